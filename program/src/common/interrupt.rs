//! Ctrl-C, or a request to end: a run that can ends by itself then, and a second one ends it at once.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use super::error::Error;

/// The shell's code of a program that Ctrl-C has ended.
const EXIT_CODE: i32 = 130;

/// Whether the program has been asked to end.
#[derive(Clone, Debug, Default)]
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// From now on Ctrl-C does not end the program, unless it comes twice.
    ///
    /// # Errors
    /// The system refuses.
    pub fn listen() -> Result<Interrupt, Error> {
        let interrupt = Interrupt::default();
        for signal in [SIGINT, SIGTERM] {
            // In this order: what ends the program sees the mark of an earlier signal only.
            let ends = flag::register_conditional_shutdown(signal, EXIT_CODE, interrupt.0.clone());
            let marks = ends.and_then(|_| flag::register(signal, interrupt.0.clone()));
            marks.map_err(|error| Error::Input(format!("the signal {signal} cannot be listened for: {error}")))?;
        }
        Ok(interrupt)
    }

    pub fn is_asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
