//! The law as the thesis prints it, in double precision: invariants of C (Eq. 4.9), second Piola–Kirchhoff stress (Eq.
//! 4.14), push-forward.

use nalgebra::Matrix3;
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
    if jacobian.is_nan() || jacobian <= 0.0 {
        return ([0.0; 6], *state, status::INVERTED);
    }
    let c = f.transpose() * f;
    let modes = yarn.modes(&c);
    let [el, tc, td, ld] = yarn.stresses(&c, modes);
    let stress = f * (el + tc + td + ld) * f.transpose() / jacobian;
    (components(&stress), super::state(yarn, modes), status::OK)
}
