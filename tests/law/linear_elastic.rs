//! The linear elastic baseline against closed forms: stretch, failure, drift of the frames, simple shear, work.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use approx::assert_relative_eq;
use nalgebra::{Matrix3, Rotation3, SymmetricEigen, Vector3};
use proptest::prelude::*;
use toron::Measure;
use toron::law::state::{
    LINEAR_ALIVE, LINEAR_ELASTIC_STATE, LINEAR_FAILED, LINEAR_LARGEST, LINEAR_STRESS, LINEAR_WORK,
};
use toron::law::status;
use toron::law::stress::{components, matrix, pulled_back};
use toron::{Criterion, LinearElastic, LinearPoint, LinearTangent, Rotation};
use toron_test_support::deformations::{rotation, samples};

/// Tab. 4.4, in GPa.
const E1: f64 = 79.414;
const E2: f64 = 0.794;
const G: f64 = 0.126;
const LIMIT: f64 = 3.637;

const START: [f64; LINEAR_ELASTIC_STATE] = [0.0; LINEAR_ELASTIC_STATE];
const FRAMES: [Rotation; 3] = [Rotation::Fibre, Rotation::Polar, Rotation::Spin];

/// Fibre along x, second axis along y.
fn yarn(limit: f64) -> LinearElastic {
    LinearElastic::new(&[E1, E2, G, limit, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]).expect("valid properties")
}

/// The last point of a path F(t), t from 0 to 1 in equal steps.
fn walk(
    law: &LinearElastic,
    rotation: Rotation,
    criterion: Criterion,
    steps: usize,
    path: impl Fn(f64) -> Matrix3<f64>,
) -> LinearPoint {
    let mut axes = law.reference_axes();
    let mut point = LinearPoint { stress: [0.0; 6], state: START, status: status::OK };
    for i in 0..steps {
        let at = |i: usize| path(i as f64 / steps as f64);
        point = law.step(&at(i), &at(i + 1), &point.state, rotation, criterion, &mut axes);
        assert_eq!(point.status, status::OK, "step {i}");
    }
    point
}

fn follow(law: &LinearElastic, rotation: Rotation, steps: usize, path: impl Fn(f64) -> Matrix3<f64>) -> LinearPoint {
    walk(law, rotation, Criterion::LargestPrincipal, steps, path)
}

fn stretch(lambda: f64) -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(lambda, 1.0, 1.0))
}

fn about_z(angle: f64) -> Matrix3<f64> {
    Rotation3::from_axis_angle(&Vector3::z_axis(), angle).into_inner()
}

/// σ11 = E1 ln λ in any number of steps, in every frame: each step adds a rounding or two.
#[test]
fn stretch_along_the_fibre() {
    for rotation in FRAMES {
        for lambda in [0.9f64, 1.0001, 1.0458, 1.5] {
            for steps in [1, 10, 1000] {
                let point = follow(&yarn(0.0), rotation, steps, |t| stretch(1.0 + t * (lambda - 1.0)));
                let bound = 4.0 * f64::EPSILON * (1.0 + steps as f64);
                let expected = E1 * lambda.ln();
                assert!((point.stress[0] - expected).abs() <= bound * E1, "{rotation:?} λ = {lambda}, {steps} steps");
                assert_eq!(point.stress[1..], [0.0; 5]);
            }
        }
    }
}

/// The yarn fails at ln λ = σ_lim/E1 = 0.0458, a strain of 4.69 %.
#[test]
fn failure_in_tension() {
    let limit = LIMIT / E1;
    assert_relative_eq!(limit, 0.0458, epsilon = 5e-6);
    assert_relative_eq!(limit.exp_m1(), 0.0469, epsilon = 5e-5);
    for (part, failed) in [(1.0 - 1e-12, 0.0), (1.0 + 1e-12, 1.0)] {
        let point = follow(&yarn(LIMIT), Rotation::Fibre, 1, |t| stretch((t * part * limit).exp()));
        assert_eq!(point.state[LINEAR_FAILED], failed);
        assert_eq!(point.state[LINEAR_ALIVE], 1.0 - failed);
        assert_relative_eq!(point.stress[0], LIMIT, max_relative = 1e-11);
    }
    let compressed = follow(&yarn(LIMIT), Rotation::Fibre, 1, |t| stretch((-t).exp()));
    assert_eq!(compressed.state[LINEAR_FAILED], 0.0, "the criterion is signed");
}

/// Equality fails: a stress of 1 under a stiffness of 1 and a limit of 1.
#[test]
fn equality_fails() {
    let law = |limit: f64| LinearElastic::new(&[1.0, 1.0, 1.0, limit, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0]).expect("valid");
    let strain = [0.5, 0.0, 0.0, 0.0, 0.0, 0.0];
    for criterion in [Criterion::LargestPrincipal, Criterion::FibreStress] {
        for (limit, failed) in [(0.5, 1.0), (0.5f64.next_up(), 0.0), (0.0, 0.0)] {
            assert_eq!(law(limit).increment(&strain, 1.0, &START, criterion).state[LINEAR_FAILED], failed);
        }
    }
}

/// The failing call returns the intact stress and latches; later ones carry nothing and keep the work.
#[test]
fn latch() {
    let law = yarn(LIMIT);
    let broken = follow(&law, Rotation::Fibre, 1, |t| stretch(1.0 + 0.05 * t));
    assert_eq!(broken.stress, follow(&yarn(0.0), Rotation::Fibre, 1, |t| stretch(1.0 + 0.05 * t)).stress);
    assert!(broken.state[LINEAR_WORK] > 0.0);
    for rotation in FRAMES {
        let mut axes = law.reference_axes();
        let after =
            law.step(&stretch(1.05), &stretch(1.0), &broken.state, rotation, Criterion::LargestPrincipal, &mut axes);
        let also = law.increment(&[0.1; 6], 1.0, &broken.state, Criterion::LargestPrincipal);
        for point in [after, also] {
            assert_eq!((point.status, point.stress), (status::OK, [0.0; 6]));
            assert_eq!(point.state[LINEAR_STRESS..LINEAR_LARGEST], [0.0; 6]);
            assert_eq!(point.state[LINEAR_LARGEST..], broken.state[LINEAR_LARGEST..]);
        }
    }
}

/// A fibre tilted by shear and turned: its frame keeps the stress along it; the others let it drift, by the angles
/// between the fibre's atan γ and their own rotation: atan(γ/2) of the polar frame, γ/2 of the spin.
#[test]
fn drift_off_a_sheared_fibre() {
    let fibre_only = LinearElastic::new(&[E1, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]).expect("valid properties");
    let gamma: f64 = 0.4;
    let turn = 0.7;
    let path = |t: f64| {
        let mut shear = Matrix3::identity();
        shear.m21 = gamma * t;
        about_z(turn * t) * shear
    };
    let fibre_angle = turn + gamma.atan();
    let drifts = [0.0, gamma.atan() - (gamma / 2.0).atan(), gamma.atan() - gamma / 2.0];
    for (rotation, drift) in FRAMES.into_iter().zip(drifts) {
        let point = follow(&fibre_only, rotation, 2000, path);
        let eigen = SymmetricEigen::new(matrix(&point.stress));
        let axis = eigen.eigenvectors.column(eigen.eigenvalues.iamax()).into_owned();
        let angle = axis.y.atan2(axis.x).rem_euclid(std::f64::consts::PI);
        assert_relative_eq!(fibre_angle - angle, drift, epsilon = 1e-6);
    }
    // What the fibre frame reads is the fibre's own stretch, √(1 + γ²).
    let point = follow(&fibre_only, Rotation::Fibre, 2000, path);
    assert_relative_eq!(matrix(&point.stress).trace(), E1 * 0.5 * (gamma * gamma).ln_1p(), max_relative = 1e-6);
}

/// A rotation laid over the path turns the stress and changes nothing else: in the fibre and in the polar frame in any
/// steps, under the spin as the steps shrink.
#[test]
fn objectivity() {
    let path = |t: f64| {
        Matrix3::new(1.0 + 0.03 * t, 0.1 * t, 0.0, -0.05 * t, 1.0 - 0.2 * t, 0.1 * t * t, 0.0, 0.02 * t, 1.0 + 0.1 * t)
    };
    let axis = Vector3::new(1.0, -2.0, 0.5);
    let turned = |t: f64| Rotation3::new(axis * t).into_inner() * path(t);
    let difference = |rotation, steps| {
        let (still, moving) = (follow(&yarn(0.0), rotation, steps, path), follow(&yarn(0.0), rotation, steps, turned));
        let end = Rotation3::new(axis).into_inner();
        (matrix(&moving.stress) - end * matrix(&still.stress) * end.transpose()).norm() / matrix(&still.stress).norm()
    };
    for rotation in [Rotation::Fibre, Rotation::Polar] {
        assert!(difference(rotation, 7) < 1e-13, "{rotation:?}");
    }
    let errors = [20, 40, 80].map(|steps| difference(Rotation::Spin, steps));
    assert!(errors[2] < 1e-3, "{errors:?}");
    for pair in errors.windows(2) {
        assert_relative_eq!(pair[0] / pair[1], 4.0, epsilon = 0.2);
    }
}

/// A stretched body turned as a whole keeps its stress in every frame, however large the steps.
#[test]
fn rigid_rotation_after_a_stretch() {
    for rotation in FRAMES {
        let law = yarn(0.0);
        let mut axes = law.reference_axes();
        let f0 = stretch(1.02);
        let first = law.step(&Matrix3::identity(), &f0, &START, rotation, Criterion::LargestPrincipal, &mut axes);
        let turn = about_z(1.5);
        let point = law.step(&f0, &(turn * f0), &first.state, rotation, Criterion::LargestPrincipal, &mut axes);
        let expected = components(&(turn * matrix(&first.stress) * turn.transpose()));
        assert_relative_eq!(point.stress[..], expected[..], epsilon = 1e-14 * E1);
    }
}

/// A step too large to integrate says so, leaves the state and the axes, and carries no stress; a stretch by five and
/// a turn by 170° are not too large.
#[test]
fn steps_too_large() {
    let law = yarn(0.0);
    let old = follow(&law, Rotation::Fibre, 1, |t| stretch(1.0 + 0.01 * t)).state;
    let half_turn = Matrix3::from_diagonal(&Vector3::new(-1.0, -1.0, 1.0));
    for (f, spin_only, expected) in [
        (stretch(5.0), false, status::OK),
        (about_z(170f64.to_radians()), false, status::OK),
        (stretch(100.0), false, status::INCREMENT_TOO_LARGE),
        (half_turn, true, status::INCREMENT_TOO_LARGE),
    ] {
        for rotation in FRAMES {
            let mut axes = law.reference_axes();
            let point = law.step(&Matrix3::identity(), &f, &old, rotation, Criterion::LargestPrincipal, &mut axes);
            let expected = if spin_only && rotation != Rotation::Spin { status::OK } else { expected };
            assert_eq!(point.status, expected, "{rotation:?}, F = {f}");
            if expected != status::OK {
                assert_eq!((point.stress, point.state, axes), ([0.0; 6], old, law.reference_axes()));
            }
        }
    }
}

/// Axes that are not orthonormal have a status and keep their values: forgotten ones, too long ones, parallel ones,
/// some that are no numbers. Those that are written with three digits are taken, and the other frames do not look at
/// them.
#[test]
fn axes_that_are_not_orthonormal() {
    let (law, f) = (yarn(0.0), stretch(1.01));
    let old = follow(&law, Rotation::Fibre, 1, |t| stretch(1.0 + 0.01 * t)).state;
    let typed = Matrix3::new(0.707, -0.707, 0.0, 0.707, 0.707, 0.0, 0.0, 0.0, 1.0);
    let mut parallel = Matrix3::identity();
    parallel.set_column(1, &Vector3::new(1.0, 0.0, 0.0));
    for (axes, expected) in [
        (Matrix3::zeros(), status::MATERIAL_AXES),
        (Matrix3::identity() * 2.0, status::MATERIAL_AXES),
        (Matrix3::identity() * 1.01, status::MATERIAL_AXES),
        (Matrix3::from_element(1e200), status::MATERIAL_AXES),
        (Matrix3::from_element(f64::NAN), status::MATERIAL_AXES),
        (parallel, status::MATERIAL_AXES),
        (typed, status::OK),
    ] {
        for rotation in FRAMES {
            let (mut kept, mut with_tangent) = (axes, axes);
            let criterion = Criterion::LargestPrincipal;
            let point = law.step(&Matrix3::identity(), &f, &old, rotation, criterion, &mut kept);
            let (again, tangent) =
                law.step_with_tangent(&Matrix3::identity(), &f, &old, rotation, criterion, &mut with_tangent);
            let expected = if rotation == Rotation::Spin { expected } else { status::OK };
            assert_eq!((point.status, again.status), (expected, expected), "{rotation:?}, axes {axes}");
            if expected != status::OK {
                assert_eq!((point.stress, point.state, again), ([0.0; 6], old, point));
                assert_eq!(tangent.0, [[0.0; 6]; 9]);
                for (found, given) in kept.iter().chain(&with_tangent).zip(axes.iter().chain(&axes)) {
                    assert_eq!(found.to_bits(), given.to_bits(), "the axes");
                }
            }
        }
    }
    // An element that has failed needs no axes.
    let mut failed = old;
    (failed[LINEAR_FAILED], failed[LINEAR_ALIVE]) = (1.0, 0.0);
    let mut none = Matrix3::zeros();
    let point = law.step(&f, &f, &failed, Rotation::Spin, Criterion::LargestPrincipal, &mut none);
    assert_eq!((point.status, point.stress), (status::OK, [0.0; 6]));
}

/// Increments of strain in a frame that does not turn are what F gives for a pure stretch.
#[test]
fn increments_of_a_pure_stretch() {
    let law = yarn(0.0);
    let stretches = |t: f64| Vector3::new((0.04 * t).exp(), (-0.5 * t * t).exp(), 1.0 + 0.3 * t);
    let steps = 50;
    let at = |i: usize| stretches(i as f64 / steps as f64);
    let mut state = START;
    for i in 0..steps {
        let (old, new) = (at(i), at(i + 1));
        let ln = new.component_div(&old).map(f64::ln);
        let jacobian = 0.5 * (old.product() + new.product());
        state = law.increment(&[ln.x, ln.y, ln.z, 0.0, 0.0, 0.0], jacobian, &state, Criterion::LargestPrincipal).state;
    }
    for rotation in FRAMES {
        let point = follow(&law, rotation, steps, |t| Matrix3::from_diagonal(&stretches(t)));
        assert_relative_eq!(point.state[..], state[..], epsilon = 1e-13 * E1);
    }
}

/// E1 = E2 = 2G: isotropic without a Poisson ratio, for which simple shear has closed forms.
fn isotropic() -> LinearElastic {
    LinearElastic::new(&[2.0, 2.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]).expect("valid properties")
}

fn simple_shear(gamma: f64) -> impl Fn(f64) -> Matrix3<f64> {
    move |t| Matrix3::new(1.0, gamma * t, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
}

/// The closed form [σ11, σ22, σ12], reached with an error that falls by four as the steps double.
fn assert_converges(rotation: Rotation, gamma: f64, expected: [f64; 3]) {
    let errors = [100, 200, 400].map(|steps| {
        let s = follow(&isotropic(), rotation, steps, simple_shear(gamma)).stress;
        [s[0] - expected[0], s[1] - expected[1], s[3] - expected[2]].into_iter().map(f64::abs).fold(0.0, f64::max)
    });
    assert!(errors[2] < 1e-4, "{rotation:?}, γ = {gamma}: {errors:?}");
    for pair in errors.windows(2) {
        assert_relative_eq!(pair[0] / pair[1], 4.0, epsilon = 0.1);
    }
}

/// Jaumann rate: the stress oscillates, σ12 = G sin γ, σ11 = −σ22 = G (1 − cos γ).
#[test]
fn simple_shear_under_the_spin() {
    for gamma in [0.5f64, 2.0, 5.0] {
        let normal = 1.0 - gamma.cos();
        assert_converges(Rotation::Spin, gamma, [normal, -normal, gamma.sin()]);
    }
}

/// Green–Naghdi rate (Dienes, Acta Mech. 32, 1979): with tan β = γ/2 and μ = G,
/// σ11 = 4μ (cos 2β ln cos β + β sin 2β − sin² β), σ12 = 2μ cos 2β (2β − 2 tan 2β ln cos β − tan β).
#[test]
fn simple_shear_in_the_polar_frame() {
    for gamma in [0.5f64, 2.5, 5.0] {
        let beta = (gamma / 2.0).atan();
        let (sine, cosine) = (2.0 * beta).sin_cos();
        let ln_cosine = beta.cos().ln();
        let normal = 4.0 * (cosine * ln_cosine + beta * sine - beta.sin().powi(2));
        let shear = 2.0 * (cosine * (2.0 * beta - beta.tan()) - 2.0 * sine * ln_cosine);
        assert_converges(Rotation::Polar, gamma, [normal, -normal, shear]);
    }
}

/// G ≠ E2/2: the answer to a transverse pure shear depends on the second axis, E2 ε across it and 2G ε at 45°.
#[test]
fn second_axis() {
    let strain = 1e-6; // small, so that the axes hardly turn
    let f = Matrix3::from_diagonal(&Vector3::new(1.0, f64::exp(strain), f64::exp(-strain)));
    for (angle, modulus) in [(0.0f64, E2), (FRAC_PI_2, E2), (FRAC_PI_4, 2.0 * G)] {
        // Any length, and any part along the fibre, are taken off the second axis.
        let law = LinearElastic::new(&[E1, E2, G, 0.0, 1.0, 0.0, 0.0, 3.0, 2.0 * angle.cos(), 2.0 * angle.sin()]);
        let law = law.expect("valid properties");
        let point = follow(&law, Rotation::Polar, 1, |t| if t > 0.0 { f } else { Matrix3::identity() });
        assert_relative_eq!(point.stress[1], modulus * strain, max_relative = 1e-9);
        assert_relative_eq!(point.stress[2], -modulus * strain, max_relative = 1e-9);
    }
    let law = LinearElastic::new(&[E1, E2, G, 0.0, 1.0, 2.0, -0.5, 0.0, 0.0, 0.0]).expect("valid properties");
    let axes = law.reference_axes();
    assert_relative_eq!(axes.transpose() * axes, Matrix3::identity(), epsilon = 1e-15);
    assert_relative_eq!(axes.determinant(), 1.0, epsilon = 1e-15);
    assert_relative_eq!(axes.column(0).into_owned(), Vector3::new(1.0, 2.0, -0.5).normalize(), epsilon = 1e-15);
}

/// Work per reference volume of a stretch along the fibre: ∫ E1 ln λ dλ = E1 (λ ln λ − λ + 1), by the trapezoidal rule.
#[test]
fn work_of_a_stretch() {
    let lambda: f64 = 1.3;
    let exact = E1 * (lambda * lambda.ln() - lambda + 1.0);
    let errors = [50, 100, 200].map(|steps| {
        let point = follow(&yarn(0.0), Rotation::Fibre, steps, |t| stretch(1.0 + t * (lambda - 1.0)));
        (point.state[LINEAR_WORK] / exact - 1.0).abs()
    });
    assert!(errors[2] < 1e-5, "{errors:?}");
    for pair in errors.windows(2) {
        assert_relative_eq!(pair[0] / pair[1], 4.0, epsilon = 0.05);
    }
    let there_and_back =
        follow(&yarn(0.0), Rotation::Fibre, 100, |t| stretch(1.0 + 0.3 * (1.0 - (2.0 * t - 1.0).abs())));
    assert!(there_and_back.state[LINEAR_WORK].abs() < 1e-12 * exact);
}

/// The fibre criterion looks along the fibre only: a stress across it that exceeds the limit does not fail the point.
#[test]
fn criterion() {
    let law = yarn(0.01);
    let across = |t: f64| Matrix3::from_diagonal(&Vector3::new(1.0, 1.0 + 0.05 * t, 1.0));
    let fails = |criterion, path: &dyn Fn(f64) -> Matrix3<f64>| {
        walk(&law, Rotation::Fibre, criterion, 1, path).state[LINEAR_FAILED] == 1.0
    };
    assert!(fails(Criterion::LargestPrincipal, &across));
    assert!(!fails(Criterion::FibreStress, &across));
    assert!(fails(Criterion::FibreStress, &|t| stretch(1.0 + 0.05 * t)));
    // Shear alone: no normal stress in the frame, a principal stress of G γ.
    let sheared = |criterion| law.increment(&[0.0, 0.0, 0.0, 0.05, 0.0, 0.0], 1.0, &START, criterion).state;
    assert_relative_eq!(sheared(Criterion::LargestPrincipal)[LINEAR_LARGEST], 0.1 * G, max_relative = 1e-15);
    assert_eq!(sheared(Criterion::LargestPrincipal)[LINEAR_FAILED], 1.0);
    assert_eq!(sheared(Criterion::FibreStress)[LINEAR_FAILED], 0.0);
}

/// The largest signed principal stress against an eigenvalue solver, repeated and widely spread values included.
#[test]
fn largest_principal_stress() {
    let law = LinearElastic::new(&[1.0, 1.0, 0.5, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]).expect("valid properties");
    let scattered = (rotation(), prop::array::uniform3(-1.0..1.0), -6..6i32);
    let spread =
        (rotation(), prop::sample::select(vec![[1.0, 1.0, 1.0], [1.0, 1.0, -2.0], [1e-8, 0.0, -1.0]]), 0..1i32);
    for (q, values, exponent) in samples(prop_oneof![scattered, spread], 5000) {
        let values = values.map(|x: f64| x * 10f64.powi(exponent));
        let stress = q * Matrix3::from_diagonal(&Vector3::from(values)) * q.transpose();
        let point = law.increment(&components(&stress), 1.0, &START, Criterion::LargestPrincipal);
        assert_eq!(point.stress, components(&stress), "stiffness 1 in every component");
        // The stress is rounded from these values; the solver's own error is a little larger.
        let made_of = values.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let solver = SymmetricEigen::new(stress).eigenvalues.max();
        let (largest, unit) = (point.state[LINEAR_LARGEST], f64::EPSILON * stress.norm());
        assert!((largest - made_of).abs() <= 8.0 * unit, "{largest:e} for {values:?}");
        assert!((largest - solver).abs() <= 16.0 * unit, "{largest:e} for {stress}");
    }
}

/// A step of some size from a stressed state, with the stress in the axes of the start.
fn strained(rotation: Rotation, law: &LinearElastic, f0: &Matrix3<f64>) -> ([f64; LINEAR_ELASTIC_STATE], Matrix3<f64>) {
    let mut axes = law.reference_axes();
    let rest = Matrix3::identity();
    let point = law.step(&rest, f0, &START, rotation, Criterion::LargestPrincipal, &mut axes);
    assert_eq!(point.status, status::OK);
    (point.state, axes)
}

/// The tangent against central differences of what the step does: every motion of the end of the step, and dP/dF.
#[test]
fn consistent_tangent() {
    let law = LinearElastic::new(&[E1, E2, G, 0.0, 1.0, 0.2, -0.3, 0.0, 1.0, 0.5]).expect("valid properties");
    let parts = prop::array::uniform9(-0.15..0.15);
    let mut worst = [[0.0_f64; 2]; 3];
    for (which, frame) in FRAMES.into_iter().enumerate() {
        for (a, b) in samples((parts.clone(), parts.clone()), 40) {
            let f0 = Matrix3::identity() + Matrix3::from_row_slice(&a);
            let f1 = (Matrix3::identity() + Matrix3::from_row_slice(&b)) * f0;
            let (state, axes) = strained(frame, &law, &f0);
            let stressed = |f: &Matrix3<f64>| {
                let point = law.step(&f0, f, &state, frame, Criterion::LargestPrincipal, &mut axes.clone());
                assert_eq!(point.status, status::OK);
                matrix(&point.stress)
            };
            let (point, tangent) =
                law.step_with_tangent(&f0, &f1, &state, frame, Criterion::LargestPrincipal, &mut axes.clone());
            assert_relative_eq!(matrix(&point.stress), stressed(&f1));
            let tau = |f: &Matrix3<f64>| stressed(f) * f.determinant();
            const STEP: f64 = 1e-5;
            let central = |tau: &dyn Fn(f64) -> Matrix3<f64>| (tau(STEP) - tau(-STEP)) / (2.0 * STEP);

            let nominal = tangent.nominal(&f1, &point.stress);
            for column in 0..9 {
                let mut l = Matrix3::zeros();
                l[column] = 1.0;
                let moved = central(&|h| tau(&((Matrix3::identity() + l * h) * f1))) / f1.determinant();
                let error = (matrix(&tangent.0[column]) - moved).norm() / E1;
                worst[which][0] = worst[which][0].max(error);
                let pulled = |f: Matrix3<f64>| tau(&f) * f.try_inverse().expect("an inverse").transpose();
                let moved = central(&|h| pulled(f1 + l * h));
                let error = (Matrix3::from_column_slice(&nominal[9 * column..9 * column + 9]) - moved).norm() / E1;
                worst[which][1] = worst[which][1].max(error);
            }
            // DDSDDE: a symmetric motion.
            let ddsdde = tangent.matrix(Measure::Jaumann, &f1, &point.stress).expect("six rows");
            let mut d = Matrix3::zeros();
            (d[(0, 1)], d[(1, 0)]) = (0.5, 0.5);
            let moved = components(&(central(&|h| tau(&((Matrix3::identity() + d * h) * f1))) / f1.determinant()));
            for (row, moved) in ddsdde.iter().zip(moved) {
                assert!((row[3] - moved).abs() <= 1e-7 * E1, "{frame:?}: {} instead of {moved}", row[3]);
            }
            let truesdell = tangent.matrix(Measure::Truesdell, &f1, &point.stress).expect("six rows");
            let material = tangent.matrix(Measure::Material, &f1, &point.stress).expect("six rows");
            let pushed = pulled_back(&material, &f1.try_inverse().expect("an inverse")).expect("an inverse");
            for (one, other) in truesdell.iter().flatten().zip(pushed.iter().flatten()) {
                assert!((one - other).abs() <= 1e-11 * E1);
            }
        }
    }
    println!("worst error of the tangent over E1 by motion and by F; frames {FRAMES:?}: {worst:?}");
    assert!(worst.iter().flatten().all(|&error| error <= 1e-7), "{worst:?}");
}

/// From rest, in an infinitesimal step, the tangent is C itself; a failed point has none, the call that detects failure
/// all.
#[test]
fn tangent_at_rest_and_at_failure() {
    let (law, rest) = (yarn(LIMIT), Matrix3::identity());
    for frame in FRAMES {
        let mut axes = law.reference_axes();
        let (point, tangent) =
            law.step_with_tangent(&rest, &rest, &START, frame, Criterion::LargestPrincipal, &mut axes);
        for measure in [Measure::Material, Measure::Truesdell, Measure::Jaumann] {
            let rows = tangent.matrix(measure, &rest, &point.stress).expect("six rows");
            for (i, row) in rows.iter().enumerate() {
                for (j, &entry) in row.iter().enumerate() {
                    let wanted = if i == j { [E1, E2, E2, G, G, G][i] } else { 0.0 };
                    assert_relative_eq!(entry, wanted, epsilon = 1e-15 * E1);
                }
            }
        }
        let pulled = Matrix3::from_diagonal(&Vector3::new(1.06, 1.0, 1.0));
        let (point, tangent) =
            law.step_with_tangent(&rest, &pulled, &START, frame, Criterion::LargestPrincipal, &mut axes);
        assert_eq!(point.state[LINEAR_FAILED], 1.0);
        assert!(tangent.0[0][0] > 0.5 * E1);
        let (again, tangent) =
            law.step_with_tangent(&pulled, &pulled, &point.state, frame, Criterion::LargestPrincipal, &mut axes);
        assert_eq!((again.status, tangent), (status::OK, LinearTangent::default()));
        let (bad, tangent) =
            law.step_with_tangent(&rest, &-rest, &START, frame, Criterion::LargestPrincipal, &mut axes);
        assert_eq!((bad.status, tangent), (status::INVERTED, LinearTangent::default()));
    }
}
