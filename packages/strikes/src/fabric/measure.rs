//! What is measured of a panel: energies, deflection, the front of the transverse wave, torn yarns, how far sections
//! tilt.

use nalgebra::Vector3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::weave::model::{Grid, Model, Piece, Yarn};
use crate::weave::torn;
use toron_explicit_host::body::Body;
use toron_explicit_host::hexahedron::{Edges, solid_corners};
use toron_explicit_host::lanes::{Number, largest, smallest};
use toron_explicit_host::solver::Solver;
use toron_explicit_host::struck;

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
    pub fn of<T: Number>(panel: &Model, solver: &Solver<T>, threshold: f64) -> OfPanel {
        let yarns: Vec<OfPanel> =
            panel.yarns.par_iter().zip(&solver.bodies).map(|(yarn, body)| OfPanel::of_yarn(yarn, body)).collect();
        OfPanel { front: front(panel, solver, threshold), ..yarns.iter().fold(OfPanel::default(), OfPanel::with) }
    }

    /// A yarn's part of what is summed, and its largest and smallest values.
    fn of_yarn<T: Number>(yarn: &Yarn, body: &Body<T>) -> OfPanel {
        let torn = torn::is_torn(yarn, &body.mesh.elements, |i| body.is_intact(i));
        let mut sample = OfPanel { torn: usize::from(torn), ..OfPanel::default() };
        for i in (0..body.mesh.elements.len()).filter(|&i| body.is_intact(i)) {
            let nodes = body.mesh.elements[i].map(|node| node as usize);
            for node in nodes.into_iter().filter(|_| !torn) {
                sample.deflection = largest(sample.deflection, -body.state.displacement[node][2].into());
            }
            let (mut at_rest, mut now) = ([[0.0; 3]; 8], [[0.0; 3]; 8]);
            for corner in 0..8 {
                at_rest[corner] = body.mesh.nodes[nodes[corner]];
                now[corner] = body.position(nodes[corner]);
            }
            let (at_rest, now) = (Edges::of(&at_rest), Edges::of(&now));
            sample.least_volume_ratio = smallest(sample.least_volume_ratio, now.volume() / at_rest.volume());
            sample.least_scaled_jacobian = smallest(
                sample.least_scaled_jacobian,
                now.least_scaled_jacobian(solid_corners(&body.mesh.elements[i])),
            );
        }
        yarn.pieces.iter().for_each(|piece| sample.measure_sections(yarn, piece, body));
        sample
    }

    /// Of the sections whose elements are all there.
    fn measure_sections<T: Number>(&mut self, yarn: &Yarn, piece: &Piece, body: &Body<T>) {
        let Piece { grid, first_node, first_element, .. } = piece;
        let whole_at = |layer: usize| grid.layer(layer).all(|element| body.is_intact(first_element + element));
        let at_rest = Sections::of(grid, |node| Vector3::from(body.mesh.nodes[first_node + node]));
        let now = Sections::of(grid, |node| Vector3::from(body.position(first_node + node)));
        for section in 0..=grid.layers {
            if (section.saturating_sub(1)..(section + 1).min(grid.layers)).all(whole_at) {
                let at_rest = at_rest.tilt_and_slip(section, yarn.halved);
                let now = now.tilt_and_slip(section, yarn.halved);
                self.tilt = largest(self.tilt, (now.0 - at_rest.0).abs());
                self.slip = largest(self.slip, (now.1 - at_rest.1).abs());
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

/// The sections of a yarn, in the places that `position` gives its nodes.
struct Sections<'a, P> {
    grid: &'a Grid,
    position: P,
    means: Vec<Vector3<f64>>,
}

impl<'a, P: Fn(usize) -> Vector3<f64>> Sections<'a, P> {
    fn of(grid: &'a Grid, position: P) -> Self {
        let sum = |section: usize| grid.section(section).map(&position).sum::<Vector3<f64>>();
        let means = (0..=grid.layers).map(|section| sum(section) / grid.nodes_per_section() as f64).collect();
        Sections { grid, position, means }
    }

    /// The angle by which a section's height leans along the yarn, in degrees, and how far its middle is ahead of its
    /// upper and lower side along the yarn.
    fn tilt_and_slip(&self, section: usize, halved: bool) -> (f64, f64) {
        let Grid { rows, columns, layers } = *self.grid;
        let (before, after) = (section.saturating_sub(1), (section + 1).min(layers));
        let along = (self.means[after] - self.means[before]).normalize();
        let first = self.grid.section(section).start;
        let node = |column: usize, row: usize| (self.position)(first + column * (rows + 1) + row);
        let height = |column: usize| node(column, rows) - node(column, 0);
        // The axis of a yarn that a plane of symmetry halves is at the side where it is highest.
        let axis = if halved { [0, columns] } else { [columns / 2, columns.div_ceil(2)] };
        let column = if height(axis[0]).norm() > height(axis[1]).norm() { axis[0] } else { axis[1] };
        let upright = height(column);
        let tilt = (along.dot(&upright) / upright.norm()).clamp(-1.0, 1.0).asin().to_degrees();
        let core = 0.5 * (node(column, rows / 2) + node(column, rows.div_ceil(2)));
        let sides = 0.5 * (node(column, rows) + node(column, 0));
        (tilt, along.dot(&(core - sides)))
    }
}
