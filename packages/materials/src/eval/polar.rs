//! The polar decomposition F = R U as a host forms it, in extended precision and rounded once.
//!
//! A comparison of the VUMAT with the other entries then shows the VUMAT's own rounding, not this decomposition's.
//! Extended precision is [`TwoFloat`]'s: it costs some seconds of a clean build, and saves error-free sums and products
//! written out here.

use nalgebra::Matrix3;
use twofloat::TwoFloat;

/// R and U of F = R U, each entry rounded once from some 30 digits.
///
/// det R = 1, so that U of an inverted F has a negative determinant. A singular F, or one that is not finite, has no
/// decomposition: then R = 1 and U = F.
pub fn polar_decomposition(f: &Matrix3<f64>) -> (Matrix3<f64>, Matrix3<f64>) {
    let wide = f.map(TwoFloat::from);
    match rotation(&wide) {
        Some(r) => {
            let u = r.transpose() * wide;
            let symmetric = (u + u.transpose()) * TwoFloat::from(0.5);
            (r.map(f64::from), symmetric.map(f64::from))
        }
        None => (Matrix3::identity(), *f),
    }
}

/// Newton's iteration X ← ½(κX + (κX)⁻ᵀ), scaled while it is far from a rotation.
fn rotation(f: &Matrix3<TwoFloat>) -> Option<Matrix3<TwoFloat>> {
    let mut x = *f;
    let mut scaled = true;
    for _ in 0..60 {
        let cofactors = cofactors(&x);
        let determinant = x.row(0).dot(&cofactors.row(0));
        if !f64::from(determinant).is_normal() {
            return None;
        }
        let inverse_transpose = cofactors / determinant;
        let kappa = if scaled { f64::sqrt(norm(&inverse_transpose) / norm(&x)) } else { 1.0 };
        let kappa = TwoFloat::from(kappa);
        let next = (x * kappa + inverse_transpose / kappa) * TwoFloat::from(0.5);
        let change = norm(&(next - x));
        x = next;
        if !change.is_finite() {
            return None;
        }
        if change < 1e-2 {
            scaled = false;
        }
        // Quadratic: the step after one of 1e-16 is at the rounding of the extended numbers.
        if change < 1e-17 {
            return Some(if f64::from(determinant) < 0.0 { -x } else { x });
        }
    }
    None
}

fn cofactors(a: &Matrix3<TwoFloat>) -> Matrix3<TwoFloat> {
    let [x, y, z] = [0, 1, 2].map(|j| a.column(j));
    Matrix3::from_columns(&[y.cross(&z), z.cross(&x), x.cross(&y)])
}

fn norm(a: &Matrix3<TwoFloat>) -> f64 {
    a.map(f64::from).norm()
}
