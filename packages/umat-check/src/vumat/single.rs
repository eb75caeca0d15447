//! The build for single precision: its answers are those of the double one but for rounding.

use std::io;

use nalgebra::Matrix3;

use super::super::finding::{Finding, Question, Verdict};
use super::super::guarded::Guard;
use super::super::material::Reads;
use super::blocks::{SIZES, paths};
use super::call::{Law, PointInput, Precision, Session};
use super::point::{Point, time};

/// In roundings: what single precision costs a law that is written well, and some room.
const ROUNDINGS: f64 = 100.0;
const INCREMENTS: usize = 12;

/// Each call of the double build, its numbers rounded beforehand, to the other one too.
///
/// # Errors
/// The system has no memory.
pub fn single(session: &mut Session, reads: Reads) -> io::Result<Finding> {
    let Some(built) = &session.material.explicit.single else {
        let text = "no second build with real*4: the source has no vaba_param.inc, or is a library (--single)";
        return Ok(Finding::new(Question::Single, Verdict::NotAsked, None, text));
    };
    let library = match built {
        Ok(library) => library,
        Err(reason) => {
            let reason = reason.lines().find(|line| line.contains("Error")).unwrap_or(reason);
            let text = format!("does not compile with real*4: {}", reason.trim());
            return Ok(Finding::new(Question::Single, Verdict::Wrong, None, text).with("does not compile"));
        }
    };
    let law = match Law::load(library) {
        Ok(law) => law,
        Err(reason) => return Ok(Finding::new(Question::Single, Verdict::NotSure, None, reason)),
    };
    let mut other = Session::new(&law, session.material, Precision::Single, Guard::Padded, None);
    let paths = paths(session.material, 0x51, SIZES[1], INCREMENTS);
    let undeformed = Point::undeformed(session)?;
    let mut points = vec![undeformed; paths.len()];
    let unturned = Matrix3::<f64>::identity();
    // The largest of stress over strain: a stiffness.
    let mut stiffness = 0.0_f64;
    let mut differences = Vec::new();
    for k in 0..INCREMENTS {
        let given: Vec<PointInput> = points
            .iter()
            .zip(&paths)
            .map(|(point, path)| rounded(point.given(&path[k], &unturned, session.material)))
            .collect();
        let time = time(k, session.material);
        let (double, single) = (session.call_law(time, &given)?, other.call_law(time, &given)?);
        for (i, (double, single)) in double.iter().zip(&single).enumerate() {
            if double.finite() && !single.finite() {
                let text = format!("not finite at increment {} of single precision, and is of double", k + 1);
                return Ok(Finding::new(Question::Single, Verdict::Wrong, None, text).with("NaN"));
            }
            let deleted = session.material.explicit.deletion;
            let same = deleted.is_none_or(|flag| double.state[flag - 1] == single.state[flag - 1]);
            if double.finite() && same {
                let norm = |values: &[f64; 6]| values.iter().map(|value| value * value).sum::<f64>().sqrt();
                let change: [f64; 6] = std::array::from_fn(|c| double.stress[c] - given[i].stress[c]);
                stiffness = stiffness.max(norm(&change) / norm(&given[i].strain_increment).max(1e-6));
                let difference: [f64; 6] = std::array::from_fn(|c| double.stress[c] - single.stress[c]);
                // A law of stretches loses what U of about 1 loses, times the stiffness; one of increments does not.
                let strain = if reads == Reads::Rate { norm(&given[i].strain_increment) } else { 1.0 };
                differences.push((norm(&difference), norm(&double.stress), strain, k + 1));
            }
            points[i] = points[i].after(&paths[i][k], &unturned, double);
        }
    }
    Ok(precision_finding(&differences, stiffness, reads))
}

/// The line, of differences of the stress with the stress, the strain that they are measured by, and the increment.
fn precision_finding(differences: &[(f64, f64, f64, usize)], stiffness: f64, reads: Reads) -> Finding {
    if stiffness == 0.0 {
        return Finding::new(Question::Single, Verdict::NotSure, None, "there was no stress");
    }
    let mut worst = (0.0_f64, String::new());
    for &(difference, stress, strain, increment) in differences {
        let figure = difference / (stiffness * strain + stress);
        if figure > worst.0 {
            worst = (figure, format!("at increment {increment}"));
        }
    }
    let (figure, place) = worst;
    let roundings = figure / f64::from(f32::EPSILON);
    let of = if reads == Reads::Rate { "stress" } else { "stiffness" };
    if roundings <= ROUNDINGS {
        let text = format!("with real*4 the stress differs by {roundings:.1} roundings of the {of} at most");
        return Finding::new(Question::Single, Verdict::Right, Some(figure), text);
    }
    let text = format!(
        "with real*4 the stress differs by {roundings:.0} roundings of the {of}, {place}; up to {ROUNDINGS:.0} are right"
    );
    Finding::new(Question::Single, Verdict::Wrong, Some(figure), text).with("single precision")
}

/// All numbers as single precision has them, so that both builds get the same ones.
fn rounded(given: PointInput) -> PointInput {
    let single = |value: f64| f64::from(value as f32);
    PointInput {
        density: single(given.density),
        strain_increment: given.strain_increment.map(single),
        spin: given.spin.map(single),
        stretch: given.stretch.map(|values| values.map(single)),
        gradient: given.gradient.map(|values| values.map(single)),
        stress: given.stress.map(single),
        state: given.state.into_iter().map(single).collect(),
        energies: given.energies.map(single),
        temperature: single(given.temperature),
    }
}
