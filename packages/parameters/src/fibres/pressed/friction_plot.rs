//! The biaxial tests of a scene over the friction between their fibres: how much the section bears, and what of that is
//! friction.

use std::path::Path;

use plotters::prelude::*;

use super::friction::Friction;
use super::output::Results;
use crate::fibres::scene::{Packing, Scene, Walls};
use toron_pictures::legend::{self, Mark};
use toron_pictures::page::{self, Area, Drawn};
use toron_pictures::panel::{bounds, chart, tick};
use toron_pictures::style::{COLOURS, GREY, HEADING, INK, TEXT, TITLE, fine, stroke, text};
use toron_shared::error::Error;

const WIDTH: i32 = 1280;
const HEAD: i32 = 84;
const HEIGHT: u32 = 560;
const PANEL_HEAD: i32 = 62;
const MARGIN: i32 = 70;
const POINT: i32 = 4;
/// Air beside the data, over their range, and how far the packings' points stand apart, over that of the friction.
const AIR: f64 = 0.08;
const APART: f64 = 0.012;

/// A test: its fibres' friction, whether they lie at random, and what came of it.
type Test = (f64, bool, Friction);

/// Draws them, if there are two or more.
///
/// # Errors
/// A file cannot be written.
pub fn write(svg: &Path, png: &Path, scene: &Scene, results: &Results) -> Result<(), Error> {
    let tests = results.iter().filter(|(_, result)| result.pressing.walls == Walls::Biaxial);
    let test = |(case, result): &(&crate::fibres::scene::Case, super::outcome::Pressed)| {
        Some((case.friction, case.packing != Packing::Hexagonal, Friction::of(result)?))
    };
    let tests: Vec<Test> = tests.filter_map(test).collect();
    if tests.len() < 2 {
        return Ok(());
    }
    page::write(svg, png, [WIDTH as u32, HEIGHT], |root| {
        root.draw_text(&scene.title, &text(TITLE, &INK), (fine(24), fine(16)))?;
        root.draw_text(
            "Top and bottom close, sides keep their pressure; means over the last half of the change of shape",
            &text(TEXT, &GREY),
            (fine(24), fine(50)),
        )?;
        let (_, body) = root.split_vertically(fine(HEAD));
        let (left, right) = body.split_horizontally(fine(WIDTH / 2));
        panel(&left, "Deviator over pressure, q/p_t", &tests, |friction| friction.critical.mean.ratio())?;
        panel(&right, "Friction, µ = q/p_t − dI_tc/dI_td", &tests, |friction| friction.critical.mean.mu())
    })
}

/// A point for each test, and a line through the means of those that are alike.
fn panel(area: &Area, title: &str, tests: &[Test], of: impl Fn(&Friction) -> f64) -> Drawn<()> {
    let kinds = [(false, "rows"), (true, "random")];
    let is_there = |random: bool| tests.iter().any(|test| test.1 == random);
    let marks: Vec<(Mark, &str)> = kinds
        .into_iter()
        .enumerate()
        .filter(|(_, (random, _))| is_there(*random))
        .map(|(colour, (_, name))| (Mark::Point(COLOURS[colour]), name))
        .collect();
    let (head, body) = area.split_vertically(fine(PANEL_HEAD));
    head.draw_text(title, &text(HEADING, &INK), (fine(MARGIN), fine(8)))?;
    legend::draw(&head, [MARGIN, 38], &marks)?;
    let wide = |values: Vec<f64>| {
        let (low, high) = bounds(&values);
        let air = AIR * (high - low);
        (low - air, high + air)
    };
    let (left, right) = wide(tests.iter().map(|test| test.0).collect());
    let (low, high) = wide(tests.iter().map(|test| of(&test.2)).chain([0.0]).collect());
    let (x_label, y_label) = (|x: &f64| tick(*x, right - left), |y: &f64| tick(*y, high - low));
    let mut chart = chart(&body, left..right, low..high, "friction between two fibres", [&x_label, &y_label])?;
    chart.draw_series(LineSeries::new([(left, 0.0), (right, 0.0)], stroke(GREY, 1)))?;
    for (colour, (random, _)) in kinds.into_iter().enumerate() {
        let shift = if random { APART } else { -APART } * (right - left);
        let own: Vec<(f64, f64)> =
            tests.iter().filter(|test| test.1 == random).map(|test| (test.0, of(&test.2))).collect();
        let mut frictions: Vec<f64> = own.iter().map(|point| point.0).collect();
        frictions.sort_by(f64::total_cmp);
        frictions.dedup();
        let mean = |friction: f64| {
            let alike: Vec<f64> = own.iter().filter(|point| point.0 == friction).map(|point| point.1).collect();
            (friction + shift, alike.iter().sum::<f64>() / alike.len() as f64)
        };
        chart.draw_series(LineSeries::new(frictions.into_iter().map(mean), stroke(COLOURS[colour], 3)))?;
        let points = own.iter().map(|&(x, y)| Circle::new((x + shift, y), fine(POINT), COLOURS[colour].filled()));
        chart.draw_series(points)?;
    }
    Ok(())
}
