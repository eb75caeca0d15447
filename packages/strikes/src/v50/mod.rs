//! `toron v50`: at which speed half of the shots go through, and how sure that is.
//!
//! Shots at a scene of [`fabric`](crate::fabric) or [`impact`](crate::impact) differ in speed, in the point of impact
//! and in the strength of the yarns. The statistics of what comes of them know nothing of scenes. `docs/guides/v50.md`
//! is the manual.

mod analysis;
pub mod command;
mod comparison;
pub mod curve;
mod curves_plot;
mod curves_report;
pub mod designs;
mod difference;
pub mod lambert_jonas;
mod likelihood;
mod limit;
pub mod link;
pub mod measured;
mod plot;
#[cfg(test)]
mod published;
mod records;
mod report;
mod run;
pub mod scene;
mod search;
mod series;
mod shot;
pub mod simulation;
pub mod test_houses;
