//! Scenes whose strength scatters: the keys, and what a mesh and a modulus change.

use crate::fabric;
use crate::fabric::strength::PanelStrength;
use crate::impact;
use crate::impact::outcome::Sample;
use crate::weave::geometry::Family;
use crate::weave::model::{Model, Piece};

const STRENGTH: &str = "cell = 0.8\nreference-length = 50.0\nweibull-modulus = 10.0\nstrain = 0.0458\n";

/// A short yarn that breaks, with these keys of `[scene]` and its tables.
fn yarn(keys: &str) -> Result<impact::scene::Scene, String> {
    let text = format!(
        "units = \"mm-g-ms\"\n[scene]\nhalf-length = 4.0\nheight = 0.115\nwidth = 0.5337\nlayers = 32\nrows = 2\ncolumns = 2\n\
         mass = 9.91e-3\nradius = 1.1\ncontact-stiffness = 1e6\nspeed = 300.0\nend = 0.006\n{keys}"
    );
    impact::scene::Scene::parse("yarn.toml", &text).map_err(|error| error.to_string())
}

fn history(keys: &str) -> Vec<Sample> {
    let scene = yarn(keys).expect("a scene");
    impact::run::run(&scene.cases[0], &mut ()).expect("it runs").run.history
}

/// A panel of this mesh, with these tables before `[scene]`.
fn panel(mesh: &str, tables: &str, strength: &str) -> Result<fabric::scene::Scene, String> {
    let text = format!(
        "units = \"mm-g-ms\"\n[weave]\npreset = \"kevlar-s706\"\nclearance = 0.005\n{mesh}\n[weave.panel]\nshape = \"circle\"\n\
         radius = 4.0\n{tables}\n[scene]\nspeed = 100.0\nmass = 0.02\nradius = 1.0\ncontact-stiffness = 1e5\nend = 1.0\n\
         failure = \"uniaxial\"\n[scene.strength]\n{strength}"
    );
    fabric::scene::Scene::parse("panel.toml", &text).map_err(|error| error.to_string())
}

/// The strength of each section of a panel's yarns, with where it begins; by ply, family and number.
type Sections = Vec<((usize, Family, i64), Vec<(f64, f64)>)>;

fn sections(mesh: &str, tables: &str) -> Sections {
    let scene = panel(mesh, tables, STRENGTH).expect("a scene");
    let case = &scene.cases[0];
    let model: Model = case.cloth.model();
    let strength = PanelStrength::of(case).expect("it scatters");
    let of = |yarn: &crate::weave::model::Yarn| {
        let back = case.cloth.plies()[yarn.ply].woven.panel.turn.back();
        let strengths = strength.strengths(&model, yarn);
        let start = |element: usize| {
            let [x, y, _] = model.nodes[model.elements[yarn.elements.start + element][0] as usize];
            back.rotate([x, y])[yarn.family as usize]
        };
        let of_piece = |piece: &Piece| -> Vec<(f64, f64)> {
            let (first, per) = (piece.first_element, piece.grid.elements_per_layer());
            let layer = |layer: usize| {
                let section = &strengths[first + layer * per..][..per];
                assert!(section.iter().all(|strength| *strength == section[0]));
                (start(first + layer * per), section[0])
            };
            (0..piece.grid.layers).map(layer).collect()
        };
        ((yarn.ply, yarn.family, yarn.number), yarn.pieces.iter().flat_map(of_piece).collect())
    };
    model.yarns.iter().map(of).collect()
}

/// Those of a yarn.
fn of_yarn(sections: &Sections, yarn: (usize, Family, i64)) -> Option<&[(f64, f64)]> {
    sections.iter().find(|(other, _)| *other == yarn).map(|(_, of)| &of[..])
}

#[test]
fn the_same_seed_gives_the_same_cells_on_every_mesh() {
    let plies = "[[ply]]\n[[ply]]\nangle = 30.0\n[[ply]]\nweave.panel.centre = \"gap\"\n";
    let coarse = sections("along = 4\ncolumns = 2\nrows = 1", plies);
    let fine = sections("along = 16\ncolumns = 2\nrows = 1", plies);
    let mut compared = 0;
    for (yarn, coarse) in &coarse {
        let fine = of_yarn(&fine, *yarn).expect("the same yarns");
        let length = coarse[1].0 - coarse[0].0;
        for (start, strength) in coarse {
            let inside = |place: f64| place > start - 1e-6 && place < start + length - 1e-6;
            let met: Vec<f64> =
                fine.iter().filter(|(place, _)| inside(*place)).map(|(_, strength)| *strength).collect();
            // The meshes do not end at the same places.
            if met.len() == 4 {
                assert_eq!(*strength, met.into_iter().fold(f64::INFINITY, f64::min), "{yarn:?} at {start}");
                compared += 1;
            }
        }
    }
    assert!(compared > 2000, "{compared}");
    // A yarn has several strengths, and others than its neighbour in the weave or in the ply below.
    let of = |ply, number| of_yarn(&coarse, (ply, Family::Warp, number)).expect("a yarn").iter().map(|of| of.1);
    assert!(of(0, 0).zip(of(0, 0).skip(1)).filter(|(a, b)| a != b).count() > 5);
    assert!(of(0, 0).zip(of(0, 2)).all(|(a, b)| a != b) && of(0, 0).zip(of(1, 0)).all(|(a, b)| a != b));
}

/// Where a panel is meshed coarsely a section has the least of those that it replaces; elsewhere nothing changes.
#[test]
fn a_coarse_part_has_the_cells_of_a_fine_one() {
    let mesh = "along = 4\ncolumns = 2\nrows = 1";
    let fine = sections(mesh, "");
    let [mut same, mut replaced] = [0; 2];
    for (yarn, partly) in sections(mesh, "coarse-radius = 2.0\ncoarse-rows = 1\n") {
        let fine = of_yarn(&fine, yarn).expect("the same yarns");
        // Without the first and the last section, since the meshes do not end at the same places.
        for pair in partly.windows(2).skip(1) {
            let inside = |place: f64| place > pair[0].0 - 1e-6 && place < pair[1].0 - 1e-6;
            let met: Vec<f64> =
                fine.iter().filter(|(place, _)| inside(*place)).map(|(_, strength)| *strength).collect();
            assert_eq!(pair[0].1, met.iter().copied().fold(f64::INFINITY, f64::min), "{yarn:?} at {}", pair[0].0);
            same += usize::from(met.len() == 1);
            replaced += usize::from(met.len() > 1);
        }
    }
    assert!(same > 100 && replaced > 100, "{same} {replaced}");
}

#[test]
fn a_quarter_has_the_cells_of_the_whole() {
    let mesh = "along = 4\ncolumns = 2\nrows = 1";
    let whole = sections(mesh, "");
    for (yarn, quarter) in sections(mesh, "part = \"quarter\"") {
        let whole = of_yarn(&whole, yarn).expect("the same yarns");
        assert!(quarter.iter().all(|section| whole.contains(section)), "{yarn:?}");
    }
}

#[test]
fn without_scatter_the_run_is_that_of_the_property_to_the_bit() {
    let even = "[scene.strength]\ncell = 1.0\nreference-length = 50.0\nweibull-modulus = inf\n";
    for precision in ["f64", "f32"] {
        let keys = |failure: &str| format!("precision = \"{precision}\"\nfailure = \"{failure}\"\n");
        let plain = history(&keys("uniaxial"));
        assert!(plain.last().is_some_and(|sample| sample.deleted > 0));
        assert_eq!(history(&format!("{}{even}strain = 0.0458\n", keys("uniaxial"))), plain);
        // The limit of a point's own is the property's, but for the last digit of a logarithm.
        let other = "hyperelastic.properties = { eps_lim = 0.04 }\n";
        let [own, property] =
            [format!("{}{even}strain = 0.04\n", keys("multiaxial")), format!("{}{other}", keys("multiaxial"))]
                .map(|keys| history(&keys));
        assert_ne!(own, history(&keys("multiaxial")));
        let speeds = |history: &[Sample]| history.iter().map(|sample| sample.speed).collect::<Vec<_>>();
        let apart = speeds(&own).iter().zip(speeds(&property)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-3 * 300.0, "{apart}");
    }
}

/// As above, of the linear elastic law, whose strength is a stress.
#[test]
fn the_linear_elastic_law_s_strength_scatters_too() {
    let keys = |table: &str| format!("law = \"linear-elastic\"\nfailure = \"uniaxial\"\n{table}");
    let plain = yarn(&keys("")).expect("a scene");
    let stress = plain.cases[0].zones.inner().strength();
    assert!(stress > 3000.0, "{stress}");
    let of = |modulus: &str, stress: f64| {
        let strength =
            format!("cell = 0.8\nreference-length = 50.0\nweibull-modulus = {modulus}\nstress = {stress:?}\n");
        history(&keys(&format!("[scene.strength]\n{strength}")))
    };
    let property = history(&keys(""));
    assert!(property.last().is_some_and(|sample| sample.deleted > 0));
    assert_eq!(of("inf", stress), property);
    let weaker = format!("linear-elastic.properties = {{ sigma_lim = {:?} }}\n", 0.9 * stress);
    assert_eq!(of("inf", 0.9 * stress), history(&keys(&weaker)));
    assert_ne!(of("10.0", stress), property);
    for (table, message) in [
        ("strain = 0.04", "strain with the linear elastic law, which fails at a stress; allowed: stress"),
        ("stress = 3e3\nelastic-modulus = 8e4", "elastic-modulus with the linear elastic law"),
    ] {
        let table = format!("[scene.strength]\ncell = 0.8\nreference-length = 1.0\nweibull-modulus = 9.0\n{table}\n");
        let error = yarn(&keys(&table)).map(|_| ()).expect_err(message);
        assert!(error.contains(message), "{message}: {error}");
    }
}

/// A weaker yarn breaks earlier; the weakest element of all says so.
#[test]
fn a_seed_moves_the_break() {
    let keys = |seed: u64| format!("failure = \"uniaxial\"\n[scene.strength]\nseed = {seed}\n{STRENGTH}");
    let scene = |seed| yarn(&keys(seed)).expect("a scene");
    let weakest = |seed: u64| {
        let case = &scene(seed).cases[0];
        let limits = case.limits(&case.yarn.mesh()).expect("it scatters");
        limits.into_iter().fold(f64::INFINITY, f64::min)
    };
    let failed = |seed: u64| {
        let scene = scene(seed);
        impact::run::run(&scene.cases[0], &mut ()).expect("it runs").run.failed.expect("it breaks")
    };
    let (seeds, mut by_strength): (Vec<u64>, Vec<(f64, f64)>) = ((1..9).collect(), Vec::new());
    by_strength.extend(seeds.iter().map(|&seed| (weakest(seed), failed(seed))));
    by_strength.sort_by(|a, b| a.0.total_cmp(&b.0));
    let [weak, strong] = [by_strength[0], by_strength[7]];
    assert!(strong.0 > 1.1 * weak.0 && strong.1 > weak.1, "{by_strength:?}");
    // Each strain stays at its limit's scale: ln(1 + ε) of a cell of 0.8 mm is larger than that of 50 mm.
    assert!(weak.0 > 0.03 && strong.0 < 0.1, "{by_strength:?}");
}

#[test]
fn a_case_has_its_own_keys_over_the_scene_s() {
    let text = format!(
        "failure = \"uniaxial\"\n[scene.strength]\n{STRENGTH}\n[[case]]\nname = \"one\"\n[[case]]\nname = \"two\"\n\
         strength = {{ weibull-modulus = 20.0, stress = 3637.0, elastic-modulus = 79414.0, seed = 7 }}\n\
         [[case]]\nname = \"three\"\nfailure = \"none\"\n"
    );
    let scene = yarn(&text).expect("three cases");
    let [one, two, three] = [0, 1, 2].map(|case| scene.cases[case].strength);
    assert_eq!(three, None);
    let (one, two) = (one.expect("a strength"), two.expect("a strength"));
    assert_eq!((one.field.seed, two.field.seed, one.field.cell, two.field.cell), (1, 7, 0.8, 0.8));
    assert_eq!((one.laws[0].modulus, one.laws[0].scale), (10.0, 0.0458));
    assert_eq!((two.laws[0].modulus, two.laws[0].scale), (20.0, 3637.0 / 79414.0));
    // A modulus of the scene's stress is none of a case's strain, nor of one whose law fails at the stress.
    let stress =
        "cell = 0.8\nreference-length = 50.0\nweibull-modulus = 10.0\nstress = 3637.0\nelastic-modulus = 79414.0\n";
    let cases = |keys: &str| {
        let scene = format!("failure = \"uniaxial\"\n[scene.strength]\n{stress}[[case]]\nname = \"one\"\n{keys}\n");
        yarn(&scene).map(|scene| scene.cases[0].strength.expect("a strength").laws[0].scale)
    };
    assert_eq!(cases("strength = { seed = 2 }"), Ok(3637.0 / 79414.0));
    assert_eq!(cases("strength = { strain = 0.04 }"), Ok(0.04));
    assert_eq!(cases("strength = { stress = 3000.0 }"), Ok(3000.0 / 79414.0));
    assert_eq!(cases("law = \"linear-elastic\""), Ok(3637.0));
    let error = cases("law = \"linear-elastic\"\nstrength = { elastic-modulus = 8e4 }").expect_err("a modulus");
    assert!(error.contains("elastic-modulus with the linear elastic law"), "{error}");
    let families =
        panel("along = 4\ncolumns = 2", "", &format!("{STRENGTH}weft = {{ strain = 0.04 }}\n")).expect("a scene");
    let laws = families.cases[0].strength.expect("a strength").laws;
    assert_eq!((laws[0].scale, laws[1].scale, laws[1].modulus), (0.0458, 0.04, 10.0));
    // Warp and weft are called as the file calls them, also where a quarter exchanges them.
    let turned = "part = \"quarter\"\n[[ply]]\n[[ply]]\nangle = 90.0\n";
    let scene =
        panel("along = 4\ncolumns = 2", turned, &format!("{STRENGTH}weft = {{ strain = 0.9 }}\n")).expect("a scene");
    let case = &scene.cases[0];
    let (model, strength) = (case.cloth.model(), PanelStrength::of(case).expect("it scatters"));
    for yarn in &model.yarns {
        let strong = (yarn.family == Family::Weft) == (yarn.ply == 0);
        assert_eq!(strength.strengths(&model, yarn)[0] > 0.3, strong, "{} {:?}", yarn.ply, yarn.family);
    }
}

#[test]
fn bad_input_is_named() {
    let with = |from: &str, to: &str| {
        let text = format!("failure = \"uniaxial\"\n[scene.strength]\n{}", STRENGTH.replace(from, to));
        yarn(&text).map(|_| ()).expect_err(to)
    };
    for (from, to, message) in [
        ("modulus = 10.0", "modulus = 1.0", "yarn.toml:18: weibull-modulus is 1; allowed: a number > 1, or inf"),
        ("modulus = 10.0", "modulus = nan", "weibull-modulus is NaN; allowed: a number > 1, or inf"),
        ("weibull-modulus = 10.0\n", "", "weibull-modulus is missing; allowed: a number > 1, or inf"),
        ("cell = 0.8", "cell = 0.0", "cell is 0; allowed: the length over which the strength of a yarn is one"),
        (
            "cell = 0.8",
            "cell = 9.0",
            "cell is 9; allowed: the length over which the strength of a yarn is one, a number > 0 up to that of the longest yarn, 8",
        ),
        ("cell = 0.8", "cell = 1e-7", "cell is 0.0000001, of which the yarns have 8e7; allowed: 8.000e-7 or more"),
        ("cell = 0.8\n", "", "cell is missing; allowed: the length over which"),
        ("= 50.0", "= -50.0", "reference-length is -50.0; allowed: a finite number > 0"),
        ("reference-length = 50.0\n", "", "reference-length is missing; allowed: the length that the scale is of"),
        ("strain = 0.0458", "strain = -0.0458", "strain is -0.0458; allowed: a finite number > 0"),
        ("strain = 0.0458", "strain = 4.58", "strain is 4.58; allowed: a number > 0 up to 1 (4.58 % is 0.0458)"),
        (
            "strain = 0.0458",
            "stress = 3637.0",
            "stress without elastic-modulus; allowed: strain, or stress and the modulus",
        ),
        ("strain = 0.0458", "", "the scale of the strength is missing; allowed: strain, or stress and elastic-modulus"),
        ("strain = 0.0458", "strain = 0.04\nstress = 3e3", "strain and stress; allowed: one of them"),
        (
            "strain = 0.0458",
            "strain = 0.04\nelastic-modulus = 8e4",
            "elastic-modulus beside strain; allowed: beside stress",
        ),
        (
            "strain = 0.0458",
            "stress = 8e4\nelastic-modulus = 3e3",
            "stress is 80000; allowed: up to elastic-modulus, 3000",
        ),
        ("cell = 0.8", "cell = 0.8\nseed = -1", "seed is -1; allowed: a whole number >= 0"),
        (
            "cell = 0.8",
            "cell = 0.8\nweft = {}",
            "warp or weft in the strength of one yarn; allowed: their keys in the table",
        ),
    ] {
        let error = with(from, to);
        assert!(error.contains(message), "{message}: {error}");
    }
    for (keys, message) in [
        ("", "strength of what does not fail; allowed: with failure = \"uniaxial\" or \"multiaxial\""),
        (
            "failure = \"uniaxial\"\nhyperelastic.properties = { eps_lim = 0.0 }\n",
            "eps_lim is 0, with which nothing fails",
        ),
        (
            "failure = \"uniaxial\"\nlaw = \"hybrid\"\nhyperelastic-length = 1.0\n",
            "strength with law = \"hybrid\"; allowed:",
        ),
    ] {
        let error = yarn(&format!("{keys}[scene.strength]\n{STRENGTH}")).map(|_| ()).expect_err(message);
        assert!(error.contains(message), "{message}: {error}");
    }
    let plies = "[[ply]]\n[[ply]]\nmaterial.properties.k_el = 2e4\n";
    let error = panel("along = 4\ncolumns = 2", plies, STRENGTH).map(|_| ()).expect_err("two materials");
    assert!(error.contains("strength of plies whose yarns differ in their material; allowed:"), "{error}");
    let short = STRENGTH.replace("0.8", "8.2");
    let error = panel("along = 4\ncolumns = 2", "", &short).map(|_| ()).expect_err("too long a cell");
    assert!(error.contains("up to that of the longest yarn, 8.1"), "{error}");
}
