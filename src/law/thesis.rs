//! The law as the thesis states it, in its order and its letters (P. del Sorbo, ENSAM 2019, section 4.3 and 4.4.2): to
//! be read first.
//!
//! Nothing of the library calls it. It is written for any number type, without regard to speed or to rounding: the
//! tests hold the library's stress against it in 320 binary digits, the benchmark in double precision, where its
//! cancellations show. [`hyperelastic`](super::hyperelastic) has the form that is computed, `kinematics` why it does
//! not cancel.

use nalgebra::{ClosedAddAssign, ClosedDivAssign, ClosedMulAssign, ClosedSubAssign, Matrix3, Scalar, Vector3};
use num_traits::{One, Zero};

use super::hyperelastic::Properties;

/// A number type that a field of matrices can be made of.
pub trait Number:
    Scalar + Zero + One + PartialOrd + ClosedAddAssign + ClosedSubAssign + ClosedMulAssign + ClosedDivAssign
{
}

impl<N> Number for N where
    N: Scalar + Zero + One + PartialOrd + ClosedAddAssign + ClosedSubAssign + ClosedMulAssign + ClosedDivAssign
{
}

/// The elementary functions of a number type, and its numbers.
#[derive(Clone, Copy, Debug)]
pub struct Functions<N> {
    /// The number of a double.
    pub number: fn(f64) -> N,
    /// The square root.
    pub sqrt: fn(N) -> N,
    /// The natural logarithm.
    pub ln: fn(N) -> N,
    /// The inverse of the hyperbolic cosine.
    pub acosh: fn(N) -> N,
    /// `power(x, p)` = x^p for x > 0.
    pub power: fn(N, N) -> N,
}

/// A yarn of the thesis.
#[derive(Clone, Copy, Debug)]
pub struct Yarn<N> {
    /// The fibre of these properties has unit length here.
    pub properties: Properties<N>,
    /// Those of `N`.
    pub functions: Functions<N>,
}

/// I1 = tr C, I3 = det C, I4 = m·C m, I5 = m·C² m.
fn invariants_of<N: Number>(c: &Matrix3<N>, m: &Vector3<N>) -> [N; 4] {
    let cm = c * m;
    [c.trace(), determinant(c), m.dot(&cm), cm.dot(&cm)]
}

impl<N: Number> Yarn<N> {
    fn n(&self, x: f64) -> N {
        (self.functions.number)(x)
    }

    fn m(&self) -> Vector3<N> {
        Vector3::from(self.properties.fibre.clone())
    }

    /// I_el, I_tc, I_td and I_ld, the four deformation modes (Eq. 4.9), of C = FᵀF.
    pub fn modes(&self, c: &Matrix3<N>) -> [N; 4] {
        let Functions { sqrt, ln, acosh, .. } = self.functions;
        let [i1, i3, i4, i5] = invariants_of(c, &self.m());
        let x = (i1 * i4.clone() - i5.clone()) / (self.n(2.0) * sqrt(i3.clone() * i4.clone()));
        let slip = i5 / (i4.clone() * i4.clone()) - N::one();
        // Both are at least 1 and 0, which the last digit may deny at rest.
        let (x, slip) = (if x < N::one() { N::one() } else { x }, if slip < N::zero() { N::zero() } else { slip });
        [self.n(0.5) * ln(i4.clone()), self.n(0.25) * ln(i3 / i4), self.n(0.5) * acosh(x), sqrt(slip)]
    }

    /// W_el (Eq. 4.11), W_tc (4.12), W_td (4.13) and W_ld, which the thesis has 0 (4.15); their sum is W (4.10), per
    /// reference volume.
    pub fn energies(&self, [i_el, i_tc, i_td, i_ld]: [N; 4]) -> [N; 4] {
        let Properties { k_el, k_tc, p, k_td, k_ld, .. } = self.properties.clone();
        let half_square = |k: N, i: N| self.n(0.5) * k * i.clone() * i;
        [
            if i_el > N::zero() { half_square(k_el, i_el) } else { N::zero() },
            if i_tc < N::zero() { k_tc * (self.functions.power)(N::zero() - i_tc, p) } else { N::zero() },
            half_square(k_td, i_td),
            half_square(k_ld, i_ld),
        ]
    }

    /// S_el, S_tc, S_td and S_ld, the parts of the second Piola–Kirchhoff stress S = 2 ∂W/∂C (Eq. 4.6 and 4.14).
    ///
    /// S_td is 0/0 where the section is undistorted; it is 0 here where its root is.
    pub fn stresses(&self, c: &Matrix3<N>, [i_el, i_tc, i_td, _]: [N; 4]) -> [Matrix3<N>; 4] {
        let Properties { k_el, k_tc, p, k_td, k_ld, .. } = self.properties.clone();
        let [two, half] = [2.0, 0.5].map(|x| self.n(x));
        let m = self.m();
        let [i1, i3, i4, i5] = invariants_of(c, &m);
        let cm = c * &m;
        let mm = &m * m.transpose();
        let cm_mc = &cm * m.transpose() + &m * cm.transpose();
        let inverse = cofactors(c) / i3.clone();

        let nothing = Matrix3::zeros();
        let el = if i_el > N::zero() { &mm * (k_el * i_el / i4.clone()) } else { nothing.clone() };
        let tc = if i_tc < N::zero() {
            let slope = p.clone() * k_tc * (self.functions.power)(N::zero() - i_tc, p - N::one());
            (&mm / i4.clone() - &inverse) * (half * slope)
        } else {
            nothing.clone()
        };
        let q = i1.clone() * i4.clone() - i5.clone();
        let root = q.clone() * q.clone() - self.n(4.0) * i3 * i4.clone();
        let td = if root > N::zero() {
            let bracket = Matrix3::identity() * (two.clone() * i4.clone()) - inverse * q
                + &mm * (i1 + i5.clone() / i4.clone())
                - &cm_mc * two.clone();
            bracket * (two.clone() * k_td * i_td / (self.n(4.0) * (self.functions.sqrt)(root)))
        } else {
            nothing
        };
        let i4_square = i4.clone() * i4.clone();
        let ld = (cm_mc / i4_square.clone() - mm * (two * i5 / (i4_square * i4))) * k_ld;
        [el, tc, td, ld]
    }

    /// σ = F S Fᵀ/det F.
    pub fn cauchy(&self, f: &Matrix3<N>) -> Matrix3<N> {
        let c = f.transpose() * f;
        let [el, tc, td, ld] = self.stresses(&c, self.modes(&c));
        f * (el + tc + td + ld) * f.transpose() / determinant(f)
    }

    /// The failure index: the yarn fails where it reaches 1. I_lim = ln(1 + ε_lim) for one mode (UF), less what
    /// compaction and distortion take of it for several (MF); ε_lim = 0 is a yarn that does not fail (section 4.4.2).
    pub fn failure_index(&self, [i_el, i_tc, i_td, _]: [N; 4]) -> N {
        let Properties { eps_lim, alpha, beta, .. } = self.properties.clone();
        if i_el <= N::zero() || eps_lim <= N::zero() {
            return N::zero();
        }
        let compaction = if i_tc < N::zero() { N::zero() - i_tc } else { N::zero() };
        i_el / (self.functions.ln)(N::one() + eps_lim) + alpha * compaction + beta * i_td
    }
}

/// The determinant.
pub fn determinant<N: Number>(a: &Matrix3<N>) -> N {
    a.row(0).transpose().dot(&cofactors(a).column(0))
}

/// The transposed matrix of the cofactors: the inverse times the determinant.
fn cofactors<N: Number>(a: &Matrix3<N>) -> Matrix3<N> {
    Matrix3::from_fn(|i, j| {
        let entry = |k: usize, l: usize| a[((j + k) % 3, (i + l) % 3)].clone();
        entry(1, 1) * entry(2, 2) - entry(1, 2) * entry(2, 1)
    })
}
