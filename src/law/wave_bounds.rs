//! Bounds of wave speeds by direction: the fast wave runs along the fibre, where elements are long.
//!
//! ρ0 c² ≤ A (m·n)² + B for every wave of direction n, with the fibre's direction m. By modes, as the law's own bound
//! is derived (`docs/design/law.md`): the elongation is k_el (m·n)² at most, and the others, with the section's
//! area ratio J_t and its distortion a = 2 I_td,
//!
//! - compaction: W″/4 + |W′|. |W′| is the sum of the Kirchhoff stresses across, and W″ = (p − 1) |W′|/|I_tc| is no more
//!   than (p − 1) |W′| from |I_tc| = 1 on, where |W′| is p k_tc, and less than (p − 1) p k_tc before;
//! - distortion: ¼ k_td ((a/sinh a) eᵃ + a) ≤ ¾ k_td cosh a;
//! - distortion that friction limits to I_te, a = 2 I_te: a eᵃ/sinh a ≤ 1 + 2 a, so that this is ¼ k_td (1 + 3 a) at
//!   most, and a ≤ 4 (µ p_t + c)/k_td, p_t = ½ |W′|: ¼ k_td + 3 (µ ½ |W′| + c); where the fibres slide, the pressure
//!   that grows adds µ W″/4;
//! - longitudinal shear: (k_ld/λ²)(2 J_t eᵃ + 4 |P b e|).
//!
//! Roots of x are replaced by (1 + x)/2, no less. Of the linear elastic law, which has no Poisson's ratios, A is E1,
//! and B the other moduli and twice the largest stress, which the spin of its frame takes along. This needs the first
//! axis to be the fibre's, which axes that turn otherwise leave.

use core::ops::{Add, Div, Mul, Sub};

use super::hyperelastic;
use super::linear_elastic::{self, Rotation};

/// Numbers that bounds are computed in: one point's, or those of several points side by side.
pub trait Arithmetic: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> {
    /// The same number for each point.
    fn constant(value: f64) -> Self;

    /// The larger ones of both.
    fn larger(self, other: Self) -> Self;
}

impl Arithmetic for f64 {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
}

/// What the bounds are made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WaveBounds {
    /// One bound for all directions: the law's own.
    Isotropic,
    /// Of a yarn law, by the stiffnesses of its modes.
    Hyperelastic {
        k_el: f64,
        k_tc: f64,
        p: f64,
        k_td: f64,
        k_ld: f64,
        /// µ and c, of a law whose distortion is limited by them.
        friction: Option<[f64; 2]>,
    },
    /// Of moduli ρ0 c² along and across the fibre.
    LinearElastic { along: f64, across: f64 },
}

/// A deformation and its stress, as far as the bounds need them.
pub struct Deformed<N> {
    /// The columns of F in axes of which the first is the fibre's.
    pub columns: [[N; 3]; 3],
    /// The Cauchy stress: xx yy zz xy yz zx.
    pub stress: [N; 6],
    /// J, and λ² of the fibre.
    pub volume_ratio: N,
    pub stretch_square: N,
    /// c22 and c33 of the section: the squares of the second and third column without what they have along the fibre.
    pub section: [N; 2],
}

impl WaveBounds {
    /// By direction where that is known: a compaction with p below 2 is infinitely stiff at first.
    pub fn hyperelastic(properties: &hyperelastic::Properties<f64>) -> WaveBounds {
        let hyperelastic::Properties { k_el, k_tc, p, k_td, k_ld, .. } = *properties;
        let friction = None;
        if p >= 2.0 { WaveBounds::Hyperelastic { k_el, k_tc, p, k_td, k_ld, friction } } else { WaveBounds::Isotropic }
    }

    /// The same with friction between the fibres.
    pub fn frictional(properties: &hyperelastic::Properties<f64>, mu: f64, cohesion: f64) -> WaveBounds {
        match Self::hyperelastic(properties) {
            WaveBounds::Hyperelastic { k_el, k_tc, p, k_td, k_ld, .. } => {
                WaveBounds::Hyperelastic { k_el, k_tc, p, k_td, k_ld, friction: Some([mu, cohesion]) }
            }
            other => other,
        }
    }

    /// By direction where the first axis stays the fibre's.
    pub fn linear_elastic(properties: &linear_elastic::Properties<f64>, frame: Rotation) -> WaveBounds {
        let linear_elastic::Properties { e_1, e_2, g, .. } = *properties;
        match frame {
            Rotation::Fibre => WaveBounds::LinearElastic { along: e_1, across: e_2 + 2.0 * g },
            _ => WaveBounds::Isotropic,
        }
    }

    /// A and B; `None` where there is one bound.
    #[inline(always)]
    pub fn at<N: Arithmetic>(&self, point: &Deformed<N>) -> Option<[N; 2]> {
        let (constant, half, one, two) = (N::constant, N::constant(0.5), N::constant(1.0), N::constant(2.0));
        let Deformed { columns: [u, v, w], stress, volume_ratio: ratio, .. } = *point;
        match *self {
            WaveBounds::Isotropic => None,
            WaveBounds::Hyperelastic { k_el, k_tc, p, k_td, k_ld, friction } => {
                let per_square = one / point.stretch_square;
                let along = dot(u, times(stress, u)) * per_square;
                let slope = size(ratio * (stress[0] + stress[1] + stress[2] - along));
                let curvature = constant(0.25 * (p - 1.0)) * slope.larger(constant(p * k_tc));
                let compaction = curvature + slope;
                let [c22, c33] = point.section;
                // cosh a = (c22 + c33)/(2 J_t), J_t² = J²/λ².
                let area_square = ratio * ratio * per_square;
                let mean = half * (c22 + c33);
                let cosh = half * (one + mean * mean / area_square);
                let distortion = match friction {
                    None => constant(0.75 * k_td) * cosh,
                    Some([mu, cohesion]) => {
                        constant(0.25 * k_td + 3.0 * cohesion) + constant(1.5 * mu) * slope + constant(mu) * curvature
                    }
                };
                let mut across = compaction + distortion;
                if k_ld > 0.0 {
                    let (h2, h3) = (dot(u, v), dot(u, w));
                    let slant = (h2 * h2 + h3 * h3) * per_square;
                    let area = half * (one + area_square);
                    let coupling = (one + c22 + c33) * (constant(0.2) + constant(5.0) * slant);
                    across = across + constant(k_ld) * per_square * (constant(4.0) * area * cosh + coupling);
                }
                Some([constant(k_el), across])
            }
            WaveBounds::LinearElastic { along, across } => {
                let row = |a: usize, b: usize, c: usize| size(stress[a]) + size(stress[b]) + size(stress[c]);
                let largest = row(0, 3, 5).larger(row(3, 1, 4)).larger(row(5, 4, 2));
                let j = ratio.larger(one);
                Some([constant(along) * j, j * (constant(across) + two * largest)])
            }
        }
    }
}

#[inline(always)]
fn dot<N: Arithmetic>(a: [N; 3], b: [N; 3]) -> N {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A stress times a vector.
#[inline(always)]
fn times<N: Arithmetic>([xx, yy, zz, xy, yz, zx]: [N; 6], v: [N; 3]) -> [N; 3] {
    [dot([xx, xy, zx], v), dot([xy, yy, yz], v), dot([zx, yz, zz], v)]
}

#[inline(always)]
fn size<N: Arithmetic>(value: N) -> N {
    value.larger(N::constant(0.0) - value)
}
