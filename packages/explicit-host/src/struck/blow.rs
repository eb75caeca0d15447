//! A blow in figures that all struck scenes have: a slip in a speed, a size or a unit shows in them.

use std::ops::RangeInclusive;

use crate::contact::RigidSurface;
use crate::judgement::Finding;
use toron::host::units::UnitSystem;
use toron_materials::units::{CONTACT_STIFFNESS, LENGTH, SPEED, unit};
use toron_shared::numbers::number;

/// Speeds at which yarns and panels are struck, in m/s, and stiffnesses of contact that yarns take, in MPa/mm, with a
/// margin on both sides.
const SPEEDS: RangeInclusive<f64> = 0.5..=3e3;
const STIFFNESSES: RangeInclusive<f64> = 1e3..=1e7;
const MPA_BY_MM: f64 = 1e9;
/// A coefficient of friction that dry surfaces reach, rubber on rubber included; of yarns it is 0.1 to 0.6.
const ROUGHEST: f64 = 2.0;
/// A figure on its bound may be beyond it by what the conversion of units rounds.
const ROUNDING: f64 = 1e-12;
/// What solids have in kg/m³: balsa from 100, osmium 22 600.
pub const DENSITIES: RangeInclusive<f64> = 100.0..=23e3;

/// A speed at which nothing is struck.
pub fn slow_or_fast(units: &UnitSystem, speed: f64) -> Option<Finding> {
    let in_si = speed / units.from_si(1.0, SPEED);
    (!holds(&SPEEDS, in_si)).then(|| {
        let text = format!(
            "the speed of {} {} is {} m/s, and yarns and panels are struck at {} to {}:\n\
             it is most likely not in the units of the file, {}",
            number(speed),
            unit(units, SPEED),
            number(in_si),
            SPEEDS.start(),
            SPEEDS.end(),
            units.names().join("-")
        );
        Finding::new("units", text)
    })
}

/// A contact that is another one than that of yarns.
pub fn soft_or_hard(units: &UnitSystem, stiffness: f64) -> Option<Finding> {
    let in_mpa = stiffness / units.from_si(MPA_BY_MM, CONTACT_STIFFNESS);
    (!holds(&STIFFNESSES, in_mpa)).then(|| {
        let text = format!(
            "contact-stiffness is {stiffness:e} {}, {} MPa/mm, and yarns take {:e} to {:e}:\n\
             it is most likely not in the units of the file, {}",
            unit(units, CONTACT_STIFFNESS),
            number(in_mpa),
            STIFFNESSES.start(),
            STIFFNESSES.end(),
            units.names().join("-")
        );
        Finding::new("units", text)
    })
}

/// Friction that no two surfaces have; `key` has its coefficient.
pub fn rough(key: &str, friction: f64) -> Option<Finding> {
    (friction > ROUGHEST).then(|| {
        let text = format!(
            "{key} is {}, and dry surfaces have 0 to {ROUGHEST}, yarns 0.1 to 0.6:\na point is most likely missing in it",
            number(friction)
        );
        Finding::new("friction", text)
    })
}

/// A striker that is larger than the target, which reaches so far from its middle.
pub fn large(units: &UnitSystem, striker: &RigidSurface, target: &str, reach: f64) -> Option<Finding> {
    (striker.radius > reach).then(|| {
        let ([radius, reach], unit) = ([striker.radius, reach].map(number), unit(units, LENGTH));
        let text = format!(
            "the {}'s radius of {radius} {unit} is more than what the {target} reaches from the middle, {reach} {unit}:\n\
             take a larger {target}, or one of the two is not in the units of the file, {}",
            striker.shape.name(),
            units.names().join("-")
        );
        Finding::new("sizes", text)
    })
}

fn holds(range: &RangeInclusive<f64>, value: f64) -> bool {
    (range.start() * (1.0 - ROUNDING)..=range.end() * (1.0 + ROUNDING)).contains(&value)
}
