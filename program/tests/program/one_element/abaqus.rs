//! Keywords of Abaqus and CalculiX.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use toron_materials::material::laws::LawName;

use super::model::{Deck, Model, Table, count, frictional, number};

#[derive(Clone, Copy, PartialEq)]
enum Solver {
    Standard,
    Explicit,
    Calculix,
}

/// A keyword, its parameters and its data lines.
struct Card {
    keyword: String,
    parameters: BTreeMap<String, String>,
    lines: Vec<Vec<String>>,
}

pub fn standard(text: &str) -> Deck {
    read(text, Solver::Standard)
}

pub fn explicit(text: &str) -> Deck {
    read(text, Solver::Explicit)
}

pub fn calculix(text: &str) -> Deck {
    read(text, Solver::Calculix)
}

/// The keywords that each solver knows, and their parameters.
fn known(solver: Solver) -> Vec<(&'static str, &'static [&'static str])> {
    let common: [(&str, &[&str]); 13] = [
        ("NODE", &["NSET"]),
        ("ELEMENT", &["TYPE", "ELSET"]),
        ("NSET", &["NSET"]),
        ("MATERIAL", &["NAME"]),
        ("DENSITY", &[]),
        ("USER MATERIAL", if solver == Solver::Standard { &["CONSTANTS", "UNSYMM"] } else { &["CONSTANTS"] }),
        ("DEPVAR", if solver == Solver::Explicit { &["DELETE"] } else { &[] }),
        (
            "SOLID SECTION",
            if solver == Solver::Explicit { &["ELSET", "MATERIAL", "CONTROLS"] } else { &["ELSET", "MATERIAL"] },
        ),
        ("AMPLITUDE", &["NAME"]),
        ("STEP", &["NLGEOM", "INC"]),
        ("BOUNDARY", &["AMPLITUDE"]),
        ("END STEP", &[]),
        ("HEADING", &[]),
    ];
    let own: &[(&str, &[&str])] = match solver {
        Solver::Standard | Solver::Calculix => &[("STATIC", &["DIRECT"]), ("EL PRINT", &["ELSET", "FREQUENCY"])],
        Solver::Explicit => &[
            ("DYNAMIC", &["EXPLICIT"]),
            ("SECTION CONTROLS", &["NAME", "ELEMENT DELETION"]),
            ("OUTPUT", &["FIELD", "HISTORY", "NUMBER INTERVAL", "TIME INTERVAL"]),
            ("NODE OUTPUT", &[]),
            ("ELEMENT OUTPUT", &["ELSET"]),
        ],
    };
    common
        .into_iter()
        .chain(own.iter().copied())
        .filter(|row| solver != Solver::Calculix || row.0 != "HEADING")
        .collect()
}

fn cards(text: &str, solver: Solver) -> Vec<Card> {
    let known = known(solver);
    let mut cards: Vec<Card> = Vec::new();
    for line in text.lines().filter(|line| !line.starts_with("**")) {
        assert!(line.is_ascii() && line.len() <= 132 && !line.trim().is_empty(), "{line}");
        let words: Vec<String> = line.trim_start_matches('*').split(',').map(|word| word.trim().to_string()).collect();
        if line.starts_with('*') {
            let parameters = words[1..].iter().map(|word| word.split_once('=').unwrap_or((word, "")));
            let parameters: BTreeMap<_, _> =
                parameters.map(|(name, value)| (name.to_string(), value.to_string())).collect();
            let (_, allowed) = known.iter().find(|row| row.0 == words[0]).unwrap_or_else(|| panic!("{line}"));
            assert!(parameters.keys().all(|name| allowed.contains(&name.as_str())), "{line}");
            cards.push(Card { keyword: words[0].clone(), parameters, lines: Vec::new() });
        } else {
            cards.last_mut().expect("a keyword comes first").lines.push(words);
        }
    }
    cards
}

fn read(text: &str, solver: Solver) -> Deck {
    let cards = cards(text, solver);
    let all = |keyword: &'static str| cards.iter().filter(move |card| card.keyword == keyword);
    let mut model = Model::until(end(&cards, solver));
    for line in all("NODE").flat_map(|card| &card.lines) {
        let node = model.nodes.insert(count(&line[0]), Vector3::from_iterator(line[1..4].iter().map(|x| number(x))));
        assert!(node.is_none() && line.len() == 4);
    }
    let sets: BTreeMap<&str, Vec<usize>> = all("NSET")
        .map(|card| {
            assert!(card.lines.iter().all(|line| line.len() <= 16), "at most 16 numbers a line");
            (card.parameters["NSET"].as_str(), card.lines.iter().flatten().map(|node| count(node)).collect())
        })
        .collect();
    let materials = materials(&cards, solver);
    for card in all("ELEMENT") {
        assert_eq!(card.parameters["TYPE"], if solver == Solver::Explicit { "C3D8R" } else { "C3D8" });
        let section = all("SOLID SECTION").find(|section| section.parameters["ELSET"] == card.parameters["ELSET"]);
        let section = section.expect("every set has a section");
        if solver == Solver::Explicit {
            let controls =
                all("SECTION CONTROLS").find(|controls| controls.parameters["NAME"] == section.parameters["CONTROLS"]);
            assert_eq!(controls.expect("the controls").parameters["ELEMENT DELETION"], "YES");
        }
        let (law, values) = materials[section.parameters["MATERIAL"].as_str()].clone();
        for line in &card.lines {
            let nodes: Vec<usize> = line[1..].iter().map(|node| count(node)).collect();
            model.elements.push((count(&line[0]), nodes.try_into().expect("eight nodes"), law, values.clone()));
        }
    }
    let amplitudes: BTreeMap<&str, Table> =
        all("AMPLITUDE").map(|card| (card.parameters["NAME"].as_str(), amplitude(card))).collect();
    for card in all("BOUNDARY") {
        let amplitude = card.parameters.get("AMPLITUDE").map(|name| &amplitudes[name.as_str()]);
        for line in &card.lines {
            let (set, first, last, value) = (&line[0], count(&line[1]), count(&line[2]), number(&line[3]));
            for (&node, component) in sets[set.as_str()].iter().flat_map(|node| (first..=last).map(move |c| (node, c)))
            {
                let table = match amplitude {
                    Some(table) => table.iter().map(|&(time, factor)| (time, value * factor)).collect(),
                    None => vec![(0.0, value)],
                };
                model.prescribe(node, component - 1, table);
            }
        }
    }
    model.deck()
}

/// The step's duration, which is cut into increments that meet the tables' points.
fn end(cards: &[Card], solver: Solver) -> f64 {
    let one = |keyword: &str| cards.iter().find(|card| card.keyword == keyword).expect("the card");
    let nlgeom = &one("STEP").parameters["NLGEOM"];
    assert_eq!(nlgeom, if solver == Solver::Calculix { "" } else { "YES" });
    assert_eq!(cards[cards.len() - 1].keyword, "END STEP");
    if solver == Solver::Explicit {
        let line = &one("DYNAMIC").lines[0];
        assert!(line[0].is_empty() && line.len() == 2, "the first increment is the solver's");
        return number(&line[1]);
    }
    let line = &one("STATIC").lines[0];
    let (increment, end) = (number(&line[0]), number(&line[1]));
    assert!(line.len() == 2 && end / increment <= number(&one("STEP").parameters["INC"]));
    assert_eq!(increment, 1.0, "the tables' points are whole seconds");
    end
}

/// Up to four pairs a line.
fn amplitude(card: &Card) -> Table {
    let full = card.lines.len() - 1;
    assert!(card.lines[..full].iter().all(|line| line.len() == 8) && card.lines[full].len() <= 8);
    let numbers: Vec<f64> = card.lines.iter().flatten().map(|value| number(value)).collect();
    numbers.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect()
}

/// Law and properties by the material's name.
fn materials(cards: &[Card], solver: Solver) -> BTreeMap<&str, (LawName, Vec<f64>)> {
    let starts = (0..cards.len()).filter(|&i| cards[i].keyword == "MATERIAL");
    starts
        .map(|start| {
            let own = |keyword: &str| {
                cards[start..].iter().find(|card| card.keyword == keyword).expect("the material's card")
            };
            let constants = own("USER MATERIAL");
            let values: Vec<f64> =
                constants.lines.iter().flatten().filter(|text| !text.is_empty()).map(|text| number(text)).collect();
            assert_eq!(count(&constants.parameters["CONSTANTS"]), values.len());
            assert!(!values.len().is_multiple_of(8), "CalculiX wants one more line");
            assert_eq!(constants.lines.len(), values.len().div_ceil(8), "eight a line");
            let name = cards[start].parameters["NAME"].as_str();
            assert_eq!(number(&own("DENSITY").lines[0][0]), 1.3514e-9);
            // Properties, variables, and those that CalculiX keeps besides.
            let (law, variables, kept, calculix) = match values.len() {
                11 => (LawName::Hyperelastic, 11, 0, "@TORON_HYPERELASTIC"),
                13 => (frictional(), 15, 0, "@TORON_FRICTIONAL"),
                10 => (LawName::LinearElastic, 10, 9, "@TORON_LINEARELASTIC"),
                other => panic!("no law has {other} properties"),
            };
            let depvar = own("DEPVAR");
            let wanted = if solver == Solver::Calculix { variables + kept } else { variables };
            assert_eq!(count(&depvar.lines[0][0]), wanted);
            match solver {
                Solver::Calculix => assert_eq!((name, depvar.lines.len()), (calculix, 1)),
                Solver::Standard => assert_eq!(depvar.lines.len(), 1 + variables),
                Solver::Explicit => {
                    assert_eq!(depvar.lines.len(), 1 + variables);
                    assert_eq!(count(&depvar.parameters["DELETE"]), variables);
                    assert_eq!(depvar.lines[variables][1], "ALIVE");
                }
            }
            (name, (law, values))
        })
        .collect()
}
