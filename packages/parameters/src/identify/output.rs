//! The files of a fit: the preset, the parameters with their intervals and correlations, and each set with its fit.

use std::collections::BTreeMap;
use std::path::Path;

use super::data::DataSet;
use super::file::Job;
use super::fit::{Fit, SetFit};
use super::friction::C;
use super::friction_report;
use super::parameter::ALL;
use super::report::{base_name, interval};
use toron::law::parameters::FRICTIONAL;
use toron_materials::material::preset::Preset;
use toron_materials::units::unit;
use toron_shared::error::Error;

/// The preset with what has been fitted and what the base has; a comment for each property says where it comes from.
pub fn preset(job: &Job, fit: &Fit) -> String {
    let mut preset: Preset = job.preset.clone();
    let mut comments: BTreeMap<&str, String> = BTreeMap::new();
    for parameter in ALL.into_iter().filter(|&parameter| fit.is_of_base(&job.problem, parameter)) {
        preset.guesses.insert(parameter.name(), &origin(job, parameter.name()));
    }
    for name in friction_report::guessed(job) {
        preset.guesses.insert(name, &origin(job, name));
    }
    for (index, property) in job.preset.law.table().iter().enumerate() {
        let of_base = job.base.as_ref().and_then(|base| base.value(index, &job.units));
        if preset.values[index].is_some() {
            continue;
        }
        if let Some(note) = friction_report::note(job, index) {
            preset.values[index] = Some(job.friction.values[usize::from(index == C)]);
            comments.insert(property.name, note);
            continue;
        }
        // Behind the parameters are the fibre direction and the friction.
        let parameter = ALL.get(index).filter(|_| fit.values.get(index).is_some_and(Option::is_some));
        if let Some(parameter) = parameter {
            preset.values[index] = fit.values[index];
            let estimate = fit.estimates.iter().find(|estimate| estimate.parameter == *parameter);
            let interval = estimate.map(interval);
            let note = interval.unwrap_or_else(|| match job.fibre {
                Some(_) if job.problem.known[index].is_some() => "from the fibre".to_string(),
                _ if job.problem.fallback[index].is_some() => format!("of {}: the data do not tell it", base_name(job)),
                _ => "the default".to_string(),
            });
            comments.insert(property.name, note);
        } else if let (Some(value), Some(base)) = (of_base, &job.base) {
            preset.values[index] = Some(value);
            comments.insert(property.name, format!("of {}: the data do not tell it", base.name));
        }
    }
    if preset.density.is_none() {
        preset.density = job.base.as_ref().and_then(|base| base.density_in(&job.units));
        if preset.density.is_some() {
            preset.guesses.insert("density", &origin(job, "density"));
        }
    }
    preset.to_toml(&comments)
}

/// Where a value of the base preset comes from, which may be a guess there.
fn origin(job: &Job, name: &str) -> String {
    let of_base = job.base.as_ref().and_then(|base| base.guesses.origin(name));
    of_base.map_or_else(|| format!("of {}", base_name(job)), str::to_string)
}

/// A line for each parameter that has an interval: value, unit, standard error, ends, correlations.
///
/// # Errors
/// The file cannot be written.
pub fn write_parameters(file: &Path, job: &Job, fit: &Fit) -> Result<(), Error> {
    let names: Vec<&str> = fit.estimates.iter().map(|estimate| estimate.parameter.name()).collect();
    let head = ["parameter", "value", "unit", "standard_error", "low_95", "high_95", "interval"].map(String::from);
    let mut lines: Vec<Vec<String>> =
        vec![head.into_iter().chain(names.iter().map(|name| format!("correlation_{name}"))).collect()];
    for (row, estimate) in fit.estimates.iter().enumerate() {
        let property = estimate.parameter.property();
        let numbers = [estimate.error, estimate.low, estimate.high].map(|value| value.to_string());
        let mut line =
            vec![property.name.to_string(), estimate.value.to_string(), unit(&job.units, property.dimension)];
        line.extend(numbers);
        line.push(if estimate.profile.is_some() { "profile" } else { "linearised" }.to_string());
        line.extend(fit.correlations.row(row).iter().map(|value| format!("{value:.6}")));
        lines.push(line);
    }
    for (index, told) in friction_report::told(job) {
        let (Some(told), property) = (told, &FRICTIONAL[index]) else { continue };
        let mut line = vec![property.name.to_string(), told.value.to_string(), unit(&job.units, property.dimension)];
        line.extend([told.error, told.low, told.high].map(|value| value.to_string()));
        line.push("scatter".to_string());
        // They are of other data than the parameters before.
        line.extend(names.iter().map(|_| "0".to_string()));
        lines.push(line);
    }
    write(file, &lines)
}

/// A line for each datum of a set.
///
/// # Errors
/// The file cannot be written.
pub fn write_set(file: &Path, set: &DataSet, fitted: &SetFit) -> Result<(), Error> {
    let (x, y) = (&set.abscissa, &set.ordinate);
    let head = |name: &str, unit: &str| format!("{name} ({unit})");
    let mut lines = vec![vec![
        head(&x.name, &x.unit),
        head(&y.name, &y.unit),
        head("fit", &y.unit),
        head("residual", &y.unit),
        head("deviation", &y.unit),
    ]];
    for i in 0..set.len() {
        let (measured, residual) = (y.values[i], fitted.residuals[i]);
        let values = [x.values[i], measured, measured - residual, residual, fitted.deviations[i]];
        lines.push(values.iter().map(f64::to_string).collect());
    }
    write(file, &lines)
}

fn write(file: &Path, lines: &[Vec<String>]) -> Result<(), Error> {
    let file_error = |error: csv::Error| Error::Input(format!("{}: {error}", file.display()));
    let mut writer = csv::Writer::from_path(file).map_err(file_error)?;
    for line in lines {
        writer.write_record(line).map_err(file_error)?;
    }
    writer.flush().map_err(|error| file_error(error.into()))
}
