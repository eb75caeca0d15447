//! `toron fit`: from the file of a fit to its preset, tables, plot and summary.

use std::path::Path;

use super::file::Job;
use super::{output, plot, region, report, worth};
use crate::common::console::print;
use crate::common::error::Error;
use crate::impact::scene::Scene;

/// Fits the parameters to the data of a file and writes what came of it to the directory `output`; with a scene, also what it
/// makes of them.
///
/// # Errors
/// The input, data that do not suffice, a file that cannot be written, or a scene that cannot be run.
pub fn run(path: &Path, output: &Path, scene: Option<&Path>) -> Result<(), Error> {
    let job = Job::read(path)?;
    let scene = scene.map(Scene::read).transpose()?;
    let fit = job.problem.fit()?;
    std::fs::create_dir_all(output).map_err(|error| Error::Input(format!("{}: {error}", output.display())))?;
    let preset = format!("{}.toml", job.preset.name);
    let mut written = vec![preset.clone(), "parameters.csv".to_string()];
    let file = output.join(&preset);
    std::fs::write(&file, output::preset(&job, &fit))
        .map_err(|error| Error::Input(format!("{}: {error}", file.display())))?;
    output::write_parameters(&output.join("parameters.csv"), &job, &fit)?;
    for (set, fitted) in job.problem.sets.iter().zip(&fit.sets) {
        let name = format!("fit-{}.csv", set.name);
        output::write_set(&output.join(&name), set, fitted)?;
        written.push(name);
    }
    if !job.problem.sets.is_empty() {
        let border = region::border(&job.problem, &fit);
        plot::write(&output.join("fit.svg"), &output.join("fit.png"), &job, &fit, border.as_deref())?;
        written.extend(["fit.svg".to_string(), "fit.png".to_string()]);
    }
    print(&report::report(&job, &fit));
    if let Some(scene) = scene {
        let trials = worth::trials(&job, &fit, &scene)?;
        worth::write(&output.join("worth.csv"), &scene, &trials)?;
        written.push("worth.csv".to_string());
        print(&worth::report(&scene, &trials));
    }
    print(&report::line("written", &format!("{} in {}", written.join(", "), output.display())));
    Ok(())
}
