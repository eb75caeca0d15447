//! The keys that all struck scenes have: a table that a scene adds its own keys to, and what is read from it.

use std::ops::Range;

use serde::Deserialize;
use toml::Spanned;

use super::zones::Zones;
use crate::strength::file::StrengthFile;
use toron::host::units::UnitSystem;
use toron_explicit_host::control_keys::control;
use toron_explicit_host::medium::Control;
use toron_explicit_host::struck::plan::Plan;
use toron_materials::material::file::MaterialFile;
use toron_materials::material::model::Material;
use toron_materials::material::of_law::material_of_law;
use toron_materials::material::of_law::{
    Choice, FailureName, HYPERELASTIC, LINEAR_ELASTIC, LawName, own_yarn, unused_material,
};
use toron_materials::material::smith::strike_speed;
use toron_shared::error::Error;
use toron_shared::toml_file::{Source, Unused, over};

/// Files for ParaView are numbered by four digits.
const MOST_FILES: usize = 9999;

/// What ends a run before its time is over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
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
#[serde(rename_all = "kebab-case")]
pub enum Precision {
    F64,
    F32,
}

/// Gives the common keys and their types to another macro.
macro_rules! with_common_keys {
    ($then:ident! { $($own:tt)* }) => {
        $then! {
            {
                name: toml::Spanned<String>,
                law: toron_materials::material::of_law::LawName,
                failure: toml::Spanned<toron_materials::material::of_law::FailureName>,
                strength: toml::Spanned<$crate::strength::file::StrengthFile>,
                hyperelastic: toml::Spanned<toron_materials::material::file::MaterialFile>,
                linear_elastic: toml::Spanned<toron_materials::material::file::MaterialFile>,
                speed: toml::Spanned<f64>,
                mass: toml::Spanned<f64>,
                radius: toml::Spanned<f64>,
                friction: toml::Spanned<f64>,
                contact_stiffness: toml::Spanned<f64>,
                hourglass: toml::Spanned<f64>,
                viscosity: toml::Spanned<toron_shared::toml_file::Numbers<3>>,
                end: toml::Spanned<f64>,
                until: $crate::struck::keys::Until,
                sample: toml::Spanned<f64>,
                pictures: toml::Spanned<Vec<f64>>,
                frames: toml::Spanned<i64>,
                checkpoints: toml::Spanned<i64>,
                precision: $crate::struck::keys::Precision,
            }
            $($own)*
        }
    };
}

macro_rules! keys {
    ({ $($key:ident: $kind:ty,)* }) => {
        /// The common keys of a scene's table, or of a case's.
        #[derive(Clone)]
        pub struct Keys {
            $(pub $key: Option<$kind>,)*
        }

        impl Keys {
            fn or(self, base: Keys) -> Keys {
                Keys { $($key: self.$key.or(base.$key),)* }
            }
        }
    };
}
with_common_keys!(keys! {});

/// A table of a file: the common keys, and a scene's own.
macro_rules! case_file {
    ({ $($key:ident: $kind:ty,)* } { $($own:ident: $own_kind:ty,)* }) => {
        /// The table as it stands in the file.
        #[derive(serde::Deserialize)]
        #[serde(deny_unknown_fields, rename_all = "kebab-case")]
        struct Flat {
            $($key: Option<$kind>,)*
            $($own: Option<$own_kind>,)*
        }

        /// The scene's table, and what a case has otherwise.
        #[derive(Clone, serde::Deserialize)]
        #[serde(from = "Flat")]
        pub struct CaseFile {
            pub keys: $crate::struck::keys::Keys,
            $(pub $own: Option<$own_kind>,)*
        }

        impl From<Flat> for CaseFile {
            fn from(flat: Flat) -> CaseFile {
                let Flat { $($key,)* $($own,)* } = flat;
                CaseFile { keys: $crate::struck::keys::Keys { $($key,)* }, $($own,)* }
            }
        }

        impl $crate::struck::keys::Table for CaseFile {
            fn keys(&self) -> &$crate::struck::keys::Keys {
                &self.keys
            }

            fn over(&self, base: &CaseFile) -> CaseFile {
                let (own, base) = (self.clone(), base.clone());
                CaseFile { keys: own.keys.over(base.keys), $($own: own.$own.or(base.$own),)* }
            }
        }
    };
}
pub(crate) use {case_file, with_common_keys};

impl Keys {
    /// These keys, with those of `base` where there is none.
    pub fn over(self, base: Keys) -> Keys {
        let material = |own: &_, base: &_| over(own, base, MaterialFile::over);
        Keys {
            hyperelastic: material(&self.hyperelastic, &base.hyperelastic),
            linear_elastic: material(&self.linear_elastic, &base.linear_elastic),
            strength: over(&self.strength, &base.strength, StrengthFile::over),
            ..self.or(base)
        }
    }

    pub fn law(&self) -> LawName {
        self.law.unwrap_or(LawName::Hyperelastic)
    }

    pub fn is_single_precision(&self) -> bool {
        self.precision == Some(Precision::F32)
    }

    /// The materials' tables, by their law.
    pub fn materials(&self) -> [(&'static str, &Option<Spanned<MaterialFile>>); 2] {
        [(HYPERELASTIC, &self.hyperelastic), (LINEAR_ELASTIC, &self.linear_elastic)]
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
        unused_material(&self.hyperelastic, &self.linear_elastic, &laws).or_else(|| {
            let strength = self.strength.as_ref().filter(|_| !cases.iter().any(|case| case.fails()))?;
            let message = "strength of what does not fail; allowed: with failure = \"uniaxial\" or \"multiaxial\"";
            Some((strength.span(), message.to_string()))
        })
    }
}

/// A table of a scene's file.
pub trait Table: Clone {
    fn keys(&self) -> &Keys;

    /// This table, with the keys of `base` where it has none.
    fn over(&self, base: &Self) -> Self;
}

/// Reads the cases of a scene, or the scene as the only one: `read` gets the reader of the common keys, the case's keys
/// over the scene's, its own ones alone and its name. The files that cases have in common are called as `common` says,
/// without their endings.
///
/// # Errors
/// A key that no case reads, as `unused` finds it; a name that cannot be; what `read` refuses.
pub fn cases<F: Table, C>(
    (source, units): (&Source, &UnitSystem),
    (scene, cases): (&Spanned<F>, &[Spanned<F>]),
    common: &[&str],
    unused: impl Fn(&F, &[&F]) -> Unused,
    read: impl Fn(&Reader, [&F; 2], String) -> Result<C, Error>,
) -> Result<Vec<C>, Error> {
    let base = scene.get_ref();
    if let Some(name) = &base.keys().name {
        return Err(source.error(name.span(), "name in [scene]; allowed: in a [[case]]"));
    }
    let tables: Vec<F> = cases.iter().map(|case| case.get_ref().over(base)).collect();
    let own_yarn = own_yarn(std::iter::once(base).chain(&tables).flat_map(|table| table.keys().materials()));
    let reader = |table: &F, own: &F, span: Range<usize>, name: String| {
        let (keys, own_keys) = (table.keys(), own.keys());
        let reader = Reader { source, units, keys, own: own_keys, own_yarn: own_yarn.as_deref(), span };
        read(&reader, [table, own], name)
    };
    if cases.is_empty() {
        source.refuse_unused(unused(base, &[base]))?;
        return Ok(vec![reader(base, base, scene.span(), "scene".to_string())?]);
    }
    source.refuse_unused(unused(base, &tables.iter().collect::<Vec<_>>()))?;
    let (mut names, mut found): (Vec<String>, _) = (Vec::new(), Vec::new());
    for (case, table) in cases.iter().zip(&tables) {
        let own = case.get_ref();
        let taken = common.iter().copied().chain(names.iter().map(String::as_str));
        let name = source.name_of("case", own.keys().name.as_ref(), case.span(), taken)?;
        source.refuse_unused(unused(own, &[table]))?;
        found.push(reader(table, own, case.span(), name.clone())?);
        names.push(name);
    }
    Ok(found)
}

/// A case's table and what is needed to read it.
pub struct Reader<'a> {
    pub source: &'a Source<'a>,
    pub units: &'a UnitSystem,
    /// The case's keys over the scene's, and those of the case's table alone.
    pub keys: &'a Keys,
    pub own: &'a Keys,
    /// A yarn that some table of the scene names, other than the default ones.
    pub own_yarn: Option<&'a str>,
    /// The place that errors name for keys that are missing.
    pub span: Range<usize>,
}

impl Reader<'_> {
    fn missing(&self, key: &str, allowed: &str) -> Error {
        self.source.error(self.span.clone(), &format!("{key} is missing; allowed: {allowed}"))
    }

    pub fn positive(&self, key: &str, value: &Option<Spanned<f64>>) -> Result<f64, Error> {
        match value {
            Some(value) => self.source.positive(key, *value.get_ref(), value.span()),
            None => Err(self.missing(key, "a finite number > 0")),
        }
    }

    /// A whole number from `least` to `most`, or the default.
    pub fn count(
        &self,
        key: &str,
        value: &Option<Spanned<i64>>,
        [least, most]: [usize; 2],
        default: Option<usize>,
    ) -> Result<usize, Error> {
        let allowed = format!("a whole number from {least} to {most}");
        let Some(count) = value else { return default.ok_or_else(|| self.missing(key, &allowed)) };
        match usize::try_from(*count.get_ref()) {
            Ok(number) if (least..=most).contains(&number) => Ok(number),
            _ => Err(self.source.error(count.span(), &format!("{key} is {}; allowed: {allowed}", count.get_ref()))),
        }
    }

    /// What the case of this name is going to do, with so many samples in its history where the file does not say
    /// otherwise.
    pub fn plan(&self, name: &str, samples: f64) -> Result<Plan, Error> {
        let keys = self.keys;
        let end = self.positive("end", &keys.end)?;
        let sample = if keys.sample.is_some() { self.positive("sample", &keys.sample)? } else { end / samples };
        if let Some(given) = keys.sample.as_ref().filter(|given| *given.get_ref() > end) {
            let message = format!("sample is {sample}; allowed: a number > 0, up to end = {end}");
            return Err(self.source.error(given.span(), &message));
        }
        Ok(Plan {
            end,
            steps_to: None,
            rebounds: keys.until == Some(Until::End),
            decides: keys.until == Some(Until::Decided),
            sample,
            pictures: self.source.pictures(&keys.pictures, name, end)?,
            frames: self.count("frames", &keys.frames, [0, MOST_FILES], Some(0))?,
            checkpoints: self.count("checkpoints", &keys.checkpoints, [0, MOST_FILES], Some(0))?,
        })
    }

    pub fn control(&self) -> Result<Control, Error> {
        control(self.source, &self.keys.hourglass, &self.keys.viscosity)
    }

    /// The speed of what strikes this material.
    pub fn speed(&self, material: &Material) -> Result<f64, Error> {
        let speed = self.positive("speed", &self.keys.speed)?;
        let place = self.keys.speed.as_ref().map_or(self.span.clone(), Spanned::span);
        strike_speed(self.source, speed, place, material, self.units)
    }

    /// The materials of the case's law; `distance` is how far the first of two reaches.
    pub fn zones(&self, distance: impl FnOnce() -> Result<f64, Error>) -> Result<Zones, Error> {
        let [hyperelastic, linear] =
            self.keys.materials().map(|(law, table)| move || self.material(law, table).map(Box::new));
        Ok(match self.keys.law() {
            LawName::Hyperelastic => Zones::One(hyperelastic()?),
            LawName::LinearElastic => Zones::One(linear()?),
            LawName::Hybrid => Zones::Two(Box::new([*hyperelastic()?, *linear()?]), distance()?),
        })
    }

    /// The material of this law's table.
    ///
    /// # Errors
    /// As for [`material_of_law`].
    pub fn material(&self, law: &'static str, table: &Option<Spanned<MaterialFile>>) -> Result<Material, Error> {
        // A property of the scene is wrong only beside the failure of a case: that is the line to change.
        let place = |name: &str| self.own.given(law, name).or(self.own.failure.as_ref().map(Spanned::span));
        let failure = self.keys.failure.as_ref().map_or(FailureName::None, |failure| *failure.get_ref());
        let choice = Choice { law, failure, own_yarn: self.own_yarn, place: &place, span: self.span.clone() };
        material_of_law(self.source, &choice, table, self.units)
    }
}
