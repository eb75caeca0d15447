//! What came of a fit from a blow: on the terminal, as a table, as a preset.

use std::collections::BTreeMap;
use std::path::Path;

use super::file::{BlowJob, Fitted, Followed};
use super::runs::Count;
use super::search::Solution;
use crate::identify::notes::STRONG;
use crate::identify::report::{digits, line};
use toron_explicit_host::struck::history::title;
use toron_materials::material::preset::Preset;
use toron_materials::units::{TIME, unit};
use toron_pictures::history;
use toron_pictures::panel::{Abscissa, Panel, Series};
use toron_shared::error::Error;
use toron_shared::numbers::number;
use toron_shared::text_table::write_csv;

/// Residuals of a column that is worth less than this part of its data come in waves.
const WAVES: f64 = 0.5;
/// Where the squares rise by more than this, or less than its inverse, over the linearised rise, the report says so: the
/// end is off by more than 1.4 or 0.7 times.
const LINEAR: f64 = 2.0;

fn interval([low, high]: [f64; 2]) -> String {
    format!("95 % (linearised): {} to {}", digits(low), digits(high))
}

/// Properties with their intervals, how the scene follows each column, and what it has cost.
pub fn report(job: &BlowJob, solution: &Solution, count: Count) -> String {
    let units = &job.scene.units;
    let mut text = format!("{}\n", job.title);
    for ((fitted, &value), &ends) in job.fits.iter().zip(&solution.values).zip(&solution.intervals) {
        let unit = match unit(units, fitted.property.dimension) {
            none if none == "-" => String::new(),
            unit => format!(" {unit}"),
        };
        let started = format!("the scene has {}", digits(fitted.start));
        text += &line(fitted.property.name, &format!("{}{unit}, {}; {started}", digits(value), interval(ends)));
    }
    for (i, j) in (0..job.fits.len()).flat_map(|i| (0..i).map(move |j| (j, i))) {
        let correlation = solution.correlations[(i, j)];
        if correlation.abs() > STRONG {
            let [a, b] = [i, j].map(|place| job.fits[place].property.name);
            let meaning = "they are sure together, less so one by one";
            text += &line("correlation", &format!("{a} and {b}: {correlation:.3}; {meaning}"));
        }
    }
    let n = job.times.len();
    let parts = |all: &[f64], place: usize| job.residuals(all)[place * n..][..n].to_vec();
    for (place, followed) in job.follows.iter().enumerate() {
        let size = |all: &[f64]| {
            let residuals = parts(all, place);
            (residuals.iter().map(|residual| residual * residual).sum::<f64>() / n as f64).sqrt() * followed.deviation
        };
        let [before, after] = [&solution.before, &solution.followed].map(|all| number(size(all)));
        let worth = solution.independent[place].round();
        let unit = unit(units, followed.dimension);
        let text_of = format!(
            "{n} data, worth {worth} independent ones; residuals {before} {unit} before, {after} after, \
            deviation {}",
            number(followed.deviation)
        );
        text += &line(followed.name, &text_of);
    }
    let seconds = count.processor.as_secs_f64();
    let made = count.all - count.found;
    text += &line(
        "runs",
        &format!("{}, of which {made} were made now: {} s of processor time", count.all, number(seconds)),
    );
    for note in notes(job, solution) {
        text += &line("note", &note);
    }
    text
}

/// What a run at the end of an interval says against it, if its squares rise by much more or less than linearised.
fn curved(value: f64, end: f64, rise: Option<f64>) -> Option<String> {
    let rise = rise.filter(|rise| !(1.0 / LINEAR..=LINEAR).contains(rise))?;
    let text = if rise > 0.0 {
        let place = value + (end - value) / rise.sqrt();
        format!(
            "a run there raises the squares by {rise:.2} times what that takes; a parabola through it ends at {}",
            digits(place)
        )
    } else {
        "a run there has no larger squares: fit again from it".to_string()
    };
    Some(text)
}

fn notes(job: &BlowJob, solution: &Solution) -> Vec<String> {
    let mut notes = Vec::new();
    let misfit = job.misfit(&solution.followed);
    if misfit > 2.0 {
        notes.push(format!(
            "the scene follows the history to {misfit:.1} of the deviations that are given: the intervals take that for noise, \
             and do not cover what the law or the scene cannot do"
        ));
    }
    let in_waves = |(followed, worth): &(&Followed, &f64)| **worth < WAVES * followed.values.len() as f64;
    let names: Vec<&str> =
        job.follows.iter().zip(&solution.independent).filter(in_waves).map(|(followed, _)| followed.name).collect();
    if !names.is_empty() {
        notes.push(format!("residuals of {} come in waves, and count for fewer data", names.join(", ")));
    }
    for (fitted, place) in job.fits.iter().zip(0..) {
        let ends = solution.intervals[place].into_iter().zip(solution.rises[place]).zip(["lower", "upper"]);
        notes.extend(ends.filter_map(|((end, rise), side)| {
            let what = curved(solution.values[place], end, rise)?;
            Some(format!(
                "the {side} end of {}, {}, is linearised, and wrong: {what}",
                fitted.property.name,
                digits(end)
            ))
        }));
    }
    let on_bound =
        |(fitted, value): &(&Fitted, &f64)| **value <= fitted.property.minimum || **value >= fitted.property.maximum;
    for (fitted, value) in job.fits.iter().zip(&solution.values).filter(on_bound) {
        notes.push(format!("{} is on a bound of what is allowed, {}", fitted.property.name, digits(*value)));
    }
    if solution.impatient {
        notes.push(
            "the search has ended before it was sure of the least squares: give the preset to the scene and fit again"
                .to_string(),
        );
    }
    notes
}

/// The scene's law with what was found; a comment for each property says where it comes from.
pub fn preset(job: &BlowJob, solution: &Solution) -> String {
    let material = job.case.zones.inner();
    let mut preset = Preset::new(&job.name, &job.source, material.law.name(), job.scene.units);
    preset.density = material.density;
    let mut comments: BTreeMap<&str, String> = BTreeMap::new();
    for (index, (property, value)) in material.table().iter().zip(material.values()).enumerate() {
        // The direction is the scene's, not the yarn's.
        if property.name.starts_with("m_") {
            continue;
        }
        let found = job.fits.iter().position(|fitted| fitted.index == index);
        preset.values[index] = Some(found.map_or(value, |place| solution.values[place]));
        let comment = found.map_or("of the scene".to_string(), |place| interval(solution.intervals[place]));
        comments.insert(property.name, comment);
    }
    preset.to_toml(&comments)
}

/// A line for each time: each column as measured, as followed and as before.
///
/// # Errors
/// The file cannot be written.
pub fn write_history(file: &Path, job: &BlowJob, solution: &Solution) -> Result<(), Error> {
    let units = &job.scene.units;
    let n = job.times.len();
    let row = |(i, &time): (usize, &f64)| {
        let mut cells = vec![(title("time", TIME, units), time.to_string())];
        for (place, followed) in job.follows.iter().enumerate() {
            let cell = |end: &str, value: f64| {
                (title(&format!("{}{end}", followed.name), followed.dimension, units), value.to_string())
            };
            let at = place * n + i;
            cells.extend([
                cell("", followed.values[i]),
                cell("_fit", solution.followed[at]),
                cell("_before", solution.before[at]),
            ]);
        }
        cells
    };
    write_csv(file, &job.times.iter().enumerate().map(row).collect::<Vec<_>>())
}

/// Each column as measured, as followed, as before.
///
/// # Errors
/// A file cannot be written.
pub fn write_plot([svg, png]: [&Path; 2], job: &BlowJob, solution: &Solution) -> Result<(), Error> {
    let n = job.times.len();
    let panel = |(place, followed): (usize, &Followed)| {
        let part = |all: &[f64]| all[place * n..][..n].to_vec();
        let series = vec![
            Series::new(0, "measured", followed.values.clone()),
            Series::new(1, "fit", part(&solution.followed)),
            Series::new(2, "scene as it was", part(&solution.before)),
        ];
        Panel::new(followed.name, &unit(&job.scene.units, followed.dimension), series)
    };
    let abscissa = Abscissa { label: title("time", TIME, &job.scene.units), values: job.times.clone(), failure: None };
    let panels = job.follows.iter().enumerate().map(panel);
    history::write(svg, png, [&job.title, "The history of a blow, followed by a scene"], panels, &abscissa)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_end_that_a_run_contradicts_is_named() {
        for rise in [None, Some(0.51), Some(1.0), Some(1.99)] {
            assert_eq!(curved(100.0, 120.0, rise), None);
        }
        let text = |rise: f64| curved(100.0, 120.0, Some(rise)).expect("a sentence");
        assert!(text(4.0).contains("by 4.00 times") && text(4.0).ends_with("ends at 110"), "{}", text(4.0));
        assert!(text(0.25).ends_with("ends at 140"), "{}", text(0.25));
        assert!(text(-0.1).contains("no larger squares"), "{}", text(-0.1));
    }
}
