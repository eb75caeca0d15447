//! The report of a scene: a table that a terminal has room for, and where the files are.

use std::path::Path;

use super::measure::Sample;
use super::run::Outcome;
use super::scene::{Case, Scene};
use super::summary::{Figures, ending, residual_speed};
use crate::common::text_table::{Column, NONE, files, or_dash, shortened, table};
use crate::common::units::{LENGTH, SPEED, TIME, number, unit};
use crate::common::warning;
use crate::explicit::lanes::largest;

/// Columns of a terminal.
const WIDTH: usize = 129;
/// A case's name of more letters is cut in the table.
const LONGEST_NAME: usize = 24;

type Results<'a> = [(&'a Case, Outcome, Figures)];

/// Title, table and the files in `output`.
pub fn report(scene: &Scene, results: &Results, output: &Path) -> String {
    let table = table(columns(scene, results), WIDTH);
    let warnings: String =
        results.iter().filter_map(|(case, outcome, figures)| hourglass_warning(case, outcome, figures)).collect();
    format!("{}\n\n{table}{}{warnings}\n{}", scene.title, sliding(results), list_files(results, output))
}

/// A warning where hourglass modes hold too much energy up to the first failure.
///
/// The blow excites them before there is much internal energy that they could be held against: a wave must have come to the rim.
fn hourglass_warning(case: &Case, outcome: &Outcome, figures: &Figures) -> Option<String> {
    let end = outcome.failed.unwrap_or(f64::INFINITY);
    figures.front_at_rim.filter(|&time| time <= end)?;
    let samples = || outcome.samples.iter().take_while(|sample| sample.time <= end);
    let most = |of: fn(&Sample) -> f64| samples().map(of).fold(0.0, largest);
    let share = most(|sample| sample.energies.hourglass) / most(|sample| sample.energies.internal);
    let remedy = format!("a finer mesh, a larger k_ld, or another hourglass than {}", case.control.hourglass);
    warning::hourglass(&case.name, share, &remedy)
}

/// The cases in whose sections nothing carries shear along the fibres.
fn sliding(results: &Results) -> String {
    let slides = |case: &&Case| case.zones.materials().iter().any(|material| material.property("k_ld") == Some(0.0));
    let cases: Vec<&str> = results.iter().map(|(case, ..)| *case).filter(slides).map(|case| &*case.name).collect();
    if cases.is_empty() {
        return String::new();
    }
    format!("k_ld = 0 in {}: the middle of a section slides along its yarn; 5 to 20 MPa hold it.\n", cases.join(", "))
}

/// The most important columns first.
fn columns(scene: &Scene, results: &Results) -> Vec<Column> {
    let [time, length, speed] = [TIME, LENGTH, SPEED].map(|dimension| unit(&scene.units, dimension));
    let column = |above: &str, below: &str, entry: &dyn Fn(&Case, &Outcome, &Figures) -> String| Column {
        heading: [above.to_string(), below.to_string()],
        entries: results.iter().map(|(case, outcome, figures)| entry(case, outcome, figures)).collect(),
    };
    // Either of the two speeds is there.
    let at_end = |outcome: &Outcome, figures: &Figures| {
        if residual_speed(outcome, figures).is_some() { NONE.to_string() } else { number(figures.last.speed) }
    };
    vec![
        column("case", "", &|case, _, _| shortened(&case.name, LONGEST_NAME)),
        column("how it ended", "", &|_, outcome, _| ending(outcome).to_string()),
        column("at", &time, &|_, _, figures| number(figures.last.time)),
        column("residual", &speed, &|_, outcome, figures| or_dash(residual_speed(outcome, figures), number)),
        column("at end", &speed, &|_, outcome, figures| at_end(outcome, figures)),
        column("deflection", &length, &|_, _, figures| number(figures.deflection.0)),
        column("rim at", &time, &|_, _, figures| or_dash(figures.front_at_rim, number)),
        column("failed at", &time, &|_, outcome, _| or_dash(outcome.failed, number)),
        column("torn", "yarns", &|_, _, figures| figures.last.torn.to_string()),
        column("energy", "off by", &|_, outcome, _| format!("{:.0e}", outcome.imbalance())),
        column("hourglass", "%", &|_, _, figures| format!("{:.2}", 100.0 * figures.hourglass)),
        column("elements", "deleted", &|_, _, figures| figures.last.deleted.to_string()),
        column("run", "s", &|_, outcome, _| format!("{:.1}", outcome.wall.as_secs_f64())),
        column("zone cycle", "ns", &|_, _, figures| format!("{:.0}", figures.ns_per_zone_cycle)),
    ]
}

/// The names of what was written, with `NAME` for the cases.
fn list_files(results: &Results, output: &Path) -> String {
    let pictures = results.iter().any(|(_, outcome, _)| !outcome.snapshots.is_empty());
    let frames = results.iter().any(|(case, ..)| case.frames > 0);
    let written = [
        (true, "summary.csv", "a line for every case, with all that is known of it"),
        (true, "NAME.csv", "the history of case NAME"),
        (true, "NAME.svg, .png", "plots of it"),
        (pictures, "NAME-panel-1.svg, .png, …", "the panel at those times of pictures that the run came to"),
        (frames, "NAME.pvd, NAME-0000.vtu, …", "a series for ParaView"),
    ];
    files(output, &written)
}
