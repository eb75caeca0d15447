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

static void every_case(void)
{
    for (const truth *t = cases; t < cases + case_count; t++) {
        real *properties = copied(t->properties, PROPERTIES), *f = copied(t->f, 9), *old = filled(0, STATE);
        real *new = reals(STATE), *stress = reals(6), *modes = reals(24), *speed = reals(1);
        int32_t status = ENTRY(toron_hyperelastic_point)(properties, PROPERTIES, f, NULL, old, new, stress, modes,
                                                         density, speed);
        CHECK(status == TORON_OK, "case %d: %d", t->id, status);
        check_stress(t, stress, 1);
        check_state(t, new, 1);
        check_modes(t, modes, stress);
        double bar = sqrt(t->properties[0] / density);
        CHECK(speed[0] >= bar * (1 - 1e-6) && speed[0] < INFINITY, "case %d: wave speed %g", t->id, speed[0]);
        release();
    }
}

/* The direction as a property or as an argument of another length, old state null or 0, in place: the same bits. */
static void ways_to_ask(void)
{
    const truth *t = &cases[case_count - 1];
    real *properties = copied(t->properties, PROPERTIES), *f = copied(t->f, 9), *state = filled(0, STATE);
    real *new = reals(STATE), *stress = reals(6), *again = reals(6);
    ENTRY(toron_hyperelastic_point)(properties, PROPERTIES, f, NULL, NULL, new, stress, NULL, 0, NULL);
    ENTRY(toron_hyperelastic_point)(properties, PROPERTIES, f, NULL, state, state, again, NULL, 0, NULL);
    CHECK(memcmp(state, new, STATE * sizeof(real)) == 0 && memcmp(stress, again, 6 * sizeof(real)) == 0, "in place");

    real *fibre = copied(t->properties + 8, 3), *other = copied(t->properties, PROPERTIES);
    other[8] = 0, other[9] = 1, other[10] = 0;
    for (int i = 0; i < 3; i++)
        fibre[i] *= 4;
    ENTRY(toron_hyperelastic_point)(other, PROPERTIES, f, fibre, NULL, NULL, again, NULL, 0, NULL);
    CHECK(memcmp(stress, again, 6 * sizeof(real)) == 0, "the fibre as an argument");

    int32_t status = ENTRY(toron_hyperelastic_point)(properties, PROPERTIES, f, NULL, NULL, NULL, NULL, NULL, 0, NULL);
    CHECK(status == TORON_OK, "nothing wanted: %d", status);

    /* A latched point: no stress, the rest as it was. */
    for (int i = 0; i < STATE; i++)
        state[i] = (real)(i + 1);
    state[FAILED] = 1;
    status = ENTRY(toron_hyperelastic_point)(properties, PROPERTIES, f, NULL, state, new, stress, NULL, 0, NULL);
    CHECK(status == TORON_OK && new[FAILED] == 1 && new[ALIVE] == 0, "%d", status);
    CHECK(memcmp(state, new, FAILED * sizeof(real)) == 0, "energies, invariants and index of a failed point");
    for (int c = 0; c < 6; c++)
        CHECK(stress[c] == 0, "stress of a failed point");
    release();
}

/* Every measure of the tangent; stress and state are those of the call without. */
static void tangents(void)
{
    for (const truth *t = cases; t < cases + case_count; t++) {
        real *properties = copied(t->properties, PROPERTIES), *f = copied(t->f, 9), *new = reals(STATE), *plain = reals(STATE);
        real *stress = reals(6), *alone = reals(6), *jaumann = reals(36), *truesdell = reals(36), *material = reals(36);
        real *nominal = reals(81);
        ENTRY(toron_hyperelastic_point)(properties, PROPERTIES, f, NULL, NULL, plain, alone, NULL, 0, NULL);
        int32_t status = ENTRY(toron_hyperelastic_point_tangent)(properties, PROPERTIES, f, NULL, NULL, new, stress,
                                                                 TORON_TANGENT_JAUMANN, jaumann);
        CHECK(status == TORON_OK, "case %d: %d", t->id, status);
        CHECK(memcmp(stress, alone, 6 * sizeof(real)) == 0, "case %d: stress", t->id);
        CHECK(memcmp(new, plain, STATE * sizeof(real)) == 0, "case %d: state", t->id);
        check_tangent(t, jaumann, 1, NULL, 0);
        ENTRY(toron_hyperelastic_point_tangent)(properties, PROPERTIES, f, NULL, NULL, NULL, NULL,
                                                TORON_TANGENT_TRUESDELL, truesdell);
        check_tangent(t, truesdell, 1, stress, 0);
        ENTRY(toron_hyperelastic_point_tangent)(properties, PROPERTIES, f, NULL, NULL, NULL, NULL,
                                                TORON_TANGENT_MATERIAL, material);
        ENTRY(toron_hyperelastic_point_tangent)(properties, PROPERTIES, f, NULL, NULL, NULL, NULL,
                                                TORON_TANGENT_NOMINAL, nominal);
        for (int k = 0; k < 36; k++)
            CHECK(material[k] == material[k % 6 * 6 + k / 6], "case %d: material, entry %d", t->id, k);
        for (int k = 0; k < 81; k++)
            CHECK(nominal[k] == nominal[k % 9 * 9 + k / 9], "case %d: nominal, entry %d", t->id, k);

        /* The latch set before: nothing. */
        new[FAILED] = 1;
        status = ENTRY(toron_hyperelastic_point_tangent)(properties, PROPERTIES, f, NULL, new, NULL, stress,
                                                         TORON_TANGENT_JAUMANN, jaumann);
        for (int k = 0; k < 36; k++)
            CHECK(status == TORON_OK && jaumann[k] == 0 && stress[0] == 0, "case %d: failed", t->id);

        if (sizeof(real) == sizeof(double)) {
            double *values = guarded(PROPERTIES * sizeof(double)), *columns = guarded(9 * sizeof(double));
            double *least = guarded(sizeof(double)), *direction = guarded(3 * sizeof(double));
            memcpy(values, t->properties, PROPERTIES * sizeof(double));
            memcpy(columns, t->f, 9 * sizeof(double));
            status = toron_hyperelastic_least_acoustic_eigenvalue_f64(values, PROPERTIES, columns, NULL, least, direction);
            double square = direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2];
            CHECK(status == TORON_OK && isfinite(*least) && fabs(square - 1) < 1e-12, "case %d: %d", t->id, status);
            CHECK(toron_hyperelastic_least_acoustic_eigenvalue_f64(values, PROPERTIES, NULL, NULL, least, NULL)
                      == TORON_NULL_ARGUMENT, "no F");
        }
        release();
    }
}

static void wrong_tangents(void)
{
    const truth *t = &cases[0];
    real *properties = copied(t->properties, PROPERTIES), *f = copied(t->f, 9), *stress = reals(6), *tangent = reals(81);
    const int32_t measures[2] = {-1, 4};
    for (int i = 0; i < 2; i++) {
        int32_t status = ENTRY(toron_hyperelastic_point_tangent)(properties, PROPERTIES, f, NULL, NULL, NULL, stress,
                                                                 measures[i], tangent);
        CHECK(status == TORON_BAD_ARGUMENT, "%d", status);
    }
    CHECK(ENTRY(toron_hyperelastic_point_tangent)(properties, PROPERTIES, f, NULL, NULL, NULL, stress, 0, NULL)
              == TORON_NULL_ARGUMENT, "no room");
    CHECK(ENTRY(toron_hyperelastic_point_tangent)(properties, PROPERTIES, NULL, NULL, NULL, NULL, stress, 0, tangent)
              == TORON_NULL_ARGUMENT, "no F");
    CHECK(ENTRY(toron_hyperelastic_block_tangent)(properties, PROPERTIES, NULL, 0, tangent) == TORON_NULL_ARGUMENT, "no block");
    toron_block block = {.n = 1, .leading_dimension = 1, .deformation_gradient = f, .stress = stress};
    CHECK(ENTRY(toron_hyperelastic_block_tangent)(properties, PROPERTIES, &block, 4, tangent) == TORON_BAD_ARGUMENT, "measure");
    CHECK(untouched(stress, 6 * sizeof(real)) && untouched(tangent, 81 * sizeof(real)), "nothing is written");

    /* A point at fault has no stiffness; without room for a tangent a block is a block. */
    f[0] = -f[0], f[1] = -f[1], f[2] = -f[2];
    int32_t status = ENTRY(toron_hyperelastic_point_tangent)(properties, PROPERTIES, f, NULL, NULL, NULL, stress,
                                                             TORON_TANGENT_NOMINAL, tangent);
    for (int k = 0; k < 81; k++)
        CHECK(status == TORON_INVERTED && tangent[k] == 0, "%d", status);
    CHECK(ENTRY(toron_hyperelastic_block_tangent)(properties, PROPERTIES, &block, 0, NULL) == TORON_INVERTED, "no tangent");
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
    return (toron_block){.n = a->n, .leading_dimension = a->ld, .deformation_gradient = a->f, .fibre = a->fibre,
                         .energies_old = w, .invariants_old = invariants, .failure_old = failure, .density = density,
                         .stress = a->stress, .energies = w, .invariants = invariants, .failure = failure,
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

static void blocks(void)
{
    for (int first = 0; first < case_count;) {
        int n = run_of_cases(first, 8);
        arrays_of_block a = allocate((size_t)n);
        for (int i = 0; i < n; i++)
            set_point(&a, (size_t)i, &cases[first + i]);
        real *properties = copied(cases[first].properties, PROPERTIES);
        real *tangent = reals(36 * a.ld);
        toron_block block = arguments(&a);
        int32_t status = ENTRY(toron_hyperelastic_block_tangent)(properties, PROPERTIES, &block, TORON_TANGENT_JAUMANN, tangent);
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

/* Points that cannot be evaluated, in the middle of a block: they say so, the others do not notice. */
static void bad_points(void)
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
    toron_block block = arguments(&a);
    int32_t worst = ENTRY(toron_hyperelastic_block)(properties, PROPERTIES, &block);
    const int32_t wanted[N] = {0, TORON_NOT_FINITE, 0, TORON_INVERTED, TORON_FIBRE_DIRECTION, 0, TORON_STATE_NOT_FINITE, 0};
    CHECK(worst == TORON_FIBRE_DIRECTION, "%d", worst);
    for (size_t i = 0; i < N; i++) {
        CHECK(a.status[i] == wanted[i], "point %d: %d", (int)i, a.status[i]);
        CHECK(a.active[i] == (wanted[i] == 0 ? 1 - a.state[FAILED * a.ld + i] : 0), "point %d", (int)i);
        for (size_t c = 0; wanted[i] != 0 && c < 6; c++)
            CHECK(a.stress[c * a.ld + i] == 0, "point %d", (int)i);
        if (wanted[i] == 0)
            check_as_alone(&a, i, t);
    }
    CHECK(a.state[NAN_AT] == 7, "the old energy stays");
    CHECK(a.state[NAN_STATE_AT] == 0, "NaN does not");
    check_gaps(&a);
    release();
}

/* A wrong call: the code, and nothing is written. */
static void refused(const real *properties, size_t count, toron_block block, arrays_of_block a, int32_t wanted)
{
    int32_t status = ENTRY(toron_hyperelastic_block)(properties, count, &block);
    CHECK(status == wanted, "%d, wanted %d", status, wanted);
    CHECK(untouched(a.stress, 6 * a.ld * sizeof(real)), "stress, status %d", wanted);
    CHECK(untouched(a.modes, 24 * a.ld * sizeof(real)), "modes, status %d", wanted);
    CHECK(untouched(a.speed, a.ld * sizeof(real)), "wave speed, status %d", wanted);
    CHECK(untouched(a.status, a.ld * sizeof(int32_t)), "status %d", wanted);
    for (size_t j = 0; j < STATE; j++)
        CHECK(a.state[j * a.ld] == 0, "state, status %d", wanted);
}

static void wrong_calls(void)
{
    const truth *t = &cases[0];
    arrays_of_block a = allocate(2);
    set_point(&a, 0, t);
    set_point(&a, 1, t);
    real *properties = copied(t->properties, PROPERTIES), *wrong = copied(t->properties, PROPERTIES);
    const toron_block good = arguments(&a);
    refused(NULL, PROPERTIES, good, a, TORON_NULL_ARGUMENT);
    refused(properties, PROPERTIES - 1, good, a, TORON_PROPERTY_COUNT);
    refused(properties, 0, good, a, TORON_PROPERTY_COUNT);
    refused(properties, (size_t)-1, good, a, TORON_PROPERTY_COUNT);
    wrong[0] = NAN;
    refused(wrong, PROPERTIES, good, a, TORON_PROPERTY_NOT_FINITE);
    wrong[0] = -1;
    refused(wrong, PROPERTIES, good, a, TORON_PROPERTY_OUT_OF_BOUNDS);
    wrong[0] = 1, wrong[2] = 1;
    refused(wrong, PROPERTIES, good, a, TORON_PROPERTY_OUT_OF_BOUNDS);
    wrong[2] = 2, wrong[8] = wrong[9] = wrong[10] = 0;
    refused(wrong, PROPERTIES, good, a, TORON_PROPERTY_DIRECTION);
    toron_block block = good;
    block.deformation_gradient = NULL;
    refused(properties, PROPERTIES, block, a, TORON_NULL_ARGUMENT);
    block = good, block.leading_dimension = 1;
    refused(properties, PROPERTIES, block, a, TORON_BAD_LEADING_DIMENSION);
    block = (toron_block){.n = 2, .leading_dimension = 1, .deformation_gradient = a.f, .stress = a.stress};
    refused(properties, PROPERTIES, block, a, TORON_BAD_LEADING_DIMENSION);
    block = good, block.density = 0;
    refused(properties, PROPERTIES, block, a, TORON_BAD_ARGUMENT);
    block = good, block.n = 0;
    refused(properties, PROPERTIES, block, a, TORON_OK);
    CHECK(ENTRY(toron_hyperelastic_block)(properties, PROPERTIES, NULL) == TORON_NULL_ARGUMENT, "no block");
    int32_t status
        = ENTRY(toron_hyperelastic_point)(properties, PROPERTIES, NULL, NULL, NULL, NULL, a.stress, NULL, 0, NULL);
    CHECK(status == TORON_NULL_ARGUMENT && untouched(a.stress, sizeof(real)), "no F: %d", status);
    /* Only the deformation gradient is needed. */
    block = (toron_block){.n = 2, .leading_dimension = a.ld, .deformation_gradient = a.f};
    refused(properties, PROPERTIES, block, a, TORON_OK);
    release();
}

int main(int argc, char **argv)
{
    read_cases(argc, argv);
    every_case();
    ways_to_ask();
    tangents();
    wrong_tangents();
    blocks();
    bad_points();
    wrong_calls();
    return finish();
}
