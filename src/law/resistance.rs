//! What resists the motions of an element at rest: of it explicit hosts take artificial viscosity and hourglass
//! control.

/// Moduli, ρ0 c² of waves at rest, and the stiffness against hourglass modes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resistance {
    /// Of the wave along the fibre.
    pub along: f64,
    /// Of the wave that compacts the section, at most.
    pub across: f64,
    /// Of the wave that changes the section's shape.
    pub shape: f64,
    /// What the material would hold hourglass modes with, of which control takes a part: they bend and shear an element
    /// mostly across the fibre.
    pub hourglass: f64,
}

impl Resistance {
    /// That of an isotropic solid of this bulk and shear modulus.
    pub fn isotropic<T: Into<f64>>([bulk, shear]: [T; 2]) -> Resistance {
        let (bulk, shear): (f64, f64) = (bulk.into(), shear.into());
        let modulus = bulk + 4.0 / 3.0 * shear;
        Resistance { along: modulus, across: modulus, shape: shear, hourglass: shear }
    }
}
