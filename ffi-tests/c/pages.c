/* Every array lies directly before or behind a page that must not be touched, and what the header says is not read is such a page. */
#define _GNU_SOURCE /* MAP_ANONYMOUS */
#include <pthread.h>
#include <setjmp.h>
#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include "check.h"

/* ---- Rooms between forbidden pages */

enum { ROOM = 1 << 16, ROOMS_AT_MOST = 48, FORBIDDEN_BYTES = 1 << 16 };

static unsigned char *forbidden, *rooms;
static size_t page, taken;
static int at_start; /* Arrays begin where a room does, or end where it ends. */

static void make_rooms(void)
{
    page = (size_t)sysconf(_SC_PAGESIZE);
    const size_t bytes = FORBIDDEN_BYTES + ROOMS_AT_MOST * (page + ROOM) + page;
    forbidden = mmap(NULL, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    rooms = forbidden + FORBIDDEN_BYTES + page;
    int made = forbidden != MAP_FAILED;
    for (size_t k = 0; made && k < ROOMS_AT_MOST; k++)
        made = mprotect(rooms + k * (page + ROOM), ROOM, PROT_READ | PROT_WRITE) == 0;
    if (!made) {
        fputs("no pages\n", stderr);
        exit(2);
    }
}

static void *room(size_t bytes)
{
    if (taken == ROOMS_AT_MOST || bytes > ROOM) {
        fputs("no room for another array\n", stderr);
        exit(2);
    }
    unsigned char *start = rooms + taken++ * (page + ROOM);
    unsigned char *array = at_start ? start : start + ROOM - bytes;
    memset(array, PATTERN, bytes);
    return array;
}

static real *numbers_of(const real *values, size_t count)
{
    real *array = room(count * sizeof(real));
    memcpy(array, values, count * sizeof(real));
    return array;
}

/* What must not be read. */
#define FORBIDDEN_REALS ((real *)(void *)(forbidden + FORBIDDEN_BYTES / 2))

/* ---- A call that may touch a forbidden page */

static sigjmp_buf before_the_call;

static void fault(int signal)
{
    (void)signal;
    siglongjmp(before_the_call, 1);
}

enum { FAULT = 1 };

/* The status of a call, or FAULT. */
static int32_t attempt(int32_t (*call)(const void *), const void *argument)
{
    if (sigsetjmp(before_the_call, 1) != 0)
        return FAULT;
    return call(argument);
}

/* ---- Inputs */

enum { MOST = 40, LINEAR_STATE = TORON_LINEAR_ELASTIC_STATE, LINEAR_PROPERTIES = TORON_LINEAR_ELASTIC_PROPERTIES };

static real gradients[9 * MOST], directions[3 * MOST], second[3 * MOST], olds[STATE * MOST], axes[9 * MOST], limits[MOST];
static real properties[PROPERTIES + 1], linear_properties[LINEAR_PROPERTIES + 1];
static toron_hyperelastic yarns[2];
static int yarn; /* that in use */
static toron_linear_elastic linear;

/* The numbers of `n` points, component by component; one of them cannot be evaluated, and one has failed. */
static void make_inputs(size_t n)
{
    for (size_t i = 0; i < n; i++) {
        for (size_t c = 0; c < 9; c++) {
            gradients[c * n + i] = (real)((c % 4 == 0 ? 1 : 0) + 0.004 * (double)((i * 5 + c * 7) % 11) - 0.02);
            axes[c * n + i] = (real)(c % 4 == 0);
        }
        for (size_t c = 0; c < 3; c++)
            directions[c * n + i] = (real)(c == 0), second[c * n + i] = (real)(c == 1);
        for (size_t c = 0; c < STATE; c++)
            olds[c * n + i] = 0;
        limits[i] = (real)(i % 3 == 0 ? 0 : 0.03);
    }
    gradients[n - 1] *= n > 2 ? -1 : 1;
    if (n > 4)
        olds[FAILED * n + 1] = olds[8 * n + 3] = 1;
}

static void make_laws(void)
{
    ENTRY(toron_preset)("kevlar-km2-600", "mm-tonne-s", properties, PROPERTIES, NULL, NULL, 0);
    ENTRY(toron_preset)("kevlar-km2-600-linear", "mm-tonne-s", linear_properties, LINEAR_PROPERTIES, NULL, NULL, 0);
    ENTRY(toron_linear_elastic_prepare)(&linear, sizeof linear, linear_properties, LINEAR_PROPERTIES, NULL, 0);
    ENTRY(toron_hyperelastic_prepare)(&yarns[0], sizeof yarns[0], properties, PROPERTIES, NULL, 0);
    properties[4] = 90, properties[9] = (real)0.5; /* shear, and a fibre that is along no axis */
    ENTRY(toron_hyperelastic_prepare)(&yarns[1], sizeof yarns[1], properties, PROPERTIES, NULL, 0);
}

/* ---- Layouts */

enum { PLAIN, WIDE, ROWS, APART, POINTERS, LAYOUTS };

/* That of an array of components, or of arrays of which this is the largest. */
static toron_layout layout_of(int which, size_t components, size_t n)
{
    switch (which) {
    case WIDE:
        return (toron_layout){n + 3, 1};
    case ROWS:
        return (toron_layout){1, components == 1 ? 3 : components};
    case APART:
        return (toron_layout){2 * n + 1, 2};
    default:
        return (toron_layout){0};
    }
}

/* An array in this layout: of these numbers, or of none for an output. */
static real *array(const real *plain, size_t components, size_t n, toron_layout layout)
{
    const size_t next = layout.leading_dimension == 0 ? n : layout.leading_dimension, stride = layout.stride == 0 ? 1 : layout.stride;
    real *to = room(((components - 1) * next + (n - 1) * stride + 1) * sizeof(real));
    for (size_t c = 0; plain != NULL && c < components; c++)
        for (size_t i = 0; i < n; i++)
            to[c * next + i * stride] = plain[c * n + i];
    return to;
}

/* Sets the pointers to the components of such an array: the first one, or each to an array of its own. */
static void point_to(void *pointers, const real *plain, size_t components, size_t n, int which)
{
    for (size_t c = 0; c < (which == POINTERS ? components : 1); c++) {
        const real *component = which == POINTERS ? array(plain == NULL ? NULL : plain + c * n, 1, n, (toron_layout){0})
                                                  : array(plain, components, n, layout_of(which, components, n));
        memcpy((char *)pointers + c * sizeof component, &component, sizeof component);
    }
}

/* Sets them to what must not be read. */
static void forbid(void *pointers, size_t components, int which)
{
    const real *const none = FORBIDDEN_REALS;
    for (size_t c = 0; c < (which == POINTERS ? components : 1); c++)
        memcpy((char *)pointers + c * sizeof none, &none, sizeof none);
}

/* ---- What is asked for */

enum { STRESS = 1, STATE_PARTS = 2, FAILURES = 4, MODES = 8, SPEED = 16, TANGENT = 32, NOMINAL = 64, FLAGS = 128, OLD = 256, FIBRES = 512 };

static const int requests[] = {
    0, STRESS, STRESS | OLD, STRESS | STATE_PARTS | FAILURES, STRESS | STATE_PARTS | FAILURES | OLD, STRESS | STATE_PARTS | FAILURES | SPEED,
    STRESS | STATE_PARTS | FAILURES | SPEED | OLD, STATE_PARTS, STRESS | STATE_PARTS | OLD, FAILURES, STRESS | FAILURES | OLD, MODES | OLD,
    SPEED, STRESS | SPEED | FLAGS, TANGENT, STRESS | TANGENT, STRESS | STATE_PARTS | FAILURES | TANGENT | SPEED | FLAGS | OLD,
    STRESS | STATE_PARTS | FAILURES | MODES | NOMINAL | SPEED | FLAGS | OLD, STRESS | NOMINAL | FLAGS | OLD, FLAGS};
enum { REQUESTS = sizeof requests / sizeof *requests };

static const char *const instead[] = {"before", "behind"};

/* ---- The hyperelastic law */

static int32_t yarn_block(const void *block)
{
    return ENTRY(toron_hyperelastic_block)(&yarns[yarn], block, NULL, 0);
}

static int32_t yarn_block_with_properties(const void *block)
{
    return ENTRY(toron_hyperelastic_block_with_properties)(properties, PROPERTIES, block, NULL, 0);
}

static toron_block block_of(size_t n, int which, int request)
{
    taken = 0;
    const toron_layout state = layout_of(which, 4, n), modes = layout_of(which, 24, n), limit = layout_of(which, 1, n);
    const size_t entries = request & NOMINAL ? 81 : 36;
    const toron_layout tangent = layout_of(which, entries, n);
    /* What is not read: measure and density without a tangent and a speed, limits where nothing fails. */
    toron_block b = {.size = sizeof b, .n = n, .measure = request & (TANGENT | NOMINAL) ? (request & NOMINAL ? 3 : 2) : 77,
                     .density = request & SPEED ? 1.4e-9 : (double)NAN, .limit = FORBIDDEN_REALS};
    point_to(b.deformation_gradient, gradients, 9, n, which);
    b.deformation_gradient_layout = layout_of(which, 9, n);
    if (request & FIBRES)
        point_to(b.fibre, directions, 3, n, which);
    b.fibre_layout = layout_of(which, 3, n);
    b.state_layout = state, b.modes_layout = modes, b.tangent_layout = tangent, b.stress_layout = layout_of(which, 6, n);
    b.limit_layout.stride = limit.stride;
    if (request & OLD) {
        b.energies_old = array(olds, 4, n, state), b.invariants_old = array(olds + INVARIANTS * n, 4, n, state);
        b.failure_old = array(olds + FAILURE * n, 3, n, state);
    }
    if (request & STRESS)
        point_to(b.stress, NULL, 6, n, which);
    if (request & STATE_PARTS)
        b.energies = array(NULL, 4, n, state), b.invariants = array(NULL, 4, n, state);
    if (request & FAILURES)
        b.failure = array(NULL, 3, n, state), b.limit = array(limits, 1, n, limit);
    if (request & MODES)
        b.modes = array(NULL, 24, n, modes);
    if (request & (TANGENT | NOMINAL))
        b.tangent = array(NULL, entries, n, tangent);
    if (request & SPEED)
        b.wave_speed = room(n * sizeof(real));
    if (request & FLAGS)
        b.active = room(n * sizeof(real)), b.status = room(n * sizeof(int32_t));
    return b;
}

static void blocks(size_t n, int which, int request)
{
    for (int32_t level = TORON_LEVEL_BEST; level <= TORON_LEVEL_AVX512; level++) {
        toron_block b = block_of(n, which, request);
        b.level = level;
        const int32_t wanted = n > 2 ? TORON_INVERTED : TORON_OK;
        int32_t found;
        for (yarn = 0; yarn < 2; yarn++) {
            found = attempt(yarn_block, &b);
            CHECK(found == wanted, "block: yarn %d, n %zu, layout %d, request %d, level %d, pages %s: %d", yarn, n, which, request, level,
                  instead[at_start], found);
        }
        found = attempt(yarn_block_with_properties, &b);
        CHECK(found == wanted, "with properties: n %zu, layout %d, request %d, level %d, pages %s: %d", n, which, request, level,
              instead[at_start], found);
    }
}

static int32_t yarn_point(const void *point)
{
    return ENTRY(toron_hyperelastic_point)(&yarns[yarn], point, NULL, 0);
}

static int32_t yarn_point_with_properties(const void *point)
{
    return ENTRY(toron_hyperelastic_point_with_properties)(properties, PROPERTIES, point, NULL, 0);
}

#ifndef SINGLE
static double *least, *least_direction;

static int32_t eigenvalue(const void *point)
{
    return toron_hyperelastic_least_acoustic_eigenvalue_f64(&yarns[yarn], point, least, least_direction, NULL, 0);
}
#endif

static void points(int request)
{
    taken = 0;
    make_inputs(1);
    toron_point p = {.size = sizeof p, .measure = request & (TANGENT | NOMINAL) ? (request & NOMINAL ? 3 : 2) : 77,
                     .density = request & SPEED ? 1.4e-9 : (double)NAN, .limit = FORBIDDEN_REALS,
                     .deformation_gradient = numbers_of(gradients, 9)};
    if (request & FIBRES)
        p.fibre = numbers_of(directions, 3);
    if (request & OLD)
        p.state_old = numbers_of(olds, STATE);
    if (request & STRESS)
        p.stress = room(6 * sizeof(real));
    if (request & FAILURES)
        p.state_new = room(STATE * sizeof(real)), p.limit = numbers_of(limits, 1);
    if (request & MODES)
        p.modes = room(24 * sizeof(real));
    if (request & (TANGENT | NOMINAL))
        p.tangent = room((request & NOMINAL ? 81 : 36) * sizeof(real));
    if (request & SPEED)
        p.wave_speed = room(sizeof(real));
    for (int32_t level = TORON_LEVEL_BEST; level <= TORON_LEVEL_AVX512; level++) {
        p.level = level;
        int32_t found;
        for (yarn = 0; yarn < 2; yarn++) {
            found = attempt(yarn_point, &p);
            CHECK(found == TORON_OK, "point: yarn %d, request %d, level %d, pages %s: %d", yarn, request, level, instead[at_start], found);
        }
        found = attempt(yarn_point_with_properties, &p);
        CHECK(found == TORON_OK, "with properties: request %d, level %d, pages %s: %d", request, level, instead[at_start], found);
    }
#ifndef SINGLE
    /* Of a point F and fibre are read. */
    least = room(sizeof(double)), least_direction = request & STRESS ? room(3 * sizeof(double)) : NULL;
    p.state_old = p.state_new = p.stress = p.modes = p.wave_speed = p.tangent = FORBIDDEN_REALS, p.limit = FORBIDDEN_REALS;
    yarn = 0;
    const int32_t found = attempt(eigenvalue, &p);
    CHECK(found == TORON_OK, "eigenvalue: request %d, pages %s: %d", request, instead[at_start], found);
#endif
}

/* ---- The linear elastic law */

static int32_t linear_block(const void *block)
{
    return ENTRY(toron_linear_elastic_block)(&linear, block, NULL, 0);
}

static int32_t linear_block_with_properties(const void *block)
{
    return ENTRY(toron_linear_elastic_block_with_properties)(linear_properties, LINEAR_PROPERTIES, block, NULL, 0);
}

static void linear_blocks(size_t n, int which, int request, int32_t rotation)
{
    taken = 0;
    const int spin = rotation == TORON_ROTATION_SPIN;
    const size_t entries = request & NOMINAL ? 81 : 36;
    const toron_layout state = layout_of(which, LINEAR_STATE, n), tangent = layout_of(which, entries, n), limit = layout_of(which, 1, n);
    toron_linear_block b = {.size = sizeof b, .n = n, .rotation = rotation, .density = request & SPEED ? 1.4e-9 : (double)NAN,
                            .measure = request & (TANGENT | NOMINAL) ? (request & NOMINAL ? 3 : 2) : 77, .limit = FORBIDDEN_REALS,
                            .deformation_gradient_layout = layout_of(which, 9, n), .fibre_layout = layout_of(which, 3, n),
                            .axes_layout = layout_of(which, 9, n), .state_layout = state, .stress_layout = layout_of(which, 6, n),
                            .tangent_layout = tangent, .limit_layout = {0, limit.stride}};
    point_to(b.f_old, axes, 9, n, which);
    point_to(b.f_new, gradients, 9, n, which);
    if (spin) {
        forbid(b.fibre, 3, which);
        forbid(b.second_axis, 3, which);
    } else if (request & FIBRES) {
        point_to(b.fibre, directions, 3, n, which);
        point_to(b.second_axis, second, 3, n, which);
    }
    b.axes = spin ? array(axes, 9, n, b.axes_layout) : FORBIDDEN_REALS;
    if (request & OLD)
        b.state_old = array(olds, LINEAR_STATE, n, state);
    if (request & FAILURES)
        b.state_new = array(NULL, LINEAR_STATE, n, state), b.limit = array(limits, 1, n, limit);
    if (request & STRESS)
        point_to(b.stress, NULL, 6, n, which);
    if (request & (TANGENT | NOMINAL))
        b.tangent = array(NULL, entries, n, tangent);
    if (request & SPEED)
        b.wave_speed = room(n * sizeof(real));
    if (request & FLAGS)
        b.active = room(n * sizeof(real)), b.status = room(n * sizeof(int32_t));
    for (b.level = TORON_LEVEL_BEST; b.level <= TORON_LEVEL_AVX512; b.level++) {
        const int32_t wanted = n > 2 ? TORON_INVERTED : TORON_OK;
        int32_t found = attempt(linear_block, &b);
        CHECK(found == wanted, "linear block: n %zu, layout %d, request %d, frame %d, level %d, pages %s: %d", n, which, request, rotation,
              b.level, instead[at_start], found);
        if (spin) /* the axes have turned */
            continue;
        found = attempt(linear_block_with_properties, &b);
        CHECK(found == wanted, "linear, with properties: n %zu, layout %d, request %d, frame %d, level %d, pages %s: %d", n, which, request,
              rotation, b.level, instead[at_start], found);
    }
}

static int32_t linear_point(const void *point)
{
    return ENTRY(toron_linear_elastic_point)(&linear, point, NULL, 0);
}

static int32_t linear_increment(const void *increment)
{
    return ENTRY(toron_linear_elastic_increment)(&linear, increment, NULL, 0);
}

static void linear_points(int request, int32_t rotation)
{
    taken = 0;
    make_inputs(1);
    const int spin = rotation == TORON_ROTATION_SPIN;
    toron_linear_point p = {.size = sizeof p, .rotation = rotation, .density = request & SPEED ? 1.4e-9 : (double)NAN,
                            .measure = request & (TANGENT | NOMINAL) ? (request & NOMINAL ? 3 : 2) : 77, .limit = FORBIDDEN_REALS,
                            .f_old = numbers_of(axes, 9), .f_new = numbers_of(gradients, 9),
                            .fibre = spin ? FORBIDDEN_REALS : request & FIBRES ? numbers_of(directions, 3) : NULL,
                            .second_axis = spin ? FORBIDDEN_REALS : request & FIBRES ? numbers_of(second, 3) : NULL,
                            .axes = spin ? numbers_of(axes, 9) : FORBIDDEN_REALS};
    toron_linear_increment increment = {.size = sizeof increment, .strain = numbers_of(olds, 6)};
    if (request & OLD)
        increment.state_old = p.state_old = numbers_of(olds, LINEAR_STATE);
    if (request & FAILURES)
        increment.state_new = p.state_new = room(LINEAR_STATE * sizeof(real)), p.limit = numbers_of(limits, 1);
    if (request & STRESS)
        increment.stress = p.stress = room(6 * sizeof(real));
    if (request & (TANGENT | NOMINAL))
        p.tangent = room((request & NOMINAL ? 81 : 36) * sizeof(real));
    if (request & SPEED)
        p.wave_speed = room(sizeof(real));
    int32_t found = attempt(linear_point, &p);
    CHECK(found == TORON_OK, "linear point: request %d, frame %d, pages %s: %d", request, rotation, instead[at_start], found);
    found = attempt(linear_increment, &increment);
    CHECK(found == TORON_OK, "increment: request %d, pages %s: %d", request, instead[at_start], found);
}

/* ---- Hosts */

static int32_t vumat(const void *block)
{
    return ENTRY(toron_abaqus_vumat)(block, NULL, 0);
}

static int32_t linear_vumat(const void *block)
{
    return ENTRY(toron_abaqus_linear_vumat)(block, NULL, 0);
}

static void vumats(size_t n, int of_linear, int data_check, int plane, int with_limit)
{
    taken = 0;
    const size_t tensor = plane ? 4 : 6, kept = of_linear ? LINEAR_STATE : STATE, variables = kept + 2;
    static real stretches[6 * MOST], states[(STATE + 2) * MOST], ones[6 * MOST];
    for (size_t i = 0; i < 6 * n; i++)
        stretches[i] = (real)(i < 3 * n ? 1.01 : 0), ones[i] = 1;
    const real *constants = of_linear ? linear_properties : properties;
    const size_t count = of_linear ? LINEAR_PROPERTIES : PROPERTIES;
    real *props = room((count + (size_t)with_limit) * sizeof(real));
    memcpy(props, constants, count * sizeof(real));
    if (with_limit)
        props[count] = (real)variables;
    toron_vumat v = {.size = sizeof v, .nblock = (int32_t)n, .ndir = 3, .nshr = plane ? 1 : 3, .nstatev = (int32_t)variables,
                     .nprops = (int32_t)count + with_limit, .step_time = !data_check, .total_time = !data_check, .props = props,
                     .density = numbers_of(ones, n), .strain_inc = data_check ? numbers_of(stretches, tensor * n) : FORBIDDEN_REALS,
                     .stretch_old = numbers_of(stretches, tensor * n), .stretch_new = numbers_of(stretches, tensor * n),
                     .stress_old = numbers_of(stretches, tensor * n), .state_old = numbers_of(states, variables * n),
                     .ener_intern_old = numbers_of(ones, n), .ener_inelas_old = numbers_of(ones, n),
                     .stress_new = room(tensor * n * sizeof(real)), .state_new = room(variables * n * sizeof(real)),
                     .ener_intern_new = room(n * sizeof(real)), .ener_inelas_new = room(n * sizeof(real))};
    const int32_t found = attempt(of_linear ? linear_vumat : vumat, &v);
    CHECK(found == TORON_OK, "VUMAT %d: %zu points, data check %d, plane %d, limit %d, pages %s: %d", of_linear, n, data_check, plane,
          with_limit, instead[at_start], found);
}

/* The arguments of LS-DYNA's routines, of a law with `nhv` variables. */
typedef struct {
    real *cm, *sig, *rows[6], *hsv, *tangent;
    int *failed;
    int32_t nhv, lft, llt, nlq;
} elements;

static int32_t lsdyna_umat(const void *of)
{
    const elements *e = of;
    return (e->nhv == STATE ? ENTRY(toron_lsdyna_umat) : ENTRY(toron_lsdyna_linear_umat))(e->cm, e->sig, e->hsv, e->nhv, e->failed, NULL, 0);
}

static int32_t lsdyna_utan(const void *of)
{
    const elements *e = of;
    return (e->nhv == STATE ? ENTRY(toron_lsdyna_utan) : ENTRY(toron_lsdyna_linear_utan))(e->cm, e->hsv, e->nhv, e->tangent, NULL, 0);
}

static int32_t lsdyna_umat_vector(const void *of)
{
    const elements *e = of;
    return (e->nhv == STATE ? ENTRY(toron_lsdyna_umat_vector) : ENTRY(toron_lsdyna_linear_umat_vector))(
        e->cm, e->rows[0], e->rows[1], e->rows[2], e->rows[3], e->rows[4], e->rows[5], e->hsv, e->nhv, e->lft, e->llt, e->nlq, e->failed,
        NULL, 0);
}

static int32_t lsdyna_utan_vector(const void *of)
{
    const elements *e = of;
    return (e->nhv == STATE ? ENTRY(toron_lsdyna_utan_vector) : ENTRY(toron_lsdyna_linear_utan_vector))(
        e->cm, e->hsv, e->nhv, e->lft, e->llt, e->nlq, e->tangent, NULL, 0);
}

static void lsdyna(size_t n, int of_linear)
{
    taken = 0;
    const size_t history = of_linear ? LINEAR_STATE + 9 : STATE;
    static real fresh[28 * MOST];
    memset(fresh, 0, sizeof fresh);
    for (size_t c = 0; c < 9; c++)
        for (size_t i = 0; i < n; i++)
            fresh[(history + c) * n + i] = gradients[c * n + i];
    elements e = {.cm = of_linear ? numbers_of(linear_properties, LINEAR_PROPERTIES) : numbers_of(properties, PROPERTIES),
                  .sig = room(6 * sizeof(real)), .hsv = numbers_of(fresh, (history + 9) * n), .tangent = room(36 * n * sizeof(real)),
                  .failed = room(n * sizeof(int)), .nhv = (int32_t)history, .lft = 1, .llt = (int32_t)n, .nlq = (int32_t)n};
    for (int c = 0; c < 6; c++)
        e.rows[c] = room(n * sizeof(real));
    if (n == 1) {
        int32_t found = attempt(lsdyna_umat, &e);
        CHECK(found == TORON_OK, "LS-DYNA's umat %d, pages %s: %d", of_linear, instead[at_start], found);
        found = attempt(lsdyna_utan, &e);
        CHECK(found == TORON_OK, "LS-DYNA's utan %d, pages %s: %d", of_linear, instead[at_start], found);
    }
    int32_t found = attempt(lsdyna_umat_vector, &e), wanted = n > 2 ? TORON_INVERTED : TORON_OK;
    CHECK(found == wanted, "LS-DYNA's umat vector %d: %zu elements, pages %s: %d", of_linear, n, instead[at_start], found);
    found = attempt(lsdyna_utan_vector, &e);
    CHECK(found == TORON_OK || found == TORON_INVERTED, "LS-DYNA's utan vector %d: %zu elements, pages %s: %d", of_linear, n, instead[at_start], found);
    if (n > 3) { /* others are not touched: they are not there */
        e.lft = 2, e.llt = (int32_t)n - 1;
        for (int tangent = 0; tangent < 2; tangent++) {
            found = attempt(tangent ? lsdyna_utan_vector : lsdyna_umat_vector, &e);
            CHECK(found == TORON_OK || found == TORON_INVERTED, "LS-DYNA, a part of %zu elements: %d", n, found);
        }
    }
}

typedef struct {
    int32_t nel, nuparam, nuvar;
    real time;
    real *uparam, *density, *f[9], *sign[6], *sigv[6], *sound, *viscosity, *uvar, *off, *nodes;
} group;

static int32_t luser(const void *of)
{
    const group *g = of;
    return ENTRY(toron_openradioss_luser)(
        g->nel, g->nuparam, g->nuvar, g->time, g->uparam, NULL, g->density, g->f[0], g->f[1], g->f[2], g->f[3], g->f[4], g->f[5], g->f[6],
        g->f[7], g->f[8], g->sign[0], g->sign[1], g->sign[2], g->sign[3], g->sign[4], g->sign[5], g->sigv[0], g->sigv[1], g->sigv[2],
        g->sigv[3], g->sigv[4], g->sigv[5], g->sound, g->viscosity, g->uvar, g->off, g->nodes, NULL, 0);
}

/* Of a group without elements nothing is read but UPARAM. */
static void openradioss(size_t n, int32_t law, int fibre_from, int with_limit, real time)
{
    taken = 0;
    static real values[24 * MOST];
    real card[16] = {0}, uparam[64], modulus;
    int32_t nuparam, nuvar;
    const size_t count = law == 1 ? PROPERTIES : LINEAR_PROPERTIES, options = law == 1 ? 2 : 4;
    memcpy(card, law == 1 ? properties : linear_properties, count * sizeof(real));
    card[count] = (real)fibre_from, card[count + options - 1] = (real)with_limit;
    const int32_t read = ENTRY(toron_openradioss_lecm)(law, card, count + options, uparam, 64, &nuparam, &nuvar, &modulus, NULL, 0);
    CHECK(read == TORON_OK, "card: %d", read);
    const size_t rows = (size_t)nuvar;
    real *forbidden_reals = FORBIDDEN_REALS;
    group g = {.nel = (int32_t)n, .nuparam = nuparam, .nuvar = nuvar, .time = time, .uparam = numbers_of(uparam, (size_t)nuparam),
               .density = forbidden_reals, .sound = forbidden_reals, .uvar = forbidden_reals, .off = forbidden_reals, .nodes = forbidden_reals};
    for (int c = 0; c < 9; c++)
        g.f[c] = forbidden_reals;
    for (int c = 0; c < 6; c++)
        g.sign[c] = forbidden_reals;
    if (n > 0) {
        static const int place[9] = {0, 4, 8, 3, 7, 2, 1, 5, 6}; /* XX YY ZZ XY YZ ZX YX ZY XZ in the columns of F */
        for (int c = 0; c < 9; c++)
            g.f[c] = numbers_of(gradients + (size_t)place[c] * n, n);
        for (int c = 0; c < 6; c++)
            g.sign[c] = room(n * sizeof(real)), g.sigv[c] = c % 2 == 0 ? room(n * sizeof(real)) : NULL;
        for (size_t i = 0; i < 24 * n; i++)
            values[i] = 1;
        g.off = numbers_of(values, n), g.density = numbers_of(values, 1), g.sound = room(n * sizeof(real));
        for (size_t i = 0; i < rows * n; i++)
            values[i] = (real)(i / n == (law == 1 ? 11 : 10));
        g.uvar = numbers_of(values, rows * n);
        if (fibre_from == 1 && time == 0) { /* read then only: a brick along x */
            for (size_t k = 0; k < 24; k++)
                for (size_t i = 0; i < n; i++)
                    values[k * n + i] = (real)(k / 8 == 0 ? 2 * (k % 8 / 4) : k / 8 == 1 ? (k % 4 == 1 || k % 4 == 2) : k % 4 / 2);
            g.nodes = numbers_of(values, 24 * n);
        }
    }
    const int32_t found = attempt(luser, &g);
    CHECK(found == TORON_OK, "LUSER %d: %zu elements, fibre_from %d, limits %d, time %g, pages %s: %d", law, n, fibre_from, with_limit,
          (double)time, instead[at_start], found);
}

#ifndef SINGLE
typedef struct {
    double *stress, *statev, *ddsdde, *sse, *pnewdt, *dfgrd0, *dfgrd1, *props;
    int32_t nprops, nstatv, nshr;
    int linear;
} umat_arguments;

static int32_t umat(const void *of)
{
    const umat_arguments *a = of;
    return a->linear ? toron_abaqus_linear_umat_f64(a->stress, a->statev, a->ddsdde, a->sse, a->pnewdt, a->dfgrd0, a->dfgrd1, a->props,
                                                    a->nprops, a->nstatv, 3, a->nshr, 1, NULL, 0)
                     : toron_abaqus_umat_tangent_f64(a->stress, a->statev, a->ddsdde, a->sse, a->pnewdt, a->dfgrd1, a->props, a->nprops,
                                                     a->nstatv, 3, a->nshr, 1, NULL, 0);
}

static void umats(int of_linear, int plane, int with_tangent, int with_limit)
{
    taken = 0;
    const size_t ntens = plane ? 4 : 6, kept = of_linear ? LINEAR_STATE : STATE, variables = kept + (size_t)with_limit;
    const size_t count = of_linear ? LINEAR_PROPERTIES : PROPERTIES;
    double constants[12] = {0}, states[12] = {0}, f[9] = {1.01, 0, 0, 0, 0.99, 0, 0, 0, 1}, one[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    memcpy(constants, of_linear ? linear_properties : properties, count * sizeof(double));
    constants[count] = (double)variables;
    umat_arguments a = {.stress = room(ntens * sizeof(double)), .statev = numbers_of(states, variables),
                        .ddsdde = with_tangent ? room(ntens * ntens * sizeof(double)) : NULL, .sse = room(sizeof(double)),
                        .pnewdt = numbers_of(one, 1), .dfgrd0 = numbers_of(one, 9), .dfgrd1 = numbers_of(f, 9),
                        .props = numbers_of(constants, count + (size_t)with_limit), .nprops = (int32_t)count + with_limit,
                        .nstatv = (int32_t)variables, .nshr = plane ? 1 : 3, .linear = of_linear};
    const int32_t found = attempt(umat, &a);
    CHECK(found == TORON_OK, "UMAT %d: plane %d, tangent %d, limit %d, pages %s: %d", of_linear, plane, with_tangent, with_limit,
          instead[at_start], found);
}
#endif

static void hosts(void)
{
    for (int of_linear = 0; of_linear < 2; of_linear++)
        for (int option = 0; option < 8; option++) {
            for (size_t n = 0; n < 12; n++) {
                make_inputs(n == 0 ? 1 : n);
                vumats(n, of_linear, option & 1, option >> 1 & 1, option >> 2);
                if (n > 0 && option == 0)
                    lsdyna(n, of_linear);
                gradients[(n == 0 ? 1 : n) - 1] = 1; /* that no element is out */
                for (int fibre_from = 0; fibre_from < 3; fibre_from++)
                    openradioss(n, 1 + of_linear, fibre_from, option & 1, (real)(option >> 1 & 1));
            }
#ifndef SINGLE
            umats(of_linear, option & 1, option >> 1 & 1, option >> 2);
#endif
        }
}

/* A block without points reads none of its arrays. */
static void nothing(void)
{
    taken = 0;
    real *const none = FORBIDDEN_REALS;
    toron_block b = {.size = sizeof b, .deformation_gradient = {none}, .fibre = {none}, .energies_old = none, .invariants_old = none,
                     .failure_old = none, .stress = {none}, .energies = none, .invariants = none, .failure = none, .modes = none,
                     .tangent = none, .wave_speed = none, .active = none, .status = (int32_t *)(void *)none, .limit = none};
    toron_linear_block l = {.size = sizeof l, .f_old = {none}, .f_new = {none}, .fibre = {none}, .second_axis = {none}, .axes = none,
                            .state_old = none, .state_new = none, .stress = {none}, .tangent = none, .wave_speed = none, .active = none,
                            .status = (int32_t *)(void *)none, .limit = none};
    for (size_t stride = 0; stride < 3; stride++) {
        b.deformation_gradient_layout.stride = l.deformation_gradient_layout.stride = stride;
        b.state_layout.stride = l.state_layout.stride = b.limit_layout.stride = l.limit_layout.stride = stride;
        for (int32_t rotation = 0; rotation < 3; rotation++) {
            l.rotation = rotation;
            CHECK(attempt(linear_block, &l) == TORON_OK, "stride %zu, frame %d", stride, rotation);
        }
        yarn = 0;
        CHECK(attempt(yarn_block, &b) == TORON_OK, "stride %zu", stride);
    }
}

static int32_t reads_a_page(const void *array)
{
    return *(const volatile unsigned char *)array;
}

/* ---- The stack of the thread that makes all these calls */

enum { STACK = 1 << 18 };

/* What docs/guides/c.md promises, without and with modes or a tangent, and 8 KiB for the thread's own functions here. */
static const size_t allowed[2] = {(52 + 8) << 10, (60 + 8) << 10};
static int with_tangents;

/* The bytes of its stack that a thread uses to run this, beside what it needs to run nothing. */
static size_t stack_of(void *(*run)(void *))
{
    static _Alignas(64) unsigned char stack[STACK];
    memset(stack, PATTERN, STACK);
    pthread_attr_t attributes;
    pthread_t thread;
    if (pthread_attr_init(&attributes) != 0 || pthread_attr_setstack(&attributes, stack, STACK) != 0
        || pthread_create(&thread, &attributes, run, NULL) != 0 || pthread_join(thread, NULL) != 0) {
        fputs("no thread\n", stderr);
        exit(2);
    }
    size_t unused = 0;
    while (unused < STACK && stack[unused] == PATTERN)
        unused++;
    return STACK - unused;
}

static void *run_nothing(void *unused)
{
    return unused;
}

static void *run_all(void *unused)
{
    struct sigaction action = {.sa_handler = fault};
    sigaction(SIGSEGV, &action, NULL);
    CHECK(attempt(reads_a_page, forbidden) == FAULT, "a fault that is not noticed");
    static const size_t counts[] = {1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 32, 33, MOST};
    for (at_start = 0; at_start < 2; at_start++) {
        for (int k = 0; k < 2 * REQUESTS; k++) {
            const int request = requests[k / 2] | (k % 2 == 0 ? 0 : FIBRES);
            if (!with_tangents && request & (MODES | TANGENT | NOMINAL))
                continue;
            points(request);
            for (int32_t rotation = 0; rotation < 3; rotation++)
                linear_points(request, rotation);
            for (size_t c = 0; c < sizeof counts / sizeof *counts; c++)
                for (int which = 0; which < LAYOUTS; which++) {
                    make_inputs(counts[c]);
                    blocks(counts[c], which, request);
                    for (int32_t rotation = 0; rotation < 3; rotation++)
                        linear_blocks(counts[c], which, request, rotation);
                }
        }
        hosts();
        nothing();
    }
    return unused;
}

int main(void)
{
    make_rooms();
    make_laws();
    const size_t least = stack_of(run_nothing);
    for (with_tangents = 0; with_tangents < 2; with_tangents++) {
        const size_t most = stack_of(run_all) - least;
        printf("%zu bytes of stack\n", most);
        CHECK(most <= allowed[with_tangents], "tangents %d: %zu bytes of stack", with_tangents, most);
    }
    return finish();
}
