//! Bulk viscosity by direction: along the fibre, and across it.
//!
//! A shock is spread over some elements by a stress that resists the rate of compression, in a quadratic term (von Neumann
//! and Richtmyer, J. Appl. Phys. 21, 1950) and a linear one that has the speed of a wave (Landshoff, LA-1930, 1955). Of a
//! yarn's waves that along the fibre is ten times as fast as that which compacts the section: one pressure for both would
//! either let the first ring or hold the second up. Here the Cauchy stress is −q_m m ⊗ m − q_t (1 − m ⊗ m), m being the
//! fibre's direction, with q = ρ l (c2 l ⟨ε̇⟩² + c1 c ε̇) and the element's length or breadth l at rest: what has collapsed
//! is damped all the more. Along the fibre ε̇ = −D_mm, and the linear term resists stretching as well, so that fronts do not
//! ring. Across it ε̇ = −(tr D − D_mm) counts in compression only: swelling, which the law leaves free, stays so.

use super::element::{LANES, Lanes, Measures, Number, Shapes, store};
use super::largest;
use super::material::Medium;

/// What viscosity keeps of the last step, one number an element.
#[derive(Clone, Debug)]
pub struct Viscosity<T> {
    /// q_t, and what P's first column has of F's beside it: with Λ, the square of the stretch, (q_t − q_m) J/Λ.
    pub pressure: Vec<T>,
    pub tension: Vec<T>,
    volume_ratio: Vec<T>,
    stretch_square: Vec<T>,
    /// In the reference placement: along the fibre, and the side of a square as large as the section.
    length: Vec<T>,
    breadth: Vec<T>,
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
        let closing = self.quadratic * self.length * rate.max(Lanes::splat(T::default()));
        (self.length * (closing + self.linear) * rate, self.length * (closing + closing + self.linear))
    }
}

impl<T: Number> Viscosity<T> {
    pub fn new(shapes: &Shapes<T>) -> Self {
        let array = |value: f64| vec![T::from_f64(value); shapes.stride];
        let (mut length, mut breadth) = (array(1.0), array(1.0));
        for i in 0..shapes.n {
            length[i] = T::from_f64(shapes.length(i));
            breadth[i] = T::from_f64((shapes.volume[i].into() / shapes.length(i)).sqrt());
        }
        let (pressure, tension) = (array(0.0), array(0.0));
        Viscosity { pressure, tension, volume_ratio: array(1.0), stretch_square: array(1.0), length, breadth }
    }

    /// A deleted element resists nothing.
    pub fn remove(&mut self, i: usize) {
        (self.pressure[i], self.tension[i]) = (T::default(), T::default());
    }

    /// The stresses at the end of a step of this length. Returns the energy dissipated in it, by the trapezoidal rule of
    /// central differences, and the largest rate at which an element is damped.
    #[inline(always)]
    pub fn advance(
        &mut self,
        medium: &Medium<T>,
        shapes: &Shapes<T>,
        measures: &Measures<T>,
        intact: &[T],
        step: f64,
    ) -> (f64, f64) {
        let splat = |value: f64| Lanes::splat(T::from_f64(value));
        let (zero, half, two) = (splat(0.0), splat(0.5), splat(2.0));
        let per_step = splat(if step > 0.0 { 1.0 / step } else { 0.0 });
        let (density, quadratic) = (splat(medium.density), splat(medium.control.quadratic));
        let linear = [medium.wave_speed, medium.compaction_speed].map(|speed| splat(medium.control.linear * speed));
        let [mut dissipated, mut most_damped] = [zero; 2];
        for first in (0..shapes.stride).step_by(LANES) {
            let at = |array: &[T]| Lanes::at(array, first);
            let (ratio, ratio_old) = (at(&measures.volume_ratio), at(&self.volume_ratio));
            let (square, square_old) = (at(&measures.stretch_square), at(&self.stretch_square));
            let shortening = (square_old - square) / (square_old + square) * per_step;
            let narrowing = two * (ratio_old - ratio) / (ratio_old + ratio) * per_step - shortening;
            let along = Direction { length: at(&self.length), linear: linear[0], quadratic };
            let across = Direction { length: at(&self.breadth), linear: linear[1], quadratic };
            let ((q_m, damping_along), (q_t, damping)) = (along.resist(shortening), across.resist(narrowing.max(zero)));
            let standing = measures.standing(intact, first);
            let pressure = (density / ratio * q_t).only_where(standing);
            let tension = (density / square * (q_t - q_m)).only_where(standing);
            // Stress power P:Ḟ = −q_t J̇ + ½ t Λ̇.
            let work = (pressure + at(&self.pressure)) * (ratio_old - ratio)
                + half * (tension + at(&self.tension)) * (square - square_old);
            dissipated = dissipated + half * work * at(&shapes.volume);
            let spread_along = at(&measures.spread_along);
            let damping = damping_along * spread_along + damping * (at(&measures.spread) - spread_along);
            most_damped = most_damped.max(damping.only_where(standing));
            store(pressure, &mut self.pressure, first);
            store(tension, &mut self.tension, first);
            store(ratio, &mut self.volume_ratio, first);
            store(square, &mut self.stretch_square, first);
        }
        let most_damped = most_damped.0.into_iter().map(Into::into).fold(0.0, largest);
        (dissipated.0.into_iter().map(Into::into).sum(), most_damped)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::driver::explicit::element::Control;
    use crate::driver::material::{Law, Material};
    use crate::law::linear_elastic::{Criterion, Rotation};
    use crate::law::parameters;

    const STEP: f64 = 1e-8;
    /// Of the brick below: along the fibre, and the side of a square as large as the section.
    const LENGTH: f64 = 2e-3;
    const BREADTH: f64 = 0.6e-3;

    fn medium() -> Medium<f64> {
        let preset = parameters::preset("kevlar-km2-600").expect("it exists");
        let law = Law::new(preset.table, preset.values, Rotation::Fibre, Criterion::LargestPrincipal).expect("valid");
        let (values, density) = (preset.values.to_vec(), preset.density);
        let material = Material { law, values, density: Some(density), label: String::new() };
        Medium::new(&material, density, Control { hourglass: 0.1, linear: 0.06, quadratic: 1.5 }).expect("valid")
    }

    /// q_m and q_t after one step to F = diag(along, across, 1), and what was dissipated by volume.
    fn resist(along: f64, across: f64) -> [f64; 3] {
        let corner = |i: usize, size: f64, bit: usize| if i >> bit & 1 == 1 { size } else { 0.0 };
        let nodes: Vec<[f64; 3]> =
            (0..8).map(|i| [corner(i, LENGTH, 0), corner(i, 0.4e-3, 1), corner(i, 0.9e-3, 2)]).collect();
        let shapes = Shapes::<f64>::new(&[std::array::from_fn(|i| i as u32)], &nodes, 0.0);
        let array = |value: f64| vec![value; shapes.stride];
        let f: Vec<f64> =
            [along, 0.0, 0.0, 0.0, across, 0.0, 0.0, 0.0, 1.0].iter().flat_map(|&entry| array(entry)).collect();
        let [volume_ratio, stretch_square, spread, spread_along] = [0.0; 4].map(array);
        let mut measures = Measures { volume_ratio, stretch_square, spread, spread_along };
        shapes.measure(&f, &mut measures);
        let mut viscosity = Viscosity::new(&shapes);
        let (dissipated, _) = viscosity.advance(&medium(), &shapes, &measures, &array(1.0), STEP);
        let (q_t, t) = (viscosity.pressure[0], viscosity.tension[0]);
        [q_t - t * along / across, q_t, dissipated / shapes.volume[0]]
    }

    fn assert_close(found: f64, expected: f64) {
        assert!((found / expected - 1.0).abs() < 1e-4, "{found}, expected {expected}");
    }

    #[test]
    fn the_fibre_s_wave_damps_stretching_and_shortening() {
        let Medium { density, wave_speed, .. } = medium();
        let rate = 1e-6 / STEP;
        let linear = density * LENGTH * 0.06 * wave_speed * rate;
        let quadratic = density * LENGTH * LENGTH * 1.5 * rate * rate;
        for (along, expected) in [(1.0 + 1e-6, -linear), (1.0 - 1e-6, linear + quadratic)] {
            let [q_m, q_t, dissipated] = resist(along, 1.0);
            assert_close(q_m, expected);
            assert!(q_t.abs() < 1e-9 * linear, "{q_t}");
            assert_close(dissipated, 0.5 * expected.abs() * 1e-6);
        }
    }

    #[test]
    fn the_wave_of_compaction_damps_narrowing_alone() {
        let Medium { density, compaction_speed, .. } = medium();
        assert!((compaction_speed - 797.0).abs() < 1.0, "{compaction_speed}");
        let rate = 1e-6 / STEP;
        let expected = density * BREADTH * (BREADTH * 1.5 * rate + 0.06 * compaction_speed) * rate;
        let [q_m, q_t, dissipated] = resist(1.0, 1.0 - 1e-6);
        assert_close(q_t, expected);
        assert_close(dissipated, 0.5 * expected * 1e-6);
        assert!(q_m.abs() < 1e-4 * expected, "{q_m}");
        let [q_m, q_t, dissipated] = resist(1.0, 1.0 + 1e-6);
        assert!(q_m.abs() < 1e-4 * expected && q_t == 0.0 && dissipated.abs() < 1e-4 * expected * 1e-6);
    }
}
