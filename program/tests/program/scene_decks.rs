//! The decks of a struck panel for three solvers, read back: nodes, volumes, masses and the fibre's direction in every
//! element by each solver's own rule. None of the solvers is run here.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;

use nalgebra::{Matrix3, Vector3};

use toron_explicit_host::judgement::warnings as warnings_of;
use toron_strikes::fabric;

use toron_test_support::library::{ROOT, folder, run};
use toron_test_support::python;
use toron_test_support::update::is_asked;

const SCENE: &str = "title = \"A small panel\"\nunits = \"mm-g-ms\"\n[weave]\npreset = \"kevlar-s706\"\nalong = 4\ncolumns = 4\n\
    [weave.panel]\nshape = \"circle\"\nradius = 4.0\npart = \"quarter\"\n[scene]\nspeed = 142.0\nmass = 0.692\nradius = 2.778\n\
    contact-stiffness = 1e5\nend = 0.02\n";
const FIRST: usize = 1001;
/// Kevlar, in g/mm³.
const DENSITY: f64 = 1.3514e-3;

/// What a deck says of the mesh.
#[derive(Debug, Default)]
struct Mesh {
    nodes: BTreeMap<usize, Vector3<f64>>,
    elements: BTreeMap<usize, [usize; 8]>,
    fibre: BTreeMap<usize, Vector3<f64>>,
}

impl Mesh {
    fn corners(&self, element: usize) -> [Vector3<f64>; 8] {
        self.elements[&element].map(|node| self.nodes[&node])
    }

    /// The volume of an element by eight points.
    fn volume(&self, element: usize) -> f64 {
        let corners = self.corners(element);
        let at = 1.0 / 3.0_f64.sqrt();
        let signs = |i: usize| {
            // Corners go round the section, then round the next one.
            let [a, b] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]][i % 4];
            [a, b, if i < 4 { -1.0 } else { 1.0 }]
        };
        let determinant = |point: [f64; 3]| {
            let mut jacobian = Matrix3::zeros();
            for (i, corner) in corners.iter().enumerate() {
                let s = signs(i);
                let f = [0, 1, 2].map(|k| 1.0 + s[k] * point[k]);
                for k in 0..3 {
                    let slope = 0.125 * s[k] * f[(k + 1) % 3] * f[(k + 2) % 3];
                    jacobian.set_column(k, &(jacobian.column(k) + corner * slope));
                }
            }
            jacobian.determinant()
        };
        (0..8).map(|i| determinant(signs(i).map(|s| s * at))).sum()
    }
}

fn fields(line: &str, width: usize) -> Vec<&str> {
    line.as_bytes().chunks(width).map(|field| std::str::from_utf8(field).expect("ASCII").trim()).collect()
}

fn numbers(fields: &[&str]) -> Vec<f64> {
    fields.iter().map(|field| field.parse().expect("a number")).collect()
}

/// The lines of a file by the keyword that they stand behind, without comments.
fn blocks(path: &Path, comment: &str, keyword: char) -> Vec<(String, Vec<String>)> {
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut blocks: Vec<(String, Vec<String>)> = Vec::new();
    for line in text.lines().filter(|line| !line.starts_with(comment)) {
        match (line.starts_with(keyword), blocks.last_mut()) {
            (true, _) => blocks.push((line.to_string(), Vec::new())),
            (false, Some((_, lines))) => lines.push(line.to_string()),
            (false, None) => {}
        }
    }
    blocks
}

fn element(values: &[usize]) -> [usize; 8] {
    values.try_into().expect("eight nodes")
}

fn openradioss(folder: &Path) -> Mesh {
    let mut mesh = Mesh::default();
    for (keyword, lines) in blocks(&folder.join("scene_mesh.inc"), "#", '/') {
        for line in &lines {
            if keyword == "/NODE" {
                let (number, place) = line.split_at(10);
                let place = numbers(&fields(place, 20));
                mesh.nodes.insert(number.trim().parse().expect("a number"), Vector3::from_column_slice(&place));
            } else if keyword.starts_with("/BRICK/") {
                let values: Vec<usize> = fields(line, 10).iter().map(|x| x.parse().expect("a number")).collect();
                mesh.elements.insert(values[0], element(&values[1..]));
            }
        }
    }
    // fibre_from = 1: from the middle of nodes 1 to 4 to that of 5 to 8.
    let elements: Vec<usize> = mesh.elements.keys().copied().collect();
    for number in elements {
        let c = mesh.corners(number);
        let way = (c[4] + c[5] + c[6] + c[7]) - (c[0] + c[1] + c[2] + c[3]);
        mesh.fibre.insert(number, way.normalize());
    }
    mesh
}

fn ls_dyna(folder: &Path) -> Mesh {
    let mut mesh = Mesh::default();
    for (keyword, lines) in blocks(&folder.join("scene-mesh.k"), "$", '*') {
        if keyword == "*NODE" {
            for line in &lines {
                let place = numbers(&fields(&line[8..56], 16));
                mesh.nodes.insert(line[..8].trim().parse().expect("a number"), Vector3::from_column_slice(&place));
            }
        } else if keyword == "*ELEMENT_SOLID_ORTHO" {
            for lines in lines.chunks(3) {
                let values: Vec<usize> = fields(&lines[0], 8).iter().map(|x| x.parse().expect("a number")).collect();
                mesh.elements.insert(values[0], element(&values[2..]));
                mesh.fibre.insert(values[0], Vector3::from_column_slice(&numbers(&fields(&lines[1], 16))));
            }
        }
    }
    mesh
}

fn abaqus(folder: &Path) -> Mesh {
    let mut mesh = Mesh::default();
    for (keyword, lines) in blocks(&folder.join("scene-mesh.inp"), "**", '*') {
        for line in &lines {
            let values: Vec<&str> = line.split(',').map(str::trim).filter(|value| !value.is_empty()).collect();
            let whole = || -> Vec<usize> { values.iter().map(|x| x.parse().expect("a number")).collect() };
            if keyword.starts_with("*NODE,") {
                let place = numbers(&values[1..]);
                mesh.nodes.insert(values[0].parse().expect("a number"), Vector3::from_column_slice(&place));
            } else if keyword.starts_with("*ELEMENT, TYPE=C3D8R") {
                mesh.elements.insert(whole()[0], element(&whole()[1..]));
            } else if keyword.starts_with("*ELEMENT, TYPE=C3D6") {
                // A triangle and the next one, as a hexahedron whose last edge is a point.
                let [i, a, b, c, d, e, f] = whole().try_into().expect("six nodes");
                mesh.elements.insert(i, [a, b, c, c, d, e, f, f]);
            } else if keyword.starts_with("*DISTRIBUTION,") && values.len() == 7 {
                let number = values[0].parse().expect("a number");
                mesh.fibre.insert(number, Vector3::from_column_slice(&numbers(&values[1..4])));
            }
        }
    }
    mesh
}

#[test]
fn three_solvers_get_the_same_panel() {
    let output = folder("scene-decks");
    let scene = output.join("scene.toml");
    std::fs::write(&scene, SCENE).expect("the scene can be written");
    let meshes = ["openradioss", "ls-dyna", "abaqus-explicit"].map(|host| {
        let to = output.join(host);
        let mut toron = Command::new(env!("CARGO_BIN_EXE_toron"));
        toron.arg("fabric").arg(&scene).args(["--deck", host, "--first-id", &FIRST.to_string(), "-o"]);
        let said = String::from_utf8(run(toron.arg(&to).current_dir(ROOT), "").stdout).expect("a text");
        let mesh = match host {
            "openradioss" => openradioss(&to),
            "ls-dyna" => ls_dyna(&to),
            _ => abaqus(&to),
        };
        let mass: f64 = mesh.elements.keys().map(|&element| DENSITY * mesh.volume(element)).sum();
        let (before, _) = said.split_once(" g:").expect("the mass");
        let printed: f64 = before.rsplit(' ').next().and_then(|mass| mass.parse().ok()).expect("a number");
        assert!((mass / printed - 1.0).abs() < 1e-3, "{host}: {mass} g, {printed} printed");
        let least = mesh.elements.keys().map(|&element| mesh.volume(element)).fold(f64::INFINITY, f64::min);
        assert!(least > 0.0, "{host}: an element is inverted");
        assert_eq!(mesh.elements.len(), mesh.fibre.len(), "{host}: a direction for every element");
        assert_eq!(mesh.elements.keys().next(), Some(&FIRST), "{host}: --first-id");
        mesh
    });
    let [openradioss, others @ ..] = &meshes;
    for (mesh, host) in others.iter().zip(["ls-dyna", "abaqus-explicit"]) {
        assert_eq!(mesh.elements.len(), openradioss.elements.len());
        for (number, fibre) in &mesh.fibre {
            assert!((fibre.norm() - 1.0).abs() < 1e-9, "{host}: {fibre}");
            let [ours, theirs] =
                [openradioss, mesh].map(|mesh| mesh.corners(*number).iter().sum::<Vector3<f64>>() / 8.0);
            let volumes = [openradioss, mesh].map(|mesh| mesh.volume(*number));
            assert!((ours - theirs).norm() < 1e-9, "{host}: element {number} is elsewhere");
            assert!((volumes[0] / volumes[1] - 1.0).abs() < 1e-6, "{host}: element {number} has another volume");
            // The direction by the nodes is that of the element's middle line.
            let angle = fibre.angle(&openradioss.fibre[number]).to_degrees();
            assert!(angle < 1.0, "{host}: the fibre of element {number} is {angle}° off");
        }
    }
}

#[test]
fn openradioss_takes_the_fibre_as_initial_values() {
    let output = folder("scene-decks-fibres");
    let scene = output.join("scene.toml");
    std::fs::write(&scene, SCENE).expect("the scene can be written");
    for (host, more) in [("abaqus-explicit", &[][..]), ("openradioss", &["--fibre-from", "initial-values"])] {
        let mut toron = Command::new(env!("CARGO_BIN_EXE_toron"));
        toron.arg("fabric").arg(&scene).args(["--deck", host]).args(more).arg("-o").arg(output.join(host));
        run(&mut toron, "");
    }
    let main = std::fs::read_to_string(output.join("openradioss/scene_0000.rad")).expect("a deck");
    let values = main.lines().skip_while(|line| !line.ends_with("          fibre_from")).nth(1);
    assert_eq!(values.map(|line| numbers(&fields(line, 20))), Some(vec![0.0, 2.0]));
    let fibre = abaqus(&output.join("abaqus-explicit")).fibre;
    let blocks = blocks(&output.join("openradioss/scene_mesh.inc"), "#", '/');
    let (_, lines) = blocks.iter().find(|(keyword, _)| keyword == "/INIBRI/AUX").expect("initial values");
    // A line for the element, and 14 values in lines of three: the law's eleven, which are 0, and the fibre.
    assert_eq!(lines.len(), 6 * fibre.len());
    for lines in lines.chunks(6) {
        let head: Vec<&str> = fields(&lines[0], 10);
        assert_eq!((head[1], head[6]), ("1", "14"), "{}", lines[0]);
        let values: Vec<f64> = lines[1..].iter().flat_map(|line| numbers(&fields(line, 20))).collect();
        assert!(values.len() == 14 && values[..11].iter().all(|value| *value == 0.0), "{values:?}");
        let wanted = fibre[&head[0].parse().expect("a number")];
        assert!((Vector3::from_column_slice(&values[11..]) - wanted).norm() < 1e-9, "{}: {wanted}", head[0]);
    }
    let mut toron = Command::new(env!("CARGO_BIN_EXE_toron"));
    toron.arg("fabric").arg(&scene).args(["--deck", "ls-dyna", "--fibre-from", "nodes", "-o"]).arg(&output);
    let refused = toron.output().expect("it runs");
    let said = String::from_utf8_lossy(&refused.stderr);
    assert!(said.contains("--fibre-from is for --deck openradioss only"), "{said}");
}

/// The committed decks of a patch are what the command in their headers writes.
#[test]
fn the_patch_s_decks_are_current() {
    let scene = "examples/fabric_impact/patch.toml";
    for host in ["openradioss", "ls-dyna", "abaqus-explicit"] {
        let committed = Path::new(ROOT).join("examples/fabric_impact/patch").join(host);
        let to = if is_asked("decks") { committed.clone() } else { folder(&format!("scene-decks-patch-{host}")) };
        let names = |folder: &Path| -> BTreeSet<_> {
            std::fs::read_dir(folder).expect("a folder").map(|file| file.expect("a file").file_name()).collect()
        };
        // Decks that were there with other contents would be kept beside the new ones.
        names(&to).iter().for_each(|name| std::fs::remove_file(to.join(name)).expect("an old deck"));
        let mut toron = Command::new(env!("CARGO_BIN_EXE_toron"));
        toron.args(["fabric", scene, "--deck", host, "--units", "mm-tonne-s", "-o"]).arg(&to).current_dir(ROOT);
        run(&mut toron, "");
        // Whose they are is nobody's business who copies them.
        std::fs::remove_file(to.join("toron.lock")).expect("the deck has an owner");
        assert_eq!(names(&committed), names(&to), "{host}");
        for name in names(&to) {
            let [old, new] = [&committed, &to].map(|folder| std::fs::read(folder.join(&name)).expect("a deck"));
            assert!(old == new, "{host}: {name:?} is not current: cargo xtask update decks");
        }
    }
}

#[test]
fn meshio_reads_the_meshes() {
    let output = folder("scene-decks-meshio");
    let scene = output.join("scene.toml");
    std::fs::write(&scene, SCENE).expect("the scene can be written");
    let (panel, _) = SCENE.split_once("[scene]").expect("a panel");
    std::fs::write(output.join("weave.toml"), panel).expect("the weave can be written");
    let toron = || Command::new(env!("CARGO_BIN_EXE_toron"));
    run(toron().arg("fabric").arg(&scene).args(["--deck", "abaqus-explicit", "-o"]).arg(&output), "");
    run(toron().arg("weave").arg(output.join("weave.toml")).arg("-o").arg(&output), "");
    let folder = Path::new(ROOT).join("ffi-tests/meshio");
    let mut script = Command::new(python::environment(&folder));
    let files = ["scene-mesh.inp", "weave.vtu"].map(|name| output.join(name));
    let said =
        String::from_utf8(run(script.arg(folder.join("meshes.py")).args(files), "python3").stdout).expect("text");
    let lines: Vec<Vec<&str>> = said.lines().map(|line| line.split(' ').collect()).collect();
    let [deck, vtu] = &lines[..] else { panic!("two lines: {said}") };
    // Points, hexahedra, volume and centre, against our own reader of the deck; then the sets.
    let mesh = abaqus(&output);
    let volume: f64 = mesh.elements.keys().map(|&element| mesh.volume(element)).sum();
    assert_eq!((deck[0], deck[1]), (mesh.nodes.len().to_string().as_str(), mesh.elements.len().to_string().as_str()));
    assert!((deck[2].parse::<f64>().expect("a volume") / volume - 1.0).abs() < 1e-3, "{said}");
    for (i, value) in vtu[..6].iter().enumerate() {
        let [value, other]: [f64; 2] = [value, deck[i]].map(|value| value.parse().expect("a number"));
        assert!((value - other).abs() <= 1e-6 * other.abs().max(1e-3), "{i}: {said}");
    }
    let sets = deck[6..].join(" ");
    assert!(["ON-X-0:", "ON-Y-0:", "RIM:", "DEFLECTION:1"].iter().all(|name| sets.contains(name)), "{said}");
}

/// Quadrangles of the striker, and the materials of the parts by their names.
fn striker_and_parts(host: &str, folder: &Path, case: &str) -> (Vec<[Vector3<f64>; 4]>, BTreeMap<String, String>) {
    let (mesh, main, comment, keyword) = match host {
        "openradioss" => (format!("{case}_mesh.inc"), format!("{case}_0000.rad"), "#", '/'),
        "ls-dyna" => (format!("{case}-mesh.k"), format!("{case}.k"), "$", '*'),
        _ => (format!("{case}-striker.inp"), format!("{case}.inp"), "**", '*'),
    };
    let split = |line: &str, width: usize| -> Vec<String> {
        if host == "abaqus-explicit" {
            return line.split(',').map(|x| x.trim().to_string()).filter(|x| !x.is_empty()).collect();
        }
        fields(line, width).into_iter().map(str::to_string).collect()
    };
    let (mut nodes, mut faces, mut parts) = (BTreeMap::new(), Vec::new(), BTreeMap::new());
    for (keyword, lines) in blocks(&folder.join(mesh), comment, keyword) {
        for line in &lines {
            if keyword.starts_with("*NODE") || keyword == "/NODE" {
                let (number, place) = match host {
                    "openradioss" => (line[..10].to_string(), split(&line[10..], 20)),
                    "ls-dyna" => (line[..8].to_string(), split(&line[8..56], 16)),
                    _ => (split(line, 0)[0].clone(), split(line, 0)[1..].to_vec()),
                };
                let place: Vec<f64> = place.iter().map(|x| x.parse().expect("a number")).collect();
                nodes.insert(number.trim().parse::<usize>().expect("a number"), Vector3::from_column_slice(&place));
            } else if ["/SHELL", "*ELEMENT_SHELL", "*ELEMENT, TYPE=R3D4"].iter().any(|name| keyword.starts_with(name)) {
                let values = split(line, if host == "ls-dyna" { 8 } else { 10 });
                let corners: Vec<usize> =
                    values[values.len() - 4..].iter().map(|x| x.parse().expect("a number")).collect();
                faces.push(corners);
            }
        }
    }
    for (keyword, lines) in blocks(&folder.join(main), comment, keyword) {
        if keyword.starts_with("/PART/") {
            parts.insert(lines[0].clone(), split(&lines[1], 10)[1].clone());
        } else if keyword == "*PART" {
            parts.insert(lines[0].clone(), split(&lines[1], 10)[2].clone());
        } else if let Some(section) = keyword.strip_prefix("*SOLID SECTION, ELSET=") {
            let (part, material) = section.split_once(", MATERIAL=").expect("a material");
            parts.insert(part.to_lowercase(), material.split(',').next().expect("a name").to_string());
        }
    }
    let corners = |face: &Vec<usize>| [0, 1, 2, 3].map(|i| nodes[&face[i]]);
    (faces.iter().map(corners).collect(), parts)
}

#[test]
fn decks_have_cylinders_and_yarns_of_two_materials() {
    let output = folder("scene-decks-cylinders");
    let scene = output.join("scene.toml");
    let cases = "[[case]]\nname = \"flat\"\nshape = \"flat\"\n[[case]]\nname = \"hemisphere\"\nshape = \"hemisphere\"\n\
        [[case]]\nname = \"weft\"\nweave.weft.material = { properties = { k_el = 41170.5 } }\n";
    std::fs::write(&scene, format!("{SCENE}{cases}")).expect("the scene can be written");
    for host in ["openradioss", "ls-dyna", "abaqus-explicit"] {
        let to = output.join(host);
        run(
            Command::new(env!("CARGO_BIN_EXE_toron")).arg("fabric").arg(&scene).args(["--deck", host, "-o"]).arg(&to),
            "",
        );
        let [flat, hemisphere] = ["flat", "hemisphere"].map(|case| striker_and_parts(host, &to, case).0);
        let area = |face: &[Vector3<f64>; 4]| 0.5 * (face[2] - face[0]).cross(&(face[3] - face[1]));
        // Each end covers a disc, seen along its axis, and looks down.
        for (faces, what) in [(&flat, "flat"), (&hemisphere, "hemisphere")] {
            let low = faces.iter().flatten().map(|corner| corner.z).fold(f64::INFINITY, f64::min);
            let end = faces.iter().flatten().map(|corner| corner.x.hypot(corner.y)).fold(0.0, f64::max);
            let seen: f64 = -faces.iter().map(|face| area(face).z).sum::<f64>();
            assert!((seen / (std::f64::consts::PI * end * end) - 1.0).abs() < 2e-3, "{host}: {what}: {seen}");
            assert!((2.74..2.779).contains(&end), "{host}: {what}: {end}");
            let at_end = faces.iter().filter(|face| face.iter().all(|corner| corner.z < low + 1e-9));
            let share = at_end.map(|face| -area(face).z).sum::<f64>() / seen;
            assert!((share > 0.999) == (what == "flat"), "{host}: {what}: {share} lies at the end");
        }
        let (_, parts) = striker_and_parts(host, &to, "weft");
        let material = |family: &str| -> Vec<&String> {
            parts.iter().filter(|(name, _)| name.starts_with(family)).map(|(_, material)| material).collect()
        };
        let (warp, weft) = (material("warp"), material("weft"));
        assert!(warp.len() > 3 && weft.len() > 3 && warp[0] != weft[0], "{host}: {parts:?}");
        assert!(warp.iter().all(|other| *other == warp[0]) && weft.iter().all(|other| *other == weft[0]), "{host}");
    }
}

/// A deck is where nothing else looks for slips: it says what a run, or the mesh alone, would say of the same scene.
#[test]
fn a_deck_says_what_is_wrong_with_its_scene() {
    let output = folder("scene-decks-slips");
    let tutorial = "units = \"mm-g-ms\"\n[weave]\npattern = \"plain\"\nwarp = { pitch = 1.18, width = 0.95, height = 0.128 }\n\
        along = 4\ncolumns = 4\n[weave.panel]\nshape = \"circle\"\nradius = 2.0\n";
    let strike = "[scene]\nspeed = 0.06\nmass = 0.692\nradius = 5.556\ncontact-stiffness = 1e2\nend = 1.0\n\
        hyperelastic.density = 1.3514\n[[case]]\nname = \"a\"\n[[case]]\nname = \"b\"\nhyperelastic.density = 1.3514e-3\n";
    let yarn = "units = \"mm-g-ms\"\n[scene]\nhalf-length = 1.0\nheight = 11.5\nwidth = 53.37\nlayers = 8\nrows = 2\ncolumns = 4\n\
        mass = 9.91e-3\nradius = 1.1\ncontact-stiffness = 1e6\nspeed = 120.0\nend = 0.01\n";
    let material = "[material]\npreset = \"kevlar-km2-600\"\nproperties = { k_ld = 126.0 }\ndensity = 1.3514\n";
    let known = "warning: case b: with along = 4 and columns = 4 the yarns";
    for (command, text, weights, warnings) in [
        (
            "fabric",
            format!("{tutorial}{strike}"),
            "Weights of b: sphere 963.2 kg/m³; panel ",
            &[known, "warning: case a: "][..],
        ),
        ("impact", yarn.to_string(), "Weights of scene: ", &["warning: case scene: a yarn has "]),
        (
            "weave",
            format!("{tutorial}{material}"),
            "Weights of weave: panel ",
            &["warning: with along", "warning: the panel weighs"],
        ),
    ] {
        let scene = output.join(format!("{command}.toml"));
        std::fs::write(&scene, text).expect("the scene can be written");
        let mut toron = Command::new(env!("CARGO_BIN_EXE_toron"));
        let deck = toron.arg(command).arg(&scene).args(["--deck", "ls-dyna", "-o"]).arg(output.join(command));
        let answer = run(deck, "");
        let [said, log] = [answer.stdout, answer.stderr].map(|text| String::from_utf8(text).expect("a text"));
        let place = said.find(weights).expect(&said);
        assert!(said[place..].contains(" elements, "), "the weights stand before the files: {said}");
        assert!(warnings.iter().all(|warning| log.contains(warning)), "{log}");
        if command == "fabric" {
            let scene = fabric::scene::Scene::read(&scene).expect("a scene");
            for case in &scene.cases {
                let found = fabric::judgement::before(&scene.units, case, &case.cloth.model());
                assert!(
                    ["units", "sizes", "striker", "crimp"].iter().all(|word| found.iter().any(|f| f.name == *word))
                );
                assert!(log.contains(&warnings_of([(case.name.as_str(), &found[..])])), "{log}");
            }
        }
    }
}

#[test]
fn a_deck_and_a_restart_exclude_each_other() {
    for command in ["fabric", "impact"] {
        let mut toron = Command::new(env!("CARGO_BIN_EXE_toron"));
        let output = toron.args([command, "scene.toml", "--deck", "ls-dyna", "--restart"]).output().expect("it runs");
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(2) && said.contains("cannot be used with"), "{said}");
    }
}

/// What a deck says besides its mesh.
#[derive(Debug, PartialEq)]
struct Said {
    /// The nodes that are held, by the axes along which they are.
    held: Vec<(BTreeSet<usize>, [bool; 3])>,
    /// The constants of each material of the yarns, and its density.
    constants: Vec<(Vec<f64>, f64)>,
    /// Friction of the striker and of the yarns.
    friction: [f64; 2],
    speed: f64,
    end: f64,
}

fn whole(text: &str) -> usize {
    text.trim().parse().unwrap_or_else(|_| panic!("{text:?} is a number"))
}

fn of_openradioss(folder: &Path) -> Said {
    let mut sets = BTreeMap::new();
    for (keyword, lines) in blocks(&folder.join("scene_mesh.inc"), "#", '/') {
        if let Some(number) = keyword.strip_prefix("/GRNOD/NODE/") {
            sets.insert(whole(number), lines[1..].iter().flat_map(|line| fields(line, 10)).map(whole).collect());
        }
    }
    let mut said = Said { held: Vec::new(), constants: Vec::new(), friction: [0.0; 2], speed: 0.0, end: 0.0 };
    let mut contacts = Vec::new();
    for (keyword, lines) in blocks(&folder.join("scene_0000.rad"), "#", '/') {
        let row = |line: usize| numbers(&fields(&lines[line], 20));
        if keyword.starts_with("/BCS/") && lines[0] != "striker" {
            let fields = fields(&lines[1], 10);
            let axis = |i: usize| fields[0].as_bytes()[i] == b'1';
            said.held.push((BTreeSet::clone(&sets[&whole(fields[2])]), [axis(0), axis(1), axis(2)]));
        } else if keyword.starts_with("/MAT/USER01/") {
            let constants = [row(2), row(3), row(4)[..1].to_vec()].concat();
            said.constants.push((constants, row(1)[0]));
        } else if keyword.starts_with("/INTER/TYPE7/") {
            contacts.push((
                lines[0].clone(),
                fields(&lines[1], 10)[..2].iter().map(|x| whole(x)).collect::<Vec<_>>(),
                row(4),
            ));
        } else if keyword.starts_with("/INIVEL/TRA/") {
            let velocity = numbers(&[&lines[1][..20], &lines[1][20..40], &lines[1][40..60]].map(str::trim));
            assert_eq!(velocity[..2], [0.0; 2]);
            said.speed = -velocity[2];
        }
    }
    let [striker, yarns] = &contacts[..] else { panic!("{contacts:?}") };
    // The yarns' nodes on the striker, and the same nodes on the yarns' faces, with the clearance for a gap.
    assert_eq!((striker.0.as_str(), yarns.0.as_str()), ("striker", "yarns"));
    assert!(striker.1[0] == yarns.1[0] && striker.1[1] != yarns.1[1], "{contacts:?}");
    assert_eq!(yarns.2[2], 1e-3);
    said.friction = [striker.2[1], yarns.2[1]];
    let engine = blocks(&folder.join("scene_0001.rad"), "#", '/');
    let run = engine.iter().find(|(keyword, _)| keyword.starts_with("/RUN/")).expect("an end");
    said.end = run.1[0].trim().parse().expect("a time");
    said
}

fn of_ls_dyna(folder: &Path) -> Said {
    let mut sets = BTreeMap::new();
    for (keyword, lines) in blocks(&folder.join("scene-mesh.k"), "$", '*') {
        if keyword == "*SET_NODE_LIST_TITLE" {
            let nodes = lines[2..].iter().flat_map(|line| fields(line, 10)).map(whole).filter(|&node| node > 0);
            sets.insert(whole(fields(&lines[1], 10)[0]), nodes.collect());
        }
    }
    let mut said = Said { held: Vec::new(), constants: Vec::new(), friction: [0.0; 2], speed: 0.0, end: 0.0 };
    for (keyword, lines) in blocks(&folder.join("scene.k"), "$", '*') {
        let row = |line: usize| numbers(&fields(&lines[line], 10));
        match keyword.as_str() {
            "*BOUNDARY_SPC_SET" => {
                let values = row(0);
                said.held.push((BTreeSet::clone(&sets[&(values[0] as usize)]), [2, 3, 4].map(|i| values[i] == 1.0)));
            }
            "*MAT_USER_DEFINED_MATERIAL_MODELS_TITLE" => {
                said.constants.push(([row(5), row(6)[..3].to_vec()].concat(), row(1)[1]));
            }
            "*CONTACT_ERODING_NODES_TO_SURFACE_ID" => said.friction[0] = row(2)[0],
            "*CONTACT_ERODING_SINGLE_SURFACE_ID" => said.friction[1] = row(2)[0],
            "*INITIAL_VELOCITY_RIGID_BODY" => said.speed = -row(0)[3],
            "*CONTROL_TERMINATION" => said.end = row(0)[0],
            _ => {}
        }
    }
    said
}

fn of_abaqus(folder: &Path) -> Said {
    let values = |line: &String| -> Vec<String> {
        line.split(',').map(|value| value.trim().to_string()).filter(|value| !value.is_empty()).collect()
    };
    let reals = |lines: &[String]| -> Vec<f64> {
        lines.iter().flat_map(values).map(|value| value.parse().expect("a number")).collect()
    };
    let mut sets: BTreeMap<String, BTreeSet<usize>> = BTreeMap::new();
    for (keyword, lines) in blocks(&folder.join("scene-mesh.inp"), "**", '*') {
        if let Some(name) = keyword.strip_prefix("*NSET, NSET=") {
            sets.insert(name.to_string(), lines.iter().flat_map(values).map(|node| whole(&node)).collect());
        }
    }
    let mut said = Said { held: Vec::new(), constants: Vec::new(), friction: [0.0; 2], speed: 0.0, end: 0.0 };
    let (mut interaction, mut density) = (String::new(), 0.0);
    let mut held: BTreeMap<String, [bool; 3]> = BTreeMap::new();
    for (keyword, lines) in blocks(&folder.join("scene.inp"), "**", '*') {
        if keyword == "*BOUNDARY" {
            for line in lines.iter().map(values).filter(|line| line[0] != "STRIKER") {
                let axes = held.entry(line[0].clone()).or_default();
                (whole(&line[1])..=whole(&line[2])).for_each(|axis| axes[axis - 1] = true);
            }
        } else if keyword == "*DENSITY" {
            density = reals(&lines)[0];
        } else if keyword.starts_with("*USER MATERIAL") {
            said.constants.push((reals(&lines), density));
        } else if let Some(name) = keyword.strip_prefix("*SURFACE INTERACTION, NAME=") {
            interaction = name.to_string();
        } else if keyword == "*FRICTION" {
            said.friction[usize::from(interaction == "ON-YARNS")] = reals(&lines)[0];
        } else if keyword.starts_with("*INITIAL CONDITIONS, TYPE=VELOCITY") {
            said.speed = -values(&lines[0])[2].parse::<f64>().expect("a speed");
        } else if keyword.starts_with("*DYNAMIC, EXPLICIT") {
            said.end = reals(&lines)[0];
        } else if keyword == "*CONTACT INCLUSIONS" || keyword == "*CONTACT PROPERTY ASSIGNMENT" {
            let pairs: Vec<String> = lines.iter().map(|line| values(line)[..2].join(" ")).collect();
            assert_eq!(pairs, ["YARN-FACES STRIKER-SURFACE", "YARN-FACES YARN-FACES"]);
        }
    }
    said.held = held.into_iter().map(|(name, axes)| (sets[&name].clone(), axes)).collect();
    said
}

/// Two plies, the lower one of another material: supports, constants, contact and motion in each deck.
#[test]
fn decks_of_plies_say_what_the_scene_says() {
    let output = folder("scene-decks-plies");
    let scene = output.join("scene.toml");
    let plies = "failure = \"uniaxial\"\nfriction = 0.21\nyarn-friction = 0.17\n[[ply]]\n[[ply]]\nangle = 90\nmaterial = { properties = { k_el = 41170.5, k_ld = 5.0 } }\n";
    std::fs::write(&scene, format!("{SCENE}{plies}")).expect("the scene can be written");
    for host in ["openradioss", "ls-dyna", "abaqus-explicit"] {
        let to = output.join(host);
        let mut toron = Command::new(env!("CARGO_BIN_EXE_toron"));
        run(toron.arg("fabric").arg(&scene).args(["--deck", host, "-o"]).arg(&to), "");
        let (mesh, mut said) = match host {
            "openradioss" => (openradioss(&to), of_openradioss(&to)),
            "ls-dyna" => (ls_dyna(&to), of_ls_dyna(&to)),
            _ => (abaqus(&to), of_abaqus(&to)),
        };
        let on = |axis: usize| -> BTreeSet<usize> {
            mesh.elements.values().flatten().copied().filter(|node| mesh.nodes[node][axis] == 0.0).collect()
        };
        // Yarns end where an element's second section is no other's first.
        let sections = |nodes: std::ops::Range<usize>| -> BTreeSet<usize> {
            mesh.elements.values().flat_map(|element| element[nodes.clone()].to_vec()).collect()
        };
        let rim: BTreeSet<usize> = sections(4..8).difference(&sections(0..4)).copied().collect();
        let mut held = vec![(on(0), [true, false, false]), (on(1), [false, true, false]), (rim, [true, true, true])];
        held.sort();
        said.held.sort();
        let property = |k_el: f64, k_ld: f64| vec![k_el, 1055.0, 2.2, 649.74, k_ld, 0.0458, 0.0, 0.0, 1.0, 0.0, 0.0];
        let constants =
            [(property(82341.0, 0.0), DENSITY), (property(41170.5, 5.0), DENSITY), (property(41170.5, 5.0), DENSITY)];
        let wanted = Said { held, constants: constants.to_vec(), friction: [0.21, 0.17], speed: 142.0, end: 0.02 };
        assert!(wanted.held.iter().all(|(nodes, _)| nodes.len() > 20), "{:?}", wanted.held);
        assert_eq!(said, wanted, "{host}");
        let (_, parts) = striker_and_parts(host, &to, "scene");
        for (name, material) in parts.iter().filter(|(name, _)| *name != "striker") {
            let upper = parts.iter().find(|(name, _)| name.starts_with("ply-1")).expect("a yarn of the upper ply").1;
            assert_eq!(name.starts_with("ply-1"), material == upper, "{host}: {name} {material}");
        }
        // The plies lie apart by the clearance.
        let below = |element: &[usize; 8]| element.iter().map(|node| mesh.nodes[node].z).sum::<f64>() < -0.9;
        assert_eq!(2 * mesh.elements.values().filter(|element| below(element)).count(), mesh.elements.len(), "{host}");
    }
}

/// What keeps elements in shape and deletes them, and which nodes touch the striker.
#[test]
fn decks_control_hourglass_collapse_and_contact_alike() {
    let output = folder("scene-decks-controls");
    let scene = output.join("scene.toml");
    std::fs::write(&scene, format!("{SCENE}failure = \"uniaxial\"\n")).expect("the scene can be written");
    for host in ["openradioss", "ls-dyna", "abaqus-explicit"] {
        let mut toron = Command::new(env!("CARGO_BIN_EXE_toron"));
        toron.arg("fabric").arg(&scene).args(["--deck", host, "--first-id", &FIRST.to_string(), "-o"]);
        run(toron.arg(output.join(host)), "");
    }
    let find = |blocks: &[(String, Vec<String>)], wanted: &str| -> Vec<(String, Vec<String>)> {
        blocks.iter().filter(|(keyword, _)| keyword.starts_with(wanted)).cloned().collect()
    };

    let deck = blocks(&output.join("openradioss/scene_0000.rad"), "#", '/');
    let [(_, property)] = &find(&deck, "/PROP/TYPE14/")[..] else { panic!("one property of solids") };
    let hourglass = numbers(&fields(&property[2], 20))[2];
    let engine = blocks(&output.join("openradioss/scene_0001.rad"), "#", '/');
    let [(_, stop)] = &find(&engine, "/STOP")[..] else { panic!("one limit of the energy's error") };
    assert_eq!(stop[0], "1.0 0 0 1 1", "the energy has doubled; no limit of masses; a last line and a last picture");

    // Viscous, of the same factor if a scale of 1 is the usual 0.1; and no element gets shorter than the part at which
    // the others delete it.
    let deck = blocks(&output.join("abaqus-explicit/scene.inp"), "**", '*');
    let [(controls, scale)] = &find(&deck, "*SECTION CONTROLS")[..] else { panic!("one set of controls") };
    let wanted =
        ["ELEMENT DELETION=YES", "HOURGLASS=VISCOUS", "DISTORTION CONTROL=YES", "LENGTH RATIO=0.1"].map(String::from);
    let options: Vec<String> = controls.split(", ").skip(2).map(String::from).collect();
    assert_eq!(options, wanted);
    let scale: f64 = scale[0].trim_end_matches(',').parse().expect("a number");
    assert!((0.1 * scale / hourglass - 1.0).abs() < 1e-9, "{scale} of 0.1, {hourglass}");

    let deck = blocks(&output.join("ls-dyna/scene.k"), "$", '*');
    let [(_, solids)] = &find(&deck, "*CONTROL_SOLID")[..] else { panic!("one control of solids") };
    assert_eq!(numbers(&fields(&solids[0], 10))[0], 2.0, "ESORT: wedges of one point stay of one point");
    let nodes = ls_dyna(&output.join("ls-dyna")).elements.into_values().flatten().collect::<BTreeSet<_>>();
    let sets = blocks(&output.join("ls-dyna/scene-mesh.k"), "$", '*');
    let [(_, range)] = &find(&sets, "*SET_NODE_LIST_GENERATE_TITLE")[..] else { panic!("one range of nodes") };
    let [set, bounds] = [1, 2].map(|line| numbers(&fields(&range[line], 10)));
    assert_eq!([Some(&(bounds[0] as usize)), Some(&(bounds[1] as usize))], [nodes.first(), nodes.last()]);
    assert_eq!(nodes.len() as f64, bounds[1] - bounds[0] + 1.0, "the yarns' nodes and no others");
    for (keyword, lines) in find(&deck, "*CONTACT_") {
        let line = |i: usize| numbers(&fields(&lines[i], 10));
        // Behind the identity: three lines, that of erosion, and options A, B and C.
        assert_eq!(lines.len(), 8, "{keyword}");
        assert_eq!((line(5)[0], line(7)[1]), (1.0, 1.0), "{keyword}: SOFT and IGNORE");
        if keyword.contains("NODES_TO_SURFACE") {
            assert_eq!((line(1)[0], line(1)[2]), (set[0], 4.0), "a set of nodes");
        }
    }
}
