/* Counts what is wrong; arrays that notice a write beyond their ends; the truth's cases as `c/tests/c/ffi.rs` writes them. */
#ifndef CHECK_H
#define CHECK_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "toron.h"

/* The precision under test: entries toron_..._f64 or, with -DSINGLE, toron_..._f32. */
#ifdef SINGLE
typedef float real;
typedef toron_block_f32 toron_block;
typedef toron_linear_block_f32 toron_linear_block;
typedef toron_vumat_f32 toron_vumat;
#define ENTRY(name) name##_f32
/* What the truth allows, in parts of one rounding of the input: see tests/law/truth.rs. */
#define ALLOWED (8 * 6e-8)
#else
typedef double real;
typedef toron_block_f64 toron_block;
typedef toron_linear_block_f64 toron_linear_block;
typedef toron_vumat_f64 toron_vumat;
#define ENTRY(name) name##_f64
#define ALLOWED (5 * 0x1p-53)
#endif

enum { PROPERTIES = TORON_HYPERELASTIC_PROPERTIES, STATE = TORON_HYPERELASTIC_STATE };
/* Where the groups of the state start. */
enum { ENERGIES = 0, INVARIANTS = 4, FAILURE = 8, FAILED = 9, ALIVE = 10 };

static int failures;

/* CHECK(condition, format, ...): what to print where it does not hold. */
#define CHECK(condition, ...)                                               \
    do {                                                                    \
        if (!(condition)) {                                                 \
            failures++;                                                     \
            fprintf(stderr, "%s:%d: %s: ", __FILE__, __LINE__, #condition); \
            fprintf(stderr, __VA_ARGS__);                                   \
            fputc('\n', stderr);                                            \
        }                                                                   \
    } while (0)

/* ---- Guarded arrays: every byte holds PATTERN at first, GUARD bytes on either side for good. Compiled with -DMEMCHECK, valgrind
 * is told that nobody has given them a value yet, and that the guards are nobody's. */

#ifdef MEMCHECK
#include <valgrind/memcheck.h>
#define UNDEFINED(start, bytes) (void)VALGRIND_MAKE_MEM_UNDEFINED(start, bytes)
#define DEFINED(start, bytes) (void)VALGRIND_MAKE_MEM_DEFINED(start, bytes)
#define FORBIDDEN(start, bytes) (void)VALGRIND_MAKE_MEM_NOACCESS(start, bytes)
/* Around a check that reads such bytes on purpose. */
#define UNCHECKED_BEGIN VALGRIND_DISABLE_ERROR_REPORTING
#define UNCHECKED_END VALGRIND_ENABLE_ERROR_REPORTING
#else
#define UNDEFINED(start, bytes) (void)0
#define DEFINED(start, bytes) (void)0
#define FORBIDDEN(start, bytes) (void)0
#define UNCHECKED_BEGIN (void)0
#define UNCHECKED_END (void)0
#endif

enum { GUARD = 64, PATTERN = 0xA5, MOST_ARRAYS = 64 };

static struct {
    unsigned char *start;
    size_t bytes;
} arrays[MOST_ARRAYS];
static int array_count;

static void *guarded(size_t bytes)
{
    unsigned char *start = malloc(bytes + 2 * GUARD);
    if (start == NULL || array_count == MOST_ARRAYS) {
        fputs("no room for another array\n", stderr);
        exit(2);
    }
    memset(start, PATTERN, bytes + 2 * GUARD);
    UNDEFINED(start + GUARD, bytes);
    FORBIDDEN(start, GUARD);
    FORBIDDEN(start + GUARD + bytes, GUARD);
    arrays[array_count].start = start;
    arrays[array_count++].bytes = bytes;
    return start + GUARD;
}

static real *reals(size_t count)
{
    return guarded(count * sizeof(real));
}

/* A guarded copy. */
static inline real *copied(const double *values, size_t count)
{
    real *copy = reals(count);
    for (size_t i = 0; i < count; i++)
        copy[i] = (real)values[i];
    return copy;
}

static inline real *filled(double value, size_t count)
{
    real *array = reals(count);
    for (size_t i = 0; i < count; i++)
        array[i] = (real)value;
    return array;
}

static int untouched(const void *start, size_t bytes)
{
    int same = 1;
    UNCHECKED_BEGIN;
    for (size_t i = 0; i < bytes; i++)
        if (((const unsigned char *)start)[i] != PATTERN)
            same = 0;
    DEFINED(&same, sizeof same);
    UNCHECKED_END;
    return same;
}

/* Checks the guards of every array, and frees them all. */
static inline void release(void)
{
    for (int i = 0; i < array_count; i++) {
        const unsigned char *start = arrays[i].start;
        CHECK(untouched(start, GUARD), "array %d: written before its start", i);
        CHECK(untouched(start + GUARD + arrays[i].bytes, GUARD), "array %d: written beyond its end", i);
        free(arrays[i].start);
    }
    array_count = 0;
}

/* ---- The truth. Stress and modes 11 22 33 12 23 31. A scale is |truth| plus what one rounding of F does. */

enum { MOST_CASES = 300 };

typedef struct {
    int id;
    double properties[PROPERTIES], f[9];
    double stress[6], stress_scale;
    double energies[4], energy_scales[2][4]; /* in double and in single precision */
    double invariants[4], invariant_scales[4];
    double modes[24];
    int modes_bounded; /* not where the pull-back magnifies errors */
    int failed;
    int clear; /* far enough from the limit for single precision to tell */
    double ddsdde[36], ddsdde_allowed; /* 11 22 33 12 13 23; what |error| may be, 1e300 where the input allows nothing */
} truth;

static truth cases[MOST_CASES];
static int case_count;

static int numbers(FILE *file, double *to, int count)
{
    for (int i = 0; i < count; i++)
        if (fscanf(file, "%lf", &to[i]) != 1)
            return 0;
    return 1;
}

static inline void read_cases(int argc, char **argv)
{
    FILE *file = argc >= 2 ? fopen(argv[1], "r") : NULL;
    if (file == NULL) {
        fputs("usage: program CASES\n", stderr);
        exit(2);
    }
    truth *t = cases;
    while (case_count < MOST_CASES && fscanf(file, "%d", &t->id) == 1) {
        int complete = numbers(file, t->properties, PROPERTIES) && numbers(file, t->f, 9) && numbers(file, t->stress, 6)
            && numbers(file, &t->stress_scale, 1) && numbers(file, t->energies, 4) && numbers(file, t->energy_scales[0], 8)
            && numbers(file, t->invariants, 4) && numbers(file, t->invariant_scales, 4) && numbers(file, t->modes, 24)
            && fscanf(file, "%d %d %d", &t->modes_bounded, &t->failed, &t->clear) == 3 && numbers(file, t->ddsdde, 36)
            && numbers(file, &t->ddsdde_allowed, 1);
        CHECK(complete, "case %d of the file", case_count);
        case_count++;
        t++;
    }
    fclose(file);
    CHECK(case_count == 256, "%d cases", case_count);
}

static inline double norm(const double s[6])
{
    return sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + 2 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

static inline double determinant(const double *f)
{
    return f[0] * (f[4] * f[8] - f[5] * f[7]) - f[3] * (f[1] * f[8] - f[2] * f[7]) + f[6] * (f[1] * f[5] - f[2] * f[4]);
}

/* |a - b| of two symmetric tensors; component c of `a` at a[c * stride]. */
static inline double distance(const real *a, size_t stride, const double b[6])
{
    double difference[6];
    for (int c = 0; c < 6; c++)
        difference[c] = (double)a[(size_t)c * stride] - b[c];
    return norm(difference);
}

/* Component c at s[c * stride], with the error that the truth allows. */
static inline void check_stress(const truth *t, const real *s, size_t stride)
{
    double error = distance(s, stride, t->stress);
    CHECK(error <= ALLOWED * t->stress_scale, "case %d: error %g of %g", t->id, error, t->stress_scale);
}

/* The new state, variable j at state[j * stride]. */
static inline void check_state(const truth *t, const real *state, size_t stride)
{
    for (size_t k = 0; k < 4; k++) {
        double w = state[(ENERGIES + k) * stride], i = state[(INVARIANTS + k) * stride];
        CHECK(fabs(w - t->energies[k]) <= ALLOWED * t->energy_scales[sizeof(real) == sizeof(float)][k], "case %d: energy %d is %g", t->id, (int)k, w);
        CHECK(fabs(i - t->invariants[k]) <= ALLOWED * t->invariant_scales[k], "case %d: invariant %d is %g", t->id,
              (int)k, i);
    }
    double failed = state[FAILED * stride], alive = state[ALIVE * stride];
    CHECK(failed == t->failed || (!t->clear && failed == !t->failed), "case %d: failed is %g", t->id, failed);
    CHECK(alive == 1 - failed, "case %d: alive is %g", t->id, alive);
}

/* A tangent against the truth, entry k at c[k * stride], where c is DDSDDE if `stress` is null and otherwise the Truesdell
 * modulus that goes with this stress; in the library's order, 11 22 33 12 23 31, or, if `standard`, in Abaqus's. */
static inline void check_tangent(const truth *t, const real *c, size_t stride, const real *stress, int standard)
{
    const int in_truth[6] = {0, 1, 2, 3, standard ? 4 : 5, standard ? 5 : 4};
    const int first[6] = {0, 1, 2, 0, 1, 2}, second[6] = {0, 1, 2, 1, 2, 0}, component[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    double square = 0, size = 0, allowed = t->ddsdde_allowed;
    for (size_t i = 0; i < 6; i++)
        for (size_t j = 0; j < 6; j++) {
            CHECK(c[(6 * i + j) * stride] == c[(6 * j + i) * stride], "case %d: %d %d", t->id, (int)i, (int)j);
            double found = c[(6 * i + j) * stride], wanted = t->ddsdde[6 * in_truth[i] + in_truth[j]];
            if (stress != NULL) {
                int a = first[i], b = second[i], k = first[j], l = second[j];
                found += 0.5 * ((a == k) * (double)stress[component[b][l]] + (b == l) * (double)stress[component[a][k]]
                                + (a == l) * (double)stress[component[b][k]] + (b == k) * (double)stress[component[a][l]]);
            }
            square += (found - wanted) * (found - wanted);
            size += wanted * wanted;
        }
    /* In single precision the rounding of F decides on which side of a kink a small strain is. */
    if (sizeof(real) == sizeof(float))
        allowed = fabs(t->invariants[0]) > 1e-3 && fabs(t->invariants[1]) > 1e-3 && allowed < 1e300 ? 3e-4 * sqrt(size) : 1e300;
    CHECK(sqrt(square) <= allowed, "case %d: error %g of %g", t->id, sqrt(square), sqrt(size));
}

/* How many cases from `first` on share their first `count` properties: they can go in one block. */
static inline int run_of_cases(int first, int count)
{
    int n = 1;
    while (first + n < case_count
           && memcmp(cases[first].properties, cases[first + n].properties, (size_t)count * sizeof(double)) == 0)
        n++;
    return n;
}

static inline int finish(void)
{
    if (failures > 0)
        fprintf(stderr, "%d failures\n", failures);
    return failures > 0;
}

/* A block of one point, from a fresh state: what a block must say of a point, wherever it stands. */
static inline void block_of_one(const real *properties, const real *f, real *state, real *stress)
{
    toron_block block = {.n = 1, .leading_dimension = 1, .deformation_gradient = f, .stress = stress,
                         .energies = state, .invariants = state + INVARIANTS, .failure = state + FAILURE};
    ENTRY(toron_hyperelastic_block)(properties, PROPERTIES, &block);
}

#endif
