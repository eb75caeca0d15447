//! Whose the files of a directory are: no command overwrites those of another, or of other data, in silence; who is
//! refused owns nothing and is told where to go; and the documents' commands are refused nowhere.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use toron_test_support::library::{ROOT, folder};

const STEP: &str = "units = \"si\"\n[material]\npreset = \"kevlar-km2-600\"\n[[step]]\nF = { 11 = 1.01 }\n";
const SHEET: &str = "units = \"mm-tonne-s\"\n[yarn]\npreset = \"kevlar-km2-600\"\n[fibre]\nmodulus = 90000.0\nvolume_fraction = 0.9\n\
                     strain_at_failure = 0.04\n";
const STRENGTHS: &str = "units = \"mm-tonne-s\"\n[[strength]]\nname = \"lot\"\nfile = \"lot.csv\"\nlength = 50\n";
const YARN: &str = "units = \"mm-g-ms\"\n[scene]\nhalf-length = 1.0\nheight = 0.1\nwidth = 0.5\nlayers = 4\nrows = 1\n\
                    columns = 2\nmass = 9.91e-3\nradius = 1.1\ncontact-stiffness = 1e6\nspeed = 120.0\nend = 1e-5\n\
                    hyperelastic.preset = \"kevlar-km2-600\"\n";

/// A place of a test's own, where an earlier run of it has left nothing.
fn place(name: &str, files: &[(&str, &str)]) -> PathBuf {
    let place = folder(name);
    std::fs::remove_dir_all(&place).and_then(|()| std::fs::create_dir_all(&place)).expect("a folder");
    for (name, text) in files {
        std::fs::write(place.join(name), text).expect("a file");
    }
    place
}

/// The exit code of a command, and what it says on the standard error.
fn toron(place: &Path, line: &str) -> (Option<i32>, String) {
    let mut program = Command::new(env!("CARGO_BIN_EXE_toron"));
    let answer = program.args(line.split(' ')).current_dir(place).output().expect("it starts");
    (answer.status.code(), String::from_utf8_lossy(&answer.stderr).into_owned())
}

#[track_caller]
fn succeeds(place: &Path, line: &str) {
    let (code, said) = toron(place, line);
    assert_eq!(code, Some(0), "{line}: {said}");
}

#[track_caller]
fn refused(place: &Path, line: &str, messages: &[&str]) {
    let (code, said) = toron(place, line);
    assert_eq!(code, Some(2), "{line}: {said}");
    for message in messages {
        assert!(said.contains(message), "{line}: {said}");
    }
}

fn read(place: &Path, name: &str) -> String {
    std::fs::read_to_string(place.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

#[test]
fn a_fit_overwrites_no_other_one() {
    let strengths = "strength (MPa)\n2900\n3000\n3100\n3150\n3300\n";
    let other = STRENGTHS.replace("\"lot\"", "\"other\"");
    let files =
        [("a.toml", SHEET), ("b.toml", SHEET), ("s.toml", STRENGTHS), ("t.toml", &other), ("lot.csv", strengths)];
    let place = place("directories-fit", &files);
    succeeds(&place, "fit a.toml");
    let first = read(&place, "toron-out/parameters.csv");
    let said = " are of toron fit ../a.toml, and toron fit ../b.toml would overwrite them; ";
    refused(&place, "fit b.toml", &[said, "allowed: another directory, as -o toron-out-b, or"]);
    assert_eq!(read(&place, "toron-out/parameters.csv"), first);
    succeeds(&place, "fit b.toml -o toron-out-b");
    // The same data again, and what has other files: but not their table by other strengths.
    for line in ["fit a.toml", "fit s.toml", "run"] {
        succeeds(&place, line);
    }
    refused(&place, "fit t.toml", &["files called strengths are of toron fit ../s.toml"]);
}

/// A file of an earlier fit of the same data stands beside no figures of another.
#[test]
fn a_fit_leaves_no_table_of_an_earlier_one() {
    let place = place("directories-worth", &[("a.toml", SHEET)]);
    succeeds(&place, "fit a.toml");
    std::fs::write(place.join("toron-out/worth.csv"), "speed\n1\n").expect("a file");
    succeeds(&place, "fit a.toml");
    assert!(!place.join("toron-out/worth.csv").exists());
}

/// `toron cell` writes `fit.toml`, which the fit reads, now and again; the fit of other data is refused there.
#[test]
fn what_a_cell_hands_over_is_fitted_in_its_directory() {
    let place = place("directories-cell", &[("other.toml", SHEET)]);
    let example = std::fs::read_to_string(Path::new(ROOT).join("examples/identification/cell.toml")).expect("a scene");
    let mut scene = example;
    for (from, to) in [
        ("packing = \"hexagonal\"", "host = \"explicit\"\npacking = \"hexagonal\""),
        ("elements = 8", "elements = 2"),
        ("largest = 0.12", "largest = 0.02"),
        ("largest_distortion = 0.06", "largest_distortion = 0.02"),
        ("increments = 24", "increments = 6"),
    ] {
        assert!(scene.contains(from), "{from}");
        scene = scene.replacen(from, to, 1);
    }
    std::fs::write(place.join("cell.toml"), &scene).expect("a file");
    std::fs::write(place.join("cell-2.toml"), &scene).expect("a file");
    let again = "fit toron-out/cell/fit.toml -o toron-out/cell";
    for line in ["cell cell.toml", again, "cell cell.toml", again, "fit toron-out/cell/fit.toml", "fit other.toml -o o"]
    {
        succeeds(&place, line);
    }
    let way_out =
        |stem: &str| format!(" would overwrite them; allowed: another directory, as -o toron-out/cell-{stem},");
    refused(&place, "fit other.toml -o toron-out/cell", &[&way_out("other")]);
    refused(&place, "cell cell-2.toml", &[&way_out("cell-2")]);
    // A checkpoint of another scene is refused before the directory is this one's.
    let owners = read(&place, "toron-out/cell/toron.lock");
    let other = scene.replacen("friction = 0.2", "friction = 0.3", 1);
    std::fs::write(place.join("cell-2.toml"), other).expect("a file");
    refused(&place, "cell cell-2.toml --restart", &["is of another scene"]);
    assert_eq!(read(&place, "toron-out/cell/toron.lock"), owners);
}

#[test]
fn a_demonstration_makes_way() {
    let place = place("directories-demonstration", &[("my path.toml", STEP), ("other.toml", STEP)]);
    succeeds(&place, "run");
    let mut program = Command::new(env!("CARGO_BIN_EXE_toron"));
    let answer = program.args(["run", "my path.toml"]).current_dir(&place).output().expect("it starts");
    assert!(answer.status.success(), "{}", String::from_utf8_lossy(&answer.stderr));
    refused(&place, "run", &["are of toron run ../my path.toml, and toron run would overwrite them"]);
    let way_out = "as -o toron-out-other, or";
    refused(&place, "run other.toml", &[way_out]);
    succeeds(&place, "run other.toml -o toron-out-other");
    // One that is somebody's already is not named.
    refused(&place, "run my.toml", &["nowhere"].map(|_| "my.toml: "));
    std::fs::rename(place.join("my path.toml"), place.join("path.toml")).expect("it is renamed");
    refused(&place, "run path.toml -o toron-out-other", &["as -o toron-out-other-path, or"]);
}

/// A scene that is refused, or whose run has nothing to write, keeps nobody out.
#[test]
fn who_is_refused_owns_nothing() {
    let fails = STEP.replace("F = { 11 = 1.01 }", "P = { 12 = 1e6 }");
    let bad = STEP.replace("[[step]]", "[[steps]]");
    let place = place("directories-refused", &[("fails.toml", &fails), ("bad.toml", &bad), ("good.toml", STEP)]);
    refused(&place, "run bad.toml", &["unknown field"]);
    assert!(!place.join("toron-out").exists());
    let (code, said) = toron(&place, "run fails.toml");
    let has_written = place.join("toron-out/increments.csv").exists();
    assert!(code == Some(1), "{said}");
    assert_eq!(read(&place, "toron-out/toron.lock").is_empty(), !has_written, "{said}");
}

/// The shots of one scene are not another's, which `--restart` tells before anything is written down.
#[test]
fn a_restart_of_another_scene_takes_no_directory() {
    let shots = "[shots]\nnumber = 2\nspeeds = [60.0, 200.0]\ndesign = \"even\"\nscatter = 1.0\n";
    let [one, two] = ["speed = 120.0", "speed = 121.0"].map(|speed| {
        YARN.replace("speed = 120.0", speed).replace("end = 1e-5", "end = 1e-5\nfailure = \"uniaxial\"") + shots
    });
    let two = two.replace("radius = 1.1", "radius = 1.2");
    let place = place("directories-v50", &[("one.toml", &one), ("two.toml", &two)]);
    let (_, said) = toron(&place, "v50 one.toml");
    let owner = read(&place, "toron-out/v50/toron.lock");
    assert!(owner.contains("one.toml"), "{said}");
    refused(&place, "v50 two.toml", &["are of toron v50 ../../one.toml", "as -o toron-out/v50-two, or"]);
    refused(&place, "v50 two.toml --restart", &["a shot of another scene"]);
    refused(&place, "v50 one.toml", &["is there, of an earlier run; allowed: --restart"]);
    assert_eq!(read(&place, "toron-out/v50/toron.lock"), owner);
}

/// Decks are their scene's. Of their files the short ones are kept, the meshes are not.
#[test]
fn decks_are_of_their_scene() {
    let finer = YARN.replace("columns = 2", "columns = 4");
    let place = place("directories-decks", &[("a.toml", YARN), ("b.toml", YARN)]);
    let deck = "--deck abaqus-explicit -o job";
    succeeds(&place, &format!("impact a.toml {deck}"));
    refused(
        &place,
        &format!("impact b.toml {deck}"),
        &["files called scene are of toron impact ../a.toml", "-o job-b"],
    );
    succeeds(&place, &format!("impact b.toml {deck} --prefix b-"));
    let mesh = read(&place, "job/scene-mesh.inp");
    std::fs::write(place.join("a.toml"), finer).expect("a file");
    let edited = read(&place, "job/scene.inp") + "** by hand\n";
    std::fs::write(place.join("job/scene.inp"), &edited).expect("a file");
    succeeds(&place, &format!("impact a.toml {deck}"));
    assert!(read(&place, "job/scene-mesh.inp") != mesh && read(&place, "job/scene.inp-old") == edited);
    let old = std::fs::read_dir(place.join("job")).expect("a folder").flatten();
    let old = old.filter(|entry| entry.file_name().to_string_lossy().contains("-old"));
    assert_eq!(old.count(), 1);
    // A deck that is refused has no owner: no case of it may be in the way.
    let bare = YARN.replace("hyperelastic.preset", "hyperelastic.presets");
    std::fs::write(place.join("bare.toml"), bare).expect("a file");
    refused(&place, "impact bare.toml --deck ls-dyna -o bare", &["presets"]);
    assert!(!place.join("bare").exists());
}

/// Results of another scene, which hours may have gone into, are not removed without a word.
#[test]
fn results_of_fibres_stay_when_the_scene_changes() {
    let scene = std::fs::read_to_string(Path::new(ROOT).join("examples/fibre_scale/smith.toml")).expect("a scene");
    let scene = scene.split("[[case]]").next().expect("the scene").to_string();
    let place = place("directories-fibres", &[("smith.toml", &scene)]);
    succeeds(&place, "fibres smith.toml --write-only -o out");
    let [history, done] = ["out/scene/history.txt", "out/scene/done.txt"];
    for file in [history, done] {
        std::fs::write(place.join(file), "an hour's work\n").expect("a file");
    }
    let changed = scene.replacen("end = ", "end = 1.01e0 # ", 1);
    assert_ne!(changed, scene);
    std::fs::write(place.join("smith.toml"), changed).expect("a file");
    let said = "what an earlier run of case scene has left in out/scene is of another scene; allowed: the scene as it was, \
                --anew, or another directory";
    refused(&place, "fibres smith.toml --write-only -o out", &[said]);
    assert!([history, done].iter().all(|file| place.join(file).exists()));
    let (code, said) = toron(&place, "fibres smith.toml --write-only --anew -o out");
    assert!(code == Some(0) && said.contains("2 files of an earlier run are removed from out\n"), "{said}");
    assert!(![history, done].iter().any(|file| place.join(file).exists()));
    // The input that may have been edited is kept, the beads are not.
    assert!(place.join("out/scene/in.lmp-old").exists() && !place.join("out/scene/beads.lmp-old").exists());
}

#[cfg(unix)]
#[test]
fn a_program_that_is_no_lammps_is_named() {
    let scene = std::fs::read_to_string(Path::new(ROOT).join("examples/fibre_scale/smith.toml")).expect("a scene");
    let scene = scene.split("[[case]]").next().expect("the scene").to_string();
    let place = place("directories-lammps", &[("smith.toml", &scene)]);
    let said = "/bin/true -in in.lmp has ended without an error, but has not written out/scene/done.txt, as LAMMPS does at \
                the end of in.lmp; all it said is in out/scene/said.txt; allowed: the program lmp of LAMMPS";
    refused(&place, "fibres smith.toml --lmp /bin/true -o out", &[said]);
}

/// Whatever is called `-` is read from the standard input, or refused by name.
#[test]
fn the_standard_input_is_read_or_refused_by_name() {
    let data = "[[data]]\nfile = \"-\"\nloading = \"elongation\"\n";
    let head = "units = \"mm-tonne-s\"\n[yarn]\npreset = \"kevlar-km2-600\"\n";
    let [strengths, mesh] =
        [STRENGTHS.replace("lot.csv", "-"), "units = \"mm-g-ms\"\n[mesh]\nfile = \"-\"\n".to_string()];
    let files = [
        ("data.toml", &*format!("{head}{data}")),
        ("path.toml", &format!("{head}[[data]]\nfile = \"a.csv\"\npath = \"-\"\n")),
        ("a.csv", "strain (%),stress (MPa)\n1,811\n"),
        ("strengths.toml", &strengths),
        ("mesh.toml", &mesh),
    ];
    let place = place("directories-standard-input", &files);
    // What a file of this name holds is not taken for it.
    std::fs::write(place.join("-"), "strain (%),stress (MPa)\n1,811\n").expect("a file");
    for (line, said) in [
        ("fit data.toml", "data.toml:5: file is \"-\"; allowed: "),
        ("fit path.toml", "path.toml:6: path is \"-\"; allowed: "),
        ("fit strengths.toml", "strengths.toml:4: file is \"-\"; allowed: "),
        ("weave mesh.toml", "mesh.toml:3: mesh.file is \"-\"; allowed: "),
    ] {
        refused(&place, line, &[said]);
    }
    #[cfg(target_os = "linux")]
    refused(&place, "check -", &["the subroutine is -; allowed: a file"]);
    let history = Path::new(ROOT).join("program/tests/program/compare/toron/scene.csv");
    let input = std::fs::File::open(history).expect("a history");
    let mut program = Command::new(env!("CARGO_BIN_EXE_toron"));
    let answer = program.args(["compare", "-"]).current_dir(&place).stdin(input).output().expect("it starts");
    assert!(answer.status.success(), "{}", String::from_utf8_lossy(&answer.stderr));
    assert!(String::from_utf8_lossy(&answer.stdout).contains("132.6"), "{answer:?}");
}

/// What a check keeps of one law is not another's, whose file has the same name.
#[cfg(target_os = "linux")]
#[test]
fn calls_of_one_law_are_not_another_s() {
    let place = place("directories-check", &[]);
    let ends =
        "      SUBROUTINE UMAT(STRESS,STATEV)\n      DIMENSION STRESS(6), STATEV(*)\n      CALL ABORT\n      END\n";
    for law in ["one", "two"] {
        std::fs::create_dir(place.join(law)).expect("a folder");
        std::fs::write(place.join(law).join("umat.f"), ends).expect("a file");
    }
    let (_, said) = toron(&place, "check one/umat.f --props 1 --only memory");
    assert!(place.join("toron-out/check/umat-memory.json").exists(), "{said}");
    refused(
        &place,
        "check two/umat.f --props 1 --only memory",
        &["are of toron check ../../one/umat.f", "-o toron-out/check-umat"],
    );
    let (_, said) = toron(&place, "check one/umat.f --props 1 --only memory");
    assert!(!said.contains("would overwrite"), "{said}");
}

/// A command of a page that writes files: the directory, the command, and what it was given.
fn written(line: &str) -> Option<(String, String, Vec<String>)> {
    const DEFAULTS: [(&str, &str); 9] = [
        ("fit", "toron-out"),
        ("run", "toron-out"),
        ("weave", "toron-out"),
        ("cell", "toron-out/cell"),
        ("fabric", "toron-out/fabric"),
        ("impact", "toron-out/impact"),
        ("v50", "toron-out/v50"),
        ("fibres", "toron-out/fibres"),
        ("compare", "toron-out/compare"),
    ];
    let line = line.split(" #").next().unwrap_or_default().split(" | ").next().unwrap_or_default();
    let words: Vec<&str> = line.split_whitespace().collect();
    let (command, default) = DEFAULTS.into_iter().find(|(command, _)| words.first() == Some(command))?;
    let given = words[1..].iter().take_while(|word| !word.starts_with("--") && **word != "-o");
    let given: Vec<String> = given.map(|word| word.to_string()).collect();
    // What stands for another word, and what strikes nothing.
    let stands_for = |word: &str| word.contains('$') || word.chars().all(|c| c.is_uppercase() || ".toml[]".contains(c));
    if given.iter().any(|word| stands_for(word)) || words.contains(&"--simulate") {
        return None;
    }
    let output = words.iter().position(|word| *word == "-o").map_or(default, |place| words[place + 1]);
    (!output.contains('$')).then(|| (output.to_string(), command.to_string(), given))
}

/// What a folder's files are called in which several commands have some of the same names.
type Owners = BTreeMap<(String, &'static str), (Vec<String>, String)>;

/// That a command of `page` is refused by none of those before, whatever their order: what has files of the same names
/// has another directory, or the same scene.
fn leaves_others(owners: &mut Owners, page: &str, (directory, command, given): (String, String, Vec<String>)) {
    let names = match &*command {
        "fabric" | "impact" | "fibres" => "a summary",
        "fit" | "cell" => "parameters",
        "run" => "increments",
        "weave" => "a mesh",
        "v50" => "shots",
        _ => "a comparison",
    };
    let line = format!("{page}: toron {command} {}", given.join(" "));
    // Without a file it makes way.
    if given.is_empty() {
        return;
    }
    let (before, whose) = owners.entry((directory.clone(), names)).or_insert((given.clone(), line.clone()));
    assert_eq!(*before, given, "{line}\n{whose}\nboth write {names} to {directory}");
}

/// Who types the commands of all pages in one folder is refused nowhere.
#[test]
fn the_documents_commands_leave_one_another_s_files() {
    let guides = std::fs::read_dir(Path::new(ROOT).join("docs/guides")).expect("a folder").flatten();
    let guides = guides.map(|entry| entry.path()).filter(|path| path.extension().is_some_and(|ending| ending == "md"));
    let pages = ["README.md", "docs/tutorial.md"].map(|name| Path::new(ROOT).join(name)).into_iter().chain(guides);
    let (mut owners, mut commands) = (Owners::new(), 0);
    for page in pages {
        let text = std::fs::read_to_string(&page).expect("a page");
        let lines = text.lines().flat_map(|line| line.split('`')).filter_map(|line| {
            let called = line.split_once("cargo run --release -- ").or_else(|| line.split_once("toron "))?;
            (called.0.trim().is_empty() || called.0.contains("TORON_LMP=")).then_some(called.1)
        });
        for told in lines.filter_map(written) {
            commands += 1;
            leaves_others(&mut owners, &page.display().to_string(), told);
        }
    }
    assert!(commands > 20, "{commands} commands");
}

/// So is who runs all that `toron init` writes.
#[test]
fn the_scenes_to_start_from_leave_one_another_s_files() {
    let answer = Command::new(env!("CARGO_BIN_EXE_toron")).arg("init").output().expect("it starts");
    let list = String::from_utf8(answer.stdout).expect("UTF-8");
    let (mut owners, mut commands) = (Owners::new(), 0);
    for row in list.lines().filter_map(|line| line.trim().split_once("  toron ")) {
        let [name, command] = [row.0, row.1].map(|text| text.split_whitespace().next().unwrap_or_default());
        commands += 1;
        leaves_others(&mut owners, "toron init", written(&format!("{command} {name}.toml")).expect("it writes files"));
    }
    assert_eq!(commands, 8, "{list}");
}
