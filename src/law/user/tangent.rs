//! The tangent of a law in formulas, by forward differentiation of its stress, and from it a bound of the wave speed where the law has
//! none.
//!
//! One point at a time: each lane of a register moves F in another direction, F + ε L F, so that two registers of four numbers hold
//! the six strains.

use super::kernel::{Input, Outcome, wave_modulus};
use super::{Array, Response, Step, User, UserMaterial};
use crate::law::block::Precision;
use crate::law::interface::Points;
use crate::law::kinematics::FibreFrame;
use crate::law::linear_tangent::{LinearTangent, by_rows};
use crate::law::number::dual::Dual;
use crate::law::number::level::Level;
use crate::law::number::real::{Lanes, WIDEST};
use crate::law::number::registers::Registers;
use crate::law::number::vector::{Matrix, image};
use crate::law::status;
use crate::law::tangent::Measure;
use crate::law::voigt::PAIRS;
use crate::law::wave_speed::wave_speed;

/// The directions L of the motions F + ε L F: six strains, the shears of engineering measure 1, and nine entries 11 21 31 12 22 32 13
/// 23 33; filled up to whole registers.
const STRAINS: [Matrix<f64>; 8] = strains();
const ENTRIES: [Matrix<f64>; 16] = entries();

const fn strains() -> [Matrix<f64>; 8] {
    let (mut directions, mut c) = ([[[0.0; 3]; 3]; 8], 0);
    while c < 6 {
        let (k, l) = PAIRS[c];
        directions[c][k][l] += 0.5;
        directions[c][l][k] += 0.5;
        c += 1;
    }
    directions
}

const fn entries() -> [Matrix<f64>; 16] {
    let (mut directions, mut c) = ([[[0.0; 3]; 3]; 16], 0);
    while c < 9 {
        directions[c][c / 3][c % 3] = 1.0; // the column of L that it multiplies
        c += 1;
    }
    directions
}

/// The results at a point, and ∂τ/∂L over J.
struct Answer<S> {
    outcome: Outcome<f64, S>,
    tangent: LinearTangent,
}

impl<M: UserMaterial, T: Precision> User<M, T> {
    /// Evaluates the points with their tangents, in double precision whatever that of the arrays is. Results that do not fit T are an
    /// overflow. Returns the worst status code.
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

    /// Evaluates point `i` and stores its results. Returns its status code.
    ///
    /// # Safety
    /// As for [`with_derivatives`](User::with_derivatives), with i < n, on a processor that has the level's instructions.
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
        input.f_old = if law.reads_old_gradient { matrix(points.f_old) } else { input.f };
        if !points.fibre[0].is_null() {
            let (frame, usable) = FibreFrame::new(points.fibre.map(load));
            (input.directions[0], input.usable) = (frame.m, usable);
        }
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
        // Rounded to T, a number that does not fit is not finite. A tangent of 0 that is converted with an F which is not finite is
        // not 0.
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

    /// The results of a point and its tangent: for [`Measure::Nominal`] by nine motions, else by six strains.
    fn answer(
        &self,
        input: &Input<f64, M::State<f64>>,
        measure: Measure,
        at_rest: f64,
        waves: bool,
        level: Level,
    ) -> Answer<M::State<f64>> {
        let mut rates = [[0.0; 6]; 16];
        let nominal = measure == Measure::Nominal;
        let directions: &[Matrix<f64>] = if nominal { &ENTRIES } else { &STRAINS };
        let response = match level {
            // SAFETY: the processor has the level's instructions.
            #[cfg(target_arch = "x86_64")]
            Level::Avx2 | Level::Avx512 => unsafe { avx2(self, input, directions, &mut rates) },
            _ => differentiated::<M, <f64 as Registers>::Baseline>(self, input, directions, &mut rates),
        };
        let step = input.step();
        let mut tangent = LinearTangent::default();
        for (c, entry) in rates.iter_mut().zip(directions).enumerate().take(if nominal { 9 } else { 6 }) {
            let (rate, direction) = entry;
            // ∂τ/∂L over J, τ = Jσ.
            let trace = direction[0][0] + direction[1][1] + direction[2][2];
            for (x, stress) in rate.iter_mut().zip(response.stress) {
                *x += trace * stress;
            }
            if nominal {
                tangent.0[c] = *rate;
            } else {
                let (k, l) = PAIRS[c];
                (tangent.0[k + 3 * l], tangent.0[l + 3 * k]) = (*rate, *rate);
            }
        }
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

/// # Safety
/// The processor has these instructions.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
unsafe fn avx2<M: UserMaterial>(
    law: &User<M, f64>,
    input: &Input<f64, M::State<f64>>,
    directions: &[Matrix<f64>],
    rates: &mut [[f64; 6]; 16],
) -> Response<f64, M::State<f64>> {
    differentiated::<M, <f64 as Registers>::Avx2>(law, input, directions, rates)
}

/// Evaluates the law with derivatives along these motions, as many at a time as there are lanes. Returns the values; the derivatives
/// of the stress go to `rates`.
#[inline(always)]
fn differentiated<M: UserMaterial, R: Lanes<f64>>(
    law: &User<M, f64>,
    input: &Input<f64, M::State<f64>>,
    directions: &[Matrix<f64>],
    rates: &mut [[f64; 6]; 16],
) -> Response<f64, M::State<f64>> {
    let constants = law.constants::<Dual<R>>();
    let constant = |x: f64| Dual::new(R::splat(x), R::splat(0.0));
    let mut moved = Input::<Dual<R>, M::State<Dual<R>>>::at_rest(law);
    for (to, &from) in moved.directions.as_flattened_mut().iter_mut().zip(input.directions.as_flattened()) {
        *to = constant(from);
    }
    for (to, &from) in moved.own.as_mut().iter_mut().zip(input.own.as_ref()) {
        *to = constant(from);
    }
    for (to, &from) in moved.f_old.as_flattened_mut().iter_mut().zip(input.f_old.as_flattened()) {
        *to = constant(from);
    }
    let mut values = [0.0; WIDEST];
    let mut answer = Response::new([0.0; 6], M::State::<f64>::filled(0.0));
    for (directions, rates) in directions.chunks_exact(R::COUNT).zip(rates.chunks_exact_mut(R::COUNT)) {
        // The motions L F, one in each lane.
        let mut slopes = [[0.0; WIDEST]; 9];
        for (lane, l) in directions.iter().enumerate() {
            for (column, f) in input.f.iter().enumerate() {
                for (row, x) in image(l, *f).into_iter().enumerate() {
                    slopes[3 * column + row][lane] = x;
                }
            }
        }
        for ((to, &from), slope) in moved.f.as_flattened_mut().iter_mut().zip(input.f.as_flattened()).zip(&slopes) {
            // SAFETY: the widest register fits.
            *to = Dual::new(R::splat(from), unsafe { R::load(slope.as_ptr()) });
        }
        if !M::DESCRIPTION.reads_old_gradient {
            moved.f_old = moved.f;
        }
        let response = M::respond(&constants, &moved.step());
        let mut first = |x: R| -> f64 {
            // SAFETY: as above.
            unsafe { x.store(values.as_mut_ptr()) };
            values[0]
        };
        for (to, x) in answer.stress.iter_mut().zip(response.stress) {
            *to = first(x.value);
        }
        for (to, x) in answer.state.as_mut().iter_mut().zip(response.state.as_ref()) {
            *to = first(x.value);
        }
        answer.status = first(response.status.value);
        answer.failed = first(R::select(response.failed, R::splat(1.0), R::splat(0.0))) == 1.0;
        for (c, x) in response.stress.iter().enumerate() {
            // SAFETY: as above.
            unsafe { x.slope.store(values.as_mut_ptr()) };
            for (rate, &value) in rates.iter_mut().zip(&values) {
                rate[c] = value;
            }
        }
    }
    answer
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
/// For a direction n and a polarisation u, unit vectors, ρ c² = u·(c : D + Wσ − σW) n − (u·σn)(u·n) with D and W the symmetric and the
/// skew part of u⊗n. Neither is longer than 1: the first part is at most the norm of c on symmetric tensors, and the others are at most
/// the largest principal stress by its size, each.
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
