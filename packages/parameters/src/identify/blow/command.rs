//! `toron fit` from a blow: from its file to a preset, a table, a plot and a summary.

use std::io::Write;
use std::path::Path;

use super::file::BlowJob;
use super::runs::Runs;
use super::{report, search};
use crate::identify::command::{lock, require_new};
use crate::identify::report::line;
use toron_shared::console::print;
use toron_shared::error::Error;
use toron_shared::kept_file;

/// What the fit writes beside its preset; the runs are kept for when it is begun again.
const HISTORY: &str = "blow.csv";
const PLOT: [&str; 2] = ["blow.svg", "blow.png"];
const RUNS: &str = "blow-runs.csv";

/// Finds the properties and writes what came of it to the directory `output`. Runs of the same fit that are there are
/// not made again.
///
/// # Errors
/// The input, a run that fails, a history that does not tell the properties, or a file that cannot be written.
pub fn run(job: &BlowJob, path: &Path, output: &Path, scene: Option<&Path>) -> Result<(), Error> {
    if scene.is_some() {
        return Err(Error::Input(
            "--scene with [blow], which has a scene of its own; allowed: one of them".to_string(),
        ));
    }
    let preset = format!("{}.toml", job.name);
    let files = [preset.as_str(), HISTORY, PLOT[0], PLOT[1], RUNS].map(String::from);
    require_new(&job.inputs, output, &files)?;
    let _directory = lock(path, output, &files, false)?.claim()?;
    let runs = Runs::open(job, &output.join(RUNS))?;
    let solution = search::minimise(&runs)?;
    print(&report::report(job, &solution, runs.count()));
    let text = report::preset(job, &solution);
    kept_file::write(&output.join(&preset), |file| file.write_all(text.as_bytes()))?;
    report::write_history(&output.join(HISTORY), job, &solution)?;
    let [svg, png] = PLOT.map(|name| output.join(name));
    report::write_plot([&svg, &png], job, &solution)?;
    print(&line("written", &format!("{} in {}", files.join(", "), output.display())));
    Ok(())
}
