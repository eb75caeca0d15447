//! The program as a user meets it: exit codes, files, tables, decks.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// A directory of this test's own, empty.
fn scratch(name: &str) -> PathBuf {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    if directory.exists() {
        std::fs::remove_dir_all(&directory).expect("an old directory can be removed");
    }
    std::fs::create_dir_all(&directory).expect("a directory can be made");
    directory
}

fn toron(directory: &Path, arguments: &[&str]) -> Output {
    let program = env!("CARGO_BIN_EXE_toron");
    Command::new(program).args(arguments).current_dir(directory).output().expect("the program starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("output is UTF-8")
}

/// Header and rows of a table.
fn read(table: &Path) -> (Vec<String>, Vec<Vec<f64>>) {
    let mut reader = csv::Reader::from_path(table).expect("there is a table");
    let header = reader.headers().expect("the table has a header").iter().map(String::from).collect();
    let number = |cell: &str| cell.parse().expect("cells are numbers");
    let rows = reader.records().map(|row| row.expect("rows are complete").iter().map(number).collect()).collect();
    (header, rows)
}

#[test]
fn without_a_file_the_demonstration_runs() {
    let directory = scratch("demonstration");
    let output = toron(&directory, &["run"]);
    let (stdout, stderr) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(0), "{stderr}");
    assert!(stdout.contains("step 2 (tension), increment 81"), "{stdout}");
    assert!(stdout.contains("0.6851 elongation + 0.3210 compaction + 0 distortion"), "{stdout}");

    let (header, rows) = read(&directory.join("toron-out/increments.csv"));
    assert_eq!(rows.len(), 1 + 70 + 130);
    let column = |name: &str| header.iter().position(|column| column == name).expect("the column exists");
    let last = rows.last().expect("there are rows");
    assert_eq!((last[column("step")], last[column("increment")], last[column("failed")]), (2.0, 130.0, 1.0));
    let failing = &rows[70 + 81];
    let [s11, force] = ["cauchy_11", "force_x_x"].map(|name| failing[column(name)]);
    // k_el ln λ/(λ J_t) with λ = 1 + 0.05·81/130 and J_t = 0.7; on a unit face P11 = J_t σ11.
    let stretch: f64 = 1.0 + 0.05 * 81.0 / 130.0;
    assert!((s11 - 82341.0 * stretch.ln() / (stretch * 0.7)).abs() < 1e-7);
    assert!((force - 0.7 * s11).abs() < 1e-7);
    // √(k_el/ρ) at rest, in mm/s.
    assert!((rows[0][column("wave_speed")] - (82341.0f64 / 1.3514e-9).sqrt()).abs() < 1e-3);

    let svg = std::fs::read_to_string(directory.join("toron-out/plot.svg")).expect("there is an SVG");
    assert!(svg.starts_with("<svg") && !svg.contains("<text") && svg.contains("<path"));
    let png = std::fs::read(directory.join("toron-out/plot.png")).expect("there is a PNG");
    assert!(png.starts_with(b"\x89PNG\r\n"));
    // Width and height of the header chunk.
    assert_eq!(png[16..24], [0, 0, 7, 128, 0, 0, 4, 236]);
}

#[test]
fn every_point_gets_its_files_and_its_columns() {
    let directory = scratch("points");
    let example = Path::new(toron_test_support::library::ROOT).join("examples/laws.toml");
    let output = toron(&directory, &["run", example.to_str().expect("a path in UTF-8"), "-o", "out"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    for name in ["multiaxial", "uniaxial", "linear"] {
        let (header, rows) = read(&directory.join(format!("out/increments-{name}.csv")));
        assert_eq!(rows.len(), 171);
        assert_eq!(header.contains(&"S_el_11".to_string()), name != "linear");
        assert!(directory.join(format!("out/plot-{name}.png")).exists());
    }
}

#[test]
fn exit_codes_tell_input_from_evaluation() {
    let directory = scratch("codes");
    let run = |text: &str| {
        std::fs::write(directory.join("path.toml"), text).expect("a file can be written");
        toron(&directory, &["run", "path.toml"])
    };
    let head = "units = \"si\"\n[material]\npreset = \"kevlar-km2-600\"\n";

    let slip = run(&format!("{head}[[step]]\nF = {{ 11 = 1.01 }}\n[[step]]\nP = {{ 12 = 1e6 }}\n"));
    assert_eq!(slip.status.code(), Some(1));
    assert!(text(&slip.stderr).contains("step 2, increment 1: P12"), "{}", text(&slip.stderr));
    // What came before is written all the same.
    assert_eq!(read(&directory.join("toron-out/increments.csv")).1.len(), 2);

    let negative = run(&format!("{head}properties = {{ k_el = -3 }}\n[[step]]\nF = {{ 11 = 1.01 }}\n"));
    assert_eq!(negative.status.code(), Some(2));
    assert!(text(&negative.stderr).starts_with("toron: path.toml:4: property 1 (k_el"), "{}", text(&negative.stderr));

    assert_eq!(toron(&directory, &["run", "nowhere.toml"]).status.code(), Some(2));
    assert_eq!(toron(&directory, &["run", "-o", "path.toml/below-a-file"]).status.code(), Some(2));
    assert_eq!(toron(&directory, &["walk"]).status.code(), Some(2));
    assert_eq!(toron(&directory, &["params", "--preset", "nylon"]).status.code(), Some(2));
    assert_eq!(toron(&directory, &["params", "--units", "furlong"]).status.code(), Some(2));
}

/// Output and complaints into pipes whose reader has gone: the command ends as it would have otherwise.
#[test]
fn a_reader_that_has_gone_is_no_error() {
    let directory = scratch("pipes");
    let point =
        r#"{"F": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "m": [1, 0, 0], "params": {"kel": 1, "ktc": 1, "p": 2, "ktd": 1}}"#;
    let scene = "units = \"mm-g-ms\"\n[scene]\nhalf-length = 1.0\nheight = 0.1\nwidth = 0.5\nlayers = 4\nrows = 1\n\
                 columns = 2\nmass = 9.91e-3\nradius = 1.1\ncontact-stiffness = 1e6\nspeed = 120.0\nend = 1e-5\n";
    for (name, text) in [("points", point), ("scene.toml", scene)] {
        std::fs::write(directory.join(name), text).expect("a file can be written");
    }
    let ended = |arguments: &[&str]| {
        let closed = || {
            let (reader, writer) = std::io::pipe().expect("a pipe");
            drop(reader);
            Stdio::from(writer)
        };
        let points = std::fs::File::open(directory.join("points")).expect("there are points");
        let mut program = Command::new(env!("CARGO_BIN_EXE_toron"));
        program.args(arguments).current_dir(&directory).stdin(points).stdout(closed()).stderr(closed());
        program.status().expect("the program starts").code()
    };
    for arguments in [&["run"][..], &["params"], &["eval"], &["impact", "scene.toml"], &["--help"]] {
        assert_eq!(ended(arguments), Some(0), "{arguments:?}");
    }
    assert_eq!(ended(&["run", "nowhere.toml"]), Some(2));
}

/// What cannot be printed is lost, and the exit code and a message say so; the files are written all the same.
#[test]
fn a_full_disk_is_an_error() {
    let directory = scratch("full");
    let point =
        r#"{"F": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "m": [1, 0, 0], "params": {"kel": 1, "ktc": 1, "p": 2, "ktd": 1}}"#;
    std::fs::write(directory.join("points"), point).expect("a file can be written");
    let full = || std::fs::File::options().write(true).open("/dev/full").expect("Linux has it");
    for arguments in [
        &["run"][..],
        &["params"],
        &["params", "--preset", "kevlar-km2-600"],
        &["deck", "--host", "ls-dyna", "--preset", "kevlar-km2-600", "--units", "mm-tonne-s"],
        &["eval"],
        &["--help"],
        &["run", "--help"],
        &["--version"],
    ] {
        let points = std::fs::File::open(directory.join("points")).expect("there are points");
        let mut program = Command::new(env!("CARGO_BIN_EXE_toron"));
        program.args(arguments).current_dir(&directory).stdin(points).stdout(full());
        let output = program.output().expect("the program starts");
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let message = "toron: standard output: No space left on device (os error 28)\n";
        assert_eq!(text(&output.stderr), message, "{arguments:?}");
    }
    assert!(directory.join("toron-out/increments.csv").exists());
}

/// A file that cannot be written is named, whether it cannot be opened or the disk is full.
#[test]
fn a_file_that_cannot_be_written() {
    for file in ["increments.csv", "plot.svg", "plot.png"] {
        let directory = scratch("unwritable");
        std::fs::create_dir(directory.join("toron-out")).expect("a directory");
        std::os::unix::fs::symlink("/dev/full", directory.join("toron-out").join(file)).expect("a link");
        let output = toron(&directory, &["run"]);
        assert_eq!(output.status.code(), Some(2), "{file}");
        let message = format!("toron: toron-out/{file}: No space left on device (os error 28)\n");
        assert_eq!(text(&output.stderr), message);
    }
}

#[test]
fn an_output_that_is_a_file() {
    let directory = scratch("output-is-a-file");
    std::fs::write(directory.join("taken"), "").expect("a file");
    for arguments in [&["run", "-o", "taken"][..], &["bench", "-o", "taken"]] {
        let output = toron(&directory, arguments);
        let message = "toron: output is taken, a file; allowed: a directory, new or not\n";
        assert_eq!((output.status.code(), text(&output.stderr).as_str()), (Some(2), message), "{arguments:?}");
    }
}

/// What a summary says of law and units.
#[test]
fn a_summary_tells_the_law_and_its_wave() {
    let directory = scratch("wave");
    let said = |material: &str| {
        let path = format!("units = \"mm-tonne-s\"\n[material]\n{material}\n[[step]]\nF = {{ 11 = 1.01 }}\n");
        std::fs::write(directory.join("path.toml"), path).expect("a file can be written");
        let output = toron(&directory, &["run", "path.toml"]);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        text(&output.stdout)
    };
    let preset = said("preset = \"kevlar-km2-600\"");
    assert!(preset.contains("law                    hyperelastic (kevlar-km2-600)\n"), "{preset}");
    assert!(preset.contains("wave along the fibre   7.806 km/s = √(k_el/density)\n"), "{preset}");
    assert!(!preset.contains("warning"), "{preset}");
    let own = "law = \"hyperelastic\"\nproperties = { k_el = 82341, k_tc = 1055, p = 2.2, k_td = 649.74 }";
    let without = said(own);
    assert!(without.contains("law                    hyperelastic\n") && !without.contains("wave"), "{without}");
    let wrong = said(&format!("{own}\ndensity = 1.3514e-6"));
    let warning = "  warning                the wave along the fibre has 0.2468 km/s, and fibres have 1 to 20:\n\
                   \x20                        density or k_el is most likely not in the units of the file, mm-tonne-s\n";
    assert!(wrong.contains(warning), "{wrong}");
}

#[test]
fn the_version_names_the_interface() {
    let output = toron(Path::new("."), &["--version"]);
    let said = text(&output.stdout);
    let build = said.strip_prefix(concat!("toron ", env!("CARGO_PKG_VERSION"), " (ABI 2, build "));
    let build = build.and_then(|rest| rest.strip_suffix(")\n")).unwrap_or_else(|| panic!("{said}"));
    assert!(build.len() == 8 && u32::from_str_radix(build, 16).is_ok(), "{said}");
}

#[test]
fn tables_fit_a_terminal() {
    let systems = ["si", "mm-tonne-s", "mm-kg-ms", "cm-g-us", "in-slinch-s", "ft-slug-s"];
    for arguments in systems.map(|units| ["params", "--units", units]) {
        let output = toron(Path::new("."), &arguments);
        assert_eq!(output.status.code(), Some(0));
        let tables = text(&output.stdout);
        for name in ["k_el", "sigma_lim", "failure_index", "kevlar-km2-600-linear"] {
            assert!(tables.contains(name), "{name}: {tables}");
        }
        for line in tables.lines() {
            assert!(line.chars().count() <= 100, "{line}");
        }
    }
}

/// What `toron deck` prints.
fn card(arguments: &[&str]) -> String {
    let output = toron(Path::new("."), &[&["deck"], arguments].concat());
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", text(&output.stderr));
    text(&output.stdout)
}

/// The lines that a solver reads.
fn read_by<'a>(card: &'a str, comment: &str) -> Vec<&'a str> {
    card.lines().filter(|line| !line.starts_with(comment)).collect()
}

/// LS-DYNA's time step follows from K + 4G/3, which must not be below the fastest wave of the law, along the fibre or
/// not.
#[test]
fn a_card_has_the_fastest_wave() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("fastest-wave");
    std::fs::create_dir_all(&folder).expect("a folder");
    let text = "units = \"mm-tonne-s\"\nlaw = \"linear-elastic\"\ndensity = 1e-9\n\
                [properties]\ne_1 = 1000.0\ne_2 = 5000.0\ng = 3000.0\n";
    let file = folder.join("stiff-across.toml");
    std::fs::write(&file, text).expect("a file");
    let card = card(&["--host", "ls-dyna", "--preset", file.to_str().expect("UTF-8")]);
    assert_eq!(read_by(&card, "$").last(), Some(&"       0.0       0.0       3e3    2250.0"), "{card}");
}

/// A density in other units than the card's is told beside it.
#[test]
fn a_card_in_wrong_units_is_told() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("wrong-units");
    std::fs::create_dir_all(&folder).expect("a folder");
    let text = "units = \"mm-tonne-s\"\ndensity = 1351.4\n[properties]\n\
                k_el = 82341.0\nk_tc = 1055.0\np = 2.2\nk_td = 649.74\n";
    std::fs::write(folder.join("yarn.toml"), text).expect("a file");
    let output = toron(&folder, &["deck", "--host", "calculix", "--preset", "yarn.toml"]);
    assert_eq!(output.status.code(), Some(0));
    let said = self::text(&output.stderr);
    assert!(said.starts_with("toron: warning: the wave along the fibre has "), "{said}");
    let right = toron(&folder, &["deck", "--host", "calculix", "--units", "si"]);
    assert_eq!(self::text(&right.stderr), "");
}

#[test]
fn a_preset_prints_as_a_card() {
    let dyna = card(&["--host", "ls-dyna", "--units", "mm-tonne-s"]);
    assert_eq!(
        read_by(&dyna, "$"),
        [
            "*MAT_USER_DEFINED_MATERIAL_MODELS_TITLE",
            "kevlar-km2-600",
            "         1 1.3514e-9        41        13        11         0        12        13",
            "         0         1         0         1         0         0",
            "   82341.0    1055.0       2.2    649.74       0.0    0.0458       1.8       0.0",
            "       1.0       0.0       0.0   41170.5 30877.875",
        ]
    );
    let linear = ["--law", "linear-elastic", "--units", "mm-tonne-s"];
    let axes = ["--fibre", "0.6,0.8,0", "--axes", "--mt", "44", "--id", "7"];
    let dyna = card(&[&["--host", "ls-dyna"], &linear[..], &axes].concat());
    assert_eq!(
        read_by(&dyna, "$")[2..],
        [
            "         7 1.3514e-9        44        12        19         1        11        12",
            "         0         1         0        -1         0         0",
            "       2.0         1       0.0       0.0       0.0       0.6       0.8       0.0",
            "       0.0       0.0       0.0       0.0       0.0       1.0       0.0         0",
            "   79414.0     794.0     126.0    3637.0       1.0       0.0       0.0       0.0",
            "       0.0       0.0   39707.0  29780.25",
        ]
    );
    let abaqus = card(&[&["--host", "abaqus"], &linear[..]].concat());
    assert_eq!(
        read_by(&abaqus, "**")[..7],
        [
            "*MATERIAL, NAME=KEVLAR-KM2-600-LINEAR",
            "*DENSITY",
            "1.3514e-9,",
            "*USER MATERIAL, CONSTANTS=10",
            "79414.0, 794.0, 126.0, 3637.0, 1.0, 0.0, 0.0, 0.0",
            "0.0, 0.0",
            "*DEPVAR, DELETE=10",
        ]
    );
    // The same card, but for the deletion that Abaqus/Standard does not have, and the linear elastic law's tangent.
    for law in ["hyperelastic", "linear-elastic"] {
        let of = |host| card(&["--host", host, "--law", law, "--units", "si"]);
        let [both, explicit, standard] = ["abaqus", "abaqus-explicit", "abaqus-standard"].map(of);
        assert_eq!(read_by(&both, "**"), read_by(&explicit, "**"));
        assert!(explicit.contains("ELEMENT DELETION=YES") && !standard.contains("DELET"), "{standard}");
        let kept = |line: &&str| !line.starts_with("*DEPVAR");
        let lines = |card| read_by(card, "**").into_iter().filter(kept).map(String::from).collect::<Vec<_>>();
        assert_eq!(standard.contains(", UNSYMM\n"), law == "linear-elastic", "{standard}");
        assert_eq!(lines(&standard.replace(", UNSYMM\n", "\n")), lines(&explicit));
    }
    let calculix = card(&[&["--host", "calculix"], &linear[..]].concat());
    let lines = read_by(&calculix, "**");
    assert_eq!(lines[..1], ["*MATERIAL, NAME=@TORON_LINEARELASTIC"]);
    assert_eq!(lines[lines.len() - 2..], ["*DEPVAR", "19"]);
    let radioss = card(&["--host", "openradioss", "--units", "mm-tonne-s", "--id", "3"]);
    let lines = read_by(&radioss, "#");
    assert_eq!(
        (lines[0], lines[6], lines[8]),
        (
            "/MAT/USER01/3",
            "/PROP/TYPE14/3",
            "         1        10                   0                   0         0         1                   0"
        )
    );
    let mtest = card(&["--host", "mtest", "--units", "mm-kg-ms"]);
    assert!(
        mtest.contains("@MaterialProperty<constant> 'k_el' 82.341;") && mtest.contains("stiffness, GPa\n"),
        "{mtest}"
    );
    // However long a value is, a blank comes before its comment.
    let long = card(&["--host", "mtest", "--units", "in-slinch-s"]);
    for card in [&mtest, &long] {
        assert!(card.lines().filter(|line| line.starts_with('@')).all(|line| !line.contains(";//")), "{card}");
    }
}

/// Every field of ten columns has a blank before it, in any units, and says its number to five digits or names itself
/// rounded.
#[test]
fn a_card_takes_changes_and_options() {
    let mm = |arguments: &[&str]| card(&[&["--units", "mm-tonne-s", "--host"], arguments].concat());
    // A property as it is on the card, behind the comment that names it.
    let value = |card: &str, name: &str| -> String {
        let mut lines = card.lines();
        let names = lines.find(|line| line.starts_with("#  ") && line.split_whitespace().any(|word| word == name));
        let names = names.unwrap_or_else(|| panic!("no {name}: {card}"));
        let end = names.find(name).expect("it is there") + name.len();
        lines.next().expect("a line of values")[end - 20..end].trim().to_string()
    };
    let plain = mm(&["openradioss"]);
    let changed = mm(&["openradioss", "--set", "k_ld=126", "--set", "density=1.4e-9", "--fibre-from", "nodes"]);
    let numbers = |card: &str, names: &[&str]| names.iter().map(|name| value(card, name)).collect::<Vec<_>>();
    assert_eq!(numbers(&plain, &["k_ld", "RHO_I", "fibre_from"]), ["0.0", "1.3514e-9", "0"]);
    assert_eq!(numbers(&changed, &["k_ld", "RHO_I", "fibre_from"]), ["126.0", "1.4e-9", "1"]);
    assert!(changed.contains("; k_ld = 126 MPa; density = 1.4e-9 tonne/mm^3\n"), "{changed}");
    // In the deck's units, whatever the preset's are; for every host.
    assert!(card(&["--units", "si", "--host", "openradioss", "--set", "k_ld=126e6"]).contains("     1.26e8\n"));
    assert!(mm(&["ls-dyna", "--set", "k_ld=126"]).contains("     126.0"));
    let linear = ["openradioss", "--law", "linear-elastic", "--frame", "polar", "--criterion", "fibre-stress"];
    assert_eq!(numbers(&mm(&linear), &["fibre_from", "frame", "criterion"]), ["0", "1", "1"]);
    assert_eq!(numbers(&mm(&linear[..3]), &["fibre_from", "frame", "criterion"]), ["0", "0", "0"]);
}

#[test]
fn fields_of_ls_dyna_never_touch() {
    for units in ["si", "mm-tonne-s", "mm-kg-ms", "cm-g-us", "um-kg-s", "in-slinch-s", "ft-slug-s"] {
        for law in ["hyperelastic", "linear-elastic"] {
            let numbers = card(&["--host", "mtest", "--law", law, "--units", units]);
            let dyna = card(&["--host", "ls-dyna", "--law", law, "--units", units]);
            let lines = read_by(&dyna, "$");
            let fields = |line: &&str| {
                let text = line.to_string();
                (0..line.len() / 10).map(|i| text[10 * i..10 * (i + 1)].to_string()).collect::<Vec<_>>()
            };
            for field in lines[2..].iter().flat_map(fields) {
                assert!(field.starts_with(' ') && !field.ends_with(' '), "{field} in\n{dyna}");
            }
            let given = lines[4..].iter().flat_map(fields).map(|field| field.trim().parse::<f64>().expect("a number"));
            let wanted = numbers.lines().filter_map(|line| line.strip_prefix("@MaterialProperty<constant> '"));
            for (found, line) in given.zip(wanted) {
                let (name, value) = line.split_once("' ").expect("name and value");
                let value: f64 = value.split(';').next().expect("a value").parse().expect("a number");
                assert!((found - value).abs() <= 5e-5 * value.abs(), "{name}: {found}, not {value}");
                let rounded = (found - value).abs() > 1e-12 * value.abs();
                let said = dyna.lines().find(|line| line.starts_with("$ rounded")).unwrap_or_default();
                assert_eq!(rounded, said.split([' ', ',']).any(|word| word == name), "{name}: {said}");
            }
        }
    }
}

#[test]
fn wrong_arguments_of_a_card_are_named() {
    let refused = |arguments: &[&str], message: &str| {
        let output = toron(Path::new("."), &[&["deck"], arguments].concat());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(text(&output.stderr).contains(message), "{arguments:?}: {}", text(&output.stderr));
    };
    refused(&["--host", "nastran"], "'nastran' for '--host <HOST>'");
    refused(&["--host", "nastran"], "ls-dyna, abaqus, abaqus-standard, abaqus-explicit, openradioss, calculix, mtest");
    refused(&["--host", "mtest"], "--units is missing, and kevlar-km2-600 has none; allowed: length-mass-time");
    let dyna = ["--host", "ls-dyna", "--units", "si"];
    for (arguments, message) in [
        (&["--law", "elastic"][..], "--law elastic; allowed: hyperelastic, linear-elastic, frictional"),
        (&["--preset", "nylon"], "--preset: preset \"nylon\"; allowed: kevlar-km2-600"),
        (&["--properties", "nylon.txt"], "--properties nylon.txt: No such file"),
        (&["--preset", "kevlar-km2-600", "--law", "linear-elastic"], "kevlar-km2-600 is of the law hyperelastic"),
        (&["--fibre", "1,0"], "--fibre 1,0; allowed: three finite numbers, X,Y,Z"),
        (&["--fibre", "1,0,inf"], "--fibre 1,0,inf; allowed: three finite numbers, X,Y,Z"),
        (
            &["--fibre", "0,0,0"],
            "--fibre: properties 9 to 11 (fibre direction) are 0.0, 0.0, 0.0; allowed: any vector but zero",
        ),
        (&["--mt", "42"], "--mt 42; allowed: 41, 43, 44, 45, 47, 48, 49, 50"),
        (&["--id", "0"], "--id 0; allowed: 1 to 999999999"),
    ] {
        refused(&[&dyna[..], arguments].concat(), message);
    }
    let units = ["--units", "mm-tonne-s", "--host"];
    for (arguments, message) in [
        (&["ls-dyna", "--fibre-from", "nodes"][..], "--fibre-from is for --host openradioss only"),
        (&["openradioss", "--frame", "polar"], "--frame or --criterion is for a law that has this option"),
        (&["openradioss", "--set", "k_x=1"], "--set k_x=1: no property k_x; allowed: k_el"),
        (&["openradioss", "--set", "k_ld=-1"], "--set k_ld=-1: property 5 (k_ld"),
        (&["openradioss", "--set", "k_ld"], "--set k_ld: allowed: NAME=VALUE"),
        (&["openradioss", "--set", "k_ld=nan"], "--set k_ld=nan: allowed: a finite number"),
        (&["openradioss", "--set", "density=0"], "--set density=0: density is 0; allowed: "),
    ] {
        refused(&[&units[..], arguments].concat(), message);
    }
    let ccx = ["--host", "calculix", "--units", "si"];
    refused(&[&ccx[..], &["--axes"]].concat(), "--axes is for --host ls-dyna only");
    refused(&[&ccx[..], &["--mt", "41"]].concat(), "--mt is for --host ls-dyna only");
    refused(&[&ccx[..], &["--id", "2"]].concat(), "--id is for --host ls-dyna and openradioss only");
    refused(&["--host", "mtest", "--units", "furlong"], "--units furlong; allowed: length-mass-time");
}

#[test]
fn every_shell_has_completions_of_every_command() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let output = Command::new(env!("CARGO_BIN_EXE_toron")).args(["completions", shell]).output().expect("it runs");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let script = String::from_utf8_lossy(&output.stdout);
        for word in ["toron", "fabric", "weave", "--preset"] {
            let word = if shell == "fish" { word.trim_start_matches('-') } else { word };
            assert!(script.contains(word), "{shell}: {word}");
        }
        // The values of options, where the shell is told them.
        let told = ["bash", "zsh", "fish"].contains(&shell);
        assert_eq!(script.contains("abaqus-explicit"), told, "{shell}");
    }
}
