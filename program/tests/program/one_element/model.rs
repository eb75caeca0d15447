//! What the readers make of a deck: points that carry a law, and the deformation gradient that each is given over time.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Vector3};
use toron::law::parameters::PRESETS;
use toron::{Criterion, Request, Rotation};
use toron_materials::material::laws::LawName;
use toron_materials::material::model::{Law, Material};

use crate::hexahedra::Mesh;

/// When numbers are given, as parts of the time; under tension the last is after failure.
pub const ROWS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// Steps of the law: rows are at their ends, and the strain at which a yarn of these decks fails is not, so that
/// rounding does not choose the step.
const STEPS: usize = 7212;

pub struct Deck {
    pub end: f64,
    pub points: Vec<Point>,
}

/// An element, or MTest's point.
pub struct Point {
    pub label: String,
    pub law: LawName,
    pub values: Vec<f64>,
    /// F at a time.
    pub path: Box<dyn Fn(f64) -> Matrix3<f64>>,
}

#[derive(Clone, Copy)]
pub struct Row {
    pub time: f64,
    /// 11 22 33 12 23 31.
    pub stress: [f64; 6],
    pub energy: f64,
    pub failed: bool,
    /// What friction has lost, of a law that loses any.
    pub lost: Option<f64>,
}

impl Deck {
    /// The law at the rows' times.
    pub fn rows(&self, point: &Point) -> Vec<Row> {
        let history = self.history(point);
        ROWS.iter().map(|part| history[(part * STEPS as f64).round() as usize]).collect()
    }

    /// When the point fails, and its energy then.
    pub fn failure(&self, point: &Point) -> Option<(f64, f64)> {
        let history = self.history(point);
        history.iter().find(|row| row.failed).map(|first| (first.time, first.energy))
    }

    /// The law in every step.
    fn history(&self, point: &Point) -> Vec<Row> {
        let law = Law::new(point.law, &point.values, Rotation::Fibre, Criterion::LargestPrincipal).expect("a material");
        let material = Material {
            law,
            density: None,
            label: String::new(),
            own: String::new(),
            origin: Default::default(),
            temperature: None,
        };
        let mut memory = material.at_rest();
        (0..=STEPS)
            .map(|step| {
                let time = self.end * step as f64 / STEPS as f64;
                let answer = material.evaluate(&(point.path)(time), time, &memory, Request::ALL).expect("an answer");
                memory = answer.memory;
                let stress = answer.cauchy.map(|s| if s.abs() < 5e-5 { 0.0 } else { s });
                let (energy, failed) = (material.energy(&memory), material.failed(&memory));
                Row { time, stress, energy, failed, lost: material.lost_energy(&memory) }
            })
            .collect()
    }
}

/// The law with friction, which the program knows by the library's list of laws alone.
pub fn frictional() -> LawName {
    let preset = PRESETS.iter().find(|preset| preset.name == "kevlar-km2-600-frictional").expect("the preset");
    LawName::from(preset)
}

/// Points of time and value, straight in between.
pub type Table = Vec<(f64, f64)>;

pub fn interpolate(table: &Table, time: f64) -> f64 {
    let next = table.partition_point(|&(t, _)| t < time);
    match (next.checked_sub(1).map(|last| table[last]), table.get(next)) {
        (Some((t0, v0)), Some(&(t1, v1))) => v0 + (v1 - v0) * (time - t0) / (t1 - t0),
        (None, Some(&(_, v))) | (Some((_, v)), None) => v,
        (None, None) => panic!("an empty table"),
    }
}

/// A finite element model whose nodes are all prescribed.
#[derive(Default)]
pub struct Model {
    end: f64,
    pub nodes: BTreeMap<usize, Vector3<f64>>,
    /// Number, nodes, law and properties.
    pub elements: Vec<(usize, [usize; 8], LawName, Vec<f64>)>,
    motion: BTreeMap<(usize, usize), Table>,
}

impl Model {
    /// A model without anything in it, until its end.
    pub fn until(end: f64) -> Model {
        Model { end, ..Model::default() }
    }

    /// Prescribes a component, from 0, of a node, which nothing else prescribes.
    pub fn prescribe(&mut self, node: usize, component: usize, table: Table) {
        assert!(self.nodes.contains_key(&node), "there is no node {node}");
        assert!(table.is_sorted_by(|a, b| a.0 < b.0), "times must increase");
        let before = self.motion.insert((node, component), table);
        assert!(before.is_none(), "component {component} of node {node} is prescribed twice");
    }

    /// The deck, in which every component of every node is prescribed and every element deforms homogeneously.
    pub fn deck(self) -> Deck {
        assert_eq!(self.motion.len(), 3 * self.nodes.len(), "every node is prescribed");
        for table in self.motion.values() {
            let (first, last) = (table[0], table[table.len() - 1]);
            assert_eq!(first, (0.0, 0.0), "the motion starts at rest");
            assert!(table.len() == 1 || last.0 == self.end, "the motion ends with the run");
        }
        let point = |(number, nodes, law, values): &(usize, [usize; 8], LawName, Vec<f64>)| {
            let places = nodes.map(|node| *self.nodes.get(&node).unwrap_or_else(|| panic!("there is no node {node}")));
            let tables = nodes.map(|node| [0, 1, 2].map(|component| self.motion[&(node, component)].clone()));
            let mesh = Mesh { nodes: places.to_vec(), elements: vec![[0, 1, 2, 3, 4, 5, 6, 7]] };
            let path = move |time: f64| {
                let moved = |tables: &[Table; 3]| Vector3::from_fn(|i, _| interpolate(&tables[i], time));
                let displacements: Vec<_> = tables.iter().map(moved).collect();
                let points = mesh.gauss_points(0, &displacements);
                let f = points[0].f;
                assert!(points.iter().all(|point| (point.f - f).norm() < 1e-8), "F is not homogeneous at {time}");
                assert!(points.iter().all(|point| point.volume > 0.0), "the order of the element's nodes");
                f
            };
            let label = format!("element {number}");
            Point { label, law: *law, values: values.clone(), path: Box::new(path) }
        };
        Deck { end: self.end, points: self.elements.iter().map(point).collect() }
    }
}

pub fn number(text: &str) -> f64 {
    text.trim().parse().unwrap_or_else(|_| panic!("\"{text}\" is no number"))
}

pub fn count(text: &str) -> usize {
    text.trim().parse().unwrap_or_else(|_| panic!("\"{text}\" is no whole number"))
}

/// The fields of a line of fixed columns, without what is missing at its end. No two fields touch.
pub fn columns(line: &str, widths: &[usize]) -> Vec<String> {
    assert!(line.is_ascii() && line.len() <= widths.iter().sum(), "columns beyond the last field: {line}");
    let (mut fields, mut start) = (Vec::new(), 0);
    for width in widths {
        let Some(field) = line.get(start..line.len().min(start + width)).filter(|field| !field.trim().is_empty())
        else {
            break;
        };
        assert!(field.starts_with(' '), "a field touches the one before it: {line}");
        assert!(field.len() == *width && !field.ends_with(' '), "a field does not end with its columns: {line}");
        fields.push(field.trim().to_string());
        start += width;
    }
    assert!(start >= line.len(), "a field is missing: {line}");
    fields
}
