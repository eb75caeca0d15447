//! CalculiX: the cards of Abaqus, under the name by which it finds the law.

use super::abaqus::{comments, constants};
use super::material::{Material, WIDE};
use toron_shared::short_number::short;

/// CalculiX reads one more line where the last one is full.
const FULL: usize = 8;

pub fn card(material: &Material) -> String {
    let name = material.interface().calculix;
    let mut card = comments(material);
    card += "** For several materials of this law: the name with a second @ and a text of your own behind it.\n";
    card += &format!("** *SOLID SECTION, ELSET=YARN, MATERIAL={name} and *STEP, NLGEOM belong to it.\n");
    card += &format!("*MATERIAL, NAME={name}\n");
    if let Some(density) = material.density_if_any() {
        card += &format!("*DENSITY\n{}\n", short(density, WIDE));
    }
    card += &constants(material, "");
    if material.values.len().is_multiple_of(FULL) {
        card += "0.0\n";
    }
    card + &format!("*DEPVAR\n{}\n", material.law.description().history())
}
