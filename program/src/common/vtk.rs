//! Arrays of a VTU file, as ParaView reads them.

use std::fmt::{Display, Write};

/// The corners of an element in the order of a VTK hexahedron; corner c stands on the upper side of axis i where bit i of c
/// is set.
pub const CORNERS: [usize; 8] = [0, 1, 3, 2, 4, 5, 7, 6];
pub const HEXAHEDRON: u8 = 12;

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
