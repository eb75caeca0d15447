//! A scene of the section from its TOML file.

use std::ops::Range;
use std::path::Path;

use toml::Spanned;

use super::file::{BoxFile, CellFile, FibreFile, HostName, LoadsFile, PackingName, SceneFile, YarnFile};
use super::scene::{Arrangement, BoxOf, Fibre, Load, Packing, Scene, YarnName};
use toron_materials::units;
use toron_shared::error::Error;
use toron_shared::toml_file::{self, Source};

/// Defaults of the keys: those of the thesis, but for the mesh and the increments.
const FRICTION: f64 = 0.2;
const LARGEST: f64 = 0.12;
const ELEMENTS: usize = 8;
const INCREMENTS: usize = 24;
/// What a key may be at most. Fibres pressed further than this have no voids left between them.
const MOST_INVARIANT: f64 = 0.2;
const MOST_ELEMENTS: usize = 40;
const MOST_INCREMENTS: usize = 1000;
const MOST_FIBRES: usize = 1000;
const MOST_FRICTION: f64 = 2.0;
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
        let largest = up_to(&source, "largest", &loads.largest, MOST_INVARIANT, LARGEST)?;
        Ok(Scene {
            title: file.title.unwrap_or_else(|| name.to_string()),
            units: units::system(&source, &file.units)?,
            fibre: fibre(&source, file.fibre.get_ref())?,
            explicit,
            friction: zero_up_to(&source, "friction", &cell.friction, MOST_FRICTION, FRICTION)?,
            elements: count(&source, "elements", &cell.elements, [1, MOST_ELEMENTS], ELEMENTS)?,
            largest,
            largest_distortion: up_to(
                &source,
                "largest_distortion",
                &loads.largest_distortion,
                MOST_INVARIANT,
                largest,
            )?,
            increments: count(&source, "increments", &loads.increments, [1, MOST_INCREMENTS], INCREMENTS)?,
            loads: read_loads(&source, loads, &arrangement)?,
            yarn: yarn(&source, file.yarn.as_ref())?,
            arrangement,
        })
    }
}

fn fibre(source: &Source<'_>, file: &FibreFile) -> Result<Fibre, Error> {
    let positive = |key: &str, value: &Spanned<f64>| source.positive(key, *value.get_ref(), value.span());
    let optional =
        |key: &str, value: &Option<Spanned<f64>>| value.as_ref().map(|value| positive(key, value)).transpose();
    let (e_1, e_2) = (positive("e_1", &file.e_1)?, positive("e_2", &file.e_2)?);
    let nu_23 = ratio(source, "nu_23", &file.nu_23, 1.0)?;
    // The energy of a deformation must be positive: 1 − ν23 − 2 ν12² E2/E1 > 0.
    let nu_12 = ratio(source, "nu_12", &file.nu_12, ((1.0 - nu_23) * e_1 / (2.0 * e_2)).sqrt())?;
    let isotropic = e_2 / (2.0 * (1.0 + nu_23));
    let g_23 = optional("g_23", &file.g_23)?.unwrap_or(isotropic);
    if let Some(given) = file.g_23.as_ref().filter(|_| (g_23 / isotropic - 1.0).abs() > ROUNDED_MODULUS) {
        let message = format!(
            "g_23 is {g_23}; allowed: within {} % of e_2/(2 (1 + nu_23)) = {isotropic}",
            100.0 * ROUNDED_MODULUS
        );
        return Err(source.error(given.span(), &message));
    }
    Ok(Fibre {
        diameter: positive("diameter", &file.diameter)?,
        e_1,
        e_2,
        nu_12,
        nu_23,
        g_12: positive("g_12", &file.g_12)?,
        g_23,
        density: optional("density", &file.density)?,
        strain_at_failure: optional("strain_at_failure", &file.strain_at_failure)?,
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
    let of_random = [file.fibres.as_ref().map(Spanned::span), file.seed.as_ref().map(Spanned::span)];
    if let Some(span) = of_random.into_iter().flatten().next() {
        return Err(source.error(span, "a key of box of a random packing; allowed here: rows, fibres_in_row"));
    }
    let rows = needed(source, "rows", &file.rows, [1, MOST_FIBRES], walls.span())?;
    let fibres_in_row = needed(source, "fibres_in_row", &file.fibres_in_row, [2, MOST_FIBRES], walls.span())?;
    if rows * fibres_in_row > MOST_FIBRES {
        let message = format!("box has {} fibres; allowed: up to {MOST_FIBRES}", rows * fibres_in_row);
        return Err(source.error(walls.span(), &message));
    }
    Ok(Arrangement::Box(BoxOf::Rows { packing, rows, fibres_in_row }))
}

fn random(source: &Source<'_>, file: &BoxFile, span: Range<usize>) -> Result<Arrangement, Error> {
    let of_rows = [&file.rows, &file.fibres_in_row].into_iter().flatten().next();
    if let Some(key) = of_rows {
        return Err(source.error(key.span(), "a key of box of a regular packing; allowed here: fibres, seed"));
    }
    let fibres = needed(source, "fibres", &file.fibres, [1, MOST_FIBRES], span.clone())?;
    let seed = count(source, "seed", &file.seed, [0, i64::MAX as usize], 1)? as u64;
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
    let given = file.and_then(|file| file.volume_fraction.clone());
    let volume_fraction = match &given {
        None => None,
        Some(_) => Some(up_to(source, "volume_fraction", &given, 1.0, 1.0)?),
    };
    let name = file.and_then(|file| file.name.as_ref());
    if let Some(empty) = name.filter(|name| name.get_ref().trim().is_empty()) {
        return Err(source.error(empty.span(), "name is empty; allowed: a name for the yarn"));
    }
    Ok(YarnName {
        name: name.map_or_else(|| "yarn-from-fibres".to_string(), |name| name.get_ref().clone()),
        source: file.and_then(|file| file.source.clone()),
        volume_fraction,
    })
}

/// A number above 0 and up to `most`, or the default.
fn up_to(source: &Source<'_>, key: &str, value: &Option<Spanned<f64>>, most: f64, default: f64) -> Result<f64, Error> {
    let Some(value) = value else { return Ok(default) };
    let number = *value.get_ref();
    if number > 0.0 && number <= most {
        return Ok(number);
    }
    Err(source.error(value.span(), &format!("{key} is {number}; allowed: a number > 0, up to {most}")))
}

/// A number from 0 to `most`, or the default.
fn zero_up_to(
    source: &Source<'_>,
    key: &str,
    value: &Option<Spanned<f64>>,
    most: f64,
    default: f64,
) -> Result<f64, Error> {
    let Some(value) = value else { return Ok(default) };
    let number = *value.get_ref();
    if (0.0..=most).contains(&number) {
        return Ok(number);
    }
    Err(source.error(value.span(), &format!("{key} is {number}; allowed: a number from 0 to {most}")))
}

/// A whole number in this range, or the default.
fn count(
    source: &Source<'_>,
    key: &str,
    value: &Option<Spanned<i64>>,
    range: [usize; 2],
    default: usize,
) -> Result<usize, Error> {
    let Some(count) = value else { return Ok(default) };
    let [least, most] = range;
    match usize::try_from(*count.get_ref()) {
        Ok(number) if (least..=most).contains(&number) => Ok(number),
        _ => {
            let message = format!("{key} is {}; allowed: a whole number from {least} to {most}", count.get_ref());
            Err(source.error(count.span(), &message))
        }
    }
}

/// A whole number in this range that must be there.
fn needed(
    source: &Source<'_>,
    key: &str,
    value: &Option<Spanned<i64>>,
    range: [usize; 2],
    span: Range<usize>,
) -> Result<usize, Error> {
    if value.is_none() {
        let message = format!("{key} is missing; allowed: a whole number from {} to {}", range[0], range[1]);
        return Err(source.error(span, &message));
    }
    count(source, key, value, range, range[0])
}
