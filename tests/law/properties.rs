//! What holds for every state: objectivity, symmetry about the fibre, no work in a loop, the latch, and no NaN out.

use std::f64::consts::TAU;

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use proptest::prelude::*;
use toron::law::linear_elastic::{Criterion, LinearElastic, LinearPoint, Rotation};
use toron::law::state::{
    ALIVE, ENERGIES, FAILED, FAILURE_INDEX, HYPERELASTIC_STATE, INVARIANTS, LINEAR_ALIVE, LINEAR_ELASTIC_STATE,
    LINEAR_FAILED, LINEAR_WORK,
};
use toron::law::status;
use toron::law::stress::{components, first_piola_kirchhoff, matrix};
use toron::{Hyperelastic, Point, Request};
use toron_test_support::deformations::{Ranges, Sample, deformation, rotation};

const START: [f64; HYPERELASTIC_STATE] = [0.0; HYPERELASTIC_STATE];

/// Stiffnesses of a yarn, any exponent, no failure: k_el, k_tc, p, k_td, k_ld, ε_lim, α, β.
fn material() -> impl Strategy<Value = [f64; 8]> {
    let exponent = prop::sample::select(vec![1.2, 1.5, 2.0, 2.2, 3.0, 5.0]);
    (10e9..100e9, 0.1e9..10e9, exponent, 0.1e9..10e9, prop_oneof![Just(0.0), 0.1e9..10e9])
        .prop_map(|(k_el, k_tc, p, k_td, k_ld)| [k_el, k_tc, p, k_td, k_ld, 0.0, 0.0, 0.0])
}

fn states() -> impl Strategy<Value = Sample> {
    deformation(Ranges { i_el: -0.3..0.3, i_tc: -0.6..0.3, i_td: 0.0..0.8, i_ld: 0.0..0.6 })
}

fn law(material: &[f64; 8], m: &Vector3<f64>) -> Hyperelastic<f64> {
    let [k_el, k_tc, p, k_td, k_ld, eps_lim, alpha, beta] = *material;
    Hyperelastic::new(&[k_el, k_tc, p, k_td, k_ld, eps_lim, alpha, beta, m.x, m.y, m.z]).expect("valid properties")
}

fn intact(law: &Hyperelastic<f64>, f: &Matrix3<f64>) -> Point<f64> {
    let point = law.point(f, &START, Request::ALL);
    assert_eq!(point.status, status::OK, "F = {f}");
    point
}

/// How far two answers lie apart: the stress, and each energy and invariant.
fn distances(a: &Point<f64>, b: &Point<f64>) -> [f64; 9] {
    let stress = (matrix(&a.stress) - matrix(&b.stress)).norm();
    std::array::from_fn(|i| if i == 8 { stress } else { (a.state[i] - b.state[i]).abs() })
}

/// How far roundings of F may move an answer: 16 of them in every entry of F, one entry after the other, either way,
/// and 16 of the answer itself. Two answers to the same question differ by no more.
fn allowances(law: &Hyperelastic<f64>, f: &Matrix3<f64>) -> [f64; 9] {
    const ROUNDINGS: f64 = 16.0 * f64::EPSILON;
    let here = intact(law, f);
    let nothing = Point { stress: [0.0; 6], state: START, ..here };
    let mut sum = distances(&here, &nothing).map(|size| ROUNDINGS * size);
    for entry in 0..9 {
        let moved = [1.0, -1.0].map(|sign| {
            let mut f = *f;
            f[entry] += sign * ROUNDINGS * f.norm();
            distances(&intact(law, &f), &here)
        });
        for i in 0..9 {
            sum[i] += moved[0][i].max(moved[1][i]);
        }
    }
    sum
}

fn assert_same(a: &Point<f64>, b: &Point<f64>, allowances: &[f64; 9]) -> Result<(), TestCaseError> {
    for (i, (distance, allowance)) in distances(a, b).into_iter().zip(allowances).enumerate() {
        prop_assert!(distance <= *allowance, "output {i}: {distance:e} apart, allowed {allowance:e}");
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    /// A rotation of the deformed body turns the stress and changes nothing else.
    #[test]
    fn objectivity(Sample { f, m, .. } in states(), material in material(), q in rotation()) {
        let law = law(&material, &m);
        let still = intact(&law, &f);
        let turned = intact(&law, &(q * f));
        let back = Point { stress: components(&(q.transpose() * matrix(&turned.stress) * q)), ..turned };
        assert_same(&back, &still, &allowances(&law, &f))?;
    }

    /// A rotation of the undeformed body about the fibre changes nothing.
    #[test]
    fn symmetry_about_the_fibre(Sample { f, m, .. } in states(), material in material(), angle in 0.0..TAU) {
        let law = law(&material, &m);
        let about = Rotation3::from_axis_angle(&Unit::new_normalize(m), angle).into_inner();
        assert_same(&intact(&law, &(f * about)), &intact(&law, &f), &allowances(&law, &f))?;
    }

    /// The fibre has no sign and its direction no length; a length that is a power of two does not even round.
    #[test]
    fn fibre_direction(
        Sample { f, m, .. } in states(),
        material in material(),
        length in 1e-3..1e3,
        exponent in -40..40i32,
    ) {
        let reference = law(&material, &m);
        let (point, allowances) = (intact(&reference, &f), allowances(&reference, &f));
        assert_same(&intact(&law(&material, &-m), &f), &point, &allowances)?;
        assert_same(&intact(&law(&material, &(m * length)), &f), &point, &allowances)?;
        for length in [1e-160, 1e160] {
            assert_same(&intact(&law(&material, &(m * length)), &f), &point, &allowances)?;
        }
        prop_assert_eq!(intact(&law(&material, &(m * 2f64.powi(exponent))), &f), point);
    }

    /// A fibre along the first axis has formulas of its own: the numbers of the general ones, whatever its length.
    #[test]
    fn fibre_along_the_first_axis(Sample { f, m, .. } in states(), material in material(), length in 1e-3..1e3) {
        // Turned so that the fibre lies along the axis.
        let turn = Rotation3::rotation_between(&Vector3::x(), &m).unwrap_or_else(Rotation3::identity).into_inner();
        let f = f * turn;
        let aligned = law(&material, &Vector3::x());
        let columns = std::array::from_fn(|j| std::array::from_fn(|i| f[(i, j)]));
        let general = |m: [f64; 3]| aligned.point_along(&columns, Some(m), &START, Request::ALL);
        let (point, allowances) = (intact(&aligned, &f), allowances(&aligned, &f).map(|x| x / 8.0));
        assert_same(&general([1.0, 0.0, 0.0]), &point, &allowances)?;
        assert_same(&general([length, 0.0, 0.0]), &point, &allowances)?;
        for length in [2.0, length, 1e-200] {
            prop_assert_eq!(intact(&law(&material, &(Vector3::x() * length)), &f), point);
        }
        // Close to the axis, but not on it.
        assert_same(&intact(&law(&material, &Vector3::new(1.0, 1e-18, -1e-18)), &f), &point, &allowances)?;
        // Along the axis the other way.
        assert_same(&intact(&law(&material, &-Vector3::x()), &f), &point, &allowances)?;
    }

    /// A rotated body at rest carries the rounding of its rotation matrix, a strain of some 10^-15, and no more.
    #[test]
    fn no_stress_at_rest(m in toron_test_support::deformations::direction(), material in material(), q in rotation()) {
        let strain = 4e-15;
        let [k_el, k_tc, p, k_td, k_ld, ..] = material;
        let allowed = (k_el + k_td + k_ld) * strain + p * k_tc * strain.powf(p - 1.0);
        let point = intact(&law(&material, &m), &q);
        prop_assert!(matrix(&point.stress).norm() <= allowed, "{:?}", point.stress);
        let identity = intact(&law(&material, &m), &Matrix3::identity());
        prop_assert_eq!(identity.stress, [0.0; 6]);
    }

    /// Stiffnesses in other units: the stress, the energies, the modes and the wave modulus scale, nothing else moves.
    #[test]
    fn homogeneity(Sample { f, m, .. } in states(), material in material(), exponent in -30..30i32) {
        let factor = 2f64.powi(exponent); // exact
        let [k_el, k_tc, p, k_td, k_ld, ..] = material;
        let scaled = [k_el * factor, k_tc * factor, p, k_td * factor, k_ld * factor, 0.0, 0.0, 0.0];
        let (a, b) = (intact(&law(&material, &m), &f), intact(&law(&scaled, &m), &f));
        prop_assert_eq!(a.stress.map(|x| x * factor), b.stress);
        prop_assert_eq!(a.modes.map(|mode| mode.map(|x| x * factor)), b.modes);
        prop_assert_eq!(a.wave_modulus * factor, b.wave_modulus);
        for i in 0..HYPERELASTIC_STATE {
            let expected = if (ENERGIES..INVARIANTS).contains(&i) { a.state[i] * factor } else { a.state[i] };
            prop_assert_eq!(expected, b.state[i]);
        }
    }
}

/// P : dF around F0 + A cos t + B sin t, net and in absolute value, by the trapezoidal rule, which is exact to all
/// orders for a smooth loop.
fn work_around(law: &Hyperelastic<f64>, loop_: [Matrix3<f64>; 3], steps: usize) -> (f64, f64, [f64; 2]) {
    let [f0, a, b] = loop_;
    let (mut net, mut gross, mut kinks) = (0.0, 0.0, [f64::INFINITY; 2]);
    for i in 0..steps {
        let (sine, cosine) = (TAU * i as f64 / steps as f64).sin_cos();
        let f = f0 + a * cosine + b * sine;
        let point = intact(law, &f);
        let work = first_piola_kirchhoff(&point.stress, &f).dot(&(b * cosine - a * sine));
        net += work;
        gross += work.abs();
        kinks = [kinks[0].min(point.state[INVARIANTS]), kinks[1].min(-point.state[INVARIANTS + 1])];
    }
    (net, gross, kinks)
}

fn amplitude(size: f64) -> impl Strategy<Value = Matrix3<f64>> {
    prop::array::uniform9(-size..size).prop_map(|entries| Matrix3::from_row_slice(&entries))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    /// Tension and compaction throughout: a smooth loop, whose quadrature leaves rounding only.
    #[test]
    fn no_work_in_a_smooth_loop(
        Sample { f, m, .. } in deformation(Ranges { i_el: 0.2..0.3, i_tc: -0.4..-0.3, i_td: 0.2..0.4, i_ld: 0.0..0.4 }),
        a in amplitude(0.03),
        b in amplitude(0.03),
        material in material(),
    ) {
        let (net, gross, kinks) = work_around(&law(&material, &m), [f, a, b], 256);
        prop_assert!(kinks[0] > 0.0 && kinks[1] > 0.0, "the loop was to stay clear of the kinks");
        prop_assert!(net.abs() <= 1e-12 * gross, "net {net:e} of {gross:e}");
    }

    /// In and out of tension and compaction, about rest: there the quadrature is of second order.
    #[test]
    fn no_work_in_a_loop_about_rest(a in amplitude(0.1), b in amplitude(0.1), material in material()) {
        let mut material = material;
        material[2] = material[2].max(2.0);
        let law = law(&material, &Vector3::x());
        let (net, gross, _) = work_around(&law, [Matrix3::identity(), a, b], 4000);
        prop_assert!(net.abs() <= 1e-6 * gross, "net {net:e} of {gross:e}");
    }
}

/// A yarn that fails: ε_lim, α, β.
fn failing() -> impl Strategy<Value = [f64; 8]> {
    (material(), 0.01..0.2, 0.0..2.0, 0.0..2.0).prop_map(|(mut material, eps_lim, alpha, beta)| {
        material[5..].copy_from_slice(&[eps_lim, alpha, beta]);
        material
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    /// The call that detects failure answers as if there were none, and latches; the next ones carry nothing and keep
    /// the energies.
    #[test]
    fn latch(Sample { f, m, .. } in states(), Sample { f: later, .. } in states(), material in failing()) {
        let [.., eps_lim, alpha, beta] = material;
        let law_with = law(&material, &m);
        let mut without = material;
        without[5] = 0.0;
        let (point, unlimited) = (intact(&law_with, &f), intact(&law(&without, &m), &f));
        prop_assert_eq!(point.stress, unlimited.stress);
        prop_assert_eq!(point.modes, unlimited.modes);
        prop_assert_eq!(&point.state[..FAILURE_INDEX], &unlimited.state[..FAILURE_INDEX]);
        prop_assert_eq!(&unlimited.state[FAILURE_INDEX..], [0.0, 0.0, 1.0], "ε_lim = 0 never fails");

        let [i_el, i_tc, i_td, _] = std::array::from_fn(|i| point.state[INVARIANTS + i]);
        let index = i_el / eps_lim.ln_1p() + alpha * (-i_tc).max(0.0) + beta * i_td;
        let index = if i_el > 0.0 { index } else { 0.0 };
        prop_assert!((point.state[FAILURE_INDEX] - index).abs() <= 8.0 * f64::EPSILON * index);
        prop_assert_eq!(point.state[FAILED], f64::from(u8::from(point.state[FAILURE_INDEX] >= 1.0)));
        prop_assert_eq!(point.state[ALIVE], 1.0 - point.state[FAILED]);

        if point.state[FAILED] == 1.0 {
            let after = law_with.point(&later, &point.state, Request::ALL);
            prop_assert_eq!(after.status, status::OK);
            prop_assert_eq!(after.stress, [0.0; 6]);
            prop_assert_eq!(after.modes, [[0.0; 6]; 4]);
            prop_assert_eq!(after.state, point.state);
        }
    }

    /// Without tension nothing fails, however strong the compaction, the distortion and their weights.
    #[test]
    fn no_failure_without_tension(
        Sample { f, m, .. } in deformation(Ranges { i_el: -0.5..-1e-12, i_tc: -3.0..0.5, i_td: 0.0..2.0, i_ld: 0.0..1.0 }),
        material in failing(),
        weight in 1.0..1e6,
    ) {
        let mut material = material;
        material[6] *= weight;
        material[7] *= weight;
        let point = intact(&law(&material, &m), &f);
        prop_assert_eq!(&point.state[FAILURE_INDEX..], [0.0, 0.0, 1.0]);
    }

    /// Where compaction and distortion have used up the limit (r ≤ 0), any tension fails.
    #[test]
    fn any_tension_fails_a_crushed_yarn(i_el in 1e-9..1e-3, i_tc in -1.0..-0.6, angle in 0.0..TAU) {
        let material = [82e9, 1e9, 2.2, 0.6e9, 0.0, 0.0458, 1.8, 0.0]; // r = 1 − 1.8 · 0.6 < 0
        let width = f64::exp(i_tc);
        let turned = Rotation3::from_axis_angle(&Vector3::x_axis(), angle).into_inner();
        for (stretch, failed) in [(f64::exp(i_el), 1.0), (1.0, 0.0), (f64::exp(-i_el), 0.0)] {
            let f = turned * Matrix3::from_diagonal(&Vector3::new(stretch, width, width));
            let point = intact(&law(&material, &Vector3::x()), &f);
            prop_assert_eq!(point.state[FAILED], failed, "stretch {}", stretch);
        }
    }
}

/// Equality fails: among a thousand stretches to the limit some give an index of exactly 1, and each of these fails;
/// the number before 1 does not.
#[test]
fn equality_fails() {
    let mut exactly = 0;
    for i in 1..=1000 {
        let eps_lim = f64::from(i) * 1e-4;
        let law = law(&[82e9, 1e9, 2.2, 0.6e9, 0.0, eps_lim, 0.0, 0.0], &Vector3::x());
        let point = intact(&law, &Matrix3::from_diagonal(&Vector3::new(1.0 + eps_lim, 1.0, 1.0)));
        if point.state[FAILURE_INDEX] == 1.0 {
            exactly += 1;
            assert_eq!(point.state[FAILED], 1.0);
        }
    }
    assert!(exactly > 0, "no index of exactly 1");
}

/// A number of any kind: any bits at all, those of ordinary size, and the awkward ones.
fn number() -> impl Strategy<Value = f64> {
    let awkward = [0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e200, -1e200, 1e-200, 5e-324, f64::MAX, 1.0];
    prop_oneof![any::<u64>().prop_map(f64::from_bits), -2.0..2.0, prop::sample::select(awkward.to_vec())]
}

fn number_single() -> impl Strategy<Value = f32> {
    let awkward = [0.0, -0.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30, -1e30, 1e-30, 1e-45, f32::MAX, 1.0];
    prop_oneof![any::<u32>().prop_map(f32::from_bits), -2.0f32..2.0, prop::sample::select(awkward.to_vec())]
}

/// A gradient of such numbers: all of them, or one among ordinary ones, or ordinary ones times a size.
fn gradient() -> impl Strategy<Value = Matrix3<f64>> {
    let near = || prop::array::uniform9(-0.5..0.5).prop_map(|h| Matrix3::identity() + Matrix3::from_row_slice(&h));
    prop_oneof![
        prop::array::uniform9(number()).prop_map(|entries| Matrix3::from_row_slice(&entries)),
        (near(), 0usize..9, number()).prop_map(|(mut f, entry, x)| {
            f[entry] = x;
            f
        }),
        (near(), -320..308i32).prop_map(|(f, size)| f * 10f64.powi(size)),
    ]
}

/// An old state: fresh, or anything.
fn state<const N: usize>() -> impl Strategy<Value = [f64; N]> {
    let array = |s: BoxedStrategy<f64>| prop::collection::vec(s, N).prop_map(|v| <[f64; N]>::try_from(v).expect("N"));
    prop_oneof![Just([0.0; N]), array(number().boxed()), array((-2.0..2.0).boxed())]
}

/// What may leave the law whatever goes in: numbers; after an error no stress and the old state, less what is not
/// finite in it.
fn assert_clean(point: &Point<f64>, old: &[f64; HYPERELASTIC_STATE], k_el: f64) -> Result<(), TestCaseError> {
    let everything = point.stress.iter().chain(&point.state).chain(point.modes.iter().flatten());
    prop_assert!(everything.chain([&point.wave_modulus]).all(|x| x.is_finite()), "{point:?}");
    prop_assert!(point.wave_modulus >= k_el);
    let failed = point.state[FAILED];
    prop_assert!((failed == 0.0 || failed == 1.0) && point.state[ALIVE] == 1.0 - failed);
    let latched = old[FAILED].is_nan() || old[FAILED] >= 0.5;
    prop_assert!(!latched || failed == 1.0, "a latch never opens");
    if point.status != status::OK || latched {
        prop_assert_eq!(point.stress, [0.0; 6]);
        prop_assert_eq!(point.modes, [[0.0; 6]; 4]);
        let kept = old.map(|x| if x.is_finite() { x } else { 0.0 });
        prop_assert_eq!(&point.state[..FAILED], &kept[..FAILED]);
        prop_assert_eq!(failed, f64::from(u8::from(latched)), "an error does not fail a point");
    }
    if latched && old[..FAILED].iter().chain([&old[FAILED]]).any(|x| !x.is_finite()) {
        prop_assert_eq!(point.status, status::STATE_NOT_FINITE);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn nothing_but_numbers_leaves(f in gradient(), old in state::<HYPERELASTIC_STATE>(), p in 1.01..6.0) {
        let law = law(&[82e9, 1e9, p, 0.6e9, 0.3e9, 0.0458, 1.8, 0.5], &Vector3::new(0.6, -0.8, 0.0));
        let point = law.point(&f, &old, Request::ALL);
        assert_clean(&point, &old, 82e9)?;
        if !(old[FAILED].is_nan() || old[FAILED] >= 0.5) && f.iter().any(|x| !x.is_finite()) {
            prop_assert_eq!(point.status, status::NOT_FINITE);
        }
    }

    #[test]
    fn nothing_but_numbers_leaves_in_single_precision(
        entries in prop::array::uniform9(number_single()),
        near in prop::array::uniform9(-0.5f32..0.5),
        mixed in any::<Option<u8>>(),
        old in prop::collection::vec(prop_oneof![Just(0.0), number_single()], HYPERELASTIC_STATE),
    ) {
        let mut f = Matrix3::from_row_slice(&entries);
        if let Some(entry) = mixed {
            f = Matrix3::identity() + Matrix3::from_row_slice(&near);
            f[usize::from(entry) % 9] = entries[0];
        }
        let properties = [82e3, 1e3, 2.2, 0.6e3, 0.3e3, 0.0458, 1.8, 0.5, 0.6, -0.8, 0.0];
        let law = Hyperelastic::<f32>::new(&properties).expect("valid properties");
        let old = <[f32; HYPERELASTIC_STATE]>::try_from(old).expect("as many");
        let p = law.point(&f, &old, Request::ALL);
        let point = Point {
            stress: p.stress.map(f64::from),
            state: p.state.map(f64::from),
            modes: p.modes.map(|mode| mode.map(f64::from)),
            wave_modulus: f64::from(p.wave_modulus),
            status: p.status,
        };
        assert_clean(&point, &old.map(f64::from), 82e3)?;
    }

    #[test]
    fn nothing_but_numbers_leaves_the_linear_law(
        f0 in gradient(),
        f1 in gradient(),
        old in state::<LINEAR_ELASTIC_STATE>(),
        strain in prop::array::uniform6(number()),
        volume in number(),
    ) {
        let law = LinearElastic::new(&[79e9, 0.8e9, 0.1e9, 3.6e9, 0.6, -0.8, 0.0, 0.0, 0.0, 1.0]).expect("valid");
        for f0 in [f0, Matrix3::identity()] {
            for rotation in [Rotation::Fibre, Rotation::Polar, Rotation::Spin] {
                let mut axes = law.reference_axes();
                let point = law.step(&f0, &f1, &old, rotation, Criterion::LargestPrincipal, &mut axes);
                prop_assert!(axes.iter().all(|x| x.is_finite()));
                assert_clean_linear(&point, &old)?;
            }
        }
        assert_clean_linear(&law.increment(&strain, volume, &old, Criterion::FibreStress), &old)?;
    }
}

fn assert_clean_linear(point: &LinearPoint, old: &[f64; LINEAR_ELASTIC_STATE]) -> Result<(), TestCaseError> {
    prop_assert!(point.stress.iter().chain(&point.state).all(|x| x.is_finite()), "{point:?}");
    if point.status != status::OK || point.state[LINEAR_FAILED] == 1.0 && old[LINEAR_FAILED] >= 0.5 {
        prop_assert_eq!(point.stress, [0.0; 6]);
        let kept = if old[LINEAR_WORK].is_finite() { old[LINEAR_WORK] } else { 0.0 };
        prop_assert_eq!(point.state[LINEAR_WORK], kept);
    }
    let failed = point.state[LINEAR_FAILED];
    prop_assert!((failed == 0.0 || failed == 1.0) && point.state[LINEAR_ALIVE] == 1.0 - failed, "latch {failed}");
    let latched = old[LINEAR_FAILED].is_nan() || old[LINEAR_FAILED] >= 0.5;
    prop_assert!(!latched || failed == 1.0, "a latch never opens");
    Ok(())
}

/// Named cases: each has its status, no stress, and the state as it was.
#[test]
fn points_that_cannot_be_evaluated() {
    let law = law(&[82e9, 1e9, 2.2, 0.6e9, 0.0, 0.0458, 1.8, 0.0], &Vector3::x());
    let old = intact(&law, &Matrix3::from_diagonal(&Vector3::new(1.01, 0.9, 0.95))).state;
    let diagonal = |a: f64, b: f64, c: f64| Matrix3::from_diagonal(&Vector3::new(a, b, c));
    let cases = [
        (diagonal(-1.0, 1.0, 1.0), status::INVERTED),
        (diagonal(1.0, 1.0, 0.0), status::INVERTED),
        (diagonal(0.0, 1.0, 1.0), status::INVERTED),
        (Matrix3::zeros(), status::INVERTED),
        (diagonal(1e-200, 1e-200, 1e-200), status::INVERTED),
        (diagonal(1e200, 1e200, 1e200), status::OVERFLOW),
        (diagonal(f64::NAN, 1.0, 1.0), status::NOT_FINITE),
        (diagonal(1.0, f64::INFINITY, 1.0), status::NOT_FINITE),
        (diagonal(1.0, 1.0, f64::NEG_INFINITY), status::NOT_FINITE),
    ];
    for (f, expected) in cases {
        let point = law.point(&f, &old, Request::ALL);
        assert_eq!(point.status, expected, "F = {f}");
        assert_eq!(point.stress, [0.0; 6]);
        assert_eq!(point.state, old, "F = {f}");
        assert_eq!(point.wave_modulus, 82e9);
    }
}
