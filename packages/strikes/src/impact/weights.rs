//! What yarn and cylinder weigh, in figures that are known of both: a slip in a size, a mass or a unit shows in them.

use std::f64::consts::PI;

use super::scene::{Case, Striker};
use toron::host::units::UnitSystem;
use toron::law::parameters::DENSITY;
use toron_explicit_host::judgement::Finding;
use toron_explicit_host::mesh::Yarn;
use toron_explicit_host::struck::blow::{self, DENSITIES};
use toron_materials::material::linear_density::LinearDensity;
use toron_materials::units::{LENGTH, unit};
use toron_shared::numbers::number;

/// A cylinder lies across the yarn, and may be longer than the yarn is wide: its length over that width, at most.
const LONGEST: f64 = 20.0;

/// The weights of a case, in words for the report.
pub fn text(units: &UnitSystem, case: &Case) -> String {
    let cylinder = cylinder(units, case)
        .map(|density| format!("cylinder {} kg/m³ if it is as long as the yarn is wide", number(density)));
    let yarn = yarn(units, case).map(|yarn| yarn.text());
    cylinder.into_iter().chain(yarn).collect::<Vec<_>>().join("; ")
}

/// The yarn, of the material in the middle.
fn yarn(units: &UnitSystem, case: &Case) -> Option<LinearDensity> {
    let density = case.zones.inner().density?;
    Some(LinearDensity::of(case.yarn.area(), density, units))
}

/// The cylinder's mass over π r² and the yarn's width, in kg/m³: its density times its length over that width. One that
/// keeps its speed may have any mass.
fn cylinder(units: &UnitSystem, case: &Case) -> Option<f64> {
    let Striker::Cylinder { cylinder, mass, held: false } = case.striker else { return None };
    Some(mass / (PI * cylinder.radius.powi(2) * case.yarn.width) / units.from_si(1.0, DENSITY))
}

/// Weights and sizes that cannot be meant.
pub fn findings(units: &UnitSystem, case: &Case) -> Vec<Finding> {
    let of_yarn = yarn(units, case).and_then(|yarn| yarn.warning(units)).map(|text| Finding::new("units", text));
    let mut findings: Vec<Finding> = of_yarn.into_iter().chain(upright(units, &case.yarn)).collect();
    findings.extend(blow::slow_or_fast(units, case.speed));
    if let Striker::Cylinder { cylinder, .. } = &case.striker {
        findings.extend(blow::soft_or_hard(units, cylinder.stiffness));
        findings.extend(blow::rough("friction", cylinder.friction));
        findings.extend(blow::large(units, cylinder, "yarn", case.yarn.length));
        findings.extend(heavy_or_light(units, case));
    }
    findings
}

/// A yarn that stands on its edge.
fn upright(units: &UnitSystem, yarn: &Yarn) -> Option<Finding> {
    (yarn.height > yarn.width).then(|| {
        let text = format!(
            "the yarn is {} {unit} high and {} {unit} wide, and yarns lie flat:\n\
             height and width are exchanged, or one of the two is not in the units of the file, {}",
            number(yarn.height),
            number(yarn.width),
            units.names().join("-"),
            unit = unit(units, LENGTH)
        );
        Finding::new("sizes", text)
    })
}

/// A cylinder that no solid of a length beside the yarn's width makes.
fn heavy_or_light(units: &UnitSystem, case: &Case) -> Option<Finding> {
    let known = *DENSITIES.start()..=LONGEST * DENSITIES.end();
    let density = cylinder(units, case).filter(|density| !known.contains(density))?;
    let text = format!(
        "a cylinder of this mass and radius has {} kg/m³ if it is as long as the yarn is wide, and of solids, up to {LONGEST} times\n\
         as long, {} to {}: mass, radius or width is most likely not in the units of the file, {}",
        number(density),
        known.start(),
        number(*known.end()),
        units.names().join("-")
    );
    Some(Finding::new("striker", text))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::impact::judgement::before;
    use crate::impact::scene::Scene;

    const YARN: &str = include_str!("../../../../program/assets/init/yarn.toml");

    fn parse(text: &str) -> Scene {
        Scene::parse("yarn.toml", text).expect("a scene")
    }

    /// The words and texts of what is found in each case of a scene.
    fn found(scene: &Scene) -> Vec<(Vec<&'static str>, String)> {
        let of_case = |case: &Case| {
            let findings = before(&scene.units, case);
            let texts: Vec<&str> = findings.iter().map(|finding| finding.text.as_str()).collect();
            (findings.iter().map(|finding| finding.name).collect(), texts.join("\n"))
        };
        scene.cases.iter().map(of_case).collect()
    }

    fn with(old: &str, new: &str) -> String {
        assert!(YARN.contains(old), "{old}");
        YARN.replace("my-yarn.toml", "kevlar-km2-600").replace(old, new)
    }

    #[test]
    fn slips_in_speed_sizes_stiffness_and_mass_are_found() {
        for (old, new, word, part) in [
            ("speed = 120.0", "speed = 0.12", "units", "is 0.1200 m/s, and yarns and panels are struck at"),
            ("mass = 9.91e-3", "mass = 9.91", "striker", "4.885e6 kg/m³ if it is as long"),
            ("mass = 9.91e-3", "mass = 9910.0", "striker", "mass, radius or width is most likely not in the units"),
            ("mass = 9.91e-3", "mass = 9.91e-6", "striker", " has 4.885 kg/m³"),
            ("contact-stiffness = 1e6", "contact-stiffness = 1e9", "units", "MPa/mm, and yarns take 1e3 to 1e7"),
            ("contact-stiffness = 1e6", "contact-stiffness = 1e2", "units", "MPa/mm, and yarns take 1e3 to 1e7"),
            ("friction = 0.18", "friction = 18", "friction", "friction is 18.00, and dry surfaces have 0 to 2"),
            ("radius = 1.1", "radius = 110.0", "sizes", "more than what the yarn reaches from the middle, 12.70 mm"),
            ("radius = 1.1", "radius = 11.0", "striker", " has 48.85 kg/m³"),
            ("radius = 1.1", "radius = 0.11", "striker", " has 4"),
            ("height = 0.115", "height = 1.15", "sizes", "1.150 mm high and 0.5337 mm wide, and yarns lie flat"),
        ] {
            let found = found(&parse(&with(old, new)));
            let is_found = |(names, text): &(Vec<&str>, String)| names.contains(&word) && text.contains(part);
            assert!(found.iter().any(is_found), "{new}: {found:?}");
        }
    }

    /// The mass of a cylinder that keeps its speed may be any.
    #[test]
    fn what_has_no_influence_is_not_looked_at() {
        let held = parse(&with("mass = 9.91e-3", "mass = 9910.0\nheld = true"));
        assert!(found(&held).iter().all(|(names, _)| names.is_empty()), "{:?}", found(&held));
    }

    #[test]
    fn the_examples_are_as_they_are_meant() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/yarn_impact");
        let files = std::fs::read_dir(folder).expect("a folder").map(|file| file.expect("a file").path());
        let mut scenes: Vec<Scene> = files.map(|file| Scene::read(&file).expect("a scene")).collect();
        assert!(scenes.len() > 10, "{}", scenes.len());
        scenes.push(parse(&with("my", "my")));
        for scene in &scenes {
            assert!(found(scene).iter().all(|(names, _)| names.is_empty()), "{}: {:?}", scene.title, found(scene));
        }
        let scene = &scenes[scenes.len() - 1];
        let said = text(&scene.units, &scene.cases[0]);
        assert!(said.starts_with("cylinder 4885 kg/m³ if it is as long as the yarn is wide; 651.4 dtex"), "{said}");
    }
}
