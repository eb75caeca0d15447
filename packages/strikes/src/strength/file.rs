//! The table `[scene.strength]` as it stands in the file.

use serde::Deserialize;
use toml::de::{DeTable, DeValue};

use crate::cases::layered;
use toron_shared::checked::Positive;
use toron_shared::field_names::field_names;
use toron_shared::spanned::Spanned;

#[derive(Clone, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct StrengthFile {
    /// Each is another panel. All moduli and scales use the same chances. Default: 1.
    pub seed: Option<u64>,
    /// ℓ, the correlation length, up to the longest yarn's length. Required.
    pub cell: Option<Spanned<f64>>,
    /// L₀, the gauge length of the tests that gave the scale. Required.
    reference_length: Option<Positive>,
    /// m, above 1; the larger, the less scatter. With `inf` nothing scatters. Required.
    weibull_modulus: Option<Spanned<f64>>,
    /// The scale s as a nominal strain, as ε_lim. Default: by `stress`.
    strain: Option<Spanned<Positive>>,
    /// The scale as a stress, with the hyperelastic law beside `elastic-modulus`; with the linear law alone, as σ_lim.
    stress: Option<Spanned<Positive>>,
    /// The modulus by which the stress becomes a strain: 3637 MPa over 79.414 GPa is 4.58 %.
    elastic_modulus: Option<Spanned<Positive>>,
    /// What is otherwise in the warp yarns.
    pub warp: Option<Spanned<LawFile>>,
    /// What is otherwise in the weft yarns.
    pub weft: Option<Spanned<LawFile>>,
}

/// Weibull's law.
#[derive(Clone, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct LawFile {
    /// L₀, the gauge length of the tests that gave the scale.
    pub reference_length: Option<Positive>,
    /// m, above 1; the larger, the less scatter.
    pub weibull_modulus: Option<Spanned<f64>>,
    /// The scale s as a nominal strain, as ε_lim.
    pub strain: Option<Spanned<Positive>>,
    /// The scale as a stress.
    pub stress: Option<Spanned<Positive>>,
    /// The modulus by which the stress becomes a strain.
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
pub fn complete_families(table: &mut toml::Spanned<DeValue>) {
    let place = table.span();
    let DeValue::Table(keys) = table.get_mut() else { return };
    let is_of_law = |key: &str| field_names::<LawFile>().contains(&key);
    let law = keys.iter().filter(|(key, _)| is_of_law(key.get_ref()));
    let law: DeTable = law.map(|(key, value)| (key.clone(), value.clone())).collect();
    let law = toml::Spanned::new(place, DeValue::Table(law));
    for family in ["warp", "weft"] {
        if let Some(own) = keys.get_mut(family) {
            *own = layered("strength", [Some(&*own), Some(&law)]).unwrap_or_else(|| own.clone());
        }
    }
}
