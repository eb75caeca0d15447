//! What the summary, the table of parameters and the preset say of µ and c.

use super::file::Job;
use super::friction::{C, MU, Told};
use super::report::{digits, line};
use super::sliding::{Mean, scatter};
use toron::law::parameters::{FRICTIONAL, STRESS};
use toron_materials::units::unit;

/// µ and c by their places among the properties, where data tell them.
pub fn told(job: &Job) -> [(usize, Option<Told>); 2] {
    [(MU, job.friction.mu), (C, job.friction.c)]
}

/// The interval in words.
pub fn interval(told: &Told) -> String {
    format!("95 %: {} to {}", digits(told.low), digits(told.high))
}

/// Where a value of the preset comes from.
pub fn note(job: &Job, index: usize) -> Option<String> {
    let (_, told) = told(job).into_iter().find(|(place, _)| *place == index)?;
    match told {
        Some(told) => Some(interval(&told)),
        None if index == C && !job.sliding.is_empty() => Some("not told: the data are of one pressure".to_string()),
        None => None,
    }
}

/// The cells of a table that programs read.
pub fn rows(job: &Job) -> Vec<Vec<String>> {
    let row = |(index, told): (usize, Option<Told>)| {
        let (told, property) = (told?, &FRICTIONAL[index]);
        let [value, low, high] = [told.value, told.low, told.high].map(|number| number.to_string());
        let said = said(job, index, &told);
        Some(vec![property.name.to_string(), value, unit(&job.units, property.dimension), low, high, said])
    };
    told(job).into_iter().filter_map(row).collect()
}

/// The lines of µ, c, c/(1 − µ).
pub fn lines(job: &Job) -> String {
    let mut text = String::new();
    for (index, told) in told(job) {
        if let Some(told) = told {
            text += &line(FRICTIONAL[index].name, &said(job, index, &told));
        }
    }
    if let Some(free) = &job.friction.free {
        let stress = unit(&job.units, STRESS);
        let names = names(job, true);
        text += &line("c/(1 − mu)", &format!("{} {stress}, {}, from {names}", digits(free.value), interval(free)));
    }
    text
}

/// What each test has shown, and what the tests do not tell.
pub fn sets(job: &Job) -> String {
    let stress = unit(&job.units, STRESS);
    let mut text = String::new();
    for set in &job.sliding {
        let [p_t, _] = scatter(&set.parts.iter().map(|part| part.p_t).collect::<Vec<_>>());
        let [mu, variance] = scatter(&set.parts.iter().map(Mean::mu).collect::<Vec<_>>());
        let range = [set.parts.first().map_or(0.0, |p| p.range[0]), set.parts.last().map_or(0.0, |p| p.range[1])];
        let sides = if set.is_free {
            "free sides".to_string()
        } else {
            format!("q/p_t less dilatancy {} ± {}", digits(mu), digits(variance.sqrt()))
        };
        let range = range.map(digits).join(" to ");
        text += &line(&set.name, &format!("I_td {range}: p_t {} {stress}, {sides}", digits(p_t)));
    }
    if !job.sliding.is_empty() && job.friction.c.is_none() && job.preset.values.get(C).copied().flatten().is_none() {
        text += &line(
            "note",
            "these data are of one pressure, and tell mu p_t + cohesion there: cohesion is taken as 0, or from the preset that the file names. What would tell it: a press with free sides \
             (loading = \"plates\"), or a biaxial test at another pressure",
        );
    }
    text
}

/// Which of µ and c neither data nor the file tell, where the base preset does: guesses.
pub fn guessed(job: &Job) -> Vec<&'static str> {
    let of_base = |index: usize| job.base.as_ref().is_some_and(|base| base.value(index, &job.units).is_some());
    let is_given = |index: usize| job.preset.values.get(index).copied().flatten().is_some();
    let guessed = told(job).into_iter().filter(|&(index, told)| told.is_none() && !is_given(index) && of_base(index));
    guessed.map(|(index, _)| FRICTIONAL[index].name).collect()
}

fn said(job: &Job, index: usize, told: &Told) -> String {
    let unit = if index == C { format!(" {}", unit(&job.units, STRESS)) } else { String::new() };
    let names = if index == MU { names(job, false) } else { names(job, true) };
    let names = if names.is_empty() { self::names(job, false) } else { names };
    format!("{}{unit}, {}, from {names}", digits(told.value), interval(told))
}

/// The first few sets of a kind.
fn names(job: &Job, free: bool) -> String {
    const MOST: usize = 4;
    let names: Vec<&str> = job.sliding.iter().filter(|set| set.is_free == free).map(|set| set.name.as_str()).collect();
    match names.get(..MOST) {
        Some(first) if names.len() > MOST => format!("{} and {} more", first.join(", "), names.len() - MOST),
        _ => names.join(", "),
    }
}
