//! The requests that a kernel is compiled for, so that its loops contain no branches about them: sums of these flags.

use super::points::{PARTS, Points};
use crate::law::hyperelastic::Hyperelastic;
use crate::law::number::real::Real;
use crate::law::response::Request;
use crate::law::state::{FRICTIONAL_PARTS, HYPERELASTIC_PARTS};

/// The stress alone; the other flags are added to this.
#[cfg_attr(not(target_arch = "x86_64"), allow(dead_code))]
pub(super) const STRESS: u8 = 0;
/// Energies, invariants, failure and the latch as well.
pub(super) const STATE: u8 = 1;
/// The fibre direction of the properties is the first axis, and no point has a direction of its own.
pub(super) const ALIGNED: u8 = 2;
/// All that the block has arrays for and, if the law has one, longitudinal shear: the kernel looks these up at run time
/// for each group of registers.
pub(super) const ANY: u8 = 4;
/// Longitudinal shear, compiled with the state alone: it is rarely used.
pub(super) const SHEAR: u8 = 8;
/// The law with friction between the fibres. The last part of its state begins with four variables of its own.
pub(super) const FRICTION: u8 = 16;
/// What explicit solvers ask beside the state, where the block has it: the wave speed, and failure limits of the
/// points.
pub(super) const EXPLICIT: u8 = 32;
pub(super) const LOST: usize = 0;
pub(super) const I_TE: usize = 1;
pub(super) const SLIP: usize = 2;

/// The place of the failure index in the last part of the state, before latch and flag.
pub(super) const fn index_row<const WANT: u8>() -> usize {
    if WANT & FRICTION != 0 { 4 } else { 0 }
}

/// The number of state variables in each part.
pub(super) const fn parts<const WANT: u8>() -> &'static [usize; PARTS] {
    if WANT & FRICTION != 0 { &FRICTIONAL_PARTS } else { &HYPERELASTIC_PARTS }
}

/// Whether the law has a longitudinal shear stiffness and the kernel is compiled for it.
#[inline(always)]
pub(super) fn shears<R: Real, const WANT: u8>(law: &Hyperelastic<R>) -> bool {
    WANT & SHEAR != 0 || (WANT & ANY != 0 && law.shears)
}

/// The results that are requested of a kernel.
#[inline(always)]
pub(super) fn request<T, const WANT: u8>(block: &Points<T>) -> Request {
    if const { WANT & ANY != 0 } {
        return block.request();
    }
    let state = WANT & STATE != 0;
    Request {
        stress: true,
        energies: state,
        invariants: state,
        failure: state,
        wave_modulus: WANT & EXPLICIT != 0 && !block.wave_speed.is_null(),
        ..Request::NOTHING
    }
}

/// Whether a kernel computes the tangent where the block has an array for it: the general one without an aligned fibre.
pub(super) const fn has_tangent<const WANT: u8>() -> bool {
    WANT & ANY != 0 && WANT & ALIGNED == 0
}
