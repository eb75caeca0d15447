//! A case from its first step to its last, and what is measured on the way.

use std::time::Instant;

use super::outcome::{End, Outcome, STATIONS, Sample};
use super::scene::{Case, Outputs, Precision, Striker, Zones};
use crate::common::error::Error;
use crate::common::units::number;
use crate::explicit::body::{Body, Support};
use crate::explicit::contact::Contact;
use crate::explicit::energies::{Balance, Energies};
use crate::explicit::judgement::MEASURED_EVERY;
use crate::explicit::lanes::{Number, largest};
use crate::explicit::medium::Medium;
use crate::explicit::projectile::Projectile;
use crate::explicit::snapshot::Snapshot;
use crate::explicit::solver::Solver;
use crate::explicit::vtu;
use crate::material::model::Material;
use crate::material::smith::{LARGEST_STRAIN, Smith, Tension};

/// The front of the elongation is where the strain has this part of what Smith's theory gives behind it.
pub const FRONT: f64 = 0.5;
/// Where, as fractions of the way to the front of the elongation, the strain behind it is taken.
pub const PLATEAU: [f64; 2] = [0.3, 0.7];
/// Times closer than this part of a case's time are the same.
const ROUNDING: f64 = 1e-9;

/// Receives the progress and the frames of a run.
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

/// An observer that does nothing.
impl Observer for () {}

/// Runs a case.
///
/// # Errors
/// A material that the host cannot use, a speed beyond every yarn, a run that is not stable, or the observer's.
pub fn run(case: &Case, observer: &mut dyn Observer) -> Result<Outcome, Error> {
    match case.precision {
        Precision::F64 => Run::<f64>::new(case)?.run(observer),
        Precision::F32 => Run::<f32>::new(case)?.run(observer),
    }
}

struct Run<'a, T> {
    case: &'a Case,
    solver: Solver<T>,
    smith: Smith,
    measured: Vec<Sample>,
    balance: Balance,
    history: Vec<Sample>,
    snapshots: Vec<Snapshot>,
    broken: Option<(f64, f64)>,
    /// Deleted elements so far, and the lines of elements along the fibre that have lost one.
    deleted: usize,
    torn: Vec<bool>,
    /// When the projectile was last in contact.
    last_contact: f64,
    start: f64,
}

impl<'a, T: Number> Run<'a, T> {
    fn new(case: &'a Case) -> Result<Self, Error> {
        let medium =
            |material: &Material| Medium::<T>::new(material, material.density.unwrap_or_default(), case.control);
        let mesh = case.yarn.mesh();
        let per_layer = mesh.elements_per_layer;
        let materials = case.zones.materials();
        let length = match case.zones {
            Zones::One(_) => case.yarn.length,
            Zones::Two(_, length) => length,
        };
        let near = case.yarn.layers_to(length);
        let media = materials.iter().map(medium).collect::<Result<Vec<_>, _>>()?;
        let yarn = Body::new(mesh, &media, |element| usize::from(element / per_layer >= near));
        let mut solver = Solver::new(vec![yarn], media);
        let density = materials[0].density.unwrap_or_default();
        let smith =
            Tension::of(&materials[0]).and_then(|tension| tension.smith(case.speed, density)).ok_or_else(|| {
                let allowed = format!("what stretches a yarn by up to {LARGEST_STRAIN}");
                Error::Input(format!("case {}: speed is {}; allowed: {allowed}", case.name, case.speed))
            })?;
        solver.all_outputs = case.outputs == Outputs::Full;
        let start = set_up(case, &mut solver);
        Ok(Run {
            case,
            solver,
            smith,
            measured: Vec::new(),
            balance: Balance::default(),
            history: Vec::new(),
            snapshots: Vec::new(),
            broken: None,
            deleted: 0,
            torn: vec![false; per_layer],
            last_contact: 0.0,
            start,
        })
    }

    fn run(mut self, observer: &mut dyn Observer) -> Result<Outcome, Error> {
        let begun = Instant::now();
        let (mut next_sample, mut next_frame) = (0.0, 0.0);
        let frame = self.case.end / self.case.frames.max(1) as f64;
        let mut pictures = self.case.pictures.clone();
        pictures.sort_by(|a, b| b.total_cmp(a));
        let mut end = None;
        let end = loop {
            let time = self.solver.state.time;
            let reached = |instant: f64| time >= instant - ROUNDING * self.case.end;
            end = end.or(reached(self.case.end).then_some(End::Time));
            let measured = self.solver.state.cost.steps.is_multiple_of(MEASURED_EVERY) || end.is_some();
            let sampled = reached(next_sample) || end.is_some();
            let drawn = pictures.last().is_some_and(|&picture| reached(picture));
            let framed = self.case.frames > 0 && reached(next_frame);
            let left = if end.is_some() { self.case.end } else { self.case.end - time };
            let energies = measured || sampled || drawn || framed;
            self.solver.accelerate(energies, left).map_err(|error| self.error(&error.to_string()))?;
            if measured || sampled {
                let sample = self.sample(time);
                if sampled {
                    self.history.push(sample);
                    next_sample += self.case.sample;
                }
                if measured {
                    self.measure(sample)?;
                    observer.progress(time / self.case.end);
                }
            }
            if drawn {
                pictures.pop();
                self.snapshots.push(Snapshot::of(&self.solver, self.radius()));
            }
            if framed {
                next_frame += frame;
                observer.frame(time, &vtu::unstructured_grid(&self.solver)?)?;
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
            measured: self.measured,
            balance: self.balance,
            history: self.history,
            snapshots: self.snapshots,
            end,
            own_speed: matches!(self.case.striker, Striker::Cylinder { held: false, .. }),
            failed: self.solver.state.failed,
            broken: self.broken,
            cost: self.solver.state.cost,
            wall: begun.elapsed(),
            smith: self.smith,
            mesh: self.solver.bodies.swap_remove(0).mesh,
        })
    }

    /// The only body.
    fn yarn(&self) -> &Body<T> {
        &self.solver.bodies[0]
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
        if self.broken.is_none() && self.check_broken() {
            self.broken = Some((time, self.speed()));
        }
        if let Some(projectile) = &self.solver.projectile {
            if projectile.force != 0.0 {
                self.last_contact = time;
            }
            if projectile.velocity >= 0.0 {
                return Some(End::Stopped);
            }
        }
        // As long as a wave takes to the clamp and back: after that, what is left of the yarn no longer touches it.
        let waiting_time = 2.0 * self.case.yarn.length / self.smith.fastest;
        if self.broken.is_some() && time - self.last_contact > waiting_time {
            return Some(End::Left);
        }
        (time >= self.case.end).then_some(End::Time)
    }

    /// Whether every line of elements along the fibre has lost one. The laws resist shear along the fibre little or not at
    /// all, so that a torn line carries no tension, whatever its neighbours do.
    fn check_broken(&mut self) -> bool {
        let yarn = &self.solver.bodies[0];
        for &element in &yarn.state.deleted[self.deleted..] {
            self.torn[element % yarn.mesh.elements_per_layer] = true;
        }
        self.deleted = yarn.state.deleted.len();
        self.torn.iter().all(|&torn| torn)
    }

    /// The error of a case without a result.
    fn error(&self, reason: &str) -> Error {
        Error::Evaluation(format!("case {} at time {}: {reason}", self.case.name, number(self.solver.state.time)))
    }

    /// What all figures come from.
    ///
    /// # Errors
    /// The balance of energy is lost.
    fn measure(&mut self, sample: Sample) -> Result<(), Error> {
        self.measured.push(sample);
        self.balance.add(&sample.energies);
        self.balance.lost().map_or(Ok(()), |moved| {
            let moved = number(moved);
            Err(self.error(&format!("the total energy is {moved} % from what it was: not stable")))
        })
    }

    fn sample(&self, time: f64) -> Sample {
        let (deleted, collapsed) = (self.yarn().state.deleted.len(), self.yarn().state.collapsed);
        let mut sample = Sample { time, speed: self.speed(), deleted, collapsed, ..Sample::default() };
        if let Some(projectile) = &self.solver.projectile {
            sample.travel = self.start - projectile.position;
            sample.force = projectile.force;
        } else {
            sample.travel = time * self.case.speed;
        }
        sample.energies = whole(&self.solver.state.energies);
        self.measure_densities(&mut sample);
        self.measure_fronts(&mut sample);
        sample.widths = STATIONS.map(|station| self.width(station));
        sample
    }

    fn measure_densities(&self, sample: &mut Sample) {
        let yarn = self.yarn();
        let (length, radius) = (self.case.yarn.length, self.radius());
        sample.least = f64::INFINITY;
        for i in 0..yarn.mesh.elements.len() {
            let densities = yarn.energy_densities(&self.solver.media, i);
            for (part, density) in sample.parts.iter_mut().zip(densities) {
                *part += 2.0 * density * yarn.volume(i);
            }
            if !yarn.is_intact(i) {
                continue;
            }
            let place = (yarn.mesh.layer(i) as f64 + 0.5) / self.case.yarn.layers as f64 * length;
            update_maxima(&mut sample.largest, densities);
            if place > radius && place < length - radius {
                update_maxima(&mut sample.free, densities);
            }
            sample.least = sample.least.min(densities[0] + densities[4]);
            sample.index = largest(sample.index, yarn.failure_index(&self.solver.media, i));
        }
    }

    /// Mean elongation of a layer's intact elements by volume: what a wave carries, whichever elements it is in.
    fn elongation(&self, layer: usize) -> f64 {
        let yarn = self.yarn();
        let per_layer = yarn.mesh.elements_per_layer;
        let intact = (layer * per_layer..(layer + 1) * per_layer).filter(|&i| yarn.is_intact(i));
        let (sum, whole) = intact.fold((0.0, 0.0), |(sum, whole), i| {
            let volume = yarn.volume(i);
            (sum + volume * yarn.elongation(&self.solver.media, i), whole + volume)
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
        let yarn = self.yarn();
        let count = yarn.mesh.nodes_per_section;
        let nodes = section * count..(section + 1) * count;
        let (mass, x, v) = nodes.fold((0.0, 0.0, 0.0), |(sum, x, v), node| {
            let mass = yarn.mass[node];
            let [place, velocity] = [yarn.position(node)[0], yarn.state.velocity[node][1].into()];
            (sum + mass, x + mass * place, v + mass * velocity)
        });
        (x / mass, v / mass)
    }

    fn width(&self, station: f64) -> f64 {
        let yarn = self.yarn();
        let count = yarn.mesh.nodes_per_section;
        let section = (station * self.case.yarn.layers as f64).round() as usize;
        let across = (section * count..(section + 1) * count).map(|node| yarn.position(node)[2]);
        let (low, high) = across.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), z| (l.min(z), h.max(z)));
        high - low
    }
}

/// The outermost place, counted in entries, at which the values fall below a threshold.
pub fn front(values: &[f64], threshold: f64) -> Option<f64> {
    let last = values.iter().rposition(|&value| value >= threshold)?;
    let Some(&next) = values.get(last + 1) else { return Some(last as f64) };
    Some(last as f64 + (values[last] - threshold) / (values[last] - next))
}

fn update_maxima(all: &mut [f64; 5], values: [f64; 5]) {
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
    let yarn = &mut solver.bodies[0];
    let count = yarn.mesh.nodes_per_section;
    let last = case.yarn.layers * count;
    let rest = [0.0; 3];
    for node in 0..count {
        let symmetric = match case.striker {
            Striker::Cylinder { .. } => Support { free: [false, true, true], velocity: rest },
            Striker::Driven => Support { free: [false, false, true], velocity: [0.0, -case.speed, 0.0] },
        };
        yarn.support(node, symmetric);
        yarn.support(last + node, Support { free: [false; 3], velocity: rest });
    }
    let Striker::Cylinder { cylinder, mass, held } = case.striker else { return 0.0 };
    let top = yarn.mesh.nodes.iter().map(|node| node[1]).fold(0.0, f64::max);
    let start = top + cylinder.radius;
    let contact = Contact::new(cylinder, &yarn.mesh.surface, &yarn.mass);
    // Half of it strikes the half model.
    solver.projectile = Some(Projectile::new(0.5 * mass, start, -case.speed, held, vec![contact]));
    start
}
