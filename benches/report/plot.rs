//! The work-precision picture: error across, time up.

use std::path::Path;

use plotters::prelude::*;
use toron_program::picture::{
    self, Area, COLOURS, Drawn, GREY, INK, RULE, TEXT, TITLE, fine, stroke, superscript, text,
};

use super::{CACHED, Family, Report, Row};

/// Width and height of the picture.
const SIZE: [u32; 2] = [1280, 840];
/// The range of errors; what stands outside is drawn at its end.
const LEAST: f64 = 1e-19;
const MOST: f64 = 1e-5;
/// Half the width of a marker.
const MARKER: i32 = 8;

/// Writes `speed.svg` and `speed.png`.
pub fn write(report: &Report, folder: &Path) -> Result<(), toron_program::Error> {
    picture::write(&folder.join("speed.svg"), &folder.join("speed.png"), SIZE, |root| draw(root, report))
}

fn draw(root: &Area, report: &Report) -> Drawn<()> {
    let machine = &report.machine;
    root.draw_text("Speed against error", &text(TITLE, &INK), (fine(24), fine(16)))?;
    let subtitle = format!("one core of {}, {CACHED} points a call, {}", machine.processor, machine.date);
    root.draw_text(&subtitle, &text(TEXT, &GREY), (fine(24), fine(50)))?;
    let (_, body) = root.split_vertically(fine(84));

    let laws = || report.rows.iter().filter_map(|row| Some((row, row.accuracy.as_ref()?)));
    let low = 0.5 * laws().map(|(row, _)| report.time(row, CACHED)).fold(f64::INFINITY, f64::min);
    let high = 1.5 * laws().map(|(row, _)| report.time(row, CACHED)).fold(0.0, f64::max);
    let mut chart = ChartBuilder::on(&body)
        .margin_left(fine(12))
        .margin_right(fine(30))
        .margin_bottom(fine(12))
        .margin_top(fine(26))
        .x_label_area_size(fine(56))
        .y_label_area_size(fine(50))
        .build_cartesian_2d((LEAST..MOST).log_scale(), (low..high).log_scale())?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(stroke(RULE, 1))
        .axis_style(stroke(GREY, 1))
        .set_all_tick_mark_size(fine(5))
        .y_labels(20)
        .x_label_formatter(&|x| format!("10{}", superscript(x.log10().round() as i32)))
        .y_label_formatter(&one_two_five)
        .label_style(text(TEXT, &INK))
        .axis_desc_style(text(TEXT, &INK))
        .x_desc("worst error of the stress over the truth cases, |σ − truth|/(|truth| + K)")
        .draw()?;
    body.draw_text("nanoseconds a point", &text(TEXT, &INK), (fine(24), 0))?;

    let copy = report.rows.iter().find(|row| row.family == Family::Copy);
    if let Some(copy) = copy.map(|row| report.time(row, CACHED)) {
        let line = [(LEAST, copy), (MOST, copy)];
        chart.draw_series(DashedLineSeries::new(line, fine(7), fine(5), stroke(GREY, 2)))?;
        let (x, y) = chart.backend_coord(&line[0]);
        let (left, top) = root.get_base_pixel();
        let label = "reading and writing the same numbers, f64";
        root.draw_text(label, &text(TEXT, &GREY), (x - left + fine(6), y - top - fine(24)))?;
    }
    for (row, accuracy) in laws() {
        let place = (accuracy.worst().clamp(LEAST, MOST), report.time(row, CACHED));
        mark(root, row, chart.backend_coord(&place))?;
    }
    Ok(())
}

/// A label where it is a one, a two or a five with noughts: others would crowd.
fn one_two_five(value: &f64) -> String {
    let text = format!("{value:.0}");
    if ["1", "2", "5"].contains(&text.trim_end_matches('0')) { text } else { String::new() }
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

/// A row's marker and its name: left of it for the library, right of it for the others.
fn mark(root: &Area, row: &Row, (x, y): (i32, i32)) -> Drawn<()> {
    let r = fine(MARKER);
    let filled = colour(row.family).filled();
    match row.family {
        Family::Literal => root.draw(&Circle::new((x, y), r, filled))?,
        Family::Eigen => root.draw(&Polygon::new([(x - r, y + r), (x + r, y + r), (x, y - r)], filled))?,
        Family::Spatial => root.draw(&Rectangle::new([(x - r, y - r), (x + r, y + r)], filled))?,
        Family::Double => root.draw(&Polygon::new([(x - r, y), (x, y - r), (x + r, y), (x, y + r)], filled))?,
        Family::Single | Family::Copy => {
            root.draw(&Polygon::new([(x - r, y - r), (x + r, y - r), (x, y + r)], filled))?
        }
    }
    let style = text(TEXT, &INK);
    let (width, height) = root.estimate_text_size(&row.name, &style)?;
    let left = [Family::Double, Family::Single].contains(&row.family);
    let offset = if left { -(width as i32) - fine(14) } else { fine(14) };
    let corner = (x + offset, y - fine(10));
    // A line may run behind the name.
    let opposite = (corner.0 + width as i32, corner.1 + height as i32);
    root.draw(&Rectangle::new([corner, opposite], WHITE.filled()))?;
    root.draw_text(&row.name, &style, corner)?;
    Ok(())
}
