//! What a mesh file says, whatever its format.

use std::collections::HashMap;

use toron_shared::error::Error;
use toron_shared::keyword_file::line::{Line, Place};

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
    /// Nodes 1 to 4 around a face, 5 to 8 around the one across from it, as solvers number a hexahedron. Of a wedge
    /// some nodes are the same.
    pub nodes: [u32; 8],
    pub yarn: usize,
    /// Of the fibre, where the file says it: of any length.
    pub direction: Option<[f64; 3]>,
}

/// A hexahedron of a wedge's nodes, around a triangle and then around the other.
pub fn of_wedge<T: Copy>([a, b, c, d, e, f]: [T; 6]) -> [T; 8] {
    [a, b, c, c, d, e, f, f]
}

/// Nodes and elements by the file's numbers, which may stand before or after what they name.
#[derive(Clone, Default)]
pub struct Numbered {
    nodes: HashMap<u64, u32>,
    pub places: Vec<[f64; 3]>,
    elements: Vec<Named>,
    /// Places in the list by the elements' numbers.
    pub element: HashMap<u64, usize>,
}

#[derive(Clone)]
struct Named {
    number: u64,
    nodes: [u64; 8],
    place: Place,
}

impl Numbered {
    /// # Errors
    /// There is another node of this number.
    pub fn add_node(&mut self, line: &Line<'_>, number: u64, place: [f64; 3]) -> Result<(), Error> {
        if self.nodes.insert(number, self.places.len() as u32).is_some() {
            return Err(line.error(&format!("node {number} has a place already; allowed: each number once in a part")));
        }
        self.places.push(place);
        Ok(())
    }

    /// # Errors
    /// There is another element of this number.
    pub fn add_element(&mut self, place: Place, number: u64, nodes: [u64; 8]) -> Result<(), Error> {
        if self.element.insert(number, self.elements.len()).is_some() {
            let message = format!("there is an element {number} already; allowed: each number once in a part");
            return Err(place.error(&message));
        }
        self.elements.push(Named { number, nodes, place });
        Ok(())
    }

    /// Adds the mesh to another one, with these yarns; `yarn` and `direction` are by the elements' places in the list.
    ///
    /// # Errors
    /// An element has a node that is nowhere, or is no yarn's.
    pub fn add_to(
        self,
        raw: &mut Raw,
        yarns: Vec<String>,
        yarn: &[Option<usize>],
        direction: &[Option<[f64; 3]>],
        parts: &str,
    ) -> Result<(), Error> {
        let (first_node, first_yarn) = (raw.nodes.len() as u32, raw.yarns.len());
        raw.nodes.extend(self.places);
        raw.yarns.extend(yarns);
        for ((element, &yarn), &direction) in self.elements.iter().zip(yarn).zip(direction) {
            let Named { number, place, .. } = element;
            let mut nodes = [0; 8];
            for (node, own) in nodes.iter_mut().zip(element.nodes) {
                let found = self.nodes.get(&own).ok_or_else(|| {
                    place.error(&format!(
                        "element {number} has node {own}, which the file does not have; allowed: nodes with a place"
                    ))
                })?;
                *node = first_node + found;
            }
            let yarn = yarn.ok_or_else(|| place.error(&format!("element {number} is of no yarn; allowed: {parts}")))?;
            raw.elements.push(Element { number: *number, nodes, yarn: first_yarn + yarn, direction });
        }
        Ok(())
    }
}
