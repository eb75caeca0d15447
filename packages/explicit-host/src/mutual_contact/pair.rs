//! A node and the face of another body that it is near: how deep it is, what presses it out, and what rubs on it.

use serde::{Deserialize, Serialize};

use super::face::{Met, Place, Query};
use super::motion::Motion;
use super::surface::{Surface, fetch};
use super::{Parameters, Scene};
use crate::friction::coulomb_return;
use crate::global_estimate::CONTACT;
use crate::lanes::Number;
use crate::vector::{Vector, add, dot, times};

/// A node that is no farther from a face's surface than this many times its motion against it in the last step may
/// touch it soon, and counts in the length of steps before it does.
const STEPS_AHEAD: f64 = 4.0;
/// One that is farther away is looked at again when it may have gone this part of the way: it may get faster.
const PART: f64 = 0.5;
/// Lengths closer than this part of themselves are the same.
const ROUNDING: f64 = 1e-6;

/// A node near a face of another body. What most steps ask of it comes first, in one line of the processor's memory.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[repr(C, align(64))]
pub struct Pair {
    pub node: u32,
    /// The other body, and the face of it that the node was last nearest to.
    pub master: u32,
    pub face: u32,
    /// The node cannot touch before its slab and the face's, by this number of [`Motion`]'s, have moved so far against
    /// each other as `free_until`.
    pub slabs: u32,
    pub place: Place,
    /// Force by depth.
    pub stiffness: f64,
    pub free_until: f64,
    /// How deep the node is, and what of its depth does not count: it has not come through this face by so much, but
    /// past an edge or an open end.
    pub depth: f64,
    pub uncounted: f64,
    /// Half the width of the onset, the node's motion in the step that brought it: the force begins so far before the
    /// face, and from so deep on is the stiffness times the depth. In between it is the mean over a step either way, and
    /// no energy comes of where within a step the node touches.
    pub onset: f64,
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
    /// Whether it counts in the length of steps.
    pub counts: bool,
}

/// What a pair gives to the corners of its face in a step.
#[derive(Clone, Copy, Debug)]
pub struct Exerted {
    pub node: u32,
    pub corners: [u32; 4],
    pub force: Vector,
    pub weights: [f64; 4],
    pub stiffness: f64,
    /// The stiffness over the face's part 1 − α of the bound of the spring's frequency, see [`Pair::exert`].
    pub spring: f64,
}

impl Exerted {
    /// What its spring resists of a trial motion of the node and of the face's body, as if it stuck.
    #[inline(always)]
    pub fn resist<T: Number>(&self, node: &[[T; 3]], face: &[[T; 3]]) -> Vector {
        let [x, y, z] = node[self.node as usize];
        let mut apart = [x.into(), y.into(), z.into()];
        for (weight, corner) in self.weights.into_iter().zip(self.corners) {
            let [x, y, z] = face[corner as usize];
            apart = add(apart, -weight, [x.into(), y.into(), z.into()]);
        }
        times(CONTACT * self.stiffness, apart)
    }
}

/// How long a pair is not looked at, and whose face it is near: kept beside the pairs, of most of which a step asks
/// nothing else.
#[derive(Clone, Copy, Debug)]
pub struct Wait {
    /// As [`Pair`] has them; infinite where it has left for good.
    until: f64,
    slabs: u32,
    pub master: u32,
}

impl Wait {
    /// Whether the pair is to be looked at: not where it has left for good, or where the node cannot have come to the
    /// part of the face's surface that it was last nearest to.
    #[inline(always)]
    pub fn is_over(&self, motion: &Motion) -> bool {
        let is_clear = (self.until > 0.0) & (motion.moved(self.slabs) < self.until);
        !is_clear
    }
}

impl Pair {
    /// Takes over where the node of body `number` is on the face; returns the force on it, if it is inside, and what
    /// slipping has dissipated.
    pub fn update(
        &mut self,
        &Query { face, place, met, .. }: &Query,
        number: usize,
        &Scene { parameters: Parameters { friction, deepest, .. }, surfaces, motion, .. }: &Scene,
    ) -> (Option<Vector>, f64) {
        let (own, master) = (&surfaces[number], &surfaces[self.master as usize]);
        let old = self.friction;
        let pressed = (self.face != face).then(|| self.work_over_half_stiffness(own, master));
        (self.face, self.place) = (face, place);
        let slip = met.map_or([0.0; 3], |met| self.slip(own, master, met.weights));
        let way = dot(slip, slip).sqrt();
        if let Some(met) = met.filter(|_| self.on_face.stiffness == 0.0) {
            self.begin(met.depth, way, -dot(met.normal, slip));
        }
        let Some(met) = met.filter(|met| met.depth > -self.onset && met.depth < deepest) else {
            return (None, self.stay_apart(met, slip, [number, self.master as usize], [own, master], motion));
        };
        let lost = self.update_penetration(met.depth, way, pressed, dot(met.normal, slip));
        let force = self.stiffness * self.pressing();
        let rough = if master.wall { 0.0 } else { friction };
        let friction = coulomb_return(old, self.stiffness, slip, met.normal, rough * force);
        self.friction = friction.force;
        self.stored = 0.5 * self.stiffness * self.held(self.depth) + friction.stored;
        let total = add(self.friction, force, met.normal);
        self.on_face = OnFace { force: total, weights: met.weights, stiffness: self.stiffness, counts: true };
        (Some(total), lost + friction.dissipated)
    }

    /// Where it may begin to be pressed, after a motion by `way`, of which `nearer` against the face, to a depth: nothing
    /// is held there. It may not have come by its motion alone, but to another face, and may have become slower.
    fn begin(&mut self, depth: f64, way: f64, nearer: f64) {
        self.onset = self.onset.min(way - depth).min(nearer).max(0.0);
        if self.onset > 0.0 {
            self.depth = -self.onset;
        }
    }

    /// Takes over that the node does not touch, or no more, after a motion by `slip` against the face; returns the
    /// energy that is lost.
    fn stay_apart(
        &mut self,
        met: Option<Met>,
        slip: Vector,
        bodies: [usize; 2],
        [own, master]: [&Surface; 2],
        motion: &Motion,
    ) -> f64 {
        let outside = met.filter(|met| met.depth <= 0.0);
        // Beyond the surface's border it may touch an edge at once.
        self.free_until = 0.0;
        // What friction held, and did in the step, is lost; what the depth held has been given back, unless the
        // face is lost as well.
        let lost = match outside {
            Some(_) if self.friction == [0.0; 3] => 0.0,
            Some(met) => coulomb_return(self.friction, self.stiffness, slip, met.normal, 0.0).dissipated,
            None => self.stored,
        };
        (self.friction, self.stored, self.on_face) = ([0.0; 3], 0.0, OnFace::default());
        (self.depth, self.uncounted, self.onset) = (0.0, 0.0, 0.0);
        self.known = outside.is_some();
        let Some(met) = outside else { return lost };
        let (gap, soon) = (-met.depth, STEPS_AHEAD * dot(slip, slip).sqrt());
        self.onset = (-dot(met.normal, slip)).clamp(0.0, gap);
        if gap <= soon {
            (self.on_face.weights, self.on_face.counts) = (met.weights, true);
            return lost;
        }
        let slabs = [own.slab_of_node(self.node), master.slab_of_face(self.face)];
        if let Some(between) = motion.between(bodies, slabs) {
            (self.slabs, self.free_until) = (between, motion.moved(between) + (gap - soon).min(PART * gap));
        }
        lost
    }

    /// Whether it touches, or may do so soon.
    #[inline(always)]
    pub fn counts(&self) -> bool {
        self.on_face.counts
    }

    #[inline(always)]
    pub fn is_pressed(&self) -> bool {
        self.on_face.stiffness > 0.0
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

    /// Has the processor fetch what a step asks of it.
    #[inline(always)]
    pub fn fetch(&self) {
        fetch(self.stored);
        fetch(self.on_face.stiffness);
    }

    #[inline(always)]
    pub fn wait(&self) -> Wait {
        let until = if self.has_left() { f64::INFINITY } else { self.free_until };
        Wait { until, slabs: self.slabs, master: self.master }
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
        // While it begins to be pressed, only what is more than its motion is a jump: what counts would change.
        let jumps =
            self.uncounted > 0.0 && self.depth >= self.onset || (depth - before).abs() > (1.0 + ROUNDING) * slip;
        self.known = true;
        if let Some(pressed) = pressed.filter(|_| jumps) {
            if self.onset > 0.0 {
                // As deep as holds as much without.
                (self.depth, self.onset) = (self.held(self.depth).sqrt(), 0.0);
            }
            // The work by the trapezoidal rule of central differences, over half the stiffness, is `pressed` and `out`
            // times the new depth.
            let held = self.depth * self.depth - pressed;
            let kept = 0.5 * ((out * out + 4.0 * held).max(0.0).sqrt() - out);
            self.depth = kept.clamp(0.0, depth.max(0.0));
            self.uncounted = (depth - self.depth).max(0.0);
            return 0.5 * self.stiffness * (held - self.depth * (self.depth + out)).max(0.0);
        }
        let expected = self.depth + (depth - before).clamp(-slip, slip);
        let least = (self.depth - slip).max(-self.onset);
        self.depth = expected.clamp(-self.onset, depth);
        self.uncounted = depth - self.depth;
        0.5 * self.stiffness * (self.held(least) - self.held(self.depth)).max(0.0)
    }

    /// The depth that counts, in the mean over what the node came by in a step, either way, outside counting as 0.
    #[inline(always)]
    fn pressing(&self) -> f64 {
        if self.depth >= self.onset {
            self.depth
        } else if self.depth <= -self.onset {
            0.0
        } else {
            (self.depth + self.onset) * (self.depth + self.onset) / (4.0 * self.onset)
        }
    }

    /// The energy that a depth holds, over half the stiffness.
    #[inline(always)]
    fn held(&self, depth: f64) -> f64 {
        if depth >= self.onset {
            depth * depth + self.onset * self.onset / 3.0
        } else if depth <= -self.onset {
            0.0
        } else {
            let into = depth + self.onset;
            into * into * into / (6.0 * self.onset)
        }
    }

    /// The work of what has pressed the node out of its face at the step's start, over half the stiffness.
    fn work_over_half_stiffness(&self, own: &Surface, master: &Surface) -> f64 {
        let force = add(self.on_face.force, -1.0, self.friction);
        let slip = self.slip(own, master, self.on_face.weights);
        dot(force, slip) / self.stiffness
    }

    /// How far the node has moved in the step against this place of its face.
    fn slip(&self, own: &Surface, master: &Surface, weights: [f64; 4]) -> Vector {
        let corners = weights.into_iter().zip(master.faces[self.face as usize]);
        corners.fold(own.state.points[self.node as usize].moved, |slip, (weight, corner)| {
            add(slip, -weight, master.state.points[corner as usize].moved)
        })
    }

    /// What it exerts on its face, and the node's part of its spring. What bounds the spring's frequency is divided
    /// between node and face by their masses: with the part α of the node a spring has the sizes 1/α there and, over
    /// the corners, 1/(1 − α).
    #[inline(always)]
    pub fn exert(&self, number: usize, &Scene { surfaces, .. }: &Scene) -> (f64, Exerted) {
        let (own, master) = (&surfaces[number], &surfaces[self.master as usize]);
        let (node, corners) = (own.state.points[self.node as usize].mass, master.faces[self.face as usize]);
        let OnFace { force, weights, .. } = self.on_face;
        let mut per_mass = 0.0;
        for i in 0..4 {
            per_mass += weights[i].abs() / master.state.points[corners[i] as usize].mass;
        }
        // Tied nodes have no mass of their own.
        let ratio = if node > 0.0 && per_mass.is_finite() { (node * per_mass).clamp(0.1, 10.0) } else { 1.0 };
        let spring = self.stiffness * (1.0 + 1.0 / ratio);
        let Pair { node, stiffness, .. } = *self;
        (stiffness * (1.0 + ratio), Exerted { node, corners, force, weights, stiffness, spring })
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

    /// A unit mass that comes at unit speed and goes again, in steps of 1: what its energy has gained, over what it was.
    fn bounce(frequency: f64, start: f64, averaged: bool) -> f64 {
        let onset = if averaged { 1.0 } else { 0.0 };
        let mut pair = Pair { stiffness: frequency * frequency, onset, depth: start, ..Pair::default() };
        let mut speed = 1.0;
        while pair.depth > -3.0 {
            speed -= pair.stiffness * pair.pressing();
            pair.depth += speed;
        }
        speed * speed - 1.0
    }

    /// Where within a step it touches makes energy, up to several times its own near the longest stable step 2/ω; the
    /// mean over a step does not.
    #[test]
    fn no_energy_comes_of_touching_within_a_step() {
        let worst = |frequency: f64, averaged: bool| {
            let gains = (0..100).map(|i| bounce(frequency, -2.0 - 0.01 * f64::from(i), averaged).abs());
            gains.fold(0.0, f64::max)
        };
        for frequency in [0.5, 1.0, 1.2, 1.4, 1.6, 1.8, 1.95] {
            let gain = worst(frequency, true);
            assert!(gain < 0.035, "{frequency}: {gain}");
        }
        assert!(worst(1.6, false) > 1.0 && worst(1.95, false) > 5.0);
    }

    /// However far before the face it was, and however much slower it comes than in the step before.
    #[test]
    fn nothing_is_lost_where_a_node_begins_to_be_pressed() {
        for (gap, way) in [(1.5, 0.7), (1.05, 0.1), (0.9, 0.9), (0.2, 0.6)] {
            for known in [true, false] {
                let mut pair = Pair { stiffness: STIFFNESS, onset: 1.0, known, ..Pair::default() };
                let depth = way - gap;
                pair.begin(depth, way, way);
                if depth <= -pair.onset {
                    continue;
                }
                let lost = pair.update_penetration(depth, way, Some(0.0), way);
                let (held, into) = (pair.held(pair.depth), pair.depth + pair.onset);
                assert!(lost == 0.0 && into <= way + 1e-15, "{gap} {way}: {lost} {into}");
                assert!(held <= way * way * way / 6.0 / pair.onset.max(1e-300), "{gap} {way}: {held}");
            }
        }
    }

    #[test]
    fn what_is_held_is_the_work_of_what_presses() {
        let mut pair = Pair { stiffness: STIFFNESS, onset: 0.4, ..Pair::default() };
        for depth in [-0.5, -0.39, -0.1, 0.0, 0.3, 0.41, 2.0] {
            pair.depth = depth;
            let slope = (pair.held(depth + 1e-5) - pair.held(depth - 1e-5)) / 2e-5;
            assert!((0.5 * slope - pair.pressing()).abs() < 1e-9, "{depth}");
        }
        pair.depth = 0.4;
        assert!((pair.held(0.4) - 0.16 - 0.16 / 3.0).abs() < 1e-15 && (pair.pressing() - 0.4).abs() < 1e-15);
    }
}
