/* Structures of other versions of the interface: shorter ones, of which nothing is read or written beyond their size, longer ones, and
 * sizes that no structure has. Each lies directly before a page that must not be touched. */
#define _GNU_SOURCE /* MAP_ANONYMOUS */
#include <sys/mman.h>
#include <unistd.h>

#include "check.h"

/* Room for `bytes` bytes that end where the page begins; the same room every time. */
static unsigned char *before_the_page(size_t bytes)
{
    enum { ROOM = 1 << 17 };
    static unsigned char *start;
    if (start == NULL) {
        size_t page = (size_t)sysconf(_SC_PAGESIZE);
        start = mmap(NULL, ROOM + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (start == MAP_FAILED || mprotect(start + ROOM, page, PROT_NONE) != 0) {
            fputs("no pages\n", stderr);
            exit(2);
        }
    }
    memset(start, PATTERN, ROOM);
    return start + ROOM - bytes;
}

/* ---- The inputs, and the outputs in one piece of memory. */

enum { N = 5, LD = 7, MOST = 1 << 15 };

static real f[81 * LD], fibre[81], old[81], stretch[6 * N];
static _Alignas(8) unsigned char results[MOST], wanted[MOST];
static size_t used;

static real *result(size_t count)
{
    real *array = (real *)(void *)(results + used);
    used += (count * sizeof(real) + 7) / 8 * 8;
    if (used > MOST) {
        fputs("no room for another output\n", stderr);
        exit(2);
    }
    return array;
}

static real properties[PROPERTIES], linear_properties[TORON_LINEAR_ELASTIC_PROPERTIES];
static toron_hyperelastic law;
static toron_linear_elastic linear;

static void make_inputs(void)
{
    for (size_t i = 0; i < sizeof f / sizeof *f; i++)
        f[i] = (real)((i % 9 % 4 == 0 ? 1 : 0) + 0.001 * (double)(i * 7 % 11));
    for (size_t i = 0; i < sizeof fibre / sizeof *fibre; i++)
        fibre[i] = (real)(1 + i * i % 7), old[i] = (real)(0.001 * (double)(i % 7));
    for (size_t i = 0; i < sizeof stretch / sizeof *stretch; i++)
        stretch[i] = (real)((i < 3 * N ? 1 : 0) + 0.001 * (double)(i % 7));
    ENTRY(toron_preset)("kevlar-km2-600", "mm-kg-ms", properties, PROPERTIES, NULL, NULL, 0);
    ENTRY(toron_preset)("kevlar-km2-600-linear", "mm-kg-ms", linear_properties, TORON_LINEAR_ELASTIC_PROPERTIES, NULL, NULL, 0);
    ENTRY(toron_hyperelastic_prepare)(&law, sizeof law, properties, PROPERTIES, NULL, 0);
    ENTRY(toron_linear_elastic_prepare)(&linear, sizeof linear, linear_properties, TORON_LINEAR_ELASTIC_PROPERTIES, NULL, 0);
}

/* ---- A structure of each kind, with every member set, and the calls that read it. */

static void make_point(void *to)
{
    toron_point point = {.size = sizeof point, .measure = TORON_TANGENT_JAUMANN, .level = TORON_LEVEL_AVX2, .density = 1.4,
                         .deformation_gradient = f, .fibre = fibre, .state_old = old, .state_new = result(STATE), .stress = result(6),
                         .modes = result(24), .wave_speed = result(1), .tangent = result(36)};
    memcpy(to, &point, sizeof point);
}

static void make_block(void *to)
{
    const toron_layout by_point = {.leading_dimension = 1, .stride = 9};
    toron_block block = {.size = sizeof block, .n = N, .leading_dimension = LD, .measure = TORON_TANGENT_JAUMANN,
                         .level = TORON_LEVEL_AVX2,
                         .density = 1.4, .deformation_gradient = {f}, .fibre = {fibre}, .energies_old = old, .invariants_old = old + 8,
                         .failure_old = old + 16, .stress = {result(6 * 9)}, .energies = result(4 * 2 * LD), .invariants = result(4 * 2 * LD),
                         .failure = result(3 * 2 * LD), .modes = result(24 * LD), .tangent = result(36 * LD), .wave_speed = result(N),
                         .active = result(N), .status = (int32_t *)(void *)result(N), .deformation_gradient_layout = by_point,
                         .fibre_layout = {.leading_dimension = 20, .stride = 2}, .state_layout = {.leading_dimension = 12,
                                                                                                  .stride = 2},
                         .stress_layout = by_point, .modes_layout = {.leading_dimension = 6, .stride = 1},
                         .tangent_layout = {.leading_dimension = 1, .stride = 36}};
    memcpy(to, &block, sizeof block);
}

static void make_linear_point(void *to)
{
    toron_linear_point point = {.size = sizeof point, .rotation = TORON_ROTATION_POLAR, .criterion = TORON_CRITERION_FIBRE,
                                .measure = TORON_TANGENT_JAUMANN, .level = TORON_LEVEL_AVX2, .density = 1.4, .f_old = f, .f_new = f + 9,
                                .fibre = fibre, .second_axis = fibre + 3, .axes = result(9), .state_old = old,
                                .state_new = result(TORON_LINEAR_ELASTIC_STATE), .stress = result(6), .wave_speed = result(1),
                                .tangent = result(36)};
    memcpy(to, &point, sizeof point);
}

static void make_linear_block(void *to)
{
    const toron_layout by_point = {.leading_dimension = 1, .stride = 9};
    toron_linear_block block = {.size = sizeof block, .n = N, .leading_dimension = LD, .rotation = TORON_ROTATION_POLAR,
                                .criterion = TORON_CRITERION_FIBRE, .measure = TORON_TANGENT_JAUMANN, .level = TORON_LEVEL_AVX2, .density = 1.4,
                                .f_old = {f}, .f_new = {f + 9}, .fibre = {fibre}, .second_axis = {fibre + 1}, .axes = result(9 * LD),
                                .state_old = old, .state_new = result(TORON_LINEAR_ELASTIC_STATE * LD), .stress = {result(6 * 9)},
                                .tangent = result(36 * LD), .wave_speed = result(N), .active = result(N),
                                .status = (int32_t *)(void *)result(N), .deformation_gradient_layout = by_point,
                                .fibre_layout = {.leading_dimension = 20, .stride = 2}, .axes_layout = by_point,
                                .state_layout = {.leading_dimension = 6, .stride = 1}, .stress_layout = by_point,
                                .tangent_layout = {.leading_dimension = 1, .stride = 36}};
    memcpy(to, &block, sizeof block);
}

static void make_increment(void *to)
{
    toron_linear_increment increment = {.size = sizeof increment, .criterion = TORON_CRITERION_FIBRE, .jacobian = 1.5,
                                        .strain = old,
                                        .state_old = old + 10, .state_new = result(TORON_LINEAR_ELASTIC_STATE), .stress = result(6)};
    memcpy(to, &increment, sizeof increment);
}

static void make_vumat(void *to)
{
    toron_vumat block = {.size = sizeof block, .nblock = N, .ndir = 3, .nshr = 3, .nstatev = STATE, .nprops = PROPERTIES,
                         .level = TORON_LEVEL_AVX2, .step_time = 1, .total_time = 1, .props = properties, .density = fibre, .strain_inc = old,
                         .stretch_old = stretch, .stretch_new = stretch, .stress_old = old, .state_old = old, .ener_intern_old = old,
                         .ener_inelas_old = old, .stress_new = result(6 * N), .state_new = result(STATE * N), .ener_intern_new = result(N),
                         .ener_inelas_new = result(N)};
    memcpy(to, &block, sizeof block);
}

#define CALLS(name, ...)                           \
    static int32_t name(const void *structure)     \
    {                                              \
        return TOLD(__VA_ARGS__, structure);       \
    }
CALLS(point, ENTRY(toron_hyperelastic_point), &law)
CALLS(point_with_properties, ENTRY(toron_hyperelastic_point_with_properties), properties, PROPERTIES)
CALLS(block, ENTRY(toron_hyperelastic_block), &law)
CALLS(block_with_properties, ENTRY(toron_hyperelastic_block_with_properties), properties, PROPERTIES)
CALLS(linear_point, ENTRY(toron_linear_elastic_point), &linear)
CALLS(linear_point_with_properties, ENTRY(toron_linear_elastic_point_with_properties), linear_properties,
      TORON_LINEAR_ELASTIC_PROPERTIES)
CALLS(linear_block, ENTRY(toron_linear_elastic_block), &linear)
CALLS(linear_block_with_properties, ENTRY(toron_linear_elastic_block_with_properties), linear_properties,
      TORON_LINEAR_ELASTIC_PROPERTIES)
CALLS(increment, ENTRY(toron_linear_elastic_increment), &linear)
CALLS(vumat, ENTRY(toron_abaqus_vumat))

#ifndef SINGLE
static int32_t eigenvalue(const void *structure)
{
    double *least = (double *)(void *)(results + MOST - 32);
    return TOLD(toron_hyperelastic_least_acoustic_eigenvalue_f64, &law, structure, least, least + 1);
}
#endif

static const struct {
    const char *name;
    size_t known;
    void (*make)(void *);
    int32_t (*call)(const void *);
} kinds[] = {
#define KIND(name) TEXT(ENTRY(name)), sizeof(name)
    {KIND(toron_point), make_point, point},
    {KIND(toron_point), make_point, point_with_properties},
    {KIND(toron_block), make_block, block},
    {KIND(toron_block), make_block, block_with_properties},
    {KIND(toron_linear_point), make_linear_point, linear_point},
    {KIND(toron_linear_point), make_linear_point, linear_point_with_properties},
    {KIND(toron_linear_block), make_linear_block, linear_block},
    {KIND(toron_linear_block), make_linear_block, linear_block_with_properties},
    {KIND(toron_linear_increment), make_increment, increment},
    {KIND(toron_vumat), make_vumat, vumat},
#ifndef SINGLE
    {KIND(toron_point), make_point, eigenvalue},
#endif
};
enum { KINDS = sizeof kinds / sizeof *kinds, LARGEST = 1 << 16 };

/* The first `size` bytes of a structure, and zeros beyond what it has, before the page. */
static unsigned char *placed(const unsigned char *structure, size_t known, size_t size)
{
    unsigned char *to = before_the_page(size);
    memset(to, 0, size);
    memcpy(to, structure, size < known ? size : known);
    memcpy(to, &size, sizeof size);
    return to;
}

static int32_t run(size_t kind, const void *structure)
{
    memset(results, PATTERN, sizeof results);
    return kinds[kind].call(structure);
}

/* A structure that is refused with this code and these words, and then nothing is written. */
static void refused(size_t kind, const void *structure, int32_t code, const char *words)
{
    int32_t status = run(kind, structure);
    CHECK(status == code && strcmp(text, words) == 0, "%d: %s; wanted: %s", status, text, words);
    CHECK(untouched(results, sizeof results), "%s", words);
}

static void sizes(size_t kind)
{
    static _Alignas(8) unsigned char whole[1024], zeroed[1024];
    const size_t known = kinds[kind].known, word = sizeof(size_t);
    const char *name = kinds[kind].name;
    char words[sizeof text];
    used = 0;
    kinds[kind].make(whole);

    /* Cut off anywhere: as the structure with zeros instead. */
    int taken = 0;
    for (size_t size = 2 * word; size <= known; size += word) {
        memset(zeroed, 0, sizeof zeroed);
        memcpy(zeroed, whole, size);
        int32_t status = run(kind, zeroed);
        memcpy(words, text, sizeof words);
        memcpy(wanted, results, sizeof wanted);
        int32_t again = run(kind, placed(whole, known, size));
        CHECK(again == status && memcmp(text, words, sizeof words) == 0, "%s of %zu bytes: %d, %d", name, size, again, status);
        CHECK(memcmp(results, wanted, sizeof results) == 0, "%s of %zu bytes", name, size);
        taken += status == TORON_OK;
    }
    CHECK(taken > 0 && run(kind, whole) == TORON_OK, "%s: %s", name, text);

    /* Longer: zeros are nothing, and anything else is more than the library knows. */
    memcpy(wanted, results, sizeof wanted);
    for (size_t size = known + word; size <= LARGEST; size = size < known + 9 * word ? size + word : 2 * size - size % 16) {
        CHECK(run(kind, placed(whole, known, size)) == TORON_OK, "%s of %zu bytes: %s", name, size, text);
        CHECK(memcmp(results, wanted, sizeof results) == 0, "%s of %zu bytes", name, size);
        const size_t offsets[] = {known, known + (size - known) / 2, size - 1};
        for (int i = 0; i < 3; i++) {
            unsigned char *structure = placed(whole, known, size);
            structure[offsets[i]] = 1;
            snprintf(words, sizeof words, "byte %zu of %s is not 0; this version of the library knows %zu bytes of it", offsets[i],
                     name, known);
            refused(kind, structure, TORON_UNKNOWN_FIELD, words);
        }
    }

    /* No size at all: only the size itself can be read. */
    const size_t none[] = {0, 1, 7, word, known - 1, known + 1, known + word / 2, LARGEST + word, (size_t)1 << 40};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++) {
        unsigned char *structure = before_the_page(word);
        memcpy(structure, &none[i], word);
        snprintf(words, sizeof words, "the size of %s is given as %zu; it is %zu in this version of the library",
                 name, none[i], known);
        refused(kind, structure, TORON_BAD_SIZE, words);
    }
}

/* ---- Rows of the tables, which are written as far as they go. */

static int32_t property(toron_table_row *row)
{
    return TOLD(toron_property, TORON_HYPERELASTIC, 2, row);
}

static int32_t state_variable(toron_table_row *row)
{
    return TOLD(toron_state_variable, TORON_LINEAR_ELASTIC, 7, row);
}

static void rows(int32_t (*call)(toron_table_row *))
{
    const size_t known = sizeof(toron_table_row), word = sizeof(size_t);
    toron_table_row whole = {.size = sizeof whole};
    CHECK(call(&whole) == TORON_OK && whole.size == known && whole.meaning[0] != '\0', "%s", text);
    for (size_t size = 2 * word; size <= 2 * known; size += word) {
        unsigned char *row = before_the_page(size);
        memcpy(row, &size, sizeof size);
        CHECK(call((void *)row) == TORON_OK, "%zu bytes: %s", size, text);
        CHECK(memcmp(row, &size, word) == 0, "%zu bytes: the size stays", size);
        CHECK(memcmp(row + word, (unsigned char *)&whole + word, (size < known ? size : known) - word) == 0, "%zu bytes", size);
        for (size_t i = known; i < size; i++)
            CHECK(row[i] == 0, "%zu bytes: byte %zu", size, i);
        CHECK(untouched(row - GUARD, GUARD), "%zu bytes: written before it", size);
    }
    const size_t none[] = {0, 7, word, known - 1, known + word / 2, LARGEST + word, (size_t)1 << 40};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++) {
        char words[200];
        unsigned char *row = before_the_page(word);
        memcpy(row, &none[i], word);
        snprintf(words, sizeof words, "the size of toron_table_row is given as %zu; it is "
                 "%zu in this version of the library", none[i], known);
        CHECK(call((void *)row) == TORON_BAD_SIZE && strcmp(text, words) == 0, "%s", text);
        CHECK(memcmp(row, &none[i], word) == 0 && untouched(row - GUARD, GUARD), "nothing is written");
    }
}

/* A prepared law has one size, and nothing behind it is written or read. */
static void laws(void)
{
    toron_hyperelastic *own = (void *)before_the_page(sizeof *own);
    CHECK(TOLD(ENTRY(toron_hyperelastic_prepare), own, sizeof *own, properties, PROPERTIES) == TORON_OK, "%s", text);
    CHECK(memcmp(own, &law, sizeof law) == 0 && untouched((char *)own - GUARD, GUARD), "the law is where it is");
    toron_point whole;
    used = 0;
    make_point(&whole);
    memset(results, PATTERN, sizeof results);
    CHECK(TOLD(ENTRY(toron_hyperelastic_point), own, &whole) == TORON_OK, "%s", text);
    toron_linear_elastic *other = (void *)before_the_page(sizeof *other);
    CHECK(TOLD(ENTRY(toron_linear_elastic_prepare), other, sizeof *other, linear_properties,
               TORON_LINEAR_ELASTIC_PROPERTIES) == TORON_OK, "%s", text);
    CHECK(memcmp(other, &linear, sizeof linear) == 0 && untouched((char *)other - GUARD, GUARD), "the law is where it is");
    CHECK(TOLD(ENTRY(toron_linear_elastic_axes), other, NULL, NULL, whole.stress) == TORON_OK, "%s", text);
}

int main(void)
{
    make_inputs();
    for (size_t kind = 0; kind < KINDS; kind++)
        sizes(kind);
    rows(property);
    rows(state_variable);
    laws();
    return finish();
}
