//! Whether a point that has not been deformed has stress.

use nalgebra::{DMatrix, Matrix3};

use super::call::Session;
use super::finding::{Finding, NOT_FINITE, Question, Verdict};
use super::kinematics::Modulus;
use super::point::Point;

/// Of the stiffness, what counts as no stress.
const TOLERANCE: f64 = 1e-9;
/// Of the largest: what stiffness counts as none, and is no negative one.
const NO_STIFFNESS: f64 = 1e-6;

pub fn rest(session: &mut Session) -> Finding {
    let point = Point::undeformed(session, [1, 1]);
    let call = point.call(&Matrix3::identity(), session.material);
    let answer = session.call_law(&call);
    if !answer.finite() {
        let begins = &session.material.initial;
        let hint = if begins.is_empty() || begins.iter().any(|state| *state != 0.0) {
            ""
        } else {
            "; STATEV begins at zero: does the law need values there (initial, SDVINI)?"
        };
        let text = format!("stress, state or DDSDDE is not finite at rest{hint}");
        return Finding::new(Question::Rest, Verdict::Wrong, None, text).with(NOT_FINITE);
    }
    if answer.refused() {
        let text = "PNEWDT asks for a smaller increment at rest, where nothing is deformed";
        return Finding::new(Question::Rest, Verdict::Wrong, None, text).with("refused");
    }
    let largest =
        |values: &mut dyn Iterator<Item = &f64>| values.fold(0.0_f64, |largest, value| largest.max(value.abs()));
    let stiffness = largest(&mut answer.modulus.iter().flatten());
    // A stress that is there from the beginning stays.
    let left: Vec<f64> = answer.stress.iter().zip(&point.stress).map(|(a, b)| a - b).collect();
    let stress = largest(&mut left.iter());
    // Under a stress from the beginning DDSDDE has its terms too.
    if largest(&mut point.stress.iter()) == 0.0
        && let Some((least, most)) = negative_stiffness(&answer.modulus, session.material.components)
    {
        let text = format!(
            "DDSDDE at rest is no stiffness: its eigenvalues go from {least:.2e} to {most:.2e}; is the order of PROPS that \
             of the law, and are they possible together (Poisson's ratios)?"
        );
        return Finding::new(Question::Rest, Verdict::Wrong, Some(least / least.abs().max(most)), text)
            .with("negative stiffness");
    }
    if stress == 0.0 {
        return Finding::new(Question::Rest, Verdict::Right, Some(0.0), "no stress at rest");
    }
    let figure = stress / stiffness.max(f64::MIN_POSITIVE);
    if figure <= TOLERANCE {
        return Finding::new(Question::Rest, Verdict::Right, Some(figure), "stress over stiffness at rest");
    }
    let text = format!("stress of {stress:.3e} at rest, over a stiffness of {stiffness:.3e}");
    Finding::new(Question::Rest, Verdict::Wrong, Some(figure), text).with("stress at rest")
}

/// The least and the largest stiffness of DDSDDE's symmetric part, if the least is negative.
fn negative_stiffness(modulus: &Modulus, components: usize) -> Option<(f64, f64)> {
    // Of a strain 33 in plane strain nothing is known.
    let asked: Vec<usize> = (0..components).filter(|&k| components != 4 || k != 2).collect();
    let symmetric = DMatrix::from_fn(asked.len(), asked.len(), |i, j| {
        0.5 * (modulus[asked[i]][asked[j]] + modulus[asked[j]][asked[i]])
    });
    let values = symmetric.symmetric_eigenvalues();
    let (least, most, size) = (values.min(), values.max(), values.amax());
    (least < -NO_STIFFNESS * size).then_some((least, most))
}
