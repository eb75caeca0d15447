//! Struck yarns and panels: their scenes and meshes, the strike in the explicit host or as decks of other solvers, what
//! comes of it, and at which speed half of the shots go through.
//!
//! Which module answers which question:
//!
//! - a woven panel that is struck (`toron fabric`): [`fabric`];
//! - a yarn under impact (`toron impact`): [`impact`];
//! - at which speed half of the shots go through (`toron v50`), on scenes of either: [`v50`];
//! - what scenes of those two have in common, their keys: [`scene_keys`]; cases over their scene: [`cases`];
//! - woven panels as meshes of hexahedra (`toron weave`): [`weave`];
//! - a scene as a solver's whole deck (`--deck` of `toron fabric`, `impact` and `weave`): [`scene_deck`];
//! - yarns and panels of a law of one's own, in a program of three lines: [`of_law`];
//! - histories of a scene from several hosts (`toron compare`): [`compare`];
//! - strength that scatters along a yarn: [`strength`];
//! - numbers of chance, roots, the level of intervals: [`chance`], [`root`](mod@root), [`confidence`].

pub mod cases;
pub mod chance;
pub mod compare;
pub mod confidence;
pub mod fabric;
pub mod impact;
mod losses;
pub mod own_program;
pub mod residual;
pub mod root;
pub mod scene_deck;
pub mod scene_keys;
pub mod strength;
pub mod v50;
pub mod weave;

pub use own_program::of_law;
