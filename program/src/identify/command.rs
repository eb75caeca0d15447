//! `toron fit`: from the file of a fit to its preset, tables, plot and summary.

use std::path::Path;

use super::file::Job;
use super::{output, plot, region, report};
use crate::common::console::print;
use crate::common::error::Error;

/// Fits the parameters to the data of a file and writes what came of it to the directory `output`.
///
/// # Errors
/// The input, data that do not suffice, or a file that cannot be written.
pub fn run(path: &Path, output: &Path) -> Result<(), Error> {
    let job = Job::read(path)?;
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
    print(&report::line("written", &format!("{} in {}", written.join(", "), output.display())));
    Ok(())
}
