//! Wu and Tian's design (2014), 3pod: search until fates mix, estimate, approach a percentile.
//!
//! It is followed as printed, where the R package gonogo has changed it with its authors' consent: a search beyond the
//! range goes on by 1.5 guesses a shot (gonogo's steps grow), and a gap that is wide is entered at the likeliest V50 by
//! the guess (gonogo takes its middle). Not as printed, but as gonogo has it, are the third phase's lengths: the bounds
//! of τ² are printed for a deviation near 1, and are taken in squares of the deviation here, without which another unit
//! of speed would give other shots.

use statrs::distribution::{Continuous, Normal};

use super::d_optimal::{Bounds, Estimate, estimate, most_told_by};
use super::{Approach, Plan, Step, close};
use crate::v50::curve::{Curve, Fate};
use crate::v50::link::Link;

/// Steps of the search over the guess of the deviation: out of the range, out of it on both sides, and out of a gap.
const BEYOND: f64 = 1.5;
const BOTH_SIDES: f64 = 3.0;
const ASIDE: f64 = 0.3;
/// A gap of so many guesses or more is entered.
const WIDE: f64 = 1.5;
/// What is left of the guess when shots on both sides of the gap have not made fates mix.
const REDUCTION: f64 = 2.0 / 3.0;
/// How far from the middle of the mixed zone its two further shots stand, over the guess.
const ENHANCING: f64 = 0.5;
/// The bounds of τ² in the third phase, and what its steepness is multiplied by.
const SPREADS: [f64; 2] = [2.3429, 6.5079];
const HALVED: f64 = 0.5;
/// The guess of the deviation is up to this part of the range.
pub const OF_RANGE: f64 = 1.0 / 6.0;

/// What the next shot is for; the phases are gone through again, fate by fate. The shots of the third phase make one
/// step in every `size`.
pub fn plan(fates: &[Fate], range: [f64; 2], guess: f64, approach: Option<Approach>, size: usize) -> Plan {
    let (used, guess) = match mixed(fates, range, guess) {
        Ok(found) => found,
        Err(plan) => return plan,
    };
    let bounds = Bounds::of(&fates[..used]);
    let (middle, width) = (0.5 * (bounds.through + bounds.stop), bounds.stop - bounds.through);
    let step = Step::Enhance { zone: [bounds.through, bounds.stop] };
    let places =
        if width >= guess { vec![middle] } else { vec![middle + ENHANCING * guess, middle - ENHANCING * guess] };
    if let Some(&speed) = places.get(fates.len() - used) {
        return Plan::at(speed, step);
    }
    let first = approach.map_or(usize::MAX, |approach| approach.after).max(used + places.len());
    match approach.filter(|_| fates.len() >= first) {
        Some(approach) => third(fates, approach, first, size, None),
        None => most_told_by(estimate(fates)),
    }
}

/// The number of shots after which fates mixed and the guess that was left, or the next shot on the way.
fn mixed(fates: &[Fate], [low, high]: [f64; 2], mut guess: f64) -> Result<(usize, f64), Plan> {
    let next = |speed: f64, step: Step| Err(Plan::at(speed, step));
    let quarters = [0.75 * low + 0.25 * high, 0.25 * low + 0.75 * high];
    if let Some(&speed) = quarters.get(fates.len()) {
        return next(speed, Step::Quarter);
    }
    let mut used = 2;
    if Bounds::of(&fates[..2]).mix() {
        let sides = [low - BOTH_SIDES * guess, high + BOTH_SIDES * guess];
        return sides.get(fates.len() - 2).map_or(Ok((4, guess)), |&speed| next(speed, Step::BothSides));
    }
    while Bounds::of(&fates[..used]).counts.contains(&0) {
        let through = fates[0].through;
        let steps = BEYOND * (used - 1) as f64 * guess;
        if used == fates.len() {
            return next(if through { low - steps } else { high + steps }, Step::Outward { through });
        }
        used += 1;
    }
    // Of a pair of shots beside the gap, whether the first one was above it.
    let mut pair: Option<bool> = None;
    loop {
        let Bounds { stop, through, counts } = Bounds::of(&fates[..used]);
        if through < stop {
            return Ok((used, guess));
        }
        let gap = [stop, through];
        let is_wide = through - stop >= WIDE * guess || close(through, stop + WIDE * guess);
        let is_above = pair.map_or(counts[0] > counts[1], |first| !first);
        let aside = if is_above { through + ASIDE * guess } else { stop - ASIDE * guess };
        let enters = pair.is_none() && is_wide;
        if used == fates.len() {
            return if enters {
                let v50 = Curve::likeliest_of_deviation(fates, guess);
                next(v50, Step::Between { gap, above: WIDE * guess })
            } else {
                next(aside, Step::Aside { gap, guess, is_above })
            };
        }
        used += 1;
        if pair.is_some() && !Bounds::of(&fates[..used]).mix() {
            guess *= REDUCTION;
        }
        pair = (pair.is_none() && !enters).then_some(is_above);
    }
}

/// The third phase, by Robbins, Monro and Joseph: the mean speed of the last step, moved by what its fates are more or
/// less than expected. Beyond these first shots none has a say in the deviation.
///
/// Of several shots in one step their mean speed and their share of perforations count. `unit` is the length whose
/// square bounds τ²: the deviation, if not given.
fn third(fates: &[Fate], approach: Approach, first: usize, size: usize, unit: Option<f64>) -> Plan {
    let (before, steps) = fates.split_at(first);
    let of = estimate(before);
    let z = Link::Probit.quantile(approach.chance);
    let unit = unit.unwrap_or(of.deviation);
    let mut spread = variance(before, of, z).clamp(SPREADS[0] * unit * unit, SPREADS[1] * unit * unit);
    let slope = HALVED / of.deviation;
    let mut speed = of.v50 + z * of.deviation;
    for step in steps.chunks(size) {
        let count = step.len() as f64;
        let root = (1.0 + slope * slope * spread).sqrt();
        let expected = Link::Probit.chance(z / root);
        let noise = expected * (1.0 - expected);
        let gain = slope * spread / root * Normal::standard().pdf(z / root) / noise;
        let share = step.iter().filter(|fate| fate.through).count() as f64 / count;
        speed = step.iter().map(|fate| fate.speed).sum::<f64>() / count - gain * (share - expected);
        spread -= noise * gain * gain;
    }
    Plan::About { speed, deviation: of.deviation, step: Step::Approach { chance: approach.chance, first } }
}

/// What the information on V50 and the deviation leaves of the percentile at z, without their covariance.
fn variance(fates: &[Fate], of: Estimate, z: f64) -> f64 {
    let mut sums = [0.0; 3];
    for fate in fates {
        let place = (fate.speed - of.v50) / of.deviation;
        let weight = Link::Probit.log_information(place).exp();
        sums = [sums[0] + weight, sums[1] + weight * place, sums[2] + weight * place * place];
    }
    let [a, b, c] = sums;
    let determinant = a * c - b * b;
    // Shots that say nothing leave everything open.
    if determinant > 0.0 { of.deviation.powi(2) * (c + z * z * a) / determinant } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fates(shots: &[(f64, u8)]) -> Vec<Fate> {
        shots.iter().map(|&(speed, through)| Fate { speed, through: through == 1 }).collect()
    }

    /// The 30 shots of Wu and Tian's table 1.
    const PUBLISHED: [(f64, u8); 30] = [
        (5.5, 0),
        (16.5, 1),
        (11.0, 0),
        (13.8, 1),
        (10.1, 0),
        (14.7, 1),
        (10.4, 1),
        (11.7, 1),
        (9.7, 1),
        (7.3, 0),
        (7.8, 0),
        (8.1, 0),
        (12.2, 1),
        (8.5, 0),
        (11.8, 1),
        (11.7106, 1),
        (11.4896, 1),
        (11.2980, 0),
        (12.3899, 1),
        (12.2393, 1),
        (12.1033, 1),
        (11.9796, 1),
        (11.8660, 1),
        (11.7612, 1),
        (11.6638, 1),
        (11.5730, 1),
        (11.4878, 1),
        (11.4077, 1),
        (11.3321, 1),
        (11.2605, 1),
    ];
    const RANGE: [f64; 2] = [0.0, 22.0];
    const GUESS: f64 = 3.0;
    const APPROACH: Approach = Approach { chance: 0.9, after: 15 };

    fn speed(fates: &[Fate], approach: Option<Approach>) -> f64 {
        plan(fates, RANGE, GUESS, approach, 1).speed(fates)
    }

    /// Phases I and II of the published example follow shot by shot, to its digits: the levels of phase II are rounded
    /// to 0.1 there.
    #[test]
    fn wu_and_tian_s_example_is_met() {
        let shots = fates(&PUBLISHED);
        for (count, (published, _)) in PUBLISHED.iter().enumerate().take(15) {
            let found = speed(&shots[..count], Some(APPROACH));
            let tolerance = if count < 9 && count != 3 { 1e-9 } else { 0.051 };
            assert!((found - published).abs() < tolerance, "{}: {found}, published {published}", count + 1);
        }
        // The likeliest V50 by a deviation of 3 is no middle of the gap, which is 13.75.
        assert!((speed(&shots[..3], None) - 13.8).abs() < 0.03 && speed(&shots[..3], None) > 13.76);
        let found = estimate(&shots[..9]);
        assert!((found.v50 - 9.9726).abs() < 1e-4 && (found.deviation - 2.0705).abs() < 1e-4, "{found:?}");
        // As the package gonogo has them of the same rounded levels, from a grid of 0.001 deviations.
        for (count, published) in
            [(9, 7.26438), (10, 7.75467), (11, 8.08350), (12, 12.16394), (13, 8.51676), (14, 11.82596)]
        {
            let found = speed(&shots[..count], None);
            assert!((found - published).abs() < 2e-3, "{count}: {found}, {published}");
        }
    }

    /// Phase III of the published example, whose bounds are in units of a deviation of 1; and, with bounds in squares
    /// of the estimated deviation, that which gonogo prints of the same fates.
    #[test]
    fn the_third_phase_is_met() {
        let shots = fates(&PUBLISHED);
        for (count, (published, _)) in PUBLISHED.iter().enumerate().skip(15) {
            let found = third(&shots[..count], APPROACH, 15, 1, Some(1.0)).speed(&shots[..count]);
            assert!((found - published).abs() < 2e-3, "{}: {found}, published {published}", count + 1);
        }
        let mut own = fates(&PUBLISHED[..15]);
        for (published, through) in
            [(11.71214, 1), (11.40675, 1), (11.15419, 0), (12.46178, 1), (12.27455, 1), (12.10918, 1)]
        {
            let found = speed(&own, Some(APPROACH));
            assert!((found - published).abs() < 2e-3, "{}: {found}, published {published}", own.len());
            own.push(Fate { speed: published, through: through == 1 });
        }
    }

    /// Of any unit of speed the shots are the same.
    #[test]
    fn nothing_depends_on_the_unit() {
        let shots = fates(&PUBLISHED);
        for count in 0..=30 {
            let scaled: Vec<Fate> =
                shots[..count].iter().map(|fate| Fate { speed: 3.280_839_9 * fate.speed, ..*fate }).collect();
            let range = RANGE.map(|end| 3.280_839_9 * end);
            let found = plan(&scaled, range, 3.280_839_9 * GUESS, Some(APPROACH), 1).speed(&scaled);
            let own = speed(&shots[..count], Some(APPROACH));
            assert!((found / 3.280_839_9 - own).abs() < 1e-6, "{count}: {found} {own}");
        }
    }

    /// By hand: from 0 to 80 by a guess of 10, the quarters are 20 and 60.
    #[test]
    fn the_search_is_that_of_the_flow_chart() {
        let speed = |shots: &[(f64, u8)]| {
            let fates = fates(shots);
            plan(&fates, [0.0, 80.0], 10.0, None, 1).speed(&fates)
        };
        assert_eq!([speed(&[]), speed(&[(20.0, 0)]), speed(&[(20.0, 1)])], [20.0, 60.0, 60.0]);
        // All alike: 1.5, 3, 4.5 guesses beyond the range.
        let mut stops = vec![(20.0, 0), (60.0, 0)];
        for wanted in [95.0, 110.0, 125.0] {
            assert_eq!(speed(&stops), wanted);
            stops.push((wanted, 0));
        }
        assert_eq!(speed(&[(20.0, 1), (60.0, 1)]), -15.0);
        // The wrong way round: both ends, and then the mixed zone is wide enough for one shot in its middle.
        let mut contrary = vec![(20.0, 1), (60.0, 0)];
        for (wanted, through) in [(-30.0, 0), (110.0, 1), (40.0, 1)] {
            assert_eq!(speed(&contrary), wanted);
            contrary.push((wanted, through));
        }
        // A gap below 1.5 guesses: 0.3 guesses below it, above it, and with two thirds of the guess again.
        let mut gap = vec![(20.0, 0), (60.0, 1), (40.0, 0), (48.0, 1)];
        for (wanted, through) in [(37.0, 0), (51.0, 1), (38.0, 1)] {
            assert!((speed(&gap) - wanted).abs() < 1e-12, "{}", speed(&gap));
            gap.push((wanted, through));
        }
        // Mixed from 38 to 40, by a guess of 6.67: two more shots, half of it above and below the middle.
        for (wanted, through) in [(39.0 + 10.0 / 3.0, 1), (39.0 - 10.0 / 3.0, 0)] {
            assert!((speed(&gap) - wanted).abs() < 1e-12, "{}", speed(&gap));
            gap.push((wanted, through));
        }
        let by_estimate = plan(&fates(&gap), [0.0, 80.0], 10.0, None, 1);
        assert!(matches!(by_estimate, Plan::MostTold { .. }), "{by_estimate:?}");
        // More stops than perforations: first above the gap.
        assert_eq!(speed(&[(20.0, 0), (60.0, 1), (40.0, 0), (47.0, 0)]), 63.0);
    }

    /// A measured speed that is not the asked one moves what follows; no state is lost by it.
    #[test]
    fn measured_speeds_count() {
        let shots = fates(&[(20.0, 0), (60.0, 1), (41.0, 0), (50.5, 1), (41.5, 0)]);
        let found = plan(&shots, [0.0, 80.0], 10.0, None, 1).speed(&shots);
        assert!((found - 53.5).abs() < 1e-12, "{found}");
    }

    /// Several shots in one step: their mean and their share.
    #[test]
    fn a_batch_makes_one_step_of_the_third_phase() {
        let mut shots = fates(&PUBLISHED[..15]);
        let start = third(&shots, APPROACH, 15, 2, None).speed(&shots);
        let single = |through: bool| {
            let shots = [&shots[..], &[Fate { speed: start, through }]].concat();
            third(&shots, APPROACH, 15, 1, None).speed(&shots)
        };
        let [down, up] = [true, false].map(single);
        shots.extend([Fate { speed: start - 0.2, through: false }, Fate { speed: start + 0.2, through: true }]);
        let both = third(&shots, APPROACH, 15, 2, None).speed(&shots);
        assert!((both - 0.5 * (down + up)).abs() < 1e-12, "{down} {up} {both}");
    }
}
