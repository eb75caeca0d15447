//! Random histories of the deformation, within the range of stretches that a material is for.

use fastrand::Rng;
use nalgebra::{Matrix3, Rotation3, Vector3};

use super::kinematics::{Increment, exp};
use super::material::Material;

/// Increments of a leg, at most.
const LONGEST: f64 = 150.0;

/// The largest turn of one increment, 5°: many rate laws integrate the spin as solvers do, for small turns alone.
pub const LARGEST_TURN: f64 = 0.0873;

/// Legs between random states: the sequence of F after each increment. Increments of a leg are equal; those of
/// different legs differ by up to a factor of thirty.
pub fn history(rng: &mut Rng, material: &Material, legs: usize) -> Vec<Matrix3<f64>> {
    let mut history = Vec::new();
    let mut f = Matrix3::identity();
    let mut before = f;
    for leg in 0..legs {
        let target = match rng.usize(0..5) {
            // Back to where the leg before began: unloading.
            0 if leg > 0 => before,
            // A part of the way that is not reversed.
            1 => Increment::between(&Matrix3::identity(), &state(rng, material)).at(0.2 * rng.f64(), &f),
            _ => state(rng, material),
        };
        let size = material.increment * 10f64.powf(-1.0 + 1.3 * rng.f64());
        before = f;
        let increment = Increment::between(&f, &target);
        let count = (increment.strain.norm() / size).max(increment.angle() / LARGEST_TURN).ceil().clamp(1.0, LONGEST);
        // A short leg of small increments, so that little strains are seen too.
        let taken = if rng.f64() < 0.3 { count.min(5.0) } else { count };
        history.extend((1..=taken as usize).map(|k| increment.at(k as f64 / count, &before)));
        f = history.last().copied().unwrap_or(f);
    }
    history
}

/// A random deformation, unsymmetric and turned.
pub fn state(rng: &mut Rng, material: &Material) -> Matrix3<f64> {
    let [low, high] = material.stretch.map(f64::ln);
    let values = Vector3::from_fn(|_, _| low + (high - low) * rng.f64());
    let axes = rotation(rng, material);
    let mut strain = axes * Matrix3::from_diagonal(&values) * axes.transpose();
    if material.components < 6 {
        strain = planar(&strain, material, values[2]);
    }
    rotation(rng, material) * exp(&strain)
}

/// A random direction of strain, of norm 1.
pub fn direction(rng: &mut Rng, material: &Material) -> Matrix3<f64> {
    let random = Matrix3::from_fn(|_, _| 2.0 * rng.f64() - 1.0);
    let strain = planar(&((random + random.transpose()) * 0.5), material, random[(2, 2)]);
    strain / strain.norm().max(1e-3)
}

/// A random velocity gradient or part of one, of norm 1.
pub fn gradient(rng: &mut Rng, material: &Material) -> Matrix3<f64> {
    let random = Matrix3::from_fn(|_, _| 2.0 * rng.f64() - 1.0);
    let gradient = planar(&random, material, random[(2, 2)]);
    gradient / gradient.norm().max(1e-3)
}

/// Without the shears out of the plane, where the material has none of them.
fn planar(matrix: &Matrix3<f64>, material: &Material, across: f64) -> Matrix3<f64> {
    if material.components == 6 {
        return *matrix;
    }
    if material.is_diagonal() {
        let is_kept = |i: usize, j: usize| i == j && i < material.components;
        return Matrix3::from_fn(|i, j| if is_kept(i, j) { matrix[(i, j)] } else { 0.0 });
    }
    let mut planar = *matrix;
    for (i, j) in [(0, 2), (1, 2), (2, 0), (2, 1)] {
        planar[(i, j)] = 0.0;
    }
    let is_across = material.components == 4 && !material.is_plane_strain();
    planar[(2, 2)] = if is_across { across } else { 0.0 };
    planar
}

/// A random rotation, about the third axis where the material is planar; none of a bar or of a shell of
/// revolution.
pub fn rotation(rng: &mut Rng, material: &Material) -> Matrix3<f64> {
    // Between two turns of it a bar would be sheared.
    if material.is_diagonal() {
        return Matrix3::identity();
    }
    if material.components < 6 {
        return turn(Vector3::z() * (std::f64::consts::TAU * rng.f64()));
    }
    let axis = Vector3::from_fn(|_, _| 2.0 * rng.f64() - 1.0);
    turn(axis.normalize() * (std::f64::consts::PI * rng.f64()))
}

/// The rotation about this axis by its length.
pub fn turn(axis: Vector3<f64>) -> Matrix3<f64> {
    *Rotation3::from_scaled_axis(axis).matrix()
}
