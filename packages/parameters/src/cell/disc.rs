//! The mesh of a fibre's section: a core of squares, and rings of quadrilaterals from it to the circle.

use std::collections::HashMap;
use std::f64::consts::PI;

/// The core's half width over the radius, and by how much its corner is drawn in: no quadrilateral is too flat.
const CORE: f64 = 0.5;
const CORNER: f64 = 0.15;
/// Nodes of two quarters closer than one over this are the same.
const MERGE: f64 = 1e9;

/// A disc of diameter 1 about the origin, or a quarter of it.
#[derive(Clone, Debug, Default)]
pub struct Disc {
    pub nodes: Vec<[f64; 2]>,
    /// Counter-clockwise.
    pub quads: Vec<[usize; 4]>,
    /// The quadrilaterals whose second edge (second to third corner) lies on the circle.
    pub rim: Vec<usize>,
    /// The corners of the core, one a quarter: where a whole disc is held by springs.
    pub corners: Vec<usize>,
}

impl Disc {
    /// The quarter between `quadrant` and `quadrant + 1` right angles, with so many elements along an eighth of the
    /// circumference: 9 n² quadrilaterals in the whole disc times 4/3.
    pub fn quarter(elements: usize, quadrant: usize) -> Disc {
        let n = elements;
        let radius = 0.5 * polygon_radius(n);
        let mut disc = Disc::default();
        let core = |i: usize, j: usize| {
            let [s, t] = [i, j].map(|k| k as f64 / n as f64);
            [s, t].map(|x| CORE * 0.5 * x * (1.0 - CORNER * s * t))
        };
        disc.nodes.extend((0..=n).flat_map(|i| (0..=n).map(move |j| core(i, j))));
        let at = |i: usize, j: usize| i * (n + 1) + j;
        let squares = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
        disc.quads.extend(squares.map(|(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]));
        let mut inner: Vec<usize> = (0..=n).map(|j| at(n, j)).chain((0..n).rev().map(|i| at(i, n))).collect();
        let start: Vec<[f64; 2]> = inner.iter().map(|&node| disc.nodes[node]).collect();
        for ring in 1..=n {
            let share = ring as f64 / n as f64;
            let outer: Vec<usize> = (0..=2 * n).map(|k| disc.nodes.len() + k).collect();
            for (k, from) in start.iter().enumerate() {
                let (sine, cosine) = (k as f64 / (2 * n) as f64 * 0.5 * PI).sin_cos();
                let to = [radius * cosine, radius * sine];
                disc.nodes.push([0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis])));
            }
            for k in 0..2 * n {
                disc.quads.push([inner[k], outer[k], outer[k + 1], inner[k + 1]]);
            }
            inner = outer;
        }
        disc.rim = (disc.quads.len() - 2 * n..disc.quads.len()).collect();
        disc.corners = vec![at(n, n)];
        for node in &mut disc.nodes {
            *node = turned(*node, quadrant);
        }
        disc
    }

    /// Four quarters.
    pub fn whole(elements: usize) -> Disc {
        let mut disc = Disc::default();
        let mut known: HashMap<[i64; 2], usize> = HashMap::new();
        for quadrant in 0..4 {
            let quarter = Disc::quarter(elements, quadrant);
            let mut numbers = Vec::with_capacity(quarter.nodes.len());
            for node in quarter.nodes {
                let key = node.map(|x| (x * MERGE).round() as i64);
                numbers.push(*known.entry(key).or_insert_with(|| {
                    disc.nodes.push(node);
                    disc.nodes.len() - 1
                }));
            }
            disc.rim.extend(quarter.rim.iter().map(|quad| quad + disc.quads.len()));
            disc.quads.extend(quarter.quads.iter().map(|quad| quad.map(|node| numbers[node])));
            disc.corners.extend(quarter.corners.iter().map(|&node| numbers[node]));
        }
        disc
    }
}

/// The radius of the polygon's corners over the circle's: a polygon of the circle's area. With corners on the circle
/// the sides would lie inside it everywhere, and the fibres would touch too late.
fn polygon_radius(elements: usize) -> f64 {
    let half_side = PI / (8 * elements) as f64;
    (2.0 * half_side / (2.0 * half_side).sin()).sqrt()
}

/// Turned by so many right angles, without rounding.
fn turned([x, y]: [f64; 2], quadrant: usize) -> [f64; 2] {
    match quadrant % 4 {
        0 => [x, y],
        1 => [-y, x],
        2 => [-x, -y],
        _ => [y, -x],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(disc: &Disc) -> f64 {
        let cross = |[a, b, c, d]: [usize; 4]| {
            let [a, b, c, d] = [a, b, c, d].map(|node| disc.nodes[node]);
            0.5 * ((c[0] - a[0]) * (d[1] - b[1]) - (c[1] - a[1]) * (d[0] - b[0]))
        };
        disc.quads.iter().map(|&quad| cross(quad)).sum()
    }

    #[test]
    fn a_disc_has_the_area_of_the_circle() {
        for elements in [1, 2, 3, 8] {
            let whole = Disc::whole(elements);
            assert_eq!(whole.quads.len(), 12 * elements * elements);
            assert!((area(&whole) - 0.25 * PI).abs() < 1e-12);
            for quadrant in 0..4 {
                assert!((area(&Disc::quarter(elements, quadrant)) - PI / 16.0).abs() < 1e-12);
            }
        }
        assert_eq!(Disc::whole(3).quads.len(), 108);
    }

    #[test]
    fn quarters_share_their_nodes() {
        let (whole, quarter) = (Disc::whole(3), Disc::quarter(3, 0));
        let on_axis = quarter.nodes.iter().filter(|node| node[0].abs() < 1e-12).count();
        assert_eq!(whole.nodes.len(), 4 * (quarter.nodes.len() - on_axis) + 1);
    }
}
