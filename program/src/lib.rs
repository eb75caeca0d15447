//! The commands of the program `toron` that strike, compare, fit and press; materials and their commands are in the
//! package `toron-materials`. No law and no host knows of it.
//!
//! Which module answers which question:
//!
//! - a scene as a solver's whole deck (`--deck` of `toron fabric`, `impact` and `weave`): [`scene_deck`];
//! - histories of a scene from several hosts (`toron compare`): [`compare`];
//! - scenes to start from, which are built in (`toron init`): [`init`];
//! - properties from measured data (`toron fit`): [`identify`];
//! - energies of a yarn's fibres by finite elements, in CalculiX, from which they are found too (`toron cell`): [`cell`];
//! - a woven panel struck by a sphere (`toron fabric`): [`fabric`], on the same solver;
//! - the fibres of a yarn under impact, as rows of beads in LAMMPS (`toron fibres`): [`fibres`];
//! - a yarn under impact (`toron impact`): [`impact`], on the explicit solver of the package `toron-explicit-host`;
//! - at which speed half of the shots go through (`toron v50`), on scenes of either: [`v50`];
//! - what those two have in common, their keys: [`struck`];
//! - woven panels as meshes of hexahedra (`toron weave`): [`weave`];
//! - what they share: numbers of chance, roots, the level of intervals: [`common`].
//!
//! What is wrong with anybody's UMAT (`toron check`) is asked in the package `umat-check`, on Linux.

pub mod cell;
pub mod common;
pub mod compare;
pub mod fabric;
pub mod fibres;
pub mod identify;
pub mod impact;
pub mod init;
pub mod scene_deck;
pub mod strength;
pub mod struck;
pub mod v50;
pub mod weave;

pub use toron_materials::of_law;
