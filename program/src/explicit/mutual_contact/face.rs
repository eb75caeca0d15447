//! A point and the faces of a surface: the place on them that is nearest to it.

use super::surface::{NONE, Surface};

/// A place on a face, from −1 to 1 both ways.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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
    pub normal: [f64; 3],
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
pub fn meet(surface: &Surface, face: &mut u32, place: &mut Place, point: [f64; 3]) -> Option<Met> {
    let mut before = NONE;
    for _ in 0..MOVES {
        if surface.gone[*face as usize] {
            return None;
        }
        let corners = surface.faces[*face as usize].map(|corner| surface.positions[corner as usize]);
        let patch = Patch::new(corners);
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
    mean: [f64; 3],
    a: [f64; 3],
    b: [f64; 3],
    c: [f64; 3],
}

impl Patch {
    fn new([p, q, r, s]: [[f64; 3]; 4]) -> Patch {
        let sum = |signs: [f64; 4]| {
            [0, 1, 2].map(|i| 0.25 * (signs[0] * p[i] + signs[1] * q[i] + signs[2] * r[i] + signs[3] * s[i]))
        };
        Patch {
            mean: sum([1.0; 4]),
            a: sum([-1.0, 1.0, 1.0, -1.0]),
            b: sum([-1.0, -1.0, 1.0, 1.0]),
            c: sum([1.0, -1.0, 1.0, -1.0]),
        }
    }

    /// The vector from a point to a place, and the tangents there.
    fn at(&self, Place { xi, eta }: Place, point: [f64; 3]) -> [[f64; 3]; 3] {
        let Patch { mean, a, b, c } = self;
        let along = [0, 1, 2].map(|i| a[i] + eta * c[i]);
        let across = [0, 1, 2].map(|i| b[i] + xi * c[i]);
        [[0, 1, 2].map(|i| mean[i] + xi * along[i] + eta * b[i] - point[i]), along, across]
    }

    /// Newton's method for the nearest place, without the patch's curvature.
    fn project(&self, place: &mut Place, point: [f64; 3]) {
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
    fn met(&self, place: Place, point: [f64; 3]) -> Option<Met> {
        let [away, along, across] = self.at(place, point);
        let normal = cross(along, across);
        let size = dot(normal, normal).sqrt();
        let normal = normal.map(|n| n / size);
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

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
