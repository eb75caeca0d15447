//! One font's sizes, one set of colours, and lengths in plotters' coordinates.

use plotters::prelude::*;

/// plotters knows whole coordinates only: a unit of the picture has this many of them, so that lines are smooth.
pub const FINE: u32 = 10;
/// Sizes of text, in units of the picture.
pub const TITLE: f64 = 19.4;
pub const HEADING: f64 = 15.4;
pub const TEXT: f64 = 12.9;

pub const INK: RGBColor = RGBColor(40, 40, 40);
pub const GREY: RGBColor = RGBColor(110, 110, 110);
pub const RULE: RGBColor = RGBColor(222, 222, 222);
/// Okabe and Ito's colours, which the colour-blind can tell apart.
pub const COLOURS: [RGBColor; 6] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
];

/// A length of the picture in plotters' coordinates.
pub const fn fine(length: i32) -> i32 {
    length * FINE as i32
}

/// Text of this size and colour. The sheet has one font, whatever name is given here.
pub fn text(size: f64, colour: &RGBColor) -> TextStyle<'static> {
    (FontFamily::SansSerif, size * f64::from(FINE)).into_font().color(colour)
}

/// A line of this colour and width.
pub fn stroke(colour: RGBColor, width: u32) -> ShapeStyle {
    colour.stroke_width(width * FINE)
}

/// A power of ten's exponent.
pub fn superscript(power: i32) -> String {
    let digits = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = |c: char| c.to_digit(10).map_or('⁻', |d| digits[d as usize]);
    power.to_string().chars().map(digit).collect()
}
