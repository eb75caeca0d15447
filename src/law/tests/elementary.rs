//! The elementary functions and the lanes' operations, at every level of instructions that this machine has.
//!
//! The functions keep the errors that the table of `number/elementary.rs` promises, in units in the last place of the
//! exact result. In double precision the reference has 128 binary digits; in single precision the double-precision
//! library is exact enough, its error being below 2^-26 of such a unit. `--nocapture` prints the worst found and where.

use std::fmt::Debug;

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use fastrand::Rng;

use crate::law::number::elementary::{Asinh, Exponent, exp, ln, ln_1p, ln_sum, power, powf, sinh_and_exp_of_minus};
use crate::law::number::level::Level;
use crate::law::number::real::{Lanes, Real};
use crate::law::number::registers::Registers;
use crate::law::number::twice::Twice;
#[cfg(target_arch = "x86_64")]
use crate::law::number::x86::{self, products};

/// A reference for double precision: enough digits for its error not to matter, few enough to be quick.
type Reference = FBig<HalfEven, 2>;

fn reference(x: f64) -> Reference {
    Reference::try_from(x).expect("a finite number").with_precision(128).value()
}

/// A precision and its measure of errors.
trait Number: Registers + Debug {
    type Exact;
    /// The error against the exact number, in units in the last place.
    fn ulps(self, exact: &Self::Exact) -> f64;
    fn exact(self) -> Self::Exact;
}

impl Number for f64 {
    type Exact = Reference;
    fn ulps(self, exact: &Reference) -> f64 {
        if !self.is_finite() {
            return f64::INFINITY;
        }
        let error = (reference(self) - exact).to_f64().value().abs();
        let size = exact.to_f64().value().abs().max(f64::MIN_POSITIVE);
        error / (size.next_up() - size)
    }
    fn exact(self) -> Reference {
        reference(self)
    }
}

impl Number for f32 {
    type Exact = f64;
    fn ulps(self, exact: &f64) -> f64 {
        if !self.is_finite() {
            return f64::INFINITY;
        }
        let size = (*exact as f32).abs().max(f32::MIN_POSITIVE);
        (f64::from(self) - exact).abs() / (f64::from(size.next_up()) - f64::from(size))
    }
    fn exact(self) -> f64 {
        f64::from(self)
    }
}

/// A function of `I` numbers with `O` results, in any number.
trait Function<const I: usize, const O: usize> {
    fn of<R: Real>(&self, x: [R; I]) -> [R; O];
}

/// The results of a function in lanes; unused lanes repeat the last argument.
fn in_lanes<T: Number, R: Lanes<T>, const I: usize, const O: usize>(
    function: &impl Function<I, O>,
    arguments: &[[T; I]],
) -> Vec<[T; O]> {
    let mut results = Vec::with_capacity(arguments.len());
    for chunk in arguments.chunks(R::COUNT) {
        let column = |c: usize| -> Vec<T> { (0..R::COUNT).map(|j| chunk[j.min(chunk.len() - 1)][c]).collect() };
        // SAFETY: a column has as many values as there are lanes.
        let x = std::array::from_fn(|c| unsafe { R::load(column(c).as_ptr()) });
        let columns = function.of(x).map(|y: R| {
            let mut values = vec![T::splat(0.0); R::COUNT];
            // SAFETY: as many values as lanes.
            unsafe { y.store(values.as_mut_ptr()) };
            values
        });
        results.extend((0..chunk.len()).map(|j| std::array::from_fn(|c| columns[c][j])));
    }
    results
}

/// The results of a function as a scalar and at every level.
fn everywhere<T: Number, const I: usize, const O: usize>(
    function: &impl Function<I, O>,
    arguments: &[[T; I]],
) -> Vec<(&'static str, Vec<[T; O]>)> {
    let mut results = vec![("scalar", arguments.iter().map(|&x| function.of(x)).collect())];
    for level in Level::ALL.into_iter().filter(|&level| level <= Level::best()) {
        #[cfg(target_arch = "x86_64")]
        let values = match level {
            Level::Baseline => in_lanes::<T, T::Baseline, I, O>(function, arguments),
            Level::Avx2 => in_lanes::<T, T::Avx2, I, O>(function, arguments),
            Level::Avx512 => in_lanes::<T, T::Avx512, I, O>(function, arguments),
        };
        #[cfg(not(target_arch = "x86_64"))]
        let values = in_lanes::<T, T, I, O>(function, arguments);
        results.push((level.name(), values));
    }
    #[cfg(target_arch = "x86_64")]
    if Level::best() >= Level::Avx2 {
        results.push(("one point", in_lanes::<T, T::Point, I, O>(function, arguments)));
        results.push(("two registers", in_lanes::<T, Twice<T::Avx2>, I, O>(function, arguments)));
    }
    results
}

/// Asserts that the error of each result is within its bound plus `spare`, which depends on the argument.
fn within<T: Number, const I: usize, const O: usize>(
    what: [(&str, f64); O],
    function: &impl Function<I, O>,
    arguments: &[[T; I]],
    exact: impl Fn([T; I]) -> [T::Exact; O],
    spare: impl Fn([T; I]) -> f64,
) {
    let exact: Vec<_> = arguments.iter().map(|&x| exact(x)).collect();
    for (level, results) in everywhere(function, arguments) {
        for (c, (name, bound)) in what.into_iter().enumerate() {
            let errors = results.iter().zip(&exact).zip(arguments);
            let errors = errors.map(|((y, exact), x)| ((y[c].ulps(&exact[c]) - spare(*x)).max(0.0), x));
            let (worst, at) = errors.fold((-1.0, None), |worst, (e, x)| if e > worst.0 { (e, Some(x)) } else { worst });
            let text = format!("{name}, {} bits, {level}: {worst:.3} ulp at {at:?}", 8 * size_of::<T>());
            println!("{text}, allowed {bound}");
            assert!(0.0 <= worst && worst <= bound, "{text}");
        }
    }
}

/// Values evenly spread, the same ones in every run.
fn samples(range: std::ops::Range<f64>, count: usize) -> impl Iterator<Item = f64> {
    let mut random = Rng::with_seed(1);
    (0..count).map(move |_| range.start + (range.end - range.start) * random.f64())
}

/// Positive numbers of every size: all exponents, the neighbourhood of 1, and the seams of the reduction at ¾ times
/// powers of two.
fn positive() -> Vec<f64> {
    let exponents = (-1022..=1022).step_by(3).flat_map(|k| [1.0, 1.1, 1.3, 1.999].map(|z: f64| z * f64::powi(2.0, k)));
    let near_one = (1..1000).flat_map(|k| [1.0 - f64::from(k) * 2f64.powi(-53), 1.0 + f64::from(k) * 2f64.powi(-52)]);
    let about_one = (1..53).flat_map(|k| [1.0 - 0.7 * 2f64.powi(-k), 1.0 + 0.7 * 2f64.powi(-k)]);
    let seams = (-40..40).flat_map(|k| {
        let seam = 0.75 * f64::powi(2.0, k);
        [seam.next_down().next_down(), seam.next_down(), seam, seam.next_up(), seam.next_up().next_up()]
    });
    let about_seams = samples(0.74..0.78, 10_000).chain(samples(1.45..1.51, 10_000));
    let dense = samples(0.5..2.0, 10_000);
    let wide = samples(-700.0..700.0, 1_000).map(f64::exp);
    let all = exponents.chain(near_one).chain(about_one).chain(seams);
    all.chain(about_seams).chain(dense).chain(wide).collect()
}

/// Positive normal single-precision numbers, 3 million evenly spread over the range and 4 million near 1.
fn positive_single() -> impl Iterator<Item = f32> {
    let (first, last) = (f32::MIN_POSITIVE.to_bits(), 2f32.powi(127).to_bits());
    let near_one = (0.6f32.to_bits()..1.6f32.to_bits()).step_by(3);
    (first..last).step_by(701).chain(near_one).map(f32::from_bits)
}

fn none<X>(_: X) -> f64 {
    0.0
}

struct LnSum;
impl Function<2, 1> for LnSum {
    fn of<R: Real>(&self, [y, c]: [R; 2]) -> [R; 1] {
        [ln_sum(y, c)]
    }
}

#[test]
fn logarithm_of_a_sum() {
    let mut arguments = Vec::new();
    for y in positive() {
        // Below 1 the spacing halves, so that the correction to a power of two from below is half as large.
        let (up, down) = ((y.next_up() - y) / 2.0, (y.next_down() - y) / 2.0);
        arguments.extend([0.0, up, down].map(|c| [y, c]));
    }
    let exact = |[y, c]: [f64; 2]| [(reference(y) + reference(c)).ln()];
    arguments.retain(|&[y, c]| y != 1.0 || c != 0.0);
    within([("ln_sum", LN_SUM.0)], &LnSum, &arguments, exact, none);

    let mut arguments = Vec::new();
    for y in positive_single().filter(|&y| y != 1.0) {
        arguments.push([y, 0.0]);
        let half_ulp = (y.next_up() - y) / 2.0;
        if half_ulp >= f32::MIN_POSITIVE {
            arguments.push([y, half_ulp]);
        }
    }
    let exact = |[y, c]: [f32; 2]| [(f64::from(y) + f64::from(c)).ln()];
    within([("ln_sum", LN_SUM.1)], &LnSum, &arguments, exact, none);

    for (level, results) in everywhere(&LnSum, &[[1.0, 0.0]]) {
        assert_eq!(results, [[0.0]], "{level}");
    }
    for (level, results) in everywhere(&LnSum, &[[1.0f32, 0.0]]) {
        assert_eq!(results, [[0.0]], "{level}");
    }
}

struct Ln1p;
impl Function<1, 1> for Ln1p {
    fn of<R: Real>(&self, [x]: [R; 1]) -> [R; 1] {
        [ln_1p(x)]
    }
}

#[test]
fn logarithm_of_one_and_a_little() {
    let tiny = samples(-700.0..0.0, 1_000).map(f64::exp);
    let all = tiny.flat_map(|x| [x, -x]).chain(positive()).chain(positive().into_iter().map(|y| y - 1.0));
    let arguments: Vec<_> = all.filter(|&x| x > -1.0 && x != 0.0).map(|x| [x]).collect();
    within([("ln_1p", LN_1P.0)], &Ln1p, &arguments, |[x]: [f64; 1]| [reference(x).ln_1p()], none);
    for (level, results) in everywhere(&Ln1p, &[[0.0]]) {
        assert_eq!(results, [[0.0]], "{level}");
    }

    let all = positive_single().flat_map(|x| [x, -x]);
    let arguments: Vec<_> = all.filter(|&x| x > -1.0).map(|x| [x]).collect();
    within([("ln_1p", LN_1P.1)], &Ln1p, &arguments, |[x]: [f32; 1]| [f64::from(x).ln_1p()], none);
}

struct InverseSinh;
impl Function<1, 2> for InverseSinh {
    fn of<R: Real>(&self, [s]: [R; 1]) -> [R; 2] {
        let (value, ratio) = asinh(s);
        [value, ratio]
    }
}

/// asinh s and (asinh s)/s for s ≥ 0.
fn asinh<R: Real>(s: R) -> (R, R) {
    let one = R::splat(1.0);
    let (asinh, _) = Asinh::new(s, s.mul_add(s, one).sqrt(), one);
    let (a, ratio) = asinh.finish();
    (a + a, ratio + ratio)
}

/// asinh in double precision without the cancellation that some libraries have for small arguments.
fn inverse_sinh(s: f64) -> f64 {
    (s + s * s / (1.0 + (1.0 + s * s).sqrt())).ln_1p()
}

#[test]
fn inverse_hyperbolic_sine() {
    let sizes = samples(-345.0..345.0, 2_000).map(f64::exp);
    // Just above e^2a = 3/2, where k ln 2 and 2 artanh w cancel by half, and down to where k = 0 is left.
    let seam = samples(0.19..0.22, 20_000).chain(samples(0.35..0.39, 10_000));
    let all = positive().into_iter().filter(|&s| s <= 1e150).chain(sizes).chain(seam);
    let arguments: Vec<_> = all.map(|s| [s]).collect();
    let exact = |[s]: [f64; 1]| {
        let value = reference(s).asinh();
        let ratio = &value / reference(s);
        [value, ratio]
    };
    let what = |bound: fn(&(f64, f64)) -> f64| [("asinh s", bound(&ASINH)), ("(asinh s)/s", bound(&RATIO))];
    within(what(|bound| bound.0), &InverseSinh, &arguments, exact, none);

    let seam = samples(0.19..0.22, 20_000).chain(samples(0.35..0.39, 10_000)).map(|s| s as f32);
    let arguments: Vec<_> = positive_single().filter(|&s| s <= 1e18).chain(seam).map(|s| [s]).collect();
    let exact = |[s]: [f32; 1]| {
        let value = inverse_sinh(f64::from(s));
        [value, value / f64::from(s)]
    };
    within(what(|bound| bound.1), &InverseSinh, &arguments, exact, none);

    for (level, results) in everywhere(&InverseSinh, &[[0.0]]) {
        assert_eq!(results, [[0.0, 1.0]], "{level}");
    }
    for (level, results) in everywhere(&InverseSinh, &[[0.0f32]]) {
        assert_eq!(results, [[0.0, 1.0]], "{level}");
    }
}

struct Power<T>(Exponent<T>);
impl<T: Number> Function<1, 1> for Power<T> {
    fn of<R: Real>(&self, [i]: [R; 1]) -> [R; 1] {
        [power(i, &self.0.map(|x: T| R::splat(x.into())))]
    }
}

/// Exponents of the compaction stress, p − 1 for any p that the law takes, and awkward ones.
fn exponents() -> Vec<f64> {
    let named =
        [0.01, 0.2, 0.5, 1.0 - 1e-9, 1.0, 1.0 + 1e-9, 1.2, 1.5, 2.0, 2.0 + 1e-12, 3.0, 4.0, 5.0, 8.0, 20.0, 39.0];
    named.into_iter().chain(samples(0.01..39.0, 12)).collect()
}

/// Powers from the least that is not 0 to the greatest that is promised.
fn promised<T: Number>(size: f64) -> bool {
    T::EXPONENTS.0 + 0.1 < size && size < T::EXPONENTS.1
}

#[test]
fn powers() {
    let bases: Vec<f64> = samples(-60.0..0.1, 1_500)
        .map(f64::exp)
        .chain(samples(0.5..2.0, 1_000))
        .chain((-1022..=1022).step_by(7).map(|k| 2f64.powi(k)))
        .chain((1..200).flat_map(|k| [1.0 - f64::from(k) * 2f64.powi(-53), 1.0 + f64::from(k) * 2f64.powi(-52)]))
        .collect();
    for q in exponents() {
        let arguments: Vec<_> = bases.iter().filter(|i| promised::<f64>(q * i.log2())).map(|&i| [i]).collect();
        let exact = |[i]: [f64; 1]| [reference(i).powf(&reference(q))];
        let name = format!("power {q}");
        within([(&name, POWER.0.0 + POWER.0.1 * q)], &Power(Exponent::new(q)), &arguments, exact, none);
    }
    for q in exponents().into_iter().map(|q| q as f32) {
        let bases = positive_single().step_by(23);
        let q_64 = f64::from(q);
        let arguments: Vec<_> = bases.filter(|&i| promised::<f32>(q_64 * f64::from(i).log2())).map(|i| [i]).collect();
        let exact = |[i]: [f32; 1]| [f64::from(i).powf(q_64)];
        let name = format!("power {q}");
        within([(&name, POWER.1.0 + POWER.1.1 * q_64)], &Power(Exponent::new(q)), &arguments, exact, none);
    }
}

#[test]
fn powers_at_the_ends_of_the_range() {
    for q in exponents() {
        let arguments = [[0.0], [1.0], [f64::MIN_POSITIVE / 2.0], [-1.0]];
        for (level, results) in everywhere(&Power(Exponent::new(q)), &arguments) {
            assert_eq!(results, [[0.0], [1.0], [0.0], [0.0]], "{level} {q}");
        }
        let arguments = [[0.0f32], [1.0], [f32::MIN_POSITIVE / 2.0], [-1.0]];
        for (level, results) in everywhere(&Power(Exponent::new(q as f32)), &arguments) {
            assert_eq!(results, [[0.0], [1.0], [0.0], [0.0]], "{level} {q}");
        }
    }
    for (level, results) in everywhere(&Power(Exponent::new(2.0)), &[[1e-200]]) {
        assert_eq!(results, [[0.0]], "{level}: underflow");
    }
    for (level, results) in everywhere(&Power(Exponent::new(2.0f32)), &[[1e-20f32]]) {
        assert_eq!(results, [[0.0]], "{level}: underflow");
    }
}

/// The functions that laws of one's own are written with.
struct Public;
impl Function<1, 2> for Public {
    fn of<R: Real>(&self, [x]: [R; 1]) -> [R; 2] {
        [ln(x), exp(x)]
    }
}

struct Logarithm;
impl Function<1, 1> for Logarithm {
    fn of<R: Real>(&self, [x]: [R; 1]) -> [R; 1] {
        [ln(x)]
    }
}

struct Exponential;
impl Function<1, 1> for Exponential {
    fn of<R: Real>(&self, [x]: [R; 1]) -> [R; 1] {
        [exp(x)]
    }
}

struct Hyperbolic;
impl Function<1, 2> for Hyperbolic {
    fn of<R: Real>(&self, [u]: [R; 1]) -> [R; 2] {
        let (sinh, decay) = sinh_and_exp_of_minus(u);
        [sinh, decay]
    }
}

struct AnyPower;
impl Function<2, 1> for AnyPower {
    fn of<R: Real>(&self, [x, q]: [R; 2]) -> [R; 1] {
        [powf(x, q)]
    }
}

#[test]
fn hyperbolic_sines_keep_their_digits_down_to_zero() {
    let both = |u: f64| {
        let (growth, decay) = (reference(u).exp(), reference(-u).exp());
        [(growth - &decay) / reference(2.0), decay]
    };
    let small = samples(-40.0..0.0, 2_000).map(f64::exp);
    let arguments: Vec<_> =
        samples(0.0..200.0, 10_000).chain(samples(0.0..2.0, 10_000)).chain(small).map(|u| [u]).collect();
    within(HYPERBOLIC, &Hyperbolic, &arguments, |[u]: [f64; 1]| both(u), none);
    let single: Vec<_> = samples(0.0..40.0, 50_000).chain(samples(0.0..2.0, 50_000)).map(|u| [u as f32]).collect();
    let both = |u: f64| [u.sinh(), (-u).exp()];
    within(HYPERBOLIC, &Hyperbolic, &single, |[u]: [f32; 1]| both(f64::from(u)), none);
    for (level, results) in everywhere(&Hyperbolic, &[[0.0]]) {
        assert_eq!(results, [[0.0, 1.0]], "{level}");
    }
}

#[test]
fn logarithms_and_exponentials() {
    let arguments: Vec<_> = positive().into_iter().filter(|&x| x != 1.0).map(|x| [x]).collect();
    within([("ln", LN.0)], &Logarithm, &arguments, |[x]: [f64; 1]| [reference(x).ln()], none);
    let arguments: Vec<_> = positive_single().filter(|&x| x != 1.0).map(|x| [x]).collect();
    within([("ln", LN.1)], &Logarithm, &arguments, |[x]: [f32; 1]| [f64::from(x).ln()], none);

    let small = samples(-40.0..0.0, 2_000).map(f64::exp).flat_map(|x| [x, -x]);
    let normal =
        samples(-708.3..709.7, 20_000).chain(samples(-1.0..1.0, 10_000)).chain(small).chain([709.782, -708.39]);
    let arguments: Vec<_> = normal.map(|x| [x]).collect();
    within([("exp", EXP.0)], &Exponential, &arguments, |[x]: [f64; 1]| [reference(x).exp()], none);
    let normal = samples(-87.3..88.7, 200_000).chain(samples(-1.0..1.0, 100_000)).chain([88.722, -87.33]);
    let arguments: Vec<_> = normal.map(|x| [x as f32]).collect();
    within([("exp", EXP.1)], &Exponential, &arguments, |[x]: [f32; 1]| [f64::from(x).exp()], none);
}

#[test]
fn any_powers() {
    let bases: Vec<f64> = samples(-30.0..30.0, 400).map(f64::exp).chain(samples(0.5..2.0, 400)).collect();
    let about_one = || samples(-3e-3..3e-3, 300).map(|x| 1.0 + x);
    for q in exponents().into_iter().flat_map(|q| [q, -q]).chain([-1000.0, 77.7, 1000.0]) {
        let arguments: Vec<_> = bases.iter().copied().chain(about_one()).map(|x| [x, q]).collect();
        let inside = |least: f64, most: f64| move |&[x, q]: &[f64; 2]| least < q * x.log2() && q * x.log2() < most;
        let double: Vec<_> = arguments.iter().copied().filter(inside(-1000.9, 1023.9)).collect();
        let exact = |[x, q]: [f64; 2]| [reference(x).powf(&reference(q))];
        let name = format!("x^{q}");
        within([(&name, 1.5 + 2.0 * q.abs())], &AnyPower, &double, exact, none);
        let single: Vec<_> =
            arguments.iter().copied().filter(inside(-104.9, 127.9)).map(|x| x.map(|x| x as f32)).collect();
        let exact = |[x, q]: [f32; 2]| [f64::from(x).powf(f64::from(q))];
        within([(&name, 1.5 + 2.0 * q.abs())], &AnyPower, &single, exact, none);
    }
}

/// Beyond the normal numbers, and where there is no real number.
#[test]
fn public_functions_at_the_ends_of_the_range() {
    macro_rules! check {
        ($t:ident) => {
            let (inf, nan, tiny) = ($t::INFINITY, $t::NAN, $t::MIN_POSITIVE / 2.0);
            let same = |a: $t, b: $t| a == b || (a.is_nan() && b.is_nan());
            let cases = [
                (0.0, -inf, 1.0),
                (-0.0, -inf, 1.0),
                (tiny, -inf, 1.0),
                (-1.0, nan, (-1.0 as $t).exp()),
                (1.0, 0.0, (1.0 as $t).exp()),
                (inf, inf, inf),
                (-inf, nan, 0.0),
                (nan, nan, nan),
                (1e4, (1e4 as $t).ln(), inf),
                (-1e4, nan, 0.0),
            ];
            for (level, results) in everywhere(&Public, &cases.map(|(x, ..)| [x])) {
                for ([logarithm, exponential], (x, a, b)) in results.into_iter().zip(cases) {
                    let near = |x: $t, y: $t| same(x, y) || (x - y).abs() <= 3.0 * $t::EPSILON * y.abs();
                    assert!(near(logarithm, a) && near(exponential, b), "{level} {x}: {logarithm} {exponential}");
                }
            }
            let cases = [
                (0.0, 2.0, 0.0),
                (0.0, -2.0, inf),
                (0.0, 0.0, 1.0),
                (tiny, 0.5, 0.0),
                (-1.0, 2.0, nan),
                (1.0, 1000.0, 1.0),
                (7.5, 0.0, 1.0),
                (2.0, 2000.0, inf),
                (2.0, -2000.0, 0.0),
                (4.0, -1.0, 0.25),
                (nan, 1.0, nan),
                (1.0, nan, nan),
                (1.0, inf, nan),
            ];
            for (level, results) in everywhere(&AnyPower, &cases.map(|(x, q, _)| [x, q])) {
                for ([found], (x, q, wanted)) in results.into_iter().zip(cases) {
                    assert!(same(found, wanted), "{level} {x}^{q}: {found}, not {wanted}");
                }
            }
        };
    }
    check!(f64);
    check!(f32);
}

// The bounds in double and single precision, as in the table of `law/number/elementary.rs`. For the power, (a, b)
// stands for a + b q.
const LN_SUM: (f64, f64) = (3.0, 3.0);
const LN: (f64, f64) = (3.0, 3.0);
const EXP: (f64, f64) = (1.5, 1.5);
const HYPERBOLIC: [(&str, f64); 2] = [("sinh", 2.5), ("exp of minus", 2.5)];
const LN_1P: (f64, f64) = (3.0, 3.0);
const ASINH: (f64, f64) = (4.5, 4.5);
const RATIO: (f64, f64) = (6.5, 6.5);
const POWER: ((f64, f64), (f64, f64)) = ((1.2, 1.5), (1.2, 1.8));

struct Split;
impl Function<1, 2> for Split {
    fn of<R: Real>(&self, [x]: [R; 1]) -> [R; 2] {
        let (z, k) = x.split_exponent();
        [z, k]
    }
}

struct Scaled;
impl Function<2, 1> for Scaled {
    fn of<R: Real>(&self, [x, k]: [R; 2]) -> [R; 1] {
        [x.times_power_of_two(k)]
    }
}

/// The limits of the reduced interval and the powers of two, with their neighbours, and some numbers in between.
macro_rules! splitting {
    ($name:ident, $t:ident) => {
        #[test]
        fn $name() {
            let mut arguments = Vec::new();
            for k in $t::MIN_EXP - 1..$t::MAX_EXP - 1 {
                let power = (2.0 as $t).powi(k);
                for seam in [1.5 * power, power] {
                    let (below, above) = (seam.next_down(), seam.next_up());
                    let near = [below.next_down(), below, seam, above, above.next_up(), 1.25 * power, 1.75 * power];
                    arguments.extend(near.into_iter().filter(|x| x.is_normal()).map(|x| [x]));
                }
            }
            let mut places = Vec::new();
            for (level, results) in everywhere(&Split, &arguments) {
                for (&[z, k], &[x]) in results.iter().zip(&arguments) {
                    assert!((0.75..1.5).contains(&z), "{level}: {x:e} = {z:e} 2^{k}");
                    // Two steps, since 2^k alone may be too large or small.
                    let half = (k / 2.0).trunc();
                    let whole = z * (2.0 as $t).powi(half as i32) * (2.0 as $t).powi((k - half) as i32);
                    assert_eq!(whole, x, "{level}: {z:e} 2^{k}");

                    if k.abs() < ($t::MAX_EXP - 2) as $t {
                        places.push([z, k]);
                    }
                }
            }
            places.truncate(arguments.len());
            for (level, results) in everywhere(&Scaled, &places) {
                for (&[found], &[z, k]) in results.iter().zip(&places) {
                    assert_eq!(found, z * (2.0 as $t).powi(k as i32), "{level}: {z:e} 2^{k}");
                }
            }
        }
    };
}
splitting!(exponents_split_and_join_f64, f64);
splitting!(exponents_split_and_join_f32, f32);

struct Reciprocal;
impl Function<1, 1> for Reciprocal {
    fn of<R: Real>(&self, [x]: [R; 1]) -> [R; 1] {
        [x.reciprocal()]
    }
}

struct Quotient;
impl Function<3, 1> for Quotient {
    fn of<R: Real>(&self, [x, divisor, reciprocal]: [R; 3]) -> [R; 1] {
        [x.quotient(divisor, reciprocal)]
    }
}

macro_rules! dividing {
    ($name:ident, $t:ident, $one:expr, $span:expr) => {
        #[test]
        fn $name() {
            let mut random = Rng::with_seed(7);
            let mut of_any_size = |span: f64| ((2.0 * random.f64() - 1.0) * span * std::f64::consts::LN_10).exp() as $t;
            let mut arguments: Vec<_> = (0..100_000).map(|_| [of_any_size(2.0 * $span)]).collect();
            for k in 0..2000 {
                arguments.push([(1.0 as $t) + k as $t * $t::EPSILON]);
                arguments.push([(2.0 as $t) - k as $t * $t::EPSILON]);
            }
            arguments.extend(arguments.clone().into_iter().map(|[x]| [-x]));
            let exact = |[x]: [$t; 1]| [$one / x.exact()];
            within([("1/x", 0.5)], &Reciprocal, &arguments, exact, none);

            let quotients: Vec<_> = (0..200_000)
                .map(|i| {
                    let divisor = of_any_size($span);
                    let x = if i % 4 == 0 { divisor } else { of_any_size($span) };
                    [x, divisor, 1.0 / divisor]
                })
                .collect();
            for (level, results) in everywhere(&Quotient, &quotients) {
                for (&[found], &[x, divisor, _]) in results.iter().zip(&quotients) {
                    assert_eq!(found, x / divisor, "{level}: {x:e}/{divisor:e}");
                }
            }
        }
    };
}
dividing!(reciprocals_and_quotients_f64, f64, reference(1.0), 75.0);
dividing!(reciprocals_and_quotients_f32, f32, 1.0, 7.0);

/// The mantissas of double precision whose reciprocals lie nearest to halfway between two numbers, x m = 2^106 + k for
/// an odd m of 54 bits and |k| ≤ 8: where a reciprocal computed in any other way than by a division goes wrong first.
/// Found by factoring.
const HALFWAY: [u64; 86] = [
    0x1ffffff8000001,
    0x1fffffffffffff,
    0x1014ca35e947b6,
    0x1024a3bd98da02,
    0x10699d36aec84e,
    0x109107683ee29e,
    0x10af911aa26396,
    0x10d03f8a57cc76,
    0x110af85de838ce,
    0x110d10000221a2,
    0x1125e52b034982,
    0x115efb8b10aa42,
    0x11d3799c32581e,
    0x11f98ea5d9b262,
    0x120a8f5bbf2106,
    0x12af4d6bc06922,
    0x12bf5907e316d2,
    0x12e93952a2ed6e,
    0x130a0dd90e13a2,
    0x134d8fe343ef42,
    0x1379cb88f092f2,
    0x13a324a526d5ee,
    0x13a7a1d01d1ec2,
    0x13d75d54b37492,
    0x1403e897077b16,
    0x14a6fb45f5d782,
    0x14cad5a5fa03ee,
    0x155f2490c86132,
    0x156a8cb0234262,
    0x159aa11aaecb86,
    0x16026c81a85766,
    0x163baaac17d1e2,
    0x163dd0554d0122,
    0x16d6422e5cf246,
    0x16f0f27bf434d6,
    0x16fae7ba173812,
    0x17641c46f799ee,
    0x178cb7d5d6e322,
    0x17f52093014f0e,
    0x1806c89fcb9452,
    0x181efe51ead722,
    0x18401cbcdb5596,
    0x184a12efef626e,
    0x1960a45d1a71e6,
    0x199e1b447e99c2,
    0x19f142d24e1352,
    0x1a0b8ffffcbe8e,
    0x1a149bad85de72,
    0x1a2ce4d7478a06,
    0x1a6f41dab98cb2,
    0x1aa7c88ee59082,
    0x1ae6849e786ad2,
    0x1b227794e85702,
    0x1bea3278b789d2,
    0x1c2693dcf34742,
    0x1c4d3aabd478f6,
    0x1c69bf28eba166,
    0x1d5b9032f086be,
    0x1da210daeb138e,
    0x1de441d5331432,
    0x1de4a0d00fa9b2,
    0x1e20adbc4078a2,
    0x1e756f08df1792,
    0x1e8d517d09c5c2,
    0x1e9a9473949bf6,
    0x1ef7930608393e,
    0x1f65fad23b0d86,
    0x1f739bd459bea2,
    0x10aadc6f562fdc,
    0x10ed85c351e224,
    0x12d2d2d2d2d2d4,
    0x12e3c6a0509ca4,
    0x132160ccc0848c,
    0x13541c0067f83c,
    0x14873ecade304c,
    0x15555555555554,
    0x172f10bf899124,
    0x178d42e524dcdc,
    0x194ab05a4ecedc,
    0x194c4511fa3124,
    0x199d2b42ffe9f4,
    0x1c36899addce3c,
    0x1c384d119331c4,
    0x1c928b5b9dc714,
    0x1fe24bffeb8794,
    0x1ffb8a8b628dbc,
];

/// These mantissas, those at both ends of the range, and some in between.
fn hard_mantissas() -> Vec<f64> {
    let ends = (0..64).flat_map(|k| [(1_u64 << 53) - 1 - k, (1 << 52) + k]);
    let hard = HALFWAY.into_iter().chain(ends).map(|mantissa| mantissa as f64 / (1_u64 << 52) as f64);
    hard.chain(samples(1.0..2.0, 20_000)).collect()
}

/// In single precision, some hundred thousand mantissas, those at both ends of the range among them.
fn mantissas_single() -> Vec<f32> {
    let ends = (0..64).flat_map(|k| [(1_u32 << 24) - 1 - k, (1 << 23) + k]);
    ends.chain((1 << 23..1 << 24).step_by(61)).map(|mantissa| mantissa as f32 / (1_u32 << 23) as f32).collect()
}

/// Reciprocals are the same at every level: those of a correctly rounded division.
#[test]
fn reciprocals_are_those_of_a_division() {
    let sizes = [1.0, -1.0, 2f64.powi(-300), 2f64.powi(300)];
    let arguments: Vec<_> = hard_mantissas().into_iter().flat_map(|x| sizes.map(|size| [x * size])).collect();
    for (level, results) in everywhere(&Reciprocal, &arguments) {
        for (&[found], &[x]) in results.iter().zip(&arguments) {
            assert_eq!(found, 1.0 / x, "{level}: 1/{x:e}");
        }
    }
    let arguments: Vec<_> = mantissas_single().into_iter().flat_map(|x| [[x], [x * 1e-9]]).collect();
    for (level, results) in everywhere(&Reciprocal, &arguments) {
        for (&[found], &[x]) in results.iter().zip(&arguments) {
            assert_eq!(found, 1.0 / x, "{level}: 1/{x:e}");
        }
    }
}

#[cfg(target_arch = "x86_64")]
struct Series<const TERMS: u8>;
#[cfg(target_arch = "x86_64")]
impl<const TERMS: u8> Function<2, 1> for Series<TERMS> {
    fn of<R: Real>(&self, [x, y]: [R; 2]) -> [R; 1] {
        [products::reciprocal_series::<R, TERMS>(x, y)]
    }
}

#[cfg(target_arch = "x86_64")]
struct NewtonStep;
#[cfg(target_arch = "x86_64")]
impl Function<2, 1> for NewtonStep {
    fn of<R: Real>(&self, [x, y]: [R; 2]) -> [R; 1] {
        [products::newton_reciprocal(x, y)]
    }
}

/// The reciprocal of AVX-512 step by step, from approximations of every error that the instruction may have: the result
/// does not depend on it, so that it is the same on every maker's processors, and this needs none of them.
#[cfg(target_arch = "x86_64")]
#[test]
fn refined_reciprocals_do_not_depend_on_the_approximation() {
    if Level::best() < Level::Avx2 {
        return; // without a fused multiply-add there is no such refinement
    }
    let errors = [-1.0, -0.99, -0.7, -1e-3, -1e-9, 0.0, 1e-9, 1e-3, 0.5, 0.99, 1.0].map(|e| 1.0 + e * 2f64.powi(-14));

    let arguments: Vec<[f64; 2]> =
        hard_mantissas().into_iter().flat_map(|x| errors.map(|error| [x, error / x])).collect();
    let series = in_lanes::<f64, x86::F64Point, 2, 1>(&Series::<3>, &arguments);
    let near: Vec<_> = series.iter().zip(&arguments).map(|(&[s], &[x, y])| [x, y_plus_product_upwards(s, y)]).collect();
    let found = in_lanes::<f64, x86::F64Point, 2, 1>(&NewtonStep, &near);
    for (&[found], &[x, y]) in found.iter().zip(&arguments) {
        assert_eq!(found, 1.0 / x, "1/{x:e} from {y:e}");
    }

    let arguments: Vec<[f32; 2]> = mantissas_single()
        .into_iter()
        .flat_map(|x| errors.map(|error| [x, (error / f64::from(x)) as f32]))
        // Rounding may have carried an approximation beyond what the instruction promises.
        .filter(|&[x, y]| (f64::from(x) * f64::from(y) - 1.0).abs() <= 2f64.powi(-14))
        .collect();
    let series = in_lanes::<f32, x86::F32Point, 2, 1>(&Series::<1>, &arguments);
    let near = series.iter().zip(&arguments).map(|(&[s], &[x, y])| {
        // Less than 62 bits: of the exact sum only the sign of the remainder counts.
        let sum = (f64::from(s) * f64::from(y) + f64::from(y)) as f32;
        let remainder = (f64::from(y) - f64::from(sum)) + f64::from(s) * f64::from(y);
        [x, if remainder > 0.0 { sum.next_up() } else { sum }]
    });
    let near: Vec<_> = near.collect();
    let found = in_lanes::<f32, x86::F32Point, 2, 1>(&NewtonStep, &near);
    for (&[found], &[x, y]) in found.iter().zip(&arguments) {
        assert_eq!(found, 1.0 / x, "1/{x:e} from {y:e}");
    }
}

/// s y + y, rounded upwards.
#[cfg(target_arch = "x86_64")]
fn y_plus_product_upwards(s: f64, y: f64) -> f64 {
    let sum = s.mul_add(y, y);
    let exact = reference(s) * reference(y) + reference(y);
    if reference(sum) < exact { sum.next_up() } else { sum }
}
