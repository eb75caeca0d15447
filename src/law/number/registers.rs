//! The registers that each precision is computed in.

#[cfg(target_arch = "x86_64")]
use super::real::Single;
use super::real::{Lanes, Scalar};
#[cfg(target_arch = "x86_64")]
use super::x86;

/// The number types of a precision: several points in lanes at each level of instructions, and a single point.
pub trait Registers: Scalar + Lanes<Self> {
    /// Instructions that every processor of the architecture has.
    type Baseline: Lanes<Self>;
    /// AVX2 with fused multiply-add.
    #[cfg(target_arch = "x86_64")]
    type Avx2: Lanes<Self>;
    /// AVX-512.
    #[cfg(target_arch = "x86_64")]
    type Avx512: Lanes<Self>;
    /// One point, computed by the same operations as `Avx2`.
    #[cfg(target_arch = "x86_64")]
    type Point: Single<Self> + Lanes<Self>;
}

#[cfg(target_arch = "x86_64")]
impl Registers for f64 {
    type Baseline = x86::F64x2;
    type Avx2 = x86::F64x4;
    type Avx512 = x86::F64x8;
    type Point = x86::F64Point;
}

#[cfg(target_arch = "x86_64")]
impl Registers for f32 {
    type Baseline = x86::F32x4;
    type Avx2 = x86::F32x8;
    type Avx512 = x86::F32x16;
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
