//! The likelihood of a curve: F(a + b x) at the speeds x, which are counted from their mean in their standard
//! deviation.

use super::curve::Fate;
use super::link::Link;
use super::search::{falling_root, maximum};

/// Slopes b at which the curve is as good as level, and as good as a step.
pub const SLOPES: [f64; 2] = [1e-6, 1e6];
/// η at which a chance is as good as 1.
const FAR: f64 = 40.0;
/// Newton's steps, at most, and where they end: how little they move the curve, and what is left of one that finds
/// nothing better.
const NEWTON: usize = 60;
const NEWTON_END: f64 = 1e-10;
const CONVERGED: f64 = 1e-5;
const LEAST_PART: f64 = 1e-8;
/// Slopes between which Newton's steps are believed: others are looked for in another way.
const FLATTEST: f64 = 1e-4;
const STEEPEST: f64 = 1e4;
/// A weight of so small a part of the largest one, as a logarithm, is nothing beside it.
const NOTHING: f64 = -100.0;

/// The shots, and what is sought.
#[derive(Clone, Debug)]
pub struct Likelihood {
    link: Link,
    firth: bool,
    shots: Vec<Fate>,
    /// The mean speed.
    pub mean: f64,
    /// The deviation of the speeds.
    pub scale: f64,
    /// A slope near which the best one of a line is sought first.
    pub near: f64,
}

impl Likelihood {
    /// Of these shots, whose speeds are not all the same.
    pub fn new(fates: &[Fate], link: Link, firth: bool) -> Likelihood {
        let n = fates.len() as f64;
        let mean = fates.iter().map(|fate| fate.speed).sum::<f64>() / n;
        let scale = (fates.iter().map(|fate| (fate.speed - mean).powi(2)).sum::<f64>() / n).sqrt();
        let shots = fates.iter().map(|fate| Fate { speed: (fate.speed - mean) / scale, ..*fate }).collect();
        Likelihood { link, firth, shots, mean, scale, near: 1.0 }
    }

    pub fn count(&self) -> usize {
        self.shots.len()
    }

    /// The speed at a place x.
    pub fn speed(&self, x: f64) -> f64 {
        self.mean + self.scale * x
    }

    /// The logarithm of the likelihood of a curve, without a penalty.
    pub fn log_likelihood(&self, a: f64, b: f64) -> f64 {
        let one =
            |shot: &Fate| self.link.log_chance(if shot.through { a + b * shot.speed } else { -a - b * shot.speed });
        self.shots.iter().map(one).sum()
    }

    /// The logarithm of the likelihood and what it has for slopes along a line of curves, whose offset and slope are
    /// known at a place of it, with their slopes.
    fn along(&self, curve: impl Fn(f64) -> [f64; 2], slopes: [f64; 2], place: f64) -> [f64; 2] {
        let [a, b] = curve(place);
        self.shots.iter().fold([0.0; 2], |[first, second], shot| {
            let side = if shot.through { 1.0 } else { -1.0 };
            let [_, one, two] = self.link.log_chance_with_slopes(side * (a + b * shot.speed));
            let slope = side * (slopes[0] + slopes[1] * shot.speed);
            [first + one * slope, second + two * slope * slope]
        })
    }

    /// The slopes of the logarithm of the likelihood in a and b, and its second derivatives, aa, ab and bb.
    pub fn derivatives(&self, a: f64, b: f64) -> ([f64; 2], [f64; 3]) {
        let (mut slopes, mut bends) = ([0.0; 2], [0.0; 3]);
        for shot in &self.shots {
            let side = if shot.through { 1.0 } else { -1.0 };
            let [_, one, two] = self.link.log_chance_with_slopes(side * (a + b * shot.speed));
            let x = shot.speed;
            slopes = [slopes[0] + side * one, slopes[1] + side * one * x];
            bends = [bends[0] + two, bends[1] + two * x, bends[2] + two * x * x];
        }
        (slopes, bends)
    }

    /// The best curve by Newton's steps, where there is one that rises; without a penalty the likelihood is concave.
    fn newton(&self) -> Option<[f64; 3]> {
        let share = self.shots.iter().filter(|shot| shot.through).count() as f64 / self.shots.len() as f64;
        let (mut a, mut b) = (self.link.quantile(share.clamp(0.01, 0.99)), 1.0);
        let mut value = self.log_likelihood(a, b);
        for _ in 0..NEWTON {
            let (slopes, bends) = self.derivatives(a, b);
            let determinant = bends[0] * bends[2] - bends[1] * bends[1];
            let step = [
                (bends[1] * slopes[1] - bends[2] * slopes[0]) / determinant,
                (bends[1] * slopes[0] - bends[0] * slopes[1]) / determinant,
            ];
            let mut part = 1.0;
            let mut next = self.log_likelihood(a + step[0], b + step[1]);
            while next.is_nan() || next < value {
                part *= 0.5;
                if part < LEAST_PART {
                    break;
                }
                next = self.log_likelihood(a + part * step[0], b + part * step[1]);
            }
            if part < LEAST_PART {
                // No better place along the step: this one, as far as its digits go.
                return (step[0].abs() + step[1].abs() < CONVERGED * (1.0 + b)).then_some([a, b, value]);
            }
            (a, b, value) = (a + part * step[0], b + part * step[1], next);
            if !(b < STEEPEST && value.is_finite()) {
                return None;
            }
            if step[0].abs() + step[1].abs() < NEWTON_END * (1.0 + b) {
                return (b > FLATTEST).then_some([a, b, value]);
            }
        }
        None
    }

    /// What is maximised: the log-likelihood, plus half the logarithm of the information's determinant with Firth's
    /// correction.
    pub fn objective(&self, a: f64, b: f64) -> f64 {
        self.log_likelihood(a, b) + if self.firth { 0.5 * self.log_information(a, b) } else { 0.0 }
    }

    /// The logarithm of the determinant of Fisher's information on a and b: the sum of w_i w_j (x_i − x_j)² over all
    /// pairs.
    fn log_information(&self, a: f64, b: f64) -> f64 {
        let weights: Vec<f64> = self.shots.iter().map(|shot| self.link.log_information(a + b * shot.speed)).collect();
        let (first, most) = largest(weights.iter().copied());
        let x = self.shots[first].speed;
        let others = |i: &usize| self.shots[*i].speed != x;
        let (_, second) = largest((0..weights.len()).map(|i| if others(&i) { weights[i] } else { f64::NEG_INFINITY }));
        let indices = 0..weights.len();
        if second - most > NOTHING {
            let shares: Vec<f64> = weights.iter().map(|weight| (weight - most).exp()).collect();
            let sum: f64 = shares.iter().sum();
            let centre = indices.clone().map(|i| shares[i] * self.shots[i].speed).sum::<f64>() / sum;
            let spread: f64 = indices.map(|i| shares[i] * (self.shots[i].speed - centre).powi(2)).sum();
            return 2.0 * most + (sum * spread).ln();
        }
        // The pairs without the speed of the largest weight are nothing beside those with it.
        let own: f64 = indices.clone().filter(|i| !others(i)).map(|i| (weights[i] - most).exp()).sum();
        let pairs: f64 =
            indices.filter(others).map(|i| (weights[i] - second).exp() * (self.shots[i].speed - x).powi(2)).sum();
        most + second + (own * pairs).ln()
    }

    /// The best offset a with a slope, and its likelihood.
    pub fn with_slope(&self, b: f64) -> (f64, f64) {
        let speeds = self.shots.iter().map(|shot| -b * shot.speed);
        let (low, high) = speeds.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), a| (l.min(a), h.max(a)));
        if self.firth {
            return maximum(|a| self.objective(a, b), [low - FAR, high + FAR]);
        }
        let a = falling_root(|a| self.along(|a| [a, b], [1.0, 0.0], a), [low - FAR, high + FAR], 0.0);
        (a, self.log_likelihood(a, b))
    }

    /// The best slope, its offset and their likelihood.
    pub fn best(&self) -> [f64; 3] {
        if let Some(best) = self.newton().filter(|_| !self.firth) {
            return best;
        }
        let (log, _) = maximum(|log| self.with_slope(log.exp()).1, SLOPES.map(f64::ln));
        let slope = log.exp();
        let (offset, value) = self.with_slope(slope);
        [offset, slope, value]
    }

    /// The largest likelihood of a curve that has this η at a place x.
    pub fn through(&self, eta: f64, x: f64) -> f64 {
        if !self.firth {
            let b = falling_root(|b| self.along(|b| [eta - b * x, b], [-x, 1.0], b), SLOPES, self.near);
            return self.log_likelihood(eta - b * x, b);
        }
        maximum(
            |log| {
                let b = log.exp();
                self.objective(eta - b * x, b)
            },
            SLOPES.map(f64::ln),
        )
        .1
    }

    /// The largest likelihood of a level curve whose η is at least, or at most, this: what is left where its place is
    /// far away.
    pub fn level(&self, eta: f64, above: bool) -> f64 {
        let bounds = if above { [eta, FAR] } else { [-FAR, eta] };
        maximum(|a| self.objective(a, SLOPES[0]), bounds).1
    }
}

/// The largest value and its place.
fn largest(values: impl Iterator<Item = f64>) -> (usize, f64) {
    values.enumerate().fold((0, f64::NEG_INFINITY), |best, found| if found.1 > best.1 { found } else { best })
}
