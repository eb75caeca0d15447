//! In what way a tangent is wrong: which of the usual mistakes explain DDSDDE at the states where it is wrong.

use std::time::{Duration, Instant};

use nalgebra::Matrix3;

use super::call::Session;
use super::differences::{TOLERANCE, of_deformation, of_strain_increment};
use super::hypotheses::{ExactTangent, Factor, Hypothesis, sum, times, usual_mistakes};
use super::judgement::{Difference, compare};
use super::kinematics::{Increment, Modulus, of_stress, rotation_of, tensor};
use super::tangent::{Convention, State, add_volume_term};

/// How long mistakes are looked for.
const TIME: Duration = Duration::from_secs(10);
/// States on which mistakes are tried, of the wrong and of the right ones.
const TRIED: usize = 24;
/// Relative difference from which the modulus of unloading is another than that of loading.
const TWO_MODULI: f64 = 5e-2;

/// The states on which mistakes are tried.
pub struct Sample<'a> {
    states: &'a [State],
    components: usize,
    /// How wrong each state is.
    found: &'a [Option<Difference>],
    /// The wrong ones, the most wrong first, and the right ones.
    wrong: Vec<usize>,
    right: Vec<usize>,
}

/// The usual mistakes at each state that could be differentiated.
type Tried = Vec<(usize, Vec<Hypothesis>)>;

/// A mistake with which the modulus would be what it is at all wrong states.
struct Explanation {
    kinds: Vec<&'static str>,
    text: String,
    factor: Factor,
    /// Whether it would be so at the right states too.
    everywhere: bool,
}

/// A mistake that explains a part.
struct NearMistake {
    kind: &'static str,
    text: String,
    /// The largest error beside it.
    leaves: f64,
}

/// So many kinds at most are told together.
const MOST_KINDS: usize = 3;
/// Of the largest error, what a reading that is told leaves at most.
const BETTER: f64 = 0.3;
/// What the nearest mistake may leave of the error, at most.
const NEAR: f64 = 0.1;

/// As `1.2 %`.
pub fn percent(part: f64) -> String {
    match 100.0 * part {
        1e5.. => "more than 1000 times".to_string(),
        of @ 10.0.. => format!("{of:.0} %"),
        of @ 0.01.. => format!("{of:.2} %"),
        of => format!("{of:.0e} %"),
    }
}

/// The kinds of the mistakes that explain the wrong states, and a text for the report.
pub fn name(session: &mut Session, sample: &Sample, conventions: &[Convention]) -> (Vec<String>, String) {
    let unknown = |text: &str| (vec!["unknown".to_string()], text.to_string());
    let deadline = Instant::now() + TIME;
    let mut explanations: Vec<Explanation> = Vec::new();
    let mut nearest: Option<NearMistake> = None;
    for &convention in conventions {
        let Some(tried) = sample.tried(session, convention, deadline) else {
            return unknown("too slow a law to be asked in what way");
        };
        let count = tried.first().map_or(0, |(_, all)| all.len());
        explanations.extend((0..count).filter_map(|mistake| sample.explanation(&tried, mistake, convention)));
        let near = (0..count).filter_map(|mistake| sample.near(&tried, mistake, convention));
        nearest = nearest.into_iter().chain(near).min_by(|a, b| a.leaves.total_cmp(&b.leaves));
    }
    let everywhere = keep_simplest(&mut explanations);
    let mut kinds: Vec<String> = Vec::new();
    for kind in explanations.iter().flat_map(|explanation| &explanation.kinds) {
        if !kinds.iter().any(|known| known == kind) {
            kinds.push(kind.to_string());
        }
    }
    if kinds.len() > MOST_KINDS {
        return unknown("what the states do not tell apart: any of many mistakes");
    }
    if kinds.is_empty() {
        let Some(near) = nearest.filter(|near| near.leaves < NEAR * sample.largest_error()) else {
            return unknown("none of the usual mistakes");
        };
        let text = format!("nearest to {}: {}, which leaves {}", near.kind, near.text, percent(near.leaves));
        return (vec!["unknown".to_string(), near.kind.to_string()], text);
    }
    let texts: Vec<String> = kinds.iter().map(|kind| text_of_kind(kind, &explanations)).collect();
    let branch = if everywhere { "" } else { ", in one branch" };
    (kinds, format!("{}{branch}", texts.join(", or ")))
}

/// Drops what explains less, or needs more; returns whether what is kept holds at the right states too.
fn keep_simplest(explanations: &mut Vec<Explanation>) -> bool {
    // What explains the right states too is the better explanation; and what needs fewer mistakes.
    let everywhere = explanations.iter().any(|explanation| explanation.everywhere);
    explanations.retain(|explanation| explanation.everywhere || !everywhere);
    let fewest = explanations.iter().map(|explanation| explanation.kinds.len()).min().unwrap_or(0);
    explanations.retain(|explanation| explanation.kinds.len() == fewest);
    // A mistake that needs no factor explains more than the same with one.
    let without_factor = explanations.iter().filter(|explanation| explanation.factor == Factor::One);
    let plain: Vec<Vec<&'static str>> = without_factor.map(|explanation| explanation.kinds.clone()).collect();
    explanations.retain(|explanation| explanation.factor == Factor::One || !plain.contains(&explanation.kinds));
    everywhere
}

fn text_of_kind(kind: &str, explanations: &[Explanation]) -> String {
    let of_kind = explanations.iter().filter(|explanation| explanation.kinds[0] == kind);
    let mut texts: Vec<&str> = of_kind.map(|explanation| explanation.text.as_str()).collect();
    texts.dedup();
    match texts[..] {
        [] => kind.to_string(),
        [one] => format!("{kind}: {one}"),
        [one, other] => format!("{kind}: {one} or {other}"),
        [first, ..] => format!("{kind}: {first}, or {} others like it", texts.len() - 1),
    }
}

impl<'a> Sample<'a> {
    pub fn new(
        components: usize,
        states: &'a [State],
        found: &'a [Option<Difference>],
        wrong: &[usize],
        right: &[usize],
    ) -> Self {
        // The most wrong ones tell mistakes apart best.
        let mut wrong = wrong.to_vec();
        wrong.sort_by(|&a, &b| error_at(found, b).total_cmp(&error_at(found, a)));
        let spread = wrong.len().div_ceil(TRIED).max(1);
        let wrong: Vec<usize> = wrong.into_iter().step_by(spread).collect();
        let right: Vec<usize> = right.iter().copied().step_by(right.len().div_ceil(TRIED).max(1)).collect();
        Sample { states, components, found, wrong, right }
    }

    /// None where the law is too slow.
    fn tried(&self, session: &mut Session, convention: Convention, deadline: Instant) -> Option<Tried> {
        let mut tried = Vec::new();
        for &k in self.wrong.iter().chain(&self.right) {
            if Instant::now() > deadline {
                return None;
            }
            if let Some(exact) = exact_tangent(session, &self.states[k], convention) {
                tried.push((k, usual_mistakes(&exact, session.material.layout())));
            }
        }
        Some(tried)
    }

    /// The mistake of this number, if it explains the wrong states.
    fn explanation(&self, tried: &Tried, mistake: usize, convention: Convention) -> Option<Explanation> {
        let components = self.components;
        let Hypothesis { kinds, text, factor, .. } = &tried[0].1[mistake];
        let common = self.common_factor(tried, mistake);
        // A modulus of unloading that is that of loading is no other one, and any factor of each state explains too
        // much.
        let is_kept = tried.iter().all(|(k, all)| {
            let truth = self.states[*k].truth(convention, components);
            truth
                .is_none_or(|(sure, truth)| compare(&all[mistake].modulus, &truth, sure, components).worst < TWO_MODULI)
        });
        if is_kept && (kinds.contains(&"intact") || kinds.contains(&"relaxed")) {
            return None;
        }
        if common.is_nan() || (*factor == Factor::OfAllStates && (common - 1.0).abs() < 1e-3) {
            return None;
        }
        let explains = |these: &[usize]| {
            let mut tried = tried.iter().filter(|(k, _)| these.contains(k));
            tried.all(|(k, all)| self.fits(*k, &all[mistake], common, convention))
        };
        if !explains(&self.wrong) || !self.does_better(tried, mistake, common, convention) {
            return None;
        }
        let text = if *factor == Factor::OfAllStates { format!("{text} times {common:.4}") } else { text.clone() };
        Some(Explanation { kinds: kinds.clone(), text, factor: *factor, everywhere: explains(&self.right) })
    }

    /// How far the wrong states are from this mistake, at most.
    fn near(&self, tried: &Tried, mistake: usize, convention: Convention) -> Option<NearMistake> {
        let Hypothesis { kinds, text, factor, .. } = &tried[0].1[mistake];
        if *factor != Factor::One || is_of_other_increment(kinds) || kinds.len() > 1 {
            return None;
        }
        let mut leaves = 0.0_f64;
        for (k, all) in tried.iter().filter(|(k, _)| self.wrong.contains(k)) {
            let (differences, _) = self.states[*k].truth(convention, self.components)?;
            let mistaken = compare(&self.states[*k].modulus, &all[mistake].modulus, differences, self.components);
            leaves = leaves.max(if mistaken.worst.is_nan() { f64::INFINITY } else { mistaken.worst });
        }
        Some(NearMistake { kind: kinds[0], text: text.clone(), leaves })
    }

    fn largest_error(&self) -> f64 {
        self.wrong.iter().map(|&k| error_at(self.found, k)).fold(0.0, f64::max)
    }

    /// Whether the wrong states are in all nearer to this mistake than to the right modulus.
    fn does_better(&self, tried: &Tried, mistake: usize, common: f64, convention: Convention) -> bool {
        let wrong = tried.iter().filter(|(k, _)| self.wrong.contains(k));
        let mistaken = wrong.map(|(k, all)| self.mistaken(*k, &all[mistake], common, convention));
        mistaken.fold(0.0_f64, |worst, of| worst.max(if of.is_nan() { f64::INFINITY } else { of }))
            < BETTER * self.largest_error()
    }

    /// How far a state's modulus is from that of the mistake.
    fn mistaken(&self, k: usize, hypothesis: &Hypothesis, common: f64, convention: Convention) -> f64 {
        let components = self.components;
        let factor = match hypothesis.factor {
            Factor::One => 1.0,
            Factor::OfEachState => fitted(&self.states[k].modulus, &hypothesis.modulus),
            Factor::OfAllStates => common,
        };
        let modulus = hypothesis.modulus.map(|row| row.map(|entry| factor * entry));
        let Some((differences, _)) = self.states[k].truth(convention, components) else { return f64::INFINITY };
        compare(&self.states[k].modulus, &modulus, differences, components).worst
    }

    /// Whether a state's modulus is that of the mistake, much nearer than the right one.
    fn fits(&self, k: usize, hypothesis: &Hypothesis, common: f64, convention: Convention) -> bool {
        let mistaken = self.mistaken(k, hypothesis, common, convention);
        // The modulus of unloading is found a little beside the state.
        let (near, part) = if is_of_other_increment(&hypothesis.kinds) { (2e-2, 0.1) } else { (5.0 * TOLERANCE, 1e-3) };
        let error = error_at(self.found, k);
        // A state that is little wrong cannot tell what is found only nearly.
        if error <= TOLERANCE.max(if part > 1e-2 { 5.0 * near } else { 0.0 }) {
            mistaken <= near
        } else {
            mistaken <= near.max(part * error).min(0.3 * error)
        }
    }

    /// One factor for all states: the median of those that fit best.
    fn common_factor(&self, tried: &Tried, mistake: usize) -> f64 {
        if tried[0].1[mistake].factor != Factor::OfAllStates {
            return 1.0;
        }
        let factor = |(k, all): &(usize, Vec<Hypothesis>)| fitted(&self.states[*k].modulus, &all[mistake].modulus);
        let mut factors: Vec<f64> = tried.iter().map(factor).collect();
        factors.sort_by(f64::total_cmp);
        factors[factors.len() / 2]
    }
}

/// Whether it is a modulus that is found beside the state.
fn is_of_other_increment(kinds: &[&'static str]) -> bool {
    kinds.iter().any(|kind| ["intact", "continuum", "relaxed"].contains(kind))
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

/// What the usual mistakes are made of, at a state.
fn exact_tangent(session: &mut Session, state: &State, convention: Convention) -> Option<ExactTangent> {
    let components = session.material.components;
    let (_, truth) = state.truth(convention, components)?;
    let axes = if session.material.orientation { rotation_of(&state.f1) } else { Matrix3::identity() };
    let f = axes.transpose() * state.f1;
    let intact = intact(session, state, convention).into_iter().map(|modulus| modulus.unwrap_or([[f64::NAN; 6]; 6]));
    Some(ExactTangent {
        truth,
        jaumann: convention == Convention::Jaumann,
        stress: of_stress(&tensor(&state.stress, components), components),
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
const ALL_TIME: f64 = 1e6;

/// The moduli of unloading, without time for the state to change, of going on a little, and with all the time.
fn intact(session: &mut Session, state: &State, convention: Convention) -> [Option<Modulus>; 4] {
    let answer = session.call_law(&state.call);
    let after = state.before.after(&state.f1, &state.call, &answer);
    let components = session.material.components;
    let whole = Increment::between(&state.before.f, &state.f1);
    // Differences need some room on this side of the kink.
    let part = TAKEN_BACK.max(LEAST_BACK / whole.strain.norm().max(LEAST_BACK)).min(0.5);
    let back = whole.at(1.0 - part, &state.before.f);
    let little = LEAST_BACK / whole.strain.norm().max(LEAST_BACK);
    let onwards = [1.0, 2.0].map(|times| (whole.at(1.0 + times * little, &state.before.f), times * little));
    let mut of = |f: &Matrix3<f64>, time: f64| {
        let mut call = after.call(f, session.material);
        call.time_step *= time;
        let differences = match convention {
            Convention::Jaumann => of_deformation(session, &after, &call, f),
            Convention::Plain | Convention::PlainWithVolume => of_strain_increment(session, &call),
        }?;
        let mut modulus = differences.value;
        if convention == Convention::PlainWithVolume {
            add_volume_term(&mut modulus, &answer.stress, components);
        }
        Some(modulus)
    };
    // Of a vanishing increment, by two that are not.
    let [one, two] = onwards.map(|(f, time)| of(&f, time));
    let vanishing = one.zip(two).map(|(one, two)| sum(&times(&one, 2.0), &two, -1.0));
    [of(&back, 1.0), of(&state.f1, NO_TIME), vanishing, of(&state.f1, ALL_TIME)]
}
