//! Outlines written as the paths of an SVG file.

use std::fmt::Write;

use plotters_backend::BackendColor;
use tiny_skia::{Path, PathSegment, Point};

/// The parts of a unit that coordinates are rounded to.
const PARTS: f32 = 100.0;

/// An SVG file in the making.
pub struct Svg {
    text: String,
}

impl Svg {
    pub fn new([width, height]: [u32; 2]) -> Self {
        let text = format!(
            "<svg width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" xmlns=\"http://www.w3.org/2000/svg\">\n"
        );
        Svg { text }
    }

    pub fn fill(&mut self, path: &Path, colour: BackendColor) {
        let paint = format!("fill=\"{}\"", hex(colour));
        self.element(path, &paint, colour);
    }

    pub fn stroke(&mut self, path: &Path, colour: BackendColor, width: f32) {
        let width = decimal(parts(width));
        let paint = format!("fill=\"none\" stroke=\"{}\" stroke-width=\"{width}\"", hex(colour));
        self.element(path, &paint, colour);
    }

    /// A PNG at this place, of this width and height.
    pub fn image(&mut self, place: [f32; 2], size: [f32; 2], png: &[u8]) {
        let [x, y, width, height] = [place[0], place[1], size[0], size[1]].map(|length| decimal(parts(length)));
        let _ = write!(self.text, "<image x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"");
        let _ = writeln!(self.text, " href=\"data:image/png;base64,{}\"/>", base64(png));
    }

    /// The whole file.
    pub fn finish(&self) -> String {
        format!("{}</svg>\n", self.text)
    }

    fn element(&mut self, path: &Path, paint: &str, colour: BackendColor) {
        let _ = write!(self.text, "<path {paint}");
        if colour.alpha < 1.0 {
            let _ = write!(self.text, " opacity=\"{}\"", decimal(parts(colour.alpha as f32)));
        }
        let _ = writeln!(self.text, " d=\"{}\"/>", data(path));
    }
}

/// Bytes as text: six bits a letter, filled up to four letters.
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for chunk in bytes.chunks(3) {
        let bits = (0..3).fold(0, |bits, i| bits << 8 | u32::from(chunk.get(i).copied().unwrap_or(0)));
        for i in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * i) & 63) as usize];
            text.push(if i <= chunk.len() { char::from(letter) } else { '=' });
        }
    }
    text
}

fn hex(colour: BackendColor) -> String {
    let (red, green, blue) = colour.rgb;
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// The commands of a path, each relative to the point where the one before has ended: most numbers are short then.
///
/// Differences are those of rounded points, so that errors do not add up.
fn data(path: &Path) -> String {
    let mut pen = Pen { text: String::new(), place: [0; 2], command: ' ' };
    let mut start = pen.place;
    for segment in path.segments() {
        match segment {
            PathSegment::MoveTo(to) => {
                pen.draw('m', &[to]);
                start = pen.place;
            }
            PathSegment::LineTo(to) => pen.draw('l', &[to]),
            PathSegment::QuadTo(by, to) => pen.draw('q', &[by, to]),
            PathSegment::CubicTo(by, then, to) => pen.draw('c', &[by, then, to]),
            PathSegment::Close => {
                pen.draw('z', &[]);
                pen.place = start;
            }
        }
    }
    pen.text
}

struct Pen {
    text: String,
    place: [i64; 2],
    command: char,
}

impl Pen {
    fn draw(&mut self, command: char, points: &[Point]) {
        let mut separate = command == self.command;
        if !separate {
            self.text.push(command);
        }
        self.command = command;
        let mut last = self.place;
        for point in points {
            last = [parts(point.x), parts(point.y)];
            for (to, from) in last.into_iter().zip(self.place) {
                // A minus separates as well as a space.
                if separate && to >= from {
                    self.text.push(' ');
                }
                self.text.push_str(&decimal(to - from));
                separate = true;
            }
        }
        self.place = last;
    }
}

fn parts(length: f32) -> i64 {
    (length * PARTS).round() as i64
}

/// A number of hundredths, without trailing zeros.
fn decimal(hundredths: i64) -> String {
    let sign = if hundredths < 0 { "-" } else { "" };
    let [whole, rest] = [hundredths.abs() / 100, hundredths.abs() % 100];
    match (whole, rest) {
        (whole, 0) => format!("{sign}{whole}"),
        (0, rest) => format!("{sign}.{rest:02}").trim_end_matches('0').to_string(),
        (whole, rest) => format!("{sign}{whole}.{rest:02}").trim_end_matches('0').to_string(),
    }
}

#[cfg(test)]
mod tests {
    use tiny_skia::PathBuilder;

    use super::*;

    #[test]
    fn numbers_are_short() {
        let written = [0, 5, -5, 10, 100, -120, 1005, -300].map(decimal);
        assert_eq!(written, ["0", ".05", "-.05", ".1", "1", "-1.2", "10.05", "-3"]);
    }

    #[test]
    fn bytes_are_four_letters_for_three() {
        let written = ["", "f", "fo", "foo", "foobar"].map(|text| base64(text.as_bytes()));
        assert_eq!(written, ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYmFy"]);
    }

    #[test]
    fn a_path_is_relative_and_ends_where_it_should() {
        let mut path = PathBuilder::new();
        path.move_to(1.0, 2.0);
        path.line_to(4.0, 2.0);
        path.line_to(3.996, 0.5);
        path.close();
        path.move_to(1.5, 2.0);
        path.quad_to(2.0, 3.0, 1.25, 4.0);
        let path = path.finish().expect("a path");
        assert_eq!(data(&path), "m1 2l3 0 0-1.5zm.5 0q.5 1-.25 2");
    }

    #[test]
    fn rounding_does_not_add_up() {
        let mut path = PathBuilder::new();
        path.move_to(0.0, 0.0);
        for step in 1..=300 {
            path.line_to(step as f32 / 3.0, 0.0);
        }
        let data = data(&path.finish().expect("a path"));
        let steps: Vec<f64> = data.split(['m', 'l', ' ']).skip(3).step_by(2).filter_map(|n| n.parse().ok()).collect();
        assert_eq!(steps.len(), 300);
        assert!((steps.iter().sum::<f64>() - 100.0).abs() < 1e-9);
    }
}
