//! Derivatives of a law's own stress by central differences, extrapolated (Ridders 1982), with an estimate of their
//! error.

use super::call::{Answer, Call, Session};
use super::kinematics::{Components, Modulus, exp, of_stress, rotation_of, unit_strain};
use super::point::{Point, global};

/// Largest relative error of a modulus that is right.
pub const TOLERANCE: f64 = 1e-4;
/// A soft direction counts against this part of the stiffest one.
const SOFTEST: f64 = 1e-4;

/// What each entry is measured by: the stiffness of its row and column.
pub fn scale(truth: &Modulus, components: usize) -> Modulus {
    let largest = truth.iter().flatten().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
    let mut scale = [[f64::INFINITY; 6]; 6];
    for i in 0..components {
        for j in 0..components {
            let of_both = (truth[i][i] * truth[j][j]).abs().sqrt();
            scale[i][j] = of_both.max(truth[i][j].abs()).max(SOFTEST * largest).max(f64::MIN_POSITIVE);
        }
    }
    scale
}

/// The largest step of strain, and how many halvings follow; of a stress that moves in steps fewer do.
const LARGEST: f64 = 2e-3;
const HALVINGS: usize = 10;
const HALVINGS_OF_STEPS: usize = 2;
/// Columns of the extrapolation.
const ORDERS: usize = 4;

/// What one-sided slopes leave of their jump if the step is halved, where the stress is smooth: a half, with some room.
const SMOOTH: f64 = 0.75;

/// A modulus by differences.
#[derive(Clone, Debug)]
pub struct Derivative {
    pub value: Modulus,
    pub error: Modulus,
    /// Where forward and backward differences do not meet with any step.
    pub kinks: [[bool; 6]; 6],
}

/// An entry as the differences of one step, and of the larger ones, have it.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    value: f64,
    error: f64,
    /// Between the forward and the backward slope, with this step and with twice the step.
    jumps: [f64; 2],
}

impl Candidate {
    /// No kink within the step that would spoil an entry measured by this.
    fn smooth(&self, scale: f64) -> bool {
        let [jump, before] = self.jumps;
        jump < 0.1 * TOLERANCE * scale || jump < SMOOTH * before
    }
}

/// A stress of the strain of one component of this size; none where the law refuses.
type Stress<'a> = dyn FnMut(usize, f64) -> Option<Components> + 'a;

fn differences(components: usize, halvings: usize, stress: &mut Stress) -> Option<Derivative> {
    let columns = (0..components).map(|column| candidates(column, halvings, stress));
    let columns: Option<Vec<[Vec<Candidate>; 6]>> = columns.collect();
    let columns = columns?;
    let (value, error) = chosen(&columns, |_, _, _| true);
    let scale = scale(&value, components);
    let (smooth, error_of_smooth) = chosen(&columns, |i, j, candidate| candidate.smooth(scale[i][j]));
    let mut all = Derivative { value: smooth, error: error_of_smooth, kinks: [[false; 6]; 6] };
    for i in 0..components {
        for j in 0..components {
            if !all.error[i][j].is_finite() {
                (all.value[i][j], all.error[i][j]) = (value[i][j], error[i][j]);
                all.kinks[i][j] = error[i][j].is_finite();
            }
        }
    }
    all.value.iter().flatten().all(|entry| entry.is_finite()).then_some(all)
}

/// Of each entry the candidate with the least error, among those that are taken.
fn chosen(columns: &[[Vec<Candidate>; 6]], taken: impl Fn(usize, usize, &Candidate) -> bool) -> (Modulus, Modulus) {
    let (mut value, mut error) = ([[0.0; 6]; 6], [[f64::INFINITY; 6]; 6]);
    for (j, rows) in columns.iter().enumerate() {
        for (i, candidates) in rows.iter().enumerate() {
            for candidate in candidates.iter().filter(|candidate| taken(i, j, candidate)) {
                if candidate.error < error[i][j] {
                    (value[i][j], error[i][j]) = (candidate.value, candidate.error);
                }
            }
        }
    }
    (value, error)
}

/// The entries of a column, by rows, with ever smaller steps.
fn candidates(column: usize, halvings: usize, stress: &mut Stress) -> Option<[Vec<Candidate>; 6]> {
    let centre = stress(column, 0.0)?;
    let mut all: [Vec<Candidate>; 6] = Default::default();
    let mut above: Vec<Components> = Vec::new();
    let mut jumps_before: Components = [0.0; 6];
    for k in 0..=halvings {
        let size = LARGEST / (1 << k) as f64;
        let (Some(plus), Some(minus)) = (stress(column, size), stress(column, -size)) else {
            above.clear();
            continue;
        };
        let jumps: Components = std::array::from_fn(|i| (plus[i] - 2.0 * centre[i] + minus[i]).abs() / size);
        let mut row = vec![std::array::from_fn(|i| (plus[i] - minus[i]) / (2.0 * size))];
        for order in 1..ORDERS.min(above.len() + 1) {
            let factor = 4f64.powi(order as i32);
            let (coarse, fine): (&Components, &Components) = (&above[order - 1], &row[order - 1]);
            let next: Components = std::array::from_fn(|i| (factor * fine[i] - coarse[i]) / (factor - 1.0));
            for (i, candidates) in all.iter_mut().enumerate() {
                let rounding = f64::EPSILON * (plus[i].abs() + minus[i].abs()) / size;
                let error = (next[i] - fine[i]).abs().max((next[i] - coarse[i]).abs()) + rounding;
                candidates.push(Candidate { value: next[i], error, jumps: [jumps[i], jumps_before[i]] });
            }
            row.push(next);
        }
        (above, jumps_before) = (row, jumps);
    }
    Some(all)
}

fn halvings(session: &Session) -> usize {
    if session.coarse { HALVINGS_OF_STEPS } else { HALVINGS }
}

fn answered(answer: &Answer) -> bool {
    !answer.refused() && answer.stress.iter().all(|value| value.is_finite())
}

/// The Jaumann rate of the Kirchhoff stress over J: the deformation at the increment's end is strained further, without
/// rotation.
pub fn of_deformation(
    session: &mut Session,
    point: &Point,
    base: &Call,
    f1: &nalgebra::Matrix3<f64>,
) -> Option<Derivative> {
    let material = session.material;
    let components = material.components;
    let volume = f1.determinant();
    let axes = if material.orientation { rotation_of(f1) } else { nalgebra::Matrix3::identity() };
    differences(components, halvings(session), &mut |column, size| {
        let strain = axes * unit_strain(components, column) * axes.transpose();
        let strained = exp(&(strain * size)) * f1;
        let mut call = point.call(&strained, material);
        call.time_step = base.time_step;
        let answer = session.call_law(&call);
        let kirchhoff = global(&answer.stress, &strained, material) * (strained.determinant() / volume);
        answered(&answer).then(|| of_stress(&(axes.transpose() * kirchhoff * axes), components))
    })
}

/// The plain ∂Δσ/∂Δε: the strain increment grows, the rotation stays.
pub fn of_strain_increment(session: &mut Session, base: &Call) -> Option<Derivative> {
    let components = session.material.components;
    differences(components, halvings(session), &mut |column, size| {
        let mut call = base.clone();
        call.strain_increment[column] += size;
        call.f1 = exp(&(unit_strain(components, column) * size)) * base.f1;
        let answer = session.call_law(&call);
        answered(&answer).then_some(answer.stress)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_smooth_function_a_kink_and_noise() {
        let smooth = differences(3, HALVINGS, &mut |column, h| {
            Some(std::array::from_fn(|i| ((i + 1) as f64 * (0.3 + h)).exp() * (column + 1) as f64))
        });
        let smooth = smooth.expect("finite");
        for column in 0..3 {
            for i in 0..3 {
                let exact = (i + 1) as f64 * (0.3 * (i + 1) as f64).exp() * (column + 1) as f64;
                let error = (smooth.value[i][column] - exact).abs();
                assert!(error < 1e-9 * exact, "{error}");
                assert!(error < 10.0 * smooth.error[i][column] + 1e-12 * exact);
            }
        }
        assert_eq!(smooth.kinks, [[false; 6]; 6]);

        for away in [0.0, 1e-12, -1e-9, 1e-7, -5e-7] {
            let kinked = differences(3, HALVINGS, &mut |_, h| Some([if h > away { 2.0 * h - away } else { h }; 6]));
            let kinked = kinked.expect("finite");
            assert!(kinked.kinks[..3].iter().all(|row| row[..3] == [true; 3]), "{away}");
        }
        // A kink beside the state is outside the smaller steps: never the mean of both sides.
        for (away, slope) in [(1e-4, 1.0), (1e-5, 1.0), (-1e-4, 2.0), (-1e-5, 2.0), (4e-6, 1.0), (-2.5e-6, 2.0)] {
            let kinked = differences(3, HALVINGS, &mut |_, h| Some([if h > away { 2.0 * h - away } else { h }; 6]));
            let kinked = kinked.expect("finite");
            let sure = !kinked.kinks[0][0] && kinked.error[0][0] < 0.1 * TOLERANCE;
            assert!(!sure || (kinked.value[0][0] - slope).abs() < TOLERANCE, "{away}: {kinked:?}");
        }

        let noisy = differences(3, HALVINGS, &mut |_, h| Some([h + 1e-4 * (1e9 * h).sin(); 6])).expect("finite");
        assert!(noisy.error[0][0] > 1e-4, "{}", noisy.error[0][0]);
    }
}
