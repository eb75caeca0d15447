//! The program `toron`. It calls the laws as a host does, through the functions that the C interface exports; no law and no
//! host knows of it.
//!
//! Which module answers which question:
//!
//! - one element along a load path (`toron run`): [`load_path`];
//! - single points through any C entry (`toron eval`): [`eval`];
//! - what a point costs (`toron bench`): [`mod@bench`];
//! - tables of properties and presets (`toron params`): [`params`];
//! - a material's card for a solver's deck (`toron deck`): [`deck`];
//! - a scene as a solver's whole deck (`--deck` of `toron fabric`, `impact` and `weave`): [`scene_deck`];
//! - histories of a scene from several hosts (`toron compare`): [`compare`];
//! - what is wrong with anybody's UMAT (`toron check`): the package `umat-check`, on Linux;
//! - scenes to start from, which are built in (`toron init`): [`init`];
//! - properties from measured data (`toron fit`): [`identify`];
//! - energies of a yarn's fibres by finite elements, in CalculiX, from which they are found too (`toron cell`): [`cell`];
//! - a woven panel struck by a sphere (`toron fabric`): [`fabric`], on the same solver;
//! - the fibres of a yarn under impact, as rows of beads in LAMMPS (`toron fibres`): [`fibres`];
//! - a yarn under impact (`toron impact`): [`impact`], on the explicit solver in [`explicit`];
//! - at which speed half of the shots go through (`toron v50`), on scenes of either: [`v50`];
//! - what those two have in common, from their keys to their checkpoints: [`struck`];
//! - woven panels as meshes of hexahedra (`toron weave`): [`weave`];
//! - `run`, `params`, `deck` and `eval` for a law of one's own, in a program of three lines: [`of_law`];
//! - what they share: materials, presets and how files describe them in [`material`], the calls of the C interface in [`entries`],
//!   units and tables of measured data in [`common`]; drawing in the package `toron-pictures`; errors, TOML
//!   files, arguments and exit codes in `toron-shared`.

pub mod bench;
pub mod cell;
pub mod common;
pub mod compare;
pub mod deck;
pub mod entries;
pub mod eval;
pub mod explicit;
pub mod fabric;
pub mod fibres;
pub mod identify;
pub mod impact;
pub mod init;
pub mod load_path;
pub mod material;
mod own_program;
pub mod params;
pub mod scene_deck;
pub mod strength;
pub mod struck;
pub mod v50;
pub mod weave;

pub use own_program::of_law;

/// The commands whose output is tables, which they can print as JSON too.
pub const WITH_TABLES: [&str; 12] =
    ["init", "fit", "run", "weave", "fabric", "impact", "v50", "fibres", "cell", "params", "compare", "bench"];
