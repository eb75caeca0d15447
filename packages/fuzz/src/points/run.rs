//! Cases one after the other: each through its entries, the one that fails made small.

use std::cell::RefCell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;
use std::time::{Duration, Instant};

use fastrand::Rng;
use toron::status;

use super::case::{Case, Form, HOSTS, Host, Input, Law, Old, with};
use super::checks::{self, Checked, holds};
use super::compare::{Of, close, is_moderate, same};
use super::entries::{Entry, Outcome, call};
use super::faults::Fault;
use super::functions::Functions;
use super::{difference, hosts, literal};

/// What a run has done.
#[derive(Clone, Copy, Debug, Default)]
pub struct Totals {
    pub cases: u64,
    pub calls: u64,
    /// Points that calls were asked to evaluate.
    pub points: u64,
    /// Points of which a call said that it cannot evaluate them.
    pub refused: u64,
    /// Points held against the formulas in high precision, and the worst error in units of the rounding.
    pub literal: u64,
    pub worst: [f64; 2],
    /// Tangents held against differences of the stress.
    pub differences: u64,
    /// Points that hosts have evaluated, as the block has: UMAT, VUMAT, MGIS, LS-DYNA, OpenRadioss, CalculiX.
    pub hosts: [u64; HOSTS.len() - 1],
    /// Tangents of LS-DYNA that are those of the block.
    pub tangents: u64,
}

/// A case that fails.
#[derive(Debug)]
pub struct Found {
    pub case: Case,
    pub why: String,
}

thread_local! {
    /// The case that is called, for the message of a panic: one in a C function ends the process.
    static CURRENT: RefCell<Option<Case>> = const { RefCell::new(None) };
}

fn tell_case_of_panics() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let usual = panic::take_hook();
        panic::set_hook(Box::new(move |panic| {
            usual(panic);
            CURRENT.with_borrow(|case| {
                if let Some(case) = case {
                    eprintln!("the case: {case}");
                }
            });
        }));
    });
}

/// Runs cases from this seed on until their calls have been asked for so many points, or one fails.
pub fn run(seed: u64, points: u64, fault: Option<Fault>) -> (Totals, Option<Found>) {
    tell_case_of_panics();
    let mut totals = Totals::default();
    let mut seeds = Rng::with_seed(seed);
    while totals.points < points {
        let case = Case::random(seeds.u64(..));
        totals.cases += 1;
        if let Err(why) = checked(&case, fault, &mut totals) {
            return (totals, Some(Found { case, why }));
        }
    }
    (totals, None)
}

/// Checks a case.
///
/// # Errors
/// What does not hold.
pub fn replay(case: &Case, fault: Option<Fault>) -> Checked {
    tell_case_of_panics();
    checked(case, fault, &mut Totals::default())
}

fn checked(case: &Case, fault: Option<Fault>, totals: &mut Totals) -> Checked {
    CURRENT.set(Some(case.clone()));
    let checked = panic::catch_unwind(AssertUnwindSafe(|| {
        if case.single {
            through_entries::<f32>(case, fault, totals)
        } else {
            through_entries::<f64>(case, fault, totals)
        }
    }));
    CURRENT.set(None);
    checked.unwrap_or_else(|_| Err("a panic".into()))
}

/// Calls an entry, counts, and checks the outcome by itself.
fn one<T: Functions>(
    entry: Entry,
    case: &Case,
    fault: Option<Fault>,
    totals: &mut Totals,
    codes: Option<&[Option<i32>]>,
) -> Result<Outcome<T>, String> {
    let outcome = call::<T>(entry, case, fault);
    let n = case.points.len();
    totals.calls += 1;
    totals.points += n as u64;
    let own: Vec<_> = (0..n).map(|i| outcome.status(case, i)).collect();
    totals.refused += own.iter().filter(|code| matches!(code, Some(-310..=-301))).count() as u64;
    checks::outcome(case, &outcome, codes.unwrap_or(&own))?;
    Ok(outcome)
}

fn through_entries<T: Functions>(case: &Case, fault: Option<Fault>, totals: &mut Totals) -> Checked {
    let reference = one::<T>(Entry::Block, case, fault, totals, None)?;
    let other = one::<T>(Entry::BlockWithProperties, case, fault, totals, None)?;
    holds(reference.code == other.code, || format!("codes {} and {} of blocks", reference.code, other.code))?;
    let is_refused = reference.code <= -100 && reference.code > -300;
    let n = case.points.len();
    if !is_refused {
        for i in 0..n {
            same(case, of(&reference, i), of(&other, i))?;
        }
        other_level(case, fault, totals, &reference)?;
    }
    let rng = &mut Rng::with_seed(case.seed ^ 0x5eed);
    for _ in 0..n.min(2) {
        let i = rng.usize(..n);
        let alone = case.of_point(i);
        for entry in [Entry::BlockOfOne, Entry::Point, Entry::PointWithProperties] {
            let outcome = one::<T>(entry, &alone, fault, totals, None)?;
            if is_refused {
                holds((-300..=-100).contains(&outcome.code), || {
                    format!("{entry:?} returned {}, not a refusal", outcome.code)
                })?;
            } else if has_same_request(case, entry) {
                let exact = has_same_bits(case, entry);
                let (a, b) = (of(&reference, i), of(&outcome, 0));
                if exact { same(case, a, b) } else { close(case, a, b) }?;
            }
        }
        if !is_refused {
            let seed = rng.u64(..);
            totals.literal += u64::from(literal::check::<T>(case, i, &reference, seed, &mut totals.worst)?);
            totals.differences += u64::from(difference::check::<T>(&alone, fault, seed)?);
        }
        let code = if is_refused { Some(reference.code) } else { reference.status(case, i) };
        let goes_on = case.host != Host::CalculiX || code.is_some_and(|code| hosts::goes_on(case, i, code));
        if case.host.has_points() && goes_on {
            let outcome = one::<T>(Entry::Host, &alone, fault, totals, None)?;
            let evaluated = through_host(case, &reference, i, &outcome, 0)?;
            totals.hosts[case.host as usize - 1] += u64::from(evaluated);
            tangents_of_elements(&alone, &outcome, fault, totals)?;
        }
    }
    if case.host.has_blocks() {
        let codes: Vec<_> = (0..n).map(|i| reference.status(case, i)).collect();
        let codes = if is_refused { None } else { Some(&codes[..]) };
        let outcome = one::<T>(Entry::Host, case, fault, totals, codes)?;
        for i in 0..n {
            totals.hosts[case.host as usize - 1] += u64::from(through_host(case, &reference, i, &outcome, i)?);
        }
        tangents_of_elements(case, &outcome, fault, totals)?;
    }
    Ok(())
}

/// The tangents of LS-DYNA: the symmetric part of those of a further step to the same F, from the state written.
fn tangents_of_elements<T: Functions>(
    case: &Case,
    outcome: &Outcome<T>,
    fault: Option<Fault>,
    totals: &mut Totals,
) -> Checked {
    let Some((code, tangents)) = &outcome.further else { return Ok(()) };
    if *code == status::NO_DEFORMATION_GRADIENT && lacks_gradient(case, 0) {
        return Ok(());
    }
    // What the routine evaluates itself; a stress may be beyond the format.
    let asked = with::TANGENT | with::STATUS | with::STATE | with::STRESS;
    let mut further = Case { host: Host::None, with: asked, old: Old::Apart, measure: 1, ..case.clone() };
    for (i, point) in further.points.iter_mut().enumerate() {
        (point.state, point.f_old) = (outcome.state.row(i), point.f);
    }
    let block = call::<T>(Entry::BlockWithProperties, &further, fault);
    // Those of the hyperelastic law are symmetric.
    let block = if case.law == Law::Hyperelastic { block } else { block.symmetric() };
    holds(*code == block.code, || format!("utan returned {code}, the block {}", block.code))?;
    let exact = case.law != Law::Hyperelastic || !hosts::is_scalar(case);
    for i in 0..case.points.len() {
        let [found, expected] = [tangents, &block.tangent].map(|array| array.row(i));
        let size = expected.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let near = |(a, b): (&f64, &f64)| a == b || (!exact && (a - b).abs() <= 1e6 * T::ROUNDING * size);
        let moderate = exact || is_moderate(case, i, outcome.state.get(5, i).into());
        holds(!moderate || found.iter().zip(&expected).all(near), || {
            format!("utan, point {i}: {found:?}, the block {expected:?}")
        })?;
        totals.tangents += u64::from(moderate);
    }
    Ok(())
}

/// Whether the first element of a call, this one of the case, may be one of which LS-DYNA and OpenRadioss say that it has no F: its state is
/// that before a first call or none at all, or F has a row or column of zeros.
fn lacks_gradient(case: &Case, first: usize) -> bool {
    let Some(point) = case.points.get(first) else { return false };
    let failed = case.law.failed();
    let flags = &point.state[failed..failed + 2];
    let is_state = flags.iter().all(|&x| x == 0.0 || x == 1.0) && flags[0] + flags[1] > 0.0;
    let zeros = |first: usize, stride: usize| (0..3).all(|i| point.f[first + stride * i] as f32 == 0.0);
    !is_state || (0..3).any(|k| zeros(3 * k, 1) || zeros(k, 3))
}

fn of<T>(outcome: &Outcome<T>, point: usize) -> Of<'_, T> {
    Of { outcome, point }
}

/// AVX2 and AVX-512 give the same bits.
fn other_level<T: Functions>(
    case: &Case,
    fault: Option<Fault>,
    totals: &mut Totals,
    reference: &Outcome<T>,
) -> Checked {
    if case.level < 2 {
        return Ok(());
    }
    let case = Case { level: 5 - case.level, ..case.clone() };
    let other = one::<T>(Entry::BlockWithProperties, &case, fault, totals, None)?;
    (0..case.points.len()).try_for_each(|i| same(&case, of(reference, i), of(&other, i)))
}

/// Whether the entry for one point is asked for the same as the block: a point has a state in whole or not at all, and
/// what is not asked for is not looked at.
fn has_same_request(case: &Case, entry: Entry) -> bool {
    !entry.is_point() || case.asks_state() || (case.old != Old::InPlace && !case.asks(with::STATE))
}

/// Whether an entry promises the bits of the block.
fn has_same_bits(case: &Case, entry: Entry) -> bool {
    match (entry, case.law) {
        (Entry::PointWithProperties, Law::Hyperelastic) => false,
        (Entry::Point, Law::Hyperelastic) => !case.asks(with::TANGENT),
        _ => true,
    }
}

/// A host's answer against that of the block; whether it has evaluated the point.
fn through_host<T: Functions>(
    case: &Case,
    reference: &Outcome<T>,
    i: usize,
    outcome: &Outcome<T>,
    j: usize,
) -> Result<bool, String> {
    const POINT: std::ops::RangeInclusive<i32> = -310..=-301;
    let code =
        if reference.code < -300 || reference.code == 0 { reference.status(case, i) } else { Some(reference.code) };
    let Some(code) = code else { return Ok(false) };
    if let Some(stop) = checks::stopped(case, outcome) {
        let has_length = |m: &[f64; 3]| (1e-30..1e30).contains(&m.iter().map(|x| x.abs()).sum::<f64>());
        let mut points = (0..case.points.len()).map(|i| (&case.points[i].fibre, reference.status(case, i)));
        let is_due = points.any(|(fibre, code)| {
            // In the first cycle all directions are looked at, also those of points that have failed.
            let first = stop == status::FIBRE_DIRECTION && hosts::is_first_cycle(case) && !has_length(fibre);
            first || code == Some(stop)
        });
        holds(is_due, || format!("OpenRadioss is stopped with {stop}"))?;
        return Ok(false);
    }
    let is_whole = |code: i32| code != 0 && !POINT.contains(&code);
    let refused = match case.host {
        Host::Vumat => is_whole(reference.code),
        _ if case.host.has_blocks() => is_whole(reference.code) || is_whole(outcome.code),
        _ => outcome.code != 0,
    };
    if refused || code != 0 {
        let expected = match case.host {
            // A host has more to compute: energies per mass, another stress.
            Host::Umat | Host::Mgis | Host::CalculiX if code == 0 => is_extreme(case, i),
            // Which of several wrong arguments is named is a host's choice.
            _ if (-300..=-100).contains(&code) => (-300..=-100).contains(&outcome.code) || outcome.code == -1,
            Host::LsDyna | Host::OpenRadioss if outcome.code == status::NO_DEFORMATION_GRADIENT => {
                lacks_gradient(case, i - j)
            }
            // From a law without stiffness the starter has no time step.
            Host::OpenRadioss if outcome.code == status::BAD_ARGUMENT => case.properties[0] < 1e-30,
            Host::LsDyna | Host::OpenRadioss if is_whole(outcome.code) => false,
            // Checked by the codes of all points.
            _ if case.host.has_blocks() => true,
            // A limit that is none is an argument of a UMAT, looked at before F; an energy per volume may overflow.
            Host::Umat if outcome.code == status::BAD_ARGUMENT => is_no_limit(case.points[i].limit),
            Host::Umat => outcome.code == code || outcome.code == status::OVERFLOW,
            Host::CalculiX => outcome.beside[0] <= 0.25,
            _ => outcome.code == -1 && (!POINT.contains(&code) || outcome.beside[1] <= 0.25),
        };
        holds(expected, || {
            format!("host returned {}, {}, the block {code}, {:?}", outcome.code, outcome.message, outcome.beside)
        })?;
        return Ok(false);
    }
    // A matrix of which CalculiX has a triangle.
    let symmetric = case.host == Host::CalculiX;
    let reference = if symmetric { &reference.clone().symmetric() } else { reference };
    let (a, b) = (of(reference, i), of(outcome, j));
    let exact = match case.host {
        // Other stress measures.
        Host::Mgis | Host::CalculiX => false,
        Host::LsDyna => case.law != Law::Hyperelastic || !of_one_element(case, outcome),
        _ => case.law != Law::Hyperelastic || case.host.has_blocks(),
    };
    if exact { same(case, a, b) } else { close(case, a, b) }?;
    Ok(true)
}

/// Whether an outcome is that of the routine of LS-DYNA for one element.
fn of_one_element<T: Functions>(case: &Case, outcome: &Outcome<T>) -> bool {
    case.host == Host::LsDyna && outcome.stress.points == 1 && hosts::is_scalar(&case.of_point(0))
}

/// Whether a product of a point's numbers may be beyond the format.
fn is_extreme(case: &Case, i: usize) -> bool {
    // The second Piola–Kirchhoff stress has products of four entries of F.
    let most = match case.host {
        Host::CalculiX => 1e30,
        _ if case.single => 1e8,
        _ => 1e80,
    };
    let point = &case.points[i];
    let numbers = point.f.iter().chain(&case.properties).chain([&case.density]);
    // The linear law's state has a stress.
    let is_large = case.law == Law::Linear && point.state.iter().any(|x| x.abs() >= most);
    is_large || numbers.into_iter().any(|x| *x != 0.0 && !(1.0 / most..most).contains(&x.abs()))
}

fn is_no_limit(limit: f64) -> bool {
    !(limit >= 0.0 && limit.is_finite())
}

/// The smallest case, as far as it is found, that still fails.
pub fn smallest(found: Found, fault: Option<Fault>) -> Found {
    /// Then it is small enough, or a case of many points takes too long.
    const MOST_PASSES: usize = 4;
    const MOST_TIME: Duration = Duration::from_secs(60);
    let (mut found, start) = (found, Instant::now());
    for _ in 0..MOST_PASSES {
        let (mut place, before) = (0, found.case.to_string());
        let mut cases = smaller(&found.case);
        while let Some(case) = cases.get(place).filter(|_| start.elapsed() < MOST_TIME) {
            match replay(case, fault) {
                Err(why) => {
                    found = Found { case: case.clone(), why };
                    cases = smaller(&found.case);
                }
                Ok(()) => place += 1,
            }
        }
        if found.case.to_string() == before {
            break;
        }
    }
    found
}

/// Numbers are made simpler in cases of no more points.
const MOST_POINTS: usize = 16;

/// Cases that are smaller: fewer points, plainer arrays, fewer requests, simpler numbers.
fn smaller(case: &Case) -> Vec<Case> {
    let mut cases = Vec::new();
    let n = case.points.len();
    for (from, to) in [(0, n / 2), (n / 2, n)].into_iter().chain((0..n).map(|i| (i, i + 1))) {
        if from < to && to - from < n {
            let mut points = case.points.clone();
            points.drain(from..to);
            cases.push(Case { points, ..case.clone() });
        }
    }
    let before = case.to_string();
    let mut add = |change: &dyn Fn(&mut Case)| {
        let mut changed = case.clone();
        change(&mut changed);
        let host = changed.host;
        changed.points.iter_mut().for_each(|point| point.fit_host(host));
        // As text: NaN is not equal to itself.
        if changed.to_string() != before {
            cases.push(changed);
        }
    };
    add(&|case| case.placings = Default::default());
    add(&|case| case.gap = 0);
    for group in 0..case.placings.len() {
        add(&|case| case.placings[group] = Default::default());
        add(&|case| case.placings[group].form = Form::Plain);
    }
    if case.host == Host::None {
        add(&|case| case.level = 0);
        for bit in 0..12 {
            add(&|case| case.with &= !(1 << bit));
        }
    }
    add(&|case| case.rotation = 0);
    for (place, &value) in case.properties.iter().enumerate() {
        for simple in simpler(value) {
            add(&|case| case.properties[place] = simple);
        }
    }
    // Each is a copy of the case, which must be small for so many.
    let points = if n > MOST_POINTS { 0 } else { n };
    for point in 0..points {
        let count = numbers(&mut case.points[point].clone()).count();
        for place in 0..count {
            let value = *numbers(&mut case.points[point].clone()).nth(place).expect("a number");
            for simple in simpler(value) {
                add(&|case| {
                    if let Some(number) = numbers(&mut case.points[point]).nth(place) {
                        *number = simple;
                    }
                });
            }
        }
    }
    cases
}

fn numbers(point: &mut Input) -> impl Iterator<Item = &mut f64> {
    let Input { f, f_old, fibre, second_axis, limit, axes, state } = point;
    f.iter_mut().chain(f_old).chain(fibre).chain(second_axis).chain(std::iter::once(limit)).chain(axes).chain(state)
}

/// Simpler numbers in place of one, in a direction that ends.
fn simpler(value: f64) -> Vec<f64> {
    let weight = |x: f64| format!("{x:?}").len();
    let rounded = |digits: f64| (value * digits).round() / digits;
    let mut simple = vec![0.0, 1.0, rounded(1.0), rounded(100.0)];
    simple.retain(|&x| weight(x) < weight(value) || (x == 0.0 && value == 1.0));
    simple
}
