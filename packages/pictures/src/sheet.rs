//! The backend that plotters draws on: every shape becomes an outline that goes into the SVG and, rendered, into the
//! PNG.

use std::collections::BTreeSet;
use std::convert::Infallible;

use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind, FontTransform,
};
use tiny_skia::{FillRule, IntSize, Paint, Path, PathBuilder, Pixmap, PixmapPaint, Stroke, Transform};

use super::font::{ASCENT, CAPITAL, DESCENT, Font};
use super::style::FINE;
use super::svg::Svg;

/// The PNG has this many dots for each unit of the SVG.
pub const PNG_SCALE: f32 = 1.5;

type Done = Result<(), DrawingErrorKind<Infallible>>;

/// A picture in the making.
pub struct Sheet {
    size: [u32; 2],
    font: Font,
    svg: Svg,
    pixels: Pixmap,
    /// What texts had that the font lacks.
    missing: BTreeSet<char>,
}

impl Sheet {
    /// An empty sheet of this width and height.
    ///
    /// # Errors
    /// It has no width or no height, or is larger than the memory.
    pub fn new(size: [u32; 2]) -> Result<Self, String> {
        let font = Font::new().map_err(|error| format!("the embedded font: {error}"))?;
        let [width, height] = size.map(|length| (length as f32 * PNG_SCALE) as u32);
        let pixels = Pixmap::new(width, height).ok_or("no memory for the picture")?;
        Ok(Sheet { size, font, svg: Svg::new(size), pixels, missing: BTreeSet::new() })
    }

    /// The text of the SVG file.
    pub fn svg(&self) -> String {
        self.svg.finish()
    }

    /// The characters for which boxes stand.
    pub fn missing(&self) -> &BTreeSet<char> {
        &self.missing
    }

    /// The bytes of the PNG file.
    ///
    /// # Errors
    /// They cannot be encoded.
    pub fn png(&self) -> Result<Vec<u8>, String> {
        self.pixels.encode_png().map_err(|error| error.to_string())
    }

    fn fill(&mut self, path: Option<Path>, colour: BackendColor) {
        let Some(path) = path.filter(|_| colour.alpha > 0.0) else { return };
        self.svg.fill(&path, colour);
        self.pixels.fill_path(&path, &paint(colour), FillRule::Winding, scale(), None);
    }

    fn stroke(&mut self, path: Option<Path>, colour: BackendColor, width: u32) {
        let Some(path) = path.filter(|_| colour.alpha > 0.0) else { return };
        let width = width as f32 / FINE as f32;
        self.svg.stroke(&path, colour, width);
        self.pixels.stroke_path(&path, &paint(colour), &Stroke { width, ..Stroke::default() }, scale(), None);
    }

    fn fill_or_stroke<S: BackendStyle>(&mut self, path: Option<Path>, style: &S, fill: bool) {
        if fill {
            self.fill(path, style.color());
        } else {
            self.stroke(path, style.color(), style.stroke_width());
        }
    }
}

fn scale() -> Transform {
    Transform::from_scale(PNG_SCALE, PNG_SCALE)
}

fn paint(colour: BackendColor) -> Paint<'static> {
    let (red, green, blue) = colour.rgb;
    let mut paint = Paint::default();
    paint.set_color_rgba8(red, green, blue, (255.0 * colour.alpha).round() as u8);
    paint
}

/// From plotters' coordinates to the picture's units.
fn units((x, y): BackendCoord) -> (f32, f32) {
    (x as f32 / FINE as f32, y as f32 / FINE as f32)
}

/// The line through some points. There is none through fewer than two.
fn line(points: impl IntoIterator<Item = BackendCoord>, closed: bool) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (x, y) in points.into_iter().map(units) {
        if path.is_empty() {
            path.move_to(x, y);
        } else {
            path.line_to(x, y);
        }
    }
    if closed {
        path.close();
    }
    path.finish()
}

/// A text of this size, its anchor at the origin.
fn anchored(font: &Font, text: &str, style: &impl BackendTextStyle, size: f32) -> Option<Path> {
    let anchor = style.anchor();
    let width = font.width(text, size);
    let left = match anchor.h_pos {
        HPos::Left => 0.0,
        HPos::Center => -0.5 * width,
        HPos::Right => -width,
    };
    let base = match anchor.v_pos {
        VPos::Top => ASCENT,
        VPos::Center => 0.5 * CAPITAL,
        VPos::Bottom => -DESCENT,
    };
    font.outline(text, size)?.transform(Transform::from_translate(left, base * size))
}

impl DrawingBackend for &mut Sheet {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        (self.size[0] * FINE, self.size[1] * FINE)
    }

    fn ensure_prepared(&mut self) -> Done {
        Ok(())
    }

    fn present(&mut self) -> Done {
        Ok(())
    }

    fn draw_pixel(&mut self, (x, y): BackendCoord, colour: BackendColor) -> Done {
        self.draw_rect((x, y), (x + 1, y + 1), &colour, true)
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Done {
        self.draw_path([from, to], style)
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        (left, top): BackendCoord,
        (right, bottom): BackendCoord,
        style: &S,
        fill: bool,
    ) -> Done {
        let corners = [(left, top), (right, top), (right, bottom), (left, bottom)];
        self.fill_or_stroke(line(corners, true), style, fill);
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, points: I, style: &S) -> Done {
        self.stroke(line(points, false), style.color(), style.stroke_width());
        Ok(())
    }

    fn draw_circle<S: BackendStyle>(&mut self, centre: BackendCoord, radius: u32, style: &S, fill: bool) -> Done {
        let (x, y) = units(centre);
        self.fill_or_stroke(PathBuilder::from_circle(x, y, radius as f32 / FINE as f32), style, fill);
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, points: I, style: &S) -> Done {
        self.fill(line(points, true), style.color());
        Ok(())
    }

    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, place: BackendCoord) -> Done {
        let turn = match style.transform() {
            FontTransform::None => 0.0,
            FontTransform::Rotate90 => 90.0,
            FontTransform::Rotate180 => 180.0,
            FontTransform::Rotate270 => 270.0,
        };
        self.missing.extend(text.chars().filter(|&c| !self.font.has(c)));
        let (x, y) = units(place);
        let outline = anchored(&self.font, text, style, style.size() as f32 / FINE as f32);
        let outline = outline.and_then(|path| path.transform(Transform::from_rotate(turn).post_translate(x, y)));
        self.fill(outline, style.color());
        Ok(())
    }

    /// Dots of the PNG as they are; in the SVG an image.
    fn blit_bitmap(&mut self, place: BackendCoord, (width, height): (u32, u32), dots: &[u8]) -> Done {
        let opaque = dots.chunks_exact(3).flat_map(|dot| [dot[0], dot[1], dot[2], 255]).collect();
        let pixels = IntSize::from_wh(width, height).and_then(|size| Pixmap::from_vec(opaque, size));
        let Some(pixels) = pixels else { return Ok(()) };
        let (x, y) = units(place);
        let [left, top] = [x, y].map(|length| (length * PNG_SCALE).round() as i32);
        self.pixels.draw_pixmap(left, top, pixels.as_ref(), &PixmapPaint::default(), Transform::identity(), None);
        if let Ok(png) = pixels.encode_png() {
            self.svg.image([x, y], [width, height].map(|length| length as f32 / PNG_SCALE), &png);
        }
        Ok(())
    }

    fn estimate_text_size<S: BackendTextStyle>(
        &self,
        text: &str,
        style: &S,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        let width = self.font.width(text, style.size() as f32);
        Ok((width.ceil() as u32, style.size().ceil() as u32))
    }
}

#[cfg(test)]
mod tests;
