//! A small explicit host for one body: hexahedra of one point, central differences, a rigid cylinder in contact.
//!
//! It calls the laws as a solver does, through their C entries: blocks of component-major arrays, history in place,
//! deletion by the latch. The energies of its balance are those that the laws report, so that the balance tells whether
//! stress and energy belong together and whether the step is short enough.

pub mod contact;
pub mod element;
pub mod material;
pub mod mesh;
pub mod vtu;

use std::time::{Duration, Instant};

use contact::Contact;
use element::Number;
use material::{BLOCK, ElementBlock, Medium, Scratch, Sums, Wanted};
use mesh::Mesh;

/// A step is this fraction of the longest one that the bound of the frequency allows; the bound is renewed after so many
/// steps.
const SAFETY: f64 = 0.9;
const STEPS_PER_BOUND: u64 = 10;

/// What moves a node beside the forces on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Support {
    /// Which directions are free.
    pub free: [bool; 3],
    /// The velocity in the directions that are not.
    pub velocity: [f64; 3],
}

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
    moved: f64,
}

impl Projectile {
    pub fn new(mass: f64, position: f64, velocity: f64, held: bool, contact: Contact) -> Self {
        Projectile { mass, position, velocity, held, contact, force: 0.0, moved: 0.0 }
    }
}

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

/// A body on its way.
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
    /// Intact elements that hold a node.
    holding: Vec<u16>,
    scratch: Scratch<T>,
    pub time: f64,
    step: f64,
    frequency: f64,
    friction_and_viscosity: [f64; 2],
    /// Hourglass energy of deleted elements.
    released: f64,
    external: f64,
    pub energies: Energies,
    pub deleted: Vec<usize>,
    pub cost: Cost,
}

impl<T: Number> Solver<T> {
    /// A body at rest. `medium_of` says which of the media an element is made of.
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
            holding: vec![0; count],
            scratch: Scratch::default(),
            time: 0.0,
            step: 0.0,
            frequency: 0.0,
            friction_and_viscosity: [0.0; 2],
            released: 0.0,
            external: 0.0,
            energies: Energies::default(),
            deleted: Vec::new(),
            cost: Cost::default(),
            mesh,
            media,
        };
        solver.divide(medium_of);
        solver.weigh();
        solver
    }

    /// Cuts the elements into blocks of one medium.
    fn divide(&mut self, medium_of: impl Fn(usize) -> usize) {
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
    fn weigh(&mut self) {
        for block in &self.blocks {
            for i in 0..block.shapes.n {
                let mass = self.media[block.medium].density * block.shapes.corner_volume(i);
                for node in block.shapes.nodes[i] {
                    self.mass[node as usize] += mass;
                    self.holding[node as usize] += 1;
                }
            }
        }
        self.mobility = self.mass.iter().map(|mass| [T::from_f64(1.0 / mass); 3]).collect();
    }

    pub fn mass(&self) -> &[f64] {
        &self.mass
    }

    /// Holds a node, or moves it.
    pub fn support(&mut self, node: usize, support: Support) {
        for i in (0..3).filter(|&i| !support.free[i]) {
            self.mobility[node][i] = T::default();
            self.velocity[node][i] = T::from_f64(support.velocity[i]);
        }
        if support.velocity != [0.0; 3] {
            self.supports.push((node, support));
        }
    }

    /// One step, `longest` at most. With `measured`, the energies are afterwards those at its start.
    pub fn advance(&mut self, measured: bool, longest: f64) {
        let started = Instant::now();
        let bounded = self.cost.steps.is_multiple_of(STEPS_PER_BOUND);
        let wanted =
            Wanted { law: measured || self.all_outputs, balance: measured, frequency: bounded, step: self.step };
        let sums = self.compute_forces(wanted);
        let computed = Instant::now();
        self.meet_projectile();
        let met = Instant::now();
        self.take_leave(&sums);
        let contact = self.projectile.as_ref().map_or(0.0, |projectile| projectile.contact.frequency);
        if bounded {
            self.frequency = sums.frequency;
        }
        let stable = SAFETY * 2.0 / (self.frequency + contact).sqrt();
        let before = self.step;
        self.step = stable.min(longest);
        self.accelerate(0.5 * (before + self.step), measured, &sums);
        self.displace();
        self.time += self.step;
        self.cost.steps += 1;
        self.cost.law += sums.law;
        self.cost.elements += computed - started;
        self.cost.contact += met - computed;
        self.cost.nodes += met.elapsed();
    }

    fn compute_forces(&mut self, wanted: Wanted) -> Sums {
        self.forces.fill([T::default(); 3]);
        let mut sums = Sums::default();
        for block in &mut self.blocks {
            let medium = &self.media[block.medium];
            block.advance(medium, &self.displacement, &mut self.forces, &mut self.scratch, wanted, &mut sums);
        }
        self.friction_and_viscosity[1] += sums.viscosity;
        sums
    }

    fn meet_projectile(&mut self) {
        if let Some(projectile) = &mut self.projectile {
            let Projectile { position, moved, contact, .. } = projectile;
            projectile.force = contact.apply(*position, *moved, &self.displacement, &mut self.forces);
            self.friction_and_viscosity[0] = contact.dissipated;
        }
    }

    /// Deleted elements let their nodes go; a node without elements keeps its mass and meets nothing.
    fn take_leave(&mut self, sums: &Sums) {
        if sums.deleted.is_empty() {
            return;
        }
        for &element in &sums.deleted {
            for node in self.mesh.elements[element] {
                self.holding[node as usize] -= 1;
            }
        }
        self.released += sums.released;
        self.deleted.extend(&sums.deleted);
        if let Some(projectile) = &mut self.projectile {
            projectile.contact.remove(|node| self.holding[node] == 0);
        }
    }

    /// Velocities in the middle of the step; `interval` is the time from the middle of the last one.
    fn accelerate(&mut self, interval: f64, measured: bool, sums: &Sums) {
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
        let work = interval * self.power_from_outside();
        self.external += work;
        if measured {
            // Half of the work belongs to what comes after the instant of the measurement.
            let external = self.external - 0.5 * work;
            self.energies = Energies { projectile: striking, kinetic, external, ..self.other_energies(sums) };
        }
    }

    /// The power of what holds a velocity.
    fn power_from_outside(&self) -> f64 {
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
        let [friction, viscosity] = self.friction_and_viscosity;
        Energies {
            internal,
            // Those of this step still stand in the first sum.
            hourglass: sums.hourglass + self.released - sums.released,
            friction,
            viscosity,
            contact: self.projectile.as_ref().map_or(0.0, |projectile| projectile.contact.stored),
            ..Energies::default()
        }
    }

    fn displace(&mut self) {
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
    }

    /// Where a node stands.
    pub fn position(&self, node: usize) -> [f64; 3] {
        std::array::from_fn(|i| self.mesh.nodes[node][i] + self.displacement[node][i].into())
    }

    /// The block of an element, and its place there.
    pub fn element(&self, number: usize) -> (&ElementBlock<T>, usize) {
        let block = &self.blocks[self.blocks.partition_point(|block| block.first <= number) - 1];
        (block, number - block.first)
    }

    /// Whether an element still stands.
    pub fn is_intact(&self, number: usize) -> bool {
        let (block, i) = self.element(number);
        block.is_intact(i)
    }

    /// Energy densities in an element, as [`material::ENERGY_NAMES`] has them.
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
