//! `toron eval`: points as JSON through any of the C entries.

pub mod command;
pub mod polar;
pub mod push_forward;
