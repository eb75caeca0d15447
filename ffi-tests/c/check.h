/* Counts what is wrong; arrays that notice a write beyond their ends; the truth's cases as `c/tests/c/ffi.rs` writes them. */
#ifndef CHECK_H
#define CHECK_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "toron.h"

/* The precision under test: ENTRY(toron_...) is toron_..._f64 or, with -DSINGLE, toron_..._f32. */
#ifdef SINGLE
typedef float real;
#define ENTRY(name) name##_f32
/* What the truth allows, in parts of one rounding of the input: see tests/law/truth.rs. */
#define ALLOWED (8 * 6e-8)
#else
typedef double real;
#define ENTRY(name) name##_f64
#define ALLOWED (5 * 0x1p-53)
#endif
#define TEXT_OF(name) #name
#define TEXT(name) TEXT_OF(name)
typedef ENTRY(toron_hyperelastic) toron_hyperelastic;
typedef ENTRY(toron_point) toron_point;
typedef ENTRY(toron_block) toron_block;
typedef ENTRY(toron_linear_elastic) toron_linear_elastic;
typedef ENTRY(toron_linear_point) toron_linear_point;
typedef ENTRY(toron_linear_increment) toron_linear_increment;
typedef ENTRY(toron_linear_block) toron_linear_block;
typedef ENTRY(toron_vumat) toron_vumat;

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

enum { GUARD = 64, PATTERN = 0xA5, MOST_ARRAYS = 1000 };

static struct {
    unsigned char *start;
    size_t bytes;
    int opaque;
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
    arrays[array_count].opaque = 0;
    arrays[array_count++].bytes = bytes;
    return start + GUARD;
}

/* A structure whose bytes are the library's affair, or hold addresses. */
static inline void *opaque(size_t bytes)
{
    void *structure = guarded(bytes);
    arrays[array_count - 1].opaque = 1;
    return structure;
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

/* As memcmp() == 0, for arrays with gaps that nobody has written. */
static inline int same_bytes(const void *a, const void *b, size_t bytes)
{
    UNCHECKED_BEGIN;
    int same = memcmp(a, b, bytes) == 0;
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

/* ---- Messages, in a buffer that is larger than it need be. */

static char text[TORON_MESSAGE_CAPACITY + GUARD];

static inline char *fresh_text(void)
{
    memset(text, PATTERN, sizeof text);
    return text;
}

/* The status of a call that got this buffer: it is written only if there is an error, and then no further than the message. */
static inline int32_t told(int32_t status)
{
    const char *end = memchr(text, '\0', sizeof text);
    size_t length = end == NULL ? sizeof text : (size_t)(end - text);
    if (status >= 0)
        CHECK(untouched(text, sizeof text), "a message without an error");
    else
        CHECK(length > 0 && length < TORON_MESSAGE_CAPACITY - 1 && untouched(text + length + 1, sizeof text - length - 1),
              "status %d", status);
    return status;
}

/* TOLD(entry, arguments...): the call with a buffer for a message. */
#define TOLD(entry, ...) told(entry(__VA_ARGS__, fresh_text(), TORON_MESSAGE_CAPACITY))

enum { ROOMS = 7 };

/* Sizes of a buffer for a message of this length, from none at all to an exact fit and more. */
static inline size_t capacity_of(int room, size_t length)
{
    const size_t capacities[ROOMS] = {0, 0, 1, 2, length, length + 1, TORON_MESSAGE_CAPACITY};
    return capacities[room];
}

/* The text in a buffer of this size, which holds as much of the message as fits. */
static inline void check_text(const char *whole, size_t capacity, int line)
{
    size_t length = strlen(whole), written = capacity <= length ? capacity : length + 1;
    if (capacity > 0)
        CHECK(text[written - 1] == '\0' && strncmp(text, whole, written - 1) == 0, "line %d, capacity %zu: %.200s", line, capacity,
              text);
    CHECK(untouched(text + written, sizeof text - written), "line %d, capacity %zu", line, capacity);
}

/* REFUSED(code, message, entry, arguments...): the call fails with this code and this message, in buffers of all sizes. */
#define REFUSED(code, message, entry, ...)                                                      \
    do {                                                                                        \
        for (int room = 0; room < ROOMS; room++) {                                              \
            size_t capacity = capacity_of(room, strlen(message));                               \
            fresh_text();                                                                       \
            int32_t refusal = entry(__VA_ARGS__, room == 0 ? NULL : text, capacity);            \
            CHECK(refusal == (code), "%d: %s", refusal, message);                               \
            check_text(message, capacity, __LINE__);                                            \
        }                                                                                       \
    } while (0)

/* Messages that several entries give. */
#define NOT_PREPARED_BY(entry) "the law has not been prepared by " TEXT(ENTRY(entry))
#define INVERTED_TEXT "the deformation gradient has a determinant <= 0 or maps the fibre to zero length"
/* The most points, and the greatest distance between two components. */
#define MOST_DISTANCE ((SIZE_MAX >> 1) >> 10)
#define MOST_TEXT "9007199254740991"
#define NO_FIBRE_TEXT "the fibre direction of this point is zero, NaN or infinite, or along the second axis"
#define LEVELS_TEXT "0 (the best), 1 (baseline), 2 (AVX2) or 3 (AVX-512)"
#define MEASURES_TEXT "0 (material), 1 (Truesdell), 2 (Jaumann) or 3 (nominal)"
#define DENSITIES_TEXT "a finite number > 0, not subnormal"

/* ---- What may be left out: outputs that a structure has pointers to. */

typedef struct {
    size_t at, bytes; /* of the pointer in the structure; of the array */
} output;

enum { MOST_OUTPUTS = 9 };

/* Sets the pointers of the outputs whose bits are in `wanted` to new arrays, the others to null. */
static inline void request(void *structure, const output *outputs, size_t count, unsigned wanted, void **arrays_of_outputs)
{
    for (size_t k = 0; k < count; k++) {
        arrays_of_outputs[k] = wanted >> k & 1 ? guarded(outputs[k].bytes) : NULL;
        memcpy((char *)structure + outputs[k].at, &arrays_of_outputs[k], sizeof(void *));
    }
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
        CHECK(fabs(w - t->energies[k]) <= ALLOWED * t->energy_scales[sizeof(real) == sizeof(float)][k], "case %d: energy %d is %g",
              t->id, (int)k, w);
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

/* The law of these properties, in a guarded structure. */
static inline toron_hyperelastic *prepared(const real *properties)
{
    toron_hyperelastic *law = guarded(sizeof *law);
    int32_t status = TOLD(ENTRY(toron_hyperelastic_prepare), law, sizeof *law, properties, PROPERTIES);
    CHECK(status == TORON_OK, "%d: %s", status, text);
    return law;
}

/* A block of one point, from a fresh state: what a block must say of a point, wherever it stands. */
static inline void block_of_one(const real *properties, const real *f, real *state, real *stress)
{
    toron_block block = {.size = sizeof block, .n = 1, .leading_dimension = 1, .deformation_gradient = {f}, .stress = {stress},
                         .energies = state, .invariants = state + INVARIANTS, .failure = state + FAILURE};
    ENTRY(toron_hyperelastic_block_with_properties)(properties, PROPERTIES, &block, NULL, 0);
}

#endif
