//! Variables that are not set and reach only a comparison, so that nothing of the answer is NaN: whether the answers
//! are those of another fill.

use super::call::Session;
use super::finding::{Finding, Question, Verdict};
use super::process;

/// The kind of an answer that changes with what variables hold that are not set.
pub const UNSET: &str = "unset variable";

/// Numbers of the stress and of DDSDDE in an answer.
const STRESS: usize = 6;
const MODULUS: usize = 36;
const ENERGIES: usize = 3;

/// The bits of stress, state, DDSDDE and energies along a few histories.
pub fn answers(session: &mut Session) -> Vec<u64> {
    let all = process::answers_of(session, 0x6e, 8, 40);
    let numbers = all.iter().flat_map(|answer| {
        let stress_and_state = answer.stress.into_iter().chain(answer.state.iter().copied());
        stress_and_state.chain(answer.modulus.into_iter().flatten()).chain(answer.energies)
    });
    numbers.map(f64::to_bits).collect()
}

/// The line where two builds answer otherwise that differ in what they fill unset variables with, and in nothing else:
/// no bit may differ. `states` is NSTATV, none where the answers are stresses alone; `named` are the variables that the
/// compiler sees unset, and `saved` whether some keep their value from call to call.
pub fn line(filled: &[u64], zeroed: &[u64], states: Option<usize>, named: &[String], saved: bool) -> Option<Finding> {
    let what = difference(filled, zeroed, states)?;
    let text = format!("another answer with unset variables of zero than of NaN, -77777777, .TRUE.: {what}");
    let line = |verdict, text: String| Finding::new(Question::Runtime, verdict, None, text).with(UNSET);
    Some(match (named, saved) {
        ([], true) => line(Verdict::Warning, format!("{text}; a variable of SAVE without DATA, perhaps")),
        ([], false) => line(Verdict::Wrong, text),
        _ => line(Verdict::Wrong, format!("{text}; by gfortran used unset: {}", named.join(", "))),
    })
}

/// What differs first: the stress, then a state variable, then DDSDDE, then an energy.
fn difference(filled: &[u64], zeroed: &[u64], states: Option<usize>) -> Option<String> {
    let length = states.map_or(STRESS, |states| STRESS + states + MODULUS + ENERGIES);
    if filled == zeroed {
        return None;
    }
    if filled.len() != zeroed.len() {
        return Some("increments have no answer".to_string());
    }
    let pairs = || filled.chunks(length).zip(zeroed.chunks(length));
    let (mut largest, mut size) = (0.0_f64, 0.0_f64);
    for (one, other) in pairs() {
        for (one, other) in one.iter().zip(other).take(STRESS) {
            let [one, other] = [one, other].map(|bits| f64::from_bits(*bits));
            largest = largest.max((one - other).abs());
            size = size.max(other.abs());
        }
    }
    if largest > 0.0 {
        return Some(format!("the stress by {:.1e} of itself", largest / size.max(f64::MIN_POSITIVE)));
    }
    let entry = pairs().find_map(|(one, other)| one.iter().zip(other).position(|(one, other)| one != other));
    // The sign of a zero is no difference.
    Some(match (entry, states) {
        (Some(entry), Some(states)) if (STRESS..STRESS + states).contains(&entry) => {
            format!("STATEV({})", entry - STRESS + 1)
        }
        (Some(entry), Some(states)) if entry >= STRESS + states + MODULUS => "SSE, SPD or SCD".to_string(),
        (Some(entry), _) if entry >= STRESS => "DDSDDE".to_string(),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bits(numbers: &[f64]) -> Vec<u64> {
        numbers.iter().map(|number| number.to_bits()).collect()
    }

    #[test]
    fn what_differs_is_named() {
        let mut zeroed = vec![1.0; STRESS + 2 + MODULUS + ENERGIES];
        let same = bits(&zeroed);
        assert_eq!(difference(&same, &same, Some(2)), None);
        zeroed[STRESS + 1] = 2.0;
        assert_eq!(difference(&same, &bits(&zeroed), Some(2)).as_deref(), Some("STATEV(2)"));
        zeroed[2] = 2.0;
        assert_eq!(difference(&same, &bits(&zeroed), Some(2)).as_deref(), Some("the stress by 5.0e-1 of itself"));
        assert_eq!(difference(&same[1..], &same, Some(2)).as_deref(), Some("increments have no answer"));
        let mut modulus = vec![1.0; STRESS + 2 + MODULUS + ENERGIES];
        modulus[STRESS + 2] = 0.0;
        assert_eq!(difference(&same, &bits(&modulus), Some(2)).as_deref(), Some("DDSDDE"));
        let mut energy = vec![1.0; STRESS + 2 + MODULUS + ENERGIES];
        energy[STRESS + 2 + MODULUS + 1] = 0.0;
        assert_eq!(difference(&same, &bits(&energy), Some(2)).as_deref(), Some("SSE, SPD or SCD"));
    }

    #[test]
    fn a_saved_variable_is_only_warned_of() {
        let (one, other) = (bits(&[1.0; STRESS]), bits(&[2.0; STRESS]));
        let verdict = |named: &[String], saved| line(&one, &other, None, named, saved).map(|line| line.verdict);
        assert_eq!(verdict(&[], true), Some(Verdict::Warning));
        assert_eq!(verdict(&[], false), Some(Verdict::Wrong));
        assert_eq!(verdict(&["q (a.f:12)".to_string()], true), Some(Verdict::Wrong));
    }
}
