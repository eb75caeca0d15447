//! The level of all intervals, and where those of a likelihood ratio end.

use statrs::distribution::{ContinuousCDF, Normal};

use super::root::root;

/// The level of all intervals.
pub const LEVEL: f64 = 0.95;

/// Twice the logarithm of a likelihood ratio beyond which one value is refused: the quantile of χ² with one degree of
/// freedom.
pub fn refusal() -> f64 {
    refusal_at(LEVEL)
}

/// The same of another level.
pub fn refusal_at(level: f64) -> f64 {
    Normal::standard().inverse_cdf(0.5 + 0.5 * level).powi(2)
}

/// Where a function that rises away from `start` passes `level`, sought outwards from a step of `first` on, each twice
/// the one before; none where it does not within `farthest`. Where it is no number it has passed.
pub fn crossing(of: impl Fn(f64) -> f64, start: f64, first: f64, level: f64, farthest: f64) -> Option<f64> {
    let left = |place: f64| level - of(place);
    let (mut inside, mut step) = (start, first);
    while step.abs() <= farthest {
        let outside = start + step;
        let value = left(outside);
        if value <= 0.0 || value.is_nan() {
            return Some(root(&left, inside, outside));
        }
        (inside, step) = (outside, 2.0 * step);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_is_refused_beyond_the_known_quantile() {
        assert!((refusal() - 3.841_458_820_694_124).abs() < 1e-9, "{}", refusal());
    }

    #[test]
    fn a_crossing_is_found_on_either_side_or_not_at_all() {
        let beyond = |x: f64| if x.abs() > 3.0 { f64::NAN } else { x * x };
        for first in [0.1_f64, -0.1] {
            let end = first.signum() * 7.0_f64.sqrt();
            let found = crossing(|x| x * x, 0.0, first, 7.0, 100.0).expect("it is passed");
            assert!((found - end).abs() < 1e-9, "{found}");
            let found = crossing(beyond, 0.0, first, 7.0, 100.0).expect("it is passed");
            assert!((found - end).abs() < 1e-9, "{found}");
        }
        assert_eq!(crossing(|x| 1.0 - 1.0 / (1.0 + x.abs()), 0.0, 1.0, 1.0, 1e4), None);
        assert_eq!(crossing(|x| x, 0.0, 1.0, 7.0, 4.0), None);
    }
}
