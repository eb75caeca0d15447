//! Whether the answer turns with the axes: superposed rotations, and those of the reference where the law is isotropic
//! or has fibres.

use fastrand::Rng;
use nalgebra::{Matrix3, Vector3};

use super::call::Session;
use super::finding::{Finding, NOT_FINITE, Question, Verdict};
use super::histories::{LARGEST_TURN, history, rotation, turn};
use super::kinematics::Increment;
use super::material::{Material, Reads};
use super::point::{Failure, Point};
use super::tangent::EXCHANGED;

/// Of the stress.
const TOLERANCE: f64 = 1e-6;
const HISTORIES: usize = 24;
/// Increments of a history, at most.
const INCREMENTS: usize = 40;

/// What differs between two histories that should answer the same.
struct Worst {
    figure: f64,
    compared: usize,
    text: String,
    /// Histories that the law refuses turned, and not as they are.
    refused_turned: usize,
}

/// Superposed rotations: of a total law at once, of others in turns as solvers have them.
pub fn objectivity(session: &mut Session, reads: Reads) -> Finding {
    if session.material.separation.is_some() {
        return Finding::new(Question::Objectivity, Verdict::NotAsked, None, "tractions turn with their element");
    }
    if reads == Reads::Total { turned_at_once(session, reads) } else { at_small_turns(session, reads) }
}

/// A steady spin, which adds up to large turns. A law that integrates the spin itself errs with the square of the turn
/// at least.
fn at_small_turns(session: &mut Session, reads: Reads) -> Finding {
    let spin = |turn_of_one: f64| {
        move |rng: &mut Rng, material: &Material, _: usize, count: usize| {
            let axis = match material.components {
                6 => Vector3::from_fn(|_, _| 2.0 * rng.f64() - 1.0).normalize(),
                _ => Vector3::z(),
            };
            let turns = (0..count).map(|k| turn(axis * (turn_of_one * (k + 1) as f64))).collect();
            (format!("a spin of {:.1}° an increment", turn_of_one.to_degrees()), turns)
        }
    };
    // Each increment in parts, so that the turn in all stays.
    let asked =
        |session: &mut Session, parts: usize| compared(session, parts, |f, q| q * f, spin(LARGEST_TURN / parts as f64));
    let mut line = objective(session, reads, &|session| asked(session, 1));
    let (Verdict::Wrong, Some(figure)) = (line.verdict, line.figure) else { return line };
    let mut in_parts = |parts: usize| asked(session, parts).map_or(f64::INFINITY, |worst| worst.figure);
    let (half, quarter) = (in_parts(2), in_parts(4));
    if half < figure && quarter < FALLS * half {
        let text = format!(
            "right for small turns alone: the stress changes by {figure:.1e} of itself at 5° an increment, by {half:.1e} at \
             2.5°, by {quarter:.1e} at 1.25°"
        );
        line = Finding::new(Question::Objectivity, Verdict::Warning, Some(figure), text);
    } else {
        line.text.push_str(&format!("; in smaller turns by {half:.1e} at 2.5°, {quarter:.1e} at 1.25°"));
    }
    line
}

/// What half the turn leaves, at most, of an error that is of first order in it: a half, with some room.
const FALLS: f64 = 0.65;

/// The same of a law that reads increments and is right at small turns.
pub fn at_large_turns(session: &mut Session) -> Finding {
    turned_at_once(session, Reads::Mixed)
}

/// A quarter turn, half a turn and random ones in one increment.
fn turned_at_once(session: &mut Session, reads: Reads) -> Finding {
    let rotations = |rng: &mut Rng, material: &Material, number: usize, count: usize| -> (String, Vec<Matrix3<f64>>) {
        let z = Vector3::z();
        let half = std::f64::consts::FRAC_PI_2;
        let tilted = if material.components == 6 { Vector3::new(1.0, 0.0, 0.0) } else { z };
        match number % 4 {
            0 => ("a quarter turn in the last increment".into(), last(turn(tilted * half), count)),
            1 => ("half a turn in the last increment".into(), last(turn(z * 2.0 * half), count)),
            2 => ("a random turn in the last increment".into(), last(rotation(rng, material), count)),
            _ => ("a random turn in every increment".into(), (0..count).map(|_| rotation(rng, material)).collect()),
        }
    };
    objective(session, reads, &|session| compared(session, 1, |f, q| q * f, rotations))
}

fn objective(session: &mut Session, reads: Reads, asked: &dyn Fn(&mut Session) -> Result<Worst, String>) -> Finding {
    let worst = match asked(session) {
        Ok(worst) => worst,
        Err(text) => return Finding::new(Question::Objectivity, Verdict::Wrong, None, text).with(NOT_FINITE),
    };
    let mut line =
        rotation_finding(Question::Objectivity, NOT_OBJECTIVE, &worst, "superposed rotations turn the stress alone");
    if line.verdict == Verdict::Wrong && session.material.components == 6 {
        session.exchange(true);
        if asked(session).is_ok_and(|worst| worst.figure <= TOLERANCE) {
            line.kinds.push(EXCHANGED.to_string());
            line.text = format!("{EXCHANGED}: with 12 23 13 in the place of 12 13 23 it is right; {}", line.text);
        }
        session.exchange(false);
    }
    let mut line = with_halved_shears(session, line, asked);
    if line.verdict == Verdict::Wrong && line.figure.is_some() && line.kinds == [NOT_OBJECTIVE] {
        line.text.push_str(advice(session.material, reads));
    }
    line
}

const NOT_OBJECTIVE: &str = "not objective";

/// What a law of this kind may lack: only tensors in the states of a law of increments have to be turned, and only such
/// a law needs axes that turn.
fn advice(material: &Material, reads: Reads) -> &'static str {
    match (reads == Reads::Total, material.initial.len() < material.components.min(3)) {
        (true, _) => "",
        (false, true) => {
            "; a law with directions of its own needs orientation = true; without NLGEOM that does not matter"
        }
        (false, false) => {
            "; tensors in STATEV are to be turned by DROT (ROTSIG), and a law with directions of its own needs orientation = \
             true; without NLGEOM neither matters"
        }
    }
}

/// Rotations of the material before all else.
pub fn isotropy(session: &mut Session) -> Finding {
    let material = session.material;
    if !material.traits.isotropic && material.fibres.is_empty() {
        return Finding::new(Question::Isotropy, Verdict::NotAsked, None, "neither isotropic nor fibres are declared");
    }
    if material.is_diagonal() || material.orientation && !material.traits.isotropic {
        return Finding::new(Question::Isotropy, Verdict::NotAsked, None, "on the material's own axes");
    }
    let rotations = |rng: &mut Rng, material: &Material, number: usize, count: usize| {
        let q = if material.traits.isotropic {
            if number == 0 { turn(Vector3::z() * std::f64::consts::FRAC_PI_2) } else { rotation(rng, material) }
        } else {
            // Half a turn about a fibre leaves it, and others only if they are along it or across.
            turn(Vector3::from(material.fibres[0]) * std::f64::consts::PI)
        };
        ("the material turned beforehand".to_string(), vec![q; count])
    };
    if !material.traits.isotropic && !about_first_fibre(material) {
        let text = "no rotation leaves the fibres where they are";
        return Finding::new(Question::Isotropy, Verdict::NotAsked, None, text);
    }
    let asked = |session: &mut Session| compared(session, 1, |f, q| q * f * q.transpose(), rotations);
    match asked(session) {
        Ok(worst) => {
            let right = "turning the material turns the stress alone";
            with_halved_shears(session, rotation_finding(Question::Isotropy, "axes matter", &worst, right), &asked)
        }
        Err(text) => Finding::new(Question::Isotropy, Verdict::Wrong, None, text).with(NOT_FINITE),
    }
}

/// The kind of a law that takes engineering shears for those of the tensor.
const ENGINEERING_SHEARS: &str = "engineering shears";

/// What is wrong, and whether it is right where the law gets the shears of the tensor.
fn with_halved_shears(
    session: &mut Session,
    mut line: Finding,
    asked: &dyn Fn(&mut Session) -> Result<Worst, String>,
) -> Finding {
    if line.verdict != Verdict::Wrong {
        return line;
    }
    session.halve_shears(true);
    if asked(session).is_ok_and(|worst| worst.figure <= TOLERANCE && worst.compared > 0) {
        line.kinds = vec![ENGINEERING_SHEARS.to_string()];
        line.text = format!(
            "{ENGINEERING_SHEARS}: with half the shears of STRAN and DSTRAN, which are the tensor's, it is right; {}",
            line.text
        );
    }
    session.halve_shears(false);
    line
}

fn about_first_fibre(material: &Material) -> bool {
    let first = Vector3::from(material.fibres[0]);
    let planar = material.components == 6 || (first - Vector3::z()).norm() < 1e-12;
    let left = |fibre: &[f64; 3]| {
        let along = first.dot(&Vector3::from(*fibre)).abs();
        along < 1e-9 || (along - 1.0).abs() < 1e-9
    };
    planar && material.fibres.iter().all(left)
}

fn last(rotation: Matrix3<f64>, count: usize) -> Vec<Matrix3<f64>> {
    let mut rotations = vec![Matrix3::identity(); count];
    if let Some(last) = rotations.last_mut() {
        *last = rotation;
    }
    rotations
}

/// Random histories, and the same with rotations: the largest difference of the stress, over the largest stress of the
/// history. Each increment in so many equal parts, in its time.
///
/// What PNEWDT divides goes other ways turned and not, in between: as long as there are others, increments from there
/// on are not compared.
fn compared(
    session: &mut Session,
    parts: usize,
    turned: impl Fn(&Matrix3<f64>, &Matrix3<f64>) -> Matrix3<f64>,
    rotations: impl Fn(&mut Rng, &Material, usize, usize) -> (String, Vec<Matrix3<f64>>),
) -> Result<Worst, String> {
    let whole = compared_where(session, (parts, true), &turned, &rotations)?;
    if whole.compared > 0 { Ok(whole) } else { compared_where(session, (parts, false), &turned, &rotations) }
}

/// The same, of all increments or of those before the first that PNEWDT divides.
fn compared_where(
    session: &mut Session,
    (parts, whole): (usize, bool),
    turned: impl Fn(&Matrix3<f64>, &Matrix3<f64>) -> Matrix3<f64>,
    rotations: impl Fn(&mut Rng, &Material, usize, usize) -> (String, Vec<Matrix3<f64>>),
) -> Result<Worst, String> {
    let mut rng = Rng::with_seed(session.material.seed ^ 0x0b);
    let mut worst = Worst { figure: 0.0, compared: 0, text: String::new(), refused_turned: 0 };
    for number in 0..HISTORIES {
        let mut path = history(&mut rng, session.material, 2);
        path.truncate(INCREMENTS);
        let path = divided(&path, parts);
        let time_step = session.material.time_step / parts as f64;
        let (text, rotations) = rotations(&mut rng, session.material, number, path.len());
        // One after the other at one element and point: laws have tables by these, and may keep data by them.
        let turned: Vec<Matrix3<f64>> = path.iter().zip(&rotations).map(|(f, q)| turned(f, q)).collect();
        let plain = stresses(session, &path, time_step);
        let other = stresses(session, &turned, time_step);
        let mut largest = 0.0_f64;
        for (k, q) in rotations.iter().enumerate() {
            let (stress, seen) = match (&plain[k.min(plain.len() - 1)], &other[k.min(other.len() - 1)]) {
                (Ok((_, divided)), _) | (_, Ok((_, divided))) if whole && *divided => break,
                (Ok((stress, _)), Ok((seen, _))) => (stress, seen),
                (Err(Failure::NotFinite(_)), _) | (_, Err(Failure::NotFinite(_))) => {
                    return Err(format!("not finite with {text}"));
                }
                (Ok(_), Err(Failure::Refused)) => {
                    worst.refused_turned += 1;
                    break;
                }
                _ => break,
            };
            largest = largest.max(stress.norm());
            let difference = (seen - q * stress * q.transpose()).norm();
            if largest > 0.0 {
                worst.compared += 1;
                if difference / largest > worst.figure {
                    worst = Worst { figure: difference / largest, text: text.clone(), ..worst };
                }
            }
        }
    }
    Ok(worst)
}

/// The stress on global axes after an increment, and whether PNEWDT has divided it.
type Stress = (Matrix3<f64>, bool);

/// The stress after each increment; the last one may be why there is none.
fn stresses(session: &mut Session, path: &[Matrix3<f64>], time_step: f64) -> Vec<Result<Stress, Failure>> {
    let mut point = Point::undeformed(session, [1, 1]);
    let mut all = Vec::new();
    for f in path {
        let before = point.increments();
        let found = point.advance_in(session, f, time_step);
        let found = found.map(|_| (point.global_stress(session.material), point.increments() > before + 1));
        let ends = found.is_err();
        all.push(found);
        if ends {
            break;
        }
    }
    all
}

/// A path, each of its increments in so many equal parts.
pub fn divided(path: &[Matrix3<f64>], parts: usize) -> Vec<Matrix3<f64>> {
    let mut divided = Vec::new();
    let mut before = Matrix3::identity();
    for f in path {
        let increment = Increment::between(&before, f);
        divided.extend((1..=parts).map(|part| increment.at(part as f64 / parts as f64, &before)));
        before = *f;
    }
    divided
}

fn rotation_finding(question: Question, kind: &str, worst: &Worst, right: &str) -> Finding {
    if worst.figure <= TOLERANCE && worst.refused_turned > 0 {
        let text = format!(
            "{} of {HISTORIES} histories end with PNEWDT if they are turned, and not else",
            worst.refused_turned
        );
        let most = 2 * worst.refused_turned > HISTORIES;
        let verdict = if most { Verdict::Wrong } else { Verdict::Warning };
        return Finding::new(question, verdict, None, text).with(kind);
    }
    if worst.compared == 0 {
        return Finding::new(question, Verdict::NotSure, None, "there was no stress");
    }
    if worst.figure <= TOLERANCE {
        return Finding::new(
            question,
            Verdict::Right,
            Some(worst.figure),
            format!("{right}, {} increments", worst.compared),
        );
    }
    let text = format!("the stress changes by {:.2e} of itself with {}", worst.figure, worst.text);
    Finding::new(question, Verdict::Wrong, Some(worst.figure), text).with(kind)
}
