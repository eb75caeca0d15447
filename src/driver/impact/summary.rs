//! A line for every case: how it ended, with what speed, energies and cost.

use std::path::Path;

use super::run::{End, Outcome};
use super::scene::{Case, Outputs, Precision, Scene, Striker, Zones};
use crate::driver::Error;

/// Column titles of the printed table and of the file.
const COLUMNS: [&str; 22] = [
    "case",
    "law",
    "elements",
    "speed",
    "outcome",
    "residual",
    "broken_at",
    "speed_then",
    "time",
    "w_el",
    "w_tc",
    "w_td",
    "w_el_min",
    "longitudinal",
    "transverse_at_clamp",
    "imbalance",
    "deleted",
    "steps",
    "seconds",
    "ns_per_zone_cycle",
    "law_share",
    "contact_stiffness",
];

/// How a case ended, in words.
pub fn outcome(result: &Outcome) -> &'static str {
    match (result.end, result.broken) {
        (End::Stopped, None) => "not penetrated",
        (End::Stopped, Some(_)) => "broken, stopped",
        (_, Some(_)) => "penetrated",
        (_, None) => "unbroken",
    }
}

fn law(case: &Case) -> String {
    let name = match &case.zones {
        Zones::One(material) => material.law_name().to_string(),
        Zones::Two(_, length) => format!("hyperelastic to {length}"),
    };
    let mut name = name;
    if case.precision == Precision::F32 {
        name.push_str(", f32");
    }
    if case.outputs == Outputs::Stress {
        name.push_str(", stress only");
    }
    name
}

fn cells(case: &Case, result: &Outcome) -> Vec<String> {
    let last = result.last();
    let number = |value: f64, digits: usize| format!("{value:.digits$}");
    let maybe = |value: Option<f64>, digits: usize| value.map_or("-".to_string(), |value| number(value, digits));
    let length = case.yarn.length;
    let per_cycle = result.cost.total().as_nanos() as f64 / result.zone_cycles();
    let share = result.cost.law.as_secs_f64() / result.cost.total().as_secs_f64();
    let residual = if result.end == End::Stopped { 0.0 } else { last.speed };
    let stiffness = match case.striker {
        Striker::Cylinder { cylinder, .. } => format!("{:e}", cylinder.stiffness),
        Striker::Driven => "-".to_string(),
    };
    vec![
        case.name.clone(),
        law(case),
        result.mesh.elements.len().to_string(),
        number(case.speed, 0),
        outcome(result).to_string(),
        number(residual, 1),
        maybe(result.broken.map(|broken| broken.0), 5),
        maybe(result.broken.map(|broken| broken.1), 1),
        number(last.time, 5),
        number(last.largest[0], 2),
        number(last.largest[1], 2),
        number(last.largest[2], 2),
        number(last.least, 2),
        maybe(result.front_speed(length, |sample| sample.longitudinal), 0),
        maybe(result.transverse_at_clamp(length), 5),
        format!("{:.1e}", result.imbalance()),
        last.deleted.to_string(),
        result.cost.steps.to_string(),
        number(result.cost.total().as_secs_f64(), 2),
        number(per_cycle, 1),
        number(share, 2),
        stiffness,
    ]
}

/// The table of all cases as Markdown, the columns that say nothing left out.
pub fn table(scene: &Scene, results: &[Outcome]) -> String {
    let lines: Vec<Vec<String>> = scene.cases.iter().zip(results).map(|(case, result)| cells(case, result)).collect();
    let kept: Vec<usize> = (0..COLUMNS.len()).filter(|&c| lines.iter().any(|line| line[c] != "-")).collect();
    let width = |c: usize| lines.iter().map(|line| line[c].chars().count()).fold(COLUMNS[c].len(), usize::max);
    let mut text = String::new();
    let mut row = |entry: &dyn Fn(usize) -> String| {
        text.push('|');
        for &c in &kept {
            text.push_str(&format!(" {:<width$} |", entry(c), width = width(c)));
        }
        text.push('\n');
    };
    row(&|c| COLUMNS[c].to_string());
    row(&|c| "-".repeat(width(c)));
    for line in &lines {
        row(&|c| line[c].clone());
    }
    text
}

/// Writes the table as CSV.
///
/// # Errors
/// The file cannot be written.
pub fn write(file: &Path, scene: &Scene, results: &[Outcome]) -> Result<(), Error> {
    let fault = |error: csv::Error| Error::Input(format!("{}: {error}", file.display()));
    let mut writer = csv::Writer::from_path(file).map_err(fault)?;
    writer.write_record(COLUMNS).map_err(fault)?;
    for (case, result) in scene.cases.iter().zip(results) {
        writer.write_record(cells(case, result)).map_err(fault)?;
    }
    writer.flush().map_err(|error| fault(error.into()))
}

/// Writes the history of a case.
///
/// # Errors
/// The file cannot be written.
pub fn write_history(file: &Path, result: &Outcome) -> Result<(), Error> {
    let fault = |error: csv::Error| Error::Input(format!("{}: {error}", file.display()));
    let mut writer = csv::Writer::from_path(file).map_err(fault)?;
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
            "w_el_max",
            "w_tc_max",
            "w_td_max",
            "w_el_min",
            "w_tc_outside",
            "w_td_outside",
            "deleted",
            "longitudinal_front",
            "transverse_front",
            "strain",
            "width_1",
            "width_2",
            "width_3",
            "width_4",
        ])
        .map_err(fault)?;
    for sample in &result.samples {
        let e = sample.energies;
        let line = (
            [sample.time, sample.speed, sample.travel, sample.force],
            [e.projectile, e.kinetic, e.internal, e.hourglass, e.viscosity, e.friction, e.contact, e.external],
            [e.total(), sample.largest[0], sample.largest[1], sample.largest[2], sample.least],
            [sample.outside[1], sample.outside[2]],
            sample.deleted,
            [sample.longitudinal, sample.transverse, sample.strain],
            sample.widths,
        );
        writer.serialize(line).map_err(fault)?;
    }
    writer.flush().map_err(|error| fault(error.into()))
}
