//! The linear density of a yarn in dtex, which every data sheet has: a slip in a size of the section, or in the
//! density, shows in it.

use std::ops::RangeInclusive;

use toron::host::units::UnitSystem;
use toron::law::parameters::{DENSITY, Dimension};
use toron_shared::numbers::number;

const MASS_BY_LENGTH: Dimension = Dimension { mass: 1, length: -1, time: 0, name: "linear density" };
/// A tex is a gram a kilometre.
const DTEX: f64 = 1e-7;
/// What yarns have that are woven, in dtex, with a margin on both sides: the finest silk 13, rovings of glass 48 000.
const KNOWN: RangeInclusive<f64> = 10.0..=60e3;

/// A yarn's linear density in dtex, and its density with its voids in kg/m³.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearDensity {
    pub dtex: f64,
    pub density: f64,
}

impl LinearDensity {
    /// Of a yarn with a section of this area and this density, in these units.
    pub fn of(section: f64, density: f64, units: &UnitSystem) -> LinearDensity {
        LinearDensity {
            dtex: section * density / units.from_si(DTEX, MASS_BY_LENGTH),
            density: density / units.from_si(1.0, DENSITY),
        }
    }

    /// As `651.4 dtex of 1351 kg/m³`.
    pub fn text(&self) -> String {
        format!("{} dtex of {} kg/m³", number(self.dtex), number(self.density))
    }

    /// A warning where no yarn has this linear density: a size or the units are likely wrong.
    pub fn warning(&self, units: &UnitSystem) -> Option<String> {
        (!KNOWN.contains(&self.dtex)).then(|| {
            format!(
                "a yarn has {} dtex, and yarns {} to {}:\n\
                 its width, its height or its density is most likely not in the units of the file, {}",
                number(self.dtex),
                number(*KNOWN.start()),
                number(*KNOWN.end()),
                units.names().join("-")
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 600 denier of Kevlar KM2 in a section of 0.5337 by 0.115 mm.
    #[test]
    fn a_yarn_has_its_linear_density_whatever_the_units() {
        let section = std::f64::consts::FRAC_PI_4 * 0.5337 * 0.115;
        let of = |units: &str, section: f64, density: f64| {
            let units = UnitSystem::parse(units).expect("a system");
            let yarn = LinearDensity::of(section, density, &units);
            (yarn.text(), yarn.warning(&units).is_some())
        };
        let right = ("651.4 dtex of 1351 kg/m³".to_string(), false);
        assert_eq!(of("mm-g-ms", section, 1.3514e-3), right);
        assert_eq!(of("si", 1e-6 * section, 1351.4), right);
        // Inches taken for millimetres, and a density in g/cm³.
        assert!(of("mm-g-ms", section / 25.4_f64.powi(2), 1.3514e-3).1);
        assert!(of("mm-g-ms", section * 25.4_f64.powi(2), 1.3514e-3).1);
        assert!(of("mm-g-ms", section, 1.3514).1);
    }
}
