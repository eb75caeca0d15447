//! The arguments of `toron deck`.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use toron::host::units::UnitSystem;
use toron::{Criterion, Rotation};

use super::abaqus::{self, Solver};
use super::ls_dyna::{self, Fibre, NUMBERS};
use super::material::Material;
use super::openradioss::FibreFrom;
use super::{calculix, mtest, openradioss};
use crate::material::laws::{LawName, Laws};
use crate::material::preset::Preset;
use toron_shared::console::{print, print_error};
use toron_shared::error::Error;
use toron_shared::toml_file;

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Host {
    LsDyna,
    /// One card for both solvers.
    Abaqus,
    AbaqusStandard,
    AbaqusExplicit,
    Openradioss,
    Calculix,
    Mtest,
}

#[derive(Args, Debug)]
pub struct Arguments {
    /// The solver.
    #[arg(long, value_enum)]
    host: Host,
    /// The yarn: a preset by name (`toron params` lists them), or a file of your own, as my-yarn.toml (`toron fit` and
    /// `toron init path` write one); without it, the first built-in one of the law.
    #[arg(long)]
    preset: Option<String>,
    /// The yarn's file, whatever its name ends in: what --preset takes, and `toron fit` writes; - is the standard
    /// input.
    #[arg(long, value_name = "FILE", conflicts_with = "preset")]
    properties: Option<PathBuf>,
    /// hyperelastic, linear-elastic or frictional: which built-in preset to take, or what law that of --preset must be
    /// of.
    #[arg(long)]
    law: Option<String>,
    /// The deck's units, for instance mm-tonne-s; may be left out for a file, which has its own.
    #[arg(long)]
    units: Option<String>,
    /// A property, or the density, other than the yarn has it, in the deck's units; for each one an option, as --set
    /// k_ld=126.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    changes: Vec<String>,
    /// The fibre direction X,Y,Z instead of the yarn's own.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    fibre: Option<String>,
    /// LS-DYNA, OpenRadioss: the material's number in the deck, and that of OpenRadioss's property; 1 without it.
    #[arg(long)]
    id: Option<u64>,
    /// LS-DYNA: the fibre is the first material axis, element by element (IHYPER -1, IORTHO 1, AOPT 2), and not one
    /// direction for the material (IHYPER 1, IORTHO 0).
    #[arg(long)]
    axes: bool,
    /// LS-DYNA: the number of the material, and of the routine umatMT.
    #[arg(long)]
    mt: Option<u32>,
    /// OpenRadioss: where each element's fibre direction comes from; the card without it.
    #[arg(long, value_enum)]
    fibre_from: Option<FibreFrom>,
    /// OpenRadioss, linear elastic law: what the material axes follow; the fibre without it.
    #[arg(long, value_enum)]
    frame: Option<Frame>,
    /// OpenRadioss, linear elastic law: failure by the largest principal stress, as without it, or by that along the
    /// fibre.
    #[arg(long, value_enum)]
    criterion: Option<Limit>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Frame {
    Fibre,
    Polar,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Limit {
    LargestPrincipal,
    FibreStress,
}

/// Prints the card of a material of one of these laws, and to the standard error a warning of units that do not fit.
///
/// # Errors
/// The argument that is wrong, or what is wrong with the yarn.
pub fn run(laws: Laws, arguments: &Arguments) -> Result<(), Error> {
    let (card, warning) = card(laws, arguments)?;
    print(&card);
    if let Some(warning) = warning {
        print_error(&format!("{}: warning: {warning}\n", laws.program()));
    }
    Ok(())
}

/// The card, and a warning of units that do not fit.
///
/// # Errors
/// The argument that is wrong, or what is wrong with the yarn.
pub fn card(laws: Laws, arguments: &Arguments) -> Result<(String, Option<String>), Error> {
    let law = arguments.law.as_deref().map(|name| law(laws, name)).transpose()?;
    let mut preset = preset(laws, arguments, law)?;
    let units = units(arguments, &preset)?;
    for change in &arguments.changes {
        set(&mut preset, change, &units)?;
    }
    let fibre = arguments.fibre.as_deref().map(direction).transpose()?;
    let mut material = Material::new(&preset, &units, fibre)?;
    if arguments.frame == Some(Frame::Polar) {
        material.frame = Rotation::Polar;
    }
    if arguments.criterion == Some(Limit::FibreStress) {
        material.criterion = Criterion::FibreStress;
    }
    if arguments.axes && material.fibre().is_empty() {
        return Err(Error::Input("--axes is for a law with a fibre direction".into()));
    }
    if arguments.host != Host::LsDyna {
        only_for("ls-dyna", "--axes", arguments.axes)?;
        only_for("ls-dyna", "--mt", arguments.mt.is_some())?;
    }
    if arguments.host != Host::Openradioss {
        only_for("openradioss", "--fibre-from", arguments.fibre_from.is_some())?;
        only_for("openradioss", "--frame", arguments.frame.is_some())?;
        only_for("openradioss", "--criterion", arguments.criterion.is_some())?;
    }
    let id = id(arguments)?;
    let card = match arguments.host {
        Host::LsDyna => {
            let fibre = if arguments.axes { Fibre::Axes } else { Fibre::Global };
            ls_dyna::card(&material, id, arguments.mt.map(number).transpose()?, fibre)
        }
        Host::Abaqus => abaqus::card(&material, Solver::Both),
        Host::AbaqusStandard => abaqus::card(&material, Solver::Standard),
        Host::AbaqusExplicit => abaqus::card(&material, Solver::Explicit),
        Host::Openradioss => {
            let fibre_from = arguments.fibre_from.unwrap_or(FibreFrom::Card);
            openradioss::card(&material, id, fibre_from)
        }
        Host::Calculix => Ok(calculix::card(&material)),
        Host::Mtest => Ok(mtest::card(&material)),
    };
    Ok((card?, material.unit_warning()))
}

fn law(laws: Laws, text: &str) -> Result<LawName, Error> {
    laws.find(text).ok_or_else(|| {
        let names: Vec<&str> = laws.names().into_iter().map(LawName::text).collect();
        Error::Input(format!("--law {text}; allowed: {}", names.join(", ")))
    })
}

/// The preset that the arguments name, which must be of the law, if one is given.
fn preset(laws: Laws, arguments: &Arguments, law: Option<LawName>) -> Result<Preset, Error> {
    let preset = match (&arguments.preset, &arguments.properties) {
        (Some(name), _) => {
            Preset::find(laws, name, Path::new(""), |message| Error::Input(format!("--preset: {message}")))?
        }
        (None, Some(path)) => {
            let (file, text) =
                toml_file::read(path).map_err(|reason| Error::Input(format!("--properties {reason}")))?;
            Preset::parse(laws, &file, &text)?
        }
        (None, None) => {
            let law = law.unwrap_or(laws.first());
            let mut presets = laws.presets().iter().map(Preset::from);
            presets
                .find(|preset| preset.law == law)
                .ok_or_else(|| Error::Input("--preset or --properties is missing; allowed: a file".into()))?
        }
    };
    let Some(law) = law else { return Ok(preset) };
    let (name, own) = (preset.name.clone(), preset.law.text());
    let wrong = || Error::Input(format!("--law {}: {name} is of the law {own}; allowed: {own}", law.text()));
    preset.for_law(law).ok_or_else(wrong)
}

/// The deck's units, or those of the yarn's file.
fn units(arguments: &Arguments, preset: &Preset) -> Result<UnitSystem, Error> {
    let allowed = UnitSystem::ALLOWED;
    match &arguments.units {
        Some(name) => {
            UnitSystem::parse(name).ok_or_else(|| Error::Input(format!("--units {name}; allowed: {allowed}")))
        }
        None if preset.file().is_some() => Ok(preset.units),
        None => Err(Error::Input(format!("--units is missing, and {} has none; allowed: {allowed}", preset.name))),
    }
}

fn direction(text: &str) -> Result<[f64; 3], Error> {
    let numbers: Vec<f64> = text.split(',').map_while(|number| number.trim().parse().ok()).collect();
    let complete = text.split(',').count() == 3 && numbers.iter().all(|number| number.is_finite());
    let numbers = <[f64; 3]>::try_from(numbers).ok().filter(|_| complete);
    numbers.ok_or_else(|| Error::Input(format!("--fibre {text}; allowed: three finite numbers, X,Y,Z")))
}

fn number(mt: u32) -> Result<u32, Error> {
    let allowed = NUMBERS.map(|number| number.to_string()).join(", ");
    let other = "42 and 46 have other argument lists";
    NUMBERS.contains(&mt).then_some(mt).ok_or_else(|| Error::Input(format!("--mt {mt}; allowed: {allowed} ({other})")))
}

/// As many digits as a field of ten columns has room for, with a blank before them.
fn id(arguments: &Arguments) -> Result<u32, Error> {
    match arguments.id {
        Some(_) if !matches!(arguments.host, Host::LsDyna | Host::Openradioss) => {
            Err(Error::Input("--id is for --host ls-dyna and openradioss only".into()))
        }
        Some(id) if !(1..=999_999_999).contains(&id) => {
            Err(Error::Input(format!("--id {id}; allowed: 1 to 999999999")))
        }
        id => Ok(id.map_or(1, |id| id as u32)), // of nine digits at most
    }
}

fn only_for(host: &str, argument: &str, given: bool) -> Result<(), Error> {
    if given { Err(Error::Input(format!("{argument} is for --host {host} only"))) } else { Ok(()) }
}

/// Changes a property of the preset, as in k_ld=126.
fn set(preset: &mut Preset, change: &str, units: &UnitSystem) -> Result<(), Error> {
    let error = |message: &str| Error::Input(format!("--set {change}: {message}"));
    let (name, value) = change.split_once('=').ok_or_else(|| error("allowed: NAME=VALUE, as k_ld=126"))?;
    let number = value.trim().parse().ok().filter(|value: &f64| value.is_finite());
    let value = number.ok_or_else(|| error("allowed: a finite number behind the ="))?;
    preset.set(name.trim(), value, units).map_err(|message| error(&message))
}
