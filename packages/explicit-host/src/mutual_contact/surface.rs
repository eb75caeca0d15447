//! The surface of a body: faces, their neighbours, and where their nodes are.

use std::collections::HashMap;

use serde::{Deserialize, Serialize};

use super::bounds::Bounds;
use crate::body::Body;
use crate::lanes::Number;
use crate::mesh::Mesh;
use crate::tie::Tie;
use crate::vector::{Vector, minus};

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
    /// Whether it is a rigid wall's: nothing rubs on it, and the nodes of others press against it alone, not its own
    /// against others.
    pub wall: bool,
    /// Of all nodes of the body, inner ones included, which have no share: their share of the faces, as the size of a
    /// sum of vectors, so that on an edge what faces another body counts once.
    pub area: Vec<f64>,
    pub state: SurfaceState,
    /// How many slabs the body is cut into whose motion is followed, in which of them nodes and faces are, and how
    /// the nodes of each have moved in the last step.
    pub slabs: usize,
    slab_of_node: Vec<u16>,
    slab_of_face: Vec<u16>,
    pub moved_by_slab: Vec<Bounds>,
}

/// What a surface remembers from step to step.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct SurfaceState {
    /// Whether the element of each face has been deleted.
    pub gone: Vec<bool>,
    /// The nodes of the faces in their order.
    pub nodes: Vec<u32>,
    /// Of all nodes of the body.
    pub points: Vec<Point>,
}

/// What contact asks of a node, together in the processor's memory.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
#[repr(align(64))]
pub struct Point {
    pub position: Vector,
    /// How it has moved in the last step.
    pub moved: Vector,
    /// As the body has it now.
    #[serde(skip)]
    pub mass: f64,
}

/// Has the processor fetch what lies around a value: a loop that does nothing else waits for many at once, where each
/// use would wait for its own.
#[inline(always)]
pub fn fetch(value: f64) {
    std::hint::black_box(value);
}

/// A slab is as wide as this many of the longest faces; no body has more slabs than this.
const FACES_IN_SLAB: f64 = 2.0;
const MOST_SLABS: f64 = 1024.0;

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
        let (slabs, slab_of_node) = cut(&mesh.nodes, &nodes, &faces);
        Surface {
            wall: false,
            state: SurfaceState {
                gone: vec![false; faces.len()],
                nodes,
                points: mesh.nodes.iter().map(|&position| Point { position, ..Point::default() }).collect(),
            },
            slabs,
            slab_of_face: faces.iter().map(|face| slab_of_node[face[0] as usize]).collect(),
            slab_of_node,
            moved_by_slab: vec![Bounds::EMPTY; slabs],
            faces,
            elements,
            neighbours,
            area: area.iter().map(nalgebra::Vector3::norm).collect(),
        }
    }

    /// Makes faces neighbours whose edges are one edge of a coarser face, or lie on it, by tied nodes.
    pub fn join(&mut self, ties: &[Tie]) {
        let tied: HashMap<u32, &Tie> = ties.iter().map(|tie| (tie.node, tie)).collect();
        let mut coarse: HashMap<[u32; 2], (u32, usize)> = HashMap::new();
        let mut fine = Vec::new();
        for (number, face) in self.faces.iter().enumerate() {
            for edge in (0..4).filter(|&edge| self.neighbours[number][edge] == NONE) {
                let (a, b) = (face[edge], face[(edge + 1) % 4]);
                match [a, b].map(|node| tied.get(&node)) {
                    [Some(a), Some(b)] => {
                        let mut ends: Vec<u32> = a.rests_on().chain(b.rests_on()).collect();
                        ends.sort_unstable();
                        ends.dedup();
                        fine.push((number, edge, ends));
                    }
                    _ => {
                        coarse.insert([a.min(b), a.max(b)], (number as u32, edge));
                    }
                }
            }
        }
        for (number, edge, ends) in fine {
            let beside = <[u32; 2]>::try_from(ends).ok().and_then(|ends| coarse.get(&ends));
            if let Some(&(other, at)) = beside {
                self.neighbours[number][edge] = other;
                self.neighbours[other as usize][at] = number as u32;
            }
        }
    }

    /// Takes the nodes' places over.
    pub fn follow<T: Number>(&mut self, body: &Body<T>) {
        let Surface { state: SurfaceState { nodes, points, .. }, slab_of_node, moved_by_slab, .. } = self;
        moved_by_slab.fill(Bounds::EMPTY);
        // Nodes that follow one another mostly lie in one slab: its bounds are written once.
        let (mut slab, mut bounds) = (0, Bounds::EMPTY);
        for &node in &*nodes {
            let node = node as usize;
            let now = body.position(node);
            let moved = minus(now, points[node].position);
            points[node] = Point { position: now, moved, mass: body.mass[node] };
            let of_node = usize::from(slab_of_node[node]);
            if of_node != slab {
                moved_by_slab[slab] = moved_by_slab[slab].with(bounds);
                (slab, bounds) = (of_node, Bounds::EMPTY);
            }
            bounds.take(moved);
        }
        moved_by_slab[slab] = moved_by_slab[slab].with(bounds);
    }

    /// Where the nodes of each slab and the corners of its faces are.
    pub fn places_by_slab(&self) -> Vec<Bounds> {
        let mut places = vec![Bounds::EMPTY; self.slabs];
        for &node in &self.state.nodes {
            places[self.slab_of_node[node as usize] as usize].take(self.state.points[node as usize].position);
        }
        for face in (0..self.faces.len()).filter(|&face| !self.state.gone[face]) {
            for corner in self.faces[face] {
                places[self.slab_of_face[face] as usize].take(self.state.points[corner as usize].position);
            }
        }
        places
    }

    /// The slabs of a node and of a face.
    #[inline(always)]
    pub fn slab_of_node(&self, node: u32) -> u16 {
        self.slab_of_node[node as usize]
    }

    #[inline(always)]
    pub fn slab_of_face(&self, face: u32) -> u16 {
        self.slab_of_face[face as usize]
    }

    /// Takes out the faces of deleted elements and the nodes without any.
    pub fn remove<T: Number>(&mut self, body: &Body<T>) {
        for (gone, &element) in self.state.gone.iter_mut().zip(&self.elements) {
            *gone = !body.is_intact(element as usize);
        }
        self.state.nodes.retain(|&node| !body.is_loose(node as usize));
    }
}

/// Cuts a body into slabs along the axis in which its surface is largest: their number, and that of each node.
fn cut(places: &[[f64; 3]], nodes: &[u32], faces: &[[u32; 4]]) -> (usize, Vec<u16>) {
    let extent = |corners: &[u32], axis: usize| {
        let along = corners.iter().map(|&node| places[node as usize][axis]);
        let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        [low, (high - low).max(0.0)]
    };
    let sizes = [0, 1, 2].map(|axis| extent(nodes, axis)[1]);
    let axis = (0..3).max_by(|&i, &j| sizes[i].total_cmp(&sizes[j])).unwrap_or(0);
    let longest = faces.iter().map(|face| extent(face, axis)[1]).fold(0.0, f64::max);
    let width = (FACES_IN_SLAB * longest).max(sizes[axis] / MOST_SLABS);
    let last = if width > 0.0 { (sizes[axis] / width) as usize } else { 0 };
    let low = extent(nodes, axis)[0];
    let slab = |place: &[f64; 3]| if last > 0 { (((place[axis] - low) / width) as usize).min(last) as u16 } else { 0 };
    (last + 1, places.iter().map(slab).collect())
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
