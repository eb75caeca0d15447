//! A metal by von Mises as a law of one's own, `examples/own_law`: in a UMAT and in blocks of points, against the same
//! law by eigenvectors and bisection, and against a closed form.

use std::ptr::null_mut;

use fastrand::Rng;
use nalgebra::{Matrix3, SymmetricEigen, Vector3};
use reinforced_solid::plastic::PlasticSolid;
use toron::host::abaqus::{self, StandardLaw};
use toron::law::block::{Circumstances, Points, Precision, components, components_mut};
use toron::law::interface::Law;
use toron::status;
use toron::user::User;

const BULK: f64 = 160_000.0;
const SHEAR: f64 = 80_000.0;
const FIRST: f64 = 300.0;
const SATURATION: f64 = 700.0;
const RATE: f64 = 17.0;
const HARDENING: f64 = 130.0;
const VALUES: [f64; 6] = [BULK, SHEAR, FIRST, SATURATION, RATE, HARDENING];
const STATE: usize = 11;

fn yield_stress(plastic: f64) -> f64 {
    FIRST + (SATURATION - FIRST) * -(-RATE * plastic).exp_m1() + HARDENING * plastic
}

/// The root of a function that falls, between these.
fn root(low: f64, high: f64, function: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (low, high);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if function(middle) > 0.0 { low = middle } else { high = middle }
    }
    low
}

/// The law by eigenvectors: the inverse plastic metric and the plastic strain.
#[derive(Clone)]
struct Metal {
    metric: Matrix3<f64>,
    plastic: f64,
    stored: f64,
    lost: f64,
}

impl Metal {
    fn new() -> Metal {
        Metal { metric: Matrix3::identity(), plastic: 0.0, stored: 0.0, lost: 0.0 }
    }

    /// The Kirchhoff stress at the end of a step to F.
    fn step(&mut self, f: &Matrix3<f64>) -> Matrix3<f64> {
        let b = f * self.metric * f.transpose();
        let SymmetricEigen { eigenvectors, eigenvalues } = (0.5 * (b + b.transpose())).symmetric_eigen();
        let strain = eigenvalues.map(|value| 0.5 * value.ln());
        let volume = f.determinant().ln();
        let mut shape = strain - Vector3::from_element(strain.mean());
        let q = 6.0_f64.sqrt() * SHEAR * shape.norm();
        if q > yield_stress(self.plastic) {
            let x = root(0.0, q / (3.0 * SHEAR), |x| q - 3.0 * SHEAR * x - yield_stress(self.plastic + x));
            shape *= 1.0 - 3.0 * SHEAR * x / q;
            self.plastic += x;
            self.lost += FIRST * x;
            let elastic = shape.map(|e| (2.0 * e + 2.0 / 3.0 * volume).exp());
            let b = eigenvectors * Matrix3::from_diagonal(&elastic) * eigenvectors.transpose();
            let back = f.try_inverse().expect("invertible");
            self.metric = back * b * back.transpose();
        }
        let gone = -(-RATE * self.plastic).exp_m1() / RATE;
        let grown = (SATURATION - FIRST) * (self.plastic - gone) + 0.5 * HARDENING * self.plastic.powi(2);
        self.stored = 0.5 * BULK * volume * volume + SHEAR * shape.norm_squared() + grown;
        let principal = shape.map(|e| 2.0 * SHEAR * e + BULK * volume);
        eigenvectors * Matrix3::from_diagonal(&principal) * eigenvectors.transpose()
    }
}

/// A path that shears, turns and stretches, so that the directions of the flow change all the time.
fn path(steps: usize, phase: f64) -> Vec<Matrix3<f64>> {
    let at = |number: usize| {
        let t = (number + 1) as f64 / steps as f64;
        let shear = Matrix3::new(
            1.0,
            0.4 * t,
            0.1 * ((5.0 * t + phase).sin() - phase.sin()),
            0.0,
            1.0,
            0.2 * t * t,
            0.0,
            0.0,
            1.0,
        );
        let stretch =
            Matrix3::from_diagonal(&Vector3::new(1.0 + 0.1 * t, 1.0 - 0.05 * (3.0 * t).sin(), 1.0 - 0.04 * t));
        nalgebra::Rotation3::from_euler_angles(0.3 * t, phase * t, 1.1 * t).into_inner() * shear * stretch
    };
    (0..steps).map(at).collect()
}

/// Stress 11 22 33 12 23 31 as Rust has it.
fn components_of(a: &Matrix3<f64>) -> [f64; 6] {
    [a[(0, 0)], a[(1, 1)], a[(2, 2)], a[(0, 1)], a[(1, 2)], a[(2, 0)]]
}

/// Stress 11 22 33 12 13 23 and DDSDDE of a UMAT's step.
fn umat(f: &Matrix3<f64>, statev: &mut [f64; STATE]) -> ([f64; 6], [f64; 36], f64) {
    let (mut stress, mut ddsdde, mut sse, mut pnewdt, mut temperature) = ([0.0; 6], [0.0; 36], 0.0, 1.0, 0.0);
    let (time, dtime, temp, dtemp) = ([0.0; 2], 0.1, 0.0, 0.0);
    let call = abaqus::Umat {
        stress: stress.as_mut_ptr(),
        statev: statev.as_mut_ptr(),
        ddsdde: ddsdde.as_mut_ptr(),
        sse: &mut sse,
        pnewdt: &mut pnewdt,
        dfgrd0: f.as_ptr(),
        dfgrd1: f.as_ptr(),
        props: VALUES.as_ptr(),
        nprops: 6,
        nstatv: STATE as i32,
        ndi: 3,
        nshr: 3,
        nlgeom: 1,
        // SAFETY: as many values as Abaqus passes.
        circumstances: unsafe { abaqus::circumstances(time.as_ptr(), &dtime, &temp, &dtemp, &mut temperature) },
    };
    // SAFETY: arrays as long as the call says.
    assert_eq!(unsafe { User::<PlasticSolid, f64>::umat(&call, null_mut(), 0) }, 0);
    (stress, ddsdde, sse)
}

#[test]
fn a_umat_is_the_law_by_eigenvectors() {
    let (mut metal, mut statev, mut worst, mut worst_tangent) = (Metal::new(), [0.0; STATE], 0.0_f64, 0.0_f64);
    for f in path(40, 0.7) {
        let (old, before) = (statev, metal.clone());
        let (stress, ddsdde, sse) = umat(&f, &mut statev);
        let j = f.determinant();
        let exact = components_of(&(metal.step(&f) / j));
        let [s_11, s_22, s_33, s_12, s_23, s_31] = exact;
        let off = |found: f64, exact: f64| (found - exact).abs() / BULK;
        for (found, exact) in stress.into_iter().zip([s_11, s_22, s_33, s_12, s_31, s_23]) {
            worst = worst.max(off(found, exact));
        }
        assert!((statev[2] - metal.plastic).abs() < 2e-13 && (statev[1] - metal.lost).abs() < 1e-10, "{statev:?}");
        assert!((sse * j - metal.stored).abs() < 1e-9 * (1.0 + metal.stored), "{sse} {}", metal.stored);
        assert!(old != statev || metal.plastic == 0.0);
        // DDSDDE D = the rate of τ over J in a stretching D, by differences.
        for (column, (i, k)) in [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].into_iter().enumerate() {
            let mut d = Matrix3::zeros();
            d[(i, k)] += 0.5;
            d[(k, i)] += 0.5;
            let h = 1e-6;
            let at = |s: f64| before.clone().step(&((s * h * d).exp() * f));
            let rate = (at(1.0) - at(-1.0)) / (2.0 * h * j);
            let [r_11, r_22, r_33, r_12, r_23, r_31] = components_of(&rate);
            for (row, exact) in [r_11, r_22, r_33, r_12, r_31, r_23].into_iter().enumerate() {
                worst_tangent = worst_tangent.max(off(ddsdde[6 * column + row], exact));
            }
        }
    }
    assert!(metal.plastic > 0.2, "it flows: {}", metal.plastic);
    assert!(worst < 4e-15, "stress off by {worst:e} of K");
    assert!(worst_tangent < 2e-8, "DDSDDE off by {worst_tangent:e} of K");
}

/// A block of points with paths of their own, in a precision: the stress and the plastic strain at the end.
fn block<T: Precision + Default>(steps: usize, n: usize) -> Vec<([f64; 6], f64)> {
    let law = User::<PlasticSolid, T>::new(&VALUES.map(T::splat)).expect("a metal");
    let (mut state, mut stress) = (vec![T::default(); STATE * n], vec![T::default(); 6 * n]);
    let (mut f, mut statuses) = (vec![T::default(); 9 * n], vec![0; n]);
    let paths: Vec<_> = (0..n).map(|point| path(steps, 0.1 * point as f64)).collect();
    for number in 0..steps {
        for (point, path) in paths.iter().enumerate() {
            for (c, &entry) in path[number].as_slice().iter().enumerate() {
                f[c * n + point] = T::splat(entry);
            }
        }
        let points = Points {
            f_new: components(f.as_ptr(), n),
            circumstances: Circumstances::UNKNOWN,
            state_old: User::<PlasticSolid, T>::parts(state.as_ptr(), n),
            state_new: User::<PlasticSolid, T>::parts_mut(state.as_mut_ptr(), n),
            stress: components_mut(stress.as_mut_ptr(), n),
            status: statuses.as_mut_ptr(),
            ..Points::without_arrays(n, n)
        };
        // SAFETY: each array has its components of n numbers.
        assert_eq!(unsafe { law.step(&points) }.expect("a call"), status::OK);
    }
    let value = |array: &[T], c: usize, point: usize| -> f64 { array[c * n + point].into() };
    (0..n).map(|point| (std::array::from_fn(|c| value(&stress, c, point)), value(&state, 2, point))).collect()
}

#[test]
fn blocks_are_the_law_by_eigenvectors_in_both_precisions() {
    let (n, steps) = (37, 25);
    for (found, allowed) in [(block::<f64>(steps, n), 4e-15), (block::<f32>(steps, n), 3e-6)] {
        for (point, (stress, plastic)) in found.into_iter().enumerate() {
            let (mut metal, mut exact) = (Metal::new(), [0.0; 6]);
            for f in path(steps, 0.1 * point as f64) {
                exact = components_of(&(metal.step(&f) / f.determinant()));
            }
            for (found, exact) in stress.into_iter().zip(exact) {
                assert!((found - exact).abs() < allowed * BULK, "point {point}: {found} {exact}");
            }
            assert!((plastic - metal.plastic).abs() < 10.0 * allowed, "point {point}: {plastic} {}", metal.plastic);
        }
    }
}

/// Stretched along its axes with its volume, ε = ln λ: q = 3G (ε − α) = y(α) in any number of steps, τ_11 = ⅔ q.
#[test]
fn a_bar_that_keeps_its_volume_is_the_closed_form() {
    for steps in [1, 3, 50] {
        let mut statev = [0.0; STATE];
        for number in 1..=steps {
            let strain = 0.3 * number as f64 / steps as f64;
            let across = (-0.5 * strain).exp();
            let f = Matrix3::from_diagonal(&Vector3::new(strain.exp(), across, across));
            let (stress, ..) = umat(&f, &mut statev);
            let plastic = root(0.0, strain, |x| 3.0 * SHEAR * (strain - x) - yield_stress(x));
            let q = yield_stress(plastic);
            let near = |found: f64, exact: f64| assert!((found - exact).abs() < 2e-10, "{strain}: {found} {exact}");
            near(stress[0], 2.0 / 3.0 * q);
            near(stress[1], -q / 3.0);
            assert!((statev[2] - plastic).abs() < 2e-13, "{statev:?} {plastic}");
        }
    }
}

/// What the stress does is stored or lost, but for an error that falls with the step.
#[test]
fn work_is_stored_or_lost() {
    let miss = |steps: usize| {
        let (mut statev, mut work) = ([0.0; STATE], 0.0);
        let (mut old, mut nominal) = (Matrix3::identity(), Matrix3::zeros());
        for f in path(steps, 0.7) {
            let ([a, b, c, d, e, g], ..) = umat(&f, &mut statev);
            let sigma = Matrix3::new(a, d, e, d, b, g, e, g, c);
            let new = f.determinant() * sigma * f.try_inverse().expect("invertible").transpose();
            work += 0.5 * (nominal + new).dot(&(f - old));
            (old, nominal) = (f, new);
        }
        let [stored, lost, ..] = statev;
        assert!(lost > 60.0 && stored > 10.0, "{stored} {lost}");
        (work - stored - lost) / work
    };
    for (steps, most) in [(20, 2e-2), (160, 2e-4), (2560, 3e-6)] {
        let miss = miss(steps);
        assert!(miss.abs() < most, "{steps}: {miss:e}");
    }
}

#[test]
fn metals_of_all_kinds_return_to_their_yield_stress() {
    let mut rng = Rng::with_seed(8);
    for _ in 0..20_000 {
        let mut power = |low: f64, high: f64| 10_f64.powf(low + (high - low) * rng.f64());
        let (shear, first) = (power(2.0, 6.0), power(0.0, 3.0));
        let values = [2.0 * shear, shear, first, first * (1.0 + power(-2.0, 2.0)), power(-1.0, 3.0), power(-1.0, 4.0)];
        let law = User::<PlasticSolid, f64>::new(&values).expect("a metal");
        let (f, mut state, mut stress, mut code) = (path(1, rng.f64())[0], [0.0; STATE], [0.0; 6], [0]);
        let points = Points {
            f_new: components(f.as_slice().as_ptr(), 1),
            state_old: User::<PlasticSolid, f64>::parts(state.as_ptr(), 1),
            state_new: User::<PlasticSolid, f64>::parts_mut(state.as_mut_ptr(), 1),
            stress: components_mut(stress.as_mut_ptr(), 1),
            status: code.as_mut_ptr(),
            ..Points::without_arrays(1, 1)
        };
        // SAFETY: each array has its components.
        assert_eq!(unsafe { law.step(&points) }.expect("a call"), status::OK, "{values:?}");
    }
    let wrong = User::<PlasticSolid, f64>::new(&[1.0, 1.0, 3.0, 2.0, 0.0, 0.0]).expect_err("it softens");
    assert_eq!(wrong.to_string(), "argument saturation is 2.0; allowed: a number from the first yield stress on");
}
