//! Plots of a case's history.

use std::path::Path;

use super::model::Striking;
use super::outcome::{Outcome, Sample};
use super::scene::{Case, Scene};
use crate::common::error::Error;
use crate::common::units::{ENERGY, SPEED, TIME, unit};
use crate::impact::outcome::STATIONS;
use crate::picture::history;
use crate::picture::panel::{self, Panel, Series, tidy};
use crate::picture::style::{COLOURS, INK};

/// Speed, energies, strain and widths of a case over time, as far as they change.
///
/// # Errors
/// A file cannot be written.
pub fn write_history(svg: &Path, png: &Path, scene: &Scene, case: &Case, result: &Outcome) -> Result<(), Error> {
    let abscissa = panel::Abscissa {
        label: format!("time ({})", unit(&scene.units, TIME)),
        values: result.samples.iter().map(|sample| sample.time).collect(),
        failure: result.first_break(),
    };
    history::write(svg, png, [&scene.title, &case.name], panels(scene, case, result), &abscissa)
}

fn panels(scene: &Scene, case: &Case, result: &Outcome) -> [Panel; 6] {
    let line = |colour: usize, name: &str, of: &dyn Fn(&Sample) -> f64| Series {
        name: name.to_string(),
        colour: COLOURS[colour % COLOURS.len()],
        values: result.samples.iter().map(of).collect(),
    };
    let panel = |title, dimension, series: Vec<Series>| Panel {
        title,
        unit: unit(&scene.units, dimension),
        series: tidy(series),
        limit: None,
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
    let section = vec![
        line(0, "contact", &|s| s.contact),
        line(1, "contact, projectile", &|s| s.pressed),
        line(2, "friction, fibres", &|s| s.friction_fibres),
        line(3, "friction, projectile", &|s| s.friction_projectile),
    ];
    let length = scene.units.names()[0];
    let station = |i: usize| format!("{:.2} {length}", STATIONS[i] * case.half_length);
    let limit = case.fibre.strain_at_failure.map(|strain| 100.0 * strain);
    [
        panel("Speed of the projectile", SPEED, vec![line(0, "speed", &|s| s.speed)]),
        panel("Energies", ENERGY, energies),
        panel("Energies of the section", ENERGY, section),
        Panel { limit, ..panel_of("Largest strain of a fibre", "%", vec![line(0, "strain", &|s| 100.0 * s.strain)]) },
        panel("Fastest bead", SPEED, vec![line(0, "speed", &|s| s.fastest)]),
        panel_of(
            "Width of the section by place",
            length,
            (0..STATIONS.len()).map(|i| line(i, &station(i), &|s| s.spreads[i])).collect(),
        ),
    ]
}

fn panel_of(title: &'static str, unit: &str, series: Vec<Series>) -> Panel {
    Panel { title, unit: unit.to_string(), series, limit: None }
}
