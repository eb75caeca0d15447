//! The bodies together: forces, contact, central differences, the balance of energy.

use std::f64::consts::PI;
use std::time::Instant;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::archive::Archive;
use super::block::{Scratch, StepOptions};
use super::body::Body;
use super::energies::{Cost, Energies};
use super::lanes::{Number, largest};
use super::medium::Medium;
use super::mutual_contact::MutualContact;
use super::striker::Striker;
use toron::law::status;
use toron_shared::error::Error;

/// A step is this fraction of the longest one that the bounds of frequency and damping allow.
const SAFETY: f64 = 0.9;
/// An element that may fail has collapsed, and is deleted, when its own stable step is this fraction of the first one
/// of all: it is a torn shred, which no neighbours hold any more. Before the break steps fall to 0.67 of the first,
/// shreds go down to 0.02.
const COLLAPSED: f64 = 0.2;
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
    pub state: SolverState,
    scratch: Scratch<T>,
}

/// What a solver remembers from step to step, besides what its bodies and contacts do.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct SolverState {
    pub time: f64,
    step: f64,
    /// The first stable step.
    first_step: Option<f64>,
    /// When the first element failed: one that was deleted by its law, and not since it had collapsed.
    pub failed: Option<f64>,
    viscosity: f64,
    external: f64,
    pub energies: Energies,
    pub cost: Cost,
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

/// Of all bodies in a step.
#[derive(Clone, Copy, Debug, Default)]
struct Bounds {
    stiffness: f64,
    damping: f64,
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
            state: SolverState::default(),
            scratch: Scratch::default(),
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
        self.bodies.iter_mut().try_for_each(|body| body.archive(archive))?;
        self.mutual.iter_mut().try_for_each(|contact| contact.archive(archive))
    }

    pub(super) fn compute_accelerations(&mut self, measured: bool, left: f64) -> Result<(), Error> {
        let started = Instant::now();
        let shortest = self.state.first_step.map_or(0.0, |first| COLLAPSED * first / SAFETY);
        let options = StepOptions {
            law_outputs: measured || self.all_outputs,
            energy_balance: measured,
            step: self.state.step,
            shortest,
        };
        let bounds = self.compute_forces(options)?;
        let computed = Instant::now();
        self.apply_contact();
        let met = Instant::now();
        self.release_nodes();
        let stable = self.stable_step(bounds)?;
        let before = self.state.step;
        // Equal steps to the end, rather than a very short last one.
        self.state.step = left / (left / stable.min(self.longest)).ceil();
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

    /// Central differences with a damping force that lags by half a step are stable for Δt² ω² + 2 Δt d ≤ 4, that is
    /// Δt ≤ 2/ω (√(1 + ξ²) − ξ) with d = 2 ξ ω.
    fn stable_step(&mut self, bounds: Bounds) -> Result<f64, Error> {
        let striker = self.striker.as_ref().map_or(0.0, Striker::frequency);
        let mutual = self.mutual.as_ref().map_or(0.0, |contact| contact.state.frequency);
        let (k, d) = (bounds.stiffness + striker + mutual, bounds.damping);
        let step = SAFETY * 4.0 / (d + (d * d + 4.0 * k).sqrt());
        let first = *self.state.first_step.get_or_insert(step);
        if step.is_finite() && step > SHORTEST * first {
            return Ok(step);
        }
        Err(Error::Evaluation(format!(
            "the stable step is {step:.1e}, from {first:.1e} at first: elements have collapsed"
        )))
    }

    fn compute_forces(&mut self, options: StepOptions) -> Result<Bounds, Error> {
        let media = &self.media;
        match &mut self.bodies[..] {
            [body] => body.compute_forces(media, &mut self.scratch, options),
            bodies => {
                let work = |scratch: &mut Scratch<T>, body: &mut Body<T>| body.compute_forces(media, scratch, options);
                bodies.par_iter_mut().for_each_init(Scratch::default, work);
            }
        }
        let mut bounds = Bounds::default();
        for sums in self.bodies.iter().map(|body| &body.sums) {
            if let Some(code) = sums.refused {
                return Err(Error::Evaluation(format!(
                    "the law refuses its call: {}",
                    status::meaning(code).unwrap_or("no known code")
                )));
            }
            self.state.viscosity += sums.viscosity;
            bounds.stiffness = largest(bounds.stiffness, sums.stiffness);
            bounds.damping = largest(bounds.damping, sums.damping);
        }
        Ok(bounds)
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
            if !body.release_nodes() {
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
        Energies {
            internal: self.bodies.iter().map(|body| body.internal_energy(&self.media)).sum(),
            hourglass: self.bodies.iter().map(|body| body.sums.hourglass + body.state.released).sum(),
            friction: striker.map_or(0.0, Striker::dissipated) + mutual.map_or(0.0, |contact| contact.state.dissipated),
            fibres: self.bodies.iter().map(|body| body.lost_energy(&self.media)).sum(),
            viscosity: self.state.viscosity,
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
