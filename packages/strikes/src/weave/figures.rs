//! What a meshed ply is in figures.

use nalgebra::Vector3;

use super::geometry::{Family, Geometry};
use super::model::{Model, Yarn};
use toron_explicit_host::hexahedron::{Edges, solid_corners};

/// Lengths are in the units of the weave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    /// Yarns of warp and weft.
    pub yarns: [usize; 2],
    pub nodes: usize,
    pub elements: usize,
    /// Of warp and weft: the length of the meshed centre line over that of the panel it crosses, less 1.
    pub crimp: [f64; 2],
    /// From the lowest to the highest node.
    pub thickness: f64,
    /// Volume of the yarns of warp and weft over the panel's area: times their density, the areal density.
    pub volumes_by_area: [f64; 2],
    /// The least at a corner of an element, and the least divided by the lengths of the three edges there.
    pub least_jacobian: f64,
    pub least_scaled_jacobian: f64,
    pub shortest_edge: f64,
}

impl Figures {
    /// Those of a ply, from 0; the geometry is its own.
    pub fn of(model: &Model, ply: usize, geometry: &Geometry) -> Figures {
        let covered = |family: Family| {
            let width = |yarn: &Yarn| if yarn.halved { 0.5 } else { 1.0 };
            let yarns = model.yarns.iter().filter(|yarn| yarn.ply == ply && yarn.family == family);
            let steps = |yarn: &Yarn| yarn.pieces.iter().map(|piece| piece.steps as f64).sum::<f64>();
            let steps: f64 = yarns.map(|yarn| width(yarn) * steps(yarn)).sum();
            steps * geometry.weave.step(family) * geometry.weave.thread(family).pitch
        };
        let crimp = Family::BOTH.map(|family| geometry.crimp(family));
        Figures::with(model, ply, crimp, Family::BOTH.map(covered))
    }

    /// With the crimp of warp and weft, and the area that the yarns of each cover, each its pitch wide.
    pub fn with(model: &Model, ply: usize, crimp: [f64; 2], covered: [f64; 2]) -> Figures {
        let yarns = || model.yarns.iter().filter(move |yarn| yarn.ply == ply);
        let heights = || yarns().flat_map(|yarn| &model.nodes[yarn.nodes.clone()]).map(|node| node[2]);
        let count = |family: Family| yarns().filter(|yarn| yarn.family == family).count();
        let mut figures = Figures {
            yarns: Family::BOTH.map(count),
            nodes: yarns().map(|yarn| yarn.nodes.len()).sum(),
            elements: yarns().map(|yarn| yarn.elements.len()).sum(),
            crimp,
            thickness: heights().fold(f64::NEG_INFINITY, f64::max) - heights().fold(f64::INFINITY, f64::min),
            volumes_by_area: Family::BOTH.map(|family| volume(model, ply, family) / covered[family as usize]),
            least_jacobian: f64::INFINITY,
            least_scaled_jacobian: f64::INFINITY,
            shortest_edge: f64::INFINITY,
        };
        for element in yarns().flat_map(|yarn| &model.elements[yarn.elements.clone()]) {
            let edges = Edges::of(&model.corners(element));
            let jacobians = edges.jacobians().into_iter().zip(solid_corners(element)).filter(|(_, solid)| *solid);
            figures.least_jacobian = jacobians.fold(figures.least_jacobian, |least, (jacobian, _)| least.min(jacobian));
            figures.least_scaled_jacobian =
                figures.least_scaled_jacobian.min(edges.least_scaled_jacobian(element, 1.0));
            let lengths = edges.lengths().into_iter().flatten().filter(|length| *length > 0.0);
            figures.shortest_edge = lengths.fold(figures.shortest_edge, f64::min);
        }
        figures
    }

    /// The mean section of a yarn of warp and of weft, which lie this far apart.
    pub fn sections(&self, pitches: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|family| self.volumes_by_area[family] * pitches[family] / (1.0 + self.crimp[family]))
    }

    pub fn volume_by_area(&self) -> f64 {
        self.volumes_by_area.iter().sum()
    }
}

/// The volume of a ply's family.
fn volume(model: &Model, ply: usize, family: Family) -> f64 {
    let yarns = model.yarns.iter().filter(|yarn| yarn.ply == ply && yarn.family == family);
    let derivatives = derivatives();
    yarns
        .flat_map(|yarn| model.elements[yarn.elements.clone()].iter())
        .map(|element| of_element(model, element, &derivatives))
        .sum()
}

/// Derivatives of the corners' weights along the three axes, at the eight points of Gauss.
type Derivatives = [[[f64; 8]; 3]; 8];

fn derivatives() -> Derivatives {
    let offset = 0.5 / 3_f64.sqrt();
    let upper = |number: usize, axis: usize| number >> axis & 1 == 1;
    let factor = |point: usize, corner: usize, axis: usize| {
        let near = upper(point, axis) == upper(corner, axis);
        if near { 0.5 + offset } else { 0.5 - offset }
    };
    let weight = |point: usize, along: usize, corner: usize| {
        let others = [(along + 1) % 3, (along + 2) % 3].map(|axis| factor(point, corner, axis));
        others[0] * others[1] * if upper(corner, along) { 1.0 } else { -1.0 }
    };
    std::array::from_fn(|point| std::array::from_fn(|along| std::array::from_fn(|corner| weight(point, along, corner))))
}

/// The volume of a trilinear element.
fn of_element(model: &Model, element: &[u32; 8], derivatives: &Derivatives) -> f64 {
    let nodes = element.map(|node| Vector3::from(model.nodes[node as usize]));
    let at_point = |weights: &[[f64; 8]; 3]| {
        let [a, b, c] = weights.each_ref().map(|weights| {
            weights.iter().zip(&nodes).fold(Vector3::zeros(), |sum, (&weight, node)| sum + node * weight)
        });
        a.cross(&b).dot(&c)
    };
    derivatives.iter().map(at_point).sum::<f64>() / 8.0
}
