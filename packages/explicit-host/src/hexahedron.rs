//! The shape of a hexahedron, by its edges: plain loops, since a host asks for it of every element, over and over.

#![expect(clippy::needless_range_loop, reason = "what is inlined for certain: see Lanes")]

use super::lanes::smallest;
use super::vector::{Vector, add, cross, dot, minus};

/// The corners at which the edges along each axis begin. Corner c stands on the upper side of its axis i where bit i of
/// c is set.
const BEGIN: [[usize; 4]; 3] = [[0, 2, 4, 6], [0, 1, 4, 5], [0, 1, 2, 3]];
/// By the corner: the places of its three edges in the lists.
const AT: [[usize; 3]; 8] = [[0, 0, 0], [0, 1, 1], [1, 0, 2], [1, 1, 3], [2, 2, 0], [2, 3, 1], [3, 2, 2], [3, 3, 3]];

/// A square that is larger by this is of a larger number, whatever the rounding.
const CERTAINLY: f64 = 1.0 + 1e-12;

/// Which corners of an element have three edges: of a wedge, those whose node is no other corner's too.
#[inline(always)]
pub fn solid_corners(nodes: &[u32; 8]) -> [bool; 8] {
    let mut solid = [true; 8];
    for axis in 0..3 {
        for place in 0..4 {
            let (from, to) = (BEGIN[axis][place], BEGIN[axis][place] | 1 << axis);
            let apart = nodes[from] != nodes[to];
            (solid[from], solid[to]) = (solid[from] & apart, solid[to] & apart);
        }
    }
    solid
}

/// The four edges along each axis, in its direction.
pub struct Edges([[Vector; 4]; 3]);

impl Edges {
    /// Of the hexahedron with these corners.
    #[inline(always)]
    pub fn of(corners: &[Vector; 8]) -> Edges {
        let mut edges = [[[0.0; 3]; 4]; 3];
        for axis in 0..3 {
            for place in 0..4 {
                let from = BEGIN[axis][place];
                edges[axis][place] = minus(corners[from | 1 << axis], corners[from]);
            }
        }
        Edges(edges)
    }

    pub fn lengths(&self) -> [[f64; 4]; 3] {
        self.squares().map(|of_axis| of_axis.map(f64::sqrt))
    }

    /// Of their lengths.
    #[inline(always)]
    fn squares(&self) -> [[f64; 4]; 3] {
        let mut squares = [[0.0; 4]; 3];
        for axis in 0..3 {
            for place in 0..4 {
                let edge = self.0[axis][place];
                squares[axis][place] = dot(edge, edge);
            }
        }
        squares
    }

    /// At the corners.
    #[inline(always)]
    pub fn jacobians(&self) -> [f64; 8] {
        let [a, b, c] = &self.0;
        let mut jacobians = [0.0; 8];
        for corner in 0..8 {
            let [i, j, k] = AT[corner];
            jacobians[corner] = dot(cross(a[i], b[j]), c[k]);
        }
        jacobians
    }

    /// The least Jacobian at a corner with three edges over their lengths, of the element with these nodes, or this
    /// value, at most 1, where none is less: 1 in a cuboid, negative where it is inside out, NaN where an edge has no
    /// length.
    #[inline(always)]
    pub fn least_scaled_jacobian(&self, nodes: &[u32; 8], mut least: f64) -> f64 {
        let ([a, b, c], jacobians) = (self.squares(), self.jacobians());
        for corner in 0..8 {
            let ([i, j, k], jacobian) = (AT[corner], jacobians[corner]);
            // Roots and quotients are taken only where the squares leave it open: rounding is far below the margin.
            let is_more = jacobian * jacobian > CERTAINLY * least * least * (a[i] * b[j] * c[k]);
            if !(jacobian > 0.0 && is_more) && solid_corners(nodes)[corner] {
                least = smallest(least, jacobian / (a[i].sqrt() * b[j].sqrt() * c[k].sqrt()));
            }
        }
        least
    }

    /// The volume between the means of the edges along each axis.
    #[inline(always)]
    pub fn volume(&self) -> f64 {
        let mut means = [[0.0; 3]; 3];
        for axis in 0..3 {
            for place in 0..4 {
                means[axis] = add(means[axis], 0.25, self.0[axis][place]);
            }
        }
        dot(cross(means[0], means[1]), means[2])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners of the unit cube, with the last one moved.
    fn cube(last: Vector) -> [Vector; 8] {
        let mut corners = [0, 1, 2, 3, 4, 5, 6, 7].map(|c| [0, 1, 2].map(|axis| f64::from(c >> axis & 1)));
        corners[7] = last;
        corners
    }

    fn least(edges: &Edges) -> f64 {
        edges.least_scaled_jacobian(&[0, 1, 2, 3, 4, 5, 6, 7], 1.0)
    }

    #[test]
    fn a_corner_that_is_pressed_in_is_seen() {
        let whole = Edges::of(&cube([1.0; 3]));
        assert_eq!((whole.volume(), least(&whole), whole.lengths()), (1.0, 1.0, [[1.0; 4]; 3]));
        let flat = Edges::of(&cube([0.5, 0.5, 1.0]));
        // Its edges from (0, 1, 1), (1, 0, 1) and (1, 1, 0).
        let [a, b, c] = [[0.5, -0.5, 0.0], [-0.5, 0.5, 0.0], [-0.5, -0.5, 1.0]];
        let expected = dot(cross(a, b), c) / (dot(a, a) * dot(b, b) * dot(c, c)).sqrt();
        assert_eq!(flat.jacobians()[7], 0.0);
        assert!((least(&flat) - expected).abs() < 1e-15, "{}", least(&flat));
        let inside_out = Edges::of(&cube([0.25, 0.25, 0.5]));
        assert!(least(&inside_out) < 0.0 && inside_out.volume() > 0.0);
        assert!(least(&Edges::of(&cube([0.0, 1.0, 1.0]))).is_nan());
    }

    /// From 1 on no corner is passed over.
    #[test]
    fn the_least_of_many_is_that_of_each_to_the_bit() {
        let mut random = fastrand::Rng::with_seed(3);
        for (spread, turned) in [(0.1, false), (1.0, true)] {
            let (mut running, mut of_each): (f64, f64) = (1.0, 1.0);
            for _ in 0..500 {
                let corners = cube([1.0; 3]).map(|corner| corner.map(|x| x + spread * (random.f64() - 0.5)));
                let edges = Edges::of(&corners);
                running = edges.least_scaled_jacobian(&[0, 1, 2, 3, 4, 5, 6, 7], running);
                of_each = smallest(of_each, least(&edges));
                assert_eq!(running.to_bits(), of_each.to_bits());
            }
            assert_eq!(running < 0.0, turned, "{running}");
        }
    }
}
