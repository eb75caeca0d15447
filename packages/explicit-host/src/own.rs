//! Elements of a law that the host knows by its description alone.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use super::lanes::Number;
use toron::law::description::Description;
use toron_materials::entries::own_block::{BlockLaw, OwnBlock};
use toron_materials::material::own_law::Own;
use toron_shared::error::Error;

/// Rows behind the state of a law that counts no energies: the work done on the element, and P at the end of the last
/// step by columns.
const COUNTED: usize = 1 + 9;

/// A law by its description: which one it is is chosen once a block.
#[derive(Clone)]
pub struct OwnEntry<T> {
    law: Arc<dyn BlockLaw<T>>,
    name: String,
    /// The number of the law's state variables.
    state: usize,
    pub failed: usize,
    energies: Range<usize>,
    lost: Option<usize>,
}

impl<T> fmt::Debug for OwnEntry<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name)
    }
}

/// A block of its elements in a step: F at both ends by columns, and what the law makes of them.
pub struct Elements<'a, T> {
    pub n: usize,
    pub stride: usize,
    pub f_old: &'a mut [T],
    pub f: &'a [T],
    pub state: &'a mut [T],
    pub stress: &'a mut [T],
    pub density: T,
    pub wave_speed: &'a mut [T],
    pub status: &'a mut [i32],
    /// The length of the step, and the time at its end.
    pub step: f64,
    pub time: f64,
}

impl<T: Number> OwnEntry<T> {
    /// # Errors
    /// A property does not fit the precision.
    pub fn new(own: &Own) -> Result<Self, Error> {
        let Description { state, failed, energies, lost, .. } = &own.law.description;
        let name = own.law.name.clone();
        let law = own.block_law().map_err(|error| Error::Input(format!("the law {name}: {error}")))?;
        Ok(OwnEntry { law, name, state: state.len(), failed: *failed, energies: energies.clone(), lost: *lost })
    }

    /// How many rows are kept for it.
    pub fn rows(&self) -> usize {
        if self.energies.is_empty() { self.state + COUNTED } else { self.state }
    }

    /// The rows whose sum is the energy by reference volume: that of the law, or the work that is counted here.
    pub fn energies(&self) -> Range<usize> {
        if self.energies.is_empty() { self.state..self.state + 1 } else { self.energies.clone() }
    }

    /// The row of the energy lost. The work of a law that counts no energies has it already.
    pub fn lost(&self) -> Option<usize> {
        self.lost.filter(|_| !self.energies.is_empty())
    }

    /// From the deformation gradients to stresses and wave speeds; updates the history. Returns the law's code.
    pub fn advance(&self, elements: Elements<'_, T>) -> i32 {
        let Elements { n, stride, f_old, f, state, stress, density, wave_speed, status, step, time } = elements;
        let (of_law, counts) = (self.state * stride, self.energies.is_empty());
        let (state, counted) = state.split_at_mut(of_law);
        if counts {
            // Of elements that are there.
            let failed = &state[self.failed * stride..];
            add_work([n, stride], [f_old, f], counted, |i| failed[i] == T::default());
        }
        let code = self.law.evaluate(OwnBlock {
            n,
            leading_dimension: stride,
            f_old,
            f_new: f,
            time_increment: step,
            time,
            state,
            stress,
            density,
            wave_speed,
            status,
        });
        if counts {
            store_nominal([n, stride], f, stress, &mut counted[stride..]);
            add_work([n, stride], [f_old, f], counted, |_| true);
        }
        f_old.copy_from_slice(&f[..9 * stride]);
        code
    }
}

/// Adds ½ P : ΔF of the step to the first row, where an element takes part and has any stress; P by columns is in the
/// rows behind it.
fn add_work<T: Number>(
    [n, stride]: [usize; 2],
    [f_old, f]: [&[T]; 2],
    rows: &mut [T],
    takes_part: impl Fn(usize) -> bool,
) {
    let (work, nominal) = rows.split_at_mut(stride);
    for i in (0..n).filter(|&i| takes_part(i)) {
        let entries = (0..9).map(|c| c * stride + i);
        if entries.clone().all(|entry| nominal[entry] == T::default()) {
            continue;
        }
        let twice = entries.fold(T::default(), |sum, entry| sum + nominal[entry] * (f[entry] - f_old[entry]));
        work[i] += T::from_f64(0.5) * twice;
    }
}

/// P = σ cof F by columns; 0 where there is no stress, whatever F is.
fn store_nominal<T: Number>([n, stride]: [usize; 2], f: &[T], stress: &[T], nominal: &mut [T]) {
    for i in 0..n {
        let column = |j: usize| [f[3 * j * stride + i], f[(3 * j + 1) * stride + i], f[(3 * j + 2) * stride + i]];
        let [a, b, c] = [column(0), column(1), column(2)];
        let s: [T; 6] = std::array::from_fn(|k| stress[k * stride + i]);
        let none = s.iter().all(|&component| component == T::default());
        let rows = [[s[0], s[3], s[5]], [s[3], s[1], s[4]], [s[5], s[4], s[2]]];
        for (j, [x, y, z]) in [cross(b, c), cross(c, a), cross(a, b)].into_iter().enumerate() {
            for (k, row) in rows.iter().enumerate() {
                let p = if none { T::default() } else { row[0] * x + row[1] * y + row[2] * z };
                nominal[(3 * j + k) * stride + i] = p;
            }
        }
    }
}

fn cross<T: Number>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
