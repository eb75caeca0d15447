//! LS-DYNA: the folder of a run with its text files glstat, rbdout, nodout, rcforc and matsum.
//!
//! Not compared with a run: LS-DYNA was not at hand. Numbers are found by the names before them, as the public manuals
//! print them.

use std::path::Path;

use super::history::{Curve, History, Quantity, direction};
use toron_shared::error::Error;

/// One of these is in a folder of a run.
pub const FILES: [&str; 5] = ["glstat", "rbdout", "nodout", "rcforc", "matsum"];

/// Components along x, y and z.
type Vectors = [Curve; 3];

/// # Errors
/// No energies, no speed of the striker, or a number that is none.
pub fn read(folder: &Path, name: String) -> Result<History, Error> {
    let text =
        |file: &str| std::fs::read(folder.join(file)).map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).ok();
    let missing = |what: &str| {
        let files = FILES.join(", ");
        Error::Input(format!("{}: no {what}; allowed: a folder with {files} of one run", folder.display()))
    };
    let glstat = text("glstat").ok_or_else(|| missing("glstat"))?;
    let velocities = match (text("rbdout"), text("matsum")) {
        (Some(rbdout), _) => rigid_body(&rbdout),
        (None, Some(matsum)) => fastest(&matsum),
        (None, None) => return Err(missing("rbdout")),
    };
    let starts = [0, 1, 2].map(|i| velocities[i].values.first().copied().unwrap_or_default());
    let (axis, sign) =
        direction(starts).ok_or_else(|| missing("speed of a rigid body at the start in rbdout or matsum"))?;
    let mut history = History::new("LS-DYNA", name);
    history.set(Quantity::Speed, velocities[axis].map(|speed| sign * speed));
    history.set(Quantity::Deflection, text("nodout").map(|nodout| node(&nodout, axis).map(|way| sign * way)));
    history.set(Quantity::Force, text("rcforc").map(|rcforc| contact(&rcforc, axis)));
    let named = |name: &str| global(&glstat, name);
    let energy = |name: &str| Some(named(name)).filter(|curve| !curve.times.is_empty());
    history.split_kinetic(&energy("kinetic energy").ok_or_else(|| missing("kinetic energy in glstat"))?);
    history.set(Quantity::Internal, energy("internal energy"));
    history.set(Quantity::Hourglass, energy("hourglass energy"));
    // Friction is a part of it.
    history.set(Quantity::Contact, energy("sliding interface energy"));
    history.set(Quantity::Total, energy("total energy"));
    let eroded = ["eroded kinetic energy", "eroded internal energy"].map(|name| named(name).first(|lost| lost != 0.0));
    history.failed = eroded.into_iter().flatten().reduce(f64::min);
    Ok(history)
}

/// A line of glstat: `kinetic energy.................   1.74419E+03`.
fn global(text: &str, name: &str) -> Curve {
    let mut points = Vec::new();
    let mut time = None;
    for line in text.lines() {
        let Some((title, value)) = line.split_once("..") else { continue };
        let value = value.trim_start_matches('.').split_whitespace().next().and_then(number);
        match title.trim() {
            "time" => time = value,
            title if title == name => points.extend(time.zip(value)),
            _ => {}
        }
    }
    Curve::new(points)
}

/// The first velocities behind each time of rbdout are those of the first rigid body in global axes.
fn rigid_body(text: &str) -> Vectors {
    let mut points = Vec::new();
    let mut time = None;
    for line in text.lines() {
        if let Some((_, value)) = line.split_once("time=") {
            time = number(value.trim());
        } else if let Some(values) = line.trim_start().strip_prefix("velocities:") {
            points.extend(time.take().zip(three(values)));
        }
    }
    vectors(&points)
}

/// The velocities of the fastest rigid body of matsum at its first time, which only a rigid body has.
fn fastest(text: &str) -> Vectors {
    let mut states: Vec<(f64, Vec<[f64; 3]>)> = Vec::new();
    for line in text.lines() {
        if let Some(value) = line.trim_start().strip_prefix("time =") {
            states.extend(number(value.trim()).map(|time| (time, Vec::new())));
        } else if line.trim_start().starts_with("x-rbv=") {
            let values = three(&line.replace("x-rbv=", " ").replace("y-rbv=", " ").replace("z-rbv=", " "));
            if let (Some((_, bodies)), Some(values)) = (states.last_mut(), values) {
                bodies.push(values);
            }
        }
    }
    let speed = |velocity: &[f64; 3]| velocity.iter().fold(0.0, |speed: f64, component| speed.max(component.abs()));
    let body = states
        .first()
        .and_then(|(_, bodies)| (0..bodies.len()).max_by(|&a, &b| speed(&bodies[a]).total_cmp(&speed(&bodies[b]))));
    let points: Vec<(f64, [f64; 3])> =
        states.iter().filter_map(|(time, bodies)| Some((*time, *bodies.get(body?)?))).collect();
    vectors(&points)
}

/// The displacement of the first node of nodout: numbers of 12 columns behind the node's.
fn node(text: &str, axis: usize) -> Curve {
    let mut points = Vec::new();
    let mut time = None;
    let mut follows = false;
    for line in text.lines() {
        if let Some((_, value)) = line.split_once("( at time") {
            time = value.split(')').next().and_then(|value| number(value.trim()));
        } else if line.contains("x-disp") {
            follows = true;
        } else if std::mem::take(&mut follows) {
            let field = line.get(10 + 12 * axis..22 + 12 * axis);
            points.extend(time.take().zip(field.and_then(|field| number(field.trim()))));
        }
    }
    Curve::new(points)
}

/// The size of the force on one side of the first contact, the striker's.
fn contact(text: &str, axis: usize) -> Curve {
    const SIDES: [&str; 4] = ["slave", "master", "surfa", "surfb"];
    let mut first: Option<(String, String)> = None;
    let mut points = Vec::new();
    for line in text.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [side, contact, "time", time, ..] = words[..] else { continue };
        if !SIDES.contains(&side.to_lowercase().as_str()) {
            continue;
        }
        let of = (side.to_string(), contact.to_string());
        if *first.get_or_insert_with(|| of.clone()) != of {
            continue;
        }
        let value = words.iter().position(|word| *word == ["x", "y", "z"][axis]).and_then(|at| words.get(at + 1));
        points.extend(number(time).zip(value.and_then(|value| number(value)).map(f64::abs)));
    }
    Curve::new(points)
}

fn vectors(points: &[(f64, [f64; 3])]) -> Vectors {
    [0, 1, 2].map(|i| Curve::new(points.iter().map(|&(time, vector)| (time, vector[i]))))
}

fn three(text: &str) -> Option<[f64; 3]> {
    let values: Vec<f64> = text.split_whitespace().map_while(number).take(3).collect();
    values.try_into().ok()
}

fn number(text: &str) -> Option<f64> {
    text.parse().ok().filter(|number: &f64| number.is_finite())
}
