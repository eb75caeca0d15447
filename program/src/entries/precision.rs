//! The C entries that there are in both precisions.

use std::ffi::c_int;

use toron::host::c::{self, Block, LinearBlock};
use toron::host::{abaqus, lsdyna};

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
pub trait BlockPrecision: Copy + Default + Into<f64> + FromF64 + Send + Sync + 'static {
    const ENTRY: unsafe extern "C" fn(*const Self, usize, *const Block<Self>) -> i32;
    const LINEAR_ENTRY: LinearBlockEntry<Self>;
    const POINT: PointEntry<Self>;
    const POINT_TANGENT: PointTangentEntry<Self>;
    const VUMAT: unsafe extern "C" fn(*const abaqus::Vumat<Self>) -> i32;
    const LSDYNA: unsafe extern "C" fn(*const Self, *mut Self, *mut Self, i32, *mut c_int) -> i32;
    const LSDYNA_VECTOR: LsdynaVectorEntry<Self>;
}

pub type LinearBlockEntry<T> = unsafe extern "C" fn(*const T, usize, *const LinearBlock<T>, i32, i32) -> i32;
pub type PointEntry<T> =
    unsafe extern "C" fn(*const T, usize, *const T, *const T, *const T, *mut T, *mut T, *mut T, T, *mut T) -> i32;
pub type PointTangentEntry<T> =
    unsafe extern "C" fn(*const T, usize, *const T, *const T, *const T, *mut T, *mut T, i32, *mut T) -> i32;
pub type LsdynaVectorEntry<T> = unsafe extern "C" fn(
    *const T,
    *mut T,
    *mut T,
    *mut T,
    *mut T,
    *mut T,
    *mut T,
    *mut T,
    i32,
    i32,
    i32,
    i32,
    *mut c_int,
) -> i32;

impl BlockPrecision for f64 {
    const ENTRY: unsafe extern "C" fn(*const f64, usize, *const Block<f64>) -> i32 = c::hyperelastic_block_f64;
    const LINEAR_ENTRY: LinearBlockEntry<f64> = c::linear_elastic_block_f64;
    const POINT: PointEntry<f64> = c::hyperelastic_point_f64;
    const POINT_TANGENT: PointTangentEntry<f64> = c::hyperelastic_point_tangent_f64;
    const VUMAT: unsafe extern "C" fn(*const abaqus::Vumat<f64>) -> i32 = abaqus::vumat_f64;
    const LSDYNA: unsafe extern "C" fn(*const f64, *mut f64, *mut f64, i32, *mut c_int) -> i32 = lsdyna::umat_f64;
    const LSDYNA_VECTOR: LsdynaVectorEntry<f64> = lsdyna::umat_vector_f64;
}

impl BlockPrecision for f32 {
    const ENTRY: unsafe extern "C" fn(*const f32, usize, *const Block<f32>) -> i32 = c::hyperelastic_block_f32;
    const LINEAR_ENTRY: LinearBlockEntry<f32> = c::linear_elastic_block_f32;
    const POINT: PointEntry<f32> = c::hyperelastic_point_f32;
    const POINT_TANGENT: PointTangentEntry<f32> = c::hyperelastic_point_tangent_f32;
    const VUMAT: unsafe extern "C" fn(*const abaqus::Vumat<f32>) -> i32 = abaqus::vumat_f32;
    const LSDYNA: unsafe extern "C" fn(*const f32, *mut f32, *mut f32, i32, *mut c_int) -> i32 = lsdyna::umat_f32;
    const LSDYNA_VECTOR: LsdynaVectorEntry<f32> = lsdyna::umat_vector_f32;
}
