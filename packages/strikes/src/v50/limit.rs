//! The limit of a scene in which nothing is chance: between the fastest stop and the slowest perforation, by bisection;
//! and whether the answer around it is monotone.

use std::sync::{Mutex, PoisonError};

use super::curve::{Fate, Mix, mix};
use super::records::Records;
use super::run::{FiringRange, stays};
use super::scene::Shot;
use super::shot::{Ended, Ending};
use toron_shared::error::Error;
use toron_shared::numbers::number;

/// How many tolerances from the limit it is probed, on either side.
const PROBES: [f64; 4] = [1.5, 3.0, 6.0, 12.0];

/// What was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// A stop and a perforation with nothing between them, within the tolerance.
    pub bracket: [f64; 2],
    /// The fastest stop and the slowest perforation of all shots, where the stop is faster.
    pub not_monotone: Option<[f64; 2]>,
    pub shots: usize,
}

/// How many shots it takes, as far as is known.
pub fn shots(range: f64, tolerance: f64) -> usize {
    2 + (range / tolerance).log2().ceil().max(0.0) as usize + 2 * PROBES.len()
}

/// Finds the limit; none where it was interrupted.
///
/// # Errors
/// The ends of the range have one fate; a shot is undecided, or ends with an error.
pub fn find(range: &FiringRange, records: &Mutex<Records>) -> Result<Option<Limit>, Error> {
    let mut search = Search { range, records, fates: Vec::new() };
    let [mut low, mut high] = range.scene.shots.speeds;
    let tolerance = range.scene.shots.tolerance;
    let Some([slow, fast]) = search.both([low, high])? else { return Ok(None) };
    if slow == fast {
        let (how, towards) = if slow { ("go through", "slower") } else { ("are stopped", "faster") };
        let speeds = format!("speeds is [{low}, {high}], at both of which shots {how}");
        return Err(Error::Evaluation(format!("{speeds}; allowed: a range that begins or ends {towards}")));
    }
    if slow {
        let message = format!(
            "a shot at {low} goes through and one at {high} is stopped: no limit between them can be found by bisection; allowed: speeds of \
             which the slowest is stopped and the fastest goes through"
        );
        return Err(Error::Evaluation(message));
    }
    while high - low > tolerance {
        let middle = 0.5 * (low + high);
        let Some(through) = search.one(middle)? else { return Ok(None) };
        if through {
            high = middle;
        } else {
            low = middle;
        }
    }
    let [least, most] = range.scene.shots.speeds;
    let probes = PROBES.iter().flat_map(|part| [low - part * tolerance, high + part * tolerance]);
    let probes: Vec<f64> = probes.filter(|speed| (least..=most).contains(speed)).collect();
    if search.all(&probes)?.is_none() {
        return Ok(None);
    }
    let not_monotone = match mix(&search.fates) {
        Mix::Mixed => {
            let of =
                |through: bool| search.fates.iter().filter(move |fate| fate.through == through).map(|fate| fate.speed);
            Some([of(false).fold(f64::NEG_INFINITY, f64::max), of(true).fold(f64::INFINITY, f64::min)])
        }
        _ => None,
    };
    Ok(Some(Limit { bracket: [low, high], not_monotone, shots: search.fates.len() }))
}

struct Search<'a> {
    range: &'a FiringRange<'a>,
    records: &'a Mutex<Records>,
    fates: Vec<Fate>,
}

impl Search<'_> {
    /// A shot that has been fired at this speed.
    fn fired(&self, speed: f64) -> Option<Ended> {
        let records = self.records.lock().unwrap_or_else(PoisonError::into_inner);
        records.shots.values().find(|ended| ended.shot.speed == speed).cloned()
    }

    /// The same, if it stays.
    fn known(&self, speed: f64) -> Option<Ended> {
        self.fired(speed).filter(|ended| stays(self.range.scene, ended))
    }

    /// A shot in place of the one that has been fired at this speed, or so many numbers ahead of the next one.
    fn shot(&self, ahead: usize, speed: f64) -> Shot {
        let again = self.fired(speed).map(|ended| ended.shot.number);
        let records = self.records.lock().unwrap_or_else(PoisonError::into_inner);
        let last = records.shots.keys().next_back().copied().unwrap_or(0);
        self.range.scene.plain_shot(again.unwrap_or(last + 1 + ahead), speed)
    }

    /// Whether a shot at this speed goes through; none where it was interrupted.
    fn one(&mut self, speed: f64) -> Result<Option<bool>, Error> {
        let known = self.known(speed);
        let ended = match known {
            Some(ended) => Some(ended),
            None => self.range.fire_one(&self.shot(0, speed), self.records)?,
        };
        ended.map(|ended| self.fate(&ended)).transpose()
    }

    fn both(&mut self, speeds: [f64; 2]) -> Result<Option<[bool; 2]>, Error> {
        let through = self.all(&speeds)?;
        Ok(through.map(|through| [through[0], through[1]]))
    }

    /// The same of several, which are fired side by side.
    fn all(&mut self, speeds: &[f64]) -> Result<Option<Vec<bool>>, Error> {
        let unknown: Vec<f64> = speeds.iter().copied().filter(|&speed| self.known(speed).is_none()).collect();
        let shots: Vec<Shot> = unknown.iter().enumerate().map(|(ahead, &speed)| self.shot(ahead, speed)).collect();
        self.range.fire_all(&shots, self.records)?;
        if self.range.is_interrupted() {
            return Ok(None);
        }
        let mut through = Vec::new();
        for &speed in speeds {
            let Some(ended) = self.fired(speed) else { return Ok(None) };
            through.push(self.fate(&ended)?);
        }
        Ok(Some(through))
    }

    fn fate(&mut self, ended: &Ended) -> Result<bool, Error> {
        let speed = number(ended.shot.speed);
        match (ended.fate(), &ended.ending) {
            (Some(fate), _) => {
                self.fates.push(fate);
                Ok(fate.through)
            }
            (None, Ending::Error(message)) => Err(Error::Evaluation(format!("the shot at {speed}: {message}"))),
            (None, _) => {
                let time = number(ended.time);
                let message = format!(
                    "the shot at {speed} is undecided at time {time}; allowed: a later end, or a larger extension"
                );
                Err(Error::Evaluation(message))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::v50::report;
    use crate::v50::scene::{Scene, YARN};
    use toron_shared::interrupt::Interrupt;

    /// Of a table with a shot for every speed that is looked at, so that none is fired: what is found, and said, where
    /// these go through.
    fn found(through: impl Fn(f64) -> bool) -> (Limit, String) {
        let text = YARN.replace("speeds = [20.0, 300.0]", "speeds = [20.0, 276.0]\ntolerance = 16.0");
        let scene = Scene::parse("yarn.toml", &text, None).expect("a scene");
        let mut records = Records::new(&scene, Path::new("limit.csv"));
        records.shots = (1..=33)
            .map(|number| {
                let shot = scene.plain_shot(number, 12.0 + 8.0 * number as f64);
                let ending = if through(shot.speed) { Ending::Through } else { Ending::Stopped };
                let verdict = "sound".to_string();
                (number, Ended { ending, speed_at_end: 1.0, time: 0.1, verdict, seconds: 1.0, ..Ended::of(shot) })
            })
            .collect();
        let range = FiringRange::new(&scene, 1, 0, Interrupt::default());
        let limit = find(&range, &Mutex::new(records)).expect("a limit").expect("nothing interrupts");
        let said = report::limit(&scene, &limit);
        (limit, said.split_whitespace().collect::<Vec<_>>().join(" "))
    }

    #[test]
    fn a_limit_is_bracketed_and_an_answer_that_is_not_monotone_is_seen() {
        let (limit, said) = found(|speed| speed >= 100.0);
        assert_eq!((limit.bracket, limit.not_monotone), ([84.0, 100.0], None));
        assert!(
            said.contains("stopped at 84.00 mm/ms, through at 100.0 mm/ms") && !said.contains("monotone"),
            "{said}"
        );
        // A probe below goes through, or one above is stopped.
        let (limit, said) = found(|speed| speed >= 100.0 || speed == 60.0);
        assert_eq!((limit.bracket, limit.not_monotone), ([84.0, 100.0], Some([84.0, 60.0])));
        let wanted =
            "The answer is not monotone: a shot at 60.00 mm/ms goes through, and one at 84.00 mm/ms is stopped";
        assert!(said.contains(wanted), "{said}");
        let (limit, _) = found(|speed| speed >= 100.0 && speed != 196.0);
        assert_eq!(limit.not_monotone, Some([196.0, 100.0]));
    }
}
