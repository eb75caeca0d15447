//! Blocks of OpenRadioss's starter: fields of 10 columns for whole numbers and of 20 for others.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use toron_materials::material::laws::LawName;

use super::model::{Deck, Model, Table, columns, count, frictional, number};

/// A block: its keyword with the number cut off, the number, and its lines.
struct Block<'a> {
    keyword: &'a str,
    id: usize,
    lines: Vec<&'a str>,
}

const WHOLE: [usize; 10] = [10; 10];
const REAL: [usize; 5] = [20; 5];

fn blocks(text: &str) -> Vec<Block<'_>> {
    let mut blocks: Vec<Block> = Vec::new();
    for line in text.lines().filter(|line| !line.starts_with('#')) {
        assert!(line.is_ascii() && line.len() <= 100, "{line}");
        if line.starts_with('/') {
            let (keyword, id) =
                line.rsplit_once('/').filter(|(_, id)| id.parse::<usize>().is_ok()).unwrap_or((line, "0"));
            blocks.push(Block { keyword, id: count(id), lines: Vec::new() });
        } else {
            blocks.last_mut().expect("a block comes first").lines.push(line);
        }
    }
    blocks
}

pub fn read(text: &str) -> Deck {
    assert!(text.starts_with("#RADIOSS STARTER\n"));
    let blocks = blocks(text);
    const KNOWN: [&str; 14] = [
        "/BEGIN",
        "/MAT/USER01",
        "/MAT/USER02",
        "/MAT/USER03",
        "/PROP/TYPE14",
        "/PART",
        "/NODE",
        "/BRICK",
        "/GRNOD/NODE",
        "/BCS",
        "/FUNCT",
        "/IMPDISP",
        "/TH/BRIC",
        "/END",
    ];
    for block in &blocks {
        assert!(KNOWN.contains(&block.keyword), "{}", block.keyword);
    }
    let all = |keyword: &'static str| blocks.iter().filter(move |block| block.keyword == keyword);
    let find = |keyword: &'static str, id: &str| all(keyword).find(|block| block.id == count(id)).expect("the block");
    let begin = all("/BEGIN").next().expect("the beginning");
    let name = begin.lines[0];
    assert_eq!(columns(begin.lines[2], &REAL), ["Mg", "mm", "s"]);
    let mut model = Model::until(end(name));
    for line in all("/NODE").flat_map(|block| &block.lines) {
        let fields = columns(line, &[10, 20, 20, 20]);
        model.nodes.insert(count(&fields[0]), Vector3::from_iterator(fields[1..].iter().map(|x| number(x))));
    }
    for brick in all("/BRICK") {
        let part = columns(find("/PART", &brick.id.to_string()).lines[1], &WHOLE);
        property(find("/PROP/TYPE14", &part[0]));
        let (law, values) =
            material(blocks.iter().find(|block| block.keyword.starts_with("/MAT/") && block.id == count(&part[1])));
        for line in &brick.lines {
            let numbers: Vec<usize> = columns(line, &WHOLE).iter().map(|field| count(field)).collect();
            model.elements.push((numbers[0], numbers[1..].try_into().expect("eight nodes"), law, values.clone()));
        }
    }
    let groups: BTreeMap<usize, Vec<usize>> = all("/GRNOD/NODE")
        .map(|block| {
            (
                block.id,
                block.lines[1..].iter().flat_map(|line| columns(line, &WHOLE)).map(|node| count(&node)).collect(),
            )
        })
        .collect();
    for block in all("/BCS") {
        // Six switches in the first field, then the skew system and the group.
        let (switches, rest) = block.lines[1].split_at(10);
        let rest = columns(rest, &WHOLE);
        let switches: Vec<&str> = switches.split_whitespace().collect();
        assert_eq!((switches.len(), switches[0].len(), switches[1], rest[0].as_str()), (2, 3, "000", "0"));
        for (component, _) in switches[0].char_indices().filter(|(_, switch)| *switch == '1') {
            groups[&count(&rest[1])].iter().for_each(|&node| model.prescribe(node, component, vec![(0.0, 0.0)]));
        }
    }
    for block in all("/IMPDISP") {
        let fields = columns(block.lines[1], &WHOLE);
        let component = "XYZ".find(&fields[1]).expect("a direction");
        assert_eq!(columns(block.lines[2], &REAL).iter().map(|x| number(x)).collect::<Vec<_>>(), [1.0, 1.0, 0.0, 0.0]);
        let function = find("/FUNCT", &fields[0]);
        let pair = |line: &&str| columns(line, &REAL).iter().map(|x| number(x)).collect::<Vec<_>>();
        let table: Table = function.lines[1..].iter().map(pair).map(|pair| (pair[0], pair[1])).collect();
        groups[&count(&fields[4])].iter().for_each(|&node| model.prescribe(node, component, table.clone()));
    }
    for block in all("/TH/BRIC") {
        let elements: Vec<usize> = block.lines[2..].iter().map(|line| count(line)).collect();
        assert_eq!(elements, model.elements.iter().map(|element| element.0).collect::<Vec<_>>());
    }
    model.deck()
}

/// The end of the run, from the engine's file.
fn end(name: &str) -> f64 {
    let path = format!("{}/examples/one-element/openradioss/{name}_0001.rad", toron_test_support::library::ROOT);
    let engine = std::fs::read_to_string(path).expect("the engine's file");
    assert!(engine.starts_with("#RADIOSS ENGINE\n"));
    let (_, run) = engine.split_once(&format!("/RUN/{name}/1\n")).expect("the run's name is the starter's");
    number(run.lines().next().expect("the end"))
}

/// Isolid 1, Ismstr 10, Iframe 1: all others give F in other axes, or none.
fn property(block: &Block) {
    let fields = columns(block.lines[1], &[10, 10, 20, 20, 10, 10, 20]);
    assert_eq!([&fields[0], &fields[1], &fields[5]].map(|field| count(field)), [1, 10, 1]);
    assert_eq!(block.lines.len(), 4);
}

/// Law and properties; the options behind them are 0.
fn material(block: Option<&Block>) -> (LawName, Vec<f64>) {
    let block = block.expect("the material");
    let (law, options) = match block.keyword {
        "/MAT/USER01" => (LawName::Hyperelastic, 1),
        "/MAT/USER02" => (LawName::LinearElastic, 3),
        _ => (frictional(), 1),
    };
    assert_eq!(number(block.lines[1]), 1.3514e-9);
    let lines = &block.lines[2..];
    assert!(lines[..lines.len() - 1].iter().all(|line| columns(line, &REAL).len() == 5));
    let mut values: Vec<f64> = lines.iter().flat_map(|line| columns(line, &REAL)).map(|value| number(&value)).collect();
    let chosen = values.split_off(law.table().len());
    assert_eq!(chosen, vec![0.0; options]);
    (law, values)
}
