//! The picture of a panel: from above, its middle larger, and a cut through the axis of a warp yarn.

use std::collections::HashSet;
use std::path::Path;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::cut;
use super::geometry::Family;
use super::model::Model;
use super::projection::{self, FACING, Lit};
use super::reader::Scene;
use super::surface::{self, Visible};
use toron_pictures::page::{self, Area, Drawn};
use toron_pictures::ruler;
use toron_pictures::style::{COLOURS, GREY, HEADING, INK, TEXT, TITLE, fine, text};
use toron_pictures::view::View;
use toron_shared::error::Error;

const WIDTH: i32 = 1280;
const LEFT: i32 = 24;
const TITLE_TOP: i32 = 16;
const LEGEND_TOP: i32 = 58;
const LEGEND_STEP: i32 = 150;
const SWATCH: i32 = 14;
/// Two square views side by side, their headings above them and rulers below.
const HEADING_TOP: i32 = 88;
const VIEW_TOP: i32 = 114;
const VIEW: i32 = 604;
const RULER_BELOW: i32 = 18;
/// The cut, over the whole width.
const CUT_HEADING: i32 = 58;
const CUT_BELOW: i32 = 84;
const FOOT: i32 = 36;
/// What the views show at most, in pitches: the panel, its middle, and the cut.
const LARGEST: f64 = 40.0;
const MIDDLE: f64 = 4.0;
const CUT: f64 = 6.0;
/// Radius of the mark of an element that is in two yarns.
const MARK: i32 = 2;
/// How much a slope towards the light or away changes the brightness, and what the lowest lose.
const CONTRAST: f64 = 1.5;
const DEPTH: f64 = 0.45;

/// Elements of a mesh that reach into another yarn.
const OVERLAP: RGBColor = RGBColor(200, 20, 40);

fn colour(family: Family) -> RGBColor {
    if family == Family::Warp { COLOURS[0] } else { COLOURS[4] }
}

/// Draws the panel.
///
/// # Errors
/// A file cannot be written.
pub fn write(svg: &Path, png: &Path, scene: &Scene, model: &Model) -> Result<(), Error> {
    let pitch = scene.cloth.pitch();
    let unit = scene.units.names()[0];
    let whole = bounds(model, LARGEST * pitch);
    let right = LEFT + VIEW + (WIDTH - 2 * LEFT - 2 * VIEW);
    let [panel, middle] = [(LEFT, LARGEST), (right, MIDDLE)].map(|(left, pitches)| {
        let [low, high] = bounds(model, pitches * pitch);
        View::square([left, VIEW_TOP], VIEW, low, high)
    });
    let [low, high] = bounds(model, CUT * pitch);
    let heights = || model.nodes.iter().map(|node| node[2]);
    let [lowest, highest] = [heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max)];
    let below = VIEW_TOP + VIEW + CUT_BELOW;
    let cut = View::strip([LEFT, below], WIDTH - 2 * LEFT, [low[0], lowest], [high[0], highest]);
    let bottom = cut.corner[1].ceil() as i32;
    let height = bottom + RULER_BELOW + FOOT;
    let sides = surface::visible(model, &model.nodes, |_| true);
    let family: Vec<Family> = model.yarns.iter().flat_map(|yarn| yarn.elements.clone().map(|_| yarn.family)).collect();
    let overlapping: HashSet<usize> = scene.cloth.overlapping().iter().copied().collect();
    let colour_of = |element| if overlapping.contains(&element) { OVERLAP } else { colour(family[element]) };
    let (of_cut, plane) = match scene.cloth.overlapping() {
        [] => match cut::warp_axis(model) {
            Some(plane) => ("Cut through the axis of a warp yarn", plane),
            None => ("Cut at y = 0", 0.0),
        },
        elements => ("Cut along the warp where most elements are in two yarns", cut::through_most(model, elements)),
    };
    let shade = |side: &Visible, lit: Lit| {
        let depth = 0.5 * (1.0 - lit.height / highest);
        let brightness = 1.0 + CONTRAST * (lit.light - FACING) - DEPTH * depth;
        projection::brightened(colour_of(side.element), brightness)
    };
    page::write(svg, png, [WIDTH as u32, height as u32], |root| {
        root.draw_text(&scene.title, &text(TITLE, &INK), (fine(LEFT), fine(TITLE_TOP)))?;
        draw_legend(root, is_turned(model), !overlapping.is_empty())?;
        let of_part = if whole == bounds(model, f64::INFINITY) {
            "The panel from above"
        } else {
            "A part of the panel from above"
        };
        let rulers_top = VIEW_TOP + VIEW + RULER_BELOW;
        for (left, name, view) in [(LEFT, of_part, panel), (right, "Its middle", middle)] {
            draw_heading(root, name, left, HEADING_TOP)?;
            projection::draw_above(root, view, &sides, shade)?;
            mark(root, &view, model, scene.cloth.overlapping())?;
            ruler::draw(root, [left, rulers_top], view.scale, unit)?;
        }
        draw_heading(root, of_cut, LEFT, VIEW_TOP + VIEW + CUT_HEADING)?;
        cut::draw(root, &cut, &cut::along_the_warp(model, plane), |piece| colour_of(piece.element))?;
        ruler::draw(root, [LEFT, bottom + RULER_BELOW], cut.scale, unit)
    })
}

/// The panel's bounds, or those of a square of this size in its middle; that of a quarter is its corner at the origin.
pub fn bounds(model: &Model, size: f64) -> [[f64; 2]; 2] {
    let mut bounds = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    for node in &model.nodes {
        for axis in 0..2 {
            bounds[0][axis] = bounds[0][axis].min(node[axis]);
            bounds[1][axis] = bounds[1][axis].max(node[axis]);
        }
    }
    let [low, high] = bounds;
    let quarter = !model.on_x.is_empty();
    let limit = if quarter { [0.0, size] } else { [-0.5 * size, 0.5 * size] };
    [low.map(|x| x.max(limit[0])), high.map(|x| x.min(limit[1]))]
}

/// Marks these elements, which others may hide.
fn mark(area: &Area, view: &View, model: &Model, elements: &[usize]) -> Drawn<()> {
    for &element in elements {
        let corners = model.corners(&model.elements[element]);
        let middle = [0, 1].map(|axis| 0.125 * corners.iter().map(|corner| corner[axis]).sum::<f64>());
        if (0..2).all(|axis| (view.low[axis]..=view.high[axis]).contains(&middle[axis])) {
            area.draw(&Circle::new(view.place(middle), fine(MARK), OVERLAP.filled()))?;
        }
    }
    Ok(())
}

fn draw_heading(root: &Area, name: &str, left: i32, top: i32) -> Drawn<()> {
    root.draw_text(name, &text(HEADING, &INK), (fine(left), fine(top)))?;
    Ok(())
}

/// Whether some ply is turned.
fn is_turned(model: &Model) -> bool {
    model.yarns.iter().any(|yarn| !cut::is_along(model, yarn, yarn.family as usize))
}

fn draw_legend(root: &Area, turned: bool, overlap: bool) -> Drawn<()> {
    let names = if turned { ["warp", "weft"] } else { ["warp, along x", "weft, along y"] };
    let families = [(Family::Warp, names[0]), (Family::Weft, names[1])];
    let entries = families.into_iter().map(|(family, name)| (colour(family), name));
    let overlap = overlap.then_some((OVERLAP, "in two yarns"));
    for (number, (colour, name)) in entries.chain(overlap).enumerate() {
        let left = LEFT + number as i32 * LEGEND_STEP;
        let corners = [(left, LEGEND_TOP), (left + SWATCH, LEGEND_TOP + SWATCH)].map(|(x, y)| (fine(x), fine(y)));
        root.draw(&Rectangle::new(corners, colour.filled()))?;
        let style = text(TEXT, &GREY).pos(Pos::new(HPos::Left, VPos::Center));
        root.draw_text(name, &style, (fine(left + SWATCH + 8), fine(LEGEND_TOP + SWATCH / 2)))?;
    }
    Ok(())
}
