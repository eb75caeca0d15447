//! The law as the thesis prints it: invariants of C (Eq. 4.9), second Piola–Kirchhoff stress (Eq. 4.12, 4.14),
//! push-forward.
//!
//! Eq. 4.14 is 0/0 where the section is undistorted; where its root is not positive the distortion carries no stress
//! here, the least that lets it run.

use nalgebra::Matrix3;
use toron::law::state::{FAILED, HYPERELASTIC_STATE};
use toron::law::status;
use toron_program::bench::entries::Answer;

use super::{Properties, components};

/// Stress, new state and status of one point.
pub fn point(law: &Properties, f: &Matrix3<f64>, state: &[f64; HYPERELASTIC_STATE]) -> Answer<f64> {
    if state[FAILED] >= 0.5 {
        return ([0.0; 6], *state, status::OK);
    }
    let jacobian = f.determinant();
    let c = f.transpose() * f;
    let Some(inverse) = c.try_inverse().filter(|_| jacobian > 0.0) else {
        return ([0.0; 6], *state, status::INVERTED);
    };
    let m = law.m;
    let cm = c * m;
    let (i1, i3, i4, i5) = (c.trace(), c.determinant(), m.dot(&cm), cm.norm_squared());
    let i_el = 0.5 * i4.ln();
    let i_tc = 0.25 * (i3 / i4).ln();
    let i_td = 0.5 * ((i1 * i4 - i5) / (2.0 * (i3 * i4).sqrt())).max(1.0).acosh();
    let i_ld = (i5 / (i4 * i4) - 1.0).max(0.0).sqrt();

    let mm = m * m.transpose();
    let sym = cm * m.transpose() + m * cm.transpose();
    let mut s = law.k_ld * (sym / (i4 * i4) - 2.0 * i5 / i4.powi(3) * mm);
    if i_el > 0.0 {
        s += law.k_el * i_el / i4 * mm;
    }
    if i_tc < 0.0 {
        s -= 0.5 * law.p * law.k_tc * (-i_tc).powf(law.p - 1.0) * (inverse - mm / i4);
    }
    let q = i1 * i4 - i5;
    let root = q * q - 4.0 * i3 * i4;
    if root > 0.0 {
        let bracket = 2.0 * i4 * Matrix3::identity() - q * inverse + (i1 + i5 / i4) * mm - 2.0 * sym;
        s += 2.0 * law.k_td * i_td / (4.0 * root.sqrt()) * bracket;
    }
    (components(&(f * s * f.transpose() / jacobian)), law.state([i_el, i_tc, i_td, i_ld]), status::OK)
}
