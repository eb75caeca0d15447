//! A meshed panel as ParaView reads it.

use std::fmt::Write;

use super::model::Model;
use crate::common::vtk::{CORNERS, HEXAHEDRON, array, vectors};

/// The text of a VTU file; each cell has the number of its yarn from 0, its family (0 warp, 1 weft) and its fibre direction.
pub fn unstructured_grid(model: &Model) -> String {
    let (points, cells) = (model.nodes.len(), model.elements.len());
    let mut text = String::from("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\">\n");
    let _ = write!(text, "<UnstructuredGrid><Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">\n<Points>\n");
    vectors(&mut text, "position", model.nodes.iter().copied());
    text.push_str("</Points>\n<Cells>\n");
    let corners = model.elements.iter().flat_map(|element| CORNERS.map(|corner| element[corner]));
    array(&mut text, "connectivity", "Int32", 1, corners);
    array(&mut text, "offsets", "Int32", 1, (1..=cells).map(|i| 8 * i));
    array(&mut text, "types", "UInt8", 1, (0..cells).map(|_| HEXAHEDRON));
    text.push_str("</Cells>\n<CellData>\n");
    let yarns = || model.yarns.iter().enumerate();
    array(&mut text, "yarn", "Int32", 1, yarns().flat_map(|(i, yarn)| yarn.elements.clone().map(move |_| i)));
    let families = yarns().flat_map(|(_, yarn)| yarn.elements.clone().map(|_| yarn.family as u8));
    array(&mut text, "family", "UInt8", 1, families);
    vectors(&mut text, "fibre", model.fibre.iter().copied());
    text.push_str("</CellData>\n</Piece></UnstructuredGrid>\n</VTKFile>\n");
    text
}
