//! A woven panel, and a case of `toron fabric`, as the model of a deck.

use std::collections::BTreeMap;

use super::model::{Contact, Conversion, Mesh, Model, Part, Strike, Support, frame, hourglass, step};
use super::striker::{Striker, divisions};
use crate::fabric::scene::Case;
use crate::fabric::solver::{check, share, start, zone};
use crate::weave::cloth::Cloth;
use crate::weave::command::NAME;
use crate::weave::model as woven;
use crate::weave::model::Yarn;
use toron_explicit_host::contact::{RigidSurface, Shape};
use toron_materials::deck::material::Material;
use toron_materials::units::{LENGTH, MASS, SPEED, TIME};
use toron_shared::error::Error;
use toron_shared::numbers::number;

/// Corners of a woven element in the order of a deck's: its section where it starts, then the one where it ends.
pub const SECTIONS: [usize; 8] = [0, 2, 6, 4, 1, 3, 7, 5];
/// Elements nearest to the striker's axis, or to its rim, that are watched for failure.
pub const WATCHED: usize = 100;

/// # Errors
/// A strength that scatters: a deck's cards have one for all elements.
pub fn refuse_strength(case: &str, scatters: bool) -> Result<(), Error> {
    if scatters {
        let message =
            format!("case {case} has a strength that scatters; allowed in a deck: no strength, the material's own");
        return Err(Error::Input(message));
    }
    Ok(())
}

/// # Errors
/// A strength that scatters, a material that the host or the deck's units cannot have, a sphere under which there is
/// nothing.
pub fn of_case(case: &Case, panel: &woven::Model, conversion: Conversion) -> Result<Model, Error> {
    refuse(case, panel)?;
    let used = used(case);
    let of_case: Vec<_> = case.materials().collect();
    let used_materials: Vec<_> = used.iter().map(|&i| of_case[i]).collect();
    let materials = materials(case, &used, conversion)?;
    let of_zones = used.iter().take_while(|&&i| i < case.zones.materials().len());
    let names: Vec<&str> = of_zones.zip(&materials).map(|(_, material)| material.name.as_str()).collect();
    let corners = |element: usize| panel.elements[element].map(|node| panel.nodes[node as usize]);
    let place = |i: usize| used.iter().position(|&other| other == i).unwrap_or_default();
    let of_element = |yarn: &Yarn, element| {
        place(case.own_material(yarn.ply, yarn.family).unwrap_or_else(|| zone(&case.zones, corners(element))))
    };
    let parts = parts(panel, &names, of_element);
    let mesh = mesh(panel, conversion);
    let mut supports = symmetry(panel, &case.cloth);
    if case.held {
        supports.push(rim(panel));
    }
    let step = step(&mesh, &parts, &materials);
    let strike = strike((case, panel, &mesh), &used_materials, step, conversion)?;
    Ok(Model {
        title: String::new(),
        source: String::new(),
        name: case.name.clone(),
        units: conversion.to,
        mesh,
        parts,
        materials,
        supports,
        strike: Some(strike),
    })
}

/// Refuses what no deck can have.
fn refuse(case: &Case, panel: &woven::Model) -> Result<(), Error> {
    refuse_strength(&case.name, case.strength.is_some())?;
    check(case, panel)?;
    if case.striker.aim != [0.0; 2] {
        let [x, y] = case.striker.aim;
        return Err(Error::Input(format!("aim is [{x}, {y}] in case {}; allowed in a deck: none", case.name)));
    }
    check_mesh(&case.cloth)?;
    if case.cloth.clearance() <= 0.0 {
        let message = "yarns of the mesh meet, so that the deck's contact has no gap; allowed: clearance > 0 in [mesh]";
        return Err(Error::Input(format!("case {}: {message}", case.name)));
    }
    Ok(())
}

/// The deck's materials: those of the case at these places.
fn materials(case: &Case, used: &[usize], Conversion { from, to }: Conversion) -> Result<Vec<Material>, Error> {
    let of_case: Vec<_> = case.materials().collect();
    let material = |&i: &usize| {
        let mut material = Material::of_scene(of_case[i], &from, &to)?;
        // Those of warp and weft may have one name.
        let mut own = case.families_with_materials();
        if let Some((ply, family)) = own.find(|&(ply, family)| case.own_material(ply, family) == Some(i)) {
            material.name = format!("{}-{}", case.family_name(ply, family), material.name);
        }
        Ok(material)
    };
    used.iter().map(material).collect()
}

/// What strikes the panel, whose mesh is in the deck's units.
fn strike(
    (case, panel, mesh): (&Case, &woven::Model, &Mesh),
    materials: &[&toron_materials::material::model::Material],
    step: f64,
    conversion: Conversion,
) -> Result<Strike, Error> {
    let length = |value| conversion.convert(value, LENGTH);
    let [height, _] = case.cloth.yarn_heights();
    let end = conversion.convert(case.plan.end, TIME);
    let RigidSurface { shape, radius, friction, .. } = case.striker;
    Ok(Strike {
        striker: Striker {
            shape,
            radius: length(radius),
            mass: share(case) * conversion.convert(case.mass, MASS),
            velocity: -conversion.convert(case.speed, SPEED),
            friction,
            centre: [0.0, 0.0, length(start(case, panel)?)],
            side: 0.0,
            divisions: divisions(radius, height),
        },
        part: share(case),
        height: length(height),
        contact: Some(Contact { friction: case.mutual.friction, clearance: length(case.cloth.clearance()) }),
        control: case.control,
        end,
        sample: conversion.convert(case.plan.sample, TIME),
        frame: frame(end, case.plan.frames),
        deflection: lowest_on_axis(&mesh.nodes, 2),
        // A flat end cuts at its rim.
        watched: nearest(mesh, 2, if shape == Shape::Flat { length(radius) } else { 0.0 }, WATCHED),
        fails: materials.iter().any(|material| material.can_fail()),
        hourglass: hourglass(materials.iter().copied(), case.control, conversion)?,
        step,
    })
}

/// A panel alone, which nothing strikes.
///
/// # Errors
/// The deck's units cannot have the material.
pub fn of_panel(
    cloth: &Cloth,
    panel: &woven::Model,
    material: &toron_materials::material::model::Material,
    conversion: Conversion,
) -> Result<Model, Error> {
    let Conversion { from, to } = conversion;
    let material = Material::of_scene(material, &from, &to)?;
    check_mesh(cloth)?;
    let mut supports = symmetry(panel, cloth);
    supports.push(Support { fixed: [false; 3], ..rim(panel) });
    Ok(Model {
        title: String::new(),
        source: String::new(),
        name: NAME.to_string(),
        units: to,
        mesh: mesh(panel, conversion),
        parts: parts(panel, &[&material.name], |_, _| 0),
        materials: vec![material],
        supports,
        strike: None,
    })
}

/// Refuses a mesh that has tied nodes.
fn check_mesh(cloth: &Cloth) -> Result<(), Error> {
    cloth.coarse_radius().map_or(Ok(()), |radius| {
        let message =
            format!("coarse-radius is {} in [weave.panel], of a mesh whose nodes are tied to others", number(radius));
        Err(Error::Input(format!("{message}; allowed in a deck: none")))
    })
}

fn mesh(panel: &woven::Model, conversion: Conversion) -> Mesh {
    Mesh {
        nodes: panel.nodes.iter().map(|node| node.map(|x| conversion.convert(x, LENGTH))).collect(),
        elements: panel.elements.iter().map(|element| SECTIONS.map(|corner| element[corner])).collect(),
        fibre: panel.fibre.clone(),
        straight: false,
        faces: panel.faces.iter().map(|face| face.nodes).collect(),
    }
}

/// The places in the case's materials of those that some yarn is made of.
fn used(case: &Case) -> Vec<usize> {
    let own: Vec<usize> =
        case.families_with_materials().filter_map(|(ply, family)| case.own_material(ply, family)).collect();
    let families = 2 * case.threads.len();
    let of_zones = if own.len() < families { case.zones.materials().len() } else { 0 };
    (0..of_zones).chain(own).collect()
}

/// A part for each yarn, or for each of its materials; named by both where `zones` are several, the names of the first
/// materials.
fn parts(panel: &woven::Model, zones: &[&str], material: impl Fn(&Yarn, usize) -> usize) -> Vec<Part> {
    let mut parts = Vec::new();
    let name = |yarn| name(yarn, panel.plies() > 1);
    for yarn in &panel.yarns {
        let mut of_yarn: BTreeMap<usize, Vec<u32>> = BTreeMap::new();
        for element in yarn.elements.clone() {
            of_yarn.entry(material(yarn, element)).or_default().push(element as u32);
        }
        for (material, elements) in of_yarn {
            let zone = zones.get(material).filter(|_| zones.len() > 1);
            let name = zone.map_or_else(|| name(yarn), |zone| format!("{}-{zone}", name(yarn)));
            parts.push(Part { name, material, elements });
        }
    }
    parts
}

/// As `warp-3`, `weft-m2`, `ply-2-warp-3`: a name may have no sign.
fn name(yarn: &Yarn, of_several_plies: bool) -> String {
    let ply = if of_several_plies { format!("ply-{}-", yarn.ply + 1) } else { String::new() };
    let sign = if yarn.number < 0 { "m" } else { "" };
    format!("{ply}{}-{sign}{}", yarn.family.name(), yarn.number.abs())
}

fn symmetry(panel: &woven::Model, cloth: &Cloth) -> Vec<Support> {
    let key = match cloth {
        Cloth::Woven(_) => "[weave.panel] part = \"quarter\"",
        Cloth::Foreign(_) => "[mesh] part = \"quarter\"",
    };
    let planes = [("on-x-0", &panel.on_x, [true, false, false]), ("on-y-0", &panel.on_y, [false, true, false])];
    let planes = planes.into_iter().filter(|(_, nodes, _)| !nodes.is_empty());
    planes.map(|(name, nodes, fixed)| Support { name, key, nodes: nodes.clone(), fixed }).collect()
}

fn rim(panel: &woven::Model) -> Support {
    Support { name: "rim", key: "rim", nodes: panel.rim.clone(), fixed: [true; 3] }
}

/// Of the nodes nearest to the axis through the origin, the last one that a striker from above would meet.
pub fn lowest_on_axis(nodes: &[[f64; 3]], axis: usize) -> u32 {
    let key = |node: &[f64; 3]| (distance(node, axis), node[axis]);
    let order = |(_, a): &(usize, &[f64; 3]), (_, b): &(usize, &[f64; 3])| {
        let ([a, low], [b, high]) = (<[f64; 2]>::from(key(a)), <[f64; 2]>::from(key(b)));
        a.total_cmp(&b).then(low.total_cmp(&high))
    };
    nodes.iter().enumerate().min_by(order).map_or(0, |(number, _)| number as u32)
}

/// The elements whose distance from that axis is nearest to this radius.
pub fn nearest(mesh: &Mesh, axis: usize, radius: f64, count: usize) -> Vec<u32> {
    let distance = |element: usize| {
        let corners = mesh.corners(element);
        let centre = [0, 1, 2].map(|i| 0.125 * corners.iter().map(|corner| corner[i]).sum::<f64>());
        (distance(&centre, axis) - radius).abs()
    };
    let mut found: Vec<(f64, u32)> = (0..mesh.elements.len()).map(|i| (distance(i), i as u32)).collect();
    let count = count.min(found.len());
    if count < found.len() {
        found.select_nth_unstable_by(count, |a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
    }
    let mut elements: Vec<u32> = found[..count].iter().map(|&(_, element)| element).collect();
    elements.sort_unstable();
    elements
}

fn distance(place: &[f64; 3], axis: usize) -> f64 {
    place[(axis + 1) % 3].hypot(place[(axis + 2) % 3])
}
