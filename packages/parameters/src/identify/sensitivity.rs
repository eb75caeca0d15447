//! What the parameters are worth in a scene: the scene with the fitted parameters, and with each at the ends of its
//! interval.
//!
//! A parameter that is strongly correlated with others is moved twice: alone, which the data may not allow, and with
//! the others moved to where the data want them then.

use std::path::Path;

use rayon::prelude::*;

use super::file::Job;
use super::fit::Fit;
use super::notes::STRONG;
use super::parameter::{ALL, PARAMETERS, Parameter};
use super::report::{digits, line, table};
use super::uncertainty::Estimate;
use toron::law::parameters::{DENSITY, ENERGY_DENSITY};
use toron_explicit_host::struck::plan::Plan;
use toron_materials::material::model::{Law, Material};
use toron_materials::units::{SPEED, unit};
use toron_shared::error::Error;
use toron_shared::numbers::number;
use toron_strikes::impact::run;
use toron_strikes::impact::scene::{Case, Scene, Zones};

/// A run of a case.
#[derive(Clone, Debug)]
pub struct Trial {
    /// The index of the case in the scene.
    pub case: usize,
    /// The parameter that is at an end of its interval, and whether it is moved alone.
    pub moved: Option<Parameter>,
    pub alone: bool,
    pub name: String,
    /// Of the projectile: its residual speed where it has left the yarn behind.
    pub speed: f64,
    /// Largest energy densities of elongation, compaction and distortion up to the break.
    pub densities: [f64; 3],
    /// Of the section, when the transverse wave is at the clamp.
    pub widening: Option<f64>,
}

/// Runs the scene's cases with all these sets of parameters.
///
/// # Errors
/// A scene with another yarn than a hyperelastic one, or a run that is not stable.
pub fn trials(job: &Job, fit: &Fit, scene: &Scene) -> Result<Vec<Trial>, Error> {
    for case in &scene.cases {
        if !matches!(&case.zones, Zones::One(material) if matches!(material.law, Law::Hyperelastic { .. })) {
            let message =
                format!("case {}: not hyperelastic throughout; allowed with --scene: yarns that are", case.name);
            return Err(Error::Input(message));
        }
        if case.strength.is_some() {
            let message =
                format!("case {}: strength, in place of eps_lim; allowed with --scene: no strength", case.name);
            return Err(Error::Input(message));
        }
    }
    let sets = sets(job, fit);
    let acts = |case: &Case, set: &Set| set.moved.is_none_or(|moved| !kept(case.zones.inner(), moved));
    let runs: Vec<(usize, &Set)> = (scene.cases.iter().enumerate())
        .flat_map(|(index, case)| sets.iter().filter(move |set| acts(case, set)).map(move |set| (index, set)))
        .collect();
    runs.par_iter().map(|&(case, set)| trial(job, scene, case, set)).collect()
}

/// Parameters to run the scene with.
struct Set {
    moved: Option<Parameter>,
    alone: bool,
    name: String,
    values: [Option<f64>; PARAMETERS],
}

fn sets(job: &Job, fit: &Fit) -> Vec<Set> {
    let own: [Option<f64>; PARAMETERS] = std::array::from_fn(|i| fit.values[i].or(job.problem.fallback[i]));
    let mut sets = vec![Set { moved: None, alone: true, name: "as fitted".to_string(), values: own }];
    for (row, estimate) in fit.estimates.iter().enumerate() {
        let strong = |column: usize| column != row && fit.correlations[(row, column)].abs() > STRONG;
        let along: Vec<&Estimate> =
            fit.estimates.iter().enumerate().filter(|(column, _)| strong(*column)).map(|(_, other)| other).collect();
        let parameter = estimate.parameter;
        // A parameter that the data cannot tell has no ends that mean anything.
        if estimate.bounded || estimate.high >= parameter.property().maximum {
            continue;
        }
        for (place, end) in [estimate.low, estimate.high].into_iter().enumerate() {
            let mut values = own;
            values[parameter.index()] = Some(end);
            let name = format!("{} {}", parameter.name(), digits(end));
            sets.push(Set { moved: Some(parameter), alone: true, name: name.clone(), values });
            if along.is_empty() {
                continue;
            }
            let mut names = Vec::new();
            for other in &along {
                let value = match estimate.profile.filter(|_| fit.together(parameter, other.parameter)) {
                    Some(ends) => other.parameter.clamped(ends[place][other.parameter.index()]),
                    None => follow(fit, estimate, end, other),
                };
                values[other.parameter.index()] = Some(value);
                names.push(format!("{} {}", other.parameter.name(), digits(value)));
            }
            let name = format!("{name}, with {}", names.join(", "));
            sets.push(Set { moved: Some(parameter), alone: false, name, values });
        }
    }
    sets
}

/// Where the data want a parameter when another is at an end of its interval.
fn follow(fit: &Fit, moved: &Estimate, end: f64, other: &Estimate) -> f64 {
    let covariance = |a: &Estimate, b: &Estimate| fit.uncertainty.covariance(a.parameter, b.parameter);
    let slope = covariance(moved, other) / covariance(moved, moved);
    // On the scales on which the estimates are linear in one another.
    let step = if moved.parameter.logarithmic() { moved.value * (end / moved.value).ln() } else { end - moved.value };
    let change = slope * step;
    let value =
        if other.parameter.logarithmic() { other.value * (change / other.value).exp() } else { other.value + change };
    other.parameter.clamped(value)
}

fn trial(job: &Job, scene: &Scene, index: usize, set: &Set) -> Result<Trial, Error> {
    let case = scene.cases[index].clone();
    let material = with(job, scene, case.zones.inner(), set)?;
    let plan = Plan { pictures: Vec::new(), frames: 0, checkpoints: 0, ..case.plan };
    let case = Case { zones: Zones::One(Box::new(material)), plan, ..case };
    let outcome = run::run(&case, &mut ())?;
    Ok(Trial {
        case: index,
        moved: set.moved,
        alone: set.alone,
        name: set.name.clone(),
        speed: outcome.last().speed,
        densities: outcome.largest_densities(),
        widening: outcome.widening(case.yarn.length),
    })
}

/// Whether a case keeps its own value: one without failure, or with uniaxial failure, stays so.
fn kept(material: &Material, parameter: Parameter) -> bool {
    let values = material.values();
    let absent = |parameter: Parameter| values[parameter.index()] == 0.0;
    let unlimited = absent(Parameter::EpsLim);
    match parameter {
        Parameter::EpsLim => unlimited,
        Parameter::Alpha | Parameter::Beta => unlimited || (absent(Parameter::Alpha) && absent(Parameter::Beta)),
        _ => false,
    }
}

/// The case's material with these parameters.
fn with(job: &Job, scene: &Scene, material: &Material, set: &Set) -> Result<Material, Error> {
    let (mut changed, mut values) = (material.clone(), material.values());
    for parameter in ALL.into_iter().filter(|&parameter| !kept(material, parameter)) {
        let Some(value) = set.values[parameter.index()] else { continue };
        let dimension = parameter.property().dimension;
        values[parameter.index()] = job.units.scale(dimension).convert(value, &scene.units.scale(dimension));
    }
    if let Some(density) = job.preset.density {
        changed.density = Some(job.units.scale(DENSITY).convert(density, &scene.units.scale(DENSITY)));
    }
    changed.law = changed.law.with(&values).map_err(|error| Error::Evaluation(format!("{}: {error}", set.name)))?;
    Ok(changed)
}

/// Titles of the figures.
const FIGURES: [&str; 5] = ["speed", "W_el", "W_tc", "W_td", "wider by"];
/// The index of the one that is a share.
const WIDENING: usize = 4;

fn figures(trial: &Trial) -> [Option<f64>; FIGURES.len()] {
    let [w_el, w_tc, w_td] = trial.densities.map(Some);
    [Some(trial.speed), w_el, w_tc, w_td, trial.widening]
}

/// For each case a line for each trial, and which parameter moves which figure most.
pub fn report(job: &Job, fit: &Fit, scene: &Scene, trials: &[Trial]) -> String {
    let [speed, density] = [SPEED, ENERGY_DENSITY].map(|dimension| unit(&scene.units, dimension));
    let heading = format!(
        "the projectile's speed at the end ({speed}), the largest energies up to the break ({density}), and how much wider the \
         section is when the transverse wave is at the clamp"
    );
    let open = |p: &Parameter| fit.values[p.index()].or(job.problem.fallback[p.index()]).is_none();
    let names: Vec<&str> = ALL.into_iter().filter(open).map(|parameter| parameter.name()).collect();
    let mut text = String::new();
    if !names.is_empty() {
        text += &line("of the scene", &format!("{}: the fit has none", names.join(", ")));
    }
    for (index, case) in scene.cases.iter().enumerate() {
        let of_case: Vec<&Trial> = trials.iter().filter(|trial| trial.case == index).collect();
        text += &format!("\n{}", line(&case.name, &heading));
        let title = [""].iter().chain(&FIGURES).map(ToString::to_string).collect();
        let rows: Vec<Vec<String>> = [title].into_iter().chain(of_case.iter().map(|trial| row(trial))).collect();
        text += &table(&rows);
        let moves =
            |figure| most(&of_case, figure).map(|parameter| format!("{} {}", FIGURES[figure], parameter.name()));
        let moves: Vec<String> = (0..FIGURES.len()).filter_map(moves).collect();
        if !moves.is_empty() {
            text += &line("moved most by", &moves.join(", "));
        }
    }
    text
}

fn row(trial: &Trial) -> Vec<String> {
    let cell = |(figure, value): (usize, Option<f64>)| match value {
        None => "-".to_string(),
        Some(share) if figure == WIDENING => format!("{:.1} %", 100.0 * share),
        Some(value) => number(value),
    };
    [trial.name.clone()].into_iter().chain(figures(trial).into_iter().enumerate().map(cell)).collect()
}

/// The parameter, moved alone, whose ends are farthest apart in a figure.
fn most(trials: &[&Trial], figure: usize) -> Option<Parameter> {
    let range = |parameter: Parameter| {
        let ends: Vec<f64> = trials
            .iter()
            .filter(|t| t.alone && t.moved == Some(parameter))
            .filter_map(|t| figures(t)[figure])
            .collect();
        (ends.len() == 2).then(|| (parameter, (ends[1] - ends[0]).abs()))
    };
    let farthest = ALL.into_iter().filter_map(range).max_by(|a, b| a.1.total_cmp(&b.1));
    farthest.filter(|(_, range)| *range > 0.0).map(|(parameter, _)| parameter)
}

/// Writes the table as CSV.
///
/// # Errors
/// The file cannot be written.
pub fn write(file: &Path, scene: &Scene, trials: &[Trial]) -> Result<(), Error> {
    let file_error = |error: csv::Error| Error::Input(format!("{}: {error}", file.display()));
    let mut writer = csv::Writer::from_path(file).map_err(file_error)?;
    let [speed, density] = [SPEED, ENERGY_DENSITY].map(|dimension| unit(&scene.units, dimension));
    let titles = [
        "case".to_string(),
        "parameters".to_string(),
        format!("speed ({speed})"),
        format!("w_el ({density})"),
        format!("w_tc ({density})"),
        format!("w_td ({density})"),
        "widening (-)".to_string(),
    ];
    writer.write_record(titles).map_err(file_error)?;
    for trial in trials {
        let values = figures(trial).map(|value| value.map_or(String::new(), |value| value.to_string()));
        let names = [scene.cases[trial.case].name.clone(), trial.name.clone()];
        writer.write_record(names.into_iter().chain(values)).map_err(file_error)?;
    }
    writer.flush().map_err(|error| file_error(error.into()))
}
