//! What a load path of `toron run` answers as a function of the law's parameters, free components in equilibrium.
//!
//! Where a component of P is prescribed, its component of F depends on the parameters θ: with S the prescribed
//! components, dF_S/dθ = −(∂P_S/∂F_S)⁻¹ ∂P_S/∂θ, and a measured y changes by ∂y/∂θ + ∂y/∂F_S dF_S/dθ.

use nalgebra::{DMatrix, DVector};

use super::parameter::{self, ALL, PARAMETERS, Parameter, Values};
use super::response::{Measured, Modes, Quantity, Response};
use toron_materials::load_path::newton::COMPONENTS;
use toron_materials::load_path::path::{LoadPath, Point};
use toron_materials::load_path::run::{self, End, Increment};
use toron_materials::material::model::{Law, Material};

/// A direction of stiffness below this fraction of the largest has none, and does not move.
const NO_STIFFNESS: f64 = 1e-9;
/// A transverse stiffness where the path's material has none, over its largest.
const FIRST_GUESS: f64 = 0.01;

/// A load path whose last step ends its increments where the data are.
#[derive(Clone, Debug)]
pub struct PathResponse {
    path: LoadPath,
    /// For each datum the fraction of the last step.
    fractions: Vec<f64>,
    measured: Measured,
    /// By component, whether P is prescribed in the last step.
    stress_controlled: [bool; 9],
}

impl PathResponse {
    /// `fractions` says for each datum where in the last step it lies, from 0 to 1.
    pub fn new(mut path: LoadPath, fractions: Vec<f64>, measured: Measured) -> PathResponse {
        let stress_controlled = path.stress_controlled(path.steps.len() - 1);
        path.points.truncate(1);
        let mut response = PathResponse { path, fractions, measured, stress_controlled };
        response.end_increments_at_data();
        response
    }

    /// The parameters that the file of the path has, and its fibre direction.
    pub fn material(&self) -> &Material {
        &self.path.points[0].material
    }

    /// The parameters of the path's own material, near which the answer is sought. A stiffness of 0 that compaction or
    /// distortion may have is replaced by a small one: with 0 nothing would depend on p, nor on what holds against it.
    pub fn trial(&self) -> Values {
        let own = self.material().values();
        let mut values: Values = std::array::from_fn(|i| own[i]);
        let largest = values[..4].iter().copied().fold(0.0, f64::max);
        for stiffness in [Parameter::KTc, Parameter::KTd] {
            let value = &mut values[stiffness.index()];
            *value = if *value == 0.0 { FIRST_GUESS * largest } else { *value };
        }
        values
    }

    pub fn subset(&self, keep: &[usize]) -> PathResponse {
        let fractions = keep.iter().map(|&i| self.fractions[i]).collect();
        let mut subset = PathResponse { fractions, ..self.clone() };
        subset.end_increments_at_data();
        subset
    }

    fn end_increments_at_data(&mut self) {
        let mut fractions = self.fractions.clone();
        fractions.sort_by(f64::total_cmp);
        fractions.dedup();
        if let Some(step) = self.path.steps.last_mut() {
            step.fractions = fractions;
        }
    }

    /// The predictions for all data, with their derivatives.
    ///
    /// # Errors
    /// Where on the path the law has no answer, and why.
    pub fn responses(&self, values: &Values) -> Result<Vec<Response>, String> {
        let mut intact = *values;
        intact[Parameter::EpsLim.index()] = 0.0;
        let fibre: [f64; 3] = self.material().fibre().into();
        let properties = parameter::properties(&intact, fibre);
        let law = toron::Hyperelastic::with(properties).map_err(|error| error.to_string())?;
        let material = Material { law: Law::Hyperelastic { law, properties }, ..self.material().clone() };
        let point = Point { name: self.path.points[0].name.clone(), material };
        let history = run::run_point(&self.path, &point, &|| {});
        if let End::Failed(reason) | End::Stopped(reason) = history.end {
            return Err(reason);
        }
        let last = self.path.steps.len() - 1;
        let measured: Vec<&Increment> = history.increments.iter().filter(|i| i.step == last && i.number > 0).collect();
        let of = |increment: &&Increment| self.response(increment, &point.material, fibre, &intact);
        let responses = measured.iter().map(of).collect::<Result<Vec<_>, _>>()?;
        let ends = &self.path.steps[last].fractions;
        let place = |fraction: &f64| ends.partition_point(|end| end < fraction);
        Ok(self.fractions.iter().map(|fraction| responses[place(fraction)]).collect())
    }

    fn response(
        &self,
        increment: &Increment,
        material: &Material,
        fibre: [f64; 3],
        values: &Values,
    ) -> Result<Response, String> {
        let modes = Modes::at(&increment.f, fibre, values)?;
        let mut response = modes.response(self.measured, values);
        let free: Vec<usize> = (0..9).filter(|&k| self.stress_controlled[k]).collect();
        if free.is_empty() {
            return Ok(response);
        }
        let refused = |code: i32| format!("the law has no tangent here: status {code}");
        let (_, tangent) = material.tangent(&increment.f, 0.0, &material.at_rest()).map_err(refused)?;
        let by_columns = |k: usize| COMPONENTS[k].0 + 3 * COMPONENTS[k].1;
        let stiffness = |row: usize, column: usize| tangent[(by_columns(row), by_columns(column))];
        let matrix = DMatrix::from_fn(free.len(), free.len(), |i, j| stiffness(free[i], free[j]));
        let rhs = DMatrix::from_fn(free.len(), PARAMETERS, |i, parameter| {
            let (row, column) = COMPONENTS[free[i]];
            let stress = Measured { quantity: Quantity::Nominal(row, column), factor: 1.0 };
            modes.response(stress, values).gradient[ALL[parameter].index()]
        });
        let decomposition = matrix.svd(true, true);
        let cut = NO_STIFFNESS * decomposition.singular_values.amax();
        let moved = -decomposition.solve(&rhs, cut)?;
        let by_gradient = DVector::from_iterator(
            free.len(),
            free.iter().map(|&k| match self.measured.quantity {
                Quantity::Energy => increment.p[COMPONENTS[k]],
                // Data along a path have no Cauchy stress.
                Quantity::Nominal(row, column) | Quantity::Cauchy(row, column) => {
                    let measured = COMPONENTS.iter().position(|&component| component == (row, column));
                    measured.map_or(0.0, |measured| stiffness(measured, k))
                }
            }),
        );
        for parameter in ALL {
            let i = parameter.index();
            response.gradient[i] += self.measured.factor * by_gradient.dot(&moved.column(i));
        }
        Ok(response)
    }
}
