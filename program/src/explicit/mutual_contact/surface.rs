//! The surface of a body: faces, their neighbours, and where their nodes are.

use std::collections::HashMap;

use crate::explicit::archive::Archive;
use crate::explicit::body::Body;
use crate::explicit::lanes::Number;
use crate::explicit::mesh::Mesh;
use crate::explicit::vector::{dot, minus};

/// No face.
pub const NONE: u32 = u32::MAX;

/// The faces of a body that may touch others.
#[derive(Clone, Debug, Default)]
pub struct Surface {
    /// Counter-clockwise as seen from outside.
    pub faces: Vec<[u32; 4]>,
    /// The element of each.
    pub elements: Vec<u32>,
    /// Beyond the edges from each corner to the next, or `NONE`.
    pub neighbours: Vec<[u32; 4]>,
    /// Whether its element has been deleted.
    pub gone: Vec<bool>,
    /// Whether it is a rigid wall's: nothing rubs on it, and the nodes of others press against it alone, not its own against others.
    pub wall: bool,
    /// The nodes of the faces in their order.
    pub nodes: Vec<u32>,
    /// Of all nodes of the body: their share of the faces, as the size of a sum of vectors, so that on an edge what faces another
    /// body counts once; where they are, and how they have moved in the last step.
    pub area: Vec<f64>,
    pub positions: Vec<[f64; 3]>,
    pub moved: Vec<[f64; 3]>,
}

impl Surface {
    /// These faces of a body's elements.
    pub fn new(mesh: &Mesh, faces: Vec<[u32; 4]>, elements: Vec<u32>) -> Surface {
        let mut beside: HashMap<[u32; 2], (u32, usize)> = HashMap::new();
        let mut neighbours = vec![[NONE; 4]; faces.len()];
        let mut area = vec![nalgebra::Vector3::zeros(); mesh.nodes.len()];
        for (number, face) in faces.iter().enumerate() {
            for edge in 0..4 {
                let (a, b) = (face[edge], face[(edge + 1) % 4]);
                if let Some((other, at)) = beside.insert([a.min(b), a.max(b)], (number as u32, edge)) {
                    neighbours[number][edge] = other;
                    neighbours[other as usize][at] = number as u32;
                }
            }
            let corners = face.map(|corner| nalgebra::Vector3::from(mesh.nodes[corner as usize]));
            let share = 0.125 * (corners[2] - corners[0]).cross(&(corners[3] - corners[1]));
            for &corner in face {
                area[corner as usize] += share;
            }
        }
        let mut nodes: Vec<u32> = faces.iter().flatten().copied().collect();
        nodes.sort_unstable();
        nodes.dedup();
        Surface {
            gone: vec![false; faces.len()],
            wall: false,
            positions: mesh.nodes.clone(),
            moved: vec![[0.0; 3]; mesh.nodes.len()],
            faces,
            elements,
            neighbours,
            nodes,
            area: area.iter().map(nalgebra::Vector3::norm).collect(),
        }
    }

    /// # Errors
    /// The archive's.
    pub fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), postcard::Error> {
        archive.keep_all(&mut self.gone)?;
        archive.keep(&mut self.nodes)?;
        archive.keep_all(&mut self.positions)?;
        archive.keep_all(&mut self.moved)
    }

    /// Takes the nodes' places over; returns how far the one has moved that has moved farthest.
    pub fn follow<T: Number>(&mut self, body: &Body<T>) -> f64 {
        let mut farthest: f64 = 0.0;
        for &node in &self.nodes {
            let node = node as usize;
            let now = body.position(node);
            let moved = minus(now, self.positions[node]);
            (self.positions[node], self.moved[node]) = (now, moved);
            farthest = farthest.max(dot(moved, moved));
        }
        farthest.sqrt()
    }

    /// Takes out the faces of deleted elements and the nodes without any.
    pub fn remove<T: Number>(&mut self, body: &Body<T>) {
        for (gone, &element) in self.gone.iter_mut().zip(&self.elements) {
            *gone = !body.is_intact(element as usize);
        }
        self.nodes.retain(|&node| !body.is_loose(node as usize));
    }
}

/// The faces that one element alone has, counter-clockwise as seen from outside, with their elements.
pub fn outer_faces(elements: &[[u32; 8]]) -> Vec<([u32; 4], u32)> {
    /// Of a hexahedron whose corner c stands on the upper side of axis i where bit i of c is set.
    const FACES: [[usize; 4]; 6] = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let mut count: HashMap<[u32; 4], u32> = HashMap::new();
    let key = |mut face: [u32; 4]| {
        face.sort_unstable();
        face
    };
    let faces = |element: &[u32; 8]| FACES.map(|face| face.map(|corner| element[corner]));
    for face in elements.iter().flat_map(faces) {
        *count.entry(key(face)).or_default() += 1;
    }
    let outer =
        elements.iter().enumerate().flat_map(|(number, element)| faces(element).map(|face| (face, number as u32)));
    outer.filter(|(face, _)| count[&key(*face)] == 1).collect()
}
