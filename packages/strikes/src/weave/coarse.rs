//! Where a panel is meshed coarsely: beyond a distance from the centre, with sections of 2 × 1 or 2 × 2 elements, two
//! layers of which reach from a crossing to the next.
//!
//! A crossing is fine or coarse for both of its yarns. A yarn changes from one to the other half way between crossings,
//! where it touches nothing: there the nodes of the fine section lie on the coarse one, and are tied to its corners.
//! The coarse centre line is as long between these places as the fine one, so that the yarn has as much to straighten,
//! and its section has the same area.

use super::geometry::{Family, Geometry, Weave};
use super::mesh::lines;
use super::panel::{Panel, Place};
use toron_explicit_host::tie::Tie;

/// Columns of a coarse section.
pub const COLUMNS: usize = 2;
/// The most rows that it may have, and those where the file does not say: with one the bending of a yarn is left to
/// hourglass control.
pub const ROWS: usize = 2;

/// Where the mesh is coarse, and how many rows a section has there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coarse {
    pub radius: f64,
    pub rows: usize,
}

/// Sections of a yarn that are meshed alike, by their stations.
#[derive(Clone, Debug, PartialEq)]
pub struct Span {
    pub stations: Vec<i64>,
    pub is_coarse: bool,
    /// Columns and rows of elements of a whole section.
    pub section: [usize; 2],
}

impl Span {
    pub fn layers(&self) -> usize {
        self.stations.len() - 1
    }

    /// Its length in layers of a fine mesh.
    pub fn steps(&self) -> usize {
        (self.stations[self.layers()] - self.stations[0]) as usize
    }

    pub fn elements(&self, place: &Place) -> usize {
        let [columns, rows] = self.section;
        self.layers() * columns * rows / (1 + usize::from(place.halved))
    }
}

impl Panel {
    /// Why a part cannot be meshed coarsely.
    ///
    /// # Errors
    /// What is allowed.
    pub fn check_coarse_radius(&self, weave: &Weave, places: &[Place]) -> Result<(), String> {
        let Some(Coarse { radius, rows }) = self.coarse else { return Ok(()) };
        if weave.columns < COLUMNS {
            return Err(format!("coarse-radius with columns = {}; allowed: {COLUMNS} or more", weave.columns));
        }
        if weave.rows < rows {
            return Err(format!("coarse-rows is {rows} with rows = {}; allowed: up to as many", weave.rows));
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
        let section = [weave.columns, weave.rows];
        let fine = |[from, to]: [i64; 2]| Span { stations: (from..=to).collect(), is_coarse: false, section };
        let Some(Coarse { radius, rows }) = self.coarse else { return vec![fine(place.stations)] };
        let (along, half) = (weave.along as i64, weave.along as i64 / 2);
        let shift = self.shift(weave);
        let coarse = |[from, to]: [i64; 2]| {
            let inner = (from + 1..to).filter(|station| (station - shift).rem_euclid(half) == 0);
            let stations = [from].into_iter().chain(inner).chain([to]).collect();
            Span { stations, is_coarse: true, section: [COLUMNS, rows] }
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

/// The height of the coarse centre line at a station: the fine one's half way between crossings; at a crossing that
/// which makes it as long as the fine one from half a pitch before to half a pitch behind; in between, where a yarn may
/// end, on the line between these.
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

/// Ties the nodes of a fine section to the corners of the coarse one in the same place; each with its columns and rows
/// and the number of its first node.
pub fn ties(place: &Place, fine: ([usize; 2], usize), coarse: ([usize; 2], usize)) -> Vec<Tie> {
    let ([columns, rows], fine) = fine;
    let ([coarse_columns, coarse_rows], coarse) = coarse;
    let [of_fine, of_coarse] = [columns, coarse_columns].map(|columns| lines(place, columns));
    let mut ties = Vec::with_capacity(of_fine.len() * (rows + 1));
    for line in of_fine {
        let column = (coarse_columns * line / columns).min(of_coarse.end - 2);
        let across = (coarse_columns * line - column * columns) as f64 / columns as f64;
        for row in 0..=rows {
            let below = (coarse_rows * row / rows).min(coarse_rows - 1);
            let up = (coarse_rows * row - below * rows) as f64 / rows as f64;
            let first = coarse + (coarse_rows + 1) * (column - of_coarse.start) + below;
            ties.push(Tie {
                node: (fine + ties.len()) as u32,
                corners: [0, 1, coarse_rows + 1, coarse_rows + 2].map(|corner| (first + corner) as u32),
                shares: [(1.0 - across) * (1.0 - up), (1.0 - across) * up, across * (1.0 - up), across * up],
            });
        }
    }
    ties
}

#[cfg(test)]
mod tests {
    use crate::weave::figures::Figures;
    use crate::weave::model::{Model, Yarn};
    use crate::weave::reader::Scene;

    fn scene(keys: &str) -> Result<Scene, String> {
        let text = format!(
            "units = \"mm-g-ms\"\n[weave]\npreset = \"kevlar-s706\"\nalong = 8\n\
             [weave.panel]\nshape = \"circle\"\nradius = 6.0\n{keys}\n"
        );
        Scene::parse("panel.toml", &text).map_err(|error| error.to_string())
    }

    fn meshed(keys: &str) -> (Scene, Model) {
        let scene = scene(keys).expect("a scene");
        let model = scene.cloth.model();
        (scene, model)
    }

    /// The way from section to section along the middle of a yarn.
    fn length(model: &Model, yarn: &Yarn) -> f64 {
        let mut length = 0.0;
        for piece in &yarn.pieces {
            let first = yarn.nodes.start + piece.first_node;
            let middle = |section: usize| {
                let nodes = piece.grid.section(section).map(|node| nalgebra::Vector3::from(model.nodes[first + node]));
                nodes.sum::<nalgebra::Vector3<f64>>() / piece.grid.nodes_per_section() as f64
            };
            length += (0..piece.grid.layers).map(|layer| (middle(layer + 1) - middle(layer)).norm()).sum::<f64>();
        }
        length
    }

    #[test]
    fn a_yarn_is_as_long_and_as_heavy_as_a_fine_one() {
        for centre in ["crossing", "gap"] {
            let [(_, fine), (scene, coarse)] =
                ["", "coarse-radius = 3.0"].map(|keys| meshed(&format!("centre = \"{centre}\"\n{keys}")));
            assert_eq!(fine.yarns.len(), coarse.yarns.len());
            assert!(coarse.elements.len() < fine.elements.len() / 2, "{}", coarse.elements.len());
            for (one, other) in fine.yarns.iter().zip(&coarse.yarns) {
                // A yarn may end between two stations of the coarse mesh.
                let lengths = [length(&fine, one), length(&coarse, other)];
                assert!((lengths[1] / lengths[0] - 1.0).abs() < 5e-3, "{lengths:?} {:?}", other.pieces);
            }
            let ply = &scene.cloth.plies()[0].woven.geometry;
            let [one, other] = [&fine, &coarse].map(|model| Figures::of(model, 0, ply).volume_by_area());
            assert!((other / one - 1.0).abs() < 5e-3, "{one} {other}");
        }
    }

    #[test]
    fn a_crossing_is_fine_or_coarse_for_both_yarns_and_the_joint_lies_half_way() {
        let (_, model) = meshed("coarse-radius = 3.0");
        // Half the length of the elements along the yarn whose middle is nearest to the crossing.
        let step = |yarn: &Yarn, place: [f64; 2]| {
            let axis = yarn.family as usize;
            let layer = model.elements[yarn.elements.clone()].iter().find_map(|element| {
                let [from, to] = [element[0], element[1]].map(|node| model.nodes[node as usize][axis]);
                (from <= place[axis] + 1e-9 && place[axis] + 1e-9 < to).then_some(to - from)
            });
            layer.unwrap_or_default()
        };
        for crossing in &model.crossings {
            let steps = [crossing.warp, crossing.weft].map(|yarn| step(&model.yarns[yarn], crossing.place));
            let is_fine = crossing.place[0].hypot(crossing.place[1]) <= 3.0;
            if steps.iter().all(|step| *step > 0.0) && crossing.place[0].hypot(crossing.place[1]) < 5.0 {
                assert_eq!(steps.map(|step| step < 0.1), [is_fine; 2], "{crossing:?} {steps:?}");
            }
        }
        let joined = model.yarns.iter().filter(|yarn| yarn.pieces.len() == 3).count();
        assert!(joined >= 10, "{joined}");
        for yarn in &model.yarns {
            for tie in &yarn.ties {
                let place = |node: u32| model.nodes[yarn.nodes.start + node as usize];
                let mut on_face = [0.0; 3];
                for (corner, share) in tie.parts() {
                    (0..3).for_each(|i| on_face[i] += share * place(corner as u32)[i]);
                }
                assert_eq!(place(tie.node), on_face);
                assert!((tie.shares.iter().sum::<f64>() - 1.0).abs() < 1e-15 && tie.shares.iter().all(|s| *s >= 0.0));
            }
        }
    }

    #[test]
    fn a_quarter_is_that_of_the_whole() {
        let [(_, whole), (scene, quarter)] =
            ["whole", "quarter"].map(|part| meshed(&format!("part = \"{part}\"\ncoarse-radius = 3.0")));
        let ply = &scene.cloth.plies()[0].woven.geometry;
        let [one, other] = [&whole, &quarter].map(|model| Figures::of(model, 0, ply).volume_by_area());
        assert!((other / one - 1.0).abs() < 2e-2, "{one} {other}");
        let on_plane = |nodes: &[u32], axis: usize| nodes.iter().all(|&node| quarter.nodes[node as usize][axis] == 0.0);
        assert!(on_plane(&quarter.on_x, 0) && on_plane(&quarter.on_y, 1));
    }

    #[test]
    fn a_radius_that_leaves_one_mesh_is_refused() {
        for (keys, message) in [
            ("coarse-radius = 7.0", "coarse-radius is 7, so that all elements are fine; allowed"),
            ("coarse-radius = 0.3\ncentre = \"gap\"", "coarse-radius is 0.3, so that all elements are coarse; allowed"),
            ("coarse-radius = -1.0", "coarse-radius is -1.0; allowed"),
            ("coarse-radius = 3.0\ncoarse-rows = 3", "coarse-rows is 3; allowed: a whole number from 1 to 2"),
            ("coarse-rows = 1", "coarse-rows without coarse-radius"),
        ] {
            let error = scene(keys).map(|_| ()).expect_err(message);
            assert!(error.contains(message), "{error}");
        }
    }
}
