//! The file of a fit from a blow: a scene, a history, and what is to be found. `docs/reference/fit-files.md` has the
//! keys.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use crate::identify::reader::plain_name;
use toron::law::parameters::{Dimension, NUMBER, Property};
use toron_explicit_host::struck::history::{self, Column};
use toron_explicit_host::struck::plan::Plan;
use toron_materials::data_table::DataTable;
use toron_materials::material::preset::LONGEST_NAME;
use toron_materials::units::{self, TIME};
use toron_shared::checked::{Checked, Positive};
use toron_shared::error::Error;
use toron_shared::nearest;
use toron_shared::spanned::Spanned;
use toron_shared::toml_file::{self, Numbers, Source};
use toron_strikes::impact::outcome::OfYarn;
use toron_strikes::impact::scene::{Case, Scene, Zones};
use toron_strikes::impact::summary;

/// The table that makes a file one of a fit from a blow.
const BLOW: &str = "blow";

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub struct BlowFile {
    /// Heading of summary and plot. Default: the yarn's name.
    title: Option<String>,
    /// Of the file, those of the scene.
    units: Spanned<String>,
    /// The preset that comes out. It has the scene's values for what was not fitted.
    #[serde(default)]
    yarn: YarnFile,
    /// The [blow](reference/fit-files.md#blow).
    blow: Spanned<BlowTable>,
}

#[derive(Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
struct YarnFile {
    /// Of the preset and its file. Default: `my-yarn`.
    name: Option<Spanned<String>>,
    /// Where the values come from, kept in the preset. Default: the title.
    source: Option<String>,
}

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
struct BlowTable {
    /// A scene of `toron impact`, in the same `units`; its properties are the start.
    scene: Spanned<String>,
    /// The case of the scene. Default: its only one.
    case: Option<Spanned<String>>,
    /// A CSV file with `time` and what is followed; titles have the units.
    history: Spanned<String>,
    /// `{ width_1 = "spread_1" }`: what the history calls a column. Default: the same name.
    #[serde(default)]
    columns: BTreeMap<Spanned<String>, Spanned<String>>,
    /// `[from, to]` of the time; the scene ends with it. Default: all.
    range: Option<Spanned<Numbers<2>>>,
    /// [Columns of a history](reference/impact-files.md#namecsv), each with its standard deviation.
    follows: Spanned<BTreeMap<Spanned<String>, Spanned<Positive>>>,
    /// Names of properties of the scene's law.
    fits: Spanned<Vec<Spanned<String>>>,
}

/// A fit from a blow as a file describes it; numbers are in the units of the scene, which are those of the file.
#[derive(Debug)]
pub struct BlowJob {
    pub title: String,
    /// Of the preset that comes out, and where its values come from.
    pub name: String,
    pub source: String,
    pub scene: Scene,
    /// As it is run: up to the end of the range, without pictures.
    pub case: Case,
    pub fits: Vec<Fitted>,
    pub follows: Vec<Followed>,
    pub times: Vec<f64>,
    /// The files that were read, none of which is to be overwritten.
    pub inputs: Vec<PathBuf>,
}

/// A property that is to be found.
#[derive(Clone, Copy, Debug)]
pub struct Fitted {
    /// Its place in the law's table.
    pub index: usize,
    pub property: &'static Property,
    /// The scene's, from which the search starts.
    pub start: f64,
    /// What counts as a change of one that starts at 0.
    pub size: f64,
}

/// A column of the history that the scene is to follow.
#[derive(Clone, Debug)]
pub struct Followed {
    pub name: &'static str,
    pub dimension: Dimension,
    /// What a datum may be off by.
    pub deviation: f64,
    /// At each of the times.
    pub values: Vec<f64>,
}

/// The columns that a history of `toron impact` has.
pub fn columns() -> Vec<Column<OfYarn>> {
    history::columns(summary::columns())
}

impl BlowJob {
    /// Reads the file, its scene and its history; none where the file has no table `[blow]`.
    ///
    /// # Errors
    /// An input error that names file, line and what is allowed.
    pub fn read(path: &Path) -> Result<Option<BlowJob>, Error> {
        let (name, text) = toml_file::read(path)?;
        let source = Source { name: &name, text: &text };
        if source.tables()?.get_ref().get(BLOW).is_none() {
            return Ok(None);
        }
        let file: BlowFile = source.parse()?;
        let blow = file.blow.get_ref();
        let folder = path.parent().unwrap_or(Path::new(""));
        let [scene_path, history_path] = [&blow.scene, &blow.history].map(|name| folder.join(name.get_ref()));
        let scene = Scene::read(&scene_path)?;
        let units = units::system(&source, &file.units)?;
        if units.names() != scene.units.names() {
            let message = format!(
                "units is \"{}\", and the scene's are \"{}\"; allowed: the same",
                units.names().join("-"),
                scene.units.names().join("-")
            );
            return Err(source.error(file.units.span(), &message));
        }
        let case = case(&source, blow, &scene)?;
        let (times, follows) = history_of(&source, blow, &history_path, &scene)?;
        let fits = fits(&source, blow, &case)?;
        let data = times.len() * follows.len();
        if data <= fits.len() {
            let message = format!("{data} data for {} properties; allowed: more data than properties", fits.len());
            return Err(source.error(blow.fits.span(), &message));
        }
        let end = times.last().copied().unwrap_or_default();
        let plan = Plan { end, pictures: Vec::new(), frames: 0, checkpoints: 0, ..case.plan.clone() };
        let name_of = file.yarn.name.as_ref().map_or("my-yarn", |name| name.get_ref());
        if !plain_name(name_of) || name_of.len() > LONGEST_NAME || toron::preset(name_of).is_some() {
            let span = file.yarn.name.as_ref().map_or(0..0, Spanned::span);
            let allowed = "up to 80 letters, digits and - _ ., and no name of the library's presets";
            return Err(source.error(span, &format!("name is \"{name_of}\"; allowed: {allowed}")));
        }
        let title = file.title.unwrap_or_else(|| name_of.to_string());
        Ok(Some(BlowJob {
            name: name_of.to_string(),
            source: file.yarn.source.unwrap_or_else(|| title.clone()),
            title,
            case: Case { plan, ..case },
            scene,
            fits,
            follows,
            times,
            inputs: vec![path.to_path_buf(), scene_path, history_path],
        }))
    }
}

/// The case of the scene that is struck as the history was.
fn case(source: &Source<'_>, blow: &BlowTable, scene: &Scene) -> Result<Case, Error> {
    let names = || scene.cases.iter().map(|case| case.name.as_str());
    let found = match &blow.case {
        Some(name) => scene.cases.iter().find(|case| case.name == *name.get_ref()).ok_or_else(|| {
            let hint = nearest::hint(name.get_ref(), names());
            let allowed = names().collect::<Vec<_>>().join(", ");
            source.error(name.span(), &format!("case \"{}\"{hint}; allowed: {allowed}", name.get_ref()))
        })?,
        None if scene.cases.len() == 1 => &scene.cases[0],
        None => {
            let message = format!(
                "the scene has several cases; allowed: case, one of {}",
                names().collect::<Vec<_>>().join(", ")
            );
            return Err(source.error(blow.scene.span(), &message));
        }
    };
    let yarn_law = matches!(&found.zones, Zones::One(material) if material.law.yarn().is_some());
    if !yarn_law || found.strength.is_some() {
        let message = format!(
            "case \"{}\" has two materials, a scattered strength or another law than a yarn's; allowed: one yarn law throughout",
            found.name
        );
        return Err(source.error(blow.scene.span(), &message));
    }
    Ok(found.clone())
}

/// The times of the history within the range, and there what is to be followed.
fn history_of(
    source: &Source<'_>,
    blow: &BlowTable,
    path: &Path,
    scene: &Scene,
) -> Result<(Vec<f64>, Vec<Followed>), Error> {
    let table = DataTable::read(path)?;
    let times = table.values("time", TIME, &scene.units)?;
    if let Some(place) = times.windows(2).position(|pair| pair[1] <= pair[0]) {
        let message = format!("time {} follows {}; allowed: times that grow", times[place + 1], times[place]);
        return Err(Error::Input(format!("{}: {message}", path.display())));
    }
    let range = blow.range.as_ref().map_or([0.0, f64::INFINITY], |range| range.get_ref().0);
    let kept: Vec<usize> =
        (0..times.len()).filter(|&i| times[i] > 0.0 && (range[0]..=range[1]).contains(&times[i])).collect();
    if kept.is_empty() {
        let span = blow.range.as_ref().map_or(blow.history.span(), Spanned::span);
        return Err(source.error(span, "the history has no time above 0 in this range; allowed: one at least"));
    }
    if blow.follows.get_ref().is_empty() {
        return Err(source.error(blow.follows.span(), "follows is empty; allowed: columns, each with its deviation"));
    }
    if let Some((name, _)) = blow.columns.iter().find(|(name, _)| !blow.follows.get_ref().contains_key(*name)) {
        let message = format!("columns names \"{}\", which is not in follows; allowed: what is", name.get_ref());
        return Err(source.error(name.span(), &message));
    }
    let known = columns();
    let followed = |(name, deviation): (&Spanned<String>, &Spanned<Positive>)| {
        let column =
            known.iter().find(|column| column.name == name.get_ref() && column.name != "time").ok_or_else(|| {
                let names: Vec<&str> = known.iter().map(|column| column.name).filter(|&name| name != "time").collect();
                let hint = nearest::hint(name.get_ref(), names.iter().copied());
                source
                    .error(name.span(), &format!("follows \"{}\"{hint}; allowed: {}", name.get_ref(), names.join(", ")))
            })?;
        let own = blow.columns.iter().find(|(name, _)| name.get_ref() == column.name).map(|(_, own)| own.get_ref());
        let all = table.values(own.map_or(column.name, String::as_str), column.dimension, &scene.units)?;
        Ok(Followed {
            name: column.name,
            dimension: column.dimension,
            deviation: deviation.get_ref().value(),
            values: kept.iter().map(|&i| all[i]).collect(),
        })
    };
    let follows = blow.follows.get_ref().iter().map(followed).collect::<Result<_, Error>>()?;
    Ok((kept.iter().map(|&i| times[i]).collect(), follows))
}

/// The properties that are to be found, each once.
fn fits(source: &Source<'_>, blow: &BlowTable, case: &Case) -> Result<Vec<Fitted>, Error> {
    let material = case.zones.inner();
    let (table, values) = (material.table(), material.values());
    let mut fits: Vec<Fitted> = Vec::new();
    for name in blow.fits.get_ref() {
        let names: Vec<&str> =
            table.iter().map(|property| property.name).filter(|name| !name.starts_with("m_")).collect();
        let known = names.contains(&name.get_ref().as_str());
        let index = table.iter().position(|property| property.name == name.get_ref()).filter(|_| known);
        let Some(index) = index.filter(|index| fits.iter().all(|fitted| fitted.index != *index)) else {
            let hint = nearest::hint(name.get_ref(), names.iter().copied());
            let message = format!("fits \"{}\"{hint}; allowed: {}, each once", name.get_ref(), names.join(", "));
            return Err(source.error(name.span(), &message));
        };
        fits.push(Fitted { index, property: &table[index], start: values[index], size: size(table, &values, index) });
    }
    if fits.is_empty() {
        return Err(source.error(blow.fits.span(), "fits is empty; allowed: properties of the scene's law"));
    }
    Ok(fits)
}

/// A tenth of a property's range where that is known, 1 for other numbers, and else a ten-thousandth of the law's
/// greatest property of the same dimension, its stiffness along the fibre: what makes a difference, in any units.
fn size(table: &[Property], values: &[f64], index: usize) -> f64 {
    let Property { minimum, maximum, dimension, .. } = table[index];
    if maximum <= 1.0 {
        return 0.1 * (maximum - minimum);
    }
    let alike = table.iter().zip(values).filter(|(property, _)| property.dimension == dimension);
    let greatest = alike.map(|(_, value)| *value).fold(0.0, f64::max);
    if dimension == NUMBER || greatest == 0.0 { 1.0 } else { 1e-4 * greatest }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use toron::law::parameters::FRICTIONAL;

    #[test]
    fn what_starts_at_0_has_a_size_in_any_units() {
        let place = |name: &str| FRICTIONAL.iter().position(|property| property.name == name).expect("it exists");
        for pascal in [1.0, 1e-6] {
            let mut values = [0.0; FRICTIONAL.len()];
            for (name, value) in [("k_el", 82e9), ("k_tc", 1e9), ("k_td", 650e6), ("cohesion", 1e3)] {
                values[place(name)] = value * pascal;
            }
            // Of a fibre that is not quite along an axis.
            values[place("m_2")] = 4e-17;
            for stress in ["cohesion", "k_ld"] {
                assert_relative_eq!(size(&FRICTIONAL, &values, place(stress)), 8.2e6 * pascal);
            }
            for number in ["alpha", "beta"] {
                assert_eq!(size(&FRICTIONAL, &values, place(number)), 1.0);
            }
            assert_eq!(size(&FRICTIONAL, &values, place("mu")), 0.1 * FRICTIONAL[place("mu")].maximum);
        }
    }
}
