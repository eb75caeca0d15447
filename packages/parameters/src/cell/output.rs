//! The files of figures: a table of energies a load, and the file that the identification reads.

use std::fmt::Write;
use std::path::Path;

use super::energies::Increment;
use super::model::Model;
use super::run::Outcome;
use super::scene::{Arrangement, Load, Scene};
use crate::identify::written::{DEVIATION, Fibre, RANDOM_DEVIATION, Set, Written};
use toron::law::parameters::STRESS;
use toron_materials::units::unit;
use toron_shared::error::Error;

/// Writes a file.
///
/// # Errors
/// It cannot be written.
pub fn write(file: &Path, text: &str) -> Result<(), Error> {
    std::fs::write(file, text).map_err(|error| Error::Input(format!("{}: {error}", file.display())))
}

/// The table of a load. A box of rows has columns for what lies outside its middle, a random one for where the work has
/// gone.
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

/// The file that `toron fit` reads.
pub fn fit_file(scene: &Scene, model: &Model, outcomes: &[Outcome]) -> String {
    let volume_fraction = volume_fraction(scene, model);
    let solver = if scene.explicit { "the explicit host" } else { "CalculiX" };
    let source = scene.yarn.source.clone().unwrap_or_else(|| format!("{}: fibres in {solver}", scene.title));
    let set = |outcome: &Outcome| Set {
        name: outcome.load.name().to_string(),
        loading: if outcome.load == Load::Compaction { "compaction" } else { "compression" },
        abscissa: None,
        columns: Vec::new(),
        range: None,
        deviation: Some([
            outcome.increments.iter().fold(0.0, |largest: f64, increment| largest.max(increment.energy)),
            if scene.arrangement.is_random() { RANDOM_DEVIATION } else { DEVIATION },
        ]),
    };
    let modulus = scene.fibre.e_1;
    let written = Written {
        title: &scene.title,
        units: &scene.units,
        name: &scene.yarn.name,
        source: &source,
        density: scene.fibre.density.map(|density| density * volume_fraction),
        fibre: scene.fibre.strain_at_failure.map(|strain_at_failure| Fibre {
            modulus,
            volume_fraction,
            strain_at_failure,
        }),
        sets: outcomes.iter().map(set).collect(),
    };
    written.text()
}
