//! Presets of a user's own files, in load paths, scenes and decks.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use toron::host::units::UnitSystem;
use toron_materials::load_path::path::LoadPath;
use toron_materials::material::laws::Laws;
use toron_materials::material::model::Material;
use toron_strikes::impact::scene::{Scene, Zones};

const YARN: &str = "name = \"my-yarn\"\nsource = \"lot 12\"\nunits = \"mm-tonne-s\"\ndensity = 1.1e-9\n[properties]\n\
                    k_el = 82445.3\nk_tc = 1012.7\np = 2.3\nk_td = 655.1\neps_lim = 0.046\n";
const LINEAR: &str = "units = \"si\"\nlaw = \"linear-elastic\"\ndensity = 1100\n[properties]\ne_1 = 79.1e9\ne_2 = 0.8e9\n\
                      g = 0.13e9\nsigma_lim = 3.6e9\n";

/// A folder with the two yarns in `yarns/`.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("presets-{name}"));
    if folder.exists() {
        std::fs::remove_dir_all(&folder).expect("an old folder can be removed");
    }
    std::fs::create_dir_all(folder.join("yarns")).expect("a folder can be made");
    write(&folder, "yarns/my-yarn.toml", YARN);
    write(&folder, "yarns/linear.toml", LINEAR);
    folder
}

fn write(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).expect("a file can be written");
}

fn toron(folder: &Path, arguments: &[&str]) -> Output {
    let mut program = Command::new(env!("CARGO_BIN_EXE_toron"));
    program.args(arguments).current_dir(folder).output().expect("the program starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("output is UTF-8")
}

/// A load path with this material, and points if any.
fn load_path(units: &str, material: &str) -> String {
    format!("units = \"{units}\"\n[material]\n{material}\n[[step]]\nF = {{ 11 = 1.01 }}\n")
}

fn materials(folder: &Path, text: &str) -> Vec<Material> {
    write(folder, "path.toml", text);
    let path = LoadPath::read(Laws::Toron, &folder.join("path.toml")).unwrap_or_else(|error| panic!("{text}: {error}"));
    path.points.into_iter().map(|point| point.material).collect()
}

fn property(material: &Material, name: &str) -> f64 {
    let row = material.table().iter().position(|property| property.name == name).expect("the law has it");
    material.values()[row]
}

#[test]
fn the_file_s_own_units_keep_every_bit() {
    let folder = folder("units");
    let own = materials(&folder, &load_path("mm-tonne-s", "preset = \"yarns/my-yarn.toml\"")).remove(0);
    assert_eq!(own.values(), [82445.3, 1012.7, 2.3, 655.1, 0.0, 0.046, 0.0, 0.0, 1.0, 0.0, 0.0]);
    assert_eq!((own.density, own.label.as_str()), (Some(1.1e-9), "my-yarn"));
    // The same units of stress, another one of mass: the stresses are not touched.
    let grams = materials(&folder, &load_path("mm-g-ms", "preset = \"yarns/my-yarn.toml\"")).remove(0);
    assert_eq!((&grams.values(), grams.density), (&own.values(), Some(1.1e-9 * 1e6)));
    let si = materials(&folder, &load_path("si", "preset = \"yarns/my-yarn.toml\"")).remove(0);
    assert_eq!((property(&si, "k_el"), property(&si, "p"), si.density), (82445.3e6, 2.3, Some(1.1e-9 * 1e12)));
    let inches = materials(&folder, &load_path("in-slinch-s", "preset = \"yarns/my-yarn.toml\"")).remove(0);
    let psi = UnitSystem::parse("in-slinch-s").expect("a system").from_si(1e6, toron::parameters::STRESS);
    assert!((property(&inches, "k_el") / (82445.3 * psi) - 1.0).abs() < 1e-14);
}

#[test]
fn a_material_overrides_the_file_as_a_built_in_preset() {
    let folder = folder("overrides");
    let points = "preset = \"yarns/my-yarn.toml\"\nproperties = { k_ld = 20, alpha = 1.5 }\n\
                  [[point]]\nname = \"askew\"\nmaterial = { fibre = [1, 0.1, 0], density = 2e-9 }\n\
                  [[point]]\nname = \"linear\"\nmaterial = { preset = \"yarns/linear.toml\", frame = \"polar\" }";
    let materials = materials(&folder, &load_path("mm-tonne-s", points));
    assert_eq!(materials[0].values(), [82445.3, 1012.7, 2.3, 655.1, 20.0, 0.046, 1.5, 0.0, 1.0, 0.1, 0.0]);
    assert_eq!(materials[0].density, Some(2e-9));
    assert_eq!((materials[1].law_name(), materials[1].label.as_str()), ("linear elastic", "linear"));
    assert_eq!((property(&materials[1], "e_1"), property(&materials[1], "g")), (79.1e9 / 1e6, 0.13e9 / 1e6));
}

#[test]
fn an_absolute_path_is_one() {
    let folder = folder("absolute");
    let file = folder.join("yarns/my-yarn.toml");
    let elsewhere = folder.join("yarns");
    let path = load_path("mm-tonne-s", &format!("preset = '{}'", file.display()));
    assert_eq!(property(&materials(&elsewhere, &path)[0], "k_el"), 82445.3);
}

fn scene(lines: &str) -> String {
    format!(
        "units = \"mm-g-ms\"\n[scene]\nhalf-length = 12.7\nheight = 0.115\nwidth = 0.5337\nlayers = 100\nrows = 2\n\
         columns = 6\nspeed = 120.0\nend = 0.03\nmass = 9.91e-3\nradius = 1.1\ncontact-stiffness = 1e6\n{lines}\n"
    )
}

/// The zones of the first case.
fn zones(folder: &Path, lines: &str) -> Result<Zones, String> {
    write(folder, "scene.toml", &scene(lines));
    let scene = Scene::read(&folder.join("scene.toml")).map_err(|error| error.to_string())?;
    Ok(scene.cases.into_iter().next().expect("a case").zones)
}

#[test]
fn both_zones_of_a_scene_take_files() {
    let folder = folder("scene");
    let hybrid = "law = \"hybrid\"\nfailure = \"uniaxial\"\nhyperelastic-length = 2.54\n\
                  hyperelastic = { preset = \"yarns/my-yarn.toml\" }\nlinear-elastic = { preset = \"yarns/linear.toml\" }";
    let Ok(Zones::Two(materials, _)) = zones(&folder, hybrid) else { panic!("two laws") };
    assert_eq!((property(&materials[0], "k_el"), property(&materials[0], "eps_lim")), (82445.3, 0.046));
    assert_eq!((property(&materials[1], "e_1"), materials[1].density), (79.1e9 / 1e6, Some(1100.0 / 1e6)));
    let case = "[[case]]\nname = \"a\"\nhyperelastic = { preset = \"yarns/my-yarn.toml\", properties = { p = 3.0 } }";
    let Ok(Zones::One(material)) = zones(&folder, case) else { panic!("one law") };
    assert_eq!((property(&material, "p"), property(&material, "k_tc")), (3.0, 1012.7));

    let place = folder.join("scene.toml").display().to_string();
    assert_eq!(
        zones(&folder, "hyperelastic = { preset = \"yarns/linear.toml\" }").err(),
        Some(format!("{place}:14: hyperelastic has a material of the law linear-elastic; allowed: hyperelastic"))
    );
    let missing = zones(&folder, "hyperelastic = { preset = \"nylon.toml\" }").expect_err("there is no such file");
    let file = folder.join("nylon.toml").display().to_string();
    let expected = format!("{place}:14: preset \"nylon.toml\": {file} cannot be read: ");
    assert!(missing.starts_with(&expected), "{missing}");
}

#[test]
fn errors_name_the_file_that_is_wrong() {
    let folder = folder("errors");
    let said = |yarn: &str, material: &str| {
        write(&folder, "yarns/wrong.toml", yarn);
        let material = format!("preset = \"yarns/wrong.toml\"\n{material}");
        write(&folder, "path.toml", &load_path("mm-tonne-s", &material));
        let output = toron(&folder, &["run", "path.toml"]);
        (output.status.code(), text(&output.stderr))
    };
    let wrong = |yarn: &str, material: &str, message: &str| {
        let expected = format!("toron: {message}\n");
        assert_eq!(said(yarn, material), (Some(2), expected), "{yarn}{material}");
    };
    let without = |line: &str| YARN.replace(line, "");
    let k_td = "property k_td (transverse distortion stiffness) is missing, and yarns/wrong.toml does not give it";
    wrong(&without("k_td = 655.1\n"), "", &format!("path.toml:2: {k_td}; allowed: a number from 0 to 1e25"));
    assert_eq!(said(&without("k_td = 655.1\n"), "properties = { k_td = 600 }").0, Some(0));
    let negative = "property 2 (k_tc, transverse compaction stiffness) is -1012.7; allowed: a number from 0 to 1e25";
    wrong(&YARN.replace("k_tc = ", "k_tc = -"), "", &format!("yarns/wrong.toml:7: {negative}"));
    let direction = "properties 9 to 11 (fibre direction) are 0.0, 0.0, 0.0; allowed: any vector but zero";
    wrong(&format!("{YARN}m_1 = 0\n"), "", &format!("yarns/wrong.toml:11: {direction}"));
    assert_eq!(said(&format!("{YARN}m_1 = 0\n"), "fibre = [0, 1, 0]").0, Some(0));
    wrong(YARN, "fibre = [0, 0, 0]", &format!("path.toml:4: {direction}"));
    let other = "path.toml:4: preset \"my-yarn\" is of the law hyperelastic; allowed: hyperelastic";
    wrong(YARN, "law = \"linear-elastic\"", other);
    // A yarn gets friction between its fibres: that law has all of its properties.
    let mu = "property mu (friction of the section: sine of its angle of friction) is missing, and yarns/wrong.toml does not give it";
    wrong(YARN, "law = \"frictional\"", &format!("path.toml:2: {mu}; allowed: a number from 0 to below 1"));
    assert_eq!(said(YARN, "law = \"frictional\"\nproperties = { mu = 0.15 }").0, Some(0));
    let k_tc = YARN.replace("k_tc = ", "k_tc = -");
    wrong(&k_tc, "law = \"frictional\"\nproperties = { mu = 0.15 }", &format!("yarns/wrong.toml:7: {negative}"));
    // Allowed in the file's units, not in those of the load path.
    let huge = "property 1 (k_el, longitudinal elongation stiffness) is 2e25; allowed: a number from 0 to 1e25";
    let giga = YARN.replace("mm-tonne-s", "mm-kg-ms").replace("82445.3", "2e22");
    wrong(&giga, "", &format!("yarns/wrong.toml:6: {huge}"));
    std::fs::remove_file(folder.join("yarns/wrong.toml")).expect("it is there");
    let (code, missing) = {
        let output = toron(&folder, &["run", "path.toml"]);
        (output.status.code(), text(&output.stderr))
    };
    let expected = "toron: path.toml:3: preset \"yarns/wrong.toml\": yarns/wrong.toml cannot be read: ";
    assert!(code == Some(2) && missing.starts_with(expected), "{missing}");
}

#[test]
fn a_summary_names_the_yarn() {
    let folder = folder("summary");
    write(&folder, "path.toml", &load_path("mm-tonne-s", "preset = \"yarns/my-yarn.toml\""));
    let output = toron(&folder, &["run", "path.toml"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let said = text(&output.stdout);
    assert!(said.contains("law                    hyperelastic (my-yarn)\n"), "{said}");
}

#[test]
fn a_file_prints_as_a_deck() {
    let folder = folder("deck");
    let answer = |arguments: &[&str]| {
        let output = toron(&folder, arguments);
        if output.status.success() { Ok(text(&output.stdout)) } else { Err(text(&output.stderr)) }
    };
    let deck = |arguments: &[&str]| answer(&[&["deck", "--host", "abaqus", "--preset"], arguments].concat());
    let own = deck(&["yarns/my-yarn.toml"]).expect("a deck");
    for line in [
        "** my-yarn: lot 12",
        "** toron, hyperelastic yarn law, in mm, tonne, s",
        "*MATERIAL, NAME=MY-YARN",
        "82445.3, 1012.7, 2.3, 655.1, 0.0, 0.046, 0.0, 0.0",
        "1.1e-9,",
    ] {
        assert!(own.lines().any(|found| found == line), "{line}\nin\n{own}");
    }
    assert_eq!(deck(&["yarns/my-yarn.toml", "--units", "mm-tonne-s"]), Ok(own.clone()));
    // The same file under another name, which no preset could have.
    write(&folder, "yarns/lot-12.txt", YARN);
    assert_eq!(answer(&["deck", "--host", "abaqus", "--properties", "yarns/lot-12.txt"]), Ok(own));
    let si = deck(&["yarns/my-yarn.toml", "--units", "si"]).expect("a deck");
    assert!(
        si.contains("\n** toron, hyperelastic yarn law, in m, kg, s\n") && si.contains("*DENSITY\n1.1e3,\n"),
        "{si}"
    );
    let linear = deck(&["yarns/linear.toml"]).expect("a deck");
    assert!(
        linear.contains("** toron, linear elastic law, in m, kg, s\n") && linear.contains("CONSTANTS=10"),
        "{linear}"
    );
    let values = answer(&["params", "--preset", "yarns/linear.toml"]).expect("a table");
    assert!(
        values.contains("Preset linear (linear-elastic)\n") && values.contains("density    1.1e3 kg/m³"),
        "{values}"
    );
    assert!(values.contains("toron deck --host HOST --preset yarns/linear.toml --units m-kg-s\n"), "{values}");

    write(&folder, "bare.toml", "units = \"si\"\n[properties]\nk_el = 1\nk_tc = 1\np = 2\n");
    let missing = "property k_td (transverse distortion stiffness) is missing; allowed: a number from 0 to 1e25";
    assert_eq!(deck(&["bare.toml"]), Err(format!("toron: bare.toml: {missing}\n")));
    write(&folder, "bare.toml", "units = \"si\"\n[properties]\nk_el = 1\nk_tc = 1\np = 2\nk_td = 1\n");
    let missing = "density is missing, which this host needs; allowed: a finite number > 0";
    assert_eq!(deck(&["bare.toml"]), Err(format!("toron: bare.toml: {missing}\n")));
    let static_only = answer(&["deck", "--host", "calculix", "--preset", "bare.toml"]).expect("it needs no density");
    assert!(static_only.contains("CONSTANTS=11") && !static_only.contains("*DENSITY"), "{static_only}");
    let nothing = deck(&["nothing.toml"]).expect_err("there is no file");
    assert!(
        nothing.starts_with("toron: --preset: preset \"nothing.toml\": nothing.toml cannot be read: "),
        "{nothing}"
    );
    let known = "kevlar-km2-600, kevlar-km2-600-linear, kevlar-km2-600-frictional, or a file NAME.toml";
    assert_eq!(deck(&["nylon"]), Err(format!("toron: --preset: preset \"nylon\"; allowed: {known}\n")));
}

const TENSION: &str = "units = \"mm-tonne-s\"\n[yarn]\nname = \"mine\"\nsource = \"lot 12\"\npreset = \"kevlar-km2-600\"\n[[data]]\n\
                       name = \"pull\"\nfile = \"pull.csv\"\nloading = \"elongation\"\n";

/// A tensile test alone: all else is a guess, α and ε_lim as well, and every way on says so: the notes, the preset,
/// cards, decks.
#[test]
fn guesses_are_called_so_wherever_the_yarn_goes() {
    let folder = folder("guesses");
    write(&folder, "pull.csv", "strain (%),stress (MPa)\n0.5,404\n1,811\n1.5,1205\n2,1599\n2.5,1990\n3,2363\n");
    write(&folder, "fit.toml", TENSION);
    let said = |arguments: &[&str]| {
        let output = toron(&folder, arguments);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        text(&output.stdout).split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let notes = said(&["fit", "fit.toml", "-o", "."]);
    let names = "k_tc, p, k_td, k_ld, eps_lim, alpha, beta";
    let note = format!("the data say nothing of {names}: these are guesses, the base preset's");
    assert!(notes.contains(&note), "{notes}");

    let guesses = |names: &str| format!("guesses, not measured on this yarn: {names} (of kevlar-km2-600)");
    for host in ["ls-dyna", "abaqus", "openradioss", "calculix", "mtest"] {
        let card = said(&["deck", "--host", host, "--preset", "mine.toml"]);
        assert!(card.contains("mine: lot 12") && card.contains(&guesses(&format!("{names}, density"))), "{card}");
    }
    // What somebody has given is no guess any more, and has a unit.
    let card = said(&["deck", "--host", "abaqus", "--preset", "mine.toml", "--set", "k_tc=900", "--set", "k_ld=10"]);
    let left = guesses("p, k_td, eps_lim, alpha, beta, density");
    assert!(card.contains("mine: lot 12; k_tc = 900 MPa; k_ld = 10 MPa") && card.contains(&left), "{card}");

    let own = "hyperelastic = { preset = \"mine.toml\", properties = { k_tc = 900, k_ld = 10 } }";
    write(&folder, "scene.toml", &scene(own));
    for (host, file) in [("ls-dyna", "scene.k"), ("abaqus-explicit", "scene.inp"), ("openradioss", "scene_0000.rad")] {
        said(&["impact", "scene.toml", "-o", host, "--deck", host, "--units", "mm-kg-ms"]);
        let deck = std::fs::read_to_string(folder.join(host).join(file)).expect("a deck");
        assert!(deck.contains("mine: lot 12; k_ld = 10 MPa; k_tc = 900 MPa\n") && deck.contains(&left), "{deck}");
    }
}

/// So are those of the friction between fibres.
#[test]
fn a_friction_that_no_test_tells_is_a_guess() {
    let folder = folder("guessed-friction");
    write(&folder, "pull.csv", "strain (%),stress (MPa)\n0.5,404\n1,811\n1.5,1205\n2,1599\n2.5,1990\n3,2363\n");
    write(&folder, "fit.toml", &TENSION.replace("kevlar-km2-600", "kevlar-km2-600-frictional"));
    let output = toron(&folder, &["fit", "fit.toml", "-o", "."]);
    let notes = text(&output.stdout).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(notes.contains("the data say nothing of mu, cohesion: these are guesses, the base preset's"), "{notes}");
    let card = text(&toron(&folder, &["deck", "--host", "abaqus", "--preset", "mine.toml"]).stdout);
    let card = card.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(card.contains("mu, cohesion, density (of kevlar-km2-600-frictional)"), "{card}");
}

/// A guess of a guess is one of where it began; a guess of what the file does not give is none.
#[test]
fn guesses_are_handed_on() {
    let folder = folder("handed-on");
    write(&folder, "pull.csv", "strain (%),stress (MPa)\n1,811\n1.5,1205\n2,1599\n2.5,1990\n3,2363\n");
    write(&folder, "yarns/my-yarn.toml", &format!("{YARN}[guesses]\nk_tc = \"of nylon\"\n"));
    write(&folder, "fit.toml", &TENSION.replace("kevlar-km2-600", "yarns/my-yarn.toml"));
    assert!(toron(&folder, &["fit", "fit.toml", "-o", "."]).status.success());
    let card = text(&toron(&folder, &["deck", "--host", "abaqus", "--preset", "mine.toml"]).stdout);
    assert!(card.contains(": k_tc (of nylon); p, k_td, eps_lim, density (of my-yarn)\n"), "{card}");

    write(&folder, "yarns/my-yarn.toml", &format!("{YARN}[guesses]\nk_ld = \"of nylon\"\n"));
    let output = toron(&folder, &["params", "--preset", "yarns/my-yarn.toml"]);
    let expected =
        "toron: yarns/my-yarn.toml:12: a guess of k_ld, which the file does not give; allowed: a property of it\n";
    assert_eq!((output.status.code(), text(&output.stderr).as_str()), (Some(2), expected));
}

/// What a user may have changed by hand is not lost when a command writes it again: it has another name then, which is
/// said.
#[test]
fn a_file_that_may_have_been_edited_is_kept() {
    let folder = folder("kept");
    write(&folder, "pull.csv", "strain (%),stress (MPa)\n1,811\n1.5,1205\n2,1599\n2.5,1990\n3,2363\n");
    write(&folder, "fit.toml", TENSION);
    let strengths = "units = \"mm-tonne-s\"\n[[strength]]\nname = \"lot\"\nfile = \"lot.csv\"\nlength = 50\n";
    write(&folder, "strengths.toml", strengths);
    write(&folder, "lot.csv", "strength (MPa)\n2900\n3000\n3100\n3150\n3300\n");
    write(&folder, "scene.toml", &scene("law = \"hyperelastic\""));
    let said = |arguments: &[&str]| {
        let output = toron(&folder, arguments);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        text(&output.stderr)
    };
    let read =
        |name: &str| std::fs::read_to_string(folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    for (command, file) in
        [(&["fit", "fit.toml", "-o", "."][..], "mine.toml"), (&["fit", "strengths.toml", "-o", "."], "lot.toml")]
    {
        assert_eq!(said(command), "", "nothing was there");
        assert_eq!(said(command), "", "the same is no loss");
        let edited = read(file) + "# weighed again\n";
        write(&folder, file, &edited);
        let old = format!("{file}-old");
        assert_eq!(said(command), format!("./{file}, as it was before, is now ./{old}\n"));
        assert!(read(&old) == edited && !read(file).contains("weighed"), "{}", read(file));
    }
    for (host, file) in [("ls-dyna", "scene.k"), ("abaqus-explicit", "scene.inp"), ("openradioss", "scene_0000.rad")] {
        let deck = |units: &str| said(&["impact", "scene.toml", "-o", "deck", "--deck", host, "--units", units]);
        assert!(!deck("mm-tonne-s").contains("as it was before"));
        let first = read(&format!("deck/{file}"));
        let said = deck("mm-kg-ms");
        assert!(said.contains(&format!("deck/{file}, as it was before, is now deck/{file}-old\n")), "{said}");
        assert!(read(&format!("deck/{file}-old")) == first && read(&format!("deck/{file}")) != first);
    }
}
