//! The joint 95 % region of k_tc and p: where no pair of the two meets the data much worse than the best.
//!
//! Its border is where the weighted squares, least over the other parameters, exceed their least value by 2 F(0.95; 2,
//! ν); it is bent like the data's own dependence, which an ellipse is not.

use nalgebra::{Matrix2, Vector2};
use rayon::prelude::*;

use super::data::DataSet;
use super::fit::{Fit, Group, Problem};
use super::least_squares::{Weighted, search};
use super::parameter::{Parameter, Values};
use toron_strikes::confidence::LEVEL;

/// So many points of the border.
const POINTS: usize = 40;
/// Halvings of the distance along a ray.
const HALVINGS: usize = 11;
/// The border is sought this much farther than where the ellipse has it.
const FARTHEST: f64 = 8.0;
/// So near, in standard deviations, the squares rise as a parabola does.
const NEAR: f64 = 0.1;

/// The border as pairs of k_tc and p, closed.
pub fn border(problem: &Problem, fit: &Fit) -> Option<Vec<[f64; 2]>> {
    let pair = [Parameter::KTc, Parameter::P];
    let told = |group: &&Group| pair.iter().all(|p| group.parameters.contains(p) && !group.bounded.contains(p));
    let group = fit.groups.iter().find(told)?;
    let sets: Vec<&DataSet> = group.sets.iter().map(|&set| &problem.sets[set]).collect();
    let data = Weighted { sets: &sets, weights: &group.weights };
    let others: Vec<Parameter> = group.parameters.iter().copied().filter(|p| !pair.contains(p)).collect();
    let squares = |values: &Values| search(data, &others, values).map_or(f64::INFINITY, |found| found.squares);
    let least = squares(&group.values);
    let [k_tc, p] = pair.map(|parameter| group.values[parameter.index()]);
    // In ln k_tc and p, where the region is nearly an ellipse.
    let root = covariance(fit, k_tc).cholesky()?.l();
    let freedom = pair.map(|parameter| fit.uncertainty.freedom(parameter)).into_iter().fold(f64::INFINITY, f64::min);
    let at = |angle: f64, distance: f64| {
        let moved = root * Vector2::new(angle.cos(), angle.sin()) * distance;
        [k_tc * moved.x.exp(), p + moved.y]
    };
    let rise = |[k_tc, p]: [f64; 2]| {
        let mut values = group.values;
        (values[Parameter::KTc.index()], values[Parameter::P.index()]) = (k_tc, p);
        if p > Parameter::P.least() { squares(&values) - least } else { f64::INFINITY }
    };
    // A weight of the user's makes the squares larger or smaller than the noise does.
    let own_weights = sets.iter().any(|set| set.weight != 1.0);
    let angle = |i: usize| std::f64::consts::TAU * i as f64 / POINTS as f64;
    let near = (0..POINTS).map(|i| rise(at(angle(i), NEAR)) / (NEAR * NEAR * POINTS as f64)).sum::<f64>();
    let level = quantile(freedom);
    let limit = if own_weights { near * level } else { level };
    let border = |i: usize| {
        let (mut inner, mut outer) = (0.0, FARTHEST * level.sqrt());
        for _ in 0..HALVINGS {
            let middle = 0.5 * (inner + outer);
            if rise(at(angle(i), middle)) > limit { outer = middle } else { inner = middle }
        }
        at(angle(i), inner)
    };
    Some((0..=POINTS).into_par_iter().map(border).collect())
}

/// The covariance of ln k_tc and p.
fn covariance(fit: &Fit, k_tc: f64) -> Matrix2<f64> {
    let of = |a, b| fit.uncertainty.covariance(a, b);
    let mixed = of(Parameter::KTc, Parameter::P) / k_tc;
    let own = of(Parameter::KTc, Parameter::KTc) / (k_tc * k_tc);
    Matrix2::new(own, mixed, mixed, of(Parameter::P, Parameter::P))
}

/// 2 F(0.95; 2, ν), which for two degrees of freedom has a closed form.
fn quantile(freedom: f64) -> f64 {
    if freedom > 1e6 {
        return -2.0 * (1.0 - LEVEL).ln();
    }
    freedom * ((1.0 - LEVEL).powf(-2.0 / freedom) - 1.0)
}
