//! MTest: the behaviour and a line for each of its properties.

use std::fmt::Write;

use super::interface::Interface;
use super::material::{Material, WIDE};
use toron_shared::short_number::short;

pub fn card(material: &Material) -> String {
    let mut card = material.comments().iter().map(|comment| format!("// {comment}\n")).collect::<String>();
    let Interface { library, behaviour, .. } = material.interface();
    let _ = writeln!(card, "@Behaviour<generic> '{library}' '{behaviour}';");
    for (property, &value) in material.table().iter().zip(&material.values) {
        let unit = material.unit(property.dimension);
        let blank = if unit.is_empty() { "" } else { ", " };
        let line = format!("@MaterialProperty<constant> '{}' {};", property.name, short(value, WIDE));
        let _ = writeln!(card, "{line:<49} // {}{blank}{unit}", property.meaning);
    }
    card
}
