//! The points that speed is measured on: random states of a yarn under impact, in a solver's arrays.

use fastrand::Rng;
use nalgebra::{Matrix3, Rotation3, Vector3};

use crate::entries::aligned::{Aligned, LINE};
use crate::entries::hosts::OnePoint;
use toron::Level;
use toron::Measure;
use toron::Real;
use toron::law::block::{Arrays, Precision};

/// A leading dimension that is a multiple of this (4096 bytes) would put all columns in the same lines of the cache.
const PAGE: usize = 512;

/// Points twice: in component-major arrays, laid out as [`block`](toron::law::block) says, and one after the other, for
/// what is called point by point. The fibre is the first axis.
#[derive(Debug)]
pub struct Scene<T> {
    pub n: usize,
    pub leading_dimension: usize,
    pub deformation_gradient: Aligned<T>,
    pub stress: Aligned<T>,
    pub energies: Aligned<T>,
    pub invariants: Aligned<T>,
    pub failure: Aligned<T>,
    pub status: Aligned<i32>,
    pub points: Vec<OnePoint<T>>,
}

impl<T: Precision> Scene<T> {
    /// `n` points with these deformation gradients, in turn; the state is a fresh one.
    pub fn new(n: usize, deformation_gradients: impl Iterator<Item = Matrix3<f64>>) -> Self {
        let full = n.next_multiple_of(LINE);
        let leading_dimension = if full.is_multiple_of(PAGE) { full + LINE } else { full };
        Scene::with_leading_dimension(n, leading_dimension, deformation_gradients)
    }

    /// The same with a leading dimension of one's own, at least `n`.
    pub fn with_leading_dimension(
        n: usize,
        leading_dimension: usize,
        deformation_gradients: impl Iterator<Item = Matrix3<f64>>,
    ) -> Self {
        let array = |components: usize| Aligned::new(T::splat(0.0), components * leading_dimension);
        let mut deformation_gradient = array(9);
        let mut points = Vec::with_capacity(n);
        for (i, f) in deformation_gradients.take(n).enumerate() {
            points.push(OnePoint::new(std::array::from_fn(|c| T::splat(f[c]))));
            for (c, &value) in f.iter().enumerate() {
                deformation_gradient[c * leading_dimension + i] = T::splat(value);
            }
        }
        Scene {
            n,
            leading_dimension,
            deformation_gradient,
            stress: array(6),
            energies: array(4),
            invariants: array(4),
            failure: array(3),
            status: Aligned::new(0, leading_dimension),
            points,
        }
    }

    /// `n` random states of a yarn under impact, always the same ones.
    pub fn impact(n: usize) -> Self {
        Scene::new(n, impacts())
    }

    /// All that a solver wants.
    pub fn arrays(&mut self, level: Level) -> Arrays<'_, T> {
        Arrays {
            energies: Some(&mut self.energies),
            invariants: Some(&mut self.invariants),
            failure: Some(&mut self.failure),
            ..stress_arrays(
                self.n,
                self.leading_dimension,
                &self.deformation_gradient,
                &mut self.stress,
                &mut self.status,
                level,
            )
        }
    }

    /// Stress and status.
    pub fn stress_only(&mut self, level: Level) -> Arrays<'_, T> {
        stress_arrays(
            self.n,
            self.leading_dimension,
            &self.deformation_gradient,
            &mut self.stress,
            &mut self.status,
            level,
        )
    }
}

fn stress_arrays<'a, T: Real>(
    n: usize,
    leading_dimension: usize,
    deformation_gradient: &'a [T],
    stress: &'a mut [T],
    status: &'a mut [i32],
    level: Level,
) -> Arrays<'a, T> {
    Arrays {
        n,
        leading_dimension,
        deformation_gradient,
        fibre: None,
        limit: None,
        density: T::splat(0.0),
        stress: Some(stress),
        energies: None,
        invariants: None,
        failure: None,
        modes: None,
        wave_speed: None,
        tangent: None,
        measure: Measure::Jaumann,
        status: Some(status),
        active: None,
        level: Some(level),
    }
}

/// The deformation gradients of [`Scene::impact`].
pub fn impacts() -> impl Iterator<Item = Matrix3<f64>> {
    let mut random = Rng::with_seed(1);
    std::iter::from_fn(move || Some(impact(&mut random)))
}

/// A deformation gradient as a point of a yarn sees it: ahead of the waves, in tension behind the longitudinal one,
/// turned and sheared by the transverse one, compacted and flattened under the projectile.
fn impact(random: &mut Rng) -> Matrix3<f64> {
    let mut between = |low: f64, high: f64| low + (high - low) * random.f64();
    let zone = between(0.0, 1.0);
    let noise = 1e-6;
    // The largest strains along and across the fibre, aspect of the section, shear and angle of the zone.
    let [tension, compaction, aspect, shear, angle] = match zone {
        ..0.1 => [0.0; 5],
        0.1..0.2 => [noise; 5],
        0.2..0.5 => [0.04, noise, noise, noise, noise],
        0.5..0.75 => [0.04, 0.02, 0.1, 0.05, 0.4],
        _ => [0.047, 0.3, 0.5, 0.2, 0.4],
    };
    let stretch = 1.0 + between(-0.1, 1.0) * tension;
    let area = 1.0 - between(-0.1, 1.0) * compaction;
    let ratio = f64::exp(0.5 * between(-1.0, 1.0) * aspect);
    let (wide, high) = (area.sqrt() * ratio, area.sqrt() / ratio);
    let mut slip = || between(-1.0, 1.0) * shear;
    // The triangle of Eq. 4.7, then a rotation.
    let triangle = Matrix3::new(stretch, slip(), slip(), 0.0, wide, slip(), 0.0, 0.0, high);
    let axis = Vector3::new(0.1 * between(-1.0, 1.0), between(-1.0, 1.0), 0.3 * between(-1.0, 1.0));
    Rotation3::new(axis * angle).into_inner() * triangle
}
