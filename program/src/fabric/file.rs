//! The tables of a scene's TOML file: the weave, the scene's own table and its cases'.

use serde::Deserialize;
use toml::Spanned;

use crate::common::toml_file::{Numbers, Unused, over};
use crate::impact::scene::Precision;
use crate::material::file::MaterialFile;
use crate::material::of_law::{FailureName, HYPERELASTIC, LINEAR_ELASTIC, LawName, unused_material};
use crate::weave::file::WeaveFile;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    pub title: Option<String>,
    pub units: Spanned<String>,
    pub weave: Spanned<WeaveFile>,
    pub scene: Spanned<CaseFile>,
    #[serde(default)]
    pub case: Vec<Spanned<CaseFile>>,
}

/// The scene's table, and what a case has otherwise.
#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct CaseFile {
    pub name: Option<Spanned<String>>,
    pub weave: Option<Spanned<WeaveFile>>,
    pub law: Option<LawName>,
    pub failure: Option<Spanned<FailureName>>,
    pub hyperelastic: Option<Spanned<MaterialFile>>,
    pub linear_elastic: Option<Spanned<MaterialFile>>,
    pub hyperelastic_radius: Option<Spanned<f64>>,
    pub speed: Option<Spanned<f64>>,
    pub mass: Option<Spanned<f64>>,
    pub radius: Option<Spanned<f64>>,
    pub rim: Option<Rim>,
    pub friction: Option<Spanned<f64>>,
    pub yarn_friction: Option<Spanned<f64>>,
    pub contact_stiffness: Option<Spanned<f64>>,
    pub hourglass: Option<Spanned<f64>>,
    pub viscosity: Option<Spanned<Numbers<3>>>,
    pub end: Option<Spanned<f64>>,
    pub until: Option<Until>,
    pub sample: Option<Spanned<f64>>,
    pub pictures: Option<Spanned<Vec<f64>>>,
    pub frames: Option<Spanned<i64>>,
    pub checkpoints: Option<Spanned<i64>>,
    pub precision: Option<Precision>,
}

/// What ends a run before its time is over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Until {
    /// The sphere has stopped, or gone through.
    Stopped,
    /// It has gone through; when it turns back, the run goes on.
    End,
}

/// How the yarns' ends at the panel's outline are held.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Rim {
    Fixed,
    Free,
}

impl CaseFile {
    pub fn law(&self) -> LawName {
        self.law.unwrap_or(LawName::Hyperelastic)
    }

    /// The materials' tables, by their law.
    pub fn materials(&self) -> [(&'static str, &Option<Spanned<MaterialFile>>); 2] {
        [(HYPERELASTIC, &self.hyperelastic), (LINEAR_ELASTIC, &self.linear_elastic)]
    }

    pub fn failure(&self) -> FailureName {
        self.failure.as_ref().map_or(FailureName::None, |failure| *failure.get_ref())
    }

    /// A material or a radius of this table that none of these cases has a law for.
    pub fn unused(&self, cases: &[&CaseFile]) -> Unused {
        let laws: Vec<LawName> = cases.iter().map(|case| case.law()).collect();
        let radius = self.hyperelastic_radius.as_ref().filter(|_| !laws.contains(&LawName::Hybrid));
        let radius = radius.map(|radius| {
            let message = format!("hyperelastic-radius is {}; allowed: with law = \"hybrid\"", radius.get_ref());
            (radius.span(), message)
        });
        unused_material(&self.hyperelastic, &self.linear_elastic, &laws).or(radius)
    }

    /// This table, with the keys of `base` where it has none, but for its name and its weave, which goes over `[weave]`.
    pub fn over(&self, base: &CaseFile) -> CaseFile {
        let material = |own: &_, base: &_| over(own, base, MaterialFile::over);
        let (own, base) = (self.clone(), base.clone());
        CaseFile {
            name: own.name,
            weave: own.weave,
            law: own.law.or(base.law),
            failure: own.failure.or(base.failure),
            hyperelastic: material(&own.hyperelastic, &base.hyperelastic),
            linear_elastic: material(&own.linear_elastic, &base.linear_elastic),
            hyperelastic_radius: own.hyperelastic_radius.or(base.hyperelastic_radius),
            speed: own.speed.or(base.speed),
            mass: own.mass.or(base.mass),
            radius: own.radius.or(base.radius),
            rim: own.rim.or(base.rim),
            friction: own.friction.or(base.friction),
            yarn_friction: own.yarn_friction.or(base.yarn_friction),
            contact_stiffness: own.contact_stiffness.or(base.contact_stiffness),
            hourglass: own.hourglass.or(base.hourglass),
            viscosity: own.viscosity.or(base.viscosity),
            end: own.end.or(base.end),
            until: own.until.or(base.until),
            sample: own.sample.or(base.sample),
            pictures: own.pictures.or(base.pictures),
            frames: own.frames.or(base.frames),
            checkpoints: own.checkpoints.or(base.checkpoints),
            precision: own.precision.or(base.precision),
        }
    }
}
