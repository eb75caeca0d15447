//! Whether the stress moves in steps, as a variable of single precision makes it: differences cannot be taken of it,
//! and Newton's method does not get beyond it.

use super::call::Session;
use super::kinematics::{Modulus, exp, unit_strain};
use super::tangent::State;

/// The kind of a stress that moves in steps.
pub const NOISE: &str = "steps of the stress";
/// The kind where a variable of single precision is known.
pub const SINGLE: &str = "single precision";

/// States and points of each direction of strain at which the stress is asked.
const STATES: usize = 4;
const POINTS: usize = 24;
/// Their strains: some times the rounding of single precision, so that what is smooth is straight.
const RANGE: f64 = 3.3e-6;
/// Steps of the stress over the stiffness between which a variable of single precision is likely.
const LEAST: f64 = 2e-9;

/// The largest departure of the stress from a parabola in small strains, over the stiffness; none where it is rounding.
pub fn steps(session: &mut Session, states: &[State], truth: impl Fn(&State) -> Option<Modulus>) -> Option<f64> {
    let components = session.material.components;
    let mut worst = 0.0_f64;
    let spread = states.len().div_ceil(STATES).max(1);
    for state in states.iter().step_by(spread) {
        let Some(truth) = truth(state) else { continue };
        let stiffness = truth.iter().flatten().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
        for column in 0..components {
            let Some(rows) = stresses(session, state, column) else { continue };
            for row in 0..components {
                let values: Vec<f64> = rows.iter().map(|stress| stress[row]).collect();
                worst = worst.max(departure(&values) / stiffness.max(f64::MIN_POSITIVE));
            }
        }
    }
    (worst > LEAST).then_some(worst)
}

fn stresses(session: &mut Session, state: &State, column: usize) -> Option<Vec<[f64; 6]>> {
    let strain = unit_strain(session.material.layout(), column);
    let stress = |k: usize| {
        let size = RANGE * (k as f64 / (POINTS - 1) as f64 - 0.5);
        let mut call = state.call.clone();
        call.strain_increment[column] += size;
        call.f1 = exp(&(strain * size)) * state.call.f1;
        let answer = session.call_law(&call);
        (!answer.refused() && answer.stress.iter().all(|value| value.is_finite())).then_some(answer.stress)
    };
    (0..POINTS).map(stress).collect()
}

/// The typical departure of numbers at equal distances from the straight line of their neighbours, without the largest
/// ones, which a single kink makes.
fn departure(values: &[f64]) -> f64 {
    let mut second: Vec<f64> = values.windows(3).map(|three| (three[0] - 2.0 * three[1] + three[2]).abs()).collect();
    second.sort_by(f64::total_cmp);
    second[second.len() - 1 - OF_KINKS]
}

/// So many second differences may be those of kinks.
const OF_KINKS: usize = 4;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_told_from_what_is_smooth_and_from_a_kink() {
        let at = |k: usize| RANGE * k as f64 / (POINTS - 1) as f64;
        let smooth: Vec<f64> = (0..POINTS).map(|k| (1.0 + at(k)).exp()).collect();
        let kink: Vec<f64> = (0..POINTS).map(|k| at(k).max(RANGE / 2.0)).collect();
        let steps: Vec<f64> = (0..POINTS).map(|k| f64::from((1.0 + at(k)) as f32)).collect();
        assert!(departure(&smooth) < LEAST && departure(&kink) < LEAST);
        assert!(departure(&steps) > LEAST, "{}", departure(&steps));
    }
}
