//! Bounds of wave speeds by direction: the fast wave runs along the fibre, where elements are long.
//!
//! ρ0 c² ≤ A (m·n)² + B for every wave of direction n, with the fibre's direction m. By modes, as the law's own bound is derived
//! (`docs/theory.md`): the elongation is k_el (m·n)² at most, and the others, with the section's area ratio J_t and its distortion
//! a = 2 I_td,
//!
//! - compaction: W″/4 + |W′|. |W′| is the sum of the Kirchhoff stresses across, and W″ = (p − 1) |W′|/|I_tc| is no more than
//!   (p − 1) |W′| from |I_tc| = 1 on, where |W′| is p k_tc, and less than (p − 1) p k_tc before;
//! - distortion: ¼ k_td ((a/sinh a) eᵃ + a) ≤ ¾ k_td cosh a;
//! - longitudinal shear: (k_ld/λ²)(2 J_t eᵃ + 4 |P b e|).
//!
//! Roots of x are replaced by (1 + x)/2, no less. Of the linear elastic law without Poisson's ratios A is E1, and B the other moduli
//! and twice the largest stress, which the spin of its frame takes along.

#![expect(clippy::needless_range_loop, reason = "what is inlined for certain: see Lanes")]

use super::lanes::{LANES, Lanes, Number, dot, load, times};
use crate::material::model::{Law, Material};

/// What the bounds are made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WaveBounds {
    /// One bound for all directions: the law's own.
    Isotropic,
    Hyperelastic {
        k_el: f64,
        k_tc: f64,
        p: f64,
        k_td: f64,
        k_ld: f64,
    },
    LinearElastic {
        along: f64,
        across: f64,
    },
}

/// The measures of F that the bounds need, beside F: J, λ², and the section's metric.
pub struct Section<'a, T> {
    pub volume_ratio: &'a [T],
    pub stretch_square: &'a [T],
    pub metric: &'a [T],
}

impl WaveBounds {
    /// By direction where that is known for a material: a compaction with p below 2 is infinitely stiff at first.
    pub fn of(material: &Material) -> WaveBounds {
        let property = |name: &str| material.property(name).unwrap_or_default();
        match &material.law {
            Law::Hyperelastic(_) if property("p") >= 2.0 => WaveBounds::Hyperelastic {
                k_el: property("k_el"),
                k_tc: property("k_tc"),
                p: property("p"),
                k_td: property("k_td"),
                k_ld: property("k_ld"),
            },
            Law::LinearElastic { .. } if ["nu_12", "nu_23"].iter().all(|name| property(name) == 0.0) => {
                WaveBounds::LinearElastic { along: property("e_1"), across: property("e_2") + 2.0 * property("g") }
            }
            _ => WaveBounds::Isotropic,
        }
    }

    /// A and B of elements from `first` on; `None` where there is one bound.
    #[inline(always)]
    pub fn at<T: Number>(
        &self,
        f: &[T],
        stress: &[T],
        section: &Section<T>,
        stride: usize,
        first: usize,
    ) -> Option<[Lanes<T>; 2]> {
        let constant = Lanes::constant;
        let (half, one, two) = (constant(0.5), constant(1.0), constant(2.0));
        let stress: [Lanes<T>; 6] = load(stress, stride, first);
        let ratio = Lanes::at(section.volume_ratio, first);
        match *self {
            WaveBounds::Isotropic => None,
            WaveBounds::Hyperelastic { k_el, k_tc, p, k_td, k_ld } => {
                let [f0, f1, f2, f3, f4, f5, f6, f7, f8] = load(f, stride, first);
                let (u, v, w) = ([f0, f1, f2], [f3, f4, f5], [f6, f7, f8]);
                let per_square = one / Lanes::at(section.stretch_square, first);
                let along = dot(u, times(&stress, u)) * per_square;
                let slope = size(ratio * (stress[0] + stress[1] + stress[2] - along));
                let compaction = constant(0.25 * (p - 1.0)) * slope.max(constant(p * k_tc)) + slope;
                let [c22, c33, _] = load(section.metric, stride, first);
                // cosh a = (c22 + c33)/(2 J_t), J_t² = J²/λ².
                let area_square = ratio * ratio * per_square;
                let mean = half * (c22 + c33);
                let cosh = half * (one + mean * mean / area_square);
                let distortion = constant(0.75 * k_td) * cosh;
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
                let mut largest = Lanes::zero();
                for row in [[0, 3, 5], [3, 1, 4], [5, 4, 2]] {
                    largest = largest.max(size(stress[row[0]]) + size(stress[row[1]]) + size(stress[row[2]]));
                }
                let j = ratio.max(one);
                Some([constant(along) * j, j * (constant(across) + two * largest)])
            }
        }
    }
}

#[inline(always)]
fn size<T: Number>(mut value: Lanes<T>) -> Lanes<T> {
    for l in 0..LANES {
        value.0[l] = if value.0[l] < T::default() { -value.0[l] } else { value.0[l] };
    }
    value
}
