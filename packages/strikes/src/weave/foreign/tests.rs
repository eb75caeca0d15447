//! Tiny meshes of two yarns a family in each format, and what is refused.

use std::fmt::Write;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::reader::Foreign;
use crate::weave::cloth::Cloth;
use crate::weave::figures::Figures;
use crate::weave::model::Model;
use crate::weave::reader::Scene;
use crate::weave::report::section_warnings;
use crate::weave::vtu;
use toron::host::units::UnitSystem;
use toron_shared::error::Error;
use toron_shared::numbers::number;

/// Four straight yarns: the weft lies on the warp, which is 0.1 high; all have a pitch of 1, are 3 long, and have three
/// columns, the outer ones wedges of half the width.
pub(super) struct Cross {
    pub nodes: Vec<[f64; 3]>,
    pub elements: Vec<Solid>,
}

pub(super) struct Solid {
    yarn: usize,
    pub nodes: Vec<usize>,
    direction: [f64; 3],
}

pub(super) const LAYERS: usize = 6;
const LENGTH: f64 = 3.0;
const HEIGHT: f64 = 0.1;
/// Across and upwards: the tip, below and above at the left, at the right, the tip.
pub(super) const SECTION: [[f64; 2]; 6] =
    [[-0.3, 0.0], [-0.1, -0.05], [-0.1, 0.05], [0.1, -0.05], [0.1, 0.05], [0.3, 0.0]];
/// By places in the section: around a triangle, a quadrangle and a triangle, as one looks along the yarn.
const PIECES: [&[usize]; 3] = [&[0, 2, 1], &[1, 2, 4, 3], &[3, 4, 5]];

impl Cross {
    pub(super) fn new(gap: f64) -> Cross {
        let mut cross = Cross { nodes: Vec::new(), elements: Vec::new() };
        for (yarn, (family, coordinate)) in [(0, -0.5), (0, 0.5), (1, -0.5), (1, 0.5)].into_iter().enumerate() {
            let first = cross.nodes.len();
            let level = if family == 0 { 0.0 } else { HEIGHT + gap };
            for layer in 0..=LAYERS {
                let along = LENGTH * (layer as f64 / LAYERS as f64 - 0.5);
                for [across, up] in SECTION {
                    // The third axis of a warp yarn is -y.
                    let [x, y] = if family == 0 { [along, coordinate - across] } else { [coordinate + across, along] };
                    cross.nodes.push([x, y, level + up]);
                }
            }
            for layer in 0..LAYERS {
                for piece in PIECES {
                    let section = |number: usize| piece.iter().map(move |&node| first + number * SECTION.len() + node);
                    let nodes = section(layer).chain(section(layer + 1)).collect();
                    let direction = if family == 0 { [1.0, 0.0, 0.0] } else { [0.0, -2.0, 0.0] };
                    cross.elements.push(Solid { yarn, nodes, direction });
                }
            }
        }
        cross
    }

    /// Abaqus, as TexGen has it: an element set and a section a yarn, directions in a file of their own.
    pub(super) fn abaqus(&self, directions: &str) -> String {
        let mut text = "*Heading\nby hand\n*Node\n".to_string();
        for (number, [x, y, z]) in (1..).zip(&self.nodes) {
            let _ = writeln!(text, "{number}, {x}, {y}, {z}");
        }
        for (kind, count) in [("C3D6", 6), ("C3D8R", 8)] {
            let _ = writeln!(text, "*Element, Type={kind}");
            for (number, solid) in (1..).zip(&self.elements).filter(|(_, solid)| solid.nodes.len() == count) {
                let nodes: Vec<String> = solid.nodes.iter().map(|node| (node + 1).to_string()).collect();
                let _ = writeln!(text, "{number}, {}", nodes.join(", "));
            }
        }
        text += directions;
        let of_yarn = LAYERS * PIECES.len();
        for yarn in 0..4 {
            let (first, last) = (of_yarn * yarn + 1, of_yarn * (yarn + 1));
            let _ = writeln!(
                text,
                "*ElSet, ElSet=Yarn{yarn}, Generate\n{first}, {last}\n*Solid Section, ElSet=Yarn{yarn}, Material=M\n1.0,"
            );
        }
        text
    }

    pub(super) fn directions(&self) -> String {
        let line = |(number, solid): (usize, &Solid)| {
            let [x, y, z] = solid.direction;
            format!("{number}, {x}, {y}, {z}, 0, 0, 1\n")
        };
        format!(
            "** by element\n, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0\n{}",
            (1..).zip(&self.elements).map(line).collect::<String>()
        )
    }

    /// LS-DYNA: a part a yarn, wedges with nodes 5 and 6, 7 and 8 alike.
    pub(super) fn ls_dyna(&self) -> String {
        let mut text = "*KEYWORD\n$ by hand\n*NODE\n".to_string();
        for (number, [x, y, z]) in (1..).zip(&self.nodes) {
            let _ = writeln!(text, "{number:>8}{x:>16.9}{y:>16.9}{z:>16.9}");
        }
        for yarn in 0..4 {
            let _ = writeln!(text, "*PART\nyarn {yarn}\n{:>10}{:>10}{:>10}", 11 + yarn, 1, 1);
        }
        text += "*ELEMENT_SOLID\n";
        for (number, solid) in (1..).zip(&self.elements) {
            let n: Vec<usize> = solid.nodes.iter().map(|node| node + 1).collect();
            let nodes = match n[..] {
                [a, b, c, d, e, f] => [b, a, d, e, c, c, f, f],
                _ => std::array::from_fn(|i| n[i]),
            };
            let _ = write!(text, "{number:>8}{:>8}", 11 + solid.yarn);
            nodes.iter().for_each(|node| {
                let _ = write!(text, "{node:>8}");
            });
            text.push('\n');
        }
        text + "*END\n"
    }
}

fn folder(name: &str) -> PathBuf {
    static COUNT: AtomicUsize = AtomicUsize::new(0);
    let [process, count] = [std::process::id() as usize, COUNT.fetch_add(1, Ordering::Relaxed)];
    let folder = std::env::temp_dir().join(format!("toron-foreign-{name}-{process}-{count}"));
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// The panel of a scene beside these files; further keys go into `[mesh]`.
pub(super) fn read<T: AsRef<[u8]>>(name: &str, files: &[(&str, T)], keys: &str) -> Result<Foreign, Error> {
    let folder = folder(name);
    for (file, text) in files {
        let place = folder.join(file);
        std::fs::create_dir_all(place.parent().expect("a folder")).expect("a folder");
        std::fs::write(place, text).expect("a file");
    }
    let scene = folder.join("scene.toml");
    let text = format!("units = \"mm-tonne-s\"\n[mesh]\nfile = \"{}\"\n{keys}\n", files[0].0);
    let read = Scene::parse(&scene.display().to_string(), &text);
    std::fs::remove_dir_all(&folder).expect("the folder can go");
    match read?.cloth {
        Cloth::Foreign(foreign) => Ok(*foreign),
        Cloth::Woven(_) => panic!("a mesh"),
    }
}

#[track_caller]
pub(super) fn refused<T: AsRef<[u8]>>(files: &[(&str, T)], keys: &str, message: &str) {
    let error = read("refused", files, keys).map(|_| ()).expect_err(message).to_string();
    assert!(error.contains(message), "{message}: {error}");
}

pub(super) fn check(foreign: &Foreign) {
    let Foreign { model, figures, checks, .. } = foreign;
    assert_eq!((figures.yarns, figures.elements, figures.nodes), ([2, 2], 72, 168));
    assert_eq!((checks.wedges, checks.inside_out, checks.overlapping.len()), (48, 0, 0));
    // Four times two triangles of 0.2 by 0.1 and a square of twice that.
    let near = |a: f64, b: f64| (a - b).abs() < 1e-7;
    assert!(near(figures.volumes_by_area[0], 0.04) && near(figures.volumes_by_area[1], 0.04), "{figures:?}");
    assert!(near(figures.crimp[0], 0.0) && near(figures.thickness, 0.21), "{figures:?}");
    assert!(near(checks.clearance, 0.01) && checks.heights.iter().all(|&height| near(height, HEIGHT)), "{checks:?}");
    assert!(checks.off_element < 1e-5 && checks.off_yarn.0 < 1e-5, "{checks:?}");
    let coordinates: Vec<f64> = model.yarns.iter().map(|yarn| yarn.coordinate).collect();
    assert!(coordinates.iter().zip([-0.5, 0.5, -0.5, 0.5]).all(|(&found, own)| near(found, own)), "{coordinates:?}");
    assert_eq!(model.yarns.iter().map(|yarn| yarn.number).collect::<Vec<_>>(), [-1, 0, -1, 0]);
    assert!(model.crossings.len() == 4 && model.crossings.iter().all(|crossing| !crossing.warp_is_over));
    // A yarn has eight faces around it in each layer, less the four that its elements share; its ends are the rim.
    assert_eq!((model.faces.len(), model.rim.len()), (4 * LAYERS * 6, 8 * SECTION.len()));
    for (element, fibre) in model.elements.iter().zip(&model.fibre) {
        let [a, b, c, d] = [0, 1, 2, 4].map(|corner| nalgebra::Vector3::from(model.corners(element)[corner]));
        assert!((b - a).normalize().dot(&nalgebra::Vector3::from(*fibre)) > 1.0 - 1e-9);
        // The first and the third corner are the same at a tip on the left, the fifth and the seventh at one on the
        // right.
        assert!(c == a || (c - a).z > 0.0 && (b - a).cross(&(c - a)).dot(&(d - a)) > 0.0, "{element:?}");
    }
    for face in &model.faces {
        let [a, b, c, d] = face.nodes.map(|node| nalgebra::Vector3::from(model.nodes[node as usize]));
        let element = model.corners(&model.elements[face.element as usize]).map(nalgebra::Vector3::from);
        let middle = element.iter().sum::<nalgebra::Vector3<f64>>() / 8.0;
        assert!((c - a).cross(&(d - b)).dot(&(a - middle)) > 0.0, "{face:?}");
    }
}

#[test]
fn each_format_gives_the_same_panel() {
    let cross = Cross::new(0.01);
    let directions = "*Distribution, Location=Element, Table=T, Name=D, Input=cross.ori\n";
    let texgen = read("texgen", &[("cross.inp", &cross.abaqus(directions)), ("cross.ori", &cross.directions())], "");
    let texgen = texgen.expect("a panel");
    check(&texgen);
    let inline = format!("*Distribution, Location=Element, Table=T, Name=D\n{}", cross.directions());
    let plain = [("cross.inp", cross.abaqus("")), ("cross.inp", cross.abaqus(&inline)), ("cross.k", cross.ls_dyna())];
    for (file, text) in &plain {
        let foreign = read("plain", &[(file, text)], "").expect("a panel");
        check(&foreign);
        let places = |model: &Model| model.nodes.iter().flatten().copied().collect::<Vec<f64>>();
        let apart =
            places(&texgen.model).iter().zip(places(&foreign.model)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-9 && foreign.model.faces.len() == texgen.model.faces.len(), "{file}: {apart}");
    }
    // Our own file of it, and that in metres.
    let own = vtu::unstructured_grid(&texgen.model);
    assert_eq!(read("own", &[("cross.vtu", &own)], "").expect("a panel").model, texgen.model);
    let metres = read("metres", &[("cross.vtu", &own)], "units = \"um\"");
    assert!(metres.is_err(), "0.08 µm of yarn");
    let shifted = read("shifted", &[("cross.vtu", &own)], "shift = [0.5, -0.5]").expect("a panel");
    assert_eq!(shifted.model.yarns.iter().map(|yarn| yarn.coordinate).collect::<Vec<_>>(), [-1.0, 0.0, 0.0, 1.0]);
    let given = read("given", &[("cross.vtu", &own)], "clearance = 0.002\nheight = 0.12").expect("a panel");
    assert_eq!((given.clearance, given.heights), (0.002, [0.12; 2]));
}

/// The panel that is woven here, through the file that `toron weave` writes.
#[test]
fn a_woven_panel_comes_back_as_it_was() {
    for (outline, part) in [("\"rectangle\"\nhalf = [2.3, 1.6]", "whole"), ("\"circle\"\nradius = 3.0", "quarter")] {
        let text = format!(
            "units = \"mm-tonne-s\"\n[weave]\npreset = \"kevlar-s706\"\nalong = 4\ncolumns = 4\n\
             [weave.panel]\nshape = {outline}\npart = \"{part}\"\n"
        );
        let cloth = Scene::parse("weave.toml", &text).expect("a weave").cloth;
        let model = cloth.model();
        let mesh = read("woven", &[("weave.vtu", &vtu::unstructured_grid(&model))], &format!("part = \"{part}\""));
        let mesh = mesh.expect("a mesh");
        assert_eq!(mesh.model.elements, model.elements);
        assert_eq!((&mesh.model.nodes, &mesh.model.fibre), (&model.nodes, &model.fibre));
        assert_eq!((&mesh.model.faces, &mesh.model.rim), (&model.faces, &model.rim));
        assert_eq!((&mesh.model.on_x, &mesh.model.on_y), (&model.on_x, &model.on_y));
        for (found, own) in mesh.model.yarns.iter().zip(&model.yarns) {
            assert!((found.coordinate - own.coordinate).abs() < 1e-12);
            assert_eq!(found, &crate::weave::model::Yarn { coordinate: found.coordinate, ..own.clone() });
        }
        let [found, own]: [Figures; 2] = [mesh.figures, cloth.figures(&model)[0]];
        assert_eq!((found.elements, found.least_jacobian), (own.elements, own.least_jacobian));
        assert!((found.volume_by_area() / own.volume_by_area() - 1.0).abs() < 1e-9, "{found:?} {own:?}");
        assert!((mesh.clearance - 1e-3).abs() < 1e-6, "{}", mesh.clearance);
    }
}

#[test]
fn yarns_that_go_into_each_other_are_counted_and_refused() {
    let sunk = |gap: f64| read("sunk", &[("cross.k", &Cross::new(gap).ls_dyna())], "");
    let slightly = sunk(-0.012).expect("a panel");
    // Eight nodes of each crossing's hexahedra are in the other yarn, and no point of an element's thirds.
    let checks = &slightly.checks;
    assert_eq!((checks.sunk_nodes, checks.shared, slightly.clearance), (4 * 4, 0.0, 0.0), "{checks:?}");
    assert!(checks.warnings()[0].contains("16 nodes are in another yarn"), "{:?}", checks.warnings());
    // Squares of 0.2 at four crossings, a third of an element high in both yarns; the wedges add little.
    let error = sunk(-0.02).map(|_| ()).expect_err("too deep").to_string();
    let share = error.split(' ').nth(1).and_then(|share| share.parse::<f64>().ok()).expect("a number");
    let hexahedra = 100.0 * 4.0 * 2.0 * 0.2 * 0.2 * HEIGHT / 3.0 / (4.0 * 0.04 * LENGTH);
    assert!((0.9 * hexahedra..2.0 * hexahedra).contains(&share), "{error}");
    let error = sunk(-0.1).map(|_| ()).expect_err("on one level").to_string();
    assert!(error.contains("% of the yarns' volume is in two yarns; allowed: up to 2.000 %"), "{error}");
}

#[test]
fn a_blow_beside_the_middle_is_said_with_the_shift_that_mends_it() {
    let cross = read("aimed", &[("cross.k", &Cross::new(0.01).ls_dyna())], "").expect("a panel");
    for blow in [[0.0, 0.0], [0.7, -0.7]] {
        assert_eq!(cross.off_middle(blow, "mm"), None);
    }
    let text = cross.off_middle([-0.5, -1.5], "mm").expect("a warning");
    let wanted = "the blow is at (-0.5000, -1.500) mm, nearer to an edge of the mesh than to its middle, x from -1.500";
    assert!(text.starts_with(wanted), "{text}");
    // The crossing at (-0.5, -0.5) comes to it.
    assert!(text.contains("add [0, -1.000] to mesh.shift"), "{text}");
    let shifted = read("aimed", &[("cross.k", &Cross::new(0.01).ls_dyna())], "shift = [0.0, -1.0]").expect("a panel");
    assert_eq!(shifted.off_middle([-0.5, -1.5], "mm"), None);
}

#[test]
fn a_mesh_in_inches_has_sections_of_no_yarn() {
    let units = UnitSystem::parse("mm-tonne-s").expect("units");
    let warning = |foreign: &Foreign| section_warnings(&foreign.figures, foreign.pitch, &units).into_iter().next();
    let cross = read("mm", &[("cross.k", &Cross::new(0.01).ls_dyna())], "").expect("a panel");
    assert_eq!(warning(&cross), None);
    for factor in [1.0 / 25.4, 25.4] {
        let mut model = cross.model.clone();
        model.nodes.iter_mut().flatten().for_each(|x| *x *= factor);
        let scaled = read("in", &[("cross.vtu", &vtu::unstructured_grid(&model))], "").expect("a panel");
        let text = warning(&scaled).expect("a warning");
        // 0.04 mm² of 1400 kg/m³ are 560 dtex.
        let dtex = number(560.0 * factor * factor);
        assert!(text.starts_with("taken to have 1400 kg/m³, ") && text.contains(&dtex), "{dtex}: {text}");
    }
}

#[test]
fn a_wrong_file_is_refused_by_name() {
    let cross = Cross::new(0.01);
    let (abaqus, ls_dyna) = (cross.abaqus(""), cross.ls_dyna());
    let own = vtu::unstructured_grid(&read("own", &[("cross.k", &ls_dyna)], "").expect("a panel").model);
    let inp = |text: &str, message: &str| refused(&[("cross.inp", text)], "", message);
    inp(&abaqus.replacen("\n1, ", "\n1000, ", 1), "element 1 has node 1, which the file does not have");
    inp(&abaqus.replace("ElSet=Yarn3, Generate\n55, 72", "ElSet=Yarn3"), "set YARN3 has no elements");
    inp(&abaqus.replace("55, 72", "55, 71"), "element 72 is of no yarn");
    inp(&abaqus.replace("55, 72", "50, 72"), "element 50 of set YARN3 is of another yarn too");
    inp(&abaqus.replace("C3D6", "C3D4"), "cross.inp:172: elements of type C3D4; allowed: C3D8 and C3D6");
    inp(
        &abaqus.replace("Type=C3D8R\n2, 2, 3, 5, 4, 8, 9, 11, 10", "Type=C3D8R\n2, 8, 9, 11, 10, 2, 3, 5, 4"),
        "element 2 of YARN0 is inside out",
    );
    inp(&abaqus.replace("3, -1.5,", "3, x,"), "cross.inp:6: x is \"x\"; allowed: a finite number");
    inp(&cross.abaqus("*Distribution, Input=none.ori\n"), "none.ori");
    inp(
        &abaqus.replacen("*Element", "*Elgen, Elset=All\n1, 2, 1, 1\n*Element", 1),
        "*ELGEN; allowed: nodes and elements",
    );
    inp(&abaqus.replacen("*Node", "*Node, System=C", 1), "*NODE, SYSTEM=C; allowed: R");
    let of_none = "*Distribution, Location=Element\n, 1., 0., 0.\n999999, 0., 1., 0.\n";
    inp(&cross.abaqus(of_none), "has a direction of element 999999, which the file does not have");
    let of_none = "*Distribution, Location=Element\n, 1., 0., 0.\nYarn99, 0., 1., 0.\n";
    inp(&cross.abaqus(of_none), "has a direction of set YARN99, which the file does not have");
    refused(&[("cross.inp", &abaqus)], "units = \"m\"", "allowed: 0.003000 to 30.00, in mesh.units = \"m\"");
    refused(&[("cross.inp", &abaqus)], "units = \"kg\"", "mesh.units is \"kg\"; allowed: a unit of length");
    refused(&[("cross.inp", &abaqus)], "part = \"quarter\"", "YARN0 has a node at x = -1.5; allowed: 0 and more");
    refused(&[("cross.stl", "")], "", "mesh.file is \"cross.stl\"; allowed: .inp, .k, .key or .vtu");
    // All fibres along x: the weft's are then across it.
    let across = "*Distribution, Location=Element\n, 1., 0., 0., 0., 1., 0.\n";
    inp(&cross.abaqus(across), "4 yarns along x and 0 along y");
    let swapped = "*Distribution, Location=Element\n, 1., 0., 0.\nYarn0, 0., 1., 0.\nYarn1, 0., 1., 0.\n";
    inp(&cross.abaqus(swapped), "is a wedge with triangles along the fibre, which is 90° off");
    let weave =
        "units = \"mm-tonne-s\"\n[weave]\npreset = \"kevlar-s706\"\n[weave.panel]\nshape = \"circle\"\nradius = 3.0\n";
    let mut model = Scene::parse("weave.toml", weave).expect("a weave").cloth.model();
    model.fibre.iter_mut().for_each(|fibre| fibre.swap(0, 1));
    let turned = vtu::unstructured_grid(&model);
    refused(&[("turned.vtu", &turned)], "", "are 90° off its length; allowed: up to 45°, directions along the yarn");
    let oblique = "units = \"mm-tonne-s\"\n[weave]\npreset = \"kevlar-s706\"\nalong = 4\n[weave.panel]\nshape = \"circle\"\n\
                   radius = 3.0\n[[ply]]\nangle = 30\n";
    let oblique = Scene::parse("weave.toml", oblique).expect("a weave").cloth.model();
    refused(&[("oblique.vtu", &vtu::unstructured_grid(&oblique))], "", "runs 30° off x and y; allowed: up to 10°");
    // A yarn without a layer of its middle, one without an element of its middle, and one whose elements share no
    // nodes.
    let model = Scene::parse("weave.toml", weave).expect("a weave").cloth.model();
    let without = |lost: &dyn Fn(usize) -> bool| {
        let mut model = model.clone();
        let mut place = 0;
        let kept: Vec<bool> = (0..model.elements.len()).map(|element| !lost(element)).collect();
        let mut keep = |element: usize| {
            place += usize::from(kept[element]);
            place
        };
        let ends: Vec<usize> = (0..model.elements.len()).map(&mut keep).collect();
        let before = |element: usize| if element == 0 { 0 } else { ends[element - 1] };
        for yarn in &mut model.yarns {
            yarn.elements = before(yarn.elements.start)..before(yarn.elements.end);
        }
        let mut number = kept.iter();
        model.elements.retain(|_| *number.next().expect("one each"));
        let mut number = kept.iter();
        model.fibre.retain(|_| *number.next().expect("one each"));
        vtu::unstructured_grid(&model)
    };
    let first = &model.yarns[3];
    let grid = &first.pieces[0].grid;
    let middle = first.elements.start + grid.layer(grid.layers / 2).start;
    let layer = without(&|element| (middle..middle + grid.elements_per_layer()).contains(&element));
    refused(&[("gap.vtu", &layer)], "", "is in 2 pieces; allowed: one, of elements that share their nodes");
    let one = without(&|element| element == middle + 1);
    refused(&[("gap.vtu", &one)], "", "has a gap along x beside element");
    let k = |text: &str, message: &str| refused(&[("cross.k", text)], "", message);
    k(&ls_dyna.replace("*END", "*PART\nempty\n        99\n*END"), "part 99, empty, has no elements");
    k(&ls_dyna.replace("*KEYWORD", "*KEYWORD LONG=Y"), "cross.k:4: x is \"0000    -0.200000000\"");
    let vtu = |text: &str, message: &str| refused(&[("cross.vtu", text)], "", message);
    vtu(&own.replace("format=\"ascii\"", "format=\"binary\""), "array position is no base64");
    vtu(&own.replace("Name=\"yarn\"", "Name=\"thread\""), "CellData has no array yarn");
    vtu("<VTKFile>", "cross.vtu");
    // One yarn is two.
    let shared = abaqus.replace("19, 36\n", "19, 35\n").replace("37, 54", "36, 54");
    inp(&shared, "is in YARN");
    let both = "units = \"mm-tonne-s\"\n[weave]\npreset = \"kevlar-s706\"\n[mesh]\nfile = \"x.k\"\n";
    let error = Scene::parse("both.toml", both).map(|_| ()).expect_err("both").to_string();
    assert!(error.contains("both.toml:4: [mesh] beside [weave]; allowed: one of them"), "{error}");
    let neither = Scene::parse("none.toml", "units = \"si\"\n").map(|_| ()).expect_err("neither").to_string();
    assert!(neither.contains("[weave] is missing; allowed: [weave], or [mesh] with a file"), "{neither}");
}
