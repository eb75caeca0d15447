//! Progress on the standard error: a bar in a terminal, a line now and then elsewhere.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::console::is_quiet;

/// Elsewhere a line comes after this part of the way, and after this time.
const PART: f64 = 0.1;
const TIME: Duration = Duration::from_secs(60);

/// A bar of this length. `template` says what stands beside it; `target` is where it is drawn, unless the program is to
/// be quiet.
pub fn bar(length: u64, template: &str, target: ProgressDrawTarget) -> ProgressBar {
    let target = if is_quiet() { ProgressDrawTarget::hidden() } else { target };
    let bar = ProgressBar::with_draw_target(Some(length), target);
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar
}

/// When the next line is due.
#[derive(Debug)]
pub struct Lines {
    last: (f64, Instant),
}

impl Lines {
    /// From this part of the way on.
    pub fn from(part: f64) -> Lines {
        Lines { last: (part, Instant::now()) }
    }

    /// Whether a line is due at this part of the way.
    pub fn are_due(&mut self, part: f64) -> bool {
        let (last, time) = self.last;
        let tenth = |part: f64| (part / PART).floor();
        let due = tenth(part) > tenth(last) || time.elapsed() >= TIME;
        if due {
            self.last = (part, Instant::now());
        }
        due
    }
}
