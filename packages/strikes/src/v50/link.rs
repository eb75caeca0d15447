//! From the distance to the limit speed to a chance: logit and probit.

use std::f64::consts::PI;

use statrs::distribution::{Continuous, ContinuousCDF, Normal};

/// Below this the normal distribution's tail is taken by its asymptotic series.
const TAIL: f64 = -20.0;

/// The distribution whose integral the curve is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Link {
    /// The logistic distribution.
    Logit,
    /// The normal one.
    Probit,
}

impl Link {
    pub const BOTH: [Link; 2] = [Link::Logit, Link::Probit];

    pub fn name(self) -> &'static str {
        match self {
            Link::Logit => "logit",
            Link::Probit => "probit",
        }
    }

    /// The chance F(η) of a perforation.
    pub fn chance(self, eta: f64) -> f64 {
        match self {
            Link::Logit => 1.0 / (1.0 + (-eta).exp()),
            Link::Probit => Normal::standard().cdf(eta),
        }
    }

    /// F(η)'s logarithm, also where F is too small for a number.
    pub fn log_chance(self, eta: f64) -> f64 {
        match self {
            // Of two forms, the one whose exponential is small.
            Link::Logit if eta < 0.0 => eta - eta.exp().ln_1p(),
            Link::Logit => -(-eta).exp().ln_1p(),
            Link::Probit if eta < TAIL => {
                let square = eta * eta;
                -0.5 * square - (-eta * (2.0 * PI).sqrt()).ln() + (-1.0 / square + 2.5 / (square * square))
            }
            Link::Probit => self.chance(eta).ln(),
        }
    }

    /// F(η)'s logarithm with its first and its second derivative.
    pub fn log_chance_with_slopes(self, eta: f64) -> [f64; 3] {
        let value = self.log_chance(eta);
        match self {
            Link::Logit => {
                let rest = self.chance(-eta);
                [value, rest, -rest * (1.0 - rest)]
            }
            Link::Probit if eta < TAIL => {
                let part = 1.0 / (eta * eta);
                [value, -eta * (1.0 + part - 2.0 * part * part), -1.0 + part]
            }
            Link::Probit => {
                let ratio = (Normal::standard().ln_pdf(eta) - value).exp();
                [value, ratio, -ratio * (ratio + eta)]
            }
        }
    }

    /// η of a chance.
    pub fn quantile(self, chance: f64) -> f64 {
        match self {
            Link::Logit => (chance / (1.0 - chance)).ln(),
            Link::Probit => Normal::standard().inverse_cdf(chance),
        }
    }

    /// The slope of F where the chance is a half.
    pub fn slope(self) -> f64 {
        match self {
            Link::Logit => 0.25,
            Link::Probit => 1.0 / (2.0 * PI).sqrt(),
        }
    }

    /// The logarithm of Fisher's information of one shot on η, F'² over F (1 − F).
    pub fn log_information(self, eta: f64) -> f64 {
        let variance = self.log_chance(eta) + self.log_chance(-eta);
        match self {
            Link::Logit => variance,
            Link::Probit => 2.0 * Normal::standard().ln_pdf(eta) - variance,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithms_and_quantiles_belong_to_the_chance() {
        for link in Link::BOTH {
            for eta in [-19.0, -6.0, -1.0, 0.0, 0.3, 4.0] {
                let (chance, log) = (link.chance(eta), link.log_chance(eta));
                assert!((log - chance.ln()).abs() < 1e-12 * (1.0 + log.abs()), "{link:?} {eta}");
                assert!((link.chance(eta) + link.chance(-eta) - 1.0).abs() < 1e-15);
            }
            for chance in [0.05, 0.5, 0.95] {
                assert!((link.chance(link.quantile(chance)) - chance).abs() < 1e-9, "{link:?} {chance}");
            }
            let step = 1e-4;
            let slope = (link.chance(step) - link.chance(-step)) / (2.0 * step);
            assert!((slope - link.slope()).abs() < 1e-8, "{link:?}");
            for eta in [-30.0, -2.0, 0.0, 1.5, 6.0] {
                let [value, first, second] = link.log_chance_with_slopes(eta);
                let [below, above] = [eta - step, eta + step].map(|eta| link.log_chance(eta));
                let bends = (above - 2.0 * value + below) / (step * step);
                assert!((first - (above - below) / (2.0 * step)).abs() < 1e-6 * (1.0 + first), "{link:?} {eta}");
                assert!((second - bends).abs() < 1e-3, "{link:?} {eta}: {second} {bends}");
            }
            for eta in [-2.0, 0.0, 1.5] {
                let slope = (link.chance(eta + step) - link.chance(eta - step)) / (2.0 * step);
                let expected = slope * slope / (link.chance(eta) * link.chance(-eta));
                assert!((link.log_information(eta).exp() / expected - 1.0).abs() < 1e-6, "{link:?} {eta}");
            }
        }
        // At the border between the forms, and beyond what is a number.
        let [below, above] = [TAIL * (1.0 + 1e-9), TAIL * (1.0 - 1e-9)].map(|eta| Link::Probit.log_chance(eta));
        assert!((below - above).abs() < 1e-6, "{below} {above}");
        assert!(Link::Probit.log_chance(-100.0) < -5000.0 && Link::Probit.log_chance(-100.0).is_finite());
    }
}
