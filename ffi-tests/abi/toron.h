/* The header of ABI 2 as it was frozen, but for the functions that `program.c` does not call: it is not changed,
 * since programs compiled with it run with every later library of ABI 2. */
#ifndef TORON_H
#define TORON_H
#define TORON_FROZEN

#include <stddef.h>
#include <stdint.h>

#define TORON_OK 0
#define TORON_NULL_ARGUMENT -101
#define TORON_BAD_COUNT -102
#define TORON_BAD_LEADING_DIMENSION -103
#define TORON_UNKNOWN_NAME -104
#define TORON_BAD_ARGUMENT -105
#define TORON_NO_DEFORMATION_GRADIENT -106
#define TORON_NOT_PREPARED -107
#define TORON_BAD_SIZE -108
#define TORON_UNKNOWN_FIELD -109
#define TORON_PROPERTY_COUNT -201
#define TORON_PROPERTY_NOT_FINITE -202
#define TORON_PROPERTY_OUT_OF_BOUNDS -203
#define TORON_PROPERTY_DIRECTION -204
#define TORON_FIBRE_OUT_OF_PLANE -205
#define TORON_STATE_COUNT -211
#define TORON_INVERTED -301
#define TORON_NOT_FINITE -302
#define TORON_OVERFLOW -303
#define TORON_STATE_NOT_FINITE -304
#define TORON_FIBRE_DIRECTION -305
#define TORON_INCREMENT_TOO_LARGE -306
#define TORON_MATERIAL_AXES -307
#define TORON_LIMIT -308
#define TORON_ABI_VERSION 2
#define TORON_HYPERELASTIC 0
#define TORON_LINEAR_ELASTIC 1
#define TORON_HYPERELASTIC_PROPERTIES 11
#define TORON_HYPERELASTIC_STATE 11
#define TORON_LINEAR_ELASTIC_PROPERTIES 10
#define TORON_LINEAR_ELASTIC_STATE 10
#define TORON_ROTATION_FIBRE 0
#define TORON_ROTATION_POLAR 1
#define TORON_ROTATION_SPIN 2
#define TORON_CRITERION_PRINCIPAL 0
#define TORON_CRITERION_FIBRE 1
#define TORON_TANGENT_MATERIAL 0
#define TORON_TANGENT_TRUESDELL 1
#define TORON_TANGENT_JAUMANN 2
#define TORON_TANGENT_NOMINAL 3
#define TORON_LEVEL_BEST 0
#define TORON_LEVEL_BASELINE 1
#define TORON_LEVEL_AVX2 2
#define TORON_LEVEL_AVX512 3
#define TORON_MESSAGE_CAPACITY 512

typedef struct toron_table_row {
    size_t size;
    char name[24];
    char symbol[24];
    char unit[24];
    int32_t mass;
    int32_t length;
    int32_t time;
    int32_t has_default;
    double default_value;
    double minimum;
    double maximum;
    int32_t minimum_excluded;
    char allowed[80];
    char meaning[100];
} toron_table_row;

typedef struct toron_layout {
    size_t leading_dimension;
    size_t stride;
} toron_layout;

/* In each precision: PRECISION(double, f64), PRECISION(float, f32). */
#define PRECISION(real, t) \
    typedef struct toron_hyperelastic_##t { \
        uint64_t tag; \
        uint64_t size; \
        real values[62]; \
    } toron_hyperelastic_##t; \
    typedef struct toron_point_##t { \
        size_t size; \
        int32_t measure; \
        int32_t level; \
        double density; \
        const real *deformation_gradient; \
        const real *fibre; \
        const real *state_old; \
        real *state_new; \
        real *stress; \
        real *modes; \
        real *wave_speed; \
        real *tangent; \
        const real *limit; \
    } toron_point_##t; \
    typedef struct toron_block_##t { \
        size_t size; \
        size_t n; \
        size_t leading_dimension; \
        int32_t measure; \
        int32_t level; \
        double density; \
        const real *deformation_gradient[9]; \
        const real *fibre[3]; \
        const real *energies_old; \
        const real *invariants_old; \
        const real *failure_old; \
        real *stress[6]; \
        real *energies; \
        real *invariants; \
        real *failure; \
        real *modes; \
        real *tangent; \
        real *wave_speed; \
        real *active; \
        int32_t *status; \
        struct toron_layout deformation_gradient_layout; \
        struct toron_layout fibre_layout; \
        struct toron_layout state_layout; \
        struct toron_layout stress_layout; \
        struct toron_layout modes_layout; \
        struct toron_layout tangent_layout; \
        const real *limit; \
        struct toron_layout limit_layout; \
    } toron_block_##t; \
    typedef struct toron_linear_elastic_##t { \
        uint64_t tag; \
        uint64_t size; \
        real values[30]; \
    } toron_linear_elastic_##t; \
    typedef struct toron_linear_point_##t { \
        size_t size; \
        int32_t rotation; \
        int32_t criterion; \
        int32_t measure; \
        int32_t level; \
        double density; \
        const real *f_old; \
        const real *f_new; \
        const real *fibre; \
        const real *second_axis; \
        real *axes; \
        const real *state_old; \
        real *state_new; \
        real *stress; \
        real *wave_speed; \
        real *tangent; \
        const real *limit; \
    } toron_linear_point_##t; \
    typedef struct toron_linear_increment_##t { \
        size_t size; \
        int32_t criterion; \
        int32_t reserved; \
        double jacobian; \
        const real *strain; \
        const real *state_old; \
        real *state_new; \
        real *stress; \
    } toron_linear_increment_##t; \
    typedef struct toron_linear_block_##t { \
        size_t size; \
        size_t n; \
        size_t leading_dimension; \
        int32_t rotation; \
        int32_t criterion; \
        int32_t measure; \
        int32_t level; \
        double density; \
        const real *f_old[9]; \
        const real *f_new[9]; \
        const real *fibre[3]; \
        const real *second_axis[3]; \
        real *axes; \
        const real *state_old; \
        real *state_new; \
        real *stress[6]; \
        real *tangent; \
        real *wave_speed; \
        real *active; \
        int32_t *status; \
        struct toron_layout deformation_gradient_layout; \
        struct toron_layout fibre_layout; \
        struct toron_layout axes_layout; \
        struct toron_layout state_layout; \
        struct toron_layout stress_layout; \
        struct toron_layout tangent_layout; \
        const real *limit; \
        struct toron_layout limit_layout; \
    } toron_linear_block_##t; \
    typedef struct toron_vumat_##t { \
        size_t size; \
        int32_t nblock; \
        int32_t ndir; \
        int32_t nshr; \
        int32_t nstatev; \
        int32_t nprops; \
        int32_t level; \
        double step_time; \
        double total_time; \
        const real *props; \
        const real *density; \
        const real *strain_inc; \
        const real *stretch_old; \
        const real *stretch_new; \
        const real *stress_old; \
        const real *state_old; \
        const real *ener_intern_old; \
        const real *ener_inelas_old; \
        real *stress_new; \
        real *state_new; \
        real *ener_intern_new; \
        real *ener_inelas_new; \
    } toron_vumat_##t; \
    int32_t toron_preset_##t(const char *preset, const char *units, real *properties, size_t count, real *density, \
        char *message, size_t capacity); \
    int32_t toron_hyperelastic_prepare_##t(toron_hyperelastic_##t *law, size_t size, const real *properties, \
        size_t count, char *message, size_t capacity); \
    int32_t toron_hyperelastic_point_##t(const toron_hyperelastic_##t *law, const toron_point_##t *point, char *message, \
        size_t capacity); \
    int32_t toron_hyperelastic_point_with_properties_##t(const real *properties, size_t count, \
        const toron_point_##t *point, char *message, size_t capacity); \
    int32_t toron_hyperelastic_block_##t(const toron_hyperelastic_##t *law, const toron_block_##t *block, char *message, \
        size_t capacity); \
    int32_t toron_hyperelastic_block_with_properties_##t(const real *properties, size_t count, \
        const toron_block_##t *block, char *message, size_t capacity); \
    int32_t toron_linear_elastic_prepare_##t(toron_linear_elastic_##t *law, size_t size, const real *properties, \
        size_t count, char *message, size_t capacity); \
    int32_t toron_linear_elastic_axes_##t(const toron_linear_elastic_##t *law, const real *fibre, \
        const real *second_axis, real *axes, char *message, size_t capacity); \
    int32_t toron_linear_elastic_point_##t(const toron_linear_elastic_##t *law, const toron_linear_point_##t *point, \
        char *message, size_t capacity); \
    int32_t toron_linear_elastic_point_with_properties_##t(const real *properties, size_t count, \
        const toron_linear_point_##t *point, char *message, size_t capacity); \
    int32_t toron_linear_elastic_increment_##t(const toron_linear_elastic_##t *law, \
        const toron_linear_increment_##t *increment, char *message, size_t capacity); \
    int32_t toron_linear_elastic_block_##t(const toron_linear_elastic_##t *law, const toron_linear_block_##t *block, \
        char *message, size_t capacity); \
    int32_t toron_linear_elastic_block_with_properties_##t(const real *properties, size_t count, \
        const toron_linear_block_##t *block, char *message, size_t capacity); \
    int32_t toron_abaqus_vumat_##t(const toron_vumat_##t *block, char *message, size_t capacity); \
    int32_t toron_abaqus_linear_vumat_##t(const toron_vumat_##t *block, char *message, size_t capacity); \
    int32_t toron_lsdyna_umat_##t(const real *cm, real *sig, real *hsv, int32_t nhv, int *failel, char *message, \
        size_t capacity); \
    int32_t toron_lsdyna_utan_##t(const real *cm, const real *hsv, int32_t nhv, real *es, char *message, size_t capacity); \
    int32_t toron_lsdyna_linear_umat_##t(const real *cm, real *sig, real *hsv, int32_t nhv, int *failel, char *message, \
        size_t capacity);
PRECISION(double, f64)
PRECISION(float, f32)

const char *toron_version(void);
int32_t toron_abi_version(void);
int32_t toron_status_message(int32_t status, char *message, size_t capacity);
int32_t toron_property_count(int32_t law, char *message, size_t capacity);
int32_t toron_property(int32_t law, int32_t index, toron_table_row *row, char *message, size_t capacity);
int32_t toron_property_index(int32_t law, const char *property, char *message, size_t capacity);
int32_t toron_state_count(int32_t law, char *message, size_t capacity);
int32_t toron_state_variable(int32_t law, int32_t index, toron_table_row *row, char *message, size_t capacity);
int32_t toron_state_index(int32_t law, const char *variable, char *message, size_t capacity);
int32_t toron_hyperelastic_least_acoustic_eigenvalue_f64(const toron_hyperelastic_f64 *law,
    const toron_point_f64 *point, double *least, double *direction, char *message, size_t capacity);
int32_t toron_abaqus_umat_tangent_f64(double *stress, double *statev, double *ddsdde, double *sse, double *pnewdt,
    const double *dfgrd1, const double *props, int32_t nprops, int32_t nstatv, int32_t ndi, int32_t nshr,
    int32_t nlgeom, char *message, size_t capacity);
int32_t toron_abaqus_umat_f64(double *stress, double *statev, double *sse, double *pnewdt, const double *dfgrd1,
    const double *props, int32_t nprops, int32_t nstatv, int32_t ndi, int32_t nshr, int32_t nlgeom, char *message,
    size_t capacity);
int32_t toron_abaqus_linear_umat_f64(double *stress, double *statev, double *ddsdde, double *sse, double *pnewdt,
    const double *dfgrd0, const double *dfgrd1, const double *props, int32_t nprops, int32_t nstatv, int32_t ndi,
    int32_t nshr, int32_t nlgeom, char *message, size_t capacity);

#endif
