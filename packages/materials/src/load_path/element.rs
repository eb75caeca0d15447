//! The element: a hexahedron of edges along the axes, deformed as one.

use nalgebra::{Matrix3, Vector3};

/// Edge lengths in the reference placement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hexahedron {
    pub size: Vector3<f64>,
}

impl Hexahedron {
    /// Reference volume.
    pub fn volume(&self) -> f64 {
        self.size.product()
    }

    /// Reference areas of the faces whose normals are the axes.
    pub fn areas(&self) -> Vector3<f64> {
        let [x, y, z] = self.size.into();
        Vector3::new(y * z, z * x, x * y)
    }

    /// Forces on the three positive faces, as columns: the first Piola–Kirchhoff stress on each normal times its area.
    pub fn face_forces(&self, p: &Matrix3<f64>) -> Matrix3<f64> {
        p * Matrix3::from_diagonal(&self.areas())
    }

    /// Work done on the element from `f0` to `f1` by the trapezoidal rule: ½ (P0 + P1) : (F1 − F0) V0.
    pub fn work(&self, f0: &Matrix3<f64>, p0: &Matrix3<f64>, f1: &Matrix3<f64>, p1: &Matrix3<f64>) -> f64 {
        0.5 * (p0 + p1).dot(&(f1 - f0)) * self.volume()
    }
}
