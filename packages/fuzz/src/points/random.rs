//! Random numbers, rotations and deformation gradients, the hostile ones no rarer than the others.

use std::f64::consts::TAU;

use fastrand::Rng;
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};

/// Numbers at the edges of what the formats and the laws can hold.
const HOSTILE: [f64; 30] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    -0.5,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    f64::MIN,
    f64::MIN_POSITIVE,
    5e-324,
    1e-310,
    1e-200,
    1e-45,
    1.2e-38,
    1e-30,
    1e-19,
    f64::EPSILON,
    6e-8,
    1e-3,
    10.0,
    1e7,
    1e19,
    1e25,
    3.4e38,
    1e100,
    1e154,
    1e300,
];

/// Some of them, or a number of any bits.
pub fn hostile(rng: &mut Rng) -> f64 {
    match rng.u8(0..8) {
        0 => f64::from_bits(rng.u64(..)),
        1 => f64::from(f32::from_bits(rng.u32(..))),
        _ => HOSTILE[rng.usize(..HOSTILE.len())],
    }
}

/// A number between these, evenly spread.
pub fn between(rng: &mut Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * rng.f64()
}

/// A power of ten between these exponents.
pub fn power_of_ten(rng: &mut Rng, low: f64, high: f64) -> f64 {
    10f64.powf(between(rng, low, high))
}

/// Whether one chance in `n` comes up.
pub fn one_in(rng: &mut Rng, n: u32) -> bool {
    rng.u32(0..n) == 0
}

/// A rotation, evenly spread; every other one is none.
fn rotation(rng: &mut Rng) -> Matrix3<f64> {
    if rng.bool() {
        return Matrix3::identity();
    }
    any_rotation(rng)
}

/// A rotation, evenly spread.
pub fn any_rotation(rng: &mut Rng) -> Matrix3<f64> {
    let (u, a, b) = (rng.f64(), TAU * rng.f64(), TAU * rng.f64());
    let (v, w) = ((1.0 - u).sqrt(), u.sqrt());
    let quaternion = Quaternion::new(v * a.sin(), v * a.cos(), w * b.sin(), w * b.cos());
    UnitQuaternion::new_normalize(quaternion).to_rotation_matrix().into_inner()
}

/// A fibre direction: the first axis, any direction of any length, one next to an axis, or a hostile one.
pub fn direction(rng: &mut Rng) -> [f64; 3] {
    match rng.u8(0..20) {
        0..=8 => [1.0, 0.0, 0.0],
        9..=15 => (any_rotation(rng).column(0) * power_of_ten(rng, -3.0, 3.0)).into(),
        16 => [power_of_ten(rng, -25.0, -5.0), 1.0, 0.0],
        17 => [-1.0, power_of_ten(rng, -25.0, -5.0), 1e-9],
        18 => [0.0, 0.0, -2.0],
        _ => [hostile(rng), hostile(rng), hostile(rng)],
    }
}

/// Axes of which the first is a direction, where it is one.
fn axes_along(m: [f64; 3]) -> Matrix3<f64> {
    let Some(m) = Vector3::from(m).try_normalize(1e-100) else { return Matrix3::identity() };
    let beside = if m.x.abs() < 0.5 { Vector3::x() } else { Vector3::y() };
    let Some(second) = m.cross(&beside).try_normalize(1e-100) else { return Matrix3::identity() };
    Matrix3::from_columns(&[m, second, m.cross(&second)])
}

/// F = Q R Nᵀ of these invariants of elongation, compaction, distortion and shear about a fibre.
fn of_modes(rng: &mut Rng, m: [f64; 3], [i_el, i_tc, i_td, i_ld]: [f64; 4]) -> Matrix3<f64> {
    let (lambda, area, aspect) = (i_el.exp(), i_tc.exp(), i_td.exp());
    let turn = if rng.bool() { 0.0 } else { TAU * rng.f64() };
    let (sin, cos) = turn.sin_cos();
    let turned = Matrix3::new(1.0, 0.0, 0.0, 0.0, cos, -sin, 0.0, sin, cos);
    let stretch = Matrix3::from_diagonal(&Vector3::new(lambda, area * aspect, area / aspect));
    let mut r = turned.transpose() * stretch * turned;
    let angle = TAU * rng.f64();
    (r.m12, r.m13) = (lambda * i_ld * angle.cos(), lambda * i_ld * angle.sin());
    rotation(rng) * r * axes_along(m).transpose()
}

/// A deformation gradient of a yarn along `m`.
pub fn gradient(rng: &mut Rng, m: [f64; 3]) -> Matrix3<f64> {
    let kind = rng.u8(0..32);
    let modes = match kind {
        0..=11 => [between(rng, -0.05, 0.08), between(rng, -0.4, 0.1), between(rng, 0.0, 0.6), between(rng, 0.0, 0.3)],
        12..=14 => [between(rng, -2.0, 2.0), between(rng, -2.0, 1.0), between(rng, 0.0, 6.9), between(rng, 0.0, 100.0)],
        15 => [0.0, -between(rng, 0.0, 0.5), 0.0, 0.0],
        _ => [between(rng, -0.3, 0.3), between(rng, -0.3, 0.3), between(rng, 0.0, 0.5), between(rng, 0.0, 0.5)],
    };
    let mut f = of_modes(rng, m, modes);
    match kind {
        0..=15 => (),
        16 => f = Matrix3::identity(),
        17 => f = any_rotation(rng),
        18 | 19 => {
            let size = power_of_ten(rng, -15.0, -1.0);
            f = Matrix3::from_fn(|i, j| f64::from(u8::from(i == j)) + size * between(rng, -1.0, 1.0));
        }
        20 | 21 => f = Matrix3::from_fn(|i, j| f64::from(u8::from(i == j)) + between(rng, -0.9, 0.9)),
        22 => f *= power_of_ten(rng, -6.0, 6.0),
        23 => f *= power_of_ten(rng, -310.0, 308.0),
        24 => f = -f,
        25 => f.set_column(1, &f.column(2).into_owned()),
        26 => f.m11 = -f.m11,
        27..=29 => {
            let entry = rng.usize(0..9);
            f[entry] = hostile(rng);
        }
        30 => {
            f = Matrix3::from_diagonal(&Vector3::new(power_of_ten(rng, -6.0, 6.0), 1.0, power_of_ten(rng, -6.0, 6.0)))
        }
        _ => f = Matrix3::from_fn(|_, _| hostile(rng)),
    }
    f
}
