//! The push-forward of dS/dE as a host forms it, in extended precision and rounded once.
//!
//! A strongly sheared F magnifies the rounding of its products by the fourth power of its size; a comparison with the other entries
//! is to show what the rounding of dS/dE itself leaves.

use nalgebra::Matrix3;
use twofloat::TwoFloat;

use std::f64::consts::SQRT_2;

/// The tensor indices of the components 11 22 33 12 13 23, MFront's order.
const PAIRS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

/// The Truesdell modulus of the Cauchy stress, 11 22 33 12 13 23, engineering shears, from dS/dE by rows as MFront's libraries give
/// it: the same order, with factors √2 on both sides.
pub fn truesdell_of_material(material: &[f64; 36], f: &Matrix3<f64>) -> [[f64; 6]; 6] {
    // The quotient, rounded, is mostly the number that has been multiplied by √2.
    let without_factors = |i: usize, j: usize| {
        let entry = material[6 * i + j];
        TwoFloat::from(match (i < 3, j < 3) {
            (true, true) => entry,
            (false, false) => entry / 2.0,
            _ => entry / SQRT_2,
        })
    };
    let wide = f.map(TwoFloat::from);
    // The 6×6 matrix of the push-forward of a symmetric tensor, in which an off-diagonal component stands for two entries.
    let transformation: [[TwoFloat; 6]; 6] = PAIRS.map(|(p, q)| {
        PAIRS.map(|(i, j)| {
            let one = wide[(p, i)] * wide[(q, j)];
            if i == j { one } else { one + wide[(p, j)] * wide[(q, i)] }
        })
    });
    let jacobian = wide.column(0).dot(&wide.column(1).cross(&wide.column(2)));
    transformation.map(|left| {
        transformation.map(|right| {
            let mut sum = TwoFloat::from(0.0);
            for (i, x) in left.into_iter().enumerate() {
                for (j, y) in right.into_iter().enumerate() {
                    sum += x * y * without_factors(i, j);
                }
            }
            f64::from(sum / jacobian)
        })
    })
}
