//! `toron compare`: histories of a scene from several hosts in one table and one figure.
//!
//! A file for each host reads its histories; `history` is what they have in common.

pub mod command;
mod figures;
mod history;
mod of_abaqus;
mod of_ls_dyna;
mod of_openradioss;
mod of_toron;
mod plot;
mod report;
mod table;
