//! Laws prepared once, in the caller's memory: what C sees of them.

use toron::host::prepared::PreparedLaw;
use toron::law::prepared::{PreparedFrictional, PreparedHyperelastic, PreparedLinearElastic};
use toron::{Frictional, Hyperelastic, LinearElastic};

/// The hyperelastic law, prepared by `toron_hyperelastic_prepare_f64` or `_f32`: numbers only, without a pointer. It
/// may be copied, shared by threads and sent to other processes of the same byte order, and needs no release. Its
/// content is the library's own; its size is the same in all versions of this interface.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct HyperelasticLaw<T> {
    /// Tells law, precision and layout; the size of the structure; the library's own numbers.
    pub tag: u64,
    pub size: u64,
    pub values: [T; 62],
}

/// The law with friction, prepared by `toron_frictional_prepare_f64` or `_f32`; as `toron_hyperelastic_f64` else.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct FrictionalLaw<T> {
    /// Tells law, precision and layout; the size of the structure; the library's own numbers.
    pub tag: u64,
    pub size: u64,
    pub values: [T; 62],
}

/// The linear elastic law, prepared by `toron_linear_elastic_prepare_f64` or `_f32`; as `toron_hyperelastic_f64` else.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct LinearElasticLaw<T> {
    /// Tells law, precision and layout; the size of the structure; the library's own numbers.
    pub tag: u64,
    pub size: u64,
    pub values: [T; 30],
}

macro_rules! prepared_laws {
    ($($structure:ident, $t:ty, $numbers:ident, $law:path, $tag:literal, $name:literal, $by:literal;)*) => {$(
        const _: () = assert!(size_of::<$structure<$t>>() >= 16 + size_of::<$numbers<$t>>() + 8);
        const _: () = assert!(size_of::<$structure<$t>>().is_multiple_of(8));
        // SAFETY: its values are more than the numbers, which are as many values.
        unsafe impl PreparedLaw<$t> for $structure<$t> {
            type Law = $law;
            const TAG: u64 = u64::from_le_bytes(*$tag);
            const NAME: &'static str = $name;
            const PREPARED_BY: &'static str = $by;
        }
    )*};
}

prepared_laws! {
    HyperelasticLaw, f64, PreparedHyperelastic, Hyperelastic<f64>, b"HE-f64-1", "toron_hyperelastic_f64",
        "toron_hyperelastic_prepare_f64";
    HyperelasticLaw, f32, PreparedHyperelastic, Hyperelastic<f32>, b"HE-f32-1", "toron_hyperelastic_f32",
        "toron_hyperelastic_prepare_f32";
    FrictionalLaw, f64, PreparedFrictional, Frictional<f64>, b"FR-f64-1", "toron_frictional_f64",
        "toron_frictional_prepare_f64";
    FrictionalLaw, f32, PreparedFrictional, Frictional<f32>, b"FR-f32-1", "toron_frictional_f32",
        "toron_frictional_prepare_f32";
    LinearElasticLaw, f64, PreparedLinearElastic, LinearElastic<f64>, b"LE-f64-1", "toron_linear_elastic_f64",
        "toron_linear_elastic_prepare_f64";
    LinearElasticLaw, f32, PreparedLinearElastic, LinearElastic<f32>, b"LE-f32-1", "toron_linear_elastic_f32",
        "toron_linear_elastic_prepare_f32";
}
