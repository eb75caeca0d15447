//! The files of a deck: the first one, and those that it includes.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::line::Line;
use crate::error::Error;

/// A text, whatever system wrote it: without the mark of its encoding, lines end with a line feed.
pub fn text(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes));
    if text.contains('\r') { text.replace("\r\n", "\n").replace('\r', "\n") } else { text.into_owned() }
}

/// The files that are being read, each of which names the next one.
pub struct Files {
    open: Vec<PathBuf>,
    /// Where a name may stand for a file besides the folder of the file that has it: that of the first file, and what
    /// the deck says.
    folders: Vec<PathBuf>,
}

fn folder(file: &Path) -> PathBuf {
    file.parent().unwrap_or(Path::new("")).to_path_buf()
}

impl Files {
    pub fn new(first: &str) -> Files {
        let first = PathBuf::from(first);
        Files { folders: vec![folder(&first)], open: vec![first] }
    }

    /// Names are looked for in this folder too, itself named from that of the first file.
    pub fn look_in(&mut self, name: &str) {
        let place = self.folders[0].join(name);
        self.folders.push(place);
    }

    /// The name and the text of a file that this line names; [`Files::close`] when it has been read.
    ///
    /// # Errors
    /// There is no such file, or two, or it is being read.
    pub fn open(&mut self, line: &Line<'_>, name: &str) -> Result<(Arc<str>, String), Error> {
        let name = name.trim();
        let own = folder(&self.open[self.open.len() - 1]);
        let folders: Vec<&PathBuf> = [&own].into_iter().chain(&self.folders).collect();
        let mut found: Vec<PathBuf> = Vec::new();
        for folder in &folders {
            // On Windows files are named with the other slash.
            let places = [name.to_string(), name.replace('\\', "/")].map(|name| folder.join(name));
            let Some(place) = places.into_iter().find(|place| place.is_file()) else { continue };
            if !found.iter().any(|other| same(other, &place)) {
                found.push(place);
            }
        }
        let place = match &found[..] {
            [] => own.join(name),
            [one] => one.clone(),
            [one, other, ..] => {
                let message = format!("{name} may be {} or {}; allowed: one of them", one.display(), other.display());
                return Err(line.error(&message));
            }
        };
        if self.open.iter().any(|open| same(open, &place)) {
            return Err(line.error(&format!("{} includes itself; allowed: other files", place.display())));
        }
        let bytes = std::fs::read(&place).map_err(|error| line.error(&format!("{}: {error}", place.display())))?;
        let name = place.display().to_string().into();
        self.open.push(place);
        Ok((name, text(&bytes)))
    }

    pub fn close(&mut self) {
        self.open.pop();
    }
}

fn same(one: &Path, other: &Path) -> bool {
    one == other || one.canonicalize().ok().is_some_and(|one| other.canonicalize().is_ok_and(|other| one == other))
}
