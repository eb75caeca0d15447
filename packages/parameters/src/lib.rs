//! Parameters of a yarn: from measured data, and from its fibres, at the scale below.
//!
//! Which module answers which question:
//!
//! - properties from measured data, and how sure they are (`toron fit`): [`identify`];
//! - energies of a section's fibres by finite elements, from which they are found too (`toron cell`): [`cell`];
//! - the fibres of a yarn under impact or between plates, as rows of beads in LAMMPS (`toron fibres`): [`fibres`].

pub mod cell;
pub mod fibres;
pub mod identify;
