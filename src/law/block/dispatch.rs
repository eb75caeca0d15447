//! The choice of kernels for a block: the widest registers first, then narrower ones for the remaining points.

use core::ops::Range;

#[cfg(target_arch = "x86_64")]
use super::avx2::Avx2;
#[cfg(target_arch = "x86_64")]
use super::avx512::Avx512;
use super::baseline::Baseline;
use super::instructions::{BlockInstructions, Instructions};
#[cfg(target_arch = "x86_64")]
use super::one::{One, run_one};
use super::points::{OnePoint, Points};
use super::request::{ALIGNED, ANY, FRICTION};
#[cfg(target_arch = "x86_64")]
use super::request::{EXPLICIT, SHEAR, STATE, STRESS};
#[cfg(not(target_arch = "x86_64"))]
use super::run::evaluate_one;
use super::run::{FRICTIONAL_ROWS, HYPERELASTIC_ROWS, LINEAR_ROWS};
use crate::law::frictional::{Friction, Frictional};
use crate::law::hyperelastic::Hyperelastic;
use crate::law::linear_elastic::LinearElastic;
use crate::law::number::level::Level;
use crate::law::number::real::Lanes;
use crate::law::number::registers::Registers;
use crate::law::prepared::PreparedFrictional;
#[cfg(target_arch = "x86_64")]
use crate::law::response::Request;
#[cfg(target_arch = "x86_64")]
use crate::law::state::part::FAILURE;
use crate::law::status;

/// A precision that the block kernels are built for: f32 or f64.
pub trait Precision: Registers + 'static {
    /// Runs the kernels of the hyperelastic law at a level.
    ///
    /// # Safety
    /// As for [`Law::step`](crate::law::interface::Law::step), with checked points next to each other; the processor
    /// has the level's instructions.
    #[doc(hidden)]
    unsafe fn dispatch(level: Level, law: &Hyperelastic<Self>, block: &Points<Self>) -> i32;

    /// Runs the kernels of the law with friction at a level.
    ///
    /// # Safety
    /// As for [`dispatch`](Self::dispatch).
    #[doc(hidden)]
    unsafe fn dispatch_frictional(level: Level, law: &Frictional<Self>, block: &Points<Self>) -> i32;

    /// Runs the kernel of the law with friction for one point that asks for stress and state alone.
    ///
    /// # Safety
    /// As for [`Law::step`](crate::law::interface::Law::step), of a law without longitudinal shear; the processor has
    /// AVX2 and FMA.
    #[doc(hidden)]
    unsafe fn one_frictional(law: &PreparedFrictional<Self>, point: &OnePoint<Self>) -> i32;

    /// Runs the kernels of the linear elastic law at a level.
    ///
    /// # Safety
    /// As for [`dispatch`](Self::dispatch); the processor has the level's instructions.
    #[doc(hidden)]
    unsafe fn dispatch_linear(level: Level, law: &LinearElastic<Self>, block: &Points<Self>) -> i32;
}

// An impl for each type and not a generic one, so that the kernels are compiled in this crate and not in the crates
// that use it.
impl Precision for f64 {
    unsafe fn dispatch(level: Level, law: &Hyperelastic<f64>, block: &Points<f64>) -> i32 {
        // SAFETY: the same block and level.
        unsafe { dispatch(level, law, block) }
    }

    unsafe fn dispatch_frictional(level: Level, law: &Frictional<f64>, block: &Points<f64>) -> i32 {
        // SAFETY: the same block and level.
        unsafe { dispatch_frictional(level, law, block) }
    }

    unsafe fn one_frictional(law: &PreparedFrictional<f64>, point: &OnePoint<f64>) -> i32 {
        // SAFETY: the same point and processor.
        unsafe { one_frictional(law, point) }
    }

    unsafe fn dispatch_linear(level: Level, law: &LinearElastic<f64>, block: &Points<f64>) -> i32 {
        // SAFETY: the same block and level.
        unsafe { dispatch_linear(level, law, block) }
    }
}

impl Precision for f32 {
    unsafe fn dispatch(level: Level, law: &Hyperelastic<f32>, block: &Points<f32>) -> i32 {
        // SAFETY: the same block and level.
        unsafe { dispatch(level, law, block) }
    }

    unsafe fn dispatch_frictional(level: Level, law: &Frictional<f32>, block: &Points<f32>) -> i32 {
        // SAFETY: the same block and level.
        unsafe { dispatch_frictional(level, law, block) }
    }

    unsafe fn one_frictional(law: &PreparedFrictional<f32>, point: &OnePoint<f32>) -> i32 {
        // SAFETY: the same point and processor.
        unsafe { one_frictional(law, point) }
    }

    unsafe fn dispatch_linear(level: Level, law: &LinearElastic<f32>, block: &Points<f32>) -> i32 {
        // SAFETY: the same block and level.
        unsafe { dispatch_linear(level, law, block) }
    }
}

/// The number of points that a register holds.
fn lanes<T: Registers, I: Instructions>() -> usize {
    <I::Lanes<T> as Lanes<T>>::COUNT
}

/// The points from `first` on that fill whole registers, for a block of `n` points.
fn whole<T: Registers, I: Instructions>(first: usize, n: usize) -> Range<usize> {
    first..n - (n - first) % lanes::<T, I>()
}

/// # Safety
/// As for [`Precision::dispatch`].
unsafe fn dispatch<T: Precision>(level: Level, law: &Hyperelastic<T>, block: &Points<T>) -> i32 {
    // SAFETY: the block is valid, and the processor has the level's instructions; what does not fill a register of them
    // is padded. AVX-512 is chosen for more points than a register holds.
    unsafe {
        match level {
            #[cfg(target_arch = "x86_64")]
            // Two registers of AVX2 take less time than one of AVX-512.
            Level::Avx512 if block.n > lanes::<T, Avx512>() => run::<T, Avx512>(law, block),
            #[cfg(target_arch = "x86_64")]
            Level::Avx512 | Level::Avx2 if block.n >= lanes::<T, Avx2>() => run::<T, Avx2>(law, block),
            #[cfg(target_arch = "x86_64")]
            Level::Avx512 | Level::Avx2 => {
                Avx2::run_padded::<T, Hyperelastic<T>, HYPERELASTIC_ROWS>(block, |points| run::<T, Avx2>(law, points))
            }
            _ if block.n >= lanes::<T, Baseline>() => run_any::<T, Baseline>(law, block),
            _ => Baseline::run_padded::<T, Hyperelastic<T>, HYPERELASTIC_ROWS>(block, |points| {
                run_any::<T, Baseline>(law, points)
            }),
        }
    }
}

/// Runs a kernel that is compiled for one of the usual requests, or else the general kernel.
///
/// # Safety
/// As for [`Precision::dispatch`], for a block that fills a register.
#[cfg(target_arch = "x86_64")]
unsafe fn run<T: Registers, I: Instructions>(law: &Hyperelastic<T>, block: &Points<T>) -> i32 {
    let Request { stress, energies, invariants, failure, wave_modulus, .. } = block.request();
    let usual = stress && block.are_usual();
    let state = usual && energies && invariants && failure;
    let nothing_else = !energies && !invariants && !failure && !wave_modulus;
    let remembers = !block.state_old[FAILURE].is_null() || !block.active.is_null();
    let stress_alone = usual && nothing_else && !remembers && !law.shears;
    let aligned = law.aligned && block.fibre[0].is_null();
    let explicit = wave_modulus || !block.limits(FAILURE).is_null();
    let none = &Friction::none();
    const STRESS_ALIGNED: u8 = STRESS + ALIGNED;
    const STATE_ALIGNED: u8 = STATE + ALIGNED;
    const EXPLICIT_STATE: u8 = EXPLICIT + STATE;
    const EXPLICIT_STATE_ALIGNED: u8 = EXPLICIT + STATE_ALIGNED;
    const SHEAR_STATE: u8 = SHEAR + STATE;
    const SHEAR_STATE_ALIGNED: u8 = SHEAR + STATE_ALIGNED;
    // SAFETY: the block fills a register, and has the arrays of the request that each kernel is compiled for: that is
    // what `state` and `stress_alone` tell.
    unsafe {
        match (law.shears, aligned) {
            (false, true) if state && explicit => I::run::<T, EXPLICIT_STATE_ALIGNED>(law, none, block),
            (false, false) if state && explicit => I::run::<T, EXPLICIT_STATE>(law, none, block),
            (false, true) if state => I::run::<T, STATE_ALIGNED>(law, none, block),
            (false, false) if state => I::run::<T, STATE>(law, none, block),
            (true, true) if state && !wave_modulus => I::run::<T, SHEAR_STATE_ALIGNED>(law, none, block),
            (true, false) if state && !wave_modulus => I::run::<T, SHEAR_STATE>(law, none, block),
            (_, true) if stress_alone => I::run::<T, STRESS_ALIGNED>(law, none, block),
            (_, false) if stress_alone => I::run::<T, STRESS>(law, none, block),
            _ => run_any::<T, I>(law, block),
        }
    }
}

/// Runs the general kernel, which looks up at run time what the block requests.
///
/// # Safety
/// As for [`run`].
unsafe fn run_any<T: Registers, I: Instructions>(law: &Hyperelastic<T>, block: &Points<T>) -> i32 {
    const ANY_ALIGNED: u8 = ANY + ALIGNED;
    // Compared with the tangent, the products with the frame that an aligned fibre saves take little time.
    let aligned = law.aligned && block.fibre[0].is_null() && block.tangent.is_null();
    // SAFETY: the block fills a register, and the general kernel looks up which arrays it has.
    unsafe {
        let none = &Friction::none();
        if aligned { I::run::<T, ANY_ALIGNED>(law, none, block) } else { I::run::<T, ANY>(law, none, block) }
    }
}

/// # Safety
/// As for [`Precision::dispatch_frictional`].
unsafe fn dispatch_frictional<T: Precision>(level: Level, law: &Frictional<T>, block: &Points<T>) -> i32 {
    // SAFETY: as for `dispatch`; `One` has one lane, and gets one point.
    unsafe {
        match level {
            #[cfg(target_arch = "x86_64")]
            Level::Avx512 if block.n > lanes::<T, Avx512>() => run_frictional::<T, Avx512>(law, block),
            #[cfg(target_arch = "x86_64")]
            Level::Avx512 | Level::Avx2 if block.n >= lanes::<T, Avx2>() => run_frictional::<T, Avx2>(law, block),
            #[cfg(target_arch = "x86_64")]
            Level::Avx512 | Level::Avx2 if block.n == 1 => run_frictional::<T, One>(law, block),
            #[cfg(target_arch = "x86_64")]
            Level::Avx512 | Level::Avx2 => Avx2::run_padded::<T, Frictional<T>, FRICTIONAL_ROWS>(block, |points| {
                run_frictional::<T, Avx2>(law, points)
            }),
            _ if block.n >= lanes::<T, Baseline>() => run_any_frictional::<T, Baseline>(law, block),
            _ => Baseline::run_padded::<T, Frictional<T>, FRICTIONAL_ROWS>(block, |points| {
                run_any_frictional::<T, Baseline>(law, points)
            }),
        }
    }
}

/// Runs a kernel of the law with friction that is compiled for what solvers ask in every step, or else the general
/// kernel.
///
/// # Safety
/// As for [`run`].
#[cfg(target_arch = "x86_64")]
unsafe fn run_frictional<T: Registers, I: Instructions>(law: &Frictional<T>, block: &Points<T>) -> i32 {
    let Frictional { elastic, friction } = law;
    let Request { stress, energies, invariants, failure, wave_modulus, .. } = block.request();
    let state = stress && energies && invariants && failure && block.are_usual() && !elastic.shears;
    let explicit = wave_modulus || !block.limits(FAILURE).is_null();
    let aligned = elastic.aligned && block.fibre[0].is_null();
    const SLIP: u8 = FRICTION + STATE;
    const SLIP_ALIGNED: u8 = SLIP + ALIGNED;
    const EXPLICIT_SLIP: u8 = EXPLICIT + SLIP;
    const EXPLICIT_SLIP_ALIGNED: u8 = EXPLICIT + SLIP_ALIGNED;
    // SAFETY: as for `run`.
    unsafe {
        match (explicit, aligned) {
            (true, true) if state => I::run::<T, EXPLICIT_SLIP_ALIGNED>(elastic, friction, block),
            (true, false) if state => I::run::<T, EXPLICIT_SLIP>(elastic, friction, block),
            (false, true) if state => I::run::<T, SLIP_ALIGNED>(elastic, friction, block),
            (false, false) if state => I::run::<T, SLIP>(elastic, friction, block),
            _ => run_any_frictional::<T, I>(law, block),
        }
    }
}

/// # Safety
/// As for [`Precision::one_frictional`].
#[cfg(target_arch = "x86_64")]
unsafe fn one_frictional<T: Precision>(law: &PreparedFrictional<T>, point: &OnePoint<T>) -> i32 {
    const SLIP: u8 = FRICTION + STATE;
    const SLIP_ALIGNED: u8 = SLIP + ALIGNED;
    // SAFETY: the same point and processor.
    unsafe {
        match law.is_aligned() && point.fibre.is_null() {
            true => run_one::<T, SLIP_ALIGNED>(law, point),
            false => run_one::<T, SLIP>(law, point),
        }
    }
}

/// # Safety
/// As for [`Precision::one_frictional`].
#[cfg(not(target_arch = "x86_64"))]
unsafe fn one_frictional<T: Precision>(law: &PreparedFrictional<T>, point: &OnePoint<T>) -> i32 {
    // SAFETY: the same point.
    unsafe { evaluate_one(&law.law(), &point.points()) }
}

/// Runs the general kernel of the law with friction.
///
/// # Safety
/// As for [`run`].
unsafe fn run_any_frictional<T: Registers, I: Instructions>(law: &Frictional<T>, block: &Points<T>) -> i32 {
    const GENERAL: u8 = FRICTION + ANY;
    const GENERAL_ALIGNED: u8 = GENERAL + ALIGNED;
    let Frictional { elastic, friction } = law;
    let aligned = elastic.aligned && block.fibre[0].is_null() && block.tangent.is_null();
    // SAFETY: the block fills a register, and the general kernel looks up which arrays it has.
    unsafe {
        match aligned {
            true => I::run::<T, GENERAL_ALIGNED>(elastic, friction, block),
            false => I::run::<T, GENERAL>(elastic, friction, block),
        }
    }
}

/// # Safety
/// As for [`Precision::dispatch_linear`].
unsafe fn dispatch_linear<T: Precision>(level: Level, law: &LinearElastic<T>, block: &Points<T>) -> i32 {
    let n = block.n;
    // SAFETY: the block is valid, and the processor has the level's instructions; `part` and `wide` are whole
    // registers, and `rest` is fewer points than one holds.
    unsafe {
        match level {
            Level::Baseline => {
                let part = whole::<T, Baseline>(0, n);
                let rest = block.from(part.end);
                let worst = run_linear::<T, Baseline>(law, block, part);
                if rest.n == 0 {
                    return worst;
                }
                worst.min(Baseline::run_padded::<T, LinearElastic<T>, LINEAR_ROWS>(&rest, |points| {
                    run_linear::<T, Baseline>(law, points, 0..points.n)
                }))
            }
            #[cfg(target_arch = "x86_64")]
            Level::Avx2 | Level::Avx512 => {
                let wide = if level == Level::Avx512 { whole::<T, Avx512>(0, n) } else { 0..0 };
                let part = whole::<T, Avx2>(wide.end, n);
                let rest = block.from(part.end);
                let worst = run_linear::<T, Avx512>(law, block, wide).min(run_linear::<T, Avx2>(law, block, part));
                if rest.n == 0 {
                    return worst;
                }
                worst.min(Avx2::run_padded::<T, LinearElastic<T>, LINEAR_ROWS>(&rest, |points| {
                    run_linear::<T, Avx2>(law, points, 0..points.n)
                }))
            }
            #[cfg(not(target_arch = "x86_64"))]
            Level::Avx2 | Level::Avx512 => run_linear::<T, Baseline>(law, block, 0..n),
        }
    }
}

/// Runs the kernel of the linear elastic law; not if there are no points, since the processor may not have the
/// instructions.
///
/// # Safety
/// As for [`Precision::dispatch_linear`], for points of the block that fill whole registers.
unsafe fn run_linear<T: Registers, I: BlockInstructions>(
    law: &LinearElastic<T>,
    block: &Points<T>,
    points: Range<usize>,
) -> i32 {
    if points.is_empty() {
        return status::OK;
    }
    // SAFETY: points of a valid block that fill whole registers: there are some, so that the level has these
    // instructions.
    unsafe { I::run_linear(law, block, points) }
}
