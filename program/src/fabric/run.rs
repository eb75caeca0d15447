//! A case from its first step to its last.

use std::path::Path;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

use super::measure::{Sample, measure};
use super::model::{share, solver};
use super::scene::Case;
use crate::common::error::Error;
use crate::common::units::number;
use crate::explicit::archive::Archive;
use crate::explicit::energies::Cost;
use crate::explicit::lanes::Number;
use crate::explicit::snapshot::Snapshot;
use crate::explicit::solver::Solver;
use crate::explicit::vtu;
use crate::weave::model::Model;

/// A run whose total energy moves by more than this part of itself is not stable.
const LARGEST_IMBALANCE: f64 = 0.05;
/// Times closer than this part of a case's time are the same.
const ROUNDING: f64 = 1e-9;

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    Time,
    /// The sphere has stopped, and the run ends with it.
    Stopped,
    /// It has turned back, and the run has gone on to its end.
    Rebounded,
    /// It has gone through, and nothing has touched it for some time.
    Left,
    /// The run could not go on.
    Failed,
}

/// What came of a case.
#[derive(Debug)]
pub struct Outcome {
    pub samples: Vec<Sample>,
    pub snapshots: Vec<Snapshot>,
    pub end: End,
    /// When the first element failed.
    pub failed: Option<f64>,
    /// Why it could not go on.
    pub failure: Option<Error>,
    pub elements: usize,
    pub cost: Cost,
    pub searches: u64,
    pub wall: Duration,
}

impl Outcome {
    /// How far the total energy has moved at most, as a part of what it was.
    pub fn imbalance(&self) -> f64 {
        imbalance(&self.samples)
    }
}

fn imbalance(samples: &[Sample]) -> f64 {
    let Some(first) = samples.first() else { return 0.0 };
    let start = first.energies.total();
    let off = samples.iter().map(|sample| (sample.energies.total() - start).abs() / start);
    off.fold(0.0, crate::explicit::lanes::largest)
}

/// Receives the progress and the frames of a run.
pub trait Observer {
    /// After each sample.
    fn progress(&mut self, _fraction: f64, _sample: &Sample, _imbalance: f64) {}

    /// The text of a VTU file, and its time.
    ///
    /// # Errors
    /// What ends the run.
    fn frame(&mut self, _time: f64, _text: &str) -> Result<(), Error> {
        Ok(())
    }

    /// A checkpoint from which the run can go on.
    ///
    /// # Errors
    /// What ends the run.
    fn checkpoint(&mut self, _bytes: &[u8]) -> Result<(), Error> {
        Ok(())
    }

    /// The run goes on behind frames of these times.
    fn resumed(&mut self, _frames: &[f64]) {}
}

impl Observer for () {}

/// Runs a case, from a checkpoint on if there is one.
///
/// # Errors
/// A material that the host cannot use; a checkpoint that is not this case's.
pub fn run(
    case: &Case,
    panel: &Model,
    checkpoint: Option<&[u8]>,
    observer: &mut (dyn Observer + Send),
) -> Result<Outcome, Error> {
    if case.single_precision {
        Run::new(case, panel, solver::<f32>(case, panel)?).resume(checkpoint, observer)
    } else {
        Run::new(case, panel, solver::<f64>(case, panel)?).resume(checkpoint, observer)
    }
}

/// The checksum of the program's file, since another build may have other bits; nothing where the file cannot be read.
static BUILD: LazyLock<Option<u32>> = LazyLock::new(|| {
    // The link leads to the file that runs, even when another one has taken its place.
    let link = Path::new("/proc/self/exe");
    let file = std::fs::read(link).or_else(|_| std::env::current_exe().and_then(std::fs::read));
    file.ok().map(|bytes| crc32fast::hash(&bytes))
});

/// Tells the program's build from others, as early as it can.
///
/// # Errors
/// The program's own file cannot be read.
pub fn build() -> Result<u32, Error> {
    let message = "the program's own file cannot be read, by which checkpoints tell its build from others; allowed: runs without them";
    BUILD.ok_or_else(|| Error::Input(message.to_string()))
}

/// What a checkpoint begins with: one of another scene or another build is not to be taken.
fn identity(case: &Case) -> Result<String, Error> {
    let (version, build) = (env!("CARGO_PKG_VERSION"), build()?);
    Ok(format!("toron {version} build {build:08x} {case:?}"))
}

fn refused(case: &Case, reason: &str) -> Error {
    let allowed = "allowed: one of the same scene and build, or none";
    Error::Input(format!("the checkpoint of case {} is {reason}; {allowed}", case.name))
}

/// Checks a checkpoint; returns what follows its head.
///
/// # Errors
/// It is not this case's, or damaged.
pub fn check<'a>(case: &Case, checkpoint: &'a [u8]) -> Result<&'a [u8], Error> {
    let damaged = || refused(case, "damaged");
    let (contents, sum) = checkpoint.split_last_chunk::<4>().ok_or_else(damaged)?;
    if crc32fast::hash(contents) != u32::from_le_bytes(*sum) {
        return Err(damaged());
    }
    let mut archive = Archive::Reads(contents);
    let mut found = String::new();
    archive.keep(&mut found).map_err(|_| damaged())?;
    if found != identity(case)? {
        return Err(refused(case, "of another scene or another build of the program"));
    }
    match archive {
        Archive::Reads(rest) => Ok(rest),
        Archive::Writes(_) => Err(damaged()), // not reached
    }
}

struct Run<'a, T> {
    case: &'a Case,
    panel: &'a Model,
    solver: Solver<T>,
    record: Record,
}

/// What a run has recorded, and what it is going to.
#[derive(Debug, Default)]
struct Record {
    samples: Vec<Sample>,
    snapshots: Vec<Snapshot>,
    /// When the frames were written.
    frames: Vec<f64>,
    failed: Option<f64>,
    /// The sphere's position at first.
    start: f64,
    next_sample: f64,
    next_frame: f64,
    next_checkpoint: f64,
    last_contact: f64,
    /// The number of pictures that have been taken.
    pictures: usize,
}

impl Record {
    fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), postcard::Error> {
        archive.keep(&mut self.samples)?;
        archive.keep(&mut self.snapshots)?;
        archive.keep(&mut self.frames)?;
        archive.keep(&mut self.failed)?;
        archive.keep(&mut self.pictures)?;
        let Record { start, next_sample, next_frame, next_checkpoint, last_contact, .. } = self;
        let times = [start, next_sample, next_frame, next_checkpoint, last_contact];
        times.into_iter().try_for_each(|time| archive.keep(time))
    }
}

impl<'a, T: Number> Run<'a, T> {
    fn new(case: &'a Case, panel: &'a Model, mut solver: Solver<T>) -> Self {
        let start = solver.projectile.as_ref().map_or(0.0, |sphere| sphere.position);
        // The balance keeps the energies with which elements are deleted.
        solver.all_outputs = solver.media.iter().any(|medium| medium.fails);
        Run { case, panel, solver, record: Record { start, ..Record::default() } }
    }

    fn checkpoint(&mut self) -> Result<Vec<u8>, Error> {
        let mut archive = Archive::Writes(Vec::new());
        let mut identity = identity(self.case)?;
        let written = archive.keep(&mut identity).and_then(|()| self.record.archive(&mut archive));
        let written = written.and_then(|()| self.solver.archive(&mut archive));
        written.map_err(|error| self.error(&error.to_string()))?;
        match archive {
            Archive::Writes(mut bytes) => {
                bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
                Ok(bytes)
            }
            Archive::Reads(_) => Ok(Vec::new()), // not reached
        }
    }

    fn read(&mut self, checkpoint: &[u8]) -> Result<(), Error> {
        let mut archive = Archive::Reads(check(self.case, checkpoint)?);
        let read = self.record.archive(&mut archive).and_then(|()| self.solver.archive(&mut archive));
        if read.is_err() || !matches!(archive, Archive::Reads([])) {
            return Err(refused(self.case, "damaged"));
        }
        Ok(())
    }

    fn resume(mut self, checkpoint: Option<&[u8]>, observer: &mut (dyn Observer + Send)) -> Result<Outcome, Error> {
        if let Some(checkpoint) = checkpoint {
            self.read(checkpoint)?;
            observer.resumed(&self.record.frames);
        }
        let begun = Instant::now();
        // Inside rayon's threads: entering them in every step would cost as much as a small panel's contact.
        let end = rayon::scope(|_| self.steps(observer));
        Ok(Outcome {
            samples: self.record.samples,
            snapshots: self.record.snapshots,
            failed: self.record.failed,
            end: *end.as_ref().unwrap_or(&End::Failed),
            failure: end.err(),
            elements: self.panel.elements.len(),
            cost: self.solver.cost,
            searches: self.solver.mutual.as_ref().map_or(0, |contact| contact.searches),
            wall: begun.elapsed(),
        })
    }

    fn steps(&mut self, observer: &mut (dyn Observer + Send)) -> Result<End, Error> {
        let share = share(self.case);
        let threshold = self.case.woven.geometry.weave.threads.iter().map(|thread| thread.height).fold(0.0, f64::max);
        let every = |count: usize| self.case.end / count.max(1) as f64;
        let (frame, between_checkpoints) = (every(self.case.frames), every(self.case.checkpoints));
        let mut pictures = self.case.pictures.clone();
        pictures.sort_by(f64::total_cmp);
        if self.solver.time == 0.0 {
            self.record.next_checkpoint = between_checkpoints;
        }
        loop {
            let time = self.solver.time;
            let reached = |instant: f64| time >= instant - ROUNDING * self.case.end;
            let end = self.end(reached(self.case.end), time - self.record.last_contact);
            if self.case.checkpoints > 0 && (reached(self.record.next_checkpoint) || end.is_some()) {
                self.record.next_checkpoint += between_checkpoints;
                let bytes = self.checkpoint()?;
                observer.checkpoint(&bytes)?;
            }
            let sampled = reached(self.record.next_sample) || end.is_some();
            let drawn = pictures.get(self.record.pictures).is_some_and(|&picture| reached(picture));
            let framed = self.case.frames > 0 && reached(self.record.next_frame);
            let left = if reached(self.case.end) { self.case.end } else { self.case.end - time };
            self.solver.accelerate(sampled || drawn || framed, left).map_err(|error| self.error(&error.to_string()))?;
            if self.solver.projectile.as_ref().is_some_and(|sphere| sphere.force != 0.0) {
                self.record.last_contact = time;
            }
            let failed = || self.solver.bodies.iter().any(|yarn| yarn.deleted.len() > yarn.collapsed);
            if self.record.failed.is_none() && failed() {
                self.record.failed = Some(time);
            }
            if sampled {
                let sample = measure(self.panel, &self.solver, share, self.record.start, threshold);
                self.record.samples.push(sample);
                self.record.next_sample += self.case.sample;
                let imbalance = imbalance(&self.record.samples);
                observer.progress(time / self.case.end, &sample, imbalance);
                if imbalance.is_nan() || imbalance > LARGEST_IMBALANCE {
                    let moved = number(100.0 * imbalance);
                    return Err(self.error(&format!("the total energy is {moved} % from what it was: not stable")));
                }
            }
            if drawn {
                self.record.pictures += 1;
                self.record.snapshots.push(Snapshot::of(&self.solver, self.case.sphere.radius));
            }
            if framed {
                self.record.next_frame += frame;
                self.record.frames.push(time);
                observer.frame(time, &vtu::unstructured_grid(&self.solver)?)?;
            }
            if let Some(end) = end {
                return Ok(end);
            }
            self.solver.displace();
        }
    }

    /// Whether the run is over; `free` is how long nothing has touched the sphere.
    fn end(&self, at_end: bool, free: f64) -> Option<End> {
        let sphere = self.solver.projectile.as_ref()?;
        if sphere.velocity >= 0.0 {
            let end = if self.case.rebounds { End::Rebounded } else { End::Stopped };
            return (at_end || !self.case.rebounds).then_some(end);
        }
        // It has gone its own radius since something touched it last, or since the beginning, where it stands at the panel.
        let gone = free * -sphere.velocity > self.case.sphere.radius;
        if gone {
            return Some(End::Left);
        }
        at_end.then_some(End::Time)
    }

    fn error(&self, reason: &str) -> Error {
        Error::Evaluation(format!("case {} at time {}: {reason}", self.case.name, number(self.solver.time)))
    }
}
