//! The rigid striker as quadrangles: a hemisphere that looks at the panel, the end of a cylinder and its wall, or half
//! of a cylinder across the yarn.

use std::f64::consts::FRAC_PI_4;

use toron_explicit_host::contact::Shape;

/// Quadrangles along the arc of half a cylinder, and along an edge of the cube that a hemisphere is made of, at most.
/// Their middles lie 0.05 % of the radius inside the cylinder, 0.03 % inside the sphere.
const MOST_DIVISIONS: usize = 48;
/// Of a striker that is small beside the yarns: so many for each height of a yarn that its radius has, for quadrangles
/// are not to be smaller than the distance at which the contact begins.
const DIVISIONS: f64 = 2.0;

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
    /// Quadrangles along an edge of the cube, an even number; a cylinder across the yarn has none.
    pub divisions: usize,
}

/// How finely a striker of this radius is drawn that strikes yarns of this height.
pub fn divisions(radius: f64, height: f64) -> usize {
    let half = (0.5 * DIVISIONS * radius / height).ceil() as usize;
    2 * half.clamp(1, MOST_DIVISIONS / 2)
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

    /// What of which body the model has of it.
    pub fn described(&self) -> &'static str {
        match self.shape {
            Shape::Sphere => "half of a rigid sphere",
            Shape::Cylinder => "half of a rigid cylinder across the yarn",
            Shape::Flat => "the flat end, and two radii of the wall, of a rigid cylinder",
            Shape::Hemisphere => "the hemispherical end, and one radius of the wall, of a rigid cylinder",
        }
    }

    /// Its surface, so far inside the radius: a host's contact may begin at a distance from it.
    pub fn surface(&self, inside: f64) -> Surface {
        let radius = self.radius - inside;
        let whole = self.divisions;
        match self.shape {
            Shape::Sphere => box_of(self.centre, whole, whole / 2, |point| on_sphere(point, radius)),
            Shape::Hemisphere => box_of(self.centre, whole, whole, |point| {
                let rim = on_sphere([point[0], point[1], point[2].min(0.0)], radius);
                [rim[0], rim[1], rim[2] + radius * point[2].max(0.0)]
            }),
            Shape::Flat => box_of(self.centre, whole, whole, |[x, y, z]| {
                let [across, along] = on_disc(x, y).map(|x| radius * x);
                // The end lies as far inside as the wall.
                [across, along, radius * z]
            }),
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

/// A point of a sphere by one of the cube about it; equal angles make quadrangles alike.
fn on_sphere(point: [f64; 3], radius: f64) -> [f64; 3] {
    let direction = point.map(|x| (FRAC_PI_4 * x).tan());
    (radius * nalgebra::Vector3::from(direction).normalize()).into()
}

/// A point of the disc of radius 1 by one of the square about it, whose sides are the circle.
fn on_disc(x: f64, y: f64) -> [f64; 2] {
    [x * (1.0 - 0.5 * y * y).sqrt(), y * (1.0 - 0.5 * x * x).sqrt()]
}

/// The lower side and, from below, so many rows of the four other sides of a cube about `centre`, whose points go from
/// -1 to 1, drawn to where `place` has them from the centre.
fn box_of(centre: [f64; 3], divisions: usize, rows: usize, place: impl Fn([f64; 3]) -> [f64; 3]) -> Surface {
    let (n, rows) = (divisions as i64, rows as i64);
    let mut numbers = std::collections::HashMap::new();
    let (mut nodes, mut faces) = (Vec::new(), Vec::new());
    // Points of the cube by whole numbers from -n to n, two to a quadrangle.
    let mut node = |point: [i64; 3]| {
        *numbers.entry(point).or_insert_with(|| {
            let from = place(point.map(|i| i as f64 / n as f64));
            nodes.push([0, 1, 2].map(|i| centre[i] + from[i]));
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
        for j in 0..rows {
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
    let around = MOST_DIVISIONS;
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

    fn surface(shape: Shape, centre: [f64; 3], radius: f64) -> Surface {
        let striker = Striker {
            shape,
            radius,
            mass: 1.0,
            velocity: -1.0,
            friction: 0.0,
            centre,
            side: 0.4,
            divisions: MOST_DIVISIONS,
        };
        striker.surface(0.0)
    }

    #[test]
    fn a_hemisphere_is_closed_below_and_looks_outwards() {
        let centre = [0.0, 0.0, 3.0];
        let surface = surface(Shape::Sphere, centre, 2.0);
        check(&surface, |place| place - nalgebra::Vector3::from(centre));
        assert_eq!(surface.faces.len(), 3 * MOST_DIVISIONS * MOST_DIVISIONS);
        for node in &surface.nodes {
            let from = nalgebra::Vector3::from(*node) - nalgebra::Vector3::from(centre);
            assert!((from.norm() - 2.0).abs() < 1e-12 && from.z < 1e-12);
        }
        // Of a disc of quadrangles: one more node than faces, and half of those on the rim.
        assert_eq!(surface.nodes.len(), surface.faces.len() + 1 + 2 * MOST_DIVISIONS);
        assert!((surface.area() / (8.0 * std::f64::consts::PI) - 1.0).abs() < 1e-3, "{}", surface.area());
    }

    #[test]
    fn cylinders_have_an_end_and_a_wall() {
        let (centre, radius) = ([0.0, 0.0, 3.0], 2.0_f64);
        let pi = std::f64::consts::PI;
        // The end, and a wall of one or two radii.
        for (shape, area) in [(Shape::Hemisphere, 4.0 * pi * radius.powi(2)), (Shape::Flat, 5.0 * pi * radius.powi(2))]
        {
            let surface = surface(shape, centre, radius);
            check(&surface, |place| place - nalgebra::Vector3::from(centre));
            assert_eq!(surface.nodes.len(), surface.faces.len() + 1 + 2 * MOST_DIVISIONS);
            assert!((surface.area() / area - 1.0).abs() < 2e-3, "{shape:?}: {}", surface.area());
            for [x, y, z] in &surface.nodes {
                let (across, up) = (x.hypot(*y), z - centre[2]);
                let inside = match shape {
                    Shape::Flat => f64::min(radius - across, radius + up),
                    _ => radius - across.hypot(up.min(0.0)),
                };
                assert!(inside.abs() < 1e-12 && up < radius + 1e-12, "{shape:?}: {x} {y} {z}");
            }
        }
    }

    #[test]
    fn a_small_striker_is_drawn_as_finely_as_the_yarns_need() {
        // The thesis's on its yarns, and one of 0.8 mm.
        assert_eq!([2.778, 0.8, 1e-3].map(|radius| divisions(radius, 0.115)), [48, 14, 2]);
    }

    #[test]
    fn half_a_cylinder_looks_outwards() {
        let surface = surface(Shape::Cylinder, [0.0, 1.5, 0.0], 1.1);
        check(&surface, |place| nalgebra::Vector3::new(place.x, place.y - 1.5, 0.0));
        assert!(surface.nodes.iter().all(|node| node[1] <= 1.5 + 1e-12 && node[2].abs() <= 0.4));
    }
}
