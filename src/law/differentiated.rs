//! The tangent of a law by forward differentiation of its stress.
//!
//! One point at a time: each lane of a register moves F in another direction, F + ε L F, so that two registers of four
//! numbers hold the six strains.

use super::linear_tangent::LinearTangent;
use super::number::dual::Dual;
use super::number::level::Level;
use super::number::real::{Lanes, WIDEST};
use super::number::registers::Registers;
use super::number::vector::{Matrix, image};
use super::tangent::Measure;
use super::voigt::PAIRS;

/// The Cauchy stress of a law as a function of F at the end of a step.
pub(super) trait Stress {
    /// What is the same for all motions.
    type Prepared<R: Lanes<f64>>;

    fn prepared<R: Lanes<f64>>(&self) -> Self::Prepared<R>;

    /// The stress 11 22 33 12 23 31 in each lane.
    fn stress<R: Lanes<f64>>(&mut self, prepared: &mut Self::Prepared<R>, f: &Matrix<Dual<R>>) -> [Dual<R>; 6];
}

/// The directions L of the motions F + ε L F: six strains, the shears of engineering measure 1, and nine entries 11 21
/// 31 12 22 32 13 23 33; filled up to whole registers.
const STRAINS: [Matrix<f64>; 8] = strains();
const ENTRIES: [Matrix<f64>; 16] = entries();

const fn strains() -> [Matrix<f64>; 8] {
    let (mut directions, mut c) = ([[[0.0; 3]; 3]; 8], 0);
    while c < 6 {
        let (k, l) = PAIRS[c];
        directions[c][k][l] += 0.5;
        directions[c][l][k] += 0.5;
        c += 1;
    }
    directions
}

const fn entries() -> [Matrix<f64>; 16] {
    let (mut directions, mut c) = ([[[0.0; 3]; 3]; 16], 0);
    while c < 9 {
        directions[c][c / 3][c % 3] = 1.0; // the column of L that it multiplies
        c += 1;
    }
    directions
}

/// The first number of a register.
#[inline(always)]
pub(super) fn first<R: Lanes<f64>>(x: R) -> f64 {
    let mut values = [0.0; WIDEST];
    // SAFETY: the widest register fits.
    unsafe { x.store(values.as_mut_ptr()) };
    values[0]
}

/// The derivatives of the stress at F by six strains, or for [`Measure::Nominal`] by nine motions, in instructions that
/// the processor has.
pub(super) struct Rates {
    rates: [[f64; 6]; 16],
    nominal: bool,
}

impl Rates {
    pub fn of<S: Stress>(law: &mut S, f: &Matrix<f64>, measure: Measure, level: Level) -> Self {
        let nominal = measure == Measure::Nominal;
        let directions: &[Matrix<f64>] = if nominal { &ENTRIES } else { &STRAINS };
        let mut rates = [[0.0; 6]; 16];
        match level.min(Level::best()) {
            // SAFETY: the processor has the level's instructions.
            #[cfg(target_arch = "x86_64")]
            Level::Avx2 | Level::Avx512 => unsafe { avx2(law, f, directions, &mut rates) },
            _ => along::<S, <f64 as Registers>::Baseline>(law, f, directions, &mut rates),
        }
        Rates { rates, nominal }
    }

    /// ∂τ/∂L over J, τ = Jσ, given σ. By strains the two motions of a shear have the mean of their derivatives.
    pub fn tangent(&self, cauchy: &[f64; 6]) -> LinearTangent {
        let mut tangent = LinearTangent::default();
        let mut column = |place: usize, rate: &[f64; 6], trace: f64| {
            let rate = core::array::from_fn(|c| rate[c] + trace * cauchy[c]);
            if let Some(to) = tangent.0.get_mut(place) {
                *to = rate;
            }
        };
        if self.nominal {
            for (c, rate) in self.rates.iter().enumerate().take(9) {
                column(c, rate, if c % 4 == 0 { 1.0 } else { 0.0 });
            }
        } else {
            for ((k, l), rate) in PAIRS.into_iter().zip(&self.rates) {
                for place in [k + 3 * l, l + 3 * k] {
                    column(place, rate, if k == l { 1.0 } else { 0.0 });
                }
            }
        }
        tangent
    }
}

/// # Safety
/// The processor has these instructions.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
unsafe fn avx2<S: Stress>(law: &mut S, f: &Matrix<f64>, directions: &[Matrix<f64>], rates: &mut [[f64; 6]; 16]) {
    along::<S, <f64 as Registers>::Avx2>(law, f, directions, rates);
}

/// Evaluates the law with derivatives along these motions, as many at a time as there are lanes.
#[inline(always)]
fn along<S: Stress, R: Lanes<f64>>(
    law: &mut S,
    f: &Matrix<f64>,
    directions: &[Matrix<f64>],
    rates: &mut [[f64; 6]; 16],
) {
    let mut prepared = law.prepared::<R>();
    let mut values = [0.0; WIDEST];
    for (directions, rates) in directions.chunks_exact(R::COUNT).zip(rates.chunks_exact_mut(R::COUNT)) {
        // The motions L F, one in each lane.
        let mut slopes = [[0.0; WIDEST]; 9];
        for (lane, l) in directions.iter().enumerate() {
            for (column, f) in f.iter().enumerate() {
                for (row, x) in image(l, *f).into_iter().enumerate() {
                    slopes[3 * column + row][lane] = x;
                }
            }
        }
        let mut moved = [[Dual::<R>::new(R::splat(0.0), R::splat(0.0)); 3]; 3];
        for ((to, &from), slope) in moved.as_flattened_mut().iter_mut().zip(f.as_flattened()).zip(&slopes) {
            // SAFETY: the widest register fits.
            *to = Dual::new(R::splat(from), unsafe { R::load(slope.as_ptr()) });
        }
        for (c, x) in law.stress(&mut prepared, &moved).into_iter().enumerate() {
            // SAFETY: as above.
            unsafe { x.slope.store(values.as_mut_ptr()) };
            for (rate, &value) in rates.iter_mut().zip(&values) {
                rate[c] = value;
            }
        }
    }
}
