//! A meshed panel: plain data for a host and for decks.

use std::ops::Range;

use super::geometry::Family;
use toron_explicit_host::tie::Tie;

/// Faces of an element, by the corners that stand counterclockwise seen from outside.
pub const UPPER: [usize; 4] = [2, 6, 7, 3];
pub const LOWER: [usize; 4] = [0, 1, 5, 4];
pub const LEFT: [usize; 4] = [0, 2, 3, 1];
pub const RIGHT: [usize; 4] = [4, 5, 7, 6];
pub const START: [usize; 4] = [0, 4, 6, 2];
pub const END: [usize; 4] = [1, 3, 7, 5];

/// Which way a face looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    Upper,
    Lower,
    /// Against the axis across the yarn, or along it.
    Left,
    Right,
}

/// A quadrangle of the surface that can touch another yarn: no cut end, and no plane of symmetry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Face {
    /// Counterclockwise, seen from outside.
    pub nodes: [u32; 4],
    pub element: u32,
    pub side: Side,
}

/// A yarn and its parts of the model's lists.
#[derive(Clone, Debug, PartialEq)]
pub struct Yarn {
    /// From the struck side.
    pub ply: usize,
    pub family: Family,
    /// Its number in the pattern, 0 at the origin or next to it, and its place: y of a warp yarn, x of a weft yarn,
    /// before the ply is turned.
    pub number: i64,
    pub coordinate: f64,
    /// Cut along its axis by a plane of symmetry: half of the columns are there.
    pub halved: bool,
    pub nodes: Range<usize>,
    pub elements: Range<usize>,
    pub faces: Range<usize>,
    /// The nodes of the sections where it begins and ends, where that is at the panel's edge or on a plane of symmetry.
    pub ends: [Vec<u32>; 2],
    /// How its elements stand, one piece after another; none where they do so in no order, as in the meshes of others.
    pub pieces: Vec<Piece>,
    /// Nodes where a fine piece meets a coarse one, numbered in the yarn.
    pub ties: Vec<Tie>,
}

impl Yarn {
    /// Whether a part of it is meshed coarser than the rest.
    pub fn is_coarse_in_part(&self) -> bool {
        self.pieces.len() > 1
    }
}

/// A part of a yarn whose elements stand in a grid, and the yarn's numbers of its first node and element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Piece {
    pub grid: Grid,
    pub first_node: usize,
    pub first_element: usize,
    /// Its length in layers of a fine mesh.
    pub steps: usize,
}

impl Piece {
    /// A grid that is the whole yarn.
    pub fn whole(grid: Grid) -> Piece {
        Piece { grid, first_node: 0, first_element: 0, steps: grid.layers }
    }
}

/// A yarn's elements by layers along it, columns across and rows upwards, and its nodes by sections.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    pub layers: usize,
    pub columns: usize,
    pub rows: usize,
}

impl Grid {
    pub fn nodes_per_section(&self) -> usize {
        (self.columns + 1) * (self.rows + 1)
    }

    pub fn elements_per_layer(&self) -> usize {
        self.columns * self.rows
    }

    /// The yarn's nodes of a section, from 0 to the number of layers: column by column, each from below.
    pub fn section(&self, number: usize) -> Range<usize> {
        number * self.nodes_per_section()..(number + 1) * self.nodes_per_section()
    }

    /// The yarn's elements of a layer: column by column, each from below.
    pub fn layer(&self, number: usize) -> Range<usize> {
        number * self.elements_per_layer()..(number + 1) * self.elements_per_layer()
    }

    /// The yarn's nodes at the corners of an element of the layer, column and row.
    pub fn corners(&self, [layer, column, row]: [usize; 3]) -> [usize; 8] {
        std::array::from_fn(|corner| {
            let [along, up, across] = [0, 1, 2].map(|axis| corner >> axis & 1);
            self.section(layer + along).start + (column + across) * (self.rows + 1) + row + up
        })
    }
}

/// Where a warp and a weft yarn cross, by their places in the list of yarns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    pub warp: usize,
    pub weft: usize,
    pub place: [f64; 2],
    pub warp_is_over: bool,
}

/// A meshed panel. Lengths are in the units of the weave; the nodes and the elements of a yarn stand one after another.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Model {
    pub nodes: Vec<[f64; 3]>,
    /// Corner c of an element stands on the upper side of its axis i where bit i of c is set: axis 0 along the yarn (x
    /// of the warp, y of the weft), 1 upwards, 2 across (-y of the warp, x of the weft). Yarn by yarn; those of a grid
    /// layer by layer. Of a wedge two corners that axis 0 does not join are the same node, and so are those across from
    /// them.
    pub elements: Vec<[u32; 8]>,
    /// The unit direction of each element's fibres: that of the centre line, as it is meshed, at the element's middle.
    pub fibre: Vec<[f64; 3]>,
    /// Ply by ply, the warp first, by their coordinates.
    pub yarns: Vec<Yarn>,
    pub faces: Vec<Face>,
    /// Nodes of the sections where yarns end at the panel's edge.
    pub rim: Vec<u32>,
    /// Nodes on the planes of symmetry x = 0 and y = 0; none in a whole panel.
    pub on_x: Vec<u32>,
    pub on_y: Vec<u32>,
    pub crossings: Vec<Crossing>,
}

impl Model {
    /// The places of an element's corners.
    pub fn corners(&self, element: &[u32; 8]) -> [[f64; 3]; 8] {
        element.map(|node| self.nodes[node as usize])
    }

    /// The least and the largest coordinate of a yarn's nodes.
    pub fn extent(&self, yarn: &Yarn, axis: usize) -> [f64; 2] {
        let places = self.nodes[yarn.nodes.clone()].iter().map(|node| node[axis]);
        places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
    }

    /// The yarns nearest to the centre of each ply.
    pub fn central(&self) -> impl Iterator<Item = (usize, &Yarn)> {
        let nearest = |ply: usize| {
            let of_ply = self.yarns.iter().filter(|yarn| yarn.ply == ply);
            of_ply.map(|yarn| yarn.coordinate.abs()).fold(f64::INFINITY, f64::min)
        };
        let nearest: Vec<f64> = (0..self.plies()).map(nearest).collect();
        self.yarns.iter().enumerate().filter(move |(_, yarn)| yarn.coordinate.abs() <= 1.001 * nearest[yarn.ply])
    }

    pub fn plies(&self) -> usize {
        self.yarns.last().map_or(0, |yarn| yarn.ply + 1)
    }
}
