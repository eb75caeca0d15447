//! The speed of the wave along the fibre at rest: what shows a density or a stiffness that is in other units than the
//! rest.

use std::ops::RangeInclusive;

use super::laws::LawName;
use super::model::{Law, Material};
use crate::units::SPEED;
use toron::host::units::UnitSystem;
use toron_shared::numbers::number;

/// Speeds in fibres, in km/s, with a margin on both sides: nylon has 2, polyethylene 12, graphene would have 20.
const KNOWN: RangeInclusive<f64> = 1.0..=20.0;

/// A wave along the fibre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FibreWave {
    /// The formula of its speed.
    pub formula: &'static str,
    /// The stiffness that it takes.
    stiffness: &'static str,
    /// In km/s, whatever the units of the file.
    pub speed: f64,
}

impl FibreWave {
    /// The wave of a material in these units; none without a density or without stiffness, and none of a law of one's
    /// own, of which it is not known what resists it.
    pub fn of(material: &Material, units: &UnitSystem) -> Option<FibreWave> {
        let (law, stiffness) = match (&material.law, material.law.yarn()) {
            (_, Some(yarn)) => (LawName::Hyperelastic, yarn.k_el),
            (Law::LinearElastic { properties, .. }, None) => (LawName::LinearElastic, properties.e_1),
            (Law::Hyperelastic { .. } | Law::Own(_), None) => return None,
        };
        Self::along(law, stiffness, material.density?, units)
    }

    /// The wave in a yarn of this law with this stiffness along the fibre and this density, which are in these units.
    pub fn along(law: LawName, stiffness: f64, density: f64, units: &UnitSystem) -> Option<FibreWave> {
        let (name, formula) = match law {
            LawName::Hyperelastic => ("k_el", "√(k_el/density)"),
            LawName::LinearElastic => ("e_1", "√(e_1/density)"),
            LawName::Own(_) => return None,
        };
        let speed = (stiffness / density).sqrt();
        let speed_in_km = speed / units.from_si(1000.0, SPEED);
        (speed > 0.0).then_some(FibreWave { formula, stiffness: name, speed: speed_in_km })
    }

    /// A warning where no fibre has this speed: the units are likely wrong.
    pub fn unit_warning(&self, units: &UnitSystem) -> Option<String> {
        (!KNOWN.contains(&self.speed)).then(|| {
            format!(
                "the wave along the fibre has {} km/s, and fibres have {} to {}:\n\
                 density or {} is most likely not in the units of the file, {}",
                number(self.speed),
                KNOWN.start(),
                KNOWN.end(),
                self.stiffness,
                units.names().join("-")
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::file::{MaterialFile, read_material};
    use crate::material::laws::Laws;
    use toron_shared::toml_file::Source;

    /// The wave of the preset, but for these keys of its table.
    fn wave(units: &str, preset: &str, keys: &str) -> (Option<FibreWave>, UnitSystem) {
        let text = format!("preset = \"{preset}\"\n{keys}\n");
        let source = Source { name: "material.toml", text: &text };
        let units = UnitSystem::parse(units).expect("a unit system");
        let file: MaterialFile = source.parse().expect("the keys exist");
        let material = read_material(&source, Laws::Toron, &file, &units, 0..0).expect("the material is valid");
        (FibreWave::of(&material, &units), units)
    }

    #[test]
    fn the_speed_is_that_of_the_yarn_in_any_units() {
        for units in ["si", "mm-tonne-s", "mm-g-ms", "cm-g-us", "in-slinch-s"] {
            for (preset, speed) in [("kevlar-km2-600", 7.80578), ("kevlar-km2-600-linear", 7.66578)] {
                let (wave, units) = wave(units, preset, "");
                let wave = wave.expect("there is a density");
                assert!((wave.speed - speed).abs() < 1e-5, "{wave:?}");
                assert_eq!(wave.unit_warning(&units), None);
            }
        }
    }

    #[test]
    fn a_factor_of_a_thousand_is_told() {
        for (keys, speed) in [
            ("density = 1.3514e-6", "0.2468"),
            ("density = 1.3514e-12", "246.8"),
            ("properties = { k_el = 82.341 }", "0.2468"),
            ("properties = { k_el = 82341e3 }", "246.8"),
        ] {
            let (wave, units) = wave("mm-tonne-s", "kevlar-km2-600", keys);
            let unit_warning = wave.and_then(|wave| wave.unit_warning(&units)).expect(keys);
            let expected = format!(
                "the wave along the fibre has {speed} km/s, and fibres have 1 to 20:\n\
                 density or k_el is most likely not in the units of the file, mm-tonne-s"
            );
            assert_eq!(unit_warning, expected);
        }
        assert_eq!(wave("si", "kevlar-km2-600", "properties = { k_el = 0 }").0, None);
    }
}
