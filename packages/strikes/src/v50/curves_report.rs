//! What is printed and written of shots with a known fate, whoever fired them: the curves, what they mean, and the
//! means of test houses.

use super::analysis::Analysis;
use super::curve::{Curve, Estimate, Interval, Mix};
use super::test_houses::Mean;
use toron_shared::numbers::number;
use toron_shared::text_table::{Column, NONE, folded, or_dash, table};

/// Columns of a terminal.
pub const WIDTH: usize = 129;
pub const UNBOUNDED: &str = "unbounded";
/// What is printed for a speed that the curve has there.
const BELOW_ZERO: &str = "below 0";

/// A value or an end of an interval, as it is printed.
pub fn figure(value: f64) -> String {
    if value < 0.0 { BELOW_ZERO.to_string() } else { number(value) }
}

pub fn interval(Interval { low, high }: &Interval) -> String {
    let [low, high] = [low, high].map(|end| end.map_or(UNBOUNDED.to_string(), figure));
    if low == high { low } else { format!("{low} to {high}") }
}

/// `one`, `one and two`, `one, two and three`.
pub fn listed<T: AsRef<str>>(words: &[T]) -> String {
    let words: Vec<&str> = words.iter().map(T::as_ref).collect();
    match &words[..] {
        [before @ .., last] if !before.is_empty() => format!("{} and {last}", before.join(", ")),
        _ => words.concat(),
    }
}

/// A sentence or more, folded, as a paragraph of lines.
pub fn paragraph(text: &str) -> String {
    folded(text, WIDTH) + "\n"
}

/// A part of one in hundredths, without the noise of the product: `5`, `99.9`.
pub fn percent(part: f64) -> String {
    let text = format!("{:.6}", 100.0 * part);
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}

fn name(curve: &Curve) -> String {
    format!("{}{}", curve.link.name(), if curve.firth { ", Firth (penalised)" } else { "" })
}

/// The name of the speed of a chance: `V50`.
fn names(told: &Analysis) -> Vec<String> {
    told.asked.chances.iter().map(|&chance| format!("V{}", percent(chance))).collect()
}

/// The units of the slope and of the scale.
fn units(told: &Analysis, speed: &str) -> [String; 2] {
    if told.asked.logarithm { ["1/ln", "ln"].map(String::from) } else { [format!("1/({speed})"), speed.to_string()] }
}

/// How the steepness of a curve is printed; files have both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Steepness {
    Slope,
    Scale,
}

/// The table of the curves; `speed` is the unit of the speeds.
pub fn curves(told: &Analysis, speed: &str, by: Steepness) -> String {
    let column = |above: &str, below: &str, entry: &dyn Fn(&Curve) -> String| Column {
        heading: [above.to_string(), below.to_string()],
        entries: told.curves.iter().map(entry).collect(),
    };
    let value = |estimate: &Estimate| or_dash(estimate.value, figure);
    let level = format!("{} %", percent(told.asked.level));
    let [of_slope, of_scale] = units(told, speed);
    let mut columns = vec![column("curve", "", &name)];
    for (place, of) in names(told).into_iter().enumerate() {
        columns.push(column(&of, speed, &|curve| value(&curve.speeds[place])));
        columns.push(column(&format!("{of}, {level}"), speed, &|curve| interval(&curve.speeds[place].interval)));
    }
    let steepness = |curve: &Curve| if by == Steepness::Slope { curve.slope } else { curve.scale() };
    let (name, of, unit) =
        if by == Steepness::Slope { ("slope at V50", "slope", of_slope) } else { ("scale", "scale", of_scale) };
    columns.push(column(name, &unit, &|curve| value(&steepness(curve))));
    columns.push(column(&format!("{of}, {level}"), &unit, &|curve| interval(&steepness(curve).interval)));
    table(columns, WIDTH)
}

/// What there is to say of the curves.
pub fn said(told: &Analysis, speed: &str) -> String {
    let is_unbounded = |place: usize| told.curves.iter().any(|curve| !curve.speeds[place].interval.is_bounded());
    let names = names(told);
    let unbounded: Vec<&String> = (0..names.len()).filter(|&place| is_unbounded(place)).map(|at| &names[at]).collect();
    let of_ends = (!unbounded.is_empty()).then(|| {
        format!(
            "Intervals of {} are unbounded: the shots do not refuse curves so level that these speeds lie as far away as one likes. More \
             shots, or a wider range of speeds, would help.",
            listed(&unbounded)
        )
    });
    [of_mix(told, speed), of_penalty(told), of_ends].into_iter().flatten().map(|text| paragraph(&text)).collect()
}

fn of_mix(told: &Analysis, speed: &str) -> Option<String> {
    if told.curves.is_empty() {
        return None;
    }
    match told.mix {
        Mix::Separated([stop, through]) if stop == through => Some(format!(
            "The fastest stop and the slowest perforation have one speed, {} {speed}, and no other results mix. The likeliest curve is a \
             step there, whose slope is unbounded; the intervals are what the shots do not refuse. More shots near this speed would help.",
            number(stop)
        )),
        Mix::Separated([stop, through]) => Some(format!(
            "No zone of mixed results: the fastest stop is at {} {speed}, the slowest perforation at {} {speed}. The curve may be a step \
             anywhere between, whose slope is unbounded, and the likelihood has no one largest place; the intervals are what the shots \
             do not refuse. More shots between these two speeds would help.",
            number(stop),
            number(through)
        )),
        _ if told.curves.iter().any(|curve| curve.mix == Mix::Level) => Some(
            "No curve that rises with the speed suits the shots better than a level one: a wider range of speeds, or more \
             shots, would help."
                .to_string(),
        ),
        Mix::Mixed => Some(zone(told, speed)),
        Mix::Level | Mix::AllThrough | Mix::AllStopped => None,
    }
}

/// The zone of mixed results.
fn zone(told: &Analysis, speed: &str) -> String {
    let speeds = |through: bool| told.fates.iter().filter(move |fate| fate.through == through).map(|fate| fate.speed);
    let (low, high) = (speeds(true).fold(f64::INFINITY, f64::min), speeds(false).fold(f64::NEG_INFINITY, f64::max));
    let within = told.fates.iter().filter(|fate| (low..=high).contains(&fate.speed)).count();
    format!(
        "Zone of mixed results: from the slowest perforation at {} {speed} to the fastest stop at {} {speed}, {} {speed} wide, with {within} of \
         {} shots.",
        number(low),
        number(high),
        number(high - low),
        told.fates.len()
    )
}

/// Firth's curves of shots that are separated follow from the penalty.
fn of_penalty(told: &Analysis) -> Option<String> {
    let separated = matches!(told.mix, Mix::Separated(_)) && told.curves.iter().any(|curve| curve.firth);
    separated.then(|| {
        "Firth's curves have values here by their penalty, not by the shots: their intervals can be narrower than the gap. \
         Those without it are the shots' own."
            .to_string()
    })
}

fn mean(mean: &Mean, speed: &str) -> String {
    let Mean { each, speed: value, spread } = mean;
    format!("{each} and {each}: {} {speed}, spread {}", number(*value), number(*spread))
}

/// What test houses print.
pub fn means(told: &Analysis, speed: &str) -> String {
    let mut texts: Vec<String> = told.means.iter().map(|found| mean(found, speed)).collect();
    if let Some((spread, found)) = &told.within {
        let found = found.as_ref().map_or("none".to_string(), |found| mean(found, speed));
        texts.push(format!("the most within a spread of {} {speed}: {found}", number(*spread)));
    }
    if texts.is_empty() {
        return String::new();
    }
    paragraph(&format!("Mean of the fastest stops and the slowest perforations, {}.", texts.join("; ")))
}

/// The lines of a table of figures: each curve and each mean, behind the cells that they share.
pub fn figures(told: &Analysis, speed: &str, shared: &[(String, String)]) -> Vec<Vec<(String, String)>> {
    let exact = |value: Option<f64>, none: &str| value.map_or(none.to_string(), |value| value.to_string());
    let first = |name: String| [vec![("curve".to_string(), name)], shared.to_vec()].concat();
    let [of_slope, of_scale] = units(told, speed);
    let of_curve = |curve: &Curve| {
        let mut line = first(name(curve));
        let mix = match curve.mix {
            Mix::Separated(_) => "separated",
            Mix::Level => "level",
            _ => "mixed",
        };
        line.push(("results".to_string(), mix.to_string()));
        let speeds = names(told).into_iter().zip(&curve.speeds).map(|(name, &estimate)| (name, speed, estimate));
        let others = [("slope", &of_slope, curve.slope), ("scale", &of_scale, curve.scale())];
        let others = others.map(|(name, unit, estimate)| (name.to_string(), unit.as_str(), estimate));
        for (quantity, unit, estimate) in speeds.chain(others) {
            line.push((format!("{quantity} ({unit})"), exact(estimate.value, NONE)));
            line.push((format!("{quantity}_low ({unit})"), exact(estimate.interval.low, UNBOUNDED)));
            line.push((format!("{quantity}_high ({unit})"), exact(estimate.interval.high, UNBOUNDED)));
        }
        line.push(("log_likelihood".to_string(), curve.log_likelihood().to_string()));
        line
    };
    let of_mean = |mean: &Mean, within: &str| {
        let mut line = first(format!("mean of {} and {}{within}", mean.each, mean.each));
        line.push((format!("V50 ({speed})"), mean.speed.to_string()));
        line.push((format!("spread ({speed})"), mean.spread.to_string()));
        line
    };
    let means = told.means.iter().map(|mean| of_mean(mean, ""));
    let within = told.within.as_ref().and_then(|(spread, mean)| Some((spread, mean.as_ref()?)));
    let within = within.map(|(spread, mean)| of_mean(mean, &format!(" within {spread}")));
    told.curves.iter().map(of_curve).chain(means).chain(within).collect()
}
