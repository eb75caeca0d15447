//! `toron fit` of strengths: to the terminal, a table of the figures, and the tables that scenes take.

use std::io::Write;
use std::path::Path;

use super::file::{Set, StrengthJob};
use super::report;
use crate::identify::command::{lock, require_new};
use crate::identify::report::line;
use toron_shared::console::print;
use toron_shared::error::Error;
use toron_shared::kept_file;
use toron_shared::text_table::write_csv;

const FIGURES: &str = "strengths.csv";

/// Writes what came of the sets, which were read from `path`, to the directory `output`.
///
/// # Errors
/// A scene, or a file that cannot be written.
pub fn run(job: &StrengthJob, path: &Path, output: &Path, scene: Option<&Path>) -> Result<(), Error> {
    if scene.is_some() {
        let message = "--scene with [[strength]]; allowed: with the law's properties. A scene takes a strength as [scene.strength]";
        return Err(Error::Input(message.to_string()));
    }
    let table = |set: &Set| format!("{}.toml", set.name);
    let files: Vec<String> = std::iter::once(FIGURES.to_string()).chain(job.sets.iter().map(table)).collect();
    require_new(&job.inputs, output, &files)?;
    let _directory = lock(path, output, &files, false)?.claim()?;
    print(&report::report(job));
    for set in &job.sets {
        kept_file::write(&output.join(table(set)), |file| file.write_all(report::table(job, set).as_bytes()))?;
    }
    write_csv(&output.join(FIGURES), &report::lines(job))?;
    print(&line("written", &format!("{} in {}", files.join(", "), output.display())));
    Ok(())
}
