//! What is wrong with a run, as far as the yarn's scenes have it, and what to change;
//! `docs/reference/impact-files.md` has the bounds.

use super::outcome::{End, Outcome};
use super::scene::{Case, Striker};
use super::weights;
use toron::host::units::UnitSystem;
use toron_explicit_host::judgement::{self, Finding};
use toron_materials::units::{TIME, unit};
use toron_shared::numbers::number;

/// Artificial viscosity may take this part of what the blow has given away while the yarn is whole. Runs of the
/// examples have 0.9 to 3.7 %; one in eight layers has 7.9 %, one with a hundred times the viscosity 7.8 %, and both
/// stop a projectile to which 65 of 120 m/s are left.
const LARGEST_VISCOSITY: f64 = 0.06;
/// How often the wave along the fibre has passed half of the yarn by then.
const PASSES: f64 = 4.0;

/// All that is wrong with a run.
pub fn judge(units: &UnitSystem, case: &Case, result: &Outcome) -> Vec<Finding> {
    let mut findings = before(units, case);
    if result.end == End::Interrupted {
        findings.push(judgement::interrupted());
        return findings;
    }
    findings.extend(hourglass(case, result));
    findings.extend(contact(case, result));
    findings.extend(viscosity(case, result));
    findings.extend(collapsed(case, result));
    findings.extend(judgement::balance(result.balance.imbalance()));
    let error = judgement::error(result.failure.as_deref());
    match result.course.broken {
        Some((time, _)) => {
            let broken = format!("the break, at {} {}", number(time), unit(units, TIME));
            let found = error.into_iter().chain(after_break(case, result));
            judgement::add_after_failure(&mut findings, &broken, found);
        }
        None => findings.extend(error),
    }
    findings
}

/// What is wrong with what followed when the yarn had broken.
fn after_break(case: &Case, result: &Outcome) -> Vec<Finding> {
    let remedy = "a finer mesh, and see how far what is left to the projectile moves";
    let viscosity = judgement::viscosity(result.viscosity_share(), judgement::LARGEST_VISCOSITY, remedy);
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

/// Elements that are deleted while nothing has failed, and so before any strength was asked for.
fn collapsed(case: &Case, result: &Outcome) -> Option<Finding> {
    let failed = result.failed.unwrap_or(f64::INFINITY);
    let samples = result.measured.iter().take_while(|sample| sample.time <= failed);
    let elements = samples.map(|sample| sample.collapsed).max().unwrap_or(0);
    judgement::collapsed(elements, &hourglass_remedy(case))
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

/// Where artificial viscosity takes too much while the yarn is whole.
///
/// To set the yarn in motion costs a blow what it costs on any mesh: 18 % of the little that it has given away after
/// 1 µs. What counts is taken when the projectile has come by its radius, and the wave along the fibre has been at the
/// clamp and back twice.
pub fn viscosity(case: &Case, result: &Outcome) -> Option<Finding> {
    let from = PASSES * case.yarn.length / result.smith.fastest;
    let way = match case.striker {
        Striker::Cylinder { cylinder, .. } => cylinder.radius,
        Striker::Driven => 0.0,
    };
    judgement::viscosity(result.viscosity_to_break(from, way), LARGEST_VISCOSITY, "a finer mesh, or less viscosity")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::run;
    use crate::impact::scene::Scene;
    use toron_explicit_host::judgement::verdict;

    /// The example's yarn at 120 m/s with so many layers, these keys, and this end in µs.
    fn verdict_of(layers: usize, keys: &str, end: f64) -> (String, f64) {
        let text = format!(
            "units = \"mm-g-ms\"\n[scene]\nfailure = \"none\"\nhalf-length = 12.7\nheight = 0.115\nwidth = 0.5337\n\
             layers = {layers}\nrows = 1\ncolumns = 3\nmass = 9.91e-3\nradius = 1.1\ncontact-stiffness = 1e6\n\
             speed = 120.0\nend = {}\n{keys}\n",
            1e-3 * end
        );
        let scene = Scene::parse("yarn.toml", &text).expect("a scene");
        let result = run::run(&scene.cases[0], &mut ()).expect("it runs");
        (verdict(&judge(&scene.units, &scene.cases[0], &result)), result.viscosity_share())
    }

    /// Nothing that was measured up to the end of such a run need be wrong.
    #[test]
    fn what_could_not_go_on_or_has_collapsed_is_not_sound() {
        let text = "units = \"mm-g-ms\"\n[scene]\nfailure = \"none\"\nhalf-length = 3.0\nheight = 0.115\nwidth = 0.5337\n\
                    layers = 12\nrows = 2\ncolumns = 3\nmass = 9.91e-3\nradius = 1.1\ncontact-stiffness = 1e6\n\
                    speed = 100.0\nend = 1e-4\n";
        let scene = Scene::parse("yarn.toml", text).expect("a scene");
        let mut result = run::run(&scene.cases[0], &mut ()).expect("it runs");
        let of = |result: &Outcome| verdict(&judge(&scene.units, &scene.cases[0], result));
        assert_eq!(of(&result), "sound");
        result.run.failure = Some("no step".to_string());
        assert_eq!(of(&result), "error");
        // What has collapsed behind a failure are shreds.
        (result.run.failed, result.run.course.broken) = (Some(0.0), Some((0.0, 100.0)));
        let last = result.run.measured.len() - 1;
        result.run.measured[last].collapsed = 2;
        let broken = of(&result);
        assert!(broken.starts_with("sound to failure; then error") && !broken.contains("collapsed"), "{broken}");
        (result.run.failed, result.run.failure, result.run.course.broken) = (None, None, None);
        assert_eq!(of(&result), "collapsed");
    }

    #[test]
    fn viscosity_is_found_where_the_mesh_is_coarse_or_it_is_large_itself() {
        let strong = "viscosity = [6.0, 150.0, 20.0]";
        for (layers, keys, wanted) in [(50, "", "sound"), (6, "", "viscosity"), (25, strong, "viscosity")] {
            assert_eq!(verdict_of(layers, keys, 11.0).0, wanted, "{layers} {keys}");
        }
        // So early it is as much on any mesh, and no fault.
        let (verdict, share) = verdict_of(50, "", 2.5);
        assert!(verdict == "sound" && share > 0.1, "{verdict} {share}");
    }
}
