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

/// Newton's steps, of which a point that has moved little since the last call needs two.
const STEPS: usize = 8;
const CLOSE: f64 = 1e-9;
/// A point that has moved far is followed over this many faces.
const MOVES: usize = 6;
/// What lies beyond a surface's border by this is still on it: nodes on a plane of symmetry are, but for rounding.
const BORDER: f64 = 1e-2;

/// Finds the place nearest to a point, from the given one on, on that face or those around it; `None` where the point lies beyond
/// the surface's border.
pub fn meet(surface: &Surface, face: &mut u32, place: &mut Place, point: Vector) -> Option<Met> {
    let mut before = NONE;
    for _ in 0..MOVES {
        if surface.gone[*face as usize] {
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
            *place = Place { xi: xi.clamp(-1.0, 1.0), eta: eta.clamp(-1.0, 1.0) };
            return patch.met(*place, point);
        }
        before = *face;
        *face = next;
        *place = Place::default();
    }
    None
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
        let at = |corner: u32| surface.positions[corner as usize];
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

    /// Newton's method for the nearest place, without the patch's curvature.
    #[inline(always)]
    fn project(&self, place: &mut Place, point: Vector) {
        for _ in 0..STEPS {
            let [away, along, across] = self.at(*place, point);
            let [aa, bb, ab] = [dot(along, along), dot(across, across), dot(along, across)];
            let [x, y] = [-dot(along, away), -dot(across, away)];
            let determinant = aa * bb - ab * ab;
            let [d_xi, d_eta] = [(bb * x - ab * y) / determinant, (aa * y - ab * x) / determinant];
            // A place far outside is left for another face.
            place.xi = (place.xi + d_xi).clamp(-2.0, 2.0);
            place.eta = (place.eta + d_eta).clamp(-2.0, 2.0);
            if d_xi.abs() + d_eta.abs() < CLOSE {
                return;
            }
        }
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
