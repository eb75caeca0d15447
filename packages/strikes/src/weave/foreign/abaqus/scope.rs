//! What has names and numbers of its own, as its keywords and lines are read.

use std::collections::{HashMap, HashSet};

use super::Block;
use super::keywords::nodes_of;
use super::motion::Motion;
use super::orientation::{Distribution, Orientation};
use crate::weave::foreign::raw::{Numbered, of_wedge};
use toron_shared::error::Error;
use toron_shared::keyword_file::abaqus::{Keyword, label};
use toron_shared::keyword_file::line::{Line, Place};

/// What has names and numbers of its own: a flat file, a part, an instance.
#[derive(Clone, Default)]
pub struct Scope {
    pub kind: Kind,
    pub mesh: Numbered,
    /// Elements that are no volumes.
    pub others: HashSet<u64>,
    pub sets: HashMap<String, Vec<Member>>,
    /// Sets that may be yarns, in their order: those of `*SOLID SECTION`, of `*ELEMENT` and of `*ELSET`.
    pub sections: Vec<Section>,
    pub of_elements: Vec<Section>,
    pub of_sets: Vec<Section>,
    pub orientations: HashMap<String, Orientation>,
    pub distributions: HashMap<String, Distribution>,
    /// Whether the entries of a distribution begin with a vector, by its table.
    pub tables: HashMap<String, bool>,
}

#[derive(Clone, Default)]
pub enum Kind {
    #[default]
    File,
    Part(String, Place),
    Instance(String, Place, Motion),
}

#[derive(Clone)]
pub struct Section {
    pub set: String,
    pub orientation: Option<String>,
    pub place: Place,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Member {
    Element(u64),
    /// First, last and step.
    Range([u64; 3]),
    Set(String),
}

impl Member {
    pub fn of(field: &str) -> Member {
        field.parse().map_or_else(|_| Member::Set(label(field)), Member::Element)
    }
}

/// The lines of `*ELEMENT`.
#[derive(Clone)]
pub struct Elements {
    /// Nodes of an element; none where they are no volumes.
    pub nodes: Option<usize>,
    pub set: Option<String>,
    /// Numbers of the element that goes on in the next line, and where it began.
    pub begun: Option<(Vec<u64>, Place)>,
}

impl Kind {
    pub fn name(&self) -> String {
        match self {
            Kind::File => "the file".to_string(),
            Kind::Part(name, place) => format!("*PART {name} of line {}", place.line),
            Kind::Instance(name, place, _) => format!("*INSTANCE {name} of line {}", place.line),
        }
    }
}

/// First, last and step of a line of `*ELSET, GENERATE`.
///
/// # Errors
/// It is no range.
pub fn range(line: &Line<'_>, fields: &[&str]) -> Result<Member, Error> {
    let number = |i: usize| line.number::<u64>("a number of a range", fields[i]);
    let step = match fields.len() {
        2 => 1,
        3 if fields[2].is_empty() => 1,
        3 => number(2)?,
        _ => return Err(line.error("a range of elements has its first and its last number, and a step")),
    };
    let [first, last] = [number(0)?, number(1)?];
    if last < first || step == 0 {
        return Err(line.error(&format!("a range from {first} to {last} by {step}; allowed: upwards, by 1 or more")));
    }
    Ok(Member::Range([first, last, step]))
}

impl Scope {
    /// What the lines behind a keyword are that changes the mesh.
    pub fn block(&mut self, keyword: &Keyword<'_>) -> Result<Block, Error> {
        let line = &keyword.line;
        let section = |set: &str, orientation| Section { set: set.to_string(), orientation, place: line.place() };
        Ok(match keyword.name.as_str() {
            "NODE" => {
                keyword.allow(&["NSET", "INPUT", "SYSTEM"])?;
                match keyword.label("SYSTEM") {
                    Some(system) if system != "R" => {
                        return Err(line.error(&format!("*NODE, SYSTEM={system}; allowed: R, rectangular coordinates")));
                    }
                    _ => Block::Nodes,
                }
            }
            "ELEMENT" => {
                keyword.allow(&["TYPE", "ELSET", "INPUT"])?;
                let elements = Elements { nodes: nodes_of(keyword)?, set: keyword.label("ELSET"), begun: None };
                let new = elements.set.as_ref().filter(|_| elements.nodes.is_some());
                if let Some(set) = new.filter(|set| self.of_elements.iter().all(|other| other.set != **set)) {
                    self.of_elements.push(section(set, None));
                }
                Block::Elements(elements)
            }
            "ELSET" => {
                keyword.allow(&["ELSET", "GENERATE", "INTERNAL", "UNSORTED", "INSTANCE"])?;
                let name = keyword.needed("ELSET")?;
                // Sets of the assembly are of elements in instances: no section is there.
                if keyword.value("INSTANCE").is_some() {
                    return Ok(Block::Nothing);
                }
                if keyword.value("INTERNAL").is_none() && self.of_sets.iter().all(|other| other.set != name) {
                    self.of_sets.push(section(&name, None));
                }
                if keyword.value("GENERATE").is_some() { Block::Range(name) } else { Block::Set(name) }
            }
            "SOLIDSECTION" => {
                keyword.allow(&["ELSET", "MATERIAL", "ORIENTATION", "CONTROLS"])?;
                let set = keyword.needed("ELSET")?;
                self.sections.push(section(&set, keyword.label("ORIENTATION")));
                Block::Nothing
            }
            "DISTRIBUTIONTABLE" => Block::Table(keyword.needed("NAME")?),
            "DISTRIBUTION" => {
                keyword.allow(&["NAME", "LOCATION", "TABLE", "INPUT"])?;
                match keyword.label("LOCATION").as_deref() {
                    None | Some("ELEMENT") => {}
                    // Of nodes: thicknesses and offsets, of no solid.
                    Some("NODE") => return Ok(Block::Nothing),
                    Some(other) => {
                        return Err(line.error(&format!("*DISTRIBUTION, LOCATION={other}; allowed: ELEMENT, NODE")));
                    }
                }
                let name = keyword.label("NAME").unwrap_or_default();
                let distribution = Distribution::new(line.place(), keyword.label("TABLE"));
                if self.distributions.insert(name.clone(), distribution).is_some() {
                    return Err(
                        line.error(&format!("there is a *DISTRIBUTION {name} already; allowed: each name once"))
                    );
                }
                Block::Distribution(name)
            }
            _ => {
                keyword.allow(&["NAME", "SYSTEM", "DEFINITION", "LOCALDIRECTIONS"])?;
                let name = keyword.needed("NAME")?;
                if self.orientations.insert(name.clone(), Orientation::new(keyword)).is_some() {
                    return Err(
                        line.error(&format!("there is an *ORIENTATION {name} already; allowed: each name once"))
                    );
                }
                Block::Orientation(name)
            }
        })
    }

    pub fn add_node(&mut self, line: &Line<'_>, fields: &[&str]) -> Result<(), Error> {
        // Behind the coordinates there may be a normal, of shells.
        let [number, places @ ..] = fields else { return Ok(()) };
        if !(1..=6).contains(&places.len()) {
            return Err(line.error("a node has a number and three coordinates"));
        }
        let coordinate = |i: usize| line.real(["x", "y", "z"][i], places.get(i).copied().unwrap_or_default());
        let place = [coordinate(0)?, coordinate(1)?, coordinate(2)?];
        self.mesh.add_node(line, line.number("a node's number", number)?, place)
    }

    pub fn add_elements(
        &mut self,
        line: &Line<'_>,
        elements: &mut Elements,
        fields: &[&str],
        goes_on: bool,
    ) -> Result<(), Error> {
        let Elements { nodes, set, begun } = elements;
        let (mut numbers, place) = begun.take().unwrap_or_else(|| (Vec::new(), line.place()));
        for field in fields {
            numbers.push(line.number("a number of an element", field)?);
        }
        let Some(count) = *nodes else {
            // Of an element of another kind, only a missing comma marks the end.
            self.others.insert(numbers[0]);
            self.add_to_set(set.as_ref(), numbers[0]);
            *begun = goes_on.then_some((numbers, place));
            return Ok(());
        };
        if numbers.len() <= count {
            *begun = Some((numbers, place));
            return Ok(());
        }
        let nodes = match (count, &numbers[1..]) {
            (6, &[a, b, c, d, e, f]) => of_wedge([a, b, c, d, e, f]),
            (8, &[a, b, c, d, e, f, g, h]) => [a, b, c, d, e, f, g, h],
            (_, found) => {
                let found = found.len();
                return Err(place.error(&format!("element {} has {found} nodes; allowed: {count}", numbers[0])));
            }
        };
        self.mesh.add_element(place, numbers[0], nodes)?;
        self.add_to_set(set.as_ref(), numbers[0]);
        Ok(())
    }

    fn add_to_set(&mut self, set: Option<&String>, number: u64) {
        if let Some(set) = set {
            self.sets.entry(set.clone()).or_default().push(Member::Element(number));
        }
    }
}
