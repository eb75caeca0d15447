/* Calls of the entries of the laws and of the library about itself. */
#ifndef ENVIRONMENT_LAWS_H
#define ENVIRONMENT_LAWS_H

#include "environment.h"
#include "environment_inputs.h"

/* Which of the combinations below are run: every one, or one in so many. */
static size_t stride = 1;

/* ---- The library about itself, and its presets */

#ifndef SINGLE
static void version(void)
{
    RUN("toron_version()", answer = (int64_t)strlen(toron_version()));
}

static void abi_version(void)
{
    CALL(toron_abi_version());
}

static void status_message(void)
{
    for (int32_t status = -310; status < 3; status++)
        CALL(toron_status_message(status, MESSAGE));
    CALL(toron_status_message(TORON_INVERTED, NULL, 0));
}

static void property_count(void)
{
    for (int32_t law = -1; law < 3; law++)
        CALL(toron_property_count(law, MESSAGE));
}

static void state_count(void)
{
    for (int32_t law = -1; law < 3; law++)
        CALL(toron_state_count(law, MESSAGE));
}

static toron_table_row *new_row(void)
{
    toron_table_row *row = opaque(sizeof *row);
    row->size = sizeof *row;
    return row;
}

static void property(void)
{
    toron_table_row *row = new_row();
    for (int32_t law = -1; law < 3; law++)
        for (int32_t index = -1; index < 12; index++)
            CALL(toron_property(law, index, row, MESSAGE));
    CALL(toron_property(0, 0, NULL, MESSAGE));
    row->size = 7;
    CALL(toron_property(0, 0, row, MESSAGE));
}

static void state_variable(void)
{
    toron_table_row *row = new_row();
    for (int32_t law = -1; law < 3; law++)
        for (int32_t index = -1; index < 12; index++)
            CALL(toron_state_variable(law, index, row, MESSAGE));
    CALL(toron_state_variable(0, 0, NULL, MESSAGE));
}

static void property_index(void)
{
    CALL(toron_property_index(TORON_HYPERELASTIC, "eps_lim", MESSAGE));
    CALL(toron_property_index(TORON_LINEAR_ELASTIC, "nothing", MESSAGE));
    CALL(toron_property_index(7, NULL, MESSAGE));
}

static void state_index(void)
{
    CALL(toron_state_index(TORON_HYPERELASTIC, "alive", MESSAGE));
    CALL(toron_state_index(TORON_LINEAR_ELASTIC, "nothing", MESSAGE));
    CALL(toron_state_index(7, NULL, MESSAGE));
}
#endif

static void preset(void)
{
    const char *const names[] = {"kevlar-km2-600", "kevlar-km2-600-linear", "kevlar-km2-600-frictional", "nylon", NULL};
    const char *const units[] = {"si", "mm-tonne-s", "mm-kg-ms", "cm-g-us", "ft-lb-s", NULL};
    real *values = reals(RUBBING), *density = reals(1);
    for (size_t i = 0; i < COUNT(names); i++)
        for (size_t k = 0; k < COUNT(units); k++)
            for (size_t count = 9; count < 14; count++) {
                CALL(ENTRY(toron_preset)(names[i], units[k], values, count, density, MESSAGE));
                CALL(ENTRY(toron_preset)(names[i], units[k], NULL, count, NULL, MESSAGE));
            }
}

/* ---- The hyperelastic law */

static void hyperelastic_prepare(void)
{
#define PREPARE ENTRY(toron_hyperelastic_prepare)
    for (size_t y = 0; y < COUNT(yarns); y++) {
        real *yarn = given(yarns[y], PROPERTIES);
        toron_hyperelastic *law = opaque(sizeof *law);
        ARGUMENTS("yarn %zu", y);
        CALL(PREPARE(law, sizeof *law, yarn, PROPERTIES, MESSAGE));
        CALL(PREPARE(law, 3, yarn, PROPERTIES, MESSAGE));
        CALL(PREPARE(law, sizeof *law, yarn, 3, MESSAGE));
        CALL(PREPARE(law, sizeof *law, NULL, PROPERTIES, MESSAGE));
        CALL(PREPARE(NULL, sizeof *law, yarn, PROPERTIES, MESSAGE));
        release();
    }
}

/* A prepared law, or one that is not, where the properties are refused. */
static toron_hyperelastic *law_of(const real *yarn)
{
    toron_hyperelastic *law = opaque(sizeof *law);
    memset(law, 0, sizeof *law);
    PREPARE(law, sizeof *law, yarn, PROPERTIES, NULL, 0);
    return law;
}

/* What one point gets. Without an old state, each fibre direction is tried. */
typedef struct {
    real *yarn, *f, *fibre, *old, *new, *stress;
} point_arrays;

/* The next combination of yarn, deformation, and old state or fibre; false after the last one. */
static int next_point(size_t *next, point_arrays *p)
{
    size_t variants = 1 + COUNT(states) + COUNT(fibres), of_a_yarn = variants * DEFORMATIONS, rest = *next;
    size_t v = 0, d = 1, y = GOOD_YARNS;
    release();
    if (rest < GOOD_YARNS * of_a_yarn)
        v = rest % variants, d = rest / variants % DEFORMATIONS, y = rest / of_a_yarn;
    else
        y += rest - GOOD_YARNS * of_a_yarn; /* refused, whatever comes with it */
    if (y >= COUNT(yarns))
        return 0;
    *next += stride;
    *p = (point_arrays){.yarn = given(yarns[y], PROPERTIES), .f = given(deformations[d], 9), .new = reals(STATE), .stress = reals(6)};
    if (v >= 1 && v <= COUNT(states))
        p->old = given(states[v - 1], STATE);
    else if (v > 0)
        p->fibre = given(fibres[v - 1 - COUNT(states)], 3);
    ARGUMENTS("yarn %zu, F %zu, old state or fibre %zu", y, d, v);
    return 1;
}

/* With a prepared law, or with properties. */
static void points(int with_properties)
{
#define POINT ENTRY(toron_hyperelastic_point)
#define POINT_WITH ENTRY(toron_hyperelastic_point_with_properties)
#define EVALUATE_POINT(point)                                            \
    do {                                                                 \
        if (with_properties)                                             \
            CALL(POINT_WITH(p.yarn, PROPERTIES, point, MESSAGE));        \
        else                                                             \
            CALL(POINT(law, point, MESSAGE));                            \
    } while (0)
    point_arrays p;
    for (size_t next = 0; next_point(&next, &p);) {
        const toron_hyperelastic *law = law_of(p.yarn);
        const toron_point all = {.size = sizeof all, .level = at_level((int32_t)(next % 4)), .density = densities[0],
                                 .deformation_gradient = p.f,
                                 .fibre = p.fibre, .state_old = p.old, .state_new = p.new, .stress = p.stress, .modes = reals(24),
                                 .wave_speed = reals(1)};
        toron_point point = all;
        EVALUATE_POINT(&all);
        put_double(&point.density, densities[next % COUNT(densities)]);
        EVALUATE_POINT(&point);
        point.modes = NULL, point.wave_speed = NULL;
        EVALUATE_POINT(&point);
        point.state_new = NULL;
        EVALUATE_POINT(&point);
        point.stress = NULL;
        EVALUATE_POINT(&point);
        point.state_new = p.new, point.modes = all.modes;
        EVALUATE_POINT(&point);

        point = all, point.tangent = reals(81);
        for (point.measure = -1; point.measure < 5; point.measure++)
            EVALUATE_POINT(&point);
        point = (toron_point){.size = sizeof point, .measure = TORON_TANGENT_JAUMANN, .level = at_level(TORON_LEVEL_BEST),
                              .deformation_gradient = p.f, .fibre = p.fibre, .state_old = p.old, .tangent = point.tangent};
        EVALUATE_POINT(&point);
        point.level = 4;
        EVALUATE_POINT(&point);
        point.deformation_gradient = NULL;
        EVALUATE_POINT(&point);
        point.size = 3;
        EVALUATE_POINT(&point);
        EVALUATE_POINT(NULL);
        if (with_properties) {
            CALL(POINT_WITH(p.yarn, 3, &all, MESSAGE));
            CALL(POINT_WITH(NULL, PROPERTIES, &all, MESSAGE));
        } else {
            CALL(POINT(NULL, &all, MESSAGE));
        }
    }
}

static void hyperelastic_point(void)
{
    points(0);
}

static void hyperelastic_point_with_properties(void)
{
    points(1);
}

#ifndef SINGLE
static void least_acoustic_eigenvalue(void)
{
#define EIGENVALUE toron_hyperelastic_least_acoustic_eigenvalue_f64
    point_arrays p;
    for (size_t next = 0; next_point(&next, &p);) {
        real *least = reals(1), *direction = reals(3);
        if (p.old != NULL || (p.fibre != NULL && next % 4 != 0)) /* a search over all directions takes its time */
            continue;
        const toron_hyperelastic *law = law_of(p.yarn);
        const toron_point point = {.size = sizeof point, .deformation_gradient = p.f,
                                   .fibre = p.fibre}, none = {.size = sizeof none};
        CALL(EIGENVALUE(law, &point, least, direction, MESSAGE));
        CALL(EIGENVALUE(law, &none, least, direction, MESSAGE));
        CALL(EIGENVALUE(law, NULL, least, direction, MESSAGE));
    }
}
#endif

/* ---- Blocks. All kinds of points side by side, good ones, or all at rest: lanes that are left over are no point's. */

static const size_t sizes[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 17, 64};
static const size_t points_of[] = {DEFORMATIONS, GOOD_DEFORMATIONS, REST};
static const char *const kinds_of_points[] = {"all kinds", "good", "at rest"};

/* Which yarn, points and instructions. */
typedef struct {
    size_t yarn, size, points;
    int32_t level;
} block_case;

/* The next one; the yarns from `good` to `yarn_count` are refused, whatever comes with them. */
static int next_block(size_t *next, size_t good, size_t yarn_count, block_case *b)
{
    enum { LEVELS = 6 }; /* -1 and 4 are none */
    size_t rest = *next, of_a_yarn = LEVELS * COUNT(points_of) * COUNT(sizes);
    release();
    *b = (block_case){.yarn = good, .size = 5, .points = 0, .level = TORON_LEVEL_BEST};
    if (rest < good * of_a_yarn) {
        b->level = (int32_t)(rest % LEVELS) - 1, rest /= LEVELS;
        b->points = rest % COUNT(points_of), rest /= COUNT(points_of);
        b->size = sizes[rest % COUNT(sizes)], rest /= COUNT(sizes);
        b->yarn = rest;
    } else {
        b->yarn += rest - good * of_a_yarn;
    }
    ARGUMENTS("yarn %zu, %zu points, %s, level %d", b->yarn, b->size, kinds_of_points[b->points], b->level);
    return *next += stride, b->yarn < yarn_count;
}

/* A block with all that there can be but a tangent. */
static toron_block hyperelastic_arrays(const block_case *b, size_t next)
{
    size_t n = b->size, old_states = b->points == 0 ? COUNT(states) : 3;
    real *old = by_component(states[0], STATE, old_states, next, n), *new = reals(STATE * n);
    return (toron_block){.size = sizeof(toron_block), .n = n, .leading_dimension = n, .level = at_level(b->level), .density = densities[0],
                         .deformation_gradient = {by_component(deformations[0], 9, points_of[b->points], next, n)},
                         .fibre = {by_component(fibres[0], 3, b->points == 0 ? COUNT(fibres) : 5, next, n)},
                         .energies_old = old, .invariants_old = old + INVARIANTS * n, .failure_old = old + FAILURE * n,
                         .stress = {reals(6 * n)}, .energies = new, .invariants = new + INVARIANTS * n,
                         .failure = new + FAILURE * n, .modes = reals(24 * n), .wave_speed = reals(n), .active = reals(n),
                         .status = guarded(n * sizeof(int32_t))};
}

/* The ways to ask: everything; without each of fibres, old state, failure; the usual ones of a solver; no output at all. */
enum { REQUESTS = 9 };

static toron_block requested(toron_block block, int which)
{
    if (which == 1 || which >= 4)
        block.fibre[0] = NULL;
    if (which == 2 || which == 5 || which == 6)
        block.energies_old = block.invariants_old = block.failure_old = NULL;
    if (which == 3 || which == 5 || which >= 7)
        block.failure = NULL;
    if (which >= 4)
        block.modes = NULL, block.wave_speed = NULL;
    if (which >= 7)
        block.energies = block.invariants = NULL;
    if (which == 8)
        block.stress[0] = NULL, block.status = NULL, block.active = NULL;
    return block;
}

/* The same points, with the components of each next to each other: evaluated in copies. */
static toron_block by_points(toron_block block)
{
    size_t n = block.n;
    real *f = reals(9 * n), *out = reals(6 * n);
    for (size_t i = 0; i < n; i++)
        for (size_t c = 0; c < 9; c++)
            memcpy(&f[9 * i + c], &block.deformation_gradient[0][c * n + i], sizeof *f);
    block.deformation_gradient[0] = f, block.deformation_gradient_layout = (toron_layout){1, 9};
    block.stress[0] = out, block.stress_layout = (toron_layout){1, 6};
    return block;
}

static void blocks(int with_properties)
{
#define BLOCK ENTRY(toron_hyperelastic_block)
#define BLOCK_WITH ENTRY(toron_hyperelastic_block_with_properties)
#define EVALUATE_BLOCK(block)                                            \
    do {                                                                 \
        if (with_properties)                                             \
            CALL(BLOCK_WITH(yarn, PROPERTIES, block, MESSAGE));          \
        else                                                             \
            CALL(BLOCK(law, block, MESSAGE));                            \
    } while (0)
    block_case b;
    for (size_t next = 0; next_block(&next, GOOD_YARNS, COUNT(yarns), &b);) {
        real *yarn = given(yarns[b.yarn], PROPERTIES), *tangent = reals(81 * b.size);
        const toron_hyperelastic *law = law_of(yarn);
        const toron_block all = hyperelastic_arrays(&b, next);
        for (int which = 0; which < REQUESTS; which++) {
            const toron_block block = requested(all, which);
            EVALUATE_BLOCK(&block);
        }
        for (int32_t measure = -1; measure < 5; measure++)
            for (int which = 0; which < 5; which += 4) {
                toron_block block = requested(all, which);
                block.measure = measure, block.tangent = tangent;
                EVALUATE_BLOCK(&block);
            }
        toron_block least = requested(all, 8), wrong = all;
        least.measure = TORON_TANGENT_JAUMANN, least.tangent = tangent;
        EVALUATE_BLOCK(&least);
        const toron_block points = by_points(all);
        EVALUATE_BLOCK(&points);
        put_double(&wrong.density, densities[next % COUNT(densities)]);
        EVALUATE_BLOCK(&wrong);
        wrong = all, wrong.leading_dimension = 1;
        EVALUATE_BLOCK(&wrong);
        wrong = all, wrong.deformation_gradient[0] = NULL;
        EVALUATE_BLOCK(&wrong);
        wrong = all, wrong.size = 3;
        EVALUATE_BLOCK(&wrong);
        EVALUATE_BLOCK(NULL);
        if (with_properties) {
            CALL(BLOCK_WITH(yarn, 3, &all, MESSAGE));
            CALL(BLOCK_WITH(NULL, PROPERTIES, &all, MESSAGE));
        } else {
            CALL(BLOCK(NULL, &all, MESSAGE));
        }
    }
}

static void hyperelastic_block(void)
{
    blocks(0);
}

static void hyperelastic_block_with_properties(void)
{
    blocks(1);
}

/* ---- The linear elastic law */

static void linear_elastic_prepare(void)
{
#define PREPARE_LINEAR ENTRY(toron_linear_elastic_prepare)
    for (size_t y = 0; y < COUNT(linear_yarns); y++) {
        real *yarn = given(linear_yarns[y], LINEAR);
        toron_linear_elastic *law = opaque(sizeof *law);
        ARGUMENTS("yarn %zu", y);
        CALL(PREPARE_LINEAR(law, sizeof *law, yarn, LINEAR, MESSAGE));
        CALL(PREPARE_LINEAR(law, 3, yarn, LINEAR, MESSAGE));
        CALL(PREPARE_LINEAR(law, sizeof *law, yarn, 3, MESSAGE));
        CALL(PREPARE_LINEAR(NULL, sizeof *law, yarn, LINEAR, MESSAGE));
        release();
    }
}

static toron_linear_elastic *linear_law_of(const real *yarn)
{
    toron_linear_elastic *law = opaque(sizeof *law);
    memset(law, 0, sizeof *law);
    PREPARE_LINEAR(law, sizeof *law, yarn, LINEAR, NULL, 0);
    return law;
}

static void linear_elastic_axes(void)
{
#define AXES ENTRY(toron_linear_elastic_axes)
    for (size_t y = 0; y < COUNT(linear_yarns); y++)
        for (size_t k = 0; k < COUNT(fibres); k++) {
            const toron_linear_elastic *law = linear_law_of(given(linear_yarns[y], LINEAR));
            real *fibre = given(fibres[k], 3), *second = given(fibres[(k + y) % COUNT(fibres)], 3), *axes = reals(9);
            ARGUMENTS("yarn %zu, fibre %zu", y, k);
            CALL(AXES(law, NULL, NULL, axes, MESSAGE));
            CALL(AXES(law, fibre, NULL, axes, MESSAGE));
            CALL(AXES(law, fibre, second, axes, MESSAGE));
            CALL(AXES(law, fibre, second, NULL, MESSAGE));
            CALL(AXES(NULL, fibre, second, axes, MESSAGE));
            release();
        }
}

/* From rest and from two other deformations, one of them at fault, to each; the old state null or any. A point with all that there can
 * be but a tangent; its properties. */
static int next_step(size_t *next, real **yarn, toron_linear_point *point)
{
    static const size_t starts[] = {0, 3, 18};
    size_t states_of = COUNT(linear_states) + 1, of_a_yarn = DEFORMATIONS * COUNT(starts) * states_of, rest = *next;
    size_t to = 1, from = 0, state = 0, y = GOOD_LINEAR_YARNS;
    release();
    if (rest < GOOD_LINEAR_YARNS * of_a_yarn) {
        to = rest % DEFORMATIONS, rest /= DEFORMATIONS;
        from = rest % COUNT(starts), rest /= COUNT(starts);
        state = rest % states_of, y = rest / states_of;
    } else {
        y += rest - GOOD_LINEAR_YARNS * of_a_yarn; /* refused, whatever comes with it */
    }
    if (y >= COUNT(linear_yarns))
        return 0;
    *next += stride;
    *yarn = given(linear_yarns[y], LINEAR);
    *point = (toron_linear_point){.size = sizeof *point, .level = (int32_t)(*next % 4), .density = densities[0],
                                  .f_old = given(deformations[starts[from]], 9), .f_new = given(deformations[to], 9),
                                  .fibre = given(fibres[*next % COUNT(fibres)], 3), .second_axis = given(fibres[*next % 2], 3),
                                  .axes = given(axes_in_space[*next % COUNT(axes_in_space)], 9), .state_new = reals(LINEAR_STATE),
                                  .stress = reals(6), .wave_speed = reals(1)};
    if (state > 0)
        point->state_old = given(linear_states[state - 1], LINEAR_STATE);
    ARGUMENTS("yarn %zu, F %zu to %zu, old state %zu, axes %zu, fibre %zu", y, starts[from], to, state,
              *next % COUNT(axes_in_space),
              *next % COUNT(fibres));
    return 1;
}

static void linear_points(int with_properties)
{
#define LINEAR_POINT ENTRY(toron_linear_elastic_point)
#define LINEAR_POINT_WITH ENTRY(toron_linear_elastic_point_with_properties)
#define EVALUATE_LINEAR_POINT(point)                                     \
    do {                                                                 \
        if (with_properties)                                             \
            CALL(LINEAR_POINT_WITH(yarn, LINEAR, point, MESSAGE));       \
        else                                                             \
            CALL(LINEAR_POINT(law, point, MESSAGE));                     \
    } while (0)
    real *yarn;
    toron_linear_point all;
    for (size_t next = 0; next_step(&next, &yarn, &all);) {
        at_level(all.level);
        const toron_linear_elastic *law = linear_law_of(yarn);
        toron_linear_point point = all;
        for (point.rotation = -1; point.rotation < 4; point.rotation++)
            for (point.criterion = 0; point.criterion < 2; point.criterion++) {
                point.fibre = NULL;
                EVALUATE_LINEAR_POINT(&point);
                point.fibre = all.fibre;
                EVALUATE_LINEAR_POINT(&point);
            }
        point = all, point.rotation = TORON_ROTATION_POLAR, point.criterion = 2;
        EVALUATE_LINEAR_POINT(&point);
        point = all, point.state_new = NULL, point.wave_speed = NULL, point.axes = NULL, point.second_axis = NULL;
        EVALUATE_LINEAR_POINT(&point);
        point = all;
        put_double(&point.density, densities[next % COUNT(densities)]);
        EVALUATE_LINEAR_POINT(&point);
        point = all, point.f_new = NULL;
        EVALUATE_LINEAR_POINT(&point);
        EVALUATE_LINEAR_POINT(NULL);

        point = all, point.tangent = reals(81), point.criterion = (int32_t)(next % 2);
        for (point.rotation = 0; point.rotation < 3; point.rotation++)
            for (point.measure = 0; point.measure < 4; point.measure++)
                EVALUATE_LINEAR_POINT(&point);
        point.rotation = TORON_ROTATION_FIBRE, point.fibre = NULL, point.stress = NULL;
        EVALUATE_LINEAR_POINT(&point);
        if (with_properties)
            CALL(LINEAR_POINT_WITH(yarn, 3, &all, MESSAGE));
        else
            CALL(LINEAR_POINT(NULL, &all, MESSAGE));
    }
}

static void linear_elastic_point(void)
{
    linear_points(0);
}

static void linear_elastic_point_with_properties(void)
{
    linear_points(1);
}

static void linear_elastic_increment(void)
{
#define INCREMENT ENTRY(toron_linear_elastic_increment)
    static const double strains[][6] = {
        {0}, {1e-3, 2e-3, -1e-3, 5e-4, 0, -5e-4}, {0.05, 0, 0, 0, 0, 0}, {-0.01, 0, 0, 60, 0, 0}, {SUBNORMAL, TINY, 0, 0, 0, 0},
        {HUGE_NUMBER, 0, 0, HUGE_NUMBER, 0, 0}, {0, NAN, 0, 0, 0, 0}, {0, 0, SIGNALLING, 0, 0, 0}, {INFINITY, 0, 0, 0, 0, 0},
    };
    static const double jacobians[] = {1, 0, SUBNORMAL, HUGE_NUMBER, -1, NAN, SIGNALLING};
    const size_t states_of = COUNT(linear_states) + 1;
    for (size_t next = 0; next < COUNT(linear_yarns) * COUNT(strains) * states_of; next += stride) {
        size_t state = next % states_of, k = next / states_of % COUNT(strains), y = next / states_of / COUNT(strains);
        const toron_linear_elastic *law = linear_law_of(given(linear_yarns[y], LINEAR));
        toron_linear_increment increment = {.size = sizeof increment, .strain = given(strains[k], 6),
                                            .state_old = state == 0 ? NULL : given(linear_states[state - 1], LINEAR_STATE),
                                            .state_new = reals(LINEAR_STATE), .stress = reals(6)};
        ARGUMENTS("yarn %zu, strain %zu, old state %zu", y, k, state);
        for (size_t j = 0; j < COUNT(jacobians); j++) {
            put_double(&increment.jacobian, jacobians[j]);
            for (increment.criterion = -1; increment.criterion < 2; increment.criterion++)
                CALL(INCREMENT(law, &increment, MESSAGE));
        }
        increment.criterion = 0, increment.state_new = NULL, increment.stress = NULL;
        CALL(INCREMENT(law, &increment, MESSAGE));
        increment.strain = NULL;
        CALL(INCREMENT(law, &increment, MESSAGE));
        CALL(INCREMENT(law, NULL, MESSAGE));
        release();
    }
}

static void linear_blocks(int with_properties)
{
#define LINEAR_BLOCK ENTRY(toron_linear_elastic_block)
#define LINEAR_BLOCK_WITH ENTRY(toron_linear_elastic_block_with_properties)
#define EVALUATE_LINEAR_BLOCK(block)                                     \
    do {                                                                 \
        if (with_properties)                                             \
            CALL(LINEAR_BLOCK_WITH(yarn, LINEAR, block, MESSAGE));       \
        else                                                             \
            CALL(LINEAR_BLOCK(law, block, MESSAGE));                     \
    } while (0)
    block_case b;
    for (size_t next = 0; next_block(&next, GOOD_LINEAR_YARNS, COUNT(linear_yarns), &b);) {
        size_t n = b.size, old_states = b.points == 0 ? COUNT(linear_states) : 3;
        real *yarn = given(linear_yarns[b.yarn], LINEAR), *old = by_component(linear_states[0], LINEAR_STATE, old_states, next, n);
        real *f_old = by_component(deformations[0], 9, b.points == 0 ? GOOD_DEFORMATIONS + 1 : REST, next + 1, n);
        const toron_linear_elastic *law = linear_law_of(yarn);
        const toron_linear_block all = {
            .size = sizeof all, .n = n, .leading_dimension = n, .level = at_level(b.level), .density = densities[0],
            .f_old = {f_old},
            .f_new = {by_component(deformations[0], 9, points_of[b.points], next, n)},
            .fibre = {by_component(fibres[0], 3, b.points == 0 ? COUNT(fibres) : 2, next, n)},
            .axes = by_component(axes_in_space[0], 9, b.points == 0 ? COUNT(axes_in_space) : 2, next, n), .state_old = old,
            .state_new = reals(LINEAR_STATE * n), .stress = {reals(6 * n)}, .wave_speed = reals(n), .active = reals(n),
            .status = guarded(n * sizeof(int32_t))};
        toron_linear_block fresh = all, least = all, wrong = all, tangent = all;
        fresh.state_old = NULL, fresh.fibre[0] = NULL, fresh.wave_speed = NULL;
        for (int32_t rotation = -1; rotation < 4; rotation++)
            for (int32_t criterion = -1; criterion < 3; criterion++) {
                toron_linear_block block = all;
                block.rotation = fresh.rotation = rotation, block.criterion = fresh.criterion = criterion;
                EVALUATE_LINEAR_BLOCK(&block);
                EVALUATE_LINEAR_BLOCK(&fresh);
            }
        tangent.tangent = reals(81 * n), tangent.measure = (int32_t)(next % 4);
        for (tangent.rotation = 0; tangent.rotation < 3; tangent.rotation++)
            EVALUATE_LINEAR_BLOCK(&tangent);
        least.state_new = NULL, least.status = NULL, least.active = NULL, least.wave_speed = NULL, least.rotation = TORON_ROTATION_SPIN;
        EVALUATE_LINEAR_BLOCK(&least);
        wrong.leading_dimension = 1;
        EVALUATE_LINEAR_BLOCK(&wrong);
        EVALUATE_LINEAR_BLOCK(NULL);
        if (with_properties)
            CALL(LINEAR_BLOCK_WITH(yarn, 3, &all, MESSAGE));
        else
            CALL(LINEAR_BLOCK(NULL, &all, MESSAGE));
    }
}

static void linear_elastic_block(void)
{
    linear_blocks(0);
}

static void linear_elastic_block_with_properties(void)
{
    linear_blocks(1);
}

#endif
