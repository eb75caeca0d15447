//! What a VUMAT does to the process that it runs in, at rest and in the data check: memory, outputs that it leaves
//! unset, floating-point exceptions, invalid input, many random histories.

use std::io;
use std::time::{Duration, Instant};

use fastrand::Rng;
use nalgebra::Matrix3;

use super::super::finding::{Finding, Question, Verdict};
use super::super::histories::{LARGEST_TURN, direction, state};
use super::super::kinematics::{Increment, exp};
use super::super::material::Reads;
use super::super::process::{EXCEPTIONS, UNSET, feclearexcept, fetestexcept};
use super::blocks::{SIZES, paths};
use super::call::{Law, PointInput, PointOutput, Session, Time};
use super::point::{self, Point, components, tensor, time};

const INCREMENTS: usize = 20;

/// Blocks of several sizes: with a page at either end of the arrays, what is touched beyond ends the process.
///
/// # Errors
/// The system has no memory.
pub fn touch_beyond_arrays(session: &mut Session) -> io::Result<Finding> {
    for size in SIZES {
        point::block(session, &paths(session.material, 0x6d, size, INCREMENTS))?;
    }
    let text = format!("{INCREMENTS} increments of blocks of 1, 17, 128 points touch nothing beyond the arguments");
    Ok(Finding::new(Question::Memory, Verdict::Right, None, text))
}

/// What counts as no stress, of the stiffness.
const NO_STRESS: f64 = 1e-9;

/// # Errors
/// The system has no memory.
pub fn rest(session: &mut Session) -> io::Result<Finding> {
    let small = exp(&(Matrix3::new(1.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, -0.3) * session.material.increment));
    let found = point::block(session, &[vec![Matrix3::identity()], vec![small]])?;
    let (Some(rest), Some(strained)) = (found[0].first(), found[1].first()) else {
        return Ok(Finding::new(Question::Rest, Verdict::NotSure, None, "there was no answer"));
    };
    if !rest.finite() {
        let text = "stress, state or energy is not finite at rest";
        return Ok(Finding::new(Question::Rest, Verdict::Wrong, None, text).with("NaN"));
    }
    let largest = |found: &PointOutput| found.stress.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    let (stress, stiffness) = (largest(rest), largest(strained) / session.material.increment);
    let figure = if stress == 0.0 { 0.0 } else { stress / stiffness.max(f64::MIN_POSITIVE) };
    if figure <= NO_STRESS {
        return Ok(Finding::new(Question::Rest, Verdict::Right, Some(figure), "no stress at rest"));
    }
    let text = format!("stress of {stress:.3e} at rest, over a stiffness of {stiffness:.3e}");
    Ok(Finding::new(Question::Rest, Verdict::Wrong, Some(figure), text).with("stress at rest"))
}

/// Whether there is stress in any state.
///
/// # Errors
/// The system has no memory.
pub fn stress(session: &mut Session) -> io::Result<Finding> {
    let found = point::block(session, &paths(session.material, 0x57e, SIZES[1], INCREMENTS))?;
    let all = found.iter().flatten();
    let largest = all.clone().flat_map(|found| found.stress).fold(0.0_f64, |largest, stress| largest.max(stress.abs()));
    Ok(super::super::stress::stress_finding(largest, all.count()))
}

/// Blocks of several histories, and paths out to the ends of the range, with the build that counts its lines.
///
/// # Errors
/// The system has no memory.
pub fn coverage(law: &Law, session: &mut Session) -> io::Result<Finding> {
    data_check(session)?;
    for size in SIZES {
        point::block(session, &paths(session.material, 0xc0, size, INCREMENTS))?;
    }
    super::deletion::deletion(session)?;
    super::energy::dissipation(session)?;
    Ok(super::super::coverage::written(law.write_counts()))
}

/// The strains of a data check.
const SMALL: f64 = 1e-6;

/// The call with stepTime = totalTime = 0, which may be answered as an elastic material does: with stress, finite,
/// along the strain.
///
/// # Errors
/// The system has no memory.
pub fn data_check(session: &mut Session) -> io::Result<Finding> {
    let mut rng = Rng::with_seed(session.material.seed ^ 0xdc);
    let mut nothing = Point::undeformed(session)?;
    nothing.state.clone_from(&session.material.initial);
    let unturned = Matrix3::<f64>::identity();
    let strains: Vec<_> = (0..SIZES[1]).map(|_| direction(&mut rng, session.material) * SMALL).collect();
    let strained: Vec<PointInput> =
        strains.iter().map(|strain| nothing.given(&exp(strain), &unturned, session.material)).collect();
    // Where strainInc alone says what the strain is.
    let rest = nothing.given(&unturned, &unturned, session.material);
    let fictitious: Vec<PointInput> =
        strains.iter().map(|strain| PointInput { strain_increment: components(strain), ..rest.clone() }).collect();
    let time = Time::data_check(session.material);
    let (with, without) = (session.call_law(time, &strained)?, session.call_law(time, &fictitious)?);
    let line = |verdict, text: &str| Finding::new(Question::DataCheck, verdict, None, text);
    if !with.iter().chain(&without).all(PointOutput::finite) {
        return Ok(line(Verdict::Wrong, "not finite with stepTime = totalTime = 0").with("NaN"));
    }
    let soft = |found: &[PointOutput]| {
        found.iter().zip(&strains).filter(|(found, strain)| tensor(&found.stress).dot(strain) <= 0.0).count()
    };
    if let count @ 1.. = soft(&with) {
        let text = format!("no stress against the strain with stepTime = totalTime = 0, {count} of {}", strains.len());
        return Ok(line(Verdict::Wrong, &text).with("no stiffness"));
    }
    if soft(&without) > 0 {
        let text = "an elastic answer to small strains, but none where stretchNew = 1 and strainInc alone has them";
        return Ok(line(Verdict::Warning, text).with("strainInc is not read"));
    }
    Ok(line(Verdict::Right, "an elastic answer with stepTime = totalTime = 0"))
}

/// What a law leaves unset, and what it writes to but should only read.
///
/// # Errors
/// The system has no memory.
pub fn outputs(session: &mut Session) -> io::Result<Finding> {
    let paths = paths(session.material, 0x0f, SIZES[1], INCREMENTS);
    let mut points = vec![Point::undeformed(session)?; paths.len()];
    let unturned = Matrix3::<f64>::identity();
    let (components, states) = (session.material.components, session.material.initial.len());
    let mut unset: Vec<String> = Vec::new();
    let mut overwritten = Vec::new();
    for k in 0..INCREMENTS {
        let all = points.iter().zip(&paths);
        let given: Vec<PointInput> =
            all.map(|(point, path)| point.given(&path[k], &unturned, session.material)).collect();
        let time = time(k, session.material);
        session.unset = f64::from_bits(UNSET);
        let found = session.call_law(time, &given)?;
        session.unset = 0.0;
        overwritten.extend(session.overwritten(time, &given)?);
        let zero = session.call_law(time, &given)?;
        // An output that keeps what was there, or depends on it.
        let mut note = |name: String, before: f64, after: f64| {
            if before.to_bits() != after.to_bits() && !after.is_nan() && !unset.contains(&name) {
                unset.push(name);
            }
        };
        for (found, zero) in found.iter().zip(&zero) {
            for c in 0..components {
                note(format!("stressNew(:, {})", c + 1), found.stress[c], zero.stress[c]);
            }
            for c in 0..states {
                note(format!("stateNew(:, {})", c + 1), found.state[c], zero.state[c]);
            }
            note("enerInternNew".to_string(), found.energies[0], zero.energies[0]);
            note("enerInelasNew".to_string(), found.energies[1], zero.energies[1]);
        }
        for (i, found) in zero.iter().enumerate() {
            points[i] = points[i].after(&paths[i][k], &unturned, found);
        }
    }
    if let Some(name) = overwritten.first() {
        let text = format!("{name} is an input, and is written to");
        return Ok(Finding::new(Question::Outputs, Verdict::Wrong, None, text).with("input overwritten"));
    }
    if unset.is_empty() {
        let text = "stress, state and energies are set at every point, inputs are left alone";
        return Ok(Finding::new(Question::Outputs, Verdict::Right, None, text));
    }
    unset.sort();
    let named = if unset.len() > 6 {
        format!("{}, … {} in all", unset[..5].join(", "), unset.len())
    } else {
        unset.join(", ")
    };
    let text = format!("{named} not set at some points, or depend on what was there before the call");
    // Energies are for the balance alone.
    let alone = unset.iter().all(|name| name.starts_with("ener"));
    let verdict = if alone { Verdict::Warning } else { Verdict::Wrong };
    Ok(Finding::new(Question::Outputs, verdict, None, text).with("unset"))
}

/// Floating-point exceptions that a call raises: with them trapped the job would end.
///
/// # Errors
/// The system has no memory.
pub fn exceptions(session: &mut Session) -> io::Result<Finding> {
    let all = EXCEPTIONS.iter().fold(0, |all, (bit, _)| all | bit);
    let paths = paths(session.material, 0xf9, 12, INCREMENTS);
    let mut points = vec![Point::undeformed(session)?; paths.len()];
    let unturned = Matrix3::<f64>::identity();
    let mut raised = [0; 3];
    let mut asked = 0;
    for k in 0..=INCREMENTS {
        let all_points = points.iter().zip(&paths);
        // The first one is at rest.
        let f1 = |path: &[Matrix3<f64>]| if k == 0 { Matrix3::identity() } else { path[k - 1] };
        let given: Vec<PointInput> =
            all_points.map(|(point, path)| point.given(&f1(path), &unturned, session.material)).collect();
        for (i, given) in given.into_iter().enumerate() {
            // SAFETY: they take and give numbers, and change the flags of this thread alone.
            let (found, flags) = unsafe {
                feclearexcept(all);
                let found = session.call_law(time(k, session.material), std::slice::from_ref(&given));
                (found?, fetestexcept(all))
            };
            asked += 1;
            for (count, (bit, _)) in raised.iter_mut().zip(EXCEPTIONS) {
                *count += i32::from(flags & bit != 0);
            }
            if found[0].finite() {
                points[i] = points[i].after(&f1(&paths[i]), &unturned, &found[0]);
            }
        }
    }
    let found: Vec<(i32, &str)> = raised
        .into_iter()
        .zip(EXCEPTIONS)
        .filter(|(count, _)| *count > 0)
        .map(|(count, (_, name))| (count, name))
        .collect();
    if found.is_empty() {
        let text = format!("{asked} calls raise neither invalid, division by zero nor overflow");
        return Ok(Finding::new(Question::Exceptions, Verdict::Right, None, text));
    }
    let named: Vec<String> = found.iter().map(|(count, name)| format!("{name} in {count}")).collect();
    let text = format!("raised, of {asked} calls: {}; where they are trapped the job ends", named.join(", "));
    let mut line = Finding::new(Question::Exceptions, Verdict::Warning, None, text);
    line.kinds = found.iter().map(|(_, name)| name.to_string()).collect();
    Ok(line)
}

/// NaN at one point of a block: it must be seen there, and nowhere else.
///
/// # Errors
/// The system has no memory.
pub fn invalid(session: &mut Session) -> io::Result<Finding> {
    let paths = paths(session.material, 0x1a, SIZES[1], 1);
    let undeformed = Point::undeformed(session)?;
    let unturned = Matrix3::<f64>::identity();
    let mut given: Vec<PointInput> =
        paths.iter().map(|path| undeformed.given(&path[0], &unturned, session.material)).collect();
    let time = time(0, session.material);
    let right = session.call_law(time, &given)?;
    let middle = given.len() / 2;
    given[middle].stretch[1][0] = f64::NAN;
    given[middle].gradient[1][0] = f64::NAN;
    given[middle].strain_increment[0] = f64::NAN;
    let found = session.call_law(time, &given)?;
    let line = |verdict, text: &str| Finding::new(Question::Invalid, verdict, None, text);
    let spoilt = (0..found.len()).filter(|&i| i != middle && !found[i].has_same_bits(&right[i])).count();
    if spoilt > 0 {
        let text = format!("NaN at one point changes the answers at {spoilt} others of its block");
        return Ok(line(Verdict::Wrong, &text).with("answers depend on the block"));
    }
    if found[middle].stress.iter().any(|stress| stress.is_nan()) {
        return Ok(line(Verdict::Right, "NaN in: NaN, at that point alone"));
    }
    if session.material.explicit.deletion.is_some_and(|flag| found[middle].state[flag - 1] == 0.0) {
        return Ok(line(Verdict::Right, "NaN in: the point is deleted, and that one alone"));
    }
    Ok(line(Verdict::Warning, "NaN in: a finite stress, as if nothing were wrong"))
}

const HISTORIES: usize = 100_000;
const TIME: Duration = Duration::from_secs(6);
/// Increments of a random history.
const OF_HISTORY: usize = 4;

/// Very many short random histories from the initial call.
///
/// # Errors
/// The system has no memory.
pub fn histories(session: &mut Session, reads: Reads) -> io::Result<Finding> {
    let started = Instant::now();
    let mut rng = Rng::with_seed(session.material.seed ^ 0x10);
    let mut done = 0;
    while done < HISTORIES && started.elapsed() < TIME {
        let path = |_| {
            let target = state(&mut rng, session.material);
            let whole =
                Increment::between(&Matrix3::identity(), &target).turning_at_most(LARGEST_TURN * OF_HISTORY as f64);
            // Small ones too: from a millionth of the way to all of it.
            let part = if rng.bool() { 1.0 } else { 10f64.powf(-6.0 * rng.f64()) };
            // A law of increments is for increments like those of the file.
            let most = 2.0 * session.material.increment * OF_HISTORY as f64 / whole.strain.norm();
            let part = if reads == Reads::Total { part } else { part.min(most) };
            let along = |k: usize| whole.at(part * k as f64 / OF_HISTORY as f64, &Matrix3::identity());
            (1..=OF_HISTORY).map(along).collect::<Vec<_>>()
        };
        let paths: Vec<_> = (0..SIZES[2].min(HISTORIES - done)).map(path).collect();
        for (i, answers) in point::block(session, &paths)?.iter().enumerate() {
            if let Some(k) = answers.iter().position(|found| !found.finite()) {
                let text = format!(
                    "{} is not finite in increment {} of history {}",
                    not_finite(&answers[k]),
                    k + 1,
                    done + i + 1
                );
                return Ok(Finding::new(Question::Histories, Verdict::Wrong, None, text).with("NaN"));
            }
        }
        done += paths.len();
    }
    let text = format!("{done} random histories from the initial call, in blocks of {}", SIZES[2]);
    Ok(Finding::new(Question::Histories, Verdict::Right, None, text))
}

fn not_finite(found: &PointOutput) -> String {
    let first = |values: &[f64]| values.iter().position(|value| !value.is_finite());
    if let Some(c) = first(&found.stress) {
        format!("stressNew(:, {})", c + 1)
    } else if let Some(c) = first(&found.state) {
        format!("stateNew(:, {})", c + 1)
    } else {
        "an energy".to_string()
    }
}

/// A few blocks with a build that checks itself, and fills what is unset with NaN.
///
/// # Errors
/// The system has no memory.
pub fn runtime(session: &mut Session) -> io::Result<Finding> {
    for size in SIZES {
        let paths = paths(session.material, 0x6e, size, INCREMENTS);
        if let Some(found) = point::block(session, &paths)?.iter().flatten().find(|found| !found.finite()) {
            let text = format!(
                "{} of the build that fills unset reals with NaN is not finite: a variable is used unset",
                not_finite(found)
            );
            return Ok(Finding::new(Question::Runtime, Verdict::Wrong, None, text).with("runtime check"));
        }
    }
    let text = "bounds, unset reals (-fcheck=all -finit-real=snan): nothing found";
    Ok(Finding::new(Question::Runtime, Verdict::Right, None, text))
}
