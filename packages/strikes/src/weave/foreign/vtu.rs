//! VTU files with hexahedra and wedges, the number of their yarn and the direction of their fibres: those of `toron
//! weave`, meshio and ParaView.

use nalgebra::Vector3;
use roxmltree::{Document, Node};

use super::raw::{Element, Raw, of_wedge};
use super::vtu_data::{Appended, Encoding};
use toron_shared::error::Error;
use toron_shared::keyword_file::files::text;
use toron_shared::keyword_file::line::{Line, Place};

const HEXAHEDRON: u64 = 12;
const WEDGE: u64 = 13;

/// # Errors
/// What in the file is wrong, by line.
pub fn read(file: &str, bytes: &[u8]) -> Result<Raw, Error> {
    let wrong = |message: String| Error::Input(format!("{file}: {message}"));
    let (xml, appended) = Appended::split(bytes);
    let xml = text(&xml);
    let document = Document::parse(&xml).map_err(|error| wrong(error.to_string()))?;
    if let Some(piece) = document.descendants().filter(|node| node.has_tag_name("Piece")).nth(1) {
        let row = document.text_pos_at(piece.range().start).row;
        return Err(Error::Input(format!("{file}:{row}: a second Piece; allowed: one")));
    }
    let encoding = Encoding::of(document.root_element()).map_err(wrong)?;
    let reader = Reader { file, document: &document, encoding, appended };
    let [points, connectivity, offsets, types] = [
        reader.array("Points", None)?,
        reader.array("Cells", Some("connectivity"))?,
        reader.array("Cells", Some("offsets"))?,
        reader.array("Cells", Some("types"))?,
    ];
    let places: Vec<f64> = reader.reals(&points)?;
    let [connectivity, offsets, types] =
        [reader.integers(&connectivity)?, reader.integers(&offsets)?, reader.integers(&types)?];
    let yarn = reader.integers(&reader.array("CellData", Some("yarn"))?)?;
    let fibre: Vec<f64> = reader.fibre()?.map_or(Ok(Vec::new()), |fibre| reader.reals(&fibre))?;
    let count = offsets.len();
    for (name, found, wanted) in [
        ("Points", places.len(), places.len() / 3 * 3),
        ("types", types.len(), count),
        ("yarn", yarn.len(), count),
        ("fibre", fibre.len(), if fibre.is_empty() { 0 } else { 3 * count }),
    ] {
        if found != wanted {
            return Err(wrong(format!("{name} has {found} numbers; allowed: {wanted}, for {count} cells")));
        }
    }
    let mut numbers = yarn.clone();
    numbers.sort_unstable();
    numbers.dedup();
    let nodes = places.chunks_exact(3).map(|place| [place[0], place[1], place[2]]).collect();
    let yarns = numbers.iter().map(|number| format!("yarn {number}")).collect();
    let mut raw = Raw { nodes, elements: Vec::with_capacity(count), yarns };
    for cell in 0..count {
        let start = if cell == 0 { 0 } else { offsets[cell - 1] } as usize;
        let own = connectivity.get(start..offsets[cell] as usize).unwrap_or_default();
        let wrong = |message: &str| Err(wrong(format!("cell {cell} {message}")));
        if let Some(node) = own.iter().find(|&&node| node as usize >= raw.nodes.len()) {
            let points = raw.nodes.len();
            return wrong(&format!("has node {node}, which the file does not have; allowed: less than {points}"));
        }
        let own: Vec<u32> = own.iter().map(|&node| node as u32).collect();
        let nodes = match (types[cell], &own[..]) {
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
    let [a, b, c, d] = corners.map(|node| Vector3::from(nodes[node as usize]));
    (b - a).cross(&(c - a)).dot(&(d - a)) >= 0.0
}

struct Reader<'a> {
    file: &'a str,
    document: &'a Document<'a>,
    encoding: Encoding,
    appended: Option<Appended<'a>>,
}

impl<'a> Reader<'a> {
    /// The arrays of a part of the file.
    fn arrays(&self, part: &str) -> impl Iterator<Item = Node<'a, 'a>> {
        let parts = self.document.descendants().filter(move |node| node.has_tag_name(part));
        parts.flat_map(|node| node.children().filter(|child| child.has_tag_name("DataArray")))
    }

    /// The array of this name in a part of the file, or the only one.
    fn array(&self, part: &str, name: Option<&str>) -> Result<Node<'a, 'a>, Error> {
        let mut arrays = self.arrays(part).filter(|array| name.is_none() || array.attribute("Name") == name);
        let name = name.unwrap_or("positions");
        let found = arrays.next().ok_or_else(|| {
            let message =
                format!("{part} has no array {name}; allowed: Points, Cells, and CellData with yarn and fibre");
            Error::Input(format!("{}: {message}", self.file))
        })?;
        let second =
            arrays.next().map(|second| self.place(&second).error(&format!("a second array {name}; allowed: one")));
        second.map_or(Ok(found), Err)
    }

    /// The directions of the cells' fibres, where the file has them. Others may call them otherwise: passed over, they
    /// would be those of the elements.
    ///
    /// # Errors
    /// It may have them under another name, or of the points.
    fn fibre(&self) -> Result<Option<Node<'a, 'a>>, Error> {
        let name = |array: &Node<'a, 'a>| array.attribute("Name").unwrap_or_default().to_string();
        if self.arrays("CellData").any(|array| name(&array) == "fibre") {
            return self.array("CellData", Some("fibre")).map(Some);
        }
        let is_direction = |array: &Node<'a, 'a>| array.attribute("NumberOfComponents") == Some("3");
        let of_cells = self.arrays("CellData").find(is_direction).map(|array| ("CellData", array));
        let is_fibre = |array: &Node<'a, 'a>| name(array).eq_ignore_ascii_case("fibre");
        let of_points = || self.arrays("PointData").find(is_fibre).map(|array| ("PointData", array));
        of_cells.or_else(of_points).map_or(Ok(None), |(part, array)| {
            Err(self.place(&array).error(&format!(
                "{part} has the array {} of three components, but none called fibre; allowed: the fibres' directions by cells, called \
                 fibre, or none",
                name(&array)
            )))
        })
    }

    fn reals(&self, array: &Node<'a, 'a>) -> Result<Vec<f64>, Error> {
        match self.bytes(array)? {
            Some((bytes, place)) => {
                let kind = array.attribute("type").unwrap_or_default();
                self.encoding.reals(kind, &bytes).map_err(|message| place.error(&self.of_array(array, &message)))
            }
            None => self.written(array),
        }
    }

    fn integers(&self, array: &Node<'a, 'a>) -> Result<Vec<u64>, Error> {
        match self.bytes(array)? {
            Some((bytes, place)) => {
                let kind = array.attribute("type").unwrap_or_default();
                self.encoding.integers(kind, &bytes).map_err(|message| place.error(&self.of_array(array, &message)))
            }
            None => self.written(array),
        }
    }

    fn of_array(&self, array: &Node<'a, 'a>, message: &str) -> String {
        format!("array {} {message}", array.attribute("Name").unwrap_or("of numbers"))
    }

    fn place(&self, array: &Node<'a, 'a>) -> Place {
        Place { file: self.file.into(), line: self.document.text_pos_at(array.range().start).row as usize }
    }

    /// The numbers of an array as they are in memory, and where it is; none of one that is text.
    fn bytes(&self, array: &Node<'a, 'a>) -> Result<Option<(Vec<u8>, Place)>, Error> {
        let place = self.place(array);
        let bytes = match array.attribute("format").unwrap_or("ascii") {
            "ascii" => return Ok(None),
            "binary" => self.encoding.from_text(&contents(array)),
            "appended" => {
                let offset = array.attribute("offset").and_then(|offset| offset.parse::<usize>().ok());
                let next = |array: Node<'a, 'a>| array.attribute("offset")?.parse::<usize>().ok();
                let end = self.document.descendants().filter_map(next).filter(|&next| Some(next) > offset).min();
                match (offset, &self.appended) {
                    (Some(offset), Some(appended)) => self.encoding.appended(appended, offset, end),
                    _ => Err("has no data; allowed: an offset, and AppendedData".to_string()),
                }
            }
            other => Err(format!("has the format {other}; allowed: ascii, binary, appended")),
        };
        let bytes = bytes.map_err(|message| place.error(&self.of_array(array, &message)))?;
        Ok(Some((bytes, place)))
    }

    /// The numbers of an array that is text.
    fn written<T: std::str::FromStr>(&self, array: &Node<'a, 'a>) -> Result<Vec<T>, Error> {
        let (place, text) = (self.place(array), contents(array));
        let line = Line { file: &place.file, number: place.line, text: "" };
        let name = self.of_array(array, "").trim_end().to_string();
        text.split_whitespace().map(|field| line.number(&format!("an entry of {name}"), field)).collect()
    }
}

/// The text of an array, which may have notes among it.
fn contents(array: &Node<'_, '_>) -> String {
    array.children().filter(Node::is_text).filter_map(|child| child.text()).collect()
}
