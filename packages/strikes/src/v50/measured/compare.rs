//! Two tables of shots: how far apart their V50 are, and whether the shots refuse that they are one.

use statrs::distribution::{ContinuousCDF, Normal};

use crate::confidence::{crossing, refusal_at};
use crate::v50::analysis::Analysis;
use crate::v50::curve::{Curve, Estimate, Interval};
use crate::v50::link::Link;
use crate::v50::search::maximum;

/// The first step to an end of the interval, and the farthest, over the deviations of the speeds.
const FIRST_STEP: f64 = 0.25;
const FARTHEST: f64 = 2048.0;
/// Places between the two V50 at which the common one is sought first, and about each, over its curve's spread: a level
/// curve is likeliest far from all shots.
const PLACES: usize = 24;
const ABOUT: [f64; 5] = [0.25, 0.5, 1.0, 2.0, 4.0];
/// A deviance of so little of the likelihood is what its digits have lost.
const ROUNDING: f64 = 1e-10;
/// How often a difference of the least size shows.
pub const POWER: f64 = 0.8;

/// The second table's V50 less the first one's, or over it where the curves are over the logarithm of the speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    pub link: Link,
    pub estimate: Estimate,
    /// Twice the logarithm of the likelihood that one V50 for both costs, and the chance of that much if it is one.
    pub one_v50: [f64; 2],
    /// The same of one curve for both.
    pub one_curve: [f64; 2],
    /// What so many shots would show in [`POWER`] of the experiments; none where the interval has no end.
    pub least: Option<f64>,
}

impl Difference {
    /// By curves of one link, without a penalty; none where a table has no curve.
    pub fn of(first: &Analysis, second: &Analysis, link: Link) -> Option<Difference> {
        let of = |told: &Analysis| told.curves.iter().find(|curve| curve.link == link && !curve.firth).cloned();
        let (one, other) = (of(first)?, of(second)?);
        let asked = &first.asked;
        let both = [&first.fates[..], &second.fates[..]].concat();
        let pooled = Curve::fit_as(asked, &both, link, false)?;
        let best = one.largest() + other.largest();
        let deviance = |difference: f64| 2.0 * (best - together(&one, &other, difference));
        let start = other.likeliest_place() - one.likeliest_place();
        let scale = one.spread().max(other.spread());
        let level = refusal_at(asked.level);
        let end = |first: f64| crossing(deviance, start, first * scale, level, FARTHEST * scale);
        let (low, high) = (end(-FIRST_STEP), end(FIRST_STEP));
        let [at_level, at_power] = [0.5 + 0.5 * asked.level, POWER].map(|part| Normal::standard().inverse_cdf(part));
        let out = |place: f64| if asked.logarithm { place.exp() } else { place };
        let has_value = one.v50().value.is_some() && other.v50().value.is_some();
        // Where there is no value, any place in the gap would be as good a start.
        let arm_of = |(low, high): (f64, f64)| {
            if has_value { (start - low).max(high - start) } else { 0.5 * (high - low) }
        };
        let arm = low.zip(high).map(arm_of);
        let known = |deviance: f64| if deviance > ROUNDING * (1.0 + best.abs()) { deviance } else { 0.0 };
        let apart = known(deviance(0.0));
        let curves = known(2.0 * (best - pooled.largest()));
        Some(Difference {
            link,
            estimate: Estimate {
                value: has_value.then(|| out(start)),
                interval: Interval { low: low.map(out), high: high.map(out) },
            },
            one_v50: [apart, 2.0 * Normal::standard().cdf(-apart.sqrt())],
            one_curve: [curves, (-0.5 * curves).exp()],
            least: arm.map(|arm| out(arm * (1.0 + at_power / at_level))),
        })
    }
}

/// The largest likelihood of two curves whose V50 are so far apart. Each falls away from its own best place, so that the
/// best common one lies between these two; it may have two maxima there.
fn together(one: &Curve, other: &Curve, difference: f64) -> f64 {
    let of = |place: f64| one.with_v50(place) + other.with_v50(place + difference);
    let [a, b] = [one.likeliest_place(), other.likeliest_place() - difference];
    let [low, high] = [a.min(b), a.max(b)];
    let between = (0..=PLACES).map(|i| low + (high - low) * i as f64 / PLACES as f64);
    let about = [(a, one.spread()), (b, other.spread())].into_iter().flat_map(|(place, spread)| {
        ABOUT.into_iter().flat_map(move |part| [place - part * spread, place + part * spread])
    });
    let mut places: Vec<f64> = between.chain(about.filter(|place| (low..=high).contains(place))).collect();
    places.sort_by(f64::total_cmp);
    let values: Vec<f64> = places.iter().map(|&place| of(place)).collect();
    let best = (0..values.len()).fold(0, |best, i| if values[i] > values[best] { i } else { best });
    let bounds = [places[best.saturating_sub(1)], places[(best + 1).min(places.len() - 1)]];
    maximum(of, bounds).1.max(values[best])
}

#[cfg(test)]
mod tests {
    use rayon::prelude::*;

    use super::*;
    use crate::v50::curve::{Asked, Fate};
    use crate::v50::designs::Design;
    use crate::v50::simulation::{Experiment, Truth};

    const DEVIATION: f64 = 10.0;
    const DESIGNS: [Design; 3] =
        [Design::Langlie, Design::UpAndDown { step: DEVIATION }, Design::DOptimal { deviation: DEVIATION }];

    /// Of so many pairs of simulated tests, whose V50 are apart by this: the share of those whose shots refuse one V50
    /// at 5 %, and the middle one of the least differences that they say they would show.
    fn refused_and_least(design: Design, shots: usize, apart: f64, pairs: u64) -> [f64; 2] {
        let experiment = Experiment { design, shots, range: [60.0, 140.0], scatter: 1.0 };
        let one = |number: u64| {
            let [first, second] = [(100.0, 1), (100.0 + apart, 2)].map(|(v50, seed)| {
                let truth = Truth { link: Link::Probit, v50, deviation: DEVIATION };
                Analysis::of(experiment.fates(&truth, seed, number), &Asked::default())
            });
            Difference::of(&first, &second, Link::Probit)
        };
        let found: Vec<Option<Difference>> = (0..pairs).into_par_iter().map(one).collect();
        let refused = found.iter().flatten().filter(|found| found.one_v50[1] < 0.05).count();
        let mut least: Vec<f64> =
            found.iter().map(|found| found.as_ref().and_then(|found| found.least).unwrap_or(f64::INFINITY)).collect();
        least.sort_by(f64::total_cmp);
        [refused as f64 / pairs as f64, least[least.len() / 2]]
    }

    /// Pairs that differ by what they would show, in the middle, show it in about as many cases as is said.
    #[test]
    fn the_least_difference_shows_about_as_often_as_is_said() {
        let [alarms, least] = refused_and_least(Design::Langlie, 40, 0.0, 40);
        let [shown, _] = refused_and_least(Design::Langlie, 40, least, 40);
        assert!(alarms < 0.2 && (shown - POWER).abs() < 0.2, "{alarms} {least} {shown}");
    }

    /// 400 pairs of each kind, for the guide.
    #[test]
    #[ignore = "takes minutes"]
    fn the_power_of_a_least_difference_by_simulation() {
        for shots in [10, 20, 40] {
            for design in DESIGNS {
                let [alarms, least] = refused_and_least(design, shots, 0.0, 400);
                if least.is_infinite() {
                    println!("{shots} {}: no difference in half of the pairs; refused {alarms:.3}", design.name());
                    continue;
                }
                let [shown, _] = refused_and_least(design, shots, least, 400);
                println!(
                    "{shots} {}: would show {:.2} deviations; refused {alarms:.3} without, {shown:.3} with it",
                    design.name(),
                    least / DEVIATION
                );
                assert!(shots < 40 || (shown - POWER).abs() < 0.1, "{shots} {}: {shown}", design.name());
            }
        }
    }

    fn told(groups: &[(f64, usize, usize)], logarithm: bool) -> Analysis {
        let group = |&(speed, through, shots): &(f64, usize, usize)| {
            (0..shots).map(move |shot| Fate { speed, through: shot < through })
        };
        Analysis::of(groups.iter().flat_map(group).collect(), &Asked { logarithm, ..Asked::default() })
    }

    const ONE: [(f64, usize, usize); 4] = [(100.0, 1, 8), (110.0, 3, 8), (120.0, 5, 8), (130.0, 7, 8)];

    /// Of a table and itself moved by 12 the difference is 12, with an interval about it, and the test of one curve is
    /// that of one V50 but for what the scales tell.
    #[test]
    fn a_table_that_is_moved_differs_by_that() {
        let moved = ONE.map(|(speed, through, shots)| (speed + 12.0, through, shots));
        for link in Link::BOTH {
            let found = Difference::of(&told(&ONE, false), &told(&moved, false), link).expect("curves");
            assert!((found.estimate.value.expect("a value") - 12.0).abs() < 1e-5, "{found:?}");
            let Interval { low: Some(low), high: Some(high) } = found.estimate.interval else { panic!("{found:?}") };
            assert!((low + high - 24.0).abs() < 1e-3 && low < 2.0 && high > 22.0, "{found:?}");
            let least = found.least.expect("bounded");
            assert!(least > high - 12.0 && least < 2.0 * (high - 12.0), "{found:?}");
            assert!(found.one_curve[0] >= found.one_v50[0] - 1e-9, "{found:?}");
            // At the end of its interval a difference is refused just so.
            let at_end = ONE.map(|(speed, through, shots)| (speed + 12.0 - low, through, shots));
            let refused = Difference::of(&told(&ONE, false), &told(&at_end, false), link).expect("curves");
            assert!((refused.one_v50[0] - 3.841_458_820_694_124).abs() < 1e-5, "{refused:?}");
            assert!((refused.one_v50[1] - 0.05).abs() < 1e-6, "{refused:?}");
        }
    }

    /// Over the logarithm V50 are compared by their ratio.
    #[test]
    fn logarithms_differ_by_a_ratio() {
        let moved = ONE.map(|(speed, through, shots)| (1.1 * speed, through, shots));
        let found = Difference::of(&told(&ONE, true), &told(&moved, true), Link::Probit).expect("curves");
        assert!((found.estimate.value.expect("a value") - 1.1).abs() < 1e-7, "{found:?}");
        assert!(found.least.is_some_and(|least| least > 1.0), "{found:?}");
    }

    /// The curve of a table without a slope is likeliest far away; one V50 for both is sought beside the other's.
    #[test]
    fn a_level_table_refuses_nothing() {
        let level = told(&[(100.0, 4, 8), (110.0, 4, 8), (120.0, 4, 8)], false);
        let found = Difference::of(&level, &told(&ONE, false), Link::Probit).expect("curves");
        assert!(found.one_v50[0] < 1e-3 && found.one_v50[1] > 0.95, "{found:?}");
    }

    /// Separated tables have an interval of their difference and no value; without a curve there is none.
    #[test]
    fn separated_tables_have_an_interval() {
        let steps = |at: f64| told(&[(at - 20.0, 0, 4), (at - 2.0, 0, 4), (at + 2.0, 4, 4), (at + 20.0, 4, 4)], false);
        let found = Difference::of(&steps(100.0), &steps(110.0), Link::Probit).expect("curves");
        let Interval { low: Some(low), high: Some(high) } = found.estimate.interval else { panic!("{found:?}") };
        assert!(found.estimate.value.is_none() && low < 6.001 && high > 13.999, "{found:?}");
        assert!(Difference::of(&steps(100.0), &told(&[(90.0, 0, 5), (99.0, 0, 1)], false), Link::Logit).is_none());
    }
}
