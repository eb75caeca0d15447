/* Evaluates 1024 moderate deformations through one entry of the library, named on the command line. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "toron.h"

enum { N = 1024, PROPERTIES = TORON_HYPERELASTIC_PROPERTIES, STATE = TORON_HYPERELASTIC_STATE };
enum { FRICTIONAL = TORON_FRICTIONAL_PROPERTIES, FRICTIONAL_STATE = TORON_FRICTIONAL_STATE };
enum { LINEAR = TORON_LINEAR_ELASTIC_PROPERTIES, LINEAR_STATE = TORON_LINEAR_ELASTIC_STATE };

static const double rest[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

/* Columns of F, point by point and component-major, in both precisions; outputs. */
static double point[N][9], gradient[9][N], rests[9][N], state[FRICTIONAL_STATE][N], stress[6][N], tangent[36][N], axes[9][N];
static float point_single[N][9], gradient_single[9][N], rests_single[9][N], state_single[STATE][N], stress_single[6][N];
static float tangent_single[36][N];
static int32_t status[N];

static double values[PROPERTIES], frictional_values[FRICTIONAL], linear_values[LINEAR];
static float values_single[PROPERTIES], linear_values_single[LINEAR];
static toron_hyperelastic_f64 law;
static toron_hyperelastic_f32 law_single;
static toron_frictional_f64 frictional_law;
static toron_linear_elastic_f64 linear_law;
static toron_linear_elastic_f32 linear_law_single;

static void expect(int32_t code, const char *what)
{
    if (code != 0) {
        fprintf(stderr, "%s: %d\n", what, code);
        exit(1);
    }
}

/* A point every step of a path: stretched up to 3 %, compacted to 70 %, sheared, turned a little. */
static void deform(void)
{
    for (int i = 0; i < N; i++) {
        double t = (double)i / N;
        double columns[9] = {1 + 0.03 * t, 0.02 * t, -0.01, 0.3 * t, 1 - 0.3 * t, 0.1, -0.2 * t, 0.05, 1 - 0.1 * t};
        for (int c = 0; c < 9; c++) {
            point[i][c] = gradient[c][i] = columns[c];
            point_single[i][c] = gradient_single[c][i] = (float)columns[c];
            rests[c][i] = axes[c][i] = rest[c];
            rests_single[c][i] = (float)rest[c];
        }
    }
}

static void prepare(void)
{
    expect(toron_preset_f64("kevlar-km2-600", "mm-tonne-s", values, PROPERTIES, NULL, NULL, 0), "preset");
    expect(toron_preset_f32("kevlar-km2-600", "mm-tonne-s", values_single, PROPERTIES, NULL, NULL, 0), "preset");
    expect(toron_preset_f64("kevlar-km2-600-linear", "mm-tonne-s", linear_values, LINEAR, NULL, NULL, 0), "preset");
    expect(toron_preset_f32("kevlar-km2-600-linear", "mm-tonne-s", linear_values_single, LINEAR, NULL, NULL, 0), "preset");
    expect(toron_preset_f64("kevlar-km2-600-frictional", "mm-tonne-s", frictional_values, FRICTIONAL, NULL, NULL, 0), "preset");
    expect(toron_frictional_prepare_f64(&frictional_law, sizeof frictional_law, frictional_values, FRICTIONAL, NULL, 0), "law");
    expect(toron_hyperelastic_prepare_f64(&law, sizeof law, values, PROPERTIES, NULL, 0), "law");
    expect(toron_hyperelastic_prepare_f32(&law_single, sizeof law_single, values_single, PROPERTIES, NULL, 0), "law");
    expect(toron_linear_elastic_prepare_f64(&linear_law, sizeof linear_law, linear_values, LINEAR, NULL, 0), "law");
    expect(toron_linear_elastic_prepare_f32(&linear_law_single, sizeof linear_law_single, linear_values_single, LINEAR, NULL, 0),
           "law");
}

/* ---- One point a call, of the hyperelastic law */

static double s[6], c[36], old[STATE], new[STATE];
static float s_single[6], old_single[STATE], new_single[STATE];

static void run_points(const toron_hyperelastic_f64 *prepared, double *to)
{
    toron_point_f64 one = {.size = sizeof one, .state_old = old, .state_new = new, .stress = s, .tangent = to,
                           .measure = TORON_TANGENT_JAUMANN};
    for (int i = 0; i < N; i++) {
        one.deformation_gradient = point[i];
        expect(prepared != NULL ? toron_hyperelastic_point_f64(prepared, &one, NULL, 0)
                                : toron_hyperelastic_point_with_properties_f64(values, PROPERTIES, &one, NULL, 0), "point");
    }
}

static void point_f64(void) { run_points(NULL, NULL); }
static void point_prepared_f64(void) { run_points(&law, NULL); }
static void point_tangent_f64(void) { run_points(&law, c); }

static void point_prepared_f32(void)
{
    toron_point_f32 one = {.size = sizeof one, .state_old = old_single, .state_new = new_single, .stress = s_single};
    for (int i = 0; i < N; i++) {
        one.deformation_gradient = point_single[i];
        expect(toron_hyperelastic_point_f32(&law_single, &one, NULL, 0), "point");
    }
}

static void umat_f64(void)
{
    double energy = 0, cut = 1;
    for (int i = 0; i < N; i++) {
        double kept[STATE] = {0};
        expect(toron_abaqus_umat_f64(s, kept, &energy, &cut, point[i], values, PROPERTIES, STATE, 3, 3, 1, NULL, 0), "UMAT");
    }
}

static void umat_tangent_f64(void)
{
    double energy = 0, cut = 1;
    for (int i = 0; i < N; i++) {
        double kept[STATE] = {0};
        expect(toron_abaqus_umat_tangent_f64(s, kept, c, &energy, &cut, point[i], values, PROPERTIES, STATE, 3, 3, 1, NULL, 0), "UMAT");
    }
}

static void lsdyna_f64(void)
{
    for (int i = 0; i < N; i++) {
        double history[STATE + 9] = {0};
        int failed;
        memcpy(history + STATE, point[i], sizeof point[i]);
        expect(toron_lsdyna_umat_f64(values, s, history, STATE, &failed, NULL, 0), "umat");
    }
}

static void lsdyna_tangent_f64(void)
{
    for (int i = 0; i < N; i++) {
        double history[STATE + 9] = {0};
        memcpy(history + STATE, point[i], sizeof point[i]);
        expect(toron_lsdyna_utan_f64(values, history, STATE, c, NULL, 0), "utan");
    }
}

/* ---- The law with friction: its fibres slide at most of the deformations */

static void run_frictional_points(double *to)
{
    double before[FRICTIONAL_STATE] = {0}, after[FRICTIONAL_STATE];
    toron_point_f64 one = {.size = sizeof one, .state_old = before, .state_new = after, .stress = s, .tangent = to,
                           .measure = TORON_TANGENT_JAUMANN};
    for (int i = 0; i < N; i++) {
        one.deformation_gradient = point[i];
        expect(toron_frictional_point_f64(&frictional_law, &one, NULL, 0), "point");
    }
}

static void frictional_point_f64(void) { run_frictional_points(NULL); }
static void frictional_point_tangent_f64(void) { run_frictional_points(c); }

static void frictional_umat_f64(void)
{
    double energy = 0, lost = 0, cut = 1;
    for (int i = 0; i < N; i++) {
        double kept[FRICTIONAL_STATE] = {0};
        expect(toron_abaqus_frictional_umat_f64(s, kept, NULL, &energy, &lost, &cut, point[i], frictional_values, FRICTIONAL,
                                                FRICTIONAL_STATE, 3, 3, 1, NULL, 0), "UMAT");
    }
}

static void frictional_block_f64(void)
{
    toron_block_f64 block = {.size = sizeof block, .n = N, .deformation_gradient = {gradient[0]}, .stress = {stress[0]},
                             .energies_old = state[0], .energies = state[0], .invariants_old = state[4], .invariants = state[4],
                             .failure_old = state[8], .failure = state[8], .status = status};
    expect(toron_frictional_block_f64(&frictional_law, &block, NULL, 0), "block");
}

/* ---- The same of the linear elastic law, from rest to the deformation in one step */

static void run_steps(int32_t rotation, double *to)
{
    double turning[9];
    toron_linear_point_f64 one = {.size = sizeof one, .rotation = rotation, .f_old = rest, .state_old = old, .state_new = new,
                                  .stress = s, .tangent = to, .measure = TORON_TANGENT_JAUMANN, .axes = turning};
    for (int i = 0; i < N; i++) {
        memcpy(turning, rest, sizeof rest);
        one.f_new = point[i];
        expect(toron_linear_elastic_point_f64(&linear_law, &one, NULL, 0), "step");
    }
}

static void linear_point_f64(void) { run_steps(TORON_ROTATION_FIBRE, NULL); }
static void linear_point_polar_f64(void) { run_steps(TORON_ROTATION_POLAR, NULL); }
static void linear_point_spin_f64(void) { run_steps(TORON_ROTATION_SPIN, NULL); }
static void linear_point_tangent_f64(void) { run_steps(TORON_ROTATION_FIBRE, c); }
static void linear_point_spin_tangent_f64(void) { run_steps(TORON_ROTATION_SPIN, c); }

static void linear_increment_f64(void)
{
    for (int i = 0; i < N; i++) {
        const double strain[6] = {point[i][0] - 1, point[i][4] - 1, point[i][8] - 1, point[i][1], point[i][5], point[i][6]};
        toron_linear_increment_f64 one = {.size = sizeof one, .strain = strain, .state_old = old, .state_new = new, .stress = s};
        expect(toron_linear_elastic_increment_f64(&linear_law, &one, NULL, 0), "increment");
    }
}

static void run_linear_umats(double *to)
{
    double energy = 0, cut = 1;
    for (int i = 0; i < N; i++) {
        double kept[LINEAR_STATE] = {0};
        expect(toron_abaqus_linear_umat_f64(s, kept, to, &energy, &cut, rest, point[i], linear_values, LINEAR, LINEAR_STATE, 3, 3, 1,
                                            NULL, 0), "UMAT");
    }
}

static void linear_umat_f64(void) { run_linear_umats(NULL); }
static void linear_umat_tangent_f64(void) { run_linear_umats(c); }

static void linear_lsdyna_f64(void)
{
    for (int i = 0; i < N; i++) {
        double history[LINEAR_STATE + 18] = {0};
        int failed;
        memcpy(history + LINEAR_STATE + 9, point[i], sizeof point[i]);
        expect(toron_lsdyna_linear_umat_f64(linear_values, s, history, LINEAR_STATE + 9, &failed, NULL, 0), "umat");
    }
}

/* ---- Blocks of all points */

static void run_block(int with_state, double *to)
{
    toron_block_f64 block = {.size = sizeof block, .n = N, .measure = TORON_TANGENT_JAUMANN, .deformation_gradient = {gradient[0]},
                             .stress = {stress[0]}, .tangent = to, .status = status};
    if (with_state) {
        block.energies_old = block.energies = state[0];
        block.invariants_old = block.invariants = state[4];
        block.failure_old = block.failure = state[8];
    }
    expect(toron_hyperelastic_block_f64(&law, &block, NULL, 0), "block");
}

static void run_block_single(int with_state, float *to)
{
    toron_block_f32 block = {.size = sizeof block, .n = N, .measure = TORON_TANGENT_JAUMANN,
                             .deformation_gradient = {gradient_single[0]}, .stress = {stress_single[0]}, .tangent = to,
                             .status = status};
    if (with_state) {
        block.energies_old = block.energies = state_single[0];
        block.invariants_old = block.invariants = state_single[4];
        block.failure_old = block.failure = state_single[8];
    }
    expect(toron_hyperelastic_block_f32(&law_single, &block, NULL, 0), "block");
}

static void block_stress_f64(void) { run_block(0, NULL); }
static void block_state_f64(void) { run_block(1, NULL); }
static void block_tangent_f64(void) { run_block(0, tangent[0]); }
static void block_stress_f32(void) { run_block_single(0, NULL); }
static void block_state_f32(void) { run_block_single(1, NULL); }
static void block_tangent_f32(void) { run_block_single(0, tangent_single[0]); }

static void run_linear_block(int32_t rotation, double *to)
{
    toron_linear_block_f64 steps = {.size = sizeof steps, .n = N, .rotation = rotation, .measure = TORON_TANGENT_JAUMANN,
                                    .f_old = {rests[0]}, .f_new = {gradient[0]}, .state_old = state[0], .state_new = state[0],
                                    .stress = {stress[0]}, .tangent = to, .status = status};
    if (rotation == TORON_ROTATION_SPIN)
        steps.axes = axes[0];
    expect(toron_linear_elastic_block_f64(&linear_law, &steps, NULL, 0), "linear block");
}

static void linear_block_f64(void) { run_linear_block(TORON_ROTATION_FIBRE, NULL); }
static void linear_block_polar_f64(void) { run_linear_block(TORON_ROTATION_POLAR, NULL); }
static void linear_block_spin_f64(void) { run_linear_block(TORON_ROTATION_SPIN, NULL); }
static void linear_block_tangent_f64(void) { run_linear_block(TORON_ROTATION_FIBRE, tangent[0]); }

static void linear_block_f32(void)
{
    toron_linear_block_f32 steps = {.size = sizeof steps, .n = N, .f_old = {rests_single[0]}, .f_new = {gradient_single[0]},
                                    .state_old = state_single[0], .state_new = state_single[0], .stress = {stress_single[0]},
                                    .status = status};
    expect(toron_linear_elastic_block_f32(&linear_law_single, &steps, NULL, 0), "linear block");
}

/* The symmetric part of F for the stretch, and no strain increment. */
#define RUN_VUMAT(real, precision, entry, properties, count, variables)                                                           \
    do {                                                                                                                          \
        static real stretch[6][N], before[6][N], ones[N], none[STATE][N], to[STATE][N], out[6][N], energy[2][N];                  \
        static const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};                                             \
        for (int i = 0; i < N; i++) {                                                                                             \
            ones[i] = 1;                                                                                                          \
            for (int k = 0; k < 6; k++) {                                                                                         \
                stretch[k][i] = (real)(0.5 * (point[i][3 * column[k] + row[k]] + point[i][3 * row[k] + column[k]]));              \
                before[k][i] = k < 3;                                                                                             \
            }                                                                                                                     \
        }                                                                                                                         \
        toron_vumat_##precision block = {                                                                                         \
            .size = sizeof block, .nblock = N, .ndir = 3, .nshr = 3, .nstatev = variables, .nprops = count, .step_time = 1,        \
            .total_time = 1, .props = properties, .density = ones, .strain_inc = none[0], .stretch_old = before[0],               \
            .stretch_new = stretch[0], .stress_old = none[0], .state_old = none[0], .ener_intern_old = none[0],                   \
            .ener_inelas_old = none[0], .stress_new = out[0], .state_new = to[0], .ener_intern_new = energy[0],                   \
            .ener_inelas_new = energy[1]};                                                                                        \
        expect(entry(&block, NULL, 0), "VUMAT");                                                                                  \
    } while (0)

static void vumat_f64(void) { RUN_VUMAT(double, f64, toron_abaqus_vumat_f64, values, PROPERTIES, STATE); }
static void vumat_f32(void) { RUN_VUMAT(float, f32, toron_abaqus_vumat_f32, values_single, PROPERTIES, STATE); }
static void linear_vumat_f64(void) { RUN_VUMAT(double, f64, toron_abaqus_linear_vumat_f64, linear_values, LINEAR, LINEAR_STATE); }

static void lsdyna_vector_f64(void)
{
    static double histories[STATE + 9][N];
    static int failed[N];
    memcpy(histories[STATE], gradient, sizeof gradient);
    expect(toron_lsdyna_umat_vector_f64(values, stress[0], stress[1], stress[2], stress[3], stress[4], stress[5], histories[0], STATE,
                                        1, N, N, failed, NULL, 0), "umat_vector");
}

static void linear_lsdyna_vector_f64(void)
{
    static double histories[LINEAR_STATE + 18][N];
    static int failed[N];
    memcpy(histories[LINEAR_STATE + 9], gradient, sizeof gradient);
    expect(toron_lsdyna_linear_umat_vector_f64(linear_values, stress[0], stress[1], stress[2], stress[3], stress[4], stress[5],
                                               histories[0], LINEAR_STATE + 9, 1, N, N, failed, NULL, 0), "umat_vector");
}

/* Groups as the solver has them. */
static void run_groups(int32_t number, const double *properties, size_t count)
{
    enum { GROUP = 128, PARAMETERS = 16, VARIABLES = 32 };
    static double uvar[VARIABLES * GROUP], off[GROUP], speed[GROUP];
    const double density = 1;
    double card[PROPERTIES + 1] = {0}, uparam[PARAMETERS], modulus;
    int32_t parameters, variables;
    memcpy(card, properties, count * sizeof *properties);
    expect(toron_openradioss_lecm_f64(number, card, count + 1, uparam, PARAMETERS, &parameters, &variables, &modulus, NULL, 0), "lecm");
    expect(variables > VARIABLES, "state variables of a group");
    for (int first = 0; first < N; first += GROUP) {
        double *f[9], *to[6];
        for (int k = 0; k < 9; k++)
            f[k] = gradient[k] + first;
        for (int k = 0; k < 6; k++)
            to[k] = stress[k] + first;
        memset(uvar, 0, sizeof uvar);
        for (int i = 0; i < GROUP; i++)
            off[i] = 1;
        expect(toron_openradioss_luser_f64(GROUP, parameters, variables, 1e-6, uparam, NULL, &density, f[0], f[4], f[8], f[3], f[7], f[2],
                                           f[1], f[5], f[6], to[0], to[1], to[2], to[3], to[4], to[5], NULL, NULL, NULL, NULL, NULL,
                                           NULL, speed, NULL, uvar, off, NULL, NULL, 0), "luser");
    }
}

static void openradioss_f64(void) { run_groups(1, values, PROPERTIES); }
static void linear_openradioss_f64(void) { run_groups(2, linear_values, LINEAR); }

/* ---- What solvers load by themselves */

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
int ToronLinearElastic_Tridimensional(mgis_data *);

static void integrate(int (*behaviour)(mgis_data *), const double *properties, double request)
{
    static const int order[9] = {0, 4, 8, 3, 1, 6, 2, 7, 5};
    static const double start[9] = {1, 1, 1};
    double rdt = 1, energy, operator[54];
    for (int i = 0; i < N; i++) {
        double f[9];
        for (int k = 0; k < 9; k++)
            f[k] = point[i][order[k]];
        operator[0] = request, operator[1] = operator[2] = 0;
        mgis_data view = {.K = operator, .rdt = &rdt,
                          .s0 = {.gradients = start, .thermodynamic_forces = s, .material_properties = properties,
                                 .internal_state_variables = old},
                          .s1 = {.gradients = f, .thermodynamic_forces = s, .material_properties = properties,
                                 .internal_state_variables = new, .stored_energy = &energy}};
        expect(behaviour(&view) != 1, "MGIS");
    }
}

static void mgis_f64(void) { integrate(ToronHyperelastic_Tridimensional, values, 0); }
static void mgis_tangent_f64(void) { integrate(ToronHyperelastic_Tridimensional, values, 4); }
static void linear_mgis_f64(void) { integrate(ToronLinearElastic_Tridimensional, linear_values, 0); }
static void linear_mgis_tangent_f64(void) { integrate(ToronLinearElastic_Tridimensional, linear_values, 4); }

typedef void behaviour(const char *, const int *, const int *, const int *, const double *, const double *, const double *,
                       const double *, const double *, const double *, const double *, const double *, const int *,
                       const double *, const double *, const double *, const double *, const int *, const int *,
                       const int *, const int *, const double *, double *, double *, double *, const int *,
                       const double *, const double *, double *, const int *, int);
extern behaviour HYPERELASTIC, LINEARELASTIC;

static void run_increments(behaviour *law_of_the_deck, const double *properties, int count, int variables)
{
    static const int first[6] = {0, 3, 6, 0, 0, 3}, second[6] = {0, 3, 6, 3, 6, 6};
    static const double zeros[9] = {0};
    const int one = 1, none = 0, kode = -100 - count;
    double before[LINEAR_STATE + 9] = {0}, after[LINEAR_STATE + 9], stiffness[21], step = 1;
    char name[81];
    memset(name, ' ', sizeof name);
    for (int i = 0; i < N; i++) {
        double strain[6];
        for (int k = 0; k < 6; k++) {
            const double *a = point[i] + first[k], *b = point[i] + second[k];
            strain[k] = 0.5 * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2] - (k < 3));
        }
        law_of_the_deck(name, &one, &one, &kode, properties, strain, zeros, zeros, zeros, zeros, point[i], zeros, &none, zeros, zeros,
                        zeros, zeros, &one, &none, &one, &variables, before, after, s, stiffness, &none, zeros, zeros, &step, &one, 80);
        expect(step < 1, "CalculiX");
    }
}

static void calculix_f64(void) { run_increments(HYPERELASTIC, values, PROPERTIES, STATE); }
static void linear_calculix_f64(void) { run_increments(LINEARELASTIC, linear_values, LINEAR, LINEAR_STATE + 9); }

/* ---- All of them */

static const struct {
    const char *name;
    void (*run)(void);
} entries[] = {
    {"umat-f64", umat_f64},
    {"umat-tangent-f64", umat_tangent_f64},
    {"point-f64", point_f64},
    {"point-prepared-f64", point_prepared_f64},
    {"point-tangent-f64", point_tangent_f64},
    {"point-prepared-f32", point_prepared_f32},
    {"block-stress-f64", block_stress_f64},
    {"block-state-f64", block_state_f64},
    {"block-tangent-f64", block_tangent_f64},
    {"block-stress-f32", block_stress_f32},
    {"block-state-f32", block_state_f32},
    {"block-tangent-f32", block_tangent_f32},
    {"vumat-f64", vumat_f64},
    {"vumat-f32", vumat_f32},
    {"ls-dyna-f64", lsdyna_f64},
    {"ls-dyna-tangent-f64", lsdyna_tangent_f64},
    {"ls-dyna-vector-f64", lsdyna_vector_f64},
    {"openradioss-f64", openradioss_f64},
    {"mgis-f64", mgis_f64},
    {"mgis-tangent-f64", mgis_tangent_f64},
    {"calculix-f64", calculix_f64},
    {"frictional-point-f64", frictional_point_f64},
    {"frictional-point-tangent-f64", frictional_point_tangent_f64},
    {"frictional-umat-f64", frictional_umat_f64},
    {"frictional-block-f64", frictional_block_f64},
    {"linear-point-f64", linear_point_f64},
    {"linear-point-polar-f64", linear_point_polar_f64},
    {"linear-point-spin-f64", linear_point_spin_f64},
    {"linear-point-tangent-f64", linear_point_tangent_f64},
    {"linear-point-spin-tangent-f64", linear_point_spin_tangent_f64},
    {"linear-increment-f64", linear_increment_f64},
    {"linear-block-f64", linear_block_f64},
    {"linear-block-polar-f64", linear_block_polar_f64},
    {"linear-block-spin-f64", linear_block_spin_f64},
    {"linear-block-tangent-f64", linear_block_tangent_f64},
    {"linear-block-f32", linear_block_f32},
    {"linear-umat-f64", linear_umat_f64},
    {"linear-umat-tangent-f64", linear_umat_tangent_f64},
    {"linear-vumat-f64", linear_vumat_f64},
    {"linear-ls-dyna-f64", linear_lsdyna_f64},
    {"linear-ls-dyna-vector-f64", linear_lsdyna_vector_f64},
    {"linear-openradioss-f64", linear_openradioss_f64},
    {"linear-mgis-f64", linear_mgis_f64},
    {"linear-mgis-tangent-f64", linear_mgis_tangent_f64},
    {"linear-calculix-f64", linear_calculix_f64},
};

int main(int argc, char **argv)
{
    const char *entry = argc > 1 ? argv[1] : "";
    deform();
    prepare();
    for (size_t i = 0; i < sizeof entries / sizeof *entries; i++)
        if (strcmp(entry, entries[i].name) == 0) {
            entries[i].run();
            return 0;
        }
    fprintf(stderr, "%s: no such entry\n", entry);
    return 2;
}
