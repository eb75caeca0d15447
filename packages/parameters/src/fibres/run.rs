//! A case in a folder of its own: written, run by LAMMPS or on from where a run was killed, and read.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Instant, SystemTime};

use super::frame::{self, Frame};
use super::history;
use super::input::{self, BEADS, DONE, FRAMES, HISTORY, INPUT, RESTARTS};
use super::lammps::{LOG, Lammps};
use super::model::{Model, Striking};
use toron_shared::error::Error;
use toron_shared::folder;
use toron_shared::kept_file;
use toron_shared::run_directory::{file_error, is_file};

/// What a run has left.
#[derive(Clone, Debug)]
pub struct Raw {
    /// The numbers of each line of the history.
    pub rows: Vec<Vec<f64>>,
    pub frames: Vec<Frame>,
    /// How long LAMMPS took, where it was not there already.
    pub seconds: Option<f64>,
}

/// The folder of a case.
pub struct Folder<'a> {
    path: PathBuf,
    model: &'a Model,
    /// What LAMMPS reads, by the files' names.
    texts: [(&'static str, String); 2],
}

impl<'a> Folder<'a> {
    /// The folder of a case at this path, which need not be there.
    pub fn new(path: PathBuf, model: &'a Model) -> Folder<'a> {
        let texts = [(INPUT, input::input(model)), (BEADS, input::beads(model))];
        Folder { path, model, texts }
    }

    /// Whether what LAMMPS reads is there as it would be written.
    pub fn is_written(&self) -> bool {
        let same =
            |(name, text): &(&str, String)| std::fs::read(self.file(name)).is_ok_and(|old| old == text.as_bytes());
        self.texts.iter().all(same)
    }

    /// Whether a run of other files than would be written has left something here, which goes when they are.
    ///
    /// # Errors
    /// Something that is no file is called as one.
    pub fn is_of_another(&self) -> Result<bool, Error> {
        Ok(!self.is_written() && !self.left()?.is_empty())
    }

    /// Writes what LAMMPS reads, unless it is there: then what a run has left stays, which goes otherwise. Returns how
    /// many files have gone.
    ///
    /// # Errors
    /// A file cannot be written or removed.
    pub fn write(&self) -> Result<usize, Error> {
        if self.is_written() {
            return Ok(0);
        }
        folder::create(&self.path)?;
        let gone = self.forget()?;
        let [input, beads] = &self.texts;
        // The input is short, and a user may have changed it.
        kept_file::write(&self.file(input.0), |file| file.write_all(input.1.as_bytes()))?;
        kept_file::overwrite(&self.file(beads.0), |file| file.write_all(beads.1.as_bytes()))?;
        Ok(gone)
    }

    fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// What runs have left.
    fn left(&self) -> Result<Vec<PathBuf>, Error> {
        let mut left = Vec::new();
        let names = [HISTORY, FRAMES, DONE, LOG, RESTARTS[0], RESTARTS[1]].map(String::from);
        for name in names.into_iter().chain(self.model.frames.iter().map(|&step| input::frame(step))) {
            let file = self.file(&name);
            if is_file(&file)? {
                left.push(file);
            }
        }
        Ok(left)
    }

    /// Removes what runs have left; returns how many files that were.
    fn forget(&self) -> Result<usize, Error> {
        let left = self.left()?;
        for file in &left {
            std::fs::remove_file(file).map_err(|error| file_error(file, &error))?;
        }
        Ok(left.len())
    }

    /// Whether a run has come to its end here.
    pub fn is_done(&self) -> bool {
        self.file(DONE).is_file()
    }

    /// Runs the case, from the last restart file that can be read if there is one. `progress` is told the part that is
    /// done.
    ///
    /// # Errors
    /// LAMMPS cannot be started, or ends with an error.
    pub fn run(&self, lammps: &Lammps, ranks: usize, progress: &mut dyn FnMut(f64)) -> Result<f64, Error> {
        let start = Instant::now();
        let history = self.file(HISTORY);
        let mut look = || progress(history::last_step(&history, self.model) / self.model.steps as f64);
        for restart in self.restarts() {
            // One that was being written when the run was killed cannot be read: then the one before it.
            let before = modified(&self.file(&restart));
            let outcome = lammps.run(&self.path, ranks, Some(&restart), &mut look);
            let told = std::fs::read_to_string(self.file(LOG)).unwrap_or_default();
            if outcome.is_ok() || told.contains("Setting up Verlet") || before.is_none() {
                return outcome.and_then(|()| self.check(lammps)).map(|()| start.elapsed().as_secs_f64());
            }
        }
        self.forget()?;
        lammps.run(&self.path, ranks, None, &mut look)?;
        self.check(lammps)?;
        Ok(start.elapsed().as_secs_f64())
    }

    /// That a program which has ended well has done what LAMMPS does with the input.
    fn check(&self, lammps: &Lammps) -> Result<(), Error> {
        if self.is_done() {
            return Ok(());
        }
        let [done, log] = [DONE, LOG].map(|name| self.file(name).display().to_string());
        Err(Error::Input(format!(
            "{lammps} has ended without an error, but has not written {done}, as LAMMPS does at the end of {INPUT}; all it \
             said is in {log}; allowed: the program lmp of LAMMPS"
        )))
    }

    /// The restart files, the last one first.
    fn restarts(&self) -> Vec<String> {
        let mut found: Vec<(SystemTime, &str)> =
            RESTARTS.iter().filter_map(|&name| Some((modified(&self.file(name))?, name))).collect();
        found.sort();
        found.into_iter().rev().map(|(_, name)| name.to_string()).collect()
    }

    /// Reads what the run has left.
    ///
    /// # Errors
    /// A file cannot be read, or has no line.
    pub fn read(&self, seconds: Option<f64>) -> Result<Raw, Error> {
        let history = self.file(HISTORY);
        let rows = history::read(&history, self.model)?;
        if rows.is_empty() {
            return Err(file_error(&history, &"no line of the run; allowed: the lines that LAMMPS writes"));
        }
        if let Some(row) = rows.iter().find(|row| row.iter().any(|x| x.is_nan())) {
            let time = row.get(1).copied().unwrap_or_default();
            return Err(file_error(
                &history,
                &format!("NaN at {time} µs; allowed: numbers. A smaller `step` may help"),
            ));
        }
        let frames = match self.model.striker {
            Striking::Driven { .. } => frame::read(&self.file(FRAMES), self.model)?,
            Striking::Cylinder { .. } | Striking::Walls(_) => {
                let files = self.model.frames.iter().map(|&step| self.file(&input::frame(step)));
                let mut frames = Vec::new();
                for file in files {
                    frames.extend(frame::read(&file, self.model)?);
                }
                frames
            }
        };
        Ok(Raw { rows, frames, seconds })
    }
}

fn modified(path: &Path) -> Option<SystemTime> {
    std::fs::metadata(path).and_then(|found| found.modified()).ok()
}
