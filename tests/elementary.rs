//! The elementary functions keep the errors that the table of `law/elementary.rs` promises.
//!
//! Errors are in units in the last place of the exact result. In double precision the reference has 128 binary digits;
//! in single precision the double-precision library is exact enough, its error being below 2^-26 of such a unit.
//! `--nocapture` prints the worst found and where.

mod common;

use common::deformations::samples;
use common::{exact, rounded};
use proptest::prelude::*;
use toron::law::elementary::{Exponent, asinh, ln_1p, ln_sum, power};

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;

/// A reference for double precision: enough digits for its error not to matter, few enough to be quick.
type Reference = FBig<HalfEven, 2>;

fn reference(x: f64) -> Reference {
    exact(x).with_precision(128).value()
}

/// The largest error seen, and the arguments that gave it.
#[derive(Default)]
struct Worst {
    error: f64,
    at: Vec<f64>,
}

impl Worst {
    /// A double-precision result against the exact one.
    fn double(&mut self, result: f64, truth: &Reference, at: &[f64]) {
        let error = rounded(&(reference(result) - truth)).abs();
        let size = rounded(truth).abs().max(f64::MIN_POSITIVE);
        self.note(error / (size.next_up() - size), at);
    }

    /// A single-precision result against the double-precision one.
    fn single(&mut self, result: f32, truth: f64, at: &[f32]) {
        let size = (truth as f32).abs().max(f32::MIN_POSITIVE);
        let ulp = f64::from(size.next_up()) - f64::from(size);
        self.note((f64::from(result) - truth).abs() / ulp, &at.iter().map(|&x| f64::from(x)).collect::<Vec<_>>());
    }

    fn note(&mut self, error: f64, at: &[f64]) {
        assert!(!error.is_nan(), "no number at {at:?}");
        if error > self.error {
            *self = Worst { error, at: at.to_vec() };
        }
    }

    fn within(&self, what: &str, bound: f64) {
        println!("{what:<16} {:6.3} ulp at {:?}, allowed {bound}", self.error, self.at);
        assert!(self.error <= bound, "{what}: {} ulp at {:?}", self.error, self.at);
    }
}

/// Positive numbers of every size: all exponents, the neighbourhood of 1, and the seams of the reduction at √½ and √2
/// times powers of two.
fn positive() -> Vec<f64> {
    use std::f64::consts::FRAC_1_SQRT_2;
    let exponents = (-1022..=1023).flat_map(|k| [1.0, 1.1, 1.3, 1.999].map(|z: f64| z * f64::powi(2.0, k)));
    let near_one = (1..1000).flat_map(|k| [1.0 - f64::from(k) * 2f64.powi(-53), 1.0 + f64::from(k) * 2f64.powi(-52)]);
    let about_one = (1..53).flat_map(|k| [1.0 - 0.7 * 2f64.powi(-k), 1.0 + 0.7 * 2f64.powi(-k)]);
    let seams = (-40..40).flat_map(|k| {
        let seam = FRAC_1_SQRT_2 * f64::powi(2.0, k);
        [seam.next_down().next_down(), seam.next_down(), seam, seam.next_up(), seam.next_up().next_up()]
    });
    let dense = samples(0.5..2.0, 20_000);
    let wide = samples((-700.0..700.0).prop_map(f64::exp), 5_000);
    exponents.chain(near_one).chain(about_one).chain(seams).chain(dense).chain(wide).collect()
}

/// Positive normal single-precision numbers, 3 million evenly spread over the range and 4 million near 1.
fn positive_single() -> impl Iterator<Item = f32> {
    let (first, last) = (f32::MIN_POSITIVE.to_bits(), f32::MAX.to_bits());
    let near_one = (0.6f32.to_bits()..1.6f32.to_bits()).step_by(3);
    (first..last).step_by(701).chain(near_one).map(f32::from_bits)
}

#[test]
fn logarithm_of_a_sum() {
    let mut worst = Worst::default();
    for y in positive() {
        let half_ulp = (y.next_up() - y) / 2.0;
        for c in [0.0, half_ulp, -half_ulp, 0.3 * half_ulp] {
            // Below 1 the spacing halves, so that the correction to a power of two from below is half as large.
            let c = if c < 0.0 { -(y - y.next_down()) / 2.0 } else { c };
            if y == 1.0 && c == 0.0 {
                assert_eq!(ln_sum(y, c), 0.0);
                continue;
            }
            worst.double(ln_sum(y, c), &(reference(y) + reference(c)).ln(), &[y, c]);
        }
    }
    worst.within("ln_sum, f64", LN_SUM.0);

    let mut worst = Worst::default();
    for y in positive_single().filter(|&y| y != 1.0) {
        worst.single(ln_sum(y, 0.0), f64::from(y).ln(), &[y]);
        let half_ulp = (y.next_up() - y) / 2.0;
        if half_ulp >= f32::MIN_POSITIVE && half_ulp.is_finite() {
            worst.single(ln_sum(y, half_ulp), (f64::from(y) + f64::from(half_ulp)).ln(), &[y, half_ulp]);
        }
    }
    worst.within("ln_sum, f32", LN_SUM.1);
}

#[test]
fn logarithm_of_one_and_a_little() {
    let tiny = samples((-700.0..0.0).prop_map(f64::exp), 5_000);
    let mut worst = Worst::default();
    for x in tiny.flat_map(|x| [x, -x]).chain(positive()).chain(positive().into_iter().map(|y| y - 1.0)) {
        if x > -1.0 && x != 0.0 {
            worst.double(ln_1p(x), &reference(x).ln_1p(), &[x]);
        }
    }
    worst.within("ln_1p, f64", LN_1P.0);
    assert_eq!(ln_1p(0.0), 0.0);

    let mut worst = Worst::default();
    for x in positive_single().flat_map(|x| [x, -x]).filter(|&x| x > -1.0) {
        worst.single(ln_1p(x), f64::from(x).ln_1p(), &[x]);
    }
    worst.within("ln_1p, f32", LN_1P.1);
}

#[test]
fn inverse_hyperbolic_sine() {
    let (mut worst, mut worst_ratio, mut worst_root) = (Worst::default(), Worst::default(), Worst::default());
    let sizes = samples((-345.0..345.0).prop_map(f64::exp), 10_000);
    // Just above e^a = √2, where k ln 2 and 2 artanh w cancel by half.
    let seam = samples(0.3536..0.3836, 20_000);
    for s in positive().into_iter().filter(|&s| s <= 1e150).chain(sizes).chain(seam) {
        let (value, ratio, root) = asinh(s);
        worst.double(value, &reference(s).asinh(), &[s]);
        worst_ratio.double(ratio, &(reference(s).asinh() / reference(s)), &[s]);
        let exact_root = (reference(1.0) + reference(s) * reference(s)).with_precision(128).value().sqrt();
        worst_root.double(root, &exact_root, &[s]);
    }
    worst.within("asinh, f64", ASINH.0);
    worst_ratio.within("asinh s/s, f64", RATIO.0);
    worst_root.within("√(1 + s²), f64", ROOT.0);
    assert_eq!(asinh(0.0), (0.0, 1.0, 1.0));

    let (mut worst, mut worst_ratio, mut worst_root) = (Worst::default(), Worst::default(), Worst::default());
    let seam = samples(0.3536..0.3836, 20_000).map(|s| s as f32);
    for s in positive_single().filter(|&s| s <= 1e18).chain(seam) {
        let (value, ratio, root) = asinh(s);
        let exact = inverse_sinh(f64::from(s));
        worst.single(value, exact, &[s]);
        worst_ratio.single(ratio, exact / f64::from(s), &[s]);
        worst_root.single(root, (1.0 + f64::from(s) * f64::from(s)).sqrt(), &[s]);
    }
    worst.within("asinh, f32", ASINH.1);
    worst_ratio.within("asinh s/s, f32", RATIO.1);
    worst_root.within("√(1 + s²), f32", ROOT.1);
}

/// asinh in double precision without the cancellation that some libraries have for small arguments.
fn inverse_sinh(s: f64) -> f64 {
    (s + s * s / (1.0 + (1.0 + s * s).sqrt())).ln_1p()
}

/// Exponents of the compaction stress, p − 1 for any p of use, and awkward ones.
fn exponents() -> Vec<f64> {
    let named = [0.01, 0.2, 0.5, 1.0 - 1e-9, 1.0, 1.0 + 1e-9, 1.2, 1.5, 2.0, 2.0 + 1e-12, 3.0, 4.0, 5.0, 8.0];
    named.into_iter().chain(samples(0.01..8.0, 12)).collect()
}

#[test]
fn powers() {
    let bases = samples((-60.0..0.1).prop_map(f64::exp), 1_500)
        .chain(samples(0.5..2.0, 1_000))
        .chain((-1022..=1023).step_by(7).map(|k| 2f64.powi(k)))
        .chain((1..200).flat_map(|k| [1.0 - f64::from(k) * 2f64.powi(-53), 1.0 + f64::from(k) * 2f64.powi(-52)]))
        .collect::<Vec<_>>();
    let mut excess = Worst::default(); // beyond q ulp
    for q in exponents() {
        for &i in &bases {
            let size = q * i.log2();
            if -1022.0 < size && size <= 1023.0 {
                let mut worst = Worst::default();
                worst.double(power(i, Exponent::new(q)), &reference(i).powf(&reference(q)), &[i, q]);
                excess.note((worst.error - q * POWER.0.1).max(0.0), &[i, q]);
            }
        }
    }
    excess.within("power, f64", POWER.0.0);

    let mut excess = Worst::default();
    for q in exponents().into_iter().map(|q| q as f32) {
        for i in positive_single().step_by(23) {
            let truth = f64::from(i).powf(f64::from(q));
            if f64::from(f32::MIN_POSITIVE) <= truth && truth <= 2f64.powi(127) {
                let mut worst = Worst::default();
                worst.single(power(i, Exponent::new(q)), truth, &[i, q]);
                excess.note((worst.error - f64::from(q) * POWER.1.1).max(0.0), &worst.at);
            }
        }
    }
    excess.within("power, f32", POWER.1.0);
}

#[test]
fn powers_at_the_ends_of_the_range() {
    for q in exponents() {
        assert_eq!(power(0.0, Exponent::new(q)), 0.0);
        assert_eq!(power(1.0, Exponent::new(q)), 1.0);
        assert_eq!(power(f64::MIN_POSITIVE / 2.0, Exponent::new(q)), 0.0, "subnormal base");
    }
    assert_eq!(power(1e-200, Exponent::new(2.0)), 0.0, "underflow");
    assert_eq!(power(1e200, Exponent::new(2.0)), f64::INFINITY, "overflow");
    assert_eq!(power(2f64.powi(1023), Exponent::new(1.0)), 2f64.powi(1023), "the largest result");
    assert_eq!(power(1.2 * 2f64.powi(1023), Exponent::new(1.0)), f64::INFINITY, "beyond the largest result");
}

// The contract, double and single precision: what the table of `law/elementary.rs` says. For the power, (a, b) stands
// for a + b q.
const LN_SUM: (f64, f64) = (0.9, 0.9);
const LN_1P: (f64, f64) = (0.9, 0.9);
const ASINH: (f64, f64) = (4.5, 4.5);
const RATIO: (f64, f64) = (6.5, 6.5);
const ROOT: (f64, f64) = (1.1, 1.1);
const POWER: ((f64, f64), (f64, f64)) = ((1.2, 1.0), (1.2, 1.0));
