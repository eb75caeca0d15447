//! The table `[scene.strength]` as it stands in the file, and what a case has otherwise.

use serde::Deserialize;
use toml::Spanned;

use toron_shared::toml_file::over;

/// The table as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Flat {
    seed: Option<Spanned<i64>>,
    cell: Option<Spanned<f64>>,
    reference_length: Option<Spanned<f64>>,
    weibull_modulus: Option<Spanned<f64>>,
    strain: Option<Spanned<f64>>,
    stress: Option<Spanned<f64>>,
    elastic_modulus: Option<Spanned<f64>>,
    warp: Option<Spanned<LawFile>>,
    weft: Option<Spanned<LawFile>>,
}

#[derive(Clone, Default, Deserialize)]
#[serde(from = "Flat")]
pub struct StrengthFile {
    pub seed: Option<Spanned<i64>>,
    pub cell: Option<Spanned<f64>>,
    /// Of all yarns, but for what warp and weft have of their own.
    pub law: LawFile,
    /// Warp and weft.
    pub families: [Option<Spanned<LawFile>>; 2],
}

/// Weibull's law.
#[derive(Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct LawFile {
    pub reference_length: Option<Spanned<f64>>,
    pub weibull_modulus: Option<Spanned<f64>>,
    /// The scale: a strain, or a stress.
    pub strain: Option<Spanned<f64>>,
    pub stress: Option<Spanned<f64>>,
    /// Makes a strain of the stress.
    pub elastic_modulus: Option<Spanned<f64>>,
}

impl From<Flat> for StrengthFile {
    fn from(flat: Flat) -> StrengthFile {
        let Flat { seed, cell, reference_length, weibull_modulus, strain, stress, elastic_modulus, warp, weft } = flat;
        let law = LawFile { reference_length, weibull_modulus, strain, stress, elastic_modulus };
        StrengthFile { seed, cell, law, families: [warp, weft] }
    }
}

impl StrengthFile {
    /// This table, with the keys of `base` where it has none.
    pub fn over(&self, base: &StrengthFile) -> StrengthFile {
        let family = |family: usize| over(&self.families[family], &base.families[family], LawFile::over);
        StrengthFile {
            seed: self.seed.clone().or(base.seed.clone()),
            cell: self.cell.clone().or(base.cell.clone()),
            law: self.law.over(&base.law),
            families: [family(0), family(1)],
        }
    }

    /// The moduli that this table itself gives.
    pub fn elastic_moduli(&self) -> impl Iterator<Item = &Spanned<f64>> {
        let families = self.families.iter().flatten().map(Spanned::get_ref);
        std::iter::once(&self.law).chain(families).filter_map(|law| law.elastic_modulus.as_ref())
    }
}

impl LawFile {
    /// This law, with the keys of `base` where it has none; one scale goes before the other, and a strain needs no modulus of another's stress.
    pub fn over(&self, base: &LawFile) -> LawFile {
        let scale = if self.strain.is_some() || self.stress.is_some() { self } else { base };
        let inherited = base.elastic_modulus.clone().filter(|_| scale.strain.is_none());
        LawFile {
            reference_length: self.reference_length.clone().or(base.reference_length.clone()),
            weibull_modulus: self.weibull_modulus.clone().or(base.weibull_modulus.clone()),
            strain: scale.strain.clone(),
            stress: scale.stress.clone(),
            elastic_modulus: self.elastic_modulus.clone().or(inherited),
        }
    }
}
