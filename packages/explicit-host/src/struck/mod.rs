//! A struck scene, whatever is struck: the loop from the first step to the last, checkpoints, histories, the figures of
//! a blow, and the command that runs a scene's cases.

pub mod blow;
pub mod checkpoint;
pub mod command;
pub mod history;
pub mod pace;
pub mod plan;
pub mod run;
pub mod sample;
pub mod summary;
