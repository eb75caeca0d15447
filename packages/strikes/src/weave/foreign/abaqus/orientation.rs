//! The first material direction of elements, by `*ORIENTATION` and `*DISTRIBUTION` of Abaqus.

use std::collections::HashMap;

use nalgebra::{Rotation3, Unit, Vector3};

use super::scope::Member;
use toron_shared::error::Error;
use toron_shared::keyword_file::abaqus::{Keyword, label};
use toron_shared::keyword_file::line::{Line, Place};

/// Points a and b of a system whose origin is c, from there; b is not always given.
pub type Points = ([f64; 3], Option<[f64; 3]>);

/// Values by elements.
#[derive(Clone)]
pub struct Distribution {
    pub place: Place,
    pub table: Option<String>,
    default: Option<(Vec<f64>, Place)>,
    entries: Vec<(Member, Vec<f64>, Place)>,
}

impl Distribution {
    pub fn new(place: Place, table: Option<String>) -> Distribution {
        Distribution { place, table, default: None, entries: Vec::new() }
    }

    /// # Errors
    /// What on the line is no number.
    pub fn add(&mut self, line: &Line<'_>, fields: &[&str]) -> Result<(), Error> {
        let [name, values @ ..] = fields else { return Ok(()) };
        let values = values.iter().map(|field| line.real("a direction", field)).collect::<Result<Vec<f64>, _>>()?;
        if name.is_empty() {
            self.default = Some((values, line.place()));
        } else {
            self.entries.push((Member::of(name), values, line.place()));
        }
        Ok(())
    }

    /// The vectors of all elements that have some; `members` are those of a set.
    ///
    /// # Errors
    /// An entry is none of vectors, or of an element that the file does not have.
    pub fn by_element<T>(
        &self,
        members: &impl Fn(&str, &Place) -> Result<Vec<u64>, Error>,
        elements: &HashMap<u64, T>,
    ) -> Result<HashMap<u64, Points>, Error> {
        let mut all = HashMap::new();
        if let Some((values, place)) = &self.default {
            let points = points(values, place)?;
            all.extend(elements.keys().map(|&number| (number, points)));
        }
        for (member, values, place) in &self.entries {
            let points = points(values, place)?;
            let (found, name) = match member {
                Member::Set(name) => (members(name, place)?, format!("set {name}")),
                Member::Element(number) => (vec![*number], format!("element {number}")),
                Member::Range(_) => (Vec::new(), String::new()),
            };
            if found.is_empty() || matches!(member, Member::Element(number) if !elements.contains_key(number)) {
                let message = format!("*DISTRIBUTION has a direction of {name}, which the file does not have");
                return Err(place.error(&message));
            }
            all.extend(found.into_iter().map(|number| (number, points)));
        }
        Ok(all)
    }
}

fn points(values: &[f64], place: &Place) -> Result<Points, Error> {
    match *values {
        [x, y, z] => Ok(([x, y, z], None)),
        [x, y, z, u, v, w] => Ok(([x, y, z], Some([u, v, w]))),
        _ => {
            let message =
                format!("*DISTRIBUTION has {} numbers for an element; allowed: 3 or 6, of vectors", values.len());
            Err(place.error(&message))
        }
    }
}

/// A coordinate system whose first axis is along the fibre.
#[derive(Clone)]
pub struct Orientation {
    pub place: Place,
    system: String,
    definition: String,
    has_local_directions: bool,
    lines: Vec<(Place, Vec<String>)>,
}

impl Orientation {
    pub fn new(keyword: &Keyword<'_>) -> Orientation {
        let without_blanks =
            |name: &str, default: &str| keyword.label(name).unwrap_or(default.to_string()).replace(' ', "");
        Orientation {
            place: keyword.line.place(),
            system: without_blanks("SYSTEM", "RECTANGULAR"),
            definition: without_blanks("DEFINITION", "COORDINATES"),
            has_local_directions: keyword.value("LOCALDIRECTIONS").is_some(),
            lines: Vec::new(),
        }
    }

    /// # Errors
    /// There are too many lines.
    pub fn add(&mut self, line: &Line<'_>, fields: &[&str]) -> Result<(), Error> {
        if self.lines.len() == 2 {
            return Err(line.error("a third line of *ORIENTATION; allowed: the points, and a rotation"));
        }
        self.lines.push((line.place(), fields.iter().map(|field| (*field).to_string()).collect()));
        Ok(())
    }

    fn field(&self, line: usize, number: usize) -> &str {
        self.lines.get(line).and_then(|(_, fields)| fields.get(number)).map_or("", String::as_str)
    }

    fn real(&self, line: usize, number: usize) -> Result<f64, Error> {
        let (place, _) = &self.lines[line];
        Line { file: &place.file, number: place.line, text: "" }
            .real("a number of *ORIENTATION", self.field(line, number))
    }

    /// The name of the distribution that has the points, if one has.
    pub fn distribution(&self) -> Option<String> {
        let first = self.field(0, 0);
        let is_name = first.starts_with(|c: char| c.is_alphabetic() || c == '"' || c == '_');
        (is_name && self.definition == "COORDINATES").then(|| label(first))
    }

    /// The direction of the first axis, where the points are these or its own.
    ///
    /// # Errors
    /// The system is of a kind that is not read, or its points do not tell its axes.
    pub fn fibre(&self, points: Option<Points>) -> Result<[f64; 3], Error> {
        let refuse = |what: String| {
            let allowed = "allowed: RECTANGULAR or Z RECTANGULAR by COORDINATES";
            Err(self.place.error(&format!("*ORIENTATION with {what}; {allowed}")))
        };
        if self.definition != "COORDINATES" {
            return refuse(format!("DEFINITION={}", self.definition));
        }
        if self.has_local_directions {
            return refuse("LOCAL DIRECTIONS".to_string());
        }
        let along_z = match self.system.as_str() {
            "RECTANGULAR" => false,
            "ZRECTANGULAR" => true,
            other => return refuse(format!("SYSTEM={other}")),
        };
        let (a, b) = match points {
            Some(points) => points,
            None => self.points()?,
        };
        let (turned_about, angle) = self.rotation()?;
        if !along_z && (turned_about == 1 || angle == 0.0) {
            return Ok(a);
        }
        let [a, b] = [a, b.unwrap_or_default()].map(Vector3::from);
        let Some(normal) = Unit::try_new(a.cross(&b), 0.0) else {
            return Err(self
                .place
                .error("*ORIENTATION whose points are on a line with its origin; allowed: two directions"));
        };
        // Point a is on the first or the third axis, b in the plane of the first and the second, or of the third and
        // the first.
        let a = a.normalize();
        let axes = if along_z { [normal.cross(&a), *normal, a] } else { [a, normal.cross(&a), *normal] };
        let about = Unit::new_unchecked(axes[turned_about - 1]);
        Ok((Rotation3::from_axis_angle(&about, angle.to_radians()) * axes[0]).into())
    }

    fn points(&self) -> Result<Points, Error> {
        let Some((place, fields)) = self.lines.first() else {
            return Err(self.place.error("*ORIENTATION without points; allowed: two, and an origin"));
        };
        if fields.len() != 6 && fields.len() != 9 {
            let message =
                format!("*ORIENTATION has {} numbers; allowed: 6 of two points, or 9 with the origin", fields.len());
            return Err(place.error(&message));
        }
        let point = |first: usize| Ok([self.real(0, first)?, self.real(0, first + 1)?, self.real(0, first + 2)?]);
        let ([a, b], c) = ([point(0)?, point(3)?], point(6)?);
        let from_origin = |point: [f64; 3]| std::array::from_fn(|i| point[i] - c[i]);
        Ok((from_origin(a), Some(from_origin(b))))
    }

    /// The axis, from 1, and the angle in degrees by which the others are turned about it.
    fn rotation(&self) -> Result<(usize, f64), Error> {
        let Some((place, _)) = self.lines.get(1) else { return Ok((1, 0.0)) };
        let axis = match self.field(1, 0) {
            "" | "1" => 1,
            "2" => 2,
            "3" => 3,
            other => return Err(place.error(&format!("the axis of a rotation is {other}; allowed: 1, 2, 3"))),
        };
        Ok((axis, self.real(1, 1)?))
    }
}
