//! The summary of a fit on the terminal.

use super::data::{DataSet, Loading, Toe};
use super::file::Job;
use super::fit::{Fit, Problem, SetFit};
use super::parameter::{ALL, Parameter};
use super::ranges::{self, PARTS};
use super::uncertainty::{self, Estimate};
use super::{friction_report, influence, notes};
use toron::law::parameters::NUMBER;
use toron_materials::units::unit;
use toron_shared::console::{is_json, value_record};
use toron_shared::numbers::number;
use toron_shared::text_table::{or_dash, plain_table};

/// The width of the names.
const NAMES: usize = 14;
/// The text of a line is broken before this column.
const WIDTH: usize = 110;

/// The parameters, their intervals, the sets and what else there is to say.
pub fn report(job: &Job, fit: &Fit) -> String {
    let mut text = format!("{}\n", job.title);
    text += &plain_table(&PARAMETER_HEAD, &parameters(job, fit), || {
        let of_law = ALL.iter().map(|&parameter| line(parameter.name(), &value(job, fit, parameter)));
        of_law.chain([friction_report::lines(job)]).collect()
    });
    text += &how_sure(fit);
    if let Some(sheet) = &job.sheet {
        text += &line("data sheet", &sheet.summary(&job.units));
        text += &sheet.warning().map_or(String::new(), |warning| line("warning", &warning));
    }
    for (a, b, correlation) in notes::strong_correlations(fit) {
        let meaning = "they are sure together, less so one by one";
        text += &line("correlation", &format!("{} and {}: {correlation:.3}; {meaning}", a.name(), b.name()));
    }
    for (set, fitted) in job.problem.sets.iter().zip(&fit.sets) {
        text += &line(&set.name, &quality(set.ordinate.unit.as_str(), set.largest(), fitted));
        text += &set.toe.as_ref().map_or(String::new(), |toe| line("", &slack(set, toe)));
    }
    text += &friction_report::sets(job);
    text += &by_range(&job.problem, fit);
    let influence = influence::notes(&job.problem, fit);
    let guessed = notes::guesses(&friction_report::guessed(job));
    for note in job.said.iter().cloned().chain(influence).chain(notes::notes(&job.problem, fit)).chain(guessed) {
        text += &line("note", &note);
    }
    text
}

/// A name and a text in lines that a terminal holds.
pub fn line(name: &str, text: &str) -> String {
    if is_json() {
        return value_record(name, text);
    }
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let last = lines.len() - 1;
        if NAMES + lines[last].chars().count() + word.chars().count() > WIDTH {
            lines.push(String::new());
        }
        let last = lines.len() - 1;
        lines[last] += &format!("{word} ");
    }
    let name = |i: usize| if i == 0 { name } else { "" };
    lines.iter().enumerate().map(|(i, text)| format!("  {:<NAMES$} {}\n", name(i), text.trim_end())).collect()
}

/// The cells of each parameter in a table that programs read.
const PARAMETER_HEAD: [&str; 6] = ["parameter", "value", "unit", "low_95", "high_95", "said"];

fn parameters(job: &Job, fit: &Fit) -> Vec<Vec<String>> {
    let row = |parameter: Parameter| {
        let estimate = fit.estimates.iter().find(|estimate| estimate.parameter == parameter);
        let index = parameter.index();
        let known = fit.values[index].or(job.problem.fallback[index]).or(parameter.property().default);
        let numbers = [estimate.map(|e| e.value).or(known), estimate.map(|e| e.low), estimate.map(|e| e.high)];
        let [value, low, high] = numbers.map(|number| or_dash(number, |number| number.to_string()));
        let unit = unit(&job.units, parameter.property().dimension);
        vec![parameter.name().to_string(), value, unit, low, high, self::value(job, fit, parameter)]
    };
    ALL.into_iter().map(row).chain(friction_report::rows(job)).collect()
}

/// A parameter's value, its interval or where it comes from.
fn value(job: &Job, fit: &Fit, parameter: Parameter) -> String {
    let index = parameter.index();
    let unit = match unit(&job.units, parameter.property().dimension) {
        unit if parameter.property().dimension == NUMBER => unit.replace('-', ""),
        unit => format!(" {unit}"),
    };
    if let Some(estimate) = fit.estimates.iter().find(|estimate| estimate.parameter == parameter) {
        let (value, interval, origin) = (digits(estimate.value), interval(estimate), origin(job, fit, parameter));
        return format!("{value}{unit}, {interval}{origin}{}", doubt(job, fit, parameter));
    }
    let (value, origin) = match (fit.values[index], job.preset.values[index], job.problem.fallback[index]) {
        (Some(value), Some(_), _) => (value, ", given".to_string()),
        (Some(value), None, _) if job.problem.known[index].is_some() => (value, origin(job, fit, parameter)),
        (_, _, Some(value)) => (value, format!(", of the preset {}", base_name(job))),
        (_, _, None) => match parameter.property().default {
            Some(default) => (default, ", the default".to_string()),
            None => return "not told by these data, and not given".to_string(),
        },
    };
    format!("{}{unit}{origin}", digits(value))
}

pub fn base_name(job: &Job) -> &str {
    job.base.as_ref().map_or("", |base| base.name.as_str())
}

/// The interval in words.
pub fn interval(estimate: &Estimate) -> String {
    let property = estimate.parameter.property();
    let least = if property.minimum_excluded { "just above " } else { "" };
    let low = match estimate.low <= estimate.parameter.least() {
        true => format!("{least}{}, the least that the law takes,", digits(property.minimum)),
        false => digits(estimate.low),
    };
    match (estimate.high >= property.maximum, property.dimension == NUMBER && property.maximum < 1e3) {
        (true, true) => format!("95 %: {low} to {}, the most that the law takes", digits(property.maximum)),
        (true, false) => format!("95 %: {low} and more, without limit"),
        (false, _) => format!("95 %: {low} to {}", digits(estimate.high)),
    }
}

/// Which intervals are linearised where others are profiles.
fn how_sure(fit: &Fit) -> String {
    let searches = fit.searches;
    if searches == 0 {
        return String::new();
    }
    let names: Vec<&str> = fit.linearised().into_iter().map(Parameter::name).collect();
    let others = if names.is_empty() { String::new() } else { format!("; linearised of {}", names.join(", ")) };
    line("intervals", &format!("by profiles of the squares, of {searches} searches{others}"))
}

/// The sets that tell a parameter, or the fibre.
fn origin(job: &Job, fit: &Fit, parameter: Parameter) -> String {
    if let Some(group) = fit.groups.iter().find(|group| group.parameters.contains(&parameter)) {
        let names: Vec<&str> = group.sets.iter().map(|&set| job.problem.sets[set].name.as_str()).collect();
        return format!(", from {}", names.join(", "));
    }
    match (&job.fibre, parameter) {
        (Some(fibre), Parameter::KEl) => format!(
            ", from the fibre: the energies of both laws agree within {:.1} % of that at failure",
            100.0 * fibre.misfit()
        ),
        (Some(_), Parameter::EpsLim) => ", from the fibre".to_string(),
        _ => String::new(),
    }
}

/// What the interval does not cover, where the law does not follow the data that tell a parameter.
fn doubt(job: &Job, fit: &Fit, parameter: Parameter) -> &'static str {
    let told_by = fit.groups.iter().filter(|group| group.parameters.contains(&parameter)).flat_map(|group| &group.sets);
    let patterned = |&set: &usize| notes::patterned(&job.problem.sets[set], &fit.sets[set]);
    if told_by.copied().any(|set| patterned(&set)) {
        "; no noise: the value may be farther off than the interval says, see the note"
    } else {
        ""
    }
}

/// The slack that was taken off a set.
fn slack(set: &DataSet, toe: &Toe) -> String {
    let unit = if set.abscissa.unit == "-" { String::new() } else { format!(" {}", set.abscissa.unit) };
    format!(
        "slack: the {} counts from {}{unit} ± {} (95 %), where the curve beyond its toe begins; {} points up to {}{unit} are left \
         out (zero = 0 keeps them)",
        set.abscissa.name,
        number(toe.zero),
        number(uncertainty::quantile(f64::INFINITY) * toe.deviation),
        toe.left_out,
        number(toe.end)
    )
}

/// How the law meets a set.
fn quality(unit: &str, largest: f64, fitted: &SetFit) -> String {
    let count = fitted.residuals.len();
    let mean_square = fitted.residuals.iter().map(|r| r * r).sum::<f64>() / count as f64;
    let share = 100.0 * mean_square.sqrt() / largest;
    let unit = if unit == "-" { String::new() } else { format!(" {unit}") };
    let size = format!(
        "{count} points, residuals {}{unit} (root mean square), {share:.2} % of the largest",
        number(mean_square.sqrt())
    );
    if fitted.freedom.is_finite() {
        return size;
    }
    let squares = fitted.residuals.iter().zip(&fitted.deviations).map(|(r, d)| (r / d).powi(2)).sum::<f64>();
    format!("{size}; {:.2} of the deviations that are given", (squares / count as f64).sqrt())
}

/// The fitted parameters when only a part of the range is used.
fn by_range(problem: &Problem, fit: &Fit) -> String {
    let fitted: Vec<Parameter> = fit.groups.iter().flat_map(|group| group.parameters.clone()).collect();
    if problem.sets.iter().all(|set| matches!(set.loading, Loading::Failure { .. })) {
        return String::new();
    }
    let mut text = String::new();
    for (part, of_part) in PARTS.into_iter().zip(ranges::by_range(problem)) {
        let name = format!("to {:.0} %", 100.0 * part);
        let values = |fit: Fit| {
            let one = |p: &Parameter| format!("{} {}", p.name(), fit.values[p.index()].map_or("-".to_string(), digits));
            fitted.iter().map(one).collect::<Vec<_>>().join(", ")
        };
        let missing = || "the data that are left do not suffice".to_string();
        text += &line(&name, &format!("of the range: {}", of_part.map_or_else(missing, values)));
    }
    text
}

/// Five significant digits.
pub fn digits(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || (1e-4..1e7).contains(&size) {
        let decimals = if value == 0.0 { 0 } else { (4 - size.log10().floor() as i32).max(0) as usize };
        let text = format!("{value:.decimals$}");
        return if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_string() } else { text };
    }
    format!("{value:.4e}")
}

/// Rows of cells in columns, the heading first: the first column to the left, the others to the right.
pub fn table(rows: &[Vec<String>]) -> String {
    let Some((head, below)) = rows.split_first() else { return String::new() };
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    plain_table(&head, below, || aligned(rows))
}

fn aligned(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max();
    let widths: Vec<usize> = (0..columns).map(|column| width(column).unwrap_or(0)).collect();
    let mut text = String::new();
    for row in rows {
        let cells = row.iter().zip(&widths).enumerate().map(|(column, (cell, &width))| match column {
            0 => format!("{cell:<width$}"),
            _ => format!("{cell:>width$}"),
        });
        text += &format!("  {}\n", cells.collect::<Vec<_>>().join("  ").trim_end());
    }
    text
}
