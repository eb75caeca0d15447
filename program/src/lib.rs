//! The commands of the program `toron` that find parameters and go between scales, beside its scenes to start from.
//!
//! Which module answers which question:
//!
//! - scenes to start from, which are built in (`toron init`): [`init`];
//! - properties from measured data (`toron fit`): [`identify`];
//! - energies of a yarn's fibres by finite elements, in CalculiX, from which they are found too (`toron cell`): [`cell`];
//! - the fibres of a yarn under impact, as rows of beads in LAMMPS (`toron fibres`): [`fibres`].
//!
//! Materials and their commands are in the package `toron-materials`, struck scenes in `toron-strikes`; what is wrong
//! with anybody's UMAT (`toron check`) is asked in `umat-check`, on Linux.

pub mod cell;
pub mod fibres;
pub mod identify;
pub mod init;

pub use toron_materials::of_law;
