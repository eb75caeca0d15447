//! Which properties change the answer: one that changes nothing is not read, or is shortened to a whole number.

use std::time::{Duration, Instant};

use fastrand::Rng;
use nalgebra::Matrix3;

use super::call::{Answer, Session};
use super::finding::{Finding, Question, Verdict};
use super::histories::history;
use super::point::Point;

const HISTORIES: usize = 6;
/// Increments of a history, at most.
const INCREMENTS: usize = 40;
const TIME: Duration = Duration::from_secs(6);
/// By what a property is changed, of itself.
const CHANGES: [f64; 2] = [1e-3, 0.1];

pub fn properties(session: &mut Session) -> Finding {
    let count = session.properties.len();
    let line = |verdict, text: String| Finding::new(Question::Properties, verdict, None, text);
    if count == 0 && session.material.fields.is_empty() {
        return line(Verdict::NotAsked, "there are no properties".to_string());
    }
    let mut rng = Rng::with_seed(session.material.seed ^ 0x9a);
    let paths: Vec<Vec<Matrix3<f64>>> = (0..HISTORIES).map(|_| history(&mut rng, session.material, 2)).collect();
    let given = session.properties.clone();
    let alone = answers(session, &paths);
    if alone.iter().all(Vec::is_empty) {
        return line(Verdict::NotSure, "there was no answer".to_string());
    }
    let mut idle = Vec::new();
    let started = Instant::now();
    for (index, &value) in given.iter().enumerate() {
        if started.elapsed() > TIME {
            return line(Verdict::NotSure, format!("too slow a law: {index} of {count} asked"));
        }
        let changed = CHANGES.iter().any(|change| {
            session.properties[index] = if value == 0.0 { *change } else { value * (1.0 + change) };
            let differs = differs(session, &paths, &alone);
            session.properties[index] = value;
            differs
        });
        if !changed {
            idle.push(index + 1);
        }
    }
    let of_fields = fields(session, &paths, &alone) + &idle_states(&session.material.initial, &alone);
    if idle.is_empty() {
        return line(Verdict::Right, format!("each of {count} changes the answer{of_fields}"));
    }
    let named: Vec<String> = idle.iter().take(SHOWN).map(|number| format!("PROPS({number})")).collect();
    let more = if idle.len() > SHOWN { format!(" and {} others", idle.len() - SHOWN) } else { String::new() };
    let text = format!(
        "{}{more} {} nothing, by a thousandth or a tenth of it: not read, or a part of the law that was not reached{of_fields}",
        named.join(", "),
        if idle.len() > 1 { "change" } else { "changes" }
    );
    // Flags, thresholds that are not reached and directions of any length are right.
    line(Verdict::Right, text).with("changes nothing")
}

/// The state variables that stay as they begin.
fn idle_states(initial: &[f64], alone: &[Vec<Answer>]) -> String {
    let stays = |i: &usize| alone.iter().flatten().all(|answer| answer.state[*i].to_bits() == initial[*i].to_bits());
    let idle: Vec<String> = (0..initial.len()).filter(stays).map(|i| (i + 1).to_string()).collect();
    match idle.len() {
        0 => String::new(),
        count if count == initial.len() => format!("; none of {count} state variables ever changes"),
        _ => format!("; STATEV of {} never changes", idle.join(", ")),
    }
}

/// Which fields change the answer, by PREDEF and by DPRED.
fn fields(session: &mut Session, paths: &[Vec<Matrix3<f64>>], alone: &[Vec<Answer>]) -> String {
    let given = session.fields;
    let mut text = String::new();
    for index in 0..session.material.fields.len() {
        let [value, increment] = [0, 1].map(|of| {
            CHANGES.iter().any(|change| {
                let [fields, _] = given;
                session.fields[of][index] += change * if fields[index] == 0.0 { 1.0 } else { fields[index] };
                let differs = differs(session, paths, alone);
                session.fields = given;
                differs
            })
        });
        let number = index + 1;
        text += &match (value, increment) {
            (true, true) => format!("; PREDEF({number}) and DPRED({number}) change it"),
            (true, false) => {
                format!("; PREDEF({number}) changes it, DPRED({number}) does not: the field before the increment")
            }
            (false, true) => format!("; DPRED({number}) changes it, PREDEF({number}) does not"),
            (false, false) => format!("; PREDEF({number}) changes nothing"),
        };
    }
    text
}

/// So many properties are named.
const SHOWN: usize = 6;

fn answers(session: &mut Session, paths: &[Vec<Matrix3<f64>>]) -> Vec<Vec<Answer>> {
    let mut all = Vec::new();
    for path in paths {
        let mut point = Point::undeformed(session, [1, 1]);
        all.push(path.iter().take(INCREMENTS).map_while(|f1| point.advance(session, f1).ok()).collect());
    }
    all
}

/// Whether any answer is another one.
fn differs(session: &mut Session, paths: &[Vec<Matrix3<f64>>], alone: &[Vec<Answer>]) -> bool {
    paths.iter().zip(alone).any(|(path, alone)| {
        let mut point = Point::undeformed(session, [1, 1]);
        let mut answers = path.iter().take(INCREMENTS).map_while(|f1| point.advance(session, f1).ok());
        alone.iter().any(|alone| answers.next().is_none_or(|found| !found.has_same_bits(alone)))
            || answers.next().is_some()
    })
}
