//! Increments of the deformation as Abaqus hands them to a UMAT, and components of tensors in its order.

use nalgebra::{Matrix3, Rotation3, SymmetricEigen, Vector3};

/// An increment ΔF = V R: what a UMAT gets of it.
///
/// Abaqus itself integrates by Hughes–Winget, which is inexact for finite increments and would blame the law for it;
/// polar decomposition and logarithm are exact.
pub struct Increment {
    /// ln V, on the axes of the increment's end.
    pub strain: Matrix3<f64>,
    /// R, which turns stress and tensors among the state variables.
    pub rotation: Matrix3<f64>,
}

impl Increment {
    pub fn between(f0: &Matrix3<f64>, f1: &Matrix3<f64>) -> Self {
        let change = f1 * f0.try_inverse().unwrap_or_else(|| Matrix3::from_element(f64::NAN));
        let (squared_stretches, axes) = eigen(&(change * change.transpose()));
        let of = |function: fn(f64) -> f64| rebuilt(&squared_stretches, &axes, function);
        Increment { strain: of(|x| 0.5 * x.ln()), rotation: of(|x| 1.0 / x.sqrt()) * change }
    }

    /// The angle of R.
    pub fn angle(&self) -> f64 {
        rotation_vector(&self.rotation).norm()
    }

    /// The same with a turn of this angle, if it is larger.
    pub fn turning_at_most(mut self, angle: f64) -> Self {
        let rotation = Rotation3::from_matrix_unchecked(self.rotation);
        if rotation.angle() > angle {
            self.rotation = *rotation.powf(angle / rotation.angle()).matrix();
        }
        self
    }

    /// The deformation from F0 at this part of the increment, along constant rates of stretch and spin.
    pub fn at(&self, part: f64, f0: &Matrix3<f64>) -> Matrix3<f64> {
        let spin = rotation_vector(&self.rotation) * part;
        exp(&(self.strain * part)) * Rotation3::from_scaled_axis(spin).matrix() * f0
    }
}

/// R of F = R U.
pub fn rotation_of(f: &Matrix3<f64>) -> Matrix3<f64> {
    let (squared_stretches, axes) = eigen(&(f * f.transpose()));
    rebuilt(&squared_stretches, &axes, |x| 1.0 / x.sqrt()) * f
}

/// A rotation's axis times its angle; exactly 0 where nothing turns. Rounding leaves cosines above 1, which have no
/// arc: the angle is that of sine and cosine. Half a turn has no axis here.
pub fn rotation_vector(rotation: &Matrix3<f64>) -> Vector3<f64> {
    let of = |i: usize, j: usize| 0.5 * (rotation[(i, j)] - rotation[(j, i)]);
    let axis = Vector3::new(of(2, 1), of(0, 2), of(1, 0));
    let sine = axis.norm();
    if sine == 0.0 { axis } else { axis * (sine.atan2(0.5 * (rotation.trace() - 1.0)) / sine) }
}

/// ln V of F = V R.
pub fn logarithm(f: &Matrix3<f64>) -> Matrix3<f64> {
    let (squared_stretches, axes) = eigen(&(f * f.transpose()));
    rebuilt(&squared_stretches, &axes, |x| 0.5 * x.ln())
}

/// The exponential of a symmetric matrix.
pub fn exp(matrix: &Matrix3<f64>) -> Matrix3<f64> {
    // Closer to rounding than eigenvalues for the small strains by which tangents are found.
    if matrix.norm() < 5e-3 {
        let square = matrix * matrix;
        return Matrix3::identity()
            + matrix
            + square * 0.5
            + square * matrix / 6.0
            + square * square / 24.0
            + square * square * matrix / 120.0;
    }
    let (values, axes) = eigen(matrix);
    rebuilt(&values, &axes, f64::exp)
}

fn eigen(symmetric: &Matrix3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
    // The iteration for eigenvalues does not end with NaN.
    if symmetric.iter().any(|entry| !entry.is_finite()) {
        return (Vector3::from_element(f64::NAN), Matrix3::identity());
    }
    let SymmetricEigen { eigenvalues, eigenvectors } = symmetric.symmetric_eigen();
    (eigenvalues, eigenvectors)
}

fn rebuilt(values: &Vector3<f64>, axes: &Matrix3<f64>, function: impl Fn(f64) -> f64) -> Matrix3<f64> {
    axes * Matrix3::from_diagonal(&values.map(function)) * axes.transpose()
}

/// NTENS components or fewer.
pub type Components = [f64; 6];
/// NTENS by NTENS components or fewer.
pub type Modulus = [[f64; 6]; 6];

/// NTENS, and whether the components are those of a traction: along the normal and two in the plane.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    pub components: usize,
    pub traction: bool,
}

impl From<usize> for Layout {
    fn from(components: usize) -> Layout {
        Layout { components, traction: false }
    }
}

/// Row and column of each component: 11 22 33 12 13 23, without 33 in plane stress; 11 22 of a shell of revolution. A
/// traction's stand on the diagonal: the logarithms of stretches there add up, as separations do.
pub fn places(layout: impl Into<Layout>) -> &'static [(usize, usize)] {
    let Layout { components, traction } = layout.into();
    match components {
        3 if traction => &[(0, 0), (1, 1), (2, 2)],
        1 => &[(0, 0)],
        2 => &[(0, 0), (1, 1)],
        3 => &[(0, 0), (1, 1), (0, 1)],
        4 => &[(0, 0), (1, 1), (2, 2), (0, 1)],
        _ => &[(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)],
    }
}

/// How a component is written: `12`; those of a traction `n`, `s`, `t`.
pub fn name(layout: impl Into<Layout>, index: usize) -> String {
    let layout = layout.into();
    if layout.traction {
        return ["n", "s", "t"][index].to_string();
    }
    let (i, j) = places(layout)[index];
    format!("{}{}", i + 1, j + 1)
}

pub fn tensor(values: &Components, components: impl Into<Layout>) -> Matrix3<f64> {
    let mut tensor = Matrix3::zeros();
    for (&value, &(i, j)) in values.iter().zip(places(components)) {
        tensor[(i, j)] = value;
        tensor[(j, i)] = value;
    }
    tensor
}

pub fn of_stress(tensor: &Matrix3<f64>, components: impl Into<Layout>) -> Components {
    let mut values = [0.0; 6];
    for (value, &(i, j)) in values.iter_mut().zip(places(components)) {
        *value = 0.5 * (tensor[(i, j)] + tensor[(j, i)]);
    }
    values
}

/// Shear strains are twice the tensor's.
pub fn of_strain(tensor: &Matrix3<f64>, components: impl Into<Layout>) -> Components {
    let components = components.into();
    let mut values = of_stress(tensor, components);
    for (value, (i, j)) in values.iter_mut().zip(places(components)) {
        *value *= if i == j { 1.0 } else { 2.0 };
    }
    values
}

pub fn strain_tensor(values: &Components, components: impl Into<Layout>) -> Matrix3<f64> {
    let mut tensor = tensor(values, components);
    for i in 0..3 {
        for j in 0..3 {
            tensor[(i, j)] *= if i == j { 1.0 } else { 0.5 };
        }
    }
    tensor
}

/// The strain whose component is 1, a shear strain being twice the tensor's.
pub fn unit_strain(components: impl Into<Layout>, index: usize) -> Matrix3<f64> {
    let mut values = [0.0; 6];
    values[index] = 1.0;
    strain_tensor(&values, components)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rotation_vector_is_finite_whatever_rounding_leaves() {
        let more_than_one = Matrix3::identity() * (1.0 + 4.0 * f64::EPSILON);
        assert_eq!(rotation_vector(&more_than_one), Vector3::zeros());
        let found = rotation_vector(&(more_than_one + Matrix3::new(0.0, -1e-7, 0.0, 1e-7, 0.0, 0.0, 0.0, 0.0, 0.0)));
        assert!((found - Vector3::z() * 1e-7).norm() < 1e-20, "{found}");
        for size in [1e-14, 1e-8, 0.3, 3.0] {
            let vector = Vector3::new(0.6, -0.48, 0.64) * size;
            let found = rotation_vector(Rotation3::from_scaled_axis(vector).matrix());
            assert!((found - vector).norm() < 1e-14 * size.max(1e-2), "{found}");
        }
    }

    #[test]
    fn an_increment_is_decomposed_and_put_together_again() {
        let f0 = Matrix3::new(1.1, 0.2, 0.0, -0.1, 0.9, 0.1, 0.05, 0.0, 1.2);
        let turn = Rotation3::from_scaled_axis(Vector3::new(0.4, -1.2, 0.3));
        let f1 = exp(&Matrix3::new(0.1, 0.02, 0.0, 0.02, -0.2, 0.03, 0.0, 0.03, 0.05)) * turn.matrix() * f0;
        let increment = Increment::between(&f0, &f1);
        assert!((increment.rotation - turn.matrix()).norm() < 1e-14);
        assert!((increment.at(1.0, &f0) - f1).norm() < 1e-14);
        let middle = increment.at(0.5, &f0);
        assert!((Increment::between(&middle, &f1).strain - increment.strain * 0.5).norm() > 1e-3, "it turns");
        assert!((Increment::between(&f0, &middle).strain - increment.strain * 0.5).norm() < 1e-14);
    }

    #[test]
    fn components_come_back() {
        for components in [1, 2, 3, 4, 6] {
            let mut values = [0.0; 6];
            for (i, value) in values.iter_mut().take(components).enumerate() {
                *value = i as f64 + 1.0;
            }
            assert_eq!(of_stress(&tensor(&values, components), components), values);
            assert_eq!(of_strain(&strain_tensor(&values, components), components), values);
        }
        let traction = Layout { components: 3, traction: true };
        let values = [1.0, 2.0, 3.0, 0.0, 0.0, 0.0];
        assert_eq!(of_strain(&strain_tensor(&values, traction), traction), values);
        assert_eq!((name(6, 4), name(traction, 2)), ("13".to_string(), "t".to_string()));
        assert_eq!(name(3, 2), "12");
    }
}
