//! Plots of a case's history.

use std::path::Path;

use super::beside::{self, Beside};
use super::frame::Frame;
use super::model::{Striking, micro};
use super::outcome::{Outcome, Sample};
use super::scene::{Case, Scene};
use toron::host::units::UnitSystem;
use toron_materials::units::{ENERGY, LENGTH, SPEED, TIME, time, unit};
use toron_pictures::history::{self, Samples};
use toron_pictures::panel::{self, Panel, Series, tidy};
use toron_pictures::style::INK;
use toron_shared::error::Error;
use toron_strikes::impact::outcome::STATIONS;

/// Speed, energies, strain and widths of a case over time, as far as they change.
///
/// # Errors
/// A file cannot be written.
pub fn write_history(
    svg: &Path,
    png: &Path,
    scene: &Scene,
    case: &Case,
    result: &Outcome,
    law: Option<&Beside>,
) -> Result<(), Error> {
    let samples = Samples(&result.samples);
    let abscissa = samples.over_time(&unit(&scene.units, TIME), |sample| sample.time, result.first_break());
    history::write(svg, png, [&scene.title, &case.name], panels(&samples, &scene.units, case, result, law), &abscissa)
}

/// Mean strain along the yarn at the times of the pictures, and the law's beside, where its run has drawn the yarn at
/// as many.
///
/// # Errors
/// A file cannot be written or read.
pub fn write_strains(svg: &Path, png: &Path, scene: &Scene, case: &Case, result: &Outcome) -> Result<(), Error> {
    let mut panels = Vec::new();
    let instant = |frame: &Frame| micro(&scene.units, TIME) * frame.step as f64 * result.model.step;
    let length = micro(&scene.units, LENGTH) * result.model.spacing;
    let trusses = result.model.beads - 1;
    for (number, frame) in (1..).zip(&result.frames) {
        // A gap is where no truss is whole.
        let mut mean = vec![f64::NAN; trusses];
        for (place, [strain, _]) in result.strains(&scene.units, frame) {
            mean[(place / length) as usize] = 100.0 * strain;
        }
        let mut series = vec![Series::new(0, "fibres, mean", mean)];
        let places = (0..trusses).map(|layer| length * (layer as f64 + 0.5));
        let law = case.law.as_deref().map(|law| beside::strains(law, number, places)).transpose()?.flatten();
        if let Some(values) = law {
            series.push(Series::new(1, "law", values));
        }
        let unit = format!("% at {}", time(&scene.units, instant(frame)));
        panels.push(Panel::new("Strain along the yarn", &unit, series));
    }
    if panels.is_empty() {
        return Ok(());
    }
    let abscissa = panel::Abscissa {
        label: format!("place from mid-span, at rest ({})", scene.units.names()[0]),
        values: (0..trusses).map(|layer| length * (layer as f64 + 0.5)).collect(),
        failure: None,
    };
    history::write(svg, png, [&scene.title, &case.name], panels, &abscissa)
}

fn panels(
    samples: &Samples<Sample>,
    units: &UnitSystem,
    case: &Case,
    result: &Outcome,
    law: Option<&Beside>,
) -> [Panel; 6] {
    let line = |colour: usize, name: &str, of: &dyn Fn(&Sample) -> f64| samples.line(colour, name, of);
    let panel = |title, dimension, series: Vec<Series>| Panel::new(title, &unit(units, dimension), tidy(series));
    let beside = |colour: usize, name: &str, columns: &[&str]| {
        law.map(|law| {
            let of = |sample: &Sample| columns.iter().map(|column| law.at(column, sample.time)).sum();
            line(colour, &format!("{name}, law"), &of)
        })
    };
    let mut energies = vec![
        line(1, "fibres, kinetic", &|s| s.kinetic),
        line(2, "elongation", &|s| s.elongation),
        line(3, "broken", &|s| s.broken),
        line(4, "friction", &Sample::friction),
    ];
    if let Striking::Cylinder { held: false, .. } = result.model.striker {
        energies.insert(0, line(0, "projectile", &|s| s.projectile));
    } else {
        energies.push(Series { colour: INK, ..line(0, "external work", &|s| s.external) });
    }
    if law.is_some() {
        // Friction is in the section's energies.
        energies
            .retain(|series| !["broken", "external work", "projectile", "friction"].contains(&series.name.as_str()));
    }
    energies.extend(beside(3, "kinetic", &["kinetic_energy"]));
    energies.extend(beside(0, "elongation", &["elongation_energy"]));
    let mut section = vec![
        line(0, "contact", &|s| s.contact),
        line(1, "contact, projectile", &|s| s.pressed),
        line(2, "friction, fibres", &|s| s.friction_fibres),
        line(3, "friction, projectile", &|s| s.friction_projectile),
    ];
    if law.is_some() {
        section.retain(|series| series.name != "contact, projectile");
    }
    section.extend(beside(4, "W_tc + W_td", &["compaction_energy", "distortion_energy"]));
    let length = units.names()[0];
    let station = |i: usize| format!("{:.2} {length}", STATIONS[i] * case.half_length);
    let limit = case.fibre.strain_at_failure.map(|strain| 100.0 * strain);
    let speeds = [line(0, "speed", &|s| s.speed)].into_iter().chain(beside(1, "speed", &["speed"])).collect();
    // The law's width is that between outermost points, which of an ellipse that is full is the same.
    let mut widths: Vec<Series> = (0..STATIONS.len()).map(|i| line(i, &station(i), &|s| s.spreads[i])).collect();
    widths.extend(beside(4, "first", &["width_1"]));
    [
        panel("Speed of the projectile", SPEED, speeds),
        panel("Energies", ENERGY, energies),
        panel("Energies of the section", ENERGY, section),
        Panel { limit, ..Panel::new("Largest strain of a fibre", "%", vec![line(0, "strain", &|s| 100.0 * s.strain)]) },
        panel("Fastest bead", SPEED, vec![line(0, "speed", &|s| s.fastest)]),
        Panel::new("Width of the section by place", length, widths),
    ]
}
