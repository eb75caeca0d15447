//! The block kernel against the scalar law and against itself, at every level of instructions that this machine has.
//!
//! The baseline gives the scalar law's bits. AVX2 and AVX-512 fuse multiplications with additions and stay within a few
//! roundings of the input; at one level, no result depends on where its point stands.

use std::ops::Range;
use std::ptr::null_mut;

use nalgebra::Matrix3;
use proptest::prelude::*;
use toron::Arrays;
use toron::Error;
use toron::Level;
use toron::Measure;
use toron::Point;
use toron::Real;
use toron::host::{constants, point_and_block, points};
use toron::law::block::Points;
use toron::law::interface::Law;
use toron::law::parameters::PRESETS;
use toron::law::prepared::PreparedHyperelastic;
use toron::law::state::{FAILED, FAILURE_INDEX, HYPERELASTIC_STATE};
use toron::law::status;
use toron::{Hyperelastic, LinearElastic, Request};
use toron_test_support::block::{Asked, Call, Input, Number, Old, Output, VALUES, levels, run};
use toron_test_support::deformations::{Ranges, Sample, deformation, samples};
use toron_test_support::truth::{
    Answer, Bounds, Case, DOUBLE, FAR_DOUBLE, FAR_SINGLE, SINGLE, Score, cases, far_cases,
};

/// Where the groups of an output stand, see `common/block.rs`.
const STRESS: Range<usize> = 0..6;
const INDEX: usize = 14;
const LATCH: usize = 15;
/// Where the index stands among the groups that are measured.
const INDEX_GROUP: usize = 9;
const MODES: Range<usize> = 17..41;
const WAVE_SPEED: usize = 41;

const AXIS: [f64; 3] = [1.0, 0.0, 0.0];
const REST: [f64; 9] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

fn law<T: Number>(properties: [f64; 11]) -> Hyperelastic<T> {
    Hyperelastic::new(&properties.map(T::splat)).expect("valid properties")
}

fn preset<T: Number>() -> Hyperelastic<T> {
    law(PRESETS[0].values.try_into().expect("eleven properties"))
}

fn by_columns(f: &Matrix3<f64>) -> [f64; 9] {
    std::array::from_fn(|c| f[c])
}

/// Every exponent with every combination of what may be left out: shear, failure, its weights.
fn materials(fibre: [f64; 3]) -> Vec<[f64; 11]> {
    let [m_1, m_2, m_3] = fibre;
    let failures = [[0.0, 0.0, 0.0], [0.0458, 0.0, 0.0], [0.0458, 1.8, 0.0], [0.02, 0.7, 1.3]];
    let mut materials = Vec::new();
    for p in [1.2, 1.5, 2.0, 2.2, 3.0, 5.0, 9.0] {
        for k_ld in [0.0, 1.3e9] {
            for [eps_lim, alpha, beta] in failures {
                materials.push([82.341e9, 1.055e9, p, 0.64974e9, k_ld, eps_lim, alpha, beta, m_1, m_2, m_3]);
            }
        }
    }
    materials
}

/// Points of moderate and of large strain, with directions of their own and states of all kinds.
fn ordinary<T: Number>(count: usize) -> Vec<Input<T>> {
    let moderate = deformation(Ranges { i_el: -0.1..0.1, i_tc: -0.4..0.2, i_td: 0.0..0.5, i_ld: 0.0..0.4 });
    let large = deformation(Ranges { i_el: -0.5..0.5, i_tc: -1.5..0.8, i_td: 0.0..2.0, i_ld: 0.0..3.0 });
    let tiny = deformation(Ranges { i_el: -1e-9..1e-9, i_tc: -1e-9..1e-9, i_td: 0.0..1e-9, i_ld: 0.0..1e-9 });
    let latch = prop_oneof![4 => Just(0.0), 1 => Just(1.0)];
    let points = (prop_oneof![3 => moderate, 2 => large, 1 => tiny], prop::array::uniform9(-10.0..10.0), latch);
    let input = |(sample, frozen, latch): (Sample, [f64; 9], f64)| {
        let mut input = Input::fresh(by_columns(&sample.f), sample.m.into());
        for (x, frozen) in input.old.iter_mut().zip(frozen) {
            *x = T::splat(frozen);
        }
        input.old[FAILED] = T::splat(latch);
        input
    };
    samples(points, count).map(input).collect()
}

/// Rest, failing, inverted, singular, astronomical and meaningless gradients, each with states that are fresh, failed
/// before, or not finite.
fn extreme<T: Number>() -> Vec<Input<T>> {
    let least: f64 = T::from_bits(1).into();
    let most = 1.0 / T::MIN_POSITIVE;
    let diagonal = |a, b, c| [a, 0.0, 0.0, 0.0, b, 0.0, 0.0, 0.0, c];
    let mut gradients = vec![REST, diagonal(1.2, 0.9, 1.1), diagonal(1.04, 0.6, 0.9), diagonal(0.9, 1.3, 0.2)];
    gradients.extend([
        diagonal(-1.0, 1.0, 1.0),
        diagonal(-1.0, -1.0, 1.0),
        diagonal(0.0, 1.0, 1.0),
        [0.0; 9],
        [1.0; 9],
    ]);
    for x in [least, T::MIN_POSITIVE, 1e-30, 1e-15, 1e15, 1e30, most] {
        gradients.extend([diagonal(x, x, x), diagonal(x, 1.0, 1.0), diagonal(1.0, 1.0, x), diagonal(1.0 / x, x, 1.0)]);
    }
    for at in 0..9 {
        for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut f = [1.1, 0.1, 0.0, 0.2, 0.9, 0.1, 0.0, -0.1, 1.0];
            f[at] = x;
            gradients.push(f);
        }
    }
    let mut olds = vec![[0.0; HYPERELASTIC_STATE]; 6];
    for (old, latch) in olds.iter_mut().zip([0.0, 1.0, 0.5, 0.499, f64::NAN, f64::INFINITY]) {
        *old = [1.0, 2.0, 3.0, 4.0, 0.1, -0.2, 0.3, 0.4, 1.5, latch, 1.0];
    }
    for at in 0..HYPERELASTIC_STATE {
        let mut old = olds[1];
        old[at] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY][at % 3];
        olds.push(old);
    }
    let mut inputs = Vec::new();
    for (k, &f) in gradients.iter().enumerate() {
        for (j, old) in olds.iter().enumerate() {
            let fibre = [AXIS, [0.0, 0.0, -1.0], [0.6, -1e-3, 0.8], [3e-20, 4e-20, 0.0]][(k + j) % 4];
            inputs.push(Input { old: old.map(T::splat), ..Input::fresh(f, fibre) });
        }
    }
    inputs
}

fn baseline_is_the_scalar_law<T: Number>() {
    let call = Call::<T>::new(Level::Baseline);
    let compare = |inputs: &[Input<T>], found: &[Output], wanted: &[Output]| {
        for ((input, found), wanted) in inputs.iter().zip(found).zip(wanted) {
            assert_eq!(found, wanted, "{input:?}");
        }
    };
    let inputs = [ordinary(100), extreme()].concat();
    for (k, material) in [materials([0.48, -0.6, 0.64]), materials(AXIS)].concat().into_iter().enumerate() {
        let law = law::<T>(material);
        let wanted: Vec<_> = inputs.iter().map(|input| Output::scalar(&law, input, call.density)).collect();
        let (found, worst) = run(&law, &inputs, &Call { gap: k % 3, offset: k % 4, ..call });
        compare(&inputs, &found, &wanted);
        assert_eq!(worst, found.iter().map(|output| output.status).min().expect("points"));
        for asked in Asked::USUAL.into_iter().filter(|asked| asked.failure) {
            let wanted: Vec<_> = wanted.iter().map(|output| output.masked(asked)).collect();
            compare(&ordinary(100), &run(&law, &ordinary(100), &Call { asked, ..call }).0, &wanted);
        }
        // A direction for each point.
        let own = |input: &Input<T>| Output::along(&law, Some(input.fibre), input, call.density);
        let wanted: Vec<_> = inputs.iter().map(own).collect();
        compare(&inputs, &run(&law, &inputs, &Call { fibres: true, ..call }).0, &wanted);
    }
}

#[test]
fn baseline_is_the_scalar_law_f64() {
    baseline_is_the_scalar_law::<f64>();
}

#[test]
fn baseline_is_the_scalar_law_f32() {
    baseline_is_the_scalar_law::<f32>();
}

/// What is measured together, and how many roundings lanes may differ from the scalar law: four; six for the modes,
/// which 1/λ² pulls back whatever the sensitivity is.
fn groups() -> Vec<(&'static str, Range<usize>, f64)> {
    let single = |name, range: Range<usize>| range.map(move |c| (name, c..c + 1, APART));
    let mut groups = vec![("stress", STRESS, APART)];
    groups.extend(single("energy", 6..10).chain(single("invariant", 10..14)));
    groups.extend([("index", INDEX..INDEX + 1, APART), ("wave speed", WAVE_SPEED..VALUES, APART)]);
    groups.extend(MODES.step_by(6).map(|c| ("mode", c..c + 6, 6.0)));
    groups
}

const APART: f64 = 4.0;

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn distance(a: &[f64; VALUES], b: &[f64; VALUES], group: &Range<usize>) -> f64 {
    norm(&group.clone().map(|c| a[c] - b[c]).collect::<Vec<_>>())
}

/// What one rounding of the value and of each entry of F may do to each group: ε (|value| + Σ |F_ij| |∂value/∂F_ij|).
fn roundings<T: Number>(law: &Hyperelastic<f64>, input: &Input<T>) -> Vec<f64> {
    const STEP: f64 = 1e-7;
    let exact =
        Input { f: input.f.map(Into::into), fibre: input.fibre.map(Into::into), old: input.old.map(Into::into) };
    let values = |input: &Input<f64>| Output::scalar(law, input, 1351.4).values::<f64>();
    let here = values(&exact);
    let moved: Vec<_> = (0..18)
        .map(|k| {
            let mut input = exact;
            input.f[k / 2] *= if k % 2 == 0 { 1.0 + STEP } else { 1.0 - STEP };
            values(&input)
        })
        .collect();
    let sensitivity = |group: &Range<usize>| -> f64 {
        let sides =
            moved.chunks(2).map(|sides| distance(&sides[0], &here, group).max(distance(&sides[1], &here, group)));
        sides.sum::<f64>() / STEP
    };
    groups().iter().map(|(_, group, _)| T::ROUNDING * (norm(&here[group.clone()]) + sensitivity(group))).collect()
}

/// Lanes differ from the scalar law by no more than a few roundings of the input. Strains are large against the step of
/// the sensitivity; the truth's cases hold the small ones.
fn lanes_stay_with_the_scalar_law<T: Number>() {
    let strained = |input: &Input<T>| {
        let f = input.deformation_gradient().map(Into::<f64>::into);
        (f.transpose() * f - Matrix3::identity()).norm() > 1e-3
    };
    let inputs: Vec<Input<T>> = ordinary(1000).into_iter().filter(strained).collect();
    assert!(inputs.len() > 500);
    let mut worst = vec![[0.0_f64; Level::ALL.len()]; groups().len()];
    for material in [materials([0.48, -0.6, 0.64]), materials(AXIS)].concat().into_iter().step_by(3) {
        let (law, exact) = (law::<T>(material), law::<f64>(material.map(|x| T::splat(x).into())));
        let allowed: Vec<_> = inputs.iter().map(|input| roundings(&exact, input)).collect();
        for (l, level) in levels().enumerate() {
            let call = Call::<T>::new(level);
            for (i, output) in run(&law, &inputs, &call).0.into_iter().enumerate() {
                let (scalar, input) = (Output::scalar(&law, &inputs[i], call.density), &inputs[i]);
                assert_eq!(output.status, scalar.status, "{level:?} {input:?}");
                let (a, b) = (output.values::<T>(), scalar.values::<T>());
                for (g, (name, group, bound)) in groups().into_iter().enumerate() {
                    let distance = distance(&a, &b, &group);
                    let ratio = if distance == 0.0 { 0.0 } else { distance / allowed[i][g] };
                    worst[g][l] = worst[g][l].max(ratio);
                    if ratio > bound {
                        println!("{level:?}: {name} {group:?} {ratio}, {input:?}, {material:?}");
                    }
                }
                if (b[INDEX] - 1.0).abs() > APART * allowed[i][INDEX_GROUP] {
                    assert_eq!((a[LATCH], a[LATCH + 1]), (b[LATCH], b[LATCH + 1]), "{level:?} {input:?}");
                }
            }
        }
    }
    println!("roundings apart from the scalar law, level by level");
    for ((name, group, bound), worst) in groups().iter().zip(&worst) {
        println!("{name:<12}{:>3} {worst:>6.2?} of {bound}", group.start);
    }
    let within = groups().iter().zip(&worst).all(|((.., bound), worst)| worst.iter().all(|ratio| ratio <= bound));
    assert!(within, "see above");
}

#[test]
fn lanes_stay_with_the_scalar_law_f64() {
    println!("levels of this machine: {:?}", levels().collect::<Vec<_>>());
    lanes_stay_with_the_scalar_law::<f64>();
}

#[test]
fn lanes_stay_with_the_scalar_law_f32() {
    lanes_stay_with_the_scalar_law::<f32>();
}

/// The law as a host calls it that hands over the properties with every point, and the modulus of the Jaumann rate.
fn once(properties: &[f64; 11], input: &Input<f64>) -> (Point<f64>, [f64; 21]) {
    let mut tangent = [[f64::NAN; 6]; 6];
    let mut answers =
        [Point { stress: [0.0; 6], state: input.old, modes: [[0.0; 6]; 4], wave_modulus: 0.0, status: 0 }; 2];
    for (point, with_tangent) in answers.iter_mut().zip([true, false]) {
        let (stress, state) = (point.stress.as_mut_ptr(), point.state.as_mut_ptr());
        let arguments = point_and_block::Point {
            measure: constants::TORON_TANGENT_JAUMANN,
            deformation_gradient: input.f.as_ptr(),
            state_old: input.old.as_ptr(),
            state_new: state,
            stress,
            tangent: if with_tangent { tangent.as_mut_ptr().cast() } else { null_mut() },
            ..point_and_block::Point::empty()
        };
        // SAFETY: eleven properties and state variables, nine entries of F, six stresses, 36 moduli.
        unsafe {
            point.status = status_of(points::hyperelastic_point(&properties[..], &arguments));
            check_prepared(properties, &arguments, point);
        }
    }
    // Without the tangent the answer is the same.
    let [point, alone] = answers;
    assert_eq!(bits(&alone), bits(&point), "{input:?}");
    let triangle = (0..6).flat_map(|row| tangent[row][row..].to_vec()).collect::<Vec<_>>();
    (point, triangle.try_into().expect("the upper triangle"))
}

/// A status, or the code of what is wrong with the call.
fn status_of(answer: Result<i32, Error>) -> i32 {
    answer.unwrap_or_else(|error| error.code())
}

/// With the law prepared once, the results are those of the call with properties, to four roundings of F.
///
/// # Safety
/// The arrays are those of one point.
unsafe fn check_prepared(properties: &[f64; 11], arguments: &point_and_block::Point<f64>, point: &Point<f64>) {
    let (mut stress, mut state) = ([0.0; 6], [0.0; 11]);
    let again = point_and_block::Point { state_new: state.as_mut_ptr(), stress: stress.as_mut_ptr(), ..*arguments };
    let law = Hyperelastic::new(properties).map(|law| PreparedHyperelastic::from(&law));
    // SAFETY: as the caller promises.
    let answer = law.and_then(|law| unsafe { points::hyperelastic_point(&law, &again) });
    assert_eq!(status_of(answer), point.status);
    let prepared = Point { stress, state, ..*point };
    assert_eq!(bits(&prepared).0[..14], bits(point).0[..14], "stress, energies and invariants");
    let difference = (state[FAILURE_INDEX] - point.state[FAILURE_INDEX]).abs();
    assert!(difference <= 4.0 * f64::EPSILON * point.state[FAILURE_INDEX].abs(), "failure index: {difference}");
}

/// Stress and state, whose zeros may differ in sign.
fn bits(point: &Point<f64>) -> (Vec<u64>, i32) {
    ([&point.stress[..], &point.state].concat().iter().map(|x| (x + 0.0).to_bits()).collect(), point.status)
}

/// The same of the scalar law.
fn plain(law: &Hyperelastic<f64>, input: &Input<f64>) -> (Point<f64>, [f64; 21]) {
    let f = std::array::from_fn(|j| std::array::from_fn(|i| input.f[3 * j + i]));
    let request = Request::STRESS_AND_STATE;
    let (point, moduli) = law.point_with_moduli(&f, None, &input.old, request, Measure::Jaumann);
    (point, moduli.0)
}

/// Stress, energies one by one, invariants one by one, index and DDSDDE.
fn parts((point, moduli): &(Point<f64>, [f64; 21])) -> Vec<Vec<f64>> {
    let single = point.state[..FAILED].iter().map(|&x| vec![x]);
    [point.stress.to_vec()].into_iter().chain(single).chain([moduli.to_vec()]).collect()
}

/// A single point with fused multiply-add differs from the scalar law as lanes do.
#[test]
fn one_point_stays_with_the_scalar_law() {
    const STEP: f64 = 1e-7;
    let strained = |input: &Input<f64>| {
        let f = input.deformation_gradient();
        (f.transpose() * f - Matrix3::identity()).norm() > 1e-3
    };
    let inputs: Vec<Input<f64>> = ordinary(400).into_iter().filter(strained).collect();
    assert!(inputs.len() > 200);
    let mut worst = [0.0_f64; 11];
    let differ = |a: &[f64], b: &[f64]| norm(&a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<_>>());
    for material in [materials([0.48, -0.6, 0.64]), materials(AXIS)].concat().into_iter().step_by(3) {
        let law = law::<f64>(material);
        for input in &inputs {
            let (found, wanted) = (once(&material, input), plain(&law, input));
            assert_eq!(found.0.status, wanted.0.status, "{input:?}");
            let mut sensitivity = [0.0; 11];
            for entry in 0..9 {
                let moved = [1.0 + STEP, 1.0 - STEP].map(|factor| {
                    let mut input = *input;
                    input.f[entry] *= factor;
                    parts(&plain(&law, &input))
                });
                for (g, wanted) in parts(&wanted).iter().enumerate() {
                    sensitivity[g] += moved.iter().map(|moved| differ(&moved[g], wanted)).fold(0.0, f64::max) / STEP;
                }
            }
            for (g, (found, wanted)) in parts(&found).iter().zip(parts(&wanted)).enumerate() {
                let distance = differ(found, &wanted);
                let allowed = f64::ROUNDING * (norm(&wanted) + sensitivity[g]);
                worst[g] = worst[g].max(if distance == 0.0 { 0.0 } else { distance / allowed });
            }
        }
    }
    println!("roundings apart: stress, energies, invariants, index, DDSDDE: {worst:.2?}");
    assert!(worst.iter().all(|&ratio| ratio <= APART), "{worst:?}");
}

/// Whatever comes in, a single point gives finite numbers and a code that the scalar law has nearby; no stiffness with
/// an error or after a failure.
#[test]
fn one_point_gives_a_status_and_no_nan() {
    let mut seen = std::collections::BTreeSet::new();
    for material in [materials([0.48, -0.6, 0.64]), materials(AXIS)].concat().into_iter().step_by(5) {
        let law = law::<f64>(material);
        for input in [ordinary(50), extreme()].concat() {
            let (point, moduli) = once(&material, &input);
            seen.insert(point.status);
            let numbers = [&point.stress[..], &point.state, &moduli].concat();
            assert!(numbers.iter().all(|x| x.is_finite()), "{point:?} from {input:?}");
            assert!(could_be(&law, &input, false, point.status), "{point:?} from {input:?}");
            let carries = input.old[FAILED] < 0.5 && point.status == status::OK;
            assert!(carries || point.stress.iter().chain(&moduli).all(|&x| x == 0.0), "{point:?} from {input:?}");
        }
    }
    let all = [status::OK, status::INVERTED, status::NOT_FINITE, status::OVERFLOW, status::STATE_NOT_FINITE];
    assert!(all.iter().all(|code| seen.contains(code)), "{seen:?}");
}

/// Cases of the truth at every level, by their own measure.
fn truth<T: Number>(cases: Vec<Case>, epsilon: f64, flag_margin: f64, bounds: &Bounds) -> Vec<(Level, Score)> {
    let at_level = |level: Level| {
        let mut score = Score::new(epsilon, flag_margin);
        for case in &cases {
            let input = Input::<T>::fresh(by_columns(&case.deformation_gradient()), case.m);
            // Alone and amid others, by the general kernel and by one of the special ones.
            let inputs = vec![input; 1 + 20 * (case.id % 2)];
            let asked = if case.id % 3 == 0 { Asked::USUAL[0] } else { Asked::ALL };
            let call = Call { asked, fibres: case.id % 5 == 0, ..Call::<T>::new(level) };
            let (outputs, worst) = run(&law(case.properties()), &inputs, &call);
            assert_eq!(worst, status::OK, "case {}", case.id);
            let v = outputs[0].values::<T>();
            score.add(
                case,
                &Answer {
                    stress: std::array::from_fn(|c| v[c]),
                    energies: std::array::from_fn(|c| v[6 + c]),
                    invariants: std::array::from_fn(|c| v[10 + c]),
                    modes: asked.modes.then(|| std::array::from_fn(|m| std::array::from_fn(|c| v[17 + 6 * m + c]))),
                    failed: v[LATCH] == 1.0,
                },
            );
        }
        println!("{}, {} bits\n{score}", level.name(), 8 * size_of::<T>());
        score.assert_within(bounds, level.name());
        (level, score)
    };
    levels().map(at_level).collect()
}

#[test]
fn truth_f64() {
    for (level, score) in truth::<f64>(cases(), f64::EPSILON / 2.0, 0.0, &DOUBLE) {
        for category in ["small", "degenerate"] {
            let forward = score.worst[category].forward;
            assert!(forward <= 2e-15, "{level:?} {category}: relative error {forward}");
        }
        for category in ["small", "degenerate", "moderate", "failure", "units", "fibre_direction"] {
            let modes = score.worst[category].modes;
            assert!(modes <= 1e-12, "{level:?} {category}: modes {modes}");
        }
    }
}

#[test]
fn truth_f32() {
    truth::<f32>(cases(), 6e-8, 1e-6, &SINGLE);
}

/// The cases where sums over F cancel.
#[test]
fn truth_far_from_the_reference() {
    truth::<f64>(far_cases(), f64::EPSILON / 2.0, 0.0, &FAR_DOUBLE);
    let single: Vec<_> = far_cases().into_iter().filter(Case::fits_single_precision).collect();
    assert!(single.len() > 50, "{}", single.len());
    truth::<f32>(single, 6e-8, 1e-6, &FAR_SINGLE);
}

/// Whatever the number of points, their leading dimension, place and neighbours: the bits of the point on its own.
fn place_does_not_matter<T: Number>([m_1, m_2, m_3]: [f64; 3]) {
    let law = law::<T>([82.341e9, 1.055e9, 2.2, 0.64974e9, 1e9, 0.0458, 1.8, 0.3, m_1, m_2, m_3]);
    let far = far_cases();
    let far = far.iter().filter(|case| case.fits_single_precision());
    let far: Vec<_> = far.map(|case| Input::fresh(by_columns(&case.deformation_gradient()), case.m)).collect();
    let mut pool = [ordinary(160), extreme(), far].concat();
    // Ordinary and extreme points side by side.
    let count = pool.len();
    pool = (0..count).map(|i| pool[i * 101 % count]).collect();
    assert_ne!(count % 101, 0);
    for level in levels() {
        for (k, asked) in Asked::USUAL.into_iter().chain([Asked::ALL]).enumerate() {
            let call = Call { asked, fibres: k % 2 == 1, ..Call::<T>::new(level) };
            let alone: Vec<_> = pool.iter().map(|&input| run(&law, &[input], &call).0[0]).collect();
            let mut first = 0;
            // More than a full group of registers of any width and two of most.
            for n in (0..=70).chain([95, 96, 97, 103, 112, 113, 127, 192, 193]) {
                for gap in 0..=9 {
                    if first + n > count {
                        first = 0;
                    }
                    let inputs = &pool[first..first + n];
                    let call = Call { gap, offset: (n + gap) % 8, ..call };
                    let (found, worst) = run(&law, inputs, &call);
                    assert_eq!(found, alone[first..first + n], "{n} points from {first}, {call:?}");
                    if asked.status {
                        assert_eq!(worst, found.iter().map(|output| output.status).min().unwrap_or(status::OK));
                    }
                    first += n;
                }
            }
        }
    }
}

#[test]
fn place_does_not_matter_f64() {
    place_does_not_matter::<f64>([0.48, -0.6, 0.64]);
    place_does_not_matter::<f64>(AXIS);
}

#[test]
fn place_does_not_matter_f32() {
    place_does_not_matter::<f32>([0.48, -0.6, 0.64]);
    place_does_not_matter::<f32>(AXIS);
}

/// F = diag(1, 1, J) for J with mantissas of all ones and of one, less and more by so many units in the last place:
/// where reciprocals that are not divided may be rounded otherwise.
fn hard_volumes<T: Number>() -> Vec<Input<T>> {
    let ulp = 2.0 * T::ROUNDING;
    let volumes =
        (0..64).flat_map(|k| [2.0 - f64::from(k + 1) * ulp, 1.0 + f64::from(k) * ulp, 1.0 - f64::from(k) * ulp / 2.0]);
    volumes.map(|j| Input::fresh([1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, j], AXIS)).collect()
}

/// Every level with fused multiply-add gives the same bits: the answer does not depend on the processor. What this
/// machine's does not have is left out; `reciprocals` in `src/law/tests/elementary.rs` are checked for all of them.
fn fused_levels_agree<T: Number>() {
    let law = law::<T>([82.341e9, 1.055e9, 2.2, 0.64974e9, 1e9, 0.0458, 1.8, 0.3, 0.48, -0.6, 0.64]);
    let truth: Vec<_> = cases().into_iter().chain(far_cases()).collect();
    let truth = truth.iter().map(|case| Input::fresh(by_columns(&case.deformation_gradient()), case.m));
    let inputs: Vec<Input<T>> = [ordinary(160), extreme(), hard_volumes()].concat().into_iter().chain(truth).collect();
    let fused: Vec<_> = levels().filter(|&level| level > Level::Baseline).collect();
    println!("levels with fused arithmetic here: {fused:?}");
    for asked in Asked::USUAL.into_iter().chain([Asked::ALL]) {
        for fibres in [false, true] {
            let answers =
                fused.iter().map(|&level| run(&law, &inputs, &Call { asked, fibres, ..Call::<T>::new(level) }).0);
            let answers: Vec<_> = answers.collect();
            for (level, answer) in fused.iter().zip(&answers).skip(1) {
                for ((one, other), input) in answers[0].iter().zip(answer).zip(&inputs) {
                    assert_eq!(one, other, "{:?} and {level:?}: {input:?}", fused[0]);
                }
            }
        }
    }
}

#[test]
fn fused_levels_agree_f64() {
    fused_levels_agree::<f64>();
}

#[test]
fn fused_levels_agree_f32() {
    fused_levels_agree::<f32>();
}

/// Points that fail, have failed or cannot be evaluated, among good ones: each has its own code, and none disturbs
/// another.
fn bad_points_keep_to_themselves<T: Number>() {
    let law = preset::<T>();
    let good = Input::<T>::fresh([1.01, 0.1, 0.0, 0.2, 0.8, 0.1, 0.0, -0.1, 0.9], AXIS);
    let frozen = [1.0, 2.0, 3.0, 4.0, 0.1, -0.2, 0.3, 0.4, 1.5, 1.0, 0.0].map(T::splat);
    let with = |at: usize, x: f64| {
        let mut old = frozen;
        old[at] = T::splat(x);
        old
    };
    let gradient = |f: [f64; 9]| Input::<T>::fresh(f, AXIS);
    let inverted = [-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let bad = [
        (gradient([1.2, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]), status::OK, 1.0),
        (Input { old: frozen, ..good }, status::OK, 1.0),
        (gradient(inverted), status::INVERTED, 0.0),
        (gradient([0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]), status::INVERTED, 0.0),
        (gradient([1.0, f64::NAN, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]), status::NOT_FINITE, 0.0),
        (gradient([1.0, 0.0, 0.0, 0.0, f64::INFINITY, 0.0, 0.0, 0.0, 1.0]), status::NOT_FINITE, 0.0),
        (Input { fibre: [T::default(); 3], ..good }, status::FIBRE_DIRECTION, 0.0),
        (Input { fibre: [T::splat(f64::NAN); 3], ..good }, status::FIBRE_DIRECTION, 0.0),
        (Input { old: with(FAILED, f64::NAN), ..good }, status::STATE_NOT_FINITE, 1.0),
        (Input { old: with(0, f64::NAN), ..good }, status::STATE_NOT_FINITE, 1.0),
        (Input { old: with(6, f64::INFINITY), ..good }, status::STATE_NOT_FINITE, 1.0),
        (Input { old: with(8, f64::NEG_INFINITY), ..gradient(inverted) }, status::STATE_NOT_FINITE, 1.0),
        (Input { old: frozen, ..gradient(inverted) }, status::OK, 1.0),
    ];
    for level in levels() {
        for asked in [Asked::ALL, Asked::USUAL[0]] {
            let call = Call { asked, fibres: true, ..Call::<T>::new(level) };
            let undisturbed = run(&law, &[good], &call).0[0];
            for (k, (input, code, failed)) in bad.iter().enumerate() {
                for at in 0..19 {
                    let mut inputs = [good; 19];
                    inputs[at] = *input;
                    let (outputs, worst) = run(&law, &inputs, &call);
                    let found = outputs[at];
                    assert_eq!((found.status, worst), (*code, *code), "bad point {k} at {at}, {call:?}");
                    let v = found.values::<T>();
                    assert_eq!((v[LATCH], v[LATCH + 1]), (*failed, 1.0 - failed), "bad point {k} at {at}, {call:?}");
                    // All but the first carry nothing and keep what is finite of their state.
                    if k > 0 {
                        assert!(STRESS.chain(MODES).all(|c| v[c] == 0.0), "bad point {k} at {at}, {call:?}");
                        let old = input.old.map(Into::into);
                        let kept = |x: f64| if x.is_finite() { x } else { 0.0 };
                        assert!((0..9).all(|c| v[6 + c] == kept(old[c])), "bad point {k} at {at}, {call:?}");
                    } else {
                        assert!(v[0] > 1e9 && v[INDEX] > 1.0, "the stress is intact in the call that detects failure");
                    }
                    let others = outputs.iter().enumerate().filter(|&(i, _)| i != at);
                    assert!(
                        others.into_iter().all(|(_, output)| *output == undisturbed),
                        "point {k} at {at}, {call:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn bad_points_keep_to_themselves_f64() {
    bad_points_keep_to_themselves::<f64>();
}

#[test]
fn bad_points_keep_to_themselves_f32() {
    bad_points_keep_to_themselves::<f32>();
}

/// Every combination of outputs, with the old state in place, apart or absent: the bits of the full request.
///
/// A point whose failure is not asked for does not fail. What is not asked for is not looked at: neither an overflow
/// nor an old value that is not finite is noticed there.
fn any_combination_of_outputs<T: Number>(k_ld: f64, [m_1, m_2, m_3]: [f64; 3]) {
    let law = law::<T>([82.341e9, 1.055e9, 2.2, 0.64974e9, k_ld, 0.0458, 1.8, 0.3, m_1, m_2, m_3]);
    let inputs = [ordinary(30), extreme()].concat();
    let forget = |input: &Input<T>, latch_too: bool| {
        let mut input = *input;
        input.old[FAILED] = if latch_too { T::default() } else { input.old[FAILED] };
        input
    };
    for level in levels() {
        for bits in 0..128 {
            let asked = Asked::from_bits(bits);
            for old in [Old::InPlace, Old::Apart, Old::Null] {
                let call = Call { asked, old, fibres: bits % 3 == 0, ..Call::<T>::new(level) };
                // In place, a failure that is not asked for has no old latch either.
                let no_latch = old == Old::InPlace && !asked.failure;
                let seen: Vec<_> = inputs.iter().map(|input| forget(input, no_latch)).collect();
                let full = run(
                    &law,
                    &seen,
                    &Call { asked: Asked::ALL, old: if old == Old::Null { old } else { Old::Apart }, ..call },
                )
                .0;
                let (found, _) = run(&law, &seen, &call);
                for ((input, full), found) in seen.iter().zip(&full).zip(&found) {
                    if full.status == status::OVERFLOW {
                        continue;
                    }
                    let mut wanted = full.masked(asked);
                    let partly = full.status == status::STATE_NOT_FINITE && old != Old::Null;
                    if partly && asked.status && unnoticed(input, asked) {
                        wanted.status = status::OK;
                    }
                    assert_eq!(*found, wanted, "{input:?}, {call:?}");
                }
            }
        }
    }
}

/// Whether all that is not finite in the old state belongs to what is not asked for.
fn unnoticed<T: Number>(input: &Input<T>, asked: Asked) -> bool {
    let finite = |range: Range<usize>| input.old[range].iter().all(|&x| Into::<f64>::into(x).is_finite());
    finite(FAILED..FAILED + 1)
        && (!asked.energies || finite(0..4))
        && (!asked.invariants || finite(4..8))
        && (!asked.failure || finite(8..9))
}

#[test]
fn any_combination_of_outputs_f64() {
    any_combination_of_outputs::<f64>(0.0, [0.48, -0.6, 0.64]);
    any_combination_of_outputs::<f64>(1e9, AXIS);
}

#[test]
fn any_combination_of_outputs_f32() {
    any_combination_of_outputs::<f32>(0.0, [0.48, -0.6, 0.64]);
    any_combination_of_outputs::<f32>(1e9, AXIS);
}

/// Properties at their bounds: what does not fit the number is an overflow, whatever outputs are asked for, and nothing
/// of it leaves.
fn greatest_properties<T: Number>() {
    let section = |x: f64| Input::<T>::fresh([1.0, 0.2, 0.1, 0.1 * x, x, 0.0, 0.0, 0.0, x], AXIS);
    let inputs: Vec<_> = [0.9, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 2.0, 100.0].map(section).into();
    let cases = [1.000_001, 1.2, 2.0, 17.0, 40.0].into_iter().flat_map(|p| [(p, 0.0), (p, 1e25)]);
    for (p, k_ld) in cases {
        let law = law::<T>([1e25, 1e25, p, 1e25, k_ld, 1e25, 1e25, 1e25, 1.0, 0.0, 0.0]);
        for level in levels() {
            for bits in 64..128 {
                let asked = Asked::from_bits(bits);
                let (outputs, _) = run(&law, &inputs, &Call { asked, ..Call::new(level) });
                for (output, input) in outputs.iter().zip(&inputs) {
                    let v = output.values::<T>();
                    assert!(v.iter().all(|x| x.is_finite()), "{v:?} from {input:?}, p = {p}, {level:?} {asked:?}");
                    assert!([status::OK, status::OVERFLOW].contains(&output.status), "{output:?} from {input:?}");
                }
                if size_of::<T>() == 8 || p == 1.2 {
                    assert_eq!(outputs[0].status, status::OK, "p = {p}, {level:?} {asked:?}");
                }
            }
        }
    }
}

#[test]
fn greatest_properties_f64() {
    greatest_properties::<f64>();
}

#[test]
fn greatest_properties_f32() {
    greatest_properties::<f32>();
}

/// Whatever the stiffnesses, from 0 to their bounds, and however far the columns of F are from 1, to the ends of the
/// range: a stress that is not finite has a status.
fn any_stiffness<T: Number>() {
    let mut random = fastrand::Rng::with_seed(7);
    let size = if size_of::<T>() == 8 { 52.0 } else { 9.0 };
    let mut power = |most: f64| 10f64.powf(most * (2.0 * random.f64() - 1.0));
    // Two of 6e7 points of a search with k_td = 1e10: both transverse stretches near the least ones.
    let mut inputs = vec![
        Input::<T>::fresh([1.0, 0.0, 0.0, 0.0, 1.1e-50, 0.0, 0.0, 0.0, 1.2e-50], AXIS),
        Input::<T>::fresh([1.0, 0.0, 0.0, 0.0, 1.1e-45, 0.0, 0.0, 0.0, 1.2e-45], AXIS),
    ];
    for _ in 0..600 {
        let [a, b, c] = [power(size), power(size), power(size)];
        // A section of about equal sides, and one of any; sheared and not.
        let c = if power(1.0) < 1.0 { b * power(0.5) } else { c };
        let [x, y, z] = [a * power(20.0), a * power(20.0), b * power(20.0)].map(|x| if x > b { 0.0 } else { x });
        inputs.push(Input::fresh([a, 0.0, 0.0, x, b, 0.0, y, z, c], AXIS));
        // And at the least and the greatest squares of the range.
        let edge = (if size > 10.0 { 1e45_f64 } else { 1e5 }) * power(0.3);
        inputs.push(Input::fresh([power(1.0), 0.0, 0.0, 0.0, 1.0 / edge, 0.0, 0.0, 0.0, 1.1 / edge], AXIS));
        inputs.push(Input::fresh([1.0 / edge, 0.0, 0.0, 0.0, power(1.0), 0.0, 0.0, 0.0, power(1.0)], AXIS));
    }
    for round in 0..24 {
        let mut stiffness = || match round % 4 {
            0 => 1e25,
            1 => 0.0,
            _ => power(25.0).min(1e25),
        };
        let [k_el, k_tc, k_td] = [stiffness(), stiffness(), stiffness()];
        let [k_td, k_ld] = [if round % 4 == 1 { 1e10 } else { k_td }, if round % 3 == 0 { stiffness() } else { 0.0 }];
        let p = [1.000_001, 1.5, 2.2, 7.0, 40.0][round % 5];
        let fibre = if round % 2 == 0 { AXIS } else { [0.48, -0.6, 0.64] };
        let law = law::<T>([k_el, k_tc, p, k_td, k_ld, 0.0458, 1.8, 0.5, fibre[0], fibre[1], fibre[2]]);
        for level in levels() {
            for asked in Asked::USUAL.into_iter().chain([Asked::ALL]) {
                let (outputs, _) = run(&law, &inputs, &Call { asked, ..Call::new(level) });
                for (output, input) in outputs.iter().zip(&inputs) {
                    let (v, code) = (output.values::<T>(), output.status);
                    let valid = [status::OK, status::OVERFLOW, status::INVERTED].contains(&code);
                    assert!(
                        valid && v.iter().all(|x| x.is_finite()),
                        "{code}, {v:?} from {input:?}, k_td = {k_td:e}, {level:?} {asked:?}"
                    );
                }
            }
        }
        for input in &inputs {
            let point = law.point(&input.deformation_gradient(), &input.old, Request::STRESS_AND_STATE);
            let valid = [status::OK, status::OVERFLOW, status::INVERTED].contains(&point.status);
            let finite = point.stress.iter().chain(&point.state).all(|&x| x.into().is_finite());
            assert!(valid && finite, "{point:?} from {input:?}, k_td = {k_td:e}");
        }
    }
}

#[test]
fn any_stiffness_f64() {
    any_stiffness::<f64>();
}

#[test]
fn any_stiffness_f32() {
    any_stiffness::<f32>();
}

/// The columns of F almost multiples of one another, so that the section's vectors may cancel to nothing while det F
/// does not: whatever is asked for, no NaN leaves.
fn almost_parallel_images<T: Number>() {
    let mut random = fastrand::Rng::with_seed(11);
    let by_hand = [
        [3.0, 1.0 / 7.0, 0.0, 0.03, 0.01 / 7.0, 0.0, 0.0, 0.0, 1.0],
        [8.0, 12.0, -4.0, -2.0, -3.0, 1.0, 2.0, 1.862645815364772e-9, -6.103515625e-5],
        [15.0, 10.0, 15.0, 5.551115123125783e-17, 0.0, 0.0, -3.0, -1.9992675781248863, -3.0],
        [0.58620691, 3.2857144, 1.6923077, 17586.207, 98571.43, 50769.23, 164137.94, 920000.0, 473846.16],
    ];
    let mut ratio = |most: u32| f64::from(random.u32(1..most)) / f64::from(random.u32(1..most));
    let mut any = || {
        let c1 = [ratio(20), ratio(20), ratio(20)];
        let [s2, s3] = [ratio(9), ratio(9)].map(|s| s * ratio(9).powi(8));
        let off = 1.0 + T::ROUNDING * (ratio(5) - 1.0);
        std::array::from_fn(|c| [1.0, s2, s3][c / 3] * c1[c % 3] * if c == 4 || c == 8 { off } else { 1.0 })
    };
    let gradients: Vec<[f64; 9]> = by_hand.into_iter().chain((0..4000).map(|_| any())).collect();
    for fibre in [AXIS, [-4.0, 1.0, 0.0], [-4.0, 4.0, 0.0], [1.0, 2.0, -3.0]] {
        let inputs: Vec<Input<T>> = gradients.iter().map(|&f| Input::fresh(f, fibre)).collect();
        for k_ld in [0.0, 1e9] {
            let [m_1, m_2, m_3] = fibre;
            let law = law::<T>([82341.0, 1055.0, 2.2, 649.74, k_ld, 0.0458, 1.8, 0.5, m_1, m_2, m_3]);
            for level in levels() {
                let requests = [Asked::ALL, Asked::from_bits(64 + 6)].into_iter().chain(Asked::USUAL);
                for (asked, fibres) in requests.flat_map(|asked| [(asked, false), (asked, true)]) {
                    let (outputs, _) = run(&law, &inputs, &Call { asked, fibres, ..Call::new(level) });
                    for (output, input) in outputs.iter().zip(&inputs) {
                        let v = output.values::<T>();
                        assert!(v.iter().all(|x| x.is_finite()), "{v:?} from {input:?}, {level:?} {asked:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn almost_parallel_images_f64() {
    almost_parallel_images::<f64>();
}

#[test]
fn almost_parallel_images_f32() {
    almost_parallel_images::<f32>();
}

/// Arrays of a block of `n` points, as long as they must be.
struct Owned<T> {
    gradient: Vec<T>,
    fibre: Vec<T>,
    stress: Vec<T>,
    energies: Vec<T>,
    invariants: Vec<T>,
    failure: Vec<T>,
    modes: Vec<T>,
    wave_speed: Vec<T>,
    status: Vec<i32>,
}

impl<T: Number> Owned<T> {
    fn new(inputs: &[Input<T>], stride: usize) -> Self {
        let n = inputs.len();
        let filled = |components: usize, value: &dyn Fn(&Input<T>, usize) -> T| {
            let mut array = vec![T::default(); (components - 1) * stride + n];
            for (i, input) in inputs.iter().enumerate() {
                for c in 0..components {
                    array[c * stride + i] = value(input, c);
                }
            }
            array
        };
        let zero = |_: &Input<T>, _| T::default();
        Owned {
            gradient: filled(9, &|input, c| input.f[c]),
            fibre: filled(3, &|input, c| input.fibre[c]),
            stress: filled(6, &zero),
            energies: filled(4, &|input, c| input.old[c]),
            invariants: filled(4, &|input, c| input.old[4 + c]),
            failure: filled(3, &|input, c| input.old[8 + c]),
            modes: filled(24, &zero),
            wave_speed: filled(1, &zero),
            status: vec![0; n],
        }
    }

    fn arrays(&mut self, n: usize, stride: usize) -> Arrays<'_, T> {
        Arrays {
            n,
            leading_dimension: stride,
            deformation_gradient: &self.gradient,
            fibre: Some(&self.fibre),
            density: T::splat(1351.4),
            stress: Some(&mut self.stress),
            energies: Some(&mut self.energies),
            invariants: Some(&mut self.invariants),
            failure: Some(&mut self.failure),
            modes: Some(&mut self.modes),
            wave_speed: Some(&mut self.wave_speed),
            status: Some(&mut self.status),
            ..Arrays::default()
        }
    }
}

/// Slices give what pointers give, at the best level unless another is named; a level beyond the machine is the best
/// too.
#[test]
fn slices() {
    let (law, inputs, stride) = (preset::<f64>(), ordinary(37), 41);
    for level in [None, Some(Level::Avx512)].into_iter().chain(levels().map(Some)) {
        let used = level.map_or(Level::best(), |level| level.min(Level::best()));
        let (wanted, worst) = run(&law, &inputs, &Call { fibres: true, ..Call::new(used) });
        let mut owned = Owned::new(&inputs, stride);
        assert_eq!(law.block(Arrays { level, ..owned.arrays(37, stride) }), Ok(worst));
        for (i, wanted) in wanted.iter().enumerate() {
            let rows = [(&owned.stress, 6), (&owned.energies, 4), (&owned.invariants, 4), (&owned.failure, 3)];
            let rows = rows.into_iter().chain([(&owned.modes, 24), (&owned.wave_speed, 1)]);
            let found = rows.flat_map(|(array, count)| (0..count).map(move |c| array[c * stride + i].bits()));
            assert!(found.eq(wanted.bits), "point {i}, {level:?}");
            assert_eq!(owned.status[i], wanted.status);
        }
    }
}

/// What is too short is named, with the length that it needs; a refused call writes nothing.
#[test]
fn refused_calls() {
    let (law, inputs, stride) = (preset::<f64>(), ordinary::<f64>(5), 7);
    let refused = |change: &dyn Fn(&mut Arrays<'_, f64>)| {
        let mut owned = Owned::new(&inputs, stride);
        let mut arrays = owned.arrays(5, stride);
        change(&mut arrays);
        let error = law.block(arrays).expect_err("a refusal");
        assert!(owned.stress.iter().chain(&owned.modes).all(|&x| x == 0.0), "{error}");
        error
    };
    // Drops the last entry of an array of components.
    macro_rules! short {
        ($($field:ident: $components:expr),*) => {$(
            let error = refused(&|arrays| {
                let array = arrays.$field.take().expect("an array");
                let length = array.len() - 1;
                arrays.$field = Some(&mut array[..length]);
            });
            let what = concat!("entries of ", stringify!($field));
            let wanted = ($components - 1) * 7 + 5;
            assert_eq!(error, Error::Count { code: status::BAD_COUNT, what, found: wanted - 1, wanted });
            assert!(error.to_string().contains(what));
        )*};
    }
    short!(stress: 6, energies: 4, invariants: 4, failure: 3, modes: 24, wave_speed: 1, status: 1);
    let error = refused(&|arrays| arrays.deformation_gradient = &arrays.deformation_gradient[1..]);
    let what = "entries of deformation_gradient";
    assert_eq!(error, Error::Count { code: status::BAD_COUNT, what, found: 60, wanted: 61 });
    let error = refused(&|arrays| arrays.fibre = arrays.fibre.map(|fibre| &fibre[1..]));
    assert_eq!(error, Error::Count { code: status::BAD_COUNT, what: "entries of fibre", found: 18, wanted: 19 });

    let error = refused(&|arrays| arrays.leading_dimension = 4);
    let what = "leading dimension";
    assert_eq!(error, Error::Count { code: status::BAD_LEADING_DIMENSION, what, found: 4, wanted: 5 });
    assert_eq!(refused(&|arrays| arrays.leading_dimension = 0).code(), status::BAD_LEADING_DIMENSION);
    // Lengths that no array has, whose product no integer holds.
    assert_eq!(refused(&|arrays| arrays.leading_dimension = usize::MAX / 2).code(), status::BAD_COUNT);
    assert_eq!(refused(&|arrays| arrays.n = usize::MAX).code(), status::BAD_COUNT);

    for density in [0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -0.0, 5e-324] {
        let error = refused(&|arrays| arrays.density = density);
        assert_eq!(error.code(), status::BAD_ARGUMENT);
        assert!(error.to_string().contains("density"), "{error}");
        // Nobody asks for it where the wave speed is not wanted.
        let mut owned = Owned::new(&inputs, stride);
        let worst = law.block(Arrays { density, wave_speed: None, ..owned.arrays(5, stride) });
        assert_eq!(worst, Ok(status::OK));
    }
}

#[test]
fn a_null_gradient_is_refused_and_no_points_are_none() {
    let law = preset::<f64>();
    let mut owned = Owned::new(&ordinary::<f64>(3), 3);
    let empty =
        Arrays { n: 0, deformation_gradient: &[], stress: Some(&mut []), status: Some(&mut []), ..Arrays::default() };
    assert_eq!(law.block(empty), Ok(status::OK));
    let stress = toron::law::block::components_mut(owned.stress.as_mut_ptr(), 3);
    for missing in 0..9 {
        let mut f_new = toron::law::block::components(owned.gradient.as_ptr(), 3);
        f_new[missing] = std::ptr::null();
        let block = Points { f_new, stress, ..Points::without_arrays(3, 3) };
        // SAFETY: each pointer is null or has three values a component.
        assert_eq!(unsafe { law.step(&block) }, Err(Error::Null { name: "f_new" }));
        assert!(owned.stress.iter().all(|&x| x == 0.0));
    }
}

/// A number of any bits, the meaningless ones no rarer than the others.
fn any_number<T: Number>() -> impl Strategy<Value = T> {
    let special = [0.0, -0.0, 1.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e-300, 1e300];
    prop_oneof![
        4 => any::<u64>().prop_map(|bits| T::from_bits(bits >> (64 - 8 * size_of::<T>()))),
        2 => prop::sample::select(special.to_vec()).prop_map(T::splat),
        6 => (-2.0..2.0).prop_map(T::splat),
    ]
}

/// A point of any numbers: nine, three, eleven.
fn any_input<T: Number>() -> impl Strategy<Value = Input<T>> {
    let numbers = prop::collection::vec(any_number::<T>(), 23);
    let state = prop::sample::select(vec![0.0, 1.0]);
    (numbers, any::<bool>(), state).prop_map(|(x, usual_latch, latch)| {
        let mut input = Input {
            f: std::array::from_fn(|c| x[c]),
            fibre: std::array::from_fn(|c| x[9 + c]),
            old: std::array::from_fn(|c| x[12 + c]),
        };
        if usual_latch {
            input.old[FAILED] = T::splat(latch);
        }
        input
    })
}

/// Any properties that the law accepts, and any density.
fn any_law<T: Number>() -> impl Strategy<Value = (Hyperelastic<T>, T)> {
    let numbers = prop::collection::vec(any_number::<T>(), 12);
    numbers.prop_filter_map("refused properties", |x| {
        let density = x[11];
        // Within the bounds: what is larger or meaningless becomes the greatest value.
        let within =
            |x: T, least: f64, most: f64| T::splat(Into::<f64>::into(Real::abs(x)).clamp(least, most).min(most));
        let mut properties: [T; 11] = std::array::from_fn(|c| if c < 8 { within(x[c], 0.0, 9e24) } else { x[c] });
        properties[2] = within(properties[2], 1.001, 40.0);
        let positive = Into::<f64>::into(density) >= T::MIN_POSITIVE && Into::<f64>::into(density) < f64::INFINITY;
        Hyperelastic::new(&properties).ok().filter(|_| positive).map(|law| (law, density))
    })
}

/// Whether the scalar law gives this status, or would for entries of F or of the fibre direction a few roundings away;
/// for entries of F also a few roundings of its largest one: the law takes F in the axes of the fibre, where the
/// columns of an F that is nearly singular are mixed, and what is left of a column of 1e-300 beside one of 1 is not to
/// be told from 0.
fn could_be<T: Number>(law: &Hyperelastic<T>, input: &Input<T>, own: bool, code: i32) -> bool {
    let code_of = |input: &Input<T>| Output::along(law, own.then_some(input.fibre), input, T::splat(1.0)).status;
    let largest = input.f.iter().fold(0.0, |largest: f64, &x| largest.max(Real::abs(x).into()));
    code_of(input) == code
        || (0..42).any(|k| {
            let mut input = *input;
            let part = if k % 2 == 0 { 8.0 * T::ROUNDING } else { -8.0 * T::ROUNDING };
            match k / 2 {
                entry @ 0..9 => input.f[entry] *= T::splat(1.0 + part),
                entry @ 9..18 => input.f[entry - 9] += T::splat(part * largest),
                component => input.fibre[component - 18] *= T::splat(1.0 + part),
            }
            code_of(&input) == code
        })
}

/// Whatever comes in, what goes out are finite numbers, a latch of 0 or 1, and a code of the table.
fn nothing_meaningless_leaves<T: Number>(
    (law, density): (Hyperelastic<T>, T),
    inputs: &[Input<T>],
    bits: u8,
) -> Result<(), TestCaseError> {
    for level in levels() {
        for old in [Old::InPlace, Old::Apart] {
            let asked = if bits < 128 { Asked::from_bits(bits | 64) } else { Asked::ALL };
            let call = Call { asked, density, old, fibres: bits.is_multiple_of(2), ..Call::new(level) };
            let (outputs, worst) = run(&law, inputs, &call);
            for (input, output) in inputs.iter().zip(&outputs) {
                let v = output.values::<T>();
                prop_assert!(v.iter().all(|x| x.is_finite()), "{v:?} from {input:?}, {call:?}");
                if output.status != status::OK {
                    prop_assert!(STRESS.chain(MODES).all(|c| v[c] == 0.0), "{input:?}, {call:?}");
                    let kept = input.old.map(|x| if Into::<f64>::into(x).is_finite() { x.into() } else { 0.0 });
                    let same = (0..9).all(|c| v[6 + c] == kept[c] || !asked.of_state(c));
                    prop_assert!(same, "{v:?} from {input:?}, {call:?}");
                }
                // Beyond this a fibre's shear leaves nothing but rounding of the section, and of what can be said of
                // it.
                let sensible = input.f.iter().all(|&x| Into::<f64>::into(Real::abs(x)) < T::ROUNDING.sqrt().recip());
                if asked == Asked::ALL && (sensible || !input.f.iter().all(|&x| Into::<f64>::into(x).is_finite())) {
                    prop_assert!(
                        could_be(&law, input, call.fibres, output.status),
                        "{output:?} from {input:?}, {call:?}"
                    );
                }
                let name = status::name(output.status);
                prop_assert!(name.is_some() && (output.status == 0 || output.status <= status::INVERTED), "{input:?}");
                if asked.failure {
                    prop_assert!(v[LATCH] == 0.0 || v[LATCH] == 1.0, "{input:?}, {call:?}");
                    prop_assert_eq!(v[LATCH] + v[LATCH + 1], 1.0);
                }
            }
            prop_assert_eq!(Some(worst), outputs.iter().map(|output| output.status).min());
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn nothing_meaningless_leaves_f64(
        law in any_law::<f64>(),
        inputs in prop::collection::vec(any_input::<f64>(), 1..20),
        bits in any::<u8>(),
    ) {
        nothing_meaningless_leaves(law, &inputs, bits)?;
    }

    #[test]
    fn nothing_meaningless_leaves_f32(
        law in any_law::<f32>(),
        inputs in prop::collection::vec(any_input::<f32>(), 1..20),
        bits in any::<u8>(),
    ) {
        nothing_meaningless_leaves(law, &inputs, bits)?;
    }
}

/// A block's answers with a tangent, component by component: stress, state, tangent.
fn with_tangent<T: Number>(
    law: &Hyperelastic<T>,
    inputs: &[Input<T>],
    measure: Measure,
    level: Level,
) -> Vec<Vec<u64>> {
    let n = inputs.len();
    let column = |c: usize| inputs.iter().map(move |input| input.f[c]);
    let f: Vec<T> = (0..9).flat_map(column).collect();
    let array = |components: usize| vec![T::default(); components * n];
    let (mut stress, mut energies, mut invariants, mut failure) = (array(6), array(4), array(4), array(3));
    let mut tangent = array(measure.components());
    law.block(Arrays {
        n,
        leading_dimension: n,
        deformation_gradient: &f,
        stress: Some(&mut stress),
        energies: Some(&mut energies),
        invariants: Some(&mut invariants),
        failure: Some(&mut failure),
        tangent: Some(&mut tangent),
        measure,
        level: Some(level),
        ..Arrays::default()
    })
    .expect("a block");
    let arrays = [&stress, &energies, &invariants, &failure, &tangent];
    let point = |i: usize| arrays.iter().flat_map(|array| array.iter().skip(i).step_by(n)).map(|x| x.bits()).collect();
    (0..n).map(point).collect()
}

/// Beside a tangent as well a point's place does not matter, whether the fibre lies along the first axis or not.
fn place_does_not_matter_for_tangents<T: Number>() {
    let inputs = ordinary(40);
    for [m_1, m_2, m_3] in [AXIS, [0.48, -0.6, 0.64]] {
        for k_ld in [0.0, 1e9] {
            let law = law::<T>([82.341e9, 1.055e9, 2.2, 0.64974e9, k_ld, 0.0458, 1.8, 0.3, m_1, m_2, m_3]);
            for measure in [Measure::Material, Measure::Truesdell, Measure::Jaumann, Measure::Nominal] {
                for level in levels() {
                    let together = with_tangent(&law, &inputs, measure, level);
                    for count in [1, 2, 3, 5, 7, 11, 19] {
                        let apart = inputs.chunks(count).flat_map(|part| with_tangent(&law, part, measure, level));
                        assert!(apart.eq(together.iter().cloned()), "parts of {count}, {measure:?}, {level:?}, {m_1}");
                    }
                }
            }
        }
    }
}

#[test]
fn place_does_not_matter_for_tangents_f64() {
    place_does_not_matter_for_tangents::<f64>();
}

#[test]
fn place_does_not_matter_for_tangents_f32() {
    place_does_not_matter_for_tangents::<f32>();
}

/// Compactions down to the smallest numbers, with large exponents too: the tangent and the wave speed are finite
/// numbers.
fn tiny_compactions<T: Number>(largest: i32, least: i32) {
    for p in [2.0, 2.2, 3.0, 40.0] {
        let law = law::<T>([82.341e9, 1.055e9, p, 0.64974e9, 0.0, 0.0458, 1.8, 0.3, 1.0, 0.0, 0.0]);
        // With F23 = F32 = x, J_t = 1 − x².
        let inputs: Vec<Input<T>> = (least..largest)
            .map(|k| 2f64.powi(k))
            .map(|x| Input::fresh([1.0, 0.0, 0.0, 0.0, 1.0, x, 0.0, x, 1.0], AXIS))
            .collect();
        for level in levels() {
            for measure in [Measure::Material, Measure::Truesdell, Measure::Jaumann, Measure::Nominal] {
                let answers = with_tangent(&law, &inputs, measure, level);
                for (bits, input) in answers.iter().zip(&inputs) {
                    let finite = bits.iter().all(|&bits| T::from_bits(bits).into().is_finite());
                    // What is not evaluated has a tangent of zeros.
                    assert!(
                        finite && T::from_bits(bits[17]).into() > 0.0,
                        "p = {p}, {measure:?}, {level:?}: {input:?}"
                    );
                }
            }
            let (outputs, worst) = run(&law, &inputs, &Call { asked: Asked::ALL, ..Call::new(level) });
            assert_eq!(worst, status::OK, "p = {p}, {level:?}");
            for output in outputs {
                assert!(output.values::<T>()[WAVE_SPEED] > 0.0, "p = {p}, {level:?}");
            }
        }
    }
}

#[test]
fn tiny_compactions_f64() {
    tiny_compactions::<f64>(-20, -1074);
}

#[test]
fn tiny_compactions_f32() {
    tiny_compactions::<f32>(-10, -149);
}

/// A compaction energy beyond single precision is told, and not taken for a small one, at every level.
#[test]
fn powers_beyond_single_precision_are_told() {
    let law = law::<f32>([82.341e9, 1.055e9, 40.0, 0.64974e9, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
    let inputs: Vec<Input<f32>> = (0..200)
        .map(|k| 4.4e-5 * (1.15f64 / 4.4).powf(f64::from(k) / 199.0))
        .map(|a| Input::fresh([1.0, 0.0, 0.0, 0.0, a, 0.0, 0.0, 0.0, a], AXIS))
        .collect();
    for level in levels() {
        let (outputs, _) = run(&law, &inputs, &Call { asked: Asked::ALL, ..Call::new(level) });
        for (output, input) in outputs.iter().zip(&inputs) {
            assert_eq!(output.status, status::OVERFLOW, "{level:?}: {input:?}");
        }
    }
}

/// Second axes and axes of their own are refused for points of the hyperelastic law, modes for those of the linear
/// elastic one, wherever the points are: what a law does not have has no room in the copies of points that are apart,
/// or that fill no register.
#[test]
fn arrays_that_a_law_does_not_have_are_refused() {
    let linear = [79414.0, 793.0, 0.0, 3637.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let (law, linear) = (preset::<f64>(), LinearElastic::new(&linear).expect("valid properties"));
    let mut owned = Owned::new(&ordinary::<f64>(3), 3);
    let mut other = [1.0; 72];
    let (array, f) = (other.as_mut_ptr(), toron::law::block::components(owned.gradient.as_ptr(), 3));
    let stress = toron::law::block::components_mut(owned.stress.as_mut_ptr(), 3);
    let points = Points { f_old: f, f_new: f, stress, ..Points::without_arrays(3, 3) };
    for wrong in [Points { second_axis: [array.cast_const(); 3], ..points }, Points { axes: array, ..points }] {
        // SAFETY: each pointer has as many values as three points have.
        assert_eq!(unsafe { law.step(&wrong) }.map_err(|error| error.code()), Err(status::BAD_ARGUMENT));
    }
    let wrong = Points { modes: array, ..points };
    // SAFETY: as above.
    let code = unsafe { Law::step(&linear, &wrong) }.map_err(|error| error.code());
    assert_eq!((code, other), (Err(status::BAD_ARGUMENT), [1.0; 72]));
}
