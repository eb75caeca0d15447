//! A second step of a job: KSTEP = 2, KINC = 1 and TIME(1) = 0 begin again, the material does not.

use fastrand::Rng;
use nalgebra::Matrix3;

use super::call::{Answer, Session};
use super::finding::{Finding, Question, Verdict};
use super::histories::history;
use super::point::{Point, StepStart};

const HISTORIES: usize = 8;
/// Increments of either step, at most.
const INCREMENTS: usize = 15;
/// Of the stress or of a state variable: what rounding of the time may change.
const SAME: f64 = 1e-9;

/// What differs, and at how many histories.
#[derive(Default)]
struct Differences {
    count: usize,
    what: String,
}

pub fn job(session: &mut Session) -> Finding {
    let mut rng = Rng::with_seed(session.material.seed ^ 0x10b);
    let paths: Vec<Vec<Matrix3<f64>>> = (0..HISTORIES)
        .map(|_| history(&mut rng, session.material, 3).into_iter().take(2 * INCREMENTS).collect())
        .collect();
    let one: Vec<Vec<Answer>> = paths.iter().map(|path| answers(session, path, None)).collect();
    let asked = one.iter().filter(|answers| answers.len() > 2).count();
    let line = |verdict, text: String| Finding::new(Question::Job, verdict, None, text);
    if asked == 0 {
        return line(Verdict::NotSure, "there was no answer".to_string());
    }
    let tiny = 1e-9 * session.material.time_step;
    let mut of = |begun: StepStart| differences(session, &paths, &one, begun);
    let whole = StepStart { step: true, increment: true, time: Some(0.0) };
    let found = of(whole);
    if found.count == 0 {
        let text = format!("{asked} histories in two steps (KSTEP = 2, KINC = 1, TIME(1) = 0) as in one");
        return line(Verdict::Right, text);
    }
    let what = format!("{}, in {} of {asked} histories", found.what, found.count);
    if of(StepStart { step: false, ..whole }).count == 0 {
        let text = format!("the law asks for KSTEP: with 2 in a second step it has {what}");
        return line(Verdict::Warning, text).with("depends on the step");
    }
    if of(StepStart { time: None, ..whole }).count > 0 {
        let text = format!("KINC = 1 of a second step begins again what it should not: {what}");
        return line(Verdict::Wrong, text).with("second step");
    }
    // What asks whether TIME(1) is 0 takes any other for no beginning.
    if of(StepStart { time: Some(tiny), ..whole }).count == 0 {
        let text = format!("TIME(1) = 0 of a second step begins again what it should not: {what}");
        return line(Verdict::Wrong, text).with("second step");
    }
    let text = format!("the answer depends on TIME(1), which begins again in each step: a second one has {what}");
    line(Verdict::Warning, text).with("depends on the step")
}

/// The answers along a path, whose second half is a step of its own if that is said.
fn answers(session: &mut Session, path: &[Matrix3<f64>], begun: Option<StepStart>) -> Vec<Answer> {
    let mut point = Point::undeformed(session, [1, 1]);
    let mut all = Vec::new();
    for (k, f1) in path.iter().enumerate() {
        if let Some(begun) = begun.filter(|_| k == path.len() / 2) {
            point = point.next_step(begun);
        }
        let Ok(answer) = point.advance(session, f1) else { break };
        all.push(answer);
    }
    all
}

fn differences(
    session: &mut Session,
    paths: &[Vec<Matrix3<f64>>],
    one: &[Vec<Answer>],
    begun: StepStart,
) -> Differences {
    let mut found = Differences::default();
    for (path, one) in paths.iter().zip(one) {
        let two = answers(session, path, Some(begun));
        let what = one.iter().zip(&two).find_map(|(one, two)| different(one, two));
        let what = what.or_else(|| (one.len() != two.len()).then(|| "no answer".to_string()));
        if let Some(what) = what {
            found.count += 1;
            found.what = what;
        }
    }
    found
}

fn different(one: &Answer, two: &Answer) -> Option<String> {
    let far = |a: f64, b: f64, size: f64| (a - b).is_nan() || (a - b).abs() > SAME * size;
    let size = one.stress.iter().fold(0.0_f64, |size, stress| size.max(stress.abs()));
    if (0..6).any(|i| far(one.stress[i], two.stress[i], size)) {
        let change = one.stress.iter().zip(&two.stress).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        return Some(format!("another stress (by {:.1e} of itself)", change / size));
    }
    let i = (0..one.state.len()).find(|&i| far(one.state[i], two.state[i], one.state[i].abs().max(1e-12)))?;
    Some(format!("another STATEV({}) ({:.3e}, not {:.3e})", i + 1, two.state[i], one.state[i]))
}
