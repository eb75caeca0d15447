//! Weibull's law from the scales that were found at several lengths, where the strengths themselves are not given.
//!
//! The scale at a length is s (L₀/L)^(1/m): its logarithm falls by 1/m with that of the length. By least squares, with
//! the scatter of the scales about the line as their error.

use statrs::distribution::{ChiSquared, ContinuousCDF, StudentsT};

use super::fit::Estimate;
use crate::confidence::LEVEL;

/// n times the variance of ln m of samples of n tests, in large samples: 6/π².
const VARIANCE: f64 = 0.607_927_101_854_026_6;
/// The most tests at one length that are proposed.
const MOST_TESTS: f64 = 1e6;

/// What scales tell.
#[derive(Clone, Debug, PartialEq)]
pub struct ScaleFit {
    pub modulus: Estimate,
    /// At the reference length.
    pub scale: Estimate,
    pub reference_length: f64,
    /// By how much of itself each scale is off.
    pub residuals: Vec<f64>,
}

impl ScaleFit {
    /// The largest of the residuals.
    pub fn farthest(&self) -> f64 {
        self.residuals.iter().map(|residual| residual.abs()).fold(0.0, f64::max)
    }
}

/// Fits the law to scales at these lengths.
///
/// # Errors
/// Scales that tell no modulus, and what would.
pub fn fit(lengths: &[f64], scales: &[f64], reference_length: f64) -> Result<ScaleFit, String> {
    let count = lengths.len() as f64;
    if lengths.len() < 3 {
        return Err(format!("scales at {count} lengths; allowed: three at least, since their scatter is their error"));
    }
    let x: Vec<f64> = lengths.iter().map(|length| (length / reference_length).ln()).collect();
    let y: Vec<f64> = scales.iter().map(|scale| scale.ln()).collect();
    let mean = |of: &[f64]| of.iter().sum::<f64>() / count;
    let [x_mean, y_mean] = [mean(&x), mean(&y)];
    let spread: f64 = x.iter().map(|x| (x - x_mean).powi(2)).sum();
    if spread < f64::EPSILON {
        return Err("scales at one length; allowed: three lengths at least".to_string());
    }
    let slope = x.iter().zip(&y).map(|(x, y)| (x - x_mean) * (y - y_mean)).sum::<f64>() / spread;
    if slope >= 0.0 {
        return Err("the scales do not fall with the length; allowed: longer yarns that are weaker".to_string());
    }
    let level = y_mean - slope * x_mean;
    let off: Vec<f64> = x.iter().zip(&y).map(|(x, y)| y - level - slope * x).collect();
    let variance = off.iter().map(|off| off * off).sum::<f64>() / (count - 2.0);
    let student = StudentsT::new(0.0, 1.0, count - 2.0).map_err(|error| error.to_string())?;
    let quantile = student.inverse_cdf(0.5 + 0.5 * LEVEL);
    let of_slope = quantile * (variance / spread).sqrt();
    let of_level = quantile * (variance * (1.0 / count + x_mean * x_mean / spread)).sqrt();
    // A line that may be level has no largest modulus.
    let high = if slope + of_slope < 0.0 { -1.0 / (slope + of_slope) } else { f64::INFINITY };
    Ok(ScaleFit {
        modulus: Estimate { value: -1.0 / slope, low: -1.0 / (slope - of_slope), high },
        scale: Estimate { value: level.exp(), low: (level - of_level).exp(), high: (level + of_level).exp() },
        reference_length,
        residuals: off.iter().map(|off| off.exp_m1()).collect(),
    })
}

/// The number of tests at each length from which on moduli that were found there differ by more than those of one law
/// would in 95 of 100 cases; none where there are fewer than two, or they are so alike that nobody makes so many tests.
pub fn contradiction(moduli: &[f64]) -> Option<f64> {
    let count = moduli.len() as f64;
    let mean = moduli.iter().map(|modulus| modulus.ln()).sum::<f64>() / count;
    let squares: f64 = moduli.iter().map(|modulus| (modulus.ln() - mean).powi(2)).sum();
    let quantile = ChiSquared::new(count - 1.0).ok()?.inverse_cdf(LEVEL);
    Some((VARIANCE * quantile / squares).ceil()).filter(|&tests| tests <= MOST_TESTS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::strength::weibull::Weibull;

    /// Kevlar 49 yarns (13th International Conference on Fracture, paper 389): lengths in mm, scales in MPa, moduli.
    const LENGTHS: [f64; 6] = [50.0, 125.0, 200.0, 275.0, 350.0, 425.0];
    const SCALES: [f64; 6] = [1933.0, 1829.0, 1795.0, 1724.0, 1726.0, 1652.0];
    const MODULI: [f64; 6] = [21.7, 11.5, 14.3, 11.9, 7.9, 8.8];

    #[test]
    fn scales_of_a_law_give_it_back() {
        let law = Weibull { modulus: 8.0, scale: 1900.0, reference_length: 50.0 };
        let found = fit(&LENGTHS, &LENGTHS.map(|length| law.scale_at(length)), 200.0).expect("a fit");
        assert!(
            (found.modulus.value / 8.0 - 1.0).abs() < 1e-12
                && (found.scale.value / law.scale_at(200.0) - 1.0).abs() < 1e-12
        );
        assert!(found.farthest() < 1e-12 && found.modulus.high < 8.001);
    }

    #[test]
    fn scales_of_kevlar_49_pool_and_their_moduli_do_not() {
        let found = fit(&LENGTHS, &SCALES, 50.0).expect("a fit");
        let Estimate { value, low, high } = found.modulus;
        for (found, expected) in [(value, 14.74), (low, 11.21), (high, 21.51), (found.scale.value, 1944.3)] {
            assert!((found / expected - 1.0).abs() < 5e-4, "{found} {expected}");
        }
        assert!((found.farthest() - 0.0176).abs() < 1e-4, "{}", found.farthest());
        assert_eq!(contradiction(&MODULI), Some(11.0));
        // Moduli that are equal, but for a digit perhaps, contradict nothing.
        for alike in [[10.0; 6], [0.1; 6], [10.0, 10.0 + 1e-13, 10.0, 10.0, 10.0, 10.0]] {
            assert_eq!(contradiction(&alike), None, "{alike:?}");
        }
        assert_eq!(contradiction(&MODULI[..1]), None);
        // A cell whose length is added to the yarn's fits alike: it is not told, and m with it.
        for (cell, modulus) in [(100.0, 8.62), (200.0, 6.33)] {
            let other = fit(&LENGTHS.map(|length| length + cell), &SCALES, 50.0).expect("a fit");
            assert!(other.farthest() < found.farthest() && (other.modulus.value - modulus).abs() < 0.01, "{other:?}");
        }
    }

    #[test]
    fn scales_that_tell_nothing_are_refused() {
        for (lengths, scales, message) in [
            (&[50.0, 100.0][..], &[2.0, 1.0][..], "scales at 2 lengths; allowed: three at least"),
            (&[50.0; 3], &[3.0, 2.0, 1.0], "scales at one length; allowed"),
            (&[50.0, 60.0, 70.0], &[1.0, 2.0, 3.0], "the scales do not fall with the length; allowed"),
        ] {
            let error = fit(lengths, scales, 50.0).expect_err(message);
            assert!(error.contains(message), "{error}");
        }
        // A line that may be level.
        assert_eq!(
            fit(&[50.0, 100.0, 200.0], &[3.0, 2.9, 3.0 - 0.05], 50.0).expect("a fit").modulus.high,
            f64::INFINITY
        );
    }
}
