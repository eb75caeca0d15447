//! The deformed yarn coloured by each mode's energy: from the side and above, and its section at mid-span.

use std::path::Path;

use plotters::prelude::*;

use super::run::{Outcome, Snapshot};
use super::scene::{Case, Scene, Zones};
use crate::Error;
use crate::explicit::mesh::Mesh;
use crate::material::Law;
use crate::picture::{self, Area, Drawn, GREY, HEADING, INK, TEXT, TITLE, fine, stroke, text};
use crate::unit_names::{number, time, unit};
use toron::law::parameters::ENERGY_DENSITY;

const WIDTH: u32 = 1280;
/// The part of the width that the view of the whole yarn gets; the rest is the section's.
const SIDE: i32 = 960;
const ROW: i32 = 272;
/// Air below the last row.
const BOTTOM: i32 = 4;
/// Where the first row starts, the height of a row's heading, and where the yarn's axis lies below that.
const TOP: i32 = 80;
const HEAD: i32 = 38;
const AXIS: f64 = 78.0;
/// Air beside the pictures, and beside all text on the left.
const AIR: i32 = 30;
const LEFT: i32 = 24;
/// Where the text of the headings lies below their tops.
const TITLE_TOP: i32 = 16;
const TIME_TOP: i32 = 50;
const NAME_TOP: i32 = 8;
const LABEL_TOP: i32 = 10;
/// Air between the scale of colours and its label.
const LABEL_AIR: i32 = 12;
/// Corners of the projectile's circle.
const CORNERS: usize = 72;
/// The scale of colours: its place, width and height in the heading, and its steps.
const SCALE_LEFT: i32 = 180;
const SCALE_WIDTH: i32 = 200;
const SCALE_TOP: i32 = 12;
const SCALE_HEIGHT: i32 = 14;
const SCALE_STEPS: i32 = 40;
/// Looking down by so much, the top is seen: a length across is drawn upwards in this proportion.
const TILT: f64 = 1.0;
const MODES: [&str; 3] = ["Elongation", "Compaction", "Distortion"];

/// What the rows show: the modes or, where there is none, the work of the linear law. Of two laws the first row has both.
fn rows(case: &Case) -> Vec<&'static str> {
    match &case.zones {
        Zones::One(material) if matches!(material.law, Law::LinearElastic { .. }) => vec!["Work"],
        Zones::One(_) => MODES.to_vec(),
        Zones::Two(..) => vec!["Elongation*", MODES[1], MODES[2]],
    }
}

/// Draws the yarn as it stood at an instant.
///
/// # Errors
/// A file cannot be written.
pub fn write(
    svg: &Path,
    png: &Path,
    scene: &Scene,
    case: &Case,
    result: &Outcome,
    snapshot: &Snapshot,
) -> Result<(), Error> {
    let rows = rows(case);
    let size = [WIDTH, (TOP + ROW * rows.len() as i32 + BOTTOM) as u32];
    picture::write(svg, png, size, |root| {
        let title = format!("{}: {}", scene.title, case.name);
        root.draw_text(&title, &text(TITLE, &INK), (fine(LEFT), fine(TITLE_TOP)))?;
        let laws = if matches!(case.zones, Zones::Two(..)) { "; * work, where the law is linear" } else { "" };
        let time = format!("at {}{laws}", time(&scene.units, snapshot.time));
        root.draw_text(&time, &text(TEXT, &GREY), (fine(LEFT), fine(TIME_TOP)))?;
        let drawing = Drawing { mesh: &result.mesh, case, snapshot };
        for (mode, name) in rows.into_iter().enumerate() {
            let top = TOP + ROW * mode as i32;
            let row = root.margin(fine(top), 0, 0, 0);
            drawing.draw_row(&row, mode, name, &unit(&scene.units, ENERGY_DENSITY))?;
        }
        Ok(())
    })
}

struct Drawing<'a> {
    mesh: &'a Mesh,
    case: &'a Case,
    snapshot: &'a Snapshot,
}

/// From lengths to the picture: a scale and the place of the origin.
struct View {
    scale: f64,
    origin: [f64; 2],
}

impl View {
    fn place(&self, [x, y]: [f64; 2]) -> (i32, i32) {
        let [a, b] = [self.origin[0] + self.scale * x, self.origin[1] - self.scale * y];
        ((a * f64::from(fine(1))) as i32, (b * f64::from(fine(1))) as i32)
    }
}

/// A colour of viridis between nothing and the largest value.
fn colour(share: f64) -> RGBColor {
    ViridisRGB.get_color(share.clamp(0.0, 1.0))
}

impl Drawing<'_> {
    fn draw_row(&self, area: &Area, mode: usize, name: &str, unit: &str) -> Drawn<()> {
        // The linear law has no modes.
        let density = |w: &[f64; 5]| if mode == 0 { w[0] + w[4] } else { w[mode] };
        let values = self.snapshot.densities.iter().zip(&self.snapshot.intact);
        let largest = values.filter(|(_, intact)| **intact).map(|(w, _)| density(w)).fold(0.0, f64::max);
        draw_head(area, name, largest, unit)?;
        let share = |element: usize| density(&self.snapshot.densities[element]) / largest;
        let shade = |element: usize| colour(if largest > 0.0 { share(element) } else { 0.0 });
        self.draw_side(area, &shade)?;
        self.draw_section(area, &shade)
    }

    /// The whole yarn: the half that was computed, and its mirror image.
    fn draw_side(&self, area: &Area, shade: &dyn Fn(usize) -> RGBColor) -> Drawn<()> {
        let span = 2.0 * self.case.yarn.length;
        let scale = f64::from(SIDE - 2 * AIR) / span;
        let view = View { scale, origin: [f64::from(SIDE) / 2.0, f64::from(HEAD) + AXIS] };
        // The far side first.
        for column in (0..self.case.yarn.columns).rev() {
            let rows = self.case.yarn.rows;
            for (layer, row) in (0..self.case.yarn.layers).flat_map(|layer| (0..rows).map(move |row| (layer, row))) {
                // What stands above covers it.
                let element = self.element(layer, column, row);
                if !self.snapshot.intact[element] {
                    continue;
                }
                // The corners of the upper face, around it.
                let face = [2, 3, 7, 6].map(|corner| self.mesh.elements[element][corner] as usize);
                for side in [1.0, -1.0] {
                    let points = face.map(|node| {
                        let [x, y, z] = self.snapshot.positions[node];
                        view.place([side * x, y + TILT * z])
                    });
                    area.draw(&Polygon::new(points.to_vec(), shade(element).filled()))?;
                }
            }
        }
        if let Some((height, radius)) = self.snapshot.projectile {
            let turn = |i: usize| 2.0 * std::f64::consts::PI * i as f64 / CORNERS as f64;
            let circle = (0..=CORNERS)
                .map(|i| view.place([radius * turn(i).cos(), height + radius * turn(i).sin()]))
                .collect::<Vec<_>>();
            area.draw(&PathElement::new(circle, stroke(GREY, 2)))?;
        }
        Ok(())
    }

    /// The elements beside mid-span, seen along the yarn.
    fn draw_section(&self, area: &Area, shade: &dyn Fn(usize) -> RGBColor) -> Drawn<()> {
        let yarn = &self.case.yarn;
        let nodes = 0..self.mesh.nodes_per_section;
        let centre = nodes.clone().map(|node| self.snapshot.positions[node][1]).sum::<f64>() / nodes.len() as f64;
        // Twice the section's width has room.
        let scale = f64::from(WIDTH as i32 - SIDE - 2 * AIR) / (2.0 * yarn.width);
        let origin = [f64::from(SIDE) + f64::from(WIDTH as i32 - SIDE) / 2.0, f64::from(HEAD + ROW) / 2.0];
        let view = View { scale, origin };
        for element in (0..self.mesh.elements_per_layer).filter(|&element| self.snapshot.intact[element]) {
            let face = [0, 2, 6, 4].map(|corner| self.mesh.elements[element][corner] as usize);
            let mut points: Vec<(i32, i32)> = face
                .iter()
                .map(|&node| {
                    let [_, y, z] = self.snapshot.positions[node];
                    view.place([z, y - centre])
                })
                .collect();
            area.draw(&Polygon::new(points.clone(), shade(element).filled()))?;
            points.push(points[0]);
            area.draw(&PathElement::new(points, stroke(WHITE, 1)))?;
        }
        Ok(())
    }

    fn element(&self, layer: usize, column: usize, row: usize) -> usize {
        layer * self.mesh.elements_per_layer + column * self.case.yarn.rows + row
    }
}

/// The mode's name, and what its colours mean.
fn draw_head(area: &Area, name: &str, largest: f64, unit: &str) -> Drawn<()> {
    area.draw_text(name, &text(HEADING, &INK), (fine(LEFT), fine(NAME_TOP)))?;
    for step in 0..SCALE_STEPS {
        let x = |i: i32| fine(SCALE_LEFT) + fine(SCALE_WIDTH) * i / SCALE_STEPS;
        // To the end, each over the last: between neighbours the ground would shine through.
        let corners = [(x(step), fine(SCALE_TOP)), (x(SCALE_STEPS), fine(SCALE_TOP + SCALE_HEIGHT))];
        let share = f64::from(step) / f64::from(SCALE_STEPS - 1);
        area.draw(&Rectangle::new(corners, colour(share).filled()))?;
    }
    let label = format!("0 to {} {unit}", number(largest));
    area.draw_text(&label, &text(TEXT, &INK), (fine(SCALE_LEFT + SCALE_WIDTH + LABEL_AIR), fine(LABEL_TOP)))?;
    Ok(())
}
