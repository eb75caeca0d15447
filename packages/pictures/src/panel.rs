//! A panel: lines over an abscissa between two axes, with its title and legend.

use plotters::coord::ranged1d::{AsRangedCoord, ValueFormatter};
use plotters::prelude::*;

use super::page::{Area, Drawn};
use super::sheet::Sheet;
use super::style::{COLOURS, GREY, HEADING, INK, RULE, TEXT, fine, stroke, superscript, text};

/// The width of an ordinate's labels.
const MARGIN: i32 = 70;
/// A legend's line with the blank behind it, and the gap behind a name.
const LINE: i32 = 33;
const GAP: i32 = 24;
/// A line with more points than this is thinned.
const MOST_POINTS: usize = 4000;
/// Lines of which the least value is above this part of the largest would all lie at the top of an axis from 0.
const FAR_FROM_0: f64 = 0.7;

/// A line in a panel.
pub struct Series {
    pub name: String,
    pub colour: RGBColor,
    pub values: Vec<f64>,
}

impl Series {
    /// In the colour of this number.
    pub fn new(colour: usize, name: &str, values: Vec<f64>) -> Series {
        Series { name: name.to_string(), colour: COLOURS[colour % COLOURS.len()], values }
    }
}

pub struct Panel {
    pub title: &'static str,
    pub unit: String,
    pub series: Vec<Series>,
    /// A level of its own, drawn dashed.
    pub limit: Option<f64>,
}

impl Panel {
    /// One without a limit.
    pub fn new(title: &'static str, unit: &str, series: Vec<Series>) -> Panel {
        Panel { title, unit: unit.to_string(), series, limit: None }
    }
}

/// The abscissa that panels share.
pub struct Abscissa {
    pub label: String,
    pub values: Vec<f64>,
    pub failure: Option<f64>,
}

/// Drops lines that stay at 0 beside others that do not, and joins lines that the eye cannot tell apart.
pub fn tidy(series: Vec<Series>) -> Vec<Series> {
    let size = |values: &[f64]| values.iter().fold(0.0, |size: f64, value| size.max(value.abs()));
    let largest = series.iter().map(|one| size(&one.values)).fold(0.0, f64::max);
    let mut kept: Vec<Series> = Vec::new();
    for one in series {
        let own = size(&one.values);
        if own <= 1e-6 * largest {
            continue;
        }
        let same = |other: &&mut Series| other.values.iter().zip(&one.values).all(|(a, b)| (a - b).abs() <= 1e-3 * own);
        match kept.iter_mut().find(same) {
            Some(other) => other.name = format!("{} = {}", other.name, one.name),
            None => kept.push(one),
        }
    }
    kept
}

/// A plot between two axes.
type Chart<'a, X, Y> = ChartContext<'a, &'a mut Sheet, Cartesian2d<X, Y>>;

/// Writes a value on an axis.
type Label<'a> = &'a dyn Fn(&f64) -> String;

/// Axes and the rules across, as all plots have them, with the abscissa's name and the two axes' labels.
pub fn chart<'a, X, Y>(
    area: &Area<'a>,
    x: X,
    y: Y,
    name: &str,
    [x_label, y_label]: [Label; 2],
) -> Drawn<Chart<'a, X::CoordDescType, Y::CoordDescType>>
where
    X: AsRangedCoord<Value = f64, CoordDescType: ValueFormatter<f64>>,
    Y: AsRangedCoord<Value = f64, CoordDescType: ValueFormatter<f64>>,
{
    let mut chart = ChartBuilder::on(area)
        .margin_right(fine(30))
        .margin_bottom(fine(12))
        .x_label_area_size(fine(50))
        .y_label_area_size(fine(MARGIN))
        .build_cartesian_2d(x, y)?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(stroke(RULE, 1))
        .axis_style(stroke(GREY, 1))
        .set_all_tick_mark_size(fine(5))
        .x_labels(8)
        .y_labels(6)
        .x_label_formatter(&x_label)
        .y_label_formatter(&y_label)
        .label_style(text(TEXT, &INK))
        .axis_desc_style(text(TEXT, &INK))
        .x_desc(name)
        .draw()?;
    Ok(chart)
}

impl Panel {
    pub fn draw(&self, area: &Area, abscissa: &Abscissa) -> Drawn<()> {
        let (head, body) = area.split_vertically(fine(62));
        let ([low, high], power) = self.range();
        self.draw_head(&head, power)?;
        let factor = 10f64.powi(-power);
        let (left, right) = bounds(&abscissa.values);
        let x_power = power_of_thousand(left.abs().max(right.abs()));
        let x_factor = 10f64.powi(-x_power);
        let (left, right) = (left * x_factor, right * x_factor);
        let (x, y) = (|x: &f64| tick(*x, right - left), |y: &f64| tick(*y, (high - low) * factor));
        let label = with_power(&abscissa.label, x_power);
        let mut chart = chart(&body, left..right, low * factor..high * factor, &label, [&x, &y])?;
        let level = |y: f64| [(left, y * factor), (right, y * factor)];
        if low < 0.0 {
            chart.draw_series(LineSeries::new(level(0.0), stroke(GREY, 1)))?;
        }
        if let Some(limit) = self.limit {
            chart.draw_series(DashedLineSeries::new(level(limit), fine(7), fine(5), stroke(GREY, 2)))?;
        }
        if let Some(x) = abscissa.failure.map(|x| x * x_factor) {
            let line = [(x, low * factor), (x, high * factor)];
            chart.draw_series(DashedLineSeries::new(line, fine(3), fine(4), stroke(INK, 2)))?;
            let (x, y) = chart.backend_coord(&line[1]);
            mark_failure(area, x, y)?;
        }
        let stride = abscissa.values.len().div_ceil(MOST_POINTS).max(1);
        for series in &self.series {
            let points = abscissa.values.iter().zip(&series.values).map(|(&x, &y)| (x * x_factor, y * factor));
            let last = points.clone().next_back();
            let points: Vec<(f64, f64)> = points.step_by(stride).chain(last).collect();
            // What is no number is a gap.
            for part in points.split(|point| !point.1.is_finite()) {
                chart.draw_series(LineSeries::new(part.iter().copied(), stroke(series.colour, 3)))?;
            }
        }
        Ok(())
    }

    /// Title with the unit, and below it the legend in one line, where it covers no data.
    fn draw_head(&self, head: &Area, power: i32) -> Drawn<()> {
        let title = with_power(&format!("{} ({})", self.title, self.unit), power);
        head.draw_text(&title, &text(HEADING, &INK), (fine(MARGIN), fine(8)))?;
        let style = text(TEXT, &INK);
        let width = |name: &str| Ok::<_, Box<dyn std::error::Error>>(head.estimate_text_size(name, &style)?.0 as i32);
        let mut names = 0;
        for series in &self.series {
            names += width(&series.name)?;
        }
        // Shorter lines and gaps, by half at most, where the names would not have room.
        let room = head.dim_in_pixel().0 as i32 - fine(MARGIN) - names;
        let part = f64::from(room) / f64::from(self.series.len().max(1) as i32 * fine(LINE + GAP)).max(1.0);
        let short = |length: i32| (f64::from(fine(length)) * part.clamp(0.4, 1.0)) as i32;
        let mut x = fine(MARGIN);
        for series in &self.series {
            head.draw(&PathElement::new([(x, fine(45)), (x + short(26), fine(45))], stroke(series.colour, 4)))?;
            head.draw_text(&series.name, &style, (x + short(LINE), fine(38)))?;
            x += width(&series.name)? + short(LINE + GAP);
        }
        Ok(())
    }

    /// The range of all lines and the limit with some air, and of 0 unless they vary by far less than they are away
    /// from it; and the power of a thousand that keeps its labels short.
    fn range(&self) -> ([f64; 2], i32) {
        let values = self.series.iter().flat_map(|series| &series.values).copied();
        let mut values: Vec<f64> = values.chain(self.limit).collect();
        let (low, high) = bounds(&values);
        if low <= FAR_FROM_0 * high || values.iter().all(|&value| value == low) {
            values.push(0.0);
        }
        let (low, high) = bounds(&values);
        let air = 0.08 * (high - low);
        let range = [if low == 0.0 { low } else { low - air }, high + air];
        let largest = range[0].abs().max(range[1].abs());
        (range, power_of_thousand(largest))
    }
}

/// The power of a thousand that keeps the labels of numbers up to this one short.
fn power_of_thousand(largest: f64) -> i32 {
    if largest == 0.0 || (1e-2..1e5).contains(&largest) { 0 } else { (largest.log10() / 3.0).floor() as i32 * 3 }
}

/// `time (s)` as `time (10⁻⁶ s)`; a number's unit, which is -, is left out.
fn with_power(label: &str, power: i32) -> String {
    let (name, unit) = label.strip_suffix(')').and_then(|rest| rest.rsplit_once(" (")).unwrap_or((label, "-"));
    match (unit, power) {
        ("-", 0) => name.to_string(),
        (unit, 0) => format!("{name} ({unit})"),
        ("-", power) => format!("{name} (10{})", superscript(power)),
        (unit, power) => format!("{name} (10{} {unit})", superscript(power)),
    }
}

/// The word beside the top of the failure's line, on the side that has room; `x` and `y` are the picture's.
fn mark_failure(area: &Area, x: i32, y: i32) -> Drawn<()> {
    let style = text(TEXT, &INK);
    let (width, _) = area.estimate_text_size("failure", &style)?;
    let (area_left, area_top) = area.get_base_pixel();
    let room_left = x - area_left - fine(MARGIN) > width as i32 + fine(16);
    let offset = if room_left { -(width as i32) - fine(8) } else { fine(8) };
    area.draw_text("failure", &style, (x - area_left + offset, y - area_top + fine(2)))?;
    Ok(())
}

/// Least and largest value, apart from one another even where there is but one.
pub fn bounds(values: &[f64]) -> (f64, f64) {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if low < high { (low, high) } else { (low, low + 1.0) }
}

/// A label without the noise of rounding: as many decimals as ticks of this range need, or a power of ten where they
/// are many.
pub fn tick(value: f64, range: f64) -> String {
    let power = range.log10().floor() as i32;
    if !(-3..6).contains(&power) {
        let digits = tick(value / 10f64.powi(power), range / 10f64.powi(power));
        return if digits == "0" { digits } else { format!("{digits}·10{}", superscript(power)) };
    }
    let decimals = (2 - range.log10().floor() as i32).max(0) as usize;
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_string() } else { text.replace('-', "−") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::draw;
    use crate::style::COLOURS;

    #[test]
    fn labels_are_short_whatever_the_unit() {
        assert_eq!(["0", "20", "−0.05"], [tick(0.0, 30.0), tick(20.0, 30.0), tick(-0.05, 0.2)]);
        assert_eq!(["0", "1·10⁻⁵", "2.5·10⁻⁵"], [0.0, 1e-5, 2.5e-5].map(|x| tick(x, 3e-5)));
        let power = power_of_thousand(3e-5);
        assert_eq!(with_power("time (s)", power), "time (10⁻⁶ s)");
        assert_eq!(with_power("time (ms)", power_of_thousand(0.03)), "time (ms)");
        assert_eq!(["F11", "F11 (10³)"], [0, 3].map(|power| with_power("F11 (-)", power)));
        assert_eq!([0, 0, 6], [0.0, 99_999.0, 2e6].map(power_of_thousand));
    }

    #[test]
    fn a_line_has_a_gap_where_it_has_no_number() {
        let lines = |values: [f64; 5]| {
            let series = Series { name: String::new(), colour: COLOURS[0], values: values.to_vec() };
            let panel = Panel { title: "", unit: "-".to_string(), series: vec![series], limit: None };
            let abscissa = Abscissa { label: "x".to_string(), values: vec![0.0, 1.0, 2.0, 3.0, 4.0], failure: None };
            let sheet = draw([400, 300], |area| panel.draw(area, &abscissa)).expect("it can be drawn");
            sheet.svg().matches("#0072b2").count()
        };
        assert_eq!(lines([1.0, 2.0, f64::NAN, 4.0, 5.0]), lines([1.0, 2.0, 3.0, 4.0, 5.0]) + 1);
    }

    #[test]
    fn an_axis_begins_at_0_unless_its_lines_are_far_from_it() {
        let range = |values: &[f64], limit| {
            let line = Series { name: String::new(), colour: INK, values: values.to_vec() };
            Panel { title: "", unit: String::new(), series: vec![line], limit }.range().0
        };
        let [low, high] = range(&[0.6, 0.7], None);
        assert!((low - 0.592).abs() < 1e-9 && (high - 0.708).abs() < 1e-9, "{low} to {high}");
        assert_eq!(range(&[60.0, 120.0], None)[0], 0.0);
        assert_eq!(range(&[0.6, 0.7], Some(0.1))[0], 0.0);
        assert_eq!(range(&[2.0, 2.0], None)[0], 0.0);
        assert!(range(&[-1.0, 2.0], None)[0] < -1.0);
    }
}
