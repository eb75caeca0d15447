//! A yarn as it is struck: how it is set up, what is measured of it, and when it has broken.

use super::outcome::{Course, OfYarn, Outcome, STATIONS, Sample};
use super::scene::{Case, Outputs, Striker, Zones};
use toron_explicit_host::body::{Body, Support};
use toron_explicit_host::contact::Contact;
use toron_explicit_host::lanes::{Number, largest};
use toron_explicit_host::medium::Medium;
use toron_explicit_host::solver::Solver;
use toron_explicit_host::striker;
use toron_explicit_host::struck::plan::Plan;
use toron_explicit_host::struck::run::{self, Observer, Struck};
use toron_materials::material::model::Material;
use toron_materials::material::smith::{LARGEST_STRAIN, Smith, Tension};
use toron_shared::error::Error;

/// The front of the elongation is where the strain has this part of what Smith's theory gives behind it.
pub const FRONT: f64 = 0.5;
/// Where, as fractions of the way to the front of the elongation, the strain behind it is taken.
pub const PLATEAU: [f64; 2] = [0.3, 0.7];
/// Half of the yarn is computed.
const WHOLE: f64 = 2.0;

/// Runs a case.
///
/// # Errors
/// A material that the host cannot use, a speed beyond every yarn, a run that is not stable, or the observer's.
pub fn run(case: &Case, observer: &mut (dyn Observer<OfYarn> + Send)) -> Result<Outcome, Error> {
    let yarn = StruckYarn::new(case)?;
    let outcome = yarn.outcome(run::run(&yarn, None, observer)?);
    match outcome.failure.clone() {
        None => Ok(outcome),
        Some(failure) => Err(Error::Evaluation(failure)),
    }
}

/// A case that can be run.
pub struct StruckYarn<'a> {
    pub case: &'a Case,
    smith: Smith,
}

impl<'a> StruckYarn<'a> {
    /// # Errors
    /// A material that the host cannot use, or a speed beyond every yarn.
    pub fn new(case: &'a Case) -> Result<Self, Error> {
        let material = case.zones.inner();
        let density = material.density.unwrap_or_default();
        let smith = Tension::of(material).and_then(|tension| tension.smith(case.speed, density)).ok_or_else(|| {
            let allowed = format!("what stretches a yarn by up to {LARGEST_STRAIN}");
            Error::Input(format!("case {}: speed is {}; allowed: {allowed}", case.name, case.speed))
        })?;
        let yarn = StruckYarn { case, smith };
        yarn.media::<f64>()?;
        Ok(yarn)
    }

    /// What came of its run.
    pub fn outcome(&self, run: run::Outcome<OfYarn, Course>) -> Outcome {
        let own_speed = matches!(self.case.striker, Striker::Cylinder { held: false, .. });
        Outcome { run, mesh: self.case.yarn.mesh(), own_speed, smith: self.smith }
    }

    fn media<T: Number>(&self) -> Result<Vec<Medium<T>>, Error> {
        let Case { zones, control, .. } = self.case;
        let medium = |material: &Material| Medium::new(material, material.density.unwrap_or_default(), *control);
        zones.materials().iter().map(medium).collect()
    }
}

impl Struck for StruckYarn<'_> {
    type Own = OfYarn;
    type Course = Course;

    fn name(&self) -> &str {
        &self.case.name
    }

    fn plan(&self) -> &Plan {
        &self.case.plan
    }

    fn single_precision(&self) -> bool {
        self.case.single_precision
    }

    fn identity(&self) -> String {
        format!("{:?}", Case { plan: Plan::default(), ..self.case.clone() })
    }

    fn solver<T: Number>(&self) -> Result<Solver<T>, Error> {
        let case = self.case;
        let (mesh, media) = (case.yarn.mesh(), self.media()?);
        let per_layer = mesh.elements_per_layer;
        let length = match case.zones {
            Zones::One(_) => case.yarn.length,
            Zones::Two(_, length) => length,
        };
        let near = case.yarn.layers_to(length);
        let mut yarn = Body::new(mesh, &media, |element| usize::from(element / per_layer >= near));
        if let Some(limits) = case.limits(&yarn.mesh) {
            yarn.limit(&limits);
        }
        let mut solver = Solver::new(vec![yarn], media);
        solver.all_outputs = case.outputs == Outputs::Full;
        set_up(case, &mut solver);
        Ok(solver)
    }

    fn radius(&self) -> f64 {
        match self.case.striker {
            Striker::Cylinder { cylinder, .. } => cylinder.radius,
            Striker::Driven => 0.0,
        }
    }

    fn sample<T: Number>(&self, solver: &Solver<T>, start: f64) -> Sample {
        let mut sample = Sample::of(solver, WHOLE, start);
        if self.case.striker == Striker::Driven {
            (sample.speed, sample.travel) = (self.case.speed, sample.time * self.case.speed);
        }
        let measured = Measured { case: self.case, smith: &self.smith, solver };
        measured.measure_densities(self.radius(), &mut sample.own);
        measured.measure_fronts(&mut sample.own);
        sample.own.widths = STATIONS.map(|station| measured.width(station));
        sample
    }

    /// The yarn has broken when every line of elements along the fibre has lost one. The laws resist shear along the
    /// fibre little or not at all, so that a torn line carries no tension, whatever its neighbours do.
    fn follow<T: Number>(&self, solver: &Solver<T>, course: &mut Course) -> Result<(), Error> {
        let yarn = &solver.bodies[0];
        course.torn.resize(yarn.mesh.elements_per_layer, false);
        for &element in &yarn.state.deleted[course.deleted..] {
            course.torn[element % yarn.mesh.elements_per_layer] = true;
        }
        course.deleted = yarn.state.deleted.len();
        if course.broken.is_none() && course.torn.iter().all(|&torn| torn) {
            let speed = solver.striker.as_ref().map_or(self.case.speed, |striker| -striker.velocity);
            course.broken = Some((solver.state.time, speed));
        }
        Ok(())
    }

    /// As long as a wave takes to the clamp and back: after that, what is left of the yarn no longer touches it.
    fn has_left<T: Number>(&self, _: &Solver<T>, course: &Course, free: f64) -> bool {
        course.broken.is_some() && free > 2.0 * self.case.yarn.length / self.smith.fastest
    }
}

/// A yarn at an instant.
struct Measured<'a, T> {
    case: &'a Case,
    smith: &'a Smith,
    solver: &'a Solver<T>,
}

impl<T: Number> Measured<'_, T> {
    /// The only body.
    fn yarn(&self) -> &Body<T> {
        &self.solver.bodies[0]
    }

    fn measure_densities(&self, radius: f64, sample: &mut OfYarn) {
        let (yarn, length) = (self.yarn(), self.case.yarn.length);
        sample.least = f64::INFINITY;
        for i in (0..yarn.mesh.elements.len()).filter(|&i| yarn.is_intact(i)) {
            let densities = yarn.energy_densities(&self.solver.media, i);
            let place = (yarn.mesh.layer(i) as f64 + 0.5) / self.case.yarn.layers as f64 * length;
            if place > radius && place < length - radius {
                for (most, density) in sample.free.iter_mut().zip(densities) {
                    *most = largest(*most, density);
                }
            }
            sample.least = sample.least.min(densities[0] + densities[4]);
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

    fn measure_fronts(&self, sample: &mut OfYarn) {
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

/// Symmetry at mid-span, the clamp at the other end, and what strikes.
fn set_up<T: Number>(case: &Case, solver: &mut Solver<T>) {
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
    let Striker::Cylinder { cylinder, mass, held } = case.striker else { return };
    let top = yarn.mesh.nodes.iter().map(|node| node[1]).fold(0.0, f64::max);
    let start = top + cylinder.radius;
    let contact = Contact::new(cylinder, &yarn.mesh.surface);
    // Half of it strikes the half model.
    solver.striker = Some(striker::Striker::new(0.5 * mass, start, -case.speed, held, vec![contact]));
}
