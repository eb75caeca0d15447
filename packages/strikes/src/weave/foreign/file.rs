//! The table `[mesh]` of a TOML file.

use serde::Deserialize;
use toml::Spanned;

use crate::weave::panel::Part;
use toron_shared::toml_file::Numbers;

/// The table, and what a case has otherwise.
#[derive(Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeshFile {
    pub file: Option<Spanned<String>>,
    pub units: Option<Spanned<String>>,
    pub part: Option<Part>,
    pub shift: Option<Spanned<Numbers<2>>>,
    pub clearance: Option<Spanned<f64>>,
    pub height: Option<Spanned<f64>>,
}

impl MeshFile {
    /// This table, with the keys of `base` where it has none. A file of its own has its own sizes.
    pub fn over(&self, base: &MeshFile) -> MeshFile {
        let (own, base) = (self.clone(), base.clone());
        let sizes = if own.file.is_some() { MeshFile::default() } else { base.clone() };
        MeshFile {
            file: own.file.or(base.file),
            units: own.units.or(base.units),
            part: own.part.or(base.part),
            shift: own.shift.or(base.shift),
            clearance: own.clearance.or(sizes.clearance),
            height: own.height.or(sizes.height),
        }
    }
}
