//! The figures of each history, and how far it is from the first one.

use super::history::{Curve, History, Quantity};

/// The speed is the residual one if it has changed by less than this part of the first speed in the last part of the
/// run.
const STILL: f64 = 0.01;
const LAST: f64 = 0.1;

pub struct Figures {
    pub end: f64,
    /// At the start and at the end.
    pub speed: [Option<f64>; 2],
    /// The largest, until something fails: what is torn flies off.
    pub deflection: Option<f64>,
    /// What is left to a striker that has gone through.
    pub residual: Option<f64>,
    /// How far the speed is from that of the first history, at most, until something fails in one of both.
    pub apart: Option<f64>,
}

impl Figures {
    pub fn of(history: &History, first: &History) -> Figures {
        let speed = history.curve(Quantity::Speed);
        let apart = |speed: &Curve| {
            let failed = [history.failed, first.failed].into_iter().flatten().reduce(f64::min);
            let other = first.curve(Quantity::Speed).filter(|_| !std::ptr::eq(history, first))?;
            largest_before(&speed.with(other, |a, b| (a - b).abs()), failed)
        };
        Figures {
            end: history.end(),
            speed: [speed.and_then(|speed| speed.values.first().copied()), speed.and_then(Curve::last)],
            deflection: history.curve(Quantity::Deflection).and_then(|way| largest_before(way, history.failed)),
            residual: speed.filter(|_| history.failed.is_some()).and_then(residual),
            apart: speed.and_then(apart),
        }
    }
}

/// The largest value at times before this one, or at all.
fn largest_before(curve: &Curve, time: Option<f64>) -> Option<f64> {
    let known = curve.times.iter().zip(&curve.values).filter(|(sample, _)| time.is_none_or(|time| **sample < time));
    known.map(|(_, value)| *value).reduce(f64::max)
}

fn residual(speed: &Curve) -> Option<f64> {
    let (start, last) = (*speed.values.first()?, speed.last()?);
    let before = speed.at((1.0 - LAST) * *speed.times.last()?)?;
    (last > 0.0 && (before - last).abs() < STILL * start).then_some(last)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn history(speeds: [f64; 4], failed: Option<f64>) -> History {
        let mut history = History::new("toron", String::new());
        history.set(Quantity::Speed, Curve::new([0.0, 1.0, 2.0, 3.0].into_iter().zip(speeds)));
        history.failed = failed;
        history
    }

    #[test]
    fn a_residual_speed_is_one_that_lasts_after_a_failure() {
        let residual = |speeds, failed| Figures::of(&history(speeds, failed), &history(speeds, failed)).residual;
        assert_eq!(residual([9.0, 8.0, 7.0, 7.0], Some(1.5)), Some(7.0));
        assert_eq!(residual([9.0, 8.0, 7.0, 7.0], None), None);
        assert_eq!(residual([9.0, 8.0, 7.0, 5.0], Some(1.5)), None);
        assert_eq!(residual([9.0, 1.0, -2.0, -2.0], Some(1.5)), None);
    }

    #[test]
    fn histories_are_apart_until_something_fails() {
        let first = history([9.0, 8.0, 7.0, 7.0], Some(2.5));
        let apart = |speeds, failed| Figures::of(&history(speeds, failed), &first).apart;
        assert_eq!(apart([9.0, 8.5, 6.0, 3.0], Some(3.0)), Some(1.0));
        assert_eq!(apart([9.0, 8.5, 6.0, 3.0], Some(2.0)), Some(0.5));
        assert_eq!(Figures::of(&first, &first).apart, None);
    }
}
