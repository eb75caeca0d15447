//! What is measured of a panel: energies, deflection, the front of the transverse wave, torn yarns, how far sections
//! tilt.

use nalgebra::Vector3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::weave::model::{Grid, Model, Piece, Yarn};
use crate::weave::torn;
use toron_explicit_host::body::Body;
use toron_explicit_host::hexahedron::Edges;
use toron_explicit_host::lanes::{Number, largest, smallest};
use toron_explicit_host::solver::Solver;
use toron_explicit_host::struck;
use toron_explicit_host::vector::Vector;

/// What a sample of a panel has besides the quantities of all scenes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OfPanel {
    /// The farthest that a node has gone in the direction of the blow, in yarns that are not torn.
    pub deflection: f64,
    /// Along a yarn through the centre.
    pub front: f64,
    /// The smallest intact element: its volume over that at rest. And the most distorted corner of one, by its scaled
    /// Jacobian.
    pub least_volume_ratio: f64,
    pub least_scaled_jacobian: f64,
    /// Yarns that are torn through.
    pub torn: usize,
    /// By how much, at most, a section whose elements are all there has tilted along its yarn since it was at rest, in
    /// degrees; and how far its middle has slipped along it against its upper and lower side. 0 where no yarn has a
    /// grid.
    pub tilt: f64,
    pub slip: f64,
}

pub type Sample = struck::sample::Sample<OfPanel>;

/// At rest.
impl Default for OfPanel {
    fn default() -> OfPanel {
        let (least_volume_ratio, least_scaled_jacobian) = (1.0, 1.0);
        OfPanel {
            deflection: 0.0,
            front: 0.0,
            least_volume_ratio,
            least_scaled_jacobian,
            torn: 0,
            tilt: 0.0,
            slip: 0.0,
        }
    }
}

impl OfPanel {
    /// Measures all.
    ///
    /// The front of the transverse wave is where the panel has come down by `threshold`, more than crimp gives when
    /// yarns are stretched straight before it comes.
    pub fn of<T: Number>(panel: &Model, at_rest: &[AtRest], solver: &Solver<T>, threshold: f64) -> OfPanel {
        let yarns = panel.yarns.par_iter().zip(at_rest).zip(&solver.bodies);
        let yarns: Vec<OfPanel> = yarns.map(|((yarn, at_rest), body)| OfPanel::of_yarn(yarn, at_rest, body)).collect();
        OfPanel { front: front(panel, solver, threshold), ..yarns.iter().fold(OfPanel::default(), OfPanel::with) }
    }

    /// A yarn's part of what is summed, and its largest and smallest values.
    fn of_yarn<T: Number>(yarn: &Yarn, at_rest: &AtRest, body: &Body<T>) -> OfPanel {
        let (elements, intact) = (&body.mesh.elements, body.intact());
        let nodes: Vec<Vector> = (0..body.mesh.nodes.len()).map(|node| body.position(node)).collect();
        let torn = torn::is_torn(yarn, elements, |i| intact[i]);
        let mut sample = OfPanel { torn: usize::from(torn), ..OfPanel::default() };
        for node in (0..nodes.len()).filter(|&node| !torn && !body.is_loose(node)) {
            sample.deflection = largest(sample.deflection, -body.state.displacement[node][2].into());
        }
        for i in (0..elements.len()).filter(|&i| intact[i]) {
            let now = edges(&elements[i], 0, &nodes);
            sample.least_volume_ratio = smallest(sample.least_volume_ratio, now.volume() / at_rest.volumes[i]);
            sample.least_scaled_jacobian = now.least_scaled_jacobian(&elements[i], sample.least_scaled_jacobian);
        }
        for (piece, at_rest) in yarn.pieces.iter().zip(&at_rest.pieces) {
            sample.measure_sections(piece, at_rest, &sections(yarn, piece, &nodes), &intact);
        }
        sample
    }

    /// Of the sections whose elements are all there.
    fn measure_sections(&mut self, piece: &Piece, at_rest: &[Section], now: &[Section], intact: &[bool]) {
        let Piece { grid, first_element, .. } = piece;
        let whole_at = |layer: usize| grid.layer(layer).all(|element| intact[first_element + element]);
        for (section, (at_rest, now)) in at_rest.iter().zip(now).enumerate() {
            if (section.saturating_sub(1)..(section + 1).min(grid.layers)).all(whole_at) {
                self.tilt = largest(self.tilt, (now.tilt - at_rest.tilt).abs());
                self.slip = largest(self.slip, (now.slip - at_rest.slip).abs());
            }
        }
    }

    /// With what another yarn has.
    fn with(self, other: &OfPanel) -> OfPanel {
        OfPanel {
            deflection: largest(self.deflection, other.deflection),
            front: largest(self.front, other.front),
            least_volume_ratio: smallest(self.least_volume_ratio, other.least_volume_ratio),
            least_scaled_jacobian: smallest(self.least_scaled_jacobian, other.least_scaled_jacobian),
            torn: self.torn + other.torn,
            tilt: largest(self.tilt, other.tilt),
            slip: largest(self.slip, other.slip),
        }
    }
}

/// The farthest place from the centre, along the yarns next to its axes, that has come down by more than a threshold.
fn front<T: Number>(panel: &Model, solver: &Solver<T>, threshold: f64) -> f64 {
    let mut farthest: f64 = 0.0;
    for body in panel.central().map(|(number, _)| &solver.bodies[number]) {
        for (node, [x, y, _]) in body.mesh.nodes.iter().enumerate() {
            if -body.state.displacement[node][2].into() > threshold {
                farthest = farthest.max(x.hypot(*y));
            }
        }
    }
    farthest
}

/// What of a yarn at rest it is measured against.
#[derive(Debug)]
pub struct AtRest {
    /// Of its elements.
    volumes: Vec<f64>,
    pieces: Vec<Vec<Section>>,
}

impl AtRest {
    /// Of each yarn.
    pub fn of(panel: &Model) -> Vec<AtRest> {
        let of_yarn = |yarn: &Yarn| {
            let (nodes, elements) = (&panel.nodes[yarn.nodes.clone()], &panel.elements[yarn.elements.clone()]);
            AtRest {
                volumes: elements.iter().map(|element| edges(element, yarn.nodes.start, nodes).volume()).collect(),
                pieces: yarn.pieces.iter().map(|piece| sections(yarn, piece, nodes)).collect(),
            }
        };
        panel.yarns.par_iter().map(of_yarn).collect()
    }
}

/// The edges of an element whose numbers of nodes begin at `first`.
fn edges(element: &[u32; 8], first: usize, nodes: &[Vector]) -> Edges {
    let mut corners = [[0.0; 3]; 8];
    for corner in 0..8 {
        corners[corner] = nodes[element[corner] as usize - first];
    }
    Edges::of(&corners)
}

/// The angle by which a section's height leans along the yarn, in degrees, and how far its middle is ahead of its upper
/// and lower side along the yarn.
#[derive(Debug)]
struct Section {
    tilt: f64,
    slip: f64,
}

/// The sections of a piece, the yarn's nodes in these places.
fn sections(yarn: &Yarn, Piece { grid, first_node, .. }: &Piece, nodes: &[Vector]) -> Vec<Section> {
    let Grid { rows, columns, layers } = *grid;
    let nodes = &nodes[*first_node..];
    let mean = |section: usize| {
        let nodes = &nodes[grid.section(section)];
        nodes.iter().map(|&node| Vector3::from(node)).sum::<Vector3<f64>>() / nodes.len() as f64
    };
    let means: Vec<Vector3<f64>> = (0..=layers).map(mean).collect();
    let of = |section: usize| {
        let along = (means[(section + 1).min(layers)] - means[section.saturating_sub(1)]).normalize();
        let first = grid.section(section).start;
        let node = |column: usize, row: usize| Vector3::from(nodes[first + column * (rows + 1) + row]);
        let height = |column: usize| node(column, rows) - node(column, 0);
        // The axis of a yarn that a plane of symmetry halves is at the side where it is highest.
        let axis = if yarn.halved { [0, columns] } else { [columns / 2, columns.div_ceil(2)] };
        let column = if height(axis[0]).norm() > height(axis[1]).norm() { axis[0] } else { axis[1] };
        let upright = height(column);
        let tilt = (along.dot(&upright) / upright.norm()).clamp(-1.0, 1.0).asin().to_degrees();
        let core = 0.5 * (node(column, rows / 2) + node(column, rows.div_ceil(2)));
        let sides = 0.5 * (node(column, rows) + node(column, 0));
        Section { tilt, slip: along.dot(&(core - sides)) }
    };
    (0..=layers).map(of).collect()
}
