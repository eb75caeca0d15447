//! What friction between the fibres costs a block beside the hyperelastic law.

use super::choices::Run;
use super::command::properties;
use super::hosts::whole;
use super::scene::Scene;
use crate::entries::aligned::Aligned;
use crate::entries::blocks::{SolverBlock, prepared_frictional};
use toron::law::state::{FRICTIONAL_LOST, FRICTIONAL_STATE};
use toron_shared::error::Error;

/// µ of the law that is measured, and a cohesion by which nothing slides.
const MU: f64 = 0.25;
const HELD: f64 = 1e20;
/// Both components of the slip where there is one, and the place of the first among the state variables.
const SLIP: f64 = 0.05;
const FIRST_SLIP: usize = FRICTIONAL_LOST + 2;

/// Whether the fibres of all points have slid before, and whether they may slide now.
#[derive(Clone, Copy)]
pub struct Fibres {
    pub have_slid: bool,
    pub slide: bool,
}

/// The C entry for blocks of the law with friction, whose old state is apart, so that every call does the same.
///
/// # Errors
/// The law cannot be prepared.
pub fn of_friction(fibres: Fibres, n: usize) -> Result<Run, Error> {
    let values = [properties(), &[MU, if fibres.slide { 0.0 } else { HELD }]].concat();
    let law = prepared_frictional(&values).map_err(Error::Evaluation)?;
    let mut scene = Scene::<f64>::impact(n);
    let stride = scene.leading_dimension;
    let mut old = Aligned::new(0.0, FRICTIONAL_STATE * stride);
    let mut state = Aligned::new(0.0, FRICTIONAL_STATE * stride);
    if fibres.have_slid {
        old[FIRST_SLIP * stride..(FIRST_SLIP + 2) * stride].fill(SLIP);
    }
    Ok(Box::new(move || {
        SolverBlock { state_old: Some(&old), ..whole(&mut scene, &mut state) }.call_frictional(&law);
        Ok(())
    }))
}
