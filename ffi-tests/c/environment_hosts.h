/* Calls of the entries of Abaqus, LS-DYNA and CalculiX. */
#ifndef ENVIRONMENT_HOSTS_H
#define ENVIRONMENT_HOSTS_H

#include <sys/wait.h>
#include <unistd.h>

#include "environment_laws.h"

/* ---- Abaqus */

#ifndef SINGLE
static const double time_increments[] = {1, 0.1, SUBNORMAL, NAN, SIGNALLING};

/* A UMAT's arrays; the old state null in `p` is a fresh one. Those with fibres say nothing new. */
static int next_umat(size_t *next, point_arrays *p, real **pnewdt)
{
    do {
        if (!next_point(next, p))
            return 0;
    } while (p->fibre != NULL);
    if (p->old == NULL)
        p->old = filled(0, STATE);
    *pnewdt = given(&time_increments[*next % COUNT(time_increments)], 1);
    return 1;
}

static void abaqus_umat(void)
{
#define UMAT toron_abaqus_umat_f64
    point_arrays p;
    real *pnewdt;
    for (size_t next = 0; next_umat(&next, &p, &pnewdt);) {
        real *sse = reals(1);
        CALL(UMAT(p.stress, p.old, sse, pnewdt, p.f, p.yarn, PROPERTIES, STATE, 3, 3, 1, MESSAGE));
        CALL(UMAT(p.stress, p.old, sse, pnewdt, p.f, p.yarn, PROPERTIES, STATE, 3, 1, 1, MESSAGE));
        CALL(UMAT(p.stress, p.old, sse, pnewdt, p.f, p.yarn, PROPERTIES, STATE, 3, 3, 0, MESSAGE));
        CALL(UMAT(p.stress, p.old, sse, pnewdt, p.f, p.yarn, 3, STATE, 3, 3, 1, MESSAGE));
        CALL(UMAT(p.stress, p.old, sse, NULL, p.f, p.yarn, PROPERTIES, STATE, 3, 3, 1, MESSAGE));
    }
}

static void abaqus_umat_tangent(void)
{
#define UMAT_TANGENT toron_abaqus_umat_tangent_f64
    point_arrays p;
    real *pnewdt;
    for (size_t next = 0; next_umat(&next, &p, &pnewdt);) {
        real *sse = reals(1), *c = reals(36);
        CALL(UMAT_TANGENT(p.stress, p.old, c, sse, pnewdt, p.f, p.yarn, PROPERTIES, STATE, 3, 3, 1, MESSAGE));
        CALL(UMAT_TANGENT(p.stress, p.old, c, sse, pnewdt, p.f, p.yarn, PROPERTIES, STATE, 3, 1, 1, MESSAGE));
        CALL(UMAT_TANGENT(p.stress, p.old, c, sse, pnewdt, p.f, p.yarn, PROPERTIES, 3, 3, 3, 1, MESSAGE));
        CALL(UMAT_TANGENT(p.stress, p.old, c, sse, pnewdt, p.f, p.yarn, PROPERTIES, STATE, 2, 1, 1, MESSAGE));
        CALL(UMAT_TANGENT(p.stress, p.old, NULL, sse, pnewdt, p.f, p.yarn, PROPERTIES, STATE, 3, 3, 1, MESSAGE));
        CALL(UMAT_TANGENT(NULL, p.old, c, sse, pnewdt, p.f, p.yarn, PROPERTIES, STATE, 3, 3, 1, MESSAGE));
    }
}
#endif

/* A deformation's diagonal and upper triangle as a stretch: 11 22 33 12 23 31. */
static real *stretches(size_t rows, size_t first, size_t n)
{
    static const int entries_of_f[6] = {0, 4, 8, 3, 7, 6};
    real *array = reals(6 * n);
    for (size_t i = 0; i < n; i++)
        for (size_t c = 0; c < 6; c++)
            put(&array[c * n + i], deformations[(first + 5 * i) % rows][entries_of_f[c]]);
    return array;
}

static void abaqus_vumat(void)
{
#define VUMAT ENTRY(toron_abaqus_vumat)
    enum { VUMAT_STATE = STATE + 2 };
    /* Step and total time: a step, the data check, and what is nearly one. */
    static const double times[][2] = {{1e-6, 1e-6}, {0, 0}, {-0.0, SUBNORMAL}, {SIGNALLING, 0}, {NAN, NAN}};
    block_case b;
    for (size_t next = 0; next_block(&next, GOOD_YARNS, COUNT(yarns), &b);) {
        size_t n = b.size, rows = points_of[b.points], old_states = b.points == 0 ? COUNT(states) : 3;
        real *old = by_component(states[0], STATE, old_states, next, n), *state_old = filled(7, VUMAT_STATE * n);
        memcpy(state_old, old, STATE * n * sizeof(real));
        toron_vumat block = {
            .size = sizeof block, .nblock = (int32_t)n, .ndir = 3, .nshr = 3, .nstatev = VUMAT_STATE, .nprops = PROPERTIES,
            .level = at_level(b.level),
            .props = given(yarns[b.yarn], PROPERTIES), .density = b.points == 0 ? stretches(rows, next, n) : filled(2, n),
            .strain_inc = stretches(rows, next + 1, n), .stretch_old = stretches(rows, next + 2, n),
            .stretch_new = stretches(rows, next, n), .stress_old = stretches(rows, next + 3, n), .state_old = state_old,
            .ener_intern_old = stretches(rows, next + 4, n), .ener_inelas_old = stretches(rows, next + 6, n),
            .stress_new = reals(6 * n), .state_new = reals(VUMAT_STATE * n), .ener_intern_new = reals(n), .ener_inelas_new = reals(n)};
        for (size_t k = 0; k < COUNT(times); k++) {
            put_double(&block.step_time, times[k][0]);
            put_double(&block.total_time, times[k][1]);
            CALL(VUMAT(&block, MESSAGE));
        }
        toron_vumat wrong = block;
        wrong.nshr = 1; /* plane elements: right where the fibre is in the plane */
        CALL(VUMAT(&wrong, MESSAGE));
        wrong = block, wrong.nshr = 2;
        CALL(VUMAT(&wrong, MESSAGE));
        wrong = block, wrong.nprops = 3;
        CALL(VUMAT(&wrong, MESSAGE));
        wrong = block, wrong.nblock = -1;
        CALL(VUMAT(&wrong, MESSAGE));
        wrong = block, wrong.stress_new = NULL;
        CALL(VUMAT(&wrong, MESSAGE));
        wrong = block, wrong.size = 3;
        CALL(VUMAT(&wrong, MESSAGE));
        CALL(VUMAT(NULL, MESSAGE));
    }
}

/* ---- LS-DYNA */

enum { HISTORY = STATE + 9 };

/* State and F of one element, side by side. Those with fibres say nothing new. */
static int next_element(size_t *next, point_arrays *p, real **history)
{
    do {
        if (!next_point(next, p))
            return 0;
    } while (p->fibre != NULL);
    *history = filled(0, HISTORY);
    if (p->old != NULL)
        memcpy(*history, p->old, STATE * sizeof(real));
    memcpy(*history + STATE, p->f, 9 * sizeof(real));
    return 1;
}

static void lsdyna_umat(void)
{
    point_arrays p;
    real *history;
    for (size_t next = 0; next_element(&next, &p, &history);) {
        int *failed = guarded(sizeof *failed);
        CALL(ENTRY(toron_lsdyna_umat)(p.yarn, p.stress, history, STATE, failed, MESSAGE));
        CALL(ENTRY(toron_lsdyna_umat)(p.yarn, p.stress, history, 3, failed, MESSAGE));
        CALL(ENTRY(toron_lsdyna_umat)(p.yarn, p.stress, NULL, STATE, failed, MESSAGE));
    }
}

static void lsdyna_utan(void)
{
    point_arrays p;
    real *history;
    for (size_t next = 0; next_element(&next, &p, &history);) {
        real *es = reals(36);
        CALL(ENTRY(toron_lsdyna_utan)(p.yarn, history, STATE, es, MESSAGE));
        CALL(ENTRY(toron_lsdyna_utan)(p.yarn, history, 3, es, MESSAGE));
        CALL(ENTRY(toron_lsdyna_utan)(NULL, history, STATE, es, MESSAGE));
    }
}

/* (nlq, 20): elements 3 to n + 2 of n + 3. */
enum { LFT = 3 };

static real *histories(const block_case *b, size_t next)
{
    size_t n = b->size, nlq = n + LFT, old_states = b->points == 0 ? COUNT(states) : 3;
    real *old = by_component(states[0], STATE, old_states, next, n), *all = filled(NAN, HISTORY * nlq);
    real *f = by_component(deformations[0], 9, points_of[b->points], next, n);
    for (size_t c = 0; c < HISTORY; c++)
        memcpy(all + c * nlq + LFT - 1, c < STATE ? old + c * n : f + (c - STATE) * n, n * sizeof(real));
    return all;
}

static void lsdyna_umat_vector(void)
{
#define UMAT_VECTOR ENTRY(toron_lsdyna_umat_vector)
    block_case b;
    for (size_t next = 0; next_block(&next, GOOD_YARNS, COUNT(yarns), &b);) {
        int32_t n = (int32_t)b.size, nlq = n + LFT, llt = n + LFT - 1;
        real *cm = given(yarns[b.yarn], PROPERTIES), *s[6], *history = histories(&b, next);
        int *failed = guarded((size_t)nlq * sizeof *failed);
        for (int c = 0; c < 6; c++)
            s[c] = reals((size_t)nlq);
        CALL(UMAT_VECTOR(cm, s[0], s[1], s[2], s[3], s[4], s[5], history, STATE, LFT, llt, nlq, failed, MESSAGE));
        CALL(UMAT_VECTOR(cm, s[0], s[1], s[2], s[3], s[4], s[5], history, STATE, 0, llt, nlq, failed, MESSAGE));
        CALL(UMAT_VECTOR(cm, s[0], s[1], s[2], s[3], s[4], s[5], history, STATE, LFT, llt, llt - 1, failed, MESSAGE));
        CALL(UMAT_VECTOR(cm, s[0], s[1], s[2], s[3], s[4], NULL, history, STATE, LFT, llt, nlq, failed, MESSAGE));
    }
}

static void lsdyna_utan_vector(void)
{
#define UTAN_VECTOR ENTRY(toron_lsdyna_utan_vector)
    block_case b;
    for (size_t next = 0; next_block(&next, GOOD_YARNS, COUNT(yarns), &b);) {
        int32_t n = (int32_t)b.size, nlq = n + LFT, llt = n + LFT - 1;
        real *cm = given(yarns[b.yarn], PROPERTIES), *history = histories(&b, next), *dsave = reals(36 * (size_t)nlq);
        CALL(UTAN_VECTOR(cm, history, STATE, LFT, llt, nlq, dsave, MESSAGE));
        CALL(UTAN_VECTOR(cm, history, STATE, LFT, llt, llt - 1, dsave, MESSAGE));
        CALL(UTAN_VECTOR(cm, history, 3, LFT, llt, nlq, dsave, MESSAGE));
        CALL(UTAN_VECTOR(cm, NULL, STATE, LFT, llt, nlq, dsave, MESSAGE));
    }
}

/* ---- OpenRadioss */

enum { RADIOSS_PARAMETERS = 16, RADIOSS_VARIABLES = 23 };

/* Of each law, by its number, those of properties, state variables and variables, of yarns, good ones and all, and of states. */
static const struct {
    size_t properties, state;
    int32_t variables;
    size_t good_yarns, yarns, states;
} radioss_laws[] = {
    {0},
    {PROPERTIES, STATE, 18, GOOD_YARNS, COUNT(yarns), COUNT(states)},
    {LINEAR, LINEAR_STATE, 26, GOOD_LINEAR_YARNS, COUNT(linear_yarns), COUNT(linear_states)},
    {RUBBING, SLIP_STATE, 22, GOOD_RUBBING_YARNS, RUBBING_YARNS, COUNT(slip_states)},
};

static real *radioss_yarn(int law, size_t yarn)
{
    return law == 1 ? given(yarns[yarn], PROPERTIES) : law == 2 ? given(linear_yarns[yarn], LINEAR) : rubbing_yarn(yarn);
}

/* Old states, component-major. */
static real *radioss_states(int law, size_t rows, size_t next, size_t n)
{
    const double *table = law == 1 ? states[0] : law == 2 ? linear_states[0] : slip_states[0];
    return by_component(table, radioss_laws[law].state, rows, next, n);
}

/* UPARAM of a law with one of its yarns. */
static real *radioss_parameters(int law, size_t yarn, double fibre_from)
{
    const size_t count = radioss_laws[law].properties;
    const double number = law;
    real *uparam = filled(0, RADIOSS_PARAMETERS);
    put(uparam, number);
    memcpy(uparam + 1, radioss_yarn(law, yarn), count * sizeof(real));
    put(uparam + 1 + count, fibre_from);
    return uparam;
}

/* NUPARAM: the law's number, the properties and the options. */
#define RADIOSS_COUNT(law) ((law) < 3 ? (law) + 13 : 16)

static void openradioss_lecm(void)
{
#define LECM ENTRY(toron_openradioss_lecm)
    for (int law = 1; law < 4; law++)
        for (size_t y = 0; y < radioss_laws[law].yarns; y++) {
            real *card = radioss_parameters(law, y, 0) + 1, *uparam = reals(RADIOSS_PARAMETERS), *parmat = reals(1);
            int32_t *counts = guarded(2 * sizeof *counts);
            ARGUMENTS("law %d, yarn %zu", law, y);
            CALL(LECM(law, card, 12, uparam, RADIOSS_PARAMETERS, counts, counts + 1, parmat, MESSAGE));
            CALL(LECM(law, card, 9, uparam, RADIOSS_PARAMETERS, counts, counts + 1, parmat, MESSAGE));
            CALL(LECM(law, card, 12, uparam, 5, counts, counts + 1, parmat, MESSAGE));
            CALL(LECM(law, NULL, 12, uparam, RADIOSS_PARAMETERS, counts, counts + 1, parmat, MESSAGE));
            CALL(LECM(law, card, 15, uparam, RADIOSS_PARAMETERS, counts, counts + 1, parmat, MESSAGE));
            CALL(LECM(law + 3, card, 12, uparam, RADIOSS_PARAMETERS, counts, counts + 1, parmat, MESSAGE));
            put(&card[radioss_laws[law].properties], 0.5); /* the option */
            CALL(LECM(law, card, 12, uparam, RADIOSS_PARAMETERS, counts, counts + 1, parmat, MESSAGE));
            release();
        }
}

static void openradioss_listing(void)
{
#define LISTING ENTRY(toron_openradioss_listing)
    for (int law = 1; law < 4; law++) {
        real *uparam = radioss_parameters(law, 0, 0), *wrong = radioss_parameters(law, 0, 0.25);
        for (int32_t line = -1; line < 45; line++)
            CALL(LISTING(uparam, RADIOSS_COUNT(law), line, MESSAGE));
        CALL(LISTING(uparam, 3, 0, MESSAGE));
        CALL(LISTING(wrong, RADIOSS_COUNT(law), 0, MESSAGE));
        CALL(LISTING(NULL, 13, 0, MESSAGE));
        release();
    }
}

static void openradioss_luser(void)
{
#define LUSER ENTRY(toron_openradioss_luser)
#define LUSER_WITH(nuvar, time, density, f0, stress, nodes)                                                                          \
    CALL(LUSER(n, RADIOSS_COUNT(law), nuvar, times[time], uparam, ngl, density, f0, f[4], f[8], f[3], f[7], f[2], f[1], f[5], f[6], s, s + n,   \
               s + 2 * n, s + 3 * n, s + 4 * n, stress, v, v + n, v + 2 * n, v + 3 * n, v + 4 * n, v + 5 * n, sound, v + 6 * n, uvar, \
               off, nodes, MESSAGE))
    static const real times[] = {0, 1, (real)SUBNORMAL, NAN};
    block_case b;
    for (int law = 1; law < 4; law++)
        for (size_t next = 0; next_block(&next, radioss_laws[law].good_yarns, radioss_laws[law].yarns, &b);) {
            const int32_t n = (int32_t)b.size, variables = radioss_laws[law].variables;
            const size_t rows = b.points == 0 ? radioss_laws[law].states : 3;
            real *f[9], *all = by_component(deformations[0], 9, points_of[b.points], next, b.size), *density = filled(2, 1);
            real *s = reals(6 * b.size), *v = reals(7 * b.size), *sound = reals(b.size), *off = filled(1, b.size);
            real *uvar = filled(0, (size_t)variables * b.size), *nodes = by_component(deformations[0], 24, 3, next, b.size);
            int32_t *ngl = guarded(b.size * sizeof *ngl);
            for (int c = 0; c < 9; c++)
                f[c] = all + (size_t)c * b.size;
            memcpy(uvar, radioss_states(law, rows, next, b.size), radioss_laws[law].state * b.size * sizeof(real));
            memset(ngl, 0, b.size * sizeof *ngl);
            put(&off[b.size - 1], next % 3 == 0 ? 0.5 : 1);
            for (int fibre_from = 0; fibre_from < 3; fibre_from++) {
                real *uparam = radioss_parameters(law, b.yarn, fibre_from);
                LUSER_WITH(variables, 0, density, f[0], s + 5 * n, nodes);
                LUSER_WITH(variables, 1, density, f[0], s + 5 * n, NULL);
                LUSER_WITH(variables, 2, density, f[0], s + 5 * n, NULL);
                LUSER_WITH(variables, 3, density, f[0], s + 5 * n, nodes);
                LUSER_WITH(variables, 0, density, f[0], s + 5 * n, NULL);
            }
            real *uparam = radioss_parameters(law, b.yarn, 0), *zero = filled(0, b.size), *no_density = filled(0, 1);
            LUSER_WITH(variables - 1, 1, density, f[0], s + 5 * n, NULL);
            LUSER_WITH(variables, 1, no_density, f[0], s + 5 * n, NULL);
            LUSER_WITH(variables, 1, density, NULL, s + 5 * n, NULL);
            LUSER_WITH(variables, 1, density, f[0], NULL, NULL);
            for (int c = 1; c < 9; c++)
                f[c] = zero;
            LUSER_WITH(variables, 1, density, zero, s + 5 * n, NULL);
        }
}

#ifndef SINGLE
static void lsdyna_bulk_and_shear(void)
{
    for (size_t y = 0; y < COUNT(yarns); y++) {
        real *yarn = given(yarns[y], PROPERTIES), *moduli = reals(2);
        ARGUMENTS("yarn %zu", y);
        CALL(toron_lsdyna_bulk_and_shear_f64(yarn, PROPERTIES, moduli, moduli + 1, MESSAGE));
        CALL(toron_lsdyna_bulk_and_shear_f64(yarn, 3, moduli, moduli + 1, MESSAGE));
        CALL(toron_lsdyna_bulk_and_shear_f64(yarn, PROPERTIES, moduli, NULL, MESSAGE));
        release();
    }
}

/* ---- CalculiX, which finds its entries by name. An error in the deck ends the process. */

typedef void behaviour(const char *amat, const int32_t *iel, const int32_t *iint, const int32_t *kode, const double *elconloc,
                       const double *emec, const double *emec0, const double *beta, const double *xokl, const double *voj,
                       const double *xkl, const double *vj, const int32_t *ithermal, const double *t1l, const double *dtime,
                       const double *time, const double *ttime, const int32_t *icmd, const int32_t *ielas, const int32_t *mi,
                       const int32_t *nstate, const double *xstateini, double *xstate, double *stre, double *stiff,
                       const int32_t *iorien, const double *pgauss, const double *orab, double *pnewdt, const int32_t *ipkon,
                       int32_t amat_length);
extern behaviour HYPERELASTIC, LINEARELASTIC, FRICTIONAL;

typedef struct {
    behaviour *law;
    char name[80];
    int32_t kode, state_count, orientation;
    double *yarn, *strain, *initial_stress, *f, *old, *new, *stress, *stiffness, *orab, *place, *pnewdt;
} deck;

#define CALCULIX(d)                                                                                                        \
    (d)->law((d)->name, &one, &one, &(d)->kode, (d)->yarn, (d)->strain, unused, (d)->initial_stress, unused, unused,   \
                 (d)->f, unused, &zero, unused, unused, unused, unused, &zero, &zero, &one, &(d)->state_count, (d)->old,   \
                 (d)->new, (d)->stress, (d)->stiffness, &(d)->orientation, (d)->place, (d)->orab, (d)->pnewdt, &zero, 80)
static const int32_t one = 1, zero = 0;
static const double unused[9] = {0};

/* Of each law the function, the numbers of properties and state variables, of variables with F, of yarns and states that are good, and
 * a state that is none. */
static const struct {
    const char *call;
    behaviour *law;
    int properties, state, variables, good_yarns, bad_state;
} calculix_laws[] = {
    {"HYPERELASTIC()", HYPERELASTIC, PROPERTIES, STATE, STATE, GOOD_YARNS, 6},
    {"LINEARELASTIC()", LINEARELASTIC, LINEAR, LINEAR_STATE, LINEAR_STATE + 9, GOOD_LINEAR_YARNS, 5},
    {"FRICTIONAL()", FRICTIONAL, RUBBING, SLIP_STATE, SLIP_STATE, GOOD_RUBBING_YARNS, 5},
};

static deck new_deck(int law, size_t yarn, size_t f, size_t state)
{
    const double nowhere[3] = {1, 2, 3}, axes[7] = {1, 1, 0, 0, 2, 1, 1};
    const double *old = law == 0 ? states[state] : law == 1 ? linear_states[state] : slip_states[state];
    const int properties = calculix_laws[law].properties, variables = calculix_laws[law].variables;
    deck d = {.law = calculix_laws[law].law, .kode = -100 - properties, .state_count = variables,
              .yarn = law == 0 ? given(yarns[yarn], PROPERTIES) : law == 1 ? given(linear_yarns[yarn], LINEAR) : rubbing_yarn(yarn),
              .strain = reals(6), .initial_stress = filled(0, 6), .f = given(deformations[f], 9),
              .old = filled(0, (size_t)variables), .new = reals((size_t)variables), .stress = reals(6), .stiffness = reals(21),
              .orab = given(axes, 7), .place = given(nowhere, 3),
              .pnewdt = given(&time_increments[(yarn + f) % COUNT(time_increments)], 1)};
    memset(d.name, ' ', sizeof d.name);
    /* F of the last increment stays 0, as at the start. */
    memcpy(d.old, given(old, (size_t)calculix_laws[law].state), (size_t)calculix_laws[law].state * sizeof(real));
    /* Lagrange's, as in an analysis with NLGEOM: 11 22 33 12 13 23. */
    const int first[6] = {0, 1, 2, 0, 0, 1}, second[6] = {0, 1, 2, 1, 2, 2};
    for (int c = 0; c < 6; c++) {
        const double *a = d.f + 3 * first[c], *b = d.f + 3 * second[c];
        d.strain[c] = 0.5 * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2] - (c < 3));
    }
    return d;
}

/* Whether this is the end of the program, or a child that is to end, or neither. */
static enum { CALLING, CHILD, DONE } phase;

/* An entry that ends the process: only errors in a deck are to, and in the environment that CalculiX has set. */
static void at_exit(void)
{
    if (phase == CHILD && _mm_getcsr() != environments[where].mxcsr)
        _exit(EXIT_FAILURE);
    if (phase == CALLING)
        printf("%s: %s: the process ends; %s\n", entries[entry].name, environments[where].name, arguments);
}

/* What a deck may have wrong ends the process, with CalculiX's code, and not by SIGFPE. */
static void calculix_refuses(int law)
{
    const size_t bad_yarn = (size_t)calculix_laws[law].good_yarns, bad_state = (size_t)calculix_laws[law].bad_state;
    enum { EXIT_CODE = 201, ERRORS = 8 };
    for (int error = 0; error < ERRORS; error++)
        for (where = 0; where < environment_count; where++) {
            deck d = new_deck(law, error == 0 ? bad_yarn : 0, 3, error == 1 ? bad_state : 0);
            d.state_count -= error == 2;
            d.kode += error == 3;
            put(&d.initial_stress[2], error == 4 ? 0.5 : error == 5 ? SIGNALLING : error == 6 ? SUBNORMAL : 0);
            if (error == 7) { /* the strain is that of small displacements */
                const double linear[6] = {0, -0.1, -0.2, 0.1, 0.05, 0.15};
                memcpy(d.strain, linear, sizeof linear);
            }
            int status = 0;
            ARGUMENTS("error %d in the deck", error);
            fflush(stdout);
            const pid_t child = fork();
            if (child == 0) {
                phase = CHILD;
                signal(SIGFPE, SIG_DFL);
                if (freopen("/dev/null", "w", stdout) == NULL)
                    exit(2);
                set_environment(&environments[where]);
                CALCULIX(&d);
                exit(0);
            }
            waitpid(child, &status, 0);
            if (WIFSIGNALED(status))
                fault(where, TRAPPED, "it ended by a signal");
            else if (WEXITSTATUS(status) != EXIT_CODE)
                fault(where, DIFFERENT, "it ended without CalculiX's code, or in another environment");
            release();
        }
}

static void calculix_law(int law)
{
    enum { STATES = 5, ORIENTATIONS = 3 }; /* another state is an error in the deck */
    const size_t good = (size_t)calculix_laws[law].good_yarns;
    for (size_t next = 0; next < good * DEFORMATIONS * STATES * ORIENTATIONS; next += stride) {
        size_t rest = next, orientation = rest % ORIENTATIONS, state = (rest /= ORIENTATIONS) % STATES;
        size_t f = (rest /= STATES) % DEFORMATIONS, y = rest / DEFORMATIONS;
        deck d = new_deck(law, y, f, state);
        d.orientation = orientation > 0;
        d.orab[6] = orientation == 1 ? 1 : -1; /* rectangular, cylindrical */
        ARGUMENTS("yarn %zu, F %zu, old state %zu, orientation %zu", y, f, state, orientation);
        RUN(calculix_laws[law].call, CALCULIX(&d); answer = 0);
        release();
    }
    calculix_refuses(law);
}

static void calculix(void)
{
    calculix_law(0);
}

static void calculix_linear(void)
{
    calculix_law(1);
}
#endif

#endif
