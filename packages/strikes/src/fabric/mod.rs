//! `toron fabric`: a woven panel struck by a sphere or a cylinder (thesis, chapter 5), on the explicit
//! [host](toron_explicit_host). `docs/reference/fabric-files.md` has the keys of a scene.

pub mod command;
pub mod fate;
pub mod file;
#[cfg(test)]
mod joint_tests;
pub mod judgement;
pub mod measure;
pub mod panel_picture;
pub mod plot;
pub mod reader;
pub mod report;
pub mod run;
pub mod scene;
pub mod solver;
pub mod strength;
pub mod summary;
#[cfg(test)]
mod tests;
pub mod weights;
