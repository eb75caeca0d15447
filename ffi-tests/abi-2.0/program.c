/* A program that a user has compiled with this folder's header, that of ABI 2.0, and has not touched since: it must give the same with
 * every later library of ABI 2. One function of each kind. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "toron.h"

static int failures;

#define CHECK(condition)                                                             \
    do {                                                                             \
        if (!(condition)) {                                                          \
            failures++;                                                              \
            fprintf(stderr, "%s:%d: %s: %s\n", __FILE__, __LINE__, #condition, text); \
        }                                                                            \
    } while (0)

static char text[TORON_MESSAGE_CAPACITY];
#define MESSAGE text, sizeof text

static int near(double a, double b)
{
    return fabs(a - b) <= 1e-6 * fabs(b);
}

int main(void)
{
    enum { N = 5, COUNT = TORON_HYPERELASTIC_PROPERTIES, STATE = TORON_HYPERELASTIC_STATE,
          LINEAR = TORON_LINEAR_ELASTIC_PROPERTIES };
    /* A yarn along 11 in mm, kg, ms, stretched by one percent: σ11 = k_el ln λ/λ. */
    const double stretch = 1.01, columns[9] = {stretch, 0, 0, 0, 1, 0, 0, 0, 1}, rest[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    double properties[COUNT], density, state[STATE], stress[6], speed, tangent[36];
    double linear_properties[LINEAR], linear_state[TORON_LINEAR_ELASTIC_STATE], axes[9];

    /* About the library, and its tables. */
    CHECK(toron_abi_version() == TORON_ABI_VERSION && toron_abi_version() == 2 && strlen(toron_version()) > 0);
    CHECK(toron_status_message(TORON_INVERTED, MESSAGE) == TORON_OK && strlen(text) > 0);
    CHECK(toron_property_count(TORON_HYPERELASTIC, MESSAGE) == COUNT);
    CHECK(toron_state_index(TORON_HYPERELASTIC, "failed", MESSAGE) == 9);
    toron_table_row row = {.size = sizeof row};
    CHECK(toron_property(TORON_HYPERELASTIC, 0, &row, MESSAGE) == TORON_OK && strcmp(row.name, "k_el") == 0);
    CHECK(strcmp(row.unit, "stress") == 0 && row.mass == 1 && row.minimum == 0 && strlen(row.meaning) > 0);
    CHECK(toron_preset_f64("kevlar-km2-600", "mm-kg-ms", properties, COUNT, &density, MESSAGE) == TORON_OK);
    CHECK(toron_preset_f64("kevlar-km2-600-linear", "mm-kg-ms", linear_properties, LINEAR, NULL, MESSAGE) == TORON_OK);

    /* A point, by both ways; a block of such points, one of them inverted; a wave. */
    const double wanted = properties[0] * log(stretch) / stretch;
    toron_hyperelastic_f64 law;
    CHECK(toron_hyperelastic_prepare_f64(&law, sizeof law, properties, COUNT, MESSAGE) == TORON_OK);
    toron_point_f64 point = {.size = sizeof point, .measure = TORON_TANGENT_TRUESDELL, .density = density,
                             .deformation_gradient = columns, .state_new = state, .stress = stress, .wave_speed = &speed,
                             .tangent = tangent};
    CHECK(toron_hyperelastic_point_f64(&law, &point, MESSAGE) == TORON_OK);
    CHECK(near(stress[0], wanted) && state[9] == 0 && state[10] == 1 && speed >= sqrt(properties[0] / density) && tangent[0] > 0);
    CHECK(toron_hyperelastic_point_with_properties_f64(properties, COUNT, &point, MESSAGE) == TORON_OK);
    CHECK(near(stress[0], wanted));
    double f[N][9], block_stress[N][6], block_state[STATE][N], active[N];
    int32_t status[N];
    for (int i = 0; i < N; i++)
        memcpy(f[i], columns, sizeof columns);
    f[2][0] = -1;
    toron_block_f64 block = {.size = sizeof block, .n = N, .deformation_gradient = {f[0]}, .stress = {block_stress[0]},
                             .energies = block_state[0], .invariants = block_state[4], .failure = block_state[8], .active = active,
                             .status = status, .deformation_gradient_layout = {1, 9}, .stress_layout = {1, 6}};
    CHECK(toron_hyperelastic_block_f64(&law, &block, MESSAGE) == TORON_INVERTED && strncmp(text, "point 2", 7) == 0);
    CHECK(near(block_stress[4][0], wanted) && block_stress[2][0] == 0 && active[2] == 0 && active[4] == 1
          && status[2] == TORON_INVERTED);
    double least;
    CHECK(toron_hyperelastic_least_acoustic_eigenvalue_f64(&law, &point, &least, NULL, MESSAGE) == TORON_OK && isfinite(least));

    /* The linear elastic law, by a step and by an increment: E1 ln λ. */
    toron_linear_elastic_f64 linear;
    const double of_linear = linear_properties[0] * log(stretch), strain[6] = {log(stretch)};
    CHECK(toron_linear_elastic_prepare_f64(&linear, sizeof linear, linear_properties, LINEAR, MESSAGE) == TORON_OK);
    CHECK(toron_linear_elastic_axes_f64(&linear, NULL, NULL, axes, MESSAGE) == TORON_OK && axes[0] == 1);
    toron_linear_point_f64 step = {.size = sizeof step, .rotation = TORON_ROTATION_SPIN, .density = density, .f_old = rest,
                                   .f_new = columns, .axes = axes, .state_new = linear_state, .stress = stress, .wave_speed = &speed};
    CHECK(toron_linear_elastic_point_f64(&linear, &step, MESSAGE) == TORON_OK && near(stress[0], of_linear) && speed > 0);
    toron_linear_increment_f64 increment = {.size = sizeof increment, .strain = strain, .state_new = linear_state,
                                            .stress = stress};
    CHECK(toron_linear_elastic_increment_f64(&linear, &increment, MESSAGE) == TORON_OK && near(stress[0], of_linear));
    toron_linear_block_f64 steps = {.size = sizeof steps, .n = 1, .f_old = {rest}, .f_new = {columns}, .stress = {stress},
                                    .tangent = tangent, .measure = TORON_TANGENT_JAUMANN, .active = active};
    CHECK(toron_linear_elastic_block_f64(&linear, &steps, MESSAGE) == TORON_OK && near(stress[0], of_linear) && tangent[0] > 0);

    /* Hosts. */
    double statev[STATE] = {0}, energy, factor = 1, history[STATE + 9] = {0}, out[STATE];
    const double stretches[6] = {stretch, 1, 1}, zeros[6] = {0};
    int failed;
    CHECK(toron_abaqus_umat_f64(stress, statev, &energy, &factor, columns, properties, COUNT, STATE, 3, 3, 1, MESSAGE) == TORON_OK
          && near(stress[0], wanted));
    memcpy(history + STATE, columns, sizeof columns);
    CHECK(toron_lsdyna_umat_f64(properties, stress, history, STATE, &failed, MESSAGE) == TORON_OK && near(stress[0], wanted)
          && failed == 0);
    memset(statev, 0, sizeof statev);
    toron_vumat_f64 vumat = {.size = sizeof vumat, .nblock = 1, .ndir = 3, .nshr = 3, .nstatev = STATE, .nprops = COUNT,
                             .step_time = 1, .total_time = 1, .props = properties, .density = &density, .strain_inc = zeros,
                             .stretch_old = stretches, .stretch_new = stretches, .stress_old = zeros, .state_old = statev,
                             .ener_intern_old = zeros, .ener_inelas_old = zeros, .stress_new = stress, .state_new = out,
                             .ener_intern_new = &energy, .ener_inelas_new = &least};
    CHECK(toron_abaqus_vumat_f64(&vumat, MESSAGE) == TORON_OK && near(stress[0], wanted));

    /* What is wrong is said. */
    block.size = 0;
    CHECK(toron_hyperelastic_block_f64(&law, &block, MESSAGE) == TORON_BAD_SIZE);
    memset(&law, 0, sizeof law);
    CHECK(toron_hyperelastic_point_f64(&law, &point, MESSAGE) == TORON_NOT_PREPARED);
    properties[0] = -1;
    CHECK(toron_hyperelastic_prepare_f64(&law, sizeof law, properties, COUNT, MESSAGE) == TORON_PROPERTY_OUT_OF_BOUNDS);
    CHECK(strncmp(text, "property 1 (k_el", 16) == 0);
    return failures > 0;
}
