//! The interfaces to host programs, one file for each; it begins with the host's order of arguments and components.
//! Beside them what the C interface is made of: the structures that a caller passes, and what evaluates them. Its
//! functions are those of package `toron-c-functions`.
//!
//! # What a caller promises
//!
//! What is null is passed over or refused; of a pointer that is not, each function has to believe, while it runs:
//!
//! - a structure that begins with its size has as many bytes as it says, a prepared law is a whole structure of its
//!   type, prepared or not, and in what a function prepares, `size` bytes may be written;
//! - an array has as many values as its argument or field says, in the layout that the structure says, valid for
//!   reading or writing;
//! - outputs overlap nothing but, exactly, the old state that they replace;
//! - a name is a null-terminated text, and at `message` `capacity` bytes may be written.

pub mod abaqus;
pub mod arguments;
pub mod blocks;
pub mod calculix;
mod card_variables;
pub mod constants;
pub mod entry_points;
pub mod environment;
pub mod frictional;
pub mod laws;
pub mod linear_elastic;
pub mod listed;
pub mod lsdyna;
pub mod mgis;
pub mod openradioss;
pub mod point_and_block;
pub mod points;
pub mod prepared;
mod structures;
pub mod tables;
pub mod units;

use crate::law::block::Precision;
use crate::law::frictional::Frictional;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::interface::Law;
use crate::law::linear_elastic::LinearElastic;
use crate::law::user::{User, UserMaterial, check_tables};

/// A law by its name, without a precision: a [`UserMaterial`], or a law of the library.
pub trait Material<T: Precision> {
    /// The law in this precision.
    type Law: Law<T>;
    /// Does not compile where the tables of a law do not fit its types.
    const TABLES_FIT: () = ();
}

impl<M: UserMaterial, T: Precision> Material<T> for M {
    type Law = User<M, T>;
    const TABLES_FIT: () = check_tables::<M>();
}

impl<T: Precision> Material<T> for Hyperelastic<f64> {
    type Law = Hyperelastic<T>;
}

impl<T: Precision> Material<T> for Frictional<f64> {
    type Law = Frictional<T>;
}

impl<T: Precision> Material<T> for LinearElastic<f64> {
    type Law = LinearElastic<T>;
}

/// A law whose points every host evaluates by [`Law::step`] alone: with this it is a law of every host. The
/// hyperelastic law has kernels of one point instead, and the hosts of the linear elastic one are compiled in this
/// crate.
pub trait ByStep {}

impl<M: UserMaterial, T: Precision> ByStep for User<M, T> {}
impl<T: Precision> ByStep for Frictional<T> {}

/// Whether a law may have this name in a library: capitals, digits and underscores, a capital first. Symbols are made
/// of it.
pub const fn is_name(name: &str) -> bool {
    let (name, mut i) = (name.as_bytes(), 0);
    while i < name.len() {
        let capital = name[i].is_ascii_uppercase();
        if !capital && (i == 0 || !(name[i].is_ascii_digit() || name[i] == b'_')) {
            return false;
        }
        i += 1;
    }
    !name.is_empty()
}

/// Whether there is a `/MAT/USERnn` of this number in OpenRadioss.
pub const fn is_number(number: i32) -> bool {
    0 < number && number < 100
}
