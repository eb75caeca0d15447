//! The balance of energy, and where the computing time goes.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::lanes::largest;

/// A run whose total energy moves by more than this part of itself is not stable.
const LARGEST_IMBALANCE: f64 = 0.05;

/// The energies of the body and of the striker.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Energies {
    pub striker: f64,
    pub kinetic: f64,
    /// What the laws report, and what hourglass modes hold, deleted elements' included.
    pub internal: f64,
    pub hourglass: f64,
    pub viscosity: f64,
    pub friction: f64,
    /// Lost by friction between the fibres of sections, deleted elements' included.
    pub fibres: f64,
    /// Lost where torn ends were lent mass.
    pub shreds: f64,
    /// Stored in the penalty, including that of nodes that have left the contact.
    pub contact: f64,
    /// Work done from outside, through supports that move and a striker that is held.
    pub external: f64,
}

impl Energies {
    /// The part that artificial viscosity has taken of what the blow has brought in since `first`; none where it has
    /// brought in nothing.
    pub fn viscosity_share(&self, first: &Energies) -> Option<f64> {
        let given = first.striker - self.striker + self.external - first.external;
        (given != 0.0).then(|| self.viscosity / given)
    }

    /// All energies but the striker's, the kinetic and the internal one.
    pub fn other(&self) -> f64 {
        self.hourglass + self.viscosity + self.friction + self.fibres + self.shreds + self.contact
    }

    /// All of them, multiplied.
    pub fn times(&self, factor: f64) -> Energies {
        let Energies { striker, kinetic, internal, hourglass, viscosity, friction, fibres, shreds, contact, external } =
            *self;
        Energies {
            striker: factor * striker,
            kinetic: factor * kinetic,
            internal: factor * internal,
            hourglass: factor * hourglass,
            viscosity: factor * viscosity,
            friction: factor * friction,
            fibres: factor * fibres,
            shreds: factor * shreds,
            contact: factor * contact,
            external: factor * external,
        }
    }

    /// The conserved sum.
    pub fn total(&self) -> f64 {
        self.striker + self.kinetic + self.internal + self.other() - self.external
    }
}

/// How the total energy has moved since the first measurement.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Balance {
    start: Option<f64>,
    most: f64,
    /// The energy that was there at first or the work from outside, the largest of both so far.
    pub scale: f64,
}

impl Balance {
    /// Takes a measurement.
    pub fn add(&mut self, energies: &Energies) {
        let total = energies.total();
        let start = *self.start.get_or_insert(total);
        self.most = largest(self.most, (total - start).abs());
        self.scale = largest(self.scale, largest(start.abs(), energies.external.abs()));
    }

    /// How far the total energy has moved at most, as a part of the scale.
    pub fn imbalance(&self) -> f64 {
        if self.most == 0.0 { 0.0 } else { self.most / self.scale }
    }

    /// By how much the energy has moved, in per cent, where that is too much for a run to go on.
    pub fn lost(&self) -> Option<f64> {
        let imbalance = self.imbalance();
        (imbalance.is_nan() || imbalance > LARGEST_IMBALANCE).then_some(100.0 * imbalance)
    }
}

/// Computing time. That of the parts is wall time, which is longer where the machine has other work; the law's is
/// summed over threads.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Cost {
    pub steps: u64,
    pub law: Duration,
    pub elements: Duration,
    pub contact: Duration,
    pub nodes: Duration,
    /// Processor time of all threads of the process while the run went on.
    pub processor: Duration,
}

impl Cost {
    /// The wall time of all steps.
    pub fn total(&self) -> Duration {
        self.elements + self.contact + self.nodes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_balance_keeps_the_worst_of_what_it_was_given() {
        let of = |energies: &[[f64; 2]]| {
            let mut balance = Balance::default();
            for &[kinetic, external] in energies {
                balance.add(&Energies { kinetic, external, ..Energies::default() });
            }
            (balance.imbalance(), balance.lost())
        };
        assert_eq!(of(&[[2.0, 0.0], [1.9, 0.0], [2.0, 0.0]]).0, (2.0_f64 - 1.9) / 2.0);
        assert_eq!(of(&[[0.0, 0.0], [4.0, 4.0]]), (0.0, None));
        // Of the work from outside, which is more than what was there.
        assert_eq!(of(&[[1.0, 0.0], [5.5, 4.0]]), (0.125, Some(12.5)));
        assert!(of(&[[2.0, 0.0], [f64::NAN, 0.0], [2.0, 0.0]]).1.is_some_and(f64::is_nan));
    }
}
