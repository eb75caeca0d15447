//! `toron bench`: what a point costs here, by every way in and every set of instructions, beside what copying its
//! numbers costs.

use std::hint::black_box;
use std::path::Path;

use nalgebra::Scalar;
use serde::Serialize;

use super::choices::{self, Choice};
use super::entries::Entry;
use super::hosts::{Host, HostArrays, call};
use super::scene::Scene;
use super::timing::Best;
use crate::entries::precision::BlockPrecision;
use toron::Hyperelastic;
use toron::law::block::Precision;
use toron::law::parameters;
use toron_shared::console::print;
use toron_shared::error::Error;
use toron_shared::run_directory::{RunDirectory, Writes};
use toron_shared::text_table::plain_table;

/// The sizes of a block: one point, a few, a solver's vectors, a batch that stays in the cache, one that does not.
pub const SIZES: [usize; 6] = [1, 8, 64, 192, 4096, 1_000_000];
/// No host keeps more points than these in the arrays of one call.
const LARGEST_HOST: usize = 4096;
/// The law that is measured.
pub const PRESET: &str = "kevlar-km2-600";

/// Every row is timed this often, in turn, and the fastest counts: what disturbs a measurement only makes it longer.
/// Short and many, since a processor's clock changes within a second: each row is to meet it at its fastest.
const ROUNDS: usize = 40;
/// The same for more points than [`LARGEST_HOST`].
const ROUNDS_OF_MANY: usize = 7;

/// A line of the report.
#[derive(Serialize)]
struct Row {
    name: String,
    /// Nanoseconds a point, in the order of [`SIZES`]; none where no host has so many points.
    nanoseconds: Vec<Option<f64>>,
    /// Multiples of the copy limit of the same precision.
    copies: Vec<Option<f64>>,
}

#[derive(Serialize)]
struct Report {
    version: &'static str,
    processor: String,
    preset: &'static str,
    sizes: [usize; 6],
    rows: Vec<Row>,
    choices: Vec<Choice>,
}

/// Measures the library on this machine, prints a table, and writes `bench.json` to `output` if there is one.
///
/// # Errors
/// The file cannot be written.
pub fn run(output: Option<&Path>) -> Result<(), Error> {
    let writes = Writes { command: "bench", names: vec!["bench".to_string()], ..Writes::default() };
    let locked = output.map(|output| RunDirectory::lock(output, writes)).transpose()?;
    let mut rows = measured::<f64>("f64", &[&Host::BOTH[..], &Host::DOUBLE].concat())?;
    rows.extend(measured::<f32>("f32", &Host::BOTH)?);
    let report = Report {
        version: env!("CARGO_PKG_VERSION"),
        processor: processor(),
        preset: PRESET,
        sizes: SIZES,
        rows,
        choices: choices::measured()?,
    };
    print(&table(&report));
    let (Some(output), Some(locked)) = (output, locked) else { return Ok(()) };
    let _directory = locked.claim()?;
    let file = output.join("bench.json");
    let file_error = |error: &dyn std::fmt::Display| Error::Input(format!("{}: {error}", file.display()));
    let text = serde_json::to_string_pretty(&report).map_err(|error| file_error(&error))?;
    std::fs::write(&file, text + "\n").map_err(|error| file_error(&error))
}

/// The properties of the law that is measured.
pub fn properties() -> &'static [f64] {
    parameters::preset(PRESET).map_or(&[], |preset| preset.values)
}

/// All rows of a precision, its hosts' and then the law's own; the copy limit is the last one.
fn measured<T: Precision + BlockPrecision + Scalar>(precision: &str, hosts: &[Host]) -> Result<Vec<Row>, Error> {
    let values: Vec<T> = properties().iter().map(|&value| T::splat(value)).collect();
    let law_error = |error: toron::Error| Error::Evaluation(error.to_string());
    let law = Hyperelastic::new(&values).map_err(law_error)?;
    let values = choices::all_properties(values)?;
    let entries = Entry::all();
    let mut times = vec![Vec::new(); hosts.len() + entries.len()];
    for n in SIZES {
        let mut scene = Scene::<T>::impact(n);
        let mut arrays = match n <= LARGEST_HOST {
            true => Some(HostArrays::new(&values, &scene).map_err(Error::Evaluation)?),
            false => None,
        };
        let mut best = vec![Best::default(); times.len()];
        for _ in 0..if n <= LARGEST_HOST { ROUNDS } else { ROUNDS_OF_MANY } {
            let (of_hosts, of_entries) = best.split_at_mut(hosts.len());
            if let Some(arrays) = &mut arrays {
                for (&host, best) in hosts.iter().zip(of_hosts) {
                    best.time(|| {
                        call(host, black_box(&mut scene), arrays);
                        Ok(())
                    })
                    .map_err(law_error)?;
                }
            }
            for (&entry, best) in entries.iter().zip(of_entries) {
                best.time(|| entry.run(black_box(&law), &mut scene)).map_err(law_error)?;
            }
        }
        for (times, best) in times.iter_mut().zip(best) {
            times.push(best.seconds.map(|seconds| seconds * 1e9 / n as f64));
        }
    }
    let copies = times.last().cloned().unwrap_or_default();
    let names = hosts.iter().map(|host| host.name().to_string()).chain(entries.iter().map(|entry| entry.name()));
    let row = |(name, nanoseconds): (String, Vec<Option<f64>>)| Row {
        name: format!("{precision} {name}"),
        copies: nanoseconds.iter().zip(&copies).map(|(time, copy)| Some((*time)? / (*copy)?)).collect(),
        nanoseconds,
    };
    Ok(names.zip(times).map(row).collect())
}

/// The processor's name, where the system tells it.
pub fn processor() -> String {
    let information = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = information.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    name.map_or_else(|| std::env::consts::ARCH.to_string(), |(_, name)| name.to_string())
}

fn table(report: &Report) -> String {
    let Report { version, processor, .. } = report;
    let title = format!(
        "toron {version} on {processor}, {PRESET}\n\nnanoseconds a point, in brackets multiples of the copy limit\n\n"
    );
    let head: Vec<String> =
        std::iter::once("points a call".to_string()).chain(report.sizes.map(|n| n.to_string())).collect();
    let cells = |row: &Row| {
        let cell = |(time, copies): (&Option<f64>, &Option<f64>)| {
            time.zip(*copies).map_or("–".to_string(), |(time, copies)| format!("{time:.2} ({copies:.1})"))
        };
        std::iter::once(row.name.clone()).chain(row.nanoseconds.iter().zip(&row.copies).map(cell)).collect()
    };
    let rows: Vec<Vec<String>> = report.rows.iter().map(cells).collect();
    let line = |cells: &Vec<String>| {
        let behind: String = cells[1..].iter().map(|cell| format!("{cell:>15}")).collect();
        format!("{:<30}{behind}\n", cells[0])
    };
    let text = || line(&head) + &rows.iter().map(line).collect::<String>();
    let titles: Vec<&str> = head.iter().map(String::as_str).collect();
    format!("{title}{}\n{}", plain_table(&titles, &rows, text), choices::table(&report.choices))
}
