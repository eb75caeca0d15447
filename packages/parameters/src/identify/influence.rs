//! Which test decides a parameter: one without which the others have an interval that does not hold the value that all
//! have together. It is named; nothing is left out by itself.

use super::data::DataSet;
use super::fit::{Fit, Group, Problem, leverages};
use super::least_squares::{Weighted, search};
use super::profile;
use super::report::digits;
use super::uncertainty::Estimate;
use toron_shared::numbers::number;

/// A sentence for each parameter that one point, or one of several sets, decides.
pub fn notes(problem: &Problem, fit: &Fit) -> Vec<String> {
    let mut notes = Vec::new();
    for group in &fit.groups {
        let points = point(problem, group).map(|(what, problem)| of_one(&what, &problem, fit, group));
        let sets = sets(problem, group).into_iter().flat_map(|(what, problem)| of_one(&what, &problem, fit, group));
        notes.extend(points.unwrap_or_default().into_iter().chain(sets));
    }
    notes
}

/// What the data say without one of them.
fn of_one(what: &str, rest: &Problem, fit: &Fit, group: &Group) -> Vec<String> {
    let Ok(without) = rest.fit() else { return Vec::new() };
    let decides = |without: &Fit| {
        let of = |estimate: &&Estimate| {
            let with = fit.values[estimate.parameter.index()].unwrap_or(estimate.value);
            let is_out = with < estimate.low || with > estimate.high;
            is_out && estimate.fitted && group.parameters.contains(&estimate.parameter)
        };
        without.estimates.iter().filter(of).copied().collect::<Vec<Estimate>>()
    };
    if decides(&without).is_empty() {
        return Vec::new();
    }
    // The linearised intervals may be too short.
    let without = profile::profiled(rest, without);
    let sentence = |estimate: &Estimate| {
        let name = estimate.parameter.name();
        let with = fit.values[estimate.parameter.index()].map_or_else(String::new, digits);
        format!(
            "{name} is decided by {what}: without it {name} is {} (95 %: {} to {}), and {with} with it. Nothing is left out by \
             itself; a reason in a column excluded, or excluded = \"reason\" of a set, does that",
            digits(estimate.value),
            digits(estimate.low),
            digits(estimate.high)
        )
    };
    decides(&without).iter().map(sentence).collect()
}

/// The point that moves the answer most, and the data without it.
fn point(problem: &Problem, group: &Group) -> Option<(String, Problem)> {
    let sets: Vec<&DataSet> = group.sets.iter().map(|&set| &problem.sets[set]).collect();
    let data = Weighted { sets: &sets, weights: &group.weights };
    let solution = search(data, &[], &group.values).ok()?;
    let leverages = leverages(&solution, &group.weights, &group.parameters);
    let moves = |i: &usize| {
        let left = (1.0 - leverages[*i]).max(f64::EPSILON);
        group.weights[*i].sqrt() * solution.residuals[*i].abs() * leverages[*i].sqrt() / left
    };
    let most = (0..leverages.len()).max_by(|a, b| moves(a).total_cmp(&moves(b)))?;
    let mut place = most;
    for &index in &group.sets {
        let set = &problem.sets[index];
        if place < set.len() {
            let unit = if set.abscissa.unit == "-" { String::new() } else { format!(" {}", set.abscissa.unit) };
            let (name, value) = (&set.abscissa.name, number(set.abscissa.values[place]));
            let mut rest = problem.clone();
            rest.sets[index] = set.of(|i| i != place);
            return Some((format!("one point of {}, at {name} {value}{unit}", set.name), rest));
        }
        place -= set.len();
    }
    None
}

/// The data without each of several sets that were fitted together.
fn sets(problem: &Problem, group: &Group) -> Vec<(String, Problem)> {
    let without = |&index: &usize| {
        let mut rest = problem.clone();
        let set = rest.sets.remove(index);
        (format!("data set {}", set.name), rest)
    };
    if group.sets.len() < 2 { Vec::new() } else { group.sets.iter().map(without).collect() }
}

#[cfg(test)]
mod tests;
