//! The picture of a series: the curves with what the shots do not refuse, and residual over striking speed.

use std::path::Path;

use plotters::prelude::*;

use super::curve::Curve;
use super::link::Link;
use super::scene::Scene;
use super::series::Series;
use super::shot::{Ended, Ending};
use toron_explicit_host::judgement::SOUND;
use toron_materials::units::{SPEED, unit};
use toron_pictures::legend::{self, BAND, Mark};
use toron_pictures::page::{self, Area, Drawn};
use toron_pictures::panel::{bounds, chart, tick};
use toron_pictures::style::{COLOURS, GREY, HEADING, INK, TEXT, TITLE, fine, stroke, text};
use toron_shared::error::Error;

const WIDTH: i32 = 1280;
const HEAD: i32 = 84;
const PANEL: i32 = 470;
/// The height of a panel's title and legend.
const PANEL_HEAD: i32 = 62;
const MARGIN: i32 = 70;
const POINT: i32 = 5;
/// Air around the speeds, over their range.
const AIR: f64 = 0.06;
/// Chances from 0 to 1 over the height, and as much air above and below.
const CHANCES: std::ops::Range<f64> = -0.08..1.08;
/// The chances at which a band is found: every fiftieth, but for 0 and 1, and nearer to these.
const STEPS: usize = 50;
const EXTREMES: [f64; 2] = [0.002, 0.008];
const SHOT: f64 = 0.75;
/// Points of a line.
const POINTS: usize = 300;
/// The colours of stops and perforations, and of the two curves.
const FATES: [RGBColor; 2] = [COLOURS[0], COLOURS[1]];
const CURVES: [RGBColor; 2] = [COLOURS[2], COLOURS[3]];

/// Writes the picture.
///
/// # Errors
/// A file cannot be written.
pub fn write(svg: &Path, png: &Path, scene: &Scene, series: &Series) -> Result<(), Error> {
    page::write(svg, png, [WIDTH as u32, (HEAD + PANEL) as u32], |root| {
        root.draw_text(&scene.title, &text(TITLE, &INK), (fine(24), fine(16)))?;
        let [stopped, through, undecided, errors] = series.counts();
        let unsound = series.verdicts().filter(|(ended, ..)| ended.verdict != SOUND).count();
        let counts = format!(
            "design {}: {stopped} stopped, {through} through, {undecided} undecided, {errors} errors; verdict of {unsound} other than {SOUND}",
            scene.design().name()
        );
        root.draw_text(&counts, &text(TEXT, &GREY), (fine(24), fine(50)))?;
        let (_, body) = root.split_vertically(fine(HEAD));
        let (left, right) = body.split_horizontally(fine(WIDTH / 2));
        draw_curves(&left, scene, series)?;
        draw_residuals(&right, scene, series)
    })
}

/// The speeds of all shots, with some air.
fn speeds(series: &Series) -> (f64, f64) {
    let speeds: Vec<f64> = series.shots.iter().map(|ended| ended.shot.speed).collect();
    let (low, high) = bounds(&speeds);
    let air = AIR * (high - low);
    (low - air, high + air)
}

fn head<'a>(area: &Area<'a>, title: &str, legend: &[(Mark, String)]) -> Drawn<Area<'a>> {
    let (head, body) = area.split_vertically(fine(PANEL_HEAD));
    head.draw_text(title, &text(HEADING, &INK), (fine(MARGIN), fine(8)))?;
    legend::draw(&head, [MARGIN, 38], legend)?;
    Ok(body)
}

/// Where a shot is drawn whose fate is known, or not.
fn height(ended: &Ended) -> f64 {
    match ended.ending {
        Ending::Stopped => 0.0,
        Ending::Through => 1.0,
        Ending::Undecided | Ending::Error(_) => 0.5,
    }
}

fn draw_curves(area: &Area, scene: &Scene, series: &Series) -> Drawn<()> {
    let speed = unit(&scene.units, SPEED);
    let (low, high) = speeds(series);
    let drawn: Vec<&Curve> = Link::BOTH.into_iter().filter_map(|link| series.drawn(link)).collect();
    let mut legend =
        vec![(Mark::Point(FATES[0]), "stopped".to_string()), (Mark::Point(FATES[1]), "through".to_string())];
    let [_, _, undecided, errors] = series.counts();
    let without_fate: Vec<&str> = [(undecided, "undecided"), (errors, "error")]
        .into_iter()
        .filter(|(count, _)| *count > 0)
        .map(|it| it.1)
        .collect();
    if !without_fate.is_empty() {
        legend.push((Mark::Ring, without_fate.join(", ")));
    }
    for curve in &drawn {
        let firth = if curve.firth { ", Firth" } else { "" };
        let (colour, name) = (CURVES[curve.link as usize], format!("{}{firth}", curve.link.name()));
        // Shots that are separated have no line, but a band of what they do not refuse.
        let is_line = !points(curve, low, high).is_empty();
        legend.push((if is_line { Mark::Line(colour) } else { Mark::Band(colour) }, format!("{name}, 95 %")));
    }
    let body = head(area, "Chance of a perforation", &legend)?;
    let x_label = |x: &f64| tick(*x, high - low);
    let y_label = |y: &f64| tick(*y, 1.0);
    let mut chart = chart(&body, low..high, CHANCES, &format!("striking speed ({speed})"), [&x_label, &y_label])?;
    for curve in &drawn {
        let colour = CURVES[curve.link as usize];
        chart.draw_series([Polygon::new(band(curve, low, high), colour.mix(BAND).filled())])?;
    }
    for curve in &drawn {
        let colour = CURVES[curve.link as usize];
        chart.draw_series(LineSeries::new(points(curve, low, high), stroke(colour, 3)))?;
    }
    chart.draw_series(series.shots.iter().map(|ended| {
        let style = match ended.fate() {
            Some(fate) => FATES[usize::from(fate.through)].mix(SHOT).filled(),
            None => stroke(GREY, 2),
        };
        Circle::new((ended.shot.speed, height(ended)), fine(POINT), style)
    }))?;
    Ok(())
}

/// The line of a curve; none where it has no chances.
fn points(curve: &Curve, low: f64, high: f64) -> Vec<(f64, f64)> {
    let speeds = (0..=POINTS).map(|i| low + (high - low) * i as f64 / POINTS as f64);
    speeds.filter_map(|speed| Some((speed, curve.chance(speed)?))).collect()
}

/// The outline of what the shots do not refuse: from below to above along the slow ends, and back along the fast ones.
fn band(curve: &Curve, low: f64, high: f64) -> Vec<(f64, f64)> {
    let inner = (1..STEPS).map(|i| i as f64 / STEPS as f64);
    let [first, second] = EXTREMES;
    let chances: Vec<f64> = [first, second].into_iter().chain(inner).chain([1.0 - second, 1.0 - first]).collect();
    let intervals: Vec<_> = chances.iter().map(|&chance| curve.speed_interval(chance)).collect();
    let slow = |end: Option<f64>| end.unwrap_or(low).clamp(low, high);
    let fast = |end: Option<f64>| end.unwrap_or(high).clamp(low, high);
    let up = chances.iter().zip(&intervals).map(|(&chance, interval)| (slow(interval.low), chance));
    let down = chances.iter().zip(&intervals).map(|(&chance, interval)| (fast(interval.high), chance)).rev();
    up.chain(down).collect()
}

fn draw_residuals(area: &Area, scene: &Scene, series: &Series) -> Drawn<()> {
    let speed = unit(&scene.units, SPEED);
    let mut legend =
        vec![(Mark::Point(FATES[0]), "stopped".to_string()), (Mark::Point(FATES[1]), "through".to_string())];
    let fitted = series.residual.and_then(Result::ok);
    if fitted.is_some() {
        legend.push((Mark::Line(INK), "Lambert and Jonas".to_string()));
    }
    let body = head(area, &format!("Residual speed ({speed})"), &legend)?;
    let (low, high) = speeds(series);
    let points: Vec<(f64, f64, bool)> = series
        .shots
        .iter()
        .filter_map(|ended| {
            let fate = ended.fate()?;
            Some((fate.speed, ended.residual().unwrap_or(0.0), fate.through))
        })
        .collect();
    let fastest = fitted.map_or(0.0, |curve| curve.residual(high));
    let most = points.iter().map(|point| point.1).fold(fastest, f64::max).max(f64::MIN_POSITIVE);
    let x_label = |x: &f64| tick(*x, high - low);
    let y_label = |y: &f64| tick(*y, most);
    let range = -AIR * most..(1.0 + AIR) * most;
    let mut chart = chart(&body, low..high, range, &format!("striking speed ({speed})"), [&x_label, &y_label])?;
    if let Some(curve) = fitted {
        let points = (0..=POINTS).map(|i| low + (high - low) * i as f64 / POINTS as f64);
        chart.draw_series(LineSeries::new(points.map(|speed| (speed, curve.residual(speed))), stroke(INK, 2)))?;
    }
    chart.draw_series(points.iter().map(|&(speed, residual, through)| {
        Circle::new((speed, residual), fine(POINT), FATES[usize::from(through)].mix(SHOT).filled())
    }))?;
    Ok(())
}
