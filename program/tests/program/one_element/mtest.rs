//! Instructions of MTest.

use std::collections::BTreeMap;

use nalgebra::Matrix3;
use toron_materials::material::laws::LawName;

use super::model::{Deck, Point, Table, frictional, interpolate, number};

pub fn read(text: &str) -> Deck {
    let lines: Vec<&str> = text.lines().filter(|line| !line.starts_with("//")).collect();
    // Instructions end with a semicolon, a comment may follow.
    let source: String =
        lines.iter().map(|line| format!("{} ", line.split("//").next().unwrap_or(line).trim())).collect();
    let instructions: Vec<&str> = source.split(';').map(str::trim).filter(|text| !text.is_empty()).collect();
    let all = |keyword: &'static str| instructions.iter().filter_map(move |text| text.strip_prefix(keyword));
    let one = |keyword: &'static str| all(keyword).next().unwrap_or_else(|| panic!("no {keyword}"));
    const KEYWORDS: [&str; 6] = [
        "@ModellingHypothesis ",
        "@Behaviour<",
        "@MaterialProperty<",
        "@ExternalStateVariable ",
        "@Imposed",
        "@Times ",
    ];
    for text in &instructions {
        assert!(KEYWORDS.iter().any(|keyword| text.starts_with(keyword)), "{text}");
    }
    assert_eq!(one("@ModellingHypothesis "), "'Tridimensional'");
    let law = match one("@Behaviour<generic> ") {
        "'libtoron_mgis.so' 'ToronHyperelastic'" => LawName::Hyperelastic,
        "'libtoron_mgis.so' 'ToronLinearElastic'" => LawName::LinearElastic,
        "'libtoron_mgis.so' 'ToronFrictional'" => frictional(),
        other => panic!("{other}"),
    };
    let properties: BTreeMap<&str, f64> =
        all("@MaterialProperty<constant> ").map(quoted).map(|(name, value)| (name, number(value))).collect();
    let table = law.table();
    assert_eq!(properties.len(), table.len());
    let values = table.iter().map(|property| properties[property.name]).collect();
    let gradients: BTreeMap<&str, Table> = all("@ImposedDeformationGradient<evolution> ")
        .map(quoted)
        .map(|(name, evolution)| {
            let pairs = evolution.strip_prefix('{').and_then(|text| text.strip_suffix('}')).expect("an evolution");
            let pair = |text: &str| text.split_once(':').map(|(time, value)| (number(time), number(value)));
            (name, pairs.split(',').map(|text| pair(text).expect("time and value")).collect())
        })
        .collect();
    assert_eq!(gradients.len(), 9);
    // {0., 60. in 60}: an increment a second, which meets the points of all evolutions.
    let times = one("@Times ").trim_matches(['{', '}']);
    let (start, rest) = times.split_once(',').expect("two times");
    let (end, increments) = rest.split_once(" in ").expect("a number of increments");
    let end = number(end);
    assert_eq!((number(start), number(increments)), (0.0, end));
    for table in gradients.values() {
        assert!(
            table[0].0 == 0.0 && table[table.len() - 1].0 == end && table.iter().all(|(time, _)| time.fract() == 0.0)
        );
    }
    // F by columns.
    let names = ["FXX", "FYX", "FZX", "FXY", "FYY", "FZY", "FXZ", "FYZ", "FZZ"];
    let tables = names.map(|name| gradients[name].clone());
    let path = move |time: f64| Matrix3::from_iterator(tables.iter().map(|table| interpolate(table, time)));
    Deck { end, points: vec![Point { label: "the point".to_string(), law, values, path: Box::new(path) }] }
}

/// A quoted name, and what follows it.
fn quoted(text: &str) -> (&str, &str) {
    let (name, rest) = text.trim().strip_prefix('\'').and_then(|text| text.split_once('\'')).expect("a quoted name");
    (name, rest.trim())
}
