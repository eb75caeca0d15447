//! One stress, several measures: Cauchy σ, Kirchhoff τ = Jσ, first Piola–Kirchhoff P = JσF⁻ᵀ, second S = JF⁻¹σF⁻ᵀ.

use nalgebra::Matrix3;

use super::real::Real;

/// The indices of the six components 11 22 33 12 23 31, and the component of two indices.
pub const PAIRS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)];
pub const VOIGT: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];

/// s a⊗a, 11 22 33 12 23 31.
#[inline(always)]
pub fn square<R: Real>(s: R, a: [R; 3]) -> [R; 6] {
    let [x, y, z] = [s * a[0], s * a[1], s * a[2]];
    [x * a[0], y * a[1], z * a[2], x * a[1], y * a[2], z * a[0]]
}

/// s times the symmetric part of a⊗b, 11 22 33 12 23 31.
#[inline(always)]
pub fn symmetric_product<R: Real>(s: R, a: [R; 3], b: [R; 3]) -> [R; 6] {
    let half = R::splat(0.5) * s;
    [
        s * a[0] * b[0],
        s * a[1] * b[1],
        s * a[2] * b[2],
        half * a[0].mul_add(b[1], a[1] * b[0]),
        half * a[1].mul_add(b[2], a[2] * b[1]),
        half * a[2].mul_add(b[0], a[0] * b[2]),
    ]
}

/// The symmetric matrix of six components 11 22 33 12 23 31.
pub fn matrix(s: &[f64; 6]) -> Matrix3<f64> {
    Matrix3::new(s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2])
}

/// The six components 11 22 33 12 23 31 of a symmetric matrix.
pub fn components(s: &Matrix3<f64>) -> [f64; 6] {
    [s.m11, s.m22, s.m33, s.m12, s.m23, s.m31]
}

/// The matrix of cofactors, J F⁻ᵀ, which exists for every F.
pub fn cofactors(f: &Matrix3<f64>) -> Matrix3<f64> {
    Matrix3::new(
        f.m22 * f.m33 - f.m23 * f.m32,
        f.m23 * f.m31 - f.m21 * f.m33,
        f.m21 * f.m32 - f.m22 * f.m31,
        f.m13 * f.m32 - f.m12 * f.m33,
        f.m11 * f.m33 - f.m13 * f.m31,
        f.m12 * f.m31 - f.m11 * f.m32,
        f.m12 * f.m23 - f.m13 * f.m22,
        f.m13 * f.m21 - f.m11 * f.m23,
        f.m11 * f.m22 - f.m12 * f.m21,
    )
}

/// First Piola–Kirchhoff stress of a Cauchy stress: the conjugate of F, force per reference area.
pub fn first_piola_kirchhoff(cauchy: &[f64; 6], f: &Matrix3<f64>) -> Matrix3<f64> {
    matrix(cauchy) * cofactors(f)
}
