//! What an entry, an output, a layout or a block's size costs beside another: ratios of calls in turn, since single
//! times of different moments are not to be divided by one another where a processor's clock changes.

use std::convert::Infallible;
use std::time::Duration;

use serde::Serialize;

use super::command::properties;
use super::friction::{Fibres, of_friction};
use super::hosts::{Host, HostArrays, call, whole};
use super::scene::{Scene, impacts};
use super::timing::{calls_that_last, in_turn};
use crate::entries::aligned::Aligned;
use crate::entries::blocks::{SolverBlock, prepared};
use crate::entries::hosts::{Given, PointOutputs};
use toron::Hyperelastic;
use toron::law::block::Arrays;
use toron::law::parameters::{self, EPS_LIM, HYPERELASTIC_PROPERTIES};
use toron::law::state::HYPERELASTIC_STATE;
use toron_shared::error::Error;
use toron_shared::text_table::plain_table;

/// A ratio is the median over so many pairs of timings; of calls of a millisecond, over fewer.
const PAIRS: usize = 301;
const PAIRS_OF_LONG: usize = 51;
/// A timing repeats the call so often that it lasts about this long.
const BATCH: Duration = Duration::from_micros(50);
/// The points of one pass where they are called one by one.
const POINTS: usize = 256;
/// A block where the outputs are compared.
const BLOCK: usize = 1024;
/// The longitudinal shear stiffness of the law that has one, and its place among the properties.
const SHEARED: f64 = 20.0;
const K_LD: usize = parameters::place(&parameters::HYPERELASTIC, "k_ld");

/// A line of the report.
#[derive(Serialize)]
pub struct Choice {
    name: String,
    /// Points of a call above and below; those of all calls of a pass where a call has one.
    points: [usize; 2],
    /// How many times the second the first takes: the median over pairs of timings.
    ratio: f64,
    /// The least times: a point, or, where the numbers of points differ, a call.
    nanoseconds: [f64; 2],
}

/// What is timed, with arrays of its own.
pub type Run = Box<dyn FnMut() -> Result<(), Infallible>>;

/// All properties of the law that is measured.
///
/// # Errors
/// The law has another number of them.
pub fn all_properties<T>(values: Vec<T>) -> Result<[T; HYPERELASTIC_PROPERTIES], Error> {
    values.try_into().map_err(|_| Error::Evaluation("the preset has other properties".to_string()))
}

/// Every ratio, in double precision.
///
/// # Errors
/// The law cannot be prepared.
pub fn measured() -> Result<Vec<Choice>, Error> {
    let mut choices = Vec::new();
    let mut add = |name: &str, n: [usize; 2], runs: [Result<Run, Error>; 2]| {
        let [above, below] = runs;
        choices.push(ratio(name, n, above?, below?));
        Ok(())
    };
    let point = Host::Point(PointOutputs::State);
    for (above, below) in [
        (Host::Point(PointOutputs::Stress), point),
        (Host::Point(PointOutputs::Tangent), point),
        (Host::PointWithProperties, point),
        (Host::Umat { tangent: false }, point),
        (Host::Umat { tangent: true }, Host::Umat { tangent: false }),
        (Host::Lsdyna, point),
        (Host::Mgis { tangent: false }, Host::Umat { tangent: false }),
        (Host::Mgis { tangent: true }, Host::Mgis { tangent: false }),
    ] {
        let name = format!("{} / {}", above.name(), below.name());
        add(&name, [POINTS; 2], [above, below].map(|host| of_host(host, POINTS)))?;
    }

    let state = Outputs { energies: true, invariants: true, failure: true, ..Outputs::default() };
    for (name, outputs) in [
        ("stress only", Outputs::default()),
        ("energies alone", Outputs { energies: true, ..Outputs::default() }),
        ("with wave speed", Outputs { wave_speed: true, ..state }),
        ("with modes", Outputs { modes: true, ..state }),
    ] {
        let name = format!("block, {name} / with whole state");
        add(&name, [BLOCK; 2], [outputs, state].map(|outputs| of_outputs(outputs, BLOCK)))?;
    }
    let plain = Calls::default();
    let (sheared, waves) = (Calls { sheared: true, ..plain }, Calls { wave_speed: true, ..plain });
    for (name, calls) in [("block", plain), ("block with k_ld", sheared), ("block with wave speed", waves)] {
        let name = format!("{name}, limits of points / none");
        let limited = Calls { limits: true, ..calls };
        add(&name, [BLOCK; 2], [limited, calls].map(|calls| of_block(calls, BLOCK)))?;
    }
    let apart = Calls { old_state_apart: true, ..plain };
    for (name, fibres) in [
        ("held, never slid", Fibres { have_slid: false, slide: false }),
        ("held, have slid", Fibres { have_slid: true, slide: false }),
        ("sliding, never slid", Fibres { have_slid: false, slide: true }),
        ("sliding, have slid", Fibres { have_slid: true, slide: true }),
    ] {
        let name = format!("block, fibres {name} / no friction");
        for n in [1, 64, BLOCK] {
            add(&name, [n; 2], [of_friction(fibres, n), of_block(apart, n)])?;
        }
    }
    for n in [4096, 100_000] {
        add("block, old state apart / in place", [n; 2], [apart, plain].map(|calls| of_block(calls, n)))?;
    }
    // A multiple of a page: all columns fall into the same set of the cache.
    let page = Calls { leading_dimension: Some(4096), ..plain };
    let line_more = Calls { leading_dimension: Some(4104), ..plain };
    let name = "block, leading dimension 4096 / 4104";
    add(name, [4096; 2], [page, line_more].map(|calls| of_block(calls, 4096)))?;
    for n in [1, 16, 64] {
        let by_properties = Calls { by_properties: true, ..plain };
        add("block, with properties / prepared", [n; 2], [by_properties, plain].map(|calls| of_block(calls, n)))?;
    }

    for n in [1, 2, 3, 4, 8] {
        add("block / C points", [n; 2], [of_block(plain, n), of_host(point, n)])?;
    }
    let tangent = Calls { tangent: true, ..plain };
    let runs = [of_block(tangent, 1), of_host(Host::Point(PointOutputs::Tangent), 1)];
    add("block with dS/dE / C point with dS/dE", [1; 2], runs)?;
    for (n, full) in [(1, 4), (2, 4), (3, 4), (5, 8), (9, 16), (63, 64), (127, 128)] {
        add(&format!("block of {n} / of {full}"), [n, full], [n, full].map(|n| of_block(plain, n)))?;
    }
    Ok(choices)
}

/// The ratio of two runs that are timed in turn.
fn ratio(name: &str, points: [usize; 2], mut above: Run, mut below: Run) -> Choice {
    let Ok(calls) = calls_that_last(BATCH, &mut above).and_then(|a| Ok([a, calls_that_last(BATCH, &mut below)?]));
    let pairs = if calls[0] > 1 { PAIRS } else { PAIRS_OF_LONG };
    let mut runs = [above, below];
    let run = |side: usize| {
        let Ok(()) = runs[side]();
    };
    let times = in_turn(run, calls, pairs);
    let mut ratios: Vec<f64> = times.iter().map(|[above, below]| above / below).collect();
    ratios.sort_by(f64::total_cmp);
    let least = |side: usize| times.iter().map(|pair| pair[side]).fold(f64::INFINITY, f64::min);
    let divided_by = if points[0] == points[1] { points[0] as f64 } else { 1.0 };
    Choice {
        name: name.to_string(),
        points,
        ratio: ratios[pairs / 2],
        nanoseconds: [0, 1].map(|side| 1e9 * least(side) / divided_by),
    }
}

fn of_host(host: Host, n: usize) -> Result<Run, Error> {
    let mut scene = Scene::<f64>::impact(n);
    let mut arrays = HostArrays::new(&all_properties(properties().to_vec())?, &scene).map_err(Error::Evaluation)?;
    Ok(Box::new(move || {
        call(host, &mut scene, &mut arrays);
        Ok(())
    }))
}

/// What is asked of a block beside stress and status.
#[derive(Clone, Copy, Default)]
struct Outputs {
    energies: bool,
    invariants: bool,
    failure: bool,
    modes: bool,
    wave_speed: bool,
}

/// A block of the law's own interface with some of its outputs.
fn of_outputs(outputs: Outputs, n: usize) -> Result<Run, Error> {
    let law_error = |error: toron::Error| Error::Evaluation(error.to_string());
    let law = Hyperelastic::new(properties()).map_err(law_error)?;
    let mut scene = Scene::<f64>::impact(n);
    let array = |components: usize| Aligned::new(0.0, components * scene.leading_dimension);
    let (mut modes, mut wave_speed) = (array(24), array(1));
    let mut run = move || {
        let Scene { n, leading_dimension, .. } = scene;
        let arrays = Arrays {
            n,
            leading_dimension,
            deformation_gradient: &scene.deformation_gradient,
            density: 1.0,
            stress: Some(&mut scene.stress),
            energies: outputs.energies.then_some(&mut scene.energies),
            invariants: outputs.invariants.then_some(&mut scene.invariants),
            failure: outputs.failure.then_some(&mut scene.failure),
            modes: outputs.modes.then_some(&mut modes),
            wave_speed: outputs.wave_speed.then_some(&mut wave_speed),
            status: Some(&mut scene.status),
            ..Arrays::default()
        };
        law.block(arrays).map(drop)
    };
    run().map_err(law_error)?;
    // The same call does not fail later.
    Ok(Box::new(move || {
        let _ = run();
        Ok(())
    }))
}

/// How the C entry for blocks is called.
#[derive(Clone, Copy, Default)]
struct Calls {
    /// Another one than the scene's.
    leading_dimension: Option<usize>,
    old_state_apart: bool,
    by_properties: bool,
    tangent: bool,
    wave_speed: bool,
    /// A failure limit of its own for each point: that of the properties, so that the same points fail.
    limits: bool,
    /// A law with a longitudinal shear.
    sheared: bool,
}

fn of_block(calls: Calls, n: usize) -> Result<Run, Error> {
    let mut properties = all_properties(properties().to_vec())?;
    if calls.sheared {
        properties[K_LD] = SHEARED;
    }
    let law = prepared(&properties).map_err(Error::Evaluation)?;
    let scene = match calls.leading_dimension {
        Some(leading_dimension) => Scene::with_leading_dimension(n, leading_dimension, impacts()),
        None => Scene::<f64>::impact(n),
    };
    let array = |wanted: bool, components: usize| {
        Aligned::new(0.0, if wanted { components * scene.leading_dimension } else { 0 })
    };
    let (old, tangent) = (array(calls.old_state_apart, HYPERELASTIC_STATE), array(calls.tangent, 36));
    let limit = &*Box::leak(Box::new(Aligned::new(properties[EPS_LIM].ln_1p(), n)));
    let wave_speed = Box::leak(Box::new(array(true, 1)));
    // A caller sets up the structure once, for arrays that stay to the program's end.
    let (state, old, tangent) =
        (Box::leak(Box::new(array(true, HYPERELASTIC_STATE))), Box::leak(Box::new(old)), Box::leak(Box::new(tangent)));
    let block = SolverBlock {
        state_old: calls.old_state_apart.then_some(&**old),
        tangent: calls.tangent.then_some(&mut **tangent),
        limit: calls.limits.then_some(&**limit),
        wave_speed: calls.wave_speed.then_some((1.0, &mut **wave_speed)),
        ..whole(Box::leak(Box::new(scene)), state)
    };
    let mut block = block.arrays();
    Ok(Box::new(move || {
        block.call(if calls.by_properties { Given::Properties(&properties) } else { Given::Prepared(&law) });
        Ok(())
    }))
}

/// The ratios as a table.
pub fn table(choices: &[Choice]) -> String {
    let cells = |Choice { name, points: [above, below], ratio, nanoseconds: [first, second] }: &Choice| {
        let points = if above == below { above.to_string() } else { format!("{above}, {below}") };
        vec![name.to_string(), points, format!("{ratio:.2}"), format!("{first:.2}"), format!("{second:.2}")]
    };
    let rows: Vec<Vec<String>> = choices.iter().map(cells).collect();
    let head = ["", "points", "ratio", "ns above", "ns below"];
    let line =
        |cells: &[&str]| format!("{:<52}{:>10}{:>8}{:>12}{:>12}\n", cells[0], cells[1], cells[2], cells[3], cells[4]);
    let of_row = |row: &Vec<String>| line(&row.iter().map(String::as_str).collect::<Vec<_>>());
    let table = plain_table(&head, &rows, || line(&head) + &rows.iter().map(of_row).collect::<String>());
    format!(
        "choices: ratios of calls in turn; nanoseconds a point, or a call where the numbers of points differ\n\n{table}"
    )
}
