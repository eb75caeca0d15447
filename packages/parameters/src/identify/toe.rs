//! Where a tensile test begins to bear: the toe in which the yarn's slack and the fibres' waviness are taken up (the
//! slack compensation of ASTM D885), by a change point.
//!
//! Up to a place c the curve is a parabola that starts without slope, beyond it the law's own curve from a zero z: the
//! force of fibres whose slack is spread evenly from 2z − c to c. Of all c that one is taken whose squares are least; z
//! and the stiffness are then those of the points beyond c alone, so that the toe's own shape does not count.

use nalgebra::{Matrix2, Vector2};

/// The change point is sought among at most so many points of a curve.
const SEARCHED: usize = 100;
/// There is no toe of fewer points, and no line of fewer.
const LEAST_TOE: usize = 3;
const LEAST_LINE: usize = 6;
/// Beyond a toe lies this part of the points at least.
const LEAST_BEYOND: f64 = 0.3;
/// In a toe the yarn bears less than this part of what it would without slack.
const SLACK: f64 = 0.7;
/// A toe has to explain so much: the F statistic of its two parameters. By chance it stays below 10 in all but one of a
/// thousand curves, and the change point is the best of many.
const CERTAIN: f64 = 25.0;
/// Iterations of Gauss and Newton: the law's curve is nearly straight.
const ITERATIONS: usize = 5;
/// The step of differences, over the largest abscissa.
const STEP: f64 = 1e-5;

/// Where the curve begins, and up to where it is a toe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    pub zero: f64,
    /// Its standard deviation.
    pub deviation: f64,
    pub end: f64,
}

/// A curve: distances from the file's own rest, what is measured there and its standard deviations where they are
/// known.
pub struct Curve<'a, S: Fn(f64) -> f64> {
    pub x: &'a [f64],
    pub y: &'a [f64],
    pub deviations: Option<&'a [f64]>,
    /// The law's answer at a distance from rest, with a stiffness of 1.
    pub shape: S,
}

/// Stiffness and zero of a part of the curve, with their squares and the inverse of their normal equations.
struct Line {
    stiffness: f64,
    zero: f64,
    squares: f64,
    inverse: Matrix2<f64>,
}

impl<S: Fn(f64) -> f64> Curve<'_, S> {
    /// The toe, if the curve has one beyond doubt.
    pub fn toe(&self) -> Option<Found> {
        let mut order: Vec<usize> = (0..self.x.len()).collect();
        order.sort_by(|&a, &b| self.x[a].total_cmp(&self.x[b]));
        let stride = order.len().div_ceil(SEARCHED).max(1);
        let some: Vec<usize> = order.iter().copied().step_by(stride).collect();
        let beyond = LEAST_LINE.max((LEAST_BEYOND * some.len() as f64) as usize);
        let ends = LEAST_TOE..(some.len() + 1).saturating_sub(beyond);
        let trial = |first: usize| {
            let line = self.line(&some[first..])?;
            let squares = line.squares + self.toe_squares(&some[..first], &line, self.x[some[first]]);
            squares.is_finite().then_some((first, squares))
        };
        let (first, squares) = ends.filter_map(trial).min_by(|a, b| a.1.total_cmp(&b.1))?;
        let end = self.x[some[first]];
        let (toe, rest): (Vec<usize>, Vec<usize>) = order.iter().partition(|&&i| self.x[i] < end);
        let line = self.line(&rest)?;
        let certain = self.straight_squares(&some) - squares > 2.0 * CERTAIN * squares / (some.len() - 3) as f64;
        let borne: f64 = toe.iter().map(|&i| self.y[i]).sum();
        let unslack: f64 = toe.iter().map(|&i| line.stiffness * (self.shape)(self.x[i].max(0.0))).sum();
        if !(certain && borne < SLACK * unslack && line.zero > 0.0 && line.stiffness > 0.0) {
            return None;
        }
        let noise = if self.deviations.is_some() { 1.0 } else { line.squares / (rest.len() - 2) as f64 };
        Some(Found { zero: line.zero, deviation: (noise * line.inverse.m22).sqrt(), end: end.max(line.zero) })
    }

    fn weight(&self, i: usize) -> f64 {
        self.deviations.map_or(1.0, |deviations| deviations[i].powi(-2))
    }

    /// The law's answer and its slope, continued straight on below rest.
    fn answer(&self, distance: f64, step: f64) -> [f64; 2] {
        let at = distance.max(0.0);
        let value = (self.shape)(at);
        let slope = ((self.shape)(at + step) - value) / step;
        [value + slope * (distance - at), slope]
    }

    /// The least squares of k g(x − z) over some points.
    fn line(&self, points: &[usize]) -> Option<Line> {
        let step = STEP * points.iter().map(|&i| self.x[i]).fold(0.0, f64::max);
        let mut zero = 0.0;
        let mut line = None;
        for _ in 0..ITERATIONS {
            // The stiffness follows from the zero; the step is that of both.
            let terms = |&i: &usize| (self.weight(i), self.answer(self.x[i] - zero, step), self.y[i]);
            let terms: Vec<(f64, [f64; 2], f64)> = points.iter().map(terms).collect();
            let [above, below] = terms.iter().fold([0.0; 2], |[a, b], (w, [g, _], y)| [a + w * g * y, b + w * g * g]);
            let stiffness = above / below;
            let (mut normal, mut right, mut squares) = (Matrix2::zeros(), Vector2::zeros(), 0.0);
            for (weight, [value, slope], y) in terms {
                let (row, residual) = (Vector2::new(value, -stiffness * slope), y - stiffness * value);
                normal += weight * row * row.transpose();
                right += weight * row * residual;
                squares += weight * residual * residual;
            }
            let inverse = normal.try_inverse()?;
            line = Some(Line { stiffness, zero, squares, inverse });
            zero += (inverse * right).y;
        }
        line.filter(|line| line.squares.is_finite())
    }

    /// The squares of the parabola up to `end` that meets the line there.
    fn toe_squares(&self, points: &[usize], line: &Line, end: f64) -> f64 {
        let start = 2.0 * line.zero - end;
        let height = line.stiffness * (self.shape)((end - line.zero).max(0.0));
        let squares = points.iter().map(|&i| {
            let part = if start < end { ((self.x[i] - start) / (end - start)).max(0.0) } else { 0.0 };
            self.weight(i) * (self.y[i] - height * part * part).powi(2)
        });
        squares.sum()
    }

    /// The squares without slack.
    fn straight_squares(&self, points: &[usize]) -> f64 {
        let terms: Vec<[f64; 3]> =
            points.iter().map(|&i| [self.weight(i), (self.shape)(self.x[i].max(0.0)), self.y[i]]).collect();
        let sum = |of: fn(&[f64; 3]) -> f64| terms.iter().map(of).sum::<f64>();
        let stiffness = sum(|[w, g, y]| w * g * y) / sum(|[w, g, _]| w * g * g);
        terms.iter().map(|[w, g, y]| w * (y - stiffness * g).powi(2)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Nearly that of the law's nominal stress.
    fn shape(strain: f64) -> f64 {
        strain.ln_1p() / (1.0 + strain)
    }

    fn found(of: impl Fn(f64) -> f64, noise: f64, seed: u64) -> Option<Found> {
        let mut random = fastrand::Rng::with_seed(seed);
        let x: Vec<f64> = (1..=60).map(|i| 0.0006 * f64::from(i)).collect();
        let gauss = |random: &mut fastrand::Rng| (0..12).map(|_| random.f64() - 0.5).sum::<f64>();
        let y: Vec<f64> = x.iter().map(|&x| of(x) + noise * gauss(&mut random)).collect();
        Curve { x: &x, y: &y, deviations: None, shape }.toe()
    }

    #[test]
    fn a_toe_is_found_with_its_deviation() {
        // Without force up to 0.5 %; and straightened bit by bit from 0.2 to 0.8 %.
        let slack = |x: f64| 100.0 * shape((x - 0.005).max(0.0));
        let wavy = |x: f64| (0..60).map(|i| 100.0 / 60.0 * shape((x - 0.00205 - 0.0001 * f64::from(i)).max(0.0))).sum();
        for curve in [&slack as &dyn Fn(f64) -> f64, &wavy] {
            let mut squares = 0.0;
            for seed in 0..200 {
                let found = found(curve, 0.01, seed).expect("a toe");
                squares += ((found.zero - 0.005) / found.deviation).powi(2) / 200.0;
                assert!(found.end > 0.004 && found.end < 0.012, "{found:?}");
            }
            // The mean square of a standard normal, but for what the choice of the change point adds.
            assert!((0.6..2.0).contains(&squares), "{squares}");
        }
    }

    #[test]
    fn there_is_no_toe_where_there_is_none() {
        for seed in 0..200 {
            assert_eq!(found(|x| 100.0 * shape(x), 0.03, seed), None);
            // Stiffer at the end than the law, and softer.
            assert_eq!(found(|x| 100.0 * x, 0.01, seed), None);
            assert_eq!(found(|x| 100.0 * shape(x) * (1.0 - 3.0 * x), 0.01, seed), None);
        }
    }
}
