//! The embedded font: outlines of text, and their width.

use tiny_skia::{Path, PathBuilder, Transform};
use ttf_parser::gpos::{PairAdjustment, PositioningSubtable};
use ttf_parser::{Face, GlyphId, OutlineBuilder};

static FILE: &[u8] = include_bytes!("../assets/DejaVuSans-subset.ttf");

/// Heights above and below the base line, as parts of the font's size: of a capital, of the tallest letter, and down to
/// the lowest.
pub const CAPITAL: f32 = 0.73;
pub const ASCENT: f32 = 0.76;
pub const DESCENT: f32 = 0.24;

/// The glyph of what a font lacks; this font's own is empty.
const MISSING: GlyphId = GlyphId(0);
/// Of the embedded font, as of its family.
const UNITS_PER_EM: f32 = 2048.0;

pub struct Font {
    face: Face<'static>,
}

impl Font {
    /// # Errors
    /// The embedded font is unusable.
    pub fn new() -> Result<Self, ttf_parser::FaceParsingError> {
        Ok(Font { face: Face::parse(FILE, 0)? })
    }

    /// Whether it has this character, or draws it as nothing: else a box stands for it.
    pub fn has(&self, c: char) -> bool {
        c.is_control() || self.face.glyph_index(c).is_some()
    }

    /// The width of a text of this size.
    pub fn width(&self, text: &str, size: f32) -> f32 {
        let advances: i32 = self.glyphs(text).map(|(_, advance)| advance).sum();
        advances as f32 * self.scale(size)
    }

    /// The outlines of a text, whose base line starts at the origin; upwards is negative, as in a picture. There are
    /// none of blanks.
    pub fn outline(&self, text: &str, size: f32) -> Option<Path> {
        let mut outline = Outline { path: PathBuilder::new(), left: 0 };
        for (glyph, advance) in self.glyphs(text) {
            if glyph == MISSING {
                outline.draw_box(advance as f32);
            } else {
                self.face.outline_glyph(glyph, &mut outline);
            }
            outline.left += advance;
        }
        let scale = self.scale(size);
        outline.path.finish()?.transform(Transform::from_scale(scale, -scale))
    }

    fn scale(&self, size: f32) -> f32 {
        size / f32::from(self.face.units_per_em())
    }

    /// The glyphs of a text, and how far it is to the next, in the font's units. What the font lacks is a box.
    fn glyphs(&self, text: &str) -> impl Iterator<Item = (GlyphId, i32)> {
        let glyph = |c: char| self.face.glyph_index(if c.is_control() { ' ' } else { c }).unwrap_or_default();
        let glyphs: Vec<GlyphId> = text.chars().map(glyph).collect();
        let advance = move |i: usize| {
            let own = if glyphs[i] == MISSING { self.box_width() } else { self.face.glyph_hor_advance(glyphs[i]) };
            let own = i32::from(own.unwrap_or_default());
            let kerning = glyphs.get(i + 1).map_or(0, |&next| self.kerning(glyphs[i], next));
            (glyphs[i], own + i32::from(kerning))
        };
        (0..text.chars().count()).map(advance)
    }

    /// A box is as wide as a capital.
    fn box_width(&self) -> Option<u16> {
        self.face.glyph_hor_advance(self.face.glyph_index('H')?)
    }

    /// What a pair stands closer together than each by itself.
    fn kerning(&self, left: GlyphId, right: GlyphId) -> i16 {
        let Some(table) = self.face.tables().gpos else { return 0 };
        let subtables = table.lookups.into_iter().flat_map(|lookup| lookup.subtables.into_iter());
        let mut pairs = subtables.filter_map(|subtable| match subtable {
            PositioningSubtable::Pair(pairs) => kerning(&pairs, left, right),
            _ => None,
        });
        pairs.next().unwrap_or_default()
    }
}

fn kerning(pairs: &PairAdjustment, left: GlyphId, right: GlyphId) -> Option<i16> {
    let place = pairs.coverage().get(left)?;
    let (first, _) = match pairs {
        PairAdjustment::Format1 { sets, .. } => sets.get(place)?.get(right)?,
        PairAdjustment::Format2 { classes, matrix, .. } => matrix.get((classes.0.get(left), classes.1.get(right)))?,
    };
    Some(first.x_advance)
}

/// Takes the outlines of glyphs side by side.
struct Outline {
    path: PathBuilder,
    left: i32,
}

impl Outline {
    /// The frame in which a character stands that the font lacks: as high as a capital, its inside turned the other way
    /// round.
    fn draw_box(&mut self, advance: f32) {
        const SIDE: f32 = 0.1;
        const PEN: f32 = 0.07;
        let (left, right, top) = (SIDE * advance, (1.0 - SIDE) * advance, CAPITAL * UNITS_PER_EM);
        let pen = PEN * UNITS_PER_EM;
        let outer = [(left, 0.0), (right, 0.0), (right, top), (left, top)];
        let inner = [(left + pen, pen), (left + pen, top - pen), (right - pen, top - pen), (right - pen, pen)];
        for frame in [outer, inner] {
            self.move_to(frame[0].0, frame[0].1);
            frame[1..].iter().for_each(|&(x, y)| self.line_to(x, y));
            self.close();
        }
    }

    fn right(&self, x: f32) -> f32 {
        x + self.left as f32
    }
}

impl OutlineBuilder for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        self.path.move_to(self.right(x), y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.path.line_to(self.right(x), y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.path.quad_to(self.right(x1), y1, self.right(x), y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.path.cubic_to(self.right(x1), y1, self.right(x2), y2, self.right(x), y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn advance(font: &Font, c: char) -> f32 {
        font.face.glyph_hor_advance(font.face.glyph_index(c).expect("a glyph")).expect("an advance").into()
    }

    #[test]
    fn a_text_is_as_wide_as_its_letters() {
        let font = Font::new().expect("the font");
        let size = 10.0;
        let sum: f32 = "0.25 mm".chars().map(|c| advance(&font, c)).sum();
        assert!((font.width("0.25 mm", size) - sum * size / 2048.0).abs() < 1e-4);
        let apart: f32 = ['Y', 'a'].into_iter().map(|c| font.width(&c.to_string(), size)).sum();
        assert!(font.width("Ya", size) < 0.98 * apart, "a pair that is kerned");
    }

    #[test]
    fn outlines_stand_on_the_base_line_and_end_within_the_width() {
        let font = Font::new().expect("the font");
        let bounds = font.outline("HIH", 100.0).expect("outlines").bounds();
        assert!(bounds.bottom() == 0.0 && (bounds.top() + 100.0 * CAPITAL).abs() < 0.2, "{bounds:?}");
        let width = font.width("HIH", 100.0);
        assert!(0.0 < bounds.left() && 0.9 * width < bounds.right() && bounds.right() < width, "{bounds:?}");
        let bounds = font.outline("dpg", 100.0).expect("outlines").bounds();
        assert!((bounds.top() + 100.0 * ASCENT).abs() < 0.5 && bounds.bottom() <= 100.0 * DESCENT, "{bounds:?}");
        assert!(font.outline(" \n", 100.0).is_none());
    }

    #[test]
    fn a_box_stands_for_what_the_font_lacks() {
        let font = Font::new().expect("the font");
        assert_eq!(f32::from(font.face.units_per_em()), UNITS_PER_EM);
        assert!(font.has('a') && font.has('\n') && !font.has('纱'));
        let (one, two) = (font.outline("纱", 100.0).expect("a box"), font.outline("纱线", 100.0).expect("boxes"));
        let bounds = one.bounds();
        assert!(bounds.bottom() == 0.0 && (bounds.top() + 100.0 * CAPITAL).abs() < 0.2, "{bounds:?}");
        assert!(0.0 < bounds.left() && bounds.right() < font.width("纱", 100.0), "{bounds:?}");
        assert!(two.bounds().right() > 1.8 * bounds.right(), "{:?}", two.bounds());
    }

    #[test]
    fn the_font_has_what_the_pictures_write() {
        let font = Font::new().expect("the font");
        for c in "⁰¹²³⁴⁵⁶⁷⁸⁹⁻−–×·µσλεαβν|%°≤".chars() {
            assert!(font.face.glyph_index(c).is_some(), "{c}");
        }
    }
}
