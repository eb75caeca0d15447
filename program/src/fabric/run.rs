//! A case from its first step to its last.

use std::time::{Duration, Instant};

use super::measure::{Sample, measure};
use super::model::{share, solver};
use super::scene::{Case, Scene};
use crate::common::error::Error;
use crate::common::units::number;
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
    /// The sphere turns back.
    Stopped,
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
}

impl Observer for () {}

/// Runs a case.
///
/// # Errors
/// A material that the host cannot use.
pub fn run(scene: &Scene, case: &Case, panel: &Model, observer: &mut (dyn Observer + Send)) -> Result<Outcome, Error> {
    if case.single_precision {
        Ok(Run::new(scene, case, panel, solver::<f32>(scene, case, panel)?).run(observer))
    } else {
        Ok(Run::new(scene, case, panel, solver::<f64>(scene, case, panel)?).run(observer))
    }
}

struct Run<'a, T> {
    scene: &'a Scene,
    case: &'a Case,
    panel: &'a Model,
    solver: Solver<T>,
    snapshots: Vec<Snapshot>,
    failed: Option<f64>,
}

impl<'a, T: Number> Run<'a, T> {
    fn new(scene: &'a Scene, case: &'a Case, panel: &'a Model, solver: Solver<T>) -> Self {
        Run { scene, case, panel, solver, snapshots: Vec::new(), failed: None }
    }

    fn run(mut self, observer: &mut (dyn Observer + Send)) -> Outcome {
        let begun = Instant::now();
        let mut samples = Vec::new();
        // Inside rayon's threads: entering them in every step would cost as much as a small panel's contact.
        let end = rayon::scope(|_| self.steps(&mut samples, observer));
        Outcome {
            samples,
            snapshots: self.snapshots,
            failed: self.failed,
            end: *end.as_ref().unwrap_or(&End::Failed),
            failure: end.err(),
            elements: self.panel.elements.len(),
            cost: self.solver.cost,
            searches: self.solver.mutual.as_ref().map_or(0, |contact| contact.searches),
            wall: begun.elapsed(),
        }
    }

    fn steps(&mut self, samples: &mut Vec<Sample>, observer: &mut (dyn Observer + Send)) -> Result<End, Error> {
        let start = self.solver.projectile.as_ref().map_or(0.0, |sphere| sphere.position);
        let share = share(self.scene);
        let threshold = self.scene.woven.geometry.weave.threads.iter().map(|thread| thread.height).fold(0.0, f64::max);
        self.solver.all_outputs = false;
        let (mut next, mut next_frame, mut last_contact) = (0.0, 0.0, 0.0);
        let frame = self.case.end / self.case.frames.max(1) as f64;
        let mut pictures = self.case.pictures.clone();
        pictures.sort_by(|a, b| b.total_cmp(a));
        loop {
            let time = self.solver.time;
            let reached = |instant: f64| time >= instant - ROUNDING * self.case.end;
            let end = self.end(reached(self.case.end), time - last_contact);
            let sampled = reached(next) || end.is_some();
            let drawn = pictures.last().is_some_and(|&picture| reached(picture));
            let framed = self.case.frames > 0 && reached(next_frame);
            let left = if reached(self.case.end) { self.case.end } else { self.case.end - time };
            self.solver.accelerate(sampled || drawn || framed, left).map_err(|error| self.error(&error.to_string()))?;
            if self.solver.projectile.as_ref().is_some_and(|sphere| sphere.force != 0.0) {
                last_contact = time;
            }
            let failed = || self.solver.bodies.iter().any(|yarn| yarn.deleted.len() > yarn.collapsed);
            if self.failed.is_none() && failed() {
                self.failed = Some(time);
            }
            if sampled {
                let sample = measure(self.panel, &self.solver, share, start, threshold);
                samples.push(sample);
                next += self.case.sample;
                let imbalance = imbalance(samples);
                observer.progress(time / self.case.end, &sample, imbalance);
                if imbalance.is_nan() || imbalance > LARGEST_IMBALANCE {
                    let moved = number(100.0 * imbalance);
                    return Err(self.error(&format!("the total energy is {moved} % from what it was: not stable")));
                }
            }
            if drawn {
                pictures.pop();
                self.snapshots.push(Snapshot::of(&self.solver, self.case.sphere.radius));
            }
            if framed {
                next_frame += frame;
                observer.frame(time, &vtu::unstructured_grid(&self.solver))?;
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
            return Some(End::Stopped);
        }
        // In which it goes on by its own radius.
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
