//! `toron v50 --next K TABLE`: at which speeds to fire now, by the shots that a table has.

use std::path::Path;

use super::planned::Planned;
use super::{Choice, read};
use crate::v50::curves_report::{WIDTH, listed, paragraph, percent};
use crate::v50::designs::{APART, Approach, Batch, Design, Next, OF_RANGE};
use toron_shared::console::print;
use toron_shared::error::Error;
use toron_shared::numbers::number;
use toron_shared::text_table::{Column, table};

/// Shots at a time, at most.
const MOST: usize = 20;
/// Over the range: the guess of the deviation, if none is given.
const GUESS: f64 = 0.125;
/// The shots of 3pod's first two phases, if it is not given: as many as in Wu and Tian's example.
const FIRST_PHASES: usize = 15;
const DESIGNS: &str = "langlie, up-and-down, d-optimal, 3pod";

/// What is asked for the next shots.
#[derive(clap::Args)]
pub struct NextShots {
    /// Fire none: the speeds of the next K shots, by the shots in the table that stands in the place of the scene.
    #[arg(
        long,
        value_name = "K",
        group = "table",
        allow_negative_numbers = true,
        conflicts_with_all = ["case", "restart", "shots", "collect", "limit", "simulate", "threads", "firth"]
    )]
    pub next: Option<usize>,
    /// How the speeds are chosen: langlie, up-and-down, d-optimal or 3pod.
    #[arg(long, requires = "next")]
    design: Option<String>,
    /// The range in which V50 should be, in the table's unit, the same from the first shot to the last.
    #[arg(long, num_args = 2, value_names = ["LOW", "HIGH"], allow_negative_numbers = true, requires = "next")]
    range: Option<Vec<f64>>,
    /// The first guess of the deviation σ, and the step up or down; an eighth of the range if not given.
    #[arg(long, value_name = "SIGMA", allow_negative_numbers = true, requires = "next")]
    guess: Option<f64>,
    /// Speeds are whole multiples of this.
    #[arg(long, value_name = "SPEED", allow_negative_numbers = true, requires = "next")]
    resolution: Option<f64>,
    /// The column of the asked speeds, where its name does not tell.
    #[arg(long, value_name = "COLUMN", requires = "next")]
    asked: Option<String>,
    /// After so many shots 3pod approaches its percentile; 15 if not given.
    #[arg(long, value_name = "SHOTS", requires = "next")]
    first_phases: Option<usize>,
}

/// Reads the table, and prints the next speeds and why.
///
/// # Errors
/// The arguments or the table.
pub fn run(table: &Path, arguments: &NextShots, choice: &Choice, percentiles: &[f64]) -> Result<(), Error> {
    let asked = arguments.checked(percentiles)?;
    let planned = Planned::of(&read(table)?, choice, arguments.asked.as_deref())?;
    of_the_range(&planned, asked.range)?;
    print(&said(&planned, &asked));
    Ok(())
}

/// Every design begins within its range, so that a range without any shot is that of other shots, or in another unit.
fn of_the_range(planned: &Planned, [low, high]: [f64; 2]) -> Result<(), Error> {
    let speeds = || planned.fired.iter().map(|shot| shot.fate.speed);
    if planned.fired.is_empty() || speeds().any(|speed| (low..=high).contains(&speed)) {
        return Ok(());
    }
    let [slowest, fastest] = [speeds().fold(f64::INFINITY, f64::min), speeds().fold(0.0, f64::max)];
    let (name, unit) = (&planned.name, &planned.unit.text);
    Err(Error::Input(format!(
        "--range is {low} {high}, and the shots of {name} are from {slowest} to {fastest} {unit}; allowed: a range in {unit} \
         with one of them at least"
    )))
}

/// What a user asks for, checked.
struct Wanted {
    design: Design,
    range: [f64; 2],
    guess: f64,
    size: usize,
    resolution: Option<f64>,
    /// Whether the guess is a user's.
    is_guessed: bool,
}

impl NextShots {
    fn checked(&self, percentiles: &[f64]) -> Result<Wanted, Error> {
        let error = |message: String| Err(Error::Input(message));
        let size = self.next.unwrap_or_default();
        if !(1..=MOST).contains(&size) {
            return error(format!("--next is {size}; allowed: 1 to {MOST} shots"));
        }
        let Some(name) = self.design.as_deref() else {
            return error(format!("--next without --design; allowed: --design and one of {DESIGNS}"));
        };
        let range = match self.range.as_deref() {
            None => {
                return error(
                    "--next without --range; allowed: --range LOW HIGH, between which V50 should be".to_string(),
                );
            }
            Some(&[low, high]) if low > 0.0 && low < high && high.is_finite() => [low, high],
            Some(given) => {
                let given = given.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
                return error(format!(
                    "--range is {given}; allowed: the slow and then the fast end, two finite numbers > 0"
                ));
            }
        };
        let width = range[1] - range[0];
        for (option, value) in [("--guess", self.guess), ("--resolution", self.resolution)] {
            if let Some(value) = value.filter(|value| !(*value > 0.0 && *value <= width)) {
                return error(format!("{option} is {value}; allowed: above 0, up to {width}, the width of --range"));
            }
        }
        let guess = self.guess.unwrap_or(GUESS * width);
        let design = match name {
            "langlie" => Design::Langlie,
            "up-and-down" => Design::UpAndDown { step: guess },
            "d-optimal" => Design::DOptimal { deviation: guess },
            "3pod" => Design::ThreePod { deviation: guess, approach: self.approach(percentiles)? },
            _ => return error(format!("--design is {name}; allowed: {DESIGNS}")),
        };
        let is_pod = matches!(design, Design::ThreePod { .. });
        if is_pod && guess > OF_RANGE * width {
            let most = OF_RANGE * width;
            return error(format!("--guess is {guess}; allowed: up to {most}, a sixth of --range, with --design 3pod"));
        }
        if let Some(percent) = percentiles.first().filter(|_| !is_pod) {
            return error(format!("--percentile is {percent}; allowed: with --design 3pod"));
        }
        if let Some(count) = self.first_phases.filter(|_| percentiles.is_empty() || !is_pod) {
            return error(format!("--first-phases is {count}; allowed: with --design 3pod and --percentile"));
        }
        Ok(Wanted { design, range, guess, size, resolution: self.resolution, is_guessed: self.guess.is_some() })
    }

    fn approach(&self, percentiles: &[f64]) -> Result<Option<Approach>, Error> {
        match percentiles {
            [] => Ok(None),
            [percent] if (1.0..=99.0).contains(percent) => {
                Ok(Some(Approach { chance: percent / 100.0, after: self.first_phases.unwrap_or(FIRST_PHASES) }))
            }
            _ => {
                let given = percentiles.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
                Err(Error::Input(format!(
                    "--percentile is {given}; allowed: one, from 1 to 99, in percent, with --next"
                )))
            }
        }
    }
}

/// The report: how the table was read, the speeds, and why.
fn said(planned: &Planned, wanted: &Wanted) -> String {
    let unit = &planned.unit.text;
    let batch = Batch {
        range: wanted.range,
        guess: wanted.guess,
        size: wanted.size,
        pending: planned.pending.iter().map(|(_, speed)| *speed).collect(),
        resolution: wanted.resolution,
    };
    let next = batch.speeds(wanted.design, &planned.fired);
    let mut parts = vec![head(planned), setting(wanted, unit)];
    let (rule, step) = batch.rule(wanted.design, &planned.fired);
    let mut reasons = vec![format!("{}: {}", step.phase(), step.why(unit))];
    if wanted.size > 1 {
        reasons.push(format!("{} {}", rule.why(wanted.size, unit), of_distances(wanted, unit)));
    }
    parts.push(reasons.iter().map(|reason| paragraph(reason)).collect());
    parts.push(of_pending(planned, wanted, next.len()));
    if !next.is_empty() {
        parts.push(speeds(planned, &next));
    }
    parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("\n")
}

/// How near the shots of a batch stand to each other.
fn of_distances(wanted: &Wanted, unit: &str) -> String {
    match wanted.resolution {
        Some(resolution) if resolution > APART * wanted.guess => format!(
            "No two have one speed: by the resolution they are {resolution} {unit} or more apart, also where the design would have \
             them nearer."
        ),
        _ => "No two are nearer than a twentieth of σ.".to_string(),
    }
}

fn head(planned: &Planned) -> String {
    let Planned { name, fired, pending, without_fate, left_out, notes, .. } = planned;
    let [stopped, through] = [false, true].map(|through| planned.count(through));
    let mut text = paragraph(&format!(
        "{name}: {} shots fired: {stopped} stopped, {through} through; {} still to be fired, {} without a fate, {} left out",
        fired.len(),
        pending.len(),
        without_fate.len(),
        left_out.len()
    ));
    notes.iter().for_each(|note| text += &paragraph(note));
    let lines: Vec<String> = without_fate.iter().map(usize::to_string).collect();
    if !lines.is_empty() {
        let lines = listed(&lines);
        text += &paragraph(&format!("Without a fate, line {lines}: the design goes on from the shots that have one."));
    }
    left_out.iter().for_each(|(line, why)| text += &paragraph(&format!("Left out, line {line}: {why}")));
    text
}

fn setting(wanted: &Wanted, unit: &str) -> String {
    let Wanted { design, range: [low, high], guess, resolution, is_guessed, .. } = wanted;
    let mut text = format!("Design {}, range {low} to {high} {unit}", design.name());
    match design {
        Design::Langlie => {}
        Design::UpAndDown { step } => text += &format!(", step {} {unit}", number(*step)),
        _ => text += &format!(", guess of σ {} {unit}", number(*guess)),
    }
    if !is_guessed && *design != Design::Langlie {
        text += ", an eighth of the range";
    }
    if let Design::ThreePod { approach: Some(Approach { chance, after }), .. } = design {
        text += &format!(", percentile {} after {after} shots", percent(*chance));
    }
    if let Some(resolution) = resolution {
        text += &format!(", multiples of {resolution} {unit}");
    }
    paragraph(&text)
}

/// The shots that are still to be fired are the first of the batch.
fn of_pending(planned: &Planned, wanted: &Wanted, left: usize) -> String {
    let pending: Vec<String> = planned
        .pending
        .iter()
        .map(|(line, speed)| format!("line {line} at {} {}", number(*speed), planned.unit.text))
        .collect();
    if pending.is_empty() {
        return String::new();
    }
    let shots = if pending.len() == 1 { "shot is" } else { "shots are" };
    let rest = match left {
        0 => "no further one is asked for before its result is known".to_string(),
        _ => format!("{left} more make {}", wanted.size),
    };
    let [count, listed] = [pending.len().to_string(), listed(&pending)];
    paragraph(&format!(
        "{count} {shots} still to be fired, {listed}: they count as the first of the batch, and {rest}."
    ))
}

fn speeds(planned: &Planned, next: &[Next]) -> String {
    let first = planned.fired.len() + planned.pending.len() + 1;
    let column =
        |above: &str, below: &str, entries: Vec<String>| Column { heading: [above, below].map(String::from), entries };
    let numbers = (first..).take(next.len()).map(|number| number.to_string()).collect();
    let asked = next.iter().map(|next| rounded(next.speed)).collect();
    table(vec![column("shot", "number", numbers), column("fire at", &planned.unit.text, asked)], WIDTH)
}

/// A speed with the digits that somebody can set, at least.
fn rounded(speed: f64) -> String {
    let text = format!("{speed:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}

#[cfg(test)]
mod tests;
