//! What is looked at in a foreign mesh before it is struck: figures, and what no run can come of.

use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;

use super::bins::{Bins, around};
use super::build::LongAxis;
use crate::weave::cut;
use crate::weave::distance::{self, Quad};
use crate::weave::geometry::Family;
use crate::weave::model::{END, Model, START, Yarn};
use toron_explicit_host::hexahedron::{Edges, solid_corners};
use toron_shared::numbers::number;

/// Stations along a yarn at which its height is measured; the middle one of the heights counts.
const STATIONS: usize = 9;
/// The points of an element that are looked for in other yarns are the middles of its thirds along each axis.
const THIRDS: [f64; 3] = [-2.0 / 3.0, 0.0, 2.0 / 3.0];
/// A node is in an element where it is farther than this part of it from its faces.
const ON_FACE: f64 = 1e-6;
/// More of the yarns' volume may not be in two of them.
const MOST_SHARED: f64 = 0.02;
/// Fibres may be farther off the line through their element, and those of a yarn off its length, by these angles in
/// degrees.
const OFF_ELEMENT: f64 = 25.0;
const OFF_YARN: f64 = 45.0;

/// The figures of a mesh. Lengths are in the scene's units, angles in degrees.
#[derive(Clone, Debug, PartialEq)]
pub struct Checks {
    /// The part of the yarns' volume that is in another yarn too, by 27 points an element, nodes that are, and the
    /// elements that have such points or nodes.
    pub shared: f64,
    pub sunk_nodes: usize,
    pub overlapping: Vec<usize>,
    /// The least distance between yarns; 0 where they meet.
    pub clearance: f64,
    /// Of warp and weft, across the fibre.
    pub heights: [f64; 2],
    /// Wedges among the elements, and elements with a corner that is inside out.
    pub wedges: usize,
    pub inside_out: usize,
    /// How far at most a fibre is off the line from an element's start to its end, and the fibres of a yarn off its
    /// length, with its family and number.
    pub off_element: f64,
    pub off_yarn: (f64, Family, i64),
}

impl Checks {
    pub fn of(model: &Model) -> Checks {
        let heights = Family::BOTH.map(|family| {
            let mut all: Vec<f64> = model
                .yarns
                .iter()
                .filter(|yarn| yarn.family == family)
                .filter_map(|yarn| height(model, yarn))
                .collect();
            middle_of(&mut all).unwrap_or(0.0)
        });
        let elements = || model.elements.iter();
        let overlap = Overlap::of(model);
        let volume = |element: usize| Edges::of(&model.corners(&model.elements[element])).volume();
        let shared: f64 = overlap.elements.iter().map(|&(element, share)| 0.0_f64.max(share * volume(element))).sum();
        let whole: f64 = (0..model.elements.len()).map(volume).sum();
        Checks {
            shared: shared.max(0.0) / whole,
            sunk_nodes: overlap.nodes,
            clearance: if overlap.elements.is_empty() { clearance(model, heights[0].max(heights[1])) } else { 0.0 },
            overlapping: overlap.elements.into_iter().map(|(element, _)| element).collect(),
            heights,
            wedges: elements().filter(|element| solid_corners(element).contains(&false)).count(),
            inside_out: elements().filter(|element| is_inside_out(model, element)).count(),
            off_element: (0..model.elements.len()).map(|element| off_element(model, element)).fold(0.0, f64::max),
            off_yarn: off_yarn(model),
        }
    }

    /// Says what no run can come of.
    ///
    /// # Errors
    /// What is wrong, and what is allowed.
    pub fn refuse(&self) -> Result<(), String> {
        let (angle, family, yarn) = self.off_yarn;
        if angle > OFF_YARN {
            return Err(format!(
                "the fibres of {} {yarn} are {angle:.0}° off its length; allowed: up to {OFF_YARN:.0}°, directions along the yarn",
                family.name()
            ));
        }
        if self.shared > MOST_SHARED {
            return Err(format!(
                "{} % of the yarns' volume is in two yarns; allowed: up to {} %, of which a contact can press them apart",
                number(100.0 * self.shared),
                number(100.0 * MOST_SHARED)
            ));
        }
        Ok(())
    }

    /// What is likely wrong, though a run can begin.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        if !self.overlapping.is_empty() {
            warnings.push(format!(
                "{} nodes are in another yarn, and {} % of the yarns' volume, in {} elements, red in the picture:\n\
                 the contact presses them apart with a force that is there before the strike",
                self.sunk_nodes,
                number(100.0 * self.shared),
                self.overlapping.len()
            ));
        }
        if self.inside_out > 0 {
            warnings.push(format!("{} elements have a corner that is inside out, or flat", self.inside_out));
        }
        if self.off_element > OFF_ELEMENT {
            warnings.push(format!(
                "a fibre is {:.0}° off the line from its element's start to its end, more than {OFF_ELEMENT:.0}°",
                self.off_element
            ));
        }
        warnings
    }

    /// Names and values for the terminal; `length` is the unit.
    pub fn rows(&self, length: &str) -> Vec<(&'static str, String)> {
        let (angle, family, yarn) = self.off_yarn;
        let [warp, weft] = self.heights.map(number);
        vec![
            ("wedges among the elements", self.wedges.to_string()),
            ("heights of warp and weft", format!("{warp} {length}, {weft} {length}")),
            (
                "volume in two yarns",
                format!(
                    "{} %, of {} elements, {} nodes",
                    number(100.0 * self.shared),
                    self.overlapping.len(),
                    self.sunk_nodes
                ),
            ),
            ("elements with a corner inside out", self.inside_out.to_string()),
            ("fibres off their elements", format!("up to {}°", number(self.off_element))),
            ("fibres off their yarn's length", format!("up to {}°, of {} {yarn}", number(angle), family.name())),
        ]
    }
}

fn middle_of(values: &mut [f64]) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

/// The height of a yarn across its fibre, by cuts.
fn height(model: &Model, yarn: &Yarn) -> Option<f64> {
    let axis = yarn.family as usize;
    let [low, high] = model.extent(yarn, axis);
    let at = |station: usize| {
        let plane = low + (high - low) * (station as f64 + 0.5) / STATIONS as f64;
        let mut heights = [f64::INFINITY, f64::NEG_INFINITY];
        let (mut slope, mut count) = (0.0, 0.0);
        for piece in yarn.elements.clone().filter_map(|element| cut::piece(model, element, axis, plane)) {
            for [_, z] in &piece.corners {
                heights = [heights[0].min(*z), heights[1].max(*z)];
            }
            (slope, count) = (slope + model.fibre[piece.element][axis].abs(), count + 1.0);
        }
        (count > 0.0).then(|| (heights[1] - heights[0]) * slope / count)
    };
    middle_of(&mut (0..STATIONS).filter_map(at).collect::<Vec<f64>>())
}

fn is_inside_out(model: &Model, element: &[u32; 8]) -> bool {
    let jacobians = Edges::of(&model.corners(element)).jacobians().into_iter().zip(solid_corners(element));
    jacobians.into_iter().any(|(jacobian, solid)| solid && jacobian <= 0.0)
}

fn angle(a: Vector3<f64>, b: Vector3<f64>) -> f64 {
    (a.dot(&b).abs() / (a.norm() * b.norm())).min(1.0).acos().to_degrees()
}

fn off_element(model: &Model, element: usize) -> f64 {
    let corners = model.corners(&model.elements[element]);
    let [start, end] = [START, END].map(|side| side.iter().map(|&i| Vector3::from(corners[i])).sum::<Vector3<f64>>());
    angle(end - start, Vector3::from(model.fibre[element]))
}

/// The largest angle between the mean of a yarn's fibres and the direction in which it is longest, where its shape
/// tells that.
fn off_yarn(model: &Model) -> (f64, Family, i64) {
    let nodes = |yarn: &Yarn| model.nodes[yarn.nodes.clone()].iter().map(|&node| node.into()).collect::<Vec<_>>();
    let axes = LongAxis::told(model.yarns.iter().map(|yarn| LongAxis::of(&nodes(yarn))).collect());
    let off = |(yarn, axis): (&Yarn, Option<Vector3<f64>>)| {
        let fibres = model.fibre[yarn.elements.clone()].iter().map(|&axis| Vector3::from(axis));
        axis.map(|axis| (angle(fibres.sum(), axis), yarn.family, yarn.number))
    };
    let all = model.yarns.iter().zip(axes).filter_map(off);
    all.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, Family::Warp, 0))
}

/// The number of the yarn of every element.
fn yarn_of_element(model: &Model) -> Vec<u32> {
    let mut yarns = vec![0; model.elements.len()];
    for (number, yarn) in model.yarns.iter().enumerate() {
        yarns[yarn.elements.clone()].fill(number as u32);
    }
    yarns
}

/// Where yarns are in one another.
struct Overlap {
    /// The elements that have points or nodes in another yarn, and the part of their points.
    elements: Vec<(usize, f64)>,
    nodes: usize,
}

impl Overlap {
    fn of(model: &Model) -> Overlap {
        let yarns = yarn_of_element(model);
        let bins = Bins::new(model.elements.iter().map(|element| around(model.corners(element))).collect());
        let inside = |yarn: u32, point: &Vector3<f64>, margin: f64| {
            let bounds = [(*point).into(); 2];
            let mut near = bins.near(&bounds).filter(|&other| yarns[other] != yarn);
            near.any(|other| holds(&model.corners(&model.elements[other]), point, margin))
        };
        let mut sunk = vec![false; model.nodes.len()];
        for (number, yarn) in model.yarns.iter().enumerate() {
            sunk[yarn.nodes.clone()].par_iter_mut().zip(&model.nodes[yarn.nodes.clone()]).for_each(|(sunk, &node)| {
                *sunk = inside(number as u32, &Vector3::from(node), ON_FACE);
            });
        }
        let of_element = |element: usize| {
            let points = points_in(&model.corners(&model.elements[element]));
            let found = points.iter().filter(|point| inside(yarns[element], point, 0.0)).count();
            let with_node = model.elements[element].iter().any(|&node| sunk[node as usize]);
            (found > 0 || with_node).then_some((element, found as f64 / points.len() as f64))
        };
        Overlap {
            elements: (0..model.elements.len()).into_par_iter().filter_map(of_element).collect(),
            nodes: sunk.iter().filter(|sunk| **sunk).count(),
        }
    }
}

/// The middles of an element's 27 parts.
fn points_in(corners: &[[f64; 3]; 8]) -> [Vector3<f64>; 27] {
    std::array::from_fn(|point| {
        let place = [point / 9, point / 3 % 3, point % 3].map(|third| THIRDS[third]);
        let weight = |corner: usize| {
            let near = |axis: usize| if corner >> axis & 1 == 1 { 1.0 + place[axis] } else { 1.0 - place[axis] };
            0.125 * near(0) * near(1) * near(2)
        };
        (0..8).map(|corner| Vector3::from(corners[corner]) * weight(corner)).sum()
    })
}

/// Whether a point is in one of the six tetrahedra about an element's diagonal, by this margin from what is outside the
/// element.
fn holds(corners: &[[f64; 3]; 8], point: &Vector3<f64>, margin: f64) -> bool {
    let from_first = |corner: usize| Vector3::from(corners[corner]) - Vector3::from(corners[0]);
    let (diagonal, point) = (from_first(7), point - Vector3::from(corners[0]));
    [[1, 3], [3, 2], [2, 6], [6, 4], [4, 5], [5, 1]].into_iter().any(|[a, b]| {
        let edges = Matrix3::from_columns(&[from_first(a), from_first(b), diagonal]);
        // One of no volume holds nothing.
        edges.try_inverse().is_some_and(|inverse| {
            let shares = inverse * point;
            // Two of the four faces are the element's: across from its first and its last corner.
            shares.iter().all(|&share| share >= 0.0) && 1.0 - shares.sum() >= margin && shares.z >= margin
        })
    })
}

/// The least distance between faces of different yarns that look at each other, up to a bound.
fn clearance(model: &Model, bound: f64) -> f64 {
    let quads: Vec<Quad> = model.faces.iter().map(|face| face.nodes.map(|node| model.nodes[node as usize])).collect();
    let normals: Vec<Vector3<f64>> = quads.iter().map(normal).collect();
    let bins = Bins::new(quads.iter().map(|quad| around(*quad)).collect());
    let of_yarn = |yarn: &Yarn| {
        let (mut least, mut near) = (bound, Vec::new());
        for face in yarn.faces.clone() {
            let [low, high] = around(quads[face]);
            let reach = [low.map(|x| x - least), high.map(|x| x + least)];
            near.clear();
            // Each pair of yarns once.
            near.extend(bins.near(&reach).filter(|&other| other >= yarn.faces.end));
            near.sort_unstable();
            near.dedup();
            for &other in near.iter().filter(|&&other| normals[face].dot(&normals[other]) < 0.0) {
                least = distance::quads(&quads[face], &quads[other], least);
            }
        }
        least
    };
    model.yarns.par_iter().map(of_yarn).reduce(|| bound, f64::min)
}

fn normal(quad: &Quad) -> Vector3<f64> {
    let [a, b, c, d] = quad.map(Vector3::from);
    (c - a).cross(&(d - b))
}
