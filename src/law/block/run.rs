//! The way of points to the kernels of a law: checked, copied where they are not next to each other, their old state in
//! the place of the new one where the kernels want it there.

use core::ptr::{null, null_mut};

use super::copies::in_copies;
use super::dispatch::Precision;
use super::kernel::STAGED;
use super::linear::with_tangents;
use super::points::{Needs, PARTS, Points, Strides, rows};
use crate::law::error::Error;
use crate::law::frictional::Frictional;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::interface::Law;
use crate::law::linear_elastic::{LinearElastic, Rotation};
use crate::law::number::level::Level;
use crate::law::number::real::{Scalar, WIDEST};
use crate::law::state::{FRICTIONAL_STATE, HYPERELASTIC_STATE, LINEAR_ELASTIC_STATE};
use crate::law::status;

/// How many numbers a copy of a point takes.
pub(super) const HYPERELASTIC_ROWS: usize = rows(HYPERELASTIC_STATE, 0);
pub(super) const FRICTIONAL_ROWS: usize = rows(FRICTIONAL_STATE, 0);
pub(super) const LINEAR_ROWS: usize = rows(LINEAR_ELASTIC_STATE, LINEAR_ELSE);

/// F at the start, second axis, axes.
const LINEAR_ELSE: usize = 9 + 3 + 9;

/// The kernels of a law.
///
/// # Safety
/// The numbers of `Else` are at least as many as [`Needs`] says beside what points of every law have.
pub(crate) unsafe trait Kernels<T: Precision>: Law<T> {
    /// Whether they want the old state in the arrays of the new one, or a copy of it there.
    const IN_PLACE: bool;
    /// Whether those of one point above the baseline read its old state wherever it is.
    const ALONE: bool;
    /// An array of the numbers of a point that not every law has, besides state and modes: F at the start, directions,
    /// axes.
    type Else: Copy;

    /// Runs them. Returns the worst of the status codes.
    ///
    /// # Safety
    /// The points are valid, see [`Points`], checked, and next to each other, one at least.
    unsafe fn run(&self, points: &Points<T>) -> i32;
}

// SAFETY: F at the end and a fibre are all that points of this law have.
unsafe impl<T: Precision> Kernels<T> for Hyperelastic<T> {
    const IN_PLACE: bool = true;
    const ALONE: bool = false;
    type Else = [T; 0];

    #[inline(always)]
    unsafe fn run(&self, points: &Points<T>) -> i32 {
        // SAFETY: the points are valid and checked; `level` is one that the processor has.
        unsafe { T::dispatch(points.level(), self, points) }
    }
}

// SAFETY: as of the hyperelastic law.
unsafe impl<T: Precision> Kernels<T> for Frictional<T> {
    const IN_PLACE: bool = true;
    const ALONE: bool = true;
    type Else = [T; 0];

    #[inline(always)]
    unsafe fn run(&self, points: &Points<T>) -> i32 {
        // SAFETY: the points are valid and checked; `level` is one that the processor has.
        unsafe { T::dispatch_frictional(points.level(), self, points) }
    }
}

// SAFETY: as many as F at the start, a second axis and axes.
unsafe impl<T: Precision> Kernels<T> for LinearElastic<T> {
    const IN_PLACE: bool = false;
    const ALONE: bool = false;
    type Else = [T; LINEAR_ELSE];

    unsafe fn run(&self, points: &Points<T>) -> i32 {
        // SAFETY: the points are valid and checked; `level` is one that the processor has.
        unsafe {
            if points.tangent.is_null() {
                T::dispatch_linear(points.level(), self, points)
            } else {
                with_tangents(self, points)
            }
        }
    }
}

impl<T: Scalar> Points<T> {
    /// Whether the old state is in the arrays of the new one, as far as these are requested.
    #[inline(always)]
    fn in_place(&self) -> bool {
        let (mut in_place, mut part) = (true, 0);
        while part < PARTS {
            let (old, new) = (self.state_old[part], self.state_new[part].cast_const());
            in_place &= new.is_null() || old == new;
            part += 1;
        }
        in_place
    }

    /// Whether there is an old state wherever a new one is requested.
    #[inline(always)]
    fn has_old_state(&self) -> bool {
        let (mut has, mut part) = (true, 0);
        while part < PARTS {
            has &= self.state_new[part].is_null() || !self.state_old[part].is_null();
            part += 1;
        }
        has
    }

    /// Copies the old state of one point to the arrays of the new one. The old one stays where it is: kernels that work
    /// in place may read it from either.
    ///
    /// # Safety
    /// The points are valid, there is one, and it has an old state, see [`has_old_state`](Self::has_old_state).
    #[inline(always)]
    pub(super) unsafe fn keep_old_state_of_one(&self, parts: &[usize; PARTS]) {
        // SAFETY: as the caller promises.
        unsafe { keep_old_state(self.state_old, self.state_new, self.leading_dimension, parts) }
    }

    /// Copies the old state, or zeros where there is none, to the arrays of the new one: for kernels that work in
    /// place.
    ///
    /// # Safety
    /// The points are valid and next to each other.
    unsafe fn copy_old_state(&mut self, parts: &[usize; PARTS]) {
        let (n, stride) = (self.n, self.leading_dimension);
        for ((old, &new), &components) in self.state_old.iter_mut().zip(&self.state_new).zip(parts) {
            if new.is_null() || old.cast_mut() == new {
                continue;
            }
            for c in 0..components {
                // SAFETY: of valid points both arrays have the component c, n values from `c * stride` on, and do not
                // overlap if they are not the same. A number whose bytes are all 0 is 0.
                unsafe {
                    match old.is_null() {
                        true => new.add(c * stride).write_bytes(0, n),
                        false => new.add(c * stride).copy_from_nonoverlapping(old.add(c * stride), n),
                    }
                }
            }
            *old = new;
        }
    }
}

/// The copy of [`Points::keep_old_state_of_one`]. It takes the arrays and not the points, which then need not be in
/// memory for it.
///
/// # Safety
/// As there.
#[cold]
#[inline(never)]
unsafe fn keep_old_state<T: Copy>(
    old: [*const T; PARTS],
    new: [*mut T; PARTS],
    leading_dimension: usize,
    parts: &[usize; PARTS],
) {
    for ((old, new), &components) in old.into_iter().zip(new).zip(parts) {
        if new.is_null() || old == new.cast_const() {
            continue;
        }
        for c in 0..components {
            // SAFETY: of a valid point both arrays have the component c.
            unsafe { *new.add(c * leading_dimension) = *old.add(c * leading_dimension) };
        }
    }
}

/// The number of points whose old state is copied at a time: a multiple of the points of a stage in either precision.
const COPIED: usize = 2 * STAGED * WIDEST;

/// Evaluates a law at every point. Returns the worst (most negative) of the status codes.
///
/// # Errors
/// As for [`Law::step`].
///
/// # Safety
/// The points are valid, see [`Points`].
#[inline(always)]
pub(crate) unsafe fn evaluate_points<T: Precision, L: Kernels<T>>(law: &L, points: &Points<T>) -> Result<i32, Error> {
    let needs = const { Needs::of::<T, L>() };
    points.check(&needs)?;
    if points.n == 0 {
        return Ok(status::OK);
    }
    // SAFETY: the points are valid, checked, and at least one.
    unsafe {
        if points.strides != Strides::UNIT {
            return Ok(in_copies(law, points));
        }
        if points.n == 1 {
            return Ok(evaluate_one(law, points));
        }
        if !L::IN_PLACE || points.in_place() {
            return Ok(law.run(points));
        }
        // An old state in other arrays is copied part by part, so that the copy is still in the first-level cache when
        // it is read.
        let mut worst = status::OK;
        for first in (0..points.n).step_by(COPIED) {
            let mut part = points.from(first);
            part.n = part.n.min(COPIED);
            part.copy_old_state(&needs.parts);
            worst = worst.min(law.run(&part));
        }
        Ok(worst)
    }
}

/// Evaluates a law at one point of which [`evaluate_points`] need find out nothing: as it has been checked, or as a
/// host makes it of its own structure for one point. Returns its status code.
///
/// # Safety
/// The points are valid, see [`Points`], with n = 1 and strides of 1, and [`Points::check`] finds nothing wrong.
#[inline(always)]
pub(crate) unsafe fn evaluate_one<T: Precision, L: Kernels<T>>(law: &L, point: &Points<T>) -> i32 {
    let parts = const { &Needs::of::<T, L>().parts };
    // SAFETY: as the caller promises.
    unsafe {
        if L::IN_PLACE && !point.in_place() {
            if !point.has_old_state() {
                let mut fresh = *point;
                fresh.copy_old_state(parts);
                return law.run(&fresh);
            }
            if !L::ALONE || point.level() == Level::Baseline {
                point.keep_old_state_of_one(parts);
            }
        }
        law.run(point)
    }
}

/// The number of points that are evaluated again at a time to find one at fault.
const SEARCHED: usize = 32;

/// The first of the points, which have been evaluated, that has this status code; `None` if that can no longer be told:
/// nothing is stored, and what depends on the old state, on axes that have been turned, or on the size of a result is
/// not seen.
///
/// # Safety
/// As for [`evaluate_points`], for the same points, after it.
pub(crate) unsafe fn at_fault<T: Precision, L: Kernels<T>>(law: &L, points: &Points<T>, code: i32) -> Option<usize> {
    let needs = Needs::of::<T, L>();
    if points.rotation == Rotation::Spin || [status::STATE_NOT_FINITE, status::OVERFLOW].contains(&code) {
        return None;
    }
    if code == status::LIMIT {
        // SAFETY: the points are valid, and some point has an unusable limit, so that there are limits.
        return (0..points.n).find(|&i| unsafe { points.has_wrong_limit(i, &needs) });
    }
    for first in (0..points.n).step_by(SEARCHED) {
        let mut codes = [status::OK; SEARCHED];
        let part = Points { status: codes.as_mut_ptr(), ..points.inputs(first, SEARCHED, &needs) };
        // SAFETY: some of valid points, with some of their inputs and a code for each of them.
        if unsafe { evaluate_points(law, &part) } == Ok(code) {
            return codes.iter().position(|&found| found == code).map(|i| first + i);
        }
    }
    None
}

impl<T: Precision> LinearElastic<T> {
    /// The points without the arrays that the frame does not need, which are not read.
    ///
    /// # Errors
    /// Null axes for [`Rotation::Spin`].
    pub(crate) fn in_frame(points: &Points<T>) -> Result<Points<T>, Error> {
        match points.rotation {
            Rotation::Spin if points.n > 0 && points.axes.is_null() => Err(Error::Null { name: "axes" }),
            Rotation::Spin => Ok(Points { fibre: [null(); 3], second_axis: [null(); 3], ..*points }),
            Rotation::Fibre | Rotation::Polar => Ok(Points { axes: null_mut(), ..*points }),
        }
    }
}
