//! The least distance between two quadrangles in space.

pub type Point = [f64; 3];
pub type Quad = [Point; 4];

/// Both ways of cutting a quadrangle into triangles: one that is not plane lies between them.
const TRIANGLES: [[usize; 3]; 4] = [[0, 1, 2], [0, 2, 3], [0, 1, 3], [1, 2, 3]];
const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2], [1, 3]];

/// The least distance of the triangles of two quadrangles, 0 where they meet, or `bound` if it is not below that.
pub fn quads(a: &Quad, b: &Quad, bound: f64) -> f64 {
    if boxes_apart(a, b) >= bound {
        return bound;
    }
    let mut least = bound * bound;
    let of = |quad: &Quad, triangle: [usize; 3]| triangle.map(|corner| quad[corner]);
    let pairs = [(a, b), (b, a)];
    for (one, other) in pairs {
        for triangle in TRIANGLES.map(|triangle| of(other, triangle)) {
            for point in one {
                least = least.min(point_to_triangle(point, &triangle));
            }
            if EDGES.iter().any(|edge| meet(&one[edge[0]], &one[edge[1]], &triangle)) {
                return 0.0;
            }
        }
    }
    for edge in EDGES {
        for other in EDGES {
            let [one, other] = [edge.map(|i| a[i]), other.map(|i| b[i])];
            least = least.min(segment_to_segment(&one, &other));
        }
    }
    least.sqrt()
}

/// The distance of the boxes around two quadrangles.
fn boxes_apart(a: &Quad, b: &Quad) -> f64 {
    let gap = |axis: usize| {
        let [one, other] = [range(a, axis), range(b, axis)];
        (one[0] - other[1]).max(other[0] - one[1]).max(0.0)
    };
    [0, 1, 2].map(|axis| gap(axis) * gap(axis)).iter().sum::<f64>().sqrt()
}

/// The least and the largest coordinate of a quadrangle.
pub fn range(quad: &Quad, axis: usize) -> [f64; 2] {
    let [a, b, c, d] = quad.each_ref().map(|point| point[axis]);
    [a.min(b).min(c).min(d), a.max(b).max(c).max(d)]
}

/// The square of a point's distance to a triangle (Ericson, Real-Time Collision Detection, section 5.1.5).
fn point_to_triangle(point: &Point, [a, b, c]: &[Point; 3]) -> f64 {
    let normal = cross(minus(b, a), minus(c, a));
    let inside = |from: &Point, to: &Point| dot(cross(minus(to, from), minus(point, from)), normal) >= 0.0;
    if inside(a, b) && inside(b, c) && inside(c, a) {
        let size = dot(normal, normal);
        let from_a = minus(point, a);
        return if size > 0.0 { dot(from_a, normal).powi(2) / size } else { dot(from_a, from_a) };
    }
    let edge = |from: &Point, to: &Point| point_to_segment(point, from, to);
    edge(a, b).min(edge(b, c)).min(edge(c, a))
}

fn point_to_segment(point: &Point, from: &Point, to: &Point) -> f64 {
    let [along, offset] = [minus(to, from), minus(point, from)];
    let share = (dot(offset, along) / dot(along, along)).clamp(0.0, 1.0);
    let rest = minus(&offset, &along.map(|x| share * x));
    dot(rest, rest)
}

/// The square of the distance of two segments: between their lines where both feet are inside, else from an end.
fn segment_to_segment([a, b]: &[Point; 2], [c, d]: &[Point; 2]) -> f64 {
    let ends = [(a, c, d), (b, c, d), (c, a, b), (d, a, b)];
    let least = ends.iter().map(|(end, from, to)| point_to_segment(end, from, to)).fold(f64::INFINITY, f64::min);
    let [u, v, w] = [minus(b, a), minus(d, c), minus(a, c)];
    let [uu, uv, vv, uw, vw] = [dot(u, u), dot(u, v), dot(v, v), dot(u, w), dot(v, w)];
    let determinant = uu * vv - uv * uv;
    if determinant <= 1e-14 * uu * vv {
        return least; // Parallel: the least distance is found at an end too.
    }
    let [s, t] = [(uv * vw - vv * uw) / determinant, (uu * vw - uv * uw) / determinant];
    if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) {
        let between = [0, 1, 2].map(|i| w[i] + s * u[i] - t * v[i]);
        return least.min(dot(between, between));
    }
    least
}

/// Whether a segment goes through a triangle.
fn meet(from: &Point, to: &Point, [a, b, c]: &[Point; 3]) -> bool {
    let normal = cross(minus(b, a), minus(c, a));
    let [below, above] = [from, to].map(|end| dot(minus(end, a), normal));
    if below * above > 0.0 || below == above {
        return false;
    }
    let share = below / (below - above);
    let point = [0, 1, 2].map(|i| from[i] + share * (to[i] - from[i]));
    [(a, b), (b, c), (c, a)].iter().all(|(p, q)| dot(cross(minus(q, p), minus(&point, p)), normal) >= 0.0)
}

fn minus(a: &Point, b: &Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const UNIT: Quad = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];

    #[test]
    fn distances_of_faces_edges_and_corners() {
        let shifted = |by: [f64; 3]| UNIT.map(|point| [0, 1, 2].map(|i| point[i] + by[i]));
        let a = UNIT;
        for (by, distance) in
            [([0.3, 0.4, 0.2], 0.2), ([1.3, 0.4, 0.4], 0.5), ([1.0, 2.0, 2.0], 5_f64.sqrt()), ([0.5, 0.5, 0.0], 0.0)]
        {
            assert!((quads(&a, &shifted(by), 10.0) - distance).abs() < 1e-14, "{by:?}");
        }
        assert_eq!(quads(&a, &shifted([0.0, 0.0, 3.0]), 2.0), 2.0, "no more than the bound");
        let edge_on = [[0.2, 0.5, 0.1], [0.8, 0.5, 0.1], [0.8, 0.5, 1.0], [0.2, 0.5, 1.0]];
        assert!((quads(&a, &edge_on, 10.0) - 0.1).abs() < 1e-15);
        let through = [[0.2, 0.5, -0.1], [0.8, 0.5, -0.1], [0.8, 0.5, 1.0], [0.2, 0.5, 1.0]];
        assert_eq!(quads(&a, &through, 10.0), 0.0);
    }

    proptest! {
        /// No pair of points on them is nearer, and some pair is nearly as near.
        #[test]
        fn as_near_as_the_nearest_points(values in proptest::collection::vec(-1.0..1.0_f64, 18)) {
            let point = |i: usize| [values[3 * i], values[3 * i + 1], values[3 * i + 2]];
            let sum = |a: Point, b: Point, c: Point| [0, 1, 2].map(|i| a[i] + b[i] - c[i]);
            // Two parallelograms.
            let plane = |i: usize| [point(i), point(i + 1), sum(point(i + 1), point(i + 2), point(i)), point(i + 2)];
            let [a, b] = [plane(0), plane(3)];
            let distance = quads(&a, &b, 100.0);
            let steps = 12;
            let on = |q: &Quad, i: i32, j: i32| {
                let [s, t] = [i, j].map(|k| f64::from(k) / f64::from(steps));
                [0, 1, 2].map(|k| q[0][k] + (q[1][k] - q[0][k]) * s + (q[3][k] - q[0][k]) * t)
            };
            let grid = |q: &Quad| -> Vec<Point> {
                (0..=steps).flat_map(|i| (0..=steps).map(move |j| (i, j))).map(|(i, j)| on(q, i, j)).collect()
            };
            let others = grid(&b);
            let length = |p: &Point, q: &Point| dot(minus(p, q), minus(p, q)).sqrt();
            let pairs = grid(&a).into_iter().flat_map(|p| others.iter().map(move |q| length(&p, q)));
            let sampled = pairs.fold(f64::INFINITY, f64::min);
            let size = [&a, &b].map(|q| length(&q[1], &q[0]) + length(&q[3], &q[0])).iter().sum::<f64>();
            prop_assert!(distance <= sampled + 1e-12);
            prop_assert!(sampled <= distance + 0.5 * size / f64::from(steps));
        }
    }
}
