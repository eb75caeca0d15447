//! The keys that all struck scenes have, beside those of what is struck, and what is read from them.

use std::ops::Range;

use serde::Deserialize;
use serde::de::DeserializeOwned;
use toml::de::DeValue;

use super::zones::Zones;
use crate::cases::{self, CaseTables, SceneTable};
use crate::strength::file::{StrengthFile, complete_families};
use toron::host::units::UnitSystem;
use toron_explicit_host::control_keys::control;
use toron_explicit_host::medium::Control;
use toron_explicit_host::struck::plan::Plan;
use toron_materials::material::file::MaterialFile;
use toron_materials::material::laws::Laws;
use toron_materials::material::model::Material;
use toron_materials::material::of_law::{
    Choice, FRICTIONAL, FailureName, HYPERELASTIC, LINEAR_ELASTIC, LawName, MATERIAL, Tables, material_of_law,
    own_yarn, unused_material,
};
use toron_materials::material::smith::strike_speed;
use toron_shared::checked::{Checked, NotNegative, Positive, Whole, value};
use toron_shared::error::Error;
use toron_shared::spanned::Spanned;
use toron_shared::toml_file::{Numbers, Source, Unused};

/// Files for ParaView are numbered by four digits.
const MOST_FILES: usize = 9999;

/// What ends a run before its time is over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Until {
    /// What strikes has stopped, or gone through.
    Stopped,
    /// It has gone through; when it turns back, the run goes on.
    End,
    /// It has stopped, or it is certain that it goes through.
    Decided,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Precision {
    F64,
    F32,
}

/// The common keys of a scene's table, or of a case's.
#[derive(Clone, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(rename_all = "kebab-case")]
pub struct Keys {
    /// In `[[case]]` alone: of the case and its files. Required.
    pub name: Option<Spanned<String>>,
    /// `hybrid` is hyperelastic near the blow: up to `hyperelastic-length` from a yarn's mid-span, or
    /// `hyperelastic-radius` from a panel's centre, and linear elastic elsewhere.
    /// [`frictional`](guides/hosts.md#the-law-with-friction-between-the-fibres) has fibres that rub. Default:
    /// `hyperelastic`.
    pub law: Option<LawName>,
    /// `uniaxial` has α = β = 0. The linear law fails by its σ_lim with either. The limits and weights of the material
    /// must be those that the failure uses. Default: `none`.
    pub failure: Option<Spanned<FailureName>>,
    /// [Strength that scatters](reference/fabric-files.md#strength-that-scatters). Of a yarn it has no `warp` and
    /// `weft`, and the yarn's other half has the mirrored strengths. Default: the material's.
    pub strength: Option<Spanned<StrengthFile>>,
    /// The [material](guides/load-paths.md#material) of the hyperelastic law: what differs from the default yarn. The
    /// fibre of a struck yarn is `[1, 0, 0]`. A table that names a `preset` or a `law` inherits nothing. A case
    /// completes or overrides the scene's table. Where any table of the scene names another yarn, all must name theirs.
    /// A material that no case's law uses is refused. Default: `kevlar-km2-600`.
    pub hyperelastic: Option<Spanned<MaterialFile>>,
    /// The same of the linear elastic law. Default: `kevlar-km2-600-linear`.
    pub linear_elastic: Option<Spanned<MaterialFile>>,
    /// The same of the law with friction between the fibres. Default: `kevlar-km2-600-frictional`.
    pub frictional: Option<Spanned<MaterialFile>>,
    /// The same of [a law of your own](guides/own-law.md#struck), in its program alone.
    pub material: Option<Spanned<MaterialFile>>,
    /// Of what strikes; down along z on a panel. A speed that by Smith's theory stretches a yarn by more than 0.5 is
    /// refused. Required.
    pub speed: Option<Spanned<Positive>>,
    /// Of the whole projectile or striker. Required.
    pub mass: Option<Spanned<Positive>>,
    /// Of the projectile or striker. Required.
    pub radius: Option<Spanned<Positive>>,
    /// Coulomb friction coefficient, of what strikes and the yarns. Default: 0 on a yarn, 0.23 on a panel.
    pub friction: Option<Spanned<NotNegative>>,
    /// Pressure per depth of penetration, of all contact; for Kevlar 10⁵ MPa/mm or more. Required.
    pub contact_stiffness: Option<Spanned<Positive>>,
    /// Coefficient of hourglass control. Default: 0.1.
    pub hourglass: Option<NotNegative>,
    /// Coefficients of viscosity: linear, quadratic, and for the section's shape. Default: `[0.06, 1.5, 0.2]`.
    pub viscosity: Option<Numbers<3, NotNegative>>,
    /// Latest time at which the run ends. Required.
    pub end: Option<Positive>,
    /// What ends the run before `end`. A run on a panel ends always when the striker has gone through; with `stopped`
    /// and `decided` also when it turns back, and with `decided` also [as soon as it is
    /// certain](design/explicit-host.md#a-fate-that-is-decided) that it goes through. One on a yarn has `stopped`,
    /// until the projectile turns back, or `end`. Default: `stopped`.
    pub until: Option<Until>,
    /// Time between two lines of the history, up to `end`. Default: `end`/600 of a yarn, `end`/400 of a panel.
    pub sample: Option<Spanned<Positive>>,
    /// Times at which the yarn or the panel is drawn. Default: none.
    pub pictures: Option<Spanned<Vec<f64>>>,
    /// Number of VTU files, for ParaView, after the one of the start. Default: none.
    pub frames: Option<Whole<0, MOST_FILES>>,
    /// How many checkpoints are written, at equal intervals, and one more if the run ends before. Default: 0.
    pub checkpoints: Option<Whole<0, MOST_FILES>>,
    /// [Of the computation](results/fabric.md#single-precision). Default: `f64` of a yarn, `f32` of a panel.
    pub precision: Option<Precision>,
}

/// A table of a scene, or of a case: the common keys, and those of the target, a yarn or a panel.
pub struct Table<T> {
    pub common: Keys,
    pub target: T,
}

/// The keys of what is struck.
pub trait Target: DeserializeOwned {
    /// A key of this table that none of these cases reads.
    fn unused(table: &Table<Self>, cases: &[&Table<Self>]) -> Unused;
}

impl<T: Target> SceneTable for Table<T> {
    fn read(source: &Source, table: &toml::Spanned<DeValue>) -> Result<Table<T>, Error> {
        let mut table = table.clone();
        if let DeValue::Table(keys) = table.get_mut()
            && let Some(strength) = keys.get_mut("strength")
        {
            complete_families(strength);
        }
        let (common, target) = source.read_both(&table)?;
        Ok(Table { common, target })
    }

    fn name(&self) -> Option<&Spanned<String>> {
        self.common.name.as_ref()
    }

    fn unused(&self, cases: &[&Table<T>]) -> Unused {
        T::unused(self, cases)
    }
}

impl Keys {
    pub fn law(&self) -> LawName {
        let default = if self.material.is_some() { LawName::Own } else { LawName::Hyperelastic };
        self.law.unwrap_or(default)
    }

    /// The materials' tables, by their law.
    pub fn materials(&self) -> Tables<&Option<Spanned<MaterialFile>>> {
        [
            (HYPERELASTIC, &self.hyperelastic),
            (LINEAR_ELASTIC, &self.linear_elastic),
            (FRICTIONAL, &self.frictional),
            (MATERIAL, &self.material),
        ]
    }

    /// The place of a property that this table itself gives to the material of a law.
    fn given(&self, law: &str, name: &str) -> Option<Range<usize>> {
        let (_, table) = self.materials().into_iter().find(|(of, _)| *of == law)?;
        table.as_ref()?.get_ref().given(name).map(Spanned::span)
    }

    /// Whether anything may fail.
    pub fn fails(&self) -> bool {
        self.failure.as_ref().is_some_and(|failure| *failure.get_ref() != FailureName::None)
    }

    /// A material of this table that none of these cases has a law for, or a strength where nothing fails.
    pub fn unused(&self, cases: &[&Keys]) -> Unused {
        let laws: Vec<LawName> = cases.iter().map(|case| case.law()).collect();
        unused_material(self.materials(), &laws).or_else(|| {
            let strength = self.strength.as_ref().filter(|_| !cases.iter().any(|case| case.fails()))?;
            let message = "strength of what does not fail; allowed: with failure = \"uniaxial\" or \"multiaxial\"";
            Some((strength.span(), message.to_string()))
        })
    }
}

/// Reads the cases of a scene as [`cases::cases`] finds them in these tables.
///
/// # Errors
/// As for that; what `read` refuses.
pub fn read_cases<'t, T: Target, C>(
    (source, laws, units): (&Source<'t>, Laws, &UnitSystem),
    tables: &DeValue<'t>,
    beside: &[&str],
    common: &[&str],
    read: impl Fn(&Reader, &CaseTables<Table<T>>) -> Result<C, Error>,
) -> Result<Vec<C>, Error> {
    let cases: Vec<CaseTables<Table<T>>> = cases::cases(source, tables, beside, common)?;
    let own_yarn = own_yarn(cases.iter().flat_map(|case| case.table.common.materials()));
    let read_case = |case: &CaseTables<Table<T>>| {
        let (keys, case_keys) = (&case.table.common, &case.own_table.common);
        read(&Reader { source, laws, units, keys, case_keys, own_yarn: own_yarn.as_deref(), span: case.span() }, case)
    };
    cases.iter().map(read_case).collect()
}

/// A case's table and what is needed to read it.
pub struct Reader<'a> {
    pub source: &'a Source<'a>,
    /// The laws of the program.
    pub laws: Laws,
    pub units: &'a UnitSystem,
    /// The case's keys over the scene's, and those of the case's table alone.
    pub keys: &'a Keys,
    pub case_keys: &'a Keys,
    /// A yarn that some table of the scene names, other than the default ones.
    pub own_yarn: Option<&'a str>,
    /// The place that errors name for keys that are missing.
    pub span: Range<usize>,
}

impl Reader<'_> {
    /// The value of a key that must be there.
    pub fn needed<V: Checked>(&self, key: &str, given: &Option<V>) -> Result<V::Value, Error> {
        self.source.needed(key, given, self.span.clone())
    }

    /// What the case of this name is going to do, with so many samples in its history where the file does not say
    /// otherwise.
    pub fn plan(&self, name: &str, samples: f64) -> Result<Plan, Error> {
        let keys = self.keys;
        let end = self.needed("end", &keys.end)?;
        let sample = value(&keys.sample).unwrap_or(end / samples);
        if let Some(given) = keys.sample.as_ref().filter(|_| sample > end) {
            let message = format!("sample is {sample}; allowed: a number > 0, up to end = {end}");
            return Err(self.source.error(given.span(), &message));
        }
        Ok(Plan {
            end,
            steps_to: None,
            rebounds: keys.until == Some(Until::End),
            decides: keys.until == Some(Until::Decided),
            settles: false,
            sample,
            pictures: self.source.pictures(&keys.pictures, name, end)?,
            frames: value(&keys.frames).unwrap_or(0),
            checkpoints: value(&keys.checkpoints).unwrap_or(0),
        })
    }

    pub fn control(&self) -> Control {
        control(&self.keys.hourglass, &self.keys.viscosity)
    }

    /// The speed of what strikes this material.
    pub fn speed(&self, material: &Material) -> Result<f64, Error> {
        let speed = self.needed("speed", &self.keys.speed)?;
        let place = self.keys.speed.as_ref().map_or(self.span.clone(), Spanned::span);
        strike_speed(self.source, speed, place, material, self.units)
    }

    /// The materials of the case's law; `distance` is how far the first of two reaches.
    pub fn zones(&self, distance: impl FnOnce() -> Result<f64, Error>) -> Result<Zones, Error> {
        let law = self.keys.law();
        if let (Laws::Own(own), None, LawName::Hyperelastic) = (self.laws, self.keys.law, law) {
            let message = format!(
                "the material is missing; allowed: the table material, of the law {}, or law = \"hyperelastic\" and the like",
                own.name
            );
            return Err(self.source.error(self.span.clone(), &message));
        }
        let tables = self.keys.materials().into_iter().filter(|(table, _)| law.has(table));
        let materials: Vec<Material> =
            tables.map(|(table, file)| self.material(table, file)).collect::<Result<_, Error>>()?;
        Ok(match <[Material; 2]>::try_from(materials) {
            Ok(both) => Zones::Two(Box::new(both), distance()?),
            Err(one) => Zones::One(Box::new(one.into_iter().next().expect("every law has a table"))),
        })
    }

    /// The material of this law's table.
    ///
    /// # Errors
    /// As for [`material_of_law`].
    pub fn material(&self, law: &'static str, table: &Option<Spanned<MaterialFile>>) -> Result<Material, Error> {
        // A property of the scene is wrong only beside the failure of a case: that is the line to change.
        let place = |name: &str| self.case_keys.given(law, name).or(self.case_keys.failure.as_ref().map(Spanned::span));
        let failure = self.keys.failure.as_ref().map_or(FailureName::None, |failure| *failure.get_ref());
        if let Some(given) = self.keys.failure.as_ref().filter(|_| law == MATERIAL && failure != FailureName::None) {
            let message =
                "failure is that of the library's laws; allowed: none, since this law says itself when it fails";
            return Err(self.source.error(given.span(), message));
        }
        let choice =
            Choice { laws: self.laws, law, failure, own_yarn: self.own_yarn, place: &place, span: self.span.clone() };
        material_of_law(self.source, &choice, table, self.units)
    }
}
