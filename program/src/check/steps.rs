//! Whether the answer depends on how an increment is divided.

use fastrand::Rng;
use nalgebra::Matrix3;

use super::call::Session;
use super::histories::history;
use super::kinematics::Increment;
use super::line::{Line, NOT_FINITE, Question, Verdict};
use super::point::{Failure, Point};

const HISTORIES: usize = 16;
/// Each increment in so many parts.
const PARTS: [usize; 5] = [1, 2, 4, 8, 16];
/// And where these tell no order: a threshold that is crossed within an increment makes differences uneven.
const MORE_PARTS: [usize; 2] = [32, 64];
/// Increments of a history.
const INCREMENTS: usize = 12;
/// Of the stress.
const SAME: f64 = 1e-8;
/// A last change of the stress that is none.
const SETTLED: f64 = 1e-3;
/// An order of convergence below this is none.
const LOWEST_ORDER: f64 = 0.5;

/// A path, the stress at its end with the most parts, and the largest on the way.
struct Ended {
    path: Vec<Matrix3<f64>>,
    stress: Matrix3<f64>,
    size: f64,
}

pub fn ask(session: &mut Session) -> Line {
    let mut rng = Rng::with_seed(session.material.seed ^ 0x57);
    let mut largest_change = 0.0_f64;
    let (mut coarse, mut fine, mut last) = (0.0, 0.0, 0.0);
    let mut paths = Vec::new();
    for _ in 0..HISTORIES {
        let mut path = history(&mut rng, session.material, 2);
        path.truncate(INCREMENTS);
        let mut ends = Vec::new();
        // Of all that is on the way: a path may end where there is next to no stress.
        let mut size = 0.0_f64;
        for parts in PARTS {
            match end(session, &path, parts) {
                Ok(Some((stress, largest))) => {
                    ends.push(stress);
                    size = size.max(largest);
                }
                Ok(None) => {}
                Err(text) => return Line::new(Question::Steps, Verdict::Wrong, None, text).with(NOT_FINITE),
            }
        }
        let [one, two, four, eight, sixteen] = ends[..] else { continue };
        if size == 0.0 {
            continue;
        }
        largest_change = largest_change.max((two - one).norm() / size);
        coarse += (two - one).norm() / size + (four - two).norm() / size;
        last = f64::max(last, (sixteen - eight).norm() / size);
        fine += (eight - four).norm() / size + (sixteen - eight).norm() / size;
        paths.push(Ended { path, stress: sixteen, size });
    }
    if paths.is_empty() {
        return Line::new(Question::Steps, Verdict::NotSure, None, "there was no stress");
    }
    if largest_change <= SAME {
        let text = "an increment in two gives the same stress";
        return Line::new(Question::Steps, Verdict::Right, Some(largest_change), text);
    }
    if session.material.traits.hyperelastic {
        let text = format!("an increment in two changes the stress by {largest_change:.2e} of itself");
        return Line::new(Question::Steps, Verdict::Wrong, Some(largest_change), text).with("path matters");
    }
    // Two halvings lie between the coarse differences and the fine ones.
    let mut order = 0.5 * (coarse / f64::max(fine, f64::MIN_POSITIVE)).log2();
    if order < LOWEST_ORDER && coarse > 1e-6 && last > SETTLED {
        match finer(session, &paths) {
            // Four halvings lie between.
            Ok(Some([finest, of_last])) => {
                order = 0.25 * (coarse / f64::max(finest, f64::MIN_POSITIVE)).log2();
                last = of_last;
            }
            Ok(None) => {}
            Err(text) => return Line::new(Question::Steps, Verdict::Wrong, None, text).with(NOT_FINITE),
        }
    }
    // Below the tolerance of a law's own iterations no order is seen.
    if order >= LOWEST_ORDER || coarse <= 1e-6 || last <= SETTLED {
        let text = format!("increments in two change the stress by up to {largest_change:.1e}; order {order:.1}");
        return Line::new(Question::Steps, Verdict::Right, Some(order), text);
    }
    let text =
        format!("finer increments change the stress by {largest_change:.1e}, and order {order:.1} is no convergence");
    Line::new(Question::Steps, Verdict::Warning, Some(order), text).with("no convergence")
}

/// The changes of the stress with more parts, their sum over all paths and the largest of the last; none where the law refuses all.
fn finer(session: &mut Session, paths: &[Ended]) -> Result<Option<[f64; 2]>, String> {
    let mut found = None;
    for Ended { path, stress, size } in paths {
        let [Some((more, _)), Some((most, _))] =
            [end(session, path, MORE_PARTS[0])?, end(session, path, MORE_PARTS[1])?]
        else {
            continue;
        };
        let [first, second] = [more - stress, most - more].map(|change| change.norm() / size);
        let [sum, last] = found.unwrap_or([0.0, 0.0]);
        found = Some([sum + first + second, f64::max(last, second)]);
    }
    Ok(found)
}

/// The stress at the end of the path and the largest on the way, each of its increments in so many parts.
fn end(session: &mut Session, path: &[Matrix3<f64>], parts: usize) -> Result<Option<(Matrix3<f64>, f64)>, String> {
    let mut point = Point::virgin(session, [1, 1]);
    let mut largest = 0.0_f64;
    for f1 in path {
        let begin = point.f;
        let increment = Increment::between(&begin, f1);
        for part in 1..=parts {
            let f = increment.at(part as f64 / parts as f64, &begin);
            match point.advance_in(session, &f, session.material.time_step / parts as f64) {
                Ok(_) => largest = largest.max(point.global_stress(session.material).norm()),
                Err(Failure::Refused) => return Ok(None),
                Err(Failure::NotFinite(_)) => return Err("not finite in divided increments".to_string()),
            }
        }
    }
    Ok(Some((point.global_stress(session.material), largest)))
}
