//! The summary of a run on the terminal.

use super::newton::{COMPONENT_NAMES, COMPONENTS};
use super::path::{LoadPath, Target};
use super::run::{End, History, Increment};
use crate::material::fibre_wave::FibreWave;
use crate::material::model::{Law, Material};
use crate::units::{ENERGY, unit};
use toron::law::parameters::{ENERGY_DENSITY, STRESS};
use toron::law::state::{ENERGIES, INVARIANTS};
use toron_shared::numbers::number;
use toron_shared::text_table::value_line;

/// The names of the four deformation modes.
pub const MODE_NAMES: [&str; 4] = ["elongation", "compaction", "distortion", "shear"];

/// A section of so many times its area has grown.
const GROWN: f64 = 1.01;

/// The width of the names of values.
pub const NAMES: usize = 22;

/// An energy below this fraction of the largest one is none.
const ROUNDING: f64 = 1e-12;

/// The summary of a point: largest fibre stress, energies, failure and its reason, work.
pub fn summary(path: &LoadPath, history: &History) -> String {
    let mut text = String::new();
    let material = &history.point.material;
    let mut line = |name: &str, value: String| {
        text += &value_line(name, NAMES, &value);
    };
    line("law", law(material));
    let wave = FibreWave::of(material, &path.units);
    if let Some(wave) = wave {
        line("wave along the fibre", format!("{} km/s = {}", number(wave.speed), wave.formula));
    }
    let stressed = history.increments.iter().filter(|_| material.has_fibre());
    if let Some(largest) = stressed.max_by(|a, b| a.fibre_stress.total_cmp(&b.fibre_stress)) {
        let value = format!("{} {}", number(largest.fibre_stress), unit(&path.units, STRESS));
        line("largest fibre stress", format!("{value}, {}", place(path, largest)));
    }
    for (name, value) in energies(path, history) {
        line(&name, value);
    }
    for (name, value) in failure(path, history) {
        line(name, value);
    }
    if let Some(text) = grown_section(path, history) {
        line("section", text);
    }
    if let Some(last) = history.increments.last() {
        let unit = unit(&path.units, ENERGY);
        let mut work = format!("{} {unit}", number(last.work));
        if material.has_energy() {
            let stored = material.energy(&last.answer.memory) * path.element.volume();
            let kept = if history.failure.is_some() { "frozen at failure" } else { "stored" };
            work += &format!("; {kept} {} {unit}", number(stored));
            if let Some(lost) = material.lost_energy(&last.answer.memory) {
                work += &format!(", lost {} {unit}", number(lost * path.element.volume()));
            }
        }
        line("work on the element", work);
    }
    let iterations = history.increments.iter().map(|increment| increment.iterations);
    if let Some(most) = iterations.clone().max().filter(|&most| most > 0) {
        let all: usize = iterations.sum();
        line("Newton iterations", format!("{all} in all, at most {most} an increment"));
    }
    match &history.end {
        End::Completed => {}
        End::Stopped(place) => line(
            "stopped",
            format!("before {place}: the point has failed and carries no stress, but one is prescribed"),
        ),
        End::Failed(reason) => line("not completed", reason.clone()),
    }
    if let Some(unit_warning) = wave.and_then(|wave| wave.unit_warning(&path.units)) {
        for (name, part) in ["warning", ""].into_iter().zip(unit_warning.lines()) {
            line(name, part.to_string());
        }
    }
    text
}

/// What is to be said of a section that has grown where its sides are free: Newton's method has found one of many
/// equilibria.
fn grown_section(path: &LoadPath, history: &History) -> Option<String> {
    let (material, last) = (&history.point.material, history.increments.last()?);
    let area = last.f.determinant() / (last.f * material.fibre()).norm();
    let is_free = |place: usize| {
        let mut targets = path.steps[..=last.step].iter().map(|step| step.targets[place]);
        targets.any(|target| matches!(target, Some(Target::Stress(_))))
    };
    let on_sides = (0..COMPONENTS.len()).filter(|&place| COMPONENTS[place].0 == COMPONENTS[place].1);
    let free: Vec<usize> = on_sides.filter(|&place| is_free(place)).collect();
    if !matches!(material.law, Law::Hyperelastic { .. }) || free.is_empty() || area < GROWN {
        return None;
    }
    let side = |&place: &usize| format!("F{} = {}", COMPONENT_NAMES[place], number(last.f[COMPONENTS[place]]));
    Some(format!(
        "has {} times its area at the end, {}: the law does not resist a section that grows, and any such sides are in \
         equilibrium; hold one, as with F = {{ {} = 1 }}, where that is not meant",
        number(area),
        free.iter().map(side).collect::<Vec<_>>().join(", "),
        COMPONENT_NAMES[free[free.len() - 1]]
    ))
}

/// The law, and the preset where there is one.
fn law(material: &Material) -> String {
    let (name, label) = (material.law_name(), &material.label);
    if name.replace(' ', "-") == *label { name.to_string() } else { format!("{name} ({label})") }
}

/// The largest energies and those at the end, mode by mode where the law has modes.
fn energies(path: &LoadPath, history: &History) -> Vec<(String, String)> {
    let unit = unit(&path.units, ENERGY_DENSITY);
    let material = &history.point.material;
    let parts = |increment: &Increment| -> Vec<f64> {
        match &material.law {
            Law::Hyperelastic { .. } => increment.answer.memory.state[ENERGIES..INVARIANTS].to_vec(),
            Law::LinearElastic { .. } => vec![material.energy(&increment.answer.memory)],
            Law::Own(own) => increment.answer.memory.state[own.law.description.energies.clone()].to_vec(),
        }
    };
    let names: Vec<&str> = match &material.law {
        Law::Hyperelastic { .. } => MODE_NAMES.to_vec(),
        Law::LinearElastic { .. } => vec!["work per volume"],
        Law::Own(own) => {
            material.state_table()[own.law.description.energies.clone()].iter().map(|row| row.name).collect()
        }
    };
    if names.is_empty() {
        return Vec::new();
    }
    let Some(last) = history.increments.last().map(parts) else { return Vec::new() };
    let largest = history.increments.iter().map(parts).fold(vec![0.0; names.len()], |largest, parts| {
        largest.iter().zip(parts).map(|(a, b): (&f64, f64)| a.max(b)).collect()
    });
    let noise = ROUNDING * largest.iter().copied().fold(0.0, f64::max);
    let list = |values: &[f64]| {
        let item =
            |(name, &value): (&&str, &f64)| format!("{name} {}", number(if value > noise { value } else { 0.0 }));
        let items: Vec<String> = names.iter().zip(values).map(item).collect();
        format!("{} {unit}", items.join(", "))
    };
    vec![("largest energies".to_string(), list(&largest)), ("energies at the end".to_string(), list(&last))]
}

/// When the point failed and what of its index came from which mode.
fn failure(path: &LoadPath, history: &History) -> Vec<(&'static str, String)> {
    let material = &history.point.material;
    let index = |increment: &Increment| material.failure_index(&increment.answer.memory);
    let Some(first) = history.failure.map(|i| &history.increments[i]) else {
        let largest = history.increments.iter().filter_map(index).reduce(f64::max);
        let index = largest.map(|largest| format!("; largest failure index {}", number(largest.max(0.0))));
        return vec![("failure", format!("none{}", index.unwrap_or_default()))];
    };
    let reason = index(first).map(|index| ("failure index", format!("{}{}", number(index), parts(material, first))));
    [("failure", place(path, first))].into_iter().chain(reason).collect()
}

/// The terms whose sum is the hyperelastic law's failure index.
fn parts(material: &Material, increment: &Increment) -> String {
    let Some(terms) = material.failure_terms(&increment.answer.memory) else { return String::new() };
    let [elongation, compaction, distortion] = terms.map(number);
    format!(" = {elongation} elongation + {compaction} compaction + {distortion} distortion")
}

fn place(path: &LoadPath, increment: &Increment) -> String {
    if increment.number == 0 {
        return "at the start".to_string();
    }
    let step = &path.steps[increment.step];
    format!("{step}, increment {}, time {}", increment.number, number(increment.time))
}
