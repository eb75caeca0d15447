//! How `toron bench` times calls, and how it and `cargo bench` time two in turn.

use std::time::{Duration, Instant};

/// A timing of [`Best`] repeats the call so often that it lasts about this long.
const BATCH: Duration = Duration::from_millis(1);

/// The fastest of some timings of a call.
#[derive(Clone, Default)]
pub struct Best {
    /// How often a timing repeats the call; 0 before the first one.
    calls: usize,
    /// Of one call.
    pub seconds: Option<f64>,
}

impl Best {
    /// One more timing, after a call that is not timed, so that the caches hold this call's data and not another's.
    ///
    /// # Errors
    /// The call's.
    pub fn time<E>(&mut self, mut run: impl FnMut() -> Result<(), E>) -> Result<(), E> {
        run()?;
        if self.calls == 0 {
            self.calls = calls_that_last(BATCH, &mut run)?;
        }
        let seconds = timed(self.calls, &mut run)?;
        self.seconds = Some(self.seconds.map_or(seconds, |best| best.min(seconds)));
        Ok(())
    }
}

/// Seconds of one call, of so many.
///
/// # Errors
/// The call's.
pub fn timed<E>(calls: usize, run: &mut impl FnMut() -> Result<(), E>) -> Result<f64, E> {
    let start = Instant::now();
    for _ in 0..calls {
        run()?;
    }
    Ok(start.elapsed().as_secs_f64() / calls as f64)
}

/// How many calls last about so long, at least one.
///
/// # Errors
/// The call's.
pub fn calls_that_last<E>(duration: Duration, run: &mut impl FnMut() -> Result<(), E>) -> Result<usize, E> {
    let mut calls = 1;
    while timed(calls, run)? * (calls as f64) < duration.as_secs_f64() {
        calls *= 2;
    }
    Ok(calls)
}

/// Seconds of a call of either side, 0 and 1, in so many pairs, each side timed over its number of calls.
///
/// The sides are timed in turn: a clock that wanders slows both of a pair alike. A call that is not timed, before each
/// timing, leaves the caches as the call itself leaves them.
pub fn in_turn(mut call: impl FnMut(usize), calls: [usize; 2], pairs: usize) -> Vec<[f64; 2]> {
    let mut seconds = |side: usize| {
        call(side);
        let start = Instant::now();
        for _ in 0..calls[side] {
            call(side);
        }
        start.elapsed().as_secs_f64() / calls[side] as f64
    };
    (0..pairs).map(|_| [seconds(0), seconds(1)]).collect()
}
