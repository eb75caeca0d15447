//! A one-dimensional search: the largest value of a function.

/// The golden section, after which a bracket has that part of its length.
pub const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// A bracket of so little of what it began with is a point: a function is flat there, as far as its digits go.
const NARROW: f64 = 1e-9;

/// Where a function that rises and then falls between two places is largest, and that value; an end counts as any other
/// place.
pub fn maximum(mut of: impl FnMut(f64) -> f64, [low, high]: [f64; 2]) -> (f64, f64) {
    let (mut left, mut right) = (low, high);
    let mut inner = [right - GOLDEN * (right - left), left + GOLDEN * (right - left)];
    let mut values = inner.map(&mut of);
    // Numbers themselves are no narrower.
    let narrow = (NARROW * (high - low)).max(4.0 * f64::EPSILON * low.abs().max(high.abs()));
    while right - left > narrow {
        if values[0] < values[1] {
            left = inner[0];
            (inner[0], values[0]) = (inner[1], values[1]);
            inner[1] = left + GOLDEN * (right - left);
            values[1] = of(inner[1]);
        } else {
            right = inner[1];
            (inner[1], values[1]) = (inner[0], values[0]);
            inner[0] = right - GOLDEN * (right - left);
            values[0] = of(inner[0]);
        }
    }
    let middle = 0.5 * (left + right);
    [low, middle, high]
        .map(|place| (place, of(place)))
        .into_iter()
        .fold((low, f64::NEG_INFINITY), |best, found| if found.1 > best.1 { found } else { best })
}

/// Steps of Newton's at most, halvings included.
const STEPS: usize = 200;
/// Steps of so little of a place end there.
const THERE: f64 = 1e-12;

/// Where a function that falls between two places, and whose slope is known, passes 0; an end that it does not reach.
pub fn falling_root(mut of: impl FnMut(f64) -> [f64; 2], [mut low, mut high]: [f64; 2], start: f64) -> f64 {
    let mut place = start.clamp(low, high);
    let mut width = high - low;
    for step in 1..=STEPS {
        let [value, slope] = of(place);
        if value == 0.0 {
            return place;
        }
        if value > 0.0 {
            low = place
        } else {
            high = place
        }
        let newton = place - value / slope;
        // Bisection where Newton leaves the bracket, or has not halved it in six steps: by size, where there is one.
        let is_slow = step % 6 == 0 && high - low > 0.5 * width;
        if step % 6 == 0 {
            width = high - low;
        }
        let middle = if low > 0.0 { (low * high).sqrt() } else { 0.5 * (low + high) };
        let next = if newton > low && newton < high && !is_slow { newton } else { middle };
        let is_there = (next - place).abs() <= THERE * place.abs().max(next.abs()).max(THERE);
        place = next;
        if is_there {
            break;
        }
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_root_is_found_inside_or_at_an_end() {
        let of = |x: f64| [2.0 - x.exp(), -x.exp()];
        assert!((falling_root(of, [-50.0, 50.0], 0.0) - 2.0_f64.ln()).abs() < 1e-12);
        assert!((falling_root(of, [-50.0, 50.0], -49.0) - 2.0_f64.ln()).abs() < 1e-12);
        assert!((falling_root(of, [1.0, 50.0], 2.0) - 1.0).abs() < 1e-9);
        assert!((falling_root(of, [-50.0, 0.5], 0.0) - 0.5).abs() < 1e-9);
        assert!((falling_root(|x| [1e-3 - x, -1.0], [1e-6, 1e6], 1.0) - 1e-3).abs() < 1e-12);
    }

    #[test]
    fn a_maximum_is_found_inside_or_at_an_end() {
        let (place, value) = maximum(|x| 2.0 - (x - 0.3).powi(2), [-5.0, 9.0]);
        assert!((place - 0.3).abs() < 1e-7 && (value - 2.0).abs() < 1e-14, "{place} {value}");
        assert_eq!(maximum(|x| x, [-1.0, 2.0]), (2.0, 2.0));
        assert_eq!(maximum(|x| -x, [-1.0, 2.0]), (-1.0, 1.0));
        let (place, _) = maximum(|x| -(x - 500.861_306).powi(2), [500.861_305_86, 500.861_306_43]);
        assert!((place - 500.861_306).abs() < 1e-8, "between places that are next to each other: {place}");
    }
}
