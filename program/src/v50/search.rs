//! One-dimensional searches: the largest value of a function, and where a rising one passes a level.

use crate::common::root::root;

/// The golden section, after which a bracket has that part of its length.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// A bracket of so little of what it began with is a point: a function is flat there, as far as its digits go.
const NARROW: f64 = 1e-9;
/// Steps outwards, each twice the one before: what is farther is as good as without end.
const DOUBLINGS: usize = 14;

/// Where a function that rises and then falls between two places is largest, and that value; an end counts as any other place.
pub fn maximum(mut of: impl FnMut(f64) -> f64, [low, high]: [f64; 2]) -> (f64, f64) {
    let (mut left, mut right) = (low, high);
    let mut inner = [right - GOLDEN * (right - left), left + GOLDEN * (right - left)];
    let mut values = inner.map(&mut of);
    while right - left > NARROW * (high - low) {
        if values[0] < values[1] {
            left = inner[0];
            (inner[0], values[0]) = (inner[1], values[1]);
            inner[1] = left + GOLDEN * (right - left);
            values[1] = of(inner[1]);
        } else {
            right = inner[1];
            (inner[1], values[1]) = (inner[0], values[0]);
            inner[0] = right - GOLDEN * (right - left);
            values[0] = of(inner[0]);
        }
    }
    let middle = 0.5 * (left + right);
    [low, middle, high]
        .map(|place| (place, of(place)))
        .into_iter()
        .fold((low, f64::NEG_INFINITY), |best, found| if found.1 > best.1 { found } else { best })
}

/// Where a function that rises away from `start` passes `level`, sought outwards from a step of `first` on; none where it does not.
pub fn crossing(of: impl Fn(f64) -> f64, start: f64, first: f64, level: f64) -> Option<f64> {
    let above = |place: f64| of(place) - level;
    let mut step = first;
    let mut inside = start;
    for _ in 0..DOUBLINGS {
        let outside = start + step;
        if above(outside) > 0.0 {
            return Some(root(&above, inside, outside));
        }
        (inside, step) = (outside, 2.0 * step);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_maximum_is_found_inside_or_at_an_end() {
        let (place, value) = maximum(|x| 2.0 - (x - 0.3).powi(2), [-5.0, 9.0]);
        assert!((place - 0.3).abs() < 1e-7 && (value - 2.0).abs() < 1e-14, "{place} {value}");
        assert_eq!(maximum(|x| x, [-1.0, 2.0]), (2.0, 2.0));
        assert_eq!(maximum(|x| -x, [-1.0, 2.0]), (-1.0, 1.0));
    }

    #[test]
    fn a_crossing_is_found_on_either_side_or_not_at_all() {
        for first in [0.1, -0.1] {
            let found = crossing(|x| x * x, 0.0, first, 7.0).expect("it is passed");
            assert!((found - first.signum() * 7.0_f64.sqrt()).abs() < 1e-9, "{found}");
        }
        assert_eq!(crossing(|x| 1.0 - 1.0 / (1.0 + x.abs()), 0.0, 1.0, 1.0), None);
    }
}
