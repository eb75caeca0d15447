//! Bodies as ParaView reads them.

use super::body::Body;
use super::lanes::Number;
use super::medium::ENERGY_NAMES;
use super::solver::Solver;
use crate::vtk::{self, array, components, vectors};
use toron::law::state::{FAILURE_INDEX, HYPERELASTIC, INVARIANTS};
use toron::law::status;
use toron_shared::error::Error;

/// Components of the stress, in ParaView's order of a symmetric tensor.
const STRESS: [&str; 6] = ["11", "22", "33", "12", "23", "31"];

/// What an element has.
struct Cell {
    corners: [u32; 8],
    yarn: usize,
    densities: [f64; 5],
    stress: [f64; 6],
    invariants: [f64; 4],
    failure_index: f64,
    limit: Option<f64>,
}

/// The bodies as they stand, as the text of a VTU file: intact elements only, with displacement and velocity of the
/// nodes, and of the elements the energy densities, the law's Cauchy stress, the invariants and the failure index, by
/// the names of the laws' tables, and the failure limits where elements have their own; of several bodies, which are
/// yarns, also their numbers from 0.
///
/// # Errors
/// The law refuses its call.
pub fn unstructured_grid<T: Number>(solver: &Solver<T>) -> Result<String, Error> {
    let (bodies, media) = (&solver.bodies, &solver.media);
    let (mut positions, mut cells) = (Vec::new(), Vec::new());
    for (yarn, body) in bodies.iter().enumerate() {
        let first = positions.len() as u32;
        positions.extend((0..body.mesh.nodes.len()).map(|node| body.position(node)));
        let meaning = |code| status::meaning(code).unwrap_or("no known code");
        let stress = body.stress(media).map_err(|code| Error::Evaluation(format!("the stress: {}", meaning(code))))?;
        cells.extend((0..body.mesh.elements.len()).filter(|&i| body.is_intact(i)).map(|i| Cell {
            corners: body.mesh.elements[i].map(|node| first + node),
            yarn,
            densities: body.energy_densities(media, i),
            stress: stress[i],
            invariants: body.invariants(media, i),
            failure_index: body.failure_index(media, i),
            limit: body.own_limit(i),
        }));
    }
    let (mut point_data, mut cell_data) = (String::new(), String::new());
    let mut nodal = |name: &str, of: fn(&Body<T>) -> &[[T; 3]]| {
        let values = bodies.iter().flat_map(of).map(|value| value.map(Into::into));
        vectors(&mut point_data, name, values);
    };
    nodal("displacement", |body| &body.state.displacement);
    nodal("velocity", |body| &body.state.velocity);
    let mut scalar = |name: &str, of: &dyn Fn(&Cell) -> f64| {
        array(&mut cell_data, name, "Float32", 1, cells.iter().map(|cell| of(cell) as f32));
    };
    for (mode, name) in ENERGY_NAMES.into_iter().enumerate() {
        scalar(name, &|cell| cell.densities[mode]);
    }
    for mode in 0..4 {
        scalar(HYPERELASTIC[INVARIANTS + mode].name, &|cell| cell.invariants[mode]);
    }
    scalar(HYPERELASTIC[FAILURE_INDEX].name, &|cell| cell.failure_index);
    if cells.iter().any(|cell| cell.limit.is_some()) {
        scalar("failure_limit", &|cell| cell.limit.unwrap_or_default());
    }
    components(&mut cell_data, "cauchy", STRESS, cells.iter().map(|cell| cell.stress));
    if bodies.len() > 1 {
        array(&mut cell_data, "yarn", "Int32", 1, cells.iter().map(|cell| cell.yarn));
    }
    let corners = cells.iter().map(|cell| cell.corners);
    Ok(vtk::unstructured_grid(positions.into_iter(), corners, &point_data, &cell_data))
}
