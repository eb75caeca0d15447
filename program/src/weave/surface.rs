//! What of a panel's elements can be seen: sides behind which no other element of the yarn stands.

use nalgebra::Vector3;

use super::model::{END, LEFT, LOWER, Model, RIGHT, START, UPPER};

/// The sides of an element, and where along the yarn, by columns and by rows the element stands that would hide it.
const SIDES: [([usize; 4], [isize; 3]); 6] = [
    (UPPER, [0, 0, 1]),
    (LOWER, [0, 0, -1]),
    (LEFT, [0, -1, 0]),
    (RIGHT, [0, 1, 0]),
    (START, [-1, 0, 0]),
    (END, [1, 0, 0]),
];

/// A side of an element that can be seen, where the nodes are now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Visible {
    pub element: usize,
    pub corners: [[f64; 3]; 4],
    /// Outwards, of length 1.
    pub normal: Vector3<f64>,
}

/// The sides of the intact elements that are seen with the nodes at these positions; with them the yarns' ends, which stand
/// upright at rest.
pub fn visible(model: &Model, positions: &[[f64; 3]], intact: impl Fn(usize) -> bool) -> Vec<Visible> {
    let mut found = Vec::new();
    for yarn in &model.yarns {
        let counts = [yarn.layers, yarn.columns, yarn.rows];
        let element = |[layer, column, row]: [usize; 3]| yarn.layer(layer).start + column * yarn.rows + row;
        for number in yarn.elements.clone().filter(|&number| intact(number)) {
            let place = number - yarn.elements.start;
            let place = [place / yarn.elements_per_layer(), place / yarn.rows % yarn.columns, place % yarn.rows];
            let hidden = |step: [isize; 3]| {
                let next = [0, 1, 2].map(|i| place[i].checked_add_signed(step[i]).filter(|&j| j < counts[i]));
                matches!(next, [Some(layer), Some(column), Some(row)] if intact(element([layer, column, row])))
            };
            for (side, _) in SIDES.into_iter().filter(|(_, step)| !hidden(*step)) {
                let corners = side.map(|corner| positions[model.elements[number][corner] as usize]);
                found.push(Visible { element: number, corners, normal: normal(&corners) });
            }
        }
    }
    found
}

fn normal(corners: &[[f64; 3]; 4]) -> Vector3<f64> {
    let [a, b, c, d] = corners.map(Vector3::from);
    (c - a).cross(&(d - b)).normalize()
}
