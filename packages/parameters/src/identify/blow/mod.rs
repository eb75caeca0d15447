//! `toron fit` from a blow: properties with which a scene of `toron impact` follows a measured history, or that of
//! `toron fibres`, by least squares over runs of the scene.

pub mod command;
pub mod file;
mod report;
pub mod runs;
pub mod search;
