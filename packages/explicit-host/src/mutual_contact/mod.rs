//! Contact of bodies with one another: the nodes of each surface against the faces of the others, by a penalty and
//! Coulomb friction.
//!
//! Both sides are treated alike: where two surfaces overlap, the nodes of either are pressed out of the other, each
//! with half of the stiffness. A node's force is divided among the face's corners in the proportion of its place on the
//! face, so that momentum is kept to rounding. On a rigid wall it is the others' nodes alone, with the whole stiffness
//! and no friction. Which nodes are near which faces is found anew where something may have come near that was not, or
//! a face has gone.
//!
//! Bodies are worked on in parallel, and their sums taken in their order: the result has the same bits on any number of
//! threads.

#![expect(clippy::needless_range_loop, reason = "loops over the components of vectors")]

mod bounds;
mod face;
mod motion;
mod pair;
mod search;
mod surface;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::archive::Archive;
use super::body::Body;
use super::lanes::Number;
use face::{Finder, Place, Query};
use motion::{Due, Motion};
use pair::{Exerted, Pair, Wait};
use search::{Grid, Near};
use surface::fetch;
pub use surface::{Surface, outer_faces};

/// The parameters of contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Pressure by depth of penetration: the same contact whatever the mesh.
    pub stiffness: f64,
    /// Coulomb's coefficient.
    pub friction: f64,
    /// How near a node must be to a face, beyond half of its diagonal, to be followed until the next search.
    pub margin: f64,
    /// Deeper nodes have not come through this face.
    pub deepest: f64,
    /// Whether surfaces that overlap from the start press each other: else only what they go deeper.
    pub pressed_at_rest: bool,
}

impl Parameters {
    /// Which of these places is nearest to its point; `None` if none of them can come into contact before the next
    /// search.
    ///
    /// A point beyond the surface's border has no depth. It may come back, and takes any of the faces where no other
    /// one is near.
    fn nearest<'a>(&self, places: &'a [Query]) -> Option<&'a Query> {
        let mut nearest = None;
        let mut least = f64::INFINITY;
        for place in places {
            let distance = match place.met.map(|met| met.depth) {
                Some(depth) if depth < -self.margin || depth >= self.deepest => continue,
                Some(depth) => depth.abs(),
                None => self.margin.max(self.deepest),
            };
            if distance < least {
                (nearest, least) = (Some(place), distance);
            }
        }
        nearest
    }
}

/// What belongs to a body.
#[derive(Debug, Default)]
struct Side {
    state: SideState,
    /// Of each pair.
    waits: Vec<Wait>,
    /// The numbers of the pairs that may touch in this step.
    near: Vec<u32>,
    /// What those that do exert, and the bodies that they do so on.
    exerted: Vec<Exerted>,
    masters: Vec<u32>,
    /// What is exerted on it: by which body, and the place there.
    incoming: Vec<(u32, u32)>,
}

/// Pairs that are worked on together: what one needs is then still in the processor's nearest memory.
const AT_ONCE: usize = 48;

impl Side {
    /// Takes over how long its pairs wait.
    fn renew_waits(&mut self) {
        self.waits.clear();
        self.waits.extend(self.state.pairs.iter().map(Pair::wait));
    }

    /// Presses the nodes of this body out of the others' faces.
    fn press<T: Number>(&mut self, number: usize, body: &mut Body<T>, scene: &Scene, finder: &mut Finder) {
        let Side { state: SideState { pairs, stored, dissipated }, waits, near, exerted, masters, .. } = self;
        find_near(waits, scene.motion, near);
        exerted.clear();
        masters.clear();
        let points = &scene.surfaces[number].state.points;
        let mut lost = 0.0;
        *stored = 0.0;
        for places in near.chunks(AT_ONCE) {
            finder.queries.clear();
            for &place in places {
                let pair = &pairs[place as usize];
                pair.fetch();
                fetch(body.springs[pair.node as usize]);
                fetch(body.forces[pair.node as usize][0].into());
                let point = points[pair.node as usize].position;
                finder.queries.push(Query::new(pair.master, pair.face, pair.place, point));
            }
            for query in &finder.queries {
                let master = &scene.surfaces[query.body as usize];
                for corner in master.faces[query.face as usize] {
                    fetch(master.state.points[corner as usize].position[2]);
                }
            }
            finder.find(scene.surfaces);
            for (&place, found) in places.iter().zip(&finder.queries) {
                let pair = &mut pairs[place as usize];
                let (force, loss) = pair.update(found, number, scene);
                lost += loss;
                *stored += pair.stored;
                waits[place as usize] = pair.wait();
                if !pair.counts() {
                    continue;
                }
                let node = pair.node as usize;
                let (own, on_face) = pair.exert(number, scene);
                exerted.push(on_face);
                masters.push(pair.master);
                body.springs[node] += own;
                let Some(force) = force else { continue };
                for i in 0..3 {
                    body.forces[node][i] += T::from_f64(force[i]);
                }
            }
        }
        *dissipated += lost;
    }
}

/// The numbers of the pairs whose wait is over.
fn find_near(waits: &[Wait], motion: &Motion, near: &mut Vec<u32>) {
    // Without jumps, which would not be foreseen: every number is written, and kept if the next one comes behind it.
    near.resize(waits.len(), 0);
    let mut count = 0;
    for (place, wait) in waits.iter().enumerate() {
        near[count] = place as u32;
        count += usize::from(wait.is_over(motion));
    }
    near.truncate(count);
}

/// What a body's contact remembers from step to step.
#[derive(Debug, Default, Serialize, Deserialize)]
struct SideState {
    /// Its nodes near the faces of others.
    pairs: Vec<Pair>,
    stored: f64,
    dissipated: f64,
}

/// The contact of all bodies, and what it has done so far.
#[derive(Debug)]
pub struct MutualContact {
    parameters: Parameters,
    surfaces: Vec<Surface>,
    sides: Vec<Side>,
    pub state: ContactState,
}

/// What all pairs are worked on with.
struct Scene<'a> {
    parameters: Parameters,
    surfaces: &'a [Surface],
    motion: &'a Motion,
}

/// Where nodes are looked for, by slabs, and near whose faces.
struct Scope {
    slabs: Vec<bool>,
    bodies: Vec<bool>,
}

impl Scope {
    fn all(motion: &Motion) -> Scope {
        Scope { slabs: vec![true; motion.slabs()], bodies: vec![true; motion.bodies()] }
    }

    fn none(motion: &Motion) -> Scope {
        Scope { slabs: vec![false; motion.slabs()], bodies: vec![false; motion.bodies()] }
    }
}

/// A search.
struct Look<'a> {
    parameters: Parameters,
    surfaces: &'a [Surface],
    grid: Grid,
    /// Where bodies overlap from the start, they press each other.
    first: bool,
}

impl Look<'_> {
    /// The pairs of a body's nodes with the grid's faces, in their order; not of those that press already, which go on
    /// as they were.
    fn pairs_of(&self, number: usize, nodes: &[u32], old: &[Pair]) -> Vec<Pair> {
        let (mut faces, mut finder) = (Vec::new(), Finder::default());
        // Nodes, and where the faces near them that belong to one body end among the queries.
        let mut ends = Vec::new();
        let mut old = old.iter().peekable();
        for &node in nodes {
            let point = self.surfaces[number].state.points[node as usize].position;
            self.grid.near(number, point, &mut faces);
            for of_body in faces.chunk_by(|a, b| a.body == b.body) {
                let key = (node, of_body[0].body);
                while old.next_if(|pair| pair.key() < key).is_some() {}
                if old.peek().is_some_and(|pair| pair.key() == key && pair.is_pressed()) {
                    continue;
                }
                let query = |near: &Near| Query::new(near.body, near.face, Place::default(), point);
                finder.queries.extend(of_body.iter().map(query));
                ends.push((node, finder.queries.len()));
            }
        }
        finder.find(self.surfaces);
        let (mut pairs, mut start) = (Vec::with_capacity(ends.len()), 0);
        for (node, end) in ends {
            let nearest = self.parameters.nearest(&finder.queries[start..end]);
            pairs.extend(nearest.map(|nearest| self.pair(number, node, nearest)));
            start = end;
        }
        pairs
    }

    /// The new pair of a node and the face's surface that it is nearest to.
    fn pair(&self, number: usize, node: u32, &Query { body: master, face, place, met, .. }: &Query) -> Pair {
        let share = if self.surfaces[master as usize].wall { 1.0 } else { 0.5 };
        let stiffness = share * self.parameters.stiffness * self.surfaces[number].area[node as usize];
        let known = self.first || met.is_some_and(|met| met.depth <= 0.0);
        let overlap = if self.first { met.map_or(0.0, |met| met.depth.max(0.0)) } else { 0.0 };
        let [depth, uncounted] = if self.parameters.pressed_at_rest { [overlap, 0.0] } else { [0.0, overlap] };
        Pair { node, master, face, place, stiffness, known, depth, uncounted, ..Pair::default() }
    }
}

/// Puts new pairs in the place of those that are due; where one of these touches it goes on as it was. Both are in the
/// order of their keys.
fn merge(old: Vec<Pair>, found: Vec<Pair>, due: impl Fn(&Pair) -> bool) -> Vec<Pair> {
    let mut merged = Vec::with_capacity(old.len().max(found.len()));
    let mut found = found.into_iter().peekable();
    for pair in old {
        while let Some(new) = found.next_if(|new| new.key() < pair.key()) {
            merged.push(new);
        }
        if !due(&pair) {
            merged.push(pair);
            continue;
        }
        let new = found.next_if(|new| new.key() == pair.key());
        match new {
            _ if pair.is_pressed() => merged.push(Pair { free_until: 0.0, ..pair }),
            // What was outside one face has not come through another one.
            Some(new) => {
                let known = new.known || pair.known && pair.face == new.face;
                merged.push(Pair { known, onset: pair.onset, ..new });
            }
            None => {}
        }
    }
    merged.extend(found);
    merged
}

/// What the contact remembers from step to step, besides what its sides do.
#[derive(Debug, Default, Serialize, Deserialize)]
pub struct ContactState {
    motion: Motion,
    /// Of everything, and of parts.
    pub searches: u64,
    local_searches: u64,
    /// Stored in penetrations and in sticking, nodes that have left included; dissipated by slipping.
    pub stored: f64,
    pub dissipated: f64,
    released: f64,
    /// The bodies that have lost faces since the last step.
    torn: Vec<u32>,
}

impl MutualContact {
    /// Of as many surfaces as there are bodies.
    pub fn new(parameters: Parameters, surfaces: Vec<Surface>) -> Self {
        let motion = Motion::new(&surfaces);
        let sides = surfaces.iter().map(|_| Side::default()).collect();
        let state = ContactState { motion, ..ContactState::default() };
        MutualContact { parameters, surfaces, sides, state }
    }

    /// # Errors
    /// The archive's.
    pub fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), postcard::Error> {
        archive.keep(&mut self.state)?;
        for (surface, side) in self.surfaces.iter_mut().zip(&mut self.sides) {
            archive.keep(&mut surface.state)?;
            archive.keep(&mut side.state)?;
            side.renew_waits();
        }
        Ok(())
    }

    /// Adds the forces of the contact to those of the bodies.
    pub fn apply<T: Number>(&mut self, bodies: &mut [Body<T>]) {
        self.surfaces.par_iter_mut().zip(&*bodies).for_each(|(surface, body)| surface.follow(body));
        match self.state.motion.advance(&self.surfaces, self.parameters.margin) {
            Due::All => {
                self.search(&Scope::all(&self.state.motion));
                self.restart();
            }
            Due::Slabs(due) if due.is_empty() && self.state.torn.is_empty() => {}
            Due::Slabs(due) => {
                self.search(&self.scope(&due));
                self.state.local_searches += 1;
            }
        }
        self.state.torn.clear();
        self.press(bodies);
        self.collect(bodies);
        let sum = |value: fn(&Side) -> f64| self.sides.iter().map(value).sum::<f64>();
        self.state.stored = self.state.released + sum(|side| side.state.stored);
        self.state.dissipated = sum(|side| side.state.dissipated);
    }

    /// What is to be looked for where these slabs have moved against each other and bodies are torn.
    fn scope(&self, due: &[[u32; 2]]) -> Scope {
        let (motion, torn) = (&self.state.motion, &self.state.torn);
        let mut scope = Scope::none(motion);
        for &slab in due.as_flattened() {
            scope.slabs[slab as usize] = true;
            scope.bodies[motion.body(slab)] = true;
        }
        for &body in torn {
            scope.bodies[body as usize] = true;
        }
        if torn.is_empty() {
            return scope;
        }
        for (number, (side, surface)) in self.sides.iter().zip(&self.surfaces).enumerate() {
            // What is beyond a border may have come across a face that was there.
            let on_torn = side.state.pairs.iter().zip(&side.waits).filter(|(_, wait)| torn.contains(&wait.master));
            for (pair, _) in on_torn.filter(|(pair, _)| !pair.known) {
                scope.slabs[motion.slab(number, surface.slab_of_node(pair.node))] = true;
            }
        }
        scope
    }

    /// Finds the nodes of the scope that are near faces of its bodies; pairs that go on keep their friction.
    fn search(&mut self, scope: &Scope) {
        let (parameters, surfaces, motion) = (self.parameters, &self.surfaces[..], &self.state.motion);
        let grid = Grid::new(surfaces, |body| scope.bodies[body], parameters.margin);
        let look = Look { parameters, surfaces, grid, first: self.state.searches == 0 };
        let search = |(number, (side, surface)): (usize, (&mut Side, &Surface))| {
            if surface.wall || !scope.slabs[motion.slabs_of(number)].contains(&true) {
                return;
            }
            let is_due = |node: &u32| scope.slabs[motion.slab(number, surface.slab_of_node(*node))];
            let nodes: Vec<u32> = surface.state.nodes.iter().copied().filter(is_due).collect();
            let old = std::mem::take(&mut side.state.pairs);
            let found = look.pairs_of(number, &nodes, &old);
            let is_due = |pair: &Pair| is_due(&pair.node) && scope.bodies[pair.master as usize];
            side.state.pairs = merge(old, found, is_due);
            side.renew_waits();
        };
        self.sides.par_iter_mut().zip(surfaces).enumerate().for_each(search);
    }

    /// Follows the motion anew from where the bodies are.
    fn restart(&mut self) {
        self.state.motion.restart(&self.surfaces, self.parameters.margin);
        self.state.searches += 1;
    }

    /// Presses the nodes of every body out of the others' faces.
    fn press<T: Number>(&mut self, bodies: &mut [Body<T>]) {
        let MutualContact { parameters, surfaces, sides, state } = self;
        let scene = Scene { parameters: *parameters, surfaces, motion: &state.motion };
        let press = |finder: &mut Finder, (number, (side, body)): (usize, (&mut Side, &mut Body<T>))| {
            side.press(number, body, &scene, finder);
        };
        sides.par_iter_mut().zip(bodies).enumerate().for_each_init(Finder::default, press);
        for side in &mut self.sides {
            side.incoming.clear();
        }
        for body in 0..self.sides.len() {
            for place in 0..self.sides[body].masters.len() {
                let master = self.sides[body].masters[place] as usize;
                self.sides[master].incoming.push((body as u32, place as u32));
            }
        }
    }

    /// Gives every body what others' nodes exert on its faces, and the springs of it: no eigenvalue of M⁻¹K is larger
    /// than the largest sum over a row of sizes. A spring between a node and a face has the sizes 1 and, over the
    /// corners, again 1.
    fn collect<T: Number>(&mut self, bodies: &mut [Body<T>]) {
        let sides = &self.sides;
        bodies.par_iter_mut().enumerate().for_each(|(number, body)| {
            for &(other, place) in &sides[number].incoming {
                let Exerted { corners, force, weights, spring, .. } = sides[other as usize].exerted[place as usize];
                for (weight, corner) in weights.into_iter().zip(corners) {
                    let corner = corner as usize;
                    body.springs[corner] += weight.abs() * spring;
                    for i in 0..3 {
                        body.forces[corner][i] -= T::from_f64(weight * force[i]);
                    }
                }
            }
        });
    }

    /// Adds to what resists the bodies' trial motions.
    pub fn resist<T: Number>(&self, bodies: &mut [Body<T>]) {
        let sides = &self.sides;
        let mut resisted: Vec<_> = bodies.iter_mut().map(|body| std::mem::take(&mut body.trial.resisted)).collect();
        let motion = |body: usize| &bodies[body].state.trial[..];
        resisted.par_iter_mut().enumerate().for_each(|(number, resisted)| {
            let Side { exerted, masters, incoming, .. } = &sides[number];
            for (spring, &master) in exerted.iter().zip(masters) {
                let force = spring.resist(motion(number), motion(master as usize));
                for i in 0..3 {
                    resisted[spring.node as usize][i] -= T::from_f64(force[i]);
                }
            }
            for &(other, place) in incoming {
                let spring = &sides[other as usize].exerted[place as usize];
                let force = spring.resist(motion(other as usize), motion(number));
                for (weight, corner) in spring.weights.into_iter().zip(spring.corners) {
                    for i in 0..3 {
                        resisted[corner as usize][i] += T::from_f64(weight * force[i]);
                    }
                }
            }
        });
        for (body, resisted) in bodies.iter_mut().zip(resisted) {
            body.trial.resisted = resisted;
        }
    }

    /// Takes the faces of a body's deleted elements and its loose nodes out; the balance keeps what was stored in them.
    /// What was near a face that is gone may be near another one: the next step looks for it.
    pub fn remove<T: Number>(&mut self, number: usize, body: &Body<T>) {
        let side = &mut self.sides[number];
        self.surfaces[number].remove(body);
        let gone = &self.surfaces[number].state.gone;
        let loose = side.state.pairs.extract_if(.., |pair| body.is_loose(pair.node as usize));
        let mut released = loose.map(|mut pair| pair.leave()).sum::<f64>();
        side.renew_waits();
        for other in &mut self.sides {
            let pairs = other.state.pairs.iter_mut().zip(&mut other.waits);
            let on_it =
                pairs.filter(|(_, wait)| wait.master as usize == number).filter(|(pair, _)| gone[pair.face as usize]);
            let leave = |(pair, wait): (&mut Pair, &mut Wait)| {
                let stored = pair.leave();
                *wait = pair.wait();
                stored
            };
            released += on_it.map(leave).sum::<f64>();
        }
        self.state.released += released;
        self.state.torn.push(number as u32);
    }
}

#[cfg(test)]
mod tests;
