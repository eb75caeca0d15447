/* One point and blocks of points: the truth's numbers, what may be left out, and what is refused. */
#include "check.h"

static const real density = 1351;

/* S by mode against the truth in double precision, where its scale is known: the pull-back magnifies errors elsewhere.
 * In every case and precision the push-forward F S Fᵀ/J of their sum is the stress of the same call. */
static void check_modes(const truth *t, const real *modes, const real *stress)
{
    double sizes = 0, square = 0, sum[6] = {0}, pushed[6];
    for (int mode = 0; mode < 4; mode++) {
        const double six[6] = {modes[6 * mode],     modes[6 * mode + 1], modes[6 * mode + 2],
                               modes[6 * mode + 3], modes[6 * mode + 4], modes[6 * mode + 5]};
        sizes += norm(six);
        for (int c = 0; c < 6; c++)
            sum[c] += six[c];
    }
    if (t->modes_bounded && sizeof(real) == sizeof(double))
        for (int mode = 0; mode < 4; mode++)
            CHECK(distance(modes + 6 * mode, 1, t->modes + 6 * mode) <= 1e-12 * sizes, "case %d, mode %d", t->id, mode);
    const int component[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}, pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
    for (int c = 0; c < 6; c++) {
        pushed[c] = 0;
        for (int k = 0; k < 3; k++)
            for (int l = 0; l < 3; l++)
                pushed[c] += t->f[3 * k + pairs[c][0]] * sum[component[k][l]] * t->f[3 * l + pairs[c][1]];
        pushed[c] /= determinant(t->f);
    }
    for (int i = 0; i < 9; i++)
        square += t->f[i] * t->f[i];
    double scale = square * sizes / determinant(t->f);
    CHECK(distance(stress, 1, pushed) <= ALLOWED * scale, "case %d: %g of %g", t->id, distance(stress, 1, pushed), scale);
}

/* The two ways to call the law: prepared, or with its properties. */
enum { PREPARED, WITH_PROPERTIES, WAYS };

static int32_t evaluate_point(int way, const real *properties, const toron_point *point)
{
    if (way == WITH_PROPERTIES)
        return TOLD(ENTRY(toron_hyperelastic_point_with_properties), properties, PROPERTIES, point);
    return TOLD(ENTRY(toron_hyperelastic_point), prepared(properties), point);
}

static int32_t evaluate_block(int way, const real *properties, const toron_block *block)
{
    if (way == WITH_PROPERTIES)
        return TOLD(ENTRY(toron_hyperelastic_block_with_properties), properties, PROPERTIES, block);
    return TOLD(ENTRY(toron_hyperelastic_block), prepared(properties), block);
}

static void every_case(int way)
{
    for (const truth *t = cases; t < cases + case_count; t++) {
        real *properties = copied(t->properties, PROPERTIES);
        toron_point point = {.size = sizeof point, .density = density, .deformation_gradient = copied(t->f, 9),
                             .state_old = filled(0, STATE), .state_new = reals(STATE), .stress = reals(6),
                             .modes = reals(24), .wave_speed = reals(1)};
        int32_t status = evaluate_point(way, properties, &point);
        CHECK(status == TORON_OK, "case %d: %d", t->id, status);
        check_stress(t, point.stress, 1);
        check_state(t, point.state_new, 1);
        check_modes(t, point.modes, point.stress);
        double bar = sqrt(t->properties[0] / density), speed = *point.wave_speed;
        CHECK(speed >= bar * (1 - 1e-6) && speed < INFINITY, "case %d: wave speed %g", t->id, speed);

        /* The best instructions are those of AVX2; the baseline's results are as good. */
        toron_point other = point;
        other.level = TORON_LEVEL_AVX2, other.stress = reals(6), other.state_new = reals(STATE);
        CHECK(evaluate_point(way, properties, &other) == TORON_OK, "case %d: %s", t->id, text);
        CHECK(memcmp(other.stress, point.stress, 6 * sizeof(real)) == 0, "case %d: AVX2", t->id);
        CHECK(memcmp(other.state_new, point.state_new, STATE * sizeof(real)) == 0, "case %d: AVX2", t->id);
        other.level = TORON_LEVEL_BASELINE;
        CHECK(evaluate_point(way, properties, &other) == TORON_OK, "case %d: %s", t->id, text);
        check_stress(t, other.stress, 1);
        check_state(t, other.state_new, 1);
        release();
    }
}

/* The direction as a property or as an argument of another length, old state null or 0, in place: the same bits. */
static void ways_to_ask(int way)
{
    const truth *t = &cases[case_count - 1];
    real *properties = copied(t->properties, PROPERTIES), *f = copied(t->f, 9), *state = filled(0, STATE);
    real *new = reals(STATE), *stress = reals(6), *again = reals(6);
    toron_point point = {.size = sizeof point, .deformation_gradient = f, .state_new = new, .stress = stress};
    CHECK(evaluate_point(way, properties, &point) == TORON_OK, "%s", text);
    point.state_old = point.state_new = state, point.stress = again;
    CHECK(evaluate_point(way, properties, &point) == TORON_OK, "%s", text);
    CHECK(memcmp(state, new, STATE * sizeof(real)) == 0 && memcmp(stress, again, 6 * sizeof(real)) == 0, "in place");

    real *fibre = copied(t->properties + 8, 3), *other = copied(t->properties, PROPERTIES);
    other[8] = 0, other[9] = 1, other[10] = 0;
    for (int i = 0; i < 3; i++)
        fibre[i] *= 4;
    point.fibre = fibre, point.state_old = point.state_new = NULL;
    CHECK(evaluate_point(way, other, &point) == TORON_OK, "%s", text);
    CHECK(memcmp(stress, again, 6 * sizeof(real)) == 0, "the fibre as an argument");

    point = (toron_point){.size = sizeof point, .deformation_gradient = f};
    CHECK(evaluate_point(way, properties, &point) == TORON_OK, "nothing wanted: %s", text);

    /* A latched point: no stress, the rest as it was. */
    for (int i = 0; i < STATE; i++)
        state[i] = (real)(i + 1);
    state[FAILED] = 1;
    point.state_old = state, point.state_new = new, point.stress = stress;
    int32_t status = evaluate_point(way, properties, &point);
    CHECK(status == TORON_OK && new[FAILED] == 1 && new[ALIVE] == 0, "%d", status);
    CHECK(memcmp(state, new, FAILED * sizeof(real)) == 0, "energies, invariants and index of a failed point");
    for (int c = 0; c < 6; c++)
        CHECK(stress[c] == 0, "stress of a failed point");

    /* A point at fault: no stress, the state as it was but for `alive`; the message is the code's. */
    f[0] = -f[0], f[1] = -f[1], f[2] = -f[2], state[FAILED] = 0;
    CHECK(evaluate_point(way, properties, &point) == TORON_INVERTED && strcmp(text, INVERTED_TEXT) == 0, "%s", text);
    CHECK(memcmp(state, new, ALIVE * sizeof(real)) == 0 && new[ALIVE] == 1 && stress[0] == 0, "a point at fault");
    fibre[0] = fibre[1] = fibre[2] = 0, point.fibre = fibre;
    CHECK(evaluate_point(way, properties, &point) == TORON_FIBRE_DIRECTION && strcmp(text, NO_FIBRE_TEXT) == 0, "%s", text);
    release();
}

/* Every combination of outputs: each has the bits that it has when everything is wanted. */
static void point_outputs(int way, const truth *t, unsigned inputs)
{
    static const output outputs[] = {{offsetof(toron_point, state_new), STATE * sizeof(real)},
                                     {offsetof(toron_point, stress), 6 * sizeof(real)},
                                     {offsetof(toron_point, modes), 24 * sizeof(real)}, {offsetof(toron_point, wave_speed),
                                                                                         sizeof(real)},
                                     {offsetof(toron_point, tangent), 36 * sizeof(real)}};
    enum { COUNT = sizeof outputs / sizeof *outputs };
    const unsigned all = (1u << COUNT) - 1;
    for (unsigned wanted = 0; wanted <= all; wanted++) {
        void *whole[COUNT], *part[COUNT];
        real *properties = copied(t->properties, PROPERTIES);
        toron_point point = {.size = sizeof point, .measure = TORON_TANGENT_JAUMANN, .density = density,
                             .deformation_gradient = copied(t->f, 9)};
        if (inputs & 1)
            point.fibre = filled(3, 3);
        if (inputs & 2)
            point.state_old = filled(0.25, STATE);
        request(&point, outputs, COUNT, all, whole);
        CHECK(evaluate_point(way, properties, &point) == TORON_OK && ((real *)whole[0])[FAILED] != 1, "%s", text);
        request(&point, outputs, COUNT, wanted, part);
        CHECK(evaluate_point(way, properties, &point) == TORON_OK, "%s", text);
        for (size_t k = 0; k < COUNT; k++)
            CHECK(part[k] == NULL || memcmp(part[k], whole[k], outputs[k].bytes) == 0, "case %d, wanted %#x, output %zu", t->id,
                  wanted, k);
        release();
    }
}

/* Every measure of the tangent; stress and state are those of the call without. */
static void tangents(int way)
{
    for (const truth *t = cases; t < cases + case_count; t++) {
        real *properties = copied(t->properties, PROPERTIES), *f = copied(t->f, 9), *new = reals(STATE), *plain = reals(STATE);
        real *stress = reals(6), *alone = reals(6), *jaumann = reals(36), *truesdell = reals(36), *material = reals(36);
        real *nominal = reals(81);
        toron_point point = {.size = sizeof point, .measure = -1, .deformation_gradient = f, .state_new = plain, .stress = alone};
        CHECK(evaluate_point(way, properties, &point) == TORON_OK, "case %d: %s; the measure is not read", t->id, text);
        point.state_new = new, point.stress = stress, point.measure = TORON_TANGENT_JAUMANN, point.tangent = jaumann;
        int32_t status = evaluate_point(way, properties, &point);
        CHECK(status == TORON_OK, "case %d: %d", t->id, status);
        CHECK(memcmp(stress, alone, 6 * sizeof(real)) == 0, "case %d: stress", t->id);
        CHECK(memcmp(new, plain, STATE * sizeof(real)) == 0, "case %d: state", t->id);
        check_tangent(t, jaumann, 1, NULL, 0);
        point = (toron_point){.size = sizeof point, .measure = TORON_TANGENT_TRUESDELL, .deformation_gradient = f,
                              .tangent = truesdell};
        evaluate_point(way, properties, &point);
        check_tangent(t, truesdell, 1, stress, 0);
        point.measure = TORON_TANGENT_MATERIAL, point.tangent = material;
        evaluate_point(way, properties, &point);
        point.measure = TORON_TANGENT_NOMINAL, point.tangent = nominal;
        evaluate_point(way, properties, &point);
        for (int k = 0; k < 36; k++)
            CHECK(material[k] == material[k % 6 * 6 + k / 6], "case %d: material, entry %d", t->id, k);
        for (int k = 0; k < 81; k++)
            CHECK(nominal[k] == nominal[k % 9 * 9 + k / 9], "case %d: nominal, entry %d", t->id, k);

        /* The latch set before: nothing. */
        new[FAILED] = 1;
        point.state_old = new, point.stress = stress, point.measure = TORON_TANGENT_JAUMANN, point.tangent = jaumann;
        status = evaluate_point(way, properties, &point);
        for (int k = 0; k < 36; k++)
            CHECK(status == TORON_OK && jaumann[k] == 0 && stress[0] == 0, "case %d: failed", t->id);
        release();
    }
}

#ifndef SINGLE
static void least_acoustic_eigenvalues(void)
{
#define EIGENVALUE toron_hyperelastic_least_acoustic_eigenvalue_f64
    for (const truth *t = cases; t < cases + case_count; t++) {
        const toron_hyperelastic *law = prepared(copied(t->properties, PROPERTIES));
        double *least = reals(1), *direction = reals(3), *alone = reals(1);
        toron_point point = {.size = sizeof point, .deformation_gradient = copied(t->f, 9)};
        int32_t status = TOLD(EIGENVALUE, law, &point, least, direction);
        double square = direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2];
        CHECK(status == TORON_OK && isfinite(*least) && fabs(square - 1) < 1e-12, "case %d: %d", t->id, status);
        point.fibre = copied(t->properties + 8, 3);
        CHECK(TOLD(EIGENVALUE, law, &point, alone, NULL) == TORON_OK, "case %d", t->id);
        CHECK(fabs(*alone - *least) <= 1e-16 * t->properties[0], "case %d: %g instead of %g", t->id, *alone, *least);
        release();
    }
    const toron_hyperelastic *law = prepared(copied(cases[0].properties, PROPERTIES)), none = {0};
    double *f = copied(cases[0].f, 9), *least = reals(1), *direction = reals(3);
    toron_point point = {.size = sizeof point, .deformation_gradient = f};
    REFUSED(TORON_NULL_ARGUMENT, "argument law is null", EIGENVALUE, NULL, &point, least, direction);
    REFUSED(TORON_NOT_PREPARED, NOT_PREPARED_BY(toron_hyperelastic_prepare), EIGENVALUE, &none, &point, least, direction);
    REFUSED(TORON_NULL_ARGUMENT, "argument point is null", EIGENVALUE, law, NULL, least, direction);
    REFUSED(TORON_NULL_ARGUMENT, "argument least is null", EIGENVALUE, law, &point, NULL, direction);
    f[0] = -1;
    REFUSED(TORON_INVERTED, INVERTED_TEXT, EIGENVALUE, law, &point, least, direction);
    point.deformation_gradient = NULL;
    REFUSED(TORON_NULL_ARGUMENT, "argument deformation_gradient is null", EIGENVALUE, law, &point, least, direction);
    CHECK(untouched(least, sizeof *least) && untouched(direction, 3 * sizeof *direction), "nothing is written");
    release();
}
#endif

/* A point that is refused: the code, the message, and nothing is written. */
static void refused_point(const real *properties, toron_point point, int32_t wanted, const char *words)
{
    REFUSED(wanted, words, ENTRY(toron_hyperelastic_point), prepared(properties), &point);
    REFUSED(wanted, words, ENTRY(toron_hyperelastic_point_with_properties), properties, PROPERTIES, &point);
    CHECK(untouched(point.stress, 6 * sizeof(real)) && untouched(point.state_new, STATE * sizeof(real)), "%s", words);
    CHECK(untouched(point.tangent, 81 * sizeof(real)) && untouched(point.wave_speed, sizeof(real)), "%s", words);
}

static void wrong_points(void)
{
    const truth *t = &cases[0];
    real *properties = copied(t->properties, PROPERTIES), *f = copied(t->f, 9);
    const toron_point good = {.size = sizeof good, .density = density, .deformation_gradient = f, .state_new = reals(STATE),
                              .stress = reals(6), .wave_speed = reals(1), .tangent = reals(81)};
    toron_point point = good;
    point.measure = -1;
    refused_point(properties, point, TORON_BAD_ARGUMENT, "argument measure is -1; allowed: " MEASURES_TEXT);
    point.measure = 4;
    refused_point(properties, point, TORON_BAD_ARGUMENT, "argument measure is 4; allowed: " MEASURES_TEXT);
    point = good, point.level = -1;
    refused_point(properties, point, TORON_BAD_ARGUMENT, "argument level is -1; allowed: " LEVELS_TEXT);
    point.level = 4;
    refused_point(properties, point, TORON_BAD_ARGUMENT, "argument level is 4; allowed: " LEVELS_TEXT);
    point = good, point.density = 0;
    refused_point(properties, point, TORON_BAD_ARGUMENT, "argument density is 0.0; allowed: " DENSITIES_TEXT);
    point = good, point.deformation_gradient = NULL;
    refused_point(properties, point, TORON_NULL_ARGUMENT, "argument deformation_gradient is null");

#define POINT ENTRY(toron_hyperelastic_point)
#define POINT_WITH ENTRY(toron_hyperelastic_point_with_properties)
    const toron_hyperelastic *law = prepared(properties);
    REFUSED(TORON_NULL_ARGUMENT, "argument point is null", POINT, law, NULL);
    REFUSED(TORON_NULL_ARGUMENT, "argument point is null", POINT_WITH, properties, PROPERTIES, NULL);
    REFUSED(TORON_NULL_ARGUMENT, "argument law is null", POINT, NULL, &good);
    REFUSED(TORON_NULL_ARGUMENT, "argument properties is null", POINT_WITH, NULL, PROPERTIES, &good);
    REFUSED(TORON_PROPERTY_COUNT, "number of properties: 10 given, 11 needed", POINT_WITH, properties, PROPERTIES - 1, &good);
    real *wrong = copied(t->properties, PROPERTIES);
    wrong[0] = -1;
    REFUSED(TORON_PROPERTY_OUT_OF_BOUNDS,
            "property 1 (k_el, longitudinal elongation stiffness) is -1.0; allowed: a number from 0 to 1e25", POINT_WITH,
            wrong, PROPERTIES, &good);
    CHECK(untouched(good.stress, 6 * sizeof(real)) && untouched(good.tangent, 81 * sizeof(real)), "nothing is written");

    /* A point at fault has no stiffness; without room for a tangent a block is a block. */
    f[0] = -f[0], f[1] = -f[1], f[2] = -f[2];
    point = good, point.measure = TORON_TANGENT_NOMINAL;
    REFUSED(TORON_INVERTED, INVERTED_TEXT, POINT, law, &point);
    for (int k = 0; k < 81; k++)
        CHECK(good.tangent[k] == 0, "entry %d", k);
    toron_block block = {.size = sizeof block, .n = 1, .deformation_gradient = {f}, .stress = {good.stress}};
    REFUSED(TORON_INVERTED, "point 0, counted from 0: " INVERTED_TEXT, ENTRY(toron_hyperelastic_block), law, &block);
    release();
}

/* A law that nobody has prepared, another one, or one of the other precision; a structure of another size; copies. */
static void prepared_laws(void)
{
#define PREPARE ENTRY(toron_hyperelastic_prepare)
#ifdef SINGLE
#define OTHER(name) name##_f64
    double linear[TORON_LINEAR_ELASTIC_PROPERTIES], values[PROPERTIES];
#else
#define OTHER(name) name##_f32
    float linear[TORON_LINEAR_ELASTIC_PROPERTIES], values[PROPERTIES];
#endif
    const truth *t = &cases[0];
    real *properties = copied(t->properties, PROPERTIES), *own_linear = reals(TORON_LINEAR_ELASTIC_PROPERTIES);
    ENTRY(toron_preset)("kevlar-km2-600-linear", "mm-kg-ms", own_linear, TORON_LINEAR_ELASTIC_PROPERTIES, NULL, NULL, 0);
    OTHER(toron_preset)("kevlar-km2-600-linear", "mm-kg-ms", linear, TORON_LINEAR_ELASTIC_PROPERTIES, NULL, NULL, 0);
    OTHER(toron_preset)("kevlar-km2-600", "mm-kg-ms", values, PROPERTIES, NULL, NULL, 0);
    toron_hyperelastic *zero = guarded(sizeof *zero);
    memset(zero, 0, sizeof *zero);
    toron_linear_elastic *own = guarded(sizeof *own);
    OTHER(toron_hyperelastic) *other = guarded(sizeof *other);
    OTHER(toron_linear_elastic) *neither = guarded(sizeof *neither);
    CHECK(TOLD(ENTRY(toron_linear_elastic_prepare), own, sizeof *own, own_linear, TORON_LINEAR_ELASTIC_PROPERTIES) == TORON_OK,
          "%s", text);
    CHECK(TOLD(OTHER(toron_hyperelastic_prepare), other, sizeof *other, values, PROPERTIES) == TORON_OK, "%s", text);
    CHECK(TOLD(OTHER(toron_linear_elastic_prepare), neither, sizeof *neither, linear, TORON_LINEAR_ELASTIC_PROPERTIES) == TORON_OK,
          "%s", text);
    /* A copy that is cut off. */
    toron_hyperelastic *cut = guarded(sizeof *cut);
    CHECK(TOLD(PREPARE, cut, sizeof *cut, properties, PROPERTIES) == TORON_OK, "%s", text);
    memset((char *)cut + sizeof *cut / 2, 0, sizeof *cut / 2);
    const void *wrong[] = {zero, own, other, neither, cut};
    const toron_point point = {.size = sizeof point, .deformation_gradient = copied(t->f, 9), .stress = reals(6)};
    const toron_block block = {.size = sizeof block, .n = 1, .deformation_gradient = {point.deformation_gradient},
                               .stress = {point.stress}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        REFUSED(TORON_NOT_PREPARED, NOT_PREPARED_BY(toron_hyperelastic_prepare), POINT, wrong[i], &point);
        REFUSED(TORON_NOT_PREPARED, NOT_PREPARED_BY(toron_hyperelastic_prepare), ENTRY(toron_hyperelastic_block), wrong[i], &block);
    }
    CHECK(untouched(point.stress, 6 * sizeof(real)), "nothing is written");

    toron_hyperelastic *law = guarded(sizeof *law);
    const size_t sizes[] = {0, 8, sizeof *law - 8, sizeof *law + 8, sizeof *other, (size_t)1 << 40};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        char words[200];
        snprintf(words, sizeof words, "the size of " TEXT(ENTRY(toron_hyperelastic)) " is given as %zu; it is "
                 "%zu in this version of the library", sizes[i], sizeof *law);
        REFUSED(TORON_BAD_SIZE, words, PREPARE, law, sizes[i], properties, PROPERTIES);
    }
    REFUSED(TORON_NULL_ARGUMENT, "argument law is null", PREPARE, NULL, sizeof *law, properties, PROPERTIES);
    CHECK(untouched(law, sizeof *law), "nothing is written");

    /* Every byte is the law's, so that copies can be compared; a copy needs neither the original nor the properties. */
    toron_hyperelastic *again = prepared(properties), *copy = guarded(sizeof *copy);
    CHECK(TOLD(PREPARE, law, sizeof *law, properties, PROPERTIES) == TORON_OK, "%s", text);
    CHECK(memcmp(law, again, sizeof *law) == 0 && law->size == sizeof *law, "two laws of the same properties");
    memcpy(copy, law, sizeof *copy);
    real *stress = reals(6);
    CHECK(TOLD(POINT, law, &point) == TORON_OK, "%s", text);
    memset(law, 0, sizeof *law), memset(properties, 0, PROPERTIES * sizeof *properties);
    toron_point elsewhere = point;
    elsewhere.stress = stress;
    CHECK(TOLD(POINT, copy, &elsewhere) == TORON_OK && memcmp(stress, point.stress, 6 * sizeof(real)) == 0, "%s", text);
    CHECK(memcmp(copy, again, sizeof *copy) == 0, "a law is read only");
    release();
}

/* Guarded arrays of a block: `ld` is more than n, so that there are gaps nobody may write to. */
typedef struct {
    size_t n, ld;
    real *f, *fibre, *state, *stress, *modes, *speed, *active;
    int32_t *status;
} arrays_of_block;

static arrays_of_block allocate(size_t n)
{
    size_t ld = n + 3;
    arrays_of_block a = {n,         ld,           reals(9 * ld), reals(3 * ld), reals(STATE * ld), reals(6 * ld),
                         reals(24 * ld), reals(ld), reals(ld), guarded(ld * sizeof(int32_t))};
    for (size_t j = 0; j < STATE; j++)
        for (size_t i = 0; i < n; i++)
            a.state[j * ld + i] = 0;
    return a;
}

static void set_point(arrays_of_block *a, size_t i, const truth *t)
{
    for (size_t c = 0; c < 9; c++)
        a->f[c * a->ld + i] = (real)t->f[c];
    for (size_t c = 0; c < 3; c++)
        a->fibre[c * a->ld + i] = (real)t->properties[8 + c];
}

static toron_block arguments(const arrays_of_block *a)
{
    real *w = a->state, *invariants = a->state + INVARIANTS * a->ld, *failure = a->state + FAILURE * a->ld;
    return (toron_block){.size = sizeof(toron_block), .n = a->n, .leading_dimension = a->ld, .deformation_gradient = {a->f},
                         .fibre = {a->fibre},
                         .energies_old = w, .invariants_old = invariants, .failure_old = failure, .density = density,
                         .stress = {a->stress}, .energies = w, .invariants = invariants, .failure = failure,
                         .modes = a->modes, .wave_speed = a->speed, .status = a->status, .active = a->active};
}

static void check_gaps(const arrays_of_block *a)
{
    const struct { const real *array; size_t components; } all[] = {{a->f, 9}, {a->fibre, 3}, {a->state, STATE},
                                                                    {a->stress, 6}, {a->modes, 24}, {a->speed, 1},
                                                                    {a->active, 1}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        for (size_t c = 0; c < all[k].components; c++)
            CHECK(untouched(all[k].array + c * a->ld + a->n, (a->ld - a->n) * sizeof(real)), "array %d", (int)k);
    CHECK(untouched(a->status + a->n, (a->ld - a->n) * sizeof(int32_t)), "status");
}

/* Point i of a block is bit for bit what the point alone is. */
static void check_as_alone(const arrays_of_block *a, size_t i, const truth *t)
{
    real *properties = copied(t->properties, PROPERTIES), *f = copied(t->f, 9), *new = reals(STATE), *stress = reals(6);
    block_of_one(properties, f, new, stress);
    for (size_t c = 0; c < 6; c++)
        CHECK(memcmp(&stress[c], &a->stress[c * a->ld + i], sizeof(real)) == 0, "case %d", t->id);
    for (size_t j = 0; j < STATE; j++)
        CHECK(memcmp(&new[j], &a->state[j * a->ld + i], sizeof(real)) == 0, "case %d, state %d", t->id, (int)j);
}

/* So is its tangent, of each measure of 6×6, with or without the state, and with the wave speed. */
static void tangents_alone(int way)
{
    enum { N = 5, LD = 7 };
    for (int first = 0; first + N <= case_count; first += 3) {
        real *properties = copied(cases[first].properties, PROPERTIES);
        real *f = reals(9 * LD), *fibre = reals(3 * LD), *old = filled(0.25, STATE * LD);
        for (size_t i = 0; i < N; i++) {
            for (size_t c = 0; c < 9; c++)
                f[c * LD + i] = (real)cases[first + (int)i].f[c];
            for (size_t c = 0; c < 3; c++)
                fibre[c * LD + i] = (real)cases[first + (int)i].properties[8 + c];
            old[FAILED * LD + i] = i == 1;
        }
        const int32_t wanted = first % 2 ? TORON_NOT_FINITE : TORON_OK;
        f[2 * LD + 3] = first % 2 ? NAN : f[2 * LD + 3];
        for (int variant = 0; variant < 24; variant++) {
            real *of_all = reals(54 * LD), *alone = reals(54 * LD);
            for (size_t i = 0; i <= N; i++) {
                /* All first, then each. */
                size_t from = i > 0 ? i - 1 : 0, n = i > 0 ? 1 : N;
                real *to = i > 0 ? alone : of_all;
                toron_block block = {.size = sizeof block, .n = n, .leading_dimension = LD, .measure = variant % 3, .density = density,
                                     .deformation_gradient = {f + from}, .stress = {to + from}, .tangent = to + 6 * LD + from};
                if (variant / 3 % 2)
                    block.fibre[0] = fibre + from;
                if (variant / 6 % 2) {
                    block.energies = to + 42 * LD + from;
                    block.invariants = to + (42 + INVARIANTS) * LD + from;
                    block.failure = to + (42 + FAILURE) * LD + from;
                    block.energies_old = old + from;
                    block.invariants_old = old + INVARIANTS * LD + from;
                    block.failure_old = old + FAILURE * LD + from;
                    if (variant / 12)
                        block.wave_speed = to + 53 * LD + from;
                }
                int32_t code = evaluate_block(way, properties, &block);
                CHECK(code == (n == N || from == 3 ? wanted : TORON_OK), "case %d, point %d: %d", cases[first].id, (int)i - 1, code);
            }
            CHECK(!untouched(alone + 6 * LD, sizeof(real)), "case %d: no tangent", cases[first].id);
            CHECK(same_bytes(alone, of_all, 54 * LD * sizeof(real)), "case %d, variant %d", cases[first].id, variant);
        }
        release();
    }
}

static void blocks(int way)
{
    for (int first = 0; first < case_count;) {
        int n = run_of_cases(first, 8);
        arrays_of_block a = allocate((size_t)n);
        for (int i = 0; i < n; i++)
            set_point(&a, (size_t)i, &cases[first + i]);
        real *properties = copied(cases[first].properties, PROPERTIES);
        real *tangent = reals(36 * a.ld);
        toron_block block = arguments(&a);
        block.measure = TORON_TANGENT_JAUMANN, block.tangent = tangent;
        int32_t status = evaluate_block(way, properties, &block);
        CHECK(status == TORON_OK, "%d", status);
        for (size_t c = 0; c < 36; c++)
            CHECK(untouched(tangent + c * a.ld + a.n, (a.ld - a.n) * sizeof(real)), "tangent %d", (int)c);
        for (int i = 0; i < n; i++) {
            check_tangent(&cases[first + i], tangent + i, a.ld, NULL, 0);
            CHECK(a.status[i] == TORON_OK, "case %d: %d", cases[first + i].id, a.status[i]);
            CHECK(a.active[i] == 1 - a.state[FAILED * a.ld + (size_t)i], "case %d", cases[first + i].id);
            check_stress(&cases[first + i], a.stress + i, a.ld);
            check_state(&cases[first + i], a.state + i, a.ld);
        }
        check_gaps(&a);
        release();
        first += n;
    }
}

/* Every combination of outputs, by both ways, without what else may be left out: each output has the bits that it has when
 * everything is wanted, gaps included. */
static void block_outputs(unsigned inputs)
{
    enum { N = 11, LD = N + 3 };
    static const output outputs[] = {
        {offsetof(toron_block, stress), 6 * LD * sizeof(real)}, {offsetof(toron_block, energies), 4 * LD * sizeof(real)},
        {offsetof(toron_block, invariants), 4 * LD * sizeof(real)}, {offsetof(toron_block, failure), 3 * LD * sizeof(real)},
        {offsetof(toron_block, modes), 24 * LD * sizeof(real)}, {offsetof(toron_block, tangent), 81 * LD * sizeof(real)},
        {offsetof(toron_block, wave_speed), N * sizeof(real)}, {offsetof(toron_block, active), N * sizeof(real)},
        {offsetof(toron_block, status), N * sizeof(int32_t)}};
    enum { COUNT = sizeof outputs / sizeof *outputs };
    const unsigned all = (1u << COUNT) - 1;
    const truth *t = &cases[case_count / 2];
    for (unsigned wanted = 0; wanted <= all; wanted++) {
        void *whole[COUNT], *part[COUNT];
        real *properties = copied(t->properties, PROPERTIES), *f = reals(9 * LD), *old = filled(0.25, STATE * LD);
        properties[5] = 0; /* no failure: what is left out does not change the rest */
        for (size_t i = 0; i < N; i++)
            for (size_t c = 0; c < 9; c++)
                f[c * LD + i] = (real)(t->f[c] + 0.01 * (double)(i * c % 5));
        toron_block block = {.size = sizeof block, .n = N, .leading_dimension = LD, .measure = TORON_TANGENT_NOMINAL,
                             .density = density,
                             .deformation_gradient = {f}};
        if (inputs & 1)
            block.fibre[0] = filled(3, 3 * LD);
        if (inputs & 2)
            block.energies_old = old;
        if (inputs & 4)
            block.invariants_old = old + INVARIANTS * LD;
        if (inputs & 8)
            block.failure_old = old + FAILURE * LD;
        request(&block, outputs, COUNT, all, whole);
        CHECK(evaluate_block(PREPARED, properties, &block) == TORON_OK, "%s", text);
        for (int way = 0; way < WAYS; way++) {
            request(&block, outputs, COUNT, wanted, part);
            CHECK(evaluate_block(way, properties, &block) == TORON_OK, "%s", text);
            for (size_t k = 0; k < COUNT; k++)
                CHECK(part[k] == NULL || same_bytes(part[k], whole[k], outputs[k].bytes), "wanted %#x, output %zu", wanted, k);
        }
        release();
    }
}

/* Points that cannot be evaluated, in the middle of a block: they say so, the others do not notice. */
static void bad_points(int way)
{
    enum { NAN_AT = 1, INVERTED_AT = 3, NO_FIBRE_AT = 4, NAN_STATE_AT = 6, N = 8 };
    const truth *t = &cases[case_count / 2];
    arrays_of_block a = allocate(N);
    for (size_t i = 0; i < N; i++)
        set_point(&a, i, t);
    a.f[4 * a.ld + NAN_AT] = NAN;
    for (size_t c = 0; c < 3; c++) {
        a.f[c * a.ld + INVERTED_AT] *= -1;
        a.fibre[c * a.ld + NO_FIBRE_AT] = 0;
    }
    a.state[NAN_AT] = 7;
    a.state[NAN_STATE_AT] = NAN;
    a.state[FAILED * a.ld + NAN_STATE_AT] = 1;
    real *properties = copied(t->properties, PROPERTIES);
    const double bar = sqrt(t->properties[0] / density);
    real *tangent = reals(36 * a.ld);
    toron_block block = arguments(&a);
    block.tangent = tangent;
    int32_t worst = evaluate_block(way, properties, &block);
    CHECK(strcmp(text, "point 4, counted from 0: " NO_FIBRE_TEXT) == 0, "%s", text);
    const int32_t wanted[N] = {0, TORON_NOT_FINITE, 0, TORON_INVERTED, TORON_FIBRE_DIRECTION, 0, TORON_STATE_NOT_FINITE, 0};
    CHECK(worst == TORON_FIBRE_DIRECTION, "%d", worst);
    for (size_t i = 0; i < N; i++) {
        CHECK(a.status[i] == wanted[i], "point %d: %d", (int)i, a.status[i]);
        CHECK(a.active[i] == (wanted[i] == 0 ? 1 - a.state[FAILED * a.ld + i] : 0), "point %d", (int)i);
        for (size_t c = 0; wanted[i] != 0 && c < 6; c++)
            CHECK(a.stress[c * a.ld + i] == 0, "point %d", (int)i);
        for (size_t c = 0; wanted[i] != 0 && c < 24; c++)
            CHECK(a.modes[c * a.ld + i] == 0, "point %d", (int)i);
        for (size_t c = 0; wanted[i] != 0 && c < 36; c++)
            CHECK(tangent[c * a.ld + i] == 0, "point %d", (int)i);
        CHECK(wanted[i] == 0 || fabs(a.speed[i] - bar) <= 1e-6 * bar, "point %d: wave speed %g at rest", (int)i, a.speed[i]);
        if (wanted[i] == 0)
            check_as_alone(&a, i, t);
    }
    block.status = NULL;
    CHECK(evaluate_block(way, properties, &block) == TORON_FIBRE_DIRECTION, "%s", text);
    CHECK(strcmp(text, "point 4, counted from 0: " NO_FIBRE_TEXT) == 0, "%s", text);
    CHECK(a.state[NAN_AT] == 7, "the old energy stays");
    CHECK(a.state[NAN_STATE_AT] == 0, "NaN does not");
    check_gaps(&a);
    release();
}

#define BLOCK_WITH ENTRY(toron_hyperelastic_block_with_properties)

/* Failure alone, in rows of its three components as by components. */
static void failure_alone(void)
{
    enum { N = 3, FAILURES = STATE - FAILURE };
    real *properties = copied(cases[0].properties, PROPERTIES), *f = reals(9 * N), *rows = reals(FAILURES * N);
    real *components = reals(FAILURES * N), *old = reals(FAILURES * N);
    for (size_t i = 0; i < N; i++) {
        for (size_t c = 0; c < 9; c++)
            f[c * N + i] = c % 4 == 0 ? 1 + (real)0.2 * (real)(i == 1) : 0; /* the second point is torn */
        for (size_t c = 0; c < FAILURES; c++)
            old[FAILURES * i + c] = 0;
    }
    properties[8] = 1, properties[9] = properties[10] = 0;
    toron_block block = {.size = sizeof block, .n = N, .leading_dimension = N, .deformation_gradient = {f}, .failure = components};
    CHECK(TOLD(BLOCK_WITH, properties, PROPERTIES, &block) == TORON_OK, "%s", text);
    block.failure = rows, block.failure_old = old, block.state_layout.stride = FAILURES;
    CHECK(TOLD(BLOCK_WITH, properties, PROPERTIES, &block) == TORON_OK, "%s", text);
    for (size_t c = 0; c < FAILURES; c++)
        for (size_t i = 0; i < N; i++)
            CHECK(rows[FAILURES * i + c] == components[c * N + i], "component %zu of point %zu", c, i);
    CHECK(rows[FAILURES + FAILED - FAILURE] == 1 && rows[FAILED - FAILURE] == 0, "the second point is torn, the first is not");
    release();
}

/* A wrong call: the code, the message, and nothing is written. */
static void refused(const real *properties, size_t count, toron_block block, arrays_of_block a, int32_t wanted, const char *words)
{
    if (wanted == TORON_OK)
        CHECK(TOLD(BLOCK_WITH, properties, count, &block) == TORON_OK, "%s", text);
    else
        REFUSED(wanted, words, BLOCK_WITH, properties, count, &block);
    CHECK(untouched(a.stress, 6 * a.ld * sizeof(real)), "stress, status %d", wanted);
    CHECK(untouched(a.modes, 24 * a.ld * sizeof(real)), "modes, status %d", wanted);
    CHECK(untouched(a.speed, a.ld * sizeof(real)), "wave speed, status %d", wanted);
    CHECK(untouched(a.status, a.ld * sizeof(int32_t)), "status %d", wanted);
    for (size_t j = 0; j < STATE; j++)
        CHECK(a.state[j * a.ld] == 0, "state, status %d", wanted);
}

/* A block that is refused, by both ways to call. */
static void refused_block(const real *properties, toron_block block, arrays_of_block a, int32_t wanted, const char *words)
{
    refused(properties, PROPERTIES, block, a, wanted, words);
    if (wanted == TORON_OK)
        CHECK(evaluate_block(PREPARED, properties, &block) == TORON_OK, "%s", text);
    else
        REFUSED(wanted, words, ENTRY(toron_hyperelastic_block), prepared(properties), &block);
    CHECK(untouched(a.stress, 6 * a.ld * sizeof(real)), "stress, status %d", wanted);
}

/* Negative distances, converted: for each array in turn, where the others are right. */
static void wrong_distances(const real *properties, toron_block good, arrays_of_block a, real *tangent)
{
    static const struct {
        const char *array;
        size_t layout;
    } layouts[] = {
        {"deformation_gradient", offsetof(toron_block, deformation_gradient_layout)}, {"fibre", offsetof(toron_block, fibre_layout)},
        {"the state", offsetof(toron_block, state_layout)}, {"stress", offsetof(toron_block, stress_layout)},
        {"modes", offsetof(toron_block, modes_layout)}, {"tangent", offsetof(toron_block, tangent_layout)},
    };
    good.tangent = tangent;
    for (size_t k = 0; k < sizeof layouts / sizeof *layouts; k++) {
        toron_block block = good;
        toron_layout *layout = (toron_layout *)((char *)&block + layouts[k].layout);
        char words[160];
        *layout = (toron_layout){0, (size_t)-3};
        snprintf(words, sizeof words, "argument stride of %s is -3; allowed: 1 to %zu", layouts[k].array, MOST_DISTANCE / 2);
        refused_block(properties, block, a, TORON_BAD_LEADING_DIMENSION, words);
        *layout = (toron_layout){1, MOST_DISTANCE / 2 + 1};
        snprintf(words, sizeof words, "argument stride of %s is %zu; allowed: 1 to %zu", layouts[k].array, MOST_DISTANCE / 2 + 1, MOST_DISTANCE / 2);
        refused_block(properties, block, a, TORON_BAD_LEADING_DIMENSION, words);
        for (size_t stride = 0; stride < 3; stride++) {
            *layout = (toron_layout){(size_t)-100, stride};
            snprintf(words, sizeof words, "argument leading dimension of %s is -100; allowed: 1 to " MOST_TEXT, layouts[k].array);
            refused_block(properties, block, a, TORON_BAD_LEADING_DIMENSION, words);
        }
    }
    /* Components with pointers of their own. */
    toron_block block = good;
    for (int c = 0; c < 9; c++)
        block.deformation_gradient[c] = good.deformation_gradient[0];
    block.deformation_gradient_layout.stride = (size_t)-1;
    refused_block(properties, block, a, TORON_BAD_LEADING_DIMENSION,
                  "argument stride of deformation_gradient is -1; allowed: 1 to 4503599627370495");
    /* The leading dimension of the whole block. */
    block = good, block.leading_dimension = (size_t)-1;
    refused_block(properties, block, a, TORON_BAD_LEADING_DIMENSION,
                  "argument leading dimension of deformation_gradient is -1; allowed: 1 to " MOST_TEXT);
    block.n = 1;
    refused_block(properties, block, a, TORON_BAD_LEADING_DIMENSION,
                  "argument leading dimension of deformation_gradient is -1; allowed: 1 to " MOST_TEXT);
}

static void wrong_calls(void)
{
    const truth *t = &cases[0];
    arrays_of_block a = allocate(2);
    set_point(&a, 0, t);
    set_point(&a, 1, t);
    real *properties = copied(t->properties, PROPERTIES), *wrong = copied(t->properties, PROPERTIES);
    const toron_block good = arguments(&a);
    refused(NULL, PROPERTIES, good, a, TORON_NULL_ARGUMENT, "argument properties is null");
    refused(properties, PROPERTIES - 1, good, a, TORON_PROPERTY_COUNT, "number of properties: 10 given, 11 needed");
    refused(properties, 0, good, a, TORON_PROPERTY_COUNT, "number of properties: 0 given, 11 needed");
    refused(properties, (size_t)-1, good, a, TORON_PROPERTY_COUNT, "number of properties: 9223372036854775807 given, 11 needed");
    wrong[0] = NAN;
    refused(wrong, PROPERTIES, good, a, TORON_PROPERTY_NOT_FINITE,
            "property 1 (k_el, longitudinal elongation stiffness) is NaN; allowed: a number from 0 to 1e25");
    wrong[0] = -1;
    refused(wrong, PROPERTIES, good, a, TORON_PROPERTY_OUT_OF_BOUNDS,
            "property 1 (k_el, longitudinal elongation stiffness) is -1.0; allowed: a number from 0 to 1e25");
    wrong[0] = 1, wrong[2] = 1;
    refused(wrong, PROPERTIES, good, a, TORON_PROPERTY_OUT_OF_BOUNDS,
            "property 3 (p, transverse compaction exponent) is 1.0; allowed: a number > 1, at most 40");
    wrong[2] = 2, wrong[8] = wrong[9] = wrong[10] = 0;
    refused(wrong, PROPERTIES, good, a, TORON_PROPERTY_DIRECTION,
            "properties 9 to 11 (fibre direction) are 0.0, 0.0, 0.0; allowed: any vector but zero");
    toron_block block = good;
    block.deformation_gradient[0] = NULL;
    refused_block(properties, block, a, TORON_NULL_ARGUMENT, "argument deformation_gradient is null");
    block = good, block.leading_dimension = 1;
    refused_block(properties, block, a, TORON_BAD_LEADING_DIMENSION,
                  "leading dimension of deformation_gradient: 1 given, 2 needed");
    block = (toron_block){.size = sizeof block, .n = 2, .leading_dimension = 1, .deformation_gradient = {a.f},
                          .stress = {a.stress}};
    refused_block(properties, block, a, TORON_BAD_LEADING_DIMENSION,
                  "leading dimension of deformation_gradient: 1 given, 2 needed");
    block = good, block.state_layout.leading_dimension = 1;
    refused_block(properties, block, a, TORON_BAD_LEADING_DIMENSION, "leading dimension of the state: 1 given, 2 needed");
    block = good, block.stress_layout = (toron_layout){1, 5}; /* rows of five numbers for six */
    refused_block(properties, block, a, TORON_BAD_LEADING_DIMENSION, "stride of stress: 5 given, 6 needed");
    block = good, block.state_layout = (toron_layout){2, 3};
    refused_block(properties, block, a, TORON_BAD_LEADING_DIMENSION, "leading dimension of the state: 2 given, 4 needed");
    block.energies = block.invariants = NULL, block.energies_old = block.invariants_old = NULL, block.state_layout = (toron_layout){0, 2};
    refused_block(properties, block, a, TORON_BAD_LEADING_DIMENSION, "stride of the state: 2 given, 3 needed");
    block = good, block.n = (size_t)-1;
    refused_block(properties, block, a, TORON_BAD_COUNT,
                  "argument n is -1; allowed: 0 to " MOST_TEXT);
    wrong_distances(properties, good, a, wrong);
    block = good, block.modes_layout.leading_dimension = 1;
    refused_block(properties, block, a, TORON_BAD_LEADING_DIMENSION, "leading dimension of modes: 1 given, 2 needed");
    block = good, block.tangent_layout.leading_dimension = 1, block.tangent = wrong;
    refused_block(properties, block, a, TORON_BAD_LEADING_DIMENSION, "leading dimension of tangent: 1 given, 2 needed");
    block = good, block.density = 0;
    refused_block(properties, block, a, TORON_BAD_ARGUMENT, "argument density is 0.0; allowed: " DENSITIES_TEXT);
    block = good, block.density = NAN;
    refused_block(properties, block, a, TORON_BAD_ARGUMENT, "argument density is NaN; allowed: " DENSITIES_TEXT);
    block = good, block.level = 4;
    refused_block(properties, block, a, TORON_BAD_ARGUMENT, "argument level is 4; allowed: " LEVELS_TEXT);
    block = good, block.measure = 4, block.tangent = wrong;
    refused_block(properties, block, a, TORON_BAD_ARGUMENT, "argument measure is 4; allowed: " MEASURES_TEXT);
    /* Some pointers to components, but not all of them. */
    block = good, block.deformation_gradient[5] = a.f;
    refused_block(properties, block, a, TORON_NULL_ARGUMENT, "argument deformation_gradient, one of its components, is null");
    block = good, block.fibre[2] = a.fibre;
    refused_block(properties, block, a, TORON_NULL_ARGUMENT, "argument fibre, one of its components, is null");
    block = good, block.stress[0] = NULL, block.stress[3] = a.stress;
    refused_block(properties, block, a, TORON_NULL_ARGUMENT, "argument stress, one of its components, is null");
    block = good, block.n = 0;
    refused_block(properties, block, a, TORON_OK, "");
    block = (toron_block){.size = sizeof block};
    refused_block(properties, block, a, TORON_OK, "");
    /* Only the deformation gradient is needed. */
    block = (toron_block){.size = sizeof block, .n = 2, .leading_dimension = a.ld, .deformation_gradient = {a.f}};
    refused_block(properties, block, a, TORON_OK, "");
    REFUSED(TORON_NULL_ARGUMENT, "argument block is null", BLOCK_WITH, properties, PROPERTIES, NULL);
    REFUSED(TORON_NULL_ARGUMENT, "argument block is null", ENTRY(toron_hyperelastic_block), prepared(properties), NULL);
    REFUSED(TORON_NULL_ARGUMENT, "argument law is null", ENTRY(toron_hyperelastic_block), NULL, &good);
    release();
}

int main(int argc, char **argv)
{
    read_cases(argc, argv);
    for (int way = 0; way < WAYS; way++) {
        every_case(way);
        ways_to_ask(way);
        tangents(way);
        tangents_alone(way);
        blocks(way);
        bad_points(way);
        for (unsigned inputs = 0; inputs < 4; inputs++)
            point_outputs(way, &cases[case_count / 2], inputs);
    }
    for (unsigned inputs = 0; inputs < 16; inputs += 5)
        block_outputs(inputs);
    failure_alone();
    wrong_points();
    wrong_calls();
    prepared_laws();
#ifndef SINGLE
    least_acoustic_eigenvalues();
#endif
    return finish();
}
