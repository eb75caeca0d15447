/* Every entry in every floating-point environment that a host may have: nothing traps, every bit is the same, and the
 * environment is the caller's afterwards.
 *
 * Runs everything and prints what is wrong. Options:
 *     --list      then prints the names of the entries that it has called
 *     --sample    one in so many cases
 *     --default   in the default environment only, for checks of another kind
 *     --sums      that too, and prints of each entry how often it was called and the sum of what it gave back
 *     --trace ENTRY   with --sums: the sum after each call of this entry too
 */
#define _GNU_SOURCE /* sigaction, fork, feenableexcept */
#include "environment_frictional.h"
#include "environment_hosts.h"
#include "environment_laws.h"
#include "environment_linear_hosts.h"
#include "environment_mgis.h"

/* ---- All of them */

static const struct {
    const char *name;
    void (*cases)(void);
} all[] = {
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
    {"toron_abaqus_umat_f64", abaqus_umat},
    {"toron_abaqus_umat_tangent_f64", abaqus_umat_tangent},
    {"toron_lsdyna_bulk_and_shear_f64", lsdyna_bulk_and_shear},
    {"toron_abaqus_linear_umat_f64", abaqus_linear_umat},
    {"toron_lsdyna_linear_bulk_and_shear_f64", lsdyna_linear_bulk_and_shear},
    {"toron_abaqus_frictional_umat_f64", abaqus_frictional_umat},
    {"toron_lsdyna_frictional_bulk_and_shear_f64", lsdyna_frictional_bulk_and_shear},
#endif
    {IN_BOTH(toron_preset), preset},
    {IN_BOTH(toron_hyperelastic_prepare), hyperelastic_prepare},
    {IN_BOTH(toron_hyperelastic_point), hyperelastic_point},
    {IN_BOTH(toron_hyperelastic_point_with_properties), hyperelastic_point_with_properties},
    {IN_BOTH(toron_hyperelastic_block), hyperelastic_block},
    {IN_BOTH(toron_hyperelastic_block_with_properties), hyperelastic_block_with_properties},
    {IN_BOTH(toron_linear_elastic_prepare), linear_elastic_prepare},
    {IN_BOTH(toron_linear_elastic_axes), linear_elastic_axes},
    {IN_BOTH(toron_linear_elastic_point), linear_elastic_point},
    {IN_BOTH(toron_linear_elastic_point_with_properties), linear_elastic_point_with_properties},
    {IN_BOTH(toron_linear_elastic_increment), linear_elastic_increment},
    {IN_BOTH(toron_linear_elastic_block), linear_elastic_block},
    {IN_BOTH(toron_linear_elastic_block_with_properties), linear_elastic_block_with_properties},
    {IN_BOTH(toron_frictional_prepare), frictional_prepare},
    {IN_BOTH(toron_frictional_point), frictional_point},
    {IN_BOTH(toron_frictional_point_with_properties), frictional_point_with_properties},
    {IN_BOTH(toron_frictional_block), frictional_block},
    {IN_BOTH(toron_frictional_block_with_properties), frictional_block_with_properties},
    {IN_BOTH(toron_abaqus_vumat), abaqus_vumat},
    {IN_BOTH(toron_lsdyna_umat), lsdyna_umat},
    {IN_BOTH(toron_lsdyna_utan), lsdyna_utan},
    {IN_BOTH(toron_lsdyna_umat_vector), lsdyna_umat_vector},
    {IN_BOTH(toron_lsdyna_utan_vector), lsdyna_utan_vector},
    {IN_BOTH(toron_abaqus_linear_vumat), abaqus_linear_vumat},
    {IN_BOTH(toron_lsdyna_linear_umat), lsdyna_linear_umat},
    {IN_BOTH(toron_lsdyna_linear_utan), lsdyna_linear_utan},
    {IN_BOTH(toron_lsdyna_linear_umat_vector), lsdyna_linear_umat_vector},
    {IN_BOTH(toron_lsdyna_linear_utan_vector), lsdyna_linear_utan_vector},
    {IN_BOTH(toron_abaqus_frictional_vumat), abaqus_frictional_vumat},
    {IN_BOTH(toron_lsdyna_frictional_umat), lsdyna_frictional_umat},
    {IN_BOTH(toron_lsdyna_frictional_utan), lsdyna_frictional_utan},
    {IN_BOTH(toron_lsdyna_frictional_umat_vector), lsdyna_frictional_umat_vector},
    {IN_BOTH(toron_lsdyna_frictional_utan_vector), lsdyna_frictional_utan_vector},
    {IN_BOTH(toron_openradioss_lecm), openradioss_lecm},
    {IN_BOTH(toron_openradioss_listing), openradioss_listing},
    {IN_BOTH(toron_openradioss_luser), openradioss_luser},
#ifndef SINGLE
    {"ToronHyperelastic_Tridimensional", mgis_hyperelastic},
    {"ToronHyperelastic_PlaneStrain", mgis_hyperelastic_in_plane_strain},
    {"ToronHyperelastic_Axisymmetrical", mgis_hyperelastic_of_revolution},
    {"ToronLinearElastic_Tridimensional", mgis_linear_elastic},
    {"ToronLinearElastic_PlaneStrain", mgis_linear_elastic_in_plane_strain},
    {"ToronLinearElastic_Axisymmetrical", mgis_linear_elastic_of_revolution},
    {"ToronFrictional_Tridimensional", mgis_frictional},
    {"ToronFrictional_PlaneStrain", mgis_frictional_in_plane_strain},
    {"ToronFrictional_Axisymmetrical", mgis_frictional_of_revolution},
    /* The last ones, since they may end the process. */
    {"HYPERELASTIC", calculix},
    {"LINEARELASTIC", calculix_linear},
    {"FRICTIONAL", calculix_frictional},
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
        else if (strcmp(argv[i], "--sums") == 0)
            environment_count = 1, sums_wanted = 1;
        else if (strcmp(argv[i], "--trace") == 0 && i + 1 < argc)
            traced = argv[++i];
    start();
#ifndef SINGLE
    atexit(at_exit);
#endif
    for (size_t i = 0; i < COUNT(all); i++) {
        entries[++entry].name = all[i].name;
        ARGUMENTS("no arguments to tell");
        at_level(TORON_LEVEL_BEST);
        all[i].cases();
        release();
    }
    report();
#ifndef SINGLE
    phase = DONE;
#endif
    for (int i = 0; list && i <= entry; i++)
        puts(entries[i].name);
    if (sums_wanted)
        print_sums();
    return finish();
}

