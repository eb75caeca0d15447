//! The committed schemas and tables of keys are those of the types that read the files, and the schemas take the files
//! that the readers take. `cargo xtask update keys` writes schemas and tables anew.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use serde_json::Value;
use toron_keys::check::check;
use toron_keys::{page, schema};
use toron_test_support::library::ROOT;
use toron_test_support::update::is_asked;

/// Where the program has them, which writes them beside a scene.
const SCHEMAS: &str = "program/assets/schema";
/// That of `check` is printed by `umat-check` too, without the program.
const OF_CHECK: &str = "packages/umat-check/input.schema.json";
/// From `docs/`.
const PAGES: [&str; 8] = [
    "guides/cell.md",
    "guides/load-paths.md",
    "reference/check-lines.md",
    "reference/fabric-files.md",
    "reference/fibre-files.md",
    "reference/fit-files.md",
    "reference/impact-files.md",
    "reference/v50-files.md",
];
/// Folders of files that are read.
const FOLDERS: [&str; 3] = ["examples", "program/assets/init", "ffi-tests/check/laws"];

fn of(kind: &str) -> Value {
    let found = schema::all().into_iter().find(|(name, _)| *name == kind);
    found.unwrap_or_else(|| panic!("there is no schema {kind}")).1
}

/// Writes a file anew if that is asked for; else holds it against what it should be.
fn hold(path: &Path, wanted: &str) {
    if is_asked("keys") {
        std::fs::write(path, wanted).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    }
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    assert!(text == wanted, "{} is stale; cargo xtask update keys writes it anew", path.display());
}

#[test]
fn schemas_are_current() {
    let folder = Path::new(ROOT).join(SCHEMAS);
    let mut names = BTreeSet::new();
    for (kind, schema) in schema::all() {
        if kind == "check" {
            hold(&Path::new(ROOT).join(OF_CHECK), &schema::text(&schema));
            continue;
        }
        names.insert(format!("{kind}.json"));
        hold(&folder.join(format!("{kind}.json")), &schema::text(&schema));
    }
    let found = std::fs::read_dir(&folder).expect("the folder").map(|entry| entry.expect("an entry").file_name());
    assert_eq!(found.map(|name| name.into_string().expect("a name")).collect::<BTreeSet<_>>(), names);
}

/// Between `<!-- keys of KIND: TABLE -->` and `<!-- end -->`; without a table it is the file itself.
#[test]
fn pages_are_current() {
    for page in PAGES {
        let path = Path::new(ROOT).join("docs").join(page);
        let text = std::fs::read_to_string(&path).expect(page);
        let mut parts = text.split("<!-- keys of ");
        let mut new = parts.next().expect("a beginning").to_string();
        let mut tables = 0;
        for part in parts {
            let (name, rest) = part.split_once(" -->").expect("the mark ends");
            let (_, after) = rest.split_once("<!-- end -->").expect("the table ends");
            let (kind, table) = name.split_once(": ").unwrap_or((name, ""));
            new += &format!("<!-- keys of {name} -->\n{}<!-- end -->{after}", page::table(&of(kind), table, page));
            tables += 1;
        }
        assert!(tables > 0, "{page} has no table of keys");
        hold(&path, &new);
    }
}

/// The TOML files in a folder and those below.
fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "toml") {
            found.push(path);
        }
    }
}

/// The kind of a file, by the tables that only such a file has.
fn kind(file: &toml::Table) -> &'static str {
    let has = |key: &str| file.contains_key(key);
    let of_fibres = || file["scene"].get("fibre").is_some();
    match () {
        () if has("weave") || has("mesh") => {
            if has("scene") {
                "fabric"
            } else {
                "weave"
            }
        }
        () if has("scene") => {
            if of_fibres() {
                "fibres"
            } else {
                "impact"
            }
        }
        () if has("cell") => "cell",
        () if has("step") => "run",
        () if has("blow") => "blow",
        () if has("law") || has("properties") => "preset",
        () => "fit",
    }
}

/// The examples, with their kinds.
fn examples() -> Vec<(PathBuf, &'static str, toml::Table)> {
    let mut paths = Vec::new();
    FOLDERS.iter().for_each(|folder| files(&Path::new(ROOT).join(folder), &mut paths));
    let read = |path: PathBuf| {
        let text = std::fs::read_to_string(&path).expect("a file");
        let file: toml::Table = toml::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let is_law = path.strip_prefix(ROOT).is_ok_and(|path| path.starts_with("ffi-tests"));
        (path, if is_law { "check" } else { kind(&file) }, file)
    };
    paths.retain(|path| path.file_name().is_none_or(|name| name != "Cargo.toml"));
    paths.into_iter().map(read).chain(shown()).collect()
}

/// The whole files that the pages show: those with `units`, and that of a check.
fn shown() -> Vec<(PathBuf, &'static str, toml::Table)> {
    let mut found = Vec::new();
    for page in PAGES {
        let text = std::fs::read_to_string(Path::new(ROOT).join("docs").join(page)).expect(page);
        for block in text.split("```toml\n").skip(1) {
            let (block, _) = block.split_once("```").expect("a block ends");
            let file: toml::Table = toml::from_str(block).unwrap_or_else(|error| panic!("{page}: {error}"));
            if file.contains_key("units") {
                found.push((PathBuf::from(page), kind(&file), file));
            } else if page == "reference/check-lines.md" {
                found.push((PathBuf::from(page), "check", file));
            }
        }
    }
    found
}

#[test]
fn examples_are_as_their_schemas_want_them() {
    let mut kinds = BTreeSet::new();
    for (path, kind, file) in examples() {
        let root = of(kind);
        let found = check(&root, &root, &toml::Value::Table(file), kind);
        found.unwrap_or_else(|fault| panic!("{}: {fault}", path.display()));
        kinds.insert(kind);
    }
    assert_eq!(kinds, schema::all().into_iter().map(|(kind, _)| kind).collect());
}

/// What the readers refuse in the same words of TOML.
#[test]
fn mistakes_are_refused() {
    let fault = |kind: &str, text: &str| {
        let root = of(kind);
        let file: toml::Table = toml::from_str(text).expect("TOML");
        check(&root, &root, &toml::Value::Table(file), kind).expect_err(text)
    };
    for (kind, text, wanted) in [
        ("fabric", "units = \"si\"\n[scene]\nsped = 1", "fabric.scene.sped: an unknown key"),
        ("fabric", "units = \"si\"\n[scene]\nname = \"a\"", "fabric.scene.name: an unknown key"),
        ("fabric", "units = \"si\"\n[scene]\nspeed = 0", "fabric.scene.speed: 0 against exclusiveMinimum 0"),
        ("fabric", "units = \"si\"\n[scene]\nspeed = \"fast\"", "fabric.scene.speed: no \"number\""),
        ("fabric", "units = \"si\"\n[scene]\naim = [0.0]", "fabric.scene.aim: too few entries"),
        ("fabric", "units = \"si\"\n[scene]\n[[case]]\nspeed = 1", "fabric.case[0]: name is missing"),
        ("fabric", "[scene]", "fabric: units is missing"),
        ("weave", "units = \"si\"\nweave.along = 65", "weave.weave.along: 65 against maximum 64"),
        ("weave", "units = \"si\"\nweave.warp.pich = 1", "weave.weave.warp.pich: an unknown key"),
        ("weave", "units = \"si\"\nweave.pattern = \"twill\"", "weave.weave.pattern: none of the choices, or several"),
        ("impact", "units = \"si\"\n[scene]\nrows = 2.5", "impact.scene.rows: no \"integer\""),
        ("impact", "units = \"si\"\n[scene]\nheld = 1", "impact.scene.held: no \"boolean\""),
        ("check", "[[expect]]\nsource = \"by hand\"\nstress = [1.0]", "check.expect[0]: strain is missing"),
        ("check", "[[expect]]\nstrain = [1.0]\nstress = [1.0]", "check.expect[0]: source is missing"),
        ("check", "defgrad = \"R\"", "check.defgrad: String(\"R\") is none of [\"RU\",\"U\"]"),
        ("check", "[allow]\ntangent = 0.0", "check.allow.tangent: 0 against exclusiveMinimum 0"),
    ] {
        assert_eq!(fault(kind, text), wanted, "{text}");
    }
    let word = fault("impact", "units = \"si\"\n[scene]\nsection = \"circle\"");
    assert!(word.starts_with("impact.scene.section: String(\"circle\") is none of"), "{word}");
}
