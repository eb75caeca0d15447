/* The library that Abaqus loads by itself, called as Standard and Explicit do: with no more arguments than they pass, NaN in what
   is not to be read, exceptions trapped, and the solver's routines for ending a job in this program. The argument is the library;
   with -DSINGLE it is that of Explicit in single precision, which has no UMAT. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fenv.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#ifdef SINGLE
typedef float real;
#define ROUNDING 1e-6
#else
typedef double real;
#define ROUNDING 1e-14
#endif

static int failures, ends_of_standard, ends_of_explicit;
#define CHECK(condition, ...) \
    ((condition) ? (void)0 : (void)(failures++, fprintf(stderr, "%s:%d: %s: ", __FILE__, __LINE__, #condition), \
                                    fprintf(stderr, __VA_ARGS__), fputc('\n', stderr)))

void xit_(void);
void xplb_exit_(void);

void xit_(void)
{
    ends_of_standard++;
}

void xplb_exit_(void)
{
    ends_of_explicit++;
}

#ifdef REINFORCED
static const double reinforced[7] = {1000, 3000, 20000, 0, 1, 0, 0};

/* Stress along the fibre and energy per reference volume of a stretch. */
static double reinforced_stress(double l)
{
    return (1000 * (l * l - 1) + 3000 * log(l) + 2 * 20000 * (l * l - 1) * l * l) / l;
}

static double reinforced_energy(double l)
{
    return 500 * (l * l - 1) - 1000 * log(l) + 1500 * log(l) * log(l) + 10000 * (l * l - 1) * (l * l - 1);
}
#else
static const double yarn[11] = {82341, 1055, 2.2, 649.74, 0, 0.0458, 1.8, 0, 1, 0, 0};
static const double linear[10] = {79414, 794, 126, 3637, 1, 0, 0, 0, 0, 0};
#endif

/* CMNAME, with blanks behind it. */
static char name[80];

static void set_name(const char *text)
{
    memset(name, ' ', sizeof name);
    memcpy(name, text, strlen(text));
}

#ifndef SINGLE
typedef void umat(double *, double *, double *, double *, double *, double *, double *, double *, double *, double *, const double *,
                  const double *, const double *, const double *, const double *, const double *, const double *, const double *,
                  const char *, const int32_t *, const int32_t *, const int32_t *, const int32_t *, const double *, const int32_t *,
                  const double *, const double *, double *, const double *, const double *, const double *, const int32_t *,
                  const int32_t *, const int32_t *, const int32_t *, const int32_t *, const int32_t *, int);

static double stress[6], statev[11], ddsdde[36], pnewdt, sse;

/* A stretch by `lambda` in one increment from rest. */
static void standard(umat *call, const double *props, int32_t nprops, int32_t nstatv, double lambda)
{
    double nan[9], before[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, f[9] = {lambda, 0, 0, 0, 1, 0, 0, 0, 1};
    const int32_t ndi = 3, nshr = 3, ntens = 6, one = 1, jstep[4] = {1, 1, 1, 0};
    for (int i = 0; i < 9; i++)
        nan[i] = NAN;
    for (int i = 0; i < 36; i++)
        ddsdde[i] = NAN;
    for (int i = 0; i < 6; i++)
        stress[i] = NAN;
    memset(statev, 0, sizeof statev);
    pnewdt = 1;
    sse = NAN;
    call(stress, statev, ddsdde, &sse, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, name, &ndi, &nshr, &ntens,
         &nstatv, props, &nprops, nan, nan, &pnewdt, nan, before, f, &one, &one, &one, &one, jstep, &one, 80);
}

#ifdef REINFORCED
static void umat_of_laws(umat *call)
{
    const char *names[] = {"REINFORCED", "reinforced", "REINFORCED_YARN-2"};
    const double wrong[7] = {1000, 3000, -1, 0, 1, 0, 0};
    for (int i = 0; i < 3; i++) {
        set_name(names[i]);
        standard(call, reinforced, 7, 4, 1.01);
        CHECK(fabs(stress[0] / reinforced_stress(1.01) - 1) < 10 * ROUNDING, "%g", stress[0]);
        CHECK(fabs(sse * 1.01 / reinforced_energy(1.01) - 1) < 1e-11, "%g", sse);
        CHECK(fabs(statev[1] - 1.01) < ROUNDING && statev[3] == 1 && pnewdt == 1, "%g, %g", statev[1], pnewdt);
        double logarithmic = 1.01 * (reinforced_stress(1.01 + 1e-5) - reinforced_stress(1.01 - 1e-5)) / 2e-5 + stress[0];
        CHECK(fabs(ddsdde[0] / logarithmic - 1) < 1e-8, "%g, %g", ddsdde[0], logarithmic);
    }
    standard(call, reinforced, 7, 4, -1);
    CHECK(pnewdt == 0.25 && stress[0] == 0 && ends_of_standard == 0, "%g, %g, %d", pnewdt, stress[0], ends_of_standard);
    standard(call, wrong, 7, 4, 1.01);
    CHECK(ends_of_standard == 1 && isnan(stress[0]), "%d, %g", ends_of_standard, stress[0]);
    standard(call, reinforced, 7, 3, 1.01);
    CHECK(ends_of_standard == 2 && isnan(stress[0]), "%d, %g", ends_of_standard, stress[0]);
    set_name("YARN");
    standard(call, reinforced, 7, 4, 1.01);
    CHECK(ends_of_standard == 3 && isnan(stress[0]), "%d, %g", ends_of_standard, stress[0]);
}
#else
static void umat_of_laws(umat *call)
{
    set_name("YARN");
    standard(call, yarn, 11, 11, 1.01);
    CHECK(fabs(stress[0] / (82341 * log(1.01) / 1.01) - 1) < ROUNDING && ddsdde[0] > 0, "%g, %g", stress[0], ddsdde[0]);
    CHECK(statev[10] == 1 && pnewdt == 1, "%g, %g", statev[10], pnewdt);
    standard(call, linear, 10, 10, 1.01);
    CHECK(fabs(stress[0] / (79414 * log(1.01)) - 1) < ROUNDING && ddsdde[0] > 0, "%g, %g", stress[0], ddsdde[0]);
    CHECK(statev[9] == 1 && pnewdt == 1, "%g, %g", statev[9], pnewdt);
    standard(call, yarn, 11, 11, -1);
    CHECK(pnewdt == 0.25 && stress[0] == 0 && ends_of_standard == 0, "%g, %g, %d", pnewdt, stress[0], ends_of_standard);
    standard(call, yarn, 10, 11, 1.01); /* a property is missing */
    CHECK(ends_of_standard == 1 && isnan(stress[0]), "%d, %g", ends_of_standard, stress[0]);
}
#endif
#endif

typedef void vumat(const int32_t *, const int32_t *, const int32_t *, const int32_t *, const int32_t *, const int32_t *, const int32_t *,
                   const real *, const real *, const real *, const char *, const real *, const real *, const real *, const real *,
                   const real *, const real *, const real *, const real *, const real *, const real *, const real *, const real *,
                   const real *, const real *, const real *, const real *, const real *, const real *, real *, real *, real *, real *,
                   int);

enum { POINTS = 3, STATE = 11 };
static real sigma[6 * POINTS], state[STATE * POINTS], energy[POINTS];

/* A stretch by `lambda` of all points, in a step from rest at the density 2. */
static void explicit_step(vumat *call, const double *values, int32_t nprops, int32_t nstatev, real lambda)
{
    real nan[9 * POINTS], u0[6 * POINTS] = {0}, u1[6 * POINTS] = {0}, density[POINTS], props[11], zeros[STATE * POINTS] = {0};
    real inelastic[POINTS];
    const real time = 1;
    const int32_t n = POINTS, ndir = 3, nshr = 3, zero = 0;
    for (int i = 0; i < 9 * POINTS; i++)
        nan[i] = NAN;
    for (int i = 0; i < 3 * POINTS; i++)
        u0[i] = 1, u1[i] = i < POINTS ? lambda : 1;
    for (int i = 0; i < POINTS; i++)
        density[i] = 2, energy[i] = NAN;
    for (int i = 0; i < nprops; i++)
        props[i] = (real)values[i];
    for (int i = 0; i < 6 * POINTS; i++)
        sigma[i] = NAN;
    call(&n, &ndir, &nshr, &nstatev, &zero, &nprops, &zero, &time, &time, nan, name, nan, nan, props, density, nan, nan, nan, u0, nan, nan,
         nan, zeros, zeros, zeros, nan, u1, nan, nan, sigma, state, energy, inelastic, 80);
}

#ifdef REINFORCED
static void vumat_of_laws(vumat *call)
{
    const double wrong[7] = {1000, 3000, 20000, 0, 0, 0, 0};
    set_name("REINFORCED-1");
    explicit_step(call, reinforced, 7, 4, (real)1.01);
    for (int i = 0; i < POINTS; i++) {
        CHECK(fabs((double)sigma[i] / reinforced_stress((real)1.01) - 1) < 100 * ROUNDING, "%g", (double)sigma[i]);
        CHECK(state[3 * POINTS + i] == 1, "%g", (double)state[3 * POINTS + i]);
        double specific = (double)energy[i] * 2 * 1.005 / reinforced_energy((real)1.01); /* the density is that at half the step */
        CHECK(fabs(specific - 1) < 1e5 * ROUNDING, "%g", specific);
    }
    explicit_step(call, reinforced, 7, 4, -1);
    CHECK(state[3 * POINTS + 2] == 0 && ends_of_explicit == 0, "%g, %d", (double)state[3 * POINTS + 2], ends_of_explicit);
    explicit_step(call, wrong, 7, 4, (real)1.01);
    CHECK(ends_of_explicit == 1 && isnan((double)sigma[0]), "%d, %g", ends_of_explicit, (double)sigma[0]);
    explicit_step(call, reinforced, 7, 3, (real)1.01);
    CHECK(ends_of_explicit == 2 && isnan((double)sigma[0]), "%d, %g", ends_of_explicit, (double)sigma[0]);
    set_name("REINFORCE");
    explicit_step(call, reinforced, 7, 4, (real)1.01);
    CHECK(ends_of_explicit == 3 && isnan((double)sigma[0]), "%d, %g", ends_of_explicit, (double)sigma[0]);
}
#else
static void vumat_of_laws(vumat *call)
{
    set_name("YARN");
    explicit_step(call, yarn, 11, 11, (real)1.01);
    double wanted = 82341 * log(1.01) / 1.01;
    CHECK(fabs((double)sigma[2] / wanted - 1) < 100 * ROUNDING, "%g", (double)sigma[2]);
    CHECK(state[10 * POINTS + 2] == 1 && energy[2] > 0, "%g, %g", (double)state[10 * POINTS + 2], (double)energy[2]);
    explicit_step(call, linear, 10, 10, (real)1.01);
    wanted = 79414 * log(1.01);
    CHECK(fabs((double)sigma[2] / wanted - 1) < 100 * ROUNDING, "%g", (double)sigma[2]);
    CHECK(state[9 * POINTS + 2] == 1 && energy[2] > 0, "%g, %g", (double)state[9 * POINTS + 2], (double)energy[2]);
    explicit_step(call, yarn, 11, 11, -1);
    CHECK(state[10 * POINTS + 2] == 0 && ends_of_explicit == 0, "%g, %d", (double)state[10 * POINTS + 2], ends_of_explicit);
    explicit_step(call, linear, 10, 11, (real)1.01); /* eleven state variables: not the linear elastic law's */
    CHECK(ends_of_explicit == 1 && isnan((double)sigma[0]), "%d, %g", ends_of_explicit, (double)sigma[0]);
}
#endif

int main(int argc, char **argv)
{
    void *library = dlopen(argv[argc - 1], RTLD_NOW | RTLD_LOCAL);
    if (library == NULL) {
        fprintf(stderr, "%s\n", dlerror());
        return 1;
    }
    vumat *of_explicit;
    *(void **)&of_explicit = dlsym(library, "vumat_");
    CHECK(of_explicit != NULL, "vumat_");
    void *of_standard = dlsym(library, "umat_");
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
#ifdef SINGLE
    CHECK(of_standard == NULL, "there is no Abaqus/Standard in single precision");
#else
    umat *call;
    *(void **)&call = of_standard;
    CHECK(call != NULL, "umat_");
    if (call != NULL)
        umat_of_laws(call);
#endif
    if (of_explicit != NULL)
        vumat_of_laws(of_explicit);
    fflush(stdout);
    return failures > 0;
}
