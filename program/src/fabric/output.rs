//! The history of a case as a table.

use std::fmt::Write;

use super::measure::Sample;
use crate::explicit::medium::ENERGY_NAMES;

/// The titles of the columns.
pub fn titles() -> String {
    let mut text = String::from(
        "time,speed,travel,force,deflection,front,projectile,kinetic,internal,hourglass,viscosity,friction,contact,total",
    );
    for name in ENERGY_NAMES {
        let _ = write!(text, ",{name}");
    }
    for name in ENERGY_NAMES {
        let _ = write!(text, ",largest_{name}");
    }
    text.push_str(",failure_index,deleted,collapsed,torn_yarns,tilt,slip,least_volume_ratio,least_scaled_jacobian\n");
    text
}

/// The line of a sample.
pub fn line(sample: &Sample) -> String {
    let mut text = String::new();
    let e = &sample.energies;
    let numbers = [
        sample.time,
        sample.speed,
        sample.travel,
        sample.force,
        sample.deflection,
        sample.front,
        e.projectile,
        e.kinetic,
        e.internal,
        e.hourglass,
        e.viscosity,
        e.friction,
        e.contact,
        e.total(),
    ];
    let numbers = numbers.iter().chain(&sample.parts).chain(&sample.largest).chain([&sample.index]);
    for number in numbers {
        let _ = write!(text, "{number:.6e},");
    }
    let _ = writeln!(
        text,
        "{},{},{},{:.3},{:.6e},{:.4},{:.4}",
        sample.deleted,
        sample.collapsed,
        sample.torn,
        sample.tilt,
        sample.slip,
        sample.least_volume_ratio,
        sample.least_scaled_jacobian
    );
    text
}
