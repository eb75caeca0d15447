//! The report of a scene: a table that a terminal has room for, warnings, and where the files are.

use std::path::Path;

use super::judgement::judge;
use super::outcome::Outcome;
use super::scene::{Case, LEFT_OUT, Scene, Striker};
use super::summary::outcome;
use super::weights;
use crate::losses::lost_between_fibres;
use crate::strength::scatter;
use toron_explicit_host::judgement::{verdict, warnings};
use toron_materials::material::fibre_wave::FibreWave;
use toron_materials::units::{SPEED, TIME, unit};
use toron_shared::numbers::{number, one_digit};
use toron_shared::text_table::{Column, NONE, files, of_cases, or_dash, shortened, table};

/// Columns of a terminal.
const WIDTH: usize = 100;
/// A case's name of more letters is cut in the table.
const LONGEST_NAME: usize = 30;

type Results<'a> = [(&'a Case, Outcome)];

/// Title, tables, warnings and the files in `output`.
pub fn report(scene: &Scene, results: &Results, output: &Path) -> String {
    let waves = waves(scene, results);
    let yarns: Vec<_> = results.iter().map(|(case, _)| (case.name.as_str(), case.zones.names())).collect();
    let weights: Vec<_> =
        results.iter().map(|(case, _)| (case.name.as_str(), weights::text(&scene.units, case))).collect();
    let findings: Vec<_> = results.iter().map(|(case, result)| (case, judge(&scene.units, case, result))).collect();
    let warnings = warnings(findings.iter().map(|(case, findings)| (case.name.as_str(), &findings[..])));
    let lost = results.iter().map(|(case, result)| (case.name.as_str(), result.last().energies.fibres));
    let parts = [
        table(struck(scene, results), WIDTH),
        table(driven(scene, results), WIDTH),
        of_cases("Yarns", &yarns, WIDTH)
            + &of_cases("Weights", &weights, WIDTH)
            + &lost_between_fibres(&scene.units, lost, WIDTH)
            + &strength(scene, results)
            + &wave_line(&waves),
        warnings,
        list_files(scene, results, output),
    ];
    let parts: Vec<String> = parts.into_iter().filter(|part| !part.is_empty()).collect();
    format!("{}\n\n{}", scene.title, parts.join("\n"))
}

/// The cases whose strength scatters.
fn strength(scene: &Scene, results: &Results) -> String {
    let weakest: Vec<_> = results.iter().map(|(case, result)| case.weakest(&scene.units, &result.mesh)).collect();
    let cases = results.iter().zip(&weakest);
    let cases = cases.map(|((case, _), weakest)| (case.name.as_str(), case.strength.as_ref(), weakest.as_deref()));
    scatter::report(cases, Some(LEFT_OUT), &scene.units, WIDTH)
}

/// The waves of all the cases' materials, each once.
fn waves(scene: &Scene, results: &Results) -> Vec<FibreWave> {
    let materials = results.iter().flat_map(|(case, _)| case.zones.materials());
    let mut waves: Vec<FibreWave> = Vec::new();
    for wave in materials.filter_map(|material| FibreWave::of(material, &scene.units)) {
        if !waves.contains(&wave) {
            waves.push(wave);
        }
    }
    waves
}

/// The waves' speeds, from the slowest to the fastest by each formula.
fn wave_line(waves: &[FibreWave]) -> String {
    let mut formulas: Vec<&str> = Vec::new();
    for wave in waves {
        if !formulas.contains(&wave.formula) {
            formulas.push(wave.formula);
        }
    }
    let speeds = |formula: &str| {
        let of_formula = waves.iter().filter(|wave| wave.formula == formula).map(|wave| wave.speed);
        let [slowest, fastest] = [of_formula.clone().fold(f64::INFINITY, f64::min), of_formula.fold(0.0, f64::max)];
        let [slowest, fastest] = [slowest, fastest].map(number);
        let range = if slowest == fastest { slowest } else { format!("{slowest} to {fastest}") };
        format!("{range} km/s = {formula}")
    };
    let parts: Vec<String> = formulas.into_iter().map(speeds).collect();
    if parts.is_empty() { String::new() } else { format!("Wave along the fibre: {}\n", parts.join(", ")) }
}

/// Builds a column of the cases that belong to a table.
fn column(cases: &[&(&Case, Outcome)], [above, below]: [&str; 2], entry: impl Fn(&Case, &Outcome) -> String) -> Column {
    let entries = cases.iter().map(|(case, result)| entry(case, result)).collect();
    Column { heading: [above.to_string(), below.to_string()], entries }
}

fn broken_at(_: &Case, result: &Outcome) -> String {
    or_dash(result.course.broken.map(|(time, _)| time), number)
}

/// The columns for what a projectile has struck, the most important first.
fn struck(scene: &Scene, results: &Results) -> Vec<Column> {
    let cases: Vec<_> = results.iter().filter(|(case, _)| case.striker != Striker::Driven).collect();
    let [time, speed] = [TIME, SPEED].map(|dimension| unit(&scene.units, dimension));
    let at_end = |result: &Outcome| result.residual_speed().is_none().then(|| result.last().speed);
    // Samples fall between the steps: the element that fails passes 1 unseen.
    let index = |result: &Outcome| match (result.failed, result.largest_index()) {
        (Some(_), _) => "1".to_string(),
        (None, index) if index > 0.0 => format!("{index:.3}"),
        _ => NONE.to_string(),
    };
    let mut columns = vec![
        column(&cases, ["case", ""], |case, _| shortened(&case.name, LONGEST_NAME)),
        column(&cases, ["how it ended", ""], |_, result| outcome(result).to_string()),
        verdicts(scene, &cases),
        column(&cases, ["broken at", &time], broken_at),
        column(&cases, ["residual", &speed], |_, result| or_dash(result.residual_speed(), number)),
        column(&cases, ["at end", &speed], |_, result| or_dash(at_end(result), number)),
        column(&cases, ["failure", "index"], |_, result| index(result)),
        column(&cases, ["elements", "deleted"], |_, result| result.last().deleted.to_string()),
    ];
    columns.extend(costs(&cases));
    columns
}

/// The columns for yarns whose middle is driven, beside Smith's theory.
fn driven(scene: &Scene, results: &Results) -> Vec<Column> {
    let cases: Vec<_> = results.iter().filter(|(case, _)| case.striker == Striker::Driven).collect();
    let speed = unit(&scene.units, SPEED);
    let wave = |case: &Case, result: &Outcome| result.front_speed(case.yarn.length, |sample| sample.own.longitudinal);
    let kink = |case: &Case, result: &Outcome| result.front_speed(case.yarn.length, |sample| sample.own.transverse);
    let percent = |strain: f64| number(100.0 * strain);
    let strain = |case: &Case, result: &Outcome| result.plateau(case.yarn.length);
    // Theory stands only beside what was measured.
    let beside = |measured: Option<f64>, theory: String| measured.map_or(NONE.to_string(), |_| theory);
    let waves = |result: &Outcome| format!("{}-{}", number(result.smith.fastest), number(result.smith.slowest));
    let mut columns = vec![
        column(&cases, ["case", ""], |case, _| shortened(&case.name, LONGEST_NAME)),
        verdicts(scene, &cases),
        column(&cases, ["longitudinal", &speed], |case, result| or_dash(wave(case, result), number)),
        column(&cases, ["theory", &speed], |case, result| beside(wave(case, result), waves(result))),
        column(&cases, ["strain", "%"], |case, result| or_dash(strain(case, result), percent)),
        column(&cases, ["theory", "%"], |case, result| beside(strain(case, result), percent(result.smith.strain))),
        column(&cases, ["transverse", &speed], |case, result| or_dash(kink(case, result), number)),
        column(&cases, ["theory", &speed], |case, result| beside(kink(case, result), number(result.smith.transverse))),
        column(&cases, ["broken at", &unit(&scene.units, TIME)], broken_at),
    ];
    columns.extend(costs(&cases));
    columns
}

fn verdicts(scene: &Scene, cases: &[&(&Case, Outcome)]) -> Column {
    column(cases, ["verdict", ""], |case, result| verdict(&judge(&scene.units, case, result)))
}

/// The error of the energy balance, and the time that a run took.
fn costs(cases: &[&(&Case, Outcome)]) -> [Column; 2] {
    [
        column(cases, ["energy", "off by"], |_, result| one_digit(result.balance.imbalance())),
        column(cases, ["run", "s"], |_, result| format!("{:.1}", result.cost.total().as_secs_f64())),
    ]
}

/// The names of what was written, with `NAME` for the cases.
fn list_files(scene: &Scene, results: &Results, output: &Path) -> String {
    let pictures = results.iter().any(|(_, result)| !result.snapshots.is_empty());
    let frames = results.iter().any(|(case, _)| case.plan.frames > 0);
    let written = [
        (true, "summary.csv", "a line for every case, with all that is known of it"),
        (scene.abscissa.is_some(), "residual-speed.svg, .png", "the cases side by side"),
        (true, "NAME.csv", "the history of case NAME"),
        (true, "NAME.svg, .png", "plots of it"),
        (pictures, "NAME-yarn-1.svg, .png, …", "the yarn at those times of pictures that the run came to"),
        (pictures, "NAME-strain-1.csv, …", "the strain along the yarn then"),
        (frames, "NAME.pvd, NAME-0000.vtu, …", "a series for ParaView"),
    ];
    files(output, &written)
}
