//! A load on the section: deck, CalculiX, energies and the deformed section at the end.

use std::collections::HashMap;
use std::path::Path;
use std::time::Duration;

use super::deck::{self, STRESS_UNIT, Task, front};
use super::energies::{self, Increment};
use super::model::Model;
use super::scene::{Load, Scene};
use super::solver::{self, Printed};
use crate::common::error::Error;

/// A quadrilateral of a fibre, deformed: its corners in diameters, and the von Mises stress in the scene's unit.
pub type Patch = ([[f64; 2]; 4], f64);

/// What came of a load.
#[derive(Debug)]
pub struct Outcome {
    pub load: Load,
    pub increments: Vec<Increment>,
    /// The fibres at the last increment.
    pub patches: Vec<Patch>,
    /// Why the load was not taken to its end.
    pub failure: Option<String>,
    pub elapsed: Duration,
}

/// What CalculiX is asked to compute.
pub fn task<'a>(scene: &'a Scene, model: &'a Model, load: Load) -> Task<'a> {
    let (fibre, friction, increments) = (&scene.fibre, scene.friction, scene.increments);
    Task { model, fibre, friction, load, last_stretch: scene.last_stretch(load), increments }
}

/// Runs a load on so many threads.
///
/// # Errors
/// CalculiX cannot be started, or leaves nothing of what it was asked for.
pub fn run(
    program: &Path,
    task: &Task,
    text: &str,
    threads: usize,
    progress: &mut dyn FnMut(f64),
) -> Result<Outcome, Error> {
    let name = task.load.name();
    let printed = solver::run(program, text, threads, progress)?;
    let in_load = |message: String| Error::Evaluation(format!("load {name}: {message}"));
    let increments = energies::increments(task, &printed.tables).map_err(in_load)?;
    let Some(last) = increments.last() else {
        let why = printed.failure.unwrap_or_else(|| "CalculiX has printed no energies".to_string());
        return Err(in_load(format!("not one increment converges: {why}")));
    };
    let short = (last.stretch - task.last_stretch).abs() > 1e-6;
    let failure = (short || printed.failure.is_some()).then(|| {
        let why = printed.failure.clone().unwrap_or_else(|| "CalculiX stopped".to_string());
        let (reached, wanted) = (last.stretch, task.last_stretch);
        format!("load {name}: increment {} does not converge; the stretch is {reached:.5} then, and {wanted:.5} at the end: {why}", increments.len() + 1)
    });
    let patches = patches(task, &printed);
    Ok(Outcome { load: task.load, increments, patches, failure, elapsed: printed.elapsed })
}

/// The fibres' quadrilaterals with the mean of their corners' stresses.
fn patches(task: &Task, printed: &Printed) -> Vec<Patch> {
    let moved: HashMap<usize, [f64; 3]> = printed.displacements.iter().copied().collect();
    let stressed: HashMap<usize, f64> =
        printed.stresses.iter().map(|(node, stress)| (*node, von_mises(stress))).collect();
    let unit = STRESS_UNIT * task.fibre.e_2;
    let patch = |quad: &[usize; 4]| {
        let mut corners = quad.map(|node| task.model.nodes[node]);
        let mut sum = 0.0;
        for (corner, &node) in corners.iter_mut().zip(quad) {
            let u = moved.get(&front(node))?;
            *corner = [corner[0] + u[0], corner[1] + u[1]];
            sum += stressed.get(&front(node))?;
        }
        Some((corners, 0.25 * unit * sum))
    };
    task.model.bodies[..task.model.fibres].iter().flat_map(|body| &body.quads).filter_map(patch).collect()
}

/// Of xx, yy, zz, xy, yz, zx.
fn von_mises([xx, yy, zz, xy, yz, zx]: &[f64; 6]) -> f64 {
    let normal = (xx - yy).powi(2) + (yy - zz).powi(2) + (zz - xx).powi(2);
    (0.5 * normal + 3.0 * (xy * xy + yz * yz + zx * zx)).sqrt()
}

/// The deck of a task, for those who want to run it themselves.
pub fn deck(task: &Task) -> String {
    deck::text(task)
}
