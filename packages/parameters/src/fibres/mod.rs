//! `toron fibres`: the fibres of a yarn as rows of point masses (thesis, chapter 3), on LAMMPS.
//!
//! The physics is LAMMPS's. What stands here is the geometry ([`section`], [`model`]), the input that it reads
//! ([`input`]), how it is found and run ([`lammps`], [`run`]), and what becomes of what it writes: [`history`] and
//! [`frame`] read it, [`outcome`] has the quantities that are computed from it. [`pressed`] is the section between
//! walls.

pub mod beside;
pub mod command;
pub mod file;
pub mod frame;
pub mod history;
pub mod input;
pub mod lammps;
pub mod model;
pub mod outcome;
pub mod picture;
pub mod plot;
pub mod pressed;
pub mod reader;
pub mod report;
pub mod run;
pub mod scene;
pub mod section;
pub mod summary;
