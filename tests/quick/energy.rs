//! The stress is the derivative of the energy: S = 2 ∂W/∂C, mode by mode, with W written from the thesis's invariants.
//!
//! W(C) stands in `law::thesis` as Eq. 4.9–4.15 print it. Here it is computed in 320 binary digits, where the
//! cancellations of acosh x and of I5/I4² − 1 do no harm, and differentiated by central differences of step 2^-80,
//! whose own error is far below a double's. The thesis's own stress, Eq. 4.14, is held against the same differences.

use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;
use toron::law::state::{ENERGIES, HYPERELASTIC_STATE, INVARIANTS};
use toron::law::status;
use toron::law::thesis::{Functions, Yarn, determinant};
use toron::{Hyperelastic, Properties, Request};
use toron_test_support::deformations::{Ranges, Sample, deformation, direction, samples};
use toron_test_support::exact::{Exact, exact, rounded};

/// The six components of the library: 11 22 33 12 23 31.
const COMPONENTS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)];

const NAMES: [&str; 4] = ["elongation", "compaction", "distortion", "longitudinal shear"];

#[derive(Clone, Copy, Debug)]
struct Stiffness {
    k_el: f64,
    k_tc: f64,
    p: f64,
    k_td: f64,
    k_ld: f64,
}

impl Stiffness {
    fn properties(&self, m: &Vector3<f64>) -> [f64; 11] {
        [self.k_el, self.k_tc, self.p, self.k_td, self.k_ld, 0.0, 0.0, 0.0, m.x, m.y, m.z]
    }
}

/// Stiffnesses of one size, so that no mode hides behind another.
fn stiffness() -> impl Strategy<Value = Stiffness> {
    let exponent = prop::sample::select(vec![1.2, 1.5, 2.0, 2.2, 3.0, 5.0]);
    (0.5..2.0, 0.5..2.0, exponent, 0.5..2.0, prop_oneof![Just(0.0), 0.5..2.0])
        .prop_map(|(k_el, k_tc, p, k_td, k_ld)| Stiffness { k_el, k_tc, p, k_td, k_ld })
}

/// The thesis's yarn with a fibre direction of unit length.
fn yarn(m: &Vector3<Exact>, k: &Stiffness) -> Yarn<Exact> {
    let [eps_lim, alpha, beta] = [0.0; 3].map(exact);
    let [k_el, k_tc, p, k_td, k_ld] = [k.k_el, k.k_tc, k.p, k.k_td, k.k_ld].map(exact);
    let fibre = m.clone().into();
    Yarn {
        properties: Properties { k_el, k_tc, p, k_td, k_ld, eps_lim, alpha, beta, fibre },
        functions: Functions {
            number: exact,
            sqrt: |x| x.sqrt(),
            ln: |x| x.ln(),
            acosh: |x| x.acosh(),
            power: |x, p| x.powf(&p),
        },
    }
}

/// S_el, S_tc, S_td, S_ld = 2 ∂W/∂C. A change of C12 is one of C21 too, hence the factor of the shears.
fn second_piola_kirchhoff(c: &Matrix3<Exact>, yarn: &Yarn<Exact>) -> [[Exact; 6]; 4] {
    let step = exact(1.0) >> 80;
    let slopes = COMPONENTS.map(|(i, j)| {
        let moved = |h: &Exact| {
            let mut c = c.clone();
            c[(i, j)] += h;
            if i != j {
                c[(j, i)] += h;
            }
            yarn.energies(yarn.modes(&c))
        };
        let (ahead, behind) = (moved(&step), moved(&-step.clone()));
        let factor = if i == j { exact(2.0) } else { exact(1.0) };
        let mut mode = 0;
        ahead.map(|ahead| {
            let slope = &factor * (ahead - &behind[mode]) / (exact(2.0) * &step);
            mode += 1;
            slope
        })
    });
    std::array::from_fn(|mode| std::array::from_fn(|component| slopes[component][mode].clone()))
}

/// The Cauchy stress of a second Piola–Kirchhoff stress, F S Fᵀ/J.
fn cauchy(second: &[Exact; 6], f: &Matrix3<Exact>) -> [f64; 6] {
    let s = Matrix3::from_fn(|i, j| {
        let k = COMPONENTS.iter().position(|&(a, b)| (a, b) == (i, j) || (b, a) == (i, j)).expect("a component");
        second[k].clone()
    });
    let sigma = f * s * f.transpose();
    let jacobian = determinant(f);
    COMPONENTS.map(|(i, j)| rounded(&(&sigma[(i, j)] / &jacobian)))
}

fn norm(v: &[f64; 6]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The library's energies, modes and Cauchy stress against the differentiated energy; the worst relative errors.
fn check(f: &Matrix3<f64>, direction: &Vector3<f64>, k: &Stiffness, tolerance: f64) -> [f64; 3] {
    let law = Hyperelastic::<f64>::new(&k.properties(direction)).expect("valid properties");
    let point = law.point(f, &[0.0; HYPERELASTIC_STATE], Request::ALL);
    assert_eq!(point.status, status::OK);

    let m = direction.map(exact);
    let m = &m / m.dot(&m).sqrt();
    let f = f.map(exact);
    let c = f.transpose() * &f;
    let yarn = yarn(&m, k);
    let truth = second_piola_kirchhoff(&c, &yarn);
    let stiffness = k.k_el + k.k_tc * k.p * k.p + k.k_td + k.k_ld;

    let scale = |x: f64| x.max(1e-3 * stiffness);
    let mut worst = [0.0; 3];
    let mut note = |which: usize, what: &str, error: f64| {
        assert!(error <= tolerance, "{what}: {error:e} for {k:?}, F = {f:?}");
        worst[which] = f64::max(worst[which], error);
    };
    let (energies, stresses) = (yarn.energies(yarn.modes(&c)), yarn.stresses(&c, yarn.modes(&c)));
    for mode in 0..4 {
        let energy = rounded(&energies[mode]);
        let error = (point.state[ENERGIES..INVARIANTS][mode] - energy).abs();
        note(0, NAMES[mode], error / scale(energy));
        let exact_mode = truth[mode].each_ref().map(rounded);
        let error = norm(&std::array::from_fn(|i| point.modes[mode][i] - exact_mode[i]));
        note(1, NAMES[mode], error / scale(norm(&exact_mode)));
        let printed = &stresses[mode];
        let error = norm(&std::array::from_fn(|i| rounded(&(&printed[COMPONENTS[i]] - &truth[mode][i]))));
        // Where the section is undistorted Eq. 4.14 is 0/0.
        let is_defined = mode != 2 || yarn.modes(&c)[2] > exact(1e-30);
        assert!(!is_defined || error <= 1e-20 * scale(norm(&exact_mode)), "{} as printed: {error:e}", NAMES[mode]);
    }
    let sum: [Exact; 6] = std::array::from_fn(|i| &truth[0][i] + &truth[1][i] + &truth[2][i] + &truth[3][i]);
    let sigma = cauchy(&sum, &f);
    let error = norm(&std::array::from_fn(|i| point.stress[i] - sigma[i]));
    note(2, "Cauchy stress", error / scale(norm(&sigma)));
    worst
}

/// Every mode at work or at rest, but none within 0.001 of its kink, where p < 2 magnifies roundings without bound.
#[test]
fn stress_is_the_derivative_of_the_energy() {
    let part = |low: f64, high: f64| prop_oneof![Just(low..-1e-3), Just(1e-3..high)];
    let ranges = (part(-0.3, 0.3), part(-0.5, 0.3));
    let states =
        ranges.prop_flat_map(|(i_el, i_tc)| deformation(Ranges { i_el, i_tc, i_td: 0.0..0.6, i_ld: 0.0..0.5 }));
    let mut worst = [0.0f64; 3];
    for (Sample { f, m, .. }, length, k) in samples((states, 0.1..10.0, stiffness()), 150) {
        let errors = check(&f, &(m * length), &k, 1e-13);
        worst = std::array::from_fn(|i| worst[i].max(errors[i]));
    }
    println!("worst relative errors of energies, modes, Cauchy stress: {:?}", worst.map(|x| format!("{x:.1e}")));
}

/// Any F and any m, unrelated to each other.
#[test]
fn stress_is_the_derivative_of_the_energy_for_any_gradient() {
    let entries = prop::array::uniform9(-0.4..0.4);
    let mut count = 0;
    for (h, m, k) in samples((entries, direction(), stiffness()), 120) {
        let f = Matrix3::identity() + Matrix3::from_row_slice(&h);
        if f.determinant() > 0.1 {
            check(&f, &m, &k, 1e-12);
            count += 1;
        }
    }
    assert!(count > 100, "{count} usable gradients");
}

/// At the kinks themselves and where the section is undistorted, Eq. 4.14 is 0/0 but the energy has its derivative.
#[test]
fn stress_is_the_derivative_of_the_energy_at_the_kinks() {
    let diagonal = |a: f64, b: f64, c: f64| Matrix3::from_diagonal(&Vector3::new(a, b, c));
    let states = [
        diagonal(1.0, 1.0, 1.0),
        diagonal(1.0, 0.5, 0.5),  // I_el = 0, s = 0
        diagonal(1.0, 0.5, 2.0),  // I_el = 0, I_tc = 0
        diagonal(1.25, 0.5, 2.0), // I_tc = 0
        diagonal(1.25, 0.5, 0.5), // s = 0
        diagonal(0.5, 2.0, 2.0),  // s = 0
    ];
    for p in [2.0, 2.2, 3.0, 5.0] {
        let k = Stiffness { k_el: 1.0, k_tc: 1.0, p, k_td: 1.0, k_ld: 1.0 };
        for f in &states {
            check(f, &Vector3::x(), &k, 1e-15);
        }
    }
}
