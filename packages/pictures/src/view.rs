//! A part of a plane and where a picture has it.

use super::style::fine;

#[derive(Clone, Copy, Debug)]
pub struct View {
    pub low: [f64; 2],
    pub high: [f64; 2],
    /// The picture's units in a unit of length, and where the picture has the lower left corner.
    pub scale: f64,
    pub corner: [f64; 2],
}

impl View {
    /// What a square of the picture shows of this part, in its middle; the place is the square's upper left corner.
    pub fn square([left, top]: [i32; 2], size: i32, low: [f64; 2], high: [f64; 2]) -> View {
        let [width, height] = [high[0] - low[0], high[1] - low[1]];
        let size = f64::from(size);
        let scale = size / width.max(height);
        let corner = [f64::from(left) + 0.5 * (size - scale * width), f64::from(top) + 0.5 * (size + scale * height)];
        View { low, high, scale, corner }
    }

    /// What a strip of the picture shows, as wide as this and as high as it takes.
    pub fn strip([left, top]: [i32; 2], width: i32, low: [f64; 2], high: [f64; 2]) -> View {
        let scale = f64::from(width) / (high[0] - low[0]);
        View { low, high, scale, corner: [f64::from(left), f64::from(top) + scale * (high[1] - low[1])] }
    }

    /// Width and height in the picture.
    pub fn size(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.scale * (self.high[axis] - self.low[axis]))
    }

    pub fn place(&self, [x, y]: [f64; 2]) -> (i32, i32) {
        let left = self.corner[0] + self.scale * (x - self.low[0]);
        let down = self.corner[1] - self.scale * (y - self.low[1]);
        ((left * f64::from(fine(1))).round() as i32, (down * f64::from(fine(1))).round() as i32)
    }
}
