//! What is measured of a panel: energies, deflection, the front of the transverse wave, torn yarns, how far sections tilt.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::explicit::energies::Energies;
use crate::explicit::lanes::{Number, largest};
use crate::explicit::solver::Solver;
use crate::weave::figures::{corners, scaled_jacobian};
use crate::weave::model::{Model, Yarn};

/// The state at an instant. Energies are those of the whole panel.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Sample {
    pub time: f64,
    /// Of the sphere, in the direction of the blow; how far it has come; the force that holds it up.
    pub speed: f64,
    pub travel: f64,
    pub force: f64,
    /// The farthest that a node has gone in the direction of the blow, in yarns that are not torn.
    pub deflection: f64,
    /// Along a yarn through the centre.
    pub front: f64,
    pub energies: Energies,
    /// The panel's energy by mode, and the largest densities in intact elements.
    pub parts: [f64; 5],
    pub largest: [f64; 5],
    pub index: f64,
    pub deleted: usize,
    pub collapsed: usize,
    /// The smallest intact element: its volume over that at rest. And the most distorted corner of one, by its scaled Jacobian.
    pub least_volume_ratio: f64,
    pub least_scaled_jacobian: f64,
    /// Yarns that are torn through.
    pub torn: usize,
    /// By how much, at most, a section whose elements are all there has tilted along its yarn since it was at rest, in degrees; and
    /// how far its middle has slipped along it against its upper and lower side.
    pub tilt: f64,
    pub slip: f64,
}

/// Measures all.
///
/// The front of the transverse wave is where the panel has come down by `threshold`, more than crimp gives when yarns are
/// stretched straight before it comes.
pub fn measure<T: Number>(panel: &Model, solver: &Solver<T>, share: f64, start: f64, threshold: f64) -> Sample {
    let whole = 1.0 / share;
    let mut sample =
        Sample { time: solver.time, least_volume_ratio: 1.0, least_scaled_jacobian: 1.0, ..Sample::default() };
    if let Some(sphere) = &solver.projectile {
        sample.speed = -sphere.velocity;
        sample.travel = start - sphere.position;
        sample.force = sphere.force * whole;
    }
    sample.energies = times(whole, &solver.energies);
    for (yarn, body) in panel.yarns.iter().zip(&solver.bodies) {
        sample.deleted += body.deleted.len();
        sample.collapsed += body.collapsed;
        let torn = is_torn(yarn, body.mesh.elements.len(), |i| body.is_intact(i));
        sample.torn += usize::from(torn);
        for i in 0..body.mesh.elements.len() {
            let densities = body.energy_densities(&solver.media, i);
            for (part, density) in sample.parts.iter_mut().zip(densities) {
                *part += whole * density * body.volume(i);
            }
            if !body.is_intact(i) {
                continue;
            }
            for (most, density) in sample.largest.iter_mut().zip(densities) {
                *most = largest(*most, density);
            }
            sample.index = largest(sample.index, body.failure_index(&solver.media, i));
            let nodes = body.mesh.elements[i].map(|node| node as usize);
            for node in nodes.into_iter().filter(|_| !torn) {
                sample.deflection = largest(sample.deflection, -body.displacement[node][2].into());
            }
            let (ratio, scaled) =
                quality(|corner| body.mesh.nodes[nodes[corner]], |corner| body.position(nodes[corner]));
            sample.least_volume_ratio = smallest(sample.least_volume_ratio, ratio);
            sample.least_scaled_jacobian = smallest(sample.least_scaled_jacobian, scaled);
        }
        let lines = yarn.elements_per_layer();
        let whole_at = |layer: usize| (layer * lines..(layer + 1) * lines).all(|element| body.is_intact(element));
        for section in 0..=yarn.layers {
            if !(section.saturating_sub(1)..(section + 1).min(yarn.layers)).all(whole_at) {
                continue;
            }
            let at_rest = section_of(yarn, section, |node| Vector3::from(body.mesh.nodes[node]));
            let now = section_of(yarn, section, |node| Vector3::from(body.position(node)));
            sample.tilt = largest(sample.tilt, (now.0 - at_rest.0).abs());
            sample.slip = largest(sample.slip, (now.1 - at_rest.1).abs());
        }
    }
    sample.front = front(panel, solver, threshold);
    sample
}

/// The smaller one; NaN where one is.
pub fn smallest(a: f64, b: f64) -> f64 {
    -largest(-a, -b)
}

/// An element's volume over that at rest, both taken from the means of its edges along each axis, and its least scaled Jacobian.
fn quality(at_rest: impl Fn(usize) -> [f64; 3], position: impl Fn(usize) -> [f64; 3]) -> (f64, f64) {
    let volume = |node: &dyn Fn(usize) -> Vector3<f64>| {
        let mut axes = [Vector3::zeros(); 3];
        for edges in corners(node) {
            for (axis, edge) in axes.iter_mut().zip(edges) {
                *axis += edge;
            }
        }
        axes[0].cross(&axes[1]).dot(&axes[2])
    };
    let now = |corner: usize| Vector3::from(position(corner));
    let scaled = corners(now).map(|edges| scaled_jacobian(&edges));
    (volume(&now) / volume(&|corner| Vector3::from(at_rest(corner))), scaled.fold(1.0, smallest))
}

fn times(factor: f64, energies: &Energies) -> Energies {
    let Energies { projectile, kinetic, internal, hourglass, viscosity, friction, contact, external } = *energies;
    Energies {
        projectile: factor * projectile,
        kinetic: factor * kinetic,
        internal: factor * internal,
        hourglass: factor * hourglass,
        viscosity: factor * viscosity,
        friction: factor * friction,
        contact: factor * contact,
        external: factor * external,
    }
}

/// Whether every line of elements along a yarn has lost one.
fn is_torn(yarn: &Yarn, elements: usize, intact: impl Fn(usize) -> bool) -> bool {
    let lines = yarn.elements_per_layer();
    (0..lines).all(|line| (line..elements).step_by(lines).any(|element| !intact(element)))
}

/// The farthest place from the centre, along the yarns next to its axes, that has come down by more than a threshold.
fn front<T: Number>(panel: &Model, solver: &Solver<T>, threshold: f64) -> f64 {
    let nearest = panel.yarns.iter().map(|yarn| yarn.coordinate.abs()).fold(f64::INFINITY, f64::min);
    let mut farthest: f64 = 0.0;
    for (yarn, body) in panel.yarns.iter().zip(&solver.bodies) {
        if yarn.coordinate.abs() > 1.001 * nearest {
            continue;
        }
        for (node, [x, y, _]) in body.mesh.nodes.iter().enumerate() {
            if -body.displacement[node][2].into() > threshold {
                farthest = farthest.max(x.hypot(*y));
            }
        }
    }
    farthest
}

/// The angle by which a section's height leans along the yarn, in degrees, and how far its middle is ahead of its upper and lower
/// side along the yarn.
fn section_of(yarn: &Yarn, section: usize, position: impl Fn(usize) -> Vector3<f64>) -> (f64, f64) {
    let (per, rows, columns) = (yarn.nodes_per_section(), yarn.rows, yarn.columns);
    let mean = |section: usize| -> Vector3<f64> {
        (section * per..(section + 1) * per).map(&position).sum::<Vector3<f64>>() / per as f64
    };
    let (before, after) = (section.saturating_sub(1), (section + 1).min(yarn.layers));
    let along = (mean(after) - mean(before)).normalize();
    let node = |column: usize, row: usize| position(section * per + column * (rows + 1) + row);
    let height = |column: usize| node(column, rows) - node(column, 0);
    // The axis of a yarn that a plane of symmetry halves is at the side where it is highest.
    let axis = if yarn.halved { [0, columns] } else { [columns / 2, columns.div_ceil(2)] };
    let column = if height(axis[0]).norm() > height(axis[1]).norm() { axis[0] } else { axis[1] };
    let upright = height(column);
    let tilt = (along.dot(&upright) / upright.norm()).clamp(-1.0, 1.0).asin().to_degrees();
    let core = 0.5 * (node(column, rows / 2) + node(column, rows.div_ceil(2)));
    let sides = 0.5 * (node(column, rows) + node(column, 0));
    (tilt, along.dot(&(core - sides)))
}
