//! Speed against error: the library and what it is measured against, on the same points, in one run on one core.
//!
//! `cargo bench` measures, prints a table and writes `benches/results/`; docs/results/speed.md says how to read it.

mod baselines;
mod report;

use std::path::{Path, PathBuf};
use std::time::Duration;

use baselines::{eigen, fortran, literal};
use criterion::Criterion;
use nalgebra::{Matrix3, Scalar};
use report::{Accuracy, Family, Machine, Quartiles, Report, Row};
use serde::Deserialize;
use toron::Hyperelastic;
use toron::Level;
use toron::law::block::Precision;
use toron::law::state::HYPERELASTIC_STATE;
use toron::law::thesis::Yarn;
use toron_materials::bench::command::{SIZES, processor, properties};
use toron_materials::bench::entries::{Answer, Entry, each_point};
use toron_materials::bench::scene::Scene;
use toron_materials::bench::timing::in_turn;
use toron_test_support::truth::{Case, cases};

/// Every row is measured this often, in turn with the others, so that what disturbs one moment disturbs all.
const ROUNDS: usize = 6;
/// Points in all the pairs of calls that a ratio is the median of, and the least number of pairs.
const PAIRED: usize = 2_000_000;
const LEAST_PAIRS: usize = 51;
/// A point of the truth fills this many points, so that lanes and vectorised loops run as they do in a block.
const COPIES: usize = 16;

/// What evaluates a scene.
type Evaluate<T> = Box<dyn Fn(&mut Scene<T>)>;
/// What makes a kernel of the properties.
type Prepare = Box<dyn Fn(&[f64]) -> Kernel>;

/// A law with its properties, ready to evaluate scenes.
enum Kernel {
    Double(Evaluate<f64>),
    Single(Evaluate<f32>),
}

/// What a row of the report measures.
struct Implementation {
    name: String,
    family: Family,
    /// How it was compiled, where that differs from the benchmark itself.
    flags: String,
    /// Whether it evaluates the scene's points one by one, not its arrays.
    by_point: bool,
    kernel: Prepare,
}

fn main() {
    let compiler = fortran::compiler();
    let implementations = implementations(compiler.is_some());
    let kernels: Vec<Kernel> = implementations.iter().map(|one| (one.kernel)(properties())).collect();
    let timings = timings(&implementations, &kernels);
    let cases = cases();
    let row = |(implementation, timings): (&Implementation, Vec<Quartiles>)| Row {
        name: implementation.name.clone(),
        family: implementation.family,
        flags: implementation.flags.clone(),
        timings,
        accuracy: (implementation.family != Family::Copy).then(|| accuracy(implementation, &cases)),
    };
    let rows = implementations.iter().zip(timings).map(row).collect();
    let mut report = Report::new(Machine::new(processor(), compiler), SIZES.to_vec(), rows);
    report.compare(|above, below, n| ratios(&kernels[above], &kernels[below], n));
    print!("\n{}", report.summary());
    report.write(&Path::new(env!("CARGO_MANIFEST_DIR")).join("results")).expect("the results are written");
}

fn implementations(has_fortran: bool) -> Vec<Implementation> {
    let mut rows = vec![
        scalar("Rust Eq. 4.14, scalar", Family::Literal, literal::point),
        scalar("Rust eigenvalues, scalar", Family::Eigen, eigen::point),
    ];
    if has_fortran {
        for routine in fortran::rows() {
            let routine = routine.expect("the Fortran baselines compile");
            rows.push(Implementation {
                name: routine.name.clone(),
                family: if routine.name.contains("spatial") { Family::Spatial } else { Family::Literal },
                flags: routine.flags.clone(),
                by_point: routine.by_point(),
                kernel: Box::new(move |properties| {
                    let (routine, properties) = (routine.clone(), properties.to_vec());
                    Kernel::Double(Box::new(move |scene| routine.run(&properties, scene)))
                }),
            });
        }
    }
    let best = Level::best();
    let blocks = Level::ALL.into_iter().filter(|&level| level <= best).map(Entry::Block);
    let entries: Vec<Entry> =
        [Entry::Point].into_iter().chain(blocks).chain([Entry::StressOnly(best), Entry::Copy]).collect();
    rows.extend(entries.iter().map(|&entry| library(entry, "f64", Family::Double, Kernel::Double)));
    rows.extend(entries.iter().skip(1).map(|&entry| library(entry, "f32", Family::Single, Kernel::Single)));
    rows
}

/// A law of one point in Rust.
fn scalar<L>(name: &str, family: Family, law: L) -> Implementation
where
    L: Fn(&Yarn<f64>, &Matrix3<f64>, &[f64; HYPERELASTIC_STATE]) -> Answer<f64> + Copy + 'static,
{
    let kernel = move |properties: &[f64]| {
        let yarn = baselines::yarn(properties);
        Kernel::Double(Box::new(move |scene| each_point(scene, |f, state| law(&yarn, f, state))))
    };
    Implementation { name: name.to_string(), family, flags: String::new(), by_point: true, kernel: Box::new(kernel) }
}

/// A way into the library.
fn library<T: Precision + Scalar + Send + Sync>(
    entry: Entry,
    precision: &str,
    family: Family,
    wrap: fn(Evaluate<T>) -> Kernel,
) -> Implementation {
    let kernel = move |properties: &[f64]| {
        let properties: Vec<T> = properties.iter().map(|&value| T::splat(value)).collect();
        let law = Hyperelastic::new(&properties).expect("valid properties");
        wrap(Box::new(move |scene| entry.run(&law, scene).expect("a valid block")))
    };
    Implementation {
        name: format!("{}{precision} {}", if entry == Entry::Copy { "" } else { "toron " }, entry.name()),
        family: if entry == Entry::Copy { Family::Copy } else { family },
        flags: String::new(),
        by_point: entry == Entry::Point,
        kernel: Box::new(kernel),
    }
}

/// Where criterion keeps the measurements of a round.
fn output(round: usize) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("criterion").join(round.to_string())
}

/// Short samples in place of criterion's eight seconds a row: the rounds make up for it.
fn criterion(round: usize) -> Criterion {
    Criterion::default()
        .output_directory(&output(round))
        .warm_up_time(Duration::from_millis(5))
        .measurement_time(Duration::from_millis(30))
        .sample_size(10)
        .nresamples(1000)
        .configure_from_args()
}

/// One measurement as criterion stores it: how many calls each sample made and how many nanoseconds they took.
#[derive(Deserialize)]
struct Sample {
    iters: Vec<f64>,
    times: Vec<f64>,
}

/// Times of a point, by row and size.
fn timings(implementations: &[Implementation], kernels: &[Kernel]) -> Vec<Vec<Quartiles>> {
    // What an earlier run left must not be read as this one's.
    (0..ROUNDS).for_each(|round| drop(std::fs::remove_dir_all(output(round))));
    let mut timings: Vec<Vec<Quartiles>> = kernels.iter().map(|_| Vec::new()).collect();
    for n in SIZES {
        let (mut double, mut single) = (Scene::impact(n), Scene::impact(n));
        let mut samples: Vec<Vec<f64>> = kernels.iter().map(|_| Vec::new()).collect();
        for round in 0..ROUNDS {
            let mut criterion = criterion(round);
            for ((kernel, Implementation { name, .. }), samples) in
                kernels.iter().zip(implementations).zip(&mut samples)
            {
                let mut group = criterion.benchmark_group(n.to_string());
                match kernel {
                    Kernel::Double(run) => group.bench_function(name, |bench| bench.iter(|| run(&mut double))),
                    Kernel::Single(run) => group.bench_function(name, |bench| bench.iter(|| run(&mut single))),
                };
                group.finish();
                samples.extend(samples_of(round, n, name));
            }
        }
        for (timings, samples) in timings.iter_mut().zip(samples) {
            timings.push(Quartiles::new(samples.into_iter().map(|call| call / n as f64).collect()));
        }
    }
    timings
}

/// The ratios of the times of two kernels called in turn.
fn ratios(above: &Kernel, below: &Kernel, n: usize) -> Quartiles {
    let (mut double, mut single) = (Scene::impact(n), Scene::impact(n));
    let call = |side: usize| match [above, below][side] {
        Kernel::Double(run) => run(&mut double),
        Kernel::Single(run) => run(&mut single),
    };
    let times = in_turn(call, [1, 1], (PAIRED / n).max(LEAST_PAIRS));
    Quartiles::new(times.into_iter().map(|[above, below]| above / below).collect())
}

/// Nanoseconds a call of every sample of a row in a round.
fn samples_of(round: usize, n: usize, name: &str) -> Vec<f64> {
    let file = output(round).join(n.to_string()).join(name).join("new/sample.json");
    let text = std::fs::read_to_string(&file).expect("criterion has stored its samples");
    let sample: Sample = serde_json::from_str(&text).expect("samples");
    sample.times.iter().zip(&sample.iters).map(|(time, calls)| time / calls).collect()
}

fn accuracy(implementation: &Implementation, cases: &[Case]) -> Accuracy {
    let mut accuracy = Accuracy::default();
    for case in cases {
        let stress = match (implementation.kernel)(&case.properties()) {
            Kernel::Double(run) => stress(case, implementation.by_point, run),
            Kernel::Single(run) => stress(case, implementation.by_point, run),
        };
        let [error, relative] = case.stress_errors(&stress);
        accuracy.add(&case.category, error, relative);
    }
    accuracy
}

/// The stress that a law gives for a case of the truth.
fn stress<T: Precision>(case: &Case, by_point: bool, run: impl Fn(&mut Scene<T>)) -> [f64; 6] {
    let mut scene = Scene::new(COPIES, std::iter::repeat(case.deformation_gradient()));
    run(&mut scene);
    let of_block = || std::array::from_fn(|c| scene.stress[c * scene.leading_dimension]);
    (if by_point { scene.points[0].stress } else { of_block() }).map(Into::into)
}
