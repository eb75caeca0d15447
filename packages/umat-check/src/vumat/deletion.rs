//! The state variable by which elements are deleted: once it is 0 it stays 0, and there is no stress. Abaqus sees to
//! both itself, and calls no more; other solvers that take the routine may not.

use std::io;

use fastrand::Rng;

use super::super::finding::{Finding, Question, Verdict};
use super::super::histories::direction;
use super::super::kinematics::exp;
use super::call::Session;
use super::point;

const PATHS: usize = 32;
/// Increments of a path: out, beyond the range of stretches, and back.
const INCREMENTS: usize = 200;
/// How far, in ranges of stretch.
const BEYOND: f64 = 4.0;

/// Why it is not wrong.
const ABAQUS: &str = "; Abaqus sets the stress of deleted points to zero itself, and never takes them back";

/// # Errors
/// The system has no memory.
pub fn deletion(session: &mut Session) -> io::Result<Finding> {
    let line = |verdict, text: String| Finding::new(Question::Deletion, verdict, None, text);
    let Some(flag) = session.material.explicit.deletion else {
        return Ok(line(Verdict::NotAsked, "deletion, the number of DELETE, is not declared".to_string()));
    };
    let mut rng = Rng::with_seed(session.material.seed ^ 0xde);
    let size = session.material.stretch.iter().map(|stretch| stretch.ln().abs()).fold(0.0, f64::max) * BEYOND;
    let (mut deleted, mut after) = (0, 0);
    for _ in 0..PATHS {
        let strain = direction(&mut rng, session.material) * size;
        let half = INCREMENTS / 2;
        let path: Vec<_> =
            (1..=INCREMENTS).map(|k| exp(&(strain * (k.min(INCREMENTS - k) as f64 / half as f64)))).collect();
        let found = point::history(session, &path)?;
        let Some(first) = found.iter().position(|found| found.state[flag - 1] == 0.0) else { continue };
        deleted += 1;
        for (k, found) in found.iter().enumerate().skip(first + 1) {
            after += 1;
            let increment = k + 1;
            if found.state[flag - 1] != 0.0 {
                let text = format!(
                    "stateNew(:, {flag}) is 0 in increment {}, and {} again in increment {increment}: not latched",
                    first + 1,
                    found.state[flag - 1]
                );
                return Ok(line(Verdict::Warning, format!("{text}{ABAQUS}")).with("not latched"));
            }
            if let Some(c) = found.stress.iter().position(|&stress| stress != 0.0) {
                let text = format!(
                    "deleted in increment {}, and stressNew(:, {}) = {:.3e} in increment {increment}",
                    first + 1,
                    c + 1,
                    found.stress[c]
                );
                return Ok(line(Verdict::Warning, format!("{text}{ABAQUS}")).with("stress after deletion"));
            }
        }
    }
    if deleted == 0 {
        let text = format!("no point is deleted up to {BEYOND} times the range of stretches");
        return Ok(line(Verdict::NotSure, text));
    }
    let text = format!("once 0 stays 0, without stress: {deleted} of {PATHS} points, {after} increments after");
    Ok(line(Verdict::Right, text))
}
