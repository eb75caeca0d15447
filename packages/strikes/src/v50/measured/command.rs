//! `toron v50 --analyse TABLE`: the curve of shots that somebody has measured, and of two tables their difference.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::compare::Difference;
use super::words::plain;
use super::{Choice, Measured, report};
use crate::confidence::LEVEL;
use crate::v50::analysis::Analysis;
use crate::v50::curve::{Asked, CHANCES};
use crate::v50::curves_plot::{self, Shown};
use crate::v50::curves_report::{UNBOUNDED, figures};
use crate::v50::link::Link;
use toron_pictures::page;
use toron_pictures::style::{GREY, INK, TEXT, TITLE, fine, text};
use toron_shared::console::print;
use toron_shared::error::Error;
use toron_shared::numbers::number;
use toron_shared::run_directory::{Locked, RunDirectory, Writes};
use toron_shared::text_table::{NONE, files, write_csv};

const FIGURES: &str = "v50.csv";
const DIFFERENCE: &str = "difference.csv";
/// The picture, and its head.
const SIZE: [i32; 2] = [900, 554];
const HEAD: i32 = 84;

/// What is asked of measured shots.
#[derive(clap::Args)]
pub struct Measurements {
    /// Fire none: the curve of the shots in this table, with columns as "speed (m/s)" and "outcome".
    #[arg(
        long,
        value_name = "TABLE",
        group = "table",
        conflicts_with_all = ["scene", "case", "restart", "shots", "collect", "limit", "simulate", "threads"]
    )]
    pub analyse: Option<PathBuf>,
    /// A second table, measured or of toron v50: both in one picture, and the difference of their V50.
    #[arg(long, value_name = "TABLE", requires = "analyse")]
    with: Option<PathBuf>,
    /// The percentiles whose speeds are told beside V50; 5 and 95 if not given. With --next, the one that 3pod
    /// approaches.
    #[arg(long, value_name = "PERCENT", num_args = 1.., requires = "table")]
    pub percentile: Vec<f64>,
    /// The level of the intervals in percent; 95 if not given.
    #[arg(long, value_name = "PERCENT", requires = "analyse")]
    level: Option<f64>,
    /// The curve, logit or probit; both if not given.
    #[arg(long, requires = "analyse")]
    link: Option<String>,
    /// Curves over the logarithm of the speed.
    #[arg(long, requires = "analyse")]
    log: bool,
    /// The spread within which the mean of the most shots is taken, in the table's unit.
    #[arg(long, value_name = "SPEED", requires = "analyse")]
    spread: Option<f64>,
    /// The column of the speeds, where its name does not tell.
    #[arg(long, value_name = "COLUMN", requires = "table")]
    speed: Option<String>,
    /// The column of the outcomes, where its name does not tell.
    #[arg(long, value_name = "COLUMN", requires = "table")]
    outcome: Option<String>,
    /// The word of the perforations; the other word is that of the stops.
    #[arg(long, value_name = "WORD", requires = "table")]
    through: Option<String>,
    /// Only the shots that have this value in this column; may be given several times.
    #[arg(long, value_name = "COLUMN=VALUE", requires = "table")]
    only: Vec<String>,
}

/// Reads the tables, prints the report, writes figures and a picture.
///
/// # Errors
/// The arguments, a table, a file that cannot be written, or shots without a curve.
pub fn run(table: &Path, arguments: &Measurements, firth: bool, output: &Path) -> Result<(), Error> {
    let (asked, choice) = (arguments.asked(firth)?, arguments.choice()?);
    if let Some(with) = arguments.with.as_deref().filter(|with| is_same_file(table, with)) {
        let message = format!("--with is {}, the table of --analyse itself; allowed: another table", with.display());
        return Err(Error::Input(message));
    }
    let first = Measured::read(table, &choice)?;
    let second = arguments.with.as_deref().map(|table| Measured::read(table, &choice)).transpose()?;
    let second = second.map(|second| second.in_unit(&first.unit));
    let tables: Vec<Measured> = [Some(first), second].into_iter().flatten().collect();
    let told: Vec<Analysis> = tables.iter().map(|table| Analysis::of(table.fates.clone(), &asked)).collect();
    let names = ["v50", "difference"].map(String::from).to_vec();
    let given = [Some(table), arguments.with.as_deref()].into_iter().flatten().collect();
    let writes = Writes { command: "v50 --analyse", files: given, names, ..Writes::default() };
    let found: Vec<Difference> = match &told[..] {
        [one, other] => asked.links.iter().filter_map(|&link| Difference::of(one, other, link)).collect(),
        _ => Vec::new(),
    };
    let mut parts: Vec<String> = tables.iter().zip(&told).map(|(table, told)| report::report(table, told)).collect();
    if let ([one, other], [a, b]) = (&tables[..], &told[..])
        && !found.is_empty()
    {
        parts.push(report::difference([one, other], [a, b], &found));
    }
    if told.iter().any(|told| !told.curves.is_empty()) {
        let of_output = |error: Error| match error {
            Error::Input(message) => Error::Input(format!("toron v50 --analyse writes its files to -o: {message}")),
            other => other,
        };
        let directory = RunDirectory::lock(output, writes).and_then(Locked::claim).map_err(of_output)?;
        for name in [FIGURES, DIFFERENCE, "v50.svg", "v50.png"] {
            directory.remove(name)?;
        }
        write(output, &tables, &told, &found)?;
        let listed = [
            (true, FIGURES, "a line for every curve, and the means"),
            (!found.is_empty(), DIFFERENCE, "the difference of the two V50"),
            (true, "v50.svg, .png", "the curves with every shot"),
        ];
        parts.push(files(output, &listed));
    }
    print(&parts.join("\n"));
    let missing = tables.iter().zip(&told).find_map(|(table, told)| report::no_curve(table, told));
    missing.map_or(Ok(()), Err)
}

fn is_same_file(one: &Path, other: &Path) -> bool {
    let [one, other] = [one, other].map(std::fs::canonicalize);
    one.ok().zip(other.ok()).is_some_and(|(one, other)| one == other)
}

fn write(output: &Path, tables: &[Measured], told: &[Analysis], found: &[Difference]) -> Result<(), Error> {
    let of_table = |(table, told): (&Measured, &Analysis)| {
        let counts = [
            ("stopped", told.count(false)),
            ("through", told.count(true)),
            ("without_fate", table.without_fate.len()),
            ("left_out", table.left_out.len()),
        ];
        let counts = counts.map(|(name, count)| (name.to_string(), count.to_string()));
        let shared = [vec![("table".to_string(), table.name.clone())], counts.to_vec()].concat();
        figures(told, &table.unit.text, &shared)
    };
    let lines: Vec<_> = tables.iter().zip(told).flat_map(of_table).collect();
    write_csv(&output.join(FIGURES), &lines)?;
    if !found.is_empty() {
        let of = if told[0].asked.logarithm { ["ratio", "-"] } else { ["difference", &tables[0].unit.text] };
        write_csv(&output.join(DIFFERENCE), &found.iter().map(|found| cells(found, of)).collect::<Vec<_>>())?;
    }
    draw(output, tables, told)
}

/// The cells of a difference, or of a ratio, and its unit.
fn cells(found: &Difference, [name, unit]: [&str; 2]) -> Vec<(String, String)> {
    let exact = |value: Option<f64>, none: &str| value.map_or(none.to_string(), |value| value.to_string());
    let Difference { link, estimate, one_v50, one_curve, least } = found;
    [
        ("curve".to_string(), link.name().to_string()),
        (format!("{name} ({unit})"), exact(estimate.value, NONE)),
        (format!("{name}_low ({unit})"), exact(estimate.interval.low, UNBOUNDED)),
        (format!("{name}_high ({unit})"), exact(estimate.interval.high, UNBOUNDED)),
        ("one_v50_deviance".to_string(), one_v50[0].to_string()),
        ("one_v50_chance".to_string(), one_v50[1].to_string()),
        ("one_curve_deviance".to_string(), one_curve[0].to_string()),
        ("one_curve_chance".to_string(), one_curve[1].to_string()),
        (format!("would_show ({unit})"), exact(*least, UNBOUNDED)),
    ]
    .to_vec()
}

/// The files' names without their folders, unless two are the same.
fn short_names<'a>(paths: impl Iterator<Item = &'a str> + Clone) -> Vec<String> {
    let name = |path: &str| Path::new(path).file_name().map_or(String::new(), |name| name.display().to_string());
    let names: Vec<String> = paths.clone().map(name).collect();
    let distinct: BTreeSet<&String> = names.iter().collect();
    if distinct.len() == names.len() { names } else { paths.map(str::to_string).collect() }
}

fn draw(output: &Path, tables: &[Measured], told: &[Analysis]) -> Result<(), Error> {
    let names = short_names(tables.iter().map(|table| table.name.as_str()));
    let shown: Vec<Shown> = tables
        .iter()
        .zip(told)
        .zip(&names)
        .map(|((table, told), name)| {
            let speeds = table.without_fate.iter().filter_map(|(_, speed)| *speed).collect();
            Shown { name, told, without_fate: (speeds, "no fate".into()) }
        })
        .collect();
    let count =
        |told: &Analysis, name: &str| format!("{name}: {} stopped, {} through", told.count(false), told.count(true));
    let counts: Vec<String> = told.iter().zip(&names).map(|(told, name)| count(told, name)).collect();
    let size = SIZE.map(|length| length as u32);
    page::write(&output.join("v50.svg"), &output.join("v50.png"), size, |root| {
        root.draw_text(&title(told, &tables[0].unit.text), &text(TITLE, &INK), (fine(24), fine(16)))?;
        root.draw_text(&counts.join("; "), &text(TEXT, &GREY), (fine(24), fine(50)))?;
        let (_, body) = root.split_vertically(fine(HEAD));
        curves_plot::draw(&body, &tables[0].unit.text, &shown)
    })
}

/// V50, as the curve that is drawn last has it.
fn title(told: &[Analysis], speed: &str) -> String {
    let v50 = |told: &Analysis| told.asked.links.last().and_then(|&link| told.drawn(link)?.v50().value);
    let all: Vec<String> = told.iter().map(|told| v50(told).map_or(NONE.to_string(), number)).collect();
    if all.iter().all(|value| value == NONE) { "V50".to_string() } else { format!("V50 {} {speed}", all.join(" and ")) }
}

impl Measurements {
    fn asked(&self, firth: bool) -> Result<Asked, Error> {
        let links = match self.link.as_deref() {
            None => Link::BOTH.to_vec(),
            Some(name) => {
                let found = Link::BOTH.into_iter().find(|link| link.name() == name);
                vec![found.ok_or_else(|| Error::Input(format!("--link is {name}; allowed: logit, probit")))?]
            }
        };
        let level = match self.level {
            None => LEVEL,
            Some(level) if (1.0..=99.99).contains(&level) => level / 100.0,
            Some(level) => return Err(Error::Input(format!("--level is {level}; allowed: 1 to 99.99, in percent"))),
        };
        let mut chances = if self.percentile.is_empty() { CHANCES.to_vec() } else { vec![0.5] };
        for &percent in &self.percentile {
            if !(0.01..=99.99).contains(&percent) {
                let message = format!("--percentile is {percent}; allowed: 0.01 to 99.99, in percent");
                return Err(Error::Input(message));
            }
            chances.push(percent / 100.0);
        }
        chances.sort_by(f64::total_cmp);
        chances.dedup();
        if let Some(spread) = self.spread.filter(|spread| !(spread.is_finite() && *spread > 0.0)) {
            return Err(Error::Input(format!("--spread is {spread}; allowed: a finite number > 0")));
        }
        Ok(Asked { links, firth, chances, level, logarithm: self.log, spread: self.spread })
    }

    /// What a user says of the table.
    ///
    /// # Errors
    /// `--only` is no pair.
    pub fn choice(&self) -> Result<Choice, Error> {
        let pair = |text: &String| {
            let wrong = || Error::Input(format!("--only is {text}; allowed: COLUMN=VALUE, as in \"plies=20\""));
            let (name, value) = text.split_once('=').ok_or_else(wrong)?;
            if plain(name).is_empty() { Err(wrong()) } else { Ok((name.to_string(), value.to_string())) }
        };
        let only: Result<Vec<(String, String)>, Error> = self.only.iter().map(pair).collect();
        let [speed, outcome, through] = [&self.speed, &self.outcome, &self.through].map(Clone::clone);
        Ok(Choice { speed, outcome, through, only: only? })
    }
}

#[cfg(test)]
mod tests {
    use super::short_names;

    #[test]
    fn tables_of_one_name_are_told_apart_by_their_folders() {
        assert_eq!(short_names(["a/shots.csv", "b/gun.csv"].into_iter()), ["shots.csv", "gun.csv"]);
        assert_eq!(short_names(["a/shots.csv", "b/shots.csv"].into_iter()), ["a/shots.csv", "b/shots.csv"]);
    }
}
