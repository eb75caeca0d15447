//! The number types that the laws are written in, scalars and SIMD registers, with their elementary functions and
//! vectors.

pub mod dual;
pub(crate) mod elementary;
pub(crate) mod level;
pub mod real;
pub(crate) mod registers;
mod scalar;
mod series;
pub mod tensor;
#[cfg(any(test, target_arch = "x86_64"))]
pub(crate) mod twice;
pub mod vector;
#[cfg(target_arch = "x86_64")]
pub(crate) mod x86;
