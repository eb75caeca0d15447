/* What the entries get in `environment.c`: yarns, deformations and states, good ones and such as no law can serve. */
#ifndef ENVIRONMENT_INPUTS_H
#define ENVIRONMENT_INPUTS_H

#include "check.h"

/* ---- Inputs. Numbers that stand for others: what is huge, tiny or subnormal is so in the precision under test. */

#ifdef SINGLE
#define HUGE_NUMBER 1e30
#define TINY 1e-30
#define SUBNORMAL 1e-42
#else
#define HUGE_NUMBER 1e200
#define TINY 1e-200
#define SUBNORMAL 1e-310
#endif
#define SIGNALLING 0x1.5ap99

/* Numbers that are double in either precision. */
static void put_double(double *to, double value)
{
    static const uint64_t signalling_nan = 0x7ff4000000000000;
    if (value == SIGNALLING)
        memcpy(to, &signalling_nan, sizeof *to);
    else
        *to = value;
}

static void put(real *to, double value)
{
#ifdef SINGLE
    static const uint32_t signalling_nan = 0x7fa00000;
    if (value == SIGNALLING)
        memcpy(to, &signalling_nan, sizeof *to);
    else
        *to = (real)value;
#else
    put_double(to, value);
#endif
}

static real *given(const double *values, size_t count)
{
    real *array = reals(count);
    for (size_t i = 0; i < count; i++)
        put(&array[i], values[i]);
    return array;
}

#define COUNT(table) (sizeof(table) / sizeof *(table))

/* k_el k_tc p k_td k_ld eps_lim alpha beta m_1 m_2 m_3. */
static const double yarns[][PROPERTIES] = {
    {82.341, 1.055, 2.2, 0.64974, 0.1, 0.0458, 1.8, 0, 1, 0, 0},
    {82.341, 1.055, 2.2, 0.64974, 0, 0.0458, 1.8, 0, 1, 0, 0},
    {82.341, 1.055, 2.2, 0.64974, 0.1, 0, 0, 0, 1, 0, 0},
    {82.341, 1.055, 2.2, 0.64974, 0, 0.0458, 1.8, 0.5, 0.3, -0.5, 0.8},
    {82.341, 1.055, 3, 0.64974, 0.1, 0.0458, 1.8, 0.5, 0.3, -0.5, 0.8},
    {1e20, 1e25, 40, 1e25, 1e25, 10, 0, 0, -3, 0, 0},
    {0, 0, 1.0001, 0, 0, 0, 0, 0, 0, 0, TINY},
    /* Refused. */
    {0, 0, 1.0001, 0, 0, 0, 0, 0, 0, 0, SUBNORMAL},
    {NAN, 1.055, 2.2, 0.64974, 0.1, 0.0458, 1.8, 0, 1, 0, 0},
    {82.341, SIGNALLING, 2.2, 0.64974, 0.1, 0.0458, 1.8, 0, 1, 0, 0},
    {82.341, 1.055, INFINITY, 0.64974, 0.1, 0.0458, 1.8, 0, 1, 0, 0},
    {82.341, 1.055, 0.5, 0.64974, 0.1, 0.0458, 1.8, 0, 1, 0, 0},
    {-SUBNORMAL, 1.055, 2.2, 0.64974, 0.1, 0.0458, 1.8, 0, 1, 0, 0},
    {82.341, 1.055, 2.2, 0.64974, 0.1, 0.0458, 1.8, 0, 0, 0, 0},
    {82.341, 1.055, 2.2, 0.64974, 0.1, 0.0458, 1.8, 0, 1, SIGNALLING, 0},
};
enum { GOOD_YARNS = 7 };

/* Deformation gradients by columns. */
static const double deformations[][9] = {
    {1, 0, 0, 0, 1, 0, 0, 0, 1},
    {1.02, 0, 0, 0, 1, 0, 0, 0, 1},
    {0.97, 0.01, 0, 0, 1.1, 0, -0.02, 0, 0.9},
    {1, 0.2, 0.1, 0, 0.9, 0, 0, 0.3, 0.8},
    {1, 0, 0, 0, 0.7, 0, 0, 0, 0.7},
    {0.03, 1.01, -0.2, -0.9, 0.1, 0.3, 0.2, 0.1, 1.1},
    {1, -0.0, 0, 0, 1, -0.0, 0, 0, 1},
    {1 + 1e-9, 1e-12, 0, 0, 1 - 1e-7, 0, 0, 1e-9, 1},
    {1, TINY, SUBNORMAL, SUBNORMAL, 1, TINY, TINY, -SUBNORMAL, 1},
    /* Failing. */
    {1.2, 0, 0, 0, 1, 0, 0, 0, 1},
    {1.5, 0.4, 0, 0.1, 1, 0.2, 0.3, 0, 2},
    {1, 0, 0, 0, 1e-3, 0, 0, 0, 1e-3},
    {1, 0, 0, 50, 1, 0, 0, -20, 1},
    /* At fault. */
    {-1, 0, 0, 0, 1, 0, 0, 0, 1},
    {0, 0, 0, 0, 0, 0, 0, 0, 0},
    {0, 0, 0, 0, 1, 0, 0, 0, 1},
    {1, 0, 0, 0, 1, 0, 0, 1, 0},
    {NAN, 0, 0, 0, 1, 0, 0, 0, 1},
    {1, 0, 0, 0, SIGNALLING, 0, 0, 0, 1},
    {1, 0, 0, 0, 1, 0, SIGNALLING, 0, 1},
    {INFINITY, 0, 0, 0, 1, 0, 0, 0, 1},
    {1, 0, -INFINITY, 0, INFINITY, 0, 0, 0, 1},
    {HUGE_NUMBER, 0, 0, 0, HUGE_NUMBER, 0, 0, 0, HUGE_NUMBER},
    {HUGE_NUMBER, HUGE_NUMBER, -HUGE_NUMBER, 1, HUGE_NUMBER, 0, 0, 3, -HUGE_NUMBER},
    {HUGE_NUMBER, 0, 0, 0, TINY, 0, 0, 0, 1},
    {1, 0, 0, 0, HUGE_NUMBER, 0, 0, 0, 1},
    {TINY, 0, 0, 0, TINY, 0, 0, 0, TINY},
    {1, 0, 0, 0, TINY, 0, 0, 0, TINY},
    {SUBNORMAL, 0, 0, 0, SUBNORMAL, 0, 0, 0, SUBNORMAL},
};
enum { REST = 1, GOOD_DEFORMATIONS = 9, DEFORMATIONS = COUNT(deformations) };

/* W_el W_tc W_td W_ld, I_el I_tc I_td I_ld, failure index, failed, alive. */
static const double states[][STATE] = {
    {0},
    {0.1, 0.2, 0.3, 0.4, 0.01, 0.02, 0.03, 0.04, 0.5, 0, 1},
    {0.1, 0.2, 0.3, 0.4, 0.01, 0.02, 0.03, 0.04, 1.5, 1, 0},
    {SUBNORMAL, TINY, 0, 0, SUBNORMAL, -SUBNORMAL, 0, 0, SUBNORMAL, 0, 1},
    {HUGE_NUMBER, HUGE_NUMBER, HUGE_NUMBER, HUGE_NUMBER, HUGE_NUMBER, 0, 0, 0, HUGE_NUMBER, SUBNORMAL, 1},
    {0, NAN, 0, 0, 0, 0, 0, 0, 0, 0, 1},
    {0, 0, 0, 0, SIGNALLING, 0, 0, 0, 0, 1, 0},
    {0, 0, 0, 0, 0, 0, 0, 0, 0, SIGNALLING, 1},
    {0, 0, 0, 0, 0, 0, 0, 0, INFINITY, 0, 1},
};

static const double fibres[][3] = {
    {1, 0, 0}, {0.3, -4, 0.2}, {0, 0, TINY}, {HUGE_NUMBER, HUGE_NUMBER, 0}, {0, SUBNORMAL, 0},
    {0, 0, 0}, {NAN, 0, 1}, {1, SIGNALLING, 0}, {INFINITY, 0, 0},
};

static const double densities[] = {1351, 0, SUBNORMAL, 1e-310, 1e300, -1, INFINITY, NAN, SIGNALLING};

/* ---- The linear elastic law: E_1 G_t G_12 sigma_lim, the fibre and the second axis. */

enum { LINEAR = TORON_LINEAR_ELASTIC_PROPERTIES, LINEAR_STATE = TORON_LINEAR_ELASTIC_STATE };

static const double linear_yarns[][LINEAR] = {
    {79.414, 0.794, 0.126, 3.637, 1, 0, 0, 0, 0, 0},
    {79.414, 0.794, 0.126, 0, 0.3, -0.5, 0.8, 0, 1, 0},
    {1e25, TINY, SUBNORMAL, 3.637, 0, 0, TINY, HUGE_NUMBER, 0, 0},
    /* Refused. */
    {79.414, 0.794, 0.126, 3.637, 0, 0, SUBNORMAL, 0, 0, 0},
    {79.414, 0.794, 0.126, 3.637, 1, 0, 0, -2, 0, 0},
    {79.414, 0.794, 0.126, SIGNALLING, 1, 0, 0, 0, 0, 0},
    {79.414, NAN, 0.126, 3.637, 1, 0, 0, 0, 0, 0},
    {-1, 0.794, 0.126, 3.637, 1, 0, 0, 0, 0, 0},
};
enum { GOOD_LINEAR_YARNS = 3 };

/* Stress, work, failed, alive. */
static const double linear_states[][LINEAR_STATE] = {
    {0},
    {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.1, 0, 1},
    {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.1, 1, 0},
    {SUBNORMAL, -SUBNORMAL, TINY, 0, 0, 0, SUBNORMAL, SUBNORMAL, 0, 1},
    {HUGE_NUMBER, -HUGE_NUMBER, 0, HUGE_NUMBER, 0, 0, HUGE_NUMBER, HUGE_NUMBER, 0, 1},
    {0, NAN, 0, 0, 0, 0, 0, 0, 0, 1},
    {0, 0, 0, 0, 0, SIGNALLING, 0, 0, 0, 1},
    {0, 0, 0, 0, 0, 0, 0, 0, SIGNALLING, 1},
};

/* Axes that turn: the reference ones, turned ones, not orthogonal, none, no numbers. */
static const double axes_in_space[][9] = {
    {1, 0, 0, 0, 1, 0, 0, 0, 1}, {0.6, 0.8, 0, -0.8, 0.6, 0, 0, 0, 1}, {1, TINY, SUBNORMAL, 0.5, 1, 0, 0, 0, 2},
    {0, 0, 0, 0, 0, 0, 0, 0, 0}, {1, 0, 0, 0, SIGNALLING, 0, 0, 0, NAN},
};

/* ---- The law with friction: yarns of the hyperelastic law, and friction. */

enum {
    RUBBING = TORON_FRICTIONAL_PROPERTIES, SLIP_STATE = TORON_FRICTIONAL_STATE, GOOD_FRICTIONS = 4, BAD_FRICTIONS = 4,
    GOOD_RUBBING_YARNS = GOOD_YARNS, RUBBING_YARNS = GOOD_YARNS + BAD_FRICTIONS + 1,
};

/* mu and cohesion: good ones, and such as are refused. */
static const double frictions[GOOD_FRICTIONS + BAD_FRICTIONS][2] = {
    {0.25, 0}, {0.1, 1e-3}, {0, 0}, {0.9, SUBNORMAL}, {1, 0}, {-0.1, 0}, {NAN, 0}, {0.2, SIGNALLING},
};

/* A yarn of the hyperelastic law with friction; the last one is refused whatever its friction. */
static real *rubbing_yarn(size_t k)
{
    const size_t refused = k - GOOD_YARNS;
    const double *yarn = yarns[k < GOOD_YARNS ? k : refused < BAD_FRICTIONS ? 0 : GOOD_YARNS];
    const double *friction = frictions[k < GOOD_YARNS ? k % GOOD_FRICTIONS : refused < BAD_FRICTIONS ? GOOD_FRICTIONS + refused : 0];
    double values[RUBBING];
    memcpy(values, yarn, PROPERTIES * sizeof *values);
    memcpy(values + PROPERTIES, friction, 2 * sizeof *values);
    return given(values, RUBBING);
}

/* W_el W_tc W_td W_ld, I_el I_tc I_td I_ld, w_fr I_te d1 d2, failure index, failed, alive. */
static const double slip_states[][SLIP_STATE] = {
    {0},
    {0.1, 0.2, 0.3, 0.4, 0.01, 0.02, 0.03, 0.04, 0.01, 0.02, 0.3, -0.2, 0.5, 0, 1},
    {0.1, 0.2, 0.3, 0.4, 0.01, 0.02, 0.03, 0.04, 0.02, 0.03, -5, 0.7, 1.5, 1, 0},
    {SUBNORMAL, TINY, 0, 0, SUBNORMAL, -SUBNORMAL, 0, 0, SUBNORMAL, 0, -SUBNORMAL, TINY, SUBNORMAL, 0, 1},
    {HUGE_NUMBER, HUGE_NUMBER, 0, 0, HUGE_NUMBER, 0, 0, 0, HUGE_NUMBER, HUGE_NUMBER, HUGE_NUMBER, -HUGE_NUMBER, 0, SUBNORMAL, 1},
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, NAN, 0, 0, 0, 1},
    {0, 0, 0, 0, 0, 0, 0, 0, SIGNALLING, 0, 0, 0, 0, 1, 0},
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, SIGNALLING, 0, 0, 1},
    {0, 0, 0, 0, 0, 0, 0, 0, 0, -1, 0, INFINITY, 0, 0, 1},
};

/* ---- Blocks */

/* Component-major arrays of n points, a row of the table each; point i has row (first + 5 i) mod rows. */
static real *by_component(const double *table, size_t components, size_t rows, size_t first, size_t n)
{
    real *array = reals(components * n);
    for (size_t i = 0; i < n; i++)
        for (size_t c = 0; c < components; c++)
            put(&array[c * n + i], table[(first + 5 * i) % rows * components + c]);
    return array;
}

#endif
