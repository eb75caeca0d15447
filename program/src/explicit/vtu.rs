//! Pictures of a body in time as ParaView reads them: a VTU file each, and a PVD file that names their times.

use std::fmt::Write;

use super::body::Body;
use super::lanes::Number;
use super::medium::{ENERGY_NAMES, Medium};

/// The corners in the order of a VTK hexahedron.
const VTK_ORDER: [usize; 8] = [0, 1, 3, 2, 4, 5, 7, 6];
const VTK_HEXAHEDRON: u8 = 12;

/// The body as it stands, as the text of a VTU file: intact elements only, with displacement and velocity of the nodes
/// and the energy densities of the elements.
pub fn unstructured_grid<T: Number>(body: &Body<T>, media: &[Medium<T>]) -> String {
    let intact: Vec<usize> = (0..body.mesh.elements.len()).filter(|&i| body.is_intact(i)).collect();
    let mut text = String::from("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\">\n");
    let (points, cells) = (body.mesh.nodes.len(), intact.len());
    let _ = write!(text, "<UnstructuredGrid><Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">\n<Points>\n");
    vectors(&mut text, "position", (0..points).map(|node| body.position(node)));
    text.push_str("</Points>\n<PointData>\n");
    vectors(&mut text, "displacement", body.displacement.iter().map(|u| u.map(Into::into)));
    vectors(&mut text, "velocity", body.velocity.iter().map(|v| v.map(Into::into)));
    text.push_str("</PointData>\n<Cells>\n");
    let corners = intact.iter().flat_map(|&i| VTK_ORDER.map(|corner| body.mesh.elements[i][corner]));
    array(&mut text, "connectivity", "Int32", 1, corners);
    array(&mut text, "offsets", "Int32", 1, (1..=cells).map(|i| 8 * i));
    array(&mut text, "types", "UInt8", 1, (0..cells).map(|_| VTK_HEXAHEDRON));
    text.push_str("</Cells>\n<CellData>\n");
    let densities: Vec<[f64; 5]> = intact.iter().map(|&i| body.energy_densities(media, i)).collect();
    for (mode, name) in ENERGY_NAMES.into_iter().enumerate() {
        array(&mut text, name, "Float32", 1, densities.iter().map(|energies| energies[mode] as f32));
    }
    text.push_str("</CellData>\n</Piece></UnstructuredGrid>\n</VTKFile>\n");
    text
}

fn vectors(text: &mut String, name: &str, values: impl Iterator<Item = [f64; 3]>) {
    array(text, name, "Float32", 3, values.flatten().map(|value| value as f32));
}

fn array<V: std::fmt::Display>(
    text: &mut String,
    name: &str,
    kind: &str,
    components: usize,
    values: impl Iterator<Item = V>,
) {
    let _ = writeln!(
        text,
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"ascii\">"
    );
    for (i, value) in values.enumerate() {
        let separator = if (i + 1) % 24 == 0 { '\n' } else { ' ' };
        let _ = write!(text, "{value}{separator}");
    }
    text.push_str("\n</DataArray>\n");
}

/// The text of the PVD file: times and names of the VTU files.
pub fn collection(files: &[(f64, String)]) -> String {
    let mut text =
        String::from("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n");
    for (time, file) in files {
        let _ = writeln!(text, "<DataSet timestep=\"{time}\" file=\"{file}\"/>");
    }
    text.push_str("</Collection>\n</VTKFile>\n");
    text
}
