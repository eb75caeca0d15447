//! The law with friction: against its truth table, against the hyperelastic law, and what is said of sliding, energy
//! and hard cases.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use nalgebra::{Matrix3, Rotation3, SMatrix, Vector3};
use proptest::prelude::*;
use serde::Deserialize;
use toron::law::block::{Points, components, components_mut};
use toron::law::frictional::Frictional;
use toron::law::interface::Law;
use toron::law::state::{FRICTIONAL_FAILED, FRICTIONAL_LOST, FRICTIONAL_STATE};
use toron::law::status;
use toron::law::stress::{first_piola_kirchhoff, matrix, truesdell_of_jaumann};
use toron::law::voigt::PAIRS;
use toron::{Arrays, Hyperelastic, Level, Measure};
use toron_test_support::block::{Number, levels};
use toron_test_support::deformations::{Ranges, Sample, deformation, rotation, samples};
use toron_test_support::truth::Truth;

const W_TD: usize = 2;
const I_TE: usize = FRICTIONAL_LOST + 1;
const SLIP: usize = FRICTIONAL_LOST + 2;

type State<T> = [T; FRICTIONAL_STATE];

/// The properties of a yarn along m.
#[derive(Clone, Copy, Debug, Deserialize)]
struct Yarn {
    k_el: f64,
    k_tc: f64,
    p: f64,
    k_td: f64,
    k_ld: f64,
    mu: f64,
    cohesion: f64,
}

const KEVLAR: Yarn = Yarn { k_el: 82341.0, k_tc: 1055.0, p: 2.2, k_td: 649.74, k_ld: 0.0, mu: 0.25, cohesion: 0.3 };

impl Yarn {
    fn properties(&self, m: [f64; 3]) -> [f64; 13] {
        let Yarn { k_el, k_tc, p, k_td, k_ld, mu, cohesion } = *self;
        [k_el, k_tc, p, k_td, k_ld, 0.0, 0.0, 0.0, m[0], m[1], m[2], mu, cohesion]
    }

    fn law<T: Number>(&self, m: [f64; 3]) -> Frictional<T> {
        Frictional::new(&self.properties(m).map(T::splat)).expect("valid properties")
    }
}

/// What the law says of a point.
#[derive(Clone, Debug)]
struct Answer<T> {
    stress: [T; 6],
    tangent: Vec<T>,
    wave_speed: T,
    status: i32,
}

/// The points after a step from these states, which it replaces; a tangent of the measure, if one is given.
fn step<T: Number>(
    law: &Frictional<T>,
    level: Level,
    f: &[Matrix3<f64>],
    states: &mut [State<T>],
    measure: Option<Measure>,
) -> Vec<Answer<T>> {
    let (n, entries) = (f.len(), measure.map_or(0, Measure::components));
    let of =
        |rows: usize, at: &dyn Fn(usize, usize) -> T| -> Vec<T> { (0..rows * n).map(|k| at(k / n, k % n)).collect() };
    let columns = of(9, &|c, i| T::splat(f[i][c]));
    let mut state = of(FRICTIONAL_STATE, &|c, i| states[i][c]);
    let (mut stress, mut tangent, mut speed) =
        (of(6, &|_, _| T::default()), vec![T::default(); entries * n], vec![T::default(); n]);
    let mut codes = vec![1; n];
    let points = Points {
        f_new: components(columns.as_ptr(), n),
        state_old: Frictional::<T>::parts(state.as_ptr(), n),
        state_new: Frictional::<T>::parts_mut(state.as_mut_ptr(), n),
        stress: components_mut(stress.as_mut_ptr(), n),
        tangent: if entries > 0 { tangent.as_mut_ptr() } else { std::ptr::null_mut() },
        measure: measure.unwrap_or_default(),
        density: T::splat(1.0),
        wave_speed: speed.as_mut_ptr(),
        status: codes.as_mut_ptr(),
        level: Some(level),
        ..Points::without_arrays(n, n)
    };
    // SAFETY: every array has a value for each of the points' components.
    let worst = unsafe { law.step(&points) };
    assert_eq!(worst, Ok(codes.iter().copied().min().unwrap_or(0)));
    for (i, old) in states.iter_mut().enumerate() {
        *old = std::array::from_fn(|c| state[c * n + i]);
    }
    (0..n)
        .map(|i| Answer {
            stress: std::array::from_fn(|c| stress[c * n + i]),
            tangent: (0..entries).map(|c| tangent[c * n + i]).collect(),
            wave_speed: speed[i],
            status: codes[i],
        })
        .collect()
}

/// One point, which can be evaluated.
fn one(law: &Frictional<f64>, f: &Matrix3<f64>, state: &mut State<f64>) -> [f64; 6] {
    let mut states = [*state];
    let answer = step(law, Level::best(), &[*f], &mut states, None);
    assert_eq!(answer[0].status, status::OK);
    *state = states[0];
    answer[0].stress
}

/// A tangent of one point, whose new state is dropped.
fn tangent(law: &Frictional<f64>, f: &Matrix3<f64>, state: &State<f64>, measure: Measure) -> Vec<f64> {
    let answer = step(law, Level::best(), &[*f], &mut [*state], Some(measure));
    assert_eq!(answer[0].status, status::OK);
    answer[0].tangent.clone()
}

fn numbers(values: &[Truth]) -> Vec<f64> {
    values.iter().map(Truth::value).collect()
}

// ---------------------------------------------------------------------------------------------------------------------
// The truth

#[derive(Deserialize)]
struct Case {
    id: usize,
    family: String,
    properties: Yarn,
    m: [f64; 3],
    /// d1, d2, I_te and w_fr before the first step.
    before: [f64; 4],
    path: Vec<[[f64; 3]; 3]>,
    after: Vec<After>,
}

#[derive(Deserialize)]
struct After {
    /// 11 22 33 12 13 23
    sigma: [Truth; 6],
    i_te: Truth,
    w_fr: Truth,
    slip: Option<[Truth; 2]>,
    slips: bool,
    margin: Truth,
    #[serde(rename = "K")]
    sensitivity: Sensitivity,
    ddsdde: Option<Vec<Vec<Truth>>>,
}

/// What a rounding of F, of the old slip and of the old I_te does, over a rounding.
#[derive(Deserialize)]
struct Sensitivity {
    sigma: Truth,
    slip: Option<Truth>,
    i_te: Truth,
    w_fr: Truth,
}

fn cases() -> Vec<Case> {
    let table = include_str!("../truth/friction.jsonl");
    table.lines().map(|line| serde_json::from_str(line).expect("a case")).collect()
}

impl Case {
    fn gradients(&self) -> Vec<Matrix3<f64>> {
        self.path.iter().map(|rows| Matrix3::from_fn(|i, j| rows[i][j])).collect()
    }

    fn start<T: Number>(&self) -> State<T> {
        let mut state = [T::default(); FRICTIONAL_STATE];
        let [d1, d2, i_te, lost] = self.before.map(T::splat);
        (state[SLIP], state[SLIP + 1], state[I_TE], state[FRICTIONAL_LOST]) = (d1, d2, i_te, lost);
        state
    }

    /// The worst error of stress, slip, I_te and w_fr along the path, in roundings of the value and of what roundings
    /// of the input do to it; flags that are wrong although the limit is not near.
    fn score<T: Number>(&self, level: Level, margin: f64) -> ([f64; 4], usize) {
        let law = self.properties.law::<T>(self.m);
        // Alone, and as the last of some.
        let count = 3 + 2 * (self.id % 8);
        let mut states = vec![self.start::<T>(); count];
        let (mut worst, mut wrong, mut sums) = ([0.0; 4], 0, [0.0; 4]);
        for (f, after) in self.gradients().iter().zip(&self.after) {
            let old = states[count - 1];
            let answers = step(&law, level, &vec![*f; count], &mut states, None);
            let (answer, new) = (&answers[count - 1], states[count - 1]);
            assert_eq!(answer.status, status::OK, "case {}", self.id);
            let stress = [0, 1, 2, 3, 5, 4].map(|c| answer.stress[c].into());
            let slip = after.slip.as_ref().zip(after.sensitivity.slip.as_ref());
            let measured: [(&[Truth], &[f64], Option<&Truth>); 4] = [
                (&after.sigma, &stress, Some(&after.sensitivity.sigma)),
                match slip {
                    Some((truth, sensitivity)) => (truth, &[new[SLIP].into(), new[SLIP + 1].into()], Some(sensitivity)),
                    None => (&[], &[], None),
                },
                (std::slice::from_ref(&after.i_te), &[new[I_TE].into()], Some(&after.sensitivity.i_te)),
                (std::slice::from_ref(&after.w_fr), &[new[FRICTIONAL_LOST].into()], Some(&after.sensitivity.w_fr)),
            ];
            for (k, (truth, value, sensitivity)) in measured.into_iter().enumerate() {
                let Some(sensitivity) = sensitivity else { continue };
                sums[k] += sensitivity.value();
                let weight = |c: usize| if truth.len() == 6 && c >= 3 { 2.0 } else { 1.0 };
                let norm =
                    |at: &dyn Fn(usize) -> f64| (0..truth.len()).map(|c| weight(c) * at(c).powi(2)).sum::<f64>().sqrt();
                let error = norm(&|c| truth[c].error(value[c]));
                let scale = T::ROUNDING * (norm(&|c| truth[c].value()) + sums[k]);
                worst[k] = f64::max(worst[k], if error == 0.0 { 0.0 } else { error / scale });
            }
            let slid = new[SLIP..SLIP + 2] != old[SLIP..SLIP + 2] || new[FRICTIONAL_LOST] != old[FRICTIONAL_LOST];
            if after.margin.value().abs() > margin && slid != after.slips {
                wrong += 1;
            }
        }
        (worst, wrong)
    }
}

fn assert_true<T: Number>(bound: f64, margin: f64, fits: impl Fn(&Case) -> bool) {
    let mut found = BTreeMap::<_, ([f64; 4], usize)>::new();
    for case in cases().iter().filter(|case| fits(case)) {
        for level in levels() {
            let (worst, wrong) = case.score::<T>(level, margin);
            let entry = found.entry(case.family.clone()).or_default();
            entry.0 = std::array::from_fn(|k| entry.0[k].max(worst[k]));
            entry.1 += wrong;
        }
    }
    assert!(found.len() >= 9, "{:?}", found.keys());
    for (family, (worst, wrong)) in found {
        assert!(worst.iter().all(|&x| x <= bound), "{family}: {worst:?}");
        assert_eq!(wrong, 0, "{family}: flags");
    }
}

#[test]
fn truth_in_double_precision() {
    assert_true::<f64>(2.0, 1e-12, |_| true);
}

#[test]
fn truth_in_single_precision() {
    // To aspects of the slip of a thousand, and where rounding F to single precision leaves the point on its side of
    // the limit and of the kink at I_tc = 0.
    let resolved = |case: &Case| !["small", "limit"].contains(&case.family.as_str());
    assert_true::<f32>(2.0, 3e-4, |case| resolved(case) && case.before[0].hypot(case.before[1]) <= 500.0);
}

#[test]
fn tangents_are_those_of_the_truth() {
    let mut compared = 0;
    for case in cases() {
        let (law, gradients) = (case.properties.law::<f64>(case.m), case.gradients());
        let (Some(last), Some(f)) = (case.after.last(), gradients.last()) else { continue };
        let Some(truth) = &last.ddsdde else { continue };
        // At rest and at the limit the tangent is what the kinks make of it.
        if ["rest", "limit"].contains(&case.family.as_str()) || last.margin.value().abs() <= 1e-12 {
            continue;
        }
        let mut state = case.start();
        for f in &gradients[..gradients.len() - 1] {
            one(&law, f, &mut state);
        }
        let truth: Vec<_> = truth.iter().map(|row| numbers(row)).collect();
        let order = [0, 1, 2, 3, 5, 4];
        let here = tangent(&law, f, &state, Measure::Jaumann);
        let distance = |tangent: &[f64], to: &dyn Fn(usize, usize) -> f64| {
            let square = |k: usize| (tangent[6 * order[k / 6] + order[k % 6]] - to(k / 6, k % 6)).powi(2);
            (0..36).map(square).sum::<f64>().sqrt()
        };
        let size = distance(&[0.0; 36], &|i, j| truth[i][j]);
        let error = distance(&here, &|i, j| truth[i][j]);
        // What an ulp of an entry of F does.
        let mut moved = 0.0_f64;
        for entry in 0..9 {
            for towards in [f64::next_up, f64::next_down] {
                let mut f = *f;
                f[entry] = towards(f[entry]);
                let there = tangent(&law, &f, &state, Measure::Jaumann);
                moved = moved.max(distance(&there, &|i, j| here[6 * order[i] + order[j]]));
            }
        }
        assert!(error <= 1e-12 * size + 4.0 * moved, "case {}: {error:e} of {size:e}, an ulp of F {moved:e}", case.id);
        compared += 1;
    }
    assert!(compared >= 64, "{compared}");
}

// ---------------------------------------------------------------------------------------------------------------------
// The hyperelastic law, and derivatives

/// Deformations that press a section, and some that do not.
fn pressed() -> impl Strategy<Value = Sample> {
    let calm = Ranges { i_el: -0.02..0.05, i_tc: -0.2..0.05, i_td: 0.0..0.1, i_ld: 0.0..0.2 };
    let wild = Ranges { i_el: -0.3..0.4, i_tc: -0.8..0.2, i_td: 0.0..1.0, i_ld: 0.0..1.0 };
    prop_oneof![deformation(calm), deformation(wild)]
}

#[test]
fn where_nothing_has_slid_it_is_the_hyperelastic_law_bit_by_bit() {
    let yarns = [0.0, 700.0].map(|k_ld| Yarn { k_ld, cohesion: 1e20, ..KEVLAR });
    for (yarn, m) in yarns.into_iter().flat_map(|yarn| [[1.0, 0.0, 0.0], [0.3, -0.5, 0.8]].map(|m| (yarn, m))) {
        let gradients: Vec<_> = samples(pressed(), 200).map(|sample| sample.f).collect();
        let n = gradients.len();
        let columns: Vec<f64> = (0..9 * n).map(|k| gradients[k % n][k / n]).collect();
        for level in levels() {
            let mut states = vec![[0.0; FRICTIONAL_STATE]; n];
            let answers = step(&yarn.law(m), level, &gradients, &mut states, None);
            let law = Hyperelastic::<f64>::new(&yarn.properties(m)[..11]).expect("valid properties");
            let (mut stress, mut energies, mut invariants) = (vec![0.0; 6 * n], vec![0.0; 4 * n], vec![0.0; 4 * n]);
            law.block(Arrays {
                n,
                leading_dimension: n,
                deformation_gradient: &columns,
                stress: Some(&mut stress),
                energies: Some(&mut energies),
                invariants: Some(&mut invariants),
                level: Some(level),
                ..Arrays::default()
            })
            .expect("a block");
            for (i, (answer, state)) in answers.iter().zip(&states).enumerate() {
                assert_eq!(answer.stress, std::array::from_fn(|c| stress[c * n + i]), "{level:?}, point {i}");
                for c in 0..4 {
                    assert_eq!([state[c], state[4 + c]], [energies[c * n + i], invariants[c * n + i]]);
                }
            }
        }
    }
}

/// A state that has slid on a path, and the next deformation.
fn slid(law: &Frictional<f64>, seed: usize) -> (State<f64>, Matrix3<f64>) {
    let mut path = samples((pressed(), pressed(), pressed()), seed + 1);
    let (a, b, c) = path.nth(seed).expect("a path");
    let mut state = [0.0; FRICTIONAL_STATE];
    one(law, &a.f, &mut state);
    one(law, &b.f, &mut state);
    (state, c.f)
}

#[test]
fn tangents_are_derivatives_sliding_or_not() {
    let (mut sliding, mut sticking) = (0, 0);
    for seed in 0..120 {
        let yarn = Yarn {
            k_ld: [0.0, 800.0][seed % 2],
            mu: [0.1, 0.6][seed / 2 % 2],
            cohesion: [0.0, 20.0, 300.0][seed / 4 % 3],
            p: [2.2, 3.0][seed / 12 % 2],
            ..KEVLAR
        };
        let law = yarn.law([[1.0, 0.0, 0.0], [0.4, 0.7, -0.3]][seed / 24 % 2]);
        let (state, f) = slid(&law, seed);
        let stress = |f: &Matrix3<f64>| {
            let mut new = state;
            let stress = one(&law, f, &mut new);
            (first_piola_kirchhoff(&stress, f), new[SLIP..SLIP + 2] != state[SLIP..SLIP + 2])
        };
        let nominal = SMatrix::<f64, 9, 9>::from_row_slice(&tangent(&law, &f, &state, Measure::Nominal));
        let mut numeric = SMatrix::<f64, 9, 9>::zeros();
        let here = stress(&f).1;
        let mut kink = false;
        for entry in 0..9 {
            let [after, before] = [1e-6, -1e-6].map(|h| {
                let mut f = f;
                f[entry] += h;
                stress(&f)
            });
            kink |= after.1 != here || before.1 != here;
            numeric.set_column(
                entry,
                &(((after.0 - before.0) / 2e-6).reshape_generic(nalgebra::Const::<9>, nalgebra::Const::<1>)),
            );
        }
        if kink {
            continue;
        }
        let scale = numeric.norm();
        assert!((nominal - numeric).norm() <= 2e-6 * scale, "seed {seed}: {:e}", (nominal - numeric).norm() / scale);
        if here {
            sliding += 1
        } else {
            sticking += 1
        }

        // The 6×6 measures are the same derivative.
        let cauchy = matrix(&one(&law, &f, &mut state.clone()));
        let (inverse, jacobian) = (f.try_inverse().expect("F"), f.determinant());
        let [material, truesdell, jaumann] =
            [Measure::Material, Measure::Truesdell, Measure::Jaumann].map(|measure| tangent(&law, &f, &state, measure));
        let at = |c: &[f64], i: usize, j: usize, k: usize, l: usize| {
            let voigt = |i, j| PAIRS.iter().position(|&pair| pair == (i, j) || pair == (j, i)).expect("a pair");
            c[6 * voigt(i, j) + voigt(k, l)]
        };
        let mut errors = [0.0_f64; 2];
        for (row, column) in (0..9).flat_map(|row| (0..9).map(move |column| (row, column))) {
            let ((i, big_j), (k, big_l)) = ((row % 3, row / 3), (column % 3, column / 3));
            let (mut from_material, mut from_truesdell) = (0.0, 0.0);
            for (x, y) in (0..3).flat_map(|x| (0..3).map(move |y| (x, y))) {
                from_material += f[(i, x)] * f[(k, y)] * at(&material, x, big_j, y, big_l);
                let spatial = at(&truesdell, i, x, k, y) + if i == k { cauchy[(x, y)] } else { 0.0 };
                from_truesdell += jacobian * inverse[(big_j, x)] * inverse[(big_l, y)] * spatial;
            }
            if i == k {
                let second = jacobian * inverse * cauchy * inverse.transpose();
                from_material += second[(big_j, big_l)];
            }
            let exact = nominal[(row, column)];
            errors = [errors[0].max((from_material - exact).abs()), errors[1].max((from_truesdell - exact).abs())];
        }
        assert!(errors.iter().all(|&error| error <= 1e-12 * scale), "seed {seed}: {errors:?} of {scale:e}");
        let rows: [[f64; 6]; 6] = std::array::from_fn(|i| std::array::from_fn(|j| jaumann[6 * i + j]));
        let other = truesdell_of_jaumann(&rows, &one(&law, &f, &mut state.clone()));
        let size = truesdell.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        for (x, y) in other.as_flattened().iter().zip(&truesdell) {
            assert!((x - y).abs() <= 1e-12 * size, "seed {seed}");
        }
    }
    assert!(sliding >= 20 && sticking >= 20, "{sliding} {sticking}");
}

#[test]
fn no_wave_is_faster_than_the_bound() {
    let mut closest = 0.0_f64;
    for seed in 0..400 {
        let yarn = Yarn { k_ld: [0.0, 800.0][seed % 2], mu: 0.9, cohesion: [0.0, 100.0][seed / 2 % 2], ..KEVLAR };
        // Without elongation, so that the section's waves count.
        let law = Yarn { k_el: [0.0, 82341.0][seed / 4 % 2], ..yarn }.law([1.0, 0.0, 0.0]);
        let (state, f) = slid(&law, seed);
        let answer = &step(&law, Level::best(), &[f], &mut [state], Some(Measure::Nominal))[0];
        for (n, u) in
            samples((rotation(), rotation()), 60).map(|(n, u)| (n.column(0).into_owned(), u.column(0).into_owned()))
        {
            // Directions of the deformed placement, carried back: N = Fᵀn, ρ0 c² = A_iJkL u_i N_J u_k N_L.
            let big: Vector3<f64> = f.transpose() * n;
            let mut modulus = 0.0;
            for (row, column) in (0..9).flat_map(|row| (0..9).map(move |column| (row, column))) {
                modulus +=
                    answer.tangent[9 * row + column] * u[row % 3] * big[row / 3] * u[column % 3] * big[column / 3];
            }
            let bound = answer.wave_speed.powi(2);
            assert!(modulus <= bound * (1.0 + 1e-12), "seed {seed}: {modulus:e} {bound:e}");
            closest = closest.max(modulus / bound);
        }
    }
    assert!(closest > 0.3, "{closest}");
}

// ---------------------------------------------------------------------------------------------------------------------
// Energy, paths, invariance

/// A smooth path that presses, shears and turns the section, at a time from 0 to 1.
fn path(seed: u64, t: f64) -> Matrix3<f64> {
    let mut random = fastrand::Rng::with_seed(seed);
    let mut wave = |size: f64| {
        let (a, b, c) = (random.f64() - 0.5, random.f64() * 6.0 + 1.0, TAU * random.f64());
        size * a * ((b * t + c).sin() - c.sin())
    };
    let mut f = Matrix3::identity() + Matrix3::from_fn(|_, _| wave(0.3));
    let squeeze = 1.0 - wave(0.4).abs();
    f.set_column(1, &(f.column(1) * squeeze));
    Rotation3::from_euler_angles(wave(2.0), wave(2.0), wave(2.0)).into_inner() * f
}

fn energy(state: &State<f64>) -> f64 {
    state[..4].iter().sum::<f64>() + state[FRICTIONAL_LOST]
}

/// Work less what is stored and lost, on a path of so many steps.
fn miss(law: &Frictional<f64>, seed: u64, steps: usize) -> (f64, State<f64>) {
    let mut state = [0.0; FRICTIONAL_STATE];
    let (mut work, mut old) = (0.0, (path(seed, 0.0), Matrix3::zeros()));
    old.1 = first_piola_kirchhoff(&one(law, &old.0, &mut state), &old.0);
    let start = energy(&state);
    for i in 1..=steps {
        let f = path(seed, i as f64 / steps as f64);
        let lost = state[FRICTIONAL_LOST];
        let p = first_piola_kirchhoff(&one(law, &f, &mut state), &f);
        assert!(state[FRICTIONAL_LOST] >= lost, "what is lost never falls");
        work += 0.5 * (p + old.1).dot(&(f - old.0));
        old = (f, p);
    }
    (work - (energy(&state) - start), state)
}

#[test]
fn work_is_stored_or_lost_to_first_order_in_the_step() {
    let mut halved = Vec::new();
    for seed in 0..24 {
        let law = Yarn { cohesion: [0.0, 1.0, 10.0][seed as usize % 3], ..KEVLAR }.law([1.0, 0.0, 0.0]);
        let (coarse, state) = miss(&law, seed, 40_000);
        let (fine, _) = miss(&law, seed, 80_000);
        assert!(coarse.abs() <= 0.01 * energy(&state), "seed {seed}: {coarse:e} of {:e}", energy(&state));
        // Where the first order all but vanishes, the second shows.
        if coarse.abs() > 1e-6 * energy(&state) {
            halved.push(coarse / fine);
        }
    }
    assert!(halved.len() >= 12, "{halved:?}");
    assert!(halved.iter().all(|ratio| (1.8..2.2).contains(ratio)), "{halved:?}");
}

#[test]
fn a_coaxial_path_ends_the_same_in_one_step_and_in_a_thousand() {
    for seed in 0..40 {
        let mut random = fastrand::Rng::with_seed(seed);
        let law = Yarn { cohesion: [0.0, 3.0][seed as usize % 2], ..KEVLAR }.law([1.0, 0.0, 0.0]);
        // The section is pressed to its area first, and then drawn out along fixed axes.
        let (area, aspect, angle) = (-0.3 * random.f64(), 0.2 + random.f64(), 3.0 * random.f64());
        let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), angle).into_inner();
        let at = |t: f64| {
            let stretch = Vector3::new(1.01, (area + aspect * t).exp(), (area - aspect * t).exp());
            turn * Matrix3::from_diagonal(&stretch) * turn.transpose()
        };
        let mut ends = [1, 1000].map(|steps| {
            let mut state = [0.0; FRICTIONAL_STATE];
            let mut stress = one(&law, &at(0.0), &mut state);
            for i in 1..=steps {
                stress = one(&law, &at(f64::from(i) / f64::from(steps)), &mut state);
            }
            stress
        });
        let [single, many] = &mut ends;
        let size = single.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        let apart = single.iter().zip(many).fold(0.0_f64, |apart, (x, y)| apart.max((*x - *y).abs()));
        // Eight roundings of the stress, and of what roundings of F do to it along the fibre and across.
        let allowed = 8.0 * f64::EPSILON * (size + 2.0 * (82341.0 + 1055.0 + 649.74));
        assert!(apart <= allowed, "seed {seed}: {apart:e}, {allowed:e}");
    }
}

#[test]
fn a_release_in_one_step_loses_what_a_thousand_lose() {
    // Pressed and distorted within the limit; when the pressure goes, so does what held the shape.
    let law = Yarn { cohesion: 0.0, mu: 0.5, ..KEVLAR }.law([1.0, 0.0, 0.0]);
    let at = |area: f64| Matrix3::from_diagonal(&Vector3::new(1.01, (area + 0.02).exp(), (area - 0.02).exp()));
    let lost = [1, 1000].map(|steps| {
        let mut state = [0.0; FRICTIONAL_STATE];
        one(&law, &at(-0.3), &mut state);
        assert_eq!(state[FRICTIONAL_LOST], 0.0, "nothing slides under pressure");
        let held = state[W_TD];
        for i in 1..=steps {
            one(&law, &at(-0.3 * (1.0 - f64::from(i) / f64::from(steps))), &mut state);
        }
        assert!(state[I_TE] <= 1e-12);
        (state[FRICTIONAL_LOST], held)
    });
    for (lost, held) in lost {
        assert!((lost - held).abs() <= 1e-12 * held, "{lost:e} {held:e}");
    }
}

#[test]
fn the_answer_turns_with_the_point_and_does_not_depend_on_the_transverse_axes() {
    for (seed, q) in samples(rotation(), 60).enumerate() {
        let seed = seed as u64;
        let yarn = Yarn { k_ld: [0.0, 300.0][seed as usize % 2], ..KEVLAR };
        let m = q.column(0).into_owned();
        let (straight, oblique) = (yarn.law([1.0, 0.0, 0.0]), yarn.law([m.x, m.y, m.z]));
        let turned = Rotation3::from_axis_angle(&Vector3::x_axis(), 0.1 * seed as f64).into_inner();
        let mut states = [[0.0; FRICTIONAL_STATE]; 4];
        for i in 1..=50 {
            let f = path(seed, f64::from(i) / 50.0);
            let plain = matrix(&one(&straight, &f, &mut states[0]));
            let in_space = matrix(&one(&straight, &(q * f), &mut states[1]));
            // Another fibre direction, and the same with the transverse axes turned about it.
            let of_fibre = matrix(&one(&oblique, &(f * q.transpose()), &mut states[2]));
            let about_fibre = matrix(&one(&straight, &(f * turned), &mut states[3]));
            let size = plain.norm() + 100.0;
            assert!((q * plain * q.transpose() - in_space).norm() <= 1e-11 * size, "seed {seed} step {i}");
            assert!((plain - of_fibre).norm() <= 1e-11 * size, "seed {seed} step {i}");
            assert!((plain - about_fibre).norm() <= 1e-11 * size, "seed {seed} step {i}");
            for state in &states[1..] {
                assert!((state[FRICTIONAL_LOST] - states[0][FRICTIONAL_LOST]).abs() <= 1e-10);
            }
        }
        assert!(states[0][FRICTIONAL_LOST] > 0.0, "seed {seed}: nothing slid");
    }
}

// ---------------------------------------------------------------------------------------------------------------------
// Hard cases

#[test]
fn a_loose_section_without_cohesion_has_no_stress_across() {
    let law = Yarn { cohesion: 0.0, ..KEVLAR }.law([1.0, 0.0, 0.0]);
    let mut state = [0.0; FRICTIONAL_STATE];
    for i in 0..200 {
        let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), 0.3 * f64::from(i)).into_inner();
        let loose = Matrix3::from_diagonal(&Vector3::new(1.01, 3.0, 0.4));
        let [s11, across @ ..] = one(&law, &(turn * loose * turn.transpose()), &mut state);
        assert!(s11 > 0.0 && across == [0.0; 5], "{across:?}");
        assert_eq!([state[W_TD], state[I_TE]], [0.0; 2]);
    }
}

#[test]
fn without_a_stiffness_nothing_slides() {
    let law = Yarn { k_td: 0.0, cohesion: 0.0, mu: 0.0, ..KEVLAR }.law([1.0, 0.0, 0.0]);
    let mut state = [0.0; FRICTIONAL_STATE];
    for i in 0..100 {
        one(&law, &path(7, f64::from(i) / 100.0), &mut state);
        assert_eq!(state[SLIP..SLIP + 2], [0.0; 2]);
    }
    assert_eq!(state[FRICTIONAL_LOST], 0.0);
}

#[test]
fn a_bad_step_between_good_ones_changes_nothing() {
    let law = KEVLAR.law::<f64>([1.0, 0.0, 0.0]);
    let bad = [
        (Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, 1.0)), status::INVERTED),
        (Matrix3::identity() * f64::NAN, status::NOT_FINITE),
        (Matrix3::from_diagonal(&Vector3::new(1e60, 1.0, 1.0)), status::OVERFLOW),
    ];
    for level in levels() {
        for (f, code) in bad {
            let mut states = [[0.0; FRICTIONAL_STATE]; 9];
            for i in 0..20 {
                let good = [path(3, f64::from(i) / 20.0); 9];
                step(&law, level, &good, &mut states, None);
                let before = states;
                let mut mixed = good;
                mixed[4] = f;
                let answers = step(&law, level, &mixed, &mut states, Some(Measure::Jaumann));
                assert_eq!(answers[4].status, code);
                assert_eq!(answers[4].stress, [0.0; 6]);
                assert!(answers[4].tangent.iter().all(|&x| x == 0.0));
                // It keeps its state; `alive` is written.
                assert_eq!(states[4][..FRICTIONAL_FAILED], before[4][..FRICTIONAL_FAILED]);
                assert_eq!(answers[3].status, status::OK);
            }
            assert!(states[0][FRICTIONAL_LOST] > 0.0);
        }
    }
}

#[test]
fn an_old_state_without_meaning_is_reported_and_kept_finite() {
    let law = KEVLAR.law::<f64>([1.0, 0.0, 0.0]);
    for level in levels() {
        for row in [FRICTIONAL_LOST, I_TE, SLIP, SLIP + 1, FRICTIONAL_FAILED] {
            for wrong in [f64::NAN, f64::INFINITY] {
                let mut states = [[0.0; FRICTIONAL_STATE]; 5];
                states[2][row] = wrong;
                let answers = step(&law, level, &[path(3, 0.3); 5], &mut states, None);
                assert_eq!(answers[2].status, status::STATE_NOT_FINITE, "row {row}, {wrong}");
                assert!(states[2].iter().all(|x| x.is_finite()), "{:?}", states[2]);
                assert_eq!(answers[1].status, status::OK);
            }
        }
        // Without a new state the old one is read all the same.
        for row in [FRICTIONAL_LOST, I_TE, SLIP, SLIP + 1] {
            let (f, mut old, mut stress, mut code) = (path(3, 0.3), [0.0; FRICTIONAL_STATE], [0.0; 6], 0);
            old[row] = f64::NAN;
            let points = Points {
                f_new: components(f.as_slice().as_ptr(), 1),
                state_old: Frictional::<f64>::parts(old.as_ptr(), 1),
                stress: components_mut(stress.as_mut_ptr(), 1),
                status: &mut code,
                level: Some(level),
                ..Points::without_arrays(1, 1)
            };
            // SAFETY: each array has the values of one point.
            assert_eq!(unsafe { law.step(&points) }.expect("the arguments are right"), status::STATE_NOT_FINITE);
        }
        // A slip too large for its section.
        let mut states = [[0.0; FRICTIONAL_STATE]; 5];
        states[2][SLIP] = 1e200;
        let answers = step(&law, level, &[path(3, 0.3); 5], &mut states, None);
        assert_eq!(answers[2].status, status::OVERFLOW);
        assert_eq!(states[2][SLIP], 1e200);
    }
}

#[test]
fn a_point_that_has_failed_keeps_what_it_lost() {
    let mut properties = KEVLAR.properties([1.0, 0.0, 0.0]);
    properties[5] = 0.01;
    let law = Frictional::<f64>::new(&properties).expect("valid properties");
    let mut state = [0.0; FRICTIONAL_STATE];
    let pressed = |stretch: f64| Matrix3::from_diagonal(&Vector3::new(stretch, 1.1, 0.8));
    one(&law, &pressed(1.0), &mut state);
    assert_eq!(state[FRICTIONAL_FAILED], 0.0);
    assert!(one(&law, &pressed(1.02), &mut state)[0] > 0.0);
    assert_eq!(state[FRICTIONAL_FAILED], 1.0);
    let (frozen, lost) = (state, state[FRICTIONAL_LOST]);
    assert!(lost > 0.0);
    assert_eq!(one(&law, &pressed(1.3), &mut state), [0.0; 6]);
    assert_eq!(state, frozen);
}

#[test]
fn wrong_properties_are_named() {
    let mut properties = KEVLAR.properties([1.0, 0.0, 0.0]);
    for (value, named) in [(1.0, "mu"), (-0.1, "mu"), (f64::NAN, "mu")] {
        properties[11] = value;
        let error = Frictional::<f64>::new(&properties).expect_err("a wrong property").to_string();
        assert!(error.contains(named) && error.contains("from 0 to below 1"), "{error}");
    }
    let single: [f32; 13] = KEVLAR.properties([1.0, 0.0, 0.0]).map(|x| x as f32);
    assert!(Frictional::<f32>::new(&single).is_ok());
    assert!(Frictional::<f64>::new(&properties[..11]).is_err());
}

/// d1, d2, I_te and w_fr after so many steps of [`a_million_steps_drift_by_few_roundings`], in 40 digits by the
/// formulas of docs/reference/theory.md.
const DRIFT: [(u32, [f64; 4]); 3] = [
    (1_000, [-0.030_655_847_710_926_39, 0.021_636_067_606_001_67, 0.002_927_340_399_679_24, 0.032_322_418_342_170_27]),
    (100_000, [-0.031_629_441_457_502_47, 0.003_752_061_643_506_637, 0.006_945_760_235_457_081, 4.581_700_445_923_355]),
    (
        1_000_000,
        [-0.000_491_332_259_628_604_6, -0.015_134_599_386_249_148, 0.001_856_670_845_490_880_6, 45.722_609_688_828_26],
    ),
];

/// A wave of whole numbers, from 0 up to half a period and back.
fn triangle(i: u32, period: u32) -> f64 {
    let x = i % period;
    f64::from(x.min(period - x))
}

#[test]
fn a_million_steps_drift_by_few_roundings() {
    let yarn = Yarn { k_el: 0.0, p: 3.0, k_td: 649.75, mu: 0.25, cohesion: 0.5, ..KEVLAR };
    let law = yarn.law([1.0, 0.0, 0.0]);
    let mut state = [0.0; FRICTIONAL_STATE];
    let mut marks = DRIFT.iter();
    let mut next = marks.next();
    for i in 1..=1_000_000_u32 {
        let [a, b] = [triangle(i, 4096), triangle(i + 1000, 6144)].map(|x| x / 32768.0);
        let [s, t] = [triangle(i + 500, 10240) - 2560.0, triangle(i + 2500, 2048) - 512.0].map(|x| x / 65536.0);
        one(&law, &Matrix3::new(1.0078125, 0.0, 0.0, 0.0, 1.0 - a, s, 0.0, t, 1.0 - b), &mut state);
        let Some((steps, [d1, d2, i_te, lost])) = next else { break };
        if i == *steps {
            for (value, exact) in [(state[SLIP], d1), (state[SLIP + 1], d2), (state[I_TE], i_te)] {
                assert!((value - exact).abs() <= 1e-13, "{steps}: {value} {exact}");
            }
            // Every step rounds the sum.
            let allowed = 4.0 * f64::EPSILON * f64::from(*steps).sqrt() * lost;
            assert!((state[FRICTIONAL_LOST] - lost).abs() <= allowed, "{steps}: {} {lost}", state[FRICTIONAL_LOST]);
            next = marks.next();
        }
    }
}
