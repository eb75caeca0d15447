//! Hourglass control of a section whose fibres slide: it holds no more shear across the fibre than they do.
//!
//! An element's hourglass modes are those of its reference placement, carried along by F, and an elastic force holds the
//! rest e of them. What control may hold is a stress τ, that of its modulus M and of the strain whose energy it has: ½ τ²/M
//! by volume. Where the modes across the fibre exceed the limit, they slide back to it, along themselves, and what they
//! slide by becomes a part S of the reference placement: e = q − F S. So the force stays the slope of an energy, turns with
//! the element, and is at rest in any shape into which the section has slid; what is lost is not given back. Modes along
//! the fibre are held as before: friction in the plane of the section does not bound them.

#![expect(clippy::needless_range_loop, reason = "what is inlined for certain: see Lanes")]

use super::element::{Measures, Shapes};
use super::lanes::{LANES, Lanes, Number, cross, load};
use super::rows::Rows;

/// Loose fibres without cohesion hold nothing at all, but corners of their elements must not turn inside out: control may
/// hold this part of what the material would hold hourglass modes with in any case. In Kevlar it is 0.2 MPa, with which a
/// panel keeps its energy and its mesh; without it neither.
pub const LEAST: f64 = 3e-4;

/// The strain of the modes, that of the stress and the modulus, up to which they may have slid: a side of the element has
/// then lost an eighth. Beyond it they are held as where nothing slides. With 0.05 a struck yarn's width is the same to
/// 1 %, with 0.3 the corners of a panel's elements turn inside out.
const FARTHEST: f64 = 0.1;

/// Rows of the history: S, mode α of X_j in α + 4j, and the size of e across the fibre.
pub const SLIP: usize = 0;
const SIZE: usize = SLIP + 12;
const ROWS: usize = SIZE + 1;

/// The history of elements that have not slid.
pub fn fresh<T: Number>(elements: usize) -> Rows<T> {
    Rows::new(ROWS, elements)
}

/// The part of a stress of this size that a limit leaves: all of it where it is no larger.
#[inline(always)]
pub fn part_held<T: Number>(limit: Lanes<T>, size: Lanes<T>) -> Lanes<T> {
    // Where both are 0 the part does not matter.
    limit / size.max(limit).max(Lanes::constant(f64::from(f32::MIN_POSITIVE)))
}

/// Numbers of elements in this step.
pub struct Elements<'a, T> {
    pub f: &'a [T],
    pub measures: &'a Measures<T>,
    pub intact: &'a [T],
    /// The shear that each holds.
    pub limit: &'a [T],
}

/// Sums over elements.
#[derive(Clone, Copy, Debug, Default)]
pub struct Slid {
    /// The energy lost, as a law's friction counts it: of the forces before and after.
    pub lost: f64,
    /// The largest of what hourglass modes add to the squares of frequencies, times the density.
    pub shared: f64,
}

/// Lets the modes slide, and leaves in `modal` what is held of them, by a modulus and a least limit.
#[inline(always)]
pub fn slide<T: Number>(
    [modulus, least]: [f64; 2],
    shapes: &Shapes<T>,
    of: Elements<'_, T>,
    history: &mut Rows<T>,
    modal: &mut [T],
) -> Slid {
    let (stride, zero, one) = (shapes.stride, Lanes::zero(), Lanes::constant(1.0));
    let (half, least, modulus) = (Lanes::constant(0.5), Lanes::constant(least), Lanes::constant(modulus));
    let (mut lost, mut shared) = (zero, zero);
    for group in 0..stride / LANES {
        let first = group * LANES;
        let active = of.measures.active(of.intact, first);
        let [f0, f1, f2, f3, f4, f5, f6, f7, f8] = load(of.f, stride, first);
        let [u, v, w] = [[f0, f1, f2], [f3, f4, f5], [f6, f7, f8]];
        // Rows of F's inverse, times J.
        let inverse = [cross(v, w), cross(w, u), cross(u, v)];
        let per_volume = (one / Lanes::at(&of.measures.volume_ratio, first)).only_where(active);
        let per_square = one / Lanes::at(&of.measures.stretch_square, first);
        let mut e: [Lanes<T>; 12] = load(modal, stride, first);
        let (mut across, mut square) = ([zero; 12], zero);
        for mode in 0..4 {
            let along = (e[mode] * u[0] + e[mode + 4] * u[1] + e[mode + 8] * u[2]) * per_square;
            for i in 0..3 {
                across[mode + 4 * i] = e[mode + 4 * i] - along * u[i];
                square = square + across[mode + 4 * i] * across[mode + 4 * i];
            }
        }
        let stiffness = shapes.stiffness_by_volume(first);
        let [old] = history.at(SIZE, first);
        let size = square.sqrt();
        let limit = Lanes::at(of.limit, first).max(least);
        let held = part_held(limit, (modulus * stiffness).sqrt() * size);
        let slips = (one - held).only_where(active);
        let mut slip: [Lanes<T>; 12] = history.at(SLIP, first);
        let mut added = [zero; 12];
        // |S|², S·added and |added|².
        let (mut own, mut crossed, mut whole) = (zero, zero, zero);
        for mode in 0..4 {
            for j in 0..3 {
                let (row, c) = (inverse[j], mode + 4 * j);
                let part = row[0] * across[mode] + row[1] * across[mode + 4] + row[2] * across[mode + 8];
                added[c] = part * per_volume * slips;
                own = own + slip[c] * slip[c];
                crossed = crossed + slip[c] * added[c];
                whole = whole + added[c] * added[c];
            }
        }
        // As much of it as ends at the farthest.
        let room = (Lanes::constant(FARTHEST * FARTHEST) * modulus / stiffness - own).max(zero);
        let reach = (crossed * crossed + whole * room).sqrt() - crossed;
        let allowed = part_held(reach.max(zero), whole);
        let slips = slips * allowed;
        for c in 0..12 {
            e[c] = e[c] - across[c] * slips;
            e[c].store(modal, c * stride + first);
            slip[c] = slip[c] + added[c] * allowed;
        }
        history.store(SLIP, first, slip);
        let now = size * (one - slips);
        history.store(SIZE, first, [now]);
        // The smaller of two is minus the larger of both with minus.
        let smaller = zero - (zero - size).max(zero - old);
        let work = half * stiffness * (now + now.max(smaller)) * (size - now);
        lost = lost + (work * shapes.volumes(first)).only_where(active);
        // What has not slid has the bound that it was given.
        shared = shared.max((stiffness * shapes.shed(&slip, first)).only_where(active).only_where(own + whole));
    }
    Slid { lost: lost.sum(), shared: shared.largest() }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, Matrix3, Rotation3, Vector3};

    use super::*;
    use crate::element::tests::{MODULUS, NODES};

    /// Below the stress of the modes of `crooked`, 0.02 and more across the fibre.
    const LIMIT: f64 = 4e-3;

    /// One element, where it is and what has slid.
    struct Element {
        shapes: Shapes<f64>,
        history: Rows<f64>,
        f: Vec<f64>,
        modal: Vec<f64>,
    }

    impl Element {
        fn new() -> Self {
            Element::of(&NODES)
        }

        fn of(nodes: &[[f64; 3]; 8]) -> Self {
            let shapes = Shapes::new(&[[0, 1, 2, 3, 4, 5, 6, 7]], &[], nodes, MODULUS);
            let array = |components: usize| vec![0.0; components * shapes.stride];
            Element { history: fresh(1), f: array(9), modal: array(12), shapes }
        }

        fn place(&mut self, displacement: &[[f64; 3]]) {
            self.shapes.deform(displacement, &self.history, &mut self.f, &mut self.modal);
        }

        /// After a step to there.
        fn slide(&mut self, displacement: &[[f64; 3]], limit: f64) -> Slid {
            self.place(displacement);
            let mut measures = Measures::new(self.shapes.stride);
            self.shapes.measure(&self.f, &mut measures);
            let (intact, limit) = (vec![1.0; self.shapes.stride], vec![limit; self.shapes.stride]);
            let of = Elements { f: &self.f, measures: &measures, intact: &intact, limit: &limit };
            slide([MODULUS, LEAST], &self.shapes, of, &mut self.history, &mut self.modal)
        }

        fn forces(&self) -> Vec<[f64; 3]> {
            let mut forces = vec![[0.0; 3]; 8];
            let (intact, nominal) = (vec![1.0; self.shapes.stride], vec![0.0; 9 * self.shapes.stride]);
            self.shapes.forces(&nominal, &self.modal, &intact, &self.history, &mut forces);
            forces
        }

        fn energy(&self) -> f64 {
            self.shapes.hourglass_energy(0, &self.modal)
        }

        /// The amplitudes, a column a mode.
        fn amplitudes(&self) -> nalgebra::Matrix3x4<f64> {
            nalgebra::Matrix3x4::from_fn(|i, mode| self.modal[(mode + 4 * i) * self.shapes.stride])
        }

        /// The stress of the modes across the fibre.
        fn stress(&self) -> f64 {
            let fibre = Vector3::from_fn(|i, _| self.f[i * self.shapes.stride]).normalize();
            let across = (Matrix3::identity() - fibre * fibre.transpose()) * self.amplitudes();
            let stiffness: f64 = self.shapes.stiffness_by_volume(0).0[0];
            (MODULUS * stiffness).sqrt() * across.norm()
        }
    }

    /// Displacements that are no linear field.
    fn crooked(size: f64) -> Vec<[f64; 3]> {
        (0..8).map(|i| [0.1, 0.7, 1.3].map(|phase| size * (phase + 2.3 * f64::from(i)).sin())).collect()
    }

    /// A good part of an element's size, by which its modes may slide in one step.
    const FAR: f64 = 0.05;

    /// An element that has slid by that.
    fn slid() -> Element {
        let mut element = Element::new();
        element.slide(&crooked(FAR), LIMIT);
        assert!((element.stress() / LIMIT - 1.0).abs() < 1e-12, "{}", element.stress());
        element
    }

    #[test]
    fn below_the_limit_the_bits_stay() {
        let (mut element, mut free) = (Element::new(), Element::new());
        free.history = Rows::new(0, 0);
        free.place(&crooked(0.05));
        for _ in 0..2 {
            let slid = element.slide(&crooked(0.05), 1.0);
            assert_eq!(slid.lost, 0.0);
        }
        assert!(element.stress() > LIMIT, "{}", element.stress());
        assert_eq!((&element.modal, element.forces()), (&free.modal, free.forces()));
    }

    #[test]
    fn beyond_it_the_limit_is_held_and_work_is_stored_or_lost() {
        let missing = [50, 100].map(|steps| {
            let mut element = Element::new();
            let (mut work, mut lost) = (0.0, 0.0);
            for step in 0..steps {
                let before = element.forces();
                let [from, to] = [step, step + 1].map(|step| crooked(0.05 * f64::from(step) / f64::from(steps)));
                lost += element.slide(&to, LIMIT).lost;
                let after = element.forces();
                for ((from, to), (before, after)) in from
                    .as_flattened()
                    .iter()
                    .zip(to.as_flattened())
                    .zip(before.as_flattened().iter().zip(after.as_flattened()))
                {
                    work -= 0.5 * (before + after) * (to - from);
                }
            }
            assert!((element.stress() / LIMIT - 1.0).abs() < 1e-12, "{}", element.stress());
            assert!(lost > 0.1 * work, "{lost} {work}");
            (work - lost - element.energy()) / work
        });
        assert!(missing[0].abs() < 1e-2 && missing[1].abs() < 0.6 * missing[0].abs(), "{missing:?}");
    }

    #[test]
    fn what_has_slid_turns_with_the_element_and_rests_there() {
        let mut element = slid();
        let (size, energy) = (element.amplitudes(), element.energy());
        let turn = Rotation3::from_euler_angles(0.4, -0.7, 1.1).into_inner();
        let turned: Vec<[f64; 3]> = NODES
            .iter()
            .zip(crooked(FAR))
            .map(|(&x, u)| (turn * (Vector3::from(x) + Vector3::from(u)) - Vector3::from(x)).into())
            .collect();
        let lost = element.slide(&turned, LIMIT).lost;
        assert!((element.amplitudes() - turn * size).norm() < 1e-13 * size.norm());
        assert!((element.energy() / energy - 1.0).abs() < 1e-12 && lost < 1e-12 * energy, "{lost} {energy}");
    }

    #[test]
    fn forces_are_the_slope_of_the_energy_that_is_left() {
        let mut element = slid();
        let mut displacement = crooked(FAR);
        element.place(&displacement);
        let (force, step) = (element.forces(), 1e-6);
        assert!(force.iter().flatten().any(|f| f.abs() > 1e-4), "there is something to compare");
        for (node, i) in [(0, 0), (3, 1), (6, 2), (7, 0)] {
            let [low, high] = [-step, step].map(|change| {
                displacement[node][i] += change;
                element.place(&displacement);
                displacement[node][i] -= change;
                element.energy()
            });
            let slope = (high - low) / (2.0 * step);
            assert!((slope + force[node][i]).abs() < 1e-8, "{slope} {}", force[node][i]);
        }
    }

    /// The forces are linear in the displacement, alike for its three components.
    #[test]
    fn no_motion_has_a_higher_frequency_than_the_bound() {
        // At rest a cuboid's modes are at right angles to linear fields.
        let cuboid = std::array::from_fn(|i| {
            [(0, 2.0), (1, 1.0), (2, 1.5)].map(|(bit, side)| if i >> bit & 1 == 1 { side } else { 0.0 })
        });
        let mut element = Element::of(&cuboid);
        let shared = element.slide(&crooked(FAR), LIMIT).shared;
        let [own, at_rest] = element.shapes.hourglass_frequency;
        element.place(&[[0.0; 3]; 8]);
        let rest = element.forces();
        let columns: Vec<f64> = (0..8)
            .flat_map(|node| {
                let mut displacement = [[0.0; 3]; 8];
                displacement[node][0] = 1.0;
                element.place(&displacement);
                let force = element.forces();
                (0..8).map(|n| rest[n][0] - force[n][0]).collect::<Vec<f64>>()
            })
            .collect();
        let largest = DMatrix::from_vec(8, 8, columns).symmetric_eigenvalues().max() / element.shapes.corner_volume(0);
        assert!(largest <= own + shared, "{largest} {own} {shared}");
        assert!(largest > 1.005 * (own + at_rest), "the bound at rest would not do: {largest} {own} {at_rest}");
    }

    #[test]
    fn modes_slide_no_farther_than_their_elements_stay_whole() {
        let mut element = Element::new();
        for step in 1..=1000 {
            element.slide(&crooked(6e-4 * f64::from(step)), LIMIT);
        }
        let stiffness: f64 = element.shapes.stiffness_by_volume(0).0[0];
        let slip: f64 = (0..12).map(|c| element.history.number(SLIP + c, 0).powi(2)).sum();
        let strain = (stiffness / MODULUS * slip).sqrt();
        assert!(strain < 1.000_001 * FARTHEST && strain > 0.95 * FARTHEST, "{strain}");
        assert!(element.stress() > 2.0 * LIMIT, "{}", element.stress());
    }

    #[test]
    fn a_part_of_the_modulus_is_held_where_the_limit_is_0() {
        let mut element = Element::new();
        let lost = element.slide(&crooked(FAR), 0.0).lost;
        assert!((element.stress() / LEAST - 1.0).abs() < 1e-12 && lost > 0.0, "{} {lost}", element.stress());
        // Along the fibre modes are held as ever.
        assert!(element.energy() > 5e-4, "{}", element.energy());
    }
}
