//! The properties of the hyperelastic law that data can tell.

use toron::law::parameters::{HYPERELASTIC, Property};
use toron::{Hyperelastic, Properties};

/// Number of parameters: the properties of the law before the fibre direction.
pub const PARAMETERS: usize = 8;

/// A value for each parameter, in the order of the law's properties.
pub type Values = [f64; PARAMETERS];

/// A property of the law, by its index in the property table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Parameter {
    KEl,
    KTc,
    P,
    KTd,
    KLd,
    EpsLim,
    Alpha,
    Beta,
}

use Parameter::{Alpha, Beta, EpsLim, KEl, KLd, KTc, KTd, P};

/// All parameters, in the order of the property table.
pub const ALL: [Parameter; PARAMETERS] = [KEl, KTc, P, KTd, KLd, EpsLim, Alpha, Beta];

/// The stiffnesses in the order of the law's modes.
pub const STIFFNESSES: [Parameter; 4] = [KEl, KTc, KTd, KLd];

impl Parameter {
    /// The parameter of this name in the property table.
    pub fn named(name: &str) -> Option<Parameter> {
        ALL.into_iter().find(|parameter| parameter.name() == name)
    }

    pub fn index(self) -> usize {
        self as usize
    }

    /// Its row of the property table.
    pub fn property(self) -> &'static Property {
        &HYPERELASTIC[self.index()]
    }

    pub fn name(self) -> &'static str {
        self.property().name
    }

    /// The value moved into what the property table allows.
    pub fn clamped(self, value: f64) -> f64 {
        value.clamp(self.least(), self.property().maximum)
    }

    /// The least value that the law takes.
    pub fn least(self) -> f64 {
        let property = self.property();
        if property.minimum_excluded { property.minimum.next_up() } else { property.minimum }
    }

    /// Whether a value is on a bound of the property table, or beyond it.
    pub fn on_bound(self, value: f64) -> bool {
        value <= self.least() || value >= self.property().maximum
    }

    /// The sign of the direction from the bound that is nearer into what is allowed.
    pub fn inwards(self, value: f64) -> f64 {
        if value <= 0.5 * (self.least() + self.property().maximum) { 1.0 } else { -1.0 }
    }

    /// A step off the bound, from which a search finds its way.
    pub fn trial_step(self) -> f64 {
        match self {
            EpsLim => 0.01,
            P => 0.5,
            _ => 1.0,
        }
    }

    /// Whether its estimate is distributed evenly on a logarithmic scale: ln W_tc = ln k_tc + p ln|I_tc| is linear in
    /// ln k_tc and p, and k_tc is an extrapolation to |I_tc| = 1.
    pub fn logarithmic(self) -> bool {
        self == KTc
    }

    /// What kind of data tell it, for messages.
    pub fn told_by(self) -> &'static str {
        match self {
            KEl => "a tensile test, or the [fibre]'s modulus",
            KTc | P => "energy or pressure in compaction, or transverse compression",
            KTd => "transverse compression",
            KLd => "a path with longitudinal shear",
            EpsLim => "failure points, or the [fibre]'s strain at failure",
            Alpha => "failure points at several compactions",
            Beta => "failure points at several distortions",
        }
    }
}

/// The law's properties with these parameters and this fibre direction.
pub fn properties(&[k_el, k_tc, p, k_td, k_ld, eps_lim, alpha, beta]: &Values, fibre: [f64; 3]) -> Properties<f64> {
    Properties { k_el, k_tc, p, k_td, k_ld, eps_lim, alpha, beta, fibre }
}

/// The law with these parameters and this fibre direction.
///
/// # Errors
/// The first property that is wrong.
pub fn law(values: &Values, fibre: [f64; 3]) -> Result<Hyperelastic<f64>, toron::Error> {
    Hyperelastic::with(properties(values, fibre))
}

#[cfg(test)]
mod tests {
    use super::*;
    use toron::law::parameters::FIBRE;

    #[test]
    fn parameters_are_the_rows_of_the_property_table() {
        let names = ["k_el", "k_tc", "p", "k_td", "k_ld", "eps_lim", "alpha", "beta"];
        assert_eq!(ALL.map(Parameter::name), names);
        assert_eq!(ALL.map(Parameter::index), [0, 1, 2, 3, 4, 5, 6, 7]);
        assert_eq!(PARAMETERS, FIBRE);
    }
}
