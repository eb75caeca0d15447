//! Points and the faces of surfaces: the places on them that are nearest.

#![expect(clippy::needless_range_loop, reason = "what is inlined for certain: see Lanes")]

use serde::{Deserialize, Serialize};

use super::surface::{NONE, Surface};
use crate::instructions::{Loops, run_widest};
use crate::lanes::{LANES, Lanes, add, cross, dot, sub};
use crate::vector::Vector;

/// A place on a face, from −1 to 1 both ways.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Place {
    pub xi: f64,
    pub eta: f64,
}

/// Where a point is in relation to a face.
#[derive(Clone, Copy, Debug)]
pub struct Met {
    /// Along the normal, inwards.
    pub depth: f64,
    /// The face's outward unit normal there.
    pub normal: Vector,
    /// The corners' shares of that place.
    pub weights: [f64; 4],
}

/// Newton's steps, of which a point that has moved little since the last call needs one or two.
const STEPS: usize = 8;
/// A step this short is the last one. The next one of Newton's would be as long as its square, and the depth, which is
/// least at the nearest place, is off by the square of that.
const CLOSE: f64 = 1e-3;
/// A point that has moved far is followed over this many faces.
const MOVES: usize = 6;
/// What lies beyond a surface's border by this is still on it: nodes on a plane of symmetry are, but for rounding.
const BORDER: f64 = 1e-2;

/// A point whose nearest place on a surface is looked for, from a place on one of its faces on.
#[derive(Clone, Copy, Debug)]
pub struct Query {
    /// Whose surface it is.
    pub body: u32,
    pub face: u32,
    pub place: Place,
    point: Vector,
    /// The face that it came from, or `NONE`.
    before: u32,
    /// `None` where the point lies beyond the surface's border, deleted faces being beyond it, or where the face has
    /// shrunk to a line.
    pub met: Option<Met>,
}

/// Where a query goes on.
enum Next {
    /// Found, or beyond the surface's border.
    Done,
    /// Projected onto another face.
    Face,
    /// In the wedge between two faces, whose edge is nearest.
    Edge,
}

impl Query {
    pub fn new(body: u32, face: u32, place: Place, point: Vector) -> Query {
        Query { body, face, place, point, before: NONE, met: None }
    }

    /// Follows the point over the edge beyond which its projection lies.
    fn go_on(&mut self, surface: &Surface) -> Next {
        let Place { xi, eta } = self.place;
        let edge = match (xi.abs() > 1.0 || eta.abs() > 1.0, xi.abs() >= eta.abs()) {
            (false, _) => return Next::Done,
            (true, true) if xi > 0.0 => 1,
            (true, true) => 3,
            (true, false) if eta > 0.0 => 2,
            (true, false) => 0,
        };
        let next = surface.neighbours[self.face as usize][edge];
        if next == NONE || surface.state.gone[next as usize] {
            if xi.abs().max(eta.abs()) > 1.0 + BORDER {
                self.met = None;
            }
            return Next::Done;
        }
        if next == self.before {
            return Next::Edge;
        }
        self.place = self.place.beyond(edge, surface.neighbours[next as usize].iter().position(|&at| at == self.face));
        (self.before, self.face) = (self.face, next);
        Next::Face
    }
}

impl Place {
    /// The place next to this one on the edge of the neighbour, given by the edge's number on either side; edges run
    /// counter-clockwise from corner to corner, so that the neighbour's runs the other way. Its centre where the
    /// neighbour does not know this face.
    fn beyond(self, edge: usize, of_neighbour: Option<usize>) -> Place {
        let Place { xi, eta } = self;
        let along = -[xi, eta, -xi, -eta][edge].clamp(-1.0, 1.0);
        match of_neighbour {
            Some(0) => Place { xi: along, eta: -1.0 },
            Some(1) => Place { xi: 1.0, eta: along },
            Some(2) => Place { xi: -along, eta: 1.0 },
            Some(3) => Place { xi: -1.0, eta: -along },
            _ => Place::default(),
        }
    }
}

/// Finds the places nearest to points, side by side.
#[derive(Debug, Default)]
pub struct Finder {
    pub queries: Vec<Query>,
    /// The numbers of those that are looked for, and of those that lie at an edge.
    open: Vec<u32>,
    at_edges: Vec<u32>,
}

impl Finder {
    /// Answers all queries.
    pub fn find(&mut self, surfaces: &[Surface]) {
        let Finder { queries, open, at_edges } = self;
        let surface = |query: &Query| &surfaces[query.body as usize];
        debug_assert!(queries.iter().all(|query| !surface(query).state.gone[query.face as usize]));
        open.clear();
        open.extend(0..queries.len() as u32);
        at_edges.clear();
        for _ in 0..MOVES {
            if open.is_empty() {
                break;
            }
            run_widest(Project { surfaces, queries, selected: open });
            open.retain(|&number| {
                let query = &mut queries[number as usize];
                let next = query.go_on(surface(query));
                if matches!(next, Next::Edge) {
                    at_edges.push(number);
                }
                matches!(next, Next::Face)
            });
        }
        // Round a corner where several faces meet, it is that or one of its edges.
        at_edges.append(open);
        if !at_edges.is_empty() {
            run_widest(AtEdge { surfaces, queries, selected: at_edges });
        }
    }
}

/// Newton's method on each query's face.
struct Project<'a> {
    surfaces: &'a [Surface],
    queries: &'a mut [Query],
    selected: &'a [u32],
}

/// The nearest place of queries in the wedge between their face and that before.
struct AtEdge<'a> {
    surfaces: &'a [Surface],
    queries: &'a mut [Query],
    selected: &'a [u32],
}

impl Loops for Project<'_> {
    #[inline(always)]
    fn run(self) {
        for group in 0..self.selected.len().div_ceil(LANES) {
            let numbers = numbers(self.selected, group * LANES);
            let (point, mut place) = load(self.queries, &numbers);
            let patch = Patch::new(self.surfaces, self.queries, &numbers, false);
            patch.project(&mut place, point);
            patch.met(place, point).store(self.queries, &numbers, place);
        }
    }
}

impl Loops for AtEdge<'_> {
    #[inline(always)]
    fn run(self) {
        let centre = [Lanes::zero(), Lanes::zero()];
        for group in 0..self.selected.len().div_ceil(LANES) {
            let numbers = numbers(self.selected, group * LANES);
            let (point, mut place) = load(self.queries, &numbers);
            for l in 0..LANES {
                place[0].0[l] = within(1.0, place[0].0[l]);
                place[1].0[l] = within(1.0, place[1].0[l]);
            }
            let patch = Patch::new(self.surfaces, self.queries, &numbers, false);
            let beside = Patch::new(self.surfaces, self.queries, &numbers, true).met(centre, point);
            patch.met_at_edge(place, point, &beside).store(self.queries, &numbers, place);
        }
    }
}

type Vectors = [Lanes<f64>; 3];

/// A number from −size to size; NaN stays.
#[inline(always)]
fn within(size: f64, number: f64) -> f64 {
    if number > size {
        size
    } else if number < -size {
        -size
    } else {
        number
    }
}

/// The numbers of the queries in the lanes, that of the last one in those that are left.
#[inline(always)]
fn numbers(selected: &[u32], first: usize) -> [usize; LANES] {
    let (mut numbers, last) = ([0; LANES], selected.len() - 1);
    for l in 0..LANES {
        numbers[l] = selected[if first + l < last { first + l } else { last }] as usize;
    }
    numbers
}

/// The queries' points and places.
#[inline(always)]
fn load(queries: &[Query], numbers: &[usize; LANES]) -> (Vectors, [Lanes<f64>; 2]) {
    let (mut point, mut place) = ([Lanes::zero(); 3], [Lanes::zero(); 2]);
    for l in 0..LANES {
        let query = &queries[numbers[l]];
        for i in 0..3 {
            point[i].0[l] = query.point[i];
        }
        (place[0].0[l], place[1].0[l]) = (query.place.xi, query.place.eta);
    }
    (point, place)
}

/// The bilinear surfaces through four corners: mean + ξ a + η b + ξη c.
struct Patch {
    mean: Vectors,
    a: Vectors,
    b: Vectors,
    c: Vectors,
}

/// [`Met`] of several points.
struct AllMet {
    depth: Lanes<f64>,
    normal: Vectors,
    weights: [Lanes<f64>; 4],
    /// Above 0 where the face has not shrunk to a line.
    size: Lanes<f64>,
}

impl Patch {
    /// Of the queries' faces, or of those that they came from.
    #[inline(always)]
    fn new(surfaces: &[Surface], queries: &[Query], numbers: &[usize; LANES], before: bool) -> Patch {
        let mut corners = [[Lanes::zero(); 3]; 4];
        for l in 0..LANES {
            let query = &queries[numbers[l]];
            let surface = &surfaces[query.body as usize];
            let nodes = &surface.faces[if before { query.before } else { query.face } as usize];
            for k in 0..4 {
                let position = &surface.state.points[nodes[k] as usize].position;
                for i in 0..3 {
                    corners[k][i].0[l] = position[i];
                }
            }
        }
        let [p, q, r, s] = corners;
        // Differences first: the corners' coordinates are large beside them.
        let (pq, sr) = (sub(q, p), sub(r, s));
        let (ps, qr) = (sub(s, p), sub(r, q));
        Patch {
            mean: quarter(add(add(add(p, q), r), s)),
            a: quarter(add(pq, sr)),
            b: quarter(add(ps, qr)),
            c: quarter(sub(sr, pq)),
        }
    }

    /// The vectors from points to places, and the tangents there.
    #[inline(always)]
    fn at(&self, [xi, eta]: [Lanes<f64>; 2], point: Vectors) -> [Vectors; 3] {
        let along = plus(self.a, eta, self.c);
        let across = plus(self.b, xi, self.c);
        [plus(plus(sub(self.mean, point), xi, along), eta, self.b), along, across]
    }

    /// Newton's method for the nearest places.
    #[inline(always)]
    fn project(&self, place: &mut [Lanes<f64>; 2], point: Vectors) {
        let zero = Lanes::zero();
        let mut going = Lanes::constant(1.0);
        for _ in 0..STEPS {
            let [away, along, across] = self.at(*place, point);
            let [aa, bb, ab] = [dot(along, along), dot(across, across), dot(along, across)];
            let [x, y] = [zero - dot(along, away), zero - dot(across, away)];
            // The patch is bent by its twist, which counts where that leaves the distance a least one.
            let bent = ab + dot(away, self.c);
            let (flat, twisted) = (aa * bb - ab * ab, aa * bb - bent * bent);
            let mut left = zero;
            for l in 0..LANES {
                let is_least = twisted.0[l] > 0.5 * flat.0[l];
                let ab = if is_least { bent.0[l] } else { ab.0[l] };
                let per_determinant = 1.0 / if is_least { twisted.0[l] } else { flat.0[l] };
                let d_xi = (bb.0[l] * x.0[l] - ab * y.0[l]) * per_determinant;
                let d_eta = (aa.0[l] * y.0[l] - ab * x.0[l]) * per_determinant;
                // A place far outside is left for another face.
                let (xi, eta) = (place[0].0[l] + d_xi, place[1].0[l] + d_eta);
                let is_going = going.0[l] > 0.0;
                place[0].0[l] = if is_going { within(2.0, xi) } else { place[0].0[l] };
                place[1].0[l] = if is_going { within(2.0, eta) } else { place[1].0[l] };
                left.0[l] = if is_going && d_xi.abs() + d_eta.abs() >= CLOSE { 1.0 } else { 0.0 };
            }
            going = left;
            if going.sum() == 0.0 {
                return;
            }
        }
    }

    #[inline(always)]
    fn met(&self, place: [Lanes<f64>; 2], point: Vectors) -> AllMet {
        let [away, along, across] = self.at(place, point);
        let normal = cross(along, across);
        let size = dot(normal, normal).sqrt();
        let (one, quarter) = (Lanes::constant(1.0), Lanes::constant(0.25));
        let normal = scale(one / size, normal);
        let [xi, eta] = place;
        let [lower, upper] = [quarter * (one - eta), quarter * (one + eta)];
        let weights = [lower * (one - xi), lower * (one + xi), upper * (one + xi), upper * (one - xi)];
        AllMet { depth: dot(away, normal), normal, weights, size }
    }

    /// At an edge, where the distance is not along the face's normal: the force is along the distance, so that it turns
    /// from one face's normal to the other's and does not jump. The point is inside if it is so by the mean of this
    /// normal and that beside it.
    #[inline(always)]
    fn met_at_edge(&self, place: [Lanes<f64>; 2], point: Vectors, beside: &AllMet) -> AllMet {
        let mut met = self.met(place, point);
        let [away, ..] = self.at(place, point);
        let distance = dot(away, away).sqrt();
        let side = dot(away, add(met.normal, beside.normal));
        for l in 0..LANES {
            let depth = if side.0[l] < 0.0 { -distance.0[l] } else { distance.0[l] };
            let is_apart = distance.0[l] != 0.0;
            met.depth.0[l] = if is_apart { depth } else { met.depth.0[l] };
            for i in 0..3 {
                let along = away[i].0[l] / depth;
                met.normal[i].0[l] = if is_apart { along } else { met.normal[i].0[l] };
            }
            met.size.0[l] = if beside.size.0[l] > 0.0 { met.size.0[l] } else { 0.0 };
        }
        met
    }
}

impl AllMet {
    #[inline(always)]
    fn store(&self, queries: &mut [Query], numbers: &[usize; LANES], place: [Lanes<f64>; 2]) {
        for l in 0..LANES {
            let query = &mut queries[numbers[l]];
            (query.place, query.met) = (Place::default(), None);
            if self.size.0[l] > 0.0 {
                query.place = Place { xi: place[0].0[l], eta: place[1].0[l] };
                let normal = [self.normal[0].0[l], self.normal[1].0[l], self.normal[2].0[l]];
                let [a, b, c, d] = &self.weights;
                let weights = [a.0[l], b.0[l], c.0[l], d.0[l]];
                query.met = Some(Met { depth: self.depth.0[l], normal, weights });
            }
        }
    }
}

#[inline(always)]
fn scale(factor: Lanes<f64>, [x, y, z]: Vectors) -> Vectors {
    [factor * x, factor * y, factor * z]
}

#[inline(always)]
fn quarter(vectors: Vectors) -> Vectors {
    scale(Lanes::constant(0.25), vectors)
}

/// a + factor b.
#[inline(always)]
fn plus(a: Vectors, factor: Lanes<f64>, b: Vectors) -> Vectors {
    add(a, scale(factor, b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::vector::{dot, minus};

    fn surface(nodes: &[[f64; 3]], faces: &[[u32; 4]]) -> Surface {
        let mesh = Mesh {
            nodes: nodes.to_vec(),
            elements: Vec::new(),
            fibre: Vec::new(),
            elements_per_layer: 1,
            nodes_per_section: 1,
            surface: Vec::new(),
        };
        Surface::new(&mesh, faces.to_vec(), vec![0; faces.len()])
    }

    /// Two faces that meet in an edge along axis 2 at this height over their outer edges; outside is where axis 1
    /// points.
    fn folded(height: f64) -> Surface {
        let nodes = [-1.0, 0.0, 1.0].map(|x| [0.0, 1.0].map(|z| [x, if x == 0.0 { height } else { 0.0 }, z]));
        surface(nodes.as_flattened(), &[[0, 1, 3, 2], [2, 3, 5, 4]])
    }

    fn met(surface: &Surface, from: u32, point: Vector) -> Met {
        let mut finder = Finder { queries: vec![Query::new(0, from, Place::default(), point)], ..Finder::default() };
        finder.find(std::slice::from_ref(surface));
        finder.queries[0].met.expect("it is over the surface")
    }

    #[test]
    fn the_force_at_an_edge_turns_from_one_normal_to_the_other() {
        // Under a valley and over a ridge the edge is nearest; from either face the answer is the same.
        for (height, below) in [(-0.4, 0.3), (0.4, -0.3)] {
            let surface = folded(height);
            let mut before: Option<Met> = None;
            for i in -40..=40 {
                let point = [0.01 * f64::from(i), height - below, 0.4];
                let [one, other] = [0, 1].map(|face| met(&surface, face, point));
                assert!((one.depth - other.depth).abs() < 1e-9, "{point:?} {one:?} {other:?}");
                assert!(dot(minus(one.normal, other.normal), minus(one.normal, other.normal)) < 1e-16);
                assert!(one.depth.signum() == below.signum(), "{point:?} {one:?}");
                // The place that the shares of the corners give is that far off, along the normal.
                if let Some(before) = before {
                    let turned = minus(one.normal, before.normal);
                    assert!(dot(turned, turned).sqrt() < 0.04, "{point:?} {turned:?}");
                    assert!((one.depth - before.depth).abs() < 0.011);
                }
                before = Some(one);
            }
        }
    }

    #[test]
    fn a_point_outside_a_sharp_edge_is_outside() {
        // The faces' normals are more than a right angle apart: each alone would have the point inside.
        let surface = folded(3.0);
        for x in [-0.2, 0.0, 0.2] {
            let found = met(&surface, 0, [x, 3.2, 0.5]);
            assert!((found.depth + (x * x + 0.04_f64).sqrt()).abs() < 1e-6, "{found:?}");
        }
    }

    #[test]
    fn a_corner_of_many_faces_is_met_from_any_of_them() {
        // A pyramid of four faces whose top is shared, from above and, with the top as a pit, from below.
        for height in [0.5, -0.5] {
            let at = |x: usize, z: usize| (3 * x + z) as u32;
            let mut nodes = Vec::new();
            for x in [-1.0, 0.0, 1.0] {
                nodes.extend([-1.0, 0.0, 1.0].map(|z| [x, if x == 0.0 && z == 0.0 { height } else { 0.0 }, z]));
            }
            let face = |x: usize, z: usize| [at(x, z), at(x, z + 1), at(x + 1, z + 1), at(x + 1, z)];
            let surface = surface(&nodes, &[face(0, 0), face(0, 1), face(1, 0), face(1, 1)]);
            let point = [0.01, 1.4 * height, -0.02];
            for from in 0..4 {
                let found = met(&surface, from, point);
                let away = minus([0.0, height, 0.0], point);
                assert!((found.depth.abs() - dot(away, away).sqrt()).abs() < 1e-9, "{from} {found:?}");
                assert!(found.depth.signum() == -height.signum(), "{from} {found:?}");
            }
        }
    }

    #[test]
    fn queries_side_by_side_have_the_answers_of_each_alone() {
        // Two ridges, of which the second has lost a face; points over faces, at edges, at corners and beyond the
        // border.
        let mut surfaces = [folded(0.4), folded(3.0)];
        surfaces[1].state.gone[1] = true;
        let mut finder = Finder::default();
        for i in 0..43 {
            let (x, body) = (0.07 * f64::from(i) - 1.5, i % 2);
            let from = if body == 0 { i / 2 % 2 } else { 0 };
            let point = [x, 0.3 + 0.01 * f64::from(i), 0.4 + 0.3 * f64::from(i % 3)];
            finder.queries.push(Query::new(body as u32, from as u32, Place::default(), point));
        }
        let alone: Vec<Query> = finder.queries.clone();
        finder.find(&surfaces);
        let beyond = finder.queries.iter().filter(|query| query.met.is_none()).count();
        assert!(beyond > 3 && beyond < 20, "{beyond}");
        for (together, query) in finder.queries.iter().zip(alone) {
            let mut one = Finder { queries: vec![query], ..Finder::default() };
            one.find(&surfaces);
            // All digits are printed.
            assert_eq!(format!("{:?}", one.queries[0]), format!("{together:?}"));
        }
    }

    #[test]
    fn a_point_over_a_deleted_face_comes_back() {
        let mut surface = folded(0.0);
        surface.state.gone[1] = true;
        let mut query = Query::new(0, 0, Place::default(), [0.3, -0.1, 0.5]);
        for (x, depth) in [(0.3, None), (-0.2, Some(0.1))] {
            query = Query::new(0, query.face, query.place, [x, -0.1, 0.5]);
            let mut finder = Finder { queries: vec![query], ..Finder::default() };
            finder.find(std::slice::from_ref(&surface));
            query = finder.queries[0];
            let found = query.met.map(|met| met.depth.abs());
            assert!(found.is_some() == depth.is_some(), "{found:?}");
            assert!((found.unwrap_or(0.0) - depth.unwrap_or(0.0)).abs() < 1e-9, "{found:?}");
        }
    }

    #[test]
    fn the_nearest_place_on_a_twisted_face_is_found() {
        let nodes = [[0.0, 0.0, 0.0], [0.3, 0.5, 1.1], [1.6, -0.4, 1.0], [1.0, 0.5, 0.1]];
        let surface = surface(&nodes, &[[0, 1, 2, 3]]);
        let distance = |Place { xi, eta }: Place, point: Vector| {
            let weights = [
                (1.0 - xi) * (1.0 - eta),
                (1.0 + xi) * (1.0 - eta),
                (1.0 + xi) * (1.0 + eta),
                (1.0 - xi) * (1.0 + eta),
            ];
            let at = |i: usize| (0..4).map(|k| 0.25 * weights[k] * nodes[k][i]).sum::<f64>();
            let away = minus([at(0), at(1), at(2)], point);
            dot(away, away).sqrt()
        };
        for height in [-0.3, -0.05, 0.05, 0.3] {
            let mut least = f64::INFINITY;
            let point = [0.7, 0.15 + height, 0.5];
            for (i, j) in (0..=400).flat_map(|i| (0..=400).map(move |j| (i, j))) {
                let place = Place { xi: -1.0 + f64::from(i) / 200.0, eta: -1.0 + f64::from(j) / 200.0 };
                least = least.min(distance(place, point));
            }
            let found = met(&surface, 0, point);
            assert!(found.depth.abs() <= least && found.depth.abs() > least - 1e-3, "{found:?} {least}");
            assert!(found.depth.signum() == -height.signum(), "{found:?}");
        }
    }
}
