//! Boxes found by where they are, seen from above.

pub type Bounds = [[f64; 3]; 2];

/// The box around these points.
pub fn around(points: impl IntoIterator<Item = [f64; 3]>) -> Bounds {
    let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for point in points {
        for axis in 0..3 {
            bounds[0][axis] = bounds[0][axis].min(point[axis]);
            bounds[1][axis] = bounds[1][axis].max(point[axis]);
        }
    }
    bounds
}

/// A grid of bins over x and y, each with the boxes that reach into it.
pub struct Bins {
    boxes: Vec<Bounds>,
    low: [f64; 2],
    size: [f64; 2],
    counts: [usize; 2],
    /// Where the boxes of each bin begin, and their numbers.
    starts: Vec<usize>,
    numbers: Vec<u32>,
}

/// No more bins than this along an axis.
const MOST: f64 = 2048.0;

impl Bins {
    pub fn new(boxes: Vec<Bounds>) -> Bins {
        let [low, high] = around(boxes.iter().flatten().copied());
        let mean =
            |axis: usize| boxes.iter().map(|[low, high]| high[axis] - low[axis]).sum::<f64>() / boxes.len() as f64;
        let size = [0, 1].map(|axis| mean(axis).max((high[axis] - low[axis]) / MOST).max(f64::MIN_POSITIVE));
        let counts = [0, 1].map(|axis| ((high[axis] - low[axis]) / size[axis]) as usize + 1);
        let mut bins = Bins { boxes, low: [low[0], low[1]], size, counts, starts: Vec::new(), numbers: Vec::new() };
        let mut all: Vec<(usize, u32)> = Vec::new();
        for number in 0..bins.boxes.len() {
            bins.reached(&bins.boxes[number]).for_each(|bin| all.push((bin, number as u32)));
        }
        all.sort_unstable();
        bins.starts = (0..=counts[0] * counts[1]).map(|bin| all.partition_point(|&(other, _)| other < bin)).collect();
        bins.numbers = all.into_iter().map(|(_, number)| number).collect();
        bins
    }

    fn reached(&self, [low, high]: &Bounds) -> impl Iterator<Item = usize> + use<> {
        let bin = |x: f64, axis: usize| {
            (((x - self.low[axis]) / self.size[axis]).max(0.0) as usize).min(self.counts[axis] - 1)
        };
        let [columns, rows] = [0, 1].map(|axis| bin(low[axis], axis)..bin(high[axis], axis) + 1);
        let count = self.counts[0];
        rows.flat_map(move |row| columns.clone().map(move |column| row * count + column))
    }

    /// The boxes that meet this one, some of them more than once.
    pub fn near<'a>(&'a self, bounds: &'a Bounds) -> impl Iterator<Item = usize> + 'a {
        let meets = |number: &usize| {
            let [low, high] = &self.boxes[*number];
            (0..3).all(|axis| low[axis] <= bounds[1][axis] && bounds[0][axis] <= high[axis])
        };
        let bins = self.reached(bounds);
        bins.flat_map(|bin| &self.numbers[self.starts[bin]..self.starts[bin + 1]]).map(|&n| n as usize).filter(meets)
    }
}
