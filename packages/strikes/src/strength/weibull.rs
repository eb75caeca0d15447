//! Weibull's law of the strength of a length.

/// The least strength of a length L is below x with the probability 1 − exp(−L/L₀ (x/s)^m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weibull {
    /// m, above 1; infinite where nothing scatters.
    pub modulus: f64,
    /// s, at the reference length L₀.
    pub scale: f64,
    pub reference_length: f64,
}

impl Weibull {
    /// The scale at a length.
    pub fn scale_at(&self, length: f64) -> f64 {
        self.scale * (self.reference_length / length).powf(1.0 / self.modulus)
    }

    /// The strength that a length has with the probability `share`, between 0 and 1, at most.
    pub fn quantile(&self, length: f64, share: f64) -> f64 {
        self.scale_at(length) * (-(-share).ln_1p()).powf(1.0 / self.modulus)
    }

    /// The probability that a length is weaker.
    pub fn probability(&self, length: f64, strength: f64) -> f64 {
        -(-(strength / self.scale_at(length)).powf(self.modulus)).exp_m1()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quantile_is_the_inverse_of_the_probability() {
        for modulus in [1.5, 5.0, 20.0] {
            let law = Weibull { modulus, scale: 0.04, reference_length: 50.0 };
            for length in [0.1, 50.0, 400.0] {
                for share in [1e-6, 0.1, 0.5, 0.999] {
                    let found = law.probability(length, law.quantile(length, share));
                    assert!((found / share - 1.0).abs() < 1e-12, "{modulus} {length} {share}: {found}");
                }
            }
            // 1 − 1/e of the reference length is weaker than the scale; twice the length survives with the square of
            // the chance.
            assert!((law.probability(50.0, 0.04) - (1.0 - (-1.0_f64).exp())).abs() < 1e-15);
            let survives = |length: f64| 1.0 - law.probability(length, 0.038);
            assert!((survives(100.0) - survives(50.0).powi(2)).abs() < 1e-14);
        }
        let even = Weibull { modulus: f64::INFINITY, scale: 0.04, reference_length: 50.0 };
        assert_eq!([1e-9, 0.5].map(|share| even.quantile(3.0, share)), [0.04; 2]);
    }
}
