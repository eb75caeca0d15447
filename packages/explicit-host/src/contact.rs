//! A rigid cylinder or sphere against the nodes of a body's surface: penalty and Coulomb friction.

use serde::{Deserialize, Serialize};

use super::friction::coulomb_return;
use super::global_estimate::CONTACT;
use super::lanes::Number;
use super::vector::{Vector, add, dot, times};

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Shape {
    /// Its axis lies along axis 2; it moves along axis 1.
    Cylinder,
    /// It moves along axis 2, downwards, as do the two after it.
    Sphere,
    /// A cylinder along axis 2 with a flat lower end. What is called its centre is one radius above that end.
    Flat,
    /// One whose lower end is a half of a sphere.
    Hemisphere,
}

impl Shape {
    /// The axis along which it moves.
    pub fn direction(self) -> usize {
        match self {
            Shape::Cylinder => 1,
            Shape::Sphere | Shape::Flat | Shape::Hemisphere => 2,
        }
    }

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Shape::Sphere => "sphere",
            Shape::Cylinder | Shape::Flat | Shape::Hemisphere => "cylinder",
        }
    }
}

/// What strikes, and the parameters of its contact. It moves along one axis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RigidSurface {
    pub shape: Shape,
    pub radius: f64,
    /// Pressure by depth of penetration: the same contact whatever the mesh.
    pub stiffness: f64,
    /// Coulomb's coefficient.
    pub friction: f64,
    /// Where its axis of motion passes the plane across it: x and y of what moves along z. That of a cylinder across a
    /// yarn passes the origin.
    pub aim: [f64; 2],
}

/// Nodes that are nearer than this many times the motion of the last step, and this part of the radius, may touch soon.
const STEPS_AHEAD: f64 = 2.0;
const SOON: f64 = 1e-3;

/// A node that may be touched.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Node {
    number: u32,
    /// Force by depth: the stiffness times the surface that belongs to it.
    stiffness: f64,
    /// The friction force on it, at the end of the last step.
    friction: Vector,
    /// Energy in its penetration and its sticking.
    stored: f64,
    /// Whether it touches, or may do so soon.
    counts: bool,
}

/// Where a body's nodes are, and how they got there.
#[derive(Clone, Copy, Debug)]
pub struct Nodes<'a, T> {
    pub reference: &'a [[f64; 3]],
    pub displacement: &'a [[T; 3]],
    /// In the last step, and its length.
    pub velocity: &'a [[T; 3]],
    pub step: f64,
    /// No node has moved farther in it.
    pub farthest: f64,
}

/// The surface, and what the contact has done so far.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Contact {
    striker: RigidSurface,
    nodes: Vec<Node>,
    /// Stored in penetrations and in sticking, nodes that have left included; dissipated by slipping.
    pub stored: f64,
    pub dissipated: f64,
    /// What nodes had stored that have left.
    released: f64,
    /// Nothing touches before body and striker have moved so far.
    clear: f64,
    /// Whether something touches, or may do so soon.
    is_near: bool,
    /// Sum of the stiffnesses of the nodes that are touched.
    pub touching: f64,
}

impl Contact {
    /// Nodes with a share of the surface take part.
    pub fn new(striker: RigidSurface, surface: &[f64]) -> Self {
        let met = (0..surface.len()).filter(|&i| surface[i] > 0.0);
        let node = |i: usize| Node {
            number: i as u32,
            stiffness: striker.stiffness * surface[i],
            friction: [0.0; 3],
            stored: 0.0,
            counts: false,
        };
        let nodes = met.map(node).collect();
        Contact {
            striker,
            nodes,
            stored: 0.0,
            dissipated: 0.0,
            released: 0.0,
            clear: 0.0,
            is_near: false,
            touching: 0.0,
        }
    }

    /// Removes the nodes that belong to no element any more; the energy balance keeps what they have stored.
    pub fn remove(&mut self, gone: impl Fn(usize) -> bool) {
        let leaving = self.nodes.iter().filter(|node| gone(node.number as usize));
        self.released += leaving.map(|node| node.stored).sum::<f64>();
        self.nodes.retain(|node| !gone(node.number as usize));
    }

    /// Adds the contact's forces to the nodes' and returns the force on the striker along its direction. `centre` is
    /// where it is on that axis, `moved` how far it has moved in the step that led here. The stiffnesses of what
    /// touches, or may do so soon, are added to the nodes' springs.
    pub fn apply<T: Number>(
        &mut self,
        centre: f64,
        moved: f64,
        body: Nodes<'_, T>,
        forces: &mut [[T; 3]],
        springs: &mut [f64],
    ) -> f64 {
        (self.stored, self.touching) = (self.released, 0.0);
        let motion = body.farthest + moved.abs();
        self.clear -= motion;
        // What may touch in the next steps counts in their length before it does.
        let soon = STEPS_AHEAD * motion + SOON * self.striker.radius;
        if self.clear > soon {
            self.is_near = false;
            return 0.0;
        }
        self.is_near = true;
        let (mut total, mut deepest, mut held) = (0.0, f64::NEG_INFINITY, false);
        for node in &mut self.nodes {
            let number = node.number as usize;
            let ([x, y, z], [u, v, w]) = (body.reference[number], body.displacement[number]);
            let place = [x + u.into(), y + v.into(), z + w.into()];
            let [x, y, z] = body.velocity[number];
            let step = times(body.step, [x.into(), y.into(), z.into()]);
            let (depth, normal) = self.striker.meet(centre, place);
            deepest = if depth > deepest { depth } else { deepest };
            node.counts = depth > -soon;
            if node.counts {
                springs[number] += node.stiffness;
            }
            let (pressing, dissipated) = node.update(&self.striker, moved, depth, normal, step);
            self.dissipated += dissipated;
            held |= node.friction != [0.0; 3];
            let Some(pressing) = pressing else { continue };
            self.stored += node.stored;
            self.touching += node.stiffness;
            let force = add(pressing, 1.0, node.friction);
            let nodal = &mut forces[number];
            for i in 0..3 {
                nodal[i] += T::from_f64(force[i]);
            }
            total -= force[self.striker.shape.direction()];
        }
        // Not above 0 where a node is inside.
        self.clear = if held { 0.0 } else { -deepest };
        total
    }

    /// Adds to what resists a trial motion of the body, as if nodes stuck to a striker at rest.
    pub fn resist<T: Number>(&self, motion: &[[T; 3]], resisted: &mut [[T; 3]]) {
        for node in self.nodes.iter().filter(|node| self.is_near && node.counts) {
            let (number, stiffness) = (node.number as usize, T::from_f64(CONTACT * node.stiffness));
            for i in 0..3 {
                resisted[number][i] -= stiffness * motion[number][i];
            }
        }
    }
}

impl RigidSurface {
    /// How deep a place is in it, and the normal of its surface there; its centre is here. Outside the depth is
    /// negative, and a place is as far from it or farther.
    #[inline(always)]
    fn meet(&self, centre: f64, place: Vector) -> (f64, Vector) {
        let direction = self.shape.direction();
        let mut from = place;
        from[direction] -= centre;
        from[0] -= self.aim[0];
        from[1] -= self.aim[1];
        match self.shape {
            Shape::Cylinder => from[2] = 0.0,
            Shape::Hemisphere => from[2] = from[2].min(0.0),
            Shape::Flat => {
                let across = from[0].hypot(from[1]);
                let (inside_end, inside_wall) = (from[2] + self.radius, self.radius - across);
                if inside_end <= inside_wall || across == 0.0 {
                    return (inside_end, [0.0, 0.0, -1.0]);
                }
                return (inside_wall, [from[0] / across, from[1] / across, 0.0]);
            }
            Shape::Sphere => {}
        }
        let distance = dot(from, from).sqrt();
        // A node at the centre itself is pressed along the axis, downwards.
        let mut normal = [0.0; 3];
        normal[direction] = -1.0;
        if distance > 0.0 {
            normal = times(1.0 / distance, from);
        }
        (self.radius - distance, normal)
    }
}

impl Node {
    /// The node is so deep in the striker, whose surface has this normal there, after a step like this; returns the
    /// force that presses it outwards, if it is inside, and what slipping, or letting go, has dissipated.
    #[inline(always)]
    fn update(
        &mut self,
        striker: &RigidSurface,
        moved: f64,
        depth: f64,
        normal: Vector,
        mut step: Vector,
    ) -> (Option<Vector>, f64) {
        step[striker.shape.direction()] -= moved;
        if depth <= 0.0 && self.friction == [0.0; 3] {
            self.stored = 0.0;
            return (None, 0.0);
        }
        let depth = depth.max(0.0);
        let force = self.stiffness * depth;
        let friction = coulomb_return(self.friction, self.stiffness, step, normal, striker.friction * force);
        self.friction = friction.force;
        self.stored = 0.5 * force * depth + friction.stored;
        ((depth > 0.0).then_some(times(force, normal)), friction.dissipated)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CYLINDER: RigidSurface =
        RigidSurface { shape: Shape::Cylinder, radius: 1.0, stiffness: 100.0, friction: 0.5, aim: [0.0; 2] };

    /// A node of unit surface and mass, a tenth inside the cylinder, whose axis is at this height.
    const AXIS: f64 = 0.9;

    struct Node {
        contact: Contact,
        reference: [f64; 3],
        displacement: [f64; 3],
    }

    impl Node {
        fn new(striker: RigidSurface, reference: [f64; 3]) -> Node {
            Node { contact: Contact::new(striker, &[1.0]), reference, displacement: [0.0; 3] }
        }

        /// The force on the node, and that on the striker.
        fn step(&mut self, axis: f64, moved: f64, displacement: [f64; 3]) -> ([f64; 3], f64) {
            let mut forces = [[0.0; 3]];
            let velocity = [0, 1, 2].map(|i| displacement[i] - self.displacement[i]);
            let farthest = dot(velocity, velocity).sqrt();
            let nodes = Nodes {
                reference: &[self.reference],
                displacement: &[displacement],
                velocity: &[velocity],
                step: 1.0,
                farthest,
            };
            let on_striker = self.contact.apply(axis, moved, nodes, &mut forces, &mut [0.0]);
            self.displacement = displacement;
            (forces[0], on_striker)
        }
    }

    fn inside() -> Node {
        let mut node = Node::new(CYLINDER, [0.0; 3]);
        node.step(AXIS, 0.0, [0.0; 3]);
        node
    }

    #[track_caller]
    fn assert_close(value: f64, expected: f64) {
        assert!((value - expected).abs() < 1e-9, "{value}, expected {expected}");
    }

    #[test]
    fn what_sticks_is_a_spring() {
        let mut node = inside();
        let force = node.step(AXIS, 0.0, [0.0, 0.0, 1e-3]).0;
        assert_close(force[1], -10.0);
        assert_close(force[2], -0.1);
        assert_close(node.contact.stored, 0.5 * 100.0 * 0.01 + 0.5 * 100.0 * 1e-6);
        assert_close(node.contact.dissipated, 0.0);
    }

    #[test]
    fn slipping_dissipates_its_work_and_leaving_the_spring_s() {
        let mut node = inside();
        let force = (1..=100).fold([0.0; 3], |_, i| node.step(AXIS, 0.0, [0.0, 0.0, 0.01 * f64::from(i)]).0);
        // Half of the pressing 10, over all but the 0.05 that stretch the spring.
        assert_close(force[2], -5.0);
        assert_close(node.contact.dissipated, 5.0 * 0.95);
        node.step(AXIS + 1.0, 1.0, [0.0, 0.0, 1.0]);
        assert_close(node.contact.stored, 0.0);
        assert_close(node.contact.dissipated, 5.0 * 0.95 + 0.5 * 5.0 * 0.05);
    }

    #[test]
    fn a_sphere_presses_towards_its_surface() {
        let sphere = RigidSurface { shape: Shape::Sphere, ..CYLINDER };
        let reference = [0.48, 0.0, 0.64];
        let mut node = Node::new(sphere, reference);
        // A fifth inside, then slid along the sphere's equator.
        let (force, on_sphere) = node.step(0.0, 0.0, [0.0; 3]);
        for (found, expected) in force.into_iter().zip([0.6 * 20.0, 0.0, 0.8 * 20.0]) {
            assert_close(found, expected);
        }
        assert_close(on_sphere, -16.0);
        let (force, _) = node.step(0.0, 0.0, [0.0, 1e-3, 0.0]);
        assert!(f64::abs(force[1] + 0.1 - 0.025) < 1e-3, "spring less what presses outwards: {force:?}");
    }

    /// Wherever it aims, what lies there meets it as what lies at the origin meets one that aims there.
    #[test]
    fn a_striker_meets_what_it_aims_at() {
        for shape in [Shape::Sphere, Shape::Flat, Shape::Hemisphere] {
            let force = |aim: [f64; 2], [x, y, z]: [f64; 3]| {
                let striker = RigidSurface { shape, aim, ..CYLINDER };
                Node::new(striker, [x + aim[0], y + aim[1], z]).step(0.0, 0.0, [0.0; 3]).0
            };
            let place = [0.3, -0.2, -0.85];
            let [centred, aside] = [[0.0; 2], [0.25, -0.5]].map(|aim| force(aim, place));
            assert!(centred[2] < 0.0);
            (0..3).for_each(|i| assert_close(aside[i], centred[i]));
        }
    }

    #[test]
    fn a_cylinder_presses_down_under_its_end_and_out_beside_its_wall() {
        for (shape, under, beside) in [
            (Shape::Flat, [0.0, 0.0, -10.0], [10.0, 0.0, 0.0]),
            // Under the end's edge the half of a sphere is 0.1 above the place; beside the wall both are alike.
            (Shape::Hemisphere, [0.0; 3], [10.0, 0.0, 0.0]),
        ] {
            let force = |place: [f64; 3]| {
                let mut node = Node::new(RigidSurface { shape, friction: 0.0, ..CYLINDER }, place);
                node.step(0.0, 0.0, [0.0; 3]).0
            };
            let found = [force([0.8, 0.0, -0.9]), force([0.9, 0.0, 2.0])];
            for (found, expected) in found.into_iter().flatten().zip(under.into_iter().chain(beside)) {
                assert_close(found, expected);
            }
            // At the lowest point both press by the depth.
            assert_close(force([0.0, 0.0, -0.9])[2], -10.0);
            assert_eq!([force([0.0, 0.0, -1.1]), force([1.1, 0.0, 2.0])], [[0.0; 3]; 2]);
        }
    }

    #[test]
    fn a_node_on_the_axis_is_pressed_down() {
        assert_close(inside().step(0.0, -AXIS, [0.0; 3]).0[1], -100.0);
    }

    #[test]
    fn what_was_far_is_met_when_it_comes_near() {
        let mut node = Node::new(CYLINDER, [0.0, -1.5, 0.0]);
        for i in 1..=20 {
            let ([_, y, _], _) = node.step(-0.01 * f64::from(i), -0.01, [0.0, 0.02 * f64::from(i), 0.0]);
            let depth = (0.03 * f64::from(i) - 0.5).max(0.0);
            assert_close(y, -100.0 * depth);
        }
    }
}
