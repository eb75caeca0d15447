//! Where a fine part of a yarn meets a coarse one: waves pass, and nothing is lost.

use std::collections::BTreeMap;

use super::scene::Scene;
use super::solver;
use crate::weave::model::Yarn;
use toron_explicit_host::solver::Solver;

/// Half the length of the pulses, four elements of the coarse mesh, and where they start.
const WIDTH: f64 = 1.5;
const START: f64 = 5.0;
/// Where what comes back is looked for, on this side of the joint at 14.6 mm.
const BACK: std::ops::Range<f64> = 4.0..13.0;

/// A straight warp yarn, without the wefts under which it lies; coarse beyond 14 mm, if at all.
fn yarn(is_coarse: bool) -> (Yarn, Solver<f64>) {
    let over = |letter: &str, other: &str| format!("{}{other}{}", letter.repeat(32), letter.repeat(31));
    let text = format!(
        "units = \"mm-g-ms\"\n[weave]\npreset = \"kevlar-s706\"\nalong = 4\ncolumns = 4\npattern = [\"{}\", \"{}\"]\n\
         [weave.panel]\nshape = \"rectangle\"\nhalf = [22.4, 0.35]\n{}\n\
         [scene]\nspeed = 1.0\nmass = 0.03\nradius = 1.0\ncontact-stiffness = 1e5\nend = 1.0\n\
         hyperelastic.properties = {{ k_ld = 126.0 }}\n",
        over("o", "u"),
        over("u", "o"),
        if is_coarse { "coarse-radius = 14.0" } else { "" }
    );
    let scene = Scene::parse("yarn.toml", &text).expect("a scene");
    let panel = scene.cases[0].cloth.model();
    let mut solver = solver::build(&scene.cases[0], &panel).expect("a panel");
    (solver.striker, solver.mutual) = (None, None);
    solver.bodies.truncate(1);
    (panel.yarns[0].clone(), solver)
}

/// What came of a pulse.
struct Passed {
    /// The largest velocity at first.
    most: f64,
    /// The mean velocity of each section where what comes back is looked for, by its place in µm.
    by_place: BTreeMap<i64, f64>,
    imbalance: f64,
}

/// Sends a pulse along the yarn, past the joint. `axis` is that of the motion, `tension` the strain of the yarn before.
fn send(is_coarse: bool, axis: usize, tension: f64) -> Passed {
    let (_, mut solver) = yarn(is_coarse);
    let along = solver.media[0].wave_speed;
    let stretch = 1.0 + tension;
    // Of the string in the reference placement: its force over its mass by length and its stretch.
    let speed = if axis == 0 { along } else { along * (stretch.ln()).sqrt() / stretch };
    let shape = |x: f64| (-((x - START) / WIDTH).powi(2)).exp();
    let size = if axis == 0 { 10.0 / speed } else { 0.02 };
    let body = &mut solver.bodies[0];
    for (node, place) in body.mesh.nodes.iter().enumerate() {
        let x = place[0];
        body.state.displacement[node][0] = tension * x;
        // A pulse of velocity moves what it has passed by its area.
        let (moved, velocity) = if axis == 0 {
            let beyond = (0..4000).map(|i| shape(x + 0.005 * (f64::from(i) + 0.5)) * 0.005).sum::<f64>();
            (size * beyond, size * speed * shape(x))
        } else {
            (size * shape(x), size * speed * 2.0 * (x - START) / WIDTH.powi(2) * shape(x))
        };
        body.state.displacement[node][axis] += moved;
        body.state.velocity[node][axis] = velocity;
    }
    let most = |solver: &Solver<f64>| {
        solver.bodies[0].state.velocity.iter().map(|velocity| velocity[axis].abs()).fold(0.0, f64::max)
    };
    let (sent, mut energies) = (most(&solver), Vec::new());
    let end = 14.0 / speed;
    while solver.state.time < end {
        solver.accelerate(true, end - solver.state.time).expect("stable");
        energies.push(solver.state.energies.total());
        solver.displace();
    }
    let body = &solver.bodies[0];
    let mut sums: BTreeMap<i64, [f64; 2]> = BTreeMap::new();
    for (place, velocity) in
        body.mesh.nodes.iter().zip(&body.state.velocity).filter(|(place, _)| BACK.contains(&place[0]))
    {
        let sum = sums.entry((1e3 * place[0]).round() as i64).or_default();
        *sum = [sum[0] + velocity[axis], sum[1] + 1.0];
    }
    let drift = energies.iter().map(|energy| (energy - energies[0]).abs()).fold(0.0, f64::max);
    let by_place = sums.into_iter().map(|(place, [sum, count])| (place, sum / count)).collect();
    Passed { most: sent, by_place, imbalance: drift / energies[0] }
}

/// What comes back from the joint, over what was sent: the difference to a yarn that is fine everywhere.
fn reflected(axis: usize, tension: f64) -> f64 {
    let [fine, coarse] = [false, true].map(|is_coarse| send(is_coarse, axis, tension));
    // Viscosity, whose work lags by half a step, moves the energy of so short a pulse in both.
    assert!((fine.imbalance - coarse.imbalance).abs() < 1e-4, "{} {}", fine.imbalance, coarse.imbalance);
    assert_eq!(fine.by_place.len(), coarse.by_place.len());
    let difference = |(place, velocity): (&i64, &f64)| (velocity - coarse.by_place[place]).abs();
    fine.by_place.iter().map(difference).fold(0.0, f64::max) / fine.most
}

#[test]
fn a_longitudinal_wave_passes_the_joint() {
    let part = reflected(0, 0.0);
    assert!(part > 0.0 && part < 1e-3, "{part}");
}

#[test]
fn a_transverse_wave_passes_the_joint() {
    let part = reflected(2, 0.02);
    assert!(part > 0.0 && part < 0.05, "{part}");
}

#[test]
fn tied_nodes_have_no_mass_and_take_none() {
    let [fine, coarse] = [false, true].map(yarn);
    let mass = |solver: &Solver<f64>| solver.bodies[0].mass.iter().sum::<f64>();
    assert!((mass(&coarse.1) / mass(&fine.1) - 1.0).abs() < 1e-9, "{} {}", mass(&coarse.1), mass(&fine.1));
    assert_eq!(coarse.0.ties.len(), 2 * 15);
    assert!(coarse.0.ties.iter().all(|tie| coarse.1.bodies[0].mass[tie.node as usize] == 0.0));
}
