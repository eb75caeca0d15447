/* Blocks in the arrays that solvers have: a pointer for each component or a leading dimension for each group of arrays, points next to
 * each other or not. Every bit is that of a block in plain arrays, and what is between the entries is not touched. */
#include "check.h"

enum { MOST_POINTS = 23, VECTOR = 64, MODES = 24, MOST_TANGENT = 81, LINEAR_STATE = TORON_LINEAR_ELASTIC_STATE };

/* Component c of point i is at offset[c] + i stride; the layout, or the pointers to components, say so. */
typedef struct {
    toron_layout layout;
    int pointers;
    size_t offset[MOST_TANGENT], stride;
} arrangement;

/* A leading dimension and a stride that the layout gives. */
static arrangement spaced(size_t leading_dimension, size_t stride)
{
    arrangement a = {.layout = {leading_dimension, stride}, .stride = stride == 0 ? 1 : stride};
    for (size_t c = 0; c < MOST_TANGENT; c++)
        a.offset[c] = c * leading_dimension;
    return a;
}

/* The leading dimension of the block: nothing is said. */
static arrangement inherited(size_t leading_dimension)
{
    arrangement a = spaced(leading_dimension, 1);
    a.layout = (toron_layout){0};
    return a;
}

/* A pointer for each component, at these places of an array. */
static arrangement pointed(const size_t *places, size_t components, size_t factor, size_t stride)
{
    arrangement a = {.layout = {0, stride}, .pointers = 1, .stride = stride};
    for (size_t c = 0; c < components; c++)
        a.offset[c] = places[c] * factor;
    return a;
}

/* A way to hold a block: its leading dimension, and the arrangement of each group of arrays. */
typedef struct {
    const char *name;
    size_t leading_dimension;
    arrangement f, fibre, axes, state, stress, modes, tangent;
} way;

enum { WAYS = 6 };

static way way_of(int which, size_t n)
{
    /* F by columns and the stress in a matrix by rows; components in any order. */
    static const size_t f_by_rows[9] = {0, 3, 6, 1, 4, 7, 2, 5, 8}, stress_by_rows[6] = {0, 4, 8, 1, 5, 6};
    static const size_t any[9] = {4, 8, 1, 3, 0, 2, 7, 6, 5};
    const arrangement plain = inherited(n), wide = inherited(n + 3), vector = spaced(VECTOR, 0);
    switch (which) {
    case 0:
        return (way){"a leading dimension", n + 3, wide, wide, wide, wide, wide, wide, wide};
    case 1:
        return (way){"a pointer for each component", 0, pointed(any, 9, n + 5, 1), pointed(any + 4, 3, n + 5, 1), plain, plain,
                     pointed(any + 2, 6, n + 5, 1), plain, plain};
    case 2:
        return (way){"NumPy's (n, 3, 3)", 0, pointed(f_by_rows, 9, 1, 9), spaced(1, 3), spaced(1, 9), spaced(1, 11),
                     pointed(stress_by_rows, 6, 1, 9), spaced(1, MODES), spaced(1, MOST_TANGENT)};
    case 3:
        return (way){"NumPy's (3, 3, n)", 0, pointed(f_by_rows, 9, n, 1), plain, plain, plain, pointed(stress_by_rows, 6, n, 1),
                     plain, plain};
    case 4:
        return (way){"vectors, and the history of a group", n, vector, vector, vector, plain, vector, plain, plain};
    default:
        return (way){"strides", 0, spaced(2 * n + 1, 2), spaced(3 * n, 3), spaced(4 * n, 4), spaced(2 * n + 3, 2), spaced(5 * n, 4),
                     spaced(2 * n, 2), spaced(3 * n + 1, 3)};
    }
}

static real *room_for(size_t components, size_t n, const arrangement *a)
{
    size_t most = 0;
    for (size_t c = 0; c < components; c++)
        most = a->offset[c] > most ? a->offset[c] : most;
    return reals(most + (n - 1) * a->stride + 1);
}

/* The plain array, component-major, in this arrangement. */
static real *spread(const real *plain, size_t components, size_t n, const arrangement *a)
{
    real *array = room_for(components, n, a);
    for (size_t c = 0; c < components; c++)
        for (size_t i = 0; i < n; i++)
            array[a->offset[c] + i * a->stride] = plain[c * n + i];
    return array;
}

/* Whether an array in this arrangement holds the bits of the plain one, and nothing else has been written. */
static void check_same(const char *what, const way *w, const real *array, const real *plain, size_t components, size_t n,
                       const arrangement *a)
{
    size_t most = 0;
    for (size_t c = 0; c < components; c++)
        most = a->offset[c] > most ? a->offset[c] : most;
    size_t extent = most + (n - 1) * a->stride + 1;
    unsigned char *ours = calloc(extent, 1);
    for (size_t c = 0; c < components; c++)
        for (size_t i = 0; i < n; i++) {
            size_t at = a->offset[c] + i * a->stride;
            ours[at] = 1;
            CHECK(memcmp(&array[at], &plain[c * n + i], sizeof(real)) == 0, "%s, %s: component %zu of point %zu", w->name, what, c,
                  i);
        }
    for (size_t at = 0; at < extent; at++)
        CHECK(ours[at] || untouched(&array[at], sizeof(real)), "%s, %s: entry %zu", w->name, what, at);
    free(ours);
}

/* Sets the pointers to the components, or the first one only. */
static void point_to(void *pointers, const real *array, size_t components, const arrangement *a)
{
    for (size_t c = 0; c < (a->pointers ? components : 1); c++) {
        const real *component = array + a->offset[c];
        memcpy((char *)pointers + c * sizeof component, &component, sizeof component);
    }
}

/* ---- Inputs in plain arrays: moderate deformations, and one point that cannot be evaluated. */

static real f_old[9 * MOST_POINTS], f_new[9 * MOST_POINTS], fibre[3 * MOST_POINTS], second[3 * MOST_POINTS], old[11 * MOST_POINTS];

static void make_inputs(size_t n)
{
    for (size_t i = 0; i < n; i++) {
        for (size_t c = 0; c < 9; c++) {
            double change = 0.02 * (double)((i * 5 + c * 7) % 11) - 0.1;
            f_new[c * n + i] = (real)((c % 4 == 0 ? 1 : 0) + change);
            f_old[c * n + i] = (real)((c % 4 == 0 ? 1 : 0) + 0.5 * change);
        }
        for (size_t c = 0; c < 3; c++) {
            fibre[c * n + i] = (real)(1 + 0.4 * (double)((i + 2 * c) % 5));
            second[c * n + i] = (real)(c == i % 3 ? -1.5 : 0);
        }
        for (size_t c = 0; c < 11; c++)
            old[c * n + i] = (real)(c < 8 ? 0.001 * (double)((i + c) % 7) : 0);
    }
    if (n > 5)
        for (size_t c = 0; c < 3; c++)
            f_new[c * n + 5] *= -1;
}

/* ---- The hyperelastic law */

typedef struct {
    real *stress, *state, *modes, *tangent, *wave_speed, *active;
    int32_t *status;
} outputs;

static int32_t evaluate(const toron_hyperelastic *law, toron_block *block, outputs *out, size_t n)
{
    out->wave_speed = block->wave_speed = reals(n), out->active = block->active = reals(n);
    out->status = block->status = guarded(n * sizeof(int32_t));
    block->size = sizeof *block, block->n = n, block->density = 1.4;
    return TOLD(ENTRY(toron_hyperelastic_block), law, block);
}

/* Where the new state goes: to other arrays than the old one, to the same, or the energies only. */
enum { ELSEWHERE, IN_PLACE, ENERGIES_IN_PLACE, PLACES };

static void hyperelastic(size_t n, int32_t level, int32_t measure, int place)
{
    real properties[PROPERTIES];
    ENTRY(toron_preset)("kevlar-km2-600", "mm-kg-ms", properties, PROPERTIES, NULL, NULL, 0);
    const size_t entries = measure == TORON_TANGENT_NOMINAL ? 81 : 36;
    make_inputs(n);
    for (int which = 0; which < WAYS; which++) {
        const way w = way_of(which, n);
        const toron_hyperelastic *law = prepared(properties);
        outputs plain = {.stress = reals(6 * n), .state = reals(STATE * n), .modes = reals(MODES * n),
                         .tangent = reals(entries * n)}, out;
        toron_block block = {.measure = measure, .level = level, .deformation_gradient = {f_new}, .fibre = {fibre},
                             .energies_old = old,
                             .invariants_old = old + INVARIANTS * n, .failure_old = old + FAILURE * n, .stress = {plain.stress},
                             .energies = plain.state, .invariants = plain.state + INVARIANTS * n,
                             .failure = plain.state + FAILURE * n, .modes = plain.modes, .tangent = plain.tangent};
        const int32_t worst = evaluate(law, &block, &plain, n);
        CHECK(worst == (n > 5 ? TORON_INVERTED : TORON_OK), "%d: %s", worst, text);

        real *state_old = spread(old, STATE, n, &w.state);
        out = (outputs){.stress = room_for(6, n, &w.stress), .state = place == IN_PLACE ? state_old : room_for(STATE, n, &w.state),
                        .modes = room_for(MODES, n, &w.modes), .tangent = room_for(entries, n, &w.tangent)};
        block = (toron_block){.leading_dimension = w.leading_dimension, .measure = measure, .level = level,
                              .energies_old = state_old,
                              .invariants_old = state_old + w.state.offset[INVARIANTS], .failure_old = state_old + w.state.offset[FAILURE],
                              .energies = out.state, .invariants = out.state + w.state.offset[INVARIANTS],
                              .failure = out.state + w.state.offset[FAILURE], .modes = out.modes, .tangent = out.tangent,
                              .deformation_gradient_layout = w.f.layout, .fibre_layout = w.fibre.layout, .state_layout = w.state.layout,
                              .stress_layout = w.stress.layout, .modes_layout = w.modes.layout, .tangent_layout = w.tangent.layout};
        if (place == ENERGIES_IN_PLACE) {
            for (size_t c = 0; c < 4; c++)
                for (size_t i = 0; i < n; i++)
                    out.state[w.state.offset[c] + i * w.state.stride] = old[c * n + i];
            block.energies_old = out.state;
        }
        real *f = spread(f_new, 9, n, &w.f), *m = spread(fibre, 3, n, &w.fibre);
        point_to(block.deformation_gradient, f, 9, &w.f);
        point_to(block.fibre, m, 3, &w.fibre);
        point_to(block.stress, out.stress, 6, &w.stress);
        CHECK(evaluate(law, &block, &out, n) == worst, "%s: %s", w.name, text);
        check_same("F", &w, f, f_new, 9, n, &w.f);
        check_same("fibre", &w, m, fibre, 3, n, &w.fibre);
        check_same("stress", &w, out.stress, plain.stress, 6, n, &w.stress);
        check_same("state", &w, out.state, plain.state, STATE, n, &w.state);
        if (place != IN_PLACE)
            check_same("old state", &w, state_old, old, STATE, n, &w.state);
        check_same("modes", &w, out.modes, plain.modes, MODES, n, &w.modes);
        check_same("tangent", &w, out.tangent, plain.tangent, entries, n, &w.tangent);
        CHECK(memcmp(out.wave_speed, plain.wave_speed, n * sizeof(real)) == 0, "%s: wave speed", w.name);
        CHECK(memcmp(out.active, plain.active, n * sizeof(real)) == 0, "%s: active", w.name);
        CHECK(memcmp(out.status, plain.status, n * sizeof(int32_t)) == 0, "%s: status", w.name);
        release();
    }
}

/* What an explicit solver requests, and nothing else: other kernels than those above. */
static void usual_requests(size_t n, int32_t level, int request)
{
    real properties[PROPERTIES];
    ENTRY(toron_preset)("kevlar-km2-600", "mm-kg-ms", properties, PROPERTIES, NULL, NULL, 0);
    make_inputs(n);
    for (int which = 0; which < WAYS; which++) {
        const way w = way_of(which, n);
        const toron_hyperelastic *law = prepared(properties);
        real *stress = reals(6 * n), *state = reals(STATE * n), *speed = reals(n), *speed_spread = reals(n);
        toron_block block = {.size = sizeof block, .n = n, .level = level, .density = 1.4, .deformation_gradient = {f_new},
                             .stress = {stress},
                             .wave_speed = request == 2 ? speed : NULL};
        toron_block other = {.size = sizeof other, .n = n, .leading_dimension = w.leading_dimension, .level = level, .density = 1.4,
                             .wave_speed = request == 2 ? speed_spread : NULL, .deformation_gradient_layout = w.f.layout,
                             .state_layout = w.state.layout, .stress_layout = w.stress.layout};
        real *f = spread(f_new, 9, n, &w.f), *out = room_for(6, n, &w.stress), *new = spread(old, STATE, n, &w.state);
        memcpy(state, old, STATE * n * sizeof(real));
        if (request > 0) {
            block.energies_old = block.energies = state, other.energies_old = other.energies = new;
            block.invariants_old = block.invariants = state + INVARIANTS * n;
            block.failure_old = block.failure = state + FAILURE * n;
            other.invariants_old = other.invariants = new + w.state.offset[INVARIANTS];
            other.failure_old = other.failure = new + w.state.offset[FAILURE];
        }
        point_to(other.deformation_gradient, f, 9, &w.f);
        point_to(other.stress, out, 6, &w.stress);
        const int32_t status = TOLD(ENTRY(toron_hyperelastic_block), law, &block);
        CHECK(TOLD(ENTRY(toron_hyperelastic_block), law, &other) == status, "%s: %s", w.name, text);
        check_same("stress", &w, out, stress, 6, n, &w.stress);
        check_same("state", &w, new, state, STATE, n, &w.state);
        CHECK(request < 2 || memcmp(speed, speed_spread, n * sizeof(real)) == 0, "%s: wave speed", w.name);
        release();
    }
}

/* ---- The linear elastic law */

typedef struct {
    real *stress, *state, *axes, *tangent, *wave_speed, *active;
    int32_t *status;
} linear_outputs;

static int32_t evaluate_linear(const toron_linear_elastic *law, toron_linear_block *block, linear_outputs *out, size_t n)
{
    out->wave_speed = block->wave_speed = reals(n), out->active = block->active = reals(n);
    out->status = block->status = guarded(n * sizeof(int32_t));
    block->size = sizeof *block, block->n = n, block->density = 1.4;
    return TOLD(ENTRY(toron_linear_elastic_block), law, block);
}

static void linear_elastic(size_t n, int32_t level, int32_t rotation, int with_tangent)
{
    real properties[TORON_LINEAR_ELASTIC_PROPERTIES], axes[9 * MOST_POINTS];
    toron_linear_elastic law;
    ENTRY(toron_preset)("kevlar-km2-600-linear", "mm-kg-ms", properties, TORON_LINEAR_ELASTIC_PROPERTIES, NULL, NULL, 0);
    CHECK(TOLD(ENTRY(toron_linear_elastic_prepare), &law, sizeof law, properties, TORON_LINEAR_ELASTIC_PROPERTIES) == TORON_OK,
          "%s", text);
    make_inputs(n);
    for (size_t i = 0; i < 9 * n; i++)
        axes[i] = (real)(i / n % 4 == 0);
    for (int which = 0; which < WAYS; which++) {
        way w = way_of(which, n);
        linear_outputs plain = {.stress = reals(6 * n), .state = reals(LINEAR_STATE * n), .axes = reals(9 * n),
                                .tangent = with_tangent ? reals(36 * n) : NULL}, out;
        memcpy(plain.axes, axes, 9 * n * sizeof(real));
        toron_linear_block block = {.rotation = rotation, .measure = TORON_TANGENT_TRUESDELL, .level = level, .f_old = {f_old},
                                    .f_new = {f_new}, .fibre = {fibre}, .second_axis = {second}, .axes = plain.axes, .state_old = old,
                                    .state_new = plain.state, .stress = {plain.stress}, .tangent = plain.tangent};
        const int32_t worst = evaluate_linear(&law, &block, &plain, n);
        CHECK(worst == (n > 5 ? TORON_INVERTED : TORON_OK), "%d: %s", worst, text);

        out = (linear_outputs){.stress = room_for(6, n, &w.stress), .state = room_for(LINEAR_STATE, n, &w.state),
                               .axes = spread(axes, 9, n, &w.axes), .tangent = with_tangent ? room_for(36, n, &w.tangent) : NULL};
        block = (toron_linear_block){.leading_dimension = w.leading_dimension, .rotation = rotation,
                                     .measure = TORON_TANGENT_TRUESDELL,
                                     .level = level, .axes = out.axes, .state_old = spread(old, LINEAR_STATE, n, &w.state),
                                     .state_new = out.state, .tangent = out.tangent, .deformation_gradient_layout = w.f.layout,
                                     .fibre_layout = w.fibre.layout, .axes_layout = w.axes.layout, .state_layout = w.state.layout,
                                     .stress_layout = w.stress.layout, .tangent_layout = w.tangent.layout};
        point_to(block.f_old, spread(f_old, 9, n, &w.f), 9, &w.f);
        point_to(block.f_new, spread(f_new, 9, n, &w.f), 9, &w.f);
        point_to(block.fibre, spread(fibre, 3, n, &w.fibre), 3, &w.fibre);
        point_to(block.second_axis, spread(second, 3, n, &w.fibre), 3, &w.fibre);
        point_to(block.stress, out.stress, 6, &w.stress);
        CHECK(evaluate_linear(&law, &block, &out, n) == worst, "%s: %s", w.name, text);
        check_same("stress", &w, out.stress, plain.stress, 6, n, &w.stress);
        check_same("state", &w, out.state, plain.state, LINEAR_STATE, n, &w.state);
        check_same("axes", &w, out.axes, plain.axes, 9, n, &w.axes);
        if (with_tangent)
            check_same("tangent", &w, out.tangent, plain.tangent, 36, n, &w.tangent);
        CHECK(memcmp(out.wave_speed, plain.wave_speed, n * sizeof(real)) == 0, "%s: wave speed", w.name);
        CHECK(memcmp(out.active, plain.active, n * sizeof(real)) == 0, "%s: active", w.name);
        CHECK(memcmp(out.status, plain.status, n * sizeof(int32_t)) == 0, "%s: status", w.name);
        release();
    }
}

int main(void)
{
    static const size_t counts[] = {1, 2, 7, 8, MOST_POINTS};
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++)
        for (int32_t level = TORON_LEVEL_BEST; level <= TORON_LEVEL_AVX512; level++) {
            for (int place = 0; place < PLACES; place++) {
                hyperelastic(counts[k], level, TORON_TANGENT_TRUESDELL, place);
                hyperelastic(counts[k], level, TORON_TANGENT_NOMINAL, place);
            }
            for (int request = 0; request < 3; request++)
                usual_requests(counts[k], level, request);
            for (int32_t rotation = 0; rotation < 3; rotation++)
                for (int with_tangent = 0; with_tangent < 2; with_tangent++)
                    linear_elastic(counts[k], level, rotation, with_tangent);
        }
    return finish();
}
