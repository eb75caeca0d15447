//! The kernels for one point, in AVX2 with fused multiply-add: no lane is filled up with copies.

use super::instructions::Instructions;
use super::kernel::sweep;
use super::points::{OnePoint, Points};
use crate::law::frictional::Friction;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::number::registers::Registers;
use crate::law::prepared::PreparedFrictional;

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

/// The kernel of the law with friction for one point as a caller has it: neither the law nor the structure of points
/// is made in memory.
///
/// # Safety
/// As for [`sweep`], of a point that has what `WANT` requests; the processor has the instructions.
#[target_feature(enable = "avx2,fma")]
pub(super) unsafe fn run_one<T: Registers, const WANT: u8>(law: &PreparedFrictional<T>, point: &OnePoint<T>) -> i32 {
    let law = law.law();
    // SAFETY: as the caller promises.
    unsafe { sweep::<T, T::Point, WANT>(&law.elastic, &law.friction, &point.points()) }
}
