//! `toron bench`: what a point costs here, by every way in and every set of instructions, beside what copying its numbers
//! costs.

use std::fmt::Write;
use std::hint::black_box;
use std::path::Path;
use std::time::{Duration, Instant};

use nalgebra::Scalar;
use serde::Serialize;

use super::entries::Entry;
use super::hosts::{Host, HostArrays, call};
use super::scene::Scene;
use crate::common::console::print;
use crate::common::error::Error;
use crate::entries::precision::BlockPrecision;
use toron::Hyperelastic;
use toron::law::block::Precision;
use toron::law::parameters::{self, HYPERELASTIC_PROPERTIES};

/// The sizes of a block: one point, a few, a solver's vectors, a batch that stays in the cache, one that does not.
pub const SIZES: [usize; 6] = [1, 8, 64, 192, 4096, 1_000_000];
/// No host keeps more points than these in the arrays of one call.
const LARGEST_HOST: usize = 4096;
/// The law that is measured.
pub const PRESET: &str = "kevlar-km2-600";

/// Every row is timed this often, in turn, and the fastest counts: what disturbs a measurement only makes it longer. Short and many,
/// since a processor's clock changes within a second: each row is to meet it at its fastest.
const ROUNDS: usize = 40;
/// The same for more points than [`LARGEST_HOST`].
const ROUNDS_OF_MANY: usize = 7;
/// A timing repeats the call until it has lasted this long.
const BATCH: Duration = Duration::from_millis(1);

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
}

/// Measures the library on this machine, prints a table, and writes `bench.json` to `output` if there is one.
///
/// # Errors
/// The file cannot be written.
pub fn run(output: Option<&Path>) -> Result<(), Error> {
    let mut rows = measured::<f64>("f64", &[&Host::BOTH[..], &Host::DOUBLE].concat())?;
    rows.extend(measured::<f32>("f32", &Host::BOTH)?);
    let report =
        Report { version: env!("CARGO_PKG_VERSION"), processor: processor(), preset: PRESET, sizes: SIZES, rows };
    print(&table(&report));
    let Some(folder) = output else { return Ok(()) };
    let file = folder.join("bench.json");
    let file_error = |error: &dyn std::fmt::Display| Error::Input(format!("{}: {error}", file.display()));
    std::fs::create_dir_all(folder).map_err(|error| file_error(&error))?;
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
    let values: [T; HYPERELASTIC_PROPERTIES] =
        values.try_into().map_err(|_| Error::Evaluation("the preset has other properties".to_string()))?;
    let entries = Entry::all();
    let mut times = vec![Vec::new(); hosts.len() + entries.len()];
    for n in SIZES {
        let mut scene = Scene::<T>::impact(n);
        let mut arrays = match n <= LARGEST_HOST {
            true => Some(HostArrays::new(&values, &scene).map_err(Error::Evaluation)?),
            false => None,
        };
        let mut best = vec![None; times.len()];
        for _ in 0..if n <= LARGEST_HOST { ROUNDS } else { ROUNDS_OF_MANY } {
            let (of_hosts, of_entries) = best.split_at_mut(hosts.len());
            if let Some(arrays) = &mut arrays {
                for (&host, best) in hosts.iter().zip(of_hosts) {
                    faster(best, &mut scene, |scene| {
                        call(host, black_box(&values), scene, arrays);
                        Ok(())
                    })
                    .map_err(law_error)?;
                }
            }
            for (&entry, best) in entries.iter().zip(of_entries) {
                faster(best, &mut scene, |scene| entry.run(black_box(&law), scene)).map_err(law_error)?;
            }
        }
        for (times, best) in times.iter_mut().zip(best) {
            times.push(best);
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

/// Nanoseconds a point of one more round, where they are fewer than those of the rounds before.
fn faster<T: Precision>(
    best: &mut Option<f64>,
    scene: &mut Scene<T>,
    mut run: impl FnMut(&mut Scene<T>) -> Result<(), toron::Error>,
) -> Result<(), toron::Error> {
    // One call first, so that the caches hold this row's data and not the last one's.
    run(scene)?;
    let start = Instant::now();
    let mut calls = 0;
    while start.elapsed() < BATCH {
        // So many at a time that the clock does not count.
        for _ in 0..256_usize.div_ceil(scene.n) {
            run(black_box(scene))?;
            calls += 1;
        }
    }
    let time = start.elapsed().as_secs_f64() * 1e9 / (calls * scene.n) as f64;
    *best = Some(best.map_or(time, |best| best.min(time)));
    Ok(())
}

/// The processor's name, where the system tells it.
pub fn processor() -> String {
    let information = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = information.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    name.map_or_else(|| std::env::consts::ARCH.to_string(), |(_, name)| name.to_string())
}

fn table(report: &Report) -> String {
    let mut text = format!(
        "toron {} on {}, {PRESET}\n\nnanoseconds a point, in brackets multiples of the copy limit\n\n{:<30}",
        report.version, report.processor, "points a call"
    );
    // Writing to a string does not fail.
    for n in report.sizes {
        let _ = write!(text, "{n:>15}");
    }
    for row in &report.rows {
        let _ = write!(text, "\n{:<30}", row.name);
        for (time, copies) in row.nanoseconds.iter().zip(&row.copies) {
            let cell = time.zip(*copies).map_or("–".to_string(), |(time, copies)| format!("{time:.2} ({copies:.1})"));
            let _ = write!(text, "{cell:>15}");
        }
    }
    let row = |host: Host| report.rows.iter().find(|row| row.name == format!("f64 {}", host.name()));
    let ratios = [
        ("DDSDDE or not, ratio", Host::Umat { tangent: true }, Host::Umat { tangent: false }),
        ("C block / C point, ratio", Host::Block, Host::Point { tangent: false }),
        ("OpenRadioss / C blocks, ratio", Host::OpenRadioss, Host::BlockOfGroup),
    ];
    for (name, above, below) in ratios {
        let Some((above, below)) = row(above).zip(row(below)) else { continue };
        let _ = write!(text, "\n\n{name:<30}");
        for (above, below) in above.nanoseconds.iter().zip(&below.nanoseconds) {
            let cell = above.zip(*below).map_or("–".to_string(), |(above, below)| format!("{:.2}", above / below));
            let _ = write!(text, "{cell:>15}");
        }
    }
    text + "\n"
}
