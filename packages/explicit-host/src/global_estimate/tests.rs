use nalgebra::{DMatrix, DVector, Matrix3, Rotation3, Vector3};

use super::*;
use crate::archive::Archive;
use crate::block::{Scratch, StepOptions};
use crate::body::Support;
use crate::medium::Control;
use crate::mesh::{Mesh, Section, Yarn};
use crate::mutual_contact::{Parameters, Surface, outer_faces};
use crate::solver::Solver;
use crate::tie::Tie;
use toron::law::parameters;
use toron::law::wave_bounds::Deformed as Point;
use toron::{Criterion, Rotation};
use toron_materials::material::model::{Law, Material, Origin};

const PARAMETERS: Parameters =
    Parameters { stiffness: 1e15, friction: 0.5, margin: 2e-5, deepest: 5e-5, pressed_at_rest: true };
const CONTROL: Control = Control { hourglass: 0.1, linear: 0.06, quadratic: 1.5, shape: 0.2, by_direction: true };
/// Of the damping.
const REFERENCE: f64 = 1e-8;

fn media() -> Vec<Medium<f64>> {
    let preset = parameters::preset("kevlar-km2-600").expect("it exists");
    let mut values = preset.values.to_vec();
    values[4] = 126e6;
    values[5..8].fill(0.0);
    let law = Law::new(preset.into(), &values, Rotation::Fibre, Criterion::LargestPrincipal).expect("valid");
    let (label, own, origin) = (String::new(), String::new(), Origin::default());
    let material = Material { law, density: Some(preset.density), label, own, origin, temperature: None };
    vec![Medium::new(&material, preset.density, CONTROL).expect("valid")]
}

/// A bar turned about axis 1, its centre here.
fn bar(angle: f64, centre: [f64; 3]) -> Mesh {
    let section = Section::Rectangle;
    let mut mesh = Yarn { section, length: 6e-4, height: 2e-4, width: 4e-4, layers: 4, rows: 1, columns: 2 }.mesh();
    let turn = Rotation3::from_axis_angle(&Vector3::y_axis(), angle);
    for node in &mut mesh.nodes {
        *node = (turn * (Vector3::from(*node) - Vector3::x() * 3e-4) + Vector3::from(centre)).into();
    }
    let fibre: [f64; 3] = (turn * Vector3::x()).into();
    mesh.fibre = vec![fibre; mesh.elements.len()];
    mesh
}

/// Two bars of which one lies across the other, this high above it.
fn crossed(gap: f64, media: &[Medium<f64>]) -> (Vec<Body<f64>>, MutualContact) {
    let meshes = [bar(0.0, [0.0; 3]), bar(1.3, [5.2e-5, 2e-4 + gap, 6.9e-5])];
    let surfaces = meshes.iter().map(|mesh| {
        let (faces, elements) = outer_faces(&mesh.elements).into_iter().unzip();
        Surface::new(mesh, faces, elements)
    });
    let contact = MutualContact::new(PARAMETERS, surfaces.collect());
    (meshes.map(|mesh| Body::new(mesh, media, |_| 0)).into(), contact)
}

/// The same pressed, deformed and with a tied node.
fn pressed(media: &[Medium<f64>]) -> (Vec<Body<f64>>, MutualContact) {
    let (mut bodies, mut contact) = crossed(-1e-6, media);
    let last = bodies[0].mesh.nodes.len() as u32 - 6;
    let corners = [0, 1, 4, 5].map(|corner| last + corner);
    bodies[0].tie(vec![Tie { node: last + 2, corners, shares: [0.25; 4] }]);
    for (node, u) in bodies.iter_mut().flat_map(|body| &mut body.state.displacement).enumerate() {
        *u = [0.3, 1.1, 2.9].map(|phase| 2e-6 * (phase + 2.3 * node as f64).sin());
    }
    contact.apply(&mut bodies);
    (bodies, contact)
}

fn add_elements(bodies: &mut [Body<f64>], media: &[Medium<f64>]) {
    let options = StepOptions { reference: REFERENCE, trial: Some(REFERENCE), ..StepOptions::default() };
    bodies.iter_mut().for_each(|body| body.compute_forces(media, &mut Scratch::default(), options));
}

fn noise(bodies: &mut [Body<f64>]) {
    let mut random = fastrand::Rng::with_seed(3);
    for body in bodies {
        body.state.trial = body.mesh.nodes.iter().map(|_| [0; 3].map(|_| random.f64() - 0.5)).collect();
    }
}

/// x·A x of a body, by what resists it.
fn power(body: &Body<f64>) -> f64 {
    let products = body.state.trial.as_flattened().iter().zip(body.trial.resisted.as_flattened());
    -products.map(|(x, force)| x * force).sum::<f64>()
}

/// The form that bounds an element, of a trial motion.
fn form(body: &Body<f64>, medium: &Medium<f64>, stress: [f64; 6], i: usize) -> f64 {
    let block = &body.blocks[0];
    let corners = body.mesh.elements[i].map(|node| node as usize);
    let sign = |corner: usize, axis: usize| if corner >> axis & 1 == 1 { 0.125 } else { -0.125 };
    let by_xi = |at: &dyn Fn(usize) -> Vector3<f64>| {
        Matrix3::from_columns(&[0, 1, 2].map(|axis| (0..8).map(|c| at(corners[c]) * sign(c, axis)).sum()))
    };
    let x = by_xi(&|node| body.mesh.nodes[node].into());
    let inverse = x.try_inverse().expect("regular");
    let f = Matrix3::identity() + by_xi(&|node| body.state.displacement[node].into()) * inverse;
    let h = by_xi(&|node| body.state.trial[node].into()) * (f * x).try_inverse().expect("regular");
    let fibre = Vector3::from(body.mesh.fibre[i]);
    let [u, v, w] = [fibre, Vector3::y(), fibre.cross(&Vector3::y())].map(|axis| f * axis);
    let m = u.normalize();
    let across = Matrix3::identity() - m * m.transpose();
    let metric = [v, w].map(|column| (across * column).norm_squared());
    let point = Point {
        columns: [u.into(), v.into(), w.into()],
        stress,
        volume_ratio: f.determinant(),
        stretch_square: u.norm_squared(),
        section: metric,
    };
    let bounds = medium.bounds.at(&point).expect("by direction");
    let (volume, length) = (block.shapes.volume(i), block.shapes.length(i));
    let (breadth, damping) = ((volume / length).sqrt(), 2.0 / REFERENCE * medium.density);
    let section = 0.5 * across * (h + h.transpose()) * across;
    let (along, trace) = (m.dot(&(h * m)), section.trace());
    let shape = (section - 0.5 * trace * across).norm_squared();
    volume
        * ((bounds.returning * bounds.elongation + damping * length * CONTROL.linear * medium.wave_speed)
            * along
            * along
            + bounds.tension * (across * h * m).norm_squared()
            + (bounds.compaction + damping * breadth * CONTROL.linear * medium.compaction_speed) * trace * trace
            + 2.0 * (bounds.distortion + damping * breadth * CONTROL.shape * medium.distortion_speed) * shape
            + bounds.all_round * h.norm_squared())
}

#[test]
fn elements_resist_by_the_forms_that_bound_them() {
    let media = media();
    let (mut bodies, _) = pressed(&media);
    noise(&mut bodies);
    add_elements(&mut bodies, &media);
    for body in &bodies {
        let (block, stress) = (&body.blocks[0], body.stress(&media).expect("valid"));
        let (mut f, mut modal) = (vec![0.0; 9 * block.shapes.stride], vec![0.0; 12 * block.shapes.stride]);
        block.shapes.deform(&body.state.trial, &crate::rows::Rows::new(0, 0), &mut f, &mut modal);
        let of = |i: usize| form(body, &media[0], stress[i], i) + 2.0 * block.shapes.hourglass_energy(i, &modal);
        let expected: f64 = (0..block.shapes.n).map(of).sum();
        assert!((power(body) / expected - 1.0).abs() < 1e-9, "{} {expected}", power(body));
    }
}

/// Both moved alike nothing resists; one alone is resisted as it is pressed more.
#[test]
fn contact_resists_what_moves_apart() {
    let media = media();
    let (mut bodies, mut contact) = crossed(-1e-6, &media);
    contact.apply(&mut bodies);
    let force = |bodies: &[Body<f64>]| bodies[1].forces.iter().map(|force| force[1]).sum::<f64>();
    let mut resisted = |motions: [f64; 2]| {
        for (body, motion) in bodies.iter_mut().zip(motions) {
            body.state.trial = vec![[0.0, motion, 0.0]; body.mesh.nodes.len()];
            let Body { trial, state, .. } = body;
            trial.start(&mut state.trial, body.mesh.nodes.len());
        }
        contact.resist(&mut bodies);
        bodies.iter().map(|body| body.trial.resisted.iter().map(|force| force[1]).sum::<f64>()).collect::<Vec<_>>()
    };
    let (alike, apart) = (resisted([1.0, 1.0]), resisted([0.0, 1.0]));
    assert!(apart[1] < 0.0 && (apart[0] + apart[1]).abs() < 1e-9 * apart[0], "{apart:?}");
    assert!(alike.iter().all(|force| force.abs() < 1e-9 * apart[0]), "{alike:?}");
    let before = force(&bodies);
    bodies.iter_mut().for_each(|body| body.forces.fill([0.0; 3]));
    bodies[1].state.displacement.iter_mut().for_each(|u| u[1] -= 1e-8);
    contact.apply(&mut bodies);
    let stiffness = (force(&bodies) - before) / 1e-8;
    assert!(
        -apart[1] > 0.99 * CONTACT * stiffness && -apart[1] < 2.0 * CONTACT * stiffness,
        "{} {stiffness}",
        apart[1]
    );
}

/// Between the growth that has settled and the largest eigenvalue of the matrix there are some thousandths, and from
/// there on central differences are not stable.
#[test]
fn the_largest_eigenvalue_is_found() {
    let media = media();
    let (mut bodies, contact) = pressed(&media);
    noise(&mut bodies);
    let places: Vec<(usize, usize)> =
        (0..2).flat_map(|b| (0..bodies[b].mesh.nodes.len()).map(move |node| (b, node))).collect();
    let free: Vec<_> = places.into_iter().filter(|&(b, node)| bodies[b].mass[node] > 0.0).collect();
    let acceleration = |bodies: &mut [Body<f64>], x: &DVector<f64>| {
        for (&(b, node), x) in free.iter().zip(x.as_slice().chunks(3)) {
            bodies[b].state.trial[node].copy_from_slice(x);
        }
        bodies.iter_mut().for_each(|body| {
            body.trial.sizes = vec![1.0];
            body.scale_trial(1.0);
        });
        add_elements(bodies, &media);
        contact.resist(bodies);
        bodies.iter_mut().for_each(Body::iterate);
        DVector::from_iterator(x.len(), free.iter().flat_map(|&(b, node)| bodies[b].state.trial[node]))
    };
    let size = 3 * free.len();
    let mut matrix = DMatrix::zeros(size, size);
    for i in 0..size {
        let unit = DVector::from_fn(size, |k, _| f64::from(u8::from(k == i)));
        matrix.set_column(i, &acceleration(&mut bodies, &unit));
    }
    let root = |i: usize| bodies[free[i / 3].0].mass[free[i / 3].1].sqrt();
    let symmetric = DMatrix::from_fn(size, size, |i, j| -root(i) * matrix[(i, j)] / root(j));
    assert!((&symmetric - symmetric.transpose()).norm() < 1e-9 * symmetric.norm());
    let eigenvalue = symmetric.symmetric_eigenvalues().max();

    noise(&mut bodies);
    let mut growth = 0.0;
    for iteration in 1..=150 {
        add_elements(&mut bodies, &media);
        growth = iterate(&mut bodies, &contact, None);
        if iteration == SETTLED {
            assert!(growth > 0.9 * eigenvalue, "{growth:e} {eigenvalue:e}");
        }
    }
    assert!((growth / eigenvalue - 1.0).abs() < 0.01, "{growth:e} {eigenvalue:e}");
    let spread = |step: f64| {
        let mut x = DVector::from_fn(size, |i, _| (1.7 * i as f64).sin());
        let mut before = x.clone();
        for _ in 0..300 {
            let next = 2.0 * &x - &before + step * step * &matrix * &x;
            before = std::mem::replace(&mut x, next);
        }
        x.norm()
    };
    let step = 2.0 / growth.sqrt();
    assert!(spread(0.98 * step) < 1e4 && spread(1.05 * step) > 1e20, "{:e}", spread(1.05 * step));
}

/// A bar that is driven onto another.
fn driven() -> Solver<f64> {
    let media = media();
    let (mut bodies, contact) = crossed(1e-9, &media);
    for (body, (at, velocity)) in bodies.iter_mut().zip([(-1e-4, [0.0; 3]), (3e-4, [0.5, -2.0, 0.2])]) {
        for node in 0..body.mesh.nodes.len() {
            if (body.mesh.nodes[node][1] - at).abs() < 1e-5 {
                body.support(node, Support { free: [false; 3], velocity });
            }
        }
    }
    let mut solver = Solver::new(bodies, media);
    solver.mutual = Some(contact);
    solver
}

/// Up to a time, with the estimate or by the elements' bound alone; returns by how much the total energy has changed on
/// the way, over the work of the supports.
fn advance(solver: &mut Solver<f64>, end: f64, estimated: bool) -> f64 {
    let mut start = None;
    while solver.state.time < end {
        if !estimated {
            solver.state.estimate = Estimate::default();
        }
        solver.accelerate(true, 1.0).expect("stable");
        start.get_or_insert(solver.state.energies);
        solver.displace();
    }
    let (start, now) = (start.expect("a step was made"), solver.state.energies);
    (now.total() - start.total()) / now.external
}

fn positions(solver: &Solver<f64>) -> Vec<[f64; 3]> {
    let bodies = solver.bodies.iter();
    bodies.flat_map(|body| (0..body.mesh.nodes.len()).map(|node| body.position(node))).collect()
}

#[test]
fn longer_steps_keep_the_energy_and_their_bits() {
    const END: f64 = 3e-6;
    let [(one, change), (two, _)] = [1, 2].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let mut solver = driven();
        let change = pool.install(|| advance(&mut solver, END, true));
        (solver, change)
    });
    assert!(positions(&one) == positions(&two));
    let mut bounded = driven();
    let expected = advance(&mut bounded, END, false);
    let [steps, bound] = [&one, &bounded].map(|solver| solver.state.cost.steps);
    assert!(steps as f64 <= 0.95 * bound as f64, "{steps} {bound}");
    assert!(change.abs() < 3e-5 && expected.abs() < 3e-5, "{change} {expected}");

    // Goes on from what was written in between.
    let mut half = driven();
    advance(&mut half, 0.5 * END, true);
    let mut archive = Archive::Writes(Vec::new());
    half.archive(&mut archive).expect("it is written");
    let Archive::Writes(bytes) = archive else { panic!("it was written") };
    let mut restarted = driven();
    restarted.archive(&mut Archive::Reads(&bytes)).expect("it is read");
    advance(&mut restarted, END, true);
    assert!(positions(&restarted) == positions(&one));
}

/// An estimate that has settled at 6, with a bound of 10.
fn settled() -> Estimate {
    let mut estimate = Estimate::default();
    for _ in 0..SETTLED {
        assert!(estimate.is_due() && estimate.rate(10.0, 0.0).is_none());
        estimate.take(6.0, 1.0);
    }
    estimate
}

#[test]
fn an_estimate_adds_what_the_bound_grows_by() {
    let mut estimate = settled();
    let rates = [10.0, 10.5, 9.0].map(|bound| estimate.rate(bound, 0.0));
    assert_eq!(rates, [Some(6.0), Some(6.5), Some(6.0)]);
    assert!(!estimate.is_due() && estimate.rate(5.0, 0.0).is_none());
    // It falls slowly.
    estimate.take(1.0, 1.0);
    assert_eq!(estimate.rate(10.0, 0.0), Some(FADE * 6.0));
}

#[test]
fn a_rate_is_no_less_than_the_least() {
    let mut estimate = settled();
    assert_eq!([3.0, 7.0].map(|least| estimate.rate(10.0, least)), [Some(6.0), Some(7.0)]);
}

#[test]
fn the_bound_holds_after_a_jump() {
    let mut estimate = settled();
    assert_eq!(estimate.rate(10.0, 0.0), Some(6.0));
    for _ in 0..AFTER_JUMP {
        assert!(estimate.rate(12.0, 0.0).is_none() && estimate.is_due());
        estimate.take(8.0, 1.0);
    }
    assert_eq!(estimate.rate(12.0, 0.0), Some(8.0));
    // One in a step with an iteration as well.
    estimate.take(8.0, 1.0);
    assert!(estimate.rate(14.0, 0.0).is_none() && estimate.is_due());
}

#[test]
fn a_shorter_step_than_the_reference_has_more_damping() {
    let mut estimate = settled();
    // Two seconds are as long as the reference or longer; half a second has twice the damping, at most.
    estimate.take(1.0, 1.0);
    assert_eq!([1.0, 16.0].map(|rate| estimate.stable_step(rate)), [2.0, 0.25]);
}
