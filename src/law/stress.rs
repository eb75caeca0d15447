//! Stress measures and conversions between them: Cauchy σ, Kirchhoff τ = Jσ, first Piola–Kirchhoff P = JσF⁻ᵀ, second
//! S = JF⁻¹σF⁻ᵀ.

use nalgebra::Matrix3;

use super::number::real::Real;
use super::number::vector::{Matrix, cofactors, cross, dot, image, product, scaled, select, transposed, unit};
use super::voigt::{Moduli, PAIRS, columns, paired_with_one, upper_triangle};

/// The symmetric matrix of six components 11 22 33 12 23 31.
pub fn matrix(s: &[f64; 6]) -> Matrix3<f64> {
    Matrix3::new(s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2])
}

/// The six components 11 22 33 12 23 31 of a symmetric matrix.
pub fn components(s: &Matrix3<f64>) -> [f64; 6] {
    [s.m11, s.m22, s.m33, s.m12, s.m23, s.m31]
}

/// Q s Qᵀ of a symmetric tensor s, 11 22 33 12 23 31.
#[inline(always)]
pub(crate) fn turned<R: Real>(q: &Matrix<R>, s: &[R; 6]) -> [R; 6] {
    let moved = product(q, &columns(s));
    let (a, b) = (transposed(&moved), transposed(q));
    [dot(a[0], b[0]), dot(a[1], b[1]), dot(a[2], b[2]), dot(a[0], b[1]), dot(a[1], b[2]), dot(a[2], b[0])]
}

/// The first Piola–Kirchhoff stress P = JσF⁻ᵀ of a Cauchy stress 11 22 33 12 23 31: force per reference area.
pub fn first_piola_kirchhoff(cauchy: &[f64; 6], f: &Matrix3<f64>) -> Matrix3<f64> {
    // J F⁻ᵀ is the matrix of cofactors, which exists for every F.
    matrix(cauchy) * Matrix3::from(cofactors(&f.data.0).1)
}

/// The second Piola–Kirchhoff stress S = JF⁻¹σF⁻ᵀ of a Cauchy stress, both 11 22 33 12 23 31; F by columns. A stress of
/// 0 stays 0 whatever F is.
#[inline(always)]
pub(crate) fn second_piola_kirchhoff(cauchy: &[f64; 6], f: &Matrix<f64>) -> [f64; 6] {
    if cauchy.iter().all(|&x| x == 0.0) {
        return [0.0; 6];
    }
    let (jacobian, minors) = cofactors(f);
    let [[s11, s21, s31], [_, s22, s32], [_, _, s33]] =
        scaled(1.0 / jacobian, &product(&transposed(&minors), &product(&columns(cauchy), &minors)));
    [s11, s22, s33, s21, s32, s31]
}

/// The eigenvalues of a symmetric tensor 11 22 33 12 23 31, in no particular order, and an orthonormal axis for each,
/// by Jacobi rotations.
pub fn principal_axes(s: &[f64; 6]) -> ([f64; 3], [[f64; 3]; 3]) {
    let [mut a, mut b, mut c, mut ab, mut bc, mut ca] = *s;
    let [mut x, mut y, mut z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    // One Jacobi rotation: makes the entry `pq` zero, and changes the entries `pr` and `qr` with the third axis and the
    // axes `u` and `v`.
    type Axis = [f64; 3];
    let rotate = |p: &mut f64, q: &mut f64, pq: &mut f64, pr: &mut f64, qr: &mut f64, u: &mut Axis, v: &mut Axis| {
        if *pq == 0.0 {
            return;
        }
        let theta = (*q - *p) / (2.0 * *pq);
        let root = libm::sqrt(theta * theta + 1.0);
        let t = if theta < 0.0 { -1.0 / (root - theta) } else { 1.0 / (root + theta) };
        let cosine = 1.0 / libm::sqrt(t * t + 1.0);
        let sine = t * cosine;
        *p -= t * *pq;
        *q += t * *pq;
        *pq = 0.0;
        let turn = |x: &mut f64, y: &mut f64| (*x, *y) = (cosine * *x - sine * *y, sine * *x + cosine * *y);
        turn(pr, qr);
        for (x, y) in u.iter_mut().zip(v) {
            turn(x, y);
        }
    };
    // Convergence is quadratic: after six sweeps any 3×3 matrix is diagonal to rounding.
    for _ in 0..6 {
        rotate(&mut a, &mut b, &mut ab, &mut ca, &mut bc, &mut x, &mut y);
        rotate(&mut b, &mut c, &mut bc, &mut ab, &mut ca, &mut y, &mut z);
        rotate(&mut c, &mut a, &mut ca, &mut bc, &mut ab, &mut z, &mut x);
    }
    ([a, b, c], [x, y, z])
}

/// The largest eigenvalue of a symmetric tensor 11 22 33 12 23 31, to within a few roundings of its norm.
///
/// The eigenvalue farthest from the other two is a simple root of the characteristic equation even if those two
/// coincide, and its axis is a column of the matrix of cofactors; the tensor in the plane across that axis gives the
/// other two, however near to each other they are (after Scherzinger and Dohrmann, Comput. Methods Appl. Mech. Engrg.
/// 197, 2008).
#[inline(always)]
pub(crate) fn largest_principal<R: Real>(s: &[R; 6]) -> R {
    let (half, least) = (R::splat(0.5), R::splat(R::MIN_POSITIVE));
    let size = s[0].abs().max(s[1].abs()).max(s[2].abs()).max(s[3].abs()).max(s[4].abs()).max(s[5].abs());
    let size = size.max(least);
    let over_size = size.reciprocal();
    // The deviator over p = √(J2/3): its eigenvalues are 2 cos φ, with cos 3φ half its determinant.
    let mean = (s[0] + s[1] + s[2]) * over_size * R::splat(1.0 / 3.0);
    let [a, b, c] = [s[0].mul_add(over_size, -mean), s[1].mul_add(over_size, -mean), s[2].mul_add(over_size, -mean)];
    let [d, e, f] = [s[3] * over_size, s[4] * over_size, s[5] * over_size];
    let square = R::splat(1.0 / 6.0) * dot([a, b, c], [a, b, c]) + R::splat(1.0 / 3.0) * dot([d, e, f], [d, e, f]);
    let p = square.max(least).sqrt();
    let scaling = p.reciprocal();
    let [a, b, c, d, e, f] = [a * scaling, b * scaling, c * scaling, d * scaling, e * scaling, f * scaling];
    let apart = apart(half * dot([a, d, f], cross([d, b, e], [f, e, c])));
    let (u, v, w) = ([a - apart, d, f], [d, b - apart, e], [f, e, c - apart]);
    let n = unit(longer(longer(cross(v, w), cross(w, u)), cross(u, v)));
    let alone = dot(n, image(&columns(s), n));
    // Without its component along that axis and its mean in the plane across it, the deviator has the eigenvalues 0 and
    // ± half the distance between the other two.
    let (drop, middle) = (R::splat(-1.5) * apart, half * apart);
    let along = [drop * n[0], drop * n[1], drop * n[2]];
    let diagonal =
        [along[0].mul_add(n[0], a + middle), along[1].mul_add(n[1], b + middle), along[2].mul_add(n[2], c + middle)];
    let shear = [along[0].mul_add(n[1], d), along[1].mul_add(n[2], e), along[2].mul_add(n[0], f)];
    let gap = half.mul_add(dot(diagonal, diagonal), dot(shear, shear)).sqrt();
    alone.max(p.mul_add(gap - middle, mean) * size)
}

/// The longer of two vectors.
#[inline(always)]
fn longer<R: Real>(u: [R; 3], v: [R; 3]) -> [R; 3] {
    select(dot(v, v).le(dot(u, u)), u, v)
}

/// The solution x of x³ − 3x = 2r for |r| ≤ 1 that is farthest from the other two.
#[inline(always)]
fn apart<R: Real>(r: R) -> R {
    const ROOT: f64 = 1.732_050_807_568_877_2;
    let [one, two, three] = [R::splat(1.0), R::splat(2.0), R::splat(3.0)];
    let size = r.abs().min(one);
    // Newton's method. Its start is linear in |r|, from the solution √3 at r = 0 to the solution 2 at |r| = 1.
    let mut x = R::splat(2.0 - ROOT).mul_add(size, R::splat(ROOT));
    for _ in 0..3 {
        let square = x * x;
        x = x - (square - three).mul_add(x, -two * size) * (three * (square - one)).reciprocal();
    }
    R::select(r.lt(R::splat(0.0)), -x, x)
}

/// An entry of ½ 1⊙σ.
#[inline(always)]
fn half_with_one<R: Real, const ROW: usize, const COLUMN: usize>(stress: &[R; 6]) -> R {
    paired_with_one::<R, ROW, COLUMN>(stress).map_or(R::splat(0.0), |entry| R::splat(0.5) * entry)
}

/// The Truesdell modulus c − ½ 1⊙σ, from the Jaumann modulus c and the Cauchy stress σ; 11 22 33 12 23 31, engineering
/// shears.
pub fn truesdell_of_jaumann(jaumann: &[[f64; 6]; 6], cauchy: &[f64; 6]) -> [[f64; 6]; 6] {
    let mut truesdell = *jaumann;
    let stress = Moduli(upper_triangle!(half_with_one(cauchy))).matrix();
    for (entry, stress) in truesdell.iter_mut().flatten().zip(stress.iter().flatten()) {
        *entry -= stress;
    }
    truesdell
}

/// dS/dE, from the Truesdell modulus of the Cauchy stress: J times its pull-back by F⁻¹ on all four indices; `None` if
/// F has no inverse.
pub fn pulled_back(truesdell: &[[f64; 6]; 6], f: &Matrix3<f64>) -> Option<[[f64; 6]; 6]> {
    let inverse = f.try_inverse()?;
    // The 6×6 matrix T of the pull-back of a symmetric tensor, in which an off-diagonal component stands for two
    // entries. The result is J T c Tᵀ.
    let mut t = [[0.0; 6]; 6];
    for (row, (a, b)) in t.iter_mut().zip(PAIRS) {
        for (entry, (i, j)) in row.iter_mut().zip(PAIRS) {
            let one = inverse[(a, i)] * inverse[(b, j)];
            *entry = if i == j { one } else { one + inverse[(a, j)] * inverse[(b, i)] };
        }
    }
    let jacobian = f.determinant();
    let mut material = [[0.0; 6]; 6];
    for (row, left) in material.iter_mut().zip(&t) {
        // A row of T c.
        let mut moved = [0.0; 6];
        for (moduli, x) in truesdell.iter().zip(left) {
            moved.iter_mut().zip(moduli).for_each(|(entry, modulus)| *entry += x * modulus);
        }
        for (entry, right) in row.iter_mut().zip(&t) {
            *entry = jacobian * moved.iter().zip(right).map(|(x, y)| x * y).sum::<f64>();
        }
    }
    Some(material)
}
