//! A line of a round length, which a view is measured by.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::page::{Area, Drawn};
use super::style::{GREY, INK, TEXT, fine, stroke, text};

/// The line is some round part of this long.
const LONGEST: f64 = 120.0;
const TICK: i32 = 4;
const NAME_AIR: i32 = 12;

/// Draws the line from a place of the picture to the right, with its length behind it; `scale` is the picture's units
/// in a unit of length.
pub fn draw(area: &Area, [left, middle]: [i32; 2], scale: f64, unit: &str) -> Drawn<()> {
    let length = round_length(LONGEST / scale);
    let right = fine(left) + (scale * length * f64::from(fine(1))) as i32;
    let tick = |x: i32| [(x, fine(middle - TICK)), (x, fine(middle + TICK))];
    for line in [[(fine(left), fine(middle)), (right, fine(middle))], tick(fine(left)), tick(right)] {
        area.draw(&PathElement::new(line, stroke(INK, 1)))?;
    }
    let style = text(TEXT, &GREY).pos(Pos::new(HPos::Left, VPos::Center));
    area.draw_text(&format!("{length} {unit}"), &style, (right + fine(NAME_AIR), fine(middle)))?;
    Ok(())
}

/// The largest of 1, 2 and 5 times a power of ten that is not above `most`.
fn round_length(most: f64) -> f64 {
    let power = 10_f64.powi(most.log10().floor() as i32);
    [5.0, 2.0].into_iter().map(|digit| digit * power).find(|&length| length <= most).unwrap_or(power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ruler_is_a_round_length() {
        let lengths = [9.9, 5.0, 4.9, 1.99, 0.3, 0.07].map(round_length);
        assert_eq!(lengths.map(|length| length.to_string()), ["5", "5", "2", "1", "0.2", "0.05"]);
    }
}
