//! Materials: laws with their properties, in files, on one element, at single points, and as cards of solvers. It calls
//! the laws as a host does, through the functions that the C interface exports; no law and no host knows of it.
//!
//! Which module answers which question:
//!
//! - one element along a load path (`toron run`): [`load_path`];
//! - single points through any C entry (`toron eval`): [`eval`];
//! - what a point costs (`toron bench`): [`mod@bench`];
//! - tables of properties and presets (`toron params`): [`params`];
//! - a material's card for a solver's deck (`toron deck`): [`deck`];
//! - these commands for a law of one's own, in a program of three lines: [`of_law`];
//! - what they share: materials, presets and how files describe them in [`material`], the calls of the C interface in
//!   [`entries`], [`units`] and their expressions ([`unit_expression`]), tables of measured data in [`data_table`].

pub mod bench;
pub mod data_table;
pub mod deck;
pub mod entries;
pub mod eval;
pub mod load_path;
pub mod material;
pub mod own_program;
pub mod params;
pub mod unit_expression;
pub mod units;

pub use own_program::of_law;
