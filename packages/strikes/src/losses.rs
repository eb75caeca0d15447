//! What friction between the fibres of a section has taken, in reports.

use toron::host::units::UnitSystem;
use toron_materials::units::{ENERGY, unit};
use toron_shared::numbers::number;
use toron_shared::text_table::folded;

/// The line of a report on the cases that have lost energy so, each by its name; empty where none has.
pub fn lost_between_fibres<'a>(
    units: &UnitSystem,
    cases: impl Iterator<Item = (&'a str, f64)>,
    width: usize,
) -> String {
    let lost: Vec<String> = cases
        .filter(|&(_, energy)| energy > 0.0)
        .map(|(case, energy)| format!("{} {} ({case})", number(energy), unit(units, ENERGY)))
        .collect();
    if lost.is_empty() {
        String::new()
    } else {
        folded(&format!("Lost between fibres: {}", lost.join(", ")), width) + "\n"
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::run;
    use crate::impact::scene::Scene;

    #[test]
    fn a_yarn_that_is_struck_loses_energy_by_friction_alone() {
        let text = "units = \"mm-g-ms\"\n[scene]\nfailure = \"multiaxial\"\nhalf-length = 6.0\nheight = 0.115\nwidth = 0.5337\n\
                    layers = 24\nrows = 2\ncolumns = 4\nmass = 9.91e-3\nradius = 1.1\ncontact-stiffness = 1e6\n\
                    speed = 120.0\nend = 4e-3\n[[case]]\nname = \"without\"\n[[case]]\nname = \"with\"\nlaw = \"frictional\"\n\
                    [[case]]\nname = \"held\"\nlaw = \"frictional\"\nfrictional.properties = { cohesion = 1e6 }\n";
        let scene = Scene::parse("yarn.toml", text).expect("a scene");
        let results: Vec<_> = scene.cases.iter().map(|case| run::run(case, &mut ()).expect("it runs")).collect();
        let [without, with, held] = [0, 1, 2].map(|i| results[i].last());
        assert!(with.energies.fibres > 0.0 && without.energies.fibres == 0.0 && held.energies.fibres == 0.0);
        for result in &results {
            assert!(result.run.balance.imbalance() < 2e-3, "{}", result.run.balance.imbalance());
        }
        // Held by as much cohesion the fibres are those of the hyperelastic law.
        let same = |a: f64, b: f64| (a - b).abs() <= 1e-6 * b.abs();
        assert!(same(held.speed, without.speed) && same(held.parts[2], without.parts[2]), "{held:?} {without:?}");
        // The section holds less of its distortion where the fibres slide.
        assert!(with.parts[2] < 0.9 * without.parts[2], "{} {}", with.parts[2], without.parts[2]);
        let cases =
            scene.cases.iter().zip(&results).map(|(case, result)| (case.name.as_str(), result.last().energies.fibres));
        let line = lost_between_fibres(&scene.units, cases, 100);
        assert!(line.starts_with("Lost between fibres: ") && line.ends_with(" mJ (with)\n"), "{line}");
        assert_eq!(lost_between_fibres(&scene.units, std::iter::empty(), 100), "");
    }
}
