//! `toron impact`: from the file of a scene to its histories, pictures and table.

use std::path::Path;

use indicatif::{ProgressBar, ProgressDrawTarget};
use rayon::prelude::*;

use super::outcome::Outcome;
use super::run::{self, Observer};
use super::scene::{Case, Scene};
use super::summary::STRAINS;
use super::{plot, report, summary, yarn_picture};
use crate::common::console::{print, print_error};
use crate::common::error::Error;
use crate::common::progress;
use crate::common::run_directory::RunDirectory;
use crate::common::vtk::Frames;

const SUMMARY: &str = "summary.csv";
/// Between a case's name and the number of a picture.
const PICTURES: &str = "-yarn-";
/// The files of the plot of all cases.
const COMPARISON: [&str; 2] = ["svg", "png"];
/// Ticks of the progress bar for each case.
const TICKS: u64 = 1000;

/// Runs the cases of a scene and writes what came of them to the directory `output`.
///
/// A case that has no result keeps no other from having one.
///
/// # Errors
/// The input, a file that cannot be written, or the cases that have no result.
pub fn run(path: &Path, output: &Path) -> Result<(), Error> {
    let scene = Scene::read(path)?;
    let directory = RunDirectory::open(output)?;
    let comparisons = COMPARISON.map(|ending| format!("residual-speed.{ending}"));
    let mut removed = 0;
    for name in comparisons.iter().map(String::as_str).chain([SUMMARY]) {
        removed += usize::from(directory.remove(name)?);
    }
    for case in &scene.cases {
        removed += directory.remove_files_of(&case.name, PICTURES, 0)?;
        removed += directory.remove_series(&case.name, STRAINS)?;
    }
    print_error(&directory.removal(removed));
    let length = TICKS * scene.cases.len() as u64;
    let bar = progress::bar(length, "{wide_bar} {percent} %, {eta} left", ProgressDrawTarget::stderr());
    let runs: Vec<_> = scene.cases.par_iter().map(|case| run_case(&scene, case, output, &bar)).collect();
    bar.finish_and_clear();
    let (mut results, mut errors) = (Vec::new(), Vec::new());
    for (case, run) in scene.cases.iter().zip(runs) {
        match run {
            Ok(outcome) => results.push((case, outcome)),
            Err(error) => errors.push(error),
        }
    }
    if !results.is_empty() {
        write_comparison(&scene, &results, output)?;
    }
    combine(errors)
}

/// What the cases that have a result have in common.
fn write_comparison(scene: &Scene, results: &[(&Case, Outcome)], output: &Path) -> Result<(), Error> {
    if let Some(abscissa) = scene.abscissa {
        let [svg, png] = COMPARISON.map(|ending| output.join(format!("residual-speed.{ending}")));
        plot::write_comparison(&svg, &png, scene, abscissa, results)?;
    }
    summary::write(&output.join(SUMMARY), scene, results)?;
    print(&report::report(scene, results, output));
    Ok(())
}

/// The errors of the cases that have no result as one.
fn combine(errors: Vec<Error>) -> Result<(), Error> {
    let messages: Vec<String> = errors.iter().map(Error::to_string).collect();
    match errors.first() {
        None => Ok(()),
        Some(Error::Input(_)) => Err(Error::Input(messages.join("\n"))),
        Some(Error::Evaluation(_)) => Err(Error::Evaluation(messages.join("\n"))),
    }
}

/// Runs a case and writes its files.
fn run_case(scene: &Scene, case: &Case, output: &Path, bar: &ProgressBar) -> Result<Outcome, Error> {
    let mut observer = CaseObserver { bar, ticks: 0, frames: Frames::new(output, &case.name) };
    let result = run::run(case, &mut observer);
    // A case that ends early has not used its ticks.
    observer.progress(1.0);
    let result = result?;
    write_case(scene, case, &result, output)?;
    Ok(result)
}

/// Moves the bar, and writes ParaView's files as they come.
struct CaseObserver<'a> {
    bar: &'a ProgressBar,
    ticks: u64,
    frames: Frames,
}

impl Observer for CaseObserver<'_> {
    fn progress(&mut self, fraction: f64) {
        let ticks = (fraction.clamp(0.0, 1.0) * TICKS as f64) as u64;
        self.bar.inc(ticks - self.ticks);
        self.ticks = ticks;
    }

    fn frame(&mut self, time: f64, text: &str) -> Result<(), Error> {
        self.frames.write(time, text)
    }
}

fn write_case(scene: &Scene, case: &Case, result: &Outcome, output: &Path) -> Result<(), Error> {
    let file = |ending: &str| output.join(format!("{}{ending}", case.name));
    summary::write_history(&file(".csv"), result)?;
    plot::write_history(&file(".svg"), &file(".png"), scene, case, result)?;
    for (number, snapshot) in result.snapshots.iter().enumerate() {
        let [svg, png] = ["svg", "png"].map(|ending| file(&format!("{PICTURES}{}.{ending}", number + 1)));
        yarn_picture::write(&svg, &png, scene, case, result, snapshot)?;
        let strains = file(&format!("{}{}.csv", summary::STRAINS, number + 1));
        summary::write_strains(&strains, result.strains(snapshot))?;
    }
    Ok(())
}
