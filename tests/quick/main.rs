//! The yarn law and its tangents against exact arithmetic and the derivative of its energy: what to run after every
//! change of a formula.

mod energy;
mod tangent;
mod truth;
