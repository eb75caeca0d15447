//! What a yarn or a panel is made of, from where it is struck outwards.

use toron_materials::material::model::{self, Material};
use toron_shared::numbers::number;

#[derive(Clone, Debug)]
pub enum Zones {
    One(Box<Material>),
    /// The first material up to this distance from the middle, in a yarn in whole layers.
    Two(Box<[Material; 2]>, f64),
}

impl Zones {
    /// The material in the middle.
    pub fn inner(&self) -> &Material {
        &self.materials()[0]
    }

    pub fn materials(&self) -> &[Material] {
        match self {
            Zones::One(material) => std::slice::from_ref(&**material),
            Zones::Two(materials, _) => &materials[..],
        }
    }

    /// The names of the materials, from the middle outwards.
    pub fn names(&self) -> String {
        let to = match self {
            Zones::One(_) => String::new(),
            Zones::Two(_, distance) => number(*distance),
        };
        model::names(self.materials(), &to)
    }
}
