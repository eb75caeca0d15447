/* The standard reinforcing model in C. Written by toron_solvers::c_header from the law's tables: do not edit.
 *
 * A library may have the functions of one precision only. Every function may be called from any thread at any time. The last two
 * arguments are for a message, REINFORCED_MESSAGE_CAPACITY bytes are enough, or null and 0; it is written only if there is an error. The
 * status returned is 0 or the worst of the codes below; where the call itself is wrong (-1xx, -2xx) nothing else is written. */
#ifndef REINFORCED_H
#define REINFORCED_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Indices of the properties, and their number. */
enum {
    /* shear modulus of the solid (stress): a number > 0, at most 1e25 */
    REINFORCED_PROPERTY_MU = 0,
    /* first Lamé constant of the solid (stress): a number from 0 to 1e25 */
    REINFORCED_PROPERTY_LAMBDA = 1,
    /* stiffness of the fibres (stress): a number from 0 to 1e25 */
    REINFORCED_PROPERTY_K = 2,
    /* fibre stretch at failure, 0: no failure (-): a number from 0 to 1e25, default 0 */
    REINFORCED_PROPERTY_STRETCH_LIM = 3,
    /* fibre direction in the reference placement, any length (-): a finite number, not all three 0, default 1 */
    REINFORCED_PROPERTY_M_1 = 4,
    /* fibre direction in the reference placement, any length (-): a finite number, not all three 0, default 0 */
    REINFORCED_PROPERTY_M_2 = 5,
    /* fibre direction in the reference placement, any length (-): a finite number, not all three 0, default 0 */
    REINFORCED_PROPERTY_M_3 = 6,
    REINFORCED_PROPERTIES = 7
};

/* Indices of the state variables, all 0 at the start, and their number. */
enum {
    /* energy per reference volume (energy/volume) */
    REINFORCED_STATE_ENERGY = 0,
    /* stretch of the fibre (-) */
    REINFORCED_STATE_STRETCH = 1,
    /* the latch: 1 once the point has failed; 0 at the start (-) */
    REINFORCED_STATE_FAILED = 2,
    /* 1 - failed, written on every call and never read: for element deletion (-) */
    REINFORCED_STATE_ALIVE = 3,
    REINFORCED_STATE = 4
};

/* Status codes: what is wrong with the call (-1xx), the properties (-2xx), a point (-3xx). */
enum {
    /* no error */
    REINFORCED_STATUS_OK = 0,
    /* an argument that must not be null is null */
    REINFORCED_STATUS_NULL_ARGUMENT = -101,
    /* a count that this function does not support */
    REINFORCED_STATUS_BAD_COUNT = -102,
    /* the leading dimension is less than the number of points */
    REINFORCED_STATUS_BAD_LEADING_DIMENSION = -103,
    /* no such name, index, law, preset or unit system */
    REINFORCED_STATUS_UNKNOWN_NAME = -104,
    /* a scalar argument is outside what is allowed */
    REINFORCED_STATUS_BAD_ARGUMENT = -105,
    /* the law has not been prepared, or it is another law or precision */
    REINFORCED_STATUS_NOT_PREPARED = -107,
    /* the size of a structure is not set, or wrong */
    REINFORCED_STATUS_BAD_SIZE = -108,
    /* a structure requests what this version of the library does not know */
    REINFORCED_STATUS_UNKNOWN_FIELD = -109,
    /* the number of properties differs from the table */
    REINFORCED_STATUS_PROPERTY_COUNT = -201,
    /* a property is NaN or infinite */
    REINFORCED_STATUS_PROPERTY_NOT_FINITE = -202,
    /* a property is outside its bounds */
    REINFORCED_STATUS_PROPERTY_OUT_OF_BOUNDS = -203,
    /* a direction among the properties has no length or is not independent */
    REINFORCED_STATUS_PROPERTY_DIRECTION = -204,
    /* the deformation gradient has a determinant <= 0 or maps the fibre to zero length */
    REINFORCED_STATUS_INVERTED = -301,
    /* the deformation has an entry that is NaN or infinite */
    REINFORCED_STATUS_NOT_FINITE = -302,
    /* the deformation is too large or too small to evaluate, or a result does not fit the number format */
    REINFORCED_STATUS_OVERFLOW = -303,
    /* an old state variable is NaN or infinite */
    REINFORCED_STATUS_STATE_NOT_FINITE = -304,
    /* the fibre direction of this point is zero, NaN or infinite, or along the second axis */
    REINFORCED_STATUS_FIBRE_DIRECTION = -305,
    /* the step is too large to integrate: a stretch by a factor of ten or a half-turn */
    REINFORCED_STATUS_INCREMENT_TOO_LARGE = -306,
    /* the material axes of this point are not orthonormal: start with the law's own, and keep those that each step returns */
    REINFORCED_STATUS_MATERIAL_AXES = -307,
    /* the failure limit of this point is negative, NaN or infinite; 0 stands for that of the properties */
    REINFORCED_STATUS_LIMIT = -308,
    /* the law cannot evaluate this point, for a reason of its own */
    REINFORCED_STATUS_LAW = -309,
    /* the law can evaluate this point in smaller steps only */
    REINFORCED_STATUS_SMALLER_STEP = -310,
    /* room for any message */
    REINFORCED_MESSAGE_CAPACITY = 512
};

/* Tangents: dS/dE (6 x 6); for the Truesdell rate; for the Jaumann rate of the Kirchhoff stress, over J, as Abaqus's DDSDDE;
 * dP/dF (9 x 9). */
enum {
    REINFORCED_TANGENT_MATERIAL = 0,
    REINFORCED_TANGENT_TRUESDELL = 1,
    REINFORCED_TANGENT_JAUMANN = 2,
    REINFORCED_TANGENT_NOMINAL = 3
};

/* Instructions: the best that the processor has, or at most these. */
enum {
    REINFORCED_LEVEL_BEST = 0,
    REINFORCED_LEVEL_BASELINE = 1,
    REINFORCED_LEVEL_AVX2 = 2,
    REINFORCED_LEVEL_AVX512 = 3
};

/* A row of the tables. Set `size`; the rest is written. Texts are null-terminated UTF-8. */
typedef struct REINFORCED_table_row {
    size_t size;
    char name[24], symbol[24];
    /* "stress", "energy/volume", "-"; then exponents of mass, length and time */
    char unit[24];
    int32_t mass, length, time;
    int32_t has_default;
    double default_value;
    double minimum, maximum;
    int32_t minimum_excluded;
    char allowed[80], meaning[100];
} REINFORCED_table_row;

int32_t REINFORCED_property_count(void);
int32_t REINFORCED_property(int32_t index, REINFORCED_table_row *row, char *message, size_t capacity);
int32_t REINFORCED_state_count(void);
int32_t REINFORCED_state_variable(int32_t index, REINFORCED_table_row *row, char *message, size_t capacity);
/* The meaning of a status code. */
int32_t REINFORCED_status_message(int32_t status, char *message, size_t capacity);

/* The law, prepared: numbers only, which may be copied and shared by threads, and need no release. */
typedef struct REINFORCED_f64 {
    uint64_t tag, size;
    double values[17];
} REINFORCED_f64;

/* Checks REINFORCED_PROPERTIES properties and prepares the law; `size` is sizeof *law, `count` the number of properties. */
int32_t REINFORCED_prepare_f64(REINFORCED_f64 *law, size_t size, const double *properties, size_t count, char *message,
    size_t capacity);

/* Points. Set `size`, `n`, and what is wanted; the rest is 0: an array that is null is left out, and an output that is left out is not
 * computed. Component c of point i is at c * leading_dimension + i. Arrays of pointers have one for each component; where only the
 * first is set, the others follow by the leading dimension. Old and new state may be the same array; else arrays must not overlap. */
typedef struct REINFORCED_points_f64 {
    /* sizeof this structure */
    size_t size;
    /* the number of points */
    size_t n;
    /* 0: n */
    size_t leading_dimension;
    /* one of REINFORCED_TANGENT_..., read if there is a tangent */
    int32_t measure;
    /* one of REINFORCED_LEVEL_... */
    int32_t level;
    /* reference density, read if there is a wave speed */
    double density;
    /* In: F at the start of the step, by columns. Not read by this law. */
    const double *f_old[9];
    /* In: F at its end, by columns. Must not be null. */
    const double *f_new[9];
    /* In, 3 components: the fibre direction of each point, of any length; null: that of the properties. */
    const double *fibre[3];
    /* In, 4 components: the old state; null: all 0. */
    const double *state_old;
    /* Out, 4 components: the new state. */
    double *state_new;
    /* Out: Cauchy stress 11 22 33 12 23 31. */
    double *stress[6];
    /* Out, 36 or 81 components: entry (row, column) is 6 row + column or 9 row + column. */
    double *tangent;
    /* Out: a bound of the speed of every wave. */
    double *wave_speed;
    /* Out: 1, or 0 where the point has failed or cannot be evaluated. */
    double *active;
    /* Out: a status code for each point. */
    int32_t *status;
    /* In: the length of the step. Not read by this law. */
    double time_increment;
    /* In: the time at its end. Not read by this law. */
    double time;
    /* In: the temperature of each point at the end of the step. Not read by this law. */
    const double *temperature;
} REINFORCED_points_f64;

int32_t REINFORCED_block_f64(const REINFORCED_f64 *law, const REINFORCED_points_f64 *points, char *message, size_t capacity);

/* The law, prepared: numbers only, which may be copied and shared by threads, and need no release. */
typedef struct REINFORCED_f32 {
    uint64_t tag, size;
    float values[18];
} REINFORCED_f32;

/* Checks REINFORCED_PROPERTIES properties and prepares the law; `size` is sizeof *law, `count` the number of properties. */
int32_t REINFORCED_prepare_f32(REINFORCED_f32 *law, size_t size, const float *properties, size_t count, char *message,
    size_t capacity);

/* Points. Set `size`, `n`, and what is wanted; the rest is 0: an array that is null is left out, and an output that is left out is not
 * computed. Component c of point i is at c * leading_dimension + i. Arrays of pointers have one for each component; where only the
 * first is set, the others follow by the leading dimension. Old and new state may be the same array; else arrays must not overlap. */
typedef struct REINFORCED_points_f32 {
    /* sizeof this structure */
    size_t size;
    /* the number of points */
    size_t n;
    /* 0: n */
    size_t leading_dimension;
    /* one of REINFORCED_TANGENT_..., read if there is a tangent */
    int32_t measure;
    /* one of REINFORCED_LEVEL_... */
    int32_t level;
    /* reference density, read if there is a wave speed */
    double density;
    /* In: F at the start of the step, by columns. Not read by this law. */
    const float *f_old[9];
    /* In: F at its end, by columns. Must not be null. */
    const float *f_new[9];
    /* In, 3 components: the fibre direction of each point, of any length; null: that of the properties. */
    const float *fibre[3];
    /* In, 4 components: the old state; null: all 0. */
    const float *state_old;
    /* Out, 4 components: the new state. */
    float *state_new;
    /* Out: Cauchy stress 11 22 33 12 23 31. */
    float *stress[6];
    /* Out, 36 or 81 components: entry (row, column) is 6 row + column or 9 row + column. */
    float *tangent;
    /* Out: a bound of the speed of every wave. */
    float *wave_speed;
    /* Out: 1, or 0 where the point has failed or cannot be evaluated. */
    float *active;
    /* Out: a status code for each point. */
    int32_t *status;
    /* In: the length of the step. Not read by this law. */
    double time_increment;
    /* In: the time at its end. Not read by this law. */
    double time;
    /* In: the temperature of each point at the end of the step. Not read by this law. */
    const float *temperature;
} REINFORCED_points_f32;

int32_t REINFORCED_block_f32(const REINFORCED_f32 *law, const REINFORCED_points_f32 *points, char *message, size_t capacity);

#ifdef __cplusplus
}
#endif

#endif
