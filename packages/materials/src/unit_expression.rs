//! The unit of a measured column, as its header has it: `MPa`, `N/mm²`, `kg/(m s²)`, `%`.

use toron::host::units::{Scale, UnitSystem};
use toron::law::parameters::Dimension;

/// A unit: exponents of mass, length and time, and its size.
#[derive(Clone, Debug, PartialEq)]
pub struct Unit {
    /// As it was written.
    pub text: String,
    pub mass: i32,
    pub length: i32,
    pub time: i32,
    /// The size in SI units. The power of ten is a whole number of its own, so that MPa and mm are exact.
    pub scale: Scale,
}

/// What may stand in the brackets of a header.
pub const ALLOWED: &str = "-, % or ° for a number; else products and quotients of m, in, ft, fps, g, t (tonne), lb, slug, slinch, s, \
                           N, lbf, gf, kgf, Pa, bar, psi, psf, ksi, J, W, tex, den with prefixes n µ (u) m c d k M G T P where they are metric, in \
                           capitals and small letters as here: N, kN, MPa, N/mm², mJ/mm^3, kg/(m s²), 1/s";

/// Longer texts are no units; this also bounds how deep parentheses can be.
const LONGEST: usize = 100;
/// Exponents of base units beyond this are mistakes, and their powers of ten would not be exact.
const GREATEST_EXPONENT: i32 = 9;

/// A unit by its name: exponents of mass, length and time, then factor · 10^exponent of the SI unit.
struct Named {
    name: &'static str,
    dimension: [i32; 3],
    factor: f64,
    exponent: i32,
    prefixes: bool,
}

const fn metric(name: &'static str, dimension: [i32; 3], exponent: i32) -> Named {
    Named { name, dimension, factor: 1.0, exponent, prefixes: true }
}

const fn plain(name: &'static str, dimension: [i32; 3], factor: f64, exponent: i32) -> Named {
    Named { name, dimension, factor, exponent, prefixes: false }
}

const FORCE: [i32; 3] = [1, 1, -2];
const PRESSURE: [i32; 3] = [1, -1, -2];

/// A pound-force, 0.45359237 kg · 9.80665 m/s², in 10⁻¹³ N: exact.
const POUND_FORCE: f64 = 44_482_216_152_605.0;
/// An inch and a foot in 10⁻⁴ m.
const INCH: f64 = 254.0;
const FOOT: f64 = 3048.0;

const NAMED: [Named; 30] = [
    plain("1", [0, 0, 0], 1.0, 0),
    plain("%", [0, 0, 0], 1.0, -2),
    plain("°", [0, 0, 0], std::f64::consts::PI / 180.0, 0),
    metric("m", [0, 1, 0], 0),
    metric("g", [1, 0, 0], -3),
    metric("s", [0, 0, 1], 0),
    plain("sec", [0, 0, 1], 1.0, 0),
    metric("N", FORCE, 0),
    metric("Pa", PRESSURE, 0),
    metric("bar", PRESSURE, 5),
    metric("J", [1, 2, -2], 0),
    metric("W", [1, 2, -3], 0),
    plain("t", [1, 0, 0], 1.0, 3),
    plain("tonne", [1, 0, 0], 1.0, 3),
    plain("gf", FORCE, 9.80665, -3),
    plain("kgf", FORCE, 9.80665, 0),
    plain("lb", [1, 0, 0], 45_359_237.0, -8),
    plain("lbs", [1, 0, 0], 45_359_237.0, -8),
    // Grams in 1000 m and, of a denier, in 9000 m.
    metric("tex", [1, -1, 0], -6),
    plain("den", [1, -1, 0], 1.0 / 9.0, -6),
    plain("denier", [1, -1, 0], 1.0 / 9.0, -6),
    plain("in", [0, 1, 0], INCH, -4),
    plain("ft", [0, 1, 0], FOOT, -4),
    plain("fps", [0, 1, -1], FOOT, -4),
    plain("lbf", FORCE, POUND_FORCE, -13),
    plain("psi", PRESSURE, POUND_FORCE / (INCH * INCH), -5),
    plain("psf", PRESSURE, POUND_FORCE / (FOOT * FOOT), -5),
    plain("ksi", PRESSURE, POUND_FORCE / (INCH * INCH), -2),
    // lbf s²/ft and lbf s²/in, written as the unit systems have them.
    plain("slug", [1, 0, 0], 0.45359237 * 9.80665 / 0.3048, 0),
    plain("slinch", [1, 0, 0], 0.45359237 * 9.80665 / 0.0254, 0),
];

/// µ has two characters: the micro sign and the Greek letter.
const PREFIXES: [(char, i32); 12] = [
    ('n', -9),
    ('u', -6),
    ('\u{b5}', -6),
    ('\u{3bc}', -6),
    ('m', -3),
    ('c', -2),
    ('d', -1),
    ('k', 3),
    ('M', 6),
    ('G', 9),
    ('T', 12),
    ('P', 15),
];

impl Unit {
    /// The unit that this text says; an empty one and `-` are a plain number.
    ///
    /// # Errors
    /// What of the text is not understood, without what is allowed: see [`ALLOWED`].
    pub fn parse(text: &str) -> Result<Unit, String> {
        let text = text.trim();
        if text.len() > LONGEST {
            return Err(format!("a unit of more than {LONGEST} characters"));
        }
        let mut unit = if text.is_empty() || text == "-" {
            number()
        } else {
            let figures = with_figures(text);
            let mut expression = Expression { rest: &figures };
            let unit = expression.product()?;
            match expression.rest.chars().next() {
                None => unit,
                Some(character) => return Err(format!("'{character}' is not expected there")),
            }
        };
        unit.text = text.to_string();
        Ok(unit)
    }

    /// Whether quantities of this dimension can have this unit. A stress and an energy by volume are not distinguished.
    pub fn measures(&self, dimension: Dimension) -> bool {
        [self.mass, self.length, self.time] == [dimension.mass, dimension.length, dimension.time]
    }

    /// What a kilogram, gram or pound in place of a force is taken for: kgf/mm2 of kg/mm2; none of another unit.
    pub fn as_force(&self) -> Option<Unit> {
        let (name, rest) =
            ["kg", "g", "lbs", "lb"].into_iter().find_map(|name| Some((name, self.text.strip_prefix(name)?)))?;
        let rest = Some(rest).filter(|rest| !rest.starts_with(char::is_alphabetic))?;
        Unit::parse(&format!("{}f{rest}", name.trim_end_matches('s'))).ok()
    }

    /// Converts a value of this unit to a system's unit of the same dimension: bit for bit where the two are one unit,
    /// by one rounding where they differ by a power of ten.
    pub fn convert(&self, value: f64, units: &UnitSystem) -> f64 {
        let own = Dimension { mass: self.mass, length: self.length, time: self.time, name: "" };
        self.scale.convert(value, &units.scale(own))
    }

    /// This unit times the `power`-th power of another.
    fn times(&self, other: &Unit, power: i32) -> Result<Unit, String> {
        let mut factor = self.scale.factor;
        for _ in 0..power.unsigned_abs() {
            factor = if power > 0 { factor * other.scale.factor } else { factor / other.scale.factor };
        }
        let unit = Unit {
            text: String::new(),
            mass: self.mass + power * other.mass,
            length: self.length + power * other.length,
            time: self.time + power * other.time,
            scale: Scale { exponent: self.scale.exponent + power * other.scale.exponent, factor },
        };
        let too_great = |exponent: &i32| exponent.abs() > GREATEST_EXPONENT;
        if [unit.mass, unit.length, unit.time].iter().any(too_great) {
            return Err(format!("an exponent of mass, length or time of more than {GREATEST_EXPONENT}"));
        }
        Ok(unit)
    }
}

/// With `in²` and `ft³` for `sq. in.` and `cu ft`.
fn with_figures(text: &str) -> String {
    let mut text = text.to_string();
    for (word, power) in [("sq", '²'), ("cu", '³')] {
        for (point, blank, end) in [(".", " ", "."), (".", "", "."), (".", " ", ""), ("", " ", "."), ("", " ", "")] {
            for unit in ["in", "ft"] {
                text = text.replace(&format!("{word}{point}{blank}{unit}{end}"), &format!("{unit}{power}"));
            }
        }
    }
    text
}

fn number() -> Unit {
    Unit { text: String::new(), mass: 0, length: 0, time: 0, scale: Scale::SI }
}

/// What remains of a text that is read from left to right.
struct Expression<'a> {
    rest: &'a str,
}

impl Expression<'_> {
    /// Powers, joined by `/`, `*`, `·` or blanks, which are taken from left to right: kg/m/s² is kg/(m s²).
    fn product(&mut self) -> Result<Unit, String> {
        let mut unit = number().times(&self.power()?, 1)?;
        let mut divided = false;
        loop {
            let blank = self.rest.starts_with(char::is_whitespace);
            self.rest = self.rest.trim_start();
            match self.rest.chars().next() {
                None | Some(')') => return Ok(unit),
                Some('/') => {
                    divided = true;
                    self.skip('/');
                    unit = unit.times(&self.power()?, -1)?;
                }
                Some(sign @ ('*' | '·' | '⋅')) => {
                    self.skip(sign);
                    unit = unit.times(&self.power()?, 1)?;
                }
                // Some read kg/m s² as kg/(m s²), others as kg s²/m.
                Some(_) if blank && divided => {
                    return Err("a blank after a '/': write kg/(m s²), or kg/m·s² for kg·s²/m".to_string());
                }
                Some(_) if blank => unit = unit.times(&self.power()?, 1)?,
                Some(character) => return Err(format!("'{character}' is not expected there")),
            }
        }
    }

    /// A name or a product in parentheses, and its exponent.
    fn power(&mut self) -> Result<Unit, String> {
        self.rest = self.rest.trim_start();
        let base = if self.rest.starts_with('(') {
            self.skip('(');
            let inner = self.product()?;
            if !self.rest.starts_with(')') {
                return Err("a ')' is missing".to_string());
            }
            self.skip(')');
            inner
        } else {
            self.name()?
        };
        number().times(&base, self.exponent()?)
    }

    fn name(&mut self) -> Result<Unit, String> {
        let no_letter = |c: char| !c.is_alphabetic();
        let end = match self.rest.chars().next() {
            Some('%') => 1,
            // Of an angle, not of a temperature.
            Some('°') if !self.rest['°'.len_utf8()..].starts_with(char::is_alphabetic) => '°'.len_utf8(),
            // A whole number is no unit, but for 1.
            Some('1') => self.rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(self.rest.len()),
            _ => self.rest.find(no_letter).unwrap_or(self.rest.len()),
        };
        let (name, rest) = self.rest.split_at(end);
        if name.is_empty() {
            let found = rest.chars().next().map_or("the end".to_string(), |character| format!("'{character}'"));
            return Err(format!("a unit is expected where there is {found}"));
        }
        self.rest = rest;
        named(name).ok_or_else(|| format!("\"{name}\" is not known"))
    }

    /// `²`, `^2`, `2`, `⁻¹` or `^-1`; 1 if there is none.
    fn exponent(&mut self) -> Result<i32, String> {
        const DIGITS: [char; 9] = ['¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
        let caret = self.skip('^');
        let negative = if caret { self.skip('-') } else { self.skip('⁻') };
        let first = self.rest.chars().next();
        let raised = DIGITS.iter().position(|&digit| Some(digit) == first).filter(|_| !caret).map(|i| i as i32 + 1);
        let digit = first.and_then(|c| c.to_digit(10)).filter(|&digit| digit > 0 && (caret || !negative));
        let exponent = raised.or(digit.map(|digit| digit as i32));
        match (exponent, first) {
            (Some(exponent), Some(character)) => {
                self.skip(character);
                Ok(if negative { -exponent } else { exponent })
            }
            _ if caret || negative => Err("an exponent is one digit from 1 to 9".to_string()),
            _ => Ok(1),
        }
    }

    /// Passes over a character; whether it was there.
    fn skip(&mut self, character: char) -> bool {
        let rest = self.rest.strip_prefix(character);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }
}

/// The unit of this name, which may have a prefix.
fn named(name: &str) -> Option<Unit> {
    let find = |name: &str, prefix: i32| {
        let row = NAMED.iter().find(|row| row.name == name && (row.prefixes || prefix == 0))?;
        let [mass, length, time] = row.dimension;
        let scale = Scale { exponent: row.exponent + prefix, factor: row.factor };
        Some(Unit { text: String::new(), mass, length, time, scale })
    };
    find(name, 0).or_else(|| {
        let first = name.chars().next()?;
        let (_, exponent) = PREFIXES.iter().find(|(prefix, _)| *prefix == first)?;
        find(&name[first.len_utf8()..], *exponent)
    })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::units::{CONTACT_STIFFNESS, ENERGY, FORCE, SPEED, TIME, unit};
    use toron::law::parameters::{DENSITY, ENERGY_DENSITY, NUMBER, STRESS};

    const LENGTH: Dimension = Dimension { mass: 0, length: 1, time: 0, name: "length" };

    #[track_caller]
    fn parse(text: &str) -> Unit {
        Unit::parse(text).unwrap_or_else(|error| panic!("{text}: {error}"))
    }

    #[test]
    fn forms_of_one_unit_are_equal() {
        for (texts, dimension, exponent) in [
            (&["N", "kg m/s²", "kg·m/s^2", "kg*m/s2", "J/m", "kg m s⁻²", "kg m s^-2", "W s/m"][..], FORCE, 0),
            (&["MPa", "N/mm²", "N/mm^2", "N/mm2", "N / mm²", "N/(mm mm)", "N/mm/mm", "mJ/mm³", "MJ/m^3"], STRESS, 6),
            (&["GPa", "kN/mm²", "(kN)/(mm)²", "kN/(mm²)"], STRESS, 9),
            (&["bar", "dN/mm²"], STRESS, 5),
            (&["-", "", " ", "1", "mm/mm"], NUMBER, 0),
            (&["%", "mm/dm"], NUMBER, -2),
            (&["µm", "μm", "um"], LENGTH, -6),
            (&["g/cm³", "t/m³", "tonne/m^3", "kg/dm³"], DENSITY, 3),
            (&["tonne/mm^3", "t/(mm² mm)"], DENSITY, 12),
            (&["kN/m", "N/mm"], Dimension { mass: 1, length: 0, time: -2, name: "" }, 3),
            (&["ms", "m·s/km"], TIME, -3),
            (&["dtex", "dg/km"], Dimension { mass: 1, length: -1, time: 0, name: "" }, -7),
            (&["N/tex", "cN/ctex", "kN m/g"], Dimension { mass: 0, length: 2, time: -2, name: "" }, 6),
        ] {
            for text in texts {
                let unit = parse(text);
                assert!(unit.measures(dimension), "{text}: {unit:?}");
                assert_eq!(unit.scale, Scale { exponent, factor: 1.0 }, "{text}");
            }
        }
    }

    #[test]
    fn a_value_in_the_system_s_own_unit_keeps_its_bits() {
        let mm = UnitSystem::parse("mm-tonne-s").expect("a system");
        for value in [0.1, 82.341, 1.0 / 3.0, 1e-300] {
            assert_eq!(parse("MPa").convert(value, &mm), value);
            assert_eq!(parse("mm").convert(value, &mm), value);
            assert_eq!(parse("mm").convert(value, &UnitSystem::SI), value / 1e3);
            assert_eq!(parse("GPa").convert(value, &mm), value * 1e3);
            assert_eq!(parse("%").convert(value, &mm), value / 100.0);
        }
        assert_eq!(parse("MPa").convert(1.0, &UnitSystem::SI), 1e6);
        assert_eq!(parse("°").convert(180.0, &mm), std::f64::consts::PI);
        assert_eq!(parse("lbf").convert(1.0, &UnitSystem::SI), 4.4482216152605);
        assert_eq!(parse("in").convert(1.0, &mm), 25.4);
        let psi = parse("ksi").convert(1e-3, &UnitSystem::SI);
        assert!((psi - 6894.757293168361).abs() < 1e-11, "{psi}");
    }

    #[test]
    fn the_units_that_the_program_writes_are_read() {
        for name in ["si", "mm-tonne-s", "mm-g-ms", "mm-kg-ms", "cm-g-us", "in-slinch-s", "ft-slug-s", "ft-kg-ms"] {
            let units = UnitSystem::parse(name).expect("a system");
            for dimension in [NUMBER, STRESS, ENERGY_DENSITY, DENSITY, FORCE, ENERGY, TIME, SPEED, CONTACT_STIFFNESS] {
                let text = unit(&units, dimension);
                let unit = parse(&text);
                assert!(unit.measures(dimension), "{text}");
                assert!((unit.convert(1.0, &units) - 1.0).abs() < 1e-14, "{text} in {name}");
            }
        }
    }

    #[test]
    fn pounds_and_kilograms_are_masses_or_forces() {
        let si = |text: &str, value: f64| {
            let found = parse(text).convert(1.0, &UnitSystem::SI);
            assert!((found / value - 1.0).abs() < 1e-14, "{text}: {found}");
        };
        for text in ["lb/cu. in.", "lb/cu.in.", "lb/cu in", "lb/in³", "lbs/in^3"] {
            assert!(parse(text).measures(DENSITY), "{text}");
            si(text, 0.45359237 / 0.0254_f64.powi(3));
        }
        si("lbf/sq. in.", 6894.757293168361);
        si("kgf/mm²", 9.80665e6);
        for (text, force, value) in [
            ("kg/mm2", "kgf/mm2", 9.80665e6),
            ("kg", "kgf", 9.80665),
            ("g/den", "gf/den", 9.80665e-3 * 9e6),
            ("lb", "lbf", 4.4482216152605),
            ("lbs/sq. in.", "lbf/sq. in.", 6894.757293168361),
        ] {
            let found = parse(text).as_force().expect(text);
            assert_eq!(found.text, force);
            si(force, value);
        }
        for text in ["N", "m", "t/m²", "gf", "1/kg", "kgf"] {
            assert_eq!(parse(text).as_force(), None, "{text}");
        }
    }

    #[test]
    fn errors_name_what_is_not_understood() {
        for (text, message) in [
            ("Mpa", "\"Mpa\" is not known"),
            ("N/mmm", "\"mmm\" is not known"),
            ("kpsi", "\"kpsi\" is not known"),
            ("µ", "\"µ\" is not known"),
            ("kg/m s²", "a blank after a '/': write kg/(m s²), or kg/m·s² for kg·s²/m"),
            ("N/", "a unit is expected where there is the end"),
            ("N//m", "a unit is expected where there is '/'"),
            ("m**2", "a unit is expected where there is '*'"),
            ("N/(mm²", "a ')' is missing"),
            ("N)", "')' is not expected there"),
            ("m^", "an exponent is one digit from 1 to 9"),
            ("m^0", "an exponent is one digit from 1 to 9"),
            ("m²³", "'³' is not expected there"),
            ("m10", "'0' is not expected there"),
            ("10 N", "\"10\" is not known"),
            ("12", "\"12\" is not known"),
            ("1N", "'N' is not expected there"),
            ("°C", "a unit is expected where there is '°'"),
            ("(m^9)^2", "an exponent of mass, length or time of more than 9"),
            ("--", "a unit is expected where there is '-'"),
        ] {
            assert_eq!(Unit::parse(text), Err(message.to_string()), "{text}");
        }
        assert!(Unit::parse(&"(".repeat(100_000)).is_err());
        assert!(Unit::parse(&"(".repeat(LONGEST)).is_err());
    }

    proptest! {
        #[test]
        fn no_text_panics(any in "\\PC*", alike in "[mgsNPajkMGµ²³1-9/*·()^ %-]{0,40}") {
            for text in [any, alike] {
                if let Ok(unit) = Unit::parse(&text) {
                    prop_assert!(unit.scale.factor > 0.0 && unit.convert(1.0, &UnitSystem::SI).is_finite());
                }
            }
        }
    }
}
