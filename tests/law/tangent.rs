//! The tangents of the hyperelastic law: against the truth table, against dual numbers through the law's own generic
//! code, against central differences as each host would perturb, and what is said of kinks, failure and bad points.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Matrix6, SMatrix, Vector3, Vector6};
use proptest::prelude::*;
use toron::Measure;
use toron::Real;
use toron::law::state::{FAILED, HYPERELASTIC_STATE};
use toron::law::status;
use toron::law::stress::{components, first_piola_kirchhoff, matrix, pulled_back, truesdell_of_jaumann};
use toron::law::voigt::PAIRS;
use toron::user::Dual;
use toron::{Arrays, Level};
use toron::{Hyperelastic, Point, Request};
use toron_test_support::block::Number;
use toron_test_support::deformations::{Ranges, Sample, deformation, samples};
use toron_test_support::truth::cases;

const FRESH: [f64; HYPERELASTIC_STATE] = [0.0; HYPERELASTIC_STATE];
const SIX: [Measure; 3] = [Measure::Material, Measure::Truesdell, Measure::Jaumann];

type Nominal = SMatrix<f64, 9, 9>;

#[derive(Clone, Copy, Debug)]
struct Stiffness {
    k_el: f64,
    k_tc: f64,
    p: f64,
    k_td: f64,
    k_ld: f64,
}

impl Stiffness {
    fn law<T: Real + Into<f64>>(&self, m: &Vector3<f64>) -> Hyperelastic<T> {
        let Stiffness { k_el, k_tc, p, k_td, k_ld } = *self;
        let properties = [k_el, k_tc, p, k_td, k_ld, 0.0, 0.0, 0.0, m.x, m.y, m.z];
        Hyperelastic::new(&properties.map(T::splat)).expect("valid properties")
    }
}

fn stiffness() -> impl Strategy<Value = Stiffness> {
    let exponent = prop::sample::select(vec![1.2, 1.5, 2.0, 2.2, 3.0, 5.0]);
    (0.5..2.0, 0.5..2.0, exponent, 0.5..2.0, prop_oneof![Just(0.0), 0.5..2.0])
        .prop_map(|(k_el, k_tc, p, k_td, k_ld)| Stiffness { k_el, k_tc, p, k_td, k_ld })
}

fn states() -> impl Strategy<Value = Sample> {
    let calm = Ranges { i_el: -0.05..0.05, i_tc: -0.2..0.1, i_td: 0.0..0.1, i_ld: 0.0..0.2 };
    let wild = Ranges { i_el: -0.5..0.5, i_tc: -1.2..0.5, i_td: 0.0..1.2, i_ld: 0.0..1.2 };
    prop_oneof![deformation(calm), deformation(wild)]
}

fn preset() -> Hyperelastic<f64> {
    Hyperelastic::new(&[82341.0, 1055.0, 2.2, 649.74, 100.0, 0.0458, 1.8, 0.0, 0.6, 0.0, 0.8])
        .expect("valid properties")
}

fn six(law: &Hyperelastic<f64>, f: &Matrix3<f64>, measure: Measure) -> Matrix6<f64> {
    let (point, rows) = law.tangent(f, measure);
    assert_eq!(point.status, status::OK);
    Matrix6::from_fn(|i, j| rows[i][j])
}

fn nine(law: &Hyperelastic<f64>, f: &Matrix3<f64>) -> Nominal {
    let (point, entries) = law.point_with_nominal(&f.data.0, None, &FRESH, Request::ALL);
    assert_eq!(point.status, status::OK);
    Nominal::from_column_slice(&entries)
}

/// Six components of a tensor with engineering shears.
fn strain(d: &Matrix3<f64>) -> Vector6<f64> {
    Vector6::from_fn(|c, _| d[PAIRS[c]] + if c < 3 { 0.0 } else { d[PAIRS[c]] })
}

fn six_of(s: &Matrix3<f64>) -> Vector6<f64> {
    Vector6::from(components(s))
}

// ---------------------------------------------------------------------------------------------------------------------
// The truth

/// What one ulp of an entry of F does to DDSDDE, at most, relative to it.
fn sensitivity(law: &Hyperelastic<f64>, f: &Matrix3<f64>) -> f64 {
    let here = six(law, f, Measure::Jaumann);
    let mut worst = 0.0_f64;
    for entry in 0..9 {
        for towards in [f64::next_up, f64::next_down] {
            let mut moved = *f;
            moved[entry] = towards(moved[entry]);
            worst = worst.max((six(law, &moved, Measure::Jaumann) - here).norm() / here.norm());
        }
    }
    worst
}

#[test]
fn truth() {
    let mut worst = BTreeMap::<_, (f64, f64)>::new();
    for case in cases() {
        let law = Hyperelastic::<f64>::new(&case.properties()).expect("valid properties");
        let f = case.deformation_gradient();
        let (point, tangent) = law.tangent(&f, Measure::Jaumann);
        assert_eq!(point.status, status::OK, "case {}", case.id);
        let Some(error) = case.tangent_error(&tangent) else { continue };
        let allowed = sensitivity(&law, &f);
        // An error no larger than what the input's own rounding does, or small.
        assert!(error <= 1e-12 + 4.0 * allowed, "case {}: {error:e}, an ulp of F does {allowed:e}", case.id);
        let worst = worst.entry(case.category).or_default();
        *worst = (worst.0.max(error), worst.1.max(allowed));
    }
    println!("{:<20}{:>12}{:>16}", "category", "error", "an ulp of F");
    for (category, (error, allowed)) in worst {
        println!("{category:<20}{error:>12.1e}{allowed:>16.1e}");
        // At the kinks of `distortion` an ulp of F decides: the bound of each case above.
        if category != "distortion" {
            assert!(error <= 1e-12, "{category}: {error:e}");
        }
    }
}

// ---------------------------------------------------------------------------------------------------------------------
// Dual numbers

/// Cauchy and second Piola–Kirchhoff stress of F + ε dF.
fn dual_stresses(law: &Hyperelastic<Dual<f64>>, f: &Matrix3<f64>, df: &Matrix3<f64>) -> [[Dual<f64>; 6]; 2] {
    let columns = std::array::from_fn(|j| std::array::from_fn(|i| Dual::new(f[(i, j)], df[(i, j)])));
    let point = law.point_along(&columns, None, &FRESH.map(Dual::splat), Request::ALL);
    assert_eq!(point.status, status::OK);
    let modes = point.modes;
    [point.stress, std::array::from_fn(|c| modes[0][c] + modes[1][c] + modes[2][c] + modes[3][c])]
}

fn slopes(s: &[Dual<f64>; 6]) -> Vector6<f64> {
    Vector6::from_fn(|c, _| s[c].slope)
}

#[test]
fn dual_numbers() {
    let mut worst = [0.0_f64; 4];
    let parts = prop::array::uniform9(-1.0..1.0);
    for (Sample { f, m, invariants }, k, h) in samples((states(), stiffness(), parts), 2000) {
        // Near a kink of p < 3 the stiffness magnifies what rounding F does.
        if invariants[0].abs() < 1e-4 || invariants[1].abs() < 1e-2 {
            continue;
        }
        let (law, dual) = (k.law(&m), k.law(&m));
        let l = Matrix3::<f64>::from_row_slice(&h);
        let d = (l + l.transpose()) * 0.5;
        let inverse = f.try_inverse().expect("an inverse");
        let stress = matrix(&law.point(&f, &FRESH, Request::ALL).stress);

        // Jaumann: a motion without spin. Truesdell: what is left of it without the stress.
        let moved = slopes(&dual_stresses(&dual, &f, &(d * f))[0]);
        let jaumann = moved + six_of(&stress) * d.trace();
        let truesdell = jaumann - six_of(&(d * stress + stress * d));
        // dS/dE: a change of E alone; dP/dF: any.
        let material = slopes(&dual_stresses(&dual, &f, &(inverse.transpose() * d))[1]);
        let second = dual_stresses(&dual, &f, &l)[1];
        let nominal = l * matrix(&second.map(|s| s.value)) + f * matrix(&second.map(|s| s.slope));

        let six = |measure| six(&law, &f, measure);
        let nominal_tangent = nine(&law, &f);
        let errors = [
            (six(Measure::Jaumann) * strain(&d) - jaumann).norm() / six(Measure::Jaumann).norm(),
            (six(Measure::Truesdell) * strain(&d) - truesdell).norm() / six(Measure::Jaumann).norm(),
            (six(Measure::Material) * strain(&d) - material).norm() / six(Measure::Material).norm(),
            (nominal_tangent * SMatrix::<f64, 9, 1>::from_column_slice(l.as_slice())
                - SMatrix::<f64, 9, 1>::from_column_slice(nominal.as_slice()))
            .norm()
                / nominal_tangent.norm(),
        ];
        for (worst, error) in worst.iter_mut().zip(errors) {
            *worst = worst.max(error);
        }
    }
    println!("worst errors, Jaumann, Truesdell, material, nominal: {worst:?}");
    // Several hundred roundings, by both ways, of states sheared and flattened at random.
    assert!(worst.iter().all(|&error| error <= 3e-13), "{worst:?}");
}

// ---------------------------------------------------------------------------------------------------------------------
// Central differences, as each host perturbs

/// What a host differentiates: the change of its stress for a change of size h of its strain, and what the tangent
/// says.
type Difference<'a> = (&'a str, Box<dyn Fn(f64) -> Matrix3<f64> + 'a>, Matrix3<f64>);

#[test]
fn central_differences() {
    let law = preset();
    let spread = Ranges { i_el: 0.02..0.03, i_tc: -0.3..-0.2, i_td: 0.2..0.3, i_ld: 0.2..0.3 };
    let Sample { f, m: fibre, .. } = samples(deformation(spread), 1).next().expect("one");
    // The sample's fibre is not the law's: bring it there.
    let to = nalgebra::Rotation3::rotation_between(&Vector3::new(0.6, 0.0, 0.8), &fibre).expect("not opposite");
    let f = f * to.matrix();
    let l = Matrix3::new(0.3, -0.5, 0.2, 0.7, 0.1, -0.4, -0.2, 0.6, -0.8);
    let d = (l + l.transpose()) * 0.5;
    let spin = (l - l.transpose()) * 0.5;
    let one = Matrix3::identity();
    let tau = |f: &Matrix3<f64>| matrix(&law.point(f, &FRESH, Request::ALL).stress) * f.determinant();
    let second = |f: &Matrix3<f64>| {
        let modes = law.point(f, &FRESH, Request::ALL).modes;
        modes.iter().map(matrix).sum::<Matrix3<f64>>()
    };
    let jacobian = f.determinant();
    let here = tau(&f);
    let six = |measure: Measure, d: &Matrix3<f64>| {
        let c = six(&law, &f, measure) * strain(d);
        matrix(&c.into())
    };
    let right = f.transpose() * f;
    let differences: [Difference; 5] = [
        ("DDSDDE, no spin", Box::new(|h| tau(&((one + d * h) * f)) / jacobian), six(Measure::Jaumann, &d)),
        (
            "DDSDDE, with spin",
            Box::new(|h| (tau(&((one + l * h) * f)) - (spin * here - here * spin) * h) / jacobian),
            six(Measure::Jaumann, &d),
        ),
        (
            "utan",
            Box::new(|h| (tau(&((one + l * h) * f)) - (l * here + here * l.transpose()) * h) / jacobian),
            six(Measure::Truesdell, &d),
        ),
        (
            "dS/dE",
            Box::new(|h| {
                let c: Matrix3<f64> = right + d * (2.0 * h);
                second(&c.cholesky().expect("positive").l().transpose())
            }),
            six(Measure::Material, &d),
        ),
        (
            "dP/dF",
            Box::new(|h| {
                let moved = f + l * h;
                first_piola_kirchhoff(&law.point(&moved, &FRESH, Request::ALL).stress, &moved)
            }),
            Matrix3::from_column_slice(
                (nine(&law, &f)
                    * nalgebra::Vector::from_column_slice_generic(
                        nalgebra::Const::<9>,
                        nalgebra::Const::<1>,
                        l.as_slice(),
                    ))
                .as_slice(),
            ),
        ),
    ];
    println!(
        "relative error of a central difference of step h\n{:>8}{}",
        "h",
        differences.iter().map(|x| format!("{:>20}", x.0)).collect::<String>()
    );
    let mut best = [f64::INFINITY; 5];
    for exponent in 1..=12 {
        let h = 0.1_f64.powi(exponent);
        print!("{h:>8.0e}");
        for (best, (_, stress, tangent)) in best.iter_mut().zip(&differences) {
            let error = ((stress(h) - stress(-h)) / (2.0 * h) - tangent).norm() / tangent.norm();
            print!("{error:>20.1e}");
            *best = best.min(error);
        }
        println!();
    }
    // Rounding over h meets h²: about ε^(2/3) at best.
    assert!(best.iter().all(|&error| error < 1e-9), "{best:?}");
}

// ---------------------------------------------------------------------------------------------------------------------
// Form

#[test]
fn symmetric_and_consistent() {
    for (Sample { f, m, .. }, k) in samples((states(), stiffness()), 500) {
        let law = k.law(&m);
        for measure in SIX {
            let c = six(&law, &f, measure);
            assert_eq!(c, c.transpose());
        }
        let a = nine(&law, &f);
        assert_eq!(a, a.transpose());

        let (point, jaumann) = law.tangent(&f, Measure::Jaumann);
        let truesdell = truesdell_of_jaumann(&jaumann, &point.stress);
        let rows = |c: [[f64; 6]; 6]| Matrix6::from_fn(|i, j| c[i][j]);
        let scale = rows(jaumann).norm();
        assert!((rows(truesdell) - six(&law, &f, Measure::Truesdell)).norm() <= 1e-14 * scale);
        let material = six(&law, &f, Measure::Material);
        let pulled = rows(pulled_back(&truesdell, &f).expect("an inverse"));
        let inverse = f.try_inverse().expect("an inverse").norm();
        let magnified = scale * f.determinant() * inverse.powi(4);
        assert!((pulled - material).norm() <= 1e-13 * magnified, "{:e}", (pulled - material).norm() / magnified);

        // The columns of the material measure, by another fibre frame: the direction alone counts.
        let fibre = [2.0 * m.x, 2.0 * m.y, 2.0 * m.z];
        let (_, along) = law.point_with_moduli(&f.data.0, Some(fibre), &FRESH, Request::ALL, Measure::Jaumann);
        assert!((rows(along.matrix()) - rows(jaumann)).norm() <= 1e-12 * scale);
    }
}

/// At rest the tangent has rank 3 of 6: eigenvalues 0, 0, 0, k_td/4, k_td/2, k_el; with p = 2 the area has k_tc.
#[test]
fn at_rest() {
    let rest = Matrix3::identity();
    for (p, area) in [(2.2, 0.0), (3.0, 0.0), (2.0, 1.25)] {
        let k = Stiffness { k_el: 80.0, k_tc: 1.25, p, k_td: 0.5, k_ld: 0.0 };
        for m in [Vector3::x(), Vector3::new(1.0, 2.0, -2.0)] {
            for measure in SIX {
                let c = six(&k.law(&m), &rest, measure);
                // Tensor components make the shears' basis orthonormal, and the eigenvalues those of no direction.
                let root = Matrix6::from_diagonal(&Vector6::new(1.0, 1.0, 1.0, 2f64.sqrt(), 2f64.sqrt(), 2f64.sqrt()));
                let mut found: Vec<_> = (root * c * root).symmetric_eigenvalues().iter().copied().collect();
                found.sort_by(f64::total_cmp);
                let mut wanted = [0.0, 0.0, area, 0.5 / 2.0, 0.5 / 2.0, 80.0];
                wanted.sort_by(f64::total_cmp);
                for (found, wanted) in found.iter().zip(wanted) {
                    assert!((found - wanted).abs() <= 1e-14 * 80.0, "{found} instead of {wanted}, p = {p}");
                }
            }
        }
        let along_x = six(&k.law(&Vector3::x()), &rest, Measure::Jaumann);
        let mut found: Vec<_> = along_x.symmetric_eigenvalues().iter().copied().collect();
        found.sort_by(f64::total_cmp);
        let mut wanted = [0.0, 0.0, area, 0.5 / 4.0, 0.5 / 2.0, 80.0];
        wanted.sort_by(f64::total_cmp);
        assert!(found.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() <= 1e-14 * 80.0), "{found:?}");
    }
}

/// On a kink the side of loading counts; off it there is none.
#[test]
fn kinks() {
    for p in [1.2, 1.5, 2.0, 2.2, 3.0] {
        let k = Stiffness { k_el: 80.0, k_tc: 1.25, p, k_td: 0.5, k_ld: 0.0 };
        let law = k.law(&Vector3::x());
        let along = |lambda: f64| {
            six(&law, &Matrix3::from_diagonal(&Vector3::new(lambda, 1.0, 1.0)), Measure::Truesdell)[(0, 0)]
        };
        assert_eq!(along(1.0), 80.0);
        assert_eq!(along(1.0 - 1e-15), 0.0);
        assert!((along(1.0 + 1e-9) - 80.0).abs() < 1e-6);

        let across = |lambda: f64| {
            let c = six(&law, &Matrix3::from_diagonal(&Vector3::new(1.0, lambda, lambda)), Measure::Jaumann);
            0.5 * (c[(1, 1)] + c[(1, 2)]) // ¼ W″
        };
        // p < 2: the stiffness of a compaction of 1e-8, for every smaller one.
        let held = 0.25 * p * (p - 1.0) * 1.25 * if p <= 2.0 { 1e-8_f64.powf(p - 2.0) } else { 0.0 };
        assert!((across(1.0) - held).abs() <= 1e-13 * held.max(1.0), "p = {p}: {} instead of {held}", across(1.0));
        assert_eq!(across(1.0 + 1e-12), 0.0);
        let i = 1e-4;
        let wanted = 0.25 * p * (p - 1.0) * 1.25 * f64::powf(i, p - 2.0);
        let found = across((-i).exp()) * (-2.0 * i).exp();
        assert!((found - wanted).abs() <= 1e-11 * wanted, "p = {p}: {found} instead of {wanted}");
        if p < 2.0 {
            assert!((across((-1e-10_f64).exp()) - held).abs() <= 1e-9 * held);
        }
    }
}

// ---------------------------------------------------------------------------------------------------------------------
// Failure and bad points

#[test]
fn failure() {
    let law = preset();
    let whole =
        Hyperelastic::new(&[82341.0, 1055.0, 2.2, 649.74, 100.0, 0.0, 0.0, 0.0, 0.6, 0.0, 0.8]).expect("properties");
    let f = Matrix3::identity() + Vector3::new(0.6, 0.0, 0.8) * Vector3::new(0.6, 0.0, 0.8).transpose() * 0.05;
    for measure in SIX {
        let (point, moduli) = law.point_with_moduli(&f.data.0, None, &FRESH, Request::ALL, measure);
        assert_eq!((point.status, point.state[FAILED]), (status::OK, 1.0));
        assert_eq!(moduli.matrix(), whole.tangent(&f, measure).1);
        let (again, moduli) = law.point_with_moduli(&f.data.0, None, &point.state, Request::ALL, measure);
        assert_eq!((again.status, again.stress, moduli.0), (status::OK, [0.0; 6], [0.0; 21]));
    }
    let (point, nominal) = law.point_with_nominal(&f.data.0, None, &FRESH, Request::ALL);
    assert!(nominal.iter().any(|&x| x > 1e4));
    assert!(law.point_with_nominal(&f.data.0, None, &point.state, Request::ALL).1.iter().all(|&x| x == 0.0));
}

#[test]
fn bad_points() {
    let law = preset();
    let mut inverted = Matrix3::identity();
    inverted[0] = -1.0;
    for (f, wanted) in [
        (inverted, status::INVERTED),
        (Matrix3::from_element(f64::NAN), status::NOT_FINITE),
        (Matrix3::zeros(), status::INVERTED),
        (Matrix3::identity() * 1e120, status::OVERFLOW),
    ] {
        for measure in SIX {
            let (point, rows) = law.tangent(&f, measure);
            assert_eq!((point.status, rows, point.stress), (wanted, [[0.0; 6]; 6], [0.0; 6]));
        }
    }
    // A stiffness that does not fit although the stress does: the point cannot be evaluated.
    let stiff = Hyperelastic::new(&[1e25_f32, 1e25, 9.0, 1e25, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0]).expect("properties");
    let f = Matrix3::from_diagonal(&Vector3::new(1.0, 0.01, 0.01));
    let (point, rows) = stiff.tangent(&f, Measure::Material);
    assert_eq!((point.status, rows, point.stress), (status::OVERFLOW, [[0.0; 6]; 6], [0.0; 6]));
    // Another measure of it does.
    let (point, rows) = stiff.tangent(&f, Measure::Truesdell);
    assert!(
        point.status == status::OK && rows[1][1] > 1e34 && point.stress[1] < -1e34,
        "{}, {:e}, {:e}",
        point.status,
        rows[1][1],
        point.stress[1]
    );
}

fn numbers_only<T: Real<Mask = bool> + Into<f64> + std::fmt::Debug>(
    law: &Hyperelastic<T>,
    f: &[[T; 3]; 3],
    state: &[T; 11],
) {
    let check = |point: Point<T>, tangent: &[T]| {
        let finite = tangent.iter().chain(&point.stress).chain(&point.state).all(|&x| x.into().is_finite());
        assert!(finite, "{f:?}, {state:?}: {tangent:?}");
        let zero = tangent.iter().all(|&x| x.into() == 0.0);
        assert!(point.status == status::OK || zero, "{f:?}: {}", point.status);
    };
    for measure in SIX {
        let (point, moduli) = law.point_with_moduli(f, None, state, Request::ALL, measure);
        check(point, &moduli.0);
    }
    let (point, nominal) = law.point_with_nominal(f, None, state, Request::ALL);
    check(point, &nominal);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]
    /// Whatever bits go in, only numbers come out.
    #[test]
    fn only_numbers(
        f in prop::array::uniform9(prop_oneof![
            any::<u64>().prop_map(f64::from_bits), -2.0..2.0, prop::sample::select(vec![0.0, 1.0, 1e300, 1e-300, -0.0])]),
        latch in prop_oneof![Just(0.0), any::<f64>()],
        p in prop::sample::select(vec![1.2, 2.0, 2.2, 5.0]),
        k_ld in prop_oneof![Just(0.0), Just(1e9)],
    ) {
        let columns = |f: [f64; 9]| [[f[0], f[1], f[2]], [f[3], f[4], f[5]], [f[6], f[7], f[8]]];
        let properties = [8e10, 1e9, p, 6e8, k_ld, 0.0458, 1.8, 0.0, 1.0, 0.5, 0.0];
        let mut state = FRESH;
        state[FAILED] = latch;
        numbers_only(&Hyperelastic::new(&properties).expect("properties"), &columns(f), &state);
        let single = |x: f64| x as f32;
        let law = Hyperelastic::new(&properties.map(single)).expect("properties");
        numbers_only(&law, &columns(f).map(|column| column.map(single)), &state.map(single));
    }
}

// ---------------------------------------------------------------------------------------------------------------------
// Blocks

/// A block's tangents at every level are those of its points alone, to rounding; nothing is written beside them; what
/// is left out is nothing.
fn blocks<T: Number>(tolerance: f64) {
    let points: Vec<_> = samples((states(), stiffness()), 37).collect();
    let law = Hyperelastic::<T>::new(&[80.0, 1.25, 2.2, 0.5, 0.25, 0.3, 0.0, 0.0, 1.0, 0.0, 0.0].map(T::splat))
        .expect("properties");
    let (n, stride) = (points.len(), points.len() + 3);
    let mut gradient = vec![T::splat(f64::NAN); 9 * stride];
    let mut fibre = vec![T::splat(0.0); 3 * stride];
    let mut latches = vec![T::splat(0.0); 3 * stride];
    for (i, (Sample { f, m, .. }, _)) in points.iter().enumerate() {
        for c in 0..9 {
            gradient[c * stride + i] = T::splat(if i == 20 { -f[c] } else { f[c] });
        }
        for c in 0..3 {
            fibre[c * stride + i] = T::splat(m[c]);
        }
    }
    latches[stride + 30] = T::splat(1.0);
    for level in Level::ALL.into_iter().filter(|&level| level <= Level::best()) {
        for measure in [Measure::Material, Measure::Truesdell, Measure::Jaumann, Measure::Nominal] {
            let size = measure.components();
            let mut tangent = vec![T::splat(7.0); size * stride];
            let mut failure = latches.clone();
            let mut codes = vec![0; n];
            let worst = law.block(Arrays {
                n,
                leading_dimension: stride,
                deformation_gradient: &gradient,
                fibre: Some(&fibre),
                failure: Some(&mut failure),
                tangent: Some(&mut tangent),
                measure,
                status: Some(&mut codes),
                level: Some(level),
                ..Arrays::default()
            });
            assert_eq!(worst, Ok(status::INVERTED));
            for i in 0..n {
                let value = |array: &[T], c: usize| array[c * stride + i];
                let columns = std::array::from_fn(|j| std::array::from_fn(|k| value(&gradient, 3 * j + k)));
                let along = Some(std::array::from_fn(|c| value(&fibre, c)));
                let mut state = [T::splat(0.0); HYPERELASTIC_STATE];
                state[FAILED] = value(&latches, 1);
                let (status, alone) = if measure == Measure::Nominal {
                    let (point, alone) = law.point_with_nominal(&columns, along, &state, Request::ALL);
                    (point.status, alone.to_vec())
                } else {
                    let (point, moduli) = law.point_with_moduli(&columns, along, &state, Request::ALL, measure);
                    (point.status, moduli.matrix().as_flattened().to_vec())
                };
                assert_eq!(codes[i], status);
                let alone: Vec<f64> = alone.into_iter().map(Into::into).collect();
                let scale = alone.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
                assert_eq!(scale == 0.0, i == 20 || i == 30, "point {i}");
                for (c, &alone) in alone.iter().enumerate() {
                    let found: f64 = value(&tangent, c).into();
                    assert!(
                        (found - alone).abs() <= tolerance * scale,
                        "{level:?} {measure:?} {i} {c}: {found} {alone}"
                    );
                }
            }
            for c in 0..size {
                assert!(tangent[c * stride + n..(c + 1) * stride].iter().all(|&x| x == T::splat(7.0)), "a gap");
            }
        }
    }
    let short = Arrays {
        n,
        leading_dimension: stride,
        deformation_gradient: &gradient,
        tangent: Some(&mut latches),
        ..Arrays::default()
    };
    assert_eq!(law.block(short).map_err(|error| error.code()), Err(status::BAD_COUNT));
}

#[test]
fn blocks_of_points() {
    blocks::<f64>(1e-12);
    blocks::<f32>(1e-3);
}

/// dP/dF keeps its digits where the images of the axes across the fibre are nearly parallel: two entries, of a section
/// sheared by 78 and of fibres sheared by 63 beside it, computed in 50 digits.
#[test]
fn nominal_of_a_flattened_section() {
    let law =
        Hyperelastic::new(&[82341.0, 1055.0, 2.2, 649.74, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0]).expect("properties");
    let cases = [
        ([[1.02, 0.0, 0.0], [0.0, 1.1, 0.0], [0.0, 77.7, 0.9]], (5, 4), -129_981.809_191_741_18),
        ([[1.02, 0.0, 0.0], [63.0, 1.1, 0.0], [31.0, 77.7, 0.9]], (2, 0), 6_691_333.260_179_681),
    ];
    for (f, (row, column), truth) in cases {
        let (point, nominal) = law.point_with_nominal(&f, None, &FRESH, Request::ALL);
        assert_eq!(point.status, status::OK);
        let norm = nominal.iter().map(|x: &f64| x * x).sum::<f64>().sqrt();
        let error = (nominal[9 * row + column] - truth).abs() / norm;
        assert!(error < 4e-15, "{f:?}: {error:e} of the norm");
    }
}
