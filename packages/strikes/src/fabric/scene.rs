//! A scene: a panel, what strikes it, and the cases that differ from one another.

use std::sync::Arc;

use crate::scene_keys::shots::Shots;
pub use crate::scene_keys::zones::Zones;
use crate::strength::scatter::Strength;
use crate::weave::cloth::Cloth;
use crate::weave::geometry::Family;
use crate::weave::panel::Part;
use toron::host::units::UnitSystem;
use toron_explicit_host::contact::RigidSurface;
use toron_explicit_host::medium::Control;
use toron_explicit_host::mutual_contact::Parameters;
use toron_explicit_host::struck::plan::Plan;
use toron_materials::material::model::Material;

/// The cases of a file.
#[derive(Clone, Debug)]
pub struct Scene {
    pub title: String,
    pub units: UnitSystem,
    pub cases: Vec<Case>,
    /// The series that `toron v50` fires.
    pub shots: Option<Shots>,
}

/// One run.
#[derive(Clone, Debug)]
pub struct Case {
    pub name: String,
    /// The panel; cases without keys of their own for it have the same one.
    pub cloth: Arc<Cloth>,
    pub zones: Zones,
    /// What the yarns of warp and weft of each ply are made of, where they have materials of their own.
    pub threads: Vec<[Option<Box<Material>>; 2]>,
    /// What strikes, and the whole of its mass.
    pub striker: RigidSurface,
    pub mass: f64,
    pub striker_density: StrikerDensity,
    pub speed: f64,
    /// Where it scatters, in place of the materials'.
    pub strength: Option<Strength>,
    /// Whether the yarns' ends at the panel's outline are fixed.
    pub held: bool,
    /// Of yarns with one another.
    pub mutual: Parameters,
    pub control: Control,
    /// The part of the yarns' mass that torn ends may be lent in all.
    pub shred_mass: f64,
    pub plan: Plan,
    pub single_precision: bool,
}

/// What is known of the material of what strikes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrikerDensity {
    /// In kg/m³; none of a cylinder whose length is not given.
    pub density: Option<f64>,
    /// Whether the file gives it, and not only a mass and sizes.
    pub is_told: bool,
}

impl Case {
    /// Those of the zones, then those of warp and weft.
    pub fn materials(&self) -> impl Iterator<Item = &Material> {
        self.zones.materials().iter().chain(self.threads.iter().flatten().flatten().map(|material| &**material))
    }

    /// What symmetry leaves out.
    pub fn left_out(&self) -> Option<&'static str> {
        (self.cloth.part() == Part::Quarter).then_some("three quarters of a panel")
    }

    /// The place among the materials of what the yarns of a ply's family are made of, if it is not that of the zones.
    pub fn own_material(&self, ply: usize, family: Family) -> Option<usize> {
        let before = self.threads.iter().flatten().take(2 * ply + family as usize).flatten().count();
        self.threads[ply][family as usize].as_ref().map(|_| self.zones.materials().len() + before)
    }

    /// The plies' families that have materials of their own, in the order of these.
    pub fn families_with_materials(&self) -> impl Iterator<Item = (usize, Family)> {
        let families = (0..self.threads.len()).flat_map(|ply| Family::BOTH.map(|family| (ply, family)));
        families.filter(|&(ply, family)| self.threads[ply][family as usize].is_some())
    }

    /// What the yarns of a ply's family are made of in the middle.
    pub fn material(&self, ply: usize, family: Family) -> &Material {
        self.threads[ply][family as usize].as_deref().unwrap_or(self.zones.inner())
    }

    /// What the yarns of warp and weft of each ply are made of in the middle.
    pub fn of_plies(&self) -> Vec<[Material; 2]> {
        (0..self.threads.len()).map(|ply| Family::BOTH.map(|family| self.material(ply, family).clone())).collect()
    }

    /// The names of the materials: of the zones from the centre outwards, or of the plies' warp and weft.
    pub fn material_names(&self) -> String {
        if self.families_with_materials().next().is_none() {
            return self.zones.names();
        }
        let families = (0..self.threads.len()).flat_map(|ply| Family::BOTH.map(|family| (ply, family)));
        let name = |(ply, family)| format!("{} {}", self.family_name(ply, family), self.material(ply, family).name());
        families.map(name).collect::<Vec<_>>().join("; ")
    }

    /// As `warp`, or `ply-2-warp` where there are several.
    pub fn family_name(&self, ply: usize, family: Family) -> String {
        if self.threads.len() == 1 { family.name().to_string() } else { format!("ply-{}-{}", ply + 1, family.name()) }
    }
}
