//! DDSDDE against differences of the law's own stress, at many states, and in what way it is wrong.

use std::time::{Duration, Instant};

use fastrand::Rng;
use nalgebra::Matrix3;

use super::call::{Call, Session};
use super::differences::{Derivative, TOLERANCE, of_deformation, of_strain_increment};
use super::finding::{Finding, NOT_FINITE, Question, Verdict};
use super::histories::history;
use super::hypotheses::{self, ExactTangent, Factor, stress_by_volume};
use super::judgement::{Difference, compare, contraction};
use super::kinematics::{Components, Increment, Modulus, name, of_stress, rotation_of};
use super::material::Reads;
use super::point::{Failure, Point};

/// States that are asked at, if the time suffices.
const STATES: usize = 200;
const TIME: Duration = Duration::from_secs(14);
/// For naming what is wrong.
const TIME_FOR_NAMES: Duration = Duration::from_secs(14);
/// Histories, at most; each gives some states.
const HISTORIES: usize = 60;
/// States on which mistakes are tried, of the wrong and of the right ones.
const TRIED: usize = 24;

/// So many wrong states of at least [`MANY`] times as many are a warning.
const FEW: usize = 2;
const MANY: usize = 25;

/// Relative difference from which the modulus of unloading is another than that of loading.
const TWO_MODULI: f64 = 5e-2;

/// The kind of a law that is written for another order.
pub const EXCHANGED: &str = "13 and 23 exchanged";

/// What DDSDDE may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Convention {
    /// The Jaumann rate of the Kirchhoff stress over J.
    Jaumann,
    /// The plain ∂Δσ/∂Δε.
    Plain,
    /// The same with σ⊗I, which makes it that of the Kirchhoff stress over J.
    PlainWithVolume,
}

impl Convention {
    fn of(reads: Reads, components: usize) -> &'static [Convention] {
        use Convention::{Jaumann, Plain, PlainWithVolume};
        match reads {
            // In plane stress the law alone knows the thickness, and so J.
            _ if components == 3 => &[Plain, PlainWithVolume],
            Reads::Total => &[Jaumann],
            Reads::Rate => &[Plain, PlainWithVolume],
            Reads::Mixed => &[Jaumann, Plain, PlainWithVolume],
        }
    }

    fn name(self) -> &'static str {
        match self {
            Convention::Jaumann => "the Jaumann rate of the Kirchhoff stress over J",
            Convention::Plain => "∂Δσ/∂Δε",
            Convention::PlainWithVolume => "∂Δσ/∂Δε + σ⊗I",
        }
    }
}

/// An increment at whose end DDSDDE is asked for.
struct State {
    name: String,
    before: Point,
    call: Call,
    f1: Matrix3<f64>,
    stress: Components,
    modulus: Modulus,
    jaumann: Option<Derivative>,
    plain: Option<Derivative>,
}

impl State {
    /// The differences, and what DDSDDE should be.
    fn truth(&self, convention: Convention, components: usize) -> Option<(&Derivative, Modulus)> {
        let differences = match convention {
            Convention::Jaumann => self.jaumann.as_ref()?,
            Convention::Plain | Convention::PlainWithVolume => self.plain.as_ref()?,
        };
        let mut truth = differences.value;
        if convention == Convention::PlainWithVolume {
            for (row, terms) in truth.iter_mut().zip(stress_by_volume(&self.stress, components)) {
                for (entry, term) in row.iter_mut().zip(terms) {
                    *entry += term;
                }
            }
        }
        Some((differences, truth))
    }
}

/// DDSDDE against derivatives of the stress. Where it is wrong in no known way, the question is repeated with 13 and 23 exchanged.
pub fn tangent(session: &mut Session, reads: Reads, allowed: Option<f64>) -> Finding {
    let started = Instant::now();
    let mut line = tangent_in_order(session, reads, allowed);
    // As long again must not be too long.
    if session.material.components == 6 && line.kinds == ["unknown"] && started.elapsed() < TIME {
        session.exchange(true);
        let exchanged = tangent_in_order(session, reads, allowed);
        session.exchange(false);
        let named = exchanged.verdict == Verdict::Wrong && exchanged.kinds != line.kinds;
        if exchanged.verdict == Verdict::Right || named {
            line.kinds = vec![EXCHANGED.to_string()];
            line.kinds.extend(exchanged.kinds);
            let text = if exchanged.verdict == Verdict::Right { line.text } else { exchanged.text };
            line.text = format!("{EXCHANGED} in STRESS and DDSDDE (the order is 11 22 33 12 13 23): {text}");
        }
    }
    line
}

fn tangent_in_order(session: &mut Session, reads: Reads, allowed: Option<f64>) -> Finding {
    let components = session.material.components;
    let (states, broken) = match gather(session, reads) {
        Ok(gathered) => gathered,
        Err(line) => return *line,
    };
    if broken && states.is_empty() {
        return Finding::new(
            Question::Tangent,
            Verdict::NotSure,
            None,
            "the law asks for smaller increments at every state",
        );
    }
    let tolerance = allowed.unwrap_or(TOLERANCE);
    let judged = |convention: &Convention| {
        let found = states.iter().map(|state| {
            let (differences, truth) = state.truth(*convention, components)?;
            Some(compare(&state.modulus, &truth, differences, components))
        });
        found.collect::<Vec<Option<Difference>>>()
    };
    let by_convention = Convention::of(reads, components).iter().map(|convention| (*convention, judged(convention)));
    let rank = |found: &[Option<Difference>]| {
        let wrong = found.iter().flatten().filter(|difference| difference.worst > TOLERANCE).count();
        (wrong, worst(found).map_or(0.0, |(_, difference)| difference.worst))
    };
    let best = by_convention.min_by(|a, b| rank(&a.1).partial_cmp(&rank(&b.1)).unwrap_or(std::cmp::Ordering::Equal));
    let Some((convention, found)) = best else {
        return Finding::new(Question::Tangent, Verdict::NotAsked, None, "");
    };
    let Some((at, difference)) = worst(&found) else {
        return Finding::new(Question::Tangent, Verdict::NotSure, None, "no state has sure differences");
    };
    let unsure = found.iter().filter(|found| found.is_none_or(|found| found.unsure > 0)).count();
    let kinks = states.iter().filter(|state| {
        let differences = state.jaumann.iter().chain(&state.plain);
        differences.into_iter().any(|differences| differences.kinks.iter().flatten().any(|kink| *kink))
    });
    let kinks = kinks.count();
    let aside = match (unsure, kinks) {
        (0, _) => String::new(),
        (unsure, 0) => format!("; {unsure} states in part without sure differences"),
        (unsure, kinks) => format!("; {unsure} states in part without sure differences, {kinks} of them at kinks"),
    };
    if difference.worst <= TOLERANCE {
        let text = format!("{} at {} states{aside}", convention.name(), states.len());
        // Sure of nothing is not right.
        let verdict = if unsure * 2 > states.len() { Verdict::NotSure } else { Verdict::Right };
        return Finding::new(Question::Tangent, verdict, Some(difference.worst), text);
    }
    let wrong: Vec<usize> =
        (0..states.len()).filter(|&k| found[k].is_some_and(|difference| difference.worst > TOLERANCE)).collect();
    let right: Vec<usize> =
        (0..states.len()).filter(|&k| found[k].is_some_and(|difference| difference.worst <= TOLERANCE)).collect();
    let (i, j) = difference.place;
    let place = format!("({}, {})", name(components, i), name(components, j));
    let instead = states[at].truth(convention, components).map_or(f64::NAN, |(_, truth)| truth[i][j]);
    let is = states[at].modulus[i][j];
    let factor = wrong.iter().filter_map(|&k| {
        let (_, truth) = states[k].truth(convention, components)?;
        contraction(&states[k].modulus, &truth, components)
    });
    let factor = factor.fold(0.0, f64::max);
    let slows = convergence(factor);
    let few = wrong.len() <= FEW && states.len() >= MANY * FEW;
    let (kinds, way) = if few {
        (vec!["few states".to_string()], "in few states alone, perhaps at kinks that are not seen".to_string())
    } else {
        in_what_way(session, &states, &wrong, &right, &found, Convention::of(reads, components))
    };
    let where_ = states_named(&states, &wrong);
    let text = format!(
        "{way}; wrong at {} of {} states ({where_}), worst at {place} {}, {is:.5e} instead of {instead:.5e}; {slows}{aside}",
        wrong.len(),
        states.len(),
        states[at].name,
    );
    let verdict = if few || difference.worst <= tolerance { Verdict::Warning } else { Verdict::Wrong };
    let mut line = Finding::new(Question::Tangent, verdict, Some(difference.worst), text);
    line.kinds = kinds;
    if few {
        line.call_bits = Some(states[at].call.numbers().into_iter().map(f64::to_bits).collect());
    }
    line
}

fn convergence(factor: f64) -> String {
    if factor >= 1.0 {
        return format!("Newton's method may diverge: it multiplies an error by up to {factor:.2}");
    }
    if factor < 1e-3 {
        return "it hardly slows Newton's method".to_string();
    }
    if factor > 0.98 {
        return format!("Newton's method keeps {factor:.2} of an error and hardly converges");
    }
    let iterations = (1e-8_f64.ln() / factor.ln()).ceil();
    format!("Newton's method keeps {factor:.2} of an error: {iterations} iterations for eight digits")
}

fn worst(found: &[Option<Difference>]) -> Option<(usize, Difference)> {
    let found = found.iter().enumerate().filter_map(|(k, difference)| difference.map(|difference| (k, difference)));
    found.max_by(|a, b| a.1.worst.total_cmp(&b.1.worst))
}

/// The kinds of the states, each once with how many there are.
fn states_named(states: &[State], wrong: &[usize]) -> String {
    let mut names: Vec<(&str, usize, usize)> = Vec::new();
    for (k, state) in states.iter().enumerate() {
        let of = usize::from(wrong.contains(&k));
        match names.iter_mut().find(|(name, ..)| *name == state.name) {
            Some((_, all, count)) => (*all, *count) = (*all + 1, *count + of),
            None => names.push((&state.name, 1, of)),
        }
    }
    let wrong = names.iter().filter(|(_, _, count)| *count > 0);
    wrong.map(|(name, all, count)| format!("{name} {count} of {all}")).collect::<Vec<_>>().join(", ")
}

/// The states, and whether the law refused some.
fn gather(session: &mut Session, reads: Reads) -> Result<(Vec<State>, bool), Box<Finding>> {
    let started = Instant::now();
    let mut rng = Rng::with_seed(session.material.seed);
    let mut states = Vec::new();
    let mut broken = false;
    let rest = Point::virgin(session, [1, 1]);
    let identity = Matrix3::identity();
    match state(session, &rest, &identity, reads, "at rest") {
        Ok(state) => states.push(state),
        Err(failure) => broken |= refused(failure)?,
    }
    'histories: for number in 0..HISTORIES {
        let mut point = Point::virgin(session, [1, 1]);
        let path = history(&mut rng, session.material, 3);
        let asked = [rng.usize(0..path.len()), rng.usize(0..path.len()), path.len() - 1, 0];
        for (k, f1) in path.iter().enumerate() {
            if started.elapsed() > TIME {
                break 'histories;
            }
            if asked.contains(&k) && !(k == 0 && number % 4 > 0) {
                let name = kind_of(&point, f1);
                match state(session, &point, f1, reads, name) {
                    Ok(state) => states.push(state),
                    Err(failure) => broken |= refused(failure)?,
                }
                if states.len() >= STATES {
                    break 'histories;
                }
            }
            if let Err(failure) = point.advance(session, f1) {
                broken |= refused(failure)?;
                break;
            }
        }
    }
    Ok((states, broken))
}

/// What an increment does, in a word.
fn kind_of(point: &Point, f1: &Matrix3<f64>) -> &'static str {
    let strain = |f: &Matrix3<f64>| Increment::between(&Matrix3::identity(), f).strain.norm();
    if point.f == Matrix3::identity() {
        "in the first increment"
    } else if strain(f1) < strain(&point.f) {
        "unloading"
    } else {
        "loading"
    }
}

fn refused(failure: Failure) -> Result<bool, Box<Finding>> {
    match failure {
        Failure::Refused => Ok(true),
        Failure::NotFinite(call) => {
            let text = format!("stress, state or DDSDDE is not finite at increment {}", call.increment);
            Err(Box::new(Finding::new(Question::Tangent, Verdict::Wrong, None, text).with(NOT_FINITE)))
        }
    }
}

fn state(session: &mut Session, before: &Point, f1: &Matrix3<f64>, reads: Reads, name: &str) -> Result<State, Failure> {
    let call = before.call(f1, session.material);
    let answer = session.call_law(&call);
    if answer.refused() {
        return Err(Failure::Refused);
    }
    if !answer.finite() {
        return Err(Failure::NotFinite(Box::new(call)));
    }
    let (jaumann, plain) = derivatives(session, before, &call, f1, reads);
    Ok(State {
        name: name.to_string(),
        before: before.clone(),
        call,
        f1: *f1,
        stress: answer.stress,
        modulus: answer.modulus,
        jaumann,
        plain,
    })
}

fn derivatives(
    session: &mut Session,
    before: &Point,
    call: &Call,
    f1: &Matrix3<f64>,
    reads: Reads,
) -> (Option<Derivative>, Option<Derivative>) {
    let conventions = Convention::of(reads, session.material.components);
    let jaumann = conventions.contains(&Convention::Jaumann);
    let plain = conventions.contains(&Convention::Plain);
    (
        jaumann.then(|| of_deformation(session, before, call, f1)).flatten(),
        plain.then(|| of_strain_increment(session, call)).flatten(),
    )
}

/// The mistakes that explain what is seen, and how it is said.
fn in_what_way(
    session: &mut Session,
    states: &[State],
    wrong: &[usize],
    right: &[usize],
    found: &[Option<Difference>],
    conventions: &[Convention],
) -> (Vec<String>, String) {
    let components = session.material.components;
    // The most wrong ones say most.
    let mut wrong = wrong.to_vec();
    wrong.sort_by(|&a, &b| error_at(found, b).total_cmp(&error_at(found, a)));
    let spread = wrong.len().div_ceil(TRIED).max(1);
    let wrong: Vec<usize> = wrong.into_iter().step_by(spread).collect();
    let right: Vec<usize> = right.iter().copied().step_by(right.len().div_ceil(TRIED).max(1)).collect();
    let mut names: Vec<(Vec<&'static str>, String, Factor, bool)> = Vec::new();
    let deadline = Instant::now() + TIME_FOR_NAMES;
    for &convention in conventions {
        let mut tried: Vec<(usize, Vec<hypotheses::Hypothesis>)> = Vec::new();
        for &k in wrong.iter().chain(&right) {
            if Instant::now() > deadline {
                return (vec!["unknown".to_string()], "too slow a law to be asked in what way".to_string());
            }
            if let Some(exact) = exact(session, &states[k], convention) {
                tried.push((k, hypotheses::usual_mistakes(&exact, components)));
            }
        }
        let Some(count) = tried.first().map(|(_, all)| all.len()) else { continue };
        for h in 0..count {
            let common = common_factor(states, &tried, h);
            let fits = |k: usize, hypothesis: &hypotheses::Hypothesis| {
                let factor = match hypothesis.factor {
                    Factor::One => 1.0,
                    Factor::OfEachState => fitted(&states[k].modulus, &hypothesis.modulus),
                    Factor::OfAllStates => common,
                };
                let modulus = hypothesis.modulus.map(|row| row.map(|entry| factor * entry));
                let Some((differences, _)) = states[k].truth(convention, components) else { return false };
                let mistaken = compare(&states[k].modulus, &modulus, differences, components).worst;
                // The modulus of unloading is found a little beside the state.
                let (near, part) =
                    if hypothesis.kinds.contains(&"intact") { (2e-2, 0.1) } else { (5.0 * TOLERANCE, 1e-3) };
                let error = error_at(found, k);
                // What is little wrong says nothing for what is found only nearly.
                if error <= TOLERANCE.max(if part > 1e-2 { 5.0 * near } else { 0.0 }) {
                    mistaken <= near
                } else {
                    mistaken <= near.max(part * error).min(0.3 * error)
                }
            };
            // What unloads as it loads has no modulus of its own for that, and any factor of each state explains too much.
            let kept = tried.iter().all(|(k, all)| {
                let truth = states[*k].truth(convention, components);
                truth.is_none_or(|(sure, truth)| compare(&all[h].modulus, &truth, sure, components).worst < TWO_MODULI)
            });
            if kept && tried[0].1[h].kinds.contains(&"intact") {
                continue;
            }
            if common.is_nan() || (tried[0].1[h].factor == Factor::OfAllStates && (common - 1.0).abs() < 1e-3) {
                continue;
            }
            let explains = |these: &[usize]| {
                let mut tried = tried.iter().filter(|(k, _)| these.contains(k));
                tried.all(|(k, all)| fits(*k, &all[h]))
            };
            if explains(&wrong) {
                let mut text = tried[0].1[h].text.clone();
                if tried[0].1[h].factor == Factor::OfAllStates {
                    text = format!("{text} times {common:.4}");
                }
                names.push((tried[0].1[h].kinds.clone(), text, tried[0].1[h].factor, explains(&right)));
            }
        }
    }
    // What explains the right states too is the better explanation; and what needs fewer mistakes.
    let everywhere = names.iter().any(|(.., everywhere)| *everywhere);
    names.retain(|(.., holds)| *holds || !everywhere);
    let fewest = names.iter().map(|(kinds, ..)| kinds.len()).min().unwrap_or(0);
    names.retain(|(kinds, ..)| kinds.len() == fewest);
    // A mistake that needs no factor explains more than the same with one.
    let plain: Vec<Vec<&'static str>> =
        names.iter().filter(|named| named.2 == Factor::One).map(|(kinds, ..)| kinds.clone()).collect();
    names.retain(|(kinds, _, factor, _)| *factor == Factor::One || !plain.contains(kinds));
    let mut kinds: Vec<String> = Vec::new();
    for kind in names.iter().flat_map(|(kinds, ..)| kinds) {
        if !kinds.iter().any(|known| known == kind) {
            kinds.push(kind.to_string());
        }
    }
    if kinds.is_empty() {
        return (vec!["unknown".to_string()], "none of the usual mistakes".to_string());
    }
    let texts: Vec<String> = kinds
        .iter()
        .map(|kind| {
            let of_kind = names.iter().filter(|(kinds, ..)| kinds[0] == kind);
            let mut texts: Vec<&str> = of_kind.map(|(_, text, ..)| text.as_str()).collect();
            texts.dedup();
            match texts[..] {
                [] => kind.clone(),
                [ref said @ .., last] if texts.len() <= 2 => {
                    format!("{kind}: {}", [said, &[last]].concat().join(" or "))
                }
                [first, ..] => format!("{kind}: {first}, or {} others like it", texts.len() - 1),
            }
        })
        .collect();
    let branch = if everywhere { "" } else { ", in one branch" };
    (kinds, format!("{}{branch}", texts.join(", or ")))
}

fn error_at(found: &[Option<Difference>], k: usize) -> f64 {
    found[k].map_or(0.0, |difference| difference.worst)
}

/// The factor of one modulus that makes it most like the other.
fn fitted(modulus: &Modulus, like: &Modulus) -> f64 {
    let product =
        |a: &Modulus, b: &Modulus| a.iter().flatten().zip(b.iter().flatten()).map(|(x, y)| x * y).sum::<f64>();
    product(modulus, like) / product(like, like)
}

/// The same for all states.
fn common_factor(states: &[State], tried: &[(usize, Vec<hypotheses::Hypothesis>)], h: usize) -> f64 {
    let mut factors: Vec<f64> = tried.iter().map(|(k, all)| fitted(&states[*k].modulus, &all[h].modulus)).collect();
    if tried[0].1[h].factor != Factor::OfAllStates {
        return 1.0;
    }
    factors.sort_by(f64::total_cmp);
    factors[factors.len() / 2]
}

fn exact(session: &mut Session, state: &State, convention: Convention) -> Option<ExactTangent> {
    let components = session.material.components;
    let (_, truth) = state.truth(convention, components)?;
    let axes = if session.material.orientation { rotation_of(&state.f1) } else { Matrix3::identity() };
    let f = axes.transpose() * state.f1;
    let intact = intact(session, state, convention).into_iter().map(|modulus| modulus.unwrap_or([[f64::NAN; 6]; 6]));
    Some(ExactTangent {
        truth,
        jaumann: convention == Convention::Jaumann,
        stress: of_stress(&super::kinematics::tensor(&state.stress, components), components),
        f,
        intact: intact.collect(),
    })
}

/// Of the strain increment, what is taken back to unload.
const TAKEN_BACK: f64 = 0.02;
/// The strain that is taken back at least.
const LEAST_BACK: f64 = 2e-5;
/// Of the time step, what passes in no time.
const NO_TIME: f64 = 1e-9;

/// The moduli of unloading, and without time for the state to change.
fn intact(session: &mut Session, state: &State, convention: Convention) -> [Option<Modulus>; 2] {
    let answer = session.call_law(&state.call);
    let after = state.before.after(&state.f1, &state.call, &answer);
    let components = session.material.components;
    let whole = Increment::between(&state.before.f, &state.f1);
    // Differences need some room on this side of the kink.
    let part = TAKEN_BACK.max(LEAST_BACK / whole.strain.norm().max(LEAST_BACK)).min(0.5);
    let back = whole.at(1.0 - part, &state.before.f);
    let mut of = |f: &Matrix3<f64>, time: f64| {
        let mut call = after.call(f, session.material);
        call.time_step *= time;
        let differences = match convention {
            Convention::Jaumann => of_deformation(session, &after, &call, f),
            Convention::Plain | Convention::PlainWithVolume => of_strain_increment(session, &call),
        }?;
        let mut modulus = differences.value;
        if convention == Convention::PlainWithVolume {
            for (row, terms) in modulus.iter_mut().zip(stress_by_volume(&answer.stress, components)) {
                for (entry, term) in row.iter_mut().zip(terms) {
                    *entry += term;
                }
            }
        }
        Some(modulus)
    };
    [of(&back, 1.0), of(&state.f1, NO_TIME)]
}
