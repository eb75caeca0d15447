//! The deformed fibres, coloured by their von Mises stress.

use std::path::Path;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::model::Model;
use super::report::title;
use super::run::{Outcome, Shape};
use super::scene::Scene;
use toron::law::parameters::STRESS;
use toron_materials::units::unit;
use toron_pictures::page::{self, Area, Drawn};
use toron_pictures::style::{GREY, INK, TEXT, TITLE, fine, stroke, text};
use toron_shared::error::Error;
use toron_shared::numbers::number;

/// The width of what is drawn, the air around it, and the heading's height.
const WIDTH: i32 = 760;
const AIR: i32 = 24;
const HEAD: i32 = 116;
const TITLE_TOP: i32 = 16;
const TEXT_TOP: i32 = 48;
/// The scale of colours: place, size, steps.
const SCALE_TOP: i32 = 78;
const SCALE_SIZE: [i32; 2] = [260, 16];
const SCALE_STEPS: i32 = 64;
const NAME_AIR: i32 = 12;
/// A cell that symmetry leaves is continued by mirror images: from −1 to this many of its widths and heights.
const IMAGES: [[i32; 2]; 2] = [[-1, 3], [-1, 1]];

/// Draws the fibres as they are at the end of a load.
///
/// # Errors
/// A file cannot be written.
pub fn write(svg: &Path, png: &Path, scene: &Scene, model: &Model, outcome: &Outcome) -> Result<(), Error> {
    let Some(last) = outcome.increments.last() else { return Ok(()) };
    let stretches = outcome.load.stretches(last.stretch);
    let size = [0, 1].map(|axis| model.size[axis] * stretches[axis]);
    let images = if model.mirrored { IMAGES } else { [[0, 1]; 2] };
    let [width, height] = [0, 1].map(|axis| size[axis] * f64::from(images[axis][1] - images[axis][0]));
    let scale = f64::from(WIDTH) / width;
    let sheet = [WIDTH + 2 * AIR, HEAD + (scale * height).ceil() as i32 + AIR];
    let low = [0, 1].map(|axis| size[axis] * f64::from(images[axis][0]));
    let view = View { scale, low, top: f64::from(HEAD) + scale * height };
    let largest = outcome.shape.patches.iter().map(|(_, stress)| *stress).fold(0.0, f64::max);
    page::write(svg, png, sheet.map(|length| length as u32), |root| {
        root.draw_text(&scene.title, &text(TITLE, &INK), (fine(AIR), fine(TITLE_TOP)))?;
        let [i_tc, i_td] = last.invariants;
        let line = format!("{}, I_tc = {i_tc:.3}, I_td = {i_td:.3}: von Mises stress", title(outcome.load));
        root.draw_text(&line, &text(TEXT, &GREY), (fine(AIR), fine(TEXT_TOP)))?;
        draw_scale(root, largest, &unit(&scene.units, STRESS))?;
        for image in images[0][0]..images[0][1] {
            for row in images[1][0]..images[1][1] {
                draw_image(root, &view, &outcome.shape, [image, row], size, largest)?;
            }
        }
        draw_frame(root, &view, [low, [0, 1].map(|axis| size[axis] * f64::from(images[axis][1]))], model.mirrored)
    })
}

struct View {
    scale: f64,
    low: [f64; 2],
    top: f64,
}

impl View {
    fn place(&self, [x, y]: [f64; 2]) -> (i32, i32) {
        let left = f64::from(AIR) + self.scale * (x - self.low[0]);
        let down = self.top - self.scale * (y - self.low[1]);
        ((left * f64::from(fine(1))) as i32, (down * f64::from(fine(1))) as i32)
    }
}

fn colour(share: f64) -> RGBColor {
    ViridisRGB.get_color(share.clamp(0.0, 1.0))
}

/// The image in this column and row of cells: mirrored in every other one.
fn draw_image(root: &Area, view: &View, shape: &Shape, image: [i32; 2], size: [f64; 2], largest: f64) -> Drawn<()> {
    let place = |x: f64, axis: usize| {
        let (cell, size) = (image[axis], size[axis]);
        if cell.rem_euclid(2) == 0 { f64::from(cell) * size + x } else { f64::from(cell + 1) * size - x }
    };
    for (corners, stress) in &shape.patches {
        let mut points: Vec<(i32, i32)> =
            corners.iter().map(|[x, y]| view.place([place(*x, 0), place(*y, 1)])).collect();
        let fill = colour(if largest > 0.0 { stress / largest } else { 0.0 });
        root.draw(&Polygon::new(points.clone(), fill.filled()))?;
        // Between neighbours the ground would shine through.
        points.push(points[0]);
        root.draw(&PathElement::new(points, fill.stroke_width(fine(1) as u32 / 2)))?;
    }
    for rim in &shape.rims {
        let points = rim.map(|[x, y]| view.place([place(x, 0), place(y, 1)]));
        root.draw(&PathElement::new(points, INK.stroke_width(fine(1) as u32)))?;
    }
    Ok(())
}

/// The walls, or the cell that was computed among its images.
fn draw_frame(root: &Area, view: &View, [low, high]: [[f64; 2]; 2], mirrored: bool) -> Drawn<()> {
    let [low, high] =
        if mirrored { [[0.0; 2], [0, 1].map(|axis| high[axis] / f64::from(IMAGES[axis][1]))] } else { [low, high] };
    let corners = [low, [high[0], low[1]], high, [low[0], high[1]], low].map(|corner| view.place(corner));
    root.draw(&PathElement::new(corners, stroke(INK, 1)))?;
    Ok(())
}

/// What the colours mean.
fn draw_scale(root: &Area, largest: f64, unit: &str) -> Drawn<()> {
    let [width, height] = SCALE_SIZE;
    for step in 0..SCALE_STEPS {
        let x = |i: i32| fine(AIR) + fine(width) * i / SCALE_STEPS;
        // To the end, each over the last: between neighbours the ground would shine through.
        let corners = [(x(step), fine(SCALE_TOP)), (x(SCALE_STEPS), fine(SCALE_TOP + height))];
        let share = f64::from(step) / f64::from(SCALE_STEPS - 1);
        root.draw(&Rectangle::new(corners, colour(share).filled()))?;
    }
    let style = text(TEXT, &GREY).pos(Pos::new(HPos::Left, VPos::Center));
    let label = format!("0 to {} {unit}", number(largest));
    root.draw_text(&label, &style, (fine(AIR + width + NAME_AIR), fine(SCALE_TOP + height / 2)))?;
    Ok(())
}
