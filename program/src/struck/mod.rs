//! A struck scene, whatever is struck: the keys that scenes have in common, the loop from the first step to the last,
//! checkpoints, histories, and the command that runs a scene's cases. [`impact`](crate::impact) strikes a yarn,
//! [`fabric`](crate::fabric) a panel.

pub mod blow;
pub mod checkpoint;
pub mod command;
pub mod history;
pub mod keys;
pub mod pace;
pub mod plan;
pub mod run;
pub mod sample;
pub mod shots;
pub mod summary;
pub mod zones;
