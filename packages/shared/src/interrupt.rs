//! Ctrl-C, or a request to end: a run that can ends by itself then, and one that comes a second later ends it at once.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use super::error::Error;

/// The shell's code of a program that Ctrl-C has ended.
const EXIT_CODE: i32 = 130;

/// For so long a second signal says what the first one has said: `timeout` sends one to the program and one to its
/// group.
const SAME: Duration = Duration::from_secs(1);
/// How often the first one is looked for.
const LOOK: Duration = Duration::from_millis(100);

/// Whether the program has been asked to end.
#[derive(Clone, Debug, Default)]
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// From now on Ctrl-C does not end the program, unless it comes again later.
    ///
    /// # Errors
    /// The system refuses.
    pub fn listen() -> Result<Interrupt, Error> {
        let (interrupt, again) = (Interrupt::default(), Arc::new(AtomicBool::new(false)));
        for signal in [SIGINT, SIGTERM] {
            let ends = flag::register_conditional_shutdown(signal, EXIT_CODE, again.clone());
            let marks = ends.and_then(|_| flag::register(signal, interrupt.0.clone()));
            marks.map_err(|error| Error::Input(format!("the signal {signal} cannot be listened for: {error}")))?;
        }
        let watched = interrupt.clone();
        thread::spawn(move || {
            while !watched.is_asked() {
                thread::sleep(LOOK);
            }
            thread::sleep(SAME);
            again.store(true, Ordering::Relaxed);
        });
        Ok(interrupt)
    }

    pub fn is_asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
