//! Artificial viscosity by direction: along the fibre, and of the section in area and in shape.
//!
//! A shock is spread over some elements by a stress that resists the rate of compression, in a quadratic term (von
//! Neumann and Richtmyer, J. Appl. Phys. 21, 1950) and a linear one that has the speed of a wave (Landshoff, LA-1930,
//! 1955). Of a yarn's waves that along the fibre is ten times as fast as that which compacts the section: one pressure
//! for both would either let the first ring or hold the second up. Here the Cauchy stress is −q_m m ⊗ m − q_t (1 − m ⊗
//! m) + 2 η dev D̄, m being the fibre's direction and D̄ the rate of deformation across it, with q = ρ l (c2 l ⟨ε̇⟩² +
//! c1 c ε̇), η = ρ l c3 c and the element's length or breadth l at rest: what has collapsed is damped all the more.
//! Along the fibre ε̇ = −D_mm, and the linear term resists stretching as well, so that fronts do not ring. Across it ε̇
//! = −tr D̄ counts in compression only: swelling, which the law leaves free, stays so. A change of shape is resisted
//! with the speed of distortion's wave, or the section would ring long after the kink has wrenched it; of a section
//! whose fibres slide with no more than what they hold, half the difference of the section's principal stresses.
//!
//! D̄ follows from the metric of the section, C̄: the products of F's second and third column, less their parts along
//! the first. With half its rate the stress R̄ is conjugate that is kept here.

use serde::{Deserialize, Serialize};

use super::element::{Measures, Shapes};
use super::lanes::{LANES, Lanes, Number, load};
use super::medium::Medium;
use super::rows::Rows;
use super::sliding::part_held;

/// Rows of the viscosity's history. Its stress, compression positive: along the fibre as a multiple of F's first
/// column, q_m J/Λ with the square Λ of the stretch, and 22 33 23 of the section's R̄. Then Λ and the section's metric.
const STRESS: usize = 0;
const STRETCH_SQUARE: usize = STRESS + 4;
const METRIC: usize = STRETCH_SQUARE + 1;
/// In the reference placement: the length along the fibre, and the side of a square as large as the section.
const LENGTH: usize = METRIC + 3;
const BREADTH: usize = LENGTH + 1;
const ROWS: usize = BREADTH + 1;

/// History of the viscosity, by element.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Viscosity<T> {
    history: Rows<T>,
}

/// Of one direction: coefficients of the rate and of its square, speeds included.
#[derive(Clone, Copy)]
struct Direction<T> {
    length: Lanes<T>,
    linear: Lanes<T>,
    quadratic: Lanes<T>,
}

impl<T: Number> Direction<T> {
    /// q/ρ, and its slope: the kinematic viscosity.
    #[inline(always)]
    fn resist(self, rate: Lanes<T>) -> (Lanes<T>, Lanes<T>) {
        let closing = self.quadratic * self.length * rate.max(Lanes::zero());
        (self.length * (closing + self.linear) * rate, self.length * (closing + closing + self.linear))
    }
}

impl<T: Number> Viscosity<T> {
    pub fn new(shapes: &Shapes<T>) -> Self {
        let mut history = Rows::new(ROWS, shapes.n);
        for i in 0..shapes.stride {
            for row in [STRETCH_SQUARE, METRIC, METRIC + 1, LENGTH, BREADTH] {
                history.set(row, i, T::from_f64(1.0));
            }
        }
        for i in 0..shapes.n {
            history.set(LENGTH, i, T::from_f64(shapes.length(i)));
            history.set(BREADTH, i, T::from_f64((shapes.volume(i) / shapes.length(i)).sqrt()));
        }
        Viscosity { history }
    }

    /// A deleted element resists nothing.
    pub fn remove(&mut self, i: usize) {
        (STRESS..STRESS + 4).for_each(|row| self.history.set(row, i, T::default()));
    }

    /// The stress along the fibre, and 22 33 23 of the section.
    #[inline(always)]
    pub fn stress(&self, first: usize) -> [Lanes<T>; 4] {
        self.history.at(STRESS, first)
    }

    /// The stresses at the end of a step of this length. Returns the energy dissipated in it, by the trapezoidal rule
    /// of central differences; the rates at which elements are damped go to the measures, without the limit of their
    /// shear, which is empty where there is none.
    #[inline(always)]
    pub fn advance(
        &mut self,
        medium: &Medium<T>,
        shapes: &Shapes<T>,
        measures: &mut Measures<T>,
        intact: &[T],
        limit: &[T],
        step: f64,
    ) -> f64 {
        let (zero, half, two) = (Lanes::zero(), Lanes::constant(0.5), Lanes::constant(2.0));
        let per_step = Lanes::constant(if step > 0.0 { 1.0 / step } else { 0.0 });
        let control = medium.control;
        let (density, quadratic) = (Lanes::constant(medium.density), Lanes::constant(control.quadratic));
        let linear_along = Lanes::constant(control.linear * medium.wave_speed);
        let linear_across = Lanes::constant(control.linear * medium.compaction_speed);
        let shape = Lanes::constant(control.shape * medium.distortion_speed);
        let (mut dissipated, stride) = (zero, shapes.stride);
        for group in 0..stride / LANES {
            let first = group * LANES;
            let active = measures.active(intact, first);
            let ratio = Lanes::at(&measures.volume_ratio, first);
            let square = Lanes::at(&measures.stretch_square, first);
            let [old_t, old_r22, old_r33, old_r23, square_old, old22, old33, old23, length, breadth] =
                self.history.at(STRESS, first);
            let [c22, c33, c23] = load(&measures.metric, stride, first);
            let [d22, d33, d23] = [c22 - old22, c33 - old33, c23 - old23];
            // Λ/J² is 1/det C̄, and half of tr C̄⁻¹ΔC̄ the section's growth; of ΔC̄ the rest changes the shape.
            let per_area = square / (ratio * ratio);
            let growth = half * (c33 * d22 + c22 * d33 - two * c23 * d23) * per_area;
            let [e22, e33, e23] = [d22 - growth * c22, d33 - growth * c33, d23 - growth * c23];
            let along = Direction { length, linear: linear_along, quadratic };
            let across = Direction { length: breadth, linear: linear_across, quadratic };
            let (q_m, damping_along) = along.resist((square_old - square) / (square_old + square) * per_step);
            let (q_t, damping_across) = across.resist((zero - growth * per_step).max(zero));
            let eta = across.length * shape;
            // R̄ = q_t J C̄⁻¹ − η J C̄⁻¹ Ē C̄⁻¹, where C̄⁻¹ Ē C̄⁻¹ det C̄ is less the adjugate of Ē, whose trace with
            // C̄⁻¹ is 0.
            let (scale, mut turning) = (density * per_area, eta * per_step);
            if !limit.is_empty() {
                let size = density * turning * ((e23 * e23 - e22 * e33).max(zero) * per_area).sqrt();
                turning = turning * part_held(Lanes::at(limit, first), size);
            }
            let r22 = (scale * (q_t * c33 + turning * e33)).only_where(active);
            let r33 = (scale * (q_t * c22 + turning * e22)).only_where(active);
            let r23 = (zero - scale * (q_t * c23 + turning * e23)).only_where(active);
            let t = (density / square * q_m).only_where(active);
            // Stress power ½ (t Λ̇ + R̄ : C̄̇).
            let work = (t + old_t) * (square_old - square)
                - (r22 + old_r22) * d22
                - (r33 + old_r33) * d33
                - two * (r23 + old_r23) * d23;
            dissipated = dissipated + half * half * work * shapes.volumes(first);
            // The two act on motions at right angles. Across, of a gradient g of the velocity the form is ν (tr g)² + 2
            // η
            // |dev sym g|²; with the section's spread, its largest eigenvalue is one of a 2 × 2 matrix, or η times the
            // trace of a shear.
            let [trace, area] = [Lanes::at(&measures.trace_across, first), Lanes::at(&measures.area_across, first)];
            let sum = (damping_across + eta) * trace;
            let product = Lanes::constant(16.0) * damping_across * eta * area;
            let across = half * (sum + (sum * sum - product).max(zero).sqrt());
            across.max(eta * trace).store(&mut measures.damping_across, first);
            sum.store(&mut measures.damping_at_corners, first);
            damping_along.store(&mut measures.viscosities, first);
            damping_across.store(&mut measures.viscosities, stride + first);
            eta.store(&mut measures.viscosities, 2 * stride + first);
            (damping_along * Lanes::at(&measures.spread_along, first)).store(&mut measures.damping_along, first);
            self.history.store(STRESS, first, [t, r22, r33, r23, square, c22, c33, c23]);
        }
        dissipated.sum()
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix3;

    use super::*;
    use crate::medium::Control;
    use crate::stress::first_piola_kirchhoff;
    use toron::law::parameters;
    use toron::{Criterion, Rotation};
    use toron_materials::material::model::{Law, Material, Origin};

    const STEP: f64 = 1e-8;
    const CONTROL: Control = Control { hourglass: 0.1, linear: 0.06, quadratic: 1.5, shape: 0.3, by_direction: false };
    /// Of the brick below: along the fibre, and the side of a square as large as the section.
    const LENGTH: f64 = 2e-3;
    const BREADTH: f64 = 0.6e-3;

    fn medium() -> Medium<f64> {
        let preset = parameters::preset("kevlar-km2-600").expect("it exists");
        let law = Law::new(preset.into(), preset.values, Rotation::Fibre, Criterion::LargestPrincipal).expect("valid");
        let density = preset.density;
        let material = Material {
            law,
            density: Some(density),
            label: String::new(),
            own: String::new(),
            origin: Origin::default(),
            temperature: None,
        };
        Medium::new(&material, density, CONTROL).expect("valid")
    }

    /// The Cauchy stress after a step from one deformation gradient to another, and what was dissipated in it by volume
    /// at rest with the stress that was there before.
    fn resist(from: Matrix3<f64>, to: Matrix3<f64>) -> (Matrix3<f64>, f64) {
        resist_within(&[], from, to)
    }

    /// The same within a limit of the shear, or none.
    fn resist_within(limit: &[f64], from: Matrix3<f64>, to: Matrix3<f64>) -> (Matrix3<f64>, f64) {
        let corner = |i: usize, size: f64, bit: usize| if i >> bit & 1 == 1 { size } else { 0.0 };
        let nodes: Vec<[f64; 3]> =
            (0..8).map(|i| [corner(i, LENGTH, 0), corner(i, 0.4e-3, 1), corner(i, 0.9e-3, 2)]).collect();
        let shapes = Shapes::<f64>::new(&[std::array::from_fn(|i| i as u32)], &[], &nodes, 0.0);
        let (intact, stride) = (vec![1.0; shapes.stride], shapes.stride);
        let (mut viscosity, mut measures, mut dissipated) = (Viscosity::new(&shapes), Measures::new(stride), 0.0);
        // No time passes up to the first: it is where the yarn starts.
        for (f, step) in [(from, 0.0), (to, STEP)] {
            let columns: Vec<f64> = f.iter().flat_map(|&entry| vec![entry; stride]).collect();
            shapes.measure(&columns, &mut measures);
            dissipated = viscosity.advance(&medium(), &shapes, &mut measures, &intact, limit, step);
        }
        let [along, section @ ..] = viscosity.stress(0);
        let columns: Vec<Lanes<f64>> = to.iter().map(|&entry| Lanes::splat(entry)).collect();
        let columns = columns.try_into().unwrap_or_else(|_| unreachable!("nine entries"));
        let nominal = first_piola_kirchhoff(&columns, &[Lanes::splat(0.0); 6], along, &section);
        let nominal = Matrix3::from_fn(|i, j| nominal[j][i].0[0]);
        (nominal * to.transpose() / to.determinant(), dissipated / shapes.volume(0))
    }

    /// The same by the formulas at the head of this file.
    fn expected(from: Matrix3<f64>, to: Matrix3<f64>) -> Matrix3<f64> {
        let Medium { density, wave_speed, compaction_speed, distortion_speed, .. } = medium();
        let rate = (to - from) / STEP * to.try_inverse().expect("it is regular");
        let rate = 0.5 * (rate + rate.transpose());
        let m = to.column(0).normalize();
        let (along, across) = (m * m.transpose(), Matrix3::identity() - m * m.transpose());
        let [shortening, narrowing] = [-along.dot(&rate), -across.dot(&rate)];
        let resist = |length: f64, speed: f64, rate: f64, closing: f64| {
            length * (CONTROL.quadratic * length * closing.powi(2) + CONTROL.linear * speed * rate)
        };
        let q_m = resist(LENGTH, wave_speed, shortening, shortening.max(0.0));
        let q_t = resist(BREADTH, compaction_speed, narrowing.max(0.0), narrowing.max(0.0));
        let shape = across * rate * across + 0.5 * narrowing * across;
        let stress = 2.0 * BREADTH * CONTROL.shape * distortion_speed * shape - q_m * along - q_t * across;
        density / to.determinant() * stress
    }

    fn assert_close(found: f64, expected: f64, scale: f64) {
        assert!((found - expected).abs() < 1e-4 * scale, "{found}, expected {expected}");
    }

    /// Placements from which a step is made: at rest, and stretched, slipped and turned.
    fn placements() -> [Matrix3<f64>; 2] {
        [Matrix3::identity(), Matrix3::new(0.6, -0.9, 0.2, 0.8, 0.7, -0.4, 0.1, 0.3, 0.9)]
    }

    #[test]
    fn every_motion_is_resisted_as_the_formulas_say() {
        let steps = [
            Matrix3::from_diagonal(&[1.0, 0.0, 0.0].into()),
            Matrix3::from_diagonal(&[-1.0, 0.0, 0.0].into()),
            Matrix3::from_diagonal(&[0.0, -1.0, 0.0].into()),
            Matrix3::from_diagonal(&[0.0, 1.0, 1.0].into()),
            Matrix3::new(0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0),
            Matrix3::new(0.3, -0.5, 0.2, 0.1, -0.7, 0.4, 0.6, -0.2, 0.5),
        ];
        // Rates at which the linear terms lead, and the quadratic ones.
        for (from, size) in placements().into_iter().flat_map(|from| [(from, 1e-6), (from, 1e-3)]) {
            for step in steps {
                let to = from + size * step;
                let ((found, _), expected) = (resist(from, to), expected(from, to));
                // A stress of 1 Pa is rounding: these are of some thousands.
                let scale = expected.norm().max(1.0);
                // Rates are differences here, exact to first order.
                let error = (found - expected).norm();
                assert!(error < 1e-4_f64.max(10.0 * size) * scale, "{found} expected {expected}");
            }
        }
    }

    #[test]
    fn a_section_that_slides_is_damped_by_no_more_than_it_holds() {
        let limits = |limit: f64| vec![limit; LANES];
        let shear = |size: f64| Matrix3::new(0.0, 0.0, 0.0, 0.0, -0.3, 1.0, 0.0, 0.5, 0.3) * size;
        for from in placements() {
            let to = from + from * shear(1e-4);
            let held = |limit: &[f64]| {
                let (stress, lost) = resist_within(limit, from, to);
                let half = 0.5 * to.determinant();
                let values = stress.symmetric_eigenvalues();
                (half * (values.max() - values.min()), lost)
            };
            let (free, lost) = held(&[]);
            assert_eq!((held(&limits(1e3 * free)), held(&limits(free * 1.001))), ((free, lost), (free, lost)));
            for part in [0.5, 0.1, 0.0] {
                let (found, less) = held(&limits(part * free));
                assert!((found - part * free).abs() < 1e-4 * free, "{found} {free}");
                assert!((less - part * lost).abs() < 1e-4 * lost, "{less} {lost}");
            }
        }
    }

    #[test]
    fn swelling_slip_and_rotation_are_free() {
        for from in placements() {
            let turn = nalgebra::Rotation3::from_euler_angles(1e-4, -2e-4, 3e-4).into_inner();
            let slip = Matrix3::new(1.0, 1e-4, -2e-4, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
            let swell = Matrix3::from_diagonal(&[1.0, 1.0 + 1e-4, 1.0 + 1e-4].into());
            for to in [turn * from, from * slip] {
                assert!(resist(from, to).0.norm() < 1e-9 * resist(from, from * swell.transpose() * 0.999).0.norm());
            }
        }
        let (stress, dissipated) = resist(Matrix3::identity(), Matrix3::from_diagonal(&[1.0, 1.0001, 1.0001].into()));
        assert!(stress.norm() < 1e-6 && dissipated.abs() < 1e-12, "{stress}, {dissipated}");
    }

    #[test]
    fn what_is_dissipated_is_the_work_of_the_stress() {
        // The trapezoidal rule has half of it: there was none before.
        for from in placements() {
            let to = from + 1e-6 * Matrix3::new(0.3, -0.5, 0.2, 0.1, -0.7, 0.4, 0.6, -0.2, 0.5);
            let (stress, dissipated) = resist(from, to);
            let nominal = to.determinant() * stress * to.try_inverse().expect("it is regular").transpose();
            let work = 0.5 * nominal.dot(&(to - from));
            assert!(work > 0.0, "{work}");
            assert_close(dissipated, work, work);
        }
    }

    /// The section's form ν (tr g)² + 2 η |dev sym g|² for gradients g of the velocity, spread by S: its largest
    /// eigenvalue from its 4 × 4 matrix.
    #[test]
    fn no_motion_across_the_fibre_is_damped_more_than_the_bound() {
        let nodes: Vec<[f64; 3]> = (0..8)
            .map(|i| [LENGTH * f64::from(i & 1), 0.4e-3 * f64::from(i >> 1 & 1), 0.9e-3 * f64::from(i >> 2)])
            .collect();
        let shapes = Shapes::<f64>::new(&[std::array::from_fn(|i| i as u32)], &[], &nodes, 0.0);
        let mut medium = medium();
        for [linear, shape] in [[0.06, 0.3], [0.3, 0.05], [0.0, 0.3], [0.3, 0.0]] {
            medium.control = Control { linear, shape, ..CONTROL };
            for f in placements() {
                let columns: Vec<f64> = f.iter().flat_map(|&entry| vec![entry; shapes.stride]).collect();
                let (mut viscosity, mut measures) = (Viscosity::new(&shapes), Measures::new(shapes.stride));
                shapes.measure(&columns, &mut measures);
                viscosity.advance(&medium, &shapes, &mut measures, &vec![1.0; shapes.stride], &[], 0.0);
                let [nu, eta] =
                    [linear * medium.compaction_speed, shape * medium.distortion_speed].map(|speed| BREADTH * speed);
                let (trace, area) = (measures.trace_across[0], measures.area_across[0]);
                let apart = (trace * trace - 4.0 * area).max(0.0).sqrt();
                let roots = [0.5 * (trace + apart), 0.5 * (trace - apart)].map(f64::sqrt);
                // Entries 11 22 12 21, each times the root of the eigenvalue of S that its direction has.
                let form = nalgebra::Matrix4::new(
                    nu + eta,
                    nu - eta,
                    0.0,
                    0.0,
                    nu - eta,
                    nu + eta,
                    0.0,
                    0.0,
                    0.0,
                    0.0,
                    eta,
                    eta,
                    0.0,
                    0.0,
                    eta,
                    eta,
                );
                let scale = nalgebra::Matrix4::from_diagonal(&[roots[0], roots[1], roots[1], roots[0]].into());
                let expected = (scale * form * scale).symmetric_eigenvalues().max();
                assert_close(measures.damping_across[0], expected, 1e-3 * expected);
                assert!(measures.damping_at_corners[0] >= expected);
            }
        }
    }

    #[test]
    fn compaction_and_distortion_have_their_speeds() {
        let Medium { compaction_speed, distortion_speed, .. } = medium();
        assert!((compaction_speed - 797.0).abs() < 1.0, "{compaction_speed}");
        assert!((distortion_speed - 346.7).abs() < 0.1, "{distortion_speed}");
    }
}
