//! The result of a case in the scene's units: its history, and the quantities computed from it. Energies are of the
//! whole yarn, twice those of the half that LAMMPS has computed.

use super::frame::Frame;
use super::history::{self, Line, Station};
use super::model::{Model, Striking, micro};
use super::run::Raw;
use super::scene::{Case, Striker};
use toron::host::units::UnitSystem;
use toron_explicit_host::lanes::largest;
use toron_materials::material::smith::{Smith, Tension};
use toron_materials::units::{ENERGY, FORCE, LENGTH, SPEED, TIME};
use toron_strikes::impact::run::{FRONT, PLATEAU, front};

/// The part of the half length over which the speeds of fronts are fitted.
const FITTED: [f64; 2] = [0.4, 0.85];
/// The yarn is torn when the force stays below this part of its largest, after a truss has broken.
const TORN: f64 = 0.05;
/// The speed is the residual one if it moves by less than this part of the striking speed in the last tenth of the run.
const STEADY: f64 = 0.005;

/// A line of the history.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    pub time: f64,
    /// Of the projectile or the driven section, along the blow; and how far it has come.
    pub speed: f64,
    pub travel: f64,
    /// On the whole yarn, in the mean since the sample before.
    pub force: f64,
    pub projectile: f64,
    pub kinetic: f64,
    /// In the trusses, in the contacts of fibres, and in those with the projectile.
    pub elongation: f64,
    pub contact: f64,
    pub pressed: f64,
    /// What went with the trusses that broke.
    pub broken: f64,
    /// What friction at the projectile has taken, and friction between fibres: the remainder.
    pub friction_projectile: f64,
    pub friction_fibres: f64,
    /// Work from outside, where the projectile is held or a section driven.
    pub external: f64,
    /// The fastest bead.
    pub fastest: f64,
    /// The largest strain of a truss, and how many have broken in the half that is computed.
    pub strain: f64,
    pub breaks: usize,
    /// Of the section at the stations: from the outermost bead to the other, and the width of a full ellipse whose
    /// points scatter as the beads do.
    pub widths: [f64; 4],
    pub spreads: [f64; 4],
}

impl Sample {
    /// All that friction has taken.
    pub fn friction(&self) -> f64 {
        self.friction_projectile + self.friction_fibres
    }
}

/// The fronts of a driven fibre, and the mean strain behind that of the elongation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fronts {
    pub time: f64,
    pub longitudinal: f64,
    pub transverse: f64,
    pub strain: f64,
}

/// The result of a case.
#[derive(Clone, Debug)]
pub struct Outcome {
    pub model: Model,
    pub samples: Vec<Sample>,
    /// The instants of the pictures.
    pub frames: Vec<Frame>,
    pub fronts: Vec<Fronts>,
    pub smith: Option<Smith>,
    pub seconds: Option<f64>,
    half_length: f64,
}

impl Outcome {
    pub fn new(units: &UnitSystem, case: &Case, model: Model, raw: Raw) -> Outcome {
        let lines: Vec<Line> = raw.rows.iter().filter_map(|row| history::line(row)).collect();
        let samples = samples(units, &model, &lines);
        let smith = Tension::Hooke(case.fibre.modulus).smith(case.speed, case.fibre.density);
        let driven = matches!(case.striker, Striker::Driven { .. });
        // A broken fibre has no plateau.
        let whole = samples.iter().find(|sample| sample.breaks > 0).map_or(f64::INFINITY, |sample| sample.time);
        let fronts = match smith {
            Some(smith) if driven => {
                let all = raw.frames.iter().map(|frame| fronts(units, &model, frame, &smith));
                all.filter(|fronts| fronts.time < whole).collect()
            }
            _ => Vec::new(),
        };
        let frames = raw.frames.into_iter().filter(|frame| model.frames.contains(&frame.step)).collect();
        Outcome { samples, frames, fronts, smith, seconds: raw.seconds, half_length: case.half_length, model }
    }

    pub fn last(&self) -> Sample {
        self.samples.last().copied().unwrap_or_default()
    }

    /// The sample at a time or the first one after.
    pub fn at(&self, time: f64) -> Sample {
        let found = self.samples.iter().find(|sample| sample.time >= time * (1.0 - 1e-9));
        found.copied().unwrap_or_else(|| self.last())
    }

    /// When the first truss broke.
    pub fn first_break(&self) -> Option<f64> {
        self.samples.iter().find(|sample| sample.breaks > 0).map(|sample| sample.time)
    }

    /// When the yarn no longer held the projectile.
    pub fn torn(&self) -> Option<f64> {
        self.first_break()?;
        let limit = TORN * self.samples.iter().fold(0.0, |most: f64, sample| most.max(sample.force));
        let last = self.samples.iter().rposition(|sample| sample.force > limit)?;
        self.samples.get(last + 1).map(|sample| sample.time)
    }

    /// The places of the trusses at rest, and the mean and the largest strain of those that are whole.
    pub fn strains(&self, units: &UnitSystem, frame: &Frame) -> impl Iterator<Item = (f64, [f64; 2])> {
        let length = micro(units, LENGTH) * self.model.spacing;
        let strains =
            move |layer: usize| Some((length * (layer as f64 + 0.5), frame.strain(layer, self.model.limit())?));
        (0..frame.layers() - 1).filter_map(strains)
    }

    /// The speed that the projectile keeps when it has torn the yarn.
    pub fn residual_speed(&self) -> Option<f64> {
        let Striking::Cylinder { held: false, .. } = self.model.striker else { return None };
        self.torn()?;
        let (last, striking) = (self.last(), self.samples.first()?.speed);
        let before = self.at(0.9 * last.time);
        ((last.speed - before.speed).abs() < STEADY * striking).then_some(last.speed)
    }

    /// What friction of fibres has taken, and friction at the projectile; none where nothing rubs, and the remainder is
    /// what the balance is off by.
    pub fn frictions(&self) -> [Option<f64>; 2] {
        let at_projectile = matches!(self.model.striker, Striking::Cylinder { friction, .. } if friction > 0.0);
        let Sample { friction_fibres, friction_projectile, .. } = self.last();
        [(self.model.friction > 0.0).then_some(friction_fibres), at_projectile.then_some(friction_projectile)]
    }

    /// How much friction seems to have given back at most, over the energy that came in: 0 but for what the step leaves
    /// of the balance. Without friction, by how much the balance is off.
    pub fn imbalance(&self) -> f64 {
        let frictionless = self.frictions() == [None; 2];
        let scale = self.samples.iter().fold(0.0, |most: f64, s| most.max(s.projectile).max(s.external.abs()));
        let (mut highest, mut worst): (f64, f64) = (0.0, 0.0);
        for friction in self.samples.iter().map(Sample::friction) {
            worst = largest(worst, if frictionless { friction.abs() } else { highest - friction });
            highest = largest(highest, friction);
        }
        if scale == 0.0 { 0.0 } else { worst / scale }
    }

    /// The fronts while that of the elongation passes the middle of half the span.
    fn passing(&self) -> Vec<Fronts> {
        let [from, to] = FITTED.map(|part| part * self.half_length);
        let until = self.fronts.iter().position(|front| front.longitudinal > to).unwrap_or(self.fronts.len());
        self.fronts[..until].iter().copied().filter(|front| front.longitudinal >= from).collect()
    }

    /// The speed of a front: the slope of a fitted line.
    pub fn front_speed(&self, place: impl Fn(&Fronts) -> f64) -> Option<f64> {
        let passing = self.passing();
        let n = passing.len() as f64;
        let mean = |of: &dyn Fn(&Fronts) -> f64| passing.iter().map(of).sum::<f64>() / n;
        let (t, x) = (mean(&|front| front.time), mean(&place));
        let above = mean(&|front| (front.time - t) * (place(front) - x));
        let below = mean(&|front| (front.time - t).powi(2));
        (below > 0.0).then(|| above / below)
    }

    /// The mean strain behind the front meanwhile.
    pub fn plateau(&self) -> Option<f64> {
        let passing = self.passing();
        let sum: f64 = passing.iter().map(|front| front.strain).sum();
        (!passing.is_empty()).then(|| sum / passing.len() as f64)
    }
}

fn samples(units: &UnitSystem, model: &Model, lines: &[Line]) -> Vec<Sample> {
    let [length, time, speed, energy, force] =
        [LENGTH, TIME, SPEED, ENERGY, FORCE].map(|dimension| micro(units, dimension));
    let whole = 2.0 * energy;
    let (mass, held) = match model.striker {
        Striking::Cylinder { mass, held, .. } => (mass, held),
        Striking::Driven { .. } | Striking::Walls(_) => (0.0, true),
    };
    let driven = model.near == 0;
    let striking = |v: f64| if held { 0.0 } else { 0.5 * mass * v * v };
    let trusses = (model.centres.len() * (model.beads - 1)) as f64;
    let start = striking(model.speed);
    let mut first = Sample {
        speed: if driven { 0.0 } else { model.speed * speed },
        projectile: whole * start,
        ..Sample::default()
    };
    if let Some(line) = lines.first() {
        // Layers at the stations are at rest until the wave comes.
        first.spreads = line.stations.map(|station| length * spread(&station));
        first.widths = line.stations.map(|station| length * (station.most - station.least));
    }
    let mut samples = vec![first];
    let (mut before, mut external, mut work, mut rubbed) = (0.0, 0.0, 0.0, 0.0);
    for line in lines {
        let passed = line.time - before;
        before = line.time;
        if driven {
            work += line.power * passed;
            // The force that moves the section does so with its own mass as well.
            external = work + 0.25 * model.centres.len() as f64 * model.bead_mass * line.speed * line.speed;
        } else {
            rubbed -= line.power * passed;
            // The mean force times the speed, which a held projectile keeps.
            external += if held { line.force * line.speed * passed } else { 0.0 };
        }
        let breaks = (trusses - line.left).round().max(0.0);
        let broken = breaks * model.energy_of_break();
        let projectile = striking(line.speed);
        let stored = projectile + line.kinetic + line.trusses + line.contact + line.pressed + broken;
        let friction = start + external - stored;
        let at_projectile = if driven { 0.0 } else { rubbed - line.pressed };
        samples.push(Sample {
            time: time * line.time,
            speed: -speed * line.speed,
            travel: -length * line.way,
            force: -2.0 * force * line.force,
            projectile: whole * projectile,
            kinetic: whole * line.kinetic,
            elongation: whole * line.trusses,
            contact: whole * line.contact,
            pressed: whole * line.pressed,
            broken: whole * broken,
            friction_projectile: whole * at_projectile,
            friction_fibres: whole * (friction - at_projectile),
            external: whole * external,
            fastest: speed * line.fastest.sqrt(),
            strain: line.longest / model.spacing - 1.0,
            breaks: breaks as usize,
            widths: line.stations.map(|station| length * (station.most - station.least)),
            spreads: line.stations.map(|station| length * spread(&station)),
        });
    }
    samples
}

/// Points that fill an ellipse scatter by a quarter of its width.
fn spread(station: &Station) -> f64 {
    4.0 * (station.mean_square - station.mean * station.mean).max(0.0).sqrt()
}

fn fronts(units: &UnitSystem, model: &Model, frame: &Frame, smith: &Smith) -> Fronts {
    let [length, time] = [LENGTH, TIME].map(|dimension| micro(units, dimension));
    let mean = |layer: usize| frame.strains(layer).sum::<f64>() / model.centres.len() as f64;
    let strains: Vec<f64> = (0..frame.layers() - 1).map(mean).collect();
    // A truss is measured in its middle.
    let longitudinal = front(&strains, FRONT * smith.strain).map_or(0.0, |place| place + 0.5);
    let [from, to] = PLATEAU.map(|part| (part * longitudinal) as usize);
    let plateau = &strains[from..to.max(from + 1).min(strains.len())];
    let fibres = model.centres.len();
    let of_layer = |values: &dyn Fn(usize) -> f64, layer: usize| {
        (layer * fibres..(layer + 1) * fibres).map(values).sum::<f64>() / fibres as f64
    };
    let velocities: Vec<f64> = (0..frame.layers()).map(|layer| of_layer(&|bead| -frame.values[bead], layer)).collect();
    let transverse = front(&velocities, FRONT * model.speed).map_or(0.0, |place| {
        let (layer, part) = (place as usize, place.fract());
        let [here, next] =
            [layer, (layer + 1).min(frame.layers() - 1)].map(|layer| of_layer(&|bead| frame.positions[bead][0], layer));
        here + part * (next - here)
    });
    Fronts {
        time: time * frame.step as f64 * model.step,
        longitudinal: length * longitudinal * model.spacing,
        transverse: length * transverse,
        strain: plateau.iter().sum::<f64>() / plateau.len() as f64,
    }
}
