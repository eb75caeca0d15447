/* The linear elastic law: axes, steps, tangents and increments, failure, directions of a point's own, and what is refused. */
#include "check.h"

enum { N = TORON_LINEAR_ELASTIC_PROPERTIES, M = TORON_LINEAR_ELASTIC_STATE, WORK = 7, FAILED_AT = 8, ALIVE_AT = 9 };

#ifdef SINGLE
#define EPSILON 0x1p-24
#else
#define EPSILON 0x1p-53
#endif
/* What a few roundings may do. */
#define ROUNDINGS (90 * EPSILON)

#define PREPARE ENTRY(toron_linear_elastic_prepare)
#define AXES ENTRY(toron_linear_elastic_axes)
#define POINT ENTRY(toron_linear_elastic_point)
#define POINT_WITH ENTRY(toron_linear_elastic_point_with_properties)
#define BLOCK ENTRY(toron_linear_elastic_block)
#define BLOCK_WITH ENTRY(toron_linear_elastic_block_with_properties)
#define INCREMENT ENTRY(toron_linear_elastic_increment)

static const double e_1 = 79.414, limit = 3.637;
static const double at_rest[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

static real *yarn(void)
{
    real *properties = reals(N);
    ENTRY(toron_preset)("kevlar-km2-600-linear", "mm-kg-ms", properties, N, NULL, NULL, 0);
    return properties;
}

static toron_linear_elastic *law_of(const real *properties)
{
    toron_linear_elastic *law = guarded(sizeof *law);
    CHECK(TOLD(PREPARE, law, sizeof *law, properties, N) == TORON_OK, "%s", text);
    return law;
}

/* The initial axes of a law. */
static real *axes_of(const toron_linear_elastic *law)
{
    real *axes = reals(9);
    CHECK(TOLD(AXES, law, NULL, NULL, axes) == TORON_OK, "%s", text);
    return axes;
}

/* The two ways to call the law, which give the same bits: prepared, or with its properties. */
static int32_t evaluate_point(int with_properties, const real *properties, const toron_linear_point *point)
{
    return with_properties ? TOLD(POINT_WITH, properties, N, point) : TOLD(POINT, law_of(properties), point);
}

static int32_t evaluate_block(int with_properties, const real *properties, const toron_linear_block *block)
{
    return with_properties ? TOLD(BLOCK_WITH, properties, N, block) : TOLD(BLOCK, law_of(properties), block);
}

static void axes(void)
{
    real *properties = yarn(), *a = reals(9);
    properties[4] = 0, properties[5] = 0, properties[6] = 5; /* the fibre, any length */
    properties[7] = 3;                                       /* the second axis */
    const toron_linear_elastic *law = law_of(properties), *other = law_of(yarn());
    const double wanted[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0}, none[3] = {0};
    real *fibre = copied(wanted, 3), *second = copied(wanted + 3, 3), *zero = copied(none, 3);
    CHECK(TOLD(AXES, law, NULL, NULL, a) == TORON_OK, "%s", text);
    for (int i = 0; i < 9; i++)
        CHECK(fabs(a[i] - wanted[i]) <= 9 * EPSILON, "axes[%d] = %g", i, a[i]);
    CHECK(TOLD(AXES, other, fibre, second, a) == TORON_OK, "%s", text);
    for (int i = 0; i < 9; i++)
        CHECK(fabs(a[i] - wanted[i]) <= 9 * EPSILON, "axes[%d] = %g", i, a[i]);
    /* Any second axis that is across the fibre. */
    CHECK(TOLD(AXES, other, fibre, zero, a) == TORON_OK, "%s", text);
    CHECK(a[2] == 1 && fabs((double)a[3] * a[0] + a[4] * a[1] + a[5] * a[2]) <= 9 * EPSILON, "%g %g %g", a[3], a[4], a[5]);
    CHECK(TOLD(AXES, other, NULL, zero, a) == TORON_OK && a[0] == 1, "the second axis alone is not read");

    real *untouched_axes = reals(9);
    REFUSED(TORON_NULL_ARGUMENT, "argument axes is null", AXES, law, NULL, NULL, NULL);
    REFUSED(TORON_NULL_ARGUMENT, "argument law is null", AXES, NULL, fibre, second, untouched_axes);
    const toron_linear_elastic not_prepared = {0};
    REFUSED(TORON_NOT_PREPARED, NOT_PREPARED_BY(toron_linear_elastic_prepare), AXES, &not_prepared, fibre, second, untouched_axes);
    REFUSED(TORON_FIBRE_DIRECTION, NO_FIBRE_TEXT, AXES, law, zero, second, untouched_axes);
    CHECK(TOLD(AXES, law, fibre, fibre, untouched_axes) == TORON_FIBRE_DIRECTION, "the second axis along the fibre: %s", text);
    CHECK(untouched(untouched_axes, 9 * sizeof(real)), "nothing is written");
    release();
}

/* The tangent of an infinitesimal step from rest is C, in every frame. */
static void tangent_at_rest(void)
{
    const double wanted[6] = {79.414, 0.794, 0.794, 0.126, 0.126, 0.126}, allowed = 1000 * EPSILON;
    for (int32_t rotation = 0; rotation < 3; rotation++) {
        real *properties = yarn(), *f = copied(at_rest, 9), *c = reals(36), *nominal = reals(81);
        toron_linear_point point = {.size = sizeof point, .rotation = rotation, .f_old = f, .f_new = f,
                                    .axes = axes_of(law_of(properties)), .stress = reals(6), .tangent = c};
        for (point.measure = TORON_TANGENT_MATERIAL; point.measure <= TORON_TANGENT_JAUMANN; point.measure++) {
            CHECK(evaluate_point(0, properties, &point) == TORON_OK, "%s", text);
            for (int i = 0; i < 36; i++)
                CHECK(fabs(c[i] - (i % 7 == 0 ? wanted[i / 7] : 0)) <= allowed, "measure %d: c[%d] = %g", point.measure, i, c[i]);
        }
        point.measure = TORON_TANGENT_NOMINAL, point.tangent = nominal, point.stress = NULL;
        CHECK(evaluate_point(0, properties, &point) == TORON_OK, "%s", text);
        CHECK(fabs(nominal[0] - wanted[0]) <= allowed && fabs(nominal[40] - wanted[1]) <= allowed, "frame %d", rotation);
        release();
    }
}

/* ---- Tangents against differences of the stress. Matrices by rows here. */

typedef struct {
    double at[3][3];
} matrix;

static matrix multiplied(matrix a, matrix b)
{
    matrix c = {{{0}}};
    for (int i = 0; i < 9; i++)
        for (int k = 0; k < 3; k++)
            c.at[i / 3][i % 3] += a.at[i / 3][k] * b.at[k][i % 3];
    return c;
}

static matrix transposed(matrix a)
{
    matrix b;
    for (int i = 0; i < 9; i++)
        b.at[i / 3][i % 3] = a.at[i % 3][i / 3];
    return b;
}

/* a + factor b */
static matrix sum(matrix a, double factor, matrix b)
{
    for (int i = 0; i < 9; i++)
        a.at[i / 3][i % 3] += factor * b.at[i / 3][i % 3];
    return a;
}

static double volume(matrix f)
{
    return determinant(&f.at[0][0]);
}

static matrix inverse(matrix f)
{
    matrix g;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            g.at[j][i] = (f.at[(i + 1) % 3][(j + 1) % 3] * f.at[(i + 2) % 3][(j + 2) % 3]
                          - f.at[(i + 1) % 3][(j + 2) % 3] * f.at[(i + 2) % 3][(j + 1) % 3]) / volume(f);
    return g;
}

/* J σ at the end of a step to this F; with a tangent, so that it is computed in double precision. */
static matrix kirchhoff(const real *properties, int32_t rotation, const real *f_old, matrix f)
{
    static const int component[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    real columns[9], stress[6], axes[9], c[36];
    toron_linear_elastic law;
    PREPARE(&law, sizeof law, properties, N, NULL, 0);
    AXES(&law, NULL, NULL, axes, NULL, 0);
    for (int i = 0; i < 9; i++)
        columns[i] = (real)f.at[i % 3][i / 3];
    toron_linear_point point = {.size = sizeof point, .rotation = rotation, .f_old = f_old, .f_new = columns, .axes = axes,
                                .stress = stress, .tangent = c};
    CHECK(TOLD(POINT, &law, &point) == TORON_OK, "%s", text);
    matrix tau;
    for (int i = 0; i < 9; i++)
        tau.at[i / 3][i % 3] = volume(f) * stress[component[i / 3][i % 3]];
    return tau;
}

/* The stress whose change a tangent of this measure gives: S, P, or else τ = Jσ. */
static matrix stress_measure(int32_t measure, matrix tau, matrix f)
{
    matrix g = inverse(f);
    if (measure == TORON_TANGENT_MATERIAL)
        return multiplied(multiplied(g, tau), transposed(g));
    return measure == TORON_TANGENT_NOMINAL ? multiplied(tau, transposed(g)) : tau;
}

/* Central differences, for a change d of F itself (nominal), of E (material), or for a rate of deformation d. Rows and columns of the
 * 6 x 6 measures are 11 22 33 12 23 31. The Truesdell rate is the Jaumann rate of τ over J less dσ + σd. */
static void tangent_by_differences(int32_t rotation, int32_t measure)
{
    const double h = sizeof(real) == sizeof(float) ? 0x1p-7 : 1e-5, allowed = sizeof(real) == sizeof(float) ? 1e-3 : 1e-6;
    static const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
    const double start[9] = {1.001, 0.02, 0, 0.01, 0.98, 0.01, 0, 0.03, 1.02};
    const matrix f = {{{1.02, 0.1, -0.05}, {0.03, 0.95, 0.08}, {0.02, -0.04, 1.05}}};
    const int size = measure == TORON_TANGENT_NOMINAL ? 9 : 6;
    real *properties = yarn(), *f_old = copied(start, 9), *f_new = reals(9), *c = reals((size_t)(size * size));
    properties[4] = (real)0.9, properties[5] = (real)0.3, properties[6] = (real)-0.2, properties[8] = 1;
    for (int i = 0; i < 9; i++)
        f_new[i] = (real)f.at[i % 3][i / 3];
    toron_linear_point point = {.size = sizeof point, .rotation = rotation, .measure = measure, .f_old = f_old, .f_new = f_new,
                                .axes = axes_of(law_of(properties)), .tangent = c};
    CHECK(evaluate_point(0, properties, &point) == TORON_OK, "%s", text);
    const matrix tau = kirchhoff(properties, rotation, f_old, f);
    double square = 0, squares = 0;
    for (int k = 0; k < size; k++) {
        matrix d = {{{0}}}, change;
        if (size == 9) {
            d.at[k % 3][k / 3] = 1, change = d;
        } else {
            d.at[row[k]][column[k]] += 0.5, d.at[column[k]][row[k]] += 0.5;
            matrix g = inverse(f);
            change = measure == TORON_TANGENT_MATERIAL ? multiplied(transposed(g), d) : multiplied(d, f);
        }
        matrix ahead = sum(f, h, change), back = sum(f, -h, change);
        matrix rate = stress_measure(measure, kirchhoff(properties, rotation, f_old, ahead), ahead);
        rate = sum(rate, -1, stress_measure(measure, kirchhoff(properties, rotation, f_old, back), back));
        for (int i = 0; i < size; i++) {
            const int a = size == 9 ? i % 3 : row[i], b = size == 9 ? i / 3 : column[i];
            double wanted = rate.at[a][b] / (2 * h);
            if (measure == TORON_TANGENT_TRUESDELL)
                wanted -= multiplied(d, tau).at[a][b] + multiplied(tau, d).at[a][b];
            if (measure == TORON_TANGENT_TRUESDELL || measure == TORON_TANGENT_JAUMANN)
                wanted /= volume(f);
            square += (c[size * i + k] - wanted) * (c[size * i + k] - wanted);
            squares += wanted * wanted;
        }
    }
    CHECK(sqrt(square) <= allowed * sqrt(squares), "frame %d, measure %d: %g of %g", rotation, measure, sqrt(square),
          sqrt(squares));
    release();
}

/* F = diag(λ, 1, 1) in equal steps: σ11 = E1 ln λ in any frame, and failure at ln λ = σ_lim/E1. */
static void pull(int32_t rotation)
{
    enum { STEPS = 10 };
    real *properties = yarn(), *state = filled(0, M), *stress = reals(6), *f_old = copied(at_rest, 9), *f_new = copied(at_rest, 9);
    const toron_linear_elastic *law = law_of(properties);
    toron_linear_point point = {.size = sizeof point, .rotation = rotation, .criterion = TORON_CRITERION_PRINCIPAL, .density = 1.44,
                                .f_old = f_old, .f_new = f_new, .axes = axes_of(law), .state_old = state, .state_new = state,
                                .stress = stress, .wave_speed = reals(1)};
    const double strain_at_failure = limit / e_1, bar = sqrt(e_1 / point.density);
    for (int step = 1; step <= STEPS; step++) {
        f_old[0] = f_new[0];
        f_new[0] = (real)exp(1.05 * strain_at_failure * step / STEPS); /* past the limit in the last step only */
        CHECK(TOLD(POINT, law, &point) == TORON_OK, "%s", text);
        double wanted = e_1 * log((double)f_new[0]);
        CHECK(fabs(stress[0] - wanted) <= ROUNDINGS * e_1, "frame %d, step %d: %.17g, wanted %.17g", rotation, step, stress[0],
              wanted);
        CHECK(state[FAILED_AT] == (wanted >= limit) && state[ALIVE_AT] == 1 - state[FAILED_AT], "step %d", step);
        CHECK(*point.wave_speed >= bar * (1 - 1e-6) && *point.wave_speed < INFINITY, "wave speed %g", *point.wave_speed);
    }
    CHECK(state[FAILED_AT] == 1 && state[WORK] > 0, "failed in the end");
    point.f_old = f_new;
    TOLD(POINT, law, &point);
    CHECK(stress[0] == 0 && state[0] == 0 && state[FAILED_AT] == 1, "and stays failed, without stress");
    release();
}

/* A plain increment: engineering shears are twice the tensor's, the work is weighed by J. */
static void increment(void)
{
    const toron_linear_elastic *law = law_of(yarn());
    real *state = reals(M), *stress = reals(6), *again = reals(6);
    const double values[6] = {1e-3, 2e-3, -1e-3, 5e-4, 0, -5e-4};
    real *strain = copied(values, 6);
    const double wanted[6] = {79.414e-3, 0.794 * 2e-3, -0.794e-3, 0.126e-3, 0, -0.126e-3};
    toron_linear_increment in = {.size = sizeof in, .jacobian = 2, .strain = strain, .state_new = state, .stress = stress};
    CHECK(TOLD(INCREMENT, law, &in) == TORON_OK, "%s", text);
    double work = 0;
    for (int i = 0; i < 6; i++) {
        CHECK(fabs(stress[i] - wanted[i]) <= 9 * EPSILON * e_1, "stress %d is %.17g", i, stress[i]);
        CHECK(state[i] == stress[i], "the state holds the stress");
        work += 0.5 * wanted[i] * values[i] * (i < 3 ? 1 : 2);
    }
    CHECK(fabs(state[WORK] - 2 * work) <= ROUNDINGS * work, "work %g, wanted %g", state[WORK], 2 * work);
    in.jacobian = 0;
    CHECK(TOLD(INCREMENT, law, &in) == TORON_OK && fabs(state[WORK] - work) <= ROUNDINGS * work, "J not known: %g", state[WORK]);
    /* In place, and the stress alone. */
    const toron_linear_increment alone = {.size = sizeof alone, .strain = strain, .state_old = state, .stress = again};
    in.state_old = state;
    CHECK(TOLD(INCREMENT, law, &alone) == TORON_OK && TOLD(INCREMENT, law, &in) == TORON_OK, "%s", text);
    CHECK(memcmp(stress, again, 6 * sizeof(real)) == 0 && memcmp(state, stress, 6 * sizeof(real)) == 0, "in place");
    CHECK(stress[0] > 1.9 * wanted[0], "two increments: %g", stress[0]);
    /* The principal stress exceeds the fibre's where there is shear: only the first criterion sees a limit between. */
    strain[0] = (real)(0.9 * limit / e_1), strain[3] = (real)(2 * limit / 0.126);
    in = (toron_linear_increment){.size = sizeof in, .criterion = TORON_CRITERION_FIBRE, .strain = strain, .state_new = state};
    CHECK(TOLD(INCREMENT, law, &in) == TORON_OK && state[FAILED_AT] == 0, "fibre stress: %s", text);
    in.criterion = TORON_CRITERION_PRINCIPAL;
    CHECK(TOLD(INCREMENT, law, &in) == TORON_OK && state[FAILED_AT] == 1, "principal stress: %s", text);

    in.state_new = reals(M), in.stress = reals(6), in.criterion = 9;
    REFUSED(TORON_BAD_ARGUMENT, "argument criterion is 9; allowed: 0 (largest principal stress) or 1 (fibre stress)", INCREMENT,
            law, &in);
    in.criterion = 0, in.reserved = 5;
    REFUSED(TORON_UNKNOWN_FIELD, "argument reserved is 5; allowed: 0", INCREMENT, law, &in);
    in.reserved = 0, in.jacobian = -3;
    REFUSED(TORON_BAD_ARGUMENT, "argument jacobian is -3.0; allowed: a finite number > 0, or 0 if it is not known", INCREMENT,
            law, &in);
    in.jacobian = NAN;
    REFUSED(TORON_BAD_ARGUMENT, "argument jacobian is NaN; allowed: a finite number > 0, or 0 if it is not known", INCREMENT,
            law, &in);
    in.jacobian = 0, in.strain = NULL;
    REFUSED(TORON_NULL_ARGUMENT, "argument strain is null", INCREMENT, law, &in);
    REFUSED(TORON_NULL_ARGUMENT, "argument increment is null", INCREMENT, law, NULL);
    REFUSED(TORON_NULL_ARGUMENT, "argument law is null", INCREMENT, NULL, &alone);
    const toron_linear_elastic not_prepared = {0};
    REFUSED(TORON_NOT_PREPARED, NOT_PREPARED_BY(toron_linear_elastic_prepare), INCREMENT, &not_prepared, &alone);
    CHECK(untouched(in.state_new, M * sizeof(real)) && untouched(in.stress, 6 * sizeof(real)), "nothing is written");
    in.strain = strain, strain[1] = NAN;
    REFUSED(TORON_NOT_FINITE, "the deformation has an entry that is NaN or infinite", INCREMENT, law, &in);
    CHECK(in.stress[0] == 0 && in.state_new[ALIVE_AT] == 1, "no stress");
    release();
}

/* ---- Blocks */

enum { POINTS = 11, LD = 13, BAD = 4 };

/* A block with all that there can be but a tangent: moderate deformations, each point with directions of its own. */
static toron_linear_block all_of_a_block(const toron_linear_elastic *law, int32_t rotation)
{
    real *f_old = reals(9 * LD), *f_new = reals(9 * LD), *axes = reals(9 * LD), *fibre = reals(3 * LD), *second = reals(3 * LD);
    real *state = reals(M * LD), *start = axes_of(law);
    for (int i = 0; i < POINTS; i++) {
        for (int c = 0; c < 9; c++) {
            f_old[c * LD + i] = (real)at_rest[c];
            f_new[c * LD + i] = (real)(at_rest[c] + 0.001 * (i - c) * (c % 3 + 1));
            axes[c * LD + i] = start[c];
        }
        for (int c = 0; c < 3; c++) {
            fibre[c * LD + i] = (real)(1 + 0.3 * c * i);
            second[c * LD + i] = (real)(c == i % 3 ? 2 : 0);
        }
        for (int c = 0; c < M; c++)
            state[c * LD + i] = 0;
    }
    return (toron_linear_block){.size = sizeof(toron_linear_block), .n = POINTS, .leading_dimension = LD, .rotation = rotation,
                                .criterion = TORON_CRITERION_FIBRE, .density = 1.44, .f_old = {f_old}, .f_new = {f_new},
                                .fibre = {fibre}, .second_axis = {second}, .axes = axes, .state_old = state, .state_new = state,
                                .stress = {reals(6 * LD)}, .wave_speed = reals(POINTS), .active = reals(POINTS),
                                .status = guarded(POINTS * sizeof(int32_t))};
}

/* `count` components of point i. */
static void gather(real *to, const real *array, size_t count, size_t i)
{
    for (size_t c = 0; c < count; c++)
        to[c] = array[c * LD + i];
}

/* A block is, bit for bit, the law at each of its points; one that cannot be evaluated is none of the others' business. */
static void block(int32_t rotation, int with_directions, int with_tangent, int with_properties)
{
    real *properties = yarn(), *tangent = with_tangent ? reals(81 * LD) : NULL;
    const toron_linear_elastic *law = law_of(properties);
    toron_linear_block b = all_of_a_block(law, rotation);
    real *f_new = (real *)b.f_new[0], *start = axes_of(law);
    f_new[BAD] = -1;
    b.measure = TORON_TANGENT_NOMINAL, b.tangent = tangent;
    if (!with_directions)
        b.fibre[0] = b.second_axis[0] = NULL;
    CHECK(evaluate_block(with_properties, properties, &b) == TORON_INVERTED, "%s", text);
    CHECK(strcmp(text, "point 4, counted from 0: " INVERTED_TEXT) == 0, "%s", text);
    for (size_t i = 0; i < POINTS; i++) {
        real f[9], rest[9], fibre[3], second[3], axes[9], state[M], stress[6], speed, c[81], found[81];
        const size_t bytes = sizeof(real);
        gather(f, f_new, 9, i), gather(rest, b.f_old[0], 9, i);
        memcpy(axes, start, sizeof axes);
        toron_linear_point point = {.size = sizeof point, .rotation = rotation, .criterion = TORON_CRITERION_FIBRE,
                                    .measure = TORON_TANGENT_NOMINAL, .density = b.density, .f_old = rest, .f_new = f, .axes = axes,
                                    .state_new = state, .stress = stress, .wave_speed = &speed, .tangent = with_tangent ? c : NULL};
        if (with_directions) {
            gather(fibre, b.fibre[0], 3, i), gather(second, b.second_axis[0], 3, i);
            point.fibre = fibre, point.second_axis = second;
        }
        int32_t status = evaluate_point(0, properties, &point);
        CHECK(status == b.status[i] && (status == TORON_OK) == (i != BAD), "point %zu: %d, %d", i, status, b.status[i]);
        CHECK(b.active[i] == (i == BAD ? 0 : state[ALIVE_AT]), "point %zu: active %g", i, b.active[i]);
        CHECK(memcmp(&speed, &b.wave_speed[i], bytes) == 0, "point %zu: wave speed %g, %g", i, speed, b.wave_speed[i]);
        CHECK(speed >= sqrt(e_1 / b.density) * (1 - 1e-6) && speed < INFINITY, "point %zu: wave speed %g", i, speed);
        gather(found, b.stress[0], 6, i);
        CHECK(memcmp(found, stress, 6 * bytes) == 0, "point %zu: stress", i);
        gather(found, b.state_new, M, i);
        CHECK(memcmp(found, state, M * bytes) == 0, "point %zu: state", i);
        gather(found, b.axes, 9, i);
        CHECK(memcmp(found, axes, 9 * bytes) == 0, "point %zu: axes", i);
        CHECK(rotation == TORON_ROTATION_SPIN || memcmp(axes, start, 9 * bytes) == 0, "point %zu: axes that are not used", i);
        if (with_tangent) {
            gather(found, tangent, 81, i);
            CHECK(memcmp(found, c, 81 * bytes) == 0 && (c[0] == 0) == (i == BAD), "point %zu: tangent", i);
        }
    }
    /* Without the codes the point at fault is found again, unless the axes have been turned. */
    b.status = NULL;
    CHECK(evaluate_block(with_properties, properties, &b) == TORON_INVERTED, "%s", text);
    const char *named = rotation == TORON_ROTATION_SPIN ? INVERTED_TEXT : "point 4, counted from 0: " INVERTED_TEXT;
    CHECK(strcmp(text, named) == 0, "%s", text);
    release();
}

/* Every combination of outputs, by both ways: each has the bits that it has when everything is wanted, gaps included. With a tangent
 * everything is computed in another way, so that it is always there or never. */
static void block_outputs(int32_t rotation, int with_tangent)
{
    static const output outputs[] = {
        {offsetof(toron_linear_block, state_new), M * LD * sizeof(real)}, {offsetof(toron_linear_block, stress),
                                                                           6 * LD * sizeof(real)},
        {offsetof(toron_linear_block, wave_speed), POINTS * sizeof(real)}, {offsetof(toron_linear_block, active),
                                                                            POINTS * sizeof(real)},
        {offsetof(toron_linear_block, status), POINTS * sizeof(int32_t)}};
    enum { COUNT = sizeof outputs / sizeof *outputs };
    const unsigned all = (1u << COUNT) - 1;
    for (unsigned wanted = 0; wanted <= all; wanted++) {
        void *whole[COUNT], *part[COUNT];
        real *properties = yarn(), *fresh = reals(9 * LD);
        properties[3] = 0; /* no failure: what is left out does not change the rest */
        toron_linear_block b = all_of_a_block(law_of(properties), rotation);
        real *axes = b.axes;
        UNCHECKED_BEGIN;
        memcpy(fresh, axes, 9 * LD * sizeof(real));
        UNCHECKED_END;
        b.tangent = with_tangent ? reals(36 * LD) : NULL;
        request(&b, outputs, COUNT, all, whole);
        CHECK(evaluate_block(0, properties, &b) == TORON_OK, "%s", text);
        for (int way = 0; way < 2; way++) {
            request(&b, outputs, COUNT, wanted, part);
            b.axes = reals(9 * LD), b.tangent = with_tangent ? reals(36 * LD) : NULL;
            memcpy(b.axes, fresh, 9 * LD * sizeof(real));
            CHECK(evaluate_block(way, properties, &b) == TORON_OK, "%s", text);
            for (size_t k = 0; k < COUNT; k++)
                CHECK(part[k] == NULL || same_bytes(part[k], whole[k], outputs[k].bytes), "wanted %#x, output %zu", wanted, k);
            CHECK(same_bytes(b.axes, axes, 9 * LD * sizeof(real)), "wanted %#x: axes", wanted);
        }
        release();
    }
}

/* AVX2 and AVX-512 give the same bits; the baseline differs in the last digits. */
static void levels(int32_t rotation)
{
    real *properties = yarn();
    toron_linear_block b[4];
    for (int32_t level = TORON_LEVEL_BEST; level <= TORON_LEVEL_AVX512; level++) {
        b[level] = all_of_a_block(law_of(properties), rotation);
        b[level].level = level;
        CHECK(evaluate_block(0, properties, &b[level]) == TORON_OK, "%s", text);
    }
    CHECK(same_bytes(b[TORON_LEVEL_AVX2].stress[0], b[TORON_LEVEL_AVX512].stress[0], 6 * LD * sizeof(real)), "frame %d", rotation);
    CHECK(same_bytes(b[TORON_LEVEL_AVX2].state_new, b[TORON_LEVEL_AVX512].state_new, M * LD * sizeof(real)), "frame %d", rotation);
    CHECK(same_bytes(b[TORON_LEVEL_AVX512].stress[0], b[TORON_LEVEL_BEST].stress[0], 6 * LD * sizeof(real)), "frame %d", rotation);
    for (size_t c = 0; c < 6; c++)
        for (size_t i = 0; i < POINTS; i++) {
            double found = b[TORON_LEVEL_BASELINE].stress[0][c * LD + i], best = b[TORON_LEVEL_BEST].stress[0][c * LD + i];
            CHECK(fabs(found - best) <= ROUNDINGS * e_1, "frame %d, point %zu, stress %zu: %g, %g", rotation, i, c, found, best);
        }
    release();
}

/* Every combination of the outputs of a point. */
static void point_outputs(int32_t rotation, int with_tangent)
{
    static const output outputs[] = {{offsetof(toron_linear_point, state_new), M * sizeof(real)},
                                     {offsetof(toron_linear_point, stress), 6 * sizeof(real)},
                                     {offsetof(toron_linear_point, wave_speed), sizeof(real)}};
    enum { COUNT = sizeof outputs / sizeof *outputs };
    const unsigned all = (1u << COUNT) - 1;
    const double f[9] = {1.01, 0.02, 0, 0.3, 0.9, 0.1, 0, -0.1, 1.1};
    for (unsigned wanted = 0; wanted <= all; wanted++) {
        void *whole[COUNT], *part[COUNT];
        real *properties = yarn();
        properties[3] = 0;
        toron_linear_point point = {.size = sizeof point, .rotation = rotation, .density = 1.44, .f_old = copied(at_rest, 9),
                                    .f_new = copied(f, 9), .state_old = filled(0.25, M)};
        for (int way = 0; way < 3; way++) {
            point.tangent = with_tangent ? reals(36) : NULL;
            point.axes = rotation == TORON_ROTATION_SPIN ? axes_of(law_of(properties)) : NULL;
            request(&point, outputs, COUNT, way == 0 ? all : wanted, way == 0 ? whole : part);
            CHECK(evaluate_point(way == 1, properties, &point) == TORON_OK, "%s", text);
            for (size_t k = 0; way > 0 && k < COUNT; k++)
                CHECK(part[k] == NULL || memcmp(part[k], whole[k], outputs[k].bytes) == 0, "wanted %#x, output %zu", wanted, k);
        }
        release();
    }
}

/* ---- Directions of a point's own */

/* They give what a law gives that has been prepared with these directions, bit for bit where the axes have the same bits: a law's are
 * computed without fused multiply-add, a point's with it, and in the frame of these directions no rounding differs. Only with a tangent
 * in single precision the law's are rounded first, and a point's are not. */
static void directions(int32_t rotation, int with_tangent)
{
    const double fibre[3] = {0.6, -2, 0.3}, second[3] = {0.5, 0.1, 3}, f[9] = {1.01, 0.02, 0, 0.3, 0.9, 0.1, 0, -0.1, 1.1};
    const double nowhere[3] = {NAN, NAN, NAN}, zero[3] = {0};
    real *other = yarn(), *properties = yarn(), *stress = reals(6), *wanted = reals(6), *c = reals(36), *c_wanted = reals(36);
    for (int c = 0; c < 3; c++)
        other[4 + c] = (real)fibre[c], other[7 + c] = (real)second[c];
    toron_linear_point point = {.size = sizeof point, .rotation = rotation, .f_old = copied(at_rest, 9), .f_new = copied(f, 9),
                                .stress = wanted, .tangent = with_tangent ? c_wanted : NULL};
    CHECK(evaluate_point(0, other, &point) == TORON_OK, "%s", text);
    /* The second axis alone goes with the fibre of the properties, whose direction is rounded once more. */
    real *no_second = yarn(), *along_fibre = reals(6);
    for (int k = 0; k < 3; k++)
        no_second[4 + k] = (real)fibre[k];
    toron_linear_point alone = point;
    alone.second_axis = copied(second, 3), alone.stress = along_fibre, alone.tangent = NULL;
    CHECK(evaluate_point(0, no_second, &alone) == TORON_OK, "%s", text);
    for (int i = 0; i < 6; i++)
        CHECK(fabs((double)along_fibre[i] - (double)wanted[i]) <= (sizeof(real) == sizeof(float) ? 1e-5 : 1e-14) * e_1,
              "the second axis alone, frame %d: %.17g, wanted %.17g", rotation, along_fibre[i], wanted[i]);
    point.fibre = copied(fibre, 3), point.second_axis = copied(second,
                                                               3), point.stress = stress, point.tangent = with_tangent ? c : NULL;
    CHECK(evaluate_point(0, properties, &point) == TORON_OK, "%s", text);
    const double allowed = with_tangent && sizeof(real) == sizeof(float) ? 1e-5 * e_1 : 0;
    for (int i = 0; i < 6; i++)
        CHECK(fabs((double)stress[i] - (double)wanted[i]) <= allowed, "frame %d: %.17g, wanted %.17g", rotation, stress[i],
              wanted[i]);
    for (int i = 0; with_tangent && i < 36; i++)
        CHECK(fabs((double)c[i] - (double)c_wanted[i]) <= allowed, "frame %d, entry %d: %g, wanted %g", rotation, i, c[i],
              c_wanted[i]);
    CHECK(fabs(stress[0]) + fabs(stress[3]) > 1e-3, "some stress");

    /* Without a second axis it is that of the properties, as a unit vector: to rounding. */
    for (int c = 0; c < 3; c++)
        properties[7 + c] = (real)second[c];
    point.second_axis = NULL;
    CHECK(evaluate_point(0, properties, &point) == TORON_OK, "%s", text);
    for (int i = 0; i < 6; i++)
        CHECK(fabs((double)stress[i] - (double)wanted[i]) <= ROUNDINGS * e_1, "frame %d: %.17g, wanted %.17g", rotation, stress[i],
              wanted[i]);

    /* A fibre direction of no length, and a second axis along the fibre. */
    point.fibre = copied(zero, 3);
    REFUSED(TORON_FIBRE_DIRECTION, NO_FIBRE_TEXT, POINT, law_of(properties), &point);
    CHECK(stress[0] == 0 && (!with_tangent || c[0] == 0), "no stress");
    point.fibre = point.second_axis = copied(second, 3);
    CHECK(evaluate_point(0, properties, &point) == TORON_FIBRE_DIRECTION, "%s", text);
    /* They are not read where the axes are the caller's. */
    point.rotation = TORON_ROTATION_SPIN, point.fibre = point.second_axis = copied(nowhere, 3), point.axes = copied(at_rest, 9);
    CHECK(evaluate_point(0, properties, &point) == TORON_OK, "%s", text);
    release();
}

/* ---- What is refused */

static void refused_point(const real *properties, toron_linear_point point, int32_t wanted, const char *words)
{
    REFUSED(wanted, words, POINT, law_of(properties), &point);
    REFUSED(wanted, words, POINT_WITH, properties, N, &point);
    CHECK(untouched(point.state_new, M * sizeof(real)) && untouched(point.stress, 6 * sizeof(real)), "%s", words);
    CHECK(untouched(point.wave_speed, sizeof(real)) && untouched(point.tangent, 81 * sizeof(real)), "%s", words);
}

static void wrong_points(void)
{
    real *properties = yarn(), *f = copied(at_rest, 9), *bad = copied(at_rest, 9);
    const toron_linear_elastic *law = law_of(properties);
    const toron_linear_point good = {.size = sizeof good, .density = 1.44, .f_old = f, .f_new = f, .state_new = reals(M),
                                     .stress = reals(6), .wave_speed = reals(1), .tangent = reals(81)};
    toron_linear_point point = good;
    point.rotation = 3;
    refused_point(properties, point, TORON_BAD_ARGUMENT, "argument rotation is 3; allowed: 0 (fibre), 1 (polar) or 2 (spin)");
    point.rotation = -1;
    refused_point(properties, point, TORON_BAD_ARGUMENT, "argument rotation is -1; allowed: 0 (fibre), 1 (polar) or 2 (spin)");
    point = good, point.criterion = 2;
    refused_point(properties, point, TORON_BAD_ARGUMENT, "argument criterion is 2; allowed: 0 (largest principal stress) or 1 (fibre stress)");
    point = good, point.measure = 4;
    refused_point(properties, point, TORON_BAD_ARGUMENT, "argument measure is 4; allowed: " MEASURES_TEXT);
    point = good, point.level = 4;
    refused_point(properties, point, TORON_BAD_ARGUMENT, "argument level is 4; allowed: " LEVELS_TEXT);
    point = good, point.density = -1;
    refused_point(properties, point, TORON_BAD_ARGUMENT, "argument density is -1.0; allowed: " DENSITIES_TEXT);
    point = good, point.f_old = NULL;
    refused_point(properties, point, TORON_NULL_ARGUMENT, "argument f_old is null");
    point = good, point.f_new = NULL;
    refused_point(properties, point, TORON_NULL_ARGUMENT, "argument f_new is null");
    point = good, point.rotation = TORON_ROTATION_SPIN;
    refused_point(properties, point, TORON_NULL_ARGUMENT, "argument axes is null");
    REFUSED(TORON_NULL_ARGUMENT, "argument point is null", POINT, law, NULL);
    REFUSED(TORON_NULL_ARGUMENT, "argument law is null", POINT, NULL, &good);
    REFUSED(TORON_NULL_ARGUMENT, "argument properties is null", POINT_WITH, NULL, N, &good);
    REFUSED(TORON_PROPERTY_COUNT, "number of properties: 11 given, 10 needed", POINT_WITH, properties, 11, &good);
    REFUSED(TORON_NULL_ARGUMENT, "argument point is null", POINT_WITH, properties, N, NULL);

    bad[0] = -1;
    point = good, point.f_new = bad;
    REFUSED(TORON_INVERTED, INVERTED_TEXT, POINT, law, &point);
    CHECK(point.stress[0] == 0 && point.tangent[0] == 0 && point.state_new[ALIVE_AT] == 1, "inverted");
    point.rotation = TORON_ROTATION_POLAR, bad[0] = NAN;
    CHECK(TOLD(POINT, law, &point) == TORON_NOT_FINITE, "NaN: %s", text);
    point.rotation = TORON_ROTATION_FIBRE, bad[0] = 100;
    CHECK(TOLD(POINT, law, &point) == TORON_INCREMENT_TOO_LARGE, "a stretch by 100: %s", text);
    release();
}

static void refused_block(const real *properties, toron_linear_block b, int32_t wanted, const char *words)
{
    REFUSED(wanted, words, BLOCK, law_of(properties), &b);
    REFUSED(wanted, words, BLOCK_WITH, properties, N, &b);
    CHECK(untouched(b.wave_speed, POINTS * sizeof(real)) && untouched(b.status, POINTS * sizeof(int32_t)), "%s", words);
    CHECK(untouched(b.active, POINTS * sizeof(real)) && b.state_new[0] == 0, "%s", words);
}

/* Without a new state no point fails, whatever else is requested; and what the frame does not need is not read. */
static void points_that_do_not_fail(void)
{
    const double drawn[9] = {1.2, 0, 0, 0, 1, 0, 0, 0, 1};
    real *properties = yarn(), *active = reals(1), *tangent = reals(36), *stress = reals(6);
    properties[4] = 1, properties[5] = properties[6] = 0;
    const toron_linear_elastic *law = law_of(properties);
    toron_linear_block b = {.size = sizeof b, .n = 1, .f_old = {copied(at_rest, 9)}, .f_new = {copied(drawn, 9)}, .active = active,
                            .stress = {stress}};
    for (int way = 0; way < 4; way++) {
        b.criterion = way & 1 ? TORON_CRITERION_FIBRE : TORON_CRITERION_PRINCIPAL, b.tangent = way & 2 ? tangent : NULL;
        CHECK(ENTRY(toron_linear_elastic_block)(law, &b, NULL, 0) == TORON_OK && active[0] == 1 && stress[0] > properties[3],
              "criterion %d: active %g", b.criterion, (double)active[0]);
    }
    b.rotation = TORON_ROTATION_SPIN, b.axes = copied(at_rest, 9), b.tangent = NULL;
    b.fibre[0] = b.second_axis[0] = (const real *)(uintptr_t)8;
    CHECK(ENTRY(toron_linear_elastic_block)(law, &b, NULL, 0) == TORON_OK, "the spin's frame needs no fibre");
    b.tangent = tangent;
    CHECK(ENTRY(toron_linear_elastic_block)(law, &b, NULL, 0) == TORON_OK, "the spin's frame needs no fibre");
    release();
}

static void wrong_blocks(void)
{
    real *properties = yarn(), *stress = reals(6 * LD), *tangent = reals(36 * LD);
    const toron_linear_block good = all_of_a_block(law_of(properties), TORON_ROTATION_SPIN);
    toron_linear_block b = good;
    b.leading_dimension = POINTS - 1;
    refused_block(properties, b, TORON_BAD_LEADING_DIMENSION,
                  "leading dimension of f_old: 10 given, 11 needed");
    b = good, b.axes_layout.leading_dimension = POINTS - 1;
    refused_block(properties, b, TORON_BAD_LEADING_DIMENSION, "leading dimension of axes: 10 given, 11 needed");
    b = good, b.state_layout.leading_dimension = POINTS - 1;
    refused_block(properties, b, TORON_BAD_LEADING_DIMENSION, "leading dimension of the state: 10 given, 11 needed");
    b = good, b.tangent = tangent, b.tangent_layout.leading_dimension = POINTS - 1;
    refused_block(properties, b, TORON_BAD_LEADING_DIMENSION, "leading dimension of tangent: 10 given, 11 needed");
    static const struct {
        const char *array;
        size_t layout;
    } layouts[] = {
        {"f_old", offsetof(toron_linear_block, deformation_gradient_layout)}, {"fibre", offsetof(toron_linear_block, fibre_layout)},
        {"axes", offsetof(toron_linear_block, axes_layout)}, {"the state", offsetof(toron_linear_block, state_layout)},
        {"stress", offsetof(toron_linear_block, stress_layout)}, {"tangent", offsetof(toron_linear_block, tangent_layout)},
    };
    for (size_t k = 0; k < sizeof layouts / sizeof *layouts; k++) {
        char words[160];
        b = good, b.tangent = tangent;
        toron_layout *layout = (toron_layout *)((char *)&b + layouts[k].layout);
        *layout = (toron_layout){0, (size_t)-3};
        snprintf(words, sizeof words, "argument stride of %s is -3; allowed: 1 to %zu", layouts[k].array, MOST_DISTANCE / POINTS);
        refused_block(properties, b, TORON_BAD_LEADING_DIMENSION, words);
        *layout = (toron_layout){(size_t)-100, 0};
        snprintf(words, sizeof words, "argument leading dimension of %s is -100; allowed: 1 to " MOST_TEXT, layouts[k].array);
        refused_block(properties, b, TORON_BAD_LEADING_DIMENSION, words);
    }
    b = good, b.leading_dimension = (size_t)-1;
    refused_block(properties, b, TORON_BAD_LEADING_DIMENSION,
                  "argument leading dimension of f_old is -1; allowed: 1 to " MOST_TEXT);
    b = good, b.tangent = tangent, b.measure = -1;
    refused_block(properties, b, TORON_BAD_ARGUMENT, "argument measure is -1; allowed: " MEASURES_TEXT);
    b = good, b.axes = NULL;
    refused_block(properties, b, TORON_NULL_ARGUMENT, "argument axes is null");
    b = good, b.f_old[0] = NULL;
    refused_block(properties, b, TORON_NULL_ARGUMENT, "argument f_old is null");
    b = good, b.f_new[0] = NULL;
    refused_block(properties, b, TORON_NULL_ARGUMENT, "argument f_new is null");
    b = good, b.f_new[8] = good.f_new[0];
    refused_block(properties, b, TORON_NULL_ARGUMENT, "argument f_new, one of its components, is null");
    b = good, b.fibre[1] = good.fibre[0];
    refused_block(properties, b, TORON_NULL_ARGUMENT, "argument fibre, one of its components, is null");
    b = good, b.second_axis[0] = NULL, b.second_axis[1] = good.fibre[0];
    refused_block(properties, b, TORON_NULL_ARGUMENT, "argument second_axis, one of its components, is null");
    b = good, b.stress[1] = stress;
    refused_block(properties, b, TORON_NULL_ARGUMENT, "argument stress, one of its components, is null");
    b = good, b.density = INFINITY;
    refused_block(properties, b, TORON_BAD_ARGUMENT, "argument density is infinity; allowed: " DENSITIES_TEXT);
    b = good, b.rotation = 7;
    refused_block(properties, b, TORON_BAD_ARGUMENT, "argument rotation is 7; allowed: 0 (fibre), 1 (polar) or 2 (spin)");
    b = good, b.criterion = -1;
    refused_block(properties, b, TORON_BAD_ARGUMENT, "argument criterion is -1; allowed: 0 (largest principal stress) or 1 (fibre stress)");
    b = good, b.level = -1;
    refused_block(properties, b, TORON_BAD_ARGUMENT, "argument level is -1; allowed: " LEVELS_TEXT);
    REFUSED(TORON_NULL_ARGUMENT, "argument block is null", BLOCK, law_of(properties), NULL);
    REFUSED(TORON_NULL_ARGUMENT, "argument block is null", BLOCK_WITH, properties, N, NULL);
    REFUSED(TORON_NULL_ARGUMENT, "argument law is null", BLOCK, NULL, &good);
    REFUSED(TORON_NULL_ARGUMENT, "argument properties is null", BLOCK_WITH, NULL, N, &good);
    REFUSED(TORON_PROPERTY_COUNT, "number of properties: 9 given, 10 needed", BLOCK_WITH, properties, 9, &good);
    b = good, b.n = 0;
    CHECK(evaluate_block(0, properties, &b) == TORON_OK && untouched(b.wave_speed, sizeof(real)), "no point: %s", text);
    b = (toron_linear_block){.size = sizeof b};
    CHECK(evaluate_block(0, properties, &b) == TORON_OK, "nothing at all: %s", text);
    release();
}

/* Properties, sizes and laws that are wrong; a copy is as good as the law. */
static void prepared_laws(void)
{
    real *properties = yarn(), *hyperelastic_properties = reals(PROPERTIES), *stress = reals(6), *again = reals(6);
    toron_linear_elastic *law = guarded(sizeof *law);
    properties[7] = -2; /* the second axis along the fibre */
    REFUSED(TORON_PROPERTY_DIRECTION,
            "properties 8 to 10 (second axis) are -2.0, 0.0, 0.0; allowed: any vector that is not along the fibre, or zero", PREPARE,
            law, sizeof *law, properties, N);
    properties[7] = 0;
    REFUSED(TORON_PROPERTY_COUNT, "number of properties: 9 given, 10 needed", PREPARE, law, sizeof *law, properties, 9);
    REFUSED(TORON_NULL_ARGUMENT, "argument properties is null", PREPARE, law, sizeof *law, NULL, N);
    REFUSED(TORON_NULL_ARGUMENT, "argument law is null", PREPARE, NULL, sizeof *law, properties, N);
    char words[200];
    for (size_t size = 0; size <= 2 * sizeof *law; size += 4) {
        if (size == sizeof *law)
            continue;
        snprintf(words, sizeof words, "the size of " TEXT(ENTRY(toron_linear_elastic)) " is given as %zu; it is "
                 "%zu in this version of the library", size, sizeof *law);
        REFUSED(TORON_BAD_SIZE, words, PREPARE, law, size, properties, N);
    }
    CHECK(untouched(law, sizeof *law), "nothing is written");

    ENTRY(toron_preset)("kevlar-km2-600", "mm-kg-ms", hyperelastic_properties, PROPERTIES, NULL, NULL, 0);
    const void *other = prepared(hyperelastic_properties);
    const double f[9] = {1.01, 0.02, 0, 0.3, 0.9, 0.1, 0, -0.1, 1.1};
    toron_linear_point point = {.size = sizeof point, .f_old = copied(at_rest, 9), .f_new = copied(f, 9), .stress = stress};
    const toron_linear_block b = {.size = sizeof b, .n = 1, .f_old = {point.f_old}, .f_new = {point.f_new}, .stress = {stress}};
    REFUSED(TORON_NOT_PREPARED, NOT_PREPARED_BY(toron_linear_elastic_prepare), POINT, other, &point);
    REFUSED(TORON_NOT_PREPARED, NOT_PREPARED_BY(toron_linear_elastic_prepare), BLOCK, other, &b);
    CHECK(untouched(stress, 6 * sizeof(real)), "nothing is written");

    toron_linear_elastic *copy = law_of(properties), *moved = guarded(sizeof *moved);
    CHECK(TOLD(POINT, copy, &point) == TORON_OK, "%s", text);
    memcpy(moved, copy, sizeof *moved), memset(copy, 0, sizeof *copy), memset(properties, 0, N * sizeof *properties);
    point.stress = again;
    CHECK(TOLD(POINT, moved, &point) == TORON_OK && memcmp(stress, again, 6 * sizeof(real)) == 0, "a copy: %s", text);
    release();
}

int main(void)
{
    axes();
    tangent_at_rest();
    for (int32_t rotation = 0; rotation < 3; rotation++) {
        pull(rotation);
        levels(rotation);
        for (int32_t measure = 0; measure < 4; measure++)
            tangent_by_differences(rotation, measure);
        for (int with_tangent = 0; with_tangent < 2; with_tangent++) {
            for (int ways = 0; ways < 4; ways++)
                block(rotation, ways & 1, with_tangent, ways >> 1);
            block_outputs(rotation, with_tangent);
            point_outputs(rotation, with_tangent);
            if (rotation != TORON_ROTATION_SPIN)
                directions(rotation, with_tangent);
        }
    }
    increment();
    wrong_points();
    points_that_do_not_fail();
    wrong_blocks();
    prepared_laws();
    return finish();
}
