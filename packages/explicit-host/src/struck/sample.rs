//! The state of a struck scene at an instant, as far as all scenes have it.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::body::Body;
use crate::energies::Energies;
use crate::lanes::{Number, largest};
use crate::medium::Medium;
use crate::solver::Solver;

/// Energies and the force are those of the whole, also where a part of it is computed; what is counted is counted in
/// that part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sample<E> {
    pub time: f64,
    /// Of what strikes, in the direction of the blow; how far it has come; the force that brakes it.
    pub speed: f64,
    pub travel: f64,
    pub force: f64,
    pub energies: Energies,
    /// The internal energy by mode, as [`ENERGY_NAMES`](crate::medium::ENERGY_NAMES) has them, and the
    /// largest densities and the largest failure index of intact elements.
    pub parts: [f64; 5],
    pub largest: [f64; 5],
    pub index: f64,
    /// Elements deleted so far, and how many of them because they had collapsed.
    pub deleted: usize,
    pub collapsed: usize,
    /// What this kind of scene has besides.
    pub own: E,
}

impl<E: Default> Sample<E> {
    /// Measures a solver that computes one part in `whole`, and whose striker was at `start`.
    pub fn of<T: Number>(solver: &Solver<T>, whole: f64, start: f64) -> Sample<E> {
        // Collected, since the order of a parallel sum is not always the same.
        let bodies: Vec<Sample<()>> =
            solver.bodies.par_iter().map(|body| Sample::of_body(body, &solver.media, whole)).collect();
        let mut sample =
            Sample { time: solver.state.time, energies: solver.state.energies.times(whole), ..Sample::default() };
        for body in &bodies {
            for mode in 0..sample.parts.len() {
                sample.parts[mode] += body.parts[mode];
                sample.largest[mode] = largest(sample.largest[mode], body.largest[mode]);
            }
            sample.index = largest(sample.index, body.index);
            sample.deleted += body.deleted;
            sample.collapsed += body.collapsed;
        }
        if let Some(striker) = &solver.striker {
            sample.speed = -striker.velocity;
            sample.travel = start - striker.position;
            sample.force = striker.force * whole;
        }
        sample
    }
}

impl Sample<()> {
    fn of_body<T: Number>(body: &Body<T>, media: &[Medium<T>], whole: f64) -> Self {
        let (deleted, collapsed) = (body.state.deleted.len(), body.state.collapsed);
        let mut sample = Sample { deleted, collapsed, ..Sample::default() };
        for block in &body.blocks {
            let medium = &media[block.medium];
            for i in 0..block.shapes.n {
                let densities = block.energies(medium, i);
                let volume = whole * block.shapes.volume(i);
                for (part, density) in sample.parts.iter_mut().zip(densities) {
                    *part += density * volume;
                }
                if block.is_intact(i) {
                    for (most, density) in sample.largest.iter_mut().zip(densities) {
                        *most = largest(*most, density);
                    }
                    sample.index = largest(sample.index, block.failure_index(medium, i));
                }
            }
        }
        sample
    }
}
