//! What the program's rooms share: numbers of chance, roots, the level of intervals.

pub mod chance;
pub mod confidence;
pub mod root;
