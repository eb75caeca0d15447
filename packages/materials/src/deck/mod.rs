//! `toron deck`: a material's card, ready to be pasted into a solver's deck. A file for each host; what they share, the
//! material and its comments, is in `material`, and how each law is found by each host in `interface`.

pub mod abaqus;
mod calculix;
pub mod command;
pub mod interface;
pub mod ls_dyna;
pub mod material;
mod mtest;
pub mod openradioss;
