//! Several shots at a time, before the fates of any of them are known.

use super::d_optimal::{ends, estimate, most_told};
use super::why::Rule;
use super::{Design, Estimate, Fired, Next, Plan, SLOWEST, Step, fates};
use crate::v50::curve::{Fate, Mix, mix};
use crate::v50::link::Link;

/// No two shots of a batch are nearer to each other than this part of the deviation, guessed or estimated.
pub const APART: f64 = 0.05;
/// So many courses of what may come are looked at, at most.
const COURSES: usize = 256;
/// Chances that differ by so little of them are the same.
const SAME: f64 = 1e-9;

/// What is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Batch {
    pub range: [f64; 2],
    /// The guess of the deviation.
    pub guess: f64,
    /// As many shots at a time, those included that are still to be fired.
    pub size: usize,
    /// Shots of the batch that have their speeds and are still to be fired.
    pub pending: Vec<f64>,
    /// Speeds are whole multiples of this, where it is given.
    pub resolution: Option<f64>,
}

/// A course that the experiment may take: shots up to now and as if they had been fired, and how likely.
struct Course {
    shots: Vec<Fired>,
    chance: f64,
}

impl Batch {
    /// The speeds of the shots that are left of a batch, no two of them equal.
    ///
    /// - By an estimate, or by Neyer's guess about a gap, each shot stands where it tells most with those before it,
    ///   whose fates that does not need.
    /// - A percentile is approached by a batch about one speed, that makes one step.
    /// - Up and down goes on in as many series as there are shots.
    /// - Else, where there is no estimate, the batch has the speeds that the design would ask for after the likeliest
    ///   fates of the shots before them, as if V50 were in the middle of the gap, of the range, or beyond shots that
    ///   were all alike, and the deviation the guess.
    pub fn speeds(&self, design: Design, before: &[Fired]) -> Vec<Next> {
        let fates = fates(before);
        let mut found: Vec<Next> = Vec::new();
        let mut taken = self.pending.clone();
        let wanted = self.size.saturating_sub(self.pending.len());
        if let (Rule::Courses(curve), _) = self.rule(design, before) {
            found = self.by_courses(design, before, wanted, curve);
            taken.extend(found.iter().map(|next| next.speed));
        }
        while found.len() < wanted {
            let plan = design.plan(before.len() + taken.len() + 1, before, &fates, self.range, self.size);
            let (speed, deviation) = match plan {
                Plan::At(next) => (next.speed, self.guess),
                Plan::About { speed, deviation, .. } => (speed, deviation),
                Plan::MostTold { of, shrinking, .. } => {
                    let deviation = of.deviation * shrinking.powi(taken.len() as i32);
                    let of = Estimate { deviation, ..of };
                    (most_told(&fates, &taken, of, self.least(deviation)), deviation)
                }
            };
            let speed = self.beside(speed, &taken, deviation);
            taken.push(speed);
            found.push(Next { speed, step: plan.step() });
        }
        found
    }

    /// By which rule, and what the first shot of the batch is for.
    pub fn rule(&self, design: Design, before: &[Fired]) -> (Rule, Step) {
        let fates = fates(before);
        let plan = design.plan(before.len() + 1, before, &fates, self.range, self.size);
        let rule = match (plan, design) {
            (_, Design::UpAndDown { .. } | Design::Even) => Rule::Series,
            (Plan::MostTold { .. }, _) => Rule::MostTold,
            (Plan::About { .. }, _) => Rule::About,
            (Plan::At(Next { speed, .. }), _) => Rule::Courses(self.supposed(&fates, speed)),
        };
        (rule, plan.step())
    }

    /// How near two shots of the batch may stand.
    fn least(&self, deviation: f64) -> f64 {
        (APART * deviation).max(self.resolution.unwrap_or(0.0))
    }

    fn rounded(&self, speed: f64) -> f64 {
        let slowest = SLOWEST * self.range[0];
        let Some(resolution) = self.resolution else { return speed.max(slowest) };
        (speed / resolution).round().max((slowest / resolution).ceil()) * resolution
    }

    /// The speed itself, or the nearest one that is not taken.
    fn beside(&self, speed: f64, taken: &[f64], deviation: f64) -> f64 {
        let (least, speed) = (self.least(deviation), speed.max(SLOWEST * self.range[0]));
        let aside = (0..).flat_map(|i: usize| [i as f64, -(i as f64)]).map(|i| self.rounded(speed + i * least));
        let free = aside.take(8 * taken.len() + 8).find(|&speed| is_free(speed, taken, least));
        free.unwrap_or_else(|| self.rounded(speed))
    }

    /// The speeds that the design may ask for next, the likeliest courses of what comes first.
    fn by_courses(&self, design: Design, before: &[Fired], wanted: usize, curve: Estimate) -> Vec<Next> {
        let mut found: Vec<Next> = Vec::new();
        let mut courses = vec![Course { shots: before.to_vec(), chance: 1.0 }];
        for _ in 0..COURSES {
            let best = courses.iter().map(|course| course.chance).fold(0.0, f64::max);
            let Some(place) = courses.iter().position(|course| course.chance >= best * (1.0 - SAME)) else { break };
            if found.len() == wanted {
                break;
            }
            let Course { shots, chance } = courses.remove(place);
            let fates = fates(&shots);
            let plan = design.plan(shots.len() + 1, &shots, &fates, self.range, self.size);
            let speed = self.rounded(plan.speed(&fates));
            let taken: Vec<f64> = self.pending.iter().copied().chain(found.iter().map(|next| next.speed)).collect();
            if is_free(speed, &taken, self.least(self.guess)) {
                found.push(Next { speed, step: plan.step() });
            }
            let through = Link::Probit.chance((speed - curve.v50) / curve.deviation);
            // The rarer fate first where both are as likely: the search goes on to its side.
            let count = |through: bool| before.iter().filter(|shot| shot.fate.through == through).count();
            let stop_first = count(false) > count(true);
            for is_through in [!stop_first, stop_first] {
                let fate = Fate { speed, through: is_through };
                let chance = chance * if is_through { through } else { 1.0 - through };
                courses.push(Course { shots: [&shots[..], &[Fired { nominal: speed, fate }]].concat(), chance });
            }
        }
        found
    }

    /// The curve by which fates are supposed where there is no estimate; `first` is the speed of the first shot.
    fn supposed(&self, fates: &[Fate], first: f64) -> Estimate {
        let middle = 0.5 * (self.range[0] + self.range[1]);
        let [slowest, fastest] = ends(fates);
        let v50 = match mix(fates) {
            _ if fates.is_empty() => middle,
            Mix::AllStopped => middle.max(first),
            Mix::AllThrough => middle.min(first),
            Mix::Separated([stop, through]) => 0.5 * (stop + through),
            Mix::Mixed | Mix::Level if fastest > slowest => return estimate(fates),
            Mix::Mixed | Mix::Level => slowest,
        };
        Estimate { v50, deviation: self.guess, is_flat: false }
    }
}

fn is_free(speed: f64, taken: &[f64], least: f64) -> bool {
    taken.iter().all(|taken| (speed - taken).abs() >= least * (1.0 - SAME))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::v50::designs::Approach;

    const RANGE: [f64; 2] = [100.0, 200.0];

    fn batch(size: usize) -> Batch {
        Batch { range: RANGE, guess: 12.5, size, pending: Vec::new(), resolution: None }
    }

    fn designs() -> [Design; 5] {
        let deviation = 12.5;
        [
            Design::Langlie,
            Design::UpAndDown { step: deviation },
            Design::DOptimal { deviation },
            Design::ThreePod { deviation, approach: None },
            Design::ThreePod { deviation, approach: Some(Approach { chance: 0.9, after: 12 }) },
        ]
    }

    fn fired(shots: &[(f64, u8)]) -> Vec<Fired> {
        let one = |&(speed, through): &(f64, u8)| Fired { nominal: speed, fate: Fate { speed, through: through == 1 } };
        shots.iter().map(one).collect()
    }

    fn speeds(batch: &Batch, design: Design, before: &[Fired]) -> Vec<f64> {
        batch.speeds(design, before).iter().map(|next| next.speed).collect()
    }

    /// Experiments of 24 shots, of each design, in batches of each size and by coarse speeds: as many speeds as are
    /// asked for, and no two in a batch are equal or nearer than the resolution.
    #[test]
    fn no_two_shots_of_a_batch_are_equal() {
        for design in designs() {
            for (size, resolution) in [(1, None), (2, None), (5, Some(5.0)), (8, None), (8, Some(30.0))] {
                for limit in [60.0, 131.0, 152.0, 199.0, 260.0] {
                    let mut before = Vec::new();
                    let batch = Batch { resolution, ..batch(size) };
                    while before.len() < 24 {
                        let found = speeds(&batch, design, &before);
                        assert_eq!(found.len(), size, "{design:?}");
                        let least = resolution.unwrap_or(1e-6);
                        for (place, speed) in found.iter().enumerate() {
                            assert!(*speed >= 10.0 && speed.is_finite(), "{design:?} {found:?}");
                            assert!(
                                found[..place].iter().all(|other| (speed - other).abs() > 0.999 * least),
                                "{design:?} {size} {found:?}"
                            );
                        }
                        // Fates that mix: shots off the limit by less than 8 are turned every third time.
                        let fates = found.iter().map(|&speed| {
                            let turned = (speed - limit).abs() < 8.0 && (speed * 7.0) as i64 % 3 == 0;
                            (speed, u8::from((speed > limit) != turned))
                        });
                        before.extend(fired(&fates.collect::<Vec<_>>()));
                    }
                }
            }
        }
    }

    /// A batch of one is the design's own next shot, whatever came before.
    #[test]
    fn a_batch_of_one_is_the_next_shot() {
        let all = fired(&[
            (125.0, 0),
            (175.0, 1),
            (150.0, 0),
            (160.0, 1),
            (145.0, 1),
            (152.0, 0),
            (148.0, 0),
            (157.0, 1),
            (150.0, 1),
            (139.0, 0),
            (166.0, 1),
            (150.5, 0),
            (161.0, 1),
            (158.0, 1),
        ]);
        for design in designs() {
            for count in 0..=all.len() {
                let one = speeds(&batch(1), design, &all[..count]);
                let own = design.speed(count + 1, &all[..count], RANGE);
                assert!((one[0] - own).abs() < 1e-9, "{design:?} {count}: {one:?} {own}");
            }
        }
    }

    /// Shots of a batch that have been written down but not fired change nothing: the rest is the same.
    #[test]
    fn a_batch_that_is_under_way_is_the_same_batch() {
        for design in designs() {
            for before in
                [vec![], fired(&[(125.0, 0), (175.0, 1)]), fired(&[(150.0, 0), (140.0, 1), (160.0, 1), (130.0, 0)])]
            {
                let whole = speeds(&batch(4), design, &before);
                for count in 1..=4 {
                    let rest = speeds(&Batch { pending: whole[..count].to_vec(), ..batch(4) }, design, &before);
                    let same = rest.iter().zip(&whole[count..]).all(|(one, other)| (one - other).abs() < 1e-9);
                    assert!(same && rest.len() == 4 - count, "{design:?} {count}: {rest:?} {whole:?}");
                }
            }
        }
    }

    /// By hand: before there is any fate, and in a gap.
    #[test]
    fn a_batch_before_results_mix_has_the_likeliest_courses() {
        // The middle, and halfway from it to either end; then between these.
        let langlie = speeds(&batch(5), Design::Langlie, &[]);
        assert_eq!(langlie[..3], [150.0, 125.0, 175.0]);
        let rest: Vec<f64> = langlie[3..].to_vec();
        assert!(rest.contains(&137.5) && rest.contains(&162.5), "{langlie:?}");
        // 3pod's two first shots do not hang on each other.
        let pod = Design::ThreePod { deviation: 12.5, approach: None };
        assert_eq!(speeds(&batch(3), pod, &[]), [125.0, 175.0, 150.0]);
        // Neyer's: a gap from 125 to 175, which is halved and halved again.
        let gap = fired(&[(150.0, 0), (175.0, 1)]);
        let neyer = speeds(&batch(3), Design::DOptimal { deviation: 5.0 }, &gap);
        assert_eq!(neyer[0], 162.5);
        assert!(neyer[1..].contains(&156.25) && neyer[1..].contains(&168.75), "{neyer:?}");
    }

    /// Series side by side do not meet, and each goes its own way.
    #[test]
    fn up_and_down_goes_on_in_several_series() {
        let design = Design::UpAndDown { step: 12.0 };
        let first = speeds(&batch(3), design, &[]);
        assert_eq!(first, [150.0, 154.0, 146.0]);
        let before = fired(&[(150.0, 1), (154.0, 0), (146.0, 0)]);
        assert_eq!(speeds(&batch(3), design, &before), [138.0, 166.0, 158.0]);
    }
}
