//! Smith's theory of a yarn struck at a point (thesis, Eq. 2.1–2.9), with a tension that need not be linear.
//!
//! A wave of elongation runs outwards at c(λ) = √(dP/dλ / ρ0), in reference lengths, and leaves the yarn moving inwards
//! at w = ∫ c dλ (its Riemann invariant). The kink follows at √(P/(ρ0 λ)). In space, per unit time, the length λ√(P/(ρ0
//! λ)) of yarn stands between mid-span and the kink; w of it has come from outside, so that the kink is at U = √(Pλ/ρ0)
//! − w, and Pythagoras gives V² = Pλ/ρ0 − U². With P = E ε that is V = c √(ε(2√(ε(1+ε)) − ε)) and U = c(√(ε(1+ε)) − ε).

use std::ops::Range;

use super::fibre_wave::FibreWave;
use super::model::{Law, Material};
use toron::host::units::UnitSystem;
use toron_shared::error::Error;
use toron_shared::numbers::number;
use toron_shared::toml_file::Source;

/// Steps of the integral, and of the bisection for the strain.
const STEPS: usize = 1000;
const HALVINGS: usize = 60;
/// Strains are looked for up to here; every fibre breaks before.
pub const LARGEST_STRAIN: f64 = 0.5;

/// What a transverse velocity does to a yarn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Smith {
    pub strain: f64,
    /// Of the front of the elongation, and at its end, by reference length.
    pub fastest: f64,
    pub slowest: f64,
    /// Of the kink, in space.
    pub transverse: f64,
}

/// How the tension of a yarn depends on its stretch, by area of the reference section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tension {
    /// P = k ln λ/λ: the yarn laws with a section that is free to change.
    Logarithmic(f64),
    /// P = E ln λ: the linear elastic law, whose section keeps its area.
    Linear(f64),
    /// P = E ε: Smith's own, and that of a law of one's own, with its stiffness at rest.
    Hooke(f64),
}

impl Tension {
    /// The tension of a material; none of a law of one's own that resists no tension at rest.
    pub fn of(material: &Material) -> Option<Tension> {
        match (&material.law, material.law.yarn()) {
            (_, Some(yarn)) => Some(Tension::Logarithmic(yarn.k_el)),
            (Law::LinearElastic { properties, .. }, None) => Some(Tension::Linear(properties.e_1)),
            (Law::Own(own), None) => own.youngs_modulus().map(Tension::Hooke),
            (Law::Hyperelastic { .. }, None) => None, // not reached: it is a yarn law
        }
    }

    fn stress(&self, stretch: f64) -> f64 {
        match self {
            Tension::Logarithmic(k) => k * stretch.ln() / stretch,
            Tension::Linear(e) => e * stretch.ln(),
            Tension::Hooke(e) => e * (stretch - 1.0),
        }
    }

    fn slope(&self, stretch: f64) -> f64 {
        match self {
            Tension::Logarithmic(k) => k * (1.0 - stretch.ln()) / (stretch * stretch),
            Tension::Linear(e) => e / stretch,
            Tension::Hooke(e) => *e,
        }
    }

    /// The transverse velocity that stretches a yarn of this reference density by [`LARGEST_STRAIN`].
    pub fn fastest_strike(&self, density: f64) -> f64 {
        self.velocities(LARGEST_STRAIN, density).0
    }

    /// What the transverse velocity does to a yarn of this reference density; none where it needs more than
    /// [`LARGEST_STRAIN`].
    pub fn smith(&self, velocity: f64, density: f64) -> Option<Smith> {
        if self.fastest_strike(density) < velocity {
            return None;
        }
        let (mut low, mut high) = (0.0, LARGEST_STRAIN);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            let (v, _) = self.velocities(middle, density);
            if v < velocity { low = middle } else { high = middle }
        }
        let (_, transverse) = self.velocities(low, density);
        let speed = |strain: f64| (self.slope(1.0 + strain) / density).sqrt();
        Some(Smith { strain: low, fastest: speed(0.0), slowest: speed(low), transverse })
    }

    /// V and U at a strain.
    fn velocities(&self, strain: f64, density: f64) -> (f64, f64) {
        let step = strain / STEPS as f64;
        let speed = |i: usize| (self.slope(1.0 + (i as f64 + 0.5) * step) / density).sqrt();
        let inwards: f64 = (0..STEPS).map(|i| step * speed(i)).sum();
        let stretch = 1.0 + strain;
        let square = self.stress(stretch) * stretch / density;
        let kink = square.sqrt() - inwards;
        ((square - kink * kink).max(0.0).sqrt(), kink)
    }
}

impl Material {
    /// That a strike of this speed stretches a yarn of this material by no more than any fibre bears; `key` is what
    /// gives the speed.
    ///
    /// # Errors
    /// It is faster: what is allowed, with a hint if the units cannot be right.
    pub fn bears_strike(&self, key: &str, speed: f64, units: &UnitSystem) -> Result<(), String> {
        let density = self.density.unwrap_or_default();
        let most = Tension::of(self).map_or(0.0, |tension| tension.fastest_strike(density));
        if speed <= most {
            return Ok(());
        }
        let most = number(most);
        let mut message =
            format!("{key} is {speed}; allowed: up to {most}, which stretches the yarn by {LARGEST_STRAIN}");
        if let Some(warning) = FibreWave::of(self, units).and_then(|wave| wave.unit_warning(units)) {
            message.push_str(&format!(";\n{warning}"));
        }
        Err(message)
    }
}

/// The speed of a strike, given there, if a yarn of this material bears it.
///
/// # Errors
/// As for [`Material::bears_strike`], with file and line.
pub fn strike_speed(
    source: &Source<'_>,
    speed: f64,
    place: Range<usize>,
    material: &Material,
    units: &UnitSystem,
) -> Result<f64, Error> {
    material.bears_strike("speed", speed, units).map(|()| speed).map_err(|message| source.error(place, &message))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hooke_gives_the_thesis_values() {
        // Tab. 3.1: E 84.62 GPa, ρ 1440 kg/m³.
        let hooke = Tension::Hooke(84.62e9);
        for (velocity, percent, transverse) in [(200.0, 0.498, 504.2), (400.0, 1.271, 772.0), (800.0, 3.258, 1156.0)] {
            let smith = hooke.smith(velocity, 1440.0).expect("it is slow enough");
            assert!((100.0 * smith.strain - percent).abs() < 6e-4, "{}", smith.strain);
            assert!((smith.transverse - transverse).abs() < 0.6, "{}", smith.transverse);
        }
    }

    #[test]
    fn no_yarn_is_stretched_by_half() {
        assert_eq!(Tension::Logarithmic(82.341e9).smith(1e5, 1351.4), None);
    }

    #[test]
    fn the_law_slows_the_wave_as_it_stretches() {
        let smith = Tension::Logarithmic(82.341e9).smith(400.0, 1351.4).expect("it is slow enough");
        let fallen = 1.0 - smith.slowest / smith.fastest;
        assert!((fallen - 0.019).abs() < 0.0015, "{fallen}");
    }
}
