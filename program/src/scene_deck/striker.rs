//! The rigid striker as quadrangles: a hemisphere that looks at the panel, or half of a cylinder across the yarn.

use std::f64::consts::FRAC_PI_4;

use crate::explicit::contact::Shape;

/// Quadrangles along an edge of the cube that a hemisphere is made of, and along the arc of half a cylinder. Their middles lie
/// 0.03 % of the radius inside the sphere, 0.05 % inside the cylinder.
const DIVISIONS: usize = 48;

/// A rigid body that moves along one axis.
pub struct Striker {
    pub shape: Shape,
    pub radius: f64,
    /// Its part that the model has.
    pub mass: f64,
    /// Along the axis of its motion.
    pub velocity: f64,
    pub friction: f64,
    /// Where its centre is, as it first touches.
    pub centre: [f64; 3],
    /// Half of a cylinder's length.
    pub side: f64,
}

/// What is met of it.
pub struct Surface {
    pub nodes: Vec<[f64; 3]>,
    /// Counterclockwise seen from outside.
    pub faces: Vec<[u32; 4]>,
}

impl Striker {
    /// The axis of its motion.
    pub fn axis(&self) -> usize {
        self.shape.direction()
    }

    /// Its surface, so far inside the radius: a host's contact may begin at a distance from it.
    pub fn surface(&self, inside: f64) -> Surface {
        let radius = self.radius - inside;
        match self.shape {
            Shape::Sphere | Shape::Flat | Shape::Hemisphere => hemisphere(self.centre, radius),
            Shape::Cylinder => half_cylinder(self.centre, radius, self.side),
        }
    }
}

impl Surface {
    pub fn area(&self) -> f64 {
        let area = |face: &[u32; 4]| {
            let [a, b, c, d] = face.map(|node| nalgebra::Vector3::from(self.nodes[node as usize]));
            0.5 * (c - a).cross(&(d - b)).norm()
        };
        self.faces.iter().map(area).sum()
    }
}

/// The half of a sphere about `centre` that has the lower z: five sides of a cube, of which four are halved, drawn to the radius.
fn hemisphere(centre: [f64; 3], radius: f64) -> Surface {
    let (n, half) = (DIVISIONS as i64, DIVISIONS as i64 / 2);
    let mut numbers = std::collections::HashMap::new();
    let (mut nodes, mut faces) = (Vec::new(), Vec::new());
    // Points of the cube by whole numbers from -n to n, two to a quadrangle; equal angles make quadrangles alike.
    let mut node = |point: [i64; 3]| {
        *numbers.entry(point).or_insert_with(|| {
            let direction = point.map(|i| (FRAC_PI_4 * i as f64 / n as f64).tan());
            let direction = nalgebra::Vector3::from(direction).normalize();
            nodes.push([0, 1, 2].map(|i| centre[i] + radius * direction[i]));
            nodes.len() as u32 - 1
        })
    };
    let step = |i: i64| 2 * i - n;
    for i in 0..n {
        for j in 0..n {
            let [x, y, right, back] = [step(i), step(j), step(i + 1), step(j + 1)];
            // Counterclockwise seen from below.
            faces.push([[x, y, -n], [x, back, -n], [right, back, -n], [right, y, -n]].map(&mut node));
        }
        for j in 0..half {
            let [a, b, low, high] = [step(i), step(i + 1), step(j), step(j + 1)];
            faces.push([[a, -n, low], [b, -n, low], [b, -n, high], [a, -n, high]].map(&mut node));
            faces.push([[b, n, low], [a, n, low], [a, n, high], [b, n, high]].map(&mut node));
            faces.push([[-n, b, low], [-n, a, low], [-n, a, high], [-n, b, high]].map(&mut node));
            faces.push([[n, a, low], [n, b, low], [n, b, high], [n, a, high]].map(&mut node));
        }
    }
    Surface { nodes, faces }
}

/// The half of a cylinder along z about `centre` that has the lower y.
fn half_cylinder(centre: [f64; 3], radius: f64, side: f64) -> Surface {
    let around = DIVISIONS;
    let arc = std::f64::consts::PI / around as f64;
    let along = (2.0 * side / (arc * radius)).ceil().max(1.0) as usize;
    let mut nodes = Vec::new();
    for i in 0..=around {
        let (sine, cosine) = (arc * i as f64).sin_cos();
        for j in 0..=along {
            let z = side * (2.0 * j as f64 / along as f64 - 1.0);
            nodes.push([centre[0] - radius * cosine, centre[1] - radius * sine, z]);
        }
    }
    let number = |i: usize, j: usize| (i * (along + 1) + j) as u32;
    let face = |i: usize, j: usize| [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
    let faces = (0..around).flat_map(|i| (0..along).map(move |j| face(i, j))).collect();
    Surface { nodes, faces }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every face looks away from the axis or the centre.
    fn check(surface: &Surface, from: impl Fn(nalgebra::Vector3<f64>) -> nalgebra::Vector3<f64>) {
        for face in &surface.faces {
            let corners = face.map(|node| nalgebra::Vector3::from(surface.nodes[node as usize]));
            let normal = (corners[2] - corners[0]).cross(&(corners[3] - corners[1]));
            assert!(normal.dot(&from(corners.iter().sum::<nalgebra::Vector3<f64>>() / 4.0)) > 0.0, "{corners:?}");
        }
    }

    #[test]
    fn a_hemisphere_is_closed_below_and_looks_outwards() {
        let centre = [0.0, 0.0, 3.0];
        let surface = hemisphere(centre, 2.0);
        check(&surface, |place| place - nalgebra::Vector3::from(centre));
        assert_eq!(surface.faces.len(), 3 * DIVISIONS * DIVISIONS);
        for node in &surface.nodes {
            let from = nalgebra::Vector3::from(*node) - nalgebra::Vector3::from(centre);
            assert!((from.norm() - 2.0).abs() < 1e-12 && from.z < 1e-12);
        }
        // Of a disc of quadrangles: one more node than faces, and half of those on the rim.
        assert_eq!(surface.nodes.len(), surface.faces.len() + 1 + 2 * DIVISIONS);
        assert!((surface.area() / (8.0 * std::f64::consts::PI) - 1.0).abs() < 1e-3, "{}", surface.area());
    }

    #[test]
    fn half_a_cylinder_looks_outwards() {
        let surface = half_cylinder([0.0, 1.5, 0.0], 1.1, 0.4);
        check(&surface, |place| nalgebra::Vector3::new(place.x, place.y - 1.5, 0.0));
        assert!(surface.nodes.iter().all(|node| node[1] <= 1.5 + 1e-12 && node[2].abs() <= 0.4));
    }
}
