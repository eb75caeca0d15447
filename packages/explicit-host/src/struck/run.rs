//! A case from its first step to its last.

use std::fmt::Debug;
use std::time::{Duration, Instant};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::checkpoint;
use super::pace::{Estimate, Pace};
use super::plan::Plan;
use super::sample::Sample;
use crate::archive::Archive;
use crate::energies::{Balance, Cost};
use crate::judgement::MEASURED_EVERY;
use crate::lanes::Number;
use crate::snapshot::Snapshot;
use crate::solver::{Solver, SolverState};
use crate::step_limit::Histogram;
use crate::vtu;
use toron_shared::error::Error;
use toron_shared::numbers::number;
use toron_shared::processor_time::thread_time;

/// Times closer than this part of a case's time are the same.
pub const ROUNDING: f64 = 1e-9;

/// What is struck, and how it is measured.
pub trait Struck: Sync {
    /// What a sample has besides the quantities of all scenes.
    type Own: Copy + Debug + Default + PartialEq + Serialize + DeserializeOwned + Send + Sync;
    /// What is followed from step to step.
    type Course: Debug + Default + Serialize + DeserializeOwned + Send;

    /// How many steps lie between two measurements of which the run is judged; with none, it is not.
    const MEASURED_EVERY: Option<u64> = Some(MEASURED_EVERY);
    /// Whether a picture is taken of how it stands at the end, however that comes.
    const DRAWN_AT_END: bool = false;

    fn name(&self) -> &str;
    fn plan(&self) -> &Plan;
    fn single_precision(&self) -> bool;

    /// All that a run depends on, but for its plan.
    fn identity(&self) -> String;

    /// At rest, with what strikes about to touch.
    ///
    /// # Errors
    /// What cannot be run.
    fn solver<T: Number>(&self) -> Result<Solver<T>, Error>;

    /// The radius of what strikes, for pictures.
    fn radius(&self) -> f64 {
        0.0
    }

    /// Measures an instant at which what strikes, which was at `start`, has come as far as the solver says.
    fn sample<T: Number>(&self, solver: &Solver<T>, start: f64) -> Sample<Self::Own>;

    /// Instants at which steps end, in order, and the time that the step after one is a part of. The history has these
    /// instants; where there are none, those of the plan, or the first ones after them.
    fn stops(&self) -> (&[f64], f64) {
        (&[], self.plan().end)
    }

    /// Follows what has come of an instant.
    ///
    /// # Errors
    /// What ends the run.
    fn follow<T: Number>(&self, _solver: &Solver<T>, _course: &mut Self::Course) -> Result<(), Error> {
        Ok(())
    }

    /// Whether it is certain that what strikes goes through.
    fn is_decided(&self, _course: &Self::Course) -> bool {
        false
    }

    /// Whether what still acts on it once that is certain takes little of its speed.
    fn has_settled(&self, _course: &Self::Course) -> bool {
        false
    }

    /// Whether what strikes has left behind what is struck; nothing has touched it for this time.
    fn has_left<T: Number>(&self, _solver: &Solver<T>, _course: &Self::Course, _free: f64) -> bool {
        false
    }
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum End {
    Time,
    /// What strikes has stopped, and the run ends with it.
    Stopped,
    /// It has turned back, and the run has gone on to its end.
    Rebounded,
    /// It has gone through, and nothing has touched it for some time.
    Left,
    /// It is certain that it goes through, though it is still touched.
    Decided,
    /// That was certain, and what still acts on it now takes little of its speed.
    Settled,
    /// Somebody has asked the program to end.
    Interrupted,
    /// The run could not go on.
    Failed,
}

/// The instant at which it was certain that what strikes goes through.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Decision {
    pub time: f64,
    /// Of what strikes, in the direction of the blow.
    pub speed: f64,
    /// What it had cost until then.
    pub steps: u64,
    pub processor: Duration,
}

/// What came of a case.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Outcome<E, C> {
    /// Measured every [`MEASURED_EVERY`] steps: what is said of the run comes from these.
    pub measured: Vec<Sample<E>>,
    pub balance: Balance,
    /// Measured when it was asked for.
    pub history: Vec<Sample<E>>,
    pub snapshots: Vec<Snapshot>,
    pub course: C,
    pub end: End,
    /// When it was decided, where that was looked for and came.
    pub decision: Option<Decision>,
    /// When the first element failed.
    pub failed: Option<f64>,
    /// Why it could not go on.
    pub failure: Option<String>,
    pub elements: usize,
    pub cost: Cost,
    pub searches: u64,
    /// For how long each of [`Limiter::ALL`](crate::step_limit::Limiter::ALL) has limited the step, and how long the
    /// elements' own steps were.
    pub limited: [f64; 5],
    pub histogram: Histogram,
    /// Mass that torn ends were lent.
    pub lent: f64,
    pub wall: Duration,
}

/// What came of a case of this kind.
pub type OutcomeOf<S> = Outcome<<S as Struck>::Own, <S as Struck>::Course>;

impl<E: Copy + Default, C> Outcome<E, C> {
    /// The last measurement.
    pub fn last(&self) -> Sample<E> {
        self.measured.last().copied().unwrap_or_default()
    }

    /// The time up to which the run is known.
    pub fn last_time(&self) -> f64 {
        self.history.last().map_or(0.0, |sample| sample.time).max(self.last().time)
    }

    /// Number of steps times elements.
    pub fn zone_cycles(&self) -> f64 {
        self.cost.steps as f64 * self.elements as f64
    }

    /// Processor time of a step of an element, in nanoseconds.
    pub fn ns_per_zone_cycle(&self) -> f64 {
        self.cost.processor.as_nanos() as f64 / self.zone_cycles().max(1.0)
    }
}

/// Receives what a run has to tell on its way.
pub trait Observer<E> {
    /// How far the run is: the part of its time, what was measured, and how far the total energy has moved.
    fn progress(&mut self, _fraction: f64, _sample: &Sample<E>, _imbalance: f64) {}

    /// How long the run will take, once.
    fn estimate(&mut self, _estimate: &Estimate) {}

    /// A line of the history.
    ///
    /// # Errors
    /// What ends the run.
    fn sample(&mut self, _sample: &Sample<E>) -> Result<(), Error> {
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
    fn resumed(&mut self, _fraction: f64, _samples: &[Sample<E>], _frames: &[f64]) -> Result<(), Error> {
        Ok(())
    }

    /// Whether the run is to write its checkpoint and end.
    fn interrupts(&self) -> bool {
        false
    }
}

impl<E> Observer<E> for () {}

/// Runs a case, from a checkpoint on if there is one; one of a case that has ended is its outcome.
///
/// # Errors
/// What cannot be run; a checkpoint that is not this case's.
pub fn run<S: Struck>(
    struck: &S,
    checkpoint: Option<&[u8]>,
    observer: &mut (dyn Observer<S::Own> + Send),
) -> Result<OutcomeOf<S>, Error> {
    if let Some(outcome) = checkpoint.map(|bytes| checkpoint::outcome(struck, bytes)).transpose()?.flatten() {
        return Ok(outcome);
    }
    if struck.single_precision() {
        Run::new(struck, struck.solver::<f32>()?).resume(checkpoint, observer)
    } else {
        Run::new(struck, struck.solver::<f64>()?).resume(checkpoint, observer)
    }
}

struct Run<'a, S: Struck, T> {
    struck: &'a S,
    /// The case's, but for the time between samples, which is the checkpoint's.
    plan: Plan,
    solver: Solver<T>,
    record: Record<S::Own, S::Course>,
    /// Its threads' processor time up to which the run's own is counted.
    counted: Duration,
}

/// What a run has recorded, and what it is going to.
#[derive(Debug, Default, Serialize, Deserialize)]
struct Record<E, C> {
    measured: Vec<Sample<E>>,
    balance: Balance,
    history: Vec<Sample<E>>,
    snapshots: Vec<Snapshot>,
    course: C,
    decision: Option<Decision>,
    /// When the frames were written.
    frames: Vec<f64>,
    /// Where what strikes was at first.
    start: f64,
    next_sample: f64,
    /// How many of the stops are behind it.
    stops: usize,
    next_frame: f64,
    next_checkpoint: f64,
    last_contact: f64,
    /// When pictures will be taken, in order.
    pictures: Vec<f64>,
}

impl<'a, S: Struck, T: Number> Run<'a, S, T> {
    fn new(struck: &'a S, solver: Solver<T>) -> Self {
        let start = solver.striker.as_ref().map_or(0.0, |striker| striker.position);
        let plan = struck.plan().clone();
        let mut pictures = plan.pictures.clone();
        pictures.sort_by(f64::total_cmp);
        let next_checkpoint = plan.between_checkpoints();
        let record = Record { start, pictures, next_checkpoint, ..Record::default() };
        Run { struck, plan, solver, record, counted: Duration::ZERO }
    }

    /// Counts the processor time that has passed.
    fn count(&mut self) {
        let now = self.threads_time();
        self.solver.state.cost.processor += now.saturating_sub(self.counted);
        self.counted = now;
    }

    /// The processor time of the threads that the run is computed in: those of the pool that it is in, or, of a single
    /// body, this one alone, beside which others may have cases of their own.
    fn threads_time(&self) -> Duration {
        match self.solver.bodies.len() {
            ..2 => thread_time(),
            _ => rayon::broadcast(|_| thread_time()).into_iter().sum(),
        }
    }

    fn checkpoint(&mut self) -> Result<Vec<u8>, Error> {
        self.count();
        let time = self.solver.state.time;
        let Run { struck, plan, record, solver, .. } = self;
        let contents = |archive: &mut Archive<'_>| archive.keep(record).and_then(|()| solver.archive(archive));
        checkpoint::of_state(*struck, plan.clone(), time, contents)
    }

    fn read(&mut self, checkpoint: &[u8]) -> Result<(), Error> {
        let (head, rest) = checkpoint::check(self.struck, checkpoint)?;
        let mut archive = Archive::Reads(rest);
        let read = archive.keep(&mut self.record).and_then(|()| self.solver.archive(&mut archive));
        if read.is_err() || !matches!(archive, Archive::Reads([])) {
            return Err(checkpoint::damaged(self.struck));
        }
        self.plan.sample = head.plan.sample;
        self.change_plan(&head.plan);
        Ok(())
    }

    /// Goes over from the plan of the run that wrote the checkpoint to this one's. Where they are the same nothing
    /// changes.
    fn change_plan(&mut self, old: &Plan) {
        let (new, time) = (&self.plan, self.solver.state.time);
        let later = |interval: f64, round: fn(f64) -> f64| interval * round(time / interval);
        if (new.end, new.frames) != (old.end, old.frames) {
            // The frame of this time comes after the checkpoint.
            self.record.next_frame = later(new.between_frames(), |count| (count - ROUNDING).ceil());
        }
        if (new.end, new.checkpoints) != (old.end, old.checkpoints) {
            let next = |count: f64| (count + ROUNDING).floor() + 1.0;
            self.record.next_checkpoint = later(new.between_checkpoints(), next);
        }
        if new.pictures != old.pictures {
            let pending = |picture: &f64| *picture >= time || self.record.pictures.contains(picture);
            let mut pictures: Vec<f64> = new.pictures.iter().copied().filter(pending).collect();
            pictures.sort_by(f64::total_cmp);
            self.record.pictures = pictures;
        }
    }

    fn resume(
        mut self,
        checkpoint: Option<&[u8]>,
        observer: &mut (dyn Observer<S::Own> + Send),
    ) -> Result<OutcomeOf<S>, Error> {
        if let Some(checkpoint) = checkpoint {
            self.read(checkpoint)?;
            let fraction = self.solver.state.time / self.plan.end;
            observer.resumed(fraction, &self.record.history, &self.record.frames)?;
        }
        let begun = Instant::now();
        // Inside rayon's threads: entering them in every step would cost as much as a small panel's contact.
        let end = rayon::scope(|_| {
            self.counted = self.threads_time();
            let end = self.steps(observer);
            self.count();
            end
        });
        let Run { struck, solver, mut record, .. } = self;
        if S::DRAWN_AT_END {
            record.snapshots.push(Snapshot::of(&solver, struck.radius()));
        }
        Ok(Outcome {
            measured: record.measured,
            balance: record.balance,
            history: record.history,
            snapshots: record.snapshots,
            course: record.course,
            decision: record.decision,
            failed: solver.state.failed,
            end: *end.as_ref().unwrap_or(&End::Failed),
            failure: end.err().map(|error| error.to_string()),
            elements: solver.bodies.iter().map(|body| body.mesh.elements.len()).sum(),
            cost: solver.state.cost,
            searches: solver.mutual.as_ref().map_or(0, |contact| contact.state.searches),
            limited: solver.state.limited,
            histogram: solver.state.histogram,
            lent: solver.state.lent,
            wall: begun.elapsed(),
        })
    }

    fn steps(&mut self, observer: &mut (dyn Observer<S::Own> + Send)) -> Result<End, Error> {
        let Plan { end: last, frames, checkpoints, .. } = self.plan;
        let (between_frames, between_checkpoints) = (self.plan.between_frames(), self.plan.between_checkpoints());
        let elements = self.solver.bodies.iter().map(|body| body.mesh.elements.len()).sum();
        let (mut pace, mut is_estimated) = (None, false);
        loop {
            let time = self.solver.state.time;
            let reached = |instant: f64| time >= instant - ROUNDING * last;
            let end = self.end(reached(last));
            if observer.interrupts() && end.is_none() && self.solver.state.cost.steps > 0 {
                let bytes = self.checkpoint()?;
                observer.checkpoint(&bytes)?;
                return Ok(End::Interrupted);
            }
            if checkpoints > 0 && (reached(self.record.next_checkpoint) || end.is_some()) {
                self.record.next_checkpoint += between_checkpoints;
                let bytes = self.checkpoint()?;
                observer.checkpoint(&bytes)?;
            }
            let steps = self.solver.state.cost.steps;
            let measured = S::MEASURED_EVERY.is_some_and(|every| steps.is_multiple_of(every)) || end.is_some();
            let (stops, after_stop) = self.struck.stops();
            let stop = stops.get(self.record.stops).copied();
            let stopped = reached(stop.unwrap_or(last));
            self.record.stops += usize::from(stopped);
            let sampled = if stops.is_empty() { reached(self.record.next_sample) } else { stopped } || end.is_some();
            let drawn = self.record.pictures.first().is_some_and(|&picture| reached(picture));
            let framed = frames > 0 && reached(self.record.next_frame);
            let left = if stopped { after_stop } else { stop.unwrap_or(self.plan.next_mark(time)) - time };
            let energies = measured || sampled || drawn || framed;
            self.solver.accelerate(energies, left).map_err(|error| self.error(&error.to_string()))?;
            if self.solver.striker.as_ref().is_some_and(|striker| striker.force != 0.0) {
                self.record.last_contact = time;
            }
            self.struck
                .follow(&self.solver, &mut self.record.course)
                .map_err(|error| self.error(&error.to_string()))?;
            self.decide();
            if measured || sampled {
                let sample = self.struck.sample(&self.solver, self.record.start);
                self.record(sample, [measured, sampled], observer)?;
            }
            if drawn {
                self.record.pictures.remove(0);
                self.record.snapshots.push(Snapshot::of(&self.solver, self.struck.radius()));
            }
            if framed {
                self.record.next_frame += between_frames;
                self.record.frames.push(time);
                observer.frame(time, &vtu::unstructured_grid(&self.solver)?)?;
            }
            if let Some(end) = end {
                return Ok(end);
            }
            self.solver.displace();
            if !is_estimated {
                let (now, steps) = (self.solver.state.time, self.solver.state.cost.steps);
                // From the second step on: the first one searches for all contact.
                let pace = pace.get_or_insert_with(|| Pace::new(now, steps));
                if let Some(estimate) = pace.estimate([now, last], steps, elements) {
                    observer.estimate(&estimate);
                    is_estimated = true;
                }
            }
        }
    }

    /// Keeps a measurement for what is said of the run, for its history, or for both.
    ///
    /// # Errors
    /// The balance of energy is lost, or the observer's.
    fn record(
        &mut self,
        sample: Sample<S::Own>,
        [measured, sampled]: [bool; 2],
        observer: &mut (dyn Observer<S::Own> + Send),
    ) -> Result<(), Error> {
        let Record { measured: kept, balance, history, next_sample, .. } = &mut self.record;
        if measured {
            kept.push(sample);
            balance.add(&sample.energies);
        }
        if measured || S::MEASURED_EVERY.is_none() {
            observer.progress(sample.time / self.plan.end, &sample, balance.imbalance());
        }
        let lost = balance.lost().filter(|_| S::MEASURED_EVERY.is_some());
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

    /// Keeps the instant at which it is certain that what strikes goes through.
    fn decide(&mut self) {
        if !self.plan.decides || self.record.decision.is_some() || !self.struck.is_decided(&self.record.course) {
            return;
        }
        self.count();
        let SolverState { time, cost, .. } = &self.solver.state;
        let speed = self.solver.striker.as_ref().map_or(0.0, |striker| -striker.velocity);
        self.record.decision = Some(Decision { time: *time, speed, steps: cost.steps, processor: cost.processor });
    }

    /// Whether the run is over.
    fn end(&self, at_end: bool) -> Option<End> {
        let time = self.solver.state.time;
        let stands = self.solver.striker.as_ref().is_some_and(|striker| striker.velocity >= 0.0);
        let decision = self.record.decision.filter(|_| self.plan.decides);
        if stands && decision.is_some() {
            return Some(End::Settled);
        }
        if stands {
            let end = if self.plan.rebounds { End::Rebounded } else { End::Stopped };
            return (at_end || !self.plan.rebounds).then_some(end);
        }
        if self.struck.has_left(&self.solver, &self.record.course, time - self.record.last_contact) {
            return Some(End::Left);
        }
        match decision {
            Some(_) if self.plan.settles => {
                let settled = self.struck.has_settled(&self.record.course).then_some(End::Settled);
                // Fate comes first: the time that is over has not undone it.
                settled.or(at_end.then_some(End::Decided))
            }
            Some(_) => Some(End::Decided),
            None => at_end.then_some(End::Time),
        }
    }

    fn error(&self, reason: &str) -> Error {
        let (name, time) = (self.struck.name(), number(self.solver.state.time));
        Error::Evaluation(format!("case {name} at time {time}: {reason}"))
    }
}
