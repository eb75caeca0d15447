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
//! not a branch.

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

/// What the law needs to know of a deformation gradient.
#[derive(Clone, Copy, Debug)]
pub struct Deformation<R> {
    /// Current fibre direction and two axes across it, as vectors in space.
    pub e: [R; 3],
    pub q1: [R; 3],
    pub q2: [R; 3],
    /// The upper triangle of R: see the module's text.
    pub lambda: R,
    pub f_a: R,
    pub f_b: R,
    pub r11: R,
    pub r12: R,
    pub r22: R,
    /// det F, its reciprocal, and the area ratio J_t = J/λ.
    pub jacobian: R,
    pub inverse_jacobian: R,
    pub area_ratio: R,
    /// Elongation, compaction, distortion and longitudinal-shear invariant (Eq. 4.9).
    pub invariants: [R; 4],
    /// The deviator of B/J_t on (q1, q2), its magnitude s, asinh s = 2 I_td, asinh s/s, and x = √(1 + s²) = cosh 2 I_td.
    pub d1: R,
    pub d2: R,
    pub s: R,
    pub asinh_s: R,
    pub asinh_ratio: R,
    pub cosh: R,
}

impl<R: Real> Deformation<R> {
    /// The deformation of `f` (columns of F) seen from the material frame `n`.
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
        let off_diagonal = dot([f[0][1], f[0][2], f[1][2]], [f[0][1], f[0][2], f[1][2]])
            + dot([f[1][0], f[2][0], f[2][1]], [f[1][0], f[2][0], f[2][1]]);
        let near = (dot(h, h) + off_diagonal).lt(R::splat(NEAR_REFERENCE));
        let sigma = R::select(near, one, zero);

        // g_i = (F − σ1) n_i, c_i = F n_i.
        let diagonal = [R::select(near, h[0], f[0][0]), R::select(near, h[1], f[1][1]), R::select(near, h[2], f[2][2])];
        let columns =
            [[diagonal[0], f[0][1], f[0][2]], [f[1][0], diagonal[1], f[1][2]], [f[2][0], f[2][1], diagonal[2]]];
        let (g1, g2, g3) = (image(&columns, n.m), image(&columns, n.t1), image(&columns, n.t2));
        let (c1, c2, c3) = (along(g1, sigma, n.m), along(g2, sigma, n.t1), along(g3, sigma, n.t2));

        // Along the fibre.
        let u11 = dot(g1, along(c1, sigma, n.m));
        let stretch_square = sigma + u11;
        let lambda = stretch_square.sqrt();
        let [inverse_lambda, inverse_jacobian] = reciprocals([lambda, jacobian]);
        let e = scale(inverse_lambda, c1);

        // Longitudinal shear.
        let f_a = sigma.mul_add(dot(n.t1, g1), dot(c1, g2)) * inverse_lambda;
        let f_b = sigma.mul_add(dot(n.t2, g1), dot(c1, g3)) * inverse_lambda;
        let i_ld = f_a.mul_add(f_a, f_b * f_b).sqrt() * inverse_lambda;

        // Across the fibre: x_ij = a_i·a_j − σ δ_ij for the images a_i of the transverse axes less their part along e.
        let a = along(c2, -f_a, e);
        let b = along(c3, -f_b, e);
        let (twice_1, twice_2) = (along(c2, sigma, n.t1), along(c3, sigma, n.t2));
        let x22 = R::select(near, dot(g2, twice_1) - f_a * f_a, dot(a, a));
        let x33 = R::select(near, dot(g3, twice_2) - f_b * f_b, dot(b, b));
        let x23 = R::select(near, dot(c2, g3) + dot(n.t2, g2) - f_a * f_b, dot(a, b));
        let r11_square = sigma + x22;
        let r11 = r11_square.sqrt();
        let inverse_r11 = one / r11;
        let area_ratio = jacobian * inverse_lambda;
        let inverse_area = lambda * inverse_jacobian;
        let r12 = x23 * inverse_r11;
        let r22 = area_ratio * inverse_r11;

        // Compaction: ¼ ln det X near the reference, ½ ln J_t away from it.
        let growth = x22 + x33 + x22.mul_add(x33, -(x23 * x23));
        let area_square = R::select(near, one + growth, area_ratio * area_ratio);

        // Distortion.
        let d1 = half.mul_add(x22 - x33, r12 * r12) * inverse_area;
        let d2 = r12 * inverse_r11;
        let s = d1.mul_add(d1, d2 * d2).sqrt();

        // Two logarithms and an inverse hyperbolic sine share one division. Near the reference 1 + u has lost digits of u
        // that the logarithm needs: they follow as a correction.
        let (elongation, compaction, distortion) =
            (Logarithm::new(stretch_square), Logarithm::new(area_square), Asinh::new(s));
        let [a_1, a_2] = distortion.denominators();
        let [over_el, over_tc, over_1, over_2] =
            reciprocals([elongation.denominator(), compaction.denominator(), a_1, a_2]);
        let lost_el = u11 - (stretch_square - sigma);
        let lost_tc = R::select(near, growth - (area_square - one), zero);
        let i_el = half * elongation.finish(over_el, lost_el * inverse_lambda * inverse_lambda);
        let i_tc = R::splat(0.25) * compaction.finish(over_tc, lost_tc * inverse_area * inverse_area);
        let (asinh_s, asinh_ratio) = distortion.finish([over_1, over_2]);

        let q1 = scale(inverse_r11, a);
        let q2 = cross(e, q1);
        Deformation {
            e,
            q1,
            q2,
            lambda,
            f_a,
            f_b,
            r11,
            r12,
            r22,
            jacobian,
            inverse_jacobian,
            area_ratio,
            invariants: [i_el, i_tc, half * asinh_s, i_ld],
            d1,
            d2,
            s,
            asinh_s,
            asinh_ratio,
            cosh: distortion.cosh(),
        }
    }
}
