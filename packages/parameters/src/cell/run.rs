//! A load on the section: deck, CalculiX, energies and the deformed section at the end.

use std::collections::HashMap;
use std::time::{Duration, Instant};

use super::deck::{self, STRESS_UNIT, Task, front};
use super::energies::{self, Increment};
use super::model::Model;
use super::scene::{Load, Scene};
use super::solver::{Job, Printed};
use toron_shared::error::Error;

/// The stretch is known to the seven digits that CalculiX prints of the time.
const ROUNDING: f64 = 1e-6;

/// The fibres' energy over the supports' work, from the load's middle on; before, what the polygons' corners store
/// counts. Where it is more, CalculiX has taken for equilibrium what is none. The trapezoidal rule over the increments
/// is within a percent.
const MOST_ENERGY: f64 = 1.02;

/// How often a load is taken again with twice as many increments where that happens: to eight times as many. In larger
/// increments the contact finds an equilibrium that is none sooner.
const REFINEMENTS: usize = 3;

/// A quadrilateral of a fibre, deformed: its corners in diameters, and the von Mises stress in the scene's unit.
pub type Patch = ([[f64; 2]; 4], f64);

/// The fibres, deformed.
#[derive(Debug, Default)]
pub struct Shape {
    pub patches: Vec<Patch>,
    /// The edges of the fibres' circumferences, which tell fibres apart where they are pressed together.
    pub rims: Vec<[[f64; 2]; 2]>,
}

/// Where the work of the walls has gone by the end of a load in the explicit host.
#[derive(Clone, Copy, Debug)]
pub struct Shares {
    /// Over the strain energy: the kinetic energy, and the hourglass modes' part of it.
    pub kinetic: f64,
    pub hourglass: f64,
    /// Over the work: friction, viscosity and brake, penetration.
    pub friction: f64,
    pub viscosity: f64,
    pub contact: f64,
    /// What the balance of energy is off by.
    pub balance: f64,
    pub steps: u64,
}

/// What came of a load.
#[derive(Debug)]
pub struct Outcome {
    pub load: Load,
    pub increments: Vec<Increment>,
    /// The fibres at the last increment.
    pub shape: Shape,
    /// Where the walls' work has gone; of the explicit host.
    pub shares: Option<Shares>,
    /// The increments with which it was taken again, where the fibres stored more than the walls' work with those of
    /// the scene.
    pub refined: Option<usize>,
    /// Why the load was not taken to its end.
    pub failure: Option<String>,
    pub elapsed: Duration,
}

/// What CalculiX is asked to compute.
pub fn task<'a>(scene: &'a Scene, model: &'a Model, load: Load) -> Task<'a> {
    let (fibre, friction, increments) = (&scene.fibre, scene.friction, scene.increments);
    Task { model, fibre, friction, load, last_stretch: scene.last_stretch(load), increments }
}

/// Runs a load, and again with more increments as long as the fibres store more than the walls have done work.
///
/// # Errors
/// CalculiX cannot be started, or leaves nothing of what it was asked for.
pub fn run(job: &Job, task: Task, progress: &mut dyn FnMut(f64)) -> Result<Outcome, Error> {
    let (mut task, asked, started) = (task, task.increments, Instant::now());
    loop {
        let (outcome, unbalanced) = once(job, &task, progress)?;
        let refined = (task.increments > asked).then_some(task.increments);
        if !unbalanced || task.increments >= asked << REFINEMENTS {
            return Ok(Outcome { refined, elapsed: started.elapsed(), ..outcome });
        }
        task.increments *= 2;
    }
}

/// Runs a load once; whether the fibres store more than the walls have done work.
fn once(job: &Job, task: &Task, progress: &mut dyn FnMut(f64)) -> Result<(Outcome, bool), Error> {
    let name = task.load.name();
    let printed = job.run(&deck::text(task), progress)?;
    let in_load = |message: String| Error::Evaluation(format!("load {name}: {message}"));
    let (mut increments, missing) = energies::increments(task, &printed.tables);
    let unbalanced = first_unbalanced(&increments, task.last_stretch);
    increments.truncate(unbalanced.unwrap_or(increments.len()));
    let too_much = unbalanced.map(|_| {
        format!(
            "with {} increments to the load's end its fibres store more than the walls have done work: no equilibrium",
            task.increments
        )
    });
    let why = too_much.or(missing).or_else(|| printed.failure.clone());
    let Some(last) = increments.last() else {
        let why = why.unwrap_or_else(|| "CalculiX has printed no energies".to_string());
        return Err(in_load(format!("not one increment converges: {why}")));
    };
    let short = (last.stretch - task.last_stretch).abs() > ROUNDING;
    let failure = (short || why.is_some()).then(|| {
        format!(
            "load {name}: increment {} does not converge, at I_tc = {:.4}, I_td = {:.4}; the increments before are kept: {}",
            increments.len() + 1,
            last.invariants[0],
            last.invariants[1],
            why.unwrap_or_else(|| "CalculiX stopped".to_string())
        )
    });
    let shape = shape(task, &printed);
    let outcome =
        Outcome { load: task.load, increments, shape, shares: None, refined: None, failure, elapsed: printed.elapsed };
    Ok((outcome, unbalanced.is_some()))
}

/// The first increment, from the load's middle on, in which the fibres store more than the supports have done work.
fn first_unbalanced(increments: &[Increment], last_stretch: f64) -> Option<usize> {
    increments.iter().position(|increment| {
        let late = 1.0 - increment.stretch > 0.5 * (1.0 - last_stretch);
        late && increment.whole > MOST_ENERGY * increment.work
    })
}

/// The fibres' quadrilaterals with the mean of their corners' stresses, and their circumferences.
fn shape(task: &Task, printed: &Printed) -> Shape {
    let moved: HashMap<usize, [f64; 3]> = printed.displacements.iter().copied().collect();
    let stressed = printed.stresses.iter().map(|(node, stress)| (*node, von_mises(stress)));
    let stressed: HashMap<usize, f64> = stressed.collect();
    let unit = STRESS_UNIT * task.fibre.e_2;
    let place = |node: usize| {
        let ([x, y], u) = (task.model.nodes[node], moved.get(&front(node))?);
        Some([x + u[0], y + u[1]])
    };
    let mut shape = Shape::default();
    for body in &task.model.bodies[..task.model.fibres] {
        for quad in &body.quads {
            let corners: Option<Vec<[f64; 2]>> = quad.iter().map(|&node| place(node)).collect();
            let stresses: Option<Vec<f64>> = quad.iter().map(|&node| stressed.get(&front(node)).copied()).collect();
            let (Some(corners), Some(stresses)) = (corners, stresses) else { continue };
            let mean = 0.25 * unit * stresses.iter().sum::<f64>();
            shape.patches.push(([corners[0], corners[1], corners[2], corners[3]], mean));
        }
        for (edge, _) in &body.rim {
            let quad = body.quads[edge.quad];
            if let (Some(from), Some(to)) = (place(quad[edge.edge]), place(quad[(edge.edge + 1) % 4])) {
                shape.rims.push([from, to]);
            }
        }
    }
    shape
}

/// Of xx, yy, zz, xy, yz, zx.
fn von_mises([xx, yy, zz, xy, yz, zx]: &[f64; 6]) -> f64 {
    let normal = (xx - yy).powi(2) + (yy - zz).powi(2) + (zz - xx).powi(2);
    (0.5 * normal + 3.0 * (xy * xy + yz * yz + zx * zx)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 25 increments to a stretch of 0.9 whose work is in the fibres but for what friction took, 3 %; the energy is
    /// multiplied by `factor` from increment `from` on.
    fn series(factor: f64, from: usize) -> Vec<Increment> {
        let increment = |number: usize| {
            let stretch = 1.0 - 0.1 * number as f64 / 25.0;
            let work = f64::ln(stretch).powi(2);
            let whole = 0.97 * work * if number >= from { factor } else { 1.0 };
            Increment {
                stretch,
                invariants: [stretch.ln(), 0.0],
                energy: whole,
                whole,
                springs: 0.0,
                work,
                friction: 0.0,
            }
        };
        (1..=25).map(increment).collect()
    }

    #[test]
    fn energy_beyond_the_work_ends_a_load() {
        assert_eq!(first_unbalanced(&series(1.0, 1), 0.9), None);
        // 1.0185 of the work, within what the trapezoidal rule misses, and 1.0282.
        assert_eq!(first_unbalanced(&series(1.05, 1), 0.9), None);
        assert_eq!(first_unbalanced(&series(1.06, 20), 0.9), Some(19));
        // Up to the middle, between the twelfth and the thirteenth, what the polygons' corners store counts.
        assert_eq!(first_unbalanced(&series(1.06, 1), 0.9), Some(12));
    }
}
