//! Runs decks of `ffi-tests/calculix`, and of other folders beside it, in CalculiX and reads what it writes.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;

use nalgebra::Vector3;

use toron_test_support::library::{LIBRARY, OWN_LAW, ROOT, folder, run};

/// Which material a deck runs with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tangent {
    /// The library's own.
    Analytic,
    /// Central differences of the library's stress.
    Numerical,
}

/// The name by which the decks call the library's material.
const MATERIAL: &str = "@TORON_HYPERELASTIC";

static DECKS: LazyLock<PathBuf> = LazyLock::new(|| Path::new(ROOT).join("ffi-tests/calculix"));

/// The solver, built if it is not there yet.
pub static SOLVER: LazyLock<PathBuf> = LazyLock::new(|| {
    let output = run(Command::new("sh").arg(DECKS.join("build.sh")), "dash");
    PathBuf::from(String::from_utf8(output.stdout).expect("a path").trim())
});

/// A folder with the libraries under the names that CalculiX looks for.
static LIBRARIES: LazyLock<PathBuf> = LazyLock::new(|| {
    let folder = folder("calculix-libraries");
    std::fs::copy(LIBRARY.join("libtoron_calculix.so"), folder.join("libTORON.so")).expect("libTORON.so");
    let mut gcc = Command::new("gcc");
    gcc.args(["-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O2", "-shared", "-fPIC", "-o"]);
    gcc.arg(folder.join("libNUMERICAL.so")).arg(DECKS.join("numerical_tangent.c")).arg("-L").arg(&folder);
    run(gcc.arg("-lTORON"), "gcc");
    folder
});

/// A folder with the library of a law of one's own, `@OWN_REINFORCED`.
static OWN_LIBRARY: LazyLock<PathBuf> = LazyLock::new(|| {
    let folder = folder("calculix-own-library");
    std::fs::copy(OWN_LAW.join("libown_law_double.so"), folder.join("libOWN.so")).expect("libOWN.so");
    folder
});

/// Tolerances of the iterations: residual over average force, largest correction over largest increment.
pub fn control(residual: f64, correction: f64) -> String {
    format!(
        "*CONTROLS, PARAMETERS=FIELD\n{residual:e}, {correction:e}\n\
         *CONTROLS, PARAMETERS=TIME INCREMENTATION\n8, 10, 9, 40, 20, 10, , 10\n"
    )
}

/// A deck, with the files that it includes.
pub struct Job<'a> {
    pub deck: &'a str,
    pub includes: &'a [(&'a str, String)],
    pub tangent: Tangent,
}

impl Job<'_> {
    /// The deck as it is committed.
    pub fn deck(name: &str) -> String {
        std::fs::read_to_string(DECKS.join(name)).expect("a deck")
    }

    /// Runs the deck, changed by `edit`, to whatever end it comes.
    pub fn attempt(&self, name: &str, edit: impl Fn(String) -> String) -> (Output, PathBuf) {
        let folder = folder(&format!("calculix-{name}-{:?}", self.tangent));
        let mut deck = edit(Self::deck(self.deck));
        if self.tangent == Tangent::Numerical {
            deck = deck.replace(MATERIAL, "@NUMERICAL_TANGENT");
        }
        let libraries = if deck.contains("@OWN_") { &*OWN_LIBRARY } else { &*LIBRARIES };
        std::fs::write(folder.join("job.inp"), deck).expect("a file");
        for (file, text) in self.includes {
            std::fs::write(folder.join(file), text).expect("a file");
        }
        let mut solver = Command::new(&*SOLVER);
        solver.arg("job").current_dir(&folder).env("LD_LIBRARY_PATH", libraries).env("OMP_NUM_THREADS", "2");
        (solver.output().expect("CalculiX runs"), folder)
    }

    /// Runs the deck to its end, which must be a good one.
    pub fn run(&self) -> Results {
        self.run_edited(self.deck.trim_end_matches(".inp"), |deck| deck)
    }

    /// Runs the deck, changed by `edit`, to its end, which must be a good one.
    pub fn run_edited(&self, name: &str, edit: impl Fn(String) -> String) -> Results {
        let start = std::time::Instant::now();
        let (output, folder) = self.attempt(name, edit);
        let seconds = start.elapsed().as_secs_f64();
        let log = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(output.status.success(), "{name}, {:?}: {}\n{log}", self.tangent, output.status);
        let read = |file: &str| std::fs::read_to_string(folder.join(file)).expect("a file of results");
        Results { iterations: iterations(&read("job.cvg")), tables: tables(&read("job.dat")), log, seconds }
    }
}

/// The eleven properties of a deck's only user material.
pub fn properties(deck: &str) -> Vec<f64> {
    let deck = Job::deck(deck);
    let lines = deck.lines().skip_while(|line| !line.starts_with("*USER MATERIAL")).skip(1);
    let values = lines.take_while(|line| !line.starts_with('*')).flat_map(|line| line.split(','));
    values.map(|value| value.trim().parse().expect("a property")).collect()
}

/// A line of the file on convergence.
#[derive(Clone, Copy, Debug)]
pub struct Iteration {
    pub step: usize,
    pub increment: usize,
    pub attempt: usize,
    /// Number of contact elements.
    pub contact: usize,
    /// Largest residual over average force, and largest correction over largest increment of the displacements.
    pub residual: f64,
    pub correction: f64,
}

/// A table of printed values, a row a node or an integration point.
#[derive(Debug)]
pub struct Table {
    pub title: String,
    pub time: f64,
    pub rows: Vec<Vec<f64>>,
}

pub struct Results {
    pub iterations: Vec<Iteration>,
    pub tables: Vec<Table>,
    pub log: String,
    pub seconds: f64,
}

impl Results {
    /// The tables whose title starts like this, one a printed increment.
    pub fn all(&self, title: &str) -> Vec<&Table> {
        self.tables.iter().filter(|table| table.title.starts_with(title)).collect()
    }

    /// The last of them.
    pub fn last(&self, title: &str) -> &Table {
        self.all(title).last().unwrap_or_else(|| panic!("no table of {title}"))
    }

    /// The iterations of every attempt at an increment.
    pub fn attempts(&self) -> impl Iterator<Item = &[Iteration]> {
        self.iterations.chunk_by(|a, b| (a.step, a.increment, a.attempt) == (b.step, b.increment, b.attempt))
    }
}

/// A number as Fortran prints it: exponents of three digits have no E.
fn number(text: &str) -> f64 {
    let sign = text.rfind(['+', '-']).filter(|&i| i > 0 && text.as_bytes()[i - 1].is_ascii_digit());
    let with_e = sign.map_or_else(|| text.to_string(), |i| format!("{}E{}", &text[..i], &text[i..]));
    with_e.parse().unwrap_or_else(|_| panic!("{text} is no number"))
}

fn iterations(text: &str) -> Vec<Iteration> {
    let rows = text.lines().map(|line| line.split_whitespace().collect::<Vec<_>>());
    let rows = rows.filter(|row| row.len() == 9 && row[0].parse::<usize>().is_ok());
    let count = |text: &str| text.parse().expect("a count");
    rows.map(|row| Iteration {
        step: count(row[0]),
        increment: count(row[1]),
        attempt: count(row[2]),
        contact: count(row[4]),
        residual: number(row[5]) / 100.0,
        correction: number(row[6]) / 100.0,
    })
    .collect()
}

fn tables(text: &str) -> Vec<Table> {
    let mut tables: Vec<Table> = Vec::new();
    for line in text.lines().map(str::trim).filter(|line| !line.is_empty()) {
        if let Some((title, time)) = line.split_once(" and time ") {
            tables.push(Table { title: title.to_string(), time: number(time.trim()), rows: Vec::new() });
        } else if let Some(table) = tables.last_mut() {
            table.rows.push(line.split_whitespace().map(number).collect());
        }
    }
    tables
}

/// A residual over the average force, from which on Newton's method has to converge quadratically.
const NEAR: f64 = 3e-2;

/// r' ≤ C r² there. A tangent that is off by 1 % leaves r' = 0.01 r: too much from r = 1e-3 downwards.
const CONSTANT: f64 = 10.0;

/// Pairs of residuals, one iteration after another, where the first is near and the contact stays as it is.
fn near_pairs(results: &Results) -> Vec<[f64; 2]> {
    let near = |pair: &[Iteration]| match pair {
        [a, b] => (a.residual > 0.0 && a.residual < NEAR && a.contact == b.contact).then_some([a.residual, b.residual]),
        _ => None,
    };
    results.attempts().flat_map(|attempt| attempt.windows(2).filter_map(near)).collect()
}

/// Runs a deck with both tangents; the analytic one may not need more iterations, and must converge quadratically.
pub fn both_tangents(deck: &str, includes: &[(&str, String)]) -> Results {
    let [results, numerical] =
        [Tangent::Analytic, Tangent::Numerical].map(|tangent| Job { deck, includes, tangent }.run());
    let (count, reference) = (results.iterations.len(), numerical.iterations.len());
    let [time, reference_time] = [&results, &numerical].map(|results| results.seconds);
    println!("{deck}: {count} iterations in {time:.2} s; numerical tangent {reference} in {reference_time:.2} s");
    assert!(count <= reference, "{deck}: {count} iterations, {reference} with the numerical tangent");
    assert_quadratic(deck, &results);
    results
}

/// Prints the residuals of a job; near the solution each must be at most a multiple of the square of the one before.
pub fn assert_quadratic(deck: &str, results: &Results) {
    for attempt in results.attempts() {
        let residuals: Vec<_> = attempt.iter().map(|iteration| format!("{:.1e}", iteration.residual)).collect();
        println!(
            "  step {} increment {} attempt {}: {}",
            attempt[0].step,
            attempt[0].increment,
            attempt[0].attempt,
            residuals.join(" ")
        );
    }
    let pairs = near_pairs(results);
    assert!(!pairs.is_empty(), "{deck}: no residual comes near");
    for [before, after] in pairs {
        assert!(after <= CONSTANT * before * before, "{deck}: a residual of {before:e} is followed by {after:e}");
    }
}

/// The last three columns of each row: the components behind a node.
pub fn vectors(table: &Table) -> Vec<Vector3<f64>> {
    table.rows.iter().map(|row| Vector3::from_column_slice(&row[row.len() - 3..])).collect()
}
