/* A finite standard solid: neo-Hooke beside one Maxwell branch, whose elastic strain is Hencky's.
 *
 *   W   = mu / 2 (tr bbar - 3) + kappa / 2 (J - 1)^2 + mu_v |dev ln V_e|^2
 *   dev ln V_e = dev ln V_e(trial) / (1 + dt / T),   b_e(trial) = F Cv^-1 F^T,   T = T_0 exp(-a (J - 1))
 *
 * The flow is a step of backward Euler along the exponential map: closed, without change of volume. More volume lets it
 * relax faster, so that the tangent is not symmetric.
 *
 * props   mu, kappa, mu_v, relaxation time T_0, its sensitivity a to the volume
 * statev  Cv^-1 - I, which is of the configuration at rest and is not turned; 11 22 33 12 13 23
 * ddsdde  Jaumann rate of the Kirchhoff stress, over J
 * sse, scd  stored and dissipated, of the volume at rest
 */
#include <math.h>
#include <string.h>

typedef double matrix[3][3];

static const int ROW[6] = {0, 1, 2, 0, 0, 1}, COLUMN[6] = {0, 1, 2, 1, 2, 2};

/* Eigenvalues and, in columns, eigenvectors of a symmetric matrix, by Jacobi's rotations. */
static void eigen(const matrix of, double value[3], matrix axes)
{
    matrix a;
    memcpy(a, of, sizeof a);
    memset(axes, 0, sizeof a);
    axes[0][0] = axes[1][1] = axes[2][2] = 1;
    for (int turn = 0; turn < 60; turn++) {
        int p = 0, q = 1;
        if (fabs(a[0][2]) > fabs(a[p][q]))
            q = 2;
        if (fabs(a[1][2]) > fabs(a[p][q]))
            p = 1, q = 2;
        if (a[p][q] == 0)
            break;
        double gap = a[q][q] - a[p][p], twice = 2 * a[p][q];
        double t = twice / (gap + copysign(hypot(gap, twice), gap)), c = 1 / hypot(t, 1), s = t * c;
        for (int k = 0; k < 3; k++) {
            double x = a[k][p], y = a[k][q];
            a[k][p] = c * x - s * y, a[k][q] = s * x + c * y;
        }
        for (int k = 0; k < 3; k++) {
            double x = a[p][k], y = a[q][k], v = axes[k][p], w = axes[k][q];
            a[p][k] = c * x - s * y, a[q][k] = s * x + c * y;
            axes[k][p] = c * v - s * w, axes[k][q] = s * v + c * w;
        }
        a[p][q] = a[q][p] = 0;
    }
    for (int i = 0; i < 3; i++)
        value[i] = a[i][i];
}

/* a s a^T */
static void push(const matrix a, const matrix s, matrix out)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            out[i][j] = 0;
            for (int k = 0; k < 3; k++)
                for (int l = 0; l < 3; l++)
                    out[i][j] += a[i][k] * s[k][l] * a[j][l];
        }
}

static double inverse(const matrix a, matrix out)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int k = (i + 1) % 3, l = (i + 2) % 3, m = (j + 1) % 3, n = (j + 2) % 3;
            out[j][i] = a[k][m] * a[l][n] - a[k][n] * a[l][m];
        }
    double det = a[0][0] * out[0][0] + a[0][1] * out[1][0] + a[0][2] * out[2][0];
    for (int i = 0; i < 9; i++)
        out[i / 3][i % 3] /= det;
    return det;
}

void umat_(double *stress, double *statev, double *ddsdde, double *sse, double *spd, double *scd, double *rpl,
           double *ddsddt, double *drplde, double *drpldt, double *stran, double *dstran, double *time, double *dtime,
           double *temp, double *dtemp, double *predef, double *dpred, char *cmname, int *ndi, int *nshr, int *ntens,
           int *nstatv, double *props, int *nprops, double *coords, double *drot, double *pnewdt, double *celent,
           double *dfgrd0, double *dfgrd1, int *noel, int *npt, int *layer, int *kspt, int *jstep, int *kinc)
{
    const double mu = props[0], kappa = props[1], mu_v = props[2], faster = props[4];
    const matrix one = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    matrix f, inverse_f, bbar, trial, n, cv;
    double value[3], ln[3], mean = 0, before = 0;

    memset(ddsdde, 0, sizeof(double) * *ntens * *ntens);
    for (int i = 0; i < 9; i++)
        f[i % 3][i / 3] = dfgrd1[i];
    const double jacobian = inverse(f, inverse_f);
    if (!(jacobian > 0 && isfinite(jacobian))) {
        *pnewdt = 0.25;
        return;
    }

    const double times = *dtime / props[3] * exp(faster * (jacobian - 1)), flow = 1 / (1 + times);

    /* The equilibrium part */
    push(f, one, bbar);
    for (int i = 0; i < 9; i++)
        bbar[i / 3][i % 3] *= pow(jacobian, -2.0 / 3);
    const double trace = bbar[0][0] + bbar[1][1] + bbar[2][2];

    /* The branch */
    for (int p = 0; p < 6; p++) {
        int i = ROW[p], j = COLUMN[p];
        cv[i][j] = cv[j][i] = one[i][j] + statev[p];
    }
    push(f, cv, trial);
    eigen(trial, value, n);
    for (int i = 0; i < 3; i++)
        mean += (ln[i] = 0.5 * log(value[i])) / 3;
    double elastic[3][3] = {{0}}; /* b_e in its axes */
    for (int i = 0; i < 3; i++) {
        ln[i] -= mean;
        before += ln[i] * ln[i];
        elastic[i][i] = exp(2 * (mean + flow * ln[i]));
    }

    const double volume = kappa * jacobian * (2 * jacobian - 1);
    for (int p = 0; p < *ntens; p++) {
        int i = ROW[p], j = COLUMN[p];
        stress[p] = (mu * (bbar[i][j] - one[i][j] * trace / 3)) / jacobian + kappa * (jacobian - 1) * one[i][j];
        double branch = 0; /* its Kirchhoff stress */
        for (int x = 0; x < 3; x++)
            branch += 2 * mu_v * flow * ln[x] * n[i][x] * n[j][x];
        stress[p] += branch / jacobian;
        for (int q = 0; q < *ntens; q++) {
            int k = ROW[q], l = COLUMN[q];
            double c = (volume * one[i][j] - branch * flow * times * faster * jacobian) * one[k][l];
            c += 0.5 * mu * (one[i][k] * bbar[j][l] + one[i][l] * bbar[j][k] + one[j][l] * bbar[i][k] + one[j][k] * bbar[i][l]);
            c -= 2.0 / 3 * mu * (one[i][j] * bbar[k][l] + bbar[i][j] * one[k][l] - one[i][j] * one[k][l] * trace / 3);
            /* The branch: its stress is a function of the trial strain in the same axes, which turn. */
            for (int x = 0; x < 3; x++)
                for (int y = 0; y < 3; y++) {
                    double e = ln[x] - ln[y], turning = e == 0 ? 1 : e / tanh(e);
                    c += 2 * mu_v * flow * ((x == y) - 1.0 / 3) * n[i][x] * n[j][x] * n[k][y] * n[l][y];
                    if (x != y)
                        c += mu_v * flow * turning * n[i][x] * n[j][y] * (n[k][x] * n[l][y] + n[k][y] * n[l][x]);
                }
            ddsdde[p + q * *ntens] = c / jacobian;
        }
    }

    /* Back to rest: Cv^-1 = F^-1 b_e F^-T */
    push(n, elastic, trial);
    push(inverse_f, trial, cv);
    for (int p = 0; p < 6; p++)
        statev[p] = cv[ROW[p]][COLUMN[p]] - one[ROW[p]][COLUMN[p]];
    *sse = 0.5 * mu * (trace - 3) + 0.5 * kappa * (jacobian - 1) * (jacobian - 1) + mu_v * flow * flow * before;
    *scd += mu_v * (1 - flow * flow) * before;
}
