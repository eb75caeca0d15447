//! `toron fabric`: from the file of a scene to its histories and table.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use indicatif::{ProgressBar, ProgressDrawTarget};

use super::measure::Sample;
use super::run::{self, Observer, Outcome};
use super::scene::{Case, Scene};
use super::summary::{self, Figures};
use super::{model, output, panel_picture, plot, report};
use crate::common::console::{print, print_error};
use crate::common::error::Error;
use crate::common::progress;
use crate::common::units::number;
use crate::common::vtk::Frames;
use crate::weave::model::Model;

const TICKS: u64 = 1000;

/// Runs the cases of a scene, one after another, and writes what came of them to the directory `output`. With `restart`, cases
/// go on from their checkpoints there.
///
/// # Errors
/// The input, a file that cannot be written, or a case that has no result.
pub fn run(path: &Path, output: &Path, restart: bool) -> Result<(), Error> {
    let build = run::build();
    let scene = Scene::read(path)?;
    if restart || scene.cases.iter().any(|case| case.checkpoints > 0) {
        build?;
    }
    if output.exists() && !output.is_dir() {
        return Err(Error::Input(format!("output is {}, a file; allowed: a directory, new or not", output.display())));
    }
    let place = |case: &Case| output.join(format!("{}.checkpoint", case.name));
    // Before hours are spent on the first one.
    let mut found = false;
    for case in &scene.cases {
        model::check(case)?;
        if let Some(bytes) = if restart { read(&place(case))? } else { None } {
            run::check(case, &bytes)?;
            found = true;
        }
    }
    if restart && !found {
        let allowed = "allowed: the directory of the run that was stopped";
        return Err(Error::Input(format!("no case has a checkpoint in {}; {allowed}", output.display())));
    }
    std::fs::create_dir_all(output).map_err(|error| file_error(output, &error))?;
    let (mut results, mut failures) = (Vec::new(), Vec::new());
    for case in &scene.cases {
        let panel = case.woven.model();
        let bar = progress::bar(TICKS, "{msg} {wide_bar} {percent} %, {eta} left", ProgressDrawTarget::stderr());
        let checkpoint = place(case);
        let bytes = if restart { read(&checkpoint)? } else { None };
        if restart {
            let how = if bytes.is_some() { "goes on from its checkpoint" } else { "has none, from the beginning" };
            print_error(&format!("case {}: {how}\n", case.name));
        }
        let frames = Frames::new(output, &case.name);
        let mut observer = CaseObserver { name: &case.name, bar: &bar, frames, checkpoint };
        let result = run::run(case, &panel, bytes.as_deref(), &mut observer);
        bar.finish_and_clear();
        let mut outcome = result?;
        write_case(&scene, case, &panel, &outcome, output)?;
        failures.extend(outcome.failure.take().map(|error| error.to_string()));
        let figures = Figures::of(&panel, &outcome);
        results.push((case, outcome, figures));
        // After each, for who stops the program in a later one.
        summary::write(&output.join("summary.csv"), &results)?;
    }
    print(&report::report(&scene, &results, output));
    if failures.is_empty() { Ok(()) } else { Err(Error::Evaluation(failures.join("\n"))) }
}

/// A checkpoint, if there is one.
fn read(file: &Path) -> Result<Option<Vec<u8>>, Error> {
    match std::fs::read(file) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(file_error(file, &error)),
    }
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

/// Moves the bar, and writes ParaView's files and the checkpoints as they come.
struct CaseObserver<'a> {
    name: &'a str,
    bar: &'a ProgressBar,
    frames: Frames,
    checkpoint: PathBuf,
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

    fn checkpoint(&mut self, bytes: &[u8]) -> Result<(), Error> {
        // In one go: who stops the program while it writes has the last checkpoint still.
        let new = self.checkpoint.with_extension("checkpoint-new");
        let written = std::fs::write(&new, bytes).and_then(|()| std::fs::rename(&new, &self.checkpoint));
        written.map_err(|error| file_error(&self.checkpoint, &error))
    }

    fn resumed(&mut self, frames: &[f64]) {
        self.frames.resume(frames);
    }
}
