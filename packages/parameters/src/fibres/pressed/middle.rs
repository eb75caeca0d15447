//! The fibres of a box that are away from its walls: what they do, they do in a yarn of many more.

use crate::fibres::scene::Packing;
use crate::fibres::section::{ROW, Section};

/// Fibres whose centre is nearer than this to a wall, in diameters, feel it.
const EDGE: f64 = 2.0;

/// The middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Middle {
    /// So many of the section's fibres, the first ones.
    pub fibres: usize,
    /// What they take of the section at rest, voids included.
    pub area: f64,
}

impl Middle {
    /// # Errors
    /// There is none.
    pub fn of(section: &Section, packing: Packing, diameter: f64) -> Result<Middle, String> {
        let fibres = section.centres.iter().take_while(|&&centre| section.depth(centre) >= EDGE).count();
        if fibres == 0 {
            return Err(format!("no fibre of the box is {EDGE} diameters away from all walls; allowed: more fibres"));
        }
        let area = match packing {
            // The part of the box that is as far from the walls holds a whole number of rows only by chance.
            Packing::Hexagonal => ROW * fibres as f64,
            Packing::Random { .. } => section.size.iter().map(|size| size - 2.0 * EDGE).product(),
        };
        Ok(Middle { fibres, area: area * diameter * diameter })
    }
}
