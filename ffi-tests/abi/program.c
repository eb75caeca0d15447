/* A program that a user has compiled with this folder's header, and has not touched since: it must give the same
 * with every later library of ABI 2. Every function that takes a structure, and one of each other kind; in double
 * precision or, with -DSINGLE, in single. It compiles with the library's own header too, whose structures may only
 * grow at their ends. */
#include <math.h>
#include <stdio.h>
#include <string.h>

/* That of the folder which the compiler is told of. */
#include <toron.h>

#ifdef SINGLE
typedef float real;
#define ENTRY(name) name##_f32
#define ROUNDING 1e-5
#else
typedef double real;
#define ENTRY(name) name##_f64
#define ROUNDING 1e-12
#endif

/* ---- Numbers and places that programs have compiled in */

#define IS(name, value) _Static_assert(TORON_##name == value, #name);
IS(OK, 0) IS(NULL_ARGUMENT, -101) IS(BAD_COUNT, -102) IS(BAD_LEADING_DIMENSION, -103) IS(UNKNOWN_NAME, -104)
IS(BAD_ARGUMENT, -105) IS(NO_DEFORMATION_GRADIENT, -106) IS(NOT_PREPARED, -107) IS(BAD_SIZE, -108)
IS(UNKNOWN_FIELD, -109) IS(PROPERTY_COUNT, -201) IS(PROPERTY_NOT_FINITE, -202)
IS(PROPERTY_OUT_OF_BOUNDS, -203) IS(PROPERTY_DIRECTION, -204) IS(FIBRE_OUT_OF_PLANE, -205)
IS(STATE_COUNT, -211) IS(INVERTED, -301) IS(NOT_FINITE, -302) IS(OVERFLOW, -303) IS(STATE_NOT_FINITE, -304)
IS(FIBRE_DIRECTION, -305) IS(INCREMENT_TOO_LARGE, -306) IS(MATERIAL_AXES, -307) IS(LIMIT, -308)
IS(ABI_VERSION, 2) IS(HYPERELASTIC, 0) IS(LINEAR_ELASTIC, 1) IS(HYPERELASTIC_PROPERTIES, 11)
IS(HYPERELASTIC_STATE, 11) IS(LINEAR_ELASTIC_PROPERTIES, 10) IS(LINEAR_ELASTIC_STATE, 10)
IS(ROTATION_FIBRE, 0) IS(ROTATION_POLAR, 1) IS(ROTATION_SPIN, 2) IS(CRITERION_PRINCIPAL, 0)
IS(CRITERION_FIBRE, 1) IS(TANGENT_MATERIAL, 0) IS(TANGENT_TRUESDELL, 1) IS(TANGENT_JAUMANN, 2)
IS(TANGENT_NOMINAL, 3) IS(LEVEL_BEST, 0) IS(LEVEL_BASELINE, 1) IS(LEVEL_AVX2, 2) IS(LEVEL_AVX512, 3)
IS(MESSAGE_CAPACITY, 512)

#ifdef TORON_FROZEN
#define MAY_BE ==
#else
#define MAY_BE >=
#endif
#define STRUCTURE(name, bytes, ...)                                \
    {                                                              \
        typedef name structure;                                    \
        _Static_assert(sizeof(structure) MAY_BE bytes, "size");    \
        __VA_ARGS__                                                \
    }
#define AT(member, offset) _Static_assert(offsetof(structure, member) == offset, #member);

static void structures(void)
{
    STRUCTURE(toron_table_row, 304, AT(size, 0) AT(name, 8) AT(symbol, 32) AT(unit, 56) AT(mass, 80) AT(length, 84)
        AT(time, 88) AT(has_default, 92) AT(default_value, 96) AT(minimum, 104) AT(maximum, 112)
        AT(minimum_excluded, 120) AT(allowed, 124) AT(meaning, 204))
    STRUCTURE(ENTRY(toron_point), 96, AT(size, 0) AT(measure, 8) AT(level, 12) AT(density, 16) AT(deformation_gradient, 24)
        AT(fibre, 32) AT(state_old, 40) AT(state_new, 48) AT(stress, 56) AT(modes, 64) AT(wave_speed, 72)
        AT(tangent, 80) AT(limit, 88))
    STRUCTURE(toron_layout, 16, AT(leading_dimension, 0) AT(stride, 8))
    STRUCTURE(ENTRY(toron_block), 392, AT(size, 0) AT(n, 8) AT(leading_dimension, 16) AT(measure, 24) AT(level, 28)
        AT(density, 32) AT(deformation_gradient, 40) AT(fibre, 112) AT(energies_old, 136) AT(invariants_old, 144)
        AT(failure_old, 152) AT(stress, 160) AT(energies, 208) AT(invariants, 216) AT(failure, 224) AT(modes, 232)
        AT(tangent, 240) AT(wave_speed, 248) AT(active, 256) AT(status, 264) AT(deformation_gradient_layout, 272)
        AT(fibre_layout, 288) AT(state_layout, 304) AT(stress_layout, 320) AT(modes_layout, 336)
        AT(tangent_layout, 352) AT(limit, 368) AT(limit_layout, 376))
    STRUCTURE(ENTRY(toron_linear_point), 120, AT(size, 0) AT(rotation, 8) AT(criterion, 12) AT(measure, 16) AT(level, 20)
        AT(density, 24) AT(f_old, 32) AT(f_new, 40) AT(fibre, 48) AT(second_axis, 56) AT(axes, 64) AT(state_old, 72)
        AT(state_new, 80) AT(stress, 88) AT(wave_speed, 96) AT(tangent, 104) AT(limit, 112))
    STRUCTURE(ENTRY(toron_linear_increment), 56, AT(size, 0) AT(criterion, 8) AT(reserved, 12) AT(jacobian, 16) AT(strain, 24)
        AT(state_old, 32) AT(state_new, 40) AT(stress, 48))
    STRUCTURE(ENTRY(toron_linear_block), 464, AT(size, 0) AT(n, 8) AT(leading_dimension, 16) AT(rotation, 24) AT(criterion, 28)
        AT(measure, 32) AT(level, 36) AT(density, 40) AT(f_old, 48) AT(f_new, 120) AT(fibre, 192)
        AT(second_axis, 216) AT(axes, 240) AT(state_old, 248) AT(state_new, 256) AT(stress, 264) AT(tangent, 312)
        AT(wave_speed, 320) AT(active, 328) AT(status, 336) AT(deformation_gradient_layout, 344)
        AT(fibre_layout, 360) AT(axes_layout, 376) AT(state_layout, 392) AT(stress_layout, 408)
        AT(tangent_layout, 424) AT(limit, 440) AT(limit_layout, 448))
    STRUCTURE(ENTRY(toron_vumat), 152, AT(size, 0) AT(nblock, 8) AT(ndir, 12) AT(nshr, 16) AT(nstatev, 20) AT(nprops, 24)
        AT(level, 28) AT(step_time, 32) AT(total_time, 40) AT(props, 48) AT(density, 56) AT(strain_inc, 64)
        AT(stretch_old, 72) AT(stretch_new, 80) AT(stress_old, 88) AT(state_old, 96) AT(ener_intern_old, 104)
        AT(ener_inelas_old, 112) AT(stress_new, 120) AT(state_new, 128) AT(ener_intern_new, 136)
        AT(ener_inelas_new, 144))
    /* Users keep these; they are never longer. */
    _Static_assert(sizeof(ENTRY(toron_hyperelastic)) == 16 + 62 * sizeof(real), "hyperelastic law");
    _Static_assert(sizeof(ENTRY(toron_linear_elastic)) == 16 + 30 * sizeof(real), "linear elastic law");
}

/* ---- Calls, each with its answer: a yarn along 11 in mm, kg, ms, stretched by 1 % */

static int failures;
static char text[TORON_MESSAGE_CAPACITY];
#define MESSAGE text, sizeof text

#define CHECK(condition)                                                              \
    do {                                                                              \
        if (!(condition)) {                                                           \
            failures++;                                                               \
            fprintf(stderr, "%s:%d: %s: %s\n", __FILE__, __LINE__, #condition, text); \
        }                                                                             \
    } while (0)

enum { N = 5, COUNT = TORON_HYPERELASTIC_PROPERTIES, STATE = TORON_HYPERELASTIC_STATE };
enum { LINEAR = TORON_LINEAR_ELASTIC_PROPERTIES, LINEAR_STATE = TORON_LINEAR_ELASTIC_STATE };

static const real stretch = (real)1.01;
static const real rest[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
static real columns[9] = {0, 0, 0, 0, 1, 0, 0, 0, 1}, properties[COUNT], linear_properties[LINEAR], density;
/* sigma11 of the hyperelastic law, k_el ln(stretch)/stretch, its dS11/dE11 and its energy; of the linear one E1
 * ln(stretch). */
static double wanted, tangent_wanted, energy_wanted, wanted_of_linear;

static int near(double a, double b)
{
    return fabs(a - b) <= ROUNDING * fabs(b);
}

static void tables(void)
{
    toron_table_row row = {.size = sizeof row};
    CHECK(toron_abi_version() == 2 && strlen(toron_version()) > 0);
    CHECK(toron_status_message(TORON_INVERTED, MESSAGE) == TORON_OK && strlen(text) > 0);
    CHECK(toron_property_count(TORON_HYPERELASTIC, MESSAGE) == COUNT && toron_state_count(TORON_LINEAR_ELASTIC, MESSAGE) == LINEAR_STATE);
    CHECK(toron_property_index(TORON_HYPERELASTIC, "eps_lim", MESSAGE) == 5 && toron_state_index(TORON_HYPERELASTIC, "failed", MESSAGE) == 9);
    CHECK(toron_property(TORON_HYPERELASTIC, 0, &row, MESSAGE) == TORON_OK && strcmp(row.name, "k_el") == 0);
    CHECK(strcmp(row.unit, "stress") == 0 && row.mass == 1 && row.length == -1 && row.time == -2 && row.minimum == 0 && row.maximum == 1e25);
    CHECK(strlen(row.symbol) > 0 && strlen(row.allowed) > 0 && strlen(row.meaning) > 0 && !row.has_default && !row.minimum_excluded);
    CHECK(toron_state_variable(TORON_HYPERELASTIC, 10, &row, MESSAGE) == TORON_OK && strcmp(row.name, "alive") == 0);
}

static void presets(void)
{
    CHECK(ENTRY(toron_preset)("kevlar-km2-600", "mm-kg-ms", properties, COUNT, &density, MESSAGE) == TORON_OK);
    CHECK(ENTRY(toron_preset)("kevlar-km2-600-linear", "mm-kg-ms", linear_properties, LINEAR, NULL, MESSAGE) == TORON_OK);
    columns[0] = stretch;
    double k = properties[0], i = log(stretch), square = (double)stretch * stretch;
    wanted = k * i / stretch;
    energy_wanted = 0.5 * k * i * i;
    tangent_wanted = k * (1 - 2 * i) / (square * square);
    wanted_of_linear = linear_properties[0] * i;
}

static void hyperelastic(void)
{
    real state[STATE], stress[6], modes[24], speed, tangent[36], fibre[3] = {2, 0, 0}, tight = (real)0.005, wide = (real)0.5;
    ENTRY(toron_hyperelastic) law;
    CHECK(ENTRY(toron_hyperelastic_prepare)(&law, sizeof law, properties, COUNT, MESSAGE) == TORON_OK);
    ENTRY(toron_point) point = {.size = sizeof point, .measure = TORON_TANGENT_MATERIAL, .level = TORON_LEVEL_BASELINE, .density = density,
                                .deformation_gradient = columns, .fibre = fibre, .state_new = state, .stress = stress, .modes = modes,
                                .wave_speed = &speed, .tangent = tangent};
    CHECK(ENTRY(toron_hyperelastic_point)(&law, &point, MESSAGE) == TORON_OK);
    CHECK(near(stress[0], wanted) && near(state[0], energy_wanted) && near(state[4], log(stretch)) && state[9] == 0 && state[10] == 1);
    CHECK(near(modes[0], wanted / stretch) && near(tangent[0], tangent_wanted) && speed >= 0.9 * sqrt(properties[0] / density));
    point.state_old = state, point.limit = &tight;
    CHECK(ENTRY(toron_hyperelastic_point)(&law, &point, MESSAGE) == TORON_OK && state[9] == 1 && state[10] == 0);
    CHECK(ENTRY(toron_hyperelastic_point_with_properties)(properties, COUNT, &point, MESSAGE) == TORON_OK && stress[0] == 0);
    point.state_old = NULL, point.limit = &wide;
    CHECK(ENTRY(toron_hyperelastic_point_with_properties)(properties, COUNT, &point, MESSAGE) == TORON_OK && near(stress[0], wanted));
#ifndef SINGLE
    double least, direction[3];
    CHECK(toron_hyperelastic_least_acoustic_eigenvalue_f64(&law, &point, &least, direction, MESSAGE) == TORON_OK && isfinite(least));
#endif

    /* A block of such points by rows, one of them inverted and one with a tight limit. */
    real f[N][9], fibres[3][N], by_point[N][6], old[STATE][N] = {{0}}, new[STATE][N], block_modes[N][24], tangents[N][36], speeds[N];
    real active[N], limits[2 * N];
    int32_t status[N];
    for (int i = 0; i < N; i++) {
        memcpy(f[i], columns, sizeof columns);
        fibres[0][i] = 1, fibres[1][i] = fibres[2][i] = 0;
        limits[2 * i] = i == 3 ? tight : 0;
    }
    f[2][0] = -1;
    ENTRY(toron_block) block = {
        .size = sizeof block, .n = N, .measure = TORON_TANGENT_MATERIAL, .level = TORON_LEVEL_BASELINE, .density = density,
        .deformation_gradient = {f[0]}, .fibre = {fibres[0]}, .energies_old = old[0], .invariants_old = old[4], .failure_old = old[8],
        .stress = {by_point[0]}, .energies = new[0], .invariants = new[4], .failure = new[8], .modes = block_modes[0], .tangent = tangents[0],
        .wave_speed = speeds, .active = active, .status = status, .deformation_gradient_layout = {1, 9}, .fibre_layout = {N, 1},
        .state_layout = {N, 1}, .stress_layout = {1, 6}, .modes_layout = {1, 24}, .tangent_layout = {1, 36}, .limit = limits,
        .limit_layout = {0, 2}};
    for (int with_properties = 0; with_properties < 2; with_properties++) {
        memset(by_point, 0, sizeof by_point);
        int32_t code = with_properties ? ENTRY(toron_hyperelastic_block_with_properties)(properties, COUNT, &block, MESSAGE)
                                       : ENTRY(toron_hyperelastic_block)(&law, &block, MESSAGE);
        CHECK(code == TORON_INVERTED && strncmp(text, "point 2", 7) == 0 && status[2] == TORON_INVERTED && active[2] == 0);
        CHECK(near(by_point[4][0], wanted) && by_point[2][0] == 0 && near(tangents[4][0], tangent_wanted) && active[4] == 1);
        CHECK(near(block_modes[4][0], wanted / stretch) && near(new[0][4], energy_wanted) && near(speeds[4], speed));
        CHECK(new[9][3] == 1 && new[10][3] == 0 && new[9][4] == 0 && new[10][4] == 1);
    }

    /* What is wrong is said. */
    block.size = 0;
    CHECK(ENTRY(toron_hyperelastic_block)(&law, &block, MESSAGE) == TORON_BAD_SIZE);
    memset(&law, 0, sizeof law);
    CHECK(ENTRY(toron_hyperelastic_point)(&law, &point, MESSAGE) == TORON_NOT_PREPARED);
    real wrong[COUNT];
    memcpy(wrong, properties, sizeof wrong);
    wrong[0] = -1;
    CHECK(ENTRY(toron_hyperelastic_prepare)(&law, sizeof law, wrong, COUNT, MESSAGE) == TORON_PROPERTY_OUT_OF_BOUNDS);
    CHECK(strncmp(text, "property 1 (k_el", 16) == 0);
}

static void linear_elastic(void)
{
    real state[LINEAR_STATE], stress[6], speed, tangent[36], axes[9], limit = (real)1e-3;
    const real strain[6] = {(real)log(stretch)}, fibre[3] = {3, 0, 0}, second[3] = {1, 1, 0};
    ENTRY(toron_linear_elastic) law;
    CHECK(ENTRY(toron_linear_elastic_prepare)(&law, sizeof law, linear_properties, LINEAR, MESSAGE) == TORON_OK);
    CHECK(ENTRY(toron_linear_elastic_axes)(&law, fibre, second, axes, MESSAGE) == TORON_OK && axes[0] == 1 && axes[4] == 1);
    ENTRY(toron_linear_point) step = {
        .size = sizeof step, .rotation = TORON_ROTATION_SPIN, .criterion = TORON_CRITERION_FIBRE, .measure = TORON_TANGENT_JAUMANN,
        .level = TORON_LEVEL_BASELINE, .density = density, .f_old = rest, .f_new = columns, .fibre = fibre, .second_axis = second,
        .axes = axes, .state_new = state, .stress = stress, .wave_speed = &speed, .tangent = tangent};
    CHECK(ENTRY(toron_linear_elastic_point)(&law, &step, MESSAGE) == TORON_OK && near(stress[0], wanted_of_linear) && speed > 0);
    CHECK(tangent[0] > 0 && state[8] == 0 && state[9] == 1);
    step.limit = &limit, step.rotation = TORON_ROTATION_FIBRE, step.state_old = NULL;
    CHECK(ENTRY(toron_linear_elastic_point_with_properties)(linear_properties, LINEAR, &step, MESSAGE) == TORON_OK && state[8] == 1);
    ENTRY(toron_linear_increment) increment = {.size = sizeof increment, .criterion = TORON_CRITERION_PRINCIPAL, .jacobian = stretch,
                                               .strain = strain, .state_new = state, .stress = stress};
    CHECK(ENTRY(toron_linear_elastic_increment)(&law, &increment, MESSAGE) == TORON_OK && near(stress[0], wanted_of_linear));
    increment.state_old = state, increment.state_new = NULL;
    CHECK(ENTRY(toron_linear_elastic_increment)(&law, &increment, MESSAGE) == TORON_OK && near(stress[0], 2 * wanted_of_linear));

    /* Two points by rows, one of which breaks. */
    real from[2][9], to[2][9], turning[2][9], fibres[2][3] = {{1, 0, 0}, {1, 0, 0}}, across[2][3] = {{0, 1, 0}, {0, 1, 0}};
    real old[2][LINEAR_STATE] = {{0}}, new[2][LINEAR_STATE], by_point[2][6], tangents[2][36], speeds[2], active[2];
    const real limits[2] = {0, limit};
    int32_t status[2];
    for (int i = 0; i < 2; i++)
        memcpy(from[i], rest, sizeof rest), memcpy(to[i], columns, sizeof columns), memcpy(turning[i], rest, sizeof rest);
    ENTRY(toron_linear_block) block = {
        .size = sizeof block, .n = 2, .leading_dimension = 2, .rotation = TORON_ROTATION_SPIN, .criterion = TORON_CRITERION_FIBRE,
        .measure = TORON_TANGENT_JAUMANN, .level = TORON_LEVEL_BASELINE, .density = density, .f_old = {from[0]}, .f_new = {to[0]},
        .fibre = {fibres[0]}, .second_axis = {across[0]}, .axes = turning[0], .state_old = old[0], .state_new = new[0],
        .stress = {by_point[0]}, .tangent = tangents[0], .wave_speed = speeds, .active = active, .status = status,
        .deformation_gradient_layout = {1, 9}, .fibre_layout = {1, 3}, .axes_layout = {1, 9}, .state_layout = {1, LINEAR_STATE},
        .stress_layout = {1, 6}, .tangent_layout = {1, 36}, .limit = limits, .limit_layout = {0, 1}};
    for (int with_properties = 0; with_properties < 2; with_properties++) {
        memset(by_point, 0, sizeof by_point);
        CHECK((with_properties ? ENTRY(toron_linear_elastic_block_with_properties)(linear_properties, LINEAR, &block, MESSAGE)
                               : ENTRY(toron_linear_elastic_block)(&law, &block, MESSAGE)) == TORON_OK);
        CHECK(near(by_point[0][0], wanted_of_linear) && near(speeds[0], speed) && tangents[0][0] == tangent[0]);
        CHECK(new[0][8] == 0 && new[1][8] == 1 && status[0] == TORON_OK && active[0] == 1 && active[1] == 0);
    }
}

static void hosts(void)
{
    real stress[6], history[LINEAR_STATE + 18] = {0}, before[STATE] = {0}, after[STATE], energy, inelastic, es[36];
    const real stretches[6] = {stretch, 1, 1}, unstretched[6] = {1, 1, 1}, zeros[6] = {0}, increment[6] = {(real)log(stretch)};
    int failed;
    ENTRY(toron_vumat) vumat = {
        .size = sizeof vumat, .nblock = 1, .ndir = 3, .nshr = 3, .nstatev = STATE, .nprops = COUNT, .level = TORON_LEVEL_BASELINE,
        .step_time = 1, .total_time = 1, .props = properties, .density = &density, .strain_inc = zeros, .stretch_old = stretches,
        .stretch_new = stretches, .stress_old = zeros, .state_old = before, .ener_intern_old = zeros, .ener_inelas_old = zeros,
        .stress_new = stress, .state_new = after, .ener_intern_new = &energy, .ener_inelas_new = &inelastic};
    CHECK(ENTRY(toron_abaqus_vumat)(&vumat, MESSAGE) == TORON_OK && near(stress[0], wanted) && near(energy, energy_wanted / (density * stretch)));
    vumat.nstatev = LINEAR_STATE, vumat.nprops = LINEAR, vumat.props = linear_properties, vumat.strain_inc = increment;
    vumat.stretch_old = unstretched;
    CHECK(ENTRY(toron_abaqus_linear_vumat)(&vumat, MESSAGE) == TORON_OK && near(stress[0], wanted_of_linear) && after[9] == 1);

    memcpy(history + STATE, columns, sizeof columns);
    CHECK(ENTRY(toron_lsdyna_umat)(properties, stress, history, STATE, &failed, MESSAGE) == TORON_OK && near(stress[0], wanted));
    CHECK(failed == 0 && ENTRY(toron_lsdyna_utan)(properties, history, STATE, es, MESSAGE) == TORON_OK && es[0] > 0);
    memset(history, 0, sizeof history);
    memcpy(history + LINEAR_STATE + 9, columns, sizeof columns);
    CHECK(ENTRY(toron_lsdyna_linear_umat)(linear_properties, stress, history, LINEAR_STATE + 9, &failed, MESSAGE) == TORON_OK);
    CHECK(near(stress[0], wanted_of_linear) && failed == 0);
#ifndef SINGLE
    double statev[STATE] = {0}, sse, factor = 1, ddsdde[36];
    CHECK(toron_abaqus_umat_f64(stress, statev, &sse, &factor, columns, properties, COUNT, STATE, 3, 3, 1, MESSAGE) == TORON_OK);
    CHECK(near(stress[0], wanted) && near(sse, energy_wanted / stretch));
    memset(statev, 0, sizeof statev);
    CHECK(toron_abaqus_umat_tangent_f64(stress, statev, ddsdde, &sse, &factor, columns, properties, COUNT, STATE, 3, 3, 1, MESSAGE)
          == TORON_OK && near(stress[0], wanted) && ddsdde[0] > 0);
    memset(statev, 0, sizeof statev);
    CHECK(toron_abaqus_linear_umat_f64(stress, statev, ddsdde, &sse, &factor, rest, columns, linear_properties, LINEAR, LINEAR_STATE,
                                       3, 3, 1, MESSAGE) == TORON_OK && near(stress[0], wanted_of_linear) && ddsdde[0] > 0);
#endif
}

int main(void)
{
    structures();
    tables();
    presets();
    hyperelastic();
    linear_elastic();
    hosts();
    return failures > 0;
}
