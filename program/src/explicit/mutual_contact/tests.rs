use nalgebra::{Rotation3, Vector3};

use super::*;
use crate::explicit::body::Support;
use crate::explicit::medium::{Control, Medium};
use crate::explicit::mesh::{Mesh, Section, Yarn};
use crate::explicit::solver::Solver;
use crate::material::model::{Law, Material};
use toron::law::parameters;
use toron::{Criterion, Rotation};

const PARAMETERS: Parameters = Parameters { stiffness: 1e15, friction: 0.5, margin: 2e-5, deepest: 5e-5 };

/// The yarn of the thesis, without failure.
fn media() -> Vec<Medium<f64>> {
    let preset = parameters::preset("kevlar-km2-600").expect("it exists");
    let mut values = preset.values.to_vec();
    values[5..8].fill(0.0);
    let law = Law::new(preset.table, &values, Rotation::Fibre, Criterion::LargestPrincipal).expect("valid");
    let material = Material { law, values, density: Some(preset.density), label: String::new() };
    let control = Control { hourglass: 0.1, linear: 0.06, quadratic: 1.5, shape: 0.2, by_direction: false };
    vec![Medium::new(&material, preset.density, control).expect("valid")]
}

/// A bar 1 mm long with a section of 0.4 mm by 0.2 mm, its fibre along axis 0 turned by an angle about axis 1, its centre here.
fn bar(angle: f64, centre: [f64; 3]) -> Mesh {
    let section = Section::Rectangle;
    let yarn = Yarn { section, length: 1e-3, height: 2e-4, width: 4e-4, layers: 10, rows: 2, columns: 4 };
    let turn = Rotation3::from_axis_angle(&Vector3::y_axis(), angle);
    let mut mesh = yarn.mesh();
    for node in &mut mesh.nodes {
        *node = (turn * (Vector3::from(*node) - Vector3::x() * 5e-4) + Vector3::from(centre)).into();
    }
    let fibre: [f64; 3] = (turn * Vector3::x()).into();
    mesh.fibre = vec![fibre; mesh.elements.len()];
    mesh
}

fn bodies(meshes: Vec<Mesh>, media: &[Medium<f64>]) -> (Vec<Body<f64>>, MutualContact) {
    let surface = |mesh: &Mesh| {
        let (faces, elements) = outer_faces(&mesh.elements).into_iter().unzip();
        Surface::new(mesh, faces, elements)
    };
    let surfaces = meshes.iter().map(surface).collect();
    let bodies = meshes.into_iter().map(|mesh| Body::new(mesh, media, |_| 0)).collect();
    (bodies, MutualContact::new(PARAMETERS, surfaces))
}

/// Two bars of which one lies across the other, this deep in it.
fn crossed(depth: f64, media: &[Medium<f64>]) -> (Vec<Body<f64>>, MutualContact) {
    // Not square, and no node nearer to an edge of the other than 6 µm.
    bodies(vec![bar(0.0, [0.0; 3]), bar(1.3, [5.2e-5, 2e-4 - depth, 6.9e-5])], media)
}

fn force(body: &Body<f64>) -> Vector3<f64> {
    body.forces.iter().map(|&force| Vector3::from(force)).sum()
}

fn moment(bodies: &[Body<f64>]) -> Vector3<f64> {
    let of = |body: &Body<f64>| -> Vector3<f64> {
        let nodes = 0..body.mesh.nodes.len();
        nodes.map(|node| Vector3::from(body.position(node)).cross(&Vector3::from(body.forces[node]))).sum()
    };
    bodies.iter().map(of).sum()
}

#[test]
fn the_outer_faces_of_a_bar_look_outwards() {
    let mesh = bar(0.4, [0.0; 3]);
    let faces = outer_faces(&mesh.elements);
    assert_eq!(faces.len(), 2 * (4 * 2 + 10 * 4 + 10 * 2));
    let place = |node: u32| Vector3::from(mesh.nodes[node as usize]);
    let mut area = 0.0;
    for (face, _) in faces {
        let [a, b, c, d] = face.map(place);
        let normal = 0.5 * (c - a).cross(&(d - b));
        area += normal.norm();
        assert!(normal.dot(&(a + b + c + d)) > 0.0);
    }
    assert!((area - 2.0 * (1.0 * 0.4 + 1.0 * 0.2 + 0.4 * 0.2) * 1e-6).abs() < 1e-15, "{area}");
}

#[test]
fn two_bars_press_each_other_by_their_overlap() {
    let media = media();
    // A node that is nearer to an edge than this is pressed sideways.
    let depth = 1e-7;
    let (mut sum, shifts) = (0.0, 7);
    for shift in 0..shifts * shifts {
        let [x, z] = [shift % shifts, shift / shifts].map(|i| 1e-4 * f64::from(i) / f64::from(shifts) + 1.1e-6);
        let (mut bodies, mut contact) = bodies(vec![bar(0.0, [0.0; 3]), bar(1.3, [x, 2e-4 - depth, z])], &media);
        contact.apply(&mut bodies);
        let [lower, upper] = [&bodies[0], &bodies[1]].map(force);
        assert!((lower + upper).norm() < 1e-12 * lower.norm(), "{lower} {upper}");
        assert!(upper.x.abs() + upper.z.abs() < 1e-9 * upper.y);
        assert!(moment(&bodies).norm() < 1e-12 * upper.y * 1e-3, "{}", moment(&bodies));
        assert!((contact.stored / (0.5 * upper.y * depth) - 1.0).abs() < 1e-9 && contact.dissipated == 0.0);
        sum += upper.y;
    }
    // The common parallelogram is as wide as either and slanted. The outermost of five lines of nodes count √½ each, for ½.
    let width = 1e-4 * (3.0 + 2.0_f64.sqrt());
    let expected = PARAMETERS.stiffness * depth * width * 4e-4 / 1.3_f64.sin();
    let mean = sum / f64::from(shifts * shifts);
    assert!((mean / expected - 1.0).abs() < 0.02, "{mean} {expected}");
}

#[test]
fn sliding_bars_rub() {
    let media = media();
    let (mut bodies, mut contact) = crossed(1e-6, &media);
    contact.apply(&mut bodies);
    let pressing = force(&bodies[1]).y;
    let (steps, slip) = (200, 1e-8);
    for _ in 0..steps {
        for body in &mut bodies {
            body.forces.fill([0.0; 3]);
        }
        for u in &mut bodies[1].displacement {
            u[0] += slip;
        }
        contact.apply(&mut bodies);
    }
    let [lower, upper] = [&bodies[0], &bodies[1]].map(force);
    assert!((lower + upper).norm() < 1e-12 * lower.norm());
    assert!((upper.x / (-PARAMETERS.friction * upper.y) - 1.0).abs() < 1e-9, "{upper}");
    // Nodes slip after half of the depth.
    let path = f64::from(steps) * slip - PARAMETERS.friction * 1e-6;
    assert!(
        (contact.dissipated / (PARAMETERS.friction * pressing * path) - 1.0).abs() < 0.02,
        "{}",
        contact.dissipated
    );
}

#[test]
fn what_was_far_is_found_when_it_comes_near() {
    let media = media();
    let (mut bodies, mut contact) = crossed(-2e-4, &media);
    contact.apply(&mut bodies);
    assert_eq!((contact.searches, contact.stored), (1, 0.0));
    for _ in 0..100 {
        for u in &mut bodies[1].displacement {
            u[1] -= 2.01e-6;
        }
        contact.apply(&mut bodies);
    }
    assert!(contact.searches < 30, "{}", contact.searches);
    assert!(contact.stored > 0.0);
}

/// A bar falls on another that is free, at 20 m/s, and both fly on; the momentum and the change of energy over the kinetic energy
/// at the start, and where the nodes are.
fn collide(threads: usize) -> (Vector3<f64>, f64, Vec<[f64; 3]>, [f64; 2]) {
    let media = media();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    pool.install(|| {
        let (mut bodies, contact) = crossed(-1e-7, &media);
        for v in &mut bodies[1].velocity {
            *v = [3.0, -20.0, 1.0];
        }
        let mut solver = Solver::new(bodies, media);
        solver.mutual = Some(contact);
        solver.accelerate(true, 1.0).expect("stable");
        let start = solver.energies.total();
        solver.displace();
        while solver.time < 3e-6 {
            solver.accelerate(true, 1.0).expect("stable");
            solver.displace();
        }
        let momentum = |body: &Body<f64>| -> Vector3<f64> {
            body.mass.iter().zip(&body.velocity).map(|(&mass, &v)| mass * Vector3::from(v)).sum()
        };
        let total: Vector3<f64> = solver.bodies.iter().map(momentum).sum();
        let mass: f64 = solver.bodies[1].mass.iter().sum();
        let expected = mass * Vector3::new(3.0, -20.0, 1.0);
        let positions =
            solver.bodies.iter().flat_map(|body| (0..body.mesh.nodes.len()).map(|node| body.position(node)));
        let energies = solver.energies;
        assert!(momentum(&solver.bodies[0]).y < 0.3 * expected.y, "it was hit: {}", momentum(&solver.bodies[0]));
        let friction = energies.friction / start;
        (
            (total - expected) / expected.norm(),
            (energies.total() - start) / start,
            positions.collect(),
            [friction, energies.contact / start],
        )
    })
}

#[test]
fn a_collision_keeps_momentum_and_energy_and_has_the_same_bits_on_any_number_of_threads() {
    let [(momentum, energy, one, shares), (.., two, _)] = [1, 2].map(collide);
    assert!(momentum.norm() < 1e-12, "{momentum}");
    assert!(energy.abs() < 0.01, "{energy}");
    assert!(shares[0] > 1e-4, "{shares:?}");
    assert!(one == two);
}

#[test]
fn what_is_deleted_leaves_the_contact() {
    let media = media();
    let (mut bodies, mut contact) = crossed(1e-6, &media);
    let free = Support { free: [true; 3], velocity: [0.0; 3] };
    bodies[0].support(0, free);
    contact.apply(&mut bodies);
    let stored = contact.stored;
    let all: Vec<usize> = (0..bodies[1].mesh.elements.len()).collect();
    bodies[1].delete(&all);
    contact.remove(1, &bodies[1]);
    for body in &mut bodies {
        body.forces.fill([0.0; 3]);
    }
    contact.apply(&mut bodies);
    assert_eq!([force(&bodies[0]), force(&bodies[1])], [Vector3::zeros(); 2]);
    assert!((contact.stored / stored - 1.0).abs() < 1e-12, "the balance keeps what was stored");
}
