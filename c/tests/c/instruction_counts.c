/* Evaluates 1024 moderate deformations through one entry of the library, named on the command line. */
#include <stdio.h>
#include <string.h>

#include "toron.h"

enum { N = 1024, PROPERTIES = TORON_HYPERELASTIC_PROPERTIES, STATE = TORON_HYPERELASTIC_STATE };

/* Columns of F, point by point and component-major, in both precisions; outputs. */
static double point[N][9], gradient[9][N], state[STATE][N], stress[6][N], tangent[36][N];
static float gradient_single[9][N], state_single[STATE][N], stress_single[6][N];
static int32_t status[N];

/* A point every step of a path: stretched up to 3 %, compacted to 70 %, sheared, turned a little. */
static void deform(void)
{
    for (int i = 0; i < N; i++) {
        double t = (double)i / N;
        double columns[9] = {1 + 0.03 * t, 0.02 * t, -0.01, 0.3 * t, 1 - 0.3 * t, 0.1, -0.2 * t, 0.05, 1 - 0.1 * t};
        for (int c = 0; c < 9; c++) {
            point[i][c] = gradient[c][i] = columns[c];
            gradient_single[c][i] = (float)columns[c];
        }
    }
}

int main(int argc, char **argv)
{
    const char *entry = argc > 1 ? argv[1] : "";
    double values[PROPERTIES];
    float values_single[PROPERTIES];
    if (toron_preset_f64("kevlar-km2-600", "mm-tonne-s", values, PROPERTIES, NULL, NULL, 0) != 0 ||
        toron_preset_f32("kevlar-km2-600", "mm-tonne-s", values_single, PROPERTIES, NULL, NULL, 0) != 0)
        return 2;
    deform();
    toron_hyperelastic_f64 law;
    toron_hyperelastic_f32 law_single;
    if (toron_hyperelastic_prepare_f64(&law, sizeof law, values, PROPERTIES, NULL, 0) != 0 ||
        toron_hyperelastic_prepare_f32(&law_single, sizeof law_single, values_single, PROPERTIES, NULL, 0) != 0)
        return 2;
    double s[6], c[36], old[STATE] = {0}, new[STATE], energy = 0, cut = 1;
    toron_point_f64 one = {.size = sizeof one, .state_old = old, .state_new = new, .stress = s};
    toron_block_f64 block = {
        .size = sizeof block, .n = N, .deformation_gradient = {gradient[0]}, .stress = {stress[0]}, .status = status};
    toron_block_f32 single = {.size = sizeof single,
                              .n = N,
                              .deformation_gradient = {gradient_single[0]},
                              .stress = {stress_single[0]},
                              .status = status};
    if (strstr(entry, "state") != NULL) {
        block.energies = state[0], block.invariants = state[4], block.failure = state[8];
        block.energies_old = state[0], block.invariants_old = state[4], block.failure_old = state[8];
        single.energies = state_single[0], single.invariants = state_single[4], single.failure = state_single[8];
        single.energies_old = state_single[0], single.invariants_old = state_single[4];
        single.failure_old = state_single[8];
    }
    if (strstr(entry, "tangent") != NULL) {
        block.measure = one.measure = TORON_TANGENT_JAUMANN;
        block.tangent = tangent[0], one.tangent = c;
    }
    if (strcmp(entry, "point-f64") == 0) {
        for (int i = 0; i < N; i++) {
            one.deformation_gradient = point[i];
            if (toron_hyperelastic_point_with_properties_f64(values, PROPERTIES, &one, NULL, 0) != 0)
                return 1;
        }
        return 0;
    }
    if (strcmp(entry, "point-prepared-f64") == 0 || strcmp(entry, "point-tangent-f64") == 0) {
        for (int i = 0; i < N; i++) {
            one.deformation_gradient = point[i];
            if (toron_hyperelastic_point_f64(&law, &one, NULL, 0) != 0)
                return 1;
        }
        return 0;
    }
    if (strcmp(entry, "umat-tangent-f64") == 0) {
        for (int i = 0; i < N; i++) {
            double kept[STATE] = {0};
            if (toron_abaqus_umat_tangent_f64(s, kept, c, &energy, &cut, point[i], values, PROPERTIES, STATE, 3, 3, 1, NULL,
                                              0) != 0)
                return 1;
        }
        return 0;
    }
    if (strcmp(entry, "umat-f64") == 0) {
        for (int i = 0; i < N; i++) {
            double kept[STATE] = {0};
            if (toron_abaqus_umat_f64(s, kept, &energy, &cut, point[i], values, PROPERTIES, STATE, 3, 3, 1, NULL, 0) != 0)
                return 1;
        }
        return 0;
    }
    if (strcmp(entry, "block-state-f64") == 0 || strcmp(entry, "block-stress-f64") == 0 || strcmp(entry, "block-tangent-f64") == 0)
        return toron_hyperelastic_block_f64(&law, &block, NULL, 0) != 0;
    if (strcmp(entry, "block-state-f32") == 0 || strcmp(entry, "block-stress-f32") == 0)
        return toron_hyperelastic_block_f32(&law_single, &single, NULL, 0) != 0;
    if (strcmp(entry, "linear-block-f64") == 0) {
        /* From rest to the deformation in one step. */
        static double rest[9][N], linear_state[TORON_LINEAR_ELASTIC_STATE][N];
        double linear[TORON_LINEAR_ELASTIC_PROPERTIES];
        toron_linear_elastic_f64 linear_law;
        if (toron_preset_f64("kevlar-km2-600-linear", "mm-tonne-s", linear, TORON_LINEAR_ELASTIC_PROPERTIES, NULL, NULL, 0) != 0 ||
            toron_linear_elastic_prepare_f64(&linear_law, sizeof linear_law, linear, TORON_LINEAR_ELASTIC_PROPERTIES, NULL, 0) != 0)
            return 2;
        for (int i = 0; i < N; i++)
            rest[0][i] = rest[4][i] = rest[8][i] = 1;
        toron_linear_block_f64 steps = {.size = sizeof steps, .n = N, .f_old = {rest[0]}, .f_new = {gradient[0]},
                                        .state_old = linear_state[0], .state_new = linear_state[0], .stress = {stress[0]},
                                        .status = status};
        return toron_linear_elastic_block_f64(&linear_law, &steps, NULL, 0) != 0;
    }
    fprintf(stderr, "%s: no such entry\n", entry);
    return 2;
}
