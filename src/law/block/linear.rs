//! The linear elastic law at many points at once, over component-major arrays as for the yarn law.
//!
//! | array | components |
//! |---|---|
//! | `f_old`, `f_new` | F11 F21 F31 F12 F22 F32 F13 F23 F33 (columns of F) at both ends of the step |
//! | `axes` | the three material axes in space, one after the other, in and out; for [`Rotation::Spin`] only |
//! | `state_old`, `state_new` | the rows of [`state::LINEAR_ELASTIC`](crate::law::state::LINEAR_ELASTIC) |
//! | `stress` | σ11 σ22 σ33 σ12 σ23 σ31 (Cauchy) |

use core::ops::Range;

use super::kernel::least_code;
use crate::law::linear_elastic::{Criterion, LinearElastic, Rotation, Wanted};
use crate::law::number::level::Level;
use crate::law::number::real::{Lanes, Scalar};
use crate::law::number::vector::Matrix;
use crate::law::state::LINEAR_ELASTIC_STATE;

/// A block as a host passes it. A null array is absent: a null old state stands for a fresh one (all 0), and an output that is
/// null is not computed.
#[derive(Clone, Copy, Debug)]
pub struct LinearPointers<T> {
    /// The number of points; and the leading dimension of all arrays, at least `n`.
    pub n: usize,
    pub leading_dimension: usize,
    pub f_old: *const T,
    pub f_new: *const T,
    pub axes: *mut T,
    pub state_old: *const T,
    pub state_new: *mut T,
    pub stress: *mut T,
    /// A status code for each point.
    pub status: *mut i32,
    pub rotation: Rotation,
    pub criterion: Criterion,
    /// The instructions to use, or the best that the processor has if those are lower; `None` for the best.
    pub level: Option<Level>,
}

/// The kernel, for points that fill whole registers. Returns the worst status code.
///
/// # Safety
/// As for [`LinearElastic::raw_block`], on a processor that has the lanes' instructions, for points of the block whose number is
/// a multiple of COUNT.
#[inline(always)]
pub(super) unsafe fn sweep_linear<T: Scalar, R: Lanes<T>>(
    law: &LinearElastic<T>,
    block: &LinearPointers<T>,
    points: Range<usize>,
) -> i32 {
    let lanes = law.lanes::<R>();
    let mut worst = R::splat(0.0);
    let mut i = points.start;
    while i < points.end {
        // SAFETY: i + COUNT ≤ the end, and the caller's promise.
        worst = worst.min(unsafe { evaluate(&lanes, block, i) });
        i += R::COUNT;
    }
    least_code(worst)
}

/// Evaluates the points of one register from `i` on. Returns their status codes.
///
/// # Safety
/// As for [`sweep_linear`], with i + COUNT ≤ n.
#[inline(always)]
unsafe fn evaluate<T: Scalar, R: Lanes<T>>(law: &LinearElastic<R>, block: &LinearPointers<T>, i: usize) -> R {
    let stride = block.leading_dimension;
    let wanted = Wanted { stress: !block.stress.is_null(), state: !block.state_new.is_null() };
    // SAFETY: the arrays that the block has are valid for the lanes from i on.
    unsafe {
        let (f0, f1) = (columns(block.f_old, stride, i), columns(block.f_new, stride, i));
        let axes = if block.axes.is_null() { f0 } else { columns(block.axes, stride, i) };
        let mut old = [R::splat(0.0); LINEAR_ELASTIC_STATE];
        if !block.state_old.is_null() {
            for (c, value) in old.iter_mut().enumerate() {
                *value = R::load(block.state_old.add(c * stride + i));
            }
        }
        let answer = law.respond(&f0, &f1, &axes, &old, block.rotation, block.criterion, wanted);
        store(&answer.stress, block.stress, stride, i);
        store(&answer.state, block.state_new, stride, i);
        store(answer.q1.as_flattened(), block.axes, stride, i);
        if !block.status.is_null() {
            answer.status.store_integers(block.status.add(i));
        }
        answer.status
    }
}

/// Loads a matrix by columns.
///
/// # Safety
/// `array` is valid for nine components of the lanes from i on.
#[inline(always)]
unsafe fn columns<T, R: Lanes<T>>(array: *const T, stride: usize, i: usize) -> Matrix<R> {
    // SAFETY: the caller's promise.
    let entry = |c: usize| unsafe { R::load(array.add(c * stride + i)) };
    [[entry(0), entry(1), entry(2)], [entry(3), entry(4), entry(5)], [entry(6), entry(7), entry(8)]]
}

/// Stores the components of an array that is requested.
///
/// # Safety
/// `array` is null, or valid for a component for each value, in the lanes from i on.
#[inline(always)]
unsafe fn store<T, R: Lanes<T>>(values: &[R], array: *mut T, stride: usize, i: usize) {
    if !array.is_null() {
        for (c, value) in values.iter().enumerate() {
            // SAFETY: the caller's promise.
            unsafe { value.store(array.add(c * stride + i)) };
        }
    }
}
