//! What is struck: a panel that is woven here, or one of a mesh file.

use toml::Spanned;

use super::figures::Figures;
use super::file::WeaveFile;
use super::foreign::file::MeshFile;
use super::foreign::reader::Foreign;
use super::model::Model;
use super::panel::Part;
use super::reader::Woven;
use crate::common::error::Error;
use crate::common::toml_file::Source;
use toron::host::units::UnitSystem;

#[derive(Clone, Debug)]
pub enum Cloth {
    Woven(Woven),
    Foreign(Box<Foreign>),
}

impl Cloth {
    pub fn model(&self) -> Model {
        match self {
            Cloth::Woven(woven) => woven.model(),
            Cloth::Foreign(foreign) => foreign.model.clone(),
        }
    }

    pub fn figures(&self, model: &Model) -> Figures {
        match self {
            Cloth::Woven(woven) => Figures::of(model, &woven.geometry),
            Cloth::Foreign(foreign) => foreign.figures,
        }
    }

    /// The part of the panel that is modelled.
    pub fn part(&self) -> Part {
        match self {
            Cloth::Woven(woven) => woven.panel.part,
            Cloth::Foreign(foreign) => foreign.part,
        }
    }

    /// The least distance of two yarns at rest.
    pub fn clearance(&self) -> f64 {
        match self {
            Cloth::Woven(woven) => woven.geometry.weave.clearance,
            Cloth::Foreign(foreign) => foreign.clearance,
        }
    }

    /// The least and the largest height of a family's yarns.
    pub fn yarn_heights(&self) -> [f64; 2] {
        let [warp, weft] = match self {
            Cloth::Woven(woven) => woven.geometry.weave.threads.map(|thread| thread.height),
            Cloth::Foreign(foreign) => foreign.heights,
        };
        [warp.min(weft), warp.max(weft)]
    }

    /// Elements that reach into another yarn.
    pub fn overlapping(&self) -> &[usize] {
        match self {
            Cloth::Woven(_) => &[],
            Cloth::Foreign(foreign) => &foreign.checks.overlapping,
        }
    }

    /// The larger pitch.
    pub fn pitch(&self) -> f64 {
        let [warp, weft] = match self {
            Cloth::Woven(woven) => woven.geometry.weave.threads.map(|thread| thread.pitch),
            Cloth::Foreign(foreign) => foreign.pitch,
        };
        warp.max(weft)
    }
}

impl Source<'_> {
    /// The table `[weave]` or `[mesh]`.
    ///
    /// # Errors
    /// Neither or both are there, or what is wrong with the one.
    pub fn cloth(
        &self,
        weave: Option<&Spanned<WeaveFile>>,
        mesh: Option<&Spanned<MeshFile>>,
        units: &UnitSystem,
    ) -> Result<Cloth, Error> {
        match (weave, mesh) {
            (Some(weave), None) => self.woven(weave, units).map(Cloth::Woven),
            (None, Some(mesh)) => self.foreign(mesh, units).map(|foreign| Cloth::Foreign(Box::new(foreign))),
            (Some(_), Some(mesh)) => Err(self.error(mesh.span(), "[mesh] beside [weave]; allowed: one of them")),
            (None, None) => Err(self.error(0..0, "[weave] is missing; allowed: [weave], or [mesh] with a file")),
        }
    }
}
