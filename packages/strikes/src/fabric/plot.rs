//! Plots of a case's history.

use std::path::Path;

use super::measure::Sample;
use super::run::Outcome;
use super::scene::{Case, Scene};
use toron::host::units::UnitSystem;
use toron::law::parameters::ENERGY_DENSITY;
use toron_materials::units::{ENERGY, FORCE, LENGTH, SPEED, TIME, unit};
use toron_pictures::history::{self, Samples};
use toron_pictures::panel::{Panel, Series, tidy};
use toron_pictures::style::INK;
use toron_shared::error::Error;

const MODES: [&str; 5] = ["elongation", "compaction", "distortion", "shear", "work of the linear law"];

/// Speed, deflection, energies by kind and by mode, largest energy densities, front and force over time, as far as they
/// change, with the verdict of the run.
///
/// # Errors
/// A file cannot be written.
pub fn write(
    svg: &Path,
    png: &Path,
    scene: &Scene,
    case: &Case,
    outcome: &Outcome,
    verdict: &str,
) -> Result<(), Error> {
    let samples = Samples(&outcome.history);
    let abscissa = samples.over_time(&unit(&scene.units, TIME), |sample| sample.time, outcome.failed);
    let subtitle = format!("{}; verdict: {verdict}", case.name);
    history::write(svg, png, [&scene.title, &subtitle], panels(&samples, &scene.units), &abscissa)
}

fn panels(samples: &Samples<Sample>, units: &UnitSystem) -> [Panel; 11] {
    let line = |colour: usize, name: &str, of: &dyn Fn(&Sample) -> f64| samples.line(colour, name, of);
    let panel = |title, dimension, series: Vec<Series>| Panel::new(title, &unit(units, dimension), tidy(series));
    let energies = vec![
        line(0, "striker", &|s| s.energies.striker),
        line(1, "kinetic", &|s| s.energies.kinetic),
        line(2, "internal", &|s| s.energies.internal),
        line(3, "all other", &|s| s.energies.other()),
        Series { colour: INK, ..line(0, "total", &|s| s.energies.total()) },
    ];
    let others = vec![
        line(0, "friction", &|s| s.energies.friction),
        line(1, "hourglass", &|s| s.energies.hourglass),
        line(2, "viscosity", &|s| s.energies.viscosity),
        line(3, "contact", &|s| s.energies.contact),
    ];
    let deflections = vec![line(1, "way of the striker", &|s| s.travel), line(0, "panel", &|s| s.own.deflection)];
    let worst = vec![
        line(0, "least volume over that at rest", &|s| s.own.least_volume_ratio),
        line(1, "least scaled Jacobian", &|s| s.own.least_scaled_jacobian),
    ];
    let by_mode = |of: fn(&Sample) -> [f64; 5]| -> Vec<Series> {
        (0..MODES.len()).map(|mode| line(mode, MODES[mode], &|s| of(s)[mode])).collect()
    };
    [
        panel("Speed of the striker", SPEED, vec![line(0, "speed", &|s| s.speed)]),
        panel("Largest deflection", LENGTH, deflections),
        panel("Energies", ENERGY, energies),
        panel("All other energies", ENERGY, others),
        panel("Internal energy", ENERGY, by_mode(|s| s.parts)),
        panel("Largest energy per reference volume", ENERGY_DENSITY, by_mode(|s| s.largest)),
        panel("Front of the transverse wave", LENGTH, vec![line(0, "from the centre", &|s| s.own.front)]),
        panel("Force on the striker", FORCE, vec![line(0, "force", &|s| s.force)]),
        Panel::new("Largest tilt of a section", "°", vec![line(0, "tilt", &|s| s.own.tilt)]),
        panel("Largest slip of a section's middle", LENGTH, vec![line(0, "slip", &|s| s.own.slip)]),
        Panel::new("Worst elements", "-", tidy(worst)),
    ]
}
