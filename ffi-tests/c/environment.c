/* Every entry in every floating-point environment that a host may have: nothing traps, every bit is the same, and the
 * environment is the caller's afterwards.
 *
 * Runs everything and prints what is wrong. Options:
 *     --list      then prints the names of the entries that it has called
 *     --sample    one in so many cases
 *     --default   in the default environment only, for checks of another kind
 */
#define _GNU_SOURCE /* sigaction, fork, feenableexcept */
#include "environment_hosts.h"
#include "environment_laws.h"

/* ---- All of them */

static const struct {
    const char *name;
    void (*cases)(void);
} all[] = {
#define TEXT_OF(name) #name
#define TEXT(name) TEXT_OF(name)
#define IN_BOTH(name) TEXT(ENTRY(name))
#ifndef SINGLE
    {"toron_version", version},
    {"toron_abi_version", abi_version},
    {"toron_status_message", status_message},
    {"toron_property_count", property_count},
    {"toron_property", property},
    {"toron_property_index", property_index},
    {"toron_state_count", state_count},
    {"toron_state_variable", state_variable},
    {"toron_state_index", state_index},
    {"toron_hyperelastic_least_acoustic_eigenvalue_f64", least_acoustic_eigenvalue},
    {"toron_linear_elastic_validate_f64", linear_elastic_validate},
    {"toron_linear_elastic_axes_f64", linear_elastic_axes},
    {"toron_linear_elastic_step_f64", linear_elastic_step},
    {"toron_linear_elastic_step_tangent_f64", linear_elastic_step_tangent},
    {"toron_linear_elastic_increment_f64", linear_elastic_increment},
    {"toron_abaqus_umat_f64", abaqus_umat},
    {"toron_abaqus_umat_tangent_f64", abaqus_umat_tangent},
    {"toron_lsdyna_bulk_and_shear_f64", lsdyna_bulk_and_shear},
#endif
    {IN_BOTH(toron_preset), preset},
    {IN_BOTH(toron_hyperelastic_validate), hyperelastic_validate},
    {IN_BOTH(toron_hyperelastic_point), hyperelastic_point},
    {IN_BOTH(toron_hyperelastic_point_tangent), hyperelastic_point_tangent},
    {IN_BOTH(toron_hyperelastic_block), hyperelastic_block},
    {IN_BOTH(toron_hyperelastic_block_tangent), hyperelastic_block_tangent},
    {IN_BOTH(toron_linear_elastic_block), linear_elastic_block},
    {IN_BOTH(toron_abaqus_vumat), abaqus_vumat},
    {IN_BOTH(toron_lsdyna_umat), lsdyna_umat},
    {IN_BOTH(toron_lsdyna_utan), lsdyna_utan},
    {IN_BOTH(toron_lsdyna_umat_vector), lsdyna_umat_vector},
    {IN_BOTH(toron_lsdyna_utan_vector), lsdyna_utan_vector},
#ifndef SINGLE
    {"HYPERELASTIC", calculix}, /* the last one, since it may end the process */
#endif
};

int main(int argc, char **argv)
{
    int list = 0;
    for (int i = 1; i < argc; i++)
        if (strcmp(argv[i], "--list") == 0)
            list = 1;
        else if (strcmp(argv[i], "--sample") == 0)
            stride = 37; /* no divisor of the numbers of yarns, deformations, ... */
        else if (strcmp(argv[i], "--default") == 0)
            environment_count = 1;
    start();
#ifndef SINGLE
    atexit(at_exit);
#endif
    for (size_t i = 0; i < COUNT(all); i++) {
        entries[++entry].name = all[i].name;
        ARGUMENTS("no arguments to tell");
        all[i].cases();
        release();
    }
    report();
#ifndef SINGLE
    phase = DONE;
#endif
    for (int i = 0; list && i <= entry; i++)
        puts(entries[i].name);
    return finish();
}

