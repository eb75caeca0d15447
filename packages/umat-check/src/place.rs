//! Whether the answer depends on NOEL and NPT, as of laws with tables of fibres or random fields. Every other question
//! is asked at one element and point.

use fastrand::Rng;

use super::call::Session;
use super::finding::{Finding, Question, Verdict};
use super::histories::history;
use super::point::Point;

/// NOEL, NPT.
const PLACES: [[i32; 2]; 5] = [[1, 1], [1, 2], [2, 1], [3, 4], [7, 8]];
const HISTORIES: usize = 4;
/// Increments of a history, at most.
const INCREMENTS: usize = 30;

pub fn place(session: &mut Session) -> Finding {
    let mut rng = Rng::with_seed(session.material.seed ^ 0x91);
    let (mut compared, mut figure, mut counts) = (0, 0.0_f64, [false; 2]);
    for _ in 0..HISTORIES {
        let path = history(&mut rng, session.material, 2);
        let mut stresses = |place: [i32; 2]| -> Vec<_> {
            let mut point = Point::undeformed(session, place);
            let stress = |f1| point.advance(session, f1).ok().map(|answer| answer.stress);
            path.iter().take(INCREMENTS).map_while(stress).collect()
        };
        let first = stresses(PLACES[0]);
        let size = first.iter().flatten().fold(0.0_f64, |size, stress| size.max(stress.abs()));
        compared += first.len();
        for place in &PLACES[1..] {
            let other = stresses(*place);
            let pairs = first.iter().flatten().zip(other.iter().flatten());
            let change = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size.max(f64::MIN_POSITIVE);
            let changed = change > 0.0 || other.len() != first.len();
            counts[0] |= changed && place[0] != 1;
            counts[1] |= changed && place[0] == 1;
            figure = figure.max(change);
        }
    }
    place_finding(figure, compared, counts)
}

/// The line, of the largest change of the stress and of whether elements and points of one element have another answer.
pub fn place_finding(figure: f64, compared: usize, [elements, points]: [bool; 2]) -> Finding {
    if compared == 0 {
        return Finding::new(Question::Place, Verdict::NotSure, None, "there was no answer");
    }
    let by = match (elements, points) {
        (false, false) => {
            let text = "the same answer at every element and point";
            return Finding::new(Question::Place, Verdict::Right, None, text);
        }
        (true, false) => "NOEL",
        (false, true) => "NPT",
        (true, true) => "NOEL, NPT",
    };
    let text = format!(
        "the answer depends on {by} (a table, a random field): other elements or points change the stress by {figure:.1e} of \
         itself; every other line is of one element and point"
    );
    Finding::new(Question::Place, Verdict::Right, Some(figure), text).with("depends on the place")
}
