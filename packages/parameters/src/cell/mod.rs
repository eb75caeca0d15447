//! `toron cell`: the section of a yarn, fibre by fibre, in CalculiX or in the explicit host, which takes what statics
//! cannot follow; its strain energies identify the yarn law's transverse parameters (thesis sections 4.5.2 and 4.5.3).
//!
//! Plane strain: the fibres are one layer of C3D8 thick and stay as long as they are. A fibre is transversely
//! isotropic, and CalculiX takes it as a St. Venant–Kirchhoff solid (linear between second Piola–Kirchhoff stress and
//! Green's strain).
//!
//! Inside, lengths are counted in diameters of a fibre, stresses in thousandths of its transverse modulus: forces are
//! then of the size that CalculiX's tolerances are made for.

pub mod arrangement;
pub mod command;
pub mod deck;
pub mod disc;
pub mod energies;
pub mod explicit_run;
pub mod file;
pub mod model;
pub mod output;
pub mod picture;
pub mod printed;
pub mod random_packing;
pub mod reader;
pub mod report;
pub mod run;
pub mod scene;
pub mod solver;
