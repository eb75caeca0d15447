/* A block gives the same bits by AVX2 and by AVX-512: the truth's points, volumes whose reciprocals are hard to round, and random
 * deformations, with every output. A level that the processor lacks is the best one below, and agrees with itself. */
#include "check.h"

#ifdef SINGLE
enum { DIGITS = 24 };
#else
enum { DIGITS = 53 };
#endif

enum { OUTPUTS = 6 + STATE + 24 + 1 + 81, MOST_POINTS = 1000, RANDOM_POINTS = 600, HARD = 64 };

static double points[MOST_POINTS][9];
static int point_count;

static double *add_point(void)
{
    if (point_count == MOST_POINTS) {
        fputs("no room for another point\n", stderr);
        exit(2);
    }
    return points[point_count++];
}

/* The next of a sequence of numbers from 0 to 1, the same ones everywhere. */
static double uniform(void)
{
    static uint64_t seed = 1;
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) * 0x1p-53;
}

static void make_points(void)
{
    for (int i = 0; i < case_count; i++)
        memcpy(add_point(), cases[i].f, sizeof cases[i].f);
    /* J = 2 - (k + 1) ulp and 1 + k ulp: mantissas of all ones less k, and of one and k. */
    for (int k = 0; k < 2 * HARD; k++) {
        double ulp = ldexp(1, 1 - DIGITS), *f = add_point();
        f[0] = f[4] = 1;
        f[8] = k < HARD ? 2 - (k + 1) * ulp : 1 + (k - HARD) * ulp;
    }
    for (int k = 0; k < RANDOM_POINTS; k++) {
        double *f = add_point(), size = k % 3 == 0 ? 1e-3 : 0.4;
        for (int c = 0; c < 9; c++)
            f[c] = (c % 4 == 0 ? 1 : 0) + size * (2 * uniform() - 1);
    }
}

/* All outputs of all points, component-major; F and the fibre directions come from the points. */
static int32_t evaluate(const double *yarn, int32_t level, int32_t measure, int fibres, real *out, int32_t *status)
{
    size_t n = (size_t)point_count;
    real properties[PROPERTIES], *f = reals(9 * n), *fibre = reals(3 * n);
    for (int c = 0; c < PROPERTIES; c++)
        properties[c] = (real)yarn[c];
    for (size_t i = 0; i < n; i++) {
        for (size_t c = 0; c < 9; c++)
            f[c * n + i] = (real)points[i][c];
        for (size_t c = 0; c < 3; c++)
            fibre[c * n + i] = (real)(c == i % 3 ? 1 : 0.3 * (double)(i % 7) - 0.9);
    }
    real *state = out + 6 * n, *modes = state + STATE * n, *wave = modes + 24 * n, *tangent = wave + n;
    toron_block block = {.size = sizeof block, .n = n, .measure = measure, .level = level, .density = 1.3514e-9,
                         .deformation_gradient = {f}, .fibre = {fibres ? fibre : NULL}, .stress = {out},
                         .energies = state + ENERGIES * n, .invariants = state + INVARIANTS * n, .failure = state + FAILURE * n,
                         .modes = modes, .wave_speed = wave, .tangent = tangent, .status = status};
    return TOLD(ENTRY(toron_hyperelastic_block), prepared(properties), &block);
}

/* The kernels that solvers use: stress, energies and the whole state, and nothing else. */
static int32_t evaluate_usual(const double *yarn, int32_t level, int outputs, real *out, int32_t *status)
{
    size_t n = (size_t)point_count;
    real properties[PROPERTIES], *f = reals(9 * n);
    for (int c = 0; c < PROPERTIES; c++)
        properties[c] = (real)yarn[c];
    for (size_t i = 0; i < n; i++)
        for (size_t c = 0; c < 9; c++)
            f[c * n + i] = (real)points[i][c];
    real *state = out + 6 * n;
    toron_block block = {.size = sizeof block, .n = n, .level = level, .deformation_gradient = {f}, .stress = {out},
                         .status = status};
    if (outputs > 0)
        block.energies = state + ENERGIES * n;
    if (outputs > 1) {
        block.invariants = state + INVARIANTS * n;
        block.failure = state + FAILURE * n;
    }
    return TOLD(ENTRY(toron_hyperelastic_block), prepared(properties), &block);
}

static const double yarns[][PROPERTIES] = {
    {82341, 1055, 2.2, 649.74, 0, 0.0458, 1.8, 0, 1, 0, 0},
    {82341, 1055, 2.2, 649.74, 126, 0.0458, 1.8, 0.3, 0.48, -0.6, 0.64},
    {82341, 1055, 1.5, 649.74, 0, 0, 0, 0, 0, 1, 0},
};

static void compare(const char *what, size_t yarn, const real *a, const real *b, const int32_t *codes)
{
    size_t n = (size_t)point_count;
    for (size_t c = 0; c < OUTPUTS; c++)
        for (size_t i = 0; i < n; i++)
            CHECK(memcmp(&a[c * n + i], &b[c * n + i], sizeof(real)) == 0, "%s, yarn %zu, output %zu, point %zu: %.17g %.17g", what,
                  yarn, c, i, (double)a[c * n + i], (double)b[c * n + i]);
    for (size_t i = 0; i < n; i++)
        CHECK(codes[i] == codes[n + i], "%s, yarn %zu, point %zu: status %d %d", what, yarn, i, codes[i], codes[n + i]);
}

int main(int argc, char **argv)
{
    read_cases(argc, argv);
    make_points();
    size_t n = (size_t)point_count;
    for (size_t yarn = 0; yarn < sizeof yarns / sizeof *yarns; yarn++) {
        for (int32_t measure = TORON_TANGENT_MATERIAL; measure <= TORON_TANGENT_NOMINAL; measure++)
            for (int fibres = 0; fibres < 2; fibres++) {
                real *out[2] = {filled(0, OUTPUTS * n), filled(0, OUTPUTS * n)};
                int32_t *codes = guarded(2 * n * sizeof *codes);
                int32_t worst = evaluate(yarns[yarn], TORON_LEVEL_AVX2, measure, fibres, out[0], codes);
                int32_t other = evaluate(yarns[yarn], TORON_LEVEL_AVX512, measure, fibres, out[1], codes + n);
                CHECK(worst == other && worst > -400 && worst <= 0 && (worst == 0 || worst < -300), "%d %d", worst, other);
                compare("all outputs", yarn, out[0], out[1], codes);
                release();
            }
        for (int outputs = 0; outputs < 3; outputs++) {
            real *out[2] = {filled(0, OUTPUTS * n), filled(0, OUTPUTS * n)};
            int32_t *codes = guarded(2 * n * sizeof *codes);
            int32_t worst = evaluate_usual(yarns[yarn], TORON_LEVEL_AVX2, outputs, out[0], codes);
            int32_t other = evaluate_usual(yarns[yarn], TORON_LEVEL_AVX512, outputs, out[1], codes + n);
            CHECK(worst == other, "%d %d", worst, other);
            compare("usual outputs", yarn, out[0], out[1], codes);
            release();
        }
    }
    /* A level that does not exist is refused. */
    real *out = filled(0, OUTPUTS * n);
    int32_t *codes = guarded(n * sizeof *codes);
    CHECK(evaluate_usual(yarns[0], 4, 0, out, codes) == TORON_BAD_ARGUMENT, "level 4");
    CHECK(evaluate_usual(yarns[0], -1, 0, out, codes) == TORON_BAD_ARGUMENT, "level -1");
    release();
    return finish();
}
