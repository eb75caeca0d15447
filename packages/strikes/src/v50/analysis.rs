//! What shots with a known fate tell: the curves, and the means that test houses print.

use super::curve::{Asked, Curve, Fate, Mix, mix};
use super::link::Link;
use super::test_houses::{self, Mean};

/// As many stops and as many perforations as test houses take: of four, six and ten shots.
const EACH: [usize; 3] = [2, 3, 5];

/// Shots, and what follows from them.
#[derive(Clone, Debug)]
pub struct Analysis {
    pub asked: Asked,
    pub fates: Vec<Fate>,
    pub mix: Mix,
    /// The links that were asked for, and with Firth's correction, where it is asked for.
    pub curves: Vec<Curve>,
    pub means: Vec<Mean>,
    /// With a spread: the one of the most shots within it.
    pub within: Option<(f64, Option<Mean>)>,
}

impl Analysis {
    pub fn of(fates: Vec<Fate>, asked: &Asked) -> Analysis {
        let corrections: &[bool] = if asked.firth { &[false, true] } else { &[false] };
        let kinds = corrections.iter().flat_map(|&firth| asked.links.iter().map(move |&link| (link, firth)));
        Analysis {
            mix: mix(&fates),
            curves: kinds.filter_map(|(link, firth)| Curve::fit_as(asked, &fates, link, firth)).collect(),
            means: EACH.iter().filter_map(|&each| test_houses::mean(&fates, each)).collect(),
            within: asked.spread.map(|spread| (spread, test_houses::widest(&fates, spread))),
            fates,
            asked: asked.clone(),
        }
    }

    /// The curve that is drawn: with Firth's correction, where it is asked for and the fates mix.
    pub fn drawn(&self, link: Link) -> Option<&Curve> {
        let separated = matches!(self.mix, Mix::Separated(_));
        self.curves.iter().rev().find(|curve| curve.link == link && !(separated && curve.firth))
    }

    /// The slowest and the fastest speed.
    pub fn range(&self) -> [f64; 2] {
        let speeds = self.fates.iter().map(|fate| fate.speed);
        speeds.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], speed| [low.min(speed), high.max(speed)])
    }

    /// Shots that went through, or were stopped.
    pub fn count(&self, through: bool) -> usize {
        self.fates.iter().filter(|fate| fate.through == through).count()
    }
}
