//! What a user has to know of a fit besides its numbers.

use super::data::DataSet;
use super::data_sheet::{Known, MODULI, STRAINS, YARN_DENSITIES};
use super::fit::{Fit, Problem, SetFit};
use super::parameter::{ALL, Parameter};
use toron::law::parameters::{DENSITY, STRESS};
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
    notes.extend(beyond_fibres(problem, fit));
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

/// What no yarn has: a density, a stiffness or a strain at failure, or a wave along the fibre; something is in other
/// units.
fn beyond_fibres(problem: &Problem, fit: &Fit) -> Vec<String> {
    let units = &problem.units;
    let of = |parameter: Parameter| fit.values[parameter.index()].filter(|&value| value > 0.0);
    let mut notes = Vec::new();
    let mut beyond = |known: &Known, name: &str, value: f64, [scale, size]: [f64; 2], unit: &str, slip: &str| {
        let [least, most] = known.range;
        if !(least..=most).contains(&(value * scale)) {
            let value = number(value * scale / size);
            notes.push(format!("{name} is {value}{unit}; {}: {slip}", known.text));
        }
    };
    let wrong = "a force, an area or a strain is most likely not in the unit that it is said to have";
    let stress = [1.0 / units.from_si(1.0, STRESS), 1e9];
    if let Some(k_el) = of(Parameter::KEl) {
        beyond(&MODULI, "k_el", k_el, stress, " GPa", wrong);
    }
    // Nothing is stiffer than a fibre along itself; how soft a section may be nobody knows.
    let most = Known { range: [0.0, MODULI.range[1]], text: "at most 1000 GPa, as fibres have" };
    for parameter in [Parameter::KTd, Parameter::KLd] {
        if let Some(value) = of(parameter) {
            beyond(&most, parameter.name(), value, stress, " GPa", wrong);
        }
    }
    if let Some(strain) = of(Parameter::EpsLim) {
        let wrong = "a strain is most likely not in the unit that it is said to have";
        beyond(&STRAINS, "eps_lim", strain, [1.0, 0.01], " %", wrong);
    }
    if let Some(density) = problem.density {
        let scale = [1.0 / units.from_si(1.0, DENSITY), 1000.0];
        let wrong = format!("it is most likely not in the units of the file, {}", units.names().join("-"));
        beyond(&YARN_DENSITIES, "density", density, scale, " g/cm³", &wrong);
    }
    if notes.is_empty()
        && let (Some(k_el), Some(density)) = (of(Parameter::KEl), problem.density)
    {
        let wave = FibreWave::along(LawName::Hyperelastic, k_el, density, units);
        notes.extend(wave.and_then(|wave| wave.unit_warning(units)));
    }
    notes
}

/// What the base preset has told in the data's place, if it has.
pub fn guesses(names: &[&str]) -> Option<String> {
    let names = names.join(", ");
    (!names.is_empty()).then(|| format!("the data say nothing of {names}: these are guesses, the base preset's"))
}

/// Which parameters nothing tells, and what would.
fn open_parameters(problem: &Problem, fit: &Fit) -> Vec<String> {
    let list = |parameters: &[Parameter]| parameters.iter().map(|p| p.name()).collect::<Vec<_>>();
    let names = |parameters: &[Parameter]| list(parameters).join(", ");
    let (filled, others): (Vec<Parameter>, Vec<Parameter>) = ALL.into_iter().partition(|&p| fit.is_of_base(problem, p));
    let is_open = |p: &Parameter| fit.values[p.index()].is_none() && p.property().default.is_none();
    let missing: Vec<Parameter> = others.into_iter().filter(is_open).collect();
    let mut notes: Vec<String> = guesses(&list(&filled)).into_iter().collect();
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
