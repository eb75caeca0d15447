//! The table `[mesh]` of a TOML file.

use serde::Deserialize;
use toml::Spanned;

use crate::weave::panel::Part;
use toron_shared::checked::Positive;
use toron_shared::toml_file::Numbers;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeshFile {
    pub file: Option<Spanned<String>>,
    pub units: Option<Spanned<String>>,
    pub part: Option<Part>,
    pub shift: Option<Spanned<Numbers<2>>>,
    pub clearance: Option<Positive>,
    pub height: Option<Positive>,
}
