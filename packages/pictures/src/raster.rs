//! A view as dots, of which each shows what is highest there: for far more faces than an SVG could have outlines.

use plotters::element::{Drawable, PointCollection};
use plotters_backend::{BackendCoord, DrawingBackend, DrawingErrorKind};

use super::page::{Area, Drawn};
use super::sheet::PNG_SCALE;
use super::style::fine;
use super::view::View;

/// Each dot of the picture is the mean of so many samples in either direction.
const SAMPLES: usize = 3;

/// A view in the making, white where nothing is.
pub struct Raster {
    view: View,
    /// Dots in a unit of length, and of the picture.
    scale: f64,
    size: [usize; 2],
    /// Height and colour of each sample.
    samples: Vec<(f32, [u8; 3])>,
}

impl Raster {
    pub fn new(view: View) -> Raster {
        let size = view.size().map(|length| (length * f64::from(PNG_SCALE)).round().max(1.0) as usize);
        let samples = vec![(f32::NEG_INFINITY, [255; 3]); size[0] * size[1] * SAMPLES * SAMPLES];
        Raster { view, scale: view.scale * f64::from(PNG_SCALE) * SAMPLES as f64, size, samples }
    }

    /// A quadrangle as two triangles.
    pub fn quadrangle(&mut self, corners: &[[f64; 3]; 4], colour: [u8; 3]) {
        let [a, b, c, d] =
            corners.map(|[x, y, z]| [(x - self.view.low[0]) * self.scale, (self.view.high[1] - y) * self.scale, z]);
        self.triangle([a, b, c], colour);
        self.triangle([a, c, d], colour);
    }

    fn triangle(&mut self, corners: [[f64; 3]; 3], colour: [u8; 3]) {
        let [a, b, c] = corners;
        let twice = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        if twice == 0.0 || !twice.is_finite() {
            return;
        }
        // The samples whose middles lie between the bounds.
        let range = |axis: usize| {
            let values = corners.map(|corner| corner[axis]);
            let low = values.iter().copied().fold(f64::INFINITY, f64::min);
            let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let first = (low - 0.5).ceil().max(0.0) as usize;
            first..((high + 0.5).floor().max(0.0) as usize).min(self.size[axis] * SAMPLES)
        };
        let (columns, rows) = (range(0), range(1));
        for row in rows {
            for column in columns.clone() {
                let [x, y] = [column, row].map(|i| i as f64 + 0.5);
                let part = |p: [f64; 3], q: [f64; 3]| ((p[0] - x) * (q[1] - y) - (q[0] - x) * (p[1] - y)) / twice;
                let parts = [part(b, c), part(c, a), part(a, b)];
                // A line between two triangles belongs to both, so that nothing shines through.
                if parts.iter().any(|&part| part < -1e-9) {
                    continue;
                }
                let height = (parts[0] * a[2] + parts[1] * b[2] + parts[2] * c[2]) as f32;
                let sample = &mut self.samples[row * self.size[0] * SAMPLES + column];
                if height > sample.0 {
                    *sample = (height, colour);
                }
            }
        }
    }

    /// Draws what has been collected.
    pub fn draw(self, area: &Area) -> Drawn<()> {
        let [left, bottom] = self.view.corner;
        let top = bottom - self.view.size()[1];
        let place = [left, top].map(|length| (length * f64::from(fine(1))).round() as i32);
        let width = self.size[0] * SAMPLES;
        let mut dots = Vec::with_capacity(3 * self.size[0] * self.size[1]);
        for dot in 0..self.size[0] * self.size[1] {
            let first = dot / self.size[0] * SAMPLES * width + dot % self.size[0] * SAMPLES;
            let samples = (0..SAMPLES * SAMPLES).map(|i| self.samples[first + i / SAMPLES * width + i % SAMPLES].1);
            let sums =
                samples.fold([0; 3], |sums: [usize; 3], colour| [0, 1, 2].map(|i| sums[i] + usize::from(colour[i])));
            dots.extend(sums.map(|sum| (sum / (SAMPLES * SAMPLES)) as u8));
        }
        area.draw(&Bitmap { place: (place[0], place[1]), size: self.size.map(|length| length as u32), dots })?;
        Ok(())
    }
}

/// Dots of the PNG, row by row from above, red, green and blue.
struct Bitmap {
    place: BackendCoord,
    size: [u32; 2],
    dots: Vec<u8>,
}

impl<'a> PointCollection<'a, BackendCoord> for &'a Bitmap {
    type Point = &'a BackendCoord;
    type IntoIter = std::iter::Once<&'a BackendCoord>;

    fn point_iter(self) -> Self::IntoIter {
        std::iter::once(&self.place)
    }
}

impl<B: DrawingBackend> Drawable<B> for Bitmap {
    fn draw<I: Iterator<Item = BackendCoord>>(
        &self,
        mut places: I,
        backend: &mut B,
        _: (u32, u32),
    ) -> Result<(), DrawingErrorKind<B::ErrorType>> {
        let Some(place) = places.next() else { return Ok(()) };
        backend.blit_bitmap(place, (self.size[0], self.size[1]), &self.dots)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_highest_is_seen_whatever_comes_first() {
        let view = View { low: [0.0; 2], high: [2.0, 1.0], scale: 4.0, corner: [0.0, 4.0] };
        let square = |left: f64, height: f64| {
            [[left, 0.0, height], [left + 1.0, 0.0, height], [left + 1.0, 1.0, height], [left, 1.0, height]]
        };
        for low_first in [true, false] {
            let mut raster = Raster::new(view);
            let mut squares = [(square(0.0, 0.0), [1; 3]), (square(0.5, 1.0), [2; 3])];
            if !low_first {
                squares.reverse();
            }
            for (corners, colour) in squares {
                raster.quadrangle(&corners, colour);
            }
            let (width, height) = (raster.size[0] * SAMPLES, raster.size[1] * SAMPLES);
            let row = &raster.samples[height / 2 * width..][..width];
            let seen: Vec<u8> =
                [0.1, 0.4, 0.6, 0.9, 1.4, 1.6].map(|x| row[(0.5 * x * width as f64) as usize].1[0]).to_vec();
            assert_eq!(seen, [1, 1, 2, 2, 2, 255]);
        }
    }
}
