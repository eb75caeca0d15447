//! A scene: a panel, what strikes it, and the cases that differ from one another.

use std::sync::Arc;

use crate::explicit::contact::Rigid;
use crate::explicit::medium::Control;
use crate::explicit::mutual_contact::Parameters;
use crate::material::model::Material;
use crate::struck::plan::Plan;
pub use crate::struck::zones::Zones;
use crate::weave::cloth::Cloth;
use crate::weave::geometry::Family;
use toron::host::units::UnitSystem;

/// The cases of a file.
#[derive(Clone, Debug)]
pub struct Scene {
    pub title: String,
    pub units: UnitSystem,
    pub cases: Vec<Case>,
}

/// One run.
#[derive(Clone, Debug)]
pub struct Case {
    pub name: String,
    /// The panel; cases without keys of their own for it have the same one.
    pub cloth: Arc<Cloth>,
    pub zones: Zones,
    /// What the yarns of warp and weft are made of, where they have materials of their own.
    pub threads: [Option<Box<Material>>; 2],
    /// The sphere, and the whole of its mass.
    pub sphere: Rigid,
    pub mass: f64,
    pub speed: f64,
    /// Whether the yarns' ends at the panel's outline are fixed.
    pub held: bool,
    /// Of yarns with one another.
    pub mutual: Parameters,
    pub control: Control,
    pub plan: Plan,
    pub single_precision: bool,
}

impl Case {
    /// Those of the zones, then those of warp and weft.
    pub fn materials(&self) -> impl Iterator<Item = &Material> {
        self.zones.materials().iter().chain(self.threads.iter().flatten().map(|material| &**material))
    }

    /// The place among the materials of what a yarn of this family is made of, if it is not that of the zones.
    pub fn own_material(&self, family: Family) -> Option<usize> {
        let of_weft = self.zones.materials().len() + usize::from(self.threads[0].is_some());
        let place = if family == Family::Warp { self.zones.materials().len() } else { of_weft };
        self.threads[family as usize].as_ref().map(|_| place)
    }

    /// What the yarns of a family are made of in the middle.
    pub fn material(&self, family: Family) -> &Material {
        self.threads[family as usize].as_deref().unwrap_or(self.zones.inner())
    }

    /// The names of the materials: of the zones from the centre outwards, or of warp and weft.
    pub fn material_names(&self) -> String {
        if self.threads.iter().all(Option::is_none) {
            return self.zones.names();
        }
        Family::BOTH.map(|family| format!("{} {}", family.name(), self.material(family).name())).join("; ")
    }
}
