//! From a mesh file's nodes and elements to a panel.

use std::collections::HashMap;

use nalgebra::{Matrix3, Vector3};

use super::orient::Corners;
use super::raw::{Element, Raw};
use crate::weave::geometry::Family;
use crate::weave::model::{Crossing, END, Face, Grid, LEFT, LOWER, Model, Piece, RIGHT, START, Side, UPPER, Yarn};
use crate::weave::panel::Part;
use crate::weave::torn;
use toron_explicit_host::mutual_contact::outer_faces;

/// Lengths smaller than this part of a yarn's width are rounding in the file.
const ROUNDING: f64 = 1e-4;
/// Yarns run along x and y, but for so many degrees.
const OBLIQUE: f64 = 10.0;
/// A direction whose square is 1 but for this is taken as it is.
const UNIT: f64 = 1e-12;

impl Raw {
    /// A panel of these yarns, the warp along x. With a quarter the planes x = 0 and y = 0 are planes of symmetry.
    ///
    /// # Errors
    /// What of the mesh is no panel, by element or yarn.
    pub fn model(&self, part: Part) -> Result<Model, String> {
        let mut owner = vec![None; self.nodes.len()];
        for element in &self.elements {
            for node in element.nodes {
                if let Some(other) = owner[node as usize].replace(element.yarn).filter(|&yarn| yarn != element.yarn) {
                    let yarns = [element.yarn, other].map(|yarn| &*self.yarns[yarn]).join(" and ");
                    let number = element.number;
                    return Err(format!(
                        "a node of element {number} is in {yarns}; allowed: yarns without common nodes"
                    ));
                }
            }
        }
        let mut points = vec![Vec::new(); self.yarns.len()];
        for (owner, &node) in owner.iter().zip(&self.nodes) {
            owner.iter().for_each(|&yarn| points[yarn].push(Vector3::from(node)));
        }
        let axes = LongAxis::told(points.iter().map(|points| LongAxis::of(points)).collect());
        let threads = axes.into_iter().enumerate().map(|(yarn, long)| Thread::of(self, yarn, long));
        let mut threads = threads.collect::<Result<Vec<_>, _>>()?;
        let families = |family: Family| threads.iter().filter(move |thread| thread.family == family).count();
        if threads.is_empty() || families(Family::Warp) == 0 || families(Family::Weft) == 0 {
            let [warps, wefts] = Family::BOTH.map(families);
            return Err(format!("{warps} yarns along x and {wefts} along y; allowed: some of both"));
        }
        threads.sort_by(|a, b| (a.family as u8).cmp(&(b.family as u8)).then(a.coordinate.total_cmp(&b.coordinate)));
        let mut model = Model::default();
        for thread in &threads {
            model.add_thread(self, thread, part)?;
        }
        model.number_yarns();
        model.cross();
        Ok(model)
    }
}

/// The elements of a yarn.
struct Thread<'a> {
    name: &'a str,
    elements: Vec<&'a Element>,
    fibre: Vec<Vector3<f64>>,
    family: Family,
    coordinate: f64,
}

impl<'a> Thread<'a> {
    fn of(raw: &'a Raw, yarn: usize, long: Option<Vector3<f64>>) -> Result<Thread<'a>, String> {
        let name = &*raw.yarns[yarn];
        let elements: Vec<&Element> = raw.elements.iter().filter(|element| element.yarn == yarn).collect();
        let nodes = elements.iter().flat_map(|element| element.nodes).map(|node| raw.nodes[node as usize]);
        let mut fibre = Vec::with_capacity(elements.len());
        for element in &elements {
            let corners = Corners::new(element.nodes, &raw.nodes);
            let given = element.direction.map(Vector3::from);
            let direction = given.or_else(|| long.map(|long| corners.nearest_axis(long))).ok_or_else(|| {
                format!("{name} has no fibre directions and is too short to tell them; allowed: directions, or a longer yarn")
            })?;
            if !(direction.norm() > 0.0 && direction.norm().is_finite()) {
                return Err(format!("element {} of {name} has a fibre direction of no length", element.number));
            }
            let unit = (direction.norm_squared() - 1.0).abs() < UNIT;
            fibre.push(if unit { direction } else { direction.normalize() });
        }
        // A fibre has no sense.
        let sense = |axis: &Vector3<f64>| if axis.dot(&fibre[0]) < 0.0 { -axis } else { *axis };
        let sum: Vector3<f64> = fibre.iter().map(sense).sum();
        let family = if sum.x.abs() >= sum.y.abs() { Family::Warp } else { Family::Weft };
        let off = sum.x.abs().min(sum.y.abs()).atan2(sum.x.abs().max(sum.y.abs())).to_degrees();
        if off > OBLIQUE {
            return Err(format!(
                "{name} runs {off:.0}° off x and y; allowed: up to {OBLIQUE}°, warp along x, weft along y"
            ));
        }
        for axis in &mut fibre {
            if axis[family as usize] < 0.0 {
                *axis = -*axis;
            }
        }
        let [low, high] = extent(nodes.map(|place| place[1 - family as usize]));
        let middle = 0.5 * (low + high);
        let coordinate = if middle.abs() < ROUNDING * (high - low) { 0.0 } else { middle };
        Ok(Thread { name, elements, fibre, family, coordinate })
    }
}

fn extent(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
}

/// The direction in which points are spread most.
#[derive(Clone, Copy)]
pub struct LongAxis {
    pub direction: Vector3<f64>,
    /// How far, and over how far in another direction.
    spread: f64,
    ratio: f64,
}

/// A yarn is so many times as long as wide where its shape tells which is which, and has this part of the longest
/// yarn's length: those that the outline cuts short do not.
const LONGER: f64 = 1.5;
const NO_STUB: f64 = 0.25;

impl LongAxis {
    pub fn of(points: &[Vector3<f64>]) -> LongAxis {
        let middle = points.iter().sum::<Vector3<f64>>() / points.len().max(1) as f64;
        let spread: Matrix3<f64> = points.iter().map(|point| (point - middle) * (point - middle).transpose()).sum();
        let axes = (spread / points.len().max(1) as f64).symmetric_eigen();
        let longest = axes.eigenvalues.imax();
        let others = (0..3).filter(|&axis| axis != longest).map(|axis| axes.eigenvalues[axis]).fold(0.0, f64::max);
        LongAxis {
            direction: axes.eigenvectors.column(longest).into_owned(),
            spread: axes.eigenvalues[longest].sqrt(),
            ratio: (axes.eigenvalues[longest] / others).sqrt(),
        }
    }

    /// Of each yarn, where its shape tells it.
    pub fn told(axes: Vec<LongAxis>) -> Vec<Option<Vector3<f64>>> {
        let longest = axes.iter().map(|axis| axis.spread).fold(0.0, f64::max);
        let tells = |axis: &LongAxis| axis.ratio > LONGER && axis.spread >= NO_STUB * longest;
        axes.into_iter().map(|axis| tells(&axis).then_some(axis.direction)).collect()
    }
}

impl Model {
    fn add_thread(&mut self, raw: &Raw, thread: &Thread<'_>, part: Part) -> Result<(), String> {
        let [first_node, first_element, first_face] = [self.nodes.len(), self.elements.len(), self.faces.len()];
        let family = thread.family;
        let mut used: Vec<u32> = thread.elements.iter().flat_map(|element| element.nodes).collect();
        used.sort_unstable();
        used.dedup();
        let number: HashMap<u32, u32> =
            used.iter().zip(first_node as u32..).map(|(&node, number)| (node, number)).collect();
        self.nodes.extend(used.iter().map(|&node| raw.nodes[node as usize]));
        for (element, &fibre) in thread.elements.iter().zip(&thread.fibre) {
            let wrong = |message: String| format!("element {} of {} {message}", element.number, thread.name);
            let corners = Corners::new(element.nodes, &raw.nodes);
            let turned = corners.along(fibre).map_err(wrong)?;
            let volume = corners.volume();
            if volume.is_nan() || volume <= 0.0 {
                return Err(wrong(format!(
                    "is inside out or flat, with the volume {volume:.3e}; allowed: more than 0"
                )));
            }
            self.elements.push(turned.map(|node| number[&node]));
            self.fibre.push(fibre.into());
        }
        let nodes = first_node..self.nodes.len();
        let elements = first_element..self.elements.len();
        let local: Vec<[u32; 8]> = self.elements[elements.clone()]
            .iter()
            .map(|element| element.map(|node| node - first_node as u32))
            .collect();
        let pieces = torn::pieces(nodes.len(), &local);
        if pieces > 1 {
            return Err(format!(
                "{} is in {pieces} pieces; allowed: one, of elements that share their nodes",
                thread.name
            ));
        }
        let [low, high] = extent(self.nodes[nodes.clone()].iter().map(|node| node[1 - family as usize]));
        let rounding = ROUNDING * (high - low);
        let mut yarn = Yarn {
            ply: 0,
            family,
            number: 0,
            coordinate: thread.coordinate,
            halved: false,
            ends: [Vec::new(), Vec::new()],
            pieces: Grid::of(&self.elements[elements.clone()], nodes.len(), first_node as u32)
                .map(Piece::whole)
                .into_iter()
                .collect(),
            ties: Vec::new(),
            nodes,
            elements,
            faces: first_face..first_face,
        };
        if part == Part::Quarter {
            self.settle_on_planes(&mut yarn, rounding).map_err(|message| format!("{} {message}", thread.name))?;
        }
        let gap = self.add_surface(&mut yarn, part);
        if let Some(element) = gap {
            let (name, number) = (thread.name, thread.elements[element].number);
            let axis = if family == Family::Warp { "x" } else { "y" };
            return Err(format!(
                "{name} has a gap along {axis} beside element {number}; allowed: none but at its ends"
            ));
        }
        self.yarns.push(yarn);
        Ok(())
    }

    /// Moves what is on a plane of symmetry but for rounding onto it.
    fn settle_on_planes(&mut self, yarn: &mut Yarn, rounding: f64) -> Result<(), String> {
        for number in yarn.nodes.clone() {
            for axis in 0..2 {
                let place = &mut self.nodes[number][axis];
                if *place < -rounding {
                    let name = ["x", "y"][axis];
                    return Err(format!(
                        "has a node at {name} = {place}; allowed: 0 and more where part = \"quarter\""
                    ));
                }
                if *place <= rounding {
                    *place = 0.0;
                    [&mut self.on_x, &mut self.on_y][axis].push(number as u32);
                }
            }
        }
        let across = 1 - yarn.family as usize;
        yarn.halved = yarn.nodes.clone().any(|node| self.nodes[node][across] == 0.0);
        if yarn.halved {
            yarn.coordinate = 0.0;
        }
        Ok(())
    }

    /// The faces that can touch something, and the ends. Returns the place of an element that is beside a gap in the
    /// yarn, if there is one: an end of its own that is farther from the yarn's than the element is long or the yarn
    /// wide.
    fn add_surface(&mut self, yarn: &mut Yarn, part: Part) -> Option<usize> {
        let along = yarn.family as usize;
        let [low, high] = self.extent(yarn, along);
        let [left, right] = self.extent(yarn, 1 - along);
        let mut gap = None;
        let on_plane = |nodes: &[u32; 4], axis: usize| nodes.iter().all(|&node| self.nodes[node as usize][axis] == 0.0);
        let sides = [(UPPER, Side::Upper), (LOWER, Side::Lower), (LEFT, Side::Left), (RIGHT, Side::Right)];
        let mut faces: Vec<(u32, u8, Face)> = Vec::new();
        for (nodes, place) in outer_faces(&self.elements[yarn.elements.clone()]) {
            let element = (yarn.elements.start + place as usize) as u32;
            let corners = &self.elements[element as usize];
            let is = |side: [usize; 4]| side.map(|corner| corners[corner]) == nodes;
            let [a, b, c, d] = nodes;
            let line = a == b && c == d || b == c && a == d;
            if is(START) || is(END) {
                let places = |nodes: &[u32]| extent(nodes.iter().map(|&node| self.nodes[node as usize][along]));
                let ([from, to], [at, until]) = (places(corners), places(&nodes));
                let beyond = if is(START) { at - low } else { high - until };
                if beyond > (to - from).max(right - left) {
                    gap = gap.or(Some(place as usize));
                }
                yarn.ends[usize::from(is(END))].extend(nodes);
            } else if !line && (part == Part::Whole || !(0..2).any(|axis| on_plane(&nodes, axis))) {
                let found = sides.into_iter().find(|(side, _)| is(*side));
                faces.extend(found.map(|(_, side)| (element, side as u8, Face { nodes, element, side })));
            }
        }
        faces.sort_by_key(|&(element, side, _)| (element, side));
        self.faces.extend(faces.into_iter().map(|(_, _, face)| face));
        yarn.faces.end = self.faces.len();
        for nodes in &mut yarn.ends {
            nodes.sort_unstable();
            nodes.dedup();
        }
        let held = |node: &&u32| part == Part::Whole || self.nodes[**node as usize][along] != 0.0;
        let [start, end] = &yarn.ends;
        self.rim.extend(end.iter().chain(start).filter(held));
        gap
    }

    /// Numbers the yarns of each family by their places; that nearest to the origin is 0.
    fn number_yarns(&mut self) {
        for family in Family::BOTH {
            let mut yarns: Vec<&mut Yarn> = self.yarns.iter_mut().filter(|yarn| yarn.family == family).collect();
            let distance = |yarn: &&mut Yarn| yarn.coordinate.abs();
            let least = yarns.iter().map(distance).fold(f64::INFINITY, f64::min);
            // Of two that are as near, the one on the positive side.
            let zero = yarns.iter().rposition(|yarn| distance(yarn) <= (1.0 + ROUNDING) * least).unwrap_or(0);
            for (place, yarn) in yarns.iter_mut().enumerate() {
                yarn.number = place as i64 - zero as i64;
            }
        }
    }

    fn cross(&mut self) {
        let inside = |[low, high]: [f64; 2], x: f64| (low..=high).contains(&x);
        let wefts: Vec<usize> = (0..self.yarns.len()).filter(|&i| self.yarns[i].family == Family::Weft).collect();
        for warp in 0..self.yarns.len() - wefts.len() {
            for &weft in &wefts {
                let [i, j] = [&self.yarns[warp], &self.yarns[weft]];
                let place = [j.coordinate, i.coordinate];
                if inside(self.extent(i, 0), place[0]) && inside(self.extent(j, 1), place[1]) {
                    let warp_is_over = self.height_at(i, place) > self.height_at(j, place);
                    self.crossings.push(Crossing { warp, weft, place, warp_is_over });
                }
            }
        }
    }

    /// The middle height of a yarn's nodes that are nearest to a place along it.
    fn height_at(&self, yarn: &Yarn, place: [f64; 2]) -> f64 {
        let along = yarn.family as usize;
        let nodes = &self.nodes[yarn.nodes.clone()];
        let distance = |node: &[f64; 3]| (node[along] - place[along]).abs();
        let least = nodes.iter().map(distance).fold(f64::INFINITY, f64::min);
        let [low, high] = self.extent(yarn, 1 - along);
        let reach = least + ROUNDING * (high - low);
        let [low, high] = extent(nodes.iter().filter(|node| distance(node) <= reach).map(|node| node[2]));
        0.5 * (low + high)
    }
}

impl Grid {
    /// The grid in whose order these elements and nodes are, if they are in one.
    fn of(elements: &[[u32; 8]], nodes: usize, first: u32) -> Option<Grid> {
        let corner = |number: usize| elements.first().map(|element| (element[number] - first) as usize);
        let (along, up, across) = (corner(1)?, corner(2)?, corner(4)?);
        if corner(0)? != 0 || up != 1 || across < 2 || along < across || !along.is_multiple_of(across) {
            return None;
        }
        let grid = Grid { layers: (nodes / along).checked_sub(1)?, columns: along / across - 1, rows: across - 1 };
        let places = (0..grid.layers).flat_map(|layer| {
            (0..grid.columns).flat_map(move |column| (0..grid.rows).map(move |row| [layer, column, row]))
        });
        let same = |(element, place): (&[u32; 8], [usize; 3])| {
            element.map(|node| (node - first) as usize) == grid.corners(place)
        };
        let whole = nodes == grid.section(grid.layers).end && elements.len() == grid.layer(grid.layers).start;
        (whole && elements.iter().zip(places).all(same)).then_some(grid)
    }
}
