//! From CalculiX's tables to the energies of each increment.

use super::deck::{FIBRES, MIDDLE, SPRING, SPRUNG, STRESS_UNIT, Task, front, support_name};
use super::printed::Table;

/// An increment, its energies over reference areas and in the scene's unit of stress.
#[derive(Clone, Debug, PartialEq)]
pub struct Increment {
    pub stretch: f64,
    pub invariants: [f64; 2],
    /// Strain energy of the middle's fibres over the middle's area, voids included.
    pub energy: f64,
    /// The same for all fibres.
    pub whole: f64,
    /// Energy of the grounding springs over the whole area.
    pub springs: f64,
    /// Work that the supports have done so far, over the whole area.
    pub work: f64,
    /// What friction has dissipated of it; CalculiX does not tell.
    pub friction: f64,
}

/// The increments that were reached, and what is missing where one is not whole: those before it stand.
pub fn increments(task: &Task, tables: &[Table]) -> (Vec<Increment>, Option<String>) {
    let mut increments = Vec::new();
    let mut before = Reached { stretch: 1.0, forces: vec![0.0; task.model.supports.len()], work: 0.0 };
    for tables in by_time(tables) {
        match increment(task, tables, &mut before) {
            Ok(increment) => increments.push(increment),
            Err(missing) => return (increments, Some(missing)),
        }
    }
    (increments, None)
}

/// Where the supports are, with their forces along their axes, and the work that they have done.
struct Reached {
    stretch: f64,
    forces: Vec<f64>,
    work: f64,
}

/// The increment of these tables; moves `before` to its end.
fn increment(task: &Task, tables: &[Table], before: &mut Reached) -> Result<Increment, String> {
    let Task { model, load, .. } = *task;
    let unit = STRESS_UNIT * task.fibre.e_2;
    let time = tables[0].time;
    let stretch = 1.0 + time * (task.last_stretch - 1.0);
    let energy = |set: &str| Ok::<f64, String>(table(tables, "total internal energy", set)?.rows[0][0]);
    let [from, to] = [before.stretch, stretch].map(|stretch| load.stretches(stretch));
    let (mut forces, mut work) = (Vec::new(), before.work);
    for (i, support) in model.supports.iter().enumerate() {
        let total = table(tables, "total force", &support_name(i))?;
        let force = *total.rows[0].get(support.axis).ok_or_else(|| missing("a force", time))?;
        work += 0.5 * (before.forces[i] + force) * (to[support.axis] - from[support.axis]) * support.at;
        forces.push(force);
    }
    *before = Reached { stretch, forces, work };
    Ok(Increment {
        stretch,
        invariants: load.invariants(stretch),
        energy: unit * energy(MIDDLE)? / model.middle_area,
        whole: unit * energy(FIBRES)? / model.area,
        springs: task.fibre.e_2 * springs(task, tables, stretch)? / model.area,
        work: unit * work / model.area,
        friction: 0.0,
    })
}

/// The tables of each time; CalculiX prints a last increment that it has cut to nothing a second time.
fn by_time(tables: &[Table]) -> impl Iterator<Item = &[Table]> {
    let mut last = 0.0;
    tables.chunk_by(|a, b| a.time == b.time).filter(move |chunk| {
        let later = chunk[0].time > last;
        last = chunk[0].time;
        later
    })
}

fn table<'a>(tables: &'a [Table], title: &str, set: &str) -> Result<&'a Table, String> {
    let of_set = |table: &&Table| table.title.starts_with(title) && table.title.ends_with(&format!(" set {set}"));
    let found = tables.iter().find(of_set).filter(|table| table.rows.first().is_some_and(|row| !row.is_empty()));
    found.ok_or_else(|| missing(&format!("{title} of {set}"), tables[0].time))
}

fn missing(what: &str, time: f64) -> String {
    format!("CalculiX has not printed {what} at {:.1} % of the load", 100.0 * time)
}

/// ½ k u² of the way from where an affine deformation takes a node, over e_2.
fn springs(task: &Task, tables: &[Table], stretch: f64) -> Result<f64, String> {
    let model = task.model;
    if model.sprung.is_empty() {
        return Ok(0.0);
    }
    let moved = table(tables, "displacements", SPRUNG)?;
    let stretches = task.load.stretches(stretch);
    let mut energy = 0.0;
    for &node in &model.sprung {
        let row = moved.rows.iter().find(|row| row.first() == Some(&(front(node) as f64)));
        let row = row.filter(|row| row.len() > 2).ok_or_else(|| missing("a displacement", moved.time))?;
        for axis in 0..2 {
            let away = row[1 + axis] - (stretches[axis] - 1.0) * model.nodes[node][axis];
            energy += 0.5 * SPRING * away * away;
        }
    }
    Ok(energy)
}
