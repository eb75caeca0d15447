//! Tangents and stresses in MFront's orders: symmetric tensors 11 22 33 √2·12 √2·13 √2·23, others 11 22 33 12 21 13 31 23 32.

use core::f64::consts::SQRT_2;

use crate::law::number::vector::{Matrix, cofactors, product, scaled, sum, transposed};
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
    ORDER.map(|row| ORDER.map(|column| entry(row, column)))
}

/// dσ/dF, from the Jaumann modulus over J, rows and columns 11 22 33 12 23 31, and the Cauchy stress: with L = dF F⁻¹,
/// dσ = c : D + Wσ − σW − tr L σ.
#[inline(always)]
pub(super) fn cauchy_by_gradient(jaumann: &[[f64; 6]; 6], stress: &[f64; 6], f: &Matrix<f64>) -> [[f64; 9]; 6] {
    let (jacobian, minors) = cofactors(f);
    // The product with F⁻ᵀ, whose columns are those of the cofactors over J.
    by_rows(jaumann, stress, true, &scaled(1.0 / jacobian, &minors))
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
    by_rows(jaumann, stress, false, &product(&cofactors(f1).1, &transposed(f0)))
}

/// The derivative with respect to L, times `right`; with `volume` that of σ, else that of τ over J.
#[inline(always)]
fn by_rows(jaumann: &[[f64; 6]; 6], stress: &[f64; 6], volume: bool, right: &Matrix<f64>) -> [[f64; 9]; 6] {
    let [r1, r2, r3, r4, r5, r6] = jaumann;
    [
        row::<0, 0>(r1, stress, volume, right),
        row::<1, 1>(r2, stress, volume, right),
        row::<2, 2>(r3, stress, volume, right),
        row::<0, 1>(r4, stress, volume, right).map(|x| SQRT_2 * x),
        row::<2, 0>(r6, stress, volume, right).map(|x| SQRT_2 * x),
        row::<1, 2>(r5, stress, volume, right).map(|x| SQRT_2 * x),
    ]
}

/// The row of the component ij. As a matrix of k and m, ∂τ_ij/∂L_km over J is c_ijkm plus the skew part of e_i⊗σ_j + e_j⊗σ_i,
/// σ_j being a column of the stress.
#[inline(always)]
fn row<const I: usize, const J: usize>(
    moduli: &[f64; 6],
    stress: &[f64; 6],
    volume: bool,
    right: &Matrix<f64>,
) -> [f64; 9] {
    let (sigma, mut spun) = (columns(stress), [[0.0; 3]; 3]);
    let mut m = 0;
    while m < 3 {
        spun[m][I] += sigma[J][m];
        spun[m][J] += sigma[I][m];
        m += 1;
    }
    let skew = sum(&spun, -1.0, &transposed(&spun));
    let mut rate = sum(&columns(moduli), 0.5, &skew);
    if volume {
        let mut k = 0;
        while k < 3 {
            rate[k][k] -= sigma[J][I];
            k += 1;
        }
    }
    unsymmetric(product(&rate, right))
}

/// The first Piola–Kirchhoff stress P = JσF⁻ᵀ, by columns.
#[inline(always)]
pub(super) fn first_piola_kirchhoff(cauchy: &[f64; 6], f: &Matrix<f64>) -> Matrix<f64> {
    product(&columns(cauchy), &cofactors(f).1)
}

/// The second Piola–Kirchhoff stress S = JF⁻¹σF⁻ᵀ, 11 22 33 12 23 31.
#[inline(always)]
pub(super) fn second_piola_kirchhoff(cauchy: &[f64; 6], f: &Matrix<f64>) -> [f64; 6] {
    let (jacobian, minors) = cofactors(f);
    let [[s11, s21, s31], [_, s22, s32], [_, _, s33]] =
        scaled(1.0 / jacobian, &product(&transposed(&minors), &product(&columns(cauchy), &minors)));
    [s11, s22, s33, s21, s32, s31]
}
