//! A meshed panel as ParaView reads it.

use super::model::Model;
use toron_explicit_host::vtk::{self, array, doubles};

/// The text of a VTU file, in double precision so that a scene reads the same mesh from it; each cell has the number of
/// its yarn from 0, its family (0 warp, 1 weft) and its fibre direction.
pub fn unstructured_grid(model: &Model) -> String {
    let mut cell_data = String::new();
    let yarns = || model.yarns.iter().enumerate();
    array(&mut cell_data, "yarn", "Int32", 1, yarns().flat_map(|(i, yarn)| yarn.elements.clone().map(move |_| i)));
    let families = yarns().flat_map(|(_, yarn)| yarn.elements.clone().map(|_| yarn.family as u8));
    array(&mut cell_data, "family", "UInt8", 1, families);
    doubles(&mut cell_data, "fibre", model.fibre.iter().copied());
    vtk::unstructured_grid_of_doubles(model.nodes.iter().copied(), model.elements.iter().copied(), "", &cell_data)
}
