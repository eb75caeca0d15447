//! The curve of perforation over speed, by maximum likelihood, and how sure it is.
//!
//! The chance of a perforation at a speed is F(η), where η rises with the speed: a faster shot is no less likely to go
//! through. An interval has the values that the likelihood-ratio test does not refuse, everything else being what suits
//! the value best (the profile likelihood). Where the shots do not refuse a level curve the interval of a speed has no
//! end; where no speed has seen both fates that of the slope has none.

use std::f64::consts::TAU;

use rayon::prelude::*;

use super::likelihood::{Likelihood, SLOPES};
use super::link::Link;
use crate::confidence::{LEVEL, crossing, refusal_at};

/// The chances whose speeds are reported: V5, V50 and V95.
pub const CHANCES: [f64; 3] = [0.05, 0.5, 0.95];
/// The first steps from an estimate to an end of its interval: over the deviation of the speeds, and of the slope's
/// logarithm.
const FIRST_STEP: f64 = 0.25;
/// An end as far from the estimate as this, in the same units, is as good as none.
const FARTHEST: f64 = 2048.0;

/// Of more shots the intervals of a picture are traced, at so many places of their outline.
const MANY: usize = 1000;
const OUTLINE: usize = 96;

/// A shot whose fate is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fate {
    pub speed: f64,
    /// Whether it went through.
    pub through: bool,
}

/// What is asked of the shots.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    pub links: Vec<Link>,
    /// Whether curves with Firth's correction are fitted too.
    pub firth: bool,
    /// The chances whose speeds are reported.
    pub chances: Vec<f64>,
    /// The level of the intervals.
    pub level: f64,
    /// Whether η is a line over the logarithm of the speed.
    pub logarithm: bool,
    /// The spread within which test houses take their mean.
    pub spread: Option<f64>,
}

impl Default for Asked {
    fn default() -> Asked {
        let (links, chances) = (Link::BOTH.to_vec(), CHANCES.to_vec());
        Asked { links, firth: false, chances, level: LEVEL, logarithm: false, spread: None }
    }
}

/// What the shots say of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mix {
    /// Some stop was faster than some perforation: the curve has a slope.
    Mixed,
    /// No stop was faster than a perforation: the curve may be a step, anywhere between the fastest stop and the
    /// slowest perforation.
    Separated([f64; 2]),
    /// No curve that rises with the speed is better than a level one.
    Level,
    AllThrough,
    AllStopped,
}

/// An interval; an end that is missing is without bound.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Interval {
    pub low: Option<f64>,
    pub high: Option<f64>,
}

impl Interval {
    pub fn contains(&self, value: f64) -> bool {
        self.low.is_none_or(|low| low <= value) && self.high.is_none_or(|high| value <= high)
    }

    pub fn is_bounded(&self) -> bool {
        self.low.is_some() && self.high.is_some()
    }
}

/// A value with its interval; without a value where the likelihood is not largest at one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    pub value: Option<f64>,
    pub interval: Interval,
}

/// The likeliest V50, whether its interval has a low and a high end, and whether it holds another one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OfV50 {
    pub value: Option<f64>,
    pub ends: [bool; 2],
    pub holds: bool,
}

/// A curve that is fitted to shots.
#[derive(Clone, Debug)]
pub struct Curve {
    pub link: Link,
    /// Whether Firth's correction is made.
    pub firth: bool,
    pub mix: Mix,
    /// Of the chances that were asked for.
    pub speeds: Vec<Estimate>,
    v50: Estimate,
    /// Of the chance, by speed or by its logarithm, where it is a half.
    pub slope: Estimate,
    logarithm: bool,
    /// The deviance beyond which a value is refused.
    refusal: f64,
    likelihood: Likelihood,
    /// Offset, slope and likelihood of the best curve.
    best: [f64; 3],
}

/// What the shots say of a curve, before one is fitted.
pub fn mix(fates: &[Fate]) -> Mix {
    let speeds = |through: bool| fates.iter().filter(move |fate| fate.through == through).map(|fate| fate.speed);
    let bounds = |through: bool| {
        speeds(through).fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], speed| [l.min(speed), h.max(speed)])
    };
    let ([slowest_stop, fastest_stop], [slowest, fastest]) = (bounds(false), bounds(true));
    if speeds(false).next().is_none() {
        Mix::AllThrough
    } else if speeds(true).next().is_none() {
        Mix::AllStopped
    } else if fastest <= slowest_stop {
        Mix::Level
    } else if fastest_stop <= slowest {
        Mix::Separated([fastest_stop, slowest])
    } else {
        Mix::Mixed
    }
}

impl Curve {
    /// The curve of these shots over their speeds; none where all have the same fate, or the same speed.
    pub fn fit(fates: &[Fate], link: Link, firth: bool) -> Option<Curve> {
        Curve::fit_as(&Asked::default(), fates, link, firth)
    }

    /// The same, as it was asked for. Speeds are above 0 where their logarithm is asked for.
    pub fn fit_as(asked: &Asked, fates: &[Fate], link: Link, firth: bool) -> Option<Curve> {
        let found = mix(fates);
        let same_speed = fates.windows(2).all(|pair| pair[0].speed == pair[1].speed);
        if same_speed || matches!(found, Mix::AllThrough | Mix::AllStopped) {
            return None;
        }
        let logarithm = asked.logarithm;
        let place = |fate: &Fate| Fate { speed: if logarithm { fate.speed.ln() } else { fate.speed }, ..*fate };
        let mut likelihood = Likelihood::new(&fates.iter().map(place).collect::<Vec<_>>(), link, firth);
        let best = likelihood.best();
        likelihood.near = best[1];
        let found = if best[1] > 2.0 * SLOPES[0] { found } else { Mix::Level };
        let (refusal, none) = (refusal_at(asked.level), Estimate::default());
        let (speeds, v50, slope) = (Vec::new(), none, none);
        let mut curve = Curve { link, firth, mix: found, speeds, v50, slope, logarithm, refusal, likelihood, best };
        curve.speeds = asked.chances.iter().map(|&chance| curve.estimate(chance)).collect();
        let told = asked.chances.iter().position(|&chance| chance == 0.5);
        curve.v50 = told.map_or_else(|| curve.estimate(0.5), |place| curve.speeds[place]);
        curve.slope = Estimate {
            value: curve.has_values().then(|| link.slope() * best[1] / curve.likelihood.scale),
            interval: curve.slope_interval(),
        };
        Some(curve)
    }

    /// The speed of a chance.
    fn estimate(&self, chance: f64) -> Estimate {
        let value = self.has_values().then(|| self.speed(self.place(chance)));
        Estimate { value, interval: self.speed_interval(chance) }
    }

    /// The speed at a place of the likelihood.
    fn speed(&self, place: f64) -> f64 {
        let speed = self.likelihood.speed(place);
        if self.logarithm { speed.exp() } else { speed }
    }

    /// The σ of the probit, or the s of the logit: of the speed, or of its logarithm.
    pub fn scale(&self) -> Estimate {
        let of = |slope: f64| self.link.slope() / slope;
        let Interval { low, high } = self.slope.interval;
        let interval = Interval { low: Some(high.map_or(0.0, of)), high: low.filter(|&slope| slope > 0.0).map(of) };
        Estimate { value: self.slope.value.map(of), interval }
    }

    /// V50 and deviation of the likeliest normal distribution, without intervals and without a check of what they are
    /// worth.
    pub fn likeliest(fates: &[Fate]) -> [f64; 2] {
        let likelihood = Likelihood::new(fates, Link::Probit, false);
        let [offset, slope, _] = likelihood.best();
        [likelihood.speed(-offset / slope), likelihood.scale / slope]
    }

    /// What the shots say of a V50, in less time than a whole curve takes; none where there is no curve.
    pub fn of_v50(fates: &[Fate], link: Link, v50: f64) -> Option<OfV50> {
        let found = mix(fates);
        let same_speed = fates.windows(2).all(|pair| pair[0].speed == pair[1].speed);
        if same_speed || matches!(found, Mix::AllThrough | Mix::AllStopped) {
            return None;
        }
        let likelihood = Likelihood::new(fates, link, false);
        let is_separated = matches!(found, Mix::Separated(_));
        // A step in the gap leaves nothing to chance.
        let [offset, slope, largest] = if is_separated { [0.0; 3] } else { likelihood.best() };
        let refuses = |likelihood: f64| 2.0 * (largest - likelihood) > refusal_at(LEVEL);
        let is_level = !is_separated && slope <= 2.0 * SLOPES[0];
        let has_end = |below: bool| !is_level && refuses(likelihood.level(0.0, below));
        let ends = [true, false].map(has_end);
        let value = (!is_separated && !is_level).then(|| likelihood.speed(-offset / slope));
        let place = match found {
            Mix::Separated([stop, through]) => 0.5 * (stop + through),
            _ => value.unwrap_or(v50),
        };
        let is_within = !refuses(likelihood.through(0.0, (v50 - likelihood.mean) / likelihood.scale));
        let holds = is_within || !ends[usize::from(v50 > place)];
        Some(OfV50 { value, ends, holds })
    }

    /// V50 of the likeliest normal distribution with this deviation.
    pub fn likeliest_of_deviation(fates: &[Fate], deviation: f64) -> f64 {
        let likelihood = Likelihood::new(fates, Link::Probit, false);
        let slope = likelihood.scale / deviation;
        let (offset, _) = likelihood.with_slope(slope);
        likelihood.speed(-offset / slope)
    }

    /// Whether the likelihood is largest at one curve that rises.
    fn has_values(&self) -> bool {
        self.mix == Mix::Mixed || self.firth && self.mix != Mix::Level
    }

    pub fn v50(&self) -> &Estimate {
        &self.v50
    }

    /// The chance of a perforation at a speed above 0, where there is one best curve.
    pub fn chance(&self, speed: f64) -> Option<f64> {
        let (v50, slope) = (self.v50.value?, self.slope.value?);
        let distance = if self.logarithm { (speed / v50).ln() } else { speed - v50 };
        Some(self.link.chance(slope / self.link.slope() * distance))
    }

    /// The largest likelihood, as the intervals have it.
    pub fn largest(&self) -> f64 {
        self.best[2]
    }

    /// Where the likelihood of V50 is largest, or a place in the gap where it is so everywhere; as for
    /// [`Curve::with_v50`].
    pub fn likeliest_place(&self) -> f64 {
        self.likelihood.speed(self.place(0.5))
    }

    /// The standard deviation of the speeds, or of their logarithms.
    pub fn spread(&self) -> f64 {
        self.likelihood.scale
    }

    /// The largest likelihood of a curve whose V50 lies at a speed, or at its logarithm where that is asked for.
    pub fn with_v50(&self, place: f64) -> f64 {
        self.likelihood.through(0.0, (place - self.likelihood.speed(0.0)) / self.likelihood.scale)
    }

    /// The logarithm of the likelihood of the best curve, without a penalty.
    pub fn log_likelihood(&self) -> f64 {
        self.likelihood.log_likelihood(self.best[0], self.best[1])
    }

    /// The deviation of a normal distribution with the curve's slope.
    pub fn deviation(&self) -> Option<f64> {
        self.slope.value.map(|slope| Link::Probit.slope() / slope)
    }

    /// Where the best curve has a chance.
    fn place(&self, chance: f64) -> f64 {
        (self.link.quantile(chance) - self.best[0]) / self.best[1]
    }

    /// The speeds that may have this chance.
    pub fn speed_interval(&self, chance: f64) -> Interval {
        let (likelihood, eta) = (&self.likelihood, self.link.quantile(chance));
        let end = |below: bool| {
            // Far below the shots a chance is that of a level curve that has it there, or more.
            if self.mix == Mix::Level || !self.is_refused(likelihood.level(eta, below)) {
                return None;
            }
            let deviance = |x: f64| self.deviance(likelihood.through(eta, x));
            let first = if below { -FIRST_STEP } else { FIRST_STEP };
            crossing(deviance, self.place(chance), first, self.refusal, FARTHEST).map(|x| self.speed(x))
        };
        Interval { low: end(true), high: end(false) }
    }

    /// The speeds that may have these chances, as a picture shows them: of many shots the outline of all curves that are
    /// not refused is traced once, and the ends are those of its places.
    pub fn speed_intervals(&self, chances: &[f64]) -> Vec<Interval> {
        let outline = if self.likelihood.count() > MANY { self.outline() } else { None };
        let Some(outline) = outline else {
            return chances.par_iter().map(|&chance| self.speed_interval(chance)).collect();
        };
        let of = |&chance: &f64| {
            let eta = self.link.quantile(chance);
            let speeds = outline.iter().map(|[a, b]| self.speed((eta - a) / b));
            let ends = [f64::INFINITY, f64::NEG_INFINITY];
            let [low, high] = speeds.fold(ends, |[low, high], speed| [low.min(speed), high.max(speed)]);
            Interval { low: Some(low), high: Some(high) }
        };
        chances.iter().map(of).collect()
    }

    /// Offsets and slopes around all curves that are not refused; none where some of these are level.
    fn outline(&self) -> Option<Vec<[f64; 2]>> {
        let [a, b, _] = self.best;
        if self.mix != Mix::Mixed || self.slope.interval.low.is_none_or(|low| low <= 0.0) {
            return None;
        }
        // In these directions the curves that are just not refused are about as far.
        let (_, [aa, ab, bb]) = self.likelihood.derivatives(a, b);
        let first = (-aa).sqrt();
        let second = (ab * ab / aa - bb).sqrt();
        let first_step = self.refusal.sqrt();
        let end = |place: usize| {
            let (sine, cosine) = (TAU * place as f64 / OUTLINE as f64).sin_cos();
            let along_b = sine / second;
            let along = [(cosine + ab / first * along_b) / first, along_b];
            let at = |part: f64| [a + part * along[0], b + part * along[1]];
            let deviance = |part: f64| {
                let [a, b] = at(part);
                if b > 0.0 { self.deviance(self.likelihood.objective(a, b)) } else { f64::NAN }
            };
            crossing(deviance, 0.0, first_step, self.refusal, FARTHEST).map(at)
        };
        (0..OUTLINE).into_par_iter().map(end).collect()
    }

    fn slope_interval(&self) -> Interval {
        let deviance = |log: f64| self.deviance(self.likelihood.with_slope(log.exp()).1);
        let end = |limit: f64, first: f64| {
            if !self.is_refused(self.likelihood.with_slope(limit).1) {
                return None;
            }
            let slope = crossing(deviance, self.best[1].ln(), first, self.refusal, FARTHEST)?.exp();
            Some(self.link.slope() * slope / self.likelihood.scale)
        };
        Interval { low: end(SLOPES[0], -FIRST_STEP).or(Some(0.0)), high: end(SLOPES[1], FIRST_STEP) }
    }

    /// Twice the logarithm of the likelihood that a value costs.
    fn deviance(&self, likelihood: f64) -> f64 {
        2.0 * (self.best[2] - likelihood)
    }

    fn is_refused(&self, likelihood: f64) -> bool {
        self.deviance(likelihood) > self.refusal
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fates(speeds: &[f64], through: &[u8]) -> Vec<Fate> {
        speeds.iter().zip(through).map(|(&speed, &through)| Fate { speed, through: through == 1 }).collect()
    }

    /// So many of so many shots go through at each speed.
    fn groups(groups: &[(f64, usize, usize)]) -> Vec<Fate> {
        let group = |&(speed, through, shots): &(f64, usize, usize)| {
            (0..shots).map(move |shot| Fate { speed, through: shot < through })
        };
        groups.iter().flat_map(group).collect()
    }

    fn value(estimate: &Estimate) -> f64 {
        estimate.value.expect("there is a value")
    }

    #[track_caller]
    fn assert_close(found: f64, expected: f64, tolerance: f64) {
        assert!((found / expected - 1.0).abs() < tolerance, "{found}, expected {expected}");
    }

    /// Two speeds have as many parameters as chances: the curve has the shares of both, Firth's those with half a shot
    /// more of either fate.
    #[test]
    fn two_speeds_have_a_closed_form() {
        let shots = groups(&[(100.0, 3, 12), (140.0, 8, 10)]);
        for link in Link::BOTH {
            for (firth, shares) in [(false, [3.0 / 12.0, 8.0 / 10.0]), (true, [3.5 / 13.0, 8.5 / 11.0])] {
                if firth && link == Link::Probit {
                    continue; // Jeffreys' prior of the probit has no such form
                }
                let [a, b] = shares.map(|share| link.quantile(share));
                let slope = (b - a) / 40.0;
                let curve = Curve::fit(&shots, link, firth).expect("a curve");
                assert_eq!(curve.mix, Mix::Mixed);
                for (estimate, chance) in curve.speeds.iter().zip(CHANCES) {
                    assert_close(value(estimate), 100.0 + (link.quantile(chance) - a) / slope, 1e-6);
                }
                assert_close(value(&curve.slope), link.slope() * slope, 1e-6);
                assert_close(curve.chance(140.0).expect("a chance"), shares[1], 1e-6);
            }
        }
    }

    /// The drops of Neyer's example, over the logarithm of their heights; the estimates are those of the package SenPy.
    #[test]
    fn a_published_set_has_its_published_curve() {
        let heights = [
            1.0, 1.2, 1.4, 1.8, 2.6, 4.2, 3.4, 3.8, 4.0, 4.1, 4.28, 4.52, 5.55, 5.24, 6.37, 6.08, 7.38, 7.09, 6.89,
            6.74,
        ];
        let fired = [0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 1, 1, 1, 1];
        let curve = Curve::fit(&fates(&heights.map(f64::ln), &fired), Link::Logit, false).expect("a curve");
        assert_close(value(curve.v50()).exp(), 5.317603889844265, 1e-6);
        assert_close(value(&curve.slope) / Link::Logit.slope(), 8.27725905945797, 1e-5);
    }

    /// An end of an interval is where the best of all slopes has the deviance at which the test refuses: by sums over
    /// shots and pairs of them.
    #[test]
    fn intervals_are_those_of_the_profile() {
        let shots = fates(
            &[84.0, 90.0, 96.0, 100.0, 105.0, 110.0, 112.0, 120.0, 126.0, 140.0],
            &[0, 0, 0, 0, 1, 0, 1, 1, 1, 1],
        );
        let of = |link: Link, firth: bool, eta: &dyn Fn(f64) -> f64| {
            let chance = |shot: &Fate| if shot.through { eta(shot.speed) } else { -eta(shot.speed) };
            let likelihood: f64 = shots.iter().map(|shot| link.log_chance(chance(shot))).sum();
            let weight = |shot: &Fate| link.log_information(eta(shot.speed)).exp();
            let pair = |one: &Fate, other: &Fate| weight(one) * weight(other) * (one.speed - other.speed).powi(2);
            let pairs: f64 = shots.iter().map(|one| shots.iter().map(|other| pair(one, other)).sum::<f64>()).sum();
            likelihood + if firth { 0.5 * pairs.ln() } else { 0.0 }
        };
        for (link, firth) in [(Link::Logit, false), (Link::Logit, true), (Link::Probit, false), (Link::Probit, true)] {
            let curve = Curve::fit(&shots, link, firth).expect("a curve");
            let slope = value(&curve.slope) / link.slope();
            let best = of(link, firth, &|speed| slope * (speed - value(curve.v50())));
            for (estimate, chance) in curve.speeds.iter().zip(CHANCES) {
                for end in [estimate.interval.low, estimate.interval.high].into_iter().flatten() {
                    let line = |slope: f64| of(link, firth, &|speed| link.quantile(chance) + slope * (speed - end));
                    let slopes = (0..3000).map(|i| (-9.0 + 9.0 * f64::from(i) / 3000.0).exp());
                    let deviance = 2.0 * (best - slopes.map(line).fold(f64::NEG_INFINITY, f64::max));
                    assert!((deviance - 3.841_458_820_694_124).abs() < 1e-4, "{link:?} {firth} {chance}: {deviance}");
                }
            }
            assert!(curve.v50().interval.is_bounded(), "{curve:?}");
        }
    }

    /// No zone of mixed results: no slope, but a gap; V50 has an interval all the same, and Firth's correction values.
    #[test]
    fn separated_shots_have_a_gap() {
        let shots = fates(&[100.0, 104.0, 108.0, 112.0, 116.0, 120.0, 124.0, 128.0], &[0, 0, 0, 0, 1, 1, 1, 1]);
        for link in Link::BOTH {
            let curve = Curve::fit(&shots, link, false).expect("a curve");
            assert_eq!(curve.mix, Mix::Separated([112.0, 116.0]));
            assert_eq!((curve.v50().value, curve.slope.value, curve.slope.interval.high), (None, None, None));
            assert!(curve.log_likelihood().abs() < 1e-9);
            let Interval { low: Some(low), high: Some(high) } = curve.v50().interval else { panic!("{curve:?}") };
            assert!(low < 112.0 && high > 116.0 && (low + high - 228.0).abs() < 1e-4, "{low} {high}");
            assert!(curve.slope.interval.low.is_some_and(|low| low > 0.0));
            let firth = Curve::fit(&shots, link, true).expect("a curve");
            assert_close(value(firth.v50()), 114.0, 1e-6);
            assert!(value(&firth.slope) > 0.0 && firth.slope.interval.high.is_some(), "{firth:?}");
        }
        // Two speeds: half a shot more of either fate.
        let firth = Curve::fit(&groups(&[(100.0, 0, 5), (140.0, 5, 5)]), Link::Logit, true).expect("a curve");
        assert_close(value(&firth.slope), 0.25 * 2.0 * (5.5_f64 / 0.5).ln() / 40.0, 1e-6);
    }

    /// Few shots may not refuse a level curve: the interval of a speed has no end then.
    #[test]
    fn intervals_without_end_are_seen() {
        let shots = fates(&[100.0, 110.0, 120.0, 130.0], &[0, 1, 0, 1]);
        let curve = Curve::fit(&shots, Link::Logit, false).expect("a curve");
        assert_eq!(curve.mix, Mix::Mixed);
        assert_eq!(curve.v50().interval, Interval { low: None, high: None });
        assert_eq!(curve.slope.interval.low, Some(0.0));
        // Far from the shots nothing else is found.
        let level = curve.likelihood.level(0.0, true);
        assert!((level - curve.likelihood.through(0.0, -1e4)).abs() < 1e-3);
    }

    #[test]
    fn shots_without_a_curve_are_told_apart() {
        let speeds = [100.0, 110.0, 120.0, 130.0];
        for (through, expected) in [
            ([1, 1, 1, 1], Mix::AllThrough),
            ([0, 0, 0, 0], Mix::AllStopped),
            ([1, 1, 0, 0], Mix::Level),
            ([0, 0, 1, 1], Mix::Separated([110.0, 120.0])),
            ([0, 1, 0, 1], Mix::Mixed),
        ] {
            assert_eq!(mix(&fates(&speeds, &through)), expected);
        }
        // One speed with both fates, between separated ones.
        assert_eq!(mix(&fates(&[1.0, 2.0, 2.0, 3.0], &[0, 0, 1, 1])), Mix::Separated([2.0, 2.0]));
        assert!(Curve::fit(&fates(&speeds, &[1; 4]), Link::Logit, false).is_none());
        assert!(Curve::fit(&fates(&[2.0, 2.0], &[0, 1]), Link::Logit, false).is_none());
        let falling = Curve::fit(&fates(&speeds, &[1, 1, 0, 1]), Link::Probit, false).expect("a curve");
        assert_eq!((falling.mix, falling.v50().value), (Mix::Level, None));
        assert_eq!(falling.v50().interval, Interval { low: None, high: None });
    }

    /// Of many shots the intervals of a picture are those of whole curves, to a thousandth of their widths.
    #[test]
    fn intervals_of_many_shots_are_traced() {
        let shot = |i: u64| {
            let speed = 550.0 + 100.0 * crate::chance::uniform(1, [i, 0]);
            let chance = Link::Probit.chance((speed - 600.0) / 15.0);
            Fate { speed, through: crate::chance::uniform(1, [i, 1]) < chance }
        };
        let shots: Vec<Fate> = (0..MANY as u64 + 1).map(shot).collect();
        let chances = [0.002, 0.1, 0.5, 0.98];
        for link in Link::BOTH {
            let curve = Curve::fit(&shots, link, false).expect("a curve");
            assert!(curve.outline().is_some());
            for (chance, found) in chances.iter().zip(curve.speed_intervals(&chances)) {
                let exact = curve.speed_interval(*chance);
                let [found, exact] = [found, exact].map(|it| it.low.zip(it.high).expect("ends"));
                let apart = (found.0 - exact.0).abs().max((found.1 - exact.1).abs());
                assert!(apart < 1e-3 * (exact.1 - exact.0), "{chance}: {found:?} {exact:?}");
            }
        }
        // Of few shots they are the same.
        let few = Curve::fit(&shots[..40], Link::Logit, false).expect("a curve");
        assert_eq!(few.speed_intervals(&[0.5]), [few.speed_interval(0.5)]);
    }

    /// Speeds of another unit are the same shots.
    #[test]
    fn nothing_depends_on_the_unit() {
        let speeds = [90.0, 100.0, 105.0, 110.0, 112.0, 120.0, 126.0, 140.0];
        let through = [0, 0, 1, 0, 0, 1, 1, 1];
        let fit = |factor: f64| {
            Curve::fit(&fates(&speeds.map(|speed| factor * speed), &through), Link::Probit, true).expect("a curve")
        };
        let (one, other) = (fit(1.0), fit(1000.0));
        for (one, other) in one.speeds.iter().zip(&other.speeds) {
            assert_close(value(other), 1000.0 * value(one), 1e-7);
            if let (Some(one), Some(other)) = (one.interval.low, other.interval.low) {
                assert_close(other, 1000.0 * one, 1e-7);
            }
        }
        assert_close(value(&one.slope), 1000.0 * value(&other.slope), 1e-6);
    }
}
