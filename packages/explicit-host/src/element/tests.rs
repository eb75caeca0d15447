use super::*;
use crate::stress::{Points, nominal_stress};
use crate::viscosity::Viscosity;

pub const MODULUS: f64 = 0.6;
/// A skewed brick, and a prism whose upper rear edge has shrunk to nothing.
pub const NODES: [[f64; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [2.0, 0.1, 0.0],
    [0.1, 1.0, 0.1],
    [2.1, 1.2, 0.0],
    [0.0, 0.1, 1.5],
    [2.0, 0.0, 1.4],
    [0.2, 1.0, 1.5],
    [2.0, 1.1, 1.6],
];
const ELEMENTS: [[u32; 8]; 2] = [[0, 1, 2, 3, 4, 5, 6, 7], [0, 1, 2, 3, 4, 5, 4, 5]];

struct State {
    f: Vec<f64>,
    modal: Vec<f64>,
}

fn deform(shapes: &Shapes<f64>, displacement: &[[f64; 3]]) -> State {
    let mut state = State { f: vec![0.0; 9 * shapes.stride], modal: vec![0.0; 12 * shapes.stride] };
    shapes.deform(displacement, &Rows::new(0, 0), &mut state.f, &mut state.modal);
    state
}

/// Displacements that are no linear field.
fn crooked() -> Vec<[f64; 3]> {
    (0..8).map(|i| [0.1, 0.7, 1.3].map(|phase| 0.05 * (phase + 2.3 * f64::from(i)).sin())).collect()
}

fn forces(shapes: &Shapes<f64>, state: &State, stress: [f64; 6]) -> Vec<[f64; 3]> {
    let stress: Vec<f64> = stress.iter().flat_map(|&s| vec![s; shapes.stride]).collect();
    let intact = vec![1.0; shapes.stride];
    let mut nominal = vec![0.0; 9 * shapes.stride];
    let viscosity = Viscosity::new(shapes);
    let point = Points { deformation_gradient: &state.f, stress: &stress, viscosity: &viscosity };
    nominal_stress(shapes.stride, &point, &mut nominal);
    let mut forces = vec![[0.0; 3]; NODES.len()];
    shapes.forces(&nominal, &state.modal, &intact, &Rows::new(0, 0), &mut forces);
    forces
}

#[test]
fn a_linear_field_has_its_gradient_and_no_hourglass() {
    let shapes = Shapes::<f64>::new(&ELEMENTS, &[], &NODES, MODULUS);
    let h = nalgebra::Matrix3::new(0.1, -0.3, 0.2, 0.4, 0.05, -0.1, -0.2, 0.3, -0.15);
    let field: Vec<[f64; 3]> = NODES.iter().map(|&x| (h * nalgebra::Vector3::from(x)).into()).collect();
    let state = deform(&shapes, &field);
    for element in 0..shapes.n {
        for (c, expected) in (h + nalgebra::Matrix3::identity()).iter().enumerate() {
            assert!((state.f[c * shapes.stride + element] - expected).abs() < 1e-14);
        }
        assert!((0..12).all(|c| state.modal[c * shapes.stride + element].abs() < 1e-14));
    }
}

#[test]
fn axes_of_its_own_turn_the_reference_placement_and_nothing_else() {
    let fibre = [0.6, 0.0, 0.8];
    let [plain, turned] = [&[][..], &[fibre, fibre]].map(|fibre| Shapes::<f64>::new(&ELEMENTS, fibre, &NODES, MODULUS));
    let [a, b] = [&plain, &turned].map(|shapes| deform(shapes, &crooked()));
    let of = |shapes: &Shapes<f64>, values: &[f64], element: usize| {
        nalgebra::Matrix3::from_fn(|i, j| values[(i + 3 * j) * shapes.stride + element])
    };
    let stress = [3.0, -1.0, 2.0, 0.5, -0.7, 0.2];
    for element in 0..2 {
        let axes = of(&turned, &turned.at_rest(), element);
        assert!((axes.column(0) - nalgebra::Vector3::from(fibre)).norm() < 1e-15);
        assert!((axes.determinant() - 1.0).abs() < 1e-15);
        let difference = of(&turned, &b.f, element) - of(&plain, &a.f, element) * axes;
        assert!(difference.norm() < 1e-14, "{difference}");
        assert!((turned.volume(element) / plain.volume(element) - 1.0).abs() < 1e-14);
    }
    for (c, d) in a.modal.iter().zip(&b.modal) {
        assert!((c - d).abs() < 1e-14);
    }
    for (c, d) in forces(&plain, &a, stress).as_flattened().iter().zip(forces(&turned, &b, stress).as_flattened()) {
        assert!((c - d).abs() < 1e-13, "{c} {d}");
    }
}

/// S = 8 Σ ∇N ⊗ ∇N in the current placement, corners being so many times as heavy, and the fibre's direction there.
fn spread(shapes: &Shapes<f64>, state: &State, heavier: [f64; 8]) -> (nalgebra::Matrix3<f64>, nalgebra::Vector3<f64>) {
    let f = nalgebra::Matrix3::from_fn(|i, j| state.f[(i + 3 * j) * shapes.stride]);
    let current = f.try_inverse().expect("it is regular").transpose();
    let mut sum = nalgebra::Matrix3::zeros();
    let corners = ELEMENTS[0].map(|node| NODES[node as usize]);
    for (corner, heavier) in heavier.into_iter().enumerate() {
        let gradient = current * nalgebra::Vector3::from(Shape::new(corners).gradient(corner));
        sum += 8.0 / heavier * gradient * gradient.transpose();
    }
    (sum, f.column(0).normalize())
}

/// Against nalgebra, corners alike and not.
#[test]
fn the_spread_along_and_across_is_that_of_the_gradients() {
    let mut shapes = Shapes::<f64>::new(&ELEMENTS[..1], &[], &NODES, MODULUS);
    for heavier in [[1.0; 8], [1.0, 2.0, 0.5, 1.5, 1.0, 3.0, 1.0, 0.8]] {
        if heavier != [1.0; 8] {
            shapes.weigh(0, heavier);
            assert_eq!(shapes.lightest, Some(0.5));
        }
        let state = deform(&shapes, &crooked());
        let (s, m) = spread(&shapes, &state, heavier);
        let mut measures = Measures::new(shapes.stride);
        shapes.measure(&state.f, &mut measures);
        let across = nalgebra::Matrix3::identity() - m * m.transpose();
        let section = across * s * across;
        let eigenvalues = section.symmetric_eigenvalues();
        let largest = eigenvalues.max();
        for (found, expected) in [
            (measures.spread_along[0], m.dot(&(s * m))),
            (measures.trace_across[0], section.trace()),
            (measures.spread_across[0], largest),
            (measures.area_across[0], largest * (section.trace() - largest)),
            (measures.slanting[0], (across * s * m).norm_squared()),
        ] {
            assert!((found - expected).abs() < 1e-9 * s.norm().powi(2), "{found} {expected}");
            assert!(expected > 1e-3, "there is something to compare: {expected}");
        }
    }
}

#[test]
fn forces_are_in_balance() {
    let shapes = Shapes::<f64>::new(&ELEMENTS, &[], &NODES, MODULUS);
    let displacement = crooked();
    let state = deform(&shapes, &displacement);
    let forces = forces(&shapes, &state, [3.0, -1.0, 2.0, 0.5, -0.7, 0.2]);
    let sum = forces.iter().fold(nalgebra::Vector3::zeros(), |sum, &f| sum + nalgebra::Vector3::from(f));
    assert!(sum.norm() < 1e-14, "{sum}");
}

#[test]
fn hourglass_forces_are_the_slope_of_their_energy() {
    let shapes = Shapes::<f64>::new(&ELEMENTS[..1], &[], &NODES, MODULUS);
    let mut displacement = crooked();
    let state = deform(&shapes, &displacement);
    let force = forces(&shapes, &state, [0.0; 6]);
    assert!(force.iter().flatten().any(|f| f.abs() > 1e-4), "there is something to compare");
    let step = 1e-6;
    for (node, i) in [(0, 0), (3, 1), (6, 2), (7, 0)] {
        let [low, high] = [-step, step].map(|change| {
            displacement[node][i] += change;
            let energy = shapes.hourglass_energy(0, &deform(&shapes, &displacement).modal);
            displacement[node][i] -= change;
            energy
        });
        let slope = (high - low) / (2.0 * step);
        assert!((slope + force[node][i]).abs() < 1e-8, "{slope} {}", force[node][i]);
    }
}

#[test]
fn nodal_forces_do_the_work_of_the_stress() {
    // δW = V P:δF for a displacement that is a linear field; the hourglass does none.
    let shapes = Shapes::<f64>::new(&ELEMENTS[..1], &[], &NODES, MODULUS);
    let stress = [3.0, -1.0, 2.0, 0.5, -0.7, 0.2];
    let state = deform(&shapes, &crooked());
    let force = forces(&shapes, &state, stress);
    let f = nalgebra::Matrix3::from_fn(|i, j| state.f[(i + 3 * j) * shapes.stride]);
    let p = toron::law::stress::first_piola_kirchhoff(&stress, &f);
    let h = nalgebra::Matrix3::new(0.1, -0.3, 0.2, 0.4, 0.05, -0.1, -0.2, 0.3, -0.15);
    let work: f64 = NODES
        .iter()
        .zip(&force)
        .map(|(&x, &f)| -(h * nalgebra::Vector3::from(x)).dot(&nalgebra::Vector3::from(f)))
        .sum();
    assert!((work - shapes.volume(0) * p.dot(&h)).abs() < 1e-13 * work.abs().max(1.0), "{work}");
}
