//! The bodies at an instant, to be drawn.

use serde::{Deserialize, Serialize};

use super::lanes::Number;
use super::solver::Solver;

/// Nodes and elements body by body.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Snapshot {
    pub time: f64,
    pub positions: Vec<[f64; 3]>,
    pub intact: Vec<bool>,
    /// As [`ENERGY_NAMES`](super::medium::ENERGY_NAMES) has them.
    pub densities: Vec<[f64; 5]>,
    /// Von Mises stress in the elements of solids.
    pub von_mises: Vec<f64>,
    /// Height of the striker's centre, and its radius.
    pub striker: Option<(f64, f64)>,
}

impl Snapshot {
    /// How the bodies stand, and a striker of this radius.
    pub fn of<T: Number>(solver: &Solver<T>, radius: f64) -> Snapshot {
        let mut snapshot = Snapshot {
            time: solver.state.time,
            positions: Vec::new(),
            intact: Vec::new(),
            densities: Vec::new(),
            von_mises: Vec::new(),
            striker: solver.striker.as_ref().map(|striker| (striker.position, radius)),
        };
        for body in &solver.bodies {
            let elements = 0..body.mesh.elements.len();
            snapshot.positions.extend((0..body.mesh.nodes.len()).map(|node| body.position(node)));
            snapshot.intact.extend(elements.clone().map(|i| body.is_intact(i)));
            snapshot.von_mises.extend(elements.clone().filter_map(|i| {
                let (block, place) = body.element(i);
                block.von_mises(&solver.media[block.medium], place)
            }));
            snapshot.densities.extend(elements.map(|i| body.energy_densities(&solver.media, i)));
        }
        snapshot
    }

    /// The largest of a density in intact elements.
    pub fn largest(&self, density: impl Fn(&[f64; 5]) -> f64) -> f64 {
        let intact = self.densities.iter().zip(&self.intact).filter(|(_, intact)| **intact);
        intact.map(|(densities, _)| density(densities)).fold(0.0, f64::max)
    }
}
