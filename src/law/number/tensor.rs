//! Functions of symmetric tensors for laws in formulas: inverse, square root, logarithm, exponential, polar decomposition.
//!
//! Each is a fixed number of products and inverses, without eigenvectors, so that it has a derivative everywhere, also
//! where eigenvalues coincide, as they do at rest. The eigenvalues themselves have none there.

use super::real::Real;
use super::vector::{Matrix, cofactors, product, scaled, sum, transposed};

/// Steps of the iteration for a root: for eigenvalues that differ by a factor of 10⁵ at most.
const STEPS: usize = 14;
/// The logarithm is taken of the 2ᵏ-th root.
const ROOTS: usize = 3;
/// The exponential is taken of the 2ᵏ-th part.
const HALVINGS: usize = 6;

/// 1.
#[inline(always)]
pub fn identity<R: Real>() -> Matrix<R> {
    let (one, zero) = (R::splat(1.0), R::splat(0.0));
    [[one, zero, zero], [zero, one, zero], [zero, zero, one]]
}

/// A⁻¹ of any matrix whose determinant is not 0.
#[inline(always)]
pub fn inverse<R: Real>(a: &Matrix<R>) -> Matrix<R> {
    let (determinant, minors) = cofactors(a);
    scaled(R::splat(1.0) / determinant, &transposed(&minors))
}

/// √A of a symmetric, positive definite matrix (Denman and Beavers' iteration, Appl. Math. Comput. 2, 1976).
#[inline(always)]
pub fn square_root<R: Real>(a: &Matrix<R>) -> Matrix<R> {
    // In the middle of its eigenvalues 1 is nearest.
    let third = R::splat(1.0 / 3.0);
    let size = third * (a[0][0] + a[1][1] + a[2][2]);
    let half = R::splat(0.5);
    let (mut x, mut y, mut step) = (scaled(R::splat(1.0) / size, a), identity(), 0);
    while step < STEPS {
        let (x_inverse, y_inverse) = (inverse(&x), inverse(&y));
        x = scaled(half, &sum(&x, R::splat(1.0), &y_inverse));
        y = scaled(half, &sum(&y, R::splat(1.0), &x_inverse));
        step += 1;
    }
    scaled(size.sqrt(), &x)
}

/// ln A of a symmetric, positive definite matrix: with ½ ln FᵀF the true strain.
#[inline(always)]
pub fn logarithm<R: Real>(a: &Matrix<R>) -> Matrix<R> {
    let (mut root, mut k) = (*a, 0);
    while k < ROOTS {
        root = square_root(&root);
        k += 1;
    }
    // ln X = 2 artanh Z, Z = (X − 1)(X + 1)⁻¹.
    let (one, identity) = (R::splat(1.0), identity());
    let z = product(&sum(&root, -one, &identity), &inverse(&sum(&root, one, &identity)));
    let square = product(&z, &z);
    let (mut series, mut term) = (scaled(R::splat(1.0 / 29.0), &identity), 27_i32);
    while term > 0 {
        series = sum(&product(&square, &series), R::splat(1.0 / f64::from(term)), &identity);
        term -= 2;
    }
    scaled(R::splat(2.0 * (1 << ROOTS) as f64), &product(&z, &series))
}

/// eᴬ of any matrix.
#[inline(always)]
pub fn exponential<R: Real>(a: &Matrix<R>) -> Matrix<R> {
    let part = scaled(R::splat(1.0 / (1 << HALVINGS) as f64), a);
    let identity = identity();
    let (mut series, mut term) = (identity, 14_i32);
    while term > 0 {
        series = sum(&identity, R::splat(1.0 / f64::from(term)), &product(&part, &series));
        term -= 1;
    }
    let mut k = 0;
    while k < HALVINGS {
        series = product(&series, &series);
        k += 1;
    }
    series
}

/// R and U of F = RU: the rotation and the right stretch of a deformation gradient.
#[inline(always)]
pub fn polar<R: Real>(f: &Matrix<R>) -> (Matrix<R>, Matrix<R>) {
    let stretch = square_root(&product(&transposed(f), f));
    (product(f, &inverse(&stretch)), stretch)
}
