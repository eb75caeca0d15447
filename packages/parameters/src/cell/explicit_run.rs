//! A load on the section in the explicit host: what rearranges on the way is carried over by inertia, which statics has
//! not.
//!
//! The walls move so slowly that the fibres are near equilibrium all the time. The density is chosen for the number of
//! steps alone: lengths are counted in diameters, stresses in e_2, masses so that the density is 1. A wave across a
//! fibre then takes a time of about 1.

use serde::{Deserialize, Serialize};

use super::energies::Increment;
use super::model::{Body as Fibre, Model};
use super::run::{Outcome, Shape, Shares};
use super::scene::{Load, Scene};
use toron_explicit_host::body::{Body, Support};
use toron_explicit_host::energies::Energies;
use toron_explicit_host::lanes::Number;
use toron_explicit_host::medium::{Control, Medium};
use toron_explicit_host::mesh::Mesh;
use toron_explicit_host::mutual_contact::{MutualContact, Parameters, Surface};
use toron_explicit_host::snapshot::Snapshot;
use toron_explicit_host::solid::Solid;
use toron_explicit_host::solver::{Ramp, Solver};
use toron_explicit_host::struck::plan::Plan;
use toron_explicit_host::struck::run::{self, End, Observer, OutcomeOf, Struck};
use toron_explicit_host::struck::sample::Sample;
use toron_shared::error::Error;

/// Pressure by depth of penetration over e_2 a diameter.
const STIFFNESS: f64 = 200.0;
/// In diameters: nodes nearer to faces than this are looked at in every step, deeper ones have come through from the
/// other side.
const MARGIN: f64 = 0.05;
const DEEPEST: f64 = 0.1;
/// The longest step over the time √(m/k) of a node with the whole stiffness of contact.
const CONTACT_STEP: f64 = 1.0;
/// How long a load takes, by the larger side of the section in diameters.
const DURATION: f64 = 80.0;
/// Before it, what overlaps at the start is let apart, and its vibrations are braked.
const SETTLING: f64 = 20.0;
const SETTLING_BRAKE: f64 = 0.5;
/// The brake in the load: what has snapped to another place comes to rest within a fraction of it.
const BRAKE: f64 = 0.01;
/// With half of the shear modulus against hourglass modes, elements bend about as the solid does.
const CONTROL: Control = Control { hourglass: 0.5, linear: 0.06, quadratic: 1.5, shape: 0.2, by_direction: false };

/// Runs a load, from a checkpoint on if there is one.
///
/// # Errors
/// None of its increments is reached, or the checkpoint is not this load's.
pub fn run(
    scene: &Scene,
    model: &Model,
    load: Load,
    checkpoint: Option<&[u8]>,
    observer: &mut (dyn Observer<OfSection> + Send),
) -> Result<Outcome, Error> {
    let section = Section::new(scene, model, load);
    section.outcome(run::run(&section, checkpoint, observer)?)
}

/// What is measured of a section: the strain energy of the middle's fibres, and of all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OfSection {
    middle: f64,
    whole: f64,
}

/// A load on a section, ready to be run.
pub struct Section<'a> {
    scene: &'a Scene,
    model: &'a Model,
    load: Load,
    ramp: Ramp,
    /// The end of the settling, and of each increment.
    stops: Vec<f64>,
    plan: Plan,
    thickness: f64,
}

impl<'a> Section<'a> {
    pub fn new(scene: &'a Scene, model: &'a Model, load: Load) -> Self {
        let duration = DURATION * model.size[0].max(model.size[1]);
        let ramp = Ramp { start: SETTLING, duration, brake: [SETTLING_BRAKE, BRAKE] };
        let increments = (1..=scene.increments).map(|number| number as f64 / scene.increments as f64);
        let stops = increments.map(|part| ramp.start + duration * time_of(part));
        let stops: Vec<f64> = std::iter::once(ramp.start).chain(stops).collect();
        // The ramp is there a little before its time is over, to all digits.
        let end = stops.last().copied().unwrap_or(ramp.start);
        Section {
            scene,
            model,
            load,
            ramp,
            stops,
            plan: Plan { end, checkpoints: scene.increments, ..Plan::default() },
            // As thick as the elements on the circumference are wide.
            thickness: std::f64::consts::PI / (8 * scene.elements) as f64,
        }
    }

    /// What came of the run: the first line of its history is what had settled, each other one an increment.
    pub fn outcome(&self, run: OutcomeOf<Self>) -> Result<Outcome, Error> {
        let Section { scene, model, load, .. } = self;
        let settled = run.history.first().copied().unwrap_or_default();
        let last_stretch = scene.last_stretch(*load);
        let reached = run.history.iter().skip(1).enumerate();
        let increments: Vec<Increment> = reached
            .map(|(number, sample)| {
                let part = (number + 1) as f64 / scene.increments as f64;
                self.increment(1.0 + part * (last_stretch - 1.0), sample, &settled.energies)
            })
            .collect();
        let missing = || format!("load {}: increment {} is not reached: ", load.name(), increments.len() + 1);
        let failure = match (run.failure, run.end) {
            (Some(failure), _) => Some(missing() + &failure),
            (None, End::Interrupted) => Some(missing() + "interrupted"),
            (None, _) => None,
        };
        let (Some(last), Some(snapshot)) =
            (run.history.last().filter(|_| !increments.is_empty()), run.snapshots.last())
        else {
            return Err(Error::Evaluation(failure.unwrap_or_default()));
        };
        Ok(Outcome {
            load: *load,
            shape: shape(model, &self.meshes(), snapshot, scene.fibre.e_2),
            shares: Some(shares(&last.energies, &settled.energies, run.cost.steps)),
            increments,
            refined: None,
            failure,
            elapsed: run.wall,
        })
    }

    fn increment(&self, stretch: f64, sample: &Sample<OfSection>, settled: &Energies) -> Increment {
        let Section { scene, model, load, thickness, .. } = self;
        let over = |area: f64, energy: f64| scene.fibre.e_2 * energy / (thickness * area);
        Increment {
            stretch,
            invariants: load.invariants(stretch),
            energy: over(model.middle_area, sample.own.middle),
            whole: over(model.area, sample.own.whole),
            springs: 0.0,
            work: over(model.area, sample.energies.external),
            friction: over(model.area, sample.energies.friction - settled.friction),
        }
    }

    /// Fibres and walls, one element thick.
    fn layers(&self) -> impl Iterator<Item = (bool, Layer)> {
        let Section { model, thickness, .. } = *self;
        model.bodies.iter().enumerate().map(move |(number, part)| match number >= model.fibres {
            true => (true, Layer::of_wall(model, part, thickness)),
            false => (false, Layer::of_fibre(model, part, thickness)),
        })
    }

    fn meshes(&self) -> Vec<Mesh> {
        self.layers().map(|(_, layer)| layer.mesh).collect()
    }
}

impl Struck for Section<'_> {
    type Own = OfSection;
    type Course = ();
    const MEASURED_EVERY: Option<u64> = None;
    const DRAWN_AT_END: bool = true;

    fn name(&self) -> &str {
        self.load.name()
    }

    fn plan(&self) -> &Plan {
        &self.plan
    }

    fn single_precision(&self) -> bool {
        false
    }

    fn identity(&self) -> String {
        format!("{:?} {:?}", self.load, self.scene)
    }

    fn stops(&self) -> (&[f64], f64) {
        (&self.stops, self.ramp.duration)
    }

    fn solver<T: Number>(&self) -> Result<Solver<T>, Error> {
        let Section { scene, model, load, .. } = *self;
        let fibre = &scene.fibre;
        let [e_1, g_23] = [fibre.e_1, fibre.g_23].map(|modulus| modulus / fibre.e_2);
        // Nothing shears along the fibres: with the modulus of that, steps would only be shorter.
        let solid = Solid::new([e_1, 1.0], [fibre.nu_12, fibre.nu_23], [g_23, g_23]);
        let media = vec![Medium::of_solid(solid, 1.0, CONTROL)];
        let stretches = load.stretches(scene.last_stretch(load));
        let (mut bodies, mut surfaces) = (Vec::new(), Vec::new());
        // Of all nodes that may touch, the smallest square of the time in which contact turns one back.
        let mut lightest = f64::INFINITY;
        for (wall, layer) in self.layers() {
            // The run ends where an element fails: none is taken out of the contact.
            let elements = vec![0; layer.faces.len()];
            let mut surface = Surface::new(&layer.mesh, layer.faces, elements);
            surface.wall = wall;
            let count = layer.mesh.nodes.len();
            let mut body = Body::new(layer.mesh, &media, |_| 0);
            for node in 0..count {
                // Plane strain; and walls do not deform.
                body.support(node, Support { free: [false, !wall, !wall], velocity: [0.0; 3] });
            }
            let numbers = layer.numbers;
            for support in &model.supports {
                let (mut free, mut velocity) = ([true; 3], [0.0; 3]);
                free[1 + support.axis] = false;
                velocity[1 + support.axis] = (stretches[support.axis] - 1.0) * support.at;
                let fronts = (0..count / 2).filter(|&front| support.nodes.contains(&numbers[front]));
                for node in fronts.flat_map(|front| [front, front + count / 2]) {
                    body.support(node, Support { free, velocity });
                }
            }
            for &node in &surface.state.nodes {
                let node = node as usize;
                lightest = lightest.min(body.mass[node] / (STIFFNESS * surface.area[node]));
            }
            surfaces.push(surface);
            bodies.push(body);
        }
        let mut solver = Solver::new(bodies, media);
        let parameters = Parameters {
            stiffness: STIFFNESS,
            friction: scene.friction,
            margin: MARGIN,
            deepest: DEEPEST,
            pressed_at_rest: true,
        };
        solver.mutual = Some(MutualContact::new(parameters, surfaces));
        solver.longest = CONTACT_STEP * lightest.sqrt();
        solver.ramp = Some(self.ramp);
        Ok(solver)
    }

    fn sample<T: Number>(&self, solver: &Solver<T>, start: f64) -> Sample<OfSection> {
        let strain = |number: usize| {
            let body = &solver.bodies[number];
            body.internal_energy(&solver.media) + body.sums.hourglass
        };
        let own = OfSection {
            middle: self.model.middle.iter().map(|&fibre| strain(fibre)).sum(),
            whole: (0..self.model.fibres).map(strain).sum(),
        };
        Sample { own, ..Sample::of(solver, 1.0, start) }
    }

    fn follow<T: Number>(&self, solver: &Solver<T>, (): &mut ()) -> Result<(), Error> {
        if solver.bodies.iter().any(|body| !body.state.deleted.is_empty()) {
            return Err(Error::Evaluation("an element has been turned inside out".to_string()));
        }
        Ok(())
    }
}

/// Where the work has gone that the walls have done since what overlapped had come to rest.
fn shares(energies: &Energies, settled: &Energies, steps: u64) -> Shares {
    let (strain, work) = (energies.internal + energies.hourglass, energies.external);
    Shares {
        kinetic: energies.kinetic / strain,
        hourglass: energies.hourglass / strain,
        friction: (energies.friction - settled.friction) / work,
        viscosity: (energies.viscosity - settled.viscosity) / work,
        contact: energies.contact / work,
        balance: (energies.total() - settled.total()) / work,
        steps,
    }
}

/// The fibres as they stand, with stresses that are counted in `unit`.
fn shape(model: &Model, meshes: &[Mesh], snapshot: &Snapshot, unit: f64) -> Shape {
    let mut shape = Shape::default();
    let (mut nodes, mut elements) = (0, 0);
    for (fibre, mesh) in model.bodies[..model.fibres].iter().zip(meshes) {
        let place = |node: u32| {
            let [_, x, y] = snapshot.positions[nodes + node as usize];
            [x, y]
        };
        let corners: Vec<[[f64; 2]; 4]> =
            mesh.elements.iter().map(|element| [0, 2, 6, 4].map(|corner| place(element[corner]))).collect();
        for (number, &corners) in corners.iter().enumerate() {
            shape.patches.push((corners, unit * snapshot.von_mises[elements + number]));
        }
        let rims = fibre.rim.iter().map(|(edge, _)| [0, 1].map(|i| corners[edge.quad][(edge.edge + i) % 4]));
        shape.rims.extend(rims);
        (nodes, elements) = (nodes + mesh.nodes.len(), elements + mesh.elements.len());
    }
    shape
}

/// When a ramp of duration 1 has gone this part of its way.
fn time_of(part: f64) -> f64 {
    let ramp = Ramp { start: 0.0, duration: 1.0, brake: [0.0; 2] };
    let [mut low, mut high] = [0.0, 1.0];
    while high - low > 1e-12 {
        let middle = 0.5 * (low + high);
        if ramp.share(middle) < part { low = middle } else { high = middle }
    }
    high
}

/// A layer of hexahedra, axis 0 along the fibres: the nodes of the front, then those behind them.
struct Layer {
    mesh: Mesh,
    /// The model's numbers of the front's nodes; of a wall's all the one of its first, with which it moves.
    numbers: Vec<usize>,
    faces: Vec<[u32; 4]>,
}

impl Layer {
    fn of_fibre(model: &Model, fibre: &Fibre, thickness: f64) -> Layer {
        let mut numbers: Vec<usize> = fibre.quads.iter().flatten().copied().collect();
        numbers.sort_unstable();
        numbers.dedup();
        let points: Vec<[f64; 2]> = numbers.iter().map(|&node| model.nodes[node]).collect();
        let local = |node: &usize| numbers.partition_point(|number| number < node);
        let quads: Vec<[usize; 4]> = fibre.quads.iter().map(|quad| [0, 1, 2, 3].map(|i| local(&quad[i]))).collect();
        let rim = fibre.rim.iter().map(|(edge, _)| [0, 1].map(|i| quads[edge.quad][(edge.edge + i) % 4])).collect();
        Layer::new(&points, &quads, rim, thickness, numbers)
    }

    /// The wall in pieces that are about as long as it is thick, or the search for contacts would look far.
    fn of_wall(model: &Model, wall: &Fibre, thickness: f64) -> Layer {
        let (quad, edge) = (wall.quads[0], wall.rim[0].0.edge);
        let [from, to, beyond, behind] = [0, 1, 2, 3].map(|i| model.nodes[quad[(edge + i) % 4]]);
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        let pieces = (length / thickness).ceil() as usize;
        let between = |a: [f64; 2], b: [f64; 2], i: usize| {
            [0, 1].map(|axis| a[axis] + i as f64 / pieces as f64 * (b[axis] - a[axis]))
        };
        let points: Vec<[f64; 2]> =
            (0..=pieces).flat_map(|i| [between(from, to, i), between(behind, beyond, i)]).collect();
        let quads: Vec<[usize; 4]> = (0..pieces).map(|i| [2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1]).collect();
        let rim = quads.iter().map(|quad| [quad[0], quad[1]]).collect();
        let numbers = vec![quad[0]; points.len()];
        Layer::new(&points, &quads, rim, thickness, numbers)
    }

    /// Of quadrilaterals, counter-clockwise, and the edges that may touch others.
    fn new(
        points: &[[f64; 2]],
        quads: &[[usize; 4]],
        rim: Vec<[usize; 2]>,
        thickness: f64,
        numbers: Vec<usize>,
    ) -> Layer {
        let count = points.len();
        let at = |x: f64| points.iter().map(move |&[y, z]| [x, y, z]);
        let element = |&[a, b, c, d]: &[usize; 4]| {
            [a, a + count, b, b + count, d, d + count, c, c + count].map(|node| node as u32)
        };
        let mesh = Mesh {
            nodes: at(0.0).chain(at(thickness)).collect(),
            elements: quads.iter().map(element).collect(),
            ..Mesh::default()
        };
        let face = |[from, to]: [usize; 2]| [from, to, to + count, from + count].map(|node| node as u32);
        Layer { mesh, numbers, faces: rim.into_iter().map(face).collect() }
    }
}
