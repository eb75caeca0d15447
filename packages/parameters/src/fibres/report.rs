//! The report of a scene: tables that a terminal has room for, and where the files are.

use std::path::Path;

use super::model::{Model, Striking};
use super::outcome::{Fronts, Outcome};
use super::pressed;
use super::scene::{Case, Scene, Walls};
use super::summary::{cost, outcome};
use toron_materials::material::linear_density::LinearDensity;
use toron_materials::units::{ENERGY, SPEED, TIME, unit};
use toron_shared::numbers::{number, one_digit};
use toron_shared::text_table::{Column, files, or_dash, shortened, table};

/// Columns of a terminal.
const WIDTH: usize = 100;
/// A case's name of more letters is cut in the table.
const LONGEST_NAME: usize = 24;

type Results<'a> = [(&'a Case, Outcome)];

/// Title, tables and the files in `output`.
pub fn report(scene: &Scene, results: &Results, pressed: &pressed::output::Results, output: &Path) -> String {
    let models = results.iter().map(|(case, result)| (*case, &result.model));
    let models: Vec<_> = models.chain(pressed.iter().map(|(case, result)| (*case, &result.model))).collect();
    let parts = [
        table(struck(scene, results), WIDTH),
        table(driven(scene, results), WIDTH),
        table(pressed::output::columns(scene, pressed), WIDTH),
        sections(scene, &models),
        list_files(scene, results, pressed, output),
    ];
    let parts: Vec<String> = parts.into_iter().filter(|part| !part.is_empty()).collect();
    format!("{}\n\n{}", scene.title, parts.join("\n"))
}

fn is_driven(result: &Outcome) -> bool {
    matches!(result.model.striker, Striking::Driven { .. })
}

/// Builds a column of the cases that belong to a table.
pub fn column<T>(cases: &[&(&Case, T)], [above, below]: [&str; 2], entry: impl Fn(&Case, &T) -> String) -> Column {
    let entries = cases.iter().map(|(case, result)| entry(case, result)).collect();
    Column { heading: [above.to_string(), below.to_string()], entries }
}

/// The columns for what a projectile has struck, the most important first.
fn struck(scene: &Scene, results: &Results) -> Vec<Column> {
    let cases: Vec<_> = results.iter().filter(|(_, result)| !is_driven(result)).collect();
    let [time, speed, energy] = [TIME, SPEED, ENERGY].map(|dimension| unit(&scene.units, dimension));
    let at_end = |result: &Outcome| result.residual_speed().is_none().then(|| result.last().speed);
    let mut columns = vec![
        column(&cases, ["case", ""], |case, _| shortened(&case.name, LONGEST_NAME)),
        column(&cases, ["how it", "ended"], |_, result| outcome(result).to_string()),
        column(&cases, ["first", &format!("break, {time}")], |_, result| or_dash(result.first_break(), number)),
        column(&cases, ["torn at", &time], |_, result| or_dash(result.torn(), number)),
        column(&cases, ["residual", &speed], |_, result| or_dash(result.residual_speed(), number)),
        column(&cases, ["at end", &speed], |_, result| or_dash(at_end(result), number)),
        column(&cases, ["friction,", &energy], |_, result| {
            or_dash(result.frictions().into_iter().flatten().reduce(|one, other| one + other), number)
        }),
    ];
    columns.extend(costs(&cases));
    columns
}

/// The columns for fibres whose middle is driven, beside Smith's theory.
fn driven(scene: &Scene, results: &Results) -> Vec<Column> {
    let cases: Vec<_> = results.iter().filter(|(_, result)| is_driven(result)).collect();
    let speed = unit(&scene.units, SPEED);
    let front = |result: &Outcome, place: fn(&Fronts) -> f64| or_dash(result.front_speed(place), number);
    let percent = |strain: f64| number(100.0 * strain);
    let theory = |result: &Outcome, of: fn(&toron_materials::material::smith::Smith) -> f64| {
        result.smith.filter(|_| result.plateau().is_some()).map(|smith| of(&smith))
    };
    let mut columns = vec![
        column(&cases, ["case", ""], |case, _| shortened(&case.name, LONGEST_NAME)),
        column(&cases, ["strain", "%"], |_, result| or_dash(result.plateau(), percent)),
        column(&cases, ["theory", "%"], |_, result| or_dash(theory(result, |smith| smith.strain), percent)),
        column(&cases, ["longitudinal", &speed], |_, result| front(result, |front| front.longitudinal)),
        column(&cases, ["theory", &speed], |_, result| or_dash(theory(result, |smith| smith.fastest), number)),
        column(&cases, ["transverse", &speed], |_, result| front(result, |front| front.transverse)),
        column(&cases, ["theory", &speed], |_, result| or_dash(theory(result, |smith| smith.transverse), number)),
        column(&cases, ["first", &format!("break, {}", unit(&scene.units, TIME))], |_, result| {
            or_dash(result.first_break(), number)
        }),
    ];
    columns.extend(costs(&cases));
    columns
}

/// The error of the energy balance, and what the run took.
fn costs(cases: &[&(&Case, Outcome)]) -> [Column; 3] {
    [
        column(cases, ["energy", "off by"], |_, result| one_digit(result.imbalance())),
        column(cases, ["run", "s"], |_, result| or_dash(result.seconds, |seconds| format!("{seconds:.1}"))),
        column(cases, ["a bead and", "step, ns"], |_, result| or_dash(cost(result), |cost| format!("{cost:.0}"))),
    ]
}

/// The sections, each once.
fn sections(scene: &Scene, models: &[(&Case, &Model)]) -> String {
    let length = scene.units.names()[0];
    let mut lines: Vec<String> = Vec::new();
    for (case, model) in models {
        let [width, height] = model.section.size.map(|size| number(size * case.fibre.diameter));
        let beads = model.all_beads();
        let (area, fraction) = (case.fibres as f64 * case.fibre.area(), model.section.fraction());
        let yarn = LinearDensity::of(area / fraction, case.fibre.density * fraction, &scene.units);
        let line = format!(
            "{} fibres, {beads} beads; the section is {width} × {height} {length}, filled to {fraction:.3}: {}\n",
            case.fibres,
            yarn.text()
        );
        if !lines.contains(&line) {
            lines.push(line);
        }
    }
    lines.concat()
}

/// The names of what was written, with `NAME` for the cases.
fn list_files(scene: &Scene, results: &Results, pressed: &pressed::output::Results, output: &Path) -> String {
    let strains = results.iter().any(|(_, result)| !result.frames.is_empty());
    let pictures = strains || pressed.iter().any(|(_, result)| !result.frames.is_empty());
    let tests = pressed.iter().filter(|(_, result)| result.pressing.walls == Walls::Biaxial).count();
    let written = [
        (!results.is_empty(), "summary.csv", "a line for every case that was struck, with all that is known of it"),
        (!pressed.is_empty(), "pressed.csv", "a line for every section that was pressed: friction and dilatancy too"),
        (tests > 1, "pressed.svg, .png", "biaxial tests over the friction between their fibres"),
        (true, "NAME.csv", "the history of case NAME"),
        (true, "NAME.svg, .png", "plots of it"),
        (pictures, "NAME-fibres-1.svg, .png, …", "the fibres at the times of pictures"),
        (strains, "NAME-strain.svg, .png", "the strain along the yarn then"),
        (strains, "NAME-strain-1.csv, …", "the same as tables"),
        (true, "NAME/", "what LAMMPS has read and written"),
        (pressed::output::fit_file(scene, pressed).is_some(), "fit.toml", "what toron fit reads"),
    ];
    files(output, &written)
}
