//! Residuals of Newton's method, as the programs in Python print them.

/// What rounding leaves of a residual.
const ROUNDING: f64 = 1e-12;

/// r' ≤ C r² for residuals over the reaction forces. A tangent that is off by 1 % leaves r' = 0.01 r, a thousand times
/// more at the smallest residual before the last.
const CONSTANT: f64 = 50.0;

/// The numbers of a line.
pub fn numbers(line: &str) -> Vec<f64> {
    line.split_whitespace().map(|number| number.parse().expect("a number")).collect()
}

/// The last three residuals of an increment fall quadratically.
#[track_caller]
pub fn assert_quadratic(residuals: &[f64]) {
    let [a, b, c] = residuals.last_chunk().expect("three iterations at least");
    for (before, after) in [(a, b), (b, c)] {
        assert!(*after <= (CONSTANT * before * before).max(ROUNDING), "{before:e} is followed by {after:e}");
    }
    assert!(*b > ROUNDING, "the last step but one says something: {residuals:?}");
}
