//! Experiments that are simulated: how often the intervals hold what they should, and how often there is nothing to
//! hold.

use rayon::prelude::*;

use super::curve::{CHANCES, Curve, Fate, Mix};
use super::designs::{Design, Fired, scattered};
use super::link::Link;
use crate::chance::uniform;

/// How shots are fired.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Experiment {
    pub design: Design,
    pub shots: usize,
    pub range: [f64; 2],
    /// The standard deviation of a shot's speed from what it was to be.
    pub scatter: f64,
}

/// The curve that a panel has: the fates follow it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truth {
    pub link: Link,
    pub v50: f64,
    /// Of the normal distribution with the same slope at V50.
    pub deviation: f64,
}

impl Truth {
    /// The speed of a chance.
    fn speed(&self, chance: f64) -> f64 {
        self.v50 + self.link.quantile(chance) * self.scale()
    }

    fn chance(&self, speed: f64) -> f64 {
        self.link.chance((speed - self.v50) / self.scale())
    }

    fn scale(&self) -> f64 {
        self.link.slope() / Link::Probit.slope() * self.deviation
    }
}

/// What came of many experiments. Shares are those of all of them, but for the coverages: of those that have a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Coverage {
    /// How often the intervals of V5, V50 and V95 hold them, where there is a curve at all.
    pub speeds: [Option<f64>; 3],
    /// How often V50's interval has no end on one side.
    pub unbounded: f64,
    pub separated: f64,
    /// As `speeds`, of the separated experiments alone.
    pub speeds_where_separated: [Option<f64>; 3],
    /// How often no curve rises, and how often all shots had the same fate.
    pub level: f64,
    pub one_fate: f64,
    /// The mean of V50 less the true one, and its standard deviation, where there are a value and two; over the true
    /// deviation.
    pub bias: Option<f64>,
    pub error: Option<f64>,
    /// The middle one of the widths of V50's intervals over the true deviation; one without an end is wider than all
    /// others.
    pub width: Option<f64>,
}

impl Experiment {
    /// The fates of the experiment of this number.
    pub fn fates(&self, truth: &Truth, seed: u64, number: u64) -> Vec<Fate> {
        let mut before: Vec<Fired> = Vec::new();
        for shot in 1..=self.shots {
            let chance = |kind: u64| uniform(seed, [number, shot as u64, kind]);
            let nominal = self.design.speed(shot, &before, self.range);
            let speed = scattered(nominal, self.scatter, chance(0));
            before.push(Fired { nominal, fate: Fate { speed, through: chance(1) < truth.chance(speed) } });
        }
        before.into_iter().map(|shot| shot.fate).collect()
    }

    /// So many experiments, and the curves of the truth's link that are fitted to them.
    pub fn coverage(&self, truth: &Truth, firth: bool, experiments: u64, seed: u64) -> Coverage {
        let curves: Vec<Option<Curve>> = (0..experiments)
            .into_par_iter()
            .map(|number| Curve::fit(&self.fates(truth, seed, number), truth.link, firth))
            .collect();
        let share = |count: usize, of: usize| count as f64 / of.max(1) as f64;
        let found: Vec<&Curve> = curves.iter().flatten().collect();
        let among_all = |is: fn(&Curve) -> bool| share(found.iter().filter(|curve| is(curve)).count(), curves.len());
        let separated: Vec<&Curve> =
            found.iter().filter(|curve| matches!(curve.mix, Mix::Separated(_))).copied().collect();
        let holds = |of: &[&Curve], which: usize| {
            let speed = truth.speed(CHANCES[which]);
            let held = of.iter().filter(|curve| curve.speeds[which].interval.contains(speed)).count();
            (!of.is_empty()).then(|| share(held, of.len()))
        };
        let errors: Vec<f64> =
            found.iter().filter_map(|curve| curve.v50().value).map(|v50| (v50 - truth.v50) / truth.deviation).collect();
        let n = errors.len() as f64;
        let mean = errors.iter().sum::<f64>() / n;
        let variance = errors.iter().map(|error| (error - mean).powi(2)).sum::<f64>() / (n - 1.0);
        let width = |curve: &&Curve| {
            let interval = curve.v50().interval;
            interval.high.zip(interval.low).map_or(f64::INFINITY, |(high, low)| (high - low) / truth.deviation)
        };
        let mut widths: Vec<f64> = found.iter().map(width).collect();
        widths.sort_by(f64::total_cmp);
        Coverage {
            speeds: [0, 1, 2].map(|which| holds(&found, which)),
            unbounded: among_all(|curve| !curve.v50().interval.is_bounded()),
            separated: share(separated.len(), curves.len()),
            speeds_where_separated: [0, 1, 2].map(|which| holds(&separated, which)),
            level: among_all(|curve| curve.mix == Mix::Level),
            one_fate: share(curves.len() - found.len(), curves.len()),
            bias: (!errors.is_empty()).then_some(mean),
            error: (errors.len() > 1).then_some(variance.sqrt()),
            width: widths.get(widths.len() / 2).copied().filter(|width| width.is_finite()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RANGE: [f64; 2] = [60.0, 140.0];

    fn experiment(design: Design, shots: usize) -> Experiment {
        Experiment { design, shots, range: RANGE, scatter: 1.0 }
    }

    /// The share of perforations at a speed is the truth's, and the shots of an experiment depend on nothing but its
    /// number.
    #[test]
    fn fates_follow_the_truth() {
        for link in Link::BOTH {
            let truth = Truth { link, v50: 100.0, deviation: 10.0 };
            assert!((truth.chance(truth.speed(0.95)) - 0.95).abs() < 1e-9);
            let fates = Experiment { scatter: 0.0, ..experiment(Design::Even, 4000) }.fates(&truth, 1, 0);
            let expected: f64 = fates.iter().map(|fate| truth.chance(fate.speed)).sum();
            let found = fates.iter().filter(|fate| fate.through).count() as f64;
            let variance: f64 =
                fates.iter().map(|fate| truth.chance(fate.speed)).map(|chance| chance * (1.0 - chance)).sum();
            assert!((found - expected).abs() < 4.0 * variance.sqrt(), "{found} {expected}");
            let short = Experiment { scatter: 0.0, ..experiment(Design::Even, 10) };
            assert_eq!(short.fates(&truth, 1, 0), fates[..10]);
            assert_ne!(
                experiment(Design::Even, 10).fates(&truth, 1, 1),
                experiment(Design::Even, 10).fates(&truth, 1, 0)
            );
        }
    }

    /// Nothing is said of curves that there are not, and no deviation of one value.
    #[test]
    fn experiments_without_a_curve_have_no_figures() {
        let truth = Truth { link: Link::Logit, v50: 400.0, deviation: 5.0 };
        let none = experiment(Design::Even, 10).coverage(&truth, false, 20, 7);
        assert_eq!((none.one_fate, none.speeds, none.bias, none.error, none.width), (1.0, [None; 3], None, None, None));
        let truth = Truth { link: Link::Logit, v50: 100.0, deviation: 15.0 };
        let one = experiment(Design::Langlie, 20).coverage(&truth, false, 1, 7);
        assert!(one.bias.is_some() && one.error.is_none(), "{one:?}");
    }

    /// A shot is no slower than a tenth of what it was to be, as those of a scene.
    #[test]
    fn simulated_speeds_are_above_zero() {
        let wide = Experiment { scatter: 200.0, ..experiment(Design::Even, 200) };
        let fates = wide.fates(&Truth { link: Link::Logit, v50: 100.0, deviation: 10.0 }, 1, 0);
        let least = fates.iter().map(|fate| fate.speed).fold(f64::INFINITY, f64::min);
        assert!((6.0..14.0).contains(&least), "{least}");
    }

    /// With many shots the intervals hold what they should nearly as often as they say; with few separation is
    /// frequent.
    #[test]
    fn intervals_hold_nearly_as_often_as_they_say() {
        let truth = Truth { link: Link::Probit, v50: 103.0, deviation: 10.0 };
        let many = experiment(Design::Even, 60).coverage(&truth, false, 200, 7);
        assert!(many.speeds.iter().flatten().all(|share| (0.88..0.995).contains(share)), "{many:?}");
        let [bias, error] = [many.bias, many.error].map(|value| value.expect("there are values"));
        assert!(bias.abs() < 0.1 && error < 0.4 && many.unbounded == 0.0, "{many:?}");
        let few = experiment(Design::Langlie, 8).coverage(&truth, false, 200, 7);
        assert!(few.separated > 0.2 && few.width > many.width, "{few:?}");
        let firth = experiment(Design::Langlie, 8).coverage(&truth, true, 200, 7);
        assert_eq!((firth.separated, firth.one_fate), (few.separated, few.one_fate));
        // A steep curve is between the shots: what they do not refuse holds its V5, and the penalty says that it is flat.
        let steep = Truth { link: Link::Logit, v50: 103.0, deviation: 1.0 };
        let [plain, penalised] = [false, true]
            .map(|firth| experiment(Design::Even, 20).coverage(&steep, firth, 200, 7).speeds_where_separated);
        assert!(plain[0] > Some(0.95) && penalised[0].is_some_and(|share| share < 0.9), "{plain:?} {penalised:?}");
        // None of the separated ones lacks a value.
        assert!(firth.error.is_some_and(f64::is_finite) && firth.level <= few.level + 0.05, "{firth:?}");
    }
}
