//! On which axes a law answers: superposed rotations, the material turned beforehand, increments in two.

use std::io;

use fastrand::Rng;
use nalgebra::Matrix3;

use super::super::finding::{Finding, Question, Verdict};
use super::super::histories::{history, rotation};
use super::super::kinematics::rotation_of;
use super::super::material::Reads;
use super::super::objectivity::divided;
use super::super::steps::Shares;
use super::call::{Misread, PointInput, Session};
use super::point::{self, Point, tensor, time};

/// Of the stress.
const TOLERANCE: f64 = 1e-6;
/// Of the stress of a hyperelastic law whose increments are halved.
const SAME: f64 = 1e-8;
const HISTORIES: usize = 24;
/// Increments of a history, at most.
const INCREMENTS: usize = 40;

/// Which arguments change the stress.
#[derive(Clone, Copy, Default)]
struct Arguments {
    stretch: bool,
    gradient: bool,
    increments: bool,
}

/// Changes one argument at a time along histories.
fn arguments(session: &mut Session) -> io::Result<Arguments> {
    let mut rng = Rng::with_seed(session.material.seed ^ 0x4e);
    let mut read = Arguments::default();
    let unturned = Matrix3::<f64>::identity();
    let other = Matrix3::new(1.01, 0.004, 0.0, 0.004, 0.995, 0.0, 0.0, 0.0, 1.003);
    for _ in 0..6 {
        let mut point = Point::undeformed(session)?;
        for (k, f1) in history(&mut rng, session.material, 2).iter().take(20).enumerate() {
            let given = point.given(f1, &unturned, session.material);
            let further = point.given(&(f1 * other), &unturned, session.material);
            let changes: [PointInput; 4] = [
                PointInput { stretch: [given.stretch[0], further.stretch[1]], ..given.clone() },
                PointInput { gradient: [given.gradient[0], further.gradient[1]], ..given.clone() },
                PointInput { strain_increment: further.strain_increment, ..given.clone() },
                // A law of increments of U or F is one of rates too.
                PointInput {
                    stretch: [further.stretch[1], given.stretch[1]],
                    gradient: [further.gradient[1], given.gradient[1]],
                    ..given.clone()
                },
            ];
            let all: Vec<PointInput> = [given].into_iter().chain(changes).collect();
            let found = session.call_law(time(k, session.material), &all)?;
            if !found[0].finite() {
                break;
            }
            let size = found[0].stress.iter().fold(0.0_f64, |size, stress| size.max(stress.abs()));
            let changed = |i: usize| {
                let difference = found[i].stress.iter().zip(&found[0].stress).map(|(a, b)| (a - b).abs());
                !difference.fold(0.0, f64::max).le(&(1e-12 * size))
            };
            read.stretch |= changed(1);
            read.gradient |= changed(2);
            read.increments |= changed(3) || changed(4);
            point = point.after(f1, &unturned, &found[0]);
        }
    }
    Ok(read)
}

/// What the law reads.
///
/// # Errors
/// The system has no memory.
pub fn reads(session: &mut Session) -> io::Result<Reads> {
    let Arguments { stretch, gradient, increments } = arguments(session)?;
    Ok(match (stretch || gradient, increments) {
        (true, true) => Reads::Mixed,
        (false, true) => Reads::Rate,
        _ => Reads::Total,
    })
}

/// Superposed rotations, which defgradOld and defgradNew alone see: stretch and strain are on axes that turn along.
///
/// # Errors
/// The system has no memory.
pub fn objectivity(session: &mut Session) -> io::Result<Finding> {
    if session.material.explicit.stretch_alone {
        let text = "defgradNew = U alone is declared: no argument sees a rotation";
        return Ok(Finding::new(Question::Objectivity, Verdict::NotAsked, None, text));
    }
    let read = arguments(session)?;
    let mut rng = Rng::with_seed(session.material.seed ^ 0x0b);
    // The largest difference from the same stress, and from the same stress turned by R.
    let (mut figure, mut from_global, mut compared) = (0.0_f64, 0.0_f64, 0);
    for _ in 0..HISTORIES {
        let (mut plain, mut turned) = (Point::undeformed(session)?, Point::undeformed(session)?);
        let mut largest = 0.0_f64;
        for (k, f1) in history(&mut rng, session.material, 2).iter().take(INCREMENTS).enumerate() {
            let turn = rotation(&mut rng, session.material);
            // The plain one without any rotation, its own included.
            let r = rotation_of(f1);
            let without = plain.given(f1, &r.transpose(), session.material);
            let with = turned.given(f1, &turn, session.material);
            let found = session.call_law(time(k, session.material), &[without, with])?;
            if !found.iter().all(|found| found.finite()) {
                let text = "not finite with superposed rotations";
                return Ok(Finding::new(Question::Objectivity, Verdict::Wrong, None, text).with("NaN"));
            }
            let [stress, seen] = [0, 1].map(|i| tensor(&found[i].stress));
            largest = largest.max(stress.norm());
            if largest > 0.0 {
                compared += 1;
                let whole = turn * r;
                figure = figure.max((seen - stress).norm() / largest);
                from_global = from_global.max((seen - whole * stress * whole.transpose()).norm() / largest);
            }
            plain = plain.after(f1, &r.transpose(), &found[0]);
            turned = turned.after(f1, &turn, &found[1]);
        }
    }
    let line = |verdict, text: String| Finding::new(Question::Objectivity, verdict, Some(figure), text);
    if compared == 0 {
        return Ok(Finding::new(Question::Objectivity, Verdict::NotSure, None, "there was no stress"));
    }
    let of = match (read.gradient, read.stretch, read.increments) {
        (true, ..) => "defgradNew is read",
        (false, true, true) => "stretchNew and increments are read, defgradNew is not",
        (false, true, false) => "stretchNew is read, defgradNew is not",
        _ => "strainInc is read, defgradNew is not",
    };
    if figure <= TOLERANCE {
        let text = format!("superposed rotations change nothing; {of}; assumed is R U, {compared} increments");
        return Ok(line(Verdict::Right, text));
    }
    if from_global <= TOLERANCE {
        let text = format!(
            "stress on global axes: with defgradNew = R U, as assumed, it turns with R, and should not (changes by \
             {figure:.2e} of itself); right only where defgradNew is U alone: defgrad = \"U\""
        );
        return Ok(line(Verdict::Wrong, text).with("stress on global axes"));
    }
    let text =
        format!("a superposed rotation (defgradNew = R U is assumed) changes the stress by {figure:.2e} of itself");
    Ok(line(Verdict::Wrong, text).with("not objective"))
}

/// Rotations of the material before all else.
///
/// # Errors
/// The system has no memory.
pub fn isotropy(session: &mut Session) -> io::Result<Finding> {
    if !session.material.traits.isotropic {
        return Ok(Finding::new(Question::Isotropy, Verdict::NotAsked, None, "isotropic is not declared"));
    }
    let Some((figure, compared)) = anisotropy(session)? else {
        return Ok(Finding::new(Question::Isotropy, Verdict::NotSure, None, "there was no stress"));
    };
    if figure <= TOLERANCE {
        let text = format!("turning the material turns the stress alone, {compared} increments");
        return Ok(Finding::new(Question::Isotropy, Verdict::Right, Some(figure), text));
    }
    let text = format!("the stress changes by {figure:.2e} of itself with the material turned beforehand");
    let line =
        |text: String, kind: &str| Finding::new(Question::Isotropy, Verdict::Wrong, Some(figure), text).with(kind);
    if session.material.components == 6 {
        for misread in Misread::ALL {
            session.misread = Some(misread);
            let found = anisotropy(session)?;
            session.misread = None;
            if found.is_some_and(|(figure, _)| figure <= TOLERANCE) {
                let kind = misread.name();
                return Ok(line(format!("{kind}: altered back, it is right; {text}"), kind));
            }
        }
    }
    Ok(line(text, "axes matter"))
}

/// The largest change of the stress with the material turned beforehand, and of how many increments; none without
/// stress.
fn anisotropy(session: &mut Session) -> io::Result<Option<(f64, usize)>> {
    let mut rng = Rng::with_seed(session.material.seed ^ 0x0c);
    let (mut figure, mut compared) = (0.0_f64, 0);
    for _ in 0..HISTORIES {
        let mut path = history(&mut rng, session.material, 2);
        path.truncate(INCREMENTS);
        let q = rotation(&mut rng, session.material);
        let turned = path.iter().map(|f| q * f * q.transpose()).collect();
        let found = point::block(session, &[path, turned])?;
        let mut largest = 0.0_f64;
        for (plain, other) in found[0].iter().zip(&found[1]) {
            if !plain.finite() || !other.finite() {
                break;
            }
            let [stress, seen] = [plain, other].map(|found| tensor(&found.stress));
            largest = largest.max(stress.norm());
            if largest > 0.0 {
                compared += 1;
                figure = figure.max((seen - q * stress * q.transpose()).norm() / largest);
            }
        }
    }
    Ok((compared > 0).then_some((figure, compared)))
}

/// Each increment in one, and in two.
///
/// # Errors
/// The system has no memory.
pub fn steps(session: &mut Session) -> io::Result<Finding> {
    let mut rng = Rng::with_seed(session.material.seed ^ 0x57);
    let (mut figure, mut compared, mut shares) = (0.0_f64, 0, Shares::default());
    for _ in 0..HISTORIES {
        let mut path = history(&mut rng, session.material, 2);
        path.truncate(INCREMENTS / 2);
        let mut of_parts = Vec::new();
        for parts in [1, 2, 4] {
            let found = point::history(session, &divided(&path, parts))?;
            let ends = found.iter().skip(parts - 1).step_by(parts);
            of_parts.push(ends.map(|found| tensor(&found.stress)).collect::<Vec<_>>());
        }
        let mut largest = 0.0_f64;
        for ((one, two), four) in of_parts[0].iter().zip(&of_parts[1]).zip(&of_parts[2]) {
            largest = largest.max(one.norm());
            if largest > 0.0 {
                compared += 1;
                figure = figure.max((one - two).norm() / largest);
                shares.add([one, two, four], one.norm());
            }
        }
    }
    if compared == 0 {
        return Ok(Finding::new(Question::Steps, Verdict::NotSure, None, "there was no stress"));
    }
    if let Some(line) = shares.not_added_up() {
        return Ok(line);
    }
    if !session.material.traits.hyperelastic {
        return Ok(Finding::new(Question::Steps, Verdict::NotAsked, None, "hyperelastic is not declared"));
    }
    if figure <= SAME {
        let text = "an increment in two gives the same stress";
        return Ok(Finding::new(Question::Steps, Verdict::Right, Some(figure), text));
    }
    let text = format!("an increment in two changes the stress by {figure:.2e} of itself");
    Ok(Finding::new(Question::Steps, Verdict::Wrong, Some(figure), text).with("steps matter"))
}
