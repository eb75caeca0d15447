//! The summary of a scene for the terminal.

use std::fmt::Write;
use std::path::Path;

use super::energies::Increment;
use super::model::Model;
use super::output::volume_fraction;
use super::run::{Outcome, Shares};
use super::scene::{Arrangement, Load, Packing, Scene};
use toron::law::parameters::STRESS;
use toron_materials::units::unit;
use toron_shared::numbers::number;
use toron_shared::text_table::{Column, or_dash, table};

/// Columns of a terminal.
const WIDTH: usize = 100;

/// The springs that hold free fibres may store this part of the fibres' energy, or they bear the load with them.
pub const LARGEST_SPRINGS: f64 = 1e-3;

/// The kinetic energy at the end may be this part of the strain energy, or fibres are still on their way.
pub const LARGEST_KINETIC: f64 = 0.02;

/// Areas, energies and where the files are.
pub fn report(scene: &Scene, model: &Model, outcomes: &[Outcome], output: &Path) -> String {
    let mut text = format!("{}\n\n", scene.title);
    areas(&mut text, scene, model);
    let _ = writeln!(text, "\n{}", energies(scene, outcomes));
    for outcome in outcomes {
        if let Some(increments) = outcome.refined {
            let _ = writeln!(
                text,
                "{}: with {} increments the fibres stored more than the walls had done work, which is no equilibrium:\n  \
                 run again with {increments}; increments = {increments} in [loads] begins with them",
                outcome.load.name(),
                scene.increments
            );
        }
    }
    for outcome in outcomes {
        if let Some(shares) = outcome.shares {
            losses(&mut text, outcome.load, shares);
            continue;
        }
        let share = largest_spring_share(outcome);
        if share > LARGEST_SPRINGS {
            let _ = writeln!(
                text,
                "warning: {}: the springs that hold free fibres store {:.2} % of the fibres' energy, more than {:.1} %",
                outcome.load.name(),
                100.0 * share,
                100.0 * LARGEST_SPRINGS
            );
        } else if !model.sprung.is_empty() {
            let name = outcome.load.name();
            let _ = writeln!(
                text,
                "{name}: springs that hold free fibres store up to {:.4} % of the fibres' energy",
                100.0 * share
            );
        }
    }
    let files = if scene.explicit { "the table" } else { "the table, the deck" };
    let _ = writeln!(text, "\nFiles in {}: {files} and the picture of each load", output.display());
    text
}

/// Where the work has gone in the explicit host.
fn losses(text: &mut String, load: Load, shares: Shares) {
    let Shares { kinetic, hourglass, friction, viscosity, contact, balance, steps } = shares;
    let percent = |share: f64| 100.0 * share;
    let name = load.name();
    let _ = writeln!(
        text,
        "{name}: of the walls' work friction took {:.1} %, viscosity and brake {:.1} %, contact holds {:.1} %; the balance is off by \
         {:.3} %. Of the fibres' energy hourglass modes hold {:.1} %, and {:.2} % is what they move with; {steps} steps",
        percent(friction),
        percent(viscosity),
        percent(contact),
        percent(balance),
        percent(hourglass),
        percent(kinetic),
    );
    if kinetic > LARGEST_KINETIC {
        let _ = writeln!(
            text,
            "warning: {name}: at the end the fibres still move, with {:.1} % of their strain energy; more than {:.0} %",
            percent(kinetic),
            percent(LARGEST_KINETIC)
        );
    }
}

fn areas(text: &mut String, scene: &Scene, model: &Model) {
    let length = scene.units.names()[0];
    let scale = scene.fibre.diameter;
    let quads: usize = model.bodies[..model.fibres].iter().map(|body| body.quads.len()).sum();
    let pieces = match scene.arrangement {
        Arrangement::Cell(Packing::Square) => "quarter of a fibre",
        Arrangement::Cell(Packing::Hexagonal) => "quarters of fibres",
        Arrangement::Box(_) => "fibres",
    };
    let [width, height] = model.size.map(|size| number(size * scale));
    let _ = writeln!(text, "{} {pieces} in {width} × {height} {length}, {quads} elements", model.fibres);
    if scene.arrangement == Arrangement::Cell(Packing::Square) && scene.friction > 0.0 {
        let _ = writeln!(text, "friction does not act: by symmetry nothing slides in a square packing");
    }
    let area = number(model.middle_area * scale * scale);
    let of_middle = if model.mirrored || scene.arrangement.is_random() {
        String::new()
    } else {
        format!(" of the middle's {} fibres", model.middle.len())
    };
    let fraction = volume_fraction(scene, model);
    let _ = writeln!(
        text,
        "reference area{of_middle}, voids included: {area} {length}²; fibres' part of it {:.4}",
        model.fraction
    );
    let _ =
        writeln!(text, "over the fibres' own area the energies would be those below times {:.4}", 1.0 / model.fraction);
    if (fraction - model.fraction).abs() > 1e-9 {
        let _ = writeln!(text, "over a yarn's with the fraction {fraction}: times {:.4}", fraction / model.fraction);
    }
}

/// The last increment of each load.
fn energies(scene: &Scene, outcomes: &[Outcome]) -> String {
    let stress = unit(&scene.units, STRESS);
    let boxed = matches!(scene.arrangement, Arrangement::Box(_)) && !scene.arrangement.is_random();
    let last: Vec<_> = outcomes.iter().filter_map(|outcome| Some((outcome, outcome.increments.last()?))).collect();
    let column = |above: &str, below: &str, entry: &dyn Fn(&Outcome, &Increment) -> String| Column {
        heading: [above.to_string(), below.to_string()],
        entries: last.iter().map(|(outcome, increment)| entry(outcome, increment)).collect(),
    };
    let columns = vec![
        column("load", "", &|outcome, _| outcome.load.name().to_string()),
        column("I_tc", "-", &|_, last| format!("{:.4}", last.invariants[0])),
        column("I_td", "-", &|_, last| format!("{:.4}", last.invariants[1])),
        column("energy", &stress, &|_, last| number(last.energy)),
        column("whole box", &stress, &|_, last| or_dash(boxed.then_some(last.whole), number)),
        column("run", "s", &|outcome, _| format!("{:.1}", outcome.elapsed.as_secs_f64())),
    ];
    table(columns, WIDTH)
}

/// The largest part of the fibres' energy that the springs have, from the load's middle on: before, there is hardly
/// any.
pub fn largest_spring_share(outcome: &Outcome) -> f64 {
    let later = &outcome.increments[outcome.increments.len() / 2..];
    later.iter().map(|increment| increment.springs / increment.whole).fold(0.0, f64::max)
}

/// What a load is, for titles.
pub fn title(load: Load) -> &'static str {
    match load {
        Load::Compaction => "compaction, all sides alike",
        Load::AlongRows => "compression along the rows",
        Load::AcrossRows => "compression across the rows",
    }
}
