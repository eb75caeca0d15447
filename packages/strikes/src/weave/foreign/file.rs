//! The table `[mesh]` of a TOML file.

use serde::Deserialize;

use crate::weave::panel::Part;
use toron_shared::checked::Positive;
use toron_shared::spanned::Spanned;
use toron_shared::toml_file::Numbers;

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub struct MeshFile {
    /// `.inp`, `.k` or `.key`, `.vtu`, relative to the scene's folder. Required.
    pub file: Option<Spanned<String>>,
    /// Unit of the file's lengths, as `"mm"` or `"in"`. Default: the scene's.
    pub units: Option<Spanned<String>>,
    /// Of a `quarter` x = 0 and y = 0 are planes of symmetry, with nothing beyond them. Default: `whole`.
    pub part: Option<Part>,
    /// Along x and y, added to the nodes: an unaimed blow is at the origin. `toron weave` prints the crossing nearest
    /// to it. Default: none.
    pub shift: Option<Spanned<Numbers<2>>>,
    /// Least distance of yarns, which decks take as the gap of their contact. Decks refuse yarns that meet. Default:
    /// measured.
    pub clearance: Option<Positive>,
    /// Of a yarn. Default: measured.
    pub height: Option<Positive>,
}
