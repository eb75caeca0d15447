//! The arguments of `--deck`, and the files that it writes.

use std::fs::File;
use std::io::{self, BufWriter};
use std::path::Path;

use clap::{Args, ValueEnum};
use toron::host::units::UnitSystem;

use super::model::{Conversion, Model};
use super::{abaqus, ls_dyna, of_fabric, of_impact, openradioss};
use crate::{fabric, impact, weave};
use toron_explicit_host::judgement::warnings;
use toron_materials::deck::openradioss::FibreFrom;
use toron_shared::console::{print, print_error};
use toron_shared::error::Error;
use toron_shared::kept_file;
use toron_shared::numbers::number;
use toron_shared::run_directory::{RunDirectory, Writes};
use toron_shared::text_table::of_cases;

/// Columns of a terminal.
const WIDTH: usize = 129;

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Host {
    Openradioss,
    LsDyna,
    AbaqusExplicit,
}

#[derive(Args, Clone, Debug)]
pub struct Arguments {
    /// Write the scene as the whole deck of this solver, instead of running it.
    #[arg(long = "deck", value_name = "HOST", value_enum)]
    pub host: Option<Host>,
    /// The deck's units, for instance mm-tonne-s; without it, the scene's.
    #[arg(long, requires = "host")]
    units: Option<String>,
    /// The number of the first node, element, part, set, ...; those of a deck follow it.
    #[arg(long, requires = "host", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=90_000_000))]
    first_id: u32,
    /// What names of files, parts and sets begin with.
    #[arg(long, requires = "host", default_value = "")]
    prefix: String,
    /// OpenRadioss: where each element's fibre direction comes from; without it, from its nodes, or of a straight yarn
    /// from the card.
    #[arg(long, requires = "host", value_enum)]
    fibre_from: Option<FibreFrom>,
}

/// A scene, as its command was given it.
struct Given<'a> {
    command: &'static str,
    path: &'a Path,
    title: &'a str,
    /// The names of its cases.
    cases: Vec<&'a str>,
}

/// A model, and what is known of it before it is run.
struct Known {
    model: Model,
    weights: String,
    /// As they are printed.
    warnings: String,
}

/// What the writers take besides the model.
#[derive(Clone, Debug)]
pub struct Naming {
    /// The least number of every kind.
    pub first: u32,
    pub prefix: String,
    /// Of OpenRadioss.
    pub fibre_from: Option<FibreFrom>,
}

/// The decks of a scene of `toron fabric`.
///
/// # Errors
/// The input, an argument, or a file that cannot be written.
pub fn fabric(path: &Path, output: &Path, host: Host, arguments: &Arguments) -> Result<(), Error> {
    let scene = fabric::scene::Scene::read(path)?;
    let conversion = arguments.conversion(scene.units)?;
    let known = scene.cases.iter().map(|case| {
        let panel = case.cloth.model();
        let found = fabric::judgement::before(&scene.units, case, &panel);
        Ok(Known {
            model: of_fabric::of_case(case, &panel, conversion)?,
            weights: fabric::weights::text(&scene.units, case, &panel),
            warnings: warnings([(case.name.as_str(), &found[..])]),
        })
    });
    let cases = scene.cases.iter().map(|case| case.name.as_str()).collect();
    arguments.write(known, &Given { command: "fabric", path, title: &scene.title, cases }, host, output)
}

/// The decks of a scene of `toron impact`.
///
/// # Errors
/// The input, an argument, or a file that cannot be written.
pub fn impact(path: &Path, output: &Path, host: Host, arguments: &Arguments) -> Result<(), Error> {
    let scene = impact::scene::Scene::read(path)?;
    let conversion = arguments.conversion(scene.units)?;
    let known = scene.cases.iter().map(|case| {
        let found = impact::judgement::before(&scene.units, case);
        Ok(Known {
            model: of_impact::of_case(case, conversion)?,
            weights: impact::weights::text(&scene.units, case),
            warnings: warnings([(case.name.as_str(), &found[..])]),
        })
    });
    let cases = scene.cases.iter().map(|case| case.name.as_str()).collect();
    arguments.write(known, &Given { command: "impact", path, title: &scene.title, cases }, host, output)
}

/// The panel of a scene of `toron weave`, to enter a model of one's own.
///
/// # Errors
/// The input, no material, an argument, or a file that cannot be written.
pub fn weave(path: &Path, output: &Path, host: Host, arguments: &Arguments) -> Result<(), Error> {
    let scene = weave::reader::Scene::read(path)?;
    let conversion = arguments.conversion(scene.units)?;
    let material = scene.materials.first().map(|[warp, _]| warp).ok_or_else(|| {
        Error::Input(format!(
            "{}: [material] is missing, which a deck needs; allowed: a table with a preset",
            path.display()
        ))
    })?;
    let known = std::iter::once_with(|| {
        let panel = scene.cloth.model();
        Ok(Known {
            model: of_fabric::of_panel(&scene.cloth, &panel, material, conversion)?,
            weights: weave::report::weights(&scene, &panel),
            warnings: weave::report::warnings(&scene, &panel),
        })
    });
    let cases = vec![weave::command::NAME];
    arguments.write(known, &Given { command: "weave", path, title: &scene.title, cases }, host, output)
}

impl Arguments {
    fn conversion(&self, from: UnitSystem) -> Result<Conversion, Error> {
        let to = match &self.units {
            None => from,
            Some(name) => UnitSystem::parse(name)
                .ok_or_else(|| Error::Input(format!("--units {name}; allowed: {}", UnitSystem::ALLOWED)))?,
        };
        Ok(Conversion { from, to })
    }

    /// Writes one model after another, only one is in the memory; before each stands what a run would say before its
    /// first step.
    fn write(
        &self,
        mut known: impl Iterator<Item = Result<Known, Error>>,
        given: &Given<'_>,
        host: Host,
        output: &Path,
    ) -> Result<(), Error> {
        let plain = |c: char| c.is_ascii_alphanumeric() || "-_".contains(c);
        if !self.prefix.chars().all(plain) {
            return Err(Error::Input(format!("--prefix {}; allowed: letters, digits and - _", self.prefix)));
        }
        if host != Host::Openradioss && self.fibre_from.is_some() {
            return Err(Error::Input("--fibre-from is for --deck openradioss only".to_string()));
        }
        let Given { command, path, title, cases } = given;
        let names = cases.iter().map(|case| format!("{}{case}", self.prefix)).collect();
        let writes = Writes { command, files: vec![path], names, ..Writes::default() };
        let locked = RunDirectory::lock(output, writes)?;
        let first = known.next().transpose()?;
        let _directory = locked.claim()?;
        let source = ascii(&format!("toron {command} {}", path.display()));
        let Arguments { first_id, fibre_from, .. } = *self;
        let naming = Naming { first: first_id, prefix: self.prefix.clone(), fibre_from };
        for known in first.map(Ok).into_iter().chain(known) {
            let Known { model, weights, warnings } = known?;
            let name = format!("{}{}", self.prefix, model.name);
            print_error(&warnings);
            if !weights.is_empty() {
                print(&of_cases(&format!("Weights of {name}"), &[(&name, weights)], WIDTH));
            }
            let model = Model { title: ascii(title), source: source.clone(), name, ..model };
            let files = match host {
                Host::Openradioss => openradioss::write(&model, &naming, output)?,
                Host::LsDyna => ls_dyna::write(&model, &naming, output)?,
                Host::AbaqusExplicit => abaqus::write(&model, &naming, output)?,
            };
            print(&report(&model, &files));
        }
        Ok(())
    }
}

fn report(model: &Model, files: &[String]) -> String {
    let (nodes, elements, parts) = (model.mesh.nodes.len(), model.mesh.elements.len(), model.parts.len());
    let mass = format!("{} {}", number(model.mass()), model.units.names()[1]);
    format!("{}: {elements} elements, {nodes} nodes, {parts} parts, {mass}: {}\n", model.name, files.join(", "))
}

/// Solvers read bytes: other letters of a title would make lines longer than they look.
fn ascii(text: &str) -> String {
    text.replace('µ', "u").chars().map(|c| if c.is_ascii() && !c.is_ascii_control() { c } else { '?' }).collect()
}

/// Writes a file of the deck as a stream; one of other contents is kept, since a user may have changed it. Returns its
/// name.
///
/// # Errors
/// It cannot be written.
pub fn file(
    output: &Path,
    name: String,
    write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<String, Error> {
    kept_file::write(&output.join(&name), write)?;
    Ok(name)
}

/// Writes a mesh of the deck as a stream, in the place of the one before; returns its name.
///
/// # Errors
/// It cannot be written.
pub fn mesh_file(
    output: &Path,
    name: String,
    write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<String, Error> {
    kept_file::overwrite(&output.join(&name), write)?;
    Ok(name)
}
