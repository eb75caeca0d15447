//! Plots of a pressed section's history over the way of the walls.

use std::path::Path;

use super::outcome::{Pressed, Sample};
use crate::fibres::scene::{Case, Scene, Striker};
use toron::law::parameters::STRESS;
use toron_materials::units::unit;
use toron_pictures::history::{self, Samples};
use toron_pictures::panel::{self, Panel, Series, tidy};
use toron_shared::error::Error;

/// q/p_t says nothing where p_t is less than this part of its largest.
const UNPRESSED: f64 = 0.02;

/// Energies, where the work went, and invariants.
///
/// # Errors
/// A file cannot be written.
pub fn write(svg: &Path, png: &Path, scene: &Scene, case: &Case, result: &Pressed) -> Result<(), Error> {
    let samples = Samples(&result.samples);
    let largest = result.samples.iter().fold(0.0, |most: f64, sample| most.max(sample.p_t));
    let line = |colour: usize, name: &str, of: &dyn Fn(&Sample) -> f64| samples.line(colour, name, of);
    let mut energies = vec![line(0, "middle", &|s| s.middle.energy), line(1, "whole section", &|s| s.whole.energy)];
    if let Striker::Walls { law: Some(law), .. } = case.striker {
        energies.push(line(2, "the law at the middle's invariants", &|s| law.energy(s.middle.invariants)));
    }
    let work = vec![
        line(0, "work", &|s| s.work),
        line(1, "fibres", &|s| s.whole.energy),
        line(2, "walls", &|s| s.walls),
        line(3, "friction", &|s| s.friction),
        line(4, "damping", &|s| s.damping),
    ];
    let invariants = vec![
        line(0, "−I_tc, middle", &|s| -s.middle.invariants[0]),
        line(1, "section", &|s| -s.whole.invariants[0]),
        line(2, "I_td, middle", &|s| s.middle.invariants[1]),
        line(3, "section", &|s| s.whole.invariants[1]),
    ];
    let stresses = vec![line(0, "pressure p_t", &|s| s.p_t), line(1, "deviator q", &|s| s.q)];
    let ratio = |s: &Sample| if s.p_t > UNPRESSED * largest { s.q / s.p_t } else { f64::NAN };
    let stress = unit(&scene.units, STRESS);
    let panel = |title, series: Vec<Series>| Panel::new(title, &stress, tidy(series));
    let panels = [
        panel("Contact energy over the area at rest", energies),
        panel("The work of the walls", work),
        panel("Stress of the walls", stresses),
        Panel::new("q over p_t", "–", vec![line(0, "q/p_t", &ratio)]),
        Panel::new("Invariants", "–", tidy(invariants)),
        panel("Kinetic energy", vec![line(0, "kinetic", &|s| s.kinetic)]),
    ];
    let abscissa = panel::Abscissa {
        label: "way of the walls over their distance (–)".to_string(),
        values: result.samples.iter().map(|sample| 1.0 - sample.stretch).collect(),
        failure: None,
    };
    history::write(svg, png, [&scene.title, &case.name], panels, &abscissa)
}
