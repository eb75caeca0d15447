//! The report: times and errors of every row as a table, as JSON and as a picture.

mod plot;

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;
use std::process::Command;

use plot::CACHED;
pub use plot::Family;
use serde::{Serialize, Serializer};

/// Where a set of measurements lies.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Quartiles {
    pub least: f64,
    pub lower_quartile: f64,
    pub median: f64,
    pub upper_quartile: f64,
}

impl Quartiles {
    pub fn new(mut samples: Vec<f64>) -> Self {
        samples.sort_by(f64::total_cmp);
        let quantile = |quarters: usize| samples[quarters * (samples.len() - 1) / 4];
        Quartiles { least: quantile(0), lower_quartile: quantile(1), median: quantile(2), upper_quartile: quantile(3) }
    }
}

/// How many times one row's time is another's.
#[derive(Serialize)]
pub struct Ratio {
    name: &'static str,
    above: String,
    below: String,
    points: usize,
    times: Quartiles,
}

/// The errors of the stress over the truth cases: |σ − truth|/(|truth| + K), K being what rounding F by one part does
/// to the stress. An answer as good as its input allows has the unit roundoff here, 1.1e−16 or 6e−8.
#[derive(Default, Serialize)]
pub struct Accuracy {
    /// By category; the report keeps the worst and the median.
    #[serde(serialize_with = "worst_and_median")]
    errors: BTreeMap<String, Vec<f64>>,
    /// The worst |σ − truth|/|truth| near the unloaded state, however small the strain.
    near_rest: f64,
}

impl Accuracy {
    pub fn add(&mut self, category: &str, error: f64, relative: f64) {
        self.errors.entry(category.to_string()).or_default().push(error);
        if ["small", "degenerate"].contains(&category) {
            self.near_rest = self.near_rest.max(relative);
        }
    }

    fn all(&self) -> Vec<f64> {
        self.errors.values().flatten().copied().collect()
    }

    pub fn worst(&self) -> f64 {
        worst(&self.all())
    }

    pub fn median(&self) -> f64 {
        median(&self.all())
    }
}

fn worst_and_median<S: Serializer>(errors: &BTreeMap<String, Vec<f64>>, to: S) -> Result<S::Ok, S::Error> {
    let summary = |errors: &Vec<f64>| BTreeMap::from([("worst", worst(errors)), ("median", median(errors))]);
    to.collect_map(errors.iter().map(|(category, errors)| (category, summary(errors))))
}

fn worst(errors: &[f64]) -> f64 {
    errors.iter().copied().fold(0.0, f64::max)
}

fn median(errors: &[f64]) -> f64 {
    let mut errors = errors.to_vec();
    errors.sort_by(f64::total_cmp);
    errors[errors.len() / 2]
}

/// A row of the report.
#[derive(Serialize)]
pub struct Row {
    pub name: String,
    pub family: Family,
    /// The compiler's flags, where they are not the benchmark's own.
    pub flags: String,
    /// Nanoseconds a point over all samples of all rounds, by size. The tables use the least: what disturbs a
    /// measurement only makes it longer.
    pub timings: Vec<Quartiles>,
    /// `None` where no law is evaluated.
    pub accuracy: Option<Accuracy>,
}

/// Where and when it was measured, and with what.
#[derive(Serialize)]
pub struct Machine {
    processor: String,
    version: &'static str,
    rustc: String,
    fortran: Option<String>,
    libraries: String,
    date: String,
}

impl Machine {
    pub fn new(processor: String, fortran: Option<String>) -> Self {
        let said = |command: &str, argument: &str| {
            let output = Command::new(command).arg(argument).output().map(|output| output.stdout).unwrap_or_default();
            String::from_utf8_lossy(&output).lines().next().unwrap_or("unknown").to_string()
        };
        Machine {
            processor,
            version: concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION")),
            rustc: said("rustc", "--version"),
            fortran,
            libraries: libraries(),
            date: said("date", "+%Y-%m-%d"),
        }
    }
}

/// The versions of what is linked: nalgebra from the lock file, libm and libmvec from the system.
fn libraries() -> String {
    let lock = include_str!("../../Cargo.lock");
    // That of this package: another one may use an older nalgebra.
    let own = lock.split("name = \"toron\"\n").nth(1).and_then(|rest| rest.split("[[package]]").next()).unwrap_or("");
    let version = own.split("\"nalgebra ").nth(1).and_then(|rest| rest.split('"').next());
    let system = Command::new("ldd").arg("--version").output().map(|output| output.stdout).unwrap_or_default();
    let system = String::from_utf8_lossy(&system).lines().next().unwrap_or("unknown").to_string();
    format!("nalgebra {}; libm, libmvec: {system}", version.unwrap_or("unknown"))
}

#[derive(Serialize)]
pub struct Report {
    machine: Machine,
    sizes: Vec<usize>,
    rows: Vec<Row>,
    ratios: Vec<Ratio>,
}

/// The ratios are measured for a batch in the cache, and for one in memory.
const STREAMED: usize = 1_000_000;

impl Report {
    pub fn new(machine: Machine, sizes: Vec<usize>, rows: Vec<Row>) -> Self {
        Report { machine, sizes, rows, ratios: Vec::new() }
    }

    /// Has the ratios measured that the text claims: of two rows, by their places, at a number of points.
    pub fn compare(&mut self, measure: impl Fn(usize, usize, usize) -> Quartiles) {
        let block =
            |family| move |row: &Row| row.family == family && row.name.contains("block") && !row.name.contains("only");
        let double = |n| self.fastest(n, block(Family::Double));
        let fortran =
            |what| self.fastest(CACHED, move |row| row.name.starts_with("Fortran") && row.name.contains(what));
        let copy = self.fastest(STREAMED, |row| row.family == Family::Copy && row.name.starts_with("f64"));
        let single = self.fastest(CACHED, block(Family::Single));
        let claims = [
            ("fastest Fortran loop / f64 block, 4096 points", fortran("loop"), double(CACHED), CACHED),
            ("scalar Fortran / f64 block, 4096 points", fortran("scalar"), double(CACHED), CACHED),
            ("f64 block / copy limit, 10⁶ points", double(STREAMED), copy, STREAMED),
            ("f64 block / f32 block, 4096 points", double(CACHED), single, CACHED),
        ];
        let ratio = |(name, above, below, points): (_, Option<usize>, Option<usize>, _)| {
            let (above, below) = above.zip(below)?;
            let times = measure(above, below, points);
            let [above, below] = [above, below].map(|row| self.rows[row].name.clone());
            Some(Ratio { name, above, below, points, times })
        };
        self.ratios = claims.into_iter().filter_map(ratio).collect();
    }

    /// Times and ratios in Markdown.
    pub fn summary(&self) -> String {
        let mut text = String::from("# Speed against error\n\n");
        let machine = &self.machine;
        // Writing to a string does not fail.
        let _ = writeln!(text, "{}, one core of {}, {}.", machine.version, machine.processor, machine.date);
        let fortran = machine.fortran.as_deref().unwrap_or("gfortran is missing: its rows are left out");
        let _ = writeln!(text, "{}; {fortran}; {}.\n", machine.rustc, machine.libraries);
        self.write_times(&mut text);
        self.write_ratios(&mut text);
        text
    }

    /// Likewise, with all errors and flags.
    fn text(&self) -> String {
        let mut text = self.summary();
        self.write_errors(&mut text);
        self.write_flags(&mut text);
        text
    }

    /// Writes `speed.md`, `speed.json`, `speed.svg` and `speed.png`.
    pub fn write(&self, folder: &Path) -> Result<(), Box<dyn std::error::Error>> {
        std::fs::create_dir_all(folder)?;
        std::fs::write(folder.join("speed.md"), self.text())?;
        let json = serde_json::to_string_pretty(self)? + "\n";
        std::fs::write(folder.join("speed.json"), &json)?;
        plot::write(&json, folder)
    }

    fn time(&self, row: &Row, n: usize) -> f64 {
        let size = self.sizes.iter().position(|&size| size == n).expect("a measured size");
        row.timings[size].least
    }

    fn write_times(&self, text: &mut String) {
        text.push_str("## Nanoseconds a point\n\n");
        text.push_str(
            "The fastest sample, by points a call; spread: how far the median lies above it, 4096 points.\n\n",
        );
        let mut head: Vec<String> = vec!["".into()];
        head.extend(self.sizes.iter().map(|n| n.to_string()));
        head.extend(["spread", "worst error", "median error", "near rest"].map(String::from));
        let rows = self.rows.iter().map(|row| {
            let mut cells = vec![row.name.clone()];
            cells.extend(row.timings.iter().map(|timing| time(timing.least)));
            let cached = self.sizes.iter().position(|&n| n == CACHED).map(|size| row.timings[size]);
            cells.push(cached.map_or(String::new(), |t| format!("{:.0} %", 100.0 * (t.median / t.least - 1.0))));
            match &row.accuracy {
                Some(a) => cells.extend([a.worst(), a.median(), a.near_rest].map(error)),
                None => cells.extend(["–"; 3].map(String::from)),
            }
            cells
        });
        write_table(text, &head, rows);
    }

    /// The place of the fastest of the rows that qualify.
    fn fastest(&self, n: usize, qualifies: impl Fn(&Row) -> bool) -> Option<usize> {
        let rows = (0..self.rows.len()).filter(|&row| qualifies(&self.rows[row]));
        rows.min_by(|&one, &other| self.time(&self.rows[one], n).total_cmp(&self.time(&self.rows[other], n)))
    }

    fn write_ratios(&self, text: &mut String) {
        text.push_str("\n## Ratios\n\n");
        text.push_str("The two called in turn, each after an untimed call of its own: the median of the pairs, and the middle half.\n\n");
        let rows = self.ratios.iter().map(|Ratio { name, times, .. }| {
            let middle = format!("{:.2} to {:.2}", times.lower_quartile, times.upper_quartile);
            vec![name.to_string(), format!("{:.2}", times.median), middle]
        });
        write_table(text, &["", "times", "middle half"].map(String::from), rows);
    }

    fn write_errors(&self, text: &mut String) {
        text.push_str("\n## Errors by category\n\n");
        text.push_str("|σ − truth|/(|truth| + K) over the truth cases, the worst and in brackets the median.\n\n");
        let with_errors = || self.rows.iter().filter_map(|row| Some((row, row.accuracy.as_ref()?)));
        let Some((_, first)) = with_errors().next() else { return };
        let categories = first.errors.iter().map(|(category, errors)| format!("{category}, {} cases", errors.len()));
        let head: Vec<String> = std::iter::once(String::new()).chain(categories).collect();
        let rows = with_errors().map(|(row, accuracy)| {
            let cell = |errors: &Vec<f64>| format!("{} ({})", error(worst(errors)), error(median(errors)));
            std::iter::once(row.name.clone()).chain(accuracy.errors.values().map(cell)).collect()
        });
        write_table(text, &head, rows);
    }

    fn write_flags(&self, text: &mut String) {
        text.push_str("\n## Flags\n\n");
        for row in self.rows.iter().filter(|row| !row.flags.is_empty()) {
            let _ = writeln!(text, "- {}: `gfortran {}`", row.name, row.flags);
        }
        text.push_str("- everything else: `cargo bench`, the release profile of Cargo.toml\n");
    }
}

/// A time to three digits.
fn time(nanoseconds: f64) -> String {
    let decimals = (2 - nanoseconds.log10().floor() as i32).clamp(0, 2) as usize;
    format!("{nanoseconds:.decimals$}")
}

fn error(value: f64) -> String {
    if value == 0.0 { "0".to_string() } else { format!("{value:.0e}") }
}

/// A table in Markdown whose columns stand in line on a terminal too.
fn write_table(text: &mut String, head: &[String], rows: impl Iterator<Item = Vec<String>>) {
    let rows: Vec<Vec<String>> = rows.collect();
    let width = |c: usize| {
        let cells = rows.iter().map(|row| row[c].chars().count());
        cells.chain([head[c].chars().count()]).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..head.len()).map(width).collect();
    let mut line = |cells: &[String]| {
        for (c, (cell, width)) in cells.iter().zip(&widths).enumerate() {
            let _ = if c == 0 { write!(text, "| {cell:<width$} ") } else { write!(text, "| {cell:>width$} ") };
        }
        text.push_str("|\n");
    };
    line(head);
    let rule = |(c, &width): (usize, &usize)| if c == 0 { "-".repeat(width) } else { "-".repeat(width - 1) + ":" };
    line(&widths.iter().enumerate().map(rule).collect::<Vec<String>>());
    for row in &rows {
        line(row);
    }
}
