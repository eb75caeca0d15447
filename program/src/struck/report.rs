//! What the reports of all struck scenes say.

use super::run::Outcome;
use crate::common::text_table::folded;

/// What went on after the first failure, which no bound judges: a line of the cases in which something failed, and what part of the
/// energy that the blow had brought in viscosity has taken.
pub fn after_failure<'a, E, C>(cases: impl IntoIterator<Item = (&'a str, &'a Outcome<E, C>)>, width: usize) -> String
where
    E: Copy + Default + 'a,
    C: 'a,
{
    let share = |(name, outcome): (&str, &Outcome<E, C>)| {
        outcome.failed?;
        let (first, last) = (outcome.measured.first()?.energies, outcome.last().energies);
        let lost = first.projectile - last.projectile + last.external;
        Some(format!("{:.0} % in {name}", 100.0 * last.viscosity / lost))
    };
    let shares: Vec<String> = cases.into_iter().filter_map(share).collect();
    if shares.is_empty() {
        return String::new();
    }
    let text = format!(
        "No verdict is on what follows the first failure. Of the energy that the blow has given away, artificial viscosity took {}.",
        shares.join(", ")
    );
    folded(&text, width) + "\n"
}
