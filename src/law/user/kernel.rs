//! Blocks of points of a law in formulas, at every level of instructions.

use core::ops::Range;

use super::{Array, MOST_DIRECTIONS, Response, Step, User, UserMaterial};
use crate::law::axes::FibreFrame;
use crate::law::block::{Circumstances, Kernels, Points, Precision, least_code};
use crate::law::description::Description;
use crate::law::failure::Failure;
use crate::law::number::level::Level;
use crate::law::number::real::{Lanes, Real};
#[cfg(target_arch = "x86_64")]
use crate::law::number::twice::Twice;
use crate::law::number::vector::{Matrix, accurate_cross, dot, is_finite};
use crate::law::status;
use crate::law::wave_speed::wave_speed;

/// The results at the points in the lanes, as they are stored.
pub(super) struct Outcome<R, S> {
    pub stress: [R; 6],
    pub own: S,
    pub failed: R,
    pub alive: R,
    pub wave_modulus: R,
    /// The status code, as a number.
    pub status: R,
    /// 1 where the point is neither failed nor impossible to evaluate, else 0.
    pub active: R,
}

impl<R: Real, S: Array<R>> Outcome<R, S> {
    /// The results where the step is taken.
    #[inline(always)]
    pub fn of(response: &Response<R, S>, wave_modulus: R) -> Self {
        let (zero, one) = (R::splat(0.0), R::splat(1.0));
        let failed = R::select(response.failed, one, zero);
        let (stress, own, alive) = (response.stress, response.state, one - failed);
        Outcome { stress, own, failed, alive, wave_modulus, status: zero, active: alive }
    }
}

/// F, directions, circumstances and old state of the points in the lanes.
#[derive(Clone, Copy)]
pub(super) struct Input<R: Real, S> {
    pub f_old: Matrix<R>,
    pub f: Matrix<R>,
    pub directions: [[R; 3]; MOST_DIRECTIONS],
    /// Where the fibre direction is finite and not zero.
    pub usable: R::Mask,
    /// 0 where the law does not read it.
    pub time_increment: R,
    pub time: R,
    pub temperature: R,
    pub own: S,
    pub failed: R,
}

impl<R: Real, S: Array<R>> Input<R, S> {
    /// A point at rest, with the directions of the properties.
    #[inline(always)]
    pub fn at_rest<M: UserMaterial, T: Precision>(law: &User<M, T>) -> Self {
        let (zero, one) = (R::splat(0.0), R::splat(1.0));
        let identity = [[one, zero, zero], [zero, one, zero], [zero, zero, one]];
        let (mut directions, mut k) = ([[zero; 3]; MOST_DIRECTIONS], 0);
        while k < M::DESCRIPTION.directions.len().max(1) {
            let [x, y, z] = law.directions[k];
            directions[k] = [R::splat(x.into()), R::splat(y.into()), R::splat(z.into())];
            k += 1;
        }
        Input {
            f_old: identity,
            f: identity,
            directions,
            usable: zero.le(zero),
            time_increment: zero,
            time: zero,
            temperature: zero,
            own: S::filled(zero),
            failed: zero,
        }
    }

    /// What the law is evaluated from.
    #[inline(always)]
    pub fn step(&self) -> Step<R, S> {
        let [fibre, a, b] = self.directions;
        Step {
            f_old: self.f_old,
            f: self.f,
            jacobian: determinant(&self.f),
            fibre,
            other_directions: [a, b],
            time_increment: self.time_increment,
            time: self.time,
            temperature: self.temperature,
            state: self.own,
        }
    }

    /// Where the step is taken, since the point has not failed before and can be evaluated; and where det F is
    /// positive. An entry of F that is not finite makes det F not finite.
    #[inline(always)]
    pub fn taken(
        &self,
        step: &Step<R, S>,
        response: &Response<R, S>,
        wave_modulus: R,
        &Description { reads, refusal, .. }: &Description,
    ) -> (R::Mask, R::Mask) {
        let zero = R::splat(0.0);
        // A number times zero is zero unless it is NaN or infinite. Two sums: half as long a chain of operations.
        let [s_11, s_22, s_33, s_12, s_23, s_31] = response.stress;
        let mut check = s_33.mul_add(zero, s_22.mul_add(zero, s_11 * zero));
        let mut other = s_31.mul_add(zero, s_23.mul_add(zero, s_12 * zero));
        for &x in response.state.as_ref() {
            check = x.mul_add(zero, check);
        }
        // A law may choose between an old value that is no number and another one.
        for &x in self.own.as_ref() {
            other = x.mul_add(zero, other);
        }
        check = step.jacobian.mul_add(zero, wave_modulus.mul_add(zero, check)) + other;
        if refusal.is_some() {
            check -= response.status; // a code is negative
        }
        let mut not_inverted = zero.lt(step.jacobian);
        if reads.old_gradient {
            let jacobian = determinant(&self.f_old);
            check = jacobian.mul_add(zero, check);
            not_inverted = not_inverted & zero.lt(jacobian);
        }
        (check.le(zero) & not_inverted & self.usable & Failure::intact(self.failed), not_inverted)
    }

    /// Restores the old state where a step has not been taken, with 0 in place of what is not finite, sets the stress
    /// to 0, the wave modulus to that at rest, and the status to the reason: 0 for a point that has failed before.
    #[inline(always)]
    pub fn restore(
        &self,
        outcome: &mut Outcome<R, S>,
        taken: R::Mask,
        not_inverted: R::Mask,
        at_rest: R,
        own_status: R,
        &Description { reads, refusal, .. }: &Description,
    ) {
        let (zero, one) = (R::splat(0.0), R::splat(1.0));
        let code = |status: i32| R::splat(f64::from(status));
        let intact = Failure::intact(self.failed);
        for x in &mut outcome.stress {
            *x = R::select(taken, *x, zero);
        }
        let mut known = (self.failed * zero).le(zero);
        let mut olds = self.own.as_ref().iter();
        for x in outcome.own.as_mut() {
            let Some(&old) = olds.next() else { break };
            let finite = (old * zero).le(zero);
            known = known & finite;
            *x = R::select(taken, *x, R::select(finite, old, zero));
        }
        let latched = R::select(intact, zero, one);
        outcome.failed = R::select(taken, outcome.failed, latched);
        outcome.alive = one - outcome.failed;
        outcome.active = R::select(taken, outcome.alive, zero);
        outcome.wave_modulus = R::select(taken, outcome.wave_modulus, at_rest);
        let mut finite = is_finite(&self.f);
        if reads.old_gradient {
            finite = finite & is_finite(&self.f_old);
        }
        // Later lines take precedence.
        let why = code(status::OVERFLOW);
        let why = if refusal.is_some() { R::select(own_status.lt(zero), own_status, why) } else { why };
        let why = R::select(not_inverted, why, code(status::INVERTED));
        let why = R::select(known, why, code(status::STATE_NOT_FINITE));
        let why = R::select(self.usable, why, code(status::FIBRE_DIRECTION));
        let why = R::select(finite, why, code(status::NOT_FINITE));
        let why = R::select(intact, why, R::select(known, zero, code(status::STATE_NOT_FINITE)));
        outcome.status = R::select(taken, zero, why);
    }
}

/// det F, from vector products that are accurate to a rounding.
#[inline(always)]
fn determinant<R: Real>(f: &Matrix<R>) -> R {
    dot(f[0], accurate_cross(f[1], f[2]))
}

// SAFETY: as many numbers as F at the start has, all that points of such a law may have besides.
unsafe impl<M: UserMaterial, T: Precision> Kernels<T> for User<M, T> {
    const IN_PLACE: bool = false;
    const ALONE: bool = false;
    type Else = [T; 9];

    unsafe fn run(&self, points: &Points<T>) -> i32 {
        let asks_for_derivatives = !points.tangent.is_null() || (!points.wave_speed.is_null() && !self.bounds_waves());
        // SAFETY: the points are valid and checked; `level` is one that the processor has.
        unsafe {
            if asks_for_derivatives { self.with_derivatives(points) } else { self.sweeps(points.level(), points) }
        }
    }
}

impl<M: UserMaterial, T: Precision> User<M, T> {
    /// Whether the law has a bound of its wave speed.
    pub(super) fn bounds_waves(&self) -> bool {
        let law = self.doubled();
        let constants = law.constants::<f64>();
        let rest = Input::at_rest(&law);
        let step = rest.step();
        M::wave_modulus(&constants, &step, &M::respond(&constants, &step)).is_some()
    }

    /// # Safety
    /// As for [`Kernels::run`], on a processor that has the level's instructions.
    unsafe fn sweeps(&self, level: Level, points: &Points<T>) -> i32 {
        let n = points.n;
        let whole = |count: usize, first: usize| n - (n - first) % count;
        // SAFETY: the ranges are points of the block, and whole registers where `sweep` asks for that; the processor
        // has the level's instructions.
        unsafe {
            match level {
                #[cfg(target_arch = "x86_64")]
                Level::Avx2 | Level::Avx512 => {
                    let wide = if level == Level::Avx512 { whole(<T::Avx512 as Lanes<T>>::COUNT, 0) } else { 0 };
                    let worst = if wide > 0 { avx512(self, points, 0..wide) } else { status::OK };
                    if wide < n { worst.min(avx2(self, points, wide..n)) } else { worst }
                }
                _ => {
                    let part = whole(<T::Baseline as Lanes<T>>::COUNT, 0);
                    let worst = sweep::<M, T, T::Baseline>(self, points, 0..part);
                    if part < n { worst.min(sweep::<M, T, T>(self, points, part..n)) } else { worst }
                }
            }
        }
    }
}

/// # Safety
/// As for [`sweep`], on a processor that has these instructions.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
unsafe fn avx512<M: UserMaterial, T: Precision>(law: &User<M, T>, points: &Points<T>, range: Range<usize>) -> i32 {
    // SAFETY: these are the instructions of the lanes.
    unsafe { sweep::<M, T, T::Avx512>(law, points, range) }
}

/// Two registers at a time, since the operations of one wait for one another; then one, and the last points one by one,
/// by the same operations.
///
/// # Safety
/// As for [`sweep`], with any number of points, on a processor that has these instructions.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
unsafe fn avx2<M: UserMaterial, T: Precision>(law: &User<M, T>, points: &Points<T>, range: Range<usize>) -> i32 {
    let Range { start, end } = range;
    let count = <T::Avx2 as Lanes<T>>::COUNT;
    let (pairs, whole) = (end - (end - start) % (2 * count), end - (end - start) % count);
    // SAFETY: each range is whole registers of its type, and these are the instructions of the lanes.
    unsafe {
        let of_pairs =
            if start < pairs { sweep::<M, T, Twice<T::Avx2>>(law, points, start..pairs) } else { status::OK };
        let of_one = if pairs < whole { sweep::<M, T, T::Avx2>(law, points, pairs..whole) } else { status::OK };
        let rest = if whole < end { sweep::<M, T, T::Point>(law, points, whole..end) } else { status::OK };
        of_pairs.min(of_one).min(rest)
    }
}

/// Evaluates the points of a range of the block. Returns the worst status code.
///
/// # Safety
/// As for [`Kernels::run`], with a range of its points whose number is a multiple of COUNT, on a processor that has the
/// lanes' instructions.
#[inline(always)]
unsafe fn sweep<M: UserMaterial, T: Precision, R: Lanes<T>>(
    law: &User<M, T>,
    points: &Points<T>,
    range: Range<usize>,
) -> i32 {
    let constants = law.constants::<R>();
    let mut rest = Input::<R, M::State<R>>::at_rest(law);
    let zero = R::splat(0.0);
    let at_rest = if points.wave_speed.is_null() { zero } else { wave_modulus::<M, R>(&constants, &rest) };
    let Circumstances { time_increment, time, .. } = points.circumstances;
    rest.time_increment = if M::DESCRIPTION.reads.time_increment { R::splat(time_increment) } else { zero };
    rest.time = if M::DESCRIPTION.reads.time { R::splat(time) } else { zero };
    let (mut worst, mut i) = (zero, range.start);
    let states = !points.state_old[0].is_null() && !points.state_new[0].is_null();
    let usual = states && !points.stress[0].is_null() && points.fibre[0].is_null() && points.wave_speed.is_null();
    // SAFETY: the points from i on fill a register.
    unsafe {
        while i < range.end {
            // Most registers have no such point: a loop without what such points need keeps more numbers in registers.
            while usual && i < range.end && register::<M, T, R, true>(&constants, points, &rest, i, at_rest).is_some() {
                i += R::COUNT;
            }
            if i < range.end {
                let codes = register::<M, T, R, false>(&constants, points, &rest, i, at_rest);
                worst = worst.min(codes.unwrap_or(zero));
                i += R::COUNT;
            }
        }
    }
    least_code(worst)
}

/// The bound of the law's wave modulus at a point; 0 for a law that has none.
#[inline(always)]
pub(super) fn wave_modulus<M: UserMaterial, R: Real>(constants: &M::Constants<R>, input: &Input<R, M::State<R>>) -> R {
    let step = input.step();
    M::wave_modulus(constants, &step, &M::respond(constants, &step)).unwrap_or(R::splat(0.0))
}

/// Evaluates the points of a register from `i` on. Returns their status codes. `USUAL`: the block has stress and both
/// states, and neither fibres nor wave speeds; if one of the points has failed before or cannot be evaluated, nothing
/// is stored, and the answer is `None`.
///
/// # Safety
/// As for [`sweep`], for these points.
#[inline(always)]
unsafe fn register<M: UserMaterial, T: Precision, R: Lanes<T>, const USUAL: bool>(
    constants: &M::Constants<R>,
    points: &Points<T>,
    rest: &Input<R, M::State<R>>,
    i: usize,
    at_rest: R,
) -> Option<R> {
    let (law, zero) = (M::DESCRIPTION, R::splat(0.0));
    let next_row = |row: *mut T| row.wrapping_add(points.leading_dimension);
    // SAFETY: the arrays that the block has are valid for these points: the state for a row of each variable.
    unsafe {
        let mut input = *rest;
        input.f = gradient(&points.f_new, i);
        input.f_old = if law.reads.old_gradient { gradient(&points.f_old, i) } else { input.f };
        if !USUAL && !points.fibre[0].is_null() {
            let [x, y, z] = points.fibre;
            let (frame, usable) = FibreFrame::new([R::load(x.add(i)), R::load(y.add(i)), R::load(z.add(i))]);
            input.directions[0] = frame.m;
            input.usable = usable;
        }
        if law.reads.temperature {
            input.temperature = R::load(points.circumstances.temperature.add(i));
        }
        if USUAL || !points.state_old[0].is_null() {
            let mut row = points.state_old[0].wrapping_add(i);
            for x in input.own.as_mut() {
                *x = R::load(row);
                row = next_row(row.cast_mut());
            }
            input.failed = R::load(row);
        }
        let step = input.step();
        let response = M::respond(constants, &step);
        let modulus = if USUAL || points.wave_speed.is_null() {
            zero
        } else {
            M::wave_modulus(constants, &step, &response).unwrap_or(zero)
        };
        let (taken, not_inverted) = input.taken(&step, &response, modulus, &law);
        let mut outcome = Outcome::of(&response, modulus);
        if R::any(!taken) {
            if USUAL {
                return None;
            }
            input.restore(&mut outcome, taken, not_inverted, at_rest, response.status, &law);
        }
        if USUAL || !points.stress[0].is_null() {
            let mut c = 0;
            while c < 6 {
                outcome.stress[c].store(points.stress[c].add(i));
                c += 1;
            }
        }
        if USUAL || !points.state_new[0].is_null() {
            let mut row = points.state_new[0].wrapping_add(i);
            for &x in outcome.own.as_ref() {
                x.store(row);
                row = next_row(row);
            }
            outcome.failed.store(row);
            outcome.alive.store(next_row(row));
        }
        if !USUAL && !points.wave_speed.is_null() {
            let density = R::splat(points.density.into());
            wave_speed(outcome.wave_modulus, density).store(points.wave_speed.add(i));
        }
        if !points.active.is_null() {
            outcome.active.store(points.active.add(i));
        }
        if !points.status.is_null() {
            outcome.status.store_integers(points.status.add(i));
        }
        Some(outcome.status)
    }
}

/// F by columns.
///
/// # Safety
/// The components are valid for the points of a register from `i` on.
#[inline(always)]
unsafe fn gradient<T, R: Lanes<T>>(f: &[*const T; 9], i: usize) -> Matrix<R> {
    // SAFETY: each component has a register of values from i on.
    unsafe {
        [
            [R::load(f[0].add(i)), R::load(f[1].add(i)), R::load(f[2].add(i))],
            [R::load(f[3].add(i)), R::load(f[4].add(i)), R::load(f[5].add(i))],
            [R::load(f[6].add(i)), R::load(f[7].add(i)), R::load(f[8].add(i))],
        ]
    }
}
