//! The tangent of a law in formulas, by forward differentiation of its stress, and from it a bound of the wave speed
//! where the law has none.

use super::kernel::{Input, Outcome, wave_modulus};
use super::{Array, Response, Step, User, UserMaterial};
use crate::law::axes::FibreFrame;
use crate::law::block::{Circumstances, Precision};
use crate::law::differentiated::{Rates, Stress, first};
use crate::law::interface::Points;
use crate::law::linear_tangent::{LinearTangent, by_rows};
use crate::law::number::dual::Dual;
use crate::law::number::level::Level;
use crate::law::number::real::{Lanes, Real};
use crate::law::number::vector::Matrix;
use crate::law::status;
use crate::law::tangent::Measure;
use crate::law::voigt::PAIRS;
use crate::law::wave_speed::wave_speed;

/// The results at a point, and ∂τ/∂L over J.
struct Answer<S> {
    outcome: Outcome<f64, S>,
    tangent: LinearTangent,
}

impl<M: UserMaterial, T: Precision> User<M, T> {
    /// Evaluates the points with their tangents, in double precision whatever that of the arrays is. Results that do
    /// not fit T are an overflow. Returns the worst status code.
    ///
    /// # Safety
    /// As for [`Kernels::run`](crate::law::block::Kernels::run).
    pub(super) unsafe fn with_derivatives(&self, points: &Points<T>) -> i32 {
        let law = self.doubled();
        let at_rest = if points.wave_speed.is_null() { 0.0 } else { law.wave_modulus_at_rest() };
        let level = points.level.unwrap_or(Level::Avx512).min(Level::best());
        let mut worst = status::OK;
        for i in 0..points.n {
            // SAFETY: i < n by the loop, and `level` is one that the processor has.
            worst = worst.min(unsafe { law.point::<T>(points, i, at_rest, level) });
        }
        worst
    }
}

impl<M: UserMaterial> User<M, f64> {
    /// ρ0 c² of a bound of the wave speed at rest.
    pub(super) fn wave_modulus_at_rest(&self) -> f64 {
        let rest = Input::at_rest(self);
        if self.bounds_waves() {
            return wave_modulus::<M, f64>(&self.constants(), &rest);
        }
        let Answer { outcome, tangent } = self.answer(&rest, Measure::Jaumann, 0.0, true, Level::best());
        acoustic_bound(&tangent, &outcome.stress)
    }

    /// What is wrong with a law that gives no numbers at rest, where every model begins.
    #[cold]
    pub(super) fn fault_at_rest(&self) -> Option<&'static str> {
        let Answer { outcome, tangent } =
            self.answer(&Input::at_rest(self), Measure::Jaumann, 0.0, false, Level::Baseline);
        if outcome.status != 0.0 {
            return Some(
                "at rest (F = 1, state 0) the stress or the state of this law is no number with these properties: is there 0/0?",
            );
        }
        let finite = tangent.0.as_flattened().iter().all(|x| x.is_finite());
        (!finite).then_some("at rest (F = 1, state 0) the tangent of this law is not finite with these properties: is there the root of 0?")
    }

    /// Evaluates point `i` and stores its results. Returns its status code.
    ///
    /// # Safety
    /// As for [`with_derivatives`](User::with_derivatives), with i < n, on a processor that has the level's
    /// instructions.
    unsafe fn point<T: Precision>(&self, points: &Points<T>, i: usize, at_rest: f64, level: Level) -> i32 {
        let law = M::DESCRIPTION;
        // SAFETY: the arrays that the block has are valid for point i, here and below.
        let load = |array: *const T| -> f64 { unsafe { *array.add(i) }.into() };
        let matrix = |[a, b, c, d, e, f, g, h, k]: [*const T; 9]| -> Matrix<f64> {
            [[a, b, c], [d, e, f], [g, h, k]].map(|column| column.map(load))
        };
        let row = |c: usize| c.wrapping_mul(points.leading_dimension);
        let mut input = Input::<f64, M::State<f64>>::at_rest(self);
        input.f = matrix(points.f_new);
        input.f_old = if law.reads.old_gradient { matrix(points.f_old) } else { input.f };
        if !points.fibre[0].is_null() {
            let (frame, usable) = FibreFrame::new(points.fibre.map(load));
            (input.directions[0], input.usable) = (frame.m, usable);
        }
        let Circumstances { time_increment, time, temperature } = points.circumstances;
        input.time_increment = if law.reads.time_increment { time_increment } else { 0.0 };
        input.time = if law.reads.time { time } else { 0.0 };
        input.temperature = if law.reads.temperature { load(temperature) } else { 0.0 };
        if !points.state_old[0].is_null() {
            for (c, x) in input.own.as_mut().iter_mut().enumerate() {
                *x = load(points.state_old[0].wrapping_add(row(c)));
            }
            input.failed = load(points.state_old[0].wrapping_add(row(law.failed)));
        }
        let Answer { mut outcome, tangent } =
            self.answer(&input, points.measure, at_rest, !points.wave_speed.is_null(), level);
        let (entries, size) = by_rows(&tangent, points.measure, &input.f.into(), &outcome.stress);
        let entries = if points.tangent.is_null() { &[][..] } else { entries.get(..size * size).unwrap_or_default() };
        // Rounded to T, a number that does not fit is not finite. A tangent of 0 that is converted with an F which is
        // not finite is not 0.
        let fits = |x: f64| (T::splat(x).into() * 0.0) == 0.0;
        let taken = outcome.active == 1.0 || (outcome.status == 0.0 && input.failed < 0.5);
        let results = outcome.stress.iter().chain(outcome.own.as_ref()).chain(entries);
        let speed = |modulus: f64| wave_speed(modulus, points.density.into());
        let waves = points.wave_speed.is_null() || fits(speed(outcome.wave_modulus));
        if taken && !(results.into_iter().all(|&x| fits(x)) && waves) {
            outcome = finish::<M>(&input, &input.step(), &overflowed::<M>(), 0.0, at_rest);
        }
        let has_tangent = outcome.status == 0.0 && input.failed < 0.5;
        // SAFETY: as above.
        let store = |x: f64, array: *mut T| unsafe { *array.add(i) = T::splat(x) };
        if !points.stress[0].is_null() {
            outcome.stress.into_iter().zip(points.stress).for_each(|(x, component)| store(x, component));
        }
        if !points.state_new[0].is_null() {
            for (c, &x) in outcome.own.as_ref().iter().enumerate() {
                store(x, points.state_new[0].wrapping_add(row(c)));
            }
            store(outcome.failed, points.state_new[0].wrapping_add(row(law.failed)));
            store(outcome.alive, points.state_new[0].wrapping_add(row(law.alive)));
        }
        for (c, &x) in entries.iter().enumerate() {
            store(if has_tangent { x } else { 0.0 }, points.tangent.wrapping_add(c * points.tangent_leading_dimension));
        }
        if !points.wave_speed.is_null() {
            store(speed(outcome.wave_modulus), points.wave_speed);
        }
        if !points.active.is_null() {
            store(outcome.active, points.active);
        }
        let code = outcome.status as i32;
        if !points.status.is_null() {
            // SAFETY: as above.
            unsafe { *points.status.add(i) = code };
        }
        code
    }

    /// The results of a point and its tangent.
    fn answer(
        &self,
        input: &Input<f64, M::State<f64>>,
        measure: Measure,
        at_rest: f64,
        waves: bool,
        level: Level,
    ) -> Answer<M::State<f64>> {
        let response = Response::new([0.0; 6], M::State::<f64>::filled(0.0));
        let mut formulas = Formulas { law: self, input, response };
        let rates = Rates::of(&mut formulas, &input.f, measure, level);
        let (response, step) = (formulas.response, input.step());
        let tangent = rates.tangent(&response.stress);
        let own = if waves { M::wave_modulus(&self.constants::<f64>(), &step, &response) } else { Some(0.0) };
        let bound = match own {
            Some(bound) => bound,
            None => {
                let bound = step.jacobian * acoustic_bound(&tangent, &response.stress);
                // What is no number stays so.
                if bound < at_rest { at_rest } else { bound }
            }
        };
        let outcome = finish::<M>(input, &step, &response, bound, at_rest);
        Answer { outcome, tangent }
    }
}

/// The formulas of a law at a point; the response is that of the last evaluation.
struct Formulas<'a, M: UserMaterial> {
    law: &'a User<M, f64>,
    input: &'a Input<f64, M::State<f64>>,
    response: Response<f64, M::State<f64>>,
}

impl<M: UserMaterial> Stress for Formulas<'_, M> {
    type Prepared<R: Lanes<f64>> = (M::Constants<Dual<R>>, Input<Dual<R>, M::State<Dual<R>>>);

    #[inline(always)]
    fn prepared<R: Lanes<f64>>(&self) -> Self::Prepared<R> {
        let mut moved = Input::<Dual<R>, M::State<Dual<R>>>::at_rest(self.law);
        for (to, &from) in moved.directions.as_flattened_mut().iter_mut().zip(self.input.directions.as_flattened()) {
            *to = Dual::splat(from);
        }
        moved.time_increment = Dual::splat(self.input.time_increment);
        moved.time = Dual::splat(self.input.time);
        moved.temperature = Dual::splat(self.input.temperature);
        for (to, &from) in moved.own.as_mut().iter_mut().zip(self.input.own.as_ref()) {
            *to = Dual::splat(from);
        }
        for (to, &from) in moved.f_old.as_flattened_mut().iter_mut().zip(self.input.f_old.as_flattened()) {
            *to = Dual::splat(from);
        }
        (self.law.constants(), moved)
    }

    #[inline(always)]
    fn stress<R: Lanes<f64>>(
        &mut self,
        (constants, moved): &mut Self::Prepared<R>,
        f: &Matrix<Dual<R>>,
    ) -> [Dual<R>; 6] {
        moved.f = *f;
        if !M::DESCRIPTION.reads.old_gradient {
            moved.f_old = *f;
        }
        let response = M::respond(constants, &moved.step());
        for (to, x) in self.response.stress.iter_mut().zip(response.stress) {
            *to = first(x.value);
        }
        for (to, x) in self.response.state.as_mut().iter_mut().zip(response.state.as_ref()) {
            *to = first(x.value);
        }
        self.response.status = first(response.status.value);
        self.response.failed = first(R::select(response.failed, R::splat(1.0), R::splat(0.0))) == 1.0;
        response.stress
    }
}

/// The results of a point, from what the law has answered.
fn finish<M: UserMaterial>(
    input: &Input<f64, M::State<f64>>,
    step: &Step<f64, M::State<f64>>,
    response: &Response<f64, M::State<f64>>,
    wave_modulus: f64,
    at_rest: f64,
) -> Outcome<f64, M::State<f64>> {
    let law = &M::DESCRIPTION;
    let (taken, not_inverted) = input.taken(step, response, wave_modulus, law);
    let mut outcome = Outcome::of(response, wave_modulus);
    if !taken {
        input.restore(&mut outcome, taken, not_inverted, at_rest, response.status, law);
    }
    outcome
}

/// A response that is not finite: the point cannot be evaluated.
fn overflowed<M: UserMaterial>() -> Response<f64, M::State<f64>> {
    Response::new([f64::INFINITY; 6], M::State::<f64>::filled(0.0))
}

/// A bound of ρ c² for waves in the current placement, from ∂τ/∂L over J for the six strains and the Cauchy stress.
///
/// For a direction n and a polarisation u, unit vectors, ρ c² = u·(c : D + Wσ − σW) n − (u·σn)(u·n) with D and W the
/// symmetric and the skew part of u⊗n. Neither is longer than 1: the first part is at most the norm of c on symmetric
/// tensors, and the others are at most the largest principal stress by its size, each.
fn acoustic_bound(tangent: &LinearTangent, &[s_11, s_22, s_33, s_12, s_23, s_31]: &[f64; 6]) -> f64 {
    let weight = |c: usize| if c < 3 { 1.0 } else { core::f64::consts::SQRT_2 };
    let (mut rows, mut columns) = ([0.0_f64; 6], [0.0_f64; 6]);
    for (column, (k, l)) in PAIRS.into_iter().enumerate() {
        for (row, (x, y)) in tangent.0[k + 3 * l].iter().zip(&tangent.0[l + 3 * k]).enumerate() {
            // A strain is half of each of two motions.
            let size = (weight(row) * weight(column) * (0.5 * x + 0.5 * y)).abs();
            rows[row] += size;
            columns[column] += size;
        }
    }
    let largest = |sums: [f64; 6]| sums.into_iter().fold(0.0, f64::max);
    let row = |a: f64, b: f64, c: f64| a.abs() + b.abs() + c.abs();
    let size = row(s_11, s_12, s_31).max(row(s_12, s_22, s_23)).max(row(s_31, s_23, s_33));
    let bound = libm::sqrt(largest(rows)) * libm::sqrt(largest(columns)) + 2.0 * size;
    // A maximum passes over what is no number.
    0.0 * rows.iter().sum::<f64>() + bound
}
