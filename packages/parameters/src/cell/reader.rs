//! A scene of the section from its TOML file.

use std::ops::Range;
use std::path::Path;

use super::file::{BoxFile, CellFile, FibreFile, HostName, LoadsFile, MOST_FIBRES, PackingName, SceneFile, YarnFile};
use super::scene::{Arrangement, BoxOf, Fibre, Load, Packing, Scene, YarnName};
use toron_materials::units;
use toron_shared::checked::{Checked, value};
use toron_shared::error::Error;
use toron_shared::spanned::Spanned;
use toron_shared::toml_file::{self, Source};

/// Defaults of the keys: those of the thesis, but for the mesh and the increments.
const FRICTION: f64 = 0.2;
const LARGEST: f64 = 0.12;
const ELEMENTS: usize = 8;
const INCREMENTS: usize = 24;
/// g_23 may differ by this part from e_2/(2 (1 + nu_23)), which it is in a fibre without directions across it.
const ROUNDED_MODULUS: f64 = 0.02;

impl Scene {
    /// Reads the file.
    ///
    /// # Errors
    /// An input error that names file, line, value and what is allowed.
    pub fn read(path: &Path) -> Result<Scene, Error> {
        let (name, text) = toml_file::read(path)?;
        Scene::parse(&name, &text)
    }

    /// The scene that `text` describes; `name` stands for the file in messages.
    ///
    /// # Errors
    /// An input error that names file, line, value and what is allowed.
    pub fn parse(name: &str, text: &str) -> Result<Scene, Error> {
        let source = Source { name, text };
        let file: SceneFile = source.parse()?;
        let cell = file.cell.get_ref();
        let arrangement = arrangement(&source, cell, file.cell.span())?;
        let explicit = is_explicit(&source, cell, &arrangement)?;
        let none = LoadsFile::default();
        let loads = file.loads.as_ref().unwrap_or(&none);
        let largest = value(&loads.largest).unwrap_or(LARGEST);
        Ok(Scene {
            title: file.title.unwrap_or_else(|| name.to_string()),
            units: units::system(&source, &file.units)?,
            fibre: fibre(&source, file.fibre.get_ref())?,
            explicit,
            friction: value(&cell.friction).unwrap_or(FRICTION),
            elements: value(&cell.elements).unwrap_or(ELEMENTS),
            largest,
            largest_distortion: value(&loads.largest_distortion).unwrap_or(largest),
            increments: value(&loads.increments).unwrap_or(INCREMENTS),
            loads: read_loads(&source, loads, &arrangement)?,
            yarn: yarn(&source, file.yarn.as_ref())?,
            arrangement,
        })
    }
}

fn fibre(source: &Source<'_>, file: &FibreFile) -> Result<Fibre, Error> {
    let [e_1, e_2] = [file.e_1.value(), file.e_2.value()];
    let nu_23 = ratio(source, "nu_23", &file.nu_23, 1.0)?;
    // The energy of a deformation must be positive: 1 − ν23 − 2 ν12² E2/E1 > 0.
    let nu_12 = ratio(source, "nu_12", &file.nu_12, ((1.0 - nu_23) * e_1 / (2.0 * e_2)).sqrt())?;
    let isotropic = e_2 / (2.0 * (1.0 + nu_23));
    let g_23 = value(&file.g_23).unwrap_or(isotropic);
    if let Some(given) = file.g_23.as_ref().filter(|_| (g_23 / isotropic - 1.0).abs() > ROUNDED_MODULUS) {
        let message = format!(
            "g_23 is {g_23}; allowed: within {} % of e_2/(2 (1 + nu_23)) = {isotropic}",
            100.0 * ROUNDED_MODULUS
        );
        return Err(source.error(given.span(), &message));
    }
    Ok(Fibre {
        diameter: file.diameter.value(),
        e_1,
        e_2,
        nu_12,
        nu_23,
        g_12: file.g_12.value(),
        g_23,
        density: value(&file.density),
        strain_at_failure: value(&file.strain_at_failure),
    })
}

/// A ratio of contraction whose size is below `bound`.
fn ratio(source: &Source<'_>, key: &str, value: &Spanned<f64>, bound: f64) -> Result<f64, Error> {
    let ratio = *value.get_ref();
    if ratio.abs() < bound {
        return Ok(ratio);
    }
    let message = format!("{key} is {ratio}; allowed: between -{bound} and {bound}, or the fibre is not stable");
    Err(source.error(value.span(), &message))
}

/// Fibres at random are computed by the explicit host alone.
fn is_explicit(source: &Source<'_>, cell: &CellFile, arrangement: &Arrangement) -> Result<bool, Error> {
    let random = arrangement.is_random();
    let Some(host) = &cell.host else { return Ok(random) };
    let explicit = *host.get_ref() == HostName::Explicit;
    if random && !explicit {
        let message = "host is calculix, whose statics does not follow fibres at random; allowed here: explicit";
        return Err(source.error(host.span(), message));
    }
    Ok(explicit)
}

fn arrangement(source: &Source<'_>, cell: &CellFile, span: Range<usize>) -> Result<Arrangement, Error> {
    let packing = match cell.packing {
        PackingName::Hexagonal => Packing::Hexagonal,
        PackingName::Square => Packing::Square,
        PackingName::Random => {
            let wanted = "packing is random and box is missing; allowed: box = { fibres, seed }";
            let walls = cell.walls.as_ref().ok_or_else(|| source.error(span, wanted))?;
            return random(source, walls.get_ref(), walls.span());
        }
    };
    let Some(walls) = &cell.walls else { return Ok(Arrangement::Cell(packing)) };
    let file = walls.get_ref();
    if let Some(span) = file.fibres.as_ref().map(Spanned::span).or(file.seed.as_ref().map(Spanned::span)) {
        return Err(source.error(span, "a key of box of a random packing; allowed here: rows, fibres_in_row"));
    }
    let rows = source.needed("rows", &file.rows, walls.span())?;
    let fibres_in_row = source.needed("fibres_in_row", &file.fibres_in_row, walls.span())?;
    if rows * fibres_in_row > MOST_FIBRES {
        let message = format!("box has {} fibres; allowed: up to {MOST_FIBRES}", rows * fibres_in_row);
        return Err(source.error(walls.span(), &message));
    }
    Ok(Arrangement::Box(BoxOf::Rows { packing, rows, fibres_in_row }))
}

fn random(source: &Source<'_>, file: &BoxFile, span: Range<usize>) -> Result<Arrangement, Error> {
    if let Some(span) = file.rows.as_ref().map(Spanned::span).or(file.fibres_in_row.as_ref().map(Spanned::span)) {
        return Err(source.error(span, "a key of box of a regular packing; allowed here: fibres, seed"));
    }
    let fibres = source.needed("fibres", &file.fibres, span)?;
    let seed = file.seed.as_ref().map_or(1, |seed| *seed.get_ref());
    Ok(Arrangement::Box(BoxOf::Random { fibres, seed }))
}

fn read_loads(source: &Source<'_>, file: &LoadsFile, arrangement: &Arrangement) -> Result<Vec<Load>, Error> {
    // Square packing is the same along its rows and across them.
    let square = *arrangement == Arrangement::Cell(Packing::Square);
    let all = [Load::Compaction, Load::AlongRows, Load::AcrossRows];
    let Some(kinds) = &file.kinds else { return Ok(all[..if square { 2 } else { 3 }].to_vec()) };
    let given = kinds.get_ref();
    let twice = given.iter().enumerate().any(|(i, kind)| given[..i].contains(kind));
    if given.is_empty() || twice {
        return Err(
            source.error(kinds.span(), "kinds is empty or names a load twice; allowed: each once, one at least")
        );
    }
    Ok(given.clone())
}

fn yarn(source: &Source<'_>, file: Option<&Spanned<YarnFile>>) -> Result<YarnName, Error> {
    let file = file.map(Spanned::get_ref);
    let name = file.and_then(|file| file.name.as_ref());
    if let Some(empty) = name.filter(|name| name.get_ref().trim().is_empty()) {
        return Err(source.error(empty.span(), "name is empty; allowed: a name for the yarn"));
    }
    Ok(YarnName {
        name: name.map_or_else(|| "yarn-from-fibres".to_string(), |name| name.get_ref().clone()),
        source: file.and_then(|file| file.source.clone()),
        volume_fraction: file.and_then(|file| value(&file.volume_fraction)),
    })
}
