//! Where a panel is meshed coarsely: beyond a distance from the centre, with sections of 2 × 1 elements, two of which reach from a
//! crossing to the next.
//!
//! A crossing is fine or coarse for both of its yarns. A yarn changes from one to the other half way between crossings, where it
//! touches nothing: there the nodes of the fine section lie on the coarse one, and are tied to its corners. The coarse centre line
//! is as long between these places as the fine one, so that the yarn has as much to straighten, and its section has the same area.

use super::geometry::{Family, Geometry, Weave};
use super::mesh::lines;
use super::panel::{Panel, Place};
use crate::explicit::tie::Tie;

/// Columns of a coarse section, which is one row high.
pub const COLUMNS: usize = 2;

/// Sections of a yarn that are meshed alike, by their stations.
#[derive(Clone, Debug, PartialEq)]
pub struct Span {
    pub stations: Vec<i64>,
    pub is_coarse: bool,
}

impl Span {
    pub fn layers(&self) -> usize {
        self.stations.len() - 1
    }

    /// Its length in layers of a fine mesh.
    pub fn steps(&self) -> usize {
        (self.stations[self.layers()] - self.stations[0]) as usize
    }

    /// Columns and rows of elements of a whole section.
    pub fn section(&self, weave: &Weave) -> [usize; 2] {
        if self.is_coarse { [COLUMNS, 1] } else { [weave.columns, weave.rows] }
    }

    pub fn elements(&self, weave: &Weave, place: &Place) -> usize {
        let [columns, rows] = self.section(weave);
        self.layers() * columns * rows / (1 + usize::from(place.halved))
    }
}

impl Panel {
    /// Says what speaks against meshing a part coarsely.
    ///
    /// # Errors
    /// What is allowed.
    pub fn check_coarse_radius(&self, weave: &Weave, places: &[Place]) -> Result<(), String> {
        let Some(radius) = self.coarse_radius else { return Ok(()) };
        if weave.columns < COLUMNS {
            return Err(format!("coarse-radius with columns = {}; allowed: {COLUMNS} or more", weave.columns));
        }
        let spans = || places.iter().flat_map(|place| self.spans(weave, place));
        let all = [spans().all(|span| span.is_coarse), !spans().any(|span| span.is_coarse)];
        if all == [false; 2] {
            return Ok(());
        }
        let kind = if all[0] { "coarse" } else { "fine" };
        let allowed = "one with crossings of yarns on both of its sides, or none";
        Err(format!("coarse-radius is {radius}, so that all elements are {kind}; allowed: {allowed}"))
    }

    /// The spans of a yarn, one after another: one, or up to three where a part of the panel is coarse.
    pub fn spans(&self, weave: &Weave, place: &Place) -> Vec<Span> {
        let [first, last] = place.stations;
        let fine = |[from, to]: [i64; 2]| Span { stations: (from..=to).collect(), is_coarse: false };
        let Some(radius) = self.coarse_radius else { return vec![fine(place.stations)] };
        let (along, half) = (weave.along as i64, weave.along as i64 / 2);
        let shift = self.shift(weave);
        let coarse = |[from, to]: [i64; 2]| {
            let inner = (from + 1..to).filter(|station| (station - shift).rem_euclid(half) == 0);
            Span { stations: [from].into_iter().chain(inner).chain([to]).collect(), is_coarse: true }
        };
        let pitch = weave.thread(place.family.other()).pitch;
        let is_fine = |&crossed: &i64| self.coordinate(pitch, crossed).hypot(place.coordinate) <= radius;
        let crossed = [first, last].map(|station| (station - shift).div_euclid(along));
        let mut crossings = (crossed[0]..=crossed[1] + 1).filter(is_fine);
        let Some(nearest) = crossings.next() else { return vec![coarse(place.stations)] };
        let farthest = crossings.next_back().unwrap_or(nearest);
        let [from, to] = [first.max(nearest * along + shift - half), last.min(farthest * along + shift + half)];
        if from >= to {
            return vec![coarse(place.stations)];
        }
        let before = (first < from).then(|| coarse([first, from]));
        let after = (to < last).then(|| coarse([to, last]));
        before.into_iter().chain([fine([from, to])]).chain(after).collect()
    }
}

/// The sections of a yarn: their stations, counted as in its pattern, and the height of the meshed centre line there.
pub struct CentreLine {
    step: f64,
    points: Vec<(i64, f64)>,
}

impl CentreLine {
    /// Of the yarn of this number, whose stations are `shift` less in the pattern.
    pub fn new(geometry: &Geometry, family: Family, number: i64, spans: &[Span], shift: i64) -> CentreLine {
        let mut points: Vec<(i64, f64)> = Vec::new();
        for span in spans {
            let stations = span.stations.iter().map(|station| station - shift);
            // The section between two spans belongs to both, at the same height.
            for station in stations.skip(usize::from(!points.is_empty())) {
                let height = if span.is_coarse {
                    coarse_centre(geometry, family, number, station)
                } else {
                    geometry.centre(family, number, station)
                };
                points.push((station, height));
            }
        }
        CentreLine { step: geometry.weave.step(family), points }
    }

    /// From a section to the next.
    pub fn slope(&self, section: usize) -> f64 {
        let [(from, low), (to, high)] = [self.points[section], self.points[section + 1]];
        (high - low) / (self.step * (to - from) as f64)
    }

    pub fn height(&self, section: usize) -> f64 {
        self.points[section].1
    }

    /// What an upright height is of one across the fibre: the mean of the elements before and behind.
    pub fn upright(&self, section: usize) -> f64 {
        let last = self.points.len() - 1;
        let beside = [section.saturating_sub(1), section.min(last - 1)];
        0.5 * beside.map(|section| self.slope(section).hypot(1.0)).iter().sum::<f64>()
    }
}

/// The height of the coarse centre line at a station: the fine one's half way between crossings; at a crossing that which makes it as
/// long as the fine one from half a pitch before to half a pitch behind; in between, where a yarn may end, on the line between these.
fn coarse_centre(geometry: &Geometry, family: Family, number: i64, station: i64) -> f64 {
    let (along, half) = (geometry.weave.along as i64, geometry.weave.along as i64 / 2);
    let [before, beyond] = [station.div_euclid(half) * half, station.rem_euclid(half)];
    if beyond > 0 {
        let [from, to] = [before, before + half].map(|station| coarse_centre(geometry, family, number, station));
        return from + (to - from) * beyond as f64 / half as f64;
    }
    let fine = |station: i64| geometry.centre(family, number, station);
    if station.rem_euclid(along) != 0 {
        return fine(station);
    }
    let [from, to] = [fine(station - half), fine(station + half)];
    let step = geometry.weave.step(family);
    let stretches = (station - half..station + half).map(|station| geometry.stretch(family, number, station));
    let length = step * stretches.sum::<f64>();
    // On the ellipse around both ends, from its centre upwards or downwards.
    let (pitch, rise) = (step * along as f64, to - from);
    let chord = pitch * pitch + rise * rise;
    let (major, minor) = (0.25 * length * length, 0.25 * (length * length - chord));
    let middle = 0.5 * (from + to);
    if minor <= 0.0 {
        return middle;
    }
    let square = chord / (rise * rise / major + pitch * pitch / minor);
    middle + (fine(station) - middle).signum() * square.sqrt()
}

/// Ties the nodes of a fine section, whose first one is `fine`, to the corners of the coarse one in the same place.
pub fn ties(weave: &Weave, place: &Place, [fine, coarse]: [usize; 2]) -> Vec<Tie> {
    let (columns, rows) = (weave.columns, weave.rows);
    let [of_fine, of_coarse] = [columns, COLUMNS].map(|columns| lines(place, columns));
    let mut ties = Vec::with_capacity(of_fine.len() * (rows + 1));
    for line in of_fine {
        let column = (COLUMNS * line / columns).min(of_coarse.end - 2);
        let across = (COLUMNS * line - column * columns) as f64 / columns as f64;
        let first = coarse + 2 * (column - of_coarse.start);
        for row in 0..=rows {
            let up = row as f64 / rows as f64;
            ties.push(Tie {
                node: (fine + ties.len()) as u32,
                corners: [0, 1, 2, 3].map(|corner| (first + corner) as u32),
                shares: [(1.0 - across) * (1.0 - up), (1.0 - across) * up, across * (1.0 - up), across * up],
            });
        }
    }
    ties
}
