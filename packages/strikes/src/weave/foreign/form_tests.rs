//! Each legal form of a file against the plain one, and what is refused.

use std::fmt::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::reader::Foreign;
use super::tests::{Cross, LAYERS, SECTION, check, read, refused};
use crate::weave::vtu;

/// The panel of these files is that of the plain one, to rounding where a motion has one.
#[track_caller]
fn same(name: &str, files: &[(&str, &str)], plain: &Foreign) {
    let found = read(name, files, "").unwrap_or_else(|error| panic!("{name}: {error}"));
    check(&found);
    let of = |foreign: &Foreign| {
        foreign.model.nodes.iter().chain(&foreign.model.fibre).flatten().copied().collect::<Vec<f64>>()
    };
    let apart = of(&found).iter().zip(of(plain)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(apart < 1e-12, "{name}: {apart}");
    assert_eq!(found.model.elements, plain.model.elements, "{name}");
}

/// The lines of a text, where those behind a keyword are changed.
fn changed(text: &str, keyword: &str, change: impl Fn(&str) -> String) -> String {
    let mut inside = false;
    let mut line = |line: &str| {
        if line.starts_with('*') {
            inside = line.to_lowercase().starts_with(keyword);
            line.to_string()
        } else if inside {
            change(line)
        } else {
            line.to_string()
        }
    };
    text.lines().map(|text| line(text) + "\n").collect()
}

/// The text before a keyword, and from there.
fn split<'a>(text: &'a str, keyword: &str) -> (&'a str, &'a str) {
    text.split_at(text.find(keyword).expect(keyword))
}

#[test]
fn legal_forms_of_abaqus_give_the_plain_panel() {
    let text = Cross::new(0.01).abaqus("");
    let plain = read("plain-inp", &[("cross.inp", &text)], "").expect("a panel");
    let legal = |name: &str, text: &str| same(name, &[("cross.inp", text)], &plain);
    legal("bom", &format!("\u{feff}{text}"));
    legal("windows", &text.replace('\n', "\r\n"));
    legal("old-mac", &text.replace('\n', "\r"));
    legal("lower-case", &text.to_lowercase());
    legal(
        "blanks",
        &text
            .replace("*Node", "*  NODE")
            .replace("*Element, Type=", "*ELEMENT ,\tType =  ")
            .replace("*Solid Section", "*SOLIDSECTION"),
    );
    legal(
        "continued",
        &text.replace("*Element, Type", "*Element,\n** a comment\n  Type").replace("Section, ElSet", "Section,\nElSet"),
    );
    legal("quoted", &text.replace("Yarn0", "\"yarn, no. 0\"").replace("Yarn1", "\"Yarn=1\""));
    legal("blank-lines", &text.replace("*Node\n", "*Node\n\n").replace("*ElSet", "\n*ElSet"));
    legal("commas", &changed(&text, "*node", |line| format!("{line},")));
    legal(
        "blank-coordinates",
        &changed(&text, "*node", |line| line.strip_suffix(", 0").map_or(line.to_string(), |line| format!("{line}, "))),
    );
    legal("short-nodes", &changed(&text, "*node", |line| line.strip_suffix(", 0").unwrap_or(line).to_string()));
    legal("normals", &changed(&text, "*node", |line| format!("{line}, 0., 0., 1.")));
    let halves = |comma: &str| {
        changed(&text, "*element", |line| {
            let place = line.match_indices(',').nth(3).expect("four fields").0;
            format!("{}{comma}\n  {}", &line[..place], &line[place + 1..])
        })
    };
    legal("two-lines", &halves(","));
    legal("two-lines-without-comma", &halves(""));
    let exponents = |line: &str| {
        line.split(", ")
            .enumerate()
            .map(|(i, field)| {
                if i == 0 {
                    field.to_string()
                } else {
                    format!("{field}{}d0", if field.contains('.') { "" } else { "." })
                }
            })
            .collect::<Vec<_>>()
            .join(", ")
    };
    legal("fortran", &changed(&text, "*node", exponents));
    // Sets before what they name, by steps, and of sets.
    let (before, sets) = split(&text, "*ElSet");
    let (heading, mesh) = split(before, "*Node");
    legal("sets-first", &format!("{heading}{sets}{mesh}"));
    legal(
        "set-of-sets",
        &text.replace(
            "ElSet=Yarn0, Generate\n1, 18",
            "ElSet=Yarn0\nodd, even\n*ElSet, ElSet=Odd, Generate\n1, 18, 2\n*ElSet, ElSet=Even, Generate\n2, 18, 2",
        ),
    );
    legal("range-beyond", &text.replace("55, 72", "55, 1000000000000"));
    // What is beside a mesh in a deck.
    let beside = "*Material, name=M\n*Density\n1e-9,\n*Elastic, type=ENGINEERING CONSTANTS\n1, 2, 3, 4, 5, 6, 7, 8,\n9,\n*User Material, constants=2\n1, 2\n\
                  *Nset, nset=all, generate\n1, 168\n*Surface, type=ELEMENT, name=s\nYarn0, S1\n*Boundary\nall, 1\n*Transform, nset=all\n1., 0., 0., 0., 1., 0.\n\
                  *Surface Interaction, name=c\n*Friction\n0.1,\n*Amplitude, name=a, input=none.inp\n*Initial Conditions, type=SOLUTION, input=none.eld\n\
                  *Step, nlgeom=YES\n*Dynamic, Explicit\n, 1.\n*Contact\n*Output, field\n*Node Output\nU\n*Element Output\nS\n*End Step\n";
    legal("deck", &format!("*Preprint, echo=NO\n{text}{beside}"));
    let rigid = "*Node, nset=ball\n900, 9., 9., 9.\n901, 9., 9., 8.\n902, 9., 8., 9.\n*Element, type=R3D3, elset=ball\n900, 900, 901, 902\n\
                 *Element, type=MASS, elset=weight\n901, 900\n*Mass, elset=weight\n1.0,\n*Rigid Body, ref node=900, elset=ball\n";
    legal("rigid", &format!("{text}{rigid}"));
}

#[test]
fn yarns_are_told_by_sections_or_sets() {
    let text = Cross::new(0.01).abaqus("");
    let plain = read("told-inp", &[("cross.inp", &text)], "").expect("a panel");
    let sets: String = changed(&text, "*solid", |_| "**".to_string()).replace("*Solid Section", "** ");
    same("meshio", &[("cross.inp", &sets)], &plain);
    // Gmsh writes surfaces and lines too, all in sets of their own.
    let (before, elements) = split(&text, "*Element");
    let yarn =
        |line: &str| (line.split(',').next().expect("a number").parse::<usize>().expect("a number") - 1) / (LAYERS * 3);
    let mut of_yarns =
        vec![["*ELEMENT, type=C3D6, ELSET=Volume", "*ELEMENT, type=C3D8, ELSET=Volume"].map(String::from); 4];
    of_yarns.iter_mut().enumerate().for_each(|(i, two)| two.iter_mut().for_each(|text| *text += &format!("{i}\n")));
    for line in elements.lines().take_while(|line| !line.starts_with("*ElSet")).filter(|line| !line.starts_with('*')) {
        let _ = writeln!(of_yarns[yarn(line)][usize::from(line.split(',').count() == 9)], "{line}");
    }
    let volumes: String = of_yarns.iter().flatten().map(String::as_str).collect();
    let gmsh = format!(
        "{before}******* E L E M E N T S *************\n*ELEMENT, type=T3D2, ELSET=Line1\n1001, 1, 2\n*ELEMENT, type=CPS4, ELSET=Surface1\n1002, 1, 2, 3, 4\n{volumes}"
    );
    same("gmsh", &[("cross.inp", &gmsh)], &plain);
}

#[test]
fn included_files_stand_where_they_are_named() {
    let text = Cross::new(0.01).abaqus("");
    let plain = read("whole-inp", &[("cross.inp", &text)], "").expect("a panel");
    let (heading, rest) = split(&text, "*Node");
    let (nodes, rest) = split(rest, "*Element");
    let data = nodes.strip_prefix("*Node\n").expect("the keyword");
    let with = |before: &str| format!("{heading}{before}{rest}");
    for (name, main, included) in [
        ("keyword", with("*Include, Input=nodes.inp\n"), nodes),
        ("continued", with("*Include,\n  input = nodes.inp\n"), nodes),
        ("quoted", with("*INCLUDE, INPUT=\"nodes.inp\"\n"), nodes),
        ("data", with("*Node\n*Include, Input=nodes.inp\n"), data),
        ("input", with("*Node, NSet=all, Input=nodes.inp\n"), data),
    ] {
        same(name, &[("cross.inp", &main), ("nodes.inp", &format!("\u{feff}{included}"))], &plain);
    }
    // A file in a folder names the next one from there, or from the folder of the first.
    let main = with("*Include, Input=mesh\\outer.inp\n");
    for inner in ["inner.inp", "mesh/inner.inp"] {
        let outer = format!("** only this\n*Include, Input={inner}\n");
        same("nested", &[("cross.inp", &main), ("mesh/outer.inp", &outer), ("mesh/inner.inp", nodes)], &plain);
    }
    let cycle =
        [("cross.inp", with("*Include, Input=a.inp\n")), ("a.inp", "\n*Include, Input=./cross.inp\n".to_string())];
    refused(&cycle, "", "a.inp:2: ");
    refused(&cycle, "", "includes itself");
    let two = [
        ("cross.inp", main),
        ("mesh/outer.inp", "*Include, Input=a.inp\n".to_string()),
        ("mesh/a.inp", nodes.to_string()),
        ("a.inp", nodes.to_string()),
    ];
    refused(&two, "", "outer.inp:1: a.inp may be ");
    refused(&[("cross.inp", with("*Include, Input=none.inp\n"))], "", "cross.inp:3: ");
    let locked = [("cross.inp", with("*Include, Input=a.inp, Password=x\n"))];
    refused(&locked, "", "cross.inp:3: *INCLUDE has the parameter PASSWORD; allowed: INPUT");
}

/// The keyword lines and data of a part with everything.
fn part_of(text: &str) -> &str {
    split(text, "*Node").1
}

#[test]
fn parts_are_instanced_where_the_assembly_has_them() {
    let cross = Cross::new(0.01);
    let text = cross.abaqus("");
    let plain = read("flat-inp", &[("cross.inp", &text)], "").expect("a panel");
    // The whole panel as a part: moved by (1, 2, 3), then turned by 90° about the upright axis through (5, 1).
    let back = |line: &str| {
        let fields: Vec<&str> = line.split(", ").collect();
        let [x, y, z] = [1, 2, 3].map(|i| fields[i].parse::<f64>().expect("a number"));
        // A turn by 90° takes (5 + a, 1 + b) to (5 - b, 1 + a).
        let [a, b] = [y - 1.0, 5.0 - x];
        format!("{}, {}, {}, {}", fields[0], 5.0 + a - 1.0, 1.0 + b - 2.0, z - 3.0)
    };
    let moved = changed(part_of(&text), "*node", back);
    let place = "1., 2., 3.\n5., 1., 0., 5., 1., 2., 90.\n";
    let cae = |part: &str, instance: &str| {
        format!(
            "*Heading\n** Job name: cross\n*Preprint, echo=NO, model=NO\n**\n** PARTS\n**\n*Part, name=Cross\n{part}*End Part\n**\n\
             *Assembly, name=Assembly\n**\n*Instance, name=\"Cross-1\", part=Cross\n{instance}*End Instance\n**\n\
             *Node\n1, 0., 0., 5.\n*Nset, nset=ref, internal\n1,\n*Elset, elset=Set-1, instance=Cross-1\n1, 2\n*Surface, type=ELEMENT, name=s\nSet-1, S1\n\
             *End Assembly\n*Material, name=M\n*Density\n1.,\n"
        )
    };
    same("part", &[("cross.inp", &cae(&moved, place))], &plain);
    let flat = changed(part_of(&text), "*none", str::to_string);
    same("not-moved", &[("cross.inp", &cae(&flat, ""))], &plain);
    same("blank", &[("cross.inp", &cae(&flat, "\n"))], &plain);
    // The mesh of an independent instance stands in it.
    same("independent", &[("cross.inp", &cae("", &format!("{place}{moved}")))], &plain);
    // Fibre directions turn with an instance: half of those of the weft are the other way round, which a fibre does not
    // feel.
    let directions = changed(&cross.directions(), "*none", |line| line.to_string());
    let swapped: String = directions
        .lines()
        .map(|line| {
            let fields: Vec<&str> = line.split(", ").collect();
            match fields[..] {
                [number, x, y, z, ..] if number.parse::<u64>().is_ok() => {
                    let [x, y]: [f64; 2] = [x, y].map(|field| field.parse().expect("a number"));
                    format!("{number}, {y}, {}, {z}\n", -x)
                }
                _ => "**\n".to_string(),
            }
        })
        .collect();
    let table = "*Distribution Table, name=T\nCOORD3D\n*Distribution, name=D, location=ELEMENT, table=T\n";
    let oriented = moved.replace("Material=M", "Material=M, Orientation=O");
    let oriented = format!("{oriented}{table}{swapped}*Orientation, name=O, system=RECTANGULAR\nD\n1, 0.\n");
    same("oriented", &[("cross.inp", &cae(&oriented, place))], &plain);
    // Outside the part they would not turn, and a section of the part does not see them.
    let (part, distribution) = split(&oriented, "*Distribution, ");
    let (distribution, orientation) = split(distribution, "*Orientation, ");
    let outside = |part: &str, file: &str| [("cross.inp", cae(part, place) + file)];
    let message = "ORIENTATION=O, which stands outside the part; allowed: in the part, or in the instance";
    refused(&outside(&format!("{part}{distribution}"), orientation), "", message);
    let message = "*DISTRIBUTION D, which stands outside the part; allowed: in the part, or in the instance";
    refused(&outside(&format!("{part}{orientation}"), distribution), "", message);
    // One yarn, four times, twice without a section: the instance is the yarn then.
    let nodes: String = (0..(LAYERS + 1) * SECTION.len())
        .map(|i| {
            let [x, y, z] = cross.nodes[i];
            format!("{}, {x}, {}, {z}\n", i + 1, y + 0.5)
        })
        .collect();
    let elements: String = cross.elements[..LAYERS * 3]
        .iter()
        .enumerate()
        .map(|(i, solid)| {
            let nodes: Vec<String> = solid.nodes.iter().map(|node| (node + 1).to_string()).collect();
            format!(
                "*Element, type={}\n{}, {}\n",
                if nodes.len() == 6 { "C3D6" } else { "C3D8R" },
                i + 1,
                nodes.join(", ")
            )
        })
        .collect();
    let instance =
        |name: &str, part: &str, place: &str| format!("*Instance, name={name}, part={part}\n{place}*End Instance\n");
    let four = format!(
        "*Part, name=Bare\n*Node\n{nodes}{elements}*End Part\n*Part, name=Whole\n*Node\n{nodes}{elements}*Elset, elset=all, generate\n1, 18, 1\n\
         *Solid Section, elset=all, material=M\n,\n*End Part\n*Assembly, name=A\n{}{}{}{}*End Assembly\n",
        instance("Warp-1", "Whole", "0., -0.5, 0.\n"),
        instance("Warp-2", "Bare", "0., 0.5\n"),
        instance("Weft-1", "Whole", "0., 0., 0.11\n-0.25, -0.25, 0., -0.25, -0.25, 1., 90.\n"),
        // The other way round about an axis that looks the other way.
        instance("Weft-2", "Bare", "0., 0., 0.11\n0.25, 0.25, 0., 0.25, 0.25, -3., -90.\n"),
    );
    let found = read("four", &[("cross.inp", &four)], "").expect("a panel");
    check(&found);
}

#[test]
fn orientations_turn_the_fibres() {
    let cross = Cross::new(0.01);
    let text = cross.abaqus("");
    let plain = read("turned-inp", &[("cross.inp", &text)], "").expect("a panel");
    let sections = |warp: &str, weft: &str| {
        let mut text = text.clone();
        for (yarn, name) in [(0, warp), (1, warp), (2, weft), (3, weft)] {
            text = text.replace(
                &format!("Section, ElSet=Yarn{yarn}, Material=M"),
                &format!("Section, ElSet=Yarn{yarn}, Material=M, Orientation={name}"),
            );
        }
        text
    };
    let both = sections("along-x", "along-y");
    for (name, axes) in [
        (
            "points",
            "*Orientation, name=along-x\n1., 0., 0., 0., 1., 0.\n*Orientation, name=along-y\n0., 1., 0., 1., 0., 0.\n1, 30.\n",
        ),
        (
            "origin",
            "*Orientation, name=along-x\n3., 1., 1., 2., 2., 1., 2., 1., 1.\n*Orientation, name=along-y, definition=COORDINATES\n2., 2., 1., 3., 1., 1., 2., 1., 1.\n",
        ),
        (
            "about-3",
            "*Orientation, name=along-x\n0., 1., 0., 1., 0., 0.\n3, 90.\n*Orientation, name=along-y, system=RECTANGULAR\n1., 0., 0., 0., 1., 0.\n3, 90.\n",
        ),
        (
            "about-2",
            "*Orientation, name=along-x\n0., 0., 1., 0., 1., 0.\n2, 90.\n*Orientation, name=along-y\n0., 0., 1., 1., 0., 0.\n2, 270.\n",
        ),
        (
            "along-z",
            "*Orientation, name=along-x, system=Z RECTANGULAR\n0., 0., 1., 1., 0., 0.\n*Orientation, name=along-y, system=Z Rectangular\n0., 0., 1., 1., 0., 0.\n3, 90.\n",
        ),
    ] {
        same(name, &[("cross.inp", &format!("{axes}{both}"))], &plain);
    }
    let table = "*Distribution Table, name=T\nCOORD3D, COORD3D\n";
    let vectors = format!("*Distribution, name=D, location=ELEMENT, table=T\n{}", cross.directions());
    let elastic = "*Distribution Table, name=E\nMODULUS, RATIO, RATIO\n*Distribution, name=L, location=ELEMENT, table=E\n, 1., 0.2, 0.3\n1, 2., 0.2, 0.3\n";
    let oriented = "*Orientation, name=O\nD\n1, 0.\n";
    let by_element = sections("O", "O");
    same("distribution", &[("cross.inp", &format!("{by_element}{table}{vectors}{oriented}"))], &plain);
    same("elastic-first", &[("cross.inp", &format!("{elastic}{table}{vectors}{oriented}{by_element}"))], &plain);
    same("elastic-last", &[("cross.inp", &format!("{table}{vectors}{elastic}{text}"))], &plain);
    // A fibre that an orientation turns across its yarn is no panel's.
    let inp = |text: &str, message: &str| refused(&[("cross.inp", text)], "", message);
    let across = sections("along-y", "along-y");
    inp(
        &format!("*Orientation, name=along-y\n0., 1., 0., 1., 0., 0.\n{across}"),
        "0 yarns along x and 4 along y; allowed: some of both",
    );
    inp(&format!("*Orientation, name=O\n1., 0., 0., 0., 1., 0.\n3, 45.\n{by_element}"), "runs 45° off x and y");
    inp(&by_element, "ORIENTATION=O, which the file does not have");
    inp(&format!("{oriented}{by_element}"), "cross.inp:1: *DISTRIBUTION D, which the file does not have");
    inp(&format!("{oriented}{elastic}{by_element}").replace("name=L", "name=D"), "*DISTRIBUTION D is of no vectors");
    let second = vectors.replace("name=D", "name=F");
    inp(
        &format!("{table}{vectors}{second}{text}"),
        "a second *DISTRIBUTION of vectors, F; allowed: one, or an *ORIENTATION",
    );
    inp(
        &format!("*Orientation, name=O, system=CYLINDRICAL\n0., 0., 0., 0., 0., 1.\n{by_element}"),
        "cross.inp:1: *ORIENTATION with SYSTEM=CYLINDRICAL",
    );
    inp(
        &format!("*Orientation, name=O, definition=NODES\n1, 2\n{by_element}"),
        "cross.inp:1: *ORIENTATION with DEFINITION=NODES",
    );
    inp(&format!("*Orientation, name=O\n1., 0., 0., 2., 0., 0.\n2, 10.\n{by_element}"), "whose points are on a line");
    inp(&format!("*Orientation, name=O\n1., 0., 0.\n{by_element}"), "cross.inp:2: *ORIENTATION has 3 numbers");
    inp(&text.replace("Material=M", "Material=M, Composite"), "*SOLID SECTION has the parameter COMPOSITE");
}

#[test]
fn what_of_abaqus_may_move_a_mesh_is_refused() {
    let text = Cross::new(0.01).abaqus("");
    let inp = |text: &str, message: &str| refused(&[("cross.inp", text)], "", message);
    let first = |line: &str| format!("{line}\n{text}");
    for keyword in [
        "*NMAP, NSET=all",
        "*SYSTEM",
        "*NGEN",
        "*NFILL",
        "*NCOPY",
        "*ELGEN",
        "*ELCOPY",
        "*IMPERFECTION, FILE=f, STEP=1",
        "*PARAMETER",
        "*ADAPTIVE MESH",
        "*SYMMETRIC MODEL GENERATION",
        "*MAP SOLUTION",
        "*IMPORT",
        "*MODEL CHANGE, REMOVE",
        "*SOMETHING NEW",
        "*MATRIX INPUT",
    ] {
        let name = keyword.split(',').next().expect("a name");
        inp(&first(keyword), &format!("cross.inp:1: {name}; allowed: nodes and elements one by one"));
    }
    inp(&first("*Tie, name=t"), "cross.inp:1: *TIE, which moves nodes; allowed: ADJUST=NO");
    inp(&first("*Contact Pair, Adjust=0.1"), "cross.inp:1: *CONTACT PAIR, which moves nodes; allowed: ADJUST=NO");
    inp(&first("*Node, System=C"), "cross.inp:1: *NODE, SYSTEM=C; allowed: R");
    inp(
        &first("*Node, Nset=a, Something=b"),
        "cross.inp:1: *NODE has the parameter SOMETHING; allowed: NSET, INPUT, SYSTEM",
    );
    inp(&first("1, 2, 3, 4"), "cross.inp:1: a line before the first keyword");
    for kind in ["C3D10", "C3D10M", "C3D20R", "C3D4", "COH3D8", "SC8R", "C3D15"] {
        inp(&text.replace("C3D8R", kind), &format!("elements of type {kind}; allowed: C3D8 and C3D6"));
    }
    inp(&text.replace("3, -1.5,", "3, <x>,"), "cross.inp:6: x is \"<x>\"; allowed: a finite number");
    inp(&text.replace("3, -1.5,", "3, -1.5, 0, 0, 0, 0, 1,"), "cross.inp:6: a node has a number and three coordinates");
    inp(&text.replace("\n1, 1, 3, 2, 7, 9, 8\n", "\n1, 1, 3, 2, 7, 9, 8, 9\n"), "element 1 has 7 nodes; allowed: 6");
    inp(
        &text.replace("1, 18\n", "1, Nothing\n").replace("ElSet=Yarn0, Generate", "ElSet=Yarn0"),
        "set YARN0 has the member NOTHING",
    );
    inp(&text.replace("1, 18\n", "1, Yarn0\n").replace("ElSet=Yarn0, Generate", "ElSet=Yarn0"), "set YARN0 has itself");
    inp(&text.replace("1, 18\n", "18, 1\n"), "a range from 18 to 1 by 1; allowed: upwards");
    inp(&format!("{text}*Step\n*Static\n*Model Change, Remove\nYarn0\n*End Step\n"), "*MODEL CHANGE in a step");
    for keyword in
        ["Nodde", "NCopy, Change Number=9", "Adaptive Mesh", "Orientation, Name=O", "Solid Section, ElSet=Yarn0"]
    {
        let step = format!("{text}*Step\n*Dynamic, Explicit\n, 1.\n*{keyword}\n1, 2.\n*End Step\n");
        inp(&step, "in a step; allowed: procedures, loads and results");
    }
    for location in ["Elemnt", "Integration Point"] {
        let distribution = format!("{text}*Distribution, Name=D, Location={location}\n, 1., 0., 0.\n");
        inp(&distribution, &format!("*DISTRIBUTION, LOCATION={}; allowed", location.to_uppercase()));
    }
    inp(&format!("{text}*Distribution, Nam=D\n"), "*DISTRIBUTION has the parameter NAM; allowed: NAME");
    inp(&format!("{text}*Element, Type=C3D8R,\n*Node\n"), "a keyword line ends with a comma");
    let part = part_of(&text);
    inp(&format!("*Part, name=A\n{part}"), "*PART A of line 1 has no end");
    inp(&format!("*Part, name=A\n*Part, name=B\n{part}"), "cross.inp:2: *PART in *PART A of line 1");
    inp("*Instance, name=A-1, part=A\n*End Instance\n", "cross.inp:1: *INSTANCE of A, which the file does not have");
    inp("*Instance, name=A-1, library=old\n*End Instance\n", "cross.inp:1: *INSTANCE has the parameter LIBRARY");
    let instanced = format!("*Part, name=A\n{part}*End Part\n*Instance, name=A-1, part=A\n*End Instance\n");
    inp(&format!("{instanced}*Solid Section, ElSet=Yarn0, Material=M\n"), "*SOLID SECTION outside the parts");
    let directions = "*Distribution, Name=D, Location=Element\n, 1., 0., 0.\n";
    inp(&format!("{instanced}{directions}"), "*DISTRIBUTION of vectors outside the parts");
    inp("*End Part\n", "cross.inp:1: *END PART; allowed: behind what it ends");
    let instance =
        |lines: &str| format!("*Part, name=A\n*End Part\n*Instance, name=A-1, part=A\n{lines}*End Instance\n");
    inp(
        &instance("0., 0., 0.\n1., 2., 3.\n"),
        "cross.inp:5: a line of *INSTANCE; allowed: three numbers of a translation, then seven",
    );
    inp(&instance("0., 0., 0., 0., 0., 0., 5.\n"), "cross.inp:4: a line of *INSTANCE; allowed: three numbers");
    inp(&instance("0.\n1., 1., 1., 1., 1., 1., 5.\n"), "cross.inp:5: a line of *INSTANCE; allowed: an axis");
}

/// The deck in the long format: all fields of nodes, elements and parts in 20 columns.
fn long(text: &str) -> String {
    let wide = |line: &str, widths: &[usize]| {
        let mut start = 0;
        let fields = widths.iter().map(|width| {
            let field = line.get(start..(start + width).min(line.len())).unwrap_or_default();
            start += width;
            format!("{:>20}", field.trim())
        });
        fields.collect::<String>()
    };
    let text = changed(text, "*node", |line| wide(line, &[8, 16, 16, 16]));
    let text =
        changed(&text, "*part", |line| if line.contains("yarn") { line.to_string() } else { wide(line, &[10; 3]) });
    changed(&text, "*element_solid", |line| wide(line, &[8; 10]))
}

/// The deck with a direction of the fibres in each element.
fn ortho(text: &str) -> String {
    let axes = |line: &str| {
        let number: usize = line[..8].trim().parse().expect("a number");
        let fibre = if number <= 36 { [1, 0, 0] } else { [0, -2, 0] };
        let card = |axis: [i32; 3]| axis.map(|x| format!("{x:>16}")).concat();
        format!("{line}\n{}\n{}", card(fibre), card([0, 0, 1]))
    };
    changed(text, "*element", axes).replace("*ELEMENT_SOLID", "*ELEMENT_SOLID_ORTHO")
}

#[test]
fn legal_forms_of_ls_dyna_give_the_plain_panel() {
    let text = Cross::new(0.01).ls_dyna();
    let plain = read("plain-k", &[("cross.k", &text)], "").expect("a panel");
    let legal = |name: &str, text: &str| same(name, &[("cross.k", text)], &plain);
    legal("bom", &format!("\u{feff}{text}"));
    legal("windows", &text.replace('\n', "\r\n"));
    legal("lower-case", &text.to_lowercase());
    legal("behind-the-end", &format!("{text}*NODE\n&rest\n*NODE_TRANSFORM\n"));
    let long = long(&text);
    for option in ["LONG=Y", "LONG = Y", "long=y", "MEMORY=20M LONG =  Y", "LONG=K"] {
        legal("long", &long.replace("*KEYWORD", &format!("*KEYWORD {option}")));
    }
    legal("standard", &text.replace("*KEYWORD", "*KEYWORD LONG=S"));
    for mark in [" +", "+", "   +"] {
        let marked = ["*NODE", "*PART", "*ELEMENT_SOLID"]
            .iter()
            .fold(long.clone(), |text, keyword| text.replace(&format!("{keyword}\n"), &format!("{keyword}{mark}\n")));
        legal("plus", &marked);
    }
    legal(
        "minus",
        &text
            .replace("*KEYWORD", "*KEYWORD LONG=Y")
            .replace("*NODE\n", "*NODE -\n")
            .replace("*PART\n", "*PART -\n")
            .replace("*ELEMENT_SOLID\n", "*ELEMENT_SOLID -\n"),
    );
    let commas = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(",");
    legal("commas", &changed(&changed(&text, "*node", commas), "*element", commas));
    let zero =
        |line: &str| if line.ends_with("0.000000000") { format!("{}{:16}", &line[..40], "") } else { line.to_string() };
    legal("blank-coordinates", &changed(&text, "*node", zero));
    legal("constraints", &changed(&text, "*node", |line| format!("{line}{:>8}{:>8}", 0, 7)));
    let cards = |line: &str| format!("{}\n{}", &line[..16], &line[16..]);
    legal("two-cards", &changed(&text, "*element", cards));
    let ten = |line: &str| format!("{}\n{}{:>8}{:>8}", &line[..16], &line[16..], 0, 0);
    legal("ten-nodes", &changed(&text, "*element", ten).replace("*ELEMENT_SOLID", "*ELEMENT_SOLID (ten nodes format)"));
    legal("axes", &ortho(&text));
    let beside = "*TITLE\na deck\n*PARAMETER\nR       x       1.0\n*CONTROL_TERMINATION\n       1.0\n*DATABASE_GLSTAT\n       0.1\n*MAT_ELASTIC_TITLE\nyarn\n         1       1.0       1.0       0.3\n\
                  *SECTION_SOLID_TITLE\nsolid\n         1         1\n*SET_NODE_LIST_TITLE\nall\n         1\n         1         2\n*DEFINE_CURVE_TITLE\ncurve\n         1\n                 0.0                 1.0\n\
                  *CONTACT_AUTOMATIC_SINGLE_SURFACE_ID\n         1\n*INITIAL_VELOCITY_RIGID_BODY\n         9\n*DEFINE_TRANSFORMATION\n         1\nSCALE            2.0       1.0       1.0\n\
                  *NODE\n     900             9.0             9.0             9.0\n*ELEMENT_SHELL\n       1      99     900     900     900     900\n*BOUNDARY_SPC_SET\n         1\n*HOURGLASS\n         1\n";
    let (before, _) = split(&text, "*END");
    legal("deck", &format!("{before}{beside}*END\n"));
    // A title may be blank.
    let untitled = text.replace("yarn 3\n", "\n");
    legal("untitled", &untitled);
}

#[test]
fn included_files_of_ls_dyna_are_read_with_their_offsets() {
    let text = Cross::new(0.01).ls_dyna();
    let plain = read("whole-k", &[("cross.k", &text)], "").expect("a panel");
    let (before, rest) = split(&text, "*NODE");
    let (nodes, rest) = split(rest, "*PART");
    let with = |lines: &str| format!("{before}{lines}{rest}");
    let nodes = format!("*KEYWORD\n{nodes}*END\n*NODE\nrest\n");
    for (name, lines, place) in [
        ("plain", "*INCLUDE\nnodes.k\n", "nodes.k"),
        ("folder", "*INCLUDE\nmesh/nodes.k\n", "mesh/nodes.k"),
        ("continued", "*INCLUDE\nmesh/ +\n$ on\nnodes.k\n", "mesh/nodes.k"),
        ("path", "*INCLUDE_PATH\nmesh\n*INCLUDE\nnodes.k\n", "mesh/nodes.k"),
        ("transform", "*INCLUDE_TRANSFORM\nnodes.k\n         0         0         0\n\n\n         0\n", "nodes.k"),
        ("short", "*INCLUDE_TRANSFORM\nnodes.k\n", "nodes.k"),
    ] {
        same(name, &[("cross.k", &with(lines)), (place, &nodes)], &plain);
    }
    // Everything twenty numbers down, in a file that is included by one with another offset.
    let down = |line: &str, fields: usize| {
        let number = |i: usize| line[8 * i..8 * i + 8].trim().parse::<i64>().expect("a number");
        (0..fields).map(|i| format!("{:>8}", number(i) + 1000)).collect::<String>() + &line[8 * fields..]
    };
    let moved = changed(&changed(&text, "*node", |line| down(line, 1)), "*element", |line| down(line, 10));
    let moved = changed(&moved, "*part", |line| {
        if line.contains("yarn") {
            line.to_string()
        } else {
            format!("{:>10}", line[..10].trim().parse::<i64>().expect("a number") + 1000)
        }
    });
    let offsets = |by: i64| format!("{by:>10}{by:>10}{by:>10}\n");
    let main = format!("*KEYWORD\n*INCLUDE_TRANSFORM\nouter.k\n{}", offsets(-1020));
    let outer =
        format!("*INCLUDE_TRANSFORM\ninner.k\n{}         0\n       1.0       1.0       1.0\n         0\n", offsets(20));
    same("offsets", &[("cross.k", &main), ("outer.k", &outer), ("inner.k", &moved)], &plain);
    let deck =
        |cards: &str| [("cross.k", with(&format!("*INCLUDE_TRANSFORM\nnodes.k\n{cards}"))), ("nodes.k", nodes.clone())];
    refused(&deck("\n\n\n         7\n"), "", "cross.k:4: *INCLUDE_TRANSFORM with the transformation 7; allowed: 0");
    refused(
        &deck("\n\n       1.0       1.0      25.4\n"),
        "",
        "cross.k:4: *INCLUDE_TRANSFORM with the factor 25.4 of lengths",
    );
    refused(&deck("        -1\n"), "", "nodes.k:3: a node's number is 1 with an offset of -1");
    let zero = changed(&nodes, "*node", |line| line.replacen("       1", "       0", 1));
    let [main, _] = deck("      1000\n");
    refused(
        &[main, ("nodes.k", zero)],
        "",
        "nodes.k:3: a node's number is 0 with an offset of 1000; allowed: a number",
    );
    // Without its offset the nodes are nowhere.
    refused(&deck("      1000\n"), "", "element 1 has node ");
    let cycle = [("cross.k", with("*INCLUDE\na.k\n")), ("a.k", "*KEYWORD\n*INCLUDE\ncross.k\n".to_string())];
    refused(&cycle, "", "a.k:3: ");
    refused(&cycle, "", "includes itself");
}

#[test]
fn what_of_ls_dyna_may_move_a_mesh_is_refused() {
    let text = Cross::new(0.01).ls_dyna();
    let k = |text: &str, message: &str| refused(&[("cross.k", text)], "", message);
    for keyword in [
        "*NODE_TRANSFORM",
        "*NODE_MERGE_SET",
        "*PART_MOVE",
        "*PART_DUPLICATE",
        "*INCLUDE_AUTO_OFFSET",
        "*INCLUDE_STAMPED_PART",
        "*INCLUDE_NASTRAN",
        "*PERTURBATION_NODE",
        "*ELEMENT_SOLID_H20",
        "*ELEMENT_SOLID_T10",
        "*ELEMENT_SOLID_ORTHO_BETA",
        "*ELEMENT_TSHELL",
        "*ELEMENT_GENERATE_SOLID",
        "*ELEMENT_SPH",
        "*INITIAL_FOAM_REFERENCE_GEOMETRY",
        "*DELETE_PART",
        "*CONTROL_REFINE_SOLID",
        "*CONTROL_REFNE_SOLID",
        "*CONTROL_ADAPTIVE",
        "*CONTROL_FORMING_POSITION",
        "*DEFINE_FIBERS",
        "*SOMETHING_NEW",
    ] {
        k(
            &text.replace("*KEYWORD", &format!("*KEYWORD\n{keyword}")),
            &format!("cross.k:2: {keyword}; allowed: *ELEMENT_SOLID and"),
        );
    }
    let contact = |name: &str| text.replace("*KEYWORD", &format!("*KEYWORD\n*CONTACT_{name}\n         1         2"));
    for name in ["TIED_NODES_TO_SURFACE", "TIED_SHELL_EDGE_TO_SURFACE_ID", "SPOTWELD"] {
        k(
            &contact(name),
            &format!("cross.k:2: *CONTACT_{name}, which moves nodes; allowed: tied contacts with OFFSET"),
        );
    }
    for name in ["TIED_NODES_TO_SURFACE_OFFSET", "AUTOMATIC_SINGLE_SURFACE"] {
        check(&read("contact", &[("cross.k", &contact(name))], "").expect("a panel"));
    }
    for mark in ["*NODE %", "*NODE%"] {
        k(&text.replace("*NODE", mark), "cross.k:3: *NODE");
        k(&text.replace("*NODE", mark), "numbers in ten columns; allowed: the standard or the long format");
    }
    k(&text.replace("*KEYWORD", "*KEYWORD I10=Y"), "cross.k:1: I10=Y; allowed: LONG=Y, LONG=N or neither");
    k(
        &text.replace("       1    -1.500000000", "       1           &left"),
        "cross.k:4: x is \"&left\"; allowed: a finite number",
    );
    k(&text.replace("*KEYWORD", "1, 2, 3"), "cross.k:1: a line before the first keyword");
    k(&text.replace("*KEYWORD", "*KEYWORD\n-----BEGIN PGP MESSAGE-----"), "cross.k:2: an encrypted part");
    k(&changed(&text, "*node", |line| line.replacen("    ", "\t", 1)), "cross.k:4: a tab, or a letter beyond ASCII");
    let ten = |line: &str| format!("{}\n{}{:>8}{:>8}", &line[..16], &line[16..], 1, 2);
    k(&changed(&text, "*element", ten), "element 1 has ten nodes; allowed: eight");
    let axes = |second: &'static str| move |line: &str| format!("{line}\n{:>16}{:>16}{:>16}\n{second}", 1, 0, 0);
    let ortho = |second: &'static str| {
        changed(&text, "*element", axes(second)).replace("*ELEMENT_SOLID", "*ELEMENT_SOLID_ORTHO")
    };
    k(&ortho(""), "vector d is 0; allowed: two vectors");
    k(
        &ortho("             0.0             0.0             1.0")
            .replace("*END", "*ELEMENT_SOLID_ORTHO\n    1000      11\n*END"),
        "an element without all its cards",
    );
    k(&ortho("             0.0             0.0             1.0"), "4 yarns along x and 0 along y");
}

/// What a law's own axes would turn is said where no element says it better.
#[test]
fn fibres_that_a_material_of_ls_dyna_may_turn_are_refused() {
    let text = Cross::new(0.01).ls_dyna();
    let with = |text: &str, material: &str| text.replace("*KEYWORD\n", &format!("*KEYWORD\n{material}"));
    let card = |fields: &[&str]| fields.iter().map(|field| format!("{field:>10}")).collect::<String>() + "\n";
    let orthotropic = |aopt: &str| {
        let elastic = card(&["1", "1.4e-9", "8e4", "8e2", "8e2", "0", "0", "0"]);
        elastic + &card(&["126.0", "126.0", "126.0", aopt]) + &card(&["0", "0", "0", "0", "1"]) + &card(&["0"])
    };
    let own = |iortho: &str, aopt: &str| {
        let first = card(&["1", "1.4e-9", "41", "13", "11", iortho, "12", "13"]) + &card(&["0", "1", "0", "-1"]);
        first + if iortho == "0" { "" } else { aopt } + &card(&["8e4"])
    };
    let axes = |aopt: &str| card(&[aopt, "1", "0", "0", "0", "0", "1"]) + &card(&["0"]);
    let turned = [
        (format!("*MAT_ORTHOTROPIC_ELASTIC\n{}", orthotropic("2.0")), "cross.k:4: AOPT is 2, which is not read"),
        (format!("*MAT_002_TITLE\nyarn\n{}", orthotropic("-7")), "cross.k:5: AOPT is -7, which is not read"),
        (
            format!("*MAT_USER_DEFINED_MATERIAL_MODELS\n{}", own("1", &axes("2.0"))),
            "cross.k:5: AOPT is 2, which is not read",
        ),
        (format!("*MAT_041\n{}", own("1", &axes("3"))), "cross.k:5: AOPT is 3, which is not read; allowed: AOPT = 0"),
        ("*MAT_COMPOSITE_DAMAGE\n".to_string(), "cross.k:2: *MAT_COMPOSITE_DAMAGE, whose AOPT is not read"),
        ("*MAT_ELASTIC_NEW\n".to_string(), "cross.k:2: *MAT_ELASTIC_NEW, whose AOPT is not read"),
    ];
    let plain = read("plain-k", &[("cross.k", &text)], "").expect("a panel");
    let of_elements = ortho(&text);
    for (material, message) in &turned {
        refused(&[("cross.k", with(&text, material))], "", message);
        same("own-directions", &[("cross.k", &with(&of_elements, material))], &plain);
    }
    for material in [
        format!("*MAT_ORTHOTROPIC_ELASTIC_TITLE\nyarn\n{}", orthotropic("")),
        format!("*MAT_2\n{}", orthotropic("0.0")),
        format!("*MAT_USER_DEFINED_MATERIAL_MODELS\n{}", own("0", "")),
        format!("*MAT_USER_DEFINED_MATERIAL_MODELS_TITLE\nyarn\n{}", own("1", &axes("0"))),
        "*MAT_RIGID\n*MAT_020\n*MAT_ADD_EROSION\n*MAT_JOHNSON_COOK_TITLE\n".to_string(),
    ] {
        same("no-axes", &[("cross.k", &with(&text, &material))], &plain);
    }
}

/// Files of the panel by meshio 5.3.5 and VTK 9.7: as they write them by default, and otherwise.
const FILES: [(&str, &[u8]); 9] = [
    ("meshio.vtu", include_bytes!("test_files/meshio.vtu")),
    ("meshio-not-compressed.vtu", include_bytes!("test_files/meshio-not-compressed.vtu")),
    ("vtk-ascii.vtu", include_bytes!("test_files/vtk-ascii.vtu")),
    ("vtk-binary-64.vtu", include_bytes!("test_files/vtk-binary-64.vtu")),
    ("vtk-binary-zlib.vtu", include_bytes!("test_files/vtk-binary-zlib.vtu")),
    ("vtk-appended-raw.vtu", include_bytes!("test_files/vtk-appended-raw.vtu")),
    ("vtk-appended-raw-zlib-64.vtu", include_bytes!("test_files/vtk-appended-raw-zlib-64.vtu")),
    ("vtk-appended-base64.vtu", include_bytes!("test_files/vtk-appended-base64.vtu")),
    ("vtk-appended-base64-zlib.vtu", include_bytes!("test_files/vtk-appended-base64-zlib.vtu")),
];

#[test]
fn vtu_files_of_others_give_the_same_panel() {
    let plain = read("ascii-vtu", &[("cross.vtu", FILES[2].1)], "").expect("a panel");
    for (name, bytes) in FILES {
        let found = read(name, &[("cross.vtu", bytes)], "").unwrap_or_else(|error| panic!("{name}: {error}"));
        check(&found);
        assert_eq!((&found.model.elements, &found.model.fibre), (&plain.model.elements, &plain.model.fibre), "{name}");
        let apart =
            found.model.nodes.iter().flatten().zip(plain.model.nodes.iter().flatten()).map(|(a, b)| (a - b).abs());
        assert!(apart.fold(0.0, f64::max) < 1e-7, "{name}");
    }
}

#[test]
fn a_vtu_file_that_is_cut_or_of_another_kind_is_refused() {
    let vtu = |bytes: &[u8], message: &str| refused(&[("cross.vtu", bytes)], "", message);
    let lz4 = include_bytes!("test_files/vtk-lz4.vtu");
    vtu(lz4, "array Points is compressed by vtkLZ4DataCompressor; allowed: vtkZLibDataCompressor, or none");
    for (name, bytes) in FILES {
        // What is missing is said, or there is no whole document.
        for part in 1..40 {
            let cut = &bytes[..bytes.len() * part / 40];
            let read = read(name, &[("cross.vtu", cut)], "");
            assert!(read.is_err(), "{name}, {part} of 40");
        }
    }
    let text = |bytes: &[u8], from: &str, to: &str| {
        String::from_utf8(bytes.to_vec()).expect("text").replacen(from, to, 1).into_bytes()
    };
    let [meshio, plain] = [FILES[0].1, FILES[1].1];
    vtu(&text(meshio, "eJ", "eK"), "is no zlib data");
    vtu(&text(plain, "format=\"binary\">\n", "format=\"binary\">\n!!!!"), "array Points is no base64");
    vtu(&text(plain, "format=\"binary\">\n", "format=\"binary\">\n////"), "array Points is shorter than it says");
    vtu(&text(plain, "Float64", "Float32"), "allowed: finite coordinates");
    vtu(&text(plain, "Float64", "Int16"), "array Points has the entry -");
    vtu(&text(plain, "LittleEndian", "MiddleEndian"), "byte_order is MiddleEndian; allowed: LittleEndian, BigEndian");
    vtu(&text(FILES[8].1, "offset=\"0\"", "offset=\"999999\""), "begins at 999999 of ");
}

/// A name that is not read would turn the fibres without a word.
#[test]
fn directions_of_a_vtu_file_under_another_name_are_refused() {
    let plain = read("plain-vtu", &[("cross.vtu", FILES[2].1)], "").expect("a panel");
    let text = vtu::unstructured_grid(&plain.model);
    let named = |name: &str| text.replace("Name=\"fibre\"", &format!("Name=\"{name}\""));
    let vtu = |text: &str, message: &str| refused(&[("cross.vtu", text)], "", message);
    for name in ["Fibre", "fiber", "Orientation"] {
        let message = format!("CellData has the array {name} of three components, but none called fibre; allowed: ");
        vtu(&named(name), &message);
    }
    let (before, cells) = split(&text, "<CellData>");
    let (cells, behind) = split(cells, "</CellData>");
    let (yarns, fibres) = cells.split_at(cells.rfind("<DataArray").expect("an array"));
    let of_points = |name: &str| {
        let fibres = fibres.replace("fibre", name);
        format!("{before}<PointData>{fibres}</PointData>{yarns}{behind}")
    };
    vtu(&of_points("Fibre"), "PointData has the array Fibre of three components, but none called fibre; allowed: ");
    vtu(&format!("{before}{cells}{fibres}{behind}"), "a second array fibre; allowed: one");
    // What a file of results has besides is no direction of fibres, and beside these anything may be.
    let vectors = fibres.replace("fibre", "velocity");
    for text in [of_points("displacement"), format!("{before}{cells}{vectors}{behind}")] {
        same("results", &[("cross.vtu", &text)], &plain);
    }
}

#[test]
fn a_vtu_array_of_too_few_bytes_is_refused() {
    let vtu = |attributes: &str, points: &[u8], message: &str| {
        let points = STANDARD.encode(points);
        let text = format!(
            "<VTKFile {attributes}><Points><DataArray Name=\"Points\" type=\"Float64\" format=\"binary\">{points}</DataArray>\
             </Points><Cells><DataArray Name=\"connectivity\"/><DataArray Name=\"offsets\"/><DataArray Name=\"types\"/></Cells>\
             <CellData><DataArray Name=\"yarn\"/></CellData></VTKFile>"
        );
        refused(&[("cross.vtu", text)], "", &format!("cross.vtu:1: array Points {message}"));
    };
    let [header, zlib] = ["header_type=\"UInt64\"", "compressor=\"vtkZLibDataCompressor\""];
    for attributes in [String::new(), header.to_string(), zlib.to_string(), format!("{header} {zlib}")] {
        let length = if attributes.contains(header) { 8 } else { 4 };
        for count in 1..length {
            vtu(&attributes, &[0; 8][..count], "is shorter than it says");
        }
        vtu(&attributes, &[255; 8][..length], "is shorter than it says");
    }
    // A block of one byte, which is 0, that says it has as many as there may be.
    let block = [0x78, 0x9c, 0x63, 0, 0, 0, 1, 0, 1];
    let lengths = [1, u64::MAX, 0, block.len() as u64].map(u64::to_le_bytes).concat();
    let message = "has 1 bytes in a block; allowed: 18446744073709551615";
    vtu(&format!("{header} {zlib}"), &[&lengths[..], &block].concat(), message);
}
