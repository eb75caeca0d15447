//! The fibres of a pressed section at an instant, coloured by the energy of their contacts.

use std::path::Path;

use plotters::prelude::*;

use super::outcome::Pressed;
use crate::fibres::frame::Frame;
use crate::fibres::model::micro;
use crate::fibres::scene::{Case, Scene};
use toron::law::parameters::STRESS;
use toron_materials::units::{LENGTH, TIME, time, unit};
use toron_pictures::colour_scale::{Colours, Scale};
use toron_pictures::page::{self, Area, Drawn};
use toron_pictures::ruler;
use toron_pictures::style::{GREY, INK, TEXT, TITLE, fine, stroke, text};
use toron_pictures::view::View;
use toron_shared::error::Error;

const WIDTH: i32 = 760;
const LEFT: i32 = 24;
const TITLE_TOP: i32 = 16;
const TIME_TOP: i32 = 50;
const SCALE_MIDDLE: i32 = 92;
const SCALE_INDENT: i32 = 150;
const SCALE_WIDTH: i32 = 200;
const TOP: i32 = 120;
const BELOW: i32 = 44;

/// Draws the fibres and the walls.
///
/// # Errors
/// A file cannot be written.
pub fn write(svg: &Path, png: &Path, scene: &Scene, case: &Case, result: &Pressed, frame: &Frame) -> Result<(), Error> {
    let model = &result.model;
    let length = micro(&scene.units, LENGTH);
    let instant = micro(&scene.units, TIME) * frame.step as f64 * model.step;
    let sample = result.samples.iter().find(|sample| sample.time >= instant * (1.0 - 1e-9));
    let sample = sample.copied().unwrap_or_else(|| result.last());
    // Over what a fibre takes of the section.
    let area = model.section.area * model.diameter * model.diameter / model.centres.len() as f64;
    let density = micro(&scene.units, STRESS) / (area * model.spacing);
    let largest = density * frame.values.iter().copied().fold(0.0, f64::max);
    let radius = 0.5 * model.diameter;
    let walls = result.pressing.walls.pairs();
    let ways = [0, 1].map(|axis| walls[axis].map(|_| sample.ways[axis] * result.pressing.half[axis]));
    // Beads are written along the fibre, along the blow, across the yarn.
    let reach = [0, 1].map(|axis| {
        let beads = frame.positions.iter().map(|bead| bead[2 - axis].abs() + radius);
        length * beads.fold(ways[axis].unwrap_or(0.0), f64::max)
    });
    let view = View::strip([LEFT, TOP], WIDTH - 2 * LEFT, reach.map(|x| -x), reach);
    let height = TOP + view.size()[1] as i32 + BELOW;
    let colours = Scale {
        name: "Contact energy",
        indent: SCALE_INDENT,
        width: SCALE_WIDTH,
        largest,
        unit: &unit(&scene.units, STRESS),
        colours: Colours::Viridis,
        root: false,
    };
    page::write(svg, png, [WIDTH as u32, height as u32], |root| {
        root.draw_text(&format!("{}: {}", scene.title, case.name), &text(TITLE, &INK), (fine(LEFT), fine(TITLE_TOP)))?;
        let [i_tc, i_td] = sample.middle.invariants;
        let heading = format!(
            "at {}; {} fibres, I_tc = {i_tc:.3}, I_td = {i_td:.3} in the middle",
            time(&scene.units, instant),
            case.fibres
        );
        root.draw_text(&heading, &text(TEXT, &GREY), (fine(LEFT), fine(TIME_TOP)))?;
        colours.draw(root, [LEFT, SCALE_MIDDLE])?;
        for (bead, energy) in frame.positions.iter().zip(&frame.values) {
            let place = view.place([length * bead[2], length * bead[1]]);
            let size = (length * radius * view.scale * f64::from(fine(1))) as i32;
            root.draw(&Circle::new(place, size, colours.colour(density * energy).filled()))?;
        }
        draw_walls(root, &view, ways.map(|way| way.map(|way| length * way)), reach)?;
        ruler::draw(root, [LEFT, height - BELOW / 2], view.scale, scene.units.names()[0])
    })
}

/// Those that there are; plates reach beyond the fibres.
fn draw_walls(root: &Area, view: &View, ways: [Option<f64>; 2], reach: [f64; 2]) -> Drawn<()> {
    for axis in 0..2 {
        let Some(way) = ways[axis] else { continue };
        let along = ways[1 - axis].unwrap_or(reach[1 - axis]);
        for side in [-way, way] {
            let end = |along: f64| view.place(if axis == 0 { [side, along] } else { [along, side] });
            root.draw(&PathElement::new(vec![end(-along), end(along)], stroke(INK, 2)))?;
        }
    }
    Ok(())
}
