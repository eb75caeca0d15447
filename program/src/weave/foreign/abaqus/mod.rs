//! Abaqus input: `*NODE`, `*ELEMENT` of C3D8 and C3D6, a yarn for each `*SOLID SECTION`, fibre directions by `*DISTRIBUTION`.
//!
//! TexGen writes such files of dry fibres, with the directions in a file of their own beside the input.

use std::collections::HashMap;

use super::raw::{Line, Numbered, Raw, included, lines, of_wedge};
use crate::common::error::Error;

const PARTS: &str = "elements of the set of one *SOLID SECTION or, without sections, of *ELEMENT, ELSET=NAME";
/// So deep may files include others.
const DEEPEST: usize = 8;

/// # Errors
/// What in the file is wrong, by line.
pub fn read(file: &str, text: &str) -> Result<Raw, Error> {
    let mut reader = Reader::default();
    reader.read(file, text, Block::None, 0)?;
    reader.finish(file)
}

#[derive(Default)]
struct Reader {
    mesh: Numbered,
    sets: HashMap<String, Vec<Member>>,
    /// Sets of `*ELEMENT` and of sections, in their order, with the places of their lines.
    of_elements: Vec<(String, String, usize)>,
    of_sections: Vec<(String, String, usize)>,
    directions: Vec<(Member, [f64; 3])>,
    /// The direction of elements that no line names.
    default: Option<[f64; 3]>,
}

#[derive(Clone)]
enum Member {
    Element(u64),
    Set(String),
}

/// What the lines after a keyword are.
#[derive(Clone)]
enum Block {
    None,
    Nodes,
    /// Nodes of an element, and the set that it belongs to.
    Elements(usize, Option<String>),
    Set(String),
    Range(String),
    Directions,
}

/// A keyword line: its name, and parameters in capitals with their values.
struct Keyword<'a> {
    name: String,
    parameters: Vec<(String, &'a str)>,
}

impl<'a> Keyword<'a> {
    fn new(text: &'a str) -> Keyword<'a> {
        let mut parts = text.trim_start_matches('*').split(',');
        let name = parts.next().unwrap_or_default().trim().to_uppercase();
        let parameter = |part: &'a str| {
            let (key, value) = part.split_once('=').unwrap_or((part, ""));
            (key.trim().to_uppercase(), value.trim().trim_matches('"'))
        };
        Keyword { name, parameters: parts.map(parameter).collect() }
    }

    fn value(&self, key: &str) -> Option<&'a str> {
        self.parameters.iter().find(|(name, _)| name == key).map(|(_, value)| *value)
    }
}

impl Reader {
    fn read(&mut self, file: &str, text: &str, mut block: Block, depth: usize) -> Result<(), Error> {
        for line in lines(file, text) {
            let text = line.text.trim();
            if text.is_empty() || text.starts_with("**") {
                continue;
            }
            if text.starts_with('*') {
                block = self.keyword(&line, &Keyword::new(text), depth)?;
            } else {
                self.data(&line, text, &block)?;
            }
        }
        Ok(())
    }

    fn keyword(&mut self, line: &Line<'_>, keyword: &Keyword<'_>, depth: usize) -> Result<Block, Error> {
        let set = |key: &str| keyword.value(key).map(str::to_uppercase);
        let block = match keyword.name.as_str() {
            "NODE" => match set("SYSTEM") {
                Some(system) if system != "R" => {
                    return Err(line.error(&format!("*NODE, SYSTEM={system}; allowed: R, rectangular coordinates")));
                }
                _ => Block::Nodes,
            },
            "ELEMENT" => {
                let kind = keyword.value("TYPE").unwrap_or_default().to_uppercase();
                let nodes = match kind.get(..4) {
                    Some("C3D8") => 8,
                    Some("C3D6") => 6,
                    _ => {
                        let message = format!("elements of type {kind}; allowed: C3D8 and C3D6 and their variants");
                        return Err(line.error(&message));
                    }
                };
                let set = set("ELSET");
                let new = set.iter().filter(|set| !self.of_elements.iter().any(|(name, ..)| name == *set));
                let new: Vec<_> = new.map(|set| (set.clone(), line.file.to_string(), line.number)).collect();
                self.of_elements.extend(new);
                Block::Elements(nodes, set)
            }
            "ELSET" => {
                let name = set("ELSET").unwrap_or_default();
                if keyword.value("GENERATE").is_some() { Block::Range(name) } else { Block::Set(name) }
            }
            "SOLID SECTION" => {
                let name = set("ELSET").ok_or_else(|| line.error("*SOLID SECTION without ELSET; allowed: a set"))?;
                self.of_sections.push((name, line.file.to_string(), line.number));
                Block::None
            }
            "DISTRIBUTION" if set("LOCATION").is_none_or(|location| location == "ELEMENT") => Block::Directions,
            "ELGEN" | "ELCOPY" | "NGEN" | "NCOPY" | "NFILL" => {
                return Err(line.error(&format!("*{}; allowed: nodes and elements one by one", keyword.name)));
            }
            "INSTANCE" => return Err(line.error("*INSTANCE; allowed: a flat input, as of a mesh alone")),
            _ => Block::None,
        };
        let inside =
            if keyword.name == "INCLUDE" || !matches!(block, Block::None) { keyword.value("INPUT") } else { None };
        if let Some(name) = inside {
            if depth == DEEPEST {
                return Err(line.error(&format!("files that include others are {DEEPEST} deep; allowed: fewer")));
            }
            let (file, text) = included(line, name)?;
            self.read(&file, &text, block.clone(), depth + 1)?;
        }
        Ok(block)
    }

    fn data(&mut self, line: &Line<'_>, text: &str, block: &Block) -> Result<(), Error> {
        let fields: Vec<&str> = text.trim_end_matches(',').split(',').map(str::trim).collect();
        match block {
            Block::None => {}
            Block::Nodes => {
                let [number, x, y, z] = fields[..] else {
                    return Err(line.error("a node has a number and three coordinates"));
                };
                let place = [line.real("x", x)?, line.real("y", y)?, line.real("z", z)?];
                self.mesh.add_node(line, line.number("a node's number", number)?, place)?;
            }
            Block::Elements(count, set) => {
                let numbers = fields.iter().map(|field| line.number("a number of an element", field));
                let numbers = numbers.collect::<Result<Vec<u64>, Error>>()?;
                let nodes = match (count, &numbers[..]) {
                    (6, &[_, a, b, c, d, e, f]) => of_wedge([a, b, c, d, e, f]),
                    (8, &[_, a, b, c, d, e, f, g, h]) => [a, b, c, d, e, f, g, h],
                    _ => return Err(line.error(&format!("an element has a number and {count} nodes on one line"))),
                };
                self.mesh.add_element(line, numbers[0], nodes)?;
                if let Some(set) = set {
                    self.sets.entry(set.clone()).or_default().push(Member::Element(numbers[0]));
                }
            }
            Block::Set(name) => {
                let members = fields.iter().filter(|field| !field.is_empty()).map(|field| member(field));
                self.sets.entry(name.clone()).or_default().extend(members);
            }
            Block::Range(name) => {
                let number = |i: usize| fields.get(i).map(|field| line.number::<u64>("a number of a range", field));
                let (Some(first), Some(last)) = (number(0), number(1)) else {
                    return Err(line.error("a range of elements has its first and its last number"));
                };
                let (first, last, step) = (first?, last?, number(2).transpose()?.unwrap_or(1).max(1));
                let members = self.sets.entry(name.clone()).or_default();
                // Numbers that no element has are no members: a set may not be larger than the mesh.
                let mut found: Vec<u64> =
                    self.mesh.element.keys().copied().filter(|n| (first..=last).contains(n)).collect();
                found.retain(|number| (number - first).is_multiple_of(step));
                found.sort_unstable();
                members.extend(found.into_iter().map(Member::Element));
            }
            Block::Directions => {
                // A distribution of something else has fewer numbers.
                let [label, x, y, z, ..] = fields[..] else { return Ok(()) };
                let direction =
                    [line.real("a direction", x)?, line.real("a direction", y)?, line.real("a direction", z)?];
                if label.is_empty() {
                    self.default = Some(direction);
                } else {
                    self.directions.push((member(label), direction));
                }
            }
        }
        Ok(())
    }

    fn finish(self, file: &str) -> Result<Raw, Error> {
        let parts = if self.of_sections.is_empty() { &self.of_elements } else { &self.of_sections };
        if parts.is_empty() {
            return Err(Error::Input(format!("{file}: nothing says which elements are a yarn; allowed: {PARTS}")));
        }
        let (mut yarns, mut yarn) = (Vec::new(), vec![None; self.mesh.element.len()]);
        for (name, file, number) in parts {
            let line = Line { file, number: *number, text: "" };
            let mut found = Vec::new();
            self.members(name, &mut found, 0);
            if found.is_empty() {
                return Err(line.error(&format!("set {name} has no elements; allowed: a set of a yarn's elements")));
            }
            for number in found {
                let Some(&place) = self.mesh.element.get(&number) else {
                    let message = format!("set {name} has element {number}, which the file does not have");
                    return Err(line.error(&message));
                };
                if yarn[place].replace(yarns.len()).is_some_and(|other| other != yarns.len()) {
                    return Err(
                        line.error(&format!("element {number} of set {name} is of another yarn too; allowed: {PARTS}"))
                    );
                }
            }
            yarns.push(name.clone());
        }
        let mut directions = HashMap::new();
        if let Some(default) = self.default {
            directions.extend(self.mesh.element.keys().map(|&number| (number, default)));
        }
        for (member, direction) in &self.directions {
            let mut found = Vec::new();
            match member {
                Member::Element(number) => found.push(*number),
                Member::Set(name) => self.members(name, &mut found, 0),
            }
            let unknown = found.iter().find(|number| !self.mesh.element.contains_key(number));
            let unknown = match (member, unknown) {
                (_, Some(number)) => Some(format!("element {number}")),
                (Member::Set(name), None) if found.is_empty() => Some(format!("set {name}")),
                _ => None,
            };
            if let Some(unknown) = unknown {
                let message = format!("*DISTRIBUTION has a direction of {unknown}, which the file does not have");
                return Err(Error::Input(format!("{file}: {message}")));
            }
            directions.extend(found.into_iter().map(|number| (number, *direction)));
        }
        self.mesh.finish(yarns, &yarn, &directions, PARTS)
    }

    /// The elements of a set, and of the sets in it.
    fn members(&self, name: &str, found: &mut Vec<u64>, depth: usize) {
        for member in self.sets.get(name).into_iter().flatten() {
            match member {
                Member::Element(number) => found.push(*number),
                Member::Set(name) if depth < DEEPEST => self.members(name, found, depth + 1),
                Member::Set(_) => {}
            }
        }
    }
}

fn member(field: &str) -> Member {
    field.parse().map_or_else(|_| Member::Set(field.to_uppercase()), Member::Element)
}
