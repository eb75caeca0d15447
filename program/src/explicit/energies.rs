//! The balance of energy, and where the computing time goes.

use std::time::Duration;

/// The energies of the body and of what meets it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energies {
    pub projectile: f64,
    pub kinetic: f64,
    /// What the laws report, and what hourglass modes hold, deleted elements' included.
    pub internal: f64,
    pub hourglass: f64,
    pub viscosity: f64,
    pub friction: f64,
    /// Stored in the penalty, that of nodes that have left included.
    pub contact: f64,
    /// Work done from outside, through supports that move and a projectile that is held.
    pub external: f64,
}

impl Energies {
    /// What is neither of the projectile nor kinetic nor the laws'.
    pub fn other(&self) -> f64 {
        self.hourglass + self.viscosity + self.friction + self.contact
    }

    /// What stays as it is.
    pub fn total(&self) -> f64 {
        self.projectile + self.kinetic + self.internal + self.other() - self.external
    }
}

/// Where the time went.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cost {
    pub steps: u64,
    pub law: Duration,
    pub elements: Duration,
    pub contact: Duration,
    pub nodes: Duration,
}

impl Cost {
    pub fn total(&self) -> Duration {
        self.elements + self.contact + self.nodes
    }
}
