//! The laws' bounds of stiffness by direction, of neighbouring elements at once.

use super::lanes::{Lanes, Number, load};
use toron::law::parameters::HYPERELASTIC_PROPERTIES;
use toron::law::wave_bounds::{Arithmetic, Deformed, Stiffness, WaveBounds};
use toron_materials::material::model::{Law, Material};

/// The measures of F that the bounds need, beside F: J, λ², and the section's metric.
pub struct Section<'a, T> {
    pub volume_ratio: &'a [T],
    pub stretch_square: &'a [T],
    pub metric: &'a [T],
}

/// By direction where that is known for a material.
pub fn wave_bounds(material: &Material) -> WaveBounds {
    match &material.law {
        Law::Hyperelastic { properties, .. } => WaveBounds::hyperelastic(properties),
        Law::LinearElastic { properties, frame, .. } => WaveBounds::linear_elastic(properties, *frame),
        Law::Own(own) => match (material.law.yarn(), own.values.get(HYPERELASTIC_PROPERTIES..)) {
            (Some(yarn), Some(&[mu, cohesion])) => WaveBounds::frictional(&yarn, mu, cohesion),
            _ => WaveBounds::Isotropic,
        },
    }
}

/// The bounds of elements from `first` on; where they do not know directions, all is `own`, the law's own bound of ρ0
/// c².
///
/// Bounds by friction's limit hold for whatever distortion the limit allows: with a large cohesion they are far above
/// the law's own, of the distortion that is there, which holds for every direction.
#[inline(always)]
pub fn bounds_at<T: Number>(
    bounds: &WaveBounds,
    own: Lanes<T>,
    f: &[T],
    stress: &[T],
    section: &Section<T>,
    stride: usize,
    first: usize,
) -> Stiffness<Lanes<T>> {
    let (zero, one) = (Lanes::zero(), Lanes::constant(1.0));
    let isotropic = Stiffness {
        elongation: zero,
        returning: one,
        tension: zero,
        compaction: zero,
        distortion: zero,
        all_round: own,
    };
    if *bounds == WaveBounds::Isotropic {
        return isotropic;
    }
    let [f0, f1, f2, f3, f4, f5, f6, f7, f8] = load(f, stride, first);
    let [c22, c33, _] = load(section.metric, stride, first);
    let found = bounds.at(&Deformed {
        columns: [[f0, f1, f2], [f3, f4, f5], [f6, f7, f8]],
        stress: load(stress, stride, first),
        volume_ratio: Lanes::at(section.volume_ratio, first),
        stretch_square: Lanes::at(section.stretch_square, first),
        section: [c22, c33],
    });
    let Some(found) = found else { return isotropic };
    let WaveBounds::Hyperelastic { friction: Some(_), .. } = bounds else { return found };
    let all_round = found.all_round.min(own);
    let (rest, half) = (own - all_round, Lanes::constant(0.5));
    Stiffness {
        elongation: found.elongation.min(rest),
        returning: found.returning,
        tension: found.tension.min(rest),
        compaction: found.compaction.min(rest),
        distortion: found.distortion.min(half * rest),
        all_round,
    }
}

impl<T: Number> Arithmetic for Lanes<T> {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Lanes::constant(value)
    }

    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        self.max(other)
    }

    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }
}

#[cfg(test)]
mod tests {
    use fastrand::Rng;
    use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

    use super::*;
    use crate::element::{Measures, Shapes};
    use toron::law::parameters;
    use toron::{Criterion, Request, Rotation};
    use toron_materials::material::model::Origin;

    fn material(preset: &str, k_ld: f64) -> Material {
        turning(preset, &[("k_ld", k_ld)], Rotation::Fibre)
    }

    fn turning(preset: &str, own: &[(&str, f64)], rotation: Rotation) -> Material {
        let preset = parameters::preset(preset).expect("it exists");
        let mut values = preset.values.to_vec();
        assert!(own.iter().all(|(name, _)| preset.table().iter().any(|property| property.name == *name)), "{own:?}");
        for (value, property) in values.iter_mut().zip(preset.table()) {
            match own.iter().find(|(name, _)| *name == property.name) {
                Some((_, own)) => *value = *own,
                None if ["eps_lim", "sigma_lim", "alpha", "beta"].contains(&property.name) => *value = 0.0,
                None => {}
            }
        }
        let law = Law::new(preset.into(), &values, rotation, Criterion::LargestPrincipal).expect("valid");
        Material {
            law,
            density: Some(preset.density),
            label: String::new(),
            own: String::new(),
            origin: Origin::default(),
            temperature: None,
        }
    }

    /// The bounds at a deformation gradient with this stress and this bound of the law's own.
    fn bounds(material: &Material, own: f64, f: &Matrix3<f64>, stress: &[f64; 6]) -> Stiffness<f64> {
        let nodes: Vec<[f64; 3]> = (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from)).collect();
        let shapes = Shapes::<f64>::new(&[std::array::from_fn(|i| i as u32)], &[], &nodes, 0.0);
        let mut measures = Measures::new(shapes.stride);
        let repeat = |values: &[f64]| values.iter().flat_map(|&value| vec![value; shapes.stride]).collect::<Vec<_>>();
        let (f, stress) = (repeat(f.as_slice()), repeat(stress));
        shapes.measure(&f, &mut measures);
        let Measures { volume_ratio, stretch_square, metric, .. } = &measures;
        let section = Section { volume_ratio, stretch_square, metric };
        let found = bounds_at(&wave_bounds(material), Lanes::splat(own), &f, &stress, &section, shapes.stride, 0);
        let Stiffness { elongation, returning, tension, compaction, distortion, all_round } = found;
        let [elongation, returning, tension, compaction, distortion, all_round] =
            [elongation, returning, tension, compaction, distortion, all_round].map(|lanes| lanes.0[0]);
        Stiffness { elongation, returning, tension, compaction, distortion, all_round }
    }

    /// No rate of deformation h, a wave's u ⊗ n or another one, meets more stiffness than A (m·h m)² + G |P h m|² + C (tr
    /// h_t)² + 2 D |dev h_t|² + I |h|². Returns how near one came.
    fn check(material: &Material, spread: f64) -> f64 {
        let mut random = Rng::with_seed(7);
        let mut nearest: f64 = 0.0;
        for trial in 0..2000 {
            let mut number = |size: f64| size * (2.0 * random.f64() - 1.0);
            let mut f = Matrix3::from_fn(|_, _| number(spread));
            f += Matrix3::from_diagonal(&[1.0, 1.0 - 0.5 * spread, 1.0 - 0.5 * spread].into());
            // Along the fibre yarns stretch by some percent; slack ones shorten without end.
            let stretch = if trial % 4 == 0 { 0.6 + number(0.4) } else { 1.0 + number(0.06) };
            let to = stretch / f.column(0).norm();
            f.column_mut(0).scale_mut(to);
            let Ok((stress, tangent)) = material.tangent(&f, 0.0, &material.at_rest()) else { continue };
            let request = Request { wave_modulus: true, ..Request::default() };
            let Ok(answer) = material.evaluate(&f, 0.0, &material.at_rest(), request) else { continue };
            let bound = bounds(material, answer.wave_modulus, &f, &stress);
            if let WaveBounds::Hyperelastic { friction: Some(_), .. } = wave_bounds(material) {
                let most = answer.wave_modulus * (1.0 + 1e-12);
                let Stiffness { elongation, tension, compaction, distortion, all_round, .. } = bound;
                assert!(
                    [elongation, tension, compaction, 2.0 * distortion].iter().all(|part| part + all_round <= most),
                    "{bound:?} {most:e}"
                );
            }
            let m = f.column(0).normalize();
            let across = Matrix3::identity() - m * m.transpose();
            let of_section = |h: &Matrix3<f64>| {
                let part = 0.5 * across * (h + h.transpose()) * across;
                let trace = part.trace();
                (trace, part - 0.5 * trace * across)
            };
            let most = |h: &Matrix3<f64>, other: &Matrix3<f64>| {
                let [(trace, dev), (other_trace, other_dev)] = [h, other].map(of_section);
                bound.returning * bound.elongation * m.dot(&(h * m)) * m.dot(&(other * m))
                    + bound.tension * (across * h * m).dot(&(other * m))
                    + bound.compaction * trace * other_trace
                    + 2.0 * bound.distortion * dev.dot(&other_dev)
                    + bound.all_round * h.dot(other)
            };
            let met = |h: &Matrix3<f64>, other: &Matrix3<f64>| {
                let [step, other] = [h, other].map(|h| SVector::<f64, 9>::from_column_slice((h * f).as_slice()));
                0.5 * (step.dot(&(tangent * other)) + other.dot(&(tangent * step)))
            };
            let unit = |c: usize| Matrix3::from_fn(|i, j| if i + 3 * j == c { 1.0 } else { 0.0 });
            let left = SMatrix::<f64, 9, 9>::from_fn(|i, j| {
                let (h, other) = (unit(i), unit(j));
                most(&h, &other) - met(&h, &other)
            });
            let least = left.symmetric_eigenvalues().min();
            assert!(least > -1e-9 * bound.elongation.max(bound.all_round), "{least:e} {bound:?} {f}");
            for general in [true, false] {
                let h = if general {
                    Matrix3::from_fn(|_, _| number(1.0))
                } else {
                    let [u, n] = [0, 1].map(|_| Vector3::from_fn(|_, _| number(1.0)).normalize());
                    u * n.transpose()
                };
                nearest = nearest.max(met(&h, &h) / most(&h, &h));
            }
        }
        nearest
    }

    #[test]
    fn nothing_of_the_hyperelastic_law_is_stiffer() {
        for k_ld in [0.0, 126e6] {
            for spread in [0.02, 0.3, 0.6] {
                assert!(check(&material("kevlar-km2-600", k_ld), spread) > 0.5);
            }
        }
    }

    /// The same motion of the nodes has a gradient 1/λ times that at rest, and meets what a tense fibre would there.
    #[test]
    fn a_slack_fibre_meets_what_it_does_when_it_is_tense_again() {
        let material = material("kevlar-km2-600", 0.0);
        let met = |stretch: f64| {
            let f = Matrix3::from_diagonal(&[stretch, 1.1, 1.0].into());
            let Stiffness { elongation, returning, .. } = bounds(&material, 1e12, &f, &[0.0; 6]);
            returning * elongation / (stretch * stretch)
        };
        let tense = met(1.0);
        assert!(tense > 1e10 && met(1.05) < tense, "{tense:e}");
        for stretch in [0.05, 0.5, 0.99] {
            assert!((met(stretch) / tense - 1.0).abs() < 1e-12, "{stretch}");
        }
    }

    #[test]
    fn nothing_of_the_law_with_friction_is_stiffer() {
        for k_ld in [0.0, 126e6] {
            for spread in [0.02, 0.3, 0.6] {
                assert!(check(&material("kevlar-km2-600-frictional", k_ld), spread) > 0.5);
            }
        }
    }

    #[test]
    fn a_cohesion_without_end_does_not_raise_the_bounds() {
        let sticky = |c| turning("kevlar-km2-600-frictional", &[("k_ld", 0.0), ("cohesion", c)], Rotation::Fibre);
        let f = Matrix3::from_diagonal(&[1.01, 0.9, 1.0].into());
        let across = [1e12, 1e15].map(|c| {
            let material = sticky(c);
            assert!(check(&material, 0.3) > 0.5);
            let answer = material.evaluate(&f, 0.0, &material.at_rest(), Request::ALL).expect("valid");
            bounds(&material, answer.wave_modulus, &f, &answer.cauchy)
        });
        assert_eq!(across[0], across[1]);
    }

    #[test]
    fn nothing_of_the_linear_elastic_law_is_stiffer() {
        for spread in [0.02, 0.2] {
            assert!(check(&turning("kevlar-km2-600-linear", &[], Rotation::Fibre), spread) > 0.5);
        }
    }

    #[test]
    fn axes_that_leave_the_fibre_have_one_bound() {
        let preset = "kevlar-km2-600-linear";
        for rotation in [Rotation::Polar, Rotation::Spin] {
            assert_eq!(wave_bounds(&turning(preset, &[], rotation)), WaveBounds::Isotropic);
        }
        assert_ne!(wave_bounds(&turning(preset, &[], Rotation::Fibre)), WaveBounds::Isotropic);
    }
}
