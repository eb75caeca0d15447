//! The directory of a command's files.

use std::path::Path;

use super::error::Error;

/// Checks that an output can be a directory.
///
/// # Errors
/// It is a file.
pub fn check(output: &Path) -> Result<(), Error> {
    if output.exists() && !output.is_dir() {
        return Err(Error::Input(format!("output is {}, a file; allowed: a directory, new or not", output.display())));
    }
    Ok(())
}

/// Makes the directory and those above it, unless they exist.
///
/// # Errors
/// It is a file, or cannot be made.
pub fn create(output: &Path) -> Result<(), Error> {
    check(output)?;
    std::fs::create_dir_all(output).map_err(|error| Error::Input(format!("{}: {error}", output.display())))
}
