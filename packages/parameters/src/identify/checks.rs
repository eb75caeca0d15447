//! Whether a measured curve can be what it is said to be: it rises from rest, and what is pressed or pulled resists.

/// A curve falls, or is negative, where it does by more than this many times its noise: by chance that does not happen.
const SURE: f64 = 8.0;
/// From this number of points on the noise can be read off a curve.
const ENOUGH: usize = 20;
/// With fewer points it is taken for this at least, over the largest value; without noise, for that.
const FEW: f64 = 0.1;
const EXACT: f64 = 1e-6;
/// A way back that is this much beside the way out, over the largest value, is another way.
const HYSTERESIS: f64 = 0.03;
/// A way out has so many points, and goes so far of all of them.
const LEAST_WAY: usize = 3;
const FAR_OUT: f64 = 0.3;
/// A way back is no noise of the abscissae: it goes back by this part of the largest.
const LEAST_BACK: f64 = 0.05;
/// The standard deviation of normally distributed numbers over the median of their sizes.
const NORMAL: f64 = 1.4826;

/// What is wrong with a curve, at the index of a point.
#[derive(Clone, Debug, PartialEq)]
pub enum Flaw {
    Negative(usize),
    /// The point and the earlier one that it is far below.
    Falls(usize, usize),
    /// The file turns back before this point and comes back off the way it went.
    Unloads(usize),
}

/// The first flaw of a curve over the distance from rest; `noise` is its standard deviation where that is known.
pub fn flaw(distances: &[f64], values: &[f64], noise: Option<f64>) -> Option<Flaw> {
    if let Some(point) = unloading(distances, values) {
        return Some(Flaw::Unloads(point));
    }
    let flaw = of_order(distances, values, noise)?;
    // The way out has none: what comes after it is to blame, wherever it lies beside it.
    match turn(distances) {
        Some(turn) if of_order(&distances[..turn], &values[..turn], noise).is_none() => Some(Flaw::Unloads(turn)),
        _ => Some(flaw),
    }
}

/// The first point with which a file that has gone out step by step goes back.
fn turn(distances: &[f64]) -> Option<usize> {
    let turn = 1 + distances.windows(2).position(|pair| pair[1] < pair[0])?;
    let largest = distances.iter().copied().fold(0.0, f64::max);
    // A file that is in another order, or whose abscissae are noisy, goes back at once.
    (turn >= LEAST_WAY && distances[turn - 1] > FAR_OUT * largest).then_some(turn)
}

/// The first flaw of the points by their distance.
fn of_order(distances: &[f64], values: &[f64], noise: Option<f64>) -> Option<Flaw> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| distances[a].total_cmp(&distances[b]));
    let largest = values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    let few = if values.len() < ENOUGH { FEW * largest } else { 0.0 };
    let rough = few.max(SURE * roughness(distances, values, &order));
    let tolerance = noise.map_or(rough, |noise| SURE * noise).max(EXACT * largest);
    let mut highest = *order.first()?;
    for &point in &order {
        if values[point] < -tolerance {
            return Some(Flaw::Negative(point));
        }
        if values[point] < values[highest] - tolerance {
            return Some(Flaw::Falls(point, highest));
        }
        if values[point] > values[highest] {
            highest = point;
        }
    }
    // However large the noise, the whole may not fall.
    let (first, last) = (order[0], order[order.len() - 1]);
    (values.len() > 2 && slope(distances, values) < 0.0).then_some(Flaw::Falls(last, first))
}

/// Where a file that goes out and comes back, in its own order, comes back beside the way it went: by more than a share
/// of the largest value, in the mean. Points in any other order are no path.
fn unloading(distances: &[f64], values: &[f64]) -> Option<usize> {
    let turn = turn(distances)?;
    let falls = distances[turn..].windows(2).take_while(|pair| pair[1] <= pair[0]).count();
    let back = turn..turn + 1 + falls;
    let largest = |values: &[f64]| values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    if distances[turn - 1] - distances[back.end - 1] < LEAST_BACK * largest(distances) || back.len() < 2 {
        return None;
    }
    let beside = back.clone().map(|i| out(&distances[..turn], &values[..turn], distances[i]) - values[i]);
    (beside.sum::<f64>().abs() > HYSTERESIS * largest(values) * back.len() as f64).then_some(turn)
}

/// The value on the way out at a distance.
fn out(distances: &[f64], values: &[f64], at: f64) -> f64 {
    let after = distances.partition_point(|&distance| distance < at).clamp(1, distances.len() - 1);
    let (from, to) = (distances[after - 1], distances[after]);
    let part = if to > from { (at - from) / (to - from) } else { 1.0 };
    values[after - 1] + part * (values[after] - values[after - 1])
}

/// The sign of the line through the points.
fn slope(distances: &[f64], values: &[f64]) -> f64 {
    let mean = |of: &[f64]| of.iter().sum::<f64>() / of.len() as f64;
    let (x, y) = (mean(distances), mean(values));
    distances.iter().zip(values).map(|(a, b)| (a - x) * (b - y)).sum()
}

/// The noise of a curve: how far its points are off the line between their neighbours.
fn roughness(distances: &[f64], values: &[f64], order: &[usize]) -> f64 {
    let deviation = |three: &[usize]| {
        let [x, y, z] = [0, 1, 2].map(|i| distances[three[i]]);
        let part = if z > x { (y - x) / (z - x) } else { 0.5 };
        let between = (1.0 - part) * values[three[0]] + part * values[three[2]];
        (values[three[1]] - between).abs() / (1.0 + part * part + (1.0 - part) * (1.0 - part)).sqrt()
    };
    let mut deviations: Vec<f64> = order.windows(3).map(deviation).collect();
    deviations.sort_by(f64::total_cmp);
    deviations.get(deviations.len() / 2).map_or(0.0, |median| NORMAL * median)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(n: usize, of: impl Fn(f64) -> f64) -> (Vec<f64>, Vec<f64>) {
        let distances: Vec<f64> = (1..=n).map(|i| i as f64 / n as f64).collect();
        let values = distances.iter().map(|&x| of(x)).collect();
        (distances, values)
    }

    #[test]
    fn a_rising_curve_has_no_flaw_with_or_without_noise() {
        let (x, y) = curve(40, |x| x.powf(2.2));
        assert_eq!(flaw(&x, &y, None), None);
        let mut random = fastrand::Rng::with_seed(1);
        for _ in 0..2000 {
            let noisy: Vec<f64> =
                y.iter().map(|y| y + 0.02 * (0..12).map(|_| random.f64() - 0.5).sum::<f64>()).collect();
            assert_eq!(flaw(&x, &noisy, None), None);
            assert_eq!(flaw(&x, &noisy, Some(0.02)), None);
        }
    }

    #[test]
    fn a_curve_that_falls_or_is_negative_is_named() {
        let (x, y) = curve(40, |x| if x < 0.6 { x } else { 1.2 - x });
        assert!(matches!(flaw(&x, &y, None), Some(Flaw::Falls(later, 23)) if later > 23));
        let (x, y) = curve(40, |x| -x);
        assert_eq!(flaw(&x, &y, None), Some(Flaw::Negative(0)));
        let (x, y) = curve(3, |x| 1.0 - x);
        assert!(matches!(flaw(&x, &y, None), Some(Flaw::Falls(1, 0))));
        assert_eq!(flaw(&[1.0, 2.0, 3.0], &[5.0, 4.9, 4.8], None), Some(Flaw::Falls(2, 0)));
        assert_eq!(flaw(&[], &[], None), None);
    }

    #[test]
    fn a_curve_that_comes_back_below_is_named_where_it_turns() {
        let (mut x, mut y) = curve(20, |x| x.powf(2.2));
        let back: Vec<f64> = x.iter().rev().skip(1).copied().collect();
        y.extend(back.iter().map(|x| 0.6 * x.powf(2.2)));
        x.extend(&back);
        assert_eq!(flaw(&x, &y, None), Some(Flaw::Unloads(20)));
        // Back above the way out, and out, half back and out again: the turn is named, not a point of the way out.
        let above: Vec<f64> = y.iter().enumerate().map(|(i, y)| if i < 20 { *y } else { 3.0 * y + 0.05 }).collect();
        assert_eq!(flaw(&x, &above, None), Some(Flaw::Unloads(20)));
        let again = |of: &[f64]| [&of[..30], &of[10..20]].concat();
        assert_eq!(flaw(&again(&x), &again(&above), None), Some(Flaw::Unloads(20)));
        // There and back on the same way is elastic.
        let elastic: Vec<f64> = x.iter().map(|x| x.powf(2.2)).collect();
        assert_eq!(flaw(&x, &elastic, None), None);
    }
}
