//! The kernels for one point, in AVX2 with fused multiply-add: no lane is filled up with copies.

use super::instructions::Instructions;
use super::kernel::sweep;
use super::points::Points;
use crate::law::frictional::Friction;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::number::registers::Registers;

pub(super) struct One;

impl Instructions for One {
    type Lanes<T: Registers> = T::Point;

    #[target_feature(enable = "avx2,fma")]
    unsafe fn run<T: Registers, const WANT: u8>(
        law: &Hyperelastic<T>,
        friction: &Friction<T>,
        block: &Points<T>,
    ) -> i32 {
        // SAFETY: `run` requires of its caller what `sweep` requires.
        unsafe { sweep::<T, T::Point, WANT>(law, friction, block) }
    }
}
