//! A case from its first step to its last, and what is measured on the way.

use std::time::{Duration, Instant};

use super::scene::{Case, Outputs, Precision, Striker, Zones};
use super::smith::{LARGEST_STRAIN, Smith, Tension};
use crate::Error;
use crate::explicit::contact::Contact;
use crate::explicit::element::{Number, largest};
use crate::explicit::material::Medium;
use crate::explicit::mesh::Mesh;
use crate::explicit::{Cost, Energies, Projectile, Solver, Support, vtu};
use crate::material::Material;
use crate::unit_names::number;

/// Where the section's width is measured, as fractions of half the span (Fig. 4.16 has four points).
pub const STATIONS: [f64; 4] = [0.2, 0.4, 0.6, 0.8];
/// The part of half the span over which the speed of a front is fitted: where it no longer builds up, and away from the clamp.
const FITTED: [f64; 2] = [0.4, 0.85];
/// The front of the elongation is where the strain has this part of what Smith's theory gives behind it.
const FRONT: f64 = 0.5;
/// Where, as fractions of the way to the front of the elongation, the strain behind it is taken.
const PLATEAU: [f64; 2] = [0.3, 0.7];
/// A run whose total energy moves by more than this part of itself is not stable.
const LARGEST_IMBALANCE: f64 = 0.05;
/// The failure index of an element that has failed, but for the rounding of single precision.
const FAILED: f64 = 1.0 - 1e-6;
/// Times are told apart by this part of a case's time.
const ROUNDING: f64 = 1e-9;
/// A transverse front this near the clamp has reached it but for what its own length adds.
const AT_CLAMP: [f64; 2] = [0.75, 0.95];

/// A line of the history.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    pub time: f64,
    /// Of the projectile, along its way; and how far it has come.
    pub speed: f64,
    pub travel: f64,
    /// Contact force of the half model.
    pub force: f64,
    /// Of the whole yarn: twice the half model's.
    pub energies: Energies,
    /// The parts of the internal energy, as `ENERGY_NAMES` has them.
    pub parts: [f64; 5],
    /// Largest energy densities: in the yarn, and further than a radius from mid-span and from the clamp, where neither
    /// touches the yarn.
    pub largest: [f64; 5],
    pub free: [f64; 5],
    /// Least energy density of elongation, or of the linear law's work.
    pub least: f64,
    /// The largest failure index of what stands.
    pub index: f64,
    /// Elements deleted so far, and how many of them for their own step.
    pub deleted: usize,
    pub collapsed: usize,
    /// The front of the elongation, by reference length, and of the kink, in space.
    pub longitudinal: f64,
    pub transverse: f64,
    /// Of the section, at the stations.
    pub widths: [f64; 4],
    /// Mean strain behind the front of the elongation.
    pub strain: f64,
}

/// How a case ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    /// At the end of the time asked for.
    Time,
    /// The projectile has stopped.
    Stopped,
    /// It has left the broken yarn behind.
    Left,
}

/// The yarn at an instant, to be drawn.
#[derive(Clone, Debug)]
pub struct Snapshot {
    pub time: f64,
    pub positions: Vec<[f64; 3]>,
    pub intact: Vec<bool>,
    pub densities: Vec<[f64; 5]>,
    /// Height of the projectile's axis, and its radius.
    pub projectile: Option<(f64, f64)>,
}

/// What came of a case.
#[derive(Clone, Debug)]
pub struct Outcome {
    pub samples: Vec<Sample>,
    pub snapshots: Vec<Snapshot>,
    pub mesh: Mesh,
    pub end: End,
    /// Whether a projectile strikes whose speed is its own, neither held nor driven.
    pub own_speed: bool,
    /// When the first element reached a failure index of 1.
    pub failed: Option<f64>,
    /// When the last line of elements along the fibre tore, and the projectile's speed then.
    pub broken: Option<(f64, f64)>,
    pub cost: Cost,
    pub wall: Duration,
    pub smith: Smith,
}

/// Who follows a run.
pub trait Observer {
    /// The fraction of the case's time that has passed.
    fn progress(&mut self, _fraction: f64) {}

    /// The text of a VTU file, and its time.
    ///
    /// # Errors
    /// What ends the run.
    fn frame(&mut self, _time: f64, _text: &str) -> Result<(), Error> {
        Ok(())
    }
}

/// Nobody does.
impl Observer for () {}

/// Runs a case.
///
/// # Errors
/// A material that the host cannot use, a speed beyond every yarn, a run that is not stable, or the observer's.
pub fn run(case: &Case, observer: &mut dyn Observer) -> Result<Outcome, Error> {
    match case.precision {
        Precision::F64 => Run::<f64>::new(case)?.go(observer),
        Precision::F32 => Run::<f32>::new(case)?.go(observer),
    }
}

struct Run<'a, T> {
    case: &'a Case,
    solver: Solver<T>,
    smith: Smith,
    samples: Vec<Sample>,
    snapshots: Vec<Snapshot>,
    failed: Option<f64>,
    broken: Option<(f64, f64)>,
    /// Deleted elements so far, and the lines of elements along the fibre that have lost one.
    deleted: usize,
    torn: Vec<bool>,
    /// Since when nothing has touched the projectile.
    untouched: f64,
    start: f64,
}

impl<'a, T: Number> Run<'a, T> {
    fn new(case: &'a Case) -> Result<Self, Error> {
        let medium =
            |material: &Material| Medium::<T>::new(material, material.density.unwrap_or_default(), case.control);
        let mesh = case.yarn.mesh();
        let per_layer = mesh.elements_per_layer;
        let (materials, length) = match &case.zones {
            Zones::One(material) => (std::slice::from_ref(&**material), case.yarn.length),
            Zones::Two(materials, length) => (&materials[..], *length),
        };
        let near = case.yarn.layers_to(length);
        let media = materials.iter().map(medium).collect::<Result<_, _>>()?;
        let mut solver = Solver::new(mesh, media, |element| usize::from(element / per_layer >= near));
        let tension = Tension::of(&materials[0]);
        let smith = tension.smith(case.speed, materials[0].density.unwrap_or_default()).ok_or_else(|| {
            let allowed = format!("what stretches a yarn by up to {LARGEST_STRAIN}");
            Error::Input(format!("case {}: speed is {}; allowed: {allowed}", case.name, case.speed))
        })?;
        solver.all_outputs = case.outputs == Outputs::Full;
        let start = set_up(case, &mut solver);
        Ok(Run {
            case,
            solver,
            smith,
            samples: Vec::new(),
            snapshots: Vec::new(),
            failed: None,
            broken: None,
            deleted: 0,
            torn: vec![false; per_layer],
            untouched: 0.0,
            start,
        })
    }

    fn go(mut self, observer: &mut dyn Observer) -> Result<Outcome, Error> {
        let begun = Instant::now();
        let (mut next_sample, mut next_frame) = (0.0, 0.0);
        let frame = self.case.end / self.case.frames.max(1) as f64;
        let mut pictures = self.case.pictures.clone();
        pictures.sort_by(|a, b| b.total_cmp(a));
        let mut end = None;
        let end = loop {
            let time = self.solver.time;
            let reached = |instant: f64| time >= instant - ROUNDING * self.case.end;
            end = end.or(reached(self.case.end).then_some(End::Time));
            let sampled = reached(next_sample) || end.is_some();
            let drawn = pictures.last().is_some_and(|&picture| reached(picture));
            let framed = self.case.frames > 0 && reached(next_frame);
            let left = if end.is_some() { self.case.end } else { self.case.end - time };
            self.solver.accelerate(sampled || drawn || framed, left).map_err(|error| self.fault(&error.to_string()))?;
            if sampled {
                self.sample(time)?;
                next_sample += self.case.sample;
                observer.progress(time / self.case.end);
            }
            if drawn {
                pictures.pop();
                self.snapshots.push(self.snapshot(time));
            }
            if framed {
                next_frame += frame;
                observer.frame(time, &vtu::unstructured_grid(&self.solver))?;
            }
            if let Some(end) = end {
                break end;
            }
            // How it stands after the last step: sampled, and the end.
            end = self.ended(time);
            self.solver.displace();
        };
        observer.progress(1.0);
        Ok(Outcome {
            samples: self.samples,
            snapshots: self.snapshots,
            end,
            own_speed: matches!(self.case.striker, Striker::Cylinder { held: false, .. }),
            failed: self.failed,
            broken: self.broken,
            cost: self.solver.cost,
            wall: begun.elapsed(),
            smith: self.smith,
            mesh: self.solver.mesh,
        })
    }

    fn snapshot(&self, time: f64) -> Snapshot {
        let elements = 0..self.solver.mesh.elements.len();
        Snapshot {
            time,
            positions: (0..self.solver.mesh.nodes.len()).map(|node| self.solver.position(node)).collect(),
            intact: elements.clone().map(|i| self.solver.is_intact(i)).collect(),
            densities: elements.map(|i| self.solver.energy_densities(i)).collect(),
            projectile: self.solver.projectile.as_ref().map(|p| (p.position, self.radius())),
        }
    }

    fn radius(&self) -> f64 {
        match self.case.striker {
            Striker::Cylinder { cylinder, .. } => cylinder.radius,
            Striker::Driven => 0.0,
        }
    }

    fn speed(&self) -> f64 {
        self.solver.projectile.as_ref().map_or(self.case.speed, |projectile| -projectile.velocity)
    }

    /// Whether the run is over.
    fn ended(&mut self, time: f64) -> Option<End> {
        if self.broken.is_none() && self.tears(time) {
            self.broken = Some((time, self.speed()));
        }
        if let Some(projectile) = &self.solver.projectile {
            if projectile.force != 0.0 {
                self.untouched = time;
            }
            if projectile.velocity >= 0.0 {
                return Some(End::Stopped);
            }
        }
        // As long as a wave takes to the clamp and back: what is left of the yarn has had its say.
        let patience = 2.0 * self.case.yarn.length / self.smith.fastest;
        if self.broken.is_some() && time - self.untouched > patience {
            return Some(End::Left);
        }
        (time >= self.case.end).then_some(End::Time)
    }

    /// Whether every line of elements along the fibre has lost one. The laws resist shear along the fibre little or not at
    /// all, so that a torn line carries no tension, whatever its neighbours do.
    fn tears(&mut self, time: f64) -> bool {
        for &element in &self.solver.deleted[self.deleted..] {
            self.torn[element % self.solver.mesh.elements_per_layer] = true;
            // The index of what has failed stays as it was then; what has collapsed has a lower one.
            if self.solver.failure_index(element) >= FAILED {
                self.failed = self.failed.or(Some(time));
            }
        }
        self.deleted = self.solver.deleted.len();
        self.torn.iter().all(|&torn| torn)
    }

    /// Why the case has no result.
    fn fault(&self, reason: &str) -> Error {
        Error::Evaluation(format!("case {} at time {}: {reason}", self.case.name, number(self.solver.time)))
    }

    /// # Errors
    /// The balance of energy is lost.
    fn sample(&mut self, time: f64) -> Result<(), Error> {
        let (deleted, collapsed) = (self.solver.deleted.len(), self.solver.collapsed);
        let mut sample = Sample { time, speed: self.speed(), deleted, collapsed, ..Sample::default() };
        if let Some(projectile) = &self.solver.projectile {
            sample.travel = self.start - projectile.position;
            sample.force = projectile.force;
        } else {
            sample.travel = time * self.case.speed;
        }
        sample.energies = whole(&self.solver.energies);
        self.measure_densities(&mut sample);
        self.measure_fronts(&mut sample);
        sample.widths = STATIONS.map(|station| self.width(station));
        self.samples.push(sample);
        let imbalance = imbalance(&self.samples);
        if imbalance <= LARGEST_IMBALANCE {
            return Ok(());
        }
        let energy = number(sample.energies.total());
        let bound = 100.0 * LARGEST_IMBALANCE;
        Err(self.fault(&format!("total energy {energy}, more than {bound} % from what it was: the run is not stable")))
    }

    fn measure_densities(&self, sample: &mut Sample) {
        let (length, radius) = (self.case.yarn.length, self.radius());
        sample.least = f64::INFINITY;
        for i in 0..self.solver.mesh.elements.len() {
            let densities = self.solver.energy_densities(i);
            for (part, density) in sample.parts.iter_mut().zip(densities) {
                *part += 2.0 * density * self.solver.volume(i);
            }
            if !self.solver.is_intact(i) {
                continue;
            }
            let place = (self.solver.mesh.layer(i) as f64 + 0.5) / self.case.yarn.layers as f64 * length;
            larger(&mut sample.largest, densities);
            if place > radius && place < length - radius {
                larger(&mut sample.free, densities);
            }
            sample.least = sample.least.min(densities[0] + densities[4]);
            sample.index = largest(sample.index, self.solver.failure_index(i));
        }
    }

    /// Mean elongation of a layer's intact elements by volume: what a wave carries, whichever elements it is in.
    fn elongation(&self, layer: usize) -> f64 {
        let per_layer = self.solver.mesh.elements_per_layer;
        let intact = (layer * per_layer..(layer + 1) * per_layer).filter(|&i| self.solver.is_intact(i));
        let (sum, whole) = intact.fold((0.0, 0.0), |(sum, whole), i| {
            let volume = self.solver.volume(i);
            (sum + volume * self.solver.elongation(i), whole + volume)
        });
        if whole == 0.0 { 0.0 } else { sum / whole }
    }

    fn measure_fronts(&self, sample: &mut Sample) {
        let layers = self.case.yarn.layers;
        let length = self.case.yarn.length / layers as f64;
        let threshold = FRONT * self.smith.strain.ln_1p();
        let strains: Vec<f64> = (0..layers).map(|layer| self.elongation(layer)).collect();
        // Layers are measured in their middles.
        sample.longitudinal = front(&strains, threshold).map_or(0.0, |place| (place + 0.5) * length);
        let [from, to] = PLATEAU.map(|fraction| (fraction * sample.longitudinal / length) as usize);
        let plateau = &strains[from..to.max(from + 1).min(layers)];
        sample.strain = (plateau.iter().sum::<f64>() / plateau.len() as f64).exp_m1();
        let velocities: Vec<f64> = (0..=layers).map(|section| -self.section_mean(section).1).collect();
        if let Some(place) = front(&velocities, 0.5 * self.case.speed) {
            let (section, part) = (place as usize, place.fract());
            let [here, next] = [section, (section + 1).min(layers)].map(|section| self.section_mean(section).0);
            sample.transverse = here + part * (next - here);
        }
    }

    /// Mean of a section's positions along the yarn and of its velocities along axis 1, by mass.
    fn section_mean(&self, section: usize) -> (f64, f64) {
        let count = self.solver.mesh.nodes_per_section;
        let nodes = section * count..(section + 1) * count;
        let (mass, x, v) = nodes.fold((0.0, 0.0, 0.0), |(sum, x, v), node| {
            let mass = self.solver.mass()[node];
            let [place, velocity] = [self.solver.position(node)[0], self.solver.velocity[node][1].into()];
            (sum + mass, x + mass * place, v + mass * velocity)
        });
        (x / mass, v / mass)
    }

    fn width(&self, station: f64) -> f64 {
        let count = self.solver.mesh.nodes_per_section;
        let section = (station * self.case.yarn.layers as f64).round() as usize;
        let across = (section * count..(section + 1) * count).map(|node| self.solver.position(node)[2]);
        let (low, high) = across.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), z| (l.min(z), h.max(z)));
        high - low
    }
}

/// The outermost place, counted in entries, at which the values fall below a threshold.
fn front(values: &[f64], threshold: f64) -> Option<f64> {
    let last = values.iter().rposition(|&value| value >= threshold)?;
    let Some(&next) = values.get(last + 1) else { return Some(last as f64) };
    Some(last as f64 + (values[last] - threshold) / (values[last] - next))
}

/// The largest difference of the total energy from what it was, over the largest of: the energy that was there, the work
/// from outside.
fn imbalance(samples: &[Sample]) -> f64 {
    let Some((first, scale)) = energy(samples) else { return 0.0 };
    let difference = samples.iter().map(|sample| (sample.energies.total() - first).abs()).fold(0.0, largest);
    if difference > 0.0 || difference.is_nan() { difference / scale } else { 0.0 }
}

/// The energy at the start, and the largest of it and of the work from outside.
fn energy(samples: &[Sample]) -> Option<(f64, f64)> {
    let first = samples.first()?.energies.total();
    let scale = samples.iter().map(|sample| sample.energies.external.abs()).fold(first.abs(), largest);
    Some((first, scale))
}

fn larger(all: &mut [f64; 5], values: [f64; 5]) {
    for (most, value) in all.iter_mut().zip(values) {
        *most = largest(*most, value);
    }
}

/// Energies of the whole yarn from those of its half.
fn whole(half: &Energies) -> Energies {
    Energies {
        projectile: 2.0 * half.projectile,
        kinetic: 2.0 * half.kinetic,
        internal: 2.0 * half.internal,
        hourglass: 2.0 * half.hourglass,
        viscosity: 2.0 * half.viscosity,
        friction: 2.0 * half.friction,
        contact: 2.0 * half.contact,
        external: 2.0 * half.external,
    }
}

/// Symmetry at mid-span, the clamp at the other end, and what strikes; returns the height at which its axis starts.
fn set_up<T: Number>(case: &Case, solver: &mut Solver<T>) -> f64 {
    let count = solver.mesh.nodes_per_section;
    let last = case.yarn.layers * count;
    let rest = [0.0; 3];
    for node in 0..count {
        let symmetric = match case.striker {
            Striker::Cylinder { .. } => Support { free: [false, true, true], velocity: rest },
            Striker::Driven => Support { free: [false, false, true], velocity: [0.0, -case.speed, 0.0] },
        };
        solver.support(node, symmetric);
        solver.support(last + node, Support { free: [false; 3], velocity: rest });
    }
    let Striker::Cylinder { cylinder, mass, held } = case.striker else { return 0.0 };
    let top = solver.mesh.nodes.iter().map(|node| node[1]).fold(0.0, f64::max);
    let start = top + cylinder.radius;
    let contact = Contact::new(cylinder, &solver.mesh.nodes, &solver.mesh.surface, solver.mass());
    // Half of it strikes the half model.
    solver.projectile = Some(Projectile::new(0.5 * mass, start, -case.speed, held, contact));
    start
}

impl Outcome {
    /// The last sample.
    pub fn last(&self) -> Sample {
        self.samples.last().copied().unwrap_or_default()
    }

    /// The sample at a time or the first one after.
    pub fn at(&self, time: f64) -> Sample {
        let found = self.samples.iter().find(|sample| sample.time >= time);
        found.copied().unwrap_or_else(|| self.last())
    }

    /// The largest difference of the total energy from what it was, over the work from outside or the energy that was there.
    pub fn imbalance(&self) -> f64 {
        imbalance(&self.samples)
    }

    /// What is left of the projectile's speed; none where the run has ended before that was settled, or where the speed is
    /// not the projectile's own.
    pub fn residual_speed(&self) -> Option<f64> {
        match self.end {
            End::Stopped if self.own_speed => Some(0.0),
            End::Left if self.own_speed => Some(self.last().speed),
            _ => None,
        }
    }

    /// The largest of a quantity in the samples up to the break.
    fn largest_before_break(&self, of: impl Fn(&Sample) -> f64) -> f64 {
        let end = self.broken.map_or(f64::INFINITY, |(time, _)| time);
        self.samples.iter().take_while(|sample| sample.time <= end).map(of).fold(0.0, largest)
    }

    /// The largest failure index of the samples up to the break.
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
        energy(&self.samples).filter(|_| contact > 0.0).map_or(0.0, |(_, scale)| contact / scale)
    }

    /// The samples in which the wave of elongation passes the middle of half the span.
    fn passing(&self, half_length: f64) -> &[Sample] {
        let [from, to] = FITTED.map(|fraction| fraction * half_length);
        let Some(end) = self.samples.iter().position(|sample| sample.longitudinal >= to) else { return &[] };
        let start = self.samples[..end].iter().rposition(|sample| sample.longitudinal < from).map_or(0, |i| i + 1);
        &self.samples[start..end]
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
        let sum: f64 = passing.iter().map(|sample| sample.strain).sum();
        (!passing.is_empty()).then(|| sum / passing.len() as f64)
    }

    /// When the transverse wave is at the clamp: from its last stretch before it.
    pub fn transverse_at_clamp(&self, half_length: f64) -> Option<f64> {
        let [a, b] = AT_CLAMP.map(|fraction| {
            let place = fraction * half_length;
            self.samples.iter().find(|sample| sample.transverse >= place).map(|sample| sample.time)
        });
        let (a, b) = (a?, b?);
        Some(b + (b - a) * (1.0 - AT_CLAMP[1]) / (AT_CLAMP[1] - AT_CLAMP[0]))
    }

    /// Number of steps times elements.
    pub fn zone_cycles(&self) -> f64 {
        self.cost.steps as f64 * self.mesh.elements.len() as f64
    }
}
