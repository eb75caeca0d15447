//! A panel's outline, what of it is meshed, and where its yarns lie and end.

use serde::Deserialize;

use super::geometry::{Family, Weave};

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outline {
    /// Half of its sizes along x and y.
    Rectangle([f64; 2]),
    /// Its radius.
    Circle(f64),
}

#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum Part {
    #[default]
    Whole,
    /// x ≥ 0 and y ≥ 0, where the planes x = 0 and y = 0 are planes of symmetry.
    Quarter,
}

/// What lies at the origin.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
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
}

/// A yarn of a panel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    pub family: Family,
    /// Its number in the pattern; 0 lies at the origin, or next to it.
    pub number: i64,
    /// y of a warp yarn, x of a weft yarn.
    pub coordinate: f64,
    /// The layers from the plane through the origin to the end; a whole panel has them on both sides.
    pub layers: usize,
    /// Cut along its axis by a plane of symmetry.
    pub halved: bool,
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
        let bounds = match self.outline {
            Outline::Rectangle(half) => half,
            Outline::Circle(radius) => [radius; 2],
        };
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
        let sections: usize =
            places.iter().map(|place| place.layers * self.halves() / (1 + usize::from(place.halved))).sum();
        if (sections * weave.columns * weave.rows) as f64 > MOST_ELEMENTS {
            return Err(format!("the panel has more than {MOST_ELEMENTS:.0e} elements; allowed: up to so many"));
        }
        Ok(places)
    }

    /// How often a yarn's layers from the origin to its end are there.
    pub fn halves(&self) -> usize {
        if self.part == Part::Whole { 2 } else { 1 }
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
        let [bound_along, bound_across] = if family == Family::Warp { bounds } else { [bounds[1], bounds[0]] };
        let shift = if self.centre == Centre::Gap { 0.5 } else { 0.0 };
        let last = (bound_across / pitch - shift + ROUNDING).floor() as i64;
        // The mirror image of a number: that of 0 in a gap is -1.
        let first = match (self.part, self.centre) {
            (Part::Quarter, _) => 0,
            (Part::Whole, Centre::Crossing) => -last,
            (Part::Whole, Centre::Gap) => -last - 1,
        };
        let place = |number: i64| {
            let coordinate = pitch * (number as f64 + shift);
            let length = match self.outline {
                Outline::Rectangle(_) => bound_along,
                Outline::Circle(radius) => (radius * radius - coordinate * coordinate).max(0.0).sqrt(),
            };
            // The last layer's middle is half an element before its end.
            let layers = (length / step + 0.5 + ROUNDING).floor() as usize;
            let halved = self.part == Part::Quarter && self.centre == Centre::Crossing && number == 0;
            Place { family, number, coordinate, layers, halved }
        };
        (first..=last).map(place).filter(|place| place.layers > 0).collect()
    }
}
