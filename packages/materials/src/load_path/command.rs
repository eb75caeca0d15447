//! `toron run`: from the file of a load path to its table, plot and summary.

use std::path::PathBuf;
use std::sync::Once;
use std::time::{Duration, Instant};

use clap::Args;
use indicatif::ProgressDrawTarget;

use super::path::{LoadPath, Point};
use super::run::{self, End, History};
use super::{plot, report, table};
use crate::material::laws::Laws;
use toron_shared::console::{is_quiet, print};
use toron_shared::error::Error;
use toron_shared::progress;
use toron_shared::run_directory::{RunDirectory, Writes};
use toron_shared::text_table::value_line;

const DEMONSTRATION: &str = include_str!("../../assets/compaction-then-tension.toml");
/// A run that is over before this needs no progress bar.
const PROGRESS_DELAY: Duration = Duration::from_secs(1);

#[derive(Args)]
pub struct Arguments {
    /// The load path, a TOML file (`toron init path` writes one); - is the standard input. Without it, a demonstration:
    /// compaction, then tension to failure.
    pub path: Option<PathBuf>,
    /// Where the table and the plot go.
    #[arg(short, long, default_value = "toron-out")]
    pub output: PathBuf,
}

/// Runs the load path of a file with materials of these laws, or the demonstration of the library's, and writes what
/// came of it to a directory.
///
/// # Errors
/// The input, a file that cannot be written, or the evaluation of a point; what was computed before is written all the
/// same.
pub fn run(laws: Laws, Arguments { path, output }: &Arguments) -> Result<(), Error> {
    let file = path.as_deref();
    let path = match file {
        Some(path) => LoadPath::read(laws, path)?,
        None => LoadPath::parse(Laws::Toron, "demonstration", DEMONSTRATION)?,
    };
    let names =
        path.points.iter().flat_map(|point| ["increments", "plot"].map(|of| format!("{of}{}", behind(&path, point))));
    let files = file.into_iter().collect();
    let writes = Writes { command: "run", files, names: names.collect(), ..Writes::default() };
    let locked = RunDirectory::lock(output, writes)?;
    let histories = run_with_progress(&path);
    let is_written = histories.iter().any(|history| !history.increments.is_empty());
    let _directory = is_written.then(|| locked.claim()).transpose()?;
    print(&format!("{}\n", path.title));
    for history in &histories {
        let name = behind(&path, history.point);
        let mut text = report::summary(&path, history);
        if path.points.len() > 1 {
            text = format!("\n{}\n{text}", history.point.name);
        }
        print(&text);
        if history.increments.is_empty() {
            continue;
        }
        let [table, svg, png] = ["increments{}.csv", "plot{}.svg", "plot{}.png"].map(|file| file.replace("{}", &name));
        table::write(&output.join(&table), &path, history)?;
        plot::write(&output.join(&svg), &output.join(&png), &path, history)?;
        let files = format!("{table}, {svg}, {png} in {}", output.display());
        print(&value_line("written", report::NAMES, &files));
    }
    first_failure(&histories)
}

/// What stands behind the names of a point's files, where there are several.
fn behind(path: &LoadPath, point: &Point) -> String {
    if path.points.len() > 1 { format!("-{}", point.name) } else { String::new() }
}

/// Runs the path; a progress bar shows up where that takes long and someone is looking.
fn run_with_progress(path: &LoadPath) -> Vec<History<'_>> {
    let template = "{wide_bar} {pos}/{len} increments, {eta} left";
    let bar = progress::bar(path.increments() as u64, template, ProgressDrawTarget::hidden());
    let (start, shown) = (Instant::now(), Once::new());
    let histories = run::run(path, &|| {
        bar.inc(1);
        if !is_quiet() && !shown.is_completed() && start.elapsed() > PROGRESS_DELAY {
            shown.call_once(|| bar.set_draw_target(ProgressDrawTarget::stderr()));
        }
    });
    bar.finish_and_clear();
    histories
}

fn first_failure(histories: &[History]) -> Result<(), Error> {
    for history in histories {
        if let End::Failed(reason) = &history.end {
            return Err(Error::Evaluation(format!("point {}: {reason}", history.point.name)));
        }
    }
    Ok(())
}
