//! Pictures: one font, one set of colours, and the way from a drawing to SVG and PNG.
//!
//! The text is drawn with an embedded font and turned into outlines, so that a picture looks alike wherever it is made
//! and wherever it is seen.

use std::path::Path;
use std::sync::OnceLock;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::register_font;
use resvg::{tiny_skia, usvg};

use super::Error;

static FONT: &[u8] = include_bytes!("../assets/DejaVuSans-subset.ttf");
const FAMILY: &str = "DejaVu Sans";

/// The backend knows whole coordinates only: drawn this much larger, lines are smooth once the picture has its size.
const FINE: u32 = 10;
/// The PNG has this many dots for each unit of the SVG.
const PNG_SCALE: f32 = 1.5;
pub const TITLE: f64 = 24.0;
pub const HEADING: f64 = 19.0;
pub const TEXT: f64 = 16.0;

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

pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub type Drawn<T> = Result<T, Box<dyn std::error::Error>>;

/// A length of the picture in the backend's coordinates.
pub const fn fine(length: i32) -> i32 {
    length * FINE as i32
}

/// Text of this size and colour.
pub fn text(size: f64, colour: &RGBColor) -> TextStyle<'static> {
    (FAMILY, size * f64::from(FINE)).into_font().color(colour)
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

/// Draws a picture of this width and height and writes it to two files.
///
/// # Errors
/// A file cannot be written.
pub fn write(svg: &Path, png: &Path, size: [u32; 2], paint: impl FnOnce(&Area) -> Drawn<()>) -> Result<(), Error> {
    let fault = |file: &Path, error: &dyn std::fmt::Display| Error::Input(format!("{}: {error}", file.display()));
    let drawn = draw(size, paint).map_err(|error| fault(svg, &error))?;
    let mut options = usvg::Options { font_family: FAMILY.to_string(), ..usvg::Options::default() };
    options.fontdb_mut().load_font_data(FONT.to_vec());
    let tree = usvg::Tree::from_str(&drawn, &options).map_err(|error| fault(svg, &error))?;
    let outlined = usvg::WriteOptions { coordinates_precision: 2, ..usvg::WriteOptions::default() };
    std::fs::write(svg, tree.to_string(&outlined)).map_err(|error| fault(svg, &error))?;
    let [width, height] = size.map(|length| (length as f32 * PNG_SCALE) as u32);
    let mut pixels = tiny_skia::Pixmap::new(width, height).ok_or_else(|| fault(png, &"no memory for the picture"))?;
    resvg::render(&tree, tiny_skia::Transform::from_scale(PNG_SCALE, PNG_SCALE), &mut pixels.as_mut());
    pixels.save_png(png).map_err(|error| fault(png, &error))
}

/// The picture as SVG, its text still text.
fn draw(size: [u32; 2], paint: impl FnOnce(&Area) -> Drawn<()>) -> Drawn<String> {
    static REGISTERED: OnceLock<bool> = OnceLock::new();
    if !REGISTERED.get_or_init(|| register_font(FAMILY, FontStyle::Normal, FONT).is_ok()) {
        return Err("the embedded font is unusable".into());
    }
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (size[0] * FINE, size[1] * FINE)).into_drawing_area();
        root.fill(&WHITE)?;
        paint(&root)?;
        root.present()?;
    }
    // The picture's own size, in front of the coordinates that it is drawn in.
    let [fine, own] = [FINE, 1].map(|scale| format!("width=\"{}\" height=\"{}\"", size[0] * scale, size[1] * scale));
    Ok(svg.replacen(&fine, &own, 1))
}
