//! Abaqus: `*MATERIAL` with `*USER MATERIAL` and `*DEPVAR`, the state variables named. Which of the library's laws runs
//! follows from the numbers of properties and of state variables; the name of a material of another law begins with the
//! law's.

use std::fmt::Write;

use super::material::{Material, WIDE};
use crate::material::laws::{LawName, Names};
use crate::material::preset::LONGEST_NAME;
use toron_shared::error::Error;
use toron_shared::short_number::short;

/// A comment of the card: only the law's author knows whether its tangent is symmetric.
const UNSYMMETRIC: &str =
    "** Abaqus/Standard: *USER MATERIAL, CONSTANTS=..., UNSYMM where the tangent of the law is not symmetric.\n";

/// Which of the two solvers the card is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Solver {
    Standard,
    Explicit,
    Both,
}

/// # Errors
/// The material has no density.
pub fn card(material: &Material, solver: Solver) -> Result<String, Error> {
    let mut card = comments(material);
    match solver {
        Solver::Standard => {
            card += "** Abaqus/Standard: *STEP, NLGEOM=YES. It deletes no failed elements.\n";
            if matches!(material.law, LawName::Own(_)) && !unsymmetric(material.law) {
                card += UNSYMMETRIC;
            }
        }
        Solver::Explicit => card += &deletion(material),
        Solver::Both => {
            card += "** Abaqus/Standard: *STEP, NLGEOM=YES. It deletes no failed elements; DELETE is for Explicit.\n";
            match material.law {
                _ if unsymmetric(material.law) => {
                    card += "** Abaqus/Standard: *USER MATERIAL, CONSTANTS=..., UNSYMM.\n"
                }
                LawName::Hyperelastic | LawName::LinearElastic => {}
                LawName::Own(_) => card += UNSYMMETRIC,
            }
            card += &deletion(material);
        }
    }
    let _ = write!(card, "*MATERIAL, NAME={}\n*DENSITY\n{},\n", name(material), short(material.density()?, WIDE));
    let unsymmetric = solver == Solver::Standard && unsymmetric(material.law);
    card += &constants(material, if unsymmetric { ", UNSYMM" } else { "" });
    let delete = match solver {
        Solver::Standard => String::new(),
        Solver::Explicit | Solver::Both => format!(", DELETE={}", material.law.description().alive + 1),
    };
    let variables = material.state_table();
    let _ = writeln!(card, "*DEPVAR{delete}\n{},", variables.len());
    for (i, variable) in variables.iter().enumerate() {
        let _ = writeln!(card, "{}, {}, \"{}\"", i + 1, variable.name.to_uppercase(), variable.meaning);
    }
    Ok(card)
}

/// Whether the law is one of the library's whose tangent is not symmetric: all but the hyperelastic law.
fn unsymmetric(law: LawName) -> bool {
    law != LawName::Hyperelastic && matches!(law.names(), Names::Library(_))
}

pub fn comments(material: &Material) -> String {
    material.comments().iter().map(|comment| format!("** {comment}\n")).collect()
}

/// The material's name, behind that of its law where Abaqus finds the law by it.
pub fn name(material: &Material) -> String {
    let name = material.name.to_uppercase();
    match material.interface().abaqus {
        Some(law) if !name.starts_with(law) => format!("{law}-{name}").chars().take(LONGEST_NAME).collect(),
        _ => name,
    }
}

/// What deletes failed elements besides the card.
fn deletion(material: &Material) -> String {
    let name = name(material);
    format!(
        "** Abaqus/Explicit deletes failed elements if their section says so:\n\
         **   *SECTION CONTROLS, NAME=DELETE-FAILED, ELEMENT DELETION=YES\n\
         **   *SOLID SECTION, ELSET=YARN, MATERIAL={name}, CONTROLS=DELETE-FAILED\n"
    )
}

/// The properties, eight a line, with their names in a comment before them; `options` stands behind their number.
pub fn constants(material: &Material, options: &str) -> String {
    let (table, values) = (material.table(), &material.values);
    let mut text = String::new();
    let names: Vec<&str> = table.iter().map(|property| property.name).collect();
    for names in names.chunks(8) {
        let _ = writeln!(text, "** {}", names.join(", "));
    }
    let _ = writeln!(text, "*USER MATERIAL, CONSTANTS={}{options}", values.len());
    for line in values.chunks(8) {
        let fields: Vec<String> = line.iter().map(|&value| short(value, WIDE)).collect();
        let _ = writeln!(text, "{}", fields.join(", "));
    }
    text
}
