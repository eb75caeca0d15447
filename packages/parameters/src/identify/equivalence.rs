//! k_el from the fibre alone (section 4.5.1): the energy ½ k_el I² is fitted to that of a linear yarn, ½ E ν (e^I −
//! 1)², by least squares over even I from 0 to the failure of the fibre (Eq. 4.21–4.23).

use super::parameter::{PARAMETERS, Parameter, Values};

/// So many intervals of even length, each with its middle.
const POINTS: usize = 10_000;

/// A constant and its standard deviation, 0 where it is exact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constant {
    pub value: f64,
    pub deviation: f64,
}

/// What is known of the fibre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fibre {
    pub modulus: Constant,
    /// Of fibres in the yarn's section.
    pub volume_fraction: Constant,
    /// Engineering strain.
    pub strain_at_failure: Constant,
}

impl Fibre {
    pub fn k_el(&self) -> f64 {
        self.modulus.value * self.volume_fraction.value * self.sums().0
    }

    /// k_el over E ν, and its derivative by the largest I.
    fn sums(&self) -> (f64, f64) {
        let largest = self.strain_at_failure.value.ln_1p();
        let (mut above, mut below) = (0.0, 0.0);
        for point in 0..POINTS {
            let i = largest * (point as f64 + 0.5) / POINTS as f64;
            above += i.exp_m1().powi(2) * i * i;
            below += i.powi(4);
        }
        let ratio = above / below;
        // d/dI_max of the quotient of the integrals, of which the sums are POINTS/I_max times as large.
        let end = largest.exp_m1().powi(2) * largest * largest - ratio * largest.powi(4);
        (ratio, end * POINTS as f64 / (largest * below))
    }

    /// The largest difference of the two energies, over the energy at failure.
    pub fn misfit(&self) -> f64 {
        let largest = self.strain_at_failure.value.ln_1p();
        let linear = |i: f64| i.exp_m1().powi(2);
        let ratio = self.sums().0;
        let points = (0..=POINTS).map(|point| largest * point as f64 / POINTS as f64);
        let difference = points.map(|i| (ratio * i * i - linear(i)).abs()).fold(0.0, f64::max);
        difference / linear(largest)
    }

    /// For each constant, what its standard deviation makes of k_el and ε_lim.
    pub fn deviations(&self) -> Vec<Values> {
        let k_el = self.k_el();
        let by_strain = self.modulus.value * self.volume_fraction.value * self.sums().1;
        let strain = self.strain_at_failure;
        let rows = [
            [k_el / self.modulus.value * self.modulus.deviation, 0.0],
            [k_el / self.volume_fraction.value * self.volume_fraction.deviation, 0.0],
            [by_strain / (1.0 + strain.value) * strain.deviation, strain.deviation],
        ];
        let values = |[k_el, eps_lim]: [f64; 2]| {
            let mut values = [0.0; PARAMETERS];
            values[Parameter::KEl.index()] = k_el;
            values[Parameter::EpsLim.index()] = eps_lim;
            values
        };
        rows.into_iter().filter(|row| row.iter().any(|&deviation| deviation != 0.0)).map(values).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exact(value: f64) -> Constant {
        Constant { value, deviation: 0.0 }
    }

    /// Table 4.1.
    fn kevlar() -> Fibre {
        Fibre { modulus: exact(84.62), volume_fraction: exact(0.9385), strain_at_failure: exact(0.0458) }
    }

    #[test]
    fn kevlar_has_the_stiffness_of_the_least_squares() {
        // 82.445 with the fraction's further digits, 0.93848.
        approx::assert_abs_diff_eq!(kevlar().k_el(), 82.447, epsilon = 0.001);
        // The thesis, whose points are not stated.
        approx::assert_relative_eq!(kevlar().k_el(), 82.341, max_relative = 0.0015);
        assert!(kevlar().misfit() < 0.01);
    }

    #[test]
    fn deviations_are_those_of_differences() {
        let mut fibre = kevlar();
        fibre.modulus.deviation = 1e-3;
        fibre.volume_fraction.deviation = 1e-5;
        fibre.strain_at_failure.deviation = 1e-5;
        let moved = |change: fn(&mut Fibre, f64)| {
            let [mut more, mut less] = [fibre; 2];
            change(&mut more, 1.0);
            change(&mut less, -1.0);
            0.5 * (more.k_el() - less.k_el())
        };
        let expected = [
            moved(|fibre, sign| fibre.modulus.value += sign * fibre.modulus.deviation),
            moved(|fibre, sign| fibre.volume_fraction.value += sign * fibre.volume_fraction.deviation),
            moved(|fibre, sign| fibre.strain_at_failure.value += sign * fibre.strain_at_failure.deviation),
        ];
        for (values, expected) in fibre.deviations().iter().zip(expected) {
            approx::assert_relative_eq!(values[0], expected, max_relative = 1e-6);
        }
        assert_eq!(fibre.deviations()[2][Parameter::EpsLim.index()], 1e-5);
        assert!(kevlar().deviations().is_empty());
    }
}
