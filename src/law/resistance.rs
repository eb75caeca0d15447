//! What resists the motions of an element at rest: of it explicit hosts take artificial viscosity and hourglass
//! control.

use super::state::{ENERGIES, INVARIANTS};

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

/// The shear that a section holds whose fibres slide over one another, a Kirchhoff stress. Artificial viscosity and
/// hourglass control that held more would keep a shape that the law lets go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearLimit {
    /// µ p/2: p_t is (p/2) W_tc/⟨−I_tc⟩.
    per_pressure: f64,
    cohesion: f64,
}

impl ShearLimit {
    /// The state variables that it follows: W_tc and I_tc.
    pub const ENERGY: usize = ENERGIES + 1;
    pub const INVARIANT: usize = INVARIANTS + 1;

    /// Of a law with the exponent p of its compaction, µ and c.
    pub(super) fn new<T: Into<f64>>([p, mu, cohesion]: [T; 3]) -> ShearLimit {
        ShearLimit { per_pressure: 0.5 * mu.into() * p.into(), cohesion: cohesion.into() }
    }

    /// µ p_t + c, from the two state variables.
    #[inline(always)]
    pub fn at(&self, energy: f64, invariant: f64) -> f64 {
        let pressed = if invariant < 0.0 { energy / -invariant } else { 0.0 };
        self.per_pressure * pressed + self.cohesion
    }
}

#[cfg(test)]
mod tests {
    use crate::law::frictional::Frictional;
    use crate::law::interface::Law;
    use crate::law::parameters;

    #[test]
    fn sections_that_slide_hold_what_friction_does() {
        let preset = parameters::preset("kevlar-km2-600-frictional").expect("it exists");
        let mut values = preset.values.to_vec();
        values[12] = 0.3e6;
        let (k_tc, p, mu) = (values[1], values[2], values[11]);
        let law = Frictional::<f64>::new(&values).expect("valid");
        let limit = law.shear_limit().expect("fibres slide");
        for pressed in [1e-3, 0.05, 0.4_f64] {
            let expected = mu * 0.5 * p * k_tc * pressed.powf(p - 1.0) + 0.3e6;
            let found = limit.at(k_tc * pressed.powf(p), -pressed);
            assert!((found / expected - 1.0).abs() < 1e-14, "{found} {expected}");
        }
        assert_eq!([limit.at(0.0, 0.0), limit.at(0.0, 0.2)], [0.3e6; 2]);
        assert_eq!(Law::shear_limit(&law.elastic), None);
    }
}
