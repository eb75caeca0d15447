//! A brick of eight nodes as the solver has it, whose diagonal tells whether a deformation gradient is in the axes of
//! the coordinates.

use crate::law::number::vector::{Matrix, cross, dot};

/// The corners of the reference cube, node by node: nodes 1 to 4 are a face, and 5 to 8 the one opposite.
const CORNERS: [[f64; 3]; 8] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
];

/// Where elements of eight points have them.
const POINT: f64 = 0.577_350_269_189_625_8;

/// The part of its length by which a diagonal may be elsewhere than F takes it.
const ALLOWED: f64 = 1e-4;

/// The part of the largest coordinate by which it may besides, in units of rounding.
const ROUNDINGS: f64 = 64.0;

/// The coordinates of a brick's nodes.
#[derive(Clone, Copy, Debug)]
pub struct Brick(pub [[f64; 3]; 8]);

impl Brick {
    /// ∂x/∂ξ at a place of the reference cube, by columns; at the centre, half of the way from each face to the
    /// opposite one.
    pub fn jacobian(&self, place: [f64; 3]) -> Matrix<f64> {
        let mut columns = [[0.0; 3]; 3];
        for (node, corner) in self.0.iter().zip(&CORNERS) {
            for (column, slope) in columns.iter_mut().zip(slopes(*corner, place)) {
                column.iter_mut().zip(node).for_each(|(sum, x)| *sum += slope * x);
            }
        }
        columns
    }

    /// Whether an element of this volume is integrated by one point, the centre: those of eight points have a part of
    /// it each.
    pub fn has_one_point(&self, volume: f64) -> bool {
        let [a, b, c] = self.jacobian([0.0; 3]);
        let whole = 8.0 * dot(a, cross(b, c));
        whole > 0.0 && libm::fabs(volume - whole) <= 1e-3 * whole
    }

    /// From the first node to the seventh, and at once between the other opposite ones: the image of (1, 1, 1) at the
    /// centre. None of a brick with an edge that has no length: of such elements the solver may have another gradient.
    pub fn diagonal(&self) -> Option<[f64; 3]> {
        let [n1, n2, n3, n4, n5, n6, n7, n8] = self.0;
        let (faces, between) = ([n1, n2, n3, n4, n1, n5, n6, n7, n8, n5], [[n2, n6], [n3, n7], [n4, n8]]);
        let mut edges = faces.windows(2).chain(between.iter().map(<[_; 2]>::as_slice));
        (!edges.any(|edge| edge.first() == edge.last())).then(|| self.diagonal_at([0.0; 3]))
    }

    fn diagonal_at(&self, place: [f64; 3]) -> [f64; 3] {
        let [a, b, c] = self.jacobian(place);
        [0, 1, 2].map(|i| a[i] + b[i] + c[i])
    }

    /// Whether the diagonals of its eight points are that of the centre: of an undeformed element that is not even, F
    /// at a point takes the centre's diagonal to another place than that of the deformed one, which may be a box.
    pub fn is_even(&self) -> bool {
        let here = self.diagonal_at([0.0; 3]);
        self.unevenness(here) <= ALLOWED * length(here)
    }

    /// By how much the diagonal of one of its eight points differs from this one.
    fn unevenness(&self, here: [f64; 3]) -> f64 {
        let of_points = CORNERS.iter().map(|corner| self.diagonal_at(corner.map(|x| POINT * x)));
        of_points.fold(0.0, |largest: f64, other| largest.max(length(difference(other, here))))
    }

    /// Whether the diagonal of this element may be where F takes that of the undeformed one. Of one point, F is that of
    /// the centre; of eight points, of an element that was [even](Self::is_even), it may differ from it by what the
    /// diagonal does from point to point.
    pub fn has_diagonal(&self, taken: [f64; 3], one_point: bool, rounding: f64) -> bool {
        let here = self.diagonal_at([0.0; 3]);
        let largest = self.0.iter().flatten().fold(0.0, |largest: f64, x| largest.max(libm::fabs(*x)));
        let mut allowed = ALLOWED * length(here) + ROUNDINGS * rounding * largest;
        if !one_point {
            allowed += 1.5 * self.unevenness(here);
        }
        let apart = length(difference(taken, here));
        apart <= allowed || apart.is_nan()
    }
}

/// The slopes of a corner's shape function at a place of the reference cube.
fn slopes([r, s, t]: [f64; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    let (u, v, w) = (1.0 + r * x, 1.0 + s * y, 1.0 + t * z);
    [0.125 * r * v * w, 0.125 * s * u * w, 0.125 * t * u * v]
}

fn length([x, y, z]: [f64; 3]) -> f64 {
    libm::sqrt(x * x + y * y + z * z)
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A brick that is no box.
    fn brick() -> Brick {
        let mut nodes = CORNERS.map(|[x, y, z]| [0.5 * x + 0.1 * z, 0.2 * y - 0.05 * x, z + 0.1 * y]);
        nodes[6][0] += 0.1;
        Brick(nodes)
    }

    /// By rows: a stretch and a shear of some per cent, behind them a turn about z.
    fn stretched_and_turned(angle: f64) -> [[[f64; 3]; 3]; 2] {
        let (c, s) = (angle.cos(), angle.sin());
        let stretched = [[1.03, 0.01, 0.0], [0.01, 0.9, 0.02], [0.0, 0.02, 1.0]];
        let turn = [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]];
        let times = |a: [[f64; 3]; 3], b: [[f64; 3]; 3]| {
            a.map(|row| [0, 1, 2].map(|j| (0..3).map(|k| row[k] * b[k][j]).sum::<f64>()))
        };
        // In axes that turn with the element: those that are turned on both sides, of the matrix that is.
        [times(turn, stretched), times(stretched, turn)]
    }

    fn taken(f: [[f64; 3]; 3], vector: [f64; 3]) -> [f64; 3] {
        f.map(|row| dot(row, vector))
    }

    #[test]
    fn a_gradient_in_global_axes_takes_the_diagonal_along() {
        let first = brick();
        let diagonal = first.diagonal().expect("a brick");
        for angle in [0.0, 0.1, 0.5, 1.2, 3.1] {
            let [f, turning] = stretched_and_turned(angle);
            // Far from the origin, where single precision has few digits.
            let now = Brick(first.0.map(|x| taken(f, x).map(|x| x + 100.0)));
            for (one_point, rounding) in [(true, 1e-16), (true, 1e-7), (false, 1e-16)] {
                assert!(now.has_diagonal(taken(f, diagonal), one_point, rounding), "{angle}");
            }
            let sees = !now.has_diagonal(taken(turning, diagonal), true, 1e-16);
            assert_eq!(sees, angle > 0.0, "{angle}: axes that turn");
        }
        assert!(first.has_diagonal([f64::NAN; 3], true, 1e-16), "no number: what that is the law says");
    }

    #[test]
    fn elements_of_eight_points_may_differ_by_their_unevenness() {
        let mut bent = brick();
        let diagonal = bent.diagonal().expect("a brick");
        bent.0[2][0] += 0.2;
        bent.0[4][0] -= 0.2;
        let of_a_point = bent.diagonal_at([POINT; 3]);
        assert!(bent.has_diagonal(of_a_point, false, 1e-16) && !bent.has_diagonal(of_a_point, true, 1e-16));
        assert!(!bent.has_diagonal(diagonal.map(|x| 3.0 * x), false, 1e-16));
        // A brick of a crimped yarn, whose end faces are tilted, pulled straight: F at its points takes the diagonal
        // elsewhere.
        let tilted = |by: f64| Brick(CORNERS.map(|[x, y, z]| [x + by * x * y, 0.5 * y, 0.5 * z]));
        assert!(!tilted(0.05).is_even() && tilted(0.0).is_even());
        let mut wedge = brick();
        wedge.0[3] = wedge.0[2];
        assert_eq!(wedge.diagonal(), None, "an edge without length");
    }

    #[test]
    fn elements_of_one_point_have_the_whole_volume() {
        let brick = Brick(CORNERS.map(|[x, y, z]| [2.0 * x, 0.5 * y, 0.25 * z]));
        assert!(brick.has_one_point(2.0) && !brick.has_one_point(0.25) && !brick.has_one_point(f64::NAN));
    }
}
