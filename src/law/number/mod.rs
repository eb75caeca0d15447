//! The numbers that the laws are written in: scalars and registers of several points, their elementary functions, vectors.

pub(crate) mod elementary;
pub(crate) mod level;
pub mod real;
pub mod registers;
mod scalar;
mod series;
pub(crate) mod vector;
#[cfg(target_arch = "x86_64")]
pub(crate) mod x86;
