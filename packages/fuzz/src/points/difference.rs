//! The tangent against differences of the stress: dP/dF along a random direction.

use fastrand::Rng;
use nalgebra::{Matrix3, SMatrix, SVector};

use super::case::{Case, Host, Law, Old, with};
use super::checks::{has_failed, holds};
use super::entries::{Entry, Outcome, call};
use super::faults::Fault;
use super::functions::Functions;
use super::random::{between, one_in};

/// The step, and the error that is allowed of the whole: the step's square and a rounding over the step are far below.
const STEP: f64 = 1e-6;
const ALLOWED: f64 = 1e-5;

/// P = J σ F⁻ᵀ, by columns.
fn first_piola_kirchhoff(case: &Case, outcome: &Outcome<f64>) -> Option<SVector<f64, 9>> {
    let f = Matrix3::from_column_slice(&case.points[0].f);
    let [s11, s22, s33, s12, s23, s31] = <[f64; 6]>::try_from(outcome.stress.row(0)).ok()?;
    let sigma = Matrix3::new(s11, s12, s31, s12, s22, s23, s31, s23, s33);
    let nominal = f.determinant() * sigma * f.try_inverse()?.transpose();
    Some(SVector::from_column_slice(nominal.as_slice()))
}

/// On which side of its kinks a point is; `None` near one, or where it cannot be told.
fn branch(case: &Case, outcome: &Outcome<f64>) -> Option<[bool; 3]> {
    let old = &case.points[0].state;
    if outcome.code != 0 || has_failed(old[case.law.failed()]) {
        return None;
    }
    if case.law.is_linear() {
        return Some([false; 3]);
    }
    let state = outcome.state.row(0);
    let is_apart = state[4].abs() > 1e-4 && state[5].abs() > 1e-3 && state[6] > 1e-3;
    let slides = case.law == Law::Frictional && state[8] > if case.old == Old::Null { 0.0 } else { old[8] };
    is_apart.then_some([state[4] > 0.0, state[5] > 0.0, slides])
}

fn is_moderate(case: &Case) -> bool {
    let point = &case.points[0];
    let upright = |f: &[f64; 9]| {
        f.iter().all(|x| x.abs() < 4.0) && (0.2..5.0).contains(&Matrix3::from_column_slice(f).determinant())
    };
    let usual = |k: &f64| *k == 0.0 || (1e-3..1e3).contains(k);
    let stiffness = &case.properties[..if case.law.is_linear() { 3 } else { 5 }];
    // At half a turn in one step the spin's frame jumps.
    let turns_little = || {
        let [f, f_old] = [&point.f, &point.f_old].map(|f| Matrix3::from_column_slice(f));
        f_old.try_inverse().is_some_and(|inverse| (f * inverse + Matrix3::identity()).determinant() > 0.1)
    };
    upright(&point.f)
        && upright(&point.f_old)
        && point.state.iter().all(|x| x.abs() < 10.0)
        && stiffness.iter().all(usual)
        && if case.law.is_linear() { turns_little() } else { (1.2..6.0).contains(&case.properties[2]) }
}

/// Whether the tangent of a case of one point has been looked at, which is one in so many.
///
/// # Errors
/// It is not the derivative of the stress.
pub fn check<T: Functions>(case: &Case, fault: Option<Fault>, seed: u64) -> Result<bool, String> {
    let rng = &mut Rng::with_seed(seed);
    if case.single || !one_in(rng, 8) || !is_moderate(case) {
        return Ok(false);
    }
    let keeps = case.with & (with::FIBRE | with::SECOND_AXIS);
    let old = if case.old == Old::InPlace { Old::Apart } else { case.old };
    let asked = keeps | with::STRESS | with::STATE | with::TANGENT;
    let middle = Case { with: asked, measure: 3, old, host: Host::None, ..case.clone() };
    let direction: [f64; 9] = std::array::from_fn(|_| between(rng, -1.0, 1.0));
    let moved = |step: f64| {
        let mut case = middle.clone();
        case.points[0].f = std::array::from_fn(|c| middle.points[0].f[c] + step * direction[c]);
        let outcome = call::<f64>(Entry::Point, &case, fault);
        let stress = first_piola_kirchhoff(&case, &outcome)?;
        Some((stress, branch(&case, &outcome)?, outcome.tangent.row(0)))
    };
    let Some(((behind, one, _), (here, two, tangent), (ahead, three, _))) =
        moved(-STEP).zip(moved(0.0)).zip(moved(STEP)).map(|((a, b), c)| (a, b, c))
    else {
        return Ok(false);
    };
    if one != two || two != three {
        return Ok(false);
    }
    let tangent = SMatrix::<f64, 9, 9>::from_row_slice(&tangent);
    let slope = (ahead - behind) / (2.0 * STEP);
    let expected = tangent * SVector::from(direction);
    let (error, size) = ((slope - expected).norm(), tangent.norm() + here.norm());
    holds(error <= ALLOWED * size, || {
        format!("dP/dF differs from differences of P by {:e} of the whole, slides {}", error / size, two[2])
    })?;
    Ok(true)
}
