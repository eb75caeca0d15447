//! The figures of a scene: a line for every case, how it ended, with what speed, deflection, damage and cost.

use std::path::Path;
use std::time::Duration;

use super::judgement::{Measures, judge};
use super::measure::{OfPanel, Sample};
use super::run::{Decision, End, Outcome};
use super::scene::{Case, Zones};
use super::strength::PanelStrength;
use super::weights;
use crate::residual::SpeedIs;
use crate::strength::scatter;
use crate::weave::model::Model;
use toron::host::units::UnitSystem;
use toron::law::parameters::{Dimension, ENERGY_DENSITY, NUMBER};
use toron_explicit_host::judgement::{Finding, verdict};
use toron_explicit_host::lanes::{largest, smallest};
use toron_explicit_host::step_limit::{BINS, Histogram, Limiter};
use toron_explicit_host::struck::history::{Column, title};
use toron_explicit_host::struck::summary::{Cells, Row};
use toron_materials::units::{LENGTH, MASS, SPEED, TIME};
use toron_shared::error::Error;
use toron_shared::numbers::number;
use toron_shared::text_table::{NONE, write_csv};

/// Of angles.
const DEGREES: Dimension = Dimension { mass: 0, length: 0, time: 0, name: "°" };

/// The front has reached the rim at this part of the way to it: the rim is held, and beside it there is no deflection
/// to see.
const AT_RIM: f64 = 0.95;

/// A case's figures.
pub struct Figures {
    pub last: Sample,
    /// The largest deflection, and when it was there.
    pub deflection: (f64, f64),
    /// When the front of the transverse wave has reached the rim.
    pub front_at_rim: Option<f64>,
    /// The least volume of an element over that at rest, of all times.
    pub least_volume_ratio: f64,
    /// The largest energy densities of all times.
    pub densities: [f64; 5],
    /// The least strength of all elements, where it scatters.
    pub weakest: Option<String>,
    /// What panel and striker weigh, in words.
    pub weights: String,
    /// Up to the first failure, of the whole run, and what is wrong with it.
    pub measures: Measures,
    pub whole: Measures,
    pub findings: Vec<Finding>,
}

impl Figures {
    pub fn of(units: &UnitSystem, case: &Case, panel: &Model, outcome: &Outcome) -> Figures {
        let samples = &outcome.measured;
        let most = |of: fn(&Sample) -> f64| samples.iter().map(of).fold(0.0, largest);
        let least = |of: fn(&Sample) -> f64| samples.iter().map(of).fold(1.0, smallest);
        let deflection = most(|sample| sample.own.deflection);
        let deepest = samples.iter().find(|sample| sample.own.deflection == deflection);
        let rim = AT_RIM * rim(panel);
        let front_at_rim = samples.iter().find(|sample| sample.own.front >= rim).map(|sample| sample.time);
        let [measures, whole] = [Measures::to_failure(outcome), Measures::whole(outcome)];
        Figures {
            last: outcome.last(),
            deflection: (deflection, deepest.map_or(0.0, |sample| sample.time)),
            front_at_rim,
            least_volume_ratio: least(|sample| sample.own.least_volume_ratio),
            densities: std::array::from_fn(|mode| samples.iter().map(|s| s.largest[mode]).fold(0.0, largest)),
            weakest: PanelStrength::of(case)
                .map(|strength| scatter::text(case.zones.inner(), strength.least(panel), units)),
            weights: weights::text(units, case, panel),
            findings: judge(units, case, panel, outcome, [&measures, &whole], front_at_rim),
            measures,
            whole,
        }
    }
}

/// How far the yarns next to the axes, along which the front is measured, reach from the centre.
fn rim(panel: &Model) -> f64 {
    let nodes = panel.central().flat_map(|(_, yarn)| &panel.nodes[yarn.nodes.clone()]);
    nodes.map(|[x, y, _]| x.hypot(*y)).fold(0.0, f64::max)
}

/// How a case ended, in words.
pub fn ending(case: &Case, outcome: &Outcome) -> String {
    let strikes = case.striker.shape.name();
    match outcome.end {
        End::Time => "time is over".to_string(),
        End::Stopped => format!("{strikes} stopped"),
        End::Rebounded => format!("{strikes} flies back"),
        End::Left => format!("{strikes} went through"),
        End::Decided => format!("{strikes} goes through, decided"),
        End::Settled => format!("{strikes} goes through, settled"),
        End::Interrupted => "interrupted".to_string(),
        End::Failed => "an error".to_string(),
    }
}

/// The striker's residual speed, where the panel has either stopped it or let it through.
pub fn residual_speed(outcome: &Outcome, figures: &Figures) -> Option<f64> {
    match outcome.end {
        End::Stopped => Some(0.0),
        End::Left | End::Decided | End::Settled => Some(figures.last.speed.max(0.0)),
        End::Time | End::Failed | End::Interrupted | End::Rebounded => None,
    }
}

/// Which speed of a striker that goes through that one is.
pub fn speed_is(case: &Case, outcome: &Outcome) -> Option<SpeedIs> {
    SpeedIs::of(outcome.end, case.plan.settles)
}

fn law(case: &Case) -> String {
    match &case.zones {
        Zones::One(material) => material.law_name().to_string(),
        Zones::Two(_, radius) => format!("hyperelastic to {}", number(*radius)),
    }
}

/// A case's line in the summary.
pub fn line(units: &UnitSystem, case: &Case, outcome: &Outcome, figures: &Figures) -> Cells {
    let Figures { last, deflection: (deflection, deepest_at), measures, whole, .. } = figures;
    let seconds = |time: Duration| time.as_secs_f64();
    let total = seconds(outcome.cost.total()).max(f64::MIN_POSITIVE);
    let mut row = Row::new(units);
    row.add("case", &case.name);
    row.add("law", law(case));
    row.add("precision", if case.single_precision { "f32" } else { "f64" });
    row.add("elements", outcome.elements);
    row.quantity("speed", SPEED, case.speed);
    row.add("ending", ending(case, outcome));
    row.quantity("end", TIME, last.time);
    row.quantity("residual_speed", SPEED, residual_speed(outcome, figures));
    row.add("residual_speed_is", speed_is(case, outcome).map_or(NONE, SpeedIs::name));
    row.quantity("speed_at_end", SPEED, last.speed);
    row.add("verdict", verdict(&figures.findings));
    row.add("material", case.material_names());
    let seed = case.strength.map(|strength| strength.field.seed.to_string());
    row.add("strength_seed", seed.as_deref().unwrap_or(NONE));
    row.add("strength_least", figures.weakest.as_deref().unwrap_or(NONE));
    row.quantity("deflection_max", LENGTH, *deflection);
    row.quantity("deflection_max_at", TIME, *deepest_at);
    row.quantity("front_at_rim", TIME, figures.front_at_rim);
    row.quantity("first_failure_at", TIME, outcome.failed);
    row.add("torn_yarns", last.own.torn);
    row.add("deleted", last.deleted);
    row.add("collapsed", last.collapsed);
    row.add("imbalance", format_args!("{:.1e}", outcome.balance.imbalance()));
    row.decimals("hourglass_share", whole.hourglass, 4);
    row.decimals("viscosity_share", whole.viscosity, 4);
    row.add(&title("tilt_at_end", DEGREES, units), format_args!("{:.1}", last.own.tilt));
    row.quantity("slip_at_end", LENGTH, last.own.slip);
    row.add("least_volume_ratio", number(figures.least_volume_ratio));
    row.add("least_scaled_jacobian", number(whole.least_scaled_jacobian));
    row.decimals("hourglass_to_failure", measures.hourglass, 4);
    row.decimals("w_ld_to_failure", measures.shear, 4);
    row.add("scaled_jacobian_to_failure", number(measures.least_scaled_jacobian));
    row.decimals("contact_to_failure", measures.contact, 4);
    row.decimals("viscosity_to_failure", measures.viscosity, 4);
    for (name, density) in
        ["w_el_max", "w_tc_max", "w_td_max", "w_ld_max", "work_max"].into_iter().zip(figures.densities)
    {
        row.quantity(name, ENERGY_DENSITY, density);
    }
    row.add("steps", outcome.cost.steps);
    row.add("searches", outcome.searches);
    row.quantity("shred_mass", MASS, outcome.lent);
    let limited: f64 = outcome.limited.iter().sum();
    for (limiter, time) in Limiter::ALL.into_iter().zip(outcome.limited) {
        row.decimals(&format!("limited_by_{}", limiter.name()), time / limited.max(f64::MIN_POSITIVE), 4);
    }
    row.decimals("ns_per_zone_cycle", outcome.ns_per_zone_cycle(), 1);
    row.decimals("contact_time_share", seconds(outcome.cost.contact) / total, 2);
    row.decimals("law_time_share", seconds(outcome.cost.law) / total, 2);
    row.decimals("seconds", seconds(outcome.cost.processor), 2);
    row.decimals("wall_seconds", seconds(outcome.cost.total()), 2);
    let decision = outcome.decision;
    row.quantity("decided_at", TIME, decision.map(|decision| decision.time));
    row.quantity("speed_at_decision", SPEED, decision.map(|decision| decision.speed));
    let of_decision = |text: &dyn Fn(Decision) -> String| decision.map_or(NONE.to_string(), text);
    row.add("steps_to_decision", of_decision(&|decision| decision.steps.to_string()));
    row.add("seconds_to_decision", of_decision(&|decision| format!("{:.2}", seconds(decision.processor))));
    row.cells
}

/// Writes how many elements have which step of their own, in the mean over the looks, and at which part of these the
/// step itself was there.
///
/// # Errors
/// The file cannot be written.
pub fn write_steps(file: &Path, histogram: &Histogram) -> Result<(), Error> {
    let mean = |of: &[u64], bin: usize| of.get(bin).copied().unwrap_or(0) as f64 / histogram.looks.max(1) as f64;
    let line = |bin: usize| {
        let [whole, torn] = &histogram.elements;
        let entries = [Histogram::low(bin), mean(whole, bin), mean(torn, bin), mean(&histogram.steps, bin)];
        ["over_first", "whole", "torn", "steps"].into_iter().zip(entries.map(number)).collect()
    };
    write_csv(file, &(0..BINS).map(line).collect::<Vec<_>>())
}

/// The columns of the history that a panel has besides those of all scenes.
pub fn columns() -> Vec<Column<OfPanel>> {
    vec![
        Column::own("deflection", LENGTH, |own: &OfPanel| own.deflection),
        Column::own("transverse_front", LENGTH, |own: &OfPanel| own.front),
        Column::own("torn_yarns", NUMBER, |own: &OfPanel| own.torn as f64),
        Column::own("tilt", DEGREES, |own: &OfPanel| own.tilt),
        Column::own("slip", LENGTH, |own: &OfPanel| own.slip),
        Column::own("least_volume_ratio", NUMBER, |own: &OfPanel| own.least_volume_ratio),
        Column::own("least_scaled_jacobian", NUMBER, |own: &OfPanel| own.least_scaled_jacobian),
    ]
}
