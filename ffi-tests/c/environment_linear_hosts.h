/* Calls of the entries of Abaqus and LS-DYNA for the linear elastic law. */
#ifndef ENVIRONMENT_LINEAR_HOSTS_H
#define ENVIRONMENT_LINEAR_HOSTS_H

#include "environment_hosts.h"

#ifndef SINGLE
static void abaqus_linear_umat(void)
{
#define LINEAR_UMAT toron_abaqus_linear_umat_f64
    real *yarn;
    toron_linear_point p;
    for (size_t next = 0; next_step(&next, &yarn, &p);) {
        real *state = filled(0, LINEAR_STATE), *sse = reals(1), *c = reals(36);
        real *pnewdt = given(&time_increments[next % COUNT(time_increments)], 1);
        if (p.state_old != NULL)
            memcpy(state, p.state_old, LINEAR_STATE * sizeof(real));
        CALL(LINEAR_UMAT(p.stress, state, c, sse, pnewdt, p.f_old, p.f_new, yarn, LINEAR, LINEAR_STATE, 3, 3, 1, MESSAGE));
        CALL(LINEAR_UMAT(p.stress, state, NULL, sse, pnewdt, p.f_old, p.f_new, yarn, LINEAR, LINEAR_STATE, 3, 3, 1, MESSAGE));
        CALL(LINEAR_UMAT(p.stress, state, c, sse, pnewdt, p.f_old, p.f_new, yarn, LINEAR, LINEAR_STATE, 3, 1, 1, MESSAGE));
        CALL(LINEAR_UMAT(p.stress, state, c, sse, pnewdt, p.f_old, p.f_new, yarn, LINEAR, LINEAR_STATE, 3, 3, 0, MESSAGE));
        CALL(LINEAR_UMAT(p.stress, state, c, sse, pnewdt, p.f_old, p.f_new, yarn, 3, LINEAR_STATE, 3, 3, 1, MESSAGE));
        CALL(LINEAR_UMAT(p.stress, state, c, sse, pnewdt, NULL, p.f_new, yarn, LINEAR, LINEAR_STATE, 3, 3, 1, MESSAGE));
    }
}
#endif

static void abaqus_linear_vumat(void)
{
#define LINEAR_VUMAT ENTRY(toron_abaqus_linear_vumat)
    enum { VUMAT_STATE = LINEAR_STATE + 2 };
    static const double times[][2] = {{1e-6, 1e-6}, {0, 0}, {-0.0, SUBNORMAL}, {SIGNALLING, 0}, {NAN, NAN}};
    block_case b;
    for (size_t next = 0; next_block(&next, GOOD_LINEAR_YARNS, COUNT(linear_yarns), &b);) {
        size_t n = b.size, rows = points_of[b.points], old_states = b.points == 0 ? COUNT(linear_states) : 3;
        real *old = by_component(linear_states[0], LINEAR_STATE, old_states, next, n), *state_old = filled(7, VUMAT_STATE * n);
        memcpy(state_old, old, LINEAR_STATE * n * sizeof(real));
        toron_vumat block = {
            .size = sizeof block, .nblock = (int32_t)n, .ndir = 3, .nshr = 3, .nstatev = VUMAT_STATE, .nprops = LINEAR,
            .level = at_level(b.level),
            .props = given(linear_yarns[b.yarn], LINEAR), .density = b.points == 0 ? stretches(rows, next, n) : filled(2, n),
            .strain_inc = stretches(rows, next + 1, n), .stretch_old = stretches(rows, next + 2, n),
            .stretch_new = stretches(rows, next, n), .stress_old = stretches(rows, next + 3, n), .state_old = state_old,
            .ener_intern_old = stretches(rows, next + 4, n), .ener_inelas_old = stretches(rows, next + 6, n),
            .stress_new = reals(6 * n), .state_new = reals(VUMAT_STATE * n), .ener_intern_new = reals(n), .ener_inelas_new = reals(n)};
        for (size_t k = 0; k < COUNT(times); k++) {
            put_double(&block.step_time, times[k][0]);
            put_double(&block.total_time, times[k][1]);
            CALL(LINEAR_VUMAT(&block, MESSAGE));
        }
        toron_vumat other = block;
        other.nshr = 1;
        CALL(LINEAR_VUMAT(&other, MESSAGE));
        other = block, other.nprops = 3;
        CALL(LINEAR_VUMAT(&other, MESSAGE));
        other = block, other.stretch_old = NULL;
        CALL(LINEAR_VUMAT(&other, MESSAGE));
        CALL(LINEAR_VUMAT(NULL, MESSAGE));
    }
}

enum { LINEAR_NHV = LINEAR_STATE + 9, LINEAR_HISTORY = LINEAR_NHV + 9 };

/* State, F of the last step and F of one element, side by side. */
static int next_linear_element(size_t *next, real **yarn, real **history, toron_linear_point *p)
{
    if (!next_step(next, yarn, p))
        return 0;
    *history = filled(0, LINEAR_HISTORY);
    if (p->state_old != NULL) {
        memcpy(*history, p->state_old, LINEAR_STATE * sizeof(real));
        memcpy(*history + LINEAR_STATE, p->f_old, 9 * sizeof(real));
    }
    memcpy(*history + LINEAR_NHV, p->f_new, 9 * sizeof(real));
    return 1;
}

static void lsdyna_linear_umat(void)
{
#define LINEAR_LSDYNA ENTRY(toron_lsdyna_linear_umat)
    real *yarn, *history;
    toron_linear_point p;
    for (size_t next = 0; next_linear_element(&next, &yarn, &history, &p);) {
        int *failed = guarded(sizeof *failed);
        CALL(LINEAR_LSDYNA(yarn, p.stress, history, LINEAR_NHV, failed, MESSAGE));
        CALL(LINEAR_LSDYNA(yarn, p.stress, history, 3, failed, MESSAGE));
        CALL(LINEAR_LSDYNA(yarn, p.stress, NULL, LINEAR_NHV, failed, MESSAGE));
    }
}

static void lsdyna_linear_utan(void)
{
#define LINEAR_UTAN ENTRY(toron_lsdyna_linear_utan)
    real *yarn, *history;
    toron_linear_point p;
    for (size_t next = 0; next_linear_element(&next, &yarn, &history, &p);) {
        real *es = reals(36);
        CALL(LINEAR_UTAN(yarn, history, LINEAR_NHV, es, MESSAGE));
        CALL(LINEAR_UTAN(yarn, history, 3, es, MESSAGE));
        CALL(LINEAR_UTAN(NULL, history, LINEAR_NHV, es, MESSAGE));
    }
}

/* (nlq, 28): elements 3 to n + 2 of n + 3. */
static real *linear_histories(const block_case *b, size_t next)
{
    size_t n = b->size, nlq = n + LFT, old_states = b->points == 0 ? COUNT(linear_states) : 3;
    real *old = by_component(linear_states[0], LINEAR_STATE, old_states, next, n), *all = filled(NAN, LINEAR_HISTORY * nlq);
    real *f = by_component(deformations[0], 9, points_of[b->points], next, n);
    real *f_old = by_component(deformations[0], 9, REST, next, n);
    for (size_t c = 0; c < LINEAR_HISTORY; c++) {
        const real *row = c < LINEAR_STATE ? old + c * n : c < LINEAR_NHV ? f_old + (c - LINEAR_STATE) * n : f + (c - LINEAR_NHV) * n;
        memcpy(all + c * nlq + LFT - 1, row, n * sizeof(real));
    }
    return all;
}

static void lsdyna_linear_umat_vector(void)
{
#define LINEAR_VECTOR ENTRY(toron_lsdyna_linear_umat_vector)
    block_case b;
    for (size_t next = 0; next_block(&next, GOOD_LINEAR_YARNS, COUNT(linear_yarns), &b);) {
        int32_t n = (int32_t)b.size, nlq = n + LFT, llt = n + LFT - 1;
        real *cm = given(linear_yarns[b.yarn], LINEAR), *s[6], *history = linear_histories(&b, next);
        int *failed = guarded((size_t)nlq * sizeof *failed);
        for (int c = 0; c < 6; c++)
            s[c] = reals((size_t)nlq);
        CALL(LINEAR_VECTOR(cm, s[0], s[1], s[2], s[3], s[4], s[5], history, LINEAR_NHV, LFT, llt, nlq, failed, MESSAGE));
        CALL(LINEAR_VECTOR(cm, s[0], s[1], s[2], s[3], s[4], s[5], history, LINEAR_NHV, LFT, llt, llt - 1, failed, MESSAGE));
        CALL(LINEAR_VECTOR(cm, s[0], s[1], s[2], s[3], s[4], NULL, history, LINEAR_NHV, LFT, llt, nlq, failed, MESSAGE));
    }
}

static void lsdyna_linear_utan_vector(void)
{
#define LINEAR_UTAN_VECTOR ENTRY(toron_lsdyna_linear_utan_vector)
    block_case b;
    for (size_t next = 0; next_block(&next, GOOD_LINEAR_YARNS, COUNT(linear_yarns), &b);) {
        int32_t n = (int32_t)b.size, nlq = n + LFT, llt = n + LFT - 1;
        real *cm = given(linear_yarns[b.yarn], LINEAR), *history = linear_histories(&b, next), *dsave = reals(36 * (size_t)nlq);
        CALL(LINEAR_UTAN_VECTOR(cm, history, LINEAR_NHV, LFT, llt, nlq, dsave, MESSAGE));
        CALL(LINEAR_UTAN_VECTOR(cm, history, LINEAR_NHV, LFT, llt, llt - 1, dsave, MESSAGE));
        CALL(LINEAR_UTAN_VECTOR(cm, NULL, LINEAR_NHV, LFT, llt, nlq, dsave, MESSAGE));
    }
}

#ifndef SINGLE
static void lsdyna_linear_bulk_and_shear(void)
{
    for (size_t y = 0; y < COUNT(linear_yarns); y++) {
        real *yarn = given(linear_yarns[y], LINEAR), *moduli = reals(2);
        ARGUMENTS("yarn %zu", y);
        CALL(toron_lsdyna_linear_bulk_and_shear_f64(yarn, LINEAR, moduli, moduli + 1, MESSAGE));
        CALL(toron_lsdyna_linear_bulk_and_shear_f64(yarn, 3, moduli, moduli + 1, MESSAGE));
        release();
    }
}
#endif

#endif
