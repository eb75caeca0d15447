//! The C entries that there are in both precisions.

use std::ffi::c_char;

use super::own_block::PrepareBlock;
use crate::material::own_law::OwnLaw;
use toron::Hyperelastic;
use toron::host::abaqus::ExplicitLaw;
use toron::host::lsdyna::UserRoutines;
use toron::host::{abaqus, lsdyna, openradioss};
use toron_c::{Block, FrictionalLaw, HyperelasticLaw, LinearBlock, LinearElasticLaw, Point};

/// Rounding to the precision of an entry.
pub trait FromF64 {
    fn from_f64(x: f64) -> Self;
}

impl FromF64 for f64 {
    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        x
    }
}

impl FromF64 for f32 {
    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        x as f32
    }
}

/// A precision of the entries that there are in both.
pub trait BlockPrecision: openradioss::MyReal + Default + FromF64 + Send + Sync + 'static {
    const PREPARE: PrepareEntry<HyperelasticLaw<Self>, Self>;
    const PREPARE_LINEAR: PrepareEntry<LinearElasticLaw<Self>, Self>;
    const PREPARE_FRICTIONAL: PrepareEntry<FrictionalLaw<Self>, Self>;
    const BLOCK: PreparedEntry<HyperelasticLaw<Self>, Block<Self>>;
    const BLOCK_WITH_PROPERTIES: PropertiesEntry<Self, Block<Self>>;
    const LINEAR_BLOCK: PreparedEntry<LinearElasticLaw<Self>, LinearBlock<Self>>;
    const FRICTIONAL_BLOCK: PreparedEntry<FrictionalLaw<Self>, Block<Self>>;
    const FRICTIONAL_POINT: PreparedEntry<FrictionalLaw<Self>, Point<Self>>;
    const FRICTIONAL_POINT_WITH_PROPERTIES: PropertiesEntry<Self, Point<Self>>;
    const POINT: PreparedEntry<HyperelasticLaw<Self>, Point<Self>>;
    const POINT_WITH_PROPERTIES: PropertiesEntry<Self, Point<Self>>;
    const VUMAT: VumatEntry<Self>;
    const LSDYNA: Routine<lsdyna::Umat<Self>>;
    const LSDYNA_VECTOR: Routine<lsdyna::UmatVector<Self>>;
    const OPENRADIOSS: OpenradiossEntry<Self>;
    /// What prepares a law that is known by its description alone.
    fn own(law: &OwnLaw) -> PrepareBlock<Self>;
}

/// An entry that prepares a law, one that takes it, and one that takes the properties; the last two arguments are for a
/// message.
pub type PrepareEntry<L, T> = unsafe extern "C" fn(*mut L, usize, *const T, usize, *mut c_char, usize) -> i32;
pub type PreparedEntry<L, S> = unsafe extern "C" fn(*const L, *const S, *mut c_char, usize) -> i32;
pub type PropertiesEntry<T, S> = unsafe extern "C" fn(*const T, usize, *const S, *mut c_char, usize) -> i32;
pub type OpenradiossEntry<T> = unsafe fn(&openradioss::Group<T>, *mut c_char, usize) -> i32;
pub type VumatEntry<T> = unsafe fn(*const abaqus::Vumat<T>, *mut c_char, usize) -> i32;
/// A routine of a solver, whose arguments are a structure.
pub type Routine<S> = unsafe fn(&S, *mut c_char, usize) -> i32;

impl BlockPrecision for f64 {
    const PREPARE: PrepareEntry<HyperelasticLaw<f64>, f64> = toron_c::toron_hyperelastic_prepare_f64;
    const PREPARE_LINEAR: PrepareEntry<LinearElasticLaw<f64>, f64> = toron_c::toron_linear_elastic_prepare_f64;
    const PREPARE_FRICTIONAL: PrepareEntry<FrictionalLaw<f64>, f64> = toron_c::toron_frictional_prepare_f64;
    const BLOCK: PreparedEntry<HyperelasticLaw<f64>, Block<f64>> = toron_c::toron_hyperelastic_block_f64;
    const BLOCK_WITH_PROPERTIES: PropertiesEntry<f64, Block<f64>> =
        toron_c::toron_hyperelastic_block_with_properties_f64;
    const LINEAR_BLOCK: PreparedEntry<LinearElasticLaw<f64>, LinearBlock<f64>> =
        toron_c::toron_linear_elastic_block_f64;
    const FRICTIONAL_BLOCK: PreparedEntry<FrictionalLaw<f64>, Block<f64>> = toron_c::toron_frictional_block_f64;
    const FRICTIONAL_POINT: PreparedEntry<FrictionalLaw<f64>, Point<f64>> = toron_c::toron_frictional_point_f64;
    const FRICTIONAL_POINT_WITH_PROPERTIES: PropertiesEntry<f64, Point<f64>> =
        toron_c::toron_frictional_point_with_properties_f64;
    const POINT: PreparedEntry<HyperelasticLaw<f64>, Point<f64>> = toron_c::toron_hyperelastic_point_f64;
    const POINT_WITH_PROPERTIES: PropertiesEntry<f64, Point<f64>> =
        toron_c::toron_hyperelastic_point_with_properties_f64;
    const VUMAT: VumatEntry<f64> = <Hyperelastic<f64>>::vumat;
    const LSDYNA: Routine<lsdyna::Umat<f64>> = <Hyperelastic<f64>>::umat;
    const LSDYNA_VECTOR: Routine<lsdyna::UmatVector<f64>> = <Hyperelastic<f64>>::umat_vector;
    const OPENRADIOSS: OpenradiossEntry<f64> = openradioss::group_f64;

    fn own(law: &OwnLaw) -> PrepareBlock<f64> {
        law.blocks.0
    }
}

impl BlockPrecision for f32 {
    const PREPARE: PrepareEntry<HyperelasticLaw<f32>, f32> = toron_c::toron_hyperelastic_prepare_f32;
    const PREPARE_LINEAR: PrepareEntry<LinearElasticLaw<f32>, f32> = toron_c::toron_linear_elastic_prepare_f32;
    const PREPARE_FRICTIONAL: PrepareEntry<FrictionalLaw<f32>, f32> = toron_c::toron_frictional_prepare_f32;
    const BLOCK: PreparedEntry<HyperelasticLaw<f32>, Block<f32>> = toron_c::toron_hyperelastic_block_f32;
    const BLOCK_WITH_PROPERTIES: PropertiesEntry<f32, Block<f32>> =
        toron_c::toron_hyperelastic_block_with_properties_f32;
    const LINEAR_BLOCK: PreparedEntry<LinearElasticLaw<f32>, LinearBlock<f32>> =
        toron_c::toron_linear_elastic_block_f32;
    const FRICTIONAL_BLOCK: PreparedEntry<FrictionalLaw<f32>, Block<f32>> = toron_c::toron_frictional_block_f32;
    const FRICTIONAL_POINT: PreparedEntry<FrictionalLaw<f32>, Point<f32>> = toron_c::toron_frictional_point_f32;
    const FRICTIONAL_POINT_WITH_PROPERTIES: PropertiesEntry<f32, Point<f32>> =
        toron_c::toron_frictional_point_with_properties_f32;
    const POINT: PreparedEntry<HyperelasticLaw<f32>, Point<f32>> = toron_c::toron_hyperelastic_point_f32;
    const POINT_WITH_PROPERTIES: PropertiesEntry<f32, Point<f32>> =
        toron_c::toron_hyperelastic_point_with_properties_f32;
    const VUMAT: VumatEntry<f32> = <Hyperelastic<f32>>::vumat;
    const LSDYNA: Routine<lsdyna::Umat<f32>> = <Hyperelastic<f32>>::umat;
    const LSDYNA_VECTOR: Routine<lsdyna::UmatVector<f32>> = <Hyperelastic<f32>>::umat_vector;
    const OPENRADIOSS: OpenradiossEntry<f32> = openradioss::group_f32;

    fn own(law: &OwnLaw) -> PrepareBlock<f32> {
        law.blocks.1
    }
}
