//! How the parameters move with the range of data that they are fitted to.

use super::data::{DataSet, Loading};
use super::fit::{Fit, Problem};

/// Parts of the largest distance from rest up to which data are kept.
pub const PARTS: [f64; 3] = [0.5, 0.75, 1.0];

/// The fit to each part of the range; `None` where the data that are left do not suffice.
pub fn by_range(problem: &Problem) -> [Option<Fit>; PARTS.len()] {
    PARTS.map(|part| {
        let sets = problem.sets.iter().map(|set| up_to(set, part)).collect();
        Problem { sets, ..problem.clone() }.fit().ok()
    })
}

/// Failure points are no curve and stay whole.
fn up_to(set: &DataSet, part: f64) -> DataSet {
    if matches!(set.loading, Loading::Failure { .. }) {
        return set.clone();
    }
    let largest = (0..set.len()).map(|i| set.distance(i)).fold(0.0, f64::max);
    set.up_to(part * largest)
}
