//! The documents say what the library says. What stands in them between `<!-- generated: NAME -->` and `<!-- end -->`
//! is the library's own words, or what the program prints where NAME is a command; `cargo xtask update documents`
//! writes it anew. The programs shown there compile and print what is shown behind them, links lead to a file and to a
//! heading in it, and the code names of the symbols exist.

use std::collections::BTreeSet;
use std::ffi::c_char;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::ptr::{null, null_mut};

use toron_build_number::{OF_MATERIALS, OF_PROGRAM};

use nalgebra::{Matrix3, Vector3};
use toron::host::abaqus::{StandardLaw, Umat};
use toron::host::constants::TORON_MESSAGE_CAPACITY;
use toron::host::lsdyna::{self, UserRoutines};
use toron::host::units::UnitSystem;
use toron::law::block::Circumstances;
use toron::law::parameters::{self, DENSITY, Dimension, FIBRE, PRESETS, Preset, Property};
use toron::law::state::{self, ENERGIES, FAILED, HYPERELASTIC_STATE, INVARIANTS, StateVariable};
use toron::law::status;
use toron::{Criterion, LinearElastic, Rotation};
use toron::{Hyperelastic, Point, Request};
use toron_test_support::library::{LIBRARY, ROOT, SYSTEM, folder, run};
use toron_test_support::update::is_asked;

const DOCUMENTS: [&str; 14] = [
    "../README.md",
    "reference/theory.md",
    "reference/tables.md",
    "guides/hosts.md",
    "guides/hosts/ls-dyna.md",
    "guides/hosts/abaqus.md",
    "guides/hosts/calculix.md",
    "guides/hosts/openradioss.md",
    "guides/hosts/mgis.md",
    "guides/load-paths.md",
    "guides/identification.md",
    "guides/fabric.md",
    "results/validation.md",
    "tutorial.md",
];

fn document(name: &str) -> PathBuf {
    Path::new(ROOT).join("docs").join(name)
}

fn read(name: &str) -> String {
    std::fs::read_to_string(document(name)).unwrap_or_else(|error| panic!("docs/{name}: {error}"))
}

/// A Markdown table.
fn table<const N: usize>(head: [&str; N], rows: impl IntoIterator<Item = [String; N]>) -> String {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let rows: String = rows.into_iter().map(|row| line(&row.map(|cell| cell.replace('|', "\\|")))).collect();
    format!("{}|{}\n{rows}", line(&head.map(String::from)), "---|".repeat(N))
}

fn properties(properties: &[Property]) -> String {
    let head = ["no", "name", "symbol", "dimension", "default", "allowed", "meaning"];
    let rows = properties.iter().enumerate().map(|(i, row)| {
        let default = row.default.map_or("must be given".into(), |value| value.to_string());
        let text = [row.symbol, row.dimension.name].map(String::from);
        let [symbol, dimension] = text;
        let no = (i + 1).to_string();
        [no, format!("`{}`", row.name), symbol, dimension, default, row.allowed.into(), row.meaning.into()]
    });
    table(head, rows)
}

fn state_variables(variables: &[StateVariable]) -> String {
    let rows = variables.iter().enumerate().map(|(i, row)| {
        let no = (i + 1).to_string();
        [no, format!("`{}`", row.name), row.symbol.into(), row.dimension.name.into(), row.meaning.into()]
    });
    table(["no", "name", "symbol", "dimension", "meaning"], rows)
}

fn presets() -> String {
    const SYSTEMS: [&str; 3] = ["si", "mm-tonne-s", "mm-kg-ms"];
    let text = |preset: &Preset| {
        let rows = preset.table().iter().zip(preset.values).map(|(row, &value)| (row.name, value, row.dimension));
        let rows = rows.chain([("density", preset.density, DENSITY)]).map(|(name, value, dimension)| {
            let [a, b, c] = SYSTEMS.map(|system| quantity(system, value, dimension));
            [format!("`{name}`"), a, b, c]
        });
        let [si, tonne, kilogram] = SYSTEMS;
        format!("`{}`: {}\n\n{}", preset.name, preset.source, table(["property", si, tonne, kilogram], rows))
    };
    PRESETS.each_ref().map(text).join("\n")
}

/// To twelve digits, which is what the conversion of units keeps.
fn quantity(system: &str, si: f64, dimension: Dimension) -> String {
    let value = UnitSystem::parse(system).expect("a unit system").from_si(si, dimension);
    let value: f64 = format!("{value:.11e}").parse().expect("a number");
    if value == 0.0 || (1e-3..1e6).contains(&value) { value.to_string() } else { format!("{value:e}") }
}

/// What a host does at a code, in the words of the page, and what the user can do.
fn answer_to(code: i32) -> [&'static str; 2] {
    const POINT: &str = "deletes or repeats";
    match code {
        status::OK => ["goes on", ""],
        status::NULL_ARGUMENT => ["stops", "pass the array that the message names"],
        status::BAD_COUNT => ["stops", "Abaqus: mesh solids; else pass the count that the message names"],
        status::BAD_LEADING_DIMENSION => ["stops", "pass one no less than the number of points"],
        status::UNKNOWN_NAME => ["stops", "compare the spelling with this page, or with `toron params`"],
        status::BAD_ARGUMENT => [
            "stops",
            "change the value that the message names; in Abaqus and CalculiX it may be a state variable of the deck",
        ],
        status::NO_DEFORMATION_GRADIENT => [
            "stops",
            "Abaqus/Standard, CalculiX: `NLGEOM`; LS-DYNA: IHYPER and NHV as `toron deck` prints them; OpenRadioss: \
             Ismstr, Isolid, Iframe, and the library of the solver's precision",
        ],
        status::NOT_PREPARED => ["stops", "call the prepare function of this law and precision first"],
        status::BAD_SIZE => ["stops", "set `size` to the `sizeof` of the structure"],
        status::UNKNOWN_FIELD => ["stops", "load a library as new as the header"],
        status::PROPERTY_COUNT => ["stops", "print the card anew by `toron deck`"],
        status::PROPERTY_NOT_FINITE => ["stops", "correct the property that the message names"],
        status::PROPERTY_OUT_OF_BOUNDS => {
            ["stops", "correct the property that the message names; look for a shifted column, and for other units"]
        }
        status::PROPERTY_DIRECTION => ["stops", "give a fibre, and a second axis that is not along it"],
        status::FIBRE_OUT_OF_PLANE => ["stops", "turn the direction into the plane (component 3 is 0) or normal to it"],
        status::STATE_COUNT => ["stops", "correct `*DEPVAR` or NHV by the card of `toron deck`"],
        status::INVERTED => [
            POINT,
            "look for units other than the mesh's, too stiff a contact, too long a step, \
             [modes without stiffness](../guides/hosts.md#what-every-model-needs)",
        ],
        status::NOT_FINITE => [POINT, "the solver has lost the deformation before the call: as for −301"],
        status::OVERFLOW => [POINT, "as for −301; in single precision try double"],
        status::STATE_NOT_FINITE => {
            ["deletes or repeats; CalculiX stops", "start state variables at 0; look for what else writes to them"]
        }
        status::FIBRE_DIRECTION => [
            "deletes or repeats; OpenRadioss and CalculiX stop",
            "give every element a fibre direction, not along the second axis",
        ],
        status::INCREMENT_TOO_LARGE => [POINT, "take smaller steps; as for −301"],
        status::MATERIAL_AXES => {
            ["returns to code of your own", "start with the law's axes, keep those that each step returns"]
        }
        status::LIMIT => ["deletes or repeats; OpenRadioss stops", "give 0, or a positive limit"],
        status::LAW => [POINT, "a [law of your own](../guides/own-law.md) says why in the message"],
        status::SMALLER_STEP => [POINT, "take smaller steps; only laws of your own ask for them"],
        code => panic!("what does a user do about {code}?"),
    }
}

fn status_codes() -> String {
    let rows = status::TABLE.iter().map(|&(code, name, meaning)| {
        let [host, remedy] = answer_to(code).map(String::from);
        [code.to_string(), format!("`TORON_{}`", name.to_uppercase()), meaning.into(), host, remedy]
    });
    table(["code", "name in C", "message: what has happened", "the host", "what to do"], rows)
}

/// Decks with mistakes in them, and what the library says of each.
fn mistakes() -> String {
    let km2 = km2("mm-tonne-s");
    let with = |index: usize, value: f64| {
        let mut values = km2.clone();
        values[index] = value;
        values
    };
    let mut no_fibre = km2.clone();
    no_fibre[FIBRE..].fill(0.0);
    let mut linear_elastic = preset("kevlar-km2-600-linear", "mm-tonne-s");
    linear_elastic.resize(km2.len(), 0.0);
    let refused = [
        ("`CONSTANTS=8`: a data line of the properties is missing", km2[..8].to_vec()),
        ("a stiffness with the wrong sign", with(0, -82341.0)),
        ("p left at 0: a column of the card is shifted", with(2, 0.0)),
        ("the fibre direction left at 0", no_fibre),
        ("LS-DYNA: the linear elastic preset on the hyperelastic card", linear_elastic),
    ];
    let refused = refused.map(|(mistake, values)| {
        let error = Hyperelastic::new(&values).expect_err("a mistake");
        [mistake.to_string(), error.code().to_string(), error.to_string()]
    });
    let calls = [
        ("`*DEPVAR` with fewer than 11 variables", umat(&km2, 8, 3, 1)),
        ("Abaqus: shells, membranes or plane-stress elements", umat(&km2, 11, 2, 1)),
        ("UMAT without NLGEOM=YES", umat(&km2, 11, 3, 0)),
        ("LS-DYNA: IHYPER left at 0", element_without_f(&km2)),
    ];
    let calls = calls.map(|(mistake, (code, message))| [mistake.into(), code.to_string(), message]);
    table(["mistake", "status", "message"], refused.into_iter().chain(calls))
}

/// What an entry returns and writes.
fn answer(entry: impl FnOnce(*mut c_char, usize) -> i32) -> (i32, String) {
    let mut text = [0_u8; TORON_MESSAGE_CAPACITY];
    let code = entry(text.as_mut_ptr().cast(), text.len());
    let text = text.split(|&byte| byte == 0).next().expect("a text");
    (code, String::from_utf8_lossy(text).into_owned())
}

/// A UMAT at rest with so many state variables and direct components, and Abaqus's flag of large displacements.
fn umat(properties: &[f64], state: i32, direct: i32, nlgeom: i32) -> (i32, String) {
    let f = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let (mut stress, mut statev, mut energy, mut step) = ([0.0; 6], [0.0; 11], 0.0, 1.0);
    let call = Umat {
        stress: stress.as_mut_ptr(),
        statev: statev.as_mut_ptr(),
        ddsdde: null_mut(),
        sse: &mut energy,
        pnewdt: &mut step,
        dfgrd0: null(),
        dfgrd1: f.as_ptr(),
        props: properties.as_ptr(),
        nprops: properties.len() as i32,
        nstatv: state,
        ndi: direct,
        nshr: 3,
        nlgeom,
        circumstances: Circumstances::UNKNOWN,
    };
    // SAFETY: the arrays have the sizes that the structure tells.
    answer(|message, capacity| unsafe { <Hyperelastic as StandardLaw>::umat(&call, message, capacity) })
}

/// An element of LS-DYNA whose history holds no F.
fn element_without_f(properties: &[f64]) -> (i32, String) {
    let (mut stress, mut history, mut failed) = ([0.0; 6], [0.0; 20], 0);
    let (cm, sig, hsv) = (properties.as_ptr(), stress.as_mut_ptr(), history.as_mut_ptr());
    let call = lsdyna::Umat { cm, sig, hsv, nhv: 11, failel: &mut failed };
    // SAFETY: the arrays have the sizes that the structure tells.
    answer(|message, capacity| unsafe { <Hyperelastic as UserRoutines<f64>>::umat(&call, message, capacity) })
}

/// What a VUMAT with a wrong property says, with the prefix that the shim writes.
fn message() -> String {
    let mut values = km2("mm-tonne-s");
    values[2] = 0.0;
    let error = Hyperelastic::new(&values).expect_err("a mistake");
    fenced(&format!("toron, material KEVLAR-KM2-600: {error}\n"))
}

/// Kevlar KM2, multiaxial failure.
fn km2(system: &str) -> Vec<f64> {
    preset("kevlar-km2-600", system)
}

fn preset(name: &str, system: &str) -> Vec<f64> {
    let preset = parameters::preset(name).expect("a preset");
    let units = UnitSystem::parse(system).expect("a unit system");
    preset.table().iter().zip(preset.values).map(|(row, &value)| units.from_si(value, row.dimension)).collect()
}

/// What the command prints: cards, for the documents to show.
fn printed(arguments: &str) -> String {
    let output = run(Command::new(env!("CARGO_BIN_EXE_toron")).args(arguments.split(' ')), "");
    fenced(&String::from_utf8(output.stdout).expect("UTF-8"))
}

/// What `toron fit` prints of an example, whose files go to this folder.
fn fit(example: &str, output: &Path) -> String {
    let mut program = Command::new(env!("CARGO_BIN_EXE_toron"));
    let arguments = ["fit", &format!("examples/identification/{example}.toml"), "-o"];
    let printed = run(program.args(arguments).arg(output).current_dir(ROOT), "");
    let text = String::from_utf8(printed.stdout).expect("UTF-8");
    let (report, _) = text.split_once("  written ").expect("the files are named last");
    fenced(report)
}

fn fit_of_energies() -> String {
    let output = folder("fit-of-energies");
    let report = fit("energies", &output);
    if is_asked("pictures") {
        std::fs::copy(output.join("fit.png"), document("images/fit.png")).expect("docs/images/fit.png");
    }
    report
}

/// What `toron weave` prints of its example.
fn figures_of_the_weave() -> String {
    let output = folder("documents-weave");
    let mut program = Command::new(env!("CARGO_BIN_EXE_toron"));
    program.args(["weave", "examples/fabric_impact/weave.toml", "-o"]).arg(output).current_dir(ROOT);
    let text = String::from_utf8(run(&mut program, "").stdout).expect("UTF-8");
    let (figures, _) = text.split_once("\nFiles in ").expect("the files are named last");
    fenced(figures)
}

fn fenced(text: &str) -> String {
    format!("```text\n{text}```\n")
}

/// The hyperelastic yarn stretched along its fibre.
fn stretched(law: &Hyperelastic<f64>, stretch: f64) -> Point<f64> {
    let f = Matrix3::from_diagonal(&Vector3::new(stretch, 1.0, 1.0));
    law.point(&f, &[0.0; HYPERELASTIC_STATE], Request::ALL)
}

/// The least strain, in per cent, at which a stretch along the fibre fails.
fn failure_strain(fails: impl Fn(f64) -> bool) -> f64 {
    let (mut intact, mut failed) = (0.0, 0.1);
    assert!(!fails(1.0 + intact) && fails(1.0 + failed));
    for _ in 0..50 {
        let middle = 0.5 * (intact + failed);
        *(if fails(1.0 + middle) { &mut failed } else { &mut intact }) = middle;
    }
    100.0 * failed
}

/// The thesis's numbers that one point shows, each to half of its last digit; the library's density of 1351.4 kg/m³ is
/// rounded from 1440 · 0.93848, which moves the linear law's wave by 0.02 m/s.
fn figures() -> String {
    let mut values = km2("mm-tonne-s");
    values[6..FIBRE].fill(0.0);
    let law = Hyperelastic::<f64>::new(&values).expect("uniaxial failure");
    let at_limit = stretched(&law, 1.0458);
    let flat = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 0.7));
    let flat = law.point(&flat, &[0.0; HYPERELASTIC_STATE], Request::ALL);
    let si = Hyperelastic::<f64>::new(&km2("si")).expect("the preset");
    let linear = LinearElastic::new(&preset("kevlar-km2-600-linear", "si")).expect("the preset");
    let linear_fails = |stretch: f64| {
        let (one, f) = (Matrix3::identity(), Matrix3::from_diagonal(&Vector3::new(stretch, 1.0, 1.0)));
        let mut axes = linear.reference_axes();
        let old = [0.0; state::LINEAR_ELASTIC_STATE];
        let point = linear.step(&one, &f, &old, Rotation::Fibre, Criterion::LargestPrincipal, &mut axes);
        point.state[state::LINEAR_FAILED] == 1.0
    };
    let wave = |modulus: f64| (modulus / 1351.4).sqrt();
    let fibre_wave = wave(stretched(&si, 1.0).wave_modulus);
    let rows: [(&str, &str, usize, f64, f64, f64); 9] = [
        ("limit elongation invariant ln(1 + ε_lim)", "", 6, 0.044782, 5e-7, at_limit.state[INVARIANTS]),
        ("energy density at uniaxial failure", "mJ/mm³", 2, 82.56, 5e-3, at_limit.state[ENERGIES]),
        ("strain at uniaxial failure", "%", 2, 4.58, 5e-3, failure_strain(|l| stretched(&law, l).state[FAILED] == 1.0)),
        ("longitudinal wave, hyperelastic", "m/s", 2, 7806.0, 0.5, fibre_wave),
        ("longitudinal wave, linear elastic", "m/s", 2, 7665.76, 0.03, wave(linear.wave_modulus())),
        ("that wave over half a yarn of 25.4 mm, hyperelastic", "µs", 2, 1.65, 0.05, 12.7e3 / fibre_wave),
        (
            "strain at failure, linear elastic: σ_lim/E1 is a true strain",
            "%",
            2,
            4.69,
            5e-3,
            failure_strain(linear_fails),
        ),
        ("I_tc of diag(1, 1, 0.7): ½ ln 0.7 (Eq. 4.28)", "", 5, -0.17834, 5e-6, flat.state[INVARIANTS + 1]),
        ("I_td of the same: −½ ln 0.7", "", 5, 0.17834, 5e-6, flat.state[INVARIANTS + 2]),
    ];
    let rows = rows.map(|(name, unit, digits, thesis, tolerance, found)| {
        assert!((found - thesis).abs() <= tolerance, "{name}: {found}, not {thesis}");
        [name.into(), format!("{thesis}"), format!("{found:.digits$}"), unit.into()]
    });
    table(["one point", "thesis", "library", "unit"], rows)
}

fn generate(name: &str) -> String {
    match name {
        "hyperelastic properties" => properties(&parameters::HYPERELASTIC),
        "hyperelastic state" => state_variables(&state::HYPERELASTIC),
        "linear elastic properties" => properties(&parameters::LINEAR_ELASTIC),
        "linear elastic state" => state_variables(&state::LINEAR_ELASTIC),
        "frictional properties" => properties(&parameters::FRICTIONAL),
        "frictional state" => state_variables(&state::FRICTIONAL),
        "presets" => presets(),
        "status codes" => status_codes(),
        "message" => message(),
        "mistakes" => mistakes(),
        "figures" => figures(),
        "fit of energies" => fit_of_energies(),
        "fit of strengths" => fit("strength-kevlar-49", &folder("fit-of-strengths")),
        "figures of the weave" => figures_of_the_weave(),
        name => match name.strip_prefix("toron ") {
            Some(arguments) => printed(arguments),
            None => panic!("nothing is generated under the name {name}"),
        },
    }
}

/// The document with every generated part written anew, and how many there are.
fn regenerated(text: &str) -> (String, usize) {
    let (mut new, mut rest, mut count) = (String::new(), text, 0);
    while let Some((before, after)) = rest.split_once("<!-- generated: ") {
        let (name, after) = after.split_once(" -->").expect("the comment is closed");
        let (_, after) = after.split_once("<!-- end -->").expect("the part has an end");
        new += &format!("{before}<!-- generated: {name} -->\n{}<!-- end -->", generate(name));
        rest = after;
        count += 1;
    }
    (new + rest, count)
}

#[test]
fn generated_parts_are_current() {
    let mut count = 0;
    for name in DOCUMENTS {
        let (text, parts) = regenerated(&read(name));
        if is_asked("documents") {
            std::fs::write(document(name), &text).expect("docs are writable");
        }
        assert!(read(name) == text, "docs/{name} is not current: cargo xtask update documents");
        count += parts;
    }
    assert_eq!(count, 21, "a part has got lost");
}

/// The fenced blocks of a document in their order: language and text.
fn blocks(text: &str) -> Vec<(String, String)> {
    let mut parts = text.split("\n```").skip(1);
    let mut blocks = Vec::new();
    while let Some(block) = parts.next() {
        let (language, code) = block.split_once('\n').expect("a line of code");
        blocks.push((language.into(), format!("{code}\n")));
        parts.next().expect("the block is closed");
    }
    blocks
}

#[test]
fn programs_print_what_is_shown() {
    let compilers: [(&str, &str, &[&str]); 2] = [
        ("c", "gcc", &["-std=c11", "-Wall", "-Wextra", "-Werror"]),
        ("fortran", "gfortran", &["-std=f2018", "-Wall", "-Werror"]),
    ];
    let blocks = blocks(&read("guides/c.md"));
    let mut programs = 0;
    for (i, (language, code)) in blocks.iter().enumerate() {
        let Some((_, compiler, options)) = compilers.iter().find(|row| row.0 == language) else { continue };
        let (output_language, shown) = &blocks[i + 1];
        assert_eq!(output_language, "text", "a program's output follows it");
        programs += 1;
        let folder = folder(&format!("documents-{programs}"));
        let source = folder.join(if *compiler == "gcc" { "point.c" } else { "point.f90" });
        std::fs::write(&source, code).expect("a source");
        let mut command = Command::new(compiler);
        command.current_dir(&folder).args(*options).arg(format!("-I{ROOT}/include"));
        if *compiler == "gfortran" {
            command.arg(Path::new(ROOT).join("include/toron.f90"));
        }
        let program = folder.join("point");
        command.arg(&source).arg(LIBRARY.join("libtoron.a")).args(SYSTEM);
        run(command.arg("-o").arg(&program), compiler);
        let output = run(&mut Command::new(program), "");
        assert_eq!(String::from_utf8_lossy(&output.stdout), *shown, "{code}");
    }
    assert_eq!(programs, 3, "a program has got lost");
}

/// Every document with links to others.
fn linked_documents() -> Vec<PathBuf> {
    let markdown = |folder: &str| {
        let entries = std::fs::read_dir(Path::new(ROOT).join(folder)).expect("a folder");
        let paths = entries.map(|entry| entry.expect("an entry").path());
        paths.filter(|path| path.extension().is_some_and(|ending| ending == "md")).collect::<Vec<_>>()
    };
    [
        ".",
        "docs",
        "docs/guides",
        "docs/guides/hosts",
        "docs/design",
        "docs/reference",
        "docs/results",
        "fortran-shim",
        "ffi-tests",
        "examples/one-element",
    ]
    .map(markdown)
    .concat()
}

/// `cargo install` takes other versions of packages than Cargo.lock has, unless it is told not to.
#[test]
fn installations_are_locked() {
    let scripts = ["install.sh", "test.sh"].map(|name| Path::new(ROOT).join(name));
    let mut found = 0;
    for file in linked_documents().into_iter().chain(scripts) {
        let text = std::fs::read_to_string(&file).expect("text");
        for line in text.lines().filter(|line| line.contains("cargo install ")) {
            assert!(line.contains("cargo install --locked"), "{}: {line}", file.display());
            found += 1;
        }
    }
    assert!(found >= 2, "the README and the tutorial have one each");
}

/// A heading as a link names it: small letters, digits and hyphens.
fn anchor(heading: &str) -> String {
    let kept = |c: &char| c.is_alphanumeric() || "-_ ".contains(*c);
    heading.trim().to_lowercase().chars().filter(kept).collect::<String>().replace(' ', "-")
}

#[test]
fn links_lead_somewhere() {
    let mut links = 0;
    for document in linked_documents() {
        let text = std::fs::read_to_string(&document).expect("a document");
        let prose: String = text.split("```").step_by(2).collect();
        for target in prose.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            if target.starts_with("https://") {
                continue;
            }
            let (file, heading) = target.split_once('#').unwrap_or((target, ""));
            let path = if file.is_empty() { document.clone() } else { document.with_file_name("").join(file) };
            assert!(path.exists(), "{}: {target} does not exist", document.display());
            links += 1;
            if !heading.is_empty() {
                let there = std::fs::read_to_string(&path).expect("a document");
                let found =
                    there.lines().filter(|line| line.starts_with('#')).map(|line| anchor(line.trim_start_matches('#')));
                assert!(found.into_iter().any(|found| found == heading), "{}: no heading {target}", document.display());
            }
        }
    }
    assert!(links > 50, "{links} links");
}

/// An installation has no folder docs: what the program says, and what it writes into decks, names no file there.
#[test]
fn no_message_points_at_a_file_of_the_sources() {
    let sources = OF_MATERIALS.iter().chain(&OF_PROGRAM);
    let mut folders: Vec<_> = sources.map(|folder| Path::new(ROOT).join(folder)).collect();
    let mut lines = 0;
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder").flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                let text = std::fs::read_to_string(&path).expect("a source");
                for line in text.lines().filter(|line| !line.trim_start().starts_with("//")) {
                    let is_message = line.contains("docs/") && !line.contains("include_str!");
                    assert!(!is_message, "{}: {line}", path.display());
                    lines += 1;
                }
            }
        }
    }
    assert!(lines > 10_000, "{lines} lines");
}

/// Rows of the table of symbols: `| no | symbol | meaning | `name` | `file` |`.
#[test]
fn symbols_have_the_names_that_they_are_said_to_have() {
    let theory = read("reference/theory.md");
    let (_, symbols) = theory.split_once("## Symbols").expect("a table of symbols");
    let rows: Vec<_> = symbols.lines().filter(|line| line.starts_with("| ")).skip(1).collect();
    assert!(rows.len() > 20);
    for (i, row) in rows.iter().enumerate() {
        let cells: Vec<_> = row.trim_matches('|').split(" | ").map(str::trim).collect();
        let [no, _, _, names, file] = cells[..] else { panic!("{row}") };
        assert_eq!(no, (i + 1).to_string(), "{row}");
        let file = file.trim_matches('`');
        let source = std::fs::read_to_string(Path::new(ROOT).join("src/law").join(file)).expect(file);
        for name in names.split(", ") {
            let name = name.trim_matches('`');
            let word = |c: char| !c.is_alphanumeric() && c != '_';
            assert!(source.split(word).any(|token| token == name), "{name} is not in {file}");
        }
    }
}

/// The words of a page that stand as code, such as keys and columns.
pub fn code_words(page: &str) -> BTreeSet<String> {
    let text = read(page);
    let spans = text.split('`').skip(1).step_by(2);
    let word = |c: char| !c.is_alphanumeric() && !"_-".contains(c);
    spans.flat_map(|span| span.split(word)).map(String::from).collect()
}

/// What a file may have the program says itself, when it refuses a key.
#[test]
fn the_guides_have_the_keys_that_the_program_reads() {
    const NONE: &str = "no-such-key = 1";
    const FABRIC: &str = "reference/fabric-files.md";
    let rows: [(&str, &str, &[&str]); 8] = [
        ("run", "guides/load-paths.md", &["", "[material]", "[[point]]", "[[step]]", "[plot]"]),
        ("fit", "reference/fit-files.md", &["", "[yarn]", "[fibre]", "[[data]]", "[[strength]]"]),
        ("cell", "guides/cell.md", &["", "[fibre]", "[cell]", "[cell.box]", "[loads]", "[yarn]"]),
        ("impact", "reference/impact-files.md", &["", "[scene]", "[[case]]"]),
        ("v50", "reference/v50-files.md", &["[shots]"]),
        ("fibres", "reference/fibre-files.md", &["", "[scene]", "[scene.fibre]", "[[case]]"]),
        ("weave", FABRIC, &["", "[weave]", "[weave.warp]", "[weave.weft]", "[weave.panel]", "[mesh]"]),
        ("fabric", FABRIC, &["", "[scene]", "[[case]]", "[scene.strength]", "[scene.strength.warp]"]),
    ];
    let mut keys = 0;
    for (command, page, tables) in rows {
        let known = code_words(page);
        let output = folder(&format!("keys-of-{command}"));
        for table in tables {
            let file = output.join("file.toml");
            std::fs::write(&file, format!("units = \"mm-g-ms\"\n{table}\n{NONE}\n")).expect("a file");
            let mut program = Command::new(env!("CARGO_BIN_EXE_toron"));
            let answer = program.arg(command).arg(&file).arg("-o").arg(&output).output().expect("it starts");
            let said = String::from_utf8(answer.stderr).expect("UTF-8");
            let (_, allowed) = said.split_once(", expected ").unwrap_or_else(|| panic!("{command} {table}: {said}"));
            for key in allowed.split('`').skip(1).step_by(2) {
                keys += 1;
                assert!(known.contains(key), "docs/{page} lacks {key} of {table} of toron {command}");
            }
        }
    }
    assert!(keys > 150, "{keys} keys");
}

/// The cell of a table in a page, by the heading over the table, the row's first cell and the column's heading.
fn cell(page: &str, heading: &str, row: &str, column: &str) -> String {
    let text = read(page);
    let (_, section) = text.split_once(&format!("\n{heading}\n")).unwrap_or_else(|| panic!("{page}: no {heading}"));
    let cells = |line: &str| line.trim_matches('|').split('|').map(|cell| cell.trim().to_string()).collect::<Vec<_>>();
    let mut lines = section.lines().skip_while(|line| !line.starts_with('|'));
    let place = cells(lines.next().expect("a table")).iter().position(|title| title == column);
    let found = lines.take_while(|line| line.starts_with('|')).map(cells).find(|cells| cells[0] == row);
    let place = place.unwrap_or_else(|| panic!("{page}, {heading}: no column {column}"));
    found.unwrap_or_else(|| panic!("{page}, {heading}: no row {row}"))[place].clone()
}

/// The README's figures of the panel are of one panel, and those of the results, to its digits.
#[test]
fn the_readme_s_figures_of_the_panel_are_those_of_the_results() {
    const PAGE: &str = "results/fabric.md";
    let words: Vec<String> = read("../README.md").split_whitespace().map(String::from).collect();
    let words = words.join(" ");
    let after = |text: &str| {
        let (_, rest) = words.split_once(text).unwrap_or_else(|| panic!("README.md lacks \"{text}\""));
        rest.split([' ', ',', ')']).next().expect("a word").to_string()
    };
    let same = |shown: String, measured: String| {
        let digits = shown.split_once('.').map_or(0, |(_, decimals)| decimals.len());
        let measured = measured.split(' ').next().expect("a figure").parse::<f64>().expect("a number");
        assert_eq!(shown, format!("{measured:.digits$}"));
    };
    let panel = "R = 19.05 mm";
    assert!(words.contains(&format!("On the fine mesh with {panel} it gives way by")));
    let slow = |column| cell(PAGE, "## 63 m/s, nothing fails", "largest deflection, mm", column);
    same(after("it gives way by "), slow(panel));
    same(after("mm at 63 m/s (thesis: "), slow("thesis"));
    assert_eq!(slow("thesis").split_once("(experiment ").expect("both").1, format!("{})", after("6.8, experiment: ")));
    // The rows of the second table that name no panel, as those quoted, are of that one.
    let of_that_panel = format!("## 142 m/s\n\n{panel}, clearance 1 µm unless a row says otherwise, to 60 µs");
    assert!(read(PAGE).contains(&of_that_panel));
    let fast = |row| cell(PAGE, "## 142 m/s", row, "speed at 60 µs, m/s");
    same(after("at 142 m/s with uniaxial failure "), fast("uniaxial, fine"));
    same(after("left to the sphere (thesis: "), fast("thesis, uniaxial"));
    assert_eq!(
        fast("thesis, uniaxial").split_once("(experiment ").expect("both").1,
        format!("{})", after("120, experiment: "))
    );
}

/// The summary of a scene's cases, a record for each.
struct Summary {
    titles: csv::StringRecord,
    cases: Vec<csv::StringRecord>,
}

impl Summary {
    /// That of `toron impact SCENE`, whose files go to the folder of this name.
    fn of(scene: &Path, name: &str) -> Self {
        let output = folder(name);
        let mut program = Command::new(env!("CARGO_BIN_EXE_toron"));
        run(program.arg("impact").arg(scene).arg("-o").arg(&output).current_dir(ROOT), "");
        let mut reader = csv::Reader::from_path(output.join("summary.csv")).expect("the summary");
        let titles = reader.headers().expect("titles").clone();
        Summary { titles, cases: reader.records().map(|case| case.expect("a case")).collect() }
    }

    fn value(&self, case: &str, column: &str) -> &str {
        let place = self.titles.iter().position(|title| title == column).expect(column);
        &self.cases.iter().find(|record| &record[0] == case).expect(case)[place]
    }
}

const RESIDUAL_SPEED: &str = "residual_speed (mm/ms)";

/// The README's figure of the yarn is what its command gives, and that of the results.
#[test]
fn the_readme_s_figure_of_the_yarn_is_what_its_command_gives() {
    const SCENE: &str = "examples/yarn_impact/impact.toml";
    let summary = Summary::of(Path::new(SCENE), "documents-impact");
    let speed: f64 = summary.value("mf-120", RESIDUAL_SPEED).parse().expect("a speed");
    let words: Vec<String> = read("../README.md").split_whitespace().map(String::from).collect();
    let said = format!("the residual speed is {speed:.0} m/s at 120 m/s (thesis: 64;");
    let words = words.join(" ");
    assert!(words.contains(&format!("`toron impact {SCENE}`")) && words.contains(&said), "README.md lacks {said}");
    assert!(read("results/impact.md").contains(&format!("{speed:.1}")), "{speed}");
}

const AT_END: &str = "speed_at_end (mm/ms)";
const W_EL: &str = "w_el_at_end (mJ/mm³)";
const W_TC: &str = "w_tc_at_end (mJ/mm³)";
const W_TD: &str = "w_td_at_end (mJ/mm³)";

/// The scenes of the struck yarn, with the headings over the tables of their figures.
const SCENES_OF_THE_YARN: [(&str, &str); 6] = [
    ("table_4_5", "## Residual speeds, Tab. 4.5"),
    ("margins", "### Cases near the limit"),
    ("margins_linear", "### Cases near the limit"),
    ("no_failure", "## Energy densities at 30 µs are within 11 % of the thesis"),
    ("mesh", "## Convergence"),
    ("contact", "## Convergence"),
];

/// Their cells: scene, row, the column's title, the case, and the column of the summary.
const CELLS_OF_THE_YARN: [(&str, &str, &str, &str, &str); 30] = [
    ("table_4_5", "`toron impact`", "MF 100", "mf-100", RESIDUAL_SPEED),
    ("table_4_5", "`toron impact`", "MF 120", "mf-120", RESIDUAL_SPEED),
    ("table_4_5", "`toron impact`", "UF 120", "uf-120", RESIDUAL_SPEED),
    ("table_4_5", "`toron impact`", "UF 140", "uf-140", RESIDUAL_SPEED),
    ("table_4_5", "`toron impact`", "linear 100", "linear-100", RESIDUAL_SPEED),
    ("table_4_5", "`toron impact`", "linear 120", "linear-120", RESIDUAL_SPEED),
    ("margins", "no viscosity", "MF 120", "mf-120-no-viscosity", RESIDUAL_SPEED),
    ("margins", "no viscosity", "MF 100", "mf-100-no-viscosity", AT_END),
    ("margins", "no viscosity", "UF 140", "uf-140-no-viscosity", RESIDUAL_SPEED),
    ("margins", "hourglass 1.0", "MF 120", "mf-120-stiff-hourglass", RESIDUAL_SPEED),
    ("margins", "hourglass 1.0", "MF 100", "mf-100-stiff-hourglass", RESIDUAL_SPEED),
    ("margins", "hourglass 1.0", "UF 140", "uf-140-stiff-hourglass", RESIDUAL_SPEED),
    ("margins", "50 layers", "MF 120", "mf-120-50-layers", RESIDUAL_SPEED),
    ("margins", "50 layers", "MF 100", "mf-100-50-layers", RESIDUAL_SPEED),
    ("margins", "50 layers", "UF 140", "uf-140-50-layers", RESIDUAL_SPEED),
    ("margins_linear", "no viscosity", "linear 100", "linear-100-no-viscosity", RESIDUAL_SPEED),
    ("margins_linear", "hourglass 1.0", "linear 100", "linear-100-stiff-hourglass", RESIDUAL_SPEED),
    ("margins_linear", "50 layers", "linear 100", "linear-100-50-layers", RESIDUAL_SPEED),
    ("no_failure", "6 × 2", "W_el", "hyperelastic", W_EL),
    ("no_failure", "6 × 2", "W_tc", "hyperelastic", W_TC),
    ("no_failure", "6 × 2", "W_td", "hyperelastic", W_TD),
    ("no_failure", "12 × 4", "W_el", "section-12x4", W_EL),
    ("no_failure", "12 × 4", "W_tc", "section-12x4", W_TC),
    ("no_failure", "12 × 4", "W_td", "section-12x4", W_TD),
    ("mesh", "34.0", "150 elements", "half", RESIDUAL_SPEED),
    ("mesh", "34.0", "9600", "double", RESIDUAL_SPEED),
    ("contact", "34.0", "contact 1e4", "k-1e4", RESIDUAL_SPEED),
    ("contact", "34.0", "1e5", "k-1e5", RESIDUAL_SPEED),
    ("contact", "34.0", "1e6, usual", "k-1e6", RESIDUAL_SPEED),
    ("contact", "34.0", "1e7", "k-1e7", RESIDUAL_SPEED),
];

/// The tables of the struck yarn have what their scenes give, to the digits that they show; NP: not penetrated.
#[test]
#[ignore = "takes minutes: .ci/long documents"]
fn the_tables_of_the_yarn_are_what_its_scenes_give() {
    const PAGE: &str = "results/impact.md";
    let mut wrong = Vec::new();
    for (scene, heading) in SCENES_OF_THE_YARN {
        let cells: Vec<_> = CELLS_OF_THE_YARN.into_iter().filter(|cell| cell.0 == scene).collect();
        // Of the scene's cases those that the page shows.
        let file = Path::new(ROOT).join(format!("examples/yarn_impact/{scene}.toml"));
        let text = std::fs::read_to_string(&file).expect(scene);
        let mut parts = text.split("[[case]]");
        let common = parts.next().expect("what all cases share");
        let wanted = |part: &&str| cells.iter().any(|cell| part.contains(&format!("name = \"{}\"", cell.3)));
        let cases: Vec<_> = parts.filter(wanted).collect();
        assert_eq!(cases.len(), cells.iter().map(|cell| cell.3).collect::<BTreeSet<_>>().len(), "{scene}");
        let file = folder("documents-yarn").join("scene.toml");
        std::fs::write(&file, [&[common][..], &cases].concat().join("[[case]]")).expect("a scene");
        let summary = Summary::of(&file, "documents-yarn-results");
        for (_, row, title, case, column) in cells {
            let (shown, value) = (cell(PAGE, heading, row, title), summary.value(case, column));
            let number = shown.split(' ').next().expect("a word");
            let digits = number.split_once('.').map_or(0, |(_, decimals)| decimals.len());
            let is_shown = match value.parse::<f64>() {
                _ if shown == "NP" => summary.value(case, "ending") == "not penetrated",
                Ok(value) => number == format!("{value:.digits$}"),
                Err(_) => false,
            };
            println!("{scene}, {case}: {shown}, {value}");
            wrong.extend((!is_shown).then(|| format!("{scene}, {case}, {title}: {shown}, not {value}")));
        }
    }
    assert!(wrong.is_empty(), "{PAGE}: {}", wrong.join("; "));
}

/// The shares of the intervals of V50 that hold are those that the commands print, by the logit.
#[test]
#[ignore = "takes minutes: .ci/long documents"]
fn the_shares_of_intervals_that_hold_are_what_the_commands_print() {
    const PAGE: &str = "results/v50.md";
    const COMMAND: &str = "v50 examples/fabric_impact/v50.toml --simulate 1000 --firth";
    // A curve, and the titles of its shares in both tables.
    const CURVES: [(&str, [&str; 2]); 2] = [
        ("logit", ["V5, V50, V95, without correction", "without correction"]),
        ("logit, Firth", ["with Firth's correction"; 2]),
    ];
    let printed = |more: &str| {
        let mut program = Command::new(env!("CARGO_BIN_EXE_toron"));
        let output = run(program.args(COMMAND.split(' ')).args(more.split_whitespace()).current_dir(ROOT), "");
        String::from_utf8(output.stdout).expect("UTF-8")
    };
    // A line has the design, the curve, and the shares of V5, V50 and V95.
    let shares = |text: &str, design: &str, curve: &str| -> String {
        let names: Vec<_> = design.split(' ').chain(curve.split(' ')).collect();
        let mut lines = text.lines().map(|line| line.split_whitespace().collect::<Vec<_>>());
        let line = lines.find(|words| words.starts_with(&names)).expect(design);
        line[names.len()..names.len() + 3].join(", ")
    };
    let (flat, steep) = (printed(""), printed("--truth 41.2 0.75"));
    for (curve, [title, title_of_separated]) in CURVES {
        for design in ["even", "langlie", "up-and-down", "d-optimal", "3pod"] {
            let shown = cell(PAGE, "## How often the intervals hold", design, title);
            assert_eq!(shown, shares(&flat, design, curve), "{design}, {curve}");
        }
        for (text, row) in [(&flat, "6.25 m/s"), (&steep, "0.75 m/s")] {
            let (_, separated) = text.split_once("separated (").expect("a table of the separated");
            let shown = cell(PAGE, "### Where no zone of mixed results is left", row, title_of_separated);
            assert_eq!(shown, shares(separated, "even", curve), "{row}, {curve}");
        }
    }
}

/// What a page tells to write and to type: its files, by the name in the line before, and its commands with what they
/// print.
enum Told {
    File { name: String, text: String },
    Command { words: Vec<String>, output: Option<String> },
}

fn told(page: &str) -> Vec<Told> {
    let text = read(page);
    let mut told = Vec::new();
    let mut named = None;
    let mut rest = text.as_str();
    while let Some((before, after)) = rest.split_once("\n```") {
        let (code, after) = after.split_once("\n```").expect("the block is closed");
        let (language, code) = code.split_once('\n').expect("a line of code");
        named = before.lines().rev().flat_map(|line| line.rsplit('`')).find(|word| word.ends_with(".toml")).or(named);
        match language {
            "toml" => told.push(Told::File { name: named.expect("a name").into(), text: format!("{code}\n") }),
            "sh" => told.extend(
                code.lines()
                    .filter_map(|line| line.strip_prefix("toron "))
                    .map(|line| Told::Command { words: line.split(' ').map(String::from).collect(), output: None }),
            ),
            _ => match told.last_mut() {
                Some(Told::Command { output, .. }) => *output = Some(format!("{code}\n")),
                _ => panic!("{code} is nobody's output"),
            },
        }
        rest = after;
    }
    told
}

/// Does what the tutorial tells; the strike takes minutes and is run on a coarse mesh, unless the whole is asked for.
fn follow_the_tutorial(name: &str, whole: bool) {
    let place = folder(name);
    let mut commands = 0;
    for step in told("tutorial.md") {
        match step {
            Told::File { name, text } => {
                let text = if whole {
                    text
                } else {
                    text.replace("along = 6 ", "along = 4 ").replace("columns = 6", "columns = 2")
                };
                std::fs::write(place.join(name), text).expect("a file");
            }
            Told::Command { words, output } => {
                let mut program = Command::new(env!("CARGO_BIN_EXE_toron"));
                let answer = run(program.args(&words).current_dir(&place), "");
                let printed = String::from_utf8(answer.stdout).expect("UTF-8");
                let Some(output) = output else { continue };
                commands += 1;
                if words[0] != "fabric" {
                    assert_eq!(printed, output, "toron {}", words.join(" "));
                } else if whole {
                    // From the name to the deleted elements; then comes the time that it took.
                    let row = |text: &str| {
                        let row = text.lines().find(|line| line.starts_with("scene ")).expect("a case");
                        row.split_whitespace().take(13).map(String::from).collect::<Vec<_>>()
                    };
                    assert_eq!(row(&printed), row(&output));
                    // What follows the table: yarns, warnings, files.
                    let rest = |text: &str| text.split_once("\n\nYarns").map(|(_, rest)| rest.to_string());
                    assert_eq!(rest(&printed), rest(&output));
                } else {
                    assert_eq!(printed.lines().next(), output.lines().next());
                    assert!(place.join("strike/scene-panel-1.png").exists());
                    // scene, sphere stopped, the verdict of one word or more, its time, speed and depth.
                    let row =
                        |text: &str| text.lines().find(|line| line.starts_with("scene ")).expect("a case").to_string();
                    let depth = |text: &str| {
                        let numbers: Vec<f64> =
                            row(text).split_whitespace().filter_map(|word| word.parse().ok()).collect();
                        numbers[2]
                    };
                    assert!(row(&printed).starts_with("scene  sphere stopped  crimp; "), "{printed}");
                    // Slack yarns and two elements across them: 1.45 times as deep.
                    let deeper = depth(&printed) / depth(&output);
                    assert!((1.3..1.6).contains(&deeper), "{deeper} times as deep: {printed}");
                }
            }
        }
    }
    assert_eq!(commands, 3);
}

#[test]
fn the_tutorial_does_what_it_says() {
    follow_the_tutorial("tutorial", false);
}

#[test]
#[ignore = "takes a minute: .ci/long documents"]
fn the_tutorial_strikes_as_it_says() {
    follow_the_tutorial("tutorial-whole", true);
}

/// The README's two ratios are those of the report.
#[test]
fn the_readme_s_speed_is_that_of_the_report() {
    let report = std::fs::read_to_string(Path::new(ROOT).join("benches/results/speed.json")).expect("a report");
    let report: serde_json::Value = serde_json::from_str(&report).expect("JSON");
    let readme = read("../README.md");
    for (name, digits) in [("fastest Fortran loop / f64 block", 2), ("scalar Fortran / f64 block", 0)] {
        let ratios = report["ratios"].as_array().expect("ratios").iter();
        let row = ratios.clone().find(|row| row["name"].as_str().is_some_and(|found| found.starts_with(name)));
        let ratio = row.expect(name)["times"]["median"].as_f64().expect("a number");
        assert!(readme.contains(&format!(" {ratio:.digits$} times")), "{name}: {ratio}");
    }
}
