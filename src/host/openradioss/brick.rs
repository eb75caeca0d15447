//! A brick of eight nodes as the solver has it: its volume, the length that the solver's time step is computed with, and what the
//! velocities of its nodes say of the strain rate.

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

/// What the velocity gradient is rounded by: that of the coarser precision, which serves the finer one too.
const ROUNDING: f64 = 16.0 * f32::EPSILON as f64;

/// The part of a strain rate by which it may differ from that of the nodes. Of a strain rate in axes that are turned by an angle θ, it
/// differs by up to 2 sin θ.
const ALLOWED: f64 = 0.1;

/// The coordinates of a brick's nodes.
#[derive(Clone, Copy, Debug)]
pub struct Brick(pub [[f64; 3]; 8]);

/// ∂v/∂x at a place of a brick, by columns, and what it is rounded by.
struct VelocityGradient {
    columns: Matrix<f64>,
    rounding: f64,
}

impl Brick {
    /// ∂x/∂ξ at a place of the reference cube, by columns; at the centre, half of the way from each face to the opposite one.
    pub fn jacobian(&self, place: [f64; 3]) -> Matrix<f64> {
        let mut columns = [[0.0; 3]; 3];
        for (node, corner) in self.0.iter().zip(&CORNERS) {
            for (column, slope) in columns.iter_mut().zip(slopes(*corner, place)) {
                column.iter_mut().zip(node).for_each(|(sum, x)| *sum += slope * x);
            }
        }
        columns
    }

    /// Whether an element of this volume is integrated by one point, the centre: those of eight points have a part of it each.
    pub fn has_one_point(&self, volume: f64) -> bool {
        let [a, b, c] = self.jacobian([0.0; 3]);
        let whole = 8.0 * dot(a, cross(b, c));
        whole > 0.0 && libm::fabs(volume - whole) <= 1e-3 * whole
    }

    /// The length that the solver divides by the wave speed: the volume, by one point, over the largest face.
    pub fn length(&self) -> f64 {
        let [n1, n2, n3, n4, n5, n6, n7, n8] = self.0;
        let mut largest: f64 = 0.0;
        for [a, b, c, d] in
            [[n1, n2, n3, n4], [n5, n6, n7, n8], [n1, n2, n6, n5], [n2, n3, n7, n6], [n3, n4, n8, n7], [n4, n1, n5, n8]]
        {
            let normal = cross(difference(c, a), difference(d, b));
            largest = largest.max(0.25 * dot(normal, normal));
        }
        let [a, b, c] = self.jacobian([0.0; 3]);
        8.0 * dot(a, cross(b, c)) / libm::sqrt(largest)
    }

    /// The rows of the inverse Jacobian at a place, and the determinant.
    fn inverse(&self, place: [f64; 3]) -> ([[f64; 3]; 3], f64) {
        let [a, b, c] = self.jacobian(place);
        let rows = [cross(b, c), cross(c, a), cross(a, b)];
        let determinant = dot(a, rows[0]);
        (rows.map(|row| row.map(|x| x / determinant)), determinant)
    }

    /// The squares of the largest frequencies of an element of one point, for ρ0 c² = (m·n)² in the direction m and for
    /// ρ0 c² = 1: Flanagan and Belytschko's bound (Int. J. Numer. Meth. Eng. 17, 1981), 8 Σ over the nodes of the gradients' squares.
    pub fn frequencies(&self, m: [f64; 3]) -> [f64; 2] {
        let (rows, _) = self.inverse([0.0; 3]);
        let along = rows.iter().map(|&row| dot(row, m) * dot(row, m)).sum();
        [along, rows.iter().map(|&row| dot(row, row)).sum()]
    }

    /// Whether a strain rate, XX YY ZZ XY YZ ZX with the rates of shear angles, is that of these velocities at a point of the brick, in
    /// the axes of the coordinates. True where the velocities do not tell: of a motion that strains the brick too little or too
    /// unevenly, of a brick with an edge that has no length, and of one that is inverted.
    pub fn has_strain_rate(&self, velocities: &[[f64; 3]; 8], time_step: f64, passed: [f64; 6]) -> bool {
        let [n1, n2, n3, n4, n5, n6, n7, n8] = self.0;
        let (faces, between) = ([n1, n2, n3, n4, n1, n5, n6, n7, n8, n5], [[n2, n6], [n3, n7], [n4, n8]]);
        if faces.windows(2).chain(between.iter().map(<[_; 2]>::as_slice)).any(|edge| edge.first() == edge.last()) {
            return true;
        }
        let Some(centre) = self.velocity_gradient([0.0; 3], velocities) else { return true };
        let at_centre = centre.strain_rate();
        let from_centre = distance(passed, at_centre);
        // Midway of the step a rotation has turned the axes by half of its angle.
        let square: f64 = centre.columns.iter().map(|&column| dot(column, column)).sum();
        let allowed = ALLOWED * distance(at_centre, [0.0; 6]) + 2.0 * time_step * square + centre.rounding;
        if from_centre <= allowed || from_centre.is_nan() {
            return true;
        }
        let mut farthest: f64 = 0.0;
        for corner in CORNERS {
            let Some(here) = self.velocity_gradient(corner.map(|x| POINT * x), velocities) else { return true };
            farthest = farthest.max(distance(here.strain_rate(), at_centre));
        }
        from_centre <= allowed + 1.5 * farthest
    }

    fn velocity_gradient(&self, place: [f64; 3], velocities: &[[f64; 3]; 8]) -> Option<VelocityGradient> {
        let (rows, determinant) = self.inverse(place);
        let (mut columns, mut rounding) = ([[0.0; 3]; 3], 0.0);
        for (corner, velocity) in CORNERS.iter().zip(velocities) {
            let slopes = slopes(*corner, place);
            for (j, column) in columns.iter_mut().enumerate() {
                let gradient: f64 = slopes.iter().zip(&rows).filter_map(|(s, row)| Some(s * row.get(j)?)).sum();
                for (sum, v) in column.iter_mut().zip(velocity) {
                    *sum += v * gradient;
                    rounding += libm::fabs(v * gradient) * ROUNDING;
                }
            }
        }
        (determinant > 0.0).then_some(VelocityGradient { columns, rounding })
    }
}

impl VelocityGradient {
    /// XX YY ZZ XY YZ ZX, with the rates of shear angles.
    fn strain_rate(&self) -> [f64; 6] {
        let [[xx, yx, zx], [xy, yy, zy], [xz, yz, zz]] = self.columns;
        [xx, yy, zz, xy + yx, yz + zy, zx + xz]
    }
}

/// The slopes of a corner's shape function at a place of the reference cube.
fn slopes([r, s, t]: [f64; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    let (u, v, w) = (1.0 + r * x, 1.0 + s * y, 1.0 + t * z);
    [0.125 * r * v * w, 0.125 * s * u * w, 0.125 * t * u * v]
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// The norm of the difference of two strain rates.
fn distance(a: [f64; 6], b: [f64; 6]) -> f64 {
    let weights = [1.0, 1.0, 1.0, 0.5, 0.5, 0.5]; // a shear counts twice, with half of its angle
    libm::sqrt(a.iter().zip(&b).zip(weights).map(|((a, b), weight)| weight * (a - b) * (a - b)).sum())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A brick that is no box, turned, and velocities of a uniform gradient.
    fn brick() -> Brick {
        let mut nodes = CORNERS.map(|[x, y, z]| [0.5 * x + 0.1 * z, 0.2 * y - 0.05 * x, z + 0.1 * y]);
        nodes[6][0] += 0.1;
        Brick(nodes)
    }

    fn moving(brick: &Brick, gradient: [[f64; 3]; 3]) -> [[f64; 3]; 8] {
        brick.0.map(|x| gradient.map(|row| 1e5 + dot(row, x)))
    }

    const GRADIENT: [[f64; 3]; 3] = [[1000.0, 200.0, 0.0], [-300.0, -400.0, 50.0], [0.0, 90.0, 20.0]];
    const RATE: [f64; 6] = [1000.0, -400.0, 20.0, -100.0, 140.0, 0.0];

    #[test]
    fn strain_rates_of_a_uniform_motion() {
        let brick = brick();
        let velocities = moving(&brick, GRADIENT);
        assert!(brick.has_strain_rate(&velocities, 1e-8, RATE));
        assert!(brick.has_strain_rate(&velocities, 1e-8, RATE.map(|x| 1.05 * x)), "within what is allowed");
    }

    #[test]
    fn strain_rates_in_turned_axes() {
        let brick = brick();
        let velocities = moving(&brick, GRADIENT);
        for angle in [0.1_f64, 0.5, 1.2] {
            let (c, s) = (angle.cos(), angle.sin());
            let [xx, yy, zz, xy, yz, zx] = RATE;
            let turned = [
                c * c * xx + s * s * yy + c * s * xy,
                s * s * xx + c * c * yy - c * s * xy,
                zz,
                2.0 * c * s * (yy - xx) + (c * c - s * s) * xy,
                c * yz - s * zx,
                c * zx + s * yz,
            ];
            assert!(!brick.has_strain_rate(&velocities, 1e-8, turned), "{angle}");
        }
        let [xx, yy, zz, xy, yz, zx] = RATE;
        assert!(!brick.has_strain_rate(&velocities, 1e-8, [yy, zz, xx, yz, zx, xy]), "exchanged axes");
    }

    #[test]
    fn motions_that_do_not_tell() {
        let brick = brick();
        let still = moving(&brick, [[0.0; 3]; 3]);
        assert!(brick.has_strain_rate(&still, 1e-8, [1e-2; 6]), "rounding of a translation");
        let spin = moving(&brick, [[0.0, -1e5, 0.0], [1e5, 0.0, 0.0], [0.0; 3]]);
        assert!(brick.has_strain_rate(&spin, 1e-7, [500.0, 500.0, 0.0, 0.0, 0.0, 0.0]), "half of the step's rotation");
        let mut bent = moving(&brick, GRADIENT);
        bent[2][0] += 4000.0;
        bent[4][0] -= 4000.0;
        let corner = brick.velocity_gradient([POINT; 3], &bent).expect("a brick").strain_rate();
        assert!(brick.has_strain_rate(&bent, 1e-8, corner), "one of eight points");
        let mut wedge = brick;
        wedge.0[3] = wedge.0[2];
        assert!(wedge.has_strain_rate(&moving(&wedge, GRADIENT), 1e-8, [0.0; 6]), "a wedge");
        assert!(brick.has_strain_rate(&moving(&brick, GRADIENT), 1e-8, [f64::NAN; 6]), "no number");
    }

    #[test]
    fn lengths_and_frequencies_of_a_box() {
        let brick = Brick(CORNERS.map(|[x, y, z]| [2.0 * x, 0.5 * y, 0.25 * z]));
        assert_eq!(brick.length(), 0.5, "the volume, 2, over the largest face, 4");
        assert_eq!(brick.frequencies([1.0, 0.0, 0.0]), [0.25, 0.25 + 4.0 + 16.0]);
        assert!(brick.has_one_point(2.0) && !brick.has_one_point(0.25));
    }
}
