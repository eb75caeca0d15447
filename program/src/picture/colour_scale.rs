//! Colours for the sizes of a quantity from 0 to its largest, and the strip that tells what they mean.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::page::{Area, Drawn};
use super::style::{GREY, HEADING, INK, TEXT, fine, text};
use crate::common::units::number;

const WIDTH: i32 = 200;
const HEIGHT: i32 = 14;
const STEPS: i32 = 40;
const AIR: i32 = 12;

/// A colour of viridis between nothing and the largest value, one of those that the strip shows.
pub fn colour(share: f64) -> RGBColor {
    let last = f64::from(STEPS - 1);
    ViridisRGB.get_color((share.clamp(0.0, 1.0) * last).round() / last)
}

/// The quantity's name, at so far to its right the strip, and the largest value with its unit; all around this height.
pub fn draw(area: &Area, [left, middle]: [i32; 2], name: &str, indent: i32, (largest, unit): (f64, &str)) -> Drawn<()> {
    let beside = |size: f64, colour: &RGBColor| text(size, colour).pos(Pos::new(HPos::Left, VPos::Center));
    area.draw_text(name, &beside(HEADING, &INK), (fine(left), fine(middle)))?;
    let left = left + indent;
    let [top, bottom] = [-HEIGHT / 2, HEIGHT / 2].map(|down| fine(middle + down));
    for step in 0..STEPS {
        let x = |i: i32| fine(left) + fine(WIDTH) * i / STEPS;
        // To the end, each over the last: between neighbours the ground would shine through.
        let corners = [(x(step), top), (x(STEPS), bottom)];
        area.draw(&Rectangle::new(corners, colour(f64::from(step) / f64::from(STEPS - 1)).filled()))?;
    }
    let label = format!("0 to {} {unit}", number(largest));
    area.draw_text(&label, &beside(TEXT, &GREY), (fine(left + WIDTH + AIR), fine(middle)))?;
    Ok(())
}
