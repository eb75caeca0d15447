//! Files for ParaView: hexahedra with data (VTU), and series of them in time (PVD).

use std::fmt::{Display, Write};
use std::path::PathBuf;

use toron_shared::error::Error;

/// The corners of an element in the order of a VTK hexahedron; corner c stands on the upper side of axis i where bit i
/// of c is set.
const CORNERS: [usize; 8] = [0, 1, 3, 2, 4, 5, 7, 6];
const HEXAHEDRON: u8 = 12;

/// The text of a VTU file of these cells; the data are arrays, as [`array()`] and [`vectors`] write them.
pub fn unstructured_grid(
    points: impl ExactSizeIterator<Item = [f64; 3]>,
    cells: impl ExactSizeIterator<Item = [u32; 8]>,
    point_data: &str,
    cell_data: &str,
) -> String {
    let (nodes, mut places) = (points.len(), String::new());
    vectors(&mut places, "position", points);
    grid(nodes, &places, cells, point_data, cell_data)
}

/// The same with the points in double precision.
pub fn unstructured_grid_of_doubles(
    points: impl ExactSizeIterator<Item = [f64; 3]>,
    cells: impl ExactSizeIterator<Item = [u32; 8]>,
    point_data: &str,
    cell_data: &str,
) -> String {
    let (nodes, mut places) = (points.len(), String::new());
    doubles(&mut places, "position", points);
    grid(nodes, &places, cells, point_data, cell_data)
}

fn grid(
    nodes: usize,
    places: &str,
    cells: impl ExactSizeIterator<Item = [u32; 8]>,
    point_data: &str,
    cell_data: &str,
) -> String {
    let mut text = String::from("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\">\n");
    let count = cells.len();
    let _ = write!(text, "<UnstructuredGrid><Piece NumberOfPoints=\"{nodes}\" NumberOfCells=\"{count}\">\n<Points>\n");
    let _ = write!(text, "{places}</Points>\n<PointData>\n{point_data}</PointData>\n<Cells>\n");
    let corners = cells.flat_map(|cell| CORNERS.map(|corner| cell[corner]));
    array(&mut text, "connectivity", "Int32", 1, corners);
    array(&mut text, "offsets", "Int32", 1, (1..=count).map(|i| 8 * i));
    array(&mut text, "types", "UInt8", 1, (0..count).map(|_| HEXAHEDRON));
    let _ = write!(text, "</Cells>\n<CellData>\n{cell_data}</CellData>\n</Piece></UnstructuredGrid>\n</VTKFile>\n");
    text
}

/// Vectors in double precision, with the digits that it takes to read the same ones.
pub fn doubles(text: &mut String, name: &str, values: impl Iterator<Item = [f64; 3]>) {
    array(text, name, "Float64", 3, values.flatten());
}

/// Vectors in single precision.
pub fn vectors(text: &mut String, name: &str, values: impl Iterator<Item = [f64; 3]>) {
    array(text, name, "Float32", 3, values.flatten().map(|value| value as f32));
}

/// An array of so many components a point or cell.
pub fn array<V: Display>(
    text: &mut String,
    name: &str,
    kind: &str,
    components: usize,
    values: impl Iterator<Item = V>,
) {
    let attributes = format!("NumberOfComponents=\"{components}\"");
    write_array(text, name, kind, &attributes, values);
}

/// Values in single precision whose components have names.
pub fn components<const N: usize>(
    text: &mut String,
    name: &str,
    names: [&str; N],
    values: impl Iterator<Item = [f64; N]>,
) {
    let mut attributes = format!("NumberOfComponents=\"{N}\"");
    for (i, name) in names.iter().enumerate() {
        let _ = write!(attributes, " ComponentName{i}=\"{name}\"");
    }
    write_array(text, name, "Float32", &attributes, values.flatten().map(|value| value as f32));
}

fn write_array<V: Display>(
    text: &mut String,
    name: &str,
    kind: &str,
    attributes: &str,
    values: impl Iterator<Item = V>,
) {
    let _ = writeln!(text, "<DataArray type=\"{kind}\" Name=\"{name}\" {attributes} format=\"ascii\">");
    for (i, value) in values.enumerate() {
        let separator = if (i + 1) % 24 == 0 { '\n' } else { ' ' };
        let _ = write!(text, "{value}{separator}");
    }
    text.push_str("\n</DataArray>\n");
}

/// A series in time, written as it comes: NAME-0000.vtu and so on, and NAME.pvd, which names their times.
pub struct Frames {
    directory: PathBuf,
    name: String,
    files: Vec<(f64, String)>,
}

impl Frames {
    pub fn new(directory: impl Into<PathBuf>, name: &str) -> Self {
        Frames { directory: directory.into(), name: name.to_string(), files: Vec::new() }
    }

    /// Goes on behind the files of these times, which another run has written; later ones are no longer named.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn resume(&mut self, times: &[f64]) -> Result<(), Error> {
        self.files = times.iter().enumerate().map(|(number, &time)| (time, self.name_of(number))).collect();
        if times.is_empty() { Ok(()) } else { self.write_file(&format!("{}.pvd", self.name), &self.collection()) }
    }

    fn name_of(&self, number: usize) -> String {
        format!("{}-{number:04}.vtu", self.name)
    }

    /// Writes the text of the next VTU file, and the PVD file anew.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write(&mut self, time: f64, text: &str) -> Result<(), Error> {
        let name = self.name_of(self.files.len());
        self.write_file(&name, text)?;
        self.files.push((time, name));
        self.write_file(&format!("{}.pvd", self.name), &self.collection())
    }

    fn write_file(&self, name: &str, text: &str) -> Result<(), Error> {
        let file = self.directory.join(name);
        std::fs::write(&file, text).map_err(|error| Error::Input(format!("{}: {error}", file.display())))
    }

    fn collection(&self) -> String {
        let mut text =
            String::from("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n");
        for (time, file) in &self.files {
            let _ = writeln!(text, "<DataSet timestep=\"{time}\" file=\"{file}\"/>");
        }
        text.push_str("</Collection>\n</VTKFile>\n");
        text
    }
}
