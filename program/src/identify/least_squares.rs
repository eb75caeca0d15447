//! Weighted least squares over several data sets: by Levenberg and Marquardt's method, with analytic derivatives, scaled
//! parameters and the bounds of the property table.
//!
//! A parameter θ with the least value a is sought as θ = a + s(√(u² + 1) − 1), with a scale s: whatever u the search tries, the
//! law gets a value that it allows, and it can reach the bound itself.

use levenberg_marquardt::TerminationReason::{LostPatience, Numerical};
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{DMatrix, DVector, Dyn, U1, VecStorage};

use super::data::DataSet;
use super::parameter::{PARAMETERS, Parameter, Values};

/// Exponents of compaction from which the search starts; the best answer counts.
const EXPONENTS: [f64; 5] = [1.3, 1.7, 2.2, 3.0, 5.0];
/// Where u starts for a parameter that is at its bound: at the bound itself the squares do not change with u.
const OFF_THE_BOUND: f64 = 1.0;
/// A parameter that is nearer than this to its bound, by its scale, is on it.
const ON_THE_BOUND: f64 = 1e-6;
/// How often the search leaves a bound that it should not have stopped at.
const RETURNS: usize = 3;

/// Data sets, and the weight of each datum's square.
#[derive(Clone, Copy)]
pub struct Weighted<'a> {
    pub sets: &'a [&'a DataSet],
    pub weights: &'a [f64],
}

/// The parameters of the least squares, and there the residuals and their derivatives: not weighted, all sets' data in a row.
#[derive(Clone, Debug)]
pub struct Solution {
    pub values: Values,
    /// Predicted less measured.
    pub residuals: DVector<f64>,
    /// A column for each parameter of the law, fitted or not.
    pub gradients: DMatrix<f64>,
    /// The weighted sum of squares.
    pub squares: f64,
    /// The fitted parameters that are at the least value that the law allows.
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
    let mut start = *start;
    for _ in 0..RETURNS {
        let solution = descend(data, fitted, &start)?;
        // On a bound the squares may not fall towards the allowed side.
        let downhill = |parameter: &&Parameter| {
            let column = solution.gradients.column(parameter.index());
            let terms = column.iter().zip(&solution.residuals).zip(data.weights);
            terms.map(|((gradient, residual), weight)| weight * gradient * residual).sum::<f64>() < 0.0
        };
        let Some(&parameter) = solution.bounded.iter().find(downhill) else { return Ok(solution) };
        start = solution.values;
        start[parameter.index()] = parameter.least() + Scaled::of(parameter, &start).scale;
    }
    descend(data, fitted, &start)
}

fn descend(data: Weighted, fitted: &[Parameter], start: &Values) -> Result<Solution, String> {
    let scaled: Vec<Scaled> = fitted.iter().map(|&parameter| Scaled::of(parameter, start)).collect();
    let mut values = *start;
    for scaled in &scaled {
        let value = &mut values[scaled.parameter.index()];
        *value = scaled.value(if *value > scaled.least { scaled.unknown(*value) } else { OFF_THE_BOUND });
    }
    let (residuals, gradients) = evaluate(data.sets, &values)?;
    let mut problem = Problem { data, scaled, values, residuals, gradients, refused: None };
    if !fitted.is_empty() {
        let (found, report) = LevenbergMarquardt::new().minimize(problem);
        if let Some(reason) = found.refused {
            return Err(reason);
        }
        // A search that cannot improve any more has arrived as well as one that meets a tolerance.
        if matches!(report.termination, LostPatience | Numerical(_)) {
            return Err(format!("the least squares do not converge: {:?}", report.termination));
        }
        problem = found;
    }
    let squares = problem.residuals.iter().zip(data.weights).map(|(r, weight)| weight * r * r).sum();
    let on_bound =
        |scaled: &&Scaled| problem.values[scaled.parameter.index()] - scaled.least <= ON_THE_BOUND * scaled.scale;
    let bounded = problem.scaled.iter().filter(on_bound).map(|scaled| scaled.parameter).collect();
    let Problem { values, residuals, gradients, .. } = problem;
    Ok(Solution { values, residuals, gradients, squares, bounded })
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

/// A parameter θ = least + scale (√(u² + 1) − 1).
struct Scaled {
    parameter: Parameter,
    least: f64,
    scale: f64,
}

impl Scaled {
    fn of(parameter: Parameter, start: &Values) -> Scaled {
        let least = parameter.least();
        let distance = start[parameter.index()] - least;
        Scaled { parameter, least, scale: if distance > 0.0 { distance } else { 1.0 } }
    }

    fn value(&self, u: f64) -> f64 {
        self.least + self.scale * (u.hypot(1.0) - 1.0)
    }

    fn unknown(&self, value: f64) -> f64 {
        let above = (value - self.least).max(0.0) / self.scale;
        (above * (above + 2.0)).sqrt()
    }

    /// dθ/du
    fn derivative(&self, value: f64) -> f64 {
        let u = self.unknown(value);
        self.scale * u / u.hypot(1.0)
    }
}

/// The least squares as the crate wants them: in u, residuals weighted.
struct Problem<'a> {
    data: Weighted<'a>,
    scaled: Vec<Scaled>,
    values: Values,
    residuals: DVector<f64>,
    gradients: DMatrix<f64>,
    /// Why the law has no answer at these values.
    refused: Option<String>,
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_> {
    type ResidualStorage = VecStorage<f64, Dyn, U1>;
    type JacobianStorage = VecStorage<f64, Dyn, Dyn>;
    type ParameterStorage = VecStorage<f64, Dyn, U1>;

    fn set_params(&mut self, unknowns: &DVector<f64>) {
        for (scaled, &u) in self.scaled.iter().zip(unknowns) {
            self.values[scaled.parameter.index()] = scaled.value(u);
        }
        match evaluate(self.data.sets, &self.values) {
            Ok((residuals, gradients)) => {
                (self.residuals, self.gradients) = (residuals, gradients);
                self.refused = None;
            }
            Err(reason) => self.refused = Some(reason),
        }
    }

    fn params(&self) -> DVector<f64> {
        let unknowns = self.scaled.iter().map(|scaled| scaled.unknown(self.values[scaled.parameter.index()]));
        DVector::from_iterator(self.scaled.len(), unknowns)
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let weighted = self.residuals.iter().zip(self.data.weights).map(|(r, weight)| weight.sqrt() * r);
        self.refused.is_none().then(|| DVector::from_iterator(self.residuals.len(), weighted))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let derivatives: Vec<f64> =
            self.scaled.iter().map(|scaled| scaled.derivative(self.values[scaled.parameter.index()])).collect();
        let entry = |row: usize, column: usize| {
            let gradient = self.gradients[(row, self.scaled[column].parameter.index())];
            self.data.weights[row].sqrt() * gradient * derivatives[column]
        };
        self.refused.is_none().then(|| DMatrix::from_fn(self.residuals.len(), self.scaled.len(), entry))
    }
}
