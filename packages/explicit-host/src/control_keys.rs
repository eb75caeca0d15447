//! Keys that scenes of the explicit host have in common: hourglass control and viscosity.

use super::medium::Control;
use toron_shared::checked::{Checked, NotNegative, value};
use toron_shared::toml_file::Numbers;

/// Coefficients where the file gives none: an hourglass mode's share of the stiffness of a modulus, and viscosity,
/// linear and quadratic as explicit solvers have them, and of the section's shape.
const HOURGLASS: f64 = 0.1;
const VISCOSITY: [f64; 3] = [0.06, 1.5, 0.2];

/// The coefficients.
pub fn control(hourglass: &Option<NotNegative>, viscosity: &Option<Numbers<3, NotNegative>>) -> Control {
    let given = viscosity.map(|Numbers(coefficients)| coefficients.map(|coefficient| coefficient.value()));
    let [linear, quadratic, shape] = given.unwrap_or(VISCOSITY);
    Control { hourglass: value(hourglass).unwrap_or(HOURGLASS), linear, quadratic, shape, by_direction: false }
}
