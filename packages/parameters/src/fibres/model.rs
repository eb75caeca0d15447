//! A case in the units of LAMMPS's `micro` (µm, pg, µs: forces in nN, energies in fJ, speeds in m/s), as its input has
//! it.

use super::pressed::middle::Middle;
use super::scene::{Case, MASS, Striker, Walls, contact_dimension};
use super::section::Section;
use toron::host::units::UnitSystem;
use toron::law::parameters::{DENSITY, Dimension, STRESS};
use toron_materials::units::{LENGTH, SPEED, TIME};
use toron_shared::error::Error;
use toron_strikes::impact::outcome::STATIONS;

/// LAMMPS's units of mass, length and time in SI.
const PICOGRAM: f64 = 1e-15;
const MICRO: f64 = 1e-6;
/// A mean over a line of the history takes one step of so many; of a driven section, which has few beads, each.
const STRIDE: u64 = 2;
/// Friction brings this part of the sliding speed of two beads to rest in a step, unless Coulomb's limit is reached
/// before: a bead has up to six neighbours.
const STICKING: f64 = 0.2;
/// The most neighbours' contacts that move a bead in one direction: those of a hexagonal packing make six, and twice
/// that at the plane of symmetry, where beads have half their mass.
const CONTACTS: f64 = 12.0;
/// Beads that are further from mid-span than this, in radii of the projectile, never touch it.
const NEAR: f64 = 1.5;
/// Walls are so many times as stiff as the first touch of two fibres.
const WALL: f64 = 10.0;
/// The part of a biaxial test in which a pressure on all sides comes in and settles.
const CONSOLIDATION: f64 = 0.2;
/// How many times a run writes a restart file.
const RESTARTS: u64 = 40;

/// The unit of LAMMPS in a scene's units.
pub fn micro(units: &UnitSystem, dimension: Dimension) -> f64 {
    let si = PICOGRAM.powi(dimension.mass) * MICRO.powi(dimension.length) * MICRO.powi(dimension.time);
    units.from_si(si, dimension)
}

/// A case as LAMMPS gets it.
#[derive(Clone, Debug)]
pub struct Model {
    pub section: Section,
    /// Beads of a fibre, from the plane of symmetry to the clamp, and between two of them.
    pub beads: usize,
    pub spacing: f64,
    pub diameter: f64,
    pub half_length: f64,
    /// Centres of the fibres: across the yarn and along the blow.
    pub centres: Vec<[f64; 2]>,
    pub bead_mass: f64,
    /// Force over elongation of a truss, and the length at which it breaks.
    pub truss: f64,
    pub longest: Option<f64>,
    /// Of the force between two beads over the depth.
    pub contact: [f64; 3],
    pub friction: f64,
    /// The rate at which friction stops two beads.
    pub sticking: f64,
    pub striker: Striking,
    pub speed: f64,
    pub step: f64,
    /// Steps of the run, between two lines of the history, and between two restart files.
    pub steps: u64,
    pub sample: u64,
    /// Steps between two that a mean takes.
    pub stride: u64,
    pub restart: u64,
    /// The steps at which the beads are written.
    pub frames: Vec<u64>,
    /// Layers of beads that may touch the projectile, and those at which the section is measured.
    pub near: usize,
    pub stations: [usize; 4],
}

/// What strikes, in LAMMPS's units.
#[derive(Clone, Copy, Debug)]
pub enum Striking {
    /// The mass is that of the half that strikes the half model.
    Cylinder {
        radius: f64,
        mass: f64,
        held: bool,
        friction: f64,
        stiffness: f64,
        height: f64,
    },
    Driven {
        ramp: f64,
    },
    Walls(Pressing),
}

/// Walls that press the section.
#[derive(Clone, Copy, Debug)]
pub struct Pressing {
    pub walls: Walls,
    pub closing: f64,
    pub duration: f64,
    /// That the sides keep, and how often the others close or open again.
    pub pressure: f64,
    pub legs: u32,
    /// Half the ways between them at rest, across the yarn and along the blow.
    pub half: [f64; 2],
    /// Of their contact with a bead: force over depth.
    pub stiffness: f64,
    /// The force against a bead's motion, over its speed.
    pub braking: f64,
    /// The step up to which the pressure comes in, on all sides; 0 where none is kept.
    pub consolidation: u64,
    pub middle: Middle,
}

/// A bead, in LAMMPS's units.
#[derive(Clone, Copy)]
struct Bead {
    diameter: f64,
    mass: f64,
    /// Of its contact with another: the coefficients of the force by powers of the depth.
    contact: [f64; 3],
    /// Its length over the one to which the file's contact refers.
    share: f64,
}

/// What strikes the section; `to` converts from the scene's units.
///
/// # Errors
/// The pressed section has no middle.
fn striking(
    case: &Case,
    section: &Section,
    to: &impl Fn(f64, Dimension) -> f64,
    Bead { diameter, mass: bead_mass, contact, share }: Bead,
) -> Result<Striking, Error> {
    Ok(match case.striker {
        Striker::Driven { ramp } => Striking::Driven { ramp: to(ramp, TIME) },
        Striker::Walls { walls, closing, damping, pressure, reload, .. } => Striking::Walls(Pressing {
            walls,
            closing,
            duration: to(case.end, TIME),
            pressure: to(pressure, STRESS),
            legs: if reload { 3 } else { 1 },
            consolidation: 0,
            half: section.size.map(|size| 0.5 * diameter * size),
            stiffness: WALL * contact[0],
            braking: damping * (contact[0] * bead_mass).sqrt(),
            middle: Middle::of(section, case.packing, diameter)
                .map_err(|message| Error::Input(format!("case {}: {message}", case.name)))?,
        }),
        Striker::Cylinder { radius, mass, held, friction, stiffness } => {
            let top = section.centres.iter().map(|centre| centre[1]).fold(f64::NEG_INFINITY, f64::max);
            let radius = to(radius, LENGTH);
            Striking::Cylinder {
                radius,
                mass: 0.5 * to(mass, MASS),
                held,
                friction,
                stiffness: share * to(stiffness, contact_dimension(1)),
                height: (top + 0.5) * diameter + radius,
            }
        }
    })
}

/// The steps of a run.
struct Times {
    step: f64,
    steps: u64,
    /// Steps from one line of the history to the next, and how many lines there are.
    sample: u64,
    lines: u64,
}

impl Times {
    /// Up to `end`, with a line about every `sample`: a whole number of strides between two lines, and of lines in the
    /// run. A step is no longer than `largest`.
    fn new(end: f64, sample: f64, largest: f64, stride: u64) -> Times {
        let lines = (end / sample).round().max(1.0);
        let sample = (end / lines / (largest * stride as f64)).ceil() as u64 * stride;
        Times { step: end / lines / sample as f64, steps: lines as u64 * sample, sample, lines: lines as u64 }
    }
}

impl Model {
    /// # Errors
    /// The fibres do not go into the section.
    pub fn new(units: &UnitSystem, case: &Case) -> Result<Model, Error> {
        let to = |value: f64, dimension: Dimension| value / micro(units, dimension);
        let section = Section::pack(case.fibres, case.outline, case.packing, case.fibre.diameter)
            .map_err(|message| Error::Input(format!("case {}: {message}", case.name)))?;
        let pressed = matches!(case.striker, Striker::Walls { .. });
        let trusses = if pressed { 1.0 } else { (case.half_length / case.spacing).round().max(2.0) };
        let half_length = to(case.half_length, LENGTH);
        let spacing = half_length / trusses;
        let diameter = to(case.fibre.diameter, LENGTH);
        let area = std::f64::consts::FRAC_PI_4 * diameter * diameter;
        let [modulus, density] = [to(case.fibre.modulus, STRESS), to(case.fibre.density, DENSITY)];
        let bead_mass = density * area * spacing;
        let share = spacing / to(case.contact.length, LENGTH);
        let coefficient = |i: usize| share * to(case.contact.coefficients[i], contact_dimension(i + 1));
        let contact = [0, 1, 2].map(coefficient);
        let single = case.fibres == 1;
        let stiffness = if single { 0.0 } else { stiffest(contact, diameter) };
        let end = to(case.end, TIME);
        let mut striker = striking(case, &section, &to, Bead { diameter, mass: bead_mass, contact, share })?;
        let struck = match striker {
            Striking::Cylinder { stiffness, .. } => stiffness,
            Striking::Driven { .. } => 0.0,
            Striking::Walls(Pressing { stiffness, .. }) => stiffness,
        };
        // Central differences are stable to 2/ω: the chain's ω is 2c/spacing, a bead's between its neighbours √(k/m).
        let chain = spacing / (modulus / density).sqrt();
        let bead = 2.0 / ((CONTACTS * stiffness).max(2.0 * struck) / bead_mass).sqrt();
        let largest = if pressed { bead } else { chain.min(bead) };
        let stride = if matches!(striker, Striking::Cylinder { .. }) { STRIDE } else { 1 };
        let Times { step, steps, sample, lines } = Times::new(end, to(case.sample, TIME), case.step * largest, stride);
        if let Striking::Walls(pressing) = &mut striker
            && pressing.walls == Walls::Biaxial
        {
            pressing.consolidation = (CONSOLIDATION * lines as f64).round().max(1.0) as u64 * sample;
        }
        let near = match striker {
            Striking::Cylinder { radius, .. } => (NEAR * radius / spacing).ceil() as usize,
            Striking::Driven { .. } | Striking::Walls(_) => 0,
        };
        let beads = if pressed { 1 } else { trusses as usize + 1 };
        // The beads of a driven section are written with the lines of the history.
        let whole = if matches!(striker, Striking::Driven { .. }) { sample } else { 1 };
        let frame = |time: f64| ((time / (step * whole as f64)).round() as u64 * whole).clamp(whole, steps);
        Ok(Model {
            beads,
            spacing,
            diameter,
            half_length,
            centres: section.centres.iter().map(|centre| centre.map(|x| diameter * x)).collect(),
            section,
            bead_mass,
            truss: modulus * area / spacing,
            longest: case.fibre.strain_at_failure.map(|strain| spacing * (1.0 + strain)),
            contact,
            friction: case.friction,
            sticking: STICKING / step,
            striker,
            speed: to(case.speed, SPEED),
            step,
            steps,
            sample,
            stride,
            restart: sample * lines.div_ceil(RESTARTS),
            frames: case.pictures.iter().map(|&time| frame(to(time, TIME))).collect(),
            near: near.min(beads - 1),
            stations: STATIONS.map(|station| (station * trusses).round() as usize),
        })
    }

    /// A bead that touches nothing, at the place of walls that move by forces, and its mass: the projectile's, or that
    /// of all fibres.
    pub fn carrier(&self) -> Option<([f64; 2], f64)> {
        match self.striker {
            Striking::Cylinder { mass, .. } => Some(([0.0; 2], mass.max(self.bead_mass))),
            Striking::Walls(Pressing { walls: Walls::Biaxial, half, .. }) => {
                Some((half, self.bead_mass * self.all_beads() as f64))
            }
            _ => None,
        }
    }

    /// Beads of all fibres.
    pub fn all_beads(&self) -> usize {
        self.beads * self.centres.len()
    }

    /// The strain at which a truss breaks.
    pub fn limit(&self) -> Option<f64> {
        self.longest.map(|longest| longest / self.spacing - 1.0)
    }

    /// The energy in a truss when it breaks.
    pub fn energy_of_break(&self) -> f64 {
        self.longest.map_or(0.0, |longest| 0.5 * self.truss * (longest - self.spacing).powi(2))
    }
}

/// The steepest that the force becomes down to the depth of a radius.
fn stiffest([a, b, c]: [f64; 3], diameter: f64) -> f64 {
    let slope = |depth: f64| a + 2.0 * b * depth + 3.0 * c * depth * depth;
    // Where the slope has its own extreme, if that is on the way.
    let middle = if c == 0.0 { 0.0 } else { (-b / (3.0 * c)).clamp(0.0, 0.5 * diameter) };
    slope(0.0).max(slope(middle)).max(slope(0.5 * diameter))
}

/// Force over depth of a linear contact that is as far below the force of these coefficients as above it, at most, over
/// depths up to where it is as stiff again as at the first touch.
pub fn middle_stiffness([a, b, c]: [f64; 3]) -> f64 {
    // a + bδ + cδ² is least at −b/2c.
    let least = if c > 0.0 && b < 0.0 { a - b * b / (4.0 * c) } else { a };
    2.0 * a * least / (a + least)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lammps_counts_in_micrometres_picograms_and_microseconds() {
        let units = UnitSystem::parse("mm-g-ms").expect("a system");
        assert!((micro(&units, LENGTH) - 1e-3).abs() < 1e-15);
        assert!((micro(&units, SPEED) - 1.0).abs() < 1e-12);
        // 1 nN/µm is 1e-3 N/m, 1e-6 N/mm.
        assert!((micro(&units, contact_dimension(1)) / 1e-6 - 1.0).abs() < 1e-12);
    }

    /// The slope of this one is greatest in between.
    #[test]
    fn the_steepest_contact_is_found() {
        let (contact, diameter) = ([1000.0, 1e7, -1.1e9], 0.012);
        let slopes = (0..=1000).map(|i| {
            let depth = 0.5 * diameter * f64::from(i) / 1000.0;
            contact[0] + 2.0 * contact[1] * depth + 3.0 * contact[2] * depth * depth
        });
        let most = slopes.fold(0.0, f64::max);
        assert!((stiffest(contact, diameter) / most - 1.0).abs() < 1e-5, "{} {most}", stiffest(contact, diameter));
    }

    #[test]
    fn friction_follows_the_middle_of_the_cubic_law() {
        let contact = [6.013e3, -7.218e8, 7.984e13];
        let middle = middle_stiffness(contact);
        for depth in (0..=90).map(|i| 1e-7 * f64::from(i)) {
            let secant = contact[0] + contact[1] * depth + contact[2] * depth * depth;
            assert!((middle / secant - 1.0).abs() < 0.16, "{depth}: {}", middle / secant);
        }
        assert_eq!(middle_stiffness([500.0, 0.0, 0.0]), 500.0);
    }
}
