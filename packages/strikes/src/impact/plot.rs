//! Plots of a case's history, and of the residual speed over what the cases differ in.

use std::path::Path;

use plotters::prelude::*;

use super::outcome::{Outcome, STATIONS, Sample};
use super::scene::{Abscissa, Case, Scene, Striker};
use toron::host::units::UnitSystem;
use toron::law::parameters::ENERGY_DENSITY;
use toron_materials::units::{CONTACT_STIFFNESS, ENERGY, SPEED, TIME, unit};
use toron_pictures::history::{self, Samples};
use toron_pictures::page::{self, Area, Drawn};
use toron_pictures::panel::{self, Panel, Series, tidy};
use toron_pictures::style::{COLOURS, HEADING, INK, TEXT, TITLE, fine, stroke, text};
use toron_shared::error::Error;

const COMPARISON: [u32; 2] = [760, 480];

/// Speed, energies, largest energy densities and widths of a case over time, as far as they change, with the verdict of
/// the run.
///
/// # Errors
/// A file cannot be written.
pub fn write_history(
    svg: &Path,
    png: &Path,
    scene: &Scene,
    case: &Case,
    result: &Outcome,
    verdict: &str,
) -> Result<(), Error> {
    let samples = Samples(&result.history);
    let abscissa =
        samples.over_time(&unit(&scene.units, TIME), |sample| sample.time, result.course.broken.map(|(time, _)| time));
    let subtitle = format!("{}; verdict: {verdict}", case.name);
    history::write(svg, png, [&scene.title, &subtitle], panels(&samples, &scene.units, case), &abscissa)
}

fn panels(samples: &Samples<Sample>, units: &UnitSystem, case: &Case) -> [Panel; 4] {
    let line = |colour: usize, name: &str, of: &dyn Fn(&Sample) -> f64| samples.line(colour, name, of);
    let panel = |title, dimension, series: Vec<Series>| Panel::new(title, &unit(units, dimension), tidy(series));
    let mut energies = vec![
        line(1, "kinetic", &|s| s.energies.kinetic),
        line(2, "internal", &|s| s.energies.internal),
        line(3, "all other", &|s| s.energies.other()),
    ];
    // What is held or driven has its energy from outside.
    if let Striker::Cylinder { held: false, .. } = case.striker {
        energies.insert(0, line(0, "projectile", &|s| s.energies.striker));
        energies.push(Series { colour: INK, ..line(0, "total", &|s| s.energies.total()) });
    } else {
        energies.push(Series { colour: INK, ..line(0, "external work", &|s| s.energies.external) });
    }
    let modes = ["elongation", "compaction", "distortion", "shear", "work of the linear law"];
    let length = units.names()[0];
    let station = |i: usize| format!("{:.2} {length}", STATIONS[i] * case.yarn.length);
    [
        panel("Speed of the projectile", SPEED, vec![line(0, "speed", &|s| s.speed)]),
        panel("Energies", ENERGY, energies),
        panel(
            "Largest energy per reference volume",
            ENERGY_DENSITY,
            (0..modes.len()).map(|mode| line(mode, modes[mode], &|s| s.largest[mode])).collect(),
        ),
        Panel::new(
            "Width of the section by place",
            length,
            (0..STATIONS.len()).map(|i| line(i, &station(i), &|s| s.own.widths[i])).collect(),
        ),
    ]
}

/// The residual speeds of all cases over the scene's abscissa, which is logarithmic.
///
/// # Errors
/// A file cannot be written.
pub fn write_comparison(
    svg: &Path,
    png: &Path,
    scene: &Scene,
    abscissa: Abscissa,
    results: &[(&Case, Outcome)],
) -> Result<(), Error> {
    let points: Vec<Point> = results.iter().map(|(case, result)| point(abscissa, case, result)).collect();
    let label = match abscissa {
        Abscissa::Elements => "elements".to_string(),
        Abscissa::ContactStiffness => format!("contact stiffness ({})", unit(&scene.units, CONTACT_STIFFNESS)),
    };
    page::write(svg, png, COMPARISON, |root| draw_comparison(root, scene, &label, &points))
}

/// A case in the comparison.
struct Point<'a> {
    name: &'a str,
    place: (f64, f64),
    /// Whether its speed is the residual one, or what the run has ended with.
    residual: bool,
}

fn point<'a>(abscissa: Abscissa, case: &'a Case, result: &Outcome) -> Point<'a> {
    let x = match (abscissa, case.striker) {
        (Abscissa::ContactStiffness, Striker::Cylinder { cylinder, .. }) => cylinder.stiffness,
        _ => result.mesh.elements.len() as f64,
    };
    let residual = result.residual_speed();
    Point { name: &case.name, place: (x, residual.unwrap_or(result.last().speed)), residual: residual.is_some() }
}

fn draw_comparison(root: &Area, scene: &Scene, label: &str, points: &[Point]) -> Drawn<()> {
    root.draw_text(&scene.title, &text(TITLE, &INK), (fine(24), fine(16)))?;
    let hollow = if points.iter().all(|point| point.residual) { "" } else { "; hollow: at the end of the run" };
    let ordinate = format!("Residual speed ({}){hollow}", unit(&scene.units, SPEED));
    root.draw_text(&ordinate, &text(HEADING, &INK), (fine(24), fine(56)))?;
    let (_, body) = root.split_vertically(fine(88));
    let (left, right) =
        points.iter().fold((f64::INFINITY, 0.0_f64), |(l, r), point| (l.min(point.place.0), r.max(point.place.0)));
    let top = points.iter().map(|point| point.place.1).fold(0.0, f64::max);
    let (x, y) = ((left / 1.5..right * 1.5).log_scale(), 0.0..1.25 * top.max(1.0));
    let x_label = |x: &f64| if right < 1e5 { format!("{x:.0}") } else { format!("{x:.0e}") };
    let mut chart = panel::chart(&body, x, y, label, [&x_label, &|y| format!("{y:.0}")])?;
    for point in points {
        chart.draw_series([Circle::new(
            point.place,
            fine(5),
            if point.residual { COLOURS[0].filled() } else { stroke(COLOURS[0], 2) },
        )])?;
        let (x, y) = chart.backend_coord(&point.place);
        let style = text(TEXT, &INK);
        let (width, _) = body.estimate_text_size(point.name, &style)?;
        let (_, above) = body.get_base_pixel();
        body.draw_text(point.name, &style, (x - width as i32 / 2, y - above - fine(28)))?;
    }
    Ok(())
}
