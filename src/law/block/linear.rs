//! The linear elastic law at many points at once, over component-major arrays as the yarn law's block.
//!
//! | array | components |
//! |---|---|
//! | `f_old`, `f_new` | F11 F21 F31 F12 F22 F32 F13 F23 F33 (columns of F) at both ends of the step |
//! | `axes` | the three material axes in space, one after the other, in and out; for [`Rotation::Spin`] only |
//! | `state_old`, `state_new` | the rows of [`state::LINEAR_ELASTIC`](crate::law::state::LINEAR_ELASTIC) |
//! | `stress` | σ11 σ22 σ33 σ12 σ23 σ31 (Cauchy) |

use core::ops::Range;

use super::{Lanes, Level, Precision, leading_dimension_below, least_code};
use crate::law::linear_elastic::{Criterion, LinearElastic, Rotation, Wanted};
use crate::law::matrix::Matrix;
use crate::law::state::LINEAR_ELASTIC_STATE;
use crate::law::status::{self, Error};

/// A block as a host passes it. Null is left out: an old state that is null is a fresh one, an output not wanted.
#[derive(Clone, Copy, Debug)]
pub struct LinearPointers<T> {
    pub n: usize,
    pub leading_dimension: usize,
    pub f_old: *const T,
    pub f_new: *const T,
    pub axes: *mut T,
    pub state_old: *const T,
    pub state_new: *mut T,
    pub stress: *mut T,
    pub status: *mut i32,
    pub rotation: Rotation,
    pub criterion: Criterion,
    /// The instructions to use, no better than the processor has; `None`: the best.
    pub level: Option<Level>,
}

/// A precision that the linear elastic law's kernel is built for.
pub trait LinearPrecision: Precision {
    /// Runs the kernel at a level.
    ///
    /// # Safety
    /// As for [`LinearElastic::raw_block`]; the processor has the level's instructions.
    unsafe fn dispatch_linear(level: Level, law: &LinearElastic<Self>, block: &LinearPointers<Self>) -> i32;
}

/// A kernel for some lanes, with the instructions that they need.
macro_rules! kernel {
    ($(#[$features:meta])? $name:ident, $t:ty, $lanes:ty) => {
        $(#[$features])?
        unsafe fn $name(law: &LinearElastic<$t>, block: &LinearPointers<$t>, points: Range<usize>) -> i32 {
            // SAFETY: the caller's promise.
            unsafe { sweep::<$t, $lanes>(law, block, points) }
        }
    };
}

macro_rules! linear_precision {
    ($t:ident: $baseline:ty, $avx2:ty, $avx512:ty, $one:ty) => {
        impl LinearPrecision for $t {
            unsafe fn dispatch_linear(level: Level, law: &LinearElastic<$t>, block: &LinearPointers<$t>) -> i32 {
                kernel!(
                    #[cfg_attr(target_arch = "x86_64", target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma"))]
                    avx512,
                    $t,
                    $avx512
                );
                kernel!(
                    #[cfg_attr(target_arch = "x86_64", target_feature(enable = "avx2,fma"))]
                    avx2,
                    $t,
                    $avx2
                );
                kernel!(
                    #[cfg_attr(target_arch = "x86_64", target_feature(enable = "avx2,fma"))]
                    one,
                    $t,
                    $one
                );
                kernel!(baseline, $t, $baseline);
                kernel!(scalar, $t, $t);
                // What fills no register goes to narrower ones, which give the same bits.
                let n = block.n;
                let whole = |lanes: usize| n - n % lanes;
                let fours = whole(<$avx2 as Lanes<$t>>::COUNT);
                // SAFETY: the caller has found the instructions, and answers for the arrays.
                unsafe {
                    match level {
                        Level::Baseline => {
                            let pairs = whole(<$baseline as Lanes<$t>>::COUNT);
                            baseline(law, block, 0..pairs).min(scalar(law, block, pairs..n))
                        }
                        Level::Avx2 => avx2(law, block, 0..fours).min(one(law, block, fours..n)),
                        Level::Avx512 => {
                            let wide = whole(<$avx512 as Lanes<$t>>::COUNT);
                            let rest = avx2(law, block, wide..fours).min(one(law, block, fours..n));
                            avx512(law, block, 0..wide).min(rest)
                        }
                    }
                }
            }
        }
    };
}

#[cfg(target_arch = "x86_64")]
linear_precision!(f64: super::x86::F64x2, super::x86::F64x4, super::x86::F64x8, super::x86::F64x1);
#[cfg(target_arch = "x86_64")]
linear_precision!(f32: super::x86::F32x4, super::x86::F32x8, super::x86::F32x16, super::x86::F32x1);
#[cfg(not(target_arch = "x86_64"))]
linear_precision!(f64: f64, f64, f64, f64);
#[cfg(not(target_arch = "x86_64"))]
linear_precision!(f32: f32, f32, f32, f32);

impl<T: LinearPrecision> LinearElastic<T> {
    /// The law over a step at every point of a block of raw arrays; returns the worst (most negative) of their status codes.
    ///
    /// # Errors
    /// A null deformation gradient, null axes for the spin, a leading dimension below n.
    ///
    /// # Safety
    /// Every pointer that is not null points to as many values as the block's size and the table above say, valid for
    /// reading or writing; outputs overlap nothing but, exactly, the old state they replace.
    pub unsafe fn raw_block(&self, block: &LinearPointers<T>) -> Result<i32, Error> {
        if block.n == 0 {
            return Ok(status::OK);
        }
        let spin = block.rotation == Rotation::Spin;
        if block.f_old.is_null() || block.f_new.is_null() || (spin && block.axes.is_null()) {
            return Err(Error::Plain(status::NULL_ARGUMENT));
        }
        if block.leading_dimension < block.n {
            return Err(leading_dimension_below(block.n, block.leading_dimension));
        }
        let level = block.level.unwrap_or_else(Level::best).min(Level::best());
        let axes = if spin { block.axes } else { core::ptr::null_mut() };
        // SAFETY: the caller answers for the arrays, and the processor has the level's instructions.
        Ok(unsafe { T::dispatch_linear(level, self, &LinearPointers { axes, ..*block }) })
    }
}

/// The kernel, for points that fill whole registers.
///
/// # Safety
/// As for [`LinearElastic::raw_block`], on a processor that has the lanes' instructions, for points of the block whose number is
/// a multiple of COUNT.
#[inline(always)]
unsafe fn sweep<T: Precision, R: Lanes<T>>(
    law: &LinearElastic<T>,
    block: &LinearPointers<T>,
    points: Range<usize>,
) -> i32 {
    let mut worst = R::splat(0.0);
    if points.is_empty() {
        return status::OK;
    }
    let lanes = law.lanes::<R>();
    let mut i = points.start;
    while i < points.end {
        // SAFETY: i + COUNT ≤ the end, and the caller's promise.
        worst = worst.min(unsafe { evaluate(&lanes, block, i) });
        i += R::COUNT;
    }
    least_code(worst)
}

/// Evaluates the points of a register from `i` on; returns their codes.
///
/// # Safety
/// As for [`sweep`], with i + COUNT ≤ n.
#[inline(always)]
unsafe fn evaluate<T: Precision, R: Lanes<T>>(law: &LinearElastic<R>, block: &LinearPointers<T>, i: usize) -> R {
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

/// # Safety
/// The array has nine components, and the lanes from i on.
#[inline(always)]
unsafe fn columns<T, R: Lanes<T>>(array: *const T, stride: usize, i: usize) -> Matrix<R> {
    // SAFETY: the caller's promise.
    let entry = |c: usize| unsafe { R::load(array.add(c * stride + i)) };
    [[entry(0), entry(1), entry(2)], [entry(3), entry(4), entry(5)], [entry(6), entry(7), entry(8)]]
}

/// # Safety
/// The array is null or has a component for each value, and the lanes from i on.
#[inline(always)]
unsafe fn store<T, R: Lanes<T>>(values: &[R], array: *mut T, stride: usize, i: usize) {
    if !array.is_null() {
        for (c, value) in values.iter().enumerate() {
            // SAFETY: the caller's promise.
            unsafe { value.store(array.add(c * stride + i)) };
        }
    }
}
