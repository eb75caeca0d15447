//! The directory that a scene's runs write to: one program writes there at a time, and nothing of an earlier run stays that a
//! reader would take for this one's.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use super::error::Error;
use super::folder;

/// The file whose lock says that a run writes to its directory. The system releases it however the run ends; the file stays.
const LOCK: &str = "toron.lock";

/// The directory, for as long as its lock is held.
#[derive(Debug)]
pub struct RunDirectory {
    path: PathBuf,
    _lock: File,
}

impl RunDirectory {
    /// Makes the directory, if it is new, and takes its lock.
    ///
    /// # Errors
    /// It is a file, it cannot be made, or another run writes there.
    pub fn open(path: &Path) -> Result<RunDirectory, Error> {
        folder::create(path)?;
        let file = path.join(LOCK);
        is_file(&file)?;
        let lock = OpenOptions::new().create(true).truncate(false).write(true).open(&file);
        let lock = lock.map_err(|error| file_error(&file, &error))?;
        // Where a file system has no locks, the run goes on without.
        if let Err(TryLockError::WouldBlock) = lock.try_lock() {
            let (path, allowed) =
                (path.display(), "allowed: a directory of its own, or this one when that run has ended");
            return Err(Error::Input(format!(
                "output is {path}, to which another run writes ({LOCK} is locked); {allowed}"
            )));
        }
        Ok(RunDirectory { path: path.to_path_buf(), _lock: lock })
    }

    /// Removes a file that is of an earlier run, if it is there; whether it was.
    ///
    /// # Errors
    /// It cannot be removed.
    pub fn remove(&self, name: &str) -> Result<bool, Error> {
        let file = self.path.join(name);
        match std::fs::remove_file(&file) {
            Ok(()) => Ok(true),
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(false),
            Err(error) => Err(file_error(&file, &error)),
        }
    }

    /// Removes what an earlier run has written for this case: histories, plots, pictures, which have `pictures` between name and
    /// number, tables, which have `tables` there, and the files for ParaView from the number `frames` on. Its checkpoint stays. Returns
    /// how many there were.
    ///
    /// # Errors
    /// The directory cannot be read, or a file not be removed.
    pub fn remove_files_of(
        &self,
        case: &str,
        pictures: &str,
        tables: Option<&str>,
        frames: usize,
    ) -> Result<usize, Error> {
        let mut removed = 0;
        let entries = std::fs::read_dir(&self.path).map_err(|error| file_error(&self.path, &error))?;
        for entry in entries {
            let name = entry.map_err(|error| file_error(&self.path, &error))?.file_name();
            if let Some(name) = name.to_str().filter(|name| is_of(name, case, pictures, tables, frames)) {
                removed += usize::from(self.remove(name)?);
            }
        }
        Ok(removed)
    }

    /// What to say of files that were removed; nothing of none.
    pub fn removal(&self, files: usize) -> String {
        match files {
            0 => String::new(),
            1 => format!("1 file of an earlier run is removed from {}\n", self.path.display()),
            _ => format!("{files} files of an earlier run are removed from {}\n", self.path.display()),
        }
    }
}

/// Whether a file of this name is of a case, as [`RunDirectory::remove_files_of`] has it.
fn is_of(name: &str, case: &str, pictures: &str, tables: Option<&str>, frames: usize) -> bool {
    let Some((stem, ending)) = name.strip_prefix(case).and_then(|rest| rest.rsplit_once('.')) else { return false };
    let number =
        |text: &str| text.bytes().all(|byte| byte.is_ascii_digit()).then(|| text.parse::<usize>().ok()).flatten();
    let numbered = |between: &str| stem.strip_prefix(between).and_then(number).is_some();
    match ending {
        "csv" => stem.is_empty() || tables.is_some_and(numbered),
        "pvd" => stem.is_empty() && frames == 0,
        "svg" | "png" => stem.is_empty() || numbered(pictures),
        "vtu" => stem.strip_prefix('-').and_then(number).is_some_and(|number| number >= frames),
        _ => false,
    }
}

/// Whether there is a file; what is none, a pipe or a device, would be waited for without end.
///
/// # Errors
/// There is something else.
pub fn is_file(file: &Path) -> Result<bool, Error> {
    match std::fs::metadata(file) {
        Ok(found) if found.is_file() => Ok(true),
        Ok(found) => {
            let what = if found.is_dir() { "a directory" } else { "a pipe or a device" };
            Err(Error::Input(format!("{} is {what}; allowed: a regular file, or none", file.display())))
        }
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(false),
        Err(error) => Err(file_error(file, &error)),
    }
}

/// What went wrong with a file.
pub fn file_error(file: &Path, error: &dyn std::fmt::Display) -> Error {
    Error::Input(format!("{}: {error}", file.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_files_of_a_case_are_told_from_others() {
        let of = |name: &str| is_of(name, "one", "-panel-", Some("-strain-"), 2);
        for name in
            ["one.csv", "one.svg", "one.png", "one-panel-3.png", "one-panel-12.svg", "one-strain-2.csv", "one-0002.vtu"]
        {
            assert!(of(name), "{name}");
        }
        for name in [
            "one.checkpoint",
            "one.toml",
            "one-0001.vtu",
            "one.pvd",
            "one-2.csv",
            "one-panel-x.png",
            "one-panel-.png",
            "one-more-0003.vtu",
            "two.csv",
            "one",
        ] {
            assert!(!of(name), "{name}");
        }
        assert!(!is_of("one-strain-2.csv", "one", "-panel-", None, 0));
        assert!(is_of("one.pvd", "one", "-panel-", None, 0));
    }
}
