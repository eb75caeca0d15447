//! A point and the faces of a surface: the place on them that is nearest to it.

use serde::{Deserialize, Serialize};

use super::surface::{NONE, Surface};
use crate::explicit::vector::{Vector, add, cross, dot, minus, times};

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
/// A step this short is the last one: the next would be as long as its square.
const CLOSE: f64 = 1e-6;
/// A point that has moved far is followed over this many faces.
const MOVES: usize = 6;
/// What lies beyond a surface's border by this is still on it: nodes on a plane of symmetry are, but for rounding.
const BORDER: f64 = 1e-2;

/// Finds the place nearest to a point, from the given one on, on that face or those around it; `None` where the point lies beyond
/// the surface's border.
pub fn meet(surface: &Surface, face: &mut u32, place: &mut Place, point: Vector) -> Option<Met> {
    let mut before = NONE;
    for _ in 0..MOVES {
        if surface.state.gone[*face as usize] {
            return None;
        }
        let patch = Patch::new(surface, *face);
        patch.project(place, point);
        let Place { xi, eta } = *place;
        let edge = match (xi.abs() > 1.0 || eta.abs() > 1.0, xi.abs() >= eta.abs()) {
            (false, _) => return patch.met(*place, point),
            (true, true) => {
                if xi > 0.0 {
                    1
                } else {
                    3
                }
            }
            (true, false) => {
                if eta > 0.0 {
                    2
                } else {
                    0
                }
            }
        };
        let next = surface.neighbours[*face as usize][edge];
        if next == NONE {
            let beyond = xi.abs().max(eta.abs()) > 1.0 + BORDER;
            return if beyond { None } else { patch.met(*place, point) };
        }
        if next == before {
            // In the wedge between two faces: the edge is nearest.
            break;
        }
        before = *face;
        *face = next;
        *place = Place::default();
    }
    // Round a corner where several faces meet, it is that or one of its edges.
    *place = Place { xi: place.xi.clamp(-1.0, 1.0), eta: place.eta.clamp(-1.0, 1.0) };
    let beside = Patch::new(surface, before).met(Place::default(), point)?;
    Patch::new(surface, *face).met_at_edge(*place, point, beside.normal)
}

/// The bilinear surface through four corners: mean + ξ a + η b + ξη c.
struct Patch {
    mean: Vector,
    a: Vector,
    b: Vector,
    c: Vector,
}

impl Patch {
    #[inline(always)]
    fn new(surface: &Surface, face: u32) -> Patch {
        let [p, q, r, s] = surface.faces[face as usize];
        let at = |corner: u32| surface.state.positions[corner as usize];
        let (p, q, r, s) = (at(p), at(q), at(r), at(s));
        // Differences first: the corners' coordinates are large beside them.
        let (pq, sr) = (minus(q, p), minus(r, s));
        let (ps, qr) = (minus(s, p), minus(r, q));
        Patch {
            mean: times(0.25, add(add(add(p, 1.0, q), 1.0, r), 1.0, s)),
            a: times(0.25, add(pq, 1.0, sr)),
            b: times(0.25, add(ps, 1.0, qr)),
            c: times(0.25, minus(sr, pq)),
        }
    }

    /// The vector from a point to a place, and the tangents there.
    #[inline(always)]
    fn at(&self, Place { xi, eta }: Place, point: Vector) -> [Vector; 3] {
        let along = add(self.a, eta, self.c);
        let across = add(self.b, xi, self.c);
        [add(add(minus(self.mean, point), xi, along), eta, self.b), along, across]
    }

    /// Newton's method for the nearest place.
    #[inline(always)]
    fn project(&self, place: &mut Place, point: Vector) {
        for _ in 0..STEPS {
            let [away, along, across] = self.at(*place, point);
            let [aa, bb, ab] = [dot(along, along), dot(across, across), dot(along, across)];
            let [x, y] = [-dot(along, away), -dot(across, away)];
            // The patch is bent by its twist, which counts where that leaves the distance a least one.
            let bent = ab + dot(away, self.c);
            let (flat, twisted) = (aa * bb - ab * ab, aa * bb - bent * bent);
            let (ab, determinant) = if twisted > 0.5 * flat { (bent, twisted) } else { (ab, flat) };
            let per_determinant = 1.0 / determinant;
            let [d_xi, d_eta] = [(bb * x - ab * y) * per_determinant, (aa * y - ab * x) * per_determinant];
            // A place far outside is left for another face.
            place.xi = (place.xi + d_xi).clamp(-2.0, 2.0);
            place.eta = (place.eta + d_eta).clamp(-2.0, 2.0);
            if d_xi.abs() + d_eta.abs() < CLOSE {
                return;
            }
        }
    }

    /// At an edge, where the distance is not along the face's normal: the force is along the distance, so that it turns from one
    /// face's normal to the other's and does not jump. The point is inside if it is so by the mean of this normal and that beside it.
    fn met_at_edge(&self, place: Place, point: Vector, beside: Vector) -> Option<Met> {
        let met = self.met(place, point)?;
        let [away, ..] = self.at(place, point);
        let size = dot(away, away).sqrt();
        if size == 0.0 {
            return Some(met);
        }
        let depth = if dot(away, add(met.normal, 1.0, beside)) < 0.0 { -size } else { size };
        Some(Met { depth, normal: times(1.0 / depth, away), ..met })
    }

    /// None on a face that has shrunk to a line.
    #[inline(always)]
    fn met(&self, place: Place, point: Vector) -> Option<Met> {
        let [away, along, across] = self.at(place, point);
        let normal = cross(along, across);
        let size = dot(normal, normal).sqrt();
        let normal = times(1.0 / size, normal);
        let Place { xi, eta } = place;
        let weights = [
            0.25 * (1.0 - xi) * (1.0 - eta),
            0.25 * (1.0 + xi) * (1.0 - eta),
            0.25 * (1.0 + xi) * (1.0 + eta),
            0.25 * (1.0 - xi) * (1.0 + eta),
        ];
        (size > 0.0).then(|| Met { depth: dot(away, normal), normal, weights })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::explicit::mesh::Mesh;

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

    /// Two faces that meet in an edge along axis 2 at this height over their outer edges; outside is where axis 1 points.
    fn folded(height: f64) -> Surface {
        let nodes = [-1.0, 0.0, 1.0].map(|x| [0.0, 1.0].map(|z| [x, if x == 0.0 { height } else { 0.0 }, z]));
        surface(nodes.as_flattened(), &[[0, 1, 3, 2], [2, 3, 5, 4]])
    }

    fn met(surface: &Surface, from: u32, point: Vector) -> Met {
        meet(surface, &mut { from }, &mut Place::default(), point).expect("it is over the surface")
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
    fn the_nearest_place_on_a_twisted_face_is_found() {
        let nodes = [[0.0, 0.0, 0.0], [0.3, 0.5, 1.1], [1.6, -0.4, 1.0], [1.0, 0.5, 0.1]];
        let surface = surface(&nodes, &[[0, 1, 2, 3]]);
        let patch = Patch::new(&surface, 0);
        let distance = |place: Place, point: Vector| {
            let [away, ..] = patch.at(place, point);
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
