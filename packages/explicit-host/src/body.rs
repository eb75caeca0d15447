//! One body: lumped masses, supports, the motion of its nodes, the forces of its elements.

use serde::{Deserialize, Serialize};

use super::archive::Archive;
use super::block::{BLOCK, ElementBlock, Nodal, Scratch, StepOptions, Sums};
use super::global_estimate::Trial;
use super::lanes::{Number, largest};
use super::medium::Medium;
use super::mesh::Mesh;
use super::shreds::Adjacency;
use super::step_limit::StepLimit;
use super::tie::{self, Tie};

/// The boundary condition of a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Support {
    /// Which directions are free.
    pub free: [bool; 3],
    /// The velocity in the directions that are not, where the supports' speed is 1.
    pub velocity: [f64; 3],
}

/// A body with its motion and its history.
#[derive(Debug)]
pub struct Body<T> {
    pub mesh: Mesh,
    pub blocks: Vec<ElementBlock<T>>,
    pub state: BodyState<T>,
    pub forces: Vec<[T; 3]>,
    /// Reciprocal mass by direction, 0 where the direction is not free.
    pub(crate) mobility: Vec<[T; 3]>,
    pub mass: Vec<f64>,
    /// Without what is lent to torn ends.
    pub(crate) first_mass: Vec<f64>,
    pub(crate) adjacency: Adjacency,
    supports: Vec<(usize, Support)>,
    /// Nodes that move with others.
    pub ties: Vec<Tie>,
    /// Number of elements at each node at first.
    first_elements: Vec<u16>,
    /// Of this step: twice the stiffness of what presses each node, and what limits the step.
    pub springs: Vec<f64>,
    pub most_contact: f64,
    pub limit: StepLimit,
    pub trial: Trial<T>,
    /// Of the last step.
    pub sums: Sums,
}

/// What a body remembers from step to step, besides the history of its blocks.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct BodyState<T> {
    pub displacement: Vec<[T; 3]>,
    /// What rounding has left of it, to be added in the next step; empty in double precision.
    rest: Vec<[T; 3]>,
    pub velocity: Vec<[T; 3]>,
    /// No node has moved farther in the last step.
    pub farthest: f64,
    /// The factor of the supports' velocities.
    speed: f64,
    /// Number of intact elements at each node.
    intact_elements: Vec<u16>,
    pub deleted: Vec<usize>,
    /// How many of them because they had collapsed or turned inside out.
    pub collapsed: usize,
    /// The block and place of the element that limited the step last, where that was looked for.
    pub worst: Option<(usize, usize)>,
    /// Hourglass energy of deleted elements.
    pub released: f64,
    /// The mass that nodes of torn ends have been lent; empty before the first.
    pub lent: Vec<f64>,
    /// Of each element, by how much of its nodes it is in need for its volume; empty where all are alike.
    pub needs: Vec<f64>,
    /// The motion by which the largest eigenvalue is estimated; empty before the first.
    pub trial: Vec<[T; 3]>,
}

impl<T: Number> Body<T> {
    /// A body at rest. `medium_of` gives the index of an element's medium.
    pub fn new(mesh: Mesh, media: &[Medium<T>], medium_of: impl Fn(usize) -> usize) -> Self {
        let count = mesh.nodes.len();
        let mut body = Body {
            blocks: Vec::new(),
            state: BodyState {
                displacement: vec![[T::default(); 3]; count],
                rest: vec![[T::default(); 3]; if size_of::<T>() < 8 { count } else { 0 }],
                velocity: vec![[T::default(); 3]; count],
                farthest: 0.0,
                speed: 1.0,
                intact_elements: vec![0; count],
                deleted: Vec::new(),
                collapsed: 0,
                worst: None,
                released: 0.0,
                lent: Vec::new(),
                needs: Vec::new(),
                trial: Vec::new(),
            },
            forces: vec![[T::default(); 3]; count],
            mobility: Vec::new(),
            mass: vec![0.0; count],
            first_mass: Vec::new(),
            adjacency: Adjacency::default(),
            supports: Vec::new(),
            ties: Vec::new(),
            first_elements: Vec::new(),
            springs: vec![0.0; count],
            most_contact: 0.0,
            limit: StepLimit::default(),
            trial: Trial::default(),
            sums: Sums::default(),
            mesh,
        };
        body.build_blocks(media, medium_of);
        body.lump_mass(media);
        body
    }

    /// Groups consecutive elements of one medium into blocks.
    fn build_blocks(&mut self, media: &[Medium<T>], medium_of: impl Fn(usize) -> usize) {
        let Mesh { nodes, elements, fibre, .. } = &self.mesh;
        let mut first = 0;
        while first < elements.len() {
            let medium = medium_of(first);
            let alike = (first..elements.len().min(first + BLOCK)).take_while(|&i| medium_of(i) == medium).count();
            let range = first..first + alike;
            let fibre = if fibre.is_empty() { &[][..] } else { &fibre[range.clone()] };
            self.blocks.push(ElementBlock::new(&elements[range], fibre, first, nodes, medium, &media[medium]));
            first += alike;
        }
    }

    /// Gives each element a failure limit of its own: ln(1 + ε_lim), or the linear elastic law's strength.
    pub fn limit(&mut self, limits: &[f64]) {
        for block in &mut self.blocks {
            block.limit(&limits[block.first..block.first + block.shapes.n]);
        }
    }

    /// Lumps an eighth of every element's mass at each corner.
    fn lump_mass(&mut self, media: &[Medium<T>]) {
        for block in &self.blocks {
            for i in 0..block.shapes.n {
                let mass = media[block.medium].density * block.shapes.corner_volume(i);
                for node in block.shapes.nodes[i] {
                    self.mass[node as usize] += mass;
                    self.state.intact_elements[node as usize] += 1;
                }
            }
        }
        self.mobility = self.mass.iter().map(|mass| [T::from_f64(1.0 / mass); 3]).collect();
        self.first_elements.clone_from(&self.state.intact_elements);
        self.first_mass.clone_from(&self.mass);
    }

    /// Ties nodes to others, before any support.
    pub fn tie(&mut self, ties: Vec<Tie>) {
        tie::hand_over(&ties, &mut self.mass);
        for (mobility, &mass) in self.mobility.iter_mut().zip(&self.mass) {
            *mobility = [if mass > 0.0 { T::from_f64(1.0 / mass) } else { T::default() }; 3];
        }
        self.first_mass.clone_from(&self.mass);
        self.ties = ties;
    }

    /// # Errors
    /// The archive's.
    pub fn archive(&mut self, media: &[Medium<T>], archive: &mut Archive<'_>) -> Result<(), postcard::Error> {
        archive.keep(&mut self.state)?;
        self.blocks.iter_mut().try_for_each(|block| archive.keep(&mut block.history))?;
        // The worst of all the shares that there have been, which those of now do not tell.
        let mut extremes: Vec<_> =
            self.blocks.iter().map(|block| (block.shapes.lightest, block.shapes.corner_part)).collect();
        archive.keep(&mut extremes)?;
        if matches!(archive, Archive::Reads(_)) {
            self.weigh_all(media);
            for (block, extreme) in self.blocks.iter_mut().zip(extremes) {
                (block.shapes.lightest, block.shapes.corner_part) = extreme;
            }
        }
        Ok(())
    }

    /// Fixes a node, or prescribes its velocity. Directions that another support holds stay held.
    pub fn support(&mut self, node: usize, support: Support) {
        for i in (0..3).filter(|&i| !support.free[i]) {
            self.mobility[node][i] = T::default();
            self.state.velocity[node][i] = T::from_f64(self.state.speed * support.velocity[i]);
        }
        if support.velocity != [0.0; 3] {
            self.supports.push((node, support));
        }
    }

    /// Moves the supports at this speed.
    pub fn set_speed(&mut self, speed: f64) {
        self.state.speed = speed;
        for (node, support) in &self.supports {
            for i in (0..3).filter(|&i| !support.free[i]) {
                self.state.velocity[*node][i] = T::from_f64(speed * support.velocity[i]);
            }
        }
    }

    /// Brakes the free directions by a force of this many times the momentum; returns its power.
    pub fn brake(&mut self, rate: f64) -> f64 {
        let mut power = 0.0;
        for (((v, f), mobility), &mass) in
            self.state.velocity.iter().zip(&mut self.forces).zip(&self.mobility).zip(&self.mass)
        {
            for i in (0..3).filter(|&i| mobility[i] != T::default()) {
                let brake = rate * mass * v[i].into();
                f[i] -= T::from_f64(brake);
                power += brake * v[i].into();
            }
        }
        power
    }

    /// The elements' forces at this instant; what they sum up to is in `sums`.
    pub fn compute_forces(&mut self, media: &[Medium<T>], scratch: &mut Scratch<T>, options: StepOptions) {
        self.forces.fill([T::default(); 3]);
        self.springs.fill(0.0);
        if options.trial.is_some() {
            self.trial.start(&mut self.state.trial, self.forces.len());
        }
        self.sums = Sums::default();
        for block in &mut self.blocks {
            let medium = &media[block.medium];
            let nodal = Nodal {
                displacement: &self.state.displacement,
                forces: &mut self.forces,
                trial: &self.state.trial,
                resisted: &mut self.trial.resisted,
            };
            block.advance(medium, nodal, scratch, options, &mut self.sums);
        }
    }

    /// Releases the nodes of the elements that this step has deleted; a node without elements keeps its mass. Returns
    /// whether there are any.
    pub fn release_nodes(&mut self, media: &[Medium<T>]) -> bool {
        self.release();
        if self.sums.deleted.is_empty() {
            return false;
        }
        let nodes: Vec<u32> = self.sums.deleted.iter().flat_map(|&element| self.mesh.elements[element]).collect();
        self.weigh(media, nodes.into_iter());
        true
    }

    fn release(&mut self) {
        for &element in &self.sums.deleted {
            for node in self.mesh.elements[element] {
                self.state.intact_elements[node as usize] -= 1;
            }
        }
        self.state.released += self.sums.released;
        self.state.deleted.extend(&self.sums.deleted);
        self.state.collapsed += self.sums.collapsed;
    }

    /// Deletes elements as if they had failed; [`weigh`](Self::weigh) has to follow.
    pub fn delete(&mut self, elements: &[usize]) {
        for &element in elements {
            let place = self.blocks.partition_point(|block| block.first <= element) - 1;
            let first = self.blocks[place].first;
            self.blocks[place].history.intact[element - first] = T::default();
        }
        self.sums.deleted = elements.to_vec();
        self.release();
    }

    /// Whether a node has lost an element.
    pub fn has_lost(&self, node: usize) -> bool {
        self.state.intact_elements[node] < self.first_elements[node]
    }

    /// Whether no element is left at a node.
    pub fn is_loose(&self, node: usize) -> bool {
        self.state.intact_elements[node] == 0
    }

    /// Velocities after this interval; returns the kinetic energy if it is to be measured.
    pub fn update_velocities(&mut self, interval: f64, measured: bool) -> f64 {
        let dt = T::from_f64(interval);
        let mut kinetic = 0.0;
        for tie in &self.ties {
            let force = std::mem::take(&mut self.forces[tie.node as usize]);
            for (corner, share) in tie.parts() {
                for (f, of_node) in self.forces[corner].iter_mut().zip(force) {
                    *f += T::from_f64(share) * of_node;
                }
            }
        }
        let (velocity, forces) = (&mut self.state.velocity, &self.forces);
        if measured {
            for (((v, f), mobility), &mass) in velocity.iter_mut().zip(forces).zip(&self.mobility).zip(&self.mass) {
                let old = *v;
                for i in 0..3 {
                    v[i] += dt * f[i] * mobility[i];
                }
                // What central differences conserve is the product of the velocities before and after.
                kinetic += 0.5 * mass * (0..3).map(|i| old[i].into() * v[i].into()).sum::<f64>();
            }
        } else {
            let components = velocity.as_flattened_mut().iter_mut().zip(forces.as_flattened());
            for ((v, f), mobility) in components.zip(self.mobility.as_flattened()) {
                *v += dt * *f * *mobility;
            }
        }
        for tie in &self.ties {
            let mut velocity = [T::default(); 3];
            for (corner, share) in tie.parts() {
                for (v, of_corner) in velocity.iter_mut().zip(self.state.velocity[corner]) {
                    *v += T::from_f64(share) * of_corner;
                }
            }
            self.state.velocity[tie.node as usize] = velocity;
        }
        kinetic
    }

    /// The power of the reactions at prescribed velocities.
    pub fn external_power(&self) -> f64 {
        let mut power = 0.0;
        for (node, support) in &self.supports {
            let reaction = |i: usize| -> f64 { -self.forces[*node][i].into() * self.state.speed * support.velocity[i] };
            power += (0..3).filter(|&i| !support.free[i]).map(reaction).sum::<f64>();
        }
        power
    }

    /// Displacements at the end of a step.
    pub fn displace(&mut self, step: f64) {
        let dt = T::from_f64(step);
        let mut farthest = 0.0;
        let BodyState { displacement, rest, velocity, .. } = &mut self.state;
        for (node, (u, v)) in displacement.iter_mut().zip(velocity).enumerate() {
            let mut square = 0.0;
            for i in 0..3 {
                let before: f64 = u[i].into();
                let mut way = dt * v[i];
                if let Some(rest) = rest.get_mut(node) {
                    // What is small beside the displacement is not lost (Kahan's sum).
                    way += rest[i];
                    rest[i] = way - ((u[i] + way) - u[i]);
                }
                u[i] += way;
                let after: f64 = u[i].into(); // as rounded in f32
                square += (after - before) * (after - before);
            }
            farthest = largest(farthest, square);
        }
        self.state.farthest = farthest.sqrt();
    }

    /// What the laws report.
    pub fn internal_energy(&self, media: &[Medium<T>]) -> f64 {
        let mut internal = 0.0;
        for block in &self.blocks {
            for i in 0..block.shapes.n {
                let density: f64 = block.energies(&media[block.medium], i).iter().sum();
                internal += density * block.shapes.volume(i);
            }
        }
        internal
    }

    /// What friction between the fibres has taken, or a law of one's own has lost.
    pub fn lost_energy(&self, media: &[Medium<T>]) -> f64 {
        let blocks = self.blocks.iter().filter(|block| media[block.medium].lost().is_some());
        let of = |block: &ElementBlock<T>| -> f64 {
            (0..block.shapes.n).map(|i| block.lost(&media[block.medium], i) * block.shapes.volume(i)).sum()
        };
        blocks.map(of).sum()
    }

    /// The current position of a node.
    #[inline(always)]
    pub fn position(&self, node: usize) -> [f64; 3] {
        let ([x, y, z], [u, v, w]) = (self.mesh.nodes[node], self.state.displacement[node]);
        [x + u.into(), y + v.into(), z + w.into()]
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

    /// Of each element, whether it has not been deleted.
    pub fn intact(&self) -> Vec<bool> {
        self.blocks.iter().flat_map(|block| (0..block.shapes.n).map(|i| block.is_intact(i))).collect()
    }

    /// Energy densities in an element, as [`ENERGY_NAMES`](super::medium::ENERGY_NAMES) has them.
    pub fn energy_densities(&self, media: &[Medium<T>], number: usize) -> [f64; 5] {
        let (block, i) = self.element(number);
        block.energies(&media[block.medium], i)
    }

    /// Cauchy stress 11 22 33 12 23 31 of each element, as [`ElementBlock::stress`] has it.
    ///
    /// # Errors
    /// As there.
    pub fn stress(&self, media: &[Medium<T>]) -> Result<Vec<[f64; 6]>, i32> {
        T::stress(self, media)
    }

    pub(super) fn evaluate_stress(&self, media: &[Medium<T>]) -> Result<Vec<[f64; 6]>, i32> {
        let mut stress = Vec::with_capacity(self.mesh.elements.len());
        for block in &self.blocks {
            stress.extend(block.stress(&media[block.medium], &self.state.displacement)?);
        }
        Ok(stress)
    }

    /// The invariants of an element.
    pub fn invariants(&self, media: &[Medium<T>], number: usize) -> [f64; 4] {
        let (block, i) = self.element(number);
        block.invariants(&media[block.medium], i)
    }

    /// Reference volume of an element.
    pub fn volume(&self, number: usize) -> f64 {
        let (block, i) = self.element(number);
        block.shapes.volume(i)
    }

    /// How near an element is to failure, which is at 1.
    pub fn failure_index(&self, media: &[Medium<T>], number: usize) -> f64 {
        let (block, i) = self.element(number);
        block.failure_index(&media[block.medium], i)
    }

    /// The failure limit that an element has of its own, 0 where it is the property's; none where no element has one.
    pub fn own_limit(&self, number: usize) -> Option<f64> {
        let (block, i) = self.element(number);
        block.own_limit(i)
    }

    /// Logarithmic strain along the fibre of an element.
    pub fn elongation(&self, media: &[Medium<T>], number: usize) -> f64 {
        let (block, i) = self.element(number);
        block.elongation(&media[block.medium], i)
    }
}
