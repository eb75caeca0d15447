//! The linear elastic law's block against the law at a point and against itself, at every level of instructions that
//! this machine has.
//!
//! The baseline gives the point's bits. AVX2 and AVX-512 fuse multiplications with additions and stay within a few
//! roundings; at one level, no result depends on where its point stands nor on its neighbours.

use nalgebra::Matrix3;
use proptest::prelude::*;
use toron::Error;
use toron::Level;
use toron::Measure;
use toron::law::block::{Points, Strides, components, components_mut};
use toron::law::interface::Law;
use toron::law::linear_elastic::{Criterion, LinearElastic, Rotation};
use toron::law::state::{
    LINEAR_ALIVE, LINEAR_ELASTIC_STATE, LINEAR_FAILED, LINEAR_LARGEST, LINEAR_STRESS, LINEAR_WORK,
};
use toron::law::status;
use toron_test_support::block::{Number, levels};
use toron_test_support::deformations::samples;

/// Tab. 4.4, in GPa; a fibre along no axis.
const YARN: [f64; 10] = [79.414, 0.794, 0.126, 3.637, 1.0, 0.4, -0.3, 0.1, 1.0, 0.5];
const E1: f64 = YARN[0];
const ROTATIONS: [Rotation; 3] = [Rotation::Fibre, Rotation::Polar, Rotation::Spin];
const CRITERIA: [Criterion; 2] = [Criterion::LargestPrincipal, Criterion::FibreStress];
const REST: [f64; 9] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
const STATE: usize = LINEAR_ELASTIC_STATE;

/// What a point brings: columns of F at both ends, the axes, the old state.
#[derive(Clone, Copy, Debug)]
struct Input {
    f_old: [f64; 9],
    f_new: [f64; 9],
    axes: [f64; 9],
    old: [f64; STATE],
}

/// What it gets: stress, state, axes and status, bit by bit.
type Output = ([u64; 6], [u64; STATE], [u64; 9], i32);

fn law<T: Number>() -> LinearElastic<T> {
    LinearElastic::new(&YARN.map(T::splat)).expect("valid properties")
}

fn by_columns(f: &Matrix3<f64>) -> [f64; 9] {
    std::array::from_fn(|c| f[c])
}

/// Steps of so large an increment from strained states, with stresses that may fail.
fn steps(increment: f64, count: usize) -> Vec<Input> {
    let part = || prop::array::uniform9(-1.0..1.0);
    let input = |(a, b, stress, latch): ([f64; 9], [f64; 9], [f64; 6], f64)| {
        let f_old = Matrix3::identity() + Matrix3::from_column_slice(&a) * 0.15;
        let f_new = (Matrix3::identity() + Matrix3::from_column_slice(&b) * increment) * f_old;
        let mut old = [0.0; STATE];
        for (to, from) in old.iter_mut().zip(stress) {
            *to = from;
        }
        (old[LINEAR_WORK], old[LINEAR_FAILED], old[LINEAR_ALIVE]) = (0.3, latch, 1.0 - latch);
        let axes = by_columns(&law::<f64>().reference_axes());
        Input { f_old: by_columns(&f_old), f_new: by_columns(&f_new), axes, old }
    };
    let latch = prop_oneof![5 => Just(0.0), 1 => Just(1.0)];
    samples((part(), part(), prop::array::uniform6(-2.0..2.0), latch), count).map(input).collect()
}

/// Points that cannot be evaluated: inverted, not finite, a step too large, a state that is no number; one that cannot
/// fail.
fn troubled() -> Vec<Input> {
    let good = steps(0.01, 1)[0];
    let axes = REST;
    let rest = Input { f_old: REST, f_new: REST, axes, old: [0.0; STATE] };
    let diagonal = |a: f64, b: f64, c: f64| [a, 0.0, 0.0, 0.0, b, 0.0, 0.0, 0.0, c];
    let mut inputs = vec![rest, Input { f_new: diagonal(1.2, 1.0, 1.0), ..rest }];
    for f in [
        diagonal(-1.0, 1.0, 1.0),
        diagonal(0.0, 1.0, 1.0),
        diagonal(100.0, 1.0, 1.0),
        diagonal(-1.0, -1.0, 1.0),
        diagonal(1e30, 1e30, 1e30),
        diagonal(1e-30, 1e-30, 1e-30),
        diagonal(1e25, 1e-12, 1e-12),
        diagonal(f64::NAN, 1.0, 1.0),
        diagonal(1.0, f64::INFINITY, 1.0),
        [1.0, 0.0, f64::NEG_INFINITY, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
    ] {
        inputs.push(Input { f_new: f, ..good });
        inputs.push(Input { f_old: f, ..good });
    }
    for c in 0..STATE {
        for x in [f64::NAN, f64::INFINITY] {
            let mut input = good;
            input.old[c] = x;
            inputs.push(input);
            input.old[LINEAR_FAILED] = 1.0;
            inputs.push(input);
        }
    }
    for axes in [[f64::NAN; 9], [0.0; 9], [1e30; 9], REST.map(|x| 1.1 * x)] {
        inputs.push(Input { axes, ..good });
    }
    inputs
}

/// How the arrays lie and what is left out.
#[derive(Clone, Copy, Debug)]
struct Call {
    level: Level,
    rotation: Rotation,
    criterion: Criterion,
    /// Leading dimension less the number of points.
    gap: usize,
    in_place: bool,
    wanted: [bool; 3],
}

impl Call {
    fn new(level: Level, rotation: Rotation, criterion: Criterion) -> Self {
        Call { level, rotation, criterion, gap: 0, in_place: true, wanted: [true; 3] }
    }
}

/// Runs a block; what is not wanted comes back as 0. Gaps must stay untouched.
fn run<T: Number>(law: &LinearElastic<T>, inputs: &[Input], call: &Call) -> (Vec<Output>, i32) {
    let (n, stride) = (inputs.len(), inputs.len() + call.gap);
    let guard = T::splat(-7.25);
    let filled = |components: usize, value: &dyn Fn(&Input, usize) -> f64| {
        let mut array = vec![guard; components * stride];
        for (i, input) in inputs.iter().enumerate() {
            for c in 0..components {
                array[c * stride + i] = T::splat(value(input, c));
            }
        }
        array
    };
    let (f_old, f_new) = (filled(9, &|input, c| input.f_old[c]), filled(9, &|input, c| input.f_new[c]));
    let (mut axes, mut old) = (filled(9, &|input, c| input.axes[c]), filled(STATE, &|input, c| input.old[c]));
    let (mut new, mut stress) = (filled(STATE, &|_, _| 0.0), filled(6, &|_, _| 0.0));
    let mut codes = vec![0; n];
    let spin = call.rotation == Rotation::Spin;
    let [wants_stress, wants_state, wants_status] = call.wanted;
    let null = std::ptr::null_mut();
    let state_old = old.as_mut_ptr();
    let state_new = if call.in_place { state_old } else { new.as_mut_ptr() };
    let block = Points {
        f_old: components(f_old.as_ptr(), stride),
        f_new: components(f_new.as_ptr(), stride),
        axes: if spin { axes.as_mut_ptr() } else { null },
        state_old: LinearElastic::parts(state_old, stride),
        state_new: LinearElastic::parts_mut(if wants_state { state_new } else { null }, stride),
        stress: components_mut(if wants_stress { stress.as_mut_ptr() } else { null }, stride),
        status: if wants_status { codes.as_mut_ptr() } else { std::ptr::null_mut() },
        rotation: call.rotation,
        criterion: call.criterion,
        level: Some(call.level),
        ..Points::without_arrays(n, stride)
    };
    // SAFETY: the arrays have the sizes that the block needs, and overlap only where they are the same.
    let worst = unsafe { Law::step(law, &block) }.expect("a block that is all right");
    let state = if call.in_place { &old } else { &new };
    for (array, components) in [(&axes, 9), (state, STATE), (&stress, 6)] {
        for c in 0..components {
            assert!(array[c * stride + n..(c + 1) * stride].iter().all(|&x| x == guard), "a gap has been written to");
        }
    }
    let bits = |array: &[T], c: usize, i: usize, wanted: bool| if wanted { array[c * stride + i].bits() } else { 0 };
    let outputs = (0..n).map(|i| {
        (
            std::array::from_fn(|c| bits(&stress, c, i, wants_stress)),
            std::array::from_fn(|c| bits(state, c, i, wants_state)),
            std::array::from_fn(|c| bits(&axes, c, i, true)),
            codes[i],
        )
    });
    (outputs.collect(), worst)
}

fn all_calls(level: Level) -> impl Iterator<Item = Call> {
    ROTATIONS.into_iter().flat_map(move |rotation| CRITERIA.map(|criterion| Call::new(level, rotation, criterion)))
}

/// The law at a point.
fn point(law: &LinearElastic, input: &Input, call: &Call) -> Output {
    let [f_old, f_new, mut axes] = [input.f_old, input.f_new, input.axes].map(|f| Matrix3::from_column_slice(&f));
    let point = law.step(&f_old, &f_new, &input.old, call.rotation, call.criterion, &mut axes);
    let bits = |x: f64| x.to_bits();
    (point.stress.map(bits), point.state.map(bits), by_columns(&axes).map(bits), point.status)
}

fn values<T: Number, const N: usize>(bits: [u64; N]) -> [f64; N] {
    bits.map(|bits| T::from_bits(bits).into())
}

/// NaN of any kind in the axes, which a point that is not evaluated keeps.
fn same(a: &Output, b: &Output) -> bool {
    let axes = values::<f64, 9>(a.2).into_iter().zip(values::<f64, 9>(b.2));
    (a.0, a.1, a.3) == (b.0, b.1, b.3)
        && axes.into_iter().all(|(a, b)| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan()))
}

#[test]
fn baseline_is_the_law_at_a_point() {
    let inputs = [steps(1e-4, 60), steps(0.2, 60), troubled()].concat();
    for call in all_calls(Level::Baseline) {
        let (found, worst) = run(&law::<f64>(), &inputs, &call);
        for (input, found) in inputs.iter().zip(&found) {
            let wanted = point(&law(), input, &call);
            assert!(same(found, &wanted), "{call:?} {input:?}\n{found:?}\n{wanted:?}");
        }
        assert_eq!(worst, found.iter().map(|output| output.3).min().expect("points"));
    }
}

/// Every kind of trouble has its own code at every level and in both precisions; a latched point is none.
#[test]
fn codes() {
    fn check<T: Number>() {
        for call in levels().flat_map(all_calls) {
            let (found, worst) = run(&law::<T>(), &troubled(), &call);
            assert_ne!(worst, status::OK);
            for (input, (stress, state, axes, code)) in troubled().iter().zip(found) {
                let [f_old, f_new] = [input.f_old, input.f_new].map(|f| Matrix3::from_column_slice(&f));
                let finite = |f: &[f64]| f.iter().all(|x| x.is_finite());
                let spin = call.rotation == Rotation::Spin;
                let q = Matrix3::from_column_slice(&input.axes);
                let orthonormal = (q.transpose() * q - Matrix3::identity()).norm() < 0.01;
                let failed = input.old[LINEAR_FAILED].is_nan() || input.old[LINEAR_FAILED] >= 0.5;
                let known = finite(&input.old[..LINEAR_ALIVE]);
                let huge = [f_old[0], f_new[0]].iter().any(|x| !(1e-20..50.0).contains(&x.abs()));
                let expected = if failed {
                    if known { status::OK } else { status::STATE_NOT_FINITE }
                } else if !finite(&input.f_old) || !finite(&input.f_new) {
                    status::NOT_FINITE
                } else if spin && !orthonormal {
                    status::MATERIAL_AXES
                } else if huge {
                    // Underflow and overflow make the determinant 0, the increment no number or the axes none.
                    assert!(
                        [status::INVERTED, status::OVERFLOW, status::INCREMENT_TOO_LARGE].contains(&code),
                        "{code} {call:?} {input:?}"
                    );
                    code
                } else if f_old.determinant() <= 0.0 || f_new.determinant() <= 0.0 {
                    status::INVERTED
                } else if f_old[0] < 0.0 || f_new[0] < 0.0 {
                    // By half a turn and a little, which no frame but the spin's minds.
                    assert!(spin || code == status::OK, "{code} {call:?} {input:?}");
                    code
                } else if !known {
                    status::STATE_NOT_FINITE
                } else {
                    status::OK
                };
                assert_eq!(code, expected, "{call:?} {input:?}");
                let (stress, state) = (values::<T, 6>(stress), values::<T, STATE>(state));
                assert!(finite(&stress) && finite(&state), "{call:?} {input:?} {state:?}");
                if code != status::OK || failed {
                    assert_eq!((stress, state[LINEAR_FAILED]), ([0.0; 6], f64::from(u8::from(failed))));
                    let kept = input.old.map(|x| if x.is_finite() { T::splat(x).into() } else { 0.0 });
                    let first = if failed { LINEAR_LARGEST } else { 0 };
                    assert_eq!(state[first..LINEAR_FAILED], kept[first..LINEAR_FAILED], "{call:?} {input:?}");
                    assert!(axes.iter().zip(input.axes).all(|(&a, b)| a == T::splat(b).bits()), "{call:?} {input:?}");
                }
            }
        }
    }
    check::<f64>();
    check::<f32>();
}

/// Every number of points, odd leading dimensions, in place or not, troubled neighbours: the same bits.
#[test]
fn nothing_depends_on_the_place() {
    fn check<T: Number>() {
        let law = law::<T>();
        let good = [steps(1e-4, 20), steps(0.1, 20)].concat();
        let bad = troubled();
        for call in levels().flat_map(all_calls) {
            let alone: Vec<_> = good.iter().map(|input| run(&law, &[*input], &call).0[0]).collect();
            for n in 1..=good.len() {
                let call = Call { gap: n % 4, in_place: n % 2 == 0, ..call };
                assert_eq!(run(&law, &good[..n], &call).0, alone[..n], "{call:?}, {n} points");
            }
            let mixed: Vec<_> = good.iter().enumerate().flat_map(|(k, &input)| [input, bad[k % bad.len()]]).collect();
            let found: Vec<_> = run(&law, &mixed, &call).0.into_iter().step_by(2).collect();
            assert_eq!(found, alone, "{call:?}, beside troubled points");
        }
    }
    check::<f64>();
    check::<f32>();
}

/// What is left out changes nothing in the rest.
#[test]
fn outputs_left_out() {
    let inputs = [steps(0.05, 21), troubled()].concat();
    for call in levels().flat_map(all_calls) {
        let all = run(&law::<f64>(), &inputs, &Call { in_place: false, ..call });
        for k in 0..8 {
            let wanted = [k & 1 != 0, k & 2 != 0, k & 4 != 0];
            let part = run(&law::<f64>(), &inputs, &Call { wanted, in_place: false, ..call });
            assert_eq!(part.1, all.1);
            for (part, all) in part.0.iter().zip(&all.0) {
                assert_eq!(part.0, if wanted[0] { all.0 } else { [0; 6] }, "{call:?} {wanted:?}");
                assert_eq!(part.1, if wanted[1] { all.1 } else { [0; STATE] }, "{call:?} {wanted:?}");
                assert_eq!((part.2, part.3), (all.2, if wanted[2] { all.3 } else { 0 }), "{call:?} {wanted:?}");
            }
        }
    }
}

/// Material axes that are turned by many steps in single precision stay orthonormal: about fixed and changing axes, by
/// small and large angles.
#[test]
fn axes_after_many_steps() {
    const POINTS: usize = 64;
    const STEPS: usize = 20_000;
    let law = law::<f32>();
    let reference = by_columns(&LinearElastic::<f64>::new(&YARN).expect("valid properties").reference_axes());
    let mut axes: Vec<f32> = (0..9 * POINTS).map(|k| reference[k / POINTS] as f32).collect();
    let rest: Vec<f32> = (0..9 * POINTS).map(|k| REST[k / POINTS] as f32).collect();
    let mut turned = [rest.clone(), rest.clone()];
    let mut state = vec![0.0f32; STATE * POINTS];
    let mut codes = [0; POINTS];
    for step in 0..STEPS {
        let after = &mut turned[step % 2];
        for i in 0..POINTS {
            // From 1e-6 to 1 rad a step; every other axis turns by itself.
            let angle = 10f64.powf(-6.0 + 6.0 * (i / 2) as f64 / (POINTS / 2) as f64);
            let t = if i % 2 == 0 { 1.0 } else { step as f64 };
            let axis = nalgebra::Unit::new_normalize(nalgebra::Vector3::new(1.0, t.sin(), (0.3 * t).cos()));
            let turn = nalgebra::Rotation3::from_axis_angle(&axis, angle);
            for (c, &x) in turn.matrix().iter().enumerate() {
                after[c * POINTS + i] = x as f32;
            }
        }
        let block = Points {
            f_old: components(rest.as_ptr(), POINTS),
            f_new: components(after.as_ptr(), POINTS),
            axes: axes.as_mut_ptr(),
            state_new: LinearElastic::parts_mut(state.as_mut_ptr(), POINTS),
            status: codes.as_mut_ptr(),
            rotation: Rotation::Spin,
            ..Points::without_arrays(POINTS, POINTS)
        };
        // SAFETY: the arrays hold as many points.
        assert_eq!(unsafe { Law::step(&law, &block) }, Ok(status::OK), "step {step}: {codes:?}");
    }
    let drift = |i: usize| {
        let q = Matrix3::from_fn(|r, c| f64::from(axes[(3 * c + r) * POINTS + i]));
        (q.transpose() * q - Matrix3::identity()).norm()
    };
    let worst = (0..POINTS).map(drift).fold(0.0, f64::max);
    assert!(worst < 1e-6, "{worst}");
}

#[test]
fn blocks_that_are_refused() {
    let (law, f, mut speed) = (law::<f64>(), [1.0; 9], 0.0);
    let (null, f) = ([std::ptr::null(); 9], components(f.as_ptr(), 1));
    let block = Points { f_old: f, f_new: f, ..Points::without_arrays(1, 1) };
    // SAFETY: what is not null holds one point.
    let code = |block: Points<f64>| unsafe { Law::step(&law, &block) }.map_err(|error: Error| error.code());
    assert_eq!(code(Points { f_old: null, ..block }), Err(status::NULL_ARGUMENT));
    assert_eq!(code(Points { f_new: null, ..block }), Err(status::NULL_ARGUMENT));
    assert_eq!(code(Points { rotation: Rotation::Spin, ..block }), Err(status::NULL_ARGUMENT));
    let mut state = [0.0; STATE];
    let crowded = Points { leading_dimension: 0, state_new: LinearElastic::parts_mut(state.as_mut_ptr(), 0), ..block };
    assert_eq!(code(crowded), Err(status::BAD_LEADING_DIMENSION));
    let unknown = Points { wave_speed: &mut speed, density: f64::NAN, ..block };
    assert_eq!(code(unknown), Err(status::BAD_ARGUMENT));
    assert_eq!(code(Points { n: 0, leading_dimension: 0, ..block }), Ok(status::OK));
    assert_eq!(code(block), Ok(status::INVERTED));
}

/// An increment is as good as its own digits, not as those of F: the error of a step from rest, in roundings of E1
/// times the increment, is the same for every increment. The truth is the law in double precision, of the same numbers.
#[test]
fn small_increments_keep_their_digits() {
    fn worst<T: Number>(level: Level, rotation: Rotation, increment: f64) -> f64 {
        let exact = LinearElastic::<f64>::new(&YARN.map(|x| T::splat(x).into())).expect("valid properties");
        let axes = by_columns(&exact.reference_axes());
        let rounded = |f: [f64; 9]| f.map(|x| T::splat(x).into());
        let inputs: Vec<_> = steps(increment, 300)
            .iter()
            .map(|input| Input {
                f_old: rounded(input.f_old),
                f_new: rounded(input.f_new),
                axes: rounded(axes),
                old: [0.0; STATE],
            })
            .collect();
        let call = Call::new(level, rotation, Criterion::LargestPrincipal);
        let found = run(&law::<T>(), &inputs, &call).0;
        let errors = inputs.iter().zip(found).map(|(input, found)| {
            let wanted = values::<f64, 6>(point(&exact, input, &call).0);
            let errors = values::<T, 6>(found.0).into_iter().zip(wanted).map(|(a, b)| (a - b).abs());
            errors.fold(0.0, f64::max) / (T::ROUNDING * E1 * increment)
        });
        errors.fold(0.0, f64::max)
    }
    for level in levels() {
        for rotation in ROTATIONS {
            let errors = [1e-1, 1e-3, 1e-5].map(|increment| worst::<f32>(level, rotation, increment));
            let apart = [1e-1, 1e-3, 1e-5, 1e-9].map(|increment| worst::<f64>(level, rotation, increment));
            println!("{level:?} {rotation:?}: roundings in single precision {errors:.1?}, apart in double {apart:.1?}");
            assert!(
                errors.iter().chain(&apart).all(|&error| error <= 60.0),
                "{level:?} {rotation:?}: {errors:?} {apart:?}"
            );
        }
    }
}

/// Over a path the lanes stay with the point: stress, work and largest principal stress.
#[test]
fn lanes_stay_with_the_point() {
    for call in levels().flat_map(all_calls) {
        for increment in [1e-3, 0.2] {
            let inputs = steps(increment, 200);
            for (input, found) in inputs.iter().zip(run(&law::<f64>(), &inputs, &call).0) {
                let wanted = point(&law(), input, &call);
                assert_eq!(found.3, wanted.3);
                let state =
                    values::<f64, STATE>(found.1).into_iter().zip(values::<f64, STATE>(wanted.1)).take(LINEAR_FAILED);
                let stress = values::<f64, 6>(found.0).into_iter().zip(values::<f64, 6>(wanted.0));
                for (a, b) in stress.chain(state) {
                    assert!(
                        (a - b).abs() <= 100.0 * f64::EPSILON * (2.0 + E1 * increment),
                        "{call:?} {input:?}: {a} {b}"
                    );
                }
            }
        }
    }
    assert_eq!((LINEAR_STRESS, LINEAR_LARGEST), (0, 6), "the order of the state");
}

/// Fibre directions and second axes by points, any lengths; the last two points have no direction, or a second axis
/// along it.
fn directions(count: usize) -> Vec<([f64; 3], [f64; 3])> {
    let turn = |i: usize| (0.7 * i as f64).sin_cos();
    let mut directions: Vec<_> = (0..count)
        .map(|i| {
            let (s, c) = turn(i);
            ([3.0 * c, 3.0 * s, 0.2 * s], if i % 3 == 0 { [0.0; 3] } else { [-0.1 * s, 0.2, 0.3 * c] })
        })
        .collect();
    directions[count - 2].0 = [0.0; 3];
    directions[count - 1].1 = directions[count - 1].0;
    directions
}

/// Points with axes of their own, in rows or by components, are those of a law with these axes.
#[test]
fn points_with_axes_of_their_own() {
    let inputs = steps(0.05, 41);
    let (n, law) = (inputs.len(), law::<f64>());
    let directions = directions(n);
    let own = |i: usize, with_second: bool| {
        let (fibre, second) = directions[i];
        law.along(fibre, with_second.then_some(second))
    };
    for (rows, with_second) in [(false, true), (true, true), (false, false), (true, false)] {
        // Component c of point i: in rows, or by components.
        let stride = |components: usize| if rows { (1, components) } else { (n + 2, 1) };
        let array = |components: usize, value: &dyn Fn(usize, usize) -> f64| {
            let ((between, stride), mut array) = (stride(components), vec![0.0; components * (n + 2)]);
            for (i, c) in (0..n).flat_map(|i| (0..components).map(move |c| (i, c))) {
                array[c * between + i * stride] = value(i, c);
            }
            array
        };
        let (f_old, f_new) = (array(9, &|i, c| inputs[i].f_old[c]), array(9, &|i, c| inputs[i].f_new[c]));
        let (fibre, second) = (array(3, &|i, c| directions[i].0[c]), array(3, &|i, c| directions[i].1[c]));
        let (old, mut stress) = (array(STATE, &|i, c| inputs[i].old[c]), array(6, &|_, _| 0.0));
        let (mut new, mut tangent) = (array(STATE, &|_, _| 0.0), array(81, &|_, _| 0.0));
        let (mut active, mut codes) = (vec![7.0; n], vec![7; n]);
        let second = if with_second { second.as_ptr() } else { std::ptr::null() };
        let of = |components: usize| stride(components).1;
        let block = Points {
            f_old: components(f_old.as_ptr(), stride(9).0),
            f_new: components(f_new.as_ptr(), stride(9).0),
            fibre: components(fibre.as_ptr(), stride(3).0),
            second_axis: components(second, stride(3).0),
            state_old: LinearElastic::parts(old.as_ptr(), stride(1).0),
            state_new: LinearElastic::parts_mut(new.as_mut_ptr(), stride(1).0),
            stress: components_mut(stress.as_mut_ptr(), stride(6).0),
            status: codes.as_mut_ptr(),
            active: active.as_mut_ptr(),
            strides: Strides {
                deformation_gradient: of(9),
                fibre: of(3),
                limit: 1,
                axes: of(9),
                state: of(STATE),
                stress: of(6),
                modes: 1,
                tangent: of(81),
            },
            level: Some(Level::Baseline),
            ..Points::without_arrays(n, stride(1).0)
        };
        for with_tangent in [false, true] {
            let to = if with_tangent { tangent.as_mut_ptr() } else { std::ptr::null_mut() };
            // SAFETY: the arrays have the sizes that the block needs.
            let worst = unsafe { Law::step(&law, &Points { tangent: to, measure: Measure::Nominal, ..block }) };
            assert_eq!(worst, Ok(status::FIBRE_DIRECTION));
            for (i, input) in inputs.iter().enumerate() {
                let Ok(own) = own(i, with_second) else {
                    assert_eq!((codes[i], active[i]), (status::FIBRE_DIRECTION, 0.0), "point {i}");
                    continue;
                };
                let at = |array: &[f64], components: usize, c: usize| {
                    let (between, stride) = stride(components);
                    array[c * between + i * stride]
                };
                let [f0, f1] = [input.f_old, input.f_new].map(|f| Matrix3::from_column_slice(&f));
                let (rotation, criterion) = (Rotation::Fibre, Criterion::LargestPrincipal);
                let (point, wanted) =
                    own.step_with_tangent(&f0, &f1, &input.old, rotation, criterion, &mut Matrix3::identity());
                let found: Vec<_> = (0..6).map(|c| at(&stress, 6, c)).collect();
                assert_eq!((found, codes[i]), (point.stress.to_vec(), point.status), "point {i}");
                let found: Vec<_> = (0..STATE).map(|c| at(&new, STATE, c)).collect();
                assert_eq!((found, active[i]), (point.state.to_vec(), point.state[LINEAR_ALIVE]), "point {i}");
                let nominal = wanted.nominal(&f1, &point.stress);
                for c in (0..81).filter(|_| with_tangent) {
                    // By rows here, by columns there.
                    assert_eq!(at(&tangent, 81, c), nominal[c % 9 * 9 + c / 9], "point {i}, entry {c}");
                }
            }
        }
    }
}

/// The wave speed of a block.
fn wave_speeds(inputs: &[Input], rotation: Rotation, level: Level) -> Vec<f64> {
    let filled = |components: usize, value: &dyn Fn(&Input, usize) -> f64| -> Vec<f64> {
        (0..components).flat_map(|c| inputs.iter().map(move |input| value(input, c))).collect()
    };
    let n = inputs.len();
    let (f_old, f_new) = (filled(9, &|input, c| input.f_old[c]), filled(9, &|input, c| input.f_new[c]));
    let (mut axes, old) = (filled(9, &|input, c| input.axes[c]), filled(STATE, &|input, c| input.old[c]));
    let mut speeds = vec![0.0; n];
    let block = Points {
        f_old: components(f_old.as_ptr(), n),
        f_new: components(f_new.as_ptr(), n),
        axes: axes.as_mut_ptr(),
        state_old: LinearElastic::parts(old.as_ptr(), n),
        density: 1.0,
        wave_speed: speeds.as_mut_ptr(),
        rotation,
        level: Some(level),
        ..Points::without_arrays(n, n)
    };
    // SAFETY: the arrays have the sizes that the block needs.
    unsafe { Law::step(&law::<f64>(), &block) }.expect("a block that is all right");
    speeds
}

/// No wave is faster than the bound, in any frame and direction; at rest the one along the fibre is as fast.
#[test]
fn waves_are_no_faster_than_the_bound() {
    let unit = |v: nalgebra::Vector3<f64>| v / v.norm();
    // Stressed states, and a step of no length: its tangent is that of the rate.
    let inputs: Vec<_> = steps(0.1, 60)
        .into_iter()
        .filter(|input| input.old[LINEAR_FAILED] == 0.0)
        .map(|input| Input { f_new: input.f_old, ..input })
        .collect();
    let directions: Vec<_> = (0..200_u32)
        .map(|k| {
            unit(nalgebra::Vector3::from_fn(|c, _| (f64::from(k) * [0.61, 1.13, 1.71][c] + c as f64).sin() + 1e-3))
        })
        .collect();
    let mut closest = 0.0_f64;
    for (rotation, level) in ROTATIONS.into_iter().flat_map(|rotation| levels().map(move |level| (rotation, level))) {
        for (input, speed) in inputs.iter().zip(wave_speeds(&inputs, rotation, level)) {
            let f = Matrix3::from_column_slice(&input.f_old);
            let mut axes = Matrix3::from_column_slice(&input.axes);
            let (point, tangent) =
                law::<f64>().step_with_tangent(&f, &f, &input.old, rotation, Criterion::FibreStress, &mut axes);
            assert_eq!(point.status, status::OK);
            let nominal = tangent.nominal(&f, &point.stress);
            for (n, u) in directions.iter().zip(directions.iter().skip(1)).chain(directions.iter().map(|n| (n, n))) {
                let material = f.transpose() * n;
                let mut modulus = 0.0;
                for (row, column) in (0..9).flat_map(|row| (0..9).map(move |column| (row, column))) {
                    let of = |k: usize| u[k % 3] * material[k / 3];
                    modulus += nominal[row + 9 * column] * of(row) * of(column);
                }
                assert!(modulus <= speed * speed * (1.0 + 1e-9), "{rotation:?}: {modulus} of {}", speed * speed);
                closest = closest.max(modulus / (speed * speed));
            }
        }
    }
    assert!(closest > 0.7, "the fastest of these waves has {closest} of the bound's square");
    let axes = by_columns(&law::<f64>().reference_axes());
    let rest = Input { f_old: REST, f_new: REST, axes, old: [0.0; STATE] };
    for level in levels() {
        assert_eq!(wave_speeds(&[rest], Rotation::Fibre, level), [E1.sqrt()]);
    }
}
