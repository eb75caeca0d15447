use super::*;
use crate::block::SWOLLEN;
use crate::body::Support;
use crate::contact::{Contact, RigidSurface, Shape};
use crate::lanes::largest;
use crate::medium::Control;
use crate::mesh::{Section, Yarn};
use toron::law::parameters;
use toron::{Criterion, Rotation};
use toron_materials::material::model::{Law, Material, Origin};

/// A cube of 1 mm with these boundary conditions; it may fail.
fn cube(support_of: impl Fn([f64; 3]) -> Support) -> Solver<f64> {
    let preset = parameters::preset("kevlar-km2-600").expect("it exists");
    cube_of(preset.values.to_vec(), support_of)
}

fn cube_of<T: Number>(values: Vec<f64>, support_of: impl Fn([f64; 3]) -> Support) -> Solver<T> {
    bar(values, 1, false, support_of)
}

/// A cube of 1 mm of so many elements along the fibre, whose steps are bounded by direction or not.
fn bar<T: Number>(
    values: Vec<f64>,
    layers: usize,
    by_direction: bool,
    support_of: impl Fn([f64; 3]) -> Support,
) -> Solver<T> {
    let preset = parameters::preset("kevlar-km2-600").expect("it exists");
    let law = Law::new(preset.into(), &values, Rotation::Fibre, Criterion::LargestPrincipal).expect("valid");
    let density = preset.density;
    let material = Material {
        law,
        density: Some(density),
        label: String::new(),
        own: String::new(),
        origin: Origin::default(),
        temperature: None,
    };
    let control = Control { hourglass: 0.1, linear: 0.06, quadratic: 1.5, shape: 0.2, by_direction };
    let section = Section::Rectangle;
    let yarn = Yarn { section, length: 1e-3, height: 1e-3, width: 1e-3, layers, rows: 1, columns: 1 };
    let medium = Medium::new(&material, density, control).expect("valid");
    let media = vec![medium];
    let mut body = Body::new(yarn.mesh(), &media, |_| 0);
    for node in 0..body.mesh.nodes.len() {
        body.support(node, support_of(body.mesh.nodes[node]));
    }
    Solver::new(vec![body], media)
}

/// A node with a prescribed velocity.
fn driven(velocity: [f64; 3]) -> Support {
    Support { free: [false; 3], velocity }
}

/// A step; returns the energies at its start.
fn step(solver: &mut Solver<f64>) -> Energies {
    short_step(solver, 1.0)
}

/// A step no longer than this.
fn short_step(solver: &mut Solver<f64>, longest: f64) -> Energies {
    solver.accelerate(true, longest).expect("the step is stable");
    let energies = solver.state.energies;
    solver.displace();
    energies
}

/// A thousand steps, each a fifth of what a displacement of 10 changes by at least in single precision.
#[test]
fn slow_motions_are_not_lost_in_single_precision() {
    let preset = parameters::preset("kevlar-km2-600").expect("it exists");
    let mut solver: Solver<f32> = cube_of(preset.values.to_vec(), |_| driven([0.0; 3]));
    let body = &mut solver.bodies[0];
    body.state.displacement.fill([10.0, 0.0, 0.0]);
    body.state.velocity.fill([2.0, 0.0, 0.0]);
    for _ in 0..1000 {
        body.displace(1e-7);
    }
    for [x, ..] in &body.state.displacement {
        assert!((f64::from(*x) - 10.0002).abs() < 1e-6, "{x}");
    }
}

/// The top is driven through the bottom at 100 m/s.
fn collapse([_, y, _]: [f64; 3]) -> Support {
    driven([0.0, if y > 0.0 { -100.0 } else { 0.0 }, 0.0])
}

#[test]
fn an_element_that_may_fail_goes_when_it_has_collapsed() {
    let mut solver = cube(collapse);
    let (mut first, mut worst) = (None, 0.0);
    while solver.bodies[0].state.deleted.is_empty() {
        step(&mut solver);
        let change = solver.state.energies.total() - *first.get_or_insert(solver.state.energies.total());
        worst = largest(worst, change.abs());
        assert!(solver.state.time < 1e-5, "the top is through the bottom after 10 µs");
    }
    let first_step = solver.state.first_step.expect("a step was made");
    assert!(solver.state.step < 1.1 * COLLAPSED * first_step && solver.state.step > 0.5 * COLLAPSED * first_step);
    assert!(worst < 0.01 * solver.state.energies.external, "{worst} of {}", solver.state.energies.external);
    assert_eq!((solver.bodies[0].state.deleted.len(), solver.bodies[0].state.collapsed), (1, 1));
    // Without it nothing limits the step.
    solver.accelerate(true, 1e-5).expect("nothing is left to collapse");
    assert!(solver.state.step > first_step && !solver.bodies[0].is_intact(0));
}

#[test]
fn an_element_that_may_fail_goes_when_its_section_has_swollen() {
    let values = parameters::preset("kevlar-km2-600").expect("it exists").values.to_vec();
    // At 20 km/s.
    let apart = |place: [f64; 3]| driven([0.0, 2e4 * place[1].signum(), 2e4 * place[2].signum()]);
    let mut solver: Solver<f64> = bar(values, 1, true, apart);
    let half = solver.bodies[0].mesh.nodes[0].map(f64::abs);
    let swollen = |solver: &Solver<f64>| {
        let [_, y, z] = solver.bodies[0].position(0).map(f64::abs);
        y * z / (half[1] * half[2])
    };
    let mut before = 1.0;
    while solver.bodies[0].state.deleted.is_empty() {
        before = swollen(&solver);
        short_step(&mut solver, 1e-9);
        assert!(before < 2.0 * SWOLLEN);
    }
    assert!((before / SWOLLEN - 1.0).abs() < 0.01, "{before}");
    assert_eq!(solver.bodies[0].state.collapsed, 1);
}

/// A cube whose fibre is this part of its length at rest, and is drawn out at this speed without linear viscosity; it
/// does not fail.
fn drawn_out(stretch: f64, speed: f64) -> Solver<f64> {
    let mut values = parameters::preset("kevlar-km2-600").expect("it exists").values.to_vec();
    values[5..8].fill(0.0);
    let along = Support { free: [true, false, false], velocity: [0.0; 3] };
    let mut solver: Solver<f64> = bar(values, 10, true, |[x, ..]| if x > 0.0 { along } else { driven([0.0; 3]) });
    solver.media[0].control.linear = 0.0;
    let body = &mut solver.bodies[0];
    for (node, [x, ..]) in body.mesh.nodes.iter().enumerate() {
        body.state.displacement[node][0] = (stretch - 1.0) * x;
        body.state.velocity[node][0] = speed * x / 1e-3;
    }
    solver
}

/// However short it is, its fibre's wave limits the step as at rest; nothing gets lost where it is tense again.
#[test]
fn a_slack_fibre_is_tense_again_within_stable_steps() {
    let first_step = |stretch| {
        let mut solver = drawn_out(stretch, 0.0);
        step(&mut solver);
        solver.state.step
    };
    let [rest, slack] = [1.0, 0.3].map(first_step);
    assert!((slack / rest - 1.0).abs() < 0.05, "{slack:e} {rest:e}");
    let mut solver = drawn_out(0.3, 300.0);
    let (start, mut most, mut tense) = (step(&mut solver), 0.0, 0.0);
    while solver.state.time < 4e-6 {
        let now = step(&mut solver);
        most = largest(most, (now.total() - start.total()).abs() / start.kinetic);
        tense = largest(tense, now.internal / start.kinetic);
    }
    assert!(tense > 0.8 && most < 0.02, "{tense} {most}");
    assert!(solver.bodies[0].state.velocity.iter().any(|v| v[0] < -100.0), "it springs back");
}

#[test]
fn a_collapsing_element_that_does_not_fail_shortens_the_step_until_there_is_none() {
    let mut values = parameters::preset("kevlar-km2-600").expect("it exists").values.to_vec();
    values[5..8].fill(0.0);
    let mut solver: Solver<f64> = cube_of(values, collapse);
    let (mut first, mut worst, mut steps) = (None, 0.0, 0);
    let error = loop {
        if let Err(error) = solver.accelerate(true, 1.0) {
            break error.to_string();
        }
        let change = solver.state.energies.total() - *first.get_or_insert(solver.state.energies.total());
        worst = largest(worst, change.abs());
        solver.displace();
        steps += 1;
        assert!(steps < 100_000 && solver.state.time < 1e-5, "the top is through the bottom after 10 µs");
    };
    assert!(error.contains("elements have collapsed") && solver.bodies[0].state.deleted.is_empty(), "{error}");
    let external = solver.state.energies.external;
    assert!(worst < 0.01 * external, "{worst} of {external}");
}

/// A striker held at 10 m/s presses the cube for 10 µs in steps no longer than this: the change of the total energy
/// over the striker's work.
fn press(longest: f64) -> f64 {
    let free = Support { free: [true; 3], velocity: [0.0; 3] };
    let mut solver = cube(|[_, y, _]| if y > 0.0 { free } else { driven([0.0; 3]) });
    let cylinder = RigidSurface { shape: Shape::Cylinder, radius: 0.01, stiffness: 1e13, friction: 0.0, aim: [0.0; 2] };
    let contact = Contact::new(cylinder, &solver.bodies[0].mesh.surface);
    solver.striker = Some(Striker::new(1e-5, 0.5e-3 + cylinder.radius, -10.0, true, vec![contact]));
    let start = short_step(&mut solver, longest).total();
    let (mut force, mut work, mut now) = (0.0, 0.0, Energies::default());
    while solver.state.time < 1e-5 {
        let moved = solver.striker.as_ref().expect("it is there").moved;
        now = short_step(&mut solver, longest);
        let after = solver.striker.as_ref().expect("it is there").force;
        work -= 0.5 * (force + after) * moved;
        force = after;
    }
    assert!(solver.striker.is_some_and(|striker| striker.velocity == -10.0));
    assert!(work > 0.0 && (now.external / work - 1.0).abs() < 1e-3, "{} is not {work}", now.external);
    (now.total() - start) / work
}

#[test]
fn a_held_striker_works_on_the_body() {
    // In stable steps, and in shorter ones.
    for (longest, bound) in [(1.0, 2e-3), (2e-8, 3e-4)] {
        let imbalance = press(longest);
        assert!(imbalance.abs() < bound, "{imbalance} in steps of up to {longest}");
    }
}

#[test]
fn a_deleted_element_keeps_its_energy() {
    // Pulled at 10 m/s, one corner faster: it fails with energy in its hourglass modes.
    let mut solver = cube(|[x, y, z]| {
        let faster = if y > 0.0 && z > 0.0 { 12.0 } else { 10.0 };
        driven([if x > 0.0 { faster } else { 0.0 }, 0.0, 0.0])
    });
    let start = step(&mut solver).total();
    let mut before = Energies::default();
    while solver.bodies[0].state.deleted.is_empty() {
        before = step(&mut solver);
        assert!(solver.state.time < 1e-5, "it is a tenth longer by now");
    }
    assert!(before.hourglass > 1e-6 * before.internal && before.hourglass > 0.0, "{before:?}");
    assert!((before.total() - start).abs() < 0.01 * before.external, "{before:?}");
    let failed = step(&mut solver);
    let later = (0..10).fold(failed, |_, _| step(&mut solver));
    assert_eq!(later, failed, "nothing moves any energy");
    assert_eq!((failed.hourglass, failed.internal), (before.hourglass, before.internal));
    // The last force goes on for half a step.
    let half = failed.external - before.external;
    assert!((failed.total() + half - before.total()).abs() < 1e-9 * before.external, "{before:?} {failed:?}");
}
#[test]
fn an_element_that_could_not_be_evaluated_stays_deleted() {
    let mut solver = cube(|_| driven([0.0; 3]));
    let pull = |solver: &mut Solver<f64>, factor: [f64; 3]| {
        let body = &mut solver.bodies[0];
        for (node, place) in body.mesh.nodes.iter().enumerate() {
            body.state.displacement[node] = std::array::from_fn(|i| (factor[i] - 1.0) * place[i]);
        }
    };
    pull(&mut solver, [1.01, 1.0, 1.0]);
    let stretched = step(&mut solver);
    assert!(stretched.internal > 0.0 && solver.bodies[0].state.deleted.is_empty());
    pull(&mut solver, [1.01, -1.0, 1.0]);
    step(&mut solver);
    assert_eq!(solver.bodies[0].state.deleted, [0]);
    pull(&mut solver, [1.02, 1.0, 1.0]);
    let restored = step(&mut solver);
    assert_eq!(restored.internal, stretched.internal, "it keeps the energy it had");
    assert!(solver.bodies[0].forces.iter().all(|&force| force == [0.0; 3]), "{:?}", solver.bodies[0].forces);
}

/// What ParaView is given is what moves the nodes: the law's own stress where they are, by either law.
#[test]
fn the_stress_of_an_element_is_the_law_s() {
    let stretch = |[x, _, _]: [f64; 3]| driven([if x > 0.0 { 100.0 } else { 0.0 }, 0.0, 0.0]);
    let mut solver = cube(stretch);
    while solver.state.time < 1e-7 {
        step(&mut solver);
    }
    solver.accelerate(true, 1.0).expect("the step is stable");
    let (body, media) = (&solver.bodies[0], &solver.media);
    let state = body.blocks[0].history.clone();
    let stress = body.stress(media).expect("the law takes it");
    assert!(state == body.blocks[0].history && stress.len() == 1);
    // All but the fibre's length stays: P = k_el ln λ/λ, and the section's area is that at rest.
    let stretch = 1.0 + 100.0 * solver.state.time / 1e-3;
    let k_el = parameters::preset("kevlar-km2-600").expect("it exists").values[0];
    let expected = k_el * stretch.ln() / stretch;
    assert!((stress[0][0] / expected - 1.0).abs() < 1e-9, "{stress:?} {expected}");
    assert!(stress[0][1..].iter().all(|value| value.abs() < 1e-9 * expected), "{stress:?}");
    let invariants = body.invariants(media, 0);
    assert!((invariants[0] - stretch.ln()).abs() < 1e-12 && invariants[1..].iter().all(|i| i.abs() < 1e-12));
}
