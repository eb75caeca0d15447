/* The entries behind UMAT, VUMAT, umat41, umat41v and their tangents, called as the solvers' routines are. */
#include "check.h"

/* ---- LS-DYNA */

enum { HISTORY = STATE + 9 };

static void lsdyna_scalar(void)
{
    for (const truth *t = cases; t < cases + case_count; t++) {
        real *cm = copied(t->properties, PROPERTIES), *sig = reals(6), *hsv = filled(0, HISTORY);
        int *failel = guarded(sizeof *failel);
        for (int i = 0; i < 9; i++)
            hsv[STATE + i] = (real)t->f[i];
        int32_t status = TOLD(ENTRY(toron_lsdyna_umat), cm, sig, hsv, STATE, failel);
        CHECK(status == TORON_OK, "case %d: %d", t->id, status);
        check_stress(t, sig, 1);
        check_state(t, hsv, 1);
        CHECK(*failel == (hsv[FAILED] == 1), "case %d", t->id);
        for (int i = 0; i < 9; i++)
            CHECK(hsv[STATE + i] == (real)t->f[i], "case %d: F is read only", t->id);

        real *es = reals(36);
        hsv[FAILED] = 0;
        status = TOLD(ENTRY(toron_lsdyna_utan), cm, hsv, STATE, es);
        CHECK(status == TORON_OK, "case %d: %d", t->id, status);
        check_tangent(t, es, 1, sig, 0);
        hsv[FAILED] = 1;
        status = TOLD(ENTRY(toron_lsdyna_utan), cm, hsv, STATE, es);
        for (int k = 0; k < 36; k++)
            CHECK(status == TORON_OK && es[k] == 0, "case %d: a failed element has no stiffness", t->id);
        release();
    }
}

/* Arrays of nlq elements: `before` of them are below lft, two beyond llt. */
typedef struct {
    int n, lft, llt, nlq;
    real *cm, *sig[6], *hsvs;
    int *failels;
} vector_block;

static vector_block allocate(const truth *first, int n)
{
    enum { BEFORE = 4 };
    vector_block v = {.n = n, .lft = BEFORE + 1, .llt = BEFORE + n, .nlq = BEFORE + n + 2};
    v.cm = copied(first->properties, PROPERTIES);
    for (int c = 0; c < 6; c++)
        v.sig[c] = reals((size_t)v.nlq);
    v.hsvs = reals((size_t)(HISTORY * v.nlq));
    v.failels = guarded((size_t)v.nlq * sizeof(int));
    for (int i = v.lft - 1; i < v.llt; i++) {
        const truth *t = first + (i - v.lft + 1);
        for (int j = 0; j < HISTORY; j++)
            v.hsvs[j * v.nlq + i] = j < STATE ? 0 : (real)t->f[j - STATE];
    }
    return v;
}

#define UTAN_VECTOR ENTRY(toron_lsdyna_utan_vector)

static int32_t umat_vector(const vector_block *v)
{
    return TOLD(ENTRY(toron_lsdyna_umat_vector), v->cm, v->sig[0], v->sig[1], v->sig[2], v->sig[3], v->sig[4], v->sig[5],
                v->hsvs, STATE, v->lft, v->llt, v->nlq, v->failels);
}

static void check_outside(const vector_block *v)
{
    for (int i = 0; i < v->nlq; i++) {
        if (i == v->lft - 1)
            i = v->llt;
        for (int c = 0; c < 6; c++)
            CHECK(untouched(&v->sig[c][i], sizeof(real)), "element %d", i + 1);
        for (int j = 0; j < HISTORY; j++)
            CHECK(untouched(&v->hsvs[j * v->nlq + i], sizeof(real)), "element %d", i + 1);
        CHECK(untouched(&v->failels[i], sizeof(int)), "element %d", i + 1);
    }
}

/* The six components of element i, side by side. */
static const real *stress_of(const vector_block *v, int i)
{
    static real stress[6];
    for (int c = 0; c < 6; c++)
        stress[c] = v->sig[c][i];
    return stress;
}

static void lsdyna_vector(void)
{
    for (int first = 0; first < case_count;) {
        int n = run_of_cases(first, PROPERTIES);
        vector_block v = allocate(&cases[first], n);
        int32_t status = umat_vector(&v);
        CHECK(status == TORON_OK, "%d", status);
        for (int i = v.lft - 1; i < v.llt; i++) {
            const truth *t = &cases[first + i - v.lft + 1];
            check_stress(t, stress_of(&v, i), 1);
            check_state(t, v.hsvs + i, (size_t)v.nlq);
            CHECK(v.failels[i] == (v.hsvs[FAILED * v.nlq + i] == 1), "case %d", t->id);
        }
        check_outside(&v);
        release();
        first += n;
    }
}

/* dsave of elements lft to llt; the others are not touched. */
static void lsdyna_vector_tangents(void)
{
    for (int first = 0; first < case_count;) {
        int n = run_of_cases(first, PROPERTIES);
        vector_block v = allocate(&cases[first], n);
        umat_vector(&v);
        size_t nlq = (size_t)v.nlq;
        real *dsave = reals(36 * nlq);
        for (int i = v.lft - 1; i < v.llt; i++)
            v.hsvs[FAILED * v.nlq + i] = 0;
        int32_t status = TOLD(UTAN_VECTOR, v.cm, v.hsvs, STATE, v.lft, v.llt, v.nlq, dsave);
        CHECK(status == TORON_OK, "%d", status);
        for (int i = v.lft - 1; i < v.llt; i++) {
            check_tangent(&cases[first + i - v.lft + 1], dsave + i, nlq, stress_of(&v, i), 0);
        }
        for (size_t c = 0; c < 36; c++) {
            CHECK(untouched(dsave + c * nlq, (size_t)(v.lft - 1) * sizeof(real)), "before lft");
            CHECK(untouched(dsave + c * nlq + v.llt, (nlq - (size_t)v.llt) * sizeof(real)), "beyond llt");
        }
        release();
        first += n;
    }
    vector_block v = allocate(cases, 2);
    real *dsave = reals(36 * (size_t)v.nlq), *hsv = filled(1, HISTORY);
    REFUSED(TORON_BAD_COUNT, "argument lft is 0; allowed: 1 or more", UTAN_VECTOR, v.cm, v.hsvs, STATE, 0, v.llt, v.nlq, dsave);
    REFUSED(TORON_BAD_LEADING_DIMENSION, "leading dimension, nlq: 1 given, 6 needed", UTAN_VECTOR, v.cm, v.hsvs, STATE, 1, v.llt, 1,
            dsave);
    REFUSED(TORON_STATE_COUNT, "number of history variables, NHV: 3 given, 11 needed", UTAN_VECTOR, v.cm, v.hsvs, 3, v.lft, v.llt,
            v.nlq, dsave);
    REFUSED(TORON_NULL_ARGUMENT, "argument dsave is null", UTAN_VECTOR, v.cm, v.hsvs, STATE, v.lft, v.llt, v.nlq, NULL);
    REFUSED(TORON_NULL_ARGUMENT, "argument hsvs is null", UTAN_VECTOR, v.cm, NULL, STATE, v.lft, v.llt, v.nlq, dsave);
    REFUSED(TORON_NULL_ARGUMENT, "argument cm is null", UTAN_VECTOR, NULL, v.hsvs, STATE, v.lft, v.llt, v.nlq, dsave);
    REFUSED(TORON_NULL_ARGUMENT, "argument hsv is null", ENTRY(toron_lsdyna_utan), v.cm, NULL, STATE, dsave);
    REFUSED(TORON_NULL_ARGUMENT, "argument cm is null", ENTRY(toron_lsdyna_utan), NULL, hsv, STATE, dsave);
    REFUSED(TORON_NULL_ARGUMENT, "argument es is null", ENTRY(toron_lsdyna_utan), v.cm, hsv, STATE, NULL);
    REFUSED(TORON_STATE_COUNT, "number of history variables, NHV: 3 given, 11 needed", ENTRY(toron_lsdyna_utan), v.cm, hsv, 3,
            dsave);
    CHECK(untouched(dsave, 36 * (size_t)v.nlq * sizeof(real)), "nothing is written");
    release();
}

static void lsdyna_bad_elements(void)
{
    const truth *first = cases;
    while (run_of_cases((int)(first - cases), PROPERTIES) < 70)
        first++;
    vector_block v = allocate(first, 70), good = allocate(first, 70);
    umat_vector(&good);
    const int not_finite = v.lft + 10, inverted = v.lft + 66; /* in either chunk of 64 */
    v.hsvs[(STATE + 2) * v.nlq + not_finite] = NAN;
    for (int c = 0; c < 3; c++)
        v.hsvs[(STATE + c) * v.nlq + inverted] *= -1;
    v.hsvs[ENERGIES * v.nlq + inverted] = 3;
    CHECK(umat_vector(&v) == TORON_NOT_FINITE, "the most negative code");
    for (int i = v.lft - 1; i < v.llt; i++) {
        int bad = i == not_finite || i == inverted;
        CHECK(v.failels[i] == (bad || good.failels[i]), "element %d", i + 1);
        for (int c = 0; c < 6; c++)
            CHECK(bad ? v.sig[c][i] == 0 : memcmp(&v.sig[c][i], &good.sig[c][i], sizeof(real)) == 0, "element %d", i + 1);
    }
    CHECK(v.hsvs[ENERGIES * v.nlq + inverted] == 3, "the energy stays");
    CHECK(v.hsvs[FAILED * v.nlq + inverted] == 1 && v.hsvs[ALIVE * v.nlq + inverted] == 0, "it fails");
    check_outside(&v);
    release();
}

static void lsdyna_refused(vector_block v, int32_t wanted, const char *words)
{
    if (wanted == TORON_OK)
        CHECK(umat_vector(&v) == TORON_OK, "%s", text);
    else
        REFUSED(wanted, words, ENTRY(toron_lsdyna_umat_vector), v.cm, v.sig[0], v.sig[1], v.sig[2], v.sig[3], v.sig[4], v.sig[5],
                v.hsvs, STATE, v.lft, v.llt, v.nlq, v.failels);
    CHECK(untouched(v.sig[0], sizeof(real) * 6), "status %d", wanted);
    CHECK(untouched(v.failels, sizeof(int) * 6), "status %d", wanted);
}

static void lsdyna_wrong_calls(void)
{
    const vector_block good = allocate(cases, 2);
    vector_block v = good;
    v.lft = 0;
    lsdyna_refused(v, TORON_BAD_COUNT, "argument lft is 0; allowed: 1 or more");
    v = good, v.llt = v.lft - 2;
    lsdyna_refused(v, TORON_BAD_COUNT, "argument llt (no less than lft - 1) is 3; allowed: 4 or more");
    v = good, v.llt = v.lft - 1; /* no element */
    lsdyna_refused(v, TORON_OK, "");
    v = good, v.nlq = v.llt - 1;
    lsdyna_refused(v, TORON_BAD_LEADING_DIMENSION, "leading dimension, nlq: 5 given, 6 needed");
    v = good, v.cm = NULL;
    lsdyna_refused(v, TORON_NULL_ARGUMENT, "argument cm is null");
    v = good, v.hsvs = NULL;
    lsdyna_refused(v, TORON_NULL_ARGUMENT, "argument hsvs is null");
    v = good, v.sig[4] = NULL;
    lsdyna_refused(v, TORON_NULL_ARGUMENT, "argument sig5 is null");
    v = good, v.cm = filled(-1, PROPERTIES);
    lsdyna_refused(v, TORON_PROPERTY_OUT_OF_BOUNDS,
                   "property 1 (k_el, longitudinal elongation stiffness) is -1.0; allowed: a number from 0 to 1e25");
#define UMAT ENTRY(toron_lsdyna_umat)
    real *sig = reals(6), *hsv = filled(0, HISTORY);
    int *failel = guarded(sizeof *failel);
    REFUSED(TORON_STATE_COUNT, "number of history variables, NHV: 10 given, 11 needed", UMAT, good.cm, sig, hsv, STATE - 1, failel);
    REFUSED(TORON_NULL_ARGUMENT, "argument failel is null", UMAT, good.cm, sig, hsv, STATE, NULL);
    REFUSED(TORON_NULL_ARGUMENT, "argument cm is null", UMAT, NULL, sig, hsv, STATE, failel);
    REFUSED(TORON_NULL_ARGUMENT, "argument sig is null", UMAT, good.cm, NULL, hsv, STATE, failel);
    REFUSED(TORON_NULL_ARGUMENT, "argument hsv is null", UMAT, good.cm, sig, NULL, STATE, failel);
    /* F = 0: the slots of a card without IHYPER. Nothing is written, so that the job stops instead of losing its elements. */
    const char *message = "there is no deformation gradient behind the history: set IHYPER = 1 or -1, and NHV = 11";
    REFUSED(TORON_NO_DEFORMATION_GRADIENT, message, UMAT, good.cm, sig, hsv, STATE, failel);
    CHECK(untouched(sig, 6 * sizeof(real)) && untouched(failel, sizeof *failel), "nothing is written");
    hsv[ALIVE] = 1;
    REFUSED(TORON_NO_DEFORMATION_GRADIENT, message, UMAT, good.cm, sig, hsv, STATE, failel);
    v = good, v.hsvs = filled(0, (size_t)(HISTORY * good.nlq));
    lsdyna_refused(v, TORON_NO_DEFORMATION_GRADIENT, message);
    release();
}

/* A collapsed element of this law's history is deleted by the scalar routine as by the vectorised one, also as its first element. */
static void lsdyna_collapsed(void)
{
    static const double gradients[][9] = {{0, 0, 0, 0, 1, 0, 0, 0, 1}, {1, 0, 0, 0, 0, 0, 0, 0, 1}, {0, 0.7, 0, 0, 1, 0, 0, 0.2, 1},
                                          {0, 0, 1, 0, 0, 0, 0, 0, 0}};
    for (size_t k = 0; k < 2 * sizeof gradients / sizeof *gradients; k++) {
        vector_block v = allocate(cases, 2);
        real *sig = reals(6), *hsv = filled(0, HISTORY);
        int *failel = guarded(sizeof *failel), i = v.lft - 1;
        hsv[ALIVE] = 1, hsv[ENERGIES] = hsv[INVARIANTS] = k % 2 == 0 ? 0 : (real)0.01;
        for (int c = 0; c < 9; c++)
            hsv[STATE + c] = (real)gradients[k / 2][c];
        for (int j = 0; j < HISTORY; j++)
            v.hsvs[j * v.nlq + i] = hsv[j];
        CHECK(TOLD(ENTRY(toron_lsdyna_umat), v.cm, sig, hsv, STATE, failel) == TORON_INVERTED, "gradient %zu: %s", k / 2, text);
        CHECK(*failel == 1 && hsv[FAILED] == 1 && hsv[ALIVE] == 0 && sig[0] == 0, "gradient %zu: deleted", k / 2);
        CHECK(umat_vector(&v) == TORON_INVERTED && v.failels[i] == 1, "gradient %zu: %s", k / 2, text);
        for (int j = 0; j < HISTORY; j++)
            CHECK(v.hsvs[j * v.nlq + i] == hsv[j], "gradient %zu: variable %d", k / 2, j + 1);
        release();
    }
}

static void lsdyna_moduli(void)
{
#define MODULI toron_lsdyna_bulk_and_shear_f64
    const double *properties = cases[0].properties;
    double bulk = 0, shear = 0;
    CHECK(TOLD(MODULI, properties, PROPERTIES, &bulk, &shear) == TORON_OK, "moduli");
    double wave = bulk + 4 * shear / 3, fibre = properties[0];
    CHECK(fabs(wave - fibre) <= 1e-15 * fibre && bulk > 0 && shear > 0, "%g, %g", bulk, shear);
    REFUSED(TORON_PROPERTY_COUNT, "number of properties: 3 given, 11 needed", MODULI, properties, 3, &bulk, &shear);
    REFUSED(TORON_NULL_ARGUMENT, "argument bulk is null", MODULI, properties, PROPERTIES, NULL, &shear);
    REFUSED(TORON_NULL_ARGUMENT, "argument shear is null", MODULI, properties, PROPERTIES, &bulk, NULL);
    REFUSED(TORON_NULL_ARGUMENT, "argument properties is null", MODULI, NULL, PROPERTIES, &bulk, &shear);
}

/* ---- VUMAT */

#define VUMAT ENTRY(toron_abaqus_vumat)
#define NDIR_TEXT "direct stress components, NDIR (solids only): "
#define NDI_TEXT "direct stress components, NDI (solids only): "
#define NSHR_TEXT "shear stress components, NSHR (1 for plane strain and axisymmetric solids): "
#define DEPVAR_TEXT "number of state variables (*DEPVAR): "
enum { VUMAT_STATE = STATE + 2 };

/* The stretch of a point: the truth's F where that is symmetric, else ½1 + FᵀF/|F|², positive in either precision. */
static int stretch(const truth *t, double u[6])
{
    const double *f = t->f;
    int symmetric = f[1] == f[3] && f[2] == f[6] && f[5] == f[7];
    const int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
    double square = 0;
    for (int i = 0; i < 9; i++)
        square += f[i] * f[i];
    for (int c = 0; c < 6; c++) {
        const double *a = f + 3 * pairs[c][0], *b = f + 3 * pairs[c][1];
        u[c] = symmetric ? a[pairs[c][1]] : (c < 3 ? 0.5 : 0) + (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / square;
    }
    return symmetric;
}

typedef struct {
    toron_vumat block;
    real *strain_inc, *stretch_new, *stress_new, *state_old, *state_new, *energy_new, *inelastic_new;
} vumat_arrays;

static vumat_arrays vumat_block(const truth *first, int n)
{
    size_t count = (size_t)n;
    real *stretch_old = filled(0, 6 * count), *density = reals(count);
    vumat_arrays v = {.strain_inc = filled(0, 6 * count), .stretch_new = reals(6 * count),
                      .stress_new = reals(6 * count), .state_old = filled(0, VUMAT_STATE * count),
                      .state_new = reals(VUMAT_STATE * count), .energy_new = reals(count),
                      .inelastic_new = reals(count)};
    for (int i = 0; i < n; i++) {
        double u[6];
        stretch(first + i, u);
        for (int c = 0; c < 6; c++) {
            v.stretch_new[c * n + i] = (real)u[c];
            stretch_old[c * n + i] = (real)u[c];
        }
        /* The step keeps its stretch, so that the middle's density is ρ0/det U, with ρ0 = 2. */
        double volume = u[0] * (u[1] * u[2] - u[4] * u[4]) - u[3] * (u[3] * u[2] - u[4] * u[5])
            + u[5] * (u[3] * u[4] - u[1] * u[5]);
        density[i] = (real)(2 / volume);
        for (int j = STATE; j < VUMAT_STATE; j++)
            v.state_old[j * n + i] = (real)(j + i);
    }
    v.block = (toron_vumat){.size = sizeof v.block, .nblock = n, .ndir = 3, .nshr = 3, .nstatev = VUMAT_STATE, .nprops = PROPERTIES,
                            .step_time = 1e-6, .total_time = 1e-6,
                            .props = copied(first->properties, PROPERTIES), .density = density,
                            .strain_inc = v.strain_inc, .stretch_old = stretch_old, .stretch_new = v.stretch_new,
                            .stress_old = filled(5, 6 * count), .state_old = v.state_old,
                            .ener_intern_old = filled(7, count), .ener_inelas_old = filled(9, count),
                            .stress_new = v.stress_new, .state_new = v.state_new, .ener_intern_new = v.energy_new,
                            .ener_inelas_new = v.inelastic_new};
    return v;
}

/* Bit for bit what the law says at F = U, whose stress is the corotational one. */
static void check_corotational(const vumat_arrays *v, int i, const truth *t)
{
    int n = v->block.nblock;
    double u[6];
    stretch(t, u);
    const double f[9] = {u[0], u[3], u[5], u[3], u[1], u[4], u[5], u[4], u[2]};
    real columns[9], properties[PROPERTIES], state[STATE], stress[6];
    for (int c = 0; c < 9; c++)
        columns[c] = (real)f[c];
    for (int c = 0; c < PROPERTIES; c++)
        properties[c] = (real)t->properties[c];
    block_of_one(properties, columns, state, stress);
    for (int c = 0; c < 6; c++)
        CHECK(memcmp(&stress[c], &v->stress_new[c * n + i], sizeof(real)) == 0, "case %d", t->id);
    double energy = 0;
    for (int j = 0; j < STATE; j++) {
        CHECK(memcmp(&state[j], &v->state_new[j * n + i], sizeof(real)) == 0, "case %d, state %d", t->id, j);
        energy += j < INVARIANTS ? state[j] : 0;
    }
    /* W/ρ0 to some roundings of the volume, which is a sum of products of stretches. */
    double volume = 2 / (double)v->block.density[i], sizes = u[0] * u[1] * u[2] + fabs(2 * u[3] * u[4] * u[5])
        + u[0] * u[4] * u[4] + u[1] * u[5] * u[5] + u[2] * u[3] * u[3];
    double allowed = (sizeof(real) == 4 ? 0x1p-24 : 0x1p-53) * 16 * sizes / volume;
    CHECK(fabs(v->energy_new[i] - energy / 2) <= allowed * energy, "case %d: energy %g, wanted %g, allowed %g", t->id,
          v->energy_new[i], energy / 2, allowed);
}

static void vumat(void)
{
    int against_truth = 0;
    for (int first = 0; first < case_count;) {
        int n = run_of_cases(first, PROPERTIES);
        vumat_arrays v = vumat_block(&cases[first], n);
        int32_t status = TOLD(VUMAT, &v.block);
        CHECK(status == TORON_OK, "%d", status);
        for (int i = 0; i < n; i++) {
            const truth *t = &cases[first + i];
            double u[6];
            check_corotational(&v, i, t);
            if (stretch(t, u)) {
                check_stress(t, v.stress_new + i, (size_t)n);
                check_state(t, v.state_new + i, (size_t)n);
                against_truth++;
            }
            for (int j = STATE; j < VUMAT_STATE; j++)
                CHECK(v.state_new[j * n + i] == (real)(j + i), "what is not the law's goes over");
            CHECK(v.inelastic_new[i] == 9, "so does the inelastic energy");
        }
        release();
        first += n;
    }
    CHECK(against_truth > 40, "%d stretches in the truth", against_truth);
}

static void vumat_data_check(void)
{
    vumat_arrays v = vumat_block(cases, 2);
    v.block.step_time = v.block.total_time = 0;
    const real strain = (real)1e-4, k_el = v.block.props[0];
    v.strain_inc[0] = strain;         /* point 1, along 11 */
    v.strain_inc[3 * 2 + 1] = strain; /* point 2, tensor shear 12 */
    CHECK(TOLD(VUMAT, &v.block) == TORON_OK, "data check");
    double tolerance = sizeof(real) == 4 ? 1e-6 : 1e-15;
    CHECK(fabs((v.stress_new[0] - 5) / (k_el * strain) - 1) <= tolerance, "the fibre's wave: %g", v.stress_new[0]);
    CHECK(fabs((v.stress_new[3 * 2 + 1] - 5) / (0.75 * k_el * strain) - 1) <= tolerance, "2 G ε");
    for (int i = 0; i < 2; i++)
        CHECK(v.state_new[ALIVE * 2 + i] == 1 && v.state_new[FAILED * 2 + i] == 0 && v.energy_new[i] == 7, "alive");
    release();
}

/* In the data check as in a step: a point with numbers that are not finite is deleted, and its neighbours do not notice. No law reads
   the inelastic energy. */
static void vumat_data_check_of_bad_points(void)
{
    static const int32_t wanted[] = {TORON_OK,       TORON_NOT_FINITE,       TORON_STATE_NOT_FINITE, TORON_OVERFLOW,
                                     TORON_OVERFLOW, TORON_STATE_NOT_FINITE, TORON_OK};
    for (int bad = 0; bad < 7; bad++) {
        const int fine = wanted[bad] == TORON_OK;
        vumat_arrays v = vumat_block(cases, 2);
        v.block.step_time = v.block.total_time = 0;
        real *stress_old = filled(5, 12), *energies[2] = {filled(7, 2), filled(9, 2)};
        v.block.stress_old = stress_old;
        v.block.ener_intern_old = energies[0], v.block.ener_inelas_old = energies[1];
        v.strain_inc[0] = (real)1e-4;
        if (bad == 1)
            v.strain_inc[3 * 2 + 1] = NAN;
        if (bad == 2)
            v.state_old[ENERGIES * 2 + 1] = -INFINITY;
        if (bad == 3)
            stress_old[1] = INFINITY;
        if (bad == 4)
            v.strain_inc[1] = (real)(sizeof(real) == 4 ? 3e38 : 1e308);
        if (bad > 4)
            energies[bad - 5][1] = bad == 5 ? INFINITY : NAN;
        CHECK(TOLD(VUMAT, &v.block) == wanted[bad], "%d: %s", bad, text);
        CHECK(v.stress_new[0] > 5 && v.state_new[ALIVE * 2] == 1, "%d: the first point", bad);
        CHECK(v.state_new[ALIVE * 2 + 1] == fine && v.state_new[FAILED * 2 + 1] == !fine, "%d: the second one", bad);
        for (int c = 0; c < 6; c++)
            CHECK(v.stress_new[2 * c + 1] == (fine ? 5 : 0), "%d: component %d", bad, c);
        for (int j = 0; j < STATE; j++)
            CHECK(isfinite(v.state_new[2 * j + 1]), "%d: variable %d", bad, j);
        CHECK(v.energy_new[0] == 7 && v.energy_new[1] == (bad == 5 ? 0 : 7), "%d: energy", bad);
        CHECK(v.inelastic_new[0] == 9 && v.inelastic_new[1] == (bad == 6 ? 0 : 9), "%d: inelastic energy", bad);
        release();
    }
}

/* In a step an old energy that is not finite is not passed on, whether the point can be evaluated or not. */
static void vumat_energies_that_are_not_finite(void)
{
    static const double none[] = {NAN, INFINITY, -INFINITY};
    for (int k = 0; k < 3; k++) {
        vumat_arrays v = vumat_block(cases, 3);
        v.block.ener_intern_old = v.block.ener_inelas_old = filled(none[k], 3);
        v.stretch_new[1] = NAN;
        CHECK(TOLD(VUMAT, &v.block) == TORON_NOT_FINITE, "%s", text);
        for (int i = 0; i < 3; i++)
            CHECK(isfinite(v.energy_new[i]) && v.inelastic_new[i] == 0, "point %d: %g %g", i, v.energy_new[i], v.inelastic_new[i]);
        check_corotational(&v, 0, &cases[0]);
        check_corotational(&v, 2, &cases[2]);
        release();
    }
}

static void vumat_refused(toron_vumat block, int32_t wanted, const char *words)
{
    if (wanted == TORON_OK)
        CHECK(TOLD(VUMAT, &block) == TORON_OK, "%s", text);
    else
        REFUSED(wanted, words, VUMAT, &block);
    if (block.stress_new != NULL)
        CHECK(untouched(block.stress_new, 6 * sizeof(real)), "status %d", wanted);
    CHECK(untouched(block.state_new, VUMAT_STATE * sizeof(real)), "status %d", wanted);
    CHECK(untouched(block.ener_intern_new, sizeof(real)) && untouched(block.ener_inelas_new, sizeof(real)), "status %d", wanted);
}

static void vumat_wrong_calls(void)
{
    const toron_vumat good = vumat_block(cases, 1).block;
    toron_vumat block = good;
    block.nshr = 2;
    vumat_refused(block, TORON_BAD_COUNT, NSHR_TEXT "2 given, 3 needed");
    block = good, block.ndir = 2;
    vumat_refused(block, TORON_BAD_COUNT, NDIR_TEXT "2 given, 3 needed");
    block = good, block.nblock = -1;
    vumat_refused(block, TORON_BAD_COUNT, "argument nblock is -1; allowed: 0 or more");
    block = good, block.nblock = 0;
    vumat_refused(block, TORON_OK, "");
    block = good, block.nstatev = STATE - 1;
    vumat_refused(block, TORON_STATE_COUNT, DEPVAR_TEXT "10 given, 11 needed");
    block = good, block.nprops = PROPERTIES - 1;
    vumat_refused(block, TORON_PROPERTY_COUNT, "number of properties: 10 given, 11 needed");
    block = good, block.nprops = -1;
    vumat_refused(block, TORON_PROPERTY_COUNT, "number of properties: -1 given, 11 needed");
    block = good, block.level = 4;
    vumat_refused(block, TORON_BAD_ARGUMENT, "argument level is 4; allowed: " LEVELS_TEXT);
    block = good, block.stress_new = NULL;
    vumat_refused(block, TORON_NULL_ARGUMENT, "argument stress_new is null");
    block = good, block.stretch_new = NULL;
    vumat_refused(block, TORON_NULL_ARGUMENT, "argument stretch_new is null");
    block = good, block.props = filled(NAN, PROPERTIES);
    vumat_refused(block, TORON_PROPERTY_NOT_FINITE,
                  "property 1 (k_el, longitudinal elongation stiffness) is NaN; allowed: a number from 0 to 1e25");
    real *props = filled(VUMAT_STATE + 1, PROPERTIES + 1);
    memcpy(props, good.props, PROPERTIES * sizeof(real));
    block = good, block.props = props, block.nprops = PROPERTIES + 1, block.state_old = filled(-1, VUMAT_STATE);
    vumat_refused(block, TORON_BAD_ARGUMENT,
                  "argument limit_variable is 14.0; allowed: 0, or the number of a state variable behind those of the law, within "
                  "*DEPVAR");
    /* A limit that means nothing, in the data check. */
    props[PROPERTIES] = VUMAT_STATE;
    block.step_time = block.total_time = 0;
    vumat_refused(block, TORON_BAD_ARGUMENT,
                  "argument failure limit of a point (state variable limit_variable) is -1.0; allowed: a finite number, not negative; 0 "
                  "for that of the properties");
    REFUSED(TORON_NULL_ARGUMENT, "argument block is null", VUMAT, NULL);
    release();

    /* Points that cannot be evaluated are deleted; their neighbours do not notice. */
    vumat_arrays v = vumat_block(cases, 3);
    v.stretch_new[1] = NAN;
    v.state_old[ENERGIES * 3 + 1] = 4;
    CHECK(TOLD(VUMAT, &v.block) == TORON_NOT_FINITE, "NaN");
    CHECK(v.stress_new[1] == 0 && v.state_new[FAILED * 3 + 1] == 1 && v.state_new[ALIVE * 3 + 1] == 0, "deleted");
    CHECK(v.state_new[ENERGIES * 3 + 1] == 4 && v.energy_new[1] == 7, "energies stay");
    check_corotational(&v, 0, &cases[0]);
    check_corotational(&v, 2, &cases[2]);
    release();
}

/* ---- OpenRadioss, whose engine the programs of ffi-tests/openradioss take the part of. */

/* A group that is refused is left as it is, and so is what a card that is refused would be written to. */
static void openradioss_wrong_calls(void)
{
    enum { NEL = 3, NUVAR = 18, NUPARAM = 14, CARD = 13 };
    static const char *const words[] = {"NUVAR: 17 given, 18 needed", "argument density is 0.0; allowed: " DENSITIES_TEXT,
                                        "property 2 (k_tc, transverse compaction stiffness) is -1.0; allowed: a number from 0 to 1e25",
                                        "argument coordinates of the nodes (MAT_SOLID_GET_NOD_X) is null"};
    static const int32_t wanted[] = {TORON_STATE_COUNT, TORON_BAD_ARGUMENT, TORON_PROPERTY_OUT_OF_BOUNDS, TORON_NULL_ARGUMENT};
    for (int wrong = 0; wrong < 4; wrong++) {
        real *uparam = filled(0, NUPARAM), *density = filled(wrong == 1 ? 0 : 1, 1), *f[9], *s = reals(6 * NEL), *v = reals(7 * NEL);
        uparam[0] = 1;
        for (int c = 0; c < PROPERTIES; c++)
            uparam[1 + c] = (real)cases[0].properties[c];
        if (wrong == 2)
            uparam[2] = -1;
        uparam[1 + PROPERTIES] = wrong == 3;
        for (int c = 0; c < 9; c++)
            f[c] = filled(c < 3, NEL);
        real *sound = reals(NEL), *uvar = filled(0, NUVAR * NEL), *off = filled(0, NEL);
        uvar[14 * NEL] = 7;
        REFUSED(wanted[wrong], words[wrong], ENTRY(toron_openradioss_luser), NEL, NUPARAM, wrong == 0 ? NUVAR - 1 : NUVAR, 0, uparam, NULL,
                density, f[0], f[1], f[2], f[3], f[4], f[5], f[6], f[7], f[8], s, s + NEL, s + 2 * NEL, s + 3 * NEL, s + 4 * NEL,
                s + 5 * NEL, v, v + NEL, v + 2 * NEL, v + 3 * NEL, v + 4 * NEL, v + 5 * NEL, sound, v + 6 * NEL, uvar, off, NULL);
        CHECK(untouched(s, 6 * NEL * sizeof(real)) && untouched(v, 7 * NEL * sizeof(real)) && untouched(sound, NEL * sizeof(real)),
              "results: %s", words[wrong]);
        for (int k = 0; k < NUVAR * NEL; k++)
            CHECK(uvar[k] == (k == 14 * NEL ? 7 : 0), "variable %d: %s", k, words[wrong]);
        CHECK(off[0] == 0 && off[1] == 0 && off[2] == 0, "OFF: %s", words[wrong]);
    }
    release();
    for (int wrong = 0; wrong < 4; wrong++) {
        static const char *const of_card[] = {"argument count is -1; allowed: 0 to " MOST_TEXT, "MAXUPARAM: 5 given, 14 needed",
                                              "number of values on the card, five a line: 3 given, 11 needed",
                                              "argument nn of /MAT/USERnn is 9; allowed: 1 (USER01, hyperelastic yarn law), 2 (USER02, "
                                              "linear elastic law), 3 (USER03, yarn law with friction)"};
        static const int32_t codes[] = {TORON_BAD_COUNT, TORON_PROPERTY_COUNT, TORON_PROPERTY_COUNT, TORON_BAD_ARGUMENT};
        real *values = filled(1, CARD), *uparam = reals(20), *parmat = reals(1);
        int32_t *counts = guarded(2 * sizeof *counts);
        REFUSED(codes[wrong], of_card[wrong], ENTRY(toron_openradioss_lecm), wrong == 3 ? 9 : 1, values,
                wrong == 0 ? SIZE_MAX : wrong == 2 ? 3 : PROPERTIES, uparam, wrong == 1 ? 5 : 20, counts, counts + 1, parmat);
        CHECK(untouched(uparam, 20 * sizeof(real)) && untouched(counts, 2 * sizeof *counts) && untouched(parmat, sizeof(real)), "%s",
              of_card[wrong]);
    }
    release();
}

/* ---- UMAT: double precision only */

#ifndef SINGLE
static const int order_standard[6] = {0, 1, 2, 3, 5, 4}; /* 11 22 33 12 13 23 */

typedef struct {
    double *stress, *statev, *ddsdde, *sse, *pnewdt, *dfgrd1, *props;
    int32_t nprops, nstatv, ndi, nshr, nlgeom;
} umat_arguments;

static umat_arguments umat_point(const truth *t)
{
    umat_arguments a = {.stress = reals(6), .statev = filled(0, STATE), .ddsdde = reals(36), .sse = reals(1),
                        .pnewdt = filled(1, 1),
                        .dfgrd1 = copied(t->f, 9),
                        .props = copied(t->properties, PROPERTIES), .nprops = PROPERTIES, .nstatv = STATE, .ndi = 3,
                        .nshr = 3, .nlgeom = 1};
    return a;
}

static int32_t call_umat(const umat_arguments *a)
{
    return TOLD(toron_abaqus_umat_tangent_f64, a->stress, a->statev, a->ddsdde, a->sse, a->pnewdt, a->dfgrd1, a->props, a->nprops,
                a->nstatv, a->ndi, a->nshr, a->nlgeom);
}

/* Old energies of a failed point whose sum is no number: Abaqus is asked for a smaller increment, and nothing but the stress is
 * written. */
static void umat_energies_that_overflow(void)
{
    for (int sign = -1; sign < 2; sign += 2) {
        umat_arguments a = umat_point(cases);
        a.statev[FAILED] = 1;
        for (int k = 0; k < 4; k++)
            a.statev[ENERGIES + k] = sign * 1e308;
        CHECK(call_umat(&a) == TORON_OVERFLOW && *a.pnewdt == 0.25, "%s, PNEWDT %g", text, *a.pnewdt);
        CHECK(untouched(a.sse, sizeof(double)) && a.statev[ENERGIES] == sign * 1e308 && a.statev[ALIVE] == 0, "SSE, state");
        for (int c = 0; c < 6; c++)
            CHECK(a.stress[c] == 0, "stress");
        for (int c = 0; c < 36; c++)
            CHECK(a.ddsdde[c] == 0, "DDSDDE");
        release();
    }
}

static void umat(void)
{
    for (const truth *t = cases; t < cases + case_count; t++) {
        umat_arguments a = umat_point(t);
        int32_t status = call_umat(&a);
        CHECK(status == TORON_OK, "case %d: %d", t->id, status);
        double stress[6], energy = 0, jacobian = determinant(t->f);
        for (int c = 0; c < 6; c++)
            stress[c] = a.stress[order_standard[c]];
        check_stress(t, stress, 1);
        check_state(t, a.statev, 1);
        for (int k = 0; k < 4; k++)
            energy += a.statev[ENERGIES + k];
        CHECK(fabs(*a.sse * jacobian - energy) <= 1e-12 * energy, "case %d: SSE %g", t->id, *a.sse);
        CHECK(*a.pnewdt == 1, "case %d: PNEWDT %g", t->id, *a.pnewdt);
        check_tangent(t, a.ddsdde, 1, NULL, 1);

        /* Without DDSDDE: the same bits, by either entry. */
        umat_arguments b = umat_point(t);
        TOLD(toron_abaqus_umat_f64, b.stress, b.statev, b.sse, b.pnewdt, b.dfgrd1, b.props, b.nprops, b.nstatv, 3, 3, 1);
        CHECK(memcmp(a.stress, b.stress, 6 * sizeof(double)) == 0, "case %d: stress", t->id);
        CHECK(memcmp(a.statev, b.statev, STATE * sizeof(double)) == 0, "case %d: state", t->id);

        /* Plane strain: four components of the six, for a fibre in the plane or normal to it. */
        umat_arguments plane = umat_point(t);
        plane.nshr = 1;
        const double *m = t->properties + 8;
        if (m[2] != 0 && (m[0] != 0 || m[1] != 0)) {
            CHECK(call_umat(&plane) == TORON_FIBRE_OUT_OF_PLANE, "case %d", t->id);
            CHECK(untouched(plane.stress, 6 * sizeof(double)) && untouched(plane.ddsdde, 36 * sizeof(double)), "refused");
            release();
            continue;
        }
        CHECK(call_umat(&plane) == TORON_OK, "case %d", t->id);
        CHECK(memcmp(a.stress, plane.stress, 4 * sizeof(double)) == 0, "case %d: stress", t->id);
        for (int i = 0; i < 4; i++)
            CHECK(memcmp(a.ddsdde + 6 * i, plane.ddsdde + 4 * i, 4 * sizeof(double)) == 0, "case %d: row %d", t->id, i);
        CHECK(untouched(plane.stress + 4, 2 * sizeof(double)) && untouched(plane.ddsdde + 16, 20 * sizeof(double)), "beyond");
        release();
    }
}

static void umat_refused(umat_arguments a, int32_t wanted, const char *words)
{
    REFUSED(wanted, words, toron_abaqus_umat_tangent_f64, a.stress, a.statev, a.ddsdde, a.sse, a.pnewdt, a.dfgrd1, a.props,
            a.nprops, a.nstatv, a.ndi, a.nshr, a.nlgeom);
    REFUSED(wanted, words, toron_abaqus_umat_f64, a.stress, a.statev, a.sse, a.pnewdt, a.dfgrd1, a.props, a.nprops, a.nstatv, a.ndi,
            a.nshr, a.nlgeom);
    if (a.stress != NULL)
        CHECK(untouched(a.stress, 6 * sizeof(double)), "status %d", wanted);
    CHECK(untouched(a.ddsdde, 36 * sizeof(double)), "status %d", wanted);
    CHECK(untouched(a.sse, sizeof(double)) && *a.pnewdt == 1, "status %d", wanted);
}

static void umat_wrong_calls(void)
{
    const truth rest = cases[0];
    const umat_arguments good = umat_point(&rest);
    umat_arguments a = good;
    a.nlgeom = 0; /* small displacements: F is the identity whatever happens */
    umat_refused(a, TORON_NO_DEFORMATION_GRADIENT,
                 "there is no deformation gradient: the step is geometrically linear, give *STEP, NLGEOM=YES");
    a = good, a.ndi = 2;
    umat_refused(a, TORON_BAD_COUNT, NDI_TEXT "2 given, 3 needed");
    a = good, a.nshr = 2;
    umat_refused(a, TORON_BAD_COUNT, NSHR_TEXT "2 given, 3 needed");
    a = good, a.ndi = 2, a.nshr = 1; /* plane stress */
    umat_refused(a, TORON_BAD_COUNT, NDI_TEXT "2 given, 3 needed");
    a = good, a.nstatv = STATE - 1;
    umat_refused(a, TORON_STATE_COUNT, DEPVAR_TEXT "10 given, 11 needed");
    a = good, a.nprops = PROPERTIES + 2;
    umat_refused(a, TORON_PROPERTY_COUNT, "number of properties: 13 given, 11 needed");
    a = good, a.nprops = -1;
    umat_refused(a, TORON_PROPERTY_COUNT, "number of properties: -1 given, 11 needed");
    a = good, a.props = NULL;
    umat_refused(a, TORON_NULL_ARGUMENT, "argument props is null");
    a = good, a.stress = NULL;
    umat_refused(a, TORON_NULL_ARGUMENT, "argument stress is null");
    a = good, a.props = filled(-1, PROPERTIES);
    umat_refused(a, TORON_PROPERTY_OUT_OF_BOUNDS,
                 "property 1 (k_el, longitudinal elongation stiffness) is -1.0; allowed: a number from 0 to 1e25");

    /* An inverted point keeps its state and asks for a smaller increment, but never for a larger one. */
    a = good;
    a.dfgrd1 = copied(rest.f, 9);
    a.dfgrd1[0] = -1;
    a.statev[ENERGIES] = 3;
    CHECK(call_umat(&a) == TORON_INVERTED && *a.pnewdt == 0.25, "PNEWDT %g", *a.pnewdt);
    *a.pnewdt = 0.125;
    CHECK(call_umat(&a) == TORON_INVERTED && *a.pnewdt == 0.125, "PNEWDT %g", *a.pnewdt);
    for (int k = 0; k < 36; k++)
        CHECK(a.ddsdde[k] == 0, "no stiffness");
    CHECK(a.statev[ENERGIES] == 3 && a.stress[0] == 0 && untouched(a.sse, sizeof(double)), "the state stays");
    release();
}
#endif

int main(int argc, char **argv)
{
    read_cases(argc, argv);
    lsdyna_scalar();
    lsdyna_vector();
    lsdyna_vector_tangents();
    lsdyna_bad_elements();
    lsdyna_wrong_calls();
    lsdyna_collapsed();
    lsdyna_moduli();
    vumat();
    vumat_data_check();
    vumat_data_check_of_bad_points();
    vumat_energies_that_are_not_finite();
    vumat_wrong_calls();
    openradioss_wrong_calls();
#ifndef SINGLE
    umat();
    umat_energies_that_overflow();
    umat_wrong_calls();
#endif
    return finish();
}
