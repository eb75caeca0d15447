//! C: for a law of the name `NAME` its tables, `NAME_prepare_f64` and `NAME_block_f64` or `_f32`; and the header with
//! their prototypes.

use std::path::Path;
use std::{fs, io};

use toron::host::Material;
use toron::host::constants::TORON_MESSAGE_CAPACITY;
use toron::host::listed::prepared_size;
use toron::host::prepared::AsNumbers;
use toron::law::interface::Law;
use toron::law::status;

// What stands beside `$law` may hide the user's names: a macro brings no name but those of functions, and one that no
// law has.
#[doc(hidden)]
#[macro_export]
macro_rules! c {
    ($t:ident; $($law:ty as $name:literal, user $number:literal;)+) => {$(
        const _: () = {
            #[allow(non_camel_case_types)]
            #[derive(Clone, Copy)]
            pub struct __toron_listed;

            impl $crate::toron::host::listed::Named<$t> for __toron_listed {
                type Law = <$law as $crate::toron::host::Material<$t>>::Law;
                const PREPARED: &'static str = concat!($name, "_", stringify!($t));
                const PREPARE: &'static str = concat!($name, "_prepare_", stringify!($t));
                const POINTS: &'static str = concat!($name, "_points_", stringify!($t));
            }

            static DESCRIPTION: $crate::toron::law::description::Description = <<$law as $crate::toron::host::Material<$t>>::Law as $crate::toron::law::interface::Law<$t>>::DESCRIPTION;

            // SAFETY of each: what the header asks of the caller.
            #[unsafe(export_name = concat!($name, "_prepare_", stringify!($t)))]
            pub unsafe extern "C" fn prepare_law(
                law: *mut $crate::toron::host::listed::PreparedOf<__toron_listed, $t>,
                size: usize,
                properties: *const $t,
                count: usize,
                message: *mut ::core::ffi::c_char,
                capacity: usize,
            ) -> i32 {
                unsafe {
                    $crate::toron::host::listed::prepare::<__toron_listed, $t>(
                        law, size, properties, count, message, capacity,
                    )
                }
            }

            #[unsafe(export_name = concat!($name, "_block_", stringify!($t)))]
            pub unsafe extern "C" fn evaluate_block(
                law: *const $crate::toron::host::listed::PreparedOf<__toron_listed, $t>,
                points: *const $crate::toron::host::listed::ListedPoints<__toron_listed, $t>,
                message: *mut ::core::ffi::c_char,
                capacity: usize,
            ) -> i32 {
                unsafe { $crate::toron::host::listed::block::<__toron_listed, $t>(law, points, message, capacity) }
            }

            #[unsafe(export_name = concat!($name, "_property_count"))]
            pub extern "C" fn property_count() -> i32 {
                DESCRIPTION.properties.len() as i32
            }

            #[unsafe(export_name = concat!($name, "_property"))]
            pub unsafe extern "C" fn property(
                index: i32,
                row: *mut $crate::toron::host::tables::TableRow,
                message: *mut ::core::ffi::c_char,
                capacity: usize,
            ) -> i32 {
                unsafe { $crate::toron::host::listed::property(&DESCRIPTION, index, row, message, capacity) }
            }

            #[unsafe(export_name = concat!($name, "_state_count"))]
            pub extern "C" fn state_count() -> i32 {
                DESCRIPTION.state.len() as i32
            }

            #[unsafe(export_name = concat!($name, "_state_variable"))]
            pub unsafe extern "C" fn state_variable(
                index: i32,
                row: *mut $crate::toron::host::tables::TableRow,
                message: *mut ::core::ffi::c_char,
                capacity: usize,
            ) -> i32 {
                unsafe { $crate::toron::host::listed::state_variable(&DESCRIPTION, index, row, message, capacity) }
            }

            #[unsafe(export_name = concat!($name, "_status_message"))]
            pub unsafe extern "C" fn message_of_status(
                code: i32,
                message: *mut ::core::ffi::c_char,
                capacity: usize,
            ) -> i32 {
                unsafe { $crate::toron::host::entry_points::status_message(code, message, capacity) }
            }
        };
    )+};
}

/// Writes the [header](c_header) of a law in C to a file, unless it is there already: for the build script of the law's
/// library.
///
/// ```no_run
/// toron_solvers::write_header::<toron::Hyperelastic>("YARN", "../yarn.h").expect("the folder can be written");
/// ```
///
/// # Errors
/// The file cannot be written.
pub fn write_header<M>(name: &str, file: impl AsRef<Path>) -> io::Result<()>
where
    M: Material<f64> + Material<f32>,
    <M as Material<f64>>::Law: AsNumbers<f64>,
    <M as Material<f32>>::Law: AsNumbers<f32>,
{
    let (file, header) = (file.as_ref(), c_header::<M>(name));
    // Cargo runs the script again when the file has gone or is another one.
    println!("cargo::rerun-if-changed={}", file.display());
    if fs::read_to_string(file).is_ok_and(|there| there == header) {
        return Ok(());
    }
    fs::write(file, header)
}

/// The header of a law in C, from its tables: what a library exports that has the law under this name, in either
/// precision.
pub fn c_header<M>(name: &str) -> String
where
    M: Material<f64> + Material<f32>,
    <M as Material<f64>>::Law: AsNumbers<f64>,
    <M as Material<f32>>::Law: AsNumbers<f32>,
{
    let law = <<M as Material<f64>>::Law as Law<f64>>::DESCRIPTION;
    let properties = law.properties.iter().zip(0..).map(|(row, i)| {
        let default = row.default.map_or_else(String::new, |value| format!(", default {value}"));
        (row.name, i, format!("{} ({}): {}{default}", row.meaning, row.dimension.name, row.allowed))
    });
    let state = law.state.iter().zip(0..).map(|(row, i)| {
        let comment = format!("{} ({})", row.meaning, row.dimension.name);
        (row.name, i, comment)
    });
    let of_solvers = [status::NO_DEFORMATION_GRADIENT, status::FIBRE_OUT_OF_PLANE, status::STATE_COUNT];
    let codes = status::TABLE.iter().filter(|row| !of_solvers.contains(&row.0));
    let codes = codes.map(|&(code, word, meaning)| (word, code, meaning.to_string()));
    let enumeration = |kind: &str, rows: &mut dyn Iterator<Item = (&str, i32, String)>| -> String {
        let row = |(word, value, comment): (&str, i32, String)| {
            format!("    /* {comment} */\n    {name}_{kind}_{} = {value},\n", word.to_uppercase())
        };
        rows.map(row).collect()
    };
    let (properties, state, codes) = (
        enumeration("PROPERTY", &mut { properties }),
        enumeration("STATE", &mut { state }),
        enumeration("STATUS", &mut { codes }),
    );
    let fibre = match law.has_fibre() {
        true => "In, 3 components: the fibre direction of each point, of any length; null: that of the properties.",
        false => "Null: this law has no fibre.",
    };
    let read = |reads: bool, is_read: &'static str| if reads { is_read } else { "Not read by this law." };
    let f_old = read(law.reads.old_gradient, "Must not be null.");
    let time_increment = read(law.reads.time_increment, "Finite, not negative.");
    let time = read(law.reads.time, "Finite.");
    let temperature = read(law.reads.temperature, "Must not be null.");
    let [n_properties, n_state, capacity] =
        [law.properties.len(), law.state.len(), TORON_MESSAGE_CAPACITY].map(|count| count.to_string());
    let mut header = BEGINNING.replace("{name}", name).replace("{title}", law.title).replace("{capacity}", &capacity);
    header = header.replace("{n_properties}", &n_properties).replace("{n_state}", &n_state);
    header = header.replace("{properties}", &properties).replace("{state}", &state).replace("{codes}", &codes);
    let precisions = [
        ("f64", "double", prepared_size::<f64, <M as Material<f64>>::Law>(), 8),
        ("f32", "float", prepared_size::<f32, <M as Material<f32>>::Law>(), 4),
    ];
    for (suffix, real, size, width) in precisions {
        let part = PRECISION.replace("{name}", name).replace("{suffix}", suffix).replace("{real}", real);
        let values = (size - 2 * size_of::<u64>()) / width;
        let part = part.replace("{values}", &values.to_string()).replace("{fibre}", fibre).replace("{f_old}", f_old);
        let part = part.replace("{time_increment}", time_increment).replace("{time}", time);
        header += &part.replace("{temperature}", temperature).replace("{n_state}", &n_state);
    }
    header + END
}

/// What stands in braces is replaced.
const BEGINNING: &str = "\
/* The {title} in C. Written by toron_solvers::c_header from the law's tables: do not edit.
 *
 * A library may have the functions of one precision only. Every function may be called from any thread at any time. The last two
 * arguments are for a message, {name}_MESSAGE_CAPACITY bytes are enough, or null and 0; it is written only if there is an error. The
 * status returned is 0 or the worst of the codes below; where the call itself is wrong (-1xx, -2xx) nothing else is written. */
#ifndef {name}_H
#define {name}_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern \"C\" {
#endif

/* Indices of the properties, and their number. */
enum {
{properties}    {name}_PROPERTIES = {n_properties}
};

/* Indices of the state variables, all 0 at the start, and their number. */
enum {
{state}    {name}_STATE = {n_state}
};

/* Status codes: what is wrong with the call (-1xx), the properties (-2xx), a point (-3xx). */
enum {
{codes}    /* room for any message */
    {name}_MESSAGE_CAPACITY = {capacity}
};

/* Tangents: dS/dE (6 x 6); for the Truesdell rate; for the Jaumann rate of the Kirchhoff stress, over J, as Abaqus's DDSDDE;
 * dP/dF (9 x 9). */
enum {
    {name}_TANGENT_MATERIAL = 0,
    {name}_TANGENT_TRUESDELL = 1,
    {name}_TANGENT_JAUMANN = 2,
    {name}_TANGENT_NOMINAL = 3
};

/* Instructions: the best that the processor has, or at most these. */
enum {
    {name}_LEVEL_BEST = 0,
    {name}_LEVEL_BASELINE = 1,
    {name}_LEVEL_AVX2 = 2,
    {name}_LEVEL_AVX512 = 3
};

/* A row of the tables. Set `size`; the rest is written. Texts are null-terminated UTF-8. */
typedef struct {name}_table_row {
    size_t size;
    char name[24], symbol[24];
    /* \"stress\", \"energy/volume\", \"-\"; then exponents of mass, length and time */
    char unit[24];
    int32_t mass, length, time;
    int32_t has_default;
    double default_value;
    double minimum, maximum;
    int32_t minimum_excluded;
    char allowed[80], meaning[100];
} {name}_table_row;

int32_t {name}_property_count(void);
int32_t {name}_property(int32_t index, {name}_table_row *row, char *message, size_t capacity);
int32_t {name}_state_count(void);
int32_t {name}_state_variable(int32_t index, {name}_table_row *row, char *message, size_t capacity);
/* The meaning of a status code. */
int32_t {name}_status_message(int32_t status, char *message, size_t capacity);
";

const PRECISION: &str = "
/* The law, prepared: numbers only, which may be copied and shared by threads, and need no release. */
typedef struct {name}_{suffix} {
    uint64_t tag, size;
    {real} values[{values}];
} {name}_{suffix};

/* Checks {name}_PROPERTIES properties and prepares the law; `size` is sizeof *law, `count` the number of properties. */
int32_t {name}_prepare_{suffix}({name}_{suffix} *law, size_t size, const {real} *properties, size_t count, char *message,
    size_t capacity);

/* Points. Set `size`, `n`, and what is wanted; the rest is 0: an array that is null is left out, and an output that is left out is not
 * computed. Component c of point i is at c * leading_dimension + i. Arrays of pointers have one for each component; where only the
 * first is set, the others follow by the leading dimension. Old and new state may be the same array; else arrays must not overlap. */
typedef struct {name}_points_{suffix} {
    /* sizeof this structure */
    size_t size;
    /* the number of points */
    size_t n;
    /* 0: n */
    size_t leading_dimension;
    /* one of {name}_TANGENT_..., read if there is a tangent */
    int32_t measure;
    /* one of {name}_LEVEL_... */
    int32_t level;
    /* reference density, read if there is a wave speed */
    double density;
    /* In: F at the start of the step, by columns. {f_old} */
    const {real} *f_old[9];
    /* In: F at its end, by columns. Must not be null. */
    const {real} *f_new[9];
    /* {fibre} */
    const {real} *fibre[3];
    /* In, {n_state} components: the old state; null: all 0. */
    const {real} *state_old;
    /* Out, {n_state} components: the new state. */
    {real} *state_new;
    /* Out: Cauchy stress 11 22 33 12 23 31. */
    {real} *stress[6];
    /* Out, 36 or 81 components: entry (row, column) is 6 row + column or 9 row + column. */
    {real} *tangent;
    /* Out: a bound of the speed of every wave. */
    {real} *wave_speed;
    /* Out: 1, or 0 where the point has failed or cannot be evaluated. */
    {real} *active;
    /* Out: a status code for each point. */
    int32_t *status;
    /* In: the length of the step. {time_increment} */
    double time_increment;
    /* In: the time at its end. {time} */
    double time;
    /* In: the temperature of each point at the end of the step. {temperature} */
    const {real} *temperature;
} {name}_points_{suffix};

int32_t {name}_block_{suffix}(const {name}_{suffix} *law, const {name}_points_{suffix} *points, char *message, size_t capacity);
";

const END: &str = "
#ifdef __cplusplus
}
#endif

#endif
";
