//! Whether the answer depends on how an increment is divided.

use std::time::{Duration, Instant};

use fastrand::Rng;
use nalgebra::Matrix3;

use super::call::Session;
use super::finding::{Finding, NOT_FINITE, Question, Verdict};
use super::histories::history;
use super::kinematics::Increment;
use super::point::{Failure, Point};

const HISTORIES: usize = 16;
/// Each increment in so many parts.
const PARTS: [usize; 5] = [1, 2, 4, 8, 16];
/// Where these tell no order: a threshold that is crossed within an increment makes differences uneven, and a law that
/// relaxes faster than the time passes shows none before parts are shorter than its relaxation.
const MOST_PARTS: usize = 4096;
const LONGEST: Duration = Duration::from_secs(6);
/// Increments of a history.
const INCREMENTS: usize = 12;
/// The kind whose figure is an order.
pub const NO_CONVERGENCE: &str = "no convergence";
/// Of the stress.
const SAME: f64 = 1e-8;
/// A last change of the stress that is none.
const SETTLED: f64 = 1e-3;
/// An order of convergence below this is none.
const LOWEST_ORDER: f64 = 0.5;

/// What half the increment leaves of a stress that is of the increment alone, at most; and of which part of the whole
/// stress it is asked.
const ALONE: f64 = 0.55;
const LEAST_PART: f64 = 1e-3;
/// The order of what grows as the increments shrink.
const DIVERGES: f64 = -0.5;

/// Deviator and pressure, each with three halvings of the increment, and the whole stress, over many histories.
#[derive(Default)]
pub struct Shares {
    parts: [[f64; 3]; 2],
    whole: f64,
}

impl Shares {
    pub fn add(&mut self, halvings: [&Matrix3<f64>; 3], whole: f64) {
        self.whole += whole;
        for (k, stress) in halvings.into_iter().enumerate() {
            let pressure = Matrix3::identity() * (stress.trace() / 3.0);
            self.parts[0][k] += (stress - pressure).norm();
            self.parts[1][k] += pressure.norm();
        }
    }

    /// The line where a part of the stress halves with the increment, again and again.
    pub fn not_added_up(&self) -> Option<Finding> {
        let shrinks = |[one, half, quarter]: &[f64; 3]| {
            *one > LEAST_PART * self.whole && *half < ALONE * one && *quarter < ALONE * half
        };
        let part = ["the deviator of the stress", "the pressure"][self.parts.iter().position(shrinks)?];
        let text =
            format!("{part} is that of the increment alone, and not added up: with half the increment it is half");
        Some(Finding::new(Question::Steps, Verdict::Wrong, None, text).with("not accumulated"))
    }
}

/// A path, the stress at its end with the most parts and the largest on the way, and the last change of the first over
/// the second.
struct PathEnd {
    path: Vec<Matrix3<f64>>,
    stress: Matrix3<f64>,
    size: f64,
    change: f64,
}

pub fn steps(session: &mut Session) -> Finding {
    let mut rng = Rng::with_seed(session.material.seed ^ 0x57);
    let mut largest_change = 0.0_f64;
    let (mut coarse, mut fine, mut last) = (0.0, 0.0, 0.0);
    let (mut compared, mut worst) = (0, None::<PathEnd>);
    let mut shares = Shares::default();
    for _ in 0..HISTORIES {
        let mut path = history(&mut rng, session.material, 2);
        path.truncate(INCREMENTS);
        let (ends, size) = match end_stresses(session, &path) {
            Ok(found) => found,
            Err(text) => return Finding::new(Question::Steps, Verdict::Wrong, None, text).with(NOT_FINITE),
        };
        let [one, two, four, eight, sixteen] = ends[..] else { continue };
        if size == 0.0 {
            continue;
        }
        largest_change = largest_change.max((two - one).norm() / size);
        shares.add([&four, &eight, &sixteen], size);
        coarse += (two - one).norm() / size + (four - two).norm() / size;
        last = f64::max(last, (sixteen - eight).norm() / size);
        fine += (eight - four).norm() / size + (sixteen - eight).norm() / size;
        compared += 1;
        let change = (sixteen - eight).norm() / size;
        if worst.as_ref().is_none_or(|worst| worst.change < change) {
            worst = Some(PathEnd { path, stress: sixteen, size, change });
        }
    }
    if compared == 0 {
        return Finding::new(Question::Steps, Verdict::NotSure, None, "there was no stress");
    }
    if let Some(line) = shares.not_added_up() {
        return line;
    }
    if largest_change <= SAME {
        let text = "an increment in two gives the same stress";
        return Finding::new(Question::Steps, Verdict::Right, Some(largest_change), text);
    }
    if session.material.traits.hyperelastic {
        let text = format!("an increment in two changes the stress by {largest_change:.2e} of itself");
        return Finding::new(Question::Steps, Verdict::Wrong, Some(largest_change), text).with("path matters");
    }
    // Two halvings lie between the coarse differences and the fine ones.
    let mut order = 0.5 * (coarse / f64::max(fine, f64::MIN_POSITIVE)).log2();
    if order < LOWEST_ORDER && coarse > 1e-6 && last > SETTLED {
        match worst.map_or(Ok(None), |worst| convergence_order(session, &worst)) {
            Ok(Some((found, change))) => (order, last) = (found, change),
            Ok(None) => {}
            Err(text) => return Finding::new(Question::Steps, Verdict::Wrong, None, text).with(NOT_FINITE),
        }
    }
    // Below the tolerance of a law's own iterations no order is seen.
    if order >= LOWEST_ORDER || coarse <= 1e-6 || last <= SETTLED {
        let text = format!("increments in two change the stress by up to {largest_change:.1e}; order {order:.1}");
        return Finding::new(Question::Steps, Verdict::Right, Some(order), text);
    }
    let text =
        format!("finer increments change the stress by {largest_change:.1e}, and order {order:.1} is no convergence");
    let verdict = if order < DIVERGES { Verdict::Wrong } else { Verdict::Warning };
    Finding::new(Question::Steps, verdict, Some(order), text).with(NO_CONVERGENCE)
}

/// The stress at the end of a path in ever more parts, as far as the law does not refuse, and the largest of all on the
/// way: a path may end where there is next to no stress.
fn end_stresses(session: &mut Session, path: &[Matrix3<f64>]) -> Result<(Vec<Matrix3<f64>>, f64), String> {
    let (mut ends, mut size) = (Vec::new(), 0.0_f64);
    for parts in PARTS {
        if let Some((stress, largest)) = end(session, path, parts)? {
            ends.push(stress);
            size = size.max(largest);
        }
    }
    Ok((ends, size))
}

/// The order of the last two changes of the stress when the parts of a path are halved again and again, and the last
/// change; none where the law refuses them. It ends where an order is seen twice, or the stress has settled.
fn convergence_order(session: &mut Session, worst: &PathEnd) -> Result<Option<(f64, f64)>, String> {
    let started = Instant::now();
    let (mut stress, mut parts, mut seen) = (worst.stress, PARTS[PARTS.len() - 1], 0);
    let (mut change, mut found) = (worst.change, None);
    while parts < MOST_PARTS && seen < 2 && started.elapsed() < LONGEST {
        parts *= 2;
        let Some((next, _)) = end(session, &worst.path, parts)? else { break };
        let of_this = (next - stress).norm() / worst.size;
        let order = (change / f64::max(of_this, f64::MIN_POSITIVE)).log2();
        seen = if order >= LOWEST_ORDER || of_this <= SETTLED { seen + 1 } else { 0 };
        (stress, change, found) = (next, of_this, Some((order, of_this)));
    }
    Ok(found)
}

/// The stress at the end of the path and the largest on the way, each of its increments in so many parts.
fn end(session: &mut Session, path: &[Matrix3<f64>], parts: usize) -> Result<Option<(Matrix3<f64>, f64)>, String> {
    let mut point = Point::undeformed(session, [1, 1]);
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
