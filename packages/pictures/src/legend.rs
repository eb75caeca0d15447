//! A legend in one line: each mark as what it names is drawn.

use plotters::prelude::*;

use super::page::{Area, Drawn};
use super::style::{GREY, INK, TEXT, fine, stroke, text};

/// The opacity of what is shaded.
pub const BAND: f64 = 0.16;
/// The length of a line and of a band, and from the left of a mark to its name; that of a point; and from a name to the
/// next mark.
const LINE: i32 = 22;
const TO_NAME: i32 = 29;
const POINT_TO_NAME: i32 = 16;
const GAP: i32 = 18;

/// What is drawn in a colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mark {
    Point(RGBColor),
    /// A grey circle.
    Ring,
    Line(RGBColor),
    Band(RGBColor),
}

/// Draws marks and names from this place on.
pub fn draw<N: AsRef<str>>(area: &Area, [left, top]: [i32; 2], legend: &[(Mark, N)]) -> Drawn<()> {
    let style = text(TEXT, &INK);
    let (mut x, middle) = (fine(left), fine(top + 7));
    for (mark, name) in legend {
        let (point, line) = ((x + fine(6), middle), [(x, middle), (x + fine(LINE), middle)]);
        match mark {
            Mark::Point(colour) => area.draw(&Circle::new(point, fine(4), colour.filled()))?,
            Mark::Ring => area.draw(&Circle::new(point, fine(4), stroke(GREY, 2)))?,
            Mark::Line(colour) => area.draw(&PathElement::new(line, stroke(*colour, 3)))?,
            Mark::Band(colour) => {
                let corners = [(x, middle - fine(6)), (x + fine(LINE), middle + fine(6))];
                area.draw(&Rectangle::new(corners, colour.mix(BAND).filled()))?;
            }
        }
        x += fine(if matches!(mark, Mark::Point(_) | Mark::Ring) { POINT_TO_NAME } else { TO_NAME });
        area.draw_text(name.as_ref(), &style, (x, fine(top)))?;
        x += area.estimate_text_size(name.as_ref(), &style)?.0 as i32 + fine(GAP);
    }
    Ok(())
}
