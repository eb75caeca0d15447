//! DDSDDE against differences of the law's own stress, at many states.

use std::time::{Duration, Instant};

use fastrand::Rng;
use nalgebra::Matrix3;

use super::call::{Call, Session};
use super::differences::{Derivative, TOLERANCE, of_deformation, of_strain_increment, scale};
use super::finding::{Finding, NOT_FINITE, Question, Verdict};
use super::histories::history;
use super::hypotheses::stress_by_volume;
use super::judgement::{Difference, compare, contraction, wrong_entries};
use super::kinematics::{Components, Increment, Layout, Modulus, name};
use super::map::{self, Branch};
use super::material::{Material, Reads, direct};
use super::mistakes::{self, Sample};
use super::noise;
use super::point::{Failure, Point};

/// States that are asked at, if the time suffices.
const STATES: usize = 200;
const TIME: Duration = Duration::from_secs(10);
/// Histories, at most; each gives some states.
const HISTORIES: usize = 60;

/// Of DTIME, in turn: what is divided by it is wrong for 1 alone, or right.
const TIME_STEPS: [f64; 3] = [1.0, 0.4, 1.7];

/// The kind of a tangent that is wrong at some.
pub const FEW_STATES: &str = "few states";
/// So many wrong states of at least [`MANY`] times as many are a warning.
const FEW: usize = 2;
const MANY: usize = 25;

/// Of the stress, what is left of a product that is the stress.
const SECANT: f64 = 1e-6;

/// The kind of a law that is written for another order.
pub const EXCHANGED: &str = "13 and 23 exchanged";

/// What DDSDDE may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Convention {
    /// The Jaumann rate of the Kirchhoff stress over J.
    Jaumann,
    /// The plain ∂Δσ/∂Δε.
    Plain,
    /// The same with σ⊗I, which makes it that of the Kirchhoff stress over J.
    PlainWithVolume,
}

impl Convention {
    fn of(reads: Reads, material: &Material) -> &'static [Convention] {
        use Convention::{Jaumann, Plain, PlainWithVolume};
        let components = material.components;
        match reads {
            _ if material.separation.is_some() => &[Plain],
            // Where there is no strain across the law alone knows the thickness, and so J.
            _ if components <= 3 => &[Plain, PlainWithVolume],
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

/// An increment at whose end DDSDDE is compared with differences.
pub struct State {
    name: String,
    pub before: Point,
    pub call: Call,
    pub f1: Matrix3<f64>,
    pub stress: Components,
    pub modulus: Modulus,
    jaumann: Option<Derivative>,
    plain: Option<Derivative>,
}

impl State {
    /// Whether DDSDDE times the strain is the stress.
    fn is_secant(&self, components: usize) -> bool {
        let largest = self.stress.iter().fold(0.0_f64, |largest, stress| largest.max(stress.abs()));
        largest > 0.0
            && (0..components).all(|i| {
                let strains = self.call.strain.iter().zip(&self.call.strain_increment).map(|(a, b)| a + b);
                let product: f64 = strains.zip(&self.modulus[i]).map(|(strain, entry)| strain * entry).sum();
                (product - self.stress[i]).abs() < SECANT * largest
            })
    }

    /// Whether there is stress that nothing in the increment changes.
    fn lags(&self, convention: Convention, components: usize) -> bool {
        let changes = self.truth(convention, components).is_none_or(|(sure, _)| sure.value != [[0.0; 6]; 6]);
        !changes && self.modulus != [[0.0; 6]; 6]
    }

    /// The differences, and what DDSDDE should be.
    pub fn truth(&self, convention: Convention, components: usize) -> Option<(&Derivative, Modulus)> {
        let differences = match convention {
            Convention::Jaumann => self.jaumann.as_ref()?,
            Convention::Plain | Convention::PlainWithVolume => self.plain.as_ref()?,
        };
        let mut truth = differences.value;
        if convention == Convention::PlainWithVolume {
            add_volume_term(&mut truth, &self.stress, components);
        }
        Some((differences, truth))
    }
}

/// Adds σ⊗I.
pub fn add_volume_term(modulus: &mut Modulus, stress: &Components, components: usize) {
    for (row, terms) in modulus.iter_mut().zip(stress_by_volume(stress, components)) {
        for (entry, term) in row.iter_mut().zip(terms) {
            *entry += term;
        }
    }
}

/// DDSDDE against derivatives of the stress. Where it is wrong in no known way, the question is repeated with 13 and 23
/// exchanged.
pub fn tangent(session: &mut Session, reads: Reads, allowed: Option<f64>) -> Finding {
    let started = Instant::now();
    let mut line = tangent_in_order(session, reads, allowed);
    let unknown = line.kinds.first().is_some_and(|kind| kind == "unknown");
    // As long again must not be too long.
    if session.material.components == 6 && unknown && started.elapsed() < TIME {
        session.exchange(true);
        let exchanged = tangent_in_order(session, reads, allowed);
        session.exchange(false);
        // Of an isotropic law both readings are alike: one that explains no more is none, and one that undoes itself.
        let undone = exchanged.kinds.iter().any(|kind| kind == EXCHANGED || kind == "unknown");
        let better = exchanged.figure.unwrap_or(f64::INFINITY) < 0.5 * line.figure.unwrap_or(0.0);
        let right = exchanged.verdict == Verdict::Right;
        if right || (exchanged.verdict == Verdict::Wrong && !undone && better) {
            line.kinds = vec![EXCHANGED.to_string()];
            line.kinds.extend(exchanged.kinds);
            let text = if right { line.text } else { exchanged.text };
            line.text = format!("{EXCHANGED} in STRESS and DDSDDE (the order is 11 22 33 12 13 23): {text}");
        }
    }
    line
}

fn tangent_in_order(session: &mut Session, reads: Reads, allowed: Option<f64>) -> Finding {
    let not_sure = |text: &str| Finding::new(Question::Tangent, Verdict::NotSure, None, text);
    let components = session.material.components;
    session.coarse = false;
    let (mut states, broken) = match gather(session, reads) {
        Ok(gathered) => gathered,
        Err(line) => return *line,
    };
    if broken && states.is_empty() {
        return not_sure("the law asks for smaller increments at every state");
    }
    let conventions = Convention::of(reads, session.material);
    let Some((mut convention, mut found)) = best_convention(&states, conventions, components) else {
        return Finding::new(Question::Tangent, Verdict::NotAsked, None, "");
    };
    if without_stress(&states, convention, components) {
        return not_sure("there was no stress");
    }
    let steps = noise::steps(session, &states, |state| Some(state.truth(convention, components)?.1));
    if steps.is_some() {
        // Differences of small steps would be those of the noise.
        session.coarse = true;
        for state in &mut states {
            let (jaumann, plain) = derivatives(session, &state.before, &state.call, &state.f1, reads);
            state.jaumann = without_column_33(session, jaumann, &state.modulus);
            state.plain = without_column_33(session, plain, &state.modulus);
        }
        if let Some(again) = best_convention(&states, conventions, components) {
            (convention, found) = again;
        }
    }
    let Some((_, difference)) = worst(&found) else {
        return not_sure("no state has sure differences");
    };
    let (unsure, aside) = without_sure_differences(&states, &found);
    let layout = session.material.layout();
    let judged = Judged { states: &states, found: &found, convention, components, layout };
    let within = steps.is_some_and(|steps| judged.largest_error() < OF_STEPS * steps);
    if difference.worst <= TOLERANCE || within {
        let text = format!("{} at {} states{aside}", convention.name(), states.len());
        // Sure of nothing is not right.
        let verdict = if unsure * 2 > states.len() { Verdict::NotSure } else { Verdict::Right };
        let line = Finding::new(Question::Tangent, verdict, Some(difference.worst), text);
        let line = without_unsymm(session, &states, line);
        return steps.map_or(line.clone(), |steps| in_steps(line, steps));
    }
    wrong_tangent(session, &judged, conventions, allowed.unwrap_or(TOLERANCE), &aside)
}

/// A warning where DDSDDE is not symmetric and the input of Abaqus has no UNSYMM, without which half of it is lost.
fn without_unsymm(session: &Session, states: &[State], line: Finding) -> Finding {
    if session.material.unsymmetric != Some(false) {
        return line;
    }
    let skew = |state: &State| {
        let largest = state.modulus.iter().flatten().fold(f64::MIN_POSITIVE, |largest, entry| largest.max(entry.abs()));
        let pairs = (0..6).flat_map(|i| (0..i).map(move |j| (i, j)));
        pairs.map(|(i, j)| (state.modulus[i][j] - state.modulus[j][i]).abs()).fold(0.0, f64::max) / largest
    };
    let skew = states.iter().map(skew).fold(0.0, f64::max);
    if skew <= SYMMETRIC {
        return line;
    }
    let text =
        format!("{}; it is unsymmetric by {}, and *USER MATERIAL has no UNSYMM", line.text, mistakes::percent(skew));
    Finding { verdict: Verdict::Warning, text, ..line }.with("without UNSYMM")
}

/// Of the largest entry: what is symmetric.
const SYMMETRIC: f64 = 1e-3;

/// Whether neither stress nor its derivatives are anything but 0.
fn without_stress(states: &[State], convention: Convention, components: usize) -> bool {
    states.iter().all(|state| {
        let truth = state.truth(convention, components).map_or([[0.0; 6]; 6], |(_, truth)| truth);
        state.stress.iter().chain(truth.iter().flatten()).all(|number| *number == 0.0)
    })
}

/// The states, how wrong each is by the convention that suits best, and that convention.
struct Judged<'a> {
    states: &'a [State],
    found: &'a [Option<Difference>],
    convention: Convention,
    components: usize,
    layout: Layout,
}

/// Of the stiffness, what differences err by at most for steps of the stress of one part of it.
const OF_STEPS: f64 = 1e4;

/// The line where the stress moves in steps of this part of the stiffness.
fn in_steps(line: Finding, steps: f64) -> Finding {
    let text = format!(
        "the stress moves in steps of {steps:.1e} of the stiffness, by which differences cannot be sharper: {}",
        line.text
    );
    Finding { text, ..line }.with(noise::NOISE)
}

impl Judged<'_> {
    /// The largest error of an entry over the largest entry.
    fn largest_error(&self) -> f64 {
        let errors = self.states.iter().zip(self.found).filter_map(|(state, found)| {
            let (i, j) = (*found)?.place;
            let (_, truth) = state.truth(self.convention, self.components)?;
            let stiffness = truth.iter().flatten().fold(f64::MIN_POSITIVE, |largest, entry| largest.max(entry.abs()));
            Some((state.modulus[i][j] - truth[i][j]).abs() / stiffness)
        });
        errors.fold(0.0, f64::max)
    }

    /// The largest errors of the entries, drawn by branch.
    fn map(&self) -> Vec<String> {
        let mut branches: Vec<Branch> = Vec::new();
        for state in self.states {
            let Some((differences, truth)) = state.truth(self.convention, self.components) else { continue };
            let at = branches.iter().position(|branch| branch.name == state.name).unwrap_or_else(|| {
                branches.push(Branch { name: &state.name, errors: [[0.0; 6]; 6] });
                branches.len() - 1
            });
            let scale = scale(&differences.value, self.components);
            for (i, j) in wrong_entries(&state.modulus, &truth, differences, self.components) {
                let error = (state.modulus[i][j] - truth[i][j]).abs() / scale[i][j];
                branches[at].errors[i][j] = branches[at].errors[i][j].max(error);
            }
        }
        map::drawn(&branches, self.components)
    }

    /// The entries that are wrong at some state.
    fn entries(&self) -> Vec<(usize, usize)> {
        let mut all: Vec<(usize, usize)> = Vec::new();
        for state in self.states {
            let Some((differences, truth)) = state.truth(self.convention, self.components) else { continue };
            for place in wrong_entries(&state.modulus, &truth, differences, self.components) {
                if !all.contains(&place) {
                    all.push(place);
                }
            }
        }
        all.sort_unstable();
        all
    }

    /// These entries in words.
    fn named(&self, all: &[(usize, usize)]) -> String {
        let direct = direct(self.components);
        let named = |(i, j): &(usize, usize)| format!("({}, {})", name(self.layout, *i), name(self.layout, *j));
        match all {
            [] => String::new(),
            few if few.len() <= 4 => format!("in {} alone", few.iter().map(named).collect::<Vec<_>>().join(", ")),
            _ if !self.layout.traction && all.iter().all(|&(i, j)| i < direct && j < direct) => {
                let names = (0..direct).map(|i| name(self.layout, i)).collect::<Vec<_>>();
                format!("in {} alone", names.join(", "))
            }
            _ if all.iter().all(|&(i, j)| i >= direct && j >= direct) => "in shears by shears alone".to_string(),
            _ => format!("in {} of {} entries", all.len(), self.components.pow(2)),
        }
    }
}

/// The convention by which the fewest states are wrong, and how wrong each is by it.
fn best_convention(
    states: &[State],
    conventions: &[Convention],
    components: usize,
) -> Option<(Convention, Vec<Option<Difference>>)> {
    let judged = |convention: &Convention| {
        let found = states.iter().map(|state| {
            let (differences, truth) = state.truth(*convention, components)?;
            Some(compare(&state.modulus, &truth, differences, components))
        });
        found.collect::<Vec<Option<Difference>>>()
    };
    let by_convention = conventions.iter().map(|convention| (*convention, judged(convention)));
    let rank = |found: &[Option<Difference>]| {
        let wrong = found.iter().flatten().filter(|difference| difference.worst > TOLERANCE).count();
        (wrong, worst(found).map_or(0.0, |(_, difference)| difference.worst))
    };
    by_convention.min_by(|a, b| rank(&a.1).partial_cmp(&rank(&b.1)).unwrap_or(std::cmp::Ordering::Equal))
}

/// How many states are in part without sure differences, and that in words.
fn without_sure_differences(states: &[State], found: &[Option<Difference>]) -> (usize, String) {
    let unsure = found.iter().filter(|found| found.is_none_or(|found| found.unsure > 0)).count();
    let kinks = states.iter().filter(|state| {
        let differences = state.jaumann.iter().chain(&state.plain);
        differences.into_iter().any(|differences| differences.kinks.iter().flatten().any(|kink| *kink))
    });
    let text = match (unsure, kinks.count()) {
        (0, _) => String::new(),
        (unsure, 0) => format!("; {unsure} states in part without sure differences"),
        (unsure, kinks) => format!("; {unsure} states in part without sure differences, {kinks} of them at kinks"),
    };
    (unsure, text)
}

/// The finding where DDSDDE is wrong at some state: in what way, where, and what that does to Newton's method.
fn wrong_tangent(
    session: &mut Session,
    judged: &Judged,
    conventions: &[Convention],
    tolerance: f64,
    aside: &str,
) -> Finding {
    let &Judged { states, found, convention, components, layout } = judged;
    let those = |is_wrong: bool| {
        let judged = |k: &usize| found[*k].is_some_and(|difference| (difference.worst > TOLERANCE) == is_wrong);
        (0..states.len()).filter(judged).collect::<Vec<usize>>()
    };
    let (wrong, right) = (those(true), those(false));
    let (at, difference) = worst(found).unwrap_or_default();
    let (i, j) = difference.place;
    let place = format!("({}, {})", name(layout, i), name(layout, j));
    let unit = session.material.unit_of_strain();
    let instead = states[at].truth(convention, components).map_or(f64::NAN, |(_, truth)| truth[i][j]) / unit;
    let is = states[at].modulus[i][j] / unit;
    let factor = wrong.iter().filter_map(|&k| {
        let (_, truth) = states[k].truth(convention, components)?;
        contraction(&states[k].modulus, &truth, components)
    });
    let slows = convergence(factor.fold(0.0, f64::max));
    let few = wrong.len() <= FEW && states.len() >= MANY * FEW;
    let (kinds, way) = in_what_way(session, judged, few, (&wrong, &right), conventions);
    let where_ = states_named(states, &wrong);
    let all = judged.entries();
    let entries = judged.named(&all);
    // Where nothing should be there is no measure.
    let size = match difference.worst.is_finite() {
        true if difference.worst > NO_MEASURE => "wrong by more than 1000 times the stiffness".to_string(),
        true => format!("wrong by up to {}", mistakes::percent(difference.worst)),
        false => "wrong".to_string(),
    };
    let growth = growth(states, found);
    let text = format!(
        "{way}; {size} {entries}{growth} at {} of {} states ({where_}), worst at {place} {}, {is:.5e} instead of {instead:.5e}; {slows}{aside}",
        wrong.len(),
        states.len(),
        states[at].name,
    );
    // Whether elements have a strain 33 is not known.
    let across = components == 4 && session.material.plane.is_none() && all.iter().all(|&(_, j)| j == 2);
    let text = if across {
        format!("right in plane strain; of axisymmetric elements (plane = \"axisymmetric\") it would be wrong: {text}")
    } else {
        text
    };
    let verdict = if few || across || difference.worst <= tolerance { Verdict::Warning } else { Verdict::Wrong };
    let mut finding = Finding::new(Question::Tangent, verdict, Some(difference.worst), text);
    finding.kinds = kinds;
    finding.map = judged.map();
    finding.call_bits = Some(states[at].call.numbers().into_iter().map(f64::to_bits).collect());
    finding
}

/// In what way DDSDDE is wrong: kinds, and a text.
fn in_what_way(
    session: &mut Session,
    judged: &Judged,
    few: bool,
    (wrong, right): (&[usize], &[usize]),
    conventions: &[Convention],
) -> (Vec<String>, String) {
    let &Judged { states, found, convention, components, .. } = judged;
    let of = |kind: &str, text: &str| (vec![kind.to_string()], text.to_string());
    if wrong.iter().all(|&k| states[k].lags(convention, components)) {
        let text = "the stress does not change with the increment: is it that of STRAN or DFGRD0, at its beginning?";
        return of("lagging", text);
    }
    if few {
        return of(FEW_STATES, "in few states alone, perhaps at kinks that are not seen");
    }
    let (kinds, way) = mistakes::name(session, &Sample::new(components, states, found, wrong, right), conventions);
    if kinds[..] == ["unknown"] && wrong.iter().all(|&k| states[k].is_secant(components)) {
        return of("secant", "secant: DDSDDE times the strain is the stress, without the derivative of the damage");
    }
    (kinds, way)
}

/// How the error goes with the strain, where that can be said: at rest, and at the smaller and the larger strains.
fn growth(states: &[State], found: &[Option<Difference>]) -> &'static str {
    let strain = |state: &State| Increment::between(&Matrix3::identity(), &state.f1).strain.norm();
    let mut all: Vec<(f64, f64)> =
        states.iter().zip(found).filter_map(|(state, found)| Some((strain(state), (*found)?.worst))).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let third = all.len() / 3;
    let largest = |part: &[(f64, f64)]| part.iter().map(|(_, error)| *error).fold(0.0, f64::max);
    let Some((_, at_rest)) = all.first().filter(|(strain, _)| *strain < 1e-12 && third > 3) else { return "" };
    let (small, large) = (largest(&all[..third]), largest(&all[all.len() - third..]));
    match (*at_rest <= TOLERANCE, small < 0.4 * large) {
        (true, true) => ", right at rest, growing with the strain,",
        (true, false) => ", right at rest,",
        (false, _) => ", at rest too,",
    }
}

/// Figures beyond this say no more.
const NO_MEASURE: f64 = 1e3;

fn convergence(factor: f64) -> String {
    if factor > NO_MEASURE {
        let text = "Newton's method may diverge: it multiplies an error by more than 1000, as where DDSDDE is next to singular";
        return text.to_string();
    }
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
    let rest = Point::undeformed(session, [1, 1]);
    let identity = Matrix3::identity();
    let time_step = session.material.time_step;
    match state(session, &rest, &identity, time_step, (reads, "at rest")) {
        Ok(state) => states.push(state),
        Err(failure) => broken |= refused(failure)?,
    }
    'histories: for number in 0..HISTORIES {
        let mut point = Point::undeformed(session, [1, 1]);
        let time_step = session.material.time_step * TIME_STEPS[number % TIME_STEPS.len()];
        let path = history(&mut rng, session.material, 3);
        let asked = [rng.usize(0..path.len()), rng.usize(0..path.len()), path.len() - 1, 0];
        for (k, f1) in path.iter().enumerate() {
            if started.elapsed() > TIME {
                break 'histories;
            }
            if asked.contains(&k) && !(k == 0 && number % 4 > 0) {
                let name = kind_of(&point, f1);
                match state(session, &point, f1, time_step, (reads, name)) {
                    Ok(state) => states.push(state),
                    Err(failure) => broken |= refused(failure)?,
                }
                if states.len() >= STATES {
                    break 'histories;
                }
            }
            if let Err(failure) = point.advance_in(session, f1, time_step) {
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

fn state(
    session: &mut Session,
    before: &Point,
    f1: &Matrix3<f64>,
    time_step: f64,
    (reads, name): (Reads, &str),
) -> Result<State, Failure> {
    let mut call = before.call(f1, session.material);
    call.time_step = time_step;
    let answer = session.call_law(&call);
    if answer.refused() {
        return Err(Failure::Refused);
    }
    if !answer.finite() {
        return Err(Failure::NotFinite(Box::new(call)));
    }
    let (jaumann, plain) = derivatives(session, before, &call, f1, reads);
    let [jaumann, plain] = [jaumann, plain].map(|known| without_column_33(session, known, &answer.modulus));
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

/// In plane strain nothing is known of the column 33, nor asked: it is what DDSDDE has.
fn without_column_33(session: &Session, known: Option<Derivative>, modulus: &Modulus) -> Option<Derivative> {
    let mut known = known?;
    if session.material.is_plane_strain() {
        for (i, row) in modulus.iter().enumerate() {
            (known.value[i][2], known.error[i][2], known.kinks[i][2]) = (row[2], 0.0, false);
        }
    }
    Some(known)
}

fn derivatives(
    session: &mut Session,
    before: &Point,
    call: &Call,
    f1: &Matrix3<f64>,
    reads: Reads,
) -> (Option<Derivative>, Option<Derivative>) {
    let conventions = Convention::of(reads, session.material);
    let jaumann = conventions.contains(&Convention::Jaumann);
    let plain = conventions.contains(&Convention::Plain);
    (
        jaumann.then(|| of_deformation(session, before, call, f1)).flatten(),
        plain.then(|| of_strain_increment(session, call)).flatten(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_that_say_no_more_are_not_given() {
        assert!(convergence(1.2e16).contains("more than 1000"));
        assert!(convergence(12.0).contains("up to 12.00"));
        assert_eq!(mistakes::percent(5.36e6), "more than 1000 times");
        assert_eq!(mistakes::percent(5.0), "500 %");
    }
}
