//! Bounds of wave speeds by direction: the fast wave runs along the fibre, where elements are long.
//!
//! ρ0 c² ≤ A (m·n)² + B for every wave of direction n, with the fibre's direction m. By modes, as the law's own bound is derived
//! (`docs/reference/theory.md`): the elongation is k_el (m·n)² at most, and the others, with the section's area ratio J_t and its distortion
//! a = 2 I_td,
//!
//! - compaction: W″/4 + |W′|. |W′| is the sum of the Kirchhoff stresses across, and W″ = (p − 1) |W′|/|I_tc| is no more than
//!   (p − 1) |W′| from |I_tc| = 1 on, where |W′| is p k_tc, and less than (p − 1) p k_tc before;
//! - distortion: ¼ k_td ((a/sinh a) eᵃ + a) ≤ ¾ k_td cosh a;
//! - longitudinal shear: (k_ld/λ²)(2 J_t eᵃ + 4 |P b e|).
//!
//! Roots of x are replaced by (1 + x)/2, no less. Of the linear elastic law, which has no Poisson's ratios, A is E1, and B the other moduli
//! and twice the largest stress, which the spin of its frame takes along. This needs the first axis to be the fibre's, which axes that
//! turn otherwise leave.

use super::lanes::{LANES, Lanes, Number, dot, load, times};
use crate::material::model::{Law, Material};
use toron::Rotation;
use toron::law::{hyperelastic, linear_elastic};

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
    /// By direction where that is known for a material: a compaction with p below 2 is infinitely stiff at first, and the
    /// first axis of the linear law may leave the fibre.
    pub fn of(material: &Material) -> WaveBounds {
        match material.law {
            Law::Hyperelastic { properties: hyperelastic::Properties { k_el, k_tc, p, k_td, k_ld, .. }, .. }
                if p >= 2.0 =>
            {
                WaveBounds::Hyperelastic { k_el, k_tc, p, k_td, k_ld }
            }
            Law::LinearElastic {
                frame: Rotation::Fibre,
                properties: linear_elastic::Properties { e_1, e_2, g, .. },
                ..
            } => WaveBounds::LinearElastic { along: e_1, across: e_2 + 2.0 * g },
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

#[cfg(test)]
mod tests {
    use fastrand::Rng;
    use nalgebra::{Matrix3, Vector3};

    use super::*;
    use crate::explicit::element::{Measures, Shapes};
    use toron::Criterion;
    use toron::law::parameters;

    fn material(preset: &str, k_ld: f64) -> Material {
        turning(preset, k_ld, Rotation::Fibre)
    }

    fn turning(preset: &str, k_ld: f64, rotation: Rotation) -> Material {
        let preset = parameters::preset(preset).expect("it exists");
        let mut values = preset.values.to_vec();
        for (value, property) in values.iter_mut().zip(preset.table()) {
            match property.name {
                "k_ld" => *value = k_ld,
                "eps_lim" | "sigma_lim" | "alpha" | "beta" => *value = 0.0,
                _ => {}
            }
        }
        let law = Law::new(preset.law.into(), &values, rotation, Criterion::LargestPrincipal).expect("valid");
        Material { law, density: Some(preset.density), label: String::new(), own: String::new() }
    }

    /// A and B at a deformation gradient with this stress.
    fn bounds(material: &Material, f: &Matrix3<f64>, stress: &[f64; 6]) -> [f64; 2] {
        let nodes: Vec<[f64; 3]> = (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from)).collect();
        let shapes = Shapes::<f64>::new(&[std::array::from_fn(|i| i as u32)], &[], &nodes, 0.0);
        let mut measures = Measures::new(shapes.stride);
        let repeat = |values: &[f64]| values.iter().flat_map(|&value| vec![value; shapes.stride]).collect::<Vec<_>>();
        let (f, stress) = (repeat(f.as_slice()), repeat(stress));
        shapes.measure(&f, &mut measures);
        let Measures { volume_ratio, stretch_square, metric, .. } = &measures;
        let section = Section { volume_ratio, stretch_square, metric };
        WaveBounds::of(material)
            .at(&f, &stress, &section, shapes.stride, 0)
            .expect("by direction")
            .map(|lanes| lanes.0[0])
    }

    /// No rate of deformation h, a wave's u ⊗ n or another one, meets more stiffness than A |h m|² + B |h|². Returns how near one
    /// came.
    fn check(material: &Material, spread: f64) -> f64 {
        let mut random = Rng::with_seed(7);
        let mut nearest: f64 = 0.0;
        for _ in 0..2000 {
            let mut number = |size: f64| size * (2.0 * random.f64() - 1.0);
            let mut f = Matrix3::from_fn(|_, _| number(spread));
            f += Matrix3::from_diagonal(&[1.0, 1.0 - 0.5 * spread, 1.0 - 0.5 * spread].into());
            // Along the fibre yarns stretch by some percent.
            let stretch = (1.0 + number(0.06)) / f.column(0).norm();
            f.column_mut(0).scale_mut(stretch);
            let Ok((stress, tangent)) = material.tangent(&f, &material.at_rest()) else { continue };
            let [along, across] = bounds(material, &f, &stress);
            let m = f.column(0).normalize();
            for general in [true, false] {
                let h = if general {
                    Matrix3::from_fn(|_, _| number(1.0))
                } else {
                    let [u, n] = [0, 1].map(|_| Vector3::from_fn(|_, _| number(1.0)).normalize());
                    u * n.transpose()
                };
                let step = nalgebra::SVector::<f64, 9>::from_column_slice((h * f).as_slice());
                let stiffness = step.dot(&(tangent * step));
                let bound = along * (h * m).norm_squared() + across * h.norm_squared();
                assert!(stiffness < bound, "{stiffness:e} {bound:e} {f} {h}");
                nearest = nearest.max(stiffness / bound);
            }
        }
        nearest
    }

    #[test]
    fn no_wave_of_the_hyperelastic_law_is_faster() {
        for k_ld in [0.0, 126e6] {
            for spread in [0.02, 0.3, 0.6] {
                assert!(check(&material("kevlar-km2-600", k_ld), spread) > 0.5);
            }
        }
    }

    #[test]
    fn no_wave_of_the_linear_elastic_law_is_faster() {
        for spread in [0.02, 0.2] {
            assert!(check(&material("kevlar-km2-600-linear", 0.0), spread) > 0.5);
        }
    }

    #[test]
    fn axes_that_leave_the_fibre_have_one_bound() {
        let preset = "kevlar-km2-600-linear";
        for rotation in [Rotation::Polar, Rotation::Spin] {
            assert_eq!(WaveBounds::of(&turning(preset, 0.0, rotation)), WaveBounds::Isotropic);
        }
        assert_ne!(WaveBounds::of(&turning(preset, 0.0, Rotation::Fibre)), WaveBounds::Isotropic);
    }
}
