//! Which speed of what has gone through a run tells.

use toron_explicit_host::struck::run::End;

/// What the speed at the end of a run is where what strikes goes through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpeedIs {
    /// Nothing takes much of it any more.
    Residual,
    /// As it was when it was certain that it goes through; what touches it still may take more.
    AtDecision,
    /// That was certain, and the time was over while something still took much of it.
    NotSettled,
}

impl SpeedIs {
    pub const ALL: [SpeedIs; 3] = [SpeedIs::Residual, SpeedIs::AtDecision, SpeedIs::NotSettled];

    /// Of a run that ended so, and that was to go on behind its decision or not; none where what strikes has neither
    /// gone through nor been stopped.
    pub fn of(end: End, settles: bool) -> Option<SpeedIs> {
        match end {
            End::Stopped | End::Left | End::Settled => Some(SpeedIs::Residual),
            End::Decided if settles => Some(SpeedIs::NotSettled),
            End::Decided => Some(SpeedIs::AtDecision),
            End::Time | End::Rebounded | End::Interrupted | End::Failed => None,
        }
    }

    pub fn name(self) -> &'static str {
        match self {
            SpeedIs::Residual => "residual",
            SpeedIs::AtDecision => "at the decision",
            SpeedIs::NotSettled => "not settled",
        }
    }
}
