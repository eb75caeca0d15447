//! Why a command fails, and the exit code that follows.

use std::fmt;

/// Why a command fails, with the message for the user.
#[derive(Clone, Debug, PartialEq)]
pub enum Error {
    /// The evaluation failed: F inverted, Newton does not converge, a free direction has no stiffness.
    Evaluation(String),
    /// The input is invalid, or a file cannot be read or written.
    Input(String),
}

impl Error {
    /// The exit code of the program: 1 for an evaluation, 2 for an input.
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
