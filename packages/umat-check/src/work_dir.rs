//! A folder for what is built and asked, which goes with its owner.

use std::path::{Path, PathBuf};

use toron_shared::error::Error;

pub struct WorkDir {
    pub path: PathBuf,
}

impl WorkDir {
    /// # Errors
    /// It cannot be made.
    pub fn new() -> Result<WorkDir, Error> {
        let name = format!("toron-check-{}-{:016x}", std::process::id(), fastrand::u64(..));
        let path = std::env::temp_dir().join(name);
        let error = |error: std::io::Error| Error::Input(format!("{}: {error}", path.display()));
        // What is there already belongs to another.
        std::fs::create_dir(&path).map_err(error)?;
        std::fs::create_dir(running(&path)).map_err(error)?;
        std::fs::create_dir(in_either_case(&path)).map_err(error)?;
        Ok(WorkDir { path })
    }
}

/// Where in the folder the law runs.
pub fn running(work_dir: &Path) -> PathBuf {
    work_dir.join("run")
}

/// Where the names of the files beside a law are in small letters and in capitals: Windows does not tell them apart.
pub fn in_either_case(work_dir: &Path) -> PathBuf {
    work_dir.join("names")
}

/// Files that a law may read, beside it: so many, and no longer ones.
const FILES: usize = 200;
const LONGEST: u64 = 1 << 20;

/// Copies the files beside a law to where it runs: it may read some, and must not write to them.
///
/// # Errors
/// They cannot be read or written.
pub fn furnish(work_dir: &Path, law: &Path) -> Result<(), Error> {
    let Some(beside) = law.parent() else { return Ok(()) };
    let error = |error: std::io::Error| Error::Input(format!("{}: {error}", beside.display()));
    for entry in std::fs::read_dir(beside).map_err(error)?.take(FILES) {
        let entry = entry.map_err(error)?;
        let data = entry.metadata().map_err(error)?;
        if data.is_file() && data.len() <= LONGEST {
            std::fs::copy(entry.path(), running(work_dir).join(entry.file_name())).map_err(error)?;
            let name = entry.file_name().to_string_lossy().to_string();
            for name in [name.to_lowercase(), name.to_uppercase()] {
                std::fs::copy(entry.path(), in_either_case(work_dir).join(name)).map_err(error)?;
            }
        }
    }
    Ok(())
}

impl Drop for WorkDir {
    fn drop(&mut self) {
        // What cannot be removed stays where the system puts what is temporary.
        let _ = std::fs::remove_dir_all(&self.path);
    }
}
