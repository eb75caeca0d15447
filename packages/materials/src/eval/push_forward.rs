//! The push-forward of S and dS/dE as a host forms it, in extended precision and rounded once.
//!
//! A strongly sheared F magnifies the rounding of its products by the second and the fourth power of its size; a
//! comparison with the other entries is to show what the rounding of S and dS/dE themselves leaves.

use nalgebra::Matrix3;
use twofloat::TwoFloat;

/// The tensor indices of the components 11 22 33 12 13 23, the order of MFront and CalculiX.
const PAIRS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

/// The 6×6 matrix of the push-forward of a symmetric tensor, in which an off-diagonal component stands for two entries;
/// and J.
fn transformation(f: &Matrix3<f64>) -> ([[TwoFloat; 6]; 6], TwoFloat) {
    let wide = f.map(TwoFloat::from);
    let rows = PAIRS.map(|(p, q)| {
        PAIRS.map(|(i, j)| {
            let one = wide[(p, i)] * wide[(q, j)];
            if i == j { one } else { one + wide[(p, j)] * wide[(q, i)] }
        })
    });
    (rows, wide.column(0).dot(&wide.column(1).cross(&wide.column(2))))
}

/// The Cauchy stress of a second Piola–Kirchhoff stress, both 11 22 33 12 13 23.
pub fn cauchy_of_second(stress: &[f64; 6], f: &Matrix3<f64>) -> [f64; 6] {
    let (rows, jacobian) = transformation(f);
    rows.map(|row| {
        let mut sum = TwoFloat::from(0.0);
        for (x, &s) in row.into_iter().zip(stress) {
            sum += x * s;
        }
        f64::from(sum / jacobian)
    })
}

/// The Truesdell modulus of the Cauchy stress, 11 22 33 12 13 23, engineering shears, from dS/dE in the same order,
/// tensor components.
pub fn truesdell_of_material(material: &[[f64; 6]; 6], f: &Matrix3<f64>) -> [[f64; 6]; 6] {
    let (transformation, jacobian) = transformation(f);
    transformation.map(|left| {
        transformation.map(|right| {
            let mut sum = TwoFloat::from(0.0);
            for (i, x) in left.into_iter().enumerate() {
                for (j, y) in right.into_iter().enumerate() {
                    sum += x * y * material[i][j];
                }
            }
            f64::from(sum / jacobian)
        })
    })
}
