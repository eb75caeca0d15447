//! What is wrong with a run, as far as the yarn's scenes have it, and what to change; `docs/guides/impact.md` has the
//! bounds.

use super::outcome::{End, Outcome};
use super::scene::{Case, Striker};
use super::weights;
use crate::common::units::{TIME, number, unit};
use crate::explicit::judgement::{self, Finding};
use toron::host::units::UnitSystem;

/// All that is wrong with a run.
pub fn judge(units: &UnitSystem, case: &Case, result: &Outcome) -> Vec<Finding> {
    let mut findings = before(units, case);
    if result.end == End::Interrupted {
        findings.push(judgement::interrupted());
        return findings;
    }
    findings.extend(hourglass(case, result));
    findings.extend(contact(case, result));
    findings.extend(judgement::balance(result.balance.imbalance()));
    if let Some((time, _)) = result.course.broken {
        let broken = format!("the break, at {} {}", number(time), unit(units, TIME));
        judgement::add_after_failure(&mut findings, &broken, after_break(case, result));
    }
    findings
}

/// What is wrong with what followed when the yarn had broken.
fn after_break(case: &Case, result: &Outcome) -> Vec<Finding> {
    let viscosity = judgement::viscosity(
        result.viscosity_share(),
        "a finer mesh, and see how far what is left to the projectile moves",
    );
    let hourglass = judgement::hourglass(result.whole_hourglass_share(), &hourglass_remedy(case));
    viscosity.into_iter().chain(hourglass).collect()
}

fn hourglass_remedy(case: &Case) -> String {
    format!("a finer mesh, or another hourglass than {}", case.control.hourglass)
}

/// What is wrong before the first step.
pub fn before(units: &UnitSystem, case: &Case) -> Vec<Finding> {
    let mut findings = judgement::units(case.zones.materials(), units);
    findings.extend(weights::findings(units, case));
    findings
}

/// Where the contact stores too much energy.
pub fn contact(case: &Case, result: &Outcome) -> Option<Finding> {
    let Striker::Cylinder { cylinder, .. } = case.striker else { return None };
    judgement::contact(result.contact_share(), cylinder.stiffness)
}

/// Where hourglass modes hold too much energy.
///
/// Before a wave has been at the clamp and back, the yarn has hardly any internal energy that they could be held
/// against.
pub fn hourglass(case: &Case, result: &Outcome) -> Option<Finding> {
    let measured_to = result.course.broken.map_or(result.last().time, |(time, _)| time);
    let at_clamp = case.yarn.length / result.smith.fastest;
    judgement::hourglass(result.hourglass_share(), &hourglass_remedy(case)).filter(|_| measured_to >= 2.0 * at_clamp)
}
