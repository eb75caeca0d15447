//! A node and the face of another body that it is near: how deep it is, what presses it out, and what rubs on it.

use serde::{Deserialize, Serialize};

use super::Parameters;
use super::face::{Place, Query};
use super::motion::Motion;
use super::surface::Surface;
use crate::friction::coulomb_return;
use crate::vector::{Vector, add, dot};

/// A node that is no farther from a face's surface than this many times its motion against it in the last step may
/// touch it, or let it go, soon. It counts so many times in the length of steps: springs that come and go within a step
/// would make energy.
const AHEAD: f64 = 4.0;
const COMING_AND_GOING: f64 = 2.0;

/// A node near a face of another body.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Pair {
    pub node: u32,
    /// The other body, and the face of it that the node was last nearest to.
    pub master: u32,
    pub face: u32,
    pub place: Place,
    /// Force by depth.
    pub stiffness: f64,
    /// The node cannot touch before its slab and the face's, by this number of [`Motion`]'s, have moved
    /// so far against each other.
    pub slabs: u32,
    pub free_until: f64,
    /// How deep the node is, and what of its depth does not count: it has not come through this face by so much, but
    /// past an edge or an open end.
    pub depth: f64,
    pub uncounted: f64,
    /// Whether it touches the face, or was outside when it was last looked at: if neither, it has not come through the
    /// face.
    pub known: bool,
    /// The friction force on the node, at the end of the last step.
    pub friction: Vector,
    /// Energy in its penetration and its sticking.
    pub stored: f64,
    /// What the node exerts on the face: none where its stiffness is 0.
    pub on_face: OnFace,
}

/// A force on the corners of a face.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct OnFace {
    pub force: Vector,
    pub weights: [f64; 4],
    pub stiffness: f64,
    /// How many times it counts in the length of steps.
    pub count: f64,
    /// The stiffness over the part that the face has of what bounds the spring's frequency.
    pub spring: f64,
}

impl Pair {
    /// Takes over where the node of body `number` is on the face; returns the force on it, if it is inside, and what
    /// slipping has dissipated.
    pub fn update(
        &mut self,
        &Query { face, place, met, .. }: &Query,
        number: usize,
        surfaces: &[&Surface],
        Parameters { friction, deepest, .. }: Parameters,
        motion: &Motion,
    ) -> (Option<Vector>, f64) {
        let (own, master) = (surfaces[number], surfaces[self.master as usize]);
        let old = self.friction;
        let pressed = (self.face != face).then(|| self.pressed(own, master));
        (self.face, self.place) = (face, place);
        let inside = met.filter(|met| met.depth > 0.0 && met.depth < deepest);
        let Some(met) = inside else {
            // Beyond the surface's border it may touch an edge at once.
            self.free_until = 0.0;
            let slabs = [own.slab_of_node(self.node), master.slab_of_face(self.face)];
            let between = motion.between([number, self.master as usize], slabs);
            let soon = met.filter(|met| met.depth <= 0.0).map(|met| {
                let slip = self.slip(own, master, met.weights);
                AHEAD * dot(slip, slip).sqrt()
            });
            if let (Some(met), Some(between), Some(soon)) = (met, between, soon)
                && -met.depth > soon
            {
                (self.slabs, self.free_until) = (between, motion.moved(between) - met.depth - soon);
            }
            // What friction held, and did in the step, is lost; what the depth held has been given back, unless the
            // face is lost as well.
            let lost = match met.filter(|met| met.depth <= 0.0) {
                Some(_) if old == [0.0; 3] => 0.0,
                Some(met) => {
                    coulomb_return(old, self.stiffness, self.slip(own, master, met.weights), met.normal, 0.0).dissipated
                }
                None => self.stored,
            };
            (self.friction, self.stored, self.on_face) = ([0.0; 3], 0.0, OnFace::default());
            // It may touch in the next steps, and counts in their length before it does.
            if let (Some(met), Some(soon)) = (met, soon)
                && -met.depth <= soon
            {
                (self.on_face.weights, self.on_face.count) = (met.weights, COMING_AND_GOING);
            }
            (self.depth, self.uncounted) = (0.0, 0.0);
            self.known = met.is_some_and(|met| met.depth <= 0.0);
            return (None, lost);
        };
        let slip = self.slip(own, master, met.weights);
        let way = dot(slip, slip).sqrt();
        let lost = self.update_penetration(met.depth, way, pressed, dot(met.normal, slip));
        let force = self.stiffness * self.depth;
        let rough = if master.wall { 0.0 } else { friction };
        let friction = coulomb_return(old, self.stiffness, slip, met.normal, rough * force);
        self.friction = friction.force;
        self.stored = 0.5 * force * self.depth + friction.stored;
        let total = add(self.friction, force, met.normal);
        let count = if self.depth <= AHEAD * way { COMING_AND_GOING } else { 1.0 };
        self.on_face = OnFace { force: total, weights: met.weights, stiffness: self.stiffness, count, spring: 0.0 };
        (Some(total), lost + friction.dissipated)
    }

    /// Whether it touches, or may do so soon.
    #[inline(always)]
    pub fn counts(&self) -> bool {
        self.on_face.count > 0.0
    }

    /// Pairs are in this order.
    pub fn key(&self) -> (u32, u32) {
        (self.node, self.master)
    }

    /// Whether it has let go for good.
    #[inline(always)]
    pub fn has_left(&self) -> bool {
        self.stiffness == 0.0
    }

    /// Whether it is to be looked at: not where it has left for good, or where the node cannot have come to the part of
    /// the face's surface that it was last nearest to.
    #[inline(always)]
    pub fn may_touch(&self, motion: &Motion) -> bool {
        let is_clear = self.free_until > 0.0 && motion.moved(self.slabs) < self.free_until;
        !self.has_left() && !is_clear
    }

    /// Takes a new depth over. In a step in which node and face have moved by `slip` against each other, the depth
    /// cannot change by more: what it jumps by, since another face is nearer now, does not count. Returns the energy
    /// that is lost where less depth is left than counted.
    ///
    /// Where the face is another one and some of the depth does not count, what counts is what the motion has stored:
    /// `pressed` by the old face's force, and `out` of the new face. A node beside an edge goes from face to face in
    /// every other step, and no energy comes in.
    fn update_penetration(&mut self, depth: f64, slip: f64, pressed: Option<f64>, out: f64) -> f64 {
        let before = if self.known { self.depth + self.uncounted } else { depth };
        let jumps = self.uncounted > 0.0 || (depth - before).abs() > slip;
        self.known = true;
        if let Some(pressed) = pressed.filter(|_| jumps) {
            // The work by the trapezoidal rule of central differences, over half the stiffness, is `pressed` and `out`
            // times the new depth.
            let held = self.depth * self.depth - pressed;
            let kept = 0.5 * ((out * out + 4.0 * held).max(0.0).sqrt() - out);
            self.depth = kept.clamp(0.0, depth);
            self.uncounted = depth - self.depth;
            return 0.5 * self.stiffness * (held - self.depth * (self.depth + out)).max(0.0);
        }
        let expected = self.depth + (depth - before).clamp(-slip, slip);
        let least = (self.depth - slip).max(0.0);
        self.depth = expected.clamp(0.0, depth);
        self.uncounted = depth - self.depth;
        0.5 * self.stiffness * (least * least - self.depth * self.depth).max(0.0)
    }

    /// The work of what has pressed the node out of its face at the step's start, over half the stiffness.
    fn pressed(&self, own: &Surface, master: &Surface) -> f64 {
        let force = add(self.on_face.force, -1.0, self.friction);
        let slip = self.slip(own, master, self.on_face.weights);
        dot(force, slip) / self.stiffness
    }

    /// How far the node has moved in the step against this place of its face.
    fn slip(&self, own: &Surface, master: &Surface, weights: [f64; 4]) -> Vector {
        let corners = weights.into_iter().zip(master.faces[self.face as usize]);
        corners.fold(own.state.moved[self.node as usize], |slip, (weight, corner)| {
            add(slip, -weight, master.state.moved[corner as usize])
        })
    }

    /// Divides what bounds the spring's frequency between node and face, by their masses: with the part α of the node a
    /// spring has the sizes 1/α there and, over the corners, 1/(1 − α). Returns the node's.
    #[inline(always)]
    pub fn divide_spring(&mut self, node: f64, corners: [f64; 4]) -> f64 {
        let mut per_mass = 0.0;
        for i in 0..4 {
            per_mass += self.on_face.weights[i].abs() / corners[i];
        }
        // Tied nodes have no mass of their own.
        let ratio = if node > 0.0 && per_mass.is_finite() { (node * per_mass).clamp(0.1, 10.0) } else { 1.0 };
        let stiffness = self.on_face.count * self.stiffness;
        self.on_face.spring = stiffness * (1.0 + 1.0 / ratio);
        stiffness * (1.0 + ratio)
    }

    /// Lets go for good; returns what was stored.
    pub fn leave(&mut self) -> f64 {
        self.on_face = OnFace::default();
        self.friction = [0.0; 3];
        self.stiffness = 0.0;
        self.known = false;
        std::mem::take(&mut self.stored)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STIFFNESS: f64 = 3.0;

    fn pair(depth: f64, uncounted: f64) -> Pair {
        Pair { stiffness: STIFFNESS, depth, uncounted, known: true, ..Pair::default() }
    }

    fn stored(pair: &Pair) -> f64 {
        0.5 * STIFFNESS * pair.depth * pair.depth
    }

    /// From face to face, along both of which it moves: of two depths the lesser one is what remains counted.
    #[test]
    fn a_node_between_two_faces_gains_no_energy() {
        let mut pair = pair(1.0, 0.0);
        let lost = pair.update_penetration(0.4, 0.01, Some(0.0), 0.0);
        assert!((lost - 0.5 * STIFFNESS * (1.0 - 0.16)).abs() < 1e-12, "{lost}");
        for depth in [1.0, 0.5, 1.0, 0.45, 1.0] {
            assert_eq!(pair.update_penetration(depth, 0.01, Some(0.0), 0.0), 0.0);
            assert!((pair.depth - 0.4).abs() < 1e-15 && (pair.depth + pair.uncounted - depth).abs() < 1e-15);
        }
    }

    /// What is stored in a change of faces is the work of the old one's force and the new one's; what more was held is
    /// lost.
    #[test]
    fn a_change_of_faces_stores_its_work() {
        for (depth, old_out, out) in
            [(0.9, -0.05, -0.02), (0.9, 0.05, 0.02), (0.9, 0.02, -0.2), (0.9, -0.02, 0.2), (0.26, 0.1, 0.1)]
        {
            let mut pair = pair(0.3, 0.5);
            let before = stored(&pair);
            let lost = pair.update_penetration(depth, 0.3, Some(pair.depth * old_out), out);
            let work = 0.5 * STIFFNESS * (0.3 * old_out + pair.depth * out);
            assert!(
                (stored(&pair) - before + work + lost).abs() < 1e-15 && lost >= 0.0,
                "{depth} {old_out} {out}: {lost}"
            );
            assert!((pair.depth + pair.uncounted - depth).abs() < 1e-15 && pair.uncounted >= 0.0);
        }
        // It has gone farther out than it was deep.
        let mut pair = pair(0.01, 0.5);
        assert_eq!((pair.update_penetration(0.9, 0.3, Some(0.01 * 0.1), 0.1), pair.depth), (0.0, 0.0));
    }

    /// As long as it is on one face, all that the motion allows counts.
    #[test]
    fn what_a_face_jumps_by_does_not_count() {
        let mut pair = pair(0.3, 0.0);
        assert_eq!(pair.update_penetration(0.35, 0.1, None, -0.05), 0.0);
        assert_eq!((pair.depth, pair.uncounted), (0.35, 0.0));
        pair.update_penetration(0.9, 0.1, None, 0.0);
        assert!((pair.depth - 0.45).abs() < 1e-15 && (pair.uncounted - 0.45).abs() < 1e-15);
    }
}
