//! Weibull's law of a yarn's strength from tests, or from scales that others have found: the tables `[[strength]]` of
//! `toron fit`.

pub mod command;
pub mod file;
pub mod report;
