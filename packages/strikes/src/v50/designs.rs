//! At which speed the next shot is fired: the designs of an experiment.

use statrs::distribution::{ContinuousCDF, Normal};

use super::curve::{Curve, Fate, Mix, mix};
use super::link::Link;
use super::search::{GOLDEN, maximum};

/// What the guess of the deviation loses with each shot by which the fates do not mix yet.
const SHRINKING: f64 = 0.8;
/// The next shot of the D-optimal design is sought so many deviations about V50, at so many places, and between them.
const REACH: f64 = 4.0;
const PLACES: usize = 80;
/// No shot is to be slower than this part of the range's lower end, and none is slower than this part of what it was to
/// be.
const SLOWEST: f64 = 0.1;

/// How speeds are chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Design {
    /// Evenly over the range, whatever the fates.
    Even,
    /// Langlie's (1962): halfway to the shot before which the fates are balanced, or to an end of the range.
    Langlie,
    /// Dixon and Mood's (1948), of Bruceton: a step down after a perforation, up after a stop.
    UpAndDown { step: f64 },
    /// Neyer's (1994): where a shot tells most of V50 and the deviation, with a first guess of this.
    DOptimal { deviation: f64 },
}

/// A shot that has been fired: its speed was to be, and was.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fired {
    pub nominal: f64,
    pub fate: Fate,
}

/// The speed of a shot that scatters about what it was to be with this standard deviation: no speed is below 0, however
/// wide the scatter.
pub fn scattered(nominal: f64, scatter: f64, chance: f64) -> f64 {
    (nominal + scatter * Normal::standard().inverse_cdf(chance)).max(SLOWEST * nominal)
}

impl Design {
    pub fn name(&self) -> &'static str {
        match self {
            Design::Even => "even",
            Design::Langlie => "langlie",
            Design::UpAndDown { .. } => "up-and-down",
            Design::DOptimal { .. } => "d-optimal",
        }
    }

    /// Whether a shot needs the fates of those before it.
    pub fn is_sequential(&self) -> bool {
        *self != Design::Even
    }

    /// The speed that the shot of this number, from 1, is to have; before it were these, whose fates are known.
    pub fn speed(&self, number: usize, before: &[Fired], [low, high]: [f64; 2]) -> f64 {
        let next = match *self {
            // By the golden section of the range from each to the next, any number of them lies evenly.
            Design::Even => low + (high - low) * (0.5 + GOLDEN * (number - 1) as f64).fract(),
            Design::Langlie => langlie(before, [low, high]),
            Design::UpAndDown { step } => match before.last() {
                None => 0.5 * (low + high),
                Some(last) => last.nominal + if last.fate.through { -step } else { step },
            },
            Design::DOptimal { deviation } => d_optimal(before, [low, high], deviation),
        };
        next.max(SLOWEST * low)
    }
}

fn langlie(before: &[Fired], [low, high]: [f64; 2]) -> f64 {
    let Some(last) = before.last() else { return 0.5 * (low + high) };
    let mut balance = 0;
    for shot in before.iter().rev() {
        balance += if shot.fate.through { 1 } else { -1 };
        if balance == 0 {
            return 0.5 * (last.fate.speed + shot.fate.speed);
        }
    }
    0.5 * (last.fate.speed + if last.fate.through { low } else { high })
}

/// In three parts: until there are both fates, until they mix, and from then on.
fn d_optimal(before: &[Fired], [low, high]: [f64; 2], guess: f64) -> f64 {
    let fates: Vec<Fate> = before.iter().map(|shot| shot.fate).collect();
    let speeds = fates.iter().map(|fate| fate.speed);
    let slowest = speeds.clone().fold(f64::INFINITY, f64::min);
    let fastest = speeds.fold(f64::NEG_INFINITY, f64::max);
    if fates.is_empty() {
        return 0.5 * (low + high);
    }
    match mix(&fates) {
        Mix::AllStopped => (0.5 * (high + fastest)).max(fastest + 2.0 * guess).max(2.0 * fastest - slowest),
        Mix::AllThrough => (0.5 * (low + slowest)).min(slowest - 2.0 * guess).min(2.0 * slowest - fastest),
        Mix::Separated([stop, through]) => {
            // The guess that is left: it has shrunk with every shot since the gap was no wider than it.
            let mut left = guess;
            for count in 1..=fates.len() {
                if let Mix::Separated([stop, through]) = mix(&fates[..count])
                    && through - stop <= left
                    && count < fates.len()
                {
                    left *= SHRINKING;
                }
            }
            let middle = 0.5 * (stop + through);
            if through - stop > left { middle } else { most_told(&fates, middle, left) }
        }
        Mix::Mixed | Mix::Level => {
            // A curve that is nearly level has its V50 anywhere, and any deviation.
            let [v50, deviation] = Curve::likeliest(&fates);
            most_told(&fates, v50.clamp(slowest, fastest), deviation.min(fastest - slowest))
        }
    }
}

/// The speed at which one more shot makes the information on V50 and the deviation largest, if they are these.
fn most_told(fates: &[Fate], v50: f64, deviation: f64) -> f64 {
    let place = |speed: f64| (speed - v50) / deviation;
    let weight = |z: f64| Link::Probit.log_information(z).exp();
    let mut sums = [0.0; 3];
    for fate in fates {
        let z = place(fate.speed);
        let weight = weight(z);
        sums = [sums[0] + weight, sums[1] + weight * z, sums[2] + weight * z * z];
    }
    let determinant = |z: f64| {
        let weight = weight(z);
        (sums[0] + weight) * (sums[2] + weight * z * z) - (sums[1] + weight * z).powi(2)
    };
    let step = 2.0 * REACH / PLACES as f64;
    let places = (0..=PLACES).map(|i| -REACH + step * i as f64);
    let best = places.fold((0.0, f64::NEG_INFINITY), |best, z| {
        let found = determinant(z);
        if found > best.1 { (z, found) } else { best }
    });
    let (z, _) = maximum(determinant, [best.0 - step, best.0 + step]);
    v50 + deviation * z
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The speeds of an experiment in which this goes through.
    fn speeds(design: Design, shots: usize, through: impl Fn(usize, f64) -> bool) -> Vec<f64> {
        let mut before = Vec::new();
        for number in 1..=shots {
            let speed = design.speed(number, &before, [100.0, 200.0]);
            before.push(Fired { nominal: speed, fate: Fate { speed, through: through(number, speed) } });
        }
        before.iter().map(|shot| shot.nominal).collect()
    }

    #[test]
    fn an_even_design_fills_the_range_whatever_the_number() {
        for shots in [5, 13, 40] {
            let mut found = speeds(Design::Even, shots, |_, _| true);
            assert_eq!(found, speeds(Design::Even, shots, |_, _| false));
            found.sort_by(f64::total_cmp);
            let gaps = found.windows(2).map(|pair| pair[1] - pair[0]);
            let widest = gaps.fold(found[0] - 100.0, f64::max).max(200.0 - found[shots - 1]);
            assert!(widest < 2.0 * 100.0 / shots as f64, "{shots}: {widest}");
        }
        let long = speeds(Design::Even, 40, |_, _| true);
        assert_eq!(speeds(Design::Even, 5, |_, _| true), long[..5]);
    }

    /// By hand: halfway to the shot up to which the fates balance, else to an end of the range.
    #[test]
    fn langlie_s_design_balances_the_fates() {
        let through = [false, true, false, false, true, true, true];
        let found = speeds(Design::Langlie, 7, |number, _| through[number - 1]);
        let x6 = 0.5 * (184.375 + 168.75);
        assert_eq!(found, [150.0, 175.0, 162.5, 168.75, 184.375, x6, 0.5 * (x6 + 162.5)]);
        // It stays in the range.
        assert!(speeds(Design::Langlie, 30, |_, _| true).iter().all(|&speed| speed > 100.0));
        assert!(speeds(Design::Langlie, 30, |_, _| false).iter().all(|&speed| speed < 200.0));
    }

    #[test]
    fn up_and_down_goes_by_steps() {
        let found = speeds(Design::UpAndDown { step: 10.0 }, 6, |_, speed| speed > 165.0);
        assert_eq!(found, [150.0, 160.0, 170.0, 160.0, 170.0, 160.0]);
        assert_eq!(speeds(Design::UpAndDown { step: 40.0 }, 5, |_, _| true), [150.0, 110.0, 70.0, 30.0, 10.0]);
    }

    #[test]
    fn a_shot_is_no_slower_than_a_tenth_of_what_it_was_to_be() {
        assert!((scattered(100.0, 2.0, 0.975) - 103.919_928).abs() < 1e-5);
        assert_eq!(scattered(100.0, 200.0, 0.01), 10.0);
    }

    /// Neyer's: it leaves a range in which all fates are alike, halves the gap, and then stands 1.138 deviations from
    /// V50.
    #[test]
    fn a_d_optimal_design_stands_where_a_shot_tells_most() {
        let design = Design::DOptimal { deviation: 5.0 };
        let found = speeds(design, 6, |_, _| false);
        assert_eq!(found, [150.0, 175.0, 200.0, 250.0, 350.0, 550.0]);
        let found = speeds(design, 5, |_, speed| speed > 172.0);
        assert_eq!(found[..4], [150.0, 175.0, 162.5, 168.75]);
        let two_sided: Vec<Fate> = (0..40)
            .map(|i| Fate { speed: 150.0 + if i % 2 == 0 { -1.138 } else { 1.138 } * 5.0, through: i % 4 == 0 })
            .collect();
        let next = most_told(&two_sided, 150.0, 5.0);
        assert!(((next - 150.0).abs() / 5.0 - 1.138).abs() < 0.01, "{next}");
        // All shots on one side: the other one tells more.
        assert!(most_told(&[Fate { speed: 156.0, through: true }; 10], 150.0, 5.0) < 150.0);
    }
}
