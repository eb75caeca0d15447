//! A panel from above: what is over hides what is under, and light from the left shows the slopes.

use nalgebra::Vector3;
use plotters::prelude::*;

use super::model::{Model, Side, Yarn};
use super::picture::{View, colour};
use crate::picture::page::{Area, Drawn};
use crate::picture::style::fine;

/// Where the light comes from, how much a slope towards it or away changes the brightness, and what the lowest lose.
const LIGHT: [f64; 3] = [-0.5, 0.35, 0.79];
const CONTRAST: f64 = 1.5;
const DEPTH: f64 = 0.45;

/// A face that is seen: its corners, and its yarn's colour in the light.
struct Patch {
    over: bool,
    corners: [Vector3<f64>; 4],
    colour: RGBColor,
}

/// Draws what the view shows; each face of the mesh, or each layer of a yarn as one.
pub fn draw(area: &Area, view: &View, model: &Model, by_column: bool) -> Drawn<()> {
    let top = model.nodes.iter().map(|node| node[2]).fold(f64::NEG_INFINITY, f64::max);
    let sides = sides(model);
    let mut patches = Vec::new();
    for (yarn, sides) in model.yarns.iter().zip(&sides) {
        let faces = model.faces[yarn.faces.clone()].iter().filter(|face| face.side == Side::Upper);
        let faces: Vec<[Vector3<f64>; 4]> =
            faces.map(|face| face.nodes.map(|node| Vector3::from(model.nodes[node as usize]))).collect();
        let seen: Vec<[Vector3<f64>; 4]> = if by_column {
            faces
        } else {
            // The first and the last column of a layer bound it: corners 0 and 3 are on the left, 1 and 2 on the right.
            faces.chunks(yarn.columns).map(layer_of).collect()
        };
        let axis = yarn.family as usize;
        for corners in seen.into_iter().filter(|corners| is_in_view(view, corners)) {
            let place = 0.5 * (corners[0][axis] + corners[2][axis]);
            patches.push(Patch { over: is_over(sides, place), corners, colour: shaded(yarn, &corners, top) });
        }
    }
    patches.sort_by_key(|patch| patch.over);
    for patch in patches {
        let corners = clipped(patch.corners.iter().map(|corner| [corner.x, corner.y]).collect(), view);
        if corners.len() < 3 {
            continue;
        }
        let mut points: Vec<(i32, i32)> = corners.into_iter().map(|corner| view.place(corner)).collect();
        area.draw(&Polygon::new(points.clone(), patch.colour.filled()))?;
        // Between neighbours the ground would shine through.
        points.push(points[0]);
        area.draw(&PathElement::new(points, patch.colour.stroke_width(fine(1) as u32 / 2)))?;
    }
    Ok(())
}

/// Of each yarn, the places along it where it crosses another, and whether it is over there.
fn sides(model: &Model) -> Vec<Vec<(f64, bool)>> {
    let mut sides = vec![Vec::new(); model.yarns.len()];
    for crossing in &model.crossings {
        sides[crossing.warp].push((crossing.place[0], crossing.warp_is_over));
        sides[crossing.weft].push((crossing.place[1], !crossing.warp_is_over));
    }
    sides
}

/// Up to half way to the next crossing a yarn hides the one that it is over.
fn is_over(sides: &[(f64, bool)], place: f64) -> bool {
    let nearest = sides.iter().min_by(|a, b| (a.0 - place).abs().total_cmp(&(b.0 - place).abs()));
    nearest.is_some_and(|(_, over)| *over)
}

fn layer_of(faces: &[[Vector3<f64>; 4]]) -> [Vector3<f64>; 4] {
    let [first, last] = [&faces[0], &faces[faces.len() - 1]];
    [first[0], last[1], last[2], first[3]]
}

fn is_in_view(view: &View, corners: &[Vector3<f64>; 4]) -> bool {
    (0..2).all(|axis| {
        let values = corners.map(|corner| corner[axis]);
        values.iter().any(|&value| value > view.low[axis]) && values.iter().any(|&value| value < view.high[axis])
    })
}

/// A yarn's colour, brighter where the face looks to the light, darker the lower it is.
fn shaded(yarn: &Yarn, corners: &[Vector3<f64>; 4], top: f64) -> RGBColor {
    let normal = (corners[1] - corners[0]).cross(&(corners[3] - corners[0])).normalize();
    let middle = 0.25 * corners.iter().map(|corner| corner.z).sum::<f64>();
    let depth = 0.5 * (1.0 - middle / top);
    let light = 1.0 + CONTRAST * (normal.dot(&Vector3::from(LIGHT)) - LIGHT[2]) - DEPTH * depth;
    let mix = |channel: u8| {
        // Beyond the full colour, towards white.
        let value = if light <= 1.0 {
            f64::from(channel) * light
        } else {
            255.0 - (255.0 - f64::from(channel)) * (2.0 - light)
        };
        value.clamp(0.0, 255.0).round() as u8
    };
    let RGBColor(red, green, blue) = colour(yarn.family);
    RGBColor(mix(red), mix(green), mix(blue))
}

/// The part of a convex polygon that the view shows (Sutherland and Hodgman).
fn clipped(mut corners: Vec<[f64; 2]>, view: &View) -> Vec<[f64; 2]> {
    for (axis, bound, sign) in
        [(0, view.low[0], 1.0), (1, view.low[1], 1.0), (0, view.high[0], -1.0), (1, view.high[1], -1.0)]
    {
        let depth = |corner: &[f64; 2]| sign * (corner[axis] - bound);
        let mut kept = Vec::new();
        for (i, corner) in corners.iter().enumerate() {
            let next = &corners[(i + 1) % corners.len()];
            let [from, to] = [depth(corner), depth(next)];
            if from >= 0.0 {
                kept.push(*corner);
            }
            if from * to < 0.0 {
                let share = from / (from - to);
                kept.push([0, 1].map(|i| corner[i] + share * (next[i] - corner[i])));
            }
        }
        corners = kept;
    }
    corners
}
