//! VTU files as `toron weave` writes them: hexahedra and wedges with the number of their yarn and the direction of their fibres, as text.

use nalgebra::Vector3;
use roxmltree::{Document, Node};

use super::raw::{Element, Line, Raw, of_wedge};
use crate::common::error::Error;

const HEXAHEDRON: u8 = 12;
const WEDGE: u8 = 13;

/// # Errors
/// What in the file is wrong, by line.
pub fn read(file: &str, text: &str) -> Result<Raw, Error> {
    let document = Document::parse(text).map_err(|error| Error::Input(format!("{file}: {error}")))?;
    if let Some(piece) = document.descendants().filter(|node| node.has_tag_name("Piece")).nth(1) {
        let row = document.text_pos_at(piece.range().start).row;
        return Err(Error::Input(format!("{file}:{row}: a second Piece; allowed: one")));
    }
    let reader = Reader { file, document: &document };
    let [points, connectivity, offsets, types] = [
        reader.array("Points", None)?,
        reader.array("Cells", Some("connectivity"))?,
        reader.array("Cells", Some("offsets"))?,
        reader.array("Cells", Some("types"))?,
    ];
    let places: Vec<f64> = reader.numbers(&points)?;
    let (connectivity, offsets): (Vec<u32>, Vec<usize>) = (reader.numbers(&connectivity)?, reader.numbers(&offsets)?);
    let types: Vec<u8> = reader.numbers(&types)?;
    let of_yarn = reader.array("CellData", Some("yarn"))?;
    let yarn: Vec<u64> = reader.numbers(&of_yarn)?;
    let fibre = reader.array("CellData", Some("fibre")).ok();
    let fibre: Vec<f64> = fibre.map_or(Ok(Vec::new()), |fibre| reader.numbers(&fibre))?;
    let count = offsets.len();
    for (name, found, wanted) in [
        ("types", types.len(), count),
        ("yarn", yarn.len(), count),
        ("fibre", fibre.len(), if fibre.is_empty() { 0 } else { 3 * count }),
    ] {
        if found != wanted {
            return Err(Error::Input(format!(
                "{file}: {name} has {found} numbers; allowed: {wanted}, for {count} cells"
            )));
        }
    }
    let mut numbers = yarn.clone();
    numbers.sort_unstable();
    numbers.dedup();
    let nodes = places.chunks_exact(3).map(|place| [place[0], place[1], place[2]]).collect();
    let yarns = numbers.iter().map(|number| format!("yarn {number}")).collect();
    let mut raw = Raw { nodes, elements: Vec::with_capacity(count), yarns };
    for cell in 0..count {
        let start = if cell == 0 { 0 } else { offsets[cell - 1] };
        let own = connectivity.get(start..offsets[cell]).unwrap_or_default();
        let wrong = |message: &str| Err(Error::Input(format!("{file}: cell {cell} {message}")));
        let nodes = match (types[cell], own) {
            (HEXAHEDRON, &[a, b, c, d, e, f, g, h]) => [a, b, c, d, e, f, g, h],
            // Files differ in the sense in which they go around a wedge's triangles.
            (WEDGE, &[a, b, c, d, e, f]) if goes_around(&raw.nodes, [a, b, c, d]) => of_wedge([a, b, c, d, e, f]),
            (WEDGE, &[a, b, c, d, e, f]) => of_wedge([a, c, b, d, f, e]),
            (kind, _) => {
                let nodes = own.len();
                return wrong(&format!(
                    "is of type {kind} with {nodes} nodes; allowed: 12, a hexahedron, and 13, a wedge"
                ));
            }
        };
        if let Some(node) = nodes.iter().find(|&&node| node as usize >= raw.nodes.len()) {
            let points = raw.nodes.len();
            return wrong(&format!("has node {node}, which the file does not have; allowed: less than {points}"));
        }
        raw.elements.push(Element {
            number: cell as u64,
            nodes,
            yarn: numbers.binary_search(&yarn[cell]).unwrap_or_default(),
            direction: fibre.get(3 * cell..3 * cell + 3).map(|axis| [axis[0], axis[1], axis[2]]),
        });
    }
    Ok(raw)
}

/// Whether the first triangle goes around the way to the fourth node as solvers have it.
fn goes_around(nodes: &[[f64; 3]], corners: [u32; 4]) -> bool {
    let place = |node: u32| nodes.get(node as usize).map_or_else(Vector3::zeros, |&place| Vector3::from(place));
    let [a, b, c, d] = corners.map(place);
    (b - a).cross(&(c - a)).dot(&(d - a)) >= 0.0
}

struct Reader<'a> {
    file: &'a str,
    document: &'a Document<'a>,
}

impl<'a> Reader<'a> {
    /// The array of this name in a part of the file, or the only one.
    fn array(&self, part: &str, name: Option<&str>) -> Result<Node<'a, 'a>, Error> {
        let parts = self.document.descendants().filter(|node| node.has_tag_name(part));
        let arrays = parts.flat_map(|node| node.children().filter(|child| child.has_tag_name("DataArray")));
        let mut arrays = arrays.filter(|array| name.is_none() || array.attribute("Name") == name);
        arrays.next().ok_or_else(|| {
            let name = name.unwrap_or("positions");
            let message =
                format!("{part} has no array {name}; allowed: Points, Cells, and CellData with yarn and fibre");
            Error::Input(format!("{}: {message}", self.file))
        })
    }

    fn numbers<T: std::str::FromStr>(&self, array: &Node<'a, 'a>) -> Result<Vec<T>, Error> {
        let number = self.document.text_pos_at(array.range().start).row as usize;
        let line = Line { file: self.file, number, text: "" };
        let format = array.attribute("format").unwrap_or("ascii");
        if format != "ascii" {
            let name = array.attribute("Name").unwrap_or_default();
            return Err(line.error(&format!("array {name} has the format {format}; allowed: ascii")));
        }
        let name = array.attribute("Name").unwrap_or("of numbers");
        let fields = array.text().unwrap_or_default().split_whitespace();
        fields.map(|field| line.number(&format!("an entry of array {name}"), field)).collect()
    }
}
