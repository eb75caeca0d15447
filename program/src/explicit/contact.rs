//! A rigid cylinder across the yarn, against the nodes of its surface: penalty and Coulomb friction.

use super::element::Number;

/// The cylinder and what it does to a surface. Its axis lies across the yarn; it moves along axis 1 alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    pub radius: f64,
    /// Pressure by depth of penetration: the same contact whatever the mesh.
    pub stiffness: f64,
    /// Coulomb's coefficient.
    pub friction: f64,
}

/// A node that may be touched.
#[derive(Clone, Debug)]
struct Node {
    number: u32,
    /// Force by depth: the stiffness times the surface that belongs to it.
    stiffness: f64,
    reference: [f64; 3],
    /// The friction force on it, at the end of the last step.
    friction: [f64; 3],
    displacement: [f64; 3],
    /// Energy in its penetration and its sticking.
    stored: f64,
}

/// The surface, and what the contact has done so far.
#[derive(Clone, Debug)]
pub struct Contact {
    cylinder: Cylinder,
    nodes: Vec<Node>,
    /// Stored in penetrations and in sticking, nodes that have left included; dissipated by slipping.
    pub stored: f64,
    pub dissipated: f64,
    left_with: f64,
    /// The square of the highest frequency that it adds to a node's.
    pub frequency: f64,
    /// Sum of the stiffnesses of the nodes that are touched.
    pub touching: f64,
}

impl Contact {
    /// Nodes with a surface of their own are met.
    pub fn new(cylinder: Cylinder, reference: &[[f64; 3]], surface: &[f64], mass: &[f64]) -> Self {
        let met = (0..reference.len()).filter(|&i| surface[i] > 0.0);
        let node = |i: usize| Node {
            number: i as u32,
            stiffness: cylinder.stiffness * surface[i],
            reference: reference[i],
            friction: [0.0; 3],
            displacement: [0.0; 3],
            stored: 0.0,
        };
        let nodes: Vec<Node> = met.map(node).collect();
        let frequency = nodes.iter().map(|node| node.stiffness / mass[node.number as usize]).fold(0.0, f64::max);
        Contact { cylinder, nodes, stored: 0.0, dissipated: 0.0, left_with: 0.0, frequency, touching: 0.0 }
    }

    /// Nodes that belong to no element any more leave.
    pub fn remove(&mut self, gone: impl Fn(usize) -> bool) {
        let leaving = self.nodes.iter().filter(|node| gone(node.number as usize));
        self.left_with += leaving.map(|node| node.stored).sum::<f64>();
        self.nodes.retain(|node| !gone(node.number as usize));
    }

    /// Adds the contact's forces to the nodes' and returns the force on the cylinder along axis 1. `axis` is the height of
    /// the cylinder's axis, `moved` how far it has moved in the step that led here.
    pub fn apply<T: Number>(&mut self, axis: f64, moved: f64, displacement: &[[T; 3]], forces: &mut [[T; 3]]) -> f64 {
        (self.stored, self.touching) = (self.left_with, 0.0);
        let mut total = 0.0;
        for node in &mut self.nodes {
            let u = displacement[node.number as usize].map(Into::into);
            let (pressing, dissipated) = node.meet(&self.cylinder, axis, moved, u);
            self.dissipated += dissipated;
            if pressing == [0.0; 3] {
                continue;
            }
            self.stored += node.stored;
            self.touching += node.stiffness;
            let force: [f64; 3] = std::array::from_fn(|i| pressing[i] + node.friction[i]);
            for (to, from) in forces[node.number as usize].iter_mut().zip(force) {
                *to += T::from_f64(from);
            }
            total -= force[1];
        }
        total
    }
}

impl Node {
    /// Moves the node to its new displacement; returns the force that presses it outwards and what slipping has dissipated.
    ///
    /// Sticking is a spring as stiff as the penalty, in the tangent plane; slipping or leaving lets it go. What is dissipated
    /// is the friction's work over the step, by the trapezoidal rule of central differences, less what the spring has gained.
    fn meet(&mut self, cylinder: &Cylinder, axis: f64, moved: f64, u: [f64; 3]) -> ([f64; 3], f64) {
        let step: [f64; 3] = std::array::from_fn(|i| u[i] - self.displacement[i] - [0.0, moved, 0.0][i]);
        self.displacement = u;
        let [x, y] = [self.reference[0] + u[0], self.reference[1] + u[1] - axis];
        let square = x * x + y * y;
        if square >= cylinder.radius * cylinder.radius && self.friction == [0.0; 3] {
            self.stored = 0.0;
            return ([0.0; 3], 0.0);
        }
        let distance = square.sqrt();
        // A node on the axis itself is pressed down.
        let normal = if distance > 0.0 { [x / distance, y / distance, 0.0] } else { [0.0, -1.0, 0.0] };
        let depth = (cylinder.radius - distance).max(0.0);
        let force = self.stiffness * depth;
        let old = self.friction;
        let trial = tangential(std::array::from_fn(|i| old[i] - self.stiffness * step[i]), normal);
        let size = dot(trial, trial).sqrt();
        let limit = cylinder.friction * force;
        self.friction = if size > limit { trial.map(|t| t * (limit / size)) } else { trial };
        let [before, after] = [old, self.friction].map(|f| 0.5 * dot(f, f) / self.stiffness);
        let work = -0.5 * (dot(old, step) + dot(self.friction, step));
        self.stored = 0.5 * force * depth + after;
        (normal.map(|n| n * force), work - (after - before))
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn tangential(v: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    let along = dot(v, normal);
    std::array::from_fn(|i| v[i] - along * normal[i])
}

#[cfg(test)]
mod tests {
    use super::*;

    const CYLINDER: Cylinder = Cylinder { radius: 1.0, stiffness: 100.0, friction: 0.5 };

    /// A node of unit surface and mass, a tenth inside the cylinder, whose axis is at this height.
    const AXIS: f64 = 0.9;

    fn contact() -> Contact {
        let mut contact = Contact::new(CYLINDER, &[[0.0; 3]], &[1.0], &[1.0]);
        step(&mut contact, AXIS, 0.0, [0.0; 3]);
        contact
    }

    /// The force on the node.
    fn step(contact: &mut Contact, axis: f64, moved: f64, displacement: [f64; 3]) -> [f64; 3] {
        let mut forces = [[0.0; 3]];
        contact.apply(axis, moved, &[displacement], &mut forces);
        forces[0]
    }

    #[track_caller]
    fn assert_close(value: f64, expected: f64) {
        assert!((value - expected).abs() < 1e-9, "{value}, expected {expected}");
    }

    #[test]
    fn what_sticks_is_a_spring() {
        let mut contact = contact();
        let force = step(&mut contact, AXIS, 0.0, [0.0, 0.0, 1e-3]);
        assert_close(force[1], -10.0);
        assert_close(force[2], -0.1);
        assert_close(contact.stored, 0.5 * 100.0 * 0.01 + 0.5 * 100.0 * 1e-6);
        assert_close(contact.dissipated, 0.0);
    }

    #[test]
    fn slipping_dissipates_its_work_and_leaving_the_spring_s() {
        let mut contact = contact();
        let force = (1..=100).fold([0.0; 3], |_, i| step(&mut contact, AXIS, 0.0, [0.0, 0.0, 0.01 * f64::from(i)]));
        // Half of the pressing 10, over all but the 0.05 that stretch the spring.
        assert_close(force[2], -5.0);
        assert_close(contact.dissipated, 5.0 * 0.95);
        step(&mut contact, AXIS + 1.0, 1.0, [0.0, 0.0, 1.0]);
        assert_close(contact.stored, 0.0);
        assert_close(contact.dissipated, 5.0 * 0.95 + 0.5 * 5.0 * 0.05);
    }

    #[test]
    fn a_node_on_the_axis_is_pressed_down() {
        assert_close(step(&mut contact(), 0.0, -AXIS, [0.0; 3])[1], -100.0);
    }
}
