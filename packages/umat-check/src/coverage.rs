//! Which lines of a law are never executed: what has not run has not been asked about.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use fastrand::Rng;
use nalgebra::Matrix3;

use super::call::{Law, Session};
use super::finding::{Finding, Question, Verdict};
use super::histories::{direction, history};
use super::kinematics::exp;
use super::point::Point;

/// The kind of what has not run.
pub const NOT_EXECUTED: &str = "not executed";

const TIME: Duration = Duration::from_secs(4);
const HISTORIES: usize = 60;
/// Increments of a straight path out and back, and how many such paths.
const STRAIGHT: usize = 100;
const PATHS: usize = 8;
/// Of time steps, and of what histories take.
const TIME_STEPS: [f64; 3] = [1.0, 0.01, 100.0];

/// Histories and straight paths to the ends of the range, at several time steps, with the build that counts.
pub fn cover_lines(law: &Law, session: &mut Session) -> Finding {
    let started = Instant::now();
    let mut rng = Rng::with_seed(session.material.seed ^ 0xc0);
    let mut point = Point::undeformed(session, [1, 1]);
    let _ = point.advance(session, &Matrix3::identity());
    let size = session.material.stretch.iter().map(|stretch| stretch.ln().abs()).fold(0.0, f64::max);
    let mut paths: Vec<Vec<Matrix3<f64>>> = Vec::new();
    for _ in 0..PATHS {
        let strain = direction(&mut rng, session.material) * size;
        for strain in [strain, -strain] {
            let part = |k: usize| k.min(2 * STRAIGHT - k) as f64 / STRAIGHT as f64;
            paths.push((1..=2 * STRAIGHT).map(|k| exp(&(strain * part(k)))).collect());
        }
    }
    paths.extend((0..HISTORIES).map(|_| history(&mut rng, session.material, 3)));
    for (number, path) in paths.iter().enumerate() {
        let time_step = session.material.time_step * TIME_STEPS[number % TIME_STEPS.len()];
        let mut point = Point::undeformed(session, [1, 1]);
        for f1 in path {
            if started.elapsed() > TIME || point.advance_in(session, f1, time_step).is_err() {
                break;
            }
        }
    }
    written(law.write_counts())
}

/// The line, before the counts are read: the child has written them, or cannot.
pub fn written(written: bool) -> Finding {
    let verdict = if written { Verdict::Right } else { Verdict::NotAsked };
    Finding::new(Question::Coverage, verdict, None, "the build does not count its lines")
}

/// What the counts of this folder say of the files of a law.
pub fn of_counts(folder: &Path) -> Finding {
    let not_asked = |text: &str| Finding::new(Question::Coverage, Verdict::NotAsked, None, text);
    let Ok(entries) = std::fs::read_dir(folder) else { return not_asked("the counts of lines cannot be read") };
    let counts = entries.flatten().map(|entry| entry.path());
    let counts: Vec<_> = counts.filter(|path| path.extension().is_some_and(|ending| ending == "gcda")).collect();
    let output = Command::new("gcov").args(["-t", "-b"]).args(&counts).current_dir(folder).output();
    let Ok(output) = output else { return not_asked("there is no gcov, which reads counts of lines") };
    coverage_finding(&parsed(&String::from_utf8_lossy(&output.stdout)))
}

/// Whether each line with code has run, with its text, by file.
type Lines = BTreeMap<String, BTreeMap<usize, (bool, String)>>;

/// gcov's own text: `COUNT:LINE:SOURCE`, the count `#####` where there is none, and the file's name at line 0; before a
/// routine how often it was called. Routines that nothing calls are no part of the law.
fn parsed(text: &str) -> Lines {
    let mut lines = Lines::new();
    let (mut file, mut called) = (String::new(), true);
    for line in text.lines() {
        if let Some(routine) = line.strip_prefix("function ") {
            called = !routine.contains(" called 0 ");
            continue;
        }
        let mut parts = line.splitn(3, ':');
        let (Some(count), Some(number), Some(source)) = (parts.next(), parts.next(), parts.next()) else { continue };
        let (count, Ok(number)) = (count.trim(), number.trim().parse::<usize>()) else { continue };
        if number == 0 {
            called = true;
            if let Some(name) = source.strip_prefix("Source:") {
                file = Path::new(name).file_name().map_or(name.into(), |name| name.to_string_lossy()).to_string();
            }
        } else if count != "-" && called {
            let ran = !count.starts_with(['#', '=']);
            let known = lines.entry(file.clone()).or_default().entry(number).or_insert((false, source.to_string()));
            known.0 |= ran;
        }
    }
    lines
}

/// Lines of a branch that refuses its input, at most.
const REFUSAL: usize = 6;
/// Words of such a branch: it need not run.
const REFUSALS: [&str; 8] = ["pnewdt", "xit", "stop", "abqerr", "xplb", "exit", "write", "print"];

fn coverage_finding(lines: &Lines) -> Finding {
    let (mut all, mut missed) = (0, 0);
    let mut named = Vec::new();
    for (file, lines) in lines {
        all += lines.len();
        for run in runs(lines) {
            let refuses = |line: &&usize| {
                let text = lines[*line].1.to_lowercase();
                REFUSALS.iter().any(|word| text.contains(word))
            };
            if run.len() <= REFUSAL && run.iter().any(|line| refuses(&line)) {
                continue;
            }
            missed += run.len();
            named.push(match run[..] {
                [line] => format!("{file}:{line}"),
                _ => format!("{file}:{}-{}", run[0], run[run.len() - 1]),
            });
        }
    }
    if all == 0 {
        return Finding::new(Question::Coverage, Verdict::NotAsked, None, "no line of the law is counted");
    }
    if missed == 0 {
        let text = format!("all {all} lines are executed, but for what refuses its input");
        return Finding::new(Question::Coverage, Verdict::Right, Some(1.0), text);
    }
    let more = if named.len() > SHOWN { format!(", … {} places", named.len()) } else { String::new() };
    named.truncate(SHOWN);
    let text = format!(
        "{missed} of {all} lines are never executed, and not asked about: {}{more}; other properties, stretch or increment may reach them",
        named.join(", ")
    );
    let part = (all - missed) as f64 / all as f64;
    Finding::new(Question::Coverage, Verdict::NotSure, Some(part), text).with(NOT_EXECUTED)
}

/// So many places are named.
const SHOWN: usize = 6;

/// Lines without a count that follow each other, but for lines without code.
fn runs(lines: &BTreeMap<usize, (bool, String)>) -> Vec<Vec<usize>> {
    let mut runs: Vec<Vec<usize>> = Vec::new();
    let mut open = false;
    for (&line, (ran, _)) in lines {
        match (ran, open) {
            (true, _) => open = false,
            (false, false) => {
                runs.push(vec![line]);
                open = true;
            }
            (false, true) => runs.last_mut().into_iter().for_each(|run| run.push(line)),
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_that_never_ran_are_named_but_for_refusals() {
        let text = "        -:    0:Source:/x/law.f\n        4:    1:      A=1\n    #####:    2:      B=2\n\
                    \x20       -:    3:C\n    #####:    4:      D=2\n        4:    5:      E=1\n    #####:    6:      CALL XIT\n";
        let line = coverage_finding(&parsed(text));
        assert!(
            line.text.starts_with("2 of 5 lines are never executed, and not asked about: law.f:2-4;"),
            "{}",
            line.text
        );
        let line = coverage_finding(&parsed(
            &text.replace("#####:    2", "    1:    2").replace("#####:    4", "    1:    4"),
        ));
        assert_eq!(line.verdict, Verdict::Right);
        let idle = "function inverse_ called 0 returned 0% blocks executed 0%\n    #####:    7:      X=1\n";
        assert_eq!(parsed(&format!("{text}{idle}")), parsed(text));
    }
}
