//! Neyer's design (1994): where a shot tells most of V50 and the deviation.

use super::{Plan, Step, close};
use crate::v50::curve::{Curve, Fate};
use crate::v50::link::Link;
use crate::v50::search::maximum;

/// What the guess of the deviation loses with each shot by which the fates do not mix yet.
pub const SHRINKING: f64 = 0.8;
/// The next shot is sought so many deviations about V50, at so many places, and between them.
const REACH: f64 = 4.0;
const PLACES: usize = 80;

/// What is taken for V50 and the deviation where fates mix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    pub v50: f64,
    pub deviation: f64,
    /// Whether no curve that rises suits the shots better than a level one.
    pub is_flat: bool,
}

/// The likeliest V50 and deviation of fates that mix, no further out than the shots: V50 between the slowest and the
/// fastest, and a deviation up to what is between them.
///
/// Where perforations were no faster than stops in the mean, the likeliest curve is level: its deviation has no end,
/// and its V50 lies infinitely far on the side of the rarer fate. By Neyer's flow chart the deviation is then the
/// distance of the slowest from the fastest shot, and V50 the fastest one after more stops, the slowest after more
/// perforations; of as many of both, which he leaves open, it is the middle. (The R package gonogo takes the slowest
/// shot for V50 always, and goes 1.3153 such deviations up after a stop, down after a perforation; that is not
/// published, and its shots can lie far from all others.)
pub fn estimate(fates: &[Fate]) -> Estimate {
    let [slowest, fastest] = ends(fates);
    let of = |through: bool| {
        let speeds = fates.iter().filter(move |fate| fate.through == through).map(|fate| fate.speed);
        let count = fates.iter().filter(|fate| fate.through == through).count();
        (count, speeds.sum::<f64>() / count as f64)
    };
    let ((stops, of_stops), (perforations, of_perforations)) = (of(false), of(true));
    let range = fastest - slowest;
    if of_perforations <= of_stops || close(of_perforations, of_stops) {
        let v50 = match stops.cmp(&perforations) {
            std::cmp::Ordering::Greater => fastest,
            std::cmp::Ordering::Less => slowest,
            std::cmp::Ordering::Equal => 0.5 * (slowest + fastest),
        };
        return Estimate { v50, deviation: range, is_flat: true };
    }
    let [v50, deviation] = Curve::likeliest(fates);
    Estimate { v50: v50.clamp(slowest, fastest), deviation: deviation.min(range), is_flat: false }
}

/// The slowest and the fastest of shots.
pub fn ends(fates: &[Fate]) -> [f64; 2] {
    let speeds = fates.iter().map(|fate| fate.speed);
    speeds.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], speed| [low.min(speed), high.max(speed)])
}

/// In three parts: until there are both fates, until they mix, and from then on. Part and speed follow from the shots
/// so far, whatever speeds they were to have.
pub fn plan(fates: &[Fate], [low, high]: [f64; 2], guess: f64) -> Plan {
    let [slowest, fastest] = ends(fates);
    let Bounds { stop, through, counts } = Bounds::of(fates);
    let gap = [stop, through];
    match counts {
        [0, 0] => Plan::at(0.5 * (low + high), Step::Middle),
        [_, 0] => {
            let speed = (0.5 * (high + fastest)).max(fastest + 2.0 * guess).max(2.0 * fastest - slowest);
            Plan::at(speed, Step::Outward { through: false })
        }
        [0, _] => {
            let speed = (0.5 * (low + slowest)).min(slowest - 2.0 * guess).min(2.0 * slowest - fastest);
            Plan::at(speed, Step::Outward { through: true })
        }
        _ if through < stop => most_told_by(estimate(fates)),
        _ => {
            let left = guess_left(fates, guess);
            let middle = 0.5 * (stop + through);
            if is_wider(gap, left) {
                Plan::at(middle, Step::Halving { gap, above: left })
            } else {
                let of = Estimate { v50: middle, deviation: left, is_flat: false };
                Plan::MostTold { of, shrinking: SHRINKING, step: Step::AboutGap { gap, guess: left } }
            }
        }
    }
}

/// The fastest stop, the slowest perforation, and how many there are of both.
pub struct Bounds {
    pub stop: f64,
    pub through: f64,
    pub counts: [usize; 2],
}

impl Bounds {
    pub fn of(fates: &[Fate]) -> Bounds {
        let mut bounds = Bounds { stop: f64::NEG_INFINITY, through: f64::INFINITY, counts: [0; 2] };
        fates.iter().for_each(|fate| bounds.add(fate));
        bounds
    }

    fn add(&mut self, fate: &Fate) {
        self.counts[usize::from(fate.through)] += 1;
        if fate.through {
            self.through = self.through.min(fate.speed);
        } else {
            self.stop = self.stop.max(fate.speed);
        }
    }

    /// Whether a perforation was slower than a stop.
    pub fn mix(&self) -> bool {
        self.through < self.stop
    }
}

/// A shot that tells most by an estimate.
pub fn most_told_by(of: Estimate) -> Plan {
    Plan::MostTold { of, shrinking: 1.0, step: Step::Estimate(of) }
}

/// Digits that were lost in a difference do not make a gap wider.
fn is_wider([stop, through]: [f64; 2], than: f64) -> bool {
    through - stop > than && !close(through, stop + than)
}

/// The guess that is left: it has shrunk with every shot since the gap was no wider than it.
fn guess_left(fates: &[Fate], guess: f64) -> f64 {
    let (mut left, mut bounds) = (guess, Bounds::of(&[]));
    for fate in &fates[..fates.len() - 1] {
        bounds.add(fate);
        let is_gap = !bounds.counts.contains(&0) && !bounds.mix();
        if is_gap && !is_wider([bounds.stop, bounds.through], left) {
            left *= SHRINKING;
        }
    }
    left
}

/// The speed at which one more shot makes the determinant of Fisher's information on V50 and the deviation largest, if
/// they are these: of the places that are no nearer than `least` to a speed that is taken. The shots at the speeds that
/// are taken count as fired: information needs no fates.
pub fn most_told(fates: &[Fate], taken: &[f64], of: Estimate, least: f64) -> f64 {
    let Estimate { v50, deviation, .. } = of;
    let place = |speed: f64| (speed - v50) / deviation;
    let weight = |z: f64| Link::Probit.log_information(z).exp();
    let mut sums = [0.0; 3];
    for speed in fates.iter().map(|fate| fate.speed).chain(taken.iter().copied()) {
        let z = place(speed);
        let weight = weight(z);
        sums = [sums[0] + weight, sums[1] + weight * z, sums[2] + weight * z * z];
    }
    let determinant = |z: f64| {
        let weight = weight(z);
        (sums[0] + weight) * (sums[2] + weight * z * z) - (sums[1] + weight * z).powi(2)
    };
    let is_free = |z: &f64| taken.iter().all(|&speed| (v50 + deviation * z - speed).abs() >= least);
    let step = 2.0 * REACH / PLACES as f64;
    let evenly = (0..=PLACES).map(|i| -REACH + step * i as f64);
    // Next to a speed that is taken, and just so far from it.
    let beside = |speed: f64| [-1.0, 1.0].map(|side| place(speed + side * least * (1.0 + 1e-9)));
    let places = evenly.chain(taken.iter().flat_map(|&speed| beside(speed))).filter(is_free);
    let best = places.fold((0.0, f64::NEG_INFINITY), |best, z| {
        let found = determinant(z);
        if found > best.1 { (z, found) } else { best }
    });
    let (z, found) = maximum(determinant, [best.0 - step, best.0 + step]);
    v50 + deviation * if is_free(&z) && found > best.1 { z } else { best.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::v50::designs::{Design, Fired, Next};

    fn fates(shots: &[(f64, u8)]) -> Vec<Fate> {
        shots.iter().map(|&(speed, through)| Fate { speed, through: through == 1 }).collect()
    }

    /// It leaves a range in which all fates are alike, halves the gap, and then stands 1.138 deviations from V50.
    #[test]
    fn a_shot_stands_where_it_tells_most() {
        let two_sided: Vec<Fate> = (0..40)
            .map(|i| Fate { speed: 150.0 + if i % 2 == 0 { -1.138 } else { 1.138 } * 5.0, through: i % 4 == 0 })
            .collect();
        let of = Estimate { v50: 150.0, deviation: 5.0, is_flat: false };
        let next = most_told(&two_sided, &[], of, 0.0);
        assert!(((next - 150.0).abs() / 5.0 - 1.138).abs() < 0.01, "{next}");
        // All shots on one side: the other one tells more.
        let one_sided = [Fate { speed: 156.0, through: true }; 10];
        assert!(most_told(&one_sided, &[], of, 0.0) < 150.0);
        // What is taken counts as fired, and is not repeated.
        let second = most_told(&two_sided, &[next], of, 2.0);
        assert!((second - 150.0) * (next - 150.0) < 0.0, "{next} {second}");
        let third = most_told(&two_sided, &[next, second], of, 2.0);
        assert!([next, second].iter().all(|taken| (third - taken).abs() >= 2.0), "{next} {second} {third}");
    }

    /// Neyer's table 1: drops from 1 m on, where 0.6 to 1.4 m and a deviation of 0.1 m were guessed, and 5 m and 1 m
    /// are true. Each height follows from those before, to the digits that are printed.
    #[test]
    fn neyer_s_example_is_met() {
        let drops = fates(&[
            (1.0, 0),
            (1.2, 0),
            (1.4, 0),
            (1.8, 0),
            (2.6, 0),
            (4.2, 1),
            (3.4, 0),
            (3.8, 0),
            (4.0, 0),
            (4.1, 0),
            (4.28, 0),
            (4.52, 0),
            (5.55, 1),
            (5.24, 0),
            (6.37, 1),
            (6.08, 0),
            (7.38, 1),
            (7.09, 1),
            (6.89, 1),
            (6.74, 1),
        ]);
        let design = Design::DOptimal { deviation: 0.1 };
        for (count, drop) in drops.iter().enumerate() {
            let before: Vec<Fired> = drops[..count].iter().map(|&fate| Fired { nominal: fate.speed, fate }).collect();
            let next = design.speed(count + 1, &before, [0.6, 1.4]);
            assert!((next - drop.speed).abs() < 0.0075, "{}: {next}, published {}", count + 1, drop.speed);
        }
        // What he says of V50 and the deviation before drops 12 to 20.
        for (count, v50, deviation) in
            [(11, 4.28, 0.19), (12, 4.52, 0.79), (13, 4.66, 0.50), (14, 5.22, 0.96), (16, 5.70, 1.39), (19, 5.44, 1.09)]
        {
            let found = estimate(&drops[..count]);
            let is_near = |found: f64, published: f64| (found - published).abs() < 0.0101;
            assert!(is_near(found.v50, v50) && is_near(found.deviation, deviation), "{count}: {found:?}");
        }
    }

    /// By hand: a gap of 4 below a guess of 5 is halved no more, and each shot that leaves it a gap leaves four fifths of
    /// the guess.
    #[test]
    fn the_guess_shrinks_in_the_gap() {
        let shots = fates(&[(150.0, 0), (154.0, 1), (147.0, 0), (158.0, 1)]);
        for (count, left) in [(2, 5.0), (3, 4.0)] {
            let found = plan(&shots[..count], [100.0, 200.0], 5.0);
            let Plan::MostTold { of, shrinking, .. } = found else { panic!("{found:?}") };
            assert!((of.deviation - left).abs() < 1e-12, "{count}: {of:?}");
            assert_eq!((of.v50, shrinking), (152.0, 0.8));
        }
        // The gap is wider than the 3.2 that are left then.
        let found = plan(&shots, [100.0, 200.0], 5.0);
        assert!(matches!(found, Plan::At(Next { speed: 152.0, step: Step::Halving { .. } })), "{found:?}");
    }

    /// Perforations that were no faster than stops: the flow chart's clips, and nothing that rounding decides.
    #[test]
    fn a_level_curve_is_clipped_as_published() {
        let flat = |shots: &[(f64, u8)]| {
            let found = estimate(&fates(shots));
            assert!(found.is_flat && found.deviation == 30.0, "{found:?}");
            found.v50
        };
        assert_eq!(flat(&[(100.0, 0), (110.0, 1), (130.0, 0)]), 130.0);
        assert_eq!(flat(&[(100.0, 1), (110.0, 0), (130.0, 1), (100.0, 1)]), 100.0);
        assert_eq!(flat(&[(100.0, 1), (130.0, 0)]), 115.0);
        // Equal means are level too.
        assert_eq!(flat(&[(100.0, 0), (130.0, 0), (115.0, 1)]), 130.0);
        let scaled = |factor: f64| estimate(&fates(&[(0.1 * factor, 0), (0.3 * factor, 0), (0.2 * factor, 1)])).is_flat;
        assert!(scaled(1.0) && scaled(3.280_84) && scaled(1e-3));
        assert!(!estimate(&fates(&[(100.0, 0), (130.0, 0), (116.0, 1)])).is_flat);
    }
}
