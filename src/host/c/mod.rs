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
