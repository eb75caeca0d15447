//! A point against the laws as the papers state them, in 320 binary digits.
//!
//! The unit of the error is what the input allows: ε (|σ| + K), with K what a relative change of the entries of F by 1
//! does to σ, and of the old slip for the law with friction.

use std::sync::LazyLock;

use nalgebra::{Matrix3, Vector3};
use toron::Properties;
use toron::law::thesis::{Functions as OfNumber, Yarn, determinant};
use toron_test_support::exact::{DIGITS, Exact, exact, rounded};

use super::case::{Case, Law, with};
use super::checks::{has_failed, holds, old_state};
use super::entries::Outcome;
use super::functions::Functions;
use crate::setting;

type M = Matrix3<Exact>;
type V = Vector3<Exact>;

/// One point in so many of those that could be is checked: with 7, nine tenths of a run's time.
pub static ONE_IN: LazyLock<u64> = LazyLock::new(|| setting("TORON_FUZZ_EXACT", 7).max(1));
/// The most that an error may be, in these units, of the yarn laws and of the linear elastic one.
const MOST: [f64; 2] = [8.0, 64.0];

/// The six components of the library: 11 22 33 12 23 31.
const COMPONENTS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)];

/// What the formulas read of a point.
struct Point {
    f: M,
    f_old: M,
    properties: Vec<Exact>,
    fibre: V,
    second_axis: Option<V>,
    state: Vec<Exact>,
}

/// Whether the point is checked, and then the worst error so far, of the yarn laws and the linear elastic one.
///
/// # Errors
/// The stress is further from the formulas than the input allows.
pub fn check<T: Functions>(
    case: &Case,
    i: usize,
    outcome: &Outcome<T>,
    seed: u64,
    worst: &mut [f64; 2],
) -> Result<bool, String> {
    let old = old_state::<T>(case, outcome.entry, i);
    let wanted = seed.is_multiple_of(*ONE_IN) && case.asks(with::STRESS) && outcome.status(case, i) == Some(0);
    if !wanted || has_failed(old[case.law.failed()]) || !is_tellable(case, i, &old) {
        return Ok(false);
    }
    let point = Point::new::<T>(case, i, &old);
    let stress = outcome.stress.row(i);
    let law = usize::from(case.law.is_linear());
    if !case.law.is_linear() && is_at_kink(&point, T::ROUNDING) {
        return Ok(false);
    }
    let error = if law == 1 { linear_error::<T>(&point, &stress) } else { yarn_error::<T>(case.law, &point, &stress) };
    worst[law] = worst[law].max(error);
    holds(error <= MOST[law], || {
        format!("{:?}, point {i}: stress {stress:?} is {error} units from the formulas", case.law)
    })?;
    Ok(true)
}

/// Whether the digits of F tell the point from others: far slips of a section along an oblique fibre lose them, and in
/// single precision a power of the compaction near 1.
fn is_tellable(case: &Case, i: usize, old: &[f64]) -> bool {
    let point = &case.points[i];
    let usual = |f: &[f64; 9]| {
        let f = Matrix3::from_column_slice(f);
        f.iter().all(|x| *x == 0.0 || (1e-8..1e3).contains(&x.abs()))
            && f.try_inverse().is_some_and(|inverse| f.norm() * inverse.norm() < 1e4)
    };
    let linear = case.law.is_linear();
    let stiffness = &case.properties[..if linear { 3 } else { 5 }];
    let at_kink = !linear && case.single && case.properties[2] < 2.0;
    let fibre: f64 = fibre(case, i).map(f64::abs).iter().sum();
    usual(&point.f)
        && (!linear || (usual(&point.f_old) && case.rotation == 0))
        && (1e-6..1e6).contains(&fibre)
        && stiffness.iter().all(|k| *k == 0.0 || (1e-6..1e6).contains(k))
        && (linear || (1.5..10.0).contains(&case.properties[2]))
        && !at_kink
        && old.iter().all(|x| x.abs() < 1e2)
}

fn fibre(case: &Case, i: usize) -> [f64; 3] {
    let at = case.law.fibre();
    if case.asks(with::FIBRE) { case.points[i].fibre } else { std::array::from_fn(|c| case.properties[at + c]) }
}

/// A number that may be known without rounding, such as 1, with the digits of the others.
fn long(x: Exact) -> Exact {
    x.with_precision(DIGITS).value()
}

fn unit(v: V) -> V {
    let length = v.dot(&v).sqrt();
    v / length
}

fn matrix<T: Functions>(columns: &[f64; 9]) -> M {
    M::from_fn(|i, j| exact(T::splat(columns[3 * j + i]).into()))
}

impl Point {
    fn new<T: Functions>(case: &Case, i: usize, old: &[f64]) -> Point {
        let number = |x: f64| exact(T::splat(x).into());
        let vector = |v: [f64; 3]| V::from(v.map(number));
        let point = &case.points[i];
        let second = match case.law {
            Law::Linear if case.asks(with::SECOND_AXIS) => point.second_axis,
            Law::Linear => [case.properties[7], case.properties[8], case.properties[9]],
            _ => [0.0; 3],
        };
        Point {
            f: matrix::<T>(&point.f),
            f_old: if case.law.is_linear() { matrix::<T>(&point.f_old) } else { M::identity() },
            properties: case.properties.iter().map(|&x| number(x)).collect(),
            fibre: unit(vector(fibre(case, i))),
            // In the precision of the case, where it may have become 0.
            second_axis: Some(vector(second)).filter(|n| *n != V::zeros()).map(unit),
            state: old.iter().map(|&x| exact(x)).collect(),
        }
    }

    /// Two axes across the fibre, as the law has them.
    fn across(&self) -> [V; 2] {
        let (one, m) = (exact(1.0), &self.fibre);
        if let Some(n) = &self.second_axis {
            let second = unit(n - m * m.dot(n));
            let third = m.cross(&second);
            return [second, third];
        }
        let sign = if m.x < exact(0.0) { -&one } else { one.clone() };
        let over = &one / (&one + &sign * &m.x);
        let b = &m.y * &m.z * &over;
        [
            V::new(-(&sign * &m.y), &one - &m.y * &m.y * &over, -b.clone()),
            V::new(-m.z.clone(), -(&sign * b), &sign * (&one - &m.z * &m.z * over)),
        ]
    }

    fn yarn(&self) -> Yarn<Exact> {
        let k = |index: usize| self.properties[index].clone();
        let zero = exact(0.0);
        let [eps_lim, alpha, beta] = [zero.clone(), zero.clone(), zero];
        Yarn {
            properties: Properties {
                k_el: k(0),
                k_tc: k(1),
                p: k(2),
                k_td: k(3),
                k_ld: k(4),
                eps_lim,
                alpha,
                beta,
                fibre: self.fibre.clone().into(),
            },
            functions: OfNumber {
                number: exact,
                sqrt: |x| long(x).sqrt(),
                ln: |x| long(x).ln(),
                acosh: |x| long(x).acosh(),
                power: |x, p| long(x).powf(&p),
            },
        }
    }

    /// The Cauchy stress of a yarn law.
    fn stress(&self, law: Law) -> M {
        let yarn = self.yarn();
        if law == Law::Hyperelastic { yarn.cauchy(&self.f) } else { self.frictional(&yarn) }
    }

    /// The law with friction: all but the distortion is as in the thesis.
    fn frictional(&self, yarn: &Yarn<Exact>) -> M {
        let f = &self.f;
        let c = f.transpose() * f;
        let modes = yarn.modes(&c);
        let [el, tc, _, ld] = yarn.stresses(&c, modes.clone());
        let rest = f * (el + tc + ld) * f.transpose();
        let (zero, one, half) = (exact(0.0), exact(1.0), exact(0.5));
        let image = f * &self.fibre;
        let lambda = image.dot(&image).sqrt();
        let e = image / lambda.clone();
        let [a, b] = self.across().map(|t| {
            let image = f * t;
            let along = e.dot(&image);
            image - &e * along
        });
        let jacobian = determinant(f);
        let j_t = &jacobian / lambda;
        let [d1, d2] = [&self.state[10], &self.state[11]];
        let g = (&one + d1 * d1 + d2 * d2).sqrt();
        let [w1, w2] = if *d1 >= zero {
            let r = (&g + d1).sqrt();
            [&a * r.clone() + &b * (d2 / &r), &b * (&one / r)]
        } else {
            let r = (&g - d1).sqrt();
            [&a * (&one / &r), &a * (d2 / &r) + &b * r]
        };
        let whole = (&w1 * w1.transpose() + &w2 * w2.transpose()) / j_t;
        let x = &half * whole.trace();
        let projector = M::identity() - &e * e.transpose();
        let deviator = whole - projector * x.clone();
        let x = if x < one { one.clone() } else { x };
        let s = long(&x * &x - &one).sqrt();
        let [_, k_tc, p, k_td] = [0, 1, 2, 3].map(|index| self.properties[index].clone());
        let distortion = if s > zero {
            let i_te = &half * long(x).acosh();
            let i_tc = &modes[1];
            let pressure = if *i_tc < zero { &half * &p * k_tc * long(-i_tc.clone()).powf(&(p - one)) } else { zero };
            let most = &self.properties[11] * pressure + &self.properties[12];
            let trial = half * k_td * i_te;
            deviator * (if trial < most { trial } else { most } / s)
        } else {
            M::zeros()
        };
        (rest + distortion) / jacobian
    }

    /// The strain increment of the linear elastic law in the axes that follow the fibre, and these at the end.
    fn increment(&self) -> (M, M) {
        let [n, _] = self.across();
        let axes = |f: &M| {
            let e1 = unit(f * &self.fibre);
            let image = f * &n;
            let along = e1.dot(&image);
            let e2 = unit(image - &e1 * along);
            let e3 = e1.cross(&e2);
            M::from_columns(&[e1, e2, e3])
        };
        let (q0, q1) = (axes(&self.f_old), axes(&self.f));
        let rate = logarithm(q1.transpose() * &self.f * inverse(&self.f_old) * q0);
        ((&rate + rate.transpose()) * exact(0.5), q1)
    }
}

fn inverse(a: &M) -> M {
    let over = exact(1.0) / determinant(a);
    M::from_fn(|i, j| {
        let entry = |k: usize, l: usize| &a[((j + k) % 3, (i + l) % 3)];
        (entry(1, 1) * entry(2, 2) - entry(1, 2) * entry(2, 1)) * &over
    })
}

/// ln A by square roots (Denman and Beavers) and the series of ln(1 + X).
fn logarithm(mut a: M) -> M {
    let (one, half) = (M::identity(), exact(0.5));
    let distance = |a: &M| a.iter().zip(one.iter()).map(|(x, y)| rounded(&(x - y)).abs()).sum::<f64>();
    let mut factor = exact(1.0);
    while distance(&a) > 0.01 {
        let (mut y, mut z) = (a.clone(), one.clone());
        for _ in 0..14 {
            (y, z) = ((&y + inverse(&z)) * half.clone(), (&z + inverse(&y)) * half.clone());
        }
        a = y;
        factor *= exact(2.0);
    }
    let x = &a - &one;
    let (mut sum, mut power) = (M::zeros(), -one.clone());
    for n in 1..20 {
        power = -(power * &x);
        sum += &power * (exact(1.0) / exact(f64::from(n)));
    }
    sum * factor
}

fn norm(a: &M) -> f64 {
    a.iter().map(|x| rounded(x).powi(2)).sum::<f64>().sqrt()
}

/// The distance of an answer, 11 22 33 12 23 31, from the truth.
fn distance(truth: &M, stress: &[f64]) -> f64 {
    let answer = M::from_fn(|i, j| {
        let c = COMPONENTS.iter().position(|&(a, b)| (a, b) == (i, j) || (b, a) == (i, j)).expect("a component");
        exact(stress[c])
    });
    norm(&(truth - answer))
}

/// Whether roundings of F may take I_el or I_tc to the other side of 0, where the stiffness is another.
fn is_at_kink(point: &Point, rounding: f64) -> bool {
    let f = &point.f;
    let [i_el, i_tc, ..] = point.yarn().modes(&(f.transpose() * f));
    let most = 64.0 * rounding * norm(f) * norm(&inverse(f));
    rounded(&i_el).abs() < most || rounded(&i_tc).abs() < most
}

/// The error of a yarn law's stress in units of what the input allows.
fn yarn_error<T: Functions>(law: Law, point: &Point, stress: &[f64]) -> f64 {
    let truth = point.stress(law);
    let error = distance(&truth, stress);
    let of_value = error / (T::ROUNDING * norm(&truth));
    if error == 0.0 || of_value <= 1.0 {
        return if error == 0.0 { 0.0 } else { of_value };
    }
    let step = exact(1.0) >> 80;
    let moved = |change: &dyn Fn(&mut Point)| {
        let mut point = Point {
            f: point.f.clone(),
            f_old: point.f_old.clone(),
            properties: point.properties.clone(),
            fibre: point.fibre.clone(),
            second_axis: None,
            state: point.state.clone(),
        };
        change(&mut point);
        norm(&((point.stress(law) - &truth) / step.clone()))
    };
    let mut sensitivity = 0.0;
    let longer = exact(1.0) + &step;
    for entry in 0..9 {
        if point.f[entry] != exact(0.0) {
            sensitivity += moved(&|point| point.f[entry] *= &longer);
        }
    }
    if law == Law::Frictional {
        for place in [10, 11] {
            sensitivity += moved(&|point| point.state[place] *= &longer);
        }
    }
    error / (T::ROUNDING * (norm(&truth) + sensitivity))
}

/// The error of the linear elastic law's stress, in roundings of it and of the stiffness times the conditions of F.
fn linear_error<T: Functions>(point: &Point, stress: &[f64]) -> f64 {
    let (strain, q1) = point.increment();
    let [e_1, e_2, g] = [0, 1, 2].map(|index| &point.properties[index]);
    let local = M::from_fn(|i, j| {
        let c = COMPONENTS.iter().position(|&(a, b)| (a, b) == (i, j) || (b, a) == (i, j)).expect("a component");
        let stiffness = if i != j { g * exact(2.0) } else { if i == 0 { e_1 } else { e_2 }.clone() };
        stiffness * &strain[(i, j)] + &point.state[c]
    });
    let truth = &q1 * &local * q1.transpose();
    let condition = |f: &M| norm(f) * norm(&inverse(f));
    let stiffness = rounded(e_1).max(rounded(e_2)).max(rounded(g));
    let size = norm(&truth) + stiffness * (1.0 + norm(&strain));
    let error = distance(&truth, stress);
    if error == 0.0 { 0.0 } else { error / (T::ROUNDING * size * condition(&point.f) * condition(&point.f_old)) }
}
