//! A yarn that is drawn through a patch, beside the formulas for ropes; the example scenes.

use nalgebra::Vector3;

use super::scene::{Case, Scene};
use super::solver;
use crate::weave::geometry::Family;
use crate::weave::model::Yarn;
use toron_explicit_host::body::{Body, Support};
use toron_explicit_host::solver::{Ramp, Solver};
use toron_materials::material::model::Law;

/// A warp yarn and the five weft yarns that it crosses, which do not move.
fn patch(friction: f64) -> (Vec<Yarn>, Solver<f64>) {
    let text = format!(
        "units = \"mm-g-ms\"\n[weave]\npreset = \"kevlar-s706\"\nalong = 8\ncolumns = 4\n\
         [weave.panel]\nshape = \"rectangle\"\nhalf = [2.0, 0.35]\n\
         [scene]\nspeed = 1.0\nmass = 0.03\nradius = 1.0\ncontact-stiffness = 1e5\nend = 1.0\n\
         yarn-friction = {friction}\nhyperelastic.properties = {{ k_ld = 126.0 }}\n"
    );
    let scene = Scene::parse("patch.toml", &text).expect("a scene");
    let panel = scene.cases[0].cloth.model();
    let mut solver = solver::build(&scene.cases[0], &panel).expect("a panel");
    solver.striker = None;
    assert_eq!((panel.crossings.len(), solver.bodies.len()), (5, 6));
    (panel.yarns, solver)
}

/// The directions of a yarn's middle line from section to section, as angles over the panel.
fn slopes(yarn: &Yarn, body: &Body<f64>) -> Vec<f64> {
    let grid = yarn.pieces[0].grid;
    let per = grid.nodes_per_section();
    let middle = |section: usize| -> Vector3<f64> {
        let nodes = section * per..(section + 1) * per;
        nodes.map(|node| Vector3::from(body.position(node))).sum::<Vector3<f64>>() / per as f64
    };
    let slope = |layer: usize| {
        let along = middle(layer + 1) - middle(layer);
        along.z.atan2(along.x)
    };
    (0..grid.layers).map(slope).collect()
}

/// What acts on a body's nodes.
fn force(body: &Body<f64>, nodes: std::ops::Range<usize>) -> Vector3<f64> {
    body.forces[nodes].iter().map(|&force| Vector3::from(force)).sum()
}

/// What is measured while the yarn slides through the patch.
struct Pull {
    /// The forces at the held and at the pulled end.
    ends: [f64; 2],
    /// The angle by which the yarn turns, over all crossings.
    turn: f64,
    /// The force on the middle weft yarn across the panel, and the steepest slope of the warp.
    pressing: f64,
    steepest: f64,
    friction: f64,
}

/// Holds one end of the warp yarn, pulls the other one, and waits until it slides in every crossing.
fn pull(friction: f64) -> Pull {
    let (yarns, mut solver) = patch(friction);
    let held = |velocity: [f64; 3]| Support { free: [false; 3], velocity };
    let (warp, per) = (&yarns[0], yarns[0].pieces[0].grid.nodes_per_section());
    let last = solver.bodies[0].mesh.nodes.len() - per;
    for node in 0..per {
        solver.bodies[0].support(node, held([0.0; 3]));
        solver.bodies[0].support(last + node, held([0.1, 0.0, 0.0]));
    }
    for body in &mut solver.bodies[1..] {
        (0..body.mesh.nodes.len()).for_each(|node| body.support(node, held([0.0; 3])));
    }
    solver.ramp = Some(Ramp { start: 0.0, duration: 0.04, brake: [1e3; 2] });
    while solver.state.time < 0.03 {
        solver.accelerate(false, 1.0).expect("stable");
        solver.displace();
    }
    solver.accelerate(true, 1.0).expect("stable");
    let slopes = slopes(warp, &solver.bodies[0]);
    let middle = &solver.bodies[3];
    Pull {
        ends: [0, last].map(|first| force(&solver.bodies[0], first..first + per).norm()),
        turn: slopes.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum(),
        pressing: force(middle, 0..middle.mesh.nodes.len()).z.abs(),
        steepest: slopes[slopes.len() / 4..3 * slopes.len() / 4].iter().fold(0.0, |most, slope| slope.abs().max(most)),
        friction: solver.state.energies.friction,
    }
}

/// The yarn that is drawn presses each crossing by its force and its slope on both sides.
#[test]
fn a_crossing_is_pressed_by_the_slope_of_the_yarn_that_is_drawn() {
    let Pull { ends, pressing, steepest, friction, .. } = pull(0.0);
    let expected = 2.0 * ends[0] * steepest.sin();
    assert!(ends[0] > 1.0 && (pressing / expected - 1.0).abs() < 0.05, "{pressing} {expected} {steepest}");
    // Nothing rubs: what contacts lose where nodes leave a face, 1.05e-3.
    assert!((0.0..1.3e-3).contains(&friction), "{friction:e}");
}

/// With friction the ratio of the forces at the ends is no less than that of a rope over as many capstans, exp(μθ), θ
/// being the angle by which the yarn turns over all crossings: a yarn has a stiffness against bending, which presses
/// the crossings as well.
#[test]
fn a_yarn_is_pulled_out_of_a_patch_against_more_than_a_rope_s_friction() {
    const FRICTION: f64 = 0.18;
    let [smooth, rough] = [0.0, FRICTION].map(pull);
    let found = (rough.ends[1] / rough.ends[0]) / (smooth.ends[1] / smooth.ends[0]);
    let rope = (FRICTION * rough.turn).exp();
    assert!(rough.turn > 1.0 && found > rope && found < 1.5 * rope, "{found} {rope} {}", rough.turn);
    assert!(rough.friction > 100.0 * smooth.friction, "{} {}", rough.friction, smooth.friction);
}

#[test]
fn every_example_is_valid() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/fabric_impact");
    let mut cases = 0;
    for file in std::fs::read_dir(folder).expect("there are scenes") {
        let path = file.expect("the folder can be read").path();
        if path.is_dir() || path.ends_with("weave.toml") {
            continue;
        }
        let scene = Scene::read(&path).unwrap_or_else(|error| panic!("{error}"));
        // No case is another one by mistake.
        let mut texts: Vec<String> =
            scene.cases.iter().map(|case| format!("{:?}", Case { name: String::new(), ..case.clone() })).collect();
        texts.sort();
        texts.dedup();
        assert_eq!(texts.len(), scene.cases.len(), "{}", path.display());
        cases += scene.cases.len();
    }
    assert!(cases > 25, "{cases}");
}

#[test]
fn a_panel_is_in_single_precision_unless_it_says_otherwise() {
    let is_single = |key: &str| {
        let text = format!(
            "units = \"mm-g-ms\"\n[weave]\npreset = \"kevlar-s706\"\nalong = 4\ncolumns = 4\n\
             [weave.panel]\nshape = \"circle\"\nradius = 2.0\npart = \"whole\"\n\
             [scene]\nspeed = 100.0\nmass = 0.01\nradius = 0.8\ncontact-stiffness = 1e5\nend = 1.0\n{key}\n"
        );
        Scene::parse("scene.toml", &text).expect("a scene").cases[0].single_precision
    };
    let found = ["", "precision = \"f32\"", "precision = \"f64\""].map(is_single);
    assert_eq!(found, [true, true, false]);
}

/// A sphere that is smaller than the distance of nodes meets the one inside a yarn that it stands around.
#[test]
fn the_sphere_meets_what_stands_inside_a_yarn() {
    let text = "units = \"mm-g-ms\"\n[weave]\npreset = \"kevlar-s706\"\nalong = 4\ncolumns = 4\n\
         [weave.panel]\nshape = \"circle\"\nradius = 2.0\npart = \"quarter\"\n\
         [scene]\nspeed = 1.0\nmass = 2e-6\nradius = 0.04\ncontact-stiffness = 1e5\nend = 1.0\nfriction = 0.0\n";
    let scene = Scene::parse("patch.toml", text).expect("a scene");
    let panel = scene.cases[0].cloth.model();
    let mut solver = solver::build::<f64>(&scene.cases[0], &panel).expect("a panel");
    let sphere = solver.striker.as_mut().expect("it is there");
    // The heights of the nodes on the axis, three of each of the two yarns that cross there.
    let mut heights: Vec<f64> = panel.nodes.iter().filter(|[x, y, _]| x.hypot(*y) < 1e-9).map(|node| node[2]).collect();
    heights.sort_by(f64::total_cmp);
    assert_eq!(heights.len(), 6);
    // Those in the middle of each.
    for height in [heights[1], heights[4]] {
        // A little above the node, which it presses down.
        (sphere.position, sphere.moved) = (height + 0.01, 100.0);
        sphere.meet(&mut solver.bodies, 0.0);
        // A quarter of what belongs to the node: a pitch over 4 along the yarn, its width over 4 across it.
        let area = 0.25 * (25.4 / 34.0 / 4.0) * (0.5337 / 4.0);
        let expected = 1e5 * area * 0.03;
        assert!((sphere.force / expected - 1.0).abs() < 0.2, "{height}: {} {expected}", sphere.force);
    }
}

/// A small quarter under a small sphere, with these plies.
fn plies(tables: &str, law: &str) -> Result<Scene, String> {
    let text = format!(
        "units = \"mm-g-ms\"\n[weave]\npreset = \"kevlar-s706\"\nalong = 4\ncolumns = 4\nclearance = 0.005\n\
         [weave.panel]\nshape = \"rectangle\"\nhalf = [2.3, 2.3]\npart = \"quarter\"\n{tables}\
         [scene]\nspeed = 100.0\nmass = 0.02\nradius = 1.0\ncontact-stiffness = 1e5\nend = 1.0\n{law}"
    );
    Scene::parse("plies.toml", &text).map_err(|error| error.to_string())
}

/// The sphere's speed at these times, in µs.
fn speeds(tables: &str, times: &[f64]) -> Vec<f64> {
    let scene = plies(tables, "hyperelastic.properties = { k_ld = 126.0 }\n").expect("a scene");
    let case = &scene.cases[0];
    let panel = case.cloth.model();
    solver::check(case, &panel).expect("a scene that can run");
    let mut solver: Solver<f64> = solver::build(case, &panel).expect("a panel");
    let mut speeds = Vec::new();
    for time in times {
        while solver.state.time < 1e-3 * time {
            solver.accelerate(false, 1.0).expect("stable");
            solver.displace();
        }
        speeds.push(-solver.striker.as_ref().expect("a sphere").velocity);
    }
    speeds
}

/// A ply that is not reached yet changes nothing; one that lies close below takes its part.
#[test]
fn a_ply_counts_from_when_it_is_touched() {
    let times = [1.5, 8.0];
    let [one, far, near] =
        ["", "[[ply]]\n[[ply]]\ndistance = 0.3\n", "[[ply]]\n[[ply]]\ndistance = 0.005\nangle = 90\n"]
            .map(|tables| speeds(tables, &times));
    assert!((one[0] / far[0] - 1.0).abs() < 1e-9, "{one:?} {far:?}");
    assert!((one[1] / far[1] - 1.0).abs() > 1e-3, "{one:?} {far:?}");
    let [of_one, of_both] = [100.0 - one[1], 100.0 - near[1]];
    assert!(of_both > 1.3 * of_one && of_both < 2.1 * of_one, "{one:?} {near:?}");
}

/// A plain weave struck beside a crossing is its own mirror image; another place is another strike, and a quarter has
/// but one.
#[test]
fn a_panel_is_struck_where_it_is_aimed_at() {
    let struck = |aim: &str, part: &str| {
        let text = format!(
            "units = \"mm-g-ms\"\n[weave]\npreset = \"kevlar-s706\"\nalong = 4\ncolumns = 4\n\
             [weave.panel]\nshape = \"rectangle\"\nhalf = [1.6, 1.6]\npart = \"{part}\"\n\
             [scene]\nspeed = 100.0\nmass = 0.01\nradius = 0.8\ncontact-stiffness = 1e5\nend = 1.0\naim = {aim}\n\
             hyperelastic.properties = {{ k_ld = 126.0 }}\n"
        );
        Scene::parse("aim.toml", &text).map_err(|error| error.to_string())
    };
    let speed = |aim: &str| {
        let scene = struck(aim, "whole").expect("a scene");
        let case = &scene.cases[0];
        let mut solver: Solver<f64> = solver::build(case, &case.cloth.model()).expect("a panel");
        // Shorter than stable: the estimate of the stable step begins with noise, which is no mirror image.
        solver.longest = 5e-6;
        while solver.state.time < 2e-3 {
            solver.accelerate(false, 1.0).expect("stable");
            solver.displace();
        }
        let sphere = solver.striker.as_ref().expect("a sphere");
        (-sphere.velocity, sphere.position)
    };
    let [one, mirrored, centre] = ["[0.2, 0.3]", "[-0.2, 0.3]", "[0, 0]"].map(speed);
    assert!(one.0 < 99.9, "{one:?}");
    assert!((one.0 / mirrored.0 - 1.0).abs() < 1e-9 && (one.1 - mirrored.1).abs() < 1e-9, "{one:?} {mirrored:?}");
    assert!((one.1 - centre.1).abs() > 1e-3, "{one:?} {centre:?}");
    for (aim, part, message) in [
        ("[0.2, 0.3]", "quarter", "aim is [0.2, 0.3]; allowed: with part = \"whole\""),
        ("[nan, 0]", "whole", "aim is [NaN, 0]; allowed: within the panel's outline, x from -1.600 to 1.600 and y"),
        ("[0, -1.7]", "whole", "aim is [0, -1.7]; allowed: within the panel's outline"),
        ("[0.2]", "whole", "aim is [0.2]; allowed: a list of 2 numbers"),
    ] {
        let error = struck(aim, part).map(|_| ()).expect_err(message);
        assert!(error.contains(message), "{message}: {error}");
    }
    let mut scene = struck("[1.6, 1.6]", "whole").expect("a corner of the outline");
    scene.cases[0].striker.aim = [9.0, 0.0];
    let outside = solver::check(&scene.cases[0], &scene.cases[0].cloth.model()).expect_err("nothing lies there");
    assert!(outside.to_string().contains("aim"), "{outside}");
}

/// The yarns of a ply are of the ply's material, which its own families' go before, and those before the weave's.
#[test]
fn plies_have_materials_of_their_own() {
    let tables = "[weave.weft]\nmaterial.properties.k_el = 3e4\n[[ply]]\n[[ply]]\nmaterial.properties.k_el = 2e4\n\
                  weave.warp.material.properties.k_el = 1e4\n[[ply]]\nmaterial.properties.k_el = 4e4\nangle = 90\n\
                  weave.weft.material.properties.k_el = 5e4\n";
    let scene = plies(tables, "").expect("three plies");
    let case = &scene.cases[0];
    let stiffness = |ply: usize, family: Family| match &case.material(ply, family).law {
        Law::Hyperelastic { properties, .. } => properties.k_el,
        law => panic!("{law:?}"),
    };
    let found: Vec<[f64; 2]> = (0..3).map(|ply| Family::BOTH.map(|family| stiffness(ply, family))).collect();
    assert_eq!(found, [[82341.0, 3e4], [1e4, 2e4], [5e4, 4e4]]);
    let own: Vec<Option<usize>> =
        (0..3).flat_map(|ply| Family::BOTH.map(|family| case.own_material(ply, family))).collect();
    assert_eq!(own, [None, Some(1), Some(2), Some(3), Some(4), Some(5)]);
    let materials: Vec<_> = case.materials().collect();
    for (ply, family) in case.families_with_materials() {
        let place = case.own_material(ply, family).expect("one of its own");
        assert!(std::ptr::eq(materials[place], case.material(ply, family)));
    }
    assert!(case.material_names().contains("ply-2-weft"), "{}", case.material_names());
    for (tables, law, message) in [
        ("[[ply]]\nmaterial.preset = \"kevlar\"\n", "", "plies.toml:"),
        (
            "[[ply]]\nmaterial = {}\n",
            "law = \"hybrid\"\nhyperelastic-radius = 1.0\n",
            "or of a ply, with law = \"hybrid\"",
        ),
        ("", "[[scene.ply]]\n", "ply in [scene]; allowed: [[ply]], or in a [[case]]"),
    ] {
        let error = plies(tables, law).map(|_| ()).expect_err(message);
        assert!(error.contains(message), "{message}: {error}");
    }
    let cases =
        plies("", "[[case]]\nname = \"one\"\n[[case]]\nname = \"two\"\nply = [{}, { angle = 90 }]\n").expect("cases");
    assert_eq!(cases.cases.iter().map(|case| case.cloth.plies().len()).collect::<Vec<_>>(), [1, 2]);
}
