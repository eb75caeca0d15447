//! The properties with which the scene follows the history best: Levenberg and Marquardt's method, derivatives by
//! differences of runs, side by side.

use std::sync::Mutex;

use levenberg_marquardt::TerminationReason::{LostPatience, User};
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::DMatrix;
use nalgebra_of_least_squares as algebra;
use nalgebra_of_least_squares::{Dyn, U1, VecStorage};
use rayon::prelude::*;

use super::file::Fitted;
use super::runs::Runs;
use crate::identify::uncertainty::quantile;
use toron_shared::error::Error;

/// A difference is over this part of a property's value. A run's figures are rough in the properties, since its steps
/// and contacts come out otherwise: with a difference of 2 % the search ends on that roughness, with 5 and 10 % it
/// arrives.
const DIFFERENCE: f64 = 0.1;
/// The search ends where squares fall, or properties move, by less than these parts.
const LEAST_FALL: f64 = 1e-4;
const LEAST_MOVE: f64 = 1e-3;
/// Runs for each property and one, beside those of the differences, after which it has lost patience.
const PATIENCE: usize = 6;
/// The first step is at most this part of the properties.
const FIRST_STEP: f64 = 0.5;
/// A combination of properties that moves the figures by less than this part of what each one does is not told.
const TOLD: f64 = 1e-3;

/// What was found.
pub struct Solution {
    pub values: Vec<f64>,
    pub followed: Vec<f64>,
    /// With the scene's own values.
    pub before: Vec<f64>,
    /// The ends of each property's 95 % interval.
    pub intervals: Vec<[f64; 2]>,
    /// By how much the squares of a run at each of these ends rise, over what the linearised interval takes; none where
    /// there is no such run.
    pub rises: Vec<[Option<f64>; 2]>,
    pub correlations: DMatrix<f64>,
    /// How many data each column is worth whose residuals come in waves.
    pub independent: Vec<f64>,
    /// Whether it ended before it could tell that nothing is better.
    pub impatient: bool,
}

/// # Errors
/// A run fails, or the history does not tell the properties, or a combination of them.
pub fn minimise(runs: &Runs) -> Result<Solution, Error> {
    let fits = &runs.job.fits;
    let start: Vec<f64> = fits.iter().map(Fitted::inside).collect();
    let before = runs.follow(&fits.iter().map(|fitted| fitted.start).collect::<Vec<_>>())?;
    let followed = runs.follow(&start)?;
    let problem = Problem { runs, scales: start.clone(), unknown: start, followed, error: Mutex::new(None) };
    let method = LevenbergMarquardt::new().with_ftol(LEAST_FALL).with_xtol(LEAST_MOVE).with_gtol(LEAST_FALL);
    let (found, report) = method.with_stepbound(FIRST_STEP).with_patience(PATIENCE).minimize(problem);
    let impatient = matches!(report.termination, LostPatience);
    let values = found.values();
    let gradients = found.gradients();
    if let Some(error) = found.error.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner) {
        return Err(error);
    }
    if let User(reason) = report.termination {
        return Err(Error::Evaluation(format!("the least squares: {reason}")));
    }
    let gradients = gradients?;
    let independent = independent(runs, &found.followed);
    let (intervals, correlations, paths) = intervals(runs, &values, &found.followed, &gradients, &independent)?;
    let rises = rises(runs, [&values, &found.followed], &gradients, &intervals, &paths);
    Ok(Solution { values, followed: found.followed, before, intervals, rises, correlations, independent, impatient })
}

impl Fitted {
    /// The start, off a bound and off 0, where a property would have no scale.
    fn inside(&self) -> f64 {
        self.clamped(if self.start == 0.0 { self.size } else { self.start })
    }

    /// Within the property's bounds; a hundredth of the scene's value above one that is excluded.
    fn clamped(&self, value: f64) -> f64 {
        let property = self.property;
        let low = if property.minimum_excluded { property.minimum + 0.01 * self.start.abs() } else { property.minimum };
        value.clamp(low, property.maximum)
    }
}

struct Problem<'a> {
    runs: &'a Runs<'a>,
    scales: Vec<f64>,
    /// As the search has them, beyond bounds or not.
    unknown: Vec<f64>,
    followed: Vec<f64>,
    /// What has ended the search.
    error: Mutex<Option<Error>>,
}

impl Problem<'_> {
    fn values(&self) -> Vec<f64> {
        self.runs.job.fits.iter().zip(&self.unknown).map(|(fitted, &value)| fitted.clamped(value)).collect()
    }

    fn fail(&self, error: Error) {
        *self.error.lock().unwrap_or_else(std::sync::PoisonError::into_inner) = Some(error);
    }

    /// The residuals' derivatives by the properties over their scales.
    fn gradients(&self) -> Result<DMatrix<f64>, Error> {
        let (values, job) = (self.values(), self.runs.job);
        let residuals = job.residuals(&self.followed);
        let column = |place: usize| {
            let step = DIFFERENCE * self.scales[place].max(values[place].abs());
            let mut moved = values.clone();
            moved[place] = job.fits[place].clamped(values[place] + step);
            if moved[place] == values[place] {
                moved[place] = values[place] - step;
            }
            let change = (moved[place] - values[place]) / self.scales[place];
            let there = job.residuals(&self.runs.follow(&moved)?);
            Ok(there.iter().zip(&residuals).map(|(there, here)| (there - here) / change).collect::<Vec<f64>>())
        };
        let columns: Vec<Vec<f64>> = (0..values.len()).into_par_iter().map(column).collect::<Result<_, Error>>()?;
        Ok(DMatrix::from_fn(residuals.len(), values.len(), |row, place| columns[place][row]))
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_> {
    type ResidualStorage = VecStorage<f64, Dyn, U1>;
    type JacobianStorage = VecStorage<f64, Dyn, Dyn>;
    type ParameterStorage = VecStorage<f64, Dyn, U1>;

    fn set_params(&mut self, scaled: &algebra::DVector<f64>) {
        self.unknown = self.scales.iter().zip(scaled).map(|(scale, value)| scale * value).collect();
        match self.runs.follow(&self.values()) {
            Ok(followed) => self.followed = followed,
            Err(error) => self.fail(error),
        }
    }

    fn params(&self) -> algebra::DVector<f64> {
        let scaled = self.unknown.iter().zip(&self.scales).map(|(value, scale)| value / scale);
        algebra::DVector::from_iterator(self.unknown.len(), scaled)
    }

    fn residuals(&self) -> Option<algebra::DVector<f64>> {
        let failed = self.error.lock().is_ok_and(|error| error.is_some());
        (!failed).then(|| algebra::DVector::from_vec(self.runs.job.residuals(&self.followed)))
    }

    fn jacobian(&self) -> Option<algebra::DMatrix<f64>> {
        let gradients = self.gradients().map_err(|error| self.fail(error)).ok()?;
        let (rows, columns) = gradients.shape();
        Some(algebra::DMatrix::from_fn(rows, columns, |row, column| gradients[(row, column)]))
    }
}

/// The number of independent data that a column is worth, whose residuals follow one another with this correlation.
fn independent(runs: &Runs, followed: &[f64]) -> Vec<f64> {
    let residuals = runs.job.residuals(followed);
    let column = |residuals: &[f64]| {
        let squares: f64 = residuals.iter().map(|residual| residual * residual).sum();
        let products: f64 = residuals.windows(2).map(|pair| pair[0] * pair[1]).sum();
        let correlation = if squares > 0.0 { (products / squares).clamp(0.0, 1.0) } else { 0.0 };
        residuals.len() as f64 * (1.0 - correlation) / (1.0 + correlation)
    };
    residuals.chunks(runs.job.times.len()).map(|residuals| column(residuals).max(1.0)).collect()
}

/// Runs at the ends of the intervals, where the other properties are those of the least squares, linearised: the rise of
/// their squares over the linearised rise. It is 1 where the law's answer is linear in the properties. A run that fails
/// says nothing.
fn rises(
    runs: &Runs,
    [values, followed]: [&[f64]; 2],
    gradients: &DMatrix<f64>,
    intervals: &[[f64; 2]],
    paths: &DMatrix<f64>,
) -> Vec<[Option<f64>; 2]> {
    let fits = &runs.job.fits;
    let squares =
        |followed: &[f64]| runs.job.residuals(followed).iter().map(|residual| residual * residual).sum::<f64>();
    let least = squares(followed);
    let rise = |(place, end): (usize, f64)| {
        let along = |i: usize| values[i] + paths[(i, place)] * (end - values[place]);
        let there: Vec<f64> = (0..fits.len()).map(|i| fits[i].clamped(along(i))).collect();
        let moved = |i: usize| (there[i] - values[i]) / fits[i].inside();
        let linear = (gradients * DMatrix::from_fn(fits.len(), 1, |i, _| moved(i))).norm_squared();
        let found = squares(&runs.follow(&there).ok()?) - least;
        (linear > 0.0).then(|| found / linear)
    };
    let ends: Vec<(usize, f64)> =
        intervals.iter().enumerate().flat_map(|(place, ends)| ends.map(|end| (place, end))).collect();
    let found: Vec<Option<f64>> = ends.into_par_iter().map(rise).collect();
    found.chunks(2).map(|pair| [pair[0], pair[1]]).collect()
}

/// What is told of all properties, linearised: intervals, correlations, and by how much each property (a row) moves with
/// another (a column) where the squares are least.
type Linearised = (Vec<[f64; 2]>, DMatrix<f64>, DMatrix<f64>);

/// Linearised: the deviations are those that the residuals have where they are larger than the given ones, and the data
/// count for as many as are independent.
fn intervals(
    runs: &Runs,
    values: &[f64],
    followed: &[f64],
    gradients: &DMatrix<f64>,
    independent: &[f64],
) -> Result<Linearised, Error> {
    let (job, count) = (runs.job, values.len());
    let norms: Vec<f64> = gradients.column_iter().map(|column| column.norm()).collect();
    let names = || job.fits.iter().map(|fitted| fitted.property.name);
    let largest = norms.iter().copied().fold(0.0, f64::max);
    if let Some((name, _)) = names().zip(&norms).find(|(_, norm)| **norm <= TOLD * TOLD * largest) {
        let message =
            format!("the history does not tell {name}: a run with another one is the same; allowed: fits without it");
        return Err(Error::Evaluation(message));
    }
    let unit = DMatrix::from_fn(gradients.nrows(), count, |row, column| gradients[(row, column)] / norms[column]);
    let normal = unit.transpose() * &unit;
    let inverse =
        normal.clone().try_inverse().filter(|inverse| (0..count).all(|i| inverse[(i, i)] < 1.0 / (TOLD * TOLD)));
    let Some(inverse) = inverse else {
        let names = names().collect::<Vec<_>>().join(", ");
        let message = format!("the history tells only a combination of {names}; allowed: fits with fewer of them");
        return Err(Error::Evaluation(message));
    };
    let worth: f64 = independent.iter().sum();
    let freedom = (worth - count as f64).max(1.0);
    let variance = job.misfit(followed).powi(2).max(1.0) * job.data() as f64 / worth;
    let interval = |i: usize| {
        let scale = job.fits[i].inside();
        let half = quantile(freedom) * (variance * inverse[(i, i)]).sqrt() / norms[i] * scale;
        let property = job.fits[i].property;
        [values[i] - half, values[i] + half].map(|end| end.clamp(property.minimum, property.maximum))
    };
    let correlations =
        DMatrix::from_fn(count, count, |i, j| inverse[(i, j)] / (inverse[(i, i)] * inverse[(j, j)]).sqrt());
    let length = |i: usize| job.fits[i].inside() / norms[i];
    let paths = DMatrix::from_fn(count, count, |i, j| inverse[(i, j)] / inverse[(j, j)] * length(i) / length(j));
    Ok(((0..count).map(interval).collect(), correlations, paths))
}
