//! From the deformation gradient to the four deformation modes and to what the stress needs of them, stably.
//!
//! With N = (m, t1, t2) the fibre and any two transverse axes, F N = Q R: Q = (e, q1, q2) holds the current fibre
//! direction and two axes across it, R is upper triangular (thesis, Eq. 4.7),
//!
//! ```text
//!     ⎡ λ  f_a  f_b ⎤    λ         fibre stretch            I_el = ln λ
//! R = ⎢ 0  r11  r12 ⎥    f_a, f_b  longitudinal shear       I_ld = √(f_a² + f_b²)/λ
//!     ⎣ 0   0   r22 ⎦    J_t = r11 r22  area ratio          I_tc = ½ ln J_t
//! ```
//!
//! and the deviator of B = P F Fᵀ P over J_t has the components (d1, d2; d2, −d1) on (q1, q2), with
//! √(d1² + d2²) = s = sinh 2 I_td. No inverse, no eigenvector, no quotient 0/0.
//!
//! Near the reference the strains are differences of nearly equal numbers. There H = F − 1 is exact, and C − 1 follows
//! from it without cancellation; far from it the sums over F itself round best. Both are the same formula,
//! C_ij = σ δ_ij + g_i·g_j + σ (n_i·g_j + n_j·g_i) with g_i = (F − σ1) n_i, for σ = 1 and σ = 0: the choice is a number,
//! not a branch. The images of the transverse axes less their parts along e are a = σ t1 + δ2 and b = σ t2 + δ3 with
//! δ2 = g_2 − f_a e, δ3 = g_3 − f_b e, and a·a − σ = δ2·(a + σ t1).
//!
//! The work comes in two stages, algebra ([`Decomposition`]) and logarithms ([`Strain`]), which a block runs one after the
//! other over several points: either has a chain of operations short enough for the processor to overlap points.

use super::elementary::{Asinh, Logarithm, reciprocals};
use super::real::{Real, accurate_cross, along, cross, dot, image, scale};

/// F − 1 counts as small where the sum of its squared entries is below this: every diagonal entry of F is then above ½,
/// so that H is exact, and no singular value of F is below 0.6.
const NEAR_REFERENCE: f64 = 0.16;

/// The material frame: the fibre direction and two axes across it, orthonormal, right-handed.
#[derive(Clone, Copy, Debug)]
pub struct FibreFrame<R> {
    pub m: [R; 3],
    pub t1: [R; 3],
    pub t2: [R; 3],
}

impl<R: Real> FibreFrame<R> {
    /// The frame of a fibre direction of any length, and where that direction is usable: finite and not zero.
    #[inline(always)]
    pub fn new(direction: [R; 3]) -> (Self, R::Mask) {
        let (zero, one) = (R::splat(0.0), R::splat(1.0));
        let largest = direction[0].abs().max(direction[1].abs()).max(direction[2].abs());
        // Lengths whose square would leave the range of the number are brought near to one first.
        let ordinary = R::splat(1e-15).lt(largest) & largest.lt(R::splat(1e15));
        let scaling = R::select(ordinary, one, one / largest);
        let direction = scale(scaling, direction);
        let square = dot(direction, direction);
        let usable = zero.lt(square) & square.lt(R::splat(1e31));
        let length = R::select(usable, square, one).sqrt();
        let m = [direction[0] / length, direction[1] / length, direction[2] / length];
        // Two axes across m, without a branch and without a loss where m points along −z (Duff et al., J. Comput.
        // Graph. Tech. 6(1), 2017).
        let sign = R::select(m[2].lt(zero), -one, one);
        let a = -(one / (sign + m[2]));
        let b = m[0] * m[1] * a;
        let t1 = [one + sign * m[0] * m[0] * a, sign * b, -(sign * m[0])];
        let t2 = [b, sign + m[1] * m[1] * a, -m[1]];
        (FibreFrame { m, t1, t2 }, usable)
    }
}

/// The algebra of a deformation gradient: F N = Q R, and what the logarithms are taken of.
#[derive(Clone, Copy, Debug)]
pub struct Decomposition<R> {
    /// Current fibre direction and first axis across it, as vectors in space; the second one is [`q2`](Self::q2).
    pub e: [R; 3],
    pub q1: [R; 3],
    /// The upper triangle of R, see the module's text, and 1/λ.
    pub lambda: R,
    pub inverse_lambda: R,
    pub f_a: R,
    pub f_b: R,
    pub r11: R,
    pub r12: R,
    pub r22: R,
    /// det F, its reciprocal, and the area ratio J_t = J/λ.
    pub jacobian: R,
    pub inverse_jacobian: R,
    pub area_ratio: R,
    /// The deviator of B/J_t on (q1, q2): (d1, d2; d2, −d1).
    pub d1: R,
    pub d2: R,
    /// λ² and J_t², and what rounding took from them, relative to them.
    stretch_square: R,
    stretch_lost: R,
    area_square: R,
    area_lost: R,
    /// 0 where every entry of F is finite, else NaN.
    pub finite: R,
}

impl<R: Real> Decomposition<R> {
    /// The decomposition of `f` (columns of F) in the material frame `n`.
    ///
    /// Meaningful where F is finite, det F > 0 and the fibre's image is not zero; other points give NaN or infinities
    /// and must be masked out by the caller.
    #[inline(always)]
    pub fn new(f: &[[R; 3]; 3], n: &FibreFrame<R>) -> Self {
        let (zero, one, half) = (R::splat(0.0), R::splat(1.0), R::splat(0.5));

        // With accurate minors the determinant is as good as the entries of F allow; otherwise a sheared and compacted
        // section loses most of its digits here.
        let jacobian = dot(f[0], accurate_cross(f[1], f[2]));

        let h = [f[0][0] - one, f[1][1] - one, f[2][2] - one];
        let size = dot(h, h)
            + (dot([f[0][1], f[0][2], f[1][2]], [f[0][1], f[0][2], f[1][2]])
                + dot([f[1][0], f[2][0], f[2][1]], [f[1][0], f[2][0], f[2][1]]));
        let near = size.lt(R::splat(NEAR_REFERENCE));
        let sigma = R::select(near, one, zero);

        // A number times zero is zero unless it is NaN or infinite.
        let mut finite = zero;
        for column in f {
            for &entry in column {
                finite = entry.mul_add(zero, finite);
            }
        }

        // g_i = (F − σ1) n_i.
        let columns = [
            [R::select(near, h[0], f[0][0]), f[0][1], f[0][2]],
            [f[1][0], R::select(near, h[1], f[1][1]), f[1][2]],
            [f[2][0], f[2][1], R::select(near, h[2], f[2][2])],
        ];
        let (g1, g2, g3) = (image(&columns, n.m), image(&columns, n.t1), image(&columns, n.t2));

        // Along the fibre.
        let c1 = along(g1, sigma, n.m);
        let u11 = dot(g1, along(c1, sigma, n.m));
        let stretch_square = sigma + u11;
        let lambda = stretch_square.sqrt();
        let (inverse_lambda, inverse_jacobian) = (one / lambda, one / jacobian);
        let e = scale(inverse_lambda, c1);

        // Longitudinal shear.
        let f_a = sigma.mul_add(dot(n.t1, g1), dot(c1, g2)) * inverse_lambda;
        let f_b = sigma.mul_add(dot(n.t2, g1), dot(c1, g3)) * inverse_lambda;

        // Across the fibre: x_ij = a_i·a_j − σ δ_ij for a_1 = a, a_2 = b.
        let (delta_2, delta_3) = (along(g2, -f_a, e), along(g3, -f_b, e));
        let a = along(delta_2, sigma, n.t1);
        let x22 = dot(delta_2, along(a, sigma, n.t1));
        let x33 = dot(delta_3, along(delta_3, sigma + sigma, n.t2));
        let x23 = sigma.mul_add(dot(n.t2, delta_2), dot(a, delta_3));
        let r11 = (sigma + x22).sqrt();
        let inverse_r11 = one / r11;
        let area_ratio = jacobian * inverse_lambda;
        let inverse_area = lambda * inverse_jacobian;
        let r12 = x23 * inverse_r11;

        // J_t² = det X near the reference, where its distance from 1 holds more digits than J.
        let growth = x22 + x33 + x22.mul_add(x33, -(x23 * x23));
        let area_square = R::select(near, one + growth, area_ratio * area_ratio);

        Decomposition {
            e,
            q1: scale(inverse_r11, a),
            lambda,
            inverse_lambda,
            f_a,
            f_b,
            r11,
            r12,
            r22: area_ratio * inverse_r11,
            jacobian,
            inverse_jacobian,
            area_ratio,
            d1: half.mul_add(x22 - x33, r12 * r12) * inverse_area,
            d2: r12 * inverse_r11,
            stretch_square,
            stretch_lost: (u11 - (stretch_square - sigma)) * inverse_lambda * inverse_lambda,
            area_square,
            area_lost: R::select(near, growth - (area_square - one), zero) * inverse_area * inverse_area,
            finite,
        }
    }

    /// The second axis across the fibre.
    #[inline(always)]
    pub fn q2(&self) -> [R; 3] {
        cross(self.e, self.q1)
    }

    /// F⁻¹e, F⁻¹q1, F⁻¹q2, by the triangle R: no inverse of F.
    #[inline(always)]
    pub fn pulled_back(&self, n: &FibreFrame<R>) -> [[R; 3]; 3] {
        let one = R::splat(1.0);
        let (inverse_11, inverse_22) = (one / self.r11, one / self.r22);
        let w1 = scale(self.inverse_lambda, n.m);
        let w2 = scale(inverse_11, along(n.t1, -(self.f_a * self.inverse_lambda), n.m));
        let w3 = scale(inverse_22, along(along(n.t2, -(self.f_b * self.inverse_lambda), n.m), -self.r12, w2));
        [w1, w2, w3]
    }

    /// The longitudinal-shear invariant I_ld, the only one that needs no logarithm.
    #[inline(always)]
    pub fn shear_invariant(&self) -> R {
        self.f_a.mul_add(self.f_a, self.f_b * self.f_b).sqrt() * self.inverse_lambda
    }
}

/// What the logarithms of a decomposition give.
#[derive(Clone, Copy, Debug)]
pub struct Strain<R> {
    /// Elongation, compaction and distortion invariant (Eq. 4.9).
    pub i_el: R,
    pub i_tc: R,
    pub i_td: R,
    /// a/s and cosh a for a = asinh s = 2 I_td, s² = d1² + d2².
    pub asinh_ratio: R,
    pub cosh: R,
    pub s: R,
}

impl<R: Real> Strain<R> {
    /// Two logarithms and an inverse hyperbolic sine, which share one division.
    #[inline(always)]
    pub fn new(d: &Decomposition<R>) -> Self {
        let s = d.d1.mul_add(d.d1, d.d2 * d.d2).sqrt();
        let (elongation, compaction, distortion) =
            (Logarithm::new(d.stretch_square), Logarithm::new(d.area_square), Asinh::new(s));
        let [a_1, a_2] = distortion.denominators();
        let [over_el, over_tc, over_1, over_2] =
            reciprocals([elongation.denominator(), compaction.denominator(), a_1, a_2]);
        let (asinh_s, asinh_ratio) = distortion.finish([over_1, over_2]);
        let half = R::splat(0.5);
        Strain {
            i_el: half * elongation.finish(over_el, d.stretch_lost),
            i_tc: R::splat(0.25) * compaction.finish(over_tc, d.area_lost),
            i_td: half * asinh_s,
            asinh_ratio,
            cosh: distortion.cosh(),
            s,
        }
    }
}
