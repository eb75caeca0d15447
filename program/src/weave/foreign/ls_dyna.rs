//! LS-DYNA keyword files: `*NODE`, `*ELEMENT_SOLID` or `*ELEMENT_SOLID_ORTHO`, a yarn for each part.

use std::collections::HashMap;

use super::raw::{Line, Numbered, Raw, included, lines};
use crate::common::error::Error;

const PARTS: &str = "elements of a part";
/// So deep may files include others.
const DEEPEST: usize = 8;

/// # Errors
/// What in the file is wrong, by line.
pub fn read(file: &str, text: &str) -> Result<Raw, Error> {
    let mut reader = Reader::default();
    reader.read(file, text, 0)?;
    reader.finish()
}

#[derive(Default)]
struct Reader {
    mesh: Numbered,
    /// The number of an element's part, in the order of the elements.
    part: Vec<u64>,
    directions: HashMap<u64, [f64; 3]>,
    /// Titles of parts by their numbers, and where they are.
    titles: Vec<(u64, String, String, usize)>,
    /// Elements that are no solids have parts too.
    others: bool,
}

/// What the next line is.
#[derive(Clone, Copy)]
enum Next {
    Nothing,
    Node,
    /// The first card of an element, and whether two of axes follow its nodes.
    Element(bool),
    NodesOf(u64, bool),
    Fibre(u64),
    Second,
    Title,
    Part,
    File,
}

impl Reader {
    fn read(&mut self, file: &str, text: &str, depth: usize) -> Result<(), Error> {
        let mut next = Next::Nothing;
        let mut title = String::new();
        for line in lines(file, text) {
            if line.text.starts_with('$') || line.text.trim().is_empty() {
                continue;
            }
            if line.text.starts_with('*') {
                next = self.keyword(&line)?;
                continue;
            }
            next = match next {
                Next::Nothing => Next::Nothing,
                Next::Node => {
                    let [number, x, y, z] = fields(line.text, [8, 16, 16, 16]);
                    let place = [line.real("x", x)?, line.real("y", y)?, line.real("z", z)?];
                    self.mesh.add_node(&line, line.number("a node's number", number)?, place)?;
                    Next::Node
                }
                Next::Element(axes) => {
                    let [element, part] = fields(line.text, [8, 8]);
                    self.part.push(line.number("a part's number", part)?);
                    let element = line.number("an element's number", element)?;
                    let all: [&str; 10] = fields(line.text, [8; 10]);
                    // The older format has all numbers on one line.
                    if all[2].trim().is_empty() {
                        Next::NodesOf(element, axes)
                    } else {
                        self.element(&line, element, &all[2..], axes)?
                    }
                }
                Next::NodesOf(element, axes) => {
                    let nodes: [&str; 8] = fields(line.text, [8; 8]);
                    self.element(&line, element, &nodes, axes)?
                }
                Next::Fibre(element) => {
                    let axis: [&str; 3] = fields(line.text, [16; 3]);
                    let [x, y, z] = axis.map(|field| line.real("a direction", field));
                    self.directions.insert(element, [x?, y?, z?]);
                    Next::Second
                }
                Next::Second => Next::Element(true),
                Next::Title => {
                    title = line.text.trim().to_string();
                    Next::Part
                }
                Next::Part => {
                    let [number] = fields(line.text, [10]);
                    let number = line.number("a part's number", number)?;
                    self.titles.push((number, title.clone(), file.to_string(), line.number));
                    Next::Title
                }
                Next::File => {
                    if depth == DEEPEST {
                        return Err(
                            line.error(&format!("files that include others are {DEEPEST} deep; allowed: fewer"))
                        );
                    }
                    let (file, text) = included(&line, line.text)?;
                    self.read(&file, &text, depth + 1)?;
                    Next::File
                }
            };
        }
        Ok(())
    }

    fn keyword(&mut self, line: &Line<'_>) -> Result<Next, Error> {
        let keyword = line.text.trim().to_uppercase();
        let name = keyword.split_whitespace().next().unwrap_or_default();
        Ok(match name {
            "*KEYWORD" if keyword.contains("LONG=Y") => {
                return Err(line.error("LONG=Y; allowed: the standard format, or fields between commas"));
            }
            "*NODE" => Next::Node,
            "*ELEMENT_SOLID" => Next::Element(false),
            "*ELEMENT_SOLID_ORTHO" => Next::Element(true),
            "*PART" => Next::Title,
            "*INCLUDE" => Next::File,
            _ if name.starts_with("*ELEMENT_SOLID") => {
                let message = format!("{name}; allowed: *ELEMENT_SOLID and *ELEMENT_SOLID_ORTHO");
                return Err(line.error(&message));
            }
            _ => {
                self.others |= name.starts_with("*ELEMENT");
                Next::Nothing
            }
        })
    }

    fn element(&mut self, line: &Line<'_>, element: u64, nodes: &[&str], axes: bool) -> Result<Next, Error> {
        let mut numbers = [0; 8];
        for (number, field) in numbers.iter_mut().zip(nodes) {
            *number = line.number(&format!("a node of element {element}"), field)?;
        }
        self.mesh.add_element(line, element, numbers)?;
        Ok(if axes { Next::Fibre(element) } else { Next::Element(false) })
    }

    fn finish(self) -> Result<Raw, Error> {
        let mut numbers = self.part.clone();
        numbers.sort_unstable();
        numbers.dedup();
        let place = |number: &u64| numbers.binary_search(number).ok();
        let empty = self.titles.iter().find(|(number, ..)| !self.others && place(number).is_none());
        if let Some((number, title, file, line)) = empty {
            let line = Line { file, number: *line, text: "" };
            return Err(line.error(&format!("part {number}, {title}, has no elements; allowed: a yarn's elements")));
        }
        let name = |number: &u64| {
            let title = self.titles.iter().find(|(part, ..)| part == number);
            title.map_or_else(|| format!("part {number}"), |(_, title, ..)| title.clone())
        };
        let yarn: Vec<Option<usize>> = self.part.iter().map(place).collect();
        self.mesh.finish(numbers.iter().map(name).collect(), &yarn, &self.directions, PARTS)
    }
}

/// The fields of a line: between commas, or of so many columns; empty ones where the line ends.
fn fields<const N: usize>(text: &str, widths: [usize; N]) -> [&str; N] {
    let mut found = [""; N];
    if text.contains(',') {
        found.iter_mut().zip(text.split(',')).for_each(|(field, part)| *field = part);
        return found;
    }
    let mut start = 0;
    for (field, width) in found.iter_mut().zip(widths) {
        *field = text.get(start..(start + width).min(text.len())).unwrap_or_default();
        start += width;
    }
    found
}
