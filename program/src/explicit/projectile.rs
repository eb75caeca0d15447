//! The rigid body that strikes.

use super::contact::Contact;

/// A rigid body that moves along axis 1.
#[derive(Clone, Debug)]
pub struct Projectile {
    pub mass: f64,
    /// Height of its axis, and its velocity along axis 1.
    pub position: f64,
    pub velocity: f64,
    /// Whether it is held at its velocity, whatever meets it.
    pub held: bool,
    pub contact: Contact,
    /// The contact's force on it, and how far it moved in the last step.
    pub force: f64,
    pub moved: f64,
}

impl Projectile {
    pub fn new(mass: f64, position: f64, velocity: f64, held: bool, contact: Contact) -> Self {
        Projectile { mass, position, velocity, held, contact, force: 0.0, moved: 0.0 }
    }

    /// A bound of the square of the frequency that the penalty adds: every spring has a node at one end and at the other
    /// a share of the projectile, in proportion to its stiffness.
    pub fn frequency(&self) -> f64 {
        let own = if self.held { 0.0 } else { self.contact.touching / self.mass };
        self.contact.frequency + own
    }
}
