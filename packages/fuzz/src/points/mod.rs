//! Hostile calls of the numerical entries.

mod arrays;
mod case;
mod checks;
mod compare;
mod difference;
mod entries;
mod faults;
mod functions;
mod hosts;
mod laws;
mod line;
mod literal;
mod random;
mod run;

pub use case::{Case, Host, Input, LAWS, Law, Old, with};
pub use entries::{Entry, Outcome, call};
pub use faults::{FAULTS, Fault};
pub use literal::ONE_IN;
pub use run::{Found, Totals, replay, run, smallest};
