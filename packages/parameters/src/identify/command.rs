//! `toron fit`: from the file of a fit to its preset, tables, plot and summary.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::blow::file::BlowJob;
use super::file::Job;
use super::strength::file::StrengthJob;
use super::{blow, output, plot, region, report, sensitivity, strength};
use toron_shared::console::print;
use toron_shared::error::Error;
use toron_shared::kept_file;
use toron_shared::run_directory::{Locked, RunDirectory, Writes};
use toron_strikes::impact::scene::Scene;

/// Fits the parameters to the data of a file and writes what came of it to the directory `output`; with a scene, also
/// what it makes of them.
///
/// # Errors
/// The input, data that do not suffice, a file that cannot be written, or a scene that cannot be run.
pub fn run(path: &Path, output: &Path, scene: Option<&Path>) -> Result<(), Error> {
    if let Some(job) = BlowJob::read(path)? {
        return blow::command::run(&job, path, output, scene);
    }
    if let Some(strengths) = StrengthJob::read(path)? {
        return strength::command::run(&strengths, path, output, scene);
    }
    let job = Job::read(path)?;
    let scene = scene.map(Scene::read).transpose()?;
    let fit = job.fit()?;
    let files = names(&job);
    require_new(&job.inputs, output, &files)?;
    let directory = lock(path, output, &files, scene.is_some())?.claim()?;
    // Of an earlier run; those of this one come at the end.
    PLOTS.into_iter().chain([SENSITIVITY]).try_for_each(|name| directory.remove(name).map(drop))?;
    let file = output.join(&files[0]);
    kept_file::write(&file, |file| file.write_all(output::preset(&job, &fit).as_bytes()))?;
    output::write_parameters(&output.join(PARAMETERS), &job, &fit)?;
    for (set, fitted) in job.problem.sets.iter().zip(&fit.sets) {
        output::write_set(&output.join(of_set(&set.name)), set, fitted)?;
    }
    print(&report::report(&job, &fit));
    if plots(&job) {
        // The region takes a while along load paths.
        let border = region::border(&job.problem, &fit);
        let [svg, png] = PLOTS.map(|name| output.join(name));
        plot::write(&svg, &png, &job, &fit, border.as_deref())?;
    }
    print(&report::line("written", &format!("{} in {}", files.join(", "), output.display())));
    if let Some(scene) = scene {
        let trials = sensitivity::trials(&job, &fit, &scene)?;
        sensitivity::write(&output.join(SENSITIVITY), &scene, &trials)?;
        print(&sensitivity::report(&job, &fit, &scene, &trials));
        print(&report::line("written", SENSITIVITY));
    }
    Ok(())
}

const PARAMETERS: &str = "parameters.csv";
const PLOTS: [&str; 2] = ["fit.svg", "fit.png"];
const SENSITIVITY: &str = "worth.csv";

fn of_set(name: &str) -> String {
    format!("fit-{name}.csv")
}

/// The names of the files that are written, the preset's first.
fn names(job: &Job) -> Vec<String> {
    let mut names = vec![format!("{}.toml", job.preset.name), PARAMETERS.to_string()];
    names.extend(job.problem.sets.iter().map(|set| of_set(&set.name)));
    if plots(job) {
        names.extend(PLOTS.map(String::from));
    }
    names
}

/// Whether there is anything to draw.
fn plots(job: &Job) -> bool {
    !job.problem.sets.is_empty() || !job.friction.points.is_empty()
}

/// The directory of the files, where those of another command or of other data are not overwritten.
pub(super) fn lock(data: &Path, output: &Path, files: &[String], is_struck: bool) -> Result<Locked, Error> {
    let sensitivity = is_struck.then_some(SENSITIVITY);
    let stem = |file: &str| file.rsplit_once('.').map_or(file, |(stem, _)| stem).to_string();
    let names = files.iter().map(String::as_str).chain(sensitivity).map(stem).collect();
    RunDirectory::lock(output, Writes { command: "fit", files: vec![data], names, ..Writes::default() })
}

/// No file that was read is overwritten.
pub(super) fn require_new(inputs: &[PathBuf], output: &Path, files: &[String]) -> Result<(), Error> {
    let real = |path: &Path| std::fs::canonicalize(path).ok();
    for file in files.iter().map(String::as_str).chain([SENSITIVITY]).map(|name| output.join(name)) {
        if real(&file).is_some_and(|file| inputs.iter().any(|input| real(input).as_ref() == Some(&file))) {
            let message =
                format!("{} would be overwritten, and is read; allowed: another -o, or other names", file.display());
            return Err(Error::Input(message));
        }
    }
    Ok(())
}
