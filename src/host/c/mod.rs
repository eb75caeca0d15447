//! The C interface of the laws themselves, for drivers and solvers of any language. Package `toron-c` exports these functions
//! under their C names and documents their arguments.
//!
//! | convention | |
//! |---|---|
//! | deformation gradient | 9 values by columns: F11 F21 F31 F12 F22 F32 F13 F23 F33 |
//! | stress | Cauchy, 11 22 33 12 23 31 |
//! | energies | per reference volume |
//! | status | 0 is success, negative an error; outputs are untouched if the call itself is wrong (−1xx, −2xx) |
//! | structures | begin with their size; 0 is what is left out |
//! | message | the last two arguments: a buffer and its size, or null and 0; written only if there is an error |
//! | arrays | the caller's; read and written during the call only, never kept |
//!
//! Every function may be called from any thread at any time.
//!
//! # What a caller promises
//!
//! What is null is passed over or refused; of a pointer that is not, each function has to believe, while it runs:
//!
//! - a structure that begins with its size has as many bytes as it says, a prepared law is a whole structure of its type, prepared or
//!   not, and in what a function prepares, `size` bytes may be written;
//! - an array has as many values as its argument or field says, in the layout that the structure says, valid for reading or writing;
//! - outputs overlap nothing but, exactly, the old state that they replace;
//! - a name is a null-terminated text, and at `message` `capacity` bytes may be written.

mod about;
mod arguments;
mod blocks;
mod constants;
mod linear_elastic;
mod listed;
mod points;
mod prepared;
mod tables;

pub(super) use arguments::level;
pub(super) use points::PointAnswer;

pub use about::*;
pub use arguments::Layout;
pub use blocks::*;
pub use constants::*;
pub use linear_elastic::*;
pub use listed::*;
pub use points::*;
pub use prepared::*;
pub use tables::*;
