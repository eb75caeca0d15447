//! A St. Venant–Kirchhoff solid, transversely isotropic about the fibre: S = C E between the second Piola–Kirchhoff
//! stress and Green's strain, with the energy ½ E:S. The laws of the library are for yarns; this is what yarns are made
//! of.
//!
//! Pressed far, such a solid collapses: where the section has the stretch √c on all sides, its stiffness against shear
//! falls from G to G c + ½ (C22 + C23)(c − 1), none at c = (C22 + C23)/(2 C22), which is a stretch of 0.79 for the
//! thesis's fibres. Therefore strain in the section is that of Green down to the stretch √c0 at which a part of that
//! stiffness is left, and logarithmic from there on, which does not soften: of the principal squares c it is ½ (c − 1),
//! and then ½ (c0 − 1 + c0 ln(c/c0)), with the same slope at c0. The energy is ½ E:C E of this strain, the stress its
//! slope.

use super::lanes::Number;
use toron::law::status;

/// The strain is Green's down to the stretch at which, if all sides had it, this part of the stiffness against shear
/// would be left.
const KEPT: f64 = 0.05;
/// Squares of the principal stretches that differ by less than twice this are taken for the same.
const ALIKE: f64 = 1e-8;

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
    /// The square of the stretch in the section below which strain is logarithmic.
    pub logarithmic: f64,
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
        // G c + ½ (C22 + C23)(c − 1) is a part of G.
        let logarithmic = (KEPT * difference + sum) / (difference + sum);
        Solid {
            c_11: e_1 + 2.0 * nu_12 * c_12,
            c_12,
            c_22: 0.5 * (sum + difference),
            c_23: 0.5 * (sum - difference),
            g_12,
            g_23,
            logarithmic,
        }
    }

    /// For F by columns.
    #[inline(always)]
    pub fn evaluate(&self, f: &[f64; 9]) -> Answer {
        let [a, b, c] = [[f[0], f[1], f[2]], [f[3], f[4], f[5]], [f[6], f[7], f[8]]];
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let (e11, e12, e31) = (0.5 * (dot(a, a) - 1.0), 0.5 * dot(a, b), 0.5 * dot(c, a));
        let section = SectionStrain::new([dot(b, b), dot(c, c), dot(b, c)], self.logarithmic);
        let [e22, e33, e23] = section.strain;
        let s11 = self.c_11 * e11 + self.c_12 * (e22 + e33);
        let s22 = self.c_12 * e11 + self.c_22 * e22 + self.c_23 * e33;
        let s33 = self.c_12 * e11 + self.c_23 * e22 + self.c_22 * e33;
        let [s12, s23, s31] = [2.0 * self.g_12 * e12, 2.0 * self.g_23 * e23, 2.0 * self.g_12 * e31];
        let energy = 0.5 * (s11 * e11 + s22 * e22 + s33 * e33) + s12 * e12 + s23 * e23 + s31 * e31;
        let [s22, s33, s23] = section.slope([s22, s33, s23]);
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
        // In the current placement the stiffness is that at rest times the fourth power of the stretch, and stress adds
        // to it.
        let square = (dot(b, b).max(dot(c, c)) + dot(b, c).abs()).max(1.0);
        let largest = (yy.abs() + xy.abs() + yz.abs()).max(zz.abs() + zx.abs() + yz.abs());
        Answer {
            stress,
            energy,
            von_mises: (0.5 * normal + 3.0 * (xy * xy + yz * yz + zx * zx)).sqrt(),
            wave_modulus: square * square * self.c_22.max(self.g_12) + j * largest,
            upright: j > 0.0,
        }
    }

    /// For a block of elements, arrays component-major: stress, state and wave speed from F; in `status` whether F has
    /// turned an element inside out.
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

/// The strain in the section, 22 33 23, of the metric there, and how it follows the metric.
struct SectionStrain {
    strain: [f64; 3],
    /// Where it is not Green's.
    turned: Option<Turned>,
}

/// In the metric's principal axes: their cosine and sine of twice the angle, the slopes 2 de/dc of the principal
/// strains, and, for shear, the difference of these strains over half of that of the squares.
struct Turned {
    twice: [f64; 2],
    slopes: [f64; 2],
    shear: f64,
}

impl SectionStrain {
    #[inline(always)]
    fn new([c22, c33, c23]: [f64; 3], logarithmic: f64) -> SectionStrain {
        let (mean, half) = (0.5 * (c22 + c33), 0.5 * (c22 - c33));
        let radius = half.hypot(c23);
        // What is turned inside out has no logarithm.
        let least = (mean - radius).max(f64::MIN_POSITIVE);
        if least >= logarithmic {
            return SectionStrain { strain: [0.5 * (c22 - 1.0), 0.5 * (c33 - 1.0), 0.5 * c23], turned: None };
        }
        let squares = [mean + radius, least];
        let strain = |c: f64| {
            if c >= logarithmic {
                0.5 * (c - 1.0)
            } else {
                0.5 * (logarithmic - 1.0 + logarithmic * (c / logarithmic).ln())
            }
        };
        let slopes = squares.map(|c| (logarithmic / c).max(1.0));
        let [high, low] = squares.map(strain);
        let twice = if radius > ALIKE { [half / radius, c23 / radius] } else { [1.0, 0.0] };
        let shear = if radius > ALIKE { (high - low) / radius } else { slopes[1] };
        let (middle, difference) = (0.5 * (high + low), 0.5 * (high - low));
        let strain = [middle + difference * twice[0], middle - difference * twice[0], difference * twice[1]];
        SectionStrain { strain, turned: Some(Turned { twice, slopes, shear }) }
    }

    /// From the energy's slope by this strain to that by Green's.
    #[inline(always)]
    fn slope(&self, [s22, s33, s23]: [f64; 3]) -> [f64; 3] {
        let Some(Turned { twice: [cosine, sine], slopes, shear }) = self.turned else { return [s22, s33, s23] };
        let (mean, half) = (0.5 * (s22 + s33), 0.5 * (s22 - s33));
        let (along, across) = (cosine * half + sine * s23, cosine * s23 - sine * half);
        let [high, low, across] = [slopes[0] * (mean + along), slopes[1] * (mean - along), shear * across];
        let (mean, along) = (0.5 * (high + low), 0.5 * (high - low));
        let half = cosine * along - sine * across;
        [mean + half, mean - half, sine * along + cosine * across]
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
    use std::f64::consts::PI;

    use nalgebra::Matrix3;

    use super::*;

    /// The fibres of the thesis, in GPa.
    fn solid() -> Solid {
        Solid::new([84.62, 1.34], [0.6, 0.24], [24.4, 0.54])
    }

    fn columns(f: &Matrix3<f64>) -> [f64; 9] {
        std::array::from_fn(|i| f[i])
    }

    #[track_caller]
    fn assert_slope(f: &Matrix3<f64>, tolerance: f64) {
        let [s11, s22, s33, s12, s23, s31] = solid().evaluate(&columns(f)).stress;
        let stress = Matrix3::new(s11, s12, s31, s12, s22, s23, s31, s23, s33);
        let nominal = f.determinant() * stress * f.try_inverse().expect("it is regular").transpose();
        let step = 1e-6;
        for i in 0..9 {
            let [low, high] = [-step, step].map(|change| {
                let mut f = *f;
                f[i] += change;
                solid().evaluate(&columns(&f)).energy
            });
            let slope = (high - low) / (2.0 * step);
            assert!((slope - nominal[i]).abs() < tolerance, "{i}: {slope} {}", nominal[i]);
        }
    }

    #[test]
    fn stress_is_the_slope_of_the_energy() {
        assert_slope(&Matrix3::new(1.1, -0.2, 0.1, 0.3, 0.9, -0.15, -0.1, 0.2, 0.8), 1e-6);
    }

    /// As above, in sections that are pressed so far that the strain is logarithmic along one axis, along both, and
    /// alike.
    #[test]
    fn stress_is_the_slope_of_the_energy_far_down() {
        let turned = Matrix3::new(1.0, 0.0, 0.0, 0.0, 0.8, -0.6, 0.0, 0.6, 0.8);
        for [along, across, slant] in [[1.1, 0.5, 0.2], [0.6, 0.4, 0.1], [0.5, 0.5, 0.0], [0.6, 0.6, 1e-9]] {
            let section = Matrix3::new(1.05, 0.0, 0.0, 0.1, along, slant, -0.05, 0.0, across);
            assert_slope(&(turned * section), 1e-6);
        }
    }

    /// No stiffness is lost, however far a section is pressed: the energy of a small shear grows with its square, where
    /// a solid that is linear in Green's strain throughout has none any more.
    #[test]
    fn a_section_that_is_pressed_from_all_sides_does_not_collapse() {
        let stiffness = |solid: &Solid, stretch: f64| {
            let energy = |shear: f64| {
                let f = Matrix3::new(1.0, 0.0, 0.0, 0.0, stretch, shear, 0.0, 0.0, stretch);
                solid.evaluate(&columns(&f)).energy
            };
            (energy(1e-3) + energy(-1e-3) - 2.0 * energy(0.0)) / 1e-6
        };
        let (solid, green) = (solid(), Solid { logarithmic: 0.0, ..solid() });
        for stretch in [1.0, 0.9, 0.81] {
            assert!((stiffness(&solid, stretch) / stiffness(&green, stretch) - 1.0).abs() < 1e-6);
        }
        assert!(stiffness(&green, 0.795) > 0.0 && stiffness(&green, 0.785) < 0.0);
        let kept = stiffness(&solid, solid.logarithmic.sqrt() * 1.0001);
        for stretch in [0.795, 0.7, 0.5, 0.1] {
            assert!(stiffness(&solid, stretch) > kept, "{stretch}");
        }
    }

    /// In the plane of the section, ρ0 c² of a wave of direction n that moves along a is the second slope of the energy
    /// along a ⊗ Fᵀn.
    #[test]
    fn no_wave_is_faster_than_the_bound() {
        // Nothing shears along the fibre, and its modulus, which is in the bound, would hide the others.
        let solid = Solid { g_12: 0.54, ..solid() };
        let mut random = fastrand::Rng::with_seed(3);
        let mut nearest: f64 = 0.0;
        for _ in 0..20_000 {
            let mut number = |low: f64, high: f64| low + (high - low) * random.f64();
            let [first, second] = [number(0.35, 1.3), number(0.35, 1.3)];
            let angles = [number(0.0, PI), number(0.0, PI), number(0.0, PI)];
            let turned = |angle: f64| nalgebra::Rotation3::from_axis_angle(&nalgebra::Vector3::x_axis(), angle);
            let f = turned(angles[0]) * Matrix3::from_diagonal(&[1.0, first, second].into()) * turned(angles[1]);
            let n = turned(angles[2]) * nalgebra::Vector3::y();
            for a in [n, turned(0.5 * PI) * n] {
                let step = 1e-4 * a * (f.transpose() * n).transpose();
                let energy = |times: f64| solid.evaluate(&columns(&(f + times * step))).energy;
                let stiffness = (energy(1.0) + energy(-1.0) - 2.0 * energy(0.0)) / 1e-8;
                let bound = solid.evaluate(&columns(&f)).wave_modulus;
                assert!(stiffness < bound, "{stiffness} {bound} {f} {n} {a}");
                nearest = nearest.max(stiffness / bound);
            }
        }
        assert!(nearest > 0.7, "{nearest}");
    }

    /// Pressed along axis 2 with axes 1 and 3 held: S22 = C22 E22. And pressed with axis 3 free: S22 = E22/(S22 −
    /// S12²/S11 of the compliances), the modulus of plane strain.
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
