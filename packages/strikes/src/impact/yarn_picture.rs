//! The deformed yarn coloured by each mode's energy: from the side, from above, and its section at mid-span.

use std::path::Path;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::outcome::Outcome;
use super::scene::{Case, Scene, Zones};
use toron::law::parameters::ENERGY_DENSITY;
use toron_explicit_host::mesh::Mesh;
use toron_explicit_host::snapshot::Snapshot;
use toron_materials::units::{time, unit};
use toron_pictures::colour_scale::{Colours, Scale};
use toron_pictures::page::{self, Area, Drawn};
use toron_pictures::ruler;
use toron_pictures::style::{GREY, INK, TEXT, TITLE, fine, stroke, text};
use toron_shared::error::Error;

const WIDTH: i32 = 1280;
/// Air beside all that is drawn.
const LEFT: i32 = 24;
/// Where the text of the title lies, and where the first row starts.
const TITLE_TOP: i32 = 16;
const TIME_TOP: i32 = 50;
const TOP: i32 = 84;
/// A row: its heading, the view from the side, the one from above, and air between and below them.
const HEAD: i32 = 42;
const BETWEEN: i32 = 18;
const BELOW: i32 = 26;
/// What the projectile is longer than the yarn is wide, in the view from above.
const OVERHANG: i32 = 8;
/// What the two views of the whole yarn may take; their names stand beside them.
const LONGEST: i32 = 860;
const HIGHEST: i32 = 400;
const NAME_AIR: i32 = 12;
const NAME_BELOW: i32 = 9;
/// The section's part of the width, and what the section at rest may take: it widens.
const SECTION: i32 = 270;
const AT_REST: [f64; 2] = [220.0, 90.0];
/// The scale of colours in the heading: its middle, how far its name indents it, and its width.
const SCALE_MIDDLE: i32 = 10;
const SCALE_INDENT: i32 = 126;
const SCALE_WIDTH: i32 = 200;
/// The last line, with the scales of lengths.
const FOOT: i32 = 34;
const BAR_TOP: i32 = 8;
const PROJECTILE: RGBColor = RGBColor(232, 232, 232);
const MODES: [&str; 3] = ["Elongation", "Compaction", "Distortion"];

/// A side of an element along the yarn: its corners towards mid-span, and where the element stands that would hide it,
/// by columns and rows.
struct Side {
    corners: [usize; 2],
    neighbour: [isize; 2],
}

const UPPER: Side = Side { corners: [2, 6], neighbour: [0, 1] };
const LOWER: Side = Side { corners: [0, 4], neighbour: [0, -1] };
const NEARER: Side = Side { corners: [4, 6], neighbour: [1, 0] };

/// What the rows show: the modes or, where there is none, the work of the linear law. Of two laws the first row has
/// both.
fn rows(case: &Case) -> Vec<&'static str> {
    match &case.zones {
        Zones::One(material) if material.law.yarn().is_none() => vec!["Work"],
        Zones::One(_) => MODES.to_vec(),
        Zones::Two(..) => vec!["Elongation*", MODES[1], MODES[2]],
    }
}

/// Draws the yarn as it stood at an instant, with the verdict of the run.
///
/// # Errors
/// A file cannot be written.
pub fn write(
    svg: &Path,
    png: &Path,
    (scene, case, verdict): (&Scene, &Case, &str),
    result: &Outcome,
    snapshot: &Snapshot,
) -> Result<(), Error> {
    let names = rows(case);
    let drawing = Drawing::new(&result.mesh, case, snapshot);
    let height = TOP + names.len() as i32 * drawing.row_height() + FOOT;
    page::write(svg, png, [WIDTH as u32, height as u32], |root| {
        let title = format!("{}: {}", scene.title, case.name);
        root.draw_text(&title, &text(TITLE, &INK), (fine(LEFT), fine(TITLE_TOP)))?;
        let laws = if matches!(case.zones, Zones::Two(..)) { "; * work, where the law is linear" } else { "" };
        let scales = "energies per reference volume, colours by the square root";
        let time = format!("at {}, {scales}{laws}; verdict: {verdict}", time(&scene.units, snapshot.time));
        root.draw_text(&time, &text(TEXT, &GREY), (fine(LEFT), fine(TIME_TOP)))?;
        for (mode, name) in names.into_iter().enumerate() {
            let top = TOP + mode as i32 * drawing.row_height();
            drawing.draw_row(&root.margin(fine(top), 0, 0, 0), mode, name, &unit(&scene.units, ENERGY_DENSITY))?;
        }
        drawing.draw_foot(&root.margin(fine(height - FOOT), 0, 0, 0), scene.units.names()[0])
    })
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

struct Drawing<'a> {
    mesh: &'a Mesh,
    case: &'a Case,
    snapshot: &'a Snapshot,
    /// Size in the picture of a unit of length, in the views of the whole yarn.
    scale: f64,
    /// What there is to see from the side, from below to above, and the half of it from above.
    heights: [f64; 2],
    half_width: f64,
}

impl<'a> Drawing<'a> {
    fn new(mesh: &'a Mesh, case: &'a Case, snapshot: &'a Snapshot) -> Self {
        let mut reach = [case.yarn.length, 0.0, 0.5 * case.yarn.width];
        let mut heights = [-0.5 * case.yarn.height, 0.5 * case.yarn.height];
        let mut include = |y: f64| heights = [heights[0].min(y), heights[1].max(y)];
        for element in (0..mesh.elements.len()).filter(|&element| snapshot.intact[element]) {
            for x in mesh.elements[element].map(|node| snapshot.positions[node as usize]) {
                reach = [0, 1, 2].map(|axis| x[axis].abs().max(reach[axis]));
                include(x[1]);
            }
        }
        if let Some((height, radius)) = snapshot.striker {
            include(height - radius);
            include(height + radius);
        }
        let scale = (f64::from(LONGEST) / (2.0 * reach[0])).min(f64::from(HIGHEST) / (heights[1] - heights[0]));
        Drawing { mesh, case, snapshot, scale, heights, half_width: reach[2] }
    }

    fn side_height(&self) -> i32 {
        (self.scale * (self.heights[1] - self.heights[0])).ceil() as i32
    }

    fn above_height(&self) -> i32 {
        (2.0 * self.scale * self.half_width).ceil() as i32 + 2 * OVERHANG
    }

    fn row_height(&self) -> i32 {
        HEAD + self.side_height() + BETWEEN + self.above_height() + BELOW
    }

    fn draw_row(&self, area: &Area, mode: usize, name: &str, unit: &str) -> Drawn<()> {
        // The linear law has no modes.
        let density = |w: &[f64; 5]| if mode == 0 { w[0] + w[4] } else { w[mode] };
        let largest = self.snapshot.largest(density);
        let scale = Scale {
            name,
            indent: SCALE_INDENT,
            width: SCALE_WIDTH,
            largest,
            unit,
            colours: Colours::GreyToRed,
            root: true,
        };
        scale.draw(area, [LEFT, SCALE_MIDDLE])?;
        let shade = |element: usize| scale.colour(density(&self.snapshot.densities[element]));
        self.draw_side(area, &shade)?;
        self.draw_above(area, &shade)?;
        self.draw_section(area, &shade)
    }

    /// From the side: the yarn before the projectile, the far side first, which the near one covers.
    fn draw_side(&self, area: &Area, shade: &dyn Fn(usize) -> RGBColor) -> Drawn<()> {
        let top = f64::from(HEAD) + self.scale * self.heights[1];
        let view = View { scale: self.scale, origin: [f64::from(LEFT + LONGEST / 2), top] };
        if let Some((height, radius)) = self.snapshot.striker {
            let (centre, radius) = (view.place([0.0, height]), (self.scale * radius * f64::from(fine(1))) as i32);
            area.draw(&Circle::new(centre, radius, PROJECTILE.filled()))?;
            area.draw(&Circle::new(centre, radius, stroke(GREY, 1)))?;
        }
        let place = |[x, y, _]: [f64; 3]| view.place([x, y]);
        let yarn = &self.case.yarn;
        for (column, row) in (0..yarn.columns).flat_map(|column| (0..yarn.rows).map(move |row| (column, row))) {
            for side in [LOWER, UPPER, NEARER] {
                self.draw_line(area, [column, row], &side, &place, shade)?;
            }
        }
        name_view(area, "from the side", view.place([yarn.length, 0.0]))
    }

    /// From above, as if the projectile could be looked through.
    fn draw_above(&self, area: &Area, shade: &dyn Fn(usize) -> RGBColor) -> Drawn<()> {
        let top = HEAD + self.side_height() + BETWEEN;
        let middle = f64::from(top) + 0.5 * f64::from(self.above_height());
        let view = View { scale: self.scale, origin: [f64::from(LEFT + LONGEST / 2), middle] };
        if let Some((_, radius)) = self.snapshot.striker {
            let [left, right] = [-radius, radius].map(|x| view.place([x, 0.0]).0);
            let [top, bottom] = [top, top + self.above_height()].map(fine);
            area.draw(&Rectangle::new([(left, top), (right, bottom)], PROJECTILE.filled()))?;
            for x in [left, right] {
                area.draw(&PathElement::new([(x, top), (x, bottom)], stroke(GREY, 1)))?;
            }
        }
        let place = |[x, _, z]: [f64; 3]| view.place([x, z]);
        let yarn = &self.case.yarn;
        for (row, column) in (0..yarn.rows).flat_map(|row| (0..yarn.columns).map(move |column| (row, column))) {
            self.draw_line(area, [column, row], &UPPER, &place, shade)?;
        }
        name_view(area, "from above", view.place([yarn.length, 0.0]))
    }

    /// One side of the elements of a column and a row, as far as it is seen: the half that was computed and its mirror
    /// image, in strips of one colour.
    fn draw_line(
        &self,
        area: &Area,
        [column, row]: [usize; 2],
        side: &Side,
        place: &dyn Fn([f64; 3]) -> (i32, i32),
        shade: &dyn Fn(usize) -> RGBColor,
    ) -> Drawn<()> {
        let layers = self.case.yarn.layers;
        let mut strip = Strip::default();
        for step in 0..2 * layers {
            let (layer, sign) = if step < layers { (layers - 1 - step, -1.0) } else { (step - layers, 1.0) };
            let Some(element) = self.seen(layer, column, row, side) else {
                std::mem::take(&mut strip).draw(area)?;
                continue;
            };
            let edge = |along: usize| {
                side.corners.map(|corner| {
                    let [x, y, z] = self.node(element, corner | along);
                    place([sign * x, y, z])
                })
            };
            let (start, end) = if sign < 0.0 { (edge(1), edge(0)) } else { (edge(0), edge(1)) };
            let colour = shade(element);
            if strip.colour != colour || strip.edges.is_empty() {
                std::mem::replace(&mut strip, Strip { colour, edges: vec![start] }).draw(area)?;
            }
            strip.edges.push(end);
        }
        strip.draw(area)
    }

    /// The element of that place if it is there and no other hides its side.
    fn seen(&self, layer: usize, column: usize, row: usize, side: &Side) -> Option<usize> {
        let [across, up] = side.neighbour;
        let next = column.checked_add_signed(across).zip(row.checked_add_signed(up));
        let hidden = next.is_some_and(|(column, row)| self.intact(layer, column, row).is_some());
        self.intact(layer, column, row).filter(|_| !hidden)
    }

    fn intact(&self, layer: usize, column: usize, row: usize) -> Option<usize> {
        let yarn = &self.case.yarn;
        let element = layer * self.mesh.elements_per_layer + column * yarn.rows + row;
        (column < yarn.columns && row < yarn.rows && self.snapshot.intact[element]).then_some(element)
    }

    fn node(&self, element: usize, corner: usize) -> [f64; 3] {
        self.snapshot.positions[self.mesh.elements[element][corner] as usize]
    }

    fn section_scale(&self) -> f64 {
        (AT_REST[0] / self.case.yarn.width).min(AT_REST[1] / self.case.yarn.height)
    }

    /// The elements beside mid-span, seen along the yarn.
    fn draw_section(&self, area: &Area, shade: &dyn Fn(usize) -> RGBColor) -> Drawn<()> {
        let intact = (0..self.mesh.elements_per_layer).filter(|&element| self.snapshot.intact[element]);
        let faces = intact.map(|element| (element, [0, 2, 6, 4].map(|corner| self.node(element, corner))));
        let faces: Vec<(usize, [[f64; 3]; 4])> = faces.collect();
        let heights = || faces.iter().flat_map(|(_, face)| face.map(|node| node[1]));
        let [low, high] = [heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max)];
        let [centre, half] = [0.5 * (low + high), 0.5 * (high - low).max(0.0)];
        let origin = [WIDTH - LEFT - SECTION / 2, HEAD + self.side_height() / 2].map(f64::from);
        let view = View { scale: self.section_scale(), origin };
        for &(element, face) in &faces {
            let mut points = face.map(|[_, y, z]| view.place([z, y - centre])).to_vec();
            area.draw(&Polygon::new(points.clone(), shade(element).filled()))?;
            points.push(points[0]);
            area.draw(&PathElement::new(points, stroke(WHITE, 1)))?;
        }
        let (x, y) = view.place([0.0, -half]);
        let name = if faces.is_empty() { "torn at mid-span" } else { "at mid-span" };
        area.draw_text(name, &beside().pos(Pos::new(HPos::Center, VPos::Top)), (x, y + fine(NAME_BELOW)))?;
        Ok(())
    }

    /// The lengths that the views and the sections are measured by.
    fn draw_foot(&self, area: &Area, unit: &str) -> Drawn<()> {
        for (left, scale) in [(LEFT, self.scale), (WIDTH - LEFT - SECTION, self.section_scale())] {
            ruler::draw(area, [left, BAR_TOP], scale, unit)?;
        }
        Ok(())
    }
}

/// Sides of elements in a row, of one colour: the edges between them.
#[derive(Default)]
struct Strip {
    colour: RGBColor,
    edges: Vec<[(i32, i32); 2]>,
}

impl Strip {
    fn draw(self, area: &Area) -> Drawn<()> {
        let forth = self.edges.iter().map(|edge| edge[0]);
        let back = self.edges.iter().rev().map(|edge| edge[1]);
        let mut outline: Vec<(i32, i32)> = forth.chain(back).collect();
        let Some(&start) = outline.first() else { return Ok(()) };
        area.draw(&Polygon::new(outline.clone(), self.colour.filled()))?;
        // Between neighbours the ground would shine through, but for a line of one dot of the PNG.
        outline.push(start);
        area.draw(&PathElement::new(outline, self.colour.stroke_width(7 * fine(1) as u32 / 10)))?;
        Ok(())
    }
}

/// The name of a view beside the end of the yarn.
fn name_view(area: &Area, name: &str, (x, y): (i32, i32)) -> Drawn<()> {
    area.draw_text(name, &beside(), (x + fine(NAME_AIR), y))?;
    Ok(())
}

/// Text beside what it names.
fn beside() -> TextStyle<'static> {
    text(TEXT, &GREY).pos(Pos::new(HPos::Left, VPos::Center))
}
