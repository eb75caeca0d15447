//! From a woven panel to the bodies of the explicit host.

use nalgebra::Vector3;

use super::scene::{Case, Zones};
use super::strength::PanelStrength;
use crate::weave::model::{LOWER, Model, UPPER, Yarn};
use crate::weave::panel::Part;
use toron_explicit_host::body::{Body, Support};
use toron_explicit_host::contact::{Contact, RigidSurface, Shape};
use toron_explicit_host::lanes::Number;
use toron_explicit_host::medium::Medium;
use toron_explicit_host::mesh::Mesh;
use toron_explicit_host::mutual_contact::{MutualContact, Surface};
use toron_explicit_host::solver::Solver;
use toron_explicit_host::striker::Striker;
use toron_materials::material::model::Material;
use toron_shared::error::Error;
use toron_shared::numbers::number;

/// Checks that a run of this case can begin.
///
/// # Errors
/// A material that the host cannot use, a striker under which there is nothing, a hybrid panel that has elements of one
/// law alone.
pub fn check(case: &Case, panel: &Model) -> Result<(), Error> {
    if case.single_precision {
        media::<f32>(case).map(drop)?
    } else {
        media::<f64>(case).map(drop)?
    }
    start(case, panel)?;
    check_coarse_radius(case)?;
    let Zones::Two(_, radius) = case.zones else { return Ok(()) };
    let outside = |element: &&[u32; 8]| zone(&case.zones, element.map(|node| panel.nodes[node as usize])) > 0;
    let outside = panel.elements.iter().filter(outside).count();
    if outside == 0 || outside == panel.elements.len() {
        let (law, radius) = (if outside == 0 { "hyperelastic" } else { "linear elastic" }, number(radius));
        let message = format!("hyperelastic-radius is {radius} in case {}, so that all elements are {law}", case.name);
        return Err(Error::Input(format!("{message}; allowed: one inside the panel, or that law alone")));
    }
    Ok(())
}

/// Refuses what strikes where the mesh is coarse.
fn check_coarse_radius(case: &Case) -> Result<(), Error> {
    let (Some(coarse), radius) = (case.cloth.coarse_radius(), case.striker.radius) else { return Ok(()) };
    if coarse > radius {
        return Ok(());
    }
    let [coarse, radius] = [coarse, radius].map(number);
    let name = case.striker.shape.name();
    let message = format!("coarse-radius is {coarse} in case {}, where the {name} strikes", case.name);
    Err(Error::Input(format!("{message}; allowed: more than the {name}'s radius, {radius}")))
}

/// The media of a case's zones.
fn media<T: Number>(case: &Case) -> Result<Vec<Medium<T>>, Error> {
    let medium = |material: &Material| Medium::<T>::new(material, material.density.unwrap_or_default(), case.control);
    case.materials().map(medium).collect()
}

/// The height at which the striker touches the panel.
pub fn start(case: &Case, panel: &Model) -> Result<f64, Error> {
    let start = first_touch(panel, &case.striker);
    if !start.is_finite() {
        let (name, radius) = (case.striker.shape.name(), number(case.striker.radius));
        let [x, y] = case.striker.aim.map(number);
        let allowed = format!("allowed: one under which some node of the panel lies, with aim = [{x}, {y}]");
        return Err(Error::Input(format!("the {name}'s radius is {radius} in case {}; {allowed}", case.name)));
    }
    Ok(start)
}

/// A panel at rest with the striker about to touch it; a body a yarn, in their order.
///
/// # Errors
/// As for [`check`].
pub fn build<T: Number>(case: &Case, panel: &Model) -> Result<Solver<T>, Error> {
    let media = media(case)?;
    let (mut bodies, mut surfaces, mut contacts) = (Vec::new(), Vec::new(), Vec::new());
    let strength = PanelStrength::of(case);
    for yarn in &panel.yarns {
        let mut mesh = mesh_of(panel, yarn);
        let faces = &panel.faces[yarn.faces.clone()];
        let local = faces.iter().map(|face| face.nodes.map(|node| node - yarn.nodes.start as u32)).collect();
        let elements = faces.iter().map(|face| face.element - yarn.elements.start as u32).collect();
        let mut surface = Surface::new(&mesh, local, elements);
        surface.join(&yarn.ties);
        mesh.surface = struck_surface(&mesh, &surface.area);
        let corners = |element: &[u32; 8]| element.map(|node| mesh.nodes[node as usize]);
        let own = case.own_material(yarn.ply, yarn.family);
        let medium = |element| own.unwrap_or_else(|| zone(&case.zones, corners(element)));
        let zones: Vec<usize> = mesh.elements.iter().map(medium).collect();
        let mut body = Body::new(mesh, &media, |element| zones[element]);
        if let Some(limits) = strength.as_ref().and_then(|strength| strength.limits(panel, yarn)) {
            body.limit(&limits);
        }
        body.tie(yarn.ties.clone());
        contacts.push(Contact::new(case.striker, &body.mesh.surface));
        surfaces.push(surface);
        bodies.push(body);
    }
    hold(panel, case.held, &mut bodies);
    let mut solver = Solver::new(bodies, media);
    solver.shred_mass = case.shred_mass * solver.bodies.iter().flat_map(|body| &body.mass).sum::<f64>();
    let mass = case.mass * share(case);
    let start = start(case, panel)?;
    solver.striker = Some(Striker::new(mass, start, -case.speed, false, contacts));
    solver.mutual = Some(MutualContact::new(case.mutual, surfaces));
    Ok(solver)
}

/// The part of the panel that is modelled.
pub fn share(case: &Case) -> f64 {
    match case.cloth.part() {
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
        // Of a straight yarn's layers, which no yarn of a panel is counted by.
        elements_per_layer: 0,
        nodes_per_section: 0,
        surface: Vec::new(),
    }
}

/// The surface that belongs to each node: its share of the faces, and of an inner node that of the faces between rows
/// which it stands on, for when the elements above it are gone.
fn struck_surface(mesh: &Mesh, outer: &[f64]) -> Vec<f64> {
    let mut shares = vec![0.0; outer.len()];
    for element in &mesh.elements {
        for side in [LOWER, UPPER] {
            let [a, b, c, d] = side.map(|corner| Vector3::from(mesh.nodes[element[corner] as usize]));
            // A quarter for each corner, half of which comes from the element on the other side.
            let share = 0.0625 * (c - a).cross(&(d - b)).norm();
            side.iter().for_each(|&corner| shares[element[corner] as usize] += share);
        }
    }
    outer.iter().zip(shares).map(|(&outer, inner)| if outer > 0.0 { outer } else { inner }).collect()
}

/// The number of the medium of an element with these corners.
pub fn zone(zones: &Zones, corners: [[f64; 3]; 8]) -> usize {
    let Zones::Two(_, radius) = zones else { return 0 };
    let [x, y] = [0, 1].map(|i| 0.125 * corners.iter().map(|corner| corner[i]).sum::<f64>());
    usize::from(x.hypot(y) > *radius)
}

/// What lies on a plane of symmetry stays there; the rim is fixed, or free.
fn hold<T: Number>(panel: &Model, held: bool, bodies: &mut [Body<T>]) {
    let mut support = |nodes: &[u32], free: [bool; 3]| {
        for &node in nodes {
            let node = node as usize;
            let yarn = panel.yarns.partition_point(|yarn| yarn.nodes.end <= node);
            bodies[yarn].support(node - panel.yarns[yarn].nodes.start, Support { free, velocity: [0.0; 3] });
        }
    };
    support(&panel.on_x, [false, true, true]);
    support(&panel.on_y, [true, false, true]);
    if held {
        support(&panel.rim, [false; 3]);
    }
}

/// The height of a striker's centre at which it touches the panel from above.
fn first_touch(panel: &Model, striker: &RigidSurface) -> f64 {
    let RigidSurface { radius, aim, .. } = *striker;
    let height = |[x, y, z]: [f64; 3]| {
        let under = radius * radius - (x - aim[0]).powi(2) - (y - aim[1]).powi(2);
        match striker.shape {
            _ if under <= 0.0 => f64::NEG_INFINITY,
            Shape::Flat => z + radius,
            _ => z + under.sqrt(),
        }
    };
    panel.nodes.iter().map(|&node| height(node)).fold(f64::NEG_INFINITY, f64::max)
}
