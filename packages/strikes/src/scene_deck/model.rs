//! What a deck is made of, whatever the host: mesh, parts, materials, supports, striker, contact and output, all in the
//! deck's units.

use toron::host::units::UnitSystem;
use toron::law::parameters::{Dimension, STRESS};

use super::origin::Origin;
use super::striker::Striker;
use toron_explicit_host::medium::{Control, Medium};
use toron_materials::deck::material::Material;
use toron_shared::error::Error;

/// One case of a scene.
pub struct Model {
    /// The scene's title, and the command and file that it came from.
    pub title: String,
    pub source: String,
    /// Of the files and, in the solvers, of the run.
    pub name: String,
    pub units: UnitSystem,
    pub mesh: Mesh,
    pub parts: Vec<Part>,
    pub materials: Vec<Material>,
    /// Nodes that are held.
    pub supports: Vec<Support>,
    /// What happens to it; nothing to a panel that enters somebody's own model.
    pub strike: Option<Strike>,
}

/// Hexahedra and wedges.
#[derive(Default)]
pub struct Mesh {
    pub nodes: Vec<[f64; 3]>,
    /// Nodes 1 to 4 are a section of the yarn and 5 to 8 the next one, both in the order in which the first looks at
    /// the second. Of a wedge the nodes of one edge across are the same: 1 and 2 and so 5 and 6, or 3 and 4 and so 7
    /// and 8.
    pub elements: Vec<[u32; 8]>,
    /// The fibre's unit direction in every element.
    pub fibre: Vec<[f64; 3]>,
    /// Whether that is the x axis in all of them.
    pub straight: bool,
    /// Quadrangles, and triangles whose last two nodes are the same, that can touch something; counterclockwise seen
    /// from outside.
    pub faces: Vec<[u32; 4]>,
}

/// Elements of one yarn and one material.
pub struct Part {
    pub name: String,
    pub material: usize,
    pub elements: Vec<u32>,
}

/// Nodes that do not move along some of the axes.
pub struct Support {
    pub name: &'static str,
    /// What in the scene says so.
    pub key: &'static str,
    pub nodes: Vec<u32>,
    pub fixed: [bool; 3],
}

/// What strikes, and how it is calculated.
pub struct Strike {
    pub striker: Striker,
    /// What part of the whole the model is: 0.25 is a quarter.
    pub part: f64,
    /// Of a yarn.
    pub height: f64,
    /// Of yarns with one another, where there are several.
    pub contact: Option<Contact>,
    pub control: Control,
    pub end: f64,
    /// Times between two samples of the histories, and between two animations.
    pub sample: f64,
    pub frame: f64,
    /// A node of the mesh whose way is the deflection, and elements that fail first, if any does.
    pub deflection: u32,
    pub watched: Vec<u32>,
    /// Whether a material can fail.
    pub fails: bool,
    /// What resists hourglass modes in our host, of each material: a modulus.
    pub hourglass: Vec<f64>,
    /// A stable step at rest by the fastest wave and each element's least height.
    pub step: f64,
}

/// Contact of the yarns.
#[derive(Clone, Copy)]
pub struct Contact {
    pub friction: f64,
    /// The least distance of two yarns at rest.
    pub clearance: f64,
}

/// The fraction of the stable step that our host takes, and decks ask for.
pub const STEP_FACTOR: f64 = 0.9;
/// An element that may fail is taken out when its own step is this fraction of the first one. Our host has 0.2, by
/// direction, and takes out swollen sections as well.
pub const COLLAPSED: f64 = 0.1;
/// The factor of viscous hourglass control. The solvers' own is 0.1; with it free ends behind a break have gone
/// unstable in OpenRadioss, with 0.03 later. A part of its force grows there with h² and the square of the velocity,
/// and the stable step does not know it. With 0.01 a yarn that is about to break breaks earlier.
pub const HOURGLASS: f64 = 0.03;
/// Animations where the scene has no `frames`.
const FRAMES: usize = 40;

/// From the scene's units to the deck's.
#[derive(Clone, Copy)]
pub struct Conversion {
    pub from: UnitSystem,
    pub to: UnitSystem,
}

impl Conversion {
    pub fn convert(&self, value: f64, dimension: Dimension) -> f64 {
        self.from.scale(dimension).convert(value, &self.to.scale(dimension))
    }
}

/// The modulus with which our host resists hourglass modes, of each material.
///
/// # Errors
/// A material that the host cannot use.
pub fn hourglass<'a>(
    materials: impl IntoIterator<Item = &'a toron_materials::material::model::Material>,
    control: Control,
    conversion: Conversion,
) -> Result<Vec<f64>, Error> {
    let modulus = |material: &toron_materials::material::model::Material| {
        let medium = Medium::<f64>::new(material, material.density.unwrap_or_default(), control)?;
        Ok(conversion.convert(medium.hourglass, STRESS))
    };
    materials.into_iter().map(modulus).collect()
}

/// The time between two animations.
pub fn frame(end: f64, frames: usize) -> f64 {
    end / if frames == 0 { FRAMES } else { frames } as f64
}

impl Mesh {
    pub fn corners(&self, element: usize) -> [[f64; 3]; 8] {
        self.elements[element].map(|node| self.nodes[node as usize])
    }

    /// Volume by the triple products of the six tetrahedra about one diagonal, exact where faces are plane.
    pub fn volume(&self, element: usize) -> f64 {
        let corners = self.corners(element).map(nalgebra::Vector3::from);
        // Around the diagonal from the first node to the seventh.
        [[1, 2], [2, 3], [3, 7], [7, 4], [4, 5], [5, 1]]
            .map(|[a, b]| {
                let [a, b, c] = [corners[a], corners[b], corners[6]].map(|corner| corner - corners[0]);
                a.cross(&b).dot(&c) / 6.0
            })
            .iter()
            .sum()
    }

    /// The least height of an element: its volume over its largest face.
    pub fn height(&self, element: usize) -> f64 {
        let corners = self.corners(element).map(nalgebra::Vector3::from);
        let faces = [[0, 1, 2, 3], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
        let areas = faces.map(|[a, b, c, d]| 0.5 * (corners[c] - corners[a]).cross(&(corners[d] - corners[b])).norm());
        self.volume(element) / areas.into_iter().fold(0.0, f64::max)
    }

    /// Whether an element is a wedge.
    pub fn is_wedge(&self, element: usize) -> bool {
        let nodes = self.elements[element];
        nodes[0] == nodes[1] || nodes[2] == nodes[3]
    }
}

impl Model {
    /// The line of the deck that tells who compares its histories what they are; nothing where there are none.
    pub fn origin(&self, comment: &str) -> String {
        let origin = |strike: &Strike| Origin { units: self.units, part: strike.part }.comment();
        self.strike.as_ref().map_or_else(String::new, |strike| format!("{comment} {}\n", origin(strike)))
    }

    /// The mass of the elements.
    pub fn mass(&self) -> f64 {
        let of_part = |part: &Part| {
            let density = self.materials[part.material].density_if_any().unwrap_or_default();
            density * part.elements.iter().map(|&element| self.mesh.volume(element as usize)).sum::<f64>()
        };
        self.parts.iter().map(of_part).sum()
    }
}

/// A stable step of all elements, by their fastest wave at rest.
pub fn step(mesh: &Mesh, parts: &[Part], materials: &[Material]) -> f64 {
    let of_part = |part: &Part| {
        let material = &materials[part.material];
        let [bulk, shear] = material.bulk_and_shear();
        let speed = ((bulk + 4.0 / 3.0 * shear) / material.density_if_any().unwrap_or_default()).sqrt();
        part.elements.iter().map(|&element| mesh.height(element as usize)).fold(f64::INFINITY, f64::min) / speed
    };
    STEP_FACTOR * parts.iter().map(of_part).fold(f64::INFINITY, f64::min)
}
