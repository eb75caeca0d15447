//! Weibull's law from strengths at one or several lengths, by maximum likelihood, with likelihood-ratio intervals.
//!
//! A test that has broken at x counts by the density there, one that has ended before it broke (as it slipped in the
//! grips) by the probability that it is stronger. With w = L/L₀ the log-likelihood is Σ ln(w m/x) + m ln(x/s) over what
//! has broken, less Σ w (x/s)^m over all. Given m, s is known: s^m = Σ w x^m / r, with r that have broken; m is the
//! only root of a function that falls.

use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::weibull::Weibull;
use crate::confidence::{crossing, refusal};
use crate::root::root;

/// A modulus beyond this is not told from no scatter.
const LARGEST: f64 = 1e6;
/// The logarithm of a scale is sought within so much of its estimate: beyond, there is no bound.
const FARTHEST: f64 = 100.0;
const ITERATIONS: usize = 100;

/// A test of one yarn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Test {
    pub strength: f64,
    pub length: f64,
    /// Else the yarn is stronger than this.
    pub broken: bool,
}

/// A value and its interval; 0 or infinity where it has no bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    pub value: f64,
    pub low: f64,
    pub high: f64,
}

/// What tests tell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    pub modulus: Estimate,
    /// At the reference length.
    pub scale: Estimate,
    pub reference_length: f64,
    pub log_likelihood: f64,
}

impl Fit {
    pub fn law(&self) -> Weibull {
        let Fit { modulus, scale, reference_length, .. } = *self;
        Weibull { modulus: modulus.value, scale: scale.value, reference_length }
    }
}

/// Tests, by logarithms relative to the largest strength.
struct Sample {
    /// ln(x/x_max), and L/L₀.
    tests: Vec<[f64; 2]>,
    /// Of those that have broken: their number r, and Σ ln(x/x_max).
    broken: f64,
    sum: f64,
}

/// Fits the law to tests.
///
/// # Errors
/// Tests that tell no modulus, and what would.
pub fn fit(tests: &[Test], reference_length: f64) -> Result<Fit, String> {
    let most = tests.iter().map(|test| test.strength).fold(0.0, f64::max);
    let sample = Sample::new(tests, most, reference_length)?;
    let modulus = sample.modulus().ok_or("the modulus is too large to be told from no scatter; allowed: more tests")?;
    let scale = sample.scale_given(modulus);
    let best = sample.likelihood(modulus, scale);
    let deviance = |modulus: f64, scale: f64| 2.0 * (best - sample.likelihood(modulus, scale));
    // The estimate's standard error in large samples is some 0.8 m/√r.
    let step = 1.0 / sample.broken.sqrt();
    let of_modulus = |logarithm: f64| {
        let modulus = logarithm.exp();
        deviance(modulus, sample.scale_given(modulus))
    };
    let of_scale = |scale: f64| deviance(sample.modulus_given(scale, modulus), scale);
    let end = |of: &dyn Fn(f64) -> f64, from: f64, step: f64| {
        crossing(of, from, step, refusal(), FARTHEST).unwrap_or(step * f64::INFINITY)
    };
    let [of_modulus, of_scale]: [&dyn Fn(f64) -> f64; 2] = [&of_modulus, &of_scale];
    let interval = |of: &dyn Fn(f64) -> f64, from: f64, step: f64| [-step, step].map(|step| end(of, from, step).exp());
    let [low, high] = interval(of_modulus, modulus.ln(), step);
    let [weakest, strongest] = interval(of_scale, scale, step / modulus);
    let law = Weibull { modulus, scale: most * scale.exp(), reference_length };
    Ok(Fit {
        modulus: Estimate { value: modulus, low, high },
        scale: Estimate { value: law.scale, low: most * weakest, high: most * strongest },
        reference_length,
        log_likelihood: log_likelihood(tests, &law),
    })
}

/// The probability that one law has tests at least as unlike each other, length by length, as these are: of the
/// likelihood ratio between one law and a law for each length; none where some lengths have no fit of their own, or
/// there is but one.
pub fn probability_of_one_law(tests: &[Test], fit: &Fit) -> Option<f64> {
    let mut lengths: Vec<f64> = tests.iter().map(|test| test.length).collect();
    lengths.sort_by(f64::total_cmp);
    lengths.dedup();
    let of = |length: &f64| -> Option<f64> {
        let own: Vec<Test> = tests.iter().copied().filter(|test| test.length == *length).collect();
        self::fit(&own, fit.reference_length).ok().map(|fit| fit.log_likelihood)
    };
    let apart: f64 = lengths.iter().map(of).sum::<Option<f64>>()?;
    let ratio = 2.0 * (apart - fit.log_likelihood).max(0.0);
    ChiSquared::new(2.0 * (lengths.len() - 1) as f64).ok().map(|distribution| distribution.sf(ratio))
}

/// Of these tests by a law.
pub fn log_likelihood(tests: &[Test], law: &Weibull) -> f64 {
    let of_test = |test: &Test| {
        let weight = test.length / law.reference_length;
        let ratio = (test.strength / law.scale).ln();
        let density = if test.broken { (weight * law.modulus / test.strength).ln() + law.modulus * ratio } else { 0.0 };
        density - weight * (law.modulus * ratio).exp()
    };
    tests.iter().map(of_test).sum()
}

impl Sample {
    fn new(tests: &[Test], most: f64, reference_length: f64) -> Result<Sample, String> {
        let logarithm = |test: &Test| (test.strength / most).ln();
        let broken = || tests.iter().filter(|test| test.broken);
        let sample = Sample {
            tests: tests.iter().map(|test| [logarithm(test), test.length / reference_length]).collect(),
            broken: broken().count() as f64,
            sum: broken().map(logarithm).sum(),
        };
        match broken().count() {
            0 => Err("no test has broken; allowed: two at least that have".to_string()),
            _ if sample.sum == 0.0 => {
                Err("no test has broken below another one's strength; allowed: two at least that differ".to_string())
            }
            _ => Ok(sample),
        }
    }

    /// Σ w (x/x_max)^m, and the mean of ln(x/x_max) by these weights.
    fn moments(&self, modulus: f64) -> [f64; 2] {
        let (whole, first) = self.tests.iter().fold((0.0, 0.0), |(whole, first), [y, weight]| {
            let power = weight * (modulus * y).exp();
            (whole + power, first + power * y)
        });
        [whole, first / whole]
    }

    /// The modulus of the largest likelihood.
    fn modulus(&self) -> Option<f64> {
        let score = |logarithm: f64| {
            let modulus = logarithm.exp();
            1.0 / modulus + self.sum / self.broken - self.moments(modulus)[1]
        };
        // The strength's standard deviation is some 1.28/m of itself.
        let start = (-self.broken / self.sum).ln();
        falling_root(score, start).map(f64::exp).filter(|&modulus| modulus < LARGEST)
    }

    /// The logarithm of the best scale over the largest strength.
    fn scale_given(&self, modulus: f64) -> f64 {
        (self.moments(modulus)[0] / self.broken).ln() / modulus
    }

    /// The best modulus of a scale, near to another one.
    fn modulus_given(&self, scale: f64, near: f64) -> f64 {
        let score = |logarithm: f64| {
            let modulus = logarithm.exp();
            let power = |[y, weight]: &[f64; 2]| weight * (y - scale) * (modulus * (y - scale)).exp();
            self.broken / modulus + self.sum - self.broken * scale - self.tests.iter().map(power).sum::<f64>()
        };
        falling_root(score, near.ln()).map_or(f64::NAN, f64::exp)
    }

    /// The logarithm of the likelihood, but for what no parameter changes.
    fn likelihood(&self, modulus: f64, scale: f64) -> f64 {
        let survival: f64 = self.tests.iter().map(|[y, weight]| weight * (modulus * (y - scale)).exp()).sum();
        self.broken * (modulus.ln() - modulus * scale) + (modulus - 1.0) * self.sum - survival
    }
}

/// The root of a function that falls, from a place near it.
fn falling_root(function: impl Fn(f64) -> f64, start: f64) -> Option<f64> {
    let direction = if function(start) > 0.0 { 1.0 } else { -1.0 };
    let [mut near, mut far] = [start, start + 0.1 * direction];
    for _ in 0..ITERATIONS {
        if function(far) * direction <= 0.0 {
            return Some(root(&function, near, far));
        }
        (near, far) = (far, far + 2.0 * (far - near));
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn broken(strengths: &[f64], length: f64) -> Vec<Test> {
        strengths.iter().map(|&strength| Test { strength, length, broken: true }).collect()
    }

    /// Of two tests m ln(x₂/x₁) is twice the root of u tanh u = 1.
    #[test]
    fn two_tests_have_a_closed_form() {
        for ratio in [1.01, 1.3, 20.0] {
            let fit = fit(&broken(&[2.0, 2.0 * ratio], 50.0), 50.0).expect("a fit");
            let expected = 2.0 * 1.199_678_640_257_734 / f64::ln(ratio);
            assert!((fit.modulus.value / expected - 1.0).abs() < 1e-11, "{ratio}: {fit:?}");
            let scale = (0.5 * (2.0_f64.powf(expected) + (2.0 * ratio).powf(expected))).powf(1.0 / expected);
            assert!((fit.scale.value / scale - 1.0).abs() < 1e-11, "{ratio}: {fit:?}");
        }
    }

    /// The ball bearings of Lieblein and Zelen (1956): 2.10 and 81.9 in many books.
    #[test]
    fn a_known_sample_has_its_known_fit() {
        let lives = [
            17.88, 28.92, 33.0, 41.52, 42.12, 45.6, 48.4, 51.84, 51.96, 54.12, 55.56, 67.8, 68.64, 68.64, 68.88, 84.12,
            93.12, 98.64, 105.12, 105.84, 127.92, 128.04, 173.4,
        ];
        let fit = fit(&broken(&lives, 1.0), 1.0).expect("a fit");
        assert!((fit.modulus.value - 2.102).abs() < 1e-3 && (fit.scale.value - 81.87).abs() < 0.02, "{fit:?}");
    }

    /// Some tests of three lengths, of which some have slipped.
    fn mixed() -> Vec<Test> {
        let lengths = [50.0, 200.0, 400.0];
        let strengths = [1933.0, 1700.0, 1650.0, 2010.0, 1820.0, 1590.0, 1875.0, 1610.0, 1710.0, 1905.0];
        let test = |(i, strength): (usize, f64)| Test { strength, length: lengths[i % 3], broken: i % 4 != 3 };
        strengths.into_iter().enumerate().map(test).collect()
    }

    #[test]
    fn the_fit_has_the_largest_likelihood_and_its_intervals_end_on_one_level() {
        let tests = mixed();
        let found = fit(&tests, 100.0).expect("a fit");
        let Fit { modulus, scale, log_likelihood: most, .. } = found;
        let at =
            |modulus: f64, scale: f64| log_likelihood(&tests, &Weibull { modulus, scale, reference_length: 100.0 });
        assert!((at(modulus.value, scale.value) - most).abs() < 1e-9);
        // By a search over a grid, for each parameter alone: the profile.
        let grid = |at: &dyn Fn(f64) -> f64, middle: f64| {
            let place = |i: i32| middle * (f64::from(i) * 1e-4).exp();
            (-8000..8000).map(|i| at(place(i))).fold(f64::NEG_INFINITY, f64::max)
        };
        let level = most - 0.5 * 3.841_458_820_694_124;
        for end in [modulus.low, modulus.high] {
            let profile = grid(&|scale| at(end, scale), scale.value);
            assert!((profile - level).abs() < 1e-4, "{end}: {profile} {level}");
        }
        for end in [scale.low, scale.high] {
            let profile = grid(&|modulus| at(modulus, end), modulus.value);
            assert!((profile - level).abs() < 1e-4, "{end}: {profile} {level}");
        }
        assert!(grid(&|scale| at(modulus.value, scale), scale.value) <= most + 1e-9);
        assert!(modulus.low < modulus.value && modulus.value < modulus.high);
        assert!(scale.low < scale.value && scale.value < scale.high);
    }

    /// The slopes of the likelihood vanish, and Σ w (x/s)^m is the number of those that have broken.
    #[test]
    fn the_score_vanishes() {
        let tests = mixed();
        let law = fit(&tests, 50.0).expect("a fit").law();
        let sum: f64 =
            tests.iter().map(|test| test.length / 50.0 * (test.strength / law.scale).powf(law.modulus)).sum();
        assert!((sum - 8.0).abs() < 1e-9, "{sum}");
        let slope = |of: &dyn Fn(f64) -> Weibull| {
            let step = 1e-6;
            (log_likelihood(&tests, &of(1.0 + step)) - log_likelihood(&tests, &of(1.0 - step))) / (2.0 * step)
        };
        let slopes = [
            slope(&|factor| Weibull { modulus: factor * law.modulus, ..law }),
            slope(&|factor| Weibull { scale: factor * law.scale, ..law }),
        ];
        assert!(slopes.iter().all(|slope| slope.abs() < 1e-4), "{slopes:?}");
    }

    /// Another reference length is the same law.
    #[test]
    fn a_reference_length_is_a_choice() {
        let tests = mixed();
        let [one, other] = [50.0, 400.0].map(|length| fit(&tests, length).expect("a fit"));
        assert!((one.modulus.value / other.modulus.value - 1.0).abs() < 1e-9);
        assert!((one.modulus.high / other.modulus.high - 1.0).abs() < 1e-8);
        assert!((one.law().scale_at(400.0) / other.scale.value - 1.0).abs() < 1e-9);
        assert!((one.log_likelihood - other.log_likelihood).abs() < 1e-9);
        // Units are one as well.
        let scaled: Vec<Test> = tests.iter().map(|test| Test { strength: 1e-6 * test.strength, ..*test }).collect();
        let scaled = fit(&scaled, 50.0).expect("a fit");
        assert!((scaled.scale.low / (1e-6 * one.scale.low) - 1.0).abs() < 1e-8);
    }

    /// Of one law the probability is uniform, but for small samples; of lengths that contradict each other it is small.
    #[test]
    fn lengths_that_contradict_one_law_are_told() {
        let law = Weibull { modulus: 10.0, scale: 1.0, reference_length: 50.0 };
        let mut random = fastrand::Rng::with_seed(3);
        let mut sample = |moduli: [f64; 2]| {
            let test = |i: usize| {
                let length = [50.0, 200.0][i % 2];
                let law = Weibull { modulus: moduli[i % 2], ..law };
                Test { strength: law.quantile(length, 1.0 - random.f64()), length, broken: true }
            };
            let tests: Vec<Test> = (0..80).map(test).collect();
            probability_of_one_law(&tests, &fit(&tests, 50.0).expect("a fit")).expect("two lengths")
        };
        let below = |level: f64, mut of: Box<dyn FnMut() -> f64 + '_>| {
            f64::from((0..1000).map(|_| u32::from(of() < level)).sum::<u32>()) / 1000.0
        };
        let alike = below(0.05, Box::new(|| sample([10.0, 10.0])));
        assert!((0.03..0.08).contains(&alike), "{alike}");
        let unlike = below(0.05, Box::new(|| sample([20.0, 8.0])));
        assert!(unlike > 0.9, "{unlike}");
        assert_eq!(probability_of_one_law(&mixed()[..1], &fit(&mixed(), 50.0).expect("a fit")), None);
    }

    #[test]
    fn tests_that_tell_nothing_are_refused() {
        let slipped = |mut tests: Vec<Test>| {
            tests.iter_mut().for_each(|test| test.broken = false);
            tests
        };
        let one = broken(&[3.0], 1.0);
        for (tests, message) in [
            (one.clone(), "below another one's strength"),
            (broken(&[3.0, 3.0], 1.0), "below another one's strength"),
            (slipped(broken(&[3.0, 4.0], 1.0)), "no test has broken"),
            // One has broken at the largest strength, the other has slipped before.
            ([one, slipped(broken(&[2.0], 1.0))].concat(), "below another one's strength"),
        ] {
            let error = fit(&tests, 1.0).expect_err(message);
            assert!(error.contains(message), "{error}");
        }
        // One that has broken, and a stronger one that has slipped, do.
        let tests = [broken(&[2.0], 1.0), slipped(broken(&[3.0], 1.0))].concat();
        let found = fit(&tests, 1.0).expect("a fit");
        assert!(
            found.modulus.low < 0.1 * found.modulus.value && found.scale.high > 5.0 * found.scale.value,
            "{found:?}"
        );
    }

    /// Of samples of so many tests, how often the intervals of modulus and scale hold the true values, and the mean of
    /// the modulus over the true one: with lengths in turn, and slips at strengths of the same modulus whose scale is
    /// larger by this factor.
    fn coverage(trials: u32, count: usize, lengths: &[f64], slips: f64) -> [f64; 3] {
        let law = Weibull { modulus: 10.0, scale: 1.0, reference_length: 50.0 };
        let (mut held, mut ratio) = ([0; 2], 0.0);
        let mut random = fastrand::Rng::with_seed(count as u64);
        for _ in 0..trials {
            let mut draw = |law: &Weibull, length: f64| law.quantile(length, 1.0 - random.f64());
            let test = |i: usize| {
                let length = lengths[i % lengths.len()];
                let strength = draw(&law, length);
                let slip = if slips.is_finite() { slips * draw(&law, length) } else { f64::INFINITY };
                Test { strength: strength.min(slip), length, broken: strength < slip }
            };
            let tests: Vec<Test> = (0..count).map(test).collect();
            let fit = fit(&tests, 50.0).expect("a fit");
            ratio += fit.modulus.value / law.modulus / f64::from(trials);
            for (held, (estimate, truth)) in held.iter_mut().zip([(fit.modulus, law.modulus), (fit.scale, law.scale)]) {
                *held += u32::from(estimate.low <= truth && truth <= estimate.high);
            }
        }
        let [modulus, scale] = held.map(|held| f64::from(held) / f64::from(trials));
        [modulus, scale, ratio]
    }

    /// The figures of docs/results/identification.md: 4000 samples each, with a standard error of 0.4 %.
    #[test]
    fn intervals_hold_the_truth_nearly_as_often_as_they_say() {
        const ONE: &[f64] = &[50.0];
        const THREE: &[f64] = &[50.0, 200.0, 400.0];
        const NONE: f64 = f64::INFINITY;
        for (count, lengths, slips, expected) in [
            (10, ONE, NONE, [0.935, 0.929, 1.158]),
            (20, ONE, NONE, [0.939, 0.938, 1.076]),
            (50, ONE, NONE, [0.947, 0.949, 1.029]),
            (10, ONE, 1.1, [0.928, 0.922, 1.197]),
            (20, ONE, 1.1, [0.941, 0.943, 1.089]),
            (50, ONE, 1.1, [0.944, 0.950, 1.034]),
            (10, THREE, NONE, [0.929, 0.926, 1.125]),
            (20, THREE, NONE, [0.946, 0.942, 1.056]),
            (50, THREE, NONE, [0.944, 0.948, 1.024]),
        ] {
            let found = coverage(4000, count, lengths, slips);
            let near = |(found, expected): (&f64, &f64)| (found - expected).abs() < 0.002;
            assert!(found.iter().zip(&expected).all(near), "{count} {lengths:?} {slips}: {found:?}");
        }
    }
}
