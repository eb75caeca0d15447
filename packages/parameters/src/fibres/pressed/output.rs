//! The files of figures of pressed sections: a table of energies a case, and the file that the identification reads.

use std::fmt::Write;
use std::path::Path;

use super::outcome::{Part, Pressed, Sample};
use crate::fibres::report::column;
use crate::fibres::scene::{Case, Packing, Scene, Striker, Walls};
use crate::identify::written::{DEVIATION, Fibre, RANDOM_DEVIATION, Set, Written};
use toron::law::parameters::STRESS;
use toron_materials::units::{TIME, unit};
use toron_shared::error::Error;
use toron_shared::numbers::number;
use toron_shared::run_directory::file_error;
use toron_shared::text_table::{Column, or_dash};

pub type Results<'a> = [(&'a Case, Pressed)];

/// Of the preset that is fitted.
const YARN: &str = "fibres";
const COMPACTION: &str = "compaction";

/// Writes the history of a case.
///
/// # Errors
/// The file cannot be written.
pub fn write_history(file: &Path, scene: &Scene, result: &Pressed) -> Result<(), Error> {
    let [time, stress] = [TIME, STRESS].map(|dimension| unit(&scene.units, dimension));
    let mut text = format!("time ({time}),stretch (-)");
    for of in ["", " of the section"] {
        let _ = write!(text, ",I_tc{of} (-),I_td{of} (-),energy{of} ({stress})");
    }
    for name in [
        "energy in the walls",
        "work of the walls",
        "energy lost by friction",
        "energy lost by damping",
        "kinetic energy",
    ] {
        let _ = write!(text, ",{name} ({stress})");
    }
    text.push('\n');
    for sample in &result.samples {
        let _ = write!(text, "{:.9e},{:.9}", sample.time, sample.stretch);
        for Part { invariants: [i_tc, i_td], energy } in [sample.middle, sample.whole] {
            let _ = write!(text, ",{i_tc:.8},{i_td:.8},{energy:.7e}");
        }
        for energy in [sample.walls, sample.work, sample.friction, sample.damping, sample.kinetic] {
            let _ = write!(text, ",{energy:.7e}");
        }
        text.push('\n');
    }
    std::fs::write(file, text).map_err(|error| file_error(file, &error))
}

/// The file that `toron fit` reads: the sections that are pressed on all sides or between sides that are held, as the
/// walls say.
pub fn fit_file(scene: &Scene, results: &Results) -> Option<String> {
    let loading = |case: &Case| match case.striker {
        Striker::Walls { walls: Walls::AllSides, .. } => Some(COMPACTION),
        Striker::Walls { walls: Walls::TopAndBottom | Walls::Sides, .. } => Some("compression"),
        _ => None,
    };
    let set = |case: &'_ Case, result: &Pressed| {
        let largest = result.samples.iter().fold(0.0, |most: f64, sample| most.max(sample.whole.energy));
        let deviation = if case.packing == Packing::Hexagonal { DEVIATION } else { RANDOM_DEVIATION };
        Some(Set {
            name: case.name.clone(),
            loading: loading(case)?,
            // The middle's own invariants come back where fibres snap.
            columns: Some(["stretch", "energy of the section"]),
            range: snap(&result.samples, deviation * largest).map(|stretch| [stretch, 1.0]),
            largest,
            deviation,
        })
    };
    let (case, result) = results.iter().find(|(case, _)| loading(case) == Some(COMPACTION))?;
    let volume_fraction = result.model.section.fraction();
    let modulus = case.fibre.modulus;
    let written = Written {
        title: &scene.title,
        units: &scene.units,
        name: YARN,
        source: &format!("{}: fibres in LAMMPS", scene.title),
        density: Some(case.fibre.density * volume_fraction),
        fibre: case.fibre.strain_at_failure.map(|strain_at_failure| Fibre {
            modulus,
            volume_fraction,
            strain_at_failure,
        }),
        sets: results.iter().filter_map(|(case, result)| set(case, result)).collect(),
    };
    Some(written.text())
}

/// The stretch from which on the section's energy has fallen by more than this: fibres have snapped to other places,
/// where it is no longer that of an elastic section.
fn snap(samples: &[Sample], least: f64) -> Option<f64> {
    let mut highest = *samples.first()?;
    for sample in samples {
        if sample.whole.energy < highest.whole.energy - least {
            return Some(highest.stretch);
        }
        if sample.whole.energy > highest.whole.energy {
            highest = *sample;
        }
    }
    None
}

/// The columns of the terminal's table, the most important first.
pub fn columns(scene: &Scene, results: &Results) -> Vec<Column> {
    let results: Vec<_> = results.iter().collect();
    let stress = unit(&scene.units, STRESS);
    let share = |part: f64, whole: f64| number(100.0 * part / whole);
    vec![
        column(&results, ["case", ""], |case, _| case.name.clone()),
        column(&results, ["middle:", "I_tc"], |_, result| format!("{:.4}", result.last().middle.invariants[0])),
        column(&results, ["", "I_td"], |_, result| format!("{:.4}", result.last().middle.invariants[1])),
        column(&results, ["energy,", &stress], |_, result| number(result.last().middle.energy)),
        column(&results, ["section:", "I_tc"], |_, result| format!("{:.4}", result.last().whole.invariants[0])),
        column(&results, ["", "I_td"], |_, result| format!("{:.4}", result.last().whole.invariants[1])),
        column(&results, ["energy,", &stress], |_, result| number(result.last().whole.energy)),
        column(&results, ["work,", &stress], |_, result| number(result.last().work)),
        column(&results, ["friction,", "%"], |_, result| share(result.last().friction, result.last().work)),
        column(&results, ["damping,", "%"], |_, result| share(result.last().damping, result.last().work)),
        column(&results, ["kinetic,", "% at most"], |_, result| number(100.0 * result.restlessness())),
        column(&results, ["run", "s"], |_, result| or_dash(result.seconds, |seconds| format!("{seconds:.1}"))),
    ]
}
