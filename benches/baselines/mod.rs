//! What the library is measured against: the thesis's equations as printed, an eigen-decomposition, Fortran.

pub mod eigen;
pub mod fortran;
pub mod literal;

use nalgebra::{Matrix3, Vector3};
use toron::law::state::HYPERELASTIC_STATE;

/// The properties under the names of their symbols, for the laws written in Rust.
#[derive(Clone, Copy)]
pub struct Properties {
    pub k_el: f64,
    pub k_tc: f64,
    pub p: f64,
    pub k_td: f64,
    pub k_ld: f64,
    pub eps_lim: f64,
    pub alpha: f64,
    pub beta: f64,
    pub m: Vector3<f64>,
}

impl Properties {
    /// In the order of the table of properties.
    pub fn new(properties: &[f64]) -> Self {
        let &[k_el, k_tc, p, k_td, k_ld, eps_lim, alpha, beta, m_1, m_2, m_3] = properties else {
            panic!("eleven properties")
        };
        let m = Vector3::new(m_1, m_2, m_3).normalize();
        Properties { k_el, k_tc, p, k_td, k_ld, eps_lim, alpha, beta, m }
    }

    /// Energies, invariants, failure (Eq. 4.10–4.15, section 4.4.2) from the invariants.
    pub fn state(&self, [i_el, i_tc, i_td, i_ld]: [f64; 4]) -> [f64; HYPERELASTIC_STATE] {
        let fails = i_el > 0.0 && self.eps_lim > 0.0;
        let compaction = (-i_tc).max(0.0);
        let index = i_el / self.eps_lim.ln_1p() + self.alpha * compaction + self.beta * i_td;
        let index = if fails { index } else { 0.0 };
        let failed = if index >= 1.0 { 1.0 } else { 0.0 };
        [
            0.5 * self.k_el * i_el.max(0.0).powi(2),
            self.k_tc * compaction.powf(self.p),
            0.5 * self.k_td * i_td * i_td,
            0.5 * self.k_ld * i_ld * i_ld,
            i_el,
            i_tc,
            i_td,
            i_ld,
            index,
            failed,
            1.0 - failed,
        ]
    }
}

/// 11 22 33 12 23 31 of a symmetric tensor.
pub fn components(s: &Matrix3<f64>) -> [f64; 6] {
    [s.m11, s.m22, s.m33, s.m12, s.m23, s.m31]
}
