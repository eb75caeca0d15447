//! The files of figures: a line for every case, how it ended, with what speed, energies and cost; and a case's history.

use std::path::Path;

use super::judgement::judge;
use super::outcome::{End, OfYarn, Outcome};
use super::scene::{Case, Outputs, Striker, Zones};
use toron::host::units::UnitSystem;
use toron::law::parameters::{ENERGY_DENSITY, NUMBER};
use toron_explicit_host::judgement::verdict;
use toron_explicit_host::struck::history::Column;
use toron_explicit_host::struck::summary::{Cells, Row};
use toron_materials::material::smith::Smith;
use toron_materials::units::{CONTACT_STIFFNESS, LENGTH, SPEED, TIME};
use toron_shared::error::Error;
use toron_shared::numbers::{number, one_digit};
use toron_shared::text_table::{NONE, or_dash, write_csv};

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
    match (result.end, result.course.broken) {
        (End::Interrupted, _) => "interrupted",
        (End::Failed, _) => "an error",
        (End::Rebounded, None) => "flies back",
        (End::Rebounded, Some(_)) => "broken, flies back",
        (End::Stopped, None) => "not penetrated",
        (End::Stopped, Some(_)) => "broken, stopped",
        (End::Left | End::Decided | End::Settled, _) => "penetrated",
        (End::Time, Some(_)) => "broken, not over",
        (End::Time, None) => "unbroken, not over",
    }
}

fn law(case: &Case) -> String {
    let mut name = match &case.zones {
        Zones::One(material) => material.law_name().to_string(),
        Zones::Two(_, length) => {
            let layers = case.yarn.layers_to(*length) as f64;
            format!("hyperelastic to {}", number(layers / case.yarn.layers as f64 * case.yarn.length))
        }
    };
    if case.single_precision {
        name.push_str(", f32");
    }
    if case.outputs == Outputs::Stress {
        name.push_str(", stress only");
    }
    name
}

/// A case's line in the summary.
pub fn line(units: &UnitSystem, case: &Case, result: &Outcome) -> Cells {
    let length = case.yarn.length;
    let mut row = Row::new(units);
    row.add("case", &case.name);
    row.add("law", law(case));
    row.add("material", case.zones.names());
    row.add("verdict", verdict(&judge(units, case, result)));
    let seed = case.strength.map(|strength| strength.field.seed.to_string());
    row.add("strength_seed", seed.as_deref().unwrap_or(NONE));
    row.add("strength_least", case.weakest(units, &result.mesh).as_deref().unwrap_or(NONE));
    row.add("elements", result.elements);
    row.quantity("speed", SPEED, case.speed);
    row.quantity("longitudinal_speed", SPEED, result.front_speed(length, |sample| sample.own.longitudinal));
    match case.striker {
        Striker::Cylinder { cylinder, .. } => add_strike(&mut row, case, result, cylinder.stiffness),
        Striker::Driven => add_smith(&mut row, length, result),
    }
    let cost = result.cost;
    row.add("imbalance", one_digit(result.balance.imbalance()));
    row.add("steps", cost.steps);
    row.decimals("seconds", cost.processor.as_secs_f64(), 2);
    row.decimals("wall_seconds", cost.total().as_secs_f64(), 2);
    row.decimals("ns_per_zone_cycle", result.ns_per_zone_cycle(), 1);
    row.decimals("law_time_share", cost.law.as_secs_f64() / cost.total().as_secs_f64(), 2);
    row.cells
}

/// How a case ended, and when it broke.
fn add_ending(row: &mut Row, result: &Outcome) {
    row.add("ending", outcome(result));
    row.quantity("first_failure_at", TIME, result.failed);
    row.quantity("broken_at", TIME, result.course.broken.map(|(time, _)| time));
    row.add("deleted", result.last().deleted);
    row.add("collapsed", result.last().collapsed);
    row.quantity("end", TIME, result.last().time);
}

/// The entries of a case with a projectile.
fn add_strike(row: &mut Row, case: &Case, result: &Outcome, stiffness: f64) {
    let last = result.last();
    row.quantity("contact_stiffness", CONTACT_STIFFNESS, stiffness);
    row.quantity("transverse_at_clamp", TIME, result.transverse_at_clamp(case.yarn.length));
    add_ending(row, result);
    row.quantity("residual_speed", SPEED, result.residual_speed());
    row.quantity("speed_at_end", SPEED, last.speed);
    row.quantity("speed_at_break", SPEED, result.course.broken.map(|(_, speed)| speed));
    row.decimals("hourglass_share", result.hourglass_share(), 3);
    row.decimals("contact_share", result.contact_share(), 3);
    row.decimals("viscosity_share", result.viscosity_share(), 3);
    row.decimals("failure_index_max", result.largest_index(), 3);
    for (name, mode) in [("w_el_at_end", 0), ("w_tc_at_end", 1), ("w_td_at_end", 2), ("work_at_end", 4)] {
        row.quantity(name, ENERGY_DENSITY, last.largest[mode]);
    }
}

/// The entries that Smith's theory is compared with.
fn add_smith(row: &mut Row, length: f64, result: &Outcome) {
    let Smith { strain, fastest, slowest, transverse } = result.smith;
    row.add("longitudinal_theory", format_args!("{}-{}", number(fastest), number(slowest)));
    row.add("strain_percent", or_dash(result.plateau(length), |strain| number(100.0 * strain)));
    row.add("strain_theory", number(100.0 * strain));
    row.quantity("transverse_speed", SPEED, result.front_speed(length, |sample| sample.own.transverse));
    row.quantity("transverse_theory", SPEED, transverse);
    add_ending(row, result);
}

/// The columns of the history that a yarn has besides those of all scenes.
pub fn columns() -> Vec<Column<OfYarn>> {
    let mut columns = vec![
        Column::own("w_el_min", ENERGY_DENSITY, |own: &OfYarn| own.least),
        Column::own("w_tc_free", ENERGY_DENSITY, |own: &OfYarn| own.free[1]),
        Column::own("w_td_free", ENERGY_DENSITY, |own: &OfYarn| own.free[2]),
        Column::own("longitudinal_front", LENGTH, |own: &OfYarn| own.longitudinal),
        Column::own("transverse_front", LENGTH, |own: &OfYarn| own.transverse),
        Column::own("strain", NUMBER, |own: &OfYarn| own.strain),
    ];
    for (station, name) in ["width_1", "width_2", "width_3", "width_4"].into_iter().enumerate() {
        columns.push(Column::own(name, LENGTH, move |own: &OfYarn| own.widths[station]));
    }
    columns
}
