//! A mesh of eight-node hexahedra, with the kinematics and the nodal forces of the fully integrated element,
//! independent of any solver.

use std::fmt::Write;

use nalgebra::{Matrix3, Vector3};

/// The corners in the natural coordinates, in the order of Abaqus and CalculiX.
const CORNERS: [[f64; 3]; 8] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
];

/// Nodes and elements count from 0 here, and from 1 in a deck.
#[derive(Clone, Default)]
pub struct Mesh {
    pub nodes: Vec<Vector3<f64>>,
    pub elements: Vec<[usize; 8]>,
}

/// One integration point: F, the gradients of the eight shape functions, and the volume that it stands for.
pub struct GaussPoint {
    pub f: Matrix3<f64>,
    pub gradients: [Vector3<f64>; 8],
    pub volume: f64,
}

impl Mesh {
    /// A block of `n` elements along each axis, of this size.
    pub fn block(n: [usize; 3], size: [f64; 3]) -> Mesh {
        let index = |i: usize, j: usize, k: usize| i + (n[0] + 1) * (j + (n[1] + 1) * k);
        let mut mesh = Mesh::default();
        for (k, j, i) in product(n[2] + 1, n[1] + 1, n[0] + 1) {
            let at = |axis: usize, step: usize| size[axis] * step as f64 / n[axis] as f64;
            mesh.nodes.push(Vector3::new(at(0, i), at(1, j), at(2, k)));
        }
        for (k, j, i) in product(n[2], n[1], n[0]) {
            let layer = |k| [index(i, j, k), index(i + 1, j, k), index(i + 1, j + 1, k), index(i, j + 1, k)];
            let ([a, b, c, d], [e, f, g, h]) = (layer(k), layer(k + 1));
            mesh.elements.push([a, b, c, d, e, f, g, h]);
        }
        mesh
    }

    /// A quarter of an elliptical cylinder along x, of these half axes along y and z: a square of n × n elements in its
    /// middle, n rings of 2n around it, one layer along x. Also the elements of the outermost ring: their face S4 is
    /// the skin.
    pub fn quarter_ellipse(n: usize, thickness: f64, axes: [f64; 2]) -> (Mesh, Vec<usize>) {
        let part = |i: usize| i as f64 / n as f64;
        let mut flat: Vec<[f64; 2]> = Vec::new();
        for (j, i) in (0..=n).flat_map(|j| (0..=n).map(move |i| (j, i))) {
            let size = 0.5 - 0.03 * (part(i).powi(2) + part(j).powi(2));
            flat.push([size * part(i), size * part(j)]);
        }
        let core = |i: usize, j: usize| i + (n + 1) * j;
        let mut quads: Vec<[usize; 4]> = (0..n)
            .flat_map(|j| (0..n).map(move |i| [core(i, j), core(i + 1, j), core(i + 1, j + 1), core(i, j + 1)]))
            .collect();
        let inside: Vec<usize> = (0..=n).map(|j| core(n, j)).chain((0..n).rev().map(|i| core(i, n))).collect();
        let mut previous = inside.clone();
        for ring in 1..=n {
            let start = flat.len();
            for (q, &from) in inside.iter().enumerate() {
                let (sine, cosine) = (0.5 * part(q) * std::f64::consts::FRAC_PI_2).sin_cos();
                let [y, z] = flat[from];
                flat.push([y + (cosine - y) * part(ring), z + (sine - z) * part(ring)]);
            }
            quads.extend((0..2 * n).map(|q| [previous[q], start + q, start + q + 1, previous[q + 1]]));
            previous = (start..flat.len()).collect();
        }
        let layer = |x: f64| flat.iter().map(move |[y, z]| Vector3::new(x, axes[0] * y, axes[1] * z));
        let nodes = layer(0.0).chain(layer(thickness)).collect();
        let far = flat.len();
        let drawn_out = |&[a, b, c, d]: &[usize; 4]| [a, b, c, d, a + far, b + far, c + far, d + far];
        let elements: Vec<_> = quads.iter().map(drawn_out).collect();
        let outermost = (elements.len() - 2 * n..elements.len()).collect();
        (Mesh { nodes, elements }, outermost)
    }

    /// The cards of the nodes and elements, into these sets; `first` are the numbers of the first ones.
    pub fn cards(&self, node_set: &str, element_set: &str, first: [usize; 2]) -> String {
        let mut text = format!("*NODE, NSET={node_set}\n");
        for (i, x) in self.nodes.iter().enumerate() {
            writeln!(text, "{}, {:.12e}, {:.12e}, {:.12e}", i + first[0], x.x, x.y, x.z).expect("a string");
        }
        writeln!(text, "*ELEMENT, TYPE=C3D8, ELSET={element_set}").expect("a string");
        for (i, nodes) in self.elements.iter().enumerate() {
            let nodes = nodes.map(|node| (node + first[0]).to_string());
            writeln!(text, "{}, {}", i + first[1], nodes.join(", ")).expect("a string");
        }
        text
    }

    /// The data lines of `*BOUNDARY`: what `displacement` prescribes of each node's three components.
    pub fn boundary(&self, displacement: impl Fn(&Vector3<f64>) -> [Option<f64>; 3]) -> String {
        let mut text = String::new();
        for (i, x) in self.nodes.iter().enumerate() {
            for (component, value) in displacement(x).into_iter().enumerate() {
                if let Some(value) = value {
                    writeln!(text, "{}, {c}, {c}, {value:.12e}", i + 1, c = component + 1).expect("a string");
                }
            }
        }
        text
    }

    /// The eight integration points of an element, 2 × 2 × 2, the first coordinate running fastest.
    pub fn gauss_points(&self, element: usize, displacements: &[Vector3<f64>]) -> [GaussPoint; 8] {
        let nodes = self.elements[element];
        std::array::from_fn(|point| {
            let at: [f64; 3] =
                std::array::from_fn(|axis| if point >> axis & 1 == 0 { -1.0 } else { 1.0 } / 3f64.sqrt());
            let natural = CORNERS.map(|corner| {
                let factor = |axis: usize| 1.0 + corner[axis] * at[axis];
                0.125 * Vector3::from_fn(|i, _| corner[i] * factor((i + 1) % 3) * factor((i + 2) % 3))
            });
            let sum = |of: &dyn Fn(usize) -> Vector3<f64>, with: &[Vector3<f64>; 8]| -> Matrix3<f64> {
                with.iter().enumerate().map(|(a, gradient)| of(nodes[a]) * gradient.transpose()).sum()
            };
            let jacobian = sum(&|node| self.nodes[node], &natural);
            let inverse = jacobian.try_inverse().expect("an element that is not degenerate");
            let gradients = natural.map(|gradient| inverse.transpose() * gradient);
            let f = Matrix3::identity() + sum(&|node| displacements[node], &gradients);
            GaussPoint { f, gradients, volume: jacobian.determinant() }
        })
    }

    /// The forces by which the material resists at the nodes: the sum of P ∇N V over the integration points, P being
    /// the first Piola–Kirchhoff stress.
    pub fn forces(
        &self,
        displacements: &[Vector3<f64>],
        stress: impl Fn(&Matrix3<f64>) -> Matrix3<f64>,
    ) -> Vec<Vector3<f64>> {
        let mut forces = vec![Vector3::zeros(); self.nodes.len()];
        for (element, nodes) in self.elements.iter().enumerate() {
            for point in self.gauss_points(element, displacements) {
                let p = stress(&point.f);
                for (&node, gradient) in nodes.iter().zip(&point.gradients) {
                    forces[node] += p * gradient * point.volume;
                }
            }
        }
        forces
    }
}

/// All triples below these counts, the last running fastest.
fn product(a: usize, b: usize, c: usize) -> impl Iterator<Item = (usize, usize, usize)> {
    (0..a).flat_map(move |i| (0..b).flat_map(move |j| (0..c).map(move |k| (i, j, k))))
}
