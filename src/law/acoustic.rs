//! The acoustic tensor of a state: the speeds of its waves, and whether the material is elliptic.
//!
//! For a wave of direction n and polarisation u the acoustic tensor times the reference density is u·ρ0 Q(n)u =
//! c:(n⊗u)(n⊗u) + n·τn, with c the Truesdell modulus and τ the Kirchhoff stress. For a given n the extreme u is an
//! eigenvector of Q(n), for a given u the extreme n is one of c:(·⊗u)(·⊗u) + τ. Alternating between the two converges
//! to an extremum without a gradient or a step length; starts from many directions about the current frame find all
//! extrema.

use super::axes::FibreFrame;
use super::hyperelastic::Hyperelastic;
use super::kinematics::{Decomposition, Kinematics, Logarithms, Section, Strain, Stretch};
use super::number::real::Real;
use super::number::vector::{along, dot, scale};
use super::response::Request;
use super::state::HYPERELASTIC_STATE;
use super::status;
use super::stress::principal_axes;
use super::tangent::Measure;
use super::voigt::{VOIGT, columns};

/// The directions to start from have whole numbers up to this one as components: 109 directions, none farther than 14°
/// from the next.
const FINENESS: i32 = 3;
/// The most iterations from each start, and finally from the best result.
const ITERATIONS: i32 = 8;
const LAST_ITERATIONS: i32 = 200;

/// A plane wave of speed v in current lengths: ρ0 v² as a stress, direction and polarisation as unit vectors in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// ρ0 v².
    pub modulus: f64,
    pub direction: [f64; 3],
    pub polarisation: [f64; 3],
}

/// The acoustic tensors of one state.
#[derive(Clone, Copy, Debug)]
pub struct Acoustic {
    /// Truesdell modulus of the Cauchy stress, Cauchy stress, and J, by which both are multiplied for the Kirchhoff
    /// stress.
    modulus: [[f64; 6]; 6],
    stress: [f64; 6],
    jacobian: f64,
    /// The current frame, about which the directions are spread.
    frame: [[f64; 3]; 3],
}

impl Hyperelastic<f64> {
    /// The acoustic tensors of the intact material at `f` (columns of F); `fibre` is a fibre direction of any length,
    /// or `None` for that of the properties.
    ///
    /// # Errors
    /// The status code of a point that cannot be evaluated.
    pub fn acoustic(&self, f: &[[f64; 3]; 3], fibre: Option<[f64; 3]>) -> Result<Acoustic, i32> {
        let fresh = [0.0; HYPERELASTIC_STATE];
        let request = Request { stress: true, ..Request::default() };
        let (point, moduli) = self.point_with_moduli(f, fibre, &fresh, request, Measure::Truesdell);
        if point.status != status::OK {
            return Err(point.status);
        }
        let frame = fibre.map_or(self.frame, |fibre| FibreFrame::new(fibre).0);
        let (stretch, images) = Stretch::new(f, &frame);
        let (section, [a, b]) = Section::of_point(&stretch, images, &frame);
        let strain = Strain::new(&stretch, &section, &Logarithms::new(&stretch, &section));
        let kinematics =
            Kinematics { stretch: &stretch, section: &section, images: [images[0], a, b], strain: &strain, slid: None };
        let d = Decomposition::new(kinematics);
        let frame = [d.e, d.q1, d.q2()];
        Ok(Acoustic { modulus: moduli.matrix(), stress: point.stress, jacobian: d.jacobian, frame })
    }
}

impl Acoustic {
    /// ρ0 Q(n), 11 22 33 12 23 31.
    pub fn tensor(&self, n: [f64; 3]) -> [f64; 6] {
        let mut q = self.contracted(n);
        let normal = self.jacobian * quadratic(&self.stress, n);
        for diagonal in q.iter_mut().take(3) {
            *diagonal += normal;
        }
        q
    }

    /// The tensor A(u) = c:(·⊗u)(·⊗u) + τ with ρ0 v² = n·A n for waves of polarisation u, 11 22 33 12 23 31. Its
    /// extreme eigenvalues are those over all directions n.
    pub fn tensor_of_directions(&self, u: [f64; 3]) -> [f64; 6] {
        let mut tensor = self.contracted(u);
        for (entry, &stress) in tensor.iter_mut().zip(&self.stress) {
            *entry += self.jacobian * stress;
        }
        tensor
    }

    /// J c_ijkl v_j v_l; c being symmetric, J c_jilk v_j v_l as well.
    fn contracted(&self, v: [f64; 3]) -> [f64; 6] {
        let entry = |i: usize, k: usize| {
            let mut sum = 0.0;
            for (&row, &v_j) in VOIGT[i].iter().zip(&v) {
                let moduli = &self.modulus[row];
                let [a, b, c] = VOIGT[k];
                sum += v_j * dot([moduli[a], moduli[b], moduli[c]], v);
            }
            self.jacobian * sum
        };
        [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(2, 0)]
    }

    /// The wave of the smallest ρ0 v² over all directions. If that is below 0, the material is not elliptic.
    pub fn least(&self) -> Wave {
        self.extreme(-1.0)
    }

    /// The wave of the largest ρ0 v² over all directions.
    pub fn greatest(&self) -> Wave {
        self.extreme(1.0)
    }

    /// The wave of the largest (`sign` 1) or smallest (−1) ρ0 v² over all directions.
    fn extreme(&self, sign: f64) -> Wave {
        let mut best = self.polarised(self.frame[0], sign);
        let along_axis = -FINENESS..=FINENESS;
        for i in 0..=FINENESS {
            for j in along_axis.clone() {
                for k in along_axis.clone() {
                    if i.max(j.abs()).max(k.abs()) < FINENESS || (i == 0 && (j < 0 || (j == 0 && k < 0))) {
                        continue; // inside the cube, or opposite to another direction
                    }
                    let [e, q1, q2] = self.frame;
                    let n = along(along(scale(f64::from(i), e), f64::from(j), q1), f64::from(k), q2);
                    let wave = self.alternated(self.polarised(normalised(n), sign), sign, ITERATIONS);
                    if sign * wave.modulus > sign * best.modulus {
                        best = wave;
                    }
                }
            }
        }
        self.alternated(best, sign, LAST_ITERATIONS)
    }

    /// The wave of the largest (`sign` 1) or smallest (−1) ρ0 v² in one direction.
    fn polarised(&self, direction: [f64; 3], sign: f64) -> Wave {
        let (modulus, polarisation) = extreme_axis(&self.tensor(direction), sign);
        Wave { modulus, direction, polarisation }
    }

    /// Alternates between direction and polarisation until ρ0 v² no longer improves.
    fn alternated(&self, mut wave: Wave, sign: f64, iterations: i32) -> Wave {
        for _ in 0..iterations {
            let of_directions = self.tensor_of_directions(wave.polarisation);
            let next = self.polarised(extreme_axis(&of_directions, sign).1, sign);
            let gain = sign * (next.modulus - wave.modulus);
            if gain > 0.0 {
                wave = next;
            }
            if gain <= f64::EPSILON * wave.modulus.abs() {
                break;
            }
        }
        wave
    }
}

/// The largest (`sign` 1) or smallest (−1) eigenvalue of a symmetric tensor, and its axis.
fn extreme_axis(s: &[f64; 6], sign: f64) -> (f64, [f64; 3]) {
    let (values, axes) = principal_axes(s);
    let mut best = (values[0], axes[0]);
    for (&value, &axis) in values.iter().zip(&axes) {
        if sign * value > sign * best.0 {
            best = (value, axis);
        }
    }
    best
}

/// v·sv of a symmetric tensor s, 11 22 33 12 23 31.
fn quadratic(s: &[f64; 6], v: [f64; 3]) -> f64 {
    dot(v, columns(s).map(|column| dot(column, v)))
}

fn normalised(v: [f64; 3]) -> [f64; 3] {
    scale(1.0 / Real::sqrt(dot(v, v)), v)
}
