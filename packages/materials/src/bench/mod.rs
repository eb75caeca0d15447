//! `toron bench`: what the law costs by point, on its own and through the hosts' entries.

pub mod choices;
pub mod command;
pub mod entries;
pub mod friction;
pub mod hosts;
pub mod own_law;
pub mod parallel;
pub mod scene;
pub mod timing;
