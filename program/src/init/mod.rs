//! `toron init`: scenes to start from, which are built in, each with the yarn that it is of.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};

use toron::host::units::UnitSystem;
use toron::law::parameters::{DENSITY, FIBRE, HYPERELASTIC};
use toron_materials::material::preset::Preset;
use toron_materials::units::unit;
use toron_shared::console::print;
use toron_shared::error::Error;
use toron_shared::text_table::plain_table;
use toron_shared::{folder, kept_file, nearest, shell};

/// A scene, the command that runs it, and the schema of such files.
struct Start {
    name: &'static str,
    command: &'static str,
    text: &'static str,
    schema: &'static str,
}

macro_rules! start {
    ($name:literal, $command:literal, $schema:literal) => {
        Start {
            name: $name,
            command: $command,
            text: include_str!(concat!("../../assets/init/", $name, ".toml")),
            schema: include_str!(concat!("../../assets/schema/", $schema, ".json")),
        }
    };
}

/// In the order of the commands.
static STARTS: [Start; 8] = [
    start!("data-sheet", "fit", "fit"),
    start!("path", "run", "run"),
    start!("weave", "weave", "weave"),
    start!("fabric", "fabric", "fabric"),
    start!("yarn", "impact", "impact"),
    start!("v50", "v50", "fabric"),
    start!("fibres", "fibres", "fibres"),
    start!("cell", "cell", "cell"),
];

/// The yarn that scenes are of, and the built-in one that it is a copy of.
const YARN: &str = "my-yarn";
const MODEL: &str = "kevlar-km2-600";
/// The units of its file.
const UNITS: &str = "mm-tonne-s";

#[derive(clap::Args)]
pub struct Arguments {
    /// Which one; without it, they are listed.
    name: Option<String>,
    /// Where the files go; without it, the current folder.
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Write its schema beside it, by which editors complete, explain and check keys.
    #[arg(long, requires = "name")]
    schema: bool,
}

/// Lists the scenes, or writes one, with its yarn.
///
/// # Errors
/// There is no such scene, or a file cannot be written.
pub fn run(Arguments { name, output, schema }: &Arguments) -> Result<(), Error> {
    let Some(name) = name else {
        print(&list());
        return Ok(());
    };
    let start = STARTS.iter().find(|start| start.name == *name).ok_or_else(|| {
        let names: Vec<&str> = STARTS.iter().map(|start| start.name).collect();
        let hint = nearest::hint(name, names.iter().copied());
        Error::Input(format!("init {name}{hint}; allowed: {}", names.join(", ")))
    })?;
    output.as_deref().map_or(Ok(()), folder::create)?;
    let place = |name: &str| output.as_deref().unwrap_or(Path::new("")).join(name);
    let scene = place(&format!("{}.toml", start.name));
    let mut written = vec![scene.clone()];
    let mut text = start.text.to_string();
    if *schema {
        let name = format!("{}.schema.json", start.name);
        text.insert_str(0, &format!("#:schema ./{name}\n"));
        kept_file::write(&place(&name), |file| file.write_all(start.schema.as_bytes()))?;
        written.push(place(&name));
    }
    kept_file::write(&scene, |file| file.write_all(text.as_bytes()))?;
    let yarn = place(&format!("{YARN}.toml"));
    if start.text.contains(&format!("\"{YARN}.toml\"")) {
        // A yarn of the user's own stays.
        if !yarn.exists() {
            let text = self::yarn()?;
            kept_file::write(&yarn, |file| file.write_all(text.as_bytes()))?;
        }
        written.push(yarn);
    }
    let written: Vec<String> = written.iter().map(|file| file.display().to_string()).collect();
    print(&format!("{}\nIt runs with\n  {}\n", written.join(", "), command(start, &scene)));
    Ok(())
}

/// The file of a yarn to be changed: what of it is a guess stands in it, since none of its values is measured.
fn yarn() -> Result<String, Error> {
    let found = |name: &str| Error::Input(format!("{name} is not built in"));
    let model = Preset::from(toron::preset(MODEL).ok_or_else(|| found(MODEL))?);
    let units = UnitSystem::parse(UNITS).ok_or_else(|| found(UNITS))?;
    let mut yarn = Preset::new(YARN, &format!("a copy of {MODEL}, to be changed"), model.law, units);
    let mut comments = BTreeMap::new();
    let origin = format!("of {MODEL}");
    for (place, property) in HYPERELASTIC.iter().enumerate().take(FIBRE) {
        yarn.values[place] = model.value(place, &units).map(rounded);
        yarn.guesses.insert(property.name, &origin);
        comments.insert(property.name, format!("{}: {}", unit(&units, property.dimension), property.meaning));
    }
    yarn.density = model.density_in(&units).map(rounded);
    yarn.guesses.insert("density", &origin);
    comments.insert("density", unit(&units, DENSITY));
    Ok(yarn.to_toml(&comments))
}

/// Without what a conversion of units has left in the last digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

fn command(start: &Start, scene: &Path) -> String {
    shell::command(&["toron", start.command, &scene.display().to_string()].map(str::to_string))
}

/// The scenes, with what each is about: the first line of its file.
fn list() -> String {
    let about = |start: &Start| start.text.lines().next().unwrap_or_default().trim_start_matches("# ").to_string();
    let row = |start: &Start| vec![start.name.to_string(), format!("toron {}", start.command), about(start)];
    let rows: Vec<Vec<String>> = STARTS.iter().map(row).collect();
    let line = |cells: &Vec<String>| format!("  {:<10}  {:<12}  {}\n", cells[0], cells[1], cells[2]);
    let table = plain_table(&["name", "for", "what it is"], &rows, || rows.iter().map(line).collect());
    format!("{table}\ntoron init NAME writes NAME.toml and, where it has one, its yarn, {YARN}.toml\n")
}
