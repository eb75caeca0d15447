//! Functions of symmetric tensors for laws in formulas: inverse, square root, logarithm, exponential, polar
//! decomposition, eigenvalues.
//!
//! Each but the last is a fixed number of products and inverses, without eigenvectors, so that it has a derivative
//! everywhere, also where eigenvalues coincide, as they do at rest. The eigenvalues themselves have none there; what is
//! made of them by a formula in which they stand alike has.

use super::real::Real;
use super::vector::{Matrix, along, cofactors, dot, image, product, scale, scaled, sum, transposed};

/// Steps of the iteration for a root: for eigenvalues that differ by a factor of 10⁵ at most.
const STEPS: usize = 14;
/// The logarithm is taken of the 2ᵏ-th root.
const ROOTS: usize = 3;
/// The exponential is taken of the 2ᵏ-th part.
const HALVINGS: usize = 6;

/// Sweeps of three rotations each, after which nothing is left beside the diagonal.
const SWEEPS: usize = 5;

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

/// The eigenvalues of a symmetric matrix, the largest first, each to a few roundings of the largest one's size, however
/// near they are to one another.
///
/// The derivative of each is n·Ȧn with its eigenvector n. Where eigenvalues coincide n is one of many, which one is not
/// said; the sum of their derivatives is right, and so is the derivative of every function in which they stand alike,
/// such as f(a) + f(b) + f(c). That of one alone, the largest say, is then one of the slopes that it has to its sides.
#[inline(always)]
pub fn eigenvalues<R: Real>(a: &Matrix<R>) -> [R; 3] {
    let axes = eigenvectors(a);
    let [x, y, z] = axes;
    // Of the whole A, with its derivative, in axes that have none.
    let (x, y, z) = (quotient(a, x), quotient(a, y), quotient(a, z));
    let (x, y) = sorted(x, y);
    let (y, z) = sorted(y, z);
    let (x, y) = sorted(x, y);
    [x, y, z]
}

/// Rayleigh's quotient.
#[inline(always)]
fn quotient<R: Real>(a: &Matrix<R>, x: [R; 3]) -> R {
    dot(x, image(a, x)) / dot(x, x)
}

/// The larger of two numbers, and the other one.
#[inline(always)]
fn sorted<R: Real>(a: R, b: R) -> (R, R) {
    let swap = a.lt(b);
    (R::select(swap, b, a), R::select(swap, a, b))
}

/// Unit eigenvectors of a symmetric matrix, as numbers that do not change (Jacobi's rotations, J. reine angew. Math.
/// 30, 1846).
#[inline(always)]
fn eigenvectors<R: Real>(a: &Matrix<R>) -> Matrix<R> {
    let (zero, one) = (R::splat(0.0), R::splat(1.0));
    let entries = [a[0][0], a[1][1], a[2][2], a[0][1], a[1][2], a[2][0]];
    let (mut size, mut k) = (zero, 0);
    while k < 6 {
        size = size.max(entries[k].without_slope().abs());
        k += 1;
    }
    // Of the size of 1, whose square neither overflows nor vanishes.
    let per = one / R::select(zero.lt(size), size, one);
    let mut diagonal =
        [per * entries[0].without_slope(), per * entries[1].without_slope(), per * entries[2].without_slope()];
    // Entry k is that of the pair (k, k + 1).
    let mut beside =
        [per * entries[3].without_slope(), per * entries[4].without_slope(), per * entries[5].without_slope()];
    let (mut axes, mut turn) = (identity(), 0);
    while turn < 3 * SWEEPS {
        let p = turn % 3;
        let (q, r) = ((p + 1) % 3, (p + 2) % 3);
        let (apart, twice) = (diagonal[q] - diagonal[p], beside[p] + beside[p]);
        let length = apart.abs() + apart.mul_add(apart, twice * twice).sqrt();
        let towards = R::select(apart.lt(zero), -twice, twice);
        let tangent = towards / R::select(zero.lt(length), length, one);
        let cosine = one / tangent.mul_add(tangent, one).sqrt();
        let sine = tangent * cosine;
        diagonal[p] -= tangent * beside[p];
        diagonal[q] += tangent * beside[p];
        beside[p] = zero;
        // Those of the pairs (q, r) and (r, p).
        let (of_q, of_p) = (beside[q], beside[r]);
        beside[r] = cosine.mul_add(of_p, -(sine * of_q));
        beside[q] = sine.mul_add(of_p, cosine * of_q);
        let (axis_p, axis_q) = (axes[p], axes[q]);
        axes[p] = along(scale(cosine, axis_p), -sine, axis_q);
        axes[q] = along(scale(cosine, axis_q), sine, axis_p);
        turn += 1;
    }
    axes
}
