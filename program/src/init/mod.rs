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

/// A scene and the command that runs it.
struct Start {
    name: &'static str,
    command: &'static str,
    text: &'static str,
}

/// In the order of the commands.
static STARTS: [Start; 8] = [
    Start { name: "data-sheet", command: "fit", text: include_str!("../../assets/init/data-sheet.toml") },
    Start { name: "path", command: "run", text: include_str!("../../assets/init/path.toml") },
    Start { name: "weave", command: "weave", text: include_str!("../../assets/init/weave.toml") },
    Start { name: "fabric", command: "fabric", text: include_str!("../../assets/init/fabric.toml") },
    Start { name: "yarn", command: "impact", text: include_str!("../../assets/init/yarn.toml") },
    Start { name: "v50", command: "v50", text: include_str!("../../assets/init/v50.toml") },
    Start { name: "fibres", command: "fibres", text: include_str!("../../assets/init/fibres.toml") },
    Start { name: "cell", command: "cell", text: include_str!("../../assets/init/cell.toml") },
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
}

/// Lists the scenes, or writes one, with its yarn.
///
/// # Errors
/// There is no such scene, or a file cannot be written.
pub fn run(Arguments { name, output }: &Arguments) -> Result<(), Error> {
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
    let place = |name: &str| output.as_deref().unwrap_or(Path::new("")).join(format!("{name}.toml"));
    let scene = place(start.name);
    kept_file::write(&scene, |file| file.write_all(start.text.as_bytes()))?;
    let mut written = vec![scene.clone()];
    let yarn = place(YARN);
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
