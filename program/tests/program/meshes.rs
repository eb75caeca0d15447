//! Meshes that come in: TexGen's own export, and what `toron weave` wrote.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::weave::Picture;
use toron_test_support::library::{ROOT, folder, run};
use toron_test_support::python;

const PITCH: &str = "0.7470588";

/// A plain weave of so many yarns a family by TexGen: the width of a yarn, the points of its section, whether it is
/// refined.
fn texgen(name: &str, yarns: usize, width: &str, points: &str, refined: &str) -> PathBuf {
    let output = folder(name);
    let scripts = Path::new(ROOT).join("ffi-tests/pytexgen");
    let mut script = Command::new(python::environment(&scripts));
    let yarns = yarns.to_string();
    // The name of the directions' file stands in the input as it was given.
    script.current_dir(&output).arg(scripts.join("weave.py"));
    run(script.args([&yarns, PITCH, width, "0.115", points, refined, "texgen.inp"]), "python3");
    output
}

fn toron(output: &Path, command: &str, scene: &str) -> Output {
    let file = output.join("scene.toml");
    std::fs::write(&file, scene).expect("the scene is written");
    let mut program = Command::new(env!("CARGO_BIN_EXE_toron"));
    program.arg(command).arg(&file).arg("-o").arg(output).output().expect("it starts")
}

const MESH: &str = "units = \"mm-g-ms\"\n[mesh]\nfile = \"texgen.inp\"\n";
const MATERIAL: &str = "[material]\npreset = \"kevlar-km2-600\"\n";

/// The value that a figure of the report has.
fn figure(report: &str, name: &str) -> f64 {
    let line =
        report.lines().find(|line| line.trim_start().starts_with(name)).unwrap_or_else(|| panic!("{name}: {report}"));
    let value = line.trim_start()[name.len()..]
        .split_whitespace()
        .find_map(|word| word.trim_end_matches([',', '°']).parse().ok());
    value.unwrap_or_else(|| panic!("{line}"))
}

#[test]
fn texgen_s_weave_is_read_checked_and_drawn() {
    let output = texgen("meshes-texgen", 4, "0.5337", "12", "0");
    let answer = toron(&output, "weave", &format!("{MESH}{MATERIAL}"));
    let report = String::from_utf8(answer.stdout).expect("text");
    assert!(answer.status.success(), "{}", String::from_utf8_lossy(&answer.stderr));
    assert!(report.contains("4 warp, 4 weft"), "{report}");
    // A polygon of 12 points at equal distances along the ellipse has 0.936 of its area, π/4 of 0.5337 by 0.115; over
    // the pitch, twice.
    let straight = 2.0 * 0.936 * std::f64::consts::PI / 4.0 * 0.5337 * 0.115 / 0.747;
    let crimp = figure(&report, "crimp of warp and weft");
    assert!((1.2..1.6).contains(&crimp), "{report}");
    assert!((figure(&report, "volume over area") / (straight * (1.0 + 0.01 * crimp)) - 1.0).abs() < 0.015, "{report}");
    assert!((figure(&report, "thickness") - 0.23).abs() < 1e-3 && figure(&report, "fibres off their elements") < 1.0);
    // Its yarns lie on each other, and chords of the mesh go into them a little.
    assert!(report.contains("nodes are in another yarn, and 0 % of the yarns' volume"), "{report}");
    let elements = figure(&report, "elements, nodes");
    assert!((figure(&report, "wedges among the elements") / elements - 1.0 / 3.0).abs() < 0.01, "{report}");
    let picture = Picture::read(&output.join("weave.png"));
    let warp = picture.share(|[red, _, blue]| blue > red + 40);
    let weft = picture.share(|[red, _, blue]| red > blue + 40);
    assert!((0.2..0.4).contains(&warp) && (0.2..0.4).contains(&weft), "{warp} {weft}");
}

#[test]
fn texgen_s_yarns_that_go_into_each_other_are_refused_unless_refined() {
    let wide = |refined: &str| {
        let output = texgen(&format!("meshes-wide-{refined}"), 3, "0.70", "12", refined);
        toron(&output, "weave", MESH)
    };
    let error = String::from_utf8(wide("0").stderr).expect("text");
    assert!(error.contains("% of the yarns' volume is in two yarns; allowed: up to 2.000 %"), "{error}");
    let report = String::from_utf8(wide("1").stdout).expect("text");
    assert_eq!(figure(&report, "volume in two yarns"), 0.0, "{report}");
}

const SCENE: &str = "[scene]\nspeed = 142.0\nmass = 0.692\nradius = 2.778\ncontact-stiffness = 1e5\nend = 0.003\n\
                     sample = 0.0005\nfailure = \"uniaxial\"\nhyperelastic.properties = { k_ld = 126.0, eps_lim = 0.02 }\n";

/// The cells of a column of the history.
fn column(history: &str, name: &str) -> Vec<f64> {
    let mut lines = history.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let titles = lines.next().expect("a header");
    let place = titles.iter().position(|title| title.split(" (").next() == Some(name)).expect("the column");
    lines.map(|cells| cells[place].parse().expect("a number")).collect()
}

#[test]
fn wedges_are_struck() {
    let output = texgen("meshes-struck", 4, "0.5337", "8", "0");
    let mesh = format!("{MESH}shift = [-1.1206, -1.1206]\n");
    let answer = toron(&output, "fabric", &format!("{mesh}{SCENE}"));
    assert!(answer.status.success(), "{}", String::from_utf8_lossy(&answer.stderr));
    let history = std::fs::read_to_string(output.join("scene.csv")).expect("a history");
    let total = column(&history, "total_energy");
    assert!(total.iter().all(|energy| (energy / total[0] - 1.0).abs() < 1e-3), "{total:?}");
    let (speed, deflection) = (column(&history, "speed"), column(&history, "deflection"));
    let last = speed.len() - 1;
    assert!(speed[last] < 141.9 && deflection[last] > 0.3, "{speed:?} {deflection:?}");
    let whole = column(&history, "deleted").iter().take_while(|&&deleted| deleted == 0.0).count();
    let jacobians = column(&history, "least_scaled_jacobian");
    assert!(whole > 2 && jacobians[..whole].iter().all(|least| (0.0..=1.0).contains(least)), "{jacobians:?}");
    // A deck needs a gap, which yarns that meet do not leave.
    let deck = |mesh: &str| {
        std::fs::write(output.join("scene.toml"), format!("{mesh}{SCENE}")).expect("the scene");
        let mut program = Command::new(env!("CARGO_BIN_EXE_toron"));
        program.arg("fabric").arg(output.join("scene.toml")).args(["--deck", "ls-dyna", "-o"]).arg(&output);
        program.output().expect("it starts")
    };
    let refused = String::from_utf8(deck(&mesh).stderr).expect("text");
    assert!(refused.contains("the deck's contact has no gap; allowed: clearance > 0 in [mesh]"), "{refused}");
    assert!(deck(&format!("{mesh}clearance = 0.001\n")).status.success());
}

#[test]
fn a_mesh_that_is_struck_at_its_corner_says_so() {
    let output = texgen("meshes-corner", 4, "0.5337", "8", "0");
    let scene = SCENE.replace("end = 0.003", "end = 0.0005");
    let report = |mesh: &str| {
        let answer = toron(&output, "fabric", &format!("{mesh}{scene}"));
        assert!(answer.status.success(), "{}", String::from_utf8_lossy(&answer.stderr));
        format!("{}{}", String::from_utf8_lossy(&answer.stdout), String::from_utf8_lossy(&answer.stderr))
    };
    let corner = report(MESH);
    assert!(corner.contains("the blow is at (0, 0) mm, nearer to an edge of the mesh than to its middle"), "{corner}");
    let summary = std::fs::read_to_string(output.join("summary.csv")).expect("a summary");
    assert!(summary.contains("aim"), "{summary}");
    let middle = report(&format!("{MESH}shift = [-1.1206, -1.1206]\n"));
    assert!(!middle.contains("nearer to an edge"), "{middle}");
}

#[test]
fn a_woven_panel_read_back_has_the_same_history() {
    let output = folder("meshes-round-trip");
    let weave = "[weave]\npreset = \"kevlar-s706\"\nalong = 4\ncolumns = 4\n[weave.panel]\nshape = \"circle\"\nradius = 2.0\n\
                 part = \"quarter\"\n";
    let history = |panel: &str| {
        let answer = toron(&output, "fabric", &format!("units = \"mm-g-ms\"\n{panel}{SCENE}"));
        assert!(answer.status.success(), "{}", String::from_utf8_lossy(&answer.stderr));
        std::fs::read_to_string(output.join("scene.csv")).expect("a history")
    };
    let woven = history(weave);
    assert!(toron(&output, "weave", &format!("units = \"mm-g-ms\"\n{weave}")).status.success());
    assert!(
        woven == history("[mesh]\nfile = \"weave.vtu\"\npart = \"quarter\"\nheight = 0.115\n"),
        "the histories differ"
    );
    // The contact's search is set to the height, which is given: a measured one differs by rounding. A case may have a
    // mesh of its own.
    let cases = "[[case]]\nname = \"woven\"\n[[case]]\nname = \"read\"\nmesh = { file = \"weave.vtu\", part = \"quarter\", height = 0.115 }\n";
    let answer = toron(&output, "fabric", &format!("units = \"mm-g-ms\"\n{weave}{SCENE}{cases}"));
    assert!(answer.status.success(), "{}", String::from_utf8_lossy(&answer.stderr));
    let [one, other] =
        ["woven", "read"].map(|name| std::fs::read(output.join(format!("{name}.csv"))).expect("a history"));
    assert!(one == other && one == woven.as_bytes());
}
