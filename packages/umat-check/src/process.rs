//! What a law does to the process that it runs in: memory, order and threads of calls, outputs that it leaves unset,
//! floating-point exceptions, invalid input, many random histories.

use std::time::{Duration, Instant};

use fastrand::Rng;
use nalgebra::Matrix3;

use super::call::{Answer, Call, Law, Session};
use super::finding::{Finding, NOT_FINITE, Question, Verdict};
use super::guarded::Guard;
use super::histories::{LARGEST_TURN, history, state};
use super::kinematics::{Increment, name};
use super::material::{Material, Reads};
use super::point::{Failure, Point};

/// What the law reads: which argument changes the stress; and whether a strain 33 does.
pub fn reads(session: &mut Session) -> (Reads, bool) {
    let mut rng = Rng::with_seed(session.material.seed ^ 0x4e);
    let components = session.material.components;
    let (mut by_deformation, mut by_strain, mut by_third) = (false, false, false);
    for _ in 0..6 {
        let mut point = Point::undeformed(session, [1, 1]);
        let mut path = history(&mut rng, session.material, 2);
        path.truncate(20);
        for f1 in &path {
            let call = point.call(f1, session.material);
            let answer = session.call_law(&call);
            if answer.refused() || !answer.finite() {
                break;
            }
            let size = answer.stress.iter().fold(0.0_f64, |size, stress| size.max(stress.abs()));
            let mut changed = |call: &Call| {
                let other = session.call_law(call);
                let difference = other.stress.iter().zip(&answer.stress).map(|(a, b)| (a - b).abs());
                !difference.fold(0.0, f64::max).le(&(1e-12 * size))
            };
            let mut other = call.clone();
            other.f1 = Matrix3::new(1.01, 0.004, 0.0, 0.0, 0.995, 0.0, 0.0, 0.0, 1.003) * call.f1;
            by_deformation |= changed(&other);
            let mut other = call.clone();
            for (k, strain) in other.strain_increment.iter_mut().enumerate() {
                *strain = *strain * 1.5 + 1e-4 * (k + 1) as f64;
            }
            for (k, strain) in other.strain.iter_mut().enumerate() {
                *strain += 1e-4 * (k + 1) as f64;
            }
            by_strain |= changed(&other);
            let mut other = call.clone();
            other.f0 = Matrix3::new(1.01, 0.004, 0.0, 0.0, 0.995, 0.0, 0.0, 0.0, 1.003) * call.f0;
            // A law of increments of F is one of rates too.
            by_strain |= changed(&other);
            if components == 4 {
                let mut other = call.clone();
                other.f1[(2, 2)] *= 1.01;
                other.strain[2] += 1e-3;
                other.strain_increment[2] += 1e-3;
                by_third |= changed(&other);
            }
            point = point.after(f1, &call, &answer);
        }
    }
    let reads = match (by_deformation, by_strain) {
        (true, true) => Reads::Mixed,
        (false, true) => Reads::Rate,
        _ => Reads::Total,
    };
    (reads, by_third)
}

/// A few histories: with a page at either end of the arrays, what is touched beyond ends the process.
pub fn touch_beyond_arrays(session: &mut Session) -> Finding {
    let mut rng = Rng::with_seed(session.material.seed ^ 0x6d);
    let (mut calls, mut answered) = (0, 0);
    for _ in 0..10 {
        let mut point = Point::undeformed(session, [1, 1]);
        let mut path = history(&mut rng, session.material, 2);
        path.truncate(60);
        for f1 in &path {
            calls += 1;
            if point.advance(session, f1).is_err() {
                break;
            }
            answered += 1;
        }
    }
    if answered == 0 {
        let text = "no increment has an answer: PNEWDT asks for ever smaller ones, or what comes back is not finite";
        return Finding::new(Question::Memory, Verdict::NotSure, None, text);
    }
    let text = format!("{calls} increments touch nothing beyond STATEV, PROPS, STRESS, DDSDDE");
    Finding::new(Question::Memory, Verdict::Right, None, text)
}

/// The answers of a history, up to where there are none.
fn answers(session: &mut Session, path: &[Matrix3<f64>], place: [i32; 2]) -> Vec<Answer> {
    let mut point = Point::undeformed(session, place);
    path.iter().map_while(|f| point.advance(session, f).ok()).collect()
}

fn paths(material: &Material, seed: u64, count: usize, longest: usize) -> Vec<Vec<Matrix3<f64>>> {
    let mut rng = Rng::with_seed(material.seed ^ seed);
    let path = |_| {
        let mut path = history(&mut rng, material, 2);
        path.truncate(longest);
        path
    };
    (0..count).map(path).collect()
}

/// A second call, and another order of points: SAVE and COMMON.
pub fn repeat(session: &mut Session) -> Finding {
    let paths = paths(session.material, 0x2e, 8, 30);
    let alone: Vec<Vec<Answer>> =
        paths.iter().enumerate().map(|(k, path)| answers(session, path, [1, k as i32 + 1])).collect();
    let wrong =
        |text: String| Finding::new(Question::Repeat, Verdict::Wrong, None, text).with("answers depend on order");
    // Each increment asked twice, as Newton's iterations do, with another strain between.
    for (k, path) in paths.iter().enumerate() {
        let mut point = Point::undeformed(session, [1, k as i32 + 1]);
        for (increment, f1) in path.iter().enumerate().take(alone[k].len()) {
            let call = point.call(f1, session.material);
            let first = session.call_law(&call);
            if first.refused() {
                break;
            }
            let further = Matrix3::new(1.002, 0.001, 0.0, 0.0, 0.999, 0.0, 0.0, 0.0, 1.001) * f1;
            let between = point.call(&further, session.material);
            session.call_law(&between);
            let second = session.call_law(&call);
            if !first.has_same_bits(&second) {
                return wrong(format!(
                    "the same call answers otherwise the second time, at increment {}{}",
                    increment + 1,
                    what_differs(&first, &second)
                ));
            }
            if !first.finite() {
                break;
            }
            point = point.after(f1, &call, &first);
        }
    }
    // All points side by side, increment by increment.
    let mut points: Vec<Point> = (0..paths.len()).map(|k| Point::undeformed(session, [1, k as i32 + 1])).collect();
    let longest = paths.iter().map(Vec::len).max().unwrap_or(0);
    for increment in 0..longest {
        for k in (0..paths.len()).rev() {
            let (Some(f), Some(expected)) = (paths[k].get(increment), alone[k].get(increment)) else { continue };
            match points[k].advance(session, f) {
                Ok(answer) if answer.has_same_bits(expected) => {}
                Ok(answer) => {
                    return wrong(format!(
                        "a point answers otherwise if others are computed between its increments, at increment {}{}",
                        increment + 1,
                        what_differs(&answer, expected)
                    ));
                }
                Err(_) => return wrong("a point has no answer if others are computed between its increments".into()),
            }
        }
    }
    let calls: usize = alone.iter().map(Vec::len).sum();
    if calls == 0 {
        return Finding::new(Question::Repeat, Verdict::NotSure, None, "there was no answer");
    }
    let text = format!("a second call and another order of points: the same bits, {calls} increments");
    Finding::new(Question::Repeat, Verdict::Right, None, text)
}

/// The answers of so many histories, one after the other.
pub fn answers_of(session: &mut Session, seed: u64, count: usize, longest: usize) -> Vec<Answer> {
    let paths = paths(session.material, seed, count, longest);
    paths.iter().flat_map(|path| answers(session, path, [1, 1])).collect()
}

/// The bits of the stresses of a few histories.
pub fn stresses(session: &mut Session) -> Vec<u64> {
    let paths = paths(session.material, 0x2e, 3, 12);
    let all: Vec<Answer> = paths.iter().flat_map(|path| answers(session, path, [1, 1])).collect();
    all.iter().flat_map(|answer| answer.stress).map(f64::to_bits).collect()
}

fn what_differs(a: &Answer, b: &Answer) -> String {
    let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
    if bits(&a.stress) != bits(&b.stress) {
        let difference = a.stress.iter().zip(&b.stress).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let size = a.stress.iter().fold(0.0_f64, |size, stress| size.max(stress.abs()));
        return format!(": the stress by {:.1e} of itself", difference / size);
    }
    if let Some(entry) = (0..a.state.len()).find(|&entry| a.state[entry].to_bits() != b.state[entry].to_bits()) {
        return format!(": STATEV({})", entry + 1);
    }
    if bits(&a.energies) != bits(&b.energies) { ": SSE, SPD or SCD".into() } else { ": DDSDDE".into() }
}

const THREADS: usize = 8;
/// Of a thread: local arrays of a law may be large, and solvers' threads have room for them.
const STACK: usize = 256 << 20;

/// Eight threads at once, each with a history of its own.
pub fn threads(law: &Law, material: &Material, session: &mut Session) -> Finding {
    let paths = paths(material, 0x7e, THREADS, 60);
    let alone: Vec<Vec<Answer>> =
        paths.iter().enumerate().map(|(k, path)| answers(session, path, [1, k as i32 + 1])).collect();
    if alone.iter().all(Vec::is_empty) {
        return Finding::new(Question::Threads, Verdict::NotSure, None, "there was no answer");
    }
    let started = Instant::now();
    let run = |k: usize, mut session: Session| {
        let mut rounds = 0;
        while rounds < 200 && started.elapsed() < Duration::from_secs(3) {
            let found = answers(&mut session, &paths[k], [1, k as i32 + 1]);
            if found.len() != alone[k].len() || !found.iter().zip(&alone[k]).all(|(a, b)| a.has_same_bits(b)) {
                return Err(());
            }
            rounds += 1;
        }
        Ok(rounds)
    };
    let sessions: Result<Vec<Session>, _> = (0..THREADS).map(|_| session.for_thread(law)).collect();
    let Ok(sessions) = sessions else {
        return Finding::new(Question::Threads, Verdict::NotSure, None, "no memory for eight threads");
    };
    let found: std::io::Result<Vec<Result<i32, ()>>> = std::thread::scope(|scope| {
        let run = &run;
        let threads = sessions.into_iter().enumerate().map(|(k, session)| {
            let builder = std::thread::Builder::new().stack_size(STACK);
            builder.spawn_scoped(scope, move || run(k, session))
        });
        let threads: Result<Vec<_>, _> = threads.collect();
        threads.map(|threads| threads.into_iter().map(|thread| thread.join().unwrap_or(Err(()))).collect())
    });
    let Ok(found) = found else {
        return Finding::new(Question::Threads, Verdict::NotSure, None, "no memory for the stacks of eight threads");
    };
    let wrong = found.iter().filter(|found| found.is_err()).count();
    if wrong > 0 {
        let text =
            format!("{wrong} of eight threads get other answers than alone: variables are shared (SAVE, COMMON, DATA)");
        return Finding::new(Question::Threads, Verdict::Wrong, None, text).with("answers depend on threads");
    }
    let rounds: i32 = found.iter().flatten().sum();
    let text = format!("eight threads at once: the same bits, {rounds} histories");
    Finding::new(Question::Threads, Verdict::Right, None, text)
}

/// A NaN that no arithmetic makes.
pub const UNSET: u64 = 0x7ff8_dead_beef_0001;

/// DDSDDE before the call is what was there before: Abaqus does not promise zeros.
pub fn outputs(session: &mut Session) -> Finding {
    let components = session.material.components;
    let mut unset = [[false; 6]; 6];
    let mut used = [[false; 6]; 6];
    let (mut asked, mut stress_depends) = (0, false);
    session.watched = Some(Vec::new());
    for (k, path) in paths(session.material, 0x0f, 8, 30).into_iter().enumerate() {
        let mut point = Point::undeformed(session, [1, k as i32 + 1]);
        for f1 in &path {
            let mut call = point.call(f1, session.material);
            let zero = session.call_law(&call);
            if zero.refused() || !zero.finite() {
                break;
            }
            call.unset = f64::from_bits(UNSET);
            let answer = session.call_law(&call);
            asked += 1;
            let size = zero.stress.iter().fold(0.0_f64, |size, stress| size.max(stress.abs()));
            let changes = |(one, other): (&f64, &f64)| (one - other).is_nan() || (one - other).abs() > 1e-12 * size;
            stress_depends |= answer.stress.iter().zip(&zero.stress).any(changes);
            for i in 0..components {
                for j in 0..components {
                    let entry = answer.modulus[i][j];
                    unset[i][j] |= entry.to_bits() == UNSET;
                    used[i][j] |= entry.is_nan();
                }
            }
            point = point.after(f1, &call, &zero);
        }
    }
    let written = session.watched.take().unwrap_or_default();
    let named = |entries: &[[bool; 6]; 6]| {
        let places = (0..components).flat_map(|i| (0..components).map(move |j| (i, j)));
        let places: Vec<String> =
            places.filter(|&(i, j)| entries[i][j]).map(|(i, j)| format!("({}, {})", i + 1, j + 1)).collect();
        if places.len() > 6 {
            format!("{}, … {} entries", places[..4].join(", "), places.len())
        } else {
            places.join(", ")
        }
    };
    if asked == 0 {
        return Finding::new(Question::Outputs, Verdict::NotSure, None, "there was no answer");
    }
    if !written.is_empty() {
        return inputs_written(&written);
    }
    if stress_depends {
        let text = format!("STRESS depends on what was in DDSDDE{} before the call", named(&used));
        return Finding::new(Question::Outputs, Verdict::Warning, None, text).with("unset");
    }
    if used.iter().flatten().any(|used| *used) {
        let text = if unset == used {
            format!("DDSDDE{} not set: it keeps what was there before", named(&unset))
        } else {
            format!("DDSDDE{} depends on what was there before the call", named(&used))
        };
        return Finding::new(Question::Outputs, Verdict::Warning, None, text).with("unset");
    }
    Finding::new(Question::Outputs, Verdict::Right, None, "every entry of DDSDDE is set, inputs are left alone")
}

/// PROPS are those of all points; of others Abaqus hands over a copy.
fn inputs_written(written: &[&str]) -> Finding {
    let text = format!("{} are inputs, and are written to", written.join(", "));
    let line = |verdict, text: String| Finding::new(Question::Outputs, verdict, None, text).with("input overwritten");
    match written.contains(&"PROPS") {
        true => line(Verdict::Wrong, format!("{text}: the next call of any point gets other PROPS")),
        false => line(Verdict::Warning, text),
    }
}

/// Exceptions, in C's names of this processor.
#[cfg(target_arch = "x86_64")]
pub const EXCEPTIONS: [(i32, &str); 3] = [(0x01, "invalid"), (0x04, "division by zero"), (0x08, "overflow")];
#[cfg(not(target_arch = "x86_64"))]
pub const EXCEPTIONS: [(i32, &str); 3] = [(0x01, "invalid"), (0x02, "division by zero"), (0x04, "overflow")];

unsafe extern "C" {
    pub fn feclearexcept(exceptions: i32) -> i32;
    pub fn fetestexcept(exceptions: i32) -> i32;
}

/// Floating-point exceptions that a call raises: with them trapped the job would end.
pub fn exceptions(session: &mut Session) -> Finding {
    let all = EXCEPTIONS.iter().fold(0, |all, (bit, _)| all | bit);
    let mut raised = [0; 3];
    let mut asked = 0;
    for (k, path) in paths(session.material, 0xf9, 12, 30).into_iter().enumerate() {
        let mut point = Point::undeformed(session, [1, k as i32 + 1]);
        let rest = [Matrix3::identity()];
        for f1 in rest.iter().chain(&path) {
            let call = point.call(f1, session.material);
            // SAFETY: they take and give numbers, and change the flags of this thread alone.
            let (answer, found) = unsafe {
                feclearexcept(all);
                let answer = session.call_law(&call);
                (answer, fetestexcept(all))
            };
            asked += 1;
            for (count, (bit, _)) in raised.iter_mut().zip(EXCEPTIONS) {
                *count += i32::from(found & bit != 0);
            }
            if answer.refused() || !answer.finite() {
                break;
            }
            point = point.after(f1, &call, &answer);
        }
    }
    let found: Vec<(i32, &str)> = raised
        .iter()
        .zip(EXCEPTIONS)
        .filter(|(count, _)| **count > 0)
        .map(|(count, (_, name))| (*count, name))
        .collect();
    if found.is_empty() {
        let text = format!("{asked} calls raise neither invalid, division by zero nor overflow");
        return Finding::new(Question::Exceptions, Verdict::Right, None, text);
    }
    let named: Vec<String> = found.iter().map(|(count, name)| format!("{name} in {count}")).collect();
    let text = format!("raised, of {asked} calls: {}; where they are trapped the job ends", named.join(", "));
    let mut line = Finding::new(Question::Exceptions, Verdict::Warning, None, text);
    line.kinds = found.iter().map(|(_, name)| name.to_string()).collect();
    line
}

/// NaN and an inverted element: they must come back as such, or PNEWDT must ask for a smaller increment.
pub fn invalid(session: &mut Session, reads: Reads) -> Finding {
    let mut said = Vec::new();
    let mut silent = false;
    let mut point = Point::undeformed(session, [1, 1]);
    let first = history(&mut Rng::with_seed(session.material.seed), session.material, 1);
    for f1 in first.iter().take(3) {
        if point.advance(session, f1).is_err() {
            break;
        }
    }
    let mut base = point.call(&point.f.clone(), session.material);
    base.strain_increment = [0.0; 6];
    let mut call = base.clone();
    call.f1[(0, 0)] = f64::NAN;
    call.strain_increment[0] = f64::NAN;
    let mut answer_to = |call: &Call, what: &str, said: &mut Vec<String>| {
        let answer = session.call_law(call);
        if answer.refused() {
            said.push(format!("{what}: PNEWDT"));
            true
        } else if answer.stress.iter().any(|stress| stress.is_nan()) {
            said.push(format!("{what}: NaN"));
            true
        } else {
            said.push(format!("{what}: a finite stress, as if nothing were wrong"));
            false
        }
    };
    silent |= !answer_to(&call, "NaN in", &mut said);
    if reads != Reads::Rate {
        let mut call = base.clone();
        for i in 0..3 {
            call.f1[(i, 0)] = -call.f1[(i, 0)];
        }
        silent |= !answer_to(&call, "inverted F", &mut said);
    }
    let verdict = if silent { Verdict::Warning } else { Verdict::Right };
    Finding::new(Question::Invalid, verdict, None, said.join("; "))
}

const HISTORIES: usize = 100_000;
const TIME: Duration = Duration::from_secs(6);

/// Very many short random histories from the initial call.
pub fn histories(session: &mut Session, reads: Reads) -> Finding {
    let started = Instant::now();
    let mut rng = Rng::with_seed(session.material.seed ^ 0x10);
    let (mut done, mut refused, mut long, mut long_refused) = (0, 0, 0, 0);
    for number in 0..HISTORIES {
        if number % 64 == 0 && started.elapsed() > TIME {
            break;
        }
        let mut point = Point::undeformed(session, [1, 1]);
        let target = state(&mut rng, session.material);
        let count = rng.usize(1..5);
        let whole = Increment::between(&point.f, &target).turning_at_most(LARGEST_TURN * count as f64);
        // Small ones too: from a millionth of the way to all of it.
        let is_long = rng.bool();
        let part = if is_long { 1.0 } else { 10f64.powf(-6.0 * rng.f64()) };
        long += usize::from(is_long);
        // A law of increments is for increments like those of the file.
        let most = 2.0 * session.material.increment * count as f64 / whole.strain.norm();
        let part = if reads == Reads::Total { part } else { part.min(most) };
        for k in 1..=count {
            let f = whole.at(part * k as f64 / count as f64, &Matrix3::identity());
            match point.advance(session, &f) {
                Ok(_) => {}
                Err(Failure::Refused) => {
                    refused += 1;
                    long_refused += usize::from(is_long);
                    break;
                }
                Err(Failure::NotFinite(call)) => {
                    let answer = session.call_law(&call);
                    let text =
                        format!("{} of history {} (F = {})", not_finite(&answer, session), number + 1, rows(&call.f1));
                    return Finding::new(Question::Histories, Verdict::Wrong, None, text).with(NOT_FINITE);
                }
            }
        }
        done += 1;
    }
    let refusals = if refused > 0 { format!(", {refused} of which end with PNEWDT") } else { String::new() };
    let time = if done < HISTORIES { format!(" in {} s", TIME.as_secs()) } else { String::new() };
    if let Some(step) = session.no_step {
        let text = format!("PNEWDT is {step}: DTIME is multiplied by it, and it has to be larger than 0");
        return Finding::new(Question::Histories, Verdict::Wrong, None, text).with("PNEWDT");
    }
    let text = format!("{done} random histories from the initial call{time}{refusals}");
    if refused == done || (long >= MANY && long_refused as f64 > NEARLY_ALL * long as f64) {
        let text = format!("{text}: next to no path into the range can be finished, in five attempts at an increment");
        return Finding::new(Question::Histories, Verdict::Wrong, None, text).with("refused");
    }
    if 2 * refused > done {
        return Finding::new(Question::Histories, Verdict::Warning, None, text).with("refused");
    }
    Finding::new(Question::Histories, Verdict::Right, None, text)
}

/// So many histories into the range tell that none can be finished, and this part of them is all.
const MANY: usize = 20;
const NEARLY_ALL: f64 = 0.9;

fn not_finite(answer: &Answer, session: &Session) -> String {
    let (components, layout) = (session.material.components, session.material.layout());
    if let Some(i) = (0..components).find(|&i| !answer.stress[i].is_finite()) {
        return format!("STRESS({}) is not finite in an increment", i + 1);
    }
    if let Some(i) = (0..answer.state.len()).find(|&i| !answer.state[i].is_finite()) {
        return format!("STATEV({}) is not finite in an increment", i + 1);
    }
    let place = (0..components).flat_map(|i| (0..components).map(move |j| (i, j)));
    let place = place.into_iter().find(|&(i, j)| !answer.modulus[i][j].is_finite());
    match place {
        Some((i, j)) => {
            format!("DDSDDE({}, {}) is not finite in an increment", name(layout, i), name(layout, j))
        }
        None => "a number is not finite the first time".to_string(),
    }
}

fn rows(f: &Matrix3<f64>) -> String {
    let row = |i: usize| (0..3).map(|j| format!("{:.6}", f[(i, j)])).collect::<Vec<_>>().join(" ");
    [row(0), row(1), row(2)].join("; ")
}

/// The same few histories with a build that checks itself, and fills what is unset with NaN.
pub fn runtime(session: &mut Session) -> Finding {
    let line = touch_beyond_arrays(session);
    let mut rng = Rng::with_seed(session.material.seed ^ 0x6e);
    for _ in 0..6 {
        let mut point = Point::undeformed(session, [1, 1]);
        for f1 in history(&mut rng, session.material, 2).iter().take(30) {
            match point.advance(session, f1) {
                Ok(answer) if answer.energies.iter().all(|energy| energy.is_finite()) => {}
                Ok(_) => {
                    let text = "SSE, SPD or SCD is not finite in an increment of the build that fills unset reals with NaN: a \
                                variable is used unset";
                    return Finding::new(Question::Runtime, Verdict::Wrong, None, text)
                        .with("runtime check")
                        .with(NOT_FINITE);
                }
                Err(Failure::Refused) => break,
                Err(Failure::NotFinite(call)) => {
                    let answer = session.call_law(&call);
                    let text = format!(
                        "{} of the build that fills unset reals with NaN: a variable is used unset",
                        not_finite(&answer, session)
                    );
                    return Finding::new(Question::Runtime, Verdict::Wrong, None, text)
                        .with("runtime check")
                        .with(NOT_FINITE);
                }
            }
        }
    }
    if line.verdict != Verdict::Right {
        return Finding { check: Question::Runtime.name().to_string(), ..line };
    }
    let text = "bounds, unset reals (-fcheck=all -finit-real=snan): nothing found";
    Finding { check: Question::Runtime.name().to_string(), text: text.to_string(), ..line }
}

impl<'a> Session<'a> {
    fn for_thread(&self, law: &'a Law) -> std::io::Result<Session<'a>> {
        Ok(Session::new(law, self.material, Guard::Padded, self.shared())?.without_records())
    }
}
