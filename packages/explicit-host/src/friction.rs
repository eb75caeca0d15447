//! Coulomb's friction at a point of contact.

use super::vector::{Vector, add, dot, times};

/// Friction at a point of contact, at the end of a step.
#[derive(Clone, Copy, Debug)]
pub struct Friction {
    /// In the tangent plane, against the slip.
    pub force: Vector,
    /// The energy of the spring.
    pub stored: f64,
    /// What the step has dissipated.
    pub dissipated: f64,
}

/// From the force at the step's start to that at its end, after a motion `slip` of the point against what it touches.
///
/// Sticking is a spring of this stiffness in the tangent plane; it slips where the force would be larger than `limit`,
/// which is 0 where nothing touches any more. What is dissipated is the force's work over the step, by the trapezoidal
/// rule of central differences, less what the spring has gained.
#[inline(always)]
pub fn coulomb_return(before: Vector, stiffness: f64, slip: Vector, normal: Vector, limit: f64) -> Friction {
    let trial = add(before, -stiffness, slip);
    let trial = add(trial, -dot(trial, normal), normal);
    let size = dot(trial, trial).sqrt();
    let force = if size > limit { times(limit / size, trial) } else { trial };
    let per_stiffness = 0.5 / stiffness;
    let (held, stored) = (per_stiffness * dot(before, before), per_stiffness * dot(force, force));
    let work = -0.5 * (dot(before, slip) + dot(force, slip));
    Friction { force, stored, dissipated: work - (stored - held) }
}
