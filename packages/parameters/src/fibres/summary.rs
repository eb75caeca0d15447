//! The files of figures: a line for every case, a case's history, and the strain along its fibres at the instants of
//! its pictures.

use std::path::Path;

use super::model::{Striking, micro};
use super::outcome::Outcome;
use super::scene::{Case, Scene};
use toron::host::units::UnitSystem;
use toron::law::parameters::{Dimension, NUMBER};
use toron_explicit_host::struck::history::title;
use toron_materials::units::{ENERGY, FORCE, LENGTH, SPEED, TIME};
use toron_shared::error::Error;
use toron_shared::numbers::{number, one_digit};
use toron_shared::text_table::{or_dash, write_csv};

/// How a case ended, in the words of `toron impact` where it is the same.
pub fn outcome(result: &Outcome) -> &'static str {
    let flies_back = result.last().speed < 0.0;
    match (result.model.striker, result.first_break(), result.torn()) {
        (_, None, _) if flies_back => "flies back",
        (_, None, _) => "unbroken, not over",
        (Striking::Driven { .. }, Some(_), _) => "broken",
        (_, Some(_), _) if flies_back => "partly broken, flies back",
        (_, Some(_), None) => "breaking",
        (_, Some(_), Some(_)) => "penetrated",
    }
}

/// What a bead costs in a step, in ns.
pub fn cost(result: &Outcome) -> Option<f64> {
    result.seconds.map(|seconds| 1e9 * seconds / (result.model.all_beads() as f64 * result.model.steps as f64))
}

/// Titles and entries of a case's line.
fn cells(units: &UnitSystem, case: &Case, result: &Outcome) -> Vec<(&'static str, String)> {
    let (model, last) = (&result.model, result.last());
    let [length, time] = [LENGTH, TIME].map(|dimension| micro(units, dimension));
    let size = model.section.size.map(|size| number(size * case.fibre.diameter));
    let mut cells = vec![
        ("case", case.name.clone()),
        ("fibres", case.fibres.to_string()),
        ("spacing", number(length * model.spacing)),
        ("beads", model.all_beads().to_string()),
        ("section_width", size[0].clone()),
        ("section_height", size[1].clone()),
        ("fraction", format!("{:.4}", model.section.fraction())),
        ("friction", number(case.friction)),
        ("speed", number(case.speed)),
        ("outcome", outcome(result).to_string()),
        ("first_break_at", or_dash(result.first_break(), number)),
        ("breaks", last.breaks.to_string()),
    ];
    if let Striking::Cylinder { friction, .. } = model.striker {
        cells.extend([
            ("projectile_friction", number(friction)),
            ("torn_at", or_dash(result.torn(), number)),
            ("residual_speed", or_dash(result.residual_speed(), number)),
            ("speed_at_end", number(last.speed)),
        ]);
    } else if let Some(smith) = result.smith {
        cells.extend([
            ("strain_percent", or_dash(result.plateau(), |strain| number(100.0 * strain))),
            ("strain_theory", number(100.0 * smith.strain)),
            ("longitudinal_speed", or_dash(result.front_speed(|front| front.longitudinal), number)),
            ("longitudinal_theory", number(smith.fastest)),
            ("transverse_speed", or_dash(result.front_speed(|front| front.transverse), number)),
            ("transverse_theory", number(smith.transverse)),
        ]);
    }
    let most = |of: &dyn Fn(&super::outcome::Sample) -> f64| result.samples.iter().map(of).fold(0.0, f64::max);
    let [between_fibres, at_projectile] = result.frictions();
    cells.extend([
        ("elongation_max", number(most(&|s| s.elongation))),
        ("contact_max", number(most(&|s| s.contact))),
        ("fastest_bead", number(most(&|s| s.fastest))),
        ("friction_fibres", or_dash(between_fibres, number)),
        ("friction_projectile", or_dash(at_projectile, number)),
        ("imbalance", one_digit(result.imbalance())),
        ("step", number(time * model.step)),
        ("steps", model.steps.to_string()),
        ("seconds", or_dash(result.seconds, |seconds| format!("{seconds:.1}"))),
        ("ns_per_bead_step", or_dash(cost(result), |cost| format!("{cost:.0}"))),
    ]);
    cells
}

/// Writes the table as CSV.
///
/// # Errors
/// The file cannot be written.
pub fn write(file: &Path, scene: &Scene, results: &[(&Case, Outcome)]) -> Result<(), Error> {
    let lines: Vec<_> = results.iter().map(|(case, result)| cells(&scene.units, case, result)).collect();
    write_csv(file, &lines)
}

/// Writes the history of a case.
///
/// # Errors
/// The file cannot be written.
pub fn write_history(file: &Path, units: &UnitSystem, result: &Outcome) -> Result<(), Error> {
    let lines: Vec<_> = result
        .samples
        .iter()
        .map(|s| {
            let value =
                |name: &str, dimension: Dimension, value: f64| (title(name, dimension, units), value.to_string());
            let mut cells = vec![
                value("time", TIME, s.time),
                value("speed", SPEED, s.speed),
                value("travel", LENGTH, s.travel),
                value("force", FORCE, s.force),
                value("projectile_energy", ENERGY, s.projectile),
                value("kinetic_energy", ENERGY, s.kinetic),
                value("elongation_energy", ENERGY, s.elongation),
                value("contact_energy", ENERGY, s.contact),
                value("projectile_contact_energy", ENERGY, s.pressed),
                value("broken_energy", ENERGY, s.broken),
                value("friction_fibres", ENERGY, s.friction_fibres),
                value("friction_projectile", ENERGY, s.friction_projectile),
                value("external_work", ENERGY, s.external),
                value("fastest_bead", SPEED, s.fastest),
                value("strain_max", NUMBER, s.strain),
                value("breaks", NUMBER, s.breaks as f64),
            ];
            let widths = ["width_1", "width_2", "width_3", "width_4"].into_iter().zip(s.widths);
            let spreads = ["spread_1", "spread_2", "spread_3", "spread_4"].into_iter().zip(s.spreads);
            cells.extend(widths.chain(spreads).map(|(name, width)| value(name, LENGTH, width)));
            cells
        })
        .collect();
    write_csv(file, &lines)
}
