//! What limits the step: an element, with what presses its nodes.
//!
//! A step is stable where Δt² K + 2 Δt C ≤ 4 M, by central differences with a damping force that lags by half a step.
//! Each node gives contact the part of its mass that the springs there need, twice their stiffness over 4/Δt², which
//! bounds their matrix by its rows; the rest is what its elements swing against. So no element's own rate and that of
//! the contact at its worst node together may be more than 4/Δt²: not the worst element of the body with the worst node
//! of another one.

use serde::{Deserialize, Serialize};

use super::block::ElementBlock;
use super::body::Body;
use super::lanes::{LANES, Number};

/// The element that bounds the step, and what of it does: squares of frequencies.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepLimit {
    /// 4 over the square of the step that it allows; the [global estimate](super::global_estimate) may allow a longer
    /// one.
    pub rate: f64,
    pub viscous: f64,
    pub contact: f64,
    pub torn: bool,
}

/// What limits steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limiter {
    /// Waves in an element that has all its neighbours: the fastest runs along the fibre.
    Fibre,
    Contact,
    Viscosity,
    /// An element beside deleted ones, whatever takes its step.
    Shred,
    /// What ends before: a sample, the run, a step that is no longer than it was told to be.
    Other,
}

impl Limiter {
    pub const ALL: [Limiter; 5] =
        [Limiter::Fibre, Limiter::Contact, Limiter::Viscosity, Limiter::Shred, Limiter::Other];

    pub fn name(self) -> &'static str {
        match self {
            Limiter::Fibre => "fibre",
            Limiter::Contact => "contact",
            Limiter::Viscosity => "viscosity",
            Limiter::Shred => "shred",
            Limiter::Other => "other",
        }
    }
}

impl StepLimit {
    /// The largest part.
    pub fn limiter(&self) -> Limiter {
        let waves = self.rate - self.viscous - self.contact;
        if self.torn {
            Limiter::Shred
        } else if waves >= self.viscous && waves >= self.contact {
            Limiter::Fibre
        } else if self.contact >= self.viscous {
            Limiter::Contact
        } else {
            Limiter::Viscosity
        }
    }

    /// The one with the larger rate; a NaN is seen.
    pub fn worse(self, other: StepLimit) -> StepLimit {
        if self.rate > other.rate || self.rate.is_nan() { self } else { other }
    }
}

/// How often the interval of a rate is halved: to a part of 2⁻⁷ of the contact's.
const HALVINGS: usize = 7;

/// Own steps of elements over the first step of the run, in quarters of octaves.
pub const BINS: usize = 24;
const LOWEST: f64 = -4.0;
const PER_OCTAVE: f64 = 4.0;

/// So many steps lie between two looks at the elements' own steps, which cost as much as all that is measured of a
/// panel beside them.
pub const BETWEEN_LOOKS: u64 = 64;

/// How many elements have which step of their own, whole ones and torn ones, summed over looks at the run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Histogram {
    pub looks: u64,
    /// Whole and torn.
    pub elements: [Vec<u64>; 2],
    /// And the looks at which the step itself was there.
    pub steps: Vec<u64>,
}

impl Histogram {
    /// The lower end of a bin, as a part of the first step.
    pub fn low(bin: usize) -> f64 {
        (LOWEST + bin as f64 / PER_OCTAVE).exp2()
    }

    fn bin(part: f64) -> usize {
        (((part.log2() - LOWEST) * PER_OCTAVE).max(0.0) as usize).min(BINS - 1)
    }

    /// Takes the step of a look.
    pub fn look(&mut self, part: f64) {
        self.looks += 1;
        self.steps.resize(BINS, 0);
        self.elements.iter_mut().for_each(|of| of.resize(BINS, 0));
        self.steps[Self::bin(part)] += 1;
    }

    /// Takes a body's elements; `first` is the first stable step.
    pub fn add<T: Number>(&mut self, body: &Body<T>, first: f64) {
        for block in &body.blocks {
            for i in (0..block.shapes.n).filter(|&i| block.is_intact(i)) {
                let own = body.rate_of(block, i);
                let torn = usize::from(body.is_torn(&block.shapes.nodes[i]));
                self.elements[torn][Self::bin(2.0 / own.sqrt() / first)] += 1;
            }
        }
    }
}

/// What an element and the contact at its corners need together at a rate r: of each corner contact takes the part c/r,
/// and what is left makes the element's own rate no more than own + corner Σ c/(r − c), since a lighter corner adds what
/// it resists alone.
#[inline(always)]
fn needed(own: f64, corner: f64, contact: &[f64; 8], rate: f64) -> f64 {
    let mut sum = 0.0;
    for c in contact {
        sum += c / (rate - c);
    }
    own + corner * sum
}

/// The least rate, but for the last step's rounding, at which they have mass enough. No more is needed than own and the
/// worst c.
fn with_contact(own: f64, corner: f64, contact: &[f64; 8], worst: f64) -> f64 {
    let (mut low, mut high) = (own.max(worst), own + worst);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if needed(own, corner, contact, middle) <= middle { high = middle } else { low = middle }
    }
    high
}

impl<T: Number> Body<T> {
    /// Makes the springs at the nodes, by stiffness, rates: of each node the square of a frequency that is no less than
    /// theirs. A tied node has the worst of those it rests on.
    pub fn rate_contact(&mut self) {
        super::tie::hand_over(&self.ties, &mut self.springs);
        let mut most: f64 = 0.0;
        for (spring, mass) in self.springs.iter_mut().zip(&self.mass) {
            if *spring > 0.0 {
                *spring /= mass;
                most = if *spring > most { *spring } else { most };
            }
        }
        for tie in &self.ties {
            let worst = tie.rests_on().map(|corner| self.springs[corner as usize]).fold(0.0, f64::max);
            self.springs[tie.node as usize] = worst;
        }
        self.most_contact = most;
    }

    /// The rate now of what limited this body's step when that was looked at last.
    pub fn last_worst_rate(&self) -> f64 {
        self.state.worst.map_or(0.0, |(number, i)| self.rate_of(&self.blocks[number], i))
    }

    /// What limits the step of this body, where that is above this rate, by the rates of its contact.
    pub fn limit_step(&mut self, least: f64) {
        let found = self.worst_element(self.most_contact, least);
        self.state.worst = found.map(|(_, number, i)| (number, i)).or(self.state.worst);
        self.limit = found.map_or(StepLimit::default(), |(rate, number, i)| {
            let block = &self.blocks[number];
            let (contact, torn) = (rate - block.rates[i].into(), self.is_torn(&block.shapes.nodes[i]));
            StepLimit { rate, viscous: block.viscous[i].into(), contact, torn }
        });
    }

    /// The element with the largest rate above this one: the rate, block and place; `most` is the largest rate of
    /// contact.
    fn worst_element(&self, most: f64, least: f64) -> Option<(f64, usize, usize)> {
        let (mut limit, mut worst) = (least, None);
        for (number, block) in self.blocks.iter().enumerate() {
            for group in 0..block.group_rates.len() {
                let rate: f64 = block.group_rates[group].into();
                if rate.is_nan() {
                    return Some((rate, number, group * LANES));
                }
                if rate + most <= limit || rate == 0.0 {
                    continue;
                }
                for i in group * LANES..((group + 1) * LANES).min(block.shapes.n) {
                    if self.fits(block, i, limit) {
                        continue;
                    }
                    let rate = self.rate_of(block, i);
                    if rate > limit {
                        (limit, worst) = (rate, Some((rate, number, i)));
                    }
                }
            }
        }
        worst
    }

    /// Whether an element's rate beside the contact at its nodes is no larger than this.
    #[inline(always)]
    fn fits(&self, block: &ElementBlock<T>, i: usize, limit: f64) -> bool {
        let own: f64 = block.rates[i].into();
        let (contact, worst) = self.contact_at(&block.shapes.nodes[i]);
        own + worst <= limit || worst < limit && needed(own, block.corners[i].into(), &contact, limit) <= limit
    }

    /// The rates of contact at nodes, and the largest of them.
    #[inline(always)]
    fn contact_at(&self, nodes: &[u32; 8]) -> ([f64; 8], f64) {
        let (mut contact, mut worst) = ([0.0; 8], 0.0);
        for corner in 0..8 {
            let rate = self.springs[nodes[corner] as usize];
            contact[corner] = rate;
            worst = if rate > worst { rate } else { worst };
        }
        (contact, worst)
    }

    /// An element's rate beside the contact at its nodes; 0 where it is deleted.
    #[inline(always)]
    pub fn rate_of(&self, block: &ElementBlock<T>, i: usize) -> f64 {
        let own: f64 = block.rates[i].into();
        if own == 0.0 {
            return 0.0;
        }
        let (contact, worst) = self.contact_at(&block.shapes.nodes[i]);
        if worst == 0.0 { own } else { with_contact(own, block.corners[i].into(), &contact, worst) }
    }

    /// Whether an element has lost a neighbour at one of its nodes.
    pub fn is_torn(&self, nodes: &[u32; 8]) -> bool {
        !self.state.deleted.is_empty() && nodes.iter().any(|&node| self.has_lost(node as usize))
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;

    /// A brick whose corners' gradients are these signs times 1, 2 and 5: one component of the displacement meets the
    /// square of its gradient, each corner has the mass 1/8.
    fn stiffness() -> DMatrix<f64> {
        let mut sum = DMatrix::zeros(8, 8);
        for (axis, size) in [1.0, 2.0, 5.0].into_iter().enumerate() {
            let signs = (0..8).map(|corner: usize| if corner >> axis & 1 == 1 { size } else { -size });
            let gradient = DVector::from_iterator(8, signs);
            sum += &gradient * gradient.transpose();
        }
        sum
    }

    /// The highest frequency's square, of each corner the part that contact leaves at this rate.
    fn highest(contact: &[f64; 8], rate: f64) -> f64 {
        let per_root = |corner: usize| (0.125 * (1.0 - contact[corner] / rate)).sqrt().recip();
        let scale = DMatrix::from_diagonal(&DVector::from_iterator(8, (0..8).map(per_root)));
        (&scale * stiffness() * &scale).symmetric_eigenvalues().max()
    }

    #[test]
    fn an_element_beside_contact_has_mass_enough() {
        let own = highest(&[0.0; 8], 1.0);
        assert!((own - 8.0 * 8.0 * 25.0).abs() < 1e-9, "{own}");
        // What a corner resists alone, over its mass.
        let corner = 8.0 * (1.0 + 4.0 + 25.0);
        let mut random = fastrand::Rng::with_seed(5);
        let mut nearest: f64 = 0.0;
        for trial in 0..200 {
            let few = trial % 2 == 0;
            let contact = std::array::from_fn(|i| if few && i > 1 { 0.0 } else { 1.5 * own * random.f64() });
            let worst = contact.into_iter().fold(0.0, f64::max);
            let rate = with_contact(own, corner, &contact, worst);
            assert!(rate <= own + worst && highest(&contact, rate) <= rate * (1.0 + 1e-12), "{contact:?}: {rate}");
            nearest = nearest.max(highest(&contact, rate) / rate);
        }
        assert!(nearest > 0.7, "{nearest}");
    }

    #[test]
    fn the_largest_part_limits_the_step() {
        let limit = |viscous, contact, torn| StepLimit { rate: 10.0, viscous, contact, torn }.limiter();
        assert_eq!([limit(3.0, 3.0, false), limit(2.0, 5.0, false)], [Limiter::Fibre, Limiter::Contact]);
        assert_eq!([limit(5.0, 2.0, false), limit(5.0, 2.0, true)], [Limiter::Viscosity, Limiter::Shred]);
        assert_eq!(Limiter::ALL.map(|limiter| limiter as usize), [0, 1, 2, 3, 4]);
    }

    #[test]
    fn a_step_stands_in_its_bin() {
        let mut histogram = Histogram::default();
        for part in [1.0, 1.18, 1.2, 0.0, f64::INFINITY] {
            histogram.look(part);
        }
        let first = (0..BINS).find(|&bin| Histogram::low(bin) == 1.0).expect("a bin begins there");
        assert_eq!([histogram.steps[first], histogram.steps[first + 1]], [2, 1]);
        assert_eq!([histogram.steps[0], histogram.steps[BINS - 1], histogram.looks], [1, 1, 5]);
    }
}
