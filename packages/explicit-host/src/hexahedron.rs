//! The shape of a hexahedron, by its edges: plain loops, since a host asks for it of every element, over and over.

#![expect(clippy::needless_range_loop, reason = "what is inlined for certain: see Lanes")]

use super::lanes::smallest;
use super::vector::{Vector, add, cross, dot, minus};

/// The corners at which the edges along each axis begin. Corner c stands on the upper side of its axis i where bit i of
/// c is set.
const BEGIN: [[usize; 4]; 3] = [[0, 2, 4, 6], [0, 1, 4, 5], [0, 1, 2, 3]];
/// By the corner: the places of its three edges in the lists.
const AT: [[usize; 3]; 8] = [[0, 0, 0], [0, 1, 1], [1, 0, 2], [1, 1, 3], [2, 2, 0], [2, 3, 1], [3, 2, 2], [3, 3, 3]];

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

    #[inline(always)]
    pub fn lengths(&self) -> [[f64; 4]; 3] {
        let mut lengths = [[0.0; 4]; 3];
        for axis in 0..3 {
            for place in 0..4 {
                let edge = self.0[axis][place];
                lengths[axis][place] = dot(edge, edge).sqrt();
            }
        }
        lengths
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

    /// The least Jacobian at such a corner over the lengths of its edges: 1 in a cuboid, negative where it is inside
    /// out, NaN where an edge has no length.
    #[inline(always)]
    pub fn least_scaled_jacobian(&self, corners: [bool; 8]) -> f64 {
        let ([a, b, c], jacobians) = (self.lengths(), self.jacobians());
        let mut least: f64 = 1.0;
        for corner in 0..8 {
            if !corners[corner] {
                continue;
            }
            let [i, j, k] = AT[corner];
            least = smallest(least, jacobians[corner] / (a[i] * b[j] * c[k]));
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

    #[test]
    fn a_corner_that_is_pressed_in_is_seen() {
        let whole = Edges::of(&cube([1.0; 3]));
        assert_eq!(
            (whole.volume(), whole.least_scaled_jacobian([true; 8]), whole.lengths()),
            (1.0, 1.0, [[1.0; 4]; 3])
        );
        let flat = Edges::of(&cube([0.5, 0.5, 1.0]));
        // Its edges from (0, 1, 1), (1, 0, 1) and (1, 1, 0).
        let [a, b, c] = [[0.5, -0.5, 0.0], [-0.5, 0.5, 0.0], [-0.5, -0.5, 1.0]];
        let expected = dot(cross(a, b), c) / (dot(a, a) * dot(b, b) * dot(c, c)).sqrt();
        assert_eq!(flat.jacobians()[7], 0.0);
        assert!(
            (flat.least_scaled_jacobian([true; 8]) - expected).abs() < 1e-15,
            "{}",
            flat.least_scaled_jacobian([true; 8])
        );
        let inside_out = Edges::of(&cube([0.25, 0.25, 0.5]));
        assert!(inside_out.least_scaled_jacobian([true; 8]) < 0.0 && inside_out.volume() > 0.0);
        assert!(Edges::of(&cube([0.0, 1.0, 1.0])).least_scaled_jacobian([true; 8]).is_nan());
    }
}
