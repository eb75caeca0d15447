//! One element taken along a load path, a yarn under impact, and what there is to see of them: tables, plots, a summary,
//! decks.
//!
//! The program calls the laws as a host does, through the functions that the C interface exports; no law and no host knows of it.

pub mod bench;
pub mod command;
pub mod element;
pub mod entries;
pub mod eval;
pub mod explicit;
pub mod fibre_wave;
mod file_error;
pub mod impact;
pub mod material;
pub mod newton;
pub mod parallel;
pub mod params;
pub mod path;
pub mod picture;
pub mod plot;
pub mod polar;
pub mod report;
pub mod run;
pub mod scene;
pub mod table;
pub mod unit_names;

use std::fmt;
use std::io::Write;

/// Why a command ends without its answer, with the message for the user.
#[derive(Clone, Debug, PartialEq)]
pub enum Error {
    /// The evaluation failed: F inverted, Newton does not converge, a free direction has no stiffness.
    Evaluation(String),
    /// The input or a file is at fault.
    Input(String),
}

impl Error {
    /// What the program hands to its shell: 1 for an evaluation, 2 for an input.
    pub fn exit_code(&self) -> u8 {
        match self {
            Error::Evaluation(_) => 1,
            Error::Input(_) => 2,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Evaluation(message) | Error::Input(message) => f.write_str(message),
        }
    }
}

impl std::error::Error for Error {}

/// Writes to the standard output. A reader that has gone (`toron params | head`) is no error.
fn print(text: &str) {
    let _ = std::io::stdout().write_all(text.as_bytes());
}

/// Writes a message to the standard error, whose reader may have gone as well (`toron run 2>&1 | head`).
pub fn complain(message: &str) {
    let _ = std::io::stderr().write_all(message.as_bytes());
}
