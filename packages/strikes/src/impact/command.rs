//! `toron impact`: from the file of a scene to its histories, pictures and table.

use std::path::Path;

use super::outcome::{Course, OfYarn, Outcome};
use super::run::StruckYarn;
use super::scene::{Case, Scene};
use super::{judgement, plot, report, summary, yarn_picture};
use toron::host::units::UnitSystem;
use toron_explicit_host::judgement::{Finding, verdict};
use toron_explicit_host::struck::command;
use toron_explicit_host::struck::history::Column;
use toron_explicit_host::struck::run;
use toron_explicit_host::struck::summary::Cells;
use toron_materials::material::laws::Laws;
use toron_shared::error::Error;
use toron_shared::file_names::{STRAINS, YARN};

/// The plot of all cases.
const COMPARISON: [&str; 2] = ["residual-speed.svg", "residual-speed.png"];

/// Runs the cases of a scene, of a program with these laws, and writes what came of them to the directory `output`.
/// With `restart`, cases go on from their checkpoints there.
///
/// # Errors
/// As for [`command::run`].
pub fn run(laws: Laws, path: &Path, output: &Path, restart: bool) -> Result<(), Error> {
    command::run(&Scene::read_with(laws, path)?, path, output, restart)
}

impl command::Scene for Scene {
    const COMMAND: &'static str = "impact";
    const COMMON: &'static [&'static str] = &COMPARISON;
    const PARALLEL: bool = true;

    type Own = OfYarn;
    type Course = Course;
    type Struck<'a> = StruckYarn<'a>;
    type Result<'a> = (&'a Case, Outcome);

    fn units(&self) -> &UnitSystem {
        &self.units
    }

    fn cases(&self) -> usize {
        self.cases.len()
    }

    fn case(&self, number: usize) -> Result<StruckYarn<'_>, Error> {
        StruckYarn::new(&self.cases[number])
    }

    fn columns() -> Vec<Column<OfYarn>> {
        summary::columns()
    }

    fn before(&self, yarn: &StruckYarn<'_>) -> Vec<Finding> {
        judgement::before(&self.units, yarn.case)
    }

    fn finish<'a>(
        &'a self,
        yarn: StruckYarn<'a>,
        outcome: run::Outcome<OfYarn, Course>,
        output: &Path,
    ) -> Result<(&'a Case, Outcome), Error> {
        let (case, result) = (yarn.case, yarn.outcome(outcome));
        let file = |ending: &str| output.join(format!("{}{ending}", case.name));
        let verdict = verdict(&judgement::judge(&self.units, case, &result));
        plot::write_history(&file(".svg"), &file(".png"), self, case, &result, &verdict)?;
        for (number, snapshot) in result.snapshots.iter().enumerate() {
            let [svg, png] = ["svg", "png"].map(|ending| file(&format!("{YARN}{}.{ending}", number + 1)));
            yarn_picture::write(&svg, &png, (self, case, &verdict), &result, snapshot)?;
            let strains = file(&format!("{STRAINS}{}.csv", number + 1));
            summary::write_strains(&strains, result.strains(snapshot))?;
        }
        Ok((case, result))
    }

    fn line(&self, (case, result): &(&Case, Outcome)) -> Cells {
        summary::line(&self.units, case, result)
    }

    fn report(&self, results: &[(&Case, Outcome)], output: &Path) -> Result<String, Error> {
        if let Some(abscissa) = self.abscissa {
            let [svg, png] = COMPARISON.map(|name| output.join(name));
            plot::write_comparison(&svg, &png, self, abscissa, results)?;
        }
        Ok(report::report(self, results, output))
    }
}
