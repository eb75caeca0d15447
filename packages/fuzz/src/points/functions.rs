//! The C functions by law and precision.

use std::ffi::c_char;

use toron::host::abaqus::Vumat;
use toron_c::*;
use toron_test_support::block::Number;

use super::case::Law;

/// Where a function writes its message.
pub type Message = [c_char; TORON_MESSAGE_CAPACITY];

/// A prepared law: room for that of any law, of which each reads its own.
pub type Prepared = [u64; 64];

/// A structure of arguments.
#[derive(Clone, Copy)]
pub enum Arguments<T> {
    Point(Point<T>),
    LinearPoint(LinearPoint<T>),
    Block(Block<T>),
    LinearBlock(LinearBlock<T>),
}

/// The functions of a precision; each returns the status.
pub trait Functions: Number {
    fn prepare(law: Law, to: &mut Prepared, properties: &[Self], message: &mut Message) -> i32;

    /// # Safety
    /// The arrays are those that the structure promises.
    unsafe fn prepared(law: Law, prepared: &Prepared, arguments: &Arguments<Self>, message: &mut Message) -> i32;

    /// # Safety
    /// The arrays are those that the structure promises.
    unsafe fn with_properties(law: Law, properties: &[Self], arguments: &Arguments<Self>, message: &mut Message)
    -> i32;

    /// # Safety
    /// The arrays are those that the structure promises.
    unsafe fn vumat(law: Law, block: &Vumat<Self>, message: &mut Message) -> i32;
}

macro_rules! functions {
    ($t:ty, [$($prepare:ident)*], [$($point:ident)*], [$($block:ident)*], [$($point_with:ident)*],
        [$($block_with:ident)*], [$($vumat:ident)*]) => {
        impl Functions for $t {
            fn prepare(law: Law, to: &mut Prepared, properties: &[$t], message: &mut Message) -> i32 {
                let (to, size, values, n) = (to.as_mut_ptr(), size_of_val(to), properties.as_ptr(), properties.len());
                let (message, capacity) = (message.as_mut_ptr(), message.len());
                // SAFETY: there is room for any law, and so many properties.
                functions!(law, [$($prepare)*], |f, structure| unsafe {
                    f(to.cast(), structure.min(size), values, n, message, capacity)
                })
            }

            unsafe fn prepared(law: Law, prepared: &Prepared, arguments: &Arguments<$t>, message: &mut Message) -> i32 {
                let (prepared, message, capacity) = (prepared.as_ptr(), message.as_mut_ptr(), message.len());
                // SAFETY: the caller's arguments.
                unsafe {
                    functions!(arguments, law, [$($point)*], [$($block)*], |f, a| {
                        f(prepared.cast(), a, message, capacity)
                    })
                }
            }

            unsafe fn with_properties(
                law: Law,
                properties: &[$t],
                arguments: &Arguments<$t>,
                message: &mut Message,
            ) -> i32 {
                let (values, n) = (properties.as_ptr(), properties.len());
                let (message, capacity) = (message.as_mut_ptr(), message.len());
                // SAFETY: the caller's arguments.
                unsafe {
                    functions!(arguments, law, [$($point_with)*], [$($block_with)*], |f, a| {
                        f(values, n, a, message, capacity)
                    })
                }
            }

            unsafe fn vumat(law: Law, block: &Vumat<$t>, message: &mut Message) -> i32 {
                let (message, capacity) = (message.as_mut_ptr(), message.len());
                // SAFETY: the caller's arguments.
                unsafe { functions!(law, [$($vumat)*], |f| f(block, message, capacity)) }
            }
        }
    };
    ($law:expr, [$hyperelastic:ident $frictional:ident $linear:ident], |$f:ident, $size:ident| $call:expr) => {
        match $law {
            Law::Hyperelastic => { let ($f, $size) = ($hyperelastic, size_of::<HyperelasticLaw<Self>>()); $call }
            Law::Frictional => { let ($f, $size) = ($frictional, size_of::<FrictionalLaw<Self>>()); $call }
            Law::Linear => { let ($f, $size) = ($linear, size_of::<LinearElasticLaw<Self>>()); $call }
        }
    };
    ($law:expr, [$hyperelastic:ident $frictional:ident $linear:ident], |$f:ident| $call:expr) => {
        match $law {
            Law::Hyperelastic => { let $f = $hyperelastic; $call }
            Law::Frictional => { let $f = $frictional; $call }
            Law::Linear => { let $f = $linear; $call }
        }
    };
    ($arguments:expr, $law:expr, [$hp:ident $fp:ident $lp:ident], [$hb:ident $fb:ident $lb:ident],
        |$f:ident, $a:ident| $call:expr) => {
        match ($arguments, $law) {
            (Arguments::Point($a), Law::Hyperelastic) => { let $f = $hp; $call }
            (Arguments::Point($a), _) => { let $f = $fp; $call }
            (Arguments::LinearPoint($a), _) => { let $f = $lp; $call }
            (Arguments::Block($a), Law::Hyperelastic) => { let $f = $hb; $call }
            (Arguments::Block($a), _) => { let $f = $fb; $call }
            (Arguments::LinearBlock($a), _) => { let $f = $lb; $call }
        }
    };
}

functions!(
    f64,
    [toron_hyperelastic_prepare_f64 toron_frictional_prepare_f64 toron_linear_elastic_prepare_f64],
    [toron_hyperelastic_point_f64 toron_frictional_point_f64 toron_linear_elastic_point_f64],
    [toron_hyperelastic_block_f64 toron_frictional_block_f64 toron_linear_elastic_block_f64],
    [toron_hyperelastic_point_with_properties_f64 toron_frictional_point_with_properties_f64
        toron_linear_elastic_point_with_properties_f64],
    [toron_hyperelastic_block_with_properties_f64 toron_frictional_block_with_properties_f64
        toron_linear_elastic_block_with_properties_f64],
    [toron_abaqus_vumat_f64 toron_abaqus_frictional_vumat_f64 toron_abaqus_linear_vumat_f64]
);
functions!(
    f32,
    [toron_hyperelastic_prepare_f32 toron_frictional_prepare_f32 toron_linear_elastic_prepare_f32],
    [toron_hyperelastic_point_f32 toron_frictional_point_f32 toron_linear_elastic_point_f32],
    [toron_hyperelastic_block_f32 toron_frictional_block_f32 toron_linear_elastic_block_f32],
    [toron_hyperelastic_point_with_properties_f32 toron_frictional_point_with_properties_f32
        toron_linear_elastic_point_with_properties_f32],
    [toron_hyperelastic_block_with_properties_f32 toron_frictional_block_with_properties_f32
        toron_linear_elastic_block_with_properties_f32],
    [toron_abaqus_vumat_f32 toron_abaqus_frictional_vumat_f32 toron_abaqus_linear_vumat_f32]
);
