//! A manufacturer's data sheet in its own words: linear density, tenacity, modulus, filaments, each with its unit.

use std::cell::RefCell;

use serde::Deserialize;

use super::equivalence::{Constant, Fibre};
use super::report::digits;
use toron::host::units::UnitSystem;
use toron::law::parameters::{DENSITY, Dimension, NUMBER, STRESS};
use toron_materials::unit_expression::{self, Unit};
use toron_materials::units::{LENGTH, unit};
use toron_shared::checked::{Checked, Positive, value};
use toron_shared::error::Error;
use toron_shared::spanned::Spanned;
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
/// Of yarns, voids included.
pub(super) const YARN_DENSITIES: Known =
    Known { range: [200.0, 9000.0], text: "0.2 to 9 g/cm³, as yarns of fibres have" };
/// Pitch carbon fails at 0.3 %, drawn fibres before they are twice as long.
pub(super) const STRAINS: Known = Known { range: [1e-3, 1.0], text: "0.1 to 100 %, as fibres have" };
pub(super) const STRENGTHS: Known = Known { range: [5e7, 1.2e10], text: "0.05 to 12 GPa, as fibres have" };
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
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub(super) struct DataSheetFile {
    /// `"1.44 g/cm³"`, of the fibre; times the volume fraction it is the yarn's.
    density: Spanned<String>,
    /// `"720 cN/dtex"`, `"885 g/den"`, `"112 GPa"`.
    modulus: Spanned<String>,
    /// Standard deviation of the modulus, `"6 N/tex"`. Default: exact.
    modulus_deviation: Option<Spanned<String>>,
    /// `"2.4 %"`.
    elongation_at_break: Spanned<String>,
    /// `"208 cN/tex"`, `"23.6 g/den"`, `"3.6 GPa"`: compared with modulus and elongation. Default: not compared.
    tenacity: Option<Spanned<String>>,
    /// `"1270 dtex"`, `"1140 den"`: for the sections in the summary.
    linear_density: Option<Spanned<String>>,
    /// `768`: for the filaments' diameter in the summary.
    filaments: Option<Spanned<u32>>,
    /// Of the fibres in the yarn, `0.9`; this or `area` is needed.
    volume_fraction: Option<Spanned<Positive>>,
    /// Standard deviation of the volume fraction, `0.03`. Default: exact.
    volume_fraction_deviation: Option<Positive>,
    /// Of the yarn's section with its voids, `"0.098 mm²"`, beside `linear_density`.
    area: Option<Spanned<String>>,
}

/// What a data sheet says of a fibre and its yarn, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct DataSheet {
    density: f64,
    modulus: Constant,
    elongation: Constant,
    strength: Option<f64>,
    /// Of all filaments' sections together.
    solid: Option<f64>,
    filaments: Option<u32>,
    volume_fraction: Constant,
    /// What its words were taken for.
    pub said: Vec<String>,
}

impl DataSheet {
    pub(super) fn read(source: &Source, sheet: &Spanned<DataSheetFile>) -> Result<DataSheet, Error> {
        let file = sheet.get_ref();
        let said = RefCell::new(Vec::new());
        let read = |key: &str, text: &Spanned<String>, dimensions: &[Dimension]| {
            let found = quantity(source, key, text, dimensions)?;
            said.borrow_mut().extend(found.said(key, text.get_ref()));
            Ok::<Quantity, Error>(found)
        };
        let one = |key: &str, text: &Spanned<String>, dimension| Ok(read(key, text, &[dimension])?.value);
        let density = one("density", &file.density, DENSITY)?;
        let check = |known: &Known, key: &str, text: &Spanned<String>, value: f64| {
            known.check(source, &format!("{key} is \"{}\"", text.get_ref()), value, text.span())
        };
        check(&DENSITIES, "density", &file.density, density)?;
        let stress = |key: &str, text: &Spanned<String>| {
            let found = read(key, text, &[STRESS, TENACITY])?;
            let factor = if found.dimension == TENACITY { density } else { 1.0 };
            Ok::<Constant, Error>(Constant { value: factor * found.value, deviation: factor * found.deviation })
        };
        let mut modulus = stress("modulus", &file.modulus)?;
        check(&MODULI, "modulus", &file.modulus, modulus.value)?;
        if let Some(text) = &file.modulus_deviation {
            let deviation = stress("modulus_deviation", text)?;
            if modulus.deviation > 0.0 || deviation.deviation > 0.0 {
                let message = "modulus_deviation beside a range, or as one; allowed: a number and a unit, beside a number and a unit";
                return Err(source.error(text.span(), message));
            }
            modulus.deviation = deviation.value;
        }
        let strength = file.tenacity.as_ref().map(|text| Ok(stress("tenacity", text)?.value)).transpose()?;
        if let Some((text, strength)) = file.tenacity.as_ref().zip(strength) {
            check(&STRENGTHS, "tenacity", text, strength)?;
        }
        let elongation = read("elongation_at_break", &file.elongation_at_break, &[NUMBER])?;
        let elongation = Constant { value: elongation.value, deviation: elongation.deviation };
        if elongation.value > 1.0 {
            let message =
                format!("elongation_at_break is {}; allowed: at most \"100 %\"", file.elongation_at_break.get_ref());
            return Err(source.error(file.elongation_at_break.span(), &message));
        }
        let linear_density =
            file.linear_density.as_ref().map(|text| one("linear_density", text, LINEAR_DENSITY)).transpose()?;
        let solid = linear_density.map(|linear_density| linear_density / density);
        let area = file.area.as_ref().map(|text| one("area", text, AREA)).transpose()?;
        let fraction = fraction(source, sheet, solid.zip(area))?;
        let deviation = value(&file.volume_fraction_deviation).unwrap_or(0.0);
        check_filaments(source, file, solid)?;
        Ok(DataSheet {
            density,
            modulus,
            elongation,
            strength,
            solid,
            filaments: file.filaments.as_ref().map(|filaments| *filaments.get_ref()),
            volume_fraction: Constant { value: fraction, deviation },
            said: said.into_inner(),
        })
    }

    /// What `[fibre]` would say, in these units.
    pub fn fibre(&self, units: &UnitSystem) -> Fibre {
        let stress = |value: f64| units.from_si(value, STRESS);
        Fibre {
            modulus: Constant { value: stress(self.modulus.value), deviation: stress(self.modulus.deviation) },
            volume_fraction: self.volume_fraction,
            strain_at_failure: self.elongation,
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
        (!LINEAR.contains(&(strain / self.elongation.value))).then(|| {
            format!(
                "tenacity over modulus is a strain of {:.2} %, elongation_at_break is {:.2} %: no fibre of these kinds bends so much; one \
                 of the three is most likely in another unit, or of another grade",
                100.0 * strain,
                100.0 * self.elongation.value
            )
        })
    }
}

/// The fibres' part of the yarn's section: as given, or by the sections of the fibres and of the yarn, `solid_and_area`.
///
/// # Errors
/// Both are given or neither, or the part is more than the whole.
fn fraction(source: &Source, sheet: &Spanned<DataSheetFile>, solid_and_area: Option<(f64, f64)>) -> Result<f64, Error> {
    let file = sheet.get_ref();
    let (fraction, span) = match (&file.volume_fraction, &file.area, solid_and_area) {
        (Some(given), None, _) => (given.value(), given.span()),
        (None, Some(text), Some((solid, area))) => (solid / area, text.span()),
        (None, Some(text), None) => {
            return Err(source.error(text.span(), "area tells the fibres' fraction of it beside linear_density only"));
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
    Ok(fraction)
}

/// Checks the number of filaments, and how thick each is in the fibres' section `solid`.
///
/// # Errors
/// There are none, or they are thinner or thicker than any fibre is.
fn check_filaments(source: &Source, file: &DataSheetFile, solid: Option<f64>) -> Result<(), Error> {
    if let Some(filaments) = file.filaments.as_ref().filter(|filaments| *filaments.get_ref() == 0) {
        return Err(source.error(filaments.span(), "filaments is 0; allowed: a whole number from 1"));
    }
    if let (Some(text), Some(solid), Some(filaments)) = (&file.linear_density, solid, &file.filaments)
        && *filaments.get_ref() > 1
    {
        let diameter = diameter(solid, *filaments.get_ref());
        let each = format!("each of {} filaments {} µm thick", filaments.get_ref(), digits(1e6 * diameter));
        let what = format!("linear_density is \"{}\", {each}", text.get_ref());
        DIAMETERS.check(source, &what, diameter, text.span())?;
    }
    Ok(())
}

/// A quantity of a sheet, in SI units.
struct Quantity {
    value: f64,
    /// Of a range, as of numbers that are spread evenly over it.
    deviation: f64,
    dimension: Dimension,
    /// The force that a mass was taken for.
    force: Option<String>,
}

impl Quantity {
    /// What the words were taken for, where that is not plain.
    fn said(&self, key: &str, text: &str) -> Option<String> {
        let percent = 100.0 * self.deviation / self.value;
        let range = (self.deviation > 0.0)
            .then(|| format!("the middle of the range, with a standard deviation of {percent:.2} % of it"));
        let force = self.force.as_ref().map(|force| format!("its unit is taken for {force}"));
        let said: Vec<String> = range.into_iter().chain(force).collect();
        (!said.is_empty()).then(|| format!("{key} = \"{text}\": {}", said.join("; ")))
    }
}

/// A positive number, or a range of them, with a unit of one of these dimensions.
fn quantity(source: &Source, key: &str, text: &Spanned<String>, dimensions: &[Dimension]) -> Result<Quantity, Error> {
    let written = text.get_ref().trim();
    let plain = || {
        let (number, name) = written.split_once(char::is_whitespace).unwrap_or((written, ""));
        let number = number.parse().ok().filter(|value: &f64| value.is_finite() && *value > 0.0);
        (number.map(|value| [value; 2]), name)
    };
    let (ends, name) = range(written).map_or_else(plain, |(ends, name)| (Some(ends), name));
    let name = name.trim();
    let force = name.strip_prefix("g/").filter(|_| dimensions.contains(&TENACITY)).map(|rest| format!("gf/{rest}"));
    let unit = Unit::parse(force.as_deref().unwrap_or(name));
    let of = |unit: &Unit| dimensions.iter().copied().find(|&dimension| unit.measures(dimension));
    if let (Some(ends), Ok(unit)) = (ends, &unit) {
        let force = if of(unit).is_none() { unit.as_force() } else { None };
        let taken = force.as_ref().unwrap_or(unit);
        if let Some(dimension) = of(taken) {
            let [low, high] = ends.map(|end| taken.convert(end, &UnitSystem::SI));
            let (value, deviation) = (0.5 * (low + high), 0.5 * (high - low) / 3.0_f64.sqrt());
            return Ok(Quantity { value, deviation, dimension, force: force.map(|force| force.text) });
        }
    }
    let example = match dimensions[0] {
        DENSITY => "\"1.44 g/cm³\"",
        STRESS => "\"112 GPa\", \"720 cN/dtex\", \"23 g/den\"",
        LINEAR_DENSITY => "\"1270 dtex\", \"1140 den\"",
        AREA => "\"0.09 mm²\"",
        _ => "\"2.4 %\"",
    };
    let why = unit.err().map_or(String::new(), |why| format!(" ({why}; known are {})", unit_expression::ALLOWED));
    let message = format!(
        "{key} is \"{written}\"; allowed: a number > 0 or a range of two, a blank and a unit, as {example}{why}"
    );
    Err(source.error(text.span(), &message))
}

/// `112–137 N/tex`: two numbers, the second one larger, and what follows.
fn range(text: &str) -> Option<([f64; 2], &str)> {
    let leading = |text: &'_ str| {
        let end = text.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(text.len());
        text[..end].parse().ok().filter(|value: &f64| value.is_finite() && *value > 0.0).map(|value| (value, end))
    };
    let (low, end) = leading(text)?;
    let rest = text[end..].trim_start();
    let rest = ["–", "—", "-", "…", "to "].into_iter().find_map(|sign| rest.strip_prefix(sign))?.trim_start();
    let (high, end) = leading(rest)?;
    let unit = &rest[end..];
    (high > low && unit.starts_with(char::is_whitespace)).then_some(([low, high], unit))
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

    /// Sheets have ranges, and some write a kilogram for its weight.
    #[test]
    fn ranges_are_their_middle_and_a_deviation() {
        for text in ["78–85 N/tex", "78-85 N/tex", "78 – 85 N/tex", "78 to 85 N/tex"] {
            let sheet = read(&SHEET.replace("885 gf/denier", text)).expect("a sheet");
            let [middle, deviation] = [81.5, 3.5 / 3.0_f64.sqrt()].map(|value| 1e6 * 1440.0 * value);
            approx::assert_relative_eq!(sheet.modulus.value, middle, max_relative = 1e-12);
            approx::assert_relative_eq!(sheet.modulus.deviation, deviation, max_relative = 1e-12);
            let said =
                format!("modulus = \"{text}\": the middle of the range, with a standard deviation of 2.48 % of it");
            assert_eq!(sheet.said, [said]);
        }
        let sheet =
            read(&SHEET.replace("2.4 %", "2.2–2.6 %").replace("885 gf/denier", "11400 kg/mm2")).expect("a sheet");
        approx::assert_relative_eq!(sheet.elongation.value, 0.024, max_relative = 1e-12);
        approx::assert_relative_eq!(sheet.elongation.deviation, 0.002 / 3.0_f64.sqrt(), max_relative = 1e-12);
        approx::assert_relative_eq!(sheet.modulus.value, 11400.0 * 9.80665e6, max_relative = 1e-12);
        assert_eq!(sheet.said[0], "modulus = \"11400 kg/mm2\": its unit is taken for kgf/mm2");
        let sheet = read(&SHEET.replace("1.44 g/cm³", "0.052 lb/cu. in.")).expect("a sheet");
        approx::assert_relative_eq!(sheet.density, 0.052 * 0.45359237 / 0.0254_f64.powi(3), max_relative = 1e-12);
        let both = SHEET.replace("885 gf/denier\"", "78–85 N/tex\"\nmodulus_deviation = \"2 N/tex\"");
        assert!(read(&both).expect_err("both").contains("6: modulus_deviation beside a range"), "{both}");
    }

    #[test]
    fn what_is_wrong_on_a_sheet_is_named() {
        for (from, to, message) in [
            (
                "23.6 g/den",
                "23.6 g/cm",
                "4: tenacity is \"23.6 g/cm\"; allowed: a number > 0 or a range of two, a blank and a unit",
            ),
            ("23.6 g/den", "23.6-20 g/den", "4: tenacity is \"23.6-20 g/den\"; allowed: a number > 0 or a range"),
            ("885 gf/denier", "885-900gf/denier", "5: modulus is \"885-900gf/denier\"; allowed"),
            ("885 gf/denier", "1,200 gf/denier", "5: modulus is \"1,200 gf/denier\"; allowed"),
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
