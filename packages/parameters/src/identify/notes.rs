//! What a user has to know of a fit besides its numbers.

use super::data::DataSet;
use super::data_sheet::MODULI;
use super::fit::{Fit, Problem, SetFit};
use super::parameter::{ALL, Parameter};
use toron::law::parameters::STRESS;
use toron_materials::material::fibre_wave::FibreWave;
use toron_materials::material::laws::LawName;
use toron_shared::numbers::number;

/// An interval that reaches this far to one side, over the value, tells little.
const WIDE: f64 = 0.5;
/// Beyond this correlation parameters move together.
pub const STRONG: f64 = 0.9;
/// Durbin and Watson's statistic of residuals without a pattern is near 2; below this it hardly ever is by chance.
const PATTERN: f64 = 1.0;
/// With fewer points it is no evidence.
const ENOUGH: usize = 10;
/// Residuals below this fraction of the largest ordinate are rounding.
const EXACT: f64 = 1e-6;

/// The sentences, the gravest first.
pub fn notes(problem: &Problem, fit: &Fit) -> Vec<String> {
    let mut notes = Vec::new();
    notes.extend(unit_warning(problem, fit));
    for (set, parameter) in &fit.untold {
        notes.push(format!("data set {set} says nothing of {}: {} would", parameter.name(), parameter.told_by()));
    }
    notes.extend(open_parameters(problem, fit));
    for estimate in &fit.estimates {
        let name = estimate.parameter.name();
        let reach = (estimate.high - estimate.value).max(estimate.value - estimate.low);
        if estimate.bounded {
            notes.push(format!(
                "{name} is at the least value that the law allows: these data would have less, and cannot tell it; give it in [yarn] \
                 properties or add data that tell it ({})",
                estimate.parameter.told_by()
            ));
        } else if reach > WIDE * estimate.value.abs() {
            notes.push(format!("the data hardly tell {name}: its interval is as wide as its value"));
        }
    }
    let sets = problem.sets.iter().zip(&fit.sets);
    let patterned: Vec<&str> =
        sets.filter(|(set, fitted)| patterned(set, fitted)).map(|(set, _)| set.name.as_str()).collect();
    if !patterned.is_empty() {
        notes.push(format!(
            "the residuals of {} are not noise: the law does not follow these data exactly, or they were smoothed; the intervals \
             do not cover that",
            patterned.join(", ")
        ));
    }
    notes
}

/// Whether the law follows a set with an error that is no noise.
pub fn patterned(set: &DataSet, fitted: &SetFit) -> bool {
    let seen = fitted.residuals.iter().any(|r| r.abs() > EXACT * set.largest());
    seen && has_pattern(&order(&fitted.residuals, |i| set.distance(i)))
}

/// A wave along the fibre that no fibre has, or without a density a stiffness: something is in other units.
fn unit_warning(problem: &Problem, fit: &Fit) -> Option<String> {
    let k_el = fit.values[Parameter::KEl.index()]?;
    if let Some(density) = problem.density {
        return FibreWave::along(LawName::Hyperelastic, k_el, density, &problem.units)?.unit_warning(&problem.units);
    }
    let ([least, most], giga) = (MODULI.range, k_el / problem.units.from_si(1e9, STRESS));
    (!(least..=most).contains(&(1e9 * giga))).then(|| {
        format!(
            "k_el is {} GPa; {}: a force, an area or a strain is most likely not in the unit that it is said to have",
            number(giga),
            MODULI.text
        )
    })
}

/// Which parameters nothing tells, and what would.
fn open_parameters(problem: &Problem, fit: &Fit) -> Vec<String> {
    let names = |parameters: &[Parameter]| parameters.iter().map(|p| p.name()).collect::<Vec<_>>().join(", ");
    let (filled, others): (Vec<Parameter>, Vec<Parameter>) = ALL.into_iter().partition(|&p| fit.is_of_base(problem, p));
    let is_open = |p: &Parameter| fit.values[p.index()].is_none() && p.property().default.is_none();
    let missing: Vec<Parameter> = others.into_iter().filter(is_open).collect();
    let mut notes = Vec::new();
    if !filled.is_empty() {
        notes.push(format!("the data say nothing of {}: these are guesses, the base preset's", names(&filled)));
    }
    if !missing.is_empty() {
        let alike = missing.chunk_by(|a, b| a.told_by() == b.told_by());
        let would: Vec<String> = alike.map(|alike| format!("{} by {}", names(alike), alike[0].told_by())).collect();
        notes.push(format!(
            "the data say nothing of {}, which the preset lacks. What would: {}",
            names(&missing),
            would.join("; ")
        ));
    }
    notes
}

/// Residuals by the distance from rest.
fn order(residuals: &[f64], distance: impl Fn(usize) -> f64) -> Vec<f64> {
    let mut order: Vec<usize> = (0..residuals.len()).collect();
    order.sort_by(|&a, &b| distance(a).total_cmp(&distance(b)));
    order.into_iter().map(|i| residuals[i]).collect()
}

/// Whether neighbouring residuals are alike (Durbin and Watson).
fn has_pattern(residuals: &[f64]) -> bool {
    let squares: f64 = residuals.iter().map(|r| r * r).sum();
    let changes: f64 = residuals.windows(2).map(|pair| (pair[1] - pair[0]).powi(2)).sum();
    residuals.len() >= ENOUGH && changes < PATTERN * squares
}

/// Pairs of parameters whose estimates move together, and how much.
pub fn strong_correlations(fit: &Fit) -> Vec<(Parameter, Parameter, f64)> {
    let mut pairs = Vec::new();
    for (i, a) in fit.estimates.iter().enumerate() {
        for (j, b) in fit.estimates.iter().enumerate().skip(i + 1) {
            let correlation = fit.correlations[(i, j)];
            if correlation.abs() > STRONG {
                pairs.push((a.parameter, b.parameter, correlation));
            }
        }
    }
    pairs
}
