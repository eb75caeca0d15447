//! The laws' materials: their evaluation behind one interface, how files describe them, presets, and whether their
//! units can be right.

pub mod fibre_wave;
pub mod file;
pub mod laws;
pub mod linear_density;
pub mod model;
pub mod of_law;
pub mod own_law;
pub mod preset;
pub mod smith;
