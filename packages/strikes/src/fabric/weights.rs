//! What panel and striker weigh, in figures that are known of both: a slip in a size, a mass or a unit shows in them.

use std::ops::RangeInclusive;

use super::scene::Case;
use crate::weave::figures::Figures;
use crate::weave::geometry::Family;
use crate::weave::model::Model;
use crate::weave::weights::PlyWeight;
use toron::host::units::UnitSystem;
use toron_explicit_host::contact::Shape;
use toron_explicit_host::judgement::Finding;
use toron_explicit_host::struck::blow;
use toron_shared::numbers::number;

/// What steels have, in kg/m³.
const STEEL: RangeInclusive<f64> = 7.6e3..=8.2e3;
/// By how much a sphere is too light whose diameter was taken for its radius.
const DIAMETER_FOR_RADIUS: f64 = 8.0;

/// The weights of a case, in words for the report.
pub fn text(units: &UnitSystem, case: &Case, panel: &Model) -> String {
    let striker = case
        .striker_density
        .density
        .map_or(String::new(), |density| format!("{} {} kg/m³; ", case.striker.shape.name(), number(density)));
    striker + &PlyWeight::text(&plies(units, case, panel))
}

fn plies(units: &UnitSystem, case: &Case, panel: &Model) -> Vec<PlyWeight> {
    let figures = case.cloth.figures(panel).into_iter().zip(case.cloth.pitches());
    let weight = |(ply, (figures, pitches)): (usize, (Figures, [f64; 2]))| {
        let densities = Family::BOTH.map(|family| case.material(ply, family).density.unwrap_or_default());
        PlyWeight::of(&figures, pitches, densities, units)
    };
    figures.enumerate().map(weight).collect()
}

/// Weights and sizes that cannot be meant.
pub fn findings(units: &UnitSystem, case: &Case, panel: &Model) -> Vec<Finding> {
    let mut findings: Vec<Finding> = Vec::new();
    for text in plies(units, case, panel).iter().flat_map(|ply| ply.warnings(units)) {
        let finding = Finding::new("units", text);
        if !findings.contains(&finding) {
            findings.push(finding);
        }
    }
    let Case { striker, speed, .. } = case;
    findings.extend(blow::slow_or_fast(units, *speed));
    findings.extend(blow::soft_or_hard(units, striker.stiffness));
    findings.extend(blow::rough("friction", striker.friction));
    findings.extend(blow::rough("yarn-friction", case.mutual.friction));
    findings.extend(blow::large(units, striker, "panel", reach(panel)));
    findings.extend(striker_density(case));
    findings
}

/// How far the panel reaches from its middle along the axes: a corner is no measure, and a strip may be narrow.
fn reach(panel: &Model) -> f64 {
    panel.nodes.iter().flat_map(|[x, y, _]| [x.abs(), y.abs()]).fold(0.0, f64::max)
}

/// A density that is not steel's, where nothing says that it is meant.
fn striker_density(case: &Case) -> Option<Finding> {
    let density =
        case.striker_density.density.filter(|density| !case.striker_density.is_told && !STEEL.contains(density))?;
    let name = case.striker.shape.name();
    let hint = if case.striker.shape == Shape::Sphere && STEEL.contains(&(DIAMETER_FOR_RADIUS * density)) {
        "is radius the diameter? With half of it that is steel"
    } else {
        "of another material give striker-density, and no warning is said"
    };
    let text = format!(
        "the {name}'s mass and sizes make {} kg/m³, and steel has {} to {}:\n{hint}",
        number(density),
        STEEL.start(),
        STEEL.end()
    );
    Some(Finding::new("striker", text))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fabric::scene::Scene;

    /// A patch with a panel of this radius under a blow.
    fn scene(panel: f64, weave: &str, blow: &str) -> String {
        format!(
            "units = \"mm-g-ms\"\n[weave]\nalong = 4\ncolumns = 4\n{weave}\n\
             [weave.panel]\nshape = \"circle\"\nradius = {panel}\npart = \"quarter\"\n[scene]\nend = 1.0\n{blow}\n"
        )
    }

    const PRESET: &str = "preset = \"kevlar-s706\"";
    const BLOW: &str = "speed = 60.0\nmass = 0.692\nradius = 2.778\ncontact-stiffness = 1e5";

    /// The words and texts of what is found, and what is said of the weights.
    fn found(text: &str) -> (Vec<&'static str>, String, String) {
        let scene = Scene::parse("patch.toml", text).expect("a scene");
        let (case, panel) = (&scene.cases[0], scene.cases[0].cloth.model());
        let findings = findings(&scene.units, case, &panel);
        let texts: Vec<&str> = findings.iter().map(|finding| finding.text.as_str()).collect();
        (
            findings.iter().map(|finding| finding.name).collect(),
            texts.join("\n"),
            super::text(&scene.units, case, &panel),
        )
    }

    #[test]
    fn weights_are_said_and_what_cannot_be_meant_is_found() {
        let (names, _, said) = found(&scene(3.0, PRESET, BLOW));
        assert!(names.is_empty(), "{names:?}");
        for part in ["sphere 7706 kg/m³; panel 0.17", " kg/m²; warp and weft 651.", " dtex of 1351 kg/m³"] {
            assert!(said.contains(part), "{said}");
        }
        let inches = "pattern = \"plain\"\n[weave.warp]\npitch = 0.0294\nwidth = 0.021\nheight = 0.0045";
        let tungsten = BLOW.replace("mass = 0.692", "striker-density = 19.2e-3");
        for (text, word, part) in [
            (scene(3.0, PRESET, &BLOW.replace("2.778", "5.556")), "striker", "is radius the diameter?"),
            (scene(3.0, PRESET, &BLOW.replace("0.692", "0.346")), "striker", "give striker-density"),
            (
                scene(3.0, PRESET, &BLOW.replace("60.0", "0.06")),
                "units",
                "is 0.06000 m/s, and yarns and panels are struck at",
            ),
            (scene(3.0, PRESET, &BLOW.replace("1e5", "1e2")), "units", "100.0 MPa/mm, and yarns take"),
            (
                scene(3.0, PRESET, &format!("{BLOW}\nfriction = 23")),
                "friction",
                "friction is 23.00, and dry surfaces have 0 to 2",
            ),
            (scene(3.0, PRESET, &format!("{BLOW}\nyarn-friction = 18")), "friction", "yarn-friction is 18.00, and dry"),
            (scene(1.2, PRESET, BLOW), "sizes", "sphere's radius of 2.778 mm is more than what the panel reaches"),
            (scene(0.15, inches, BLOW), "units", "dtex, and yarns 10.00 to 60000"),
        ] {
            let (names, texts, _) = found(&text);
            assert!(names.contains(&word) && texts.contains(part), "{word}: {names:?} {texts}");
        }
        assert!(found(&scene(3.0, PRESET, &tungsten)).0.is_empty(), "the file says what it is");
    }

    #[test]
    fn a_mass_and_a_density_that_differ_are_refused() {
        let with = |density: &str| {
            let text = scene(3.0, PRESET, &format!("{BLOW}\nstriker-density = {density}"));
            Scene::parse("patch.toml", &text).map(|scene| scene.cases[0].mass).map_err(|error| error.to_string())
        };
        assert_eq!(with("7.7e-3"), Ok(0.692));
        let refused = "patch.toml:13: mass is 0.692, and striker-density 0.0027 with the sizes of the sphere makes 0.2425; allowed: one";
        assert!(with("2.7e-3").is_err_and(|error| error.starts_with(refused)), "{:?}", with("2.7e-3"));
        let wrong = "patch.toml:16: striker-density is 7.7; allowed: what solids have, 1.000e-4 to 0.02300";
        assert!(with("7.7").is_err_and(|error| error.starts_with(wrong)), "{:?}", with("7.7"));
    }
}
