//! The constitutive laws: no host, no file, no allocation, no standard library.

pub mod acoustic;
pub mod block;
pub mod elementary;
pub mod failure;
pub mod hyperelastic;
pub mod kinematics;
pub mod linear_elastic;
mod linear_tangent;
pub mod matrix;
pub mod parameters;
pub mod point;
pub mod real;
pub mod state;
pub mod status;
pub mod stress;
pub mod tangent;
pub mod wave_speed;
