//! Plies of woven fabric, one below another.

use super::crimp;
use super::model::{Crossing, Face, Model, Yarn};
use super::panel::{Part, Turn};
use super::reader::Woven;

/// A ply, and where it lies.
#[derive(Clone, Debug)]
pub struct Ply {
    pub woven: Woven,
    /// By which it is turned about z, from x to y, in degrees.
    pub angle: f64,
    /// z of the plane between its warp and its weft.
    pub height: f64,
}

/// What is struck: the plies from the struck side, one of them at least. All have one outline.
#[derive(Clone, Debug)]
pub struct Layup {
    pub plies: Vec<Ply>,
    /// The least distance of yarns at rest, in a ply or of two.
    pub clearance: f64,
    /// What to say of plies whose yarns the mesh makes too long or too short: known from here on, since it takes nine
    /// weaves that are solved, and cases and shots share what they strike.
    pub crimp: Vec<String>,
}

/// A ply on its way into the layup: `distance` is that from the ply above.
pub struct Laid {
    pub woven: Woven,
    pub angle: f64,
    pub distance: f64,
}

impl Ply {
    /// The mesh, where the ply lies.
    pub fn model(&self) -> Model {
        let mut model = self.woven.model();
        model.turn(self.woven.panel.turn);
        if self.height != 0.0 {
            model.nodes.iter_mut().for_each(|node| node[2] += self.height);
        }
        model
    }
}

impl Layup {
    /// Lays each ply below the ones before it, with that distance between their nearest nodes' heights; that of the
    /// first is nothing.
    pub fn new(plies: Vec<Laid>) -> Layup {
        let mut layup = Layup { plies: Vec::with_capacity(plies.len()), clearance: f64::INFINITY, crimp: Vec::new() };
        let several = plies.len() > 1;
        let mut above: Option<f64> = None;
        for Laid { woven, angle, distance } in plies {
            layup.clearance = layup.clearance.min(woven.geometry.weave.clearance);
            let mut height = 0.0;
            if several {
                let [lowest, highest] = woven.model().heights();
                if let Some(above) = above {
                    layup.clearance = layup.clearance.min(distance);
                    height = above - distance - highest;
                }
                above = Some(height + lowest);
            }
            layup.plies.push(Ply { woven, angle, height });
        }
        layup.crimp = layup.crimp_warnings();
        layup
    }

    /// Each once, as each weave is looked at.
    fn crimp_warnings(&self) -> Vec<String> {
        let mut warnings: Vec<String> = Vec::new();
        for (number, ply) in self.plies.iter().enumerate() {
            let geometry = &ply.woven.geometry;
            let known = self.plies[..number].iter().any(|above| above.woven.geometry.weave == geometry.weave);
            let found = if known { None } else { crimp::warning(geometry) };
            warnings.extend(found.filter(|text| !warnings.contains(text)));
        }
        warnings
    }

    /// The mesh of all plies.
    pub fn model(&self) -> Model {
        let mut plies = self.plies.iter().map(Ply::model);
        let mut model = plies.next().unwrap_or_default();
        for (number, ply) in plies.enumerate() {
            model.add_ply(ply, number + 1);
        }
        model
    }

    pub fn part(&self) -> Part {
        self.plies[0].woven.panel.part
    }

    /// The least and the largest height of a yarn.
    pub fn yarn_heights(&self) -> [f64; 2] {
        let heights = || self.plies.iter().flat_map(|ply| ply.woven.geometry.weave.threads).map(|thread| thread.height);
        [heights().fold(f64::INFINITY, f64::min), heights().fold(0.0, f64::max)]
    }
}

impl Model {
    /// From the lowest to the highest node.
    pub fn heights(&self) -> [f64; 2] {
        let heights = || self.nodes.iter().map(|node| node[2]);
        [heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max)]
    }

    fn turn(&mut self, turn: Turn) {
        if turn == Turn::NONE {
            return;
        }
        for [x, y, _] in self.nodes.iter_mut().chain(&mut self.fibre) {
            [*x, *y] = turn.rotate([*x, *y]);
        }
        self.crossings.iter_mut().for_each(|crossing| crossing.place = turn.rotate(crossing.place));
    }

    fn add_ply(&mut self, other: Model, number: usize) {
        let Model { nodes, elements, fibre, yarns, faces, rim, on_x, on_y, crossings } = other;
        let [nodes_before, elements_before, faces_before, yarns_before] =
            [self.nodes.len(), self.elements.len(), self.faces.len(), self.yarns.len()];
        let node = |node: u32| node + nodes_before as u32;
        self.nodes.extend(nodes);
        self.elements.extend(elements.into_iter().map(|element| element.map(node)));
        self.fibre.extend(fibre);
        let moved = |range: std::ops::Range<usize>, before: usize| range.start + before..range.end + before;
        self.yarns.extend(yarns.into_iter().map(|yarn| Yarn {
            ply: number,
            nodes: moved(yarn.nodes, nodes_before),
            elements: moved(yarn.elements, elements_before),
            faces: moved(yarn.faces, faces_before),
            ends: yarn.ends.map(|nodes| nodes.into_iter().map(node).collect()),
            ..yarn
        }));
        self.faces.extend(faces.into_iter().map(|face| Face {
            nodes: face.nodes.map(node),
            element: face.element + elements_before as u32,
            ..face
        }));
        for (own, other) in [(&mut self.rim, rim), (&mut self.on_x, on_x), (&mut self.on_y, on_y)] {
            own.extend(other.into_iter().map(node));
        }
        self.crossings.extend(crossings.into_iter().map(|crossing| Crossing {
            warp: crossing.warp + yarns_before,
            weft: crossing.weft + yarns_before,
            ..crossing
        }));
    }
}
