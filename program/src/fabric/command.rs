//! `toron fabric`: from the file of a scene to its histories and table.

use std::path::Path;

use indicatif::{ProgressBar, ProgressDrawTarget};

use super::measure::Sample;
use super::run::{self, Observer, Outcome};
use super::scene::{Case, Scene};
use super::summary::{self, Figures};
use super::{output, panel_picture, plot, report};
use crate::common::console::print;
use crate::common::error::Error;
use crate::common::progress;
use crate::common::units::number;
use crate::common::vtk::Frames;
use crate::weave::model::Model;

const TICKS: u64 = 1000;

/// Runs the cases of a scene, one after another, and writes what came of them to the directory `output`.
///
/// # Errors
/// The input, a file that cannot be written, or a case that has no result.
pub fn run(path: &Path, output: &Path) -> Result<(), Error> {
    let scene = Scene::read(path)?;
    if output.exists() && !output.is_dir() {
        return Err(Error::Input(format!("output is {}, a file; allowed: a directory, new or not", output.display())));
    }
    std::fs::create_dir_all(output).map_err(|error| file_error(output, &error))?;
    let panel = scene.woven.model();
    let (mut results, mut failures) = (Vec::new(), Vec::new());
    for case in &scene.cases {
        let bar = progress::bar(TICKS, "{msg} {wide_bar} {percent} %, {eta} left", ProgressDrawTarget::stderr());
        let mut observer = CaseObserver { name: &case.name, bar: &bar, frames: Frames::new(output, &case.name) };
        let result = run::run(&scene, case, &panel, &mut observer);
        bar.finish_and_clear();
        let mut outcome = result?;
        write_case(&scene, case, &panel, &outcome, output)?;
        failures.extend(outcome.failure.take().map(|error| error.to_string()));
        let figures = Figures::of(&panel, &outcome);
        results.push((case, outcome, figures));
    }
    summary::write(&output.join("summary.csv"), &results)?;
    print(&report::report(&scene, &results, output));
    if failures.is_empty() { Ok(()) } else { Err(Error::Evaluation(failures.join("\n"))) }
}

fn write_case(scene: &Scene, case: &Case, panel: &Model, outcome: &Outcome, output: &Path) -> Result<(), Error> {
    let file = |ending: &str| output.join(format!("{}{ending}", case.name));
    let history = file(".csv");
    std::fs::write(&history, output::history(outcome)).map_err(|error| file_error(&history, &error))?;
    plot::write(&file(".svg"), &file(".png"), scene, case, outcome)?;
    for (number, snapshot) in outcome.snapshots.iter().enumerate() {
        let [svg, png] = ["svg", "png"].map(|ending| file(&format!("-panel-{}.{ending}", number + 1)));
        panel_picture::write(&svg, &png, scene, case, panel, snapshot)?;
    }
    Ok(())
}

fn file_error(file: &Path, error: &dyn std::fmt::Display) -> Error {
    Error::Input(format!("{}: {error}", file.display()))
}

/// Moves the bar, and writes ParaView's files as they come.
struct CaseObserver<'a> {
    name: &'a str,
    bar: &'a ProgressBar,
    frames: Frames,
}

impl Observer for CaseObserver<'_> {
    fn progress(&mut self, fraction: f64, sample: &Sample, imbalance: f64) {
        self.bar.set_position((fraction * TICKS as f64) as u64);
        let speed = number(sample.speed);
        self.bar.set_message(format!("{}: speed {speed}, energy off by {imbalance:.0e}", self.name));
    }

    fn frame(&mut self, time: f64, text: &str) -> Result<(), Error> {
        self.frames.write(time, text)
    }
}
