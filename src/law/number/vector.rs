//! Vectors of three components and 3×3 matrices by columns.

use super::real::Real;

/// Scalar product of two vectors.
#[inline(always)]
pub fn dot<R: Real>(a: [R; 3], b: [R; 3]) -> R {
    a[0].mul_add(b[0], a[1].mul_add(b[1], a[2] * b[2]))
}

/// Vector product of two vectors.
#[inline(always)]
pub fn cross<R: Real>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    [a[1].mul_add(b[2], -(a[2] * b[1])), a[2].mul_add(b[0], -(a[0] * b[2])), a[0].mul_add(b[1], -(a[1] * b[0]))]
}

/// Vector product of two vectors, each component to within 1.5 ulp.
#[inline(always)]
pub fn accurate_cross<R: Real>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    [
        R::difference_of_products(a[1], b[2], a[2], b[1]),
        R::difference_of_products(a[2], b[0], a[0], b[2]),
        R::difference_of_products(a[0], b[1], a[1], b[0]),
    ]
}

/// `a + s b`.
#[inline(always)]
pub fn along<R: Real>(a: [R; 3], s: R, b: [R; 3]) -> [R; 3] {
    [s.mul_add(b[0], a[0]), s.mul_add(b[1], a[1]), s.mul_add(b[2], a[2])]
}

/// `a + s b + t c` where `s b` and `t c` cancel: with a = 0 and fused products as if `s b` had not been rounded.
#[inline(always)]
pub fn along_both<R: Real>(a: [R; 3], (s, b): (R, [R; 3]), (t, c): (R, [R; 3])) -> [R; 3] {
    let first = along(a, s, b);
    let rounding = along([a[0] - first[0], a[1] - first[1], a[2] - first[2]], s, b);
    let both = along(first, t, c);
    [both[0] + rounding[0], both[1] + rounding[1], both[2] + rounding[2]]
}

/// `s a`.
#[inline(always)]
pub fn scale<R: Real>(s: R, a: [R; 3]) -> [R; 3] {
    [s * a[0], s * a[1], s * a[2]]
}

/// The product of a matrix, given by its columns, and a vector.
#[inline(always)]
pub fn image<R: Real>(columns: &[[R; 3]; 3], v: [R; 3]) -> [R; 3] {
    along(along(scale(v[2], columns[2]), v[1], columns[1]), v[0], columns[0])
}

/// A 3×3 matrix by columns.
pub type Matrix<R> = [[R; 3]; 3];

/// A B.
#[inline(always)]
pub fn product<R: Real>(a: &Matrix<R>, b: &Matrix<R>) -> Matrix<R> {
    [image(a, b[0]), image(a, b[1]), image(a, b[2])]
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

/// A + s B.
#[inline(always)]
pub fn sum<R: Real>(a: &Matrix<R>, s: R, b: &Matrix<R>) -> Matrix<R> {
    [along(a[0], s, b[0]), along(a[1], s, b[1]), along(a[2], s, b[2])]
}

/// A − B.
#[inline(always)]
pub fn difference<R: Real>(a: &Matrix<R>, b: &Matrix<R>) -> Matrix<R> {
    sum(a, R::splat(-1.0), b)
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
    [select(mask, a[0], b[0]), select(mask, a[1], b[1]), select(mask, a[2], b[2])]
}

/// `a` where the mask holds, `b` elsewhere, for vectors.
#[inline(always)]
pub fn select<R: Real>(mask: R::Mask, a: [R; 3], b: [R; 3]) -> [R; 3] {
    [R::select(mask, a[0], b[0]), R::select(mask, a[1], b[1]), R::select(mask, a[2], b[2])]
}

/// Whether every entry is a finite number.
#[inline(always)]
pub fn is_finite<R: Real>(a: &Matrix<R>) -> R::Mask {
    let zero = R::splat(0.0);
    let nothing = along(along(scale(zero, a[0]), zero, a[1]), zero, a[2]);
    (nothing[0] + nothing[1] + nothing[2]).le(zero)
}

/// A vector divided by its length. A vector along a coordinate axis becomes exactly that axis, which a product with the
/// reciprocal would not.
#[inline(always)]
pub fn unit<R: Real>(v: [R; 3]) -> [R; 3] {
    let length = dot(v, v).sqrt();
    let inverse = length.reciprocal();
    [v[0].quotient(length, inverse), v[1].quotient(length, inverse), v[2].quotient(length, inverse)]
}
