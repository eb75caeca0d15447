//! A panel's outline, what of it is meshed, and where its yarns lie and end.

use serde::Deserialize;

use super::coarse::Coarse;
use super::geometry::{Family, Weave};

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outline {
    /// Half of its sizes along x and y.
    Rectangle([f64; 2]),
    /// Its radius.
    Circle(f64),
}

#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Part {
    #[default]
    Whole,
    /// x ≥ 0 and y ≥ 0, where the planes x = 0 and y = 0 are planes of symmetry.
    Quarter,
}

/// What lies at the origin.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Centre {
    /// Of the first warp and the first weft yarn of the pattern.
    #[default]
    Crossing,
    /// Before the two.
    Gap,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Panel {
    pub outline: Outline,
    pub part: Part,
    pub centre: Centre,
    /// By which the weave, not the outline, is turned about z: from x to y.
    pub turn: Turn,
    /// Where the mesh is coarse, beyond a distance from the centre; nowhere without.
    pub coarse: Option<Coarse>,
}

/// A turn about z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    cos: f64,
    sin: f64,
}

impl Turn {
    pub const NONE: Turn = Turn { cos: 1.0, sin: 0.0 };

    /// By this angle in degrees; exact for quarters of a turn.
    pub fn degrees(angle: f64) -> Turn {
        let [cos, sin] = match angle.rem_euclid(360.0) {
            0.0 => [1.0, 0.0],
            90.0 => [0.0, 1.0],
            180.0 => [-1.0, 0.0],
            270.0 => [0.0, -1.0],
            angle => [angle.to_radians().cos(), angle.to_radians().sin()],
        };
        Turn { cos, sin }
    }

    pub fn rotate(self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.cos * x - self.sin * y, self.sin * x + self.cos * y]
    }

    /// The turn back.
    pub fn back(self) -> Turn {
        Turn { sin: -self.sin, ..self }
    }
}

/// A yarn of a panel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    pub family: Family,
    /// Its number in the pattern; 0 lies at the origin, or next to it.
    pub number: i64,
    /// y of a warp yarn, x of a weft yarn.
    pub coordinate: f64,
    /// Where it begins and ends, in layers from the origin.
    pub stations: [i64; 2],
    /// Cut along its axis by a plane of symmetry.
    pub halved: bool,
}

impl Place {
    pub fn layers(&self) -> usize {
        (self.stations[1] - self.stations[0]) as usize
    }
}

/// Lengths closer than this part of an element are the same.
const ROUNDING: f64 = 1e-9;
/// An element takes some 700 bytes in a simulation: more do not fit most memories.
pub const MOST_ELEMENTS: f64 = 1e7;

impl Panel {
    /// The yarns, the warp first, by their coordinates.
    ///
    /// # Errors
    /// What is wrong with the panel, and what is allowed.
    pub fn places(&self, weave: &Weave) -> Result<Vec<Place>, String> {
        self.check_mirror_planes(weave)?;
        let bounds = self.bounds();
        let area = 4.0 * bounds[0] * bounds[1];
        let layers = Family::BOTH.map(|family| area / (weave.thread(family).pitch * weave.step(family)));
        let elements = (layers[0] + layers[1]) * (weave.columns * weave.rows) as f64;
        if !elements.is_finite() || elements > 4.0 * MOST_ELEMENTS {
            return Err(format!("the panel has about {elements:.1e} elements; allowed: up to {MOST_ELEMENTS:.0e}"));
        }
        let places: Vec<Place> =
            Family::BOTH.into_iter().flat_map(|family| self.family(weave, family, bounds)).collect();
        if Family::BOTH.iter().any(|family| !places.iter().any(|place| place.family == *family)) {
            return Err("the panel is so small that it has no yarns of one family; allowed: some pitches".to_string());
        }
        let sections: usize = places.iter().map(|place| place.layers() / (1 + usize::from(place.halved))).sum();
        if (sections * weave.columns * weave.rows) as f64 > MOST_ELEMENTS {
            return Err(format!("the panel has more than {MOST_ELEMENTS:.0e} elements; allowed: up to so many"));
        }
        Ok(places)
    }

    /// Where the axis of a yarn lies across it.
    pub fn coordinate(&self, pitch: f64, number: i64) -> f64 {
        pitch * (number as f64 + if self.centre == Centre::Gap { 0.5 } else { 0.0 })
    }

    /// The number of a station less that of the same one in the pattern, counted from the first crossing instead of the
    /// origin.
    pub fn shift(&self, weave: &Weave) -> i64 {
        if self.centre == Centre::Gap { weave.along as i64 / 2 } else { 0 }
    }

    /// How far the outline goes along the weave's x and y.
    fn bounds(&self) -> [f64; 2] {
        match self.outline {
            Outline::Circle(radius) => [radius; 2],
            Outline::Rectangle([x, y]) => {
                let Turn { cos, sin } = self.turn;
                [x * cos.abs() + y * sin.abs(), x * sin.abs() + y * cos.abs()]
            }
        }
    }

    /// From where to where the outline has a line along a family's yarns, at this coordinate across them.
    pub fn interval(&self, family: Family, coordinate: f64) -> [f64; 2] {
        match self.outline {
            Outline::Circle(radius) => {
                let half = (radius * radius - coordinate * coordinate).max(0.0).sqrt();
                [-half, half]
            }
            Outline::Rectangle(half) => {
                let ahead = family.placed(1.0, 0.0);
                let beside = family.placed(0.0, coordinate);
                let [ahead, beside] = [ahead, beside].map(|place| self.turn.rotate(place));
                let mut interval = [f64::NEG_INFINITY, f64::INFINITY];
                for axis in 0..2 {
                    if ahead[axis] == 0.0 {
                        continue;
                    }
                    let ends = [-half[axis], half[axis]].map(|end| (end - beside[axis]) / ahead[axis]);
                    interval = [interval[0].max(ends[0].min(ends[1])), interval[1].min(ends[0].max(ends[1]))];
                }
                interval
            }
        }
    }

    /// Refuses a quarter of a weave that is not its own mirror image.
    ///
    /// # Errors
    /// What is allowed.
    pub fn check_mirror_planes(&self, weave: &Weave) -> Result<(), String> {
        if self.part == Part::Whole {
            return Ok(());
        }
        let planes = |centre: Centre| weave.pattern.mirror_planes(centre == Centre::Gap);
        let own = planes(self.centre);
        if own != [true; 2] {
            let plane = if own[0] { "y = 0" } else { "x = 0" };
            let whole = "part = \"whole\"";
            let allowed = match self.centre {
                Centre::Crossing if planes(Centre::Gap) == [true; 2] => format!("{whole}, or centre = \"gap\""),
                Centre::Gap if planes(Centre::Crossing) == [true; 2] => format!("{whole}, or centre = \"crossing\""),
                _ => whole.to_string(),
            };
            let through = if self.centre == Centre::Gap { "a gap" } else { "the axes of the first yarns" };
            return Err(format!(
                "part is quarter, but the plane {plane}, through {through}, is no mirror plane of the pattern; allowed: {allowed}"
            ));
        }
        if self.centre == Centre::Crossing && !weave.columns.is_multiple_of(2) {
            let message = "part is quarter, whose planes halve the yarns on them, but columns is";
            return Err(format!("{message} {}; allowed: an even number", weave.columns));
        }
        Ok(())
    }

    fn family(&self, weave: &Weave, family: Family, bounds: [f64; 2]) -> Vec<Place> {
        let (pitch, step) = (weave.thread(family).pitch, weave.step(family));
        let bound_across = if family == Family::Warp { bounds[1] } else { bounds[0] };
        let shift = self.coordinate(1.0, 0);
        let last = (bound_across / pitch - shift + ROUNDING).floor() as i64;
        // The mirror image of a number: that of 0 in a gap is -1.
        let first = match (self.part, self.centre) {
            (Part::Quarter, _) => 0,
            (Part::Whole, Centre::Crossing) => -last,
            (Part::Whole, Centre::Gap) => -last - 1,
        };
        let place = |number: i64| {
            let coordinate = self.coordinate(pitch, number);
            // The middle of the layer at an end is half an element before it.
            let layers = |length: f64| (length / step + 0.5 + ROUNDING).floor() as i64;
            let [start, end] = self.interval(family, coordinate);
            let first = if self.part == Part::Whole { -layers(-start) } else { 0 };
            let halved = self.part == Part::Quarter && self.centre == Centre::Crossing && number == 0;
            Place { family, number, coordinate, stations: [first, layers(end)], halved }
        };
        (first..=last).map(place).filter(|place| place.stations[1] > place.stations[0]).collect()
    }
}
