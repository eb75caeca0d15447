//! The results of a series: how many shots ended how, the curves, and what follows from them.

use super::curve::{Curve, Fate, Mix, mix};
use super::lambert_jonas::{Degenerate, LambertJonas};
use super::link::Link;
use super::shot::{Ended, Ending};
use super::test_houses::{self, Mean};
use toron_explicit_host::judgement::parts_of_verdict;

/// As many stops and as many perforations as test houses take: of four, six and ten shots.
const EACH: [usize; 3] = [2, 3, 5];

/// The series.
pub struct Series {
    pub shots: Vec<Ended>,
    pub fates: Vec<Fate>,
    pub mix: Mix,
    /// Logit and probit, and with Firth's correction, where it is asked for.
    pub curves: Vec<Curve>,
    pub means: Vec<Mean>,
    /// With a spread: the one of the most shots within it.
    pub within: Option<(f64, Option<Mean>)>,
    /// The curve of the residual speeds, or why there is none; nothing of too few.
    pub residual: Option<Result<LambertJonas, Degenerate>>,
}

impl Series {
    pub fn of(shots: Vec<Ended>, firth: bool, spread: Option<f64>) -> Series {
        let fates: Vec<Fate> = shots.iter().filter_map(Ended::fate).collect();
        let corrections: &[bool] = if firth { &[false, true] } else { &[false] };
        let kinds = corrections.iter().flat_map(|&firth| Link::BOTH.map(|link| (link, firth)));
        let perforations: Vec<[f64; 2]> =
            shots.iter().filter_map(|ended| Some([ended.shot.speed, ended.residual()?])).collect();
        Series {
            mix: mix(&fates),
            curves: kinds.filter_map(|(link, firth)| Curve::fit(&fates, link, firth)).collect(),
            means: EACH.iter().filter_map(|&each| test_houses::mean(&fates, each)).collect(),
            within: spread.map(|spread| (spread, test_houses::widest(&fates, spread))),
            residual: LambertJonas::fit(&perforations),
            shots,
            fates,
        }
    }

    fn count(&self, is: impl Fn(&Ending) -> bool) -> usize {
        self.shots.iter().filter(|ended| is(&ended.ending)).count()
    }

    /// Stopped, through, undecided, errors.
    pub fn counts(&self) -> [usize; 4] {
        [
            self.count(|ending| *ending == Ending::Stopped),
            self.count(|ending| *ending == Ending::Through),
            self.count(|ending| *ending == Ending::Undecided),
            self.count(|ending| matches!(ending, Ending::Error(_))),
        ]
    }

    /// The shots that have a verdict, with what it says of them up to their first failure and of what followed.
    pub fn verdicts(&self) -> impl Iterator<Item = (&Ended, &str, Option<&str>)> {
        let judged = self.shots.iter().filter(|ended| !matches!(ended.ending, Ending::Error(_)));
        judged.map(|ended| {
            let (before, after) = parts_of_verdict(&ended.verdict);
            (ended, before, after)
        })
    }

    /// The curve that is drawn: with Firth's correction, where it is asked for.
    pub fn drawn(&self, link: Link) -> Option<&Curve> {
        self.curves.iter().rev().find(|curve| curve.link == link)
    }
}
