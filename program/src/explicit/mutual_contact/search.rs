//! Which faces are near a point: columns of a grid over the two directions in which the bodies are largest.

use super::surface::Surface;
use crate::explicit::vector::{add, dot, minus, times};

/// The faces' centres, sorted into columns.
pub struct Grid {
    axes: [usize; 2],
    low: [f64; 2],
    /// How wide a column is, no less than the reach, and how many there are.
    width: [f64; 2],
    columns: [usize; 2],
    /// No point of a face is farther from its centre than this, less the margin.
    reach: f64,
    /// Where each column's entries begin, and their end.
    starts: Vec<u32>,
    entries: Vec<Entry>,
}

/// Faces of a body that are looked at for a point: at an edge the one whose centre is nearest may not be the one that is.
const FACES: usize = 3;

/// A face near a point, and the square of its centre's distance.
#[derive(Clone, Copy, Debug)]
pub struct Near {
    pub body: u32,
    pub face: u32,
    distance: f64,
}

#[derive(Clone, Copy, Default)]
struct Entry {
    centre: [f64; 3],
    body: u32,
    face: u32,
}

impl Grid {
    /// Of all faces that are there.
    pub fn new(surfaces: &[&Surface], margin: f64) -> Grid {
        let mut unsorted = Vec::new();
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        let mut largest: f64 = 0.0;
        for (body, surface) in surfaces.iter().enumerate() {
            for (face, corners) in surface.faces.iter().enumerate().filter(|&(face, _)| !surface.gone[face]) {
                let mut sum = [0.0; 3];
                for &corner in corners {
                    sum = add(sum, 1.0, surface.positions[corner as usize]);
                }
                let centre = times(0.25, sum);
                for &corner in corners {
                    let from = minus(surface.positions[corner as usize], centre);
                    largest = largest.max(dot(from, from));
                }
                for i in 0..3 {
                    (low[i], high[i]) = (low[i].min(centre[i]), high[i].max(centre[i]));
                }
                unsorted.push(Entry { centre, body: body as u32, face: face as u32 });
            }
        }
        let mut axes = [0, 1, 2];
        axes.sort_by(|&i, &j| (high[j] - low[j]).total_cmp(&(high[i] - low[i])));
        let axes = [axes[0], axes[1]];
        let reach = largest.sqrt() + margin;
        // No more columns than faces: a body that has been torn to pieces may be scattered far.
        let most = (unsorted.len() as f64).sqrt().ceil().max(1.0);
        let width = axes.map(|i| reach.max((high[i] - low[i]) / most));
        let columns = [0, 1].map(|k| ((high[axes[k]] - low[axes[k]]) / width[k]).max(0.0) as usize + 1);
        let low = axes.map(|i| low[i]);
        let mut grid = Grid { axes, low, width, columns, reach, starts: Vec::new(), entries: Vec::new() };
        grid.sort(&unsorted);
        grid
    }

    fn sort(&mut self, unsorted: &[Entry]) {
        let [columns, rows] = self.columns;
        self.starts = vec![0; columns * rows + 1];
        let column_of = |entry: &Entry| {
            let [x, y] = self.column(entry.centre);
            y * columns + x
        };
        let places: Vec<usize> = unsorted.iter().map(column_of).collect();
        for &place in &places {
            self.starts[place + 1] += 1;
        }
        for i in 0..columns * rows {
            self.starts[i + 1] += self.starts[i];
        }
        let mut next = self.starts.clone();
        self.entries = vec![Entry::default(); unsorted.len()];
        for (&place, &entry) in places.iter().zip(unsorted) {
            self.entries[next[place] as usize] = entry;
            next[place] += 1;
        }
    }

    fn column(&self, point: [f64; 3]) -> [usize; 2] {
        [self.along(point, 0), self.along(point, 1)]
    }

    #[inline(always)]
    fn along(&self, point: [f64; 3], k: usize) -> usize {
        let place = (point[self.axes[k]] - self.low[k]) / self.width[k];
        (place.max(0.0) as usize).min(self.columns[k] - 1)
    }

    /// The faces of other bodies whose centre is nearest to a point, [`FACES`] of each, those of a body one after another; bodies in
    /// their order.
    pub fn near(&self, own: usize, point: [f64; 3], found: &mut Vec<Near>) {
        found.clear();
        let [x, y] = self.column(point);
        for row in y.saturating_sub(1)..=(y + 1).min(self.columns[1] - 1) {
            let first = row * self.columns[0] + x.saturating_sub(1);
            let last = row * self.columns[0] + (x + 1).min(self.columns[0] - 1);
            for entry in &self.entries[self.starts[first] as usize..self.starts[last + 1] as usize] {
                let from = minus(entry.centre, point);
                let distance = dot(from, from);
                if entry.body as usize != own && distance <= self.reach * self.reach {
                    found.push(Near { body: entry.body, distance, face: entry.face });
                }
            }
        }
        found.sort_unstable_by(|a, b| {
            a.body.cmp(&b.body).then(a.distance.total_cmp(&b.distance)).then(a.face.cmp(&b.face))
        });
        let mut count = 0;
        found.dedup_by(|next, last| {
            count = if next.body == last.body { count + 1 } else { 0 };
            count >= FACES
        });
    }
}
