//! What all commands share: errors and their exit codes, the console, progress bars, names of units, files in TOML.

pub mod console;
pub mod error;
pub mod progress;
pub mod toml_error;
pub mod toml_file;
pub mod units;
