//! The files of figures: a table of energies a load, and the file that the identification reads.

use std::fmt::Write;
use std::path::Path;

use super::energies::Increment;
use super::model::Model;
use super::run::Outcome;
use super::scene::{Arrangement, Load, Scene};
use crate::common::error::Error;
use crate::common::units::unit;
use toron::law::parameters::STRESS;

/// Writes a file.
///
/// # Errors
/// It cannot be written.
pub fn write(file: &Path, text: &str) -> Result<(), Error> {
    std::fs::write(file, text).map_err(|error| Error::Input(format!("{}: {error}", file.display())))
}

/// The table of a load. A box of rows has columns for what lies outside its middle, a random one for where the work has gone.
pub fn table(scene: &Scene, outcome: &Outcome) -> String {
    let stress = unit(&scene.units, STRESS);
    let boxed = matches!(scene.arrangement, Arrangement::Box(_)) && !scene.arrangement.is_random();
    let mut text = format!("I_tc (-),I_td (-),stretch (-),energy ({stress})");
    if scene.explicit {
        let _ = write!(text, ",work of the walls ({stress}),energy lost by friction ({stress})");
    }
    if boxed {
        let _ = write!(text, ",energy of the whole box ({stress})");
        if !scene.explicit {
            let _ = write!(text, ",energy of the springs ({stress})");
        }
    }
    text.push('\n');
    for Increment { stretch, invariants: [i_tc, i_td], energy, whole, springs, work, friction } in &outcome.increments {
        let _ = write!(text, "{i_tc:.8},{i_td:.8},{stretch:.8},{energy:.7e}");
        if scene.explicit {
            let _ = write!(text, ",{work:.7e},{friction:.7e}");
        }
        if boxed {
            let _ = write!(text, ",{whole:.7e}");
            if !scene.explicit {
                let _ = write!(text, ",{springs:.3e}");
            }
        }
        text.push('\n');
    }
    text
}

/// The fibres' part of the yarn: the file's, or the model's own.
pub fn volume_fraction(scene: &Scene, model: &Model) -> f64 {
    scene.yarn.volume_fraction.unwrap_or(model.fraction)
}

/// The energies' standard deviation, over the largest of a load: computed, they have no noise that could be estimated, and where
/// the law follows one load better than another this one would count for nothing.
const DEVIATION: f64 = 0.01;
/// Few fibres at random are one sample of many, and energy falls where some of them snap to another place.
const RANDOM_DEVIATION: f64 = 0.05;

/// The file that `toron fit` reads.
pub fn fit_file(scene: &Scene, model: &Model, outcomes: &[Outcome]) -> String {
    let fraction = volume_fraction(scene, model);
    let [length, mass, time] = scene.units.names();
    let solver = if scene.explicit { "the explicit host" } else { "CalculiX" };
    let source = scene.yarn.source.clone().unwrap_or_else(|| format!("{}: fibres in {solver}", scene.title));
    let mut text = format!(
        "title = {}\nunits = \"{length}-{mass}-{time}\"\n\n[yarn]\nname = {}\nsource = {}\n",
        quoted(&scene.title),
        quoted(&scene.yarn.name),
        quoted(&source)
    );
    if let Some(density) = scene.fibre.density {
        let _ = writeln!(text, "density = {}", rounded(density * fraction));
    }
    if let Some(strain) = scene.fibre.strain_at_failure {
        let _ = write!(
            text,
            "\n[fibre]\nmodulus = {}\nvolume_fraction = {}\nstrain_at_failure = {strain:?}\n",
            rounded(scene.fibre.e_1),
            rounded(fraction)
        );
    }
    for outcome in outcomes {
        let name = outcome.load.name();
        let loading = if outcome.load == Load::Compaction { "compaction" } else { "compression" };
        let largest = outcome.increments.iter().fold(0.0, |largest: f64, increment| largest.max(increment.energy));
        let part = if scene.arrangement.is_random() { RANDOM_DEVIATION } else { DEVIATION };
        let deviation = rounded(part * largest);
        let _ = write!(
            text,
            "\n[[data]]\nname = \"{name}\"\nfile = \"{name}.csv\"\nloading = \"{loading}\"\n\
             deviation = {deviation} # {:.0} % of the largest energy\n",
            100.0 * part
        );
    }
    text
}

/// A number of seven digits, as TOML has it.
fn rounded(value: f64) -> String {
    let digits = format!("{value:.6e}").parse::<f64>().unwrap_or(value);
    format!("{digits:?}")
}

/// A text of one line in quotes, as TOML has it.
fn quoted(text: &str) -> String {
    let escaped = text.chars().map(|c| match c {
        '"' | '\\' => format!("\\{c}"),
        c if c.is_control() => format!("\\u{:04X}", u32::from(c)),
        c => c.to_string(),
    });
    format!("\"{}\"", escaped.collect::<String>())
}
