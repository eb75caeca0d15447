//! The amplitude of the centre lines: that which leaves the stated clearance between the meshed faces of crossing
//! yarns.

use std::collections::BTreeSet;

use super::distance::{self, Point, Quad};
use super::geometry::{Family, Geometry, Weave};

/// The clearance is met to this part of the yarns' heights, far finer than is asked for.
const ACCURACY: f64 = 1e-9;
const MOST_TRIALS: usize = 100;
/// A centre line that is steeper has no sound elements around it.
const STEEPEST: f64 = 1.0;

impl Weave {
    /// The weave with the amplitude that leaves its clearance.
    ///
    /// # Errors
    /// What cannot be meshed, or that there is no room between the yarns.
    pub fn solve(&self) -> Result<Geometry, String> {
        self.check()?;
        let height = self.threads[0].height + self.threads[1].height;
        let accuracy = ACCURACY * height;
        let crossings = distinct_crossings(self);
        let least = |amplitude: f64, of: fn(&Geometry, [i64; 2]) -> f64| {
            let geometry = Geometry::new(self, amplitude);
            let values = crossings.iter().map(|&crossing| of(&geometry, crossing));
            values.fold(f64::INFINITY, f64::min) - self.clearance
        };
        let room = |amplitude: f64| {
            let geometry = Geometry::new(self, amplitude);
            if geometry.steepest() > STEEPEST { Err(no_room(&geometry)) } else { Ok(geometry) }
        };
        // One that bends needs more than the second.
        let start = [0.125 * height, self.flat_amplitude()];
        let of_gap = root(start, accuracy, |amplitude| least(amplitude, upright_gap), &room)?;
        // The distance is hardly less than the upright gap, and takes much longer.
        let start = [of_gap, of_gap * (1.0 + STEP)];
        room(root(start, accuracy, |amplitude| least(amplitude, separation), &room)?)
    }
}

/// By this part the second trial of an amplitude is larger than the first.
const STEP: f64 = 1e-3;

/// Where a function that grows is 0, from two places of which the first is below; the search for one above ends where
/// there is no room.
fn root(
    [low, high]: [f64; 2],
    accuracy: f64,
    of: impl Fn(f64) -> f64,
    room: &impl Fn(f64) -> Result<Geometry, String>,
) -> Result<f64, String> {
    let mut low = (low, of(low));
    if low.1.abs() < accuracy {
        return Ok(low.0);
    }
    let mut high = (high, of(high));
    while high.1 < 0.0 {
        room(high.0)?;
        let step = 2.0 * (high.0 - low.0);
        low = high;
        high.0 += step;
        high.1 = of(high.0);
    }
    // Regula falsi with the step of Illinois.
    for _ in 0..MOST_TRIALS {
        let place = high.0 - high.1 * (high.0 - low.0) / (high.1 - low.1);
        let value = of(place);
        if value.abs() < accuracy {
            return Ok(place);
        }
        if value > 0.0 {
            high = (place, value);
            low.1 *= 0.5;
        } else {
            low = (place, value);
            high.1 *= 0.5;
        }
    }
    Err("no amplitude of the centre lines leaves the clearance; allowed: a larger one".to_string())
}

fn no_room(geometry: &Geometry) -> String {
    format!(
        "the yarns have no room to change sides: a centre line would have the slope {:.2}; allowed: up to {STEEPEST}, with \
         narrower or lower sections, a larger pitch, or more elements along",
        geometry.steepest()
    )
}

/// Crossings of the repeat of which no two look alike within half a pitch, seen from above or from below.
fn distinct_crossings(weave: &Weave) -> Vec<[i64; 2]> {
    let [warps, wefts] = weave.pattern.repeat().map(|count| count as i64);
    let over = |warp: i64, weft: i64| weave.pattern.warp_is_over(warp, weft);
    let mut seen = BTreeSet::new();
    let neighbours = |i: i64, j: i64| [[i, j - 1], [i, j + 1], [i - 1, j], [i + 1, j]];
    let kind = |i: i64, j: i64| neighbours(i, j).map(|[warp, weft]| over(warp, weft) == over(i, j));
    let all = (0..warps).flat_map(|i| (0..wefts).map(move |j| [i, j]));
    all.filter(|&[i, j]| seen.insert(kind(i, j))).collect()
}

/// The least distance between the faces of a warp and a weft yarn, numbered so; below 0 the least upright gap where one
/// goes into the other.
fn separation(geometry: &Geometry, [warp, weft]: [i64; 2]) -> f64 {
    let gap = upright_gap(geometry, [warp, weft]);
    if gap <= 0.0 {
        return gap;
    }
    let warp_is_over = geometry.weave.pattern.warp_is_over(warp, weft);
    let warp_faces = faces(geometry, Family::Warp, [warp, weft], if warp_is_over { -1.0 } else { 1.0 });
    let weft_faces = faces(geometry, Family::Weft, [weft, warp], if warp_is_over { 1.0 } else { -1.0 });
    let mut least = gap;
    for face in warp_faces.iter().flatten() {
        // The faces of a strip along the weft lie between the same two places on x.
        for strip in weft_faces.iter().filter(|strip| apart(face, &strip[0], 0) < gap) {
            for other in strip.iter().filter(|other| apart(face, other, 1) < gap) {
                least = distance::quads(face, other, least);
            }
        }
    }
    least
}

/// How far two faces are apart along an axis.
fn apart(a: &Quad, b: &Quad, axis: usize) -> f64 {
    let [one, other] = [a, b].map(|quad| distance::range(quad, axis));
    (one[0] - other[1]).max(other[0] - one[1])
}

/// The least upright gap. Faces are bilinear over x and y, so that it is found where the lines of their meshes cross.
fn upright_gap(geometry: &Geometry, [warp, weft]: [i64; 2]) -> f64 {
    let half_widths = Family::BOTH.map(|family| geometry.columns(family).half_width());
    let lines = |along: Family, yarn: i64, crossed: i64| -> Vec<[f64; 4]> {
        let across = geometry.columns(along.other());
        let stations = stations(geometry).map(|k| geometry.weave.step(along) * k as f64);
        let places = stations.filter(|x| x.abs() <= half_widths[along.other() as usize]);
        places
            .chain(across.places.iter().copied())
            .map(|x| {
                let [centre, upright] = interpolated(geometry, along, [yarn, crossed], x);
                [x, centre, upright, across.half_height(x)]
            })
            .collect()
    };
    let side = if geometry.weave.pattern.warp_is_over(warp, weft) { 1.0 } else { -1.0 };
    let weft_lines = lines(Family::Weft, weft, warp);
    let mut least = f64::INFINITY;
    for [_, warp_centre, warp_upright, weft_half] in lines(Family::Warp, warp, weft) {
        for [_, weft_centre, weft_upright, warp_half] in &weft_lines {
            let halves = warp_upright * warp_half + weft_upright * weft_half;
            least = least.min(side * (warp_centre - weft_centre) - halves);
        }
    }
    least
}

/// Stations beside a crossing to half way to the next.
fn stations(geometry: &Geometry) -> impl Iterator<Item = i64> {
    let half = geometry.weave.along as i64 / 2;
    -half..=half
}

/// The centre line's height and what an upright height is of one across the fibre, at a place beside a crossing.
fn interpolated(geometry: &Geometry, family: Family, [yarn, crossed]: [i64; 2], place: f64) -> [f64; 2] {
    let position = place / geometry.weave.step(family);
    let first = crossed * geometry.weave.along as i64;
    let [before, share] = [position.floor(), position - position.floor()];
    let at = |station: i64| [geometry.centre(family, yarn, station), geometry.upright(family, yarn, station)];
    let [from, to] = [at(first + before as i64), at(first + before as i64 + 1)];
    [0, 1].map(|i| (1.0 - share) * from[i] + share * to[i])
}

/// The upper (1) or lower (-1) faces of a yarn and its sides, around the crossing at the origin: strips along the yarn.
fn faces(geometry: &Geometry, family: Family, [yarn, crossed]: [i64; 2], side: f64) -> Vec<Vec<Quad>> {
    let columns = geometry.columns(family);
    let first = crossed * geometry.weave.along as i64;
    let point = |station: i64, line: usize, level: f64| {
        let half = columns.half_heights[line] * geometry.upright(family, yarn, first + station);
        let height = geometry.centre(family, yarn, first + station) + level * half;
        let [along, across] = [geometry.weave.step(family) * station as f64, columns.places[line]];
        if family == Family::Warp { [along, -across, height] } else { [across, along, height] }
    };
    let last = columns.places.len() - 1;
    let strip = |edges: [(usize, f64); 2]| -> Vec<Quad> {
        let at = |station: i64, (line, level): (usize, f64)| point(station, line, level);
        let lines: Vec<[Point; 2]> = stations(geometry).map(|station| edges.map(|edge| at(station, edge))).collect();
        lines.windows(2).map(|pair| [pair[0][0], pair[1][0], pair[1][1], pair[0][1]]).collect()
    };
    let sides = [0, last].map(|edge| strip([(edge, -1.0), (edge, 1.0)]));
    (0..last).map(|line| strip([(line, side), (line + 1, side)])).chain(sides).collect()
}
