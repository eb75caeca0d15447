//! `toron impact`: from the file of a scene to its histories, pictures and table.

use std::path::Path;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use rayon::prelude::*;

use super::run::{self, Outcome};
use super::scene::{Case, Scene};
use super::{plot, summary, yarn_picture};
use crate::driver::explicit::vtu;
use crate::driver::{Error, print};

/// Ticks of the progress bar for each case.
const TICKS: u64 = 1000;

/// Runs the cases of a scene and writes what came of them to the directory `output`.
///
/// # Errors
/// The input, or a file that cannot be written.
pub fn run(path: &Path, output: &Path) -> Result<(), Error> {
    let scene = Scene::read(path)?;
    std::fs::create_dir_all(output).map_err(|error| Error::Input(format!("{}: {error}", output.display())))?;
    let bar = ProgressBar::with_draw_target(Some(TICKS * scene.cases.len() as u64), ProgressDrawTarget::stderr());
    if let Ok(style) = ProgressStyle::with_template("{wide_bar} {percent} %, {eta} left") {
        bar.set_style(style);
    }
    let results = scene.cases.par_iter().map(|case| run_case(case, &bar));
    let results: Vec<Outcome> = results.collect::<Result<_, _>>()?;
    bar.finish_and_clear();
    for (case, result) in scene.cases.iter().zip(&results) {
        write_case(&scene, case, result, output)?;
    }
    if let Some(abscissa) = scene.abscissa {
        let [svg, png] = ["residual-speed.svg", "residual-speed.png"].map(|name| output.join(name));
        plot::write_comparison(&svg, &png, &scene, abscissa, &results)?;
    }
    summary::write(&output.join("summary.csv"), &scene, &results)?;
    print(&format!("{}\n\n{}", scene.title, summary::table(&scene, &results)));
    Ok(())
}

fn run_case(case: &Case, bar: &ProgressBar) -> Result<Outcome, Error> {
    let done = std::cell::Cell::new(0);
    run::run(case, &|fraction| {
        let ticks = (fraction.clamp(0.0, 1.0) * TICKS as f64) as u64;
        bar.inc(ticks - done.replace(ticks));
    })
}

fn write_case(scene: &Scene, case: &Case, result: &Outcome, output: &Path) -> Result<(), Error> {
    let file = |ending: &str| output.join(format!("{}{ending}", case.name));
    summary::write_history(&file(".csv"), result)?;
    plot::write_history(&file(".svg"), &file(".png"), scene, case, result)?;
    for (number, snapshot) in result.snapshots.iter().enumerate() {
        let [svg, png] = ["svg", "png"].map(|ending| file(&format!("-yarn-{}.{ending}", number + 1)));
        yarn_picture::write(&svg, &png, scene, case, result, snapshot)?;
    }
    let mut collection = Vec::new();
    for (number, (time, text)) in result.frames.iter().enumerate() {
        let name = format!("{}-{number:04}.vtu", case.name);
        write_text(&output.join(&name), text)?;
        collection.push((*time, name));
    }
    if !collection.is_empty() {
        write_text(&file(".pvd"), &vtu::collection(&collection))?;
    }
    Ok(())
}

fn write_text(file: &Path, text: &str) -> Result<(), Error> {
    std::fs::write(file, text).map_err(|error| Error::Input(format!("{}: {error}", file.display())))
}
