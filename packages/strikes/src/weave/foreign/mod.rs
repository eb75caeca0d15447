//! Meshes of panels that others have made: read, turned as the model has them, and checked.
//! `docs/reference/fabric-files.md` has the formats.

pub mod abaqus;
pub mod bins;
pub mod build;
pub mod checks;
pub mod crimp;
pub mod file;
#[cfg(test)]
mod form_tests;
pub mod ls_dyna;
pub mod orient;
pub mod raw;
pub mod reader;
#[cfg(test)]
mod tests;
pub mod vtu;
pub mod vtu_data;
