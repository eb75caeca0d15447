//! The standard output and the standard error.

use std::io::Write;

/// Writes to the standard output. A reader that has gone (`toron params | head`) is no error.
pub fn print(text: &str) {
    let _ = std::io::stdout().write_all(text.as_bytes());
}

/// Writes a message to the standard error, whose reader may have gone as well (`toron run 2>&1 | head`).
pub fn print_error(message: &str) {
    let _ = std::io::stderr().write_all(message.as_bytes());
}
