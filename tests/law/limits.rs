//! Points with a failure limit of their own: they get what a law with that limit gives them.

use std::ptr::{null, null_mut};

use nalgebra::Matrix3;
use toron::host::arguments::Layout;
use toron::host::blocks::{self, Given};
use toron::host::linear_elastic::{self, LinearBlock};
use toron::host::point_and_block::Block;
use toron::host::point_and_block::Point;
use toron::host::points;
use toron::law::block::{Points, Strides, components, components_mut};
use toron::law::interface::Law;
use toron::law::parameters::SIGMA_LIM;
use toron::law::state::{FAILED, FAILURE_INDEX, HYPERELASTIC_STATE};
use toron::law::status;
use toron::{Arrays, Hyperelastic, Level, LinearElastic, Measure, Request};
use toron_test_support::block::levels;
use toron_test_support::deformations::{Ranges, deformation, samples};

const PROPERTIES: [f64; 11] = [82341.0, 1055.0, 2.2, 649.74, 0.0, 0.0458, 1.8, 0.1, 1.0, 0.0, 0.0];
/// 0 is that of the properties.
const LIMITS: [f64; 7] = [0.0, 0.02, 1e-3, 0.06, 0.0458, 0.0, 3.0];
const STATE: usize = HYPERELASTIC_STATE;

fn gradients(n: usize) -> Vec<Matrix3<f64>> {
    let spread = Ranges { i_el: -0.02..0.08, i_tc: -0.3..0.1, i_td: 0.0..0.3, i_ld: 0.0..0.2 };
    samples(deformation(spread), n).map(|sample| sample.f).collect()
}

fn limit(i: usize) -> f64 {
    LIMITS[i % LIMITS.len()]
}

/// What is requested besides stress and state.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Asked {
    State,
    Fibres,
    WaveSpeed,
    Modes,
}

/// Stress, state and status of all points, as bits.
fn block(
    law: &Hyperelastic<f64>,
    f: &[Matrix3<f64>],
    limits: Option<&[f64]>,
    level: Level,
    asked: Asked,
) -> Vec<Vec<u64>> {
    let n = f.len();
    let gradient: Vec<f64> = (0..9).flat_map(|c| f.iter().map(move |f| f[c])).collect();
    let fibre: Vec<f64> = [0.8, 0.0, 0.6].into_iter().flat_map(|m| vec![m; n]).collect();
    let [mut stress, mut modes, mut wave] = [6, 24, 1].map(|components| vec![0.0; components * n]);
    let mut state = vec![0.0; STATE * n];
    let mut codes = vec![0; n];
    let (energies, rest) = state.split_at_mut(4 * n);
    let (invariants, failure) = rest.split_at_mut(4 * n);
    let arrays = Arrays {
        n,
        leading_dimension: n,
        deformation_gradient: &gradient,
        fibre: (asked == Asked::Fibres).then_some(&fibre),
        limit: limits,
        density: 1.35e-9,
        stress: Some(&mut stress),
        energies: Some(energies),
        invariants: Some(invariants),
        failure: Some(failure),
        modes: (asked == Asked::Modes).then_some(&mut modes),
        wave_speed: (asked == Asked::WaveSpeed).then_some(&mut wave),
        status: Some(&mut codes),
        level: Some(level),
        ..Arrays::default()
    };
    law.block(arrays).expect("a good call");
    let point = |i: usize| {
        let numbers = [&stress, &state, &modes, &wave].into_iter().flat_map(|array| array[i..].iter().step_by(n));
        numbers.map(|x| x.to_bits()).chain([codes[i] as u64]).collect()
    };
    (0..n).map(point).collect()
}

/// Whatever the number of points, the instructions, what is requested and where the fibre comes from.
#[test]
fn a_block_gives_each_point_what_the_law_with_its_limit_gives() {
    let oblique = [82341.0, 1055.0, 2.2, 649.74, 90.0, 0.0, 1.8, 0.1, 0.6, 0.0, 0.8];
    let along = [82341.0, 1055.0, 2.2, 649.74, 90.0, 0.0458, 1.8, 0.1, 1.0, 0.0, 0.0];
    for properties in [PROPERTIES, oblique, along] {
        let law = Hyperelastic::new(&properties).expect("valid properties");
        for level in levels() {
            let mut failed = [0; 2];
            for n in [1, 2, 3, 5, 8, 9, 17, 50] {
                let f = gradients(n);
                let limits: Vec<f64> = (0..n).map(limit).collect();
                for asked in [Asked::State, Asked::Fibres, Asked::WaveSpeed, Asked::Modes] {
                    let found = block(&law, &f, Some(&limits), level, asked);
                    for own in LIMITS {
                        let wanted = block(&law.with_limit(own).expect("a limit"), &f, None, level, asked);
                        for i in (0..n).filter(|&i| limit(i) == own) {
                            assert_eq!(found[i], wanted[i], "point {i} of {n}, {asked:?}, {level:?}, limit {own}");
                            failed[f64::from_bits(found[i][6 + FAILED]) as usize] += 1;
                        }
                    }
                }
            }
            // Of each level, since processors have different ones.
            assert!(failed.iter().all(|&count| count > 33), "{level:?}: {failed:?}");
        }
    }
}

/// A limit is ln(1 + ε_lim): as the property has it, to rounding.
#[test]
fn a_limit_is_the_logarithm_of_the_property_s_stretch() {
    let law = Hyperelastic::new(&PROPERTIES).expect("valid properties");
    let fresh = [0.0; STATE];
    for (i, f) in gradients(200).iter().enumerate() {
        let eps_lim = 0.002 * (1 + i) as f64;
        let properties: [f64; 11] = std::array::from_fn(|c| if c == 5 { eps_lim } else { PROPERTIES[c] });
        let own = Hyperelastic::new(&properties).expect("valid properties").point(f, &fresh, Request::ALL);
        let limited = law.with_limit(eps_lim.ln_1p()).expect("a limit").point(f, &fresh, Request::ALL);
        let [wanted, found] = [own, limited].map(|point| point.state[FAILURE_INDEX]);
        assert!((wanted - found).abs() <= 4.0 * f64::EPSILON * wanted, "{eps_lim}: {wanted} {found}");
        assert_eq!(own.stress, limited.stress);
    }
}

/// Points in rows, a block of one point and the entry for a point read the limit where the caller says.
#[test]
fn limits_stand_where_the_caller_says() {
    let law = Hyperelastic::new(&PROPERTIES).expect("valid properties");
    let n = 70;
    let f = gradients(n);
    let gradient: Vec<[f64; 9]> = f.iter().map(|f| std::array::from_fn(|c| f[c])).collect();
    let limits: Vec<[f64; 3]> = (0..n).map(|i| [-1.0, limit(i), f64::NAN]).collect();
    let mut state = vec![[0.0; STATE]; n];
    let mut stress = vec![[0.0; 6]; n];
    let to = state.as_mut_ptr().cast::<f64>();
    let rows = Points {
        f_new: components(gradient.as_ptr().cast(), 1),
        limit: limits.as_ptr().cast::<f64>().wrapping_add(1),
        stress: components_mut(stress.as_mut_ptr().cast(), 1),
        state_new: Hyperelastic::parts_mut(to, 1),
        strides: Strides {
            deformation_gradient: 9,
            fibre: 3,
            limit: 3,
            axes: 9,
            state: STATE,
            stress: 6,
            modes: 24,
            tangent: 36,
        },
        ..Points::without_arrays(n, 1)
    };
    // SAFETY: every array has a row for each point.
    unsafe { law.step(&rows) }.expect("a good call");
    let mut of_c = state.clone();
    of_c.fill([7.0; STATE]);
    let to = of_c.as_mut_ptr().cast::<f64>();
    let row = |stride: usize| Layout { leading_dimension: 1, stride };
    let block = Block {
        n,
        deformation_gradient: std::array::from_fn(|c| if c == 0 { gradient.as_ptr().cast() } else { null() }),
        energies: to,
        invariants: to.wrapping_add(4),
        failure: to.wrapping_add(8),
        limit: limits.as_ptr().cast::<f64>().wrapping_add(1),
        deformation_gradient_layout: row(9),
        state_layout: row(STATE),
        limit_layout: row(3),
        ..Block::empty()
    };
    // SAFETY: every array has a row for each point.
    let code = unsafe { blocks::hyperelastic_block(Given::Properties(&PROPERTIES), &block) };
    assert_eq!((code, of_c), (Ok(status::OK), state.clone()));
    for i in 0..n {
        let wanted = law.with_limit(limit(i)).expect("a limit").point(&f[i], &[0.0; STATE], Request::STRESS_AND_STATE);
        let close = |found: &[f64; STATE], what: &str| {
            let apart = found.iter().zip(&wanted.state).map(|(a, b)| (a - b).abs() / b.abs().max(1e-3));
            assert!(apart.fold(0.0, f64::max) < 1e-11, "{what} {i}: {found:?} {:?}", wanted.state);
        };
        close(&state[i], "row");
        let (mut one, mut stress) = ([0.0; STATE], [0.0; 6]);
        let own = limit(i);
        let to = one.as_mut_ptr();
        let block = Block {
            n: 1,
            deformation_gradient: std::array::from_fn(|c| if c == 0 { gradient[i].as_ptr() } else { null() }),
            stress: std::array::from_fn(|c| if c == 0 { stress.as_mut_ptr() } else { null_mut() }),
            energies: to,
            invariants: to.wrapping_add(4),
            failure: to.wrapping_add(8),
            limit: &raw const own,
            ..Block::empty()
        };
        // SAFETY: arrays of one point.
        let code = unsafe { blocks::hyperelastic_block(Given::Properties(&PROPERTIES), &block) };
        assert_eq!(code, Ok(status::OK));
        close(&one, "block");
        let mut alone = [0.0; STATE];
        let point = Point {
            deformation_gradient: gradient[i].as_ptr(),
            state_new: alone.as_mut_ptr(),
            stress: stress.as_mut_ptr(),
            limit: &raw const own,
            ..Point::empty()
        };
        // SAFETY: arrays of one point.
        let code = unsafe { points::hyperelastic_point(&PROPERTIES[..], &point) };
        assert_eq!(code, Ok(status::OK));
        close(&alone, "point");
    }
}

/// Without an array for the codes the message names the point.
#[test]
fn a_limit_that_means_nothing_is_found() {
    let (f, n) = (gradients(50), 50);
    let gradient: Vec<f64> = (0..9).flat_map(|c| f.iter().map(move |f| f[c])).collect();
    let mut state = vec![0.0; STATE * n];
    // One that has failed before is not looked at.
    state[9 * n + 7] = 1.0;
    let limits: Vec<f64> = (0..n).map(|i| if i == 7 || i == 41 { -1.0 } else { 0.0 }).collect();
    let to = state.as_mut_ptr();
    let block = Block {
        n,
        deformation_gradient: std::array::from_fn(|c| if c == 0 { gradient.as_ptr() } else { null() }),
        energies_old: to,
        invariants_old: to.wrapping_add(4 * n),
        failure_old: to.wrapping_add(8 * n),
        energies: to,
        invariants: to.wrapping_add(4 * n),
        failure: to.wrapping_add(8 * n),
        limit: limits.as_ptr(),
        ..Block::empty()
    };
    // SAFETY: component-major arrays of n points.
    let error =
        unsafe { blocks::hyperelastic_block(Given::Properties(&PROPERTIES), &block) }.expect_err("a wrong limit");
    assert!(error.code() == status::LIMIT && error.to_string().contains("point 41"), "{error}");
}

/// A limit that means nothing has a code of its own; the point keeps its state, and the others do not notice.
#[test]
fn a_limit_that_means_nothing_is_an_error_of_its_point() {
    let law = Hyperelastic::new(&PROPERTIES).expect("valid properties");
    for wrong in [-1e-300, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(law.with_limit(wrong).is_err());
        for n in [1, 3, 8, 20] {
            let f = gradients(n);
            let mut limits = vec![0.0; n];
            limits[n / 2] = wrong;
            for level in levels() {
                for asked in [Asked::State, Asked::Modes] {
                    let found = block(&law, &f, Some(&limits), level, asked);
                    let wanted = block(&law, &f, None, level, asked);
                    for i in 0..n {
                        if i == n / 2 {
                            assert_eq!(found[i].last(), Some(&(status::LIMIT as u64)), "{wrong} {n} {level:?}");
                            assert!(found[i][..6 + STATE - 1].iter().all(|&bits| bits == 0), "{:?}", found[i]);
                        } else {
                            assert_eq!(found[i], wanted[i], "{wrong} {n} {level:?} {asked:?}");
                        }
                    }
                }
            }
        }
        let gradient = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        let mut state = [0.0; STATE];
        let point = Point {
            deformation_gradient: gradient.as_ptr(),
            state_new: state.as_mut_ptr(),
            limit: &raw const wrong,
            ..Point::empty()
        };
        // SAFETY: arrays of one point.
        let code = unsafe { points::hyperelastic_point(&PROPERTIES[..], &point) };
        assert_eq!(code, Ok(status::LIMIT));
        let text = toron::Error::Plain(status::LIMIT).to_string();
        assert!(text.contains("the failure limit of this point is negative, NaN or infinite"), "{text}");
    }
    // Where nothing fails it is not read.
    let f = gradients(9);
    let gradient: Vec<f64> = (0..9).flat_map(|c| f.iter().map(move |f| f[c])).collect();
    let mut stress = vec![0.0; 54];
    let limits = [f64::NAN; 9];
    let arrays = Arrays {
        n: 9,
        leading_dimension: 9,
        deformation_gradient: &gradient,
        limit: Some(&limits),
        stress: Some(&mut stress),
        ..Arrays::default()
    };
    assert_eq!(law.block(arrays), Ok(status::OK));
    let short = Arrays {
        n: 9,
        leading_dimension: 9,
        deformation_gradient: &gradient,
        limit: Some(&limits[..8]),
        ..Arrays::default()
    };
    let error = law.block(short).expect_err("eight limits of nine").to_string();
    assert!(error.contains("entries of limit"), "{error}");
}

/// All that a point asks for, and its status.
#[derive(Clone, Copy)]
struct Results {
    stress: [f64; 6],
    state: [f64; STATE],
    tangent: [f64; 36],
    wave_speed: f64,
    code: i32,
}

/// A point on its own: the entry for a point does with a limit what a block does, also with one that means nothing.
#[test]
fn a_point_is_as_a_block_of_it() {
    let law = Hyperelastic::new(&PROPERTIES).expect("valid properties");
    let (mut fine, mut refused, mut wrong) = (0, 0, 0);
    for (i, f) in gradients(60).iter().enumerate() {
        let mut f = *f;
        if i % 5 == 0 {
            f.m11 = if i % 2 == 0 { f64::NAN } else { -1.0 };
        }
        let mut old = [0.0; STATE];
        old[FAILED] = if i % 7 == 0 { 1.0 } else { 0.0 };
        for own in LIMITS.into_iter().chain([-1.0, f64::NAN, f64::INFINITY]) {
            let fresh = Results { stress: [7.0; 6], state: old, tangent: [7.0; 36], wave_speed: 7.0, code: 7 };
            let [mut point, mut block] = [fresh; 2];
            let arrays = Point {
                density: 1.35e-9,
                deformation_gradient: f.as_ptr(),
                state_old: old.as_ptr(),
                state_new: point.state.as_mut_ptr(),
                stress: point.stress.as_mut_ptr(),
                tangent: point.tangent.as_mut_ptr(),
                wave_speed: &raw mut point.wave_speed,
                limit: &raw const own,
                ..Point::empty()
            };
            // SAFETY: arrays of one point.
            point.code = unsafe { points::hyperelastic_point(&PROPERTIES[..], &arrays) }.expect("a good call");
            let state = block.state.as_mut_ptr();
            let arrays = Points {
                density: 1.35e-9,
                f_new: components(f.as_ptr(), 1),
                limit: &raw const own,
                state_old: Hyperelastic::parts(state, 1),
                state_new: Hyperelastic::parts_mut(state, 1),
                stress: components_mut(block.stress.as_mut_ptr(), 1),
                tangent: block.tangent.as_mut_ptr(),
                wave_speed: &raw mut block.wave_speed,
                measure: Measure::Material,
                ..Points::without_arrays(1, 1)
            };
            // SAFETY: arrays of one point.
            block.code = unsafe { law.step(&arrays) }.expect("a good call");
            assert_eq!((point.code, point.state[FAILED]), (block.code, block.state[FAILED]), "{i} {own}");
            let numbers =
                |of: &Results| -> Vec<f64> { [&of.stress[..], &of.state, &of.tangent, &[of.wave_speed]].concat() };
            for (a, b) in numbers(&point).iter().zip(numbers(&block)) {
                assert!((a - b).abs() <= 1e-9 * b.abs().max(1e-3), "{i} {own}: {a} {b}");
            }
            match point.code {
                status::OK => fine += 1,
                status::LIMIT => refused += 1,
                _ => wrong += 1,
            }
        }
    }
    assert!(fine > 300 && refused > 100 && wrong > 50, "{fine} {refused} {wrong}");
}

const LINEAR: [f64; 10] = [79414.0, 794.14, 126.0, 3637.0, 1.0, 0.2, 0.0, 0.0, 0.0, 1.0];
const STRENGTHS: [f64; 5] = [0.0, 40.0, 3637.0, 1e-3, 900.0];

/// State and status of all points of the linear elastic law after a step from rest, as bits.
fn linear_block(
    sigma_lim: f64,
    f: &[Matrix3<f64>],
    limits: Option<&[f64]>,
    level: i32,
    tangent: bool,
) -> Vec<Vec<u64>> {
    let n = f.len();
    let properties: [f64; 10] = std::array::from_fn(|c| if c == SIGMA_LIM { sigma_lim } else { LINEAR[c] });
    let law = LinearElastic::new(&properties).expect("valid properties");
    let columns =
        |f: &dyn Fn(usize) -> Matrix3<f64>| -> Vec<f64> { (0..9).flat_map(|c| (0..n).map(move |i| f(i)[c])).collect() };
    let (old, new) = (columns(&|_| Matrix3::identity()), columns(&|i| f[i]));
    let (mut state, mut moduli) = (vec![0.0; 10 * n], vec![0.0; 36 * n]);
    let mut codes = vec![0; n];
    let first = |array: &[f64]| std::array::from_fn(|c| if c == 0 { array.as_ptr() } else { null() });
    let block = LinearBlock {
        n,
        level,
        f_old: first(&old),
        f_new: first(&new),
        limit: limits.map_or(null(), <[f64]>::as_ptr),
        state_new: state.as_mut_ptr(),
        tangent: if tangent { moduli.as_mut_ptr() } else { null_mut() },
        status: codes.as_mut_ptr(),
        ..LinearBlock::empty()
    };
    // SAFETY: component-major arrays of n points.
    let answer = unsafe { linear_elastic::block(&law, &block) };
    let worst = answer.unwrap_or_else(|error| error.code());
    assert_eq!(Some(&worst), codes.iter().min());
    let numbers = |i: usize| state[i..].iter().step_by(n).map(|x| x.to_bits()).chain([codes[i] as u64]).collect();
    (0..n).map(numbers).collect()
}

/// As for the hyperelastic law: the strength of a point is that of a law with it, with and without a tangent; what
/// means nothing is an error of its point alone.
#[test]
fn points_of_the_linear_law_have_strengths_of_their_own() {
    let mut failed = [0; 2];
    for level in 0..4 {
        for n in [1, 3, 8, 21] {
            let f = gradients(n);
            let own = |i: usize| STRENGTHS[i % STRENGTHS.len()];
            let limits: Vec<f64> = (0..n).map(own).collect();
            for tangent in [false, true] {
                let found = linear_block(LINEAR[SIGMA_LIM], &f, Some(&limits), level, tangent);
                for strength in STRENGTHS {
                    let sigma_lim = if strength > 0.0 { strength } else { LINEAR[SIGMA_LIM] };
                    let wanted = linear_block(sigma_lim, &f, None, level, tangent);
                    for i in (0..n).filter(|&i| own(i) == strength) {
                        assert_eq!(found[i], wanted[i], "point {i} of {n}, level {level}, strength {strength}");
                        failed[f64::from_bits(found[i][8]) as usize] += 1;
                    }
                }
                for wrong in [-1.0, f64::NAN, f64::INFINITY] {
                    let mut limits = limits.clone();
                    limits[n / 2] = wrong;
                    let other = linear_block(LINEAR[SIGMA_LIM], &f, Some(&limits), level, tangent);
                    assert_eq!(other[n / 2].last(), Some(&(status::LIMIT as u64)), "{wrong}");
                    assert!((0..n).filter(|&i| i != n / 2).all(|i| other[i] == found[i]), "{wrong}");
                }
            }
        }
    }
    assert!(failed.iter().all(|&count| count > 50), "{failed:?}");
}
