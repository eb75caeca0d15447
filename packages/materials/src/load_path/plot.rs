//! The plot of a point's history: deformation, energies, stress and failure side by side, as SVG and PNG.

use std::path::Path;

use plotters::prelude::*;

use super::columns::{self, SYMMETRIC_NAMES};
use super::newton::{COMPONENT_NAMES, COMPONENTS};
use super::path::LoadPath;
use super::report::MODE_NAMES;
use super::run::{History, Increment};
use super::table;
use crate::material::model::Law;
use crate::units::{ENERGY, unit};
use toron::law::parameters::{ENERGY_DENSITY, NUMBER, STRESS};
use toron::law::state::{ENERGIES, INVARIANTS};
use toron_pictures::page::{self, Area, Drawn};
use toron_pictures::panel::{Abscissa, Panel, Series, tidy};
use toron_pictures::style::{COLOURS, GREY, INK, TEXT, TITLE, fine, text};
use toron_shared::error::Error;

/// Width and height of the picture.
const SIZE: [u32; 2] = [1280, 840];
/// Writes the plot of a history to two files.
///
/// # Errors
/// A file cannot be written.
pub fn write(svg: &Path, png: &Path, path: &LoadPath, history: &History) -> Result<(), Error> {
    page::write(svg, png, SIZE, |root| draw(root, path, history))
}

fn draw(root: &Area, path: &LoadPath, history: &History) -> Drawn<()> {
    let material = &history.point.material;
    let mut subtitle = format!("{} law, {}", material.law_name(), material.label);
    if path.points.len() > 1 {
        subtitle = format!("{}: {subtitle}", history.point.name);
    }
    root.draw_text(&path.title, &text(TITLE, &INK), (fine(24), fine(16)))?;
    root.draw_text(&subtitle, &text(TEXT, &GREY), (fine(24), fine(50)))?;
    let (_, body) = root.split_vertically(fine(84));
    let abscissa = abscissa(path, history);
    for (panel, area) in panels(path, history).iter().zip(body.split_evenly((2, 2))) {
        panel.draw(&area, &abscissa)?;
    }
    Ok(())
}

fn abscissa(path: &LoadPath, history: &History) -> Abscissa {
    let material = &history.point.material;
    let columns = columns::columns(material);
    let column = columns.iter().position(|column| column.name == path.abscissa).unwrap_or(0);
    let value = |increment: &Increment| table::values(increment, material, &path.element)[column];
    let values: Vec<f64> = history.increments.iter().map(value).collect();
    let label = match unit(&path.units, columns[column].dimension).as_str() {
        "-" => columns[column].name.clone(),
        unit => format!("{} ({unit})", columns[column].name),
    };
    Abscissa { label, failure: history.failure.map(|i| values[i]), values }
}

/// A value of every increment as a line.
fn line(history: &History, name: &str, colour: RGBColor, of: impl Fn(&Increment) -> f64) -> Series {
    Series { name: name.to_string(), colour, values: history.increments.iter().map(of).collect() }
}

/// Deformation, energies, stress; failure, or the work where nothing can fail.
fn panels(path: &LoadPath, history: &History) -> [Panel; 4] {
    let material = &history.point.material;
    let panel = |title, dimension, series, limit| Panel {
        title,
        unit: unit(&path.units, dimension),
        series: tidy(series),
        limit,
    };
    let (title, deformation, mut energies) = if material.law.yarn().is_some() {
        ("Deformation by mode: invariants", modes(history, INVARIANTS), modes(history, ENERGIES))
    } else {
        let name = if let Law::Own(_) = material.law { "energy" } else { "work" };
        let work = line(history, name, COLOURS[0], |i| material.energy(&i.answer.memory));
        ("Deformation gradient", gradient(history), vec![work])
    };
    let lost = |i: &Increment| material.lost_energy(&i.answer.memory);
    if history.increments.last().is_some_and(|last| lost(last).is_some()) {
        energies.push(line(history, "lost", GREY, |i| lost(i).unwrap_or(0.0)));
    }
    let stress = |k: usize| line(history, &format!("σ{}", SYMMETRIC_NAMES[k]), COLOURS[k], |i| i.answer.cauchy[k]);
    let last = if material.can_fail() {
        panel("Failure index", NUMBER, index(history), Some(1.0))
    } else {
        let stored = |i: &Increment| material.energy(&i.answer.memory) * path.element.volume();
        let external = line(history, "external work", COLOURS[0], |i| i.work);
        let stored = material.has_energy().then(|| line(history, "stored energy", COLOURS[1], stored));
        panel("Work", ENERGY, [external].into_iter().chain(stored).collect(), None)
    };
    [
        panel(title, NUMBER, deformation, None),
        panel("Energy per reference volume", ENERGY_DENSITY, energies, None),
        panel("Cauchy stress", STRESS, (0..6).map(stress).collect(), None),
        last,
    ]
}

/// Four state variables from `first` on, one for each deformation mode.
fn modes(history: &History, first: usize) -> Vec<Series> {
    let mode = |m: usize| line(history, MODE_NAMES[m], COLOURS[m], |i| i.answer.memory.state[first + m]);
    (0..4).map(mode).collect()
}

/// The components of F, less 1 on the diagonal.
fn gradient(history: &History) -> Vec<Series> {
    let component = |k: usize| {
        let (row, column) = COMPONENTS[k];
        let rest = if row == column { 1.0 } else { 0.0 };
        let name = format!("F{}{}", COMPONENT_NAMES[k], if row == column { " − 1" } else { "" });
        line(history, &name, COLOURS[k % COLOURS.len()], |i| i.rotated_gradient()[(row, column)] - rest)
    };
    (0..9).map(component).collect()
}

/// The failure index, and for the hyperelastic law the terms that it is the sum of.
fn index(history: &History) -> Vec<Series> {
    let material = &history.point.material;
    let total = |i: &Increment| material.failure_index(&i.answer.memory).unwrap_or(0.0);
    // Where the fibre is not in tension the index is 0, whatever its terms.
    let term = |m: usize| {
        let terms = |i: &Increment| material.failure_terms(&i.answer.memory).filter(|_| total(i) > 0.0);
        line(history, MODE_NAMES[m], COLOURS[m], |i| terms(i).map_or(0.0, |terms| terms[m]))
    };
    let mut series: Vec<Series> = match material.law {
        Law::Hyperelastic { .. } => (0..3).map(term).collect(),
        Law::LinearElastic { .. } | Law::Own(_) => Vec::new(),
    };
    series.push(line(history, "index", INK, total));
    series
}
