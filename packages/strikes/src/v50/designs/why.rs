//! What a shot is for, in the words of its design.

use super::Estimate;
use toron_shared::numbers::number;

/// What a shot is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// Wherever the golden section of the range has come to.
    Evenly,
    Middle,
    /// Langlie's: halfway from the last shot to one of this number, or to an end of the range.
    Balanced {
        number: usize,
        speed: f64,
    },
    ToEnd {
        through: bool,
    },
    /// A step from a shot that was to have this speed.
    Stepped {
        from: f64,
        through: bool,
    },
    /// All fates are alike: away from the range.
    Outward {
        through: bool,
    },
    /// Neyer's: into the middle of a gap that is wider than this, or about one that is not, by the guess that is left.
    Halving {
        gap: [f64; 2],
        above: f64,
    },
    AboutGap {
        gap: [f64; 2],
        guess: f64,
    },
    Estimate(Estimate),
    /// 3pod's: the quarters of the range, both ends of it, into a gap, beside it, and about the mixed zone.
    Quarter,
    BothSides,
    Between {
        gap: [f64; 2],
        above: f64,
    },
    Aside {
        gap: [f64; 2],
        guess: f64,
        is_above: bool,
    },
    Enhance {
        zone: [f64; 2],
    },
    /// The third phase, after so many shots.
    Approach {
        chance: f64,
        first: usize,
    },
}

impl Step {
    /// The name of the phase or the state.
    pub fn phase(&self) -> &'static str {
        match self {
            Step::Evenly | Step::Middle => "first shot",
            Step::Balanced { .. } => "balanced",
            Step::ToEnd { .. } => "not balanced",
            Step::Stepped { .. } => "step",
            Step::Outward { .. } => "search, all fates alike",
            Step::Halving { .. } => "search, gap halved",
            Step::AboutGap { .. } => "by the guess",
            Step::Estimate(of) if of.is_flat => "by the estimate, level curve",
            Step::Estimate(_) => "by the estimate",
            Step::Quarter | Step::BothSides => "phase I, both fates",
            Step::Between { .. } | Step::Aside { .. } => "phase I, search for a mixed zone",
            Step::Enhance { .. } => "phase I, more in the mixed zone",
            Step::Approach { .. } => "phase III",
        }
    }

    /// Why a shot is fired there, in a sentence.
    pub fn why(&self, unit: &str) -> String {
        let speed = |speed: f64| format!("{} {unit}", number(speed));
        let gap = |[stop, through]: [f64; 2]| {
            format!("the fastest stop at {} and the slowest perforation at {}", speed(stop), speed(through))
        };
        match *self {
            Step::Evenly => "The shots fill the range evenly.".to_string(),
            Step::Middle => "The first shots stand in the middle of the range.".to_string(),
            Step::Balanced { number, speed: of } => format!(
                "From shot {number} to the last one there are as many stops as perforations: halfway between the last shot and \
                 that one, at {}.",
                speed(of)
            ),
            Step::ToEnd { through } => format!(
                "No shot back stops and perforations are balanced: halfway from the last one to the {} end of the range, after a {}.",
                if through { "slow" } else { "fast" },
                fate(through)
            ),
            Step::Stepped { from, through } => format!(
                "After a {} of a shot for {} a step {}.",
                fate(through),
                speed(from),
                if through { "down" } else { "up" }
            ),
            Step::Outward { through } => format!(
                "All shots {}: {}, away from them.",
                if through { "went through" } else { "were stopped" },
                if through { "slower" } else { "faster" }
            ),
            Step::Halving { gap: ends, above } => format!(
                "The results do not mix: between {} there is a gap wider than {}, the guess of σ that is left. It is halved.",
                gap(ends),
                speed(above)
            ),
            Step::AboutGap { gap: ends, guess } => format!(
                "The results do not mix: between {} there is a gap no wider than the guess of σ. There is no estimate; a shot \
                 tells most if V50 is the gap's middle and σ {}.",
                gap(ends),
                speed(guess)
            ),
            Step::Estimate(Estimate { v50, deviation, is_flat }) => {
                let by = format!("V50 at {} and a σ of {}", speed(v50), speed(deviation));
                if is_flat {
                    format!(
                        "The results mix, but the perforations were no faster than the stops in the mean: no curve that \
                         rises suits them. A shot tells most by {by}, as far out as shots were fired."
                    )
                } else {
                    format!("The results mix: a shot tells most of V50 and σ there, by {by}, as they are estimated.")
                }
            }
            Step::Quarter => "The first two shots stand at a quarter and three quarters of the range.".to_string(),
            Step::BothSides => {
                "The slower of the first two shots went through and the faster was stopped: the range is narrow, and a shot on \
                 either side follows."
                    .to_string()
            }
            Step::Between { gap: ends, above } => format!(
                "The results do not mix: between {} there is a gap of {} or more. The likeliest V50 by the guess of σ is next.",
                gap(ends),
                speed(above)
            ),
            Step::Aside { gap: ends, guess, is_above } => format!(
                "The results do not mix: {} lie near. A shot just {} them may mix them, 0.3 of the guess of σ away, which is {}.",
                gap(ends),
                if is_above { "above" } else { "below" },
                speed(guess)
            ),
            Step::Enhance { zone: [through, stop] } => format!(
                "The results mix from {} to {}: shots in that zone make the estimate firm.",
                speed(through),
                speed(stop)
            ),
            Step::Approach { chance, first } => format!(
                "The speed at which {} of 100 shots go through is approached, from what the first {first} shots said of it.",
                number(100.0 * chance)
            ),
        }
    }
}

/// By which rule the shots of a batch are chosen, before the fates of any of them are known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rule {
    /// Each where it tells most with those before it.
    MostTold,
    /// About one speed.
    About,
    /// In as many series.
    Series,
    /// Where the design would go next, for the likelier fates by this curve.
    Courses(Estimate),
}

impl Rule {
    /// What a batch of so many shots does, in sentences.
    pub fn why(&self, size: usize, unit: &str) -> String {
        match self {
            Rule::MostTold => {
                "Each shot of the batch counts as fired for the next one: where that tells most does not hang on results.".to_string()
            }
            Rule::About => "The batch stands about one speed, and makes one step with its mean result.".to_string(),
            Rule::Series => format!(
                "{size} series go on side by side, without an estimate: each shot follows that of {size} shots before, by the \
                 speed that was asked for."
            ),
            Rule::Courses(Estimate { v50, deviation, .. }) => format!(
                "No result of the batch is known yet, and the design has no estimate to go by: its further shots stand where the design \
                 would go next after the likelier results of those before them, as if V50 were {} {unit} and σ {} {unit}.",
                number(*v50),
                number(*deviation)
            ),
        }
    }
}

fn fate(through: bool) -> &'static str {
    if through { "perforation" } else { "stop" }
}
