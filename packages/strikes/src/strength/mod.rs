//! Strength that scatters along a yarn: by Weibull's law, in independent cells of a correlation length.

pub mod field;
pub mod file;
pub mod fit;
pub mod reader;
pub mod scales;
pub mod scatter;
#[cfg(test)]
mod tests;
pub mod weibull;
