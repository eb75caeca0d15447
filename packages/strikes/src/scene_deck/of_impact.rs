//! A case of `toron impact` as the model of a deck: half of a yarn under a cylinder.

use super::model::{Conversion, Mesh, Model, Part, Strike, Support, frame, hourglass, step};
use super::of_fabric::{SECTIONS, WATCHED, lowest_on_axis, nearest, refuse_strength};
use super::striker::Striker;
use crate::impact::scene::{self, Case, Zones};
use toron_explicit_host::mesh as host;
use toron_materials::deck::material::Material;
use toron_materials::units::{LENGTH, MASS, SPEED, TIME};
use toron_shared::error::Error;

/// The axis of the cylinder's motion.
const DOWN: usize = 1;
/// What part of the strike the model is: it ends at mid-span.
const PART: f64 = 0.5;
/// Length of the cylinder over the width of the yarn, which widens under it.
const LENGTH_OVER_WIDTH: f64 = 4.0;

/// # Errors
/// A driven section, or a striker that keeps its speed: no deck has them. A material that the deck's units cannot have.
pub fn of_case(case: &Case, conversion: Conversion) -> Result<Model, Error> {
    let scene::Striker::Cylinder { cylinder, mass, held: false } = case.striker else {
        let what = if case.striker == scene::Striker::Driven { "striker = \"driven\"" } else { "held = true" };
        let message = format!("case {} has {what}; allowed in a deck: a cylinder that flies freely", case.name);
        return Err(Error::Input(message));
    };
    refuse_strength(&case.name, case.strength.is_some())?;
    let Conversion { from, to } = conversion;
    let materials = case.zones.materials().iter().map(|material| Material::of_scene(material, &from, &to));
    let materials = materials.collect::<Result<Vec<_>, _>>()?;
    let length = |value| conversion.convert(value, LENGTH);
    let yarn = case.yarn.mesh();
    let mesh = mesh(&yarn, conversion);
    let parts = parts(case, &materials, yarn.elements_per_layer);
    let supports = supports(case, yarn.nodes_per_section as u32);
    let radius = length(cylinder.radius);
    let top = mesh.nodes.iter().map(|node| node[DOWN]).fold(0.0, f64::max);
    let end = conversion.convert(case.plan.end, TIME);
    let strike = Strike {
        striker: Striker {
            shape: cylinder.shape,
            radius,
            mass: PART * conversion.convert(mass, MASS),
            velocity: -conversion.convert(case.speed, SPEED),
            friction: cylinder.friction,
            centre: [0.0, top + radius, 0.0],
            side: 0.5 * LENGTH_OVER_WIDTH * length(case.yarn.width),
            divisions: 0,
        },
        part: PART,
        height: length(case.yarn.height),
        contact: None,
        control: case.control,
        end,
        sample: conversion.convert(case.plan.sample, TIME),
        frame: frame(end, case.plan.frames),
        deflection: lowest_on_axis(&mesh.nodes, DOWN),
        watched: nearest(&mesh, DOWN, 0.0, WATCHED),
        fails: case.zones.materials().iter().any(|material| material.can_fail()),
        hourglass: hourglass(case.zones.materials(), case.control, conversion)?,
        step: step(&mesh, &parts, &materials),
    };
    Ok(Model {
        title: String::new(),
        source: String::new(),
        name: case.name.clone(),
        units: to,
        mesh,
        parts,
        materials,
        supports,
        strike: Some(strike),
    })
}

fn mesh(yarn: &host::Mesh, conversion: Conversion) -> Mesh {
    Mesh {
        nodes: yarn.nodes.iter().map(|node| node.map(|x| conversion.convert(x, LENGTH))).collect(),
        elements: yarn.elements.iter().map(|element| SECTIONS.map(|corner| element[corner])).collect(),
        fibre: vec![[1.0, 0.0, 0.0]; yarn.elements.len()],
        straight: true,
        faces: Vec::new(),
    }
}

/// Symmetry at mid-span, and the clamp at the other end; a section has so many nodes.
fn supports(case: &Case, section: u32) -> Vec<Support> {
    let last = section * case.yarn.layers as u32;
    let support = |name, key, nodes: std::ops::Range<u32>, fixed| Support { name, key, nodes: nodes.collect(), fixed };
    vec![
        support("mid-span", "half-length: the model is one half", 0..section, [true, false, false]),
        support("clamp", "half-length: the yarn is clamped there", last..last + section, [true; 3]),
    ]
}

/// The yarn, or its part of each material.
fn parts(case: &Case, materials: &[Material], per_layer: usize) -> Vec<Part> {
    let elements = (case.yarn.layers * per_layer) as u32;
    let near = match case.zones {
        Zones::One(_) => elements,
        Zones::Two(_, length) => (case.yarn.layers_to(length) * per_layer) as u32,
    };
    let ranges = [0..near, near..elements];
    let of_material = |(material, (of_material, range)): (usize, (&Material, std::ops::Range<u32>))| {
        let name = if materials.len() > 1 { format!("yarn-{}", of_material.name) } else { "yarn".to_string() };
        Part { name, material, elements: range.collect() }
    };
    let parts = materials.iter().zip(ranges).enumerate().map(of_material);
    parts.filter(|part| !part.elements.is_empty()).collect()
}
