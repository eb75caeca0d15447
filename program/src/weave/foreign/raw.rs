//! What a mesh file says, whatever its format.

use std::collections::HashMap;
use std::path::Path;
use std::str::FromStr;

use crate::common::error::Error;

/// Nodes and elements of a file, with numbers from 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Raw {
    pub nodes: Vec<[f64; 3]>,
    pub elements: Vec<Element>,
    /// What the file calls its yarns.
    pub yarns: Vec<String>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    /// The file's own.
    pub number: u64,
    /// Nodes 1 to 4 around a face, 5 to 8 around the one across from it, as solvers number a hexahedron. Of a wedge some nodes are
    /// the same.
    pub nodes: [u32; 8],
    pub yarn: usize,
    /// Of the fibre, where the file says it: of any length.
    pub direction: Option<[f64; 3]>,
}

/// A hexahedron of a wedge's nodes, around a triangle and then around the other.
pub fn of_wedge<T: Copy>([a, b, c, d, e, f]: [T; 6]) -> [T; 8] {
    [a, b, c, c, d, e, f, f]
}

/// A line of a text file.
#[derive(Clone, Copy, Debug)]
pub struct Line<'a> {
    pub file: &'a str,
    /// From 1.
    pub number: usize,
    pub text: &'a str,
}

impl Line<'_> {
    pub fn error(&self, message: &str) -> Error {
        Error::Input(format!("{}:{}: {message}", self.file, self.number))
    }

    /// A field as a number.
    ///
    /// # Errors
    /// It is none.
    pub fn number<T: FromStr>(&self, what: &str, field: &str) -> Result<T, Error> {
        field.trim().parse().map_err(|_| self.error(&format!("{what} is \"{}\"; allowed: a number", field.trim())))
    }

    /// A field as a coordinate or a component, with an exponent of Fortran's too.
    ///
    /// # Errors
    /// It is no finite number.
    pub fn real(&self, what: &str, field: &str) -> Result<f64, Error> {
        let text = field.trim().replace(['d', 'D'], "e");
        let wanted = || self.error(&format!("{what} is \"{}\"; allowed: a finite number", field.trim()));
        text.parse().ok().filter(|value: &f64| value.is_finite()).ok_or_else(wanted)
    }
}

/// The lines of a text, numbered.
pub fn lines<'a>(file: &'a str, text: &'a str) -> impl Iterator<Item = Line<'a>> {
    text.lines().enumerate().map(move |(i, text)| Line { file, number: i + 1, text })
}

/// The text of a file that another one names at this line.
///
/// # Errors
/// It cannot be read.
pub fn included(line: &Line<'_>, name: &str) -> Result<(String, String), Error> {
    let place = Path::new(line.file).parent().unwrap_or(Path::new("")).join(name.trim());
    let text = std::fs::read(&place).map_err(|error| line.error(&format!("{}: {error}", place.display())))?;
    Ok((place.display().to_string(), String::from_utf8_lossy(&text).into_owned()))
}

/// Nodes and elements by the file's numbers, which may stand before or after what they name.
#[derive(Default)]
pub struct Numbered {
    nodes: HashMap<u64, u32>,
    places: Vec<[f64; 3]>,
    elements: Vec<Named>,
    /// Places in the list by the elements' numbers.
    pub element: HashMap<u64, usize>,
}

struct Named {
    number: u64,
    nodes: [u64; 8],
    file: String,
    line: usize,
}

impl Numbered {
    /// # Errors
    /// There is another node of this number.
    pub fn add_node(&mut self, line: &Line<'_>, number: u64, place: [f64; 3]) -> Result<(), Error> {
        if self.nodes.insert(number, self.places.len() as u32).is_some() {
            return Err(
                line.error(&format!("node {number} has a place already; allowed: each number once, without parts"))
            );
        }
        self.places.push(place);
        Ok(())
    }

    /// # Errors
    /// There is another element of this number.
    pub fn add_element(&mut self, line: &Line<'_>, number: u64, nodes: [u64; 8]) -> Result<(), Error> {
        if self.element.insert(number, self.elements.len()).is_some() {
            let message = format!("there is an element {number} already; allowed: each number once, without parts");
            return Err(line.error(&message));
        }
        self.elements.push(Named { number, nodes, file: line.file.to_string(), line: line.number });
        Ok(())
    }

    /// The mesh, with these yarns; `yarn` and `direction` are by the elements' places in the list.
    ///
    /// # Errors
    /// An element has a node that is nowhere, or is no yarn's.
    pub fn finish(
        self,
        yarns: Vec<String>,
        yarn: &[Option<usize>],
        direction: &HashMap<u64, [f64; 3]>,
        parts: &str,
    ) -> Result<Raw, Error> {
        let mut raw = Raw { nodes: self.places, elements: Vec::with_capacity(self.elements.len()), yarns };
        for (element, &yarn) in self.elements.iter().zip(yarn) {
            let line = Line { file: &element.file, number: element.line, text: "" };
            let number = element.number;
            let mut nodes = [0; 8];
            for (node, own) in nodes.iter_mut().zip(element.nodes) {
                *node = *self.nodes.get(&own).ok_or_else(|| {
                    line.error(&format!(
                        "element {number} has node {own}, which the file does not have; allowed: nodes with a place"
                    ))
                })?;
            }
            let yarn = yarn.ok_or_else(|| line.error(&format!("element {number} is of no yarn; allowed: {parts}")))?;
            raw.elements.push(Element { number, nodes, yarn, direction: direction.get(&number).copied() });
        }
        Ok(raw)
    }
}
