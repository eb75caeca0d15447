//! What a yarn weighs, in figures that are known of it: a slip in a size or a unit shows in them.

use super::scene::Case;
use crate::material::linear_density::LinearDensity;
use toron::host::units::UnitSystem;

/// What is said of the weights of a case; nothing of a yarn without a density.
pub fn text(units: &UnitSystem, case: &Case) -> String {
    yarn(units, case).map_or(String::new(), |yarn| yarn.text())
}

/// The yarn, of the material in the middle.
pub fn yarn(units: &UnitSystem, case: &Case) -> Option<LinearDensity> {
    let density = case.zones.inner().density?;
    Some(LinearDensity::of(case.yarn.area(), density, units))
}
