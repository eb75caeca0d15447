//! OpenRadioss: `/MAT/USERnn` and the property that its elements need, fields of 20 columns, or of 10 for whole numbers.

use std::fmt::Write;

use toron::host::openradioss::card::OPTIONS;

use super::interface::Interface;
use super::material::{Material, WIDE};
use crate::common::error::Error;
use crate::common::short_number::short;

/// Values a line.
const FIELDS: usize = 5;

/// The only property with which F and stress are in global axes.
const PROPERTY: &str = "\
#   Isolid    Ismstr               Icpre               Inpts      Irot    Iframe                  dn
         1        10                   0                   0         0         1                   0
#                q_a                 q_b                   h
                   0                   0                   0
#             dt_min   istrain
                   0         1
";

/// # Errors
/// The material has no density.
pub fn card(material: &Material, id: u32) -> Result<String, Error> {
    let (Interface { openradioss: number, options, .. }, name) = (material.interface(), &material.name);
    let mut card = format!("/MAT/USER{number:02}/{id}\n{name}\n");
    for comment in material.comments() {
        let _ = writeln!(card, "# {comment}");
    }
    card += &lines(&["RHO_I"], &[short(material.density()?, WIDE)]);
    let options = &OPTIONS[..options];
    let names = material.table().iter().map(|property| property.name).chain(options.iter().map(|option| option.name));
    let zeros = options.iter().map(|_| "0".to_string());
    let values: Vec<String> = material.values.iter().map(|&value| short(value, WIDE)).chain(zeros).collect();
    let names: Vec<&str> = names.collect();
    for (names, values) in names.chunks(FIELDS).zip(values.chunks(FIELDS)) {
        card += &lines(names, values);
    }
    let _ = write!(card, "/PROP/TYPE14/{id}\n{name}\n{PROPERTY}");
    Ok(card)
}

/// A comment with the names of the fields, and their line.
fn lines(names: &[&str], values: &[String]) -> String {
    let names: String = names.iter().map(|name| format!("{name:>20}")).collect();
    let values: String = values.iter().map(|value| format!("{value:>20}")).collect();
    format!("#{}\n{values}\n", &names[1..])
}
