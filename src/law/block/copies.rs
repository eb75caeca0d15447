//! Points copied to a small block of their own, evaluated there, and their results copied back: those that do not fill
//! a register, and those that are not next to each other in memory. They go through the same operations as all others,
//! so that the result of a point does not depend on where it is.

use core::mem::MaybeUninit;
use core::ops::Range;

use super::buffers::{Apart, Padded};
use super::dispatch::Precision;
use super::points::{ALL, FEW, Needs, Points};
use super::run::Kernels;
use crate::law::number::real::{Lanes, Scalar, WIDEST};
use crate::law::status;

/// Memory for the numbers of `COUNT` points of a law: `ROWS` of every law's.
#[repr(C)]
struct Memory<T: Precision, L: Kernels<T>, const COUNT: usize, const ROWS: usize> {
    rows: [[MaybeUninit<T>; COUNT]; ROWS],
    others: [MaybeUninit<L::Else>; COUNT],
    state: [MaybeUninit<L::State>; COUNT],
}

/// How many points that are not next to each other are copied at a time; in double precision with modes or a tangent,
/// which take four times the room; and to how many copies if there are no more than these: all copies are evaluated.
const APART: usize = 32;
const LARGE_APART: usize = 16;
const FEW_APART: usize = 8;

/// Runs the kernels of a law on copies of the points, part by part, and copies the results back. Returns the worst of
/// the status codes.
///
/// # Safety
/// The points are valid, see [`Points`], and checked.
#[inline(never)]
pub(super) unsafe fn in_copies<T: Precision, L: Kernels<T>>(law: &L, points: &Points<T>) -> i32 {
    let few = points.modes.is_null() && points.tangent.is_null();
    let large = !few && size_of::<T>() > size_of::<f32>();
    let (mut worst, apart) = (status::OK, if large { LARGE_APART } else { APART });
    for first in (0..points.n).step_by(apart) {
        let range = first..points.n.min(first + apart);
        // SAFETY: the points are valid, those of the range are one at least and no more than there are copies.
        worst = worst.min(unsafe {
            match (range.len(), few) {
                (0..=FEW_APART, true) => copied::<T, L, FEW_APART, FEW>(law, points, range),
                (0..=FEW_APART, false) => copied::<T, L, FEW_APART, ALL>(law, points, range),
                (_, true) => copied::<T, L, APART, FEW>(law, points, range),
                (_, false) if large => copied::<T, L, LARGE_APART, ALL>(law, points, range),
                (_, false) => copied::<T, L, APART, ALL>(law, points, range),
            }
        });
    }
    worst
}

/// Copies the points of a range, at least one and at most `COUNT`, that have no modes and no tangent if `ROWS` is
/// [`FEW`], runs the law's kernels on the copies and copies the results back. Returns the worst of the status codes.
/// Not inlined, so that the stack has copies of one size alone.
///
/// # Safety
/// The points are valid, see [`Points`], and checked, and those of the range are some of them.
#[inline(never)]
unsafe fn copied<T: Precision, L: Kernels<T>, const COUNT: usize, const ROWS: usize>(
    law: &L,
    points: &Points<T>,
    range: Range<usize>,
) -> i32 {
    let needs = const { &Needs::of::<T, L>() };
    let mut memory = MaybeUninit::<Memory<T, L, COUNT, ROWS>>::uninit();
    let mut codes = [status::OK; COUNT];
    let mut apart = Apart::<T, COUNT>::new(memory.as_mut_ptr().cast(), range);
    // SAFETY: the memory has room for COUNT points of the law with all their numbers, and the indices are those of
    // points of the range.
    unsafe {
        let copies = points.read_into(&mut apart, codes.as_mut_ptr(), needs);
        let worst = law.run(&copies);
        points.take_results(&copies, &apart, needs);
        if !points.status.is_null() {
            for (code, &point) in codes.iter().zip(&apart.indices) {
                *points.status.add(point) = *code;
            }
        }
        worst
    }
}

/// Runs a kernel on copies of all points, at least one and fewer than a register `R` holds; the other lanes repeat the
/// last one. `ROWS` is the number of [`rows`](super::points::rows) of the law. Returns the kernel's result.
///
/// # Safety
/// The points are valid, see [`Points`], and next to each other; the processor has the instructions of `R`.
#[inline(always)]
pub(super) unsafe fn padded<T: Scalar, R: Lanes<T>, const ROWS: usize>(
    points: &Points<T>,
    needs: &Needs,
    run: impl FnOnce(&Points<T>) -> i32,
) -> i32 {
    let mut memory = [const { MaybeUninit::<R>::uninit() }; ROWS];
    let mut codes = [status::OK; WIDEST];
    let mut padded = Padded::<T, R>::new(memory.as_mut_ptr().cast(), points.n);
    // Loops and no closures, which would be called, without the processor's instructions. SAFETY: `memory` has a
    // register for each component of a point, and the valid points are one at least and fewer than a register holds.
    unsafe {
        let copies = points.read_into(&mut padded, codes.as_mut_ptr(), needs);
        let worst = run(&copies);
        points.take_results(&copies, &padded, needs);
        if !points.status.is_null() {
            points.status.copy_from_nonoverlapping(codes.as_ptr(), points.n);
        }
        worst
    }
}
