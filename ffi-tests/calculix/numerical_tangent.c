/* The library's entry for CalculiX with its tangent replaced by central differences of its stress: what a user would have
 * without a closed form. CalculiX finds it as @NUMERICAL_TANGENT. For the tests only. */

#include <stdlib.h>
#include <string.h>

typedef void behaviour(const char *, const int *, const int *, const int *, const double *, const double *, const double *,
                       const double *, const double *, const double *, const double *, const double *, const int *,
                       const double *, const double *, const double *, const double *, const int *, const int *,
                       const int *, const int *, const double *, double *, double *, double *, const int *,
                       const double *, const double *, double *, const int *, int);
behaviour HYPERELASTIC, TANGENT;

/* The best there is for central differences: the cube root of the rounding error. */
static const double STEP = 1e-5;
static const int PAIRS[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};

/* E of F by columns, 11 22 33 12 13 23. */
static void strain(const double *f, double *e)
{
    for (int c = 0; c < 6; c++) {
        const double *a = f + 3 * PAIRS[c][0], *b = f + 3 * PAIRS[c][1];
        e[c] = 0.5 * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2] - (c < 3));
    }
}

/* J F^-T by columns. */
static double cofactors(const double *f, double *g)
{
    for (int c = 0; c < 3; c++) {
        const double *a = f + 3 * ((c + 1) % 3), *b = f + 3 * ((c + 2) % 3);
        for (int i = 0; i < 3; i++)
            g[3 * c + i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    }
    return f[0] * g[0] + f[1] * g[1] + f[2] * g[2];
}

void TANGENT(const char *amat, const int *iel, const int *iint, const int *kode, const double *elconloc, const double *emec,
             const double *emec0, const double *beta, const double *xokl, const double *voj, const double *xkl,
             const double *vj, const int *ithermal, const double *t1l, const double *dtime, const double *time,
             const double *ttime, const int *icmd, const int *ielas, const int *mi, const int *nstate,
             const double *xstateini, double *xstate, double *stre, double *stiff, const int *iorien,
             const double *pgauss, const double *orab, double *pnewdt, const int *ipkon, int length)
{
    HYPERELASTIC(amat, iel, iint, kode, elconloc, emec, emec0, beta, xokl, voj, xkl, vj, ithermal, t1l, dtime, time, ttime,
                 icmd, ielas, mi, nstate, xstateini, xstate, stre, stiff, iorien, pgauss, orab, pnewdt, ipkon, length);
    const size_t place = ((size_t)(*iel - 1) * (size_t)*mi + (size_t)(*iint - 1)) * (size_t)*nstate;
    double *old = malloc(sizeof *old * (size_t)*nstate), *scratch = malloc(sizeof *scratch * (size_t)*nstate);
    const int first = 1;
    double g[9], jacobian = cofactors(xkl, g);
    int carries = xstateini[place + 9] == 0 && jacobian > 0; /* else the library's own stiffness stays */
    memcpy(old, xstateini + place, sizeof *old * (size_t)*nstate);
    for (int b = 0, k = 0; b < 6 && carries; b++) {
        double s[2][6], c[21], e[6], step, f[9];
        const int i = PAIRS[b][0], j = PAIRS[b][1];
        for (int side = 0; side < 2; side++) {
            const double h = side == 0 ? STEP : -STEP;
            /* F + F^-T dE, whose strain is E + dE up to a term that central differences cancel. */
            memcpy(f, xkl, sizeof f);
            for (int r = 0; r < 3; r++) {
                f[3 * j + r] += h * g[3 * i + r] / jacobian;
                if (i != j)
                    f[3 * i + r] += h * g[3 * j + r] / jacobian;
            }
            strain(f, e);
            step = *pnewdt;
            HYPERELASTIC(amat, &first, &first, kode, elconloc, e, emec0, beta, xokl, voj, f, vj, ithermal, t1l, dtime, time,
                         ttime, icmd, ielas, mi, nstate, old, scratch, s[side], c, iorien, pgauss, orab, &step, ipkon,
                         length);
        }
        for (int a = 0; a <= b; a++)
            stiff[k++] = (s[0][a] - s[1][a]) / (2 * STEP) * (i == j ? 1 : 0.5);
    }
    free(old);
    free(scratch);
}
