//! What a law is to those who call it: its name, its tables, and where these have what every host needs.

use core::ops::Range;

use super::error::Error;
use super::number::real::Real;
use super::parameters::{self, FIBRE, LINEAR_FIBRE, LINEAR_SECOND_AXIS, Property};
use super::state::{
    self, ALIVE, ENERGIES, FAILED, FRICTIONAL_ALIVE, FRICTIONAL_FAILED, FRICTIONAL_LOST, INVARIANTS, LINEAR_ALIVE,
    LINEAR_FAILED, LINEAR_WORK, StateVariable,
};
use super::status::LAW;

/// A law as the hosts see it.
#[derive(Debug)]
pub struct Description {
    /// What the law is called in listings.
    pub title: &'static str,
    /// The tables of properties and of state variables, in the order in which every host has them.
    pub properties: &'static [Property],
    pub state: &'static [StateVariable],
    /// The directions among the properties: first the fibre, which each point may have its own of, then others. Hosts
    /// that turn a material turn all of them.
    pub directions: &'static [Direction],
    /// Indices into the state: the latch, the flag for element deletion, and the energies, whose sum is the energy per
    /// reference volume.
    pub failed: usize,
    pub alive: usize,
    pub energies: Range<usize>,
    /// Index into the state: the energy lost since the start, per reference volume, of a law that loses any.
    pub lost: Option<usize>,
    /// What a step depends on besides F at its end and the old state.
    pub reads: Reads,
    /// Of a law that may refuse a point by a status of its own: why, as messages have it where that is
    /// [`status::LAW`](super::status::LAW).
    pub refusal: Option<&'static str>,
}

/// What a law reads besides F at the end of a step and the old state. A host that has not what its law reads is told so
/// by an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reads {
    /// F at the start of the step.
    pub old_gradient: bool,
    /// The length of the step.
    pub time_increment: bool,
    /// The time at its end.
    pub time: bool,
    /// The temperature at its end.
    pub temperature: bool,
}

impl Reads {
    /// None of these.
    pub const NOTHING: Reads = Reads { old_gradient: false, time_increment: false, time: false, temperature: false };
}

/// The most directions of a law.
pub const MOST_DIRECTIONS: usize = 3;

/// Three properties that are the components of a vector of any length in the reference placement.
#[derive(Clone, Copy, Debug)]
pub struct Direction {
    /// What messages call it.
    pub name: &'static str,
    /// The place of its first component among the properties.
    pub first: usize,
    /// Whether it may be 0, where any direction will do; else that is an error.
    pub may_be_zero: bool,
}

impl Direction {
    /// A direction that must not be 0.
    pub const fn new(name: &'static str, first: usize) -> Self {
        Direction { name, first, may_be_zero: false }
    }

    /// The direction of the fibre.
    pub const fn fibre(first: usize) -> Self {
        Direction::new("fibre direction", first)
    }

    /// The vector that properties have there.
    pub fn of<T: Real + Into<f64>>(&self, properties: &[T]) -> [f64; 3] {
        let components = properties.get(self.first..).and_then(<[T]>::first_chunk);
        components.map_or([0.0; 3], |&[x, y, z]| [x.into(), y.into(), z.into()]) // there are so many properties
    }
}

/// The hyperelastic law.
pub const HYPERELASTIC: Description = Description {
    title: "hyperelastic yarn law",
    properties: &parameters::HYPERELASTIC,
    state: &state::HYPERELASTIC,
    directions: &[Direction::fibre(FIBRE)],
    failed: FAILED,
    alive: ALIVE,
    energies: ENERGIES..INVARIANTS,
    reads: Reads::NOTHING,
    lost: None,
    refusal: None,
};

/// The law with friction between the fibres of a section.
pub const FRICTIONAL: Description = Description {
    title: "yarn law with friction",
    properties: &parameters::FRICTIONAL,
    state: &state::FRICTIONAL,
    directions: &[Direction::fibre(FIBRE)],
    failed: FRICTIONAL_FAILED,
    alive: FRICTIONAL_ALIVE,
    energies: ENERGIES..INVARIANTS,
    reads: Reads::NOTHING,
    lost: Some(FRICTIONAL_LOST),
    refusal: None,
};

/// The linear elastic law.
pub const LINEAR_ELASTIC: Description = Description {
    title: "linear elastic law",
    properties: &parameters::LINEAR_ELASTIC,
    state: &state::LINEAR_ELASTIC,
    directions: &[
        Direction::fibre(LINEAR_FIBRE),
        Direction { may_be_zero: true, ..Direction::new("second axis", LINEAR_SECOND_AXIS) },
    ],
    failed: LINEAR_FAILED,
    alive: LINEAR_ALIVE,
    energies: LINEAR_WORK..LINEAR_WORK + 1,
    reads: Reads { old_gradient: true, ..Reads::NOTHING },
    lost: None,
    refusal: None,
};

impl Description {
    /// How many entries of F a host keeps behind the state, by columns: those of the start of a step, where it depends
    /// on them.
    pub(crate) const fn kept(&self) -> usize {
        if self.reads.old_gradient { 9 } else { 0 }
    }

    /// Whether the law has a fibre.
    pub const fn has_fibre(&self) -> bool {
        !self.directions.is_empty()
    }

    /// The places of the fibre direction among the properties; none of a law without fibre.
    pub const fn fibre_components(&self) -> Range<usize> {
        match self.directions {
            [Direction { first, .. }, ..] => *first..*first + 3,
            [] => 0..0,
        }
    }

    /// The worst status code of a call: as an error with the law's own message where the law has refused a point.
    ///
    /// # Errors
    /// It is [`status::LAW`](super::status::LAW) of a law that says why.
    pub const fn told(&self, code: i32) -> Result<i32, Error> {
        match self.refusal {
            Some(text) if code == LAW => Err(Error::Setting { code, text }),
            _ => Ok(code),
        }
    }

    /// The error of a point, with the law's own message where the law has refused it.
    pub const fn named(&self, error: Error) -> Error {
        match (error, self.refusal) {
            (Error::Point { code: LAW, index }, Some(text)) => Error::PointOfLaw { code: LAW, index, text },
            _ => error,
        }
    }

    /// The energy per reference volume of a state.
    pub fn energy<T: Real>(&self, state: &[T]) -> T {
        let energies = state.get(self.energies.clone()).unwrap_or_default().iter().copied();
        energies.reduce(|sum, energy| sum + energy).unwrap_or(T::splat(0.0))
    }

    /// The energy lost per reference volume of a state; 0 of a law that loses none.
    pub fn lost_energy<T: Real>(&self, state: &[T]) -> T {
        self.lost.and_then(|place| state.get(place)).copied().unwrap_or(T::splat(0.0))
    }

    /// How many numbers a host keeps for a point: the state, and these entries of F.
    pub const fn history(&self) -> usize {
        self.state.len() + self.kept()
    }
}
