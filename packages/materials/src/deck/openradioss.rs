//! OpenRadioss: `/MAT/USERnn` and the property that its elements need, fields of 20 columns, or of 10 for whole
//! numbers.

use std::fmt::Write;

use toron::host::openradioss::card::OPTIONS;
use toron::{Criterion, Rotation};

use super::interface::Interface;
use super::material::{Material, WIDE};
use toron_shared::error::Error;
use toron_shared::short_number::short;

/// Values a line.
const FIELDS: usize = 5;

/// Where each element's fibre direction comes from, as the card's option `fibre_from` has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum FibreFrom {
    /// The direction of the card.
    Card,
    /// From nodes 1 to 4 of the element to nodes 5 to 8.
    Nodes,
    /// The initial values of its user variables.
    InitialValues,
}

/// Bulk viscosity, quadratic and linear, and the viscosity of hourglass control; 0 is the solver's own.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Control {
    pub quadratic: f64,
    pub linear: f64,
    pub hourglass: f64,
}

/// Material and property of the same number.
///
/// # Errors
/// As for [`material_card`].
pub fn card(material: &Material, id: u32, fibre_from: FibreFrom) -> Result<String, Error> {
    Ok(material_card(material, id, fibre_from)? + &property_card(&material.name, id, Control::default()))
}

/// # Errors
/// The material has no density, or its law has no such option.
pub fn material_card(material: &Material, id: u32, fibre_from: FibreFrom) -> Result<String, Error> {
    let (Interface { openradioss: number, options, .. }, name) = (material.interface(), &material.name);
    let lacks =
        |option: &str| Error::Input(format!("{option} is for a law that has this option; {name} is of another"));
    if fibre_from != FibreFrom::Card && options == 0 {
        return Err(lacks("--fibre-from"));
    }
    if !material.has_default_options() && options < OPTIONS.len() {
        return Err(lacks("--frame or --criterion"));
    }
    let mut card = format!("/MAT/USER{number:02}/{id}\n{name}\n");
    for comment in material.comments() {
        let _ = writeln!(card, "# {comment}");
    }
    card += &lines(&["RHO_I"], &[short(material.density()?, WIDE)]);
    let options = &OPTIONS[..options];
    let names = material.table().iter().map(|property| property.name).chain(options.iter().map(|option| option.name));
    let chosen = options.iter().map(|option| match option.name {
        "fibre_from" => (fibre_from as usize).to_string(),
        "frame" => usize::from(material.frame == Rotation::Polar).to_string(),
        _ => usize::from(material.criterion == Criterion::FibreStress).to_string(),
    });
    let values: Vec<String> = material.values.iter().map(|&value| short(value, WIDE)).chain(chosen).collect();
    let names: Vec<&str> = names.collect();
    for (names, values) in names.chunks(FIELDS).zip(values.chunks(FIELDS)) {
        card += &lines(names, values);
    }
    Ok(card)
}

/// The only property with which F and stress are in global axes.
pub fn property_card(name: &str, id: u32, control: Control) -> String {
    let [quadratic, linear, hourglass] = [control.quadratic, control.linear, control.hourglass]
        .map(|value| if value == 0.0 { "0".to_string() } else { short(value, WIDE) });
    let mut card = format!("/PROP/TYPE14/{id}\n{name}\n");
    card += "#   Isolid    Ismstr               Icpre               Inpts      Irot    Iframe                  dn\n";
    card += "         1        10                   0                   0         0         1                   0\n";
    card += "#                q_a                 q_b                   h\n";
    let _ = writeln!(card, "{quadratic:>20}{linear:>20}{hourglass:>20}");
    card + "#             dt_min   istrain\n                   0         1\n"
}

/// A comment with the names of the fields, and their line.
pub fn lines(names: &[&str], values: &[String]) -> String {
    let names: String = names.iter().map(|name| format!("{name:>20}")).collect();
    let values: String = values.iter().map(|value| format!("{value:>20}")).collect();
    format!("#{}\n{values}\n", &names[1..])
}
