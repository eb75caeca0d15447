//! The plot of a fit: each set with its fit and its residuals, the joint region of k_tc and p, and the sections that
//! slide with the line of their friction.

use std::path::Path;

use plotters::prelude::*;

use super::data::{Axis, DataSet, Loading};
use super::file::Job;
use super::fit::{Fit, SetFit};
use super::parameter::Parameter;
use toron::law::parameters::STRESS;
use toron_materials::units::unit;
use toron_pictures::legend::{self, Mark};
use toron_pictures::page::{self, Area, Drawn};
use toron_pictures::panel::{bounds, chart, tick};
use toron_pictures::style::{COLOURS, GREY, HEADING, INK, TEXT, TITLE, fine, stroke, text};
use toron_shared::error::Error;

const WIDTH: u32 = 1280;
/// A row of panels.
const ROW: u32 = 330;
/// More pairs of panels than this stand in two columns.
const MOST_IN_A_COLUMN: usize = 4;
const HEAD: u32 = 84;
/// The height of a panel's title and legend.
const PANEL_HEAD: i32 = 62;
const MARGIN: i32 = 70;
/// Air around the data, over their range.
const AIR: f64 = 0.06;
const POINT: i32 = 3;

/// Writes the plot; `border` is that of the joint region.
///
/// # Errors
/// A file cannot be written.
pub fn write(svg: &Path, png: &Path, job: &Job, fit: &Fit, border: Option<&[[f64; 2]]>) -> Result<(), Error> {
    let [rows, columns] = grid(job, border);
    page::write(svg, png, [WIDTH * columns as u32, HEAD + ROW * rows as u32], |root| draw(root, job, fit, border))
}

/// Rows and columns of pairs of panels: a pair for each set, and another one for the joint region and the friction.
fn grid(job: &Job, border: Option<&[[f64; 2]]>) -> [usize; 2] {
    let pairs = job.problem.sets.len() + usize::from(border.is_some() || !job.friction.points.is_empty());
    let columns = if pairs > MOST_IN_A_COLUMN { 2 } else { 1 };
    [pairs.div_ceil(columns), columns]
}

fn draw(root: &Area, job: &Job, fit: &Fit, border: Option<&[[f64; 2]]>) -> Drawn<()> {
    root.draw_text(&job.title, &text(TITLE, &INK), (fine(24), fine(16)))?;
    root.draw_text(
        "Data, fit and residuals, which are the data less the fit",
        &text(TEXT, &GREY),
        (fine(24), fine(50)),
    )?;
    let (_, body) = root.split_vertically(fine(HEAD as i32));
    let [rows, columns] = grid(job, border);
    let places = body.split_evenly((rows, columns));
    for ((set, fitted), place) in job.problem.sets.iter().zip(&fit.sets).zip(&places) {
        let (left, right) = place.split_horizontally(fine(WIDTH as i32 / 2));
        let over = abscissa(set, fit);
        draw_set(&left, set, fitted, &over)?;
        draw_residuals(&right, set, fitted, &over)?;
    }
    if let Some(place) = places.get(job.problem.sets.len()) {
        let (left, right) = place.split_horizontally(fine(WIDTH as i32 / 2));
        if let Some(border) = border {
            draw_region(&left, job, fit, border)?;
        }
        if !job.friction.points.is_empty() {
            draw_friction(if border.is_some() { &right } else { &left }, job)?;
        }
    }
    Ok(())
}

/// A panel's title, and axes for these values below it.
struct Frame<'a> {
    title: String,
    legend: &'a [(Mark, &'a str)],
    x: (f64, f64),
    y: (f64, f64),
    x_name: String,
}

type Plane<'a> = ChartContext<
    'a,
    &'a mut toron_pictures::sheet::Sheet,
    Cartesian2d<plotters::coord::types::RangedCoordf64, plotters::coord::types::RangedCoordf64>,
>;

impl Frame<'_> {
    fn draw<'a>(&self, area: &Area<'a>) -> Drawn<Plane<'a>> {
        let (head, body) = area.split_vertically(fine(PANEL_HEAD));
        head.draw_text(&self.title, &text(HEADING, &INK), (fine(MARGIN), fine(8)))?;
        legend::draw(&head, [MARGIN, 38], self.legend)?;
        let [(left, right), (low, high)] = [self.x, self.y].map(|(low, high)| {
            let air = AIR * (high - low);
            (low - air, high + air)
        });
        let x_label = |x: &f64| tick(*x, right - left);
        let y_label = |y: &f64| tick(*y, high - low);
        chart(&body, left..right, low..high, &self.x_name, [&x_label, &y_label])
    }
}

fn named(axis: &Axis) -> String {
    if axis.unit == "-" { axis.name.clone() } else { format!("{} ({})", axis.name, axis.unit) }
}

/// What a set is drawn over: its abscissa; of failure points at compactions and distortions that both vary, what the
/// fit makes of the two, since over one of them alone the fit is no line.
fn abscissa(set: &DataSet, fit: &Fit) -> Axis {
    let varies = |values: &[f64]| values.iter().any(|&value| value != values[0]);
    match &set.loading {
        Loading::Failure { compaction, distortion } if varies(compaction) && varies(distortion) => {
            let [alpha, beta] = [Parameter::Alpha, Parameter::Beta]
                .map(|parameter| fit.values[parameter.index()].or(parameter.property().default).unwrap_or_default());
            let values = compaction.iter().zip(distortion).map(|(c, d)| alpha * c + beta * d).collect();
            Axis { name: "−α I_tc + β I_td".to_string(), unit: "-".to_string(), values }
        }
        _ => set.abscissa.clone(),
    }
}

/// Indices by the abscissa, for a line from left to right.
fn sorted(x: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..x.len()).collect();
    order.sort_by(|&a, &b| x[a].total_cmp(&x[b]));
    order
}

fn draw_set(area: &Area, set: &DataSet, fitted: &SetFit, over: &Axis) -> Drawn<()> {
    let (x, y) = (&over.values, &set.ordinate.values);
    let fit = |i: usize| y[i] - fitted.residuals[i];
    let all: Vec<f64> = y.iter().copied().chain((0..set.len()).map(fit)).chain([0.0]).collect();
    let frame = Frame {
        title: format!("{}: {}", set.name, named(&set.ordinate)),
        legend: &[(Mark::Point(COLOURS[0]), "data"), (Mark::Line(COLOURS[1]), "fit")],
        x: bounds(&x.iter().copied().chain([set.rest]).collect::<Vec<_>>()),
        y: bounds(&all),
        x_name: named(over),
    };
    let mut chart = frame.draw(area)?;
    chart.draw_series((0..set.len()).map(|i| Circle::new((x[i], y[i]), fine(POINT), COLOURS[0].filled())))?;
    chart.draw_series(LineSeries::new(sorted(x).into_iter().map(|i| (x[i], fit(i))), stroke(COLOURS[1], 2)))?;
    Ok(())
}

fn draw_residuals(area: &Area, set: &DataSet, fitted: &SetFit, over: &Axis) -> Drawn<()> {
    let x = &over.values;
    let largest = set.largest();
    let shares: Vec<f64> = fitted.residuals.iter().map(|r| 100.0 * r / largest).collect();
    let size = shares.iter().fold(f64::MIN_POSITIVE, |size: f64, share| size.max(share.abs()));
    let size = if size > 1e-9 { size } else { 1e-9 };
    let frame = Frame {
        title: format!("{}: residuals (% of the largest)", set.name),
        legend: &[],
        x: bounds(&x.iter().copied().chain([set.rest]).collect::<Vec<_>>()),
        y: (-size, size),
        x_name: named(over),
    };
    let mut chart = frame.draw(area)?;
    let ends = bounds(&x.iter().copied().chain([set.rest]).collect::<Vec<_>>());
    chart.draw_series(LineSeries::new([(ends.0, 0.0), (ends.1, 0.0)], stroke(GREY, 1)))?;
    chart.draw_series((0..set.len()).map(|i| Circle::new((x[i], shares[i]), fine(POINT), COLOURS[0].filled())))?;
    Ok(())
}

/// The joint region, and the rectangle of the single intervals.
fn draw_region(area: &Area, job: &Job, fit: &Fit, border: &[[f64; 2]]) -> Drawn<()> {
    let of = |parameter| fit.estimates.iter().find(|estimate| estimate.parameter == parameter);
    let (Some(k_tc), Some(p)) = (of(Parameter::KTc), of(Parameter::P)) else { return Ok(()) };
    let axis = |i: usize, more: [f64; 2]| bounds(&border.iter().map(|pair| pair[i]).chain(more).collect::<Vec<_>>());
    let frame = Frame {
        title: format!("k_tc ({}) over p", unit(&job.units, Parameter::KTc.property().dimension)),
        legend: &[
            (Mark::Line(COLOURS[1]), "joint 95 % region"),
            (Mark::Line(GREY), "each one's 95 % interval"),
            (Mark::Point(COLOURS[1]), "fit"),
        ],
        x: axis(1, [p.low, p.high]),
        y: axis(0, [k_tc.low, k_tc.high]),
        x_name: "p".to_string(),
    };
    let mut chart = frame.draw(area)?;
    let corners = [(p.low, k_tc.low), (p.high, k_tc.low), (p.high, k_tc.high), (p.low, k_tc.high), (p.low, k_tc.low)];
    chart.draw_series(LineSeries::new(corners, stroke(GREY, 1)))?;
    chart.draw_series(LineSeries::new(border.iter().map(|pair| (pair[1], pair[0])), stroke(COLOURS[1], 3)))?;
    chart.draw_series([Circle::new((p.value, k_tc.value), fine(POINT), COLOURS[1].filled())])?;
    Ok(())
}

/// The sections that slide, and the line that µ and c make of them.
fn draw_friction(area: &Area, job: &Job) -> Drawn<()> {
    let (points, [mu, c]) = (&job.friction.points, job.friction.values);
    let line = |p_t: f64| mu * p_t + c;
    let x = bounds(&points.iter().map(|point| point.p_t).chain([0.0]).collect::<Vec<_>>());
    let stress = unit(&job.units, STRESS);
    let frame = Frame {
        title: format!("Sections that slide: q − p_t dI_tc/dI_td ({stress}), which µ p_t + c is"),
        legend: &[
            (Mark::Point(COLOURS[0]), "under pressure"),
            (Mark::Point(COLOURS[2]), "with free sides"),
            (Mark::Line(COLOURS[1]), "fit"),
        ],
        x,
        y: bounds(&points.iter().map(|point| point.q).chain([0.0, line(x.0), line(x.1)]).collect::<Vec<_>>()),
        x_name: format!("p_t ({stress})"),
    };
    let mut chart = frame.draw(area)?;
    chart.draw_series(LineSeries::new([x.0, x.1].map(|p_t| (p_t, line(p_t))), stroke(COLOURS[1], 2)))?;
    chart.draw_series(points.iter().map(|point| {
        let colour = COLOURS[if point.is_free { 2 } else { 0 }];
        Circle::new((point.p_t, point.q), fine(POINT), colour.filled())
    }))?;
    Ok(())
}
