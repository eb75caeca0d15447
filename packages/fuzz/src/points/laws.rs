//! What a law says of a point's numbers among themselves: energies of invariants, the failure index, the limit of
//! friction, the wave speed's floor, symmetry.

use toron_test_support::block::Number;

use super::case::{Case, Host, Law, with};
use super::checks::{Checked, holds};
use super::entries::{Entry, Outcome};
use super::functions::Functions;

/// Whether two numbers agree to so many roundings of `size`; below the range of the format anything does.
fn near<T: Number>(a: f64, b: f64, size: f64, roundings: f64) -> bool {
    (a - b).abs() <= roundings * T::ROUNDING * size.abs() + smallest::<T>() || a == b || !size.is_finite()
}

/// Four times the least number that is not subnormal.
fn smallest<T: Number>() -> f64 {
    4.0 * if T::ROUNDING < 1e-10 { f64::MIN_POSITIVE } else { f64::from(f32::MIN_POSITIVE) }
}

/// A property, in the precision of the case.
fn property<T: Number>(case: &Case, index: usize) -> f64 {
    T::splat(case.properties[index]).into()
}

/// The bound of the wave speed is not below the speed at rest, and that itself for a refused point.
pub fn wave_speed<T: Number>(case: &Case, speed: f64, refused: bool) -> Checked {
    let k = |index| property::<T>(case, index);
    let modulus = if case.law.is_linear() { k(0).max(k(1)).max(2.0 * k(2)) } else { k(0) };
    let density: f64 = T::splat(case.density).into();
    let rest = modulus.sqrt() / density.sqrt();
    let least = rest * (1.0 - 8.0 * T::ROUNDING);
    holds(speed >= least || !T::splat(rest).into().is_finite(), || format!("wave speed {speed}, at rest {rest}"))?;
    holds(!refused || near::<T>(speed, rest, rest, 8.0), || {
        format!("wave speed {speed} of a refused point, at rest {rest}")
    })
}

/// A point that has been evaluated.
pub fn evaluated<T: Functions>(case: &Case, outcome: &Outcome<T>, i: usize, old: &[f64]) -> Checked {
    if case.asks(with::TANGENT) && case.law == Law::Hyperelastic {
        symmetric::<T>(&outcome.tangent.row(i), case.tangent_size(), outcome.entry)?;
    }
    if !case.asks_state() {
        return Ok(());
    }
    let state = outcome.state.row(i);
    let limit = if case.asks(with::LIMIT) { T::splat(case.points[i].limit).into() } else { 0.0 };
    if case.law.is_linear() {
        return linear::<T>(case, outcome, i, &state, limit);
    }
    energies::<T>(case, &state)?;
    failure::<T>(case, &state, limit)?;
    if case.law == Law::Frictional { friction::<T>(case, i, &state, old) } else { Ok(()) }
}

/// The tangent of an energy.
fn symmetric<T: Number>(tangent: &[f64], size: usize, entry: Entry) -> Checked {
    for row in 0..size {
        for column in 0..row {
            let [a, b] = [tangent[size * row + column], tangent[size * column + row]];
            holds(a == b || (entry == Entry::Host && near::<T>(a, b, a, 8.0)), || {
                format!("tangent ({row}, {column}) {a} and {b}")
            })?;
        }
    }
    Ok(())
}

/// The part of the distortion that is held.
fn held(case: &Case, state: &[f64]) -> f64 {
    if case.law == Law::Frictional { state[9] } else { state[6] }
}

fn energies<T: Number>(case: &Case, state: &[f64]) -> Checked {
    let k = |index| property::<T>(case, index);
    let [i_el, i_tc, i_td, i_ld] = [state[4], state[5], held(case, state), state[7]];
    // Half of the smallest number is 0.
    let half_square = |k: f64, i: f64| k * i * (0.5 * i);
    let expected = [
        half_square(k(0), i_el.max(0.0)),
        k(1) * (-i_tc).max(0.0).powf(k(2)),
        half_square(k(3), i_td),
        half_square(k(4), i_ld),
    ];
    for (mode, expected) in expected.into_iter().enumerate() {
        let energy = state[mode];
        // The power p − 1 of the compaction is 0 within twenty binary orders of the least number.
        let underflows = mode == 1 && expected <= k(1) * i_tc.abs() * smallest::<T>() * 1e6;
        let expected = if underflows { energy } else { expected };
        holds(energy >= 0.0, || format!("energy {mode} is {energy}"))?;
        holds(near::<T>(energy, expected, expected, 64.0 * k(2)), || {
            format!("energy {mode} is {energy}, by its invariant {expected}")
        })?;
    }
    holds(i_td >= 0.0 && state[6] >= 0.0 && i_ld >= 0.0, || format!("invariants {:?}", &state[4..10]))
}

fn failure<T: Number>(case: &Case, state: &[f64], own_limit: f64) -> Checked {
    let k = |index| property::<T>(case, index);
    let [i_el, i_tc, i_td] = [state[4], state[5], held(case, state)];
    let [index, failed] = [state[case.law.failed() - 1], state[case.law.failed()]];
    let limit = if own_limit > 0.0 { own_limit } else { k(5).ln_1p() };
    let fails = limit > 0.0 && i_el > 0.0;
    let parts = [i_el / limit.max(1e-30), k(6) * (-i_tc).max(0.0), k(7) * i_td];
    let expected = if fails { parts.iter().sum() } else { 0.0 };
    holds(near::<T>(index, expected, expected, 64.0), || {
        format!("failure index {index}, by the invariants {expected}")
    })?;
    holds((failed == 1.0) == (index >= 1.0), || format!("failure index {index}, failed {failed}"))
}

fn friction<T: Number>(case: &Case, point: usize, state: &[f64], old: &[f64]) -> Checked {
    let k = |index| property::<T>(case, index);
    let [k_tc, p, k_td, mu, cohesion] = [k(1), k(2), k(3), k(11), k(12)];
    let [i_tc, i_td, lost, i_te] = [state[5], state[6], state[8], state[9]];
    holds(lost >= old[8], || format!("energy lost falls from {} to {lost}", old[8]))?;
    let most = mu * (0.5 * p * k_tc * (-i_tc).max(0.0).powf(p - 1.0)) + cohesion;
    let stress = 0.5 * k_td * i_te;
    // Next to the least numbers I_te has no digits.
    let is_held = stress <= most || near::<T>(stress, most, most, 64.0 * p) || i_te <= 1e8 * smallest::<T>();
    holds(is_held, || format!("distortion stress {stress} beyond what friction holds, {most}"))?;
    // The section's shape, the slip and what is held are sides of a triangle of the hyperbolic plane.
    let slip = 0.5 * state[10].hypot(state[11]).asinh();
    let digits = if T::ROUNDING < 1e-10 { 1e-5 } else { 2e-2 };
    let tolerance = digits * (1.0 + i_td + slip);
    let is_triangle = i_te <= i_td + slip + tolerance && (i_td - slip).abs() <= i_te + tolerance;
    // Of an F with entries of many sizes, or next to a singular one, digits are lost.
    let f = &case.points[point].f;
    let is_usual = f.iter().all(|x| x.abs() < 1e3) && T::ROUNDING * condition(f) < 0.01 * digits;
    let tellable = is_usual && i_td.max(slip) < if T::ROUNDING < 1e-10 { 10.0 } else { 4.0 };
    holds(is_triangle || !tellable, || format!("distortion {i_td}, held {i_te}, slip {slip}"))
}

/// How far F is from being singular: the axes of the linear elastic law, made orthogonal to one another, are so to as
/// many roundings.
pub fn condition(f: &[f64; 9]) -> f64 {
    let f = nalgebra::Matrix3::from_column_slice(f);
    f.try_inverse().map_or(f64::INFINITY, |inverse| f.norm() * inverse.norm())
}

/// The largest component of a stress 11 22 33 12 23 31, and the stress over it, in which what is below 1e-100 counts as
/// 0: beside a component of 1e-149 nalgebra's eigenvalues are NaN.
fn scaled(component: impl Fn(usize) -> f64) -> (f64, nalgebra::Matrix3<f64>) {
    let [s11, s22, s33, s12, s23, s31] = std::array::from_fn(component);
    let stress = nalgebra::Matrix3::new(s11, s12, s31, s12, s22, s23, s31, s23, s33);
    let unit = stress.amax();
    let part = |x: f64| if x.abs() < 1e-100 * unit { 0.0 } else { x / unit };
    if unit > 0.0 { (unit, stress.map(part)) } else { (1.0, stress) }
}

fn linear<T: Functions>(case: &Case, outcome: &Outcome<T>, i: usize, state: &[f64], own_limit: f64) -> Checked {
    let (unit, stress) = scaled(|c| state[c]);
    let (size, largest) = (unit * stress.norm(), unit * stress.symmetric_eigenvalues().max());
    holds(near::<T>(state[6], largest, size, 64.0), || {
        format!("largest principal stress {}, not {largest}", state[6])
    })?;
    if case.asks(with::STRESS) {
        let row = outcome.stress.row(i);
        let (unit, stress) = scaled(|c| row[c]);
        let global = unit * stress.norm();
        // Axes of a caller's that are a hundredth from orthonormal are corrected to the square of that.
        let condition = condition(&case.points[i].f);
        let roundings = match (case.rotation, case.host, outcome.entry) {
            (2, ..) => 1e-4 / T::ROUNDING,
            // There and back through the second Piola–Kirchhoff stress.
            (_, Host::CalculiX, Entry::Host) => 64.0 * condition.powi(3),
            _ => 64.0 * condition,
        };
        holds(near::<T>(global, size, size, roundings), || {
            format!("stress of size {global} in global axes, {size} in its own")
        })?;
    }
    let strength = if own_limit > 0.0 { own_limit } else { property::<T>(case, 3) };
    let measure = if case.criterion == 0 { state[6] } else { state[0] };
    let fails = strength > 0.0 && measure >= strength;
    let close = near::<T>(measure, strength, strength, 16.0);
    holds(close || fails == (state[8] == 1.0), || format!("stress {measure}, strength {strength}, failed {}", state[8]))
}
