//! `toron run`: one element of a material along a load path, and its table, plots and summary.

pub mod columns;
pub mod command;
pub mod element;
pub mod file;
pub mod newton;
pub mod path;
pub mod plot;
pub mod report;
pub mod run;
pub mod table;
