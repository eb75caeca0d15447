//! The sets of instructions that blocks are evaluated with: registers, and the kernels compiled for them. Each set has
//! a file of its own, so that the compiler builds them in parallel.

use core::ops::Range;

use super::dispatch::Precision;
use super::points::Points;
use crate::law::frictional::Friction;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::interface::Law;
use crate::law::linear_elastic::LinearElastic;
use crate::law::number::real::Lanes;
use crate::law::number::registers::Registers;

/// A set of instructions.
pub(super) trait Instructions {
    /// The widest registers of these instructions.
    type Lanes<T: Registers>: Lanes<T>;

    /// The kernel of the hyperelastic law that is built for `WANT`, see [`kernel`](super::kernel).
    ///
    /// # Safety
    /// As for [`sweep`](super::kernel::sweep), on a processor that has the instructions.
    unsafe fn run<T: Registers, const WANT: u8>(
        law: &Hyperelastic<T>,
        friction: &Friction<T>,
        block: &Points<T>,
    ) -> i32;
}

/// Instructions for blocks of any number of points and for every law.
pub(super) trait BlockInstructions: Instructions {
    /// Runs a kernel of a law on copies of points that do not fill a register.
    ///
    /// # Safety
    /// As for [`padded`](super::copies::padded), on a processor that has the instructions.
    unsafe fn run_padded<T: Precision, L: Law<T>, const ROWS: usize>(
        points: &Points<T>,
        run: impl FnOnce(&Points<T>) -> i32,
    ) -> i32;

    /// The kernel of the linear elastic law.
    ///
    /// # Safety
    /// As for [`sweep_linear`](super::linear::sweep_linear), on a processor that has the instructions.
    unsafe fn run_linear<T: Registers>(law: &LinearElastic<T>, block: &Points<T>, points: Range<usize>) -> i32;
}
