//! The kernels in the instructions that every processor of the architecture has.

use core::ops::Range;

use super::copies::padded;
use super::instructions::Instructions;
use super::kernel::sweep;
use super::linear::{LinearPointers, sweep_linear};
use super::pointers::Pointers;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::linear_elastic::LinearElastic;
use crate::law::number::registers::Registers;

pub(super) struct Baseline;

impl Instructions for Baseline {
    type Lanes<T: Registers> = T::Baseline;

    unsafe fn run<T: Registers, const WANT: u8>(law: &Hyperelastic<T>, block: &Pointers<T>) -> i32 {
        // SAFETY: `run` requires of its caller what `sweep` requires.
        unsafe { sweep::<T, T::Baseline, WANT>(law, block) }
    }

    unsafe fn run_padded<T: Registers>(block: &Pointers<T>, run: impl FnOnce(&Pointers<T>) -> i32) -> i32 {
        // SAFETY: `run_padded` requires what `padded` requires.
        unsafe { padded::<T, T::Baseline>(block, run) }
    }

    unsafe fn run_linear<T: Registers>(law: &LinearElastic<T>, block: &LinearPointers<T>, points: Range<usize>) -> i32 {
        // SAFETY: `run_linear` requires what `sweep_linear` requires.
        unsafe { sweep_linear::<T, T::Baseline>(law, block, points) }
    }
}
