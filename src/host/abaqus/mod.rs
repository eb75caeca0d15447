//! Abaqus: UMAT (Standard) and VUMAT (Explicit).
//!
//! | | UMAT | VUMAT |
//! |---|---|---|
//! | deformation | DFGRD1(3,3), F by columns; the linear law reads DFGRD0 too | stretchNew, U: 11 22 33 12 23 31; the linear law reads stretchOld too |
//! | frame of the stress | global; no `*ORIENTATION` | corotational: RᵀσR |
//! | order of the stress | 11 22 33 **12 13 23** | 11 22 33 **12 23 31** |
//! | arrays | one point | (nblock, components), component-major |
//! | precision | double | that of the job |
//! | energy | SSE = W/J per current volume; SPD what is lost | enerInternNew = W/ρ0 per mass; enerInelasNew what is lost |
//! | failure | stress 0, STATEV "alive" 0 | state variable "alive" 0: `*DEPVAR, DELETE=11`, of the linear law 10, of that with friction 15 |
//! | F inverted or not finite | state kept, PNEWDT ≤ ¼ | point failed and deleted |
//! | tangent | DDSDDE(ntens, ntens): the Jaumann rate of τ, over J | none |
//!
//! Solids: three-dimensional ones (NDI = 3, NSHR = 3), plane-strain and axisymmetric ones (3, 1). Plane stress is
//! (2, 1) in Standard and refused; in Explicit it is (3, 1) too. The symbols `umat_` and `vumat_` that Abaqus looks for are
//! in `fortran-shim/`, and in the libraries of `abaqus/`. A material with 10 properties and 10 state variables has the
//! linear elastic law there, one with 13 or 14 properties the law with friction, every other one the hyperelastic law;
//! (3, 1) in Explicit must be announced by the material's name, which ends in `_PSTRAIN` or `_AXIS`. In a library of
//! laws of one's own the material's name begins with that of its law.

mod umat;
mod vumat;

pub use umat::{StandardLaw, Umat, circumstances};
pub use vumat::{ExplicitLaw, Vumat};

use crate::law::bounds::wrong_number;
use crate::law::error::Error;
use crate::law::parameters::Property;
use crate::law::status;

/// What direct and shear components are, as Abaqus names their numbers: of a UMAT, of a VUMAT.
const UMAT_COUNTS: [&str; 2] = [
    "direct stress components, NDI (solids only)",
    "shear stress components, NSHR (1 for plane strain and axisymmetric solids)",
];
const VUMAT_COUNTS: [&str; 2] = [
    "direct stress components, NDIR (solids only)",
    "shear stress components, NSHR (1 for plane strain and axisymmetric solids)",
];

/// Checks the numbers of components, called `names`, and of state variables, of which the law has `needed`.
///
/// # Errors
/// The first number that is wrong.
#[cold]
fn check_counts(direct: i32, shear: i32, names: [&'static str; 2], state: i32, needed: usize) -> Result<(), Error> {
    let wrong = |code: i32, what: &'static str, found: i32, wanted: usize| {
        Err(Error::Count { code, what, found: i64::from(found), wanted: wanted as i64 })
    };
    if direct != 3 {
        return wrong(status::BAD_COUNT, names[0], direct, 3);
    }
    if shear != 3 && shear != 1 {
        return wrong(status::BAD_COUNT, names[1], shear, 3);
    }
    if state < needed as i32 {
        return wrong(status::STATE_COUNT, "number of state variables (*DEPVAR)", state, needed);
    }
    Ok(())
}

/// The number of properties, which Abaqus passes with a sign.
fn property_count(nprops: i32, table: &'static [Property]) -> Result<usize, Error> {
    usize::try_from(nprops).map_err(|_| wrong_number(i64::from(nprops), table))
}
