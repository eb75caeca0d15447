//! The files of figures of pressed sections: a table of energies a case, and the file that the identification reads.

use std::fmt::Write;
use std::path::Path;

use super::friction::{Friction, critical_range};
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
    let _ = writeln!(text, ",I_tc of the walls (-),I_td of the walls (-),p_t ({stress}),q ({stress})");
    for sample in &result.samples {
        let _ = write!(text, "{:.9e},{:.9}", sample.time, sample.stretch);
        for Part { invariants: [i_tc, i_td], energy } in [sample.middle, sample.whole] {
            let _ = write!(text, ",{i_tc:.8},{i_td:.8},{energy:.7e}");
        }
        for energy in [sample.walls, sample.work, sample.friction, sample.damping, sample.kinetic] {
            let _ = write!(text, ",{energy:.7e}");
        }
        let [i_tc, i_td] = sample.strain;
        let _ = writeln!(text, ",{i_tc:.9},{i_td:.9},{:.7e},{:.7e}", sample.p_t, sample.q);
    }
    std::fs::write(file, text).map_err(|error| file_error(file, &error))
}

/// The file that `toron fit` reads: the sections that are pressed on all sides or between sides that are held, as the
/// walls say, and those that slide between sides that keep a pressure or, beside those, without sides.
pub fn fit_file(scene: &Scene, results: &Results) -> Option<String> {
    let closes = |case: &Case, walls: &[Walls]| match &case.striker {
        // What goes back and closes once more is no curve from rest on.
        Striker::Walls { walls: of_case, reload: false, .. } => walls.contains(of_case),
        _ => false,
    };
    let is_there = |walls: Walls| results.iter().any(|(case, _)| closes(case, &[walls]));
    let compacted = is_there(Walls::AllSides);
    // A yarn has one friction between its fibres, and they lie in one way: as in the first case that slides.
    let first = results.iter().map(|(case, _)| *case).find(|case| closes(case, &[Walls::Biaxial]));
    let is_alike = |case: &Case| {
        let alike = |first: &Case| {
            first.friction == case.friction
                && (first.packing == Packing::Hexagonal) == (case.packing == Packing::Hexagonal)
        };
        first.is_some_and(alike)
    };
    let set = |case: &Case, result: &Pressed| {
        if closes(case, &[Walls::Biaxial, Walls::Plates]) {
            return sliding_set(case, result).filter(|_| is_alike(case));
        }
        let once = closes(case, &[Walls::AllSides, Walls::TopAndBottom, Walls::Sides]);
        elastic_set(case, result).filter(|_| compacted && once)
    };
    let sets: Vec<Set> = results.iter().filter_map(|(case, result)| set(case, result)).collect();
    let kind = if compacted { Walls::AllSides } else { Walls::Biaxial };
    let (case, result) = results.iter().find(|(case, _)| closes(case, &[kind]))?;
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
        sets,
    };
    Some(written.text())
}

/// The energies of a section that is elastic.
fn elastic_set(case: &Case, result: &Pressed) -> Option<Set> {
    let loading = match case.striker {
        Striker::Walls { walls: Walls::AllSides, .. } => COMPACTION,
        Striker::Walls { walls: Walls::TopAndBottom | Walls::Sides, .. } => "compression",
        _ => return None,
    };
    let largest = result.samples.iter().fold(0.0, |most: f64, sample| most.max(sample.whole.energy));
    let deviation = if case.packing == Packing::Hexagonal { DEVIATION } else { RANDOM_DEVIATION };
    let snapped = snap(&result.samples, deviation * largest).map(|stretch| [stretch, 1.0]);
    Some(Set {
        name: case.name.clone(),
        loading,
        // The middle's own invariants come back where fibres snap.
        abscissa: Some("stretch"),
        columns: vec![["energy", "energy of the section"]],
        range: snapped,
        deviation: Some([largest, deviation]),
    })
}

/// The stresses of a section that slides, over the last part of its way.
fn sliding_set(case: &Case, result: &Pressed) -> Option<Set> {
    let is_free = result.pressing.walls == Walls::Plates;
    let mut columns = vec![["I_td", "I_td of the walls"]];
    if !is_free {
        columns.insert(0, ["I_tc", "I_tc of the walls"]);
    }
    Some(Set {
        name: case.name.clone(),
        loading: if is_free { "plates" } else { "biaxial" },
        abscissa: None,
        columns,
        range: Some(critical_range(result)?),
        deviation: None,
    })
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
    // Between plates without sides q/p_t is 1, whatever holds the section.
    let friction = |result: &Pressed, of: fn(&Friction) -> f64| {
        let has_sides = result.pressing.walls != Walls::Plates;
        or_dash(Friction::of(result).filter(|_| has_sides).as_ref().map(of), |value| format!("{value:.3}"))
    };
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
        column(&results, ["q/p_t,", "largest"], |_, result| friction(result, |friction| friction.peak.mean.ratio())),
        column(&results, ["q/p_t at", "last"], |_, result| friction(result, |friction| friction.critical.mean.ratio())),
        column(&results, ["µ at", "last"], |_, result| friction(result, |friction| friction.critical.mean.mu())),
        column(&results, ["kinetic,", "% at most"], |_, result| number(100.0 * result.restlessness())),
        column(&results, ["run", "s"], |_, result| or_dash(result.seconds, |seconds| format!("{seconds:.1}"))),
    ]
}
