//! The designs of an experiment beside each other, by simulation: how far V50 is off, and what its intervals are worth.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::curve::{Curve, Fate};
use super::curves_report::{WIDTH, paragraph};
use super::designs::{Batch, Design, Fired, scattered};
use super::link::Link;
use crate::chance::uniform;
use toron_shared::text_table::{Column, or_dash, table};

/// The true V50 and deviation, the standard deviation of a speed from what it was to be, and the middle of the range,
/// which is off by a deviation. No speed comes near 0.
const V50: f64 = 1000.0;
const DEVIATION: f64 = 25.0;
const SCATTER: f64 = 5.0;
const MIDDLE: f64 = V50 + DEVIATION;
/// Half of the range, over the guess of the deviation: as Wu and Tian have it.
const HALF_RANGE: f64 = 4.0;
const GUESSES: [f64; 3] = [0.5, 1.0, 2.0];
const SIZES: [usize; 4] = [1, 2, 4, 8];
const COUNTS: [usize; 3] = [10, 20, 40];
const SEED: u64 = 1;

/// The distribution of limit speeds; all have the same median and the same standard deviation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Truth {
    Normal,
    Logistic,
    /// Gumbel's, of largest values: its slow tail is short, its fast one long.
    Skewed,
}

impl Truth {
    const ALL: [Truth; 3] = [Truth::Normal, Truth::Logistic, Truth::Skewed];

    fn name(self) -> &'static str {
        match self {
            Truth::Normal => "normal",
            Truth::Logistic => "logistic",
            Truth::Skewed => "skewed",
        }
    }

    /// The chance of a perforation, so many deviations from V50.
    fn chance(self, z: f64) -> f64 {
        match self {
            Truth::Normal => Link::Probit.chance(z),
            Truth::Logistic => Link::Logit.chance(z * PI / 3.0_f64.sqrt()),
            Truth::Skewed => (-std::f64::consts::LN_2 * (-z * PI / 6.0_f64.sqrt()).exp()).exp(),
        }
    }
}

/// One kind of experiments.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Kind {
    design: Design,
    truth: Truth,
    /// The guess over the true deviation.
    guess: f64,
    /// Shots at a time.
    size: usize,
}

/// What came of experiments of one kind, after so many shots. Shares are those of all experiments; they add up to 1.
#[derive(Clone, Debug, PartialEq)]
struct Came {
    kind: Kind,
    count: usize,
    /// The middle one of the V50 less the true one, and half of what is between the sixth and the last but fifth of 32,
    /// about as a standard deviation, over the true deviation, where there are values.
    off: Option<f64>,
    spread: Option<f64>,
    /// How often V50 has a value.
    valued: f64,
    /// How often its interval has both ends and holds the true one, has both and misses it, lacks one or both; and how
    /// often there is none, since all fates are alike.
    holds: f64,
    misses: f64,
    open: f64,
    none: f64,
}

fn designs(deviation: f64) -> [Design; 4] {
    [
        Design::Langlie,
        Design::UpAndDown { step: deviation },
        Design::DOptimal { deviation },
        Design::ThreePod { deviation, approach: None },
    ]
}

impl Kind {
    /// The fates of the experiment of this number.
    fn fates(&self, shots: usize, number: u64) -> Vec<Fate> {
        let guess = self.guess * DEVIATION;
        let range = [MIDDLE - HALF_RANGE * guess, MIDDLE + HALF_RANGE * guess];
        let batch = Batch { range, guess, size: self.size, pending: Vec::new(), resolution: None };
        let mut before: Vec<Fired> = Vec::new();
        while before.len() < shots {
            for next in batch.speeds(self.design, &before.clone()) {
                let chance = |kind: u64| uniform(SEED, [number, before.len() as u64, kind]);
                let speed = scattered(next.speed, SCATTER, chance(0));
                let through = chance(1) < self.truth.chance((speed - V50) / DEVIATION);
                before.push(Fired { nominal: next.speed, fate: Fate { speed, through } });
            }
        }
        before.into_iter().map(|shot| shot.fate).collect()
    }

    /// What comes of so many experiments, after each number of shots.
    fn came(&self, experiments: u64) -> Vec<Came> {
        let longest = COUNTS.into_iter().max().unwrap_or_default();
        let of = |number: u64| {
            let fates = self.fates(longest, number);
            COUNTS.map(|count| Curve::of_v50(&fates[..count], Link::Probit, V50))
        };
        let found: Vec<_> = (0..experiments).into_par_iter().map(of).collect();
        let one = |(place, count): (usize, usize)| {
            let told: Vec<_> = found.iter().map(|told| told[place]).collect();
            let share = |is: &dyn Fn(&super::curve::OfV50) -> bool| {
                told.iter().flatten().filter(|told| is(told)).count() as f64 / experiments as f64
            };
            let is_closed = |ends: [bool; 2]| ends == [true, true];
            let mut values: Vec<f64> = told.iter().flatten().filter_map(|told| told.value).collect();
            values.sort_by(f64::total_cmp);
            let at = |part: f64| values.get((part * values.len() as f64) as usize).copied();
            Came {
                kind: *self,
                count,
                off: at(0.5).map(|value| (value - V50) / DEVIATION),
                spread: at(0.159).zip(at(0.841)).map(|(low, high)| 0.5 * (high - low) / DEVIATION),
                valued: share(&|told| told.value.is_some()),
                holds: share(&|told| is_closed(told.ends) && told.holds),
                misses: share(&|told| is_closed(told.ends) && !told.holds),
                open: share(&|told| !is_closed(told.ends)),
                none: told.iter().filter(|told| told.is_none()).count() as f64 / experiments as f64,
            }
        };
        COUNTS.into_iter().enumerate().map(one).collect()
    }
}

/// All kinds, by so many experiments of each.
fn all(experiments: u64) -> Vec<Came> {
    let mut came = Vec::new();
    for truth in Truth::ALL {
        for guess in GUESSES {
            for design in designs(guess * DEVIATION) {
                for size in SIZES {
                    came.extend(Kind { design, truth, guess, size }.came(experiments));
                }
            }
        }
    }
    came
}

/// The table of all kinds.
pub fn report(experiments: u64) -> String {
    let came = all(experiments);
    let column = |above: &str, below: &str, entry: &dyn Fn(&Came) -> String| Column {
        heading: [above, below].map(String::from),
        entries: came.iter().map(entry).collect(),
    };
    let share = |share: f64| format!("{share:.3}");
    let columns = vec![
        column("truth", "", &|came| came.kind.truth.name().to_string()),
        column("guess", "σ", &|came| came.kind.guess.to_string()),
        column("design", "", &|came| came.kind.design.name().to_string()),
        column("at a", "time", &|came| came.kind.size.to_string()),
        column("after", "shots", &|came| came.count.to_string()),
        column("V50 off", "σ", &|came| or_dash(came.off, |off| format!("{off:+.3}"))),
        column("spread", "σ", &|came| or_dash(came.spread, share)),
        column("has", "value", &|came| share(came.valued)),
        column("holds", "share", &|came| share(came.holds)),
        column("misses", "share", &|came| share(came.misses)),
        column("unbounded", "share", &|came| share(came.open)),
        column("none", "share", &|came| share(came.none)),
    ];
    let head = format!(
        "{experiments} simulated experiments of each kind; V50 {V50}, σ {DEVIATION}, scatter {SCATTER}, range {MIDDLE} ± {HALF_RANGE} guesses; \
         intervals of 95 % by the probit. V50 off and its spread are the middle and half of the middle 68 % of those that have \
         a value; the last four shares are of all experiments."
    );
    format!("{}\n{}", paragraph(&head), table(columns, WIDTH))
}

#[cfg(test)]
mod tests {
    use super::super::designs::Approach;
    use super::*;

    /// Of experiments of 40 shots by 3pod: how far the speed at which `chance` of the shots go through is off, in the
    /// middle, and half of what is between the middle 68 %, over the deviation; by the speed that the design asks for
    /// next, which with the third phase is its estimate, and by the likeliest curve of all shots.
    fn of_percentile(truth: Truth, chance: f64, is_approached: bool, experiments: u64) -> [[f64; 2]; 2] {
        let approach = is_approached.then_some(Approach { chance, after: 15 });
        let kind = Kind { design: Design::ThreePod { deviation: DEVIATION, approach }, truth, guess: 1.0, size: 1 };
        // The truth's place of the chance, by halving.
        let halved = |[low, high]: [f64; 2]| {
            let middle = 0.5 * (low + high);
            if truth.chance(middle) < chance { [middle, high] } else { [low, middle] }
        };
        let [place, _] = (0..60).fold([-20.0, 20.0], |ends, _| halved(ends));
        let one = |number: u64| {
            let fates = kind.fates(40, number);
            let fired: Vec<Fired> = fates.iter().map(|&fate| Fired { nominal: fate.speed, fate }).collect();
            let range = [-1.0, 1.0].map(|side| MIDDLE + side * HALF_RANGE * DEVIATION);
            let [v50, deviation] = Curve::likeliest(&fates);
            let by_curve = v50 + Link::Probit.quantile(chance) * deviation;
            [kind.design.speed(fired.len() + 1, &fired, range), by_curve].map(|speed| (speed - V50) / DEVIATION - place)
        };
        let found: Vec<[f64; 2]> = (0..experiments).into_par_iter().map(one).collect();
        [0, 1].map(|by| {
            let mut off: Vec<f64> = found.iter().map(|found| found[by]).collect();
            off.sort_by(f64::total_cmp);
            let at = |part: f64| off[(part * off.len() as f64) as usize];
            [at(0.5), 0.5 * (at(0.841) - at(0.159))]
        })
    }

    /// The third phase comes to its percentile.
    #[test]
    fn the_third_phase_comes_to_its_percentile() {
        let [[off, spread], _] = of_percentile(Truth::Normal, 0.9, true, 60);
        assert!(off.abs() < 0.3 && spread < 1.0, "{off} {spread}");
    }

    /// 400 experiments of each kind, for the results. The third phase is less off than the curve of as many shots of the
    /// second one, and spreads more.
    #[test]
    #[ignore = "takes minutes"]
    fn the_third_phase_by_simulation() {
        for truth in Truth::ALL {
            for chance in [0.1, 0.9, 0.99] {
                let [next, all] = of_percentile(truth, chance, true, 400);
                let [_, second] = of_percentile(truth, chance, false, 400);
                println!(
                    "{} {chance}: phase III {next:.3?}, curve of its shots {all:.3?}, phase II alone {second:.3?}",
                    truth.name()
                );
                assert!(next[1] > second[1], "{} {chance}: {next:?} {second:?}", truth.name());
            }
        }
    }

    /// Half of the shots go through at V50, whatever the truth, and the deviations are one.
    #[test]
    fn truths_have_one_median_and_one_deviation() {
        for truth in Truth::ALL {
            assert!((truth.chance(0.0) - 0.5).abs() < 1e-12, "{truth:?}");
            let step = 1e-3;
            let places = (-12_000..20_000).map(|i| f64::from(i) * step);
            let parts: Vec<(f64, f64)> =
                places.map(|z| (z + 0.5 * step, truth.chance(z + step) - truth.chance(z))).collect();
            let mean: f64 = parts.iter().map(|(z, part)| z * part).sum();
            let variance: f64 = parts.iter().map(|(z, part)| (z - mean).powi(2) * part).sum();
            assert!((variance - 1.0).abs() < 1e-3, "{truth:?}: {variance}");
            assert_eq!(truth == Truth::Skewed, mean.abs() > 0.1, "{truth:?}: {mean}");
        }
    }

    /// What is told of V50 without a whole curve is what the curve tells.
    #[test]
    fn what_is_told_of_v50_is_that_of_the_curve() {
        let mut counts = [0; 4];
        for design in designs(DEVIATION) {
            for (number, shots) in (0..24).zip([4, 6, 8, 10, 14, 20].into_iter().cycle()) {
                let kind = Kind { design, truth: Truth::Normal, guess: 1.0, size: 1 };
                let fates = kind.fates(shots, number);
                let (told, curve) = (Curve::of_v50(&fates, Link::Probit, V50), Curve::fit(&fates, Link::Probit, false));
                let (Some(told), Some(curve)) = (told, &curve) else {
                    assert!(told.is_none() && curve.is_none());
                    counts[0] += 1;
                    continue;
                };
                let found = curve.v50();
                assert_eq!(told.ends, [found.interval.low.is_some(), found.interval.high.is_some()], "{fates:?}");
                assert_eq!(told.holds, found.interval.contains(V50), "{fates:?}");
                assert_eq!(told.value.is_some(), found.value.is_some());
                let apart = told.value.zip(found.value).map_or(0.0, |(one, other)| (one - other).abs());
                assert!(apart < 1e-6, "{apart}");
                counts[1] += usize::from(told.value.is_some());
                counts[2] += usize::from(!told.holds);
                counts[3] += usize::from(told.ends != [true, true]);
            }
        }
        assert!(counts[1..].iter().all(|&count| count > 0), "{counts:?}");
    }

    /// Few experiments of each design, one and four shots at a time: V50 is found, all are counted, and more shots
    /// leave less spread.
    #[test]
    fn every_experiment_is_counted() {
        for design in designs(DEVIATION) {
            for size in [1, 4] {
                let came = Kind { design, truth: Truth::Normal, guess: 1.0, size }.came(60);
                for came in &came {
                    let sum = came.holds + came.misses + came.open + came.none;
                    assert!((sum - 1.0).abs() < 1e-12, "{came:?}");
                    assert!(came.off.is_some_and(|off| off.abs() < 0.35), "{came:?}");
                }
                let last = &came[2];
                assert!(last.spread < came[0].spread && last.valued > 0.8 && last.holds > 0.75, "{came:?}");
            }
        }
    }
}
