//! `toron fabric`: from the file of a scene to its histories and table.

use std::fmt::Write;
use std::path::Path;

use indicatif::{ProgressBar, ProgressDrawTarget};

use super::measure::Sample;
use super::output;
use super::run::{self, Observer, Outcome};
use super::scene::{Case, Scene};
use crate::common::console::print;
use crate::common::error::Error;
use crate::common::progress;
use crate::common::units::number;

const TICKS: u64 = 1000;

/// Runs the cases of a scene, one after another, and writes what came of them to the directory `output`.
///
/// # Errors
/// The input, a file that cannot be written, or a case that has no result.
pub fn run(path: &Path, output: &Path) -> Result<(), Error> {
    let scene = Scene::read(path)?;
    let file_error = |file: &Path, error: &dyn std::fmt::Display| Error::Input(format!("{}: {error}", file.display()));
    if output.exists() && !output.is_dir() {
        return Err(Error::Input(format!("output is {}, a file; allowed: a directory, new or not", output.display())));
    }
    std::fs::create_dir_all(output).map_err(|error| file_error(output, &error))?;
    let panel = scene.woven.model();
    let mut text = format!("{}\n\n", scene.title);
    let mut failures = Vec::new();
    for case in &scene.cases {
        let bar = progress::bar(TICKS, "{msg} {wide_bar} {percent} %, {eta} left", ProgressDrawTarget::stderr());
        let mut observer = Bar { name: &case.name, bar: &bar };
        let result = run::run(&scene, case, &panel, &mut observer);
        bar.finish_and_clear();
        let outcome = result?;
        let file = output.join(format!("{}.csv", case.name));
        std::fs::write(&file, output::history(&outcome)).map_err(|error| file_error(&file, &error))?;
        let _ = writeln!(text, "{}", line(case, &outcome));
        failures.extend(outcome.failure.map(|error| error.to_string()));
    }
    print(&text);
    if failures.is_empty() { Ok(()) } else { Err(Error::Evaluation(failures.join("\n"))) }
}

struct Bar<'a> {
    name: &'a str,
    bar: &'a ProgressBar,
}

impl Observer for Bar<'_> {
    fn progress(&mut self, fraction: f64, sample: &Sample, imbalance: f64) {
        self.bar.set_position((fraction * TICKS as f64) as u64);
        let speed = number(sample.speed);
        self.bar.set_message(format!("{}: speed {speed}, energy off by {imbalance:.0e}", self.name));
    }
}

fn line(case: &Case, outcome: &Outcome) -> String {
    let last = outcome.samples.last().copied().unwrap_or_default();
    let deflection = outcome.samples.iter().map(|sample| sample.deflection).fold(0.0, f64::max);
    let cycles = outcome.cost.steps as f64 * outcome.elements as f64;
    let seconds = |time: std::time::Duration| time.as_secs_f64();
    let total = seconds(outcome.cost.total());
    format!(
        "{}: {:?} at {}, speed {}, deflection {}, torn yarns {}, deleted {}, energy off by {:.1e}, hourglass {:.2e} of {:.2e}, \
         tilt {:.1}, {} steps, {} elements, {:.0} ns a zone cycle (contact {:.0} %, law {:.0} %), {} searches, {:.1} s",
        case.name,
        outcome.end,
        number(last.time),
        number(last.speed),
        number(deflection),
        last.torn,
        last.deleted,
        outcome.imbalance(),
        last.energies.hourglass,
        last.energies.total(),
        last.tilt,
        outcome.cost.steps,
        outcome.elements,
        1e9 * total / cycles,
        100.0 * seconds(outcome.cost.contact) / total,
        100.0 * seconds(outcome.cost.law) / total,
        outcome.searches,
        seconds(outcome.wall),
    )
}
