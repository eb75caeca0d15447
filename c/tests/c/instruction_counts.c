/* Evaluates 1024 moderate deformations through one entry of the library, named on the command line. */
#include <stdio.h>
#include <string.h>

#include "toron.h"

enum { N = 1024, PROPERTIES = TORON_HYPERELASTIC_PROPERTIES, STATE = TORON_HYPERELASTIC_STATE };

/* Columns of F, point by point and component-major, in both precisions; outputs. */
static double point[N][9], gradient[9][N], state[STATE][N], stress[6][N];
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
    double values[PROPERTIES], density;
    float values_single[PROPERTIES], density_single;
    if (toron_preset_f64("kevlar-km2-600", "mm-tonne-s", values, PROPERTIES, &density) != 0 ||
        toron_preset_f32("kevlar-km2-600", "mm-tonne-s", values_single, PROPERTIES, &density_single) != 0)
        return 2;
    deform();
    toron_block_f64 block = {
        .n = N, .leading_dimension = N, .deformation_gradient = gradient[0], .stress = stress[0], .status = status};
    toron_block_f32 single = {.n = N,
                              .leading_dimension = N,
                              .deformation_gradient = gradient_single[0],
                              .stress = stress_single[0],
                              .status = status};
    if (strcmp(entry, "point-f64") == 0) {
        double old[STATE] = {0}, new[STATE], s[6];
        for (int i = 0; i < N; i++)
            if (toron_hyperelastic_point_f64(values, PROPERTIES, point[i], NULL, old, new, s, NULL, 0, NULL) != 0)
                return 1;
        return 0;
    }
    if (strcmp(entry, "umat-tangent-f64") == 0) {
        double s[6], c[36], energy = 0, cut = 1;
        for (int i = 0; i < N; i++) {
            double kept[STATE] = {0};
            if (toron_abaqus_umat_tangent_f64(s, kept, c, &energy, &cut, point[i], values, PROPERTIES, STATE, 3, 3, 1) != 0)
                return 1;
        }
        return 0;
    }
    if (strcmp(entry, "umat-f64") == 0) {
        double s[6], energy = 0, cut = 1;
        for (int i = 0; i < N; i++) {
            double kept[STATE] = {0};
            if (toron_abaqus_umat_f64(s, kept, &energy, &cut, point[i], values, PROPERTIES, STATE, 3, 3, 1) != 0)
                return 1;
        }
        return 0;
    }
    if (strcmp(entry, "block-state-f64") == 0) {
        block.energies = state[0], block.invariants = state[4], block.failure = state[8];
        block.energies_old = state[0], block.invariants_old = state[4], block.failure_old = state[8];
        return toron_hyperelastic_block_f64(values, PROPERTIES, &block) != 0;
    }
    if (strcmp(entry, "block-stress-f64") == 0)
        return toron_hyperelastic_block_f64(values, PROPERTIES, &block) != 0;
    if (strcmp(entry, "block-state-f32") == 0) {
        single.energies = state_single[0], single.invariants = state_single[4], single.failure = state_single[8];
        single.energies_old = state_single[0], single.invariants_old = state_single[4];
        single.failure_old = state_single[8];
        return toron_hyperelastic_block_f32(values_single, PROPERTIES, &single) != 0;
    }
    if (strcmp(entry, "block-stress-f32") == 0)
        return toron_hyperelastic_block_f32(values_single, PROPERTIES, &single) != 0;
    if (strcmp(entry, "linear-block-f64") == 0) {
        /* From rest to the deformation in one step. */
        static double rest[9][N], linear_state[TORON_LINEAR_ELASTIC_STATE][N];
        double linear[TORON_LINEAR_ELASTIC_PROPERTIES];
        if (toron_preset_f64("kevlar-km2-600-linear", "mm-tonne-s", linear, TORON_LINEAR_ELASTIC_PROPERTIES, NULL) != 0)
            return 2;
        for (int i = 0; i < N; i++)
            rest[0][i] = rest[4][i] = rest[8][i] = 1;
        toron_linear_block_f64 steps = {.n = N, .leading_dimension = N, .f_old = rest[0], .f_new = gradient[0],
                                        .state_old = linear_state[0], .state_new = linear_state[0], .stress = stress[0],
                                        .status = status};
        return toron_linear_elastic_block_f64(linear, TORON_LINEAR_ELASTIC_PROPERTIES, &steps, TORON_ROTATION_FIBRE,
                                              TORON_CRITERION_PRINCIPAL) != 0;
    }
    fprintf(stderr, "%s: no such entry\n", entry);
    return 2;
}
