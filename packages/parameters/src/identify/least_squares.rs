//! Weighted least squares over several data sets: by Levenberg and Marquardt's method, with analytic derivatives,
//! scaled parameters and the bounds of the property table.
//!
//! The method itself knows no bounds. A trial beyond one is evaluated on it; what ends there is fixed, the rest is
//! sought again, and a parameter is let go of where the squares would fall on the allowed side.

use levenberg_marquardt::TerminationReason::{LostPatience, Numerical};
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{DMatrix, DVector};
use nalgebra_of_least_squares as algebra;
use nalgebra_of_least_squares::{Dyn, U1, VecStorage};

use super::data::DataSet;
use super::parameter::{PARAMETERS, Parameter, Values};

/// Exponents of compaction from which the search starts; the best answer counts.
const EXPONENTS: [f64; 5] = [1.3, 1.7, 2.2, 3.0, 5.0];
/// How often a parameter is let go of that has been fixed on a bound.
const RETURNS: usize = 3;
/// What a trial counts that the law has no answer to, over the residuals at the start.
const REFUSED: f64 = 10.0;

/// Data sets, and the weight of each datum's square.
#[derive(Clone, Copy)]
pub struct Weighted<'a> {
    pub sets: &'a [&'a DataSet],
    pub weights: &'a [f64],
}

/// The parameters of the least squares, and there the residuals and their derivatives: not weighted, all sets' data in
/// a row.
#[derive(Clone, Debug)]
pub struct Solution {
    pub values: Values,
    /// Predicted less measured.
    pub residuals: DVector<f64>,
    /// A column for each parameter of the law, fitted or not.
    pub gradients: DMatrix<f64>,
    /// The weighted sum of squares.
    pub squares: f64,
    /// The fitted parameters that are on a bound of the property table.
    pub bounded: Vec<Parameter>,
}

/// The parameters `fitted` that make the weighted squares least; the other values are those of `start`.
///
/// # Errors
/// The law has no answer, or the search does not converge.
pub fn minimise(data: Weighted, fitted: &[Parameter], start: &Values) -> Result<Solution, String> {
    if !fitted.contains(&Parameter::P) {
        return search(data, fitted, start);
    }
    let others: Vec<Parameter> = fitted.iter().copied().filter(|&other| other != Parameter::P).collect();
    let mut best: Result<Solution, String> = search(data, fitted, start);
    for p in EXPONENTS {
        let mut values = *start;
        values[Parameter::P.index()] = p;
        // k_tc, an extrapolation to |I_tc| = 1, changes by orders of magnitude with p.
        let found = search(data, &others, &values).and_then(|near| search(data, fitted, &near.values));
        best = match (best, found) {
            (Ok(best), Ok(found)) if found.squares < best.squares => Ok(found),
            (Err(_), found) => found,
            (best, _) => best,
        };
    }
    best
}

/// As [`minimise`], from one start only.
///
/// # Errors
/// The law has no answer, or the search does not converge.
pub fn search(data: Weighted, fitted: &[Parameter], start: &Values) -> Result<Solution, String> {
    let mut values = *start;
    let mut free = fitted.to_vec();
    let mut bounded: Vec<Parameter> = Vec::new();
    let mut returns = 0;
    loop {
        let mut solution = descend(data, &free, &values)?;
        values = solution.values;
        let (stopped, kept): (Vec<Parameter>, Vec<Parameter>) =
            free.iter().partition(|p| p.on_bound(values[p.index()]));
        if !stopped.is_empty() {
            (free, bounded) = (kept, [bounded, stopped].concat());
            continue;
        }
        let inwards = |parameter: &&Parameter| {
            let column = solution.gradients.column(parameter.index());
            let terms = column.iter().zip(&solution.residuals).zip(data.weights);
            let slope: f64 = terms.map(|((gradient, residual), weight)| weight * gradient * residual).sum();
            slope * parameter.inwards(values[parameter.index()]) < 0.0
        };
        match bounded.iter().find(inwards).copied() {
            Some(parameter) if returns < RETURNS => {
                returns += 1;
                bounded.retain(|&other| other != parameter);
                free.push(parameter);
                let value = &mut values[parameter.index()];
                *value += parameter.inwards(*value) * parameter.trial_step();
            }
            _ => {
                solution.bounded = bounded;
                return Ok(solution);
            }
        }
    }
}

fn descend(data: Weighted, free: &[Parameter], start: &Values) -> Result<Solution, String> {
    let values = start_inside(free, start);
    let scales = free.iter().map(|parameter| values[parameter.index()].abs()).collect();
    let (residuals, gradients) = evaluate(data.sets, &values)?;
    let mut problem = Problem { data, free, scales, unknown: values, residuals, gradients, refused: None };
    if !free.is_empty() {
        let (found, report) = LevenbergMarquardt::new().minimize(problem);
        // A search that cannot improve any more has arrived as well as one that meets a tolerance.
        if let LostPatience | Numerical(_) = report.termination {
            return Err(format!("the least squares do not converge: {:?}", report.termination));
        }
        if let Some(reason) = found.refused {
            return Err(reason);
        }
        problem = found;
    }
    let squares: f64 = problem.residuals.iter().zip(data.weights).map(|(r, weight)| weight * r * r).sum();
    if !(squares.is_finite() && problem.gradients.iter().all(|gradient| gradient.is_finite())) {
        return Err("the least squares overflow: the data are too large or too small in these units".to_string());
    }
    let values = within(free, &problem.unknown);
    let Problem { residuals, gradients, .. } = problem;
    Ok(Solution { values, residuals, gradients, squares, bounded: Vec::new() })
}

/// The start, off the bounds: on one, a parameter would have no scale.
fn start_inside(free: &[Parameter], start: &Values) -> Values {
    let mut values = *start;
    for parameter in free {
        let value = &mut values[parameter.index()];
        if parameter.on_bound(*value) {
            *value = parameter.clamped(*value);
            *value += parameter.inwards(*value) * parameter.trial_step();
        }
    }
    values
}

fn within(free: &[Parameter], unknown: &Values) -> Values {
    let mut values = *unknown;
    for parameter in free {
        values[parameter.index()] = parameter.clamped(values[parameter.index()]);
    }
    values
}

/// Predicted less measured, and the derivatives by all parameters.
fn evaluate(sets: &[&DataSet], values: &Values) -> Result<(DVector<f64>, DMatrix<f64>), String> {
    let (mut residuals, mut gradients) = (Vec::new(), Vec::new());
    for set in sets {
        let responses = set.loading.responses(values).map_err(|reason| format!("data set {}: {reason}", set.name))?;
        for (response, measured) in responses.iter().zip(&set.ordinate.values) {
            residuals.push(response.value - measured);
            gradients.extend(response.gradient);
        }
    }
    let gradients = DMatrix::from_row_slice(residuals.len(), PARAMETERS, &gradients);
    Ok((DVector::from_vec(residuals), gradients))
}

/// The least squares as the crate takes them: parameters over their scales, residuals times the roots of the weights.
struct Problem<'a> {
    data: Weighted<'a>,
    free: &'a [Parameter],
    scales: Vec<f64>,
    /// As the search has them, beyond bounds or not.
    unknown: Values,
    residuals: DVector<f64>,
    gradients: DMatrix<f64>,
    /// Why the law has no answer at these values.
    refused: Option<String>,
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_> {
    type ResidualStorage = VecStorage<f64, Dyn, U1>;
    type JacobianStorage = VecStorage<f64, Dyn, Dyn>;
    type ParameterStorage = VecStorage<f64, Dyn, U1>;

    fn set_params(&mut self, scaled: &algebra::DVector<f64>) {
        for ((parameter, scale), value) in self.free.iter().zip(&self.scales).zip(scaled) {
            self.unknown[parameter.index()] = value * scale;
        }
        match evaluate(self.data.sets, &within(self.free, &self.unknown)) {
            Ok((residuals, gradients)) => {
                (self.residuals, self.gradients) = (residuals, gradients);
                self.refused = None;
            }
            // Large residuals: the search tries a shorter step.
            Err(reason) => {
                let largest = self.data.sets.iter().map(|set| set.largest()).fold(0.0, f64::max);
                self.residuals.fill(REFUSED * largest);
                self.refused = Some(reason);
            }
        }
    }

    fn params(&self) -> algebra::DVector<f64> {
        let scaled =
            self.free.iter().zip(&self.scales).map(|(parameter, scale)| self.unknown[parameter.index()] / scale);
        algebra::DVector::from_iterator(self.free.len(), scaled)
    }

    fn residuals(&self) -> Option<algebra::DVector<f64>> {
        let weighted = self.residuals.iter().zip(self.data.weights).map(|(r, weight)| weight.sqrt() * r);
        Some(algebra::DVector::from_iterator(self.residuals.len(), weighted))
    }

    fn jacobian(&self) -> Option<algebra::DMatrix<f64>> {
        let entry = |row: usize, column: usize| {
            let gradient = self.gradients[(row, self.free[column].index())];
            self.data.weights[row].sqrt() * gradient * self.scales[column]
        };
        self.refused.is_none().then(|| algebra::DMatrix::from_fn(self.residuals.len(), self.free.len(), entry))
    }
}
