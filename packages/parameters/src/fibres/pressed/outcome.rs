//! The result of a pressed section: energies over its reference volume, in the scene's unit of stress, and its
//! invariants.

use crate::fibres::frame::Frame;
use crate::fibres::model::{Model, Pressing, Striking, micro};
use crate::fibres::run::Raw;
use crate::fibres::scene::Walls;
use toron::host::units::UnitSystem;
use toron::law::parameters::STRESS;
use toron_materials::units::TIME;

/// A part of the section.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Part {
    /// I_tc and I_td by the second moments of the beads' places.
    pub invariants: [f64; 2],
    /// In the contacts of its fibres.
    pub energy: f64,
}

/// A line of the history.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    pub time: f64,
    /// The way between two walls that close, over that at rest.
    pub stretch: f64,
    /// The ways between the walls over those at rest, across the yarn and along the blow.
    pub ways: [f64; 2],
    /// I_tc and I_td by these ways; where there are no sides, those of the whole section. I_td rises as the walls
    /// close.
    pub strain: [f64; 2],
    /// Pressure and deviator: half the sum and half the difference of the section's principal Kirchhoff stresses, which
    /// are the walls' forces times the ways between them over the area at rest, in the mean since the line before.
    pub p_t: f64,
    pub q: f64,
    pub middle: Part,
    pub whole: Part,
    /// In the contacts with the walls.
    pub walls: f64,
    pub work: f64,
    /// What damping took of it, and friction: the remainder.
    pub damping: f64,
    pub friction: f64,
    pub kinetic: f64,
}

/// The result of a case.
#[derive(Clone, Debug)]
pub struct Pressed {
    pub model: Model,
    pub pressing: Pressing,
    pub samples: Vec<Sample>,
    pub frames: Vec<Frame>,
    pub seconds: Option<f64>,
}

impl Pressed {
    /// None of a case that is not pressed.
    pub fn new(units: &UnitSystem, model: Model, raw: &Raw) -> Option<Pressed> {
        let Striking::Walls(pressing) = model.striker else { return None };
        let samples = samples(units, &model, &pressing, &raw.rows);
        Some(Pressed { samples, frames: raw.frames.clone(), seconds: raw.seconds, pressing, model })
    }

    pub fn last(&self) -> Sample {
        self.samples.last().copied().unwrap_or_default()
    }

    /// The largest that the kinetic energy is beside what is stored, over the last half of the way.
    pub fn restlessness(&self) -> f64 {
        let way = 0.5 * (1.0 + self.last().stretch);
        let late = self.samples.iter().filter(|sample| sample.stretch < way);
        late.map(|sample| sample.kinetic / sample.whole.energy).fold(0.0, f64::max)
    }

    /// How much friction seems to have given back at most, over the work: 0 but for what the step leaves of the
    /// balance.
    pub fn imbalance(&self) -> f64 {
        let (mut highest, mut worst): (f64, f64) = (0.0, 0.0);
        for sample in &self.samples {
            highest = highest.max(sample.friction);
            worst = worst.max(highest - sample.friction);
        }
        worst / self.last().work
    }
}

fn samples(units: &UnitSystem, model: &Model, pressing: &Pressing, rows: &[Vec<f64>]) -> Vec<Sample> {
    let [time, stress] = [TIME, STRESS].map(|dimension| micro(units, dimension));
    let area = model.section.area * model.diameter * model.diameter;
    let over = |area: f64| stress / (area * model.spacing);
    let [whole, middle] = [area, pressing.middle.area].map(over);
    let brake = 2.0 * pressing.braking / model.bead_mass;
    let [all, inner] = [model.centres.len(), pressing.middle.fibres].map(|count| at_rest(&model.centres[..count]));
    let mut samples = vec![Sample { stretch: 1.0, ways: [1.0; 2], ..Sample::default() }];
    let closes = usize::from(pressing.walls != Walls::Sides);
    let (mut before, mut work, mut damping) = (0.0, 0.0, 0.0);
    for row in rows {
        let [_, now, _, power, mean_kinetic, kinetic, contacts, inside, walls, across, along, z, y, places @ ..] =
            row.as_slice()
        else {
            continue;
        };
        let ways = [z / pressing.half[0], y / pressing.half[1]];
        let stresses = [whole * across, whole * along];
        work += power * (now - before);
        damping += brake * mean_kinetic * (now - before);
        before = *now;
        let (of_all, of_inner) = places.split_at(5);
        let whole_invariants = invariants(all, moments(of_all));
        let [open, closed] = [ways[1 - closes], ways[closes]];
        let strain = [0.5 * (open * closed).ln(), 0.5 * (open / closed).ln()];
        samples.push(Sample {
            time: time * now,
            stretch: closed,
            ways,
            strain: if open > 0.0 { strain } else { whole_invariants },
            p_t: 0.5 * (stresses[0] + stresses[1]),
            q: 0.5 * (stresses[closes] - stresses[1 - closes]),
            middle: Part { invariants: invariants(inner, moments(of_inner)), energy: middle * inside },
            whole: Part { invariants: whole_invariants, energy: whole * contacts },
            walls: whole * walls,
            work: whole * work,
            damping: whole * damping,
            friction: whole * (work - damping - kinetic - contacts - walls),
            kinetic: whole * kinetic,
        });
    }
    samples
}

/// The second moments zz, zy, yy about the mean, out of the means of z, y, z², zy, y².
fn moments(means: &[f64]) -> [f64; 3] {
    let &[z, y, zz, zy, yy] = means else { return [f64::NAN; 3] };
    [zz - z * z, zy - z * y, yy - y * y]
}

fn at_rest(centres: &[[f64; 2]]) -> [f64; 3] {
    let mean = |of: &dyn Fn(&[f64; 2]) -> f64| centres.iter().map(of).sum::<f64>() / centres.len() as f64;
    moments(&[mean(&|c| c[0]), mean(&|c| c[1]), mean(&|c| c[0] * c[0]), mean(&|c| c[0] * c[1]), mean(&|c| c[1] * c[1])])
}

/// I_tc and I_td of the homogeneous deformation F that takes second moments M₀ to M = F M₀ Fᵀ: the eigenvalues of M₀⁻¹M
/// are the squares of two stretches, if its axes are those of M₀, as a box's are. I_tc is half the logarithm of their
/// product, I_td half that of their ratio.
fn invariants(before: [f64; 3], after: [f64; 3]) -> [f64; 2] {
    let determinant = |[a, b, c]: [f64; 3]| a * c - b * b;
    let ratio = determinant(after) / determinant(before);
    let [a, b, c] = before;
    let trace = (c * after[0] - 2.0 * b * after[1] + a * after[2]) / determinant(before);
    [0.25 * ratio.ln(), 0.5 * (0.5 * trace / ratio.sqrt()).max(1.0).acosh()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn invariants_are_those_of_the_stretches() {
        let places = [[2.0, 1.0], [-2.0, 1.0], [2.0, -1.0], [-2.0, -1.0], [0.0, 3.0], [0.0, -3.0]];
        let [along, across] = [1.1, 0.7f64];
        let found = invariants(at_rest(&places), at_rest(&places.map(|[z, y]| [along * z + 5.0, across * y - 3.0])));
        let expected = [0.5 * (along * across).ln(), 0.5 * (along / across).ln()];
        assert!((0..2).all(|i| (found[i] - expected[i]).abs() < 1e-12), "{found:?} {expected:?}");
        assert!(invariants(at_rest(&places), at_rest(&places)).iter().all(|i| i.abs() < 1e-7));
    }
}
