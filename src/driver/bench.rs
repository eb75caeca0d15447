//! `toron bench`: what a point costs here, by every way in and every set of instructions, beside what copying its numbers
//! costs.

use std::fmt::Write;
use std::hint::black_box;
use std::path::Path;
use std::time::{Duration, Instant};

use nalgebra::{Matrix3, Scalar};
use serde::Serialize;

use super::parallel::parallel_block;
use super::scene::Scene;
use super::{Error, print};
use crate::host::calls::Umat;
use crate::law::block::{Level, Precision};
use crate::law::hyperelastic::{Hyperelastic, Request};
use crate::law::parameters;
use crate::law::real::Real;
use crate::law::state::{ENERGIES, FAILURE_INDEX, HYPERELASTIC_STATE, INVARIANTS};

/// The sizes of a block: one point, a solver's vectors, a batch that stays in the cache, one that does not.
pub const SIZES: [usize; 6] = [1, 64, 128, 192, 4096, 1_000_000];
/// The law that is measured.
pub const PRESET: &str = "kevlar-km2-600";

/// Every row is timed this often, in turn, and the fastest counts: what disturbs a measurement only makes it longer.
const ROUNDS: usize = 7;
/// A timing repeats the call until it has lasted this long.
const BATCH: Duration = Duration::from_millis(2);

/// A way to evaluate a scene, or what to compare it with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Entry {
    /// Point by point.
    Point,
    /// Point by point through the C entry that Abaqus calls, which prepares the law at every call; with DDSDDE or with none.
    Umat { tangent: bool },
    /// A block: stress, energies, invariants, failure, status.
    Block(Level),
    /// A block: stress and status.
    StressOnly(Level),
    /// A block over the threads of rayon's pool.
    Threads(Level),
    /// No law: the same numbers read and written.
    Copy,
}

impl Entry {
    /// What this processor can run, in either precision.
    pub fn all() -> Vec<Entry> {
        let best = Level::best();
        let levels = Level::ALL.into_iter().filter(|&level| level <= best).map(Entry::Block);
        let others = [Entry::StressOnly(best), Entry::Threads(best), Entry::Copy];
        [Entry::Point].into_iter().chain(levels).chain(others).collect()
    }

    /// What there is in double precision alone.
    const DOUBLE: [Entry; 2] = [Entry::Umat { tangent: false }, Entry::Umat { tangent: true }];

    /// The name in tables.
    pub fn name(self) -> String {
        match self {
            Entry::Point => "point by point".to_string(),
            Entry::Umat { tangent: false } => "UMAT".to_string(),
            Entry::Umat { tangent: true } => "UMAT with DDSDDE".to_string(),
            Entry::Block(level) => format!("block, {}", level.name()),
            Entry::StressOnly(level) => format!("block, {}, stress only", level.name()),
            Entry::Threads(level) => format!("block, {}, {} threads", level.name(), rayon::current_num_threads()),
            Entry::Copy => "copy limit".to_string(),
        }
    }

    /// Evaluates the scene; its state goes on from where it was.
    ///
    /// # Errors
    /// What the law says of the arrays.
    pub fn run<T: Precision + Scalar + Send + Sync>(
        self,
        law: &Hyperelastic<T>,
        scene: &mut Scene<T>,
    ) -> Result<(), crate::law::status::Error> {
        match self {
            Entry::Point => points(law, scene),
            Entry::Umat { tangent } => umat(scene, tangent),
            Entry::Block(level) => drop(law.block(scene.arrays(level))?),
            Entry::StressOnly(level) => drop(law.block(scene.stress_only(level))?),
            Entry::Threads(level) => drop(parallel_block(law, scene.arrays(level))?),
            Entry::Copy => copy(scene),
        }
        Ok(())
    }
}

/// What the law answers for a point: stress, state and status.
pub type Answer<T> = ([T; 6], [T; HYPERELASTIC_STATE], i32);

/// Point by point, as a solver calls a scalar law: from the deformation gradient and the old state to the answer.
pub fn each_point<T: Real + Scalar>(
    scene: &mut Scene<T>,
    mut law: impl FnMut(&Matrix3<T>, &[T; HYPERELASTIC_STATE]) -> Answer<T>,
) {
    let stride = scene.leading_dimension;
    for i in 0..scene.n {
        let f = Matrix3::from_fn(|row, column| scene.deformation_gradient[(3 * column + row) * stride + i]);
        let state: [T; HYPERELASTIC_STATE] = std::array::from_fn(|c| match c {
            ENERGIES..INVARIANTS => scene.energies[(c - ENERGIES) * stride + i],
            INVARIANTS..FAILURE_INDEX => scene.invariants[(c - INVARIANTS) * stride + i],
            _ => scene.failure[(c - FAILURE_INDEX) * stride + i],
        });
        let (stress, state, status) = law(&f, &state);
        for (c, value) in stress.into_iter().enumerate() {
            scene.stress[c * stride + i] = value;
        }
        for (c, value) in state.into_iter().enumerate() {
            match c {
                ENERGIES..INVARIANTS => scene.energies[(c - ENERGIES) * stride + i] = value,
                INVARIANTS..FAILURE_INDEX => scene.invariants[(c - INVARIANTS) * stride + i] = value,
                _ => scene.failure[(c - FAILURE_INDEX) * stride + i] = value,
            }
        }
        scene.status[i] = status;
    }
}

fn points<T: Precision + Scalar>(law: &Hyperelastic<T>, scene: &mut Scene<T>) {
    let wanted = Request { modes: false, wave_modulus: false, ..Request::ALL };
    each_point(scene, |f, state| {
        let point = law.point(f, state, wanted);
        (point.stress, point.state, point.status)
    });
}

/// The properties are the preset's, whatever the law of the other rows.
fn umat<T: Precision + Scalar>(scene: &mut Scene<T>, tangent: bool) {
    let Ok(properties) = properties().try_into() else { return }; // not reached: the preset is this law's
    let mut point = Umat::FRESH;
    each_point(scene, |f, state| {
        point.statev = state.map(Into::into);
        let columns: [f64; 9] = std::array::from_fn(|c| f[c].into());
        let status = point.call(properties, &columns, tangent);
        black_box(&point.ddsdde);
        (point.stress.map(T::splat), point.statev.map(T::splat), status)
    });
}

/// Reads the deformation gradient and the old state and writes stress, state and status, a few lines of every column at a
/// time like a block: what any law must at least do. The state stays what it was.
fn copy<T: Real>(scene: &mut Scene<T>) {
    /// Points of a column at a time.
    const TILE: usize = 64;
    let stride = scene.leading_dimension;
    // Numbers that the compiler does not know, so that it keeps what reads and writes.
    let least = black_box(T::splat(f64::MIN));
    for first in (0..scene.n).step_by(TILE) {
        let count = TILE.min(scene.n - first);
        let tile = |c: usize| c * stride + first..c * stride + first + count;
        let f = &scene.deformation_gradient;
        for c in 0..6 {
            let (one, other) = (&f[tile(c)], &f[tile(6 + c / 2)]);
            for ((stress, &one), &other) in scene.stress[tile(c)].iter_mut().zip(one).zip(other) {
                *stress = one + other;
            }
        }
        for (array, components) in [(&mut scene.energies, 4), (&mut scene.invariants, 4), (&mut scene.failure, 3)] {
            for c in 0..components {
                for value in &mut array[tile(c)] {
                    *value = value.max(least);
                }
            }
        }
        scene.status[tile(0)].fill(0);
    }
}

/// A line of the report.
#[derive(Serialize)]
struct Row {
    name: String,
    /// Nanoseconds a point, in the order of [`SIZES`].
    nanoseconds: Vec<f64>,
    /// Multiples of the copy limit of the same precision.
    copies: Vec<f64>,
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
    let both = Entry::all();
    let mut rows = measured::<f64>("f64", &[&Entry::DOUBLE, &both[..]].concat())?;
    rows.extend(measured::<f32>("f32", &both)?);
    let report =
        Report { version: env!("CARGO_PKG_VERSION"), processor: processor(), preset: PRESET, sizes: SIZES, rows };
    print(&table(&report));
    let Some(folder) = output else { return Ok(()) };
    let file = folder.join("bench.json");
    let fault = |error: &dyn std::fmt::Display| Error::Input(format!("{}: {error}", file.display()));
    std::fs::create_dir_all(folder).map_err(|error| fault(&error))?;
    let text = serde_json::to_string_pretty(&report).map_err(|error| fault(&error))?;
    std::fs::write(&file, text + "\n").map_err(|error| fault(&error))
}

/// The properties of the law that is measured.
pub fn properties() -> &'static [f64] {
    parameters::preset(PRESET).map_or(&[], |preset| preset.values)
}

/// All rows of a precision; the copy limit is the last entry.
fn measured<T: Precision + Scalar + Send + Sync>(precision: &str, entries: &[Entry]) -> Result<Vec<Row>, Error> {
    let properties: Vec<T> = properties().iter().map(|&value| T::splat(value)).collect();
    let fault = |error: crate::law::status::Error| Error::Evaluation(error.to_string());
    let law = Hyperelastic::new(&properties).map_err(fault)?;
    let mut times = vec![Vec::new(); entries.len()];
    for n in SIZES {
        let mut scene = Scene::<T>::impact(n);
        for (times, time) in times.iter_mut().zip(fastest(entries, &law, &mut scene).map_err(fault)?) {
            times.push(time);
        }
    }
    let copies = times.last().cloned().unwrap_or_default();
    let row = |(entry, nanoseconds): (&Entry, Vec<f64>)| Row {
        name: format!("{precision} {}", entry.name()),
        copies: nanoseconds.iter().zip(&copies).map(|(time, copy)| time / copy).collect(),
        nanoseconds,
    };
    Ok(entries.iter().zip(times).map(row).collect())
}

/// Nanoseconds a point of every entry: the fastest of some rounds, each of which times them all in turn.
fn fastest<T: Precision + Scalar + Send + Sync>(
    entries: &[Entry],
    law: &Hyperelastic<T>,
    scene: &mut Scene<T>,
) -> Result<Vec<f64>, crate::law::status::Error> {
    let mut best = vec![f64::INFINITY; entries.len()];
    for _ in 0..ROUNDS {
        for (&entry, best) in entries.iter().zip(&mut best) {
            // What the last entry left in the caches is no business of this one.
            entry.run(law, scene)?;
            let start = Instant::now();
            let mut calls = 0;
            while start.elapsed() < BATCH {
                // So many at a time that the clock does not count.
                for _ in 0..256_usize.div_ceil(scene.n) {
                    entry.run(black_box(law), black_box(scene))?;
                    calls += 1;
                }
            }
            *best = best.min(start.elapsed().as_secs_f64() * 1e9 / (calls * scene.n) as f64);
        }
    }
    Ok(best)
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
            let _ = write!(text, "{:>15}", format!("{time:.2} ({copies:.1})"));
        }
    }
    let row = |entry: Entry| report.rows.iter().find(|row| row.name == format!("f64 {}", entry.name()));
    if let [Some(alone), Some(with)] = Entry::DOUBLE.map(row) {
        let _ = write!(text, "\n\n{:<30}", "DDSDDE or not, ratio");
        for (with, alone) in with.nanoseconds.iter().zip(&alone.nanoseconds) {
            let _ = write!(text, "{:>15}", format!("{:.2}", with / alone));
        }
    }
    text + "\n"
}
