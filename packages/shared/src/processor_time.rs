//! How long processors have computed for this process, or for one of its threads.

use std::time::Duration;

/// The processor time of all threads of this process since it started. Where the system does not tell, 0.
#[cfg(unix)]
pub fn processor_time() -> Duration {
    time_of(libc::CLOCK_PROCESS_CPUTIME_ID)
}

/// The processor time of the thread that asks, since it started. Where the system does not tell, 0.
#[cfg(unix)]
pub fn thread_time() -> Duration {
    time_of(libc::CLOCK_THREAD_CPUTIME_ID)
}

#[cfg(unix)]
fn time_of(clock: libc::clockid_t) -> Duration {
    let mut time = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: the time is written to a structure of its own.
    if unsafe { libc::clock_gettime(clock, &raw mut time) } != 0 {
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

/// Other systems are not asked.
#[cfg(not(unix))]
pub fn thread_time() -> Duration {
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

    #[test]
    fn a_thread_is_not_charged_for_another_one() {
        let before = thread_time();
        let other = std::thread::spawn(|| {
            while thread_time() < Duration::from_millis(60) {
                std::hint::spin_loop();
            }
        });
        other.join().expect("it ends");
        assert!(thread_time() - before < Duration::from_millis(40));
    }
}
