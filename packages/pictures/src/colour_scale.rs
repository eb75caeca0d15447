//! Colours for the sizes of a quantity from 0 to its largest, and the strip that tells what they mean.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::page::{Area, Drawn};
use super::style::{GREY, HEADING, INK, TEXT, fine, stroke, text};
use toron_shared::numbers::number;

const HEIGHT: i32 = 14;
const STEPS: i32 = 40;
const AIR: i32 = 12;
const TICK: i32 = 4;

/// The colours from nothing to the largest value.
#[derive(Clone, Copy, Debug)]
pub enum Colours {
    Viridis,
    /// What carries little is grey, what carries much goes from yellow to a dark red; each is darker than the one
    /// before.
    GreyToRed,
}

const GREY_TO_RED: [[f64; 3]; 6] = [
    [214.0, 214.0, 214.0],
    [206.0, 203.0, 196.0],
    [250.0, 200.0, 70.0],
    [240.0, 125.0, 40.0],
    [205.0, 45.0, 50.0],
    [110.0, 8.0, 60.0],
];

impl Colours {
    /// One of those that the strip shows.
    fn at(self, share: f64) -> RGBColor {
        let last = f64::from(STEPS - 1);
        let share = (share.clamp(0.0, 1.0) * last).round() / last;
        match self {
            Colours::Viridis => ViridisRGB.get_color(share),
            Colours::GreyToRed => {
                let place = share * (GREY_TO_RED.len() - 1) as f64;
                let lower = (place as usize).min(GREY_TO_RED.len() - 2);
                let [low, high] = [GREY_TO_RED[lower], GREY_TO_RED[lower + 1]];
                let mix = |i: usize| (low[i] + (place - lower as f64) * (high[i] - low[i])).round() as u8;
                RGBColor(mix(0), mix(1), mix(2))
            }
        }
    }
}

/// What the strip tells: a quantity's name, how far that indents the strip, the largest value and its unit.
pub struct Scale<'a> {
    pub name: &'a str,
    pub indent: i32,
    pub width: i32,
    pub largest: f64,
    pub unit: &'a str,
    pub colours: Colours,
    /// Whether colours go by the square root of the values, so that small ones can be told apart.
    pub root: bool,
}

impl Scale<'_> {
    pub fn colour(&self, value: f64) -> RGBColor {
        let share = if self.largest > 0.0 { value / self.largest } else { 0.0 };
        self.colours.at(if self.root { share.max(0.0).sqrt() } else { share })
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
            area.draw(&Rectangle::new(corners, self.colours.at(f64::from(step) / f64::from(STEPS - 1)).filled()))?;
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
