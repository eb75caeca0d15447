//! Whether a point's answer depends on the points beside it, on other calls, or on other threads.

use std::io;
use std::time::{Duration, Instant};

use fastrand::Rng;
use nalgebra::Matrix3;

use super::super::finding::{Finding, Question, Verdict};
use super::super::histories::history;
use super::super::material::Material;
use super::call::{Law, PointInput, PointOutput, Session};
use super::point::{self, Point, time};

/// Abaqus's own blocks have up to 136 points or so; the second size is odd, and no multiple of a vector's length.
pub const SIZES: [usize; 3] = [1, 17, 128];
/// Increments of a history.
const INCREMENTS: usize = 12;

/// Histories of this length.
pub fn paths(material: &Material, seed: u64, count: usize, length: usize) -> Vec<Vec<Matrix3<f64>>> {
    let mut rng = Rng::with_seed(material.seed ^ seed);
    (0..count)
        .map(|_| {
            let mut path = Vec::new();
            while path.len() < length {
                path = history(&mut rng, material, 3);
            }
            path.truncate(length);
            path
        })
        .collect()
}

/// The first difference, bit by bit: increment and what.
fn differ(a: &[PointOutput], b: &[PointOutput]) -> Option<(usize, String)> {
    let place = a.iter().zip(b).position(|(a, b)| !a.has_same_bits(b))?;
    Some((place + 1, a[place].difference(&b[place])))
}

/// One history at elements of other numbers.
///
/// # Errors
/// The system has no memory.
pub fn place(session: &mut Session) -> io::Result<Finding> {
    let path = paths(session.material, 0x91, 1, INCREMENTS).pop().unwrap_or_default();
    session.numbered = true;
    let found = point::block(session, &vec![path; SIZES[1]])?;
    session.numbered = false;
    let size = found[0].iter().flat_map(|found| found.stress).fold(f64::MIN_POSITIVE, |size, of| size.max(of.abs()));
    let mut change = 0.0_f64;
    for (other, first) in found[1..].iter().flat_map(|other| other.iter().zip(&found[0])) {
        let differences = other.stress.iter().zip(&first.stress).map(|(a, b)| (a - b).abs() / size);
        change = differences.fold(change, f64::max);
    }
    Ok(super::super::place::place_finding(change, found[0].len(), [change > 0.0, false]))
}

/// The temperature of a point among others.
fn temperature(material: &Material, i: usize) -> f64 {
    let part = (i % 5) as f64;
    material.temperature + if material.temperature == 0.0 { part } else { 2e-3 * part * material.temperature }
}

/// The same points in blocks of 1, 17 and 128, and in the reverse order.
///
/// # Errors
/// The system has no memory.
pub fn blocks(session: &mut Session) -> io::Result<Finding> {
    let [_, some, most] = SIZES;
    let paths = paths(session.material, 0xb1, most, INCREMENTS);
    let wrong = |text: String| {
        let line = Finding::new(Question::Blocks, Verdict::Wrong, None, text);
        Ok(line.with("answers depend on the block"))
    };
    // Each point has a temperature of its own.
    let temperatures: Vec<f64> = (0..most).map(|i| temperature(session.material, i)).collect();
    let alone: Vec<Vec<PointOutput>> = paths
        .iter()
        .zip(&temperatures)
        .map(|(path, one)| Ok(point::block_at(session, std::slice::from_ref(path), &[*one])?.pop().unwrap_or_default()))
        .collect::<io::Result<_>>()?;
    for size in [some, most] {
        for ((chunk, temperatures), expected) in
            paths.chunks(size).zip(temperatures.chunks(size)).zip(alone.chunks(size))
        {
            let found = point::block_at(session, chunk, temperatures)?;
            for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
                if let Some((increment, what)) = differ(found, expected) {
                    return wrong(format!(
                        "point {} of a block of {} answers otherwise than alone, at increment {increment}: {what}",
                        i + 1,
                        chunk.len()
                    ));
                }
            }
        }
    }
    let reversed: Vec<Vec<Matrix3<f64>>> = paths.iter().rev().cloned().collect();
    let turned: Vec<f64> = temperatures.iter().rev().copied().collect();
    for (found, expected) in point::block_at(session, &reversed, &turned)?.iter().zip(alone.iter().rev()) {
        if let Some((increment, what)) = differ(found, expected) {
            return wrong(format!("another order of points changes {what}, at increment {increment}"));
        }
    }
    let text = format!("blocks of 1, {some}, {most} points and the reverse order: the same bits");
    Ok(Finding::new(Question::Blocks, Verdict::Right, None, text))
}

/// A second call with another one in between.
///
/// # Errors
/// The system has no memory.
pub fn repeat(session: &mut Session) -> io::Result<Finding> {
    let paths = paths(session.material, 0x2e, SIZES[1], INCREMENTS);
    let undeformed = Point::undeformed(session)?;
    let mut points = vec![undeformed; paths.len()];
    let unturned = Matrix3::<f64>::identity();
    let further = Matrix3::new(1.002, 0.001, 0.0, 0.0, 0.999, 0.0, 0.0, 0.0, 1.001);
    for k in 0..INCREMENTS {
        let given = |points: &[Point], factor: &Matrix3<f64>| -> Vec<PointInput> {
            let all = points.iter().zip(&paths);
            all.map(|(point, path)| point.given(&(path[k] * factor), &unturned, session.material)).collect()
        };
        let (call, between) = (given(&points, &unturned), given(&points, &further));
        let time = time(k, session.material);
        let first = session.call_law(time, &call)?;
        session.call_law(time, &between)?;
        let second = session.call_law(time, &call)?;
        if let Some((_, what)) = differ(&first, &second) {
            let text = format!("the same call answers otherwise the second time, at increment {}: {what}", k + 1);
            return Ok(Finding::new(Question::Repeat, Verdict::Wrong, None, text).with("answers depend on order"));
        }
        for (i, found) in first.iter().enumerate() {
            points[i] = points[i].after(&paths[i][k], &unturned, found);
        }
    }
    let text = format!("a second call: the same bits, {INCREMENTS} increments of {} points", paths.len());
    Ok(Finding::new(Question::Repeat, Verdict::Right, None, text))
}

/// The bits of the stresses of a block.
///
/// # Errors
/// The system has no memory.
pub fn stresses(session: &mut Session) -> io::Result<Vec<u64>> {
    let found = point::block(session, &paths(session.material, 0x2e, SIZES[1], INCREMENTS))?;
    Ok(found.iter().flatten().flat_map(|found| found.stress).map(f64::to_bits).collect())
}

const THREADS: usize = 8;

/// Eight threads at once, each with a block of its own.
///
/// # Errors
/// The system has no memory.
pub fn threads(law: &Law, session: &mut Session) -> io::Result<Finding> {
    let blocks: Vec<Vec<Vec<Matrix3<f64>>>> =
        (0..THREADS).map(|k| paths(session.material, 0x7e + k as u64, SIZES[1], INCREMENTS)).collect();
    let alone: Vec<Vec<Vec<PointOutput>>> =
        blocks.iter().map(|paths| point::block(session, paths)).collect::<io::Result<_>>()?;
    let started = Instant::now();
    let run = |k: usize, mut session: Session| -> io::Result<Option<usize>> {
        let mut rounds = 0;
        while rounds < 200 && started.elapsed() < Duration::from_secs(3) {
            let found = point::block(&mut session, &blocks[k])?;
            if found.iter().zip(&alone[k]).any(|(a, b)| differ(a, b).is_some()) {
                return Ok(None);
            }
            rounds += 1;
        }
        Ok(Some(rounds))
    };
    let sessions: Vec<Session> = (0..THREADS).map(|_| session.for_thread(law)).collect();
    let found: Vec<Option<usize>> = std::thread::scope(|scope| {
        let run = &run;
        let threads: Vec<_> =
            sessions.into_iter().enumerate().map(|(k, session)| scope.spawn(move || run(k, session))).collect();
        threads.into_iter().map(|thread| thread.join().unwrap_or(Ok(None))).collect::<io::Result<_>>()
    })?;
    let wrong = found.iter().filter(|found| found.is_none()).count();
    if wrong > 0 {
        let text =
            format!("{wrong} of eight threads get other answers than alone: variables are shared (SAVE, COMMON, DATA)");
        return Ok(Finding::new(Question::Threads, Verdict::Wrong, None, text).with("answers depend on threads"));
    }
    let rounds: usize = found.iter().flatten().sum();
    let text = format!("eight threads at once: the same bits, {} histories", rounds * SIZES[1]);
    Ok(Finding::new(Question::Threads, Verdict::Right, None, text))
}
