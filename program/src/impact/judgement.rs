//! What is wrong with a run, as far as the yarn's scenes have it, and what to change; `docs/guides/impact.md` has the bounds.

use super::outcome::Outcome;
use super::scene::{Case, Striker};
use crate::explicit::judgement::{self, Finding};
use toron::host::units::UnitSystem;

/// All that is wrong with a run.
pub fn judge(units: &UnitSystem, case: &Case, result: &Outcome) -> Vec<Finding> {
    let mut findings = before(units, case);
    findings.extend(hourglass(case, result));
    findings.extend(contact(case, result));
    findings.extend(judgement::balance(result.balance.imbalance()));
    findings
}

/// What is wrong before the first step.
pub fn before(units: &UnitSystem, case: &Case) -> Vec<Finding> {
    judgement::units(case.zones.materials(), units)
}

/// Where the contact stores too much energy.
pub fn contact(case: &Case, result: &Outcome) -> Option<Finding> {
    let Striker::Cylinder { cylinder, .. } = case.striker else { return None };
    judgement::contact(result.contact_share(), cylinder.stiffness)
}

/// Where hourglass modes hold too much energy.
///
/// Before a wave has been at the clamp and back, the yarn has hardly any internal energy that they could be held against.
pub fn hourglass(case: &Case, result: &Outcome) -> Option<Finding> {
    let measured_to = result.course.broken.map_or(result.last().time, |(time, _)| time);
    let at_clamp = case.yarn.length / result.smith.fastest;
    let remedy = format!("a finer mesh, or another hourglass than {}", case.control.hourglass);
    judgement::hourglass(result.hourglass_share(), &remedy).filter(|_| measured_to >= 2.0 * at_clamp)
}
