//! 3×3 matrices by columns in the number that the law is written in.

use super::real::{Real, cross, dot, image, scale};

/// Three columns.
pub type Matrix<R> = [[R; 3]; 3];

/// A B.
#[inline(always)]
pub fn product<R: Real>(a: &Matrix<R>, b: &Matrix<R>) -> Matrix<R> {
    [image(a, b[0]), image(a, b[1]), image(a, b[2])]
}

/// Aᵀ B.
#[inline(always)]
pub fn transposed_product<R: Real>(a: &Matrix<R>, b: &Matrix<R>) -> Matrix<R> {
    let column = |b: [R; 3]| [dot(a[0], b), dot(a[1], b), dot(a[2], b)];
    [column(b[0]), column(b[1]), column(b[2])]
}

/// Aᵀ.
#[inline(always)]
pub fn transposed<R: Real>(a: &Matrix<R>) -> Matrix<R> {
    [[a[0][0], a[1][0], a[2][0]], [a[0][1], a[1][1], a[2][1]], [a[0][2], a[1][2], a[2][2]]]
}

/// s A.
#[inline(always)]
pub fn scaled<R: Real>(s: R, a: &Matrix<R>) -> Matrix<R> {
    [scale(s, a[0]), scale(s, a[1]), scale(s, a[2])]
}

/// s A + t B.
#[inline(always)]
pub fn combined<R: Real>(s: R, a: &Matrix<R>, t: R, b: &Matrix<R>) -> Matrix<R> {
    let column = |a: [R; 3], b: [R; 3]| {
        let b = scale(t, b);
        [s.mul_add(a[0], b[0]), s.mul_add(a[1], b[1]), s.mul_add(a[2], b[2])]
    };
    [column(a[0], b[0]), column(a[1], b[1]), column(a[2], b[2])]
}

/// A − B.
#[inline(always)]
pub fn difference<R: Real>(a: &Matrix<R>, b: &Matrix<R>) -> Matrix<R> {
    let column = |a: [R; 3], b: [R; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    [column(a[0], b[0]), column(a[1], b[1]), column(a[2], b[2])]
}

/// A + s 1.
#[inline(always)]
pub fn shifted<R: Real>(a: &Matrix<R>, s: R) -> Matrix<R> {
    [[a[0][0] + s, a[0][1], a[0][2]], [a[1][0], a[1][1] + s, a[1][2]], [a[2][0], a[2][1], a[2][2] + s]]
}

/// The determinant and the matrix of cofactors, det A A⁻ᵀ.
#[inline(always)]
pub fn cofactors<R: Real>(a: &Matrix<R>) -> (R, Matrix<R>) {
    let minors = [cross(a[1], a[2]), cross(a[2], a[0]), cross(a[0], a[1])];
    (dot(a[0], minors[0]), minors)
}

/// A:A, the square of the norm.
#[inline(always)]
pub fn square_norm<R: Real>(a: &Matrix<R>) -> R {
    dot(a[0], a[0]) + (dot(a[1], a[1]) + dot(a[2], a[2]))
}

/// `a` where the mask holds, `b` elsewhere.
#[inline(always)]
pub fn selected<R: Real>(mask: R::Mask, a: &Matrix<R>, b: &Matrix<R>) -> Matrix<R> {
    let column =
        |a: [R; 3], b: [R; 3]| [R::select(mask, a[0], b[0]), R::select(mask, a[1], b[1]), R::select(mask, a[2], b[2])];
    [column(a[0], b[0]), column(a[1], b[1]), column(a[2], b[2])]
}

/// Whether every entry is a finite number.
#[inline(always)]
pub fn is_finite<R: Real>(a: &Matrix<R>) -> R::Mask {
    let zero = R::splat(0.0);
    let nothing = scale(zero, a[0]);
    let nothing = [
        a[1][0].mul_add(zero, a[2][0].mul_add(zero, nothing[0])),
        a[1][1].mul_add(zero, a[2][1].mul_add(zero, nothing[1])),
        a[1][2].mul_add(zero, a[2][2].mul_add(zero, nothing[2])),
    ];
    (nothing[0] + nothing[1] + nothing[2]).le(zero)
}
