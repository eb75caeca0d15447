/* Metal plasticity (von Mises) in plane stress, linear isotropic hardening, small increments.
 *
 *   q^2 = (s11 + s22)^2 / 4 + 3 (s11 - s22)^2 / 4 + 3 s12^2,   yield at q = sigma_0 + H p
 *
 * The flow is d eps_p = gamma P sigma; the return is one equation for gamma, since P and the elastic stiffness share
 * their axes (sum, difference, shear).
 *
 * props   Young's modulus, Poisson's ratio, sigma_0, H
 * statev  equivalent plastic strain p
 * ddsdde  d(increment of stress)/d(increment of strain), consistent with the return; 11 22 12
 * sse     the elastic energy of the stress; spd plastic work
 */
#include <math.h>

void umat_(double *stress, double *statev, double *ddsdde, double *sse, double *spd, double *scd, double *rpl,
           double *ddsddt, double *drplde, double *drpldt, double *stran, double *dstran, double *time, double *dtime,
           double *temp, double *dtemp, double *predef, double *dpred, char *cmname, int *ndi, int *nshr, int *ntens,
           int *nstatv, double *props, int *nprops, double *coords, double *drot, double *pnewdt, double *celent,
           double *dfgrd0, double *dfgrd1, int *noel, int *npt, int *layer, int *kspt, int *jstep, int *kinc)
{
    const double young = props[0], poisson = props[1], hardening = props[3];
    const double with_sum = young / (1 - poisson), shear = young / (2 * (1 + poisson));

    /* Sum, difference and shear of the trial stress */
    const double sum = stress[0] + stress[1] + with_sum * (dstran[0] + dstran[1]);
    const double difference = stress[0] - stress[1] + 2 * shear * (dstran[0] - dstran[1]);
    const double s12 = stress[2] + shear * dstran[2];

    /* gamma: the residual q - sigma_y falls and is convex, so that Newton's steps from 0 do not overshoot. */
    double gamma = 0, a, d, q, yield;
    for (int iteration = 0; iteration < 50; iteration++) {
        a = sum / (1 + with_sum / 3 * gamma);
        d = 1 / (1 + 2 * shear * gamma);
        const double across = d * d * (0.75 * difference * difference + 3 * s12 * s12);
        q = sqrt(0.25 * a * a + across);
        yield = props[2] + hardening * (statev[0] + 2.0 / 3 * gamma * q);
        const double residual = q - yield;
        if (residual <= 1e-14 * yield)
            break; /* elastic, or found */
        const double dq = -(0.25 * a * a * with_sum / 3 / (1 + with_sum / 3 * gamma) + across * 2 * shear * d) / q;
        gamma -= residual / (dq - hardening * 2.0 / 3 * (q + gamma * dq));
    }

    stress[0] = 0.5 * (a + d * difference);
    stress[1] = 0.5 * (a - d * difference);
    stress[2] = d * s12;

    /* Inverse of the elastic compliance + gamma P, by its axes */
    const double on_sum = 0.5 * with_sum / (1 + with_sum / 3 * gamma), on_difference = shear * d;
    double tangent[3][3] = {{on_sum + on_difference, on_sum - on_difference, 0},
                            {on_sum - on_difference, on_sum + on_difference, 0},
                            {0, 0, shear * d}};
    if (gamma > 0) {
        /* P sigma, and the direction that the consistency takes out */
        const double flow[3] = {(2 * stress[0] - stress[1]) / 3, (2 * stress[1] - stress[0]) / 3, 2 * stress[2]};
        double along[3], power = 0;
        for (int i = 0; i < 3; i++) {
            along[i] = tangent[i][0] * flow[0] + tangent[i][1] * flow[1] + tangent[i][2] * flow[2];
            power += flow[i] * along[i];
        }
        power += 4.0 / 9 * q * q * hardening / (1 - 2.0 / 3 * hardening * gamma);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                tangent[i][j] -= along[i] * along[j] / power;
        statev[0] += 2.0 / 3 * gamma * q;
        *spd += 2.0 / 3 * gamma * q * q;
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            ddsdde[i + 3 * j] = tangent[i][j];
    *sse = (stress[0] * stress[0] + stress[1] * stress[1] - 2 * poisson * stress[0] * stress[1]) / (2 * young)
         + stress[2] * stress[2] / (2 * shear);
}
