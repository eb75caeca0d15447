//! What of a panel's elements can be seen: sides behind which no other element of the yarn stands.

use nalgebra::Vector3;

use super::model::Model;
use toron_explicit_host::mutual_contact::outer_faces;

/// A side of an element that can be seen, where the nodes are now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Visible {
    pub element: usize,
    pub corners: [[f64; 3]; 4],
    /// Outwards, of length 1.
    pub normal: Vector3<f64>,
}

/// The sides of the intact elements that are seen with the nodes at these positions; with them the yarns' ends, which
/// stand upright at rest.
pub fn visible(model: &Model, positions: &[[f64; 3]], intact: impl Fn(usize) -> bool) -> Vec<Visible> {
    let shown: Vec<usize> = (0..model.elements.len()).filter(|&number| intact(number)).collect();
    let elements: Vec<[u32; 8]> = shown.iter().map(|&number| model.elements[number]).collect();
    let faces = outer_faces(&elements).into_iter();
    // Of a wedge one side is a line.
    let faces = faces.filter(|([a, b, c, d], _)| !(a == b && c == d || b == c && a == d));
    let side = |(face, place): ([u32; 4], u32)| {
        let corners = face.map(|node| positions[node as usize]);
        Visible { element: shown[place as usize], corners, normal: normal(&corners) }
    };
    faces.map(side).collect()
}

fn normal(corners: &[[f64; 3]; 4]) -> Vector3<f64> {
    let [a, b, c, d] = corners.map(Vector3::from);
    (c - a).cross(&(d - b)).normalize()
}
