/* Integrates points through the functions that the loader finds: the truth's, and those in the plane. Exceptions trap, every array
 * lies directly before or directly behind a page that must not be touched, and what a behaviour must not read is NaN.
 *
 *     points LIBRARY CASES */
#define _GNU_SOURCE /* feenableexcept, MAP_ANONYMOUS */
#include <fenv.h>
#include <sys/mman.h>
#include <unistd.h>

#include "mgis.h"

/* ---- Arrays between pages. */

enum { MOST_PAGES = 64 };

static struct {
    unsigned char *start;
} pages[MOST_PAGES];
static int page_count;
/* Whether arrays lie behind the first page instead of before the last one. */
static int behind;

/* Room for so many numbers next to a page that must not be touched; all NaN. The room is used again after `new_point`. */
static double *numbers_at_a_page(size_t count)
{
    size_t page = (size_t)sysconf(_SC_PAGESIZE);
    if (page_count == MOST_PAGES)
        exit(2);
    unsigned char **start = &pages[page_count++].start;
    if (*start == NULL) {
        *start = mmap(NULL, 3 * page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (*start == MAP_FAILED || mprotect(*start + page, page, PROT_READ | PROT_WRITE) != 0) {
            fputs("no pages\n", stderr);
            exit(2);
        }
    }
    memset(*start + page, 0xff, page); /* NaN */
    return (double *)(void *)(*start + (behind ? page : 2 * page - count * sizeof(double)));
}

static double *these(const double *values, size_t count)
{
    double *array = numbers_at_a_page(count);
    memcpy(array, values, count * sizeof(double));
    return array;
}

static void new_point(void)
{
    page_count = 0;
}

/* Whether bytes are still those that nobody has written. */
static int unwritten(const double *values, size_t count)
{
    for (size_t i = 0; i < count * sizeof(double); i++)
        if (((const unsigned char *)values)[i] != 0xff)
            return 0;
    return 1;
}

/* ---- A call. */

enum { CAUCHY, PK2, PK1, DSIG_DF = 0, DPK2_DE, DPK1_DF, DTAU_DDF, NO_OPERATOR = 0, CONSISTENT = 4, WITH_SPEED = 100 };

static char told_text[512];

/* The numbers of components of F and of a symmetric tensor, and of an operator's entries. */
static size_t of_tensor(int plane)
{
    return plane ? 5 : 9;
}

static size_t of_stress(int plane, int measure)
{
    return measure == PK1 ? of_tensor(plane) : plane ? 4 : 6;
}

static size_t of_operator(int plane, int kind)
{
    size_t t = of_tensor(plane), s = plane ? 4 : 6;
    return kind == DPK2_DE ? s * s : kind == DPK1_DF ? t * t : s * t;
}

/* The data of a call, from F at both ends of the step in MFront's order. What need not be given is NaN, or null. */
static data_view call_of(const behaviour *b, const double *properties, const double *f0, const double *f1, const double *state,
                         int plane, int request, int measure, int kind)
{
    const double asked[3] = {request, measure, kind};
    size_t t = of_tensor(plane), operates = request % WITH_SPEED != NO_OPERATOR;
    new_point();
    memset(told_text, PATTERN, sizeof told_text);
    data_view v = {.error_message = told_text, .dt = NAN, .rdt = numbers_at_a_page(1), .speed_of_sound = numbers_at_a_page(1)};
    /* Without an operator K has just three numbers. */
    v.K = numbers_at_a_page(operates ? of_operator(plane, kind) : 3);
    memcpy(v.K, asked, (operates ? 3 : 2) * sizeof *asked);
    *v.rdt = 1;
    state_view old = {.gradients = f0 == NULL ? numbers_at_a_page(t) : these(f0, t), .thermodynamic_forces = numbers_at_a_page(9),
                      .mass_density = numbers_at_a_page(1), .material_properties = numbers_at_a_page((size_t)b->properties.count),
                      .internal_state_variables = these(state, (size_t)b->state.count), .stored_energy = numbers_at_a_page(1),
                      .dissipated_energy = numbers_at_a_page(1), .external_state_variables = numbers_at_a_page(1)};
    const double density = 2;
    v.s0 = old;
    v.s1 = (state_view){.gradients = these(f1, t), .thermodynamic_forces = numbers_at_a_page(of_stress(plane, measure)),
                        .mass_density = request < 50 ? numbers_at_a_page(1) : these(&density, 1),
                        .material_properties = these(properties, (size_t)b->properties.count),
                        .internal_state_variables = numbers_at_a_page((size_t)b->state.count),
                        .stored_energy = numbers_at_a_page(1), .dissipated_energy = numbers_at_a_page(1),
                        .external_state_variables = numbers_at_a_page(1)};
    return v;
}

/* Calls with exceptions trapped. */
static int called(const behaviour *b, data_view *v)
{
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
    int result = b->integrate(v);
    fedisableexcept(FE_ALL_EXCEPT);
    CHECK(b->dissipates_energy || unwritten(v->s1.dissipated_energy, 1), "%s: a dissipated energy", b->name);
    return result;
}

static const double rest[9] = {1, 1, 1};
static const double fresh[MOST_NAMES] = {0};

/* F by columns in MFront's order. */
static void mfront_order(const double *columns, double *f)
{
    static const int place[9] = {0, 4, 8, 3, 1, 6, 2, 7, 5};
    for (int i = 0; i < 9; i++)
        f[i] = columns[place[i]];
}

/* ---- Conversions, in the plainest way: matrices [row][column]. */

static const int rows_of[9] = {0, 1, 2, 0, 1, 0, 2, 1, 2}, columns_of[9] = {0, 1, 2, 1, 0, 2, 0, 2, 1};

static void full_tensor(const double *f, double to[3][3])
{
    for (int i = 0; i < 9; i++)
        to[rows_of[i]][columns_of[i]] = f[i];
}

static void full_stress(const double *s, double to[3][3])
{
    static const int a[6] = {0, 1, 2, 0, 0, 1}, b[6] = {0, 1, 2, 1, 2, 2};
    for (int i = 0; i < 6; i++)
        to[a[i]][b[i]] = to[b[i]][a[i]] = i < 3 ? s[i] : s[i] / sqrt(2);
}

static void multiply(double a[3][3], double b[3][3], int transposed, double to[3][3])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            to[i][j] = 0;
            for (int k = 0; k < 3; k++)
                to[i][j] += a[i][k] * (transposed ? b[j][k] : b[k][j]);
        }
}

static double size_of(double a[3][3])
{
    double square = 0;
    for (int i = 0; i < 9; i++)
        square += a[i / 3][i % 3] * a[i / 3][i % 3];
    return sqrt(square);
}

/* τ = Jσ = PFᵀ = FSFᵀ: P and S against σ, with what rounding in the products may do to them. */
static void check_measures(const truth *t, const double *f, double *const stress[3])
{
    double F[3][3], sigma[3][3], other[3][3], product[3][3], tau[3][3];
    full_tensor(f, F);
    full_stress(stress[CAUCHY], sigma);
    double jacobian = determinant(t->f), norm_f = size_of(F), bound;
    full_tensor(stress[PK1], other);
    multiply(other, F, 1, tau);
    bound = 1e-14 * size_of(other) * norm_f + 1e-14 * jacobian * (size_of(sigma) + t->stress_scale);
    for (int i = 0; i < 9; i++)
        CHECK(fabs(tau[i / 3][i % 3] - jacobian * sigma[i / 3][i % 3]) <= bound, "case %d: PK1", t->id);
    full_stress(stress[PK2], other);
    multiply(F, other, 0, product);
    multiply(product, F, 1, tau);
    bound = 1e-14 * size_of(other) * norm_f * norm_f + 1e-14 * jacobian * (size_of(sigma) + t->stress_scale);
    for (int i = 0; i < 9; i++)
        CHECK(fabs(tau[i / 3][i % 3] - jacobian * sigma[i / 3][i % 3]) <= bound, "case %d: PK2", t->id);
}

/* ---- The truth, in three dimensions, in every measure, with every operator. */

static void truth_point(const behaviour *b, const truth *t)
{
    double f[9], of_measure[3][9], *stress[3] = {of_measure[0], of_measure[1], of_measure[2]}, state[STATE];
    mfront_order(t->f, f);
    for (int measure = CAUCHY; measure <= PK1; measure++) {
        data_view v = call_of(b, t->properties, NULL, f, fresh, 0, NO_OPERATOR, measure, 0);
        CHECK(called(b, &v) == 1, "case %d: %.200s", t->id, told_text);
        CHECK(*v.rdt == 1 && unwritten(v.speed_of_sound, 1) && told_text[0] == (char)PATTERN, "case %d", t->id);
        CHECK(v.K[0] == NO_OPERATOR && v.K[1] == measure && unwritten(v.K + 2, 1), "case %d: K is written", t->id);
        memcpy(stress[measure], v.s1.thermodynamic_forces, of_stress(0, measure) * sizeof(double));
        double *s1 = v.s1.internal_state_variables, energy = ((s1[0] + s1[1]) + s1[2]) + s1[3];
        check_state(t, s1, 1);
        CHECK(*v.s1.stored_energy == energy, "case %d: %g", t->id, *v.s1.stored_energy);
        memcpy(state, s1, sizeof state);
    }
    const double *s = stress[CAUCHY], in_order[6] = {s[0], s[1], s[2], s[3] / sqrt(2), s[5] / sqrt(2), s[4] / sqrt(2)};
    check_stress(t, in_order, 1);
    check_measures(t, f, stress);
    for (int kind = DSIG_DF; kind <= DTAU_DDF; kind++)
        for (int request = 1; request <= CONSISTENT + WITH_SPEED; request += request == CONSISTENT ? WITH_SPEED - 3 : 1) {
            data_view v = call_of(b, t->properties, kind == DTAU_DDF ? rest : NULL, f, fresh, 0, request, kind % 3, kind);
            CHECK(called(b, &v) == 1, "case %d, operator %d: %.200s", t->id, kind, told_text);
            const double *found = v.s1.internal_state_variables;
            for (int i = 0; i < STATE; i++)
                CHECK(fabs(found[i] - state[i]) <= 1e-12 * fabs(state[i]) + 1e-300, "case %d: variable %d", t->id, i);
            for (size_t i = 0; i < of_operator(0, kind); i++)
                CHECK(isfinite(v.K[i]), "case %d, operator %d", t->id, kind);
            CHECK((request < 50) == unwritten(v.speed_of_sound, 1), "case %d", t->id);
            CHECK(request < 50 || *v.speed_of_sound >= 0.999999 * sqrt(t->properties[0] / 2), "case %d", t->id);
        }
}

/* ---- In the plane: the same numbers as in three dimensions, where the others are 0. */

static void check_plane(const behaviour *space, const behaviour *plane, const double *properties)
{
    static const int kept_of_tensor[5] = {0, 1, 2, 3, 4};
    const double f0[9] = {1.01, 0.99, 1.02, 0.01, -0.02}, f1[9] = {1.02, 0.95, 0.98, 0.03, -0.05};
    for (int measure = CAUCHY; measure <= PK1; measure++)
        for (int kind = DSIG_DF; kind <= DTAU_DDF; kind++)
            for (int request = -3; request <= CONSISTENT; request++) {
                data_view v = call_of(space, properties, f0, f1, fresh, 0, request, measure, kind);
                double stress[9], entries[81], state[MOST_NAMES];
                CHECK(called(space, &v) == 1, "%s: %.200s", space->name, told_text);
                size_t across = kind == DPK2_DE ? 6 : 9, width = kind == DPK2_DE ? 4 : 5, in_space = of_operator(0, kind);
                memcpy(stress, v.s1.thermodynamic_forces, of_stress(0, measure) * sizeof(double));
                memcpy(state, v.s1.internal_state_variables, (size_t)space->state.count * sizeof(double));
                if (request != NO_OPERATOR)
                    memcpy(entries, v.K, in_space * sizeof(double));
                v = call_of(plane, properties, f0, f1, fresh, 1, request, measure, kind);
                CHECK(called(plane, &v) == 1, "%s: %.200s", plane->name, told_text);
                CHECK(memcmp(state, v.s1.internal_state_variables, (size_t)space->state.count * sizeof(double)) == 0, "state");
                for (size_t i = 0; i < of_stress(1, measure) && request >= NO_OPERATOR; i++)
                    CHECK(v.s1.thermodynamic_forces[i] == stress[kept_of_tensor[i]], "%s: stress %d", plane->name, (int)i);
                for (size_t i = of_stress(1, measure); i < of_stress(0, measure) && request >= NO_OPERATOR; i++)
                    CHECK(stress[i] == 0, "%s: stress %d out of the plane", plane->name, (int)i);
                if (request < NO_OPERATOR)
                    CHECK(unwritten(v.s1.thermodynamic_forces, of_stress(1, measure)), "%s: a stress", plane->name);
                for (size_t i = 0; i < of_operator(1, kind) && request != NO_OPERATOR; i++)
                    CHECK(v.K[i] == entries[i / width * across + i % width], "%s: operator %d, %d", plane->name, kind, (int)i);
            }
}

/* ---- What is refused: −1, a text that ends in time, and nothing written. */

static void refused(const behaviour *b, data_view *v, int plane, double rdt, const char *words)
{
    CHECK(called(b, v) == -1, "%s: %s", b->name, words);
    const char *end = memchr(told_text, '\0', sizeof told_text);
    CHECK(end != NULL && strstr(told_text, words) != NULL, "%.300s", told_text);
    CHECK(unwritten(v->s1.thermodynamic_forces, plane ? 4 : 6), "%s: a stress", words);
    CHECK(unwritten(v->s1.internal_state_variables, (size_t)b->state.count), "%s: a state", words);
    CHECK(unwritten(v->s1.stored_energy, 1) && unwritten(v->speed_of_sound, 1), "%s: an energy or a speed", words);
    CHECK(*v->rdt == rdt, "%s: rdt is %g", words, *v->rdt);
    /* Without room for a message there is none. */
    v->error_message = NULL;
    CHECK(called(b, v) == -1, "%s: %s", b->name, words);
}

static void check_refusals(const behaviour *b, const behaviour *plane, const double *good, int first_of_fibre)
{
    const double inverted[9] = {-1, 1, 1}, not_finite[9] = {NAN, 1, 1};
    double bad[MOST_NAMES], failed_state[MOST_NAMES] = {0};
    const size_t count = (size_t)b->properties.count * sizeof(double);
    data_view v = call_of(b, good, rest, inverted, fresh, 0, CONSISTENT, CAUCHY, DSIG_DF);
    refused(b, &v, 0, 0.25, "determinant <= 0");
    v = call_of(b, good, rest, not_finite, fresh, 0, NO_OPERATOR, CAUCHY, 0);
    refused(b, &v, 0, 0.25, "NaN or infinite");
    failed_state[b->state.count - 2] = NAN; /* the latch */
    v = call_of(b, good, rest, rest, failed_state, 0, NO_OPERATOR, CAUCHY, 0);
    refused(b, &v, 0, 0.25, "state variable is NaN");
    memcpy(bad, good, count);
    bad[0] = -1;
    v = call_of(b, bad, rest, rest, fresh, 0, NO_OPERATOR, CAUCHY, 0);
    refused(b, &v, 0, 1, "is -1.0; allowed: a number from 0 to 1e25");
    v = call_of(plane, bad, rest, rest, fresh, 1, NO_OPERATOR, CAUCHY, 0);
    refused(plane, &v, 1, 1, "is -1.0; allowed: a number from 0 to 1e25");
    memcpy(bad, good, count);
    bad[first_of_fibre + 2] = 0.5;
    v = call_of(plane, bad, rest, rest, fresh, 1, NO_OPERATOR, CAUCHY, 0);
    refused(plane, &v, 1, 1, "(fibre direction) are 1.0, 0.0, 0.5; allowed: a direction in the plane (third component 0) or normal");
    v = call_of(b, good, rest, rest, fresh, 0, CONSISTENT, 3, DSIG_DF);
    refused(b, &v, 0, 1, "argument K[1] is 3.0; allowed: 0 (Cauchy), 1 (PK2) or 2 (PK1)");
    v = call_of(b, good, rest, rest, fresh, 0, CONSISTENT, CAUCHY, 4);
    refused(b, &v, 0, 1, "argument K[2] is 4.0; allowed: 0 (dsig/dF), 1 (dPK2/dE), 2 (dPK1/dF) or 3 (dtau/ddF)");
    v = call_of(b, good, rest, rest, fresh, 0, CONSISTENT, CAUCHY, DSIG_DF);
    v.K[0] = 7;
    refused(b, &v, 0, 1, "argument K[0] is 7.0; allowed: -3 to 4, or 100 more for the speed of sound");
    v = call_of(b, good, rest, rest, fresh, 0, NO_OPERATOR + WITH_SPEED, CAUCHY, 0);
    v.s1.mass_density = NULL;
    refused(b, &v, 0, 1, "argument mass_density is null");
    v = call_of(b, good, rest, rest, fresh, 0, NO_OPERATOR + WITH_SPEED, CAUCHY, 0);
    v.s1.mass_density = these(fresh, 1);
    refused(b, &v, 0, 1, "argument mass_density is 0.0; allowed: a finite number > 0");
    v = call_of(b, good, rest, rest, fresh, 0, NO_OPERATOR, CAUCHY, 0);
    v.s1.material_properties = NULL;
    refused(b, &v, 0, 1, "argument s1.material_properties is null");
    CHECK(b->integrate(NULL) == -1, "%s: no data at all", b->name);
    /* A state that is replaced in place; no room for the energy, no factor of the time step. */
    const double pulled[9] = {1.02, 0.97, 0.99};
    v = call_of(b, good, rest, pulled, fresh, 0, NO_OPERATOR, CAUCHY, 0);
    CHECK(called(b, &v) == 1, "%.200s", told_text);
    data_view in_place = call_of(b, good, rest, pulled, fresh, 0, NO_OPERATOR, CAUCHY, 0);
    double *state = in_place.s0.internal_state_variables, wanted[MOST_NAMES];
    in_place.s1.internal_state_variables = state;
    in_place.s1.stored_energy = in_place.s0.stored_energy = NULL;
    in_place.rdt = NULL;
    CHECK(called(b, &in_place) == 1, "%.200s", told_text);
    memcpy(wanted, state, (size_t)b->state.count * sizeof(double));
    v = call_of(b, good, rest, pulled, fresh, 0, NO_OPERATOR, CAUCHY, 0);
    called(b, &v);
    CHECK(memcmp(wanted, v.s1.internal_state_variables, (size_t)b->state.count * sizeof(double)) == 0, "%s: in place", b->name);
}

/* ---- Failure: the call that detects it carries, later ones do not, and the energies stay. */

static void check_failure(const behaviour *b, const double *properties)
{
    const double pulled[9] = {1.06, 1, 1}, nowhere[9] = {NAN, NAN, NAN, NAN};
    const int failed = b->state.count - 2, alive = b->state.count - 1;
    double state[MOST_NAMES];
    data_view v = call_of(b, properties, rest, pulled, fresh, 0, CONSISTENT, CAUCHY, DSIG_DF);
    CHECK(called(b, &v) == 1 && v.s1.thermodynamic_forces[0] > 1 && v.K[0] > 1, "%s: %.200s", b->name, told_text);
    CHECK(v.s1.internal_state_variables[failed] == 1 && v.s1.internal_state_variables[alive] == 0, "%s fails", b->name);
    const double energy = *v.s1.stored_energy;
    memcpy(state, v.s1.internal_state_variables, (size_t)b->state.count * sizeof(double));
    for (int measure = CAUCHY; measure <= PK1; measure++)
        for (int kind = DSIG_DF; kind <= DTAU_DDF; kind++)
            for (int finite = 0; finite <= 1; finite++) {
                const double *f = finite ? pulled : nowhere;
                v = call_of(b, properties, f, f, state, 0, CONSISTENT, measure, kind);
                CHECK(called(b, &v) == 1, "%s: %.200s", b->name, told_text);
                for (size_t i = 0; i < of_stress(0, measure); i++)
                    CHECK(v.s1.thermodynamic_forces[i] == 0, "%s: stress %d", b->name, (int)i);
                for (size_t i = 0; i < of_operator(0, kind); i++)
                    CHECK(v.K[i] == 0, "%s: operator %d, %d", b->name, kind, (int)i);
                CHECK(*v.s1.stored_energy == energy, "%s: %g", b->name, *v.s1.stored_energy);
                CHECK(v.s1.internal_state_variables[failed] == 1, "%s stays failed", b->name);
            }
    v = call_of(b, properties, rest, rest, fresh, 0, NO_OPERATOR, CAUCHY, 0);
    CHECK(called(b, &v) == 1 && v.s1.internal_state_variables[alive] == 1, "%s is alive at first", b->name);
}

int main(int argc, char **argv)
{
    enum { DIRECTIONS = 3 };
    /* Along the first axis, in the plane, and normal to it. */
    const double fibres[DIRECTIONS][3] = {{1, 0, 0}, {0.6, -0.3, 0}, {0, 0, 2}};
    if (argc < 3)
        return 2;
    open_library(argv[1]);
    read_cases(argc - 1, argv + 1);
    double yarn[PROPERTIES] = {82.341, 1.055, 2.2, 0.64974, 0.1, 0.0458, 1.8}, linear[MOST_NAMES] = {79.414, 0.794, 0.126, 3.637};
    double sliding[MOST_NAMES] = {82.341, 1.055, 2.2, 0.64974, 0.1, 0.0458, 1.8, [11] = 0.25, 1e-3};
    double *const properties[BEHAVIOURS] = {yarn, linear, sliding};
    const int first_of_fibre[BEHAVIOURS] = {8, 4, 8};
    for (behind = 0; behind <= 1; behind++)
        for (int law = 0; law < BEHAVIOURS; law++) {
            behaviour space = load(behaviours[law], hypotheses[0]);
            for (int i = 0; i < case_count && law == 0; i++)
                truth_point(&space, &cases[i]);
            for (int h = 1; h < HYPOTHESES; h++) {
                behaviour plane = load(behaviours[law], hypotheses[h]);
                for (int k = DIRECTIONS - 1; k >= 0; k--) {
                    memcpy(properties[law] + first_of_fibre[law], fibres[k], sizeof fibres[k]);
                    check_plane(&space, &plane, properties[law]);
                }
                check_refusals(&space, &plane, properties[law], first_of_fibre[law]);
            }
            check_failure(&space, properties[law]);
        }
    return finish();
}
