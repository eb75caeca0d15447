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

/// Steps by halves over which a jump of the slope stays, if it is that of a kink, or grows to twice as much with each,
/// if the state is on a branch that is narrower than the step; within this part. Where the stress is smooth the jump
/// falls to a half at least, and noise has no sign.
const KINK: usize = 4;
const ALIKE: f64 = 0.75;

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
    /// Of the extrapolation, of rounding, and of kinks within the step.
    error: f64,
}

/// The entries of a column, by rows.
#[derive(Default)]
struct Column {
    candidates: [Vec<Candidate>; 6],
    /// What stays of the slope's jump with the smallest steps.
    jump: Components,
}

/// A stress of the strain of one component of this size; none where the law refuses.
type Stress<'a> = dyn FnMut(usize, f64) -> Option<Components> + 'a;

fn differences(components: usize, halvings: usize, stress: &mut Stress) -> Option<Derivative> {
    let mut all = Derivative { value: [[0.0; 6]; 6], error: [[f64::INFINITY; 6]; 6], kinks: [[false; 6]; 6] };
    let mut jumps = [[0.0; 6]; 6];
    let columns: Option<Vec<Column>> = (0..components).map(|j| column(j, halvings, stress)).collect();
    for (j, column) in columns?.iter().enumerate() {
        for (i, candidates) in column.candidates.iter().enumerate() {
            for candidate in candidates {
                if candidate.error < all.error[i][j] {
                    (all.value[i][j], all.error[i][j]) = (candidate.value, candidate.error);
                }
            }
            jumps[i][j] = column.jump[i];
        }
    }
    let scale = scale(&all.value, components);
    all.kinks = std::array::from_fn(|i| std::array::from_fn(|j| jumps[i][j] > 0.1 * TOLERANCE * scale[i][j]));
    all.value.iter().flatten().all(|entry| entry.is_finite()).then_some(all)
}

/// A column with ever smaller steps.
fn column(column: usize, halvings: usize, stress: &mut Stress) -> Option<Column> {
    let centre = stress(column, 0.0)?;
    let mut all = Column::default();
    let (mut slopes, mut jumps) = (Extrapolation::new(4.0), Extrapolation::new(2.0));
    let mut left: [Vec<f64>; 6] = Default::default();
    for step in 0..=halvings {
        let size = LARGEST / (1 << step) as f64;
        let (Some(plus), Some(minus)) = (stress(column, size), stress(column, -size)) else {
            (slopes.rows, jumps.rows) = Default::default();
            left = Default::default();
            continue;
        };
        slopes.add(std::array::from_fn(|i| (plus[i] - minus[i]) / (2.0 * size)));
        jumps.add(std::array::from_fn(|i| (plus[i] - 2.0 * centre[i] + minus[i]) / size));
        let [above, row] = &slopes.rows;
        for (i, candidates) in all.candidates.iter_mut().enumerate() {
            for order in 1..row.len() {
                let [coarse, fine, value] = [above[order - 1][i], row[order - 1][i], row[order][i]];
                let rounding = f64::EPSILON * (plus[i].abs() + minus[i].abs()) / size;
                // Where the stress is smooth nothing is left of the jump; a kink adds up to a half of it to the slope.
                let kink = 0.5 * jumps.rows[1][order][i].abs();
                let error = (value - fine).abs().max((value - coarse).abs()).max(kink) + rounding;
                candidates.push(Candidate { value, error });
            }
            left[i].extend(jumps.rows[1].get(1).map(|jump| jump[i]));
            all.jump[i] = jump_that_stays(&left[i]);
            // Larger steps may end on one branch beyond it.
            for candidate in candidates.iter_mut() {
                candidate.error = candidate.error.max(0.5 * all.jump[i]);
            }
        }
    }
    Some(all)
}

/// The last of the jumps that are left, if the last few are those of a kink.
fn jump_that_stays(left: &[f64]) -> f64 {
    let Some(last) = left.len().checked_sub(KINK).map(|first| &left[first..]) else { return 0.0 };
    let grows = |by: f64| {
        last.windows(2).all(|two| {
            let alike = two[1] / (by * two[0]);
            alike > ALIKE && alike < 1.0 / ALIKE
        })
    };
    if grows(1.0) || grows(2.0) { last[KINK - 1].abs() } else { 0.0 }
}

/// The last two rows of Richardson's table of what is found with halved steps.
struct Extrapolation {
    rows: [Vec<Components>; 2],
    /// What a halving leaves of the error of the first column, as its inverse; of each further one a quarter of that.
    first: f64,
}

impl Extrapolation {
    fn new(first: f64) -> Self {
        Extrapolation { rows: Default::default(), first }
    }

    /// Adds what is found with half the last step.
    fn add(&mut self, found: Components) {
        let [_, above] = std::mem::take(&mut self.rows);
        let mut row = vec![found];
        for order in 1..ORDERS.min(above.len() + 1) {
            let factor = self.first * 4f64.powi(order as i32 - 1);
            let (coarse, fine): (&Components, &Components) = (&above[order - 1], &row[order - 1]);
            row.push(std::array::from_fn(|i| (factor * fine[i] - coarse[i]) / (factor - 1.0)));
        }
        self.rows = [above, row];
    }
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
    let (components, layout) = (session.material.components, session.material.layout());
    differences(components, halvings(session), &mut |column, size| {
        let mut call = base.clone();
        call.strain_increment[column] += size;
        call.f1 = exp(&(unit_strain(layout, column) * size)) * base.f1;
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

        // A weak one is not lost in the curvature, nor where larger steps are beyond another branch on either side.
        let between = |h: f64| h + (50.0 * h * h - 5e-3 * h).max(0.0);
        for weak in [&between as &dyn Fn(f64) -> f64, &|h| h + 10.0 * h * h + 1e-3 * h.max(1e-7)] {
            let kinked = differences(3, HALVINGS, &mut |_, h| Some([weak(h); 6])).expect("finite");
            assert!(kinked.kinks[..3].iter().all(|row| row[..3] == [true; 3]), "{kinked:?}");
        }
        // Nor is one of a branch that is narrower than nearly all steps.
        let narrow = |h: f64| h + 1e-2 * h.clamp(-2e-6, 3e-6);
        let kinked = differences(3, HALVINGS, &mut |_, h| Some([narrow(h); 6])).expect("finite");
        assert!((kinked.value[0][0] - 1.01).abs() < 20.0 * kinked.error[0][0], "{kinked:?}");
        let aside = |h: f64| h + 10.0 * h * h + 1e-3 * (h - 1e-5).max(0.0);
        let smooth = differences(3, HALVINGS, &mut |_, h| Some([aside(h); 6])).expect("finite");
        assert!(!smooth.kinks[0][0] && (smooth.value[0][0] - 1.0).abs() < 1e-8, "{smooth:?}");

        let noisy = differences(3, HALVINGS, &mut |_, h| Some([h + 1e-4 * (1e9 * h).sin(); 6])).expect("finite");
        assert!(noisy.error[0][0] > 1e-4, "{}", noisy.error[0][0]);
    }
}
