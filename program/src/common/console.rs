//! The standard output and the standard error.

use std::io::{self, ErrorKind, Write};
use std::sync::OnceLock;

/// Why something that was to be printed is lost: the first reason.
static LOST: OnceLock<String> = OnceLock::new();

/// Writes to the standard output. A reader that has gone (`toron params | head`) is no error; another reason, such as a full disk, is
/// [kept](lost), so that a command writes its files all the same.
pub fn print(text: &str) {
    keep(io::stdout().write_all(text.as_bytes()));
}

/// Keeps the reason if writing to the standard output has failed, or what is still in its buffer cannot be written.
pub fn keep(written: io::Result<()>) {
    if let Err(error) = written.and_then(|()| io::stdout().flush())
        && error.kind() != ErrorKind::BrokenPipe
    {
        let _ = LOST.set(error.to_string()); // an earlier reason stays
    }
}

/// Why something that was to be printed is lost.
pub fn lost() -> Option<&'static str> {
    LOST.get().map(String::as_str)
}

/// Writes a message to the standard error, whose reader may have gone as well (`toron run 2>&1 | head`).
pub fn print_error(message: &str) {
    let _ = io::stderr().write_all(message.as_bytes());
}
