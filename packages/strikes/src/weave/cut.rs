//! Cuts of elements by planes x or y = a number.

use plotters::prelude::*;

use super::geometry::Family;
use super::model::{Model, Yarn};
use toron_pictures::page::{Area, Drawn};
use toron_pictures::style::fine;
use toron_pictures::view::View;

/// A plane is moved by this part of a yarn's width, so that it meets no node.
const BESIDE: f64 = 1e-5;
/// The fibre of a yarn along an axis has less than this of the other one.
const ALONG: f64 = 0.1;
/// Planes that are tried for the one that meets the most of some elements.
const TRIED: usize = 500;
/// The edges of an element by their corners.
const EDGES: [[usize; 2]; 12] =
    [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]];

/// The part of the cut that belongs to an element: its corners, around it, by the other horizontal axis and z.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    pub element: usize,
    pub corners: Vec<[f64; 2]>,
}

/// The elements that the plane y = `plane` cuts: first the weft's, then the warp's.
pub fn along_the_warp(model: &Model, plane: f64) -> Vec<Piece> {
    let of = |family: Family| model.yarns.iter().filter(move |yarn| yarn.family == family);
    let elements = of(Family::Weft).chain(of(Family::Warp)).flat_map(|yarn| yarn.elements.clone());
    elements.filter_map(|element| piece(model, element, 1, plane)).collect()
}

/// y of the axis of the warp yarn along x that is nearest to y = 0, but for a little by which the plane misses its
/// nodes; none where all plies are turned.
pub fn warp_axis(model: &Model) -> Option<f64> {
    let warps = model.yarns.iter().filter(|yarn| yarn.family == Family::Warp && is_along(model, yarn, 0));
    let nearest = warps.min_by(|a, b| a.coordinate.abs().total_cmp(&b.coordinate.abs()));
    nearest.map(|warp| {
        let [low, high] = model.extent(warp, 1);
        // Turned by half a turn it is on the other side.
        let axis = if (low..=high).contains(&warp.coordinate) { warp.coordinate } else { -warp.coordinate };
        axis + BESIDE * (high - low)
    })
}

/// Whether a yarn runs along x (0) or y (1).
pub fn is_along(model: &Model, yarn: &Yarn, axis: usize) -> bool {
    let middle = yarn.elements.start + yarn.elements.len() / 2;
    model.fibre[middle][1 - axis].abs() < ALONG
}

/// y of the plane that meets the most of these elements.
pub fn through_most(model: &Model, elements: &[usize]) -> f64 {
    let extents: Vec<[f64; 2]> = elements
        .iter()
        .map(|&element| {
            let places = model.corners(&model.elements[element]).map(|corner| corner[1]);
            places.into_iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], y| [low.min(y), high.max(y)])
        })
        .collect();
    let met = |plane: f64| extents.iter().filter(|[low, high]| (low..=high).contains(&&plane)).count();
    let middles = extents.iter().map(|[low, high]| 0.5 * (low + high));
    let step = (extents.len() / TRIED).max(1);
    middles.step_by(step).max_by_key(|&plane| met(plane)).unwrap_or_default()
}

/// What a plane across an axis, 0 or 1, cuts out of an element.
pub fn piece(model: &Model, element: usize, axis: usize, plane: f64) -> Option<Piece> {
    let places = model.corners(&model.elements[element]);
    let mut corners: Vec<[f64; 2]> = Vec::new();
    for [from, to] in EDGES.map(|edge| edge.map(|corner| places[corner])) {
        let [below, above] = [from, to].map(|place| place[axis] - plane);
        if (below < 0.0) != (above < 0.0) {
            let share = below / (below - above);
            let point = [1 - axis, 2].map(|i| from[i] + share * (to[i] - from[i]));
            if !corners.contains(&point) {
                corners.push(point);
            }
        }
    }
    if corners.len() < 3 {
        return None;
    }
    let middle = [0, 1].map(|i| corners.iter().map(|corner| corner[i]).sum::<f64>() / corners.len() as f64);
    let angle = |corner: &[f64; 2]| (corner[1] - middle[1]).atan2(corner[0] - middle[0]);
    corners.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    Some(Piece { element, corners })
}

/// Draws the pieces that are all in the view.
pub fn draw(area: &Area, view: &View, pieces: &[Piece], colour: impl Fn(&Piece) -> RGBColor) -> Drawn<()> {
    let margin = 1e-9 * (view.high[0] - view.low[0]);
    let seen = |x: f64| x >= view.low[0] - margin && x <= view.high[0] + margin;
    for piece in pieces.iter().filter(|piece| piece.corners.iter().all(|corner| seen(corner[0]))) {
        let mut points: Vec<_> = piece.corners.iter().map(|&corner| view.place(corner)).collect();
        area.draw(&Polygon::new(points.clone(), colour(piece).filled()))?;
        points.push(points[0]);
        area.draw(&PathElement::new(points, WHITE.stroke_width(fine(1) as u32 / 2)))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_brick_and_a_wedge_are_cut_across() {
        let nodes = (0..8).map(|c| [0, 1, 2].map(|axis| f64::from(c >> axis & 1))).collect();
        // The wedge's section is a triangle in which corners 2 and 6 are one.
        let elements = vec![[0, 1, 2, 3, 4, 5, 6, 7], [0, 1, 2, 3, 4, 5, 2, 3]];
        let model = Model { nodes, elements, ..Model::default() };
        let cut = |element: usize, axis: usize, plane: f64| piece(&model, element, axis, plane).map(|cut| cut.corners);
        assert_eq!(cut(0, 0, 0.5), Some(vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]));
        assert_eq!(cut(1, 0, 0.25).expect("a triangle").len(), 3);
        assert_eq!(cut(1, 1, 0.25).expect("a quadrangle"), [[0.0, 0.0], [1.0, 0.0], [1.0, 0.75], [0.0, 0.75]]);
        assert_eq!(cut(0, 1, 2.0), None);
    }
}
