//! At which speed the next shot is fired: the designs of an experiment.

mod batch;
mod d_optimal;
mod three_pod;
mod why;

use statrs::distribution::{ContinuousCDF, Normal};

pub use self::batch::{APART, Batch};
pub use self::d_optimal::Estimate;
use self::d_optimal::most_told;
pub use self::three_pod::OF_RANGE;
pub use self::why::{Rule, Step};
use super::curve::Fate;
use super::search::GOLDEN;

/// No shot is to be slower than this part of the range's lower end, and none is slower than this part of what it was to
/// be.
const SLOWEST: f64 = 0.1;
/// Numbers that differ by so little of them are the same, but for rounding.
const ROUNDING: f64 = 1e-12;

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
    /// Wu and Tian's (2014), 3pod: search, estimate, and where a percentile is given approach it; with a first guess of
    /// this.
    ThreePod { deviation: f64, approach: Option<Approach> },
}

/// What the third phase of 3pod approaches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Approach {
    /// The chance whose speed is sought.
    pub chance: f64,
    /// So many shots are those of the first two phases, or more, until these are over.
    pub after: usize,
}

/// A shot that has been fired: its speed was to be, and was.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fired {
    pub nominal: f64,
    pub fate: Fate,
}

/// A speed for a shot, and what it is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Next {
    pub speed: f64,
    pub step: Step,
}

/// What a design does next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Plan {
    /// A shot at a speed, behind which everything hangs on its fate.
    At(Next),
    /// Shots where they tell most by an estimate, whose deviation each shot multiplies by `shrinking`.
    MostTold { of: Estimate, shrinking: f64, step: Step },
    /// Shots about a speed that is approached, by an estimate of this deviation.
    About { speed: f64, deviation: f64, step: Step },
}

impl Plan {
    fn at(speed: f64, step: Step) -> Plan {
        Plan::At(Next { speed, step })
    }

    /// The speed of one shot.
    fn speed(&self, fates: &[Fate]) -> f64 {
        match *self {
            Plan::At(Next { speed, .. }) | Plan::About { speed, .. } => speed,
            Plan::MostTold { of, .. } => most_told(fates, &[], of, 0.0),
        }
    }

    fn step(&self) -> Step {
        match *self {
            Plan::At(Next { step, .. }) | Plan::About { step, .. } | Plan::MostTold { step, .. } => step,
        }
    }
}

/// The speed of a shot that scatters about what it was to be with this standard deviation: no speed is below 0, however
/// wide the scatter.
pub fn scattered(nominal: f64, scatter: f64, chance: f64) -> f64 {
    (nominal + scatter * Normal::standard().inverse_cdf(chance)).max(SLOWEST * nominal)
}

/// Whether two numbers are the same but for rounding.
fn close(one: f64, other: f64) -> bool {
    (one - other).abs() <= ROUNDING * one.abs().max(other.abs())
}

impl Design {
    pub fn name(&self) -> &'static str {
        match self {
            Design::Even => "even",
            Design::Langlie => "langlie",
            Design::UpAndDown { .. } => "up-and-down",
            Design::DOptimal { .. } => "d-optimal",
            Design::ThreePod { .. } => "3pod",
        }
    }

    /// Whether a shot needs the fates of those before it.
    pub fn is_sequential(&self) -> bool {
        *self != Design::Even
    }

    /// The speed that the shot of this number, from 1, is to have; before it were these, whose fates are known.
    pub fn speed(&self, number: usize, before: &[Fired], range: [f64; 2]) -> f64 {
        let fates = fates(before);
        // A shot without a fate is not among those before.
        let number = if self.is_sequential() { before.len() + 1 } else { number };
        self.plan(number, before, &fates, range, 1).speed(&fates).max(SLOWEST * range[0])
    }

    /// What the shot of this number is for, in batches of this size.
    fn plan(&self, number: usize, before: &[Fired], fates: &[Fate], range: [f64; 2], size: usize) -> Plan {
        let [low, high] = range;
        match *self {
            // By the golden section of the range from each to the next, any number of them lies evenly.
            Design::Even => Plan::at(low + (high - low) * (0.5 + GOLDEN * (number - 1) as f64).fract(), Step::Evenly),
            Design::Langlie => langlie(before, range),
            Design::UpAndDown { step } => up_and_down(number, before, range, step, size),
            Design::DOptimal { deviation } => d_optimal::plan(fates, range, deviation),
            Design::ThreePod { deviation, approach } => three_pod::plan(fates, range, deviation, approach, size),
        }
    }
}

fn fates(before: &[Fired]) -> Vec<Fate> {
    before.iter().map(|shot| shot.fate).collect()
}

fn langlie(before: &[Fired], [low, high]: [f64; 2]) -> Plan {
    let Some(last) = before.last() else { return Plan::at(0.5 * (low + high), Step::Middle) };
    let mut balance = 0;
    for (place, shot) in before.iter().enumerate().rev() {
        balance += if shot.fate.through { 1 } else { -1 };
        if balance == 0 {
            let speed = 0.5 * (last.fate.speed + shot.fate.speed);
            return Plan::at(speed, Step::Balanced { number: place + 1, speed: shot.fate.speed });
        }
    }
    let through = last.fate.through;
    Plan::at(0.5 * (last.fate.speed + if through { low } else { high }), Step::ToEnd { through })
}

/// As many series go on side by side as shots are fired at a time: each shot follows that of its own series. Their
/// first shots stand evenly within a step about the middle of the range, so that no two of them have the same speeds.
fn up_and_down(number: usize, before: &[Fired], [low, high]: [f64; 2], step: f64, size: usize) -> Plan {
    let last = number.checked_sub(size + 1).and_then(|place| before.get(place));
    match last {
        None => {
            let part = ((number - 1) % size) as f64 / size as f64;
            // From the middle outwards: 0, 1/k, -1/k, ...
            let aside = if part > 0.5 { part - 1.0 } else { part };
            Plan::at(0.5 * (low + high) + aside * step, Step::Middle)
        }
        Some(last) => {
            let through = last.fate.through;
            let speed = last.nominal + if through { -step } else { step };
            Plan::at(speed, Step::Stepped { from: last.nominal, through })
        }
    }
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

    /// Neyer's: it leaves a range in which all fates are alike, and halves the gap.
    #[test]
    fn a_d_optimal_design_searches() {
        let design = Design::DOptimal { deviation: 5.0 };
        let found = speeds(design, 6, |_, _| false);
        assert_eq!(found, [150.0, 175.0, 200.0, 250.0, 350.0, 550.0]);
        let found = speeds(design, 5, |_, speed| speed > 172.0);
        assert_eq!(found[..4], [150.0, 175.0, 162.5, 168.75]);
    }
}
