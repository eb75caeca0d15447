//! Bodies as ParaView reads them.

use super::body::Body;
use super::lanes::Number;
use super::medium::ENERGY_NAMES;
use super::solver::Solver;
use crate::common::vtk::{self, array, vectors};

/// The bodies as they stand, as the text of a VTU file: intact elements only, with displacement and velocity of the nodes
/// and the energy densities of the elements; of several bodies, which are yarns, also their numbers from 0.
pub fn unstructured_grid<T: Number>(solver: &Solver<T>) -> String {
    let bodies = &solver.bodies;
    let (mut positions, mut cells) = (Vec::new(), Vec::new());
    let (mut densities, mut yarns) = (Vec::new(), Vec::new());
    for (number, body) in bodies.iter().enumerate() {
        let first = positions.len() as u32;
        positions.extend((0..body.mesh.nodes.len()).map(|node| body.position(node)));
        for i in (0..body.mesh.elements.len()).filter(|&i| body.is_intact(i)) {
            cells.push(body.mesh.elements[i].map(|node| first + node));
            densities.push(body.energy_densities(&solver.media, i));
            yarns.push(number);
        }
    }
    let (mut point_data, mut cell_data) = (String::new(), String::new());
    let mut nodal = |name: &str, of: fn(&Body<T>) -> &[[T; 3]]| {
        let values = bodies.iter().flat_map(of).map(|value| value.map(Into::into));
        vectors(&mut point_data, name, values);
    };
    nodal("displacement", |body| &body.displacement);
    nodal("velocity", |body| &body.velocity);
    for (mode, name) in ENERGY_NAMES.into_iter().enumerate() {
        array(&mut cell_data, name, "Float32", 1, densities.iter().map(|energies| energies[mode] as f32));
    }
    if bodies.len() > 1 {
        array(&mut cell_data, "yarn", "Int32", 1, yarns.into_iter());
    }
    vtk::unstructured_grid(positions.into_iter(), cells.into_iter(), &point_data, &cell_data)
}
