//! The law by principal stretches of the section: the transverse block of b = F Fᵀ is taken apart into eigenvalues and
//! eigenvectors, and each principal direction carries its own Kirchhoff stress.

use nalgebra::{Matrix3, Matrix3x2, SymmetricEigen, Vector3};
use toron::law::state::{FAILED, HYPERELASTIC_STATE};
use toron::law::status;
use toron::law::thesis::Yarn;
use toron_materials::bench::entries::Answer;

use super::components;

/// Stress, new state and status of one point.
pub fn point(yarn: &Yarn<f64>, f: &Matrix3<f64>, state: &[f64; HYPERELASTIC_STATE]) -> Answer<f64> {
    if state[FAILED] >= 0.5 {
        return ([0.0; 6], *state, status::OK);
    }
    let jacobian = f.determinant();
    let law = &yarn.properties;
    let image = f * Vector3::from(law.fibre);
    let lambda = image.norm();
    if !(jacobian > 0.0 && lambda > 0.0) {
        return ([0.0; 6], *state, status::INVERTED);
    }
    let e = image / lambda;
    // Any two axes across e.
    let least = Vector3::ith(e.iamin(), 1.0);
    let first = e.cross(&least).normalize();
    let across = Matrix3x2::from_columns(&[first, e.cross(&first)]);
    let b = f * f.transpose();
    let section = SymmetricEigen::new(across.transpose() * b * across);
    let directions = across * section.eigenvectors;
    // ln of the principal stretches: their mean is I_tc, half their difference I_td.
    let logarithms = section.eigenvalues.map(|square| 0.5 * square.ln());
    let i_el = lambda.ln();
    let i_tc = 0.5 * logarithms.sum();
    let difference = 0.5 * (logarithms[0] - logarithms[1]);
    let be = b * e;
    let sheared = be - e * e.dot(&be);
    let i_ld = (e.dot(&be) / (lambda * lambda) - 1.0).max(0.0).sqrt();

    let pressure = 0.5 * law.p * law.k_tc * (-i_tc).max(0.0).powf(law.p - 1.0);
    let distortion = 0.5 * law.k_td * difference;
    let mut stress = law.k_el * i_el.max(0.0) * e * e.transpose();
    for (k, sign) in [(0, 1.0), (1, -1.0)] {
        let n = directions.column(k);
        stress += (sign * distortion - pressure) * n * n.transpose();
    }
    stress += law.k_ld / (lambda * lambda) * (sheared * e.transpose() + e * sheared.transpose());
    (components(&(stress / jacobian)), super::state(yarn, [i_el, i_tc, difference.abs(), i_ld]), status::OK)
}
