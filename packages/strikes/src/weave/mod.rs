//! `toron weave`: woven panels meshed with hexahedra, for the explicit host and for decks of solvers.
//! `docs/reference/fabric-files.md` has the keys of a scene.
//!
//! It is geometry alone: nodes, elements, fibre directions, faces that can touch, and sets of nodes. Warp yarns run
//! along x, weft yarns along y, z goes through the thickness.

pub mod centre_line;
pub mod cloth;
pub mod coarse;
pub mod command;
pub mod crimp;
pub mod cut;
pub mod distance;
pub mod figures;
pub mod file;
pub mod foreign;
pub mod geometry;
pub mod layup;
pub mod mesh;
pub mod model;
pub mod panel;
pub mod pattern;
pub mod picture;
pub mod preset;
pub mod projection;
pub mod reader;
pub mod report;
pub mod section;
pub mod solve;
pub mod surface;
#[cfg(test)]
mod tests;
pub mod torn;
pub mod vtu;
pub mod weights;
