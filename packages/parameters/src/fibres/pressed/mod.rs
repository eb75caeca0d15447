//! A section between walls that close, slowly: a bead for each fibre, which does not move along it. Energies over the
//! section's area stand beside those of the law, and of `toron cell`.

pub mod friction;
pub mod friction_plot;
pub mod input;
pub mod middle;
pub mod outcome;
pub mod output;
pub mod picture;
pub mod plot;
pub mod summary;
