//! A St. Venant–Kirchhoff solid, transversely isotropic about the fibre: S = C E between the second Piola–Kirchhoff stress and
//! Green's strain, with the energy ½ E:S. The laws of the library are for yarns; this is what yarns are made of.

use super::lanes::Number;
use toron::law::status;

/// Rows of the state: energy by reference volume, the latch (which nothing sets), von Mises stress.
pub const SOLID_STATE: usize = 3;
pub const SOLID_WORK: usize = 0;
pub const SOLID_FAILED: usize = 1;
pub const SOLID_VON_MISES: usize = 2;

/// Stiffnesses, with the fibre along axis 1; c_33 is c_22, c_13 is c_12.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solid {
    pub c_11: f64,
    pub c_12: f64,
    pub c_22: f64,
    pub c_23: f64,
    pub g_12: f64,
    pub g_23: f64,
}

/// What the solid answers a deformation gradient with.
#[derive(Clone, Copy, Debug)]
pub struct Answer {
    /// Cauchy stress, 11 22 33 12 23 31.
    pub stress: [f64; 6],
    /// By reference volume.
    pub energy: f64,
    pub von_mises: f64,
    /// The density times the square of the speed of waves: a bound for those that run and move across the fibre.
    pub wave_modulus: f64,
    /// Whether F turns nothing inside out.
    pub upright: bool,
}

impl Solid {
    /// From the moduli: `nu_12` is the contraction across over the extension along, pulled along.
    pub fn new([e_1, e_2]: [f64; 2], [nu_12, nu_23]: [f64; 2], [g_12, g_23]: [f64; 2]) -> Solid {
        // E11 = (S11 − ν12 (S22 + S33))/E1, E22 = (S22 − ν23 S33)/E2 − ν12 S11/E1, solved for S.
        let rest = 1.0 - nu_23 - 2.0 * nu_12 * nu_12 * e_2 / e_1;
        let c_12 = nu_12 * e_2 / rest;
        let [sum, difference] = [e_2 / rest, e_2 / (1.0 + nu_23)];
        Solid {
            c_11: e_1 + 2.0 * nu_12 * c_12,
            c_12,
            c_22: 0.5 * (sum + difference),
            c_23: 0.5 * (sum - difference),
            g_12,
            g_23,
        }
    }

    /// For F by columns.
    #[inline(always)]
    pub fn evaluate(&self, f: &[f64; 9]) -> Answer {
        let [a, b, c] = [[f[0], f[1], f[2]], [f[3], f[4], f[5]], [f[6], f[7], f[8]]];
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let [e11, e22, e33] = [0.5 * (dot(a, a) - 1.0), 0.5 * (dot(b, b) - 1.0), 0.5 * (dot(c, c) - 1.0)];
        let [e12, e23, e31] = [0.5 * dot(a, b), 0.5 * dot(b, c), 0.5 * dot(c, a)];
        let s11 = self.c_11 * e11 + self.c_12 * (e22 + e33);
        let s22 = self.c_12 * e11 + self.c_22 * e22 + self.c_23 * e33;
        let s33 = self.c_12 * e11 + self.c_23 * e22 + self.c_22 * e33;
        let [s12, s23, s31] = [2.0 * self.g_12 * e12, 2.0 * self.g_23 * e23, 2.0 * self.g_12 * e31];
        let energy = 0.5 * (s11 * e11 + s22 * e22 + s33 * e33) + s12 * e12 + s23 * e23 + s31 * e31;
        let j = a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0]);
        // σ = F S Fᵀ/J
        let push = |i: usize, k: usize| {
            let mixed = s12 * (a[i] * b[k] + b[i] * a[k])
                + s23 * (b[i] * c[k] + c[i] * b[k])
                + s31 * (c[i] * a[k] + a[i] * c[k]);
            (s11 * a[i] * a[k] + s22 * b[i] * b[k] + s33 * c[i] * c[k] + mixed) / j
        };
        let stress = [push(0, 0), push(1, 1), push(2, 2), push(0, 1), push(1, 2), push(2, 0)];
        let [xx, yy, zz, xy, yz, zx] = stress;
        let normal = (xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) + (zz - xx) * (zz - xx);
        // In the current placement the stiffness is that at rest times the fourth power of the stretch, and stress adds to it.
        let square = 1.0 + 2.0 * (e22.max(e33) + e23.abs()).max(0.0);
        let largest = (yy.abs() + xy.abs() + yz.abs()).max(zz.abs() + zx.abs() + yz.abs());
        Answer {
            stress,
            energy,
            von_mises: (0.5 * normal + 3.0 * (xy * xy + yz * yz + zx * zx)).sqrt(),
            wave_modulus: square * square * self.c_22.max(self.g_12) + j * largest,
            upright: j > 0.0,
        }
    }

    /// For a block of elements, arrays component-major: stress, state and wave speed from F; in `status` whether F has turned
    /// an element inside out.
    pub fn evaluate_block<T: Number>(&self, density: f64, f: &[T], n: usize, stride: usize, to: Block<T>) {
        for i in 0..n {
            let f: [f64; 9] = std::array::from_fn(|c| f[c * stride + i].into());
            let answer = self.evaluate(&f);
            for (c, stress) in answer.stress.into_iter().enumerate() {
                to.stress[c * stride + i] = T::from_f64(stress);
            }
            to.state[SOLID_WORK * stride + i] = T::from_f64(answer.energy);
            to.state[SOLID_VON_MISES * stride + i] = T::from_f64(answer.von_mises);
            to.wave_speed[i] = T::from_f64((answer.wave_modulus / density).sqrt());
            to.status[i] = if answer.upright { status::OK } else { status::INVERTED };
        }
    }
}

/// Where a block's results go.
pub struct Block<'a, T> {
    pub stress: &'a mut [T],
    pub state: &'a mut [T],
    pub wave_speed: &'a mut [T],
    pub status: &'a mut [i32],
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix3;

    use super::*;

    /// The fibres of the thesis, in GPa.
    fn solid() -> Solid {
        Solid::new([84.62, 1.34], [0.6, 0.24], [24.4, 0.54])
    }

    fn columns(f: &Matrix3<f64>) -> [f64; 9] {
        std::array::from_fn(|i| f[i])
    }

    #[test]
    fn stress_is_the_slope_of_the_energy() {
        let f = Matrix3::new(1.1, -0.2, 0.1, 0.3, 0.9, -0.15, -0.1, 0.2, 0.8);
        let [s11, s22, s33, s12, s23, s31] = solid().evaluate(&columns(&f)).stress;
        let stress = Matrix3::new(s11, s12, s31, s12, s22, s23, s31, s23, s33);
        let nominal = f.determinant() * stress * f.try_inverse().expect("it is regular").transpose();
        let step = 1e-6;
        for i in 0..9 {
            let [low, high] = [-step, step].map(|change| {
                let mut f = f;
                f[i] += change;
                solid().evaluate(&columns(&f)).energy
            });
            assert!(((high - low) / (2.0 * step) - nominal[i]).abs() < 1e-6, "{i}");
        }
    }

    /// Pressed along axis 2 with axes 1 and 3 held: S22 = C22 E22. And pressed with axis 3 free: S22 = E22/(S22 − S12²/S11 of the
    /// compliances), the modulus of plane strain.
    #[test]
    fn plane_strain_by_hand() {
        let Solid { c_12, c_22, c_23, .. } = solid();
        let stretch: f64 = 0.9;
        let strain = 0.5 * (stretch * stretch - 1.0);
        let answer = solid().evaluate(&columns(&Matrix3::from_diagonal(&[1.0, stretch, 1.0].into())));
        assert!((answer.stress[1] - stretch * c_22 * strain).abs() < 1e-14);
        assert!((answer.stress[0] - c_12 * strain / stretch).abs() < 1e-14);
        assert!((answer.energy - 0.5 * c_22 * strain * strain).abs() < 1e-14);
        // In the plane 1/E' = S22 − S12²/S11 and −ν'/E' = S23 − S12²/S11.
        let [own, cross] = [1.0, -0.24].map(|part| part / 1.34 - 0.6 * 0.6 / 84.62);
        assert!((c_22 - own / (own * own - cross * cross)).abs() < 1e-12);
        assert!((c_23 + cross / (own * own - cross * cross)).abs() < 1e-12);
    }
}
