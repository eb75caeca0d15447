//! A yarn's section as upright columns with blunt edges.

use std::f64::consts::PI;

use serde::Deserialize;

/// The outline of a section.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Section {
    Ellipse,
    /// Between two arcs of a circle.
    Lens,
    Rectangle,
}

/// The yarns of a family: how far apart, and their section with its full sizes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thread {
    /// From one yarn of the family to the next.
    pub pitch: f64,
    pub section: Section,
    pub width: f64,
    pub height: f64,
}

impl Thread {
    pub fn area(&self) -> f64 {
        let [half_width, half_height] = [0.5 * self.width, 0.5 * self.height];
        match self.section {
            Section::Ellipse => PI * half_width * half_height,
            Section::Lens => {
                let radius = self.lens_radius();
                2.0 * (radius * radius * (half_width / radius).asin() - half_width * (radius - half_height))
            }
            Section::Rectangle => self.width * self.height,
        }
    }

    /// Half of the height at a place across, counted in half widths from the middle.
    pub fn half_height(&self, place: f64) -> f64 {
        let half_height = 0.5 * self.height;
        match self.section {
            Section::Ellipse => half_height * (1.0 - place * place).max(0.0).sqrt(),
            Section::Lens => {
                let (radius, across) = (self.lens_radius(), 0.5 * self.width * place);
                (radius * radius - across * across).max(0.0).sqrt() - (radius - half_height)
            }
            Section::Rectangle => half_height,
        }
    }

    fn lens_radius(&self) -> f64 {
        let [half_width, half_height] = [0.5 * self.width, 0.5 * self.height];
        (half_width * half_width + half_height * half_height) / (2.0 * half_height)
    }
}

/// A blunt edge is at least this part of the section's height: thinner elements would set the time step.
const LEAST_EDGE: f64 = 0.2;

/// The meshed section: the places of its upright lines across, and half of its height there.
#[derive(Clone, Debug, PartialEq)]
pub struct Columns {
    pub places: Vec<f64>,
    pub half_heights: Vec<f64>,
}

impl Columns {
    /// Columns of one width between upright lines that end on the outline. The two edges have the height that gives the
    /// polygon the section's area; where that is too low, a least one, and the section gets that much narrower.
    pub fn new(thread: &Thread, columns: usize) -> Columns {
        let share = |line: usize| 2.0 * line as f64 / columns as f64 - 1.0;
        let mut half_heights: Vec<f64> = (0..=columns).map(|line| thread.half_height(share(line))).collect();
        let inner: f64 = half_heights[1..columns].iter().sum();
        let wanted = thread.area() * columns as f64 / (2.0 * thread.width);
        let edge = (wanted - inner).max(0.5 * LEAST_EDGE * thread.height);
        (half_heights[0], half_heights[columns]) = (edge, edge);
        let half_width = 0.5 * thread.width * wanted / (inner + edge);
        Columns { places: (0..=columns).map(|line| half_width * share(line)).collect(), half_heights }
    }

    pub fn half_width(&self) -> f64 {
        self.places[self.places.len() - 1]
    }

    pub fn area(&self) -> f64 {
        let column = |line: usize| {
            (self.places[line + 1] - self.places[line]) * (self.half_heights[line] + self.half_heights[line + 1])
        };
        (0..self.places.len() - 1).map(column).sum()
    }

    /// Half of the polygon's height at a place across; at the edge outside of it.
    pub fn half_height(&self, place: f64) -> f64 {
        let last = self.places.len() - 1;
        let width = self.places[1] - self.places[0];
        let position = ((place - self.places[0]) / width).clamp(0.0, last as f64);
        let line = (position as usize).min(last - 1);
        let share = position - line as f64;
        (1.0 - share) * self.half_heights[line] + share * self.half_heights[line + 1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn thread(section: Section) -> Thread {
        Thread { pitch: 1.0, section, width: 0.5337, height: 0.115 }
    }

    #[test]
    fn the_polygon_has_the_section_s_area_blunt_edges_and_nearly_its_width() {
        for section in [Section::Ellipse, Section::Lens, Section::Rectangle] {
            let thread = thread(section);
            for count in [1, 2, 3, 4, 6, 12, 40] {
                let columns = Columns::new(&thread, count);
                assert!((columns.area() / thread.area() - 1.0).abs() < 1e-13);
                let width = 2.0 * columns.half_width() / thread.width;
                assert!((0.97..1.0 + 1e-13).contains(&width), "{section:?} {count}: width {width}");
                assert!(columns.half_heights[0] >= 0.1 * thread.height);
                assert!(columns.half_heights.iter().all(|half| *half <= 0.5 * thread.height * (1.0 + 1e-13)));
                assert_eq!(columns.half_height(columns.places[0]), columns.half_heights[0]);
            }
        }
    }

    #[test]
    fn a_lens_has_the_area_under_its_outline() {
        let thread = thread(Section::Lens);
        let steps = 20_000;
        let middle = |step: usize| 2.0 * (step as f64 + 0.5) / f64::from(steps) - 1.0;
        let sum: f64 = (0..steps as usize).map(|step| thread.half_height(middle(step))).sum();
        assert!((2.0 * sum * thread.width / f64::from(steps) / thread.area() - 1.0).abs() < 1e-8);
        assert!(thread.half_height(1.0).abs() < 1e-15 && (thread.half_height(0.0) - 0.0575).abs() < 1e-15);
    }
}
