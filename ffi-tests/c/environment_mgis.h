/* Calls of the behaviours that MGIS and MTest load. */
#ifndef ENVIRONMENT_MGIS_H
#define ENVIRONMENT_MGIS_H

#ifndef SINGLE
#include "environment_hosts.h"

typedef struct {
    const double *gradients;
    double *thermodynamic_forces;
    const double *mass_density, *material_properties;
    double *internal_state_variables, *stored_energy, *dissipated_energy;
    const double *external_state_variables;
} mgis_state;

typedef struct {
    char *error_message;
    double dt, *K, *rdt, *speed_of_sound;
    mgis_state s0, s1;
} mgis_data;

int ToronHyperelastic_Tridimensional(mgis_data *);
int ToronHyperelastic_PlaneStrain(mgis_data *);
int ToronHyperelastic_Axisymmetrical(mgis_data *);
int ToronLinearElastic_Tridimensional(mgis_data *);
int ToronLinearElastic_PlaneStrain(mgis_data *);
int ToronLinearElastic_Axisymmetrical(mgis_data *);

/* Requests, measures and operators: what there is, and what means nothing. */
static const double mgis_requests[][3] = {
    {0, 0, SIGNALLING}, {4, 0, 0}, {4, 1, 1}, {4, 2, 2}, {4, 0, 3}, {104, 1, 0}, {-1, 0, 0}, {97, 0, 1}, {100, 2, NAN},
    {SIGNALLING, 0, 0}, {4, NAN, 0}, {4, 0, SIGNALLING}, {7, 0, 0},
};

/* The data of a call; the arrays have room for either law, in three dimensions. */
static mgis_data mgis_call(size_t next, double *properties, double *f0, double *f1, double *old)
{
    double *density = given(&densities[next % COUNT(densities)], 1);
    mgis_data d = {.error_message = text, .dt = 1, .K = reals(81), .rdt = given(&time_increments[next % COUNT(time_increments)], 1),
                   .speed_of_sound = reals(1)};
    d.s0 = (mgis_state){.gradients = f0, .mass_density = density, .material_properties = properties, .internal_state_variables = old};
    d.s1 = (mgis_state){.gradients = f1, .thermodynamic_forces = reals(9), .mass_density = density,
                        .material_properties = properties, .internal_state_variables = reals(STATE), .stored_energy = reals(1)};
    return d;
}

/* Every request on the data of a call. */
#define MGIS_CALLS(function, d)                                    \
    do {                                                           \
        for (size_t k = 0; k < COUNT(mgis_requests); k++) {        \
            for (int c = 0; c < 3; c++)                            \
                put_double(&(d).K[c], mgis_requests[k][c]);        \
            CALL(function(&(d)));                                  \
        }                                                          \
        (d).s1.gradients = NULL;                                   \
        CALL(function(&(d)));                                      \
        CALL(function(NULL));                                      \
    } while (0)

#define MGIS_HYPERELASTIC(name, function)                                                                             \
    static void name(void)                                                                                            \
    {                                                                                                                 \
        point_arrays p;                                                                                               \
        real *increment;                                                                                              \
        for (size_t next = 0; next_umat(&next, &p, &increment);) {                                                    \
            mgis_data d = mgis_call(next, p.yarn, given(deformations[next % GOOD_DEFORMATIONS], 9), p.f, p.old);      \
            MGIS_CALLS(function, d);                                                                                  \
        }                                                                                                             \
    }

#define MGIS_LINEAR_ELASTIC(name, function)                                                                           \
    static void name(void)                                                                                            \
    {                                                                                                                 \
        for (size_t next = 0; next < COUNT(linear_yarns) * DEFORMATIONS * COUNT(linear_states); next += stride) {     \
            size_t state = next % COUNT(linear_states), f = next / COUNT(linear_states) % DEFORMATIONS;               \
            size_t yarn = next / COUNT(linear_states) / DEFORMATIONS;                                                 \
            double *f0 = given(deformations[next % 5 == 0 ? f : next % GOOD_DEFORMATIONS], 9);                        \
            mgis_data d = mgis_call(next, given(linear_yarns[yarn], LINEAR), f0, given(deformations[f], 9),           \
                                    given(linear_states[state], LINEAR_STATE));                                       \
            ARGUMENTS("yarn %zu, F %zu, old state %zu", yarn, f, state);                                              \
            MGIS_CALLS(function, d);                                                                                  \
            release();                                                                                                \
        }                                                                                                             \
    }

MGIS_HYPERELASTIC(mgis_hyperelastic, ToronHyperelastic_Tridimensional)
MGIS_HYPERELASTIC(mgis_hyperelastic_in_plane_strain, ToronHyperelastic_PlaneStrain)
MGIS_HYPERELASTIC(mgis_hyperelastic_of_revolution, ToronHyperelastic_Axisymmetrical)
MGIS_LINEAR_ELASTIC(mgis_linear_elastic, ToronLinearElastic_Tridimensional)
MGIS_LINEAR_ELASTIC(mgis_linear_elastic_in_plane_strain, ToronLinearElastic_PlaneStrain)
MGIS_LINEAR_ELASTIC(mgis_linear_elastic_of_revolution, ToronLinearElastic_Axisymmetrical)

#endif
#endif
