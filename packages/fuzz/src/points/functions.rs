//! The C functions by law and precision.

use std::ffi::c_char;

use toron::host::abaqus::Vumat;
use toron::host::lsdyna::{Umat, UmatVector, Utan, UtanVector};
use toron::host::openradioss::{Group, MaterialCard};
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

    /// LS-DYNA's material of one element.
    ///
    /// # Safety
    /// The arrays are those that the structure promises.
    unsafe fn umat(law: Law, call: &Umat<Self>, message: &mut Message) -> i32;

    /// That of a block of elements.
    ///
    /// # Safety
    /// The arrays are those that the structure promises.
    unsafe fn umat_vector(law: Law, call: &UmatVector<Self>, message: &mut Message) -> i32;

    /// Its tangent of one element.
    ///
    /// # Safety
    /// The arrays are those that the structure promises.
    unsafe fn utan(law: Law, call: &Utan<Self>, message: &mut Message) -> i32;

    /// That of a block of elements.
    ///
    /// # Safety
    /// The arrays are those that the structure promises.
    unsafe fn utan_vector(law: Law, call: &UtanVector<Self>, message: &mut Message) -> i32;

    /// The starter's routine of OpenRadioss.
    ///
    /// # Safety
    /// The arrays are those that the structure promises.
    unsafe fn lecm(card: &MaterialCard<Self>, message: &mut Message) -> i32;

    /// The engine's routine of OpenRadioss.
    ///
    /// # Safety
    /// The arrays are those that the structure promises.
    unsafe fn luser(group: &Group<Self>, message: &mut Message) -> i32;
}

macro_rules! functions {
    ($t:ty, [$($prepare:ident)*], [$($point:ident)*], [$($block:ident)*], [$($point_with:ident)*],
        [$($block_with:ident)*], [$($vumat:ident)*], [$($umat:ident)*], [$($umat_vector:ident)*], [$($utan:ident)*],
        [$($utan_vector:ident)*], $lecm:ident, $luser:ident) => {
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

            unsafe fn umat(law: Law, call: &Umat<$t>, message: &mut Message) -> i32 {
                let (message, capacity) = (message.as_mut_ptr(), message.len());
                let Umat { cm, sig, hsv, nhv, failel } = *call;
                // SAFETY: the caller's arguments.
                unsafe { functions!(law, [$($umat)*], |f| f(cm, sig, hsv, nhv, failel, message, capacity)) }
            }

            unsafe fn umat_vector(law: Law, call: &UmatVector<$t>, message: &mut Message) -> i32 {
                let (message, capacity) = (message.as_mut_ptr(), message.len());
                let UmatVector { cm, sig: [s1, s2, s3, s4, s5, s6], hsvs, nhv, lft, llt, nlq, failels } = *call;
                // SAFETY: the caller's arguments.
                unsafe {
                    functions!(law, [$($umat_vector)*], |f| {
                        f(cm, s1, s2, s3, s4, s5, s6, hsvs, nhv, lft, llt, nlq, failels, message, capacity)
                    })
                }
            }

            unsafe fn utan(law: Law, call: &Utan<$t>, message: &mut Message) -> i32 {
                let (message, capacity) = (message.as_mut_ptr(), message.len());
                let Utan { cm, hsv, nhv, es } = *call;
                // SAFETY: the caller's arguments.
                unsafe { functions!(law, [$($utan)*], |f| f(cm, hsv, nhv, es, message, capacity)) }
            }

            unsafe fn utan_vector(law: Law, call: &UtanVector<$t>, message: &mut Message) -> i32 {
                let (message, capacity) = (message.as_mut_ptr(), message.len());
                let UtanVector { cm, hsvs, nhv, lft, llt, nlq, dsave } = *call;
                // SAFETY: the caller's arguments.
                unsafe {
                    functions!(law, [$($utan_vector)*], |f| f(cm, hsvs, nhv, lft, llt, nlq, dsave, message, capacity))
                }
            }

            unsafe fn lecm(card: &MaterialCard<$t>, message: &mut Message) -> i32 {
                let (message, capacity) = (message.as_mut_ptr(), message.len());
                let MaterialCard { number, values, count, uparam, maxuparam, nuparam, nuvar, parmat } = *card;
                // SAFETY: the caller's arguments.
                unsafe { $lecm(number, values, count, uparam, maxuparam, nuparam, nuvar, parmat, message, capacity) }
            }

            #[rustfmt::skip] // a line for each of the structure's fields
            unsafe fn luser(group: &Group<$t>, message: &mut Message) -> i32 {
                let (message, capacity) = (message.as_mut_ptr(), message.len());
                let Group { elements, parameters, variables, time, uparam, numbers, density, .. } = *group;
                let [xx, yy, zz, xy, yz, zx, yx, zy, xz] = group.deformation_gradient;
                let [s1, s2, s3, s4, s5, s6] = group.stress;
                let [v1, v2, v3, v4, v5, v6] = group.viscous;
                let Group { sound_speed, viscosity, uvar, off, nodes, .. } = *group;
                // SAFETY: the caller's arguments.
                unsafe {
                    $luser(
                        elements, parameters, variables, time, uparam, numbers, density,
                        xx, yy, zz, xy, yz, zx, yx, zy, xz,
                        s1, s2, s3, s4, s5, s6,
                        v1, v2, v3, v4, v5, v6,
                        sound_speed, viscosity, uvar, off, nodes, message, capacity,
                    )
                }
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
    [toron_abaqus_vumat_f64 toron_abaqus_frictional_vumat_f64 toron_abaqus_linear_vumat_f64],
    [toron_lsdyna_umat_f64 toron_lsdyna_frictional_umat_f64 toron_lsdyna_linear_umat_f64],
    [toron_lsdyna_umat_vector_f64 toron_lsdyna_frictional_umat_vector_f64 toron_lsdyna_linear_umat_vector_f64],
    [toron_lsdyna_utan_f64 toron_lsdyna_frictional_utan_f64 toron_lsdyna_linear_utan_f64],
    [toron_lsdyna_utan_vector_f64 toron_lsdyna_frictional_utan_vector_f64 toron_lsdyna_linear_utan_vector_f64],
    toron_openradioss_lecm_f64,
    toron_openradioss_luser_f64
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
    [toron_abaqus_vumat_f32 toron_abaqus_frictional_vumat_f32 toron_abaqus_linear_vumat_f32],
    [toron_lsdyna_umat_f32 toron_lsdyna_frictional_umat_f32 toron_lsdyna_linear_umat_f32],
    [toron_lsdyna_umat_vector_f32 toron_lsdyna_frictional_umat_vector_f32 toron_lsdyna_linear_umat_vector_f32],
    [toron_lsdyna_utan_f32 toron_lsdyna_frictional_utan_f32 toron_lsdyna_linear_utan_f32],
    [toron_lsdyna_utan_vector_f32 toron_lsdyna_frictional_utan_vector_f32 toron_lsdyna_linear_utan_vector_f32],
    toron_openradioss_lecm_f32,
    toron_openradioss_luser_f32
);
