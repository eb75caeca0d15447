//! The bodies together: forces, contact, central differences, the balance of energy.

use std::f64::consts::PI;
use std::time::Instant;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::archive::Archive;
use super::block::{Scratch, StepOptions};
use super::body::Body;
use super::energies::{Cost, Energies};
use super::global_estimate::{Estimate, iterate};
use super::lanes::Number;
use super::medium::Medium;
use super::mutual_contact::MutualContact;
use super::step_limit::{BETWEEN_LOOKS, Histogram, Limiter, StepLimit};
use super::striker::Striker;
use toron::law::status;
use toron_shared::error::Error;

/// A step is this fraction of the longest one that the bounds of frequency and damping allow.
const SAFETY: f64 = 0.9;
/// An element that may fail has collapsed, and is deleted, when its own stable step, its fibre taken for tense, is this
/// fraction of the first one of all: before the break steps fall to 0.67 of it. A [swollen](super::block::SWOLLEN) one
/// has collapsed as well.
const COLLAPSED: f64 = 0.2;
/// Torn ends may be lent mass where they take the step below this part of the first one.
const HALF: f64 = 0.5;
/// How often the first step is looked for: by then it stays.
const FIRST_STEPS: usize = 12;
/// How often the nodes' masses are shared anew among their elements, at the end of that.
const SHARINGS: usize = 3;
/// A step that is shorter than this part of the stable one is so since something ends with it.
const NEARLY: f64 = 0.95;
/// What limits the step is looked for from this part of the last rate on.
const NEAR: f64 = 0.8;
/// And from this part on of the rate that it has now: rates are known to 2⁻⁷ of themselves, so that it is found again.
const BELOW: f64 = 0.99;
/// The run ends with an error when the step is this fraction of the first one: elements that do not fail have
/// collapsed.
const SHORTEST: f64 = 1e-4;

/// Bodies with their motion, their history and their energies.
#[derive(Debug)]
pub struct Solver<T> {
    pub bodies: Vec<Body<T>>,
    pub media: Vec<Medium<T>>,
    pub striker: Option<Striker>,
    /// Contact of the bodies with one another.
    pub mutual: Option<MutualContact>,
    /// How the supports move; at their own speed without.
    pub ramp: Option<Ramp>,
    /// A step is no longer than this: contact that closes within a step has not been in the bound of its length.
    pub longest: f64,
    /// Whether the laws give energies and invariants in every step, or only where they are measured.
    pub all_outputs: bool,
    /// How much mass torn ends may be lent in all; with none nothing is.
    pub shred_mass: f64,
    pub state: SolverState,
    scratch: Scratch<T>,
    /// Of this step.
    limit: StepLimit,
}

/// What a solver remembers from step to step, besides what its bodies and contacts do.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct SolverState {
    pub time: f64,
    step: f64,
    /// The last stable step, without what is kept for safety: by the elements' bound, and by that or the global
    /// estimate.
    bound: Option<f64>,
    stable: Option<f64>,
    pub estimate: Estimate,
    /// The first one.
    first_step: Option<f64>,
    /// When the first element failed: one that was deleted by its law, and not since it had collapsed.
    pub failed: Option<f64>,
    viscosity: f64,
    external: f64,
    /// Mass that torn ends have been lent, and the kinetic energy that this has taken.
    pub lent: f64,
    lent_energy: f64,
    pub energies: Energies,
    pub cost: Cost,
    /// For how long each of [`Limiter::ALL`] has limited the step, and how long the elements' own steps are.
    pub limited: [f64; 5],
    pub histogram: Histogram,
}

/// Supports that start and end smoothly: after this time they have gone as far as at their own speed in 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ramp {
    pub start: f64,
    pub duration: f64,
    /// Free nodes are braked by this many times their momentum, before the start and after it.
    pub brake: [f64; 2],
}

/// Times closer than this part of themselves are the same.
const ROUNDING: f64 = 1e-9;

impl Ramp {
    /// The part of the way that they have gone at a time: its speed is a cosine's arch.
    pub fn share(&self, time: f64) -> f64 {
        let part = ((time - self.start) / self.duration).clamp(0.0, 1.0);
        part - (2.0 * PI * part).sin() / (2.0 * PI)
    }

    fn brake(&self, time: f64) -> f64 {
        self.brake[usize::from(time >= self.start * (1.0 - ROUNDING))]
    }
}

impl<T: Number> Solver<T> {
    /// Bodies at rest, made of these media.
    pub fn new(bodies: Vec<Body<T>>, media: Vec<Medium<T>>) -> Self {
        Solver {
            bodies,
            media,
            striker: None,
            mutual: None,
            ramp: None,
            longest: f64::INFINITY,
            all_outputs: true,
            shred_mass: 0.0,
            state: SolverState::default(),
            scratch: Scratch::default(),
            limit: StepLimit::default(),
        }
    }

    /// The forces of this instant and the velocities in the middle of the coming step, which ends within `left`. With
    /// `measured`, the energies are those of this instant. [`displace`](Self::displace) completes the step.
    ///
    /// # Errors
    /// The law refuses its call, or elements have collapsed so far that there is no stable step.
    pub fn accelerate(&mut self, measured: bool, left: f64) -> Result<(), Error> {
        T::accelerate(self, measured, left)
    }

    /// Displacements at the end of the step.
    pub fn displace(&mut self) {
        T::displace(self);
    }

    /// Its state between two steps.
    ///
    /// # Errors
    /// The archive's.
    pub fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), postcard::Error> {
        archive.keep(&mut self.state)?;
        archive.keep(&mut self.striker)?;
        self.bodies.iter_mut().try_for_each(|body| body.archive(&self.media, archive))?;
        self.mutual.iter_mut().try_for_each(|contact| contact.archive(archive))
    }

    pub(super) fn compute_accelerations(&mut self, measured: bool, left: f64) -> Result<(), Error> {
        let started = Instant::now();
        let first = self.state.first_step.unwrap_or(0.0) / SAFETY;
        let options = StepOptions {
            law_outputs: measured || self.all_outputs,
            energy_balance: measured,
            step: self.state.step,
            time: self.state.time,
            shortest: COLLAPSED * first,
            has_failed: self.state.failed.is_some(),
            reference: self.state.bound.unwrap_or(f64::INFINITY),
            trial: self.state.stable.filter(|_| self.has_estimate() && self.state.estimate.is_due()),
        };
        self.compute_forces(options)?;
        let computed = Instant::now();
        self.apply_contact();
        if let (Some(reference), Some(mutual)) = (options.trial, &self.mutual) {
            let growth = iterate(&mut self.bodies, mutual, self.striker.as_ref());
            if growth.is_finite() {
                self.state.estimate.take(growth, reference);
            } else {
                // Begins anew.
                self.state.estimate = Estimate::default();
                self.bodies.iter_mut().for_each(|body| body.state.trial.clear());
            }
        }
        let met = Instant::now();
        self.release_nodes();
        match self.state.first_step {
            None => self.find_first_step(options)?,
            Some(_) => self.stable_step()?,
        }
        self.lend_to_shreds();
        let stable = SAFETY * self.state.stable.unwrap_or(f64::INFINITY);
        let before = self.state.step;
        // Equal steps to the end, rather than a very short last one.
        self.state.step = left / (left / stable.min(self.longest)).ceil();
        self.count_step(stable);
        if let Some(ramp) = self.ramp {
            let speed = (ramp.share(self.state.time + self.state.step) - ramp.share(self.state.time)) / self.state.step;
            self.bodies.iter_mut().for_each(|body| body.set_speed(speed));
        }
        let brake = self.ramp.map_or(0.0, |ramp| ramp.brake(self.state.time));
        if brake > 0.0 {
            let power: f64 = self.bodies.iter_mut().map(|body| body.brake(brake)).sum();
            self.state.viscosity += 0.5 * (before + self.state.step) * power;
        }
        self.update_velocities(0.5 * (before + self.state.step), measured);
        self.state.cost.steps += 1;
        self.state.cost.law += self.bodies.iter().map(|body| body.sums.law).sum();
        self.state.cost.elements += computed - started;
        self.state.cost.contact += met - computed;
        self.state.cost.nodes += met.elapsed();
        Ok(())
    }

    /// The stable step from what limits the elements, in whose rates damping is held against the last stable step: a
    /// longer one is damped less than that says, and a shorter one more, at most as the ratio of the two.
    fn stable_step(&mut self) -> Result<(), Error> {
        match &mut self.bodies[..] {
            [body] => body.rate_contact(),
            bodies => bodies.par_iter_mut().for_each(Body::rate_contact),
        }
        let mut expected = self.state.bound.map_or(0.0, |bound| NEAR * 4.0 / (bound * bound));
        if self.shred_mass == 0.0 {
            // What limited the last step limits this one, or is not far from what does.
            let now = self.bodies.iter().map(Body::last_worst_rate).fold(0.0, f64::max);
            expected = expected.max(BELOW * now);
        }
        match &mut self.bodies[..] {
            [body] => body.limit_step(expected),
            bodies => bodies.par_iter_mut().for_each(|body| body.limit_step(expected)),
        }
        let worst =
            |bodies: &[Body<T>]| bodies.iter().fold(StepLimit::default(), |worst, body| worst.worse(body.limit));
        let mut limit = worst(&self.bodies);
        if limit.rate == 0.0 {
            self.bodies.iter_mut().for_each(|body| body.limit_step(0.0));
            limit = worst(&self.bodies);
        }
        self.limit = limit;
        let rate = limit.rate + self.striker.as_ref().map_or(0.0, Striker::own_rate);
        let (mut longer, last) = (2.0 / rate.sqrt(), self.state.bound);
        if let (true, Some(first)) = (rate == 0.0, self.state.first_step) {
            // Nothing is left that limits it.
            longer = 2.0 * first / SAFETY;
        }
        let stable = last.filter(|&last| longer < last).map_or(longer, |last| longer * longer / last);
        let first = self.state.first_step.unwrap_or(SAFETY * stable);
        self.state.bound = Some(stable);
        self.state.stable = Some(stable.max(self.estimated_step(rate)));
        if rate.is_nan() || SAFETY * stable <= SHORTEST * first {
            let step = SAFETY * stable;
            return Err(Error::Evaluation(format!(
                "the stable step is {step:.1e}, from {first:.1e} at first: elements have collapsed"
            )));
        }
        Ok(())
    }

    /// Whether the stable step is estimated: contact adds to what elements have alone, their stiffness is bounded by
    /// direction, and nothing has failed. After a break it would save a few steps in a hundred.
    fn has_estimate(&self) -> bool {
        self.mutual.is_some() && self.state.failed.is_none() && self.media.iter().all(Medium::is_bounded_by_direction)
    }

    /// The stable step by the global estimate, where the elements' bound is this rate; 0 where that is not larger.
    fn estimated_step(&mut self, bound: f64) -> f64 {
        if !self.has_estimate() {
            return 0.0;
        }
        // The step is no longer than what elements without contact, and contact without elements, allow without safety.
        let alone = SAFETY * SAFETY * self.bodies.iter().map(Body::rate_alone).fold(0.0, f64::max);
        let Some(rate) = self.state.estimate.rate(bound, alone) else { return 0.0 };
        let own = self.striker.as_ref().map_or(0.0, Striker::own_rate);
        self.state.estimate.stable_step(rate + own)
    }

    /// At first there is no step that damping could be held against: it is found by repeating what limits the elements.
    fn find_first_step(&mut self, options: StepOptions) -> Result<(), Error> {
        let met: Vec<_> = self.bodies.iter().map(|body| (body.forces.clone(), body.springs.clone())).collect();
        self.stable_step()?;
        for trial in 0..FIRST_STEPS {
            if trial >= FIRST_STEPS - 2 * SHARINGS && trial % 2 == 0 {
                let media = &self.media;
                self.bodies.par_iter_mut().for_each(|body| body.share_masses(media));
            }
            let reference = self.state.bound.unwrap_or(f64::INFINITY);
            self.compute_forces(StepOptions { reference, trial: None, ..options })?;
            for (body, (forces, springs)) in self.bodies.iter_mut().zip(&met) {
                body.forces.clone_from(forces);
                body.springs.clone_from(springs);
            }
            self.stable_step()?;
        }
        self.state.first_step = self.state.bound.map(|stable| SAFETY * stable);
        Ok(())
    }

    /// Lends mass to what is torn and takes the step below half of the first, up to the part of all mass that may be.
    fn lend_to_shreds(&mut self) {
        let (Some(first), Some(stable)) = (self.state.first_step, self.state.bound) else { return };
        let half = HALF * first / SAFETY;
        if self.shred_mass <= 0.0 || self.state.failed.is_none() || stable >= half {
            return;
        }
        let rate = 4.0 / (half * half);
        for body in self.bodies.iter_mut().filter(|body| body.limit.rate > rate && !body.state.deleted.is_empty()) {
            let lent = body.lend(&self.media, rate, self.shred_mass - self.state.lent);
            self.state.lent += lent.mass;
            self.state.lent_energy += lent.energy;
        }
    }

    /// Counts what limits the step that is coming, and now and then what the elements' own steps are.
    fn count_step(&mut self, stable: f64) {
        let limiter = if self.state.step < NEARLY * stable { Limiter::Other } else { self.limit.limiter() };
        self.state.limited[limiter as usize] += self.state.step;
        let looks = self.state.cost.steps.is_multiple_of(BETWEEN_LOOKS);
        let Some(first) = self.state.first_step.filter(|_| looks) else { return };
        self.state.histogram.look(stable / first);
        for body in &self.bodies {
            self.state.histogram.add(body, first / SAFETY);
        }
    }

    fn compute_forces(&mut self, options: StepOptions) -> Result<(), Error> {
        let media = &self.media;
        match &mut self.bodies[..] {
            [body] => body.compute_forces(media, &mut self.scratch, options),
            bodies => {
                let work = |scratch: &mut Scratch<T>, body: &mut Body<T>| body.compute_forces(media, scratch, options);
                bodies.par_iter_mut().for_each_init(Scratch::default, work);
            }
        }
        for sums in self.bodies.iter().map(|body| &body.sums) {
            if let Some(code) = sums.refused {
                return Err(Error::Evaluation(format!(
                    "the law refuses its call: {}",
                    status::meaning(code).unwrap_or("no known code")
                )));
            }
            self.state.viscosity += sums.viscosity;
        }
        Ok(())
    }

    fn apply_contact(&mut self) {
        if let Some(contact) = &mut self.mutual {
            contact.apply(&mut self.bodies);
        }
        if let Some(striker) = &mut self.striker {
            striker.meet(&mut self.bodies, self.state.step);
        }
    }

    /// Nodes without elements leave the contact.
    fn release_nodes(&mut self) {
        for (number, body) in self.bodies.iter_mut().enumerate() {
            if !body.release_nodes(&self.media) {
                continue;
            }
            if let Some(striker) = &mut self.striker {
                striker.contacts[number].remove(|node| body.is_loose(node));
            }
            if let Some(contact) = &mut self.mutual {
                contact.remove(number, body);
            }
            if self.state.failed.is_none() && body.state.deleted.len() > body.state.collapsed {
                self.state.failed = Some(self.state.time);
            }
        }
    }

    /// Velocities in the middle of the step; `interval` is the time from the middle of the last one.
    fn update_velocities(&mut self, interval: f64, measured: bool) {
        let kinetic: Vec<f64> = match &mut self.bodies[..] {
            [body] => vec![body.update_velocities(interval, measured)],
            bodies => bodies.par_iter_mut().map(|body| body.update_velocities(interval, measured)).collect(),
        };
        let mut striking = 0.0;
        if let Some(striker) = &mut self.striker {
            let old = striker.velocity;
            if !striker.held {
                striker.velocity += interval * striker.force / striker.mass;
            }
            striking = 0.5 * striker.mass * old * striker.velocity;
        }
        let work = interval * self.external_power();
        self.state.external += work;
        if measured {
            // Half of this interval comes after the instant of the measurement.
            let external = self.state.external - 0.5 * work;
            let kinetic = kinetic.iter().sum();
            self.state.energies = Energies { striker: striking, kinetic, external, ..self.other_energies() };
        }
    }

    /// The power of the reactions at prescribed velocities.
    fn external_power(&self) -> f64 {
        let power = self.bodies.iter().map(Body::external_power).sum();
        match self.striker.as_ref().filter(|striker| striker.held) {
            Some(striker) => power - striker.force * striker.velocity,
            None => power,
        }
    }

    fn other_energies(&self) -> Energies {
        let striker = self.striker.as_ref();
        let mutual = self.mutual.as_ref();
        let internal: Vec<f64> = self.bodies.par_iter().map(|body| body.internal_energy(&self.media)).collect();
        Energies {
            internal: internal.iter().sum(),
            hourglass: self.bodies.iter().map(|body| body.sums.hourglass + body.state.released).sum(),
            friction: striker.map_or(0.0, Striker::dissipated) + mutual.map_or(0.0, |contact| contact.state.dissipated),
            fibres: self.bodies.iter().map(|body| body.lost_energy(&self.media)).sum(),
            viscosity: self.state.viscosity,
            shreds: self.state.lent_energy,
            contact: striker.map_or(0.0, Striker::stored) + mutual.map_or(0.0, |contact| contact.state.stored),
            ..Energies::default()
        }
    }

    pub(super) fn update_displacements(&mut self) {
        let started = Instant::now();
        let step = self.state.step;
        match &mut self.bodies[..] {
            [body] => body.displace(step),
            bodies => bodies.par_iter_mut().for_each(|body| body.displace(step)),
        }
        if let Some(striker) = &mut self.striker {
            striker.moved = step * striker.velocity;
            striker.position += striker.moved;
        }
        self.state.time += step;
        self.state.cost.nodes += started.elapsed();
    }
}

#[cfg(test)]
mod tests;
