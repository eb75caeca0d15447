//! What the library is measured against: the thesis's equations as printed, an eigen-decomposition, Fortran.

pub mod eigen;
pub mod fortran;
pub mod literal;

use nalgebra::{Matrix3, Vector3};
use toron::Properties;
use toron::law::state::HYPERELASTIC_STATE;
use toron::law::thesis::{Functions, Yarn};

/// The yarn of these properties, in the order of their table, for the laws written in Rust.
pub fn yarn(properties: &[f64]) -> Yarn<f64> {
    let &[k_el, k_tc, p, k_td, k_ld, eps_lim, alpha, beta, m_1, m_2, m_3] = properties else {
        panic!("eleven properties")
    };
    let fibre = Vector3::new(m_1, m_2, m_3).normalize().into();
    Yarn {
        properties: Properties { k_el, k_tc, p, k_td, k_ld, eps_lim, alpha, beta, fibre },
        functions: Functions { number: |x| x, sqrt: f64::sqrt, ln: f64::ln, acosh: f64::acosh, power: f64::powf },
    }
}

/// Energies, modes, failure.
pub fn state(yarn: &Yarn<f64>, modes: [f64; 4]) -> [f64; HYPERELASTIC_STATE] {
    let [w_el, w_tc, w_td, w_ld] = yarn.energies(modes);
    let [i_el, i_tc, i_td, i_ld] = modes;
    let index = yarn.failure_index(modes);
    let failed = if index >= 1.0 { 1.0 } else { 0.0 };
    [w_el, w_tc, w_td, w_ld, i_el, i_tc, i_td, i_ld, index, failed, 1.0 - failed]
}

/// 11 22 33 12 23 31 of a symmetric tensor.
pub fn components(s: &Matrix3<f64>) -> [f64; 6] {
    [s.m11, s.m22, s.m33, s.m12, s.m23, s.m31]
}
