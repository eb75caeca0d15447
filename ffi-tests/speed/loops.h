/* The loops of loops.c in one precision. Before it: REAL, and NAME(x), x with the precision behind it; BOTH(x), the same of a name
 * of the library. */

/* Points one after the other, for the entries that take one. */
static REAL (*NAME(gradient))[9], (*NAME(state))[STATE], (*NAME(stress))[6], (*NAME(history))[STATE + 9];
/* Component-major: of blocks, with a leading dimension; of a VUMAT and of LS-DYNA's vectors, with n. */
static REAL *NAME(columns), *NAME(states), *NAME(stresses), *NAME(speeds);
static REAL *NAME(stretch), *NAME(state_old), *NAME(state_new), *NAME(corotational), *NAME(zeros), *NAME(ones), *NAME(energies)[2];
static REAL *NAME(histories), *NAME(sig);

/* A group of elements in OpenRadioss. */
typedef struct {
    REAL gradient[9][LENGTH], stress[6][LENGTH], uvar[VARIABLES * GROUP], off[GROUP], speed[GROUP];
} NAME(group);
static NAME(group) *NAME(groups);
static REAL NAME(uparam)[64];
static int32_t NAME(parameters), NAME(variables);

static REAL NAME(properties)[PROPERTIES];
static BOTH(toron_hyperelastic) NAME(law);

static void NAME(set_up)(void)
{
    REAL modulus;
    expect(BOTH(toron_preset)("kevlar-km2-600", "mm-tonne-s", NAME(properties), PROPERTIES, NULL, NULL, 0) == 0, "preset");
    expect(BOTH(toron_hyperelastic_prepare)(&NAME(law), sizeof NAME(law), NAME(properties), PROPERTIES, NULL, 0) == 0, "law");
    /* With the option that says where the fibre comes from: the properties. */
    REAL card[PROPERTIES + 1] = {0};
    memcpy(card, NAME(properties), sizeof NAME(properties));
    expect(BOTH(toron_openradioss_lecm)(1, card, PROPERTIES + 1, NAME(uparam), 64, &NAME(parameters), &NAME(variables),
                                        &modulus, NULL, 0) == 0 && NAME(variables) <= VARIABLES, "OpenRadioss");
}

/* The first n points of the scene, at rest. */
static void NAME(fill)(size_t n)
{
    NAME(gradient) = zeroed(n, sizeof *NAME(gradient));
    NAME(state) = zeroed(n, sizeof *NAME(state));
    NAME(stress) = zeroed(n, sizeof *NAME(stress));
    NAME(history) = zeroed(n, sizeof *NAME(history));
    NAME(columns) = zeroed(9 * stride, sizeof(REAL));
    NAME(states) = zeroed(STATE * stride, sizeof(REAL));
    NAME(stresses) = zeroed(6 * stride, sizeof(REAL));
    NAME(speeds) = zeroed(stride, sizeof(REAL));
    NAME(stretch) = zeroed(6 * n, sizeof(REAL));
    NAME(state_old) = zeroed(STATE * n, sizeof(REAL));
    NAME(state_new) = zeroed(STATE * n, sizeof(REAL));
    NAME(corotational) = zeroed(6 * n, sizeof(REAL));
    NAME(zeros) = zeroed(6 * n, sizeof(REAL));
    NAME(ones) = zeroed(n, sizeof(REAL));
    NAME(energies)[0] = zeroed(n, sizeof(REAL));
    NAME(energies)[1] = zeroed(n, sizeof(REAL));
    /* Behind each other, as in `toron bench`: what shares a set of the cache is then the same. */
    NAME(sig) = zeroed((6 + STATE + 9) * n, sizeof(REAL));
    NAME(histories) = NAME(sig) + 6 * n;
    NAME(groups) = zeroed((n + GROUP - 1) / GROUP, sizeof *NAME(groups));
    for (size_t i = 0; i < n; i++) {
        const double *f = scene[i];
        NAME(group) *group = &NAME(groups)[i / GROUP];
        NAME(ones)[i] = 1;
        group->off[i % GROUP] = 1;
        for (size_t c = 0; c < 9; c++) {
            REAL value = (REAL)f[c];
            NAME(gradient)[i][c] = NAME(history)[i][STATE + c] = value;
            NAME(columns)[c * stride + i] = NAME(histories)[(STATE + c) * n + i] = group->gradient[c][i % GROUP] = value;
        }
        /* The symmetric part, which is a stretch for small shears. */
        static const size_t row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
        for (size_t c = 0; c < 6; c++)
            NAME(stretch)[c * n + i] = (REAL)(0.5 * (f[3 * column[c] + row[c]] + f[3 * row[c] + column[c]]));
    }
}

static void NAME(empty)(void)
{
    free(NAME(gradient)), free(NAME(state)), free(NAME(stress)), free(NAME(history)), free(NAME(columns)), free(NAME(states));
    free(NAME(stresses)), free(NAME(speeds)), free(NAME(stretch)), free(NAME(state_old)), free(NAME(state_new));
    free(NAME(corotational)), free(NAME(zeros)), free(NAME(ones)), free(NAME(energies)[0]), free(NAME(energies)[1]);
    free(NAME(sig)), free(NAME(groups));
}

static void NAME(point)(size_t n)
{
    BOTH(toron_point) point = {.size = sizeof point};
    for (size_t i = 0; i < n; i++) {
        point.deformation_gradient = NAME(gradient)[i];
        point.state_old = point.state_new = NAME(state)[i];
        point.stress = NAME(stress)[i];
        status[i] = BOTH(toron_hyperelastic_point)(&NAME(law), &point, NULL, 0);
    }
}

static void NAME(point_stress)(size_t n)
{
    BOTH(toron_point) point = {.size = sizeof point};
    for (size_t i = 0; i < n; i++) {
        point.deformation_gradient = NAME(gradient)[i];
        point.stress = NAME(stress)[i];
        status[i] = BOTH(toron_hyperelastic_point)(&NAME(law), &point, NULL, 0);
    }
}

static void NAME(point_tangent)(size_t n)
{
    REAL tangent[36];
    BOTH(toron_point) point = {.size = sizeof point, .measure = TORON_TANGENT_MATERIAL, .tangent = tangent};
    for (size_t i = 0; i < n; i++) {
        point.deformation_gradient = NAME(gradient)[i];
        point.state_old = point.state_new = NAME(state)[i];
        point.stress = NAME(stress)[i];
        status[i] = BOTH(toron_hyperelastic_point)(&NAME(law), &point, NULL, 0);
    }
}

static void NAME(point_properties)(size_t n)
{
    BOTH(toron_point) point = {.size = sizeof point};
    for (size_t i = 0; i < n; i++) {
        point.deformation_gradient = NAME(gradient)[i];
        point.state_old = point.state_new = NAME(state)[i];
        point.stress = NAME(stress)[i];
        status[i] = BOTH(toron_hyperelastic_point_with_properties)(NAME(properties), PROPERTIES, &point, NULL, 0);
    }
}

/* n points of the arrays of blocks, from the first one on. */
static BOTH(toron_block) NAME(part)(size_t first, size_t n)
{
    REAL *state = NAME(states) + first;
    BOTH(toron_block) block = {.size = sizeof block, .n = n, .leading_dimension = stride};
    block.deformation_gradient[0] = NAME(columns) + first;
    block.stress[0] = NAME(stresses) + first;
    block.energies_old = block.energies = state;
    block.invariants_old = block.invariants = state + 4 * stride;
    block.failure_old = block.failure = state + 8 * stride;
    block.status = status + first;
    return block;
}

static void NAME(block)(size_t n)
{
    BOTH(toron_block) block = NAME(part)(0, n);
    BOTH(toron_hyperelastic_block)(&NAME(law), &block, NULL, 0);
}

static void NAME(blocks_of_groups)(size_t n)
{
    for (size_t first = 0; first < n; first += GROUP) {
        BOTH(toron_block) block = NAME(part)(first, n - first < GROUP ? n - first : GROUP);
        block.density = 1;
        block.wave_speed = NAME(speeds) + first;
        BOTH(toron_hyperelastic_block)(&NAME(law), &block, NULL, 0);
    }
}

static void NAME(vumat)(size_t n)
{
    const REAL *zeros = NAME(zeros);
    BOTH(toron_vumat) block = {.size = sizeof block, .nblock = (int32_t)n, .ndir = 3, .nshr = 3, .nstatev = STATE,
                               .nprops = PROPERTIES, .step_time = 1, .total_time = 1, .props = NAME(properties),
                               .density = NAME(ones), .strain_inc = zeros, .stretch_old = NAME(stretch),
                               .stretch_new = NAME(stretch), .stress_old = zeros, .state_old = NAME(state_old),
                               .ener_intern_old = zeros, .ener_inelas_old = zeros, .stress_new = NAME(corotational),
                               .state_new = NAME(state_new), .ener_intern_new = NAME(energies)[0],
                               .ener_inelas_new = NAME(energies)[1]};
    BOTH(toron_abaqus_vumat)(&block, NULL, 0);
    /* As Abaqus does from step to step. */
    REAL *new = NAME(state_new);
    NAME(state_new) = NAME(state_old), NAME(state_old) = new;
}

static void NAME(lsdyna)(size_t n)
{
    for (size_t i = 0; i < n; i++)
        BOTH(toron_lsdyna_umat)(NAME(properties), NAME(stress)[i], NAME(history)[i], STATE, &status[i], NULL, 0);
}

static void NAME(lsdyna_vector)(size_t n)
{
    REAL *sig = NAME(sig);
    BOTH(toron_lsdyna_umat_vector)(NAME(properties), sig, sig + n, sig + 2 * n, sig + 3 * n, sig + 4 * n, sig + 5 * n,
                                   NAME(histories), STATE, 1, (int32_t)n, (int32_t)n, status, NULL, 0);
}

static void NAME(openradioss)(size_t n)
{
    const REAL density = 1;
    for (size_t first = 0; first < n; first += GROUP) {
        NAME(group) *g = &NAME(groups)[first / GROUP];
        REAL(*f)[LENGTH] = g->gradient, (*s)[LENGTH] = g->stress;
        BOTH(toron_openradioss_luser)((int32_t)(n - first < GROUP ? n - first : GROUP), NAME(parameters), NAME(variables), (REAL)1e-6,
                                      NAME(uparam), NULL, &density, f[0], f[4], f[8], f[3], f[7], f[2], f[1], f[5], f[6], s[0],
                                      s[1], s[2], s[3], s[4], s[5], NULL, NULL, NULL, NULL, NULL, NULL, g->speed, NULL, g->uvar,
                                      g->off, NULL, NULL, 0);
    }
}
