//! The fibres at an instant, coloured by their strain: from the side, from above, and in section at mid-span and at the
//! stations.

use std::path::Path;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::frame::Frame;
use super::model::{Model, Striking, micro};
use super::outcome::Outcome;
use super::scene::{Case, Scene};
use toron_materials::units::{LENGTH, TIME, time};
use toron_pictures::colour_scale::{Colours, Scale};
use toron_pictures::page::{self, Area, Drawn};
use toron_pictures::ruler;
use toron_pictures::style::{GREY, INK, TEXT, TITLE, fine, stroke, text};
use toron_pictures::view::View;
use toron_shared::error::Error;
use toron_strikes::impact::outcome::STATIONS;

const WIDTH: i32 = 1280;
/// Air beside all that is drawn.
const LEFT: i32 = 24;
const TITLE_TOP: i32 = 16;
const TIME_TOP: i32 = 50;
const SCALE_MIDDLE: i32 = 92;
const SCALE_INDENT: i32 = 60;
const SCALE_WIDTH: i32 = 200;
/// Where the view from the side begins; air between the views; room for a line of text.
const TOP: i32 = 116;
const BETWEEN: i32 = 16;
const LINE: i32 = 34;
/// The highest that the view from the side becomes, and a section.
const HIGHEST: f64 = 460.0;
const HIGHEST_SECTION: i32 = 230;
/// A fibre is drawn through so many of its beads at most.
const MOST_POINTS: usize = 160;
/// What of the yarn's ends is drawn beyond the outermost beads, in diameters of a fibre.
const AIR: f64 = 2.0;
/// A fibre that has been thrown further from its neighbours than nearly all is outside of a section's picture.
const KEPT: f64 = 0.02;
const PROJECTILE: RGBColor = RGBColor(232, 232, 232);

/// Draws the fibres.
///
/// # Errors
/// A file cannot be written.
pub fn write(svg: &Path, png: &Path, scene: &Scene, case: &Case, result: &Outcome, frame: &Frame) -> Result<(), Error> {
    let model = &result.model;
    let drawing = Drawing::new(scene, result, frame);
    let [side, above] = drawing.views();
    let tops = [TOP, TOP + side.size()[1] as i32 + BETWEEN];
    let sections = tops[1] + above.size()[1] as i32 + BETWEEN;
    let room = drawing.section_height();
    let height = sections + room + 2 * LINE;
    page::write(svg, png, [WIDTH as u32, height as u32], |root| {
        let title = format!("{}: {}", scene.title, case.name);
        root.draw_text(&title, &text(TITLE, &INK), (fine(LEFT), fine(TITLE_TOP)))?;
        let instant = micro(&scene.units, TIME) * frame.step as f64 * model.step;
        let heading = format!(
            "at {}; {} fibres, half of the yarn, from the side and from above",
            time(&scene.units, instant),
            case.fibres
        );
        root.draw_text(&heading, &text(TEXT, &GREY), (fine(LEFT), fine(TIME_TOP)))?;
        drawing.scale().draw(root, [LEFT, SCALE_MIDDLE])?;
        drawing.draw_projectile(root, &side)?;
        drawing.draw_fibres(root, &side, 1)?;
        drawing.draw_fibres(root, &above, 2)?;
        drawing.draw_sections(root, sections, room)?;
        ruler::draw(root, [LEFT, height - LINE / 2], side.scale, scene.units.names()[0])
    })
}

struct Drawing<'a> {
    model: &'a Model,
    frame: &'a Frame,
    /// The scene's unit of length in one of LAMMPS's, and its name.
    length: f64,
    unit: &'a str,
    largest: f64,
}

impl<'a> Drawing<'a> {
    fn new(scene: &'a Scene, result: &'a Outcome, frame: &'a Frame) -> Self {
        let model = &result.model;
        let strains = (0..frame.layers() - 1).filter_map(|layer| frame.strain(layer, model.limit()));
        let largest = strains.map(|[_, most]| most).fold(0.0, f64::max);
        Drawing { model, frame, length: micro(&scene.units, LENGTH), unit: scene.units.names()[0], largest }
    }

    fn scale(&self) -> Scale<'_> {
        Scale {
            name: "Strain",
            indent: SCALE_INDENT,
            width: SCALE_WIDTH,
            largest: 100.0 * self.largest,
            unit: "%",
            colours: Colours::Viridis,
            root: false,
        }
    }

    /// From the side and from above, to one scale.
    fn views(&self) -> [View; 2] {
        let air = AIR * self.model.diameter;
        let range = |axis: usize| {
            let mut places: Vec<f64> = self.frame.positions.iter().map(|x| x[axis]).collect();
            places.sort_by(f64::total_cmp);
            // A single bead that flies off does not set the scale.
            let skip = places.len() / 2000;
            [self.length * (places[skip] - air), self.length * (places[places.len() - 1 - skip] + air)]
        };
        let [y, z] = [range(1), range(2)];
        let far = self.length * (self.model.half_length + air);
        let width = f64::from(WIDTH - 2 * LEFT).min(HIGHEST * far / (y[1] - y[0])) as i32;
        let side = View::strip([LEFT, TOP], width, [0.0, y[0]], [far, y[1]]);
        let below = TOP + side.size()[1] as i32 + BETWEEN;
        [side, View::strip([LEFT, below], width, [0.0, z[0]], [far, z[1]])]
    }

    fn draw_projectile(&self, root: &Area, view: &View) -> Drawn<()> {
        let Striking::Cylinder { radius, height, .. } = self.model.striker else { return Ok(()) };
        let low = self.lowest_at_middle(height - radius);
        let centre = [0.0, self.length * (low + radius)];
        // The half beside the plane of symmetry, as far as the view goes.
        let radius = self.length * radius;
        let points = (0..=120).map(|i| f64::from(i) / 120.0 * std::f64::consts::PI);
        let points = points.map(|angle| [radius * angle.sin(), centre[1] - radius * angle.cos()]);
        let mut arc: Vec<(i32, i32)> =
            points.take_while(|point| point[1] <= view.high[1]).map(|point| view.place(point)).collect();
        let Some(&(last, top)) = arc.last() else { return Ok(()) };
        if centre[1] + radius > view.high[1] {
            let top = view.place(view.high).1;
            arc.extend([(last, top), (view.place([0.0, 0.0]).0, top)]);
        } else {
            arc.push((view.place([0.0, 0.0]).0, top));
        }
        root.draw(&Polygon::new(arc, PROJECTILE.filled()))?;
        Ok(())
    }

    /// Where the projectile's lowest line is: it has pressed the uppermost fibres at mid-span as far down.
    fn lowest_at_middle(&self, at_rest: f64) -> f64 {
        let top = |beads: &[[f64; 3]]| beads.iter().map(|x| x[1]).fold(f64::NEG_INFINITY, f64::max);
        let first = self.model.centres.iter().map(|centre| centre[1]).fold(f64::NEG_INFINITY, f64::max);
        at_rest + top(self.frame.layer(0)) - first
    }

    /// The fibres by their places along the yarn and on this axis, those at the back first.
    fn draw_fibres(&self, root: &Area, view: &View, axis: usize) -> Drawn<()> {
        let scale = self.scale();
        let (layers, fibres) = (self.frame.layers(), self.model.centres.len());
        let stride = (layers - 1).div_ceil(MOST_POINTS).max(1);
        let depth = 3 - axis;
        let mut order: Vec<usize> = (0..fibres).collect();
        order.sort_by(|&a, &b| self.frame.layer(0)[a][depth].total_cmp(&self.frame.layer(0)[b][depth]));
        for fibre in order {
            let place = |layer: usize| {
                let bead = self.frame.layer(layer)[fibre];
                view.place([self.length * bead[0], self.length * bead[axis]])
            };
            let mut line = vec![place(0)];
            let mut colour = None;
            for start in (0..layers - 1).step_by(stride) {
                let end = (start + stride).min(layers - 1);
                let strain = self.strain(fibre, start, end);
                let own = strain.map(|strain| scale.colour(100.0 * strain));
                if own != colour || own.is_none() {
                    draw_line(root, &line, colour)?;
                    line = vec![place(start)];
                    colour = own;
                }
                line.push(place(end));
            }
            draw_line(root, &line, colour)?;
        }
        Ok(())
    }

    /// The mean strain of a fibre between two layers; none where it is broken.
    fn strain(&self, fibre: usize, start: usize, end: usize) -> Option<f64> {
        let length = |layer: usize| {
            let [a, b] = [layer, layer + 1].map(|layer| self.frame.layer(layer)[fibre]);
            let square: f64 = a.iter().zip(b).map(|(a, b)| (b - a).powi(2)).sum();
            square.sqrt() / self.model.spacing - 1.0
        };
        let limit = self.model.limit().unwrap_or(f64::INFINITY);
        let strains: Vec<f64> = (start..end).map(length).collect();
        let whole = strains.iter().all(|&strain| strain <= limit);
        whole.then(|| strains.iter().sum::<f64>() / strains.len() as f64)
    }

    /// The layers whose sections are drawn: mid-span and the stations.
    fn section_layers(&self) -> [usize; 5] {
        let [a, b, c, d] = self.model.stations;
        [0, a, b, c, d]
    }

    /// The width that a section has, and the scale at which all of them go into it and are not too high.
    fn section_scale(&self) -> (i32, f64) {
        let bounds = self.section_layers().map(|layer| self.bounds(layer));
        let size = |axis: usize| bounds.iter().map(|bound| bound[axis][1] - bound[axis][0]).fold(0.0, f64::max);
        let part = (WIDTH - 2 * LEFT) / bounds.len() as i32;
        (part, (f64::from(part - BETWEEN) / size(0)).min(f64::from(HIGHEST_SECTION) / size(1)))
    }

    fn section_height(&self) -> i32 {
        let heights = self.section_layers().map(|layer| self.bounds(layer)[1]).map(|[low, high]| high - low);
        (self.section_scale().1 * heights.into_iter().fold(0.0, f64::max)).ceil() as i32
    }

    /// The sections beside mid-span and at the stations, to one scale, each around its middle.
    fn draw_sections(&self, root: &Area, top: i32, height: i32) -> Drawn<()> {
        let (part, scale) = self.section_scale();
        let room = [part - BETWEEN, height].map(f64::from);
        let colours = self.scale();
        for (number, layer) in self.section_layers().into_iter().enumerate() {
            let bound = self.bounds(layer);
            let middle = [LEFT + part * number as i32 + part / 2, top + height / 2].map(f64::from);
            let centre = bound.map(|[low, high]| 0.5 * (low + high));
            let radius = 0.5 * self.model.diameter * scale;
            let truss = layer.min(self.frame.layers() - 2);
            for (fibre, bead) in self.frame.layer(layer).iter().enumerate() {
                let [z, y] = [bead[2] - centre[0], bead[1] - centre[1]];
                if z.abs() * scale > 0.5 * room[0] || y.abs() * scale > 0.5 * room[1] {
                    continue;
                }
                let place = [middle[0] + scale * z, middle[1] - scale * y].map(|x| (x * f64::from(fine(1))) as i32);
                let colour =
                    self.strain(fibre, truss, truss + 1).map_or(PROJECTILE, |strain| colours.colour(100.0 * strain));
                root.draw(&Circle::new((place[0], place[1]), (radius * f64::from(fine(1))) as i32, colour.filled()))?;
            }
            let name = match number {
                0 => "at mid-span".to_string(),
                _ => format!("at {:.2} {}", STATIONS[number - 1] * self.length * self.model.half_length, self.unit),
            };
            let style = text(TEXT, &GREY).pos(Pos::new(HPos::Center, VPos::Top));
            root.draw_text(&name, &style, (fine(middle[0] as i32), fine(top + height + 6)))?;
        }
        let size = scale / self.length;
        ruler::draw(root, [WIDTH - LEFT - 200, top + height + LINE + LINE / 2], size, self.unit)
    }

    /// From where to where the beads of a layer lie, across the yarn and along the blow, but for a few.
    fn bounds(&self, layer: usize) -> [[f64; 2]; 2] {
        let beads = self.frame.layer(layer);
        [2, 1].map(|axis| {
            let mut places: Vec<f64> = beads.iter().map(|bead| bead[axis]).collect();
            places.sort_by(f64::total_cmp);
            let skip = (KEPT * places.len() as f64) as usize;
            let half = 0.5 * self.model.diameter;
            [places[skip] - half, places[places.len() - 1 - skip] + half]
        })
    }
}

fn draw_line(root: &Area, line: &[(i32, i32)], colour: Option<RGBColor>) -> Drawn<()> {
    let Some(colour) = colour.filter(|_| line.len() > 1) else { return Ok(()) };
    root.draw(&PathElement::new(line.to_vec(), stroke(colour, 1)))?;
    Ok(())
}
