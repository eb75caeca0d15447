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
    CALL(toron_version());
}

static void abi_version(void)
{
    CALL(toron_abi_version());
}

static void status_message(void)
{
    char *text = guarded(100);
    for (int32_t status = -310; status < 3; status++)
        CALL(toron_status_message(status, text, 100));
    CALL(toron_status_message(TORON_INVERTED, NULL, 0));
}

static void property_count(void)
{
    for (int32_t law = -1; law < 3; law++)
        CALL(toron_property_count(law));
}

static void state_count(void)
{
    for (int32_t law = -1; law < 3; law++)
        CALL(toron_state_count(law));
}

/* All of a row but the bytes behind its last member, which have no meaning. */
#define ROW_BYTES (offsetof(toron_table_row, meaning) + sizeof((toron_table_row *)0)->meaning)

static void property(void)
{
    toron_table_row row = {0};
    unsigned char *copy = guarded(ROW_BYTES);
    for (int32_t law = -1; law < 3; law++)
        for (int32_t index = -1; index < 12; index++)
            RUN("toron_property()", answer = toron_property(law, index, &row); memcpy(copy, &row, ROW_BYTES));
    CALL(toron_property(0, 0, NULL));
}

static void state_variable(void)
{
    toron_table_row row = {0};
    unsigned char *copy = guarded(ROW_BYTES);
    for (int32_t law = -1; law < 3; law++)
        for (int32_t index = -1; index < 12; index++)
            RUN("toron_state_variable()", answer = toron_state_variable(law, index, &row); memcpy(copy, &row, ROW_BYTES));
    CALL(toron_state_variable(0, 0, NULL));
}

static void property_index(void)
{
    CALL(toron_property_index(TORON_HYPERELASTIC, "eps_lim"));
    CALL(toron_property_index(TORON_LINEAR_ELASTIC, "nothing"));
    CALL(toron_property_index(7, NULL));
}

static void state_index(void)
{
    CALL(toron_state_index(TORON_HYPERELASTIC, "alive"));
    CALL(toron_state_index(TORON_LINEAR_ELASTIC, "nothing"));
    CALL(toron_state_index(7, NULL));
}
#endif

static void preset(void)
{
    const char *const names[] = {"kevlar-km2-600", "kevlar-km2-600-linear", "nylon", NULL};
    const char *const units[] = {"si", "mm-tonne-s", "mm-kg-ms", "cm-g-us", "ft-lb-s", NULL};
    real *values = reals(PROPERTIES), *density = reals(1);
    for (size_t i = 0; i < COUNT(names); i++)
        for (size_t k = 0; k < COUNT(units); k++)
            for (size_t count = 9; count < 13; count++) {
                CALL(ENTRY(toron_preset)(names[i], units[k], values, count, density));
                CALL(ENTRY(toron_preset)(names[i], units[k], NULL, count, NULL));
            }
}

/* ---- The hyperelastic law */

static void hyperelastic_validate(void)
{
    for (size_t y = 0; y < COUNT(yarns); y++) {
        real *yarn = given(yarns[y], PROPERTIES);
        char *text = guarded(200);
        int32_t *status = guarded(sizeof *status);
        ARGUMENTS("yarn %zu", y);
        CALL(ENTRY(toron_hyperelastic_validate)(yarn, PROPERTIES, text, 200, status));
        CALL(ENTRY(toron_hyperelastic_validate)(yarn, 3, text, 200, NULL));
        CALL(ENTRY(toron_hyperelastic_validate)(NULL, PROPERTIES, NULL, 0, status));
        release();
    }
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

static void hyperelastic_point(void)
{
#define POINT ENTRY(toron_hyperelastic_point)
    point_arrays p;
    for (size_t next = 0; next_point(&next, &p);) {
        real *modes = reals(24), *speed = reals(1);
        const real density = densities[0], other = densities[next % COUNT(densities)];
        CALL(POINT(p.yarn, PROPERTIES, p.f, p.fibre, p.old, p.new, p.stress, modes, density, speed));
        CALL(POINT(p.yarn, PROPERTIES, p.f, p.fibre, p.old, p.new, p.stress, NULL, other, NULL));
        CALL(POINT(p.yarn, PROPERTIES, p.f, p.fibre, p.old, NULL, p.stress, NULL, other, NULL));
        CALL(POINT(p.yarn, PROPERTIES, p.f, p.fibre, p.old, p.new, NULL, modes, other, NULL));
        CALL(POINT(p.yarn, PROPERTIES, p.f, p.fibre, p.old, NULL, NULL, NULL, other, speed));
        CALL(POINT(p.yarn, 3, p.f, p.fibre, p.old, p.new, p.stress, NULL, other, NULL));
        CALL(POINT(p.yarn, PROPERTIES, NULL, p.fibre, p.old, p.new, p.stress, NULL, other, NULL));
        CALL(POINT(NULL, PROPERTIES, p.f, p.fibre, p.old, p.new, p.stress, NULL, other, NULL));
    }
}

static void hyperelastic_point_tangent(void)
{
#define POINT_TANGENT ENTRY(toron_hyperelastic_point_tangent)
    point_arrays p;
    for (size_t next = 0; next_point(&next, &p);) {
        real *tangent = reals(81);
        for (int32_t measure = -1; measure < 5; measure++)
            CALL(POINT_TANGENT(p.yarn, PROPERTIES, p.f, p.fibre, p.old, p.new, p.stress, measure, tangent));
        CALL(POINT_TANGENT(p.yarn, PROPERTIES, p.f, p.fibre, p.old, NULL, NULL, TORON_TANGENT_JAUMANN, tangent));
        CALL(POINT_TANGENT(p.yarn, PROPERTIES, p.f, p.fibre, p.old, p.new, p.stress, TORON_TANGENT_JAUMANN, NULL));
    }
}

#ifndef SINGLE
static void least_acoustic_eigenvalue(void)
{
    point_arrays p;
    for (size_t next = 0; next_point(&next, &p);) {
        real *least = reals(1), *direction = reals(3);
        if (p.old != NULL || (p.fibre != NULL && next % 4 != 0)) /* a search over all directions takes its time */
            continue;
        CALL(toron_hyperelastic_least_acoustic_eigenvalue_f64(p.yarn, PROPERTIES, p.f, p.fibre, least, direction));
        CALL(toron_hyperelastic_least_acoustic_eigenvalue_f64(p.yarn, PROPERTIES, NULL, p.fibre, least, direction));
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

/* A block with all that there can be. */
static toron_block hyperelastic_arrays(const block_case *b, size_t next)
{
    size_t n = b->size, old_states = b->points == 0 ? COUNT(states) : 3;
    real *old = by_component(states[0], STATE, old_states, next, n), *new = reals(STATE * n);
    return (toron_block){.n = n, .leading_dimension = n, .fibre = by_component(fibres[0], 3, b->points == 0 ? COUNT(fibres) : 5, next, n),
                         .deformation_gradient = by_component(deformations[0], 9, points_of[b->points], next, n),
                         .energies_old = old, .invariants_old = old + INVARIANTS * n, .failure_old = old + FAILURE * n,
                         .density = densities[0], .stress = reals(6 * n), .energies = new, .invariants = new + INVARIANTS * n,
                         .failure = new + FAILURE * n, .modes = reals(24 * n), .wave_speed = reals(n),
                         .status = guarded(n * sizeof(int32_t)), .level = b->level};
}

/* The ways to ask: everything; without each of fibres, old state, failure; the usual ones of a solver; no output at all. */
enum { REQUESTS = 9 };

static toron_block request(toron_block block, int which)
{
    if (which == 1 || which >= 4)
        block.fibre = NULL;
    if (which == 2 || which == 5 || which == 6)
        block.energies_old = block.invariants_old = block.failure_old = NULL;
    if (which == 3 || which == 5 || which >= 7)
        block.failure = NULL;
    if (which >= 4)
        block.modes = NULL, block.wave_speed = NULL;
    if (which >= 7)
        block.energies = block.invariants = NULL;
    if (which == 8)
        block.stress = NULL, block.status = NULL;
    return block;
}

static void hyperelastic_block(void)
{
#define BLOCK ENTRY(toron_hyperelastic_block)
    block_case b;
    for (size_t next = 0; next_block(&next, GOOD_YARNS, COUNT(yarns), &b);) {
        real *yarn = given(yarns[b.yarn], PROPERTIES);
        const toron_block all = hyperelastic_arrays(&b, next);
        for (int which = 0; which < REQUESTS; which++) {
            const toron_block block = request(all, which);
            CALL(BLOCK(yarn, PROPERTIES, &block));
        }
        toron_block wrong = all;
        wrong.density = densities[next % COUNT(densities)];
        CALL(BLOCK(yarn, PROPERTIES, &wrong));
        wrong = all, wrong.leading_dimension = 0;
        CALL(BLOCK(yarn, PROPERTIES, &wrong));
        wrong = all, wrong.deformation_gradient = NULL;
        CALL(BLOCK(yarn, PROPERTIES, &wrong));
        CALL(BLOCK(yarn, 3, &all));
        CALL(BLOCK(NULL, PROPERTIES, &all));
        CALL(BLOCK(yarn, PROPERTIES, NULL));
    }
}

static void hyperelastic_block_tangent(void)
{
#define BLOCK_TANGENT ENTRY(toron_hyperelastic_block_tangent)
    block_case b;
    for (size_t next = 0; next_block(&next, GOOD_YARNS, COUNT(yarns), &b);) {
        real *yarn = given(yarns[b.yarn], PROPERTIES), *tangent = reals(81 * b.size);
        const toron_block all = hyperelastic_arrays(&b, next), usual = request(all, 4), least = request(all, 8);
        for (int32_t measure = -1; measure < 5; measure++) {
            CALL(BLOCK_TANGENT(yarn, PROPERTIES, &all, measure, tangent));
            CALL(BLOCK_TANGENT(yarn, PROPERTIES, &usual, measure, tangent));
        }
        CALL(BLOCK_TANGENT(yarn, PROPERTIES, &least, TORON_TANGENT_JAUMANN, tangent));
        CALL(BLOCK_TANGENT(yarn, PROPERTIES, &all, TORON_TANGENT_JAUMANN, NULL));
        CALL(BLOCK_TANGENT(yarn, PROPERTIES, NULL, TORON_TANGENT_JAUMANN, tangent));
    }
}

/* ---- The linear elastic law */

#ifndef SINGLE
static void linear_elastic_validate(void)
{
    for (size_t y = 0; y < COUNT(linear_yarns); y++) {
        real *yarn = given(linear_yarns[y], LINEAR);
        char *text = guarded(200);
        int32_t *status = guarded(sizeof *status);
        ARGUMENTS("yarn %zu", y);
        CALL(toron_linear_elastic_validate_f64(yarn, LINEAR, text, 200, status));
        CALL(toron_linear_elastic_validate_f64(yarn, 3, text, 200, NULL));
        CALL(toron_linear_elastic_validate_f64(NULL, LINEAR, NULL, 0, status));
        release();
    }
}

static void linear_elastic_axes(void)
{
    for (size_t y = 0; y < COUNT(linear_yarns); y++) {
        real *yarn = given(linear_yarns[y], LINEAR), *axes = reals(9);
        ARGUMENTS("yarn %zu", y);
        CALL(toron_linear_elastic_axes_f64(yarn, LINEAR, axes));
        CALL(toron_linear_elastic_axes_f64(yarn, 3, axes));
        CALL(toron_linear_elastic_axes_f64(yarn, LINEAR, NULL));
        release();
    }
}

typedef struct {
    real *yarn, *f_old, *f_new, *old, *new, *stress, *axes;
} step_arrays;

/* From rest and from two other deformations, one of them at fault, to each; the old state null or any. */
static int next_step(size_t *next, step_arrays *s)
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
    *s = (step_arrays){.yarn = given(linear_yarns[y], LINEAR), .f_old = given(deformations[starts[from]], 9),
                       .f_new = given(deformations[to], 9), .new = reals(LINEAR_STATE), .stress = reals(6),
                       .axes = given(axes_in_space[*next % COUNT(axes_in_space)], 9)};
    if (state > 0)
        s->old = given(linear_states[state - 1], LINEAR_STATE);
    ARGUMENTS("yarn %zu, F %zu to %zu, old state %zu, axes %zu", y, starts[from], to, state, *next % COUNT(axes_in_space));
    return 1;
}

static void linear_elastic_step(void)
{
#define STEP toron_linear_elastic_step_f64
    step_arrays s;
    for (size_t next = 0; next_step(&next, &s);) {
        for (int32_t rotation = -1; rotation < 4; rotation++)
            for (int32_t criterion = 0; criterion < 2; criterion++)
                CALL(STEP(s.yarn, LINEAR, s.f_old, s.f_new, s.old, s.new, s.stress, rotation, criterion, s.axes));
        CALL(STEP(s.yarn, LINEAR, s.f_old, s.f_new, s.old, s.new, NULL, TORON_ROTATION_POLAR, 2, s.axes));
        CALL(STEP(s.yarn, LINEAR, s.f_old, s.f_new, s.old, NULL, s.stress, TORON_ROTATION_FIBRE, 0, NULL));
        CALL(STEP(s.yarn, LINEAR, s.f_old, NULL, s.old, s.new, s.stress, TORON_ROTATION_FIBRE, 0, NULL));
    }
}

static void linear_elastic_step_tangent(void)
{
#define STEP_TANGENT toron_linear_elastic_step_tangent_f64
    step_arrays s;
    for (size_t next = 0; next_step(&next, &s);) {
        real *c = reals(81);
        int32_t criterion = (int32_t)(next % 2);
        for (int32_t rotation = 0; rotation < 3; rotation++)
            for (int32_t measure = 0; measure < 4; measure++)
                CALL(STEP_TANGENT(s.yarn, LINEAR, s.f_old, s.f_new, s.old, s.new, s.stress, rotation, criterion, s.axes, measure, c));
        CALL(STEP_TANGENT(s.yarn, LINEAR, s.f_old, s.f_new, s.old, s.new, s.stress, 0, 0, s.axes, 4, c));
        CALL(STEP_TANGENT(s.yarn, LINEAR, s.f_old, s.f_new, s.old, s.new, s.stress, 0, 0, s.axes, 0, NULL));
    }
}

static void linear_elastic_increment(void)
{
    static const double strains[][6] = {
        {0}, {1e-3, 2e-3, -1e-3, 5e-4, 0, -5e-4}, {0.05, 0, 0, 0, 0, 0}, {-0.01, 0, 0, 60, 0, 0}, {SUBNORMAL, TINY, 0, 0, 0, 0},
        {HUGE_NUMBER, 0, 0, HUGE_NUMBER, 0, 0}, {0, NAN, 0, 0, 0, 0}, {0, 0, SIGNALLING, 0, 0, 0}, {INFINITY, 0, 0, 0, 0, 0},
    };
    static const double jacobians[] = {1, 0, SUBNORMAL, HUGE_NUMBER, -1, NAN};
    const size_t states_of = COUNT(linear_states) + 1;
    for (size_t next = 0; next < COUNT(linear_yarns) * COUNT(strains) * states_of; next += stride) {
        size_t state = next % states_of, k = next / states_of % COUNT(strains), y = next / states_of / COUNT(strains);
        real *yarn = given(linear_yarns[y], LINEAR), *strain = given(strains[k], 6), *new = reals(LINEAR_STATE);
        real *old = state == 0 ? NULL : given(linear_states[state - 1], LINEAR_STATE), *stress = reals(6);
        ARGUMENTS("yarn %zu, strain %zu, old state %zu", y, k, state);
        for (size_t j = 0; j < COUNT(jacobians); j++)
            for (int32_t criterion = -1; criterion < 2; criterion++)
                CALL(toron_linear_elastic_increment_f64(yarn, LINEAR, strain, jacobians[j], old, new, stress, criterion));
        CALL(toron_linear_elastic_increment_f64(yarn, LINEAR, strain, 1, old, NULL, NULL, 0));
        CALL(toron_linear_elastic_increment_f64(yarn, LINEAR, NULL, 1, old, new, stress, 0));
        release();
    }
}
#endif

static void linear_elastic_block(void)
{
#define LINEAR_BLOCK ENTRY(toron_linear_elastic_block)
    block_case b;
    for (size_t next = 0; next_block(&next, GOOD_LINEAR_YARNS, COUNT(linear_yarns), &b);) {
        size_t n = b.size, old_states = b.points == 0 ? COUNT(linear_states) : 3;
        real *yarn = given(linear_yarns[b.yarn], LINEAR), *old = by_component(linear_states[0], LINEAR_STATE, old_states, next, n);
        real *f_old = by_component(deformations[0], 9, b.points == 0 ? GOOD_DEFORMATIONS + 1 : REST, next + 1, n);
        const toron_linear_block all = {
            .n = n, .leading_dimension = n, .f_old = f_old, .f_new = by_component(deformations[0], 9, points_of[b.points], next, n),
            .axes = by_component(axes_in_space[0], 9, b.points == 0 ? COUNT(axes_in_space) : 2, next, n), .state_old = old,
            .state_new = reals(LINEAR_STATE * n), .stress = reals(6 * n), .status = guarded(n * sizeof(int32_t)), .level = b.level};
        toron_linear_block fresh = all, least = all, wrong = all;
        fresh.state_old = NULL;
        least.state_new = NULL, least.status = NULL;
        wrong.leading_dimension = 0;
        for (int32_t rotation = -1; rotation < 4; rotation++)
            for (int32_t criterion = -1; criterion < 3; criterion++) {
                CALL(LINEAR_BLOCK(yarn, LINEAR, &all, rotation, criterion));
                CALL(LINEAR_BLOCK(yarn, LINEAR, &fresh, rotation, criterion));
            }
        CALL(LINEAR_BLOCK(yarn, LINEAR, &least, TORON_ROTATION_SPIN, 0));
        CALL(LINEAR_BLOCK(yarn, LINEAR, &wrong, TORON_ROTATION_FIBRE, 0));
        CALL(LINEAR_BLOCK(yarn, LINEAR, NULL, TORON_ROTATION_FIBRE, 0));
    }
}

#endif
