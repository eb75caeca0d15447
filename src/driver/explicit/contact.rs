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
        Contact { cylinder, nodes, stored: 0.0, dissipated: 0.0, left_with: 0.0, frequency }
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
        let Cylinder { radius, friction, .. } = self.cylinder;
        let (mut total, mut stored, mut dissipated) = (0.0, self.left_with, 0.0);
        for node in &mut self.nodes {
            let u = displacement[node.number as usize].map(Into::into);
            let [x, y] = [node.reference[0] + u[0], node.reference[1] + u[1] - axis];
            let square = x * x + y * y;
            let step: [f64; 3] = std::array::from_fn(|i| u[i] - node.displacement[i] - [0.0, moved, 0.0][i]);
            node.displacement = u;
            if square >= radius * radius {
                (node.friction, node.stored) = ([0.0; 3], 0.0);
                continue;
            }
            let distance = square.sqrt();
            let normal = [x / distance, y / distance, 0.0];
            let depth = radius - distance;
            let pressing = node.stiffness * depth;
            // Sticking is a spring as stiff as the penalty, in the tangent plane; slipping lets it go.
            let trial = tangential(std::array::from_fn(|i| node.friction[i] - node.stiffness * step[i]), normal);
            let size = trial.iter().map(|t| t * t).sum::<f64>().sqrt();
            let limit = friction * pressing;
            node.friction = trial;
            if size > limit {
                node.friction = trial.map(|t| t * (limit / size));
                dissipated += limit * (size - limit) / node.stiffness;
            }
            let held = size.min(limit);
            node.stored = 0.5 * (pressing * depth + held * held / node.stiffness);
            stored += node.stored;
            let force: [f64; 3] = std::array::from_fn(|i| pressing * normal[i] + node.friction[i]);
            for (to, from) in forces[node.number as usize].iter_mut().zip(force) {
                *to += T::from_f64(from);
            }
            total -= force[1];
        }
        self.stored = stored;
        self.dissipated += dissipated;
        total
    }
}

fn tangential(v: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    let along = v[0] * normal[0] + v[1] * normal[1] + v[2] * normal[2];
    std::array::from_fn(|i| v[i] - along * normal[i])
}
