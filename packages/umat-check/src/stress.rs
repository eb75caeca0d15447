//! Whether there is stress in any state: a law without it answers every other question.

use fastrand::Rng;

use super::call::Session;
use super::finding::{Finding, Question, Verdict};
use super::histories::history;
use super::point::Point;

const HISTORIES: usize = 12;
/// Increments of a history, at most.
const INCREMENTS: usize = 60;

pub fn stress(session: &mut Session) -> Finding {
    let mut rng = Rng::with_seed(session.material.seed ^ 0x57e);
    let (mut answered, mut largest) = (0, 0.0_f64);
    for _ in 0..HISTORIES {
        let mut point = Point::undeformed(session, [1, 1]);
        let path = history(&mut rng, session.material, 2);
        for f1 in path.iter().take(INCREMENTS) {
            let Ok(answer) = point.advance(session, f1) else { break };
            answered += 1;
            largest = answer.stress.iter().fold(largest, |largest, stress| largest.max(stress.abs()));
        }
    }
    stress_finding(largest, answered)
}

/// The line, of the largest stress of so many increments.
pub fn stress_finding(largest: f64, increments: usize) -> Finding {
    if increments == 0 {
        return Finding::new(Question::Stress, Verdict::NotSure, None, "there was no answer");
    }
    if largest == 0.0 {
        let text = format!("no stress in any of {increments} increments: STRESS stays 0");
        return Finding::new(Question::Stress, Verdict::Wrong, None, text).with("no stress");
    }
    let text = format!("up to {largest:.3e} in {increments} increments");
    Finding::new(Question::Stress, Verdict::Right, None, text)
}
