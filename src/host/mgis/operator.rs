//! Tangents and stresses in MFront's orders: symmetric tensors 11 22 33 √2·12 √2·13 √2·23, others 11 22 33 12 21 13 31
//! 23 32.

use core::f64::consts::SQRT_2;

use crate::law::number::vector::{Matrix, cofactors, product, scaled, transposed};
use crate::law::voigt::columns;

/// The components of a symmetric tensor 11 22 33 12 23 31.
#[inline(always)]
pub(super) fn symmetric([s11, s22, s33, s12, s23, s31]: [f64; 6]) -> [f64; 6] {
    [s11, s22, s33, SQRT_2 * s12, SQRT_2 * s31, SQRT_2 * s23]
}

/// The components of a tensor given by its columns.
#[inline(always)]
pub(super) fn unsymmetric([[t11, t21, t31], [t12, t22, t32], [t13, t23, t33]]: Matrix<f64>) -> [f64; 9] {
    [t11, t22, t33, t12, t21, t13, t31, t23, t32]
}

/// A modulus of rows and columns 11 22 33 12 23 31, its columns engineering shears.
#[inline(always)]
pub(super) fn material([r1, r2, r3, r4, r5, r6]: [[f64; 6]; 6]) -> [[f64; 6]; 6] {
    let shear = |[c11, c22, c33, c12, c23, c31]: [f64; 6]| {
        [SQRT_2 * c11, SQRT_2 * c22, SQRT_2 * c33, 2.0 * c12, 2.0 * c31, 2.0 * c23]
    };
    [symmetric(r1), symmetric(r2), symmetric(r3), shear(r4), shear(r6), shear(r5)]
}

/// dP/dF, from its entries (row, column) with both indices 11 21 31 12 22 32 13 23 33.
#[inline(always)]
pub(super) fn nominal(entry: impl Fn(usize, usize) -> f64) -> [[f64; 9]; 9] {
    const ORDER: [usize; 9] = [0, 4, 8, 3, 1, 6, 2, 7, 5];
    let (mut rows, mut r) = ([[0.0; 9]; 9], 0);
    while r < 9 {
        let mut c = 0;
        while c < 9 {
            rows[r][c] = entry(ORDER[r], ORDER[c]);
            c += 1;
        }
        r += 1;
    }
    rows
}

/// dσ/dF, from the columns of the Jaumann modulus over J, 11 22 33 12 23 31, and the Cauchy stress: with L = dF F⁻¹,
/// dσ = c : D + Wσ − σW − tr L σ.
#[inline(always)]
pub(super) fn cauchy_by_gradient(jaumann: &[[f64; 6]; 6], stress: &[f64; 6], f: &Matrix<f64>) -> [[f64; 9]; 6] {
    let (jacobian, minors) = cofactors(f);
    // The product with F⁻ᵀ, whose columns are those of the cofactors over J.
    by_rows(jaumann, stress, *stress, &scaled(1.0 / jacobian, &minors))
}

/// dτ/dΔF for F1 = ΔF F0, from the same: dτ = J (c : D + Wσ − σW) with L = dΔF F0 F1⁻¹.
#[inline(always)]
pub(super) fn kirchhoff_by_increment(
    jaumann: &[[f64; 6]; 6],
    stress: &[f64; 6],
    f0: &Matrix<f64>,
    f1: &Matrix<f64>,
) -> [[f64; 9]; 6] {
    // J (F0 F1⁻¹)ᵀ is the product of the cofactors of F1 and F0ᵀ.
    by_rows(jaumann, stress, [0.0; 6], &product(&cofactors(f1).1, &transposed(f0)))
}

/// The derivative c : D + Wσ − σW − tr L `volume` with respect to L, times `right`, by rows. The components of the
/// stress and of its derivatives stand side by side, which lets the compiler use vectors.
///
/// The columns for L_km and L_mk are those of c plus and minus w_km, w_km being that of the spin.
#[inline(always)]
fn by_rows(
    [c11, c22, c33, c12, c23, c31]: &[[f64; 6]; 6],
    &[s11, s22, s33, s12, s23, s31]: &[f64; 6],
    volume: [f64; 6],
    right: &Matrix<f64>,
) -> [[f64; 9]; 6] {
    let w12 = [s12, -s12, 0.0, 0.5 * (s22 - s11), -0.5 * s31, 0.5 * s23];
    let w23 = [0.0, s23, -s23, 0.5 * s31, 0.5 * (s33 - s22), -0.5 * s12];
    let w31 = [-s31, 0.0, s31, -0.5 * s23, 0.5 * s12, 0.5 * (s11 - s33)];
    let rate = [
        [plus(c11, -1.0, &volume), plus(c12, 1.0, &w12), plus(c31, -1.0, &w31)],
        [plus(c12, -1.0, &w12), plus(c22, -1.0, &volume), plus(c23, 1.0, &w23)],
        [plus(c31, 1.0, &w31), plus(c23, -1.0, &w23), plus(c33, -1.0, &volume)],
    ];
    let [[r11, r21, r31], [r12, r22, r32], [r13, r23, r33]] = *right;
    let by_columns = [
        combined(&rate[0], [r11, r21, r31]),
        combined(&rate[1], [r12, r22, r32]),
        combined(&rate[2], [r13, r23, r33]),
        combined(&rate[0], [r12, r22, r32]),
        combined(&rate[1], [r11, r21, r31]),
        combined(&rate[0], [r13, r23, r33]),
        combined(&rate[2], [r11, r21, r31]),
        combined(&rate[1], [r13, r23, r33]),
        combined(&rate[2], [r12, r22, r32]),
    ];
    let (mut rows, mut c) = ([[0.0; 9]; 6], 0);
    while c < 9 {
        let [x11, x22, x33, x12, x23, x31] = by_columns[c];
        (rows[0][c], rows[1][c], rows[2][c]) = (x11, x22, x33);
        (rows[3][c], rows[4][c], rows[5][c]) = (x12, x31, x23);
        c += 1;
    }
    rows
}

/// A + s B.
#[inline(always)]
fn plus(a: &[f64; 6], s: f64, b: &[f64; 6]) -> [f64; 6] {
    let (mut sum, mut i) = (*a, 0);
    while i < 6 {
        sum[i] += s * b[i];
        i += 1;
    }
    sum
}

/// The combination of three columns with these factors; its shear components with the factor √2.
#[inline(always)]
fn combined([a, b, c]: &[[f64; 6]; 3], [x, y, z]: [f64; 3]) -> [f64; 6] {
    const FACTORS: [f64; 6] = [1.0, 1.0, 1.0, SQRT_2, SQRT_2, SQRT_2];
    let (mut sum, mut i) = ([0.0; 6], 0);
    while i < 6 {
        sum[i] = FACTORS[i] * (x * a[i] + y * b[i] + z * c[i]);
        i += 1;
    }
    sum
}

/// The first Piola–Kirchhoff stress P = JσF⁻ᵀ, by columns.
#[inline(always)]
pub(super) fn first_piola_kirchhoff(cauchy: &[f64; 6], f: &Matrix<f64>) -> Matrix<f64> {
    product(&columns(cauchy), &cofactors(f).1)
}
