//! The strength of a scene's yarns from its table. `docs/reference/fabric-files.md` has the keys.

use std::ops::Range;

use super::field::Field;
use super::file::{LawFile, StrengthFile};
use super::scatter::Strength;
use super::weibull::Weibull;
use crate::scene_keys::keys::Reader;
use toron_materials::material::of_law::LawName;
use toron_shared::checked::{Checked, Positive, value};
use toron_shared::error::Error;
use toron_shared::numbers::number;
use toron_shared::spanned::Spanned;

/// The seed where the file gives none.
const SEED: u64 = 1;
/// Cells of all yarns that a memory has room for.
const MOST_CELLS: f64 = 1e7;

impl Reader<'_> {
    /// The table of the case's strength, where something may fail.
    pub fn strength_table(&self) -> Option<&Spanned<StrengthFile>> {
        self.keys.strength.as_ref().filter(|_| self.keys.fails())
    }

    /// The strength of yarns of these lengths.
    ///
    /// # Errors
    /// An input error that names file, line, value and what is allowed.
    pub fn strength(
        &self,
        table: &Spanned<StrengthFile>,
        lengths: impl Iterator<Item = f64>,
    ) -> Result<Strength, Error> {
        let (span, file) = (table.span(), table.get_ref());
        if self.keys.law() == LawName::Hybrid {
            let message = "strength with law = \"hybrid\"; allowed: hyperelastic, linear-elastic, frictional";
            return Err(self.source.error(span, message));
        }
        let seed = file.seed.unwrap_or(SEED);
        let cell = self.cell(file, &span, lengths)?;
        let law = |family: &Option<Spanned<LawFile>>| match family {
            None => self.weibull(&file.law(), &span),
            Some(family) => self.weibull(family.get_ref(), &family.span()),
        };
        let [warp, weft] = file.families().map(law);
        Ok(Strength { field: Field { seed, cell }, laws: [warp?, weft?] })
    }

    /// The cells' length.
    fn cell(&self, file: &StrengthFile, span: &Range<usize>, lengths: impl Iterator<Item = f64>) -> Result<f64, Error> {
        let (longest, all) = lengths.fold((0.0_f64, 0.0), |(longest, all), length| (longest.max(length), all + length));
        let wanted = |cell: &str| {
            format!(
                "{cell}; allowed: the length over which the strength of a yarn is one, a number > 0 up to that of the longest \
                 yarn, {}",
                number(longest)
            )
        };
        let Some(given) = &file.cell else { return Err(self.source.error(span.clone(), &wanted("cell is missing"))) };
        let cell = *given.get_ref();
        if !(cell > 0.0 && cell <= longest) {
            return Err(self.source.error(given.span(), &wanted(&format!("cell is {cell}"))));
        }
        if all / cell > MOST_CELLS {
            let least = number(all / MOST_CELLS);
            let message =
                format!("cell is {cell}, of which the yarns have {:.0e}; allowed: {least} or more", all / cell);
            return Err(self.source.error(given.span(), &message));
        }
        Ok(cell)
    }

    fn weibull(&self, file: &LawFile, span: &Range<usize>) -> Result<Weibull, Error> {
        let missing = |message: &str| self.source.error(span.clone(), message);
        let wanted = "a number > 1, or inf, with which nothing scatters";
        let Some(given) = &file.weibull_modulus else {
            return Err(missing(&format!("weibull-modulus is missing; allowed: {wanted}")));
        };
        let modulus = *given.get_ref();
        if modulus.is_nan() || modulus <= 1.0 {
            let message = format!(
                "weibull-modulus is {modulus}; allowed: {wanted} (one up to 1 is of no yarn: the weakest would be the most \
                 frequent ones; the smaller, the more scatter)"
            );
            return Err(self.source.error(given.span(), &message));
        }
        let wanted = "reference-length is missing; allowed: the length that the scale is of, a finite number > 0";
        Ok(Weibull {
            modulus,
            scale: self.scale(file, span)?,
            reference_length: value(&file.reference_length).ok_or_else(|| missing(wanted))?,
        })
    }

    /// Whether the case's own table gives this modulus, and not the scene's, whose other cases may have another law.
    fn is_of_case(&self, modulus: &Spanned<Positive>) -> bool {
        let own = self.case_keys.strength.as_ref().map(Spanned::get_ref);
        own.is_some_and(|own| own.elastic_moduli().any(|given| given.span() == modulus.span()))
    }

    /// The scale by what the case's law fails at.
    fn scale(&self, file: &LawFile, span: &Range<usize>) -> Result<f64, Error> {
        let linear = self.keys.law() == LawName::LinearElastic;
        let modulus = file.elastic_modulus.as_ref();
        match (&file.strain, &file.stress) {
            (Some(strain), None) if linear => {
                let message = "strain with the linear elastic law, which fails at a stress; allowed: stress";
                Err(self.source.error(strain.span(), message))
            }
            (None, Some(stress)) if linear => match modulus.filter(|modulus| self.is_of_case(modulus)) {
                None => Ok(stress.value()),
                Some(modulus) => {
                    let message = "elastic-modulus with the linear elastic law, which fails at the stress itself; allowed: stress alone";
                    Err(self.source.error(modulus.span(), message))
                }
            },
            (Some(strain), None) => {
                let value = strain.value();
                if value > 1.0 {
                    let message = format!("strain is {value}; allowed: a number > 0 up to 1 (4.58 % is 0.0458)");
                    return Err(self.source.error(strain.span(), &message));
                }
                if let Some(modulus) = modulus {
                    let message = "elastic-modulus beside strain; allowed: beside stress";
                    return Err(self.source.error(modulus.span(), message));
                }
                Ok(value)
            }
            (None, Some(stress)) => {
                let Some(modulus) = modulus else {
                    let message = "stress without elastic-modulus; allowed: strain, or stress and the modulus that makes a strain of it: \
                                   3637 MPa of Kevlar KM2 is 79 414 MPa times 4.58 %, at which this law's nominal stress is 3526 MPa";
                    return Err(self.source.error(stress.span(), message));
                };
                let [value, by] = [stress.value(), modulus.value()];
                if value > by {
                    let message = format!("stress is {value}; allowed: up to elastic-modulus, {by}, a strain of 1");
                    return Err(self.source.error(stress.span(), &message));
                }
                Ok(value / by)
            }
            (Some(strain), Some(_)) => Err(self.source.error(strain.span(), "strain and stress; allowed: one of them")),
            (None, None) => {
                let allowed = if linear { "stress" } else { "strain, or stress and elastic-modulus" };
                let message = format!("the scale of the strength is missing; allowed: {allowed}");
                Err(self.source.error(span.clone(), &message))
            }
        }
    }
}
