//! Which faces are near a point: columns of a grid over the two directions in which the bodies are largest.

use super::surface::Surface;
use crate::vector::{add, dot, minus, times};

/// The faces' centres, sorted into columns.
pub struct Grid {
    axes: [usize; 2],
    low: [f64; 2],
    /// How wide a column is, and how many there are.
    width: [f64; 2],
    columns: [usize; 2],
    /// Where each column's entries begin, and their end.
    starts: Vec<u32>,
    entries: Vec<Entry>,
}

/// Faces of a body that are looked at for a point: at an edge the one whose centre is nearest may not be the one that
/// is.
const FACES: usize = 3;
/// Columns are as wide as this many times the mean reach of a face. Torn yarns have faces that are drawn out far: those
/// are entered in several columns, and do not make all columns wide.
const ORDINARY: f64 = 1.5;

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
    /// No point of the face is farther from its centre than this, less the margin.
    reach: f64,
    body: u32,
    face: u32,
}

impl Grid {
    /// Of all faces of these bodies that are there.
    pub fn new(surfaces: &[Surface], of: impl Fn(usize) -> bool, margin: f64) -> Grid {
        let mut unsorted = Vec::new();
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        let mut sum_of_reaches = 0.0;
        for (body, surface) in surfaces.iter().enumerate().filter(|&(body, _)| of(body)) {
            for (face, corners) in surface.faces.iter().enumerate().filter(|&(face, _)| !surface.state.gone[face]) {
                let mut sum = [0.0; 3];
                for &corner in corners {
                    sum = add(sum, 1.0, surface.state.points[corner as usize].position);
                }
                let centre = times(0.25, sum);
                let mut farthest: f64 = 0.0;
                for &corner in corners {
                    let from = minus(surface.state.points[corner as usize].position, centre);
                    farthest = farthest.max(dot(from, from));
                }
                let reach = farthest.sqrt() + margin;
                sum_of_reaches += reach;
                for i in 0..3 {
                    (low[i], high[i]) = (low[i].min(centre[i]), high[i].max(centre[i]));
                }
                unsorted.push(Entry { centre, reach, body: body as u32, face: face as u32 });
            }
        }
        let mut axes = [0, 1, 2];
        axes.sort_by(|&i, &j| (high[j] - low[j]).total_cmp(&(high[i] - low[i])));
        let axes = [axes[0], axes[1]];
        let ordinary = ORDINARY * sum_of_reaches / unsorted.len().max(1) as f64;
        // No more columns than faces: a body that has been torn to pieces may be scattered far.
        let most = (unsorted.len() as f64).sqrt().ceil().max(1.0);
        let width = axes.map(|i| ordinary.max((high[i] - low[i]) / most));
        let columns = [0, 1].map(|k| ((high[axes[k]] - low[axes[k]]) / width[k]).max(0.0) as usize + 1);
        let low = axes.map(|i| low[i]);
        let mut grid = Grid { axes, low, width, columns, starts: Vec::new(), entries: Vec::new() };
        grid.sort(&unsorted);
        grid
    }

    fn sort(&mut self, unsorted: &[Entry]) {
        let [columns, rows] = self.columns;
        let places = |[x, y]: [[usize; 2]; 2]| {
            (y[0]..=y[1]).flat_map(move |row| (x[0]..=x[1]).map(move |column| row * columns + column))
        };
        let spans: Vec<[[usize; 2]; 2]> = unsorted.iter().map(|entry| self.span(entry)).collect();
        self.starts = vec![0; columns * rows + 1];
        for place in spans.iter().flat_map(|&span| places(span)) {
            self.starts[place + 1] += 1;
        }
        for i in 0..columns * rows {
            self.starts[i + 1] += self.starts[i];
        }
        let mut next = self.starts.clone();
        self.entries = vec![Entry::default(); self.starts[columns * rows] as usize];
        for (&span, &entry) in spans.iter().zip(unsorted) {
            for place in places(span) {
                self.entries[next[place] as usize] = entry;
                next[place] += 1;
            }
        }
    }

    /// The columns in which a face is entered: so many that a point in its reach is in one of them, or in one next to
    /// them.
    fn span(&self, entry: &Entry) -> [[usize; 2]; 2] {
        [0, 1].map(|k| {
            let beyond = (entry.reach - self.width[k]).max(0.0);
            let place = entry.centre[self.axes[k]];
            [self.along(place - beyond, k), self.along(place + beyond, k)]
        })
    }

    #[inline(always)]
    fn along(&self, place: f64, k: usize) -> usize {
        let column = (place - self.low[k]) / self.width[k];
        (column.max(0.0) as usize).min(self.columns[k] - 1)
    }

    /// The faces of other bodies whose centre is nearest to a point, [`FACES`] of each, those of a body one after
    /// another; bodies in their order.
    pub fn near(&self, own: usize, point: [f64; 3], found: &mut Vec<Near>) {
        found.clear();
        let [x, y] = [0, 1].map(|k| self.along(point[self.axes[k]], k));
        for row in y.saturating_sub(1)..=(y + 1).min(self.columns[1] - 1) {
            let first = row * self.columns[0] + x.saturating_sub(1);
            let last = row * self.columns[0] + (x + 1).min(self.columns[0] - 1);
            for entry in &self.entries[self.starts[first] as usize..self.starts[last + 1] as usize] {
                let from = minus(entry.centre, point);
                let distance = dot(from, from);
                if entry.body as usize != own && distance <= entry.reach * entry.reach {
                    insert(Near { body: entry.body, distance, face: entry.face }, found);
                }
            }
        }
    }
}

/// Puts a face in its place by body, distance and number, if it is one of the [`FACES`] nearest ones of its body.
#[inline(always)]
fn insert(near: Near, found: &mut Vec<Near>) {
    let start = found.iter().position(|other| other.body >= near.body).unwrap_or(found.len());
    let end = start + found[start..].iter().take_while(|other| other.body == near.body).count();
    let is_before = |other: &&Near| other.distance.total_cmp(&near.distance).then(other.face.cmp(&near.face)).is_lt();
    let place = start + found[start..end].iter().take_while(is_before).count();
    // A face may be in several columns.
    if place == start + FACES || place < end && found[place].face == near.face {
        return;
    }
    if end == start + FACES {
        found.remove(end - 1);
    }
    found.insert(place, near);
}
