//! How long a run will take, from its first steps.

use std::fmt;
use std::time::{Duration, Instant};

/// So long a run is measured before it is said how long it takes; a shorter one is over by then.
const MEASURED: Duration = Duration::from_secs(1);
/// And for so many steps: some measure, search for contact or write, and one alone tells nothing.
const LEAST_STEPS: u64 = 32;
const MINUTE: f64 = 60.0;
const HOUR: f64 = 60.0 * MINUTE;

/// Where a run has begun.
pub struct Pace {
    begun: Instant,
    time: f64,
    steps: u64,
}

/// How long the whole run takes if it goes on as it has begun, and what that rests on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    pub elements: usize,
    /// From the beginning to the end, and how many of them were measured.
    pub steps: f64,
    pub measured: u64,
    pub seconds: f64,
}

impl Pace {
    pub fn new(time: f64, steps: u64) -> Pace {
        Pace { begun: Instant::now(), time, steps }
    }

    /// The estimate at a time and after so many steps, as soon as there is one.
    pub fn estimate(&self, [time, end]: [f64; 2], steps: u64, elements: usize) -> Option<Estimate> {
        let (elapsed, measured) = (self.begun.elapsed(), steps - self.steps);
        if elapsed < MEASURED || measured < LEAST_STEPS || time <= self.time {
            return None;
        }
        let part = (end - self.time) / (time - self.time);
        Some(Estimate { elements, steps: part * measured as f64, measured, seconds: part * elapsed.as_secs_f64() })
    }
}

impl fmt::Display for Estimate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Estimate { elements, steps, measured, seconds } = *self;
        let nanoseconds = 1e9 * seconds / (elements as f64 * steps);
        write!(
            f,
            "about {} up to end: {elements} elements × {steps:.0} steps × {nanoseconds:.0} ns, as in the first {measured} steps",
            duration(seconds)
        )
    }
}

/// In the unit that makes it a number of some digits.
pub fn duration(seconds: f64) -> String {
    if seconds < 2.0 * MINUTE {
        format!("{seconds:.0} s")
    } else if seconds < 2.0 * HOUR {
        format!("{:.0} min", seconds / MINUTE)
    } else {
        format!("{:.1} h", seconds / HOUR)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_estimate_is_that_of_a_run_which_goes_on_as_it_has_begun() {
        let begun = Instant::now().checked_sub(Duration::from_secs(2)).expect("an instant");
        let pace = Pace { begun, time: 0.1, steps: 50 };
        let estimate = pace.estimate([0.2, 10.1], 250, 1000).expect("two seconds have passed");
        assert!((estimate.steps, estimate.measured) == (20_000.0, 200) && (estimate.seconds - 200.0).abs() < 1.0);
        let text = estimate.to_string();
        assert!(text.starts_with("about 3 min up to end: 1000 elements × 20000 steps × 10"), "{text}");
        assert!(text.ends_with(" ns, as in the first 200 steps"), "{text}");
        assert_eq!(Pace::new(0.0, 0).estimate([0.2, 10.1], 250, 1000), None);
        assert_eq!(pace.estimate([0.2, 10.1], 55, 1000), None, "after five steps, however long they took");
        assert_eq!([30.0, 119.0, 600.0, 36_000.0].map(duration), ["30 s", "119 s", "10 min", "10.0 h"]);
    }
}
