//! The struck panel coloured by its energies: from above, from below, and a cut through the blow.

use std::path::Path;

use plotters::prelude::*;

use super::scene::{Case, Scene, Zones};
use crate::common::error::Error;
use crate::common::units::{time, unit};
use crate::explicit::snapshot::Snapshot;
use crate::material::model::Law;
use crate::picture::colour_scale::Scale;
use crate::picture::page::{self, Area, Drawn};
use crate::picture::ruler;
use crate::picture::style::{GREY, HEADING, INK, TEXT, TITLE, fine, stroke, text};
use crate::picture::view::View;
use crate::weave::cut::{self, Piece};
use crate::weave::model::Model;
use crate::weave::surface::{self, Visible};
use crate::weave::{above, picture};
use toron::law::parameters::ENERGY_DENSITY;

const WIDTH: i32 = 1280;
/// Air beside all that is drawn, and between two views.
const LEFT: i32 = 24;
const BETWEEN: i32 = 20;
const TITLE_TOP: i32 = 16;
const TIME_TOP: i32 = 50;
/// Of a mode: the middle of its scale of colours, how far its name indents that, and its width.
const SCALE_MIDDLE: i32 = 88;
const SCALE_INDENT: i32 = 106;
const SCALE_WIDTH: i32 = 140;
/// The views from above and from below: names over them, squares, a ruler under them.
const VIEWS_TOP: i32 = 120;
const NAME: i32 = 26;
const LARGEST_VIEW: i32 = 604;
const RULER_BELOW: i32 = 18;
/// The cuts: the heading, a scale of colours over each, and air.
const CUT_HEADING: i32 = 46;
const CUT_SCALE: i32 = 30;
const CUT_NAME: i32 = 26;
const CUT_BELOW: i32 = 14;
const FOOT: i32 = 36;
/// The cut shows so many of the sphere's radii to either side, and as much of the sphere's height over its lowest point.
const CUT_RADII: f64 = 3.0;
const SPHERE_SHOWN: f64 = 0.45;
const SPHERE: RGBColor = RGBColor(236, 236, 236);
/// How much a slope changes the brightness. What is level has the colour of the scale.
const CONTRAST: f64 = 1.1;
const DARKEST: f64 = 0.65;
/// The views show where a density has this part of its largest, with some air; or the whole panel, where that is not much more.
const SMALL: f64 = 0.01;
const AIR: f64 = 1.25;
const NEARLY_WHOLE: f64 = 0.7;
const MODES: [&str; 3] = ["Elongation", "Compaction", "Distortion"];

/// What is shown: the modes or, where there is none, the work of the linear law. Of two laws the first view has both.
fn modes(case: &Case) -> Vec<&'static str> {
    match &case.zones {
        Zones::One(material) if matches!(material.law, Law::LinearElastic { .. }) => vec!["Work"],
        Zones::One(_) => MODES.to_vec(),
        Zones::Two(..) => vec!["Elongation*", MODES[1], MODES[2]],
    }
}

/// Draws the panel as it stood at an instant; a quarter is continued by its mirror images.
///
/// # Errors
/// A file cannot be written.
pub fn write(
    svg: &Path,
    png: &Path,
    scene: &Scene,
    case: &Case,
    panel: &Model,
    snapshot: &Snapshot,
) -> Result<(), Error> {
    let unit = unit(&scene.units, ENERGY_DENSITY);
    let drawing = Drawing::new(scene, case, panel, snapshot, &unit);
    page::write(svg, png, [WIDTH as u32, drawing.height() as u32], |root| drawing.draw(root))
}

/// The linear law has no modes: its work stands beside elongation.
fn density(mode: usize, densities: &[f64; 5]) -> f64 {
    if mode == 0 { densities[0] + densities[4] } else { densities[mode] }
}

struct Drawing<'a> {
    scene: &'a Scene,
    case: &'a Case,
    snapshot: &'a Snapshot,
    /// As the modes are numbered.
    modes: Vec<Scale<'a>>,
    /// Whether the panel is a quarter.
    quarter: bool,
    /// Of what the views show, and whether that is the whole panel.
    bounds: [[f64; 2]; 2],
    is_whole: bool,
    sides: Vec<Visible>,
    pieces: Vec<Piece>,
    /// What the cut shows, by x and z.
    cut: View,
}

impl<'a> Drawing<'a> {
    fn new(scene: &'a Scene, case: &'a Case, panel: &Model, snapshot: &'a Snapshot, unit: &'a str) -> Self {
        let mode = |(mode, name)| Scale {
            name,
            indent: SCALE_INDENT,
            width: SCALE_WIDTH,
            largest: snapshot.largest(|densities| density(mode, densities)),
            unit,
            root: true,
        };
        let modes: Vec<Scale> = modes(case).into_iter().enumerate().map(mode).collect();
        let [low, high] = picture::bounds(panel, f64::INFINITY);
        let quarter = !panel.on_x.is_empty();
        let bounds = if quarter { [high.map(|x| -x), high] } else { [low, high] };
        let (bounds, is_whole) = middle(bounds, reach(panel, case, snapshot, &modes));
        let intact = |element: usize| snapshot.intact[element];
        let pieces = cut::pieces(panel, &snapshot.positions);
        let pieces: Vec<Piece> = pieces.into_iter().filter(|piece| intact(piece.element)).collect();
        let cut = cut_view(&pieces, [bounds[0][0], bounds[1][0]], case, snapshot);
        let sides = surface::visible(panel, &snapshot.positions, intact);
        Drawing { scene, case, snapshot, modes, quarter, bounds, is_whole, sides, pieces, cut }
    }

    fn colour(&self, mode: usize, element: usize) -> RGBColor {
        self.modes[mode].colour(density(mode, &self.snapshot.densities[element]))
    }

    /// Views in a row: the modes or, of a single one, its two sides.
    fn per_row(&self) -> i32 {
        (self.modes.len() as i32).max(2)
    }

    fn view_size(&self) -> i32 {
        ((WIDTH - 2 * LEFT - (self.per_row() - 1) * BETWEEN) / self.per_row()).min(LARGEST_VIEW)
    }

    fn views_height(&self) -> i32 {
        let rows = if self.modes.len() == 1 { 1 } else { 2 };
        let [width, height] = [0, 1].map(|axis| self.bounds[1][axis] - self.bounds[0][axis]);
        let height = (f64::from(self.view_size()) * height / width.max(height)).ceil() as i32;
        rows * (NAME + height)
    }

    fn cuts_top(&self) -> i32 {
        VIEWS_TOP + self.views_height() + RULER_BELOW + CUT_HEADING
    }

    fn cut_height(&self) -> i32 {
        self.cut.size()[1].ceil() as i32
    }

    fn cut_row(&self) -> i32 {
        CUT_SCALE + CUT_NAME + self.cut_height() + CUT_BELOW
    }

    fn height(&self) -> i32 {
        self.cuts_top() + self.modes.len() as i32 * self.cut_row() + FOOT
    }

    fn draw(&self, root: &Area) -> Drawn<()> {
        let title = format!("{}: {}", self.scene.title, self.case.name);
        root.draw_text(&title, &text(TITLE, &INK), (fine(LEFT), fine(TITLE_TOP)))?;
        let units = &self.scene.units;
        let laws = if matches!(self.case.zones, Zones::Two(..)) { "; * work, where the law is linear" } else { "" };
        let scales = "colours by the square root, up to the largest value of what stands";
        let time = format!("at {}, energies per reference volume; {scales}{laws}", time(units, self.snapshot.time));
        root.draw_text(&time, &text(TEXT, &GREY), (fine(LEFT), fine(TIME_TOP)))?;
        self.draw_views(root)?;
        let length = units.names()[0];
        let top = self.cuts_top();
        let name = "Cut through the blow, along the warp";
        root.draw_text(name, &text(HEADING, &INK), (fine(LEFT), fine(top - 14)))?;
        for (i, scale) in self.modes.iter().enumerate() {
            let top = top + i as i32 * self.cut_row();
            scale.draw(root, [LEFT, top + CUT_SCALE])?;
            self.draw_cut(root, top + CUT_SCALE + CUT_NAME, i)?;
        }
        ruler::draw(root, [LEFT, self.height() - FOOT], self.cut.scale, length)
    }

    fn draw_views(&self, root: &Area) -> Drawn<()> {
        let size = self.view_size();
        let step = size + BETWEEN;
        let single = self.modes.len() == 1;
        let part = if self.is_whole { "" } else { ", the middle of the panel" };
        let [low, high] = self.bounds;
        for (i, scale) in self.modes.iter().enumerate() {
            let left = LEFT + i as i32 * step;
            scale.draw(root, [left, SCALE_MIDDLE])?;
            for (row, name) in ["from above", "from below"].into_iter().enumerate() {
                let below = row == 1;
                let (left, down) = if single { (left + row as i32 * step, 0) } else { (left, row as i32) };
                let top = VIEWS_TOP + down * self.views_height() / 2;
                root.draw_text(&format!("{name}{part}"), &text(TEXT, &GREY), (fine(left), fine(top + 4)))?;
                // From below, y goes downwards.
                let [low, high] = if below { [[low[0], -high[1]], [high[0], -low[1]]] } else { [low, high] };
                let mut view = View::square([left, top + NAME], size, low, high);
                view.corner[1] = f64::from(top + NAME) + view.size()[1];
                self.draw_view(root, view, i, below)?;
            }
        }
        let scale = View::square([0; 2], size, low, high).scale;
        let top = VIEWS_TOP + self.views_height() + RULER_BELOW;
        ruler::draw(root, [LEFT, top], scale, self.scene.units.names()[0])
    }

    fn draw_view(&self, root: &Area, view: View, mode: usize, below: bool) -> Drawn<()> {
        let up = if below { -1.0 } else { 1.0 };
        let signs: &[[f64; 2]] =
            if self.quarter { &[[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]] } else { &[[1.0, 1.0]] };
        let images: Vec<[f64; 3]> = signs.iter().map(|[x, y]| [*x, *y * up, up]).collect();
        above::draw(root, view, &self.sides, &images, |side, lit| {
            above::brightened(self.colour(mode, side.element), (1.0 + CONTRAST * lit.light).max(DARKEST))
        })?;
        if let Some((_, radius)) = self.snapshot.projectile.filter(|_| !below) {
            let radius = (view.scale * radius * f64::from(fine(1))) as i32;
            root.draw(&Circle::new(view.place([0.0, 0.0]), radius, stroke(WHITE, 2)))?;
            root.draw(&Circle::new(view.place([0.0, 0.0]), radius, stroke(INK, 1)))?;
        }
        Ok(())
    }

    fn draw_cut(&self, root: &Area, top: i32, mode: usize) -> Drawn<()> {
        let mut view = self.cut;
        view.corner[1] = f64::from(top) + view.size()[1];
        if let Some((height, radius)) = self.snapshot.projectile {
            draw_sphere(root, &view, height, radius)?;
        }
        let shade = |piece: &Piece| Some(self.colour(mode, piece.element));
        if self.quarter {
            let mirrored: Vec<Piece> = self.pieces.iter().map(mirrored).collect();
            cut::draw(root, &view, &mirrored, shade)?;
        }
        cut::draw(root, &view, &self.pieces, shade)
    }
}

/// How far from the centre the panel has an energy to show, or the sphere is.
fn reach(panel: &Model, case: &Case, snapshot: &Snapshot, modes: &[Scale]) -> f64 {
    let least = CUT_RADII * case.sphere.radius;
    let standing = (0..panel.elements.len()).filter(|&element| snapshot.intact[element]);
    let shows = |element: usize| {
        let densities = &snapshot.densities[element];
        modes.iter().enumerate().any(|(mode, scale)| density(mode, densities) > SMALL * scale.largest)
    };
    standing.filter(|&element| shows(element)).fold(least, |reach, element| {
        let [x, y, _] = panel.nodes[panel.elements[element][0] as usize];
        reach.max(AIR * x.abs()).max(AIR * y.abs())
    })
}

/// What of the panel's bounds lies within this reach, and whether that is all.
fn middle(bounds: [[f64; 2]; 2], reach: f64) -> ([[f64; 2]; 2], bool) {
    let [low, high] = bounds;
    let farthest = low.iter().chain(&high).fold(0.0, |farthest: f64, x| farthest.max(x.abs()));
    if reach > NEARLY_WHOLE * farthest {
        return (bounds, true);
    }
    ([low.map(|x| x.max(-reach)), high.map(|x| x.min(reach))], false)
}

fn mirrored(piece: &Piece) -> Piece {
    Piece { corners: piece.corners.map(|[x, z]| [-x, z]), ..*piece }
}

/// What the cut shows: the panel beside the sphere, as deep as it is there, and the lower part of the sphere.
fn cut_view(pieces: &[Piece], [left, right]: [f64; 2], case: &Case, snapshot: &Snapshot) -> View {
    let reach = CUT_RADII * case.sphere.radius;
    let [left, right] = [left.max(-reach), right.min(reach)];
    let corners = pieces.iter().flat_map(|piece| piece.corners);
    let seen = corners.filter(|[x, _]| (left..=right).contains(x));
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    let (mut low, mut high) = seen.fold(start, |(low, high), [_, z]| (low.min(z), high.max(z)));
    if let Some((height, radius)) = snapshot.projectile {
        low = low.min(height - radius);
        high = high.max(height - radius + SPHERE_SHOWN * radius);
    }
    View::strip([LEFT, 0], WIDTH - 2 * LEFT, [left, low], [right, high])
}

/// The part of the sphere's outline that is in the view, filled.
fn draw_sphere(root: &Area, view: &View, height: f64, radius: f64) -> Drawn<()> {
    const STEPS: usize = 180;
    let highest = ((view.high[1] - height) / radius).clamp(-1.0, 1.0);
    // From the lowest point, both ways to where the view ends.
    let angle = (-highest).acos();
    let outline = (0..=STEPS).map(|step| angle * (2.0 * step as f64 / STEPS as f64 - 1.0));
    let points = outline.map(|a| [radius * a.sin(), height - radius * a.cos()]);
    let points: Vec<(i32, i32)> = points.map(|point| view.place(point)).collect();
    root.draw(&Polygon::new(points.clone(), SPHERE.filled()))?;
    root.draw(&PathElement::new(points, stroke(GREY, 1)))?;
    Ok(())
}
