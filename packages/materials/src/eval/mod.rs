//! `toron eval`: points as JSON through any of the C entries; and for a law of one's own, without them.

pub mod command;
pub mod frictional;
mod lines;
pub mod own_law;
pub mod polar;
pub mod push_forward;
mod through;
