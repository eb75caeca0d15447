//! A folder for what is built and asked, which goes with its owner.

use std::path::PathBuf;

use crate::common::error::Error;

pub struct Room {
    pub path: PathBuf,
}

impl Room {
    /// # Errors
    /// It cannot be made.
    pub fn new() -> Result<Room, Error> {
        let path = std::env::temp_dir().join(format!("toron-check-{}", std::process::id()));
        let error = |error: std::io::Error| Error::Input(format!("{}: {error}", path.display()));
        // What an earlier process of this number has left.
        if path.exists() {
            std::fs::remove_dir_all(&path).map_err(error)?;
        }
        std::fs::create_dir(&path).map_err(error)?;
        Ok(Room { path })
    }
}

impl Drop for Room {
    fn drop(&mut self) {
        // What cannot be removed stays where the system puts what is temporary.
        let _ = std::fs::remove_dir_all(&self.path);
    }
}
