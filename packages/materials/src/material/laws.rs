//! The laws that the files of a program may name: the library's two, or one of somebody's own.

use serde::{Deserialize, Deserializer};
use toml::Spanned;
use toron::law::description::{self, Description};
use toron::law::parameters::{self, PRESETS, Property};

use super::own_law::OwnLaw;
use toron_shared::error::Error;
use toron_shared::toml_error::shortened;
use toron_shared::toml_file::Source;

/// A law by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LawName {
    Hyperelastic,
    LinearElastic,
    Own(&'static OwnLaw),
}

impl From<parameters::LawName> for LawName {
    fn from(law: parameters::LawName) -> LawName {
        match law {
            parameters::LawName::Hyperelastic => LawName::Hyperelastic,
            parameters::LawName::LinearElastic => LawName::LinearElastic,
        }
    }
}

impl LawName {
    pub fn description(self) -> &'static Description {
        match self {
            LawName::Hyperelastic => &description::HYPERELASTIC,
            LawName::LinearElastic => &description::LINEAR_ELASTIC,
            LawName::Own(law) => &law.description,
        }
    }

    pub fn table(self) -> &'static [Property] {
        self.description().properties
    }

    /// As files have it.
    pub fn text(self) -> &'static str {
        match self {
            LawName::Hyperelastic => "hyperelastic",
            LawName::LinearElastic => "linear-elastic",
            LawName::Own(law) => &law.name,
        }
    }
}

/// The laws of a program.
#[derive(Clone, Copy, Debug)]
pub enum Laws {
    /// The library's.
    Toron,
    Own(&'static OwnLaw),
}

impl Laws {
    pub fn names(self) -> Vec<LawName> {
        match self {
            Laws::Toron => vec![LawName::Hyperelastic, LawName::LinearElastic],
            Laws::Own(law) => vec![LawName::Own(law)],
        }
    }

    /// The law of a preset that names none.
    pub fn first(self) -> LawName {
        match self {
            Laws::Toron => LawName::Hyperelastic,
            Laws::Own(law) => LawName::Own(law),
        }
    }

    /// The law of a material that names neither law nor preset.
    pub fn only(self) -> Option<LawName> {
        match self {
            Laws::Toron => None,
            Laws::Own(law) => Some(LawName::Own(law)),
        }
    }

    pub fn find(self, text: &str) -> Option<LawName> {
        self.names().into_iter().find(|law| law.text() == text)
    }

    /// The presets that files may name.
    pub fn presets(self) -> &'static [parameters::Preset] {
        match self {
            Laws::Toron => &PRESETS,
            Laws::Own(_) => &[],
        }
    }

    pub fn preset(self, name: &str) -> Option<&'static parameters::Preset> {
        self.presets().iter().find(|preset| preset.name == name)
    }

    /// What the program is called: as its law, unless that is one of the library's.
    pub fn program(self) -> &'static str {
        match self {
            Laws::Toron => "toron",
            Laws::Own(law) => &law.name,
        }
    }
}

/// A law's name in a file, which may be wrong.
#[derive(Clone)]
pub struct LawText(pub String);

impl<'de> Deserialize<'de> for LawText {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        use serde::de::Error as _;
        // As the parser says it of a word out of a list.
        String::deserialize(deserializer).map(LawText).map_err(|_| D::Error::custom("wanted string or table"))
    }
}

/// # Errors
/// None of the laws has this name.
pub fn law(source: &Source<'_>, laws: Laws, name: &Spanned<LawText>) -> Result<LawName, Error> {
    laws.find(&name.get_ref().0).ok_or_else(|| {
        let names: Vec<&str> = laws.names().into_iter().map(LawName::text).collect();
        let found = shortened(source.text.get(name.span()).unwrap_or(&name.get_ref().0));
        source.error(name.span(), &format!("law is {found}; allowed: {}", names.join(" or ")))
    })
}
