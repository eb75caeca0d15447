//! The linear elastic law at many points at once, over component-major arrays as the yarn law's block.
//!
//! | array | components |
//! |---|---|
//! | `f_old`, `f_new` | F11 F21 F31 F12 F22 F32 F13 F23 F33 (columns of F) at both ends of the step |
//! | `axes` | the three material axes in space, one after the other, in and out; for [`Rotation::Spin`] only |
//! | `state_old`, `state_new` | the rows of [`state::LINEAR_ELASTIC`](crate::law::state::LINEAR_ELASTIC) |
//! | `stress` | σ11 σ22 σ33 σ12 σ23 σ31 (Cauchy) |

use super::{Lanes, LeftOver, Level, Precision, leading_dimension_below, least_code};
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

macro_rules! linear_precision {
    ($t:ident: $baseline:ty, $avx2:ty, $avx512:ty) => {
        impl LinearPrecision for $t {
            unsafe fn dispatch_linear(level: Level, law: &LinearElastic<$t>, block: &LinearPointers<$t>) -> i32 {
                #[cfg_attr(target_arch = "x86_64", target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma"))]
                unsafe fn avx512(law: &LinearElastic<$t>, block: &LinearPointers<$t>) -> i32 {
                    // SAFETY: the caller's promise.
                    unsafe { sweep::<$t, $avx512>(law, block) }
                }
                #[cfg_attr(target_arch = "x86_64", target_feature(enable = "avx2,fma"))]
                unsafe fn avx2(law: &LinearElastic<$t>, block: &LinearPointers<$t>) -> i32 {
                    // SAFETY: the caller's promise.
                    unsafe { sweep::<$t, $avx2>(law, block) }
                }
                // SAFETY: the caller has found the instructions.
                unsafe {
                    match level {
                        Level::Avx512 => avx512(law, block),
                        Level::Avx2 => avx2(law, block),
                        Level::Baseline => sweep::<$t, $baseline>(law, block),
                    }
                }
            }
        }
    };
}
#[cfg(target_arch = "x86_64")]
linear_precision!(f64: super::x86::F64x2, super::x86::F64x4, super::x86::F64x8);
#[cfg(target_arch = "x86_64")]
linear_precision!(f32: super::x86::F32x4, super::x86::F32x8, super::x86::F32x16);
#[cfg(not(target_arch = "x86_64"))]
linear_precision!(f64: f64, f64, f64);
#[cfg(not(target_arch = "x86_64"))]
linear_precision!(f32: f32, f32, f32);

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

/// The kernel: full lanes in the arrays themselves, then what is left in arrays of its own, by the same code.
///
/// # Safety
/// As for [`LinearElastic::raw_block`], on a processor that has the lanes' instructions.
#[inline(always)]
unsafe fn sweep<T: Precision, R: Lanes<T>>(law: &LinearElastic<T>, block: &LinearPointers<T>) -> i32 {
    let lanes = law.lanes::<R>();
    let mut worst = R::splat(0.0);
    let mut left_over = LeftOver::new();
    let mut part = LinearPointers { n: block.n - block.n % R::COUNT, ..*block };
    loop {
        let mut i = 0;
        while i < part.n {
            // SAFETY: i + COUNT ≤ n, and the caller's promise.
            let code = unsafe { evaluate(&lanes, &part, i) };
            worst = worst.min(code);
            i += R::COUNT;
        }
        if left_over.count > 0 {
            // SAFETY: the caller's promise.
            unsafe { put(&mut left_over, block) };
            break;
        }
        if part.n == block.n {
            break;
        }
        // SAFETY: the caller's promise.
        part = unsafe { fetch(&mut left_over, block, part.n, R::COUNT) };
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

/// Where the components stand in the copy of what is left over; the state and the axes are evaluated in place.
const F_NEW_ROW: usize = 9;
const AXES_ROW: usize = 18;
const STATE_ROW: usize = 27;
const STRESS_ROW: usize = STATE_ROW + LINEAR_ELASTIC_STATE;

/// Copies the inputs of the points from `first` on, and hands out the copy as a block of `lanes` points.
///
/// # Safety
/// As for [`sweep`], with first < n and n − first < lanes ≤ WIDEST.
#[inline(never)]
unsafe fn fetch<T: Precision>(
    copy: &mut LeftOver<T>,
    block: &LinearPointers<T>,
    first: usize,
    lanes: usize,
) -> LinearPointers<T> {
    (copy.first, copy.count, copy.lanes) = (first, block.n - first, lanes);
    let inputs = [
        (block.f_old, 0, 9),
        (block.f_new, F_NEW_ROW, 9),
        (block.axes.cast_const(), AXES_ROW, 9),
        (block.state_old, STATE_ROW, LINEAR_ELASTIC_STATE),
    ];
    for (array, row, components) in inputs {
        for c in 0..components {
            // SAFETY: the caller's promise.
            unsafe { copy.fetch_row(row + c, super::component(array, c, block.leading_dimension)) };
        }
    }
    // Null stays null. All pointers come from one: a second borrow of the copy would end the first one's.
    let rows = copy.row(0);
    let place = |present: *const T, row: usize| match present.is_null() {
        true => core::ptr::null_mut(),
        false => rows.wrapping_add(row * lanes),
    };
    LinearPointers {
        n: lanes,
        leading_dimension: lanes,
        f_old: place(block.f_old, 0),
        f_new: place(block.f_new, F_NEW_ROW),
        axes: place(block.axes, AXES_ROW),
        state_old: place(block.state_old, STATE_ROW),
        state_new: place(block.state_new, STATE_ROW),
        stress: place(block.stress, STRESS_ROW),
        status: if block.status.is_null() { block.status } else { copy.codes.as_mut_ptr() },
        ..*block
    }
}

/// Copies the outputs back.
///
/// # Safety
/// As for [`fetch`], which has been called.
#[inline(never)]
unsafe fn put<T: Precision>(copy: &mut LeftOver<T>, block: &LinearPointers<T>) {
    let outputs =
        [(block.axes, AXES_ROW, 9), (block.state_new, STATE_ROW, LINEAR_ELASTIC_STATE), (block.stress, STRESS_ROW, 6)];
    for (array, row, components) in outputs {
        for c in 0..components {
            let to = super::component(array, c, block.leading_dimension).cast_mut();
            // SAFETY: the caller's promise.
            unsafe { copy.put_row(to, row + c) };
        }
    }
    if !block.status.is_null() {
        for (j, &code) in copy.codes.iter().take(copy.count).enumerate() {
            // SAFETY: the caller's promise.
            unsafe { *block.status.add(copy.first + j) = code };
        }
    }
}
