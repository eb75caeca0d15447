//! The picture of a series: the curves with what the shots do not refuse, and residual over striking speed.

use std::path::Path;

use plotters::prelude::*;

use super::curves_plot::{self, AIR, FATES, POINT, SHOT, Shown, head, speeds};
use super::scene::Scene;
use super::series::Series;
use toron_explicit_host::judgement::SOUND;
use toron_materials::units::{SPEED, unit};
use toron_pictures::legend::Mark;
use toron_pictures::page::{self, Area, Drawn};
use toron_pictures::panel::{chart, tick};
use toron_pictures::style::{GREY, INK, TEXT, TITLE, fine, stroke, text};
use toron_shared::error::Error;

const WIDTH: i32 = 1280;
const HEAD: i32 = 84;
const PANEL: i32 = 470;
/// Points of a line.
const POINTS: usize = 300;

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
        curves_plot::draw(&left, &unit(&scene.units, SPEED), &[shown(series)])?;
        draw_residuals(&right, scene, series)
    })
}

/// What is drawn of the curves.
fn shown(series: &Series) -> Shown<'_> {
    let [_, _, undecided, errors] = series.counts();
    let kinds = [(undecided, "undecided"), (errors, "error")].into_iter().filter(|(count, _)| *count > 0);
    let kinds: Vec<&str> = kinds.map(|kind| kind.1).collect();
    let without_fate = series.shots.iter().filter(|ended| ended.fate().is_none());
    let speeds = without_fate.map(|ended| ended.shot.speed).collect();
    Shown { name: "", told: &series.told, without_fate: (speeds, kinds.join(", ")) }
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
    let (low, high) = speeds(&[shown(series)]);
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
