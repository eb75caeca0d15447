//! The results of a series: how many shots ended how, the curves, and what follows from them.

use super::analysis::Analysis;
use super::curve::{Asked, Fate};
use super::lambert_jonas::{Degenerate, LambertJonas};
use super::shot::{Ended, Ending};
use toron_explicit_host::judgement::parts_of_verdict;

/// The series.
pub struct Series {
    pub shots: Vec<Ended>,
    /// Of those whose fate is known.
    pub told: Analysis,
    /// The curve of the residual speeds, or why there is none; nothing of too few.
    pub residual: Option<Result<LambertJonas, Degenerate>>,
}

impl Series {
    pub fn of(shots: Vec<Ended>, firth: bool, spread: Option<f64>) -> Series {
        let fates: Vec<Fate> = shots.iter().filter_map(Ended::fate).collect();
        let perforations: Vec<[f64; 2]> =
            shots.iter().filter_map(|ended| Some([ended.shot.speed, ended.residual()?])).collect();
        let told = Analysis::of(fates, &Asked { firth, spread, ..Asked::default() });
        Series { told, residual: LambertJonas::fit(&perforations), shots }
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
}
