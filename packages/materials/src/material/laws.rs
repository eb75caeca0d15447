//! The laws that the files of a program may name: the library's, or one of somebody's own.

use std::sync::LazyLock;

use serde::{Deserialize, Deserializer};
use toron::host::laws::{LAWS, LibraryLaw};
use toron::law::description::Description;
use toron::law::parameters::{self, PRESETS, Property};

use super::own_law::OwnLaw;
use toron_c::{TORON_HYPERELASTIC, TORON_LINEAR_ELASTIC};
use toron_shared::error::Error;
use toron_shared::spanned::Spanned;
use toron_shared::toml_error::shortened;
use toron_shared::toml_file::Source;

/// A law by its name: the two that the program has more to say of than their descriptions, or any other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LawName {
    Hyperelastic,
    LinearElastic,
    Own(&'static OwnLaw),
}

macro_rules! by_description {
    ($($law:ident {
        $name:literal, $title:literal, $symbol:literal, $behaviour:literal, user $user:literal, umat $umat:literal
    })+) => {
        /// The library's laws by their descriptions, in the order of [`LAWS`].
        static BY_DESCRIPTION: LazyLock<Vec<OwnLaw>> = LazyLock::new(|| {
            let makers: &[fn(&'static LibraryLaw) -> OwnLaw] = &[$(OwnLaw::of_library::<toron::$law>),+];
            makers.iter().zip(&LAWS).map(|(maker, law)| maker(law)).collect()
        });
    };
}

toron::library_laws! { by_description {} }

impl From<&parameters::Preset> for LawName {
    /// The law of the library that has these properties.
    fn from(preset: &parameters::Preset) -> LawName {
        let found = BY_DESCRIPTION.iter().find(|law| std::ptr::eq(law.description.properties, preset.properties));
        LawName::of(found.expect("a preset is of a law of the library"))
    }
}

/// How the solvers find a law: as one of the library, or as one of somebody's own.
#[derive(Clone, Copy, Debug)]
pub enum Names {
    Library(&'static LibraryLaw),
    Own(&'static OwnLaw),
}

impl LawName {
    /// A law of the library.
    fn of(law: &'static OwnLaw) -> LawName {
        let known = [LawName::Hyperelastic, LawName::LinearElastic];
        known.into_iter().find(|known| known.text() == law.name).unwrap_or(LawName::Own(law))
    }

    pub fn names(self) -> Names {
        match self {
            LawName::Hyperelastic => Names::Library(&LAWS[TORON_HYPERELASTIC as usize]),
            LawName::LinearElastic => Names::Library(&LAWS[TORON_LINEAR_ELASTIC as usize]),
            LawName::Own(law) => law.library.map_or(Names::Own(law), Names::Library),
        }
    }

    pub fn description(self) -> &'static Description {
        match self.names() {
            Names::Library(law) => law.description,
            Names::Own(law) => &law.description,
        }
    }

    pub fn table(self) -> &'static [Property] {
        self.description().properties
    }

    /// As files have it.
    pub fn text(self) -> &'static str {
        match self.names() {
            Names::Library(law) => law.name,
            Names::Own(law) => &law.name,
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
            Laws::Toron => BY_DESCRIPTION.iter().map(LawName::of).collect(),
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
        // As it is said of a word out of a list.
        let wrong = |_| D::Error::custom("wrong type, expected a word in quotes");
        String::deserialize(deserializer).map(LawText).map_err(wrong)
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
