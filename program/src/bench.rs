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
use crate::entries::{
    self, BlockPrecision, CalculixPoint, LsdynaElement, LsdynaVector, OnePoint, SolverBlock, Umat, VumatArrays,
};
use toron::Level;
use toron::Real;
use toron::law::block::Precision;
use toron::law::parameters::{self, HYPERELASTIC_PROPERTIES};
use toron::law::state::{ENERGIES, FAILURE_INDEX, HYPERELASTIC_STATE, INVARIANTS};
use toron::law::status;
use toron::{Hyperelastic, Request};

/// The sizes of a block: one point, a few, a solver's vectors, a batch that stays in the cache, one that does not.
pub const SIZES: [usize; 6] = [1, 8, 64, 192, 4096, 1_000_000];
/// No host keeps more points than these in the arrays of one call.
const LARGEST_HOST: usize = 4096;
/// The law that is measured.
pub const PRESET: &str = "kevlar-km2-600";

/// Every row is timed this often, in turn, and the fastest counts: what disturbs a measurement only makes it longer.
const ROUNDS: usize = 7;
/// A timing repeats the call until it has lasted this long.
const BATCH: Duration = Duration::from_millis(2);

/// A way to evaluate a scene, or what to compare it with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Entry {
    /// Point by point, with a law that has been prepared once.
    Point,
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

    /// The name in tables.
    pub fn name(self) -> String {
        match self {
            Entry::Point => "point by point".to_string(),
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
    ) -> Result<(), toron::Error> {
        match self {
            Entry::Point => points(law, scene),
            Entry::Block(level) => drop(law.block(scene.arrays(level))?),
            Entry::StressOnly(level) => drop(law.block(scene.stress_only(level))?),
            Entry::Threads(level) => drop(parallel_block(law, scene.arrays(level))?),
            Entry::Copy => copy(scene),
        }
        Ok(())
    }
}

/// A C entry as its host calls it. Those for one point are called point by point on the scene's arrays; they prepare the law at
/// every call. The others have arrays of their own, laid out as the host keeps them, with the scene's deformations.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Host {
    /// `toron_hyperelastic_point`, with dS/dE or with none.
    Point {
        tangent: bool,
    },
    /// `toron_hyperelastic_block`.
    Block,
    Umat {
        tangent: bool,
    },
    Vumat,
    Lsdyna,
    LsdynaVector,
    /// With dS/dE, which it wants at every call.
    Calculix,
}

impl Host {
    /// Those in either precision.
    const BOTH: [Host; 6] = [
        Host::Point { tangent: false },
        Host::Point { tangent: true },
        Host::Block,
        Host::Vumat,
        Host::Lsdyna,
        Host::LsdynaVector,
    ];
    /// Those in double precision alone.
    const DOUBLE: [Host; 3] = [Host::Umat { tangent: false }, Host::Umat { tangent: true }, Host::Calculix];

    fn name(self) -> &'static str {
        match self {
            Host::Point { tangent: false } => "C point",
            Host::Point { tangent: true } => "C point with dS/dE",
            Host::Block => "C block",
            Host::Umat { tangent: false } => "UMAT",
            Host::Umat { tangent: true } => "UMAT with DDSDDE",
            Host::Vumat => "VUMAT",
            Host::Lsdyna => "LS-DYNA scalar",
            Host::LsdynaVector => "LS-DYNA vectorised",
            Host::Calculix => "CalculiX with dS/dE",
        }
    }
}

/// The arrays of the hosts that keep points in arrays.
struct HostArrays<T> {
    state: Vec<T>,
    vumat: VumatArrays<T>,
    lsdyna: LsdynaVector<T>,
}

impl<T: Precision + BlockPrecision> HostArrays<T> {
    /// With the scene's deformations, or their symmetric parts for a host that passes a stretch: for small shears that is one.
    fn new(scene: &Scene<T>) -> Self {
        let (n, stride) = (scene.n, scene.leading_dimension);
        let (mut vumat, mut lsdyna) = (VumatArrays::new(n), LsdynaVector::new(n));
        let half = T::splat(0.5);
        for i in 0..n {
            let f = |row: usize, column: usize| scene.deformation_gradient[(3 * column + row) * stride + i];
            for (c, (row, column)) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)].into_iter().enumerate() {
                vumat.stretch[c * n + i] = half * (f(row, column) + f(column, row));
            }
            for c in 0..9 {
                lsdyna.history[(HYPERELASTIC_STATE + c) * n + i] = f(c % 3, c / 3);
            }
        }
        HostArrays { state: vec![T::splat(0.0); HYPERELASTIC_STATE * stride], vumat, lsdyna }
    }
}

/// Calls a host's entry for all points.
fn call<T: Precision + BlockPrecision + Scalar>(
    host: Host,
    properties: &[T; HYPERELASTIC_PROPERTIES],
    scene: &mut Scene<T>,
    arrays: &mut HostArrays<T>,
) {
    let columns = |f: &Matrix3<T>| -> [T; 9] { std::array::from_fn(|c| f[c]) };
    match host {
        Host::Point { tangent } => {
            let mut point = OnePoint::default();
            each_point(scene, |f, state| {
                point.state = *state;
                let status = point.call(properties, &columns(f), tangent);
                black_box(&point.tangent);
                (point.stress, point.state, status)
            });
        }
        Host::Block => {
            let block = SolverBlock {
                n: scene.n,
                leading_dimension: scene.leading_dimension,
                deformation_gradient: &scene.deformation_gradient,
                state: &mut arrays.state,
                energies: true,
                failure: true,
                stress: &mut scene.stress,
                wave_speed: None,
                status: &mut scene.status,
            };
            entries::hyperelastic_block(properties, block);
        }
        Host::Vumat => {
            arrays.vumat.call(properties);
            let VumatArrays { state_old, state_new, .. } = &mut arrays.vumat;
            std::mem::swap(state_old, state_new); // as Abaqus does from step to step
        }
        Host::Lsdyna => {
            let zero = T::splat(0.0);
            let mut element = LsdynaElement { stress: [zero; 6], history: [zero; HYPERELASTIC_STATE + 9] };
            each_point(scene, |f, state| {
                let (old, gradient) = element.history.split_at_mut(HYPERELASTIC_STATE);
                old.copy_from_slice(state);
                gradient.copy_from_slice(&columns(f));
                let status = element.call(properties);
                (element.stress, std::array::from_fn(|c| element.history[c]), status)
            });
        }
        Host::LsdynaVector => drop(arrays.lsdyna.call(properties)),
        Host::Umat { .. } | Host::Calculix => double(host, &properties.map(Into::into), scene),
    }
}

/// The hosts in double precision alone.
fn double<T: Precision + Scalar>(host: Host, properties: &[f64; HYPERELASTIC_PROPERTIES], scene: &mut Scene<T>) {
    let (mut umat, mut calculix) = (Umat::FRESH, CalculixPoint::default());
    each_point(scene, |f, state| {
        let (columns, state): ([f64; 9], _) = (std::array::from_fn(|c| f[c].into()), state.map(Into::into));
        let (stress, state, status) = match host {
            Host::Umat { tangent } => {
                umat.statev = state;
                let status = umat.call(properties, &columns, tangent);
                black_box(&umat.ddsdde);
                (umat.stress, umat.statev, status)
            }
            _ => {
                calculix.state_old = state;
                calculix.call(properties, &columns);
                black_box(&calculix.stiffness);
                (calculix.stress, calculix.state, status::OK)
            }
        };
        (stress.map(T::splat), state.map(T::splat), status)
    });
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
    let fault = |error: &dyn std::fmt::Display| Error::Input(format!("{}: {error}", file.display()));
    std::fs::create_dir_all(folder).map_err(|error| fault(&error))?;
    let text = serde_json::to_string_pretty(&report).map_err(|error| fault(&error))?;
    std::fs::write(&file, text + "\n").map_err(|error| fault(&error))
}

/// The properties of the law that is measured.
pub fn properties() -> &'static [f64] {
    parameters::preset(PRESET).map_or(&[], |preset| preset.values)
}

/// All rows of a precision, its hosts' and then the law's own; the copy limit is the last one.
fn measured<T: Precision + BlockPrecision + Scalar>(precision: &str, hosts: &[Host]) -> Result<Vec<Row>, Error> {
    let values: Vec<T> = properties().iter().map(|&value| T::splat(value)).collect();
    let fault = |error: toron::Error| Error::Evaluation(error.to_string());
    let law = Hyperelastic::new(&values).map_err(fault)?;
    let values: [T; HYPERELASTIC_PROPERTIES] =
        values.try_into().map_err(|_| Error::Evaluation("the preset has other properties".to_string()))?;
    let entries = Entry::all();
    let mut times = vec![Vec::new(); hosts.len() + entries.len()];
    for n in SIZES {
        let mut scene = Scene::<T>::impact(n);
        let mut arrays = (n <= LARGEST_HOST).then(|| HostArrays::new(&scene));
        let mut best = vec![None; times.len()];
        for _ in 0..ROUNDS {
            let (of_hosts, of_entries) = best.split_at_mut(hosts.len());
            if let Some(arrays) = &mut arrays {
                for (&host, best) in hosts.iter().zip(of_hosts) {
                    faster(best, &mut scene, |scene| {
                        call(host, black_box(&values), scene, arrays);
                        Ok(())
                    })
                    .map_err(fault)?;
                }
            }
            for (&entry, best) in entries.iter().zip(of_entries) {
                faster(best, &mut scene, |scene| entry.run(black_box(&law), scene)).map_err(fault)?;
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
    // What the last row left in the caches is no business of this one.
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
