//! Contact of bodies with one another: the nodes of each surface against the faces of the others, by a penalty and Coulomb
//! friction.
//!
//! Both sides are treated alike: where two surfaces overlap, the nodes of either are pressed out of the other, each with half of
//! the stiffness. A node's force is divided among the face's corners in the proportion of its place on the face, so that
//! momentum is kept to rounding. On a rigid wall it is the others' nodes alone, with the whole stiffness and no friction. Which nodes
//! are near which faces is found anew when something may have come near that was not.
//!
//! Bodies are worked on in parallel, and their sums taken in their order: the result has the same bits on any number of threads.

#![expect(clippy::needless_range_loop, reason = "loops over the components of vectors")]

mod face;
mod search;
mod surface;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::archive::Archive;
use super::body::Body;
use super::lanes::Number;
use super::vector::{Vector, add, dot, times};
use face::Place;
use search::{Grid, Near};
pub use surface::{Surface, outer_faces};

/// The parameters of contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Pressure by depth of penetration: the same contact whatever the mesh.
    pub stiffness: f64,
    /// Coulomb's coefficient.
    pub friction: f64,
    /// How near a node must be to a face, beyond half of its diagonal, to be looked at in every step until the next search.
    pub margin: f64,
    /// Deeper nodes have not come through this face.
    pub deepest: f64,
}

impl Parameters {
    /// The place on these faces of a surface, or on those around them, that is nearest to a point; `None` if it cannot come into
    /// contact there before the next search.
    fn nearest(&self, surface: &Surface, faces: &[Near], point: Vector) -> Option<(u32, Place, f64)> {
        let mut nearest = None;
        let mut least = f64::INFINITY;
        for near in faces {
            let (mut face, mut place) = (near.face, Place::default());
            // A point beyond the surface's border may come back.
            let depth = face::meet(surface, &mut face, &mut place, point).map_or(self.margin, |met| met.depth);
            if depth >= -self.margin && depth < self.deepest && depth.abs() < least {
                (nearest, least) = (Some((face, place, depth)), depth.abs());
            }
        }
        nearest
    }
}

/// A node near a face of another body.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Pair {
    node: u32,
    /// The other body, and the face of it that the node was last nearest to.
    master: u32,
    face: u32,
    place: Place,
    /// Force by depth.
    stiffness: f64,
    /// The node cannot touch the face before this much of motion.
    free_until: f64,
    /// How deep the node is, and what of its depth does not count: it has not come through this face by so much, but past an
    /// edge or an open end.
    depth: f64,
    uncounted: f64,
    /// Whether it touches the face, or was outside when it was last looked at: if neither, it has not come through the face.
    known: bool,
    /// The friction force on the node, at the end of the last step.
    friction: Vector,
    /// Energy in its penetration and its sticking.
    stored: f64,
    /// What the node exerts on the face: none where its stiffness is 0.
    on_face: OnFace,
}

/// A force on the corners of a face.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct OnFace {
    force: Vector,
    weights: [f64; 4],
    stiffness: f64,
}

/// What belongs to a body.
#[derive(Debug, Default)]
struct Side {
    surface: Surface,
    /// Its nodes near the faces of others.
    pairs: Vec<Pair>,
    /// Which pairs have it as their master: body and number.
    incoming: Vec<(u32, u32)>,
    /// Of each node, the stiffnesses that act on it.
    touching: Vec<f64>,
    stored: f64,
    dissipated: f64,
    frequency: f64,
}

/// The contact of all bodies, and what it has done so far.
#[derive(Debug)]
pub struct MutualContact {
    parameters: Parameters,
    sides: Vec<Side>,
    /// How far something may have moved since the last search; none has been made where this is not finite.
    moved: f64,
    pub searches: u64,
    /// Stored in penetrations and in sticking, nodes that have left included; dissipated by slipping.
    pub stored: f64,
    pub dissipated: f64,
    released: f64,
    /// A bound of the square of the frequency that it adds to the bodies'.
    pub frequency: f64,
}

impl MutualContact {
    /// Of as many surfaces as there are bodies.
    pub fn new(parameters: Parameters, surfaces: Vec<Surface>) -> Self {
        let sides = surfaces.into_iter().map(|surface| Side {
            touching: vec![0.0; surface.area.len()],
            surface,
            ..Side::default()
        });
        MutualContact {
            parameters,
            sides: sides.collect(),
            moved: f64::INFINITY,
            searches: 0,
            stored: 0.0,
            dissipated: 0.0,
            released: 0.0,
            frequency: 0.0,
        }
    }

    /// # Errors
    /// The archive's.
    pub fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), postcard::Error> {
        archive.keep(&mut self.searches)?;
        let MutualContact { moved, stored, dissipated, released, frequency, .. } = self;
        [moved, stored, dissipated, released, frequency].into_iter().try_for_each(|value| archive.keep(value))?;
        for side in &mut self.sides {
            side.surface.archive(archive)?;
            archive.keep(&mut side.pairs)?;
            archive.keep(&mut side.incoming)?;
            let Side { stored, dissipated, frequency, .. } = side;
            [stored, dissipated, frequency].into_iter().try_for_each(|value| archive.keep(value))?;
        }
        Ok(())
    }

    /// Adds the forces of the contact to those of the bodies.
    pub fn apply<T: Number>(&mut self, bodies: &mut [Body<T>]) {
        let follow = |(side, body): (&mut Side, &Body<T>)| side.surface.follow(body);
        let farthest: Vec<f64> = self.sides.par_iter_mut().zip(&*bodies).map(follow).collect();
        // Two that move towards each other.
        self.moved += 2.0 * farthest.into_iter().fold(0.0, f64::max);
        if self.moved >= self.parameters.margin || !self.moved.is_finite() {
            self.search();
        }
        self.press(bodies);
        self.collect(bodies);
        let sum = |value: fn(&Side) -> f64| self.sides.iter().map(value).sum::<f64>();
        self.stored = self.released + sum(|side| side.stored);
        self.dissipated = sum(|side| side.dissipated);
        self.frequency = self.sides.iter().map(|side| side.frequency).fold(0.0, f64::max);
    }

    /// Finds the nodes near faces; pairs that go on keep their friction.
    fn search(&mut self) {
        let surfaces: Vec<&Surface> = self.sides.iter().map(|side| &side.surface).collect();
        let grid = Grid::new(&surfaces, self.parameters.margin);
        let parameters = self.parameters;
        // Where bodies overlap from the start, they press each other.
        let first = self.searches == 0;
        let near = |(number, side): (usize, &Side)| {
            let (mut pairs, mut faces) = (Vec::new(), Vec::new());
            let nodes = if side.surface.wall { &[][..] } else { &side.surface.nodes };
            for &node in nodes {
                let point = side.surface.positions[node as usize];
                grid.near(number, point, &mut faces);
                for of_body in faces.chunk_by(|a, b| a.body == b.body) {
                    let master = of_body[0].body;
                    let share = if surfaces[master as usize].wall { 1.0 } else { 0.5 };
                    let stiffness = share * parameters.stiffness * side.surface.area[node as usize];
                    let nearest = parameters.nearest(surfaces[master as usize], of_body, point);
                    if let Some((face, place, depth)) = nearest {
                        let known = first || depth <= 0.0;
                        let depth = if first { depth.max(0.0) } else { 0.0 };
                        pairs.push(Pair { node, master, face, place, stiffness, known, depth, ..Pair::default() });
                    }
                }
            }
            pairs
        };
        let found: Vec<Vec<Pair>> = self.sides.par_iter().enumerate().map(near).collect();
        for (side, mut pairs) in self.sides.iter_mut().zip(found) {
            let key = |pair: &Pair| (pair.node, pair.master);
            for old in &side.pairs {
                let place = pairs.binary_search_by_key(&key(old), key);
                let touching = old.on_face.stiffness > 0.0;
                match place {
                    Ok(place) if touching => pairs[place] = Pair { free_until: 0.0, ..old.clone() },
                    Err(place) if touching => pairs.insert(place, Pair { free_until: 0.0, ..old.clone() }),
                    // What was outside one face has not come through another one.
                    Ok(place) => pairs[place].known |= old.known && old.face == pairs[place].face,
                    Err(_) => {}
                }
            }
            side.pairs = pairs;
            side.incoming.clear();
        }
        for body in 0..self.sides.len() {
            for number in 0..self.sides[body].pairs.len() {
                let master = self.sides[body].pairs[number].master as usize;
                self.sides[master].incoming.push((body as u32, number as u32));
            }
        }
        self.moved = 0.0;
        self.searches += 1;
    }

    /// Presses the nodes of every body out of the others' faces.
    fn press<T: Number>(&mut self, bodies: &mut [Body<T>]) {
        let (parameters, moved) = (self.parameters, self.moved);
        let mut taken: Vec<(Vec<Pair>, Vec<f64>)> = self
            .sides
            .iter_mut()
            .map(|side| (std::mem::take(&mut side.pairs), std::mem::take(&mut side.touching)))
            .collect();
        let surfaces: Vec<&Surface> = self.sides.iter().map(|side| &side.surface).collect();
        let press = |number: usize, pairs: &mut [Pair], touching: &mut [f64], body: &mut Body<T>| {
            touching.fill(0.0);
            let (mut stored, mut dissipated) = (0.0, 0.0);
            let own = surfaces[number];
            for pair in pairs {
                if moved < pair.free_until {
                    continue;
                }
                let (node, master) = (pair.node as usize, surfaces[pair.master as usize]);
                let (force, loss) = pair.update(own, master, parameters, moved);
                dissipated += loss;
                stored += pair.stored;
                let Some(force) = force else { continue };
                touching[node] += pair.stiffness;
                for i in 0..3 {
                    body.forces[node][i] += T::from_f64(force[i]);
                }
            }
            (stored, dissipated)
        };
        let work = taken.par_iter_mut().zip(bodies).enumerate();
        let energies: Vec<(f64, f64)> =
            work.map(|(number, ((pairs, touching), body))| press(number, pairs, touching, body)).collect();
        for ((side, (pairs, touching)), (stored, dissipated)) in self.sides.iter_mut().zip(taken).zip(energies) {
            (side.pairs, side.touching, side.stored) = (pairs, touching, stored);
            side.dissipated += dissipated;
        }
    }

    /// Gives every body what others' nodes exert on its faces, and bounds the frequency: no eigenvalue of M⁻¹K is larger than the
    /// largest sum over a row of sizes. A spring between a node and a face has the sizes 1 and, over the corners, again 1.
    fn collect<T: Number>(&mut self, bodies: &mut [Body<T>]) {
        let mut taken: Vec<Vec<f64>> = self.sides.iter_mut().map(|side| std::mem::take(&mut side.touching)).collect();
        let sides = &self.sides;
        let collect = |(number, (touching, body)): (usize, (&mut Vec<f64>, &mut Body<T>))| {
            let side = &sides[number];
            for &(other, pair) in &side.incoming {
                let pair = &sides[other as usize].pairs[pair as usize];
                let OnFace { force, weights, stiffness } = pair.on_face;
                if stiffness == 0.0 {
                    continue;
                }
                for (weight, corner) in weights.into_iter().zip(side.surface.faces[pair.face as usize]) {
                    let corner = corner as usize;
                    touching[corner] += weight.abs() * stiffness;
                    for i in 0..3 {
                        body.forces[corner][i] -= T::from_f64(weight * force[i]);
                    }
                }
            }
            let mut frequency: f64 = 0.0;
            for &node in &side.surface.nodes {
                let node = node as usize;
                if touching[node] > 0.0 {
                    frequency = frequency.max(2.0 * touching[node] / body.mass[node]);
                }
            }
            frequency
        };
        let frequencies: Vec<f64> = taken.par_iter_mut().zip(bodies).enumerate().map(collect).collect();
        for ((side, touching), frequency) in self.sides.iter_mut().zip(taken).zip(frequencies) {
            (side.touching, side.frequency) = (touching, frequency);
        }
    }

    /// Takes the faces of a body's deleted elements and its loose nodes out; the balance keeps what was stored in them.
    pub fn remove<T: Number>(&mut self, number: usize, body: &Body<T>) {
        let side = &mut self.sides[number];
        side.surface.remove(body);
        let gone = side.surface.gone.clone();
        let loose = side.pairs.iter_mut().filter(|pair| body.is_loose(pair.node as usize));
        let mut released = loose.map(Pair::leave).sum::<f64>();
        for other in &mut self.sides {
            let on_it =
                other.pairs.iter_mut().filter(|pair| pair.master as usize == number && gone[pair.face as usize]);
            released += on_it.map(Pair::leave).sum::<f64>();
        }
        self.released += released;
    }
}

impl Pair {
    /// Looks where the node is on the face; returns the force on it, if it is inside, and what slipping has dissipated. `moved` is
    /// how far something may have moved since the last search.
    ///
    /// Sticking is a spring as stiff as the penalty, in the tangent plane; slipping or leaving lets it go. What is dissipated
    /// is the friction's work over the step, by the trapezoidal rule of central differences, less what the spring has gained.
    fn update(
        &mut self,
        own: &Surface,
        master: &Surface,
        Parameters { friction, deepest, .. }: Parameters,
        moved: f64,
    ) -> (Option<Vector>, f64) {
        let node = self.node as usize;
        let old = self.friction;
        if self.stiffness == 0.0 {
            return (None, 0.0);
        }
        let met = face::meet(master, &mut self.face, &mut self.place, own.positions[node]);
        let inside = met.filter(|met| met.depth > 0.0 && met.depth < deepest);
        let Some(met) = inside else {
            // Beyond the surface's border it may touch an edge at once.
            self.free_until = met.map_or(0.0, |met| moved - met.depth);
            // What the sticking held is lost; what the depth held has been given back, unless the face is lost as well.
            let sticking = 0.5 * dot(old, old) / self.stiffness;
            let lost = if met.is_some_and(|met| met.depth <= 0.0) { sticking } else { self.stored };
            (self.friction, self.stored, self.on_face) = ([0.0; 3], 0.0, OnFace::default());
            (self.depth, self.uncounted) = (0.0, 0.0);
            self.known = met.is_some_and(|met| met.depth <= 0.0);
            return (None, lost);
        };
        let mut slip = own.moved[node];
        let corners = master.faces[self.face as usize];
        for k in 0..4 {
            slip = add(slip, -met.weights[k], master.moved[corners[k] as usize]);
        }
        let lost = self.deepen(met.depth, dot(slip, slip).sqrt());
        let force = self.stiffness * self.depth;
        let trial = add(old, -self.stiffness, slip);
        let trial = add(trial, -dot(trial, met.normal), met.normal);
        let rough = if master.wall { 0.0 } else { friction };
        let (size, limit) = (dot(trial, trial).sqrt(), rough * force);
        self.friction = if size > limit { times(limit / size, trial) } else { trial };
        let per_stiffness = 0.5 / self.stiffness;
        let (held, after) = (per_stiffness * dot(old, old), per_stiffness * dot(self.friction, self.friction));
        let work = -0.5 * (dot(old, slip) + dot(self.friction, slip));
        self.stored = 0.5 * force * self.depth + after;
        let total = add(self.friction, force, met.normal);
        self.on_face = OnFace { force: total, weights: met.weights, stiffness: self.stiffness };
        (Some(total), lost + work - (after - held))
    }

    /// Takes a new depth over. In a step in which node and face have moved by `slip` against each other, the depth cannot change by
    /// more: what it jumps by, since another face is nearer now, does not count, and brings no energy in. Returns the energy that
    /// is lost where less depth is left than counted.
    fn deepen(&mut self, depth: f64, slip: f64) -> f64 {
        let before = if self.known { self.depth + self.uncounted } else { depth };
        let expected = self.depth + (depth - before).clamp(-slip, slip);
        let least = (self.depth - slip).max(0.0);
        self.depth = expected.clamp(0.0, depth);
        self.uncounted = depth - self.depth;
        self.known = true;
        0.5 * self.stiffness * (least * least - self.depth * self.depth).max(0.0)
    }

    /// Lets go for good; returns what was stored.
    fn leave(&mut self) -> f64 {
        self.on_face = OnFace::default();
        self.friction = [0.0; 3];
        self.stiffness = 0.0;
        self.known = false;
        std::mem::take(&mut self.stored)
    }
}

#[cfg(test)]
mod tests;
