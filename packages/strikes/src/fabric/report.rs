//! The report of a scene: a table that a terminal has room for, and where the files are.

use std::path::Path;

use super::run::Outcome;
use super::scene::{Case, Scene};
use super::summary::{Figures, ending, residual_speed, speed_is};
use crate::losses::lost_between_fibres;
use crate::residual::SpeedIs;
use crate::strength::scatter;
use toron_explicit_host::judgement::{verdict, warnings};
use toron_materials::units::{LENGTH, SPEED, TIME, unit};
use toron_shared::numbers::{number, one_digit};
use toron_shared::text_table::{Column, NONE, files, of_cases, or_dash, shortened, table};

/// Columns of a terminal.
const WIDTH: usize = 129;
/// A case's name of more letters is cut in the table.
const LONGEST_NAME: usize = 24;

type Results<'a> = [(&'a Case, Outcome, Figures)];

/// Title, table and the files in `output`.
pub fn report(scene: &Scene, results: &Results, output: &Path) -> String {
    let table = table(columns(scene, results), WIDTH);
    let warnings = warnings(results.iter().map(|(case, _, figures)| (case.name.as_str(), &figures.findings[..])));
    let yarns: Vec<_> = results.iter().map(|(case, ..)| (case.name.as_str(), case.material_names())).collect();
    let weights: Vec<_> =
        results.iter().map(|(case, _, figures)| (case.name.as_str(), figures.weights.clone())).collect();
    let yarns = of_cases("Yarns", &yarns, WIDTH) + &of_cases("Weights", &weights, WIDTH);
    let lost = results.iter().map(|(case, _, figures)| (case.name.as_str(), figures.last.energies.fibres));
    let strength = lost_between_fibres(&scene.units, lost, WIDTH) + &strength(scene, results);
    format!("{}\n\n{table}\n{yarns}{strength}{warnings}\n{}", scene.title, list_files(results, output))
}

/// The cases whose strength scatters.
fn strength(scene: &Scene, results: &Results) -> String {
    let left_out = results.iter().filter(|(case, ..)| case.strength.is_some()).find_map(|(case, ..)| case.left_out());
    let cases = results
        .iter()
        .map(|(case, _, figures)| (case.name.as_str(), case.strength.as_ref(), figures.weakest.as_deref()));
    scatter::report(cases, left_out, &scene.units, WIDTH)
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
    let mut columns = vec![
        column("case", "", &|case, _, _| shortened(&case.name, LONGEST_NAME)),
        column("how it ended", "", &|case, outcome, _| ending(case, outcome)),
        column("verdict", "", &|_, _, figures| verdict(&figures.findings)),
        column("at", &time, &|_, _, figures| number(figures.last.time)),
        column("residual", &speed, &|_, outcome, figures| or_dash(residual_speed(outcome, figures), number)),
        column("at end", &speed, &|_, outcome, figures| at_end(outcome, figures)),
        column("deflection", &length, &|_, _, figures| number(figures.deflection.0)),
        column("energy", "off by", &|_, outcome, _| one_digit(outcome.balance.imbalance())),
        column("hourglass", "%", &|_, _, figures| format!("{:.2}", 100.0 * figures.measures.hourglass)),
        column("Jacobian", "scaled", &|_, _, figures| format!("{:.2}", figures.measures.least_scaled_jacobian)),
        column("W_ld", "%", &|_, _, figures| format!("{:.1}", 100.0 * figures.measures.shear)),
        column("rim at", &time, &|_, _, figures| or_dash(figures.front_at_rim, number)),
        column("failed at", &time, &|_, outcome, _| or_dash(outcome.failed, number)),
        column("torn", "yarns", &|_, _, figures| figures.last.own.torn.to_string()),
        column("elements", "deleted", &|_, _, figures| figures.last.deleted.to_string()),
        column("run", "s", &|_, outcome, _| format!("{:.1}", outcome.wall.as_secs_f64())),
    ];
    if results.iter().any(|(_, outcome, _)| outcome.decision.is_some()) {
        let speed_is = |case: &Case, outcome: &Outcome| speed_is(case, outcome).map_or(NONE, SpeedIs::name);
        columns.insert(6, column("the residual", "speed is", &|case, outcome, _| speed_is(case, outcome).to_string()));
    }
    columns
}

/// The names of what was written, with `NAME` for the cases.
fn list_files(results: &Results, output: &Path) -> String {
    let pictures = results.iter().any(|(_, outcome, _)| !outcome.snapshots.is_empty());
    let frames = results.iter().any(|(case, ..)| case.plan.frames > 0);
    let written = [
        (true, "summary.csv", "a line for every case, with all that is known of it"),
        (true, "NAME.csv", "the history of case NAME"),
        (true, "NAME-steps.csv", "how long the steps of its elements were"),
        (true, "NAME.svg, .png", "plots of it"),
        (pictures, "NAME-panel-1.svg, .png, …", "the panel at those times of pictures that the run came to"),
        (frames, "NAME.pvd, NAME-0000.vtu, …", "a series for ParaView"),
    ];
    files(output, &written)
}
