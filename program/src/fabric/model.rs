//! From a woven panel to the bodies of the explicit host.

use super::scene::{Case, Zones};
use crate::common::error::Error;
use crate::common::units::number;
use crate::explicit::body::{Body, Support};
use crate::explicit::contact::Contact;
use crate::explicit::lanes::Number;
use crate::explicit::medium::Medium;
use crate::explicit::mesh::Mesh;
use crate::explicit::mutual_contact::{MutualContact, Surface};
use crate::explicit::projectile::Projectile;
use crate::explicit::solver::Solver;
use crate::material::model::Material;
use crate::weave::model::{Model, Yarn};
use crate::weave::panel::Part;

/// A panel at rest with a sphere about to touch it; a body a yarn, in their order.
///
/// # Errors
/// A material that the host cannot use.
pub fn solver<T: Number>(case: &Case, panel: &Model) -> Result<Solver<T>, Error> {
    let medium = |material: &Material| Medium::<T>::new(material, material.density.unwrap_or_default(), case.control);
    let media = case.zones.materials().iter().map(medium).collect::<Result<Vec<_>, _>>()?;
    let (mut bodies, mut surfaces, mut contacts) = (Vec::new(), Vec::new(), Vec::new());
    for yarn in &panel.yarns {
        let mut mesh = mesh_of(panel, yarn);
        let faces = &panel.faces[yarn.faces.clone()];
        let local = faces.iter().map(|face| face.nodes.map(|node| node - yarn.nodes.start as u32)).collect();
        let elements = faces.iter().map(|face| face.element - yarn.elements.start as u32).collect();
        let surface = Surface::new(&mesh, local, elements);
        mesh.surface.clone_from(&surface.area);
        let zones: Vec<usize> = (0..mesh.elements.len()).map(|element| zone(&case.zones, &mesh, element)).collect();
        let body = Body::new(mesh, &media, |element| zones[element]);
        contacts.push(Contact::new(case.sphere, &body.mesh.surface, &body.mass));
        surfaces.push(surface);
        bodies.push(body);
    }
    hold(panel, case.held, &mut bodies);
    let mut solver = Solver::new(bodies, media);
    let mass = case.mass * share(case);
    let start = first_touch(panel, case.sphere.radius);
    if !start.is_finite() {
        let radius = number(case.sphere.radius);
        let allowed = "allowed: one under which some node of the panel lies";
        return Err(Error::Input(format!("the sphere's radius is {radius} in case {}; {allowed}", case.name)));
    }
    solver.projectile = Some(Projectile::new(mass, start, -case.speed, false, contacts));
    solver.mutual = Some(MutualContact::new(case.mutual, surfaces));
    Ok(solver)
}

/// The part of the panel that is modelled.
pub fn share(case: &Case) -> f64 {
    match case.woven.panel.part {
        Part::Whole => 1.0,
        Part::Quarter => 0.25,
    }
}

fn mesh_of(panel: &Model, yarn: &Yarn) -> Mesh {
    let elements = &panel.elements[yarn.elements.clone()];
    Mesh {
        nodes: panel.nodes[yarn.nodes.clone()].to_vec(),
        elements: elements.iter().map(|element| element.map(|node| node - yarn.nodes.start as u32)).collect(),
        fibre: panel.fibre[yarn.elements.clone()].to_vec(),
        elements_per_layer: yarn.elements_per_layer(),
        nodes_per_section: yarn.nodes_per_section(),
        surface: Vec::new(),
    }
}

/// The number of the medium of an element.
fn zone(zones: &Zones, mesh: &Mesh, element: usize) -> usize {
    let Zones::Two(_, radius) = zones else { return 0 };
    let corners = mesh.elements[element].map(|node| mesh.nodes[node as usize]);
    let [x, y] = [0, 1].map(|i| 0.125 * corners.iter().map(|corner| corner[i]).sum::<f64>());
    usize::from(x.hypot(y) > *radius)
}

/// What lies on a plane of symmetry stays there; the rim is fixed, or free.
fn hold<T: Number>(panel: &Model, rim: bool, bodies: &mut [Body<T>]) {
    let mut support = |nodes: &[u32], free: [bool; 3]| {
        for &node in nodes {
            let node = node as usize;
            let yarn = panel.yarns.partition_point(|yarn| yarn.nodes.end <= node);
            bodies[yarn].support(node - panel.yarns[yarn].nodes.start, Support { free, velocity: [0.0; 3] });
        }
    };
    support(&panel.on_x, [false, true, true]);
    support(&panel.on_y, [true, false, true]);
    if rim {
        support(&panel.rim, [false; 3]);
    }
}

/// The height of a sphere's centre at which it touches the panel from above.
fn first_touch(panel: &Model, radius: f64) -> f64 {
    let height = |[x, y, z]: [f64; 3]| {
        let under = radius * radius - x * x - y * y;
        if under > 0.0 { z + under.sqrt() } else { f64::NEG_INFINITY }
    };
    panel.nodes.iter().map(|&node| height(node)).fold(f64::NEG_INFINITY, f64::max)
}
