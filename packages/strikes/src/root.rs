//! The root of a function of one variable.

const ITERATIONS: usize = 100;
/// Places closer than this, over one more than their size, are the same.
const ACCURACY: f64 = 1e-12;

/// The root between two places where the signs differ: regula falsi with the step of Illinois, or a bisection where
/// that is no number.
pub fn root(function: &(impl Fn(f64) -> f64 + ?Sized), near: f64, far: f64) -> f64 {
    let [mut a, mut b] = [near, far].map(|place| (place, function(place)));
    for _ in 0..ITERATIONS {
        let middle = 0.5 * (a.0 + b.0);
        let secant = b.0 - b.1 * (b.0 - a.0) / (b.1 - a.1);
        let place = if secant.is_finite() { secant } else { middle };
        let value = function(place);
        if value == 0.0 || (place - b.0).abs() < ACCURACY * (1.0 + place.abs()) {
            return place;
        }
        // What is no number lies on the far side.
        if (value > 0.0) == (b.1 > 0.0) {
            b = (place, value);
            a.1 *= 0.5;
        } else {
            a = b;
            b = (place, value);
        }
    }
    b.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_root_is_found_from_either_side_and_beside_what_is_no_number() {
        for (near, far) in [(1.0, 9.0), (9.0, 1.0)] {
            assert!((root(&|x: f64| x * x - 7.0, near, far) - 7.0_f64.sqrt()).abs() < 1e-11);
        }
        assert!((root(&|x: f64| if x > 3.0 { f64::NAN } else { 2.0 - x }, 0.0, 10.0) - 2.0).abs() < 1e-9);
        assert!((root(&|x: f64| if x > 3.0 { f64::INFINITY } else { x - 2.0 }, 0.0, 10.0) - 2.0).abs() < 1e-9);
    }
}
