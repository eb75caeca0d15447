//! What a section that changes its shape between walls says of its friction, µ = q/p_t − dI_tc/dI_td: see
//! [`crate::identify::sliding`].

use super::outcome::{Pressed, Sample};
use crate::fibres::scene::Walls;
use crate::identify::sliding::{Line, Mean, blocks, first_beyond, scatter};

/// Over so much of I_td states are averaged to find the largest q/p_t.
const WINDOW: f64 = 0.02;
/// The last part of I_td's rise, over which the critical state is averaged, and the parts whose scatter says how sure
/// that is.
const CRITICAL: f64 = 0.5;
const BLOCKS: usize = 5;

/// Means, and what was lost meanwhile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    pub mean: Mean,
    /// What friction and the brake have taken, over 2 p_t dI_td: µ, less what is stored meanwhile.
    pub lost: f64,
}

impl State {
    fn over(samples: &[Sample]) -> Option<State> {
        let lines: Vec<Line> = samples.iter().map(line).collect();
        let mean = Mean::over(&lines)?;
        let lost = |sample: &Sample| sample.friction + sample.damping;
        let pressed = mean.p_t * (mean.range[1] - mean.range[0]);
        Some(State { mean, lost: (lost(samples.last()?) - lost(samples.first()?)) / (2.0 * pressed) })
    }
}

/// Where q/p_t is largest, and the critical state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    pub peak: State,
    pub critical: State,
    /// The standard error of the critical state's µ by the scatter of its parts.
    pub error: f64,
}

impl Friction {
    /// None of a section that is pressed on all sides.
    pub fn of(result: &Pressed) -> Option<Friction> {
        if result.pressing.walls == Walls::AllSides {
            return None;
        }
        let samples = way(result);
        let lines: Vec<Line> = samples.iter().map(line).collect();
        let windows = (0..samples.len()).filter_map(|start| {
            let length = first_beyond(&lines[start..], lines[start].i_td + WINDOW)?;
            State::over(&samples[start..=start + length])
        });
        let peak = windows.max_by(|a, b| a.mean.ratio().total_cmp(&b.mean.ratio()))?;
        let begin = first_beyond(&lines, critical_range(result)?[0])?;
        let mus: Vec<f64> = blocks(&lines[begin..], BLOCKS).iter().map(Mean::mu).collect();
        Some(Friction { peak, critical: State::over(&samples[begin..])?, error: scatter(&mus)[1].sqrt() })
    }
}

/// The last part of I_td's rise.
pub fn critical_range(result: &Pressed) -> Option<[f64; 2]> {
    let samples = way(result);
    let [from, to] = [samples.first()?.strain[1], samples.last()?.strain[1]];
    Some([to - CRITICAL * (to - from), to])
}

fn line(sample: &Sample) -> Line {
    let &Sample { p_t, q, strain: [i_tc, i_td], .. } = sample;
    Line { p_t, q, i_tc, i_td }
}

/// The samples while walls close for the first time, from the one where they begin.
fn way(result: &Pressed) -> &[Sample] {
    let pressing = &result.pressing;
    let lines = (result.model.steps / result.model.sample) as usize;
    let first = (pressing.consolidation / result.model.sample) as usize;
    let last = first + (lines - first) / pressing.legs as usize;
    // The first sample is that at rest.
    result.samples.get(first..=last.min(result.samples.len().saturating_sub(1))).unwrap_or_default()
}
