//! The body as a whole: lumped masses, supports, central differences, the balance of energy.

use std::time::Instant;

use super::block::{BLOCK, ElementBlock, Scratch, StepOptions, Sums};
use super::energies::{Cost, Energies};
use super::lanes::Number;
use super::medium::Medium;
use super::mesh::Mesh;
use super::projectile::Projectile;
use crate::common::error::Error;
use toron::law::status;

/// A step is this fraction of the longest one that the bounds of frequency and damping allow.
const SAFETY: f64 = 0.9;
/// An element that may fail has collapsed, and is deleted, when its own stable step is this fraction of the body's first one: it
/// is a torn shred, which no neighbours hold any more. Before the break steps fall to 0.67 of the first, shreds go down to 0.02.
const COLLAPSED: f64 = 0.2;
/// The run ends with an error when the step is this fraction of the first one: elements that do not fail have collapsed.
const SHORTEST: f64 = 1e-4;

/// The boundary condition of a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Support {
    /// Which directions are free.
    pub free: [bool; 3],
    /// The velocity in the directions that are not.
    pub velocity: [f64; 3],
}

/// A body with its motion, its history and its energies.
#[derive(Debug)]
pub struct Solver<T> {
    pub mesh: Mesh,
    pub media: Vec<Medium<T>>,
    pub blocks: Vec<ElementBlock<T>>,
    pub projectile: Option<Projectile>,
    /// Whether the laws give energies and invariants in every step, or only where they are measured.
    pub all_outputs: bool,
    pub displacement: Vec<[T; 3]>,
    pub velocity: Vec<[T; 3]>,
    forces: Vec<[T; 3]>,
    /// Reciprocal mass by direction, 0 where the direction is not free.
    mobility: Vec<[T; 3]>,
    mass: Vec<f64>,
    supports: Vec<(usize, Support)>,
    /// Number of intact elements at each node.
    intact_elements: Vec<u16>,
    scratch: Scratch<T>,
    pub time: f64,
    step: f64,
    /// The first stable step.
    first_step: Option<f64>,
    friction: f64,
    viscosity: f64,
    /// Hourglass energy of deleted elements.
    released: f64,
    external: f64,
    pub energies: Energies,
    pub deleted: Vec<usize>,
    /// How many of them because they had collapsed.
    pub collapsed: usize,
    pub cost: Cost,
}

impl<T: Number> Solver<T> {
    /// A body at rest. `medium_of` gives the index of an element's medium.
    pub fn new(mesh: Mesh, media: Vec<Medium<T>>, medium_of: impl Fn(usize) -> usize) -> Self {
        let count = mesh.nodes.len();
        let mut solver = Solver {
            blocks: Vec::new(),
            projectile: None,
            all_outputs: true,
            displacement: vec![[T::default(); 3]; count],
            velocity: vec![[T::default(); 3]; count],
            forces: vec![[T::default(); 3]; count],
            mobility: Vec::new(),
            mass: vec![0.0; count],
            supports: Vec::new(),
            intact_elements: vec![0; count],
            scratch: Scratch::default(),
            time: 0.0,
            step: 0.0,
            first_step: None,
            friction: 0.0,
            viscosity: 0.0,
            released: 0.0,
            external: 0.0,
            energies: Energies::default(),
            deleted: Vec::new(),
            collapsed: 0,
            cost: Cost::default(),
            mesh,
            media,
        };
        solver.build_blocks(medium_of);
        solver.lump_mass();
        solver
    }

    /// Groups consecutive elements of one medium into blocks.
    fn build_blocks(&mut self, medium_of: impl Fn(usize) -> usize) {
        let elements = &self.mesh.elements;
        let mut first = 0;
        while first < elements.len() {
            let medium = medium_of(first);
            let alike = (first..elements.len().min(first + BLOCK)).take_while(|&i| medium_of(i) == medium).count();
            let part = &elements[first..first + alike];
            self.blocks.push(ElementBlock::new(part, first, &self.mesh.nodes, medium, &self.media[medium]));
            first += alike;
        }
    }

    /// Lumps an eighth of every element's mass at each corner.
    fn lump_mass(&mut self) {
        for block in &self.blocks {
            for i in 0..block.shapes.n {
                let mass = self.media[block.medium].density * block.shapes.corner_volume(i);
                for node in block.shapes.nodes[i] {
                    self.mass[node as usize] += mass;
                    self.intact_elements[node as usize] += 1;
                }
            }
        }
        self.mobility = self.mass.iter().map(|mass| [T::from_f64(1.0 / mass); 3]).collect();
    }

    pub fn mass(&self) -> &[f64] {
        &self.mass
    }

    /// Fixes a node, or prescribes its velocity.
    pub fn support(&mut self, node: usize, support: Support) {
        for i in (0..3).filter(|&i| !support.free[i]) {
            self.mobility[node][i] = T::default();
            self.velocity[node][i] = T::from_f64(support.velocity[i]);
        }
        if support.velocity != [0.0; 3] {
            self.supports.push((node, support));
        }
    }

    /// The forces of this instant and the velocities in the middle of the coming step, which ends within `left`. With
    /// `measured`, the energies are those of this instant. [`displace`](Self::displace) completes the step.
    ///
    /// # Errors
    /// The law refuses its call, or elements have collapsed so far that there is no stable step.
    pub fn accelerate(&mut self, measured: bool, left: f64) -> Result<(), Error> {
        let started = Instant::now();
        let shortest = self.first_step.map_or(0.0, |first| COLLAPSED * first / SAFETY);
        let options = StepOptions {
            law_outputs: measured || self.all_outputs,
            energy_balance: measured,
            step: self.step,
            shortest,
        };
        let sums = self.compute_forces(options)?;
        let computed = Instant::now();
        self.apply_contact();
        let met = Instant::now();
        self.release_nodes(&sums);
        let stable = self.stable_step(&sums)?;
        let before = self.step;
        // Equal steps to the end, rather than a very short last one.
        self.step = left / (left / stable).ceil();
        self.update_velocities(0.5 * (before + self.step), measured, &sums);
        self.cost.steps += 1;
        self.cost.law += sums.law;
        self.cost.elements += computed - started;
        self.cost.contact += met - computed;
        self.cost.nodes += met.elapsed();
        Ok(())
    }

    /// Central differences with a damping force that lags by half a step are stable for Δt² ω² + 2 Δt d ≤ 4, that is
    /// Δt ≤ 2/ω (√(1 + ξ²) − ξ) with d = 2 ξ ω.
    fn stable_step(&mut self, sums: &Sums) -> Result<f64, Error> {
        let contact = self.projectile.as_ref().map_or(0.0, Projectile::frequency);
        let (k, d) = (sums.stiffness + contact, sums.damping);
        let step = SAFETY * 4.0 / (d + (d * d + 4.0 * k).sqrt());
        let first = *self.first_step.get_or_insert(step);
        if step.is_finite() && step > SHORTEST * first {
            return Ok(step);
        }
        Err(Error::Evaluation(format!(
            "the stable step is {step:.1e}, from {first:.1e} at first: elements have collapsed"
        )))
    }

    fn compute_forces(&mut self, options: StepOptions) -> Result<Sums, Error> {
        self.forces.fill([T::default(); 3]);
        let mut sums = Sums::default();
        for block in &mut self.blocks {
            let medium = &self.media[block.medium];
            block.advance(medium, &self.displacement, &mut self.forces, &mut self.scratch, options, &mut sums);
        }
        if let Some(code) = sums.refused {
            return Err(Error::Evaluation(format!(
                "the law refuses its call: {}",
                status::meaning(code).unwrap_or("no known code")
            )));
        }
        self.viscosity += sums.viscosity;
        Ok(sums)
    }

    fn apply_contact(&mut self) {
        if let Some(projectile) = &mut self.projectile {
            let Projectile { position, moved, contact, .. } = projectile;
            projectile.force = contact.apply(*position, *moved, &self.displacement, &mut self.forces);
            self.friction = contact.dissipated;
        }
    }

    /// Releases the nodes of deleted elements; a node without elements keeps its mass and leaves the contact.
    fn release_nodes(&mut self, sums: &Sums) {
        if sums.deleted.is_empty() {
            return;
        }
        for &element in &sums.deleted {
            for node in self.mesh.elements[element] {
                self.intact_elements[node as usize] -= 1;
            }
        }
        self.released += sums.released;
        self.deleted.extend(&sums.deleted);
        self.collapsed += sums.collapsed;
        if let Some(projectile) = &mut self.projectile {
            projectile.contact.remove(|node| self.intact_elements[node] == 0);
        }
    }

    /// Velocities in the middle of the step; `interval` is the time from the middle of the last one.
    fn update_velocities(&mut self, interval: f64, measured: bool, sums: &Sums) {
        let dt = T::from_f64(interval);
        let mut kinetic = 0.0;
        for (((v, f), mobility), &mass) in
            self.velocity.iter_mut().zip(&self.forces).zip(&self.mobility).zip(&self.mass)
        {
            let old = *v;
            for i in 0..3 {
                v[i] += dt * f[i] * mobility[i];
            }
            if measured {
                // What central differences conserve is the product of the velocities before and after.
                kinetic += 0.5 * mass * (0..3).map(|i| old[i].into() * v[i].into()).sum::<f64>();
            }
        }
        let mut striking = 0.0;
        if let Some(projectile) = &mut self.projectile {
            let old = projectile.velocity;
            if !projectile.held {
                projectile.velocity += interval * projectile.force / projectile.mass;
            }
            striking = 0.5 * projectile.mass * old * projectile.velocity;
        }
        let work = interval * self.external_power();
        self.external += work;
        if measured {
            // Half of this interval comes after the instant of the measurement.
            let external = self.external - 0.5 * work;
            self.energies = Energies { projectile: striking, kinetic, external, ..self.other_energies(sums) };
        }
    }

    /// The power of the reactions at prescribed velocities.
    fn external_power(&self) -> f64 {
        let mut power = 0.0;
        for (node, support) in &self.supports {
            let reaction = |i: usize| -> f64 { -self.forces[*node][i].into() * support.velocity[i] };
            power += (0..3).filter(|&i| !support.free[i]).map(reaction).sum::<f64>();
        }
        match self.projectile.as_ref().filter(|projectile| projectile.held) {
            Some(projectile) => power - projectile.force * projectile.velocity,
            None => power,
        }
    }

    fn other_energies(&self, sums: &Sums) -> Energies {
        let mut internal = 0.0;
        for block in &self.blocks {
            for i in 0..block.shapes.n {
                let density: f64 = block.energies(&self.media[block.medium], i).iter().sum();
                internal += density * block.shapes.volume[i].into();
            }
        }
        Energies {
            internal,
            hourglass: sums.hourglass + self.released,
            friction: self.friction,
            viscosity: self.viscosity,
            contact: self.projectile.as_ref().map_or(0.0, |projectile| projectile.contact.stored),
            ..Energies::default()
        }
    }

    /// Displacements at the end of the step.
    pub fn displace(&mut self) {
        let started = Instant::now();
        let dt = T::from_f64(self.step);
        for (u, v) in self.displacement.iter_mut().zip(&self.velocity) {
            for i in 0..3 {
                u[i] += dt * v[i];
            }
        }
        if let Some(projectile) = &mut self.projectile {
            projectile.moved = self.step * projectile.velocity;
            projectile.position += projectile.moved;
        }
        self.time += self.step;
        self.cost.nodes += started.elapsed();
    }

    /// The current position of a node.
    pub fn position(&self, node: usize) -> [f64; 3] {
        std::array::from_fn(|i| self.mesh.nodes[node][i] + self.displacement[node][i].into())
    }

    /// The block of an element, and its place there.
    pub fn element(&self, number: usize) -> (&ElementBlock<T>, usize) {
        let block = &self.blocks[self.blocks.partition_point(|block| block.first <= number) - 1];
        (block, number - block.first)
    }

    /// Whether an element has not been deleted.
    pub fn is_intact(&self, number: usize) -> bool {
        let (block, i) = self.element(number);
        block.is_intact(i)
    }

    /// Energy densities in an element, as [`ENERGY_NAMES`](super::medium::ENERGY_NAMES) has them.
    pub fn energy_densities(&self, number: usize) -> [f64; 5] {
        let (block, i) = self.element(number);
        block.energies(&self.media[block.medium], i)
    }

    /// Reference volume of an element.
    pub fn volume(&self, number: usize) -> f64 {
        let (block, i) = self.element(number);
        block.shapes.volume[i].into()
    }

    /// How near an element is to failure, which is at 1.
    pub fn failure_index(&self, number: usize) -> f64 {
        let (block, i) = self.element(number);
        block.failure_index(&self.media[block.medium], i)
    }

    /// Logarithmic strain along the fibre of an element.
    pub fn elongation(&self, number: usize) -> f64 {
        let (block, i) = self.element(number);
        block.elongation(&self.media[block.medium], i)
    }
}

#[cfg(test)]
mod tests;
