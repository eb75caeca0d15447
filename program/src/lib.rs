//! The program `toron`: arguments to calls. Its commands are in the packages `toron-materials`, `toron-strikes`,
//! `toron-parameters` and, on Linux, `umat-check`; here are the scenes to start from.

pub mod init;

pub use toron_strikes::of_law;
