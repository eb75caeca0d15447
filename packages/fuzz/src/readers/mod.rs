//! Files of the repository, changed at random, for every reader of the programs.

mod checkpoints;
mod mutate;
mod run;
mod targets;

pub use run::{Totals, current, one, run};
pub use targets::{TARGETS, Target, files};
