//! A yarn as structured hexahedra: the section by columns and rows, the length by layers.
//!
//! Axis 0 runs along the yarn from the plane of symmetry at mid-span, axis 1 points at the striker, axis 2 across.

use std::f64::consts::PI;

/// The outline of the section.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Section {
    /// Columns between points of equal angle on the ellipse; the rows of the outermost ones meet at its tips.
    Ellipse,
    Rectangle,
}

/// Dimensions of a yarn and the number of its elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Yarn {
    pub section: Section,
    /// Half of the span.
    pub length: f64,
    /// Full size along axis 1, and across.
    pub height: f64,
    pub width: f64,
    pub layers: usize,
    pub rows: usize,
    pub columns: usize,
}

/// Nodes in the reference placement and what they are joined by.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    pub nodes: Vec<[f64; 3]>,
    /// Corner c of an element stands on the upper side of axis i where bit i of c is set. Layer by layer.
    pub elements: Vec<[u32; 8]>,
    /// The fibre's unit direction in every element; empty where it is axis 0 in all.
    pub fibre: Vec<[f64; 3]>,
    pub elements_per_layer: usize,
    pub nodes_per_section: usize,
    /// Surface that belongs to each node, the two ends of the yarn left out. Inner nodes have a share of the lines that
    /// they stand on, for when what stands above them is gone.
    pub surface: Vec<f64>,
}

impl Yarn {
    /// Area of the section.
    pub fn area(&self) -> f64 {
        match self.section {
            Section::Ellipse => PI / 4.0 * self.height * self.width,
            Section::Rectangle => self.height * self.width,
        }
    }

    /// The number of layers that comes nearest to a length.
    pub fn layers_to(&self, length: f64) -> usize {
        (length / self.length * self.layers as f64).round() as usize
    }

    pub fn mesh(&self) -> Mesh {
        let section = self.section_points();
        let per_section = section.points.len();
        let nodes = (0..=self.layers).flat_map(|layer| {
            let x = self.length * layer as f64 / self.layers as f64;
            section.points.iter().map(move |&[y, z]| [x, y, z])
        });
        let mut mesh = Mesh {
            nodes: nodes.collect(),
            elements: Vec::new(),
            fibre: Vec::new(),
            elements_per_layer: self.rows * self.columns,
            nodes_per_section: per_section,
            surface: vec![0.0; per_section * (self.layers + 1)],
        };
        for layer in 0..self.layers {
            let base = layer * per_section;
            for column in 0..self.columns {
                for row in 0..self.rows {
                    mesh.elements.push(std::array::from_fn(|corner| {
                        let [along, up, across] = [0, 1, 2].map(|axis| corner >> axis & 1);
                        (base + along * per_section + section.number(column + across, row + up)) as u32
                    }));
                }
                for row in 0..=self.rows {
                    let ends = [column, column + 1].map(|c| section.number(c, row));
                    // The tips belong to the outline alone.
                    let outline = row == 0 || row == self.rows;
                    let shares = ends.iter().zip([column, column + 1]).filter(|(_, c)| outline || !self.is_tip(*c));
                    let shares: Vec<usize> = shares.map(|(&end, _)| end).collect();
                    mesh.add_strip(base, ends, &shares);
                }
            }
            if self.section == Section::Rectangle {
                for row in 0..self.rows {
                    for column in [0, self.columns] {
                        let ends = [row, row + 1].map(|r| section.number(column, r));
                        mesh.add_strip(base, ends, &ends);
                    }
                }
            }
        }
        mesh
    }

    /// Whether the rows of this column of points meet in one.
    fn is_tip(&self, column: usize) -> bool {
        self.section == Section::Ellipse && (column == 0 || column == self.columns)
    }

    fn section_points(&self) -> Points {
        let mut points = Points { points: Vec::new(), numbers: Vec::new(), rows: self.rows };
        // Straight sides cut off some of the ellipse: the polygon is enlarged to its area.
        let corners = 2.0 * self.columns as f64;
        let scale = (PI / (corners / 2.0 * (2.0 * PI / corners).sin())).sqrt();
        for column in 0..=self.columns {
            let share = column as f64 / self.columns as f64;
            let (z, top) = match self.section {
                Section::Rectangle => (share - 0.5, 0.5),
                Section::Ellipse => (-0.5 * scale * (PI * share).cos(), 0.5 * scale * (PI * share).sin()),
            };
            let tip = self.is_tip(column);
            for row in 0..=self.rows {
                if row == 0 || !tip {
                    let level = if tip { 0.0 } else { 2.0 * row as f64 / self.rows as f64 - 1.0 };
                    points.points.push([self.height * top * level, self.width * z]);
                }
                points.numbers.push(points.points.len() - 1);
            }
        }
        points
    }
}

/// The points of a section and how they are numbered.
struct Points {
    points: Vec<[f64; 2]>,
    numbers: Vec<usize>,
    rows: usize,
}

impl Points {
    fn number(&self, column: usize, row: usize) -> usize {
        self.numbers[column * (self.rows + 1) + row]
    }
}

impl Mesh {
    /// Gives those of a face's nodes their quarters of it; it lies between two points of the section and is one layer
    /// long.
    fn add_strip(&mut self, base: usize, ends: [usize; 2], shares: &[usize]) {
        let [a, b] = ends.map(|end| self.nodes[base + end]);
        let length = self.nodes[base + self.nodes_per_section][0] - a[0];
        let area = length * (b[1] - a[1]).hypot(b[2] - a[2]);
        for share in shares {
            self.surface[base + share] += area / 4.0;
            self.surface[base + self.nodes_per_section + share] += area / 4.0;
        }
    }

    /// The layer of an element.
    pub fn layer(&self, element: usize) -> usize {
        element / self.elements_per_layer
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_section_has_the_area_of_the_ellipse() {
        let yarn = Yarn {
            section: Section::Ellipse,
            length: 1.0,
            height: 0.115,
            width: 0.5337,
            layers: 1,
            rows: 2,
            columns: 6,
        };
        let mesh = yarn.mesh();
        // The upper half of the outline from tip to tip.
        let mut outline: Vec<[f64; 3]> =
            mesh.nodes[..mesh.nodes_per_section].iter().copied().filter(|node| node[1] > 0.0 || is_tip(node)).collect();
        outline.sort_by(|a, b| a[2].total_cmp(&b[2]));
        let half: f64 = outline.windows(2).map(|w| 0.5 * (w[0][1] + w[1][1]) * (w[1][2] - w[0][2])).sum();
        assert!((2.0 * half / yarn.area() - 1.0).abs() < 1e-12);
    }

    /// The middle line ends at the tips, half the width and more from the centre.
    fn is_tip(node: &[f64; 3]) -> bool {
        node[2].abs() > 0.5337 / 2.0
    }

    #[test]
    fn the_surface_is_the_outline_and_the_lines_inside_times_the_length() {
        let yarn =
            Yarn { section: Section::Rectangle, length: 3.0, height: 1.0, width: 2.0, layers: 4, rows: 2, columns: 3 };
        // Around it 6, and 2 between the rows.
        assert!((yarn.mesh().surface.iter().sum::<f64>() - 3.0 * 8.0).abs() < 1e-12);
    }
}
