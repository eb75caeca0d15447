//! The kernels in AVX2 with fused multiply-add.

use core::ops::Range;

use super::copies::padded;
use super::dispatch::Precision;
use super::instructions::{BlockInstructions, Instructions};
use super::kernel::sweep;
use super::linear::sweep_linear;
use super::points::{Needs, Points};
use crate::law::frictional::Friction;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::interface::Law;
use crate::law::linear_elastic::LinearElastic;
use crate::law::number::registers::Registers;

pub(super) struct Avx2;

impl Instructions for Avx2 {
    type Lanes<T: Registers> = T::Avx2;

    #[target_feature(enable = "avx2,fma")]
    unsafe fn run<T: Registers, const WANT: u8>(
        law: &Hyperelastic<T>,
        friction: &Friction<T>,
        block: &Points<T>,
    ) -> i32 {
        // SAFETY: `run` requires of its caller what `sweep` requires.
        unsafe { sweep::<T, T::Avx2, WANT>(law, friction, block) }
    }
}

impl BlockInstructions for Avx2 {
    #[target_feature(enable = "avx2,fma")]
    unsafe fn run_padded<T: Precision, L: Law<T>, const ROWS: usize>(
        points: &Points<T>,
        run: impl FnOnce(&Points<T>) -> i32,
    ) -> i32 {
        // SAFETY: `run_padded` requires what `padded` requires.
        unsafe { padded::<T, T::Avx2, ROWS>(points, const { &Needs::of::<T, L>() }, run) }
    }

    #[target_feature(enable = "avx2,fma")]
    unsafe fn run_linear<T: Registers>(law: &LinearElastic<T>, block: &Points<T>, points: Range<usize>) -> i32 {
        // SAFETY: `run_linear` requires what `sweep_linear` requires.
        unsafe { sweep_linear::<T, T::Avx2>(law, block, points) }
    }
}
