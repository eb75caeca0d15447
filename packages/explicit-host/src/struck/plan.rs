//! What a case is going to do and to write.

use serde::{Deserialize, Serialize};

use super::run::ROUNDING;

/// A restart may change all of it but for the time between samples.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Plan {
    pub end: f64,
    /// Steps divide the time up to the next multiple of this, rather than up to the end: a run that may last longer has
    /// the same ones.
    pub steps_to: Option<f64>,
    /// Whether the run goes on when what strikes turns back.
    pub rebounds: bool,
    /// Whether the run ends as soon as it is certain that what strikes goes through.
    pub decides: bool,
    /// Whether it goes on after that, until what still acts on it takes little of its speed.
    pub settles: bool,
    /// Time between two samples of the history.
    pub sample: f64,
    /// When what is struck is drawn.
    pub pictures: Vec<f64>,
    /// How many files ParaView gets after the first.
    pub frames: usize,
    /// How many times the run writes what it takes to go on from there.
    pub checkpoints: usize,
}

impl Plan {
    /// Up to when the steps after this time divide what is left.
    pub fn next_mark(&self, time: f64) -> f64 {
        self.steps_to.map_or(self.end, |interval| interval * ((time / interval + ROUNDING).floor() + 1.0))
    }

    /// The time between two files for ParaView.
    pub fn between_frames(&self) -> f64 {
        self.end / self.frames.max(1) as f64
    }

    pub fn between_checkpoints(&self) -> f64 {
        self.end / self.checkpoints.max(1) as f64
    }
}
