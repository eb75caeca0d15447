/* Ogden, two terms, in principal stretches.
 *
 *   W = sum_p 2 mu_p / alpha_p^2 (sum_i lambdabar_i^alpha_p - 3) + kappa / 2 (J - 1)^2
 *   tau_i = sum_p 2 mu_p / alpha_p (lambdabar_i^alpha_p - mean over the axes) + kappa J (J - 1)
 *
 * props   mu_1, alpha_1, mu_2, alpha_2, kappa; both alpha are not 0
 * statev  none
 * ddsdde  Jaumann rate of the Kirchhoff stress, over J; the same where principal stretches are equal or nearly so
 * sse     W, of the volume at rest
 */
#include <math.h>
#include <string.h>

#define TERMS 2

static const int ROW[6] = {0, 1, 2, 0, 0, 1}, COLUMN[6] = {0, 1, 2, 1, 2, 2};

/* Eigenvalues and, in columns, eigenvectors of a symmetric matrix, by Jacobi's rotations; a is destroyed. */
static void eigen(double a[3][3], double value[3], double axes[3][3])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            axes[i][j] = i == j;
    for (int sweep = 0; sweep < 30; sweep++) {
        if (a[0][1] == 0 && a[0][2] == 0 && a[1][2] == 0)
            break;
        for (int p = 0; p < 2; p++)
            for (int q = p + 1; q < 3; q++) {
                if (a[p][q] == 0)
                    continue;
                double gap = a[q][q] - a[p][p], twice = 2 * a[p][q];
                double t = twice / (gap + copysign(hypot(gap, twice), gap)); /* of the smaller angle */
                double c = 1 / sqrt(t * t + 1), s = t * c;
                for (int k = 0; k < 3; k++) {
                    double x = a[k][p], y = a[k][q];
                    a[k][p] = c * x - s * y;
                    a[k][q] = s * x + c * y;
                }
                for (int k = 0; k < 3; k++) {
                    double x = a[p][k], y = a[q][k];
                    a[p][k] = c * x - s * y;
                    a[q][k] = s * x + c * y;
                    x = axes[k][p], y = axes[k][q];
                    axes[k][p] = c * x - s * y;
                    axes[k][q] = s * x + c * y;
                }
                a[p][q] = a[q][p] = 0;
            }
    }
    for (int i = 0; i < 3; i++)
        value[i] = a[i][i];
}

/* x coth e, where x is the difference of two powers whose logarithms are alpha e apart: lower * (exp(alpha e) - 1) */
static double over_tanh(double lower, double alpha, double e)
{
    return e == 0 ? lower * alpha : lower * expm1(alpha * e) / tanh(e);
}

void umat_(double *stress, double *statev, double *ddsdde, double *sse, double *spd, double *scd, double *rpl,
           double *ddsddt, double *drplde, double *drpldt, double *stran, double *dstran, double *time, double *dtime,
           double *temp, double *dtemp, double *predef, double *dpred, char *cmname, int *ndi, int *nshr, int *ntens,
           int *nstatv, double *props, int *nprops, double *coords, double *drot, double *pnewdt, double *celent,
           double *dfgrd0, double *dfgrd1, int *noel, int *npt, int *layer, int *kspt, int *jstep, int *kinc)
{
    const double *f = dfgrd1; /* by columns, as Fortran has it */
    const double kappa = props[2 * TERMS];
    double b[3][3], value[3], n[3][3], ln[3], tau[3], a[3][3], g[3][3];

    memset(ddsdde, 0, sizeof(double) * *ntens * *ntens);
    double jacobian = f[0] * (f[4] * f[8] - f[7] * f[5]) - f[3] * (f[1] * f[8] - f[7] * f[2])
                    + f[6] * (f[1] * f[5] - f[4] * f[2]);
    if (!(jacobian > 0 && isfinite(jacobian))) {
        *pnewdt = 0.25;
        return;
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            b[i][j] = f[i] * f[j] + f[i + 3] * f[j + 3] + f[i + 6] * f[j + 6];
    eigen(b, value, n);
    for (int i = 0; i < 3; i++)
        ln[i] = 0.5 * log(value[i]) - log(jacobian) / 3; /* of the isochoric stretches */

    double pressure = kappa * jacobian * (jacobian - 1), stiffness = kappa * jacobian * (2 * jacobian - 1);
    *sse = 0.5 * kappa * (jacobian - 1) * (jacobian - 1);
    for (int i = 0; i < 3; i++) {
        tau[i] = pressure;
        for (int j = 0; j < 3; j++) {
            a[i][j] = stiffness; /* d tau_i / d ln lambda_j */
            g[i][j] = 0;         /* the rate of tau_ij over d_ij, in the principal axes */
        }
    }
    for (int p = 0; p < TERMS; p++) {
        double mu = props[2 * p], alpha = props[2 * p + 1], power[3], sum = 0;
        for (int i = 0; i < 3; i++)
            sum += power[i] = exp(alpha * ln[i]);
        *sse += 2 * mu / (alpha * alpha) * (sum - 3);
        for (int i = 0; i < 3; i++) {
            tau[i] += 2 * mu / alpha * (power[i] - sum / 3);
            for (int j = 0; j < 3; j++) {
                a[i][j] += 2 * mu * ((i == j) * power[i] - (power[i] + power[j]) / 3 + sum / 9);
                if (i != j)
                    g[i][j] += 2 * mu / alpha * over_tanh(power[j], alpha, ln[i] - ln[j]);
            }
        }
    }

    for (int p = 0; p < *ntens; p++) {
        int i = ROW[p], j = COLUMN[p];
        stress[p] = (n[i][0] * tau[0] * n[j][0] + n[i][1] * tau[1] * n[j][1] + n[i][2] * tau[2] * n[j][2]) / jacobian;
        for (int q = 0; q < *ntens; q++) {
            int k = ROW[q], l = COLUMN[q];
            double c = 0;
            for (int x = 0; x < 3; x++)
                for (int y = 0; y < 3; y++) {
                    c += a[x][y] * n[i][x] * n[j][x] * n[k][y] * n[l][y];
                    c += 0.5 * g[x][y] * n[i][x] * n[j][y] * (n[k][x] * n[l][y] + n[k][y] * n[l][x]);
                }
            ddsdde[p + q * *ntens] = c / jacobian;
        }
    }
}
