//! From a weave and a panel to a model.

use std::ops::Range;

use super::geometry::{Family, Geometry, Weave};
use super::model::{Crossing, Face, Grid, LEFT, LOWER, Model, RIGHT, Side, UPPER, Yarn};
use super::panel::{Centre, Panel, Part, Place};

impl Model {
    /// Meshes a panel of a weave.
    ///
    /// # Errors
    /// What of the weave or of the panel cannot be meshed, and what is allowed.
    pub fn new(weave: &Weave, panel: &Panel) -> Result<Model, String> {
        Ok(Model::of(&weave.solve()?, panel, &panel.places(weave)?))
    }

    /// Meshes these yarns of a weave whose amplitude is known.
    pub fn of(geometry: &Geometry, panel: &Panel, places: &[Place]) -> Model {
        let mut model = Model::default();
        for place in places {
            model.add(geometry, panel, place);
        }
        model.find_crossings(geometry, places);
        model
    }

    fn add(&mut self, geometry: &Geometry, panel: &Panel, place: &Place) {
        let weave = &geometry.weave;
        let (family, rows) = (place.family, weave.rows);
        let lines = lines(place, weave.columns);
        let columns = lines.len() - 1;
        let [first, last] = place.stations;
        let starts = [self.nodes.len(), self.elements.len(), self.faces.len()];
        for station in first..=last {
            self.add_section(geometry, panel, place, station, lines.clone());
        }
        let layers = place.layers();
        let grid = Grid { layers, columns, rows };
        for layer in 0..layers {
            let direction =
                direction(geometry, family, place.number, pattern_station(weave, panel, first + layer as i64));
            for column in 0..columns {
                for row in 0..rows {
                    let corners = grid.corners([layer, column, row]).map(|node| (starts[0] + node) as u32);
                    let left = lines.start + column == 0;
                    let right = lines.start + column + 1 == weave.columns;
                    self.add_faces(corners, [row + 1 == rows, row == 0, left, right]);
                    self.elements.push(corners);
                    self.fibre.push(direction);
                }
            }
        }
        let yarn = Yarn {
            ply: 0,
            family,
            number: place.number,
            coordinate: place.coordinate,
            halved: place.halved,
            nodes: starts[0]..self.nodes.len(),
            elements: starts[1]..self.elements.len(),
            faces: starts[2]..self.faces.len(),
            ends: [0, layers].map(|number| grid.section(number).map(|node| (starts[0] + node) as u32).collect()),
            grid: Some(grid),
        };
        self.add_to_sets(&yarn, panel.part);
        self.yarns.push(yarn);
    }

    /// The faces of the next element that are on the yarn's surface: upper, lower, left, right.
    fn add_faces(&mut self, corners: [u32; 8], outer: [bool; 4]) {
        let element = self.elements.len() as u32;
        let sides = [(UPPER, Side::Upper), (LOWER, Side::Lower), (LEFT, Side::Left), (RIGHT, Side::Right)];
        for ((face, side), _) in sides.into_iter().zip(outer).filter(|(_, outer)| *outer) {
            self.faces.push(Face { nodes: face.map(|corner| corners[corner]), element, side });
        }
    }

    fn add_section(&mut self, geometry: &Geometry, panel: &Panel, place: &Place, station: i64, lines: Range<usize>) {
        let (weave, family) = (&geometry.weave, place.family);
        let along = weave.step(family) * station as f64;
        let of_pattern = pattern_station(weave, panel, station);
        let centre = geometry.centre(family, place.number, of_pattern);
        let upright = geometry.upright(family, place.number, of_pattern);
        let columns = geometry.columns(family);
        for line in lines {
            for row in 0..=weave.rows {
                let level = 2.0 * row as f64 / weave.rows as f64 - 1.0;
                let height = centre + level * upright * columns.half_heights[line];
                self.nodes.push(match family {
                    Family::Warp => [along, place.coordinate - columns.places[line], height],
                    Family::Weft => [place.coordinate + columns.places[line], along, height],
                });
            }
        }
    }

    /// A yarn ends at the edge, or on a plane of symmetry that it crosses; one that lies on such a plane has its cut there.
    fn add_to_sets(&mut self, yarn: &Yarn, part: Part) {
        let [start, end] = &yarn.ends;
        self.rim.extend(end);
        if part == Part::Whole {
            self.rim.extend(start);
            return;
        }
        let on = |nodes: &[[f64; 3]], axis: usize| {
            yarn.nodes
                .clone()
                .map(|node| node as u32)
                .filter(|&node| nodes[node as usize][axis] == 0.0)
                .collect::<Vec<_>>()
        };
        self.on_x.extend(on(&self.nodes, 0));
        self.on_y.extend(on(&self.nodes, 1));
    }

    fn find_crossings(&mut self, geometry: &Geometry, places: &[Place]) {
        let weave = &geometry.weave;
        let reaches = |place: &Place, coordinate: f64| {
            let [first, last] = place.stations.map(|station| weave.step(place.family) * station as f64);
            (first..=last).contains(&coordinate)
        };
        let warps = places.iter().take_while(|place| place.family == Family::Warp).count();
        for (warp, i) in places[..warps].iter().enumerate() {
            for (weft, j) in places[warps..].iter().enumerate() {
                if reaches(j, i.coordinate) && reaches(i, j.coordinate) {
                    self.crossings.push(Crossing {
                        warp,
                        weft: warps + weft,
                        place: [j.coordinate, i.coordinate],
                        warp_is_over: weave.pattern.warp_is_over(i.number, j.number),
                    });
                }
            }
        }
    }
}

/// The upright lines of a section that are meshed. The half on the side where x and y are positive is the first of a warp
/// yarn, whose axis across is -y, and the second of a weft yarn.
fn lines(place: &Place, columns: usize) -> Range<usize> {
    match (place.halved, place.family) {
        (false, _) => 0..columns + 1,
        (true, Family::Warp) => 0..columns / 2 + 1,
        (true, Family::Weft) => columns / 2..columns + 1,
    }
}

/// A station counted from the first crossing instead of the origin.
fn pattern_station(weave: &Weave, panel: &Panel, station: i64) -> i64 {
    if panel.centre == Centre::Gap { station - weave.along as i64 / 2 } else { station }
}

/// The direction of the centre line from a station to the next.
fn direction(geometry: &Geometry, family: Family, yarn: i64, station: i64) -> [f64; 3] {
    let slope = geometry.slope(family, yarn, station);
    let [along, up] = [1.0 / slope.hypot(1.0), slope / slope.hypot(1.0)];
    if family == Family::Warp { [along, 0.0, up] } else { [0.0, along, up] }
}
