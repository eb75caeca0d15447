//! The files of figures: a line for every case, how it ended, with what speed, energies and cost; and a case's history.

use std::path::Path;

use super::judgement::judge;
use super::outcome::{End, Outcome};
use super::scene::{Case, Outputs, Precision, Scene, Striker, Zones};
use crate::common::error::Error;
use crate::common::text_table::{or_dash, write_csv};
use crate::common::units::number;
use crate::explicit::judgement::verdict;
use crate::material::model;
use crate::material::smith::Smith;
use toron::host::units::UnitSystem;

/// Between a case's name and the number of a table of strains.
pub const STRAINS: &str = "-strain-";

/// Writes mean and largest strain along the yarn: their place in the middle of a layer at rest, and they.
///
/// # Errors
/// The file cannot be written.
pub fn write_strains(file: &Path, layers: impl Iterator<Item = (f64, [f64; 2])>) -> Result<(), Error> {
    let titles = ["place", "strain_mean", "strain_max"];
    let line = |(place, [mean, most]): (f64, [f64; 2])| {
        titles.into_iter().zip([place, mean, most].map(|value| value.to_string())).collect()
    };
    write_csv(file, &layers.map(line).collect::<Vec<_>>())
}

/// How a case ended, in words.
pub fn outcome(result: &Outcome) -> &'static str {
    match (result.end, result.broken) {
        (End::Stopped, None) => "not penetrated",
        (End::Stopped, Some(_)) => "broken, stopped",
        (End::Left, _) => "penetrated",
        (End::Time, Some(_)) => "broken, not over",
        (End::Time, None) => "unbroken, not over",
    }
}

/// The names of a case's materials, from mid-span outwards.
pub fn yarns(case: &Case) -> String {
    let to = match case.zones {
        Zones::One(_) => String::new(),
        Zones::Two(_, length) => number(length),
    };
    model::names(case.zones.materials(), &to)
}

fn law(case: &Case) -> String {
    let mut name = match &case.zones {
        Zones::One(material) => material.law_name().to_string(),
        Zones::Two(_, length) => {
            let layers = case.yarn.layers_to(*length) as f64;
            format!("hyperelastic to {}", number(layers / case.yarn.layers as f64 * case.yarn.length))
        }
    };
    if case.precision == Precision::F32 {
        name.push_str(", f32");
    }
    if case.outputs == Outputs::Stress {
        name.push_str(", stress only");
    }
    name
}

/// Titles and entries of a case's line.
fn cells(units: &UnitSystem, case: &Case, result: &Outcome) -> Vec<(&'static str, String)> {
    let length = case.yarn.length;
    let mut cells = vec![
        ("case", case.name.clone()),
        ("law", law(case)),
        ("material", yarns(case)),
        ("verdict", verdict(&judge(units, case, result))),
        ("elements", result.mesh.elements.len().to_string()),
        ("speed", number(case.speed)),
        ("longitudinal_speed", or_dash(result.front_speed(length, |sample| sample.longitudinal), number)),
    ];
    match case.striker {
        Striker::Cylinder { cylinder, .. } => strike_cells(case, result, cylinder.stiffness, &mut cells),
        Striker::Driven => smith_cells(length, result, &mut cells),
    }
    cells.extend([
        ("imbalance", format!("{:.0e}", result.balance.imbalance())),
        ("steps", result.cost.steps.to_string()),
        ("seconds", decimals(result.cost.total().as_secs_f64(), 2)),
        ("ns_per_zone_cycle", decimals(result.cost.total().as_nanos() as f64 / result.zone_cycles(), 1)),
        ("law_share", decimals(result.cost.law.as_secs_f64() / result.cost.total().as_secs_f64(), 2)),
    ]);
    cells
}

/// A number of so many decimals, for what has no unit or seconds.
fn decimals(value: f64, digits: usize) -> String {
    format!("{value:.digits$}")
}

/// The entries of a case with a projectile.
fn strike_cells(case: &Case, result: &Outcome, stiffness: f64, cells: &mut Vec<(&'static str, String)>) {
    let last = result.last();
    let broken = |of: fn((f64, f64)) -> f64| or_dash(result.broken.map(of), number);
    cells.extend([
        ("contact_stiffness", format!("{stiffness:e}")),
        ("transverse_at_clamp", or_dash(result.transverse_at_clamp(case.yarn.length), number)),
        ("outcome", outcome(result).to_string()),
        ("residual_speed", or_dash(result.residual_speed(), number)),
        ("speed_at_end", number(last.speed)),
        ("first_failure_at", or_dash(result.failed, number)),
        ("broken_at", broken(|(time, _)| time)),
        ("speed_then", broken(|(_, speed)| speed)),
        ("deleted", last.deleted.to_string()),
        ("collapsed", last.collapsed.to_string()),
        ("end", number(last.time)),
        ("hourglass_share", decimals(result.hourglass_share(), 3)),
        ("contact_share", decimals(result.contact_share(), 3)),
        ("index_max", decimals(result.largest_index(), 3)),
        ("w_el_at_end", number(last.largest[0])),
        ("w_tc_at_end", number(last.largest[1])),
        ("w_td_at_end", number(last.largest[2])),
        ("work_at_end", number(last.largest[4])),
    ]);
}

/// The entries that Smith's theory is compared with.
fn smith_cells(length: f64, result: &Outcome, cells: &mut Vec<(&'static str, String)>) {
    let Smith { strain, fastest, slowest, transverse } = result.smith;
    cells.extend([
        ("longitudinal_theory", format!("{}-{}", number(fastest), number(slowest))),
        ("strain_percent", or_dash(result.plateau(length), |strain| number(100.0 * strain))),
        ("strain_theory", number(100.0 * strain)),
        ("transverse_speed", or_dash(result.front_speed(length, |sample| sample.transverse), number)),
        ("transverse_theory", number(transverse)),
        ("outcome", outcome(result).to_string()),
        ("first_failure_at", or_dash(result.failed, number)),
        ("broken_at", or_dash(result.broken.map(|(time, _)| time), number)),
        ("deleted", result.last().deleted.to_string()),
        ("collapsed", result.last().collapsed.to_string()),
        ("end", number(result.last().time)),
    ]);
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
pub fn write_history(file: &Path, result: &Outcome) -> Result<(), Error> {
    let file_error = |error: csv::Error| Error::Input(format!("{}: {error}", file.display()));
    let mut writer = csv::Writer::from_path(file).map_err(file_error)?;
    writer
        .write_record([
            "time",
            "speed",
            "travel",
            "force",
            "projectile_energy",
            "kinetic_energy",
            "internal_energy",
            "hourglass_energy",
            "viscosity_energy",
            "friction_energy",
            "contact_energy",
            "external_work",
            "total_energy",
            "elongation_energy",
            "compaction_energy",
            "distortion_energy",
            "shear_energy",
            "linear_work",
            "w_el_max",
            "w_tc_max",
            "w_td_max",
            "w_ld_max",
            "work_max",
            "w_el_min",
            "w_tc_free",
            "w_td_free",
            "failure_index_max",
            "deleted",
            "collapsed",
            "longitudinal_front",
            "transverse_front",
            "strain",
            "width_1",
            "width_2",
            "width_3",
            "width_4",
        ])
        .map_err(file_error)?;
    for sample in &result.history {
        let e = sample.energies;
        let line = (
            [sample.time, sample.speed, sample.travel, sample.force],
            [e.projectile, e.kinetic, e.internal, e.hourglass, e.viscosity, e.friction, e.contact, e.external],
            e.total(),
            sample.parts,
            sample.largest,
            [sample.least, sample.free[1], sample.free[2], sample.index],
            sample.deleted,
            sample.collapsed,
            [sample.longitudinal, sample.transverse, sample.strain],
            sample.widths,
        );
        writer.serialize(line).map_err(file_error)?;
    }
    writer.flush().map_err(|error| file_error(error.into()))
}
