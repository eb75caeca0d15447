//! The work-precision picture: error across, time up. It is made from the report's JSON, so that it can be drawn again
//! without measuring again.

use std::collections::BTreeMap;
use std::path::Path;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use serde::{Deserialize, Serialize};
use toron_pictures::page::{self, Area, Drawn};
use toron_pictures::style::{COLOURS, GREY, INK, RULE, TEXT, TITLE, fine, stroke, superscript, text};

/// Points a call of the times that are drawn: a batch in the cache.
pub const CACHED: usize = 4096;

/// Width and height of the picture.
const SIZE: [u32; 2] = [1080, 760];
/// The range of errors; what stands outside is drawn at its end. On the right a label of the last points has room.
const LEAST: f64 = 3e-17;
const MOST: f64 = 3e-4;
const TICKS: std::ops::RangeInclusive<i32> = -16..=-6;
/// Half the width of a marker, its distance from its name, and the ground around a name.
const MARKER: i32 = 8;
const GAP: i32 = 6;
const GROUND: i32 = 3;

/// What kind of implementation a row is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Family {
    /// Eq. 4.14 as printed.
    Literal,
    /// The form without the singularity, in Fortran.
    Spatial,
    /// Principal stretches.
    Eigen,
    /// The library in double precision.
    Double,
    /// The library in single precision.
    Single,
    /// No law.
    Copy,
}

/// What the picture takes from the report.
#[derive(Deserialize)]
struct Report {
    machine: Machine,
    sizes: Vec<usize>,
    rows: Vec<Row>,
}

#[derive(Deserialize)]
struct Machine {
    processor: String,
    date: String,
}

#[derive(Deserialize)]
struct Row {
    name: String,
    family: Family,
    timings: Vec<Timing>,
    accuracy: Option<Accuracy>,
}

#[derive(Deserialize)]
struct Timing {
    least: f64,
}

#[derive(Deserialize)]
struct Accuracy {
    errors: BTreeMap<String, Category>,
}

#[derive(Deserialize)]
struct Category {
    worst: f64,
}

/// A row that has an error; its place by error and time, or in the picture.
struct Mark<'a, P> {
    row: &'a Row,
    place: (P, P),
}

/// Writes `speed.svg` and `speed.png` from the text of `speed.json`.
pub fn write(json: &str, folder: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let report: Report = serde_json::from_str(json)?;
    let size = report.sizes.iter().position(|&size| size == CACHED).ok_or("no times of a batch in the cache")?;
    page::write(&folder.join("speed.svg"), &folder.join("speed.png"), SIZE, |root| draw(root, &report, size))?;
    Ok(())
}

fn draw(root: &Area, report: &Report, size: usize) -> Drawn<()> {
    let machine = &report.machine;
    root.draw_text("Speed against error", &text(TITLE, &INK), (fine(24), fine(16)))?;
    let subtitle = format!("one core of {}, {CACHED} points a call, {}", machine.processor, machine.date);
    root.draw_text(&subtitle, &text(TEXT, &GREY), (fine(24), fine(50)))?;
    let (_, body) = root.split_vertically(fine(84));

    let time = |row: &Row| row.timings[size].least;
    let mark = |row| Some(Mark { row, place: (error(row)?.clamp(LEAST, MOST), time(row)) });
    let marks: Vec<Mark<f64>> = report.rows.iter().filter_map(mark).collect();
    let copy = report.rows.iter().find(|row| row.family == Family::Copy).map(time);
    let times = || marks.iter().map(|mark| mark.place.1).chain(copy);
    let (low, high) = (0.8 * times().fold(f64::INFINITY, f64::min), 1.3 * times().fold(0.0, f64::max));
    let x = (LEAST..MOST).log_scale().with_key_points(TICKS.step_by(2).map(|power| 10_f64.powi(power)).collect());
    let y = (low..high).log_scale().with_key_points(one_two_five(low, high));
    let mut chart = ChartBuilder::on(&body)
        .margin_left(fine(12))
        .margin_right(fine(30))
        .margin_bottom(fine(12))
        .margin_top(fine(26))
        .x_label_area_size(fine(56))
        .y_label_area_size(fine(50))
        .build_cartesian_2d(x, y)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(stroke(RULE, 1))
        .axis_style(stroke(GREY, 1))
        .set_all_tick_mark_size(fine(5))
        .x_label_formatter(&|x| format!("10{}", superscript(x.log10().round() as i32)))
        .y_label_formatter(&|y| format!("{y}"))
        .label_style(text(TEXT, &INK))
        .axis_desc_style(text(TEXT, &INK))
        .x_desc("worst error of the stress over the truth cases, |σ − truth|/(|truth| + K)")
        .draw()?;
    body.draw_text("nanoseconds a point", &text(TEXT, &INK), (fine(24), 0))?;

    if let Some(copy) = copy {
        let line = [(LEAST, copy), (MOST, copy)];
        chart.draw_series(DashedLineSeries::new(line, fine(7), fine(5), stroke(GREY, 2)))?;
        let (x, y) = chart.backend_coord(&line[0]);
        let label = "reading and writing the same numbers, f64";
        draw_name(root, label, &beside(&GREY), (x + fine(GAP), y + fine(MARKER + GAP)))?;
    }
    let marks: Vec<Mark<i32>> =
        marks.iter().map(|mark| Mark { row: mark.row, place: chart.backend_coord(&mark.place) }).collect();
    draw_names(root, &marks)?;
    marks.iter().try_for_each(|mark| draw_marker(root, mark))
}

/// The worst error of all categories.
fn error(row: &Row) -> Option<f64> {
    Some(row.accuracy.as_ref()?.errors.values().map(|category| category.worst).fold(0.0, f64::max))
}

/// Ones, twos and fives with noughts.
fn one_two_five(low: f64, high: f64) -> Vec<f64> {
    let powers = low.log10().floor() as i32..=high.log10().ceil() as i32;
    let values = powers.flat_map(|power| [1.0, 2.0, 5.0].map(|digit| digit * 10_f64.powi(power)));
    values.filter(|value| (low..high).contains(value)).collect()
}

fn colour(family: Family) -> RGBColor {
    match family {
        Family::Double => COLOURS[0],
        Family::Literal => COLOURS[1],
        Family::Spatial => COLOURS[2],
        Family::Eigen => COLOURS[3],
        Family::Single => COLOURS[5],
        Family::Copy => GREY,
    }
}

/// Text that starts beside what it names, in the middle of its height.
fn beside(colour: &RGBColor) -> TextStyle<'static> {
    text(TEXT, colour).pos(Pos::new(HPos::Left, VPos::Center))
}

fn draw_marker(root: &Area, mark: &Mark<i32>) -> Drawn<()> {
    let ((x, y), r) = (mark.place, fine(MARKER));
    let filled = colour(mark.row.family).filled();
    match mark.row.family {
        Family::Literal => root.draw(&Circle::new((x, y), r, filled))?,
        Family::Eigen => root.draw(&Polygon::new([(x - r, y + r), (x + r, y + r), (x, y - r)], filled))?,
        Family::Spatial => root.draw(&Rectangle::new([(x - r, y - r), (x + r, y + r)], filled))?,
        Family::Double => root.draw(&Polygon::new([(x - r, y), (x, y - r), (x + r, y), (x, y + r)], filled))?,
        Family::Single | Family::Copy => {
            root.draw(&Polygon::new([(x - r, y - r), (x + r, y - r), (x, y + r)], filled))?
        }
    }
    Ok(())
}

/// A rectangle of the picture by two corners.
type Bounds = [(i32, i32); 2];

fn overlap([from, to]: &Bounds, [other_from, other_to]: &Bounds) -> bool {
    from.0 < other_to.0 && other_from.0 < to.0 && from.1 < other_to.1 && other_from.1 < to.1
}

/// What is this far from a point to either side.
fn around((x, y): (i32, i32), [across, up]: [i32; 2]) -> Bounds {
    [(x - across, y - up), (x + across, y + up)]
}

/// What a name of this width covers that starts at this place.
fn bounds((x, y): (i32, i32), width: i32) -> Bounds {
    around((x + width / 2, y), [width / 2, (fine(1) as f64 * TEXT) as i32 / 2])
}

/// A name on ground of its own: a line may run behind it.
fn draw_name(root: &Area, name: &str, style: &TextStyle, place: (i32, i32)) -> Drawn<()> {
    let [(left, top), (right, bottom)] = bounds(place, root.estimate_text_size(name, style)?.0 as i32);
    let ground = [(left - fine(GROUND), top - fine(GROUND)), (right + fine(GROUND), bottom + fine(GROUND))];
    root.draw(&Rectangle::new(ground, WHITE.filled()))?;
    root.draw_text(name, style, place)?;
    Ok(())
}

/// The name of every row beside its marker: on the right, on the left, above or below, by where there is room first.
fn draw_names(root: &Area, marks: &[Mark<i32>]) -> Drawn<()> {
    let mut taken: Vec<Bounds> = marks.iter().map(|mark| around(mark.place, [fine(MARKER); 2])).collect();
    for Mark { row, place: (x, y) } in marks {
        let (width, away) = (root.estimate_text_size(&row.name, &beside(&INK))?.0 as i32, fine(MARKER + GAP));
        let places = [(x + away, *y), (x - away - width, *y), (x - width / 2, y - away), (x - width / 2, y + away)];
        let room = places.into_iter().find(|place| {
            let own = bounds(*place, width);
            own[0].0 > 0 && own[1].0 < fine(SIZE[0] as i32) && !taken.iter().any(|other| overlap(&own, other))
        });
        let place = room.unwrap_or(places[0]);
        draw_name(root, &row.name, &beside(&INK), place)?;
        taken.push(bounds(place, width));
    }
    Ok(())
}
