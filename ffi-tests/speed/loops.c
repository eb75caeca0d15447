/* What a point costs in a C program: the rows of `toron bench` that are entries, in loops over arrays as their hosts keep them. The
 * scene, nine numbers of F by columns a point, is read from a file: `toron bench` has the same.
 *
 *   loops SCENE POINTS libtoron_mgis.so libtoron_calculix.so
 *
 * prints a line of JSON a row: its name, and the least nanoseconds a point of this thread's time for so many points a call. */
#define _POSIX_C_SOURCE 200809L

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "toron.h"

enum {
    PROPERTIES = TORON_HYPERELASTIC_PROPERTIES,
    STATE = TORON_HYPERELASTIC_STATE,
    /* Elements of a group of OpenRadioss, the length of the solver's vectors, room for user variables. */
    GROUP = 128,
    LENGTH = 129,
    VARIABLES = 32,
    /* As in `toron bench`: rows are timed so often, in turn, and the fastest time counts. */
    ROUNDS = 40
};
static const double BATCH = 1e6;

static double (*scene)[9];
/* The leading dimension of blocks, as `toron bench` has it. */
static size_t stride;
static int32_t *status;

static void expect(int right, const char *what)
{
    if (!right) {
        fprintf(stderr, "%s\n", what);
        exit(1);
    }
}

/* On a cache line. */
static void *zeroed(size_t count, size_t size)
{
    void *array = NULL;
    expect(posix_memalign(&array, 64, count * size) == 0, "memory");
    return memset(array, 0, count * size);
}

#define JOINED(a, b) a##b
#define REAL double
#define NAME(x) JOINED(x, 64)
#define BOTH(x) JOINED(x, _f64)
#include "loops.h"
#undef REAL
#undef NAME
#undef BOTH
#define REAL float
#define NAME(x) JOINED(x, 32)
#define BOTH(x) JOINED(x, _f32)
#include "loops.h"

/* ---- Those in double precision alone. */

static double (*strain)[6], (*mfront)[9], (*old)[STATE], (*energy_and_step)[2], (*stiffness)[21], (*operator)[54];

static void fill_double(size_t n)
{
    strain = zeroed(n, sizeof *strain);
    mfront = zeroed(n, sizeof *mfront);
    old = zeroed(n, sizeof *old);
    energy_and_step = zeroed(n, sizeof *energy_and_step);
    stiffness = zeroed(n, sizeof *stiffness);
    operator = zeroed(n, sizeof *operator);
    static const size_t first[6] = {0, 3, 6, 0, 0, 3}, second[6] = {0, 3, 6, 3, 6, 6}, order[9] = {0, 4, 8, 3, 1, 6, 2, 7, 5};
    for (size_t i = 0; i < n; i++) {
        energy_and_step[i][1] = 1;
        for (size_t c = 0; c < 9; c++)
            mfront[i][c] = scene[i][order[c]];
        for (size_t c = 0; c < 6; c++) {
            const double *a = scene[i] + first[c], *b = scene[i] + second[c];
            strain[i][c] = 0.5 * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2] - (c < 3));
        }
    }
}

static void empty_double(void)
{
    free(strain), free(mfront), free(old), free(energy_and_step), free(stiffness), free(operator);
}

static void umat(size_t n)
{
    for (size_t i = 0; i < n; i++)
        status[i] = toron_abaqus_umat_f64(stress64[i], state64[i], &energy_and_step[i][0], &energy_and_step[i][1], gradient64[i],
                                          properties64, PROPERTIES, STATE, 3, 3, 1, NULL, 0);
}

static void umat_tangent(size_t n)
{
    double ddsdde[36];
    for (size_t i = 0; i < n; i++)
        status[i] = toron_abaqus_umat_tangent_f64(stress64[i], state64[i], ddsdde, &energy_and_step[i][0], &energy_and_step[i][1],
                                                  gradient64[i], properties64, PROPERTIES, STATE, 3, 3, 1, NULL, 0);
}

typedef void behaviour(const char *, const int *, const int *, const int *, const double *, const double *, const double *,
                       const double *, const double *, const double *, const double *, const double *, const int *,
                       const double *, const double *, const double *, const double *, const int *, const int *,
                       const int *, const int *, const double *, double *, double *, double *, const int *,
                       const double *, const double *, double *, const int *, int);
static behaviour *calculix_behaviour;

static void calculix(size_t n)
{
    const int one = 1, none = 0, kode = -100 - PROPERTIES, variables = STATE;
    const double zeros[9] = {0};
    char name[81];
    memset(name, ' ', sizeof name);
    for (size_t i = 0; i < n; i++)
        calculix_behaviour(name, &one, &one, &kode, properties64, strain[i], zeros, zeros, zeros, zeros, gradient64[i], zeros, &none,
                           zeros, zeros, zeros, zeros, &one, &none, &one, &variables, old[i], state64[i], stress64[i],
                           stiffness[i], &none, zeros, zeros, &energy_and_step[i][1], &one, 80);
}

/* As in MGIS's BehaviourDataView. */
typedef struct {
    const double *gradients;
    double *thermodynamic_forces;
    const double *mass_density, *material_properties;
    double *internal_state_variables, *stored_energy, *dissipated_energy;
    const double *external_state_variables;
} state_view;

typedef struct {
    char *error_message;
    double dt;
    double *K, *rdt, *speed_of_sound;
    state_view s0, s1;
} data_view;

static int (*mgis_behaviour)(data_view *);

static void integrate(size_t n, double request)
{
    static const double rest[9] = {1, 1, 1};
    double rdt = 1;
    data_view view = {.rdt = &rdt, .s0 = {.gradients = rest, .material_properties = properties64},
                      .s1 = {.material_properties = properties64}};
    for (size_t i = 0; i < n; i++) {
        view.K = operator[i];
        view.K[0] = request, view.K[1] = 0, view.K[2] = 0;
        view.s0.internal_state_variables = old[i];
        view.s1.gradients = mfront[i];
        view.s1.thermodynamic_forces = stress64[i];
        view.s1.internal_state_variables = state64[i];
        view.s1.stored_energy = &energy_and_step[i][0];
        status[i] = mgis_behaviour(&view);
    }
}

static void mgis(size_t n)
{
    integrate(n, 0);
}

static void mgis_tangent(size_t n)
{
    integrate(n, 4);
}

/* ---- The rows, with the names that they have in bench.json. */

static struct row {
    const char *name;
    void (*run)(size_t n);
    /* Calls of a timing; the least nanoseconds a point. */
    size_t calls;
    double least;
} rows[] = {
    {.name = "f64 C point", .run = point64},
    {.name = "f64 C point, stress only", .run = point_stress64},
    {.name = "f64 C point with dS/dE", .run = point_tangent64},
    {.name = "f64 C point with properties", .run = point_properties64},
    {.name = "f64 C block", .run = block64},
    {.name = "f64 VUMAT", .run = vumat64},
    {.name = "f64 LS-DYNA scalar", .run = lsdyna64},
    {.name = "f64 LS-DYNA vectorised", .run = lsdyna_vector64},
    {.name = "f64 C blocks of 128, wave speed", .run = blocks_of_groups64},
    {.name = "f64 OpenRadioss, groups of 128", .run = openradioss64},
    {.name = "f64 UMAT", .run = umat},
    {.name = "f64 UMAT with DDSDDE", .run = umat_tangent},
    {.name = "f64 CalculiX with dS/dE", .run = calculix},
    {.name = "f64 MGIS", .run = mgis},
    {.name = "f64 MGIS with dsig/dF", .run = mgis_tangent},
    {.name = "f32 C point", .run = point32},
    {.name = "f32 C point, stress only", .run = point_stress32},
    {.name = "f32 C point with dS/dE", .run = point_tangent32},
    {.name = "f32 C point with properties", .run = point_properties32},
    {.name = "f32 C block", .run = block32},
    {.name = "f32 VUMAT", .run = vumat32},
    {.name = "f32 LS-DYNA scalar", .run = lsdyna32},
    {.name = "f32 LS-DYNA vectorised", .run = lsdyna_vector32},
    {.name = "f32 C blocks of 128, wave speed", .run = blocks_of_groups32},
    {.name = "f32 OpenRadioss, groups of 128", .run = openradioss32},
};
enum { ROWS = sizeof rows / sizeof *rows };

/* Nanoseconds of this thread's time that so many calls take. */
static double timed(const struct row *row, size_t n, size_t calls)
{
    struct timespec start, end;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &start);
    for (size_t i = 0; i < calls; i++)
        row->run(n);
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &end);
    return 1e9 * (double)(end.tv_sec - start.tv_sec) + (double)(end.tv_nsec - start.tv_nsec);
}

static void measure(size_t n)
{
    for (size_t round = 0; round < ROUNDS; round++)
        for (size_t r = 0; r < ROWS; r++) {
            struct row *row = &rows[r];
            /* The caches then hold this row's data and not the last one's. */
            row->run(n);
            for (row->calls += row->calls == 0; round == 0 && timed(row, n, row->calls) < BATCH;)
                row->calls *= 2;
            double time = timed(row, n, row->calls) / (double)(row->calls * n);
            row->least = round == 0 || time < row->least ? time : row->least;
        }
}

static void *symbol(const char *path, const char *name)
{
    void *library = dlopen(path, RTLD_NOW);
    void *found = library == NULL ? NULL : dlsym(library, name);
    expect(found != NULL, path);
    return found;
}

int main(int count, char **arguments)
{
    expect(count == 5, "arguments: scene, points a call, libtoron_mgis.so, libtoron_calculix.so");
    size_t n = strtoul(arguments[2], NULL, 10);
    FILE *file = fopen(arguments[1], "rb");
    expect(file != NULL && n > 0, arguments[1]);
    scene = zeroed(n, sizeof *scene);
    expect(fread(scene, sizeof *scene, n, file) == n, "a scene of fewer points");
    fclose(file);
    /* ISO C has no conversion from a datum's to a function's pointer. */
    void *found = symbol(arguments[3], "ToronHyperelastic_Tridimensional");
    memcpy(&mgis_behaviour, &found, sizeof found);
    found = symbol(arguments[4], "HYPERELASTIC");
    memcpy(&calculix_behaviour, &found, sizeof found);
    stride = (n + 15) / 16 * 16;
    stride += stride % 512 == 0 ? 16 : 0;
    status = zeroed(n, sizeof *status);
    set_up64(), set_up32();
    fill64(n), fill32(n), fill_double(n);
    /* The state of later steps, where points have failed. */
    umat(n);
    memcpy(old, state64, n * sizeof *old);
    measure(n);
    for (size_t r = 0; r < ROWS; r++)
        printf("{\"name\": \"%s\", \"nanoseconds\": %.3f}\n", rows[r].name, rows[r].least);
    empty64(), empty32(), empty_double();
    free(status), free(scene);
    return 0;
}
