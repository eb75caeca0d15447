//! The picture of shots with a known fate: the curves with what the shots do not refuse, and every shot.

use plotters::prelude::*;

use super::analysis::Analysis;
use super::curve::{Curve, Interval};
use super::curves_report::percent;
use super::link::Link;
use toron_pictures::legend::{self, BAND, Mark};
use toron_pictures::page::{Area, Drawn};
use toron_pictures::panel::{bounds, chart, tick};
use toron_pictures::style::{COLOURS, GREY, HEADING, INK, fine, stroke, text};

/// The height of a panel's title and legend.
const PANEL_HEAD: i32 = 62;
pub const MARGIN: i32 = 70;
pub const POINT: i32 = 5;
/// Air around the speeds, over their range.
pub const AIR: f64 = 0.06;
/// Around one speed, over that speed.
const AIR_OF_ONE: f64 = 0.01;
/// Chances from 0 to 1 over the height, and as much air above and below.
const CHANCES: std::ops::Range<f64> = -0.08..1.08;
/// The chances at which a band is found: every fiftieth, but for 0 and 1, and nearer to these.
const STEPS: usize = 50;
const EXTREMES: [f64; 2] = [0.002, 0.008];
/// How far the shots of a second table stand from those of the first.
const BESIDE: f64 = 0.035;
pub const SHOT: f64 = 0.75;
/// Points of a line.
const POINTS: usize = 300;
/// The colours of stops and perforations, and of the two curves.
pub const FATES: [RGBColor; 2] = [COLOURS[0], COLOURS[1]];
const CURVES: [RGBColor; 2] = [COLOURS[2], COLOURS[3]];

/// Shots that are drawn.
pub struct Shown<'a> {
    /// What they are called beside others.
    pub name: &'a str,
    pub told: &'a Analysis,
    /// The speeds of those without a fate, and what became of them.
    pub without_fate: (Vec<f64>, String),
}

/// The speeds of all shots, with some air.
pub fn speeds(shown: &[Shown]) -> (f64, f64) {
    let fates = |shown: &Shown| shown.told.fates.iter().map(|fate| fate.speed).collect::<Vec<_>>();
    let all: Vec<f64> = shown.iter().flat_map(|shown| [fates(shown), shown.without_fate.0.clone()].concat()).collect();
    let (low, high) = bounds(&all);
    let air = if high > low { AIR * (high - low) } else { AIR_OF_ONE * high.abs() };
    (low - air, high + air)
}

pub fn head<'a>(area: &Area<'a>, title: &str, legend: &[(Mark, String)]) -> Drawn<Area<'a>> {
    let (head, body) = area.split_vertically(fine(PANEL_HEAD));
    head.draw_text(title, &text(HEADING, &INK), (fine(MARGIN), fine(8)))?;
    legend::draw(&head, [MARGIN, 38], legend)?;
    Ok(body)
}

/// The curves that are drawn with their colours and names: both links of one table's shots, and one of each where there
/// are several tables.
fn curves<'a>(shown: &'a [Shown]) -> Vec<(&'a Curve, RGBColor, String)> {
    let level = |shown: &Shown| format!("{} %", percent(shown.told.asked.level));
    let kind = |curve: &Curve| format!("{}{}", curve.link.name(), if curve.firth { ", Firth" } else { "" });
    if let [only] = shown {
        let drawn = Link::BOTH.into_iter().filter_map(|link| only.told.drawn(link));
        return drawn.map(|curve| (curve, CURVES[curve.link as usize], kind(curve) + ", " + &level(only))).collect();
    }
    let drawn = |(place, shown): (usize, &'a Shown)| {
        let curve = shown.told.asked.links.last().and_then(|&link| shown.told.drawn(link))?;
        Some((curve, FATES[place], format!("{}: {}, {}", shown.name, kind(curve), level(shown))))
    };
    shown.iter().enumerate().filter_map(drawn).collect()
}

/// Draws the curves and shots of one table, or of two.
pub fn draw(area: &Area, speed: &str, shown: &[Shown]) -> Drawn<()> {
    let (low, high) = speeds(shown);
    let drawn = curves(shown);
    let mut legend = Vec::new();
    if let [_] = shown {
        legend.extend([(Mark::Point(FATES[0]), "stopped".to_string()), (Mark::Point(FATES[1]), "through".to_string())]);
    }
    let without = shown.iter().find(|shown| !shown.without_fate.0.is_empty());
    legend.extend(without.map(|shown| (Mark::Ring, shown.without_fate.1.clone())));
    for (curve, colour, name) in &drawn {
        // Shots that are separated have no line, but a band of what they do not refuse.
        let is_line = !points(curve, low, high).is_empty();
        legend.push((if is_line { Mark::Line(*colour) } else { Mark::Band(*colour) }, name.clone()));
    }
    let body = head(area, "Chance of a perforation", &legend)?;
    let x_label = |x: &f64| tick(*x, high - low);
    let y_label = |y: &f64| tick(*y, 1.0);
    let mut chart = chart(&body, low..high, CHANCES, &format!("striking speed ({speed})"), [&x_label, &y_label])?;
    for (curve, colour, _) in &drawn {
        chart.draw_series([Polygon::new(band(curve, low, high), colour.mix(BAND).filled())])?;
    }
    for (curve, colour, _) in &drawn {
        chart.draw_series(LineSeries::new(points(curve, low, high), stroke(*colour, 3)))?;
    }
    for (place, group) in shown.iter().enumerate() {
        let beside = BESIDE * place as f64;
        chart.draw_series(group.told.fates.iter().map(|fate| {
            let colour = FATES[if shown.len() == 1 { usize::from(fate.through) } else { place }];
            let height = if fate.through { 1.0 - beside } else { beside };
            Circle::new((fate.speed, height), fine(POINT), colour.mix(SHOT).filled())
        }))?;
        let rings = group.without_fate.0.iter();
        chart.draw_series(rings.map(|&speed| Circle::new((speed, 0.5), fine(POINT), stroke(GREY, 2))))?;
    }
    Ok(())
}

/// The line of a curve; none where it has no chances.
fn points(curve: &Curve, low: f64, high: f64) -> Vec<(f64, f64)> {
    let speeds = (0..=POINTS).map(|i| low + (high - low) * i as f64 / POINTS as f64);
    let chance = |speed: f64| curve.chance(speed).filter(|chance| chance.is_finite());
    speeds.filter_map(|speed| Some((speed, chance(speed)?))).collect()
}

/// The outline of what the shots do not refuse: from below to above along the slow ends, and back along the fast ones.
fn band(curve: &Curve, low: f64, high: f64) -> Vec<(f64, f64)> {
    let inner = (1..STEPS).map(|i| i as f64 / STEPS as f64);
    let [first, second] = EXTREMES;
    let chances: Vec<f64> = [first, second].into_iter().chain(inner).chain([1.0 - second, 1.0 - first]).collect();
    let intervals = curve.speed_intervals(&chances);
    let ends = |end: fn(&Interval) -> Option<f64>, missing: f64| -> Vec<(f64, f64)> {
        let places =
            chances.iter().zip(&intervals).map(|(&chance, interval)| (end(interval).unwrap_or(missing), chance));
        within(&places.collect::<Vec<_>>(), low, high)
    };
    let up = ends(|interval| interval.low, low);
    let down = ends(|interval| interval.high, high);
    up.into_iter().chain(down.into_iter().rev()).collect()
}

/// A line with what is outside of two speeds on these, and the places at which it passes them.
fn within(line: &[(f64, f64)], low: f64, high: f64) -> Vec<(f64, f64)> {
    let mut drawn = Vec::new();
    for (place, &(speed, chance)) in line.iter().enumerate() {
        if let Some(&(before, chance_before)) = place.checked_sub(1).and_then(|before| line.get(before)) {
            let passes = |border: &f64| (before - border) * (speed - border) < 0.0;
            let mut borders: Vec<f64> = [low, high].into_iter().filter(passes).collect();
            borders.sort_by(|a, b| (a - before).abs().total_cmp(&(b - before).abs()));
            let at = |border: f64| chance_before + (chance - chance_before) * (border - before) / (speed - before);
            drawn.extend(borders.into_iter().map(|border| (border, at(border))));
        }
        drawn.push((speed.clamp(low, high), chance));
    }
    drawn
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_passes_the_borders_where_it_does() {
        let line = [(-4.0, 0.1), (4.0, 0.3), (12.0, 0.5)];
        assert_eq!(within(&line, 0.0, 10.0), [(0.0, 0.1), (0.0, 0.2), (4.0, 0.3), (10.0, 0.45), (10.0, 0.5)]);
        assert_eq!(
            within(&[(-5.0, 0.0), (15.0, 1.0)], 0.0, 10.0),
            [(0.0, 0.0), (0.0, 0.25), (10.0, 0.75), (10.0, 1.0)]
        );
        assert_eq!(within(&line[1..2], 0.0, 10.0), [(4.0, 0.3)]);
    }
}
