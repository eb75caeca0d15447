//! DDSDDT, which coupled analyses of temperature and displacement need, against differences of the stress.

use fastrand::Rng;

use super::call::{Call, Session};
use super::finding::{Finding, Question, Verdict};
use super::histories::history;
use super::kinematics::{Components, name};
use super::point::Point;

const HISTORIES: usize = 6;
/// Increments of a history, at most.
const INCREMENTS: usize = 20;
/// The step of temperature for differences, and the largest relative error of a derivative that is right.
const STEP: f64 = 0.1;
const TOLERANCE: f64 = 1e-3;
/// Between the differences of one step and of half of it: where they are sure.
const SURE: f64 = 1e-4;

pub fn thermal(session: &mut Session) -> Finding {
    let mut rng = Rng::with_seed(session.material.seed ^ 0x7e3);
    let line = |verdict, figure, text: String| Finding::new(Question::Thermal, verdict, figure, text);
    let (mut sure, mut depends, mut set) = (0, false, false);
    let mut worst: Option<(f64, String)> = None;
    for _ in 0..HISTORIES {
        let mut point = Point::undeformed(session, [1, 1]);
        for f1 in history(&mut rng, session.material, 2).iter().take(INCREMENTS) {
            let call = point.call(f1, session.material);
            let given = session.call_law(&call).by_temperature;
            set |= given.iter().any(|entry| *entry != 0.0);
            if let Some([coarse, fine]) = differences(session, &call) {
                let size = fine.iter().fold(0.0_f64, |size, entry| size.max(entry.abs()));
                depends |= size > 0.0;
                let apart = |a: &Components, b: &Components| {
                    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size.max(f64::MIN_POSITIVE)
                };
                if size > 0.0 && apart(&coarse, &fine) < SURE {
                    sure += 1;
                    let figure = apart(&given, &fine);
                    if worst.as_ref().is_none_or(|(worst, _)| figure > *worst) {
                        worst = Some((figure, at_worst(session, &given, &fine)));
                    }
                }
            }
            if point.advance(session, f1).is_err() {
                break;
            }
        }
    }
    match worst {
        _ if !depends => line(Verdict::NotAsked, None, "the temperature does not change the stress".to_string()),
        _ if !set => line(Verdict::NotReported, None, "DDSDDT is not set, which coupled analyses need".to_string()),
        None => line(Verdict::NotSure, None, "no state has sure differences".to_string()),
        Some((figure, _)) if figure <= TOLERANCE => {
            line(Verdict::Right, Some(figure), format!("DDSDDT is the derivative by DTEMP at {sure} states"))
        }
        Some((figure, text)) => line(Verdict::Wrong, Some(figure), text).with("DDSDDT"),
    }
}

/// ∂Δσ/∂ΔT by one step and by half of it; none where the law does not answer.
fn differences(session: &mut Session, call: &Call) -> Option<[Components; 2]> {
    let mut by = |step: f64| {
        let mut stress = |step: f64| {
            let mut call = call.clone();
            call.temperature_step += step;
            let answer = session.call_law(&call);
            (!answer.refused() && answer.finite()).then_some(answer.stress)
        };
        let (plus, minus) = (stress(step)?, stress(-step)?);
        Some(std::array::from_fn(|i| (plus[i] - minus[i]) / (2.0 * step)))
    };
    Some([by(STEP)?, by(0.5 * STEP)?])
}

fn at_worst(session: &Session, given: &Components, wanted: &Components) -> String {
    let apart = |i: &usize| (given[*i] - wanted[*i]).abs();
    let components = session.material.components;
    let i = (0..components).max_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap_or(0);
    format!(
        "DDSDDT is not the derivative of the stress by DTEMP: worst at {}, {:.5e} instead of {:.5e}",
        name(session.material.layout(), i),
        given[i],
        wanted[i]
    )
}
