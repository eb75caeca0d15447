/* Calls of the entries of the law with friction. */
#ifndef ENVIRONMENT_FRICTIONAL_H
#define ENVIRONMENT_FRICTIONAL_H

#include "environment_linear_hosts.h"
#include "environment_mgis.h"

/* The next combination of yarn, deformation, and old state or fibre; false after the last one. */
static int next_rubbing(size_t *next, point_arrays *p)
{
    size_t variants = 1 + COUNT(slip_states) + COUNT(fibres), of_a_yarn = variants * DEFORMATIONS, rest = *next;
    size_t v = 0, d = 1, y = GOOD_RUBBING_YARNS;
    release();
    if (rest < GOOD_RUBBING_YARNS * of_a_yarn)
        v = rest % variants, d = rest / variants % DEFORMATIONS, y = rest / of_a_yarn;
    else
        y += rest - GOOD_RUBBING_YARNS * of_a_yarn; /* refused, whatever comes with it */
    if (y >= RUBBING_YARNS)
        return 0;
    *next += stride;
    *p = (point_arrays){.yarn = rubbing_yarn(y), .f = given(deformations[d], 9), .new = reals(SLIP_STATE), .stress = reals(6)};
    if (v >= 1 && v <= COUNT(slip_states))
        p->old = given(slip_states[v - 1], SLIP_STATE);
    else if (v > 0)
        p->fibre = given(fibres[v - 1 - COUNT(slip_states)], 3);
    ARGUMENTS("yarn %zu, F %zu, old state or fibre %zu", y, d, v);
    return 1;
}

/* The same for a host, which has an old state always, and none with fibres. */
static int next_rubbing_host(size_t *next, point_arrays *p)
{
    do {
        if (!next_rubbing(next, p))
            return 0;
    } while (p->fibre != NULL);
    if (p->old == NULL)
        p->old = filled(0, SLIP_STATE);
    return 1;
}

/* ---- Prepared, points, blocks */

static void frictional_prepare(void)
{
#define PREPARE_RUBBING ENTRY(toron_frictional_prepare)
    for (size_t y = 0; y < RUBBING_YARNS; y++) {
        real *yarn = rubbing_yarn(y);
        ENTRY(toron_frictional) *law = opaque(sizeof *law);
        ARGUMENTS("yarn %zu", y);
        CALL(PREPARE_RUBBING(law, sizeof *law, yarn, RUBBING, MESSAGE));
        CALL(PREPARE_RUBBING(law, 3, yarn, RUBBING, MESSAGE));
        CALL(PREPARE_RUBBING(law, sizeof *law, yarn, PROPERTIES, MESSAGE));
        CALL(PREPARE_RUBBING(law, sizeof *law, NULL, RUBBING, MESSAGE));
        CALL(PREPARE_RUBBING(NULL, sizeof *law, yarn, RUBBING, MESSAGE));
        release();
    }
}

/* A prepared law, or one that is not, where the properties are refused. */
static ENTRY(toron_frictional) *rubbing_law_of(const real *yarn)
{
    ENTRY(toron_frictional) *law = opaque(sizeof *law);
    memset(law, 0, sizeof *law);
    PREPARE_RUBBING(law, sizeof *law, yarn, RUBBING, NULL, 0);
    return law;
}

static void rubbing_points(int with_properties)
{
#define RUBBING_POINT ENTRY(toron_frictional_point)
#define RUBBING_POINT_WITH ENTRY(toron_frictional_point_with_properties)
#define EVALUATE_RUBBING_POINT(point)                                    \
    do {                                                                 \
        if (with_properties)                                             \
            CALL(RUBBING_POINT_WITH(p.yarn, RUBBING, point, MESSAGE));   \
        else                                                             \
            CALL(RUBBING_POINT(law, point, MESSAGE));                    \
    } while (0)
    point_arrays p;
    for (size_t next = 0; next_rubbing(&next, &p);) {
        ENTRY(toron_frictional) *law = rubbing_law_of(p.yarn);
        const toron_point all = {.size = sizeof all, .level = at_level((int32_t)(next % 4)), .density = densities[0],
                                 .deformation_gradient = p.f, .fibre = p.fibre, .state_old = p.old, .state_new = p.new,
                                 .stress = p.stress, .modes = reals(24), .wave_speed = reals(1)};
        toron_point point = all;
        EVALUATE_RUBBING_POINT(&all);
        put_double(&point.density, densities[next % COUNT(densities)]);
        EVALUATE_RUBBING_POINT(&point);
        point.modes = NULL, point.wave_speed = NULL;
        EVALUATE_RUBBING_POINT(&point);
        point.state_new = NULL;
        EVALUATE_RUBBING_POINT(&point);
        point = all, point.tangent = reals(81);
        for (point.measure = -1; point.measure < 5; point.measure++)
            EVALUATE_RUBBING_POINT(&point);
        point.level = 4;
        EVALUATE_RUBBING_POINT(&point);
        point = all, point.deformation_gradient = NULL;
        EVALUATE_RUBBING_POINT(&point);
        point.size = 3;
        EVALUATE_RUBBING_POINT(&point);
        EVALUATE_RUBBING_POINT(NULL);
        if (with_properties) {
            CALL(RUBBING_POINT_WITH(p.yarn, PROPERTIES, &all, MESSAGE));
            CALL(RUBBING_POINT_WITH(NULL, RUBBING, &all, MESSAGE));
        } else {
            CALL(RUBBING_POINT(NULL, &all, MESSAGE));
        }
    }
}

static void frictional_point(void)
{
    rubbing_points(0);
}

static void frictional_point_with_properties(void)
{
    rubbing_points(1);
}

static void rubbing_blocks(int with_properties)
{
#define RUBBING_BLOCK ENTRY(toron_frictional_block)
#define RUBBING_BLOCK_WITH ENTRY(toron_frictional_block_with_properties)
#define EVALUATE_RUBBING_BLOCK(block)                                    \
    do {                                                                 \
        if (with_properties)                                             \
            CALL(RUBBING_BLOCK_WITH(yarn, RUBBING, block, MESSAGE));     \
        else                                                             \
            CALL(RUBBING_BLOCK(law, block, MESSAGE));                    \
    } while (0)
    block_case b;
    for (size_t next = 0; next_block(&next, GOOD_RUBBING_YARNS, RUBBING_YARNS, &b);) {
        size_t n = b.size, old_states = b.points == 0 ? COUNT(slip_states) : 3;
        real *yarn = rubbing_yarn(b.yarn), *tangent = reals(81 * n), *new = reals(SLIP_STATE * n);
        real *old = by_component(slip_states[0], SLIP_STATE, old_states, next, n);
        ENTRY(toron_frictional) *law = rubbing_law_of(yarn);
        const toron_block all = {
            .size = sizeof all, .n = n, .leading_dimension = n, .level = at_level(b.level), .density = densities[0],
            .deformation_gradient = {by_component(deformations[0], 9, points_of[b.points], next, n)},
            .fibre = {by_component(fibres[0], 3, b.points == 0 ? COUNT(fibres) : 5, next, n)},
            .energies_old = old, .invariants_old = old + INVARIANTS * n, .failure_old = old + FAILURE * n, .stress = {reals(6 * n)},
            .energies = new, .invariants = new + INVARIANTS * n, .failure = new + FAILURE * n, .modes = reals(24 * n),
            .wave_speed = reals(n), .active = reals(n), .status = guarded(n * sizeof(int32_t))};
        for (int which = 0; which < REQUESTS; which++) {
            const toron_block block = requested(all, which);
            EVALUATE_RUBBING_BLOCK(&block);
        }
        for (int32_t measure = -1; measure < 5; measure++) {
            toron_block block = requested(all, measure == 0 ? 4 : 0);
            block.measure = measure, block.tangent = tangent;
            EVALUATE_RUBBING_BLOCK(&block);
        }
        const toron_block points = by_points(all);
        EVALUATE_RUBBING_BLOCK(&points);
        toron_block wrong = all;
        put_double(&wrong.density, densities[next % COUNT(densities)]);
        EVALUATE_RUBBING_BLOCK(&wrong);
        wrong = all, wrong.leading_dimension = 1;
        EVALUATE_RUBBING_BLOCK(&wrong);
        wrong = all, wrong.deformation_gradient[0] = NULL;
        EVALUATE_RUBBING_BLOCK(&wrong);
        EVALUATE_RUBBING_BLOCK(NULL);
        if (with_properties)
            CALL(RUBBING_BLOCK_WITH(yarn, PROPERTIES, &all, MESSAGE));
        else
            CALL(RUBBING_BLOCK(NULL, &all, MESSAGE));
    }
}

static void frictional_block(void)
{
    rubbing_blocks(0);
}

static void frictional_block_with_properties(void)
{
    rubbing_blocks(1);
}

/* ---- Abaqus */

#ifndef SINGLE
static void abaqus_frictional_umat(void)
{
#define RUBBING_UMAT toron_abaqus_frictional_umat_f64
    point_arrays p;
    for (size_t next = 0; next_rubbing_host(&next, &p);) {
        real *sse = reals(1), *spd = reals(1), *c = reals(36);
        real *pnewdt = given(&time_increments[next % COUNT(time_increments)], 1);
        CALL(RUBBING_UMAT(p.stress, p.old, c, sse, spd, pnewdt, p.f, p.yarn, RUBBING, SLIP_STATE, 3, 3, 1, MESSAGE));
        CALL(RUBBING_UMAT(p.stress, p.old, NULL, sse, spd, pnewdt, p.f, p.yarn, RUBBING, SLIP_STATE, 3, 3, 1, MESSAGE));
        CALL(RUBBING_UMAT(p.stress, p.old, c, sse, NULL, pnewdt, p.f, p.yarn, RUBBING, SLIP_STATE, 3, 1, 1, MESSAGE));
        CALL(RUBBING_UMAT(p.stress, p.old, c, sse, spd, pnewdt, p.f, p.yarn, RUBBING, SLIP_STATE, 3, 3, 0, MESSAGE));
        CALL(RUBBING_UMAT(p.stress, p.old, c, sse, spd, pnewdt, p.f, p.yarn, RUBBING, STATE, 3, 3, 1, MESSAGE));
        CALL(RUBBING_UMAT(p.stress, p.old, c, sse, spd, pnewdt, p.f, p.yarn, 3, SLIP_STATE, 3, 3, 1, MESSAGE));
        CALL(RUBBING_UMAT(p.stress, p.old, c, NULL, spd, pnewdt, p.f, p.yarn, RUBBING, SLIP_STATE, 3, 3, 1, MESSAGE));
    }
}
#endif

static void abaqus_frictional_vumat(void)
{
#define RUBBING_VUMAT ENTRY(toron_abaqus_frictional_vumat)
    enum { VUMAT_STATE = SLIP_STATE + 2 };
    static const double times[][2] = {{1e-6, 1e-6}, {0, 0}, {SIGNALLING, 0}};
    block_case b;
    for (size_t next = 0; next_block(&next, GOOD_RUBBING_YARNS, RUBBING_YARNS, &b);) {
        size_t n = b.size, rows = points_of[b.points], old_states = b.points == 0 ? COUNT(slip_states) : 3;
        real *old = by_component(slip_states[0], SLIP_STATE, old_states, next, n), *state_old = filled(7, VUMAT_STATE * n);
        memcpy(state_old, old, SLIP_STATE * n * sizeof(real));
        toron_vumat block = {
            .size = sizeof block, .nblock = (int32_t)n, .ndir = 3, .nshr = 3, .nstatev = VUMAT_STATE, .nprops = RUBBING,
            .level = at_level(b.level), .props = rubbing_yarn(b.yarn),
            .density = b.points == 0 ? stretches(rows, next, n) : filled(2, n),
            .strain_inc = stretches(rows, next + 1, n), .stretch_old = stretches(rows, next + 2, n),
            .stretch_new = stretches(rows, next, n), .stress_old = stretches(rows, next + 3, n), .state_old = state_old,
            .ener_intern_old = stretches(rows, next + 4, n), .ener_inelas_old = stretches(rows, next + 6, n),
            .stress_new = reals(6 * n), .state_new = reals(VUMAT_STATE * n), .ener_intern_new = reals(n), .ener_inelas_new = reals(n)};
        for (size_t k = 0; k < COUNT(times); k++) {
            put_double(&block.step_time, times[k][0]);
            put_double(&block.total_time, times[k][1]);
            CALL(RUBBING_VUMAT(&block, MESSAGE));
        }
        toron_vumat wrong = block;
        wrong.nshr = 1;
        CALL(RUBBING_VUMAT(&wrong, MESSAGE));
        wrong = block, wrong.nstatev = STATE;
        CALL(RUBBING_VUMAT(&wrong, MESSAGE));
        CALL(RUBBING_VUMAT(NULL, MESSAGE));
    }
}

/* ---- LS-DYNA: state and F of an element, side by side; of a vector, elements 3 to n + 2 of n + 3. */

enum { SLIP_HISTORY = SLIP_STATE + 9 };

static int next_rubbing_element(size_t *next, point_arrays *p, real **history)
{
    if (!next_rubbing_host(next, p))
        return 0;
    *history = reals(SLIP_HISTORY);
    memcpy(*history, p->old, SLIP_STATE * sizeof(real));
    memcpy(*history + SLIP_STATE, p->f, 9 * sizeof(real));
    return 1;
}

static void lsdyna_frictional_umat(void)
{
#define RUBBING_DYNA ENTRY(toron_lsdyna_frictional_umat)
    point_arrays p;
    real *history;
    for (size_t next = 0; next_rubbing_element(&next, &p, &history);) {
        int *failed = guarded(sizeof *failed);
        CALL(RUBBING_DYNA(p.yarn, p.stress, history, SLIP_STATE, failed, MESSAGE));
        CALL(RUBBING_DYNA(p.yarn, p.stress, history, STATE, failed, MESSAGE));
        CALL(RUBBING_DYNA(p.yarn, p.stress, NULL, SLIP_STATE, failed, MESSAGE));
    }
}

static void lsdyna_frictional_utan(void)
{
#define RUBBING_UTAN ENTRY(toron_lsdyna_frictional_utan)
    point_arrays p;
    real *history;
    for (size_t next = 0; next_rubbing_element(&next, &p, &history);) {
        real *es = reals(36);
        CALL(RUBBING_UTAN(p.yarn, history, SLIP_STATE, es, MESSAGE));
        CALL(RUBBING_UTAN(p.yarn, history, STATE, es, MESSAGE));
        CALL(RUBBING_UTAN(NULL, history, SLIP_STATE, es, MESSAGE));
    }
}

static real *slip_histories(const block_case *b, size_t next)
{
    size_t n = b->size, nlq = n + LFT, old_states = b->points == 0 ? COUNT(slip_states) : 3;
    real *old = by_component(slip_states[0], SLIP_STATE, old_states, next, n), *all = filled(NAN, SLIP_HISTORY * nlq);
    real *f = by_component(deformations[0], 9, points_of[b->points], next, n);
    for (size_t c = 0; c < SLIP_HISTORY; c++)
        memcpy(all + c * nlq + LFT - 1, c < SLIP_STATE ? old + c * n : f + (c - SLIP_STATE) * n, n * sizeof(real));
    return all;
}

static void lsdyna_frictional_umat_vector(void)
{
#define RUBBING_VECTOR ENTRY(toron_lsdyna_frictional_umat_vector)
    block_case b;
    for (size_t next = 0; next_block(&next, GOOD_RUBBING_YARNS, RUBBING_YARNS, &b);) {
        int32_t n = (int32_t)b.size, nlq = n + LFT, llt = n + LFT - 1;
        real *cm = rubbing_yarn(b.yarn), *s[6], *h = slip_histories(&b, next);
        int *failed = guarded((size_t)nlq * sizeof *failed);
        for (int c = 0; c < 6; c++)
            s[c] = reals((size_t)nlq);
        CALL(RUBBING_VECTOR(cm, s[0], s[1], s[2], s[3], s[4], s[5], h, SLIP_STATE, LFT, llt, nlq, failed, MESSAGE));
        CALL(RUBBING_VECTOR(cm, s[0], s[1], s[2], s[3], s[4], s[5], h, STATE, LFT, llt, nlq, failed, MESSAGE));
        CALL(RUBBING_VECTOR(cm, s[0], s[1], s[2], s[3], s[4], NULL, h, SLIP_STATE, LFT, llt, nlq, failed, MESSAGE));
    }
}

static void lsdyna_frictional_utan_vector(void)
{
#define RUBBING_UTAN_VECTOR ENTRY(toron_lsdyna_frictional_utan_vector)
    block_case b;
    for (size_t next = 0; next_block(&next, GOOD_RUBBING_YARNS, RUBBING_YARNS, &b);) {
        int32_t n = (int32_t)b.size, nlq = n + LFT, llt = n + LFT - 1;
        real *cm = rubbing_yarn(b.yarn), *h = slip_histories(&b, next), *dsave = reals(36 * (size_t)nlq);
        CALL(RUBBING_UTAN_VECTOR(cm, h, SLIP_STATE, LFT, llt, nlq, dsave, MESSAGE));
        CALL(RUBBING_UTAN_VECTOR(cm, h, STATE, LFT, llt, nlq, dsave, MESSAGE));
        CALL(RUBBING_UTAN_VECTOR(cm, NULL, SLIP_STATE, LFT, llt, nlq, dsave, MESSAGE));
    }
}

#ifndef SINGLE
static void lsdyna_frictional_bulk_and_shear(void)
{
    for (size_t y = 0; y < RUBBING_YARNS; y++) {
        real *yarn = rubbing_yarn(y), *moduli = reals(2);
        ARGUMENTS("yarn %zu", y);
        CALL(toron_lsdyna_frictional_bulk_and_shear_f64(yarn, RUBBING, moduli, moduli + 1, MESSAGE));
        CALL(toron_lsdyna_frictional_bulk_and_shear_f64(yarn, PROPERTIES, moduli, moduli + 1, MESSAGE));
        CALL(toron_lsdyna_frictional_bulk_and_shear_f64(yarn, RUBBING, moduli, NULL, MESSAGE));
        release();
    }
}

/* ---- MGIS */

int ToronFrictional_Tridimensional(mgis_data *);
int ToronFrictional_PlaneStrain(mgis_data *);
int ToronFrictional_Axisymmetrical(mgis_data *);

#define MGIS_FRICTIONAL(name, function)                                                                               \
    static void name(void)                                                                                            \
    {                                                                                                                 \
        point_arrays p;                                                                                               \
        for (size_t next = 0; next_rubbing_host(&next, &p);) {                                                        \
            mgis_data d = mgis_call(next, p.yarn, given(deformations[next % GOOD_DEFORMATIONS], 9), p.f, p.old);      \
            d.s1.internal_state_variables = p.new, d.s1.dissipated_energy = reals(1);                                 \
            MGIS_CALLS(function, d);                                                                                  \
        }                                                                                                             \
    }

MGIS_FRICTIONAL(mgis_frictional, ToronFrictional_Tridimensional)
MGIS_FRICTIONAL(mgis_frictional_in_plane_strain, ToronFrictional_PlaneStrain)
MGIS_FRICTIONAL(mgis_frictional_of_revolution, ToronFrictional_Axisymmetrical)

static void calculix_frictional(void)
{
    calculix_law(2);
}
#endif

#endif
