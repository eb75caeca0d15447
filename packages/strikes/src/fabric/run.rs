//! A panel as it is struck: its solver, what is measured of it, and when the striker has gone through.

use super::fate::{self, Fate};
use super::measure::{AtRest, OfPanel, Sample};
use super::scene::Case;
use super::solver::{self, share};
use crate::weave::model::Model;
use toron_explicit_host::lanes::Number;
use toron_explicit_host::solver::Solver;
use toron_explicit_host::struck::plan::Plan;
use toron_explicit_host::struck::run::{self, Struck};
pub use toron_explicit_host::struck::run::{Decision, End};
use toron_shared::error::Error;

/// What came of a case.
pub type Outcome = run::Outcome<OfPanel, Fate>;

/// A case with its mesh.
pub struct StruckPanel<'a> {
    pub case: &'a Case,
    pub panel: Model,
    at_rest: Vec<AtRest>,
}

impl<'a> StruckPanel<'a> {
    /// # Errors
    /// As for [`solver::check`].
    pub fn new(case: &'a Case) -> Result<Self, Error> {
        let panel = case.cloth.model();
        solver::check(case, &panel)?;
        let at_rest = AtRest::of(&panel);
        Ok(StruckPanel { case, panel, at_rest })
    }
}

impl Struck for StruckPanel<'_> {
    type Own = OfPanel;
    type Course = Fate;

    fn name(&self) -> &str {
        &self.case.name
    }

    fn plan(&self) -> &Plan {
        &self.case.plan
    }

    fn single_precision(&self) -> bool {
        self.case.single_precision
    }

    fn identity(&self) -> String {
        format!("{:?}", Case { plan: Plan::default(), ..self.case.clone() })
    }

    fn solver<T: Number>(&self) -> Result<Solver<T>, Error> {
        let mut solver = solver::build(self.case, &self.panel)?;
        // The balance keeps the energies with which elements are deleted.
        solver.all_outputs = solver.media.iter().any(|medium| medium.fails);
        Ok(solver)
    }

    fn radius(&self) -> f64 {
        self.case.striker.radius
    }

    fn sample<T: Number>(&self, solver: &Solver<T>, start: f64) -> Sample {
        let [_, height] = self.case.cloth.yarn_heights();
        let own = OfPanel::of(&self.panel, &self.at_rest, solver, height);
        Sample { own, ..Sample::of(solver, 1.0 / share(self.case), start) }
    }

    fn follow<T: Number>(&self, solver: &Solver<T>, course: &mut Fate) -> Result<(), Error> {
        if self.case.plan.decides {
            course.follow(&self.panel, solver, &self.case.striker, self.case.speed);
        }
        Ok(())
    }

    fn is_decided(&self, course: &Fate) -> bool {
        course.is_decided()
    }

    fn has_settled(&self, course: &Fate) -> bool {
        course.has_settled(&self.case.striker)
    }

    /// The striker has gone its own radius since something touched it last, or since the beginning, where it stands at
    /// the panel; and no yarn is left ahead, as the next ply may be.
    fn has_left<T: Number>(&self, solver: &Solver<T>, _course: &Fate, free: f64) -> bool {
        let striker = &self.case.striker;
        solver.striker.as_ref().is_some_and(|moving| free * -moving.velocity > striker.radius)
            && !fate::anything_ahead(&self.panel, solver, striker)
    }
}
