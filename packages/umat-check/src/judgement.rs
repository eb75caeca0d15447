//! DDSDDE beside a derivative, entry by entry.

use nalgebra::DMatrix;

use super::differences::{Derivative, TOLERANCE, scale};
use super::kinematics::Modulus;

/// How wrong a modulus is.
#[derive(Clone, Copy, Debug, Default)]
pub struct Difference {
    /// The largest relative error of an entry of which the differences are sure.
    pub worst: f64,
    /// Row and column of it.
    pub place: (usize, usize),
    /// Entries of which they are not.
    pub unsure: usize,
}

/// A modulus beside what should be there, whose errors and kinks are those of the differences.
pub fn compare(modulus: &Modulus, truth: &Modulus, differences: &Derivative, components: usize) -> Difference {
    let scale = scale(&differences.value, components);
    // What has a kink in one direction may be an isolated point in another.
    let kink = differences.kinks.iter().flatten().any(|kink| *kink);
    let mut difference = Difference::default();
    for i in 0..components {
        for j in 0..components {
            let error = (modulus[i][j] - truth[i][j]).abs();
            let estimate = differences.error[i][j];
            let unsure = estimate > 0.1 * TOLERANCE * scale[i][j] && error < 20.0 * estimate;
            if kink || unsure {
                difference.unsure += 1;
            } else if error.is_nan() || error / scale[i][j] > difference.worst {
                difference.worst = error / scale[i][j];
                difference.place = (i, j);
            }
        }
    }
    difference
}

/// Which entries are wrong beyond a tolerance, where the differences are sure.
pub fn wrong_entries(
    modulus: &Modulus,
    truth: &Modulus,
    differences: &Derivative,
    components: usize,
) -> Vec<(usize, usize)> {
    let scale = scale(&differences.value, components);
    let places = (0..components).flat_map(|i| (0..components).map(move |j| (i, j)));
    let is_wrong = |&(i, j): &(usize, usize)| {
        let error = (modulus[i][j] - truth[i][j]).abs();
        error > TOLERANCE * scale[i][j] && error > 20.0 * differences.error[i][j]
    };
    places.filter(is_wrong).collect()
}

/// By what factor an iteration of Newton's method with this modulus reduces an error, at best: the spectral radius of
/// 1 - D⁻¹T.
pub fn contraction(modulus: &Modulus, truth: &Modulus, components: usize) -> Option<f64> {
    let square = |entries: &Modulus| DMatrix::from_fn(components, components, |i, j| entries[i][j]);
    let step = square(modulus).lu().solve(&square(truth))?;
    let left = DMatrix::identity(components, components) - step;
    // The root of a high power's norm (Gelfand): an iteration for eigenvalues need not end where all are equal.
    let (mut power, mut logarithm) = (left, 0.0);
    for squarings in 0..=SQUARINGS {
        let norm = power.norm();
        if norm == 0.0 {
            return Some(0.0);
        }
        if !norm.is_finite() {
            return None;
        }
        logarithm += norm.ln() / f64::from(1 << squarings);
        power /= norm;
        power = &power * &power;
    }
    Some(logarithm.exp())
}

/// The power is the 1024th.
const SQUARINGS: i32 = 10;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_wrong_scale_does_to_convergence() {
        let mut truth = [[0.0; 6]; 6];
        for (i, row) in truth.iter_mut().enumerate() {
            row[i] = 2.0;
        }
        let twice = truth.map(|row| row.map(|entry| 2.0 * entry));
        assert!((contraction(&twice, &truth, 6).expect("regular") - 0.5).abs() < 1e-2);
        assert!(contraction(&[[0.0; 6]; 6], &truth, 6).is_none());
        let sure = Derivative { value: truth, error: [[0.0; 6]; 6], kinks: [[false; 6]; 6] };
        assert_eq!(compare(&twice, &truth, &sure, 6).worst, 1.0);
        assert_eq!(compare(&truth, &truth, &sure, 6).worst, 0.0);
        let unsure = Derivative { error: [[1.0; 6]; 6], ..sure };
        assert_eq!(compare(&twice, &truth, &unsure, 6).unsure, 36);
    }
}
