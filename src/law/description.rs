//! What a law is to those who call it: its name, its tables, and where these have what every host needs.

use core::ops::Range;

use super::number::real::Real;
use super::parameters::{self, FIBRE, LINEAR_FIBRE, LINEAR_SECOND_AXIS, Property};
use super::state::{
    self, ALIVE, ENERGIES, FAILED, FRICTIONAL_ALIVE, FRICTIONAL_FAILED, INVARIANTS, LINEAR_ALIVE, LINEAR_FAILED,
    LINEAR_WORK, StateVariable,
};

/// A law as the hosts see it.
#[derive(Debug)]
pub struct Description {
    /// What the law is called in listings.
    pub title: &'static str,
    pub properties: &'static [Property],
    pub state: &'static [StateVariable],
    /// Index of the first component of the fibre direction among the properties, and that of a second axis; `None` for a law that has
    /// none.
    pub fibre: Option<usize>,
    pub second_axis: Option<usize>,
    /// Indices into the state: the latch, the flag for element deletion, and the energies, whose sum is the energy per reference
    /// volume.
    pub failed: usize,
    pub alive: usize,
    pub energies: Range<usize>,
    /// Whether a step depends on F at its start.
    pub reads_old_gradient: bool,
}

/// The hyperelastic law.
pub const HYPERELASTIC: Description = Description {
    title: "hyperelastic yarn law",
    properties: &parameters::HYPERELASTIC,
    state: &state::HYPERELASTIC,
    fibre: Some(FIBRE),
    second_axis: None,
    failed: FAILED,
    alive: ALIVE,
    energies: ENERGIES..INVARIANTS,
    reads_old_gradient: false,
};

/// The law with friction between the fibres of a section.
pub const FRICTIONAL: Description = Description {
    title: "yarn law with friction",
    properties: &parameters::FRICTIONAL,
    state: &state::FRICTIONAL,
    fibre: Some(FIBRE),
    second_axis: None,
    failed: FRICTIONAL_FAILED,
    alive: FRICTIONAL_ALIVE,
    energies: ENERGIES..INVARIANTS,
    reads_old_gradient: false,
};

/// The linear elastic law.
pub const LINEAR_ELASTIC: Description = Description {
    title: "linear elastic law",
    properties: &parameters::LINEAR_ELASTIC,
    state: &state::LINEAR_ELASTIC,
    fibre: Some(LINEAR_FIBRE),
    second_axis: Some(LINEAR_SECOND_AXIS),
    failed: LINEAR_FAILED,
    alive: LINEAR_ALIVE,
    energies: LINEAR_WORK..LINEAR_WORK + 1,
    reads_old_gradient: true,
};

impl Description {
    /// How many entries of F a host keeps behind the state, by columns: those of the start of a step, where it depends on them.
    pub(crate) const fn kept(&self) -> usize {
        if self.reads_old_gradient { 9 } else { 0 }
    }

    /// The places of the fibre direction among the properties; none of a law without fibre.
    pub const fn fibre_components(&self) -> Range<usize> {
        match self.fibre {
            Some(first) => first..first + 3,
            None => 0..0,
        }
    }

    /// The energy per reference volume of a state.
    pub fn energy<T: Real>(&self, state: &[T]) -> T {
        let energies = state.get(self.energies.clone()).unwrap_or_default().iter().copied();
        energies.reduce(|sum, energy| sum + energy).unwrap_or(T::splat(0.0))
    }

    /// How many numbers a host keeps for a point: the state, and these entries of F.
    pub const fn history(&self) -> usize {
        self.state.len() + self.kept()
    }
}
