//! The yarn law against exact arithmetic and the derivative of its energy: what to run after every
//! change of a formula.

mod energy;
mod truth;
