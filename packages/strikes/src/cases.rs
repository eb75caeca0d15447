//! Cases over their scene: which keys of a case drop which of the scene's, and the cases of a file.

use std::ops::Range;

use toml::Spanned;
use toml::de::DeValue;

use toron_materials::material::file as material;
use toron_shared::error::Error;
use toron_shared::layers::{self, Drops, entries};
use toron_shared::toml_file::{Source, Unused};

/// The tables of a strength.
const STRENGTHS: &[&str] = &["strength", "warp", "weft"];
/// What a key drops beneath it: what it stands instead of, and what goes with that alone.
const DROPS: [Drops; 10] = [
    material::DROPS[0],
    material::DROPS[1],
    // A weave has its yarns from its preset, and is no mesh; a mesh has no plies.
    Drops { tables: &["weave"], key: "preset", value: None, keys: &["pattern", "warp", "weft"] },
    Drops { tables: &["case"], key: "weave", value: None, keys: &["mesh"] },
    Drops { tables: &["case"], key: "mesh", value: None, keys: &["weave", "ply"] },
    Drops { tables: &["mesh"], key: "file", value: None, keys: &["clearance", "height"] },
    // A panel's shape has a size of its own.
    Drops { tables: &["panel"], key: "shape", value: Some("circle"), keys: &["half"] },
    Drops { tables: &["panel"], key: "shape", value: Some("rectangle"), keys: &["radius"] },
    // The scale of a strength is a strain, or a stress and the modulus that makes a strain of it.
    Drops { tables: STRENGTHS, key: "strain", value: None, keys: &["stress", "elastic-modulus"] },
    Drops { tables: STRENGTHS, key: "stress", value: None, keys: &["strain"] },
];

/// The tables of this name in one, the uppermost first.
pub fn layered<'a, 't: 'a>(
    name: &str,
    tables: impl IntoIterator<Item = Option<&'a Spanned<DeValue<'t>>>>,
) -> Option<Spanned<DeValue<'t>>> {
    layers::layered(name, tables, &DROPS)
}

/// The table `[scene]` of a file, or a `[[case]]`.
pub trait SceneTable: Sized {
    /// # Errors
    /// A key or a value that the table cannot have.
    fn read(source: &Source, table: &Spanned<DeValue>) -> Result<Self, Error>;

    fn name(&self) -> Option<&toron_shared::spanned::Spanned<String>>;

    /// A key of this table that none of these cases reads.
    fn unused(&self, cases: &[&Self]) -> Unused;
}

/// A case of a scene.
pub struct CaseTables<'t, T> {
    pub name: String,
    /// Its table over the scene's, as data and as it is read.
    pub data: Spanned<DeValue<'t>>,
    pub table: T,
    /// Its own table alone, for messages: what is wrong beside the scene's keys is to be changed there.
    pub own_table: T,
}

impl<T> CaseTables<'_, T> {
    /// The place that errors name for keys that are missing.
    pub fn span(&self) -> Range<usize> {
        self.data.span()
    }
}

/// Reads the scene's table and the cases' alone.
///
/// # Errors
/// A key or a value that one of them cannot have.
pub fn check<T: SceneTable>(source: &Source, tables: &DeValue) -> Result<(), Error> {
    let mut tables = tables.get("scene").into_iter().chain(entries(tables.get("case")));
    tables.try_for_each(|table| T::read(source, table).map(|_| ()))
}

/// The cases of a file's tables, or the scene as the only one. The tables `beside` the scene's are beneath a case's own
/// too. The files that cases have in common are called as `common` says, without their endings.
///
/// # Errors
/// What a table cannot have; a key that no case reads; a name that cannot be.
pub fn cases<'t, T: SceneTable>(
    source: &Source<'t>,
    tables: &DeValue<'t>,
    beside: &[&str],
    common: &[&str],
) -> Result<Vec<CaseTables<'t, T>>, Error> {
    let scene = &tables["scene"];
    let of_scene = T::read(source, scene)?;
    if let Some(name) = of_scene.name() {
        return Err(source.error(name.span(), "name in [scene]; allowed: in a [[case]]"));
    }
    let base = with_tables(source, scene, tables, beside)?;
    let own = entries(tables.get("case"));
    let mut cases = Vec::with_capacity(own.len().max(1));
    for own in if own.is_empty() { std::slice::from_ref(scene) } else { own } {
        let data = layered("case", [Some(own), Some(&base)]).unwrap_or_else(|| own.clone());
        let (table, own_table) = (T::read(source, &data)?, T::read(source, own)?);
        cases.push(CaseTables { name: "scene".to_string(), data, table, own_table });
    }
    source.refuse_unused(of_scene.unused(&cases.iter().map(|case: &CaseTables<T>| &case.table).collect::<Vec<_>>()))?;
    if own.is_empty() {
        return Ok(cases);
    }
    for place in 0..cases.len() {
        let (before, case) = (&cases[..place], &cases[place]);
        let taken = common.iter().copied().chain(before.iter().map(|other| other.name.as_str()));
        let name = source.name_of("case", case.own_table.name(), case.span(), taken)?;
        source.refuse_unused(case.own_table.unused(&[&case.table]))?;
        cases[place].name = name;
    }
    Ok(cases)
}

/// The scene's table with these tables of the file, none of which it has itself.
fn with_tables<'t>(
    source: &Source<'t>,
    scene: &Spanned<DeValue<'t>>,
    tables: &DeValue<'t>,
    beside: &[&str],
) -> Result<Spanned<DeValue<'t>>, Error> {
    let mut all = scene.clone();
    for &key in beside {
        if let Some(value) = scene.get_ref().get(key) {
            let table = if value.get_ref().is_array() { format!("[[{key}]]") } else { format!("[{key}]") };
            let message = format!("{key} in [scene]; allowed: {table}, or in a [[case]]");
            return Err(source.error(value.span(), &message));
        }
        let entry = tables.as_table().and_then(|tables| tables.get_key_value(key));
        if let (DeValue::Table(all), Some((key, value))) = (all.get_mut(), entry) {
            all.insert(key.clone(), value.clone());
        }
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_drops_what_it_stands_instead_of() {
        let mesh = "file = \"a\"\npart = \"whole\"\nclearance = 1\nheight = 1";
        let rectangle = "shape = \"rectangle\"\nhalf = [1, 1]\npart = \"whole\"";
        let stress = "stress = 1\nelastic-modulus = 2\ncell = 3";
        for (table, lower, upper, left) in [
            ("hyperelastic", "preset = \"a\"\nproperties.k_el = 1", "preset = \"a\"", "preset"),
            ("linear-elastic", "preset = \"a\"\ndensity = 1", "law = \"b\"", "law"),
            ("material", "preset = \"a\"\ndensity = 1", "fibre = [1, 0, 0]", "density fibre preset"),
            ("weave", "pattern = \"plain\"\nwarp.pitch = 1\nrows = 2", "preset = \"a\"", "preset rows"),
            ("weave", "preset = \"a\"\nrows = 2", "warp.pitch = 1", "preset rows warp"),
            ("case", "weave.rows = 1\nply = [{}]\nspeed = 1", "mesh.file = \"a\"", "mesh speed"),
            ("case", "mesh.file = \"a\"\nspeed = 1", "weave.rows = 1", "speed weave"),
            ("case", "weave.rows = 1\nspeed = 1", "ply = [{}]", "ply speed weave"),
            ("mesh", mesh, "file = \"b\"", "file part"),
            ("mesh", mesh, "height = 2", "clearance file height part"),
            ("panel", rectangle, "shape = \"circle\"", "part shape"),
            ("panel", rectangle, "shape = \"rectangle\"", "half part shape"),
            ("panel", "shape = \"circle\"\nradius = 1", "shape = \"rectangle\"", "shape"),
            ("strength", stress, "strain = 1", "cell strain"),
            ("weft", stress, "stress = 2", "cell elastic-modulus stress"),
            ("warp", "strain = 1\ncell = 3", "stress = 2", "cell stress"),
        ] {
            let text = format!("[lower]\n{lower}\n[upper]\n{upper}\n");
            let tables = Source { name: "both.toml", text: &text }.tables().expect(upper);
            let both = layered(table, ["upper", "lower"].map(|key| tables.get_ref().get(key))).expect(upper);
            let keys = both.get_ref().as_table().expect(upper).keys().map(|key| key.get_ref().as_ref());
            assert_eq!(keys.collect::<Vec<&str>>().join(" "), left, "{table}: {upper} over {lower}");
        }
    }
}
