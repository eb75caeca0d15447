//! The table `[scene.strength]` as it stands in the file.

use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::layers::layered;
use toron_shared::checked::Positive;
use toron_shared::field_names::field_names;

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct StrengthFile {
    pub seed: Option<u64>,
    pub cell: Option<Spanned<f64>>,
    reference_length: Option<Positive>,
    weibull_modulus: Option<Spanned<f64>>,
    strain: Option<Spanned<Positive>>,
    stress: Option<Spanned<Positive>>,
    elastic_modulus: Option<Spanned<Positive>>,
    pub warp: Option<Spanned<LawFile>>,
    pub weft: Option<Spanned<LawFile>>,
}

/// Weibull's law.
#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct LawFile {
    pub reference_length: Option<Positive>,
    pub weibull_modulus: Option<Spanned<f64>>,
    /// The scale: a strain, or a stress.
    pub strain: Option<Spanned<Positive>>,
    pub stress: Option<Spanned<Positive>>,
    /// Makes a strain of the stress.
    pub elastic_modulus: Option<Spanned<Positive>>,
}

impl StrengthFile {
    /// Of all yarns, but for what warp and weft have of their own.
    pub fn law(&self) -> LawFile {
        let StrengthFile { reference_length, weibull_modulus, strain, stress, elastic_modulus, .. } = self.clone();
        LawFile { reference_length, weibull_modulus, strain, stress, elastic_modulus }
    }

    /// The tables of warp and weft.
    pub fn families(&self) -> [&Option<Spanned<LawFile>>; 2] {
        [&self.warp, &self.weft]
    }

    /// The moduli that this table itself gives.
    pub fn elastic_moduli(&self) -> impl Iterator<Item = &Spanned<Positive>> {
        let families = self.families().into_iter().flatten().map(|family| &family.get_ref().elastic_modulus);
        families.chain([&self.elastic_modulus]).flatten()
    }
}

/// Gives warp and weft of this table what it has for all yarns.
pub fn complete_families(table: &mut Spanned<DeValue>) {
    let place = table.span();
    let DeValue::Table(keys) = table.get_mut() else { return };
    let is_of_law = |key: &str| field_names::<LawFile>().contains(&key);
    let law = keys.iter().filter(|(key, _)| is_of_law(key.get_ref()));
    let law: DeTable = law.map(|(key, value)| (key.clone(), value.clone())).collect();
    let law = Spanned::new(place, DeValue::Table(law));
    for family in ["warp", "weft"] {
        if let Some(own) = keys.get_mut(family) {
            *own = layered("strength", [Some(&*own), Some(&law)]).unwrap_or_else(|| own.clone());
        }
    }
}
