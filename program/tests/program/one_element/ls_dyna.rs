//! Keywords of LS-DYNA: the fields and the columns of each card, which the comment before a card names in the same
//! columns.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use toron_materials::material::laws::LawName;

use super::model::{Deck, Model, Table, columns, count, frictional, number};

/// The cards behind a keyword: names of the fields, and their width. The last card of a list may be repeated.
fn formats(keyword: &str) -> &'static [(&'static str, usize)] {
    match keyword {
        "*KEYWORD" | "*END" => &[],
        "*TITLE" => &[("title", 80)],
        "*CONTROL_TERMINATION" => &[("endtim endcyc dtmin endeng endmas nosol", 10)],
        "*CONTROL_TIMESTEP" => &[("dtinit tssfac isdo tslimt dt2ms lctm erode ms1st", 10)],
        "*CONTROL_ENERGY" => &[("hgen rwen slnten rylen", 10)],
        "*DATABASE_GLSTAT" | "*DATABASE_MATSUM" => &[("dt binary lcur ioopt", 10)],
        "*DATABASE_ELOUT" => &[("dt binary lcur ioopt option1 option2 option3 option4", 10)],
        "*DATABASE_HISTORY_SOLID" => &[("id1 id2 id3 id4 id5 id6 id7 id8", 10)],
        "*DATABASE_EXTENT_BINARY" => &[("neiph neips maxint strflg sigflg epsflg rltflg engflg", 10)],
        "*DATABASE_BINARY_D3PLOT" => &[("dt lcdt beam npltc psetid", 10)],
        "*NODE" => &[("nid x y z tc rc", 0)],
        "*ELEMENT_SOLID" => &[("eid pid n1 n2 n3 n4 n5 n6 n7 n8", 8)],
        "*PART" => &[("title", 80), ("pid secid mid eosid hgid grav adpopt tmid", 10)],
        "*SECTION_SOLID" => &[("secid elform aet", 10)],
        "*SET_NODE_LIST" => &[("sid da1 da2 da3 da4 solver", 10), ("nid1 nid2 nid3 nid4 nid5 nid6 nid7 nid8", 10)],
        "*BOUNDARY_SPC_SET" => &[("nsid cid dofx dofy dofz dofrx dofry dofrz", 10)],
        "*BOUNDARY_PRESCRIBED_MOTION_SET" => &[("nsid dof vad lcid sf vid death birth", 10)],
        "*DEFINE_CURVE" => &[("lcid sidr sfa sfo offa offo dattyp lcint", 10), ("a1 o1", 20)],
        "*MAT_USER_DEFINED_MATERIAL_MODELS_TITLE" => &[
            ("title", 80),
            ("mid ro mt lmc nhv iortho ibulk ig", 10),
            ("ivect ifail itherm ihyper ieos lmca", 10),
            ("", 10), // the properties, whose names are the law's
        ],
        other => panic!("no such keyword: {other}"),
    }
}

struct Card {
    keyword: String,
    lines: Vec<Vec<String>>,
}

impl Card {
    /// The field of this name in a line.
    fn field(&self, line: usize, name: &str) -> &str {
        let (names, _) = formats(&self.keyword)[line.min(formats(&self.keyword).len() - 1)];
        let index = names.split(' ').position(|known| known == name).expect("a field of the card");
        &self.lines[line][index]
    }
}

fn widths(names: &str, width: usize) -> Vec<usize> {
    match (names, width) {
        ("", width) => vec![width; 8],
        (_, 0) => vec![8, 16, 16, 16, 8, 8],
        (names, width) => vec![width; names.split(' ').count()],
    }
}

fn cards(text: &str) -> Vec<Card> {
    let (mut cards, mut heading): (Vec<Card>, Option<&str>) = (Vec::new(), None);
    for line in text.lines() {
        if line.starts_with('*') {
            formats(line);
            cards.push(Card { keyword: line.to_string(), lines: Vec::new() });
            heading = None;
        } else if line.starts_with("$#") {
            heading = Some(line);
        } else if !line.starts_with('$') {
            let card = cards.last_mut().expect("a keyword comes first");
            let formats = formats(&card.keyword);
            let (names, width) = *formats.get(card.lines.len()).or(formats.last()).expect("a keyword without cards");
            if names == "title" {
                card.lines.push(vec![line.to_string()]);
                continue;
            }
            let fields = columns(line, &widths(names, width));
            let heading = heading.unwrap_or_else(|| panic!("no names over {line}"));
            let said = columns(&heading.replacen("$#", "  ", 1), &widths(names, width));
            assert!(names.is_empty() || said.join(" ") == names, "{heading}");
            assert!(fields.len() <= said.len() && heading.len() >= line.len(), "{heading}\n{line}");
            card.lines.push(fields);
        }
    }
    cards
}

pub fn read(text: &str) -> Deck {
    let cards = cards(text);
    assert_eq!((cards[0].keyword.as_str(), cards[cards.len() - 1].keyword.as_str()), ("*KEYWORD", "*END"));
    let all = |keyword: &'static str| cards.iter().filter(move |card| card.keyword == keyword);
    let one = |keyword: &'static str| all(keyword).next().expect("the card");
    let mut model = Model::until(number(one("*CONTROL_TERMINATION").field(0, "endtim")));
    for line in &one("*NODE").lines {
        let place = Vector3::from_iterator(line[1..4].iter().map(|x| number(x)));
        assert!(model.nodes.insert(count(&line[0]), place).is_none());
    }
    let materials: BTreeMap<usize, (LawName, Vec<f64>)> =
        all("*MAT_USER_DEFINED_MATERIAL_MODELS_TITLE").map(material).collect();
    let history = materials.values().map(|(law, _)| variables(*law)).max().expect("a material");
    assert_eq!(count(one("*DATABASE_ELOUT").field(0, "option1")), history);
    assert_eq!(count(one("*DATABASE_EXTENT_BINARY").field(0, "neiph")), history);
    assert_eq!(one("*SECTION_SOLID").field(0, "elform"), "1");
    for (i, line) in one("*ELEMENT_SOLID").lines.iter().enumerate() {
        let part = all("*PART").find(|part| part.field(1, "pid") == line[1]).expect("the part");
        assert_eq!(part.field(1, "secid"), one("*SECTION_SOLID").field(0, "secid"));
        let (law, values) = materials[&count(part.field(1, "mid"))].clone();
        let nodes: Vec<usize> = line[2..].iter().map(|node| count(node)).collect();
        model.elements.push((count(&line[0]), nodes.try_into().expect("eight nodes"), law, values));
        assert_eq!(one("*DATABASE_HISTORY_SOLID").lines[0][i], line[0]);
    }
    let sets: BTreeMap<&str, Vec<usize>> = all("*SET_NODE_LIST")
        .map(|card| (card.field(0, "sid"), card.lines[1..].iter().flatten().map(|node| count(node)).collect()))
        .collect();
    for card in all("*BOUNDARY_SPC_SET") {
        for (component, name) in ["dofx", "dofy", "dofz"].into_iter().enumerate() {
            let nodes = if card.field(0, name) == "1" { sets[card.field(0, "nsid")].as_slice() } else { &[] };
            nodes.iter().for_each(|&node| model.prescribe(node, component, vec![(0.0, 0.0)]));
        }
    }
    let curves: BTreeMap<&str, Table> = all("*DEFINE_CURVE").map(|card| (card.field(0, "lcid"), curve(card))).collect();
    for card in all("*BOUNDARY_PRESCRIBED_MOTION_SET") {
        // A displacement, as the curve has it, at all times.
        assert_eq!(
            ["vad", "sf", "vid", "death", "birth"].map(|name| number(card.field(0, name))),
            [2.0, 1.0, 0.0, 0.0, 0.0]
        );
        let (component, curve) = (count(card.field(0, "dof")) - 1, &curves[card.field(0, "lcid")]);
        sets[card.field(0, "nsid")].iter().for_each(|&node| model.prescribe(node, component, curve.clone()));
    }
    model.deck()
}

fn curve(card: &Card) -> Table {
    assert_eq!(["sfa", "sfo", "offa", "offo"].map(|name| number(card.field(0, name))), [1.0, 1.0, 0.0, 0.0]);
    card.lines[1..].iter().map(|line| (number(&line[0]), number(&line[1]))).collect()
}

/// How many history variables a law has.
fn variables(law: LawName) -> usize {
    // The linear elastic law's axes are kept besides.
    law.description().state.len() + if law == LawName::LinearElastic { 9 } else { 0 }
}

/// Number, law and properties.
fn material(card: &Card) -> (usize, (LawName, Vec<f64>)) {
    let whole = |line: usize, name: &str| card.field(line, name).parse::<i64>().expect("a whole number");
    let law = match whole(1, "mt") {
        41 => LawName::Hyperelastic,
        43 => LawName::LinearElastic,
        44 => frictional(),
        other => panic!("no law has the number {other}"),
    };
    let mut values: Vec<f64> = card.lines[3..].iter().flatten().map(|value| number(value)).collect();
    assert_eq!((whole(1, "lmc") as usize, whole(1, "nhv") as usize), (values.len(), variables(law)));
    assert!(card.lines[3..card.lines.len() - 1].iter().all(|line| line.len() == 8));
    // F and stress in global axes; failed elements are deleted.
    assert_eq!((whole(1, "iortho"), whole(2, "ihyper"), whole(2, "ifail"), whole(2, "ivect")), (0, 1, 1, 0));
    let [bulk, shear] = ["ibulk", "ig"].map(|name| values[whole(1, name) as usize - 1]);
    assert!((bulk + 4.0 / 3.0 * shear - values[0]).abs() < 1e-9 * values[0], "the time step follows the fibre");
    assert_eq!(number(card.field(1, "ro")), 1.3514e-9);
    values.truncate(law.table().len());
    (count(card.field(1, "mid")), (law, values))
}
