//! The figures of a scene: a line for every case, how it ended, with what speed, deflection, damage and cost.

use std::path::Path;
use std::time::Duration;

use super::judgement::{Measures, judge};
use super::measure::Sample;
use super::run::{End, Outcome};
use super::scene::{Case, Zones};
use crate::common::error::Error;
use crate::common::text_table::{or_dash, write_csv};
use crate::common::units::number;
use crate::explicit::judgement::{Finding, verdict};
use crate::explicit::lanes::{largest, smallest};
use crate::material::model;
use crate::weave::model::Model;
use toron::host::units::UnitSystem;

/// The front has reached the rim at this part of the way to it: the rim is held, and beside it there is no deflection to see.
const AT_RIM: f64 = 0.95;

/// A case's figures.
pub struct Figures {
    pub last: Sample,
    /// The largest deflection, and when it was there.
    pub deflection: (f64, f64),
    /// When the front of the transverse wave has reached the rim.
    pub front_at_rim: Option<f64>,
    /// The largest hourglass energy over the largest internal energy.
    pub hourglass: f64,
    /// The least volume of an element over that at rest, and the least scaled Jacobian, of all times.
    pub worst: [f64; 2],
    /// The largest energy densities of all times.
    pub densities: [f64; 5],
    pub ns_per_zone_cycle: f64,
    /// Up to the first failure, and what is wrong with the run.
    pub measures: Measures,
    pub findings: Vec<Finding>,
}

impl Figures {
    pub fn of(units: &UnitSystem, case: &Case, panel: &Model, outcome: &Outcome) -> Figures {
        let samples = &outcome.measured;
        let most = |of: fn(&Sample) -> f64| samples.iter().map(of).fold(0.0, largest);
        let least = |of: fn(&Sample) -> f64| samples.iter().map(of).fold(1.0, smallest);
        let deflection = most(|sample| sample.deflection);
        let deepest = samples.iter().find(|sample| sample.deflection == deflection);
        let rim = AT_RIM * rim(panel);
        let internal = most(|sample| sample.energies.internal);
        let front_at_rim = samples.iter().find(|sample| sample.front >= rim).map(|sample| sample.time);
        let measures = Measures::of(outcome);
        let cycles = outcome.cost.steps as f64 * outcome.elements as f64;
        Figures {
            last: samples.last().copied().unwrap_or_default(),
            deflection: (deflection, deepest.map_or(0.0, |sample| sample.time)),
            front_at_rim,
            hourglass: if internal == 0.0 { 0.0 } else { most(|sample| sample.energies.hourglass) / internal },
            worst: [least(|sample| sample.least_volume_ratio), least(|sample| sample.least_scaled_jacobian)],
            densities: std::array::from_fn(|mode| samples.iter().map(|s| s.largest[mode]).fold(0.0, largest)),
            ns_per_zone_cycle: outcome.cost.total().as_nanos() as f64 / cycles.max(1.0),
            findings: judge(units, case, panel, outcome, &measures, front_at_rim),
            measures,
        }
    }
}

/// How far the yarns next to the axes, along which the front is measured, reach from the centre.
fn rim(panel: &Model) -> f64 {
    let nearest = panel.yarns.iter().map(|yarn| yarn.coordinate.abs()).fold(f64::INFINITY, f64::min);
    let yarns = panel.yarns.iter().filter(|yarn| yarn.coordinate.abs() <= 1.001 * nearest);
    let nodes = yarns.flat_map(|yarn| &panel.nodes[yarn.nodes.clone()]);
    nodes.map(|[x, y, _]| x.hypot(*y)).fold(0.0, f64::max)
}

/// How a case ended, in words.
pub fn ending(outcome: &Outcome) -> &'static str {
    match outcome.end {
        End::Time => "time is over",
        End::Stopped => "sphere stopped",
        End::Rebounded => "sphere flies back",
        End::Left => "sphere went through",
        End::Interrupted => "interrupted",
        End::Failed => "an error",
    }
}

/// The sphere's residual speed, where the panel has either stopped it or let it through.
pub fn residual_speed(outcome: &Outcome, figures: &Figures) -> Option<f64> {
    match outcome.end {
        End::Stopped => Some(0.0),
        End::Left => Some(figures.last.speed),
        End::Time | End::Failed | End::Interrupted | End::Rebounded => None,
    }
}

/// The names of a case's materials, from the centre outwards.
pub fn yarns(case: &Case) -> String {
    let to = match case.zones {
        Zones::One(_) => String::new(),
        Zones::Two(_, radius) => number(radius),
    };
    model::names(case.zones.materials(), &to)
}

fn law(case: &Case) -> String {
    match &case.zones {
        Zones::One(material) => material.law_name().to_string(),
        Zones::Two(_, radius) => format!("hyperelastic to {}", number(*radius)),
    }
}

/// Titles and entries of a case's line.
fn cells(case: &Case, outcome: &Outcome, figures: &Figures) -> Vec<(&'static str, String)> {
    let Figures { last, deflection: (deflection, deepest_at), measures, .. } = figures;
    let seconds = |time: Duration| time.as_secs_f64();
    let total = seconds(outcome.cost.total()).max(f64::MIN_POSITIVE);
    let share = |time: Duration| format!("{:.2}", seconds(time) / total);
    let mut cells = vec![
        ("case", case.name.clone()),
        ("law", law(case)),
        ("precision", if case.single_precision { "f32" } else { "f64" }.to_string()),
        ("elements", outcome.elements.to_string()),
        ("speed", number(case.speed)),
        ("ending", ending(outcome).to_string()),
        ("end", number(last.time)),
        ("residual_speed", or_dash(residual_speed(outcome, figures), number)),
        ("speed_at_end", number(last.speed)),
        ("verdict", verdict(&figures.findings)),
        ("material", yarns(case)),
        ("deflection_max", number(*deflection)),
        ("deflection_max_at", number(*deepest_at)),
        ("front_at_rim", or_dash(figures.front_at_rim, number)),
        ("first_failure_at", or_dash(outcome.failed, number)),
        ("torn_yarns", last.torn.to_string()),
        ("deleted", last.deleted.to_string()),
        ("collapsed", last.collapsed.to_string()),
        ("imbalance", format!("{:.1e}", outcome.balance.imbalance())),
        ("hourglass_share", format!("{:.4}", figures.hourglass)),
        ("tilt_at_end", format!("{:.1}", last.tilt)),
        ("slip_at_end", number(last.slip)),
        ("least_volume_ratio", number(figures.worst[0])),
        ("least_scaled_jacobian", number(figures.worst[1])),
        ("hourglass_to_failure", format!("{:.4}", measures.hourglass)),
        ("w_ld_to_failure", format!("{:.4}", measures.shear)),
        ("scaled_jacobian_to_failure", number(measures.least_scaled_jacobian)),
        ("contact_to_failure", format!("{:.4}", measures.contact)),
    ];
    let names = ["w_el_max", "w_tc_max", "w_td_max", "w_ld_max", "work_max"];
    cells.extend(names.into_iter().zip(figures.densities.map(number)));
    cells.extend([
        ("steps", outcome.cost.steps.to_string()),
        ("searches", outcome.searches.to_string()),
        ("ns_per_zone_cycle", format!("{:.1}", figures.ns_per_zone_cycle)),
        ("contact_share", share(outcome.cost.contact)),
        ("law_share", share(outcome.cost.law)),
        ("seconds", format!("{:.2}", seconds(outcome.wall))),
    ]);
    cells
}

/// Writes the table as CSV.
///
/// # Errors
/// The file cannot be written.
pub fn write(file: &Path, results: &[(&Case, Outcome, Figures)]) -> Result<(), Error> {
    let lines: Vec<_> = results.iter().map(|(case, outcome, figures)| cells(case, outcome, figures)).collect();
    write_csv(file, &lines)
}
