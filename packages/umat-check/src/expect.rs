//! Known answers: paths of strain, free where the stress is zero, and the stress at their ends. A law that is wrong
//! consistently, in plane stress say, passes every other question.

use nalgebra::{DMatrix, DVector, Matrix3};
use serde::{Deserialize, Serialize};

use super::call::Session;
use super::finding::{Finding, Question, Verdict};
use super::kinematics::{Components, exp, name, strain_tensor};
use super::mistakes::percent;
use super::point::{Failure, Point};

/// A known answer.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Expected {
    /// Where the numbers are from.
    pub source: String,
    /// The corners of the path behind the undeformed state: logarithmic strains, shears twice the tensor's; none where
    /// a component is free, without stress.
    pub path: Vec<[Option<f64>; 6]>,
    /// The Cauchy stress at the last corner; none where it is not known.
    pub stress: [Option<f64>; 6],
    /// Of the largest stress that is given.
    pub tolerance: f64,
    /// Increments from corner to corner.
    pub increments: usize,
    /// Time from corner to corner.
    pub time: f64,
}

pub fn expect(session: &mut Session) -> Finding {
    let all = &session.material.expected;
    let line = |verdict, figure, text: String| Finding::new(Question::Expect, verdict, figure, text);
    if all.is_empty() {
        return line(Verdict::NotAsked, None, "no known answer is given ([[expect]])".to_string());
    }
    let mut worst = 0.0_f64;
    for (number, expected) in all.iter().enumerate() {
        let of = format!("answer {} ({})", number + 1, expected.source);
        let stress = match stress_at_end(session, expected) {
            Ok(stress) => stress,
            Err(why) => return line(Verdict::Wrong, None, format!("{of}: {why}")).with("known answer"),
        };
        let size = expected.stress.iter().flatten().fold(f64::MIN_POSITIVE, |size, stress| size.max(stress.abs()));
        for (i, wanted) in expected.stress.iter().enumerate() {
            let Some(wanted) = wanted else { continue };
            let figure = (stress[i] - wanted).abs() / size;
            worst = worst.max(figure / expected.tolerance);
            if figure.is_nan() || figure > expected.tolerance {
                let component = name(session.material.layout(), i);
                let text = format!(
                    "{of}: the stress {component} is {:.6e} instead of {wanted:.6e}, by {} of the largest; allowed: {}",
                    stress[i],
                    percent(figure),
                    percent(expected.tolerance)
                );
                return line(Verdict::Wrong, Some(figure), text).with("known answer");
            }
        }
    }
    let text = format!("{} known answers, within {worst:.1e} of what each allows", all.len());
    line(Verdict::Right, Some(worst), text)
}

fn stress_at_end(session: &mut Session, expected: &Expected) -> Result<Components, String> {
    let mut point = Point::undeformed(session, [1, 1]);
    let mut strain = [0.0; 6];
    for corner in &expected.path {
        let begin = strain;
        for k in 1..=expected.increments {
            let part = k as f64 / expected.increments as f64;
            for (i, end) in corner.iter().enumerate() {
                if let Some(end) = end {
                    let end = end / session.material.unit_of_strain();
                    strain[i] = begin[i] + (end - begin[i]) * part;
                }
            }
            let time_step = expected.time / expected.increments as f64;
            (strain, point) = balanced(session, &point, strain, corner, time_step)?;
        }
    }
    Ok(super::kinematics::of_stress(&point.global_stress(session.material), session.material.layout()))
}

/// Iterations for the free components, their step of strain for differences, and what is left of the stress over the
/// stiffness.
const ITERATIONS: usize = 40;
const STEP: f64 = 1e-7;
const BALANCED: f64 = 1e-10;

/// The strains at which the free components have no stress, and the point there.
fn balanced(
    session: &mut Session,
    before: &Point,
    mut strain: Components,
    corner: &[Option<f64>; 6],
    time_step: f64,
) -> Result<(Components, Point), String> {
    let (components, layout) = (session.material.components, session.material.layout());
    let free: Vec<usize> = (0..components).filter(|&i| corner[i].is_none()).collect();
    let mut after = |strain: &Components| {
        let mut point = before.clone();
        let f: Matrix3<f64> = exp(&strain_tensor(strain, layout));
        match point.advance_in(session, &f, time_step) {
            Ok(_) => Ok(point),
            Err(Failure::Refused) => Err("the law asks for ever smaller increments".to_string()),
            Err(Failure::NotFinite(_)) => Err("what comes back is not finite".to_string()),
        }
    };
    for _ in 0..ITERATIONS {
        let point = after(&strain)?;
        if free.is_empty() {
            return Ok((strain, point));
        }
        let mut columns = Vec::new();
        for &j in &free {
            let mut other = strain;
            other[j] += STEP;
            columns.push(after(&other)?);
        }
        let stiffness = DMatrix::from_fn(free.len(), free.len(), |i, j| {
            (columns[j].stress[free[i]] - point.stress[free[i]]) / STEP
        });
        let left = DVector::from_fn(free.len(), |i, _| point.stress[free[i]]);
        if left.amax() <= BALANCED * stiffness.amax() {
            return Ok((strain, point));
        }
        let change = stiffness.lu().solve(&left).ok_or("a free component has no stiffness")?;
        for (&i, change) in free.iter().zip(change.iter()) {
            strain[i] -= change.clamp(-LARGEST, LARGEST);
        }
    }
    Err(format!("no strain is found in {ITERATIONS} iterations at which the free components have no stress"))
}

/// The largest change of a strain in an iteration.
const LARGEST: f64 = 0.02;
