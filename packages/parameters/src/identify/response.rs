//! What the law answers at a deformation gradient, as a function of its parameters: an energy or a stress, and its
//! derivatives.
//!
//! Energies and stresses are linear in the stiffnesses, so the law is evaluated once with all stiffnesses 1: the
//! contribution of each mode is the derivative by its stiffness. The exponent p occurs in compaction only, where W_tc =
//! k_tc i^p (Eq. 4.12).

use nalgebra::Matrix3;

use super::parameter::{self, Parameter, STIFFNESSES, Values};
use toron::Request;
use toron::law::state::{ENERGIES, HYPERELASTIC_STATE, INVARIANTS};
use toron::law::status;
use toron::law::stress::matrix;

/// What is measured, per unit of what the data say: an area that makes a force of a stress, or −1 for a pressure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    pub quantity: Quantity,
    pub factor: f64,
}

/// What the law answers with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Energy per reference volume.
    Energy,
    /// A component of the first Piola–Kirchhoff stress: force over reference area.
    Nominal(usize, usize),
    /// A component of the Cauchy stress: force over current area.
    Cauchy(usize, usize),
}

/// A prediction and its derivatives by all parameters.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Response {
    pub value: f64,
    pub gradient: Values,
}

/// Energies and stresses of each mode at a deformation gradient, with all stiffnesses 1.
#[derive(Clone, Copy, Debug)]
pub struct Modes {
    f: Matrix3<f64>,
    energies: [f64; 4],
    /// Second Piola–Kirchhoff.
    stresses: [Matrix3<f64>; 4],
    /// ⟨−I_tc⟩.
    compaction: f64,
    p: f64,
}

impl Modes {
    /// Evaluates the law at `f` with the exponent of `values`.
    ///
    /// # Errors
    /// Why the law cannot be evaluated.
    pub fn at(f: &Matrix3<f64>, fibre: [f64; 3], values: &Values) -> Result<Modes, String> {
        let p = values[Parameter::P.index()];
        let mut unit = [0.0; parameter::PARAMETERS];
        for stiffness in STIFFNESSES {
            unit[stiffness.index()] = 1.0;
        }
        unit[Parameter::P.index()] = p;
        let law = parameter::law(&unit, fibre).map_err(|error| error.to_string())?;
        let point = law.point(f, &[0.0; HYPERELASTIC_STATE], Request::ALL);
        if point.status != status::OK {
            return Err(status::meaning(point.status).unwrap_or("the law refuses this deformation").to_string());
        }
        let energies = std::array::from_fn(|mode| point.state[ENERGIES + mode]);
        let compaction = (-point.state[INVARIANTS + 1]).max(0.0);
        Ok(Modes { f: *f, energies, stresses: point.modes.map(|s| matrix(&s)), compaction, p })
    }

    /// The measured quantity with these stiffnesses, and its derivatives at this deformation gradient.
    pub fn response(&self, measured: Measured, values: &Values) -> Response {
        let mut response = Response::default();
        for (mode, stiffness) in STIFFNESSES.into_iter().enumerate() {
            let part = measured.factor * self.part(measured.quantity, mode);
            response.gradient[stiffness.index()] = part;
            response.value += values[stiffness.index()] * part;
        }
        let compaction = values[Parameter::KTc.index()] * response.gradient[Parameter::KTc.index()];
        if compaction != 0.0 {
            // d(i^p)/dp = i^p ln i, d(p i^(p−1))/dp = p i^(p−1) (1/p + ln i).
            let own = if measured.quantity == Quantity::Energy { 0.0 } else { 1.0 / self.p };
            response.gradient[Parameter::P.index()] = compaction * (own + self.compaction.ln());
        }
        response
    }

    fn part(&self, quantity: Quantity, mode: usize) -> f64 {
        match quantity {
            Quantity::Energy => self.energies[mode],
            Quantity::Nominal(i, j) => (self.f * self.stresses[mode])[(i, j)],
            Quantity::Cauchy(i, j) => {
                (self.f * self.stresses[mode] * self.f.transpose())[(i, j)] / self.f.determinant()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use toron::law::stress::first_piola_kirchhoff;

    const VALUES: Values = [82341.0, 1055.0, 2.2, 649.74, 20.0, 0.0458, 1.8, 0.3];

    fn gradient() -> Matrix3<f64> {
        Matrix3::new(1.02, 0.03, 0.0, 0.01, 0.93, 0.02, 0.0, -0.01, 0.9)
    }

    fn value(quantity: Quantity, values: &Values) -> f64 {
        let modes = Modes::at(&gradient(), [1.0, 0.1, 0.0], values).expect("a law");
        modes.response(Measured { quantity, factor: -2.0 }, values).value
    }

    #[test]
    fn a_response_is_what_the_law_answers() {
        let law = parameter::law(&VALUES, [1.0, 0.1, 0.0]).expect("a law");
        let point = law.point(&gradient(), &[0.0; HYPERELASTIC_STATE], Request::ALL);
        let energy: f64 = point.state[..INVARIANTS].iter().sum();
        let nominal = first_piola_kirchhoff(&point.stress, &gradient());
        for (quantity, expected) in [
            (Quantity::Energy, energy),
            (Quantity::Nominal(2, 2), nominal.m33),
            (Quantity::Nominal(0, 1), nominal.m12),
            (Quantity::Cauchy(1, 1), point.stress[1]),
        ] {
            approx::assert_relative_eq!(value(quantity, &VALUES), -2.0 * expected, max_relative = 1e-12);
        }
    }

    #[test]
    fn derivatives_are_those_of_differences() {
        for quantity in [Quantity::Energy, Quantity::Nominal(2, 2), Quantity::Nominal(1, 0), Quantity::Cauchy(1, 1)] {
            let modes = Modes::at(&gradient(), [1.0, 0.1, 0.0], &VALUES).expect("a law");
            let response = modes.response(Measured { quantity, factor: -2.0 }, &VALUES);
            for parameter in parameter::ALL {
                let i = parameter.index();
                let step = 1e-5 * VALUES[i];
                let moved = |step: f64| {
                    let mut values = VALUES;
                    values[i] += step;
                    value(quantity, &values)
                };
                let difference = (moved(step) - moved(-step)) / (2.0 * step);
                let size = response.value.abs() / VALUES[i];
                approx::assert_abs_diff_eq!(response.gradient[i], difference, epsilon = 1e-7 * size);
            }
        }
    }

    #[test]
    fn at_rest_nothing_depends_on_anything() {
        let modes = Modes::at(&Matrix3::identity(), [1.0, 0.0, 0.0], &VALUES).expect("a law");
        let response = modes.response(Measured { quantity: Quantity::Nominal(2, 2), factor: 1.0 }, &VALUES);
        assert_eq!(response, Response::default());
    }

    #[test]
    fn a_deformation_that_the_law_refuses_is_an_error() {
        assert!(Modes::at(&Matrix3::from_diagonal_element(-1.0), [1.0, 0.0, 0.0], &VALUES).is_err());
    }
}
