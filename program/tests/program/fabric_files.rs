//! What `toron fabric` writes: on a panel of two crossings its files and its report, and which keys it refuses.

use std::path::Path;
use std::process::{Command, Output};

use crate::documents::code_words;
use toron_test_support::library::{ROOT, folder};

/// Of a quarter, a warp yarn on the axis and the two weft yarns that it crosses, struck for a microsecond.
const SCENE: &str = r#"title = "Two crossings"
units = "mm-g-ms"

[weave]
preset = "kevlar-s706"
along = 4
columns = 4

[weave.panel]
shape = "rectangle"
half = [0.8, 0.4]
part = "quarter"

[scene]
speed = 60.0
mass = 0.26
radius = 2.0
contact-stiffness = 1e5
end = 0.001
sample = 0.0002
pictures = [0.001, 0.0005]
frames = 2

[scene.hyperelastic.properties]
k_ld = 126.0

[[case]]
name = "yarns"

[[case]]
name = "linear"
law = "linear-elastic"
frames = 0
"#;

fn run(name: &str, scene: &str) -> (Output, std::path::PathBuf) {
    let output = folder(name);
    let file = output.join("scene.toml");
    std::fs::write(&file, scene).expect("a file");
    let mut program = Command::new(env!("CARGO_BIN_EXE_toron"));
    let answer = program.arg("fabric").arg(&file).arg("-o").arg(&output).current_dir(ROOT).output();
    (answer.expect("it starts"), output)
}

#[test]
fn a_blow_writes_all_files() {
    let (answer, output) = run("fabric", SCENE);
    assert!(answer.status.success(), "{}", String::from_utf8_lossy(&answer.stderr));
    let read = |name: &str| std::fs::read_to_string(output.join(name)).unwrap_or_else(|_| panic!("{name}"));
    let exists = |name: &str| Path::new(&output).join(name).exists();

    let report = String::from_utf8(answer.stdout).expect("UTF-8");
    assert!(report.starts_with("Two crossings\n\ncase    how it ended"), "{report}");
    assert!(report.lines().all(|line| line.chars().count() < 130 || line.starts_with("Files in")), "{report}");

    let summary = read("summary.csv");
    assert!(
        summary.starts_with("case,law,precision,elements,speed (mm/ms),ending,end (ms),residual_speed (mm/ms),"),
        "{summary}"
    );
    assert_eq!(summary.lines().count(), 3);
    assert!(report.contains("hourglass  Jacobian  W_ld"), "{report}");
    let yarns = ["Yarns of yarns: kevlar-km2-600 (k_ld = 126 MPa)\n", "Yarns of linear: kevlar-km2-600-linear\n"];
    assert!(yarns.iter().all(|line| report.contains(line)), "{report}");
    let materials = [",kevlar-km2-600 (k_ld = 126 MPa),", ",kevlar-km2-600-linear,"];
    assert!(summary.lines().skip(1).zip(materials).all(|(line, material)| line.contains(material)), "{summary}");
    for case in ["yarns", "linear"] {
        assert!(read(&format!("{case}.csv")).lines().count() > 5);
        for picture in [case.to_string(), format!("{case}-panel-1"), format!("{case}-panel-2")] {
            assert!(read(&format!("{picture}.svg")).ends_with("</svg>\n"));
            assert!(exists(&format!("{picture}.png")));
        }
        assert!(!exists(&format!("{case}-panel-3.png")));
    }

    let known = code_words("reference/fabric-files.md");
    for table in [&summary, &read("yarns.csv")] {
        for title in table.lines().next().expect("a heading").split(',') {
            let column = title.split(" (").next().unwrap_or_default();
            assert!(known.contains(column), "docs/reference/fabric-files.md does not know {column}");
        }
    }

    let elements = summary.lines().nth(1).and_then(|line| line.split(',').nth(3)).expect("elements");
    let grid = read("yarns-0002.vtu");
    for part in [
        &format!("NumberOfCells=\"{elements}\""),
        "\"displacement\"",
        "\"velocity\"",
        "\"w_el\"",
        "\"yarn\"",
        "\"cauchy\"",
    ] {
        assert!(grid.contains(part), "{part}");
    }
    // W_el = ½ k_el I_el² where the fibre is drawn, and its failure index has no limit here.
    let array = |name: &str| -> Vec<f64> {
        let (_, rest) = grid.split_once(&format!("Name=\"{name}\"")).unwrap_or_else(|| panic!("{name}"));
        let values = rest.split_once('\n').and_then(|(_, rest)| rest.split_once("</DataArray>")).expect("values").0;
        values.split_whitespace().map(|value| value.parse().expect("a number")).collect()
    };
    let (w_el, i_el, cauchy) = (array("w_el"), array("i_el"), array("cauchy"));
    assert!(cauchy.len() == 6 * w_el.len() && cauchy.iter().any(|stress| stress.abs() > 1.0));
    for (w, i) in w_el.iter().zip(&i_el) {
        let expected = if *i > 0.0 { 0.5 * 82341.0 * i * i } else { 0.0 };
        assert!((w - expected).abs() <= 1e-5 * expected, "{w} {expected}");
    }
    assert!(w_el.iter().any(|&w| w > 1e-3) && array("failure_index").iter().all(|&index| index == 0.0));
    assert_eq!(read("yarns.pvd").matches("<DataSet ").count(), 3);
    assert!(!exists("linear.pvd"));
}

#[test]
fn wrong_keys_are_named() {
    for (number, (right, wrong, message)) in [
        (
            "pictures = [0.001, 0.0005]",
            "pictures = [0.0005, 0.002]",
            "scene.toml:21: a time of pictures is 0.002; allowed: a number > 0, up to end = 0.001 of case \"yarns\"",
        ),
        ("frames = 2", "frames = -1", "scene.toml:22: frames is -1; allowed: a whole number from 0 to 9999"),
        (
            "name = \"linear\"",
            "name = \"yarns-panel-2\"",
            "scene.toml:31: case \"yarns-panel-2\", with files that would be called as some of \"yarns\"; allowed: ",
        ),
    ]
    .into_iter()
    .enumerate()
    {
        let (answer, _) = run(&format!("fabric-wrong-{number}"), &SCENE.replace(right, wrong));
        let error = String::from_utf8(answer.stderr).expect("UTF-8");
        assert!(!answer.status.success() && error.contains(message), "{error}");
    }
}

/// One run writes to a directory at a time, whichever command it is of.
#[test]
fn a_directory_has_one_run_at_a_time() {
    let output = folder("locked");
    let lock = std::fs::File::create(output.join("toron.lock")).expect("a file");
    lock.lock().expect("nobody else has it");
    let scenes = [
        ("fabric", "examples/fabric_impact/coarse.toml"),
        ("impact", "examples/yarn_impact/impact.toml"),
        ("cell", "examples/identification/random.toml"),
    ];
    for (command, scene) in scenes {
        let mut program = Command::new(env!("CARGO_BIN_EXE_toron"));
        let answer = program.args([command, scene, "-o"]).arg(&output).current_dir(ROOT).output().expect("it starts");
        let error = String::from_utf8_lossy(&answer.stderr).into_owned();
        assert!(answer.status.code() == Some(2) && error.contains("to which another run writes"), "{command}: {error}");
    }
}

/// What one command has written to a directory, neither another one nor another scene overwrites.
#[test]
fn a_directory_knows_whose_its_files_are() {
    const YARN: &str = "units = \"mm-g-ms\"\n[scene]\nhalf-length = 1.0\nheight = 0.1\nwidth = 0.5\nlayers = 4\nrows = 1\n\
                        columns = 2\nmass = 9.91e-3\nradius = 1.1\ncontact-stiffness = 1e6\nspeed = 120.0\nend = 1e-5\n";
    let place = folder("owned");
    let _ = std::fs::remove_dir_all(&place);
    std::fs::create_dir_all(&place).expect("a folder");
    let step = "units = \"si\"\n[material]\npreset = \"kevlar-km2-600\"\n[[step]]\nF = { 11 = 1.01 }\n";
    for (name, text) in
        [("yarn.toml", YARN), ("other.toml", YARN), ("panel.toml", SCENE), ("path.toml", step), ("paths.toml", step)]
    {
        std::fs::write(place.join(name), text).expect("a file");
    }
    let run = |words: &[&str]| {
        let mut program = Command::new(env!("CARGO_BIN_EXE_toron"));
        let answer = program.args(words).args(["-o", "out"]).current_dir(&place).output().expect("it starts");
        (answer.status.code(), String::from_utf8_lossy(&answer.stderr).into_owned())
    };
    assert_eq!(run(&["impact", "yarn.toml"]).0, Some(0));
    let summary = || std::fs::read_to_string(place.join("out/summary.csv")).expect("a file");
    let first = summary();
    for words in [["fabric", "panel.toml"], ["impact", "other.toml"]] {
        let (code, error) = run(&words);
        let said =
            format!(" are of toron impact ../yarn.toml, and toron {} ../{} would overwrite them", words[0], words[1]);
        assert!(code == Some(2) && error.contains(&said) && error.contains("allowed: another directory"), "{error}");
    }
    assert_eq!(summary(), first);
    // What has other files may write beside it, and the same scene again.
    for words in [&["run", "path.toml"][..], &["weave", "panel.toml"], &["impact", "yarn.toml"], &["run", "path.toml"]]
    {
        assert_eq!(run(words).0, Some(0), "{words:?}");
    }
    let (code, error) = run(&["run", "paths.toml"]);
    let said = "files called increments are of toron run ../path.toml";
    assert!(code == Some(2) && error.contains(said), "{error}");
}

/// What an earlier run of the scene has left goes when a case begins, and nothing else.
#[test]
fn nothing_of_an_earlier_run_stays() {
    let output = folder("fabric-stale");
    let stale = ["yarns-panel-3.png", "yarns-0003.vtu", "linear-0000.vtu", "linear.pvd"];
    let others = ["other.csv", "yarns.toml", "yarns-more.csv"];
    for name in stale.iter().chain(&others) {
        std::fs::write(output.join(name), "").expect("a file");
    }
    let (answer, _) = run("fabric-stale", SCENE);
    assert!(answer.status.success(), "{}", String::from_utf8_lossy(&answer.stderr));
    let found = |names: &[&str]| names.iter().filter(|name| output.join(name).exists()).count();
    assert_eq!((found(&stale), found(&others)), (0, 3));
}
