//! Runs of a scene with other properties. Each is written to a file as soon as it has ended, so that a fit that is
//! begun again does not make it again.

use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::Duration;

use super::file::{BlowJob, columns};
use crate::fibres::beside::between;
use toron_explicit_host::struck::run::ROUNDING;
use toron_shared::build;
use toron_shared::console::print_note;
use toron_shared::error::Error;
use toron_shared::run_directory::file_error;
use toron_strikes::impact::outcome::Outcome;
use toron_strikes::impact::run;
use toron_strikes::impact::scene::{Case, Zones};

/// The runs of a job, made and kept.
pub struct Runs<'a> {
    pub job: &'a BlowJob,
    path: PathBuf,
    made: Mutex<Made>,
}

struct Made {
    file: File,
    /// The values of the properties, and what followed.
    runs: Vec<(Vec<f64>, Vec<f64>)>,
    found: usize,
    processor: Duration,
}

/// How many runs a fit has taken.
#[derive(Clone, Copy, Debug)]
pub struct Count {
    pub all: usize,
    /// That had been made before.
    pub found: usize,
    /// Of those that were made.
    pub processor: Duration,
}

impl<'a> Runs<'a> {
    /// Those of the file, if there is one, and what is made from now on.
    ///
    /// # Errors
    /// The file cannot be read or written, or its runs are of another scene, history or choice of what is followed.
    pub fn open(job: &'a BlowJob, path: &Path) -> Result<Self, Error> {
        let text = if path.is_file() {
            std::fs::read_to_string(path).map_err(|error| file_error(path, &error))?
        } else {
            String::new()
        };
        let heading =
            format!("# runs of {:08x}: properties in the order of fits, then what followed\n", job.identity());
        let whole = text.rfind('\n').map_or("", |end| &text[..=end]);
        let runs = match whole.strip_prefix(&heading) {
            Some(lines) => lines.lines().filter_map(|line| job.run_of(line)).collect(),
            None if text.is_empty() => Vec::new(),
            None => {
                let message = "its runs are of another build, scene, history, range, choice of follows or fits; allowed: \
                    the same, or another -o";
                return Err(file_error(path, &message));
            }
        };
        // A line that was being written is cut off.
        let mut kept = heading;
        runs.iter().for_each(|(values, followed): &(Vec<f64>, Vec<f64>)| kept += &line(values, followed));
        std::fs::write(path, kept).map_err(|error| file_error(path, &error))?;
        let file = OpenOptions::new().append(true).open(path).map_err(|error| file_error(path, &error))?;
        let made = Mutex::new(Made { file, found: runs.len(), runs, processor: Duration::ZERO });
        Ok(Runs { job, path: path.to_path_buf(), made })
    }

    pub fn count(&self) -> Count {
        let made = self.lock();
        Count { all: made.runs.len(), found: made.found, processor: made.processor }
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Made> {
        // What another thread has left whole is.
        self.made.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
    }

    /// What follows with these values: column by column, at the job's times.
    ///
    /// # Errors
    /// Values that the law refuses, a run that is not stable, or a file that cannot be written.
    pub fn follow(&self, values: &[f64]) -> Result<Vec<f64>, Error> {
        if let Some((_, followed)) = self.lock().runs.iter().find(|(known, _)| known == values) {
            return Ok(followed.clone());
        }
        let outcome = run::run(&self.job.with(values)?, &mut ())?;
        self.job.require_whole(values, outcome.last_time())?;
        let followed = self.job.followed(&outcome);
        let mut made = self.lock();
        made.processor += outcome.cost.processor;
        made.file.write_all(line(values, &followed).as_bytes()).map_err(|error| file_error(&self.path, &error))?;
        made.runs.push((values.to_vec(), followed.clone()));
        let names = self.job.fits.iter().zip(values);
        let names: Vec<String> = names.map(|(fitted, value)| format!("{} {value:.5}", fitted.property.name)).collect();
        let size = self.job.misfit(&followed);
        print_note(&format!("run {}: {}: {size:.3} of the deviations\n", made.runs.len(), names.join(", ")));
        Ok(followed)
    }
}

/// A run as a line of the file, in as many digits as it takes to read the same bits back.
fn line(values: &[f64], followed: &[f64]) -> String {
    let numbers: Vec<String> = values.iter().chain(followed).map(|number| format!("{number:?}")).collect();
    numbers.join(",") + "\n"
}

impl BlowJob {
    /// The number of data.
    pub fn data(&self) -> usize {
        self.times.len() * self.follows.len()
    }

    /// What tells this job's runs from others.
    fn identity(&self) -> u32 {
        let fits: Vec<usize> = self.fits.iter().map(|fitted| fitted.index).collect();
        let names: Vec<&str> = self.follows.iter().map(|followed| followed.name).collect();
        let (units, build) = (self.scene.units.names(), build::number());
        let text = format!("{build} {units:?} {:?} {fits:?} {names:?} {:?}", self.case, self.times);
        crc32fast::hash(text.as_bytes())
    }

    fn run_of(&self, line: &str) -> Option<(Vec<f64>, Vec<f64>)> {
        let numbers: Vec<f64> = line.split(',').map(|cell| cell.parse().ok()).collect::<Option<_>>()?;
        (numbers.len() == self.fits.len() + self.data()).then(|| {
            let (values, followed) = numbers.split_at(self.fits.len());
            (values.to_vec(), followed.to_vec())
        })
    }

    /// The case with these values of the properties that are fitted.
    fn with(&self, values: &[f64]) -> Result<Case, Error> {
        let mut material = self.case.zones.inner().clone();
        let mut all = material.values();
        for (fitted, value) in self.fits.iter().zip(values) {
            all[fitted.index] = *value;
        }
        material.law = material.law.with(&all).map_err(|error| Error::Evaluation(error.to_string()))?;
        Ok(Case { zones: Zones::One(Box::new(material)), ..self.case.clone() })
    }

    /// # Errors
    /// A run is over before the history is: the striker has stopped or left, and nothing follows any more.
    fn require_whole(&self, values: &[f64], reached: f64) -> Result<(), Error> {
        let wanted = self.times.last().copied().unwrap_or_default();
        if reached >= wanted * (1.0 - ROUNDING) {
            return Ok(());
        }
        let given: Vec<String> =
            self.fits.iter().zip(values).map(|(fitted, value)| format!("{} = {value}", fitted.property.name)).collect();
        let message = format!(
            "with {} the run is over at {reached}, since the striker has stopped or left; allowed: a range of the history up to \
             then, or a case without failure",
            given.join(", ")
        );
        Err(Error::Evaluation(message))
    }

    /// What is followed, between two samples by a straight line.
    fn followed(&self, outcome: &Outcome) -> Vec<f64> {
        let times: Vec<f64> = outcome.history.iter().map(|sample| sample.time).collect();
        let columns = columns();
        let of = |name: &str| columns.iter().find(|column| column.name == name);
        let values = self.follows.iter().flat_map(|followed| {
            let values = of(followed.name).map(|column| outcome.history.iter().map(|sample| column.value(sample)));
            let values: Vec<f64> = values.into_iter().flatten().collect();
            self.times.iter().map(|&time| between(&times, &values, time)).collect::<Vec<_>>()
        });
        values.collect()
    }

    /// Followed less measured, over the deviations, column by column.
    pub fn residuals(&self, followed: &[f64]) -> Vec<f64> {
        let data = self.follows.iter().flat_map(|one| one.values.iter().map(|&value| (value, one.deviation)));
        followed.iter().zip(data).map(|(found, (value, deviation))| (found - value) / deviation).collect()
    }

    /// The root mean square of the residuals.
    pub fn misfit(&self, followed: &[f64]) -> f64 {
        let squares: f64 = self.residuals(followed).iter().map(|residual| residual * residual).sum();
        (squares / self.data() as f64).sqrt()
    }
}
