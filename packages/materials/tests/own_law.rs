//! A program for a law of one's own: its load paths against the closed form, its tables, messages and cards.

use std::path::{Path, PathBuf};
use std::process::Command;

use clap::Parser;
use nalgebra::Matrix3;
use reinforced_solid::ReinforcedSolid;
use reinforced_solid::viscoelastic::ViscoelasticSolid;
use serde_json::Value;
use toron::host::laws::LAWS;
use toron::host::units::UnitSystem;
use toron::law::status;
use toron::user::parameters::{Property, STRESS, component, positive};
use toron::user::state::{ALIVE, FAILED};
use toron::user::{Description, Direction, Reads, Real, Response, Step, UserMaterial};
use toron::{Criterion, Request, Rotation};
use toron_materials::deck::interface::Interface;
use toron_materials::eval::own_law::{Entry, evaluate};
use toron_materials::load_path::columns::columns;
use toron_materials::load_path::command::Arguments;
use toron_materials::load_path::path::LoadPath;
use toron_materials::load_path::run::{End, run};
use toron_materials::load_path::table;
use toron_materials::material::laws::{LawName, Laws};
use toron_materials::material::model::{Law, Material, Origin};
use toron_materials::material::own_law::OwnLaw;
use toron_materials::{deck, params};
use toron_test_support::library::{ROOT, share_build};

const MU: f64 = 2.0;
const LAMBDA: f64 = 3.0;
const K: f64 = 50.0;
const LIMIT: f64 = 1.1;

/// 60 increments up to a stretch of 1.2, sides free.
const TENSION: &str = "units = \"mm-tonne-s\"\n[material]\ndensity = 1.1e-9\nfibre = [2, 0, 0]\n[material.properties]\nmu = 2\n\
                       lambda = 3\nk = 50\nstretch_lim = 1.1\n[[step]]\nincrements = 60\nF = { 11 = 1.2 }\nP = { 22 = 0, 33 = 0 }\n";

const SOLID: &str = "name = \"my-solid\"\nsource = \"a test\"\nunits = \"mm-tonne-s\"\ndensity = 1.1e-9\n[properties]\nmu = 2\n\
                     lambda = 3\nk = 50\nstretch_lim = 1.1\n";

fn law() -> &'static OwnLaw {
    Box::leak(Box::new(OwnLaw::new::<ReinforcedSolid>("REINFORCED", 3).expect("a name and a number")))
}

fn laws() -> Laws {
    Laws::Own(law())
}

/// The stretch across of a solid stretched along its fibre, the sides free: μ (t² − 1) + Λ ln(λ t²) = 0.
fn stretch_across(stretch: f64) -> f64 {
    let (mut low, mut high) = (0.5, 1.0);
    for _ in 0..100 {
        let middle: f64 = 0.5 * (low + high);
        let stress = MU * (middle * middle - 1.0) + LAMBDA * (stretch * middle * middle).ln();
        if stress < 0.0 { low = middle } else { high = middle }
    }
    low
}

#[test]
fn tension_to_failure_is_the_closed_form() {
    let path = LoadPath::parse(laws(), "tension.toml", TENSION).expect("the path is valid");
    let histories = run(&path, &|| ());
    let history = &histories[0];
    assert_eq!((&history.end, history.increments.len()), (&End::Completed, 61));
    let material = &history.point.material;
    let names: Vec<String> = columns(material).into_iter().map(|column| column.name).collect();
    let failing = history.failure.expect("it fails");
    for (number, increment) in history.increments.iter().enumerate() {
        let values = table::values(increment, material, &path.element);
        assert_eq!(values.len(), names.len());
        let value = |name: &str| values[names.iter().position(|column| column == name).expect(name)];
        let near = |name: &str, expected: f64, allowed: f64| {
            let found = value(name);
            assert!((found - expected).abs() <= allowed, "{name} at {number}: {found}, not {expected}");
        };
        let stretch = 1.0 + 0.2 * number as f64 / 60.0;
        near("F11", stretch, 1e-15);
        assert_eq!(number >= failing, number >= 30, "it fails at the first increment that reaches the limit {LIMIT}");
        assert_eq!(
            (value("failed"), value("alive")),
            if number >= 30 { (1.0, 0.0) } else { (0.0, 1.0 - value("failed")) }
        );
        if number > failing {
            near("cauchy_11", 0.0, 0.0);
            continue;
        }
        let t = stretch_across(stretch);
        let jacobian = stretch * t * t;
        let elongation = stretch * stretch - 1.0;
        let nominal = (MU * elongation + LAMBDA * jacobian.ln()) / stretch + 2.0 * K * elongation * stretch;
        near("F22", t, 1e-9);
        near("F33", t, 1e-9);
        near("P11", nominal, 1e-9);
        near("P22", 0.0, 1e-9);
        near("fibre_stress", nominal * stretch / jacobian, 1e-9);
        let energy = 0.5 * MU * (elongation + 2.0 * (t * t - 1.0)) - MU * jacobian.ln()
            + 0.5 * LAMBDA * jacobian.ln().powi(2)
            + 0.5 * K * elongation * elongation;
        near("energy", energy, 1e-9);
        near("stored_energy", energy, 1e-9);
        near("stretch", stretch, 1e-14);
        // A wave along the fibre at rest, and faster ones beyond.
        assert!(value("wave_speed") >= ((2.0 * MU + LAMBDA + 4.0 * K) / 1.1e-9).sqrt());
    }
}

fn viscoelastic() -> &'static OwnLaw {
    Box::leak(Box::new(OwnLaw::new::<ViscoelasticSolid>("VISCOELASTIC", 4).expect("a name and a number")))
}

/// σ11 of the viscoelastic solid with μ = 3, Λ = 7, μ₁ = 11, τ = 2.5 at these stretches, a time after a sudden step,
/// half of which counts.
fn relaxed(stretches: [f64; 3], time: f64) -> f64 {
    let j: f64 = stretches.iter().product();
    let growth = stretches[0] * stretches[0] - 1.0;
    (3.0 * growth + 7.0 * j.ln() + 11.0 * growth * (-time / 2.5).exp()) / j
}

#[test]
fn a_load_path_has_the_time_that_its_steps_take() {
    let text = "units = \"mm-tonne-s\"\n[material]\ndensity = 1.1e-9\n[material.properties]\nmu = 3\nlambda = 7\nmu_1 = 11\n\
                tau = 2.5\n[[step]]\nincrements = 1\nduration = 0.01\nF = { 11 = 1.3, 22 = 0.9, 33 = 1.05 }\n\
                [[step]]\nincrements = 20\nduration = 4.0\n";
    let path = LoadPath::parse(Laws::Own(viscoelastic()), "relaxation.toml", text).expect("the path is valid");
    let histories = run(&path, &|| ());
    let increments = &histories[0].increments;
    assert_eq!((&histories[0].end, increments.len()), (&End::Completed, 22));
    for increment in &increments[1..] {
        let expected = relaxed([1.3, 0.9, 1.05], increment.time - 0.005);
        let found = increment.answer.cauchy[0];
        assert!((found - expected).abs() < 1e-13, "at {}: {found}, not {expected}", increment.time);
    }
}

#[test]
fn a_point_has_the_time_that_its_line_says() {
    let ask = |more: &str| {
        let line = format!(
            "{{\"F\": [[1.3, 0, 0], [0, 0.9, 0], [0, 0, 1.05]]{more}, \"params\": {{\"mu\": 3, \"lambda\": 7, \"mu_1\": 11, \"tau\": 2.5}}}}"
        );
        let mut answer = Vec::new();
        evaluate(viscoelastic(), Entry::Block, true, line.as_bytes(), &mut answer).expect("an answer");
        serde_json::from_slice::<Value>(&answer).expect("an answer is JSON")
    };
    let (answer, expected) = (ask(", \"time_increment\": 0.01"), relaxed([1.3, 0.9, 1.05], 0.005));
    let found = answer["sigma"][0].as_f64().expect("a stress");
    assert!((found - expected).abs() < 1e-14, "{answer}");
    let refused = ask("");
    assert_eq!(refused["status"], status::BAD_ARGUMENT);
    assert!(refused["message"].to_string().contains("time_increment is not known here"), "{refused}");
}

/// `examples/own_law/new-law` makes a law under another name in every place.
#[test]
fn a_new_law_is_the_example_under_its_own_name() {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/own_law/new-law");
    let folder = folder("new-law").join("maxwell-yarn");
    let _ = std::fs::remove_dir_all(&folder);
    let run = |arguments: &[&str]| Command::new(script).args(arguments).arg(&folder).output().expect("sh runs");
    for (wrong, message) in [(["Maxwell", "7"], "a small letter first"), (["maxwell", "0"], "allowed: 1 to 99")] {
        let refused = run(&wrong);
        assert_eq!(refused.status.code(), Some(2));
        assert!(String::from_utf8_lossy(&refused.stderr).contains(message), "{refused:?}");
    }
    assert!(run(&["maxwell-yarn", "7"]).status.success());
    for file in [
        "Cargo.toml",
        "header.rs",
        "double/Cargo.toml",
        "double/src/lib.rs",
        "program/Cargo.toml",
        "program/src/main.rs",
    ] {
        let text = std::fs::read_to_string(folder.join(file)).expect(file).to_lowercase();
        assert!(
            !text.contains("reinforced")
                && !text.contains("viscoelastic")
                && !text.contains("plastic")
                && !text.contains("own_law"),
            "{text}"
        );
    }
    let library = std::fs::read_to_string(folder.join("double/src/lib.rs")).expect("the library");
    assert!(library.contains("maxwell_yarn::MaxwellYarn as \"MAXWELL_YARN\", user 7;"), "{library}");
    // With the flags and versions of the example's libraries: what both are built on is compiled once.
    std::fs::copy(Path::new(ROOT).join("examples/own_law/Cargo.lock"), folder.join("Cargo.lock")).expect("a copy");
    let mut cargo = Command::new(env!("CARGO"));
    share_build(&mut cargo);
    cargo.args(["check", "--quiet", "--release", "--package", "maxwell-yarn-double"]);
    let checked = cargo.current_dir(&folder).output().expect("cargo runs");
    assert!(checked.status.success(), "{}", String::from_utf8_lossy(&checked.stderr));
    let header = std::fs::read_to_string(folder.join("maxwell-yarn.h")).expect("the build has written the header");
    assert!(header.contains("int32_t MAXWELL_YARN_prepare_f64("), "{header}");
}

#[test]
fn a_temperature_must_be_read_by_a_law() {
    let error =
        LoadPath::parse(laws(), "tension.toml", &format!("temperature = 293.0\n{TENSION}")).expect_err("refused");
    assert!(error.to_string().contains("temperature is read by none of the laws"), "{error}");
}

#[test]
fn the_files_are_those_of_every_load_path() {
    let folder = folder("files");
    std::fs::write(folder.join("tension.toml"), TENSION).expect("a file can be written");
    let output = folder.join("out");
    let arguments = Arguments { path: Some(folder.join("tension.toml")), output: output.clone() };
    toron_materials::load_path::command::run(laws(), &arguments).expect("it runs");
    let table = std::fs::read_to_string(output.join("increments.csv")).expect("the table");
    let head = "step,cycle,increment,time,F11,F12,F13,F21,F22,F23,F31,F32,F33,cauchy_11,cauchy_22,cauchy_33,cauchy_12,\
                cauchy_23,cauchy_31,P11,P12,P13,P21,P22,P23,P31,P32,P33,energy,stretch,failed,alive,fibre_stress,";
    assert!(table.starts_with(head), "{}", table.lines().next().unwrap_or_default());
    assert_eq!(table.lines().count(), 62);
    for file in ["plot.svg", "plot.png"] {
        assert!(output.join(file).exists(), "{file}");
    }
}

#[test]
fn messages_name_the_law_s_own_properties() {
    for (from, to, message) in [
        ("mu = 2", "mu = -1", ":6: property 1 (mu, shear modulus of the solid) is -1.0; allowed: a number > 0"),
        ("mu = 2\n", "", ":2: property mu (shear modulus of the solid) is missing; allowed: a number > 0"),
        ("k = 50", "k_el = 50", ":8: property \"k_el\"; allowed: mu lambda k stretch_lim m_1 m_2 m_3"),
        ("density", "law = \"hyperelastic\"\ndensity", ":3: law is \"hyperelastic\"; allowed: reinforced"),
        ("density", "preset = \"kevlar-km2-600\"\ndensity", ":3: preset \"kevlar-km2-600\"; allowed: a file NAME.toml"),
        ("density", "frame = \"polar\"\ndensity", ":3: frame and criterion are options of the linear elastic law"),
        ("[2, 0, 0]", "[0, 0, 0]", ":4: properties 5 to 7 (fibre direction)"),
    ] {
        let text = TENSION.replacen(from, to, 1);
        let error = LoadPath::parse(laws(), "path.toml", &text).expect_err(to).to_string();
        assert!(error.starts_with("path.toml:") && error.contains(message), "{message}\n{error}");
    }
    let named = TENSION.replacen("density", "law = \"reinforced\"\ndensity", 1);
    let path = LoadPath::parse(laws(), "path.toml", &named).expect("the law may be named");
    assert_eq!(path.points[0].material.label, "reinforced");
    for (name, number, allowed) in [("Reinforced", 3, "capitals"), ("", 3, "capitals"), ("REINFORCED", 0, "1 to 99")] {
        let refused = OwnLaw::new::<ReinforcedSolid>(name, number).map(|_| ()).expect_err("it is refused");
        assert!(refused.contains(allowed), "{refused}");
    }
}

#[test]
fn the_tables_are_the_law_s() {
    let text = params::tables(laws(), &UnitSystem::parse("mm-tonne-s").expect("a system")).expect("no preset is wrong");
    for part in [
        "Standard reinforcing model: properties\n",
        "state variables, all 0 at the start\n",
        "fibre stretch at failure",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    assert!(!text.contains("k_el") && !text.contains("Preset"), "{text}");
}

/// A folder of this test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("own-law-{name}"));
    std::fs::create_dir_all(&folder).expect("a folder can be made");
    folder
}

#[derive(Parser)]
struct Deck {
    #[command(flatten)]
    arguments: deck::command::Arguments,
}

/// The card of a solid, whose file is in this folder.
fn card(folder: &Path, arguments: &[&str]) -> Result<String, String> {
    card_of(laws(), SOLID, folder, arguments)
}

fn card_of(laws: Laws, preset: &str, folder: &Path, arguments: &[&str]) -> Result<String, String> {
    let file = folder.join("my-solid.toml");
    std::fs::write(&file, preset).expect("a file can be written");
    let file = file.display().to_string();
    let given = ["deck", "--preset", &file].into_iter().chain(arguments.iter().copied());
    let deck = Deck::try_parse_from(given).map_err(|error| error.to_string())?;
    deck::command::card(laws, &deck.arguments).map(|(card, _)| card).map_err(|error| error.to_string())
}

#[test]
fn cards_have_the_law_s_names_and_counts() {
    let folder = folder("cards");
    for (arguments, parts) in [
        (
            &["--host", "abaqus"][..],
            &[
                "*MATERIAL, NAME=REINFORCED-MY-SOLID\n",
                "** mu, lambda, k, stretch_lim, m_1, m_2, m_3\n*USER MATERIAL, CONSTANTS=7\n2.0, 3.0, 5e1, 1.1, 1.0, 0.0, 0.0\n",
                "*DEPVAR, DELETE=4\n4,\n1, ENERGY,",
                "MATERIAL=REINFORCED-MY-SOLID, CONTROLS",
            ][..],
        ),
        (&["--host", "calculix"], &["*MATERIAL, NAME=@OWN_REINFORCED\n", "CONSTANTS=7\n", "*DEPVAR\n4\n"]),
        (&["--host", "openradioss", "--id", "5"], &["/MAT/USER03/5\nmy-solid\n", "stretch_lim", "fibre_from"]),
        (
            &["--host", "mtest"],
            &["@Behaviour<generic> 'libOWN.so' 'REINFORCED';\n", "@MaterialProperty<constant> 'mu' 2.0;"],
        ),
        (
            &["--host", "ls-dyna"],
            &[
                "standard reinforcing model, in mm, tonne, s\n",
                "         k stretch_l       m_1",
                "       m_3      bulk\n",
                "\n         0         1         0         1         0         0\n",
            ],
        ),
    ] {
        let card = card(&folder, arguments).expect("the card");
        for part in parts {
            assert!(card.contains(part), "{part}\n{card}");
        }
    }
    // mid ro mt lmc nhv iortho ibulk ig: nine constants, four state variables, the moduli behind the properties.
    let card = card(&folder, &["--host", "ls-dyna", "--axes"]).expect("the card");
    let numbers: Vec<&str> =
        card.lines().find(|line| line.starts_with("         1")).expect("it").split_whitespace().collect();
    assert_eq!(
        [numbers[0], numbers[2], numbers[3], numbers[4], numbers[6], numbers[7]],
        ["1", "41", "9", "4", "8", "9"]
    );
}

/// A law of two directions that reads the temperature, for its card alone.
#[derive(Clone, Copy, Debug, Default)]
struct Crossed;

static CROSSED: [Property; 7] = [
    positive("mu", "μ", STRESS, None, "shear modulus"),
    component("m_1", "m1", 1.0, "first family"),
    component("m_2", "m2", 0.0, "first family"),
    component("m_3", "m3", 0.0, "first family"),
    component("n_1", "n1", 0.0, "second family"),
    component("n_2", "n2", 1.0, "second family"),
    component("n_3", "n3", 0.0, "second family"),
];

impl UserMaterial for Crossed {
    const DESCRIPTION: Description = Description {
        title: "crossed",
        properties: &CROSSED,
        state: const { &[FAILED, ALIVE] },
        directions: &[Direction::fibre(1), Direction::new("second family", 4)],
        failed: 0,
        alive: 1,
        energies: 0..0,
        reads: Reads { temperature: true, ..Reads::NOTHING },
        lost: None,
        refusal: None,
    };
    type Properties<R: Real> = [R; 7];
    type State<R: Real> = [R; 0];
    type Constants<R: Real> = R;

    fn constants<R: Real>(&[mu, ..]: &[R; 7]) -> R {
        mu
    }

    fn respond<R: Real>(&mu: &R, step: &Step<R, [R; 0]>) -> Response<R, [R; 0]> {
        let pressure = mu * step.log_jacobian();
        let zero = R::splat(0.0);
        Response::new([pressure, pressure, pressure, zero, zero, zero], [])
    }
}

/// In LS-DYNA's material axes every direction of a law has its components along these axes.
#[test]
fn a_card_in_material_axes_turns_all_directions() {
    let folder = folder("crossed");
    let law = Box::leak(Box::new(OwnLaw::new::<Crossed>("CROSSED", 4).expect("a name and a number")));
    let preset = "name = \"my-solid\"\nsource = \"a test\"\nunits = \"mm-tonne-s\"\ndensity = 1.1e-9\n[properties]\nmu = 2\n\
                  m_1 = 0\nm_3 = 2\nn_2 = 3\nn_3 = 3\n";
    let lines = |axes: &[&str]| -> Vec<String> {
        let arguments = [&["--host", "ls-dyna"], axes].concat();
        let card = card_of(Laws::Own(law), preset, &folder, &arguments).expect("the card");
        let numbers = card.lines().filter(|line| !line.starts_with(['$', '*']));
        numbers.map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ")).collect()
    };
    let has = |lines: &[String], start: &str| lines.iter().any(|line| line.starts_with(start));
    assert!(has(&lines(&[]), "2.0 0.0 0.0 2.0 0.0 3.0 3.0 "), "{:?}", lines(&[]));
    // ivect ifail itherm ihyper ieos lmca: LS-DYNA is to tell the temperature.
    assert!(has(&lines(&[]), "0 1 1 1 0 0"), "{:?}", lines(&[]));
    let turned = lines(&["--axes"]);
    // m along the first axis, n with as much along it as along the second.
    assert!(has(&turned, "2.0 1.0 0.0 0.0 3.0 3.0 0.0 "), "{turned:?}");
    assert!(turned.iter().any(|line| line.ends_with("0.0 0.0 2.0")), "the first axis: {turned:?}");
    assert!(turned.iter().any(|line| line.contains("0.0 3.0 3.0 0.0 0")), "in the plane of the first two: {turned:?}");
}

#[test]
fn a_card_s_law_is_the_program_s() {
    let folder = folder("law-of-a-card");
    assert_eq!(
        card(&folder, &["--host", "abaqus", "--law", "hyperelastic"]),
        Err("--law hyperelastic; allowed: reinforced".into())
    );
    assert!(card(&folder, &["--host", "abaqus", "--law", "reinforced"]).is_ok());
}

fn answers(entry: Entry, tangent: bool, input: &str) -> Vec<Value> {
    let mut output = Vec::new();
    evaluate(law(), entry, tangent, input.as_bytes(), &mut output).expect("it reads and writes");
    String::from_utf8(output).expect("text").lines().map(|line| serde_json::from_str(line).expect("JSON")).collect()
}

#[test]
fn points_answer_by_the_names_of_the_law() {
    let f = "\"F\": [[1.05, 0.02, 0], [0, 0.98, 0.01], [0, 0, 1.01]]";
    let params = "\"params\": {\"mu\": 2, \"lambda\": 3, \"k\": 50, \"stretch_lim\": 1.1}";
    let lines = [
        format!("{{{f}, \"m\": [1, 0, 0], {params}}}"),
        format!("{{{f}, {params}}}"),
        format!("{{{f}, \"params\": {{\"mu\": 2, \"k\": 50}}}}"),
        format!("{{{f}, \"params\": {{\"mu\": 2, \"lambda\": 3, \"k\": 50, \"kel\": 1}}}}"),
        format!("{{{f}, \"params\": {{\"mu\": 0, \"lambda\": 3, \"k\": 50}}}}"),
        format!("{{\"F\": [[-1, 0, 0], [0, 1, 0], [0, 0, 1]], {params}}}"),
    ]
    .join("\n");
    let alone = answers(Entry::Law, true, &lines);
    assert_eq!(alone[0], alone[1], "the fibre is the first axis without m");
    let (stretch, jacobian): (f64, f64) = (1.05, 1.05 * 0.98 * 1.01);
    let sigma_33 = (MU * (1.01 * 1.01 - 1.0) + LAMBDA * jacobian.ln()) / jacobian;
    let number = |value: &Value| value.as_f64().expect("a number");
    assert!((number(&alone[0]["sigma"][2]) - sigma_33).abs() < 1e-14);
    assert!((number(&alone[0]["stretch"]) - stretch).abs() < 1e-15);
    assert_eq!((&alone[0]["failed"], &alone[0]["status"]), (&Value::Bool(false), &Value::from(0)));
    assert_eq!(alone[0]["ddsdde"].as_array().map(Vec::len), Some(6));
    for (answer, message) in alone[2..].iter().zip([
        "line 3: \"params\" lacks lambda (first Lamé constant of the solid); allowed: a number from 0 to 1e25",
        "line 4: \"params\" has the key \"kel\"; allowed: mu, lambda, k, stretch_lim, m_1, m_2, m_3",
        "property 1 (mu, shear modulus of the solid) is 0.0; allowed: a number > 0, at most 1e25",
        "",
    ]) {
        assert!(answer["status"].as_i64() < Some(0), "{answer}");
        assert!(answer["message"].as_str().expect("a message").contains(message), "{answer}");
    }
    assert_eq!(answers(Entry::Block, true, &lines), alone, "a point amid others answers as alone");
}

#[test]
fn the_header_is_that_of_the_example() {
    let committed = include_str!("../../../examples/own_law/reinforced.h");
    assert_eq!((law().header)(law().symbol), committed);
}

/// A law of the library that the program knows by its description alone: the same names in solvers, the same load path.
#[test]
fn a_law_of_the_library_needs_no_more_than_its_description() {
    let by_description = OwnLaw::of_library::<toron::LinearElastic>(&LAWS[1]);
    let by_description = LawName::Own(Box::leak(Box::new(by_description)));
    let known = Laws::Toron.find("linear-elastic").expect("a law");
    assert_eq!(Laws::Toron.names().len(), LAWS.len());
    assert_eq!(by_description.text(), known.text());
    assert_eq!(format!("{:?}", Interface::of(by_description)), format!("{:?}", Interface::of(known)));
    let values = [80e3, 800.0, 126.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let [first, second] = [by_description, known].map(|name| {
        let law = Law::new(name, &values, Rotation::Fibre, Criterion::LargestPrincipal).expect("right properties");
        let origin = Origin::default();
        let material =
            Material { law, density: None, label: String::new(), own: String::new(), origin, temperature: None };
        let f = Matrix3::new(1.01, 0.1, 0.0, 0.0, 0.97, 0.02, 0.0, 0.0, 1.03);
        material.evaluate(&f, 0.0, &material.at_rest(), Request::STRESS_AND_STATE).expect("a point").cauchy
    });
    for (first, second) in first.iter().zip(second) {
        assert!((first - second).abs() <= 1e-12 * 80e3, "{first}, not {second}");
    }
}
