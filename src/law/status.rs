//! Status codes and their meanings.
//!
//! 0 is success and a negative number an error. The hundreds say what is wrong: −1xx the call, −2xx the properties,
//! −3xx the point. New codes take numbers that are not in use; no code changes its meaning.

/// Everything went well.
pub const OK: i32 = 0;
/// An argument that must not be null is null.
pub const NULL_ARGUMENT: i32 = -101;
/// A count (of points, components or stress entries) is not one that this function supports.
pub const BAD_COUNT: i32 = -102;
/// The leading dimension of component-major arrays is less than the number of points.
pub const BAD_LEADING_DIMENSION: i32 = -103;
/// A name, index, law, preset or unit system that does not exist.
pub const UNKNOWN_NAME: i32 = -104;
/// A scalar argument (density, option, …) outside what is allowed.
pub const BAD_ARGUMENT: i32 = -105;
/// The host passes no deformation gradient: a small-strain analysis, F = 0, or F not stored where it is read.
pub const NO_DEFORMATION_GRADIENT: i32 = -106;
/// A prepared law that its prepare function has not written, or that of another law or precision.
pub const NOT_PREPARED: i32 = -107;
/// The size of a structure is not set, or is not that of any version of the structure.
pub const BAD_SIZE: i32 = -108;
/// A structure of a newer interface requests what this version of the library does not know.
pub const UNKNOWN_FIELD: i32 = -109;
/// The number of properties differs from that in the table of properties.
pub const PROPERTY_COUNT: i32 = -201;
/// A property is NaN or infinite.
pub const PROPERTY_NOT_FINITE: i32 = -202;
/// A property is outside its bounds.
pub const PROPERTY_OUT_OF_BOUNDS: i32 = -203;
/// A direction among the properties has no length, or is parallel to the one it must differ from.
pub const PROPERTY_DIRECTION: i32 = -204;
/// The fibre direction is neither in the plane of a two-dimensional element nor normal to it.
pub const FIBRE_OUT_OF_PLANE: i32 = -205;
/// There are fewer state variables than the law needs.
pub const STATE_COUNT: i32 = -211;
/// The deformation gradient has a determinant ≤ 0 (or one that underflows), or maps the fibre to zero length: an
/// inverted element.
pub const INVERTED: i32 = -301;
/// The deformation gradient, or the strain increment, has an entry that is NaN or infinite.
pub const NOT_FINITE: i32 = -302;
/// The deformation is too large or too small to evaluate, or a result does not fit the number format.
pub const OVERFLOW: i32 = -303;
/// An old state variable is NaN or infinite.
pub const STATE_NOT_FINITE: i32 = -304;
/// The fibre direction given for this point is zero, NaN or infinite, or along the second axis of the linear elastic
/// law.
pub const FIBRE_DIRECTION: i32 = -305;
/// The step is too large to integrate: a stretch by a factor of ten or more, or a half-turn.
pub const INCREMENT_TOO_LARGE: i32 = -306;
/// The material axes given for this point, for the frame of the spin, are not orthonormal.
pub const MATERIAL_AXES: i32 = -307;

/// The failure limit given for this point is negative, NaN or infinite.
pub const LIMIT: i32 = -308;
/// The law itself cannot evaluate the point, for instance since an iteration does not converge.
pub const LAW: i32 = -309;
/// The law can only evaluate the point in smaller steps.
pub const SMALLER_STEP: i32 = -310;

/// Every code with its name and meaning.
pub const TABLE: [(i32, &str, &str); 26] = [
    (OK, "ok", "no error"),
    (NULL_ARGUMENT, "null_argument", "an argument that must not be null is null"),
    (BAD_COUNT, "bad_count", "a count that this function does not support"),
    (BAD_LEADING_DIMENSION, "bad_leading_dimension", "the leading dimension is less than the number of points"),
    (UNKNOWN_NAME, "unknown_name", "no such name, index, law, preset or unit system"),
    (BAD_ARGUMENT, "bad_argument", "a scalar argument is outside what is allowed"),
    (
        NO_DEFORMATION_GRADIENT,
        "no_deformation_gradient",
        "the host passes no deformation gradient, or it is not where it is read",
    ),
    (NOT_PREPARED, "not_prepared", "the law has not been prepared, or it is another law or precision"),
    (BAD_SIZE, "bad_size", "the size of a structure is not set, or wrong"),
    (UNKNOWN_FIELD, "unknown_field", "a structure requests what this version of the library does not know"),
    (PROPERTY_COUNT, "property_count", "the number of properties differs from the table"),
    (PROPERTY_NOT_FINITE, "property_not_finite", "a property is NaN or infinite"),
    (PROPERTY_OUT_OF_BOUNDS, "property_out_of_bounds", "a property is outside its bounds"),
    (PROPERTY_DIRECTION, "property_direction", "a direction among the properties has no length or is not independent"),
    (
        FIBRE_OUT_OF_PLANE,
        "fibre_out_of_plane",
        "a direction among the properties is neither in the plane of this plane-strain or axisymmetric element nor normal to it",
    ),
    (
        STATE_COUNT,
        "state_count",
        "there are fewer state variables than the law needs (LS-DYNA: NHV is not 11; linear elastic law: 19, law with friction: 15)",
    ),
    (INVERTED, "inverted", "the deformation gradient has a determinant <= 0 or maps the fibre to zero length"),
    (NOT_FINITE, "not_finite", "the deformation has an entry that is NaN or infinite"),
    (
        OVERFLOW,
        "overflow",
        "the deformation is too large or too small to evaluate, or a result does not fit the number format",
    ),
    (STATE_NOT_FINITE, "state_not_finite", "an old state variable is NaN or infinite"),
    (
        FIBRE_DIRECTION,
        "fibre_direction",
        "the fibre direction of this point is zero, NaN or infinite, or along the second axis",
    ),
    (
        INCREMENT_TOO_LARGE,
        "increment_too_large",
        "the step is too large to integrate: a stretch by a factor of ten or a half-turn",
    ),
    (
        MATERIAL_AXES,
        "material_axes",
        "the material axes of this point are not orthonormal: start with the law's own, and keep those that each step returns",
    ),
    (
        LIMIT,
        "limit",
        "the failure limit of this point is negative, NaN or infinite; 0 stands for that of the properties",
    ),
    (LAW, "law", "the law cannot evaluate this point, for a reason of its own"),
    (SMALLER_STEP, "smaller_step", "the law can evaluate this point in smaller steps only"),
];

/// The short name of a status code; `None` if there is no such code.
pub fn name(code: i32) -> Option<&'static str> {
    TABLE.iter().find(|row| row.0 == code).map(|row| row.1)
}

/// The meaning of a status code in a sentence; `None` if there is no such code.
pub fn meaning(code: i32) -> Option<&'static str> {
    TABLE.iter().find(|row| row.0 == code).map(|row| row.2)
}
