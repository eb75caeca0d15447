//! Bounds of stiffness by direction: the fast wave runs along the fibre, where elements are long.
//!
//! With the fibre's direction m, P across it, and h_t the symmetric part of P h P, no gradient h of the velocity meets
//! more stiffness ρ0 c² than
//!
//! ```text
//! A (m·h m)² + G |P h m|² + C (tr h_t)² + 2 D |dev h_t|² + I |h|²
//! ```
//!
//! Its terms belong to what stretches the fibre, what turns it, what compacts the section, what distorts it, and what
//! has no direction. No term but the last has both motions along the fibre and across it. A wave across the fibre, h =
//! u ⊗ n, meets C + D + I at most. `docs/design/law.md` derives them for waves; that they hold for any h is tested where
//! elements use them. By modes, with the section's area ratio J_t and its distortion a = 2 I_td:
//!
//! - elongation: A = k_el, and G is the tension, k_el ln λ ≤ k_el (λ² − 1)/2. A slack fibre has neither; it is tense
//!   again when it is as long as at rest, where the gradient h of the same motion is λ times what it is now: until then
//!   a step need not be shorter than k_el λ² allows;
//! - compaction: W″/4 + |W′|. |W′| is the sum of the Kirchhoff stresses across, and W″ = (p − 1) |W′|/|I_tc| is no more
//!   than (p − 1) |W′| from |I_tc| = 1 on, where |W′| is p k_tc, and less than (p − 1) p k_tc before. C is
//!   W″/4;
//! - distortion: ¼ k_td ((a/sinh a) eᵃ + a) ≤ ¼ k_td (1 + 3 a), of which 2 a are the stress's, and a² ≤ 2 (cosh a − 1);
//! - distortion that friction limits to I_te, a = 2 I_te: a ≤ 4 (µ p_t + c)/k_td, p_t = ½ |W′|: ¼ k_td + 3 (µ ½ |W′| +
//!   c); where the fibres slide, the pressure that grows adds µ W″/4, half of it to C and half to D;
//! - longitudinal shear: (k_ld/λ²)(2 J_t eᵃ + 4 |P b e|), without direction.
//!
//! Of the linear elastic law, which has no Poisson's ratios, A and G are E1, and I the other moduli and twice the
//! largest stress, which the spin of its frame takes along. This needs the first axis to be the fibre's, which axes that
//! turn otherwise leave.

use core::ops::{Add, Div, Mul, Sub};

use super::hyperelastic;
use super::linear_elastic::{self, Rotation};
use super::number::real::Real;

/// Numbers that bounds are computed in: one point's, or those of several points side by side.
pub trait Arithmetic: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> {
    /// The same number for each point.
    fn constant(value: f64) -> Self;

    /// The larger ones of both.
    fn larger(self, other: Self) -> Self;

    /// The square root of what is not negative.
    fn root(self) -> Self;
}

/// The bounds A, G, C, D and I at a deformation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stiffness<N> {
    pub elongation: N,
    /// The part of A that a slack fibre meets when it is tense again, λ²; 1 where none is slack.
    pub returning: N,
    pub tension: N,
    pub compaction: N,
    pub distortion: N,
    pub all_round: N,
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

    #[inline(always)]
    fn root(self) -> Self {
        Real::sqrt(self)
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

    /// At a deformation; `None` where there is one bound.
    #[inline(always)]
    pub fn at<N: Arithmetic>(&self, point: &Deformed<N>) -> Option<Stiffness<N>> {
        let (constant, zero, one) = (N::constant, N::constant(0.0), N::constant(1.0));
        let Deformed { columns: [u, v, w], stress, volume_ratio: ratio, stretch_square, .. } = *point;
        match *self {
            WaveBounds::Isotropic => None,
            WaveBounds::Hyperelastic { k_el, k_tc, p, k_td, k_ld, friction } => {
                let per_square = one / stretch_square;
                let along = dot(u, times(stress, u)) * per_square;
                let slope = size(ratio * (stress[0] + stress[1] + stress[2] - along));
                let curvature = constant(0.25 * (p - 1.0)) * slope.larger(constant(p * k_tc));
                let [c22, c33] = point.section;
                let area_square = ratio * ratio * per_square;
                let area = area_square.root();
                // cosh a = (c22 + c33)/(2 J_t), J_t² = J²/λ².
                let cosh = (constant(0.5) * (c22 + c33) / area).larger(one);
                let distorted = (constant(2.0) * (cosh - one)).root();
                let [compaction, distortion, stressed] = match friction {
                    None => {
                        [curvature, constant(0.25 * k_td) * (one + distorted), slope + constant(0.5 * k_td) * distorted]
                    }
                    Some([mu, cohesion]) => [
                        curvature + constant(0.5 * mu) * curvature,
                        constant(0.25 * k_td + cohesion) + constant(0.5 * mu) * (slope + curvature),
                        slope + constant(2.0 * cohesion) + constant(mu) * slope,
                    ],
                };
                let mut all_round = stressed;
                if k_ld > 0.0 {
                    let (h2, h3) = (dot(u, v), dot(u, w));
                    let slant = (h2 * h2 + h3 * h3) * per_square;
                    let exponential = cosh + (cosh * cosh - one).root();
                    let coupling = ((c22 + c33) * slant).root();
                    let twice = area * exponential + constant(2.0) * coupling;
                    all_round = all_round + constant(2.0 * k_ld) * per_square * twice;
                }
                let tension = constant(0.5 * k_el) * (stretch_square - one).larger(zero);
                let returning = one - (one - stretch_square).larger(zero);
                let elongation = constant(k_el);
                Some(Stiffness { elongation, returning, tension, compaction, distortion, all_round })
            }
            WaveBounds::LinearElastic { along, across } => {
                let row = |a: usize, b: usize, c: usize| size(stress[a]) + size(stress[b]) + size(stress[c]);
                let largest = row(0, 3, 5).larger(row(3, 1, 4)).larger(row(5, 4, 2));
                let j = ratio.larger(one);
                let all_round = j * (constant(across) + constant(2.0) * largest);
                let along = constant(along) * j;
                Some(Stiffness {
                    elongation: along,
                    returning: one,
                    tension: along,
                    compaction: zero,
                    distortion: zero,
                    all_round,
                })
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
