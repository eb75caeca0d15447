//! The kernels in AVX2 with fused multiply-add.

use core::ops::Range;

use super::copies::padded;
use super::instructions::Instructions;
use super::kernel::sweep;
use super::linear::{LinearPointers, sweep_linear};
use super::pointers::Pointers;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::linear_elastic::LinearElastic;
use crate::law::number::registers::Registers;

pub(super) struct Avx2;

impl Instructions for Avx2 {
    type Lanes<T: Registers> = T::Avx2;

    #[target_feature(enable = "avx2,fma")]
    unsafe fn run<T: Registers, const WANT: u8>(law: &Hyperelastic<T>, block: &Pointers<T>) -> i32 {
        // SAFETY: `run` requires of its caller what `sweep` requires.
        unsafe { sweep::<T, T::Avx2, WANT>(law, block) }
    }

    #[target_feature(enable = "avx2,fma")]
    unsafe fn run_padded<T: Registers>(block: &Pointers<T>, run: impl FnOnce(&Pointers<T>) -> i32) -> i32 {
        // SAFETY: `run_padded` requires what `padded` requires.
        unsafe { padded::<T, T::Avx2>(block, run) }
    }

    #[target_feature(enable = "avx2,fma")]
    unsafe fn run_linear<T: Registers>(law: &LinearElastic<T>, block: &LinearPointers<T>, points: Range<usize>) -> i32 {
        // SAFETY: `run_linear` requires what `sweep_linear` requires.
        unsafe { sweep_linear::<T, T::Avx2>(law, block, points) }
    }
}
