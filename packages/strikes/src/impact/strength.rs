//! The strength of each element of a yarn.

use super::scene::Case;
use crate::strength::field::Yarn;
use crate::strength::scatter;
use toron::host::units::UnitSystem;
use toron_explicit_host::lanes::smallest;
use toron_explicit_host::mesh::Mesh;

/// A scene has one.
const YARN: Yarn = Yarn { ply: 0, family: 0, number: 0 };

impl Case {
    /// The strength of each element, where it scatters: the least of the cells that its layer meets. The half that is
    /// not modelled has the same ones.
    fn strengths(&self, mesh: &Mesh) -> Option<Vec<f64>> {
        let length = self.yarn.length;
        let cells = self.strength?.cells(YARN, [-length, length]);
        let piece = |element: &[u32; 8]| [0, 1].map(|corner: usize| mesh.nodes[element[corner] as usize][0]);
        Some(mesh.elements.iter().map(|element| cells.least(piece(element))).collect())
    }

    /// The failure limit of each element, as the explicit host takes it; none where they are all the property's.
    pub fn limits(&self, mesh: &Mesh) -> Option<Vec<f64>> {
        let material = self.zones.inner();
        let limits: Vec<f64> = self.strengths(mesh)?.into_iter().map(|strength| material.limit(strength)).collect();
        limits.iter().any(|&limit| limit != 0.0).then_some(limits)
    }

    /// The least strength of all elements, where it scatters.
    pub fn weakest(&self, units: &UnitSystem, mesh: &Mesh) -> Option<String> {
        let least = self.strengths(mesh)?.into_iter().fold(f64::INFINITY, smallest);
        Some(scatter::text(self.zones.inner(), least, units))
    }
}
