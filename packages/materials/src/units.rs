//! What the units of a system are called, for axes and summaries: MPa in mm-tonne-s, GPa in mm-kg-ms, psi in
//! in-slinch-s.

use toron::host::units::UnitSystem;
use toron::law::parameters::{DENSITY, Dimension, ENERGY_DENSITY, NUMBER, STRESS};
use toron_shared::error::Error;
use toron_shared::numbers::number;
use toron_shared::spanned::Spanned;
use toron_shared::toml_file::Source;

/// Joule, for work and energies.
pub const ENERGY: Dimension = Dimension { mass: 1, length: 2, time: -2, name: "energy" };
/// Newton.
pub const FORCE: Dimension = Dimension { mass: 1, length: 1, time: -2, name: "force" };

pub const MASS: Dimension = Dimension { mass: 1, length: 0, time: 0, name: "mass" };
pub const LENGTH: Dimension = Dimension { mass: 0, length: 1, time: 0, name: "length" };
pub const TIME: Dimension = Dimension { mass: 0, length: 0, time: 1, name: "time" };
/// A pressure by the depth of a contact.
pub const CONTACT_STIFFNESS: Dimension = Dimension { mass: 1, length: -2, time: -2, name: "contact stiffness" };
pub const SPEED: Dimension = Dimension { mass: 0, length: 1, time: -1, name: "speed" };

/// Powers of ten that have a prefix.
const PREFIXES: [(i32, &str); 9] =
    [(-9, "n"), (-6, "µ"), (-3, "m"), (0, ""), (3, "k"), (6, "M"), (9, "G"), (12, "T"), (15, "P")];

/// The system of units that a file names.
///
/// # Errors
/// There is none of that name.
pub fn system(source: &Source, name: &Spanned<String>) -> Result<UnitSystem, Error> {
    UnitSystem::parse(name.get_ref()).ok_or_else(|| {
        let message = format!("unit system \"{}\"; allowed: {}", name.get_ref(), UnitSystem::ALLOWED);
        source.error(name.span(), &message)
    })
}

/// The name of a system's unit: one with a name of its own where there is one, else built of the base units.
pub fn unit(units: &UnitSystem, dimension: Dimension) -> String {
    let [length, mass, time] = units.names();
    match dimension {
        NUMBER => "-".to_string(),
        ENERGY_DENSITY => match named(units, ENERGY, "J", &[]) {
            Some(joule) => format!("{joule}/{length}³"),
            None => unit(units, STRESS),
        },
        STRESS => pressure(units).unwrap_or_else(|| format!("{mass}/({length} {time}²)")),
        CONTACT_STIFFNESS => pressure(units)
            .map_or_else(|| format!("{mass}/({length}² {time}²)"), |pressure| format!("{pressure}/{length}")),
        ENERGY => named(units, dimension, "J", &[])
            .or_else(|| imperial(units, ["lbf in", "lbf ft"]))
            .unwrap_or_else(|| format!("{mass} {length}²/{time}²")),
        FORCE => named(units, dimension, "N", &[])
            .or_else(|| imperial(units, ["lbf", "lbf"]))
            .unwrap_or_else(|| format!("{mass} {length}/{time}²")),
        DENSITY => format!("{mass}/{length}³"),
        LENGTH => length.to_string(),
        TIME => time.to_string(),
        SPEED => format!("{length}/{time}"),
        _ => dimension.name.to_string(),
    }
}

/// The unit of stress that has a name of its own.
fn pressure(units: &UnitSystem) -> Option<String> {
    named(units, STRESS, "Pa", &[(11, "Mbar"), (5, "bar")]).or_else(|| imperial(units, ["psi", "psf"]))
}

/// An SI name with a prefix, or one of the `others` by their power of ten.
fn named(units: &UnitSystem, dimension: Dimension, name: &str, others: &[(i32, &str)]) -> Option<String> {
    let exponent = -units.from_si(1.0, dimension).log10();
    let whole = exponent.round();
    if (exponent - whole).abs() > 1e-9 {
        return None;
    }
    let prefixed = PREFIXES.iter().find(|row| f64::from(row.0) == whole).map(|row| format!("{}{name}", row.1));
    prefixed.or_else(|| others.iter().find(|row| f64::from(row.0) == whole).map(|row| row.1.to_string()))
}

/// The names of the inch and of the foot, in the two systems whose units have such names.
fn imperial(units: &UnitSystem, [inch, foot]: [&str; 2]) -> Option<String> {
    match units.names() {
        ["in", "slinch", "s"] => Some(inch.to_string()),
        ["ft", "slug", "s"] => Some(foot.to_string()),
        _ => None,
    }
}

/// A number's text with its unit, if it has one.
pub fn with_unit(units: &UnitSystem, number: &str, dimension: Dimension) -> String {
    if dimension == NUMBER { number.to_string() } else { format!("{number} {}", unit(units, dimension)) }
}

/// A time for people, by the system's unit or by a finer one that makes it 1 at least: 30 µs where the unit is ms.
pub fn time(units: &UnitSystem, value: f64) -> String {
    let own = unit(units, TIME).replace("us", "µs");
    let finer = ["s", "ms", "µs", "ns"].into_iter().skip_while(|&name| name != own);
    let scaled = finer.enumerate().map(|(i, name)| (value * 1e3_f64.powi(i as i32), name));
    let (value, name) = scaled.into_iter().find(|(value, _)| *value >= 1.0 - 1e-6).unwrap_or((value, &own));
    let digits = number(value);
    let kept = if digits.contains('.') && !digits.contains('e') {
        digits.trim_end_matches('0').trim_end_matches('.')
    } else {
        &digits
    };
    format!("{kept} {name}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn units(name: &str) -> UnitSystem {
        UnitSystem::parse(name).expect("a unit system")
    }

    #[test]
    fn times_have_the_digits_that_they_need() {
        for (system, value, text) in [
            ("mm-g-ms", 0.03, "30 µs"),
            ("mm-g-ms", 0.030_000_4, "30 µs"),
            ("mm-g-ms", 0.0125, "12.5 µs"),
            ("mm-g-ms", 0.00025, "250 ns"),
            ("mm-g-ms", 2.0, "2 ms"),
            ("si", 3e-5, "30 µs"),
            ("cm-g-us", 30.0, "30 µs"),
            ("cm-g-us", 100.0, "100 µs"),
            ("mm-g-ms", 0.0, "0 ms"),
        ] {
            assert_eq!(time(&units(system), value), text);
        }
    }

    #[test]
    fn contact_stiffness_is_a_pressure_by_length() {
        for (system, name) in
            [("mm-g-ms", "MPa/mm"), ("si", "Pa/m"), ("in-slinch-s", "psi/in"), ("ft-kg-s", "kg/(ft² s²)")]
        {
            assert_eq!(unit(&units(system), CONTACT_STIFFNESS), name);
        }
    }
}
