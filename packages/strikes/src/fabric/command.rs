//! `toron fabric`: from the file of a scene to its histories and table.

use std::path::Path;

use super::fate::Fate;
use super::judgement::before;
use super::measure::OfPanel;
use super::run::{Outcome, StruckPanel};
use super::scene::{Case, Scene};
use super::summary::{self, Figures};
use super::{panel_picture, plot, report};
use crate::weave;
use toron::host::units::UnitSystem;
use toron_explicit_host::judgement::{Finding, verdict};
use toron_explicit_host::struck::command;
use toron_explicit_host::struck::history::Column;
use toron_explicit_host::struck::summary::Cells;
use toron_materials::material::laws::Laws;
use toron_shared::console::print_error;
use toron_shared::error::Error;
use toron_shared::file_names::{PANEL, STEPS};

/// Runs the cases of a scene, one after another, and writes what came of them to the directory `output`. With
/// `restart`, cases go on from their checkpoints there.
///
/// # Errors
/// As for [`command::run`].
pub fn run(laws: Laws, path: &Path, output: &Path, restart: bool) -> Result<(), Error> {
    command::run(&Scene::read_with(laws, path)?, path, output, restart)
}

/// `toron weave`: the panel of a weave, or of a strike, whose yarns are those of its first case.
///
/// # Errors
/// As for [`weave::command::run`].
pub fn weave(path: &Path, output: &Path) -> Result<(), Error> {
    let mut scene = weave::reader::Scene::read(path)?;
    if scene.is_struck && scene.materials.is_empty() {
        match Scene::read(path) {
            Ok(strike) => scene.materials = strike.cases.first().map_or(Vec::new(), Case::of_plies),
            // A strike that cannot be run yet has a mesh all the same.
            Err(error) => print_error(&format!("warning: the yarns' materials are not known: {error}\n")),
        }
    }
    weave::command::run(&scene, path, output)
}

impl command::Scene for Scene {
    const COMMAND: &'static str = "fabric";
    const PARALLEL: bool = false;

    type Own = OfPanel;
    type Course = Fate;
    type Struck<'a> = StruckPanel<'a>;
    type Result<'a> = (&'a Case, Outcome, Figures);

    fn units(&self) -> &UnitSystem {
        &self.units
    }

    fn cases(&self) -> usize {
        self.cases.len()
    }

    fn case(&self, number: usize) -> Result<StruckPanel<'_>, Error> {
        StruckPanel::new(&self.cases[number])
    }

    fn columns() -> Vec<Column<OfPanel>> {
        summary::columns()
    }

    fn before(&self, StruckPanel { case, panel, .. }: &StruckPanel<'_>) -> Vec<Finding> {
        before(&self.units, case, panel)
    }

    fn finish<'a>(
        &'a self,
        StruckPanel { case, panel, .. }: StruckPanel<'a>,
        outcome: Outcome,
        output: &Path,
    ) -> Result<Self::Result<'a>, Error> {
        let file = |ending: &str| output.join(format!("{}{ending}", case.name));
        let figures = Figures::of(&self.units, case, &panel, &outcome);
        let verdict = verdict(&figures.findings);
        summary::write_steps(&file(&format!("{STEPS}.csv")), &outcome.histogram)?;
        plot::write(&file(".svg"), &file(".png"), self, case, &outcome, &verdict)?;
        for (number, snapshot) in outcome.snapshots.iter().enumerate() {
            let [svg, png] = ["svg", "png"].map(|ending| file(&format!("{PANEL}{}.{ending}", number + 1)));
            panel_picture::write(&svg, &png, (self, case, &verdict), &panel, snapshot)?;
        }
        Ok((case, outcome, figures))
    }

    fn line(&self, (case, outcome, figures): &Self::Result<'_>) -> Cells {
        summary::line(&self.units, case, outcome, figures)
    }

    fn report(&self, results: &[Self::Result<'_>], output: &Path) -> Result<String, Error> {
        Ok(report::report(self, results, output))
    }
}
