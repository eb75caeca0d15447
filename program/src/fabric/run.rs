//! A case from its first step to its last.

use std::path::Path;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::measure::{Sample, measure};
use super::model::{share, solver};
use super::scene::Case;
use crate::common::error::Error;
use crate::common::units::number;
use crate::explicit::archive::Archive;
use crate::explicit::energies::{Balance, Cost};
use crate::explicit::judgement::MEASURED_EVERY;
use crate::explicit::lanes::Number;
use crate::explicit::snapshot::Snapshot;
use crate::explicit::solver::Solver;
use crate::explicit::vtu;
use crate::weave::model::Model;

/// Times closer than this part of a case's time are the same.
const ROUNDING: f64 = 1e-9;

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum End {
    Time,
    /// The sphere has stopped, and the run ends with it.
    Stopped,
    /// It has turned back, and the run has gone on to its end.
    Rebounded,
    /// It has gone through, and nothing has touched it for some time.
    Left,
    /// Somebody has asked the program to end.
    Interrupted,
    /// The run could not go on.
    Failed,
}

/// What came of a case.
#[derive(Debug)]
pub struct Outcome {
    /// Measured every [`MEASURED_EVERY`] steps: what is said of the run comes from these.
    pub measured: Vec<Sample>,
    pub balance: Balance,
    /// Measured when it was asked for.
    pub history: Vec<Sample>,
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
    /// What stands in the file of a case that has ended, from which its report and its plots come.
    fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), postcard::Error> {
        let mut failure = self.failure.as_ref().map(Error::to_string);
        archive.keep(&mut failure)?;
        self.failure = failure.map(Error::Evaluation);
        archive.keep(&mut self.measured)?;
        archive.keep(&mut self.balance)?;
        archive.keep(&mut self.history)?;
        archive.keep(&mut self.snapshots)?;
        archive.keep(&mut self.end)?;
        archive.keep(&mut self.failed)?;
        archive.keep(&mut self.elements)?;
        archive.keep(&mut self.cost)?;
        archive.keep(&mut self.searches)?;
        archive.keep(&mut self.wall)
    }
}

/// Receives what a run has to tell on its way.
pub trait Observer {
    /// How far the run is: the part of its time, what was measured, and how far the total energy has moved.
    fn progress(&mut self, _fraction: f64, _sample: &Sample, _imbalance: f64) {}

    /// A line of the history.
    ///
    /// # Errors
    /// What ends the run.
    fn sample(&mut self, _sample: &Sample) -> Result<(), Error> {
        Ok(())
    }

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

    /// The run goes on at this part of its time, behind these samples and frames of these times.
    ///
    /// # Errors
    /// What ends the run.
    fn resumed(&mut self, _fraction: f64, _samples: &[Sample], _frames: &[f64]) -> Result<(), Error> {
        Ok(())
    }

    /// Whether the run is to write its checkpoint and end.
    fn interrupts(&self) -> bool {
        false
    }
}

impl Observer for () {}

/// Runs a case, from a checkpoint on if there is one; one of a case that has ended is its outcome.
///
/// # Errors
/// A material that the host cannot use; a checkpoint that is not this case's.
pub fn run(
    case: &Case,
    panel: &Model,
    checkpoint: Option<&[u8]>,
    observer: &mut (dyn Observer + Send),
) -> Result<Outcome, Error> {
    if let Some(outcome) = checkpoint.map(|bytes| ended(case, bytes)).transpose()?.flatten() {
        return Ok(outcome);
    }
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

/// What a checkpoint begins with: one of another build is not to be taken, nor one of another scene, but for what only the
/// future depends on.
fn identity(case: &Case) -> Result<String, Error> {
    let (version, build) = (env!("CARGO_PKG_VERSION"), build()?);
    let plan = Plan::default();
    let Plan { end, sample, pictures, frames, checkpoints } = plan;
    let past = Case { end, sample, pictures, frames, checkpoints, rebounds: false, ..case.clone() };
    Ok(format!("toron {version} build {build:08x} {past:?}"))
}

/// What a case is going to do and to write, which a restart may change, but for the time between samples.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Plan {
    end: f64,
    sample: f64,
    pictures: Vec<f64>,
    frames: usize,
    checkpoints: usize,
}

impl Plan {
    fn of(case: &Case) -> Plan {
        let Case { end, sample, pictures, frames, checkpoints, .. } = case.clone();
        Plan { end, sample, pictures, frames, checkpoints }
    }
}

/// Where a checkpoint stands in time, and the plan of the run that wrote it.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Head {
    time: f64,
    plan: Plan,
    /// How the case has ended, where its outcome follows and nothing from which it could go on.
    pub ended: Option<End>,
}

impl Head {
    /// Whether a case that has ended would go on now.
    fn is_too_early(&self, case: &Case) -> bool {
        match self.ended {
            None | Some(End::Left | End::Failed | End::Interrupted) => false,
            Some(End::Stopped) => case.rebounds,
            Some(End::Time | End::Rebounded) => case.end > self.plan.end * (1.0 + ROUNDING),
        }
    }
}

fn refused(case: &Case, reason: &str) -> Error {
    let allowed = "allowed: one of the same build and scene, but for end, until, pictures, frames and checkpoints";
    Error::Input(format!("the checkpoint of case {} is {reason}; {allowed}", case.name))
}

/// Checks a checkpoint; returns its head and what follows.
///
/// # Errors
/// It is not this case's, later than its end, or damaged.
pub fn check<'a>(case: &Case, checkpoint: &'a [u8]) -> Result<(Head, &'a [u8]), Error> {
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
    let mut head = Head::default();
    archive.keep(&mut head).map_err(|_| damaged())?;
    if head.is_too_early(case) {
        let allowed = "allowed: end and until as they were, or another directory";
        let reason = format!("of its end at {}, from which it cannot go on", number(head.time));
        return Err(Error::Input(format!("the checkpoint of case {} is {reason}; {allowed}", case.name)));
    }
    if head.time > case.end * (1.0 + ROUNDING) {
        let [end, time] = [case.end, head.time].map(number);
        let message =
            format!("end is {end} in case {}, whose checkpoint is of {time}; allowed: {time} or later", case.name);
        return Err(Error::Input(message));
    }
    match archive {
        Archive::Reads(rest) => Ok((head, rest)),
        Archive::Writes(_) => Err(damaged()), // not reached
    }
}

/// The outcome of a case that has ended, if its checkpoint is one of its end.
fn ended(case: &Case, checkpoint: &[u8]) -> Result<Option<Outcome>, Error> {
    let (head, rest) = check(case, checkpoint)?;
    let Some(end) = head.ended else { return Ok(None) };
    let mut outcome = Outcome {
        measured: Vec::new(),
        balance: Balance::default(),
        history: Vec::new(),
        snapshots: Vec::new(),
        end,
        failed: None,
        failure: None,
        elements: 0,
        cost: Cost::default(),
        searches: 0,
        wall: Duration::ZERO,
    };
    let read = outcome.archive(&mut Archive::Reads(rest));
    read.map_err(|_| refused(case, "damaged"))?;
    Ok(Some(outcome))
}

/// The checkpoint of a case that has ended: small, since it has the outcome and no state.
///
/// # Errors
/// The program's own file cannot be read.
pub fn checkpoint_of_end(case: &Case, outcome: &mut Outcome) -> Result<Vec<u8>, Error> {
    let time = outcome.measured.last().map_or(0.0, |sample| sample.time);
    let head = Head { time, plan: Plan::of(case), ended: Some(outcome.end) };
    write(case, head, |archive| outcome.archive(archive))
}

/// A checkpoint: of which case, its head, what `contents` adds, and a checksum.
fn write(
    case: &Case,
    mut head: Head,
    contents: impl FnOnce(&mut Archive<'_>) -> Result<(), postcard::Error>,
) -> Result<Vec<u8>, Error> {
    let mut archive = Archive::Writes(Vec::new());
    let mut identity = identity(case)?;
    let written =
        archive.keep(&mut identity).and_then(|()| archive.keep(&mut head)).and_then(|()| contents(&mut archive));
    written.map_err(|error| Error::Evaluation(format!("case {}: {error}", case.name)))?;
    match archive {
        Archive::Writes(mut bytes) => {
            bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
            Ok(bytes)
        }
        Archive::Reads(_) => Ok(Vec::new()), // not reached
    }
}

/// The time between so many equal parts of another.
fn interval(end: f64, count: usize) -> f64 {
    end / count.max(1) as f64
}

struct Run<'a, T> {
    case: &'a Case,
    /// The case's, but for the time between samples, which is the checkpoint's.
    plan: Plan,
    panel: &'a Model,
    solver: Solver<T>,
    record: Record,
}

/// What a run has recorded, and what it is going to.
#[derive(Debug, Default)]
struct Record {
    measured: Vec<Sample>,
    balance: Balance,
    history: Vec<Sample>,
    snapshots: Vec<Snapshot>,
    /// When the frames were written.
    frames: Vec<f64>,
    /// The sphere's position at first.
    start: f64,
    next_sample: f64,
    next_frame: f64,
    next_checkpoint: f64,
    last_contact: f64,
    /// When pictures will be taken, in order.
    pictures: Vec<f64>,
}

impl Record {
    fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), postcard::Error> {
        archive.keep(&mut self.measured)?;
        archive.keep(&mut self.balance)?;
        archive.keep(&mut self.history)?;
        archive.keep(&mut self.snapshots)?;
        archive.keep(&mut self.frames)?;
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
        let plan = Plan::of(case);
        let mut pictures = plan.pictures.clone();
        pictures.sort_by(f64::total_cmp);
        let next_checkpoint = interval(plan.end, plan.checkpoints);
        let record = Record { start, pictures, next_checkpoint, ..Record::default() };
        Run { case, plan, panel, solver, record }
    }

    fn checkpoint(&mut self) -> Result<Vec<u8>, Error> {
        let head = Head { time: self.solver.state.time, plan: self.plan.clone(), ended: None };
        let Run { record, solver, .. } = self;
        write(self.case, head, |archive| record.archive(archive).and_then(|()| solver.archive(archive)))
    }

    fn read(&mut self, checkpoint: &[u8]) -> Result<(), Error> {
        let (head, rest) = check(self.case, checkpoint)?;
        let mut archive = Archive::Reads(rest);
        let read = self.record.archive(&mut archive).and_then(|()| self.solver.archive(&mut archive));
        if read.is_err() || !matches!(archive, Archive::Reads([])) {
            return Err(refused(self.case, "damaged"));
        }
        self.plan.sample = head.plan.sample;
        self.change_plan(&head.plan);
        Ok(())
    }

    /// Goes over from the plan of the run that wrote the checkpoint to this one's. Where they are the same nothing changes.
    fn change_plan(&mut self, old: &Plan) {
        let (new, time) = (&self.plan, self.solver.state.time);
        let later = |interval: f64, round: fn(f64) -> f64| interval * round(time / interval);
        if (new.end, new.frames) != (old.end, old.frames) {
            // The frame of this time comes after the checkpoint.
            self.record.next_frame = later(interval(new.end, new.frames), |count| (count - ROUNDING).ceil());
        }
        if (new.end, new.checkpoints) != (old.end, old.checkpoints) {
            let next = |count: f64| (count + ROUNDING).floor() + 1.0;
            self.record.next_checkpoint = later(interval(new.end, new.checkpoints), next);
        }
        if new.pictures != old.pictures {
            let pending = |picture: &f64| *picture >= time || self.record.pictures.contains(picture);
            let mut pictures: Vec<f64> = new.pictures.iter().copied().filter(pending).collect();
            pictures.sort_by(f64::total_cmp);
            self.record.pictures = pictures;
        }
    }

    fn resume(mut self, checkpoint: Option<&[u8]>, observer: &mut (dyn Observer + Send)) -> Result<Outcome, Error> {
        if let Some(checkpoint) = checkpoint {
            self.read(checkpoint)?;
            let fraction = self.solver.state.time / self.plan.end;
            observer.resumed(fraction, &self.record.history, &self.record.frames)?;
        }
        let begun = Instant::now();
        // Inside rayon's threads: entering them in every step would cost as much as a small panel's contact.
        let end = rayon::scope(|_| self.steps(observer));
        Ok(Outcome {
            measured: self.record.measured,
            balance: self.record.balance,
            history: self.record.history,
            snapshots: self.record.snapshots,
            failed: self.solver.state.failed,
            end: *end.as_ref().unwrap_or(&End::Failed),
            failure: end.err(),
            elements: self.panel.elements.len(),
            cost: self.solver.state.cost,
            searches: self.solver.mutual.as_ref().map_or(0, |contact| contact.state.searches),
            wall: begun.elapsed(),
        })
    }

    fn steps(&mut self, observer: &mut (dyn Observer + Send)) -> Result<End, Error> {
        let share = share(self.case);
        let threshold = self.case.woven.geometry.weave.threads.iter().map(|thread| thread.height).fold(0.0, f64::max);
        let Plan { end: last, frames, checkpoints, .. } = self.plan;
        let (frame, between_checkpoints) = (interval(last, frames), interval(last, checkpoints));
        loop {
            let time = self.solver.state.time;
            let reached = |instant: f64| time >= instant - ROUNDING * last;
            let end = self.end(reached(last), time - self.record.last_contact);
            if observer.interrupts() && end.is_none() && !self.record.measured.is_empty() {
                let bytes = self.checkpoint()?;
                observer.checkpoint(&bytes)?;
                return Ok(End::Interrupted);
            }
            if checkpoints > 0 && (reached(self.record.next_checkpoint) || end.is_some()) {
                self.record.next_checkpoint += between_checkpoints;
                let bytes = self.checkpoint()?;
                observer.checkpoint(&bytes)?;
            }
            let measured = self.solver.state.cost.steps.is_multiple_of(MEASURED_EVERY) || end.is_some();
            let sampled = reached(self.record.next_sample) || end.is_some();
            let drawn = self.record.pictures.first().is_some_and(|&picture| reached(picture));
            let framed = frames > 0 && reached(self.record.next_frame);
            let left = if reached(last) { last } else { last - time };
            let energies = measured || sampled || drawn || framed;
            self.solver.accelerate(energies, left).map_err(|error| self.error(&error.to_string()))?;
            if self.solver.projectile.as_ref().is_some_and(|sphere| sphere.force != 0.0) {
                self.record.last_contact = time;
            }
            if measured || sampled {
                let sample = measure(self.panel, &self.solver, share, self.record.start, threshold);
                self.record(sample, [measured, sampled], observer)?;
            }
            if drawn {
                self.record.pictures.remove(0);
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

    /// Keeps a measurement for what is said of the run, for its history, or for both.
    ///
    /// # Errors
    /// The balance of energy is lost, or the observer's.
    fn record(
        &mut self,
        sample: Sample,
        [measured, sampled]: [bool; 2],
        observer: &mut (dyn Observer + Send),
    ) -> Result<(), Error> {
        let Record { measured: kept, balance, history, next_sample, .. } = &mut self.record;
        if measured {
            kept.push(sample);
            balance.add(&sample.energies);
            observer.progress(sample.time / self.plan.end, &sample, balance.imbalance());
        }
        let lost = balance.lost();
        if sampled || lost.is_some() {
            history.push(sample);
            *next_sample += self.plan.sample;
            observer.sample(&sample)?;
        }
        lost.map_or(Ok(()), |moved| {
            let moved = number(moved);
            Err(self.error(&format!("the total energy is {moved} % from what it was: not stable")))
        })
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
        Error::Evaluation(format!("case {} at time {}: {reason}", self.case.name, number(self.solver.state.time)))
    }
}
