//! A manufacturer's data sheet in its own words: linear density, tenacity, modulus, filaments, each with its unit.

use serde::Deserialize;
use toml::Spanned;

use super::equivalence::{Constant, Fibre};
use super::report::digits;
use toron::host::units::UnitSystem;
use toron::law::parameters::{DENSITY, Dimension, NUMBER, STRESS};
use toron_materials::unit_expression::{self, Unit};
use toron_materials::units::{LENGTH, unit};
use toron_shared::checked::{Checked, Positive, value};
use toron_shared::error::Error;
use toron_shared::toml_file::Source;

const LINEAR_DENSITY: Dimension = Dimension { mass: 1, length: -1, time: 0, name: "linear density" };
/// Force by linear density, of which the density makes a stress.
const TENACITY: Dimension = Dimension { mass: 0, length: 2, time: -2, name: "tenacity" };
const AREA: Dimension = Dimension { mass: 0, length: 2, time: 0, name: "area" };
/// The strength over modulus times elongation at break: 1 of a fibre that is linear up to there.
const LINEAR: std::ops::RangeInclusive<f64> = 0.7..=1.3;

/// What fibres have, in SI units, with a margin: a value beyond is in another unit than it says, or of something else.
pub(super) struct Known {
    pub range: [f64; 2],
    pub text: &'static str,
}

/// Polypropylene 900 kg/m³, steel 7900; polyamide 2 GPa, pitch carbon 900; wool 0.15 GPa, carbon 7.
const DENSITIES: Known = Known { range: [800.0, 9000.0], text: "0.8 to 9 g/cm³, as fibres have" };
pub(super) const MODULI: Known = Known { range: [5e8, 1e12], text: "0.5 to 1000 GPa, as fibres have" };
const STRENGTHS: Known = Known { range: [5e7, 1.2e10], text: "0.05 to 12 GPa, as fibres have" };
/// Of one of several filaments: microfibres have 3 µm, coarse ones 50.
const DIAMETERS: Known = Known { range: [1e-6, 1e-4], text: "filaments of 1 to 100 µm" };

impl Known {
    /// # Errors
    /// A value that no fibre has; `says` is what the file has of it.
    fn check(&self, source: &Source, says: &str, value: f64, span: std::ops::Range<usize>) -> Result<(), Error> {
        let [least, most] = self.range;
        if (least..=most).contains(&value) {
            return Ok(());
        }
        Err(source.error(span, &format!("{says}; allowed: {}", self.text)))
    }
}

/// The thickness of a filament, of so many with sections of this area together.
fn diameter(solid: f64, filaments: u32) -> f64 {
    (4.0 * solid / (std::f64::consts::PI * f64::from(filaments))).sqrt()
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DataSheetFile {
    density: Spanned<String>,
    modulus: Spanned<String>,
    modulus_deviation: Option<Spanned<String>>,
    elongation_at_break: Spanned<String>,
    tenacity: Option<Spanned<String>>,
    linear_density: Option<Spanned<String>>,
    filaments: Option<Spanned<u32>>,
    volume_fraction: Option<Spanned<Positive>>,
    volume_fraction_deviation: Option<Positive>,
    /// Of the yarn's section, voids included.
    area: Option<Spanned<String>>,
}

/// What a data sheet says of a fibre and its yarn, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct DataSheet {
    density: f64,
    modulus: Constant,
    elongation: f64,
    strength: Option<f64>,
    /// Of all filaments' sections together.
    solid: Option<f64>,
    filaments: Option<u32>,
    volume_fraction: Constant,
}

impl DataSheet {
    pub(super) fn read(source: &Source, sheet: &Spanned<DataSheetFile>) -> Result<DataSheet, Error> {
        let file = sheet.get_ref();
        let one = |key: &str, text: &Spanned<String>, dimension| Ok(quantity(source, key, text, &[dimension])?.0);
        let density = one("density", &file.density, DENSITY)?;
        let check = |known: &Known, key: &str, text: &Spanned<String>, value: f64| {
            known.check(source, &format!("{key} is \"{}\"", text.get_ref()), value, text.span())
        };
        check(&DENSITIES, "density", &file.density, density)?;
        let stress = |key: &str, text: &Spanned<String>| {
            let (value, dimension) = quantity(source, key, text, &[STRESS, TENACITY])?;
            Ok::<f64, Error>(if dimension == TENACITY { density * value } else { value })
        };
        let modulus = stress("modulus", &file.modulus)?;
        check(&MODULI, "modulus", &file.modulus, modulus)?;
        let strength = file.tenacity.as_ref().map(|text| stress("tenacity", text)).transpose()?;
        if let Some((text, strength)) = file.tenacity.as_ref().zip(strength) {
            check(&STRENGTHS, "tenacity", text, strength)?;
        }
        let elongation = one("elongation_at_break", &file.elongation_at_break, NUMBER)?;
        if elongation > 1.0 {
            let message =
                format!("elongation_at_break is {}; allowed: at most \"100 %\"", file.elongation_at_break.get_ref());
            return Err(source.error(file.elongation_at_break.span(), &message));
        }
        let linear_density =
            file.linear_density.as_ref().map(|text| one("linear_density", text, LINEAR_DENSITY)).transpose()?;
        let solid = linear_density.map(|linear_density| linear_density / density);
        let area = file.area.as_ref().map(|text| one("area", text, AREA)).transpose()?;
        let (fraction, span) = match (&file.volume_fraction, &file.area, solid.zip(area)) {
            (Some(given), None, _) => (given.value(), given.span()),
            (None, Some(text), Some((solid, area))) => (solid / area, text.span()),
            (None, Some(text), None) => {
                return Err(
                    source.error(text.span(), "area tells the fibres' fraction of it beside linear_density only")
                );
            }
            _ => {
                let message = "allowed: volume_fraction, the fibres' part of the yarn's section, or area, that of the section \
                               with its voids: one of the two";
                return Err(source.error(sheet.span(), message));
            }
        };
        if fraction > 1.0 {
            let message = format!("the fibres would be {fraction:.4} of the yarn's section; allowed: at most 1");
            return Err(source.error(span, &message));
        }
        let deviation = value(&file.volume_fraction_deviation).unwrap_or(0.0);
        let modulus_deviation =
            file.modulus_deviation.as_ref().map_or(Ok(0.0), |text| stress("modulus_deviation", text))?;
        if let Some(filaments) = file.filaments.as_ref().filter(|filaments| *filaments.get_ref() == 0) {
            return Err(source.error(filaments.span(), "filaments is 0; allowed: a whole number from 1"));
        }
        if let (Some(text), Some(solid), Some(filaments)) = (&file.linear_density, solid, &file.filaments)
            && *filaments.get_ref() > 1
        {
            let diameter = diameter(solid, *filaments.get_ref());
            let each = format!("each of {} filaments {} µm thick", filaments.get_ref(), digits(1e6 * diameter));
            DIAMETERS.check(
                source,
                &format!("linear_density is \"{}\", {each}", text.get_ref()),
                diameter,
                text.span(),
            )?;
        }
        Ok(DataSheet {
            density,
            modulus: Constant { value: modulus, deviation: modulus_deviation },
            elongation,
            strength,
            solid,
            filaments: file.filaments.as_ref().map(|filaments| *filaments.get_ref()),
            volume_fraction: Constant { value: fraction, deviation },
        })
    }

    /// What `[fibre]` would say, in these units.
    pub fn fibre(&self, units: &UnitSystem) -> Fibre {
        let stress = |value: f64| units.from_si(value, STRESS);
        Fibre {
            modulus: Constant { value: stress(self.modulus.value), deviation: stress(self.modulus.deviation) },
            volume_fraction: self.volume_fraction,
            strain_at_failure: Constant { value: self.elongation, deviation: 0.0 },
        }
    }

    /// The yarn's, in these units: that of the fibres in their part of the section.
    pub fn density(&self, units: &UnitSystem) -> f64 {
        units.from_si(self.density * self.volume_fraction.value, DENSITY)
    }

    /// What the sheet says in these units, where one looks for a slip.
    pub fn summary(&self, units: &UnitSystem) -> String {
        let text = |value: f64, dimension: Dimension| {
            format!("{} {}", digits(units.from_si(value, dimension)), unit(units, dimension))
        };
        let mut parts = vec![format!("the fibre has a modulus of {}", text(self.modulus.value, STRESS))];
        parts.extend(self.strength.map(|strength| format!("a strength of {}", text(strength, STRESS))));
        let diameter = self.solid.zip(self.filaments).map(|(solid, filaments)| diameter(solid, filaments));
        parts.extend(diameter.map(|diameter| format!("a diameter of {}", text(diameter, LENGTH))));
        let mut summary = parts.join(", ");
        if let Some(solid) = self.solid {
            let [length, ..] = units.names();
            let [solid, section] =
                [solid, solid / self.volume_fraction.value].map(|area| digits(units.from_si(area, AREA)));
            summary +=
                &format!("; the fibres' sections are {solid} {length}², the yarn's with its voids {section} {length}²");
        }
        summary
    }

    /// Where strength, modulus and elongation at break are not those of one fibre.
    pub fn warning(&self) -> Option<String> {
        let strain = self.strength? / self.modulus.value;
        (!LINEAR.contains(&(strain / self.elongation))).then(|| {
            format!(
                "tenacity over modulus is a strain of {:.2} %, elongation_at_break is {:.2} %: no fibre of these kinds bends so much; one \
                 of the three is most likely in another unit, or of another grade",
                100.0 * strain,
                100.0 * self.elongation
            )
        })
    }
}

/// A positive number with a unit of one of these dimensions, in SI units.
fn quantity(
    source: &Source,
    key: &str,
    text: &Spanned<String>,
    dimensions: &[Dimension],
) -> Result<(f64, Dimension), Error> {
    let written = text.get_ref().trim();
    let (number, name) = written.split_once(char::is_whitespace).unwrap_or((written, ""));
    // The gram of g/den is a force.
    let name = name.trim();
    let force = name.strip_prefix("g/").filter(|_| dimensions.contains(&TENACITY)).map(|rest| format!("gf/{rest}"));
    let unit = Unit::parse(force.as_deref().unwrap_or(name));
    let value = number.parse().ok().filter(|value: &f64| value.is_finite() && *value > 0.0);
    if let (Some(value), Ok(unit)) = (value, &unit)
        && let Some(&dimension) = dimensions.iter().find(|&&dimension| unit.measures(dimension))
    {
        return Ok((unit.convert(value, &UnitSystem::SI), dimension));
    }
    let example = match dimensions[0] {
        DENSITY => "\"1.44 g/cm³\"",
        STRESS => "\"112 GPa\", \"720 cN/dtex\", \"23 g/den\"",
        LINEAR_DENSITY => "\"1270 dtex\", \"1140 den\"",
        AREA => "\"0.09 mm²\"",
        _ => "\"2.4 %\"",
    };
    let why = unit.err().map_or(String::new(), |why| format!(" ({why}; known are {})", unit_expression::ALLOWED));
    let message = format!("{key} is \"{written}\"; allowed: a number > 0, a blank and a unit, as {example}{why}");
    Err(source.error(text.span(), &message))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<DataSheet, String> {
        let source = Source { name: "sheet.toml", text };
        let file: Spanned<DataSheetFile> = Spanned::new(0..1, source.parse().map_err(|error| error.to_string())?);
        DataSheet::read(&source, &file).map_err(|error| error.to_string())
    }

    const SHEET: &str = "linear_density = \"1140 den\"\nfilaments = 768\ndensity = \"1.44 g/cm³\"\ntenacity = \"23.6 g/den\"\n\
                         modulus = \"885 gf/denier\"\nelongation_at_break = \"2.4 %\"\nvolume_fraction = 0.9\n";

    #[test]
    fn a_sheet_s_own_words_are_understood() {
        let sheet = read(SHEET).expect("a sheet");
        // A gram-force by denier is 9.80665e-3 N / (1e-3/9000 kg/m).
        let by_denier = 9.80665e-3 * 9e6 * 1440.0;
        approx::assert_relative_eq!(sheet.modulus.value, 885.0 * by_denier, max_relative = 1e-12);
        approx::assert_relative_eq!(sheet.strength.expect("one"), 23.6 * by_denier, max_relative = 1e-12);
        approx::assert_relative_eq!(sheet.solid.expect("one"), 1140.0 / 9e6 / 1440.0, max_relative = 1e-12);
        let units = UnitSystem::parse("mm-tonne-s").expect("units");
        approx::assert_relative_eq!(sheet.density(&units), 1.296e-9, max_relative = 1e-12);
        approx::assert_relative_eq!(sheet.fibre(&units).modulus.value, 885.0 * by_denier / 1e6, max_relative = 1e-12);
        assert_eq!(sheet.warning(), None);
        let summary = sheet.summary(&units);
        assert!(summary.contains("a diameter of 0.012076 mm") && summary.contains("0.087963 mm²"), "{summary}");
        // The same fibre in other words.
        let metric = SHEET.replace("1140 den", "126.6666666666667 tex").replace("885 gf/denier", "781.099673 cN/dtex");
        let other = read(&metric.replace("volume_fraction = 0.9", "area = \"0.0977366255 mm^2\"")).expect("a sheet");
        approx::assert_relative_eq!(other.modulus.value, sheet.modulus.value, max_relative = 1e-8);
        approx::assert_relative_eq!(other.volume_fraction.value, 0.9, max_relative = 1e-8);
    }

    #[test]
    fn what_is_wrong_on_a_sheet_is_named() {
        for (from, to, message) in [
            ("23.6 g/den", "23.6 g/cm", "4: tenacity is \"23.6 g/cm\"; allowed: a number > 0, a blank and a unit"),
            ("885 gf/denier", "885", "5: modulus is \"885\"; allowed"),
            ("885 gf/denier", "885 cN/dtx", "\"dtx\" is not known"),
            ("1140 den", "-1140 den", "1: linear_density is \"-1140 den\""),
            ("2.4 %", "240 %", "6: elongation_at_break is 240 %; allowed: at most"),
            ("volume_fraction = 0.9", "volume_fraction = 1.2", "7: the fibres would be 1.2000 of the yarn's section"),
            ("volume_fraction = 0.9", "", "allowed: volume_fraction"),
            ("filaments = 768", "filaments = 0", "2: filaments is 0; allowed: a whole number from 1"),
            // A thousand times too much or too little.
            ("1.44 g/cm³", "1440 g/cm³", "3: density is \"1440 g/cm³\"; allowed: 0.8 to 9 g/cm³, as fibres have"),
            ("1.44 g/cm³", "1.44 kg/m³", "3: density is \"1.44 kg/m³\"; allowed: 0.8 to 9 g/cm³"),
            ("885 gf/denier", "112 TPa", "5: modulus is \"112 TPa\"; allowed: 0.5 to 1000 GPa, as fibres have"),
            ("885 gf/denier", "112 MPa", "5: modulus is \"112 MPa\"; allowed: 0.5 to 1000 GPa"),
            ("23.6 g/den", "3.6 MPa", "4: tenacity is \"3.6 MPa\"; allowed: 0.05 to 12 GPa, as fibres have"),
            ("23.6 g/den", "3.6 TPa", "4: tenacity is \"3.6 TPa\"; allowed: 0.05 to 12 GPa"),
            ("1140 den", "1.27 dtex", "1: linear_density is \"1.27 dtex\", each of 768 filaments 0.3"),
            ("1140 den", "127 ktex", "1: linear_density is \"127 ktex\", each of 768 filaments 382"),
        ] {
            let error = read(&SHEET.replace(from, to)).expect_err(to);
            assert!(error.contains(message), "{error}");
        }
        let sheet = read(&SHEET.replace("23.6 g/den", "23.6 cN/dtex").replace("2.4 %", "24 %")).expect("a sheet");
        assert!(sheet.warning().expect("a warning").contains("elongation_at_break is 24.00 %"));
    }
}
