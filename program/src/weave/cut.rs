//! A cut through the axis of the warp yarn that lies nearest to the plane y = 0, and the weft yarns that it crosses.

use plotters::prelude::*;

use super::geometry::Family;
use super::model::{Model, Yarn};
use super::picture::{View, colour};
use crate::picture::page::{Area, Drawn};
use crate::picture::style::fine;

/// Draws the elements that the plane cuts.
pub fn draw(area: &Area, view: &View, model: &Model) -> Drawn<()> {
    let warps = model.yarns.iter().enumerate().filter(|(_, yarn)| yarn.family == Family::Warp);
    let Some((number, warp)) = warps.min_by(|a, b| a.1.coordinate.abs().total_cmp(&b.1.coordinate.abs())) else {
        return Ok(());
    };
    for crossing in model.crossings.iter().filter(|crossing| crossing.warp == number) {
        let weft = &model.yarns[crossing.weft];
        let sections = (0..=weft.layers).map(|section| (section, model.nodes[weft.section(section).start][1]));
        let distance = |y: f64| (y - warp.coordinate).abs();
        let Some((section, _)) = sections.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1))) else { continue };
        let lines: Vec<Vec<[f64; 2]>> = weft
            .section(section)
            .collect::<Vec<_>>()
            .chunks(weft.rows + 1)
            .map(|line| line.iter().map(|&node| [model.nodes[node][0], model.nodes[node][2]]).collect())
            .collect();
        draw_grid(area, view, Family::Weft, &lines)?;
    }
    let lines: Vec<Vec<[f64; 2]>> = (0..=warp.layers).map(|section| axis_line(model, warp, section)).collect();
    draw_grid(area, view, Family::Warp, &lines)
}

/// The section's upright line through the yarn's axis, between the nearest lines of nodes.
fn axis_line(model: &Model, yarn: &Yarn, section: usize) -> Vec<[f64; 2]> {
    let first = yarn.section(section).start;
    let node = |line: usize, row: usize| model.nodes[first + line * (yarn.rows + 1) + row];
    let distance = |line: usize| (node(line, 0)[1] - yarn.coordinate).abs();
    let least = (0..=yarn.columns).map(distance).fold(f64::INFINITY, f64::min);
    // An odd number of columns has two lines beside the axis.
    let rounding = 1e-9 * (distance(0) + distance(yarn.columns));
    let nearest: Vec<usize> = (0..=yarn.columns).filter(|&line| distance(line) <= least + rounding).collect();
    let mean =
        |row: usize, axis: usize| nearest.iter().map(|&line| node(line, row)[axis]).sum::<f64>() / nearest.len() as f64;
    (0..=yarn.rows).map(|row| [mean(row, 0), mean(row, 2)]).collect()
}

/// The elements between neighbouring lines of points, where all of them are in the view.
fn draw_grid(area: &Area, view: &View, family: Family, lines: &[Vec<[f64; 2]>]) -> Drawn<()> {
    let margin = 1e-9 * (view.high[0] - view.low[0]);
    let seen = |x: f64| x >= view.low[0] - margin && x <= view.high[0] + margin;
    for pair in lines.windows(2) {
        for row in 0..pair[0].len() - 1 {
            let corners = [pair[0][row], pair[1][row], pair[1][row + 1], pair[0][row + 1]];
            if !corners.iter().all(|corner| seen(corner[0])) {
                continue;
            }
            let mut points = corners.map(|corner| view.place(corner)).to_vec();
            area.draw(&Polygon::new(points.clone(), colour(family).filled()))?;
            points.push(points[0]);
            area.draw(&PathElement::new(points, WHITE.stroke_width(fine(1) as u32 / 2)))?;
        }
    }
    Ok(())
}
