//! Intervals by the profile of the squares: a value of a parameter is in its interval where the weighted squares, least
//! over the parameters fitted with it, exceed their least value by no more than F(0.95; 1, ν).
//!
//! Where n of the others are on a bound there, the limit is (n + 1) F(0.95; n + 1, ν): squares that cannot fall beyond
//! a bound rise faster than those that F(1, ν) is of. The least squares at each place are sought from several starts,
//! and where they are low again farther out the interval goes on to there: it is rather too long than too short.
//!
//! Unlike the intervals of [`uncertainty`](super::uncertainty) these are not linearised: one may be lopsided, and run
//! to what the law allows. A parameter whose errors come from elsewhere too, from sets that were fitted before, from a
//! zero or from a constant, keeps its linearised interval.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;
use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor};

use super::data::DataSet;
use super::fit::{Fit, Group, Problem};
use super::least_squares::{Solution, Weighted, minimise, search};
use super::parameter::{ALL, Parameter, Values};
use super::uncertainty::{Estimate, quantile};
use toron_strikes::confidence::LEVEL;

/// An end is sought outwards from where the linearised interval has it, each time so much farther, at most so often.
const FARTHER: f64 = 1.5;
const TIMES: usize = 100;
/// So often the squares are looked at beyond the limit, lest they are low there once more.
const BEYOND: usize = 3;
/// An end is known to this part of the linearised interval's reach, which takes fewer than so many places.
const ACCURACY: f64 = 1e-4;
const PLACES: usize = 30;
/// So near, in standard deviations, the squares rise as a parabola does.
const NEAR: f64 = 0.1;
/// A logarithm is sought within so much of its estimate: beyond lies 0, or what has no limit.
const FARTHEST: f64 = 57.0;
/// With more degrees of freedom F is that of a noise that is known.
const KNOWN: f64 = 1e5;

/// The fit with profile intervals.
pub fn profiled(problem: &Problem, mut fit: Fit) -> Fit {
    let searches = AtomicUsize::new(0);
    let ends = |estimate: &Estimate| {
        let squares = Squares::of(problem, &fit, estimate, &searches)?;
        Some([-1.0, 1.0].map(|direction| squares.end(direction)))
    };
    let found: Vec<Option<[Values; 2]>> = fit.estimates.par_iter().map(ends).collect();
    for (estimate, found) in fit.estimates.iter_mut().zip(found) {
        let Some(ends) = found else { continue };
        [estimate.low, estimate.high] = ends.map(|values| values[estimate.parameter.index()]);
        estimate.profile = Some(ends);
    }
    fit.searches = searches.into_inner();
    fit
}

/// The squares over one parameter, least over the others.
struct Squares<'a> {
    sets: Vec<&'a DataSet>,
    group: &'a Group,
    estimate: &'a Estimate,
    others: Vec<Parameter>,
    /// Those of the fit.
    least: f64,
    /// Where they exceed these a value is out: with none of the others on a bound, with one, ….
    limits: Vec<f64>,
    /// How far out the linearised interval has an end, on the scale of the estimate.
    half: f64,
    searches: &'a AtomicUsize,
}

/// The squares' excess over the least ones, as a part of their limit, at a distance from the estimate.
struct Place {
    distance: f64,
    excess: f64,
    /// All parameters there.
    values: Values,
}

impl<'a> Squares<'a> {
    /// None of a parameter whose interval is not a matter of these squares alone.
    fn of(
        problem: &'a Problem,
        fit: &'a Fit,
        estimate: &'a Estimate,
        searches: &'a AtomicUsize,
    ) -> Option<Squares<'a>> {
        let parameter = estimate.parameter;
        let group = fit.groups.iter().find(|group| group.parameters.contains(&parameter))?;
        let sets: Vec<&DataSet> = group.sets.iter().map(|&set| &problem.sets[set]).collect();
        let is_uncertain = |other: &Parameter| fit.uncertainty.covariance(*other, *other) > 0.0;
        let mut needs = Vec::new();
        for set in &sets {
            needs.extend(set.depends_on().ok()?);
        }
        needs.retain(|other| !group.parameters.contains(other));
        if sets.iter().any(|set| set.toe.is_some()) || needs.iter().any(is_uncertain) {
            return None;
        }
        let others: Vec<Parameter> = group.parameters.iter().copied().filter(|&other| other != parameter).collect();
        // A parameter that ended on a bound was searched for all the same.
        let freedom = fit.uncertainty.freedom(parameter);
        let left = freedom - group.bounded.len() as f64;
        let (freedom, share) = if left > 0.0 && left.is_finite() { (left, freedom / left) } else { (freedom, 1.0) };
        let half = quantile(freedom) * estimate.error;
        let half = if parameter.logarithmic() { half / estimate.value } else { half };
        if !(half.is_finite() && half > 0.0) {
            return None;
        }
        let limits = (0..=others.len()).map(|bounds| share * limit(bounds + 1, freedom)).collect();
        let mut squares = Squares { sets, group, estimate, others, least: 0.0, limits, half, searches };
        squares.least = squares.least(group.values[parameter.index()], &group.values, false)?.squares;
        if squares.sets.iter().any(|set| set.weight != 1.0) {
            squares.allow_for_weights();
        }
        Some(squares)
    }

    /// A weight of the user's makes the squares larger or smaller than the noise does.
    fn allow_for_weights(&mut self) {
        let near = NEAR / self.limits[0].sqrt();
        let rises = [-near, near].map(|distance| self.place(distance, &self.group.values, false).excess);
        let rise = rises.into_iter().fold(0.0, f64::max) * self.limits[0];
        self.limits.iter_mut().for_each(|limit| *limit *= rise / (NEAR * NEAR));
    }

    /// The value so many times `half` away from the estimate, within what the law allows.
    fn value(&self, distance: f64) -> f64 {
        let Estimate { parameter, value, .. } = *self.estimate;
        let moved = match parameter.logarithmic() {
            true if distance * self.half < -FARTHEST => 0.0,
            true => value * (distance * self.half).min(2.0 * FARTHEST).exp(),
            false => value + distance * self.half,
        };
        parameter.clamped(moved)
    }

    /// The least squares with a value of the parameter: from the parameters nearby and from those of the fit, and where
    /// `all` is true from all exponents too.
    fn least(&self, value: f64, near: &Values, all: bool) -> Option<Solution> {
        let data = Weighted { sets: &self.sets, weights: &self.group.weights };
        let with = |values: &Values| {
            let mut values = *values;
            values[self.estimate.parameter.index()] = value;
            values
        };
        self.searches.fetch_add(1, Ordering::Relaxed);
        let first = if all { minimise } else { search };
        let found = [first(data, &self.others, &with(near)), search(data, &self.others, &with(&self.group.values))];
        found.into_iter().flatten().min_by(|a, b| a.squares.total_cmp(&b.squares))
    }

    /// Where the law has no answer the excess is infinite.
    fn place(&self, distance: f64, near: &Values, all: bool) -> Place {
        let Some(found) = self.least(self.value(distance), near, all) else {
            return Place { distance, excess: f64::INFINITY, values: *near };
        };
        let excess = (found.squares - self.least).max(0.0) / self.limits[found.bounded.len()];
        Place { distance, excess, values: found.values }
    }

    /// The parameters at an end of the interval.
    fn end(&self, direction: f64) -> Values {
        let mut inside = Place { distance: 0.0, excess: 0.0, values: self.group.values };
        let mut outside: Option<Place> = None;
        let (mut distance, mut beyond) = (direction, 0);
        for _ in 0..TIMES {
            let place = self.place(distance, &inside.values, true);
            if place.excess <= 1.0 {
                (inside, outside, beyond) = (place, None, 0);
            } else {
                outside = outside.or(Some(place));
                beyond += 1;
            }
            if self.estimate.parameter.on_bound(self.value(distance)) || beyond > BEYOND {
                break;
            }
            distance *= FARTHER;
        }
        match outside {
            Some(outside) => self.between(inside, outside),
            None => inside.values,
        }
    }

    /// The parameters where the squares pass the limit between two places, by regula falsi with the step of Illinois:
    /// the root of a linear law's squares is a straight line.
    fn between(&self, inside: Place, outside: Place) -> Values {
        let left = |place: &Place| 1.0 - place.excess.sqrt();
        let mut values = inside.values;
        let [mut inner, mut outer] = [&inside, &outside].map(|place| (place.distance, left(place)));
        let mut last = f64::NAN;
        for _ in 0..PLACES {
            let secant = outer.0 - outer.1 * (outer.0 - inner.0) / (outer.1 - inner.1);
            let place = self.place(if secant.is_finite() { secant } else { 0.5 * (inner.0 + outer.0) }, &values, false);
            let (distance, value) = (place.distance, left(&place));
            // The other end counts for less where one moves twice.
            if value >= 0.0 {
                outer.1 *= if inner.0 == last { 0.5 } else { 1.0 };
                (inner, values) = ((distance, value), place.values);
            } else {
                inner.1 *= if outer.0 == last { 0.5 } else { 1.0 };
                outer = (distance, value);
            }
            if (distance - last).abs() < ACCURACY {
                return place.values;
            }
            last = distance;
        }
        values
    }
}

/// What squares exceed their least value by in 5 of 100 cases, with so many parameters given: n F(0.95; n, ν).
fn limit(parameters: usize, freedom: f64) -> f64 {
    let n = parameters as f64;
    if freedom > KNOWN {
        return ChiSquared::new(n).map_or(f64::INFINITY, |distribution| distribution.inverse_cdf(LEVEL));
    }
    n * FisherSnedecor::new(n, freedom).map_or(f64::INFINITY, |distribution| distribution.inverse_cdf(LEVEL))
}

impl Fit {
    /// Whether an interval that should be a profile's is linearised.
    pub fn linearised(&self) -> Vec<Parameter> {
        let is_one = |parameter: &Parameter| {
            self.estimates.iter().any(|estimate| estimate.parameter == *parameter && estimate.profile.is_none())
        };
        ALL.into_iter().filter(is_one).collect()
    }
}

#[cfg(test)]
mod tests;
