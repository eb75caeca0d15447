//! A line for every section that was pressed.

use std::path::Path;

use super::friction::Friction;
use super::outcome::Pressed;
use super::output::Results;
use crate::fibres::model::micro;
use crate::fibres::scene::{Case, Packing, Scene, Striker};
use toron::host::units::UnitSystem;
use toron_materials::units::TIME;
use toron_shared::error::Error;
use toron_shared::numbers::{number, one_digit};
use toron_shared::text_table::{or_dash, write_csv};

/// Titles and entries of a case's line.
fn cells(units: &UnitSystem, case: &Case, result: &Pressed) -> Vec<(&'static str, String)> {
    let (model, last) = (&result.model, result.last());
    let friction = Friction::of(result);
    let of = |of: fn(&Friction) -> f64| or_dash(friction.as_ref().map(of), number);
    let pressure = match case.striker {
        Striker::Walls { pressure, .. } if pressure > 0.0 => Some(pressure),
        _ => None,
    };
    let packing = match case.packing {
        Packing::Hexagonal => "hexagonal".to_string(),
        Packing::Random { seed } => format!("random {seed}"),
    };
    let mut cells = vec![
        ("case", case.name.clone()),
        ("fibres", case.fibres.to_string()),
        ("packing", packing),
        ("fraction", format!("{:.4}", model.section.fraction())),
        ("friction", number(case.friction)),
        ("walls", result.pressing.walls.name().to_string()),
        ("pressure", or_dash(pressure, number)),
        ("stretch", format!("{:.4}", last.stretch)),
        ("I_tc", number(last.strain[0])),
        ("I_td", number(last.strain[1])),
        ("p_t", number(last.p_t)),
        ("q", number(last.q)),
    ];
    cells.extend([
        ("peak_I_td", of(|f| f.peak.mean.range[0])),
        ("peak_p_t", of(|f| f.peak.mean.p_t)),
        ("peak_q/p_t", of(|f| f.peak.mean.ratio())),
        ("peak_dilatancy", of(|f| f.peak.mean.dilatancy)),
        ("peak_mu", of(|f| f.peak.mean.mu())),
        ("peak_mu_lost", of(|f| f.peak.lost)),
        ("last_p_t", of(|f| f.critical.mean.p_t)),
        ("last_q/p_t", of(|f| f.critical.mean.ratio())),
        ("last_dilatancy", of(|f| f.critical.mean.dilatancy)),
        ("last_mu", of(|f| f.critical.mean.mu())),
        ("last_mu_error", of(|f| f.error)),
        ("last_mu_lost", of(|f| f.critical.lost)),
        ("work", number(last.work)),
        ("friction_lost", number(last.friction)),
        ("damping_lost", number(last.damping)),
        ("imbalance", one_digit(result.imbalance())),
        ("step", number(micro(units, TIME) * model.step)),
        ("steps", model.steps.to_string()),
        ("seconds", or_dash(result.seconds, |seconds| format!("{seconds:.1}"))),
    ]);
    cells
}

/// Writes the table as CSV.
///
/// # Errors
/// The file cannot be written.
pub fn write(file: &Path, scene: &Scene, results: &Results) -> Result<(), Error> {
    let lines: Vec<_> = results.iter().map(|(case, result)| cells(&scene.units, case, result)).collect();
    write_csv(file, &lines)
}
