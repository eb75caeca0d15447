//! From a weave and a panel to a model.

use std::ops::Range;

use super::coarse::{self, CentreLine, Span};
use super::geometry::{Family, Geometry, Weave};
use super::model::{Crossing, Face, Grid, LEFT, LOWER, Model, Piece, RIGHT, Side, UPPER, Yarn};
use super::panel::{Panel, Part, Place};
use super::section::Columns;
use toron_explicit_host::tie::Tie;

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
        let spans = panel.spans(weave, place);
        let shift = panel.shift(weave);
        let line = CentreLine::new(geometry, place.family, place.number, &spans, shift);
        let starts = [self.nodes.len(), self.elements.len(), self.faces.len()];
        let mut yarn = Yarn {
            ply: 0,
            family: place.family,
            number: place.number,
            coordinate: place.coordinate,
            halved: place.halved,
            nodes: starts[0]..starts[0],
            elements: starts[1]..starts[1],
            faces: starts[2]..starts[2],
            ends: [Vec::new(), Vec::new()],
            pieces: Vec::new(),
            ties: Vec::new(),
        };
        let mut section = 0;
        for span in &spans {
            let [columns, rows] = span.section;
            let columns = lines(place, columns).len() - 1;
            let grid = Grid { layers: span.layers(), columns, rows };
            let piece = Piece {
                grid,
                first_node: self.nodes.len() - starts[0],
                first_element: self.elements.len() - starts[1],
                steps: span.steps(),
            };
            self.add_piece(geometry, place, span, (&line, section, shift), piece);
            yarn.pieces.push(piece);
            section += grid.layers;
        }
        for (before, pair) in spans.windows(2).enumerate() {
            let [from, to] = [yarn.pieces[before], yarn.pieces[before + 1]];
            let ends = [from.first_node + from.grid.section(from.grid.layers).start, to.first_node];
            let [before, behind] = [(pair[0].section, ends[0]), (pair[1].section, ends[1])];
            let [fine, coarse] = if pair[0].is_coarse { [behind, before] } else { [before, behind] };
            yarn.ties.extend(coarse::ties(place, fine, coarse));
        }
        self.settle(&yarn.ties, starts[0]);
        (yarn.nodes.end, yarn.elements.end, yarn.faces.end) = (self.nodes.len(), self.elements.len(), self.faces.len());
        let of_end = |piece: Option<&Piece>, section: fn(&Grid) -> usize| -> Vec<u32> {
            let nodes = piece.map(|piece| {
                let first = starts[0] + piece.first_node;
                piece.grid.section(section(&piece.grid)).map(move |node| (first + node) as u32)
            });
            nodes.into_iter().flatten().collect()
        };
        yarn.ends = [of_end(yarn.pieces.first(), |_| 0), of_end(yarn.pieces.last(), |grid| grid.layers)];
        self.add_to_sets(&yarn, panel.part);
        self.yarns.push(yarn);
    }

    /// Adds the sections and elements of a span, which begins with this section of the line.
    fn add_piece(
        &mut self,
        geometry: &Geometry,
        place: &Place,
        span: &Span,
        (line, section, shift): (&CentreLine, usize, i64),
        Piece { grid, .. }: Piece,
    ) {
        let (weave, family) = (&geometry.weave, place.family);
        let [of_section, rows] = span.section;
        let (lines, first_node) = (lines(place, of_section), self.nodes.len());
        let coarse = span.is_coarse.then(|| Columns::new(weave.thread(family), of_section));
        let columns = coarse.as_ref().unwrap_or(geometry.columns(family));
        for (number, &station) in span.stations.iter().enumerate() {
            let upright = if span.is_coarse {
                line.upright(section + number)
            } else {
                geometry.upright(family, place.number, station - shift)
            };
            let centre = line.height(section + number);
            let along = weave.step(family) * station as f64;
            self.add_section(place, (columns, lines.clone(), rows), [along, centre, upright]);
        }
        for layer in 0..grid.layers {
            let direction = direction(family, line.slope(section + layer));
            for column in 0..grid.columns {
                for row in 0..rows {
                    let corners = grid.corners([layer, column, row]).map(|node| (first_node + node) as u32);
                    let left = lines.start + column == 0;
                    let right = lines.start + column + 1 == of_section;
                    self.add_faces(corners, [row + 1 == rows, row == 0, left, right]);
                    self.elements.push(corners);
                    self.fibre.push(direction);
                }
            }
        }
    }

    /// Puts the nodes that are tied where their corners have them; a yarn's nodes begin with this one.
    fn settle(&mut self, ties: &[Tie], first: usize) {
        for tie in ties {
            let mut place = [0.0; 3];
            for (corner, share) in tie.parts() {
                for (x, of_corner) in place.iter_mut().zip(self.nodes[first + corner]) {
                    *x += share * of_corner;
                }
            }
            self.nodes[first + tie.node as usize] = place;
        }
    }

    /// The faces of the next element that are on the yarn's surface: upper, lower, left, right.
    fn add_faces(&mut self, corners: [u32; 8], outer: [bool; 4]) {
        let element = self.elements.len() as u32;
        let sides = [(UPPER, Side::Upper), (LOWER, Side::Lower), (LEFT, Side::Left), (RIGHT, Side::Right)];
        for ((face, side), _) in sides.into_iter().zip(outer).filter(|(_, outer)| *outer) {
            self.faces.push(Face { nodes: face.map(|corner| corners[corner]), element, side });
        }
    }

    /// Adds the nodes of a section, line by line, each from below, at a place along the yarn and a height; `upright` is
    /// what an upright height is of one across the fibre.
    fn add_section(
        &mut self,
        place: &Place,
        (columns, lines, rows): (&Columns, Range<usize>, usize),
        [along, centre, upright]: [f64; 3],
    ) {
        for line in lines {
            for row in 0..=rows {
                let level = 2.0 * row as f64 / rows as f64 - 1.0;
                let height = centre + level * upright * columns.half_heights[line];
                self.nodes.push(match place.family {
                    Family::Warp => [along, place.coordinate - columns.places[line], height],
                    Family::Weft => [place.coordinate + columns.places[line], along, height],
                });
            }
        }
    }

    /// A yarn ends at the edge, or on a plane of symmetry that it crosses; one that lies on such a plane has its cut
    /// there.
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

/// The upright lines of a section that are meshed. The half on the side where x and y are positive is the first of a
/// warp yarn, whose axis across is -y, and the second of a weft yarn.
pub fn lines(place: &Place, columns: usize) -> Range<usize> {
    match (place.halved, place.family) {
        (false, _) => 0..columns + 1,
        (true, Family::Warp) => 0..columns / 2 + 1,
        (true, Family::Weft) => columns / 2..columns + 1,
    }
}

/// A unit vector along a centre line of this slope.
fn direction(family: Family, slope: f64) -> [f64; 3] {
    let [along, up] = [1.0 / slope.hypot(1.0), slope / slope.hypot(1.0)];
    if family == Family::Warp { [along, 0.0, up] } else { [0.0, along, up] }
}
