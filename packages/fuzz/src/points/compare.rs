//! The same point by another entry, in another layout or company: the same bits, or close.

use super::arrays::Array;
use super::case::{Case, Host, Law, with};
use super::checks::{Checked, holds};
use super::entries::{Entry, Outcome};
use super::functions::Functions;
use super::laws::condition;

/// A point of an outcome.
#[derive(Clone, Copy)]
pub struct Of<'a, T> {
    pub outcome: &'a Outcome<T>,
    pub point: usize,
}

/// What both have been asked for: names, arrays, and the components that count.
fn groups<'a, T>(case: &Case, a: &'a Outcome<T>, b: &'a Outcome<T>) -> Vec<(&'static str, &'a Array<T>, &'a Array<T>)> {
    let both_blocks = [a, b].iter().all(|o| !o.entry.is_point() && o.entry != Entry::Host);
    let mut groups = Vec::new();
    let mut add = |name, asked: bool, a, b| {
        if asked {
            groups.push((name, a, b));
        }
    };
    add("stress", case.asks(with::STRESS), &a.stress, &b.stress);
    add("modes", case.asks(with::MODES), &a.modes, &b.modes);
    add("tangent", case.asks(with::TANGENT), &a.tangent, &b.tangent);
    add("wave speed", case.asks(with::WAVE_SPEED), &a.wave_speed, &b.wave_speed);
    add("active", case.asks(with::ACTIVE) && both_blocks, &a.active, &b.active);
    // A block may be asked for a part of the state, a point for all or nothing.
    add("state", case.asks_state() || both_blocks, &a.state, &b.state);
    add("axes", case.law.is_linear() && case.rotation == 2, &a.axes, &b.axes);
    groups
}

/// The same status and the same bits.
pub fn same<T: Functions>(case: &Case, a: Of<T>, b: Of<T>) -> Checked {
    let entries = || format!("{:?} and {:?}, point {}", a.outcome.entry, b.outcome.entry, a.point);
    if let (Some(a), Some(b)) = (a.outcome.status(case, a.point), b.outcome.status(case, b.point)) {
        holds(a == b, || format!("{}: codes {a} and {b}", entries()))?;
    }
    for (name, x, y) in groups(case, a.outcome, b.outcome) {
        let equal = x.bits(a.point).eq(y.bits(b.point));
        holds(equal, || format!("{}: {name} {:?} and {:?}", entries(), x.row(a.point), y.row(b.point)))?;
    }
    Ok(())
}

/// Whether a point is one whose answers may be compared to some digits: nothing is extreme, no kink is near that
/// magnifies roundings.
pub fn is_moderate(case: &Case, point: usize, i_tc: f64) -> bool {
    let f = &case.points[point].f;
    let determinant = nalgebra::Matrix3::from_column_slice(f).determinant();
    let usual = |k: f64| k == 0.0 || (1e-4..1e4).contains(&k);
    f.iter().all(|x| x.abs() < 10.0)
        && (0.1..10.0).contains(&determinant)
        && case.properties[..4].iter().all(|&k| usual(k))
        && (case.law == Law::Linear || ((1.9..6.0).contains(&case.properties[2]) && usual(case.properties[4])))
        && i_tc.abs() > 1e-4
        && case.points[point].state.iter().all(|x| x.abs() < 1e3)
}

/// The same to some digits, where the point is moderate.
pub fn close<T: Functions>(case: &Case, a: Of<T>, b: Of<T>) -> Checked {
    let i_tc = if case.law.is_linear() || !case.asks_state() { 1.0 } else { a.outcome.state.get(5, a.point).into() };
    let codes = [a.outcome.status(case, a.point), b.outcome.status(case, b.point)];
    if codes != [Some(0); 2] || !is_moderate(case, a.point, i_tc) || !case.asks_state() {
        return Ok(());
    }
    let failed = case.law.failed();
    let index: f64 = if failed == 8 { 0.0 } else { a.outcome.state.get(failed - 1, a.point).into() };
    for (name, x, y) in groups(case, a.outcome, b.outcome) {
        let (x, y) = (x.row(a.point), y.row(b.point));
        let size = x.iter().chain(&y).fold(0.0, |most: f64, x| most.max(x.abs()));
        let stiffness = case.properties[..4].iter().fold(0.0, |most: f64, k| most.max(*k));
        let scale = if name == "state" { size.max(1.0) } else { size.max(1e-2 * stiffness) };
        // There and back through the second Piola–Kirchhoff stress.
        let lost = if case.host == Host::CalculiX { condition(&case.points[a.point].f).powi(2) } else { 1.0 };
        let digits = if name == "tangent" { 1e6 } else { 1e4 * lost } * T::ROUNDING;
        // A rounding may decide on the latch.
        let at_limit = (index - 1.0).abs() < digits || case.law.is_linear();
        for (c, (x, y)) in x.iter().zip(&y).enumerate() {
            let latch = name == "state" && c >= failed && at_limit;
            holds(latch || (x - y).abs() <= digits * scale, || {
                let entries = [a.outcome.entry, b.outcome.entry];
                format!("{entries:?}, point {}: {name} {c}: {x} and {y}", a.point)
            })?;
        }
    }
    Ok(())
}
