//! Whether the stress jumps: along one path its largest change in an increment has to shrink with the increments.

use std::time::{Duration, Instant};

use fastrand::Rng;
use nalgebra::Matrix3;

use super::call::Session;
use super::finding::{Finding, Question, Verdict};
use super::histories::direction;
use super::kinematics::exp;
use super::point::Point;

const PATHS: usize = 6;
const TIME: Duration = Duration::from_secs(10);
/// Increments of each of the three legs: out, back, and out again.
const INCREMENTS: [usize; 3] = [200, 800, 3200];
/// Time steps that a leg takes.
const OF_TIME: f64 = 25.0;
/// Where the way back ends.
const BACK: f64 = 0.3;
/// What a change keeps of itself, at least, with a quarter of the increment, and with a sixteenth of that, if it is a
/// jump: what is smooth keeps a quarter each time.
const KEPT: [f64; 2] = [0.6, 0.75];
/// Of the largest stress: what counts as a jump.
const LEAST: f64 = 3e-3;
/// Of the stiffness at rest: what is left after a jump, if that is no failure.
const INTACT: f64 = 0.95;
/// The strain of an unloading that asks for the stiffness.
const PROBE: f64 = 1e-6;
/// By what the time is longer in which a jump at a corner of the path is asked again, and what is left of it then, at
/// most, if its stress is viscous: the rate jumps there itself.
const SLOWER: f64 = 1e3;
const VISCOUS: f64 = 0.75;

/// The largest change in an increment of a path.
struct Largest {
    change: f64,
    /// Of the stress on the path.
    size: f64,
    /// How far along the path, and the point behind it.
    at: f64,
    /// Whether that is the first increment of a leg.
    at_corner: bool,
    after: Point,
}

/// The same path with ever smaller increments.
type Refined = [Option<Largest>; INCREMENTS.len()];

pub fn jumps(session: &mut Session) -> Finding {
    let started = Instant::now();
    let mut rng = Rng::with_seed(session.material.seed ^ 0x3a);
    let size = session.material.stretch.iter().map(|stretch| stretch.ln().abs()).fold(f64::INFINITY, f64::min);
    let (mut asked, mut failures) = (0, 0);
    for _ in 0..PATHS {
        let strain = direction(&mut rng, session.material) * size.max(1e-3);
        let mut found = refined(session, &strain, 1.0, started);
        let [Some(_), Some(_), Some(fine)] = &found else { continue };
        asked += 1;
        if fine.at_corner && jump(&found).is_some() {
            let change = fine.change;
            let slow = refined(session, &strain, SLOWER, Instant::now());
            let [.., Some(fine)] = &slow else { continue };
            if fine.change < VISCOUS * change {
                if fine.at_corner {
                    continue;
                }
                found = slow;
            }
        }
        let Some(fine) = jump(&found) else { continue };
        let undeformed = Point::undeformed(session, [1, 1]);
        let (Some(before), Some(after)) =
            (stiffness(session, &undeformed, &strain), stiffness(session, &fine.after, &strain))
        else {
            continue;
        };
        if after < INTACT * before {
            failures += 1;
            continue;
        }
        let text = format!(
            "the stress jumps by {:.2e} of itself in one increment, however small (at {:.0} % of a path out, back and out again), \
             and the stiffness stays",
            fine.change / fine.size,
            100.0 * fine.at
        );
        return Finding::new(Question::Jumps, Verdict::Wrong, Some(fine.change / fine.size), text).with("jump");
    }
    if asked == 0 {
        return Finding::new(
            Question::Jumps,
            Verdict::NotSure,
            None,
            "no path was finished in time, or there was no stress",
        );
    }
    let failing = if failures > 0 {
        format!("; in {failures} it falls with the stiffness, as in failure")
    } else {
        String::new()
    };
    let text = format!("changes of the stress shrink with the increments, on {asked} paths{failing}");
    Finding::new(Question::Jumps, Verdict::Right, None, text)
}

/// The path in so many times the time, with each of [`INCREMENTS`].
fn refined(session: &mut Session, strain: &Matrix3<f64>, slower: f64, started: Instant) -> Refined {
    INCREMENTS.map(|increments| {
        let time_step = session.material.time_step * slower * OF_TIME / increments as f64;
        largest(session, strain, (increments, time_step), started)
    })
}

/// The largest change with the smallest increments, if it is a jump.
fn jump([coarse, middle, fine]: &Refined) -> Option<&Largest> {
    let (coarse, middle, fine) = (coarse.as_ref()?, middle.as_ref()?, fine.as_ref()?);
    let stays = middle.change > KEPT[0] * coarse.change && fine.change > KEPT[1] * middle.change;
    (stays && fine.change >= LEAST * fine.size).then_some(fine)
}

/// None where the path is not finished or there is no stress.
fn largest(
    session: &mut Session,
    strain: &Matrix3<f64>,
    (increments, time_step): (usize, f64),
    started: Instant,
) -> Option<Largest> {
    let mut point = Point::undeformed(session, [1, 1]);
    let (mut stress, mut size) = (point.global_stress(session.material), 0.0_f64);
    let mut found: Option<(f64, usize, Point)> = None;
    for k in 1..=3 * increments {
        let part = (k % increments) as f64 / increments as f64;
        let part = match k.saturating_sub(1) / increments {
            0 => k as f64 / increments as f64,
            1 => 1.0 - (1.0 - BACK) * if k == 2 * increments { 1.0 } else { part },
            _ => BACK + (1.0 - BACK) * if k == 3 * increments { 1.0 } else { part },
        };
        if started.elapsed() > TIME {
            return None;
        }
        point.advance_in(session, &exp(&(strain * part)), time_step).ok()?;
        let next = point.global_stress(session.material);
        let change = (next - stress).norm();
        if found.as_ref().is_none_or(|(largest, ..)| change > *largest) {
            found = Some((change, k, point.clone()));
        }
        size = size.max(next.norm());
        stress = next;
    }
    let (change, k, after) = found?;
    let (at, at_corner) = (k as f64 / (3 * increments) as f64, k % increments == 1);
    (size > 0.0).then_some(Largest { change, size, at, at_corner, after })
}

/// The change of the stress over the strain of a small unloading, by two of them, so that a jump is in neither.
fn stiffness(session: &mut Session, point: &Point, strain: &Matrix3<f64>) -> Option<f64> {
    let mut stress = |size: f64| {
        let call = point.call(&(exp(&(strain * (-size / strain.norm()))) * point.f), session.material);
        let answer = session.call_law(&call);
        (!answer.refused() && answer.finite()).then_some(answer.stress)
    };
    let (one, two) = (stress(PROBE)?, stress(2.0 * PROBE)?);
    Some(one.iter().zip(&two).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt() / PROBE)
}
