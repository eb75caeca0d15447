//! The constitutive laws, independent of any host program. They access no files, allocate nothing and need no standard
//! library.

pub mod acoustic;
pub(crate) mod axes;
pub mod block;
pub mod bounds;
pub(crate) mod derivative;
pub mod description;
pub(crate) mod differentiated;
pub(crate) mod error;
pub(crate) mod failure;
pub mod frictional;
pub(crate) mod frictional_tangent;
pub mod hyperelastic;
pub mod interface;
pub(crate) mod kinematics;
pub mod linear_elastic;
pub(crate) mod linear_tangent;
pub(crate) mod number;
pub(crate) mod own;
pub mod parameters;
pub(crate) mod point;
pub(crate) mod preparation;
pub mod prepared;
pub mod resistance;
pub(crate) mod response;
pub mod state;
pub mod status;
pub mod stress;
pub(crate) mod tangent;
#[cfg(test)]
mod tests;
pub mod thesis;
pub mod user;
pub mod voigt;
pub mod wave_bounds;
pub mod wave_speed;
