//! The materials of a scene that is struck: one of each law, its failure chosen by the case.

use std::ops::Range;

use serde::Deserialize;

use super::file::MaterialFile;
use super::laws::Laws;
use super::model::{Law, Material};
use super::own_law::Own;
use crate::material::file::read_material;
use toron::Rotation;
use toron::host::units::UnitSystem;
use toron::law::parameters::{ALPHA, BETA, EPS_LIM, SIGMA_LIM};
use toron_shared::error::Error;
use toron_shared::spanned::Spanned;
use toron_shared::toml_file::{Source, Unused};

/// Numbers closer than this part of themselves are the same.
const ROUNDING: f64 = 1e-9;

/// Keys of the materials.
pub const HYPERELASTIC: &str = "hyperelastic";
pub const LINEAR_ELASTIC: &str = "linear-elastic";
pub const FRICTIONAL: &str = "frictional";
/// Of a law of one's own, in a program for it.
pub const MATERIAL: &str = "material";

/// The tables of materials, each with what is found there.
pub type Tables<T> = [(&'static str, T); 4];

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum LawName {
    Hyperelastic,
    LinearElastic,
    Frictional,
    /// The hyperelastic law where the yarn is struck, the linear elastic one elsewhere.
    Hybrid,
    /// That of the program, where a case has a material of it and names no other law.
    #[serde(skip)]
    Own,
}

impl LawName {
    /// The table of a yarn that has one material.
    pub fn table(self) -> Option<&'static str> {
        match self {
            LawName::Hyperelastic => Some(HYPERELASTIC),
            LawName::LinearElastic => Some(LINEAR_ELASTIC),
            LawName::Frictional => Some(FRICTIONAL),
            LawName::Own => Some(MATERIAL),
            LawName::Hybrid => None,
        }
    }

    /// Whether a yarn of this law has the material of that table.
    pub fn has(self, table: &str) -> bool {
        self.table().map_or([HYPERELASTIC, LINEAR_ELASTIC].contains(&table), |own| own == table)
    }
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum FailureName {
    None,
    Uniaxial,
    Multiaxial,
}

impl LawName {
    /// The yarn of a law's table that names none.
    fn default_yarn(table: &str) -> &'static str {
        match table {
            FRICTIONAL => "kevlar-km2-600-frictional",
            LINEAR_ELASTIC => "kevlar-km2-600-linear",
            _ => "kevlar-km2-600",
        }
    }
}

/// A yarn of one's own that a scene's tables name, each with its law's name; none where all are the default ones.
pub fn own_yarn<'a>(
    tables: impl IntoIterator<Item = (&'static str, &'a Option<Spanned<MaterialFile>>)>,
) -> Option<String> {
    let of_library = tables.into_iter().filter(|(law, _)| *law != MATERIAL);
    let named = of_library.filter_map(|(law, table)| Some((law, table.as_ref()?.get_ref().yarn()?)));
    named.into_iter().find(|(law, yarn)| *yarn != LawName::default_yarn(law)).map(|(_, yarn)| yarn.to_string())
}

/// A material of this table that is of no case's law.
pub fn unused_material(tables: Tables<&Option<Spanned<MaterialFile>>>, laws: &[LawName]) -> Unused {
    let (name, table) =
        tables.into_iter().find(|(name, table)| table.is_some() && laws.iter().all(|law| !law.has(name)))?;
    Some((table.as_ref()?.span(), format!("{name} is not used; allowed: the material of a case's law")))
}

/// Which material a case asks for.
pub struct Choice<'a> {
    /// The laws of the program.
    pub laws: Laws,
    /// [`HYPERELASTIC`], [`LINEAR_ELASTIC`], [`FRICTIONAL`] or [`MATERIAL`].
    pub law: &'static str,
    pub failure: FailureName,
    /// As [`own_yarn`] finds it: beside it none is taken by default.
    pub own_yarn: Option<&'a str>,
    /// Where the case itself says something of a property, or of its failure: that is the line to change.
    pub place: &'a dyn Fn(&str) -> Option<Range<usize>>,
    /// The place that errors name for keys that are missing.
    pub span: Range<usize>,
}

/// Leaves out the limits and weights that the case's failure has no use for; those that it needs must be there.
fn choose_failure(
    source: &Source<'_>,
    choice: &Choice,
    material: &mut Material,
    file: &MaterialFile,
    span: &Range<usize>,
) -> Result<(), Error> {
    let failure = choice.failure;
    // A property of the scene is wrong only beside the failure of a case: that is the line to change.
    let place = |name: &str| (choice.place)(name).or(file.given(name).map(Spanned::span)).unwrap_or(span.clone());
    let (table, mut values) = (material.table(), material.values());
    let (limit, weights): (usize, &[usize]) = match (&material.law, material.law.yarn()) {
        (_, Some(_)) => (EPS_LIM, &[ALPHA, BETA]),
        (Law::LinearElastic { .. }, None) => (SIGMA_LIM, &[]),
        (Law::Hyperelastic { .. } | Law::Own(_), None) => return Ok(()), // a law of one's own says itself when it fails
    };
    let (off, allowed): (&[usize], &str) = match failure {
        FailureName::None => (&[limit], "uniaxial or multiaxial"),
        FailureName::Uniaxial => (weights, "multiaxial"),
        FailureName::Multiaxial => (&[], ""),
    };
    for &index in off {
        values[index] = 0.0;
        let name = table[index].name;
        if let Some(given) = file.given(name).filter(|given| *given.get_ref() != 0.0) {
            let message = format!(
                "{name} is {}, which the failure leaves out; allowed: 0, or failure {allowed}",
                given.get_ref()
            );
            return Err(source.error(place(name), &message));
        }
    }
    if failure != FailureName::None && values[limit] == 0.0 {
        let name = table[limit].name;
        let message = format!("{name} is 0, with which nothing fails; allowed: a number > 0, or failure none");
        return Err(source.error(place(name), &message));
    }
    if failure == FailureName::Multiaxial && !weights.is_empty() && weights.iter().all(|&weight| values[weight] == 0.0)
    {
        let message = "alpha and beta are 0; allowed: one of them > 0, or failure uniaxial";
        return Err(source.error(place(table[ALPHA].name), message));
    }
    material.law = material.law.with(&values).map_err(|error| source.error(span.clone(), &error.to_string()))?;
    Ok(())
}

/// That a law can be struck.
fn check_own(own: &Own) -> Result<(), String> {
    let name = &own.law.name;
    if own.law.description.reads.temperature {
        return Err(format!(
            "the law {name} reads the temperature, which scenes do not have; allowed: a law that does not"
        ));
    }
    own.check_at_rest().map_err(|error| format!("the law {name}: {error}"))
}

/// The material of this law's table, which its preset completes, with the failure that the case asks for.
///
/// # Errors
/// An input error that names file, line, value and what is allowed.
pub fn material_of_law(
    source: &Source<'_>,
    choice: &Choice,
    table: &Option<Spanned<MaterialFile>>,
    units: &UnitSystem,
) -> Result<Material, Error> {
    let law = choice.law;
    let preset = LawName::default_yarn(law);
    let names_none = table.as_ref().is_none_or(|table| table.get_ref().yarn().is_none());
    if let Some(own) = choice.own_yarn.filter(|_| names_none) {
        let span = table.as_ref().map_or(choice.span.clone(), Spanned::span);
        let message = format!(
            "{law} names no yarn, and the scene has one of its own, {own}; allowed: {law}.preset or {law}.law \
             (the default is {law}.preset = \"{preset}\")"
        );
        return Err(source.error(span, &message));
    }
    let (file, span) = match table {
        Some(table) => (table.get_ref().clone(), table.span()),
        None => (MaterialFile::default(), choice.span.clone()),
    };
    let (laws, file) = match (law, choice.laws) {
        (MATERIAL, Laws::Own(_)) => (choice.laws, file),
        (MATERIAL, Laws::Toron) => {
            let message = "material is of a law of one's own, whose program runs it; allowed here: hyperelastic, \
                           linear-elastic, frictional";
            return Err(source.error(span, message));
        }
        _ => (Laws::Toron, file.or_preset(preset, choice.span.clone())),
    };
    let mut material = read_material(source, laws, &file, units, span.clone())?;
    if let Law::Own(own) = &material.law {
        check_own(own).map_err(|message| source.error(span.clone(), &message))?;
    }
    let found = material.law.name().text();
    if law != MATERIAL && found != law {
        return Err(source.error(span, &format!("{law} has a material of the law {found}; allowed: {law}")));
    }
    let fibre = material.fibre();
    if fibre.x.abs() < 1.0 - ROUNDING {
        let [x, y, z] = fibre.into();
        let message = format!("{law} has its fibres along [{x}, {y}, {z}]; allowed: along the yarn, [1, 0, 0]");
        return Err(source.error(span, &message));
    }
    choose_failure(source, choice, &mut material, &file, &span)?;
    if let Law::LinearElastic { frame: Rotation::Spin, .. } = material.law {
        return Err(source.error(span, "frame is \"spin\"; allowed here: fibre, polar"));
    }
    if material.density.is_none() {
        return Err(source.error(span, "density is missing; allowed: a finite number > 0"));
    }
    Ok(material)
}
