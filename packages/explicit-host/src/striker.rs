//! The rigid body that strikes.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::body::{Body, BodyState};
use super::contact::{Contact, Nodes};
use super::lanes::Number;

/// A rigid body that moves along one axis.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Striker {
    pub mass: f64,
    /// Where its centre is on that axis, and its velocity along it.
    pub position: f64,
    pub velocity: f64,
    /// Whether it is held at its velocity, whatever meets it.
    pub held: bool,
    /// With every body.
    pub contacts: Vec<Contact>,
    /// The contact's force on it, and how far it moved in the last step.
    pub force: f64,
    pub moved: f64,
}

impl Striker {
    pub fn new(mass: f64, position: f64, velocity: f64, held: bool, contacts: Vec<Contact>) -> Self {
        Striker { mass, position, velocity, held, contacts, force: 0.0, moved: 0.0 }
    }

    /// Adds the forces of its contact to those of the bodies, after a step of this length.
    pub fn meet<T: Number>(&mut self, bodies: &mut [Body<T>], step: f64) {
        let (position, moved) = (self.position, self.moved);
        let meet = |(contact, body): (&mut Contact, &mut Body<T>)| {
            let Body { mesh, state, forces, springs, .. } = body;
            let BodyState { displacement, velocity, farthest, .. } = &*state;
            let nodes = Nodes { reference: &mesh.nodes, displacement, velocity, step, farthest: *farthest };
            contact.apply(position, moved, nodes, forces, springs)
        };
        self.force = match (&mut self.contacts[..], bodies) {
            ([contact], [body]) => meet((contact, body)),
            (contacts, bodies) => {
                // Collected, since the order of a parallel sum is not always the same.
                let forces: Vec<f64> = contacts.par_iter_mut().zip(bodies).map(meet).collect();
                forces.iter().sum()
            }
        };
    }

    /// What the penalty's springs have at this end: each has a node at one and at the other a share of the striker, in
    /// proportion to its stiffness.
    pub fn own_rate(&self) -> f64 {
        let touching: f64 = self.contacts.iter().map(|contact| contact.touching).sum();
        if self.held { 0.0 } else { touching / self.mass }
    }

    /// Energy in the contact, and what its friction has dissipated.
    pub fn stored(&self) -> f64 {
        self.contacts.iter().map(|contact| contact.stored).sum()
    }

    pub fn dissipated(&self) -> f64 {
        self.contacts.iter().map(|contact| contact.dissipated).sum()
    }
}
