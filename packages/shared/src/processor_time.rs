//! How long processors have computed for this process.

use std::time::Duration;

/// The processor time of all threads of this process since it started. Where the system does not tell, 0.
#[cfg(unix)]
pub fn processor_time() -> Duration {
    let mut time = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: the time is written to a structure of its own.
    if unsafe { libc::clock_gettime(libc::CLOCK_PROCESS_CPUTIME_ID, &raw mut time) } != 0 {
        return Duration::ZERO;
    }
    let seconds = u64::try_from(time.tv_sec).unwrap_or(0);
    Duration::new(seconds, u32::try_from(time.tv_nsec).unwrap_or(0))
}

/// Other systems are not asked.
#[cfg(not(unix))]
pub fn processor_time() -> Duration {
    Duration::ZERO
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::time::Instant;

    #[test]
    fn it_counts_what_is_computed_and_not_what_is_waited_for() {
        let (begun, before) = (Instant::now(), processor_time());
        std::thread::sleep(Duration::from_millis(200));
        let waited = processor_time() - before;
        // Other tests of this process may run meanwhile, on other processors.
        let others = std::thread::available_parallelism().map_or(1, usize::from) as u32;
        assert!(waited <= others * begun.elapsed(), "{waited:?}");
        let mut last = processor_time();
        let computed = loop {
            let now = processor_time();
            assert!(now >= last);
            last = now;
            if now - before > waited + Duration::from_millis(50) {
                break now - before - waited;
            }
        };
        assert!(computed >= Duration::from_millis(50));
    }
}
