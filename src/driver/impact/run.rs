//! A case from its first step to its last, and what is measured on the way.

use std::time::{Duration, Instant};

use super::scene::{Case, Outputs, Precision, Striker, Zones};
use super::smith::{Smith, Tension};
use crate::driver::Error;
use crate::driver::explicit::contact::Contact;
use crate::driver::explicit::element::Number;
use crate::driver::explicit::material::Medium;
use crate::driver::explicit::mesh::Mesh;
use crate::driver::explicit::{Cost, Energies, Projectile, Solver, Support, vtu};
use crate::driver::material::Material;

/// Where the section's width is measured, as fractions of half the span (Fig. 4.16 has four points).
pub const STATIONS: [f64; 4] = [0.2, 0.4, 0.6, 0.8];
/// The part of half the span over which the speed of a front is fitted: where it no longer builds up, and away from the clamp.
const FITTED: [f64; 2] = [0.4, 0.85];
/// Where, as fractions of the way to the front of the elongation, the strain behind it is taken.
const PLATEAU: [f64; 2] = [0.3, 0.7];
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
    pub deleted: usize,
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
    /// Texts of VTU files and their times.
    pub frames: Vec<(f64, String)>,
    pub mesh: Mesh,
    pub end: End,
    /// When nothing intact joined the clamp to mid-span any more, and the projectile's speed then.
    pub broken: Option<(f64, f64)>,
    pub cost: Cost,
    pub wall: Duration,
    pub smith: Smith,
}

/// Runs a case; `progress` hears of the fraction of its time that has passed.
///
/// # Errors
/// A material that the host cannot use.
pub fn run(case: &Case, progress: &dyn Fn(f64)) -> Result<Outcome, Error> {
    match case.precision {
        Precision::F64 => Run::<f64>::new(case)?.go(progress),
        Precision::F32 => Run::<f32>::new(case)?.go(progress),
    }
}

struct Run<'a, T> {
    case: &'a Case,
    solver: Solver<T>,
    /// A front is where the strain has half of what Smith's theory gives behind it.
    smith: Smith,
    samples: Vec<Sample>,
    snapshots: Vec<Snapshot>,
    frames: Vec<(f64, String)>,
    broken: Option<(f64, f64)>,
    /// Deleted elements when the yarn was last found to hold.
    looked_at: usize,
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
        let layer_length = case.yarn.length / case.yarn.layers as f64;
        let (materials, length) = match &case.zones {
            Zones::One(material) => (std::slice::from_ref(&**material), case.yarn.length),
            Zones::Two(materials, length) => (&materials[..], *length),
        };
        let near = (length / layer_length).round() as usize;
        let media = materials.iter().map(medium).collect::<Result<_, _>>()?;
        let mut solver = Solver::new(mesh, media, |element| usize::from(element / per_layer >= near));
        let smith = Tension::of(&materials[0]).smith(case.speed, materials[0].density.unwrap_or_default());
        solver.all_outputs = case.outputs == Outputs::Full;
        let start = set_up(case, &mut solver);
        Ok(Run {
            case,
            solver,
            smith,
            samples: Vec::new(),
            snapshots: Vec::new(),
            frames: Vec::new(),
            broken: None,
            looked_at: 0,
            untouched: 0.0,
            start,
        })
    }

    fn go(mut self, progress: &dyn Fn(f64)) -> Result<Outcome, Error> {
        let begun = Instant::now();
        let (mut next_sample, mut next_frame) = (0.0, 0.0);
        let frame = self.case.end / self.case.frames.max(1) as f64;
        let mut pictures = self.case.pictures.clone();
        pictures.sort_by(|a, b| b.total_cmp(a));
        let end = loop {
            let time = self.solver.time;
            let sampled = time >= next_sample || time >= self.case.end;
            let drawn = pictures.last().is_some_and(|&picture| time >= picture);
            let framed = self.case.frames > 0 && time >= next_frame;
            let state = (drawn || framed).then(|| self.positions());
            self.solver.advance(sampled || drawn || framed, self.case.end);
            if sampled {
                self.sample(time);
                next_sample += self.case.sample;
                progress(time / self.case.end);
            }
            if let Some(positions) = state {
                if drawn {
                    pictures.pop();
                    self.snapshots.push(self.snapshot(time, positions));
                }
                if framed {
                    next_frame += frame;
                    self.frames.push((time, vtu::unstructured_grid(&self.solver)));
                }
            }
            if let Some(end) = self.ended(time) {
                break end;
            }
        };
        progress(1.0);
        Ok(Outcome {
            samples: self.samples,
            snapshots: self.snapshots,
            frames: self.frames,
            end,
            broken: self.broken,
            cost: self.solver.cost,
            wall: begun.elapsed(),
            smith: self.smith,
            mesh: self.solver.mesh,
        })
    }

    fn positions(&self) -> Vec<[f64; 3]> {
        (0..self.solver.mesh.nodes.len()).map(|node| self.solver.position(node)).collect()
    }

    fn snapshot(&self, time: f64, positions: Vec<[f64; 3]>) -> Snapshot {
        let elements = 0..self.solver.mesh.elements.len();
        Snapshot {
            time,
            positions,
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
        if self.broken.is_none() && self.solver.deleted.len() > self.looked_at {
            self.looked_at = self.solver.deleted.len();
            if self.severed() {
                self.broken = Some((time, self.speed()));
            }
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

    /// Whether no way leads from the clamp to mid-span through faces that intact elements share.
    fn severed(&self) -> bool {
        let yarn = &self.case.yarn;
        let number = |[layer, column, row]: [usize; 3]| (layer * yarn.columns + column) * yarn.rows + row;
        let counts = [yarn.layers, yarn.columns, yarn.rows];
        let mut seen = vec![false; counts.iter().product()];
        let last = yarn.layers - 1;
        let mut open: Vec<[usize; 3]> =
            (0..yarn.columns).flat_map(|column| (0..yarn.rows).map(move |row| [last, column, row])).collect();
        while let Some(place) = open.pop() {
            if std::mem::replace(&mut seen[number(place)], true) || !self.solver.is_intact(number(place)) {
                continue;
            }
            if place[0] == 0 {
                return false;
            }
            for axis in 0..3 {
                let mut neighbour = place;
                for step in [place[axis].wrapping_sub(1), place[axis] + 1] {
                    neighbour[axis] = step;
                    if step < counts[axis] {
                        open.push(neighbour);
                    }
                }
            }
        }
        true
    }

    fn sample(&mut self, time: f64) {
        let mut sample = Sample { time, speed: self.speed(), deleted: self.solver.deleted.len(), ..Sample::default() };
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
            sample.index = sample.index.max(self.solver.failure_index(i));
        }
    }

    /// Mean elongation of a layer's intact elements.
    fn elongation(&self, layer: usize) -> f64 {
        let per_layer = self.solver.mesh.elements_per_layer;
        let intact = (layer * per_layer..(layer + 1) * per_layer).filter(|&i| self.solver.is_intact(i));
        let (sum, count) = intact.fold((0.0, 0), |(sum, count), i| (sum + self.solver.elongation(i), count + 1));
        if count == 0 { 0.0 } else { sum / f64::from(count) }
    }

    fn measure_fronts(&self, sample: &mut Sample) {
        let layers = self.case.yarn.layers;
        let length = self.case.yarn.length / layers as f64;
        let threshold = 0.5 * self.smith.strain.ln_1p();
        let strains: Vec<f64> = (0..layers).map(|layer| self.elongation(layer)).collect();
        // Layers are measured in their middles.
        sample.longitudinal = front(&strains, threshold).map_or(0.0, |place| (place + 0.5) * length);
        let [from, to] = PLATEAU.map(|fraction| (fraction * sample.longitudinal / length) as usize);
        let plateau = &strains[from..to.max(from + 1).min(layers)];
        sample.strain = (plateau.iter().sum::<f64>() / plateau.len() as f64).exp_m1();
        let velocities: Vec<f64> = (0..=layers).map(|section| -self.section_mean(section).1).collect();
        if let Some(place) = front(&velocities, 0.5 * self.speed()) {
            let (section, part) = (place as usize, place.fract());
            let [here, next] = [section, (section + 1).min(layers)].map(|section| self.section_mean(section).0);
            sample.transverse = here + part * (next - here);
        }
    }

    /// Mean of a section's positions along the yarn and of its velocities along axis 1.
    fn section_mean(&self, section: usize) -> (f64, f64) {
        let count = self.solver.mesh.nodes_per_section;
        let nodes = section * count..(section + 1) * count;
        let (x, v) = nodes.fold((0.0, 0.0), |(x, v), node| {
            (x + self.solver.position(node)[0], v + self.solver.velocity[node][1].into())
        });
        (x / count as f64, v / count as f64)
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

fn larger(largest: &mut [f64; 5], values: [f64; 5]) {
    for (largest, value) in largest.iter_mut().zip(values) {
        *largest = largest.max(value);
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

    /// The largest difference of the total energy from what it was, over the work from outside or, without any, over the
    /// energy that was there.
    pub fn imbalance(&self) -> f64 {
        let Some(first) = self.samples.first().map(|sample| sample.energies.total()) else { return 0.0 };
        let work = self.samples.iter().map(|sample| sample.energies.external).fold(0.0, f64::max);
        let scale = if work > 0.0 { work } else { first };
        self.samples.iter().map(|sample| (sample.energies.total() - first).abs() / scale).fold(0.0, f64::max)
    }

    /// The largest failure index of the samples up to the break.
    pub fn largest_index(&self) -> f64 {
        let end = self.broken.map_or(f64::INFINITY, |(time, _)| time);
        self.samples.iter().take_while(|sample| sample.time <= end).map(|sample| sample.index).fold(0.0, f64::max)
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
