//! Consistent unit systems: presets and tables in the units of a user's model.
//!
//! A system is named by its units of length, mass and time, in any order, joined by `-` or `,`: `m-kg-s` (also `si`),
//! `mm-tonne-s`, `mm-kg-ms`, `cm-g-us`, `in-slinch-s`. Every other unit follows from these three.

use crate::law::parameters::Dimension;

/// A base unit in SI units: `factor` · 10^`exponent`, so that the conversion of decimal units adds no rounding of its
/// own.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Base {
    name: &'static str,
    exponent: i32,
    factor: f64,
}

const fn decimal(name: &'static str, exponent: i32) -> Base {
    Base { name, exponent, factor: 1.0 }
}

const LENGTHS: [Base; 7] = [
    decimal("m", 0),
    decimal("cm", -2),
    decimal("mm", -3),
    decimal("um", -6),
    decimal("µm", -6),
    Base { name: "in", exponent: -4, factor: 254.0 },
    Base { name: "ft", exponent: -4, factor: 3048.0 },
];

/// Pound mass 0.45359237 kg, standard gravity 9.80665 m/s²: a slug is lbf s²/ft, a slinch lbf s²/in.
const MASSES: [Base; 7] = [
    decimal("kg", 0),
    decimal("g", -3),
    decimal("mg", -6),
    decimal("t", 3),
    decimal("tonne", 3),
    Base { name: "slug", exponent: 0, factor: 0.45359237 * 9.80665 / 0.3048 },
    Base { name: "slinch", exponent: 0, factor: 0.45359237 * 9.80665 / 0.0254 },
];

const TIMES: [Base; 5] = [decimal("s", 0), decimal("ms", -3), decimal("us", -6), decimal("µs", -6), decimal("ns", -9)];

/// A consistent system of units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnitSystem {
    length: Base,
    mass: Base,
    time: Base,
}

impl UnitSystem {
    /// Metre, kilogram, second.
    pub const SI: UnitSystem = UnitSystem { length: LENGTHS[0], mass: MASSES[0], time: TIMES[0] };

    /// The allowed names, for messages.
    pub const ALLOWED: &'static str = "length-mass-time out of m cm mm um in ft, kg g mg t (tonne) slug slinch, \
                                       s ms us ns: m-kg-s (si), mm-tonne-s, mm-kg-ms, cm-g-us, ...";

    /// The system of this name; `None` unless it is three known units, one each of length, mass and time.
    pub fn parse(name: &str) -> Option<UnitSystem> {
        let name = name.trim();
        if name.eq_ignore_ascii_case("si") {
            return Some(UnitSystem::SI);
        }
        let (mut length, mut mass, mut time) = (None, None, None);
        for token in name.split(['-', ',']) {
            let token = token.trim();
            let find = |table: &[Base]| table.iter().find(|base| base.name.eq_ignore_ascii_case(token)).copied();
            let (slot, base) = match (find(&LENGTHS), find(&MASSES), find(&TIMES)) {
                (Some(base), ..) => (&mut length, base),
                (_, Some(base), _) => (&mut mass, base),
                (.., Some(base)) => (&mut time, base),
                _ => return None,
            };
            if slot.replace(base).is_some() {
                return None;
            }
        }
        Some(UnitSystem { length: length?, mass: mass?, time: time? })
    }

    /// Converts a value in SI units to the units of this system.
    pub fn from_si(&self, value: f64, dimension: Dimension) -> f64 {
        Scale::SI.convert(value, &self.scale(dimension))
    }

    /// The unit of this dimension.
    pub fn scale(&self, dimension: Dimension) -> Scale {
        let (mut exponent, mut factor) = (0, 1.0);
        for (base, power) in [(self.mass, dimension.mass), (self.length, dimension.length), (self.time, dimension.time)]
        {
            exponent += base.exponent * power;
            factor *= integer_power(base.factor, power);
        }
        Scale { exponent, factor }
    }

    /// The names of the units of length, mass and time.
    pub fn names(&self) -> [&'static str; 3] {
        [self.length.name, self.mass.name, self.time.name]
    }
}

/// A unit of some dimension in SI units: `factor` · 10^`exponent`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// The power of ten.
    pub exponent: i32,
    /// Its factor; 1 in most systems.
    pub factor: f64,
}

impl Scale {
    /// The unit of the SI.
    pub const SI: Scale = Scale { exponent: 0, factor: 1.0 };

    /// Converts a value in this unit to another one of the same dimension. Between equal units no bit changes, between
    /// units that differ by a power of ten there is one rounding.
    pub fn convert(&self, value: f64, to: &Scale) -> f64 {
        let scaled = if self.factor == to.factor { value } else { value * self.factor / to.factor };
        let exponent = to.exponent - self.exponent;
        let shift = integer_power(10.0, exponent.abs());
        if exponent >= 0 { scaled / shift } else { scaled * shift }
    }
}

/// x^n, exact for powers of ten up to 10^22.
fn integer_power(x: f64, n: i32) -> f64 {
    let mut power = 1.0;
    for _ in 0..n.unsigned_abs() {
        power *= x;
    }
    if n < 0 { 1.0 / power } else { power }
}
