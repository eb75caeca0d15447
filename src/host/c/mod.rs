//! The C interface of the laws themselves, for drivers and solvers of any language. Package `toron-c` exports these functions
//! under their C names and documents their arguments.
//!
//! | convention | |
//! |---|---|
//! | deformation gradient | 9 values by columns: F11 F21 F31 F12 F22 F32 F13 F23 F33 |
//! | stress | Cauchy, 11 22 33 12 23 31 |
//! | energies | per reference volume |
//! | status | 0 is success, negative an error; outputs are untouched if the call itself is wrong (−1xx, −2xx) |
//! | arrays | the caller's; read and written during the call only, never kept |
//!
//! Every function may be called from any thread at any time.

mod about;
mod blocks;
mod constants;
mod linear_elastic;
mod points;
mod tables;
mod tangents;

pub(super) use points::PointAnswer;

pub use about::*;
pub use blocks::*;
pub use constants::*;
pub use linear_elastic::*;
pub use points::*;
pub use tables::*;
pub use tangents::*;
