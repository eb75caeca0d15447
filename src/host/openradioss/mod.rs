//! OpenRadioss: user materials of solids, `/MAT/USERnn` (law 99), in starter and engine.
//!
//! | | |
//! |---|---|
//! | found as | `LECMUSERnn` and `LUSERnn` in `fortran-shim/` for the solver's SDK, or `libtoron_openradioss.so`, which the solver loads by itself |
//! | law | toron's own libraries: nn = 01 the hyperelastic one, nn = 02 the linear elastic one |
//! | card | after the line of the density, fields of 20 columns, five a line: the law's properties, then the options of [`card`] |
//! | UPARAM | number of the law, properties, options |
//! | deformation | FPSXX YY ZZ XY YZ ZX **YX ZY XZ**, an array for each; 0 unless Ismstr = 10 |
//! | stress | SIGNXX YY ZZ XY YZ ZX: Cauchy, global; SIGVXX … are set to 0 where the solver has not done so |
//! | arrays | F and stress have the solver's vector length; UVAR is (NEL, NUVAR), SOUNDSP and OFF are (NEL) |
//! | UVAR | the law's state, fibre direction of a law that has one, `deleted`; for a law that reads it the old F too; the element's diagonal, see [`card::Layout`] |
//! | failure | OFF = 0, `deleted` = 1; a point that cannot be evaluated: OFF = 0, `deleted` = its status code |
//! | time step | SOUNDSP, in every cycle: the law's bound of the wave speed |
//!
//! Elements with `/PROP/TYPE14` (`/PROP/SOLID`), Isolid = 1 (or 17), Iframe = 1, Ismstr = 10: F and stress are then in
//! global axes.

mod brick;
pub mod card;
pub mod engine;
mod entries;
pub mod laws;
pub mod starter;

pub use engine::{Group, evaluate_material, needs_nodes};
pub use entries::{ListingLine, MaterialCard, read_card_f32, read_card_f64, write_line_f32, write_line_f64};
pub use entries::{group_f32, group_f64, group_of_f32, group_of_f64};
pub use laws::{Laws, Material, MyReal, SolidLaw};
pub use starter::{Read, listing, read};
