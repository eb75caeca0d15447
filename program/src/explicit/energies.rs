//! The balance of energy, and where the computing time goes.

use std::time::Duration;

use serde::{Deserialize, Serialize};

/// The energies of the body and of the projectile.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Energies {
    pub projectile: f64,
    pub kinetic: f64,
    /// What the laws report, and what hourglass modes hold, deleted elements' included.
    pub internal: f64,
    pub hourglass: f64,
    pub viscosity: f64,
    pub friction: f64,
    /// Stored in the penalty, including that of nodes that have left the contact.
    pub contact: f64,
    /// Work done from outside, through supports that move and a projectile that is held.
    pub external: f64,
}

impl Energies {
    /// All energies but the projectile's, the kinetic and the internal one.
    pub fn other(&self) -> f64 {
        self.hourglass + self.viscosity + self.friction + self.contact
    }

    /// The conserved sum.
    pub fn total(&self) -> f64 {
        self.projectile + self.kinetic + self.internal + self.other() - self.external
    }
}

/// Computing time by part.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
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
