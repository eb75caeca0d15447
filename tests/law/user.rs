//! A law of one's own through the safe trait: the standard reinforcing model of `examples/own_law` against exact
//! arithmetic, and a law that reads all there is to read.

use std::array;

use fastrand::Rng;
use nalgebra::{Matrix3, Vector3};
use toron::law::block::{Precision, Strides};
use toron::law::interface::{Law, Points};
use toron::law::status;
use toron::law::stress::{components, first_piola_kirchhoff, matrix, pulled_back, truesdell_of_jaumann};
use toron::law::user::User;
use toron::law::voigt::{PAIRS, VOIGT};
use toron::user::parameters::{NUMBER, Property, STRESS, positive};
use toron::user::state::{ALIVE, ENERGY_DENSITY, FAILED, StateVariable, variable};
use toron::user::vector::{dot, transposed};
use toron::user::{Description, Dual, Reads, Real, Response, Step, UserMaterial};
use toron::{Error, Level, Measure, Value};
use toron_test_support::block::levels;
use toron_test_support::exact::{Exact, exact, rounded};

use reinforced_solid::ReinforcedSolid;

type F = [[f64; 3]; 3];
const REST: F = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// A solid whose damage never heals, with the distance that its volume has gone as another state variable: it reads the
/// old state and both F, and has no fibre and no bound of the wave speed.
#[derive(Clone, Copy, Debug, Default)]
struct Damaged;

static PROPERTIES: [Property; 2] =
    [positive("mu", "μ", STRESS, None, "shear modulus"), positive("rate", "r", NUMBER, Some(0.1), "rate of damage")];

static STATE: [StateVariable; 5] = [
    variable("energy", "W", ENERGY_DENSITY, "energy per reference volume"),
    variable("damage", "d", NUMBER, "damage"),
    variable("way", "s", NUMBER, "sum of the steps of ln J by their size"),
    FAILED,
    ALIVE,
];

impl UserMaterial for Damaged {
    const DESCRIPTION: Description = Description {
        title: "damaged solid",
        properties: &PROPERTIES,
        state: &STATE,
        directions: &[],
        failed: 3,
        alive: 4,
        energies: 0..1,
        reads: Reads { old_gradient: true, ..Reads::NOTHING },
        lost: None,
        refusal: None,
    };
    type Properties<R: Real> = [R; 2];
    type State<R: Real> = [R; 3];
    type Constants<R: Real> = [R; 2];

    fn check([mu, rate]: &[f64; 2]) -> Result<(), Error> {
        let wanted = "less than mu";
        if rate < mu { Ok(()) } else { Err(Error::Argument { name: "rate", value: Value::of(*rate), wanted }) }
    }

    #[inline(always)]
    fn constants<R: Real>(properties: &[R; 2]) -> [R; 2] {
        *properties
    }

    #[inline(always)]
    fn respond<R: Real>(&[mu, rate]: &[R; 2], step: &Step<R, [R; 3]>) -> Response<R, [R; 3]> {
        let one = R::splat(1.0);
        let [x, y, z] = transposed(&step.f);
        let first = dot(x, x) + dot(y, y) + dot(z, z) - R::splat(3.0);
        let [_, damage, way] = step.state;
        let damage = damage.max(one - (-(rate * first.max(R::splat(0.0)))).exp());
        let factor = mu * (one - damage) / step.jacobian;
        let stress = [
            factor * (dot(x, x) - one),
            factor * (dot(y, y) - one),
            factor * (dot(z, z) - one),
            factor * dot(x, y),
            factor * dot(y, z),
            factor * dot(z, x),
        ];
        let [a, b, c] = step.f_old;
        let old = dot(a, [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]]);
        let state = [mu * first, damage, way + (step.jacobian / old).ln().abs()];
        Response { failed: R::splat(0.95).le(damage), ..Response::new(stress, state) }
    }
}

/// Results of a block, each point's in a row.
#[derive(Clone, Debug, PartialEq)]
struct Answer<T> {
    stress: Vec<[T; 6]>,
    state: Vec<Vec<T>>,
    tangent: Vec<Vec<T>>,
    speed: Vec<T>,
    status: Vec<i32>,
    active: Vec<T>,
    worst: i32,
}

/// What a block is evaluated from, and how.
#[derive(Clone)]
struct Given<T> {
    f_old: Vec<[T; 9]>,
    f: Vec<[T; 9]>,
    fibre: Option<Vec<[T; 3]>>,
    state: Vec<Vec<T>>,
    measure: Option<Measure>,
    waves: bool,
    level: Option<Level>,
}

/// Evaluates the points in one block, or in blocks of these sizes, the rest in the last one.
fn run<M: UserMaterial, T: Precision + Default>(law: &User<M, T>, given: &Given<T>, sizes: &[usize]) -> Answer<T> {
    let (n, rows, entries) = (given.f.len(), M::DESCRIPTION.state.len(), given.measure.map_or(0, Measure::components));
    let by_component =
        |points: &[[T; 9]]| -> Vec<T> { (0..9).flat_map(|c| points.iter().map(move |f| f[c])).collect() };
    let (f_old, f) = (by_component(&given.f_old), by_component(&given.f));
    let fibre: Vec<T> = match &given.fibre {
        Some(fibre) => (0..3).flat_map(|c| fibre.iter().map(move |m| m[c])).collect(),
        None => Vec::new(),
    };
    let mut state: Vec<T> = (0..rows).flat_map(|c| given.state.iter().map(move |state| state[c])).collect();
    let mut tangent = vec![T::default(); entries * n];
    let (mut stress, mut speed, mut active) = (vec![T::default(); 6 * n], vec![T::default(); n], vec![T::default(); n]);
    let mut codes = vec![1; n];
    let (mut worst, mut first) = (0, 0);
    for &size in sizes.iter().chain([&n]) {
        let count = size.min(n - first);
        let mut points = Points::without_arrays(count, n);
        let row = |array: *const T, c: usize| array.wrapping_add(c * n + first);
        points.f_old = array::from_fn(|c| row(f_old.as_ptr(), c));
        points.f_new = array::from_fn(|c| row(f.as_ptr(), c));
        if given.fibre.is_some() {
            points.fibre = array::from_fn(|c| row(fibre.as_ptr(), c));
        }
        points.state_old = User::<M, T>::parts(row(state.as_ptr(), 0), n);
        points.state_new = User::<M, T>::parts_mut(row(state.as_ptr(), 0).cast_mut(), n);
        let _ = state.as_mut_ptr();
        points.stress = array::from_fn(|c| stress.as_mut_ptr().wrapping_add(c * n + first));
        points.status = codes.as_mut_ptr().wrapping_add(first);
        points.active = active.as_mut_ptr().wrapping_add(first);
        if let Some(measure) = given.measure {
            points.measure = measure;
            points.tangent = tangent.as_mut_ptr().wrapping_add(first);
        }
        if given.waves {
            points.density = T::splat(4.0);
            points.wave_speed = speed.as_mut_ptr().wrapping_add(first);
        }
        points.level = given.level;
        // SAFETY: the arrays have n points from `first` on.
        worst = worst.min(unsafe { law.step(&points) }.expect("a block that is right"));
        first += count;
    }
    let rows_of = |array: &[T], rows: usize| -> Vec<Vec<T>> {
        (0..n).map(|i| (0..rows).map(|c| array[c * n + i]).collect()).collect()
    };
    Answer {
        stress: (0..n).map(|i| array::from_fn(|c| stress[c * n + i])).collect(),
        state: rows_of(&state, rows),
        tangent: rows_of(&tangent, entries),
        speed,
        status: codes,
        active,
        worst,
    }
}

/// Evaluates the points in rows: all numbers of a point in one row, with gaps that nothing may write to. An old state
/// elsewhere, or in the place of the new one.
fn run_in_rows<M: UserMaterial, T: Precision + Default>(
    law: &User<M, T>,
    given: &Given<T>,
    in_place: bool,
) -> Answer<T> {
    const GAP: f64 = -7.25;
    let (n, variables) = (given.f.len(), M::DESCRIPTION.state.len());
    let entries = given.measure.map_or(0, Measure::components);
    // F at both ends, fibre, old and new state, stress, tangent: each with a gap behind it.
    let lengths = [9, 9, 3, variables, variables, 6, entries];
    let starts: [usize; 7] = array::from_fn(|k| lengths[..k].iter().sum::<usize>() + k);
    let stride = starts[6] + entries + 1;
    let mut rows = vec![T::splat(GAP); n * stride];
    for (i, row) in rows.chunks_mut(stride).enumerate() {
        row[starts[0]..][..9].copy_from_slice(&given.f_old[i]);
        row[starts[1]..][..9].copy_from_slice(&given.f[i]);
        if let Some(fibre) = &given.fibre {
            row[starts[2]..][..3].copy_from_slice(&fibre[i]);
        }
        let old = starts[if in_place { 4 } else { 3 }];
        row[old..][..variables].copy_from_slice(&given.state[i]);
    }
    let (mut speed, mut active, mut status) = (vec![T::default(); n], vec![T::default(); n], vec![1; n]);
    let base = rows.as_mut_ptr();
    let at = |k: usize, c: usize| base.wrapping_add(starts[k] + c);
    let mut points = Points::without_arrays(n, 1);
    points.strides = Strides {
        deformation_gradient: stride,
        fibre: stride,
        limit: stride,
        axes: stride,
        state: stride,
        stress: stride,
        modes: stride,
        tangent: stride,
    };
    points.f_old = array::from_fn(|c| at(0, c).cast_const());
    points.f_new = array::from_fn(|c| at(1, c).cast_const());
    if given.fibre.is_some() {
        points.fibre = array::from_fn(|c| at(2, c).cast_const());
    }
    points.state_old = User::<M, T>::parts(at(if in_place { 4 } else { 3 }, 0), 1);
    points.state_new = User::<M, T>::parts_mut(at(4, 0), 1);
    points.stress = array::from_fn(|c| at(5, c));
    if let Some(measure) = given.measure {
        (points.measure, points.tangent) = (measure, at(6, 0));
    }
    if given.waves {
        (points.density, points.wave_speed) = (T::splat(4.0), speed.as_mut_ptr());
    }
    (points.status, points.active) = (status.as_mut_ptr(), active.as_mut_ptr());
    points.level = given.level;
    // SAFETY: each row has what the strides say.
    let worst = unsafe { law.step(&points) }.expect("points that are right");
    let part = |k: usize, row: &[T]| row[starts[k]..][..lengths[k]].to_vec();
    for row in rows.chunks(stride) {
        for k in 0..7 {
            assert!(row[starts[k] + lengths[k]] == T::splat(GAP), "a gap has been written to");
        }
    }
    Answer {
        stress: rows.chunks(stride).map(|row| array::from_fn(|c| row[starts[5] + c])).collect(),
        state: rows.chunks(stride).map(|row| part(4, row)).collect(),
        tangent: rows.chunks(stride).map(|row| part(6, row)).collect(),
        speed,
        status,
        active,
        worst,
    }
}

fn flat(f: &F) -> [f64; 9] {
    array::from_fn(|c| f[c / 3][c % 3])
}

/// Fresh points at these F, all from rest.
fn fresh<M: UserMaterial>(points: &[F]) -> Given<f64> {
    Given {
        f_old: vec![flat(&REST); points.len()],
        f: points.iter().map(flat).collect(),
        fibre: None,
        state: vec![vec![0.0; M::DESCRIPTION.state.len()]; points.len()],
        measure: None,
        waves: false,
        level: None,
    }
}

/// F with principal stretches from 1 − `size` to 1 + `size` (any size below 1), at random rotations, and nearly
/// unstrained ones.
fn deformations(count: usize, size: f64) -> Vec<F> {
    let mut random = Rng::with_seed(7);
    let mut angle = || 6.3 * random.f64() - 3.0;
    let rotations: Vec<_> = (0..2 * count)
        .map(|_| nalgebra::Rotation3::from_euler_angles(angle(), angle(), angle()).into_inner())
        .collect();
    let mut random = Rng::with_seed(8);
    (0..count)
        .map(|i| {
            let size = if i % 4 == 0 { size * 10f64.powi(-(i as i32 / 4 % 12)) } else { size };
            let stretches = Vector3::from_fn(|_, _| 1.0 + size * (2.0 * random.f64() - 1.0));
            (rotations[2 * i] * Matrix3::from_diagonal(&stretches) * rotations[2 * i + 1].transpose()).into()
        })
        .collect()
}

const MU: f64 = 3.0;
const LAMBDA: f64 = 17.0;
const K: f64 = 230.0;
const FIBRE: [f64; 3] = [2.0, -1.0, 0.5];

fn reinforced(stretch_lim: f64) -> User<ReinforcedSolid, f64> {
    let [x, y, z] = FIBRE;
    User::new(&[MU, LAMBDA, K, stretch_lim, x, y, z]).expect("properties that are right")
}

/// Stress and Jaumann modulus over J of the reinforced solid in exact arithmetic, energy and stretch, for a fibre of
/// any length.
struct ExactAnswer {
    stress: [Exact; 6],
    /// Rows and columns 11 22 33 12 23 31, engineering shears.
    modulus: [[Exact; 6]; 6],
    state: [Exact; 2],
}

fn exact_answer(f: &F, fibre: [f64; 3]) -> ExactAnswer {
    let (one, half) = (exact(1.0), exact(0.5));
    let f: [[Exact; 3]; 3] = f.map(|column| column.map(exact));
    let entry = |i: usize, j: usize| &f[j][i];
    let minor = |i: usize, j: usize| {
        let [a, b, c, d] = [(i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3];
        entry(a, c) * entry(b, d) - entry(a, d) * entry(b, c)
    };
    let sum = |terms: [Exact; 3]| terms.into_iter().fold(exact(0.0), |sum, term| sum + term);
    let jacobian = sum(array::from_fn(|j| entry(0, j) * minor(0, j)));
    let b = |i: usize, j: usize| sum(array::from_fn(|k| entry(i, k) * entry(j, k)));
    let m = fibre.map(exact);
    let length = sum(array::from_fn(|k| &m[k] * &m[k]));
    let image: [Exact; 3] = array::from_fn(|i| sum(array::from_fn(|k| entry(i, k) * &m[k])));
    let square = sum(array::from_fn(|i| &image[i] * &image[i])) / &length;
    let (mu, lambda, k) = (exact(MU), exact(LAMBDA), exact(K));
    let logarithm = jacobian.ln();
    let delta = |i: usize, j: usize| if i == j { exact(1.0) } else { exact(0.0) };
    let aa = |i: usize, j: usize| &image[i] * &image[j] / &length;
    let stress: [Exact; 6] = array::from_fn(|c| {
        let (i, j) = PAIRS[c];
        let solid = &mu * (b(i, j) - delta(i, j)) + &lambda * &logarithm * delta(i, j);
        (solid + exact(2.0) * &k * (&square - &one) * aa(i, j)) / &jacobian
    });
    let at = |i: usize, j: usize| &stress[PAIRS.iter().position(|&p| p == (i, j) || p == (j, i)).expect("a pair")];
    let shear = exact(2.0) * (&mu - &lambda * &logarithm);
    let modulus = array::from_fn(|row| {
        array::from_fn(|column| {
            let ((i, j), (p, q)) = (PAIRS[row], PAIRS[column]);
            let symmetric = &half * (delta(i, p) * delta(j, q) + delta(i, q) * delta(j, p));
            let truesdell =
                &lambda * delta(i, j) * delta(p, q) + &shear * symmetric + exact(4.0) * &k * aa(i, j) * aa(p, q);
            // Dσ + σD for the strain D of a unit stretch or engineering shear.
            let d = |a: usize, b: usize| &half * (delta(a, p) * delta(b, q) + delta(a, q) * delta(b, p));
            let turned = sum(array::from_fn(|s| d(i, s) * at(s, j) + at(i, s) * d(s, j)));
            truesdell / &jacobian + turned
        })
    });
    let trace = b(0, 0) + b(1, 1) + b(2, 2);
    let energy = &half * &mu * (trace - exact(3.0)) - &mu * &logarithm
        + &half * &lambda * &logarithm * &logarithm
        + &half * &k * (&square - &one) * (&square - &one);
    ExactAnswer { stress, modulus, state: [energy, square.sqrt()] }
}

fn norm(s: &[f64; 6]) -> f64 {
    matrix(s).norm()
}

/// By how much the stress changes for a relative change of the entries of F by 1: what their rounding does to it.
fn sensitivity(law: &User<ReinforcedSolid, f64>, f: &F) -> f64 {
    const STEP: f64 = 1e-6;
    let moved = |c: usize, by: f64| {
        let mut f = *f;
        f[c / 3][c % 3] *= 1.0 + by;
        f
    };
    let points: Vec<F> = (0..9).flat_map(|c| [moved(c, STEP), moved(c, -STEP)]).collect();
    let answer = run(law, &fresh::<ReinforcedSolid>(&points), &[]);
    let rates = answer.stress.chunks(2).map(|pair| (matrix(&pair[0]) - matrix(&pair[1])) / (2.0 * STEP));
    rates.map(|rate| rate.norm_squared()).sum::<f64>().sqrt()
}

/// Half the distance from 1 to the next number.
const ROUNDING: f64 = f64::EPSILON / 2.0;

/// Roundings of |σ| + K, of W + K, and of the stretch.
#[test]
fn stress_and_state_are_those_of_exact_arithmetic() {
    let law = reinforced(0.0);
    for size in [0.05, 0.3, 0.6, 0.9] {
        let points = deformations(240, size);
        let wanted: Vec<ExactAnswer> = points.iter().map(|f| exact_answer(f, FIBRE)).collect();
        let sensitivities: Vec<f64> = points.iter().map(|f| sensitivity(&law, f)).collect();
        for level in levels() {
            let answer = run(&law, &Given { level: Some(level), ..fresh::<ReinforcedSolid>(&points) }, &[]);
            assert_eq!(answer.worst, status::OK);
            let mut worst = [0.0_f64; 3];
            for (i, wanted) in wanted.iter().enumerate() {
                let off = |found: f64, wanted: &Exact| rounded(&(exact(found) - wanted));
                let stress = wanted.stress.each_ref().map(rounded);
                let error: [f64; 6] = array::from_fn(|c| off(answer.stress[i][c], &wanted.stress[c]));
                let [energy, stretch] = wanted.state.each_ref().map(rounded);
                let roundings = [
                    norm(&error) / (norm(&stress) + sensitivities[i]),
                    off(answer.state[i][0], &wanted.state[0]).abs() / (energy + sensitivities[i]),
                    off(answer.state[i][1], &wanted.state[1]).abs() / stretch,
                ];
                for (worst, found) in worst.iter_mut().zip(roundings) {
                    *worst = worst.max(found / ROUNDING);
                }
            }
            println!("stretches 1 ± {size}, {}: stress, energy, stretch {worst:.2?} roundings", level.name());
            assert!(worst.iter().all(|&worst| worst <= 4.0), "{} {size}: {worst:?}", level.name());
        }
    }
}

#[test]
fn tangents_are_those_of_exact_arithmetic() {
    let law = reinforced(0.0);
    let points = deformations(120, 0.5);
    let wanted: Vec<ExactAnswer> = points.iter().map(|f| exact_answer(f, FIBRE)).collect();
    for level in levels() {
        let ask = |measure: Measure| {
            let given =
                Given { level: Some(level), measure: Some(measure), waves: true, ..fresh::<ReinforcedSolid>(&points) };
            run(&law, &given, &[])
        };
        let [jaumann, truesdell, material, nominal] =
            [Measure::Jaumann, Measure::Truesdell, Measure::Material, Measure::Nominal].map(ask);
        let stress_alone = run(&law, &Given { level: Some(level), ..fresh::<ReinforcedSolid>(&points) }, &[]);
        let mut worst = 0.0_f64;
        for (i, wanted) in wanted.iter().enumerate() {
            let exact_rows = wanted.modulus.iter().map(|row| row.iter().map(rounded));
            let largest = exact_rows.flatten().map(f64::abs).fold(0.0, f64::max);
            for (c, &found) in jaumann.tangent[i].iter().enumerate() {
                worst = worst.max(rounded(&(exact(found) - &wanted.modulus[c / 6][c % 6])).abs() / largest);
            }
            // The other measures from the first one.
            let rows: [[f64; 6]; 6] = array::from_fn(|r| array::from_fn(|c| jaumann.tangent[i][6 * r + c]));
            let (cauchy, f) = (jaumann.stress[i], Matrix3::from(points[i]));
            let near = |found: &[f64], wanted: &[f64]| {
                let size = wanted.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
                found.iter().zip(wanted).all(|(x, y)| (x - y).abs() <= 2e-13 * size)
            };
            let spatial = truesdell_of_jaumann(&rows, &cauchy);
            assert!(near(&truesdell.tangent[i], spatial.as_flattened()), "Truesdell {i}");
            assert!(
                near(&material.tangent[i], pulled_back(&spatial, &f).expect("F is regular").as_flattened()),
                "dS/dE {i}"
            );
            // dP/dF by a central difference of P of the law itself.
            let first = |f: Matrix3<f64>| {
                let answer = run(&law, &fresh::<ReinforcedSolid>(&[f.into()]), &[]);
                first_piola_kirchhoff(&answer.stress[0], &f)
            };
            let step = 1e-6;
            for column in 0..9 {
                let mut moved = [f, f];
                (moved[0][column], moved[1][column]) = (f[column] + step, f[column] - step);
                let difference = (first(moved[0]) - first(moved[1])) / (2.0 * step);
                for (row, wanted) in difference.iter().enumerate() {
                    assert!((nominal.tangent[i][9 * row + column] - wanted).abs() <= 1e-7 * largest, "dP/dF {i}");
                }
            }
        }
        println!("{}: DDSDDE off by {worst:.1e} of its largest entry", level.name());
        assert!(worst <= 1e-13, "{}: {worst:e}", level.name());
        for answer in [&jaumann, &truesdell, &material, &nominal] {
            assert_eq!(answer.state, stress_alone.state);
            assert_eq!(answer.stress, stress_alone.stress, "with a tangent the stress is the same, to the bit");
        }
    }
}

/// ρ c² of the fastest of many waves, by the tangent, against the bound: that of the law, or that which is computed
/// from the tangent.
fn fastest_of_the_bound<M: UserMaterial>(law: &User<M, f64>, points: &[F]) -> f64 {
    let given = Given { measure: Some(Measure::Truesdell), waves: true, ..fresh::<M>(points) };
    let answer = run(law, &given, &[]);
    let mut random = Rng::with_seed(3);
    let mut closest = 0.0_f64;
    for (i, f) in points.iter().enumerate() {
        // ρ0 c² for the density of the reference placement, 4.
        let bound = 4.0 * answer.speed[i].powi(2) / Matrix3::from(*f).determinant();
        let cauchy = matrix(&answer.stress[i]);
        let modulus = |r: usize, c: usize| answer.tangent[i][6 * VOIGT[r / 3][r % 3] + VOIGT[c / 3][c % 3]];
        for _ in 0..300 {
            let n = Vector3::from_fn(|_, _| random.f64() - 0.5).normalize();
            // u·Q u = c:(n⊗u)(n⊗u) + n·σn.
            let acoustic = Matrix3::from_fn(|p, q| {
                (0..9).map(|jl| modulus(3 * p + jl / 3, 3 * q + jl % 3) * n[jl / 3] * n[jl % 3]).sum::<f64>()
            });
            let fastest =
                ((acoustic + acoustic.transpose()) * 0.5).symmetric_eigenvalues().max() + n.dot(&(cauchy * n));
            closest = closest.max(fastest / bound);
        }
    }
    closest
}

#[test]
fn waves_are_slower_than_the_bound() {
    let points = deformations(120, 0.5);
    let rest = [REST];
    let own = |points| fastest_of_the_bound(&reinforced(0.0), points);
    let damaged = User::<Damaged, f64>::new(&[2.0, 0.3]).expect("properties that are right");
    let computed = |points| fastest_of_the_bound(&damaged, points);
    let found = [own(&rest), own(&points), computed(&rest), computed(&points)];
    println!(
        "the fastest waves have {found:.3?} of the bound's modulus: its own, at rest and deformed; the computed one"
    );
    assert!(found.iter().all(|&found| 0.2 < found && found <= 1.0 + 1e-12), "{found:?}");
    // The moduli for solvers that want two: K + 4G/3 is the bound at rest.
    let [bulk, shear] = reinforced(0.0).bulk_and_shear();
    assert_eq!(bulk + 4.0 / 3.0 * shear, LAMBDA + 2.0 * MU + 4.0 * K);
}

#[test]
fn results_do_not_depend_on_how_a_block_is_divided() {
    let law = reinforced(1.2);
    let mut points = deformations(67, 0.4);
    (points[5], points[40]) = ([[0.0; 3]; 3], [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    let mut random = Rng::with_seed(5);
    let mut given = fresh::<ReinforcedSolid>(&points);
    for (i, state) in given.state.iter_mut().enumerate() {
        (state[0], state[2]) = (random.f64(), if i % 9 == 3 { 1.0 } else { 0.0 });
    }
    for fibre in [false, true] {
        if fibre {
            given.fibre = Some((0..67).map(|_| array::from_fn(|_| random.f64() - 0.3)).collect());
        }
        for level in levels() {
            given.level = Some(level);
            let whole = run(&law, &given, &[]);
            assert!(whole.status.contains(&status::INVERTED) && whole.state.iter().any(|state| state[2] == 1.0));
            for sizes in [&[1; 67][..], &[3, 4, 5, 6, 7, 8, 9], &[2; 30], &[16, 1, 15, 2, 14], &[64]] {
                assert_eq!(run(&law, &given, sizes), whole, "{}", level.name());
            }
        }
        if Level::best() >= Level::Avx512 {
            let [narrow, wide] = [Level::Avx2, Level::Avx512]
                .map(|level| run(&law, &Given { level: Some(level), ..given.clone() }, &[]));
            assert_eq!(narrow, wide);
        }
    }
}

/// A law in points of rows against the same in columns, bit by bit: with and without tangents, wave speeds and fibres
/// of the points.
fn rows_are_columns<M: UserMaterial, T: Precision + Default + std::fmt::Debug>(law: &User<M, T>, count: usize) {
    let single = |f: [f64; 9]| f.map(T::splat);
    let variables = M::DESCRIPTION.state.len();
    let mut random = Rng::with_seed(11);
    let mut f: Vec<[T; 9]> = deformations(count, 0.3).iter().map(|f| single(flat(f))).collect();
    f[count / 2] = [T::splat(-1.0); 9];
    f[0][4] = T::splat(f64::NAN);
    let f_old = deformations(count + 1, 0.2).iter().skip(1).map(|f| single(flat(f))).collect();
    let mut state = vec![vec![T::default(); variables]; count];
    state.iter_mut().step_by(3).for_each(|state| state[0] = T::splat(0.125));
    state[count - 1][M::DESCRIPTION.failed] = T::splat(1.0);
    let fibres: Vec<[T; 3]> = (0..count).map(|_| array::from_fn(|_| T::splat(random.f64() - 0.3))).collect();
    let of_points = M::DESCRIPTION.has_fibre().then_some(fibres);
    for level in levels() {
        for measure in [None, Some(Measure::Jaumann), Some(Measure::Nominal)] {
            for (waves, fibre) in [(false, None), (true, of_points.clone()), (false, of_points.clone())] {
                let (f, f_old, state) = (f.clone(), Vec::clone(&f_old), state.clone());
                let given = Given { f_old, f, fibre, state, measure, waves, level: Some(level) };
                let columns = format!("{:?}", run(law, &given, &[]));
                for in_place in [true, false] {
                    let rows = format!("{:?}", run_in_rows(law, &given, in_place));
                    assert_eq!(rows, columns, "{count} points, {}, {measure:?}, {waves}, {in_place}", level.name());
                }
            }
        }
    }
}

#[test]
fn points_in_rows_give_the_bytes_of_points_in_columns() {
    let solid = [MU, LAMBDA, K, 1.2, 2.0, -1.0, 0.5];
    let single = User::<ReinforcedSolid, f32>::new(&solid.map(|x| x as f32)).expect("properties that are right");
    let damaged = User::<Damaged, f64>::new(&[2.0, 0.3]).expect("properties that are right");
    let damaged_single = User::<Damaged, f32>::new(&[2.0, 0.3]).expect("properties that are right");
    // Fewer than are copied at a time, and more.
    for count in [1, 3, 8, 9, 33, 70] {
        rows_are_columns(&reinforced(1.2), count);
        rows_are_columns(&single, count);
        rows_are_columns(&damaged, count);
        rows_are_columns(&damaged_single, count);
    }
}

#[test]
fn points_that_cannot_be_evaluated_keep_their_state_and_say_why() {
    let law = User::<Damaged, f64>::new(&[2.0, 0.3]).expect("properties that are right");
    let stretched = [[1.1, 0.0, 0.0], [0.2, 0.9, 0.0], [0.0, 0.0, 1.0]];
    let with = |c: usize, x: f64| {
        let mut f = stretched;
        f[c / 3][c % 3] = x;
        f
    };
    let old = vec![0.5, 0.1, 0.2, 0.0, 1.0];
    let state = |c: usize, x: f64| {
        let mut state = old.clone();
        state[c] = x;
        state
    };
    let (nan, inf) = (f64::NAN, f64::INFINITY);
    let cases = [
        (stretched, REST, old.clone(), status::OK),
        (with(0, -1.1), REST, old.clone(), status::INVERTED),
        (with(0, 0.0), REST, old.clone(), status::INVERTED),
        (with(4, nan), REST, old.clone(), status::NOT_FINITE),
        (with(7, inf), REST, old.clone(), status::NOT_FINITE),
        (with(1, -inf), REST, old.clone(), status::NOT_FINITE),
        (stretched, with(0, -1.0), old.clone(), status::INVERTED),
        (stretched, with(3, nan), old.clone(), status::NOT_FINITE),
        (stretched, REST, state(1, nan), status::STATE_NOT_FINITE),
        (stretched, REST, state(2, inf), status::STATE_NOT_FINITE),
        (with(0, 1e200), REST, old.clone(), status::OVERFLOW),
        (with(4, nan), REST, state(3, 1.0), status::OK),
        (stretched, REST, state(3, nan), status::STATE_NOT_FINITE),
    ];
    for (with_tangent, waves) in [(false, false), (true, false), (false, true), (true, true)] {
        for level in levels() {
            let given = Given {
                f_old: cases.iter().map(|case| flat(&case.1)).collect(),
                f: cases.iter().map(|case| flat(&case.0)).collect(),
                fibre: None,
                state: cases.iter().map(|case| case.2.clone()).collect(),
                measure: with_tangent.then_some(Measure::Jaumann),
                waves,
                level: Some(level),
            };
            let answer = run(&law, &given, &[]);
            assert_eq!(answer.worst, status::OVERFLOW.min(status::STATE_NOT_FINITE), "{:?}", answer.status);
            for (i, (_, _, old, code)) in cases.iter().enumerate() {
                let at = format!("{} {with_tangent} {waves} case {i}", level.name());
                assert_eq!(answer.status[i], *code, "{at}");
                assert!(!waves || answer.speed[i].is_finite() && answer.speed[i] > 0.0, "{at}");
                assert!(
                    answer.stress[i].iter().chain(&answer.state[i]).chain(&answer.tangent[i]).all(|x| x.is_finite())
                );
                let failed = old[3] != 0.0 || old[3].is_nan();
                assert_eq!(
                    [answer.state[i][3], answer.state[i][4]],
                    if failed { [1.0, 0.0] } else { [0.0, 1.0] },
                    "{at}"
                );
                if i == 0 {
                    assert!(answer.stress[i][0] != 0.0 && answer.state[i] != *old && answer.active[i] == 1.0);
                    continue;
                }
                assert_eq!(answer.stress[i], [0.0; 6], "{at}");
                assert!(answer.tangent[i].iter().all(|&x| x == 0.0), "{at}");
                assert_eq!(answer.active[i], 0.0, "{at}");
                for (&found, &old) in answer.state[i].iter().zip(old).take(3) {
                    assert_eq!(found, if old.is_finite() { old } else { 0.0 }, "{at}");
                }
            }
        }
    }
    // A fibre of its own that has no direction.
    let given = Given {
        fibre: Some(vec![[0.0; 3], [nan, 1.0, 0.0], [3.0, 0.0, 4.0]]),
        ..fresh::<ReinforcedSolid>(&[stretched; 3])
    };
    let answer = run(&reinforced(0.0), &given, &[]);
    assert_eq!(answer.status, [status::FIBRE_DIRECTION, status::FIBRE_DIRECTION, status::OK]);
}

/// In the step that detects failure the stress is that of the intact solid; later it is 0, and the state stays.
#[test]
fn failure_is_latched() {
    let law = reinforced(1.1);
    let along = |stretch: f64| {
        let m = Vector3::from(FIBRE).normalize();
        (Matrix3::identity() + m * m.transpose() * (stretch - 1.0)).into()
    };
    let mut given = fresh::<ReinforcedSolid>(&[along(1.1 - 1e-9), along(1.1 + 1e-9)]);
    let first = run(&law, &given, &[]);
    assert_eq!(first.state.iter().map(|state| (state[2], state[3])).collect::<Vec<_>>(), [(0.0, 1.0), (1.0, 0.0)]);
    assert!(first.stress[1].iter().any(|&s| s != 0.0) && first.status == [0, 0] && first.active == [1.0, 0.0]);
    given.state = first.state.clone();
    given.measure = Some(Measure::Jaumann);
    let again = run(&law, &given, &[]);
    assert_eq!(again.stress[1], [0.0; 6]);
    assert_eq!(again.state[1], first.state[1]);
    assert!(again.tangent[1].iter().all(|&x| x == 0.0) && again.tangent[0].iter().any(|&x| x != 0.0));
}

/// The tangent of a law that reads its old state: by central differences.
#[test]
fn tangents_of_a_law_with_memory() {
    let law = User::<Damaged, f64>::new(&[2.0, 0.3]).expect("properties that are right");
    let points = deformations(40, 0.3);
    for damage in [0.0, 0.9] {
        let mut given = Given { measure: Some(Measure::Jaumann), ..fresh::<Damaged>(&points) };
        given.state.iter_mut().for_each(|state| state[1] = damage);
        let answer = run(&law, &given, &[]);
        // Points that are hardly strained are too near to the kink where damage begins.
        for (i, f) in points.iter().enumerate().filter(|(i, _)| i % 4 != 0) {
            for (column, (k, l)) in PAIRS.into_iter().enumerate() {
                let mut d = Matrix3::zeros();
                d[(k, l)] += 0.5;
                d[(l, k)] += 0.5;
                let kirchhoff = |step: f64| {
                    let moved: Matrix3<f64> = (Matrix3::identity() + d * step) * Matrix3::from(*f);
                    let one = Given {
                        f: vec![flat(&moved.into())],
                        f_old: vec![flat(&REST)],
                        state: vec![given.state[i].clone()],
                        ..fresh::<Damaged>(&points[..1])
                    };
                    matrix(&run(&law, &one, &[]).stress[0]) * moved.determinant()
                };
                let step = 1e-6;
                let rate = (kirchhoff(step) - kirchhoff(-step)) / (2.0 * step) / Matrix3::from(*f).determinant();
                for (row, wanted) in components(&rate).into_iter().enumerate() {
                    let found = answer.tangent[i][6 * row + column];
                    assert!(
                        (found - wanted).abs() < 1e-7,
                        "damage {damage}, point {i} ({row}, {column}): {found} {wanted}"
                    );
                }
            }
        }
    }
}

#[test]
fn single_precision_is_that_of_its_numbers() {
    let values = [MU, LAMBDA, K, 0.0, 2.0, -1.0, 0.5];
    let law = User::<ReinforcedSolid, f32>::new(&values.map(|x| x as f32)).expect("properties that are right");
    let points = deformations(101, 0.3);
    let single: Vec<[f32; 9]> = points.iter().map(|f| flat(f).map(|x| x as f32)).collect();
    let doubled: Vec<F> =
        single.iter().map(|f| array::from_fn(|j| array::from_fn(|i| f64::from(f[3 * j + i])))).collect();
    let wanted = run(&reinforced(0.0), &fresh::<ReinforcedSolid>(&doubled), &[]);
    for level in levels() {
        for measure in [None, Some(Measure::Jaumann)] {
            let given = Given {
                f_old: single.clone(),
                f: single.clone(),
                fibre: None,
                state: vec![vec![0.0; 4]; 101],
                measure,
                waves: false,
                level: Some(level),
            };
            let answer = run(&law, &given, &[]);
            for (found, wanted) in answer.stress.iter().flatten().zip(wanted.stress.iter().flatten()) {
                let size = wanted.abs() + K;
                assert!((f64::from(*found) - wanted).abs() <= 8.0 * f64::from(f32::EPSILON) * size, "{found} {wanted}");
            }
        }
    }
}

#[test]
fn wrong_properties_are_named() {
    let text = |values: &[f64]| User::<ReinforcedSolid, f64>::new(values).expect_err("a wrong property").to_string();
    assert_eq!(
        text(&[0.0, 1.0, 1.0, 0.0, 1.0, 0.0, 0.0]),
        "property 1 (mu, shear modulus of the solid) is 0.0; allowed: a number > 0, at most 1e25"
    );
    assert_eq!(
        text(&[1.0, 1.0, f64::NAN, 0.0, 1.0, 0.0, 0.0]).split(';').next(),
        Some("property 3 (k, stiffness of the fibres) is NaN")
    );
    assert!(text(&[1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0]).contains("fibre direction"));
    assert!(text(&[1.0, 1.0]).contains("number of properties"));
    let own = User::<Damaged, f64>::new(&[0.2, 0.3]).expect_err("a wrong relation").to_string();
    assert_eq!(own, "argument rate is 0.3; allowed: less than mu");
    let own = User::<Damaged, f32>::new(&[0.2, 0.3]).expect_err("rate above mu").to_string();
    assert_eq!(own, "argument rate is 0.3; allowed: less than mu");
}

/// The dual numbers' own rules, against differences.
#[test]
fn dual_numbers_differentiate_every_function() {
    type Function = fn(Dual<f64>) -> Dual<f64>;
    let functions: [(&str, Function); 12] = [
        ("ln", |x| x.ln()),
        ("exp", |x| x.exp()),
        ("sqrt", |x| x.sqrt()),
        ("x^2.5", |x| x.powf(Dual::splat(2.5))),
        ("x^-1.5", |x| x.powf(Dual::splat(-1.5))),
        ("2^x", |x| Dual::splat(2.0).powf(x)),
        ("x^x", |x| x.powf(x)),
        ("1/x", |x| x.reciprocal()),
        ("quotient", |x| Dual::splat(3.0).quotient(x, x.reciprocal())),
        ("|−x|", |x| (-x).abs()),
        ("max", |x| (x * x).max(x)),
        ("difference", |x| Dual::difference_of_products(x, x * x, x, Dual::splat(2.0))),
    ];
    for x in [0.3, 0.9, 1.7, 12.0] {
        for (name, function) in functions {
            let Dual { value, slope } = function(Dual::new(x, 1.0));
            let at = |x: f64| function(Dual::new(x, 0.0)).value;
            let h = 1e-5 * x;
            let difference = (8.0 * (at(x + h) - at(x - h)) - (at(x + 2.0 * h) - at(x - 2.0 * h))) / (12.0 * h);
            assert!(
                (slope - difference).abs() <= 1e-8 * (slope.abs() + value.abs()),
                "{name} at {x}: {slope} {difference}"
            );
        }
    }
}

/// At 0 a power has the slope of a root: infinite, but 0 of what has no slope there, so that an invariant that is even
/// has a tangent at rest.
#[test]
fn powers_of_nothing_have_a_slope() {
    for (exponent, wanted) in [(0.0, 0.0), (0.5, f64::INFINITY), (1.0, 3.0), (2.0, 0.0)] {
        for slope in [0.0, 3.0] {
            let found = Dual::new(0.0, slope).powf(Dual::splat(exponent)).slope;
            assert_eq!(found, if slope == 0.0 { 0.0 } else { wanted }, "0^{exponent}, slope {slope}");
        }
    }
}

/// The computed bound of the wave speed does not depend on the tangent that is asked for beside it.
#[test]
fn the_wave_speed_is_that_of_every_measure() {
    let law = User::<Damaged, f64>::new(&[2.0, 0.3]).expect("properties that are right");
    let points = deformations(40, 0.4);
    let ask = |measure| run(&law, &Given { measure, waves: true, ..fresh::<Damaged>(&points) }, &[]).speed;
    let alone = ask(None);
    for measure in [Measure::Jaumann, Measure::Truesdell, Measure::Material, Measure::Nominal] {
        for (found, wanted) in ask(Some(measure)).into_iter().zip(&alone) {
            assert!((found - wanted).abs() <= 1e-14 * wanted, "{measure:?}: {found} {wanted}");
        }
    }
}

/// A state that is not there is one of rest, and none is written.
#[test]
fn the_yarn_law_takes_points_without_state() {
    let law = toron::Hyperelastic::new(&[80e3, 1e3, 2.2, 600.0, 5.0, 0.05, 1.8, 0.0, 1.0, 0.0, 0.0]).expect("a yarn");
    let f = [1.02, 0.1, 0.0, -0.2, 0.9, 0.05, 0.0, 0.1, 0.8];
    let mut stress = [0.0; 6];
    let mut points = Points::without_arrays(1, 1);
    points.f_new = array::from_fn(|c| &raw const f[c]);
    points.stress = stress.each_mut().map(|s| &raw mut *s);
    // SAFETY: one point's arrays.
    assert_eq!(unsafe { Law::step(&law, &points) }, Ok(status::OK));
    let wanted = law.point_along(
        &array::from_fn(|j| array::from_fn(|i| f[3 * j + i])),
        None,
        &[0.0; 11],
        toron::Request::STRESS_AND_STATE,
    );
    for (found, wanted) in stress.iter().zip(wanted.stress) {
        assert!((found - wanted).abs() <= 1e-12 * 80e3, "{stress:?} {wanted:?}");
    }
}

/// The distances and arrays that points of a law of one's own do not have are refused; that of the tangent is its own.
#[test]
fn points_have_what_the_law_has() {
    let law = reinforced(1.2);
    let f = [1.05, 0.0, 0.0, 0.0, 0.98, 0.0, 0.0, 0.0, 1.01];
    let (mut stress, mut apart, mut near, mut other) = ([0.0; 6], [0.0; 72], [0.0; 36], [1.0; 24]);
    let stress_at = stress.as_mut_ptr();
    let points = Points {
        f_new: array::from_fn(|c| &raw const f[c]),
        stress: array::from_fn(|c| stress_at.wrapping_add(c)),
        ..Points::without_arrays(1, 1)
    };
    // SAFETY: what is not null has the components of one point.
    let step = |points: Points<f64>| unsafe { law.step(&points) };
    let of_others = other.as_mut_ptr();
    for wrong in [
        Points { limit: of_others, ..points },
        Points { second_axis: [of_others.cast_const(); 3], ..points },
        Points { axes: of_others, ..points },
        Points { modes: of_others, ..points },
    ] {
        assert_eq!(step(wrong).map_err(|error| error.code()), Err(status::BAD_ARGUMENT));
    }
    assert_eq!(step(Points { tangent: near.as_mut_ptr(), ..points }), Ok(status::OK));
    let tangent_leading_dimension = 2;
    assert_eq!(step(Points { tangent: apart.as_mut_ptr(), tangent_leading_dimension, ..points }), Ok(status::OK));
    assert!(near.iter().enumerate().all(|(c, x)| *x == apart[2 * c] && apart[2 * c + 1] == 0.0), "{apart:?}");
    assert_eq!(other, [1.0; 24]);
}
