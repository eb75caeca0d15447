//! Random deformations whose modes are known, and a fixed series of random values.

use std::f64::consts::TAU;
use std::ops::Range;

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

/// `count` values of a strategy, the same ones in every run.
pub fn samples<S: Strategy>(strategy: S, count: usize) -> impl Iterator<Item = S::Value> {
    let mut runner = TestRunner::deterministic();
    (0..count).map(move |_| strategy.new_tree(&mut runner).expect("a value").current())
}

/// A rotation, evenly spread.
pub fn rotation() -> impl Strategy<Value = Matrix3<f64>> {
    (0.0..1.0, 0.0..TAU, 0.0..TAU).prop_map(|(u, a, b): (f64, f64, f64)| {
        let (v, w) = ((1.0 - u).sqrt(), u.sqrt());
        let quaternion = Quaternion::new(v * a.sin(), v * a.cos(), w * b.sin(), w * b.cos());
        UnitQuaternion::new_normalize(quaternion).to_rotation_matrix().into_inner()
    })
}

/// A direction, evenly spread.
pub fn direction() -> impl Strategy<Value = Vector3<f64>> {
    rotation().prop_map(|q| q.column(0).into_owned())
}

/// Ranges of the four invariants.
#[derive(Clone)]
pub struct Ranges {
    pub i_el: Range<f64>,
    pub i_tc: Range<f64>,
    pub i_td: Range<f64>,
    pub i_ld: Range<f64>,
}

/// A deformation gradient, the fibre direction it belongs to, and the invariants it was made of.
#[derive(Clone, Debug)]
pub struct Sample {
    pub f: Matrix3<f64>,
    pub m: Vector3<f64>,
    pub invariants: [f64; 4],
}

/// F = Q R Nᵀ with R from the four modes (thesis, Eq. 4.7), the axes of distortion and of shear turned at will.
pub fn deformation(ranges: Ranges) -> impl Strategy<Value = Sample> {
    let invariants = (ranges.i_el, ranges.i_tc, ranges.i_td, ranges.i_ld);
    let angles = (0.0..TAU, 0.0..TAU);
    (invariants, angles, rotation(), rotation()).prop_map(|((i_el, i_tc, i_td, i_ld), (section, slip), q, n)| {
        let (lambda, area, aspect) = (f64::exp(i_el), f64::exp(i_tc), f64::exp(i_td));
        let turned = |angle: f64| Rotation3::from_axis_angle(&Vector3::x_axis(), angle).into_inner();
        let stretch = Matrix3::from_diagonal(&Vector3::new(lambda, area * aspect, area / aspect));
        let mut r = turned(-section) * stretch * turned(section);
        r.m12 = lambda * i_ld * slip.cos();
        r.m13 = lambda * i_ld * slip.sin();
        Sample { f: q * r * n.transpose(), m: n.column(0).into_owned(), invariants: [i_el, i_tc, i_td, i_ld] }
    })
}
