//! `toron fabric --deck`, `toron impact --deck`, `toron weave --deck`: a scene as the whole deck of a solver.
//!
//! `of_fabric` and `of_impact` make of a case the [`model::Model`], which knows no host; a file for each host writes
//! that to streams, a mesh file and a short model file that includes it. Cards of materials are those of
//! [`toron_materials::deck`].

mod abaqus;
pub mod command;
mod fields;
mod ls_dyna;
pub mod model;
mod of_fabric;
mod of_impact;
mod openradioss;
pub mod origin;
mod striker;
