//! What must hold of a call, whatever was passed: the header's promises.

use toron::status;

use super::arrays::Array;
use super::case::{Case, Host, Law, Old, with};
use super::entries::{Entry, NO_STATUS, Outcome};
use super::functions::Functions;
use super::laws;

/// What has been found wrong.
pub type Checked = Result<(), String>;

/// The codes that a point may have.
pub const POINT_CODES: std::ops::RangeInclusive<i32> = status::SMALLER_STEP..=status::INVERTED;

/// Whether a latch says that the point has failed before: one that is NaN does.
pub fn has_failed(latch: f64) -> bool {
    latch >= 0.5 || latch.is_nan()
}

pub(super) fn holds(condition: bool, what: impl FnOnce() -> String) -> Checked {
    if condition { Ok(()) } else { Err(what()) }
}

/// The old state of a point, as the law reads it: a block has no old parts in the place of new ones that are left out.
pub fn old_state<T: Functions>(case: &Case, entry: Entry, point: usize) -> Vec<f64> {
    let is_read = |c: usize| match case.old {
        Old::Null => false,
        Old::Apart => true,
        Old::InPlace => case.law.is_linear() || entry.is_point() || asks_component(case, entry, c),
    };
    let state = case.points[point].state.iter().map(|&x| T::splat(x).into());
    state.enumerate().map(|(c, x)| if is_read(c) { x } else { 0.0 }).collect()
}

/// Checks all that does not need another call. `codes` are the statuses of the points, where they are known.
pub fn outcome<T: Functions>(case: &Case, outcome: &Outcome<T>, codes: &[Option<i32>]) -> Checked {
    let entry = outcome.entry;
    untouched(case, outcome).map_err(|text| format!("{entry:?}: {text}"))?;
    if stopped(case, outcome).is_some() {
        return Ok(());
    }
    let is_silent = outcome.message.is_empty();
    holds(is_silent == (outcome.code == 0), || {
        format!("{entry:?}: code {} with message `{}`", outcome.code, outcome.message)
    })?;
    let refused = outcome.code != 0 && !POINT_CODES.contains(&outcome.code);
    if refused {
        return refused_call(case, outcome).map_err(|text| format!("{entry:?} returned {}: {text}", outcome.code));
    }
    let worst = codes.iter().copied().flatten().min().unwrap_or(0);
    if codes.iter().all(Option::is_some) {
        holds(worst.min(0) == outcome.code, || {
            format!("{entry:?} returned {}, the worst code is {worst}", outcome.code)
        })?;
    }
    for (i, code) in codes.iter().enumerate() {
        if let Some(code) = *code {
            point(case, outcome, i, code).map_err(|text| format!("{entry:?}, point {i} of code {code}: {text}"))?;
        }
        finite(case, outcome, i).map_err(|text| format!("{entry:?}, point {i} of code {code:?}: {text}"))?;
    }
    Ok(())
}

/// The code with which OpenRadioss ends the run, at a point whose fibre or limit is wrong: nothing is promised then.
pub fn stopped<T>(case: &Case, outcome: &Outcome<T>) -> Option<i32> {
    let codes = [status::FIBRE_DIRECTION, status::LIMIT];
    let of_engine = outcome.entry == Entry::Host && case.host == Host::OpenRadioss;
    let code = outcome.beside.first().filter(|_| of_engine)?;
    codes.into_iter().find(|&stop| f64::from(stop) == *code)
}

/// The outputs with what asks for them, but for the state.
fn arrays<'a, T>(case: &Case, outcome: &'a Outcome<T>) -> [(&'static str, &'a Array<T>, bool); 5] {
    let of_block = !outcome.entry.is_point() && outcome.entry != Entry::Host;
    [
        ("stress", &outcome.stress, case.asks(with::STRESS)),
        ("modes", &outcome.modes, case.asks(with::MODES)),
        ("tangent", &outcome.tangent, case.asks(with::TANGENT)),
        ("wave speed", &outcome.wave_speed, case.asks(with::WAVE_SPEED)),
        ("active", &outcome.active, case.asks(with::ACTIVE) && of_block),
    ]
}

/// Whether a component of the state is asked for.
fn asks_component(case: &Case, entry: Entry, component: usize) -> bool {
    if case.law.is_linear() {
        return case.asks(with::FAILURE);
    }
    if entry.is_point() {
        return case.asks_state();
    }
    case.asks([with::ENERGIES, with::INVARIANTS, with::FAILURE][(component / 4).min(2)])
}

/// Inputs, guards, and outputs that were not asked for.
fn untouched<T: Functions>(case: &Case, outcome: &Outcome<T>) -> Checked {
    holds(!outcome.input_written, || "an input is written to".into())?;
    for (name, array, asked) in arrays(case, outcome) {
        match array.written_padding() {
            Some(at) => return Err(format!("{name}: entry {at} of no point is written to")),
            None => holds(asked || array.is_untouched(), || format!("{name} is written, not asked for"))?,
        }
    }
    holds(outcome.state.written_padding().is_none(), || "state: an entry of no point is written to".into())?;
    holds(!outcome.wrote_beside_status(), || "status: an entry of no point is written to".into())?;
    for c in 0..case.law.state() {
        let kept = asks_component(case, outcome.entry, c) || same_component(&outcome.state, &outcome.state_before, c);
        holds(kept, || format!("state variable {c} is written, not asked for"))?;
    }
    let axes_may_change = case.law.is_linear() && case.rotation == 2;
    holds(axes_may_change || outcome.axes.is_as(&outcome.axes_before), || "axes are written".into())
}

fn same_component<T: Functions>(a: &Array<T>, b: &Array<T>, component: usize) -> bool {
    (0..a.points).all(|i| a.get(component, i).bits() == b.get(component, i).bits())
}

/// A call that is refused as a whole writes nothing.
fn refused_call<T: Functions>(case: &Case, outcome: &Outcome<T>) -> Checked {
    for (name, array, _) in arrays(case, outcome) {
        holds(array.is_untouched(), || format!("{name} is written"))?;
    }
    let kept = outcome.state.is_as(&outcome.state_before) && outcome.axes.is_as(&outcome.axes_before);
    holds(kept, || "the state is written".into())?;
    holds(outcome.status.iter().all(|&code| code == NO_STATUS), || "status is written".into())
}

/// What comes out is a number, for every point. A UMAT leaves the state of a refused point as it is.
fn finite<T: Functions>(case: &Case, outcome: &Outcome<T>, i: usize) -> Checked {
    for (name, array, asked) in arrays(case, outcome) {
        holds(!asked || array.row(i).iter().all(|x| x.is_finite()), || format!("{name} {:?}", array.row(i)))?;
    }
    let is_kept = outcome.entry == Entry::Host && case.host == Host::Umat && outcome.code != 0;
    let state = outcome.state.row(i);
    let wrong = (0..state.len()).find(|&c| asks_component(case, outcome.entry, c) && !state[c].is_finite());
    holds(is_kept || wrong.is_none(), || format!("state {state:?}"))
}

/// What is said of a point by its code.
fn point<T: Functions>(case: &Case, outcome: &Outcome<T>, i: usize, code: i32) -> Checked {
    holds(code == 0 || POINT_CODES.contains(&code), || "no code of a point".into())?;
    let old = old_state::<T>(case, outcome.entry, i);
    let umat = outcome.entry == Entry::Host && case.host == Host::Umat;
    if umat && code != 0 {
        return refused_umat(case, outcome);
    }
    let deletes = outcome.entry == Entry::Host && case.host.has_blocks();
    let failed_before = has_failed(old[case.law.failed()]);
    if code != 0 || failed_before {
        nothing_carried(case, outcome, i)?;
        kept(case, outcome, i, &old, deletes && code != 0)?;
    }
    if case.asks(with::FAILURE) && asks_component(case, outcome.entry, case.law.failed()) {
        let row = outcome.state.row(i);
        let [failed, alive] = [row[case.law.failed()], row[case.law.failed() + 1]];
        holds((failed == 0.0 || failed == 1.0) && alive == 1.0 - failed, || format!("failed {failed}, alive {alive}"))?;
        holds(!failed_before || failed == 1.0, || "a point that has failed is whole again".into())?;
        let of_block = !outcome.entry.is_point() && outcome.entry != Entry::Host;
        if case.asks(with::ACTIVE) && of_block {
            let active: f64 = outcome.active.get(0, i).into();
            let expected = if code == 0 { alive } else { 0.0 };
            holds(active == expected, || format!("active {active}, alive {alive}"))?;
        }
    }
    if case.asks(with::WAVE_SPEED) {
        laws::wave_speed::<T>(case, outcome.wave_speed.get(0, i).into(), code != 0)?;
    }
    if code == 0 && !failed_before {
        laws::evaluated(case, outcome, i, &old)?;
    }
    Ok(())
}

/// A point that has failed before or is refused: stress, modes and tangent are 0.
fn nothing_carried<T: Functions>(case: &Case, outcome: &Outcome<T>, i: usize) -> Checked {
    for (name, array, asked) in &arrays(case, outcome)[..3] {
        let row = array.row(i);
        holds(!asked || row.iter().all(|&x| x == 0.0), || format!("{name} {row:?}, not 0"))?;
    }
    Ok(())
}

/// The state of such a point: as it was, what was not finite 0, and the flags. A host with blocks deletes a refused point.
fn kept<T: Functions>(case: &Case, outcome: &Outcome<T>, i: usize, old: &[f64], deleted: bool) -> Checked {
    let (row, failed) = (outcome.state.row(i), case.law.failed());
    let latch = if deleted || has_failed(old[failed]) { 1.0 } else { 0.0 };
    for c in (0..case.law.state()).filter(|&c| asks_component(case, outcome.entry, c)) {
        let expected = match c {
            _ if c == failed => latch,
            _ if c == failed + 1 => 1.0 - latch,
            // The stress of the linear elastic law is that of the point: none once it has failed.
            _ if case.law == Law::Linear && c < 6 && has_failed(old[failed]) => 0.0,
            _ if old[c].is_finite() => old[c],
            _ => 0.0,
        };
        holds(row[c] == expected, || format!("state variable {c} is {}, not {expected} as before", row[c]))?;
    }
    Ok(())
}

/// A refused point of a UMAT: no stress, the state to the bit, a smaller step.
fn refused_umat<T: Functions>(case: &Case, outcome: &Outcome<T>) -> Checked {
    nothing_carried(case, outcome, 0)?;
    holds(outcome.state.is_as(&outcome.state_before), || "the state is written".into())?;
    holds(outcome.beside[1] <= 0.25, || format!("PNEWDT is {}", outcome.beside[1]))
}
