//! Keys that scenes of the explicit host have in common: hourglass control and viscosity.

use toml::Spanned;

use super::medium::Control;
use toron_shared::error::Error;
use toron_shared::toml_file::{Numbers, Source};

/// Coefficients where the file gives none: an hourglass mode's share of the stiffness of a modulus, and viscosity,
/// linear and quadratic as explicit solvers have them, and of the section's shape.
const HOURGLASS: f64 = 0.1;
const VISCOSITY: [f64; 3] = [0.06, 1.5, 0.2];

/// A number from 0 on, or the default.
///
/// # Errors
/// Another number.
pub fn zero_or_more(source: &Source<'_>, key: &str, value: &Option<Spanned<f64>>, default: f64) -> Result<f64, Error> {
    match value {
        None => Ok(default),
        Some(value) if value.get_ref().is_finite() && *value.get_ref() >= 0.0 => Ok(*value.get_ref()),
        Some(value) => {
            let message = format!("{key} is {}; allowed: a finite number >= 0", value.get_ref());
            Err(source.error(value.span(), &message))
        }
    }
}

/// The coefficients.
///
/// # Errors
/// One of them is negative or no number.
pub fn control(
    source: &Source<'_>,
    hourglass: &Option<Spanned<f64>>,
    viscosity: &Option<Spanned<Numbers<3>>>,
) -> Result<Control, Error> {
    let [linear, quadratic, shape] = match viscosity {
        None => VISCOSITY,
        Some(given) => {
            for value in given.get_ref().0 {
                let single = Some(Spanned::new(given.span(), value));
                zero_or_more(source, "a coefficient of viscosity", &single, 0.0)?;
            }
            given.get_ref().0
        }
    };
    let hourglass = zero_or_more(source, "hourglass", hourglass, HOURGLASS)?;
    Ok(Control { hourglass, linear, quadratic, shape, by_direction: false })
}
