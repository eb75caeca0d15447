//! Symmetric tensors as six components, 11 22 33 12 23 31, and symmetric 6×6 matrices on them.

use super::number::real::Real;
use super::number::vector::Matrix;

/// The two tensor indices of each of the six components 11 22 33 12 23 31.
pub const PAIRS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)];
/// The component of two tensor indices: the inverse of [`PAIRS`].
pub const VOIGT: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];

/// The symmetric tensor as columns.
#[inline(always)]
pub(crate) fn columns<R: Real>(s: &[R; 6]) -> Matrix<R> {
    [[s[0], s[3], s[5]], [s[3], s[1], s[4]], [s[5], s[4], s[2]]]
}

/// s a⊗a, 11 22 33 12 23 31.
#[inline(always)]
pub(crate) fn square<R: Real>(s: R, a: [R; 3]) -> [R; 6] {
    let [x, y, z] = [s * a[0], s * a[1], s * a[2]];
    [x * a[0], y * a[1], z * a[2], x * a[1], y * a[2], z * a[0]]
}

/// s times the symmetric part of a⊗b, 11 22 33 12 23 31.
#[inline(always)]
pub(crate) fn symmetric_product<R: Real>(s: R, a: [R; 3], b: [R; 3]) -> [R; 6] {
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

/// The sum of two tensors of six components.
#[inline(always)]
pub(crate) fn sum<R: Real>(a: [R; 6], b: [R; 6]) -> [R; 6] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3], a[4] + b[4], a[5] + b[5]]
}

/// a A.
#[inline(always)]
pub(super) fn multiple<R: Real>(a: R, x: &[R; 6]) -> [R; 6] {
    [a * x[0], a * x[1], a * x[2], a * x[3], a * x[4], a * x[5]]
}

/// a A + b B.
#[inline(always)]
pub(super) fn combination<R: Real>(a: R, x: &[R; 6], b: R, y: &[R; 6]) -> [R; 6] {
    [
        a.mul_add(x[0], b * y[0]),
        a.mul_add(x[1], b * y[1]),
        a.mul_add(x[2], b * y[2]),
        a.mul_add(x[3], b * y[3]),
        a.mul_add(x[4], b * y[4]),
        a.mul_add(x[5], b * y[5]),
    ]
}

/// A + b B.
#[inline(always)]
pub(super) fn added<R: Real>(x: &[R; 6], b: R, y: &[R; 6]) -> [R; 6] {
    [
        b.mul_add(y[0], x[0]),
        b.mul_add(y[1], x[1]),
        b.mul_add(y[2], x[2]),
        b.mul_add(y[3], x[3]),
        b.mul_add(y[4], x[4]),
        b.mul_add(y[5], x[5]),
    ]
}

/// A symmetric 6×6 matrix: its upper triangle, row by row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moduli<R>(pub [R; 21]);

impl<R: Copy> Moduli<R> {
    /// The full matrix.
    #[inline(always)]
    pub fn matrix(&self) -> [[R; 6]; 6] {
        let c = &self.0;
        [
            [c[0], c[1], c[2], c[3], c[4], c[5]],
            [c[1], c[6], c[7], c[8], c[9], c[10]],
            [c[2], c[7], c[11], c[12], c[13], c[14]],
            [c[3], c[8], c[12], c[15], c[16], c[17]],
            [c[4], c[9], c[13], c[16], c[18], c[19]],
            [c[5], c[10], c[14], c[17], c[19], c[20]],
        ]
    }
}

impl<R> AsMut<[R]> for Moduli<R> {
    #[inline(always)]
    fn as_mut(&mut self) -> &mut [R] {
        &mut self.0
    }
}

/// Calls `entry::<_, ROW, COLUMN>` for each entry of the upper triangle, row by row, so that the compiler knows its row
/// and column.
macro_rules! upper_triangle {
    ($entry:ident($($argument:expr),*)) => {
        [
            $entry::<_, 0, 0>($($argument),*), $entry::<_, 0, 1>($($argument),*), $entry::<_, 0, 2>($($argument),*),
            $entry::<_, 0, 3>($($argument),*), $entry::<_, 0, 4>($($argument),*), $entry::<_, 0, 5>($($argument),*),
            $entry::<_, 1, 1>($($argument),*), $entry::<_, 1, 2>($($argument),*), $entry::<_, 1, 3>($($argument),*),
            $entry::<_, 1, 4>($($argument),*), $entry::<_, 1, 5>($($argument),*), $entry::<_, 2, 2>($($argument),*),
            $entry::<_, 2, 3>($($argument),*), $entry::<_, 2, 4>($($argument),*), $entry::<_, 2, 5>($($argument),*),
            $entry::<_, 3, 3>($($argument),*), $entry::<_, 3, 4>($($argument),*), $entry::<_, 3, 5>($($argument),*),
            $entry::<_, 4, 4>($($argument),*), $entry::<_, 4, 5>($($argument),*), $entry::<_, 5, 5>($($argument),*),
        ]
    };
}

pub(super) use upper_triangle;

/// An entry of 1⊙Z with X⊙Z = X_ik Z_jl + X_il Z_jk + X_jk Z_il + X_jl Z_ik; `None` for an entry that is 0 whatever Z
/// is.
#[inline(always)]
pub(super) fn paired_with_one<R: Real, const ROW: usize, const COLUMN: usize>(b: &[R; 6]) -> Option<R> {
    let ((i, j), (k, l)) = (PAIRS[ROW], PAIRS[COLUMN]);
    if ROW == COLUMN {
        return Some(if ROW < 3 { R::splat(4.0) * b[ROW] } else { b[VOIGT[i][i]] + b[VOIGT[j][j]] });
    }
    if ROW < 3 {
        // i = j: the entry is 0 unless i is one of the two indices of the column.
        return if COLUMN >= 3 && (k == i || l == i) { Some(b[COLUMN] + b[COLUMN]) } else { None };
    }
    // Two different pairs of unequal indices have one index in common; the entry is the component of the other two.
    Some(
        b[if i == k {
            VOIGT[j][l]
        } else if i == l {
            VOIGT[j][k]
        } else if j == k {
            VOIGT[i][l]
        } else {
            VOIGT[i][k]
        }],
    )
}
