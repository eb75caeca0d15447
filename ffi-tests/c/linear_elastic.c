/* The linear elastic law: axes, steps and increments, failure, and what is refused. */
#include "check.h"

enum { N = TORON_LINEAR_ELASTIC_PROPERTIES, M = TORON_LINEAR_ELASTIC_STATE, WORK = 7, FAILED_AT = 8, ALIVE_AT = 9 };

static const double e_1 = 79.414, limit = 3.637;
static const double at_rest[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

static double *yarn(void)
{
    double *properties = guarded(N * sizeof *properties);
    toron_preset_f64("kevlar-km2-600-linear", "mm-kg-ms", properties, N, NULL);
    return properties;
}

static double *array(const double *values, size_t count)
{
    double *copy = guarded(count * sizeof *copy);
    memcpy(copy, values, count * sizeof *copy);
    return copy;
}

static void axes(void)
{
    double *properties = yarn(), *a = guarded(9 * sizeof *a);
    properties[4] = 0, properties[5] = 0, properties[6] = 5; /* the fibre, any length */
    properties[7] = 3;                                       /* the second axis */
    CHECK(toron_linear_elastic_axes_f64(properties, N, a) == TORON_OK, "axes");
    const double wanted[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};
    for (int i = 0; i < 9; i++)
        CHECK(fabs(a[i] - wanted[i]) <= 1e-15, "axes[%d] = %g", i, a[i]);
    CHECK(toron_linear_elastic_axes_f64(properties, N, NULL) == TORON_NULL_ARGUMENT, "no room");
    CHECK(toron_linear_elastic_axes_f64(properties, 9, a) == TORON_PROPERTY_COUNT, "count");
    release();
}

/* The tangent of an infinitesimal step from rest is C, in every frame. */
static void tangent(void)
{
    double *properties = yarn(), *turning = guarded(9 * sizeof *turning), *f = array(at_rest, 9);
    double *stress = guarded(6 * sizeof *stress), *c = guarded(36 * sizeof *c), *nominal = guarded(81 * sizeof *nominal);
    toron_linear_elastic_axes_f64(properties, N, turning);
    const double wanted[6] = {79.414, 0.794, 0.794, 0.126, 0.126, 0.126};
    for (int32_t rotation = 0; rotation < 3; rotation++) {
        for (int32_t measure = TORON_TANGENT_MATERIAL; measure <= TORON_TANGENT_JAUMANN; measure++) {
            int32_t status = toron_linear_elastic_step_tangent_f64(properties, N, f, f, NULL, NULL, stress, rotation, 0,
                                                                   turning, measure, c);
            CHECK(status == TORON_OK, "%d", status);
            for (int i = 0; i < 36; i++)
                CHECK(fabs(c[i] - (i % 7 == 0 ? wanted[i / 7] : 0)) <= 1e-13, "measure %d: c[%d] = %g", measure, i, c[i]);
        }
        int32_t status = toron_linear_elastic_step_tangent_f64(properties, N, f, f, NULL, NULL, NULL, rotation, 0, turning,
                                                               TORON_TANGENT_NOMINAL, nominal);
        CHECK(status == TORON_OK && fabs(nominal[0] - wanted[0]) <= 1e-13 && fabs(nominal[40] - wanted[1]) <= 1e-13, "%d", status);
    }
    CHECK(toron_linear_elastic_step_tangent_f64(properties, N, f, f, NULL, NULL, NULL, 0, 0, turning, 4, c)
              == TORON_BAD_ARGUMENT, "measure");
    CHECK(toron_linear_elastic_step_tangent_f64(properties, N, f, f, NULL, NULL, NULL, 0, 0, turning, 0, NULL)
              == TORON_NULL_ARGUMENT, "no room");
    release();
}

/* F = diag(λ, 1, 1) in equal steps: σ11 = E1 ln λ in any frame, and failure at ln λ = σ_lim/E1. */
static void pull(int32_t rotation)
{
    enum { STEPS = 10 };
    double *properties = yarn(), *state = guarded(M * sizeof *state), *stress = guarded(6 * sizeof *stress);
    double *turning = guarded(9 * sizeof *turning), *f_old = array(at_rest, 9), *f_new = array(at_rest, 9);
    memset(state, 0, M * sizeof *state);
    toron_linear_elastic_axes_f64(properties, N, turning);
    const double strain_at_failure = limit / e_1;
    for (int step = 1; step <= STEPS; step++) {
        f_old[0] = f_new[0];
        f_new[0] = exp(1.05 * strain_at_failure * step / STEPS); /* past the limit in the last step only */
        int32_t status = toron_linear_elastic_step_f64(properties, N, f_old, f_new, state, state, stress, rotation,
                                                       TORON_CRITERION_PRINCIPAL, turning);
        double wanted = e_1 * log(f_new[0]);
        CHECK(status == TORON_OK, "%d", status);
        CHECK(fabs(stress[0] - wanted) <= 1e-14 * e_1, "frame %d, step %d: %.17g, wanted %.17g", rotation, step,
              stress[0], wanted);
        CHECK(state[FAILED_AT] == (wanted >= limit) && state[ALIVE_AT] == 1 - state[FAILED_AT], "step %d", step);
    }
    CHECK(state[FAILED_AT] == 1 && state[WORK] > 0, "failed in the end");
    toron_linear_elastic_step_f64(properties, N, f_new, f_new, state, state, stress, rotation, 0, turning);
    CHECK(stress[0] == 0 && state[0] == 0 && state[FAILED_AT] == 1, "and stays failed, without stress");
    release();
}

/* A plain increment: engineering shears are twice the tensor's, the work is weighed by J. */
static void increment(void)
{
    double *properties = yarn(), *state = guarded(M * sizeof *state), *stress = guarded(6 * sizeof *stress);
    const double values[6] = {1e-3, 2e-3, -1e-3, 5e-4, 0, -5e-4};
    double *strain = array(values, 6);
    const double wanted[6] = {79.414e-3, 0.794 * 2e-3, -0.794e-3, 0.126e-3, 0, -0.126e-3};
    int32_t status = toron_linear_elastic_increment_f64(properties, N, strain, 2, NULL, state, stress, 0);
    CHECK(status == TORON_OK, "%d", status);
    double work = 0;
    for (int i = 0; i < 6; i++) {
        CHECK(fabs(stress[i] - wanted[i]) <= 1e-15 * e_1, "stress %d is %.17g", i, stress[i]);
        CHECK(state[i] == stress[i], "the state holds the stress");
        work += 0.5 * wanted[i] * values[i] * (i < 3 ? 1 : 2);
    }
    CHECK(fabs(state[WORK] - 2 * work) <= 1e-14 * work, "work %g, wanted %g", state[WORK], 2 * work);
    /* The principal stress exceeds the fibre's where there is shear: only the first criterion sees a limit between. */
    strain[0] = 0.9 * limit / e_1, strain[3] = 2 * limit / 0.126;
    toron_linear_elastic_increment_f64(properties, N, strain, 1, NULL, state, NULL, TORON_CRITERION_FIBRE);
    CHECK(state[FAILED_AT] == 0, "fibre stress");
    toron_linear_elastic_increment_f64(properties, N, strain, 1, NULL, state, NULL, TORON_CRITERION_PRINCIPAL);
    CHECK(state[FAILED_AT] == 1, "principal stress");
    release();
}

/* A block is the law at each of its points; one that cannot be evaluated is none of the others' business. */
static void block(int32_t rotation)
{
    enum { POINTS = 11, STRIDE = 13, BAD = 4 };
    double *properties = yarn(), *f_old = guarded(9 * STRIDE * sizeof *f_old), *f_new = guarded(9 * STRIDE * sizeof *f_new);
    double *turning = guarded(9 * STRIDE * sizeof *turning), *state = guarded(M * STRIDE * sizeof *state);
    double *stress = guarded(6 * STRIDE * sizeof *stress);
    int32_t *codes = guarded(POINTS * sizeof *codes);
    double start[9], old[M] = {0}, f[9], wanted[6];
    toron_linear_elastic_axes_f64(properties, N, start);
    for (int i = 0; i < POINTS; i++) {
        for (int c = 0; c < 9; c++) {
            f_old[c * STRIDE + i] = at_rest[c];
            f_new[c * STRIDE + i] = at_rest[c] + 0.001 * (i - c) * (c % 3 + 1);
            turning[c * STRIDE + i] = start[c];
        }
        for (int c = 0; c < M; c++)
            state[c * STRIDE + i] = 0;
    }
    f_new[BAD] = -1;
    toron_linear_block_f64 points = {.n = POINTS, .leading_dimension = STRIDE, .f_old = f_old, .f_new = f_new,
                                     .axes = turning, .state_old = state, .state_new = state, .stress = stress,
                                     .status = codes};
    int32_t worst = toron_linear_elastic_block_f64(properties, N, &points, rotation, TORON_CRITERION_FIBRE);
    CHECK(worst == TORON_INVERTED, "%d", worst);
    for (int i = 0; i < POINTS; i++) {
        double axes[9], new[M];
        for (int c = 0; c < 9; c++)
            f[c] = f_new[c * STRIDE + i], axes[c] = start[c];
        int32_t status = toron_linear_elastic_step_f64(properties, N, at_rest, f, old, new, wanted, rotation,
                                                       TORON_CRITERION_FIBRE, axes);
        CHECK(status == codes[i] && (status == TORON_OK) == (i != BAD), "point %d: %d, %d", i, status, codes[i]);
        for (int c = 0; c < 6; c++)
            CHECK(fabs(stress[c * STRIDE + i] - wanted[c]) <= 1e-14 * e_1, "point %d, stress %d", i, c);
        for (int c = 0; c < M; c++)
            CHECK(fabs(state[c * STRIDE + i] - new[c]) <= 1e-14 * e_1, "point %d, state %d", i, c);
        for (int c = 0; rotation == TORON_ROTATION_SPIN && c < 9; c++)
            CHECK(fabs(turning[c * STRIDE + i] - axes[c]) <= 1e-15, "point %d, axes %d", i, c);
    }
    points.leading_dimension = POINTS - 1;
    CHECK(toron_linear_elastic_block_f64(properties, N, &points, rotation, 0) == TORON_BAD_LEADING_DIMENSION, "stride");
    CHECK(toron_linear_elastic_block_f64(properties, N, NULL, rotation, 0) == TORON_NULL_ARGUMENT, "no block");
    release();
}

static void refused(void)
{
    double *properties = yarn(), *state = guarded(M * sizeof *state), *stress = guarded(6 * sizeof *stress);
    double *f = array(at_rest, 9), *bad = array(at_rest, 9);
    bad[0] = -1;
#define STEP(values, count, old, new, rotation, criterion) \
    toron_linear_elastic_step_f64(values, count, old, new, NULL, state, stress, rotation, criterion, NULL)
    CHECK(STEP(properties, N, f, f, 3, 0) == TORON_BAD_ARGUMENT, "rotation");
    CHECK(STEP(properties, N, f, f, -1, 0) == TORON_BAD_ARGUMENT, "rotation");
    CHECK(STEP(properties, N, f, f, 0, 2) == TORON_BAD_ARGUMENT, "criterion");
    CHECK(STEP(properties, N, NULL, f, 0, 0) == TORON_NULL_ARGUMENT, "F old");
    CHECK(STEP(properties, N, f, NULL, 0, 0) == TORON_NULL_ARGUMENT, "F new");
    CHECK(STEP(properties, N, f, f, TORON_ROTATION_SPIN, 0) == TORON_NULL_ARGUMENT, "axes");
    CHECK(STEP(NULL, N, f, f, 0, 0) == TORON_NULL_ARGUMENT, "properties");
    CHECK(STEP(properties, 11, f, f, 0, 0) == TORON_PROPERTY_COUNT, "count");
    CHECK(toron_linear_elastic_increment_f64(properties, N, NULL, 1, NULL, state, stress, 0) == TORON_NULL_ARGUMENT,
          "strain");
    CHECK(toron_linear_elastic_increment_f64(properties, N, f, 1, NULL, state, stress, 9) == TORON_BAD_ARGUMENT,
          "criterion");
    CHECK(untouched(state, M * sizeof *state) && untouched(stress, 6 * sizeof *stress), "nothing is written");
    CHECK(STEP(properties, N, f, bad, 0, 0) == TORON_INVERTED && stress[0] == 0, "inverted");
    bad[0] = NAN;
    CHECK(STEP(properties, N, f, bad, 1, 0) == TORON_NOT_FINITE, "NaN");
    bad[0] = 100;
    CHECK(STEP(properties, N, f, bad, 0, 0) == TORON_INCREMENT_TOO_LARGE, "a stretch by 100");

    char *message = guarded(160);
    int32_t code = 0;
    properties[7] = -2; /* the second axis along the fibre */
    size_t length = toron_linear_elastic_validate_f64(properties, N, message, 160, &code);
    CHECK(code == TORON_PROPERTY_DIRECTION && length == strlen(message), "%d: %s", code, message);
    CHECK(strcmp(message, "properties 8 to 10 (second axis) are -2.0, 0.0, 0.0; allowed: any vector that is not along "
                          "the fibre, or zero") == 0, "%s", message);
    properties[7] = 0;
    CHECK(toron_linear_elastic_validate_f64(properties, N, message, 160, &code) == 0 && code == TORON_OK, "%s", message);
    release();
}

int main(void)
{
    axes();
    tangent();
    pull(TORON_ROTATION_FIBRE);
    pull(TORON_ROTATION_POLAR);
    pull(TORON_ROTATION_SPIN);
    block(TORON_ROTATION_FIBRE);
    block(TORON_ROTATION_POLAR);
    block(TORON_ROTATION_SPIN);
    increment();
    refused();
    return finish();
}
