//! The result of a case: its history, and the quantities computed from it.

use std::ops::{Deref, DerefMut};

use serde::{Deserialize, Serialize};

use toron_explicit_host::lanes::largest;
use toron_explicit_host::mesh::Mesh;
use toron_explicit_host::snapshot::Snapshot;
use toron_explicit_host::struck;
pub use toron_explicit_host::struck::run::End;
use toron_materials::material::smith::Smith;

/// Where the section's width is measured, as fractions of half the span (Fig. 4.16 has four points).
pub const STATIONS: [f64; 4] = [0.2, 0.4, 0.6, 0.8];
/// The part of half the span over which the speed of a front is fitted: where it no longer builds up, and away from the
/// clamp.
const FITTED: [f64; 2] = [0.4, 0.85];
/// A transverse front this near the clamp has reached it but for what its own length adds.
const AT_CLAMP: [f64; 2] = [0.75, 0.95];

/// What a sample of a yarn has besides the quantities of all scenes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OfYarn {
    /// Largest energy densities further than a radius from mid-span and from the clamp, where neither touches the yarn.
    pub free: [f64; 5],
    /// Least energy density of elongation, or of the linear law's work.
    pub least: f64,
    /// The front of the elongation, by reference length, and of the kink, in space.
    pub longitudinal: f64,
    pub transverse: f64,
    /// Of the section, at the stations.
    pub widths: [f64; 4],
    /// Mean strain behind the front of the elongation.
    pub strain: f64,
}

pub type Sample = struck::sample::Sample<OfYarn>;

/// The lines of elements along the fibre, and whether they have torn.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Course {
    /// Deleted elements so far, and the lines that have lost one.
    pub deleted: usize,
    pub torn: Vec<bool>,
    /// When the last line tore, and the projectile's speed then.
    pub broken: Option<(f64, f64)>,
}

/// The result of a case.
#[derive(Clone, Debug)]
pub struct Outcome {
    pub run: struck::run::Outcome<OfYarn, Course>,
    pub mesh: Mesh,
    /// Whether a projectile strikes whose speed is its own, neither held nor driven.
    pub own_speed: bool,
    pub smith: Smith,
}

impl Deref for Outcome {
    type Target = struck::run::Outcome<OfYarn, Course>;

    fn deref(&self) -> &Self::Target {
        &self.run
    }
}

impl DerefMut for Outcome {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.run
    }
}

impl Outcome {
    /// The place of each layer at rest, and mean and largest strain of the lines between its sections that an intact
    /// element has on an edge.
    pub fn strains(&self, snapshot: &Snapshot) -> impl Iterator<Item = (f64, [f64; 2])> {
        let mesh = &self.mesh;
        let section = mesh.nodes_per_section;
        let per_layer = mesh.elements_per_layer;
        (0..mesh.elements.len() / per_layer).filter_map(move |layer| {
            let elements = layer * per_layer..(layer + 1) * per_layer;
            let nodes =
                elements.filter(|&i| snapshot.intact[i]).flat_map(|i| mesh.elements[i]).map(|node| node as usize);
            let mut lines: Vec<usize> = nodes.filter(|node| node / section == layer).collect();
            lines.sort_unstable();
            lines.dedup();
            let length = |nodes: &[[f64; 3]], node: usize| {
                let [a, b] = [nodes[node], nodes[node + section]];
                (0..3).map(|axis| (b[axis] - a[axis]).powi(2)).sum::<f64>().sqrt()
            };
            let strain = |node: usize| length(&snapshot.positions, node) / length(&mesh.nodes, node) - 1.0;
            let strains: Vec<f64> = lines.iter().map(|&node| strain(node)).collect();
            let place = 0.5 * (mesh.nodes[layer * section][0] + mesh.nodes[(layer + 1) * section][0]);
            let mean = strains.iter().sum::<f64>() / strains.len() as f64;
            let most = strains.into_iter().reduce(f64::max)?;
            Some((place, [mean, most]))
        })
    }

    /// The measurement at a time or the first one after.
    pub fn at(&self, time: f64) -> Sample {
        let found = self.measured.iter().find(|sample| sample.time >= time);
        found.copied().unwrap_or_else(|| self.last())
    }

    /// The projectile's residual speed; none where the run has ended before the projectile stopped or left, or where
    /// the speed is not the projectile's own.
    pub fn residual_speed(&self) -> Option<f64> {
        match self.end {
            End::Stopped if self.own_speed => Some(0.0),
            End::Left | End::Decided | End::Settled if self.own_speed => Some(self.last().speed),
            _ => None,
        }
    }

    /// The largest of a quantity up to the break.
    fn largest_before_break(&self, of: impl Fn(&Sample) -> f64) -> f64 {
        let end = self.course.broken.map_or(f64::INFINITY, |(time, _)| time);
        self.measured.iter().take_while(|sample| sample.time <= end).map(of).fold(0.0, largest)
    }

    /// The largest failure index up to the break.
    pub fn largest_index(&self) -> f64 {
        self.largest_before_break(|sample| sample.index)
    }

    /// The largest hourglass energy up to the break, over the largest internal energy.
    pub fn hourglass_share(&self) -> f64 {
        let internal = self.largest_before_break(|sample| sample.energies.internal);
        let hourglass = self.largest_before_break(|sample| sample.energies.hourglass);
        if internal == 0.0 { 0.0 } else { hourglass / internal }
    }

    /// The largest energy in the contact up to the break, over the energy that was there or the work from outside.
    pub fn contact_share(&self) -> f64 {
        let contact = self.largest_before_break(|sample| sample.energies.contact);
        if contact == 0.0 { 0.0 } else { contact / self.balance.scale }
    }

    /// The largest hourglass energy of the whole run, over the largest internal energy.
    pub fn whole_hourglass_share(&self) -> f64 {
        let most = |of: fn(&Sample) -> f64| self.measured.iter().map(of).fold(0.0, largest);
        let internal = most(|sample| sample.energies.internal);
        if internal == 0.0 { 0.0 } else { most(|sample| sample.energies.hourglass) / internal }
    }

    /// The largest part that artificial viscosity has of what the blow has given away, from this time and this way of
    /// the projectile on, up to the break.
    pub fn viscosity_to_break(&self, from: f64, way: f64) -> f64 {
        let first = self.measured.first().map(|sample| sample.energies).unwrap_or_default();
        let share = |sample: &Sample| sample.energies.viscosity_share(&first).unwrap_or(0.0);
        self.largest_before_break(
            |sample| if sample.time >= from && sample.travel >= way { share(sample) } else { 0.0 },
        )
    }

    /// The part that artificial viscosity has taken in the end of what the blow has given away.
    pub fn viscosity_share(&self) -> f64 {
        let first = self.measured.first().map(|sample| sample.energies).unwrap_or_default();
        self.last().energies.viscosity_share(&first).unwrap_or(0.0)
    }

    /// The largest energy densities of elongation, compaction and distortion up to the break.
    pub fn largest_densities(&self) -> [f64; 3] {
        [0, 1, 2].map(|mode| self.largest_before_break(|sample| sample.largest[mode]))
    }

    /// How much wider the section is than at rest when the transverse wave is at the clamp: the most of the stations.
    pub fn widening(&self, half_length: f64) -> Option<f64> {
        let rest = self.measured.first()?.own.widths;
        let then = self.at(self.transverse_at_clamp(half_length)?).own.widths;
        let growth = then.iter().zip(rest).map(|(then, rest)| then / rest - 1.0);
        growth.reduce(f64::max)
    }

    /// The measurements in which the wave of elongation passes the middle of half the span.
    fn passing(&self, half_length: f64) -> &[Sample] {
        let [from, to] = FITTED.map(|fraction| fraction * half_length);
        let Some(end) = self.measured.iter().position(|sample| sample.own.longitudinal >= to) else { return &[] };
        let start = self.measured[..end].iter().rposition(|sample| sample.own.longitudinal < from).map_or(0, |i| i + 1);
        &self.measured[start..end]
    }

    /// Speed of a front while the wave of elongation passes the middle of half the span: the slope of a fitted line.
    pub fn front_speed(&self, half_length: f64, place: impl Fn(&Sample) -> f64) -> Option<f64> {
        let passing = self.passing(half_length);
        let n = passing.len() as f64;
        let mean = |of: &dyn Fn(&Sample) -> f64| passing.iter().map(of).sum::<f64>() / n;
        let (t, x) = (mean(&|sample| sample.time), mean(&|sample| place(sample)));
        let above = mean(&|sample| (sample.time - t) * (place(sample) - x));
        let below = mean(&|sample| (sample.time - t).powi(2));
        (below > 0.0).then(|| above / below)
    }

    /// Mean strain behind the wave of elongation meanwhile.
    pub fn plateau(&self, half_length: f64) -> Option<f64> {
        let passing = self.passing(half_length);
        let sum: f64 = passing.iter().map(|sample| sample.own.strain).sum();
        (!passing.is_empty()).then(|| sum / passing.len() as f64)
    }

    /// When the transverse wave is at the clamp: from its last stretch before it.
    pub fn transverse_at_clamp(&self, half_length: f64) -> Option<f64> {
        let [a, b] = AT_CLAMP.map(|fraction| {
            let place = fraction * half_length;
            self.measured.iter().find(|sample| sample.own.transverse >= place).map(|sample| sample.time)
        });
        let (a, b) = (a?, b?);
        Some(b + (b - a) * (1.0 - AT_CLAMP[1]) / (AT_CLAMP[1] - AT_CLAMP[0]))
    }
}
