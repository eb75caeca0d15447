//! Colours for the sizes of a quantity from 0 to its largest, and the strip that tells what they mean.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::page::{Area, Drawn};
use super::style::{GREY, HEADING, INK, TEXT, fine, stroke, text};
use crate::common::units::number;

const HEIGHT: i32 = 14;
const STEPS: i32 = 40;
const AIR: i32 = 12;
const TICK: i32 = 4;

/// A colour of viridis between nothing and the largest value, one of those that the strip shows.
fn colour(share: f64) -> RGBColor {
    let last = f64::from(STEPS - 1);
    ViridisRGB.get_color((share.clamp(0.0, 1.0) * last).round() / last)
}

/// What the strip tells: a quantity's name, how far that indents the strip, the largest value and its unit.
pub struct Scale<'a> {
    pub name: &'a str,
    pub indent: i32,
    pub width: i32,
    pub largest: f64,
    pub unit: &'a str,
    /// Whether colours go by the square root of the values, so that small ones can be told apart.
    pub root: bool,
}

impl Scale<'_> {
    pub fn colour(&self, value: f64) -> RGBColor {
        let share = if self.largest > 0.0 { value / self.largest } else { 0.0 };
        colour(if self.root { share.max(0.0).sqrt() } else { share })
    }

    /// Draws name, strip and numbers around this height; those of a root stand below it.
    pub fn draw(&self, area: &Area, [left, middle]: [i32; 2]) -> Drawn<()> {
        let style = |size: f64, colour: &RGBColor, h: HPos, v: VPos| text(size, colour).pos(Pos::new(h, v));
        let name = style(HEADING, &INK, HPos::Left, VPos::Center);
        area.draw_text(self.name, &name, (fine(left), fine(middle)))?;
        let left = left + self.indent;
        let [top, bottom] = [-HEIGHT / 2, HEIGHT / 2].map(|down| fine(middle + down));
        for step in 0..STEPS {
            let x = |i: i32| fine(left) + fine(self.width) * i / STEPS;
            // To the end, each over the last: between neighbours the ground would shine through.
            let corners = [(x(step), top), (x(STEPS), bottom)];
            area.draw(&Rectangle::new(corners, colour(f64::from(step) / f64::from(STEPS - 1)).filled()))?;
        }
        let start = if self.root { "" } else { "0 to " };
        let label = format!("{start}{} {}", number(self.largest), self.unit);
        let beside = style(TEXT, &GREY, HPos::Left, VPos::Center);
        area.draw_text(&label, &beside, (fine(left + self.width + AIR), fine(middle)))?;
        // A quarter of the largest value has the colour in the middle.
        let below = [(0, 0.0), (self.width / 2, 0.25 * self.largest)];
        for (x, value) in below.into_iter().filter(|_| self.root) {
            let x = fine(left + x);
            area.draw(&PathElement::new([(x, bottom), (x, bottom + fine(TICK))], stroke(GREY, 1)))?;
            let style = style(TEXT, &GREY, HPos::Center, VPos::Top);
            area.draw_text(&number(value), &style, (x, bottom + fine(TICK + 2)))?;
        }
        Ok(())
    }
}
