//! Which registers a precision is computed in.

use super::real::{Lanes, Scalar, Single};
#[cfg(target_arch = "x86_64")]
use super::x86;

/// The registers of a precision, for points side by side at each level of instructions, and for a single one.
pub trait Registers: Scalar {
    /// Of every processor of the architecture.
    type Baseline: Lanes<Self>;
    /// AVX2 with fused multiply-add.
    #[cfg(target_arch = "x86_64")]
    type Avx2: Lanes<Self>;
    #[cfg(target_arch = "x86_64")]
    type Avx512: Lanes<Self>;
    /// One point in the operations of `Avx2`.
    #[cfg(target_arch = "x86_64")]
    type One: Single<Self> + Lanes<Self>;
    /// One point in the shortest chain of operations, AVX2 with fused multiply-add.
    #[cfg(target_arch = "x86_64")]
    type Point: Single<Self> + Lanes<Self>;
}

#[cfg(target_arch = "x86_64")]
impl Registers for f64 {
    type Baseline = x86::F64x2;
    type Avx2 = x86::F64x4;
    type Avx512 = x86::F64x8;
    type One = x86::F64x1;
    type Point = x86::F64Point;
}

#[cfg(target_arch = "x86_64")]
impl Registers for f32 {
    type Baseline = x86::F32x4;
    type Avx2 = x86::F32x8;
    type Avx512 = x86::F32x16;
    type One = x86::F32x1;
    type Point = x86::F32Point;
}

#[cfg(not(target_arch = "x86_64"))]
impl Registers for f64 {
    type Baseline = f64;
}

#[cfg(not(target_arch = "x86_64"))]
impl Registers for f32 {
    type Baseline = f32;
}
