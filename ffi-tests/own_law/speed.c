/* A block of the law of examples/own_law, against the same formulas in a plain loop: prints nanoseconds a point of each. */
#define _POSIX_C_SOURCE 199309L /* clock_gettime */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "reinforced.h"

enum { N = 1000, DISTANCE = 1037, REPEATS = 300, CALLS = 20 };

static double f[9][DISTANCE], stress[6][DISTANCE], state[REINFORCED_STATE][DISTANCE];
static double stress_of_loop[6][DISTANCE], state_of_loop[REINFORCED_STATE][DISTANCE];

static const double properties[REINFORCED_PROPERTIES] = {31, 17, 230, 2, 2, -1, 0.5};

__attribute__((noinline)) static void loop(const double m[3])
{
    const double mu = properties[0], lambda = properties[1], k = properties[2], limit = properties[3] * properties[3];
    for (int i = 0; i < N; i++) {
        if (state_of_loop[REINFORCED_STATE_FAILED][i] != 0) {
            for (int c = 0; c < 6; c++)
                stress_of_loop[c][i] = 0;
            continue;
        }
        const double a = f[0][i], b = f[1][i], c = f[2][i], d = f[3][i], e = f[4][i], g = f[5][i], h = f[6][i], p = f[7][i], q = f[8][i];
        const double jacobian = a * (e * q - p * g) - d * (b * q - p * c) + h * (b * g - e * c);
        const double x = a * m[0] + d * m[1] + h * m[2], y = b * m[0] + e * m[1] + p * m[2], z = c * m[0] + g * m[1] + q * m[2];
        const double inverse = 1 / jacobian, logarithm = log(jacobian), square = x * x + y * y + z * z, elongation = square - 1;
        const double solid = mu * inverse, volume = lambda * logarithm * inverse, w = 2 * k * elongation * inverse;
        const double b11 = a * a + d * d + h * h, b22 = b * b + e * e + p * p, b33 = c * c + g * g + q * q;
        stress_of_loop[0][i] = solid * (b11 - 1) + volume + w * x * x;
        stress_of_loop[1][i] = solid * (b22 - 1) + volume + w * y * y;
        stress_of_loop[2][i] = solid * (b33 - 1) + volume + w * z * z;
        stress_of_loop[3][i] = solid * (a * b + d * e + h * p) + w * x * y;
        stress_of_loop[4][i] = solid * (b * c + e * g + p * q) + w * y * z;
        stress_of_loop[5][i] = solid * (c * a + g * d + q * h) + w * z * x;
        state_of_loop[REINFORCED_STATE_ENERGY][i] =
            0.5 * mu * (b11 + b22 + b33 - 3) - mu * logarithm + 0.5 * lambda * logarithm * logarithm + 0.5 * k * elongation * elongation;
        state_of_loop[REINFORCED_STATE_STRETCH][i] = sqrt(square);
        state_of_loop[REINFORCED_STATE_FAILED][i] = square >= limit;
        state_of_loop[REINFORCED_STATE_ALIVE][i] = square < limit;
    }
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

int main(void)
{
    for (int i = 0; i < N; i++)
        for (int c = 0; c < 9; c++)
            f[c][i] = (c % 4 == 0) + 0.2 * (((i * 37 + c * 101) % 211) / 211.0 - 0.5);
    char message[REINFORCED_MESSAGE_CAPACITY] = "";
    REINFORCED_f64 law;
    if (REINFORCED_prepare_f64(&law, sizeof law, properties, REINFORCED_PROPERTIES, message, sizeof message) != 0)
        return fprintf(stderr, "%s\n", message), 1;
    const REINFORCED_points_f64 points = {.size = sizeof points, .n = N, .leading_dimension = DISTANCE, .level = REINFORCED_LEVEL_AVX2,
                                          .f_new = {f[0]}, .state_old = state[0], .state_new = state[0], .stress = {stress[0]}};
    const double length = sqrt(5.25), m[3] = {2 / length, -1 / length, 0.5 / length};
    double of_block = INFINITY, of_loop = INFINITY;
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        const double start = now();
        for (int call = 0; call < CALLS; call++)
            if (REINFORCED_block_f64(&law, &points, message, sizeof message) != 0)
                return fprintf(stderr, "%s\n", message), 1;
        const double between = now();
        for (int call = 0; call < CALLS; call++)
            loop(m);
        const double end = now();
        of_block = fmin(of_block, (between - start) / (N * CALLS));
        of_loop = fmin(of_loop, (end - between) / (N * CALLS));
    }
    for (int i = 0; i < N; i++)
        for (int c = 0; c < 6; c++)
            if (!(fabs(stress[c][i] - stress_of_loop[c][i]) < 1e-12 * 300))
                return fprintf(stderr, "stress %d of point %d: %.17g, %.17g\n", c, i, stress[c][i], stress_of_loop[c][i]), 1;
    printf("%.3f %.3f\n", of_block, of_loop);
    return 0;
}
