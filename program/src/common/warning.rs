//! Warnings that the reports of explicit runs have in common.

/// The largest part of the internal energy that hourglass modes may hold without a warning.
const LARGEST_HOURGLASS: f64 = 0.1;

/// A warning where hourglass modes hold more of a case's largest internal energy than that; `remedy` says what to take instead.
pub fn hourglass(case: &str, share: f64, remedy: &str) -> Option<String> {
    (share > LARGEST_HOURGLASS).then(|| {
        format!(
            "warning: case {case}: hourglass energy is {:.1} % of the largest internal energy, more than {:.0} %:\n  take {remedy}\n",
            100.0 * share,
            100.0 * LARGEST_HOURGLASS
        )
    })
}
