//! A cut through the axis of the warp yarn that lies nearest to the plane y = 0, and the weft yarns that it crosses.

use plotters::prelude::*;

use super::geometry::Family;
use super::model::{Model, Yarn};
use crate::picture::page::{Area, Drawn};
use crate::picture::style::fine;
use crate::picture::view::View;

/// The part of the cut that belongs to an element: its corners by x and z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    pub element: usize,
    pub family: Family,
    pub corners: [[f64; 2]; 4],
}

/// The elements that the plane cuts at rest, with the nodes at these positions: first the weft's, then the warp's.
pub fn pieces(model: &Model, positions: &[[f64; 3]]) -> Vec<Piece> {
    let warps = model.yarns.iter().enumerate().filter(|(_, yarn)| yarn.family == Family::Warp);
    let Some((number, warp)) = warps.min_by(|a, b| a.1.coordinate.abs().total_cmp(&b.1.coordinate.abs())) else {
        return Vec::new();
    };
    let mut pieces = Vec::new();
    for crossing in model.crossings.iter().filter(|crossing| crossing.warp == number) {
        let weft = &model.yarns[crossing.weft];
        let sections = (0..=weft.layers).map(|section| (section, model.nodes[weft.section(section).start][1]));
        let distance = |y: f64| (y - warp.coordinate).abs();
        let Some((section, _)) = sections.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1))) else { continue };
        let nodes: Vec<usize> = weft.section(section).collect();
        let lines = nodes.chunks(weft.rows + 1);
        let lines: Vec<Line> = lines.map(|line| line.iter().map(|&node| flat(positions[node])).collect()).collect();
        let first = weft.layer(section.min(weft.layers - 1)).start;
        add_grid(&mut pieces, Family::Weft, &lines, |column, row| first + column * weft.rows + row);
    }
    let nearest = nearest_lines(model, warp);
    let lines: Vec<Line> = (0..=warp.layers).map(|section| axis_line(positions, warp, section, &nearest)).collect();
    let column = nearest[0].min(warp.columns - 1);
    add_grid(&mut pieces, Family::Warp, &lines, |layer, row| warp.layer(layer).start + column * warp.rows + row);
    pieces
}

/// Points one above another.
type Line = Vec<[f64; 2]>;

fn flat([x, _, z]: [f64; 3]) -> [f64; 2] {
    [x, z]
}

/// The upright lines of nodes nearest to the yarn's axis: an odd number of columns has two beside it.
fn nearest_lines(model: &Model, yarn: &Yarn) -> Vec<usize> {
    let first = yarn.section(0).start;
    let distance = |line: usize| (model.nodes[first + line * (yarn.rows + 1)][1] - yarn.coordinate).abs();
    let least = (0..=yarn.columns).map(distance).fold(f64::INFINITY, f64::min);
    let rounding = 1e-9 * (distance(0) + distance(yarn.columns));
    (0..=yarn.columns).filter(|&line| distance(line) <= least + rounding).collect()
}

/// The section's upright line through the yarn's axis, between the nearest lines of nodes.
fn axis_line(positions: &[[f64; 3]], yarn: &Yarn, section: usize, nearest: &[usize]) -> Line {
    let first = yarn.section(section).start;
    let mean = |row: usize| {
        let points = nearest.iter().map(|&line| flat(positions[first + line * (yarn.rows + 1) + row]));
        let [x, z] = points.fold([0.0; 2], |sum, point| [sum[0] + point[0], sum[1] + point[1]]);
        [x / nearest.len() as f64, z / nearest.len() as f64]
    };
    (0..=yarn.rows).map(mean).collect()
}

/// The elements between neighbouring lines of points.
fn add_grid(pieces: &mut Vec<Piece>, family: Family, lines: &[Line], element: impl Fn(usize, usize) -> usize) {
    for (i, pair) in lines.windows(2).enumerate() {
        for row in 0..pair[0].len() - 1 {
            let corners = [pair[0][row], pair[1][row], pair[1][row + 1], pair[0][row + 1]];
            pieces.push(Piece { element: element(i, row), family, corners });
        }
    }
}

/// Draws the pieces that are all in the view, those that have a colour.
pub fn draw(area: &Area, view: &View, pieces: &[Piece], colour: impl Fn(&Piece) -> Option<RGBColor>) -> Drawn<()> {
    let margin = 1e-9 * (view.high[0] - view.low[0]);
    let seen = |x: f64| x >= view.low[0] - margin && x <= view.high[0] + margin;
    for piece in pieces.iter().filter(|piece| piece.corners.iter().all(|corner| seen(corner[0]))) {
        let Some(colour) = colour(piece) else { continue };
        let mut points = piece.corners.map(|corner| view.place(corner)).to_vec();
        area.draw(&Polygon::new(points.clone(), colour.filled()))?;
        points.push(points[0]);
        area.draw(&PathElement::new(points, WHITE.stroke_width(fine(1) as u32 / 2)))?;
    }
    Ok(())
}
