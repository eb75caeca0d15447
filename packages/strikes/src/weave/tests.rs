//! The mesh as a whole: no yarn goes into another, and all are as far apart as was asked for.

use std::collections::HashSet;

use super::cloth::Cloth;
use super::distance::{self, Quad};
use super::figures::Figures;
use super::file;
use super::geometry::{Family, Weave};
use super::model::{Crossing, Grid, Model, Yarn};
use super::panel::{Centre, Outline, Panel, Part, Turn};
use super::pattern::Pattern;
use super::preset::Preset;
use super::reader::Scene;
use super::section::{Section, Thread};
use crate::cases::layered;
use crate::weave::reader::layup;
use toron::host::units::UnitSystem;
use toron_shared::toml_file::Source;

fn millimetres() -> UnitSystem {
    UnitSystem::parse("mm-tonne-s").expect("a unit system")
}

fn s706() -> Weave {
    Preset::find("kevlar-s706").expect("a preset").weave(&millimetres())
}

fn rows(rows: &[&str]) -> Pattern {
    Pattern::parse(&rows.iter().map(|row| (*row).to_string()).collect::<Vec<_>>()).expect("a pattern")
}

fn patterns() -> [Pattern; 3] {
    [Pattern::plain(), rows(&["oouu", "uoou", "uuoo", "ouuo"]), rows(&["oouu", "oouu", "uuoo", "uuoo"])]
}

fn panel(outline: Outline, part: Part, centre: Centre) -> Panel {
    Panel { outline, part, centre, turn: Turn::NONE, coarse: None }
}

/// A panel of some crossings of each kind.
fn small(weave: &Weave) -> Panel {
    let half = [1, 0].map(|family: usize| 2.0 * weave.threads[family].pitch);
    panel(Outline::Rectangle(half), Part::Whole, Centre::Crossing)
}

fn grid(yarn: &Yarn) -> Grid {
    yarn.pieces[0].grid
}

/// The least distance between the faces of two yarns within half a pitch of their crossing, up to a bound.
fn separation(model: &Model, crossing: &Crossing, reach: [f64; 2], bound: f64) -> f64 {
    let quads = |yarn: &Yarn| -> Vec<Quad> {
        let faces = model.faces[yarn.faces.clone()].iter();
        let quads = faces.map(|face| face.nodes.map(|node| model.nodes[node as usize]));
        let near = |quad: &Quad| {
            (0..2).all(|axis| quad.iter().any(|point| (point[axis] - crossing.place[axis]).abs() <= reach[axis]))
        };
        quads.filter(near).collect()
    };
    let others = quads(&model.yarns[crossing.weft]);
    let mut least = bound;
    for face in quads(&model.yarns[crossing.warp]) {
        for other in &others {
            least = distance::quads(&face, other, least);
        }
    }
    least
}

/// Faces of crossing yarns do not meet, their least distance is the clearance, and the one that is over is above.
fn check_clearance(weave: &Weave) {
    let name = format!("{:?} along {} columns {} rows {}", weave.threads, weave.along, weave.columns, weave.rows);
    let model = Model::new(weave, &small(weave)).expect("a mesh");
    let bound = 1.5 * weave.clearance;
    let mut least = bound;
    for crossing in &model.crossings {
        let [warp, weft] = [&model.yarns[crossing.warp], &model.yarns[crossing.weft]];
        let pitches = [1, 0].map(|family: usize| 0.5 * weave.threads[family].pitch);
        least = least.min(separation(&model, crossing, pitches, bound));
        let height = |yarn: &Yarn, axis: usize| {
            let at = crossing.place[axis];
            let near = yarn.nodes.clone().filter(|&node| (model.nodes[node][axis] - at).abs() < 1e-9);
            let heights: Vec<f64> = near.map(|node| model.nodes[node][2]).collect();
            heights.iter().sum::<f64>() / heights.len() as f64
        };
        if crossing.place[0].abs() < 1.9 * weave.threads[1].pitch
            && crossing.place[1].abs() < 1.9 * weave.threads[0].pitch
        {
            assert_eq!(height(warp, 0) > height(weft, 1), crossing.warp_is_over, "{name}");
        }
    }
    assert!((least - weave.clearance).abs() < 1e-9, "{name}: {least}");
    let figures = Figures::of(&model, 0, &weave.solve().expect("an amplitude"));
    assert!(figures.least_jacobian > 0.0 && figures.least_scaled_jacobian > 0.3, "{name}: {figures:?}");
}

#[test]
fn yarns_are_the_clearance_apart_whatever_pattern_section_and_mesh() {
    for pattern in patterns() {
        for section in [Section::Ellipse, Section::Lens, Section::Rectangle] {
            for [along, columns, rows] in [[4, 4, 2], [8, 6, 2]] {
                let mut weave = Weave { pattern: pattern.clone(), along, columns, rows, ..s706() };
                weave.threads = weave.threads.map(|thread| Thread { section, ..thread });
                check_clearance(&weave);
            }
        }
    }
    for [along, columns, rows] in [[2, 1, 1], [12, 8, 3]] {
        check_clearance(&Weave { along, columns, rows, ..s706() });
    }
}

#[test]
fn warp_and_weft_may_differ_and_columns_be_odd() {
    let warp = Thread { pitch: 0.9, section: Section::Ellipse, width: 0.7, height: 0.15 };
    let weft = Thread { pitch: 0.6, section: Section::Lens, width: 0.5, height: 0.08 };
    for pattern in patterns() {
        check_clearance(&Weave { pattern, threads: [warp, weft], columns: 5, rows: 1, clearance: 2e-3, ..s706() });
    }
}

#[test]
fn the_preset_has_the_areal_density_of_its_yarns_and_their_crimp() {
    let weave = s706();
    let geometry = weave.solve().expect("an amplitude");
    let disc = panel(Outline::Circle(19.05), Part::Quarter, Centre::Crossing);
    let model = Model::new(&weave, &disc).expect("a mesh");
    let figures = Figures::of(&model, 0, &geometry);
    let density = 1.3514e-6; // kg/mm³
    let areal = 1e6 * density * figures.volume_by_area();
    let straight = 1e6 * density * 2.0 * weave.threads[0].area() / weave.threads[0].pitch;
    assert!((straight - 0.1744).abs() < 1e-4, "{straight}");
    assert!((areal / (0.1744 * (1.0 + figures.crimp[0])) - 1.0).abs() < 1e-3, "{areal}");
    assert!((0.014..0.017).contains(&figures.crimp[0]) && figures.crimp[0] == figures.crimp[1], "{figures:?}");
    assert!((0.232..0.235).contains(&figures.thickness), "{figures:?}");
    assert!(figures.least_scaled_jacobian > 0.9);
    assert_eq!(figures.elements, 98_136);
    assert_eq!(
        figures.elements,
        model.yarns.iter().map(|yarn| 2 * grid(yarn).layers * grid(yarn).columns).sum::<usize>()
    );
}

/// Places to a picometre, to be found in a set.
fn key(node: [f64; 3]) -> [i64; 3] {
    node.map(|x| (x * 1e9).round() as i64)
}

#[test]
fn a_quarter_is_the_whole_where_x_and_y_are_positive() {
    let basket = Weave { pattern: rows(&["ouuo", "uoou", "uoou", "ouuo"]), ..s706() };
    for (weave, centre) in [(s706(), Centre::Crossing), (basket, Centre::Gap)] {
        let of = |part: Part| Model::new(&weave, &panel(Outline::Circle(4.0), part, centre)).expect("a mesh");
        let [whole, quarter] = [of(Part::Whole), of(Part::Quarter)];
        let places: HashSet<[i64; 3]> = whole.nodes.iter().map(|&node| key(node)).collect();
        for &[x, y, z] in &quarter.nodes {
            assert!(x >= 0.0 && y >= 0.0);
            for image in [[x, y, z], [-x, y, z], [x, -y, z], [-x, -y, z]] {
                assert!(places.contains(&key(image)), "{image:?}");
            }
        }
        assert_eq!(4 * quarter.elements.len(), whole.elements.len());
        assert!(whole.on_x.is_empty() && whole.on_y.is_empty());
        for (set, axis) in [(&quarter.on_x, 0), (&quarter.on_y, 1)] {
            let on = quarter.nodes.iter().filter(|node| node[axis] == 0.0).count();
            assert!(on == set.len() && on > 0 && set.iter().all(|&node| quarter.nodes[node as usize][axis] == 0.0));
        }
        // The rim is one section of each yarn of the quarter, two of the whole.
        let ends = |model: &Model| model.yarns.iter().map(|yarn| grid(yarn).nodes_per_section()).sum::<usize>();
        assert_eq!([quarter.rim.len(), whole.rim.len()], [ends(&quarter), 2 * ends(&whole)]);
        // No face lies on a plane of symmetry.
        for face in &quarter.faces {
            assert!((0..2).all(|axis| face.nodes.iter().any(|&node| quarter.nodes[node as usize][axis] != 0.0)));
        }
    }
}

#[test]
fn yarns_are_contiguous_and_fibres_unit_tangents_of_their_centre_lines() {
    let weave = s706();
    let model = Model::new(&weave, &small(&weave)).expect("a mesh");
    let (mut node, mut element, mut face) = (0, 0, 0);
    for yarn in &model.yarns {
        assert_eq!([yarn.nodes.start, yarn.elements.start, yarn.faces.start], [node, element, face]);
        (node, element, face) = (yarn.nodes.end, yarn.elements.end, yarn.faces.end);
        let grid = grid(yarn);
        assert_eq!(yarn.nodes.start + grid.section(grid.layers).end, node);
        assert_eq!(yarn.elements.start + grid.layer(grid.layers - 1).end, element);
        let centre = |section: usize| {
            let nodes = grid.section(section).map(|node| nalgebra::Vector3::from(model.nodes[yarn.nodes.start + node]));
            nodes.sum::<nalgebra::Vector3<f64>>() / grid.nodes_per_section() as f64
        };
        for layer in 0..grid.layers {
            let tangent = (centre(layer + 1) - centre(layer)).normalize();
            for element in grid.layer(layer).map(|element| yarn.elements.start + element) {
                assert!((nalgebra::Vector3::from(model.fibre[element]) - tangent).norm() < 1e-12);
                let corners = model.elements[element];
                assert!(corners.iter().all(|&corner| yarn.nodes.contains(&(corner as usize))));
            }
        }
        for face in &model.faces[yarn.faces.clone()] {
            let points = face.nodes.map(|node| nalgebra::Vector3::from(model.nodes[node as usize]));
            let corners = model.elements[face.element as usize];
            let middle = corners
                .map(|corner| nalgebra::Vector3::from(model.nodes[corner as usize]))
                .iter()
                .sum::<nalgebra::Vector3<f64>>()
                / 8.0;
            let normal = (points[2] - points[0]).cross(&(points[3] - points[1]));
            assert!(face.nodes.iter().all(|node| corners.contains(node)));
            assert!(normal.dot(&(points[0] - middle)) > 0.0, "{face:?}");
        }
    }
    assert_eq!([node, element, face], [model.nodes.len(), model.elements.len(), model.faces.len()]);
    assert_eq!(model.yarns.iter().filter(|yarn| yarn.family == Family::Warp).count(), 5);
    assert_eq!(model.crossings.len(), 25);
}

const SCENE: &str = "units = \"mm-tonne-s\"\n[weave]\npreset = \"kevlar-s706\"\n";

#[test]
fn mistakes_are_refused_with_file_line_value_and_what_is_allowed() {
    let disc = "panel = { shape = \"circle\", radius = 4 }\n";
    let quarter = "panel = { shape = \"circle\", radius = 4, part = \"quarter\" }\n";
    let twill = "pattern = [\"oouu\", \"uoou\", \"uuoo\", \"ouuo\"]\n";
    let wide = "the plane x = 0, through";
    for (text, line, message) in [
        (String::new(), 2, "panel is missing; allowed: a table with shape and radius or half"),
        (format!("{disc}warps = 3"), 5, "unknown field `warps`"),
        (format!("{disc}pattern = \"twill\""), 5, "pattern is \"twill\"; allowed: plain, or rows of o"),
        (format!("{disc}pattern = 3"), 5, "pattern is 3; allowed: \"plain\", or a list of rows"),
        (format!("{disc}pattern = [\"oo\", \"uu\"]"), 5, "warp yarn 1 is over all others"),
        (format!("{disc}along = 5"), 5, "along is 5; allowed: an even number"),
        (format!("{disc}columns = 0"), 5, "columns is 0; allowed: a whole number from 1 to 40"),
        (format!("{disc}clearance = 0"), 5, "clearance is 0; allowed: a finite number > 0"),
        (format!("{disc}warp = {{ width = 0.8 }}"), 5, "warp.width is 0.8; allowed: up to 0.7451, its pitch less"),
        (format!("{disc}weft = {{ section = \"round\" }}"), 5, "section is \"round\"; allowed: ellipse"),
        (
            format!("{twill}{quarter}"),
            5,
            &format!(
                "part is quarter, but {wide} the axes of the first yarns, is no mirror plane of the pattern; allowed: part = \"whole\""
            ),
        ),
        (format!("columns = 5\n{quarter}"), 5, "halve the yarns on them, but columns is 5; allowed: an even number"),
        (
            "panel = { shape = \"circle\", radius = 4, part = \"quarter\", centre = \"gap\" }".to_string(),
            4,
            "the plane x = 0, through a gap, is no mirror plane of the pattern; allowed: part = \"whole\", or centre = \"crossing\"",
        ),
        (
            "panel = { shape = \"circle\", half = [1, 2] }".to_string(),
            4,
            "panel has half, of a rectangle; allowed: radius",
        ),
        ("panel = { shape = \"rectangle\" }".to_string(), 4, "panel.half is missing; allowed: half sizes"),
        ("panel = { shape = \"circle\", radius = 1e9 }".to_string(), 4, "elements; allowed: up to 1e7"),
        ("panel = { shape = \"circle\", radius = 0.01 }".to_string(), 4, "no yarns of one family"),
        (
            format!(
                "{disc}warp = {{ section = \"rectangle\", width = 0.7 }}\nweft = {{ section = \"rectangle\", width = 0.7 }}"
            ),
            2,
            "the yarns have no room to change sides",
        ),
    ] {
        let error = Scene::parse("weave.toml", &format!("{SCENE}{text}")).map(|_| ()).expect_err(&text).to_string();
        assert!(error.starts_with(&format!("weave.toml:{line}: ")), "line {line}: {error}");
        assert!(error.contains(message), "{message}: {error}");
    }
    let own = "units = \"mm-tonne-s\"\n[weave]\npattern = \"plain\"\npanel = { shape = \"circle\", radius = 4 }\n";
    let error = Scene::parse("weave.toml", own).map(|_| ()).expect_err("no sizes").to_string();
    assert!(
        error.contains("weave.toml:2: warp.pitch is missing; allowed: a finite number > 0, or a preset"),
        "{error}"
    );
    let own = format!("{own}warp = {{ pitch = 1, width = 0.6, height = 0.1 }}");
    let scene = Scene::parse("weave.toml", &own).expect("the weft is as the warp");
    let Cloth::Woven(layup) = scene.cloth else { panic!("a weave") };
    let threads = layup.plies[0].woven.geometry.weave.threads;
    assert_eq!(threads[0], threads[1]);
}

/// A case's keys stand over the scene's one by one; a preset of its own brings its yarns, and a shape of its own has
/// its own size.
#[test]
fn a_case_s_weave_goes_over_the_scene_s() {
    const KEYS: [&str; 16] = [
        "pattern = \"plain\"",
        "warp.pitch = 1.0",
        "warp.section = \"lens\"",
        "warp.width = 0.8",
        "warp.height = 0.2",
        "weft.pitch = 1.1",
        "weft.section = \"rectangle\"",
        "weft.width = 0.7",
        "weft.height = 0.1",
        "clearance = 0.01",
        "along = 6",
        "columns = 3",
        "rows = 4",
        "panel.half = [3.0, 2.0]",
        "panel.part = \"whole\"",
        "panel.centre = \"gap\"",
    ];
    const SHAPE: &str = "panel.shape = \"rectangle\"";
    let units = millimetres();
    let woven = |own: &[&str], base: &[&str]| {
        let text = format!("[base]\n{}\n[own]\n{}\n", base.join("\n"), own.join("\n"));
        let source = Source { name: "both.toml", text: &text };
        let tables = source.tables().unwrap_or_else(|error| panic!("{error}"));
        let both = ["own", "base"].map(|table| tables.get_ref().get(table));
        let weave = layered("weave", both).expect("two tables");
        let plies = file::plies(&source, &weave, &[]).unwrap_or_else(|error| panic!("{error}"));
        match layup(&source, &plies, &units, Some(weave.span())) {
            Ok(layup) => format!("{:?} {:?}", layup.plies[0].woven.geometry.weave, layup.plies[0].woven.panel),
            Err(error) => error.to_string(),
        }
    };
    let all = [&KEYS[..], &[SHAPE]].concat();
    let expected = woven(&all, &[]);
    assert!(expected.contains("lens") || expected.contains("Lens"), "{expected}");
    assert_eq!(woven(&[], &all), expected);
    // Each key alone over another value of it.
    let preset =
        ["preset = \"kevlar-s706\"", "panel = { shape = \"rectangle\", half = [4.0, 4.0], part = \"quarter\" }"];
    let of_preset = woven(&[], &preset);
    for key in KEYS {
        let others: Vec<&str> = all.iter().copied().filter(|other| *other != key).collect();
        assert_eq!(woven(&[key], &others), expected, "{key}");
        assert_eq!(woven(&others, &[key]), expected, "{key}");
    }
    // The yarns are the preset's, all else the scene's.
    let own = woven(&["preset = \"kevlar-s706\""], &all);
    assert!(own != expected && own != of_preset, "{own}");
    let without_yarns = [&KEYS[9..], &[SHAPE]].concat();
    assert_eq!(own, woven(&[], &[&["preset = \"kevlar-s706\""], &without_yarns[..]].concat()));
    let circle = woven(&["panel = { shape = \"circle\", radius = 3.0 }"], &all);
    assert!(circle.contains("Circle(3.0)"), "{circle}");
    assert!(woven(&["panel.shape = \"circle\""], &all).contains("panel.radius is missing"));
    assert!(woven(&KEYS, &[]).contains("panel.shape is missing; allowed: circle, rectangle"));
    assert!(woven(&KEYS[..9], &[]).contains("panel is missing; allowed: a table with shape and radius or half"));
}

/// Two unlike families, so that a turn shows.
const PLIES: &str = "units = \"mm-g-ms\"\n[weave]\npattern = \"plain\"\nalong = 4\ncolumns = 4\n\
    warp = { pitch = 1.0, width = 0.6, height = 0.1 }\nweft = { pitch = 0.8, width = 0.5, height = 0.12 }\n";

fn plies(panel: &str, tables: &str) -> Result<Scene, String> {
    let text = format!("{PLIES}panel = {{ {panel} }}\n{tables}");
    Scene::parse("plies.toml", &text).map_err(|error| error.to_string())
}

fn sorted(mut nodes: Vec<[f64; 3]>) -> Vec<[f64; 3]> {
    let rounded = |node: &[f64; 3]| node.map(|x| (1e9 * x).round() as i64);
    nodes.sort_by_key(rounded);
    nodes
}

/// The plies lie one below another, each as far from the one above as it should be, turned by its angle.
#[test]
fn plies_lie_below_one_another_and_are_turned() {
    let tables = "[[ply]]\n[[ply]]\nangle = 30\ndistance = 0.25\n[[ply]]\nangle = -45\nweave.warp.height = 0.2\n";
    let scene = plies("shape = \"circle\", radius = 5.0", tables).expect("three plies");
    let model = scene.cloth.model();
    assert_eq!(model.plies(), 3);
    let of_ply = |ply: usize| model.yarns.iter().filter(move |yarn| yarn.ply == ply);
    let heights: Vec<[f64; 2]> = (0..3)
        .map(|ply| {
            let nodes = || of_ply(ply).flat_map(|yarn| &model.nodes[yarn.nodes.clone()]).map(|node| node[2]);
            [nodes().fold(f64::INFINITY, f64::min), nodes().fold(f64::NEG_INFINITY, f64::max)]
        })
        .collect();
    assert!((heights[0][0] - heights[1][1] - 0.25).abs() < 1e-12, "{heights:?}");
    assert!((heights[1][0] - heights[2][1] - 1e-3).abs() < 1e-12, "{heights:?}");
    assert_eq!(scene.cloth.clearance(), 1e-3);
    for (ply, angle) in [0.0_f64, 30.0, -45.0].into_iter().enumerate() {
        let (sin, cos) = angle.to_radians().sin_cos();
        for yarn in of_ply(ply) {
            let [along, across] =
                if yarn.family == Family::Warp { [[cos, sin], [-sin, cos]] } else { [[-sin, cos], [cos, sin]] };
            for element in yarn.elements.clone() {
                let [x, y, z] = model.fibre[element];
                assert!((x * across[0] + y * across[1]).abs() < 1e-12 && x * along[0] + y * along[1] > 0.5);
                assert!((x * x + y * y + z * z - 1.0).abs() < 1e-12);
            }
            let middle = |node: &[f64; 3]| node[0] * across[0] + node[1] * across[1] - yarn.coordinate;
            assert!(model.nodes[yarn.nodes.clone()].iter().all(|node| middle(node).abs() < 0.31));
        }
    }
    // A ply turned alone has the mesh of its own; the faces and the elements are its yarns'.
    for (number, yarn) in model.yarns.iter().enumerate() {
        let faces = &model.faces[yarn.faces.clone()];
        assert!(faces.iter().all(|face| yarn.elements.contains(&(face.element as usize))), "{number}");
        let nodes = faces
            .iter()
            .flat_map(|face| face.nodes)
            .chain(model.elements[yarn.elements.clone()].iter().flatten().copied());
        assert!(nodes.into_iter().all(|node| yarn.nodes.contains(&(node as usize))), "{number}");
    }
    for crossing in &model.crossings {
        let [warp, weft] = [&model.yarns[crossing.warp], &model.yarns[crossing.weft]];
        assert!(warp.ply == weft.ply && warp.family == Family::Warp && weft.family == Family::Weft);
    }
}

/// A quarter of plies at 0 and 90 degrees is the quarter of the whole ones.
#[test]
fn a_quarter_of_crossed_plies_is_one_of_the_whole() {
    let tables = "[[ply]]\n[[ply]]\nangle = 90\n[[ply]]\nangle = 180\n";
    for outline in ["shape = \"circle\", radius = 4.3", "shape = \"rectangle\", half = [3.0, 4.5]"] {
        let model =
            |part: &str| plies(&format!("{outline}, part = \"{part}\""), tables).expect("three plies").cloth.model();
        let [whole, quarter] = ["whole", "quarter"].map(model);
        let inside = |node: &&[f64; 3]| node[0] > -1e-9 && node[1] > -1e-9;
        let cut = sorted(whole.nodes.iter().filter(inside).copied().collect());
        let quarter = sorted(quarter.nodes);
        assert_eq!(cut.len(), quarter.len());
        let apart = cut.iter().zip(&quarter).flat_map(|(a, b)| [0, 1, 2].map(|i| (a[i] - b[i]).abs()));
        assert!(apart.fold(0.0, f64::max) < 1e-12);
    }
}

/// Yarns of a turned ply end where the rectangle does, within half an element.
#[test]
fn a_turned_ply_ends_at_the_outline_of_all() {
    let (half, step) = ([6.0, 4.0], 0.25);
    let scene = plies("shape = \"rectangle\", half = [6.0, 4.0]", "[[ply]]\nangle = 35\n").expect("a ply");
    let model = scene.cloth.model();
    // Across a yarn its ends are cut at right angles to it.
    let slack = 0.5 * step + 0.3;
    let beyond = |node: &[f64; 3]| (node[0].abs() - half[0]).max(node[1].abs() - half[1]);
    assert!(model.nodes.iter().all(|node| beyond(node) < slack));
    assert!(model.rim.iter().all(|&node| beyond(&model.nodes[node as usize]) > -slack - 0.1));
    let figures = scene.cloth.figures(&model)[0];
    let length = |family: Family| {
        let of = model.yarns.iter().filter(|yarn| yarn.family == family);
        of.map(|yarn| grid(yarn).layers as f64).sum::<f64>() * if family == Family::Warp { 0.2 } else { 0.25 }
    };
    let covered = [length(Family::Warp) * 1.0, length(Family::Weft) * 0.8];
    assert!(
        covered.iter().all(|area| (area / (4.0 * half[0] * half[1]) - 1.0).abs() < 0.05),
        "{covered:?} {figures:?}"
    );
}

#[test]
fn what_is_wrong_with_a_ply_is_named() {
    let circle = "shape = \"circle\", radius = 5.0";
    let quarter = "shape = \"circle\", radius = 5.0, part = \"quarter\"";
    for (panel, tables, message) in [
        (
            circle,
            "[[ply]]\ndistance = 0.1\n",
            "plies.toml:10: distance of the first [[ply]]; allowed: in those below it",
        ),
        (
            circle,
            "[[ply]]\n[[ply]]\ndistance = -0.1\n",
            "plies.toml:11: distance is -0.1; allowed: a finite number > 0",
        ),
        (circle, "[[ply]]\nangle = nan\n", "plies.toml:10: angle is NaN; allowed: a finite number"),
        (quarter, "[[ply]]\nangle = 45\n", "angle is 45 in a quarter; allowed: multiples of 90, or part = \"whole\""),
        (circle, "[[ply]]\nweave.panel.radius = 3.0\n", "allowed: these in [weave.panel], for all plies"),
        (circle, "[[ply]]\nweave.warp.width = 2.0\n", "plies.toml:10: warp.width is 2; allowed: up to"),
        (circle, "[[ply]]\nangel = 45\n", "unknown field `angel`"),
    ] {
        let error = plies(panel, tables).map(|_| ()).expect_err(message);
        assert!(error.contains(message), "{message}: {error}");
    }
}
