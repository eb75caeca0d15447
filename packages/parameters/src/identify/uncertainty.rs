//! How sure the parameters are: 95 % intervals and correlations.
//!
//! The error of every parameter is, to first order, a sum of the errors of all data: with J the derivatives and W the
//! weights of the data that it is fitted to, (JᵀWJ)⁻¹JᵀW times their errors, and for what was fitted before,
//! −(JᵀWJ)⁻¹JᵀW J' times the errors of those parameters. From the row of these factors follow variances and covariances
//! whatever the weights are. Where the noise of a set is estimated, Student's t has the degrees of freedom that Welch
//! and Satterthwaite's formula gives.

use std::ops::Range;

use nalgebra::{DMatrix, DVector, RowDVector};
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

use super::least_squares::Solution;
use super::parameter::{ALL, PARAMETERS, Parameter, Values};
use toron_strikes::confidence::LEVEL;

/// A parameter and its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    pub parameter: Parameter,
    pub value: f64,
    pub error: f64,
    pub low: f64,
    pub high: f64,
    /// Whether data sets tell it; else a deviation that was given.
    pub fitted: bool,
    /// At the least value that the law allows.
    pub bounded: bool,
    /// Of a [profile](super::profile) interval all parameters at its two ends; none where it is linearised.
    pub profile: Option<[Values; 2]>,
}

/// A source of errors: a data set, a constant that was given with its deviation, or the zero that a data set counts
/// from.
#[derive(Clone, Copy, Debug)]
pub struct Source {
    /// Degrees of freedom of the estimate of its noise; infinite where the noise is known.
    pub freedom: f64,
}

/// The errors of the parameters by those of the data.
#[derive(Clone, Debug)]
pub struct Uncertainty {
    /// A row for each parameter, a column for each datum of all sets, for each constant, and for each set's zero.
    factors: DMatrix<f64>,
    /// Of each column.
    variances: Vec<f64>,
    /// The columns of each source.
    sources: Vec<(Range<usize>, Source)>,
    /// The first of the zeros among the sources.
    zeros: usize,
    /// For parameters on a bound, where the data alone would put them.
    unbounded: [Option<f64>; PARAMETERS],
}

impl Uncertainty {
    /// Nothing fitted yet: sets of these lengths, and known values that are uncertain.
    pub fn new(lengths: impl Iterator<Item = usize>, known: &[Values]) -> Uncertainty {
        let mut sources = Vec::new();
        let mut columns = 0;
        let lengths: Vec<usize> = lengths.collect();
        let sets = lengths.len();
        for length in lengths.into_iter().chain(std::iter::repeat_n(1, known.len() + sets)) {
            sources.push((columns..columns + length, Source { freedom: f64::INFINITY }));
            columns += length;
        }
        let mut factors = DMatrix::zeros(PARAMETERS, columns);
        for (column, values) in (columns - known.len() - sets..).zip(known) {
            factors.column_mut(column).copy_from_slice(values);
        }
        Uncertainty {
            factors,
            variances: vec![1.0; columns],
            zeros: sources.len() - sets,
            sources,
            unbounded: [None; PARAMETERS],
        }
    }

    /// The deviations of a set's data and how well they are known.
    pub fn describe(&mut self, set: usize, source: Source, deviations: &[f64]) {
        self.sources[set].1 = source;
        for (column, deviation) in self.sources[set].0.clone().zip(deviations) {
            self.variances[column] = deviation * deviation;
        }
    }

    /// Adds the parameters that were fitted to some sets.
    pub fn add(&mut self, sets: &[usize], solution: &Solution, weights: &[f64], parameters: &[Parameter]) {
        let columns: Vec<usize> = sets.iter().flat_map(|&set| self.sources[set].0.clone()).collect();
        // What lies on a bound is let go of here: where it might be makes the others less sure, and its interval ends
        // where the data alone would have it.
        self.add_rows(&columns, solution, weights, parameters, parameters);
        for &parameter in &solution.bounded {
            let row = self.factors.row(parameter.index());
            let moved: f64 = columns.iter().enumerate().map(|(i, &c)| -row[c] * solution.residuals[i]).sum();
            self.unbounded[parameter.index()] = Some(solution.values[parameter.index()] + moved);
        }
    }

    /// Adds to the errors of parameters that were just fitted what the zero of one of their sets adds: by one standard
    /// deviation of it the predictions change by `shift`. Given the zero, the parameters have the error that they have
    /// already; the two make the error of a fit in which the zero is sought as well.
    pub fn add_zero(
        &mut self,
        set: usize,
        source: Source,
        shift: &DVector<f64>,
        solution: &Solution,
        weights: &[f64],
        parameters: &[Parameter],
    ) {
        let Some(factors) = inverse(solution, weights, parameters) else { return };
        let (columns, own) = &mut self.sources[self.zeros + set];
        *own = source;
        for (change, parameter) in (-factors * shift).iter().zip(parameters) {
            self.factors[(parameter.index(), columns.start)] = *change;
        }
    }

    fn add_rows(
        &mut self,
        columns: &[usize],
        solution: &Solution,
        weights: &[f64],
        free: &[Parameter],
        own: &[Parameter],
    ) {
        let Some(factors) = inverse(solution, weights, free) else { return };
        for (row, &parameter) in free.iter().enumerate() {
            let mut line = RowDVector::zeros(self.factors.ncols());
            for (i, &column) in columns.iter().enumerate() {
                line[column] = factors[(row, i)];
            }
            for before in ALL.into_iter().filter(|other| !own.contains(other)) {
                let gradient = solution.gradients.column(before.index());
                let by_before = -factors.row(row).transpose().dot(&gradient);
                line += by_before * self.factors.row(before.index());
            }
            self.factors.set_row(parameter.index(), &line);
        }
    }

    /// The covariance of two parameters.
    pub fn covariance(&self, a: Parameter, b: Parameter) -> f64 {
        let [a, b] = [a, b].map(|parameter| self.factors.row(parameter.index()));
        self.variances.iter().enumerate().map(|(i, variance)| a[i] * b[i] * variance).sum()
    }

    /// Degrees of freedom of a parameter's variance.
    pub fn freedom(&self, parameter: Parameter) -> f64 {
        let row = self.factors.row(parameter.index());
        let part = |columns: &Range<usize>| columns.clone().map(|i| row[i] * row[i] * self.variances[i]).sum::<f64>();
        let sum: f64 = self.sources.iter().map(|(columns, _)| part(columns)).sum();
        let parts = self.sources.iter().map(|(columns, source)| (part(columns) / sum).powi(2) / source.freedom);
        1.0 / parts.sum::<f64>()
    }

    /// The intervals of the parameters that have an error, and their correlations.
    pub fn estimates(
        &self,
        values: &[Option<f64>; PARAMETERS],
        fitted: &[Parameter],
        bounded: &[Parameter],
    ) -> (Vec<Estimate>, DMatrix<f64>) {
        let mut estimates = Vec::new();
        for parameter in ALL {
            let Some(value) = values[parameter.index()] else { continue };
            let error = self.covariance(parameter, parameter).sqrt();
            if error > 0.0 || fitted.contains(&parameter) {
                let on_bound = bounded.contains(&parameter);
                let [low, high] = self.interval(parameter, value, error);
                let fitted = fitted.contains(&parameter);
                estimates.push(Estimate {
                    parameter,
                    value,
                    error,
                    low,
                    high,
                    fitted,
                    bounded: on_bound,
                    profile: None,
                });
            }
        }
        let correlation = |i: usize, j: usize| {
            let (a, b): (&Estimate, &Estimate) = (&estimates[i], &estimates[j]);
            let product = a.error * b.error;
            if product > 0.0 { self.covariance(a.parameter, b.parameter) / product } else { f64::from(i == j) }
        };
        let correlations = DMatrix::from_fn(estimates.len(), estimates.len(), correlation);
        (estimates, correlations)
    }

    fn interval(&self, parameter: Parameter, value: f64, error: f64) -> [f64; 2] {
        if error == 0.0 {
            return [value; 2];
        }
        let half = quantile(self.freedom(parameter)) * error;
        let centre = self.unbounded[parameter.index()].unwrap_or(value);
        let ends = if parameter.logarithmic() && centre > 0.0 {
            [centre * (-half / centre).exp(), centre * (half / centre).exp()]
        } else {
            [centre - half, centre + half]
        };
        ends.map(|end| parameter.clamped(end))
    }
}

/// The two-sided quantile of Student's t, of the normal distribution for infinite degrees of freedom.
pub fn quantile(freedom: f64) -> f64 {
    let upper = 0.5 + 0.5 * LEVEL;
    // Beyond this the two agree to five digits.
    if freedom > 1e5 {
        return Normal::standard().inverse_cdf(upper);
    }
    StudentsT::new(0.0, 1.0, freedom).map_or(f64::INFINITY, |student| student.inverse_cdf(upper))
}

/// (JᵀWJ)⁻¹JᵀW, for the columns of these parameters.
fn inverse(solution: &Solution, weights: &[f64], free: &[Parameter]) -> Option<DMatrix<f64>> {
    if free.is_empty() {
        return None;
    }
    let roots: Vec<f64> = weights.iter().map(|weight| weight.sqrt()).collect();
    let weighted = DMatrix::from_fn(weights.len(), free.len(), |row, column| {
        roots[row] * solution.gradients[(row, free[column].index())]
    });
    let sizes: Vec<f64> = weighted.column_iter().map(|column| column.norm().max(f64::MIN_POSITIVE)).collect();
    let scaled = DMatrix::from_fn(weights.len(), free.len(), |row, column| weighted[(row, column)] / sizes[column]);
    let decomposition = scaled.svd(true, true);
    let pseudo_inverse = decomposition.pseudo_inverse(f64::EPSILON * weights.len() as f64).ok()?;
    Some(DMatrix::from_fn(free.len(), weights.len(), |row, column| {
        pseudo_inverse[(row, column)] * roots[column] / sizes[row]
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_tables() {
        for (freedom, expected) in
            [(1.0, 12.7062), (2.0, 4.302653), (10.0, 2.228139), (38.0, 2.024394), (100.0, 1.983972), (1e9, 1.959964)]
        {
            approx::assert_relative_eq!(quantile(freedom), expected, max_relative = 1e-5);
        }
    }
}
