//! Residual over striking speed: Lambert and Jonas's (1976) curve v_r = a (v_s^p − v_l^p)^(1/p), by least squares.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra_of_least_squares::{Dyn, Matrix, OVector, Owned, U1, U3, Vector3};

/// A curve of three parameters says something beside as many perforations, at least.
pub const FEWEST: usize = 4;
/// Exponents from which the search starts, and limits over the slowest perforation; the best answer counts.
const EXPONENTS: [f64; 3] = [1.5, 2.0, 4.0];
const LIMITS: [f64; 3] = [0.7, 0.9, 0.99];

/// An exponent beyond this is of a jump and not of a curve; one so near to 1 of a straight line.
pub const MOST_EXPONENT: f64 = 10.0;
const LEAST_EXPONENT: f64 = 1.001;
/// A limit so near to the slowest perforation, over that, is that shot's own speed.
const OWN_SPEED: f64 = 1e-4;
/// A curve that leaves more of the variance of the residual speeds than this says no more than their mean.
const MOST_LEFT: f64 = 0.5;

/// The curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LambertJonas {
    /// a, up to 1: with nothing lost to what is taken along it is 1.
    pub ratio: f64,
    /// p, above 1.
    pub exponent: f64,
    /// v_l.
    pub limit: f64,
    /// The root of the mean square of what is left.
    pub deviation: f64,
}

/// Why the best curve is no estimate of the shots' law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Degenerate {
    /// Its exponent is beyond [`MOST_EXPONENT`].
    Jump(f64),
    /// Its exponent goes to 1.
    Line,
    /// Its limit is the speed of the slowest perforation, at which this was left.
    OwnSpeed(f64),
    /// It leaves this part of the variance of the residual speeds.
    Left(f64),
}

impl LambertJonas {
    /// The curve of perforations, striking and residual speeds, or why the best one is none; nothing of fewer than
    /// [`FEWEST`], or where the search finds none.
    pub fn fit(perforations: &[[f64; 2]]) -> Option<Result<LambertJonas, Degenerate>> {
        let best = LambertJonas::best(perforations)?;
        Some(best.degenerate(perforations).map_or(Ok(best), Err))
    }

    fn degenerate(&self, perforations: &[[f64; 2]]) -> Option<Degenerate> {
        let slowest = *perforations.iter().min_by(|one, other| one[0].total_cmp(&other[0]))?;
        let count = perforations.len() as f64;
        let mean = perforations.iter().map(|shot| shot[1]).sum::<f64>() / count;
        let variance = perforations.iter().map(|shot| (shot[1] - mean).powi(2)).sum::<f64>() / count;
        let left = self.deviation.powi(2) / variance;
        if self.exponent > MOST_EXPONENT {
            Some(Degenerate::Jump(self.exponent))
        } else if self.exponent < LEAST_EXPONENT {
            Some(Degenerate::Line)
        } else if self.limit > slowest[0] * (1.0 - OWN_SPEED) {
            Some(Degenerate::OwnSpeed(slowest[1]))
        } else {
            (left > MOST_LEFT).then_some(Degenerate::Left(left))
        }
    }

    /// The best curve, whatever it says.
    fn best(perforations: &[[f64; 2]]) -> Option<LambertJonas> {
        if perforations.len() < FEWEST {
            return None;
        }
        let slowest = perforations.iter().map(|shot| shot[0]).fold(f64::INFINITY, f64::min);
        let fastest = perforations.iter().map(|shot| shot[0]).fold(0.0, f64::max);
        let starts = EXPONENTS.iter().flat_map(|&exponent| LIMITS.map(|limit| [exponent, limit * slowest / fastest]));
        let search = |[exponent, limit]: [f64; 2]| {
            let unknown = Vector3::new(logit(0.95), (exponent - 1.0).ln(), logit(limit));
            let problem = Problem { perforations, fastest, unknown };
            let (found, report) = LevenbergMarquardt::new().minimize(problem);
            report.objective_function.is_finite().then(|| found.curve())
        };
        starts
            .filter_map(search)
            .filter(|curve| curve.deviation.is_finite())
            .min_by(|one, other| one.deviation.total_cmp(&other.deviation))
    }

    /// The residual speed of a striking one.
    pub fn residual(&self, striking: f64) -> f64 {
        if striking <= self.limit {
            return 0.0;
        }
        // Over the striking speed: no power of it is too large for a number.
        let left = -(self.exponent * (self.limit / striking).ln()).exp_m1();
        self.ratio * striking * left.powf(1.0 / self.exponent)
    }
}

fn logit(share: f64) -> f64 {
    (share / (1.0 - share)).ln()
}

fn logistic(unknown: f64) -> f64 {
    1.0 / (1.0 + (-unknown).exp())
}

/// The least squares. The unknowns are free: a is the first one's logistic function, p − 1 the second one's exponential
/// function, and v_l over the fastest striking speed the third one's logistic function.
struct Problem<'a> {
    perforations: &'a [[f64; 2]],
    fastest: f64,
    unknown: Vector3<f64>,
}

impl Problem<'_> {
    fn curve(&self) -> LambertJonas {
        let [a, p, limit] = [self.unknown[0], self.unknown[1], self.unknown[2]];
        let mut curve = LambertJonas {
            ratio: logistic(a),
            exponent: 1.0 + p.exp(),
            limit: self.fastest * logistic(limit),
            deviation: 0.0,
        };
        let squares: f64 = self.perforations.iter().map(|shot| (curve.residual(shot[0]) - shot[1]).powi(2)).sum();
        curve.deviation = (squares / self.perforations.len() as f64).sqrt();
        curve
    }
}

impl LeastSquaresProblem<f64, Dyn, U3> for Problem<'_> {
    type ResidualStorage = Owned<f64, Dyn, U1>;
    type JacobianStorage = Owned<f64, Dyn, U3>;
    type ParameterStorage = Owned<f64, U3, U1>;

    fn set_params(&mut self, unknown: &Vector3<f64>) {
        self.unknown = *unknown;
    }

    fn params(&self) -> Vector3<f64> {
        self.unknown
    }

    fn residuals(&self) -> Option<OVector<f64, Dyn>> {
        let curve = self.curve();
        let residuals = self.perforations.iter().map(|shot| (curve.residual(shot[0]) - shot[1]) / self.fastest);
        Some(OVector::<f64, Dyn>::from_iterator(self.perforations.len(), residuals))
    }

    fn jacobian(&self) -> Option<Matrix<f64, Dyn, U3, Self::JacobianStorage>> {
        let curve = self.curve();
        let LambertJonas { ratio, exponent: p, limit, .. } = curve;
        let row = |striking: f64| {
            if striking <= limit {
                return [0.0; 3];
            }
            let (residual, part) = (curve.residual(striking), limit / striking);
            let power = (p * part.ln()).exp();
            let left = 1.0 - power;
            let by_exponent = residual * (-left.ln() / (p * p) - power * part.ln() / (p * left));
            let by_limit = -residual * power / (left * limit);
            [residual * (1.0 - ratio), by_exponent * (p - 1.0), by_limit * limit * (1.0 - limit / self.fastest)]
        };
        let rows: Vec<f64> =
            self.perforations.iter().flat_map(|shot| row(shot[0]).map(|slope| slope / self.fastest)).collect();
        Some(Matrix::<f64, Dyn, U3, Self::JacobianStorage>::from_row_slice(&rows))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Shots on a curve give it back.
    #[test]
    fn the_curve_of_its_own_shots_is_found() {
        for (ratio, exponent, limit) in [(0.98, 2.0, 130.0), (0.9, 2.6, 300.0), (0.95, 1.4, 80.0)] {
            let own = LambertJonas { ratio, exponent, limit, deviation: 0.0 };
            let shots: Vec<[f64; 2]> = (1..12)
                .map(|i| limit * (1.0 + 0.07 * f64::from(i)))
                .map(|speed| [speed, own.residual(speed)])
                .collect();
            let found = LambertJonas::fit(&shots).expect("a curve").expect("one that is no degenerate one");
            for (found, expected) in [(found.ratio, ratio), (found.exponent, exponent), (found.limit, limit)] {
                assert!((found / expected - 1.0).abs() < 1e-5, "{found}, expected {expected}");
            }
            assert!(found.deviation < 1e-6 * limit, "{found:?}");
        }
        assert_eq!(LambertJonas::fit(&[[100.0, 20.0]; 3]), None);
    }

    /// No parameter is told that the shots do not hold.
    #[test]
    fn a_degenerate_curve_is_none() {
        let of = |shots: &[[f64; 2]]| LambertJonas::fit(shots).expect("a best curve").expect_err("a degenerate one");
        // All at nearly one speed.
        let jump = [[59.9924, 34.99], [59.9971, 40.62], [60.0, 38.23], [60.0047, 44.05], [60.0094, 41.13]];
        assert!(matches!(of(&jump), Degenerate::Jump(exponent) if exponent > 10.0), "{:?}", of(&jump));
        // The slowest ones keep more than shots beyond them.
        let line = [[40.0, 3.0], [44.0, 4.0], [48.0, 6.0], [52.0, 12.0], [56.0, 20.0]];
        assert_eq!(of(&line), Degenerate::Line);
        let own_speed = [[60.0, 8.7], [60.3, 28.0], [61.0, 33.0], [64.0, 41.0], [70.0, 49.0], [80.0, 60.0]];
        assert_eq!(of(&own_speed), Degenerate::OwnSpeed(8.7));
        let scattered = [[60.0, 42.3], [60.5, 37.5], [61.0, 45.0], [61.5, 36.0], [62.0, 44.0], [62.5, 41.0]];
        let curve = LambertJonas { ratio: 1.0, exponent: 2.0, limit: 50.0, deviation: 3.0 };
        let left = curve.degenerate(&scattered);
        assert!(matches!(left, Some(Degenerate::Left(left)) if (left - 9.0 / 10.6556).abs() < 1e-4), "{left:?}");
        assert_eq!(LambertJonas { deviation: 2.0, ..curve }.degenerate(&scattered), None);
    }

    /// The derivatives are those of the residuals.
    #[test]
    fn the_derivatives_are_right() {
        let shots = [[120.0, 30.0], [140.0, 90.0], [99.0, 0.0]];
        let at = |unknown: Vector3<f64>| Problem { perforations: &shots, fastest: 140.0, unknown };
        let unknown = Vector3::new(1.2, 0.3, 1.1);
        let jacobian = at(unknown).jacobian().expect("derivatives");
        for i in 0..3 {
            let step = 1e-6;
            let mut moved = [unknown; 2];
            (moved[0][i], moved[1][i]) = (unknown[i] - step, unknown[i] + step);
            let [below, above] = moved.map(|unknown| at(unknown).residuals().expect("residuals"));
            for shot in 0..shots.len() {
                let slope = (above[shot] - below[shot]) / (2.0 * step);
                assert!((jacobian[(shot, i)] - slope).abs() < 1e-7, "{shot} {i}: {} {slope}", jacobian[(shot, i)]);
            }
        }
    }
}
