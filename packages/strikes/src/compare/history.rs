//! A host's results of a strike, in the same quantities and units whatever host it is.

use toron::host::units::UnitSystem;
use toron::law::parameters::Dimension;

use crate::scene_deck::origin::Origin;
use toron_materials::units::{ENERGY, FORCE, LENGTH, SPEED, TIME};

/// A sum of energies falls if it does so by this many times its largest move before, which counts as so much of its
/// size at least: the onset of contact takes 1.5e-4 of it into the first sample.
const FALL: f64 = 5.0;
const LEAST_MOVE: f64 = 5e-5;

/// A quantity over time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    /// In order.
    pub times: Vec<f64>,
    pub values: Vec<f64>,
}

impl Curve {
    pub fn new(points: impl IntoIterator<Item = (f64, f64)>) -> Curve {
        let (times, values) = points.into_iter().unzip();
        Curve { times, values }
    }

    /// The value at a time, between the samples around it; none outside of them.
    pub fn at(&self, time: f64) -> Option<f64> {
        let after = self.times.partition_point(|&sample| sample < time);
        if self.times.get(after) == Some(&time) {
            return Some(self.values[after]);
        }
        let before = after.checked_sub(1)?;
        let (start, end) = (self.times[before], *self.times.get(after)?);
        let part = (time - start) / (end - start);
        Some(self.values[before] * (1.0 - part) + self.values[after] * part)
    }

    pub fn last(&self) -> Option<f64> {
        self.values.last().copied()
    }

    /// The first time at which this is true of the value.
    pub fn first(&self, of: impl Fn(f64) -> bool) -> Option<f64> {
        self.times.iter().zip(&self.values).find(|(_, value)| of(**value)).map(|(time, _)| *time)
    }

    pub fn map(&self, of: impl Fn(f64) -> f64) -> Curve {
        Curve { times: self.times.clone(), values: self.values.iter().map(|&value| of(value)).collect() }
    }

    /// This and another one, which is taken at this one's times, where it has them.
    pub fn with(&self, other: &Curve, of: impl Fn(f64, f64) -> f64) -> Curve {
        let points = self.times.iter().zip(&self.values);
        Curve::new(points.filter_map(|(&time, &value)| Some((time, of(value, other.at(time)?)))))
    }

    /// The first sample into which a sum of energies, which hardly moves otherwise, has fallen by far more than it has
    /// ever moved from sample to sample before: what is deleted takes its energy with it.
    pub fn first_fall(&self) -> Option<f64> {
        let size = self.values.first()?.abs();
        let mut largest = LEAST_MOVE * size;
        for (i, pair) in self.values.windows(2).enumerate() {
            let change = pair[1] - pair[0];
            if change < -FALL * largest {
                return self.times.get(i + 1).copied();
            }
            largest = largest.max(change.abs());
        }
        None
    }

    /// Differences from sample to sample over the time between them, each in the middle of its two.
    pub fn slope(&self) -> Curve {
        let samples: Vec<(f64, f64)> = self.times.iter().copied().zip(self.values.iter().copied()).collect();
        let pairs = samples.windows(2).filter(|pair| pair[1].0 > pair[0].0);
        Curve::new(pairs.map(|pair| {
            let [(start, from), (end, to)] = [pair[0], pair[1]];
            (0.5 * (start + end), (to - from) / (end - start))
        }))
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    Speed,
    Deflection,
    Force,
    Striker,
    Kinetic,
    Internal,
    Hourglass,
    Viscosity,
    Contact,
    Friction,
    Total,
}

/// A quantity's name in tables, its title in pictures, and its dimension.
pub struct Row {
    pub quantity: Quantity,
    pub name: &'static str,
    pub title: &'static str,
    pub dimension: Dimension,
}

const fn row(quantity: Quantity, name: &'static str, title: &'static str, dimension: Dimension) -> Row {
    Row { quantity, name, title, dimension }
}

/// All quantities, in the order of [`Quantity`].
pub const QUANTITIES: [Row; 11] = [
    row(Quantity::Speed, "speed", "Speed of the striker", SPEED),
    row(Quantity::Deflection, "deflection", "Deflection", LENGTH),
    row(Quantity::Force, "force", "Force on the striker", FORCE),
    row(Quantity::Striker, "striker_energy", "Energy of the striker", ENERGY),
    row(Quantity::Kinetic, "kinetic_energy", "Kinetic energy of the yarns", ENERGY),
    row(Quantity::Internal, "internal_energy", "Internal energy", ENERGY),
    row(Quantity::Hourglass, "hourglass_energy", "Hourglass energy", ENERGY),
    row(Quantity::Viscosity, "viscosity_energy", "Energy taken by viscosity", ENERGY),
    row(Quantity::Contact, "contact_energy", "Energy of contact", ENERGY),
    row(Quantity::Friction, "friction_energy", "Energy of friction", ENERGY),
    row(Quantity::Total, "total_energy", "Sum of the energies", ENERGY),
];

/// A run of one host. Energies and the force are those of the whole, also where a part of it was computed; the speed is
/// that in the direction of the blow, and so is the deflection.
#[derive(Clone, Debug)]
pub struct History {
    pub host: &'static str,
    pub name: String,
    curves: [Option<Curve>; QUANTITIES.len()],
    /// When the first element failed, as far as samples tell.
    pub failed: Option<f64>,
}

impl History {
    pub fn new(host: &'static str, name: String) -> History {
        History { host, name, curves: Default::default(), failed: None }
    }

    pub fn set(&mut self, quantity: Quantity, curve: impl Into<Option<Curve>>) {
        self.curves[quantity as usize] = curve.into().filter(|curve| !curve.times.is_empty());
    }

    pub fn curve(&self, quantity: Quantity) -> Option<&Curve> {
        self.curves[quantity as usize].as_ref()
    }

    /// The last time of which anything is known.
    pub fn end(&self) -> f64 {
        self.curves.iter().flatten().filter_map(|curve| curve.times.last()).copied().fold(0.0, f64::max)
    }

    /// Splits the kinetic energy of all into that of the striker and that of the yarns, which are at rest when the
    /// history begins.
    pub fn split_kinetic(&mut self, all: &Curve) {
        let Some(speed) = self.curve(Quantity::Speed).cloned() else { return };
        let (Some(&energy), Some(&start)) = (all.values.first(), speed.values.first()) else { return };
        let striker = speed.map(|speed| energy * (speed / start).powi(2));
        self.set(Quantity::Kinetic, all.with(&striker, |all, striker| all - striker));
        self.set(Quantity::Striker, striker);
    }

    /// In other units, and of the whole.
    pub fn converted(mut self, from: &Origin, to: &UnitSystem) -> History {
        let convert = |value: f64, dimension| from.units.scale(dimension).convert(value, &to.scale(dimension));
        for (row, curve) in QUANTITIES.iter().zip(&mut self.curves) {
            let Some(curve) = curve else { continue };
            let part = if row.dimension == ENERGY || row.dimension == FORCE { from.part } else { 1.0 };
            curve.times.iter_mut().for_each(|time| *time = convert(*time, TIME));
            curve.values.iter_mut().for_each(|value| *value = convert(*value, row.dimension) / part);
        }
        self.failed = self.failed.map(|time| convert(time, TIME));
        self
    }
}

/// The component along which something moves: the axis of the largest value at the start, and its sign.
pub fn direction(start: [f64; 3]) -> Option<(usize, f64)> {
    let axis = (0..3).max_by(|&a, &b| start[a].abs().total_cmp(&start[b].abs()))?;
    (start[axis] != 0.0).then_some((axis, start[axis].signum()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_is_known_between_its_samples_only() {
        let curve = Curve::new([(0.0, 1.0), (2.0, 5.0)]);
        assert_eq!(
            [-0.1, 0.0, 0.5, 2.0, 2.1].map(|time| curve.at(time)),
            [None, Some(1.0), Some(2.0), Some(5.0), None]
        );
        assert_eq!(curve.slope(), Curve::new([(1.0, 2.0)]));
        assert_eq!(Curve::default().at(0.0), None);
    }

    #[test]
    fn a_sum_of_energies_falls_where_it_moves_as_never_before() {
        // From moves in 1e-5 of the sum at the start.
        let fall = |moves: &[f64]| {
            let mut sum = 1744.19;
            let values = std::iter::once(sum).chain(moves.iter().map(|of_size| {
                sum += 1e-5 * of_size * 1744.19;
                sum
            }));
            Curve::new((0..).map(f64::from).zip(values)).first_fall()
        };
        assert_eq!(fall(&[-2.1, -0.6, 1.1, -38.7, -18.9]), Some(4.0));
        // Runs of OpenRadioss, from the onset of contact on and around the failure: a patch, and a yarn that fails.
        let patch = [-15.3, -4.5, -3.6, -1.2, -1.4, 3.8, 6.5, -210.8, -42.2, -229.0];
        assert_eq!(fall(&patch), Some(8.0));
        let yarn = [-13.2, -11.3, -3.9, -2.8, -0.75, -0.03, -9.6, 1.6, -0.8, 2.1, 3.2, -138.4, -8.8, -1.8];
        assert_eq!(fall(&yarn), Some(12.0));
        // Neither the onset, nor drift, nor what comes in, is a fall; the elements of this yarn that fail take no more
        // than that.
        assert_eq!(fall(&[-11.6, -8.9, -3.5, -3.4, -0.5, -0.02, -7.6, -15.2, 61.9, -7.4]), None);
        assert_eq!(fall(&patch[..7]), None);
        assert_eq!(fall(&[-2.3, -5.7, -8.6, -11.5]), None);
        assert_eq!(fall(&[1000.0, 1000.0, -3500.0]), None);
        assert_eq!(Curve::default().first_fall(), None);
    }

    #[test]
    fn quantities_stand_in_their_order() {
        assert!(QUANTITIES.iter().enumerate().all(|(i, row)| row.quantity as usize == i));
    }
}
